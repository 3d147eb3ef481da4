//! Exact and approximate arithmetic that knows nothing of geometry.
//!
//! What can be added and multiplied is a [`Ring`]; what can also be divided exactly is a [`Domain`].
//! Floats are rings and not domains, so an elimination over floats does not compile. On these two
//! stand polynomials in one variable ([`UPoly`]), in many ([`Poly`]), and on the unit circle ([`Trig`]).

mod bounded;
mod bracket;
mod gaussian;
mod gcd;
mod interval;
mod lanes;
mod monomial;
mod poly;
mod rational;
mod residue;
mod ring;
mod short_trig;
mod trig;
mod twice;
mod upoly;

pub use bounded::Bounded;
pub use bracket::Bracket;
pub use gaussian::Gaussian;
pub use interval::Interval;
pub use lanes::Lanes;
pub use monomial::Monomial;
pub use poly::Poly;
pub(crate) use rational::scale_by_power_of_two;
pub use rational::{Integer, Rational, dyadic, integer_to_f64_scaled, nearest_f64, ratio_to_f64};
pub use residue::Residue;
pub use ring::{Domain, Ring};
pub use short_trig::{SHORT_ORDER, ShortTrig};
pub use trig::Trig;
pub use twice::Twice;
pub use upoly::UPoly;
