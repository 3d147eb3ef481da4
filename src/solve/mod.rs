//! From a polynomial system and a plan to every solution, with an account.

mod solutions;

pub use solutions::Account;
