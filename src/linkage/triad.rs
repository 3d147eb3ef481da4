//! The consistency polynomial T(phi) of a triad, written once over any ring.
//!
//! | symbol | meaning |
//! |---|---|
//! | `R` | rotation by `phi`, cosine `c`, sine `s` |
//! | `a`, `b` | base point and platform point of a leg |
//! | `alpha`, `beta` | `a` and `b` less those of the reference leg, the first one |
//! | `u` | where the reference leg's platform point is, seen from its base point |
//! | `k` | `R beta - alpha` |
//! | `g`, `e` | the leg's row `g·u + e = 0` |
//!
//! Every leg but a reference RR is one row, linear in `u`:
//!
//! | leg | `g` | `e` |
//! |---|---|---|
//! | RR | `2k` | `k·k - (l² - l1²)` |
//! | PR, normal `n = i u` | `n` | `n·k` |
//! | RP, normal `m = i v` | `R m` | `(R m)·k + delta` |
//!
//! With an RR leg as reference, `u·u = l1²` and two rows give `T = |e2 g3 - e3 g2|² - l1² (g2 x g3)²`; without one, three rows
//! give their determinant. `T` has half the degree of [`triad_degree`], and its roots are the orientations
//! of the assembly modes. The derivation `triad_sextic` compares it with the Sylvester route, symbol by symbol.
//!
//! Source: Gosselin, Sefrioui, Richard 1992 for RR-RR-RR; the rows of sliders are ours.

use super::group::{Dyad, Triad, degree_of};
use crate::algebra::{Gaussian, Ring};

/// The numbers of one leg over a ring, seen from the reference leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LegNumbers<R> {
    /// RR: pivots and their distance.
    Circle {
        /// Base pivot less the reference leg's.
        alpha: Gaussian<R>,
        /// Platform pivot less the reference leg's.
        beta: Gaussian<R>,
        /// Distance of the pivots.
        length: R,
    },
    /// PR: a line on the base, `normal = i u`.
    Line {
        /// A point of the line less the reference leg's base point.
        alpha: Gaussian<R>,
        /// Platform pivot less the reference leg's.
        beta: Gaussian<R>,
        /// Normal of the line, any length.
        normal: Gaussian<R>,
    },
    /// RP: a line on the platform, `normal = i v`.
    PlatformLine {
        /// Base pivot less the reference leg's base point.
        alpha: Gaussian<R>,
        /// A point of the line less the reference leg's platform point.
        beta: Gaussian<R>,
        /// Normal of the line in the platform frame, any length.
        normal: Gaussian<R>,
        /// Distance times the length of the normal.
        delta: R,
    },
}

impl<R: Ring> LegNumbers<R> {
    /// The passive joints, base first: `RR`, `PR` or `RP`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Circle { .. } => "RR",
            Self::Line { .. } => "PR",
            Self::PlatformLine { .. } => "RP",
        }
    }

    /// The same leg over another ring.
    #[inline(always)]
    pub fn map<S: Ring>(&self, f: impl Fn(&R) -> S) -> LegNumbers<S> {
        match self {
            Self::Circle { alpha, beta, length } => {
                LegNumbers::Circle { alpha: alpha.map(&f), beta: beta.map(&f), length: f(length) }
            }
            Self::Line { alpha, beta, normal } => {
                LegNumbers::Line { alpha: alpha.map(&f), beta: beta.map(&f), normal: normal.map(&f) }
            }
            Self::PlatformLine { alpha, beta, normal, delta } => LegNumbers::PlatformLine {
                alpha: alpha.map(&f),
                beta: beta.map(&f),
                normal: normal.map(&f),
                delta: f(delta),
            },
        }
    }
}

/// A condition `g·u + e = 0` on the place `u` of the reference leg's platform point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<R> {
    /// Normal of the line on which `u` lies.
    pub g: Gaussian<R>,
    /// Constant part.
    pub e: R,
}

impl<R: Ring> Row<R> {
    /// `g x g'`: zero where the two lines are parallel.
    #[inline(always)]
    pub fn cross(&self, other: &Self) -> R {
        self.g.cross(&other.g)
    }

    /// `e g' - e' g`: with parallel lines, zero where they are the same.
    #[inline(always)]
    pub fn mismatch(&self, other: &Self) -> Gaussian<R> {
        other.g.scaled(&self.e) - self.g.scaled(&other.e)
    }
}

/// The linear row of a leg at the orientation with cosine `c` and sine `s`.
///
/// `reference_length` is that of the reference RR leg; it only enters the rows of RR legs.
#[inline(always)]
pub fn leg_row<R: Ring>(leg: &LegNumbers<R>, reference_length: &R, c: &R, s: &R) -> Row<R> {
    let rotation = Gaussian::new(c.clone(), s.clone());
    let two = R::from_int(2);
    match leg {
        LegNumbers::Circle { alpha, beta, length } => {
            let k = rotation.clone() * beta.clone() - alpha.clone();
            // k·k, with |R| = 1 used: |beta|² + |alpha|² - 2 alpha·(R beta).
            let alpha_r_beta = c.clone() * alpha.dot(beta) + s.clone() * beta.cross(alpha);
            let k_k = beta.norm_sqr() + alpha.norm_sqr() - two.clone() * alpha_r_beta;
            // As a product, the difference of nearly equal lengths keeps its digits in floats.
            let lengths = (length.clone() - reference_length.clone()) * (length.clone() + reference_length.clone());
            Row { g: k.scaled(&two), e: k_k - lengths }
        }
        LegNumbers::Line { alpha, beta, normal } => {
            let k = rotation * beta.clone() - alpha.clone();
            Row { e: normal.dot(&k), g: normal.clone() }
        }
        LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
            let turned = rotation * normal.clone();
            // (R m)·(R beta) = m·beta.
            Row { e: normal.dot(beta) - turned.dot(alpha) + delta.clone(), g: turned }
        }
    }
}

/// The rows of a triad: three of them, or the reference circle's radius and two.
#[derive(Clone, Debug, PartialEq)]
pub enum Rows<R> {
    /// The reference leg is RR: `u·u = radius²`, and the rows of the other two legs.
    Circle {
        /// Length of the reference leg.
        radius: R,
        /// Rows of the second and third leg.
        rows: [Row<R>; 2],
    },
    /// No leg is RR.
    Lines([Row<R>; 3]),
}

/// The rows of three legs, reference leg first, at the orientation with cosine `c` and sine `s`.
#[inline(always)]
pub fn triad_rows<R: Ring>(legs: &[LegNumbers<R>; 3], c: &R, s: &R) -> Rows<R> {
    match &legs[0] {
        LegNumbers::Circle { length, .. } => {
            let rows = [leg_row(&legs[1], length, c, s), leg_row(&legs[2], length, c, s)];
            Rows::Circle { radius: length.clone(), rows }
        }
        _ => {
            let none = R::zero();
            Rows::Lines([
                leg_row(&legs[0], &none, c, s),
                leg_row(&legs[1], &none, c, s),
                leg_row(&legs[2], &none, c, s),
            ])
        }
    }
}

/// `T(phi)`: zero exactly where the rows of the triad are consistent, in any ring.
///
/// **Shape**: three legs without PP, the reference leg first; where one is RR, the first is.
/// **Cost**: about 60 multiplications.
///
/// ```
/// use assur::algebra::Gaussian;
/// use assur::linkage::{LegNumbers, consistency};
/// // An equilateral platform standing upright on legs of length 1.
/// let point = |x: f64, y: f64| Gaussian::new(x, y);
/// let leg = |p: Gaussian<f64>| LegNumbers::Circle { alpha: p.clone(), beta: p, length: 1.0 };
/// let legs = [leg(point(0.0, 0.0)), leg(point(2.0, 0.0)), leg(point(1.0, 1.5))];
/// assert_eq!(consistency(&legs, &1.0, &0.0), 0.0);
/// ```
#[inline(always)]
pub fn consistency<R: Ring>(legs: &[LegNumbers<R>; 3], c: &R, s: &R) -> R {
    rows_consistency(&triad_rows(legs, c, s))
}

/// `T` from the rows; see [`consistency`].
#[inline(always)]
pub(super) fn rows_consistency<R: Ring>(rows: &Rows<R>) -> R {
    match rows {
        Rows::Circle { radius, rows: [second, third] } => {
            let mismatch = second.mismatch(third);
            let cross = second.cross(third);
            mismatch.norm_sqr() - radius.clone() * radius.clone() * cross.clone() * cross
        }
        Rows::Lines([first, second, third]) => {
            first.e.clone() * second.cross(third)
                + second.e.clone() * third.cross(first)
                + third.e.clone() * first.cross(second)
        }
    }
}

impl Triad {
    /// The order of `T(phi)` of a triad without PP legs, half of [`Triad::degree`]; `None` with a PP leg.
    ///
    /// ```
    /// use assur::{Dyad, Triad, nalgebra::Vector2};
    /// let leg = |x: f64| Dyad::PR { a: Vector2::new(x, 0.0), u: Vector2::new(1.0, x), b: Vector2::new(0.0, x) };
    /// assert_eq!(Triad::new([leg(1.0), leg(2.0), leg(4.0)]).unwrap().order(), Some(1));
    /// ```
    pub fn order(&self) -> Option<usize> {
        let translating = self.legs().iter().any(|leg| matches!(leg, Dyad::PP { .. }));
        (!translating).then(|| self.degree() / 2)
    }

    /// How many assemblies there can be: the number of finite complex solutions of a generic triad of this name (see [`super::triad_degree`]).
    pub fn degree(&self) -> usize {
        let mut counts = [0; 4];
        for leg in self.legs() {
            counts[match leg {
                Dyad::RR { .. } => 0,
                Dyad::PR { .. } => 1,
                Dyad::RP { .. } => 2,
                Dyad::PP { .. } => 3,
            }] += 1;
        }
        degree_of(counts)
    }
}
