//! The spatial robots drawn in a parallel projection: one panel a pose, all on one scale.

use nalgebra::{Vector2, Vector3};
use svg::Document;
use svg::node::element::{Circle, Group, Line, Polygon, Polyline, Rectangle};

use super::plane::{COLOURS, label};
use super::symbols::{ALARM, INK, PAPER, QUIET};
use crate::spatial::{Hana, HanaPose, Multipteron, Tripod, TripodPose};

/// A pose to be drawn: what stands above it, the pose, and the sliders' positions.
pub struct PosedRobot<P, const N: usize> {
    /// What stands above it.
    pub caption: String,
    /// Where the platform is.
    pub pose: P,
    /// Slider positions.
    pub inputs: [f64; N],
}

/// Side of a panel, gap around it, room for the caption, in pixels.
const PANEL: f64 = 300.0;
const GAP: f64 = 18.0;
const CAPTION: f64 = 26.0;
const HEADER: f64 = 66.0;
const MARGIN: f64 = 22.0;
/// Width that a letter of the title takes on average.
const TITLE_LETTER: f64 = 10.5;
/// Panels side by side.
const ACROSS: usize = 4;
/// From where the robot is seen: an azimuth and an elevation, in radians.
const SEEN_FROM: [f64; 2] = [0.62, 0.42];
/// Points of a circle as it is drawn.
const CIRCLE: usize = 72;
/// Unlimited rails are drawn this much longer than their sliders need, of the extent of the inputs or the robot's size.
const BEYOND: f64 = 0.15;

/// What is drawn in space.
enum Mark {
    Line { points: Vec<Vector3<f64>>, colour: &'static str, width: f64, dashed: bool },
    Fill { points: Vec<Vector3<f64>>, colour: &'static str, opacity: f64 },
    Dot { at: Vector3<f64>, colour: &'static str, radius: f64 },
    Name { at: Vector3<f64>, text: String },
}

impl Mark {
    fn line(points: &[Vector3<f64>], colour: &'static str, width: f64) -> Self {
        Self::Line { points: points.to_vec(), colour, width, dashed: false }
    }

    fn dashed(points: &[Vector3<f64>], colour: &'static str) -> Self {
        Self::Line { points: points.to_vec(), colour, width: 1.0, dashed: true }
    }

    fn points(&self) -> &[Vector3<f64>] {
        match self {
            Self::Line { points, .. } | Self::Fill { points, .. } => points,
            Self::Dot { at, .. } | Self::Name { at, .. } => std::slice::from_ref(at),
        }
    }
}

/// From space to the page: seen from a direction, heights upwards.
fn on_page(p: &Vector3<f64>) -> Vector2<f64> {
    let [azimuth, elevation] = SEEN_FROM;
    let (s, c) = azimuth.sin_cos();
    let away = c * p.x + s * p.y;
    Vector2::new(c * p.y - s * p.x, p.z * elevation.cos() - away * elevation.sin())
}

const LEG: [&str; 3] = [COLOURS[0], COLOURS[1], COLOURS[2]];
const PLATFORM: &str = "#3f7cac";

/// HANA in given poses: rails with their strokes, sliders (red outside the stroke), links, platform.
pub fn draw_hana_poses(robot: &Hana, poses: &[PosedRobot<HanaPose, 3>]) -> String {
    let scene = |posed: &PosedRobot<HanaPose, 3>| hana_scene(robot, posed);
    let title = if robot.name.is_empty() { "HANA" } else { &robot.name };
    let subtitle =
        "seen along a parallel projection  ·  legs 1, 2, 3 in colour, strokes drawn thick, sliders outside them red";
    sheet(title, subtitle, poses.iter().map(|posed| (posed.caption.as_str(), scene(posed))).collect())
}

fn hana_scene(robot: &Hana, posed: &PosedRobot<HanaPose, 3>) -> Vec<Mark> {
    let (r, base) = (robot.platform_radius, robot.base_radius);
    let HanaPose { y, z, phi } = posed.pose;
    let (s, c) = phi.sin_cos();
    let feet = [Vector3::new(base, 0.0, 0.0), Vector3::new(-base, 0.0, 0.0), Vector3::new(0.0, -base, 0.0)];
    let joints = [Vector3::new(r * c, y, z - r * s), Vector3::new(-r * c, y, z + r * s), Vector3::new(0.0, y - r, z)];
    let strokes = robot.strokes.iter().flatten().chain(&posed.inputs).copied();
    let (low, high) = strokes.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    let ring: Vec<Vector3<f64>> = (0..=CIRCLE)
        .map(|k| {
            let (s, c) = (std::f64::consts::TAU * k as f64 / CIRCLE as f64).sin_cos();
            Vector3::new(base * c, base * s, low)
        })
        .collect();
    let mut marks = vec![Mark::dashed(&ring, "#9aa5b1")];
    for leg in 0..3 {
        let at = |height: f64| feet[leg] + Vector3::z() * height;
        let [a, b] = robot.strokes[leg];
        marks.push(Mark::line(&[at(low), at(high)], "#9aa5b1", 1.4));
        marks.push(Mark::line(&[at(a), at(b)], LEG[leg], 4.5));
        let slider = at(posed.inputs[leg]);
        marks.push(Mark::line(&[slider, joints[leg]], LEG[leg], 2.4));
        let within = (a..=b).contains(&posed.inputs[leg]);
        marks.push(Mark::Dot { at: slider, colour: if within { INK } else { ALARM }, radius: 4.5 });
        marks.push(Mark::Name { at: slider, text: format!("{}", leg + 1) });
    }
    marks.push(Mark::Fill { points: joints.to_vec(), colour: PLATFORM, opacity: 0.35 });
    marks.push(Mark::line(&[joints[0], joints[1], joints[2], joints[0]], PLATFORM, 1.8));
    marks.extend(joints.map(|at| Mark::Dot { at, colour: PLATFORM, radius: 3.0 }));
    marks.push(Mark::Dot { at: Vector3::new(0.0, y, z), colour: INK, radius: 2.6 });
    marks
}

/// A three-legged robot in given poses: rails with their strokes, sliders (red outside the stroke), the planes of the legs, the platform's axes, the tool.
pub fn draw_tripod_poses(robot: &Tripod, poses: &[PosedRobot<TripodPose, 6>]) -> String {
    let title = if robot.name.is_empty() { "three-legged robot" } else { &robot.name };
    let subtitle = "seen along a parallel projection  ·  each leg's sliders, its plane to the joint, the joint's axis on the platform; black: the tool";
    sheet(title, subtitle, poses.iter().map(|posed| (posed.caption.as_str(), tripod_scene(robot, posed))).collect())
}

fn tripod_scene(robot: &Tripod, posed: &PosedRobot<TripodPose, 6>) -> Vec<Mark> {
    let TripodPose { position, rotation } = posed.pose;
    let mut marks = Vec::new();
    let sizes = robot.legs.iter().flat_map(|leg| [leg.da.norm(), leg.db.norm(), leg.c.norm()]);
    let size = sizes.fold(robot.tool.norm(), f64::max);
    for (k, leg) in robot.legs.iter().enumerate() {
        let joint = position + rotation * leg.c;
        let values = [posed.inputs[2 * k], posed.inputs[2 * k + 1]];
        let mut sliders = [Vector3::zeros(); 2];
        for (j, rail) in [leg.da, leg.db].into_iter().enumerate() {
            let at = |along: f64| rail + leg.u * along;
            let stroke = robot.strokes.map(|strokes| strokes[2 * k + j]);
            let [low, high] = stroke.unwrap_or([values[j] - BEYOND * size, values[j] + BEYOND * size]);
            marks.push(Mark::line(&[at(low.min(values[j])), at(high.max(values[j]))], "#9aa5b1", 1.4));
            if stroke.is_some() {
                marks.push(Mark::line(&[at(low), at(high)], LEG[k], 4.0));
            }
            let within = stroke.is_none_or(|[low, high]| (low..=high).contains(&values[j]));
            sliders[j] = at(values[j]);
            marks.push(Mark::Dot { at: sliders[j], colour: if within { INK } else { ALARM }, radius: 4.0 });
            marks.push(Mark::Name { at: sliders[j], text: format!("{}", 2 * k + j + 1) });
        }
        marks.push(Mark::Fill { points: vec![sliders[0], sliders[1], joint], colour: LEG[k], opacity: 0.14 });
        marks.push(Mark::line(&[sliders[0], sliders[1]], LEG[k], 2.4));
        marks.push(Mark::line(&[sliders[0], joint], LEG[k], 1.6));
        let axis = rotation * leg.v * (0.16 * size);
        marks.push(Mark::line(&[joint - axis, joint + axis], LEG[k], 3.2));
        marks.push(Mark::line(&[position, joint], PLATFORM, 2.0));
    }
    marks.push(Mark::Dot { at: position, colour: PLATFORM, radius: 4.0 });
    if robot.tool.norm() > 0.0 {
        let tip = position + rotation * robot.tool;
        marks.push(Mark::line(&[position, tip], INK, 3.0));
        marks.push(Mark::Dot { at: tip, colour: INK, radius: 2.6 });
    }
    marks
}

/// A Multipteron in given poses, each with what stands above it: sliders, the strip of each leg's plane from the slider to the platform's point, the platform.
/// Where a rail is beside its leg is not in the model; here it is outside the platform.
pub fn draw_multipteron_poses(title: &str, robot: &Multipteron, poses: &[(String, TripodPose)]) -> String {
    let subtitle = "seen along a parallel projection  ·  each leg's slider, the plane square to it in which the leg moves, the platform's point";
    let legs = robot.legs();
    let held = |pose: &TripodPose, point: &Vector3<f64>| pose.position + pose.rotation * point;
    let places = poses.iter().map(|(_, pose)| pose.position);
    let reach = legs.iter().map(|(_, point)| point.norm()).fold(0.0, f64::max);
    // The Tripteron's platform is a point: then by how far it is away.
    let away = places.clone().map(|place| place.norm()).fold(0.0, f64::max);
    let size = [reach, 0.5 * away, 1.0].into_iter().find(|size| *size > 0.0).unwrap_or(1.0);
    let middle = places.sum::<Vector3<f64>>() / poses.len().max(1) as f64;
    // The same rails in every panel: outside what the legs hold, square to their sliders.
    let rails: Vec<Vector3<f64>> = legs
        .iter()
        .map(|(e, point)| {
            let mean =
                poses.iter().map(|(_, pose)| held(pose, point)).sum::<Vector3<f64>>() / poses.len().max(1) as f64;
            let across = |v: Vector3<f64>| v - e * e.dot(&v);
            let other = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| e.cross(&axis));
            let outwards = [across(mean - middle), across(-middle)].into_iter().chain(other);
            let away = outwards.filter_map(|v| v.try_normalize(1e-3 * size)).next().unwrap_or_else(Vector3::zeros);
            across(mean) + away * size
        })
        .collect();
    let scene = |pose: &TripodPose| {
        let mut marks = Vec::new();
        for (k, ((e, point), rail)) in legs.iter().zip(&rails).enumerate() {
            let colour = COLOURS[k % COLOURS.len()];
            let joint = held(pose, point);
            let slider = rail + e * e.dot(&joint);
            let along = e * (0.5 * size);
            marks.push(Mark::line(&[slider - along, slider + along], colour, 4.0));
            let strip = e.cross(&(joint - slider)).try_normalize(0.0).unwrap_or_else(Vector3::zeros) * (0.2 * size);
            let corners = vec![slider + strip, joint + strip, joint - strip, slider - strip];
            marks.push(Mark::Fill { points: corners, colour, opacity: 0.14 });
            marks.push(Mark::dashed(&[slider, joint], colour));
            marks.push(Mark::Dot { at: slider, colour: INK, radius: 4.0 });
            marks.push(Mark::Name { at: slider, text: format!("{}", k + 1) });
            marks.push(Mark::line(&[pose.position, joint], PLATFORM, 2.4));
            marks.push(Mark::Dot { at: joint, colour: PLATFORM, radius: 3.0 });
        }
        marks.push(Mark::Dot { at: pose.position, colour: PLATFORM, radius: 4.5 });
        marks
    };
    sheet(title, subtitle, poses.iter().map(|(caption, pose)| (caption.as_str(), scene(pose))).collect())
}

/// Panels side by side on one scale.
fn sheet(title: &str, subtitle: &str, scenes: Vec<(&str, Vec<Mark>)>) -> String {
    let infinite = Vector2::repeat(f64::INFINITY);
    let points = scenes.iter().flat_map(|(_, marks)| marks).flat_map(Mark::points).map(on_page);
    let finite = points.filter(|p| p.x.is_finite() && p.y.is_finite());
    let (low, high) = finite.fold((infinite, -infinite), |(l, h), p| (l.inf(&p), h.sup(&p)));
    let (centre, extent) =
        if low.x <= high.x { ((low + high) / 2.0, (high - low).max()) } else { (Vector2::zeros(), 1.0) };
    let scale = (PANEL - 2.0 * MARGIN) / if extent > 0.0 { extent } else { 1.0 };
    let columns = scenes.len().clamp(1, ACROSS);
    let rows = scenes.len().div_ceil(ACROSS).max(1);
    let width = (GAP + columns as f64 * (PANEL + GAP)).max(2.0 * GAP + TITLE_LETTER * title.chars().count() as f64);
    let height = HEADER + rows as f64 * (PANEL + CAPTION + GAP);
    let mut document = Document::new()
        .set("width", width)
        .set("height", height)
        .set("viewBox", (0, 0, width, height))
        .set("font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif")
        .add(Rectangle::new().set("width", width).set("height", height).set("fill", "#ffffff"))
        .add(label(title, GAP, 28.0, 18.0).set("font-weight", "bold"));
    if columns > 2 {
        document = document.add(label(subtitle, GAP, 50.0, 12.0).set("fill", QUIET));
    }
    if scenes.is_empty() {
        return document.add(label("no pose", GAP, HEADER + 40.0, 14.0).set("fill", QUIET)).to_string();
    }
    for (number, (caption, marks)) in scenes.iter().enumerate() {
        let left = GAP + (number % ACROSS) as f64 * (PANEL + GAP);
        let top = HEADER + (number / ACROSS) as f64 * (PANEL + CAPTION + GAP) + CAPTION;
        let place = |p: &Vector3<f64>| {
            let offset = (on_page(p) - centre) * scale;
            (left + PANEL / 2.0 + offset.x, top + PANEL / 2.0 - offset.y)
        };
        let frame = Rectangle::new().set("x", left).set("y", top).set("width", PANEL).set("height", PANEL);
        let mut group = Group::new().add(frame.set("fill", PAPER).set("stroke", "#d5dbe1"));
        for mark in marks {
            group = draw(group, mark, &place);
        }
        document = document.add(group).add(label(caption, left, top - 8.0, 12.5)).add(axes(left, top + PANEL));
    }
    document.to_string()
}

fn draw(group: Group, mark: &Mark, place: &dyn Fn(&Vector3<f64>) -> (f64, f64)) -> Group {
    let data = |points: &[Vector3<f64>]| {
        let pixel = |p: &Vector3<f64>| {
            let (x, y) = place(p);
            format!("{x:.2},{y:.2}")
        };
        points.iter().map(pixel).collect::<Vec<_>>().join(" ")
    };
    match mark {
        Mark::Line { points, colour, width, dashed } => {
            let line = Polyline::new()
                .set("points", data(points))
                .set("fill", "none")
                .set("stroke", *colour)
                .set("stroke-width", *width)
                .set("stroke-linecap", "round");
            group.add(if *dashed { line.set("stroke-dasharray", "4 4") } else { line })
        }
        Mark::Fill { points, colour, opacity } => {
            group.add(Polygon::new().set("points", data(points)).set("fill", *colour).set("fill-opacity", *opacity))
        }
        Mark::Dot { at, colour, radius } => {
            let (x, y) = place(at);
            let dot = Circle::new().set("cx", format!("{x:.2}")).set("cy", format!("{y:.2}")).set("r", *radius);
            group.add(dot.set("fill", *colour).set("stroke", "#ffffff").set("stroke-width", 1))
        }
        Mark::Name { at, text } => {
            let (x, y) = place(at);
            group.add(label(text, x + 7.0, y - 5.0, 11.0).set("fill", QUIET))
        }
    }
}

/// The directions of the base frame, in the lower left corner of a panel.
fn axes(left: f64, bottom: f64) -> Group {
    let (x0, y0) = (left + 34.0, bottom - 30.0);
    let mut group = Group::new();
    for (direction, name) in [(Vector3::x(), "x"), (Vector3::y(), "y"), (Vector3::z(), "z")] {
        let p = on_page(&direction) * 20.0;
        let line = Line::new().set("x1", x0).set("y1", y0).set("x2", x0 + p.x).set("y2", y0 - p.y);
        let text = label(name, x0 + 1.35 * p.x - 3.0, y0 - 1.35 * p.y + 4.0, 10.5).set("fill", QUIET);
        group = group.add(line.set("stroke", QUIET)).add(text);
    }
    group
}
