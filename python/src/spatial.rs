//! The spatial robots. Angles in radians.

use std::path::PathBuf;
use std::sync::Arc;

use assur::exchange::{
    AskedTilts, ErrorPlace, HanaFile, HanaTilts, MultipteronFile, TiltSections, TripodFile, hana_forward_json,
    hana_inverse_json, hana_velocity_json, hana_workspace_json, multipteron_forward_json, multipteron_inverse_json,
    tilt_json, tripod_determinant_json, tripod_forward_json, tripod_inverse_json, tripod_pointing_json,
    tripod_torsions_json, tripod_velocity_json,
};
use assur::nalgebra::{Matrix3, Vector3, Vector6};
use assur::plot::PosedRobot;
use assur::{ArcRegion, HanaMode, HanaPose, SpatialError, Tripod, TripodDesign, TripodError, TripodPose, WorkspaceArc};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::refused::Refused;
use crate::spatial_batch::{self, SpatialBatch};

/// Numbers that have to be finite.
fn finite<'a>(what: &str, values: impl IntoIterator<Item = &'a f64>) -> Result<(), Refused> {
    match values.into_iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(Refused::input(SpatialError::NotFinite { what: what.to_owned(), value })),
        None => Ok(()),
    }
}

fn mode(signs: &str) -> Result<HanaMode, Refused> {
    signs.parse().map_err(|error: SpatialError| Refused::input(error))
}

fn asked<E: std::fmt::Display>(error: E) -> Refused
where
    for<'a> ErrorPlace: From<&'a E>,
{
    Refused::input(error)
}

/// HANA: two translations and a rotation.
#[pyclass(frozen, module = "assur._assur")]
pub struct HanaModel {
    file: Arc<HanaFile>,
}

impl HanaModel {
    fn region(
        &self,
        phi: Option<f64>,
        range: Option<[f64; 2]>,
        signs: &str,
    ) -> Result<(&'static str, ArcRegion), Refused> {
        let (robot, mode) = (&self.file.robot, mode(signs)?);
        Ok(match (phi, range) {
            (Some(phi), _) => ("constant", robot.workspace(phi, mode).map_err(asked)?),
            (None, Some(range)) => ("reachable", robot.reachable_between(mode, range).map_err(asked)?),
            (None, None) => ("reachable", robot.reachable_workspace(mode).map_err(asked)?),
        })
    }
}

#[pymethods]
impl HanaModel {
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        let file = HanaFile::read(&path).map_err(Refused::model)?;
        Ok(Self { file: Arc::new(file) })
    }

    #[staticmethod]
    fn parse(text: &str, name: &str) -> PyResult<Self> {
        let file = HanaFile::parse(text, name).map_err(Refused::model)?;
        Ok(Self { file: Arc::new(file) })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.file.robot.name
    }

    fn inverse(&self, py: Python<'_>, pose: [f64; 3]) -> PyResult<Answer> {
        Ok(py.detach(|| {
            finite("pose", &pose)?;
            let robot = &self.file.robot;
            let pose = HanaPose::new(pose[0], pose[1], pose[2]);
            let answer = robot.inverse(&pose).map_err(asked)?;
            let mixed = robot.mixed_singularities(pose.y, pose.z).map_err(asked)?;
            let (json, file) = (hana_inverse_json(&answer, &mixed, robot.mixed_reach()), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || {
                let way = |way: &assur::HanaWay| PosedRobot { caption: way.mode.to_string(), pose, inputs: way.inputs };
                assur::plot::draw_hana_poses(&file.robot, &answer.modes.iter().map(way).collect::<Vec<_>>())
            }))
        })?)
    }

    fn forward(&self, py: Python<'_>, inputs: [f64; 3]) -> PyResult<Answer> {
        Ok(py.detach(|| {
            finite("inputs", &inputs)?;
            let robot = &self.file.robot;
            let answer = robot.forward(&inputs).map_err(asked)?;
            let (json, file) = (hana_forward_json(&answer, &robot.violations(&inputs)), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || {
                let posed = |(number, mode): (usize, &assur::HanaAssembly)| PosedRobot {
                    caption: format!("{number}: {}", mode.mode),
                    pose: mode.pose,
                    inputs,
                };
                assur::plot::draw_hana_poses(&file.robot, &(1..).zip(&answer.modes).map(posed).collect::<Vec<_>>())
            }))
        })?)
    }

    #[pyo3(signature = (pose, signs, rates, accelerations))]
    fn velocity(
        &self,
        py: Python<'_>,
        pose: [f64; 3],
        signs: &str,
        rates: Option<[f64; 3]>,
        accelerations: Option<[f64; 3]>,
    ) -> PyResult<Answer> {
        Ok(py.detach(|| {
            finite("pose", &pose)?;
            finite("rates", rates.iter().flatten())?;
            finite("accelerations", accelerations.iter().flatten())?;
            let pose = HanaPose::new(pose[0], pose[1], pose[2]);
            let velocity = self.file.robot.velocity(&pose, mode(signs)?).map_err(asked)?;
            let (rates, accelerations) = (rates.map(Vector3::from), accelerations.map(Vector3::from));
            Ok::<_, Refused>(Answer::plain(hana_velocity_json(&velocity, rates, accelerations)))
        })?)
    }

    /// Matrices, singularities, rates and accelerations of many rows; arrays without rows for what is not asked.
    fn velocity_batch(
        &self,
        py: Python<'_>,
        poses: PyReadonlyArray2<'_, f64>,
        signs: &str,
        rates: PyReadonlyArray2<'_, f64>,
        accelerations: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<SpatialBatch> {
        spatial_batch::hana(py, &self.file.robot, mode(signs)?, &poses, [&rates, &accelerations])
    }

    /// The places of the platform's centre: for an orientation, or reachable over a range of them.
    #[pyo3(signature = (phi, range, signs))]
    fn workspace(&self, py: Python<'_>, phi: Option<f64>, range: Option<[f64; 2]>, signs: &str) -> PyResult<Answer> {
        Ok(py.detach(|| {
            let (kind, region) = self.region(phi, range, signs)?;
            let (json, file) = (hana_workspace_json(kind, &region), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || {
                assur::plot::draw_hana(&file.robot.name, &[(kind.to_owned(), &region)], None)
            }))
        })?)
    }

    /// Points along the pieces of the boundary of a workspace, flat: loops of pieces.
    #[pyo3(signature = (phi, range, signs, points))]
    fn outlines(
        &self,
        py: Python<'_>,
        phi: Option<f64>,
        range: Option<[f64; 2]>,
        signs: &str,
        points: usize,
    ) -> PyResult<Vec<Vec<Vec<f64>>>> {
        Ok(py.detach(|| {
            let (_, region) = self.region(phi, range, signs)?;
            let piece = |arc: &WorkspaceArc| arc.points(points).into_iter().flatten().collect();
            let outline = |(_, arcs): &(f64, Vec<WorkspaceArc>)| arcs.iter().map(piece).collect();
            Ok::<_, Refused>(region.loops.iter().map(outline).collect())
        })?)
    }

    /// How far the platform tilts.
    #[pyo3(signature = (at, signs, strokes, cells))]
    fn capability(
        &self,
        py: Python<'_>,
        at: Option<[f64; 2]>,
        signs: &str,
        strokes: Vec<f64>,
        cells: Option<usize>,
    ) -> PyResult<Answer> {
        Ok(py.detach(|| {
            finite("at", at.iter().flatten())?;
            let question = AskedTilts { at, strokes, cells };
            let found = HanaTilts::of(&self.file.robot, mode(signs)?, &question, |_| ()).map_err(asked)?;
            let (json, file) = (found.to_json(), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || {
                let regions = [("phi = 0".to_owned(), &found.region)];
                assur::plot::draw_hana(&file.robot.name, &regions, found.map.as_ref())
            }))
        })?)
    }
}

/// A three-legged robot of six degrees of freedom.
#[pyclass(frozen, module = "assur._assur")]
pub struct TripodModel {
    file: Arc<TripodFile>,
}

/// A place with a rotation vector, or with a rotation matrix row by row.
fn tripod_pose(values: &[f64]) -> Result<TripodPose, Refused> {
    finite("pose", values)?;
    let wrong = |found| Refused::input(SpatialError::WrongCount { what: "pose", expected: 6, found });
    let place = |values: &[f64]| Vector3::from_column_slice(&values[..3]);
    match values.len() {
        6 => Ok(TripodPose::new(place(values), place(&values[3..]))),
        12 => TripodPose::with_matrix(place(values), Matrix3::from_row_slice(&values[3..])).map_err(asked),
        found => Err(wrong(found)),
    }
}

/// Rates or accelerations: six of the platform or of the sliders, fewer, one for each motor, of the sliders.
fn six(robot: &Tripod, what: &'static str, given: Option<&Vec<f64>>) -> Result<Option<Vector6<f64>>, Refused> {
    let Some(given) = given else { return Ok(None) };
    finite(what, given)?;
    let all = match <[f64; 6]>::try_from(given.as_slice()) {
        Ok(all) => all,
        Err(_) => robot.all_sliders(what, given).map_err(asked)?,
    };
    Ok(Some(all.into()))
}

#[pymethods]
impl TripodModel {
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        let file = TripodFile::read(&path).map_err(Refused::model)?;
        Ok(Self { file: Arc::new(file) })
    }

    #[staticmethod]
    fn parse(text: &str, name: &str) -> PyResult<Self> {
        let file = TripodFile::parse(text, name).map_err(Refused::model)?;
        Ok(Self { file: Arc::new(file) })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.file.robot.name
    }

    fn inverse(&self, py: Python<'_>, pose: Vec<f64>) -> PyResult<Answer> {
        Ok(py.detach(|| {
            let (robot, pose) = (&self.file.robot, tripod_pose(&pose)?);
            let inputs = robot.inverse(&pose).map_err(asked)?;
            let angles = robot.plane_angles(&pose).map_err(asked)?;
            let violations = robot.violations(&pose, &inputs).map_err(asked)?;
            let (json, file) = (tripod_inverse_json(&pose, &inputs, &angles, &violations), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || {
                assur::plot::draw_tripod_poses(&file.robot, &[PosedRobot { caption: String::new(), pose, inputs }])
            }))
        })?)
    }

    /// The sliders, from 1, that have a motor of their own.
    #[getter]
    fn motors(&self) -> Vec<usize> {
        self.file.robot.motors()
    }

    /// The orientations that point the tool's axis in a direction.
    fn pointing(&self, py: Python<'_>, direction: [f64; 3]) -> PyResult<Answer> {
        Ok(py.detach(|| {
            finite("direction", &direction)?;
            let direction = Vector3::from(direction);
            let found = self.file.robot.pointing(&direction).map_err(asked)?;
            Ok::<_, Refused>(Answer::plain(tripod_torsions_json(&direction, &found)))
        })?)
    }

    /// The poses at a place that point the tool's axis in a direction.
    fn pointed(&self, py: Python<'_>, position: [f64; 3], direction: [f64; 3]) -> PyResult<Answer> {
        Ok(py.detach(|| {
            finite("position", &position)?;
            finite("direction", &direction)?;
            let (position, direction) = (Vector3::from(position), Vector3::from(direction));
            let found = self.file.robot.pointed(&position, &direction).map_err(asked)?;
            let (json, file) = (tripod_pointing_json(&position, &direction, &found), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || {
                let angle = |way: &assur::TripodPointing| file.angle_unit.from_rad(way.torsion);
                let posed = |way: &assur::TripodPointing| PosedRobot {
                    caption: format!("torsion {:.6} {}", angle(way), file.angle_unit.name()),
                    pose: way.pose,
                    inputs: way.inputs,
                };
                assur::plot::draw_tripod_poses(&file.robot, &found.ways.iter().map(posed).collect::<Vec<_>>())
            }))
        })?)
    }

    fn forward(&self, py: Python<'_>, inputs: Vec<f64>, certify: bool) -> PyResult<Answer> {
        Ok(py.detach(|| {
            finite("inputs", &inputs)?;
            let robot = &self.file.robot;
            let inputs = robot.all_sliders("inputs", &inputs).map_err(asked)?;
            let answer = if certify { robot.certify(&inputs) } else { robot.forward(&inputs) }.map_err(asked)?;
            let (json, file) = (tripod_forward_json(&answer), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || {
                let posed = |(number, mode): (usize, &assur::TripodAssembly)| PosedRobot {
                    caption: format!("mode {number}"),
                    pose: mode.pose,
                    inputs,
                };
                assur::plot::draw_tripod_poses(&file.robot, &(1..).zip(&answer.modes).map(posed).collect::<Vec<_>>())
            }))
        })?)
    }

    #[pyo3(signature = (pose, rates, accelerations))]
    fn velocity(
        &self,
        py: Python<'_>,
        pose: Vec<f64>,
        rates: Option<Vec<f64>>,
        accelerations: Option<Vec<f64>>,
    ) -> PyResult<Answer> {
        Ok(py.detach(|| {
            let robot = &self.file.robot;
            let of_platform = [&rates, &accelerations].into_iter().flatten().all(|given| given.len() == 6);
            let rates = six(robot, "rates", rates.as_ref())?;
            let accelerations = six(robot, "accelerations", accelerations.as_ref())?;
            let velocity = robot.velocity(&tripod_pose(&pose)?).map_err(asked)?;
            let json = tripod_velocity_json(robot, &velocity, rates, accelerations, of_platform);
            Ok::<_, Refused>(Answer::plain(json))
        })?)
    }

    /// Jacobians, singularities, rates and accelerations of many rows; arrays without rows for what is not asked.
    fn velocity_batch(
        &self,
        py: Python<'_>,
        poses: PyReadonlyArray2<'_, f64>,
        rates: PyReadonlyArray2<'_, f64>,
        accelerations: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<SpatialBatch> {
        spatial_batch::tripod(py, &self.file.robot, &poses, [&rates, &accelerations])
    }

    /// The largest tilt at a place, with the angle that is proved for every azimuth.
    fn tilt(&self, py: Python<'_>, at: [f64; 3], tolerance: f64) -> PyResult<Answer> {
        Ok(py.detach(|| {
            finite("at", &at)?;
            let (robot, place) = (&self.file.robot, Vector3::from(at));
            let found = robot.tilt(&place).map_err(asked)?;
            if tolerance.is_nan() || tolerance <= 0.0 {
                let what = "tolerance".to_owned();
                return Err(Refused::input(TripodError::from(SpatialError::NotPositive { what, value: tolerance })));
            }
            let proved = match &found {
                Some(found) => robot.tilt_bound(&place, found, tolerance).map_err(asked)?,
                None => None,
            };
            Ok(Answer::plain(tilt_json(&place, found.as_ref(), proved)))
        })?)
    }

    /// The largest tilts over sections of a box.
    fn tilt_map(
        &self,
        py: Python<'_>,
        low: [f64; 3],
        high: [f64; 3],
        sections: usize,
        cells: usize,
    ) -> PyResult<Answer> {
        Ok(py.detach(|| {
            let found = TiltSections::of(&self.file.robot, low, high, [sections, cells], || ()).map_err(asked)?;
            let (json, file) = (found.to_json(), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || {
                assur::plot::draw_tilt_sections(&file.robot.name, low, high, cells, &found.maps)
            }))
        })?)
    }
}

/// `det J` over the elevations of a design (`inclined` or `upright`), a curve a pose.
#[pyfunction]
pub fn determinant(
    py: Python<'_>,
    design: &str,
    distances: [f64; 2],
    poses: Vec<Vec<f64>>,
    range: [f64; 2],
    points: usize,
) -> PyResult<Answer> {
    let known = [TripodDesign::Inclined, TripodDesign::Upright].into_iter().find(|known| known.name() == design);
    let design =
        known.ok_or_else(|| PyValueError::new_err(format!("design: \"{design}\" must be inclined or upright")))?;
    Ok(py.detach(|| {
        let curve = |pose: &Vec<f64>| {
            let pose = tripod_pose(pose)?;
            let points = design.determinant_curve(distances[0], distances[1], &pose, range, points);
            Ok::<_, Refused>((pose, points.map_err(asked)?))
        };
        let curves = poses.iter().map(curve).collect::<Result<Vec<_>, _>>()?;
        Ok::<_, Refused>(Answer::plain(tripod_determinant_json(design, distances, &curves)))
    })?)
}

/// Tripteron, Quadrupteron or Hexapteron.
#[pyclass(frozen, module = "assur._assur")]
pub struct MultipteronModel {
    file: MultipteronFile,
}

#[pymethods]
impl MultipteronModel {
    #[staticmethod]
    fn parse(text: &str, name: &str) -> PyResult<Self> {
        Ok(Self { file: MultipteronFile::parse(text, name).map_err(Refused::model)? })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.file.name
    }

    /// `tripteron`, `quadrupteron` or `hexapteron`.
    #[getter]
    fn kind(&self) -> &'static str {
        self.file.robot.name()
    }

    /// How many sliders there are.
    #[getter]
    fn degrees_of_freedom(&self) -> usize {
        self.file.robot.degrees_of_freedom()
    }

    fn forward(&self, py: Python<'_>, inputs: Vec<f64>) -> PyResult<Answer> {
        Ok(py.detach(|| {
            let answer = self.file.robot.forward(&inputs).map_err(asked)?;
            let (json, file) = (multipteron_forward_json(&self.file.robot, &inputs, &answer), self.file.clone());
            let numbered = (1..).zip(answer.poses).map(|(number, pose): (usize, _)| (format!("mode {number}"), pose));
            let poses: Vec<_> = numbered.collect();
            let draw = move || assur::plot::draw_multipteron_poses(file.title(), &file.robot, &poses);
            Ok::<_, Refused>(Answer::drawn(json, draw))
        })?)
    }

    fn inverse(&self, py: Python<'_>, place: [f64; 3], turn: [f64; 3]) -> PyResult<Answer> {
        let (place, turn) = (Vector3::from(place), Vector3::from(turn));
        Ok(py.detach(|| {
            let inputs = self.file.robot.inverse(&place, &turn).map_err(asked)?;
            let (json, file) = (multipteron_inverse_json(&self.file.robot, &place, &turn, &inputs), self.file.clone());
            let poses = [(String::new(), TripodPose::new(place, turn))];
            let draw = move || assur::plot::draw_multipteron_poses(file.title(), &file.robot, &poses);
            Ok::<_, Refused>(Answer::drawn(json, draw))
        })?)
    }
}
