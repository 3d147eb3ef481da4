//! Forward kinematics: from actuator values to every assembly mode.

use thiserror::Error;

use super::describe::Manipulator;
use crate::linkage::{Assemblies, AssemblyMode, Triad};

/// A joint value outside its range. Legs and joints are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// Leg, from 1.
    pub leg: usize,
    /// Joint of the leg, from 1.
    pub joint: usize,
    /// The joint's value, length or radians.
    pub value: f64,
    /// The range it leaves.
    pub limit: [f64; 2],
}

/// An assembly mode of a manipulator: a pose with all its joints.
#[derive(Clone, Debug, PartialEq)]
pub struct ManipulatorMode {
    /// The pose, its multiplicity, residual and det A.
    pub mode: AssemblyMode,
    /// Joint values of each leg, base first; lengths and radians in (-pi, pi].
    pub joints: Vec<[f64; 3]>,
    /// Working-mode signs, leg 1 first: `+-+`.
    pub signs: String,
    /// Passive joints outside their ranges.
    pub violations: Vec<Violation>,
}

/// Every assembly mode of a manipulator for given inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyModes {
    /// The inputs, one per actuated joint, leg by leg, base first.
    pub inputs: Vec<f64>,
    /// The triad that locking the actuators left; `None` where they left something smaller (see [`Manipulator::forward`]).
    pub triad: Option<Triad>,
    /// The modes, in the order of `group.modes`.
    pub modes: Vec<ManipulatorMode>,
    /// What is known of the group: status, account, complex solutions, rejections, self-motions.
    pub group: Assemblies,
}

/// Why inputs cannot be asked about. Inputs, legs and joints are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ForwardError {
    /// Not as many inputs as actuated joints.
    #[error("inputs: {found} given, {expected} actuated joints")]
    WrongCount {
        /// Number of actuated joints.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
}

impl Manipulator {
    /// Every assembly mode for these actuator values.
    ///
    /// # Errors
    /// See [`ForwardError`].
    pub fn forward(&self, inputs: &[f64]) -> Result<AssemblyModes, ForwardError> {
        let _ = inputs;
        unimplemented!("being written")
    }
}
