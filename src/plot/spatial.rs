//! Pictures of the two spatial robots' answers: workspaces, maps of capability and of tilt.

use std::fmt::Write;

use nalgebra::Vector2;
use svg::Document;
use svg::node::element::{ClipPath, Definitions, Group, Path, Rectangle};

use super::plane::{COLOURS, Chart, TOP, colour, label};
use super::scene::number;
use super::symbols::{INK, QUIET};
use crate::manipulator::PlaneWindow;
use crate::spatial::{ArcRegion, CapabilityMap};

/// Points of an arc as it is drawn.
const ARC_POINTS: usize = 60;

/// Regions of the plane `Oyz`, each with its name; over a map of rotational capability where one is given.
pub fn draw_hana(title: &str, regions: &[(String, &ArcRegion)], map: Option<&CapabilityMap>) -> String {
    let boxes: Vec<[f64; 4]> =
        regions.iter().filter_map(|(_, region)| region.bbox).chain(map.map(|map| map.window)).collect();
    let all = boxes.iter().fold([f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY], |all, b| {
        [all[0].min(b[0]), all[1].min(b[1]), all[2].max(b[2]), all[3].max(b[3])]
    });
    let all = if boxes.is_empty() { [-1.0, -1.0, 1.0, 1.0] } else { all };
    let room = 0.06 * (all[2] - all[0]).max(all[3] - all[1]);
    let window = PlaneWindow {
        low: Vector2::new(all[0] - room, all[1] - room),
        high: Vector2::new(all[2] + room, all[3] + room),
    };
    let mut chart = Chart::new(&window);
    chart.axes = ["y", "z"];
    let (mut inside, mut legend) = (Group::new(), Group::new());
    let (x, mut y) = (chart.beside(), TOP + 12.0);
    if let Some(map) = map {
        let highest = map.values.iter().flatten().copied().fold(0.0, f64::max);
        let cell = [
            (map.window[2] - map.window[0]) / map.size[0] as f64,
            (map.window[3] - map.window[1]) / map.size[1] as f64,
        ];
        let mut tiles = Group::new();
        for index in 0..map.values.len() {
            let place = [index % map.size[0], index / map.size[0]];
            let Some(value) = within_or_beside(map, place) else { continue };
            let [py, pz] = map.at(place[0], place[1]);
            let corner = Vector2::new(py - 0.5 * cell[0], pz + 0.5 * cell[1]);
            let opposite = Vector2::new(py + 0.5 * cell[0], pz - 0.5 * cell[1]);
            tiles = tiles.add(tile(&chart, corner, opposite, if highest > 0.0 { value / highest } else { 0.0 }));
        }
        // The exact boundary cuts the tiles.
        let inner: String = regions.iter().map(|(_, region)| outline(&chart, region)).collect();
        if !inner.is_empty() {
            let cut = Path::new().set("d", inner).set("clip-rule", "evenodd");
            inside = inside.add(Definitions::new().add(ClipPath::new().set("id", "region").add(cut)));
            tiles = tiles.set("clip-path", "url(#region)");
        }
        inside = inside.add(tiles);
        legend = scale(legend, x, y, "rotational capability ζ", highest);
        y += 150.0;
    }
    for (k, (name, region)) in regions.iter().enumerate() {
        let colour = COLOURS[k % COLOURS.len()];
        let line = Path::new().set("d", outline(&chart, region)).set("stroke", colour).set("stroke-width", 2);
        let line = line.set("stroke-linejoin", "round").set("fill-rule", "evenodd");
        inside = inside.add(if map.is_some() {
            line.set("fill", "none")
        } else {
            line.set("fill", colour).set("fill-opacity", 0.15)
        });
        let sample = Path::new().set("d", format!("M{x} {}h22", y - 4.0)).set("stroke", colour).set("stroke-width", 2);
        legend = legend.add(sample).add(label(&format!("{name}: area {}", number(region.area)), x + 28.0, y, 11.5));
        y += 18.0;
    }
    legend = legend.add(label("lengths in the model's unit", x, y + 6.0, 10.5).set("fill", QUIET));
    let subtitle = "HANA  ·  places of the platform's centre in the plane x = 0";
    chart.document(if title.is_empty() { "HANA" } else { title }, subtitle, inside, legend)
}

/// A region's loops as the data of one path.
fn outline(chart: &Chart, region: &ArcRegion) -> String {
    let mut data = String::new();
    for (_, arcs) in &region.loops {
        let points = arcs.iter().flat_map(|arc| arc.points(ARC_POINTS));
        for (k, [py, pz]) in points.enumerate() {
            let p = Vector2::new(py, pz);
            // Writing to a String cannot fail.
            let _ = write!(data, "{}{:.2} {:.2}", if k == 0 { 'M' } else { 'L' }, chart.x(p), chart.y(p));
        }
        data.push('Z');
    }
    data
}

/// A cell's value; where its middle is outside, that of a neighbour, for the part of it that the boundary leaves in.
fn within_or_beside(map: &CapabilityMap, [column, row]: [usize; 2]) -> Option<f64> {
    let value = |column: usize, row: usize| {
        let inside = column < map.size[0] && row < map.size[1];
        inside.then(|| map.values[row * map.size[0] + column]).flatten()
    };
    // Nearest first: the four that share a side, then the corners. Beyond the first row the index wraps to one that is outside.
    const AROUND: [[isize; 2]; 9] = [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]];
    AROUND.iter().find_map(|[right, up]| value(column.wrapping_add_signed(*right), row.wrapping_add_signed(*up)))
}

fn tile(chart: &Chart, corner: Vector2<f64>, opposite: Vector2<f64>, part: f64) -> Rectangle {
    Rectangle::new()
        .set("x", format!("{:.2}", chart.x(corner)))
        .set("y", format!("{:.2}", chart.y(corner)))
        .set("width", format!("{:.2}", chart.x(opposite) - chart.x(corner) + 0.3))
        .set("height", format!("{:.2}", chart.y(opposite) - chart.y(corner) + 0.3))
        .set("fill", colour(part))
}

/// A scale of colours from 0 to an angle in radians.
fn scale(legend: Group, x: f64, y: f64, name: &str, highest: f64) -> Group {
    let mut legend = legend.add(label(name, x, y, 12.0));
    for step in 0..=50 {
        let part = f64::from(step) / 50.0;
        let bar = Rectangle::new()
            .set("x", x)
            .set("y", y + 8.0 + 108.8 * (1.0 - part))
            .set("width", 14)
            .set("height", 2.5)
            .set("fill", colour(part));
        legend = legend.add(bar);
    }
    legend.add(label(&format!("{}°", number(highest.to_degrees())), x + 20.0, y + 18.0, 11.0)).add(label(
        "0°",
        x + 20.0,
        y + 118.0,
        11.0,
    ))
}

/// Side of a section's picture, and the room around it, in pixels.
const SECTION: f64 = 190.0;
const ROOM: f64 = 34.0;
/// Left of the first section, for the axis's name and its ends.
const LEFT: f64 = 58.0;
/// Sections side by side.
const ACROSS: usize = 4;

/// Largest tilts over sections, all on one scale: each a height and its values row by row from the lowest corner.
pub fn draw_tilt_sections(
    title: &str,
    low: [f64; 3],
    high: [f64; 3],
    cells: usize,
    sections: &[(f64, Vec<Option<f64>>)],
) -> String {
    let highest = sections.iter().flat_map(|(_, values)| values).flatten().copied().fold(0.0, f64::max);
    let rows = sections.len().div_ceil(ACROSS);
    let columns = sections.len().clamp(1, ACROSS);
    let (width, height) =
        (LEFT + columns as f64 * (SECTION + ROOM) + 130.0, 110.0 + rows as f64 * (SECTION + ROOM + 14.0));
    let mut document = Document::new()
        .set("width", width)
        .set("height", height)
        .set("viewBox", (0, 0, width, height))
        .set("font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif")
        .add(Rectangle::new().set("width", width).set("height", height).set("fill", "#ffffff"))
        .add(label(if title.is_empty() { "Largest tilt" } else { title }, 20.0, 28.0, 18.0).set("font-weight", "bold"))
        .add(
            label(
                "largest tilt that every azimuth allows, over sections  ·  white: home out of limits",
                20.0,
                50.0,
                12.5,
            )
            .set("fill", QUIET),
        );
    let cell = SECTION / cells.max(1) as f64;
    for (k, (z, values)) in sections.iter().enumerate() {
        let left = LEFT + (k % ACROSS) as f64 * (SECTION + ROOM);
        let top = 88.0 + (k / ACROSS) as f64 * (SECTION + ROOM + 14.0);
        let mut group = Group::new();
        for (index, value) in values.iter().enumerate() {
            let Some(value) = value else { continue };
            let (column, row) = (index % cells, index / cells);
            let part = if highest > 0.0 { value / highest } else { 0.0 };
            group = group.add(
                Rectangle::new()
                    .set("x", format!("{:.2}", left + column as f64 * cell))
                    .set("y", format!("{:.2}", top + SECTION - (row + 1) as f64 * cell))
                    .set("width", format!("{:.2}", cell + 0.3))
                    .set("height", format!("{:.2}", cell + 0.3))
                    .set("fill", colour(part)),
            );
        }
        let frame = Rectangle::new().set("x", left).set("y", top).set("width", SECTION).set("height", SECTION);
        let end = |value: f64, x: f64, y: f64, anchor: &'static str| {
            label(&number(value), x, y, 10.0).set("text-anchor", anchor).set("fill", QUIET)
        };
        if k % ACROSS == 0 {
            let names = [end(low[1], left - 4.0, top + SECTION, "end"), end(high[1], left - 4.0, top + 9.0, "end")];
            document = names.into_iter().fold(document, Document::add);
            document = document.add(label("y", left - 14.0, top + 0.5 * SECTION, 12.0).set("font-style", "italic"));
        }
        if k + ACROSS >= sections.len() {
            let below = top + SECTION + 13.0;
            let names = [end(low[0], left, below, "start"), end(high[0], left + SECTION, below, "end")];
            document = names.into_iter().fold(document, Document::add);
            document = document.add(label("x", left + 0.5 * SECTION, below, 12.0).set("font-style", "italic"));
        }
        document = document.add(group).add(frame.set("fill", "none").set("stroke", INK)).add(label(
            &format!("z = {}", number(*z)),
            left,
            top - 6.0,
            12.0,
        ));
    }
    let legend = scale(Group::new(), LEFT + columns as f64 * (SECTION + ROOM), 100.0, "largest tilt", highest);
    document.add(legend).to_string()
}
