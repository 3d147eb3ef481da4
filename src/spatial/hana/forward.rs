//! In which ways can HANA be put together for given slider heights? In at most eight, by square roots alone.
//!
//! The difference of the closures of legs 1 and 2 is a product, `(z2 - z1 - 2 r s)(2z - z1 - z2) = 0` (derivation `hana_forward`), so there are two
//! families. Where the sliders of legs 1 and 2 are on the same side of their joints, `sin phi` is known and the centre lies on two circles; where they are on opposite
//! sides, `z` is known, leg 3 gives `y` and leg 1 gives `phi`. Each takes two square roots: 4 + 4 solutions.
//!
//! How many are real is decided, not guessed: a discriminant beyond its rounding error has the sign it shows, any other is evaluated over the rationals.

use std::cmp::Ordering;

use super::super::error::{SpatialError, moderate};
use super::inverse::HanaMode;
use super::model::{Hana, HanaPose};
use crate::algebra::{Rational, Ring, dyadic};
use crate::solve::Account;

/// On which side of their joints the sliders of legs 1 and 2 are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HanaFamily {
    /// The same: `sin phi = (z2 - z1)/(2r)`.
    SameSide,
    /// Opposite: `z = (z1 + z2)/2`.
    OppositeSides,
}

impl HanaFamily {
    /// `A` and `B`, as reports write them.
    pub fn name(self) -> &'static str {
        match self {
            Self::SameSide => "A",
            Self::OppositeSides => "B",
        }
    }
}

/// One way to put the robot together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HanaAssembly {
    /// Where the platform is.
    pub pose: HanaPose,
    /// The family it belongs to.
    pub family: HanaFamily,
    /// The working mode it is in; `+` where a link lies level.
    pub mode: HanaMode,
    /// How many solutions of its family meet here: 1 unless the pose is singular.
    pub multiplicity: usize,
    /// Largest error of a link's length over the robot's largest length, measured on the assembled robot.
    pub residual: f64,
}

/// Every way to put the robot together, with an account that adds up to eight.
#[derive(Clone, Debug, PartialEq)]
pub struct HanaAssemblies {
    /// Slider heights.
    pub inputs: [f64; 3],
    /// Sorted by `phi`, then `y`, then `z`.
    pub modes: Vec<HanaAssembly>,
    /// Where the eight solutions went.
    pub account: Account,
    /// Orientations, in radians, with a circle of poses: `r = R`, and the circles of the legs coincide.
    pub self_motions: Vec<f64>,
}

/// How far rounding may move a discriminant, over `EPSILON` times the fourth power of the lengths: it is a sum of few products of sums of
/// squares, with less than fifty roundings in all.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl Hana {
    /// Every way to put the robot together.
    ///
    /// **Shape**: at most eight modes, sorted by `phi`, `y`, `z`; the account sums to 8. A pose in which both families meet (`N = 0` for legs
    /// 1 and 2) is listed in each. **Units**: lengths as given, radians in `(-pi, pi]`. **Proof**: the count and the multiplicities are exact for the `f64`s given.
    /// **Cost**: a fifth of a microsecond. **Source**: Liu et al., eqs. (7)-(9), factorised in the derivation `hana_forward`.
    ///
    /// # Errors
    /// An input that is not finite, or whose powers leave `f64`.
    ///
    /// ```
    /// use assur::{Hana, HanaMode};
    /// let robot = Hana::example();
    /// let answer = robot.forward(&[1.0, -0.5, 0.3])?;
    /// assert_eq!((answer.modes.len(), answer.account.degree), (4, 8));
    /// let built = answer.modes.iter().find(|mode| mode.mode == HanaMode::ABOVE && mode.pose.phi.cos() > 0.0).unwrap();
    /// assert!((built.pose.z + 11.677922624346667).abs() < 1e-13);
    /// # Ok::<(), assur::SpatialError>(())
    /// ```
    pub fn forward(&self, inputs: &[f64; 3]) -> Result<HanaAssemblies, SpatialError> {
        for (leg, &value) in (1..).zip(inputs) {
            moderate(|| format!("input {leg}"), value)?;
        }
        let mut found = Found {
            robot: self,
            inputs,
            modes: Vec::with_capacity(8),
            account: Account { degree: 8, ..Account::default() },
            self_motions: Vec::new(),
        };
        found.same_side();
        found.opposite_sides();
        let Found { mut modes, account, self_motions, .. } = found;
        let tie = TIE * self.size();
        modes.sort_by(|a, b| {
            let (p, q) = (&a.pose, &b.pose);
            let by = |a: f64, b: f64, tie: f64| if (a - b).abs() <= tie { Ordering::Equal } else { a.total_cmp(&b) };
            by(p.phi, q.phi, TIE).then(by(p.y, q.y, tie)).then(by(p.z, q.z, tie))
        });
        debug_assert!(account.adds_up(), "every solution is accounted for: {account:?}");
        Ok(HanaAssemblies { inputs: *inputs, modes, account, self_motions })
    }
}

/// Angles, and lengths over the robot's size, closer than this count as equal when modes are sorted.
const TIE: f64 = 1e-9;

struct Found<'a> {
    robot: &'a Hana,
    inputs: &'a [f64; 3],
    modes: Vec<HanaAssembly>,
    account: Account,
    self_motions: Vec<f64>,
}

impl Found<'_> {
    /// The sum of the squares of all lengths and heights: what rounding errors are measured by.
    fn scale(&self) -> f64 {
        let h = self.robot;
        let sum = |parts: &[f64]| parts.iter().map(|x| x.abs()).sum::<f64>();
        let all = sum(&[h.platform_radius, h.base_radius, h.link, h.third_link]) + sum(self.inputs);
        all * all
    }

    /// `sin phi = (z2 - z1)/(2r)`; the centre on a circle about `(0, (z1 + z2)/2)` and on one about `(r - R, z3)`.
    fn same_side(&mut self) {
        let (r, base, l, l3) =
            (self.robot.platform_radius, self.robot.base_radius, self.robot.link, self.robot.third_link);
        let [z1, z2, z3] = *self.inputs;
        let (apart, lost) = difference(z2, z1);
        // |z2 - z1| against 2r, exactly: the rounding error decides where the rounded difference does not.
        let room = match (2.0 * r).total_cmp(&apart.abs()) {
            Ordering::Equal => 0.0.partial_cmp(&(lost * apart.signum())).unwrap_or(Ordering::Equal),
            other => other,
        };
        let sine = (apart / (2.0 * r)).clamp(-1.0, 1.0);
        let cosine = ((2.0 * r - apart) * (2.0 * r + apart)).max(0.0).sqrt() / (2.0 * r);
        let (cosines, times) = match room {
            Ordering::Less => {
                self.account.complex += 4;
                return;
            }
            Ordering::Equal => (&[0.0][..], 2),
            Ordering::Greater => (&[cosine, -cosine][..], 1),
        };
        let (zm, y0) = (0.5 * (z1 + z2), r - base);
        let (dy, dz) = (y0, z3 - zm);
        let apart_square = dy * dy + dz * dz;
        let bound = ROUNDING * self.scale() * self.scale();
        for &c in cosines {
            let across = base - r * c;
            let radius_square = (l - across) * (l + across);
            let middle = apart_square + radius_square - l3 * l3;
            let discriminant = 4.0 * apart_square * radius_square - middle * middle;
            let exactly = || self.circles_exactly(c);
            let phi = sine.atan2(c);
            if apart_square <= bound.sqrt() && self.concentric() {
                // The circles have one centre: all in common, or nothing.
                if exactly() == Ordering::Equal {
                    self.account.self_motion += 2 * times;
                    self.self_motions.push(phi);
                } else {
                    self.account.at_infinity += 2 * times;
                }
                continue;
            }
            let count = decided(discriminant, bound, exactly);
            let half = match count {
                Ordering::Less => {
                    self.account.complex += 2 * times;
                    continue;
                }
                Ordering::Equal => 0.0,
                Ordering::Greater => discriminant.max(0.0).sqrt() / (2.0 * apart_square),
            };
            let along = middle / (2.0 * apart_square);
            let place =
                |side: f64| HanaPose::new(along * dy - side * half * dz, zm + along * dz + side * half * dy, phi);
            if count == Ordering::Equal {
                self.add(place(0.0), (sine, c), HanaFamily::SameSide, 2 * times);
            } else {
                self.add(place(1.0), (sine, c), HanaFamily::SameSide, times);
                self.add(place(-1.0), (sine, c), HanaFamily::SameSide, times);
            }
        }
    }

    /// `z = (z1 + z2)/2`; leg 3 gives `y`; `2 r R c + 2 r d s = r² + R² + d² + y² - L²` with `d = (z2 - z1)/2`.
    fn opposite_sides(&mut self) {
        let (r, base, l, l3) =
            (self.robot.platform_radius, self.robot.base_radius, self.robot.link, self.robot.third_link);
        let [z1, z2, z3] = *self.inputs;
        let (zm, half) = (0.5 * (z1 + z2), 0.5 * (z2 - z1));
        let scale = self.scale();
        let below = zm - z3;
        let offset_square = (l3 - below) * (l3 + below);
        let reach = decided(offset_square, ROUNDING * scale, || self.third_link_exactly());
        let (offsets, times) = match reach {
            Ordering::Less => {
                self.account.complex += 4;
                return;
            }
            Ordering::Equal => (&[0.0][..], 2),
            Ordering::Greater => {
                let offset = offset_square.max(0.0).sqrt();
                (&[offset, -offset][..], 1)
            }
        };
        let (a, b) = (2.0 * r * base, 2.0 * r * half);
        let square = a * a + b * b;
        for &offset in offsets {
            let y = r - base + offset;
            let k = r * r + base * base + half * half + (y - l) * (y + l);
            let discriminant = square - k * k;
            let count = decided(discriminant, ROUNDING * scale * scale, || self.turn_exactly(offset));
            let root = match count {
                Ordering::Less => {
                    self.account.complex += 2 * times;
                    continue;
                }
                Ordering::Equal => 0.0,
                Ordering::Greater => discriminant.max(0.0).sqrt(),
            };
            let sides: &[f64] = if count == Ordering::Equal { &[0.0] } else { &[1.0, -1.0] };
            let times = if count == Ordering::Equal { 2 * times } else { times };
            for side in sides {
                let (cosine, sine) = ((a * k - side * b * root) / square, (b * k + side * a * root) / square);
                // Both come from rounded numbers; the direction is what counts.
                let length = cosine.hypot(sine);
                let pose = HanaPose::new(y, zm, sine.atan2(cosine));
                self.add(pose, (sine / length, cosine / length), HanaFamily::OppositeSides, times);
            }
        }
    }

    fn add(&mut self, pose: HanaPose, (sine, cosine): (f64, f64), family: HanaFamily, multiplicity: usize) {
        let h = self.robot;
        let tilt = h.platform_radius * sine;
        let down = [pose.z - tilt - self.inputs[0], pose.z + tilt - self.inputs[1], pose.z - self.inputs[2]];
        let across = h.base_radius - h.platform_radius * cosine;
        let flat = across * across + pose.y * pose.y;
        let third = pose.y + h.base_radius - h.platform_radius;
        let errors = [
            (flat + down[0] * down[0]).sqrt() - h.link,
            (flat + down[1] * down[1]).sqrt() - h.link,
            (third * third + down[2] * down[2]).sqrt() - h.third_link,
        ];
        let residual = errors.iter().fold(0.0, |worst: f64, error| worst.max(error.abs())) / h.size();
        let mode = HanaMode { above: down.map(|height| height <= 0.0) };
        self.account.real += multiplicity;
        self.modes.push(HanaAssembly { pose, family, mode, multiplicity, residual });
    }

    /// Exact numbers of robot and inputs: `r, R, L, L3, z1, z2, z3`.
    fn exact(&self) -> [Rational; 7] {
        let h = self.robot;
        let [z1, z2, z3] = *self.inputs;
        [h.platform_radius, h.base_radius, h.link, h.third_link, z1, z2, z3]
            .map(|x| dyadic(x).expect("a robot's numbers are finite"))
    }

    fn concentric(&self) -> bool {
        let [r, base, _, _, z1, z2, z3] = self.exact();
        r == base && z1 + z2 == z3.clone() + z3
    }

    /// The sign of the circles' discriminant, over the rationals and `cos phi`; concentric circles: whether their radii agree.
    fn circles_exactly(&self, cosine: f64) -> Ordering {
        let [r, base, l, l3, z1, z2, z3] = self.exact();
        let two = Rational::from_int(2);
        let sine = (z2.clone() - z1.clone()) / (two.clone() * r.clone());
        let cosine_square = Rational::one() - sine.power(2);
        // radius² = p + q cos phi
        let p = l.power(2) - base.power(2) - r.power(2) * cosine_square.clone();
        let q = two.clone() * r.clone() * base.clone();
        let apart = (r - base).power(2) + ((z1 + z2) / two - z3).power(2);
        if apart == Rational::zero() {
            let gap = surd_sign(&(p - l3.power(2)), &q, cosine, &cosine_square);
            return if gap == Ordering::Equal { Ordering::Equal } else { Ordering::Less };
        }
        let e = apart.clone() + p.clone() - l3.power(2);
        let four = Rational::from_int(4);
        let constant = four.clone() * apart.clone() * p - e.power(2) - q.power(2) * cosine_square.clone();
        let linear = four * apart * q.clone() - Rational::from_int(2) * e * q;
        surd_sign(&constant, &linear, cosine, &cosine_square)
    }

    /// The sign of `L3² - (z - z3)²`.
    fn third_link_exactly(&self) -> Ordering {
        self.offset_square_exactly().partial_cmp(&Rational::zero()).expect("rationals are ordered")
    }

    fn offset_square_exactly(&self) -> Rational {
        let [_, _, _, l3, z1, z2, z3] = self.exact();
        l3.power(2) - ((z1 + z2) / Rational::from_int(2) - z3).power(2)
    }

    /// The sign of `(2 r R)² + (2 r d)² - k²`, over the rationals and the offset of `y`.
    fn turn_exactly(&self, offset: f64) -> Ordering {
        let [r, base, l, _, z1, z2, _] = self.exact();
        let (two, four) = (Rational::from_int(2), Rational::from_int(4));
        let half = (z2 - z1) / two;
        let offset_square = self.offset_square_exactly();
        let y0 = r.clone() - base.clone();
        let k = r.power(2) + base.power(2) + half.power(2) + y0.power(2) + offset_square.clone() - l.power(2);
        let square = four.clone() * r.power(2) * (base.power(2) + half.power(2));
        let constant = square - k.power(2) - four.clone() * y0.power(2) * offset_square.clone();
        surd_sign(&constant, &(-(four * k * y0)), offset, &offset_square)
    }
}

/// The sign of a number known to a bound; exactly where the bound does not tell.
fn decided(value: f64, bound: f64, exactly: impl FnOnce() -> Ordering) -> Ordering {
    if value > bound {
        Ordering::Greater
    } else if value < -bound {
        Ordering::Less
    } else {
        exactly()
    }
}

/// The sign of `a + b·w`, where `w` has the sign of `like` and the square `square`.
fn surd_sign(a: &Rational, b: &Rational, like: f64, square: &Rational) -> Ordering {
    let zero = Rational::zero();
    let sign = |x: &Rational| x.partial_cmp(&zero).expect("rationals are ordered");
    let linear = b.clone() * Rational::from_int(if like < 0.0 { -1 } else { 1 });
    let linear_sign = if *square == zero { Ordering::Equal } else { sign(&linear) };
    match (sign(a), linear_sign) {
        (constant, Ordering::Equal) => constant,
        (Ordering::Equal, linear) => linear,
        (constant, linear) if constant == linear => constant,
        // Opposite signs: the larger square wins.
        (constant, linear_sign) => match sign(&(a.power(2) - linear.power(2) * square.clone())) {
            Ordering::Greater => constant,
            Ordering::Less => linear_sign,
            Ordering::Equal => Ordering::Equal,
        },
    }
}

/// `a - b` rounded, and exactly what rounding lost.
///
/// Source: Knuth 1969, section 4.2.2, theorem B.
fn difference(a: f64, b: f64) -> (f64, f64) {
    let rounded = a - b;
    let back = rounded - a;
    (rounded, (a - (rounded - back)) - (b + back))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(r: f64, base: f64, l: f64, l3: f64) -> Hana {
        Hana::new(r, base, l, l3, [[-9.0, 9.0]; 3]).expect("is sound")
    }

    #[test]
    fn touching_circles_are_one_double_pose() {
        // phi = 0 or pi; the circles about (0, 0) and (-9, z3) of radii 12 (phi = 0) and 15 touch where they are 27 or 3 apart.
        let h = robot(3.0, 12.0, 15.0, 15.0);
        let z3 = (27.0_f64 * 27.0 - 81.0).sqrt();
        let near = h.forward(&[0.0, 0.0, z3]).expect("finite");
        assert!(near.account.adds_up());
        // 25-24-7 by threes: exact.
        let h = robot(4.0, 25.0, 25.0, 11.0);
        // radius² = 625 - 441 = 184 at phi = 0 is no square; at phi = pi there is no circle.
        assert!(h.forward(&[0.0, 0.0, 3.0]).expect("finite").account.adds_up());
        // R - r = 4, L = 5: radius 3 at phi = 0; centres (0, 0) and (-4, 3), 5 apart; L3 = 2 touches, 8 as well.
        let h = robot(2.0, 6.0, 5.0, 2.0);
        let answer = h.forward(&[0.0, 0.0, 3.0]).expect("finite");
        let double: Vec<_> = answer.modes.iter().filter(|mode| mode.family == HanaFamily::SameSide).collect();
        assert_eq!((double.len(), double[0].multiplicity), (1, 2));
        assert!((double[0].pose.y + 2.4).abs() < 1e-15 && (double[0].pose.z - 1.8).abs() < 1e-15);
        // A little shorter and there is none, a little longer and there are two.
        for (l3, count) in [(2.0 - f64::EPSILON, 0), (2.0 + 2.0 * f64::EPSILON, 2)] {
            let answer = robot(2.0, 6.0, 5.0, l3).forward(&[0.0, 0.0, 3.0]).expect("finite");
            let same = answer.modes.iter().filter(|mode| mode.family == HanaFamily::SameSide).count();
            assert_eq!(same, count, "{l3}");
        }
    }

    #[test]
    fn one_centre_is_a_self_motion_or_nothing() {
        // r = R and phi = 0: both circles about (0, 0); their radii are L and L3.
        let same = robot(2.0, 2.0, 5.0, 5.0).forward(&[0.0, 0.0, 0.0]).expect("finite");
        assert_eq!((same.self_motions.as_slice(), same.account.self_motion), (&[0.0][..], 2));
        assert!(same.account.adds_up());
        let other = robot(2.0, 2.0, 5.0, 4.0).forward(&[0.0, 0.0, 0.0]).expect("finite");
        assert!(
            other.self_motions.is_empty()
                && other.account.at_infinity == 2 + 2 * usize::from(other.account.at_infinity > 2)
        );
    }

    #[test]
    fn a_quarter_turn_is_double() {
        let h = robot(3.0, 12.0, 15.0, 15.0);
        let answer = h.forward(&[-3.0, 3.0, 1.0]).expect("finite");
        let upright: Vec<_> = answer.modes.iter().filter(|mode| mode.family == HanaFamily::SameSide).collect();
        assert!(upright.iter().all(|mode| mode.multiplicity == 2 && mode.pose.phi == std::f64::consts::FRAC_PI_2));
        assert_eq!(upright.len(), 2);
        assert!(answer.account.adds_up());
        let beyond = h.forward(&[-3.0, 3.0_f64.next_up(), 1.0]).expect("finite");
        assert!(beyond.modes.iter().all(|mode| mode.family == HanaFamily::OppositeSides));
    }

    #[test]
    fn what_cannot_be_computed_is_refused() {
        let h = Hana::example();
        assert_eq!(h.forward(&[0.0, f64::NAN, 0.0]).unwrap_err().to_string(), "input 2: NaN must be finite");
        assert!(h.forward(&[1e70, 0.0, 0.0]).is_err());
    }
}
