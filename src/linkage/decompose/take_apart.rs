//! Which bodies form the next Assur group? The smallest set that what is known leaves no freedom.

use num_complex::Complex64;

use super::describe::{Linkage, LinkageError};
use crate::linkage::truss::{GraphError, MOST_LINKS, group_name};

/// Bodies whose subsets are searched for groups.
const MOST_BODIES: usize = 18;
/// Joints of one link closer than this part of the drawing's size are one, shared by all their links: drawings are rounded.
const COINCIDENT: f64 = 1e-12;

/// One body at a joint: the link of it that has the joint, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct End {
    pub(super) body: usize,
    pub(super) link: usize,
    pub(super) at: Complex64,
}

/// A slider between two bodies, or a pivot that two or more share.
#[derive(Clone, Debug)]
struct Condition {
    ends: Vec<End>,
    /// The joint, the first of those that share a pivot.
    joint: usize,
}

/// A joint of a group: its ends as numbers of the group, 0 for what is known and the members from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    pub(super) nodes: [usize; 2],
    pub(super) ends: [End; 2],
    /// The direction in the drawing, of a slider.
    pub(super) direction: Option<Complex64>,
}

/// How a group is put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Means {
    Dyad,
    Triad,
    Truss,
}

/// A group, ready to be put together.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    /// Its bodies.
    pub(super) members: Vec<usize>,
    pub(super) edges: Vec<Edge>,
    pub(super) means: Means,
    pub(super) name: String,
}

impl Linkage {
    pub(super) fn take_apart(&self, bodies: usize) -> Result<Vec<Plan>, LinkageError> {
        if bodies - 1 > MOST_BODIES {
            return Err(LinkageError::TooLarge { bodies: bodies - 1, most: MOST_BODIES });
        }
        let conditions = self.conditions();
        self.refuse_loops_of_sliders(&conditions, bodies)?;
        let everything = (1u32 << bodies) - 1;
        let members = |set: u32| (0..bodies).filter(|&body| set >> body & 1 == 1).collect::<Vec<usize>>();
        // What is known counts as one body: each condition takes two freedoms for every body of it but one.
        let masks: Vec<u32> = conditions
            .iter()
            .map(|condition| condition.ends.iter().fold(0, |mask, end| mask | 1 << end.body))
            .collect();
        let mobility = |set: u32, known: u32| {
            let taken = |mask: &u32| match (mask & set).count_ones() {
                0 => 0,
                inside => i64::from(inside) - i64::from(mask & known == 0),
            };
            3 * i64::from(set.count_ones()) - 2 * masks.iter().map(taken).sum::<i64>()
        };
        let mut known = 1u32;
        let mut plans = Vec::new();
        let mut sets: Vec<u32> = (1..=everything).collect();
        sets.sort_by_key(|set| set.count_ones());
        while known != everything {
            sets.retain(|set| set & known == 0);
            let tight = sets.iter().map(|&set| (set, mobility(set, known))).find(|(_, mobility)| *mobility <= 0);
            match tight {
                Some((set, 0)) => {
                    plans.push(self.plan(members(set), &conditions, known)?);
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
        Ok(plans)
    }

    /// The passive sliders, and the pivots with everything that shares them.
    fn conditions(&self) -> Vec<Condition> {
        let joints = &self.joints;
        let pivot = |k: usize| joints[k].direction().is_none();
        // Pivots in one place that share a link are one, by the smallest of their numbers.
        let mut shared: Vec<usize> = (0..joints.len()).collect();
        for second in (0..joints.len()).filter(|&k| pivot(k)) {
            for first in (0..second).filter(|&k| pivot(k)) {
                let (a, b) = (&joints[first], &joints[second]);
                let meet = a.links.iter().any(|link| b.links.contains(link));
                if meet && (a.at - b.at).norm() <= COINCIDENT * self.size {
                    let (kept, gone) = (shared[first].min(shared[second]), shared[first].max(shared[second]));
                    shared.iter_mut().filter(|own| **own == gone).for_each(|own| *own = kept);
                }
            }
        }
        let condition = |joint: usize| {
            let mut ends: Vec<End> = Vec::new();
            for (other, _) in joints.iter().zip(&shared).filter(|(_, own)| **own == joint) {
                for link in other.links {
                    let body = self.bodies[link];
                    if ends.iter().all(|end| end.body != body) {
                        ends.push(End { body, link, at: other.place() });
                    }
                }
            }
            Condition { ends, joint }
        };
        let passive = |joint: &usize| !joints[*joint].driven || pivot(*joint);
        let own = (0..joints.len()).filter(|&joint| shared[joint] == joint).filter(passive);
        // A driven pivot alone holds two links of one body.
        own.map(condition).filter(|condition| condition.ends.len() > 1).collect()
    }

    /// Bodies that sliders join are parallel for good: one that closes a loop of them says so twice.
    fn refuse_loops_of_sliders(&self, conditions: &[Condition], bodies: usize) -> Result<(), LinkageError> {
        let sliders = conditions.iter().filter(|condition| self.joints[condition.joint].direction().is_some());
        match loop_of(bodies, sliders.map(|condition| [0, 1].map(|k| condition.ends[k].body))) {
            Some(members) => Err(LinkageError::SlidersOnly { links: self.links_of(&members) }),
            None => Ok(()),
        }
    }

    fn plan(&self, members: Vec<usize>, conditions: &[Condition], known: u32) -> Result<Plan, LinkageError> {
        let node = |end: &End| {
            let member = members.iter().position(|&member| member == end.body).map(|place| place + 1);
            member.or((known >> end.body & 1 == 1).then_some(0))
        };
        let mut edges = Vec::new();
        let mut slider = None;
        for condition in conditions {
            // What is known first: it holds the others of a shared pivot.
            let mut ends: Vec<(usize, End)> =
                condition.ends.iter().filter_map(|end| node(end).map(|node| (node, *end))).collect();
            ends.sort_by_key(|(node, _)| *node);
            let direction = self.joints[condition.joint].direction();
            let Some((hub, others)) = ends.split_first() else { continue };
            for other in others.iter().filter(|other| other.0 > 0) {
                edges.push(Edge { nodes: [hub.0, other.0], ends: [hub.1, other.1], direction });
                if direction.is_some() {
                    slider = slider.or(Some(condition.joint));
                }
            }
        }
        // What is known has its orientation already, so a loop may close through it.
        let sliders = edges.iter().filter(|edge| edge.direction.is_some()).map(|edge| edge.nodes);
        if let Some(around) = loop_of(members.len() + 1, sliders) {
            let bodies: Vec<usize> =
                around.iter().filter_map(|node| node.checked_sub(1)).map(|place| members[place]).collect();
            return Err(LinkageError::SlidersOnly { links: self.links_of(&bodies) });
        }
        let pairs: Vec<[usize; 2]> = edges.iter().map(|edge| edge.nodes).collect();
        let links = || self.links_of(&members);
        let catalogued = group_name(members.len() + 1, &pairs).map_err(|error| match error {
            GraphError::Mobility { part, mobility, .. } => {
                let bodies: Vec<usize> =
                    part.iter().filter_map(|node| node.checked_sub(1)).map(|place| members[place]).collect();
                LinkageError::Rigid { links: self.links_of(&bodies), mobility }
            }
            _ => LinkageError::GroupTooLarge { links: links(), most: MOST_LINKS - 1 },
        })?;
        let means = match members.len() {
            2 => Means::Dyad,
            4 => Means::Triad,
            _ => Means::Truss,
        };
        if let (Means::Truss, Some(joint)) = (means, slider) {
            return Err(LinkageError::SliderInLargerGroup { links: links(), bodies: members.len(), joint });
        }
        let name = match means {
            Means::Dyad => dyad_name(&edges),
            Means::Triad => triad_name(&edges),
            Means::Truss => catalogued.unwrap_or_else(|| format!("group of {} links", members.len())),
        };
        Ok(Plan { members, edges, means, name })
    }
}

/// What hangs together with the first pair that closes a loop.
fn loop_of(nodes: usize, pairs: impl Iterator<Item = [usize; 2]>) -> Option<Vec<usize>> {
    let mut root: Vec<usize> = (0..nodes).collect();
    for pair in pairs {
        let [a, b] = pair.map(|node| root[node]);
        if a == b {
            return Some((0..nodes).filter(|&node| root[node] == a).collect());
        }
        root.iter_mut().filter(|own| **own == b).for_each(|own| *own = a);
    }
    None
}

fn letter(edge: &Edge) -> char {
    if edge.direction.is_some() { 'P' } else { 'R' }
}

/// `dyad RRP`: outer, inner, outer joint, the turning one first.
fn dyad_name(edges: &[Edge]) -> String {
    let [outer, inner] = [true, false].map(|outer| {
        let mut letters: Vec<char> = edges.iter().filter(|edge| edge.nodes.contains(&0) == outer).map(letter).collect();
        letters.sort_by(|a, b| b.cmp(a));
        letters
    });
    format!("dyad {}{}{}", outer[0], inner[0], outer[1])
}

/// The two links of a pentad with three joints, what is known first if it is one, and the three others.
pub(super) fn platforms(edges: &[Edge]) -> ([usize; 2], [usize; 3]) {
    let mut nodes: Vec<usize> = (0..5).collect();
    // Stable: among equals the smaller number comes first.
    nodes.sort_by_key(|node| std::cmp::Reverse(edges.iter().filter(|edge| edge.nodes.contains(node)).count()));
    ([nodes[0], nodes[1]], [nodes[2], nodes[3], nodes[4]])
}

/// `triad RR-PR-RR`: the legs, their outer joint first. Where what is known is one of the legs the group is of class IV.
fn triad_name(edges: &[Edge]) -> String {
    let (platforms, limbs) = platforms(edges);
    let limb = |limb: usize| {
        let joint = |platform: usize| {
            edges.iter().find(|edge| edge.nodes.contains(&platform) && edge.nodes.contains(&limb)).map_or('?', letter)
        };
        platforms.map(joint).iter().collect::<String>()
    };
    let kind = if platforms.contains(&0) { "triad" } else { "class IV group" };
    format!("{kind} {}", limbs.map(limb).join("-"))
}
