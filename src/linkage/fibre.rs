//! What lies above a root of T? Decided exactly, for every root at once.
//!
//! `T(phi) = 0` says that the rows are consistent as far as determinants can tell. Above most roots lies one pose. Above a
//! root where the rows turn parallel there may be two poses (twin poses), a whole curve of them, or none. The
//! question is algebraic, so it needs no tolerance: a square-free part of `T` is split by greatest common divisors with
//! the polynomials whose vanishing makes the difference. For a generic triad one modular division shows that nothing is to
//! be split.

use super::assemblies::RejectionReason;
use super::triad::Rows;
use crate::algebra::{Domain, Gaussian, Integer, Ring, Trig, UPoly};

/// What lies above a root of `T`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fibre {
    /// One pose: two rows cross.
    Point,
    /// The rows are one line, which meets the reference circle in two points: twin poses.
    Pair,
    /// The line touches the circle: one pose.
    Tangent,
    /// The line is isotropic and meets the circle once.
    IsotropicPoint,
    /// The rows vanish and the circle has radius zero: its centre is the one real pose.
    Centre,
    /// A curve of poses with this orientation.
    Curve,
    /// No finite pose.
    Empty(RejectionReason),
}

/// A rational chart of the circle of orientations: `t = tan((phi - phi0)/2)`, `tan(phi0/2) = tau`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chart {
    tau: i64,
}

/// Some roots of `T`, all alike: a square-free factor in the chart, how often `T` has it, and what lies above its roots.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Square-free polynomial in the chart's `t`; no root at infinity and none at `±i`.
    pub in_chart: UPoly<Integer>,
    /// The same roots in `theta`.
    pub in_theta: UPoly<Gaussian<Integer>>,
    /// Multiplicity in `T`.
    pub multiplicity: usize,
    /// What lies above each of these roots.
    pub fibre: Fibre,
    /// The chart of `in_chart`.
    pub chart: Chart,
}

impl Chart {
    /// A chart in which `f`, not zero, has no root at infinity.
    pub fn without_infinity(f: &Trig<Integer>) -> Self {
        let order = f.order();
        let tau = (0..).find(|&tau| f.half_angle_about(order, tau).degree() == Some(2 * order));
        Self { tau: tau.expect("a polynomial has finitely many roots and there are infinitely many charts") }
    }

    /// `tan(phi0/2)` of the chart's origin.
    pub fn tau(self) -> i64 {
        self.tau
    }

    /// `f` in this chart; its roots at `theta = 0` and infinity, the factors `1 + t²`, removed by using its exact order.
    pub fn polynomial(&self, f: &Trig<Integer>) -> UPoly<Integer> {
        f.half_angle_about(f.order(), self.tau)
    }

    /// A polynomial of this chart in `theta`: with `t = -i(theta' - 1)/(theta' + 1)` and `theta' = theta·e^(-i phi0)`.
    pub fn to_theta(self, in_chart: &UPoly<Integer>) -> UPoly<Gaussian<Integer>> {
        let g = |re: i64, im: i64| Gaussian::new(Integer::from(re), Integer::from(im));
        // theta' = theta (1 - i tau)/(1 + i tau), cleared of its denominator.
        let turned = g(1, -self.tau);
        let back = g(1, self.tau);
        let numerator = UPoly::new(vec![-back.clone(), turned.clone()]).scaled(&g(0, -1));
        let denominator = UPoly::new(vec![back, turned]);
        let mut sum = UPoly::zero();
        let mut power = UPoly::one();
        // Homogeneous Horner: sum of c_k numerator^k denominator^(n-k).
        for c in in_chart.coefficients().iter().rev() {
            sum = sum * numerator.clone() + power.scaled(&Gaussian::real(c.clone()));
            power = power * denominator.clone();
        }
        sum
    }
}

/// The roots of a trigonometric polynomial that is not zero, in square-free parts with what lies above them.
///
/// Roots at `theta = 0` and infinity are left out: there are `2·(K - order)` of them for a polynomial of expected order `K`.
pub(super) fn parts(t: &Trig<Integer>, rows: &Rows<Trig<Integer>>) -> Vec<Part> {
    let chart = Chart::without_infinity(t);
    let mut out = Vec::new();
    for (factor, multiplicity) in chart.polynomial(t).square_free() {
        for (in_chart, fibre) in split_by_fibre(factor, chart, rows) {
            if in_chart.degree().unwrap_or(0) > 0 {
                let in_theta = chart.to_theta(&in_chart);
                out.push(Part { in_chart, in_theta, multiplicity, fibre, chart });
            }
        }
    }
    out
}

/// The roots of `t` in square-free parts, where one and the same lies above all of them.
pub(super) fn parts_alike(t: &Trig<Integer>, fibre: Fibre) -> Vec<Part> {
    let chart = Chart::without_infinity(t);
    let part =
        |(in_chart, multiplicity)| Part { in_theta: chart.to_theta(&in_chart), in_chart, multiplicity, fibre, chart };
    chart.polynomial(t).square_free().into_iter().map(part).collect()
}

fn split_by_fibre(factor: UPoly<Integer>, chart: Chart, rows: &Rows<Trig<Integer>>) -> Vec<(UPoly<Integer>, Fibre)> {
    let split = |p: UPoly<Integer>, by: &[Trig<Integer>]| split(p, by.iter().map(|f| chart.polynomial(f)));
    match rows {
        Rows::Circle { radius, rows: [second, third] } => {
            let (parallel, crossing) = split(factor, &[second.cross(third)]);
            if parallel.degree() == Some(0) {
                return vec![(crossing, Fibre::Point)];
            }
            let vectors = [&second.g.re, &second.g.im, &third.g.re, &third.g.im].map(Clone::clone);
            let constants = [second.e.clone(), third.e.clone()];
            let (vanishing, line) = split(parallel, &vectors);
            let (free, contradictory) = split(vanishing, &constants);
            let mismatch = second.mismatch(third);
            let (line, separate) = split(line, &[mismatch.re, mismatch.im]);
            // Normals k_i = theta beta_i - alpha_i that lose one of their isotropic parts together: theta is the ratio of similar platforms.
            let (similar, separate) = split(separate, &[second.g.norm_sqr(), third.g.norm_sqr()]);
            let (isotropic, line) = split(line, &[second.g.norm_sqr(), third.g.norm_sqr()]);
            let (through_centre, isotropic) = split(isotropic, &constants);
            let discriminants = [second, third]
                .map(|row| radius.clone() * radius.clone() * row.g.norm_sqr() - row.e.clone() * row.e.clone());
            let (tangent, pair) = split(line, &discriminants);
            let centre = radius.vanishes();
            vec![
                (crossing, Fibre::Point),
                (free, if centre { Fibre::Centre } else { Fibre::Curve }),
                (contradictory, Fibre::Empty(RejectionReason::SimilarPlatforms)),
                (similar, Fibre::Empty(RejectionReason::SimilarPlatforms)),
                (separate, Fibre::Empty(RejectionReason::ParallelRows)),
                (through_centre, if centre { Fibre::Curve } else { Fibre::Empty(RejectionReason::IsotropicLine) }),
                (isotropic, Fibre::IsotropicPoint),
                (tangent, Fibre::Tangent),
                (pair, Fibre::Pair),
            ]
        }
        Rows::Lines(rows) => {
            let pairs = [(0, 1), (0, 2), (1, 2)].map(|(i, j): (usize, usize)| (&rows[i], &rows[j]));
            let (parallel, crossing) = split(factor, &pairs.map(|(p, q)| p.cross(q)));
            if parallel.degree() == Some(0) {
                return vec![(crossing, Fibre::Point)];
            }
            let mismatches: Vec<Trig<Integer>> = pairs
                .iter()
                .flat_map(|(p, q)| {
                    let mismatch = p.mismatch(q);
                    [mismatch.re, mismatch.im]
                })
                .collect();
            let (same_line, separate) = split(parallel, &mismatches);
            vec![
                (crossing, Fibre::Point),
                (same_line, Fibre::Curve),
                (separate, Fibre::Empty(RejectionReason::ParallelRows)),
            ]
        }
    }
}

/// `p` as the product of what it has in common with all of `by`, and the rest.
fn split(p: UPoly<Integer>, by: impl Iterator<Item = UPoly<Integer>>) -> (UPoly<Integer>, UPoly<Integer>) {
    let common = by.fold(p.clone(), |common, f| if common.degree() == Some(0) { common } else { common.gcd(&f) });
    if common.degree() == Some(0) {
        return (UPoly::one(), p);
    }
    let rest = p.exact_div(&common).expect("a primitive common divisor divides");
    (common, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn charts_avoid_roots_at_their_infinity_and_lead_to_the_same_theta() {
        // cos phi + 1 has the double root pi.
        let f = Trig::<Integer>::cosine() + Trig::one();
        let chart = Chart::without_infinity(&f);
        assert_ne!(chart.tau, 0);
        let parts = chart.polynomial(&f).square_free();
        assert_eq!(parts.len(), 1);
        assert_eq!(parts[0].1, 2);
        let in_theta = chart.to_theta(&parts[0].0);
        let minus_one = -Gaussian::<Integer>::one();
        assert_eq!(in_theta.evaluate(&minus_one), Gaussian::zero());
        assert_eq!(in_theta.degree(), Some(1));
    }

    #[test]
    fn the_theta_polynomial_of_a_chart_is_that_of_the_trigonometric_polynomial() {
        let f = Trig::<Integer>::cosine() * Trig::sine() + Trig::from_int(3) * Trig::sine() - Trig::from_int(2);
        let chart = Chart { tau: 2 };
        let left = chart.to_theta(&chart.polynomial(&f));
        let right = f.theta(2);
        // Equal up to a constant: cross products of coefficients vanish.
        let (l, r) = (left.leading().unwrap().clone(), right.leading().unwrap().clone());
        for k in 0..5 {
            assert_eq!(left.coefficient(k) * r.clone(), right.coefficient(k) * l.clone());
        }
    }
}
