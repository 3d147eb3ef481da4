//! A linkage with drivers, taken apart into Assur groups and put together again, group after group.
//!
//! A driven joint holds two links together at a given angle, so they are one body. From the ground outwards, the smallest set of bodies whose
//! joints to each other and to what is known leave no freedom is the next Assur group; it is assembled as a [`Truss`] on known places,
//! and each real assembly is the beginning of a branch. The leaves of that tree are the assemblies of the linkage: every combination, nothing sampled.
//!
//! Not covered: sliders, named as such where a file has them; a group without a real assembly ends its branch.

use nalgebra::Vector2;
use num_complex::Complex64;
use thiserror::Error;

use super::assemblies::Status;
use super::truss::{Truss, TrussError, TrussJoint};

/// A revolute joint of a linkage drawn in one reference assembly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkageJoint {
    /// The two links, counted from 0.
    pub links: [usize; 2],
    /// Where it is in the reference assembly.
    pub at: Vector2<f64>,
    /// Whether an input gives the angle of the second link against the first, from the reference assembly.
    pub driven: bool,
}

/// Links joined by revolute joints, some of them driven.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    links: usize,
    ground: usize,
    joints: Vec<LinkageJoint>,
    /// The body that each link belongs to; that of the ground is 0.
    bodies: Vec<usize>,
    /// The Assur groups in the order in which they can be assembled, as bodies.
    groups: Vec<Vec<usize>>,
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
    /// A place or an input is NaN or infinite.
    #[error("{what}: {value} must be finite")]
    NotFinite {
        /// `joint 3` or `input 2`.
        what: String,
        /// The number found.
        value: f64,
    },
    /// Driven joints form a loop: their inputs contradict each other, or say one thing twice.
    #[error("joint {joint} is driven within a body that other drivers hold together already")]
    DrivenLoop {
        /// The joint.
        joint: usize,
    },
    /// More bodies than subsets can be searched.
    #[error("{bodies} links are movable with the drivers held: at most {} can be taken apart", MOST_BODIES)]
    TooLarge {
        /// How many bodies there are beside the ground's.
        bodies: usize,
    },
    /// A part is held more than once over.
    #[error("links {}: overdetermined with the drivers held, mobility {mobility}", listed(.links))]
    Overdetermined {
        /// The links of the part.
        links: Vec<usize>,
        /// Three times its bodies less twice its joints.
        mobility: i64,
    },
    /// What is left moves though all drivers are held.
    #[error("links {}: still movable with the drivers held, mobility {mobility}; another driven joint is needed", listed(.links))]
    Movable {
        /// The links that are left.
        links: Vec<usize>,
        /// Three times their bodies less twice their joints.
        mobility: i64,
    },
    /// Another number of inputs than of driven joints.
    #[error("{found} inputs given, {expected} needed: one for each driven joint, in file order")]
    InputCount {
        /// How many driven joints there are.
        expected: usize,
        /// How many inputs there are.
        found: usize,
    },
    /// A group is no truss that can be assembled.
    #[error("group {group}: {error}")]
    Group {
        /// Counted from 1, in the order of assembly.
        group: usize,
        /// What is wrong with it; links are those of the group.
        error: TrussError,
    },
    /// More combinations than anyone will read.
    #[error("more than {} combinations of assemblies", MOST_ASSEMBLIES)]
    TooMany,
}

fn listed(links: &[usize]) -> String {
    links.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// Bodies whose subsets are searched for groups.
const MOST_BODIES: usize = 18;
/// Leaves of the tree.
const MOST_ASSEMBLIES: usize = 100_000;

/// A rigid motion of the plane: `z -> origin + turn z`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Motion {
    origin: Complex64,
    turn: Complex64,
}

impl Motion {
    const REST: Self = Self { origin: Complex64::ZERO, turn: Complex64::ONE };

    fn about(centre: Complex64, angle: f64) -> Self {
        let turn = Complex64::from_polar(1.0, angle);
        Self { origin: centre - turn * centre, turn }
    }

    fn after(&self, first: &Self) -> Self {
        Self { origin: self.origin + self.turn * first.origin, turn: self.turn * first.turn }
    }

    fn of(&self, point: Complex64) -> Complex64 {
        self.origin + self.turn * point
    }
}

/// One of the Assur groups of a linkage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkageGroup {
    /// Its links; links that a driver holds together stand next to each other.
    pub links: Vec<usize>,
    /// `dyad`, or the name of the truss that it forms with its ground: `5#0` (a triad and its like), `7#2`.
    pub name: String,
}

/// A node of the tree: one assembly of one group on those before it.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageNode {
    /// The group, from 0.
    pub group: usize,
    /// The node it stands on; `None` for the first group.
    pub parent: Option<usize>,
    /// Which of the group's real assemblies it is, from 1.
    pub number: usize,
    /// How the group's own answer ended.
    pub status: Status,
}

/// One assembly of a whole linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageAssembly {
    /// Which of each group's real assemblies it is made of, from 1.
    pub choice: Vec<usize>,
    /// Where each link's frame, the base frame of the reference assembly, has gone: `[x, y, phi]`.
    pub poses: Vec<[f64; 3]>,
    /// Largest gap at a joint of the assembled linkage over its size.
    pub residual: f64,
}

/// Every assembly of a linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageAssemblies {
    /// The groups, in the order of assembly.
    pub groups: Vec<LinkageGroup>,
    /// The tree, parents before their children.
    pub nodes: Vec<LinkageNode>,
    /// Its leaves.
    pub assemblies: Vec<LinkageAssembly>,
    /// `Complete` where every group's answer was; else the worst of them.
    pub status: Status,
}

impl Linkage {
    /// A validated linkage, taken apart into its groups.
    ///
    /// **Errors:** see [`LinkageError`]; the message names joint, link, or the part and its mobility. **Cost:** the subsets of
    /// the movable bodies, at most 2^18.
    ///
    /// ```
    /// use assur::linkage::{Linkage, LinkageJoint};
    /// use assur::nalgebra::Vector2;
    /// let joint = |links, x, y, driven| LinkageJoint { links, at: Vector2::new(x, y), driven };
    /// let four_bar = [joint([0, 1], 0.0, 0.0, true), joint([1, 2], 0.0, 2.0, false),
    ///                 joint([2, 3], 4.0, 3.0, false), joint([0, 3], 4.0, 0.0, false)];
    /// let linkage = Linkage::new(4, 0, &four_bar)?;
    /// let found = linkage.assemble(&[0.1])?;
    /// assert_eq!((found.groups.len(), found.groups[0].name.as_str()), (1, "dyad"));
    /// assert_eq!(found.assemblies.len(), 2);
    /// // Without a driver it moves.
    /// let free = four_bar.map(|joint| LinkageJoint { driven: false, ..joint });
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
            if let Some(&value) = joint.at.iter().find(|value| !value.is_finite()) {
                return Err(LinkageError::NotFinite { what: what(), value });
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
        let mut linkage = Self { links, ground, joints: joints.to_vec(), bodies, groups: Vec::new() };
        linkage.groups = linkage.take_apart(roots.len())?;
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

    fn links_of(&self, bodies: &[usize]) -> Vec<usize> {
        bodies.iter().flat_map(|&body| (0..self.links).filter(move |&link| self.bodies[link] == body)).collect()
    }

    fn take_apart(&self, bodies: usize) -> Result<Vec<Vec<usize>>, LinkageError> {
        if bodies - 1 > MOST_BODIES {
            return Err(LinkageError::TooLarge { bodies: bodies - 1 });
        }
        let passive: Vec<[usize; 2]> = self
            .joints
            .iter()
            .filter(|joint| !joint.driven)
            .map(|joint| joint.links.map(|link| self.bodies[link]))
            .collect();
        let mut known = 1u32;
        let everything = (1u32 << bodies) - 1;
        let mut groups = Vec::new();
        let members = |set: u32| (0..bodies).filter(|&body| set >> body & 1 == 1).collect::<Vec<usize>>();
        let mobility = |set: u32, known: u32| {
            let touches = |[a, b]: &&[usize; 2]| {
                let inside = |body: usize| (set | known) >> body & 1 == 1;
                inside(*a) && inside(*b) && (set >> a | set >> b) & 1 == 1
            };
            3 * i64::from(set.count_ones()) - 2 * passive.iter().filter(touches).count() as i64
        };
        while known != everything {
            let mut sets: Vec<u32> = (1..=everything).filter(|set| set & known == 0).collect();
            sets.sort_by_key(|set| set.count_ones());
            let tight = sets.iter().map(|&set| (set, mobility(set, known))).find(|(_, mobility)| *mobility <= 0);
            match tight {
                Some((set, 0)) => {
                    groups.push(members(set));
                    known |= set;
                }
                Some((set, mobility)) => {
                    return Err(LinkageError::Overdetermined { links: self.links_of(&members(set)), mobility });
                }
                None => {
                    let rest = everything & !known;
                    let links = self.links_of(&members(rest));
                    return Err(LinkageError::Movable { links, mobility: mobility(rest, known) });
                }
            }
        }
        Ok(groups)
    }

    /// Every assembly for given inputs: of each driven joint the angle of its second link against the first, from the reference
    /// assembly, in radians and in the order of the joints.
    ///
    /// **Accuracy:** each group as [`Truss::assemble`]; residuals are measured on the whole linkage. **Errors:** a wrong number of inputs, numbers
    /// that are not finite, groups that are no trusses or too large.
    pub fn assemble(&self, inputs: &[f64]) -> Result<LinkageAssemblies, LinkageError> {
        let expected = self.inputs();
        if inputs.len() != expected {
            return Err(LinkageError::InputCount { expected, found: inputs.len() });
        }
        if let Some((number, &value)) = (1..).zip(inputs).find(|(_, value)| !value.is_finite()) {
            return Err(LinkageError::NotFinite { what: format!("input {number}"), value });
        }
        let in_body = self.links_in_bodies(inputs);
        let bodies = 1 + self.groups.iter().map(Vec::len).sum::<usize>();
        let mut start = vec![None; bodies];
        start[0] = Some(Motion::REST);
        let mut state = Tree { nodes: Vec::new(), names: vec![None; self.groups.len()], leaves: Vec::new() };
        self.grow(&in_body, 0, None, &start, &mut state)?;
        let group = |(bodies, name): (&Vec<usize>, &Option<String>)| LinkageGroup {
            links: self.links_of(bodies),
            name: name.clone().unwrap_or_else(|| "not reached".to_owned()),
        };
        let groups = self.groups.iter().zip(&state.names).map(group).collect();
        let statuses = || state.nodes.iter().map(|node| node.status);
        let status = [Status::Undecided, Status::SelfMotion].into_iter().find(|worse| statuses().any(|s| s == *worse));
        let assemblies =
            state.leaves.iter().map(|(leaf, motions)| self.leaf(&state, *leaf, motions, &in_body)).collect();
        Ok(LinkageAssemblies { groups, assemblies, status: status.unwrap_or(Status::Complete), nodes: state.nodes })
    }

    /// Where each link lies in its body's frame, which is that of one of its links.
    fn links_in_bodies(&self, inputs: &[f64]) -> Vec<Motion> {
        let mut known: Vec<Option<Motion>> = vec![None; self.links];
        let driven: Vec<(&LinkageJoint, f64)> =
            self.joints.iter().filter(|joint| joint.driven).zip(inputs.iter().copied()).collect();
        let others = (0..self.links).filter(|&link| link != self.ground);
        for start in std::iter::once(self.ground).chain(others) {
            if known[start].is_some() {
                continue;
            }
            known[start] = Some(Motion::REST);
            // As often as there are links: drivers may come in any order.
            for _ in 0..self.links {
                for (joint, angle) in &driven {
                    let [i, j] = joint.links;
                    let centre = Complex64::new(joint.at.x, joint.at.y);
                    match (known[i], known[j]) {
                        (Some(motion), None) => known[j] = Some(motion.after(&Motion::about(centre, *angle))),
                        (None, Some(motion)) => known[i] = Some(motion.after(&Motion::about(centre, -*angle))),
                        _ => {}
                    }
                }
            }
        }
        known.into_iter().map(|motion| motion.unwrap_or(Motion::REST)).collect()
    }

    fn grow(
        &self,
        in_body: &[Motion],
        group: usize,
        parent: Option<usize>,
        motions: &[Option<Motion>],
        state: &mut Tree,
    ) -> Result<(), LinkageError> {
        let Some(members) = self.groups.get(group) else {
            if state.leaves.len() >= MOST_ASSEMBLIES {
                return Err(LinkageError::TooMany);
            }
            state.leaves.push((parent, motions.iter().map(|motion| motion.unwrap_or(Motion::REST)).collect()));
            return Ok(());
        };
        // Link 0 of the truss is what is known, in the base frame; the others are the group's bodies in their own.
        let mut joints = Vec::new();
        for joint in self.joints.iter().filter(|joint| !joint.driven) {
            let at = Complex64::new(joint.at.x, joint.at.y);
            let end = |link: usize| {
                let (body, place) = (self.bodies[link], in_body[link].of(at));
                match members.iter().position(|member| *member == body) {
                    Some(number) => Some((number + 1, place)),
                    None => motions[body].map(|motion| (0, motion.of(place))),
                }
            };
            let [Some((i, p)), Some((j, q))] = joint.links.map(end) else { continue };
            if i != j {
                let at = [p, q].map(|z| Vector2::new(z.re, z.im));
                joints.push(TrussJoint { links: [i, j], at });
            }
        }
        let truss = Truss::new(members.len() + 1, &joints, 0)
            .map_err(|error| LinkageError::Group { group: group + 1, error })?;
        let name = truss.catalogued().map(|entry| entry.name());
        state.names[group] = Some(name.unwrap_or_else(|| match members.len() {
            2 => "dyad".to_owned(),
            more => format!("group of {more} links"),
        }));
        let answer = truss.assemble();
        for (number, assembly) in (1..).zip(answer.real()) {
            let frames = truss.link_frames(assembly);
            let mut next = motions.to_vec();
            for (member, (origin, turn)) in members.iter().zip(&frames[1..]) {
                next[*member] = Some(Motion { origin: *origin, turn: *turn });
            }
            state.nodes.push(LinkageNode { group, parent, number, status: answer.status });
            let node = state.nodes.len() - 1;
            self.grow(in_body, group + 1, Some(node), &next, state)?;
        }
        Ok(())
    }

    fn leaf(&self, state: &Tree, leaf: Option<usize>, motions: &[Motion], in_body: &[Motion]) -> LinkageAssembly {
        let mut choice = Vec::new();
        let mut node = leaf;
        while let Some(number) = node {
            choice.push(state.nodes[number].number);
            node = state.nodes[number].parent;
        }
        choice.reverse();
        let placed: Vec<Motion> =
            (0..self.links).map(|link| motions[self.bodies[link]].after(&in_body[link])).collect();
        let (mut gap, mut size) = (0.0f64, 0.0f64);
        for joint in &self.joints {
            let at = Complex64::new(joint.at.x, joint.at.y);
            let [a, b] = joint.links.map(|link| placed[link].of(at));
            gap = gap.max((a - b).norm());
            size = self.joints.iter().map(|other| (other.at - joint.at).norm()).fold(size, f64::max);
        }
        let poses = placed.iter().map(|motion| [motion.origin.re, motion.origin.im, motion.turn.arg()]).collect();
        LinkageAssembly { choice, poses, residual: gap / size }
    }
}

/// The tree while it grows.
struct Tree {
    nodes: Vec<LinkageNode>,
    names: Vec<Option<String>>,
    leaves: Vec<(Option<usize>, Vec<Motion>)>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joint(links: [usize; 2], x: f64, y: f64, driven: bool) -> LinkageJoint {
        LinkageJoint { links, at: Vector2::new(x, y), driven }
    }

    /// A crank and dyad whose coupler carries one leg of a triad.
    fn chain() -> Vec<LinkageJoint> {
        vec![
            joint([0, 1], 0.0, 0.0, true),
            joint([1, 2], 1.0, 1.0, false),
            joint([2, 3], 4.0, 3.0, false),
            joint([3, 0], 5.0, 0.0, false),
            joint([2, 4], 3.0, 4.0, false),
            joint([4, 7], 4.0, 6.0, false),
            joint([0, 5], 8.0, 0.0, false),
            joint([5, 7], 7.0, 5.0, false),
            joint([0, 6], 9.0, 3.0, false),
            joint([6, 7], 6.0, 7.0, false),
        ]
    }

    #[test]
    fn a_dyad_and_a_triad_are_found_in_order_and_the_drawing_comes_back() {
        let linkage = Linkage::new(8, 0, &chain()).expect("mobility 1");
        let found = linkage.assemble(&[0.0]).expect("one input");
        let groups: Vec<_> = found.groups.iter().map(|group| (group.links.clone(), group.name.as_str())).collect();
        assert_eq!(groups, [(vec![2, 3], "dyad"), (vec![4, 5, 6, 7], "5#0")]);
        assert_eq!(found.status, Status::Complete);
        let at_rest = |assembly: &LinkageAssembly| assembly.poses.iter().flatten().all(|x| x.abs() < 1e-8);
        assert_eq!(found.assemblies.iter().filter(|assembly| at_rest(assembly)).count(), 1);
        let moved = linkage.assemble(&[0.05]).expect("one input");
        assert!(!moved.assemblies.is_empty());
        assert!(moved.assemblies.iter().all(|a| a.residual < 1e-12 && (a.poses[1][2] - 0.05).abs() < 1e-15));
    }

    #[test]
    fn what_moves_or_is_held_twice_is_named() {
        let mut free = chain();
        free[0].driven = false;
        let error = Linkage::new(8, 0, &free).unwrap_err().to_string();
        assert!(error.contains("still movable with the drivers held, mobility 1"), "{error}");
        let mut held = chain();
        held.push(joint([1, 3], 2.0, 2.0, false));
        let error = Linkage::new(8, 0, &held).unwrap_err().to_string();
        assert!(
            error.starts_with("links 3: overdetermined") || error.starts_with("links 2, 3: overdetermined"),
            "{error}"
        );
        let linkage = Linkage::new(8, 0, &chain()).expect("mobility 1");
        assert_eq!(linkage.assemble(&[]).unwrap_err(), LinkageError::InputCount { expected: 1, found: 0 });
        assert!(matches!(linkage.assemble(&[f64::NAN]), Err(LinkageError::NotFinite { .. })));
    }
}
