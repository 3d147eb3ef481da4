//! Places reached in every orientation, of legs with ranges of joints 1 and 3 in both working modes.
//!
//! What such a leg does not allow is denied by both modes at once. Where joint 1 ends in one mode while joint 3 ends in the other, a corner of what is denied opens, and `C`
//! moves on a coupler curve of that one leg. To the circles and lines of [`super::super::total`] these curves are added; all are divided where they meet, and membership on
//! both sides of each piece decides it. Isolated points are not sought here.
//! With links of equal length the coupler curve falls apart into circles: about the elbow, about the base pivot, and at the orientation at which the links are parallel.

use super::super::arrangement::Bound;
use super::super::limits::{ActiveLimit, Limit};
use super::super::reach::Reach;
use super::super::region::Region;
use super::super::region::WorkspaceKind;
use super::coupled::{Branch, Coupled};
use super::curves::{Course, Curves, Surface, surfaces};
use super::motion::Motion;
use super::outline::{Look, Reached, Tracer};
use super::surface::{Place, quarter};
use crate::linkage::Triad;
use crate::plane::{Meeting, PhiRange, direction};

/// A place nearer to a circle or a line than this share of the mechanism's length is on it: the same as for vertices (error bound: a pose's roundings, some thousand).
const ON: f64 = 1e-11;

/// Where a branch is compared with a circle or a line. The two links of one leg make a kite, half of whose curve is the circle about the pin between them.
const WITHIN: [f64; 3] = [0.21, 0.5, 0.83];

/// What a candidate is called, and the limits held if it is a coupler curve.
#[derive(Clone, Debug)]
pub(super) struct Named {
    active: Vec<ActiveLimit>,
    pair: Option<[Limit; 2]>,
    /// Whether another candidate runs along it throughout.
    pub(super) double: bool,
}

impl Reach {
    /// The region that circles and lines bound, and the coupler curves of legs whose modes differ.
    pub(in super::super) fn every(&self, bounds: &[Bound], range: Option<&PhiRange>, reached: &Reached<'_>) -> Region {
        let (curves, named) = candidates(self, bounds, range);
        let mut tracer = Tracer::of_candidates(self, curves, named);
        tracer.cross();
        tracer.outline(reached).workspace(&WorkspaceKind::Dextrous).region
    }
}

/// The look of a candidate's piece: nothing is known of it but its sides.
pub(super) fn look(curves: &Curves, named: &[Named], curve: usize, t: f64) -> Option<Look> {
    let point = curves.at(curve, t);
    let outward = quarter(point.velocity).try_normalize(0.0)?;
    let Named { active, pair, .. } = named[curve].clone();
    Some(Look { at: point.at, phi: None, outward, either: true, active, pair })
}

/// Two limits of one leg, of the joints 1 and 3, each of one mode and not of the same.
fn crossed(one: &Surface, other: &Surface) -> Option<[Limit; 2]> {
    if one.leg != other.leg || one.upright || other.upright {
        return None;
    }
    let ends = |surface: &Surface| surface.limits[0].cause.joint();
    if !matches!((ends(one), ends(other)), (Some(0), Some(2)) | (Some(2), Some(0))) {
        return None;
    }
    let pairs = one.limits.iter().flat_map(|first| other.limits.iter().map(move |second| [*first, *second]));
    pairs.into_iter().find(|[first, second]| first.mode.is_some() && second.mode.is_some() && first.mode != second.mode)
}

fn candidates(reach: &Reach, bounds: &[Bound], range: Option<&PhiRange>) -> (Curves, Vec<Named>) {
    let size = reach.size();
    let mut all = Curves::empty(reach);
    let mut named: Vec<Named> = Vec::new();
    for bound in bounds {
        let active = || bound.active.iter().copied();
        let known = all.curves.iter().position(|curve| match curve.course {
            Course::Upright { on, .. } => on.meet(&bound.carrier, ON * size) == Meeting::Same,
            _ => false,
        });
        match known {
            Some(known) => {
                for name in active() {
                    if !named[known].active.contains(&name) {
                        named[known].active.push(name);
                    }
                }
            }
            None => {
                all.push(Course::Upright { on: bound.carrier, surface: 0 });
                named.push(Named { active: active().collect(), pair: None, double: false });
            }
        }
    }
    let surfaces = surfaces(reach, size);
    for one in 0..surfaces.len() {
        for other in one + 1..surfaces.len() {
            let Some(pair) = crossed(&surfaces[one], &surfaces[other]) else { continue };
            let (curve, frozen) = Coupled::new(surfaces[one].form, surfaces[other].form);
            // Equal links make a parallelogram at one orientation: both limits hold all along a circle.
            for phi in frozen.into_iter().filter(|&phi| range.is_none_or(|range| range.contains(phi))) {
                all.push(Course::Upright { on: surfaces[one].form.carrier(direction(phi)), surface: 0 });
                let active = pair.iter().map(Limit::active).collect();
                named.push(Named { active, pair: None, double: false });
            }
            let Some(curve) = curve else { continue };
            let coupled = all.coupled.len();
            all.coupled.push((curve, [one, other]));
            let first = all.curves.len();
            all.first_branch.push(first);
            for branch in curve.branches() {
                let own = all.push(Course::Coupled { coupled, branch });
                let double = all.curves[..first].iter().any(|other| match other.course {
                    Course::Upright { on, .. } => {
                        (WITHIN.iter()).all(|&t| on.distance(all.at(own, t).at).abs() <= ON * size)
                    }
                    _ => false,
                });
                named.push(Named { active: pair.iter().map(Limit::active).collect(), pair: Some(pair), double });
            }
            let mut places: Vec<(Place, f64)> = Vec::new();
            // Where one of them is stationary in the orientation: there the curve touches a circle or a line.
            for [held, met] in [[one, other], [other, one]] {
                for motion in Motion::stationary(&surfaces[held].form) {
                    let found = motion.meets(&surfaces[met].form, all.tol);
                    places.extend(found.into_iter().map(|t| (motion.place(t), motion.phi(t))));
                }
                for phi in range.into_iter().flat_map(|range| [range.from, range.to()]) {
                    let motion = Motion::sliding(phi, surfaces[held].form.carrier(direction(phi)));
                    let found = motion.meets(&surfaces[met].form, all.tol);
                    places.extend(found.into_iter().map(|t| (motion.place(t), phi)));
                }
            }
            // Where a third limit of the leg is met as well.
            for (third, surface) in surfaces.iter().enumerate() {
                if surface.leg != surfaces[one].leg || [one, other].contains(&third) {
                    continue;
                }
                let dyads = [one, other, third].map(|k| surfaces[k].limits[0].dyad);
                let Ok(triad) = Triad::new(dyads) else { continue };
                places.extend(triad.real_modes().modes().iter().map(|mode| {
                    let turn = direction(mode.pose.phi);
                    (Place { c: [mode.pose.x, mode.pose.y].into(), turn }, mode.pose.phi)
                }));
            }
            for (place, phi) in places {
                mark(&mut all, coupled, first, &place, phi);
            }
        }
    }
    all.mark_branch_ends();
    all.surfaces = surfaces;
    (all, named)
}

/// Marks a pose on its coupler curve and on the circles and lines that pass it.
fn mark(all: &mut Curves, coupled: usize, first: usize, place: &Place, phi: f64) {
    let near = ON * all.size;
    let (branch, t, off) = all.coupled[coupled].0.locate(place, phi);
    let branches: Vec<Branch> = all.coupled[coupled].0.branches().collect();
    let Some(k) = branches.into_iter().position(|own| own == branch).filter(|_| off <= near) else { return };
    let vertex = all.vertex(place.c);
    all.mark(first + k, t, vertex);
    for curve in 0..all.curves.len() {
        if let Course::Upright { on, .. } = all.curves[curve].course
            && on.distance(place.c).abs() <= near
        {
            all.mark(curve, on.parameter(place.c), vertex);
        }
    }
}
