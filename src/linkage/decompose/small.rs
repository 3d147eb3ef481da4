//! Dyads and triads on known places, with turning and sliding joints in any position.
//!
//! Two links of the group are chosen as base and platform: in a dyad the two that share a pivot, in a triad the two with three joints. Every
//! other link is a limb between them, one of RR, PR, RP and PP, so that a dyad is a [`PinnedDyad`] and a triad a [`Triad`], whichever of the
//! links the ground is. Both are solved exactly; what comes out is turned back until what is known is at rest.

use num_complex::Complex64;

use super::describe::GroupError;
use super::motion::Motion;
use super::take_apart::{Edge, platforms};
use crate::linkage::group::{Dyad, Offset, Pose, Triad};
use crate::linkage::pinned::PinnedDyad;
use crate::linkage::{Assemblies, Status};
use nalgebra::Vector2;

/// A joint of a group with its numbers in the frames of both its links.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    pub(super) nodes: [usize; 2],
    pub(super) places: [Complex64; 2],
    pub(super) directions: Option<[Complex64; 2]>,
}

/// Every real way to put a group together.
pub(super) struct Answer {
    /// Where each member of the group is, and how many assemblies meet there.
    pub(super) assemblies: Vec<(Vec<Motion>, usize)>,
    pub(super) status: Status,
}

/// Axes whose sine is below this are parallel: a link between them slides freely (heuristic: what rounding leaves of parallels).
const PARALLEL: f64 = 1e-12;

/// The joint between two nodes.
fn between(bounds: &[Bound], a: usize, b: usize) -> &Bound {
    let found = bounds.iter().find(|bound| bound.nodes == [a, b] || bound.nodes == [b, a]);
    found.expect("the graph of the group was checked")
}

/// A joint as one of its links has it.
#[derive(Clone, Copy)]
struct Side {
    place: Complex64,
    direction: Option<Complex64>,
}

impl Bound {
    fn of(&self, node: usize) -> Side {
        let side = usize::from(self.nodes[1] == node);
        Side { place: self.places[side], direction: self.directions.map(|both| both[side]) }
    }
}

/// A link between base and platform: its joint to either, as seen from base, itself, itself and platform.
struct Limb {
    base: Side,
    inner: [Side; 2],
    platform: Side,
}

/// The rotation that takes one direction to another.
fn turn(to: Complex64, from: Complex64) -> Complex64 {
    let turn = to * from.conj();
    turn / turn.norm()
}

fn vector(z: Complex64) -> Vector2<f64> {
    Vector2::new(z.re, z.im)
}

impl Limb {
    fn new(bounds: &[Bound], base: usize, limb: usize, platform: usize) -> Self {
        let (first, second) = (between(bounds, base, limb), between(bounds, limb, platform));
        Self { base: first.of(base), inner: [first.of(limb), second.of(limb)], platform: second.of(platform) }
    }

    /// The rotation of the limb against the base where a slider gives it, and of the limb against the platform likewise.
    fn turns(&self) -> [Option<Complex64>; 2] {
        let turn = |outer: &Side, inner: &Side| Some(turn(outer.direction?, inner.direction?));
        [turn(&self.base, &self.inner[0]), turn(&self.platform, &self.inner[1])]
    }

    fn dyad(&self) -> Dyad {
        let span = self.inner[1].place - self.inner[0].place;
        match (self.turns(), self.base.direction, self.platform.direction) {
            ([Some(on_base), Some(on_platform)], ..) => Dyad::PP { phi: (on_base * on_platform.conj()).arg() },
            ([Some(on_base), None], Some(u), _) => {
                let a = self.base.place + on_base * span;
                Dyad::PR { a: vector(a), u: vector(u), b: vector(self.platform.place) }
            }
            ([None, Some(on_platform)], _, Some(v)) => {
                let b = self.platform.place - on_platform * span;
                Dyad::RP { a: vector(self.base.place), b: vector(b), v: vector(v), offset: Offset::Distance(0.0) }
            }
            _ => Dyad::RR { a: vector(self.base.place), b: vector(self.platform.place), length: span.norm() },
        }
    }

    /// Where the limb is in the base's frame, once the platform is placed; `None` where it keeps a freedom of its own.
    fn placed(&self, platform: &Motion) -> Option<Motion> {
        let [first, second] = self.inner.map(|side| side.place);
        let end = platform.of(self.platform.place);
        match (self.turns(), self.base.direction, self.platform.direction) {
            ([Some(turn), Some(_)], Some(u), Some(v)) => {
                // Along the base's guide until the second axis is reached.
                let start = self.base.place - turn * first;
                let axis = platform.turn * v;
                let cross = |a: Complex64, b: Complex64| a.re * b.im - a.im * b.re;
                let sine = cross(axis, u);
                if sine.abs() <= PARALLEL * axis.norm() * u.norm() {
                    return None;
                }
                let way = cross(axis, end - start - turn * second) / sine;
                Some(Motion { origin: start + u * way, turn })
            }
            ([Some(turn), None], ..) => Some(Motion { origin: end - turn * second, turn }),
            ([None, Some(on_platform)], ..) => {
                let turn = platform.turn * on_platform;
                Some(Motion { origin: self.base.place - turn * first, turn })
            }
            _ => {
                let (now, drawn) = (end - self.base.place, second - first);
                if drawn == Complex64::ZERO || now == Complex64::ZERO {
                    return None;
                }
                let turn = turn(now, drawn);
                Some(Motion { origin: self.base.place - turn * first, turn })
            }
        }
    }
}

/// A dyad: members 1 and 2.
pub(super) fn assemble_dyad(bounds: &[Bound]) -> Result<Answer, GroupError> {
    // A pivot of what is known where there is one; sliders alone were refused.
    let pin = bounds.iter().filter(|bound| bound.directions.is_none()).min_by_key(|bound| bound.nodes.iter().min());
    let pin = pin.expect("a dyad has a pivot");
    let [base, platform] = pin.nodes;
    let limb = 3 - base - platform;
    let limbs = [(limb, Limb::new(bounds, base, limb, platform))];
    let (a, b) = (pin.of(base).place, pin.of(platform).place);
    let answer = PinnedDyad::new(vector(a), vector(b), limbs[0].1.dyad())?.assemble();
    Ok(gather(&answer, [base, platform], &limbs))
}

/// A triad, or the group of class IV that has the same joints: members 1 to 4.
pub(super) fn assemble_triad(edges: &[Edge], bounds: &[Bound]) -> Result<Answer, GroupError> {
    let ([base, platform], limbs) = platforms(edges);
    let limbs = limbs.map(|limb| (limb, Limb::new(bounds, base, limb, platform)));
    let answer = Triad::new(limbs.each_ref().map(|(_, limb)| limb.dyad()))?.assemble();
    Ok(gather(&answer, [base, platform], &limbs))
}

/// The frames of all members with node 0 at rest.
fn gather(answer: &Assemblies, [base, platform]: [usize; 2], limbs: &[(usize, Limb)]) -> Answer {
    let mut status = answer.status;
    let mut assemblies = Vec::new();
    for mode in &answer.modes {
        let Pose { x, y, phi } = mode.pose;
        let mut frames = vec![Motion::REST; limbs.len() + 2];
        frames[platform] = Motion { origin: Complex64::new(x, y), turn: Complex64::from_polar(1.0, phi) };
        debug_assert_eq!(frames[base], Motion::REST);
        let at = frames[platform];
        let mut whole = true;
        for (node, limb) in limbs {
            match limb.placed(&at) {
                Some(frame) => frames[*node] = frame,
                None => whole = false,
            }
        }
        if whole {
            let back = frames[0].inverse();
            assemblies.push((frames[1..].iter().map(|frame| back.after(frame)).collect(), mode.multiplicity));
        } else if status == Status::Complete {
            // A limb that moves on its own: a curve of assemblies.
            status = Status::SelfMotion;
        }
    }
    Answer { assemblies, status }
}
