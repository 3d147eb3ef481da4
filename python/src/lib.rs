//! `assur._assur`: the library as Python sees it, kept thin. A call parses, releases the interpreter lock, asks one question, and hands over the report the command line
//! prints, as an [`answer::Answer`]; only batches travel as arrays. What Python users see is written in Python, beside this, in `assur/`.

mod answer;
mod batch;
mod model;
mod poses;
mod problems;
mod refused;
mod spatial;
mod spatial_batch;
mod workspace;

use pyo3::prelude::*;

/// The library behind the package; use `assur` itself.
#[pymodule(gil_used = false)]
mod _assur {
    #[pymodule_export]
    use crate::answer::Answer;
    #[pymodule_export]
    use crate::batch::{Batch, RowErrors};
    #[pymodule_export]
    use crate::model::Model;
    #[pymodule_export]
    use crate::poses::{MotionBatch, WaysBatch};
    #[pymodule_export]
    use crate::problems::{coupler, coupler_polygons, group, triad};
    #[pymodule_export]
    use crate::spatial::{HanaModel, MultipteronModel, TripodModel, determinant};
    #[pymodule_export]
    use crate::spatial_batch::SpatialBatch;
    #[pymodule_export]
    use crate::workspace::Shape;

    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
