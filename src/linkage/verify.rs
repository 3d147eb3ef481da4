//! Is a claimed pose an assembly? Measured on the geometry, apart from the algebra that found it.
//!
//! The platform is placed, each leg's joints are placed, and the closure error of every leg is measured as a length. All in
//! the frame of the reference leg, in units of the group's size, so that a far origin adds no noise.

use num_complex::Complex64;

use super::triad::LegNumbers;
use crate::algebra::Gaussian;

/// A rotation and the place of the reference leg's platform point, seen from its base point; units as in the legs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    /// `e^(i phi)`, of modulus 1.
    pub rotation: Complex64,
    /// Where the reference leg's platform point is.
    pub u: Complex64,
}

fn complex(g: &Gaussian<f64>) -> Complex64 {
    Complex64::new(g.re, g.im)
}

fn cross(a: Complex64, b: Complex64) -> f64 {
    a.re * b.im - a.im * b.re
}

fn dot(a: Complex64, b: Complex64) -> f64 {
    a.re * b.re + a.im * b.im
}

/// The closure error of one leg, a length.
fn closure_error(leg: &LegNumbers<f64>, at: Placement) -> f64 {
    match leg {
        LegNumbers::Circle { alpha, beta, length } => {
            let joint = at.u + at.rotation * complex(beta);
            ((joint - complex(alpha)).norm() - length).abs()
        }
        LegNumbers::Line { alpha, beta, normal } => {
            let joint = at.u + at.rotation * complex(beta);
            dot(complex(normal), joint - complex(alpha)).abs()
        }
        LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
            let on_line = at.u + at.rotation * complex(beta);
            (dot(at.rotation * complex(normal), complex(alpha) - on_line) - delta).abs()
        }
    }
}

/// The largest closure error of the legs.
pub(super) fn residual(legs: &[LegNumbers<f64>], at: Placement) -> f64 {
    legs.iter().map(|leg| closure_error(leg, at)).fold(0.0, f64::max)
}

/// The wrench of one leg: the unit force it can exert on the platform, with its moment about the reference base point.
///
/// A leg of length zero exerts no force of its own direction: its wrench is zero, and so is the determinant.
fn wrench(leg: &LegNumbers<f64>, at: Placement) -> [f64; 3] {
    let (force, point) = match leg {
        LegNumbers::Circle { alpha, beta, length } => {
            let joint = at.u + at.rotation * complex(beta);
            let along = joint - complex(alpha);
            let distance = along.norm();
            // What rounding leaves of a length of zero points anywhere; of a length below rounding it may leave nothing.
            (if *length > 0.0 && distance > 0.0 { along / distance } else { Complex64::ZERO }, joint)
        }
        LegNumbers::Line { beta, normal, .. } => (complex(normal), at.u + at.rotation * complex(beta)),
        LegNumbers::PlatformLine { alpha, normal, .. } => (at.rotation * complex(normal), complex(alpha)),
    };
    [force.re, force.im, cross(point, force)]
}

/// det A: the determinant of the three leg wrenches, unit forces and moments in units of the legs' lengths.
///
/// Fewer than three legs leave a pure moment for each PP leg that restrains the rotation instead.
pub(super) fn determinant(legs: &[LegNumbers<f64>], at: Placement) -> f64 {
    let mut rows: Vec<[f64; 3]> = legs.iter().map(|leg| wrench(leg, at)).collect();
    rows.resize(3, [0.0, 0.0, 1.0]);
    let [a, b, c] = [rows[0], rows[1], rows[2]];
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// det A of a platform pinned at the reference point: the moment of the other leg's unit force about the pin.
///
/// Without another leg, the moment that holds the orientation.
pub(super) fn pinned_determinant(legs: &[LegNumbers<f64>], at: Placement) -> f64 {
    legs.get(1).map_or(1.0, |leg| wrench(leg, at)[2])
}

/// The largest length among the legs: distances of base points, of platform points, leg lengths and offsets.
#[inline(always)]
pub(super) fn size(legs: &[LegNumbers<f64>]) -> f64 {
    let points = |leg: &LegNumbers<f64>| match *leg {
        LegNumbers::Circle { alpha, beta, .. }
        | LegNumbers::Line { alpha, beta, .. }
        | LegNumbers::PlatformLine { alpha, beta, .. } => (alpha, beta),
    };
    let (mut apart, mut own) = (0.0f64, 0.0f64);
    for (i, leg) in legs.iter().enumerate() {
        let (alpha, beta) = points(leg);
        for other in &legs[..i] {
            let (alpha2, beta2) = points(other);
            apart = apart.max((alpha - alpha2).norm_sqr()).max((beta - beta2).norm_sqr());
        }
        own = own.max(match *leg {
            LegNumbers::Circle { length, .. } => length,
            LegNumbers::Line { .. } => 0.0,
            LegNumbers::PlatformLine { delta, .. } => delta.abs(),
        });
    }
    own.max(apart.sqrt())
}

/// How badly a complex solution `(theta, U, V)` misses the closure equations, relative to the size of their terms.
pub(super) fn complex_residual(legs: &[LegNumbers<f64>], theta: Complex64, u: Complex64, v: Complex64) -> f64 {
    let inverse = theta.inv();
    let relative = |terms: &[Complex64]| {
        let sum: Complex64 = terms.iter().sum();
        let size: f64 = terms.iter().map(|t| t.norm()).sum();
        // The unit of length is about the group's size: where all terms should vanish, what rounding leaves of them is nothing.
        sum.norm() / (size + 1.0)
    };
    legs.iter()
        .map(|leg| match leg {
            LegNumbers::Circle { alpha, beta, length } => {
                let (alpha, beta) = (complex(alpha), complex(beta));
                let (p, q) = (u + theta * beta - alpha, v + inverse * beta.conj() - alpha.conj());
                // The factors themselves come out of cancelling terms, so their sizes count before cancelling.
                let size = (u.norm() + (theta * beta).norm() + alpha.norm())
                    * (v.norm() + (inverse * beta).norm() + alpha.norm());
                // On an isotropic line of a zero-length leg one factor vanishes.
                (p * q - length * length).norm() / (size + 1.0)
            }
            LegNumbers::Line { alpha, beta, normal } => {
                let (alpha, beta, n) = (complex(alpha), complex(beta), complex(normal));
                relative(&[
                    n.conj() * u,
                    n.conj() * theta * beta,
                    -n.conj() * alpha,
                    n * v,
                    n * inverse * beta.conj(),
                    -n * alpha.conj(),
                ])
            }
            LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
                let (alpha, beta, m) = (complex(alpha), complex(beta), complex(normal));
                let (up, down) = (theta * m, inverse * m.conj());
                relative(&[
                    down * alpha,
                    -down * u,
                    -m.conj() * beta,
                    up * alpha.conj(),
                    -up * v,
                    -m * beta.conj(),
                    Complex64::from(-2.0 * delta),
                ])
            }
        })
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> [LegNumbers<f64>; 3] {
        let point = |x: f64, y: f64| Gaussian::new(x, y);
        let leg = |p: Gaussian<f64>, length| LegNumbers::Circle { alpha: p, beta: p, length };
        [leg(point(0.0, 0.0), 1.0), leg(point(1.0, 0.0), 1.0), leg(point(0.0, 1.0), 1.0)]
    }

    #[test]
    fn a_planted_assembly_closes_and_a_moved_one_does_not() {
        let at = Placement { rotation: Complex64::ONE, u: Complex64::I };
        assert_eq!(residual(&square(), at), 0.0);
        assert!(complex_residual(&square(), Complex64::ONE, Complex64::I, -Complex64::I) < 1e-16);
        let off = Placement { u: Complex64::new(0.0, 1.01), ..at };
        assert!((residual(&square(), off) - 0.01).abs() < 1e-15);
    }

    #[test]
    fn parallel_legs_are_singular() {
        let at = Placement { rotation: Complex64::ONE, u: Complex64::I };
        assert_eq!(determinant(&square(), at), 0.0);
    }

    #[test]
    fn a_leg_of_length_zero_exerts_no_force_even_off_its_place() {
        let [first, second, third] = square();
        let LegNumbers::Circle { alpha, beta, .. } = first else { panic!("an RR leg") };
        let point = LegNumbers::Circle { alpha, beta, length: 0.0 };
        let at = Placement { rotation: Complex64::ONE, u: Complex64::new(1e-49, 0.0) };
        assert_eq!(determinant(&[point, second, third], at), 0.0);
    }

    #[test]
    fn what_rounding_leaves_of_a_point_on_its_line_is_no_error() {
        let point = || Gaussian::new(0.0, 0.0);
        let line = LegNumbers::Line { alpha: point(), beta: point(), normal: Gaussian::new(0.6, 0.8) };
        let (u, v) = (Complex64::new(3e-50, 0.0), Complex64::new(0.0, 1e-50));
        assert!(complex_residual(&[line], Complex64::new(2.0, 2.0), u, v) < 1e-40);
    }

    #[test]
    fn size_is_the_largest_length() {
        assert!((size(&square()) - 2f64.sqrt()).abs() < 1e-15);
    }
}
