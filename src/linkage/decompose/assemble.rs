//! The tree of a linkage's assemblies, group by group.

use nalgebra::Vector2;

use super::describe::{Linkage, LinkageError, LinkageJoint};
use super::motion::Motion;
use super::small::{Answer, Bound, assemble_dyad, assemble_triad};
use super::take_apart::{End, Means, Plan};
use crate::linkage::Status;
use crate::linkage::truss::{Truss, TrussJoint};

/// Leaves of the tree.
const MOST_ASSEMBLIES: usize = 100_000;

/// One of the Assur groups of a linkage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkageGroup {
    /// Its links; links that a driver holds together stand next to each other.
    pub links: Vec<usize>,
    /// Its joints, outer, inner, outer: `dyad RRP`; the legs of a triad: `triad RR-RR-PR`, or `class IV group RR-RR-RR` where what is known is one of
    /// the three; of larger groups the truss that it forms with its ground: `7#2`.
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
    /// How many of the group's assemblies meet here: more than 1 at a dead centre.
    pub multiplicity: usize,
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
    /// The displacement of each joint from the reference assembly, of its second link against its first: radians in (-pi, pi], or a length.
    pub displacements: Vec<f64>,
    /// Largest gap at a joint of the assembled linkage over its size: the distance of what should coincide, of a slider the distance
    /// from its axis and the slant of the one axis against the other.
    pub residual: f64,
}

/// Every assembly of a linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageAssemblies {
    /// The groups, in the order of assembly.
    pub groups: Vec<LinkageGroup>,
    /// The tree, parents before their children.
    pub nodes: Vec<LinkageNode>,
    /// Its leaves that reach the last group.
    pub assemblies: Vec<LinkageAssembly>,
    /// Branches that end before, since a group has no real assembly there.
    pub dead_ends: usize,
    /// `Complete` where every group's answer was; else the worst of them.
    pub status: Status,
}

/// The tree while it grows.
struct Tree {
    nodes: Vec<LinkageNode>,
    leaves: Vec<(Option<usize>, Vec<Motion>)>,
    dead_ends: usize,
    status: Status,
}

impl Linkage {
    /// Every assembly for given inputs: of each driven joint the displacement of its second link against the first, from the reference
    /// assembly, in radians or the drawing's length unit, in the order of the joints.
    ///
    /// **Accuracy:** dyads and triads exactly counted, larger groups as [`Truss::assemble`]; residuals are measured on the whole linkage.
    /// **Errors:** a wrong number of inputs, numbers that are not finite or leave the range, more combinations than a hundred thousand.
    /// **Cost:** each group once for each branch that reaches it, 0.1 to 1 ms for dyads and triads.
    pub fn assemble(&self, inputs: &[f64]) -> Result<LinkageAssemblies, LinkageError> {
        let expected = self.inputs();
        if inputs.len() != expected {
            return Err(LinkageError::InputCount { expected, found: inputs.len() });
        }
        if let Some((number, &value)) = (1..).zip(inputs).find(|(_, value)| !value.is_finite()) {
            return Err(LinkageError::NotFinite { what: format!("input {number}"), value });
        }
        let in_body = self.links_in_bodies(inputs);
        let bodies = 1 + self.plans.iter().map(|plan| plan.members.len()).sum::<usize>();
        let mut start = vec![None; bodies];
        start[0] = Some(Motion::REST);
        let mut tree = Tree { nodes: Vec::new(), leaves: Vec::new(), dead_ends: 0, status: Status::Complete };
        self.grow(&in_body, 0, None, &start, &mut tree)?;
        let group = |plan: &Plan| LinkageGroup { links: self.links_of(&plan.members), name: plan.name.clone() };
        let groups = self.plans.iter().map(group).collect();
        let assemblies = tree.leaves.iter().map(|(leaf, motions)| self.leaf(&tree, *leaf, motions, &in_body)).collect();
        let Tree { nodes, dead_ends, status, .. } = tree;
        Ok(LinkageAssemblies { groups, nodes, assemblies, dead_ends, status })
    }

    /// Where each link lies in its body's frame, which is that of one of its links.
    fn links_in_bodies(&self, inputs: &[f64]) -> Vec<Motion> {
        let mut known: Vec<Option<Motion>> = vec![None; self.links];
        let of_second = |(joint, &input): (&LinkageJoint, &f64)| {
            let motion = match joint.direction() {
                None => Motion::about(joint.place(), input),
                Some(direction) => Motion::along(direction, input),
            };
            (joint.links, motion)
        };
        let driven: Vec<([usize; 2], Motion)> =
            self.joints.iter().filter(|joint| joint.driven).zip(inputs).map(of_second).collect();
        let others = (0..self.links).filter(|&link| link != self.ground);
        for start in std::iter::once(self.ground).chain(others) {
            if known[start].is_some() {
                continue;
            }
            known[start] = Some(Motion::REST);
            // As often as there are links: drivers may come in any order.
            for _ in 0..self.links {
                for ([i, j], motion) in &driven {
                    match (known[*i], known[*j]) {
                        (Some(first), None) => known[*j] = Some(first.after(motion)),
                        (None, Some(second)) => known[*i] = Some(second.after(&motion.inverse())),
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
        tree: &mut Tree,
    ) -> Result<(), LinkageError> {
        let Some(plan) = self.plans.get(group) else {
            if tree.leaves.len() >= MOST_ASSEMBLIES {
                return Err(LinkageError::TooMany { most: MOST_ASSEMBLIES });
            }
            tree.leaves.push((parent, motions.iter().map(|motion| motion.unwrap_or(Motion::REST)).collect()));
            return Ok(());
        };
        let Answer { assemblies, status } = self.assemble_group(plan, in_body, motions, group)?;
        // Undecided is worse than a motion.
        if status == Status::Undecided || (status == Status::SelfMotion && tree.status == Status::Complete) {
            tree.status = status;
        }
        if assemblies.is_empty() {
            tree.dead_ends += 1;
        }
        for (number, (frames, multiplicity)) in (1..).zip(assemblies) {
            let mut next = motions.to_vec();
            for (member, frame) in plan.members.iter().zip(frames) {
                next[*member] = Some(frame);
            }
            tree.nodes.push(LinkageNode { group, parent, number, multiplicity, status });
            let node = tree.nodes.len() - 1;
            self.grow(in_body, group + 1, Some(node), &next, tree)?;
        }
        Ok(())
    }

    /// The real assemblies of a group on known places. Number 0 of the group is what is known, in the base frame; its members are in their own.
    fn assemble_group(
        &self,
        plan: &Plan,
        in_body: &[Motion],
        motions: &[Option<Motion>],
        group: usize,
    ) -> Result<Answer, LinkageError> {
        let frame = |node: usize, end: &End| match node {
            0 => motions[end.body].unwrap_or(Motion::REST).after(&in_body[end.link]),
            _ => in_body[end.link],
        };
        let bounds: Vec<Bound> = plan
            .edges
            .iter()
            .map(|edge| {
                let frames = [0, 1].map(|side| frame(edge.nodes[side], &edge.ends[side]));
                Bound {
                    nodes: edge.nodes,
                    places: [0, 1].map(|side| frames[side].of(edge.ends[side].at)),
                    directions: edge.direction.map(|direction| frames.map(|frame| frame.turn * direction)),
                }
            })
            .collect();
        let answer = match plan.means {
            Means::Dyad => assemble_dyad(&bounds),
            Means::Triad => assemble_triad(&plan.edges, &bounds),
            Means::Truss => {
                let joint = |bound: &Bound| {
                    let at = bound.places.map(|z| Vector2::new(z.re, z.im));
                    TrussJoint { links: bound.nodes, at }
                };
                let joints: Vec<TrussJoint> = bounds.iter().map(joint).collect();
                let truss = Truss::new(plan.members.len() + 1, &joints, 0);
                truss.map(|truss| assemble_truss(&truss)).map_err(Into::into)
            }
        };
        answer.map_err(|error| LinkageError::Group { group: group + 1, error })
    }

    fn leaf(&self, tree: &Tree, leaf: Option<usize>, motions: &[Motion], in_body: &[Motion]) -> LinkageAssembly {
        let mut choice = Vec::new();
        let mut node = leaf;
        while let Some(number) = node {
            choice.push(tree.nodes[number].number);
            node = tree.nodes[number].parent;
        }
        choice.reverse();
        let placed: Vec<Motion> =
            (0..self.links).map(|link| motions[self.bodies[link]].after(&in_body[link])).collect();
        let mut gap = 0.0f64;
        let mut displacements = Vec::with_capacity(self.joints.len());
        for joint in &self.joints {
            let [first, second] = joint.links.map(|link| placed[link]);
            let [a, b] = [first, second].map(|motion| motion.of(joint.place()));
            match joint.direction() {
                None => {
                    gap = gap.max((b - a).norm());
                    displacements.push((second.turn * first.turn.conj()).arg());
                }
                Some(direction) => {
                    let unit = direction / direction.norm();
                    // Along the first link's axis, and across it.
                    let way = (b - a) * (first.turn * unit).conj();
                    let slant = (second.turn - first.turn).norm() * self.size;
                    gap = gap.max(way.im.abs()).max(slant);
                    displacements.push(way.re);
                }
            }
        }
        let poses = placed.iter().map(|motion| [motion.origin.re, motion.origin.im, motion.turn.arg()]).collect();
        let residual = if self.size > 0.0 { gap / self.size } else { gap };
        LinkageAssembly { choice, poses, displacements, residual }
    }
}

fn assemble_truss(truss: &Truss) -> Answer {
    let answer = truss.assemble();
    let motions = |assembly| {
        let frames = truss.link_frames(assembly).into_iter().skip(1);
        frames.map(|(origin, turn)| Motion { origin, turn }).collect::<Vec<Motion>>()
    };
    let assemblies = answer.real().map(|assembly| (motions(assembly), assembly.multiplicity)).collect();
    Answer { assemblies, status: answer.status }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joint(links: [usize; 2], x: f64, y: f64) -> LinkageJoint {
        LinkageJoint::revolute(links, Vector2::new(x, y))
    }

    /// A crank and dyad whose coupler carries one leg of a triad.
    fn chain() -> Vec<LinkageJoint> {
        vec![
            joint([0, 1], 0.0, 0.0).driven(),
            joint([1, 2], 1.0, 1.0),
            joint([2, 3], 4.0, 3.0),
            joint([3, 0], 5.0, 0.0),
            joint([2, 4], 3.0, 4.0),
            joint([4, 7], 4.0, 6.0),
            joint([0, 5], 8.0, 0.0),
            joint([5, 7], 7.0, 5.0),
            joint([0, 6], 9.0, 3.0),
            joint([6, 7], 6.0, 7.0),
        ]
    }

    #[test]
    fn a_dyad_and_a_triad_are_found_in_order_and_the_drawing_comes_back() {
        let linkage = Linkage::new(8, 0, &chain()).expect("mobility 1");
        let found = linkage.assemble(&[0.0]).expect("one input");
        let groups: Vec<_> = found.groups.iter().map(|group| (group.links.clone(), group.name.as_str())).collect();
        assert_eq!(groups, [(vec![2, 3], "dyad RRR"), (vec![4, 5, 6, 7], "triad RR-RR-RR")]);
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
        held.push(joint([1, 3], 2.0, 2.0));
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
