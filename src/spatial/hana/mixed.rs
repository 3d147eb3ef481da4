//! Singular positions with legs 1 and 2 in the platform's plane, and whether the strokes reach any.
//!
//! They need the sliders of legs 1 and 2 on opposite sides of their joints (`z = (z1 + z2)/2`), so a robot kept in `+++` never meets them. With
//! `l = sqrt(L² - y²)`, links and platform stretch over `l + r` or fold over `l - r`; that span is the hypotenuse over `R`, and its rise `d` puts the
//! sliders at `z ∓ d`.

use super::super::error::{SpatialError, moderate};
use super::model::Hana;

impl Hana {
    /// The inputs for which legs 1 and 2 lie in the platform's plane while the platform's centre is in `(y, z)`: singular of type 2 with the sliders on
    /// opposite sides of their joints, and whether the strokes reach them.
    ///
    /// **Shape**: up to four, stretched ones first. With `l = sqrt(L² - y²)` the inputs are `z ∓ sqrt((l ± r)² - R²)` and the third `z ± N3` (both where it
    /// reaches). **Source**: Liu et al., eqs. (45), (46).
    ///
    /// # Errors
    /// A place that is not finite.
    ///
    /// ```
    /// let found = assur::Hana::example().mixed_singularities(0.0, -12.0)?;
    /// assert!((found[0].inputs[0] + 25.416407864998739).abs() < 1e-12 && !found[0].within_strokes);
    /// # Ok::<(), assur::SpatialError>(())
    /// ```
    pub fn mixed_singularities(&self, y: f64, z: f64) -> Result<Vec<MixedSingularity>, SpatialError> {
        moderate(|| "pose y".to_owned(), y)?;
        moderate(|| "pose z".to_owned(), z)?;
        let mut found = Vec::new();
        let (r, base) = (self.platform_radius, self.base_radius);
        let flat_square = (self.link - y) * (self.link + y);
        let third = self.third_height_square(y);
        if flat_square < 0.0 || third < 0.0 {
            return Ok(found);
        }
        let within = |leg: usize, value: f64| (self.strokes[leg][0]..=self.strokes[leg][1]).contains(&value);
        let third_within = within(2, z + third.sqrt()) || within(2, z - third.sqrt());
        for (stretched, span) in [(true, flat_square.sqrt() + r), (false, flat_square.sqrt() - r)] {
            if span < base {
                continue;
            }
            let rise = ((span - base) * (span + base)).sqrt();
            // P1 lies towards its slider where stretched, away from it where folded.
            let outward = if stretched { 1.0 } else { -1.0 };
            let sides: &[f64] = if rise > 0.0 { &[1.0, -1.0] } else { &[1.0] };
            for side in sides {
                let inputs = [z - side * rise, z + side * rise];
                let phi = (outward * side * rise).atan2(outward * base);
                // atan2 of -0 is -pi; orientations are in (-pi, pi].
                let phi = if phi <= -std::f64::consts::PI { -phi } else { phi };
                let within_strokes = within(0, inputs[0]) && within(1, inputs[1]) && third_within;
                found.push(MixedSingularity { stretched, phi, inputs, within_strokes });
            }
        }
        Ok(found)
    }
}

/// A singular position with legs 1 and 2 in the platform's plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MixedSingularity {
    /// Links and platform stretched in one line, else folded.
    pub stretched: bool,
    /// Orientation, in radians.
    pub phi: f64,
    /// Heights of the sliders of legs 1 and 2.
    pub inputs: [f64; 2],
    /// Whether all three sliders can be there.
    pub within_strokes: bool,
}

/// Whether strokes reach a singular position of legs 1 and 2 in the platform's plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MixedReach {
    /// No place has one: shown for every `y` by bounds over intervals, in floating point with a margin for rounding.
    Nowhere,
    /// Here is one.
    At {
        /// Place of the centre along `y`.
        y: f64,
        /// Its height.
        z: f64,
    },
    /// The strokes touch one, or nearly: nearer than `1e-9` of the robot's size.
    Touched {
        /// Where.
        y: f64,
    },
}

/// Intervals of `y` shorter than this, over the robot's size, are not halved any more.
const FINEST: f64 = 1e-9;
/// Bounds are widened by this much of the robot's size, to cover rounding.
const SLACK: f64 = 1e-12;

impl Hana {
    /// Whether the strokes reach a singular position with legs 1 and 2 in the platform's plane, anywhere.
    ///
    /// **Proof**: `Nowhere` by bounds over intervals of `y` that cover the reach. **Cost**: some microseconds. The published robot reaches none:
    ///
    /// ```
    /// use assur::{Hana, MixedReach};
    /// assert_eq!(Hana::example().mixed_reach(), MixedReach::Nowhere);
    /// let longer = Hana::new(3.0, 12.0, 15.0, 15.0, [[-30.0, 30.0]; 3])?;
    /// assert!(matches!(longer.mixed_reach(), MixedReach::At { .. }));
    /// # Ok::<(), assur::SpatialError>(())
    /// ```
    pub fn mixed_reach(&self) -> MixedReach {
        let offset = self.platform_radius - self.base_radius;
        let low = (-self.link).max(offset - self.third_link);
        let high = self.link.min(offset + self.third_link);
        let mut touched = None;
        if low <= high {
            // Symmetric robots meet in y = 0, which halving would only approach.
            let mut pieces = if low < 0.0 && high > 0.0 { vec![[low, 0.0], [0.0, high]] } else { vec![[low, high]] };
            while let Some([a, b]) = pieces.pop() {
                if !self.may_meet([a, b]) {
                    continue;
                }
                for y in [a, 0.5 * (a + b), b] {
                    if let Some(z) = self.meets(y) {
                        return MixedReach::At { y, z };
                    }
                }
                if b - a <= FINEST * self.size() {
                    touched = Some(0.5 * (a + b));
                    break;
                }
                let middle = 0.5 * (a + b);
                pieces.extend([[a, middle], [middle, b]]);
            }
        }
        touched.map_or(MixedReach::Nowhere, |y| MixedReach::Touched { y })
    }

    /// Rises `d` of the stretched and the folded position, and heights `N3`, over an interval of `y` on one side of 0.
    fn rises([a, b]: [f64; 2], robot: &Self) -> ([Option<[f64; 2]>; 2], Option<[f64; 2]>) {
        let (near, far) = (a.abs().min(b.abs()), a.abs().max(b.abs()));
        let root = |square: f64| square.max(0.0).sqrt();
        let flat = |y: f64| root((robot.link - y) * (robot.link + y));
        let (r, base) = (robot.platform_radius, robot.base_radius);
        let rise = |span: [f64; 2]| {
            let above = |span: f64| root((span - base) * (span + base));
            (span[1] >= base).then(|| [above(span[0].max(base)), above(span[1])])
        };
        let span = [flat(far), flat(near)];
        let from = |y: f64| y + base - r;
        let (p, q) = (from(a), from(b));
        let nearest = if p <= 0.0 && q >= 0.0 { 0.0 } else { p.abs().min(q.abs()) };
        let farthest = p.abs().max(q.abs());
        let third = |w: f64| root((robot.third_link - w) * (robot.third_link + w));
        let heights = (nearest <= robot.third_link).then(|| [third(farthest), third(nearest)]);
        ([rise(span.map(|l| l + r)), rise(span.map(|l| (l - r).max(0.0)))], heights)
    }

    /// Heights of the centre that all three strokes allow, for bounds on rise and on `N3`; the widest such range is returned.
    fn allowed(&self, rise: [f64; 2], third: [f64; 2], slack: f64) -> Option<[f64; 2]> {
        let [one, two, three] = self.strokes;
        let meet = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].min(b[1])];
        let up = |s: [f64; 2], d: [f64; 2]| [s[0] + d[0] - slack, s[1] + d[1] + slack];
        let down = |s: [f64; 2], d: [f64; 2]| [s[0] - d[1] - slack, s[1] - d[0] + slack];
        let pairs = [meet(up(one, rise), down(two, rise)), meet(down(one, rise), up(two, rise))];
        let thirds = [down(three, third), up(three, third)];
        let all = pairs.into_iter().flat_map(|pair| thirds.map(|range| meet(pair, range)));
        all.filter(|range| range[0] <= range[1]).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))
    }

    fn may_meet(&self, y: [f64; 2]) -> bool {
        let (rises, third) = Self::rises(y, self);
        let slack = SLACK * self.size();
        third.is_some_and(|third| rises.into_iter().flatten().any(|rise| self.allowed(rise, third, slack).is_some()))
    }

    fn meets(&self, y: f64) -> Option<f64> {
        let (rises, third) = Self::rises([y, y], self);
        let third = third?;
        let range = rises.into_iter().flatten().find_map(|rise| self.allowed(rise, third, 0.0))?;
        Some(0.5 * (range[0] + range[1]))
    }
}
