//! Triads with a PP leg: the orientation is given, what is left is a line and a circle, or two lines.
//!
//! A rotation by an angle in `f64` is taken as the exact rational rotation with `tan(phi/2)` that `f64` nearest to the
//! angle's (within one unit in the last place of `phi`), so everything below is decided over the rationals. The multiples of
//! pi/2, as `f64` has them, are quarter turns exactly, as they are in a placement.

use std::f64::consts::FRAC_PI_2;

use num_complex::Complex64;

use super::place::Solution;
use super::triad::{LegNumbers, Row, leg_row};
use crate::algebra::{Domain, Gaussian, Integer, Rational, dyadic, nearest_f64};

/// What a triad with the orientation `phi` given comes to.
#[derive(Debug)]
pub(super) enum Given {
    /// Isolated solutions with their multiplicities.
    Isolated(Vec<(Solution, usize)>),
    /// The rows contradict each other: the pose has run to infinity.
    AtInfinity,
    /// A curve of poses.
    Curve,
}

/// The exact rotation that stands for an angle: cosine and sine, rational.
pub(super) fn exact_rotation(phi: f64) -> Gaussian<Rational> {
    let turns = (phi / FRAC_PI_2).round();
    if turns * FRAC_PI_2 == phi {
        let whole = |re: i64, im: i64| Gaussian::new(Rational::from(re), Rational::from(im));
        return match turns.rem_euclid(4.0) {
            1.0 => whole(0, 1),
            2.0 => whole(-1, 0),
            3.0 => whole(0, -1),
            _ => whole(1, 0),
        };
    }
    // Reduced to (-pi, pi]; there tan(phi/2) is finite for every f64 but may be huge, which is harmless here.
    let reduced = phi.sin().atan2(phi.cos());
    let principal = if phi.abs() <= std::f64::consts::PI { phi } else { reduced };
    let t = dyadic((principal / 2.0).tan()).expect("no f64 is an odd multiple of pi/2");
    let one = Rational::ONE;
    let square = t.clone() * t.clone();
    let w = one.clone() + square.clone();
    Gaussian::new((one - square) / w.clone(), t * Rational::from(2) / w)
}

/// Solves two legs at a rotation. Lengths of the result are in units of `2^exponent` of the integers' unit.
pub(super) fn assemble_two(legs: &[LegNumbers<Integer>], rotation: &Gaussian<Rational>, exponent: i64) -> Given {
    let unit = if exponent >= 0 {
        Rational::from_parts(Integer::ONE, dashu_int::UBig::ONE << exponent as usize)
    } else {
        Rational::from(Integer::ONE << (-exponent) as usize)
    };
    let theta = Complex64::new(nearest_f64(&rotation.re), nearest_f64(&rotation.im));
    let rational = legs.iter().map(|leg| leg.map(|x| Rational::from(x.clone()))).collect::<Vec<_>>();
    let (c, s) = (&rotation.re, &rotation.im);
    let solution = |u: [Complex64; 2], real, twin| Solution { theta, u, real, twin };
    match &rational[0] {
        LegNumbers::Circle { length, .. } => {
            let Row { g, e } = leg_row(&rational[1], length, c, s);
            let g_g = g.norm_sqr();
            if g_g.is_zero() {
                return match (e.is_zero(), length.is_zero()) {
                    (false, _) => Given::AtInfinity,
                    (true, false) => Given::Curve,
                    (true, true) => Given::Isolated(vec![(solution([Complex64::ZERO; 2], true, false), 2)]),
                };
            }
            // u = -e g/g·g ± i g sqrt(discriminant)/g·g
            let discriminant = length.clone() * length.clone() * g_g.clone() - e.clone() * e.clone();
            let foot = g.scaled(&(-e / g_g.clone() * unit.clone())).map(nearest_f64);
            let foot = Complex64::new(foot.re, foot.im);
            let ratio = discriminant / (g_g.clone() * g_g) * unit.clone() * unit;
            let along = |part: &Rational| {
                let size = nearest_f64(&(part.clone() * part.clone() * ratio.clone())).abs().sqrt();
                if *part < Rational::ZERO { -size } else { size }
            };
            let offset = Complex64::new(along(&g.re), along(&g.im));
            if ratio.is_zero() {
                Given::Isolated(vec![(solution([foot, foot.conj()], true, false), 2)])
            } else {
                let real = ratio > Rational::ZERO;
                let at = |sign: f64| {
                    if real {
                        let u = foot + Complex64::I * sign * offset;
                        [u, u.conj()]
                    } else {
                        [foot - sign * offset, foot.conj() + sign * offset.conj()]
                    }
                };
                Given::Isolated([1.0, -1.0].map(|sign| (solution(at(sign), real, true), 1)).to_vec())
            }
        }
        _ => {
            let [p, q] = [0, 1].map(|i: usize| leg_row(&rational[i], &Rational::ZERO, c, s));
            let cross = p.cross(&q);
            if !cross.is_zero() {
                // g_p·u = -e_p, g_q·u = -e_q
                let u = q.mismatch(&p).map(|part| nearest_f64(&(part.clone() / cross.clone() * unit.clone())));
                // e_q g_p - e_p g_q, turned by a quarter.
                let u = Complex64::new(u.im, -u.re);
                return Given::Isolated(vec![(solution([u, u.conj()], true, false), 1)]);
            }
            if Domain::is_zero(&p.mismatch(&q)) { Given::Curve } else { Given::AtInfinity }
        }
    }
}

/// Whether two angles are the same orientation, as exactly as their half-angle tangents tell.
pub(super) fn same_orientation(phi: f64, other: f64) -> bool {
    exact_rotation(phi) == exact_rotation(other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Ring;

    #[test]
    fn rotations_are_exactly_unit_and_near_their_angle() {
        for phi in [0.0, 0.5, -2.0, 3.0, std::f64::consts::PI, -std::f64::consts::PI, 1e-300, 7.0, 1e6] {
            let r = exact_rotation(phi);
            assert_eq!(r.norm_sqr(), Rational::ONE);
            assert!((nearest_f64(&r.re) - phi.cos()).abs() < 3e-16, "{phi}");
            assert!((nearest_f64(&r.im) - phi.sin()).abs() < 3e-16, "{phi}");
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        let whole = |re: i64, im: i64| Gaussian::new(Rational::from(re), Rational::from(im));
        let turns = [whole(1, 0), whole(0, 1), whole(-1, 0), whole(0, -1)];
        for n in -9_i32..=9 {
            assert_eq!(exact_rotation(f64::from(n) * FRAC_PI_2), turns[n.rem_euclid(4) as usize]);
        }
        assert!(!same_orientation(FRAC_PI_2, 1.5707963267948963));
    }

    #[test]
    fn two_lines_meet_where_they_should() {
        let int = |x: i64| Integer::from(x);
        let line = |n: (i64, i64), alpha: (i64, i64)| LegNumbers::Line {
            alpha: Gaussian::new(int(alpha.0), int(alpha.1)),
            beta: Gaussian::zero(),
            normal: Gaussian::new(int(n.0), int(n.1)),
        };
        // x = 3 and x + 2y = 11 meet in (3, 4).
        let legs = [line((1, 0), (3, 0)), line((1, 2), (11, 0))];
        let Given::Isolated(found) = assemble_two(&legs, &exact_rotation(0.7), 0) else { panic!("one crossing") };
        assert_eq!(found[0].0.u[0], Complex64::new(3.0, 4.0));
    }
}
