//! Curves that a point of a coupler draws: four-bars, slider-cranks and double sliders.
//!
//! A coupler is guided in two of its points, each on a circle or a line ([`CouplerSide`]). The curve of a third point is an algebraic one
//! ([`CouplerCurve::equation`]), a tricircular sextic for a four-bar; its real part falls into circuits, traced smoothly
//! through the limits of the input ([`CouplerCurve::circuits`]). [`CouplerCurve::meet`] finds every intersection with a line, a
//! circle or another such curve, real and complex, with an account.

mod circuits;
mod count;
mod cross;
mod curve;
mod equation;
mod meet;
mod nearest;
mod search;
mod sextic;

pub use circuits::{Circuit, GrashofClass, InputRange};
pub use curve::{CouplerCurve, CouplerError, CouplerSide};
pub use equation::{Biquadratic, SideNumbers, coupler_equation};
pub use meet::{Intersection, Intersections, Partner};
pub use sextic::{DoublePoint, DoublePointKind};
