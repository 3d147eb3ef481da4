//! A manipulator, and what is asked of it. Angles in radians throughout, whatever the file's unit.

use std::path::PathBuf;
use std::sync::Arc;

use assur::exchange::{
    AngleUnit, AskedLoci, CheckReport, ClaimedPoses, ForwardReport, InverseReport, Loci, ModelFile, Motion,
    MotionAnswer, PathReport, VerifyReport,
};
use assur::nalgebra::Vector3;
use assur::workspace::StrokeVoid;
use assur::{DesignError, DesignKey, Manipulator, MapQuantity, PathSettings, Pose};
use numpy::{PyArray1, PyReadonlyArray2, ToPyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::batch::{self, Batch};
use crate::poses::{self, MotionBatch, Moving, WaysBatch};
use crate::refused::Refused;
use crate::workspace::{self, Asked, Shape};

/// A model file: a manipulator, and the unit its file writes angles in.
#[pyclass(frozen, module = "assur._assur")]
pub struct Model {
    file: Arc<ModelFile>,
}

impl Model {
    fn of(file: ModelFile) -> Self {
        Self { file: Arc::new(file) }
    }

    fn robot(&self) -> &Manipulator {
        &self.file.manipulator
    }
}

fn pose([x, y, phi]: [f64; 3]) -> Pose {
    Pose::new(x, y, phi)
}

#[pymethods]
impl Model {
    /// Reads a model file, TOML or JSON by its ending.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Ok(py.detach(|| ModelFile::read(&path)).map(Self::of).map_err(Refused::model)?)
    }

    /// The model in a text; `name` is what errors call it.
    #[staticmethod]
    fn parse(text: &str, name: &str) -> PyResult<Self> {
        Ok(ModelFile::parse(text, name).map(Self::of).map_err(Refused::model)?)
    }

    /// A model of a family, with inputs to try.
    #[staticmethod]
    fn of_family(family: &str) -> PyResult<(Self, Vec<f64>)> {
        let found = Manipulator::of_family(family);
        let (manipulator, inputs) = found.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok((Self::of(ModelFile { manipulator, angle_unit: AngleUnit::Rad }), inputs.to_vec()))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.robot().name
    }

    #[getter]
    fn family(&self) -> String {
        self.robot().family()
    }

    #[getter]
    fn angle_unit(&self) -> &'static str {
        self.file.angle_unit.name()
    }

    fn to_json(&self) -> String {
        self.file.to_json()
    }

    fn to_toml(&self) -> String {
        self.file.to_toml()
    }

    fn check(&self) -> String {
        CheckReport::of(&self.file).to_json()
    }

    /// The model with some numbers of the design changed, by name; angles in radians.
    fn with_numbers(&self, numbers: Vec<(String, f64)>) -> PyResult<Self> {
        let mut file = ModelFile::clone(&self.file);
        for (key, value) in numbers {
            let key: DesignKey = key.parse().map_err(|error: DesignError| Refused::input(error))?;
            for number in key.numbers(&file.manipulator).map_err(Refused::input)? {
                file.manipulator.set_design_number(number, value).map_err(Refused::input)?;
            }
        }
        file.manipulator.validate().map_err(Refused::model)?;
        Ok(Self::of(file))
    }

    /// Every assembly mode, with proofs on request.
    fn forward(&self, py: Python<'_>, inputs: Vec<f64>, certify: bool) -> PyResult<Answer> {
        Ok(py.detach(|| {
            let robot = self.robot();
            let found = if certify { robot.certify(&inputs) } else { robot.forward(&inputs) };
            let answer = found.map_err(Refused::input)?;
            let (json, file) = (ForwardReport::of_manipulator(&answer).to_json(), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || assur::plot::draw_modes(&file.manipulator, &answer)))
        })?)
    }

    /// Every assembly mode of many rows.
    fn forward_batch(&self, py: Python<'_>, inputs: PyReadonlyArray2<'_, f64>) -> PyResult<Batch> {
        batch::forward(py, self.robot(), inputs)
    }

    /// Every working mode of many rows.
    fn inverse_batch(&self, py: Python<'_>, poses: PyReadonlyArray2<'_, f64>) -> PyResult<WaysBatch> {
        poses::inverse(py, self.robot(), poses)
    }

    /// Matrices, singularities, rates, accelerations and forces of many rows; arrays without rows for what is not asked.
    #[pyo3(signature = (poses, mode, rates, accelerations, wrenches, length))]
    #[expect(clippy::too_many_arguments, reason = "what the command line asks for")]
    fn velocity_batch(
        &self,
        py: Python<'_>,
        poses: PyReadonlyArray2<'_, f64>,
        mode: Option<&str>,
        rates: PyReadonlyArray2<'_, f64>,
        accelerations: PyReadonlyArray2<'_, f64>,
        wrenches: PyReadonlyArray2<'_, f64>,
        length: Option<f64>,
    ) -> PyResult<MotionBatch> {
        poses::velocity(py, self.robot(), poses, mode, &Moving { rates, accelerations, wrenches }, length)
    }

    fn inverse(&self, py: Python<'_>, at: [f64; 3]) -> PyResult<Answer> {
        Ok(py.detach(|| {
            let answer = self.robot().inverse(&pose(at)).map_err(Refused::input)?;
            Ok::<_, Refused>(Answer::plain(InverseReport::from(&answer).to_json()))
        })?)
    }

    #[pyo3(signature = (at, mode, rates, accelerations, wrench, length))]
    #[expect(clippy::too_many_arguments, reason = "what the command line asks for")]
    fn velocity(
        &self,
        py: Python<'_>,
        at: [f64; 3],
        mode: Option<String>,
        rates: Option<[f64; 3]>,
        accelerations: Option<[f64; 3]>,
        wrench: Option<[f64; 3]>,
        length: Option<f64>,
    ) -> PyResult<Answer> {
        let motion = Motion {
            rates: rates.map(Vector3::from),
            accelerations: accelerations.map(Vector3::from),
            wrench: wrench.map(Vector3::from),
        };
        Ok(py.detach(|| {
            let answer = MotionAnswer::of(self.robot(), &pose(at), mode.as_deref(), motion, length);
            Ok::<_, Refused>(Answer::plain(answer.map_err(Refused::input)?.report().to_json()))
        })?)
    }

    /// Where the manipulator is singular for an orientation.
    #[pyo3(signature = (phi, mode, map, polynomial))]
    fn singularities(
        &self,
        py: Python<'_>,
        phi: f64,
        mode: Option<String>,
        map: Option<&str>,
        polynomial: bool,
    ) -> PyResult<Answer> {
        let map = map.map(|name| {
            let all = [MapQuantity::Dexterity, MapQuantity::Accuracy, MapQuantity::Stiffness];
            let known = all.into_iter().find(|quantity| quantity.name() == name);
            known.ok_or_else(|| {
                PyValueError::new_err(format!("map: \"{name}\" must be dexterity, accuracy or stiffness"))
            })
        });
        let asked = AskedLoci { phi, mode, map: map.transpose()?, polynomial };
        Ok(py.detach(|| {
            let found = Loci::of(self.robot(), &asked).map_err(Refused::input)?;
            let (json, file) = (found.report().to_json(), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || {
                let Loci { phi, window, edges, traced, map, .. } = &found;
                assur::plot::draw_singularities(&file.manipulator, *phi, window, traced, edges, map.as_ref())
            }))
        })?)
    }

    /// One assembly mode through rows of inputs.
    #[pyo3(signature = (rows, start))]
    fn follow(&self, py: Python<'_>, rows: PyReadonlyArray2<'_, f64>, start: Option<[f64; 3]>) -> PyResult<Answer> {
        let rows: Vec<Vec<f64>> = rows.as_array().rows().into_iter().map(|row| row.to_vec()).collect();
        Ok(py.detach(|| {
            let found = self.robot().follow(&rows, start.map(pose), &PathSettings::default());
            let path = found.map_err(Refused::input)?;
            let (json, file) = (PathReport::from(&path).to_json(), self.file.clone());
            Ok::<_, Refused>(Answer::drawn(json, move || assur::plot::draw_path(&file.manipulator, &path)))
        })?)
    }

    /// What the stroke of each leg leaves out: kind, point or tips flat, area; none for a leg that is no PRR leg with a range.
    fn stroke_voids(&self) -> Vec<Option<(&'static str, Vec<f64>, f64)>> {
        let void = |void: StrokeVoid| match void {
            StrokeVoid::None => ("none", Vec::new(), 0.0),
            StrokeVoid::Touching { at } => ("touching", at.to_vec(), 0.0),
            StrokeVoid::Lens { tips, area } => ("lens", tips.as_flattened().to_vec(), area),
        };
        self.robot().stroke_voids().into_iter().map(|one| one.map(void)).collect()
    }

    /// The workspace of a kind.
    fn workspace(&self, py: Python<'_>, asked: Asked) -> PyResult<(Answer, Shape)> {
        Ok(py.detach(|| workspace::workspace(&self.file, &asked))?)
    }

    /// What is proved of the poses that a report claims.
    fn verify(&self, py: Python<'_>, report: &str, name: &str, tolerance: f64) -> PyResult<Answer> {
        Ok(py.detach(|| {
            let claims = ClaimedPoses::parse(report, name).map_err(Refused::model)?;
            let group = self.robot().certify(&claims.inputs).map_err(Refused::input)?.group;
            let judgement = group.judge(&claims.poses, tolerance);
            Ok::<_, Refused>(Answer::plain(VerifyReport::of(&group, &judgement, tolerance).to_json()))
        })?)
    }

    /// The frames before and after each joint of each leg, `x, y, angle`, flat: `(legs, 3, 2, 3)`.
    fn frames<'py>(&self, py: Python<'py>, joints: Vec<[f64; 3]>) -> Bound<'py, PyArray1<f64>> {
        let frames = self.robot().legs.iter().zip(&joints).flat_map(|(leg, values)| leg.frames(values));
        let flat = frames.flatten().flat_map(|frame| {
            let at = frame.translation.vector;
            [at.x, at.y, frame.rotation.angle()]
        });
        flat.collect::<Vec<f64>>().to_pyarray(py)
    }
}
