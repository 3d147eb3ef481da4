//! The independent check: joint values in closed form, orientations by brute force, areas by quadrature.
//!
//! Nothing here knows a boundary curve, an angle set or a fold. A pose has a slack, the smallest distance of any joint from an end of its
//! range; a point belongs to a workspace of the kind "some orientation" where the largest slack over the orientations is not negative, to one of the
//! kind "every orientation" where the smallest is not. Both are found by sampling orientations and refining around the best samples.

use std::f64::consts::{PI, TAU};

use assur::{JointKind, Leg, Manipulator};

/// Orientations of a coarse search; a set of orientations narrower than a turn over this may be missed, which [`Oracle::verdict_at`] with more samples settles.
pub const SAMPLES: usize = 720;
/// Samples for a disagreement: what is then still missed is narrower than 2e-5 rad.
pub const MANY_SAMPLES: usize = 300_000;
/// Steps of golden section: the bracket shrinks by 1e-12.
const GOLDEN_STEPS: usize = 58;
/// Best samples that are refined.
const REFINED: usize = 24;

/// Which orientations are asked for, and whether some or all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// First orientation, and how far counter-clockwise they run; radians.
    pub from: f64,
    pub width: f64,
    /// Every one of them, not some.
    pub every: bool,
}

impl Question {
    pub fn constant(phi: f64) -> Self {
        Self { from: phi, width: 0.0, every: false }
    }

    pub fn maximal() -> Self {
        Self { from: 0.0, width: TAU, every: false }
    }

    pub fn dextrous() -> Self {
        Self { from: 0.0, width: TAU, every: true }
    }
}

/// What brute force says of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Inside,
    Outside,
    /// The deciding slack is too small to tell.
    Near,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Chain {
    Rpr,
    Rrr,
    Prr,
}

/// A range of a joint: lengths, or angles from the first counter-clockwise to the second.
#[derive(Clone, Copy, Debug)]
struct Range {
    low: f64,
    high: f64,
}

impl Range {
    fn slack_of_length(self, value: f64) -> f64 {
        (value - self.low).min(self.high - value)
    }

    fn slack_of_angle(self, value: f64) -> f64 {
        if self.high - self.low >= TAU {
            return f64::INFINITY;
        }
        let half = (self.high - self.low).rem_euclid(TAU) / 2.0;
        let off = (value - self.low - half).rem_euclid(TAU);
        half - off.min(TAU - off)
    }
}

#[derive(Clone, Debug)]
struct OracleLeg {
    chain: Chain,
    a: [f64; 2],
    alpha: f64,
    /// The last joint from the reference point, in the platform frame.
    b: [f64; 2],
    /// Placements of the links: place and angle.
    t1: [f64; 2],
    d1: f64,
    t2: [f64; 2],
    d2: f64,
    beta: f64,
    ranges: [Option<Range>; 3],
    /// Both modes, or one.
    sign: Option<bool>,
}

/// A manipulator as the check sees it.
#[derive(Clone, Debug)]
pub struct Oracle {
    legs: Vec<OracleLeg>,
    /// Largest length of the mechanism; an angle's slack counts times this.
    pub size: f64,
}

fn turned(v: [f64; 2], angle: f64) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    [c * v[0] - s * v[1], s * v[0] + c * v[1]]
}

fn angle(v: [f64; 2]) -> f64 {
    v[1].atan2(v[0])
}

impl OracleLeg {
    fn of(leg: &Leg, reference: [f64; 2], sign: Option<bool>) -> Self {
        use JointKind::{Prismatic as P, Revolute as R};
        let chain = match leg.joints {
            [R, P, R] => Chain::Rpr,
            [R, R, R] => Chain::Rrr,
            [P, R, R] => Chain::Prr,
            other => panic!("no workspace of {other:?}"),
        };
        let direction = |d: assur::nalgebra::Vector2<f64>| d.y.atan2(d.x);
        Self {
            chain,
            a: leg.base.at.into(),
            alpha: direction(leg.base.direction),
            b: [leg.platform.at.x - reference[0], leg.platform.at.y - reference[1]],
            t1: leg.links[0].at.into(),
            d1: direction(leg.links[0].direction),
            t2: leg.links[1].at.into(),
            d2: direction(leg.links[1].direction),
            beta: direction(leg.platform.direction),
            ranges: leg.limits.map(|limit| limit.map(|[low, high]| Range { low, high })),
            sign,
        }
    }

    /// How far the leg is from an end of its ranges in its better mode; negative where it cannot be assembled.
    fn slack(&self, c: [f64; 2], sin: f64, cos: f64, phi: f64, size: f64) -> f64 {
        let v = [
            c[0] + cos * self.b[0] - sin * self.b[1] - self.a[0],
            c[1] + sin * self.b[0] + cos * self.b[1] - self.a[1],
        ];
        let (reach, joints) = match self.chain {
            Chain::Rpr => self.rpr(v),
            Chain::Rrr => self.rrr(v),
            Chain::Prr => self.prr(v),
        };
        if reach < 0.0 {
            return reach;
        }
        let of_mode = |[q1, q2, turn]: [f64; 3]| {
            let q3 = phi + self.beta - turn;
            let kinds = match self.chain {
                Chain::Rpr => [false, true, false],
                Chain::Rrr => [false; 3],
                Chain::Prr => [true, false, false],
            };
            let mut slack = f64::INFINITY;
            for ((range, value), length) in self.ranges.iter().zip([q1, q2, q3]).zip(kinds) {
                let Some(range) = range else { continue };
                slack =
                    slack.min(if length { range.slack_of_length(value) } else { range.slack_of_angle(value) * size });
            }
            slack
        };
        let [plus, minus] = joints;
        let best = match self.sign {
            Some(true) => of_mode(plus),
            Some(false) => of_mode(minus),
            None => of_mode(plus).max(of_mode(minus)),
        };
        best.min(reach)
    }

    /// Of a PRR leg: its link, and how far the pivot lies beside the slider.
    fn beside(&self, c: [f64; 2], sin: f64, cos: f64) -> (f64, f64) {
        let v = [
            c[0] + cos * self.b[0] - sin * self.b[1] - self.a[0],
            c[1] + sin * self.b[0] + cos * self.b[1] - self.a[1],
        ];
        (self.t2[0].hypot(self.t2[1]), turned(v, -self.alpha)[1] - self.t1[1])
    }

    /// By how much the slack can grow while the pivot moves by `half`.
    fn change_within(&self, c: [f64; 2], sin: f64, cos: f64, half: f64) -> f64 {
        if self.chain != Chain::Prr {
            return half;
        }
        // A stroke changes by the root of what is left beside the slider as well.
        let (l, side) = self.beside(c, sin, cos);
        let root = |side: f64| ((l - side.abs()) * (l + side.abs())).max(0.0).sqrt();
        let (less, more) = (root((side.abs() - half).max(0.0)), root(side.abs() + half));
        half + (less - root(side)).max(root(side) - more)
    }

    /// Reach, then for each mode `q1`, `q2` and the direction in which joint 3's inner frame points.
    fn rpr(&self, v: [f64; 2]) -> (f64, [[f64; 3]; 2]) {
        let back = turned(self.t1, -self.d1);
        let offset = [back[0] + self.t2[0], back[1] + self.t2[1]];
        let r = v[0].hypot(v[1]);
        // With no offset every distance is reached and the modes do not bound each other but in a point.
        let reach = if offset[1] == 0.0 { f64::INFINITY } else { r - offset[1].abs() };
        let root = ((r - offset[1].abs()) * (r + offset[1].abs())).max(0.0).sqrt();
        let mode = |along: f64| {
            let q1 = angle(v) - self.alpha - self.d1 - offset[1].atan2(along);
            [q1, along - offset[0], self.alpha + q1 + self.d1 + self.d2]
        };
        (reach, [mode(root), mode(-root)])
    }

    fn rrr(&self, v: [f64; 2]) -> (f64, [[f64; 3]; 2]) {
        let (l1, l2) = (self.t1[0].hypot(self.t1[1]), self.t2[0].hypot(self.t2[1]));
        let r = v[0].hypot(v[1]);
        let (outer, inner) = (l1 + l2 - r, r - (l1 - l2).abs());
        let elbow =
            2.0 * (outer * (l1 + l2 + r)).max(0.0).sqrt().atan2((inner * (r + (l1 - l2).abs())).max(0.0).sqrt());
        let mode = |elbow: f64| {
            // Link 2 stands at the elbow angle from link 1.
            let q2 = elbow + angle(self.t1) - angle(self.t2) - self.d1;
            let second = turned(self.t2, self.d1 + q2);
            let q1 = angle(v) - self.alpha - angle([self.t1[0] + second[0], self.t1[1] + second[1]]);
            [q1, q2, self.alpha + q1 + self.d1 + q2 + self.d2]
        };
        // Equal links have no inner circle; passing the middle is no end of the reach.
        let inner = if l1 == l2 { f64::INFINITY } else { inner };
        (outer.min(inner), [mode(elbow), mode(-elbow)])
    }

    fn prr(&self, v: [f64; 2]) -> (f64, [[f64; 3]; 2]) {
        let p = turned(v, -self.alpha);
        let (along, side) = (p[0] - self.t1[0], p[1] - self.t1[1]);
        let l = self.t2[0].hypot(self.t2[1]);
        let root = ((l - side.abs()) * (l + side.abs())).max(0.0).sqrt();
        let mode = |back: f64| {
            let q2 = side.atan2(-back) - self.d1 - angle(self.t2);
            [along + back, q2, self.alpha + self.d1 + q2 + self.d2]
        };
        (l - side.abs(), [mode(root), mode(-root)])
    }
}

impl Oracle {
    /// `modes`: one sign a leg, or both.
    pub fn of(robot: &Manipulator, modes: Option<[bool; 3]>) -> Self {
        let legs: Vec<OracleLeg> = robot
            .legs
            .iter()
            .enumerate()
            .map(|(k, leg)| OracleLeg::of(leg, robot.reference.into(), modes.map(|signs| signs[k])))
            .collect();
        let largest = |v: [f64; 2]| v[0].hypot(v[1]);
        let size = legs
            .iter()
            .flat_map(|leg| {
                let slides = leg.chain != Chain::Rrr;
                let stroke = leg.ranges[usize::from(leg.chain == Chain::Rpr)]
                    .filter(|_| slides)
                    .map_or(0.0, |range| range.low.abs().max(range.high.abs()));
                let base = [leg.a[0] - robot.legs[0].base.at.x, leg.a[1] - robot.legs[0].base.at.y];
                [largest(base), largest(leg.b), largest(leg.t1), largest(leg.t2), stroke]
            })
            .fold(0.0, f64::max);
        Self { legs, size }
    }

    /// Smallest slack over the legs of a pose of the reference point.
    pub fn slack(&self, at: [f64; 2], phi: f64) -> f64 {
        let (sin, cos) = phi.sin_cos();
        self.legs.iter().map(|leg| leg.slack(at, sin, cos, phi, self.size)).fold(f64::INFINITY, f64::min)
    }

    /// At least the slack of every pose whose pivots are within `half` of those of a pose; for legs without ranges of passive joints.
    pub fn slack_within(&self, at: [f64; 2], phi: f64, half: f64) -> f64 {
        let (sin, cos) = phi.sin_cos();
        let leg = |leg: &OracleLeg| leg.slack(at, sin, cos, phi, self.size) + leg.change_within(at, sin, cos, half);
        self.legs.iter().map(leg).fold(f64::INFINITY, f64::min)
    }

    /// Where the modes of a PRR leg merge nearest to a place, the platform not turned.
    pub fn merging(&self, leg: usize, at: [f64; 2], phi: f64) -> Option<[f64; 2]> {
        let leg = &self.legs[leg];
        if leg.chain != Chain::Prr {
            return None;
        }
        let (sin, cos) = phi.sin_cos();
        let (l, side) = leg.beside(at, sin, cos);
        let across = turned([0.0, (l - side.abs()) * if side < 0.0 { -1.0 } else { 1.0 }], leg.alpha);
        Some([at[0] + across[0], at[1] + across[1]])
    }

    /// How far that is.
    pub fn merging_gap(&self, leg: usize, at: [f64; 2], phi: f64) -> f64 {
        let (sin, cos) = phi.sin_cos();
        let (l, side) = self.legs[leg].beside(at, sin, cos);
        (l - side.abs()).abs()
    }

    /// The largest slack over the orientations, or the smallest where every one is asked for. `enough`: a value beyond which nobody needs to know better.
    pub fn extreme(&self, at: [f64; 2], question: Question, samples: usize, enough: f64) -> f64 {
        let sense = if question.every { -1.0 } else { 1.0 };
        let value = |phi: f64| sense * self.slack(at, phi);
        let found = if question.width == 0.0 {
            value(question.from)
        } else {
            let full = question.width >= TAU;
            let width = question.width.min(TAU);
            let count = ((samples as f64 * width / TAU).ceil() as usize).max(24);
            let step = width / count as f64;
            let mut values = Vec::with_capacity(count + 1);
            let mut best = f64::NEG_INFINITY;
            for k in 0..=count {
                let v = value(question.from + step * k as f64);
                if v > enough {
                    return sense * v;
                }
                best = best.max(v);
                values.push(v);
            }
            let mut peaks: Vec<usize> = (0..=count)
                .filter(|&k| {
                    let before = if k > 0 {
                        values[k - 1]
                    } else if full {
                        values[count - 1]
                    } else {
                        f64::NEG_INFINITY
                    };
                    let after = if k < count {
                        values[k + 1]
                    } else if full {
                        values[1]
                    } else {
                        f64::NEG_INFINITY
                    };
                    values[k] >= before && values[k] >= after
                })
                .collect();
            peaks.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
            for &k in peaks.iter().take(REFINED) {
                let middle = question.from + step * k as f64;
                let (mut low, mut high) = (middle - step, middle + step);
                if !full {
                    (low, high) = (low.max(question.from), high.min(question.from + width));
                }
                best = best.max(golden(&value, low, high));
                if best > enough {
                    break;
                }
            }
            best
        };
        sense * found
    }

    /// Whether a point belongs to the workspace; `near`: slacks below this part of the size do not decide.
    pub fn verdict_at(&self, at: [f64; 2], question: Question, samples: usize, near: f64) -> Verdict {
        let near = near * self.size;
        let slack = self.extreme(at, question, samples, near);
        if slack > near {
            Verdict::Inside
        } else if slack < -near {
            Verdict::Outside
        } else {
            Verdict::Near
        }
    }

    /// Whether the verdict changes within a distance of a point, in the size's part `within`: then the point lies that near to the boundary.
    pub fn is_boundary(&self, at: [f64; 2], question: Question, within: f64) -> bool {
        let around: Vec<bool> = (0..16)
            .map(|k| f64::from(k) * PI / 8.0)
            .map(|t| [at[0] + within * self.size * t.cos(), at[1] + within * self.size * t.sin()])
            .chain([at])
            .map(|p| self.extreme(p, question, MANY_SAMPLES, 0.0) >= 0.0)
            .collect();
        around.iter().any(|inside| *inside != around[0])
    }

    /// Where a line from `p` to `q` enters and leaves the workspace, by steps of this many parts, each change then halved down to the last digits.
    ///
    /// Parts between which nothing changes are taken to be all inside or all outside; slivers thinner than a step may be missed.
    pub fn crossings(&self, p: [f64; 2], q: [f64; 2], question: Question, steps: usize) -> Vec<([f64; 2], bool)> {
        let at = |t: f64| [p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t];
        let inside = |t: f64| self.extreme(at(t), question, SAMPLES, 0.0) >= 0.0;
        let mut found = Vec::new();
        let mut before = inside(0.0);
        for k in 1..=steps {
            let (mut low, mut high) = ((k - 1) as f64 / steps as f64, k as f64 / steps as f64);
            let now = inside(high);
            if now != before {
                for _ in 0..44 {
                    let middle = (low + high) / 2.0;
                    if inside(middle) == before { low = middle } else { high = middle }
                }
                found.push((at((low + high) / 2.0), now));
            }
            before = now;
        }
        found
    }

    /// The workspace's area within a box, by scan lines; each line's length by [`Oracle::crossings`], the lines summed by Gauss's rule of two points.
    pub fn area(&self, bounds: [f64; 4], question: Question, lines: usize, steps: usize) -> f64 {
        let [xmin, ymin, xmax, ymax] = bounds;
        let height = (ymax - ymin) / lines as f64;
        let mut area = 0.0;
        for k in 0..lines {
            for node in [-1.0, 1.0] {
                let y = ymin + height * (k as f64 + 0.5 + node * 0.5 / 3f64.sqrt());
                let mut entered = xmin;
                let mut last = None;
                for (at, enters) in self.crossings([xmin, y], [xmax, y], question, steps) {
                    if enters {
                        entered = at[0];
                    } else {
                        area += (at[0] - entered) * height / 2.0;
                    }
                    last = Some(enters);
                }
                let ends_inside = last.unwrap_or_else(|| self.extreme([xmin, y], question, SAMPLES, 0.0) >= 0.0);
                if ends_inside {
                    area += (xmax - entered) * height / 2.0;
                }
            }
        }
        area
    }
}

/// The largest value of a function with one peak in an interval.
fn golden(value: &impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let part = (5f64.sqrt() - 1.0) / 2.0;
    let (mut left, mut right) = (high - part * (high - low), low + part * (high - low));
    let (mut at_left, mut at_right) = (value(left), value(right));
    let mut best = at_left.max(at_right).max(value(low)).max(value(high));
    for _ in 0..GOLDEN_STEPS {
        if at_left > at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - part * (high - low);
            at_left = value(left);
            best = best.max(at_left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + part * (high - low);
            at_right = value(right);
            best = best.max(at_right);
        }
    }
    best
}
