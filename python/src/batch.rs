//! Many rows at once, array to array.

use assur::{KinematicsError, LockError, Manipulator, ModesPlaces, SpatialError, Status, TripodError};
use numpy::{PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::refused::Refused;

/// Modes a row has room for.
const MOST_MODES: usize = 6;
/// Rows between two looks at whether the user interrupts: some tenths of a second.
const ROWS_A_LOOK: usize = 1 << 18;

/// What the rows of a batch came to.
#[pyclass(frozen, module = "assur._assur", get_all)]
pub struct Batch {
    /// `(n, 6, 3)`: `x, y, phi` of each mode; zeros beyond the count.
    poses: Py<PyArray3<f64>>,
    /// `(n,)`: how many modes each row has.
    counts: Py<PyArray1<u8>>,
    /// `(n,)`: 0 complete, 1 self-motion, 2 undecided, 3 for a row with an error.
    statuses: Py<PyArray1<u8>>,
    errors: Py<RowErrors>,
}

/// Why a row could not be asked; told in words only when somebody looks.
pub enum RowError {
    /// Inputs.
    Inputs(LockError),
    /// A pose.
    Pose(KinematicsError),
    /// A pose of HANA.
    Spatial(SpatialError),
    /// A pose of a three-legged robot.
    Tripod(TripodError),
}

/// The rows that could not be asked, ascending, each with its reason.
#[pyclass(frozen, module = "assur._assur")]
pub struct RowErrors {
    pub(crate) errors: Vec<(usize, RowError)>,
}

#[pymethods]
impl RowErrors {
    fn __len__(&self) -> usize {
        self.errors.len()
    }

    /// The rows, from 0, ascending.
    fn rows<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        PyArray1::from_iter(py, self.errors.iter().map(|(row, _)| *row as u64))
    }

    /// The exception that a row stands for; none for a row without.
    fn get<'py>(&self, py: Python<'py>, row: usize) -> PyResult<Option<Bound<'py, PyAny>>> {
        let found = self.errors.binary_search_by_key(&row, |(row, _)| *row).ok();
        let reason = |place: usize| match &self.errors[place].1 {
            RowError::Inputs(error) => Refused::input(error.clone()),
            RowError::Pose(error) => Refused::input(error.clone()),
            RowError::Spatial(error) => Refused::input(error.clone()),
            RowError::Tripod(error) => Refused::input(error.clone()),
        };
        found.map(|place| reason(place).exception(py)).transpose()
    }
}

fn code(status: Option<Status>) -> u8 {
    match status {
        Some(Status::Complete) => 0,
        Some(Status::SelfMotion) => 1,
        Some(Status::Undecided) => 2,
        None => 3,
    }
}

/// Solves the rows of a C-contiguous `(n, 3)` array into new arrays.
pub fn forward(py: Python<'_>, robot: &Manipulator, inputs: PyReadonlyArray2<'_, f64>) -> PyResult<Batch> {
    let rows = inputs.shape()[0];
    // numpy allocates, and raises MemoryError where it cannot.
    let zeros = |shape: Vec<usize>, kind: &str| py.import("numpy")?.call_method1("zeros", (shape, kind));
    let poses = zeros(vec![rows, MOST_MODES, 3], "f8")?.cast_into::<PyArray3<f64>>()?;
    let counts = zeros(vec![rows], "u1")?.cast_into::<PyArray1<u8>>()?;
    let statuses = zeros(vec![rows], "u1")?.cast_into::<PyArray1<u8>>()?;
    let mut errors = Vec::new();
    {
        let inputs = inputs.as_slice()?;
        let (mut poses, mut counts, mut statuses) = (poses.readwrite(), counts.readwrite(), statuses.readwrite());
        let mut poses = poses.as_slice_mut()?;
        let mut counts = counts.as_slice_mut()?;
        let mut statuses = statuses.as_slice_mut()?;
        let width = inputs.len() / rows.max(1);
        let mut found = vec![None; rows.min(ROWS_A_LOOK)];
        for first in (0..rows).step_by(ROWS_A_LOOK) {
            let some = ROWS_A_LOOK.min(rows - first);
            let inputs = &inputs[width * first..width * (first + some)];
            let ((here, later), (tally, rest), (codes, others)) =
                (poses.split_at_mut(3 * MOST_MODES * some), counts.split_at_mut(some), statuses.split_at_mut(some));
            let found = &mut found[..some];
            let refused = py.detach(|| {
                found.fill(None);
                let places = ModesPlaces { poses: here, counts: tally, statuses: found };
                let refused = robot.forward_batch_into(inputs, places);
                codes.iter_mut().zip(&*found).for_each(|(place, status)| *place = code(*status));
                refused
            });
            errors.extend(refused.into_iter().map(|(row, error)| (first + row, RowError::Inputs(error))));
            (poses, counts, statuses) = (later, rest, others);
            py.check_signals()?;
        }
    }
    let errors = Py::new(py, RowErrors { errors })?;
    Ok(Batch { poses: poses.unbind(), counts: counts.unbind(), statuses: statuses.unbind(), errors })
}
