//! The Assur groups of class II: two links, three joints, both outer joints on known places.
//!
//! Each of the five groups comes down to a circle and a line, or two lines, in two unknowns; the general engine solves them
//! ([`crate::solve()`]) over the rationals, so that tangency, parallels and coincidences are decided exactly. The counts: two conditions, one
//! of degree two where a link turns about a known pivot at a known distance, so RRR, RRP and RPR have two assemblies; PRP and RPP
//! have two linear conditions and one assembly. Two circles (RRR) differ by a line, the radical axis, hence two and not four.
//!
//! It measures what it found on the geometry. What it cannot do: offsets beside a guide whose direction has an irrational length are
//! exact only up to the rounding of that length.

use nalgebra::Vector2;
use thiserror::Error;

use crate::algebra::{Poly, Rational, Ring, dyadic};
use crate::solve::{Account, Outcome, Plan, SolveError, System, solve};

/// A straight guide in the base, on which a slider's reference point keeps a signed distance to the left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guide {
    /// A point of the guide.
    pub point: Vector2<f64>,
    /// Its direction, of any length but zero.
    pub direction: Vector2<f64>,
    /// Signed distance of the slider's reference point to the left of the guide, in length units.
    pub offset: f64,
}

/// A group of two links between known places; named by its joints, outer, inner, outer. R turns, P slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TwoLinkGroup {
    /// Two links joined by a pivot, each turning about a known pivot.
    RRR {
        /// The known pivots.
        pivots: [Vector2<f64>; 2],
        /// Lengths of the links, from the known pivot to the inner one.
        lengths: [f64; 2],
    },
    /// A link that turns about a known pivot, joined by a pivot to a slider on a known guide: slider-crank.
    RRP {
        /// The known pivot.
        pivot: Vector2<f64>,
        /// Length of the link.
        length: f64,
        /// The guide of the slider.
        guide: Guide,
    },
    /// Two links that slide along each other, each turning about a known pivot.
    RPR {
        /// The known pivots.
        pivots: [Vector2<f64>; 2],
        /// How far the second pivot lies to the left of the directed sliding axis through the first, in length units.
        offset: f64,
    },
    /// Two sliders on known guides, joined by a pivot.
    PRP {
        /// The known guides.
        guides: [Guide; 2],
    },
    /// A link that turns about a known pivot and slides along a slider on a known guide.
    RPP {
        /// The known pivot.
        pivot: Vector2<f64>,
        /// Direction of the inner sliding axis: the slider does not turn, so it is known in the base.
        axis: Vector2<f64>,
        /// How far the pivot lies to the left of the inner axis, in length units.
        offset: f64,
        /// The guide of the slider; the inner axis goes through the slider's reference point.
        guide: Guide,
    },
}

/// One way to put a two-link group together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLinkAssembly {
    /// The inner joint. For RPR the foot of the perpendicular from the second pivot on the axis through the first, for RPP the
    /// slider's reference point.
    pub inner: Vector2<f64>,
    /// Orientation of each link in radians: the direction from its known pivot to the inner joint, or that of its sliding axis or guide.
    pub orientations: [f64; 2],
    /// How many assemblies meet here: 2 at a dead centre.
    pub multiplicity: usize,
    /// Largest closure error over the group's size, measured on the geometry.
    pub residual: f64,
}

/// Why a group has fewer assemblies than its kind, or a whole curve of them. Decided exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TwoLinkSpecial {
    /// RRR whose known pivots coincide, with unequal links: concentric circles do not meet.
    ConcentricCircles,
    /// The known pivots coincide and the links fit: the group turns freely.
    CoincidentPivots,
    /// RPR whose known pivots coincide while the offset does not vanish.
    OffsetWithoutDistance,
    /// Two guides, or an axis and a guide, are parallel and apart: they do not meet.
    ParallelGuides,
    /// Two guides, or an axis and a guide, coincide: the group slides freely.
    CoincidentGuides,
    /// A dead centre: two assemblies meet.
    DeadCentre,
}

/// Every way to put a two-link group together.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoLinkAssemblies {
    /// The assemblies, real ones only.
    pub assemblies: Vec<TwoLinkAssembly>,
    /// Where every solution went; the degree is 2 for RRR, RRP, RPR and 1 for PRP, RPP.
    pub account: Account,
    /// What is special.
    pub special: Option<TwoLinkSpecial>,
}

/// Why a two-link group cannot be asked about.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TwoLinkError {
    /// A number is NaN or infinite.
    #[error("{field} must be finite, not {value}")]
    NotFinite {
        /// Which number.
        field: &'static str,
        /// The number found.
        value: f64,
    },
    /// A link has a negative length.
    #[error("length {value} must be ≥ 0")]
    NegativeLength {
        /// The number found.
        value: f64,
    },
    /// A direction has no length.
    #[error("{field} must not be [0, 0]")]
    NoDirection {
        /// Which direction.
        field: &'static str,
    },
    /// The engine could not solve it.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

type P = Poly<Rational>;

impl TwoLinkGroup {
    /// The joints, outer, inner, outer: `RRR`, `RRP`, `RPR`, `PRP` or `RPP`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::RRR { .. } => "RRR",
            Self::RRP { .. } => "RRP",
            Self::RPR { .. } => "RPR",
            Self::PRP { .. } => "PRP",
            Self::RPP { .. } => "RPP",
        }
    }

    /// Every way to put the group together.
    ///
    /// **Accuracy:** a few roundings away from a dead centre; there exact in multiplicity and half the digits in place.
    /// **Errors:** numbers that are not finite, negative lengths, directions without length.
    ///
    /// ```
    /// use assur::{linkage::TwoLinkGroup, nalgebra::Vector2};
    /// let elbow = TwoLinkGroup::RRR { pivots: [Vector2::zeros(), Vector2::new(6.0, 0.0)], lengths: [5.0, 5.0] };
    /// let found = elbow.assemble()?;
    /// let heights: Vec<f64> = found.assemblies.iter().map(|a| a.inner.y).collect();
    /// assert_eq!(heights, [-4.0, 4.0]);
    /// # Ok::<(), assur::linkage::TwoLinkError>(())
    /// ```
    pub fn assemble(&self) -> Result<TwoLinkAssemblies, TwoLinkError> {
        match *self {
            Self::RRR { pivots: [a, b], lengths } => {
                let (circle, other) = (circle(a, lengths[0])?, circle(b, lengths[1])?);
                let special = (a == b).then_some(if lengths[0] == lengths[1] {
                    TwoLinkSpecial::CoincidentPivots
                } else {
                    TwoLinkSpecial::ConcentricCircles
                });
                let size = (b - a).norm().max(lengths[0]).max(lengths[1]);
                meet(circle.clone(), circle - other, special, |c| {
                    let errors = [(c - a).norm() - lengths[0], (c - b).norm() - lengths[1]];
                    (c, [angle(c - a), angle(c - b)], worst(&errors) / size)
                })
            }
            Self::RRP { pivot, length, guide } => {
                let line = guide.line("guide")?;
                meet(circle(pivot, length)?, line, None, |c| {
                    let size = (guide.point - pivot).norm().max(length).max(guide.offset.abs());
                    let errors = [(c - pivot).norm() - length, guide.distance(c) - guide.offset];
                    (c, [angle(c - pivot), angle(guide.direction)], worst(&errors) / size)
                })
            }
            Self::RPR { pivots: [a, b], offset } => {
                // Unknown: the axis' unit normal n, on which b - a measures the offset.
                let between = b - a;
                let line = x() * number("pivots", b.x)? + y() * number("pivots", b.y)?
                    - x() * number("pivots", a.x)?
                    - y() * number("pivots", a.y)?
                    - number("offset", offset)?;
                let special = (a == b).then_some(if offset == 0.0 {
                    TwoLinkSpecial::CoincidentPivots
                } else {
                    TwoLinkSpecial::OffsetWithoutDistance
                });
                let size = between.norm().max(offset.abs());
                meet(circle(Vector2::zeros(), 1.0)?, line, special, |n| {
                    let axis = Vector2::new(n.y, -n.x);
                    let error = (n.dot(&between) - offset) / size;
                    (a + axis * axis.dot(&between), [angle(axis); 2], error.abs().max((n.norm() - 1.0).abs()))
                })
            }
            Self::PRP { guides: [g, h] } => {
                let (first, second) = (g.line("first guide")?, h.line("second guide")?);
                meet(first, second, parallel(&g, &h), |c| {
                    let size = (g.point - c).norm().max((h.point - c).norm()).max(g.offset.abs()).max(h.offset.abs());
                    let errors = [g.distance(c) - g.offset, h.distance(c) - h.offset];
                    (c, [angle(g.direction), angle(h.direction)], worst(&errors) / size.max(f64::MIN_POSITIVE))
                })
            }
            Self::RPP { pivot, axis, offset, guide } => {
                // The slider's point lies as far to the right of the axis' parallel through the pivot as the pivot lies to its left.
                let through_pivot = Guide { point: pivot, direction: axis, offset: -offset };
                let (axis_line, guide_line) = (through_pivot.line("axis")?, guide.line("guide")?);
                meet(axis_line, guide_line, parallel(&through_pivot, &guide), |c| {
                    let size =
                        (pivot - c).norm().max((guide.point - c).norm()).max(offset.abs()).max(guide.offset.abs());
                    let errors = [through_pivot.distance(c) + offset, guide.distance(c) - guide.offset];
                    (c, [angle(axis), angle(guide.direction)], worst(&errors) / size.max(f64::MIN_POSITIVE))
                })
            }
        }
    }
}

impl Guide {
    /// `direction x (point - here) = offset·|direction|`, as a polynomial in the unknown point.
    fn line(&self, field: &'static str) -> Result<P, TwoLinkError> {
        let [ux, uy] = [number(field, self.direction.x)?, number(field, self.direction.y)?];
        let [px, py] = [number(field, self.point.x)?, number(field, self.point.y)?];
        let length = if self.offset == 0.0 { 1.0 } else { self.direction.norm() };
        let offset = number(field, self.offset)? * number(field, length)?;
        if self.direction == Vector2::zeros() {
            return Err(TwoLinkError::NoDirection { field });
        }
        Ok(ux * (y() - py) - uy * (x() - px) - offset)
    }

    /// How far a point lies to the left.
    fn distance(&self, point: Vector2<f64>) -> f64 {
        self.direction.normalize().perp(&(point - self.point))
    }
}

/// Solves two conditions in the unknown point `(x, y)`, the second of them linear.
fn meet(
    first: P,
    line: P,
    special: Option<TwoLinkSpecial>,
    measure: impl Fn(Vector2<f64>) -> (Vector2<f64>, [f64; 2], f64),
) -> Result<TwoLinkAssemblies, TwoLinkError> {
    let degree = first.total_degree() as usize;
    if let Some(special) = special {
        let free = matches!(special, TwoLinkSpecial::CoincidentPivots | TwoLinkSpecial::CoincidentGuides);
        let (self_motion, at_infinity) = if free { (degree, 0) } else { (0, degree) };
        let account = Account { degree, self_motion, at_infinity, ..Account::default() };
        return Ok(TwoLinkAssemblies { assemblies: Vec::new(), account, special: Some(special) });
    }
    let system = System::new(["x", "y"]).with("first", first).with("line", line);
    let plan = Plan::new("y").resultant_formal("r", ("first", degree as u32), ("line", 1), "x").of_degree(degree);
    let found = solve(&system, &plan)?;
    debug_assert!(!matches!(found.outcome, Outcome::IdenticallyZero { .. }), "parallels and coincidences are excluded");
    let mut assemblies: Vec<TwoLinkAssembly> = (found.real())
        .map(|solution| {
            let point = Vector2::new(solution.values[0].re, solution.values[1].re);
            let (inner, orientations, residual) = measure(point);
            TwoLinkAssembly { inner, orientations, multiplicity: solution.multiplicity, residual }
        })
        .collect();
    assemblies.sort_by(|a, b| a.inner.y.total_cmp(&b.inner.y).then(a.inner.x.total_cmp(&b.inner.x)));
    let special = assemblies.iter().any(|a| a.multiplicity > 1).then_some(TwoLinkSpecial::DeadCentre);
    Ok(TwoLinkAssemblies { assemblies, account: found.account, special })
}

/// Whether two guides never cross, decided exactly on the numbers given.
fn parallel(g: &Guide, h: &Guide) -> Option<TwoLinkSpecial> {
    let cross = |a: Vector2<f64>, b: Vector2<f64>| Some(dyadic(a.x)? * dyadic(b.y)? - dyadic(a.y)? * dyadic(b.x)?);
    if !cross(g.direction, h.direction)?.is_zero() {
        return None;
    }
    // With u = direction: u x (p - point) = offset |u| for both; compare them on the first guide's own scale.
    let along = g.direction.dot(&h.direction).signum();
    let apart = [h.point.x, h.point.y, g.point.x, g.point.y].map(dyadic);
    let [hx, hy, gx, gy] = apart.map(|x| x.unwrap_or_default());
    let apart = dyadic(g.direction.x)? * (hy - gy) - dyadic(g.direction.y)? * (hx - gx);
    let offsets = dyadic((g.offset - along * h.offset) * g.direction.norm())?;
    Some(if apart == offsets { TwoLinkSpecial::CoincidentGuides } else { TwoLinkSpecial::ParallelGuides })
}

/// `|p - centre|² - radius²`.
fn circle(centre: Vector2<f64>, radius: f64) -> Result<P, TwoLinkError> {
    if radius < 0.0 {
        return Err(TwoLinkError::NegativeLength { value: radius });
    }
    let [cx, cy] = [number("pivot", centre.x)?, number("pivot", centre.y)?];
    Ok((x() - cx).power(2) + (y() - cy).power(2) - number("length", radius)?.power(2))
}

fn x() -> P {
    P::variable(0)
}

fn y() -> P {
    P::variable(1)
}

fn number(field: &'static str, value: f64) -> Result<P, TwoLinkError> {
    dyadic(value).map(P::constant).ok_or(TwoLinkError::NotFinite { field, value })
}

fn angle(v: Vector2<f64>) -> f64 {
    v.y.atan2(v.x)
}

fn worst(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |worst: f64, e| worst.max(e.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn v(x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x, y)
    }

    fn guide(point: Vector2<f64>, direction: Vector2<f64>, offset: f64) -> Guide {
        Guide { point, direction, offset }
    }

    fn vector() -> impl Strategy<Value = Vector2<f64>> {
        (-5.0..5.0f64, -5.0..5.0f64).prop_map(|(x, y)| v(x, y))
    }

    fn left(direction: Vector2<f64>, p: Vector2<f64>) -> f64 {
        direction.normalize().perp(&p)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        /// All five groups built around a chosen inner joint give it back.
        #[test]
        fn planted_assemblies_come_back(a in vector(), b in vector(), c in vector(), u in vector(), w in vector()) {
            prop_assume!(u.norm() > 0.1 && w.norm() > 0.1 && u.normalize().perp(&w.normalize()).abs() > 0.05);
            prop_assume!((a - b).norm() > 0.1 && (c - a).normalize().perp(&(c - b).normalize()).abs() > 0.05);
            prop_assume!(u.normalize().dot(&(c - a).normalize()).abs() > 0.05);
            let (on_g, on_h) = (left(u, c - a), left(w, c - b));
            let (g, h) = (guide(a, u, on_g), guide(b, w, on_h));
            let groups = [
                (TwoLinkGroup::RRR { pivots: [a, b], lengths: [(c - a).norm(), (c - b).norm()] }, 2),
                (TwoLinkGroup::RRP { pivot: a, length: (c - a).norm(), guide: guide(c + u, u, 0.0) }, 2),
                (TwoLinkGroup::PRP { guides: [g, h] }, 1),
                (TwoLinkGroup::RPP { pivot: a, axis: w, offset: left(w, a - c), guide: guide(b, u, left(u, c - b)) }, 1),
            ];
            for (group, count) in groups {
                let found = group.assemble().unwrap();
                prop_assert!(found.account.adds_up() && found.account.degree == count);
                prop_assert_eq!(found.assemblies.len(), count, "{:?} {:?}", group, found);
                prop_assert!(found.assemblies.iter().all(|s| s.residual < 1e-12), "{:?}", found);
                prop_assert!(found.assemblies.iter().any(|s| (s.inner - c).norm() < 1e-9), "{:?} {:?}", group, found);
            }
            // RPR: the axis runs along w from a; b lies beside it.
            let group = TwoLinkGroup::RPR { pivots: [a, b], offset: left(w, b - a) };
            prop_assume!(left(w, b - a).abs() < 0.99 * (b - a).norm());
            let found = group.assemble().unwrap();
            prop_assert_eq!((found.assemblies.len(), found.account.real), (2, 2));
            prop_assert!(found.assemblies.iter().all(|s| s.residual < 1e-12));
            let turned = |s: &TwoLinkAssembly| (s.orientations[0] - angle(w)).sin().abs() + 1.0 - (s.orientations[0] - angle(w)).cos();
            prop_assert!(found.assemblies.iter().any(|s| turned(s) < 1e-8), "{:?}", found);
        }
    }

    #[test]
    fn out_of_reach_is_an_answer() {
        let found = TwoLinkGroup::RRR { pivots: [v(0.0, 0.0), v(9.0, 0.0)], lengths: [4.0, 4.0] }.assemble().unwrap();
        assert_eq!((found.assemblies.len(), found.account.complex, found.special), (0, 2, None));
    }

    #[test]
    fn dead_centre_is_one_assembly_counted_twice() {
        let found = TwoLinkGroup::RRR { pivots: [v(0.0, 0.0), v(3.0, 4.0)], lengths: [2.0, 3.0] }.assemble().unwrap();
        assert_eq!(found.special, Some(TwoLinkSpecial::DeadCentre));
        assert_eq!((found.assemblies.len(), found.assemblies[0].multiplicity), (1, 2));
        assert!((found.assemblies[0].inner - v(1.2, 1.6)).norm() < 1e-7);
    }

    #[test]
    fn pivots_above_each_other_share_a_height() {
        // The radical axis runs along x: both assemblies lie above one root.
        let found = TwoLinkGroup::RRR { pivots: [v(0.0, 0.0), v(0.0, 6.0)], lengths: [5.0, 5.0] }.assemble().unwrap();
        assert_eq!(found.assemblies.iter().map(|a| a.inner).collect::<Vec<_>>(), [v(-4.0, 3.0), v(4.0, 3.0)]);
        let slider = TwoLinkGroup::RRP { pivot: v(0.0, 0.0), length: 5.0, guide: guide(v(0.0, 1.0), v(2.0, 0.0), 2.0) };
        assert_eq!(slider.assemble().unwrap().assemblies.len(), 2);
    }

    #[test]
    fn guides_along_the_axes() {
        let (g, h) = (guide(v(3.0, 0.0), v(0.0, 2.0), 0.0), guide(v(0.0, 4.0), v(1.0, 0.0), 1.0));
        for guides in [[g, h], [h, g]] {
            let found = TwoLinkGroup::PRP { guides }.assemble().unwrap();
            assert_eq!(found.assemblies[0].inner, v(3.0, 5.0));
        }
    }

    #[test]
    fn degenerate_groups_have_names() {
        let special = |group: TwoLinkGroup| {
            let found = group.assemble().unwrap();
            assert!(found.account.adds_up() && found.assemblies.is_empty());
            found.special
        };
        let at = v(1.0, 2.0);
        let same = |lengths| special(TwoLinkGroup::RRR { pivots: [at; 2], lengths });
        assert_eq!(same([2.0, 3.0]), Some(TwoLinkSpecial::ConcentricCircles));
        assert_eq!(same([2.0, 2.0]), Some(TwoLinkSpecial::CoincidentPivots));
        let slide = |offset| special(TwoLinkGroup::RPR { pivots: [at; 2], offset });
        assert_eq!(slide(0.0), Some(TwoLinkSpecial::CoincidentPivots));
        assert_eq!(slide(0.5), Some(TwoLinkSpecial::OffsetWithoutDistance));
        let rails = |second| special(TwoLinkGroup::PRP { guides: [guide(at, v(3.0, 4.0), 0.0), second] });
        assert_eq!(rails(guide(at + v(3.0, 4.0), v(-6.0, -8.0), 0.0)), Some(TwoLinkSpecial::CoincidentGuides));
        assert_eq!(rails(guide(at, v(-6.0, -8.0), 1.0)), Some(TwoLinkSpecial::ParallelGuides));
        let group =
            TwoLinkGroup::RPP { pivot: at, axis: v(1.0, 0.0), offset: 1.0, guide: guide(at, v(-2.0, 0.0), 1.0) };
        assert_eq!(special(group), Some(TwoLinkSpecial::CoincidentGuides));
    }

    #[test]
    fn what_cannot_be_asked_is_refused_by_name() {
        let error = |group: TwoLinkGroup| group.assemble().unwrap_err().to_string();
        let pivots = [v(0.0, 0.0), v(1.0, 0.0)];
        assert_eq!(error(TwoLinkGroup::RRR { pivots, lengths: [1.0, -0.3] }), "length -0.3 must be ≥ 0");
        assert_eq!(error(TwoLinkGroup::RPR { pivots, offset: f64::NAN }), "offset must be finite, not NaN");
        let still = guide(v(0.0, 0.0), v(0.0, 0.0), 0.0);
        assert_eq!(
            error(TwoLinkGroup::RRP { pivot: v(0.0, 0.0), length: 1.0, guide: still }),
            "guide must not be [0, 0]"
        );
        assert!(error(TwoLinkGroup::PRP { guides: [still; 2] }).contains("first guide"));
    }
}
