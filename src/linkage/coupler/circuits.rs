//! Circuits: the pieces that the real curve falls into, each traced through the limits of its input without a break.
//!
//! The input is a crank's angle `alpha`. The rest is a dyad, which closes in two ways where `(u_high - u)(u - u_low) >= 0` for `u = cos delta`,
//! `delta` the angle from the line of the pivots (from the normal of the guide, for a slider). What `u_low` and `u_high` are to -1 and 1 decides how many circuits
//! there are, and is decided exactly. Between limits, `delta = mid + half sin tau` makes the two ways one smooth curve: the square root
//! that tells them apart is `cos tau` times a function without zeros.

use std::cmp::Ordering;

use nalgebra::Vector2;
use num_complex::Complex64;

use super::curve::{CouplerCurve, CouplerSide, complex};
use crate::algebra::{Rational, dyadic};

/// Over which input angles a circuit runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputRange {
    /// A full turn: the input is a crank.
    Full,
    /// From `mid - half` to `mid + half`, there and back. Radians.
    Between {
        /// Middle of the range.
        mid: f64,
        /// Half its width.
        half: f64,
    },
}

/// One connected piece of a coupler curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circuit {
    /// The range of the input: the angle of the crank of the first side that is a circle; of the coupler for two sliders.
    pub input: InputRange,
    /// In which way the dyad closes, 1 or -1; both on a circuit between limits, where it is 1 for `cos tau > 0`.
    pub way: Option<i8>,
    /// Whether it meets another circuit: the linkage folds flat exactly, and can change over.
    pub touches: bool,
    frame: Frame,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Frame {
    /// Where `delta` is zero, in radians.
    zero: f64,
    /// Bounds of `cos delta`, as far as they bind.
    low: f64,
    high: f64,
}

/// How the links of a four-bar can turn, by its first crank as the input and the second as the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GrashofClass {
    /// The input turns fully, the output swings.
    CrankRocker,
    /// The input swings, the output turns fully.
    RockerCrank,
    /// Both turn fully: the ground is the shortest link.
    DoubleCrank,
    /// Both swing, the coupler turns fully: it is the shortest link.
    GrashofDoubleRocker,
    /// Nothing turns fully; input and output swing through the given directions: 0 outwards along the line of the pivots, pi inwards.
    TripleRocker {
        /// Whether the input swings through pi rather than 0.
        input_inwards: bool,
        /// Whether the output does.
        output_inwards: bool,
    },
    /// The linkage folds flat: shortest and longest link are together as long as the two others.
    ChangePoint,
    /// Opposite links are equal in pairs: folds flat.
    Parallelogram,
    /// Neighbouring links are equal in pairs: folds flat.
    Kite,
    /// A link has no length.
    ZeroLink,
    /// One link is longer than the three others together.
    CannotAssemble,
}

impl GrashofClass {
    /// The name that reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::CrankRocker => "crank-rocker",
            Self::RockerCrank => "rocker-crank",
            Self::DoubleCrank => "double crank",
            Self::GrashofDoubleRocker => "Grashof double rocker",
            Self::TripleRocker { input_inwards: false, output_inwards: false } => "00 double rocker",
            Self::TripleRocker { input_inwards: false, output_inwards: true } => "0pi double rocker",
            Self::TripleRocker { input_inwards: true, output_inwards: false } => "pi0 double rocker",
            Self::TripleRocker { input_inwards: true, output_inwards: true } => "pipi double rocker",
            Self::ChangePoint => "change point",
            Self::Parallelogram => "parallelogram",
            Self::Kite => "kite",
            Self::ZeroLink => "zero link",
            Self::CannotAssemble => "cannot assemble",
        }
    }
}

fn exact(x: f64) -> Rational {
    dyadic(x).expect("finite, as validated")
}

fn sign(x: &Rational) -> Ordering {
    x.cmp(&Rational::ZERO)
}

/// The sign of `k + m sqrt(q)`, `q >= 0`. Exact.
fn sign_with_root(k: &Rational, m: &Rational, q: &Rational) -> Ordering {
    let root = if q.is_zero() { Ordering::Equal } else { sign(m) };
    match (sign(k), root) {
        (own, Ordering::Equal) => own,
        (Ordering::Equal, root) => root,
        (own, root) if own == root => own,
        (own, _) => {
            let larger = (k * k).cmp(&(m * m * q));
            if own == Ordering::Greater { larger } else { larger.reverse() }
        }
    }
}

/// The sign of `e sqrt(g) + f sqrt(h) + c`, `e` and `f` 1 or -1. Exact: squared until no root is left.
fn sign_of_sum(e: i8, g: &Rational, f: i8, h: &Rational, c: &Rational) -> Ordering {
    if e == f {
        let roots = if e > 0 { Ordering::Greater } else { Ordering::Less };
        // |sqrt g + sqrt h| against |c|, where they have different signs.
        let difference = sign_with_root(&(g + h - c * c), &Rational::from(2), &(g * h));
        return match sign(c) {
            own if own == roots => roots,
            _ if e > 0 => difference,
            _ => difference.reverse(),
        };
    }
    // sqrt(one) + c against sqrt(other), with one the root that is added.
    let (one, other) = if e > 0 { (g, h) } else { (h, g) };
    if sign(c) != Ordering::Less {
        return sign_with_root(&(one + c * c - other), &(Rational::from(2) * c), one);
    }
    sign_with_root(&(other + c * c - one), &(Rational::from(-2) * c), other).reverse()
}

/// What bounds `u = cos delta` are to 1 and -1.
struct Ends {
    high_to_one: Ordering,
    low_to_minus: Ordering,
    /// Whether the bounds leave something between -1 and 1.
    possible: bool,
}

/// A crank and what it drives.
struct Drive {
    crank: usize,
    frame: Frame,
    ends: Ends,
    /// Whether `u` does not depend on the angle at all.
    constant: bool,
}

impl CouplerCurve {
    /// The circuits of the real curve; empty where the linkage cannot be assembled or its input has no length.
    ///
    /// **Proof:** their number is exact, the limits are accurate to rounding. **Order:** by the middle of the input's range, then the
    /// way +1 first.
    ///
    /// ```
    /// use assur::linkage::{CouplerCurve, InputRange};
    /// // A non-Grashof four-bar has one circuit, between limits.
    /// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[0.0, 1.0], [3.0, 1.0]], [3.0, 3.5])?;
    /// let circuits = curve.circuits();
    /// assert_eq!(circuits.len(), 1);
    /// assert!(matches!(circuits[0].input, InputRange::Between { .. }));
    /// # Ok::<(), assur::linkage::CouplerError>(())
    /// ```
    pub fn circuits(&self) -> Vec<Circuit> {
        let Some(drive) = self.drive() else {
            // Two sliders: the coupler itself is the input and turns fully.
            let frame = Frame { zero: 0.0, low: -1.0, high: 1.0 };
            let both_slide = self.sides.iter().all(|side| matches!(side, CouplerSide::Line { .. }));
            let whole = Circuit { input: InputRange::Full, way: None, touches: false, frame };
            return if both_slide { vec![whole] } else { Vec::new() };
        };
        let Drive { frame, ends, constant, .. } = drive;
        if !ends.possible {
            return Vec::new();
        }
        let (top, bottom) = (ends.high_to_one != Ordering::Less, ends.low_to_minus != Ordering::Greater);
        let touches = !constant && (ends.high_to_one == Ordering::Equal || ends.low_to_minus == Ordering::Equal);
        let between = |mid: f64, half: f64| Circuit {
            input: InputRange::Between { mid: frame.zero + mid, half },
            way: None,
            touches,
            frame,
        };
        let (low, high) = (frame.low.clamp(-1.0, 1.0).acos(), frame.high.clamp(-1.0, 1.0).acos());
        match (constant || top, constant || bottom) {
            (true, true) => {
                [1, -1].map(|way| Circuit { input: InputRange::Full, way: Some(way), touches, frame }).to_vec()
            }
            (true, false) => vec![between(0.0, low)],
            (false, true) => vec![between(std::f64::consts::PI, std::f64::consts::PI - high)],
            (false, false) => {
                let (mid, half) = ((low + high) / 2.0, (low - high) / 2.0);
                vec![between(-mid, half), between(mid, half)]
            }
        }
    }

    /// The Grashof class; `None` where a side slides. Exact.
    ///
    /// ```
    /// use assur::linkage::{CouplerCurve, GrashofClass};
    /// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[-1.0, -1.0], [2.0, -1.0]], [1.0, 2.5])?;
    /// assert_eq!(curve.grashof(), Some(GrashofClass::CrankRocker));
    /// # Ok::<(), assur::linkage::CouplerError>(())
    /// ```
    pub fn grashof(&self) -> Option<GrashofClass> {
        let FourBar { ground, coupler, input, output } = self.four_bar_squares()?;
        let (g, h, r, s) = (&ground, &coupler, &input, &output);
        let zero = Rational::ZERO;
        if [g, h, r, s].into_iter().any(|length| *length == zero) {
            return Some(GrashofClass::ZeroLink);
        }
        let (sum, difference) = (r + s, r - s);
        if !can_assemble(g, h, r, s) {
            return Some(GrashofClass::CannotAssemble);
        }
        let (r2, s2) = (r * r, s * s);
        if *g == *h && r == s {
            return Some(GrashofClass::Parallelogram);
        }
        if (*g == r2 && *h == s2) || (*g == s2 && *h == r2) {
            return Some(GrashofClass::Kite);
        }
        let signs = [
            sign_of_sum(1, g, 1, h, &-sum),
            sign_of_sum(1, g, -1, h, &-difference.clone()),
            sign_of_sum(-1, g, 1, h, &-difference),
        ];
        use Ordering::{Greater, Less};
        Some(match signs {
            [Greater, Greater, Greater] => GrashofClass::CrankRocker,
            [Greater, Less, Less] => GrashofClass::RockerCrank,
            [Less, Less, Greater] => GrashofClass::DoubleCrank,
            [Less, Greater, Less] => GrashofClass::GrashofDoubleRocker,
            [Less, Less, Less] => GrashofClass::TripleRocker { input_inwards: false, output_inwards: false },
            [Less, Greater, Greater] => GrashofClass::TripleRocker { input_inwards: false, output_inwards: true },
            [Greater, Less, Greater] => GrashofClass::TripleRocker { input_inwards: true, output_inwards: false },
            [Greater, Greater, Less] => GrashofClass::TripleRocker { input_inwards: true, output_inwards: true },
            _ => GrashofClass::ChangePoint,
        })
    }

    /// Squares of ground and coupler, lengths of the cranks.
    fn four_bar_squares(&self) -> Option<FourBar> {
        let [CouplerSide::Circle { pivot: a, radius: r, arm: p }, CouplerSide::Circle { pivot: b, radius: s, arm: q }] =
            &self.sides
        else {
            return None;
        };
        Some(FourBar {
            ground: square_between(a, b),
            coupler: square_between(p, q),
            input: exact(*r),
            output: exact(*s),
        })
    }

    fn drive(&self) -> Option<Drive> {
        let crank = self.sides.iter().position(|side| matches!(side, CouplerSide::Circle { .. }))?;
        let CouplerSide::Circle { pivot, radius, arm } = &self.sides[crank] else { return None };
        if *radius == 0.0 {
            return None;
        }
        let length = (self.sides[1 - crank].arm() - complex(arm)).norm();
        match &self.sides[1 - crank] {
            CouplerSide::Circle { pivot: other, radius: s, .. } => {
                let FourBar { ground, coupler, input, output } = self.four_bar_squares()?;
                let (g, h, r, s_exact) = (&ground, &coupler, &input, &output);
                let difference = r - s_exact;
                let constant = ground.is_zero();
                let possible = can_assemble(g, h, r, s_exact);
                let high_to_one = sign_of_sum(-1, g, 1, h, &-difference.clone());
                // |g - r| against |h - s|: the product of g + h - r - s and g - h - r + s.
                let product = match (sign_of_sum(1, g, 1, h, &-(r + s_exact)), sign_of_sum(1, g, -1, h, &-difference)) {
                    (Ordering::Equal, _) | (_, Ordering::Equal) => Ordering::Equal,
                    (a, b) if a == b => Ordering::Greater,
                    _ => Ordering::Less,
                };
                let between = pivot - other;
                let (g, r) = (between.norm(), *radius);
                let bound = |sum: f64| (sum * sum - g * g - r * r) / (2.0 * g * r);
                let frame = Frame { zero: between.y.atan2(between.x), low: bound(length - s), high: bound(length + s) };
                let ends = Ends { high_to_one, low_to_minus: product.reverse(), possible };
                Some(Drive { crank, frame, ends, constant })
            }
            CouplerSide::Line { point, direction, .. } => {
                let normal = Vector2::new(-direction.y, direction.x);
                let unit = normal.normalize();
                let height = unit.dot(&(pivot - point));
                let frame = Frame {
                    zero: normal.y.atan2(normal.x),
                    low: (-length - height) / radius,
                    high: (length - height) / radius,
                };
                // With m = height |n|: comparisons of m, r |n| and l |n|, two of them roots.
                let m = exact(normal.x) * (exact(pivot.x) - exact(point.x))
                    + exact(normal.y) * (exact(pivot.y) - exact(point.y));
                let square = exact(normal.x) * exact(normal.x) + exact(normal.y) * exact(normal.y);
                let r = exact(*radius) * exact(*radius) * square.clone();
                let arms = self.sides.each_ref().map(|side| match side {
                    CouplerSide::Circle { arm, .. } | CouplerSide::Line { arm, .. } => *arm,
                });
                let l = square_between(&arms[0], &arms[1]) * square;
                // high >= 1: l - m - r >= 0; low <= -1: -l - m + r <= 0.
                let high_to_one = sign_of_sum(1, &l, -1, &r, &-m.clone());
                let low_to_minus = sign_of_sum(1, &r, -1, &l, &-m.clone());
                // high >= -1: l - m + r >= 0; low <= 1: l + m + r >= 0.
                let possible = sign_of_sum(1, &l, 1, &r, &-m.clone()) != Ordering::Less
                    && sign_of_sum(1, &l, 1, &r, &m) != Ordering::Less;
                Some(Drive { crank, frame, ends: Ends { high_to_one, low_to_minus, possible }, constant: false })
            }
        }
    }

    /// A point of a circuit and the coupler's rotation there, for `tau` from 0 to a full turn: the input angle itself where it turns
    /// fully, else `mid + half sin tau`.
    ///
    /// `None` only where the dyad that closes the linkage has no direction: its outer joints coincide.
    ///
    /// ```
    /// use assur::linkage::CouplerCurve;
    /// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[0.0, 0.0], [2.0, 0.0]], [1.0, 2.5])?;
    /// // The curve's point is the crank's end.
    /// let (point, _) = curve.trace(&curve.circuits()[0], 1.0).expect("no dead point");
    /// assert!((point.norm() - 1.0).abs() < 1e-15);
    /// # Ok::<(), assur::linkage::CouplerError>(())
    /// ```
    pub fn trace(&self, circuit: &Circuit, tau: f64) -> Option<(Vector2<f64>, Complex64)> {
        let found = |z: Complex64, theta: Complex64| {
            (z.is_finite() && theta.is_finite()).then(|| (Vector2::new(z.re, z.im), theta))
        };
        let Some(drive) = self.drive() else {
            let theta = Complex64::from_polar(1.0, tau);
            let [one, two] = self.sides.each_ref().map(|side| match side {
                CouplerSide::Line { point, direction, arm } => {
                    Some((complex(point) - theta * complex(arm), complex(direction)))
                }
                CouplerSide::Circle { .. } => None,
            });
            let ((p, u), (q, v)) = (one?, two?);
            let along = ((q - p).conj() * v).im / (u.conj() * v).im;
            return found(p + u * along, theta);
        };
        let (angle, root) = circuit.input_and_root(tau);
        let CouplerSide::Circle { pivot, radius, arm } = &self.sides[drive.crank] else { return None };
        let joint = complex(pivot) + Complex64::from_polar(*radius, angle);
        let base = self.sides[1 - drive.crank].arm() - complex(arm);
        // From the crank's end to the other guided point.
        let across = match &self.sides[1 - drive.crank] {
            CouplerSide::Circle { pivot: other, radius: s, .. } => {
                let e = complex(other) - joint;
                let square = e.norm_sqr();
                let height = if drive.constant {
                    let l = base.norm();
                    let product = ((l + s).powi(2) - square) * (square - (l - s).powi(2));
                    product.max(0.0).sqrt() * f64::from(circuit.way.unwrap_or(1))
                } else {
                    2.0 * (pivot - other).norm() * radius * root
                };
                e * Complex64::new(square + base.norm_sqr() - s * s, height) / (2.0 * square)
            }
            CouplerSide::Line { point, direction, .. } => {
                let normal = complex(direction) * Complex64::I / direction.norm();
                let height = (normal.conj() * (joint - complex(point))).re;
                normal * Complex64::new(-height, radius * root)
            }
        };
        let theta = across / base;
        // Its length is one up to rounding.
        let theta = theta / theta.norm();
        found(joint - theta * complex(arm), theta)
    }

    /// Points along every circuit, `count` each, as closed polygons.
    pub fn polygons(&self, count: usize) -> Vec<Vec<Vector2<f64>>> {
        let tau = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
        let polygon = |circuit: &Circuit| (0..count).filter_map(|k| Some(self.trace(circuit, tau(k))?.0)).collect();
        self.circuits().iter().map(polygon).collect()
    }
}

/// No link longer than the three others together.
fn can_assemble(g: &Rational, h: &Rational, r: &Rational, s: &Rational) -> bool {
    let fits = |order: Ordering| order != Ordering::Less;
    fits(sign_of_sum(-1, g, 1, h, &(r + s)))
        && fits(sign_of_sum(1, g, -1, h, &(r + s)))
        && fits(sign_of_sum(1, g, 1, h, &(s - r)))
        && fits(sign_of_sum(1, g, 1, h, &(r - s)))
}

struct FourBar {
    ground: Rational,
    coupler: Rational,
    input: Rational,
    output: Rational,
}

fn square_between(a: &Vector2<f64>, b: &Vector2<f64>) -> Rational {
    let (x, y) = (exact(a.x) - exact(b.x), exact(a.y) - exact(b.y));
    &x * &x + &y * &y
}

fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { x.sin() / x }
}

impl Circuit {
    /// The input angle at `tau`, in radians.
    pub fn input_at(&self, tau: f64) -> f64 {
        self.input_and_root(tau).0
    }

    /// Whether the circuit passes through an input angle.
    pub fn contains_input(&self, angle: f64) -> bool {
        match self.input {
            InputRange::Full => true,
            InputRange::Between { mid, half } => (angle - mid).sin().atan2((angle - mid).cos()).abs() <= half,
        }
    }

    /// The input angle and the signed root of `(high - u)(u - low)`, smooth through the limits.
    fn input_and_root(&self, tau: f64) -> (f64, f64) {
        let Frame { zero, low, high } = self.frame;
        let InputRange::Between { mid, half } = self.input else {
            let u = (tau - zero).cos();
            return (tau, ((high - u) * (u - low)).max(0.0).sqrt() * f64::from(self.way.unwrap_or(1)));
        };
        let angle = mid + half * tau.sin();
        let delta = angle - zero;
        let u = delta.cos();
        // cos a - cos b = 2 sin((a+b)/2) sin((b-a)/2), with the factor that vanishes at the limit taken out as half cos(tau).
        let middle = mid - zero;
        let around_zero = middle.abs() < 1e-300;
        let around_pi = (middle - std::f64::consts::PI).abs() < 1e-12 && high < 1.0 && low <= -1.0;
        let off = half * tau.sin();
        let both_ends = sinc((half + off) / 2.0) * sinc((half - off) / 2.0) / 2.0;
        let smooth = if around_zero && high >= 1.0 {
            // u - low = cos(off) - cos(half)
            both_ends * (high - u)
        } else if around_pi {
            // high - u = cos(off) - cos(half), seen from pi
            both_ends * (u - low)
        } else {
            // Limits on both sides of 0 or pi: the other factor of each difference has no zero here.
            let (near, far) = (middle - half, middle + half);
            let others = ((delta + near) / 2.0).sin() * ((delta + far) / 2.0).sin();
            both_ends * 2.0 * others.abs()
        };
        (angle, half * tau.cos() * smooth.max(0.0).sqrt())
    }
}
