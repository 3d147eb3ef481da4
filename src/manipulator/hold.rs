//! One assembly mode along a stretch of inputs: proven to go on, or not.
//!
//! With the actuators held, each leg is one condition `F(pose, inputs) = 0` (two for a pinned one). For a stretch of inputs about its middle, and a box of
//! poses of half width `r` about the approximate solution `p` there, with `C` any matrix near the inverse of `DF(p)`:
//!
//! - `theta`: a bound of `|1 - C DF|` over the box and the stretch,
//! - `eta`: a bound of `|C F(p)|` over the stretch.
//!
//! Where `theta < 1` and `eta ≤ (1 - theta)·r`, the simplified Newton map `u - C F(u)` is a contraction of the box for every input of the stretch: each has
//! exactly one pose in the box, it depends continuously on the input, and it is regular. A mode that enters such a box on one end leaves it on the
//! other as the same mode.
//!
//! **Proof**: both bounds are taken in [`Interval`] arithmetic, so no rounding escapes them. What they hold for is the conditions whose numbers lie within
//! [`Play`] of the locked ones: closed bounds of what the inputs move, and [`ROUNDINGS`] for the placements that were multiplied in `f64` on the way.
//! Source: Krawczyk 1969; Moore, Kearfott, Cloud 2009, chapter 8.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::describe::{JointKind, Leg, Manipulator, Placement};
use super::frame::{back, principal_angle, times, unit};
use super::lock::LockedLeg;
use crate::algebra::Interval;
use crate::linkage::Pose;

/// Roundings allowed for in each number of a condition, in units in the last place of the lengths that went into it: a leg's placements take five
/// products of rigid motions, of four products and sums each, and the sines and cosines in them are good to one unit.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// A condition on the pose with everything in it that the inputs move.
#[derive(Clone, Debug)]
enum Condition {
    /// `(|X + R b - a|² - l²) / 2 = 0`
    Circle { a: Vector2<f64>, b: Vector2<f64>, length: f64 },
    /// `n·(X + R b - a) = 0`
    Line { a: Vector2<f64>, b: Vector2<f64>, normal: Vector2<f64> },
    /// `(R m)·(a - X - R b) - d = 0`
    PlatformLine { a: Vector2<f64>, b: Vector2<f64>, normal: Vector2<f64>, offset: f64 },
    /// `phi - angle = 0`
    Orientation { angle: f64 },
}

/// By how much the parts of a condition change at most when its leg's input moves through the stretch's half width.
#[derive(Clone, Copy, Debug, Default)]
struct Play {
    /// Of `a` and `b`, lengths.
    base: f64,
    platform: f64,
    /// Of the direction, radians.
    turn: f64,
    /// Of the length or offset.
    length: f64,
}

impl Play {
    /// Widens by what rounding does to the numbers of a condition.
    fn allow_for_rounding(&mut self, leg: &Leg, held: &[(usize, f64, f64)], locked: &LockedLeg) {
        let strokes: f64 =
            held.iter().filter(|h| leg.joints[h.0] == JointKind::Prismatic).map(|h| h.1.abs() + h.2).sum();
        let links: f64 = leg.links.iter().map(|link| link.at.norm()).sum();
        let inner = links + strokes;
        let widen = |play: &mut f64, size: f64| *play = *play * (1.0 + ROUNDINGS) + ROUNDINGS * size;
        widen(&mut self.base, inner + leg.base.at.norm() + locked.near.at.norm());
        widen(&mut self.platform, inner + leg.platform.at.norm() + locked.far.at.norm());
        widen(&mut self.length, inner);
        widen(&mut self.turn, 1.0);
    }
}

/// The held platform at given inputs, the stretch around them included.
pub(super) struct Hold {
    conditions: Vec<(Condition, Play)>,
    /// Lengths are measured in this.
    scale: f64,
}

/// A pose with the derivative of the conditions there, in units of the scale.
struct Linearised {
    value: Vector3<f64>,
    derivative: Matrix3<f64>,
}

impl Hold {
    /// The conditions at `inputs`, each allowed to move by its part of `half_width`. `None` where the legs do not hold the platform with
    /// three conditions.
    pub fn new(robot: &Manipulator, inputs: &[f64], half_width: &[f64], scale: f64) -> Option<Self> {
        let mut given = inputs.iter().zip(half_width);
        let mut conditions = Vec::new();
        for leg in &robot.legs {
            let joints = (0..3).filter(|&joint| leg.actuated[joint]);
            let held: Vec<(usize, f64, f64)> =
                joints.map(|joint| given.next().map(|(&q, &h)| (joint, q, h.abs()))).collect::<Option<_>>()?;
            conditions_of(&mut conditions, leg, &held);
        }
        (conditions.len() == 3).then_some(Self { conditions, scale })
    }

    fn linearise(&self, pose: &Pose) -> Linearised {
        let turn = Placement::turned(0.0, 0.0, pose.phi).direction;
        let x = Vector2::new(pose.x, pose.y);
        let mut out = Linearised { value: Vector3::zeros(), derivative: Matrix3::zeros() };
        for (row, (condition, _)) in self.conditions.iter().enumerate() {
            let (value, force, moment) = match condition {
                Condition::Circle { a, b, length } => {
                    let arm = times(turn, *b);
                    let k = x + arm - a;
                    // As a product, the difference of nearly equal lengths keeps its digits.
                    let size = k.norm();
                    ((size - length) * (size + length) / 2.0, k, cross(arm, k))
                }
                Condition::Line { a, b, normal } => {
                    let arm = times(turn, *b);
                    (normal.dot(&(x + arm - a)), *normal, cross(arm, *normal))
                }
                Condition::PlatformLine { a, b, normal, offset } => {
                    let m = times(turn, *normal);
                    let reach = a - x;
                    (m.dot(&(reach - times(turn, *b))) - offset, -m, cross(m, reach))
                }
                Condition::Orientation { angle } => (principal_angle(pose.phi - angle), Vector2::zeros(), 1.0),
            };
            // Lengths in units of the scale: a condition of degree two is divided by its square.
            let degree = match condition {
                Condition::Circle { .. } => self.scale * self.scale,
                Condition::Line { .. } | Condition::PlatformLine { .. } => self.scale,
                Condition::Orientation { .. } => 1.0,
            };
            out.value[row] = value / degree;
            let force = force * (self.scale / degree);
            out.derivative.set_row(row, &Vector3::new(force.x, force.y, moment / degree).transpose());
        }
        out
    }

    /// By how much a pose misses each condition, in units of the scale.
    pub fn values(&self, pose: &Pose) -> Vector3<f64> {
        self.linearise(pose).value
    }

    /// The determinant of the derivative with rows of unit force, moments in units of the scale: smooth along the path, zero where modes meet.
    ///
    /// What is reported as det A is [`super::LockedGroup::det_a`].
    pub fn determinant(&self, pose: &Pose) -> f64 {
        let mut derivative = self.linearise(pose).derivative;
        for mut row in derivative.row_iter_mut() {
            let force = row[0].hypot(row[1]);
            if force > 0.0 {
                row /= force;
            }
        }
        derivative.determinant()
    }

    /// A few Newton steps from a pose; `None` where they do not settle.
    pub fn settle(&self, from: &Pose) -> Option<Pose> {
        let mut pose = *from;
        let mut before = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            let at = self.linearise(&pose);
            let step = at.derivative.lu().solve(&at.value)?;
            let size = step.amax();
            // Rounding is reached where a small step no longer shrinks.
            if !size.is_finite() || (size >= before && size > SETTLED) {
                return None;
            }
            pose = Pose::new(pose.x - step.x * self.scale, pose.y - step.y * self.scale, pose.phi - step.z);
            if size <= SETTLED && (size >= 0.5 * before || size <= f64::EPSILON) {
                return Some(Pose { phi: principal_angle(pose.phi), ..pose });
            }
            before = size;
        }
        None
    }

    /// The half width, in units of the scale and radians, of a box about `pose` in which every input of the stretch has exactly one pose; `None` where
    /// that is not shown. `pose` solves the middle of the stretch, approximately.
    pub fn contraction_radius(&self, pose: &Pose) -> Option<f64> {
        let inverse = self.linearise(pose).derivative.try_inverse()?;
        if !inverse.iter().all(|entry| entry.is_finite()) {
            return None;
        }
        let turn = Interval::cos_sin(pose.phi);
        let eta = largest_row(&inverse, |row| [self.row(row, pose, &turn, 0.0)[0]], |_, _| 0.0);
        // The least box that could be mapped into itself with theta = 1/2; a box is never a point.
        let radius = (2.0 * eta).max(f64::MIN_POSITIVE) * (1.0 + ROUNDINGS);
        if !radius.is_finite() || radius > LARGEST_BOX {
            return None;
        }
        let derivative = |row: usize| {
            let [_, x, y, phi] = self.row(row, pose, &turn, radius);
            [x, y, phi]
        };
        let theta = largest_row(&inverse, derivative, |i, j| if i == j { 1.0 } else { 0.0 });
        // Upwards: eta and the largest row are upper bounds already.
        (theta < 0.5 && eta <= ((1.0 - theta).next_down() * radius).next_down()).then_some(radius)
    }

    /// A condition's value at `pose`, and its derivative over the box of half width `radius` about it, both over the stretch: in units of the scale. `turn` is the cosine and sine of its angle.
    fn row(&self, row: usize, pose: &Pose, turn: &[Interval; 2], radius: f64) -> [Interval; 4] {
        let (condition, play) = &self.conditions[row];
        let scale = Interval::point(self.scale);
        let over = |value: Interval, by: Interval| value.checked_div(by).unwrap_or(UNBOUNDED);
        let side = Interval::point(radius) * scale;
        let around = |centre: f64, half: Interval| Interval::point(centre) + half.hull(-half);
        let x = [around(pose.x, side), around(pose.y, side)];
        // Sine and cosine change by at most the angle.
        let angle = Interval::point(radius);
        let turn = turn.map(|value| value + angle.hull(-angle));
        let point = |p: &Vector2<f64>, half: f64| [p.x, p.y].map(|c| around(c, Interval::point(half)));
        let rotated = |[c, s]: [Interval; 2], [p, q]: [Interval; 2]| [c * p - s * q, s * p + c * q];
        let plus = |p: [Interval; 2], q: [Interval; 2]| [p[0] + q[0], p[1] + q[1]];
        let minus = |p: [Interval; 2], q: [Interval; 2]| [p[0] - q[0], p[1] - q[1]];
        let dot = |p: [Interval; 2], q: [Interval; 2]| p[0] * q[0] + p[1] * q[1];
        let cross = |p: [Interval; 2], q: [Interval; 2]| p[0] * q[1] - p[1] * q[0];
        match condition {
            Condition::Circle { a, b, length } => {
                let arm = rotated(turn, point(b, play.platform));
                let k = minus(plus(x, arm), point(a, play.base));
                let radius = around(*length, Interval::point(play.length));
                let square = scale * scale;
                // At the pose the difference of squares is a product: nearly equal lengths keep their digits.
                let size = (k[0].square() + k[1].square()).sqrt().unwrap_or(UNBOUNDED);
                let value = ((size - radius) * (size + radius)).times(0.5);
                [over(value, square), over(k[0], scale), over(k[1], scale), over(cross(arm, k), square)]
            }
            Condition::Line { a, b, normal } => {
                let arm = rotated(turn, point(b, play.platform));
                let k = minus(plus(x, arm), point(a, play.base));
                let n = point(normal, play.turn);
                [over(dot(n, k), scale), n[0], n[1], over(cross(arm, n), scale)]
            }
            Condition::PlatformLine { a, b, normal, offset } => {
                // The platform's line keeps its direction unless its own joint turns it.
                let m = rotated(turn, point(normal, play.turn));
                let arm = rotated(turn, point(b, play.platform));
                let reach = minus(point(a, play.base), x);
                let value = dot(m, minus(reach, arm)) - around(*offset, Interval::point(play.length));
                [over(value, scale), -m[0], -m[1], over(cross(m, reach), scale)]
            }
            Condition::Orientation { angle } => {
                let turned = principal_angle(pose.phi - angle);
                let half = Interval::point(radius) + Interval::point(play.turn);
                let zero = Interval::point(0.0);
                [Interval::point(turned) + half.hull(-half), zero, zero, Interval::point(1.0)]
            }
        }
    }

    /// How far apart two poses are, in units of the scale and radians.
    pub fn distance(&self, p: &Pose, q: &Pose) -> f64 {
        let along = (p.x - q.x).abs().max((p.y - q.y).abs()) / self.scale;
        along.max(principal_angle(p.phi - q.phi).abs())
    }
}

/// No larger box is of use: sines and cosines are bounded by the angle.
const LARGEST_BOX: f64 = 1.0;
/// What nothing is known of.
const UNBOUNDED: Interval = Interval::EVERYTHING;

/// The largest sum of magnitudes in a row of `from - inverse · entries`, an upper bound.
fn largest_row<const N: usize>(
    inverse: &Matrix3<f64>,
    entries: impl Fn(usize) -> [Interval; N],
    from: impl Fn(usize, usize) -> f64,
) -> f64 {
    let rows = [0, 1, 2].map(entries);
    let sum = |i: usize| {
        (0..N).fold(0.0, |sum: f64, j| {
            let product = (0..3).fold(Interval::point(0.0), |sum, k| sum + rows[k][j].times(inverse[(i, k)]));
            (sum + (Interval::point(from(i, j)) - product).magnitude()).next_up()
        })
    };
    (0..3).map(sum).fold(0.0, f64::max)
}

/// Newton steps before a start is given up: from within a contraction's ball each halves the error at least.
const NEWTON_STEPS: usize = 60;
/// Steps below this, in units of the scale and radians, count as settled once they stop shrinking: rounding over the smallest singular value that a step
/// still works with (1e-8). How far the exact pose may be then is for [`Hold::contraction_radius`] to show.
const SETTLED: f64 = 1e-8;

fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The conditions of a leg with some joints held, each as (joint, value, half width).
fn conditions_of(out: &mut Vec<(Condition, Play)>, leg: &Leg, held: &[(usize, f64, f64)]) {
    use JointKind::{Prismatic as P, Revolute as R};
    let values: Vec<(usize, f64)> = held.iter().map(|&(joint, value, _)| (joint, value)).collect();
    let locked = LockedLeg::new(leg, &values);
    let (near, far) = (&locked.near, &locked.far);
    let quarter = |d: Vector2<f64>| Vector2::new(-d.y, d.x);
    let idle = locked.passive.clone();
    // What each held joint moves: everything before the first idle joint belongs to the base, after the last to the platform.
    let (first, last) = (idle.first().map_or(3, |i| i.0), idle.last().map_or(0, |i| i.0));
    let mut play = Play::default();
    for &(joint, _, half) in held {
        let reach = |links: std::ops::Range<usize>| -> f64 {
            let others: f64 =
                held.iter().filter(|h| leg.joints[h.0] == P && h.0 != joint).map(|h| h.1.abs() + h.2).sum();
            links.map(|k| leg.links[k].at.norm()).sum::<f64>() + others
        };
        let moved = |lever: f64| if leg.joints[joint] == P { half } else { half * lever };
        if leg.joints[joint] == R {
            play.turn += half;
        }
        if joint < first {
            // A line's point is carried along the link after its slider too.
            let upto = if idle[..].first().is_some_and(|i| i.1 == P) { 2 } else { first };
            play.base += moved(reach(joint..upto.min(2)));
        } else if joint > last {
            play.platform += moved(reach(last..joint));
        } else if idle[0].1 == P {
            // PR: the middle carries the line's point.
            play.base += moved(reach(0..2));
        } else {
            play.length += moved(reach(0..2));
        }
    }
    play.allow_for_rounding(leg, held, &locked);
    match (&idle[..], &locked.between[..]) {
        ([(_, R), (_, R)], [middle]) => {
            // A radius changes with the middle only.
            out.push((Condition::Circle { a: near.at, b: far.at, length: middle.at.norm() }, play));
        }
        ([(_, P), (_, R)], [middle]) => {
            let a = near.then(middle).at;
            out.push((Condition::Line { a, b: far.at, normal: quarter(unit(near.direction)) }, play));
        }
        ([(_, R), (_, P)], [middle]) => {
            let offset = -times(unit(back(middle.direction)), middle.at).y;
            let normal = quarter(unit(far.direction));
            out.push((Condition::PlatformLine { a: near.at, b: far.at, normal, offset }, play));
        }
        ([(_, P), (_, P)], [middle]) => {
            let turned = times(times(near.direction, middle.direction), back(far.direction));
            out.push((Condition::Orientation { angle: turned.y.atan2(turned.x) }, play));
        }
        ([(_, R)], _) => {
            for normal in [Vector2::x(), Vector2::y()] {
                // A pin is two lines that do not turn with the inputs.
                out.push((Condition::Line { a: near.at, b: far.at, normal }, Play { turn: 0.0, ..play }));
            }
        }
        ([(_, P)], _) => {
            let turned = times(near.direction, back(far.direction));
            out.push((Condition::Orientation { angle: turned.y.atan2(turned.x) }, play));
            let normal = quarter(unit(near.direction));
            out.push((Condition::Line { a: near.at, b: far.at, normal }, play));
        }
        ([], _) => {
            let pose = locked.placed();
            for (normal, at) in [(Vector2::x(), near.at), (Vector2::y(), near.at)] {
                out.push((Condition::Line { a: at, b: far.at, normal }, Play { turn: 0.0, ..play }));
            }
            out.push((Condition::Orientation { angle: pose.phi }, play));
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Inside a shown box the poses at the ends of the stretch are found, and none lies on its edge.
    #[test]
    fn a_shown_stretch_holds_its_ends() {
        for family in
            ["3-RPR", "3-RRR", "3-PRR", "3-RRP", "3-PRP", "R_P_R,_P_RR,RP_P_", "3-RR_R_", "3-RP_R_", "3-_R_PR"]
        {
            let (robot, inputs) = Manipulator::of_family(family).expect("a family");
            for mode in robot.forward(&inputs).expect("sound").modes {
                let pose = mode.mode.pose;
                let width = [1e-4, -1e-4, 1e-4];
                let hold = Hold::new(&robot, &inputs, &width, 10.0).expect("holds");
                let radius = hold.contraction_radius(&pose).unwrap_or_else(|| panic!("{family}: {pose:?}"));
                for sign in [-1.0, 1.0] {
                    let end: Vec<f64> = inputs.iter().zip(width).map(|(q, w)| q + sign * w).collect();
                    let moved =
                        Hold::new(&robot, &end, &[0.0; 3], 10.0).expect("holds").settle(&pose).expect("settles");
                    let distance = hold.distance(&pose, &moved);
                    assert!(0.0 < distance && distance <= radius, "{family}: {distance:e} {radius:e}");
                }
            }
        }
    }
}
