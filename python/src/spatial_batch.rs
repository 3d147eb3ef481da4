//! Velocities of the spatial robots in many poses at once, array to array.

use assur::nalgebra::{Matrix3, Vector3, Vector6};
use assur::{
    Hana, HanaMode, HanaPose, HanaSingularKind, SpatialError, Tripod, TripodError, TripodPose, TripodSingularity,
};
use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::batch::{RowError, RowErrors};
use crate::poses::zeros;

/// Rows between two looks at whether the user interrupts: some tenths of a second.
const ROWS_A_LOOK: usize = 1 << 14;
/// The code of a row that could not be asked.
const ERROR: u8 = 255;

/// What the poses of a batch came to in motion.
#[pyclass(frozen, module = "assur._assur", get_all)]
pub struct SpatialBatch {
    /// `(n, sliders)`: slider positions.
    inputs: Py<PyArrayDyn<f64>>,
    /// `(n, entries)`: the matrices, row by row, one after another.
    matrices: Py<PyArrayDyn<f64>>,
    /// `(n, readings)`.
    readings: Py<PyArrayDyn<f64>>,
    /// `(n,)`: the kind of singularity, 255 for a row with an error.
    singularities: Py<PyArrayDyn<u8>>,
    /// `(n, 2, sliders)`: rates of the inputs if those given are the platform's, of the platform if they are the inputs'; empty where none were given.
    rates: Py<PyArrayDyn<f64>>,
    /// `(n, 2)`: whether there are such rates.
    answered: Py<PyArrayDyn<bool>>,
    /// As the rates.
    accelerations: Py<PyArrayDyn<f64>>,
    accelerated: Py<PyArrayDyn<bool>>,
    errors: Py<RowErrors>,
}

/// Both answers to a row of rates or accelerations: the inputs', the platform's.
type Both = [Option<Vec<f64>>; 2];

/// What one pose came to.
struct Row {
    inputs: Vec<f64>,
    matrices: Vec<f64>,
    readings: Vec<f64>,
    kind: u8,
    rates: Option<Both>,
    accelerations: Option<Both>,
}

/// How many numbers a row has.
struct Widths {
    sliders: usize,
    matrices: usize,
    readings: usize,
}

/// Asks every row, on all processors.
fn filled(
    py: Python<'_>,
    rows: usize,
    [moved, pushed]: [bool; 2],
    widths: &Widths,
    ask: impl Fn(usize) -> Result<Row, RowError> + Sync,
) -> PyResult<SpatialBatch> {
    let some = |given: bool| if given { rows } else { 0 };
    let inputs = zeros::<f64>(py, &[rows, widths.sliders], "f8")?;
    let matrices = zeros::<f64>(py, &[rows, widths.matrices], "f8")?;
    let readings = zeros::<f64>(py, &[rows, widths.readings], "f8")?;
    let singularities = zeros::<u8>(py, &[rows], "u1")?;
    let rates = zeros::<f64>(py, &[some(moved), 2, widths.sliders], "f8")?;
    let answered = zeros::<bool>(py, &[some(moved), 2], "?")?;
    let accelerations = zeros::<f64>(py, &[some(pushed), 2, widths.sliders], "f8")?;
    let accelerated = zeros::<bool>(py, &[some(pushed), 2], "?")?;
    let mut errors = Vec::new();
    {
        let (mut all_inputs, mut all_matrices, mut all_readings) =
            (inputs.readwrite(), matrices.readwrite(), readings.readwrite());
        let (all_inputs, all_matrices, all_readings) =
            (all_inputs.as_slice_mut()?, all_matrices.as_slice_mut()?, all_readings.as_slice_mut()?);
        let mut kinds = singularities.readwrite();
        let kinds = kinds.as_slice_mut()?;
        let (mut all_rates, mut all_answered) = (rates.readwrite(), answered.readwrite());
        let (all_rates, all_answered) = (all_rates.as_slice_mut()?, all_answered.as_slice_mut()?);
        let (mut all_accelerations, mut all_accelerated) = (accelerations.readwrite(), accelerated.readwrite());
        let (all_accelerations, all_accelerated) = (all_accelerations.as_slice_mut()?, all_accelerated.as_slice_mut()?);
        for first in (0..rows).step_by(ROWS_A_LOOK) {
            let last = rows.min(first + ROWS_A_LOOK);
            let answers: Vec<_> = py.detach(|| (first..last).into_par_iter().map(&ask).collect());
            for (row, answer) in (first..).zip(answers) {
                match answer {
                    Ok(found) => {
                        put(all_inputs, row, &found.inputs);
                        put(all_matrices, row, &found.matrices);
                        put(all_readings, row, &found.readings);
                        kinds[row] = found.kind;
                        put_both(all_rates, all_answered, row, found.rates);
                        put_both(all_accelerations, all_accelerated, row, found.accelerations);
                    }
                    Err(error) => {
                        kinds[row] = ERROR;
                        errors.push((row, error));
                    }
                }
            }
            py.check_signals()?;
        }
    }
    Ok(SpatialBatch {
        inputs: inputs.unbind(),
        matrices: matrices.unbind(),
        readings: readings.unbind(),
        singularities: singularities.unbind(),
        rates: rates.unbind(),
        answered: answered.unbind(),
        accelerations: accelerations.unbind(),
        accelerated: accelerated.unbind(),
        errors: Py::new(py, RowErrors { errors })?,
    })
}

fn put(all: &mut [f64], row: usize, values: &[f64]) {
    all[row * values.len()..(row + 1) * values.len()].copy_from_slice(values);
}

fn put_both(all: &mut [f64], there: &mut [bool], row: usize, both: Option<Both>) {
    for (way, values) in both.into_iter().flatten().enumerate() {
        let Some(values) = values else { continue };
        put(all, 2 * row + way, &values);
        there[2 * row + way] = true;
    }
}

/// A row of an array that may be without rows.
fn row_of(values: &[f64], row: usize, width: usize) -> Option<&[f64]> {
    values.get(width * row..width * (row + 1)).filter(|row| !row.is_empty())
}

/// Refuses rates and accelerations of a row that are not finite.
fn finite(given: [&[f64]; 2], row: usize, widths: [usize; 2]) -> Result<(), SpatialError> {
    for (k, what) in ["rate", "acceleration"].into_iter().enumerate() {
        for (place, &value) in (1..).zip(row_of(given[k], row, widths[k]).unwrap_or_default()) {
            if !value.is_finite() {
                return Err(SpatialError::NotFinite { what: format!("{what} {place}"), value });
            }
        }
    }
    Ok(())
}

/// HANA in poses `(n, 3)`; rates and accelerations have as many rows, or none.
pub fn hana(
    py: Python<'_>,
    robot: &Hana,
    mode: HanaMode,
    poses: &PyReadonlyArray2<'_, f64>,
    [rates, accelerations]: [&PyReadonlyArray2<'_, f64>; 2],
) -> PyResult<SpatialBatch> {
    let rows = poses.shape()[0];
    let (poses, moving) = (poses.as_slice()?, [rates.as_slice()?, accelerations.as_slice()?]);
    let three = |found: Result<Vector3<f64>, SpatialError>| found.ok().map(|found| found.as_slice().to_vec());
    let ask = |row: usize| {
        finite(moving, row, [3, 3]).map_err(RowError::Spatial)?;
        let pose = HanaPose::new(poses[3 * row], poses[3 * row + 1], poses[3 * row + 2]);
        let [rates, accelerations] = moving.map(|given| row_of(given, row, 3).map(Vector3::from_column_slice));
        let velocity = robot.velocity(&pose, mode).map_err(RowError::Spatial)?;
        let singularity = velocity.singularity();
        let by_row = |matrix: &Matrix3<f64>| matrix.transpose().as_slice().to_vec();
        let at = rates.unwrap_or_else(Vector3::zeros);
        Ok(Row {
            inputs: velocity.inputs.to_vec(),
            matrices: [by_row(&velocity.pose_matrix), by_row(&velocity.input_matrix)].concat(),
            readings: vec![
                velocity.pose_matrix.determinant(),
                velocity.input_matrix.determinant(),
                singularity.sigma_min,
                singularity.sigma_min_input,
                singularity.dexterity,
            ],
            kind: match singularity.kind {
                HanaSingularKind::None => 0,
                HanaSingularKind::Type1 => 1,
                HanaSingularKind::Type2 => 2,
                HanaSingularKind::Type3 => 3,
            },
            rates: rates.map(|given| [three(velocity.input_rates(&given)), three(velocity.pose_rates(&given))]),
            accelerations: accelerations.map(|given| {
                [three(velocity.input_accelerations(&at, &given)), three(velocity.pose_accelerations(&at, &given))]
            }),
        })
    };
    let widths = Widths { sliders: 3, matrices: 18, readings: 5 };
    filled(py, rows, [rates.shape()[0] > 0, accelerations.shape()[0] > 0], &widths, ask)
}

/// A three-legged robot in poses `(n, 6)` or `(n, 12)`; rates and accelerations have as many rows, or none: six of the platform or of the sliders, fewer of the motors.
pub fn tripod(
    py: Python<'_>,
    robot: &Tripod,
    poses: &PyReadonlyArray2<'_, f64>,
    [rates, accelerations]: [&PyReadonlyArray2<'_, f64>; 2],
) -> PyResult<SpatialBatch> {
    let (rows, width) = (poses.shape()[0], poses.shape()[1]);
    let asked = [rates, accelerations].map(|given| given.shape()[0] > 0);
    let widths = [rates, accelerations].map(|given| given.shape()[1]);
    let of_platform = (0..2).all(|k| !asked[k] || widths[k] == 6);
    let (poses, moving) = (poses.as_slice()?, [rates.as_slice()?, accelerations.as_slice()?]);
    let six = |found: Result<Vector6<f64>, TripodError>| found.ok().map(|found| found.as_slice().to_vec());
    let ask = |row: usize| {
        finite(moving, row, widths).map_err(|error| RowError::Tripod(error.into()))?;
        let velocity = pose(&poses[width * row..width * (row + 1)]).and_then(|pose| robot.velocity(&pose));
        let velocity = velocity.map_err(RowError::Tripod)?;
        let given = |k: usize, what: &'static str| -> Result<Option<Vector6<f64>>, RowError> {
            let Some(given) = row_of(moving[k], row, widths[k]) else { return Ok(None) };
            if given.len() == 6 {
                return Ok(Some(Vector6::from_column_slice(given)));
            }
            Ok(Some(robot.all_sliders(what, given).map_err(RowError::Tripod)?.into()))
        };
        let (rates, accelerations) = (given(0, "rates")?, given(1, "accelerations")?);
        let all = |what, given: &Vector6<f64>| robot.all_sliders(what, given.as_slice()).map(Vector6::from);
        let at = rates.unwrap_or_else(Vector6::zeros);
        Ok(Row {
            inputs: velocity.inputs.to_vec(),
            matrices: velocity.jacobian.transpose().as_slice().to_vec(),
            readings: vec![velocity.jacobian.determinant(), velocity.position_volume, velocity.orientation_volume],
            kind: match velocity.singularity() {
                TripodSingularity::None => 0,
                TripodSingularity::Position => 1,
                TripodSingularity::Orientation => 2,
                TripodSingularity::Both => 3,
            },
            rates: rates.map(|given| {
                let inputs = of_platform.then(|| velocity.input_rates(&given).as_slice().to_vec());
                [inputs, six(all("rates", &given).and_then(|sliders| velocity.pose_rates(&sliders)))]
            }),
            accelerations: accelerations.map(|given| {
                let inputs = of_platform.then(|| velocity.input_accelerations(&at, &given).as_slice().to_vec());
                let sliders = all("rates", &at).and(all("accelerations", &given));
                [inputs, six(sliders.and_then(|sliders| velocity.pose_accelerations(&at, &sliders)))]
            }),
        })
    };
    filled(py, rows, asked, &Widths { sliders: 6, matrices: 36, readings: 3 }, ask)
}

/// A place with a rotation vector, or with a rotation matrix row by row.
fn pose(values: &[f64]) -> Result<TripodPose, TripodError> {
    let place = |values: &[f64]| Vector3::from_column_slice(&values[..3]);
    match values.len() {
        12 => TripodPose::with_matrix(place(values), Matrix3::from_row_slice(&values[3..])),
        _ => Ok(TripodPose::new(place(values), place(&values[3..]))),
    }
}
