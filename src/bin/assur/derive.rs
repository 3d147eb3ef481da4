//! The derivations, printed. Each is a program of its own as well; here they are only asked for their text.

use std::fmt::Write;

/// A derivation that can be printed.
struct Derivation {
    name: &'static str,
    /// What it shows, in one line.
    claim: &'static str,
    /// Its text, worked through.
    document: fn() -> String,
}

/// The derivations.
const DERIVATIONS: &[Derivation] = &[];

/// No derivation of this name.
#[derive(Debug, thiserror::Error)]
#[error("derivation \"{0}\": unknown; assur derive --list names them all")]
pub(crate) struct UnknownDerivation(String);

/// The text of a derivation.
pub(crate) fn document(name: &str) -> Result<String, UnknownDerivation> {
    let found = DERIVATIONS.iter().find(|derivation| derivation.name == name);
    found.map(|derivation| (derivation.document)()).ok_or_else(|| UnknownDerivation(name.to_owned()))
}

/// The names, one a line, with what each shows.
pub(crate) fn list() -> String {
    let mut text = String::new();
    for Derivation { name, claim, .. } in DERIVATIONS {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{name:<20} {claim}");
    }
    text
}
