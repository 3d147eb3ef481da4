//! From a polynomial to its roots: how many are real, exactly, and where all of them lie, to any number of digits.

mod isolate;
mod polish;

pub use isolate::{Isolation, isolate_real_roots};
pub use polish::{FineRoot, NotSettled, polish_roots};
pub(crate) use polish::{quotient, scaled};
