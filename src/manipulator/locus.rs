//! For a fixed orientation: where in the plane is a manipulator singular?
//!
//! **Type 1** is one leg's affair: the ends of its reach, circles and lines about points that the orientation fixes.
//!
//! **Type 2** is `det A = 0`. With the orientation fixed each row of `A` is a polynomial in the position `(x, y)` and in at most one square root,
//! `w = U + s·V` with `s² = Delta(x, y)`; the sign of `s` is the leg's working mode. The roots go one by one, as resultants of the determinant with
//! `s² - Delta`: the product over both signs. What is left is one polynomial in `x` and `y` that holds all working modes at once.
//!
//! | leg | idle joints | row, up to a factor | `Delta` |
//! |---|---|---|---|
//! | RRR | 1, 3 | force `D` through `P` | none |
//! | RRR | 2, 3 or 1, 2 | forces `(2d²-k)D - s·iD` through `P`, `kD + s·iD` through `A`; `k = d² + l1² - l2²` | `4 l1² d² - k²` |
//! | RPR | 1, 3 | force `D` through `P` | none |
//! | RPR | 2, 3 or 1, 2 | force `h·D + s·iD` through `P` or `A`; without offset `h` force `iD` | `d² - h²` |
//! | PRR | 2, 3 or 1, 2 | force `S n - s·e` through `P`, or `n` through the elbow | `e²l² - S²` |
//! | PRR | 1, 3 | force `n` through `P` | none |
//! | RRP | 1, 2 or 2, 3 | force `S n + s·g` through `A`, or `n` through the elbow | `g²l² - S²` |
//! | RRP | 1, 3 | force `n` through `A` | none |
//! | PPR, PRP, RPP | | a fixed direction through a point linear in `x, y`, or a pure moment | none |
//!
//! `P` is the leg's last pivot, `A` its base pivot, `D = P - A`, `d = |D|`, `n` the normal of the slider `e` or `g`, `S` the part of `D` along `n`.
//! Where `D` is isotropic, `D·D = 0`, one sign of a row with factor `d²` vanishes by itself; these factors are removed by name.
//!
//! | three legs alike | degree | | three legs alike | degree |
//! |---|---|---|---|---|
//! | `R_P_R`, `R_R_R` | 2 | | `PR_R_`, `_R_RP` | 6 |
//! | `_R_PR`, `RP_R_`, with offset | 16 | | `_P_RP`, `PR_P_` | 1 |
//! | `_P_RR`, `RR_P_` | 20 | | `P_R_R`, `R_R_P`, `_P_PR`, `P_P_R`, `R_P_P`, `RP_P_` | 0: the position does not matter |
//! | `_R_RR`, `RR_R_` | 44 | | | |
//!
//! The derivation `singularity_degrees` finds each by exact elimination on random members, three of each type (one at degree 44), shows the curve irreducible
//! over the rationals, and says how certain it is that the general member has no higher degree. What it cannot do: legs with several actuators or none.

use nalgebra::Vector2;
use thiserror::Error;

use super::describe::JointKind::{Prismatic as P, Revolute as R};
use super::describe::{Leg, Manipulator, Placement};
use super::frame::{back, times, unit};
use crate::algebra::{Domain, Gaussian, Integer, Poly, Rational, Ring, dyadic, integer_to_f64_scaled};
use crate::eliminate::{NamedFactor, Power, resultant};

/// A curve where a leg is singular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlaneCurve {
    /// A circle; of radius zero a point.
    Circle {
        /// Its centre.
        center: Vector2<f64>,
        /// Its radius.
        radius: f64,
    },
    /// A line.
    Line {
        /// A point of it.
        point: Vector2<f64>,
        /// Its direction, of length one.
        direction: Vector2<f64>,
    },
}

/// Where one leg is singular (type 1), for a fixed orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct LegLocus {
    /// Leg, from 1.
    pub leg: usize,
    /// The curves, of positions of the platform's origin.
    pub curves: Vec<PlaneCurve>,
    /// Whether the leg is singular in every position: its two sliders are parallel in this orientation.
    pub everywhere: bool,
}

/// Where a manipulator is singular of type 2, for a fixed orientation and all working modes at once.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularityLocus {
    /// The orientation, in radians.
    pub phi: f64,
    /// A polynomial in x (variable 0) and y (variable 1) of the platform's origin, exact for the `f64`s given and the `f64` cosine and sine of
    /// `phi`: zero where some working mode is singular. The zero polynomial: everywhere. A constant: nowhere.
    pub polynomial: Poly<Integer>,
    /// Factors that no singular pose needs, with the power in which each was removed.
    pub removed: Vec<(String, u32)>,
}

/// Why a manipulator has no locus of this kind. Legs are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum LocusError {
    /// The orientation is NaN or infinite.
    #[error("phi: {0} must be finite")]
    NotFinite(f64),
    /// A leg with several actuators, or none.
    #[error("leg {leg}: {actuated} actuated joints; loci are known for legs with one")]
    Actuators {
        /// Leg, from 1.
        leg: usize,
        /// How many of its joints are actuated.
        actuated: usize,
    },
}

impl SingularityLocus {
    /// The degree of the curve; 0 where it is everywhere or nowhere.
    pub fn degree(&self) -> u32 {
        self.polynomial.total_degree()
    }

    /// The terms as `(power of x, power of y, coefficient)`, coefficients rounded with the largest of modulus 1.
    pub fn rounded_terms(&self) -> Vec<(u32, u32, f64)> {
        let parts: Vec<(u32, u32, (f64, i64))> =
            self.polynomial.terms().map(|(m, c)| (m.exponent(0), m.exponent(1), integer_to_f64_scaled(c))).collect();
        let top = parts.iter().map(|(_, _, (_, e))| *e).max().unwrap_or(0);
        let value = |(m, e): (f64, i64)| m * 2f64.powi((e - top).max(-1000) as i32);
        let largest = parts.iter().map(|part| value(part.2).abs()).fold(0.0, f64::max);
        parts.into_iter().map(|(i, j, c)| (i, j, value(c) / largest)).collect()
    }

    /// The exact value at a position, up to a positive factor: its sign, and whether it is zero, are certain. `None` if a coordinate is not finite.
    ///
    /// ```
    /// use assur::{Leg, Manipulator};
    /// let robot = Manipulator::new("", [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]].map(|a| Leg::rpr(a, [0.5 * a[0], 0.5 * a[1]])).to_vec())?;
    /// let locus = robot.singularity_locus(0.0)?;
    /// // A half-size platform: with the strut lines through one point for every position, 3-RPR is singular everywhere.
    /// assert!(locus.exact_value(1.0, 2.0).is_some_and(|value| value.is_zero()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn exact_value(&self, x: f64, y: f64) -> Option<Rational> {
        let at = [dyadic(x)?, dyadic(y)?];
        Some(self.polynomial.evaluate(|c| Rational::from(c.clone()), &at))
    }
}

impl Manipulator {
    /// Where singularities of type 2 lie for a fixed orientation: one implicit curve for all working modes.
    ///
    /// **Proof**: exact for the model's `f64`s, with frames that the orientation turns rounded once. **Cost**: below a millisecond for 3-RPR, 0.1 s for 3-PRR, some
    /// seconds for 3-RRR with its degree 44.
    ///
    /// # Errors
    /// An orientation that is not finite; a leg with several actuators or none.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, _) = Manipulator::of_family("3-RPR")?;
    /// assert_eq!(robot.singularity_locus(0.3)?.degree(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn singularity_locus(&self, phi: f64) -> Result<SingularityLocus, LocusError> {
        let rows = self.leg_rows(phi)?;
        let roots = rows.iter().filter(|row| row.root.is_some()).count() as u32;
        // Variables: x, y, then one root a leg.
        let matrix: Vec<[Poly<Integer>; 3]> = rows.iter().enumerate().map(|(k, row)| row.polynomials(2 + k)).collect();
        let minor = |i: usize, j: usize| {
            matrix[1][i].clone() * matrix[2][j].clone() - matrix[1][j].clone() * matrix[2][i].clone()
        };
        let mut polynomial = matrix[0][0].clone() * minor(1, 2)
            + matrix[0][1].clone() * minor(2, 0)
            + matrix[0][2].clone() * minor(0, 1);
        for (k, row) in rows.iter().enumerate() {
            let Some(square) = row.integer_square() else { continue };
            let root = 2 + k;
            polynomial = reduced(&polynomial, root, &square);
            if polynomial.degree_in(root) > 0 {
                polynomial = resultant(&polynomial, &(Poly::variable(root).power(2) - square), root);
                polynomial = primitive(&polynomial);
            }
        }
        let mut removed = Vec::new();
        for (number, row) in (1..).zip(&rows) {
            let Some(isotropic) = &row.isotropic else { continue };
            let name = format!("leg {number}: squared distance of its last pivot from its base pivot");
            let factor = NamedFactor::new(name.clone(), integer_form(isotropic).0);
            // Each vanishes in half of the signs' product; a special shape may lack it.
            let most = 1 << (roots - 1);
            for power in (1..=most).rev() {
                if let Ok((rest, _)) = factor.remove_from(&polynomial, Power::Exactly(power)) {
                    polynomial = rest;
                    removed.push((name, power));
                    break;
                }
            }
        }
        Ok(SingularityLocus { phi, polynomial: primitive(&polynomial), removed })
    }

    /// Where each leg is singular (type 1) for a fixed orientation.
    ///
    /// **Accuracy**: centres, radii and lines are closed forms, a few roundings.
    ///
    /// # Errors
    /// As [`Manipulator::singularity_locus`], but any number of actuators will do.
    ///
    /// ```
    /// use assur::{Leg, Manipulator, PlaneCurve, nalgebra::Vector2};
    /// let robot = Manipulator::new("", vec![Leg::rrr([0.0, 0.0], 3.0, 1.0, [0.0, 0.0]); 3])?;
    /// let reach = PlaneCurve::Circle { center: Vector2::zeros(), radius: 4.0 };
    /// assert_eq!(robot.leg_loci(0.0)?[0].curves[0], reach);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn leg_loci(&self, phi: f64) -> Result<Vec<LegLocus>, LocusError> {
        if !phi.is_finite() {
            return Err(LocusError::NotFinite(phi));
        }
        Ok((1..).zip(&self.legs).map(|(number, leg)| leg_locus(leg, number, phi)).collect())
    }

    fn leg_rows(&self, phi: f64) -> Result<Vec<LegRow>, LocusError> {
        if !phi.is_finite() {
            return Err(LocusError::NotFinite(phi));
        }
        (1..)
            .zip(&self.legs)
            .map(|(number, leg)| {
                let actuated: Vec<usize> = (0..3).filter(|&joint| leg.actuated[joint]).collect();
                match actuated[..] {
                    [only] => Ok(LegRow::new(leg, only, &Oriented::new(leg, phi))),
                    _ => Err(LocusError::Actuators { leg: number, actuated: actuated.len() }),
                }
            })
            .collect()
    }
}

/// A leg at a fixed orientation of the platform: what no longer depends on the position. Rounded once.
struct Oriented {
    /// The last pivot, from the platform's origin, in base axes.
    offset: Vector2<f64>,
    /// Direction of the frame after the last joint, in base axes, any length.
    last: Vector2<f64>,
    /// Base point of the first joint; for a first slider moved by the first link.
    base: Vector2<f64>,
    /// For a last slider: from the joint before it to its guide, in base axes.
    to_guide: Vector2<f64>,
}

impl Oriented {
    fn new(leg: &Leg, phi: f64) -> Self {
        let turn = Placement::turned(0.0, 0.0, phi).direction;
        let last = times(turn, leg.platform.direction);
        let link = match leg.joints[0] {
            P => times(unit(leg.base.direction), leg.links[0].at),
            R => Vector2::zeros(),
        };
        Self {
            offset: times(turn, leg.platform.at),
            last,
            base: leg.base.at + link,
            to_guide: times(unit(times(last, back(leg.links[1].direction))), leg.links[1].at),
        }
    }
}

fn leg_locus(leg: &Leg, number: usize, phi: f64) -> LegLocus {
    let o = Oriented::new(leg, phi);
    let circle = |center: Vector2<f64>, radius: f64| PlaneCurve::Circle { center, radius };
    let strip = |middle: Vector2<f64>, along: Vector2<f64>, half: f64| {
        let direction = unit(along);
        let across = Vector2::new(-direction.y, direction.x) * half;
        [middle + across, middle - across].map(|point| PlaneCurve::Line { point, direction }).to_vec()
    };
    let [l1, l2] = [0, 1].map(|k: usize| leg.links[k].at.norm());
    let parallel = |a: Vector2<f64>, b: Vector2<f64>| {
        let (a, b) = (unit(a), unit(b));
        (a.x * b.y - a.y * b.x).abs() <= super::joints::MERGED
    };
    let (mut curves, everywhere) = match leg.joints {
        [R, R, R] => {
            let center = o.base - o.offset;
            (vec![circle(center, l1 + l2), circle(center, (l1 - l2).abs())], false)
        }
        [R, P, R] => {
            let h = times(unit(back(leg.links[0].direction)), leg.links[0].at).y + leg.links[1].at.y;
            (vec![circle(o.base - o.offset, h.abs())], false)
        }
        [P, R, R] => (strip(o.base - o.offset, leg.base.direction, l2), false),
        [R, R, P] => (strip(o.base - o.offset + o.to_guide, o.last, l1), false),
        [P, P, _] => (Vec::new(), parallel(Vector2::x(), leg.links[0].direction)),
        [R, P, P] => (Vec::new(), parallel(Vector2::x(), leg.links[1].direction)),
        [P, R, P] => (Vec::new(), parallel(leg.base.direction, o.last)),
    };
    if curves.len() == 2 && curves[0] == curves[1] {
        curves.pop();
    }
    LegLocus { leg: number, curves, everywhere }
}

type Point = Gaussian<Poly<Rational>>;

/// A row of `A` at a fixed orientation: force and moment about the base origin as `U + s·V`, `s² = root`.
struct LegRow {
    without: [Poly<Rational>; 3],
    with: [Poly<Rational>; 3],
    root: Option<Poly<Rational>>,
    /// A factor that the product over the signs has and no singular pose needs.
    isotropic: Option<Poly<Rational>>,
}

impl LegRow {
    fn new(leg: &Leg, actuated: usize, o: &Oriented) -> Self {
        let pivot = Gaussian::new(Poly::variable(0), Poly::variable(1)) + constant(o.offset);
        let a = constant(o.base);
        let arm = pivot.clone() - a.clone();
        let length_square = |v: Vector2<f64>| Poly::constant(square(v));
        let quarter = |d: Vector2<f64>| constant(Vector2::new(-d.y, d.x));
        let nothing = || Gaussian::<Poly<Rational>>::zero();
        let [first, second] = &leg.links;
        match (leg.joints, actuated) {
            ([R, R, R], 1) | ([R, P, R], 1) => Self::force(&arm, &a),
            ([R, R, R], end) => {
                let distance = arm.norm_sqr();
                let (s1, s2) = (length_square(first.at), length_square(second.at));
                let k = distance.clone() + s1.clone() - s2;
                let root = Poly::from_int(4) * s1 * distance.clone() - k.clone() * k.clone();
                let isotropic = Some(distance.clone());
                let row = if end == 0 {
                    let along = arm.scaled(&(Poly::from_int(2) * distance - k));
                    Self::rooted([along, -arm.turned()], [pivot, nothing()], root)
                } else {
                    Self::rooted([arm.scaled(&k), arm.turned()], [a, nothing()], root)
                };
                Self { isotropic, ..row }
            }
            ([R, P, R], end) => {
                let h = times(unit(back(first.direction)), first.at).y + second.at.y;
                let through = if end == 0 { pivot } else { a };
                if h == 0.0 {
                    return Self::force(&arm.turned(), &through);
                }
                let h = Poly::constant(exact(h));
                let distance = arm.norm_sqr();
                let root = distance.clone() - h.clone() * h.clone();
                let row = Self::rooted([arm.scaled(&h), arm.turned()], [through, nothing()], root);
                Self { isotropic: Some(distance), ..row }
            }
            ([P, R, R], 1) => Self::force(&quarter(leg.base.direction), &pivot),
            ([P, R, R], end) => {
                let (e, n) = (constant(leg.base.direction), quarter(leg.base.direction));
                let (size, s) = (square(leg.base.direction), arm.dot(&n));
                let root = Poly::constant(size.clone()) * length_square(second.at) - s.clone() * s.clone();
                let link = [n.scaled(&s), -e];
                if end == 0 {
                    Self::rooted(link, [pivot, nothing()], root)
                } else {
                    let shrink = Poly::constant(-(Rational::ONE / size));
                    let [link, rooted] = link.map(|part| part.scaled(&shrink));
                    Self::rooted([n, nothing()], [pivot + link, rooted], root)
                }
            }
            ([R, R, P], 1) => Self::force(&quarter(o.last), &a),
            ([R, R, P], end) => {
                let (g, n) = (constant(o.last), quarter(o.last));
                let (size, s) = (square(o.last), (arm - constant(o.to_guide)).dot(&n));
                let root = Poly::constant(size.clone()) * length_square(first.at) - s.clone() * s.clone();
                let crank = [n.scaled(&s), g];
                if end == 2 {
                    Self::rooted(crank, [a, nothing()], root)
                } else {
                    let shrink = Poly::constant(Rational::ONE / size);
                    let [crank, rooted] = crank.map(|part| part.scaled(&shrink));
                    Self::rooted([n, nothing()], [a + crank, rooted], root)
                }
            }
            ([P, P, R], 0) => Self::force(&quarter(times(leg.base.direction, first.direction)), &pivot),
            ([P, P, R], 1) => Self::force(&quarter(leg.base.direction), &pivot),
            ([R, P, P], 1) => Self::force(&quarter(o.last), &a),
            ([R, P, P], 2) => Self::force(&quarter(times(o.last, back(second.direction))), &a),
            ([P, R, P], 0 | 2) => {
                // The pivot in the middle: on the base guide, and on the platform guide.
                let (e, g) = (constant(leg.base.direction), constant(o.last));
                let sine = e.cross(&g);
                let travel = (arm - constant(o.to_guide)).cross(&g);
                // Scaled by the sine, so that parallel guides give a row of zeros and not a division.
                let middle = a.scaled(&sine) + e.scaled(&travel);
                let along = if actuated == 0 { o.last } else { leg.base.direction };
                let force = quarter(along);
                let moment = middle.cross(&force);
                let force = force.scaled(&sine);
                Self { without: [force.re, force.im, moment], with: zeros(), root: None, isotropic: None }
            }
            ([P, R, P], _) | ([P, P, _], _) | ([R, P, P], _) => {
                let without = [Poly::zero(), Poly::zero(), Poly::one()];
                Self { without, with: zeros(), root: None, isotropic: None }
            }
        }
    }

    /// A force through a point.
    fn force(force: &Point, through: &Point) -> Self {
        let without = [force.re.clone(), force.im.clone(), through.cross(force)];
        Self { without, with: zeros(), root: None, isotropic: None }
    }

    /// A force `F0 + s·F1` through the point `Q0 + s·Q1`.
    fn rooted(force: [Point; 2], through: [Point; 2], root: Poly<Rational>) -> Self {
        let [f, g] = force;
        let [p, q] = through;
        let moment = p.cross(&f) + q.cross(&g) * root.clone();
        let rooted = p.cross(&g) + q.cross(&f);
        Self { without: [f.re, f.im, moment], with: [g.re, g.im, rooted], root: Some(root), isotropic: None }
    }

    /// The common denominator of the square root's square: `denominator·s` is the root of an integer polynomial.
    fn root_denominator(&self) -> Integer {
        self.root.as_ref().map_or(Integer::ONE, |root| integer_form(root).1)
    }

    /// The square of `denominator·s`, over the integers.
    fn integer_square(&self) -> Option<Poly<Integer>> {
        let root = self.root.as_ref()?;
        let (numerator, denominator) = integer_form(root);
        Some(numerator * Poly::constant(denominator))
    }

    /// The row over the integers, with its square root as a variable.
    fn polynomials(&self, root: usize) -> [Poly<Integer>; 3] {
        let shrink = Poly::constant(Rational::ONE / Rational::from(self.root_denominator()));
        let entry = |k: usize| {
            let rooted = self.with[k].clone() * shrink.clone() * Poly::variable(root);
            self.without[k].clone() + rooted
        };
        let entries = [entry(0), entry(1), entry(2)];
        let common = entries.iter().map(|entry| integer_form(entry).1).fold(Integer::ONE, |all, one| lcm(&all, &one));
        let scale = Poly::constant(Rational::from(common));
        entries.map(|entry| integer_form(&(entry * scale.clone())).0)
    }
}

fn zeros() -> [Poly<Rational>; 3] {
    [Poly::zero(), Poly::zero(), Poly::zero()]
}

fn exact(value: f64) -> Rational {
    dyadic(value).expect("a sound description and a finite orientation give finite numbers")
}

fn constant(v: Vector2<f64>) -> Point {
    Gaussian::new(Poly::constant(exact(v.x)), Poly::constant(exact(v.y)))
}

fn square(v: Vector2<f64>) -> Rational {
    Gaussian::new(exact(v.x), exact(v.y)).norm_sqr()
}

/// `(n, d)` with `polynomial = n / d` over the integers, `d` positive and least.
fn integer_form(polynomial: &Poly<Rational>) -> (Poly<Integer>, Integer) {
    let denominators = polynomial.terms().map(|(_, c)| Integer::from(c.denominator().clone()));
    let common = denominators.fold(Integer::ONE, |all, one| lcm(&all, &one));
    let scale = Rational::from(common.clone());
    (polynomial.map(|c| (c.clone() * scale.clone()).into_parts().0), common)
}

fn lcm(a: &Integer, b: &Integer) -> Integer {
    use dashu_int::ops::Gcd;
    a.clone() / Integer::from(a.gcd(b)) * b.clone()
}

/// The polynomial divided by the greatest common divisor of its coefficients.
fn primitive(polynomial: &Poly<Integer>) -> Poly<Integer> {
    use dashu_int::ops::Gcd;
    let mut content = Integer::ZERO;
    for (_, c) in polynomial.terms() {
        content = if content.is_zero() { c.clone() } else { Integer::from(content.gcd(c)) };
        if content.is_one() {
            return polynomial.clone();
        }
    }
    if content.is_zero() {
        return polynomial.clone();
    }
    polynomial.map(|c| c.exact_div(&content).expect("the content divides every coefficient"))
}

/// The polynomial with every `root²` replaced by `square`.
fn reduced(polynomial: &Poly<Integer>, root: usize, square: &Poly<Integer>) -> Poly<Integer> {
    let (mut even, mut odd) = (Poly::zero(), Poly::zero());
    for (k, coefficient) in polynomial.coefficients_in(root).into_iter().enumerate() {
        let part = coefficient * square.power((k / 2) as u32);
        if k % 2 == 0 {
            even = even + part;
        } else {
            odd = odd + part;
        }
    }
    even + odd * Poly::variable(root)
}
