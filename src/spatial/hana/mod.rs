//! HANA: a platform that moves in the plane `Oyz` and tilts about an axis parallel to `y`.
//!
//! Three sliders on vertical rails carry links; legs 1 and 2 hold the platform at `P1`, `P2`, leg 3 at `P3`.
//!
//! | symbol | meaning |
//! |---|---|
//! | `r`, `R` | radii of platform and base |
//! | `L`, `L3` | lengths of the links of legs 1 and 2, and of leg 3 |
//! | `z1, z2, z3` | the inputs: heights of the sliders on the rails through `(R, 0)`, `(-R, 0)`, `(0, -R)` of the plane `Oxy` |
//! | `y, z, phi` | the pose: place of the platform's centre in the plane `x = 0`, rotation about `y` |
//! | `s, c` | `sin phi`, `cos phi` |
//! | `N, N3` | `sqrt(L² - (R - r c)² - y²)`, `sqrt(L3² - (y + R - r)²)`: what remains of a link's length for the height |
//!
//! `P1 = (r c, y, z - r s)`, `P2 = (-r c, y, z + r s)`, `P3 = (0, y - r, z)`.
//!
//! Source: Liu, Wang, Wang, Li 2004. What is printed there and does
//! not hold is said where it matters.

mod capability;
mod forward;
mod inverse;
mod mixed;
mod model;
mod supremum;
mod velocity;
mod workspace;

pub use capability::{Capability, CapabilityMap, CapabilityStop, CapabilitySupremum, HanaCapabilityError};
pub use forward::{HanaAssemblies, HanaAssembly, HanaFamily};
pub use inverse::{HanaMode, HanaUnreachable, HanaViolation, HanaWay, HanaWays};
pub use mixed::{MixedReach, MixedSingularity};
pub use model::{Hana, HanaPose};
pub use velocity::{HanaSingularKind, HanaSingularity, HanaVelocity};
