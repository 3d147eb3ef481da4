//! From a polynomial system and a plan to every solution, with an account.
//!
//! [`eliminate`] follows a [`Plan`] from a [`System`] to an [`Eliminant`], exactly.

mod eliminant;
mod plan;
mod solutions;
mod system;

pub use eliminant::{Eliminant, EliminateError, Outcome, eliminate};
pub use plan::{Factor, Plan, Step};
pub use solutions::Account;
pub use system::{System, ToComplex, show_polynomial, to_complex_together};
