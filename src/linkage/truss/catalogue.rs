//! The Baranov trusses of up to nine links: which there are, and in how many ways each can be put together.
//!
//! Fixing any link of a truss leaves an Assur group; fixing none, the truss is the group with its ground. There are 1, 3 and 28 of five, seven
//! and nine links with revolute joints. The counts are those of all finite solutions for general dimensions, real and complex, found by
//! Groebner bases modulo two primes. A graph is recognised by an isomorphism.
//!
//! Source: Rojas, Thomas (2012), On closed-form solutions to the position analysis of Baranov trusses, Mech. Mach. Theory 50, 179-196,
//! which names Baranov's catalogue of 1952.

use super::graph::{GraphError, LinkGraph};

/// A truss of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BaranovTruss {
    /// How many links it has: 5, 7 or 9.
    pub links: usize,
    /// Its number among those with as many links, from 0.
    pub number: usize,
    /// In how many ways it can be put together, real and complex, for general dimensions.
    pub count: usize,
    edges: &'static str,
    /// The ground and the hidden link whose pencil has the fewest superfluous eigenvalues, measured.
    best: [usize; 2],
}

impl BaranovTruss {
    /// `7#0`.
    pub fn name(&self) -> String {
        format!("{}#{}", self.links, self.number)
    }

    /// The joints, as the links they join.
    ///
    /// ```
    /// use assur::linkage::baranov_trusses;
    /// let triad = baranov_trusses().next().expect("the catalogue begins with the triad");
    /// assert_eq!((triad.name().as_str(), triad.count), ("5#0", 6));
    /// assert_eq!(triad.edges(), [[0, 3], [1, 3], [2, 3], [0, 4], [1, 4], [2, 4]]);
    /// assert_eq!(baranov_trusses().count(), 32);
    /// ```
    pub fn edges(&self) -> Vec<[usize; 2]> {
        let digit = |byte: u8| usize::from(byte - b'0');
        self.edges.split(' ').map(|edge| [digit(edge.as_bytes()[0]), digit(edge.as_bytes()[1])]).collect()
    }
}

/// All trusses of the catalogue, by links and number.
pub fn baranov_trusses() -> impl Iterator<Item = BaranovTruss> {
    TABLE.iter().map(|&(links, number, count, edges, best)| BaranovTruss { links, number, count, edges, best })
}

/// A truss of the catalogue found in a graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Recognised {
    pub(super) truss: BaranovTruss,
    /// Ground and hidden link to begin with, in the graph's own numbers.
    pub(super) best: [usize; 2],
}

/// The truss that a graph is, whatever its links are called.
pub(super) fn recognise(graph: &LinkGraph) -> Option<Recognised> {
    let own = Neighbours::of(graph.links, &graph.edges);
    baranov_trusses().filter(|truss| truss.links == graph.links).find_map(|truss| {
        let places = own.isomorphism_from(&Neighbours::of(truss.links, &truss.edges()))?;
        Some(Recognised { truss, best: truss.best.map(|link| places[link]) })
    })
}

/// For each link the set of its neighbours, and what tells links apart at first sight.
struct Neighbours {
    sets: Vec<u32>,
    marks: Vec<(u32, Vec<u32>)>,
}

impl Neighbours {
    fn of(links: usize, edges: &[[usize; 2]]) -> Self {
        let mut sets = vec![0u32; links];
        for &[i, j] in edges {
            sets[i] |= 1 << j;
            sets[j] |= 1 << i;
        }
        let members = |set: u32| (0..links).filter(move |&j| set >> j & 1 == 1);
        let mark = |&set: &u32| {
            let mut degrees: Vec<u32> = members(set).map(|j| sets[j].count_ones()).collect();
            degrees.sort_unstable();
            (set.count_ones(), degrees)
        };
        let marks = sets.iter().map(mark).collect();
        Self { sets, marks }
    }

    /// Where each link of the other graph lies in this one.
    fn isomorphism_from(&self, other: &Self) -> Option<Vec<usize>> {
        let sorted = |marks: &[(u32, Vec<u32>)]| {
            let mut marks = marks.to_vec();
            marks.sort();
            marks
        };
        if sorted(&self.marks) != sorted(&other.marks) {
            return None;
        }
        let mut places = Vec::new();
        self.extend(other, &mut places).then_some(places)
    }

    fn extend(&self, other: &Self, places: &mut Vec<usize>) -> bool {
        let next = places.len();
        if next == self.sets.len() {
            return true;
        }
        for place in 0..self.sets.len() {
            let adjacent = |k: usize| (self.sets[place] >> places[k] & 1, other.sets[next] >> k & 1);
            let fits = !places.contains(&place)
                && self.marks[place] == other.marks[next]
                && (0..next).all(|k| adjacent(k).0 == adjacent(k).1);
            if fits {
                places.push(place);
                if self.extend(other, places) {
                    return true;
                }
                places.pop();
            }
        }
        false
    }
}

/// Links, number, count, joints, best ground and hidden link.
type Entry = (usize, usize, usize, &'static str, [usize; 2]);

#[rustfmt::skip]
const TABLE: [Entry; 32] = [
    (5, 0, 6, "03 13 23 04 14 24", [0, 3]),
    (7, 0, 18, "04 14 25 35 45 06 16 26 36", [0, 6]),
    (7, 1, 16, "03 04 14 15 25 35 06 16 26", [0, 2]),
    (7, 2, 14, "03 13 04 24 15 25 06 16 26", [0, 5]),
    (9, 0, 52, "06 16 26 36 07 17 47 57 28 38 48 58", [0, 8]),
    (9, 1, 54, "05 06 16 26 07 37 47 18 28 38 48 58", [1, 3]),
    (9, 2, 48, "05 06 16 26 07 17 37 47 28 38 48 58", [2, 7]),
    (9, 3, 48, "05 15 06 26 27 37 47 57 18 38 48 68", [0, 3]),
    (9, 4, 42, "05 15 06 26 37 47 57 67 18 28 38 48", [1, 6]),
    (9, 5, 54, "05 15 26 36 27 37 47 57 08 18 48 68", [0, 2]),
    (9, 6, 48, "05 15 06 26 36 07 17 47 18 28 38 48", [1, 2]),
    (9, 7, 48, "05 15 06 26 36 07 17 47 28 38 48 58", [1, 2]),
    (9, 8, 40, "05 15 06 26 36 17 27 47 08 18 38 48", [2, 8]),
    (9, 9, 40, "05 15 06 26 36 17 27 47 28 38 48 58", [0, 4]),
    (9, 10, 42, "05 15 26 36 56 07 17 47 08 28 38 48", [2, 7]),
    (9, 11, 42, "05 15 26 36 56 07 27 47 08 18 38 48", [2, 8]),
    (9, 12, 56, "04 15 06 16 26 07 17 37 28 38 48 58", [0, 5]),
    (9, 13, 52, "04 15 06 16 26 17 37 47 08 28 38 58", [4, 8]),
    (9, 14, 44, "04 15 06 16 26 37 47 57 18 28 38 48", [0, 3]),
    (9, 15, 44, "04 05 15 16 26 07 27 37 18 28 38 48", [2, 5]),
    (9, 16, 36, "04 05 15 16 26 27 37 47 08 18 28 38", [1, 4]),
    (9, 17, 48, "04 05 15 26 36 17 47 67 08 18 28 38", [0, 2]),
    (9, 18, 38, "04 05 15 16 26 36 27 37 47 08 18 28", [0, 3]),
    (9, 19, 50, "04 15 25 06 16 36 07 27 37 18 28 48", [0, 5]),
    (9, 20, 46, "04 15 25 06 16 36 27 37 47 08 18 28", [1, 4]),
    (9, 21, 46, "04 15 25 06 16 36 27 37 47 08 38 58", [0, 2]),
    (9, 22, 30, "04 14 05 25 16 36 27 37 08 18 28 38", [4, 7]),
    (9, 23, 40, "04 14 05 25 16 36 07 27 37 18 28 38", [0, 1]),
    (9, 24, 46, "04 14 05 25 16 36 07 27 37 18 38 58", [0, 6]),
    (9, 25, 50, "04 14 05 25 16 36 27 37 47 18 38 58", [0, 3]),
    (9, 26, 58, "03 14 25 06 16 26 27 37 47 18 38 58", [0, 1]),
    (9, 27, 50, "03 14 25 06 16 26 37 47 57 18 28 38", [1, 5]),
];

/// The name in the catalogue of the truss that these links form, link 0 its ground; `None` for dyads and more than nine links.
pub(in crate::linkage) fn group_name(links: usize, edges: &[[usize; 2]]) -> Result<Option<String>, GraphError> {
    let graph = LinkGraph::of_group(links, edges, 0)?;
    Ok(recognise(&graph).map(|found| found.truss.name()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_truss_is_a_group_and_recognised_under_other_names() {
        let shuffle = [4, 7, 1, 8, 0, 3, 6, 2, 5];
        for truss in baranov_trusses() {
            let mut names: Vec<usize> = shuffle.into_iter().filter(|&name| name < truss.links).collect();
            for _ in 0..3 {
                names.rotate_left(2);
                let edges: Vec<_> = truss.edges().into_iter().rev().map(|edge| edge.map(|link| names[link])).collect();
                let graph = LinkGraph::of_group(truss.links, &edges, 0).expect("an Assur group");
                let found = recognise(&graph).expect("is in the catalogue");
                assert_eq!(found.truss, truss);
                assert_ne!(found.best[0], found.best[1]);
            }
        }
    }
}
