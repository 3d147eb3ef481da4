//! Symbols as the page takes them: what they are, the points they reach, how they look.
//!
//! What is only looked at has as many digits as can be seen; poses, inputs and handles, from which the next question starts, have all of theirs.

use assur::nalgebra::Vector2;
use assur::plot::{Look, Mark};
use serde_json::{Value, json};

/// Coordinates for the screen are told to this share of the mechanism's size: far below a pixel at any useful magnification.
const FINENESS: f64 = 1e-6;

/// The decimals that a drawing's coordinates have.
#[derive(Clone, Copy)]
pub(crate) struct Grid {
    /// A power of ten; none where rounding would not shorten anything.
    per_unit: Option<f64>,
}

impl Grid {
    /// For a mechanism of this size.
    pub(crate) fn of(size: f64) -> Self {
        let decimals = -(size * FINENESS).log10().floor();
        // Powers beyond these are not exact, and such numbers are short anyway or not ordinary.
        Self { per_unit: (0.0..=15.0).contains(&decimals).then(|| 10_f64.powi(decimals as i32)) }
    }

    pub(crate) fn point(self, at: impl Into<[f64; 2]>) -> [f64; 2] {
        at.into().map(|v: f64| match self.per_unit {
            Some(per_unit) if (v * per_unit).is_finite() => (v * per_unit).round() / per_unit,
            _ => v,
        })
    }

    pub(crate) fn points(self, points: impl IntoIterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
        points.into_iter().map(|at| self.point(at)).collect()
    }
}

pub(crate) fn marks(marks: &[Mark], grid: Grid) -> Value {
    marks.iter().map(|one| mark(one, grid)).collect()
}

fn mark(mark: &Mark, grid: Grid) -> Value {
    let look = |Look { actuated, violated }: Look| json!({ "actuated": actuated, "violated": violated });
    let at = |points: &[Vector2<f64>]| grid.points(points.iter().map(|&point| point.into()));
    // A direction is no longer than one.
    let way = |x: f64, y: f64| Grid::of(1.0).point([x, y]);
    match *mark {
        Mark::Body { ref corners } => json!({ "mark": "body", "at": at(corners) }),
        Mark::Rail { from, to, along, fixed } => {
            json!({ "mark": "rail", "at": at(&[from, to]), "along": way(along.x, along.y), "fixed": fixed })
        }
        Mark::Ground { at: point } => json!({ "mark": "ground", "at": at(&[point]) }),
        Mark::Number { at: point, leg } => json!({ "mark": "number", "at": at(&[point]), "leg": leg }),
        Mark::Bar { from, to } => json!({ "mark": "bar", "at": at(&[from, to]) }),
        Mark::Telescope { from, to, look: joint } => {
            json!({ "mark": "telescope", "at": at(&[from, to]), "look": look(joint) })
        }
        Mark::Block { at: point, along, look: joint } => {
            json!({ "mark": "block", "at": at(&[point]), "along": way(along.x, along.y), "look": look(joint) })
        }
        Mark::Pin { at: point, look: joint } => json!({ "mark": "pin", "at": at(&[point]), "look": look(joint) }),
        Mark::Frame { pose } => {
            let (point, along) = (pose.translation.vector, pose.rotation);
            json!({ "mark": "frame", "at": at(&[point]), "along": way(along.re, along.im) })
        }
    }
}
