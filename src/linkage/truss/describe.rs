//! A truss as data: links, joints with their places on both links, a ground.

use nalgebra::Vector2;
use num_complex::Complex64;
use thiserror::Error;

use super::catalogue::{BaranovTruss, Recognised, recognise};
use super::graph::{GraphError, LinkGraph};

/// A revolute joint between two links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrussJoint {
    /// The two links, counted from 0.
    pub links: [usize; 2],
    /// Where the joint sits on each of them, in that link's own frame; all frames may be the base frame of one reference assembly.
    pub at: [Vector2<f64>; 2],
}

impl TrussJoint {
    /// A joint of a group that is drawn in a reference assembly: at one place on both links.
    pub fn drawn(links: [usize; 2], at: Vector2<f64>) -> Self {
        Self { links, at: [at, at] }
    }
}

/// Links and revolute joints that form an Assur group with their ground.
///
/// Can only be had validated: an Assur group as a graph, every number finite, not all in one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Truss {
    pub(super) graph: LinkGraph,
    /// Places of each joint on its two links, as complex numbers.
    pub(super) places: Vec<[Complex64; 2]>,
    pub(super) ground: usize,
    pub(super) recognised: Option<Recognised>,
    /// Links whose joints all coincide: they turn freely and hold the joints together.
    pub(super) loose: Vec<usize>,
    /// The largest distance between two joints of one link.
    pub(super) size: f64,
}

/// Why links and joints make no truss.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TrussError {
    /// Too many or too few links or joints, or some part rigid on its own.
    #[error(transparent)]
    Graph(#[from] GraphError),
    /// A joint's place is NaN or infinite.
    #[error("joint {joint}: {value} must be finite")]
    NotFinite {
        /// The joint, from 0.
        joint: usize,
        /// The number found.
        value: f64,
    },
    /// All joints of every link coincide.
    #[error("all joints coincide on every link: nothing has a length")]
    NoLength,
    /// The joints of the ground coincide, and so do those of other links: nothing can be told apart.
    #[error("all joints of the ground, link {ground}, coincide: take another link as the ground")]
    GroundIsPoint {
        /// The ground.
        ground: usize,
    },
}

/// Joints of a link closer together than this part of the group's size count as one. A link of a millionth still has its own place in
/// the pencil; below, rounding decides where it points (heuristic).
const COINCIDENT: f64 = 1e-12;

impl Truss {
    /// A validated truss.
    ///
    /// **Units:** lengths in any one unit. **Errors:** see [`TrussError`]; the message names joint, link or part.
    ///
    /// ```
    /// use assur::linkage::{Truss, TrussJoint};
    /// use assur::nalgebra::Vector2;
    /// let joint = |i, j, x, y| TrussJoint::drawn([i, j], Vector2::new(x, y));
    /// // The triad: ground 3, platform 4, legs 0, 1, 2.
    /// let joints = [joint(0, 3, 0.0, 0.0), joint(1, 3, 4.0, 0.0), joint(2, 3, 2.0, 5.0),
    ///               joint(0, 4, 1.0, 1.5), joint(1, 4, 3.0, 1.0), joint(2, 4, 2.0, 2.5)];
    /// let truss = Truss::new(5, &joints, 3)?;
    /// assert_eq!(truss.catalogued().map(|entry| entry.count), Some(6));
    /// # Ok::<(), assur::linkage::TrussError>(())
    /// ```
    pub fn new(links: usize, joints: &[TrussJoint], ground: usize) -> Result<Self, TrussError> {
        let edges: Vec<[usize; 2]> = joints.iter().map(|joint| joint.links).collect();
        let graph = LinkGraph::of_group(links, &edges, ground)?;
        for (joint, given) in joints.iter().enumerate() {
            let numbers = given.at.iter().flat_map(|place| place.iter().copied());
            if let Some(value) = numbers.into_iter().find(|value| !value.is_finite()) {
                return Err(TrussError::NotFinite { joint, value });
            }
        }
        let places: Vec<[Complex64; 2]> =
            joints.iter().map(|joint| joint.at.map(|place| Complex64::new(place.x, place.y))).collect();
        let spread = |link: usize| {
            let of_link: Vec<Complex64> = on_link(&graph, &places, link).map(|(_, place)| place).collect();
            let apart = |a: &Complex64, b: &Complex64| (a - b).re.hypot((a - b).im);
            of_link.iter().flat_map(|a| of_link.iter().map(move |b| apart(a, b))).fold(0.0, f64::max)
        };
        let spreads: Vec<f64> = (0..links).map(spread).collect();
        let size = spreads.iter().copied().fold(0.0, f64::max);
        if size == 0.0 || !size.is_finite() {
            return Err(TrussError::NoLength);
        }
        let loose: Vec<usize> = (0..links).filter(|&link| spreads[link] <= COINCIDENT * size).collect();
        if loose.contains(&ground) {
            return Err(TrussError::GroundIsPoint { ground });
        }
        let recognised = recognise(&graph);
        Ok(Self { graph, places, ground, recognised, loose, size })
    }

    /// How many links there are, the ground among them.
    pub fn links(&self) -> usize {
        self.graph.links
    }

    /// The ground.
    pub fn ground(&self) -> usize {
        self.ground
    }

    /// The joints, in the order given.
    pub fn joints(&self) -> impl Iterator<Item = TrussJoint> {
        let vector = |z: Complex64| Vector2::new(z.re, z.im);
        self.graph.edges.iter().zip(&self.places).map(move |(&links, at)| TrussJoint { links, at: at.map(vector) })
    }

    /// The truss of the catalogue that this one is, as a graph; `None` for dyads and more than nine links.
    pub fn catalogued(&self) -> Option<BaranovTruss> {
        self.recognised.as_ref().map(|found| found.truss)
    }

    /// In how many ways it can be put together for general dimensions, real and complex, where that is known.
    pub fn general_count(&self) -> Option<usize> {
        match self.links() {
            3 => Some(2),
            _ => self.catalogued().map(|truss| truss.count),
        }
    }

    /// The links whose joints all coincide. They turn freely; what they hold together is treated as one joint.
    pub fn loose_links(&self) -> &[usize] {
        &self.loose
    }

    /// The length residuals are measured against: the largest distance between two joints of one link.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The joints of a link with their places on it.
    pub(super) fn on_link(&self, link: usize) -> impl Iterator<Item = (usize, Complex64)> {
        on_link(&self.graph, &self.places, link)
    }
}

fn on_link<'a>(
    graph: &'a LinkGraph,
    places: &'a [[Complex64; 2]],
    link: usize,
) -> impl Iterator<Item = (usize, Complex64)> + 'a {
    let side = move |(joint, ends): (usize, &[usize; 2])| {
        ends.iter().position(|&end| end == link).map(|side| (joint, places[joint][side]))
    };
    graph.edges.iter().enumerate().filter_map(side)
}
