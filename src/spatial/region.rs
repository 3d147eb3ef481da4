//! Regions of the plane bounded by curves that are graphs over the first axis, from curves that hold the boundary and a test of membership.
//!
//! 1. Between neighbouring places where two curves meet or one ends, the curves keep their order: a column there is cut into pieces by them, and one
//!    test decides each.
//! 2. Pieces that hold, side by side, make cells; where the cells of two columns do not match, the boundary is upright.
//! 3. The edges of cells that no other shares are followed around with the region on their left, each time into the first edge clockwise. So pieces that touch
//!    in a point come apart.
//!
//! Nothing is assumed of which curve bounds where: a curve too many does no harm, as long as none is missing.

use super::bow::{Bow, LinkCurve, Shape};

/// A piece of a boundary, in the plane of `y` and `z`.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkspaceArc {
    /// Where it begins; the region is on its left.
    pub start: [f64; 2],
    /// Where it ends.
    pub end: [f64; 2],
    /// What it lies on.
    pub curve: WorkspaceCurve,
    /// The limits that are reached on it.
    pub active: Vec<&'static str>,
    /// Its length.
    pub length: f64,
    /// Points along it that draw it, the ends included.
    half: Option<Bow>,
}

/// What a piece of a boundary lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WorkspaceCurve {
    /// A straight line.
    Line,
    /// A circle.
    Circle(ArcCircle),
    /// A spiric section of Perseus, which is no arc: a slider is at an end of its stroke, link and platform lie in one plane with the axis of rotation.
    Spiric(LinkCurve),
    /// The crossing of two cylinders, seen along `x`, which is no arc: a slider is at an end of its stroke, its link level.
    LevelLink(LinkCurve),
}

impl WorkspaceCurve {
    /// `line`, `circle`, `spiric`, `level link`, as reports write it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Circle(_) => "circle",
            Self::Spiric(_) => "spiric",
            Self::LevelLink(_) => "level link",
        }
    }
}

/// The circle of an arc. Angles in radians, from the `y` axis towards the `z` axis; the arc runs from the first to the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcCircle {
    /// Centre `(y, z)`.
    pub center: [f64; 2],
    /// Radius.
    pub radius: f64,
    /// Direction of the start, from the centre.
    pub start_angle: f64,
    /// Direction of the end; greater where the arc runs counter-clockwise, else smaller.
    pub end_angle: f64,
}

/// A region of the plane `Oyz` with its boundary.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct ArcRegion {
    /// Area.
    pub area: f64,
    /// Length of the boundary.
    pub perimeter: f64,
    /// Centre of gravity `(y, z)`; `None` for an empty region.
    pub centroid: Option<[f64; 2]>,
    /// `[ymin, zmin, ymax, zmax]`; `None` for an empty region.
    pub bbox: Option<[f64; 4]>,
    /// The boundary, the region on its left, each loop with its area: outer ones counter-clockwise with a positive area, holes clockwise with a negative one.
    pub loops: Vec<(f64, Vec<WorkspaceArc>)>,
}

/// Ends of a reach, where the region is cut off along a line.
const LEVEL: &str = "link level";
/// A gap below this much of the size is a touch (heuristic: some thousand roundings).
pub(super) const TOUCH: f64 = 1e-12;
/// Cells are not narrower than this, over the size, unless two curves end so near to each other: where curves cross at a slant it costs `1e-16` of the area, where they are upright
/// `1e-12`.
const THIN: f64 = 1e-8;
/// Ends of curves at one `y` closer than this, over the size, are one corner: curves may be upright there, which halves the digits (heuristic).
const CORNER: f64 = 1e-7;

/// A piece of a column between two breaks: the curves below and above.
struct Cell {
    range: [f64; 2],
    /// From the lowest; each below and above.
    pieces: Vec<[Bow; 2]>,
}

/// A directed piece of boundary.
struct Edge {
    from: (usize, usize),
    to: (usize, usize),
    /// Place of the edge among the directions at its start, and of its reverse at its end, counter-clockwise from straight down.
    leaves: i64,
    arrives: i64,
    /// The curve and the range of `y`, from start to end; upright where there is none.
    along: Option<(Bow, [f64; 2])>,
}

const DOWN: i64 = 0;
const RIGHT: i64 = 1;
const UP: i64 = 1 << 30;
const LEFT: i64 = 1 << 31;

impl ArcRegion {
    /// The region that `inside` describes, given every curve that can bound it and further places at which it can begin or end. `size` is its scale.
    pub(super) fn bounded_by(bows: &[Bow], ends: &[f64], size: f64, inside: impl Fn([f64; 2]) -> bool) -> Self {
        let breaks = breaks(bows, ends, size);
        let cells: Vec<Cell> =
            breaks.windows(2).map(|pair| Cell::new([pair[0], pair[1]], bows, size, &inside)).collect();
        let (edges, levels) = boundary(&breaks, &cells, size);
        let mut region = Self::default();
        let mut moments = [0.0; 2];
        let mut bbox = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        for run in loops(&edges) {
            let mut area = 0.0;
            for &edge in &run {
                let Some((bow, range)) = edges[edge].along else { continue };
                let forward = range[0] < range[1];
                let ordered = if forward { range } else { [range[1], range[0]] };
                let [sum, first, square, _] = bow.integrals(ordered);
                let sign = if forward { -1.0 } else { 1.0 };
                area += sign * sum;
                moments[0] += sign * first;
                moments[1] += 0.5 * sign * square;
                for y in bow.extremes(ordered) {
                    let z = bow.at(y);
                    bbox = [bbox[0].min(y), bbox[1].min(z), bbox[2].max(y), bbox[3].max(z)];
                }
            }
            let arcs = outline(&run, &edges, &breaks, &levels);
            region.perimeter += arcs.iter().map(|arc| arc.length).sum::<f64>();
            region.area += area;
            region.loops.push((area, arcs));
        }
        if region.area > 0.0 {
            region.centroid = Some(moments.map(|m| m / region.area));
            region.bbox = Some(bbox);
        }
        region
    }

    /// Pieces of positive area; pieces that touch in a point count as two.
    pub fn components(&self) -> usize {
        self.loops.iter().filter(|(area, _)| *area > 0.0).count()
    }

    /// Holes.
    pub fn holes(&self) -> usize {
        self.loops.len() - self.components()
    }

    /// The same region in another unit of length.
    pub(super) fn scaled(mut self, unit: f64) -> Self {
        let point = |p: [f64; 2]| p.map(|x| x * unit);
        let shape = |curve: LinkCurve| LinkCurve {
            height: curve.height * unit,
            link: curve.link * unit,
            factors: curve.factors.map(|[constant, linear]| [constant * unit, linear]),
        };
        for (area, arcs) in &mut self.loops {
            *area *= unit * unit;
            for arc in arcs {
                (arc.start, arc.end, arc.length) = (point(arc.start), point(arc.end), arc.length * unit);
                arc.curve = match arc.curve {
                    WorkspaceCurve::Line => WorkspaceCurve::Line,
                    WorkspaceCurve::Circle(c) => {
                        WorkspaceCurve::Circle(ArcCircle { center: point(c.center), radius: c.radius * unit, ..c })
                    }
                    WorkspaceCurve::Spiric(curve) => WorkspaceCurve::Spiric(shape(curve)),
                    WorkspaceCurve::LevelLink(curve) => WorkspaceCurve::LevelLink(shape(curve)),
                };
                if let Some(bow) = &mut arc.half {
                    bow.domain = point(bow.domain);
                    bow.shape = match bow.shape {
                        Shape::Circle { center, radius } => {
                            Shape::Circle { center: point(center), radius: radius * unit }
                        }
                        Shape::Line { z } => Shape::Line { z: z * unit },
                        Shape::Spiric(curve) => Shape::Spiric(shape(curve)),
                        Shape::Level(curve) => Shape::Level(shape(curve)),
                    };
                }
            }
        }
        self.area *= unit * unit;
        self.perimeter *= unit;
        self.centroid = self.centroid.map(point);
        self.bbox = self.bbox.map(|b| b.map(|x| x * unit));
        self
    }
}

/// Where curves end and where they meet, ascending; a meeting too near to an end or to another is left out.
fn breaks(bows: &[Bow], ends: &[f64], size: f64) -> Vec<f64> {
    let mut fixed: Vec<f64> = bows.iter().flat_map(|bow| bow.domain).chain(ends.iter().copied()).collect();
    fixed.sort_by(f64::total_cmp);
    fixed.dedup_by(|a, b| *a - *b <= f64::EPSILON * size);
    let pairs = bows.iter().enumerate().flat_map(|(k, bow)| bows[..k].iter().map(move |other| (bow, other)));
    let mut all: Vec<f64> = pairs.flat_map(|(bow, other)| bow.meets(other, size)).filter(|y| y.is_finite()).collect();
    let near = |list: &[f64], y: f64| {
        let after = list.partition_point(|end| *end < y);
        let around = after.saturating_sub(1)..(after + 1).min(list.len());
        list[around].iter().any(|end| (end - y).abs() <= THIN * size)
    };
    all.retain(|&y| !near(&fixed, y));
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| *a - *b <= THIN * size);
    all.extend(fixed);
    all.sort_by(f64::total_cmp);
    all
}

impl Cell {
    fn new([a, b]: [f64; 2], bows: &[Bow], size: f64, inside: &impl Fn([f64; 2]) -> bool) -> Self {
        let y = 0.5 * (a + b);
        let mut heights: Vec<(f64, Bow)> =
            bows.iter().filter(|bow| bow.covers(y)).map(|bow| (bow.at(y), *bow)).collect();
        heights.sort_by(|p, q| p.0.total_cmp(&q.0));
        // Curves that run together count once, the first of them by the order given: the sort is stable.
        heights.dedup_by(|next, first| next.0 - first.0 <= TOUCH * size);
        let mut pieces: Vec<[Bow; 2]> = Vec::new();
        let mut open = false;
        for pair in heights.windows(2) {
            let holds = inside([y, 0.5 * (pair[0].0 + pair[1].0)]);
            match pieces.last_mut().filter(|_| holds && open) {
                Some(piece) => piece[1] = pair[1].1,
                None if holds => pieces.push([pair[0].1, pair[1].1]),
                None => {}
            }
            open = holds;
        }
        Self { range: [a, b], pieces }
    }
}

/// The edges that no two cells share, and the corners above each break, from the lowest.
fn boundary(breaks: &[f64], cells: &[Cell], size: f64) -> (Vec<Edge>, Vec<Vec<f64>>) {
    let mut edges = Vec::new();
    let ends = |cell: Option<&Cell>, y: f64| -> Vec<[f64; 2]> {
        cell.map_or(Vec::new(), |cell| cell.pieces.iter().map(|piece| piece.map(|bow| bow.at(y))).collect())
    };
    let mut levels: Vec<Vec<f64>> = Vec::new();
    for (k, &y) in breaks.iter().enumerate() {
        let (left, right) = (k.checked_sub(1).and_then(|k| cells.get(k)), cells.get(k));
        let mut here: Vec<f64> = ends(left, y).into_iter().chain(ends(right, y)).flatten().collect();
        here.sort_by(f64::total_cmp);
        here.dedup_by(|next, first| *next - *first <= CORNER * size);
        levels.push(here);
    }
    let corner = |k: usize, z: f64| {
        // Corners are named by their lowest end.
        levels[k].partition_point(|level| *level <= z).saturating_sub(1)
    };
    for (k, cell) in cells.iter().enumerate() {
        let [a, b] = cell.range;
        for (rank, [low, up]) in (0..).zip(&cell.pieces) {
            let place = |bow: &Bow| ((k, corner(k, bow.at(a))), (k + 1, corner(k + 1, bow.at(b))));
            let ((low_a, low_b), (up_a, up_b)) = (place(low), place(up));
            let (right_low, right_up, left_low, left_up) =
                (RIGHT + 2 * rank, RIGHT + 2 * rank + 1, LEFT - 2 * rank, LEFT - 2 * rank - 1);
            edges.push(Edge {
                from: low_a,
                to: low_b,
                leaves: right_low,
                arrives: left_low,
                along: Some((*low, [a, b])),
            });
            edges.push(Edge { from: up_b, to: up_a, leaves: left_up, arrives: right_up, along: Some((*up, [b, a])) });
        }
    }
    for (k, &y) in breaks.iter().enumerate() {
        let (left, right) = (k.checked_sub(1).and_then(|k| cells.get(k)), cells.get(k));
        let spans = |cell| -> Vec<[usize; 2]> { ends(cell, y).into_iter().map(|e| e.map(|z| corner(k, z))).collect() };
        let (left, right) = (spans(left), spans(right));
        let covered = |spans: &[[usize; 2]], gap: usize| spans.iter().any(|[low, high]| *low <= gap && gap < *high);
        for gap in 0..levels[k].len().saturating_sub(1) {
            match (covered(&left, gap), covered(&right, gap)) {
                (true, false) => {
                    edges.push(Edge { from: (k, gap), to: (k, gap + 1), leaves: UP, arrives: DOWN, along: None })
                }
                (false, true) => {
                    edges.push(Edge { from: (k, gap + 1), to: (k, gap), leaves: DOWN, arrives: UP, along: None })
                }
                _ => {}
            }
        }
    }
    (edges, levels)
}

/// Edges followed around, with the region on their left: around a corner, boundaries of the region enter and leave in turn, so that every edge has a next one of its own.
fn loops(edges: &[Edge]) -> Vec<Vec<usize>> {
    let mut leaving: std::collections::BTreeMap<(usize, usize), Vec<usize>> = std::collections::BTreeMap::new();
    for (k, edge) in edges.iter().enumerate() {
        leaving.entry(edge.from).or_default().push(k);
    }
    let next = |edge: &Edge| {
        let choices = leaving.get(&edge.to).into_iter().flatten().copied();
        choices.min_by_key(|&k| clockwise(edge.arrives, edges[k].leaves))
    };
    let mut used = vec![false; edges.len()];
    let mut found = Vec::new();
    for start in 0..edges.len() {
        let mut run = Vec::new();
        let mut here = Some(start);
        while let Some(k) = here.filter(|&k| !used[k]) {
            used[k] = true;
            run.push(k);
            here = next(&edges[k]);
        }
        if !run.is_empty() {
            found.push(run);
        }
    }
    found
}

/// How far clockwise from one direction to another, in places around a corner; a full turn for the same.
fn clockwise(from: i64, to: i64) -> i64 {
    (from - to - 1).rem_euclid(LEFT << 1)
}

/// The pieces of a loop, those that continue one curve joined.
fn outline(run: &[usize], edges: &[Edge], breaks: &[f64], levels: &[Vec<f64>]) -> Vec<WorkspaceArc> {
    let point = |(k, level): (usize, usize)| [breaks[k], levels[k][level]];
    type Piece = (Option<Bow>, (usize, usize), (usize, usize), Vec<[f64; 2]>);
    let mut pieces: Vec<Piece> = Vec::new();
    let same = |a: &Option<Bow>, b: &Option<Bow>| match (a, b) {
        (Some(a), Some(b)) => a.shape == b.shape && a.side == b.side,
        (None, None) => true,
        _ => false,
    };
    let turns = |a: &Piece, edge: &Edge| match (a.3.last(), edge.along) {
        (Some(range), Some((_, next))) => (range[0] < range[1]) != (next[0] < next[1]),
        (None, None) => (a.1.1 < a.2.1) != (edge.from.1 < edge.to.1),
        _ => true,
    };
    for &k in run {
        let edge = &edges[k];
        let bow = edge.along.map(|(bow, _)| bow);
        match pieces.last_mut() {
            Some(last) if same(&last.0, &bow) && !turns(last, edge) => {
                last.2 = edge.to;
                last.3.extend(edge.along.map(|(_, range)| range));
            }
            _ => pieces.push((bow, edge.from, edge.to, edge.along.map(|(_, range)| range).into_iter().collect())),
        }
    }
    // The loop may begin in the middle of an arc.
    if pieces.len() > 1
        && let (Some(first), Some(last)) = (pieces.first(), pieces.last())
        && same(&first.0, &last.0)
        && first.1 == last.2
        && first.3.first().zip(last.3.last()).map(|(a, b)| (a[0] < a[1]) == (b[0] < b[1])) != Some(false)
    {
        let last = pieces.remove(pieces.len() - 1);
        pieces[0].1 = last.1;
        pieces[0].3.splice(0..0, last.3);
    }
    let arc = |(bow, from, to, ranges): Piece| {
        let (start, end) = (point(from), point(to));
        let (Some(bow), Some(first), Some(last)) = (bow, ranges.first(), ranges.last()) else {
            let length = (end[1] - start[1]).abs();
            return WorkspaceArc { start, end, curve: WorkspaceCurve::Line, active: vec![LEVEL], length, half: None };
        };
        let (a, b) = (first[0], last[1]);
        let curve = match bow.shape {
            Shape::Line { .. } => WorkspaceCurve::Line,
            Shape::Circle { .. } => WorkspaceCurve::Circle(bow.arc_circle(a, b).expect("is a circle")),
            Shape::Spiric(curve) => WorkspaceCurve::Spiric(curve),
            Shape::Level(curve) => WorkspaceCurve::LevelLink(curve),
        };
        let length = bow.integrals([a.min(b), a.max(b)])[3];
        let active = bow.active.into_iter().filter(|name| !name.is_empty()).collect();
        WorkspaceArc { start: [a, bow.at(a)], end: [b, bow.at(b)], curve, active, length, half: Some(bow) }
    };
    pieces.into_iter().map(arc).collect()
}

impl WorkspaceArc {
    /// Points along it, the ends included: dense where it is upright.
    pub fn points(&self, count: usize) -> Vec<[f64; 2]> {
        let steps = count.max(2) - 1;
        let along = |from: f64, to: f64, part: f64| from + part * (to - from);
        (0..=steps)
            .map(|k| {
                let part = k as f64 / steps as f64;
                match (self.curve, &self.half) {
                    (WorkspaceCurve::Circle(c), _) => {
                        let angle = along(c.start_angle, c.end_angle, part);
                        [c.center[0] + c.radius * angle.cos(), c.center[1] + c.radius * angle.sin()]
                    }
                    (WorkspaceCurve::Spiric(_) | WorkspaceCurve::LevelLink(_), Some(bow)) => {
                        let sine = 0.5 * (1.0 - (std::f64::consts::PI * part).cos());
                        let y = along(self.start[0], self.end[0], sine);
                        [y, bow.at(y)]
                    }
                    _ => std::array::from_fn(|i| along(self.start[i], self.end[i], part)),
                }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(y: f64, z: f64, radius: f64) -> Vec<Bow> {
        [1.0, -1.0].into_iter().filter_map(|side| Bow::circle([y, z], radius * radius, side, ["", ""])).collect()
    }

    fn within(y: f64, z: f64, radius: f64) -> impl Fn([f64; 2]) -> bool {
        move |p| (p[0] - y).hypot(p[1] - z) < radius
    }

    fn green(region: &ArcRegion) -> f64 {
        let of = |arc: &WorkspaceArc| {
            arc.points(4001).windows(2).map(|p| 0.5 * (p[0][0] * p[1][1] - p[1][0] * p[0][1])).sum::<f64>()
        };
        region.loops.iter().flat_map(|(_, arcs)| arcs).map(of).sum()
    }

    #[test]
    fn a_disc_a_lens_a_ring_and_two_touching_discs() {
        let pi = std::f64::consts::PI;
        let region = ArcRegion::bounded_by(&disc(1.0, 2.0, 3.0), &[], 3.0, within(1.0, 2.0, 3.0));
        assert!((region.area - 9.0 * pi).abs() < 1e-13 && (region.perimeter - 6.0 * pi).abs() < 1e-13);
        let [y, z] = region.centroid.expect("is not empty");
        assert!((y - 1.0).abs() + (z - 2.0).abs() < 1e-14);
        // Two unit discs one apart: 2 pi/3 - sqrt(3)/2.
        let two = [disc(0.0, 0.0, 1.0), disc(1.0, 0.0, 1.0)].concat();
        let (first, second) = (within(0.0, 0.0, 1.0), within(1.0, 0.0, 1.0));
        let lens = ArcRegion::bounded_by(&two, &[], 1.0, |p| first(p) && second(p));
        assert!((lens.area - (2.0 * pi / 3.0 - 0.75_f64.sqrt())).abs() < 1e-14, "{}", lens.area);
        assert_eq!((lens.loops.len(), lens.loops[0].1.len()), (1, 4));
        assert!((green(&lens) - lens.area).abs() < 1e-6);
        // One disc or the other, not both: two crescents that touch in two points.
        let crescents = ArcRegion::bounded_by(&two, &[], 1.0, |p| first(p) != second(p));
        assert_eq!((crescents.components(), crescents.holes()), (2, 0));
        assert!((crescents.area - 2.0 * (pi - lens.area)).abs() < 1e-13);
        // A disc with a hole.
        let both = [disc(0.0, 0.0, 2.0), disc(0.3, 0.2, 1.0)].concat();
        let (large, small) = (within(0.0, 0.0, 2.0), within(0.3, 0.2, 1.0));
        let ring = ArcRegion::bounded_by(&both, &[], 2.0, |p| large(p) && !small(p));
        assert_eq!((ring.components(), ring.holes()), (1, 1));
        assert!((ring.area - 3.0 * pi).abs() < 1e-13 && (green(&ring) - ring.area).abs() < 1e-5);
        let apart = [disc(0.0, 0.0, 1.0), disc(2.0, 0.0, 1.0)].concat();
        let (first, second) = (within(0.0, 0.0, 1.0), within(2.0, 0.0, 1.0));
        let touching = ArcRegion::bounded_by(&apart, &[], 1.0, |p| first(p) || second(p));
        assert_eq!((touching.components(), touching.holes()), (2, 0));
        assert_eq!(ArcRegion::bounded_by(&apart, &[], 1.0, |p| first(p) && second(p)), ArcRegion::default());
    }

    #[test]
    fn a_cut_disc_has_an_upright_edge() {
        let half = ArcRegion::bounded_by(&disc(0.0, 0.0, 1.0), &[0.0], 1.0, |p| p[0] < 0.0 && p[0].hypot(p[1]) < 1.0);
        assert!((half.area - std::f64::consts::FRAC_PI_2).abs() < 1e-14);
        assert!((half.perimeter - 2.0 - std::f64::consts::PI).abs() < 1e-13);
        assert!(half.loops[0].1.iter().any(|arc| arc.curve == WorkspaceCurve::Line && arc.start[0] == 0.0));
    }
}
