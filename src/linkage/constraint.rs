//! The constraint builder: a triad's closures as polynomials, and the plan that eliminates them.
//!
//! Unknowns are `theta = e^(i phi)` and the place `u` of the reference leg's platform point, seen from its base point, with its
//! formal conjugate `v`: for real assemblies `v` is the conjugate of `u` and `theta` has modulus 1, but the polynomials
//! need not know. Each leg gives one polynomial, without square roots, cleared of `1/theta`:
//!
//! | leg | polynomial |
//! |---|---|
//! | RR | `(u + theta beta - alpha)(theta v + beta' - theta alpha') - theta l²`; for the reference leg `u v - l²` |
//! | PR | `n'(theta u + theta² beta - theta alpha) + n(theta v + beta' - theta alpha')` |
//! | RP | `m'(alpha - u - theta beta) + theta m(theta alpha' - theta v - beta') - 2 theta delta` |
//! | PP | `w theta - (c + i s)`, the rotation as the quotient of `c + i s` by `w` |
//!
//! (`'` is the conjugate of a number; the symbols are those of [`super::triad`].) [`sylvester_plan`] takes them to one polynomial in
//! `theta` by three resultants. Those bring in two factors, both named: the coefficient of `u` in the row that is used
//! twice, and a power of `theta`.

use super::given_orientation::exact_rotation;
use super::group::{Dyad, Triad, triad_degree};
use super::numbers::TriadNumbers;
use super::triad::LegNumbers;
use crate::algebra::{Domain, Gaussian, Integer, Poly, Rational, Ring, Trig};
use crate::eliminate::Power;
use crate::solve::{Eliminant, EliminateError, Plan, System, eliminate};

/// The name of leg `number`'s polynomial, counted from 1 in the triad.
fn label<R>(leg: &LegNumbers<R>, number: usize) -> String {
    match leg {
        LegNumbers::Circle { .. } => format!("leg {number}, joint B{number} about A{number}"),
        LegNumbers::Line { .. } => format!("leg {number}, joint B{number} on its base line"),
        LegNumbers::PlatformLine { .. } => format!("leg {number}, joint A{number} on its platform line"),
    }
}

/// A given rotation over a ring: `turn / scale`, where `|turn| = scale`.
#[derive(Clone, Debug, PartialEq)]
pub struct RotationNumbers<R> {
    /// Cosine and sine, times `scale`.
    pub turn: Gaussian<R>,
    /// Common denominator.
    pub scale: R,
}

/// The constraint polynomials of a triad over any domain, in the variables `u`, `v`, `theta`.
///
/// **Shape**: legs other than PP with the reference leg first, then the rotations that PP legs give; `names` are the legs' numbers in
/// the triad in that order, for the labels. One polynomial per leg.
///
/// ```
/// use assur::algebra::{Gaussian, Integer};
/// use assur::linkage::{LegNumbers, constraint_system};
/// let point = |x: i64, y: i64| Gaussian::new(Integer::from(x), Integer::from(y));
/// let leg = |p: Gaussian<Integer>| LegNumbers::Circle { alpha: p.clone(), beta: p, length: Integer::from(1) };
/// let legs = [leg(point(0, 0)), leg(point(2, 0)), leg(point(1, 2))];
/// let system = constraint_system(&legs, &[], [1, 2, 3]);
/// assert_eq!(system.equations()[0].0, "leg 1, joint B1 about A1");
/// ```
pub fn constraint_system<R: Domain>(
    legs: &[LegNumbers<R>],
    rotations: &[RotationNumbers<R>],
    names: [usize; 3],
) -> System<Gaussian<R>> {
    let mut system = System::new(["u", "v", "theta"]);
    for (number, (leg, name)) in legs.iter().zip(names).enumerate() {
        let polynomial = match leg {
            // The reference circle holds no theta to be cleared of.
            LegNumbers::Circle { length, .. } if number == 0 => reference_circle(length),
            _ => leg_polynomial(leg),
        };
        system.add(label(leg, name), polynomial);
    }
    for (rotation, name) in rotations.iter().zip(&names[legs.len()..]) {
        let scale = Poly::constant(Gaussian::real(rotation.scale.clone()));
        let turn = Poly::constant(rotation.turn.clone());
        system.add(format!("leg {name}, orientation given"), scale * Poly::variable(2) - turn);
    }
    system
}

/// `u v - l²`.
fn reference_circle<R: Domain>(length: &R) -> Poly<Gaussian<R>> {
    let square = Gaussian::real(length.clone() * length.clone());
    Poly::variable(0) * Poly::variable(1) - Poly::constant(square)
}

/// The polynomial of one leg other than the reference circle; variables 0, 1, 2 are `u`, `v`, `theta`.
fn leg_polynomial<R: Domain>(leg: &LegNumbers<R>) -> Poly<Gaussian<R>> {
    let [u, v, theta] = [0, 1, 2].map(Poly::<Gaussian<R>>::variable);
    let number = |z: &Gaussian<R>| Poly::constant(z.clone());
    let conjugate = |z: &Gaussian<R>| Poly::constant(z.conj());
    match leg {
        LegNumbers::Circle { alpha, beta, length } => {
            let square = Poly::constant(Gaussian::real(length.clone() * length.clone()));
            let outward = u + theta.clone() * number(beta) - number(alpha);
            let formal = theta.clone() * v + conjugate(beta) - theta.clone() * conjugate(alpha);
            outward * formal - theta * square
        }
        LegNumbers::Line { alpha, beta, normal } => {
            let outward = theta.clone() * (u + theta.clone() * number(beta) - number(alpha));
            let formal = theta.clone() * v + conjugate(beta) - theta * conjugate(alpha);
            conjugate(normal) * outward + number(normal) * formal
        }
        LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
            let outward = number(alpha) - u - theta.clone() * number(beta);
            let formal = theta.clone() * conjugate(alpha) - theta.clone() * v - conjugate(beta);
            let offset = Poly::constant(Gaussian::real(delta.clone() + delta.clone()));
            conjugate(normal) * outward + theta.clone() * number(normal) * formal - theta * offset
        }
    }
}

/// The plan from the constraint polynomials of a triad to its eliminant: in `theta`, or in `v` where the orientation is given.
///
/// With an RR leg as reference `f1`, the others become rows linear in `u` and `v` (`theta f1` subtracted from those that are RR):
/// `R1 = Res_u(row, row')`, `R2 = Res_u(f1, row)`, `T = Res_v(R1, R2)`. Without, all are rows: `R1 = Res_u(row, row')`,
/// `R2 = Res_u(row, row'')`, `T = Res_v(R1, R2)`. A given rotation is put into the rows by `Res_theta`, and one resultant less
/// is left to do. Degrees are formal, so that rows which lose `u` or `v` do not change the result.
///
/// **Source**: the choice of steps and factors is ours; the derivations `triad_sextic` and `degree_table` show both.
pub fn sylvester_plan<R: Domain>(legs: &[LegNumbers<R>], system: &System<Gaussian<R>>) -> Plan<Gaussian<R>> {
    let theta = Poly::<Gaussian<R>>::variable(2);
    let labels: Vec<&str> = system.equations().iter().map(|(label, _)| label.as_str()).collect();
    let rotations = &labels[legs.len()..];
    let kinds = legs.iter().map(LegNumbers::name).chain(rotations.iter().map(|_| "PP"));
    let degree = triad_degree(&kinds.collect::<Vec<_>>()).expect("three legs of known kinds");
    if let [first, second, ..] = rotations {
        return Plan::new("v").of_degree(degree).resultant("T", (*first, *second), "theta");
    }
    let circular = matches!(legs[0], LegNumbers::Circle { .. });
    let mut plan = Plan::new(if rotations.is_empty() { "theta" } else { "v" }).of_degree(degree);
    let names = ["row 1", "row 2", "row 3"];
    for (i, leg) in legs.iter().enumerate().skip(usize::from(circular)) {
        let of_leg = (Poly::one(), labels[i]);
        plan = match leg {
            LegNumbers::Circle { .. } => plan.combine(names[i], [of_leg, (-theta.clone(), labels[0])]),
            _ => plan.combine(names[i], [of_leg]),
        };
    }
    if let [rotation] = rotations {
        let turned = ["row 1 at phi", "row 2 at phi"];
        for i in usize::from(circular)..2 {
            plan = plan.resultant_formal(turned[i], (*rotation, 1), (names[i], 2), "theta");
        }
        let first = if circular { labels[0] } else { turned[0] };
        return plan.resultant_formal("T", (first, 1), (turned[1], 1), "u");
    }
    // The row used twice must hold u: coincident pivots can cost a row its unknowns.
    let holds_u = |i: usize| match &legs[i] {
        LegNumbers::Circle { alpha, beta, .. } => !(alpha.is_zero() && beta.is_zero()),
        _ => true,
    };
    let (twice, once, third) = if circular {
        let (twice, once) = if holds_u(1) { (1, 2) } else { (2, 1) };
        (names[twice], names[once], labels[0])
    } else {
        (names[0], names[1], names[2])
    };
    plan = plan
        .resultant_formal("R1", (twice, 1), (once, 1), "u")
        .resultant_formal("R2", (third, 1), (twice, 1), "u")
        .resultant_formal("T", ("R1", 1), ("R2", if circular { 2 } else { 1 }), "v");
    if !circular || holds_u(1) || holds_u(2) {
        plan = plan.remove_coefficient("T", twice, ("u", 1), Power::Exactly(1));
    }
    // Each row carries one theta; T is of degree two in each of two rows, or one in each of three.
    let rows = if circular { 4 } else { 3 };
    plan.remove("T", theta, Power::Exactly((rows - degree / 2) as u32), "theta")
}

impl Triad {
    /// The closures of the triad as polynomials: one per leg, without square roots, labelled with the joint each came from.
    ///
    /// **Shape**: variables `u`, `v`, `theta` (see [`constraint_system`]), coefficients exact. **Units**: lengths times a power of two
    /// that makes them integers. A given rotation stands for the angle to within one unit in its last place.
    ///
    /// ```
    /// use assur::{Dyad, Triad, nalgebra::Vector2};
    /// let leg = |x: f64| Dyad::PR { a: Vector2::new(x, 0.0), u: Vector2::new(1.0, x), b: Vector2::new(0.0, x) };
    /// let triad = Triad::new([leg(1.0), leg(2.0), Dyad::PP { phi: 0.5 }])?;
    /// let system = triad.constraints();
    /// assert_eq!(system.equations()[1].0, "leg 2, joint B2 on its base line");
    /// assert_eq!(system.equations()[2].0, "leg 3, orientation given");
    /// # Ok::<(), assur::TriadError>(())
    /// ```
    pub fn constraints(&self) -> System<Gaussian<Integer>> {
        let (numbers, rotations, names) = self.exact_numbers();
        constraint_system(&numbers.legs, &rotations, names)
    }

    /// The eliminant of the triad by the reference route: constraint polynomials, Sylvester resultants, named factors removed.
    ///
    /// **Shape**: a polynomial over the Gaussian integers of formal degree [`Triad::degree`]: in `theta`, where it is `theta^order` times
    /// the consistency polynomial up to a constant, or in `v` where a PP leg gives the orientation. **Cost**: about 0.3 ms.
    ///
    /// # Errors
    /// None for a valid triad; a failing step would be a bug of the plan.
    ///
    /// ```
    /// use assur::{Dyad, Triad, nalgebra::Vector2};
    /// let leg = |x: f64, y: f64| Dyad::RR { a: Vector2::new(x, y), b: Vector2::new(y, x + 0.5), length: 2.0 };
    /// let triad = Triad::new([leg(0.0, 1.0), leg(3.0, 0.5), leg(1.0, 4.0)])?;
    /// let eliminant = triad.eliminant()?;
    /// assert_eq!(eliminant.polynomial.degree(), Some(6));
    /// assert_eq!(eliminant.removed[0].factor.name, "coefficient of u in row 2");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn eliminant(&self) -> Result<Eliminant<Gaussian<Integer>>, EliminateError> {
        let (numbers, rotations, names) = self.exact_numbers();
        let system = constraint_system(&numbers.legs, &rotations, names);
        eliminate(&system, &sylvester_plan(&numbers.legs, &system))
    }

    fn exact_numbers(&self) -> (TriadNumbers, Vec<RotationNumbers<Integer>>, [usize; 3]) {
        let numbers = TriadNumbers::of(self.legs());
        let mut order = numbers.order.clone();
        let mut rotations = Vec::new();
        for (number, leg) in self.legs().iter().enumerate() {
            if let Dyad::PP { phi } = leg {
                order.push(number);
                rotations.push(rotation_numbers(*phi));
            }
        }
        (numbers, rotations, [0, 1, 2].map(|i: usize| order[i] + 1))
    }
}

/// The exact rotation that stands for an angle, as a quotient of integers.
fn rotation_numbers(phi: f64) -> RotationNumbers<Integer> {
    let rotation = exact_rotation(phi);
    let scale = Integer::from(rotation.re.denominator().clone()) * Integer::from(rotation.im.denominator().clone());
    let part = |x: &Rational| (x.clone() * Rational::from(scale.clone())).numerator().clone();
    RotationNumbers { turn: rotation.map(part), scale }
}

/// The eliminant of three legs without PP as a trigonometric polynomial, real on the unit circle.
pub(super) fn reference_consistency(legs: &[LegNumbers<Integer>; 3], order: usize) -> Trig<Integer> {
    let system = constraint_system(legs, &[], [1, 2, 3]);
    let eliminant = eliminate(&system, &sylvester_plan(legs, &system)).expect("the plan suits every triad without PP");
    // Three linear rows leave it purely imaginary on the unit circle; a factor i mends that.
    let i = Gaussian::new(Integer::ZERO, Integer::ONE);
    let p = &eliminant.polynomial;
    Trig::from_theta(p, order)
        .or_else(|| Trig::from_theta(&p.scaled(&i), order))
        .expect("the eliminant of real legs is real on the unit circle")
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;
    use crate::linkage::{Offset, consistency};

    /// The dyads, with small integers that depend on `seed`.
    fn dyad(kind: &str, seed: i64) -> Dyad {
        let n = |k: i64| ((seed * seed * 31 + seed * k * 17 + k * k * 5) % 97 - 48) as f64;
        let point = |k: i64| Vector2::new(n(k), n(k + 1));
        match kind {
            "RR" => Dyad::RR { a: point(1), b: point(5), length: 5.0 + n(9).abs() },
            "PR" => Dyad::PR { a: point(2), u: Vector2::new(1.0 + n(3).abs(), n(4)), b: point(6) },
            "RP" => Dyad::RP {
                a: point(3),
                b: point(7),
                v: Vector2::new(n(8), 1.0 + n(2).abs()),
                offset: Offset::TimesDirection(n(4)),
            },
            _ => Dyad::PP { phi: 0.1 * n(5) },
        }
    }

    #[test]
    fn the_sylvester_route_gives_the_closed_form_for_every_triad_without_pp() {
        let kinds = ["RR", "PR", "RP"];
        for seed in 1..20 {
            for triple in 0..27 {
                let triad = [triple / 9, triple / 3 % 3, triple % 3];
                let legs = [0, 1, 2].map(|i: usize| dyad(kinds[triad[i]], seed + 7 * i as i64));
                let triad = Triad::new(legs).expect("valid");
                let numbers = TriadNumbers::of(triad.legs());
                let legs = <&[LegNumbers<Integer>; 3]>::try_from(&numbers.legs[..]).expect("three legs");
                let order = triad.order().expect("no PP");
                let symbols = legs.each_ref().map(|leg| leg.map(|x| Trig::constant(x.clone())));
                let closed = consistency(&symbols, &Trig::cosine(), &Trig::sine());
                let route = reference_consistency(legs, order);
                assert_eq!(closed.vanishes(), route.vanishes());
                let (p, q) = (closed.half_angle(order).primitive(), route.half_angle(order).primitive());
                assert_eq!(p, q, "{} seed {seed}", triad.name());
            }
        }
    }

    #[test]
    fn a_leg_given_twice_loses_its_row_and_nothing_else() {
        let leg = |length| Dyad::RR { a: Vector2::new(1.0, 2.0), b: Vector2::new(3.0, -1.0), length };
        let other = dyad("RR", 5);
        let twice = Triad::new([leg(2.0), leg(2.0), other]).expect("valid");
        assert!(twice.eliminant().expect("the plan suits it").polynomial.vanishes());
        let contradictory = Triad::new([leg(2.0), leg(3.0), other]).expect("valid");
        assert!(!contradictory.eliminant().expect("the plan suits it").polynomial.vanishes());
    }

    #[test]
    fn a_given_orientation_leaves_the_positions() {
        for (kinds, degree) in
            [(["RR", "RR", "PP"], 2), (["RR", "PP", "RP"], 2), (["PP", "PR", "RP"], 1), (["PR", "PP", "PP"], 0)]
        {
            for seed in 1..20 {
                let legs = [0, 1, 2].map(|i: usize| dyad(kinds[i], seed + 7 * i as i64));
                let triad = Triad::new(legs).expect("valid");
                let eliminant = triad.eliminant().expect("the plan suits it");
                assert_eq!(eliminant.degree_bound, degree);
                assert_eq!(eliminant.polynomial.degree(), Some(degree), "{} seed {seed}", triad.name());
            }
        }
    }
}
