//! Regions of the plane as loops of boundary arcs.

use super::boundary::BoundaryArc;
use super::limits::{ActiveLimit, WorkspaceError};
use crate::plane::PhiRange;

/// Which workspace is asked for. Angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WorkspaceKind {
    /// Reached with one orientation.
    Constant {
        /// The orientation.
        phi: f64,
    },
    /// Reached with some orientation.
    Maximal,
    /// Reached with some orientation of a range.
    Inclusive(PhiRange),
    /// Reached with every orientation of a range.
    Total(PhiRange),
    /// Reached with every orientation.
    Dextrous,
}

impl WorkspaceKind {
    /// The name in commands and reports: `constant`, `maximal`, `inclusive`, `total`, `dextrous`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Constant { .. } => "constant",
            Self::Maximal => "maximal",
            Self::Inclusive(_) => "inclusive",
            Self::Total(_) => "total",
            Self::Dextrous => "dextrous",
        }
    }

    /// Whether its numbers make sense.
    ///
    /// # Errors
    /// A number that is not finite, a negative width.
    pub fn validate(&self) -> Result<(), WorkspaceError> {
        let finite = |what, value: f64| {
            if value.is_finite() { Ok(()) } else { Err(WorkspaceError::NotFinite { what, value }) }
        };
        match self {
            Self::Constant { phi } => finite("phi", *phi),
            Self::Inclusive(range) | Self::Total(range) => {
                finite("from", range.from)?;
                finite("width of the range of phi", range.width)?;
                if range.width < 0.0 { Err(WorkspaceError::NegativeWidth { value: range.width }) } else { Ok(()) }
            }
            Self::Maximal | Self::Dextrous => Ok(()),
        }
    }
}

/// A workspace.
#[derive(Clone, Debug, PartialEq)]
pub struct Workspace {
    /// Which one.
    pub kind: WorkspaceKind,
    /// Where it is.
    pub region: Region,
    /// Arcs in its inside where a way of reaching its places ends: they separate assemblies.
    pub separating: Vec<BoundaryArc>,
}

/// A closed loop of boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// Area inside, positive for an outer loop, negative for a hole.
    pub area: f64,
    /// Its arcs, each starting where the one before ends.
    pub arcs: Vec<BoundaryArc>,
}

/// A part of a region that has no area.
#[derive(Clone, Debug, PartialEq)]
pub enum Isolated {
    /// A point.
    Point {
        /// Where.
        at: [f64; 2],
        /// The limits that leave no more.
        active: Vec<ActiveLimit>,
    },
    /// A piece of curve; no side of it belongs to the region.
    Curve(BoundaryArc),
}

/// A closed region of the plane.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Region {
    /// Outer loops run counter-clockwise, holes clockwise: the region is on the left.
    pub loops: Vec<Loop>,
    /// Parts without area.
    pub isolated: Vec<Isolated>,
    /// Area.
    pub area: f64,
    /// Length of the loops.
    pub perimeter: f64,
    /// Centre of gravity; `None` where there is no area.
    pub centroid: Option<[f64; 2]>,
    /// `[xmin, ymin, xmax, ymax]` of all of it; `None` where it is empty.
    pub bbox: Option<[f64; 4]>,
    /// Pieces of positive area; two that touch in a point are two.
    pub components: usize,
    /// Holes.
    pub holes: usize,
}
