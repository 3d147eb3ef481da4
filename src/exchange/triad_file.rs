//! Triad problem files.

use std::path::Path;

use nalgebra::Vector2;
use serde::Serialize;

use super::error::FileError;
use super::model::read_text;
use super::reader::Field;
use super::tree::Tree;
use crate::linkage::{Dyad, Offset, Triad};

/// What a triad file calls itself.
const SCHEMA: &str = "assur/triad/1";

/// Reads a triad problem file, JSON or TOML by its ending; `-` is standard input. Angles are radians.
///
/// # Errors
/// One line that names file, leg, field and value.
pub fn read_triad(path: &Path) -> Result<Triad, FileError> {
    TriadFile::parse(&read_text(path)?, &path.display().to_string())
}

/// A triad as a problem file holds it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TriadFile {
    schema: &'static str,
    /// The legs.
    pub legs: Vec<DyadEntry>,
}

/// A dyad as a problem file holds it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "type")]
pub enum DyadEntry {
    /// `|X + R b - a| = l`.
    RR {
        /// Base pivot.
        a: [f64; 2],
        /// Platform pivot.
        b: [f64; 2],
        /// Distance.
        l: f64,
    },
    /// `X + R b` on the line `a + t u`.
    PR {
        /// A point of the line.
        a: [f64; 2],
        /// Its direction.
        u: [f64; 2],
        /// Platform pivot.
        b: [f64; 2],
    },
    /// `(R i v/|v|)·(a - X - R b) = d`.
    RP {
        /// Base pivot.
        a: [f64; 2],
        /// A point of the platform line.
        b: [f64; 2],
        /// Its direction.
        v: [f64; 2],
        /// How far `a` lies to the left of it.
        d: f64,
        /// `d·|v|` where that is the number given; it overrides `d` when read.
        #[serde(skip_serializing_if = "Option::is_none")]
        delta: Option<f64>,
    },
    /// The orientation is given.
    PP {
        /// In radians.
        phi: f64,
    },
}

impl TriadFile {
    /// The triad in a text; `file` is what errors call it, and its ending says what it is.
    ///
    /// # Errors
    /// As [`read_triad`].
    ///
    /// ```
    /// use assur::exchange::TriadFile;
    /// let leg = r#"{"type":"RR","a":[0,0],"b":[1,0],"l":-2}"#;
    /// let text = format!(r#"{{"schema":"assur/triad/1","legs":[{leg},{leg},{leg}]}}"#);
    /// let error = TriadFile::parse(&text, "t.json").unwrap_err();
    /// assert_eq!(error.to_string(), "t.json: leg 1: length -2 must be ≥ 0");
    /// ```
    pub fn parse(text: &str, file: &str) -> Result<Triad, FileError> {
        let tree = Tree::parse(text, file)?;
        Field::root(&tree, file).expect_kind(SCHEMA)?;
        let root = Field::root(&tree, file).table(&["schema", "name", "legs"])?;
        root.need("schema", &format!("\"{SCHEMA}\""))?.one_of(&[SCHEMA])?;
        let legs = root.need("legs", "a list of three legs")?;
        legs.array::<3>("three legs")?;
        let legs = legs.legs()?.iter().map(read_dyad).collect::<Result<Vec<_>, _>>()?;
        let legs: [Dyad; 3] = legs.try_into().expect("the list of legs has been counted: three");
        Triad::new(legs).map_err(|error| FileError::Triad { file: file.to_owned(), error })
    }
}

fn read_dyad(field: &Field) -> Result<Dyad, FileError> {
    let every_key = ["type", "a", "b", "l", "u", "v", "d", "delta", "phi"];
    let kind = field.table(&every_key)?.need("type", "RR, PR, RP or PP")?.one_of(&["RR", "PR", "RP", "PP"])?;
    let known: &[&str] = match kind {
        "RR" => &["type", "a", "b", "l"],
        "PR" => &["type", "a", "u", "b"],
        "RP" => &["type", "a", "b", "v", "d", "delta"],
        _ => &["type", "phi"],
    };
    let table = field.table(known)?;
    let point = |key| -> Result<Vector2<f64>, FileError> { table.need(key, "two numbers")?.vector() };
    let number = |key| -> Result<f64, FileError> { table.need(key, "a number")?.number() };
    Ok(match kind {
        "RR" => Dyad::RR { a: point("a")?, b: point("b")?, length: number("l")? },
        "PR" => Dyad::PR { a: point("a")?, u: point("u")?, b: point("b")? },
        "RP" => {
            let delta = table.get("delta").map(|delta| delta.number()).transpose()?;
            // `d` is checked even where `delta` overrides it.
            let distance = match table.get("d") {
                None if delta.is_some() => 0.0,
                _ => number("d")?,
            };
            let offset = delta.map_or(Offset::Distance(distance), Offset::TimesDirection);
            Dyad::RP { a: point("a")?, b: point("b")?, v: point("v")?, offset }
        }
        _ => Dyad::PP { phi: number("phi")? },
    })
}

impl From<&Triad> for TriadFile {
    fn from(triad: &Triad) -> Self {
        Self { schema: SCHEMA, legs: triad.legs().iter().map(DyadEntry::from).collect() }
    }
}

impl From<&Dyad> for DyadEntry {
    fn from(dyad: &Dyad) -> Self {
        let array = |p: &Vector2<f64>| [p.x, p.y];
        match dyad {
            Dyad::RR { a, b, length } => Self::RR { a: array(a), b: array(b), l: *length },
            Dyad::PR { a, u, b } => Self::PR { a: array(a), u: array(u), b: array(b) },
            Dyad::RP { a, b, v, offset } => {
                let (d, delta) = match *offset {
                    Offset::Distance(d) => (d, None),
                    Offset::TimesDirection(delta) => (delta / v.norm(), Some(delta)),
                };
                Self::RP { a: array(a), b: array(b), v: array(v), d, delta }
            }
            Dyad::PP { phi } => Self::PP { phi: *phi },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        let v = Vector2::new(3.0, 4.5);
        let legs = [
            Dyad::RP { a: Vector2::x(), b: Vector2::y(), v, offset: Offset::TimesDirection(0.3) },
            Dyad::RP { a: Vector2::x(), b: Vector2::y(), v, offset: Offset::Distance(-0.7) },
            Dyad::PR { a: Vector2::new(1e-3, 7.0), u: v, b: Vector2::new(-2.0, 1.0 / 3.0) },
        ];
        let triad = Triad::new(legs).expect("is sound");
        let text = serde_json::to_string(&TriadFile::from(&triad)).expect("plain data");
        assert_eq!(TriadFile::parse(&text, "t.json"), Ok(triad));
    }
}
