//! What a proof of completeness came to, in one line.

use std::fmt;

use super::assemblies::{Assemblies, Status};
use super::group::{Pose, Triad};
use super::pinned::PinnedDyad;
use crate::certify::Verdict;
use crate::solve::Account;

/// What a proof is about: a group whose numbers are exactly these `f64`s. Where it was locked out of a mechanism, sines and cosines were
/// rounded once, on locking, and are data from there on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProofSubject {
    /// Three dyads.
    Triad(Triad),
    /// A platform pinned at a point, and one dyad.
    Pinned(PinnedDyad),
    /// A platform placed by one locked leg: the pose is the data.
    Placed(Pose),
}

impl fmt::Display for ProofSubject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Triad(_) => "the locked triad whose numbers are exactly the f64s printed; sines and cosines were rounded once, on locking",
            Self::Pinned(_) => {
                "the pinned platform and its leg, whose numbers are exactly the f64s printed; sines and cosines were rounded once, on locking"
            }
            Self::Placed(_) => "the pose in which one locked leg holds the platform, rounded on locking",
        })
    }
}

/// What is proved of an answer as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// What the proof is about.
    pub subject: ProofSubject,
    /// Where every root went; exact.
    pub account: Account,
    /// How many different real poses there are beside the self-motions.
    pub modes: usize,
    /// Whether nothing was left undecided: every mode proved, and no other exists.
    pub complete: bool,
    /// How many modes lie so close to another that boxes of `f64`s cannot tell them apart; they are proved all the same, by exact isolation.
    pub indistinct: usize,
    /// In how many ways legs without an actuator can stand in each pose, at most; 1 without such legs. In which of them they do is measured, not proved.
    pub free_ways: usize,
    /// Whether an RP leg's `d·|v|` is no `f64`: it was rounded for the count, and the boxes of simple modes hold for both.
    pub rounded_offset: bool,
}

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Account { degree, real, complex, at_infinity, rejected, self_motion, undecided } = self.account;
        write!(f, "{} of degree {degree}: {real} real proved, {complex} non-real proved", degree - undecided)?;
        for (count, what) in [
            (at_infinity, "at infinity"),
            (rejected, "without a pose"),
            (self_motion, "in a self-motion"),
            (undecided, "undecided"),
        ] {
            if count > 0 {
                write!(f, ", {count} {what}")?;
            }
        }
        write!(f, ", {}", if self.complete { "complete" } else { "not complete" })?;
        if self.free_ways > 1 {
            write!(f, "; each pose in up to {} ways of free legs, measured", self.free_ways)?;
        }
        Ok(())
    }
}

impl Assemblies {
    /// Adds the certificate to modes that carry their verdicts.
    pub(super) fn conclude(&mut self, subject: ProofSubject, indistinct: usize, rounded_offset: bool) {
        let proved = self.modes.iter().all(|mode| mode.proof == Verdict::Proven);
        let complete = proved && self.status != Status::Undecided && self.account.undecided == 0;
        self.certificate = Some(Certificate {
            subject,
            account: self.account,
            modes: self.modes.len(),
            complete,
            indistinct,
            free_ways: 1,
            rounded_offset,
        });
    }

    /// The certificate of a pose that is itself the data: a platform placed by one locked leg.
    pub(crate) fn certify_given(&mut self, pose: Pose) {
        for mode in &mut self.modes {
            mode.proof = Verdict::Proven;
            mode.pose_box = Some([pose.x, pose.y, pose.phi].map(|value| [value; 2]));
        }
        self.conclude(ProofSubject::Placed(pose), 0, false);
    }
}
