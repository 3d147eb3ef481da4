//! From a polynomial to its roots: how many are real, exactly, and where all of them lie, to any number of digits.

mod circle;
mod isolate;
mod locate;
mod polish;

pub use circle::{CountedRoots, count_on_circle};
pub use isolate::{Isolation, isolate_real_roots};
pub use locate::{CircleRoot, FIRST_BITS, MAX_BITS, NotLocated, locate_on_circle};
pub use polish::{FineRoot, NotSettled, polish_roots};
pub(crate) use polish::{quotient, scaled};
