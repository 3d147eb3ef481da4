//! Numeric homotopy for triads without PP legs: a baseline for the benches and a second opinion for the tests.
//!
//! It shares nothing with the library but the description of the triad. The unknowns are isotropic, `theta = e^(i phi)`, `tau = 1/theta`,
//! `z = x + iy`, `w = x - iy`, independent of each other over the complex numbers; in them every loop equation is bilinear
//! ([`rows`]). Two homotopies lead to its solutions:
//!
//! * [`total_degree`]: from roots of unity, in projective space; it knows nothing about triads and most of its paths run to infinity.
//! * [`family`]: from the solutions of one generic complex member of the same family of triads, one path for each solution that exists.
//!
//! Numerical only: a path may fail, or jump to another one. Both are counted ([`Outcome`]), not hidden.
//!
//! Sources: Sommese, Wampler, *The Numerical Solution of Systems of Polynomials* (2005), chapters 7 and 8; Telen, Van Barel,
//! Verschelde (2020), doi 10.1137/19M1288036, for the predictor by series and Padé approximants.

pub mod family;
pub mod linear;
pub mod rows;
pub mod total_degree;
pub mod track;

pub use family::Family;
pub use rows::Problem;
pub use total_degree::solve_by_total_degree;
pub use track::{Predictor, Settings};

use num_complex::Complex64;

/// A finite solution, in the lengths and frames of the triad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// `e^(i phi)`.
    pub theta: Complex64,
    /// `x + iy`.
    pub z: Complex64,
    /// `x - iy`.
    pub w: Complex64,
    /// Largest relative defect of the three equations.
    pub residual: f64,
}

/// What a homotopy found and what became of its paths.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// The different finite solutions.
    pub solutions: Vec<Solution>,
    /// Paths started.
    pub paths: usize,
    /// Paths that ran to infinity.
    pub at_infinity: usize,
    /// Paths that gave up.
    pub failed: usize,
    /// Paths that ended where another one had ended: one of the two jumped.
    pub jumped: usize,
    /// Paths tracked again, with care, because they had failed or jumped at first.
    pub repeated: usize,
    /// Steps taken on all paths, refused ones included.
    pub steps: usize,
}
