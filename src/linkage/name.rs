//! Groups by name.
//!
//! A triad is named by its three dyads, in any order and either case: `RR-RP-PR`. One printed name has lost a letter: `RP-RRP`, from
//! the title of a paper on the RP-RP-RP group, has five joints, and no group has. It is read as RP-RP-RP, with a note.

use thiserror::Error;

/// The passive joints of a dyad, base first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DyadKind {
    /// Two revolute joints.
    RR,
    /// A slider on the base, a pivot on the platform.
    PR,
    /// A pivot on the base, a slider on the platform.
    RP,
    /// Two sliders.
    PP,
}

/// A triad by the kinds of its dyads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GroupName {
    /// The dyads, in the order RR, PR, RP, PP that the catalogue of triads uses.
    pub dyads: [DyadKind; 3],
    /// What to tell about a name that was not taken literally.
    pub note: Option<String>,
    /// Other groups the name may have meant.
    pub other_readings: Vec<[DyadKind; 3]>,
}

/// Why a name names no triad.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum GroupNameError {
    /// A part is none of the four dyads.
    #[error("group `{name}`: `{part}` is no dyad; a triad is three of RR, PR, RP, PP, such as RR-RP-PR")]
    UnknownDyad {
        /// The name given.
        name: String,
        /// The part not understood.
        part: String,
    },
    /// Not three parts.
    #[error("group `{name}`: {found} dyads, a triad has three, such as RR-RP-PR")]
    WrongCount {
        /// The name given.
        name: String,
        /// How many parts it has.
        found: usize,
    },
}

impl GroupName {
    /// Reads a name.
    ///
    /// # Errors
    /// A part that is no dyad, or not three of them.
    ///
    /// ```
    /// use assur::linkage::GroupName;
    /// assert_eq!(GroupName::parse("rp-RR-PR")?.to_string(), "RR-PR-RP");
    /// let printed = GroupName::parse("RP-RRP")?;
    /// assert_eq!(printed.to_string(), "RP-RP-RP");
    /// assert!(printed.note.unwrap().contains("RP-RR-RP and RP-RR-RR"));
    /// assert!(GroupName::parse("RR-RR").is_err());
    /// # Ok::<(), assur::linkage::GroupNameError>(())
    /// ```
    pub fn parse(name: &str) -> Result<Self, GroupNameError> {
        use DyadKind::{RP, RR};
        let upper = name.trim().to_ascii_uppercase();
        if upper == "RP-RRP" {
            let note = "RP-RRP has five joints and is no group: read as RP-RP-RP, the group its paper solves; \
                        the other readings are RP-RR-RP and RP-RR-RR";
            return Ok(Self {
                dyads: [RP; 3],
                note: Some(note.to_string()),
                other_readings: vec![[RR, RP, RP], [RR, RR, RP]],
            });
        }
        let parts: Vec<&str> = upper.split('-').map(str::trim).collect();
        let kinds =
            parts.iter().map(|part| DyadKind::parse(part).ok_or(*part)).collect::<Result<Vec<DyadKind>, &str>>();
        let kinds =
            kinds.map_err(|part| GroupNameError::UnknownDyad { name: name.to_string(), part: part.to_string() })?;
        let found = kinds.len();
        let mut dyads: [DyadKind; 3] =
            kinds.try_into().map_err(|_| GroupNameError::WrongCount { name: name.to_string(), found })?;
        dyads.sort();
        Ok(Self { dyads, note: None, other_readings: Vec::new() })
    }

    /// All twenty triads of the four dyads.
    ///
    /// ```
    /// assert_eq!(assur::linkage::GroupName::all().len(), 20);
    /// ```
    pub fn all() -> Vec<Self> {
        let kinds = DyadKind::ALL;
        let triples =
            (0..4).flat_map(|i| (i..4).flat_map(move |j| (j..4).map(move |k| [kinds[i], kinds[j], kinds[k]])));
        triples.map(|dyads| Self { dyads, note: None, other_readings: Vec::new() }).collect()
    }
}

impl std::fmt::Display for GroupName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.dyads.map(DyadKind::name).join("-"))
    }
}

impl DyadKind {
    /// The four kinds, in the order of the catalogue.
    pub const ALL: [Self; 4] = [Self::RR, Self::PR, Self::RP, Self::PP];

    /// `RR`, `PR`, `RP` or `PP`.
    pub fn name(self) -> &'static str {
        match self {
            Self::RR => "RR",
            Self::PR => "PR",
            Self::RP => "RP",
            Self::PP => "PP",
        }
    }

    fn parse(part: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == part)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_order_of_every_triad_is_read() {
        for group in GroupName::all() {
            let [a, b, c] = group.dyads.map(DyadKind::name);
            for order in [[a, b, c], [a, c, b], [b, a, c], [b, c, a], [c, a, b], [c, b, a]] {
                assert_eq!(GroupName::parse(&order.join("-")), Ok(group.clone()));
            }
        }
    }

    #[test]
    fn the_printed_name_is_read_with_a_note() {
        let read = GroupName::parse(" rp-rrp ").unwrap();
        assert_eq!(read.dyads, [DyadKind::RP; 3]);
        assert_eq!(read.other_readings.len(), 2);
        assert!(read.note.is_some() && GroupName::parse("RP-RP-RP").unwrap().note.is_none());
    }

    #[test]
    fn other_names_are_errors_that_say_what_is_wrong() {
        let message = |name: &str| GroupName::parse(name).unwrap_err().to_string();
        assert_eq!(
            message("RR-RQ-PR"),
            "group `RR-RQ-PR`: `RQ` is no dyad; a triad is three of RR, PR, RP, PP, such as RR-RP-PR"
        );
        assert_eq!(message("RR-RR"), "group `RR-RR`: 2 dyads, a triad has three, such as RR-RP-PR");
        assert!(message("").contains("no dyad"));
        assert!(message("RR-RR-RR-RR").contains("4 dyads"));
        assert!(message("RRP-RP").contains("`RRP`"));
    }
}
