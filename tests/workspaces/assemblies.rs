//! Assemblies against a grid of the configuration space: what is surely joined, and what surely is not.
//!
//! Nodes are (x, y, phi) on a grid, once for each choice of the working modes that differ in reach. Two neighbours are surely joined where the way between
//! them, sampled, keeps every joint in its range; they may be joined only where every slack is greater than what a step of the grid can change it by. The two floods
//! from one pose hold the true assembly between them.

use std::f64::consts::TAU;

use assur::nalgebra::Rotation2;
use assur::workspace::{WorkspaceError, WorkspaceKind};
use assur::{JointKind, Manipulator, Pose};

use crate::membership::{modes_of, written};
use crate::models::{Case, Trouble, random_case, scale};
use crate::oracle::Oracle;
use crate::random::Random;
use crate::regions::Polygons;

/// Grid points across the plane and around the turn.
const ACROSS: usize = 40;
const AROUND: usize = 72;
/// Samples of a way between two neighbours.
const WAY: usize = 6;
/// What a polygon of a region may be off by, of the size.
const CHORD: f64 = 1e-3;

/// Legs whose two modes reach differently: those that slide along the base.
fn two_faced(robot: &Manipulator) -> [bool; 3] {
    [0, 1, 2].map(|k| robot.legs[k].joints[0] == JointKind::Prismatic)
}

struct Grid {
    sheets: Vec<(u32, Oracle)>,
    low: [f64; 2],
    step: [f64; 2],
}

impl Grid {
    fn of(case: &Case, low: [f64; 2], high: [f64; 2]) -> Self {
        let faced = two_faced(&case.robot);
        let bit = |k: usize| 1_u32 << k;
        let fits = |bits: &u32| {
            (0..3).all(|k| match case.modes {
                _ if !faced[k] => bits & bit(k) != 0,
                Some(signs) => (bits & bit(k) != 0) == signs[k],
                None => true,
            })
        };
        let sheets = (0..8).filter(fits).map(|bits| {
            // Legs that slide between two pivots, and cranks, reach the same in both modes.
            let signs = [0, 1, 2].map(|k| if faced[k] { bits & bit(k) != 0 } else { true });
            (bits, Oracle::of(&case.robot, Some(signs)))
        });
        let step = [0, 1].map(|k| (high[k] - low[k]) / (ACROSS - 1) as f64);
        Self { sheets: sheets.collect(), low, step }
    }

    fn len(&self) -> usize {
        self.sheets.len() * AROUND * ACROSS * ACROSS
    }

    /// Sheet, turn, and the place's two numbers of a node.
    fn split(node: usize) -> [usize; 4] {
        let (place, rest) = (node % (ACROSS * ACROSS), node / (ACROSS * ACROSS));
        [rest / AROUND, rest % AROUND, place / ACROSS, place % ACROSS]
    }

    fn node([sheet, turn, i, j]: [usize; 4]) -> usize {
        ((sheet * AROUND + turn) * ACROSS + i) * ACROSS + j
    }

    fn pose(&self, node: usize) -> ([f64; 2], f64) {
        let [_, turn, i, j] = Self::split(node);
        let at = [self.low[0] + i as f64 * self.step[0], self.low[1] + j as f64 * self.step[1]];
        (at, turn as f64 * TAU / AROUND as f64)
    }

    /// Neighbours in the same sheet.
    fn beside(node: usize) -> impl Iterator<Item = usize> {
        let [sheet, turn, i, j] = Self::split(node);
        let wrapped = [(turn + 1) % AROUND, (turn + AROUND - 1) % AROUND];
        let turned = wrapped.into_iter().map(move |turn| Self::node([sheet, turn, i, j]));
        let moved = [(1_i32, 0_i32), (-1, 0), (0, 1), (0, -1)].into_iter().filter_map(move |(di, dj)| {
            let (i, j) = (i as i32 + di, j as i32 + dj);
            let inside = (0..ACROSS as i32).contains(&i) && (0..ACROSS as i32).contains(&j);
            inside.then(|| Self::node([sheet, turn, i as usize, j as usize]))
        });
        turned.chain(moved)
    }

    /// The sheets that differ from one in the mode of one leg: their index and the leg.
    fn over(&self, sheet: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let bits = self.sheets[sheet].0;
        let of = move |(k, other): (usize, &(u32, Oracle))| {
            let differs = other.0 ^ bits;
            differs.is_power_of_two().then(|| (k, differs.trailing_zeros() as usize))
        };
        self.sheets.iter().enumerate().filter_map(of)
    }

    /// Whether a straight way between two poses keeps to a sheet.
    fn is_way(&self, sheet: usize, from: ([f64; 2], f64), to: ([f64; 2], f64), least: f64) -> bool {
        let turn = (to.1 - from.1 + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
        (0..=WAY).all(|k| {
            let t = k as f64 / WAY as f64;
            let at = [0, 1].map(|axis| from.0[axis] + t * (to.0[axis] - from.0[axis]));
            self.sheets[sheet].1.slack(at, from.1 + t * turn) >= least
        })
    }

    /// The nodes joined to one by `joined` within a sheet and `switched` across sheets.
    fn flood(
        &self,
        from: usize,
        joined: &dyn Fn(usize, usize) -> bool,
        switched: &dyn Fn(usize, usize, usize) -> bool,
    ) -> Vec<bool> {
        let mut seen = vec![false; self.len()];
        let mut open = vec![from];
        seen[from] = true;
        while let Some(node) = open.pop() {
            for next in Self::beside(node) {
                if !seen[next] && joined(node, next) {
                    seen[next] = true;
                    open.push(next);
                }
            }
            let [sheet, turn, i, j] = Self::split(node);
            for (other, leg) in self.over(sheet) {
                let next = Self::node([other, turn, i, j]);
                if !seen[next] && switched(node, next, leg) {
                    seen[next] = true;
                    open.push(next);
                }
            }
        }
        seen
    }
}

/// A random case with narrow ranges, so that it falls apart more often.
fn narrow_case(number: u64) -> Case {
    let troubles =
        [Trouble::None, Trouble::OneMode, Trouble::ReferenceInPivot, Trouble::Symmetric, Trouble::SimilarPlatform];
    let mut case = random_case(number, troubles[(number / 10 % 5) as usize]);
    let mut r = Random::new(0xa55e + number);
    for leg in &mut case.robot.legs {
        for joint in 0..3 {
            let slides = leg.joints[joint] == JointKind::Prismatic;
            if let (Some([low, high]), true) = (leg.limits[joint], slides) {
                let share = r.between(0.15, 1.0);
                leg.limits[joint] = Some([high - share * (high - low), high]);
            }
        }
    }
    case
}

#[test]
fn assemblies_hold_what_is_surely_joined_and_nothing_that_surely_is_not() {
    let (mut asked, mut parted) = (0, 0);
    let mut wrong: Vec<String> = Vec::new();
    for number in 0..20 * scale() {
        let case = narrow_case(number);
        let reach = case.robot.reach(&modes_of(&case)).expect("is covered");
        let all = match reach.workspace(&WorkspaceKind::Maximal) {
            Ok(workspace) => workspace.region,
            Err(WorkspaceError::Unbounded { .. }) => continue,
            Err(error) => panic!("{error}"),
        };
        let Some([x0, y0, x1, y1]) = all.bbox else { continue };
        let grid = Grid::of(&case, [x0, y0], [x1, y1]);
        let size = grid.sheets[0].1.size;
        let slack: Vec<f64> = (0..grid.len())
            .map(|node| {
                let (at, phi) = grid.pose(node);
                grid.sheets[Grid::split(node)[0]].1.slack(at, phi)
            })
            .collect();
        // Half a step of each coordinate moves a pivot by no more than this.
        let arm = case.robot.legs.iter().map(|leg| (leg.platform.at - case.robot.reference).norm()).fold(0.0, f64::max);
        let half = 0.5 * (grid.step[0].hypot(grid.step[1]) + arm * TAU / AROUND as f64);
        // A node may stand for its cell where some pose of the cell may be allowed.
        let lax: Vec<bool> = (0..grid.len())
            .map(|node| {
                let (at, phi) = grid.pose(node);
                grid.sheets[Grid::split(node)[0]].1.slack_within(at, phi, half) >= 0.0
            })
            .collect();
        let mut r = Random::new(0xb0b + number);
        let inner: Vec<usize> = (0..grid.len()).filter(|&node| slack[node] > 1e-3 * size).collect();
        if inner.is_empty() {
            continue;
        }
        for _ in 0..3 {
            let from = inner[(r.between(0.0, inner.len() as f64) as usize).min(inner.len() - 1)];
            let (at, phi) = grid.pose(from);
            let reference = case.robot.reference;
            let turned = Rotation2::new(phi) * reference;
            let pose = Pose::new(at[0] - turned.x, at[1] - turned.y, phi);
            // A pose names an assembly in whichever mode it is allowed: ask where it is in one only.
            let [_, turn, i, j] = Grid::split(from);
            let sheets = (0..grid.sheets.len()).filter(|&sheet| slack[Grid::node([sheet, turn, i, j])] > -0.1 * size);
            if sheets.count() > 1 {
                continue;
            }
            let region = match reach.assembly(&pose) {
                Ok(workspace) => workspace.region,
                Err(error) => {
                    wrong.push(format!("{}: {error}\n{}", case.kind, written(&case)));
                    continue;
                }
            };
            asked += 1;
            let sure = grid.flood(
                from,
                &|a, b| slack[b] > 0.0 && grid.is_way(Grid::split(a)[0], grid.pose(a), grid.pose(b), 0.0),
                &|a, b, leg| {
                    let (at, phi) = grid.pose(a);
                    let Some(to) = grid.sheets[0].1.merging(leg, at, phi) else { return false };
                    let near = slack[a] > 0.0 && slack[b] > 0.0;
                    let ways = [a, b].map(|node| Grid::split(node)[0]);
                    near && ways.iter().all(|&sheet| grid.is_way(sheet, (at, phi), (to, phi), -1e-9 * size))
                },
            );
            let perhaps = grid.flood(from, &|_, b| lax[b], &|a, b, leg| {
                let (at, phi) = grid.pose(a);
                lax[b] && grid.sheets[0].1.merging_gap(leg, at, phi) <= half
            });
            let places = |seen: &[bool]| {
                let mut out = vec![false; ACROSS * ACROSS];
                (0..seen.len()).filter(|&node| seen[node]).for_each(|node| out[node % (ACROSS * ACROSS)] = true);
                out
            };
            let (sure, perhaps) = (places(&sure), places(&perhaps));
            let polygons = Polygons::of(&region);
            let mut off: Vec<String> = Vec::new();
            let mut apart = false;
            for place in 0..ACROSS * ACROSS {
                let at = grid.pose(place).0;
                let clear = || polygons.distance(at) > CHORD * size;
                let inside = polygons.winding(at) != 0;
                apart |= !perhaps[place] && !reach.orientations(at.into()).is_empty();
                if sure[place] && !inside && clear() {
                    off.push(format!("{at:?} is reached, but missing"));
                } else if !perhaps[place] && inside && clear() {
                    off.push(format!("{at:?} cannot be reached, but is claimed"));
                }
            }
            parted += usize::from(apart);
            if !off.is_empty() {
                let first = off[..off.len().min(3)].join("\n  ");
                let count = off.len();
                wrong.push(format!(
                    "{}, from {:?}: area {} of {}, {count} places:\n  {first}\n{}",
                    case.kind,
                    [pose.x, pose.y, pose.phi],
                    region.area,
                    all.area,
                    written(&case)
                ));
            }
        }
    }
    let first = wrong[..wrong.len().min(3)].join("\n\n");
    assert!(
        wrong.is_empty(),
        "{} of {asked} assemblies wrong ({parted} surely parted); the first:\n{first}",
        wrong.len()
    );
    assert!(asked > 20 && parted > 0, "{asked} asked, {parted} parted: not much of a test");
}
