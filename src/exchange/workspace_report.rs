//! The answer to `workspace` as a JSON document, and its loops as CSV. Angles in radians.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;

use super::triad_file::DyadEntry;
use crate::plane::PhiRange;
use crate::workspace::{
    ArcCurve, BoundaryArc, CouplerArc, Isolated, Membership, Region, Stack, Workspace, WorkspaceKind, WorkspaceModes,
};

/// A workspace: loops of boundary, measures, isolated parts; membership of points where some were asked.
///
/// Loops keep the workspace on their left: outer ones run counter-clockwise, holes clockwise.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WorkspaceReport {
    schema: &'static str,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    phi: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    from: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    to: Option<f64>,
    mode: String,
    status: &'static str,
    #[serde(flatten)]
    region: RegionReport,
    /// Arcs inside it where a way of reaching its places ends.
    separating: Vec<ArcReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    assembly: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    points: Vec<PointReport>,
    /// Other workspaces asked for with it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub overlays: Vec<WorkspaceReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stack: Option<StackReport>,
    /// The area's derivatives by numbers of the design, angles in radians.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub gradient: BTreeMap<String, f64>,
    #[cfg(feature = "optimise")]
    #[serde(skip_serializing_if = "Option::is_none")]
    optimum: Option<OptimumReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct StackReport {
    from: f64,
    to: f64,
    volume: f64,
    volume_error: f64,
    slices: Vec<SliceReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct SliceReport {
    phi: f64,
    #[serde(flatten)]
    region: RegionReport,
}

/// The best design found, angles in radians.
#[cfg(feature = "optimise")]
#[derive(Clone, Debug, PartialEq, Serialize)]
struct OptimumReport {
    values: BTreeMap<String, f64>,
    area: f64,
    gradient: BTreeMap<String, f64>,
    area_before: f64,
    evaluations: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct RegionReport {
    area: f64,
    perimeter: f64,
    centroid: Option<[f64; 2]>,
    /// `[xmin, ymin, xmax, ymax]`.
    bbox: Option<[f64; 4]>,
    components: usize,
    holes: usize,
    loops: Vec<LoopReport>,
    isolated: Vec<IsolatedReport>,
    /// Pieces that could not be joined to loops, where digits ran out; the status is then `undecided`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unclosed: Vec<ArcReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct LoopReport {
    area: f64,
    arcs: Vec<ArcReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct ArcReport {
    #[serde(flatten)]
    curve: CurveReport,
    start: [f64; 2],
    end: [f64; 2],
    active: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "curve", rename_all = "lowercase")]
enum CurveReport {
    Line,
    Circle { center: [f64; 2], radius: f64, start_angle: f64, end_angle: f64 },
    Ellipse(CouplerArcReport),
    Coupler(CouplerArcReport),
}

/// Two limits held at once: the platform on two dyads, one place on either side at each orientation.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct CouplerArcReport {
    pair: [PairReport; 2],
    sigma: f64,
    phi_start: f64,
    phi_end: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct PairReport {
    limit: String,
    #[serde(flatten)]
    dyad: DyadEntry,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum IsolatedReport {
    Point { curve: &'static str, at: [f64; 2], active: Vec<String> },
    Curve(Box<ArcReport>),
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct PointReport {
    at: [f64; 2],
    inside: bool,
    margin: f64,
    binding: Option<String>,
}

impl WorkspaceReport {
    /// The report on a workspace, and on points whose membership was asked.
    ///
    /// `assembly`: the pose whose assembly alone counts, where one was named.
    pub fn new(
        workspace: &Workspace,
        modes: &WorkspaceModes,
        assembly: Option<[f64; 3]>,
        points: &[([f64; 2], Membership)],
    ) -> Self {
        let (phi, range) = match workspace.kind {
            WorkspaceKind::Constant { phi } => (Some(phi), None),
            WorkspaceKind::Inclusive(range) | WorkspaceKind::Total(range) => (None, Some(range)),
            WorkspaceKind::Maximal | WorkspaceKind::Dextrous => (None, None),
        };
        let point = |(at, membership): &([f64; 2], Membership)| PointReport {
            at: *at,
            inside: membership.inside,
            margin: membership.margin,
            binding: membership.binding.map(|limit| limit.to_string()),
        };
        Self {
            schema: "assur/workspace/1",
            kind: workspace.kind.name(),
            phi,
            from: range.map(|range: PhiRange| range.from),
            to: range.map(|range| range.from + range.width),
            mode: modes.to_string(),
            status: if workspace.region.unclosed.is_empty() { "complete" } else { "undecided" },
            region: RegionReport::from(&workspace.region),
            separating: workspace.separating.iter().map(ArcReport::from).collect(),
            assembly,
            points: points.iter().map(point).collect(),
            overlays: Vec::new(),
            stack: None,
            gradient: BTreeMap::new(),
            #[cfg(feature = "optimise")]
            optimum: None,
        }
    }

    /// The report with slices over a range of orientations.
    #[must_use]
    pub fn with_stack(mut self, stack: &Stack) -> Self {
        let slice = |slice: &Workspace| match slice.kind {
            WorkspaceKind::Constant { phi } => Some(SliceReport { phi, region: RegionReport::from(&slice.region) }),
            _ => None,
        };
        self.stack = Some(StackReport {
            from: stack.range.from,
            to: stack.range.from + stack.range.width,
            volume: stack.volume,
            volume_error: stack.volume_error,
            slices: stack.slices.iter().filter_map(slice).collect(),
        });
        self
    }

    /// The report with the best design found, `names` what was chosen.
    #[cfg(feature = "optimise")]
    #[must_use]
    pub fn with_optimum(mut self, names: &[String], best: &crate::workspace::Optimum) -> Self {
        let map = |values: &[f64]| names.iter().cloned().zip(values.iter().copied()).collect();
        self.optimum = Some(OptimumReport {
            values: map(&best.values),
            area: best.area,
            gradient: map(&best.gradient),
            area_before: best.area_before,
            evaluations: best.evaluations,
        });
        self
    }

    /// The report as a JSON document, ending in a newline.
    pub fn to_json(&self) -> String {
        super::report::json(self)
    }
}

impl From<&Region> for RegionReport {
    fn from(region: &Region) -> Self {
        let isolated = |part: &Isolated| match part {
            Isolated::Point { at, active } => IsolatedReport::Point {
                curve: "point",
                at: *at,
                active: active.iter().map(ToString::to_string).collect(),
            },
            Isolated::Curve(arc) => IsolatedReport::Curve(Box::new(arc.into())),
        };
        Self {
            area: region.area,
            perimeter: region.perimeter,
            centroid: region.centroid,
            bbox: region.bbox,
            components: region.components,
            holes: region.holes,
            loops: region
                .loops
                .iter()
                .map(|one| LoopReport { area: one.area, arcs: one.arcs.iter().map(ArcReport::from).collect() })
                .collect(),
            isolated: region.isolated.iter().map(isolated).collect(),
            unclosed: region.unclosed.iter().map(ArcReport::from).collect(),
        }
    }
}

impl From<&BoundaryArc> for ArcReport {
    fn from(arc: &BoundaryArc) -> Self {
        let curve = match &arc.curve {
            ArcCurve::Line => CurveReport::Line,
            &ArcCurve::Circle { center, radius, start_angle, end_angle } => {
                CurveReport::Circle { center, radius, start_angle, end_angle }
            }
            ArcCurve::Coupler(coupler) => CurveReport::Coupler((&**coupler).into()),
            ArcCurve::Ellipse(coupler) => CurveReport::Ellipse((&**coupler).into()),
        };
        Self { curve, start: arc.start, end: arc.end, active: arc.active.iter().map(ToString::to_string).collect() }
    }
}

impl From<&CouplerArc> for CouplerArcReport {
    fn from(arc: &CouplerArc) -> Self {
        Self {
            pair: arc
                .pair
                .each_ref()
                .map(|limit| PairReport { limit: limit.active().to_string(), dyad: DyadEntry::from(&limit.dyad) }),
            sigma: arc.sigma,
            phi_start: arc.phi_start,
            phi_end: arc.phi_end,
        }
    }
}

/// The name of the curve a piece of boundary lies on: `line`, `circle`, `ellipse` or `coupler`.
pub fn curve_name(curve: &ArcCurve) -> &'static str {
    match curve {
        ArcCurve::Line => "line",
        ArcCurve::Circle { .. } => "circle",
        ArcCurve::Ellipse(_) => "ellipse",
        ArcCurve::Coupler(_) => "coupler",
    }
}

/// Points along each arc that is no straight line, in CSV.
const CSV_POINTS: usize = 65;

/// The boundary as CSV with the header `part,loop,arc,curve,active,x,y`: points along every arc, its ends included, so that each loop
/// closes. `part` is `outer`, `hole`, `isolated` or `separating`; loops and arcs are counted from 1.
///
/// ```
/// use assur::exchange::workspace_csv;
/// use assur::workspace::{WorkspaceKind, WorkspaceModes};
/// # let (mut robot, _) = assur::Manipulator::of_family("3-RPR")?;
/// # robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([5.0, 14.0]));
/// let workspace = robot.workspace(&WorkspaceKind::Constant { phi: 0.3 }, &WorkspaceModes::Both)?;
/// assert!(workspace_csv(&workspace).starts_with("part,loop,arc,curve,active,x,y\nouter,1,1,circle,leg "));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn workspace_csv(workspace: &Workspace) -> String {
    let mut text = String::from("part,loop,arc,curve,active,x,y\n");
    let mut add = |part: &str, number: usize, arcs: &[BoundaryArc]| {
        for (k, arc) in (1..).zip(arcs) {
            let active = arc.active.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
            let count = if arc.curve == ArcCurve::Line { 2 } else { CSV_POINTS };
            for [x, y] in arc.points(count) {
                // Writing to a String cannot fail.
                let _ = writeln!(text, "{part},{number},{k},{},{active},{x},{y}", curve_name(&arc.curve));
            }
        }
    };
    for (number, one) in (1..).zip(&workspace.region.loops) {
        add(if one.area < 0.0 { "hole" } else { "outer" }, number, &one.arcs);
    }
    let mut number = 0;
    for part in &workspace.region.isolated {
        if let Isolated::Curve(arc) = part {
            number += 1;
            add("isolated", number, std::slice::from_ref(arc));
        }
    }
    for (number, arc) in (1..).zip(&workspace.separating) {
        add("separating", number, std::slice::from_ref(arc));
    }
    let points = workspace.region.isolated.iter().filter_map(|part| match part {
        Isolated::Point { at, active } => Some((at, active)),
        Isolated::Curve(_) => None,
    });
    for (at, active) in points {
        number += 1;
        let active = active.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
        let _ = writeln!(text, "isolated,{number},1,point,{active},{},{}", at[0], at[1]);
    }
    text
}
