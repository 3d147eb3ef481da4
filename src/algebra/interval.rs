//! Arithmetic with sets of numbers: every operation's result contains every exact result.
//!
//! An [`Interval`] has two `f64` ends. Sums find their rounding error exactly (Knuth 1969, 2Sum) and step outward only where there is one;
//! products, quotients and roots step outward by one unit in the last place. That needs no rounding modes, so it holds wherever `f64` is IEEE 754 with
//! rounding to nearest: every operating system, and WebAssembly. Overflow gives an infinite end, underflow an end at or beyond zero. An interval is
//! never empty and has no NaN: a question without an answer (a quotient by an interval with zero, the root of a negative one) gives `None`.
//!
//! Source: Moore, Kearfott, Cloud 2009, chapters 2 and 3. What it cannot do: trigonometric functions, except the sine and cosine of one `f64`
//! ([`Interval::cos_sin`]) and the angle of a direction ([`Interval::angle`]).

use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, Mul, Neg, Sub};

use dashu_int::UBig;
use dashu_int::ops::{Abs, BitTest};

use super::{Integer, Rational, Ring};

/// A closed interval of real numbers; ends may be infinite.
///
/// ```
/// use assur::algebra::Interval;
/// let tenth = Interval::point(1.0).checked_div(Interval::point(10.0)).unwrap();
/// // 0.1 as `f64` is not a tenth, but lies in the interval that holds it.
/// assert!(tenth.contains(0.1) && tenth.width() < 1e-16);
/// assert!(Interval::point(1.0).checked_div(Interval::new(-1.0, 1.0).unwrap()).is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

/// `a + b` rounded down.
fn add_down(a: f64, b: f64) -> f64 {
    let sum = a + b;
    let b_part = sum - a;
    let error = (a - (sum - b_part)) + (b - b_part);
    // NaN, from an infinite or overflowing part, steps outward as well.
    if error >= 0.0 { sum } else { sum.next_down() }
}

fn add_up(a: f64, b: f64) -> f64 {
    -add_down(-a, -b)
}

/// `a · b` rounded down by up to two units; ends at infinity are limits, so that zero times one is zero.
fn mul_down(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { (a * b).next_down() }
}

fn mul_up(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { (a * b).next_up() }
}

/// `x · 2^exponent` and whether it is exact.
fn scaled(x: f64, exponent: i64) -> (f64, bool) {
    let mut rest = exponent.clamp(-4400, 4400) as i32;
    let mut y = x;
    while rest != 0 {
        let step = rest.clamp(-1000, 1000);
        y *= 2f64.powi(step);
        rest -= step;
    }
    // All steps go the same way, so none has rounded unless the last one did.
    (y, x == 0.0 || (y.is_finite() && y.abs() >= f64::MIN_POSITIVE))
}

impl Interval {
    /// All real numbers.
    pub const EVERYTHING: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
    /// Zero alone.
    pub const ZERO: Self = Self { lo: 0.0, hi: 0.0 };
    /// One alone.
    pub const ONE: Self = Self { lo: 1.0, hi: 1.0 };

    /// The numbers from `lo` to `hi`; `None` where there are none or an end is NaN.
    pub fn new(lo: f64, hi: f64) -> Option<Self> {
        (lo <= hi && lo < f64::INFINITY && hi > f64::NEG_INFINITY).then_some(Self { lo, hi })
    }

    /// The number `x` alone; everything where `x` is not finite.
    pub fn point(x: f64) -> Self {
        if x.is_finite() { Self { lo: x, hi: x } } else { Self::EVERYTHING }
    }

    /// The numbers no further than `radius` from `middle`.
    pub fn around(middle: f64, radius: f64) -> Self {
        let lo = add_down(middle, -radius.abs());
        Self::new(lo, add_up(middle, radius.abs())).unwrap_or(Self::EVERYTHING)
    }

    /// Lower end.
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// Upper end.
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// A number of the interval near its middle; finite.
    pub fn middle(self) -> f64 {
        // Halved first, lest the sum overflow.
        let middle = 0.5 * self.lo.max(-f64::MAX) + 0.5 * self.hi.min(f64::MAX);
        middle.clamp(self.lo, self.hi).clamp(-f64::MAX, f64::MAX)
    }

    /// A bound on the distance of any number of the interval from [`Interval::middle`].
    pub fn radius(self) -> f64 {
        let middle = self.middle();
        add_up(self.hi, -middle).max(add_up(middle, -self.lo))
    }

    /// Upper end less lower end, rounded up.
    pub fn width(self) -> f64 {
        add_up(self.hi, -self.lo)
    }

    /// The largest modulus.
    pub fn magnitude(self) -> f64 {
        self.hi.abs().max(self.lo.abs())
    }

    /// Whether `x` is one of the numbers.
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// Whether every number of `other` is one of this interval's.
    pub fn encloses(self, other: Self) -> bool {
        self.lo <= other.lo && other.hi <= self.hi
    }

    /// Whether every number of `other` lies strictly between the ends.
    pub fn encloses_strictly(self, other: Self) -> bool {
        self.lo < other.lo && other.hi < self.hi
    }

    /// `Some(true)` where every number is positive, `Some(false)` where every one is negative.
    pub fn is_positive(self) -> Option<bool> {
        if self.lo > 0.0 {
            Some(true)
        } else if self.hi < 0.0 {
            Some(false)
        } else {
            None
        }
    }

    /// The numbers in both; `None` where there is none.
    pub fn intersection(self, other: Self) -> Option<Self> {
        Self::new(self.lo.max(other.lo), self.hi.min(other.hi))
    }

    /// The smallest interval with both in it.
    pub fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// `x²`: never negative, which a product of two intervals may be.
    pub fn square(self) -> Self {
        let (near, far) = if self.lo >= 0.0 {
            (self.lo, self.hi)
        } else if self.hi <= 0.0 {
            (-self.hi, -self.lo)
        } else {
            (0.0, self.magnitude())
        };
        Self { lo: mul_down(near, near).max(0.0), hi: mul_up(far, far) }
    }

    /// The numbers multiplied by one finite `f64`; a cheaper product.
    pub fn times(self, factor: f64) -> Self {
        if (0.0..f64::INFINITY).contains(&factor) {
            Self { lo: mul_down(self.lo, factor), hi: mul_up(self.hi, factor) }
        } else if factor.is_finite() {
            Self { lo: mul_down(self.hi, factor), hi: mul_up(self.lo, factor) }
        } else {
            self * Self::point(factor)
        }
    }

    /// The square roots of the numbers that are not negative; `None` where all are negative.
    pub fn sqrt(self) -> Option<Self> {
        let lo = if self.lo > 0.0 { self.lo.sqrt().next_down() } else { 0.0 };
        (self.hi >= 0.0).then(|| Self { lo, hi: if self.hi > 0.0 { self.hi.sqrt().next_up() } else { 0.0 } })
    }

    /// The quotient; `None` where zero is among the divisors.
    pub fn checked_div(self, divisor: Self) -> Option<Self> {
        let positive = divisor.is_positive()?;
        let (lo, hi) = ((1.0 / divisor.hi).next_down(), (1.0 / divisor.lo).next_up());
        // A reciprocal that underflows keeps its sign.
        let inverse = if positive { Self { lo: lo.max(0.0), hi } } else { Self { lo, hi: hi.min(0.0) } };
        Some(self * inverse)
    }

    /// The numbers multiplied by `2^exponent`: exact, except where an end leaves the range of normal numbers.
    pub fn scale(self, exponent: i64) -> Self {
        let (lo, lo_exact) = scaled(self.lo, exponent);
        let (hi, hi_exact) = scaled(self.hi, exponent);
        Self { lo: if lo_exact { lo } else { lo.next_down() }, hi: if hi_exact { hi } else { hi.next_up() } }
    }

    /// The tightest interval with the number `n·2^exponent` in it.
    pub fn of_integer(n: &Integer, exponent: i64) -> Self {
        if n.is_zero() {
            return Self::ZERO;
        }
        let size: UBig = n.clone().abs().try_into().expect("an absolute value is not negative");
        let dropped = size.bit_len().saturating_sub(53);
        let head: UBig = &size >> dropped;
        let exact = dropped == 0 || &head << dropped == size;
        // Below 2⁵³ every integer is an f64, and so is 2⁵³ itself.
        let lo = head.to_f64().value();
        let hi = if exact { lo } else { lo + 1.0 };
        let size = Self { lo, hi }.scale(exponent + dropped as i64);
        if *n < Integer::ZERO { -size } else { size }
    }

    /// An interval with a rational number in it, a few units in the last place wide.
    pub fn of_rational(x: &Rational) -> Self {
        let (n, d) = (x.numerator(), Integer::from(x.denominator().clone()));
        // Numerator and denominator near 1, so that neither leaves the range.
        let (en, ed) = (n.bit_len() as i64, d.bit_len() as i64);
        let quotient = Self::of_integer(n, -en).checked_div(Self::of_integer(&d, -ed));
        quotient.expect("denominators are positive").scale(en - ed)
    }

    /// Cosine and sine of one angle in radians, `|angle| ≤ 3.9`; a few units of 2⁻⁵³ wide. For larger angles all of `[-1, 1]`.
    ///
    /// The angle less its quarter turns, and Taylor's series with its remainder as an interval: no library's sine is trusted.
    pub fn cos_sin(angle: f64) -> [Self; 2] {
        let unit = Self { lo: -1.0, hi: 1.0 };
        if angle.abs() > 3.9 || angle.is_nan() {
            return [unit; 2];
        }
        // At most two quarter turns, so that their product with the leading part of pi/2 is exact.
        let quarters = (angle / FRAC_PI_2).round();
        let rest = Self::point(angle) - Self::point(quarters * FRAC_PI_2) - Self::point(quarters) * REST_OF_QUARTER;
        let square = rest.square();
        // 1 - x²/(first(first+1)) (1 - …), terms to x¹⁸ and x¹⁹.
        let series = |inverses: &[Self; 9]| {
            let sum = inverses.iter().rev().fold(Self::ONE, |sum, &inverse| Self::ONE - square * inverse * sum);
            sum + REMAINDER
        };
        let (cosine, sine) = (series(&COSINE_INVERSES), rest * series(&SINE_INVERSES));
        let turned = match quarters as i8 {
            0 => [cosine, sine],
            1 => [-sine, cosine],
            -1 => [sine, -cosine],
            _ => [-cosine, -sine],
        };
        turned.map(|x| x.intersection(unit).unwrap_or(unit))
    }

    /// The angles of the directions `(c, s)`, in radians, near the principal value; `None` where the direction is too uncertain.
    ///
    /// An enclosure across the negative axis goes on beyond pi. **Accuracy**: the direction's own uncertainty and a few 2⁻⁵³.
    pub fn angle(cosine: Self, sine: Self) -> Option<Self> {
        let guess = sine.middle().atan2(cosine.middle());
        let [c, s] = Self::cos_sin(guess);
        // In the frame turned by the guess the direction is nearly (1, 0).
        let along = cosine * c + sine * s;
        let across = sine * c - cosine * s;
        let tangent = across.checked_div(along)?;
        if along.lo <= 0.0 || tangent.magnitude() > 0.125 {
            return None;
        }
        // x - |x|³/3 ≤ atan x ≤ x for x ≥ 0, and the mirror image.
        let cubed = tangent.magnitude();
        let cubed = mul_up(mul_up(mul_up(cubed, cubed), cubed), 0.34);
        let turn = Self {
            lo: if tangent.lo > 0.0 { add_down(tangent.lo, -cubed) } else { tangent.lo },
            hi: if tangent.hi < 0.0 { add_up(tangent.hi, cubed) } else { tangent.hi },
        };
        Some(Self::point(guess) + turn)
    }
}

/// What the `f64` nearest to pi/2 lacks.
const REST_OF_QUARTER: Interval = Interval { lo: 6.12323399573676e-17, hi: 6.12323399573677e-17 };

/// A bound on the series' remainders: for `|x| ≤ 0.79` the next terms, `x²⁰/20!` and less, are below 2⁻⁶⁷.
const REMAINDER: Interval = Interval { lo: -1.0 / (1u128 << 67) as f64, hi: 1.0 / (1u128 << 67) as f64 };

/// `1/(1·2), 1/(3·4), …, 1/(17·18)`.
const COSINE_INVERSES: [Interval; 9] = inverses(1);

/// `1/(2·3), 1/(4·5), …, 1/(18·19)`.
const SINE_INVERSES: [Interval; 9] = inverses(2);

const fn inverses(first: u32) -> [Interval; 9] {
    let mut out = [Interval::ZERO; 9];
    let mut k = 0;
    while k < 9 {
        let n = first + 2 * k as u32;
        let nearest = 1.0 / (n * (n + 1)) as f64;
        out[k] = Interval { lo: nearest.next_down(), hi: nearest.next_up() };
        k += 1;
    }
    out
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { lo: add_down(self.lo, other.lo), hi: add_up(self.hi, other.hi) }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        // Which ends make the extremes depends on the signs alone.
        if a.lo >= 0.0 {
            if b.lo >= 0.0 {
                Self { lo: mul_down(a.lo, b.lo).max(0.0), hi: mul_up(a.hi, b.hi) }
            } else if b.hi <= 0.0 {
                Self { lo: mul_down(a.hi, b.lo), hi: mul_up(a.lo, b.hi).min(0.0) }
            } else {
                Self { lo: mul_down(a.hi, b.lo), hi: mul_up(a.hi, b.hi) }
            }
        } else if a.hi <= 0.0 {
            -(-a * b)
        } else if b.lo >= 0.0 || b.hi <= 0.0 {
            b * a
        } else {
            let lo = mul_down(a.lo, b.hi).min(mul_down(a.hi, b.lo));
            Self { lo, hi: mul_up(a.lo, b.lo).max(mul_up(a.hi, b.hi)) }
        }
    }
}

impl Ring for Interval {
    fn from_int(n: i64) -> Self {
        let nearest = n as f64;
        // Within 2⁵³ exact; beyond, the cast rounds to nearest.
        if n.unsigned_abs() <= 1 << 53 {
            Self::point(nearest)
        } else {
            Self { lo: nearest.next_down(), hi: nearest.next_up() }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::dyadic;
    use proptest::prelude::*;

    fn rational(x: f64) -> Rational {
        dyadic(x).expect("finite")
    }

    /// Whether the exact number lies in the interval; infinite ends hold everything on their side.
    fn holds(interval: Interval, exact: &Rational) -> bool {
        assert!(interval.lo <= interval.hi, "{interval:?} is empty");
        (interval.lo == f64::NEG_INFINITY || rational(interval.lo) <= *exact)
            && (interval.hi == f64::INFINITY || *exact <= rational(interval.hi))
    }

    /// Numbers of every size, biased to the extremes.
    fn extreme() -> impl Strategy<Value = f64> {
        let special = prop::sample::select(vec![
            0.0,
            -0.0,
            1.0,
            -1.0,
            5e-324,
            -5e-324,
            f64::MIN_POSITIVE,
            -f64::MIN_POSITIVE,
            f64::MAX,
            -f64::MAX,
            1e300,
            -1e300,
            1e-300,
            0.1,
            1.0 + f64::EPSILON,
            9007199254740993.0,
            f64::MAX / 2.0,
            f64::MIN_POSITIVE.next_down(),
        ]);
        let any = any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite());
        prop_oneof![special, any, -10.0..10.0f64]
    }

    fn interval() -> impl Strategy<Value = (Interval, f64)> {
        (extreme(), extreme(), 0..3usize).prop_map(|(a, b, pick)| {
            let interval = Interval::new(a.min(b), a.max(b)).expect("ordered");
            (interval, [interval.lo, interval.middle(), interval.hi][pick])
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn every_operation_holds_the_exact_result((x, p) in interval(), (y, q) in interval(), e in -2200i64..2200) {
            let (a, b) = (rational(p), rational(q));
            prop_assert!(x.contains(p) && y.contains(q));
            prop_assert!(holds(x + y, &(&a + &b)));
            prop_assert!(holds(x - y, &(&a - &b)));
            prop_assert!(holds(x * y, &(&a * &b)));
            prop_assert!(holds(-x, &-a.clone()));
            prop_assert!(holds(x.times(q), &(&a * &b)));
            prop_assert!(holds(x.square(), &(&a * &a)) && x.square().lo >= 0.0);
            prop_assert!(holds(x.hull(y), &a) && holds(x.hull(y), &b));
            match x.checked_div(y) {
                Some(quotient) => prop_assert!(holds(quotient, &(&a / &b))),
                None => prop_assert!(y.contains(0.0)),
            }
            match x.sqrt() {
                // r² is compared, since the root itself is irrational.
                Some(root) if p >= 0.0 => {
                    prop_assert!(root.lo >= 0.0 && rational(root.lo) * rational(root.lo) <= a);
                    prop_assert!(root.hi == f64::INFINITY || a <= rational(root.hi) * rational(root.hi));
                }
                Some(root) => prop_assert!(root.lo == 0.0),
                None => prop_assert!(x.hi < 0.0),
            }
            let two = Rational::from(2);
            let power = if e >= 0 { two.pow(e as isize) } else { Rational::ONE / two.pow(-e as isize) };
            prop_assert!(holds(x.scale(e), &(&a * &power)));
            prop_assert!(holds(Interval::of_rational(&(&a * &power)), &(&a * &power)));
            prop_assert!(x.radius() >= (x.hi - x.middle()).min(f64::MAX) && x.contains(x.middle()));
        }

        #[test]
        fn integers_are_enclosed_tightly(head in any::<i128>(), shift in 0usize..3000, e in -3000i64..500) {
            let n = Integer::from(head) << shift;
            let enclosure = Interval::of_integer(&n, e);
            let two = Rational::from(2);
            let power = if e >= 0 { two.pow(e as isize) } else { Rational::ONE / two.pow(-e as isize) };
            prop_assert!(holds(enclosure, &(Rational::from(n) * power)));
            prop_assert!((0..4).fold(enclosure.lo, |x, _| x.next_up()) >= enclosure.hi);
        }

        #[test]
        fn angles_and_their_cosines_agree(angle in -3.9..3.9f64) {
            let [c, s] = Interval::cos_sin(angle);
            prop_assert!(c.contains(angle.cos()) && s.contains(angle.sin()), "{c:?} {s:?}");
            prop_assert!(c.width() < 2e-15 && s.width() < 2e-15);
            let unit = c.square() + s.square();
            prop_assert!(unit.contains(1.0));
            let back = Interval::angle(c, s).expect("a sharp direction");
            let principal = angle.sin().atan2(angle.cos());
            prop_assert!(back.lo - 1e-15 <= principal && principal <= back.hi + 1e-15 && back.width() < 1e-14);
        }
    }

    #[test]
    fn exact_sums_stay_points_and_others_step_outward() {
        let [one, tiny] = [1.0, 1e-30].map(Interval::point);
        assert_eq!((one + one).width(), 0.0);
        let sum = one + tiny;
        assert_eq!((sum.lo, sum.hi), (1.0, 1.0f64.next_up()));
        let largest = Interval::point(f64::MAX);
        assert_eq!((largest + largest).hi, f64::INFINITY);
        assert_eq!((largest + largest).lo, f64::MAX);
        assert_eq!(Interval::point(5e-324) * Interval::point(0.25), Interval { lo: 0.0, hi: 5e-324 });
    }

    #[test]
    fn constants_hold_what_they_stand_for() {
        for k in 0..9i64 {
            let exact = |n: i64| Rational::ONE / Rational::from(n * (n + 1));
            assert!(
                holds(COSINE_INVERSES[k as usize], &exact(2 * k + 1))
                    && holds(SINE_INVERSES[k as usize], &exact(2 * k + 2))
            );
        }
        // pi to 50 digits, from any table.
        let digits: Integer = "31415926535897932384626433832795028841971693993751".parse().expect("digits");
        let quarter = Rational::from(digits) / Rational::from(Integer::from(10).pow(49)) / Rational::from(2);
        assert!(holds(REST_OF_QUARTER, &(quarter - rational(FRAC_PI_2))));
        let twenty: Rational = (1..=20i64).map(Rational::from).fold(Rational::ONE, |p, n| p * n);
        assert!(rational(0.79).pow(20) / twenty < rational(REMAINDER.hi));
    }

    #[test]
    fn quotients_need_both_of_their_roundings() {
        // Here the reciprocal's rounding and the product's add up to more than one step outward.
        for [a, b] in [
            [1.5483388900756836, 1.86029052734375],
            [1.3311376571655273, 1.612452507019043],
            [1.4608526229858398, 1.5702810287475586],
            [1.715108871459961, 1.9543075561523438],
        ] {
            for [a, b] in [[a, b], [-a, b], [a, -b], [-a, -b]] {
                let quotient = Interval::point(a).checked_div(Interval::point(b)).expect("not zero");
                assert!(holds(quotient, &(rational(a) / rational(b))), "{a} / {b}: {quotient:?}");
            }
        }
    }

    #[test]
    fn nothing_is_silently_empty_or_nan() {
        assert!(Interval::new(2.0, 1.0).is_none() && Interval::new(f64::NAN, 1.0).is_none());
        assert!(Interval::new(f64::INFINITY, f64::INFINITY).is_none());
        assert_eq!(Interval::point(f64::NAN), Interval::EVERYTHING);
        let unbounded = Interval::EVERYTHING;
        for result in [unbounded + unbounded, unbounded - unbounded, unbounded * unbounded, unbounded * Interval::ZERO]
        {
            assert!(result.lo <= result.hi, "{result:?}");
        }
        assert!(Interval::angle(Interval::ZERO, Interval::ZERO).is_none());
    }

    #[test]
    fn the_angle_goes_on_beyond_a_half_turn() {
        let across = Interval::angle(Interval::point(-1.0), Interval::around(0.0, 1e-9)).expect("sharp");
        assert!(
            across.contains(std::f64::consts::PI)
                && across.hi > std::f64::consts::PI
                && across.lo < std::f64::consts::PI
        );
    }
}
