//! One assembly mode along a path of inputs: where it goes, where it meets another, which limits it crosses.
//!
//! The path runs straight from row to row. Each stretch of it is halved until the mode is shown to go on through it as the only pose in a box
//! ([`super::hold`], in interval arithmetic), and each end of it lies with a box of its own inside; so a jump to a neighbour, however near, is not a matter of step size. Every hundredth row is also compared with
//! all modes of the complete solver. Where no stretch can be shown any more, the meeting of two modes is sought as a
//! solution of `F = 0, det A = 0` in pose and path parameter together, regular where the modes meet like a parabola; if there is none,
//! the path stops all the same and says so.
//!
//! An id is the number of the mode in [`Manipulator::forward`] at the first row, and belongs to the path: around a cusp a mode becomes another
//! one without any singularity, so that no numbering of modes fits all inputs.
//!
//! **Limits** are watched inside stretches too ([`super::watch`]); that is measured, not proved. What it cannot do: pass through a singularity; watch the
//! limits of a leg without actuator.

use nalgebra::{Matrix4, Vector4};
use thiserror::Error;

use super::describe::Manipulator;
use super::forward::Violation;
use super::hold::Hold;
use super::lock::LockError;
use crate::linkage::Pose;

/// How a path is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// Rows between two comparisons with all modes of the complete solver; the first and the last row are always compared.
    pub compare_every: usize,
    /// The shortest stretch, as a share of the way from row to row, that is tried before the path counts as stopped.
    pub shortest_stretch: f64,
    /// How far the start asked for may be from an assembly mode, in units of the largest length and radians.
    pub start_tolerance: f64,
}

impl Default for PathSettings {
    fn default() -> Self {
        Self { compare_every: 100, shortest_stretch: 1e-13, start_tolerance: 1e-3 }
    }
}

/// The mode in one row of the path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathRow {
    /// Row, from 1.
    pub step: usize,
    /// The inputs.
    pub inputs: Vec<f64>,
    /// The pose.
    pub pose: Pose,
    /// The number of the mode at the path's start, from 1.
    pub id: usize,
    /// det A as [`super::LockedGroup::det_a`] has it, the number that [`Manipulator::forward`] reports for this mode; keeps its sign along the path.
    pub det_a: f64,
}

/// What happens on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathEventKind {
    /// The mode meets another and both end: the path stops here.
    Meeting,
    /// A joint enters or leaves its range; the path goes on. One that is outside in the first row leaves it there.
    Limit {
        /// The joint, its value and its range.
        violation: Violation,
        /// Whether it leaves the range here; else it comes back.
        leaves: bool,
    },
    /// The mode could not be shown to go on, nor to meet another: modes too near to tell apart, or a path along a singularity. The path stops here.
    Branch,
    /// The inputs leave the platform a curve of poses through this one: the path stops here.
    SelfMotion {
        /// The orientation in which the platform translates, in radians; `None` where it turns as it moves.
        phi: Option<f64>,
    },
}

impl PathEventKind {
    /// The name that reports use: `meeting`, `limit`, or `branch` where the path stops without a meeting of two modes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Meeting => "meeting",
            Self::Limit { .. } => "limit",
            Self::Branch | Self::SelfMotion { .. } => "branch",
        }
    }
}

/// An event on a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathEvent {
    /// Where: 2.5 is half-way from row 2 to row 3.
    pub at: f64,
    /// What.
    pub kind: PathEventKind,
    /// The inputs there.
    pub inputs: Vec<f64>,
    /// The pose there.
    pub pose: Pose,
}

/// A followed path.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowedPath {
    /// The rows reached.
    pub rows: Vec<PathRow>,
    /// What happened, in order.
    pub events: Vec<PathEvent>,
    /// Whether the last row was reached.
    pub complete: bool,
    /// For a path that ends with the inputs it began with and was followed to its end: the id of the mode it ended in.
    pub closed_in: Option<usize>,
}

impl FollowedPath {
    /// How far, along the path in actuator space, a row is from the double root that ends it; `None` where none does.
    pub fn distance_to_meeting(&self, step: usize) -> Option<f64> {
        let end = self.events.iter().find(|event| event.kind == PathEventKind::Meeting)?;
        let later = self.rows.iter().filter(|row| row.step >= step).map(|row| &row.inputs);
        let points: Vec<&Vec<f64>> = later.chain([&end.inputs]).collect();
        (points.len() > 1).then(|| points.windows(2).map(|pair| apart(pair[0], pair[1])).sum())
    }
}

/// Why a path cannot be followed at all. Rows are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PathError {
    /// No rows.
    #[error("the path has no rows")]
    Empty,
    /// A row cannot be asked.
    #[error("row {row}: {error}")]
    Inputs {
        /// Row, from 1.
        row: usize,
        /// What is wrong with it.
        error: LockError,
    },
    /// The start asked for is not finite, or no mode is near it.
    #[error("no assembly mode of row 1 is within {tolerance} of the start [{}, {}, {}]", .from.x, .from.y, .from.phi)]
    Start {
        /// The pose asked for.
        from: Pose,
        /// How near a mode must be.
        tolerance: f64,
    },
    /// There is no mode to start from.
    #[error("row 1 has no assembly mode")]
    NoMode,
    /// The first row leaves the platform mobile, and no isolated mode is asked for.
    #[error(
        "row 1 has a self-motion: its inputs leave the platform a curve of poses{}{}; there is no mode to follow",
        motion_text(.phi), start_text(.from)
    )]
    SelfMotion {
        /// The orientation in which the platform translates, in radians; `None` where it turns as it moves.
        phi: Option<f64>,
        /// The start asked for, which lies on the curve.
        from: Option<Pose>,
    },
}

fn motion_text(phi: &Option<f64>) -> String {
    match phi {
        Some(phi) => format!(", a translation at phi = {phi} rad"),
        None => " along which it turns".to_owned(),
    }
}

fn start_text(from: &Option<Pose>) -> String {
    from.map(|p| format!(", through the start [{}, {}, {}]", p.x, p.y, p.phi)).unwrap_or_default()
}

impl Manipulator {
    /// Follows one assembly mode along rows of inputs.
    ///
    /// **Shape**: rows as in [`Manipulator::forward`]; the mode nearest to `from`, or the first one. Limits do not stop a path, they are reported.
    /// **Proof**: between rows the mode is shown, in interval arithmetic, to be the only pose in a box around it; it never jumps. That limits are crossed nowhere
    /// else is measured. **Accuracy**: meetings to about 1e-12 of the inputs, limits to rounding. **Cost**: some fifty microseconds a row, more beside singularities and where limits are watched.
    ///
    /// # Errors
    /// A row of the wrong count or not finite, by number; no mode to start from.
    ///
    /// ```
    /// use assur::{Manipulator, PathEventKind, PathSettings};
    /// let (robot, inputs) = Manipulator::of_family("3-RPR")?;
    /// let shrink = |k: usize| inputs.map(|q| q * (1.0 - 0.05 * k as f64)).to_vec();
    /// let path: Vec<Vec<f64>> = (0..20).map(shrink).collect();
    /// let answer = robot.follow(&path, None, &PathSettings::default())?;
    /// // Struts that all shorten cannot reach for ever: the mode meets another, and the path stops there.
    /// assert!(!answer.complete);
    /// assert_eq!(answer.events.last().map(|event| event.kind), Some(PathEventKind::Meeting));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn follow(
        &self,
        path: &[Vec<f64>],
        from: Option<Pose>,
        settings: &PathSettings,
    ) -> Result<FollowedPath, PathError> {
        self.follow_with(path, from, settings, |_| ())
    }

    /// [`Manipulator::follow`] that calls `progress` with the number of rows done, after each.
    ///
    /// # Errors
    /// As [`Manipulator::follow`].
    pub fn follow_with(
        &self,
        path: &[Vec<f64>],
        from: Option<Pose>,
        settings: &PathSettings,
        mut progress: impl FnMut(usize),
    ) -> Result<FollowedPath, PathError> {
        let mut free = self.clone();
        free.legs.iter_mut().for_each(|leg| leg.limits = [None; 3]);
        for (row, inputs) in (1..).zip(path) {
            free.locked_legs(inputs).map_err(|error| PathError::Inputs { row, error })?;
        }
        let first = path.first().ok_or(PathError::Empty)?;
        let scale = self.characteristic_length();
        let (id, pose) = free.start(first, from, settings, scale)?;
        let mut walk = Walk { robot: self, free: &free, scale, settings, pose, spread: 0.0, violated: Vec::new() };
        walk.violated = walk.violations(first, &pose);
        let mut out = FollowedPath { rows: Vec::new(), events: Vec::new(), complete: false, closed_in: None };
        out.events.extend(walk.violated.iter().map(|&violation| PathEvent {
            at: 1.0,
            kind: PathEventKind::Limit { violation, leaves: true },
            inputs: first.clone(),
            pose,
        }));
        if walk.row(&mut out, 1, first, id).is_none() || free.number_of(first, &pose, scale).is_none() {
            out.events.push(PathEvent { at: 1.0, kind: PathEventKind::Meeting, inputs: first.clone(), pose });
            return Ok(out);
        }
        progress(1);
        for (step, pair) in (2..).zip(path.windows(2)) {
            if !walk.advance(&mut out, step - 1, &pair[0], &pair[1]) {
                return Ok(out);
            }
            let compared = step % settings.compare_every.max(1) == 0 || step == path.len();
            let lost = compared && free.number_of(&pair[1], &walk.pose, scale).is_none();
            if walk.row(&mut out, step, &pair[1], id).is_none() || lost {
                let (inputs, pose) = (pair[1].clone(), walk.pose);
                let event = PathEvent { at: step as f64, kind: PathEventKind::Branch, inputs, pose };
                out.events.push(walk.or_self_motion(event, Vec::new()));
                return Ok(out);
            }
            progress(step);
        }
        out.complete = true;
        if path.len() > 1 && path.last() == Some(first) {
            out.closed_in = free.number_of(first, &walk.pose, scale);
        }
        Ok(out)
    }

    /// The number of the mode at the start, from 1, and its pose.
    fn start(
        &self,
        inputs: &[f64],
        from: Option<Pose>,
        settings: &PathSettings,
        scale: f64,
    ) -> Result<(usize, Pose), PathError> {
        let answer = self.forward(inputs).map_err(|error| PathError::Inputs { row: 1, error })?;
        let real = answer.group.self_motions.iter().find(|motion| motion.real);
        if let Some(motion) = real {
            // Poses on the curve solve every condition; those of isolated modes are told from it below.
            let closes = |pose: &Pose| {
                let hold = Hold::new(self, inputs, &vec![0.0; inputs.len()], scale);
                hold.is_some_and(|hold| hold.values(pose).amax() < settings.start_tolerance)
            };
            let isolated = |pose: &Pose| {
                answer.modes.iter().any(|mode| pose_distance(&mode.mode.pose, pose, scale) <= settings.start_tolerance)
            };
            let on_it = from.filter(|pose| closes(pose) && !isolated(pose));
            if on_it.is_some() || answer.modes.is_empty() {
                return Err(PathError::SelfMotion { phi: motion.phi, from: on_it });
            }
        }
        let Some(from) = from else {
            return answer.modes.first().map(|mode| (1, mode.mode.pose)).ok_or(PathError::NoMode);
        };
        let modes = (1..).zip(&answer.modes).map(|(id, mode)| (id, mode.mode.pose));
        let distance = |pose: &Pose| pose_distance(&from, pose, scale);
        let nearest = modes.min_by(|p, q| distance(&p.1).total_cmp(&distance(&q.1))).ok_or(PathError::NoMode)?;
        let tolerance = settings.start_tolerance;
        if distance(&nearest.1) <= tolerance { Ok(nearest) } else { Err(PathError::Start { from, tolerance }) }
    }

    /// The number of the simple mode of these inputs that a pose is.
    fn number_of(&self, inputs: &[f64], pose: &Pose, scale: f64) -> Option<usize> {
        let answer = self.forward(inputs).ok()?;
        let mut same = (1..).zip(&answer.modes).filter(|(_, mode)| pose_distance(&mode.mode.pose, pose, scale) < SAME);
        let (id, mode) = same.next()?;
        // A leg without actuator may reach the one pose in several ways.
        let alone = same.all(|(_, other)| other.mode.pose == mode.mode.pose);
        (alone && mode.mode.multiplicity == 1).then_some(id)
    }
}

/// Poses nearer than this, in units of the characteristic length and radians, are one in a comparison of two solvers: far above the accuracy of
/// either beside a singularity that a step still passes (1e-9).
const SAME: f64 = 1e-8;

/// How near to singular, as the part of the path's direction along the lost wrench, a meeting counts as an ordinary one.
const TRANSVERSAL: f64 = 1e-6;

/// A sought meeting farther away than this, in shares of the way between rows, in characteristic lengths or radians, is another one.
const NEAR: f64 = 0.1;

fn pose_distance(p: &Pose, q: &Pose, scale: f64) -> f64 {
    let turned = super::frame::principal_angle(p.phi - q.phi).abs();
    ((p.x - q.x).abs().max((p.y - q.y).abs()) / scale).max(turned)
}

fn apart(p: &[f64], q: &[f64]) -> f64 {
    p.iter().zip(q).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

pub(super) struct Walk<'a> {
    pub robot: &'a Manipulator,
    /// The same without limits.
    free: &'a Manipulator,
    scale: f64,
    settings: &'a PathSettings,
    pose: Pose,
    /// How far from `pose`, in units of the scale and radians, the exact one may be.
    spread: f64,
    pub violated: Vec<Violation>,
}

/// A stretch through which the mode is shown to go on.
pub(super) struct Shown {
    /// Its middle, and the half width of the box around it that holds the mode.
    pub centre: Pose,
    pub radius: f64,
    /// The pose at the end, and how far the exact one may be.
    arrived: Pose,
    spread: f64,
}

/// What is known of a stretch's limits: from where to where on the way between rows.
pub(super) struct Stretch<'a> {
    pub step: usize,
    pub from: &'a [f64],
    pub to: &'a [f64],
    pub shown: &'a Shown,
    /// The pose at its start.
    pub begin: Pose,
}

impl Walk<'_> {
    pub fn hold(&self, inputs: &[f64], half_width: &[f64]) -> Option<Hold> {
        Hold::new(self.free, inputs, half_width, self.scale)
    }

    /// Books the pose of a row; `None` where it is singular.
    fn row(&self, out: &mut FollowedPath, step: usize, inputs: &[f64], id: usize) -> Option<()> {
        let det_a = self.free.lock(inputs).ok()?.det_a(&self.pose);
        out.rows.push(PathRow { step, inputs: inputs.to_vec(), pose: self.pose, id, det_a });
        (det_a != 0.0).then_some(())
    }

    /// From one row to the next; false where the mode does not get there.
    fn advance(&mut self, out: &mut FollowedPath, step: usize, from: &[f64], to: &[f64]) -> bool {
        if from == to {
            return true;
        }
        let at = |t: f64| blend(from, to, t);
        let (mut t, mut stretch) = (0.0, 1.0_f64);
        while t < 1.0 {
            let end = if stretch >= 1.0 - t { 1.0 } else { t + stretch };
            match self.shown(&at((t + end) / 2.0), &blend_width(from, to, (end - t) / 2.0), &at(end)) {
                Some(shown) => {
                    let begin = self.pose;
                    self.watch_limits(out, &Stretch { step, from, to, shown: &shown, begin }, [t, end]);
                    (self.pose, self.spread) = (shown.arrived, shown.spread);
                    t = end;
                    stretch *= 2.0;
                }
                None => {
                    stretch = (end - t) / 2.0;
                    if stretch < self.settings.shortest_stretch {
                        let unknown = || PathEvent {
                            at: step as f64 + t,
                            kind: PathEventKind::Branch,
                            inputs: at(t),
                            pose: self.pose,
                        };
                        let event = self.meeting(step, from, to, t).unwrap_or_else(unknown);
                        let written = (1..=6).map(|digits| rounded(event.at - step as f64, digits));
                        let beside: Vec<(f64, Vec<f64>)> =
                            written.chain([1.0, 0.0]).map(|t| (step as f64 + t, at(t))).collect();
                        out.events.push(self.or_self_motion(event, beside));
                        return false;
                    }
                }
            }
        }
        true
    }

    /// The end of a path, as a self-motion where these inputs, or others beside them, leave the platform free to move.
    ///
    /// There det A vanishes as at a meeting; and the path ends beside the exact inputs, which are looked for at decimals of the way only.
    fn or_self_motion(&self, event: PathEvent, beside: Vec<(f64, Vec<f64>)>) -> PathEvent {
        let size = event.inputs.iter().fold(1.0, |size: f64, q| size.max(q.abs()));
        let candidates = std::iter::once((event.at, event.inputs.clone())).chain(beside);
        let near = candidates.filter(|(_, other)| apart(other, &event.inputs) <= BESIDE * size);
        let found = near.into_iter().find_map(|(at, inputs)| {
            let answer = self.free.forward(&inputs).ok()?;
            let here = |phi: f64| super::frame::principal_angle(phi - event.pose.phi).abs() < NEAR;
            let real = answer.group.self_motions.into_iter().find(|motion| motion.real && motion.phi.is_none_or(here));
            real.map(|motion| (at, inputs, motion.phi))
        });
        match found {
            // The exact inputs, and the last pose before them.
            Some((at, inputs, phi)) => PathEvent { at, inputs, kind: PathEventKind::SelfMotion { phi }, ..event },
            None => event,
        }
    }

    /// The pose at the end of a stretch, if the mode is shown to go on through it.
    fn shown(&self, middle: &[f64], half_width: &[f64], end: &[f64]) -> Option<Shown> {
        let hold = self.hold(middle, half_width)?;
        let centre = hold.settle(&self.pose)?;
        let radius = hold.contraction_radius(&centre)?;
        let ending = self.hold(end, &vec![0.0; end.len()])?;
        let arrived = ending.settle(&centre)?;
        // The one exact pose near each end is the one in the box.
        let spread = ending.contraction_radius(&arrived)?;
        let inside = |pose: &Pose, spread: f64| hold.distance(pose, &centre) + spread <= radius * INNER;
        let within = inside(&self.pose, self.spread) && inside(&arrived, spread);
        within.then_some(Shown { centre, radius, arrived, spread })
    }

    /// The meeting of two modes near the present pose, ahead on the path.
    fn meeting(&self, step: usize, from: &[f64], to: &[f64], t: f64) -> Option<PathEvent> {
        let length = self.scale;
        let start = Vector4::new(self.pose.x / length, self.pose.y / length, self.pose.phi, t);
        let pose_of = |u: &Vector4<f64>| Pose::new(u.x * length, u.y * length, u.z);
        let value = |u: &Vector4<f64>| -> Option<Vector4<f64>> {
            let hold = self.hold(&blend(from, to, u.w), &vec![0.0; from.len()])?;
            let at = hold.values(&pose_of(u));
            Some(Vector4::new(at.x, at.y, at.z, hold.determinant(&pose_of(u))))
        };
        let jacobian = |u: &Vector4<f64>| -> Option<Matrix4<f64>> {
            let mut out = Matrix4::zeros();
            for k in 0..4 {
                let mut offset = Vector4::zeros();
                offset[k] = DIFFERENCE;
                out.set_column(k, &((value(&(u + offset))? - value(&(u - offset))?) / (2.0 * DIFFERENCE)));
            }
            Some(out)
        };
        let mut u = start;
        let (mut settled, mut before) = (false, f64::INFINITY);
        for _ in 0..MEETING_STEPS {
            let change = jacobian(&u)?.lu().solve(&value(&u)?)?;
            if !change.iter().all(|c| c.is_finite()) || (u - change - start).amax() > NEAR {
                return None;
            }
            u -= change;
            let size = change.amax();
            // Rounding is reached where small steps no longer shrink.
            settled = size <= f64::EPSILON || size < MEETING_SETTLED && size >= 0.5 * before;
            if settled {
                break;
            }
            before = size;
        }
        // The modes end here only if the path crosses: its direction does work on the wrench that is lost.
        let slopes = jacobian(&u)?;
        let decomposition = slopes.fixed_view::<3, 3>(0, 0).clone_owned().svd(true, false);
        let lost = decomposition.u?.column(decomposition.singular_values.imin()).clone_owned();
        let along = slopes.fixed_view::<3, 1>(0, 3).clone_owned();
        let crosses = lost.dot(&along).abs() > TRANSVERSAL * along.norm();
        let ahead = t - MEETING_SETTLED <= u.w && u.w <= 1.0 + MEETING_SETTLED;
        let pose = pose_of(&u);
        (settled && crosses && ahead).then(|| PathEvent {
            at: step as f64 + u.w,
            kind: PathEventKind::Meeting,
            inputs: blend(from, to, u.w),
            pose: Pose { phi: super::frame::principal_angle(pose.phi), ..pose },
        })
    }
}

/// Rounding of a distance of poses against the box it must stay in.
const INNER: f64 = 1.0 - 1e-12;
/// Inputs within this of a path's end, in their own sizes, are looked at for a self-motion that the end only nears.
const BESIDE: f64 = 1e-5;

/// A share of the way to so many decimals: where a path passes through a self-motion, it is mostly at a number written down by someone.
fn rounded(t: f64, digits: i32) -> f64 {
    let parts = 10f64.powi(digits);
    (t * parts).round() / parts
}

/// Half-widths of central differences: the cube root of rounding.
const DIFFERENCE: f64 = 6e-6;
/// Steps of Newton's method on a meeting.
const MEETING_STEPS: usize = 60;
/// A meeting has settled once steps below this, in characteristic lengths, radians and shares of the way between rows, no longer shrink.
const MEETING_SETTLED: f64 = 1e-12;

pub(super) fn blend(from: &[f64], to: &[f64], t: f64) -> Vec<f64> {
    from.iter().zip(to).map(|(a, b)| if t == 1.0 { *b } else { a + t * (b - a) }).collect()
}

/// The half widths of the inputs on a stretch, with the rounding of its ends.
fn blend_width(from: &[f64], to: &[f64], half: f64) -> Vec<f64> {
    let rounding = |a: f64, b: f64| 2.0 * f64::EPSILON * a.abs().max(b.abs());
    from.iter().zip(to).map(|(a, b)| half * (b - a).abs() + if a == b { 0.0 } else { rounding(*a, *b) }).collect()
}
