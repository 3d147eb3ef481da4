//! From a polynomial to its roots: how many are real, exactly, and where all of them lie, to any number of digits.
//!
//! Rough complex roots come from the eigenvalues of a balanced companion matrix ([`companion_roots`]); for polynomials with exact
//! coefficients they are polished to any number of bits ([`polish_roots`]) and the real ones are counted ([`isolate_real_roots`]).
//! Where a polynomial would lose its digits, a matrix pencil keeps them ([`pencil_eigenpairs`], and faster [`real_pencil_eigenpairs`]).

mod circle;
mod companion;
mod isolate;
mod locate;
mod pencil;
mod polish;
mod real_pencil;
mod wide;

pub use circle::{CountedRoots, Harmonics};
pub(crate) use circle::{HarmonicBlock, RootColumns, RootQueue, RootsFound, WIDTH};
pub use companion::{PolynomialRoots, RootsError, companion_roots, companion_roots_real};
pub use isolate::{Isolation, isolate_real_roots};
pub use locate::{CircleRoot, FIRST_BITS, MAX_BITS, NotLocated, locate_on_circle};
pub use pencil::{Eigenpair, PencilEigenpairs, PencilError, pencil_eigenpairs};
pub use polish::{FineRoot, NotSettled, polish_roots};
pub(crate) use polish::{quotient, scaled};
pub use real_pencil::{RealPencilPair, real_pencil_eigenpairs};
