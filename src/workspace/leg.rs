//! One leg in the frame of the reference point: which platform places it allows, and the limits that bound them.
//!
//! The three chains come down to two unit vectors, the same for every placement of the joint frames: `u`, the direction of the first moving link
//! (RRR: link 1; RPR: the slider; PRR: none, the slider keeps its own), and `w`, the direction of the last one (RRR: link 2; RPR: the slider; PRR: the
//! link). With B the platform pivot and `A` the base pivot or the slider's origin,
//!
//! | chain | closure | joint 1 | joint 2 | joint 3 |
//! |---|---|---|---|---|
//! | RPR | `B = A + (rho + i o) u` | sector of `u` | range of `rho` | sector of `u` seen from the platform |
//! | RRR | `B = A + l1 u + l2 w` | sector of `u` | sector of `w` seen from `u` | sector of `w` seen from the platform |
//! | PRR | `B = A + rho e + l w` | range of `rho` | sector of `w` | sector of `w` seen from the platform |
//!
//! A range is held against cross products of these vectors: no angle is computed, and near an end no digit is lost.

use nalgebra::Vector2;

use super::limits::{Limit, LimitCause, WorkspaceError, WorkspaceModes, angle_range, seen_from};
use crate::linkage::{Dyad, Offset};
use crate::manipulator::{JointKind, Leg, Placement};
use crate::plane::{Sector, conjugate, direction, product};

/// What the chain is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Chain {
    /// The slider's axis passes the base pivot at this signed distance: the platform pivot lies so far to its left.
    Rpr {
        offset: f64,
    },
    Rrr {
        l1: f64,
        l2: f64,
    },
    /// The slider runs along the unit vector `e`.
    Prr {
        l: f64,
        e: Vector2<f64>,
    },
}

/// A leg's limits, prepared.
#[derive(Clone, Debug)]
pub(super) struct LegReach {
    pub(super) chain: Chain,
    /// Base pivot; of a PRR leg the slider's pivot at stroke 0.
    pub(super) a: Vector2<f64>,
    /// Platform pivot from the reference point, platform frame.
    pub(super) b: Vector2<f64>,
    /// The reference point in the platform frame.
    pub(super) reference: Vector2<f64>,
    /// Range of the stroke; infinite where there is none.
    pub(super) stroke: [f64; 2],
    /// Sector of the first joint (of a PRR leg: of joint 2).
    pub(super) base_sector: Option<Sector>,
    /// RRR: sector of link 2 seen from link 1.
    pub(super) elbow_sector: Option<Sector>,
    /// Sector of the last link seen from the platform.
    pub(super) platform_sector: Option<Sector>,
    /// Modes allowed: [+, -].
    pub(super) modes: [bool; 2],
    /// Every surface that may bound it.
    pub(super) limits: Vec<Limit>,
    /// Where the distance of the pivots alone decides: its least and greatest values.
    pub(super) ring: Option<[f64; 2]>,
}

impl LegReach {
    /// # Errors
    /// A leg of another type, a link without length; `index` counts legs from 0.
    pub(super) fn new(
        index: usize,
        leg: &Leg,
        reference: Vector2<f64>,
        modes: &WorkspaceModes,
    ) -> Result<Self, WorkspaceError> {
        use JointKind::{Prismatic as P, Revolute as R};
        let unit = |p: &Placement| p.direction.normalize();
        let (base, platform) = (unit(&leg.base), unit(&leg.platform));
        let turns = leg.links.each_ref().map(unit);
        let number = index + 1;
        let along = |link: usize| {
            let t = leg.links[link].at;
            t.try_normalize(0.0).map(|d| (t.norm(), d)).ok_or(WorkspaceError::NoLength { leg: number, link })
        };
        // The sector of `zero · e(q)`, or of `zero · e(-q)`, over a joint's range.
        let forward = |joint: usize, zero: Vector2<f64>| {
            angle_range(leg.limits[joint]).and_then(|(from, width)| Sector::new(product(zero, direction(from)), width))
        };
        let backward = |joint: usize, zero: Vector2<f64>| {
            angle_range(leg.limits[joint])
                .and_then(|(from, width)| Sector::new(product(zero, direction(-(from + width))), width))
        };
        let stroke = |joint: usize| leg.limits[joint].unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let mut out = Self {
            chain: Chain::Rpr { offset: 0.0 },
            a: leg.base.at,
            b: leg.platform.at - reference,
            reference,
            stroke: [f64::NEG_INFINITY, f64::INFINITY],
            base_sector: None,
            elbow_sector: None,
            platform_sector: None,
            modes: [true, false].map(|plus| modes.allow(index, plus)),
            limits: Vec::new(),
            ring: None,
        };
        match leg.joints {
            [R, P, R] => {
                let slide = seen_from(turns[0], leg.links[0].at) + leg.links[1].at;
                out.chain = Chain::Rpr { offset: slide.y };
                out.stroke = stroke(1).map(|q| q + slide.x);
                // A range of one sign rules the other mode out.
                out.modes[0] &= out.stroke[1] >= 0.0;
                out.modes[1] &= out.stroke[0] < 0.0;
                out.base_sector = forward(0, product(base, turns[0]));
                out.platform_sector = backward(2, product(platform, conjugate(turns[1])));
            }
            [R, R, R] => {
                let ((l1, d1), (l2, d2)) = (along(0)?, along(1)?);
                out.chain = Chain::Rrr { l1, l2 };
                out.base_sector = forward(0, product(base, d1));
                out.elbow_sector = forward(1, seen_from(d1, product(turns[0], d2)));
                out.platform_sector = backward(2, product(platform, product(conjugate(turns[1]), d2)));
            }
            [P, R, R] => {
                let (l, d) = along(1)?;
                out.chain = Chain::Prr { l, e: base };
                out.a += product(base, leg.links[0].at);
                out.stroke = stroke(0);
                out.base_sector = forward(1, product(base, product(turns[0], d)));
                out.platform_sector = backward(2, product(platform, product(conjugate(turns[1]), d)));
            }
            _ => {
                let joints = leg.joints.iter().map(|kind| kind.letter()).collect();
                return Err(WorkspaceError::LegNotCovered { leg: number, joints });
            }
        }
        let driven = leg.actuated.iter().filter(|driven| **driven).count();
        out.limits = out.list_limits(index, |joint| leg.actuated[joint] && driven == 1);
        out.ring = out.find_ring();
        Ok(out)
    }

    /// Whether the leg allows the platform pivot at `at` with the platform turned by the unit vector `turn`, in a mode that counts.
    ///
    /// Bounds missed by at most `tol`, a length, count as met.
    pub(super) fn allows(&self, at: Vector2<f64>, turn: Vector2<f64>, tol: f64) -> bool {
        if let Some([low, high]) = self.ring {
            let d = (at - self.a).norm();
            return low - tol <= d && d <= high + tol;
        }
        (self.modes[0] && self.allows_in(true, at, turn, tol))
            || (self.modes[1] && self.allows_in(false, at, turn, tol))
    }

    /// The same in one working mode.
    ///
    /// Where its modes nearly merge, a joint moves as the root of the gap between what the leg spans and what it could span at most (or at least), and a rounding of the
    /// gap hides that joint; there any gap within the tolerance will do.
    pub(super) fn allows_in(&self, plus: bool, at: Vector2<f64>, turn: Vector2<f64>, tol: f64) -> bool {
        /// A gap below this much of the leg's span is near (heuristic: from there on a rounding moves the joint by less than 1e-12 of it).
        const NEAR: f64 = 1e-8;
        if !self.spans(at, tol) {
            return false;
        }
        if self.allows_spanned(plus, at, turn, tol, 0.0) {
            return true;
        }
        tol > 0.0
            && self.gap(at) < NEAR * self.span()
            && [tol, -tol].iter().any(|&shift| self.allows_spanned(plus, at, turn, tol, shift))
    }

    /// The length that sets the scale of the gap.
    fn span(&self) -> f64 {
        match self.chain {
            Chain::Rpr { offset } => offset.abs(),
            Chain::Rrr { l1, l2 } => l1 + l2,
            Chain::Prr { l, .. } => l,
        }
    }

    /// How far the platform pivot is from where the modes merge; negative where the leg does not reach.
    fn gap(&self, at: Vector2<f64>) -> f64 {
        let r = at - self.a;
        match self.chain {
            Chain::Rpr { offset } => r.norm() - offset.abs(),
            Chain::Rrr { l1, l2 } => {
                let d = r.norm();
                (l1 + l2 - d).min(d - (l1 - l2).abs())
            }
            Chain::Prr { l, e } => l - e.perp(&r).abs(),
        }
    }

    /// Whether the leg reaches the platform pivot with its joints free, a miss of `tol` overlooked.
    fn spans(&self, at: Vector2<f64>, tol: f64) -> bool {
        self.gap(at) >= -tol
    }

    /// Whether the joints are in their ranges at a platform place that the leg spans, its gap taken as greater by `shift`.
    fn allows_spanned(&self, plus: bool, at: Vector2<f64>, turn: Vector2<f64>, tol: f64, shift: f64) -> bool {
        let r = at - self.a;
        let side = if plus { 1.0 } else { -1.0 };
        let within = |rho: f64| self.stroke[0] - tol <= rho && rho <= self.stroke[1] + tol;
        let points = |sector: &Option<Sector>, v: Vector2<f64>| sector.is_none_or(|sector| sector.contains(v, tol));
        match self.chain {
            Chain::Rpr { offset } => {
                let d = r.norm();
                let gap = (d - offset.abs() + shift).max(0.0);
                let rho = side * (gap * (d + offset.abs())).sqrt();
                // The slider's direction times the distance of the pivots, so that the sector's tolerance is a length; where
                // the pivots meet every direction is one.
                let u = if offset == 0.0 { r * side } else { product(Vector2::new(rho, -offset), r) / d };
                within(rho) && points(&self.base_sector, u) && points(&self.platform_sector, seen_from(turn, u))
            }
            Chain::Rrr { l1, l2 } => {
                if self.base_sector.is_none() && self.elbow_sector.is_none() && self.platform_sector.is_none() {
                    return true;
                }
                let d = r.norm();
                // Half angle of the elbow: tan² = ((l1+l2)² - d²)/(d² - (l1-l2)²).
                let above = ((l1 + l2 - d + shift) * (l1 + l2 + d)).max(0.0);
                let below = ((d - (l1 - l2).abs() + shift) * (d + (l1 - l2).abs())).max(0.0);
                let elbow = Vector2::new(below - above, side * 2.0 * (above * below).sqrt()) / (above + below);
                if !points(&self.elbow_sector, elbow * l2) {
                    return false;
                }
                // Folded onto the base pivot the leg turns freely.
                if d == 0.0 || (self.base_sector.is_none() && self.platform_sector.is_none()) {
                    return true;
                }
                let arm = Vector2::new(l1, 0.0) + elbow * l2;
                let u = product(conjugate(arm), r) / (d * arm.norm());
                points(&self.base_sector, u * l1)
                    && points(&self.platform_sector, seen_from(turn, product(u, elbow)) * l2)
            }
            Chain::Prr { l, e } => {
                let seen = seen_from(e, r);
                let gap = (l - seen.y.abs() + shift).max(0.0);
                let half = (gap * (l + seen.y.abs())).sqrt();
                if !within(seen.x + side * half) {
                    return false;
                }
                let w = product(e, Vector2::new(-side * half, seen.y));
                points(&self.base_sector, w) && points(&self.platform_sector, seen_from(turn, w))
            }
        }
    }

    /// Every surface that may bound the leg in the modes that count.
    fn list_limits(&self, leg: usize, driven: impl Fn(usize) -> bool) -> Vec<Limit> {
        let (a, b) = (self.a, self.b);
        let mut out = Vec::new();
        let min = |joint| LimitCause::JointMin { joint, driven: driven(joint) };
        let max = |joint| LimitCause::JointMax { joint, driven: driven(joint) };
        // Both ends of a sector with the side that is allowed at its beginning.
        let ends = |sector: &Option<Sector>, reversed: bool, joint| {
            sector.map_or_else(Vec::new, |sector| {
                // A joint whose value grows while the direction turns back begins at the sector's end.
                let causes = if reversed { [max(joint), min(joint)] } else { [min(joint), max(joint)] };
                vec![(sector.from, 1.0, causes[0]), (sector.to, -1.0, causes[1])]
            })
        };
        let left = |d: Vector2<f64>| Vector2::new(-d.y, d.x);
        for plus in [true, false] {
            if !self.modes[usize::from(!plus)] {
                continue;
            }
            let side = if plus { 1.0 } else { -1.0 };
            let mut push = |cause, dyad, sense| out.push(Limit { leg, mode: Some(plus), cause, dyad, sense });
            match self.chain {
                Chain::Rpr { offset } => {
                    for (u, begins, cause) in ends(&self.base_sector, false, 0) {
                        push(cause, Dyad::PR { a: a + left(u) * offset, u, b }, -side * begins);
                    }
                    for (rho, begins, cause) in [(self.stroke[0], 1.0, min(1)), (self.stroke[1], -1.0, max(1))] {
                        // A stroke of the other sign bounds the other mode; zero is where both merge.
                        if rho.is_finite() && (rho * side > 0.0 || (rho == 0.0 && offset == 0.0)) {
                            push(cause, Dyad::RR { a, b, length: rho.hypot(offset) }, -side * begins);
                        }
                    }
                    for (v, begins, cause) in ends(&self.platform_sector, true, 2) {
                        push(cause, Dyad::RP { a, b, v, offset: Offset::Distance(-offset) }, side * begins);
                    }
                }
                Chain::Rrr { l1, l2 } => {
                    for (u, begins, cause) in ends(&self.base_sector, false, 0) {
                        push(cause, Dyad::RR { a: a + u * l1, b, length: l2 }, -side * begins);
                    }
                    for (elbow, begins, cause) in ends(&self.elbow_sector, false, 1) {
                        // In the mode + the elbow is turned to the left: growing, it brings the pivots nearer.
                        if elbow.y * side > 0.0 {
                            let length = (Vector2::new(l1, 0.0) + elbow * l2).norm();
                            push(cause, Dyad::RR { a, b, length }, side * begins);
                        }
                    }
                    for (v, begins, cause) in ends(&self.platform_sector, true, 2) {
                        push(cause, Dyad::RR { a, b: b - v * l2, length: l1 }, side * begins);
                    }
                }
                Chain::Prr { l, e } => {
                    for (rho, begins, cause) in [(self.stroke[0], 1.0, min(0)), (self.stroke[1], -1.0, max(0))] {
                        if rho.is_finite() {
                            push(cause, Dyad::RR { a: a + e * rho, b, length: l }, side * begins);
                        }
                    }
                    for (w, begins, cause) in ends(&self.base_sector, false, 1) {
                        // The mode + has the slider ahead, so its link points back along it.
                        if w.dot(&e) * side < 0.0 {
                            push(cause, Dyad::PR { a: a + w * l, u: e, b }, side * begins);
                        }
                    }
                    for (v, begins, cause) in ends(&self.platform_sector, true, 2) {
                        push(cause, Dyad::PR { a, u: e, b: b - v * l }, side * begins);
                    }
                }
            }
        }
        let ranged = self.base_sector.is_some() || self.elbow_sector.is_some() || self.platform_sector.is_some();
        let mut merge = |cause, dyad, sense| out.push(Limit { leg, mode: None, cause, dyad, sense });
        match self.chain {
            Chain::Rpr { offset } if offset != 0.0 => {
                merge(LimitCause::Shortest, Dyad::RR { a, b, length: offset.abs() }, -1.0);
            }
            // A point bounds nothing, but there the surfaces of the ranges pass from one mode to the other.
            Chain::Rpr { .. } => {
                if ranged && self.stroke[0] < 0.0 && self.stroke[1] > 0.0 {
                    merge(LimitCause::Shortest, Dyad::RR { a, b, length: 0.0 }, -1.0);
                }
            }
            Chain::Rrr { l1, l2 } => {
                merge(LimitCause::Stretched, Dyad::RR { a, b, length: l1 + l2 }, 1.0);
                if l1 != l2 || ranged {
                    merge(LimitCause::Folded, Dyad::RR { a, b, length: (l1 - l2).abs() }, -1.0);
                }
            }
            Chain::Prr { l, e } => {
                merge(LimitCause::Left, Dyad::PR { a: a + left(e) * l, u: e, b }, 1.0);
                merge(LimitCause::Right, Dyad::PR { a: a - left(e) * l, u: e, b }, -1.0);
            }
        }
        out
    }

    /// The leg in one of its working modes.
    pub(super) fn in_mode(&self, plus: bool) -> Self {
        let mut out = self.clone();
        out.modes = [self.modes[0] && plus, self.modes[1] && !plus];
        out.limits.retain(|limit| limit.mode.is_none_or(|mode| mode == plus));
        out.ring = out.find_ring();
        out
    }

    /// The ring of platform places of a leg whose pivots' distance alone decides.
    fn find_ring(&self) -> Option<[f64; 2]> {
        if self.base_sector.is_some() || self.elbow_sector.is_some() || self.platform_sector.is_some() {
            return None;
        }
        match self.chain {
            Chain::Rrr { l1, l2 } => self.modes.contains(&true).then_some([(l1 - l2).abs(), l1 + l2]),
            Chain::Prr { .. } => None,
            Chain::Rpr { offset } => {
                let [low, high] = self.stroke;
                // Of each mode the strokes of its sign, as lengths.
                let of_mode = |counts: bool, from: f64, to: f64| (counts && to >= 0.0).then(|| [from.max(0.0), to]);
                let lengths = match [of_mode(self.modes[0], low, high), of_mode(self.modes[1], -high, -low)] {
                    [Some(one), None] | [None, Some(one)] => one,
                    // Both begin at zero: a stroke range that holds two signs holds zero.
                    [Some(plus), Some(minus)] => [0.0, plus[1].max(minus[1])],
                    [None, None] => return None,
                };
                Some(lengths.map(|rho| rho.hypot(offset)))
            }
        }
    }

    /// The furthest the platform pivot can be from `a`; infinite where nothing bounds it.
    pub(super) fn furthest(&self) -> f64 {
        match self.chain {
            Chain::Rpr { offset } => self.stroke[0].abs().max(self.stroke[1].abs()).hypot(offset),
            Chain::Rrr { l1, l2 } => l1 + l2,
            Chain::Prr { l, .. } => self.stroke[0].abs().max(self.stroke[1].abs()) + l,
        }
    }
}
