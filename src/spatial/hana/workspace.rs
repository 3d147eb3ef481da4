//! Where can HANA's platform be: in one orientation, and in any?
//!
//! A slider within its stroke keeps the centre between two congruent half circles, so both workspaces are bounded by arcs. The reachable one needs two facts about
//! legs 1 and 2 with `R > r`. At one `y` the stroke's lower end bounds `z` by `lo + r|s| - N(phi)`, which is least at `phi = 0`; its upper end by
//! `hi - g`, `g = r|s| + N(phi)`, and `g' = 0` means `N/(R - r c) = tan phi`, of which the left side falls and the right side rises: one
//! solution, a maximum of `g`. So the highest `z` is had at `phi = 0` or at the last orientation, and only those two arcs bound the union.
//! Beyond a quarter turn lies a singularity; what is behind it is not counted.

use thiserror::Error;

use super::super::arcs::{ArcRegion, Bounds, Bow};
use super::super::error::SpatialError;
use super::inverse::HanaMode;
use super::model::Hana;

/// Why a workspace of HANA is not given.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum HanaWorkspaceError {
    /// An orientation that is not finite, and the like.
    #[error(transparent)]
    Question(#[from] SpatialError),
    /// Sliders 1 and 2 on opposite sides of their joints: another branch of positions, not covered.
    #[error("mode {mode}: sliders 1 and 2 must be on the same side of their joints, as in +++")]
    OppositeSides {
        /// The mode asked for.
        mode: HanaMode,
    },
    /// Legs 1 and 2 have different strokes: the union over orientations is not covered.
    #[error("strokes of legs 1 and 2 differ; the union over orientations is known for equal ones only")]
    DifferentStrokes,
    /// The platform is as large as the base.
    #[error("r = {r} must be less than R = {base}: the union over orientations is known for this only")]
    LargePlatform {
        /// Radius of the platform.
        r: f64,
        /// Radius of the base.
        base: f64,
    },
    /// Beyond some `|y|` legs 1 and 2 end level before the last orientation; the boundary there is no arc.
    #[error(
        "beyond |y| = {beyond} legs 1 and 2 lie level before the last orientation; the boundary there is no arc of a circle and is not covered"
    )]
    NoArc {
        /// Where the arcs end.
        beyond: f64,
    },
}

impl Hana {
    /// The places of the platform's centre for one orientation (radians) in one working mode.
    ///
    /// **Shape**: exact arcs in the plane `Oyz`. **Accuracy**: area, perimeter and centroid in closed form, a few roundings. **Source**: Liu et al., eqs. (25)-(31); the
    /// circles printed there are to be read as their lower halves.
    ///
    /// The paper gives "the area" 31.7521 for its example. That is the perimeter of these arcs, 31.752141; their area is 43.453703, as integration confirms.
    ///
    /// # Errors
    /// An orientation that is not finite.
    ///
    /// ```
    /// use assur::{Hana, HanaMode};
    /// let region = Hana::example().workspace(0.0, HanaMode::ABOVE)?;
    /// assert!((region.area - 43.45370270595534).abs() < 1e-11);
    /// assert!((region.perimeter - 31.7521).abs() < 5e-5);
    /// assert_eq!(region.loops[0].1.len(), 4);
    /// # Ok::<(), assur::SpatialError>(())
    /// ```
    pub fn workspace(&self, phi: f64, mode: HanaMode) -> Result<ArcRegion, SpatialError> {
        Ok(self.bounds(phi, mode)?.map_or_else(ArcRegion::default, |bounds| bounds.region()))
    }

    /// Bounds of the workspace of one orientation; `None` where legs 1 and 2 cannot reach at all.
    fn bounds(&self, phi: f64, mode: HanaMode) -> Result<Option<Bounds>, SpatialError> {
        if !phi.is_finite() {
            return Err(SpatialError::NotFinite { what: "phi".to_owned(), value: phi });
        }
        let (sine, cosine) = phi.sin_cos();
        let square = self.height_square(0.0, cosine);
        if square <= 0.0 {
            return Ok(None);
        }
        let tilt = self.platform_radius * sine;
        let bow = |leg: usize, end: usize, label: &'static str| {
            let (y, radius, lift) = match leg {
                0 => (0.0, square.sqrt(), tilt),
                1 => (0.0, square.sqrt(), -tilt),
                _ => (self.platform_radius - self.base_radius, self.third_link, 0.0),
            };
            Bow { center: [y, self.strokes[leg][end] + lift], radius, side: -mode.sign(leg), label }
        };
        let lower = vec![vec![bow(0, 0, LOWEST[0])], vec![bow(1, 0, LOWEST[1])], vec![bow(2, 0, LOWEST[2])]];
        let upper = vec![vec![bow(0, 1, HIGHEST[0])], vec![bow(1, 1, HIGHEST[1])], vec![bow(2, 1, HIGHEST[2])]];
        Ok(Some(Bounds { lower, upper }))
    }

    /// The places of the platform's centre over all orientations between the quarter turns.
    ///
    /// **Shape**, **accuracy** as [`Hana::workspace`]. The "area" 32.7980 in print is the perimeter, 32.797963;
    /// the area is 44.244826, as a scan over orientations confirms.
    ///
    /// # Errors
    /// What is not covered: sliders 1 and 2 on opposite sides, different strokes of theirs, `r ≥ R`, a boundary that is no arc.
    ///
    /// ```
    /// use assur::{Hana, HanaMode};
    /// let region = Hana::example().reachable_workspace(HanaMode::ABOVE)?;
    /// assert!((region.area - 44.244825742417675).abs() < 1e-11);
    /// assert!((region.perimeter - 32.7980).abs() < 5e-5);
    /// # Ok::<(), assur::HanaWorkspaceError>(())
    /// ```
    pub fn reachable_workspace(&self, mode: HanaMode) -> Result<ArcRegion, HanaWorkspaceError> {
        self.check_same_side(mode)?;
        let (r, base) = (self.platform_radius, self.base_radius);
        if r >= base {
            return Err(HanaWorkspaceError::LargePlatform { r, base });
        }
        let Some(mut bounds) = self.bounds(0.0, mode)? else { return Ok(ArcRegion::default()) };
        let [low, high] = self.strokes[0];
        let sine = (0.5 * (high - low) / r).min(1.0);
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let square = self.height_square(0.0, cosine);
        let last = square.max(0.0).sqrt();
        // Seen from below, the last orientation adds to what the sliders' far ends allow.
        let (group, end, toward) =
            if mode.above[0] { (&mut bounds.upper, high, -1.0) } else { (&mut bounds.lower, low, 1.0) };
        let label = "last orientation";
        let side = -mode.sign(0);
        if square > 0.0 {
            let bow = Bow { center: [0.0, end + toward * r * sine], radius: last, side, label };
            group[0].push(bow);
            group[1].push(bow);
        }
        if self.ends_level(&bounds, mode, last) {
            return Err(HanaWorkspaceError::NoArc { beyond: last });
        }
        Ok(bounds.region())
    }

    /// Whether the union's boundary runs, beyond `last`, along places where links 1 and 2 lie level: `z = hi - r|s|` with `R - r c = sqrt(L² - y²)`.
    ///
    /// Sampled between the breaks; only decides whether to answer.
    fn ends_level(&self, bounds: &Bounds, mode: HanaMode, last: f64) -> bool {
        let up = mode.sign(0);
        let (near, far) = if mode.above[0] { (&bounds.lower, &bounds.upper) } else { (&bounds.upper, &bounds.lower) };
        let end = up * self.strokes[0][usize::from(mode.above[0])];
        let first = far[0][0];
        let mut breaks = bounds.breaks();
        breaks.extend([-last, last]);
        breaks.sort_by(f64::total_cmp);
        let inside = |bow: &Bow, y: f64| (bow.domain()[0]..=bow.domain()[1]).contains(&y);
        breaks
            .windows(2)
            .flat_map(|pair| {
                (1..SAMPLES).map(move |k| pair[0] + (pair[1] - pair[0]) * f64::from(k) / f64::from(SAMPLES))
            })
            .any(|y| {
                if y.abs() <= last || !inside(&first, y) || !inside(&far[2][0], y) {
                    return false;
                }
                let flat = ((self.link - y) * (self.link + y)).max(0.0).sqrt();
                let cosine = (self.base_radius - flat) / self.platform_radius;
                let level = end - self.platform_radius * ((1.0 - cosine) * (1.0 + cosine)).max(0.0).sqrt();
                let nearest = near.iter().map(|group| up * group[0].at(y)).fold(f64::NEG_INFINITY, f64::max);
                let third = up * far[2][0].at(y);
                level.min(third) > (up * first.at(y)).max(nearest)
            })
    }

    /// Whether the mode and the strokes are those for which unions over orientations are known.
    pub(super) fn check_same_side(&self, mode: HanaMode) -> Result<(), HanaWorkspaceError> {
        if mode.above[0] != mode.above[1] {
            return Err(HanaWorkspaceError::OppositeSides { mode });
        }
        if self.strokes[0] != self.strokes[1] {
            return Err(HanaWorkspaceError::DifferentStrokes);
        }
        Ok(())
    }
}

/// Places looked at between two breaks.
const SAMPLES: u32 = 16;
const LOWEST: [&str; 3] = ["leg 1 min", "leg 2 min", "leg 3 min"];
const HIGHEST: [&str; 3] = ["leg 1 max", "leg 2 max", "leg 3 max"];
