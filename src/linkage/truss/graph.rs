//! Links and joints as a graph: is it an Assur group, and which loops does it have?

use thiserror::Error;

/// Beyond this the pencil of a group (252 rows for eleven links) is no longer a sensible question.
pub(in crate::linkage) const MOST_LINKS: usize = 11;

/// Why links and joints make no Assur group. Links and joints are counted from 0, as in files.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum GraphError {
    /// Fewer than three links, or more than can be asked about.
    #[error("{links} links: must be from 3 to {}", MOST_LINKS)]
    LinkCount {
        /// How many there are.
        links: usize,
    },
    /// A joint names a link that is not there.
    #[error("joint {joint}: link {link} does not exist; there are {links}, counted from 0")]
    NoSuchLink {
        /// The joint.
        joint: usize,
        /// The link it names.
        link: usize,
        /// How many links there are.
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
    /// The ground is no link.
    #[error("ground {ground} does not exist; there are {links} links, counted from 0")]
    NoSuchGround {
        /// What the ground is said to be.
        ground: usize,
        /// How many links there are.
        links: usize,
    },
    /// Some part can move, or is rigid already, on its own; or the whole does not come out even.
    #[error("no Assur group: {} with {joints} {} between them, mobility {mobility}{}", named(.part), plural(*.joints), if *.whole { ", must be 0" } else { "; every part smaller than the whole must be movable (1 or more)" })]
    Mobility {
        /// The links of the part.
        part: Vec<usize>,
        /// The joints among them.
        joints: usize,
        /// `3 (links - 1) - 2 joints`.
        mobility: i64,
        /// Whether the part is the whole.
        whole: bool,
    },
}

fn plural(joints: usize) -> &'static str {
    if joints == 1 { "joint" } else { "joints" }
}

fn named(part: &[usize]) -> String {
    let links = part.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    format!("links {links}")
}

/// A link on a loop: where the loop enters it and where it leaves, as joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Passage {
    pub(super) link: usize,
    pub(super) enters: usize,
    pub(super) leaves: usize,
}

/// Links joined in pairs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct LinkGraph {
    pub(super) links: usize,
    pub(super) edges: Vec<[usize; 2]>,
}

impl LinkGraph {
    /// The graph, if it is that of an Assur group closed by its ground: mobility 0, and every smaller part movable.
    pub(super) fn of_group(links: usize, edges: &[[usize; 2]], ground: usize) -> Result<Self, GraphError> {
        if !(3..=MOST_LINKS).contains(&links) {
            return Err(GraphError::LinkCount { links });
        }
        if ground >= links {
            return Err(GraphError::NoSuchGround { ground, links });
        }
        for (joint, &[i, j]) in edges.iter().enumerate() {
            if let Some(&link) = [i, j].iter().find(|&&link| link >= links) {
                return Err(GraphError::NoSuchLink { joint, link, links });
            }
            if i == j {
                return Err(GraphError::SelfJoint { joint, link: i });
            }
        }
        // Small parts first: the smallest culprit is the clearest message.
        let everything = (1u32 << links) - 1;
        let mut parts: Vec<u32> = (1..=everything).filter(|part| part.count_ones() > 1).collect();
        parts.sort_by_key(|part| part.count_ones());
        for part in parts {
            let inside = |link: usize| part >> link & 1 == 1;
            let joints = edges.iter().filter(|&&[i, j]| inside(i) && inside(j)).count();
            let mobility = 3 * (i64::from(part.count_ones()) - 1) - 2 * joints as i64;
            let whole = part == everything;
            if if whole { mobility != 0 } else { mobility < 1 } {
                let part = (0..links).filter(|&link| inside(link)).collect();
                return Err(GraphError::Mobility { part, joints, mobility, whole });
            }
        }
        Ok(Self { links, edges: edges.to_vec() })
    }

    /// The joint through which each link hangs on a tree rooted in `root`, breadth first, and the order in which they are reached.
    pub(super) fn tree(&self, root: usize) -> (Vec<Option<usize>>, Vec<usize>) {
        let mut parent = vec![None; self.links];
        let mut order = vec![root];
        let mut next = 0;
        while next < order.len() {
            let link = order[next];
            next += 1;
            for (joint, &[i, j]) in self.edges.iter().enumerate() {
                let other = if i == link { j } else { i };
                if (i == link || j == link) && other != root && parent[other].is_none() {
                    parent[other] = Some(joint);
                    order.push(other);
                }
            }
        }
        (parent, order)
    }

    pub(super) fn across(&self, joint: usize, link: usize) -> usize {
        let [i, j] = self.edges[joint];
        if i == link { j } else { i }
    }

    /// As many independent loops as there are: each closes one joint that is not on a breadth-first tree.
    pub(super) fn loops(&self, root: usize) -> Vec<Vec<Passage>> {
        let (parent, order) = self.tree(root);
        let mut depth = vec![0usize; self.links];
        for &link in &order[1..] {
            if let Some(joint) = parent[link] {
                depth[link] = depth[self.across(joint, link)] + 1;
            }
        }
        let closing = (0..self.edges.len()).filter(|joint| !parent.contains(&Some(*joint)));
        let around = |closing: usize| {
            // Two walks up the tree, from both sides of the closing joint, until they meet.
            let [mut a, mut b] = self.edges[closing];
            let (mut a_from, mut b_from) = (closing, closing);
            let (mut ahead, mut behind) = (Vec::new(), Vec::new());
            while a != b {
                if depth[a] >= depth[b] {
                    let Some(up) = parent[a] else { break };
                    ahead.push(Passage { link: a, enters: a_from, leaves: up });
                    (a, a_from) = (self.across(up, a), up);
                } else {
                    let Some(up) = parent[b] else { break };
                    behind.push(Passage { link: b, enters: up, leaves: b_from });
                    (b, b_from) = (self.across(up, b), up);
                }
            }
            ahead.push(Passage { link: a, enters: a_from, leaves: b_from });
            ahead.extend(behind.into_iter().rev());
            ahead
        };
        closing.map(around).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PENTAD: [[usize; 2]; 6] = [[0, 3], [1, 3], [2, 3], [0, 4], [1, 4], [2, 4]];

    #[test]
    fn loops_run_from_joint_to_joint() {
        let graph = LinkGraph::of_group(5, &PENTAD, 0).expect("the triad");
        for root in 0..5 {
            let loops = graph.loops(root);
            assert_eq!(loops.len(), 2);
            for around in &loops {
                for (k, passage) in around.iter().enumerate() {
                    let next = around[(k + 1) % around.len()];
                    assert_eq!(passage.leaves, next.enters);
                    assert_eq!(graph.across(passage.leaves, passage.link), next.link);
                }
            }
        }
    }

    #[test]
    fn parts_that_are_rigid_or_loose_are_named() {
        // Links 0, 1, 2 form a dyad on their own.
        let edges = [[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 1]];
        let error = LinkGraph::of_group(5, &edges, 0).unwrap_err();
        assert_eq!(
            error.to_string(),
            "no Assur group: links 0, 1, 2 with 3 joints between them, mobility 0; every part smaller than the whole must be movable (1 or more)"
        );
        let error = LinkGraph::of_group(5, &PENTAD[..5], 0).unwrap_err();
        assert!(error.to_string().ends_with("mobility 2, must be 0"), "{error}");
        let error = LinkGraph::of_group(5, &[[0, 7]], 0).unwrap_err();
        assert_eq!(error.to_string(), "joint 0: link 7 does not exist; there are 5, counted from 0");
    }
}
