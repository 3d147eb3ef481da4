//! What is proved, what is refuted, and what neither.

mod krawczyk;
mod verdict;

pub use krawczyk::{Enclosure, Region, enclose_zero, unique_zero};
pub use verdict::Verdict;
