//! Where it is drawn: panels side by side on one scale, a title, a legend, a scale bar.

use nalgebra::Vector2;
use svg::Document;
use svg::node::element::{ClipPath, Definitions, Group, Rectangle, Text};

use super::scene::{Look, Mark, Scene, length};
use super::symbols::{self, Canvas, INK, PAPER, QUIET};

/// Width of a panel, and bounds of its height, in pixels.
const PANEL_WIDTH: f64 = 300.0;
const PANEL_HEIGHT: [f64; 2] = [200.0, 360.0];
/// Free room inside a panel around the mechanism, for symbols of fixed size.
const MARGIN: f64 = 30.0;
/// Room under a panel for its caption.
const CAPTION: f64 = 30.0;
/// Gap between panels and around the sheet.
const GAP: f64 = 16.0;
const HEADER: f64 = 62.0;
const LEGEND: f64 = 44.0;
/// Width that a letter of the legend takes on average.
const LETTER: f64 = 5.8;
/// Part of the window by which a point may lie beyond it and still count as inside: rounding, not reach.
const EDGE: f64 = 0.01;
/// A mode that reaches this many times as far as the middle one is cut off rather than shrink all others.
const OUTLIER: f64 = 6.0;

/// The part of the plane that every panel shows.
struct Window {
    low: Vector2<f64>,
    high: Vector2<f64>,
}

impl Window {
    fn around(points: impl IntoIterator<Item = Vector2<f64>>) -> Self {
        let infinite = Vector2::repeat(f64::INFINITY);
        let empty = Self { low: infinite, high: -infinite };
        points.into_iter().fold(empty, |window, p| Self { low: window.low.inf(&p), high: window.high.sup(&p) })
    }

    fn size(&self) -> Vector2<f64> {
        (self.high - self.low).map(|side| side.max(0.0))
    }

    fn contains(&self, p: Vector2<f64>) -> bool {
        let edge = EDGE * self.size().max();
        (0..2).all(|axis| self.low[axis] - edge <= p[axis] && p[axis] <= self.high[axis] + edge)
    }

    /// The window of the scenes that are not absurdly far from the others.
    fn of(scenes: &[Scene]) -> Self {
        let own = |scene: &Scene| Self::around(scene.marks.iter().flat_map(Mark::points));
        let mut reach: Vec<f64> = scenes.iter().map(|scene| own(scene).size().norm()).collect();
        reach.sort_by(f64::total_cmp);
        let typical = reach.get(reach.len().saturating_sub(1) / 2).copied().unwrap_or(0.0);
        let ordinary = scenes.iter().filter(|scene| own(scene).size().norm() <= OUTLIER * typical);
        let window = Self::around(ordinary.flat_map(|scene| scene.marks.iter().flat_map(Mark::points)));
        let side = window.size().max();
        // A single point, or nothing at all, still needs a window of some size.
        let (centre, side) = if side > 0.0 { ((window.low + window.high) / 2.0, side) } else { (window.low, 1.0) };
        let centre = if centre.iter().all(|c| c.is_finite()) { centre } else { Vector2::zeros() };
        let half = (window.size() / 2.0).map(|length| length.max(0.2 * side));
        Self { low: centre - half, high: centre + half }
    }
}

/// The document: scenes as small multiples on one scale.
pub(super) fn sheet(title: &str, subtitle: &str, scenes: &[Scene]) -> String {
    let window = Window::of(scenes);
    let size = window.size();
    let inner_width = PANEL_WIDTH - 2.0 * MARGIN;
    let height = (inner_width * size.y / size.x + 2.0 * MARGIN).clamp(PANEL_HEIGHT[0], PANEL_HEIGHT[1]);
    let scale = (inner_width / size.x).min((height - 2.0 * MARGIN) / size.y);
    let columns = match scenes.len() {
        0 | 1 => 1,
        2 | 4 => 2,
        _ => 3,
    };
    let rows = scenes.len().div_ceil(columns);
    // A single panel still leaves room for the title and the legend.
    let sheet_columns = columns.max(2) as f64;
    let width = GAP + sheet_columns * (PANEL_WIDTH + GAP);
    let full_height = HEADER + rows as f64 * (height + CAPTION + GAP) + LEGEND;
    let inset = (width - GAP - columns as f64 * (PANEL_WIDTH + GAP)) / 2.0;

    let frame = Rectangle::new().set("width", PANEL_WIDTH).set("height", height).set("rx", 3);
    let mut document = Document::new()
        .set("width", width)
        .set("height", full_height)
        .set("viewBox", (0, 0, width, full_height))
        .set("font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif")
        .add(Rectangle::new().set("width", width).set("height", full_height).set("fill", "#ffffff"))
        .add(Definitions::new().add(ClipPath::new().set("id", "panel").add(frame.clone())))
        .add(text(title, GAP, 28.0, 18.0).set("font-weight", "bold"))
        .add(text(subtitle, GAP, 49.0, 12.5).set("fill", QUIET));
    for (index, scene) in scenes.iter().enumerate() {
        let x = inset + GAP + (index % columns) as f64 * (PANEL_WIDTH + GAP);
        let y = HEADER + (index / columns) as f64 * (height + CAPTION + GAP);
        let canvas = Canvas {
            scale,
            centre: (window.low + window.high) / 2.0,
            middle: Vector2::new(PANEL_WIDTH / 2.0, height / 2.0),
        };
        let frame = frame.clone().set("fill", PAPER).set("stroke", "#d5d9de");
        let panel = Group::new().set("transform", format!("translate({x:.1} {y:.1})")).add(frame);
        document = document.add(draw_panel(panel, scene, &window, &canvas, height));
    }
    document.add(legend(full_height - LEGEND + 14.0, width, scale, scenes)).to_string()
}

fn draw_panel(panel: Group, scene: &Scene, window: &Window, canvas: &Canvas, height: f64) -> Group {
    let mut marks: Vec<&Mark> = scene.marks.iter().collect();
    marks.sort_by_key(|mark| mark.layer());
    let mechanism = Group::new().set("clip-path", "url(#panel)");
    let mechanism = marks.into_iter().fold(mechanism, |group, mark| group.add(symbols::draw(mark, canvas)));
    let mut panel = panel.add(mechanism);
    let mut left = 4.0;
    if let Some(number) = scene.number {
        panel = panel.add(text(&number.to_string(), 4.0, height + 18.0, 13.0).set("font-weight", "bold"));
        left = 22.0;
    }
    panel = panel.add(text(&scene.caption, left, height + 18.0, 12.5));
    match scene.pose {
        Some(pose) if !window.contains(Vector2::new(pose.x, pose.y)) => {
            let note = format!("reaches outside: platform at ({}, {})", length(pose.x), length(pose.y));
            panel.add(text(&note, 8.0, 18.0, 11.0).set("fill", symbols::ALARM))
        }
        _ => panel,
    }
}

fn legend(y: f64, width: f64, scale: f64, scenes: &[Scene]) -> Group {
    let marks = || scenes.iter().flat_map(|scene| &scene.marks);
    let looks = |mark: &Mark| match mark {
        Mark::Telescope { look, .. } | Mark::Block { look, .. } | Mark::Pin { look, .. } => Some(*look),
        _ => None,
    };
    let canvas = Canvas { scale: 1.0, centre: Vector2::zeros(), middle: Vector2::zeros() };
    let plain = Look::default();
    let here = Vector2::zeros();
    let pin = |look| Mark::Pin { at: here, look };
    let mut entries = vec![(pin(plain), "revolute")];
    if marks().any(|mark| matches!(mark, Mark::Block { .. })) {
        entries.push((Mark::Block { at: here, along: Vector2::x(), look: plain }, "slider"));
    }
    if marks().any(|mark| matches!(mark, Mark::Telescope { .. })) {
        let (from, to) = (Vector2::new(-14.0, 0.0), Vector2::new(14.0, 0.0));
        entries.push((Mark::Telescope { from, to, look: plain }, "sliding link"));
    }
    if marks().filter_map(looks).any(|look| look.actuated) {
        entries.push((pin(Look { actuated: true, violated: false }), "actuated"));
    }
    if marks().filter_map(looks).any(|look| look.violated) {
        entries.push((pin(Look { actuated: false, violated: true }), "outside its limits"));
    }
    let mut group = Group::new().set("transform", format!("translate({GAP} {y:.1})"));
    let mut x = 4.0;
    for (mark, label) in entries {
        let half = match mark {
            Mark::Telescope { .. } => 18.0,
            Mark::Block { .. } => 11.0,
            _ => 8.0,
        };
        let symbol = symbols::draw(&mark, &canvas);
        group = group
            .add(Group::new().set("transform", format!("translate({:.1} 0)", x + half)).add(symbol))
            .add(text(label, x + 2.0 * half + 4.0, 4.0, 11.0));
        x += 2.0 * half + 18.0 + LETTER * label.len() as f64;
    }
    group.add(scale_bar(width - 3.0 * GAP, scale))
}

/// A bar of a round length, about a quarter of a panel long, that ends at `right`.
fn scale_bar(right: f64, scale: f64) -> Group {
    let wanted = PANEL_WIDTH / 4.0 / scale;
    let decade = 10_f64.powf(wanted.log10().floor());
    let steps = [5.0, 2.0, 1.0].map(|step| step * decade);
    let round = steps.into_iter().find(|step| *step <= wanted).unwrap_or(decade);
    let pixels = round * scale;
    let label = text(&length(round), right - pixels / 2.0, -6.0, 11.5).set("text-anchor", "middle");
    Group::new().add(symbols::scale_bar(right - pixels, right)).add(label)
}

fn text(content: &str, x: f64, y: f64, size: f64) -> Text {
    Text::new(content)
        .set("x", format!("{x:.1}"))
        .set("y", format!("{y:.1}"))
        .set("font-size", size)
        .set("fill", INK)
        .set("xml:space", "preserve")
}
