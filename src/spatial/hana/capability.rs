//! How far can HANA tilt its platform at a place, and where the farthest?
//!
//! From level, the platform turns until a slider reaches the end of its stroke, a link lies level, or a singularity is met. Every such orientation solves an equation
//! `a cos phi + b sin phi = k`, so the candidates are had in closed form; between neighbours among them nothing changes, so one test in the middle of each gap decides.
//!
//! The paper's index `zeta` is twice the smaller of the two ways. Its eq. (47) takes `atan(z_p1/x_p1)`, which gives 162.85° for its own example; with the height from
//! the centre, `atan2(z_p1 - z, x_p1)`, the printed 89.65° comes out.

use std::f64::consts::{FRAC_PI_2, PI};

use thiserror::Error;

use super::super::error::{SpatialError, moderate};
use super::inverse::HanaMode;
use super::model::{Hana, HanaPose};

/// Why a rotational capability of HANA is not given.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum HanaCapabilityError {
    /// A place that is not finite, and the like.
    #[error(transparent)]
    Question(#[from] SpatialError),
    /// Sliders 1 and 2 on opposite sides of their joints, where the index is not defined: the platform does not turn about a level position in place.
    #[error("mode {mode}: sliders 1 and 2 must be on the same side of their joints, as in +++")]
    OppositeSides {
        /// The mode asked for.
        mode: HanaMode,
    },
}

/// What ends the tilting at one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CapabilityStop {
    /// A slider at an end of its stroke.
    Stroke {
        /// Leg, from 1.
        leg: usize,
        /// Whether it is the upper end.
        upper: bool,
    },
    /// Links 1 and 2 lie level (type 1).
    Level,
    /// A quarter turn (type 2).
    QuarterTurn,
    /// The links lie in line, seen along `x` (type 2).
    InLine,
}

/// How far the platform tilts at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capability {
    /// `zeta`, in radians: twice the smaller of the two ways.
    pub zeta: f64,
    /// The orientations from level down and up, in radians.
    pub range: [f64; 2],
    /// What ends them.
    pub stops: [CapabilityStop; 2],
}

/// The largest capability over the workspace of `phi = 0`; angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CapabilitySupremum {
    /// `zeta`: what is had, or approached.
    pub zeta: f64,
    /// Where, `[y, z]`.
    pub at: [f64; 2],
    /// Whether it is had there; else it is approached from below, and drops beyond.
    pub attained: bool,
    /// No place has more than this, in radians: shown.
    pub at_most: f64,
}

/// Capabilities over a grid of places.
#[derive(Clone, Debug, PartialEq)]
pub struct CapabilityMap {
    /// `[ymin, zmin, ymax, zmax]`.
    pub window: [f64; 4],
    /// Cells along `y` and `z`.
    pub size: [usize; 2],
    /// `zeta` in radians in the middle of each cell, row by row from the lowest; `None` outside the workspace of `phi = 0`.
    pub values: Vec<Option<f64>>,
}

impl CapabilityMap {
    /// The middle of a cell.
    pub fn at(&self, column: usize, row: usize) -> [f64; 2] {
        let [ymin, zmin, ymax, zmax] = self.window;
        let part = |k: usize, n: usize| (k as f64 + 0.5) / n as f64;
        [ymin + part(column, self.size[0]) * (ymax - ymin), zmin + part(row, self.size[1]) * (zmax - zmin)]
    }
}

/// Which ends of the strokes of legs 1 and 2 count.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ends {
    Both,
    /// Those on the platform's side: the lower ones of sliders above.
    Near,
}

/// Orientations closer than this are one candidate, in radians.
pub(super) const SAME: f64 = 1e-13;

impl Hana {
    /// How far the platform tilts at a place, from level, in a mode with sliders 1 and 2 on the same side; `None` outside the workspace of `phi = 0`.
    ///
    /// **Units**: radians. **Accuracy**: closed forms; about `1e-12` unless two limits nearly coincide. **Cost**: a microsecond. **Source**: Liu et al., eqs. (38)-(43), with (47) corrected.
    ///
    /// # Errors
    /// A place that is not finite; a mode with sliders 1 and 2 on opposite sides.
    ///
    /// ```
    /// use assur::{Hana, HanaMode};
    /// let there = Hana::example().capability([-2.0, -12.0], HanaMode::ABOVE)?.unwrap();
    /// assert!((there.zeta.to_degrees() - 89.64998565221119).abs() < 1e-9);
    /// # Ok::<(), assur::HanaCapabilityError>(())
    /// ```
    pub fn capability(&self, at: [f64; 2], mode: HanaMode) -> Result<Option<Capability>, HanaCapabilityError> {
        if mode.above[0] != mode.above[1] {
            return Err(HanaCapabilityError::OppositeSides { mode });
        }
        moderate(|| "place y".to_owned(), at[0])?;
        moderate(|| "place z".to_owned(), at[1])?;
        let third = self.third_height_square(at[0]);
        let third_in = third >= 0.0 && {
            let input = at[1] + mode.sign(2) * third.sqrt();
            (self.strokes[2][0]..=self.strokes[2][1]).contains(&input)
        };
        if !third_in || !self.pair_allowed(at, mode, 0.0, Ends::Both) {
            return Ok(None);
        }
        let stops = self.stops(at, mode, Ends::Both);
        let sides = [-1.0, 1.0].map(|side| self.first_stop(at, mode, &stops, side, Ends::Both));
        let zeta = 2.0 * sides[0].0.abs().min(sides[1].0.abs());
        Ok(Some(Capability { zeta, range: sides.map(|s| s.0), stops: sides.map(|s| s.1) }))
    }

    /// Capabilities over a grid of places in the workspace of `phi = 0`; `progress` is told the rows done.
    ///
    /// # Errors
    /// As [`Hana::capability`].
    pub fn capability_map(
        &self,
        mode: HanaMode,
        window: [f64; 4],
        size: [usize; 2],
        mut progress: impl FnMut(usize),
    ) -> Result<CapabilityMap, HanaCapabilityError> {
        let mut map = CapabilityMap { window, size, values: Vec::with_capacity(size[0] * size[1]) };
        for row in 0..size[1] {
            for column in 0..size[0] {
                let there = self.capability(map.at(column, row), mode)?;
                map.values.push(there.map(|capability| capability.zeta));
            }
            progress(row + 1);
        }
        Ok(map)
    }

    /// The same robot with every stroke of this half length about its middle.
    ///
    /// # Errors
    /// A half length that is negative or not finite.
    pub fn with_strokes(&self, half: f64) -> Result<Self, SpatialError> {
        let strokes = self.strokes.map(|[low, high]| {
            let middle = 0.5 * (low + high);
            [middle - half, middle + half]
        });
        let robot = Self { strokes, ..self.clone() };
        robot.validate()?;
        Ok(robot)
    }

    /// The largest capability above one `y`, itself for `at_most`; sliders 1 and 2 with the same strokes.
    pub(super) fn best_height(&self, y: f64, mode: HanaMode) -> Option<CapabilitySupremum> {
        let up = mode.sign(0);
        let flat_square = (self.link - y) * (self.link + y);
        let third = self.third_height_square(y);
        let level = self.height_square(y, 1.0);
        if flat_square < 0.0 || third < 0.0 || level < 0.0 {
            return None;
        }
        let (r, base) = (self.platform_radius, self.base_radius);
        let reach = |leg: usize, height: f64| self.strokes[leg].map(|end| end - mode.sign(leg) * height);
        let (one, three) = (reach(0, level.sqrt()), reach(2, third.sqrt()));
        let (low, high) = (one[0].max(three[0]), one[1].min(three[1]));
        if low > high {
            return None;
        }
        let far = self.strokes[0][usize::from(up > 0.0)];
        let span = flat_square.sqrt() + r;
        let jump = (span >= base).then(|| far - up * ((span - base) * (span + base)).sqrt());
        let stroke = self.strokes[0][1] - self.strokes[0][0];
        let cross = (stroke <= 2.0 * r).then(|| {
            let sine = stroke / (2.0 * r);
            let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
            let height = self.height_square(y, cosine).max(0.0).sqrt();
            far - up * (0.5 * stroke + height)
        });
        let mut best: Option<CapabilitySupremum> = None;
        let mut offer = |zeta: f64, z: f64, attained: bool| {
            if best.is_none_or(|known| zeta > known.zeta) {
                best = Some(CapabilitySupremum { zeta, at: [y, z], attained, at_most: zeta });
            }
        };
        for z in [Some(low), Some(high), cross].into_iter().flatten().filter(|z| (low..=high).contains(z)) {
            let (stops, at) = (self.stops([y, z], mode, Ends::Both), [y, z]);
            if self.pair_allowed(at, mode, 0.0, Ends::Both) {
                offer(2.0 * self.first_stop(at, mode, &stops, 1.0, Ends::Both).0, z, true);
            }
        }
        if let Some(z) = jump.filter(|z| (low..=high).contains(z)) {
            // Just before the jump only the near ends of the strokes count.
            let (stops, at) = (self.stops([y, z], mode, Ends::Near), [y, z]);
            if self.pair_allowed(at, mode, 0.0, Ends::Near) {
                offer(2.0 * self.first_stop(at, mode, &stops, 1.0, Ends::Near).0, z, false);
            }
        }
        best
    }

    /// Orientations at which something may end, with what it is; for these ends of strokes 1 and 2.
    fn stops(&self, [y, z]: [f64; 2], mode: HanaMode, ends: Ends) -> Vec<(f64, CapabilityStop)> {
        let (r, base, l) = (self.platform_radius, self.base_radius, self.link);
        let mut stops = vec![(-FRAC_PI_2, CapabilityStop::QuarterTurn), (FRAC_PI_2, CapabilityStop::QuarterTurn)];
        for leg in 0..2 {
            let turn = if leg == 0 { 1.0 } else { -1.0 };
            for end in 0..2 {
                let upper = end == 1;
                if ends == Ends::Near && upper == mode.above[0] {
                    continue;
                }
                let down = z - self.strokes[leg][end];
                // 2 r R cos phi ± 2 r down sin phi = k
                let (a, b) = (2.0 * r * base, 2.0 * r * turn * down);
                let k = r * r + base * base + y * y + (down - l) * (down + l);
                let amplitude = a.hypot(b);
                if k.abs() <= amplitude {
                    let (middle, half) = (b.atan2(a), (k / amplitude).acos());
                    let stop = CapabilityStop::Stroke { leg: leg + 1, upper };
                    stops.extend([middle - half, middle + half].map(|phi| (wrapped(phi), stop)));
                }
            }
        }
        let flat_square = (l - y) * (l + y);
        let mut across = |square: f64, stop: CapabilityStop| {
            if square >= 0.0 {
                for span in [square.sqrt(), -square.sqrt()] {
                    let cosine = (base - span) / r;
                    if cosine.abs() <= 1.0 {
                        stops.extend([(-cosine.acos(), stop), (cosine.acos(), stop)]);
                    }
                }
            }
        };
        across(flat_square, CapabilityStop::Level);
        // y u3 = w u with u = -s1 N, u3 = -s3 N3: N = s1 s3 y N3/w.
        let w = y + base - r;
        let height = mode.sign(0) * mode.sign(2) * y * self.third_height_square(y).max(0.0).sqrt() / w;
        if height > 0.0 && height.is_finite() {
            across(flat_square - height * height, CapabilityStop::InLine);
        }
        stops
    }

    /// The first orientation on one side of level beyond which the sliders do not go, or a singularity.
    fn first_stop(
        &self,
        at: [f64; 2],
        mode: HanaMode,
        stops: &[(f64, CapabilityStop)],
        side: f64,
        ends: Ends,
    ) -> (f64, CapabilityStop) {
        let mut ahead: Vec<(f64, CapabilityStop)> = stops
            .iter()
            .map(|&(phi, stop)| (side * phi, stop))
            .filter(|(phi, _)| (0.0..=FRAC_PI_2).contains(phi))
            .collect();
        ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        // With a slider at an end already, rounding may have put the orientation at which it leaves on the other side.
        let next = ahead.iter().map(|next| next.0).find(|&next| next > SAME).unwrap_or(FRAC_PI_2);
        if !self.pair_allowed(at, mode, side * 0.5 * next, ends) {
            let nearest = stops.iter().min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
            return (0.0, nearest.map_or(CapabilityStop::QuarterTurn, |&(_, stop)| stop));
        }
        for (k, &(phi, stop)) in ahead.iter().enumerate() {
            let singular = matches!(stop, CapabilityStop::QuarterTurn | CapabilityStop::InLine);
            let next = ahead[k + 1..].iter().map(|next| next.0).find(|next| next - phi > SAME);
            let beyond = 0.5 * (phi + next.unwrap_or(PI));
            if singular || !self.pair_allowed(at, mode, side * beyond, ends) {
                // Of several at once, the one that does not hold beyond is named; any will do.
                return (side * phi, stop);
            }
        }
        (side * FRAC_PI_2, CapabilityStop::QuarterTurn)
    }

    /// Whether sliders 1 and 2 are within their strokes.
    fn pair_allowed(&self, [y, z]: [f64; 2], mode: HanaMode, phi: f64, ends: Ends) -> bool {
        let square = self.height_square(y, phi.cos());
        let joints = self.joint_heights(&HanaPose::new(y, z, phi));
        square >= 0.0
            && (0..2).all(|leg| {
                let input = joints[leg] + mode.sign(leg) * square.sqrt();
                let [low, high] = self.strokes[leg];
                match ends {
                    Ends::Both => (low..=high).contains(&input),
                    Ends::Near => {
                        if mode.above[leg] {
                            input >= low
                        } else {
                            input <= high
                        }
                    }
                }
            })
    }
}

/// An angle in `(-pi, pi]`.
fn wrapped(angle: f64) -> f64 {
    let turned = angle.rem_euclid(2.0 * PI);
    if turned > PI { turned - 2.0 * PI } else { turned }
}
