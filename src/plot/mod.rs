//! Drawings of results as SVG: every assembly mode as a small multiple, all on one scale.
//!
//! A result becomes one scene a mode (what is drawn, in length units), the scenes become a sheet (where it is drawn, in pixels).
//! Nothing is solved here; the chains are drawn from their joint values, so a chain that does not close shows.
//!
//! Symbols: circles are revolute joints, blocks on a guide are sliders, telescopes are sliders between two links, hatching is the
//! ground, filled in colour is actuated, ringed is outside its limits.

mod couplers;
mod curves;
mod linkages;
mod modes;
mod plane;
mod robots;
mod scene;
mod sheet;
mod spatial;
mod symbols;
mod triads;
mod trusses;
mod workspaces;

pub use couplers::draw_coupler;
pub use curves::{NamedCurve, draw_curves};
pub use linkages::draw_linkage;
pub use modes::{draw_modes, mode_marks};
pub use plane::{draw_path, draw_singularities};
pub use robots::{PosedRobot, draw_hana_poses, draw_multipteron_poses, draw_tripod_poses};
pub use scene::{Look, Mark};
pub use spatial::{draw_hana, draw_tilt_sections};
pub use triads::draw_assemblies;
pub use trusses::{draw_truss, truss_marks};
pub use workspaces::{WorkspaceLayer, draw_workspaces};
