//! A linkage as data, checked.

use nalgebra::Vector2;
use num_complex::Complex64;
use thiserror::Error;

use super::take_apart::Plan;
use crate::linkage::group::TriadError;
use crate::linkage::pinned::PinnedDyadError;
use crate::linkage::truss::TrussError;

/// What a joint of a linkage lets its two links do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinkageJointKind {
    /// Turn about the joint's place.
    Revolute,
    /// Slide along a direction through the joint's place.
    Prismatic {
        /// In the reference assembly, of any length but zero; positive displacements of the second link run along it.
        direction: Vector2<f64>,
    },
}

/// A joint of a linkage drawn in one reference assembly.
///
/// ```
/// use assur::linkage::LinkageJoint;
/// use assur::nalgebra::Vector2;
/// let crank = LinkageJoint::revolute([0, 1], Vector2::zeros()).driven();
/// let slider = LinkageJoint::prismatic([2, 0], Vector2::new(4.0, 0.0), Vector2::x());
/// assert!(crank.driven && !slider.driven);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkageJoint {
    /// The two links, counted from 0.
    pub links: [usize; 2],
    /// Where it is in the reference assembly; of a slider any point of its axis.
    pub at: Vector2<f64>,
    /// Whether the links turn or slide.
    pub kind: LinkageJointKind,
    /// Whether an input gives the displacement of the second link against the first, from the reference assembly.
    pub driven: bool,
}

impl LinkageJoint {
    /// A passive joint that turns.
    pub fn revolute(links: [usize; 2], at: Vector2<f64>) -> Self {
        Self { links, at, kind: LinkageJointKind::Revolute, driven: false }
    }

    /// A passive joint that slides.
    pub fn prismatic(links: [usize; 2], at: Vector2<f64>, direction: Vector2<f64>) -> Self {
        Self { links, at, kind: LinkageJointKind::Prismatic { direction }, driven: false }
    }

    /// The same joint, driven.
    pub fn driven(self) -> Self {
        Self { driven: true, ..self }
    }

    pub(super) fn place(&self) -> Complex64 {
        Complex64::new(self.at.x, self.at.y)
    }

    /// The direction of a slider.
    pub(super) fn direction(&self) -> Option<Complex64> {
        match self.kind {
            LinkageJointKind::Revolute => None,
            LinkageJointKind::Prismatic { direction } => Some(Complex64::new(direction.x, direction.y)),
        }
    }

    /// `R` or `P`.
    pub fn letter(&self) -> char {
        if matches!(self.kind, LinkageJointKind::Revolute) { 'R' } else { 'P' }
    }
}

/// Links joined by revolute and prismatic joints, some of them driven.
///
/// Can only be had validated: finite numbers, mobility equal to the number of drivers in every part, every group one that can be solved.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    pub(super) links: usize,
    pub(super) ground: usize,
    pub(super) joints: Vec<LinkageJoint>,
    /// The body that each link belongs to; that of the ground is 0.
    pub(super) bodies: Vec<usize>,
    /// The Assur groups in the order in which they can be assembled.
    pub(super) plans: Vec<Plan>,
    /// The largest distance between two joints of the drawing.
    pub(super) size: f64,
}

/// Why a group of a linkage cannot be put together.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum GroupError {
    /// It is no truss that can be assembled; links are those of the group, 0 stands for what is known.
    #[error(transparent)]
    Truss(#[from] TrussError),
    /// A triad with numbers out of range.
    #[error(transparent)]
    Triad(#[from] TriadError),
    /// A dyad with numbers out of range.
    #[error(transparent)]
    Dyad(#[from] PinnedDyadError),
}

/// Why a linkage cannot be taken apart or put together. Links and joints are counted from 0.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LinkageError {
    /// A joint, or the ground, names a link that is not there.
    #[error("{what}: link {link} does not exist; there are {links}, counted from 0")]
    NoSuchLink {
        /// `joint 3` or `ground`.
        what: String,
        /// The link named.
        link: usize,
        /// How many there are.
        links: usize,
    },
    /// A joint joins a link to itself.
    #[error("joint {joint} joins link {link} to itself")]
    SelfJoint {
        /// The joint.
        joint: usize,
        /// The link.
        link: usize,
    },
    /// A place, a direction or an input is NaN or infinite.
    #[error("{what}: {value} must be finite")]
    NotFinite {
        /// `joint 3` or `input 2`.
        what: String,
        /// The number found.
        value: f64,
    },
    /// A slider without a direction.
    #[error("joint {joint}: direction must not be [0, 0]")]
    NoDirection {
        /// The joint.
        joint: usize,
    },
    /// Two joints of the same two links in one place.
    #[error("joints {first} and {second} join the same links in one place")]
    Coincident {
        /// One joint.
        first: usize,
        /// The other.
        second: usize,
    },
    /// Driven joints form a loop: their inputs contradict each other, or say one thing twice.
    #[error("joint {joint} is driven within a body that other drivers hold together already")]
    DrivenLoop {
        /// The joint.
        joint: usize,
    },
    /// More bodies than subsets can be searched.
    #[error("{bodies} links are movable with the drivers held: at most {most} can be taken apart")]
    TooLarge {
        /// How many bodies there are beside the ground's.
        bodies: usize,
        /// How many there may be.
        most: usize,
    },
    /// Sliders alone close a loop.
    #[error(
        "links {}: sliders alone close a loop, which then cannot turn, so that one condition is superfluous or contradicts; not covered",
        listed(.links)
    )]
    SlidersOnly {
        /// The links of the loop.
        links: Vec<usize>,
    },
    /// A part is held more than once over.
    #[error("links {}: overdetermined with the drivers held, mobility {mobility}", listed(.links))]
    Overdetermined {
        /// The links of the part.
        links: Vec<usize>,
        /// Three times its bodies less two for each joint.
        mobility: i64,
    },
    /// What is left moves though all drivers are held.
    #[error("links {}: still movable with the drivers held, mobility {mobility}; another driven joint is needed", listed(.links))]
    Movable {
        /// The links that are left.
        links: Vec<usize>,
        /// Three times their bodies less two for each joint.
        mobility: i64,
    },
    /// Some links of a group hold each other, so that they are one body, or hold each other more than once over.
    #[error("links {}: rigid among themselves, mobility {mobility} against each other; make them one link", listed(.links))]
    Rigid {
        /// The links.
        links: Vec<usize>,
        /// Their mobility against one of them: 0 where they are rigid, less where they are overdetermined.
        mobility: i64,
    },
    /// A group with more links than can be asked about.
    #[error("links {}: they form one Assur group of {} links; at most {most} are covered", listed(.links), .links.len())]
    GroupTooLarge {
        /// The links of the group.
        links: Vec<usize>,
        /// How many there may be.
        most: usize,
    },
    /// A group larger than the triad that has a slider.
    #[error(
        "links {}: they form one Assur group of {} bodies with a slider, joint {joint}; sliders are covered in dyads and triads only",
        listed(.links), .bodies
    )]
    SliderInLargerGroup {
        /// The links of the group.
        links: Vec<usize>,
        /// How many bodies they are with the drivers held.
        bodies: usize,
        /// The first slider among its joints.
        joint: usize,
    },
    /// Another number of inputs than of driven joints.
    #[error("{found} inputs given, {expected} needed: one for each driven joint, in file order")]
    InputCount {
        /// How many driven joints there are.
        expected: usize,
        /// How many inputs there are.
        found: usize,
    },
    /// A group that cannot be assembled.
    #[error("group {group}: {error}")]
    Group {
        /// Counted from 1, in the order of assembly.
        group: usize,
        /// What is wrong with it.
        error: GroupError,
    },
    /// More combinations than anyone will read.
    #[error("more than {most} combinations of assemblies")]
    TooMany {
        /// How many there may be.
        most: usize,
    },
}

fn listed(links: &[usize]) -> String {
    links.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

impl Linkage {
    /// A validated linkage, taken apart into its groups.
    ///
    /// Joints that several links share in one place are given in pairs, in any order. **Errors:** see [`LinkageError`]; the message names joint, link, or the
    /// part and its mobility. **Cost:** the subsets of the movable bodies, at most 2^18.
    ///
    /// ```
    /// use assur::linkage::{Linkage, LinkageJoint};
    /// use assur::nalgebra::Vector2;
    /// // A slider-crank.
    /// let (crank, pin) = (Vector2::new(0.0, 0.0), Vector2::new(1.0, 1.0));
    /// let joints = [LinkageJoint::revolute([0, 1], crank).driven(), LinkageJoint::revolute([1, 2], pin),
    ///               LinkageJoint::revolute([2, 3], Vector2::new(4.0, 0.0)),
    ///               LinkageJoint::prismatic([0, 3], Vector2::new(4.0, 0.0), Vector2::x())];
    /// let linkage = Linkage::new(4, 0, &joints)?;
    /// let found = linkage.assemble(&[0.1])?;
    /// assert_eq!((found.groups.len(), found.groups[0].name.as_str()), (1, "dyad RRP"));
    /// assert_eq!(found.assemblies.len(), 2);
    /// // Without a driver it moves.
    /// let free = joints.map(|joint| LinkageJoint { driven: false, ..joint });
    /// assert!(Linkage::new(4, 0, &free).is_err());
    /// # Ok::<(), assur::linkage::LinkageError>(())
    /// ```
    pub fn new(links: usize, ground: usize, joints: &[LinkageJoint]) -> Result<Self, LinkageError> {
        if ground >= links {
            return Err(LinkageError::NoSuchLink { what: "ground".to_owned(), link: ground, links });
        }
        for (number, joint) in joints.iter().enumerate() {
            let what = || format!("joint {number}");
            if let Some(&link) = joint.links.iter().find(|&&link| link >= links) {
                return Err(LinkageError::NoSuchLink { what: what(), link, links });
            }
            if joint.links[0] == joint.links[1] {
                return Err(LinkageError::SelfJoint { joint: number, link: joint.links[0] });
            }
            let direction = joint.direction().unwrap_or(Complex64::ONE);
            let numbers = [joint.at.x, joint.at.y, direction.re, direction.im];
            if let Some(&value) = numbers.iter().find(|value| !value.is_finite()) {
                return Err(LinkageError::NotFinite { what: what(), value });
            }
            if direction == Complex64::ZERO {
                return Err(LinkageError::NoDirection { joint: number });
            }
            let same = |other: &&LinkageJoint| {
                let [a, b] = joint.links;
                other.at == joint.at && (other.links == [a, b] || other.links == [b, a])
            };
            if let Some(first) = joints[..number].iter().position(|other| same(&other)) {
                return Err(LinkageError::Coincident { first, second: number });
            }
        }
        // Links that drivers hold together, by the smallest of their numbers, the ground's counted as the smallest.
        let mut root: Vec<usize> = (0..links).collect();
        for (number, joint) in joints.iter().enumerate().filter(|(_, joint)| joint.driven) {
            let [a, b] = joint.links.map(|link| root[link]);
            if a == b {
                return Err(LinkageError::DrivenLoop { joint: number });
            }
            let (kept, gone) = if b == root[ground] || (a != root[ground] && b < a) { (b, a) } else { (a, b) };
            root.iter_mut().filter(|own| **own == gone).for_each(|own| *own = kept);
        }
        let mut roots = vec![root[ground]];
        roots.extend((0..links).filter(|&link| root[link] == link && link != root[ground]));
        let bodies: Vec<usize> =
            root.iter().map(|own| roots.iter().position(|other| other == own).unwrap_or(0)).collect();
        let apart = |a: &LinkageJoint| joints.iter().map(|b| (a.at - b.at).norm()).fold(0.0, f64::max);
        let size = joints.iter().map(apart).fold(0.0, f64::max);
        let mut linkage = Self { links, ground, joints: joints.to_vec(), bodies, plans: Vec::new(), size };
        linkage.plans = linkage.take_apart(roots.len())?;
        Ok(linkage)
    }

    /// How many inputs it needs.
    pub fn inputs(&self) -> usize {
        self.joints.iter().filter(|joint| joint.driven).count()
    }

    /// The joints.
    pub fn joints(&self) -> &[LinkageJoint] {
        &self.joints
    }

    /// How many links there are.
    pub fn links(&self) -> usize {
        self.links
    }

    /// The ground.
    pub fn ground(&self) -> usize {
        self.ground
    }

    pub(super) fn links_of(&self, bodies: &[usize]) -> Vec<usize> {
        bodies.iter().flat_map(|&body| (0..self.links).filter(move |&link| self.bodies[link] == body)).collect()
    }
}
