//! From a polynomial system and a plan to every solution, with an account.
//!
//! [`eliminate`] follows a [`Plan`] from a [`System`] to an [`Eliminant`], exactly. [`lift`] takes its roots back through the plan
//! to all unknowns, refines them on the original equations and accounts for every root. [`solve`] does both.

mod eliminant;
mod lift;
mod plan;
mod solutions;
mod square_free;
mod system;

pub use eliminant::{Eliminant, EliminateError, Outcome, eliminate};
pub use lift::{SolveError, lift, solve};
pub use plan::{Factor, Plan, Step};
pub use solutions::{Account, RejectedRoot, RootRejection, Solution, Solutions};
pub use system::{System, ToComplex, show_polynomial, to_complex_together};
