//! What can be wrong with a file, in one line that says where.

use std::fmt;

use thiserror::Error;

use crate::linkage::{CouplerError, LinkageError, TriadError, TrussError};
use crate::manipulator::DescriptionError;
use crate::spatial::{MultipteronError, TripodError};

/// The two forms of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// TOML.
    Toml,
    /// JSON.
    Json,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Toml => "TOML",
            Self::Json => "JSON",
        })
    }
}

/// Why a file holds no model or problem. Prints as one line.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FileError {
    /// The file cannot be opened or is not text.
    #[error("{file}: cannot be read: {reason}")]
    Unreadable {
        /// The file.
        file: String,
        /// What the system says.
        reason: String,
    },
    /// The text is no TOML or no JSON.
    #[error("{file}:{line}:{column}: not valid {format}: {message}")]
    Syntax {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What it was read as.
        format: Format,
        /// What the parser says.
        message: String,
    },
    /// A field is missing, unknown, or holds something else than it should.
    #[error("{file}: {place}: {problem}")]
    Field {
        /// The file.
        file: String,
        /// Leg and field: `leg 2: links[0].at`.
        place: String,
        /// What is wrong.
        problem: FieldProblem,
    },
    /// The fields make no manipulator.
    #[error("{file}: {error}")]
    Description {
        /// The file.
        file: String,
        /// What is wrong.
        error: DescriptionError,
    },
    /// The fields make no linkage that can be taken apart.
    #[error("{file}: {error}")]
    Linkage {
        /// The file.
        file: String,
        /// What is wrong.
        error: LinkageError,
    },
    /// The fields make no coupler curve.
    #[error("{file}: {error}")]
    Coupler {
        /// The file.
        file: String,
        /// What is wrong.
        error: CouplerError,
    },
    /// The fields make no Assur group.
    #[error("{file}: {error}")]
    Truss {
        /// The file.
        file: String,
        /// What is wrong.
        error: TrussError,
    },
    /// The fields make no spatial robot.
    #[error("{file}: {error}")]
    Spatial {
        /// The file.
        file: String,
        /// What is wrong.
        error: TripodError,
    },
    /// The fields make no Multipteron.
    #[error("{file}: {error}")]
    Multipteron {
        /// The file.
        file: String,
        /// What is wrong.
        error: MultipteronError,
    },
    /// The fields make no triad.
    #[error("{file}: {error}")]
    Triad {
        /// The file.
        file: String,
        /// What is wrong.
        error: TriadError,
    },
}

/// What is wrong with a field.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FieldProblem {
    /// It is not there.
    #[error("missing; must be {expected}")]
    Missing {
        /// What belongs there.
        expected: String,
    },
    /// Nothing of this name belongs here.
    #[error("unknown key{}", hint(.nearest))]
    UnknownKey {
        /// The nearest known key.
        nearest: Option<String>,
    },
    /// A value of another kind.
    #[error("{found} must be {expected}")]
    Kind {
        /// What belongs there.
        expected: String,
        /// The value found.
        found: String,
    },
    /// An array of another length.
    #[error("{found} must be {expected}, has {count}")]
    Length {
        /// What belongs there.
        expected: String,
        /// The value found.
        found: String,
        /// Its length.
        count: usize,
    },
    /// NaN or infinite.
    #[error("{value} must be finite")]
    NotFinite {
        /// The value found.
        value: f64,
    },
    /// A text that is none of the known ones.
    #[error("\"{found}\" must be one of {}{}", quoted(.known), hint(.nearest))]
    UnknownText {
        /// The text found.
        found: String,
        /// The texts that are known.
        known: Vec<String>,
        /// The nearest of them.
        nearest: Option<String>,
    },
    /// A file of another kind.
    #[error("\"{found}\" is a file for `assur {command}`; must be \"{expected}\"")]
    OtherKind {
        /// What the file calls itself.
        found: String,
        /// The command that takes it.
        command: &'static str,
        /// What it must call itself here.
        expected: &'static str,
    },
    /// Two fields that say the same thing.
    #[error("given both as {first} and as {second}, must be one of them")]
    Both {
        /// One field.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// The same key twice.
    #[error("given twice")]
    Twice,
    /// `limits` as one range on a leg where several joints or none could be meant.
    #[error("{found} must be a table by joint number, as in {{ 1 = [a, b] }}: the leg has {actuated} actuated joints")]
    WhichJoint {
        /// The value found.
        found: String,
        /// How many joints of the leg are actuated.
        actuated: usize,
    },
    /// A range for a joint that belongs into the other field.
    #[error("joint {joint} is {role}; its range belongs in {belongs}")]
    OtherField {
        /// Joint, from 1.
        joint: usize,
        /// `actuated` or `passive`.
        role: &'static str,
        /// The field it belongs in.
        belongs: &'static str,
    },
}

fn hint(nearest: &Option<String>) -> String {
    nearest.as_ref().map(|name| format!("; did you mean \"{name}\"?")).unwrap_or_default()
}

fn quoted(known: &[String]) -> String {
    known.iter().map(|text| format!("\"{text}\"")).collect::<Vec<_>>().join(", ")
}

/// The candidate that takes the fewest edits, if those are at most a third of its letters (and one at least).
pub(super) fn nearest<'a>(text: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let scored = candidates.into_iter().map(|candidate| (edits(text, candidate), candidate));
    let (distance, candidate) = scored.min_by_key(|(distance, _)| *distance)?;
    (distance <= (candidate.chars().count() / 3).max(1)).then(|| candidate.to_owned())
}

/// Levenshtein's distance: insertions, deletions and replacements that turn one text into the other.
fn edits(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, letter) in from.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for j in 0..to.len() {
            let replaced = diagonal + usize::from(letter != to[j]);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_suggested_when_it_is_near() {
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(nearest("plattform", ["base", "platform"]).as_deref(), Some("platform"));
        assert_eq!(nearest("colour", ["base", "platform"]), None);
    }
}
