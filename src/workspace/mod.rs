//! **Where can it reach?** Exactly: closed loops of circular arcs, segments and coupler curves.
//!
//! | word | meaning |
//! |---|---|
//! | reference point `C` | the platform point whose places are asked for |
//! | limit | an end of a joint's range, or the place where a leg's two working modes merge; held there, the leg is a [`crate::Dyad`] |
//! | constant orientation | the places reached with one given orientation |
//! | maximal (reachable) | with some orientation |
//! | inclusive | with some orientation of a range |
//! | total orientation | with every orientation of a range |
//! | dextrous | with every orientation |
//! | margin | how far `C` may be moved without turning the platform before a limit is met |
//!
//! A leg's bound held at its value leaves a dyad, so every boundary curve is one of few: at a given orientation a dyad draws a
//! circle or a line of `C`; where its gap is stationary in the orientation it draws a circle or a line again; two dyads of
//! different legs draw a coupler curve. [`Reach`] holds the limits of a manipulator, ready for every question; [`Reach::orientations`] is the
//! exact set of orientations at a place, and every piece of boundary is decided by such exact membership on both its sides.
//!
//! It covers legs RPR, RRR and PRR, in any mixture, whichever joints are driven. Sources: Merlet, Gosselin, Mouly 1998, whose rules for
//! the maximal, inclusive, total and dextrous workspaces are mended here (derivations/ring_reach.rs, slider_reach.rs, joint_ranges.rs).

mod arrangement;
mod assembly;
mod boundary;
mod constant;
mod folds;
mod gradient;
mod leg;
mod limits;
mod membership;
mod moving_edge;
#[cfg(feature = "optimise")]
mod optimise;
mod reach;
mod region;
mod stack;
mod total;
mod void;

pub use boundary::{ArcCurve, BoundaryArc};
pub use folds::CouplerArc;
pub use limits::{ActiveLimit, Limit, LimitCause, WorkspaceError, WorkspaceModes};
pub use membership::Membership;
#[cfg(feature = "optimise")]
pub use optimise::{DesignChoice, Optimum};
pub use reach::Reach;
pub use region::{Isolated, Loop, Region, Workspace, WorkspaceKind};
pub use stack::Stack;
pub use void::StrokeVoid;
