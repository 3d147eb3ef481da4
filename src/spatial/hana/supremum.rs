//! Where can HANA tilt farthest, and is that shown?
//!
//! With sliders 1 and 2 above their joints, strokes `[lo, hi]` of both, and `N(y, t)² = L² - (R - r cos t)² - y²`, a place `(y, z)` allows every tilt up to `phi` exactly when
//!
//! - `lo - N(y, t) + r sin t <= z <= hi - N(y, t) - r sin t` for `0 <= t <= phi`. The left side grows with `t`; the right side falls up to `cos t = R/(l + r)`, `l² = L² - y²`, where
//!   `N + r sin t` is `sqrt((l + r)² - R²)`, its largest, and rises beyond. Together they say `2 r sin phi <= hi - lo`;
//! - `z` is within the stroke of leg 3, which does not see the tilt;
//! - `N` is real, and no singularity of type 2 lies between: in line is where `N² = (y N3/w)²`, `w = y + R - r`, so that `L² - (R - r cos t)² = (L3 y/w)²`.
//!
//! `N` falls with `|y|`, and `y/w` is monotone, so that over a range of `y` on one side of 0 and of `w = 0` each of these is implied by one in numbers of its ends. The farthest tilt that those admit
//! bounds all of the range: halving the range with the largest bound brings it down to what is had. Sliders below their joints are the mirror image.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::FRAC_PI_2;

use super::capability::{CapabilitySupremum, HanaCapabilityError, SAME};
use super::inverse::HanaMode;
use super::model::Hana;

/// The bound comes down to this above what is had, in radians.
const TOLERANCE: f64 = 1e-9;
/// Ranges looked at: some hundred as a rule. Beyond, the bound is what it has come down to.
const RANGES: usize = 20_000;
/// Margin of the bounds for rounding, over the sizes that are subtracted: each comes from some ten roundings.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Halvings of a quarter turn in a bound: to 1e-12, well below the tolerance.
const HALVINGS: u32 = 41;

impl Hana {
    /// The largest capability over the workspace of `phi = 0`, and a bound that none exceeds; `None` where that is empty, or so narrow that rounding leaves no place in it.
    ///
    /// Along `z` the largest is among four places in closed form, since what the near ends of the strokes allow grows with `z` and what the far ends allow falls, with
    /// one jump at `hi - sqrt((l + r)² - R²)`, `l = sqrt(L² - y²)`. Along `y` ranges are bounded and halved until no range can hold more than `1e-9` above what is had.
    /// **Proof**: `at_most` bounds every place, with a margin for rounding; as a rule it is above `zeta` by no more than `1e-9`; by more where the workspace narrows
    /// to a point where the largest is approached, or where 20,000 ranges do not suffice.
    /// Where the strokes of legs 1 and 2 differ, what both have in common counts: over tilts from `-a` to `a` slider 2 is at the heights of slider 1.
    /// **Cost**: a tenth of a millisecond to some milliseconds, a tenth of a second where all ranges are used. **Source**: derived here, see the module.
    ///
    /// # Errors
    /// Sliders 1 and 2 on opposite sides of their joints.
    ///
    /// ```
    /// use assur::{Hana, HanaMode};
    /// let best = Hana::example().capability_supremum(HanaMode::ABOVE)?.unwrap();
    /// assert!((best.zeta.to_degrees() - 139.73387603161154).abs() < 1e-8 && !best.attained); // printed: 139.2
    /// assert!(best.at_most - best.zeta < 1.1e-9);
    /// # Ok::<(), assur::HanaCapabilityError>(())
    /// ```
    pub fn capability_supremum(&self, mode: HanaMode) -> Result<Option<CapabilitySupremum>, HanaCapabilityError> {
        if mode.above[0] != mode.above[1] {
            return Err(HanaCapabilityError::OppositeSides { mode });
        }
        let [[low, high], [other_low, other_high], third] = self.strokes;
        let common = [low.max(other_low), high.min(other_high)];
        if common[0] > common[1] {
            return Ok(None);
        }
        let robot = Self { strokes: [common, common, third], ..self.clone() };
        let level = robot.workspace(0.0, mode)?;
        // Halving alone may miss a workspace that is narrow in y.
        let mut corners: Vec<f64> = level.loops.iter().flat_map(|(_, arcs)| arcs).map(|arc| arc.start[0]).collect();
        corners.sort_by(f64::total_cmp);
        let between = corners.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        Ok(if corners.is_empty() { None } else { robot.bounded_supremum(mode, between) })
    }

    /// With equal strokes of legs 1 and 2; `first` are places along `y` to begin with.
    fn bounded_supremum(&self, mode: HanaMode, first: impl Iterator<Item = f64>) -> Option<CapabilitySupremum> {
        let ceiling = Ceiling::new(self, mode);
        let mut best: Option<CapabilitySupremum> = None;
        let offer = |y: f64, best: &mut Option<CapabilitySupremum>| {
            let found = self.best_height(y, mode);
            // A place that is better by rounding alone is none.
            if let Some(found) = found.filter(|found| best.is_none_or(|known| found.zeta > known.zeta + SAME)) {
                *best = Some(found);
            }
        };
        let ends = ceiling.ends();
        ends.iter().copied().chain(first).for_each(|y| offer(y, &mut best));
        let mut open: BinaryHeap<Range> =
            ends.windows(2).filter_map(|pair| ceiling.bound([pair[0], pair[1]])).collect();
        // What ranges that are not halved any more may hold.
        let mut left: f64 = 0.0;
        for _ in 0..RANGES {
            let Some(range) = open.pop() else { break };
            if best.is_some_and(|best| range.zeta <= best.zeta + TOLERANCE) {
                left = left.max(range.zeta);
                open.clear();
                break;
            }
            let [low, high] = range.y;
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                left = left.max(range.zeta);
                continue;
            }
            offer(middle, &mut best);
            open.extend([[low, middle], [middle, high]].into_iter().filter_map(|y| ceiling.bound(y)));
        }
        left = open.peek().map_or(left, |range| left.max(range.zeta));
        best.map(|best| CapabilitySupremum { at_most: best.zeta.max(left), ..best })
    }
}

/// A range of `y` and what no place of it exceeds, in radians.
struct Range {
    zeta: f64,
    y: [f64; 2],
}

impl PartialEq for Range {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Range {}

impl PartialOrd for Range {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Range {
    fn cmp(&self, other: &Self) -> Ordering {
        self.zeta.total_cmp(&other.zeta)
    }
}

/// The conditions on a tilt over a range of `y`, for sliders 1 and 2 above their joints.
struct Ceiling<'a> {
    robot: &'a Hana,
    /// Of legs 1 and 2, and of leg 3; mirrored where the sliders are below.
    strokes: [[f64; 2]; 2],
    /// On which side of its joint slider 3 is: 1 or -1.
    third: f64,
    /// Margins for rounding: of lengths, of squares of lengths.
    margin: [f64; 2],
}

impl<'a> Ceiling<'a> {
    fn new(robot: &'a Hana, mode: HanaMode) -> Self {
        let up = mode.sign(0);
        let mirrored = |[low, high]: [f64; 2]| if up > 0.0 { [low, high] } else { [-high, -low] };
        let strokes = [mirrored(robot.strokes[0]), mirrored(robot.strokes[2])];
        let size = strokes.iter().flatten().fold(robot.size(), |size, end| size.max(end.abs()));
        let margin = [ROUNDING * size, ROUNDING * robot.size() * robot.size()];
        Self { robot, strokes, third: up * mode.sign(2), margin }
    }

    /// The `y` that a level platform can have, and what parts them: 0, and `w = 0`.
    fn ends(&self) -> Vec<f64> {
        let (robot, apart) = (self.robot, self.robot.platform_radius - self.robot.base_radius);
        let pair = robot.height_square(0.0, 1.0).max(0.0).sqrt();
        let low = (-pair).max(apart - robot.third_link);
        let high = pair.min(apart + robot.third_link);
        let mut ends = vec![low, high];
        ends.extend([0.0, apart].into_iter().filter(|y| low < *y && *y < high));
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        ends
    }

    /// What no place over a range of `y` exceeds; `None` where the range has no place.
    fn bound(&self, y: [f64; 2]) -> Option<Range> {
        if !self.admits(y, 0.0) {
            return None;
        }
        let (mut low, mut high) = (0.0, FRAC_PI_2);
        if !self.admits(y, high) {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if self.admits(y, middle) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
        }
        Some(Range { zeta: 2.0 * high, y })
    }

    /// Whether the numbers of a range's ends leave a tilt possible somewhere in it. What is possible at a tilt is at every lesser one.
    fn admits(&self, y: [f64; 2], phi: f64) -> bool {
        let robot = self.robot;
        let (r, base) = (robot.platform_radius, robot.base_radius);
        let [length, square] = self.margin;
        let (s, c) = phi.sin_cos();
        let [near, far] = if y[0].abs() < y[1].abs() { y } else { [y[1], y[0]] };
        let (level, tilted) = (robot.height_square(near, 1.0) + square, robot.height_square(near, c) + square);
        let [low, high] = self.strokes[0];
        if level < 0.0 || tilted < 0.0 || 2.0 * r * s > high - low + length || !self.clear_of_line(y, phi) {
            return false;
        }
        let lowest = low - level.sqrt().min(tilted.sqrt() - r * s);
        // The least that `N + r sin t` comes to at its largest: at the far end of the range, or where a level platform still reaches.
        let flat = (far * far).min(near * near + level);
        let height = |cosine: f64| (robot.height_square(near, cosine) + near * near - flat - square).max(0.0).sqrt();
        let span = (robot.link * robot.link - flat - square).max(0.0).sqrt() + r;
        let most = height(1.0).max(height(c) + r * s);
        let beyond = span >= base && c * span <= base;
        let most = if beyond { most.max(((span - base) * (span + base)).sqrt()) } else { most };
        // Both sides at one place: beyond the largest `N + r sin t`, what that exceeds `N(y, phi)` by grows with `|y|`, as `(l + r) (R - r cos phi) >= l R` there.
        let near_span = ((robot.link - near) * (robot.link + near)).max(0.0).sqrt() + r;
        if near_span >= base && c * near_span <= base {
            let near_most = ((near_span - base) * (near_span + base) - square).max(0.0).sqrt();
            if near_most - tilted.sqrt() + r * s > high - low + length {
                return false;
            }
        }
        let highest = high - most;
        let across = y.map(|y| (y + base - r).abs());
        let third = |across: f64, margin: f64| (robot.third_link - across) * (robot.third_link + across) + margin;
        let longest = third(across[0].min(across[1]), square);
        if longest < 0.0 {
            return false;
        }
        let heights = [third(across[0].max(across[1]), -square).max(0.0).sqrt(), longest.sqrt()];
        let [near_third, far_third] = if self.third > 0.0 { [-heights[1], -heights[0]] } else { heights };
        let [low, high] = self.strokes[1];
        lowest.max(low + near_third) <= highest.min(high + far_third) + length
    }

    /// Whether the range leaves room for a tilt without the links in line.
    fn clear_of_line(&self, y: [f64; 2], phi: f64) -> bool {
        let robot = self.robot;
        let (r, base) = (robot.platform_radius, robot.base_radius);
        let middle = 0.5 * (y[0] + y[1]);
        // On the other side of `w = 0` slider 3 is never in line with them.
        if self.third * middle * (middle + base - r) <= 0.0 {
            return true;
        }
        let squares = y.map(|y| (robot.third_link * y / (y + base - r)).powi(2));
        if squares.iter().any(|square| square.is_nan()) {
            return true;
        }
        let [least, most] = [squares[0].min(squares[1]), squares[0].max(squares[1])];
        let reach = |cosine: f64| robot.height_square(0.0, cosine);
        let margin = self.margin[1] + ROUNDING * least;
        // `L² - (R - r cos t)²` rises until the links stand upright, then falls: least at an end, largest there.
        let c = phi.cos();
        let above = reach(1.0).min(reach(c)) + margin >= least;
        let below = reach((base / r).clamp(c.min(1.0), 1.0)) <= most + self.margin[1] + ROUNDING * most;
        above || below
    }
}
