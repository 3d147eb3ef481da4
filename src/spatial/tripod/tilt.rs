//! How far can the tool be tilted at a place, whatever the azimuth?
//!
//! From the home orientation (the identity) the platform turns by `theta` about an axis square to the tool's, in the azimuth `phi`; torsion is zero and the tool's point stays. Then
//! `R` is `a aᵀ + cos theta (1 - a aᵀ) + sin theta [a]`, so every limit is a trigonometric polynomial of order at most 2 in `theta`, a quartic in `tan(theta/2)`, and the
//! first root at which it turns negative is the largest tilt of that azimuth. Over azimuths the least is sought limit by limit, each a smooth function: on a
//! grid, then refined. [`Tripod::tilt_bound`] proves that no azimuth is worse, to a tolerance, by bounds over arcs of azimuths.
//!
//! The azimuth is that of the tilt axis, as in the paper; Bonev's usual one, of the tilted tool, differs by 90°. Singularities of type 2 are no limits here; an
//! angle limit of the planes below 45° excludes them for the Cartesian robot.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Rotation3, Vector3};
use rayon::prelude::*;

use super::super::error::moderate;
use super::model::{Tripod, TripodError, TripodPose};

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

/// Azimuths looked at first. The limits are of order 4 in the azimuth at most, so they turn no more often than eight times.
const GRID: usize = 32;
/// A local least of the grid this much above the best is not refined: between neighbours on the grid no limit of order 4 falls so far (heuristic).
const PROMISING: f64 = 1.15;
/// Evaluations in the refinement of one least.
const REFINEMENTS: usize = 24;
/// The worst azimuth is sought to this, in radians: the angle is stationary there and good to its square.
const SETTLED: f64 = 1e-6;
/// Halvings in the search for a root.
const DEPTH: u32 = 40;
/// Half of the farthest tilt that is looked at, 177°: beyond, the tangent runs away; nothing is expected there, and a limit that holds until then is none.
const FARTHEST: f64 = 0.5 * 3.09;
/// Arcs of azimuths are not halved below this, in radians.
const FINEST: f64 = 1e-7;

/// `k0 + k1 c + k2 s + k3 c² + k4 s c` in the cosine and sine of the tilt.
type Order2 = [f64; 5];

/// Limits of one azimuth: twelve of strokes, six of angles, three of rails.
const LIMITS: usize = 21;

/// A limit that is not there is never met.
const NEVER: Order2 = [1.0, 0.0, 0.0, 0.0, 0.0];

impl Tripod {
    /// The largest tilt of the tool at a place that every azimuth allows; `None` where the home orientation itself is out of limits.
    ///
    /// **Units**: radians; the place is that of the tool's point, in the base frame. **Accuracy**: exact along each azimuth; the worst azimuth to about `1e-9`, found from
    /// 32; [`Tripod::tilt_bound`] proves it to a tolerance. **Cost**: some tens of microseconds.
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
        let Some(frame) = TiltFrame::new(self, place)? else { return Ok(None) };
        let step = TAU / GRID as f64;
        // Everything in t = tan(theta/2), which grows with the tilt.
        let (mut best, mut found) = (FARTHEST.tan(), None);
        let mut table = [[f64::INFINITY; LIMITS]; GRID];
        for (k, row) in table.iter_mut().enumerate() {
            let azimuth = step * k as f64;
            for (j, quadratic) in frame.limits(azimuth).iter().enumerate() {
                // What ends far beyond the best so far need not be known.
                if let Some(t) = first_end(quadratic, (PROMISING * best).min(FARTHEST.tan())) {
                    row[j] = t;
                    if t < best {
                        (best, found) = (t, Some((azimuth, j)));
                    }
                }
            }
        }
        let columns: [[f64; GRID]; LIMITS] = std::array::from_fn(|j| table.map(|row| row[j]));
        for (j, around) in columns.iter().enumerate() {
            for (k, &here) in around.iter().enumerate() {
                let (before, after) = (around[(k + GRID - 1) % GRID], around[(k + 1) % GRID]);
                if here.is_finite() && here <= before && here <= after && here <= PROMISING * best {
                    let value =
                        |azimuth: f64| first_end(&frame.one_limit(azimuth, j), FARTHEST.tan()).unwrap_or(f64::INFINITY);
                    let (azimuth, t) = least(value, step * k as f64, step, [before, here, after]);
                    if t < best {
                        (best, found) = (t, Some((azimuth.rem_euclid(TAU), j)));
                    }
                }
            }
        }
        Ok(Some(match found {
            Some((azimuth, j)) => Tilt { angle: 2.0 * best.atan(), azimuth, limit: frame.limit(j) },
            None => Tilt { angle: PI, azimuth: 0.0, limit: TiltLimit::HalfTurn },
        }))
    }

    /// The largest tilt in one azimuth (radians), exactly: the first root of a quartic for each limit; `None` as for [`Tripod::tilt`].
    ///
    /// # Errors
    /// As [`Tripod::tilt`].
    pub fn tilt_along(&self, place: &Vector3<f64>, azimuth: f64) -> Result<Option<(f64, TiltLimit)>, TripodError> {
        moderate(|| "azimuth".to_owned(), azimuth)?;
        let Some(frame) = TiltFrame::new(self, place)? else { return Ok(None) };
        let (mut best, mut limit) = (FARTHEST.tan(), None);
        for (j, quadratic) in frame.limits(azimuth).iter().enumerate() {
            if let Some(t) = first_end(quadratic, best) {
                (best, limit) = (t, Some(j));
            }
        }
        Ok(Some(limit.map_or((PI, TiltLimit::HalfTurn), |j| (2.0 * best.atan(), frame.limit(j)))))
    }

    /// A tilt that every azimuth is shown to allow, at most `tolerance` (radians) below `tilt`, which [`Tripod::tilt`] gave; `None` where that is not shown.
    ///
    /// **Proof**: turning the axis by `h` moves every joint axis by at most `2 h theta`, which bounds each limit over an arc of azimuths by its value in the middle;
    /// arcs are halved until the bounds are positive for all tilts up to the one returned. Rounding is covered by a margin, not by interval arithmetic.
    /// **Cost**: some hundred microseconds at a tolerance of `1e-3`.
    ///
    /// # Errors
    /// As [`Tripod::tilt`].
    pub fn tilt_bound(&self, place: &Vector3<f64>, tilt: &Tilt, tolerance: f64) -> Result<Option<f64>, TripodError> {
        let Some(frame) = TiltFrame::new(self, place)? else { return Ok(None) };
        let claimed = tilt.angle - tolerance;
        if claimed <= 0.0 {
            return Ok(Some(0.0));
        }
        // (0, pi) is covered; a full half turn would put tan(theta/2) at infinity.
        let claimed = claimed.min(PI - 1e-6);
        let mut arcs: Vec<(f64, f64)> = (0..16).map(|k| (TAU / 16.0 * (f64::from(k) + 0.5), TAU / 32.0)).collect();
        while let Some((middle, half)) = arcs.pop() {
            let slack = frame.slack(half, claimed);
            let holds = |(j, quadratic): (usize, &Order2)| {
                let mut lowered = *quadratic;
                lowered[0] -= slack[j];
                // The limits hold at home; the loss grows with the tilt, so small tilts are looked at with a smaller one.
                positive_up_to(quadratic, &|theta: f64| slack[j] * theta / claimed, claimed) || {
                    first_end(&lowered, (0.5 * claimed).tan()).is_none() && value(&lowered, 1.0, 0.0) > 0.0
                }
            };
            if frame.limits(middle).iter().enumerate().all(holds) {
                continue;
            }
            if half < FINEST {
                return Ok(None);
            }
            arcs.extend([(middle - 0.5 * half, 0.5 * half), (middle + 0.5 * half, 0.5 * half)]);
        }
        Ok(Some(claimed))
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
        let x = if across.norm() > 1e-9 { across.normalize() } else { Vector3::x() };
        [x, z.cross(&x)]
    }
}

/// The numbers of a robot at a place that do not depend on the azimuth.
struct TiltFrame<'a> {
    robot: &'a Tripod,
    axes: [Vector3<f64>; 2],
    place: Vector3<f64>,
    /// Sign of `n · u` at home, for each leg.
    signs: [f64; 3],
    tangent: Option<f64>,
}

impl<'a> TiltFrame<'a> {
    /// `None` where home is out of limits.
    fn new(robot: &'a Tripod, place: &Vector3<f64>) -> Result<Option<Self>, TripodError> {
        place.iter().try_for_each(|&x| moderate(|| "place".to_owned(), x))?;
        let home = TripodPose { position: place - robot.tool, rotation: Rotation3::identity() };
        let inputs = robot.inverse(&home)?;
        if !robot.violations(&home, &inputs)?.is_empty() {
            return Ok(None);
        }
        let signs = robot.legs.each_ref().map(|leg| leg.v.cross(&leg.w).dot(&leg.u).signum());
        // Planes at a right angle and beyond are excluded by `AlongRail`.
        let tangent = robot.plane_angle_limit.filter(|&limit| limit < FRAC_PI_2).map(f64::tan);
        Ok(Some(Self { robot, axes: robot.tilt_axes(), place: *place, signs, tangent }))
    }

    /// Every limit in one azimuth, not negative where it is kept.
    fn limits(&self, azimuth: f64) -> [Order2; LIMITS] {
        let axis = self.axis(azimuth);
        let mut limits = [NEVER; LIMITS];
        for leg in 0..3 {
            let of_leg = self.leg_limits(axis, leg);
            limits[4 * leg..4 * leg + 4].copy_from_slice(&of_leg[..4]);
            limits[12 + 2 * leg..14 + 2 * leg].copy_from_slice(&of_leg[4..6]);
            limits[18 + leg] = of_leg[6];
        }
        limits
    }

    /// One of them.
    fn one_limit(&self, azimuth: f64, j: usize) -> Order2 {
        let (leg, place) = match j {
            0..12 => (j / 4, j % 4),
            12..18 => ((j - 12) / 2, 4 + j % 2),
            _ => (j - 18, 6),
        };
        self.leg_limits(self.axis(azimuth), leg)[place]
    }

    /// The tilt axis of an azimuth.
    fn axis(&self, azimuth: f64) -> Vector3<f64> {
        let (sine, cosine) = azimuth.sin_cos();
        self.axes[0] * cosine + self.axes[1] * sine
    }

    /// The limits of one leg: both ends of both strokes, the plane's angle either way, the plane along the rails.
    fn leg_limits(&self, a: Vector3<f64>, k: usize) -> [Order2; 7] {
        // A rotated vector is x + y cos + z sin.
        let turned = |v: &Vector3<f64>| {
            let fixed = a * a.dot(v);
            [fixed, v - fixed, a.cross(v)]
        };
        let mut limits = [NEVER; 7];
        let leg = &self.robot.legs[k];
        let normal = turned(&leg.v).map(|part| part.cross(&leg.w) * self.signs[k]);
        let first = |d: &Vector3<f64>| [normal[0].dot(d), normal[1].dot(d), normal[2].dot(d), 0.0, 0.0];
        let along = first(&leg.u);
        limits[6] = along;
        if let Some(tangent) = self.tangent {
            let across = first(&leg.across());
            limits[4] = std::array::from_fn(|i| tangent * along[i] - across[i]);
            limits[5] = std::array::from_fn(|i| tangent * along[i] + across[i]);
        }
        let Some(strokes) = &self.robot.strokes else { return limits };
        let arm = turned(&(leg.c - self.robot.tool));
        let ss = normal[2].dot(&arm[2]);
        let arms = [
            normal[0].dot(&arm[0]) + ss,
            normal[0].dot(&arm[1]) + normal[1].dot(&arm[0]),
            normal[0].dot(&arm[2]) + normal[2].dot(&arm[0]),
            normal[1].dot(&arm[1]) - ss,
            normal[1].dot(&arm[2]) + normal[2].dot(&arm[1]),
        ];
        for (slider, rail) in [leg.da, leg.db].into_iter().enumerate() {
            let rest = first(&(self.place - rail));
            let [low, high] = strokes[2 * k + slider];
            for i in 0..5 {
                let height = arms[i] + rest[i];
                limits[2 * slider][i] = height - low * along[i];
                limits[2 * slider + 1][i] = high * along[i] - height;
            }
        }
        limits
    }

    fn limit(&self, j: usize) -> TiltLimit {
        match j {
            0..12 => TiltLimit::Stroke { slider: j / 2 + 1, upper: j % 2 == 1 },
            12..18 => TiltLimit::PlaneAngle { leg: (j - 12) / 2 + 1 },
            _ => TiltLimit::AlongRail { leg: j - 17 },
        }
    }

    /// How much each limit can lose when the azimuth moves by up to `half`, at tilts up to `theta`; a margin for rounding included.
    fn slack(&self, half: f64, theta: f64) -> [f64; LIMITS] {
        // |Q R Qᵀ - R| ≤ 2 |Q - 1| |R - 1| ≤ 2 half theta.
        let moved = 2.0 * half * theta;
        let tangent = self.tangent.unwrap_or(0.0);
        let mut slack = [0.0; LIMITS];
        for (k, leg) in self.robot.legs.iter().enumerate() {
            slack[18 + k] = moved;
            slack[12 + 2 * k] = moved * (1.0 + tangent);
            slack[13 + 2 * k] = slack[12 + 2 * k];
            let arm = (leg.c - self.robot.tool).norm();
            let Some(strokes) = &self.robot.strokes else { continue };
            for (slider, rail) in [leg.da, leg.db].into_iter().enumerate() {
                for end in 0..2 {
                    let fixed = (self.place - rail - leg.u * strokes[2 * k + slider][end]).norm();
                    slack[4 * k + 2 * slider + end] = moved * (fixed + arm) + moved * arm * (1.0 + moved);
                }
            }
        }
        slack.map(|x| x * (1.0 + 1e-9))
    }
}

fn value(k: &Order2, c: f64, s: f64) -> f64 {
    k[0] + k[1] * c + k[2] * s + (k[3] * c + k[4] * s) * c
}

/// Bernstein coefficients over `[0, h]` of the quartic in `t = tan(theta/2)`.
fn bernstein(k: &Order2, h: f64) -> [f64; 5] {
    let [k0, k1, k2, k3, k4] = *k;
    // c = (1 - t²)/(1 + t²), s = 2t/(1 + t²), over (1 + t²)².
    let q = [k0 + k1 + k3, 2.0 * (k2 + k4), 2.0 * (k0 - k3), 2.0 * (k2 - k4), k0 - k1 + k3];
    let (h2, h3, h4) = (h * h, h * h * h, h * h * h * h);
    let p = [q[0], q[1] * h, q[2] * h2, q[3] * h3, q[4] * h4];
    [
        p[0],
        p[0] + p[1] / 4.0,
        p[0] + p[1] / 2.0 + p[2] / 6.0,
        p[0] + 0.75 * p[1] + p[2] / 2.0 + p[3] / 4.0,
        p[0] + p[1] + p[2] + p[3] + p[4],
    ]
}

/// The first `t = tan(theta/2)` in `(0, until)` at which a limit that holds at 0 turns negative.
fn first_end(k: &Order2, until: f64) -> Option<f64> {
    first_root(bernstein(k, until), 0.0, until, DEPTH)
}

/// The first root over a cell, given its Bernstein coefficients, at which the polynomial turns negative.
fn first_root(b: [f64; 5], low: f64, high: f64, depth: u32) -> Option<f64> {
    if b.iter().all(|&x| x >= 0.0) {
        return None;
    }
    if b[0] < 0.0 || depth == 0 {
        return Some(low);
    }
    let changes = b.windows(2).filter(|pair| (pair[0] < 0.0) != (pair[1] < 0.0)).count();
    if changes == 1 {
        return Some(low + (high - low) * only_root(&b));
    }
    let (left, right) = halves(&b);
    let middle = 0.5 * (low + high);
    first_root(left, low, middle, depth - 1).or_else(|| first_root(right, middle, high, depth - 1))
}

/// De Casteljau's averages.
fn halves(b: &[f64; 5]) -> ([f64; 5], [f64; 5]) {
    let (mut left, mut right, mut row) = ([0.0; 5], [0.0; 5], *b);
    for n in 0..5 {
        left[n] = row[0];
        right[4 - n] = row[4 - n];
        for i in 0..4 - n {
            row[i] = 0.5 * (row[i] + row[i + 1]);
        }
    }
    (left, right)
}

/// The only root in `[0, 1]` of a polynomial that falls through it there: Newton's method, kept between bounds.
fn only_root(b: &[f64; 5]) -> f64 {
    let d = [b[1] - b[0], b[2] - b[1], b[3] - b[2], b[4] - b[3]];
    let at = |x: f64| {
        let y = 1.0 - x;
        let value =
            y * y * (y * y * b[0] + 4.0 * y * x * b[1] + 6.0 * x * x * b[2]) + x * x * x * (4.0 * y * b[3] + x * b[4]);
        let slope = 4.0 * (y * y * (y * d[0] + 3.0 * x * d[1]) + x * x * (3.0 * y * d[2] + x * d[3]));
        (value, slope)
    };
    let (mut low, mut high) = (0.0, 1.0);
    let mut x = if b[0] > b[4] { b[0] / (b[0] - b[4]) } else { 0.5 };
    for _ in 0..60 {
        let (value, slope) = at(x);
        if value >= 0.0 {
            low = x;
        } else {
            high = x;
        }
        let newton = x - value / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 2.0 * f64::EPSILON {
            return next;
        }
        x = next;
    }
    x
}

/// Whether a limit, less a loss that grows with the tilt, stays positive up to a tilt: shown over cells of it.
fn positive_up_to(k: &Order2, loss: &dyn Fn(f64) -> f64, until: f64) -> bool {
    const CELLS: u32 = 4;
    let mut b = bernstein(k, (0.5 * until).tan());
    let h = (0.5 * until).tan();
    let mut low = 0.0;
    for cell in 0..CELLS {
        // Cells by halving the rest; the last is the remainder.
        let (left, right, high) = if cell + 1 == CELLS {
            (b, b, h)
        } else {
            let (left, right) = halves(&b);
            (left, right, 0.5 * (low + h))
        };
        // The coefficients are of the limit times (1 + t²)².
        let largest = (1.0 + high * high).powi(2) * loss(2.0 * high.atan());
        if left.iter().any(|&x| x <= largest) {
            return false;
        }
        (b, low) = (right, high);
    }
    true
}

/// The least of a smooth function near a grid point whose neighbours are higher: parabolas through three points, golden sections where they fail.
fn least(f: impl Fn(f64) -> f64, at: f64, step: f64, [before, here, after]: [f64; 3]) -> (f64, f64) {
    let (mut low, mut high) = (at - step, at + step);
    let (mut x, mut fx) = (at, here);
    let mut others = [(low, before), (high, after)];
    for n in 0..REFINEMENTS {
        let [(a, fa), (b, fb)] = others;
        let (p, q) = ((x - a) * (fx - fb), (x - b) * (fx - fa));
        let parabola = x - 0.5 * ((x - a) * p - (x - b) * q) / (p - q);
        let inside = parabola > low && parabola < high && n % 5 != 4;
        let next = if inside {
            parabola
        } else if x - low > high - x {
            x - 0.381_966 * (x - low)
        } else {
            x + 0.381_966 * (high - x)
        };
        if (next - x).abs() < SETTLED {
            break;
        }
        let value = f(next);
        if value < fx {
            if next > x {
                low = x
            } else {
                high = x
            }
            others = [others[if (others[0].0 - next).abs() < (others[1].0 - next).abs() { 0 } else { 1 }], (x, fx)];
            (x, fx) = (next, value);
        } else {
            if next > x {
                high = next
            } else {
                low = next
            }
            let farther = usize::from((others[1].0 - x).abs() > (others[0].0 - x).abs());
            others[farther] = (next, value);
        }
    }
    (x, fx)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotations_are_what_the_limits_assume() {
        let robot = Tripod::cartesian_example();
        let place = Vector3::new(160.0, 170.0, 180.0);
        let frame = TiltFrame::new(&robot, &place).expect("sound").expect("home is inside");
        for (azimuth, theta) in [(0.3_f64, 0.2_f64), (4.0, 0.5)] {
            let pose = robot.tilted_pose(&place, theta, azimuth);
            let inputs = robot.inverse(&pose).expect("regular");
            let limits = frame.limits(azimuth);
            for (slider, input) in inputs.iter().enumerate() {
                let leg = &robot.legs[slider / 2];
                let along = (pose.rotation * leg.v).cross(&leg.w).dot(&leg.u);
                let found = value(&limits[2 * slider], theta.cos(), theta.sin()) / along;
                assert!((found - input).abs() < 1e-9, "{found} {input}");
            }
        }
        let identity = tilted(&robot, 0.0, 1.0).into_inner();
        assert_eq!(identity, nalgebra::Matrix3::identity());
    }

    #[test]
    fn first_roots_are_first() {
        // (t - 1/4)(t - 1/2)(t² + 1), which turns negative at 1/4.
        let q = [0.125, -0.75, 1.125, -0.75, 1.0];
        let k0 = 0.5 * (q[2] / 2.0 + (q[0] + q[4]) / 2.0);
        let k3 = 0.5 * ((q[0] + q[4]) / 2.0 - q[2] / 2.0);
        let k = [k0, (q[0] - q[4]) / 2.0, (q[1] + q[3]) / 4.0, k3, (q[1] - q[3]) / 4.0];
        let end = first_end(&k, FARTHEST.tan()).expect("ends");
        assert!((end - 0.25).abs() < 1e-14);
        assert_eq!(first_end(&k, 0.2), None);
    }
}
