//! The loops of a truss as equations in its rotations, and Newton's method on them.
//!
//! Around loop `k` the vectors from joint to joint add up: `f_k = sum_j c_kj theta_j = 0`, and conjugated `g_k = sum_j c'_kj / theta_j = 0`,
//! with `theta_j = e^(i phi_j)` and theta = 1 for one link of choice. Over the complex numbers the two are independent. Steps are
//! relative, `theta_j (1 + delta_j)`: both kinds of equation are then equally well scaled however large a rotation is.

use num_complex::Complex64;

use super::describe::Truss;
use crate::linkage::pivoting::solve;

/// The equations of a truss, lengths divided by its size.
pub(super) struct Closure {
    pub(super) links: usize,
    /// One row a loop, one column a link.
    pub(super) rows: Vec<Vec<Complex64>>,
    /// Links that turn freely.
    loose: Vec<usize>,
}

/// A Newton step is held to this part of each rotation (heuristic: halves the way at worst).
const LONGEST_STEP: f64 = 0.5;
/// Steps until a start is given up; from eigenvectors two or three suffice.
const MOST_STEPS: usize = 20;
/// Largest residual of a closed loop: sum over the sum of the sizes of its terms.
pub(super) const CLOSED: f64 = 1e-11;
/// A pivot below this part of the largest counts as zero: the Jacobian has lost a rank (heuristic; double solutions settle at about
/// 1e-8 from their place, and their pivots likewise).
const RANK: f64 = 1e-6;

/// Where Newton's method ended.
pub(super) struct Refined {
    pub(super) theta: Vec<Complex64>,
    pub(super) residual: f64,
    /// Whether the Jacobian keeps its rank there.
    pub(super) regular: bool,
}

impl Closure {
    pub(super) fn of(truss: &Truss) -> Self {
        let links = truss.links();
        let place = |link: usize, joint: usize| {
            let side = usize::from(truss.graph.edges[joint][1] == link);
            truss.places[joint][side] / truss.size
        };
        let row = |around: Vec<super::graph::Passage>| {
            let mut row = vec![Complex64::ZERO; links];
            for passage in around {
                row[passage.link] += place(passage.link, passage.leaves) - place(passage.link, passage.enters);
            }
            row
        };
        let mut rows: Vec<Vec<Complex64>> = truss.graph.loops(truss.ground).into_iter().map(row).collect();
        // A loose link turns freely, so its rotation is fixed to the ground's by a term that vanishes there and nowhere else near: the
        // equations then say more than twice as many unknowns, and solutions of this square system elsewhere are not the truss's.
        for (place, &link) in truss.loose.iter().enumerate() {
            for (k, row) in rows.iter_mut().enumerate() {
                let weight = Complex64::from_polar(1.0, 1.0 + 2.3 * k as f64 + 0.7 * place as f64);
                row[link] = weight;
                row[truss.ground] -= weight;
            }
        }
        Self { links, rows, loose: truss.loose.clone() }
    }

    /// Whether the loose links stand as they were fixed.
    pub(super) fn loose_links_stand(&self, theta: &[Complex64], ground: usize) -> bool {
        self.loose.iter().all(|&link| (theta[link] / theta[ground] - 1.0).norm() < CLOSED.sqrt())
    }

    /// The largest `|sum| / sum of sizes` over the equations.
    pub(super) fn residual(&self, theta: &[Complex64]) -> f64 {
        let worst = |value: &dyn Fn(Complex64, Complex64) -> Complex64| {
            let of_row = |row: &Vec<Complex64>| {
                let terms = row.iter().zip(theta).map(|(&c, &t)| value(c, t));
                let (sum, size) = terms.fold((Complex64::ZERO, 0.0), |(sum, size), x| (sum + x, size + x.norm()));
                if size > 0.0 { sum.norm() / size } else { 0.0 }
            };
            self.rows.iter().map(of_row).fold(0.0, f64::max)
        };
        let largest = worst(&|c, t| c * t).max(worst(&|c, t| c.conj() / t));
        if largest.is_nan() { f64::INFINITY } else { largest }
    }

    /// Newton's method in the rotations of all links but `fixed`; `None` where it leads nowhere.
    pub(super) fn refine(&self, start: &[Complex64], fixed: usize) -> Option<Refined> {
        let mut theta = start.to_vec();
        let mut residual = self.residual(&theta);
        let mut regular = true;
        for _ in 0..MOST_STEPS {
            let step = self.step(&theta, fixed)?;
            regular = step.regular;
            let longest = step.delta.iter().map(|d| d.norm()).fold(0.0, f64::max);
            if !longest.is_finite() {
                return None;
            }
            let held = if longest > LONGEST_STEP { LONGEST_STEP / longest } else { 1.0 };
            let next: Vec<Complex64> = theta.iter().zip(&step.delta).map(|(t, d)| t * (1.0 + d * held)).collect();
            let after = self.residual(&next);
            // Near the end rounding decides; a step that gains nothing is not taken.
            if residual < CLOSED && after >= residual {
                break;
            }
            (theta, residual) = (next, after);
            if longest < 1e-14 {
                break;
            }
        }
        (residual < CLOSED && theta.iter().all(|t| t.is_finite())).then_some(Refined { theta, residual, regular })
    }

    /// One relative Newton step, zero for `fixed`; a rank that is missing leaves the corresponding rotation alone.
    fn step(&self, theta: &[Complex64], fixed: usize) -> Option<Step> {
        let (loops, unknowns) = (self.rows.len(), self.links - 1);
        let mut matrix = vec![Complex64::ZERO; 2 * loops * unknowns];
        let mut right = vec![Complex64::ZERO; 2 * loops];
        for (k, row) in self.rows.iter().enumerate() {
            for (which, sign) in [(2 * k, 1.0), (2 * k + 1, -1.0)] {
                let term = |j: usize| if sign > 0.0 { row[j] * theta[j] } else { row[j].conj() / theta[j] };
                let (mut sum, mut size) = (Complex64::ZERO, 0.0);
                for j in 0..self.links {
                    let value = term(j);
                    sum += value;
                    size += value.norm();
                    if j != fixed {
                        matrix[which * unknowns + j - usize::from(j > fixed)] = value * sign;
                    }
                }
                if size > 0.0 {
                    matrix[which * unknowns..(which + 1) * unknowns].iter_mut().for_each(|z| *z /= size);
                    right[which] = -sum / size;
                }
            }
        }
        let solved = solve(&mut matrix, &mut right, unknowns, RANK)?;
        let mut delta = solved.solution;
        let mut kernel = solved.kernel;
        delta.insert(fixed, Complex64::ZERO);
        if let Some(kernel) = &mut kernel {
            kernel.insert(fixed, Complex64::ZERO);
        }
        Some(Step { delta, regular: kernel.is_none(), kernel })
    }

    /// Whether a whole curve of solutions passes through one where the Jacobian has lost a rank: a point is sought at a distance along
    /// the kernel. A double solution draws it back; on a curve it stays away.
    pub(super) fn on_a_curve(&self, theta: &[Complex64], fixed: usize) -> bool {
        const DISTANCE: f64 = 1e-3;
        let Some(Step { kernel: Some(kernel), .. }) = self.step(theta, fixed) else { return false };
        let largest = kernel.iter().map(|d| d.norm()).fold(0.0, f64::max);
        let mut point: Vec<Complex64> =
            theta.iter().zip(&kernel).map(|(t, d)| t * (1.0 + d * (DISTANCE / largest))).collect();
        for _ in 0..MOST_STEPS {
            let Some(step) = self.step(&point, fixed) else { return false };
            let longest = step.delta.iter().map(|d| d.norm()).fold(0.0, f64::max);
            if longest.is_nan() || longest > LONGEST_STEP {
                return false;
            }
            point = point.iter().zip(&step.delta).map(|(t, d)| t * (1.0 + d)).collect();
        }
        self.residual(&point) < CLOSED && distance(&point, theta) > DISTANCE / 10.0
    }
}

struct Step {
    delta: Vec<Complex64>,
    regular: bool,
    kernel: Option<Vec<Complex64>>,
}

/// The largest relative difference of two sets of rotations.
pub(super) fn distance(a: &[Complex64], b: &[Complex64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).norm() / x.norm().max(y.norm())).fold(0.0, f64::max)
}
