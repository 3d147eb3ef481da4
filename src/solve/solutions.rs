//! Where every root went.

use num_complex::Complex64;
use thiserror::Error;

use super::eliminant::Outcome;

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

/// All solutions of a system, with the account that shows the list complete.
#[derive(Clone, Debug, PartialEq)]
pub struct Solutions {
    /// The names of the variables, in the order of [`Solution::values`].
    pub variables: Vec<String>,
    /// The solutions, real and complex, ordered by the real, then the imaginary part of the variable that was left.
    pub solutions: Vec<Solution>,
    /// The roots of the eliminant that carry no solution.
    pub rejected: Vec<RejectedRoot>,
    /// How the elimination ended.
    pub outcome: Outcome,
    /// Where every root went; adds up to the eliminant's degree bound.
    pub account: Account,
}

/// One solution of a system.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The value of each variable.
    pub values: Vec<Complex64>,
    /// Largest value of an equation over the sum of the sizes of its terms.
    pub residual: f64,
    /// How many solutions meet here.
    pub multiplicity: usize,
    /// Whether every value is real; imaginary parts are then exactly zero. Decided numerically.
    pub real: bool,
}

/// A root of the eliminant above which no solution was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RejectedRoot {
    /// The value of the variable that was left.
    pub root: Complex64,
    /// How much of its multiplicity carries no solution.
    pub multiplicity: usize,
    /// Why.
    pub reason: RootRejection,
}

/// Why a root of an eliminant carries no solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum RootRejection {
    /// No values of the other variables satisfy every equation: the root is extraneous, or its solution lies at infinity.
    #[error("no finite solution lies above this root")]
    NothingAbove,
    /// The solutions above it are simple and fewer than the root's multiplicity.
    #[error("the root is counted more often than there are solutions above it")]
    ExtraMultiplicity,
    /// A variable is left free above the root: a curve of solutions may lie there.
    #[error("a variable stays free above this root")]
    FreeVariable,
    /// Several singular solutions share the multiplicity in a way that was not resolved.
    #[error("the multiplicity is shared among singular solutions in an unknown way")]
    SharedMultiplicity,
}

impl Solutions {
    /// The real solutions.
    pub fn real(&self) -> impl Iterator<Item = &Solution> {
        self.solutions.iter().filter(|solution| solution.real)
    }

    /// The largest residual; zero for an empty list.
    pub fn worst_residual(&self) -> f64 {
        self.solutions.iter().map(|solution| solution.residual).fold(0.0, f64::max)
    }
}
