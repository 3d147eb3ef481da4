//! An answer on its way to Python: its report as text, and its drawing when somebody looks.

use pyo3::prelude::*;

/// A report, as `--json` prints it, and what draws it.
#[pyclass(frozen, module = "assur._assur")]
pub struct Answer {
    json: String,
    draw: Option<Box<dyn Fn() -> String + Send + Sync>>,
}

impl Answer {
    /// An answer with a drawing, drawn at most when asked for.
    pub fn drawn(json: String, draw: impl Fn() -> String + Send + Sync + 'static) -> Self {
        Self { json, draw: Some(Box::new(draw)) }
    }

    /// An answer that no drawing shows.
    pub fn plain(json: String) -> Self {
        Self { json, draw: None }
    }
}

#[pymethods]
impl Answer {
    /// The report as a JSON document.
    #[getter]
    fn json(&self) -> &str {
        &self.json
    }

    /// The drawing as an SVG document; none where no drawing shows this.
    fn svg(&self, py: Python<'_>) -> Option<String> {
        self.draw.as_ref().map(|draw| py.detach(draw))
    }
}
