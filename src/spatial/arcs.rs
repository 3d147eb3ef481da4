//! Regions of the plane between half circles that are graphs over the first axis.
//!
//! Every bound is a half circle `z = center + side·sqrt(radius² - (y - y0)²)`. Between the places where two of them meet one is the highest lower bound and one the
//! lowest upper bound, so the region falls into cells whose areas are elementary integrals. Such a region has no holes.

/// A half circle as a graph over `y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bow {
    /// Centre `(y, z)`.
    pub(super) center: [f64; 2],
    pub(super) radius: f64,
    /// 1 for the upper half, -1 for the lower.
    pub(super) side: f64,
    /// What it stands for.
    pub(super) label: &'static str,
}

impl Bow {
    pub(super) fn at(&self, y: f64) -> f64 {
        let t = y - self.center[0];
        self.center[1] + self.side * ((self.radius - t) * (self.radius + t)).max(0.0).sqrt()
    }

    pub(super) fn domain(&self) -> [f64; 2] {
        [self.center[0] - self.radius, self.center[0] + self.radius]
    }

    /// Integrals of `z`, `y z` and `z²` over `[a, b]`.
    fn integrals(&self, a: f64, b: f64) -> [f64; 3] {
        let ([y0, z0], radius) = (self.center, self.radius);
        let root = |t: f64| ((radius - t) * (radius + t)).max(0.0).sqrt();
        let (p, q) = (a - y0, b - y0);
        let flat = |t: f64| 0.5 * (t * root(t) + radius * radius * (t / radius).clamp(-1.0, 1.0).asin());
        let half_disc = self.side * (flat(q) - flat(p));
        let moment = self.side * (root(p).powi(3) - root(q).powi(3)) / 3.0;
        let width = b - a;
        let square = radius * radius * width - (q.powi(3) - p.powi(3)) / 3.0;
        [
            z0 * width + half_disc,
            z0 * 0.5 * (b * b - a * a) + y0 * half_disc + moment,
            z0 * z0 * width + 2.0 * z0 * half_disc + square,
        ]
    }

    /// Where two circles meet, as values of `y`.
    fn meets(&self, other: &Self) -> Vec<f64> {
        let d = [other.center[0] - self.center[0], other.center[1] - self.center[1]];
        let square = d[0] * d[0] + d[1] * d[1];
        if square == 0.0 {
            return Vec::new();
        }
        let along = 0.5 * (square + (self.radius - other.radius) * (self.radius + other.radius)) / square;
        let across = self.radius * self.radius / square - along * along;
        // Circles that touch do so to rounding.
        if across < -TOUCH {
            return Vec::new();
        }
        let across = across.max(0.0).sqrt();
        [1.0, -1.0].map(|side| self.center[0] + along * d[0] - side * across * d[1]).to_vec()
    }
}

/// A piece of a boundary, in the plane of `y` and `z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorkspaceArc {
    /// Where it begins; the region is on its left.
    pub start: [f64; 2],
    /// Where it ends.
    pub end: [f64; 2],
    /// The circle it belongs to; a straight piece otherwise.
    pub circle: Option<ArcCircle>,
    /// The limit that is reached on it.
    pub active: &'static str,
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

/// A region of the plane `Oyz` bounded by arcs; its pieces have no holes.
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
    /// The boundary of each piece, counter-clockwise, with its area.
    pub loops: Vec<(f64, Vec<WorkspaceArc>)>,
}

/// Lower and upper bounds: below the highest over groups of the lowest in a group, above likewise.
pub(super) struct Bounds {
    pub(super) lower: Vec<Vec<Bow>>,
    pub(super) upper: Vec<Vec<Bow>>,
}

/// Ends of a reach, where the region is cut off along a line.
const LEVEL: &str = "link level";
/// A gap below this much of the size is a touch (heuristic: some thousand roundings).
const TOUCH: f64 = 1e-12;

impl Bounds {
    /// The bow that bounds from below and the one that bounds from above.
    pub(super) fn active(&self, y: f64) -> Option<[Bow; 2]> {
        let covers = |bow: &&Bow| {
            let [low, high] = bow.domain();
            low <= y && y <= high
        };
        let by = |a: &&Bow, b: &&Bow| a.at(y).total_cmp(&b.at(y));
        let lowest = self.lower.iter().map(|group| group.iter().filter(covers).min_by(by));
        let highest = self.upper.iter().map(|group| group.iter().filter(covers).max_by(by));
        let lower = lowest.collect::<Option<Vec<_>>>()?.into_iter().max_by(by)?;
        let upper = highest.collect::<Option<Vec<_>>>()?.into_iter().min_by(by)?;
        Some([*lower, *upper])
    }

    /// Values of `y` between which the active bounds do not change.
    pub(super) fn breaks(&self) -> Vec<f64> {
        let bows: Vec<&Bow> = self.lower.iter().chain(&self.upper).flatten().collect();
        let mut breaks: Vec<f64> = bows.iter().flat_map(|bow| bow.domain()).collect();
        for (k, bow) in bows.iter().enumerate() {
            breaks.extend(bows[..k].iter().flat_map(|other| bow.meets(other)));
        }
        breaks.retain(|y| y.is_finite());
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        breaks
    }

    pub(super) fn region(&self) -> ArcRegion {
        let breaks = self.breaks();
        let size = self.lower.iter().chain(&self.upper).flatten().map(|bow| bow.radius).fold(0.0, f64::max);
        // Runs of cells that touch along more than a point.
        let mut pieces: Vec<Vec<([f64; 2], [Bow; 2])>> = Vec::new();
        let mut joined = false;
        for pair in breaks.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let cell = self.active(0.5 * (a + b)).filter(|[low, up]| {
                let y = 0.5 * (a + b);
                up.at(y) > low.at(y) && b - a > f64::EPSILON * size
            });
            let Some([low, up]) = cell else {
                joined &= b - a <= f64::EPSILON * size;
                continue;
            };
            match pieces.last_mut().filter(|_| joined && up.at(a) - low.at(a) > TOUCH * size) {
                Some(piece) => piece.push(([a, b], [low, up])),
                None => pieces.push(vec![([a, b], [low, up])]),
            }
            joined = up.at(b) - low.at(b) > TOUCH * size;
        }
        let mut region = ArcRegion::default();
        let (mut moments, mut bbox) = ([0.0; 2], [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY]);
        for piece in &pieces {
            let mut area = 0.0;
            for &([a, b], [low, up]) in piece {
                let [lower, upper] = [low.integrals(a, b), up.integrals(a, b)];
                area += upper[0] - lower[0];
                moments[0] += upper[1] - lower[1];
                moments[1] += 0.5 * (upper[2] - lower[2]);
                for bow in [low, up] {
                    // A half circle is highest or lowest in its middle or at an end.
                    let middle = bow.center[0].clamp(a, b);
                    for y in [a, middle, b] {
                        let z = bow.at(y);
                        bbox = [bbox[0].min(y), bbox[1].min(z), bbox[2].max(y), bbox[3].max(z)];
                    }
                }
            }
            let arcs = outline(piece, TOUCH * size);
            region.perimeter += arcs.iter().map(WorkspaceArc::length).sum::<f64>();
            region.area += area;
            region.loops.push((area, arcs));
        }
        if region.area > 0.0 {
            region.centroid = Some(moments.map(|m| m / region.area));
            region.bbox = Some(bbox);
        }
        region
    }
}

/// The boundary of a run of cells, counter-clockwise.
fn outline(piece: &[([f64; 2], [Bow; 2])], touch: f64) -> Vec<WorkspaceArc> {
    let mut arcs: Vec<WorkspaceArc> = Vec::new();
    let mut runs: [Vec<([f64; 2], Bow)>; 2] = [Vec::new(), Vec::new()];
    for &([a, b], bows) in piece {
        for (run, bow) in runs.iter_mut().zip(bows) {
            match run.last_mut() {
                Some((range, last)) if *last == bow => range[1] = b,
                _ => run.push(([a, b], bow)),
            }
        }
    }
    let [low, up] = runs;
    let upright = |y: f64, from: f64, to: f64| {
        let straight = WorkspaceArc { start: [y, from], end: [y, to], circle: None, active: LEVEL };
        ((to - from).abs() > touch).then_some(straight)
    };
    arcs.extend(low.iter().map(|&([a, b], bow)| WorkspaceArc::on(&bow, a, b)));
    let ends = |run: &[([f64; 2], Bow)], last: bool| match (run.first(), run.last()) {
        (Some(&([a, _], first)), Some(&([_, b], end))) => {
            if last {
                (b, end.at(b))
            } else {
                (a, first.at(a))
            }
        }
        _ => (0.0, 0.0),
    };
    let (y, from) = ends(&low, true);
    arcs.extend(upright(y, from, ends(&up, true).1));
    arcs.extend(up.iter().rev().map(|&([a, b], bow)| WorkspaceArc::on(&bow, b, a)));
    let (y, to) = ends(&low, false);
    arcs.extend(upright(y, ends(&up, false).1, to));
    arcs
}

impl WorkspaceArc {
    fn on(bow: &Bow, from: f64, to: f64) -> Self {
        // Directions along the upper half run from pi down to 0 as y grows, along the lower half from -pi up to 0.
        let angle = |y: f64| bow.side * ((y - bow.center[0]) / bow.radius).clamp(-1.0, 1.0).acos();
        let circle =
            ArcCircle { center: bow.center, radius: bow.radius, start_angle: angle(from), end_angle: angle(to) };
        Self { start: [from, bow.at(from)], end: [to, bow.at(to)], circle: Some(circle), active: bow.label }
    }

    /// Its length.
    pub fn length(&self) -> f64 {
        match self.circle {
            Some(circle) => circle.radius * (circle.end_angle - circle.start_angle).abs(),
            None => (self.end[0] - self.start[0]).hypot(self.end[1] - self.start[1]),
        }
    }

    /// Points along it, the ends included.
    pub fn points(&self, count: usize) -> Vec<[f64; 2]> {
        let steps = count.max(2) - 1;
        (0..=steps)
            .map(|k| {
                let part = k as f64 / steps as f64;
                match self.circle {
                    Some(c) => {
                        let angle = c.start_angle + part * (c.end_angle - c.start_angle);
                        [c.center[0] + c.radius * angle.cos(), c.center[1] + c.radius * angle.sin()]
                    }
                    None => std::array::from_fn(|i| self.start[i] + part * (self.end[i] - self.start[i])),
                }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bow(y: f64, z: f64, radius: f64, side: f64) -> Bow {
        Bow { center: [y, z], radius, side, label: "" }
    }

    #[test]
    fn a_disc_a_lens_and_two_touching_halves() {
        let disc = Bounds { lower: vec![vec![bow(1.0, 2.0, 3.0, -1.0)]], upper: vec![vec![bow(1.0, 2.0, 3.0, 1.0)]] };
        let region = disc.region();
        let pi = std::f64::consts::PI;
        assert!((region.area - 9.0 * pi).abs() < 1e-13 && (region.perimeter - 6.0 * pi).abs() < 1e-13);
        let [y, z] = region.centroid.expect("is not empty");
        assert!((y - 1.0).abs() + (z - 2.0).abs() < 1e-14);
        // Two unit discs one apart: 2 pi/3 - sqrt(3)/2.
        let lens = Bounds {
            lower: vec![vec![bow(0.0, 0.0, 1.0, -1.0)], vec![bow(1.0, 0.0, 1.0, -1.0)]],
            upper: vec![vec![bow(0.0, 0.0, 1.0, 1.0)], vec![bow(1.0, 0.0, 1.0, 1.0)]],
        };
        let region = lens.region();
        assert!((region.area - (2.0 * pi / 3.0 - 0.75_f64.sqrt())).abs() < 1e-14, "{}", region.area);
        assert_eq!((region.loops.len(), region.loops[0].1.len()), (1, 4));
        // Green's theorem on the outline gives the same area.
        let green: f64 = region.loops[0]
            .1
            .iter()
            .flat_map(|arc| {
                arc.points(4001).windows(2).map(|p| 0.5 * (p[0][0] * p[1][1] - p[1][0] * p[0][1])).collect::<Vec<_>>()
            })
            .sum();
        assert!((green - region.area).abs() < 1e-6);
        // A disc above a bump that touches its lowest point: two pieces.
        let touched =
            Bounds { lower: vec![vec![bow(0.0, -5.0, 3.0, 1.0)]], upper: vec![vec![bow(0.0, 2.0, 4.0, -1.0)]] };
        assert_eq!(touched.region().loops.len(), 2);
        let nothing =
            Bounds { lower: vec![vec![bow(0.0, 5.0, 1.0, -1.0)]], upper: vec![vec![bow(0.0, 0.0, 1.0, 1.0)]] };
        assert_eq!(nothing.region(), ArcRegion::default());
    }
}
