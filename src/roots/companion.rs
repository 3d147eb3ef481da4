//! All complex roots at once: the eigenvalues of a balanced companion matrix.
//!
//! Exact zeros at either end of the coefficients are split off first, as roots at zero and at infinity. The variable is scaled by a
//! power of two, the companion matrix balanced, its eigenvalues taken and each polished on the polynomial itself. The eigenvalue
//! routine does not say when it fails, so its answer is checked: count, finiteness, the backward error of each root, and whether the
//! roots together reproduce the polynomial. Where a check fails, Aberth's simultaneous iteration answers instead.
//!
//! Sources: Parlett, Reinsch (1969), Numer. Math. 13, 293-304, doi:10.1007/BF02165404 (balancing); Edelman, Murakami (1995), Math.
//! Comp. 64, 763-776, doi:10.1090/S0025-5718-1995-1262279-2 (backward error); Bini (1996), Numer. Algorithms 13, 179-200,
//! doi:10.1007/BF02207694 (Aberth's method and its starting points).

use faer::Mat;
use num_complex::Complex64;
use thiserror::Error;

/// The roots of a polynomial, those at infinity counted.
#[derive(Clone, Debug, PartialEq)]
pub struct PolynomialRoots {
    /// The finite roots, each as often as its multiplicity, in no particular order; exact zeros last.
    pub finite: Vec<Complex64>,
    /// How many coefficients at the top were exactly zero.
    pub at_infinity: usize,
}

/// Why a polynomial has no list of roots.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum RootsError {
    /// A coefficient is NaN or infinite.
    #[error("coefficient {power} must be finite, not {value}")]
    NotFinite {
        /// The power it belongs to.
        power: usize,
        /// What was found.
        value: Complex64,
    },
    /// Every coefficient is zero: everything is a root.
    #[error("the zero polynomial has every number as a root")]
    ZeroPolynomial,
    /// Neither eigenvalues nor Aberth's iteration brought every residual down to rounding.
    #[error("no convergence: worst relative residual {residual:e}")]
    NoConvergence {
        /// The worst `|p(z)| / sum |a_k z^k|`.
        residual: f64,
    },
}

/// A root counts as found when `|p(z)|` is below this many times `degree · eps · sum |a_k z^k|`: what Horner's rule can tell apart
/// from zero is about twice the degree; the rest is for eigenvalues of clusters, which polishing leaves alone.
const BACKWARD_ERROR_FACTOR: f64 = 64.0;

/// Roots that do not reproduce the coefficients to this accuracy, relative to those of `prod (|x| + |z|)`, may hold one root twice
/// and miss another, which shows as the distance of the two. Heuristic: Wilkinson's polynomials up to degree 15 pass, by a test.
const REPRODUCTION_TOLERANCE: f64 = 1e-6;

/// All complex roots.
///
/// **Shape:** coefficients ascend; degree is the length less one. **Accuracy:** each root has a backward error of a few roundings; a
/// simple root is accurate to that times its condition number, an `m`-fold one to about `eps^(1/m)`.
/// **Errors:** a coefficient that is not finite; the zero polynomial; no convergence. **Cost:** cubic in the degree.
///
/// ```
/// use assur::{num_complex::Complex64, roots::companion_roots};
/// let i = Complex64::I;
/// let roots = companion_roots(&[-i, 0.0.into(), 1.0.into()])?; // x² - i
/// assert!(roots.finite.iter().all(|z| (z * z - i).norm() < 1e-15));
/// # Ok::<(), assur::roots::RootsError>(())
/// ```
pub fn companion_roots(coefficients: &[Complex64]) -> Result<PolynomialRoots, RootsError> {
    let Core { coefficients, exponent, zeros, at_infinity } = Core::new(coefficients)?;
    let mut finite = solve_core(&coefficients, eigenvalues(&coefficients))?;
    rescale(&mut finite, exponent);
    finite.resize(finite.len() + zeros, Complex64::ZERO);
    Ok(PolynomialRoots { finite, at_infinity })
}

/// All complex roots of a polynomial with real coefficients: real ones exactly real, the others in exact conjugate pairs.
///
/// Everything else as for [`companion_roots`].
///
/// ```
/// use assur::roots::companion_roots_real;
/// let mut roots = companion_roots_real(&[-6.0, 11.0, -6.0, 1.0])?.finite; // 1, 2, 3
/// roots.sort_by(|a, b| a.re.total_cmp(&b.re));
/// assert!(roots.iter().zip([1.0, 2.0, 3.0]).all(|(z, x)| z.im == 0.0 && (z.re - x).abs() < 1e-14));
/// # Ok::<(), assur::roots::RootsError>(())
/// ```
pub fn companion_roots_real(coefficients: &[f64]) -> Result<PolynomialRoots, RootsError> {
    let complex: Vec<Complex64> = coefficients.iter().map(|&c| c.into()).collect();
    let Core { coefficients, exponent, zeros, at_infinity } = Core::new(&complex)?;
    let mut finite = solve_core(&coefficients, eigenvalues_real(&coefficients))?;
    pair_conjugates(&mut finite);
    rescale(&mut finite, exponent);
    finite.resize(finite.len() + zeros, Complex64::ZERO);
    Ok(PolynomialRoots { finite, at_infinity })
}

/// A polynomial whose ends are not zero, in a variable scaled so that the geometric mean of its roots is about one.
struct Core {
    coefficients: Vec<Complex64>,
    /// `x = 2^exponent · y`.
    exponent: f64,
    zeros: usize,
    at_infinity: usize,
}

impl Core {
    fn new(given: &[Complex64]) -> Result<Self, RootsError> {
        if let Some((power, &value)) = given.iter().enumerate().find(|(_, c)| !c.is_finite()) {
            return Err(RootsError::NotFinite { power, value });
        }
        let nonzero = |c: &Complex64| *c != Complex64::ZERO;
        let (Some(low), Some(high)) = (given.iter().position(nonzero), given.iter().rposition(nonzero)) else {
            return Err(RootsError::ZeroPolynomial);
        };
        let core = &given[low..=high];
        let degree = core.len() - 1;
        let log_size = |c: &Complex64| modulus(*c).log2();
        let exponent =
            if degree == 0 { 0.0 } else { ((log_size(&core[0]) - log_size(&core[degree])) / degree as f64).round() };
        let logs: Vec<f64> = core.iter().enumerate().map(|(k, c)| log_size(c) + exponent * k as f64).collect();
        let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max).ceil();
        // Powers of two: exact, save where a coefficient underflows beside the largest.
        let coefficients =
            core.iter().enumerate().map(|(k, &c)| times_power_of_two(c, exponent * k as f64 - top)).collect();
        Ok(Self { coefficients, exponent, zeros: low, at_infinity: given.len() - 1 - high })
    }
}

/// `|z|` without overflow or underflow of the squares.
fn modulus(z: Complex64) -> f64 {
    z.re.hypot(z.im)
}

fn times_power_of_two(z: Complex64, exponent: f64) -> Complex64 {
    // Three factors reach from one end of the range of f64 to the other without leaving it between.
    let third = (exponent / 3.0).trunc();
    z * third.exp2() * third.exp2() * (exponent - 2.0 * third).exp2()
}

fn rescale(roots: &mut [Complex64], exponent: f64) {
    for root in roots {
        *root = times_power_of_two(*root, exponent);
    }
}

/// Polishes and checks the eigenvalues, and asks Aberth where a check fails.
fn solve_core(coefficients: &[Complex64], eigenvalues: Option<Vec<Complex64>>) -> Result<Vec<Complex64>, RootsError> {
    let degree = coefficients.len() - 1;
    let judged = |mut roots: Vec<Complex64>| {
        polish(coefficients, &mut roots);
        let quality = Quality::of(coefficients, &roots);
        (roots, quality)
    };
    let usable = |roots: &Vec<Complex64>| roots.len() == degree && roots.iter().all(|z| z.is_finite());
    let first = eigenvalues.filter(usable).map(judged);
    if let Some((roots, quality)) = &first
        && quality.passes(degree)
    {
        return Ok(roots.clone());
    }
    let second = Some(aberth(coefficients)).filter(usable).map(judged);
    let candidates = [first, second].into_iter().flatten();
    let best = candidates.min_by(|(_, a), (_, b)| {
        (a.converged(degree), a.reproduction)
            .partial_cmp(&(b.converged(degree), b.reproduction))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    match best {
        Some((roots, quality)) if quality.converged(degree) == Converged::Yes => Ok(roots),
        Some((_, quality)) => Err(RootsError::NoConvergence { residual: quality.residual }),
        None => Err(RootsError::NoConvergence { residual: f64::INFINITY }),
    }
}

#[derive(PartialEq, PartialOrd)]
enum Converged {
    Yes,
    No,
}

/// How well numbers serve as the roots of a polynomial.
struct Quality {
    /// Worst `|p(z)| / sum |a_k z^k|`.
    residual: f64,
    /// Worst difference between the coefficients and those of the product of linear factors, relative to those of `prod (|x| + |z|)`.
    reproduction: f64,
}

impl Quality {
    fn of(coefficients: &[Complex64], roots: &[Complex64]) -> Self {
        let residual = roots.iter().map(|&z| Horner::at(coefficients, z).relative_residual()).fold(0.0, f64::max);
        // Multiplying small roots in first keeps the partial products in range.
        let mut sorted = roots.to_vec();
        sorted.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        let lead = coefficients[coefficients.len() - 1];
        let mut product = vec![Complex64::ONE];
        let mut sizes = vec![1.0];
        for z in sorted {
            product.push(Complex64::ZERO);
            sizes.push(0.0);
            for k in (0..product.len()).rev() {
                let (below, below_size) = if k > 0 { (product[k - 1], sizes[k - 1]) } else { (Complex64::ZERO, 0.0) };
                product[k] = below - z * product[k];
                sizes[k] = below_size + z.norm() * sizes[k];
            }
        }
        let error = |((p, s), a): ((&Complex64, &f64), &Complex64)| (p * lead - a).norm() / (s * lead.norm());
        let reproduction = product.iter().zip(&sizes).zip(coefficients).map(error).fold(0.0, f64::max);
        Self { residual, reproduction }
    }

    fn converged(&self, degree: usize) -> Converged {
        let limit = BACKWARD_ERROR_FACTOR * degree as f64 * f64::EPSILON;
        if self.residual <= limit { Converged::Yes } else { Converged::No }
    }

    fn passes(&self, degree: usize) -> bool {
        self.converged(degree) == Converged::Yes && self.reproduction <= REPRODUCTION_TOLERANCE
    }
}

/// A polynomial's value, its derivative and the sum of the sizes of its terms, all divided by one power of `z` where `|z| > 1`.
struct Horner {
    /// `p(z)` or `p(z)/z^n`.
    value: Complex64,
    /// Sum of the sizes of the terms, divided likewise.
    size: f64,
    /// Newton's correction `p(z)/p'(z)`; not finite at a critical point.
    newton: Complex64,
}

impl Horner {
    fn at(coefficients: &[Complex64], z: Complex64) -> Self {
        let run = |terms: &mut dyn Iterator<Item = &Complex64>, x: Complex64| {
            let size = x.norm();
            terms.fold((Complex64::ZERO, Complex64::ZERO, 0.0), |(p, d, s), a| {
                (p * x + a, d * x + p, s * size + a.norm())
            })
        };
        if z.norm() <= 1.0 {
            let (value, derivative, size) = run(&mut coefficients.iter().rev(), z);
            return Self { value, size, newton: value / derivative };
        }
        // q(y) = y^n p(1/y): p/p' at z = 1/y is q / (y·(n q - y q')).
        let y = z.inv();
        let (value, derivative, size) = run(&mut coefficients.iter(), y);
        let degree = (coefficients.len() - 1) as f64;
        Self { value, size, newton: value / (y * (value * degree - y * derivative)) }
    }

    fn relative_residual(&self) -> f64 {
        if self.value == Complex64::ZERO { 0.0 } else { self.value.norm() / self.size }
    }
}

/// A few steps of Aberth's iteration on each root; a step is taken only if it lowers the residual, and never goes half-way to another root.
fn polish(coefficients: &[Complex64], roots: &mut [Complex64]) {
    const STEPS: usize = 3;
    for _ in 0..STEPS {
        for k in 0..roots.len() {
            let z = roots[k];
            let here = Horner::at(coefficients, z);
            let step = aberth_step(&here, roots, k);
            let others = roots.iter().enumerate().filter(|&(j, _)| j != k);
            let room = others.map(|(_, other)| (other - z).norm()).fold(f64::INFINITY, f64::min) / 2.0;
            if step.is_finite() && step.norm() < room {
                let there = Horner::at(coefficients, z - step);
                if there.relative_residual() < here.relative_residual() {
                    roots[k] = z - step;
                }
            }
        }
    }
}

/// Newton's correction with the other roots divided out.
fn aberth_step(here: &Horner, roots: &[Complex64], k: usize) -> Complex64 {
    if here.value == Complex64::ZERO {
        return Complex64::ZERO;
    }
    let apart = roots.iter().filter(|&&other| other != roots[k]).map(|other| (roots[k] - other).inv());
    let repulsion: Complex64 = apart.sum();
    if here.newton.is_finite() { here.newton / (Complex64::ONE - here.newton * repulsion) } else { -repulsion.inv() }
}

/// Aberth's simultaneous iteration from Bini's starting points.
fn aberth(coefficients: &[Complex64]) -> Vec<Complex64> {
    /// Roots that lie apart settle in few; clusters converge linearly and may need many (heuristic).
    const SWEEPS: usize = 200;
    let mut roots = starting_points(coefficients);
    for _ in 0..SWEEPS {
        let mut moved = false;
        for k in 0..roots.len() {
            let here = Horner::at(coefficients, roots[k]);
            let step = aberth_step(&here, &roots, k);
            let rounding = 2.0 * coefficients.len() as f64 * f64::EPSILON;
            if here.relative_residual() > rounding && step.is_finite() && step.norm() > f64::EPSILON * roots[k].norm() {
                roots[k] -= step;
                moved = true;
            }
        }
        if !moved {
            break;
        }
    }
    roots
}

/// Circles whose radii are the slopes of the upper hull of `(k, log |a_k|)`, with as many points as the edge is long.
fn starting_points(coefficients: &[Complex64]) -> Vec<Complex64> {
    let points: Vec<(f64, f64)> = (coefficients.iter().enumerate())
        .filter(|(_, c)| **c != Complex64::ZERO)
        .map(|(k, c)| (k as f64, modulus(*c).ln()))
        .collect();
    let mut hull: Vec<(f64, f64)> = Vec::new();
    for p in points {
        while let [.., a, b] = hull[..]
            && (b.1 - a.1) * (p.0 - a.0) <= (p.1 - a.1) * (b.0 - a.0)
        {
            hull.pop();
        }
        hull.push(p);
    }
    let mut roots = Vec::new();
    for edge in hull.windows(2) {
        let length = edge[1].0 - edge[0].0;
        let radius = ((edge[0].1 - edge[1].1) / length).exp();
        for j in 0..length as usize {
            // An offset without symmetry: points symmetric to the real axis would stay so.
            let angle = std::f64::consts::TAU * j as f64 / length + 0.7 + edge[0].0;
            roots.push(Complex64::from_polar(radius, angle));
        }
    }
    roots
}

/// The companion matrix: ones below the diagonal, `-a_k / a_n` in the last column.
fn companion<T: Copy>(coefficients: &[T], zero: T, one: T, over_lead: impl Fn(T) -> T) -> Vec<Vec<T>> {
    let degree = coefficients.len() - 1;
    let mut rows = vec![vec![zero; degree]; degree];
    for k in 0..degree {
        if k > 0 {
            rows[k][k - 1] = one;
        }
        rows[k][degree - 1] = over_lead(coefficients[k]);
    }
    rows
}

fn eigenvalues(coefficients: &[Complex64]) -> Option<Vec<Complex64>> {
    let lead = coefficients[coefficients.len() - 1];
    let mut rows = companion(coefficients, Complex64::ZERO, Complex64::ONE, |a| -a / lead);
    balance(&mut rows, |z| modulus(*z), |z, f| z * f);
    if rows.iter().flatten().any(|z| !z.is_finite()) {
        return None;
    }
    Mat::from_fn(rows.len(), rows.len(), |i, j| rows[i][j]).eigenvalues().ok()
}

fn eigenvalues_real(coefficients: &[Complex64]) -> Option<Vec<Complex64>> {
    let real: Vec<f64> = coefficients.iter().map(|c| c.re).collect();
    let lead = real[real.len() - 1];
    let mut rows = companion(&real, 0.0, 1.0, |a| -a / lead);
    balance(&mut rows, |x| x.abs(), |x, f| x * f);
    if rows.iter().flatten().any(|x| !x.is_finite()) {
        return None;
    }
    Mat::from_fn(rows.len(), rows.len(), |i, j| rows[i][j]).eigenvalues().ok()
}

/// Balancing by powers of two: a diagonal similarity after which each row is about as large as its column. Exact.
fn balance<T: Copy>(rows: &mut [Vec<T>], size: impl Fn(&T) -> f64, scaled: impl Fn(T, f64) -> T) {
    /// An end for matrices that keep creeping (heuristic).
    const SWEEPS: usize = 100;
    for _ in 0..SWEEPS {
        let changed = (0..rows.len()).filter(|&k| balance_one(rows, k, &size, &scaled)).count();
        if changed == 0 {
            break;
        }
    }
}

/// Balances one row against its column; whether that was worth doing.
fn balance_one<T: Copy>(
    rows: &mut [Vec<T>],
    k: usize,
    size: &impl Fn(&T) -> f64,
    scaled: &impl Fn(T, f64) -> T,
) -> bool {
    /// Parlett and Reinsch's: a scaling must lower the sum of both norms by a twentieth to be worth it.
    const WORTH: f64 = 0.95;
    let off_diagonal = (0..rows.len()).filter(|&j| j != k);
    let (column, row) = off_diagonal.fold((0.0, 0.0), |(c, r), j| (c + size(&rows[j][k]), r + size(&rows[k][j])));
    if column == 0.0 || row == 0.0 {
        return false;
    }
    let factor = ((row / column).log2() / 2.0).round().exp2();
    if column * factor + row / factor >= WORTH * (column + row) {
        return false;
    }
    for entry in &mut rows[k] {
        *entry = scaled(*entry, 1.0 / factor);
    }
    for row in rows {
        row[k] = scaled(row[k], factor);
    }
    true
}

/// Makes numbers that are nearly closed under conjugation exactly so.
fn pair_conjugates(roots: &mut [Complex64]) {
    let mut done = vec![false; roots.len()];
    for k in 0..roots.len() {
        if done[k] {
            continue;
        }
        let mirror = roots[k].conj();
        let open = (k..roots.len()).filter(|&j| !done[j]);
        let partner = open.min_by(|&i, &j| (roots[i] - mirror).norm().total_cmp(&(roots[j] - mirror).norm()));
        let Some(partner) = partner.filter(|&j| j != k) else {
            roots[k].im = 0.0;
            done[k] = true;
            continue;
        };
        // Two real roots next to each other are each other's nearest mirror only if both are off the axis.
        if roots[k].im == 0.0 {
            done[k] = true;
            continue;
        }
        let mean = (roots[k] + roots[partner].conj()) / 2.0;
        (roots[k], roots[partner]) = (mean, mean.conj());
        (done[k], done[partner]) = (true, true);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn c(re: f64, im: f64) -> Complex64 {
        Complex64::new(re, im)
    }

    fn from_roots(roots: &[Complex64]) -> Vec<Complex64> {
        let mut p = vec![Complex64::ONE];
        for z in roots {
            p.push(Complex64::ZERO);
            for k in (0..p.len()).rev() {
                p[k] = (if k > 0 { p[k - 1] } else { Complex64::ZERO }) - z * p[k];
            }
        }
        p
    }

    /// The worst relative distance after pairing each planted root with the nearest found one, each used once.
    fn distance(planted: &[Complex64], found: &[Complex64]) -> f64 {
        assert_eq!(planted.len(), found.len());
        let mut left = found.to_vec();
        let mut worst: f64 = 0.0;
        for z in planted {
            let nearest = (0..left.len()).min_by(|&i, &j| (left[i] - z).norm().total_cmp(&(left[j] - z).norm()));
            let nearest = left.swap_remove(nearest.unwrap());
            worst = worst.max((nearest - z).norm() / z.norm());
        }
        worst
    }

    #[test]
    fn low_degrees_zeros_and_infinity() {
        assert_eq!(companion_roots(&[c(3.0, 0.0)]).unwrap(), PolynomialRoots { finite: vec![], at_infinity: 0 });
        assert_eq!(companion_roots_real(&[2.0, 4.0]).unwrap().finite, [c(-0.5, 0.0)]);
        let found = companion_roots_real(&[0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0]).unwrap();
        assert_eq!(found.at_infinity, 2);
        assert_eq!(distance(&[c(1.0, 0.0), c(-1.0, 0.0)], &found.finite[..2]), 0.0);
        assert_eq!(found.finite[2..], [Complex64::ZERO; 2]);
    }

    #[test]
    fn what_has_no_roots_is_refused() {
        assert!(matches!(companion_roots_real(&[1.0, f64::NAN]), Err(RootsError::NotFinite { power: 1, .. })));
        assert!(matches!(companion_roots(&[c(0.0, f64::INFINITY)]), Err(RootsError::NotFinite { power: 0, .. })));
        assert_eq!(companion_roots_real(&[0.0, 0.0]), Err(RootsError::ZeroPolynomial));
        assert_eq!(companion_roots_real(&[]), Err(RootsError::ZeroPolynomial));
    }

    #[test]
    fn moderate_wilkinson() {
        for (degree, tolerance) in [(8, 1e-10), (12, 1e-7), (15, 1e-4)] {
            let planted: Vec<Complex64> = (1..=degree).map(|k| c(f64::from(k), 0.0)).collect();
            let real: Vec<f64> = from_roots(&planted).iter().map(|z| z.re).collect();
            let found = companion_roots_real(&real).unwrap().finite;
            assert!(found.iter().all(|z| z.im == 0.0));
            let error = distance(&planted, &found);
            assert!(error < tolerance, "degree {degree}: {error:e}");
            // The eigenvalues pass by themselves; Aberth is not asked.
            let core = Core::new(&from_roots(&planted)).unwrap();
            let mut own = eigenvalues_real(&core.coefficients).unwrap();
            polish(&core.coefficients, &mut own);
            let quality = Quality::of(&core.coefficients, &own);
            assert!(quality.passes(own.len()), "degree {degree}: {:e} {:e}", quality.residual, quality.reproduction);
        }
    }

    #[test]
    fn sizes_from_tiny_to_huge() {
        let planted: Vec<Complex64> = (-8..=8).step_by(2).map(|e| c(10f64.powi(e), 0.3 * 10f64.powi(e))).collect();
        assert!(distance(&planted, &companion_roots(&from_roots(&planted)).unwrap().finite) < 1e-13);
        let extreme = companion_roots_real(&[1e-300, 0.0, -1e300]).unwrap().finite;
        assert!(distance(&[c(1e-300, 0.0), c(-1e-300, 0.0)], &extreme) < 1e-15);
    }

    #[test]
    fn multiple_roots_stay_apart_and_counted() {
        let planted = [c(-1.0, 0.0), c(-1.0, 0.0), c(2.0, 1.0), c(2.0, 1.0), c(2.0, 1.0)];
        let found = companion_roots(&from_roots(&planted)).unwrap().finite;
        let error = distance(&planted, &found);
        assert!(error < 5e-5, "{error:e}");
        let found = companion_roots_real(&[1.0, 2.0, 1.0]).unwrap().finite;
        assert!(distance(&[c(-1.0, 0.0); 2], &found) < 1e-7);
    }

    #[test]
    fn aberth_agrees_with_the_eigenvalues() {
        let planted = [c(1e-5, 0.0), c(-3.0, 1.0), c(-3.0, -1.0), c(7e4, 2.0), c(0.0, 1.0)];
        let core = Core::new(&from_roots(&planted)).unwrap();
        let mut found = aberth(&core.coefficients);
        rescale(&mut found, core.exponent);
        assert!(distance(&planted, &found) < 1e-12);
    }

    #[test]
    fn a_doubled_root_in_place_of_another_does_not_pass() {
        let p = from_roots(&[c(1.0, 0.0), c(2.0, 0.0), c(3.0, 0.0)]);
        assert!(Quality::of(&p, &[c(1.0, 0.0), c(2.0, 0.0), c(3.0, 0.0)]).passes(3));
        assert!(!Quality::of(&p, &[c(1.0, 0.0), c(2.0, 0.0), c(2.0, 0.0)]).passes(3));
        // Such an answer is replaced.
        let found = solve_core(&p, Some(vec![c(1.0, 0.0), c(2.0, 0.0), c(2.0, 0.0)])).unwrap();
        assert!(distance(&[c(1.0, 0.0), c(2.0, 0.0), c(3.0, 0.0)], &found) < 1e-13);
    }

    #[test]
    fn balancing_evens_out_rows_and_columns() {
        let mut rows = vec![vec![1.0, 1e9], vec![1e-9, 2.0]];
        balance(&mut rows, |x: &f64| x.abs(), |x, f| x * f);
        assert!((rows[0][1] / rows[1][0]).log2().abs() <= 2.0);
        assert!((rows[0][1] * rows[1][0] - 1.0).abs() < 1e-15);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        #[test]
        fn planted_roots_come_back(planted in prop::collection::vec((-3.0..3.0f64, -3.1..3.1f64), 1..9)) {
            let planted: Vec<Complex64> = planted.into_iter().map(|(log, angle)| Complex64::from_polar(log.exp(), angle)).collect();
            let p = from_roots(&planted);
            let found = companion_roots(&p).unwrap().finite;
            for z in &planted {
                // First-order condition: the error of the coefficients over the distances to the other roots.
                let size: f64 = p.iter().enumerate().map(|(k, a)| a.norm() * z.norm().powi(k as i32)).sum();
                let others: Vec<f64> = planted.iter().map(|other| (z - other).norm()).filter(|&d| d > 0.0).collect();
                prop_assume!(others.len() + 1 == planted.len());
                let slope: f64 = others.iter().product();
                let gap = others.iter().copied().fold(z.norm(), f64::min);
                let error = found.iter().map(|w| (w - z).norm()).fold(f64::INFINITY, f64::min);
                let bound = 200.0 * f64::EPSILON * size / slope;
                prop_assume!(bound < 0.1 * gap);
                prop_assert!(error <= bound, "{error:e} {bound:e}");
            }
        }

        #[test]
        fn conjugate_pairs_are_exact(planted in prop::collection::vec((-3.0..3.0f64, 0.1..3.0f64), 1..4), real in -2.0..2.0f64) {
            let mut all = vec![c(real, 0.0)];
            all.extend(planted.iter().flat_map(|&(x, y)| [c(x, y), c(x, -y)]));
            let p: Vec<f64> = from_roots(&all).iter().map(|z| z.re).collect();
            let found = companion_roots_real(&p).unwrap().finite;
            prop_assert!(found.iter().all(|z| found.contains(&z.conj())));
            prop_assert_eq!(found.len(), all.len());
        }
    }
}
