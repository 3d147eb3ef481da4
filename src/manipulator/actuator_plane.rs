//! How many assembly modes there are over the plane of two actuators, the others held.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector2;

use super::describe::{JointKind, Manipulator};
use super::frame::principal_angle;
use super::lock::{LockError, within};
use super::trace::PlaneWindow;

/// The numbers of assembly modes over a rectangle of two actuators' values.
#[derive(Clone, Debug, PartialEq)]
pub struct ActuatorPlane {
    /// Which inputs vary, from 0: along, and up.
    pub pair: [usize; 2],
    /// Their ranges.
    pub window: PlaneWindow,
    /// Columns and rows.
    pub size: [usize; 2],
    /// Counts at the middles of the cells, row by row from below, left to right.
    pub counts: Vec<u8>,
}

/// Values of each actuator that are tried for a start.
const SAMPLES: usize = 16;

impl Manipulator {
    /// The range in which an actuator is worth moving: its limits; else for a revolute joint a turn, for a slider as far as the mechanism is wide, from zero
    /// where a negative value does the same.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, inputs) = Manipulator::of_family("3-RRR")?;
    /// assert_eq!(robot.actuator_range(0), Some([-std::f64::consts::PI, std::f64::consts::PI]));
    /// assert_eq!(robot.actuator_range(3), None);
    /// # Ok::<(), assur::FamilyError>(())
    /// ```
    pub fn actuator_range(&self, number: usize) -> Option<[f64; 2]> {
        let (leg, joint) = self.actuated_joints().nth(number)?;
        let leg = &self.legs[leg];
        let kind = leg.joints[joint];
        Some(match (kind, leg.limits[joint]) {
            (JointKind::Prismatic, Some(limit)) => limit,
            // A revolute range runs counter-clockwise, modulo a turn.
            (JointKind::Revolute, Some([low, high])) if high - low >= TAU => [low, low + TAU],
            (JointKind::Revolute, Some([low, high])) => [low, low + (high - low).rem_euclid(TAU)],
            (JointKind::Revolute, None) => [-PI, PI],
            (JointKind::Prismatic, None) => {
                let width = self.width();
                let in_line = leg.links.iter().all(|link| link.at == Vector2::zeros());
                let symmetric = joint == 1 && in_line && leg.joints == [JointKind::Revolute, kind, JointKind::Revolute];
                if symmetric { [0.0, width] } else { [-width, width] }
            }
        })
    }

    /// The same inputs, each outside its actuator's limits moved to the nearer end of them; what [`Manipulator::lock`] refuses for another reason stays as it is.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (mut robot, _) = Manipulator::of_family("3-RPR")?;
    /// robot.legs[0].limits[1] = Some([8.0, 12.0]);
    /// assert_eq!(robot.inputs_within_limits(&[6.0, 7.0, 5.0]), [8.0, 7.0, 5.0]);
    /// # Ok::<(), assur::FamilyError>(())
    /// ```
    pub fn inputs_within_limits(&self, inputs: &[f64]) -> Vec<f64> {
        let moved = |((leg, joint), &value): ((usize, usize), &f64)| {
            let kind = self.legs[leg].joints[joint];
            let Some([low, high]) =
                self.legs[leg].limits[joint].filter(|&limit| value.is_finite() && !within(kind, value, limit))
            else {
                return value;
            };
            let distance = |end: f64| match kind {
                JointKind::Prismatic => (value - end).abs(),
                JointKind::Revolute => principal_angle(value - end).abs(),
            };
            if distance(low) <= distance(high) { low } else { high }
        };
        if inputs.len() != self.actuated_joints().count() {
            return inputs.to_vec();
        }
        self.actuated_joints().zip(inputs).map(moved).collect()
    }

    /// A length that no useful distance exceeds: the spread of the base, and what legs and platform span.
    fn width(&self) -> f64 {
        let spread = |points: &[Vector2<f64>]| {
            let pairs = points.iter().flat_map(|p| points.iter().map(move |q| (p - q).norm()));
            pairs.fold(0.0, f64::max)
        };
        let base: Vec<Vector2<f64>> = self.legs.iter().map(|leg| leg.base.at).collect();
        let platform: Vec<Vector2<f64>> = self.legs.iter().map(|leg| leg.platform.at).collect();
        let links = self.legs.iter().map(|leg| leg.links.iter().map(|link| link.at.norm()).sum()).fold(0.0, f64::max);
        let width = spread(&base) + spread(&platform) + links;
        if width > 0.0 { width } else { 1.0 }
    }

    /// Actuator values to start from: of some thousand rows spread over all ranges, the one with the most assembly modes, and of these the nearest to
    /// the middle of the ranges. `None` where no row has any.
    ///
    /// **Cost**: some milliseconds.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, _) = Manipulator::of_family("3-PRR")?;
    /// let inputs = robot.sample_inputs().expect("this robot can be assembled");
    /// assert!(!robot.forward(&inputs).expect("within the ranges").modes.is_empty());
    /// # Ok::<(), assur::FamilyError>(())
    /// ```
    pub fn sample_inputs(&self) -> Option<Vec<f64>> {
        let ranges: Vec<[f64; 2]> = (0..).map_while(|number| self.actuator_range(number)).collect();
        let total = SAMPLES.pow(ranges.len() as u32);
        let part = |row: usize, axis: usize| {
            let step = row / SAMPLES.pow(axis as u32) % SAMPLES;
            (step as f64 + 0.5) / SAMPLES as f64
        };
        let parts = |row: usize| ranges.iter().enumerate().map(move |(axis, _)| part(row, axis));
        let values = |row: usize| parts(row).zip(&ranges).map(|(part, [low, high])| low + part * (high - low));
        let rows: Vec<f64> = (0..total).flat_map(values).collect();
        let off_middle = |row: usize| parts(row).map(|part| (part - 0.5).powi(2)).sum::<f64>();
        let counts = self.forward_batch(&rows);
        let best = |p: &usize, q: &usize| {
            let [a, b] = [p, q].map(|&row| counts.counts()[row]);
            a.cmp(&b).then_with(|| off_middle(*q).total_cmp(&off_middle(*p)))
        };
        let best = (0..total).max_by(best).filter(|&row| counts.counts()[row] > 0)?;
        Some(values(best).collect())
    }

    /// How many assembly modes there are over the plane of two actuators.
    ///
    /// **Shape**: see [`ActuatorPlane`]; the ranges of the two are [`Manipulator::actuator_range`]. **Proof**: each count is proved, as [`Manipulator::forward_batch`] does; between the cells nothing is
    /// known. A cell whose inputs cannot be asked has 0. **Cost**: a microsecond a cell and thread.
    ///
    /// # Errors
    /// Inputs that [`Manipulator::lock`] refuses; numbers of actuators that do not exist, or twice the same.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, inputs) = Manipulator::of_family("3-RPR")?;
    /// let plane = robot.actuator_plane(&inputs, [0, 1], [32, 32])?;
    /// assert_eq!(plane.counts.len(), 1024);
    /// assert!(plane.counts.iter().all(|count| count % 2 == 0)); // modes come and go in pairs
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn actuator_plane(
        &self,
        inputs: &[f64],
        pair: [usize; 2],
        size: [usize; 2],
    ) -> Result<ActuatorPlane, LockError> {
        self.lock(inputs)?;
        let ranges = (pair[0] != pair[1]).then(|| Some([self.actuator_range(pair[0])?, self.actuator_range(pair[1])?]));
        let Some([along, up]) = ranges.flatten() else {
            let (expected, found) = (inputs.len(), pair[0].max(pair[1]) + 1);
            return Err(LockError::WrongCount { expected, found });
        };
        let window = PlaneWindow { low: Vector2::new(along[0], up[0]), high: Vector2::new(along[1], up[1]) };
        let share = |k: usize, of: usize| (k as f64 + 0.5) / of as f64;
        let mut rows = Vec::with_capacity(inputs.len() * size[0] * size[1]);
        for row in 0..size[1] {
            for column in 0..size[0] {
                let start = rows.len();
                rows.extend_from_slice(inputs);
                rows[start + pair[0]] = along[0] + (along[1] - along[0]) * share(column, size[0]);
                rows[start + pair[1]] = up[0] + (up[1] - up[0]) * share(row, size[1]);
            }
        }
        Ok(ActuatorPlane { pair, window, size, counts: self.forward_batch(&rows).counts().to_vec() })
    }
}
