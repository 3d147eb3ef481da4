//! Total-degree homotopy in projective space, from roots of unity; it needs nothing but the equations.
//!
//! Unknowns are `(x0 : theta : tau : u : v)` on a random affine patch, so that paths to infinity stay bounded and end at `x0 = 0`. The
//! fourth equation is `theta tau = x0²`. Start system: `x_i^d_i = x0^d_i`, times a random `gamma`, against which no path meets another
//! before its end.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::family::alike;
use super::linear::{Factored, Matrix, Vector};
use super::rows::{Problem, Row};
use super::track::{Homotopy, ORDER, Settings, larger, polish, track};
use super::{Outcome, family::Segment};

/// Distances to the end, `1 - t`, at which the coordinate `x0` of a path is compared.
const PROBES: [f64; 2] = [1e-5, 1e-7];

/// A path runs to infinity where `x0` falls like `(1 - t)` to more than this power; with a finite end the power is 0, to a
/// singular point at infinity of multiplicity m it is about 1/m.
const FALLING: f64 = 0.05;

/// Random numbers from a seed: the generator splitmix64.
pub struct Numbers(u64);

impl Numbers {
    /// The sequence of this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Any argument, modulus between 1/2 and 1.
    pub fn complex(&mut self) -> Complex64 {
        Complex64::from_polar(0.5 + 0.5 * self.unit(), TAU * self.unit())
    }
}

/// The homotopy, with its start system.
struct TotalDegree {
    rows: [Row; 3],
    degrees: [i32; 4],
    gamma: Complex64,
    patch: Vector<5>,
}

impl TotalDegree {
    fn new(rows: &[Row; 3], seed: u64) -> Self {
        let mut numbers = Numbers::new(seed ^ 0x5eed);
        let degree = |row: &Row| if row[..3].iter().any(|c| *c != Complex64::ZERO) { 2 } else { 1 };
        let degrees = [degree(&rows[0]), degree(&rows[1]), degree(&rows[2]), 2];
        Self { rows: *rows, degrees, gamma: numbers.complex(), patch: std::array::from_fn(|_| numbers.complex()) }
    }

    /// The roots of unity, on the patch.
    fn starts(&self) -> Vec<Vector<5>> {
        let count: i32 = self.degrees.iter().product();
        let point = |mut index: i32| {
            let mut x = [Complex64::ONE; 5];
            for (x, d) in x[1..].iter_mut().zip(self.degrees) {
                *x = Complex64::from_polar(1.0, TAU * f64::from(index % d) / f64::from(d));
                index /= d;
            }
            let on: Complex64 = x.iter().zip(&self.patch).map(|(x, c)| x * c).sum();
            x.map(|x| x / on)
        };
        (0..count).map(point).collect()
    }

    /// The target's four equations and their gradients.
    fn target(&self, [x0, theta, tau, u, v]: &Vector<5>) -> ([Complex64; 4], [Vector<5>; 4]) {
        let mut value = [Complex64::ZERO; 4];
        let mut gradient = [[Complex64::ZERO; 5]; 4];
        for i in 0..3 {
            let c = &self.rows[i];
            if self.degrees[i] == 1 {
                value[i] = c[3] * u + c[4] * v + c[5] * theta + c[6] * tau + c[7] * x0;
                gradient[i] = [c[7], c[5], c[6], c[3], c[4]];
                continue;
            }
            let linear = c[3] * u + c[4] * v + c[5] * theta + c[6] * tau;
            let (by_u, by_v) = (c[0] * v + c[1] * tau + c[3] * x0, c[0] * u + c[2] * theta + c[4] * x0);
            let (by_theta, by_tau) = (c[2] * v + c[5] * x0, c[1] * u + c[6] * x0);
            let by_x0 = linear + c[7] * x0 * 2.0;
            value[i] = (u * by_u + v * by_v + theta * by_theta + tau * by_tau + x0 * by_x0) * 0.5;
            gradient[i] = [by_x0, by_theta, by_tau, by_u, by_v];
        }
        let zero = Complex64::ZERO;
        value[3] = theta * tau - x0 * x0;
        gradient[3] = [x0 * -2.0, *tau, *theta, zero, zero];
        (value, gradient)
    }

    /// `gamma (x_i^d - x0^d)` and its derivatives by `x0` and `x_i`.
    fn start(&self, x: &Vector<5>, i: usize) -> [Complex64; 3] {
        let (x0, xi) = (x[0], x[i + 1]);
        match self.degrees[i] {
            1 => [self.gamma * (xi - x0), -self.gamma, self.gamma],
            _ => [self.gamma * (xi * xi - x0 * x0), self.gamma * x0 * -2.0, self.gamma * xi * 2.0],
        }
    }
}

impl Homotopy<5> for TotalDegree {
    fn system(&self, x: &Vector<5>, t: f64) -> (Vector<5>, Matrix<5>) {
        let (target, gradient) = self.target(x);
        let (mut value, mut jacobian) = ([Complex64::ZERO; 5], [self.patch; 5]);
        for i in 0..4 {
            let [start, by_x0, by_xi] = self.start(x, i);
            value[i] = target[i] * t + start * (1.0 - t);
            jacobian[i] = gradient[i].map(|d| d * t);
            jacobian[i][0] += by_x0 * (1.0 - t);
            jacobian[i][i + 1] += by_xi * (1.0 - t);
        }
        value[4] = x.iter().zip(&self.patch).map(|(x, c)| x * c).sum::<Complex64>() - 1.0;
        (value, jacobian)
    }

    fn drift(&self, x: &Vector<5>, _: f64) -> Vector<5> {
        let (target, _) = self.target(x);
        std::array::from_fn(|i| if i < 4 { target[i] - self.start(x, i)[0] } else { Complex64::ZERO })
    }

    /// Every equation is of degree two at most: the product of two orders is read off from the gradient, `x'·grad f(x'')`.
    fn series(&self, x: &Vector<5>, t: f64) -> Option<[Vector<5>; ORDER]> {
        let (_, jacobian) = self.system(x, t);
        let factored = Factored::new(jacobian)?;
        let first = factored.solve(&self.drift(x, t)).map(|d| -d);
        let dot = |a: &Vector<5>, b: &Vector<5>| a.iter().zip(b).map(|(a, b)| a * b).sum::<Complex64>();
        // A gradient at a difference of points, less its constant part, is linear: the Hessian times that difference.
        let (_, at_zero) = self.system(&[Complex64::ZERO; 5], t);
        let hessian = |y: &Vector<5>| {
            let (_, at_y) = self.system(y, t);
            let rows: Matrix<5> = std::array::from_fn(|i| std::array::from_fn(|j| at_y[i][j] - at_zero[i][j]));
            rows
        };
        let (_, gradient) = self.target(x);
        let drift_jacobian: Matrix<5> = std::array::from_fn(|i| {
            let mut row = [Complex64::ZERO; 5];
            if i < 4 {
                let [_, by_x0, by_xi] = self.start(x, i);
                row = gradient[i];
                row[0] -= by_x0;
                row[i + 1] -= by_xi;
            }
            row
        });
        let by_first = hessian(&first);
        let value = std::array::from_fn(|i| -(dot(&by_first[i], &first) * 0.5 + dot(&drift_jacobian[i], &first)));
        let second = factored.solve(&value);
        // The quadratic part of the drift at `first`.
        let (target, _) = self.target(&first);
        let quadratic = |i: usize| {
            if i < 4 && self.degrees[i] == 2 { target[i] - self.start(&first, i)[0] } else { Complex64::ZERO }
        };
        let value =
            std::array::from_fn(|i| -(dot(&by_first[i], &second) + dot(&drift_jacobian[i], &second) + quadratic(i)));
        Some([first, second, factored.solve(&value)])
    }

    fn relative(&self, dx: &Vector<5>, x: &Vector<5>) -> f64 {
        dx.iter().fold(0.0, larger) / x.iter().fold(0.0, larger)
    }
}

/// The finite solutions of three rows in `(theta, u, v)`, and what became of the paths.
pub fn solve_rows(rows: &[Row; 3], seed: u64, settings: &Settings) -> (Vec<Vector<3>>, Outcome) {
    let homotopy = TotalDegree::new(rows, seed);
    // The same rows from t = 0 to 1, to sharpen what was found.
    let target = Segment::new(rows, rows);
    let mut out = Outcome::default();
    let mut found: Vec<Vector<3>> = Vec::new();
    for start in homotopy.starts() {
        out.paths += 1;
        match follow(&homotopy, start, settings, &mut out.steps) {
            End::Infinity => out.at_infinity += 1,
            End::Failed => out.failed += 1,
            End::Point([x0, theta, _, u, v]) => match polish(&target, [theta / x0, u / x0, v / x0], 1.0) {
                None => out.failed += 1,
                Some(x) if found.iter().any(|y| alike(&x, y)) => out.jumped += 1,
                Some(x) => found.push(x),
            },
        }
    }
    (found, out)
}

enum End {
    Infinity,
    Failed,
    Point(Vector<5>),
}

fn follow(homotopy: &TotalDegree, start: Vector<5>, settings: &Settings, steps: &mut usize) -> End {
    let mut x = start;
    let mut t = 0.0;
    let mut logarithms = [0.0; PROBES.len()];
    for (logarithm, left) in logarithms.iter_mut().zip(PROBES) {
        match track(homotopy, x, t, 1.0 - left, settings, steps) {
            Some(point) => (x, t) = (point, 1.0 - left),
            None => return End::Failed,
        }
        *logarithm = 0.5 * (x[0].norm_sqr() / x.iter().fold(0.0, larger)).ln();
    }
    if (logarithms[0] - logarithms[1]) / (PROBES[0] / PROBES[1]).ln() > FALLING {
        return End::Infinity;
    }
    track(homotopy, x, t, 1.0, settings, steps).map_or(End::Failed, End::Point)
}

/// The solutions of a triad by the total degree of its equations.
pub fn solve_by_total_degree(problem: &Problem, seed: u64, settings: &Settings) -> Outcome {
    let (found, mut out) = solve_rows(&problem.rows, seed, settings);
    out.solutions = found.iter().map(|x| problem.solution(x)).collect();
    out
}
