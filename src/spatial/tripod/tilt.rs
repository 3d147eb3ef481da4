//! How far can the tool be tilted at a place, whatever the azimuth?
//!
//! From the home orientation (the identity) the platform turns by `theta` about an axis square to the tool's, in the azimuth `phi`; torsion is zero and the tool's point stays.
//! Along one azimuth each limit is a quartic in `tan(theta/2)`; its first root is where it ends. Over azimuths the end of one limit is a smooth function, least where its derivative, implicit
//! in the quartic, vanishes; where two limits meet, the lesser of the two has a peak, so that no corner is ever the worst azimuth. Sectors of azimuths in which a limit is
//! shown to hold up to the least found so far are left out, so that no azimuth is overlooked; what is left is halved and followed to where it is stationary.
//!
//! The azimuth is that of the tilt axis, as in the paper; Bonev's usual one, of the tilted tool, differs by 90°. Singularities of type 2 are no limits here; an
//! angle limit of the planes below 45° excludes them for the Cartesian robot.

use std::f64::consts::{PI, TAU};

use nalgebra::{Rotation3, Vector3};
use rayon::prelude::*;

use super::super::error::moderate;
use super::model::{Tripod, TripodError, TripodPose};
use super::sector::{Quartic, Sector, first_end};
use super::tilt_limits::limits;

/// What ends a tilt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TiltLimit {
    /// A slider at an end of its stroke.
    Stroke {
        /// Slider, from 1 to 6.
        slider: usize,
        /// Whether at the upper end.
        upper: bool,
    },
    /// A leg's plane at its largest angle.
    PlaneAngle {
        /// Leg, from 1.
        leg: usize,
    },
    /// A leg's plane along its rails.
    AlongRail {
        /// Leg, from 1.
        leg: usize,
    },
    /// Nothing before a half turn.
    HalfTurn,
}

/// The largest tilt that every azimuth allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    /// The angle, in radians.
    pub angle: f64,
    /// The worst azimuth, of the axis, in radians in `[0, 2 pi)`.
    pub azimuth: f64,
    /// What ends the tilt there.
    pub limit: TiltLimit,
}

/// Azimuths looked at first, for a tilt to compare with (heuristic: of 8 to 64 the quickest).
const GRID: usize = 16;
/// A sector is left out where its limits are shown to hold up to the least tangent found less this part of it. Every worse azimuth is then within it.
const NEARLY: f64 = 1e-4;
/// Sectors looked at for one limit: a limit that hardly depends on the azimuth takes some hundred. Beyond, the search gives up and only [`Tripod::tilt_bound`] can tell.
const SECTORS: u32 = 2000;
/// Sectors looked at for one limit in a proof.
const SECTORS_PROVED: u32 = 100_000;
/// Sectors are not halved below this, in radians: their bounds are off by its square, which no tolerance asks for.
const FINEST: f64 = 1e-6;
/// The worst azimuth is sought to this, in radians: the angle is stationary there and good to its square.
const SETTLED: f64 = 1e-9;
/// Steps in the search for it: bisection alone needs thirty.
const STEPS: u32 = 60;
/// Half of the farthest tilt that is looked at, 177°: beyond, the tangent runs away; nothing is expected there, and a limit that holds until then is none.
const FARTHEST: f64 = 0.5 * 3.09;
/// Margin of a proof for rounding, over the largest coefficient: each comes from a few hundred roundings, which do not add up to this.
const ROUNDING: f64 = 256.0 * f64::EPSILON;
/// Below this length of its projection, in units of its own, the tool's axis is vertical (heuristic).
const VERTICAL: f64 = 1e-9;

impl Tripod {
    /// The largest tilt of the tool at a place that every azimuth allows; `None` where the home orientation itself is out of limits.
    ///
    /// **Units**: radians; the place is that of the tool's point, in the base frame. **Accuracy**: a few roundings at the worst azimuth found, which is stationary to `1e-9`; no azimuth is worse by more
    /// than about `1e-4` of the angle, by bounds over sectors of azimuths. [`Tripod::tilt_bound`] proves it to a tolerance of your own. **Cost**: some tens of microseconds.
    ///
    /// # Errors
    /// A place that is not finite; a leg without a plane in the home orientation.
    ///
    /// ```
    /// use assur::{Tripod, nalgebra::Vector3};
    /// let robot = Tripod::cartesian_example();
    /// let tip = Vector3::repeat(250.0) + robot.tool;
    /// let tilt = robot.tilt(&tip)?.unwrap();
    /// assert!((tilt.angle.to_degrees() - 25.761932975859754).abs() < 1e-6);
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn tilt(&self, place: &Vector3<f64>) -> Result<Option<Tilt>, TripodError> {
        let Some(limits) = limits(self, place)? else { return Ok(None) };
        let mut worst = End { t: FARTHEST.tan(), azimuth: 0.0 };
        let mut binding = None;
        for k in 0..GRID {
            let azimuth = TAU / GRID as f64 * k as f64;
            for (j, (_, limit)) in limits.iter().enumerate() {
                if let Some(t) = first_end(&limit.ray([azimuth.cos(), azimuth.sin()]), worst.t) {
                    (worst, binding) = (End { t, azimuth }, Some(j));
                }
            }
        }
        if let Some(j) = binding {
            worst = settled(&limits[j].1, worst, TAU / GRID as f64);
        }
        for (j, (_, limit)) in limits.iter().enumerate() {
            let before = worst.t;
            let mut sectors = SECTORS;
            limit.quadrants().iter().for_each(|quadrant| search(limit, quadrant, &mut worst, &mut sectors));
            if worst.t < before {
                binding = Some(j);
            }
        }
        Ok(Some(match binding {
            Some(j) => Tilt { angle: 2.0 * worst.t.atan(), azimuth: worst.azimuth.rem_euclid(TAU), limit: limits[j].0 },
            None => Tilt { angle: PI, azimuth: 0.0, limit: TiltLimit::HalfTurn },
        }))
    }

    /// The largest tilt in one azimuth (radians), exactly: the first root of a quartic for each limit; `None` as for [`Tripod::tilt`].
    ///
    /// # Errors
    /// As [`Tripod::tilt`].
    pub fn tilt_along(&self, place: &Vector3<f64>, azimuth: f64) -> Result<Option<(f64, TiltLimit)>, TripodError> {
        moderate(|| "azimuth".to_owned(), azimuth)?;
        let Some(limits) = limits(self, place)? else { return Ok(None) };
        let (mut best, mut binding) = (FARTHEST.tan(), None);
        for (limit, quartic) in &limits {
            if let Some(t) = first_end(&quartic.ray([azimuth.cos(), azimuth.sin()]), best) {
                (best, binding) = (t, Some(*limit));
            }
        }
        Ok(Some(binding.map_or((PI, TiltLimit::HalfTurn), |limit| (2.0 * best.atan(), limit))))
    }

    /// A tilt that every azimuth is shown to allow, at most `tolerance` (radians) below `tilt`, which [`Tripod::tilt`] gave; `None` where that is not shown.
    ///
    /// **Proof**: over a sector of azimuths each limit has Bernstein coefficients in distance and direction; sectors are halved until all of them are positive up to the
    /// tilt returned. Rounding is covered by a margin, not by interval arithmetic. Up to 177°. **Cost**: some tens of microseconds; some hundred where a limit hardly depends on the azimuth.
    ///
    /// # Errors
    /// As [`Tripod::tilt`].
    pub fn tilt_bound(&self, place: &Vector3<f64>, tilt: &Tilt, tolerance: f64) -> Result<Option<f64>, TripodError> {
        let Some(limits) = limits(self, place)? else { return Ok(None) };
        let claimed = (tilt.angle - tolerance).min(2.0 * FARTHEST);
        if claimed <= 0.0 {
            return Ok(Some(0.0));
        }
        let until = (0.5 * claimed).tan();
        let kept = |limit: &Quartic| {
            let mut sectors = SECTORS_PROVED;
            limit.quadrants().iter().all(|quadrant| proved(quadrant, until, &mut sectors))
        };
        Ok(limits.iter().all(|(_, limit)| kept(limit)).then_some(claimed))
    }

    /// Largest tilts over a grid of places `corner + i·along[0] + j·along[1]`, row by row in `j`; `None` where out of limits or without a plane. `progress` is told, from any
    /// thread, that another row is done.
    ///
    /// Rows are shared out among rayon's threads; the values do not depend on how many there are. **Cost**: [`Tripod::tilt`] a place.
    ///
    /// # Errors
    /// A place that is not finite.
    ///
    /// ```
    /// use assur::{Tripod, nalgebra::Vector3};
    /// let robot = Tripod::cartesian_example();
    /// let along = [Vector3::x() * 100.0, Vector3::y() * 100.0];
    /// let map = robot.tilt_map(&Vector3::new(50.0, 50.0, 150.0), along, [4, 3], || ())?;
    /// assert_eq!((map.len(), map.iter().flatten().count()), (12, 12));
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn tilt_map(
        &self,
        corner: &Vector3<f64>,
        along: [Vector3<f64>; 2],
        size: [usize; 2],
        progress: impl Fn() + Sync,
    ) -> Result<Vec<Option<f64>>, TripodError> {
        let row = |row: usize| -> Result<Vec<Option<f64>>, TripodError> {
            let place = |column: usize| corner + along[0] * column as f64 + along[1] * row as f64;
            let values = (0..size[0]).map(|column| Ok(self.tilt(&place(column))?.map(|tilt| tilt.angle))).collect();
            progress();
            values
        };
        let rows: Vec<_> = (0..size[1]).into_par_iter().map(row).collect::<Result<_, _>>()?;
        Ok(rows.concat())
    }

    /// The paper's robot as the maps have it: `d1 = 600`, `d2 = 720`, strokes 0 to 500, planes within 40°, the tool's point 150 behind the platform's origin along `(1, 1, 1)`.
    pub fn cartesian_example() -> Self {
        let robot = Self::cartesian(600.0, 720.0).expect("the distances differ");
        let axis = Vector3::repeat(1.0).normalize();
        Self {
            strokes: Some([[0.0, 500.0]; 6]),
            tool: axis * -150.0,
            tool_axis: axis,
            plane_angle_limit: Some(40_f64.to_radians()),
            ..robot
        }
    }

    /// The two axes across the tool's, from which azimuths are measured: `x''` is the tool's axis times `z`, or `x` where that vanishes.
    pub fn tilt_axes(&self) -> [Vector3<f64>; 2] {
        let z = self.tool_axis;
        let across = z.cross(&Vector3::z());
        let x = if across.norm() > VERTICAL { across.normalize() } else { Vector3::x() };
        [x, z.cross(&x)]
    }
}

/// Where a limit ends in an azimuth.
#[derive(Clone, Copy)]
struct End {
    /// `tan(theta/2)`.
    t: f64,
    azimuth: f64,
}

/// Every azimuth of a sector in which a limit could end before the worst one so far: halved, followed downhill, until shown that there is none.
fn search(limit: &Quartic, sector: &Sector, worst: &mut End, sectors: &mut u32) {
    if *sectors == 0 || sector.half < FINEST || sector.kept((1.0 - NEARLY) * worst.t, 0.0) {
        return;
    }
    *sectors -= 1;
    let [left, right] = sector.halves();
    if let Some(t) = first_end(&right.first_edge(), worst.t) {
        *worst = settled(limit, End { t, azimuth: right.start }, right.half);
    }
    search(limit, &left, worst, sectors);
    search(limit, &right, worst, sectors);
}

/// Whether a limit is shown to hold over a sector.
fn proved(sector: &Sector, until: f64, sectors: &mut u32) -> bool {
    if sector.kept(until, ROUNDING) {
        return true;
    }
    // An edge is part of the sector: where the limit ends on it there is nothing to show.
    if *sectors == 0 || sector.half < FINEST || first_end(&sector.first_edge(), until).is_some() {
        return false;
    }
    *sectors -= 1;
    let [left, right] = sector.halves();
    proved(&left, until, sectors) && proved(&right, until, sectors)
}

/// The end of a limit followed downhill from an azimuth, by steps that grow from `step`, and to where it is stationary: Newton's method on the derivative, kept between bounds.
///
/// `F(t, phi) = 0` gives `dt/dphi = -F_phi/F_t`, and `F_t < 0` where a limit ends first: it is stationary where `F_phi = 0`.
fn settled(limit: &Quartic, from: End, step: f64) -> End {
    let once = limit.by_angle();
    let twice = once.by_angle();
    // The end in an azimuth, the sign of its slope, and the azimuth that Newton's method proposes.
    let look = |azimuth: f64| -> Option<(End, f64, f64)> {
        let direction = [azimuth.cos(), azimuth.sin()];
        let ray = limit.ray(direction);
        let t = first_end(&ray, FARTHEST.tan())?;
        let ([_, steepness], [slope, cross]) =
            (value_and_derivative(&ray, t), value_and_derivative(&once.ray(direction), t));
        let [bend, _] = value_and_derivative(&twice.ray(direction), t);
        Some((End { t, azimuth }, slope, azimuth - slope / (bend - cross * slope / steepness)))
    };
    let Some((mut best, slope, mut newton)) = look(from.azimuth) else { return from };
    if slope == 0.0 {
        return best;
    }
    let downhill = -slope.signum();
    let (mut low, mut width) = (best.azimuth, step);
    let mut high = low + downhill * width;
    while width < PI {
        match look(high) {
            Some((end, slope, next)) if slope * downhill < 0.0 && end.t < best.t => {
                (best, low, newton) = (end, high, next);
                width *= 2.0;
                high = low + downhill * width;
            }
            _ => break,
        }
    }
    for _ in 0..STEPS {
        let between = (newton - low) * downhill > 0.0 && (high - newton) * downhill > 0.0;
        let azimuth = if between { newton } else { 0.5 * (low + high) };
        let last = low.max(high) - low.min(high) <= SETTLED || (between && (azimuth - best.azimuth).abs() <= SETTLED);
        match look(azimuth) {
            Some((end, slope, next)) => {
                if end.t < best.t {
                    best = end;
                }
                // A farther branch of the end slopes as it likes: only one that came down is followed.
                if slope * downhill < 0.0 && end.t <= best.t {
                    low = azimuth;
                } else {
                    high = azimuth;
                }
                newton = next;
            }
            None => high = azimuth,
        }
        if last {
            break;
        }
    }
    if best.t < from.t { best } else { from }
}

/// A polynomial and its derivative.
fn value_and_derivative(p: &[f64; 5], t: f64) -> [f64; 2] {
    p.iter().rev().fold([0.0; 2], |[value, derivative], x| [value * t + x, derivative * t + value])
}

/// The rotation of a tilt: by `angle` about the axis of the azimuth, both in radians.
pub(super) fn tilted(robot: &Tripod, angle: f64, azimuth: f64) -> Rotation3<f64> {
    let [x, y] = robot.tilt_axes();
    Rotation3::new((x * azimuth.cos() + y * azimuth.sin()) * angle)
}

impl Tripod {
    /// The pose with the tool's point in a place, tilted by `angle` about the axis of an azimuth (radians).
    pub fn tilted_pose(&self, place: &Vector3<f64>, angle: f64, azimuth: f64) -> TripodPose {
        let rotation = tilted(self, angle, azimuth);
        TripodPose { position: place - rotation * self.tool, rotation }
    }
}
