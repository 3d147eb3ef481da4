//! Workspaces as DXF, for drawing programs.
//!
//! The form is that of AutoCAD release 12 (`AC1009`), which every program reads: `LINE`, `ARC` and `CIRCLE` are exact; coupler curves and
//! ellipses are `POLYLINE`s of many points. Layers tell what a piece is: `OUTER`, `HOLE`, `ISOLATED`, `SEPARATING`. Source: AutoCAD
//! Release 12 Customization Manual, chapter 11.

use std::f64::consts::TAU;
use std::fmt::Write;

use crate::workspace::{ArcCurve, BoundaryArc, Isolated, Workspace};

/// Points along a curve that DXF R12 has no entity for.
const POINTS: usize = 129;
/// An arc whose turn misses a whole one by less than this, radians, is a circle: its ends are one point to all digits that a
/// drawing has.
const FULL: f64 = 1e-9;

/// A DXF entity after the other, each a list of pairs of a group code and a value.
struct Entities(String);

impl Entities {
    fn pair(&mut self, code: u16, value: impl std::fmt::Display) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.0, "{code:3}\n{value}");
    }

    fn start(&mut self, entity: &str, layer: &str) {
        self.pair(0, entity);
        self.pair(8, layer);
    }

    fn point(&mut self, codes: [u16; 3], [x, y]: [f64; 2]) {
        self.pair(codes[0], real(x));
        self.pair(codes[1], real(y));
        self.pair(codes[2], real(0.0));
    }

    fn arc(&mut self, arc: &BoundaryArc, layer: &str) {
        match &arc.curve {
            ArcCurve::Line => {
                self.start("LINE", layer);
                self.point([10, 20, 30], arc.start);
                self.point([11, 21, 31], arc.end);
            }
            ArcCurve::Circle { center, radius, start_angle, end_angle } => {
                let full = (end_angle - start_angle).abs() >= TAU - FULL;
                self.start(if full { "CIRCLE" } else { "ARC" }, layer);
                self.point([10, 20, 30], *center);
                self.pair(40, real(*radius));
                if !full {
                    // DXF arcs run counter-clockwise, in degrees.
                    let (from, to) =
                        if start_angle < end_angle { (start_angle, end_angle) } else { (end_angle, start_angle) };
                    self.pair(50, real(from.rem_euclid(TAU).to_degrees()));
                    self.pair(51, real(to.rem_euclid(TAU).to_degrees()));
                }
            }
            ArcCurve::Coupler(_) | ArcCurve::Ellipse(_) => {
                self.start("POLYLINE", layer);
                self.pair(66, 1);
                self.point([10, 20, 30], [0.0; 2]);
                self.pair(70, 0);
                for p in arc.points(POINTS) {
                    self.start("VERTEX", layer);
                    self.point([10, 20, 30], p);
                }
                self.start("SEQEND", layer);
            }
        }
    }
}

/// A number with a point and without an exponent, as DXF wants reals: the shortest digits that give it back.
fn real(value: f64) -> String {
    let text = value.to_string();
    if text.contains('.') { text } else { text + ".0" }
}

/// A workspace's boundary as a DXF drawing, in the file's length unit.
///
/// ```
/// use assur::exchange::workspace_dxf;
/// use assur::workspace::{WorkspaceKind, WorkspaceModes};
/// # let (mut robot, _) = assur::Manipulator::of_family("3-RPR")?;
/// # robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([5.0, 14.0]));
/// let workspace = robot.workspace(&WorkspaceKind::Constant { phi: 0.3 }, &WorkspaceModes::Both)?;
/// let drawing = workspace_dxf(&workspace);
/// assert!(drawing.contains("ARC\n  8\nOUTER\n") && drawing.ends_with("  0\nEOF\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn workspace_dxf(workspace: &Workspace) -> String {
    let region = &workspace.region;
    let mut out = Entities(String::new());
    out.pair(0, "SECTION");
    out.pair(2, "HEADER");
    out.pair(9, "$ACADVER");
    out.pair(1, "AC1009");
    if let Some([x0, y0, x1, y1]) = region.bbox {
        out.pair(9, "$EXTMIN");
        out.point([10, 20, 30], [x0, y0]);
        out.pair(9, "$EXTMAX");
        out.point([10, 20, 30], [x1, y1]);
    }
    out.pair(0, "ENDSEC");
    out.pair(0, "SECTION");
    out.pair(2, "TABLES");
    out.pair(0, "TABLE");
    out.pair(2, "LAYER");
    // Name and colour number: blue, red, magenta, grey.
    let layers = [("OUTER", 5), ("HOLE", 1), ("ISOLATED", 6), ("SEPARATING", 8)];
    out.pair(70, layers.len());
    for (name, colour) in layers {
        out.pair(0, "LAYER");
        out.pair(2, name);
        out.pair(70, 0);
        out.pair(62, colour);
        out.pair(6, "CONTINUOUS");
    }
    out.pair(0, "ENDTAB");
    out.pair(0, "ENDSEC");
    out.pair(0, "SECTION");
    out.pair(2, "ENTITIES");
    for one in &region.loops {
        let layer = if one.area < 0.0 { "HOLE" } else { "OUTER" };
        one.arcs.iter().for_each(|arc| out.arc(arc, layer));
    }
    for part in &region.isolated {
        match part {
            Isolated::Point { at, .. } => {
                out.start("POINT", "ISOLATED");
                out.point([10, 20, 30], *at);
            }
            Isolated::Curve(arc) => out.arc(arc, "ISOLATED"),
        }
    }
    workspace.separating.iter().for_each(|arc| out.arc(arc, "SEPARATING"));
    out.pair(0, "ENDSEC");
    out.pair(0, "EOF");
    out.0
}
