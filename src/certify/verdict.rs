//! Three answers, not two.

/// What a proof attempt came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Verdict {
    /// Nobody asked for a proof.
    #[default]
    NotAsked,
    /// The claim is a theorem about the numbers given.
    Proven,
    /// The opposite of the claim is a theorem about the numbers given.
    Refuted,
    /// Neither was reached within the stated limits.
    Undecided,
}
