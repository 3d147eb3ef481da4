//! What is special about a triad's shape? Decided exactly on its numbers.

use super::assemblies::Special;
use super::group::Dyad;
use super::numbers::TriadNumbers;
use super::triad::LegNumbers;
use crate::algebra::{Domain, Gaussian, Integer};

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
