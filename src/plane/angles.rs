//! Closed sets of angles.
//!
//! A set is a sorted list of disjoint closed intervals on the circle; single angles are intervals of no width and are kept, since a
//! mechanism may reach a place in one orientation only. Empty and full are told apart from everything else.

use std::f64::consts::{PI, TAU};

/// The angle in [-pi, pi), for any finite angle.
///
/// ```
/// assert_eq!(assur::plane::principal(std::f64::consts::PI), -std::f64::consts::PI);
/// ```
pub fn principal(angle: f64) -> f64 {
    if (-PI..PI).contains(&angle) {
        return angle;
    }
    let reduced = angle - TAU * (angle / TAU).round();
    if reduced >= PI { reduced - TAU } else { reduced.max(-PI) }
}

/// A closed interval of orientations, run through counter-clockwise.
///
/// Width 0 is one orientation, 2 pi or more is every orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhiRange {
    /// First orientation, in radians.
    pub from: f64,
    /// How far it goes counter-clockwise, in radians, not negative.
    pub width: f64,
}

impl PhiRange {
    /// Every orientation.
    pub const FULL: Self = Self { from: -PI, width: TAU };

    /// Counter-clockwise from `from` to `to`, radians; equal ends are one orientation, a full turn or more is every orientation.
    ///
    /// ```
    /// use assur::plane::PhiRange;
    /// assert_eq!(PhiRange::between(0.0, 1.0).width, 1.0);
    /// assert!((PhiRange::between(1.0, 0.0).width - (std::f64::consts::TAU - 1.0)).abs() < 1e-15);
    /// assert!(PhiRange::between(0.0, 7.0).is_full());
    /// ```
    pub fn between(from: f64, to: f64) -> Self {
        let span = to - from;
        let width = if (0.0..TAU).contains(&span) {
            span
        } else if span >= TAU {
            TAU
        } else {
            span.rem_euclid(TAU)
        };
        Self { from, width }
    }

    /// Whether it holds every orientation.
    pub fn is_full(&self) -> bool {
        self.width >= TAU
    }

    /// Last orientation: `from + width`, not reduced.
    pub fn to(&self) -> f64 {
        self.from + self.width
    }

    /// Whether an orientation lies in it.
    pub fn contains(&self, phi: f64) -> bool {
        self.is_full() || (phi - self.from).rem_euclid(TAU) <= self.width
    }

    /// As a set of angles.
    pub fn set(&self) -> AngleSet {
        AngleSet::arc(self.from, self.width)
    }
}

/// A closed set of angles: disjoint closed intervals on the circle.
///
/// ```
/// use assur::plane::AngleSet;
/// let set = AngleSet::arc(3.0, 1.0).intersect(&AngleSet::arc(-3.0, 2.0));
/// assert_eq!(set.intervals().len(), 1);
/// assert!(set.contains(-2.5) && !set.contains(3.1));
/// assert!(AngleSet::arc(0.0, 1.0).intersect(&AngleSet::arc(1.0, 1.0)).contains(1.0));
/// ```
#[derive(Clone, Debug, PartialEq, Default)]
pub struct AngleSet {
    /// Sorted by their beginnings, which lie in [-pi, pi); only the last may run past pi. The full circle is `[-pi, pi]`.
    intervals: Vec<[f64; 2]>,
}

impl AngleSet {
    /// No angle.
    pub fn empty() -> Self {
        Self::default()
    }

    /// Every angle.
    pub fn full() -> Self {
        Self { intervals: vec![[-PI, PI]] }
    }

    /// The closed interval of this width, counter-clockwise from `from`; radians. A width of 2 pi or more is every angle.
    pub fn arc(from: f64, width: f64) -> Self {
        if width >= TAU {
            return Self::full();
        }
        let from = principal(from);
        Self { intervals: vec![[from, from + width.max(0.0)]] }
    }

    /// The intervals `[from, to]`, `to` from `from` on and at most a turn later; single angles have equal ends.
    pub fn intervals(&self) -> &[[f64; 2]] {
        &self.intervals
    }

    /// Whether no angle is in it.
    pub fn is_empty(&self) -> bool {
        self.intervals.is_empty()
    }

    /// Whether every angle is in it.
    pub fn is_full(&self) -> bool {
        matches!(self.intervals[..], [[from, to]] if to - from >= TAU)
    }

    /// Total width of the intervals, in radians.
    pub fn measure(&self) -> f64 {
        self.intervals.iter().map(|[from, to]| to - from).sum()
    }

    /// Whether an angle, any number of turns away, is in it.
    pub fn contains(&self, angle: f64) -> bool {
        let angle = principal(angle);
        self.is_full() || self.intervals.iter().any(|&[from, to]| (from <= angle && angle <= to) || angle + TAU <= to)
    }

    /// Angles in both.
    pub fn intersect(&self, other: &Self) -> Self {
        if other.is_full() || self.is_empty() {
            return self.clone();
        }
        if self.is_full() || other.is_empty() {
            return other.clone();
        }
        let (ours, theirs) = (self.pieces(), other.pieces());
        let mut both = Vec::with_capacity(ours.len() + theirs.len());
        let (mut i, mut j) = (0, 0);
        while let (Some(a), Some(b)) = (ours.get(i), theirs.get(j)) {
            let common = [a[0].max(b[0]), a[1].min(b[1])];
            if common[0] <= common[1] {
                both.push(common);
            }
            if a[1] < b[1] { i += 1 } else { j += 1 }
        }
        Self::from_pieces(both)
    }

    /// Angles in either.
    pub fn union(&self, other: &Self) -> Self {
        let mut pieces = self.pieces();
        pieces.extend(other.pieces());
        pieces.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Self::from_pieces(pieces)
    }

    /// Angles not in it; closed again, so that it shares the ends of the intervals, and single angles leave no trace.
    pub fn complement(&self) -> Self {
        if self.is_empty() {
            return Self::full();
        }
        let mut gaps = Vec::new();
        let mut from = -PI;
        for [low, high] in self.pieces() {
            if low > from {
                gaps.push([from, low]);
            }
            from = from.max(high);
        }
        if from < PI {
            gaps.push([from, PI]);
        }
        Self::from_pieces(gaps)
    }

    /// The set without the interval around an angle, where that interval is at most so wide.
    ///
    /// On the edge of a workspace the orientation in which the edge is reached is such an interval: what remains tells whether
    /// the place is reached in another way too.
    pub fn without(&self, angle: f64, width: f64) -> Self {
        let angle = principal(angle);
        let around = |&[from, to]: &[f64; 2]| {
            let off = |x: f64| (from - x).max(x - to).max(0.0);
            to - from <= width && off(angle).min(off(angle + TAU)).min(off(angle - TAU)) <= width
        };
        Self { intervals: self.intervals.iter().filter(|interval| !around(interval)).copied().collect() }
    }

    /// Whether a whole range of orientations lies in it, gaps of at most `slack` radians overlooked.
    pub fn covers(&self, range: &PhiRange, slack: f64) -> bool {
        if range.width <= slack {
            return self.contains(range.from);
        }
        let missing = self.complement().intersect(&range.set());
        missing.intervals.iter().all(|[from, to]| to - from <= slack)
    }

    /// The intervals cut at pi, within [-pi, pi], sorted.
    fn pieces(&self) -> Vec<[f64; 2]> {
        let mut pieces = Vec::with_capacity(self.intervals.len() + 1);
        if let Some(&[from, to]) = self.intervals.last()
            && to > PI
            && !self.is_full()
        {
            pieces.push([-PI, to - TAU]);
            pieces.extend_from_slice(&self.intervals[..self.intervals.len() - 1]);
            pieces.push([from, PI]);
        } else {
            pieces.extend_from_slice(&self.intervals);
        }
        pieces
    }

    /// From intervals within [-pi, pi], sorted by their beginnings; touching ones are joined, across pi too.
    pub(crate) fn from_pieces(pieces: Vec<[f64; 2]>) -> Self {
        let mut joined: Vec<[f64; 2]> = Vec::with_capacity(pieces.len());
        for [from, to] in pieces {
            match joined.last_mut() {
                Some(last) if from <= last[1] => last[1] = last[1].max(to),
                _ => joined.push([from, to]),
            }
        }
        if let (Some(&first), Some(&last)) = (joined.first(), joined.last())
            && last[1] >= PI
        {
            if joined.len() > 1 && first[0] <= -PI {
                joined.remove(0);
                if let Some(last) = joined.last_mut() {
                    last[1] = first[1] + TAU;
                }
            }
            // A lone pi is written -pi.
            if let Some(last) = joined.last_mut()
                && last[0] >= PI
            {
                let lone = [-PI, last[1] - TAU];
                joined.pop();
                joined.insert(0, lone);
            }
        }
        Self { intervals: joined }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn set() -> impl Strategy<Value = AngleSet> {
        prop::collection::vec((-7.0..7.0f64, prop_oneof![0.0..3.0f64, Just(0.0), Just(PI)]), 0..4).prop_map(
            |arcs: Vec<(f64, f64)>| {
                arcs.iter().fold(AngleSet::empty(), |set, &(from, width)| set.union(&AngleSet::arc(from, width)))
            },
        )
    }

    proptest! {
        /// Membership in the results is what membership in the operands says, away from the ends.
        #[test]
        fn sets_obey_logic(a in set(), b in set(), angle in -10.0..10.0f64) {
            let near = |set: &AngleSet| set.intervals().iter().flatten().any(|end| principal(end - angle).abs() < 1e-9);
            prop_assume!(!near(&a) && !near(&b));
            prop_assert_eq!(a.intersect(&b).contains(angle), a.contains(angle) && b.contains(angle));
            prop_assert_eq!(a.union(&b).contains(angle), a.contains(angle) || b.contains(angle));
            prop_assert_eq!(a.complement().contains(angle), !a.contains(angle));
            let sum = a.measure() + b.measure();
            prop_assert!((a.intersect(&b).measure() + a.union(&b).measure() - sum).abs() < 1e-12);
            for set in [&a, &b, &a.union(&b), &a.intersect(&b), &a.complement()] {
                for pair in set.intervals().windows(2) {
                    prop_assert!(pair[0][1] < pair[1][0]);
                }
                prop_assert!(set.intervals().iter().all(|[from, to]| (-PI..PI).contains(from) && from <= to));
            }
        }
    }

    #[test]
    fn single_angles_and_the_seam_are_kept() {
        let lone = AngleSet::arc(PI, 0.0);
        assert!(lone.contains(-PI) && lone.contains(PI) && lone.contains(3.0 * PI) && lone.measure() == 0.0);
        let across = AngleSet::arc(3.0, 0.5).union(&AngleSet::arc(-3.0, 0.5));
        assert_eq!(across.intervals().len(), 1);
        assert!(across.intersect(&lone).contains(PI));
        assert_eq!(AngleSet::arc(-PI, PI).union(&AngleSet::arc(0.0, PI)), AngleSet::full());
        assert!(across.without(PI, 0.1) == across && lone.without(PI, 0.1).is_empty());
        assert!(AngleSet::full().covers(&PhiRange::FULL, 0.0) && !across.covers(&PhiRange::FULL, 0.1));
    }
}
