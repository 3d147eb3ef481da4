//! Where every root went.

/// Counts of solutions, with multiplicity, that add up to the degree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Account {
    /// How many solutions there can be: the degree.
    pub degree: usize,
    /// Real solutions.
    pub real: usize,
    /// Solutions that are not real, partners included.
    pub complex: usize,
    /// Roots that ran to infinity: leading and trailing coefficients that vanish.
    pub at_infinity: usize,
    /// Roots of the eliminant that carry no finite solution.
    pub rejected: usize,
    /// Multiplicity of roots above which a whole curve of solutions lies.
    pub self_motion: usize,
    /// Roots nobody could decide about within the stated limits.
    pub undecided: usize,
}

impl Account {
    /// Whether the parts add up to the degree.
    ///
    /// ```
    /// use assur::solve::Account;
    /// let account = Account { degree: 6, real: 4, complex: 2, ..Account::default() };
    /// assert!(account.adds_up());
    /// ```
    pub fn adds_up(&self) -> bool {
        self.degree == self.real + self.complex + self.at_infinity + self.rejected + self.self_motion + self.undecided
    }
}
