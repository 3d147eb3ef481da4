//! The derivations, printed. Each is a program of its own as well; here they are only asked for their text.

use std::fmt::Write;

/// The derivations: name, what it shows, its text worked through.
const DERIVATIONS: &[(&str, &str, fn() -> String)] = &[];

/// No derivation of this name.
#[derive(Debug, thiserror::Error)]
#[error("derivation \"{0}\": unknown; assur derive --list names them all")]
pub(crate) struct UnknownDerivation(String);

/// The text of a derivation.
pub(crate) fn document(name: &str) -> Result<String, UnknownDerivation> {
    let found = DERIVATIONS.iter().find(|(known, _, _)| *known == name);
    found.map(|(_, _, document)| document()).ok_or_else(|| UnknownDerivation(name.to_owned()))
}

/// The names, one a line, with what each shows.
pub(crate) fn list() -> String {
    let mut text = String::new();
    for (name, claim, _) in DERIVATIONS {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{name:<20} {claim}");
    }
    text
}
