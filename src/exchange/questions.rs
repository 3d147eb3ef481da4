//! Questions that take more than one call of the library, put together once so that every face gives the same answer.

use super::locus_report::{SingularitiesReport, TracedModes};
use super::motion_report::{Motion, VelocityReport};
use super::spatial_report::{hana_capability_json, tilt_map_json};
use crate::linkage::Pose;
use crate::manipulator::{
    KinematicsError, LegLocus, LocusError, Manipulator, MapQuantity, ModeChoice, PlaneMap, PlaneWindow, Singularity,
    SingularityLocus, Velocity,
};
use crate::spatial::{
    ArcRegion, Capability, CapabilityMap, CapabilitySupremum, Hana, HanaCapabilityError, HanaMode, SpatialError,
    Tripod, TripodError,
};
use nalgebra::{Vector2, Vector3};
use thiserror::Error;

/// A pose in motion: its matrices, its singularity, and what was asked of its motion.
#[derive(Clone, Debug)]
pub struct MotionAnswer {
    /// The working mode, as it was named or chosen.
    pub signs: String,
    /// Why this mode.
    pub choice: ModeChoice,
    /// The matrices.
    pub velocity: Velocity,
    /// What kind of singularity the pose is, if any.
    pub singularity: Singularity,
    /// What was asked.
    pub motion: Motion,
}

impl MotionAnswer {
    /// Answers for a pose in a working mode: the one named, or the only one that can be meant. `length` weighs turning against moving.
    ///
    /// # Errors
    /// As [`Manipulator::chosen_mode`] and [`Manipulator::singularity`]; a motion that is not finite.
    pub fn of(
        robot: &Manipulator,
        pose: &Pose,
        mode: Option<&str>,
        motion: Motion,
        length: Option<f64>,
    ) -> Result<Self, KinematicsError> {
        let asked = [("rates", motion.rates), ("accelerations", motion.accelerations), ("wrench", motion.wrench)];
        for (what, values) in asked {
            if let Some(&value) = values.iter().flatten().find(|value| !value.is_finite()) {
                return Err(KinematicsError::NotFinite { what, value });
            }
        }
        let (chosen, choice) = robot.chosen_mode(pose, mode)?;
        // A merged leg is named + and may have been asked for as -.
        let signs = mode.map_or(chosen.signs, str::to_owned);
        let velocity = robot.velocity(pose, &signs)?;
        let singularity = robot.singularity(pose, &signs, length)?;
        Ok(Self { signs, choice, velocity, singularity, motion })
    }

    /// The answer as a report.
    pub fn report(&self) -> VelocityReport {
        VelocityReport::new(&self.velocity, (&self.signs, self.choice), &self.singularity, &self.motion)
    }
}

/// Cells of a map of the plane along each side.
const MAP_CELLS: usize = 80;

/// What is asked about singular positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AskedLoci {
    /// The orientation, in radians.
    pub phi: f64,
    /// One working mode; all where there is none. A map is of this mode, or of the first.
    pub mode: Option<String>,
    /// A quantity over the plane.
    pub map: Option<MapQuantity>,
    /// Whether the exact curve of all modes is wanted; it takes seconds where its degree is high.
    pub polynomial: bool,
}

/// Where a manipulator is singular for an orientation.
#[derive(Clone, Debug)]
pub struct Loci {
    /// The orientation, in radians.
    pub phi: f64,
    /// What of the plane is looked at.
    pub window: PlaneWindow,
    /// Curves of type 1.
    pub legs: Vec<LegLocus>,
    /// Those curves in pieces, leg by leg, clipped to the reach of the others.
    pub edges: Vec<Vec<[Vector2<f64>; 2]>>,
    /// The curve of type 2 of each working mode, in pieces.
    pub traced: TracedModes,
    /// The exact curve of type 2 of all modes, or why there is none.
    pub locus: Result<SingularityLocus, String>,
    /// The map.
    pub map: Option<PlaneMap>,
}

/// Why singular positions cannot be told.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LociError {
    /// An orientation that is not finite.
    #[error(transparent)]
    Locus(#[from] LocusError),
    /// A mode that is none.
    #[error(transparent)]
    Mode(#[from] KinematicsError),
}

impl Loci {
    /// The singular positions of a manipulator.
    ///
    /// # Errors
    /// An orientation that is not finite, a mode's name that is none.
    pub fn of(robot: &Manipulator, asked: &AskedLoci) -> Result<Self, LociError> {
        let phi = asked.phi;
        let legs = robot.leg_loci(phi)?;
        let window = robot.plane_window(phi);
        let names = asked.mode.clone().map_or_else(|| robot.mode_names(), |name| vec![name]);
        let traced = names
            .iter()
            .map(|signs| Ok((signs.clone(), robot.trace_singularities(phi, signs, &window)?)))
            .collect::<Result<_, KinematicsError>>()?;
        // Legs with several actuators have traced curves but no exact one.
        let locus = match asked.polynomial {
            true => robot.singularity_locus(phi).map_err(|error| error.to_string()),
            false => Err("not asked for".to_owned()),
        };
        let map = asked.map.map(|quantity| robot.plane_map(quantity, phi, &names[0], None, &window, [MAP_CELLS; 2]));
        let map = map.transpose()?;
        let edges = legs.iter().map(|leg| robot.trace_leg_locus(leg, phi, &window)).collect();
        Ok(Self { phi, window, legs, edges, traced, locus, map })
    }

    /// The answer as a report.
    pub fn report(&self) -> SingularitiesReport {
        let locus = self.locus.as_ref().map_err(String::clone);
        SingularitiesReport::new(self.phi, locus, &self.traced, &self.legs, self.map.as_ref())
    }
}

/// How far HANA's platform tilts: at a place, at most, over the workspace, against the strokes.
#[derive(Clone, Debug)]
pub struct HanaTilts {
    /// The place asked for, and what is known of it; nothing outside the workspace.
    pub here: Option<([f64; 2], Option<Capability>)>,
    /// The supremum over the workspace; none where it is empty.
    pub supremum: Option<CapabilitySupremum>,
    /// The supremum for each half length of all strokes.
    pub against_strokes: Vec<(f64, Option<f64>)>,
    /// The workspace of `phi = 0`.
    pub region: ArcRegion,
    /// The map, where one was asked for and there is a workspace.
    pub map: Option<CapabilityMap>,
}

/// What is asked of HANA's rotational capability.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AskedTilts {
    /// A place `(y, z)` of the platform's centre.
    pub at: Option<[f64; 2]>,
    /// Half lengths of all strokes.
    pub strokes: Vec<f64>,
    /// Cells of a map along each side.
    pub cells: Option<usize>,
}

impl HanaTilts {
    /// The tilts in a working mode; `progress` hears of each row of the map.
    ///
    /// # Errors
    /// As [`Hana::capability`] and [`Hana::with_strokes`].
    pub fn of(
        robot: &Hana,
        mode: HanaMode,
        asked: &AskedTilts,
        progress: impl FnMut(usize),
    ) -> Result<Self, HanaCapabilityError> {
        let here = asked.at.map(|at| Ok::<_, HanaCapabilityError>((at, robot.capability(at, mode)?))).transpose()?;
        let supremum = robot.capability_supremum(mode)?;
        let mut against_strokes = Vec::new();
        for &half in &asked.strokes {
            let found = robot.with_strokes(half)?.capability_supremum(mode)?;
            against_strokes.push((half, found.map(|found| found.zeta)));
        }
        let region = robot.workspace(0.0, mode)?;
        let map = match (region.bbox, asked.cells) {
            (Some(window), Some(cells)) => Some(robot.capability_map(mode, window, [cells; 2], progress)?),
            _ => None,
        };
        Ok(Self { here, supremum, against_strokes, region, map })
    }

    /// The answer as a JSON document.
    pub fn to_json(&self) -> String {
        let here = self.here.as_ref().map(|(at, found)| (*at, found.as_ref()));
        hana_capability_json(here, self.supremum.as_ref(), self.map.as_ref(), &self.against_strokes)
    }
}

/// The largest tilts of a three-legged robot's tool over sections of a box.
#[derive(Clone, Debug, PartialEq)]
pub struct TiltSections {
    /// Lowest corner.
    pub low: [f64; 3],
    /// Highest corner.
    pub high: [f64; 3],
    /// Cells of a section along each side.
    pub cells: usize,
    /// Height and tilts of each section, `[row][column]` from the lowest corner; nothing outside the limits.
    pub maps: Vec<(f64, Vec<Option<f64>>)>,
}

impl TiltSections {
    /// Sections evenly over the height of the box; `progress` is called after each row, `sections` times `cells` of them, from any thread.
    ///
    /// # Errors
    /// Corners that are not finite or the wrong way round.
    pub fn of(
        robot: &Tripod,
        low: [f64; 3],
        high: [f64; 3],
        [sections, cells]: [usize; 2],
        progress: impl Fn() + Sync,
    ) -> Result<Self, TripodError> {
        for (what, corner) in [("low", low), ("high", high)] {
            if let Some(&value) = corner.iter().find(|value| !value.is_finite()) {
                return Err(SpatialError::NotFinite { what: what.to_owned(), value }.into());
            }
        }
        for (low, high) in low.into_iter().zip(high) {
            if low > high {
                return Err(SpatialError::Reversed { what: "map from low to high".to_owned(), low, high }.into());
            }
        }
        let side = |k: usize| (high[k] - low[k]) / cells as f64;
        let along = [Vector3::x() * side(0), Vector3::y() * side(1)];
        let section = |section: usize| {
            let z = low[2] + (high[2] - low[2]) * section as f64 / sections.saturating_sub(1).max(1) as f64;
            let corner = Vector3::new(low[0] + 0.5 * side(0), low[1] + 0.5 * side(1), z);
            Ok((z, robot.tilt_map(&corner, along, [cells; 2], &progress)?))
        };
        let maps = (0..sections).map(section).collect::<Result<_, TripodError>>()?;
        Ok(Self { low, high, cells, maps })
    }

    /// The answer as a JSON document.
    pub fn to_json(&self) -> String {
        tilt_map_json(self.low, self.high, self.cells, &self.maps)
    }
}
