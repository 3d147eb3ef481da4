//! Rows of inputs in, rows of modes out: files of any length.
//!
//! A file is cut into [`InputBlock`]s of some ten thousand rows ([`InputBlocks`]); each is read, solved and written on its own ([`SolvedBlock`]), so that memory stays
//! flat, threads share the work, and a run can be taken up again where it was stopped. [`BatchWriter`] puts written blocks together.

mod block;
mod join;
mod solved;

pub use block::{BatchFileError, InputBlock, InputBlocks};
pub use join::{BatchWriteError, BatchWriter};
pub use solved::{Reject, SolvedBlock};

use std::path::Path;

/// The form of a file of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RowFormat {
    /// Comma-separated values with a header.
    Csv,
    /// One JSON object a line.
    JsonLines,
    /// Apache Parquet; only written.
    Parquet,
}

impl RowFormat {
    /// The form that a file's ending stands for: `csv`, `jsonl` or `ndjson`, `parquet`.
    ///
    /// ```
    /// use assur::exchange::RowFormat;
    /// assert_eq!(RowFormat::of_path("modes.parquet".as_ref()), Some(RowFormat::Parquet));
    /// assert_eq!(RowFormat::of_path("modes.txt".as_ref()), None);
    /// ```
    pub fn of_path(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()? {
            "csv" => Some(Self::Csv),
            "jsonl" | "ndjson" => Some(Self::JsonLines),
            "parquet" => Some(Self::Parquet),
            _ => None,
        }
    }
}
