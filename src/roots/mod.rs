//! The roots of a polynomial in one variable.
//!
//! All complex ones come from the eigenvalues of a balanced companion matrix ([`companion_roots`]), checked and polished.

mod companion;

pub use companion::{PolynomialRoots, RootsError, companion_roots, companion_roots_real};
