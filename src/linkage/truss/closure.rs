//! The loops of a truss as equations in its rotations, and Newton's method on them.
//!
//! Around loop `k` the vectors from joint to joint add up: `f_k = sum_j c_kj theta_j = 0`, and conjugated `g_k = sum_j c'_kj / theta_j = 0`,
//! with `theta_j = e^(i phi_j)` and theta = 1 for one link of choice. Over the complex numbers the two are independent. Steps are
//! relative, `theta_j (1 + delta_j)`: both kinds of equation are then equally well scaled however large a rotation is.

use num_complex::Complex64;

use super::describe::Truss;
use crate::linkage::pivoting::{Solved, modulus, solve};

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
/// After a relative step this short the next is not taken: what it would mend is the square of this times the condition of the Jacobian, and
/// rounding leaves 1e-16 times that.
const LAST_STEP: f64 = 1e-9;
/// Rotations of such a modulus are what solutions at infinity leave: there the loops close up to rounding without being solved (heuristic:
/// of 180,000 solutions of random trusses the farthest has 5e4).
const FAR: f64 = 1e8;
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
        Newton::new(self, 0).linearise(theta)
    }

    /// Newton's method in the rotations of all links but `fixed`, from a start that closes the loops to `plausible`; `None` where it
    /// leads nowhere.
    pub(super) fn refine(&self, start: &[Complex64], fixed: usize, plausible: f64) -> Option<Refined> {
        let mut newton = Newton::new(self, fixed);
        let (mut theta, mut next) = (start.to_vec(), start.to_vec());
        let mut residual = newton.linearise(&theta);
        // Written so that NaN is refused.
        let starts_well = residual < plausible;
        if !starts_well {
            return None;
        }
        let mut regular = true;
        for taken in 0..MOST_STEPS {
            let step = newton.step()?;
            regular = step.kernel.is_none();
            let longest = longest(&step.solution);
            if !longest.is_finite() {
                return None;
            }
            let held = if longest > LONGEST_STEP { LONGEST_STEP / longest } else { 1.0 };
            newton.take(&theta, &step.solution, held, &mut next);
            let after = newton.linearise(&next);
            // Near the end rounding decides; a step that gains nothing is not taken. The first always is: where the Jacobian is nearly
            // singular, small residuals say little about a start.
            if taken > 0 && residual < CLOSED && after >= residual {
                break;
            }
            std::mem::swap(&mut theta, &mut next);
            residual = after;
            if longest < LAST_STEP {
                break;
            }
        }
        let near = |t: &Complex64| (1.0 / FAR..FAR).contains(&modulus(*t));
        (residual < CLOSED && theta.iter().all(near)).then_some(Refined { theta, residual, regular })
    }

    /// Whether a whole curve of solutions passes through one where the Jacobian has lost a rank: points are sought at distances along
    /// the kernel, both ways. A double solution draws them back, and of two solutions close together one lies on one side only; on a
    /// curve all stay where they are put, and the rank is lost there too.
    pub(super) fn on_a_curve(&self, theta: &[Complex64], fixed: usize) -> bool {
        const DISTANCES: [f64; 3] = [1e-3, -1e-3, 4e-4];
        let mut newton = Newton::new(self, fixed);
        newton.linearise(theta);
        let Some(Solved { kernel: Some(kernel), .. }) = newton.step() else { return false };
        let unit = 1.0 / longest(&kernel);
        let (mut point, mut next) = (theta.to_vec(), theta.to_vec());
        DISTANCES.iter().all(|&along| {
            newton.take(theta, &kernel, along * unit, &mut point);
            let mut singular = false;
            for _ in 0..MOST_STEPS {
                newton.linearise(&point);
                let Some(step) = newton.step() else { return false };
                let longest = longest(&step.solution);
                if longest.is_nan() || longest > LONGEST_STEP {
                    return false;
                }
                singular = step.kernel.is_some();
                newton.take(&point, &step.solution, 1.0, &mut next);
                std::mem::swap(&mut point, &mut next);
            }
            let moved = distance(&point, theta) / along.abs();
            singular && self.residual(&point) < CLOSED && (0.5..2.0).contains(&moved)
        })
    }
}

fn longest(step: &[Complex64]) -> f64 {
    // `max` would drop a NaN.
    step.iter().map(|d| modulus(*d)).fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a })
}

/// The linearised equations at one place, in memory that is used again for the next.
struct Newton<'a> {
    closure: &'a Closure,
    fixed: usize,
    matrix: Vec<Complex64>,
    right: Vec<Complex64>,
    inverses: Vec<Complex64>,
}

impl<'a> Newton<'a> {
    fn new(closure: &'a Closure, fixed: usize) -> Self {
        let equations = 2 * closure.rows.len();
        let matrix = vec![Complex64::ZERO; equations * (closure.links - 1)];
        let (right, inverses) = (vec![Complex64::ZERO; equations], vec![Complex64::ZERO; closure.links]);
        Self { closure, fixed, matrix, right, inverses }
    }

    /// Fills in the equations at `theta`; their largest residual.
    fn linearise(&mut self, theta: &[Complex64]) -> f64 {
        let unknowns = self.closure.links - 1;
        for (inverse, t) in self.inverses.iter_mut().zip(theta) {
            *inverse = t.inv();
        }
        let mut worst = 0.0f64;
        for (which, line) in self.matrix.chunks_exact_mut(unknowns).enumerate() {
            let row = &self.closure.rows[which / 2];
            let upper = which % 2 == 0;
            let (mut sum, mut size) = (Complex64::ZERO, 0.0);
            let mut place = 0;
            for (link, c) in row.iter().enumerate() {
                let value = if upper { c * theta[link] } else { c.conj() * self.inverses[link] };
                sum += value;
                size += modulus(value);
                if link != self.fixed {
                    line[place] = if upper { value } else { -value };
                    place += 1;
                }
            }
            self.right[which] = Complex64::ZERO;
            if size > 0.0 {
                let scale = 1.0 / size;
                line.iter_mut().for_each(|z| *z *= scale);
                self.right[which] = -sum * scale;
            }
            let residual = modulus(self.right[which]);
            // `max` would drop a NaN.
            worst = if residual > worst || residual.is_nan() { residual } else { worst };
        }
        if worst.is_nan() { f64::INFINITY } else { worst }
    }

    /// The relative Newton step from there; a rank that is missing leaves the corresponding rotation alone.
    fn step(&mut self) -> Option<Solved> {
        solve(&mut self.matrix, &mut self.right, self.closure.links - 1, RANK)
    }

    /// `theta (1 + held delta)`, the fixed rotation left alone.
    fn take(&self, theta: &[Complex64], delta: &[Complex64], held: f64, next: &mut [Complex64]) {
        let mut delta = delta.iter();
        for (link, (next, t)) in next.iter_mut().zip(theta).enumerate() {
            let d = if link == self.fixed { None } else { delta.next() };
            *next = d.map_or(*t, |d| t * (1.0 + d * held));
        }
    }
}

/// The largest relative difference of two sets of rotations.
pub(super) fn distance(a: &[Complex64], b: &[Complex64]) -> f64 {
    let square = |(x, y): (&Complex64, &Complex64)| (x - y).norm_sqr() / x.norm_sqr().max(y.norm_sqr());
    a.iter().zip(b).map(square).fold(0.0, f64::max).sqrt()
}
