//! Curves over one quantity: a chart with a scale of its own on either axis.

use nalgebra::Vector2;
use svg::Document;
use svg::node::element::{Group, Line, Polyline, Rectangle};

use super::plane::{COLOURS, label, ticks};
use super::scene::length;
use super::symbols::{INK, QUIET};

const WIDTH: f64 = 620.0;
const HEIGHT: f64 = 380.0;
const LEFT: f64 = 96.0;
const TOP: f64 = 88.0;
const BESIDE: f64 = 240.0;
const BOTTOM: f64 = 54.0;
/// Room above and below the curves, of their extent.
const ROOM: f64 = 0.06;

/// A curve: its name and its points; gaps where there is no value.
pub type NamedCurve = (String, Vec<(f64, Option<f64>)>);

/// Powers of ten from here on, and down to its reciprocal, go to the axis's name.
const LARGE: f64 = 1e4;

/// What the ticks of an axis are divided by, and how its name says so.
fn power_of_ten(low: f64, high: f64) -> (f64, String) {
    let size = low.abs().max(high.abs());
    if size == 0.0 || (1.0 / LARGE..LARGE).contains(&size) {
        return (1.0, String::new());
    }
    let exponent = size.log10().floor() as i32;
    let raised = |c: char| match c {
        '-' => '⁻',
        digit => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize - '0' as usize],
    };
    (10_f64.powi(exponent), format!("  (10{})", exponent.to_string().chars().map(raised).collect::<String>()))
}

/// Beyond this many times the third quartile of all sizes a curve runs off to a pole, and is cut.
const POLE: f64 = 8.0;

/// The largest size that is drawn.
fn clipped_at(curves: &[NamedCurve]) -> f64 {
    let values = curves.iter().flat_map(|(_, points)| points).filter_map(|(_, y)| *y);
    let mut sizes: Vec<f64> = values.map(f64::abs).filter(|size| size.is_finite()).collect();
    sizes.sort_by(f64::total_cmp);
    let quartile = sizes.get(sizes.len() * 3 / 4).copied().unwrap_or(0.0);
    if quartile > 0.0 { POLE * quartile } else { sizes.last().copied().unwrap_or(0.0) }
}

/// Curves over one quantity, the first axis named first; values that are not finite are gaps.
pub fn draw_curves(title: &str, subtitle: &str, axes: [&str; 2], curves: &[NamedCurve]) -> String {
    let highest = clipped_at(curves);
    let shown = |y: &f64| y.abs() <= highest;
    let known = || {
        let points = curves.iter().flat_map(|(_, points)| points);
        points.filter_map(|&(x, y)| y.filter(shown).map(|y| Vector2::new(x, y)))
    };
    let infinite = Vector2::repeat(f64::INFINITY);
    let (low, high) = known().fold((infinite, -infinite), |(l, h), p| (l.inf(&p), h.sup(&p)));
    let (mut low, mut high) = if low.x <= high.x { (low, high) } else { (Vector2::zeros(), Vector2::repeat(1.0)) };
    for axis in 0..2 {
        if low[axis] == high[axis] {
            let room = if low[axis] == 0.0 { 1.0 } else { 0.5 * low[axis].abs() };
            (low[axis], high[axis]) = (low[axis] - room, high[axis] + room);
        }
    }
    let room = ROOM * (high.y - low.y);
    (low.y, high.y) = (low.y - room, high.y + room);
    let x = |value: f64| LEFT + WIDTH * (value - low.x) / (high.x - low.x);
    let y = |value: f64| TOP + HEIGHT * (high.y - value) / (high.y - low.y);
    let (width, height) = (LEFT + WIDTH + BESIDE, TOP + HEIGHT + BOTTOM);
    let mut document = Document::new()
        .set("width", width)
        .set("height", height)
        .set("viewBox", (0, 0, width, height))
        .set("font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif")
        .add(Rectangle::new().set("width", width).set("height", height).set("fill", "#ffffff"))
        .add(label(title, LEFT, 28.0, 18.0).set("font-weight", "bold"))
        .add(label(subtitle, LEFT, 50.0, 12.5).set("fill", QUIET));
    if low.y < 0.0 && high.y > 0.0 {
        let zero = Line::new().set("x1", LEFT).set("x2", LEFT + WIDTH).set("y1", y(0.0)).set("y2", y(0.0));
        document = document.add(zero.set("stroke", "#c5ccd3"));
    }
    let (mut inside, mut legend) = (Group::new(), Group::new());
    for (k, (name, points)) in curves.iter().enumerate() {
        let colour = COLOURS[k % COLOURS.len()];
        for run in points.split(|(_, y)| y.is_none_or(|y| !shown(&y))).filter(|run| !run.is_empty()) {
            let data: Vec<String> =
                run.iter().filter_map(|&(px, py)| py.map(|py| format!("{:.2},{:.2}", x(px), y(py)))).collect();
            let curve = Polyline::new().set("points", data.join(" ")).set("fill", "none").set("stroke", colour);
            inside = inside.add(curve.set("stroke-width", 2));
        }
        let at = TOP + 14.0 + 20.0 * k as f64;
        let sample = Line::new().set("x1", LEFT + WIDTH + 16.0).set("x2", LEFT + WIDTH + 38.0);
        let sample = sample.set("y1", at - 4.0).set("y2", at - 4.0).set("stroke", colour).set("stroke-width", 2);
        legend = legend.add(sample).add(label(name, LEFT + WIDTH + 44.0, at, 11.5));
    }
    let frame = Rectangle::new().set("x", LEFT).set("y", TOP).set("width", WIDTH).set("height", HEIGHT);
    document = document.add(inside).add(frame.set("fill", "none").set("stroke", INK)).add(legend);
    for tick in ticks(low.x, high.x) {
        let mark = Line::new().set("x1", x(tick)).set("x2", x(tick)).set("y1", TOP + HEIGHT);
        let text = label(&length(tick), x(tick), TOP + HEIGHT + 18.0, 11.0).set("text-anchor", "middle");
        document = document.add(mark.set("y2", TOP + HEIGHT + 5.0).set("stroke", INK)).add(text);
    }
    let (unit, power) = power_of_ten(low.y, high.y);
    for tick in ticks(low.y, high.y) {
        let mark = Line::new().set("x1", LEFT - 5.0).set("x2", LEFT).set("y1", y(tick)).set("y2", y(tick));
        let text = label(&length(tick / unit), LEFT - 8.0, y(tick) + 4.0, 11.0).set("text-anchor", "end");
        document = document.add(mark.set("stroke", INK)).add(text);
    }
    document
        .add(label(axes[0], LEFT + WIDTH / 2.0, height - 12.0, 13.0).set("text-anchor", "middle"))
        .add(label(&format!("{}{power}", axes[1]), LEFT, TOP - 10.0, 12.0))
        .to_string()
}
