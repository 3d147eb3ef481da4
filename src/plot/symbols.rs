//! How each symbol looks, in pixels.

use std::fmt::Write;

use nalgebra::Vector2;
use svg::node::element::{Circle, Group, Path, Text};

use super::scene::{Look, Mark};

pub(super) const INK: &str = "#1f2933";
pub(super) const QUIET: &str = "#5b6770";
pub(super) const PAPER: &str = "#fcfcfb";
/// What is outside its limits.
pub(super) const ALARM: &str = "#c1121f";
const ACTUATED: &str = "#f2a33a";
const PLATFORM: &str = "#a9cbe8";
const PLATFORM_EDGE: &str = "#3f7cac";
const LINK: &str = "#4a5560";
const GROUND: &str = "#7b8794";

const PIN_RADIUS: f64 = 4.2;
const BLOCK: [f64; 2] = [9.0, 5.5];
/// Half the width of a telescope's cylinder.
const CYLINDER: f64 = 4.0;
/// The part of a telescope that its cylinder takes.
const CYLINDER_PART: f64 = 0.55;
/// How far a guide runs on beyond its ends.
const OVERHANG: f64 = 16.0;
const HATCH: f64 = 6.0;
/// Guides are hatched no further than this, in pixels; what lies beyond is cut off by the panel anyway.
const LONGEST_HATCH: f64 = 3000.0;

/// From length units to the pixels of a panel: the same scale both ways, y upwards.
pub(super) struct Canvas {
    pub(super) scale: f64,
    pub(super) centre: Vector2<f64>,
    pub(super) middle: Vector2<f64>,
}

impl Canvas {
    fn at(&self, p: &Vector2<f64>) -> Vector2<f64> {
        let offset = (p - self.centre) * self.scale;
        self.middle + Vector2::new(offset.x, -offset.y)
    }
}

/// A direction of the mechanism as a direction on the page.
fn on_page(along: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(along.x, -along.y)
}

pub(super) fn draw(mark: &Mark, canvas: &Canvas) -> Group {
    match mark {
        Mark::Body { corners } => body(&corners.iter().map(|corner| canvas.at(corner)).collect::<Vec<_>>()),
        Mark::Rail { from, to, along, fixed } => rail(canvas.at(from), canvas.at(to), on_page(along), *fixed),
        Mark::Ground { at } => ground(canvas.at(at)),
        Mark::Number { at, leg } => leg_number(canvas.at(at), *leg),
        Mark::Bar { from, to } => Group::new().add(line(&[canvas.at(from), canvas.at(to)], LINK, 3.2)),
        Mark::Telescope { from, to, look } => telescope(canvas.at(from), canvas.at(to), *look),
        Mark::Block { at, along, look } => block(canvas.at(at), on_page(along), *look),
        Mark::Pin { at, look } => pin(canvas.at(at), *look),
        Mark::Frame { pose } => {
            let origin = canvas.at(&pose.translation.vector);
            let axis = |unit: Vector2<f64>| on_page(&(pose.rotation * unit));
            Group::new().add(arrow(origin, axis(Vector2::x()), "#b23a48")).add(arrow(
                origin,
                axis(Vector2::y()),
                "#2f855a",
            ))
        }
    }
}

fn body(corners: &[Vector2<f64>]) -> Group {
    let closed = path(corners, true).set("fill", PLATFORM).set("fill-opacity", 0.6);
    Group::new().add(closed.set("stroke", PLATFORM_EDGE).set("stroke-width", 2.2).set("stroke-linejoin", "round"))
}

fn rail(from: Vector2<f64>, to: Vector2<f64>, along: Vector2<f64>, fixed: bool) -> Group {
    let reach = (to - from).dot(&along);
    let (start, end) = (from + along * (reach.min(0.0) - OVERHANG), from + along * (reach.max(0.0) + OVERHANG));
    if !fixed {
        return Group::new().add(line(&[start, end], PLATFORM_EDGE, 1.6));
    }
    let group = Group::new().add(line(&[start, end], GROUND, 1.6));
    // Hatching on the right of the guide, as of a wall.
    let side = Vector2::new(-along.y, along.x);
    let length = (end - start).norm().min(LONGEST_HATCH);
    let mut strokes = String::new();
    let mut travelled = HATCH / 2.0;
    while travelled < length {
        let foot = start + along * travelled;
        let tip = foot + (side - along) * 4.0;
        // Writing to a String cannot fail.
        let _ = write!(strokes, "M{:.1} {:.1}L{:.1} {:.1}", foot.x, foot.y, tip.x, tip.y);
        travelled += HATCH;
    }
    group.add(Path::new().set("d", strokes).set("stroke", GROUND).set("stroke-width", 0.8))
}

fn ground(at: Vector2<f64>) -> Group {
    let below = |x: f64, y: f64| at + Vector2::new(x, y);
    let foot = [below(0.0, 0.0), below(-7.0, 12.0), below(7.0, 12.0)];
    let mut strokes = String::new();
    for x in [-8.0, -4.0, 0.0, 4.0, 8.0] {
        let (top, bottom) = (below(x, 12.0), below(x - 4.0, 16.5));
        let _ = write!(strokes, "M{:.1} {:.1}L{:.1} {:.1}", top.x, top.y, bottom.x, bottom.y);
    }
    Group::new()
        .add(path(&foot, true).set("fill", "#e4e7eb").set("stroke", GROUND).set("stroke-width", 1.2))
        .add(line(&[below(-11.0, 12.0), below(11.0, 12.0)], GROUND, 1.6))
        .add(Path::new().set("d", strokes).set("stroke", GROUND).set("stroke-width", 0.9))
}

/// On paper of its own, so that no link runs through it.
fn leg_number(at: Vector2<f64>, leg: usize) -> Group {
    let place = at + Vector2::new(14.0, 12.5);
    let paper = Circle::new()
        .set("cx", format!("{:.1}", place.x))
        .set("cy", format!("{:.1}", place.y))
        .set("r", 6.5)
        .set("fill", PAPER)
        .set("fill-opacity", 0.85);
    let text = Text::new(leg.to_string())
        .set("x", format!("{:.1}", place.x))
        .set("y", format!("{:.1}", place.y + 3.6))
        .set("text-anchor", "middle")
        .set("font-size", 10)
        .set("fill", INK);
    Group::new().add(paper).add(text)
}

fn telescope(from: Vector2<f64>, to: Vector2<f64>, look: Look) -> Group {
    let end = from + (to - from) * CYLINDER_PART;
    let along = (to - from).try_normalize(0.0).unwrap_or_else(Vector2::x);
    let side = Vector2::new(-along.y, along.x) * CYLINDER;
    let start = from + along * PIN_RADIUS.min((end - from).norm());
    let cylinder = path(&[start + side, end + side, end - side, start - side], true);
    Group::new().add(line(&[from, to], LINK, 2.6)).add(filled(cylinder, look))
}

fn block(at: Vector2<f64>, along: Vector2<f64>, look: Look) -> Group {
    let side = Vector2::new(-along.y, along.x);
    let corner = |x: f64, y: f64| at + along * (x * BLOCK[0]) + side * (y * BLOCK[1]);
    let corners = [corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0), corner(1.0, -1.0)];
    Group::new().add(filled(path(&corners, true), look))
}

fn filled(path: Path, look: Look) -> Path {
    let (edge, width) = if look.violated { (ALARM, 2.6) } else { (INK, 1.3) };
    path.set("fill", if look.actuated { ACTUATED } else { "#ffffff" })
        .set("stroke", edge)
        .set("stroke-width", width)
        .set("stroke-linejoin", "round")
}

fn pin(at: Vector2<f64>, look: Look) -> Group {
    let circle = |radius: f64| {
        Circle::new().set("cx", format!("{:.1}", at.x)).set("cy", format!("{:.1}", at.y)).set("r", radius)
    };
    let fill = if look.actuated { ACTUATED } else { "#ffffff" };
    let radius = if look.actuated { PIN_RADIUS + 1.2 } else { PIN_RADIUS };
    let joint = circle(radius).set("fill", fill).set("stroke", INK).set("stroke-width", 1.5);
    let group = Group::new().add(joint);
    if !look.violated {
        return group;
    }
    group.add(circle(radius + 3.5).set("fill", "none").set("stroke", ALARM).set("stroke-width", 2))
}

fn arrow(origin: Vector2<f64>, along: Vector2<f64>, colour: &str) -> Group {
    let (tip, side) = (origin + along * 20.0, Vector2::new(-along.y, along.x));
    let head = path(&[tip + along * 5.0, tip + side * 2.8, tip - side * 2.8], true).set("fill", colour);
    Group::new().add(line(&[origin, tip], colour, 1.4)).add(head)
}

pub(super) fn scale_bar(left: f64, right: f64) -> Group {
    let tick = |x: f64| line(&[Vector2::new(x, -3.0), Vector2::new(x, 3.0)], INK, 1.2);
    let bar = line(&[Vector2::new(left, 0.0), Vector2::new(right, 0.0)], INK, 1.2);
    Group::new().add(bar).add(tick(left)).add(tick(right))
}

fn line(points: &[Vector2<f64>], colour: &str, width: f64) -> Path {
    path(points, false)
        .set("fill", "none")
        .set("stroke", colour)
        .set("stroke-width", width)
        .set("stroke-linecap", "round")
}

fn path(points: &[Vector2<f64>], closed: bool) -> Path {
    let mut data = String::new();
    for (place, point) in points.iter().enumerate() {
        let _ = write!(data, "{}{:.1} {:.1}", if place == 0 { 'M' } else { 'L' }, point.x, point.y);
    }
    if closed {
        data.push('Z');
    }
    Path::new().set("d", data)
}
