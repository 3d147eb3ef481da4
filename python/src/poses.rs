//! Many poses at once, array to array: working modes, and matrices with their singularities.

use assur::exchange::{Motion, MotionAnswer};
use assur::nalgebra::{Matrix3, Vector3};
use assur::{KinematicsError, Manipulator, Pose, SingularMatrix, SingularityKind, WorkingModes};
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::batch::{RowError, RowErrors};
use crate::refused::Refused;

/// Rows between two looks at whether the user interrupts: some tenths of a second.
const ROWS_A_LOOK: usize = 1 << 14;

/// An array of zeros. numpy allocates, and raises MemoryError where it cannot.
pub fn zeros<'py, T: Element>(py: Python<'py>, shape: &[usize], kind: &str) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    Ok(py.import("numpy")?.call_method1("zeros", (shape.to_vec(), kind))?.cast_into::<PyArrayDyn<T>>()?)
}

/// What the poses of a batch came to on the way back.
#[pyclass(frozen, module = "assur._assur", get_all)]
pub struct WaysBatch {
    /// The names of the modes, in their places below.
    names: Vec<String>,
    /// `(n, modes, legs, 3)`: joint values; zeros where there is no such mode.
    joints: Py<PyArrayDyn<f64>>,
    /// `(n, modes)`: 0 where there is no such mode, 1 within the limits, 2 where it violates some.
    found: Py<PyArrayDyn<u8>>,
    /// `(n, legs)`: by how much each leg misses, zero where it reaches.
    misses: Py<PyArrayDyn<f64>>,
    errors: Py<RowErrors>,
}

/// Every working mode of the rows of a C-contiguous `(n, 3)` array.
pub fn inverse(py: Python<'_>, robot: &Manipulator, poses: PyReadonlyArray2<'_, f64>) -> PyResult<WaysBatch> {
    let names = robot.mode_names();
    let (rows, legs) = (poses.shape()[0], robot.legs.len());
    let joints = zeros::<f64>(py, &[rows, names.len(), legs, 3], "f8")?;
    let found = zeros::<u8>(py, &[rows, names.len()], "u1")?;
    let misses = zeros::<f64>(py, &[rows, legs], "f8")?;
    let mut errors = Vec::new();
    {
        let poses = poses.as_slice()?;
        let (mut joints, mut found, mut misses) = (joints.readwrite(), found.readwrite(), misses.readwrite());
        let (joints, found, misses) = (joints.as_slice_mut()?, found.as_slice_mut()?, misses.as_slice_mut()?);
        let mut put = |row: usize, answer: WorkingModes| {
            for leg in answer.unreachable {
                misses[legs * row + leg.leg - 1] = leg.miss;
            }
            for mode in answer.modes {
                let Some(place) = names.iter().position(|name| *name == mode.signs) else { continue };
                let slot = names.len() * row + place;
                found[slot] = if mode.violations.is_empty() { 1 } else { 2 };
                joints[3 * legs * slot..3 * legs * (slot + 1)].copy_from_slice(mode.joints.as_flattened());
            }
        };
        for first in (0..rows).step_by(ROWS_A_LOOK) {
            let some = &poses[3 * first..3 * rows.min(first + ROWS_A_LOOK)];
            let answers: Vec<_> = py.detach(|| some.par_chunks_exact(3).map(|at| robot.inverse(&pose(at))).collect());
            for (row, answer) in (first..).zip(answers) {
                match answer {
                    Ok(answer) => put(row, answer),
                    Err(error) => errors.push((row, RowError::Pose(error))),
                }
            }
            py.check_signals()?;
        }
    }
    let errors = Py::new(py, RowErrors { errors })?;
    Ok(WaysBatch { names, joints: joints.unbind(), found: found.unbind(), misses: misses.unbind(), errors })
}

/// What the poses of a batch came to in motion.
#[pyclass(frozen, module = "assur._assur", get_all)]
pub struct MotionBatch {
    /// The names of the modes.
    names: Vec<String>,
    /// `(n,)`: the place of each row's mode among them.
    modes: Py<PyArrayDyn<u8>>,
    /// `(n, 2, 3, 3)`: the pose matrix and the input matrix.
    matrices: Py<PyArrayDyn<f64>>,
    /// `(n, 5)`: the determinants of both, the smallest singular values of both, the dexterity.
    readings: Py<PyArrayDyn<f64>>,
    /// `(n,)`: 0 none, 1 to 3 the type, 4 self-motion, 5 for a row with an error.
    singularities: Py<PyArrayDyn<u8>>,
    /// `(n, 2, 3)`: rates of the inputs if those given are the platform's, of the platform if they are the inputs'; empty where none were given.
    rates: Py<PyArrayDyn<f64>>,
    /// `(n, 2)`: whether there are such rates.
    answered: Py<PyArrayDyn<bool>>,
    /// `(n, 2, 3)`: accelerations, as the rates; empty where none were given.
    accelerations: Py<PyArrayDyn<f64>>,
    /// `(n, 2)`: whether there are such accelerations.
    accelerated: Py<PyArrayDyn<bool>>,
    /// `(n, 3)`: forces of the actuators that hold the wrench; empty where none was given.
    forces: Py<PyArrayDyn<f64>>,
    /// `(n,)`: whether there are such forces.
    held: Py<PyArrayDyn<bool>>,
    errors: Py<RowErrors>,
}

/// What is asked of each pose: arrays `(n, 3)`, or without rows where it is not asked.
pub struct Moving<'py> {
    /// Rates of the platform, or of the inputs.
    pub rates: PyReadonlyArray2<'py, f64>,
    /// Accelerations that go with them.
    pub accelerations: PyReadonlyArray2<'py, f64>,
    /// Wrenches on the platform.
    pub wrenches: PyReadonlyArray2<'py, f64>,
}

/// A row of an array that may be without rows.
fn row_of(values: &[f64], row: usize) -> Option<Vector3<f64>> {
    values.get(3 * row..3 * row + 3).map(Vector3::from_column_slice)
}

/// Puts both answers of a row where there are such.
fn put_both(row: usize, both: [Result<Vector3<f64>, SingularMatrix>; 2], values: &mut [f64], there: &mut [bool]) {
    for (way, found) in both.into_iter().enumerate() {
        let Ok(found) = found else { continue };
        values[6 * row + 3 * way..][..3].copy_from_slice(found.as_slice());
        there[2 * row + way] = true;
    }
}

/// Matrices, singularities and motions of the rows of a C-contiguous `(n, 3)` array.
pub fn velocity(
    py: Python<'_>,
    robot: &Manipulator,
    poses: PyReadonlyArray2<'_, f64>,
    mode: Option<&str>,
    moving: &Moving<'_>,
    length: Option<f64>,
) -> PyResult<MotionBatch> {
    if let Some(signs) = mode {
        robot.check_signs(signs).map_err(Refused::input)?;
    }
    if let Some(value) = length.filter(|value| !(value.is_finite() && *value > 0.0)) {
        return Err(Refused::input(KinematicsError::NotPositive { what: "length", value }).into());
    }
    let names = robot.mode_names();
    let rows = poses.shape()[0];
    let [moved, pushed, loaded] =
        [&moving.rates, &moving.accelerations, &moving.wrenches].map(|given| given.shape()[0]);
    let modes = zeros::<u8>(py, &[rows], "u1")?;
    let matrices = zeros::<f64>(py, &[rows, 2, 3, 3], "f8")?;
    let readings = zeros::<f64>(py, &[rows, 5], "f8")?;
    let singularities = zeros::<u8>(py, &[rows], "u1")?;
    let found_rates = zeros::<f64>(py, &[moved, 2, 3], "f8")?;
    let answered = zeros::<bool>(py, &[moved, 2], "?")?;
    let found_accelerations = zeros::<f64>(py, &[pushed, 2, 3], "f8")?;
    let accelerated = zeros::<bool>(py, &[pushed, 2], "?")?;
    let found_forces = zeros::<f64>(py, &[loaded, 3], "f8")?;
    let held = zeros::<bool>(py, &[loaded], "?")?;
    let mut errors = Vec::new();
    {
        let poses = poses.as_slice()?;
        let (given_rates, given_accelerations) = (moving.rates.as_slice()?, moving.accelerations.as_slice()?);
        let given_wrenches = moving.wrenches.as_slice()?;
        let (mut modes, mut matrices, mut readings) = (modes.readwrite(), matrices.readwrite(), readings.readwrite());
        let (modes, matrices, readings) = (modes.as_slice_mut()?, matrices.as_slice_mut()?, readings.as_slice_mut()?);
        let (mut kinds, mut rates, mut answered) =
            (singularities.readwrite(), found_rates.readwrite(), answered.readwrite());
        let (kinds, rates, answered) = (kinds.as_slice_mut()?, rates.as_slice_mut()?, answered.as_slice_mut()?);
        let (mut accelerations, mut accelerated) = (found_accelerations.readwrite(), accelerated.readwrite());
        let (accelerations, accelerated) = (accelerations.as_slice_mut()?, accelerated.as_slice_mut()?);
        let (mut forces, mut held) = (found_forces.readwrite(), held.readwrite());
        let (forces, held) = (forces.as_slice_mut()?, held.as_slice_mut()?);
        let mut put = |row: usize, answer: &MotionAnswer| {
            let (velocity, singularity) = (&answer.velocity, &answer.singularity);
            modes[row] = names.iter().position(|name| *name == answer.signs).unwrap_or_default() as u8;
            for (place, matrix) in [&velocity.pose_matrix, &velocity.input_matrix].into_iter().enumerate() {
                matrices[18 * row + 9 * place..][..9].copy_from_slice(&row_by_row(matrix));
            }
            readings[5 * row..5 * row + 5].copy_from_slice(&[
                velocity.pose_matrix.determinant(),
                velocity.input_matrix.determinant(),
                singularity.sigma_min,
                singularity.sigma_min_input,
                singularity.dexterity,
            ]);
            if let Some(given) = answer.motion.rates {
                put_both(row, [velocity.input_rates(&given), velocity.pose_rates(&given)], rates, answered);
            }
            if let Some(given) = answer.motion.accelerations {
                let at = answer.motion.rates.unwrap_or_else(Vector3::zeros);
                let both = [velocity.input_accelerations(&at, &given), velocity.pose_accelerations(&at, &given)];
                put_both(row, both, accelerations, accelerated);
            }
            if let Some(Ok(found)) = answer.motion.wrench.map(|given| velocity.actuator_forces(&given)) {
                forces[3 * row..3 * row + 3].copy_from_slice(found.as_slice());
                held[row] = true;
            }
        };
        for first in (0..rows).step_by(ROWS_A_LOOK) {
            let last = rows.min(first + ROWS_A_LOOK);
            let answers: Vec<_> = py.detach(|| {
                let ask = |row: usize| {
                    let motion = Motion {
                        rates: row_of(given_rates, row),
                        accelerations: row_of(given_accelerations, row),
                        wrench: row_of(given_wrenches, row),
                    };
                    MotionAnswer::of(robot, &pose(&poses[3 * row..3 * row + 3]), mode, motion, length)
                };
                (first..last).into_par_iter().map(ask).collect()
            });
            for (row, answer) in (first..).zip(answers) {
                match answer {
                    Ok(answer) => {
                        kinds[row] = code(answer.singularity.kind);
                        put(row, &answer);
                    }
                    Err(error) => {
                        kinds[row] = ERROR;
                        errors.push((row, RowError::Pose(error)));
                    }
                }
            }
            py.check_signals()?;
        }
    }
    Ok(MotionBatch {
        names,
        modes: modes.unbind(),
        matrices: matrices.unbind(),
        readings: readings.unbind(),
        singularities: singularities.unbind(),
        rates: found_rates.unbind(),
        answered: answered.unbind(),
        accelerations: found_accelerations.unbind(),
        accelerated: accelerated.unbind(),
        forces: found_forces.unbind(),
        held: held.unbind(),
        errors: Py::new(py, RowErrors { errors })?,
    })
}

/// The code of a row that could not be asked.
const ERROR: u8 = 5;

fn code(kind: SingularityKind) -> u8 {
    match kind {
        SingularityKind::Regular => 0,
        SingularityKind::Type1 => 1,
        SingularityKind::Type2 => 2,
        SingularityKind::Type3 => 3,
        SingularityKind::SelfMotion => 4,
    }
}

fn pose(at: &[f64]) -> Pose {
    Pose::new(at[0], at[1], at[2])
}

/// nalgebra's matrices lie column by column, numpy's row by row.
fn row_by_row(matrix: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|k| matrix[(k / 3, k % 3)])
}
