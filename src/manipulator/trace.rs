//! Drawn for a fixed orientation: the singular curve of each working mode, and maps of how well the platform is held.
//!
//! The exact curve of all modes is [`super::locus`]; here each mode's own piece is found by the sign of its `det A` on squares that are halved
//! where the sign changes and where a leg's reach ends. What it cannot do: a drawing misses pieces smaller than its squares.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::describe::{JointKind, Leg, Manipulator};
use super::inverse::KinematicsError;
use super::joints::branch_count;
use super::locus::{LegLocus, PlaneCurve};
use super::singular::positive_length;
use crate::linkage::Pose;

/// A rectangle of positions of the platform's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneWindow {
    /// Lower left corner.
    pub low: Vector2<f64>,
    /// Upper right corner.
    pub high: Vector2<f64>,
}

/// What a map shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapQuantity {
    /// [`super::Velocity::dexterity`].
    Dexterity,
    /// [`super::Velocity::position_error`] of the reference point.
    Accuracy,
    /// [`super::Velocity::stiffness`].
    Stiffness,
}

impl MapQuantity {
    /// `dexterity`, `accuracy` or `stiffness`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dexterity => "dexterity",
            Self::Accuracy => "accuracy",
            Self::Stiffness => "stiffness",
        }
    }
}

/// A quantity over the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneMap {
    /// What it shows.
    pub quantity: MapQuantity,
    /// The orientation, in radians.
    pub phi: f64,
    /// The working mode.
    pub signs: String,
    /// The characteristic length used.
    pub characteristic_length: f64,
    /// The part of the plane.
    pub window: PlaneWindow,
    /// Columns and rows.
    pub size: [usize; 2],
    /// Values at the middles of the cells, row by row from below, left to right; `None` where a leg does not reach within its limits, and where the value is infinite.
    pub values: Vec<Option<f64>>,
}

impl PlaneMap {
    /// The middle of a cell.
    pub fn at(&self, column: usize, row: usize) -> Vector2<f64> {
        let part = Vector2::new((column as f64 + 0.5) / self.size[0] as f64, (row as f64 + 0.5) / self.size[1] as f64);
        self.window.low + (self.window.high - self.window.low).component_mul(&part)
    }
}

/// A determinant below this part of its rows' sizes is what rounding leaves of zero: some tens of units in the last place.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Cells along each side of the coarse grid of a drawn curve.
const COARSE: usize = 96;
/// Halvings of a square that the curve passes, and of one in which a leg's reach ends.
const HALVINGS: usize = 3;
/// Halvings of a square's side towards the curve: to a hundred-thousandth of it.
const BISECTIONS: usize = 17;
/// Pieces of a drawn curve of type 1.
const ARCS: usize = 720;
/// How far beside a curve of type 1, in parts of the window, the reach of the other legs is looked at.
const BESIDE: f64 = 1e-6;

impl Manipulator {
    /// The part of the plane worth looking at: where all legs reach in some working mode, within the limits, with a little room; where sliders without
    /// limits reach for ever, or nothing is reached, around the points from which the legs' bases see the platform's origin, with room for links and strokes.
    pub fn plane_window(&self, phi: f64) -> PlaneWindow {
        let turn = Pose::new(0.0, 0.0, phi);
        let centres: Vec<Vector2<f64>> =
            self.legs.iter().map(|leg| leg.base.at - turn.place(leg.platform.at)).collect();
        let (mut low, mut high) = (centres[0], centres[0]);
        for centre in &centres {
            (low, high) = (low.inf(centre), high.sup(centre));
        }
        let reach = |leg: &Leg| {
            let links: f64 = leg.links.iter().map(|link| link.at.norm()).sum();
            let strokes = leg.joints.iter().zip(&leg.limits).filter(|(kind, _)| **kind == JointKind::Prismatic);
            links + strokes.filter_map(|(_, limit)| limit.map(|[a, b]| a.abs().max(b.abs()))).sum::<f64>()
        };
        let spread = self.legs.iter().map(|leg| leg.platform.at.norm()).fold(self.characteristic_length(), f64::max);
        let room = self.legs.iter().map(reach).fold(spread, f64::max) * 1.1;
        let widest = PlaneWindow { low: low - Vector2::repeat(room), high: high + Vector2::repeat(room) };
        self.reached_part(phi, &widest).unwrap_or(widest)
    }

    /// The cells of a window with a position in reach, with one more all around; `None` where there is none.
    fn reached_part(&self, phi: f64, window: &PlaneWindow) -> Option<PlaneWindow> {
        let step = (window.high - window.low) / COARSE as f64;
        let at = |i: usize, j: usize| window.low + Vector2::new(step.x * i as f64, step.y * j as f64);
        let grid = (0..=COARSE).flat_map(|i| (0..=COARSE).map(move |j| (i, j)));
        let mut reached = grid.map(|(i, j)| at(i, j)).filter(|p| self.is_reached(&Pose::new(p.x, p.y, phi)));
        let first = reached.next()?;
        let (low, high) = reached.fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)));
        let room = step * 2.0 + (high - low) * 0.04;
        Some(PlaneWindow { low: (low - room).sup(&window.low), high: (high + room).inf(&window.high) })
    }

    /// Whether some working mode reaches a pose within the limits.
    fn is_reached(&self, pose: &Pose) -> bool {
        self.inverse(pose).is_ok_and(|answer| answer.modes.iter().any(|mode| mode.violations.is_empty()))
    }

    /// The parts of a leg's curves of type 1 that the other legs reach, within the limits, as straight pieces for a drawing.
    ///
    /// **Accuracy**: pieces end where the reach does to a share of 1/720 of the circle, or of the line's part in the window.
    pub fn trace_leg_locus(&self, locus: &LegLocus, phi: f64, window: &PlaneWindow) -> Vec<[Vector2<f64>; 2]> {
        let mut out = Vec::new();
        let size = (window.high - window.low).norm();
        for curve in &locus.curves {
            // The curve, and the direction across it, at the share t of its way.
            let at = |t: f64| match *curve {
                PlaneCurve::Circle { center, radius } => {
                    let out = Vector2::new((TAU * t).cos(), (TAU * t).sin());
                    [center + out * radius, out]
                }
                PlaneCurve::Line { point, direction } => {
                    let foot = point + direction * direction.dot(&((window.low + window.high) / 2.0 - point));
                    [foot + direction * (2.0 * t - 1.0) * size, Vector2::new(-direction.y, direction.x)]
                }
            };
            // The curve itself is the edge of the leg's reach: rounding decides there, so a little to either side is looked at.
            let reached = |t: f64| {
                let [point, across] = at(t);
                [BESIDE, -BESIDE].into_iter().any(|off| {
                    let p = point + across * (off * size);
                    self.is_reached(&Pose::new(p.x, p.y, phi))
                })
            };
            for k in 0..ARCS {
                let [start, end] = [k, k + 1].map(|k| k as f64 / ARCS as f64);
                if reached((start + end) / 2.0) {
                    out.push([at(start)[0], at(end)[0]]);
                }
            }
        }
        out
    }

    /// The names of all working modes that there can be, `+++` first.
    pub fn mode_names(&self) -> Vec<String> {
        self.legs.iter().fold(vec![String::new()], |begun, leg| {
            let ways = &['+', '-'][..branch_count(leg)];
            begun.iter().flat_map(|name| ways.iter().map(move |sign| format!("{name}{sign}"))).collect()
        })
    }

    /// The pieces of a mode's curve of type 2 for a fixed orientation, as straight pieces for a drawing, clipped to where the legs reach within their
    /// limits.
    ///
    /// # Errors
    /// An orientation that is not finite, a mode that is none.
    pub fn trace_singularities(
        &self,
        phi: f64,
        signs: &str,
        window: &PlaneWindow,
    ) -> Result<Vec<[Vector2<f64>; 2]>, KinematicsError> {
        if !phi.is_finite() {
            return Err(KinematicsError::NotFinite { what: "phi", value: phi });
        }
        self.check_signs(signs)?;
        let value = |p: Vector2<f64>| {
            let pose = Pose::new(p.x, p.y, phi);
            let mode = self.working_mode(&pose, signs).ok().filter(|mode| mode.violations.is_empty())?;
            let rows = self.velocity_at(&pose, &mode.joints).pose_matrix;
            let (determinant, size) = (rows.determinant(), rows.row_iter().map(|row| row.norm()).product::<f64>());
            // Where every position is singular, the signs of what rounding leaves would draw a curve through every square.
            Some(if determinant.abs() <= ROUNDING * size { 0.0 } else { determinant })
        };
        let step = (window.high - window.low) / COARSE as f64;
        let corner = |i: usize, j: usize| window.low + Vector2::new(step.x * i as f64, step.y * j as f64);
        let mut below: Vec<Option<f64>> = (0..=COARSE).map(|i| value(corner(i, 0))).collect();
        let mut out = Vec::new();
        for j in 0..COARSE {
            let above: Vec<Option<f64>> = (0..=COARSE).map(|i| value(corner(i, j + 1))).collect();
            for i in 0..COARSE {
                let values = [below[i], below[i + 1], above[i + 1], above[i]];
                trace_square(&mut out, &value, corner(i, j), step, values, HALVINGS);
            }
            below = above;
        }
        Ok(out)
    }

    /// A quantity over the plane for a fixed orientation and working mode; `length` as in [`Manipulator::singularity`].
    ///
    /// # Errors
    /// An orientation that is not finite, a mode that is none, a length that is not positive.
    ///
    /// ```
    /// use assur::{Manipulator, MapQuantity};
    /// let (robot, _) = Manipulator::of_family("3-RRR")?;
    /// let window = robot.plane_window(0.3);
    /// let map = robot.plane_map(MapQuantity::Dexterity, 0.3, "+++", None, &window, [20, 20])?;
    /// assert!(map.values.iter().flatten().all(|value| (0.0..=1.0).contains(value)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn plane_map(
        &self,
        quantity: MapQuantity,
        phi: f64,
        signs: &str,
        length: Option<f64>,
        window: &PlaneWindow,
        size: [usize; 2],
    ) -> Result<PlaneMap, KinematicsError> {
        if !phi.is_finite() {
            return Err(KinematicsError::NotFinite { what: "phi", value: phi });
        }
        self.check_signs(signs)?;
        let length = length.unwrap_or_else(|| self.characteristic_length());
        positive_length(length)?;
        let mut map = PlaneMap {
            quantity,
            phi,
            signs: signs.to_owned(),
            characteristic_length: length,
            window: *window,
            size,
            values: Vec::new(),
        };
        let reference = Pose::new(0.0, 0.0, phi).place(self.reference);
        for row in 0..size[1] {
            for column in 0..size[0] {
                let p = map.at(column, row);
                let pose = Pose::new(p.x, p.y, phi);
                let mode = self.working_mode(&pose, signs).ok().filter(|mode| mode.violations.is_empty());
                let velocity = mode.map(|mode| self.velocity_at(&pose, &mode.joints));
                let value = velocity.map(|velocity| match quantity {
                    MapQuantity::Dexterity => velocity.dexterity(length),
                    MapQuantity::Accuracy => velocity.position_error(reference),
                    MapQuantity::Stiffness => velocity.stiffness(length),
                });
                map.values.push(value.filter(|value| value.is_finite()));
            }
        }
        Ok(map)
    }
}

/// The pieces of the curve in a square with these values at its corners, counter-clockwise from the lower left.
fn trace_square(
    out: &mut Vec<[Vector2<f64>; 2]>,
    value: &dyn Fn(Vector2<f64>) -> Option<f64>,
    low: Vector2<f64>,
    step: Vector2<f64>,
    values: [Option<f64>; 4],
    halvings: usize,
) {
    let known: Vec<f64> = values.iter().flatten().copied().collect();
    let partly = !known.is_empty() && known.len() < 4;
    let changes = known.iter().any(|v| *v > 0.0) && known.iter().any(|v| *v <= 0.0);
    if !partly && !changes {
        return;
    }
    let corners = [low, low + Vector2::new(step.x, 0.0), low + step, low + Vector2::new(0.0, step.y)];
    if halvings > 0 {
        let half = step / 2.0;
        let middles: [Vector2<f64>; 4] = std::array::from_fn(|k| (corners[k] + corners[(k + 1) % 4]) / 2.0);
        let centre = low + half;
        let [m, c] = [middles.map(value), [value(centre); 4]];
        trace_square(out, value, low, half, [values[0], m[0], c[0], m[3]], halvings - 1);
        trace_square(out, value, middles[0], half, [m[0], values[1], m[1], c[0]], halvings - 1);
        trace_square(out, value, centre, half, [c[0], m[1], values[2], m[2]], halvings - 1);
        trace_square(out, value, middles[3], half, [m[3], c[0], m[2], values[3]], halvings - 1);
        return;
    }
    let mut crossings = Vec::new();
    for k in 0..4 {
        let next = (k + 1) % 4;
        if let (Some(a), Some(b)) = (values[k], values[next])
            && (a > 0.0) != (b > 0.0)
        {
            crossings.push(crossing(value, corners[k], corners[next], a > 0.0));
        }
    }
    for pair in crossings.chunks_exact(2) {
        out.push([pair[0], pair[1]]);
    }
}

/// Where the sign changes between two points.
fn crossing(
    value: &dyn Fn(Vector2<f64>) -> Option<f64>,
    mut from: Vector2<f64>,
    mut to: Vector2<f64>,
    positive: bool,
) -> Vector2<f64> {
    for _ in 0..BISECTIONS {
        let middle = (from + to) / 2.0;
        match value(middle) {
            Some(v) if (v > 0.0) == positive => from = middle,
            Some(_) => to = middle,
            None => break,
        }
    }
    (from + to) / 2.0
}
