//! What a proof of completeness came to, in one line.

use std::fmt;

use super::assemblies::{Assemblies, Status};
use crate::certify::Verdict;
use crate::solve::Account;

/// What is proved of an answer as a whole.
///
/// All of it is proved of the mechanism whose numbers are exactly the `f64`s given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// Where every root went; exact.
    pub account: Account,
    /// How many different real poses there are beside the self-motions.
    pub modes: usize,
    /// Whether nothing was left undecided: every mode proved, and no other exists.
    pub complete: bool,
    /// How many modes lie so close to another that boxes of `f64`s cannot tell them apart; they are proved all the same, by exact isolation.
    pub indistinct: usize,
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
        write!(f, ", {}", if self.complete { "complete" } else { "not complete" })
    }
}

impl Assemblies {
    /// Adds the certificate to modes that carry their verdicts.
    pub(super) fn conclude(&mut self, indistinct: usize, rounded_offset: bool) {
        let proved = self.modes.iter().all(|mode| mode.proof == Verdict::Proven);
        let complete = proved && self.status != Status::Undecided && self.account.undecided == 0;
        let modes = self.modes.len();
        self.certificate = Some(Certificate { account: self.account, modes, complete, indistinct, rounded_offset });
    }

    /// The certificate of a pose that is itself the data: a platform placed by one locked leg.
    pub(crate) fn certify_given(&mut self) {
        for mode in &mut self.modes {
            let pose = mode.pose;
            mode.proof = Verdict::Proven;
            mode.pose_box = Some([pose.x, pose.y, pose.phi].map(|value| [value; 2]));
        }
        self.conclude(0, false);
    }
}
