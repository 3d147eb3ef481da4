//! Total-orientation and dextrous workspaces: every orientation of a range is allowed.
//!
//! The complement is a union over the orientations, so the fold rule applies to it: a place bounds the workspace where one limit is at its *worst*
//! orientation. Worst orientations are those where the limit's measure is stationary ([`super::Limit::alignments`]), the ends of the range, and
//! those where two limits of one leg meet in a corner that points into the leg's region (the lens tips of a PRR leg); never two limits
//! of different legs, because each leg must hold by itself. With two limits of one leg held, its remaining joint moves `C` on a circle, or on a line at
//! one orientation; with joint 1 at an end in one working mode and joint 3 in the other, `C` moves on a coupler curve of that leg alone. derivations/ring_reach.rs, slider_reach.rs and joint_ranges.rs work it through.

use nalgebra::Vector2;

use super::arrangement::{Bound, Plan, SAME};
use super::leg::{Chain, LegReach};
use super::limits::{ActiveLimit, Limit, LimitCause};
use super::reach::Reach;
use super::region::Region;
use crate::linkage::{Dyad, Offset};
use crate::plane::{Carrier, Meeting, PhiRange, Sector, conjugate, direction, product};

impl Reach {
    /// The places reached in every orientation of a range, or in every one.
    pub(super) fn total(&self, range: Option<&PhiRange>) -> Region {
        let range = range.filter(|range| !range.is_full());
        let mut bounds = Vec::new();
        for (k, leg) in self.legs.iter().enumerate() {
            leg.worst(k, range, self.size, &mut bounds);
        }
        let sweep = Sweep::new(range);
        if self.legs.iter().any(LegReach::modes_cross) {
            let reached = |at: Vector2<f64>| {
                self.legs.iter().all(|leg| leg.allows_all(at, &sweep, super::reach::TOUCH * self.size, self.size))
            };
            return self.every(&bounds, range, &reached);
        }
        let admits = |leg: usize, p: Vector2<f64>, tol: f64| self.legs[leg].allows_all(p, &sweep, tol, self.size);
        Plan { bounds: &bounds, legs: self.legs.len(), admits: &admits, size: self.size }.region()
    }
}

/// A range of orientations with its directions, which every leg shares.
pub(super) struct Sweep {
    range: PhiRange,
    /// Directions of its ends.
    ends: [Vector2<f64>; 2],
    /// What a vector along x sweeps; `None` for a full turn.
    sector: Option<Sector>,
}

impl Sweep {
    /// `None` stands for every orientation.
    pub(super) fn new(range: Option<&PhiRange>) -> Self {
        let range = *range.unwrap_or(&PhiRange::FULL);
        let ends = [range.from, range.to()].map(direction);
        Self { range, ends, sector: Sector::new(ends[0], range.width) }
    }
}

impl LegReach {
    /// Whether joint 1 has a range that excludes something.
    fn base_joint_limited(&self) -> bool {
        match self.chain {
            Chain::Prr { .. } => self.stroke.iter().any(|end| end.is_finite()),
            _ => self.base_sector.is_some(),
        }
    }

    /// Whether an end of joint 1 in one mode and one of joint 3 in the other can bound the orientations together.
    fn modes_cross(&self) -> bool {
        self.base_joint_limited() && self.platform_sector.is_some() && self.modes == [true, true]
    }

    /// Whether the leg allows a place in every orientation of a range (`None`: of all).
    ///
    /// Bounds missed by at most `tol`, a length, count as met.
    pub(super) fn allows_all(&self, at: Vector2<f64>, sweep: &Sweep, tol: f64, size: f64) -> bool {
        if let Some([low, high]) = self.ring {
            let (nearest, furthest) = self.distances(at, sweep);
            return low - tol <= nearest && furthest <= high + tol;
        }
        /// Gaps of the set of orientations narrower than this (radians) come from rounding its ends.
        const SEAM: f64 = 1e-13;
        /// What an end of the range cuts off from a gap, up to this wide (radians), is worst at its ends or its middle, to first order.
        const NARROW: f64 = 1e-4;
        let range = &sweep.range;
        if !sweep.ends.iter().all(|&turn| self.allows_pose(at, turn, tol)) {
            return false;
        }
        // Between two orientations where a limit is met the middle decides, within the tolerance asked for: so a place on the edge, where the
        // violation stays below it through a whole gap, is one that belongs.
        let set = self.orientations(at, tol.max(super::reach::TOUCH * size));
        let allowed = |phi: &f64| self.allows_pose(at, direction(*phi), tol);
        range.width <= SEAM
            || set.complement().intersect(&range.set()).intervals().iter().all(|&[from, to]| {
                let within = || tol > 0.0 && to - from <= NARROW && [from, 0.5 * (from + to), to].iter().all(allowed);
                to - from <= SEAM || within()
            })
    }

    /// The least and the greatest distance of the pivots over a range of orientations.
    fn distances(&self, at: Vector2<f64>, sweep: &Sweep) -> (f64, f64) {
        let (away, arm) = (at - self.a, self.b.norm());
        let d = away.norm();
        let aligned = [(d - arm).abs(), d + arm];
        let Some(sector) = sweep.sector else { return (aligned[0], aligned[1]) };
        let ends = sweep.ends.map(|turn| (away + product(turn, self.b)).norm());
        // The platform arm sweeps over A->C, or over the opposite direction.
        let seen = product(conjugate(self.b), away);
        let nearest = if sector.contains(-seen, 0.0) { aligned[0] } else { ends[0].min(ends[1]) };
        let furthest = if sector.contains(seen, 0.0) { aligned[1] } else { ends[0].max(ends[1]) };
        (nearest, furthest)
    }

    /// Every curve on which a limit of the leg is at its worst orientation.
    fn worst(&self, leg: usize, range: Option<&PhiRange>, size: f64, out: &mut Vec<Bound>) {
        let mut push = |carrier: Carrier, active: &[ActiveLimit]| {
            let finite = match carrier {
                Carrier::Circle { radius, .. } => radius.is_finite(),
                Carrier::Line { .. } => true,
            };
            if finite {
                out.push(Bound { carrier, leg, active: active.iter().copied().collect() });
            }
        };
        let arm = self.b.norm();
        for limit in self.limits.iter().filter(|limit| !self.never_bounds(limit)) {
            match (self.ring, limit.dyad) {
                // Of a ring it is known which alignments are the worst: see derivations/ring_reach.rs.
                (Some(_), Dyad::RR { a, length, .. }) => {
                    let radii = if limit.sense > 0.0 { [length - arm, -1.0] } else { [length + arm, arm - length] };
                    for radius in radii.into_iter().filter(|&radius| radius >= -size * SAME) {
                        push(Carrier::Circle { center: a, radius: radius.max(0.0) }, &[limit.active()]);
                    }
                }
                _ => limit.alignments().into_iter().for_each(|carrier| push(carrier, &[limit.active()])),
            }
            if let Some(range) = range {
                push(limit.at_orientation(direction(range.from)), &[limit.active(), ActiveLimit::PhiFrom]);
                push(limit.at_orientation(direction(range.to())), &[limit.active(), ActiveLimit::PhiTo]);
            }
        }
        if self.ring.is_none() {
            for (k, first) in self.limits.iter().enumerate() {
                for second in &self.limits[..k] {
                    self.corner(first, second, range, size, &mut |carrier| {
                        push(carrier, &[first.active(), second.active()]);
                    });
                }
            }
        }
    }

    /// A radius of zero keeps nothing out.
    fn never_bounds(&self, limit: &Limit) -> bool {
        self.ring.is_some() && matches!(limit.dyad, Dyad::RR { length, .. } if length == 0.0)
    }

    /// The curve of `C` on which two limits of this leg are met at once: circles about a fixed point, or lines at one orientation.
    fn corner(&self, i: &Limit, j: &Limit, range: Option<&PhiRange>, size: f64, push: &mut dyn FnMut(Carrier)) {
        let same = SAME * size;
        let arm = self.b.norm();
        let meet = |a: Carrier, b: Carrier| match a.meet(&b, same) {
            Meeting::Points(points) => points,
            Meeting::Same => Default::default(),
        };
        let circle = |center, radius| Carrier::Circle { center, radius };
        // At the end of its travel a slider's region goes over from a side to a half circle without a corner.
        let slider = |limit: &Limit| {
            matches!(limit.cause, LimitCause::JointMin { joint: 0, .. } | LimitCause::JointMax { joint: 0, .. })
        };
        let side = |limit: &Limit| matches!(limit.cause, LimitCause::Left | LimitCause::Right);
        if (slider(i) && side(j)) || (side(i) && slider(j)) {
            return;
        }
        // Joints 1 and 3 at their ends, one mode: what lies between them is a pivot fixed in base and platform.
        let ends = |limit: &Limit| match limit.cause {
            LimitCause::JointMin { joint, .. } | LimitCause::JointMax { joint, .. } => Some(joint),
            _ => None,
        };
        if let (Some(0), Some(2)) | (Some(2), Some(0)) = (ends(i), ends(j)) {
            if i.mode != j.mode {
                return;
            }
            let (base, platform) = if ends(i) == Some(0) { (i, j) } else { (j, i) };
            match (base.dyad, platform.dyad) {
                (Dyad::RR { a, .. }, Dyad::RR { b, .. } | Dyad::PR { b, .. }) => push(circle(a, b.norm())),
                (Dyad::PR { u, .. }, Dyad::RP { v, .. }) => {
                    let phi = u.y.atan2(u.x) - v.y.atan2(v.x);
                    if range.is_none_or(|range| range.contains(phi)) {
                        push(base.at_orientation(direction(phi)));
                    }
                }
                _ => {}
            }
            return;
        }
        match (platform_places(i, self.b), platform_places(j, self.b)) {
            // Both of B alone: B is fixed in the base.
            (None, None) => {
                let origin = |limit: &Limit| match limit.dyad {
                    Dyad::RR { a, length, .. } => circle(a, length),
                    Dyad::PR { a, u, .. } => Carrier::Line { point: a, direction: u.normalize() },
                    _ => unreachable!("a limit of the platform pivot alone"),
                };
                for v in meet(origin(i), origin(j)) {
                    push(circle(v, arm));
                }
            }
            (first, second) => {
                if let (Dyad::PR { u, a, b }, Dyad::PR { a: a2, b: b2, .. }) = (&i.dyad, &j.dyad) {
                    // Two platform points on parallel lines: the orientation is given.
                    let held = Limit { dyad: Dyad::PR { a: *a - *a2, u: *u, b: *b - *b2 }, ..*i };
                    for phi in held.orientations_at(Vector2::zeros(), same) {
                        if range.is_none_or(|range| range.contains(phi)) {
                            push(i.at_orientation(direction(phi)));
                        }
                    }
                    return;
                }
                // Both measure from the base pivot: it is fixed in the platform.
                let seen = |places: Option<Carrier>, limit: &Limit| {
                    places.or_else(|| match limit.dyad {
                        Dyad::RR { a, b, length } if a == self.a => Some(circle(b, length)),
                        _ => None,
                    })
                };
                if let (Some(first), Some(second)) = (seen(first, i), seen(second, j)) {
                    for p in meet(first, second) {
                        push(circle(self.a, p.norm()));
                    }
                }
            }
        }
    }
}

/// Where a limit of joint 3 has the base pivot, seen from the platform; `None` for limits of the platform pivot alone and of sliders.
fn platform_places(limit: &Limit, pivot: Vector2<f64>) -> Option<Carrier> {
    match limit.dyad {
        Dyad::RR { b, length, .. } if b != pivot => Some(Carrier::Circle { center: b, radius: length }),
        Dyad::RP { b, v, offset, .. } => {
            let direction = v.normalize();
            let d = match offset {
                Offset::Distance(d) => d,
                Offset::TimesDirection(delta) => delta / v.norm(),
            };
            Some(Carrier::Line { point: b + Vector2::new(-direction.y, direction.x) * d, direction })
        }
        Dyad::PR { b, .. } if b != pivot => Some(Carrier::Circle { center: b, radius: 0.0 }),
        _ => None,
    }
}
