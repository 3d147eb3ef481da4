//! What when T vanishes for every orientation? Then the rows never contradict each other as far as determinants can
//! tell, and the group either moves or has no assembly at all. Both are decided over the integers.

use super::assemblies::SelfMotion;
use super::fibre::Chart;
use super::triad::Rows;
use crate::algebra::{Integer, Ring, Trig, UPoly};
use crate::roots::{FIRST_BITS, NotLocated, isolate_real_roots, locate_on_circle};

/// The curves of poses of a triad whose `T` is identically zero; none means that it has no assembly, real or complex.
///
/// A motion that exists over the complex numbers only is listed with `real: false`.
pub(super) fn motions(rows: &Rows<Trig<Integer>>) -> Result<Vec<SelfMotion>, NotLocated> {
    let turning = |real| vec![SelfMotion { phi: None, real }];
    match rows {
        Rows::Circle { radius, rows } => {
            if !rows[0].cross(&rows[1]).vanishes() {
                // In every orientation the two rows cross, and T = 0 says on the circle.
                return Ok(turning(true));
            }
            // The rows are parallel in every orientation.
            let Some(line) = rows.iter().find(|row| !row.g.norm_sqr().vanishes()) else {
                // Neither restrains the position: their constants decide.
                let free = rows.iter().all(|row| row.e.vanishes());
                return Ok(if free { turning(true) } else { Vec::new() });
            };
            // T = |mismatch|² = 0, so they are one line. Does it meet the circle in any real orientation?
            let margin = radius.clone() * radius.clone() * line.g.norm_sqr() - line.e.clone() * line.e.clone();
            Ok(turning(somewhere_not_negative(&margin)))
        }
        Rows::Lines(rows) => {
            let pairs = [(0, 1), (0, 2), (1, 2)].map(|(i, j): (usize, usize)| (&rows[i], &rows[j]));
            if pairs.iter().any(|(p, q)| !p.cross(q).vanishes()) {
                return Ok(turning(true));
            }
            let mismatches = pairs.iter().flat_map(|(p, q)| {
                let mismatch = p.mismatch(q);
                [mismatch.re, mismatch.im]
            });
            let mismatches: Vec<Trig<Integer>> = mismatches.filter(|m| !m.vanishes()).collect();
            let Some(first) = mismatches.first() else { return Ok(turning(true)) };
            // Three parallel lines are one line only in orientations where every mismatch vanishes.
            let chart = Chart::without_infinity(first);
            let common =
                mismatches.iter().fold(UPoly::zero(), |common: UPoly<Integer>, m| common.gcd(&chart.polynomial(m)));
            let mut out = Vec::new();
            for (factor, _) in common.square_free() {
                for root in locate_on_circle(&chart.to_theta(&factor), &factor, FIRST_BITS)? {
                    let phi = root.on_circle.then(|| root.root.to_complex().arg());
                    out.push(SelfMotion { phi, real: root.on_circle });
                }
            }
            Ok(out)
        }
    }
}

/// Whether a trigonometric polynomial is zero or positive for some angle, exactly.
fn somewhere_not_negative(f: &Trig<Integer>) -> bool {
    let (zero, one) = (Integer::ZERO, Integer::ONE);
    let at = |cosine: &Integer| f.evaluate(Clone::clone, cosine, &zero);
    if f.vanishes() || at(&one) >= zero || at(&-one.clone()) >= zero {
        return true;
    }
    // Negative at 0 and at pi: only a root in between can change that, and pi is no root.
    f.half_angle(f.order()).square_free().iter().any(|(factor, _)| !isolate_real_roots(factor).is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_are_decided_between_the_samples() {
        let (c, s) = (Trig::<Integer>::cosine(), Trig::sine());
        let n = Trig::from_int;
        // 4 s c - 1 is negative at 0 and pi, positive at pi/4.
        assert!(somewhere_not_negative(&(n(4) * s.clone() * c.clone() - n(1))));
        assert!(!somewhere_not_negative(&(s.clone() * c.clone() - n(1))));
        // s - 1 touches zero at pi/2 only.
        assert!(somewhere_not_negative(&(s - n(1))));
        assert!(somewhere_not_negative(&(-n(1) - c)));
    }
}
