//! What is proved, what is refuted, and what neither.

mod verdict;

pub use verdict::Verdict;
