//! Eliminating a variable from two polynomials, exactly.
//!
//! Two polynomials share a root in a variable where the determinant of their [`SylvesterMatrix`] vanishes. The determinant is
//! taken by one of three algorithms that must agree: [`determinant_bareiss`], [`determinant_interpolated`] and, for tests and tiny
//! sizes, [`determinant_expanded`]; [`resultant`] chooses. What a product of resultants brings in beside the answer is an
//! extraneous factor; a [`NamedFactor`] goes by exact division and by name, never silently. Where a polynomial would lose its digits, a
//! [`DixonPencil`] leaves matrices that are linear in the last unknown, for a generalised eigenproblem.

mod determinant;
mod dixon;
mod factor;
mod resultant;
mod sylvester;

pub use determinant::{determinant_bareiss, determinant_degree_bound, determinant_expanded, determinant_interpolated};
pub use dixon::{DixonPencil, DixonShapeError, RealDixonPencil};
pub use factor::{FactorError, NamedFactor, Power, RemovedFactor};
pub use resultant::{resultant, resultant_bareiss, resultant_formal, resultant_interpolated};
pub use sylvester::{FormalDegreeTooLow, SylvesterMatrix};
