//! Drawings of results as SVG: every assembly mode as a small multiple, all on one scale.
//!
//! A result becomes one scene a mode (what is drawn, in length units), the scenes become a sheet (where it is drawn, in pixels).
//! Nothing is solved here; the chains are drawn from their joint values, so a chain that does not close shows.
//!
//! Symbols: circles are revolute joints, blocks on a guide are sliders, telescopes are sliders between two links, hatching is the
//! ground, filled in colour is actuated, ringed is outside its limits.

mod couplers;
mod linkages;
mod modes;
mod plane;
mod scene;
mod sheet;
mod spatial;
mod symbols;
mod triads;
mod trusses;

pub use couplers::draw_coupler;
pub use linkages::draw_linkage;
pub use modes::{draw_modes, mode_marks};
pub use plane::{draw_path, draw_singularities};
pub use scene::{Look, Mark};
pub use spatial::{draw_hana, draw_tilt_sections};
pub use triads::draw_assemblies;
pub use trusses::{draw_truss, truss_marks};
