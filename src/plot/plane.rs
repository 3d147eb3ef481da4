//! Pictures of the plane: singular curves, maps, paths.

use nalgebra::Vector2;
use svg::Document;
use svg::node::element::{Circle, ClipPath, Definitions, Group, Line, Path, Polyline, Rectangle, Text};

use super::scene::{heading, number};
use super::symbols::{ALARM, INK, QUIET};
use crate::manipulator::{FollowedPath, Manipulator, PathEventKind, PlaneMap, PlaneWindow};

/// Side of the picture of the plane, room around it and for the legend beside it, in pixels.
const SIDE: f64 = 560.0;
const LEFT: f64 = 70.0;
pub(super) const TOP: f64 = 72.0;
const BESIDE: f64 = 215.0;
const BOTTOM: f64 = 46.0;
/// Colours of curves and modes: Okabe and Ito's, told apart in all kinds of colour vision, with brown for their yellow, which is lost on white.
pub(super) const COLOURS: [&str; 8] =
    ["#d55e00", "#0072b2", "#009e73", "#e69f00", "#cc79a7", "#56b4e9", "#7a4a21", "#000000"];
/// Curves of type 1.
const EDGE: &str = "#8a949e";

/// From positions to pixels.
pub(super) struct Chart {
    window: PlaneWindow,
    scale: f64,
    pub(super) size: Vector2<f64>,
    /// Names of the axes.
    pub(super) axes: [&'static str; 2],
}

impl Chart {
    pub(super) fn new(window: &PlaneWindow) -> Self {
        let extent = (window.high - window.low).map(|side| side.max(f64::MIN_POSITIVE));
        let scale = SIDE / extent.max();
        Self { window: *window, scale, size: extent * scale, axes: ["x", "y"] }
    }

    pub(super) fn x(&self, p: Vector2<f64>) -> f64 {
        LEFT + (p.x - self.window.low.x) * self.scale
    }

    pub(super) fn y(&self, p: Vector2<f64>) -> f64 {
        TOP + (self.window.high.y - p.y) * self.scale
    }

    pub(super) fn document(&self, title: &str, subtitle: &str, inside: Group, legend: Group) -> String {
        let (width, height) = (LEFT + self.size.x + BESIDE, TOP + self.size.y + BOTTOM);
        let frame =
            || Rectangle::new().set("x", LEFT).set("y", TOP).set("width", self.size.x).set("height", self.size.y);
        let mut document = Document::new()
            .set("width", width)
            .set("height", height)
            .set("viewBox", (0, 0, width, height))
            .set("font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif")
            .add(Rectangle::new().set("width", width).set("height", height).set("fill", "#ffffff"))
            .add(Definitions::new().add(ClipPath::new().set("id", "plane").add(frame())))
            .add(label(title, LEFT, 28.0, 18.0).set("font-weight", "bold"))
            .add(label(subtitle, LEFT, 50.0, 12.5).set("fill", QUIET))
            .add(inside.set("clip-path", "url(#plane)"))
            .add(frame().set("fill", "none").set("stroke", INK));
        // Both axes have one scale, so one step as well.
        let step = tick_step(0.8 * (self.window.high - self.window.low).max());
        for axis in 0..2 {
            for tick in multiples(step, self.window.low[axis], self.window.high[axis]) {
                let at = if axis == 0 {
                    Vector2::new(tick, self.window.low.y)
                } else {
                    Vector2::new(self.window.low.x, tick)
                };
                let (x, y) = (self.x(at), self.y(at));
                let (to, place, anchor) = if axis == 0 {
                    ((x, y + 5.0), (x, y + 18.0), "middle")
                } else {
                    ((x - 5.0, y), (x - 8.0, y + 4.0), "end")
                };
                let mark = Line::new().set("x1", x).set("y1", y).set("x2", to.0).set("y2", to.1).set("stroke", INK);
                document =
                    document.add(mark).add(label(&number(tick), place.0, place.1, 11.0).set("text-anchor", anchor));
            }
        }
        let [across, up] = self.axes;
        let names = [(across, LEFT + self.size.x / 2.0, height - 10.0), (up, 14.0, TOP + self.size.y / 2.0)];
        for (name, x, y) in names {
            document = document.add(label(name, x, y, 13.0).set("font-style", "italic"));
        }
        document.add(legend).to_string()
    }

    pub(super) fn length(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// Whether a place is in the picture.
    pub(super) fn shows(&self, p: Vector2<f64>) -> bool {
        (0..2).all(|axis| self.window.low[axis] <= p[axis] && p[axis] <= self.window.high[axis])
    }

    pub(super) fn middle(&self) -> Vector2<f64> {
        (self.window.low + self.window.high) / 2.0
    }

    pub(super) fn diagonal(&self) -> f64 {
        (self.window.high - self.window.low).norm()
    }

    pub(super) fn beside(&self) -> f64 {
        LEFT + self.size.x + 16.0
    }
}

/// Round numbers in a range, four to nine of them.
pub(super) fn ticks(low: f64, high: f64) -> Vec<f64> {
    multiples(tick_step(high - low), low, high)
}

/// A round step that a range holds four to nine of.
fn tick_step(extent: f64) -> f64 {
    let decade = 10_f64.powf((extent / 4.0).log10().floor());
    [5.0, 2.0, 1.0].map(|s| s * decade).into_iter().find(|s| *s <= extent / 4.0).unwrap_or(decade)
}

fn multiples(step: f64, low: f64, high: f64) -> Vec<f64> {
    let first = (low / step).ceil() as i64;
    (first..first + 14).map(|k| k as f64 * step).take_while(|tick| *tick <= high).collect()
}

pub(super) fn label(content: &str, x: f64, y: f64, size: f64) -> Text {
    Text::new(content).set("x", x).set("y", y).set("font-size", size).set("fill", INK)
}

/// A label that stays readable on lines: with a white edge.
pub(super) fn on_lines(text: Text) -> Text {
    text.set("stroke", "#ffffff").set("stroke-width", 3).set("stroke-linejoin", "round").set("paint-order", "stroke")
}

/// Where a manipulator is singular for a fixed orientation: each mode's curve of type 2 in its colour, the legs' curves of type 1 grey, `legs` their
/// pieces; a map under them where one is given.
pub fn draw_singularities(
    robot: &Manipulator,
    phi: f64,
    window: &PlaneWindow,
    modes: &[(String, Vec<[Vector2<f64>; 2]>)],
    legs: &[Vec<[Vector2<f64>; 2]>],
    map: Option<&PlaneMap>,
) -> String {
    let chart = Chart::new(window);
    let (mut inside, mut background) = (Group::new(), Group::new());
    let mut legend = Group::new();
    let x = chart.beside();
    let mut y = TOP + 12.0;
    if let Some(map) = map {
        let known = || map.values.iter().flatten().copied();
        let (low, high) = known().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        // Accuracy and stiffness run over decades: quantiles keep a few extremes from washing out the rest.
        let mut sorted: Vec<f64> = known().collect();
        sorted.sort_by(f64::total_cmp);
        let shade = |value: f64| sorted.partition_point(|v| *v < value) as f64 / sorted.len().max(1) as f64;
        let cell = chart.size.component_div(&Vector2::new(map.size[0] as f64, map.size[1] as f64));
        for (index, value) in map.values.iter().enumerate() {
            let Some(value) = value else { continue };
            let p = map.at(index % map.size[0], index / map.size[0]);
            let rectangle = Rectangle::new()
                .set("x", format!("{:.2}", chart.x(p) - cell.x / 2.0))
                .set("y", format!("{:.2}", chart.y(p) - cell.y / 2.0))
                .set("width", format!("{:.2}", cell.x + 0.3))
                .set("height", format!("{:.2}", cell.y + 0.3))
                .set("fill", colour(shade(*value)));
            background = background.add(rectangle);
        }
        legend = legend.add(label(&format!("{} ({})", map.quantity.name(), map.signs), x, y, 12.0));
        for step in 0..=10 {
            let part = f64::from(step) / 10.0;
            let bar = Rectangle::new()
                .set("x", x)
                .set("y", y + 8.0 + 100.0 * (1.0 - part))
                .set("width", 14)
                .set("height", 11)
                .set("fill", colour(part));
            legend = legend.add(bar);
        }
        for (value, place) in [(high, y + 18.0), (low, y + 118.0)] {
            if value.is_finite() {
                legend = legend.add(label(&number(value), x + 20.0, place, 11.0));
            }
        }
        y += 150.0;
    }
    for (signs, pieces) in modes {
        let colour = COLOURS[modes.iter().position(|m| m.0 == *signs).unwrap_or(0) % COLOURS.len()];
        let data = strokes(&chart, pieces);
        if !data.is_empty() {
            inside = inside
                .add(Path::new().set("d", data).set("stroke", colour).set("stroke-width", 1.8).set("fill", "none"));
        }
        let sample = Line::new().set("x1", x).set("x2", x + 22.0).set("y1", y - 4.0).set("y2", y - 4.0);
        let shown = if pieces.is_empty() { format!("{signs} (none here)") } else { signs.clone() };
        legend = legend.add(sample.set("stroke", colour).set("stroke-width", 2)).add(label(
            &format!("type 2, {}", shown.replace('-', "−")),
            x + 28.0,
            y,
            11.5,
        ));
        y += 18.0;
    }
    let data = strokes(&chart, legs.iter().flatten());
    if !data.is_empty() {
        // Under the curves of type 2.
        let edges = Path::new().set("d", data).set("stroke", EDGE).set("stroke-width", 1.2).set("fill", "none");
        inside = Group::new().add(background).add(edges).add(inside);
    } else {
        inside = Group::new().add(background).add(inside);
    }
    let sample = Line::new().set("x1", x).set("x2", x + 22.0).set("y1", y - 4.0).set("y2", y - 4.0);
    legend = legend.add(sample.set("stroke", EDGE).set("stroke-width", 1.2)).add(label(
        "type 1, ends of a leg's reach",
        x + 28.0,
        y,
        10.5,
    ));
    let (title, family) = heading(robot);
    let subtitle = format!("{family}singular positions at φ = {}°", number(phi.to_degrees()));
    chart.document(&title, &subtitle, inside, legend)
}

/// Straight pieces as the data of one path.
fn strokes<'a>(chart: &Chart, pieces: impl IntoIterator<Item = &'a [Vector2<f64>; 2]>) -> String {
    let stroke = |[p, q]: &[Vector2<f64>; 2]| {
        format!("M{:.2} {:.2}L{:.2} {:.2}", chart.x(*p), chart.y(*p), chart.x(*q), chart.y(*q))
    };
    pieces.into_iter().map(stroke).collect()
}

/// From low to high: dark blue, green, yellow.
pub(super) fn colour(part: f64) -> String {
    let stops =
        [[68.0, 1.0, 84.0], [59.0, 82.0, 139.0], [33.0, 145.0, 140.0], [94.0, 201.0, 98.0], [253.0, 231.0, 37.0]];
    let place = part.clamp(0.0, 1.0) * 4.0;
    let k = (place.floor() as usize).min(3);
    let mix = |c: usize| (stops[k][c] + (place - k as f64) * (stops[k + 1][c] - stops[k][c])).round() as u8;
    format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
}

/// The way of the platform's origin along a path, with its events.
pub fn draw_path(robot: &Manipulator, path: &FollowedPath) -> String {
    let points: Vec<Vector2<f64>> = path.rows.iter().map(|row| Vector2::new(row.pose.x, row.pose.y)).collect();
    let all = || points.iter().copied().chain(path.events.iter().map(|e| Vector2::new(e.pose.x, e.pose.y)));
    let infinite = Vector2::repeat(f64::INFINITY);
    let (low, high) = all().fold((infinite, -infinite), |(l, h), p| (l.inf(&p), h.sup(&p)));
    let side = (high - low).max();
    let room = if side > 0.0 { 0.12 * side } else { 1.0 };
    let window = PlaneWindow { low: low - Vector2::repeat(room), high: high + Vector2::repeat(room) };
    let chart = Chart::new(&window);
    let line: Vec<String> = points.iter().map(|p| format!("{:.2},{:.2}", chart.x(*p), chart.y(*p))).collect();
    let curve = Polyline::new()
        .set("points", line.join(" "))
        .set("fill", "none")
        .set("stroke", COLOURS[1])
        .set("stroke-width", 2);
    let mut inside = Group::new().add(curve);
    let dot = |p: Vector2<f64>, fill: &str, r: f64| {
        Circle::new().set("cx", chart.x(p)).set("cy", chart.y(p)).set("r", r).set("fill", fill.to_owned())
    };
    if let Some(first) = points.first() {
        inside = inside.add(dot(*first, COLOURS[2], 4.5));
    }
    for event in &path.events {
        let fill = if matches!(event.kind, PathEventKind::Limit { .. }) { COLOURS[3] } else { ALARM };
        inside = inside.add(dot(Vector2::new(event.pose.x, event.pose.y), fill, 4.5));
    }
    let (x, mut y) = (chart.beside(), TOP + 12.0);
    let mut legend = Group::new();
    for (fill, text) in [(COLOURS[2], "start"), (ALARM, "modes meet, path stops"), (COLOURS[3], "limit crossed")] {
        let mark = Circle::new().set("cx", x + 5.0).set("cy", y - 4.0).set("r", 4.5).set("fill", fill);
        legend = legend.add(mark).add(label(text, x + 18.0, y, 11.5));
        y += 18.0;
    }
    let id = path.rows.first().map_or(0, |row| row.id);
    let end = match (path.complete, path.closed_in) {
        (true, Some(last)) if last != id => format!("closed, ends in mode {last}"),
        (true, Some(_)) => "closed, ends in the same mode".to_owned(),
        (true, None) => "complete".to_owned(),
        (false, _) => "stopped".to_owned(),
    };
    let (title, family) = heading(robot);
    let subtitle = format!("{family}mode {id} along {} rows  ·  {end}", path.rows.len());
    chart.document(&title, &subtitle, inside, legend)
}
