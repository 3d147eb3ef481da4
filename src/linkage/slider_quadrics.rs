//! RP-RP-RP the long way: three quadrics in the sliders, eliminated to a formal octic that is a quartic.
//!
//! The three platform lines form a triangle `B1 B2 B3`, line `i` along the side `e_i = B_(i+1) - B_i`. The base pivot `A_i` lies on line
//! `i`, at the body point `B_i - sigma_i e_i`. Body and base pivots are equally far apart:
//!
//! `|(1 + sigma_i) e_i - sigma_j e_j|² = |A_i A_j|²`, `j = i + 1` cyclic: three quadrics in `(sigma_1, sigma_2)`, `(sigma_2, sigma_3)`, `(sigma_3, sigma_1)`.
//!
//! Counting sliders in sides keeps every number rational, so that the four leading coefficients of the octic vanish exactly, as they do for
//! every triangle that closes (`derivations/rp_rp_rp_octic.rs`); floats leave noise there and with it four spurious huge roots. Distances
//! cannot tell a triangle from its mirror image: two of the four roots build the mirrored platform, and the sign of an area tells.
//!
//! Source: S. Mitsi, K.-D. Bouzakis, G. Mansour, I. Popescu, whose sliders are `s_i = sigma_i |e_i|`. [`Triad::assemble`] is the short
//! way, of degree two; this one checks it.

use dashu_int::ops::Gcd;
use nalgebra::Vector2;
use thiserror::Error;

use super::group::{Dyad, Offset, Pose, Triad};
use crate::algebra::{Integer, Poly, Rational, Ring, UPoly, dyadic, nearest_f64};
use crate::solve::{Account, Plan, SolveError, System, eliminate, lift};

/// The solutions of the three slider quadrics.
#[derive(Clone, Debug, PartialEq)]
pub struct SliderSolutions {
    /// The real poses of the platform.
    pub proper: Vec<SliderPose>,
    /// Sliders `s_i` (lengths) of the real solutions that build the platform's mirror image. No pose belongs to them.
    pub mirrored: Vec<[f64; 3]>,
    /// What the octic in `sigma_2` comes down to: of degree at most four.
    pub quartic: UPoly<Integer>,
    /// Where the eight formal roots went; four at least are at infinity, mirrored solutions count among real and complex ones.
    pub account: Account,
}

/// A pose with its sliders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderPose {
    /// The pose of the platform.
    pub pose: Pose,
    /// `s_i`: from the base pivot `A_i` to the corner `B_i`, along side `i`, in length units.
    pub sliders: [f64; 3],
    /// The corners `B_i` in the base frame.
    pub corners: [Vector2<f64>; 3],
    /// Largest distance of a base pivot from where its slider puts it, over the group's size.
    pub residual: f64,
}

/// Why a triad has no slider quadrics.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SliderQuadricsError {
    /// It is another group.
    #[error("the slider quadrics are those of RP-RP-RP, not of {name}")]
    OtherGroup {
        /// The group's name.
        name: String,
    },
    /// Two platform lines are parallel, or all three meet in a point.
    #[error("the three platform lines form no triangle")]
    NoTriangle,
    /// The engine could not solve them.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

type Point = [Rational; 2];

/// The poses of an RP-RP-RP triad by way of its three slider quadrics, mirrored solutions apart.
///
/// **Accuracy:** a few roundings for simple solutions. **Errors:** another group; platform lines that form no triangle.
///
/// ```
/// use assur::{Dyad, Offset, Triad, linkage::rp_rp_rp_quartic, nalgebra::Vector2};
/// let corners = [[0.0, 0.0], [40.0, 0.0], [20.0, 35.0]].map(Vector2::from);
/// let pivots = [[10.0, 17.3], [136.5, 19.7], [52.7, 111.2]].map(Vector2::from);
/// let leg = |i: usize| Dyad::RP {
///     a: pivots[i],
///     b: corners[i],
///     v: corners[(i + 1) % 3] - corners[i],
///     offset: Offset::Distance(0.0),
/// };
/// let found = rp_rp_rp_quartic(&Triad::new([leg(0), leg(1), leg(2)])?)?;
/// assert_eq!((found.quartic.degree(), found.account.at_infinity), (Some(4), 4));
/// assert_eq!(found.proper.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rp_rp_rp_quartic(triad: &Triad) -> Result<SliderSolutions, SliderQuadricsError> {
    let mut pivots = Vec::new();
    let mut lines = Vec::new();
    for leg in triad.legs() {
        let Dyad::RP { a, b, v, offset } = leg else {
            return Err(SliderQuadricsError::OtherGroup { name: triad.name() });
        };
        let [b, v] = [exact(*b), exact(*v)];
        let delta = number(match offset {
            Offset::Distance(0.0) => 0.0,
            Offset::Distance(d) => d * nearest_f64(&dot(&v, &v)).sqrt(),
            Offset::TimesDirection(delta) => *delta,
        });
        // m·p = m·b + delta with m = i v.
        let m = [-v[1].clone(), v[0].clone()];
        let level = dot(&m, &b) + delta;
        pivots.push(*a);
        lines.push((m, level));
    }
    let pivots: [Vector2<f64>; 3] = [pivots[0], pivots[1], pivots[2]];
    let corner = |i: usize| crossing(&lines[(i + 2) % 3], &lines[i]).ok_or(SliderQuadricsError::NoTriangle);
    let corners = [corner(0)?, corner(1)?, corner(2)?];
    let sides = [0, 1, 2].map(|i: usize| minus(&corners[(i + 1) % 3], &corners[i]));
    if dot(&sides[0], &sides[0]).is_zero() {
        return Err(SliderQuadricsError::NoTriangle);
    }

    let mut system = System::new(["sigma1", "sigma2", "sigma3"]);
    for i in 0..3 {
        let j = (i + 1) % 3;
        let apart = minus(&exact(pivots[i]), &exact(pivots[j]));
        let (first, second) = (Poly::variable(i) + Poly::one(), Poly::variable(j));
        let constant = |c: Rational| Poly::constant(c);
        let quadric = constant(dot(&sides[i], &sides[i])) * first.power(2)
            + constant(dot(&sides[j], &sides[j])) * second.power(2)
            - constant(Rational::from(2) * dot(&sides[i], &sides[j])) * first * second
            - constant(dot(&apart, &apart));
        system.add(["Q12", "Q23", "Q31"][i], integral(&quadric));
    }
    let plan = Plan::new("sigma2")
        .resultant("F23", ("Q12", "Q31"), "sigma1")
        .resultant("octic", ("F23", "Q23"), "sigma3")
        .of_degree(8);
    let eliminant = eliminate(&system, &plan).map_err(SolveError::from)?;
    let found = lift(&system, &plan, &eliminant)?;

    let corners = corners.map(|p| rounded(&p));
    let sides = sides.map(|p| rounded(&p));
    let mut proper = Vec::new();
    let mut mirrored = Vec::new();
    for solution in found.real() {
        let sigma = [0, 1, 2].map(|i: usize| solution.values[i].re);
        let sliders = [0, 1, 2].map(|i: usize| sigma[i] * sides[i].norm());
        let body = [0, 1, 2].map(|i: usize| corners[i] - sides[i] * sigma[i]);
        // Collinear pivots are their own mirror image: the area vanishes, and every solution builds the platform.
        if area(&body) * area(&pivots) < 0.0 {
            mirrored.push(sliders);
        } else {
            proper.push(placed(&body, &corners, &pivots, sliders));
        }
    }
    Ok(SliderSolutions { proper, mirrored, quartic: eliminant.polynomial, account: found.account })
}

/// The motion that takes the body points to the pivots, and how well it does.
fn placed(
    body: &[Vector2<f64>; 3],
    corners: &[Vector2<f64>; 3],
    pivots: &[Vector2<f64>; 3],
    sliders: [f64; 3],
) -> SliderPose {
    // The best rotation about the centroids: no single pair of pivots decides, two may coincide.
    let centre = |p: &[Vector2<f64>; 3]| (p[0] + p[1] + p[2]) / 3.0;
    let (from, to) = (centre(body), centre(pivots));
    let (c, s) = body.iter().zip(pivots).fold((0.0, 0.0), |(c, s), (p, q)| {
        let (p, q) = (p - from, q - to);
        (c + p.dot(&q), s + p.perp(&q))
    });
    let turned = Pose::new(0.0, 0.0, s.atan2(c));
    let shift = to - turned.place(from);
    let pose = Pose::new(shift.x, shift.y, turned.phi);
    let size = pivots.iter().map(|p| (p - to).norm()).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let residual = body.iter().zip(pivots).map(|(p, q)| (pose.place(*p) - q).norm() / size).fold(0.0, f64::max);
    SliderPose { pose, sliders, corners: corners.map(|p| pose.place(p)), residual }
}

/// The polynomial times its common denominator: elimination over integers spares a gcd per operation (the tests below run eight times faster).
fn integral(polynomial: &Poly<Rational>) -> Poly<Integer> {
    let denominators = polynomial.terms().map(|(_, c)| Integer::from(c.denominator().clone()));
    let common = denominators.fold(Integer::ONE, |common, d| {
        let shared = Integer::from((&common).gcd(&d));
        common * (d / shared)
    });
    polynomial.map(|c| c.numerator() * (&common / Integer::from(c.denominator().clone())))
}

/// Where two lines `m·p = level` cross.
fn crossing(first: &(Point, Rational), second: &(Point, Rational)) -> Option<Point> {
    let ((m, k), (n, l)) = (first, second);
    let cross = m[0].clone() * n[1].clone() - m[1].clone() * n[0].clone();
    if cross.is_zero() {
        return None;
    }
    let x = (k.clone() * n[1].clone() - l.clone() * m[1].clone()) / cross.clone();
    let y = (m[0].clone() * l.clone() - n[0].clone() * k.clone()) / cross;
    Some([x, y])
}

fn number(x: f64) -> Rational {
    dyadic(x).expect("the numbers of a triad are finite")
}

fn exact(p: Vector2<f64>) -> Point {
    [number(p.x), number(p.y)]
}

fn rounded(p: &Point) -> Vector2<f64> {
    Vector2::new(nearest_f64(&p[0]), nearest_f64(&p[1]))
}

fn dot(p: &Point, q: &Point) -> Rational {
    p[0].clone() * q[0].clone() + p[1].clone() * q[1].clone()
}

fn minus(p: &Point, q: &Point) -> Point {
    [p[0].clone() - q[0].clone(), p[1].clone() - q[1].clone()]
}

fn area(p: &[Vector2<f64>; 3]) -> f64 {
    (p[1] - p[0]).perp(&(p[2] - p[0]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vector2<f64>> {
        (-5.0..5.0f64, -5.0..5.0f64).prop_map(|(x, y)| Vector2::new(x, y))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn a_planted_pose_comes_back(
            b in prop::array::uniform3(vector()), v in prop::array::uniform3(vector()), d in prop::array::uniform3(-2.0..2.0f64),
            along in prop::array::uniform3(-3.0..3.0f64), (x, y, phi) in (-5.0..5.0f64, -5.0..5.0f64, -3.1..3.1f64),
        ) {
            let sine = |i: usize, j: usize| v[i].normalize().perp(&v[j].normalize()).abs();
            prop_assume!(v.iter().all(|v| v.norm() > 0.2) && sine(0, 1).min(sine(1, 2)).min(sine(2, 0)) > 0.1);
            let pose = Pose::new(x, y, phi);
            let pivot = |i: usize| {
                let unit = v[i].normalize();
                pose.place(b[i] + unit * along[i] + Vector2::new(-unit.y, unit.x) * d[i])
            };
            let a = [pivot(0), pivot(1), pivot(2)];
            let largest = (a[0] - a[1]).norm().max((a[1] - a[2]).norm());
            prop_assume!(area(&a).abs() > 0.05 * largest * largest);
            let leg = |i: usize| Dyad::RP { a: a[i], b: b[i], v: v[i], offset: Offset::Distance(d[i]) };
            let triad = Triad::new([leg(0), leg(1), leg(2)]).unwrap();
            let found = match rp_rp_rp_quartic(&triad) {
                Err(SliderQuadricsError::NoTriangle) => return Ok(()),
                found => found.unwrap(),
            };
            prop_assert!(found.quartic.degree() <= Some(4));
            prop_assert!(found.account.adds_up() && found.account.at_infinity >= 4);
            prop_assert!(found.proper.len() <= 2 && found.mirrored.len() <= 2, "{:?}", found);
            prop_assert!(found.proper.iter().all(|p| p.residual < 1e-9), "{:?}", found);
            let near = |p: &SliderPose| (0..3).map(|i| (p.pose.place(b[i]) - pose.place(b[i])).norm()).fold(0.0, f64::max);
            let error = found.proper.iter().map(near).fold(f64::INFINITY, f64::min);
            prop_assert!(error < 1e-5, "{:e} {:?}", error, found);
        }
    }

    #[test]
    fn other_groups_and_flat_triangles_are_refused() {
        let at = |x: f64, y: f64| Vector2::new(x, y);
        let rp = |v: Vector2<f64>| Dyad::RP { a: at(1.0, 2.0), b: at(0.0, 0.0), v, offset: Offset::Distance(0.0) };
        let concurrent = Triad::new([rp(at(1.0, 0.0)), rp(at(0.0, 1.0)), rp(at(1.0, 1.0))]).unwrap();
        assert_eq!(rp_rp_rp_quartic(&concurrent), Err(SliderQuadricsError::NoTriangle));
        let parallel = Triad::new([rp(at(1.0, 0.0)), rp(at(2.0, 0.0)), rp(at(1.0, 1.0))]).unwrap();
        assert_eq!(rp_rp_rp_quartic(&parallel), Err(SliderQuadricsError::NoTriangle));
        let other = Triad::new([rp(at(1.0, 0.0)), rp(at(2.0, 3.0)), Dyad::PP { phi: 0.0 }]).unwrap();
        let error = rp_rp_rp_quartic(&other).unwrap_err().to_string();
        assert_eq!(error, "the slider quadrics are those of RP-RP-RP, not of RP-RP-PP");
    }
}
