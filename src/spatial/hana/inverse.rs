//! Which slider heights take the platform to a pose?

use std::fmt;
use std::str::FromStr;

use super::super::error::SpatialError;
use super::model::{Hana, HanaPose};

/// A working mode of HANA: for each leg, whether its slider is above (`+`) or below (`-`) the platform's joint.
///
/// ```
/// let mode: assur::HanaMode = "++-".parse()?;
/// assert_eq!((mode.above, mode.to_string().as_str()), ([true, true, false], "++-"));
/// # Ok::<(), assur::SpatialError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HanaMode {
    /// Leg 1 first.
    pub above: [bool; 3],
}

impl HanaMode {
    /// `+++`: every slider above its joint, as the robot is built.
    pub const ABOVE: Self = Self { above: [true; 3] };

    /// All eight, `+++` first.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..8).map(|bits| Self { above: [bits & 4 == 0, bits & 2 == 0, bits & 1 == 0] })
    }

    /// `1` or `-1` for a leg, from 0.
    pub(super) fn sign(self, leg: usize) -> f64 {
        if self.above[leg] { 1.0 } else { -1.0 }
    }
}

impl fmt::Display for HanaMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.above.iter().try_for_each(|&above| f.write_str(if above { "+" } else { "-" }))
    }
}

impl FromStr for HanaMode {
    type Err = SpatialError;

    fn from_str(text: &str) -> Result<Self, SpatialError> {
        let signs: Vec<bool> = text
            .chars()
            .map(|sign| match sign {
                '+' => Some(true),
                '-' => Some(false),
                _ => None,
            })
            .collect::<Option<_>>()
            .unwrap_or_default();
        let above = signs.try_into().map_err(|_| SpatialError::Signs { signs: text.to_owned() })?;
        Ok(Self { above })
    }
}

/// A slider outside its stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HanaViolation {
    /// Leg, from 1.
    pub leg: usize,
    /// Height of the slider.
    pub value: f64,
    /// Its range.
    pub limit: [f64; 2],
}

/// One way to reach a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct HanaWay {
    /// Which one.
    pub mode: HanaMode,
    /// The heights of the sliders.
    pub inputs: [f64; 3],
    /// Sliders outside their strokes.
    pub violations: Vec<HanaViolation>,
}

/// A leg too short for a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HanaUnreachable {
    /// Leg, from 1.
    pub leg: usize,
    /// How much longer its link would have to be.
    pub miss: f64,
}

/// Every way to reach a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct HanaWays {
    /// The pose.
    pub pose: HanaPose,
    /// The working modes that reach it, `+++` first; a leg whose two ways have merged is written `+`.
    pub modes: Vec<HanaWay>,
    /// Legs that do not reach; then there are no modes.
    pub unreachable: Vec<HanaUnreachable>,
    /// Legs, from 1, whose two ways have merged: their links lie level.
    pub merged: Vec<usize>,
}

impl Hana {
    /// Every working mode that reaches a pose.
    ///
    /// **Shape**: up to eight, `+++` first. **Units**: lengths as given, radians. **Accuracy**: closed forms, a few roundings.
    /// **Source**: Liu et al., eqs. (10)-(12).
    ///
    /// # Errors
    /// A pose that is not finite, or whose squares leave `f64`.
    ///
    /// ```
    /// use assur::{Hana, HanaPose};
    /// let answer = Hana::example().inverse(&HanaPose::new(-2.0, -12.0, 0.4))?;
    /// assert_eq!(answer.modes.len(), 8);
    /// assert!((answer.modes[0].inputs[0] + 1.5200272056586552).abs() < 1e-13);
    /// let far = Hana::example().inverse(&HanaPose::new(20.0, 0.0, 0.0))?;
    /// assert_eq!((far.modes.len(), far.unreachable[1].leg), (0, 2));
    /// # Ok::<(), assur::SpatialError>(())
    /// ```
    pub fn inverse(&self, pose: &HanaPose) -> Result<HanaWays, SpatialError> {
        self.check_pose(pose)?;
        let (joints, squares) = (self.joint_heights(pose), self.height_squares(pose));
        let across = (self.base_radius - self.platform_radius * pose.phi.cos()).hypot(pose.y);
        let third = (pose.y + self.base_radius - self.platform_radius).abs();
        let misses = [across - self.link, across - self.link, third - self.third_link];
        let legs = || (1..).zip(squares);
        let unreachable: Vec<_> = legs()
            .filter(|(_, square)| *square < 0.0)
            .map(|(leg, _)| HanaUnreachable { leg, miss: misses[leg - 1] })
            .collect();
        let merged: Vec<usize> = legs().filter(|(_, square)| *square == 0.0).map(|(leg, _)| leg).collect();
        let reached = |mode: &HanaMode| unreachable.is_empty() && merged.iter().all(|&leg| mode.above[leg - 1]);
        let way = |mode: HanaMode| {
            let inputs = std::array::from_fn(|leg| joints[leg] + mode.sign(leg) * squares[leg].sqrt());
            HanaWay { mode, inputs, violations: self.violations(&inputs) }
        };
        let modes = HanaMode::all().filter(reached).map(way).collect();
        Ok(HanaWays { pose: *pose, modes, unreachable, merged })
    }

    /// The slider heights of one working mode in a pose.
    ///
    /// # Errors
    /// As [`Hana::inverse`]; a leg that does not reach.
    pub fn inputs_at(&self, pose: &HanaPose, mode: HanaMode) -> Result<[f64; 3], SpatialError> {
        let answer = self.inverse(pose)?;
        if let Some(&HanaUnreachable { leg, miss }) = answer.unreachable.first() {
            return Err(SpatialError::Unreachable { leg, miss });
        }
        // Where two ways have merged, either sign names the one that is left.
        let wanted =
            HanaMode { above: std::array::from_fn(|leg| mode.above[leg] || answer.merged.contains(&(leg + 1))) };
        let way = answer.modes.iter().find(|way| way.mode == wanted);
        Ok(way.expect("every mode reaches where every leg does").inputs)
    }

    /// Sliders outside their strokes.
    pub fn violations(&self, inputs: &[f64; 3]) -> Vec<HanaViolation> {
        let sliders = (1..).zip(inputs.iter().zip(self.strokes));
        let outside = sliders.filter(|(_, (value, [low, high]))| !(low..=high).contains(value));
        outside.map(|(leg, (&value, limit))| HanaViolation { leg, value, limit }).collect()
    }

    /// Heights of the platform's three joints.
    pub(super) fn joint_heights(&self, pose: &HanaPose) -> [f64; 3] {
        let tilt = self.platform_radius * pose.phi.sin();
        [pose.z - tilt, pose.z + tilt, pose.z]
    }

    /// What remains, squared, of each link for the height.
    pub(super) fn height_squares(&self, pose: &HanaPose) -> [f64; 3] {
        let square = self.height_square(pose.y, pose.phi.cos());
        [square, square, self.third_height_square(pose.y)]
    }
}
