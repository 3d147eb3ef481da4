//! A triad's numbers as integers.
//!
//! Every finite `f64` is `m·2^e`. Multiplying all lengths by one power of two, and each direction by its own, makes them
//! integers without changing where the triad can be assembled: `T` is homogeneous. Differences of points are taken
//! after that, so a far origin costs digits of nothing. The one number that need not be dyadic is `delta = d·|v|` of an RP
//! leg given by its distance; it is exact where `|v|²` is a square or `d = 0`, and rounded to `f64` otherwise.

use dashu_int::UBig;
use dashu_int::ops::{BitTest, SquareRootRem};
use nalgebra::Vector2;

use super::group::{Dyad, Offset};
use super::triad::LegNumbers;
use crate::algebra::{Gaussian, Integer, Rational, dyadic, ratio_to_f64};

/// The legs of a group that are not PP, as integers, reference leg first.
#[derive(Clone, Debug)]
pub(super) struct TriadNumbers {
    /// Numbers of the legs in the order of `order`.
    pub legs: Vec<LegNumbers<Integer>>,
    /// Which leg of the triad each is, from 0.
    pub order: Vec<usize>,
    /// Lengths are multiplied by `2^length_shift`.
    pub length_shift: i64,
}

impl TriadNumbers {
    /// The integers of a group's legs; the RR leg with the smallest length is the reference, or else the first leg that is not PP.
    pub fn of(legs: &[Dyad]) -> Self {
        let mut order: Vec<usize> = (0..legs.len()).filter(|&i| !matches!(legs[i], Dyad::PP { .. })).collect();
        let reference = order.iter().copied().filter_map(|i| match legs[i] {
            Dyad::RR { length, .. } => Some((length, i)),
            _ => None,
        });
        if let Some((_, reference)) = reference.min_by(|a, b| a.0.total_cmp(&b.0)) {
            order.retain(|&i| i != reference);
            order.insert(0, reference);
        }
        let exact: Vec<ExactLeg> = order.iter().map(|&i| ExactLeg::of(&legs[i])).collect();
        let length_shift = exact.iter().map(ExactLeg::length_shift).max().unwrap_or(0);
        let (a0, b0) = match exact.first() {
            Some(leg) => (leg.a.clone(), leg.b.clone()),
            None => Default::default(),
        };
        let legs = exact.iter().map(|leg| leg.numbers(&a0, &b0, length_shift)).collect();
        Self { legs, order, length_shift }
    }
}

/// A point with rational coordinates.
type ExactPoint = [Rational; 2];

/// A leg with its numbers exact.
struct ExactLeg {
    a: ExactPoint,
    b: ExactPoint,
    kind: ExactKind,
}

enum ExactKind {
    Circle { length: Rational },
    Line { normal: ExactPoint },
    PlatformLine { normal: ExactPoint, delta: Rational },
}

impl ExactLeg {
    fn of(leg: &Dyad) -> Self {
        match leg {
            Dyad::RR { a, b, length } => {
                Self { a: point(a), b: point(b), kind: ExactKind::Circle { length: number(*length) } }
            }
            Dyad::PR { a, u, b } => Self { a: point(a), b: point(b), kind: ExactKind::Line { normal: left_of(u) } },
            Dyad::RP { a, b, v, offset } => {
                let kind = ExactKind::PlatformLine { normal: left_of(v), delta: exact_delta(*offset, v) };
                Self { a: point(a), b: point(b), kind }
            }
            Dyad::PP { .. } => unreachable!("PP legs are set apart before their numbers are asked for"),
        }
    }

    /// The power of two that makes this leg's lengths integers.
    fn length_shift(&self) -> i64 {
        let points = self.a.iter().chain(&self.b).map(denominator_exponent);
        let own = match &self.kind {
            ExactKind::Circle { length } => denominator_exponent(length),
            ExactKind::Line { .. } => 0,
            // delta is a length times the normal, which has a scale of its own.
            ExactKind::PlatformLine { normal, delta } => denominator_exponent(delta) - direction_shift(normal),
        };
        points.max().unwrap_or(0).max(own)
    }

    fn numbers(&self, a0: &ExactPoint, b0: &ExactPoint, shift: i64) -> LegNumbers<Integer> {
        let less = |p: &ExactPoint, q: &ExactPoint| [&p[0] - &q[0], &p[1] - &q[1]];
        let alpha = integers(&less(&self.a, a0), shift);
        let beta = integers(&less(&self.b, b0), shift);
        match &self.kind {
            ExactKind::Circle { length } => LegNumbers::Circle { alpha, beta, length: integer(length, shift) },
            ExactKind::Line { normal } => {
                LegNumbers::Line { alpha, beta, normal: integers(normal, direction_shift(normal)) }
            }
            ExactKind::PlatformLine { normal, delta } => {
                let own = direction_shift(normal);
                LegNumbers::PlatformLine {
                    alpha,
                    beta,
                    normal: integers(normal, own),
                    delta: integer(delta, shift + own),
                }
            }
        }
    }
}

/// `delta = d·|v|`, exact where it is rational, else the nearest `f64` to the product.
fn exact_delta(offset: Offset, v: &Vector2<f64>) -> Rational {
    match offset {
        Offset::TimesDirection(delta) => number(delta),
        Offset::Distance(0.0) => Rational::ZERO,
        Offset::Distance(d) => {
            let [x, y] = point(v);
            match rational_root(&(&x * &x + &y * &y)) {
                Some(length) => number(d) * length,
                None => number_or_product(d, v),
            }
        }
    }
}

/// Whether a leg's `delta = d·|v|` had to be rounded.
pub(super) fn has_rounded_offset(legs: &[Dyad]) -> bool {
    legs.iter().any(|leg| match leg {
        Dyad::RP { v, offset: Offset::Distance(d), .. } if *d != 0.0 => {
            let [x, y] = point(v);
            rational_root(&(&x * &x + &y * &y)).is_none()
        }
        _ => false,
    })
}

/// `d·|v|` rounded to `f64`; as a rational where that overflows.
fn number_or_product(d: f64, v: &Vector2<f64>) -> Rational {
    let length = v.x.hypot(v.y);
    dyadic(d * length)
        .or_else(|| dyadic(length).map(|l| number(d) * l))
        .unwrap_or_else(|| number(d) * number(v.x.abs().max(v.y.abs())))
}

/// The square root of a rational that is a square.
fn rational_root(square: &Rational) -> Option<Rational> {
    let root = |n: &UBig| {
        let (root, rest) = n.sqrt_rem();
        rest.is_zero().then_some(root)
    };
    let (numerator, denominator) = (UBig::try_from(square.numerator().clone()).ok()?, square.denominator().clone());
    Some(Rational::from_parts(root(&numerator)?.into(), root(&denominator)?))
}

/// `i·u`, exactly.
fn left_of(u: &Vector2<f64>) -> ExactPoint {
    [number(-u.y), number(u.x)]
}

fn point(p: &Vector2<f64>) -> ExactPoint {
    [number(p.x), number(p.y)]
}

fn number(x: f64) -> Rational {
    dyadic(x).expect("a triad's numbers are finite")
}

fn direction_shift(normal: &ExactPoint) -> i64 {
    normal.iter().map(denominator_exponent).max().unwrap_or(0)
}

/// `k` with the denominator `2^k`.
fn denominator_exponent(x: &Rational) -> i64 {
    x.denominator().bit_len() as i64 - 1
}

/// `x·2^shift`, an integer.
fn integer(x: &Rational, shift: i64) -> Integer {
    let shift = shift - denominator_exponent(x);
    debug_assert!(shift >= 0, "the shift was chosen from the largest denominator");
    x.numerator().clone() << shift.max(0) as usize
}

fn integers(p: &ExactPoint, shift: i64) -> Gaussian<Integer> {
    Gaussian::new(integer(&p[0], shift), integer(&p[1], shift))
}

/// The same legs in `f64`, in units of `2^unit` so that the largest length is about 1, and with normals of length 1.
///
/// Differences of points are taken exactly before rounding; nothing overflows however large the numbers are.
#[derive(Clone, Debug)]
pub(super) struct LocalLegs {
    /// The legs, reference leg first; `delta` is a distance, since normals have length 1.
    pub legs: Vec<LegNumbers<f64>>,
    /// Binary exponent of the unit of length.
    pub unit: i64,
}

impl LocalLegs {
    /// The legs of `numbers`, rounded.
    pub fn of(numbers: &TriadNumbers) -> Self {
        let point_bits = |g: &Gaussian<Integer>| g.re.bit_len().max(g.im.bit_len()) as i64;
        let largest = |leg: &LegNumbers<Integer>| match leg {
            LegNumbers::Circle { alpha, beta, length } => {
                point_bits(alpha).max(point_bits(beta)).max(length.bit_len() as i64)
            }
            LegNumbers::Line { alpha, beta, .. } => point_bits(alpha).max(point_bits(beta)),
            LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
                let distance = delta.bit_len() as i64 - point_bits(normal) + 1;
                point_bits(alpha).max(point_bits(beta)).max(distance)
            }
        };
        let bits = numbers.legs.iter().map(largest).max().unwrap_or(0);
        let length = |x: &Integer| ratio_to_f64(x, &Integer::ONE, -bits);
        let legs = numbers.legs.iter().map(|leg| match leg {
            LegNumbers::Circle { alpha, beta, length: l } => {
                LegNumbers::Circle { alpha: alpha.map(length), beta: beta.map(length), length: length(l) }
            }
            LegNumbers::Line { alpha, beta, normal } => {
                LegNumbers::Line { alpha: alpha.map(length), beta: beta.map(length), normal: unit_vector(normal).0 }
            }
            LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
                let (unit_normal, size, exponent) = unit_vector(normal);
                let delta = ratio_to_f64(delta, &Integer::ONE, -bits - exponent) / size;
                LegNumbers::PlatformLine {
                    alpha: alpha.map(length),
                    beta: beta.map(length),
                    normal: unit_normal,
                    delta,
                }
            }
        });
        Self { legs: legs.collect(), unit: bits - numbers.length_shift }
    }
}

/// A vector of length 1 along `normal`, and `(m, e)` with the length `m·2^e`.
fn unit_vector(normal: &Gaussian<Integer>) -> (Gaussian<f64>, f64, i64) {
    let exponent = normal.re.bit_len().max(normal.im.bit_len()) as i64;
    let rounded = normal.map(|x| ratio_to_f64(x, &Integer::ONE, -exponent));
    let size = rounded.re.hypot(rounded.im);
    (rounded.map(|x| x / size), size, exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_far_origin_leaves_the_differences_exact() {
        let far = 2f64.powi(40);
        let leg = |x: f64, length| Dyad::RR { a: Vector2::new(far + x, -far), b: Vector2::new(x, far), length };
        let numbers = TriadNumbers::of(&[leg(0.0, 2.0), leg(0.25, 1.0), leg(3.0, 0.5)]);
        assert_eq!(numbers.order, [2, 0, 1]);
        assert_eq!(numbers.length_shift, 2);
        let LegNumbers::Circle { alpha, beta, length } = &numbers.legs[1] else { panic!("an RR leg") };
        assert_eq!(
            (alpha, beta),
            (&Gaussian::new(Integer::from(-12), Integer::ZERO), &Gaussian::new(Integer::from(-12), Integer::ZERO))
        );
        assert_eq!(*length, Integer::from(8));
    }

    #[test]
    fn delta_is_exact_for_square_directions() {
        let exact = exact_delta(Offset::Distance(0.1), &Vector2::new(3.0, 4.0));
        assert_eq!(exact, number(0.1) * Rational::from(5));
        let rounded = exact_delta(Offset::Distance(0.1), &Vector2::new(1.0, 1.0));
        assert_eq!(rounded, number(0.1 * 2f64.sqrt()));
        assert_eq!(exact_delta(Offset::TimesDirection(0.3), &Vector2::new(1.0, 1.0)), number(0.3));
    }
}
