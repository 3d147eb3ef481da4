//! `hana` and `tripod`: the two spatial robots. What both need.

mod hana;
mod tilt;
mod tripod;

use std::path::Path;

use assur::SpatialError;

pub(crate) use hana::{HanaCommand, hana};
pub(crate) use tripod::{TripodCommand, tripod};

use crate::output::Failure;
use crate::tables::{SIDE_DIGITS, digits, heading};

/// Progress bars of maps, by rows.
const ROWS: &str = "{wide_bar} {pos} of {len} rows, {eta} left";

fn about(file: &Path, error: impl std::fmt::Display) -> Failure {
    Failure::About(file.display().to_string(), error.to_string())
}

fn exactly<const N: usize>(what: &'static str, values: &[f64], file: &Path) -> Result<[f64; N], Failure> {
    let found = values.len();
    let numbers = values.try_into().map_err(|_| about(file, SpatialError::WrongCount { what, expected: N, found }))?;
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(about(file, SpatialError::NotFinite { what: what.to_owned(), value })),
        None => Ok(numbers),
    }
}

fn optional<const N: usize>(what: &'static str, values: &[f64], file: &Path) -> Result<Option<[f64; N]>, Failure> {
    (!values.is_empty()).then(|| exactly(what, values, file)).transpose()
}

fn numbers(values: &[f64]) -> String {
    values.iter().map(|value| digits(*value, SIDE_DIGITS)).collect::<Vec<_>>().join(", ")
}

fn titled(name: &str, otherwise: &str) -> String {
    let mut text = String::new();
    heading(&mut text, if name.is_empty() { otherwise } else { name });
    text
}
