//! Coupler curves: circuits in colours, foci, double points, intersections.

use nalgebra::Vector2;
use svg::node::element::{Circle, Group, Polygon, Rectangle};

use super::plane::{COLOURS, Chart, TOP, label};
use super::symbols::{ALARM, INK, QUIET};
use crate::linkage::{CouplerCurve, DoublePointKind, Intersections, Partner};
use crate::manipulator::PlaneWindow;

/// Points along each circuit.
const POINTS: usize = 720;
/// Room around the curve, in parts of its width.
const ROOM: f64 = 0.12;

/// A coupler curve as one SVG document, with what it meets in grey and the real intersections ringed.
///
/// ```
/// # #[cfg(feature = "plot")] {
/// use assur::{linkage::CouplerCurve, plot::draw_coupler};
/// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[-1.0, -1.0], [2.0, -1.0]], [1.0, 2.5]).unwrap();
/// assert!(draw_coupler(&curve, None, None).starts_with("<svg"));
/// # }
/// ```
pub fn draw_coupler(curve: &CouplerCurve, partner: Option<&Partner>, found: Option<&Intersections>) -> String {
    let polygons = curve.polygons(POINTS);
    let others = match partner {
        Some(Partner::Coupler(other)) => other.polygons(POINTS),
        _ => Vec::new(),
    };
    let real: Vec<Vector2<f64>> =
        found.map_or(Vec::new(), |found| found.list.iter().filter_map(|meeting| meeting.point()).collect());
    let foci = curve.foci().map_or(Vec::new(), |foci| foci.to_vec());
    let seen = polygons.iter().chain(&others).flatten().chain(&foci).chain(&real);
    let chart = Chart::new(&window(seen.copied()));
    let (mut inside, mut legend) = (Group::new(), Group::new());
    let x = chart.beside();
    let mut y = TOP + 12.0;
    let mut entry = |mark: Group, text: &str| {
        let row = Group::new().set("transform", format!("translate({:.1} {:.1})", x + 8.0, y));
        legend = legend.clone().add(row.add(mark).add(label(text, 16.0, 4.0, 11.5).set("fill", INK)));
        y += 19.0;
    };
    match partner {
        Some(Partner::Circle { center, radius }) => {
            let circle = ring(chart.x(*center), chart.y(*center), chart.length(*radius), QUIET, 1.6);
            inside = inside.add(circle);
            entry(Group::new().add(ring(0.0, 0.0, 5.0, QUIET, 1.6)), "circle");
        }
        Some(Partner::Line { point, direction }) => {
            // Far beyond the window on both sides; the window cuts it off.
            let reach = direction.normalize() * 10.0 * (chart.diagonal() + (point - chart.middle()).norm());
            inside = inside.add(outline(&chart, &[point - reach, point + reach], QUIET, 1.6));
            entry(Group::new().add(bar(QUIET)), "line");
        }
        _ => {}
    }
    for polygon in &others {
        inside = inside.add(outline(&chart, polygon, QUIET, 1.8));
    }
    if !others.is_empty() {
        entry(Group::new().add(bar(QUIET)), "other curve");
    }
    for (number, polygon) in polygons.iter().enumerate() {
        let colour = COLOURS[(number + 1) % COLOURS.len()];
        inside = inside.add(outline(&chart, polygon, colour, 2.4));
        entry(Group::new().add(bar(colour)), &format!("circuit {}", number + 1));
    }
    for &focus in &foci {
        inside = inside.add(cross(chart.x(focus), chart.y(focus)));
    }
    if !foci.is_empty() {
        entry(Group::new().add(cross(0.0, 0.0)), "focus");
    }
    for kind in [DoublePointKind::Crunode, DoublePointKind::Acnode, DoublePointKind::Cusp] {
        let points = curve.double_points().unwrap_or_default();
        let places: Vec<_> =
            points.iter().filter(|point| point.kind == kind).filter_map(|point| point.point()).collect();
        for &at in &places {
            inside = inside.add(square(chart.x(at), chart.y(at), kind));
        }
        if !places.is_empty() {
            entry(Group::new().add(square(0.0, 0.0, kind)), kind.name());
        }
    }
    for &at in &real {
        inside = inside.add(ring(chart.x(at), chart.y(at), 6.0, ALARM, 2.0));
    }
    if !real.is_empty() {
        entry(Group::new().add(ring(0.0, 0.0, 6.0, ALARM, 2.0)), "real intersection");
    }
    let class = curve.grashof().map_or("with a slider", |class| class.name());
    let meetings = found.map_or(String::new(), |found| {
        format!("  ·  {} real of {} intersections", found.account.real, found.account.real + found.account.complex)
    });
    let circuits = match polygons.len() {
        0 => "no real curve".to_owned(),
        1 => "1 circuit".to_owned(),
        more => format!("{more} circuits"),
    };
    chart.document("Coupler curve", &format!("{class}  ·  {circuits}{meetings}"), inside, legend)
}

/// What holds all points, with some room.
fn window(points: impl Iterator<Item = Vector2<f64>>) -> PlaneWindow {
    let infinite = Vector2::repeat(f64::INFINITY);
    let (low, high) = points.fold((infinite, -infinite), |(low, high), p| (low.inf(&p), high.sup(&p)));
    if !low.iter().chain(high.iter()).all(|x| x.is_finite()) {
        return PlaneWindow { low: Vector2::repeat(-1.0), high: Vector2::repeat(1.0) };
    }
    let side = (high - low).max();
    let room = Vector2::repeat(if side > 0.0 { ROOM * side } else { 1.0 });
    PlaneWindow { low: low - room, high: high + room }
}

fn outline(chart: &Chart, points: &[Vector2<f64>], colour: &str, width: f64) -> Polygon {
    let places: Vec<String> = points.iter().map(|&p| format!("{:.2},{:.2}", chart.x(p), chart.y(p))).collect();
    Polygon::new()
        .set("points", places.join(" "))
        .set("fill", "none")
        .set("stroke", colour)
        .set("stroke-width", width)
        .set("stroke-linejoin", "round")
}

fn ring(x: f64, y: f64, radius: f64, colour: &str, width: f64) -> Circle {
    Circle::new()
        .set("cx", format!("{x:.2}"))
        .set("cy", format!("{y:.2}"))
        .set("r", format!("{radius:.2}"))
        .set("fill", "none")
        .set("stroke", colour)
        .set("stroke-width", width)
}

fn bar(colour: &str) -> Rectangle {
    Rectangle::new().set("x", -8).set("y", -1.5).set("width", 16).set("height", 3).set("fill", colour)
}

fn cross(x: f64, y: f64) -> Group {
    let arm = |width: f64, height: f64| {
        Rectangle::new()
            .set("x", format!("{:.2}", x - width / 2.0))
            .set("y", format!("{:.2}", y - height / 2.0))
            .set("width", width)
            .set("height", height)
            .set("fill", INK)
    };
    Group::new().add(arm(11.0, 1.8)).add(arm(1.8, 11.0))
}

/// Filled where the curve passes, hollow where the point stands alone, turned at a cusp.
fn square(x: f64, y: f64, kind: DoublePointKind) -> Rectangle {
    let fill = if kind == DoublePointKind::Acnode { "#ffffff" } else { INK };
    let mark = Rectangle::new()
        .set("x", format!("{:.2}", x - 3.5))
        .set("y", format!("{:.2}", y - 3.5))
        .set("width", 7)
        .set("height", 7)
        .set("fill", fill)
        .set("stroke", INK)
        .set("stroke-width", 1.4);
    if kind == DoublePointKind::Cusp { mark.set("transform", format!("rotate(45 {x:.2} {y:.2})")) } else { mark }
}
