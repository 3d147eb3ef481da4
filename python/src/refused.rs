//! Errors of the library as exceptions of the package: the same message, with file, row, leg, joint, field and value beside it.

use std::fmt::Display;

use assur::exchange::{ErrorPlace, FoundValue};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Which exception a refusal becomes.
#[derive(Clone, Copy)]
enum Kind {
    Model,
    Input,
}

impl Kind {
    /// The name of the class in `assur.errors`.
    fn class(self) -> &'static str {
        match self {
            Self::Model => "ModelError",
            Self::Input => "InputError",
        }
    }
}

/// A question that cannot be asked, or a file that holds none.
pub struct Refused {
    kind: Kind,
    message: String,
    // Boxed, so that answers which are none do not make room for it.
    place: Box<ErrorPlace>,
}

impl Refused {
    /// A file or description that is not sound.
    pub fn model<E: Display>(error: E) -> Self
    where
        for<'a> ErrorPlace: From<&'a E>,
    {
        Self { kind: Kind::Model, message: error.to_string(), place: Box::new(ErrorPlace::from(&error)) }
    }

    /// A question that cannot be asked of a sound model.
    pub fn input<E: Display>(error: E) -> Self
    where
        for<'a> ErrorPlace: From<&'a E>,
    {
        Self { kind: Kind::Input, message: error.to_string(), place: Box::new(ErrorPlace::from(&error)) }
    }

    /// The exception, not raised.
    pub fn exception<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let place = PyDict::new(py);
        place.set_item("file", &self.place.file)?;
        place.set_item("row", self.place.row)?;
        place.set_item("leg", self.place.leg)?;
        place.set_item("joint", self.place.joint)?;
        place.set_item("field", &self.place.field)?;
        match &self.place.value {
            None => {}
            Some(FoundValue::Number(value)) => place.set_item("value", value)?,
            Some(FoundValue::Range(range)) => place.set_item("value", (range[0], range[1]))?,
            Some(FoundValue::Count(count)) => place.set_item("value", count)?,
            Some(FoundValue::Text(text)) => place.set_item("value", text)?,
        }
        py.import("assur.errors")?.getattr(self.kind.class())?.call((&self.message,), Some(&place))
    }
}

impl From<Refused> for PyErr {
    fn from(refused: Refused) -> Self {
        Python::attach(|py| refused.exception(py).map_or_else(|broken| broken, PyErr::from_value))
    }
}
