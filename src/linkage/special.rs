//! What is special about a triad's shape? Decided exactly on its numbers.

use dashu_int::ops::BitTest;

use super::assemblies::Special;
use super::group::{Dyad, Triad};
use super::numbers::TriadNumbers;
use super::triad::LegNumbers;
use crate::algebra::{Domain, Gaussian, Integer, ratio_to_f64, scale_by_power_of_two};

impl Triad {
    /// The special shapes of the triad itself, decided exactly: what [`Triad::assemble`] names before it looks for poses.
    ///
    /// ```
    /// use assur::{Dyad, Special, Triad, nalgebra::Vector2};
    /// let leg = |x: f64| Dyad::RR { a: Vector2::new(x, 0.0), b: Vector2::new(2.0 * x, 1.0), length: 3.0 };
    /// let shapes = Triad::new([leg(0.0), leg(1.0), leg(4.0)])?.special_shapes();
    /// assert_eq!(shapes, [Special::SimilarPlatforms, Special::CollinearBase, Special::CollinearPlatform]);
    /// # Ok::<(), assur::TriadError>(())
    /// ```
    pub fn special_shapes(&self) -> Vec<Special> {
        special_shapes(self.legs(), &TriadNumbers::of(self.legs()))
    }
}

/// The special shapes of a triad, in no order, each once.
pub(super) fn special_shapes(legs: &[Dyad], numbers: &TriadNumbers) -> Vec<Special> {
    let mut out = Vec::new();
    let mut note = |holds: bool, special: Special| {
        if holds {
            out.push(special);
        }
    };
    let circles: Vec<(&Gaussian<Integer>, &Gaussian<Integer>, &Integer)> = numbers
        .legs
        .iter()
        .filter_map(|leg| match leg {
            LegNumbers::Circle { alpha, beta, length } => Some((alpha, beta, length)),
            _ => None,
        })
        .collect();
    let pairs = |n: usize| (0..n).flat_map(move |i| (0..i).map(move |j| (i, j)));
    note(circles.iter().any(|(_, _, length)| length.is_zero()), Special::ZeroLength);
    note(
        pairs(circles.len()).any(|(i, j)| circles[i].0 == circles[j].0 || circles[i].1 == circles[j].1),
        Special::CoincidentPivots,
    );
    if let [(a0, b0, _), (a1, b1, _), (a2, b2, _)] = circles[..] {
        let less = |p: &Gaussian<Integer>, q: &Gaussian<Integer>| p.clone() - q.clone();
        let (alpha, beta) = ([less(a1, a0), less(a2, a0)], [less(b1, b0), less(b2, b0)]);
        let extended = |v: &[Gaussian<Integer>; 2]| v.iter().any(|p| !p.is_zero());
        let similar = extended(&alpha)
            && extended(&beta)
            && alpha[0].clone() * beta[1].clone() == alpha[1].clone() * beta[0].clone();
        let congruent = similar && (0..2).all(|i| alpha[i].norm_sqr() == beta[i].norm_sqr());
        note(similar, Special::SimilarPlatforms);
        note(congruent, Special::CongruentPlatforms);
    }
    let collinear = |points: Vec<&Gaussian<Integer>>| match points[..] {
        [p, q, r] => {
            let distinct = p != q && q != r && r != p;
            distinct && (q.clone() - p.clone()).cross(&(r.clone() - p.clone())).is_zero()
        }
        _ => false,
    };
    let base_pivots = numbers.legs.iter().filter_map(|leg| match leg {
        LegNumbers::Circle { alpha, .. } | LegNumbers::PlatformLine { alpha, .. } => Some(alpha),
        LegNumbers::Line { .. } => None,
    });
    let platform_pivots = numbers.legs.iter().filter_map(|leg| match leg {
        LegNumbers::Circle { beta, .. } | LegNumbers::Line { beta, .. } => Some(beta),
        LegNumbers::PlatformLine { .. } => None,
    });
    note(collinear(base_pivots.collect()), Special::CollinearBase);
    note(collinear(platform_pivots.collect()), Special::CollinearPlatform);
    let parallel =
        |normals: Vec<&Gaussian<Integer>>| pairs(normals.len()).any(|(i, j)| normals[i].cross(normals[j]).is_zero());
    let on_base = numbers.legs.iter().filter_map(|leg| match leg {
        LegNumbers::Line { normal, .. } => Some(normal),
        _ => None,
    });
    let on_platform = numbers.legs.iter().filter_map(|leg| match leg {
        LegNumbers::PlatformLine { normal, .. } => Some(normal),
        _ => None,
    });
    let translating = legs.iter().filter(|leg| matches!(leg, Dyad::PP { .. })).count();
    let sliders_parallel = parallel(on_base.collect()) || parallel(on_platform.collect()) || translating > 1;
    note(sliders_parallel, Special::ParallelSliders);
    out
}

/// A special shape that a triad does not have, exactly, but is within 1e-12 of.
///
/// Decimals such as 0.1 are not what they look like in binary: a platform drawn similar to its base is often not, and its answer is not that of similar
/// platforms. This says so, with the distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearMiss {
    /// The shape missed.
    pub special: Special,
    /// By how much: relative to the lengths compared, or the sine of an angle. Never 0; below 2.2e-308 the digits of `f64` run out, and 5e-324 stands for anything
    /// smaller.
    pub distance: f64,
}

/// Closer than this, a shape is worth a word. Far above what rounding decimals to `f64` does, far below any tolerance of manufacture.
const NEAR: f64 = 1e-12;

/// The square root of a ratio of integers that are not negative, the second not zero; not 0 unless the first is, though it be too small for `f64`.
fn root_of_ratio(numerator: &Integer, denominator: &Integer) -> f64 {
    if numerator.is_zero() {
        return 0.0;
    }
    let size = |n: &Integer| n.bit_len() as i64;
    // Half an even exponent, since the ratio itself may leave the range of f64 where its root does not.
    let half = (size(numerator) - size(denominator)).div_euclid(2);
    scale_by_power_of_two(ratio_to_f64(numerator, denominator, -2 * half).sqrt(), half).max(f64::from_bits(1))
}

/// The special shapes nearly had.
pub(super) fn near_misses(numbers: &TriadNumbers) -> Vec<NearMiss> {
    let mut out: Vec<NearMiss> = Vec::new();
    let mut note = |special: Special, miss_squared: Integer, scale_squared: Integer| {
        if miss_squared.is_zero() || scale_squared.is_zero() {
            return;
        }
        let distance = root_of_ratio(&miss_squared, &scale_squared);
        if distance < NEAR {
            match out.iter_mut().find(|near| near.special == special) {
                Some(near) => near.distance = near.distance.min(distance),
                None => out.push(NearMiss { special, distance }),
            }
        }
    };
    let less = |p: &Gaussian<Integer>, q: &Gaussian<Integer>| p.clone() - q.clone();
    let (mut circles, mut base, mut platform, mut on_base, mut on_platform) = (vec![], vec![], vec![], vec![], vec![]);
    for leg in &numbers.legs {
        match leg {
            LegNumbers::Circle { alpha, beta, length } => {
                circles.push((alpha, beta, length));
                base.push(alpha);
                platform.push(beta);
            }
            LegNumbers::Line { beta, normal, .. } => {
                platform.push(beta);
                on_base.push(normal);
            }
            LegNumbers::PlatformLine { alpha, normal, .. } => {
                base.push(alpha);
                on_platform.push(normal);
            }
        }
    }
    let pairs = |n: usize| (0..n).flat_map(move |i| (0..i).map(move |j| (j, i)));
    let spans =
        |points: &[&Gaussian<Integer>]| pairs(points.len()).map(|(i, j)| less(points[i], points[j]).norm_sqr()).max();
    let size = spans(&base).into_iter().chain(spans(&platform)).chain(circles.iter().map(|c| c.2 * c.2)).max();
    let size = size.unwrap_or(Integer::ZERO);
    for (_, _, length) in &circles {
        note(Special::ZeroLength, *length * *length, size.clone());
    }
    for (i, j) in pairs(circles.len()) {
        note(Special::CoincidentPivots, less(circles[i].0, circles[j].0).norm_sqr(), size.clone());
        note(Special::CoincidentPivots, less(circles[i].1, circles[j].1).norm_sqr(), size.clone());
    }
    if let [p, q, r] = circles[..] {
        let (a, b) = ([less(q.0, p.0), less(r.0, p.0)], [less(q.1, p.1), less(r.1, p.1)]);
        let mismatch = (a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone()).norm_sqr();
        let scale = (a[0].norm_sqr() * b[1].norm_sqr()).max(a[1].norm_sqr() * b[0].norm_sqr());
        let similar = !scale.is_zero() && root_of_ratio(&mismatch, &scale) < NEAR;
        note(Special::SimilarPlatforms, mismatch, scale);
        let unequal = [0, 1].map(|k: usize| a[k].norm_sqr() - b[k].norm_sqr());
        let unequal = unequal.into_iter().max_by_key(|d| d * d).unwrap_or(Integer::ZERO);
        let sides = a.iter().map(Gaussian::norm_sqr).max().unwrap_or(Integer::ZERO);
        if similar {
            // Differences of squares are twice those of lengths.
            note(Special::CongruentPlatforms, &unequal * &unequal, Integer::from(4) * &sides * &sides);
        }
    }
    for (special, points) in [(Special::CollinearBase, &base), (Special::CollinearPlatform, &platform)] {
        if let [p, q, r] = points[..] {
            let (u, v) = (less(q, p), less(r, p));
            let cross = u.cross(&v);
            note(special, &cross * &cross, u.norm_sqr() * v.norm_sqr());
        }
    }
    for normals in [&on_base, &on_platform] {
        for (i, j) in pairs(normals.len()) {
            let cross = normals[i].cross(normals[j]);
            note(Special::ParallelSliders, &cross * &cross, normals[i].norm_sqr() * normals[j].norm_sqr());
        }
    }
    out.sort_by_key(|near| near.special);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_ratios_keep_their_digits_far_below_f64() {
        let power = |n: usize| Integer::ONE << n;
        assert_eq!(root_of_ratio(&Integer::from(9), &power(2000)), 3.0 * 2f64.powi(-1000));
        assert_eq!(root_of_ratio(&Integer::from(2), &power(2001)), 2f64.powi(-1000));
        assert_eq!(root_of_ratio(&Integer::ONE, &power(9000)), 5e-324);
        assert_eq!(root_of_ratio(&Integer::ZERO, &power(9)), 0.0);
    }
}
