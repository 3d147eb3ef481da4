//! Pictures of workspaces: regions filled, boundaries coloured by what they are, several overlaid.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;

use nalgebra::Vector2;
use svg::node::element::{Circle, Group, Line, Path};

use super::plane::{COLOURS, Chart, TOP, label, on_lines};
use super::scene::{heading, number};
use super::symbols::{INK, QUIET};
use crate::manipulator::{JointKind, Manipulator, PlaneWindow};
use crate::workspace::{ActiveLimit, ArcCurve, BoundaryArc, Isolated, Region, Workspace, WorkspaceKind};

/// Points along a coupler curve: a chord of a picture's width misses it by less than a tenth of a pixel.
const CURVE_POINTS: usize = 129;
/// Room around the workspaces, as a part of their larger side.
const ROOM: f64 = 0.08;
/// A base that lies further off than this many sides of the workspaces is not shown.
const FAR: f64 = 0.8;
/// The legs' own regions.
const LEG_STROKES: [(&str, &str); 3] = [("#8a6d3b", "7 4"), ("#5b7f95", "2.5 3"), ("#7d6b91", "8 3 2 3")];
/// Width of a curve without area.
const ALONE: f64 = 4.0;
/// The workspace in a picture of one.
const FILL: &str = "#4a90c2";

/// A workspace and what a legend calls it.
#[derive(Clone, Debug)]
pub struct WorkspaceLayer<'a> {
    /// Its name in the legend.
    pub name: String,
    /// The workspace.
    pub workspace: &'a Workspace,
}

/// What a piece of boundary is, for its colour.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Stroke {
    Circle,
    Line,
    Coupler,
    Ellipse,
    /// A circle or line drawn with the platform at an end of the range of orientations.
    EndOfPhi,
}

impl Stroke {
    fn of(arc: &BoundaryArc) -> Self {
        let at_end = arc.active.iter().any(|limit| matches!(limit, ActiveLimit::PhiFrom | ActiveLimit::PhiTo));
        match arc.curve {
            ArcCurve::Coupler(_) => Self::Coupler,
            ArcCurve::Ellipse(_) => Self::Ellipse,
            _ if at_end => Self::EndOfPhi,
            ArcCurve::Circle { .. } => Self::Circle,
            ArcCurve::Line => Self::Line,
        }
    }

    fn colour(self) -> &'static str {
        match self {
            Self::Circle => COLOURS[1],
            Self::Line => COLOURS[2],
            Self::Coupler => COLOURS[0],
            Self::Ellipse => COLOURS[4],
            Self::EndOfPhi => COLOURS[3],
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Circle => "circle",
            Self::Line => "line",
            Self::Coupler => "coupler curve",
            Self::Ellipse => "ellipse",
            Self::EndOfPhi => "φ at an end of its range",
        }
    }
}

/// Workspaces in one picture, equal axes in the file's length unit.
///
/// One alone has its boundary coloured by the kind of curve; several have a colour each. `legs`: the regions that each leg alone allows, dashed; may be empty.
///
/// ```
/// use assur::plot::{WorkspaceLayer, draw_workspaces};
/// use assur::workspace::{WorkspaceKind, WorkspaceModes};
/// # let (mut robot, _) = assur::Manipulator::of_family("3-RPR")?;
/// # robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([5.0, 14.0]));
/// let workspace = robot.workspace(&WorkspaceKind::Constant { phi: 0.3 }, &WorkspaceModes::Both)?;
/// let drawing = draw_workspaces(&robot, &[WorkspaceLayer { name: "constant".into(), workspace: &workspace }], &[]);
/// assert!(drawing.starts_with("<svg") && drawing.contains("circle"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn draw_workspaces(robot: &Manipulator, layers: &[WorkspaceLayer], legs: &[Region]) -> String {
    let chart = Chart::new(&window(robot, layers));
    let x = chart.beside();
    let mut y = TOP + 12.0;
    let (mut fills, mut strokes, mut legend) = (Group::new(), Group::new(), Group::new());
    let alone = layers.len() == 1;
    for (k, layer) in layers.iter().enumerate() {
        let colour = if alone { FILL } else { COLOURS[(k + 1) % COLOURS.len()] };
        let region = &layer.workspace.region;
        let outline: String = region.loops.iter().map(|one| outline(&chart, &one.arcs, true)).collect();
        if !outline.is_empty() {
            let fill = Path::new().set("d", outline.clone()).set("fill", colour).set("fill-rule", "evenodd");
            fills = fills.add(fill.set("fill-opacity", if alone { 0.2 } else { 0.13 }));
            if !alone {
                strokes = strokes.add(stroke(outline, colour, 1.8));
            }
        }
        if alone {
            let mut kinds: Vec<Stroke> = Vec::new();
            for arc in region.loops.iter().flat_map(|one| &one.arcs) {
                let kind = Stroke::of(arc);
                if !kinds.contains(&kind) {
                    kinds.push(kind);
                }
                strokes =
                    strokes.add(stroke(self::outline(&chart, std::slice::from_ref(arc), false), kind.colour(), 2.2));
            }
            kinds.sort();
            legend = legend.add(label(&layer.name, x, y, 12.5).set("font-weight", "bold"));
            y += 20.0;
            for kind in kinds {
                legend = legend.add(sample(x, y, kind.colour(), 2.2)).add(label(kind.name(), x + 28.0, y, 11.5));
                y += 18.0;
            }
            let points = region.isolated.iter().any(|part| matches!(part, Isolated::Point { .. }));
            let curve = region.isolated.iter().find_map(|part| match part {
                Isolated::Curve(arc) => Some(Stroke::of(arc)),
                Isolated::Point { .. } => None,
            });
            if let Some(kind) = curve {
                let line = sample(x, y, kind.colour(), ALONE);
                legend = legend.add(line).add(label("curve without area", x + 28.0, y, 11.5));
                y += 18.0;
            }
            if points {
                let dot = point(x + 11.0, y - 4.0, colour);
                legend = legend.add(dot).add(label("single point", x + 28.0, y, 11.5));
                y += 18.0;
            }
            for line in measures(region) {
                legend = legend.add(label(&line, x, y, 11.5).set("fill", QUIET));
                y += 16.0;
            }
            y += 6.0;
        } else {
            legend = legend.add(sample(x, y, colour, 2.0)).add(label(&layer.name, x + 28.0, y, 11.5));
            legend = legend.add(label(&area(region), x + 28.0, y + 14.0, 10.5).set("fill", QUIET));
            y += 33.0;
        }
        for part in &region.isolated {
            strokes = strokes.add(match part {
                Isolated::Point { at, .. } => {
                    Group::new().add(point(chart.x((*at).into()), chart.y((*at).into()), colour))
                }
                Isolated::Curve(arc) => {
                    let line = self::outline(&chart, std::slice::from_ref(arc), false);
                    Group::new().add(stroke(line, if alone { Stroke::of(arc).colour() } else { colour }, ALONE))
                }
            });
        }
        let separating: String = layer
            .workspace
            .separating
            .iter()
            .map(|arc| self::outline(&chart, std::slice::from_ref(arc), false))
            .collect();
        if alone && !separating.is_empty() {
            let line = |d: String| stroke(d, INK, 0.9).set("stroke-dasharray", "3 2.5");
            strokes = strokes.add(line(separating));
            legend = legend.add(line(format!("M{x} {:.2}h22", y - 4.0))).add(label(
                "inside: a way of reaching ends",
                x + 28.0,
                y,
                10.5,
            ));
            y += 18.0;
        }
    }
    let mut dashed = Group::new();
    for (leg, region) in legs.iter().enumerate() {
        let (colour, dashes) = LEG_STROKES[leg % LEG_STROKES.len()];
        let line = |d: String| stroke(d, colour, 1.1).set("stroke-dasharray", dashes);
        let outline: String = region.loops.iter().map(|one| outline(&chart, &one.arcs, true)).collect();
        if !outline.is_empty() {
            dashed = dashed.add(line(outline));
        }
        let seen = |arc: &BoundaryArc| arc.points(CURVE_POINTS).into_iter().any(|p| chart.shows(p.into()));
        let nothing = region.loops.is_empty() && region.isolated.is_empty();
        let remark = match region.loops.iter().flat_map(|one| &one.arcs).any(seen) {
            true => "",
            false if nothing => ": empty",
            false => ": out of view",
        };
        legend = legend.add(line(format!("M{x} {:.2}h22", y - 4.0))).add(label(
            &format!("leg {} alone{remark}", leg + 1),
            x + 28.0,
            y,
            11.5,
        ));
        y += 18.0;
    }
    legend = legend.add(label("lengths in the model's unit", x, y + 6.0, 10.5).set("fill", QUIET));
    let (title, family) = heading(robot);
    let subtitle = match layers {
        [layer] => format!("{family}{}", question(layer.workspace)),
        _ => format!("{family}workspaces of the reference point"),
    };
    let inside = Group::new().add(fills).add(dashed).add(strokes).add(bases(robot, &chart));
    chart.document(&title, &subtitle, inside, legend)
}

/// What was asked, in words.
fn question(workspace: &Workspace) -> String {
    let degrees = |angle: f64| format!("{}°", number(angle.to_degrees()));
    match workspace.kind {
        WorkspaceKind::Constant { phi } => format!("reached with φ = {}", degrees(phi)),
        WorkspaceKind::Maximal => "reached with some orientation".to_owned(),
        WorkspaceKind::Inclusive(range) => {
            format!("reached with some φ from {} to {}", degrees(range.from), degrees(range.from + range.width))
        }
        WorkspaceKind::Total(range) => {
            format!("reached with every φ from {} to {}", degrees(range.from), degrees(range.from + range.width))
        }
        WorkspaceKind::Dextrous => "reached with every orientation".to_owned(),
    }
}

fn area(region: &Region) -> String {
    if !region.unclosed.is_empty() {
        return "undecided: open loops".to_owned();
    }
    match (region.loops.is_empty(), region.isolated.is_empty()) {
        (false, _) => format!("area {}", number(region.area)),
        (true, false) => "no area".to_owned(),
        (true, true) => "empty".to_owned(),
    }
}

fn measures(region: &Region) -> Vec<String> {
    let mut out = vec![area(region)];
    if !region.loops.is_empty() {
        out.push(format!("perimeter {}", number(region.perimeter)));
    }
    let plural = |count: usize, one: &str| format!("{count} {one}{}", if count == 1 { "" } else { "s" });
    if region.components > 1 || region.holes > 0 {
        out.push(format!("{}, {}", plural(region.components, "piece"), plural(region.holes, "hole")));
    }
    if !region.isolated.is_empty() {
        out.push(plural(region.isolated.len(), "isolated part"));
    }
    out
}

/// The workspaces and, where they are not far off, the bases.
fn window(robot: &Manipulator, layers: &[WorkspaceLayer]) -> PlaneWindow {
    let infinite = Vector2::repeat(f64::INFINITY);
    let (mut low, mut high) = (infinite, -infinite);
    for [x0, y0, x1, y1] in layers.iter().filter_map(|layer| layer.workspace.region.bbox) {
        (low, high) = (low.inf(&Vector2::new(x0, y0)), high.sup(&Vector2::new(x1, y1)));
    }
    let drawn = low.x.is_finite();
    let reach = if drawn { FAR * (high - low).max() } else { f64::INFINITY };
    let (inner_low, inner_high) = (low - Vector2::repeat(reach), high + Vector2::repeat(reach));
    for at in robot.legs.iter().map(|leg| leg.base.at) {
        if !drawn || (0..2).all(|axis| inner_low[axis] <= at[axis] && at[axis] <= inner_high[axis]) {
            (low, high) = (low.inf(&at), high.sup(&at));
        }
    }
    let side = (high - low).max();
    let room = if side > 0.0 { ROOM * side } else { 1.0 };
    PlaneWindow { low: low - Vector2::repeat(room), high: high + Vector2::repeat(room) }
}

/// The legs' bases: a dot with its number; a slider's stroke as a line.
fn bases(robot: &Manipulator, chart: &Chart) -> Group {
    let mut out = Group::new();
    for (leg, number) in robot.legs.iter().zip(1..) {
        let at = leg.base.at;
        if let (JointKind::Prismatic, Some([low, high])) = (leg.joints[0], leg.limits[0]) {
            // The pivot on the slider at both ends of the stroke.
            let along = leg.base.direction.normalize();
            let first = leg.links[0].at;
            let pivot = at + along * first.x + Vector2::new(-along.y, along.x) * first.y;
            let [from, to] = [low, high].map(|q| pivot + along * q);
            let rail = Line::new()
                .set("x1", chart.x(from))
                .set("y1", chart.y(from))
                .set("x2", chart.x(to))
                .set("y2", chart.y(to));
            out = out.add(rail.set("stroke", QUIET).set("stroke-width", 3.5).set("stroke-opacity", 0.55));
        }
        let (x, y) = (chart.x(at), chart.y(at));
        let dot = Circle::new().set("cx", format!("{x:.2}")).set("cy", format!("{y:.2}")).set("r", 3.4);
        out = out
            .add(dot.set("fill", "#ffffff").set("stroke", INK).set("stroke-width", 1.4))
            .add(on_lines(label(&number.to_string(), x + 6.0, y + 13.0, 11.0).set("fill", QUIET)));
    }
    out
}

fn stroke(data: String, colour: &str, width: f64) -> Path {
    Path::new()
        .set("d", data)
        .set("fill", "none")
        .set("stroke", colour.to_owned())
        .set("stroke-width", width)
        .set("stroke-linejoin", "round")
        .set("stroke-linecap", "round")
}

/// An isolated point.
fn point(x: f64, y: f64, colour: &str) -> Circle {
    let dot = Circle::new().set("cx", format!("{x:.2}")).set("cy", format!("{y:.2}")).set("r", 4.2);
    dot.set("fill", colour.to_owned()).set("stroke", INK)
}

fn sample(x: f64, y: f64, colour: &str, width: f64) -> Path {
    stroke(format!("M{x} {:.2}h22", y - 4.0), colour, width)
}

/// Arcs in a row as the data of a path.
fn outline(chart: &Chart, arcs: &[BoundaryArc], closed: bool) -> String {
    let mut data = String::new();
    let place = |p: [f64; 2]| (chart.x(p.into()), chart.y(p.into()));
    if let Some(first) = arcs.first() {
        let (x, y) = place(first.start);
        // Writing to a String cannot fail.
        let _ = write!(data, "M{x:.2} {y:.2}");
    }
    for arc in arcs {
        match &arc.curve {
            ArcCurve::Line => {
                let (x, y) = place(arc.end);
                let _ = write!(data, "L{x:.2} {y:.2}");
            }
            ArcCurve::Circle { center, radius, start_angle, end_angle } => {
                let turn = end_angle - start_angle;
                // The page's y axis points down, so counter-clockwise is the sweep 0.
                let sweep = u8::from(turn < 0.0);
                let pieces = (turn.abs() / FRAC_PI_2).ceil().clamp(1.0, 8.0);
                let r = chart.length(*radius);
                for k in 1..=pieces as usize {
                    let (sin, cos) = (start_angle + turn * k as f64 / pieces).sin_cos();
                    let end = [center[0] + radius * cos, center[1] + radius * sin];
                    let (x, y) = place(if k == pieces as usize && turn.abs() < 2.0 * PI { arc.end } else { end });
                    let _ = write!(data, "A{r:.3} {r:.3} 0 0 {sweep} {x:.2} {y:.2}");
                }
            }
            ArcCurve::Coupler(_) | ArcCurve::Ellipse(_) => {
                for p in arc.points(CURVE_POINTS).into_iter().skip(1) {
                    let (x, y) = place(p);
                    let _ = write!(data, "L{x:.2} {y:.2}");
                }
            }
        }
    }
    if closed && !data.is_empty() {
        data.push('Z');
    }
    data
}
