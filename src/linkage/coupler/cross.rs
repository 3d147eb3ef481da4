//! Where a line or a circle crosses a coupler curve: a polynomial in one real parameter.
//!
//! A line is `z = p + t u`. On a circle, `z = z0 + i sigma m / (1 - i sigma / 2 rho)` with `m` the unit vector from the centre to `z0` and
//! `sigma` about the length of the arc from there: the larger the circle, the more a line. The one point that sigma misses, opposite `z0`, is laid
//! where the curve does not come. The equation is Hermitian, so its coefficients in the real parameter are real. In floating
//! point and near the origin that is quick and mostly enough; the exact polynomial over the rationals is the second opinion.

use nalgebra::Vector2;
use num_complex::Complex64;

use super::curve::{CouplerCurve, complex};
use super::equation::Biquadratic;
use super::search::Search;
use crate::algebra::{Gaussian, Rational, Ring, dyadic};
use crate::roots::{companion_roots, companion_roots_real};
use crate::solve::to_complex_together;

/// No point of a curve of size one is further from its first pivot: a crank and an arm.
const REACH: f64 = 2.0;
/// Where a small circle misses its point: an angle that no drawing has, in radians.
const MISSED: f64 = 2.0;
/// A root so close to the parameter of a point at infinity is that point's (heuristic: simple roots are good to some 1e-12).
const AT_INFINITY: f64 = 1e-8;

/// Two linear functions, constant first, whose quotient is an isotropic coordinate.
struct Fraction {
    over: [Complex64; 2],
    under: [Complex64; 2],
}

/// Starting points on a line, in coordinates near the origin.
pub(super) fn line_starts(search: &Search, point: &Vector2<f64>, direction: &Vector2<f64>) -> Vec<[Complex64; 2]> {
    let u = complex(&direction.normalize());
    let p = (complex(point) - search.shift) / search.size;
    // From the foot of the perpendicular, so that a point given far away costs nothing.
    let foot = Complex64::I * u * (p * u.conj()).im;
    starts(&search.equation(), &Fraction { over: [foot, u], under: [Complex64::ONE, Complex64::ZERO] })
}

/// Starting points on a circle, in coordinates near the origin.
pub(super) fn circle_starts(search: &Search, center: &Vector2<f64>, radius: f64) -> Vec<[Complex64; 2]> {
    let o = (complex(center) - search.shift) / search.size;
    let rho = radius / search.size;
    let far = o.norm();
    let large = far + rho > REACH && far > 0.0;
    // `z0` as the difference of two lengths keeps its digits where both are large.
    let (m, z0) = if large {
        let m = -o / far;
        (m, m * (rho - far))
    } else {
        let m = Complex64::from_polar(1.0, MISSED);
        (m, o + m * rho)
    };
    let bend = 0.5 / rho;
    let over = [z0, Complex64::I * (m / 2.0 - o * bend)];
    starts(&search.equation(), &Fraction { over, under: [Complex64::ONE, -Complex64::I * bend] })
}

/// The points of the curve with a real parameter `t`, `z = over / under`, and with complex ones.
fn starts(equation: &Biquadratic<Complex64>, z: &Fraction) -> Vec<[Complex64; 2]> {
    let conjugate = |[a, b]: [Complex64; 2]| [a.conj(), b.conj()];
    let w = Fraction { over: conjugate(z.over), under: conjugate(z.under) };
    let (of_z, of_w) = (homogeneous_powers(z), homogeneous_powers(&w));
    let mut sum = [0.0; 7];
    for (row, z) in equation.0.iter().zip(&of_z) {
        let mut inner = [Complex64::ZERO; 4];
        for (c, w) in row.iter().zip(&of_w) {
            inner.iter_mut().zip(w).for_each(|(sum, x)| *sum += c * x);
        }
        for (a, x) in z.iter().enumerate() {
            for (b, y) in inner.iter().enumerate() {
                // The imaginary parts cancel.
                sum[a + b] += (x * y).re;
            }
        }
    }
    let Ok(roots) = companion_roots_real(&sum) else { return Vec::new() };
    let at = |f: &Fraction, t: Complex64| {
        let under = f.under[0] + f.under[1] * t;
        (under.norm() > AT_INFINITY).then(|| (f.over[0] + f.over[1] * t) / under)
    };
    roots.finite.iter().filter_map(|&t| Some([at(z, t)?, at(&w, t)?])).collect()
}

/// `over^k under^(3-k)` for `k` from 0 to 3, as ascending coefficients.
fn homogeneous_powers(f: &Fraction) -> [[Complex64; 4]; 4] {
    std::array::from_fn(|k| {
        let mut product = [Complex64::ONE, Complex64::ZERO, Complex64::ZERO, Complex64::ZERO];
        for factor in 0..3 {
            let [a, b] = if factor < k { f.over } else { f.under };
            for i in (0..4).rev() {
                let below = if i > 0 { product[i - 1] } else { Complex64::ZERO };
                product[i] = product[i] * a + below * b;
            }
        }
        product
    })
}

/// The same from the polynomial over the rationals, in coordinates as given.
pub(super) fn line_starts_exactly(
    curve: &CouplerCurve,
    point: &Vector2<f64>,
    direction: &Vector2<f64>,
) -> Vec<[Complex64; 2]> {
    let [p, u] = [point, direction].map(exact);
    // z = p + u t, w = p' + u' t.
    let sum = along(curve, [p.clone(), u.clone()], [p.conj(), u.conj()], |_| 0);
    let (p, u) = (complex(point), complex(direction));
    roots_of(&sum).iter().map(|t| [p + u * t, p.conj() + u.conj() * t]).collect()
}

/// The same for a circle.
pub(super) fn circle_starts_exactly(curve: &CouplerCurve, center: &Vector2<f64>, radius: f64) -> Vec<[Complex64; 2]> {
    let (o, rho) = (exact(center), Gaussian::real(dyadic(radius).expect("finite, as checked")));
    // z = o + rho tau, w = o' + rho / tau; times tau^3.
    let sum = along(curve, [o.clone(), rho.clone()], [rho, o.conj()], |j| 3 - j);
    let o = complex(center);
    // A root of zero, which a common focus brings, would be a point at infinity.
    let roots = roots_of(&sum).into_iter().filter(|tau| *tau != Complex64::ZERO);
    roots.map(|tau| [o + tau * radius, o.conj() + radius / tau]).collect()
}

fn exact(v: &Vector2<f64>) -> Gaussian<Rational> {
    Gaussian::new(v.x, v.y).map(|&x| dyadic(x).expect("finite, as checked"))
}

/// The equation with `z` and `w` linear in one parameter; the power `j` of `w` is moved up by `shift(j)`.
fn along(
    curve: &CouplerCurve,
    z: [Gaussian<Rational>; 2],
    w: [Gaussian<Rational>; 2],
    shift: impl Fn(usize) -> usize,
) -> Vec<Gaussian<Rational>> {
    let mut sum = vec![Gaussian::zero(); 7];
    let (of_z, of_w) = (powers(z), powers(w));
    for (row, z) in curve.equation().0.iter().zip(&of_z) {
        for (j, (c, w)) in row.iter().zip(&of_w).enumerate().filter(|(_, (c, _))| **c != Gaussian::zero()) {
            for (a, x) in z.iter().enumerate() {
                for (b, y) in w.iter().enumerate() {
                    let place = &mut sum[a + b + shift(j)];
                    *place = place.clone() + c.clone() * x.clone() * y.clone();
                }
            }
        }
    }
    sum
}

/// The powers 0 to 3 of `constant + linear t`, as ascending coefficients.
fn powers([constant, linear]: [Gaussian<Rational>; 2]) -> [Vec<Gaussian<Rational>>; 4] {
    let mut power = vec![Gaussian::one()];
    std::array::from_fn(|k| {
        if k > 0 {
            let mut next = vec![Gaussian::zero(); power.len() + 1];
            for (i, c) in power.iter().enumerate() {
                next[i] = next[i].clone() + c.clone() * constant.clone();
                next[i + 1] = next[i + 1].clone() + c.clone() * linear.clone();
            }
            power = next;
        }
        power.clone()
    })
}

fn roots_of(coefficients: &[Gaussian<Rational>]) -> Vec<Complex64> {
    companion_roots(&to_complex_together(coefficients)).map_or(Vec::new(), |roots| roots.finite)
}
