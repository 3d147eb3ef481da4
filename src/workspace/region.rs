//! Regions of the plane as loops of boundary arcs.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::boundary::{ArcCurve, BoundaryArc, around};
use super::limits::{ActiveLimit, Limit, WorkspaceError};
use crate::plane::PhiRange;

/// Which workspace is asked for. Angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WorkspaceKind {
    /// Reached with one orientation.
    Constant {
        /// The orientation.
        phi: f64,
    },
    /// Reached with some orientation.
    Maximal,
    /// Reached with some orientation of a range.
    Inclusive(PhiRange),
    /// Reached with every orientation of a range.
    Total(PhiRange),
    /// Reached with every orientation.
    Dextrous,
}

impl WorkspaceKind {
    /// The name in commands and reports: `constant`, `maximal`, `inclusive`, `total`, `dextrous`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Constant { .. } => "constant",
            Self::Maximal => "maximal",
            Self::Inclusive(_) => "inclusive",
            Self::Total(_) => "total",
            Self::Dextrous => "dextrous",
        }
    }

    /// Whether its numbers make sense.
    ///
    /// # Errors
    /// A number that is not finite, a negative width.
    pub fn validate(&self) -> Result<(), WorkspaceError> {
        let finite = |what, value: f64| {
            if value.is_finite() { Ok(()) } else { Err(WorkspaceError::NotFinite { what, value }) }
        };
        match self {
            Self::Constant { phi } => finite("phi", *phi),
            Self::Inclusive(range) | Self::Total(range) => {
                finite("from", range.from)?;
                finite("width of the range of phi", range.width)?;
                if range.width < 0.0 { Err(WorkspaceError::NegativeWidth { value: range.width }) } else { Ok(()) }
            }
            Self::Maximal | Self::Dextrous => Ok(()),
        }
    }
}

/// A workspace.
#[derive(Clone, Debug, PartialEq)]
pub struct Workspace {
    /// Which one.
    pub kind: WorkspaceKind,
    /// Where it is.
    pub region: Region,
    /// Arcs in its inside where a way of reaching its places ends: they separate assemblies.
    pub separating: Vec<BoundaryArc>,
}

/// A closed loop of boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// Area inside, positive for an outer loop, negative for a hole.
    pub area: f64,
    /// Its arcs, each starting where the one before ends.
    pub arcs: Vec<BoundaryArc>,
}

/// A part of a region that has no area.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a region has a few of them at most")]
pub enum Isolated {
    /// A point.
    Point {
        /// Where.
        at: [f64; 2],
        /// The limits that leave no more.
        active: Vec<ActiveLimit>,
    },
    /// A piece of curve; no side of it belongs to the region, but for slivers of less than `1e-12` of the mechanism's size across.
    Curve(BoundaryArc),
}

/// A closed region of the plane.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Region {
    /// Outer loops run counter-clockwise, holes clockwise: the region is on the left.
    pub loops: Vec<Loop>,
    /// Parts without area. Not sought in total and dextrous workspaces of legs with ranges of joints 1 and 3 in both working modes.
    pub isolated: Vec<Isolated>,
    /// Area.
    pub area: f64,
    /// Length of the loops.
    pub perimeter: f64,
    /// Centre of gravity; `None` where there is no area.
    pub centroid: Option<[f64; 2]>,
    /// `[xmin, ymin, xmax, ymax]` of all of it; `None` where it is empty.
    pub bbox: Option<[f64; 4]>,
    /// Pieces of positive area; two that touch in a point are two.
    pub components: usize,
    /// Holes.
    pub holes: usize,
    /// Pieces of boundary that join no loop. Empty unless digits ran out, where two curves run closer together than roundings; area and
    /// perimeter then lack what these bound.
    pub unclosed: Vec<BoundaryArc>,
}

/// A piece of boundary between two vertices.
#[derive(Clone, Debug)]
pub(super) struct JoinedArc {
    pub(super) arc: BoundaryArc,
    /// Vertex at its start; vertices are told apart by their numbers, never by their coordinates.
    pub(super) from: usize,
    /// Vertex at its end.
    pub(super) to: usize,
    /// The curve it lies on: neighbours on the same circle or line become one arc.
    pub(super) carrier: usize,
}

impl Region {
    /// The region that arcs bound, each with the region on its left.
    ///
    /// At a vertex with several ways on the walk takes the sharpest turn to the left, so that pieces that touch in a point come out as
    /// loops of their own.
    pub(super) fn from_arcs(arcs: Vec<JoinedArc>, isolated: Vec<Isolated>) -> Self {
        let mut left = vec![true; arcs.len()];
        let mut region = Self::default();
        for start in 0..arcs.len() {
            if !left[start] {
                continue;
            }
            let mut walk = vec![start];
            left[start] = false;
            let closed = loop {
                let last = walk[walk.len() - 1];
                // The first arc counts as a way on as well: taking it closes the loop.
                let ways = (0..arcs.len()).filter(|&k| (left[k] || k == start) && arcs[k].from == arcs[last].to);
                match sharpest_left(&arcs, last, ways) {
                    Some(next) if next == start => break true,
                    Some(next) => {
                        left[next] = false;
                        walk.push(next);
                    }
                    None => break false,
                }
            };
            if closed {
                region.loops.push(closed_loop(&arcs, walk));
            } else {
                region.unclosed.extend(walk.into_iter().map(|k| arcs[k].arc.clone()));
            }
        }
        region.isolated = isolated;
        region.measure();
        region
    }

    /// The region carried along with the base frame, in which limits are these; what does not change by that keeps its digits.
    pub(super) fn moved(&self, by: Vector2<f64>, own: &dyn Fn(&Limit) -> Limit) -> Self {
        let mut out = self.clone();
        for arc in out.loops.iter_mut().flat_map(|l| &mut l.arcs).chain(&mut out.unclosed) {
            *arc = arc.moved(by, own);
        }
        for part in &mut out.isolated {
            match part {
                Isolated::Point { at, .. } => *at = [at[0] + by.x, at[1] + by.y],
                Isolated::Curve(arc) => *arc = arc.moved(by, own),
            }
        }
        out.centroid = self.centroid.map(|[x, y]| [x + by.x, y + by.y]);
        out.bbox = self.bbox.map(|[x, y, to_x, to_y]| [x + by.x, y + by.y, to_x + by.x, to_y + by.y]);
        out
    }

    /// Area, perimeter, centroid, bounding box and counts from the loops.
    fn measure(&mut self) {
        let bbox = |arcs: &mut dyn Iterator<Item = [f64; 4]>| {
            arcs.reduce(|a, b| around(around(a, [b[0], b[1]]), [b[2], b[3]]))
        };
        let arcs = || self.loops.iter().flat_map(|l| &l.arcs);
        let solid = bbox(&mut arcs().map(BoundaryArc::bbox));
        let parts = self.isolated.iter().map(|part| match part {
            Isolated::Point { at: [x, y], .. } => [*x, *y, *x, *y],
            Isolated::Curve(arc) => arc.bbox(),
        });
        let everything = bbox(&mut solid.into_iter().chain(parts));
        // About the middle of the region, so that a far frame costs no digits.
        let origin = solid.map_or_else(Vector2::zeros, |b| Vector2::new(0.5 * (b[0] + b[2]), 0.5 * (b[1] + b[3])));
        let (mut area, mut moment, mut perimeter) = (0.0, Vector2::zeros(), 0.0);
        for arc in arcs() {
            let share = arc.integrals(origin);
            area += share.area;
            moment += Vector2::from(share.moment);
            perimeter += share.length;
        }
        let components = self.loops.iter().filter(|l| l.area > 0.0).count();
        self.holes = self.loops.len() - components;
        self.components = components;
        self.centroid = (area > 0.0).then(|| (origin + moment / area).into());
        (self.area, self.perimeter, self.bbox) = (area, perimeter, everything);
    }

    /// Whether there is nothing in it.
    pub fn is_empty(&self) -> bool {
        self.loops.is_empty() && self.isolated.is_empty() && self.unclosed.is_empty()
    }
}

/// Of the arcs that go on from the end of one, that with the sharpest turn to the left: the first clockwise from the way back.
fn sharpest_left(arcs: &[JoinedArc], last: usize, ways: impl Iterator<Item = usize>) -> Option<usize> {
    let ways: Vec<usize> = ways.collect();
    if let [only] = ways[..] {
        return Some(only);
    }
    let arrived = &arcs[last].arc;
    let curvature = |k: f64| if k == 0.0 { f64::INFINITY } else { 0.1 / k.abs() };
    // Directions are compared a little way along the arcs, so that curvature parts those that touch.
    let step = ways.iter().map(|&k| &arcs[k].arc).fold(0.25 * arrived.length(), |step, arc| {
        step.min(0.25 * arc.length()).min(curvature(arc.curvatures()[0])).min(curvature(arrived.curvatures()[1]))
    });
    let angle = |[x, y]: [f64; 2], bend: f64| y.atan2(x) + 0.5 * bend * step;
    let [_, end] = arrived.tangents();
    let back = angle([-end[0], -end[1]], -arrived.curvatures()[1]);
    ways.into_iter().min_by(|&a, &b| {
        let turn = |k: usize| {
            let arc = &arcs[k].arc;
            (back - angle(arc.tangents()[0], arc.curvatures()[0])).rem_euclid(TAU)
        };
        turn(a).total_cmp(&turn(b))
    })
}

/// A loop from its arcs, neighbours on one curve joined.
fn closed_loop(arcs: &[JoinedArc], walk: Vec<usize>) -> Loop {
    let goes_on = |a: usize, b: usize| {
        let (a, b) = (&arcs[a], &arcs[b]);
        let alike = match (&a.arc.curve, &b.arc.curve) {
            (
                ArcCurve::Circle { start_angle: a0, end_angle: a1, .. },
                ArcCurve::Circle { start_angle: b0, end_angle: b1, .. },
            ) => (a1 > a0) == (b1 > b0),
            (ArcCurve::Line, ArcCurve::Line) => true,
            _ => false,
        };
        alike && a.carrier == b.carrier && a.arc.active == b.arc.active
    };
    let n = walk.len();
    let first = (0..n).find(|&k| !goes_on(walk[(k + n - 1) % n], walk[k]) || n == 1).unwrap_or(0);
    let mut out: Vec<BoundaryArc> = Vec::with_capacity(n);
    for k in 0..n {
        let here = walk[(first + k) % n];
        let arc = &arcs[here].arc;
        match out.last_mut() {
            Some(before) if goes_on(walk[(first + k + n - 1) % n], here) => {
                before.end = arc.end;
                if let (ArcCurve::Circle { end_angle, .. }, ArcCurve::Circle { start_angle: from, end_angle: to, .. }) =
                    (&mut before.curve, &arc.curve)
                {
                    *end_angle += to - from;
                }
            }
            _ => out.push(arc.clone()),
        }
    }
    let middle = Vector2::from(out[0].start);
    Loop { area: out.iter().map(|arc| arc.integrals(middle).area).sum(), arcs: out }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(x: f64, radius: f64, from: f64, to: f64) -> BoundaryArc {
        let at = |t: f64| [x + radius * t.cos(), radius * t.sin()];
        let curve = ArcCurve::Circle { center: [x, 0.0], radius, start_angle: from, end_angle: to };
        BoundaryArc { curve, start: at(from), end: at(to), active: Vec::new() }
    }

    #[test]
    fn a_disc_with_a_hole_and_a_touching_disc() {
        use std::f64::consts::PI;
        let joined = |arc, from, to, carrier| JoinedArc { arc, from, to, carrier };
        // Two unit discs that touch in the origin, each of one arc through it; in the right one a hole of two arcs.
        let arcs = vec![
            joined(circle(-1.0, 1.0, 0.0, TAU), 0, 0, 0),
            joined(circle(1.0, 1.0, -PI, PI), 0, 0, 1),
            joined(circle(1.0, 0.5, PI, 0.0), 1, 2, 2),
            joined(circle(1.0, 0.5, 0.0, -PI), 2, 1, 2),
        ];
        let region = Region::from_arcs(arcs, Vec::new());
        assert_eq!((region.components, region.holes, region.loops.len()), (2, 1, 3));
        assert!((region.area - 1.75 * PI).abs() < 1e-14 && (region.perimeter - 5.0 * PI).abs() < 1e-14);
        let [x, y] = region.centroid.expect("has an area");
        assert!((x - (0.75 - 1.0) / 1.75).abs() < 1e-14 && y.abs() < 1e-14);
        let bbox = region.bbox.expect("is not empty");
        assert!(bbox.iter().zip([-2.0, -1.0, 2.0, 1.0]).all(|(a, b)| (a - b).abs() < 1e-15), "{bbox:?}");
        assert_eq!(region.loops[2].arcs.len(), 1, "two arcs of one circle are one");
    }

    #[test]
    fn an_arc_without_a_neighbour_is_handed_over() {
        let open = JoinedArc { arc: circle(0.0, 1.0, 0.0, 1.0), from: 0, to: 1, carrier: 0 };
        let region = Region::from_arcs(vec![open], Vec::new());
        assert!(region.loops.is_empty() && region.unclosed.len() == 1 && !region.is_empty());
    }
}
