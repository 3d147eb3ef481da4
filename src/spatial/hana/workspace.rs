//! Where can HANA's platform be: in one orientation, and over a range of them?
//!
//! In one orientation a slider within its stroke keeps the centre between two congruent half circles. Over a range, a place is on the boundary only if no orientation
//! that reaches it can be left either way, so one of these holds: two limits are met at once, or one limit is met and turning does not change it to first
//! order, or a link lies level. Each gives a curve:
//!
//! | what is met | curve |
//! |---|---|
//! | both sliders 1 and 2 at ends `e1`, `e2`, on the same side | `sin phi = (e2 - e1)/(2r)`: half a circle about `(0, (e1 + e2)/2)` |
//! | the same, on opposite sides | the line `z = (e1 + e2)/2` |
//! | a slider at an end, the orientation at its last | half a circle |
//! | a slider at an end, turning changes nothing | `y² + (r ± sqrt(R² + (z - e)²))² = L²`: a spiric section; link and platform in one plane |
//! | a slider at an end, links 1 and 2 level | `(R - r c)² + y² = L²`, `z = e ± r s`: the crossing of two cylinders |
//! | links 1 and 2 level, turning changes nothing | an upright line, `c = ±1` or `c = R/r` |
//! | slider 3 at an end, or its link level | half a circle, an upright line |
//!
//! The fourth and fifth are no arcs of circles and are named as what they are; with equal strokes, sliders on the same side and `r < R` they bound little or nothing. Which
//! curve bounds where is decided by inverse kinematics between them: a place is reached if one of the orientations in which a limit is met allows the others.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::super::bow::{Bow, LinkCurve, Shape};
use super::super::error::SpatialError;
use super::super::region::ArcRegion;
use super::inverse::HanaMode;
use super::model::Hana;

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
        finite("phi", phi)?;
        let (robot, unit) = self.in_own_unit();
        let reach = Reach { robot: &robot, mode, orientations: Orientations::Only(phi) };
        let mut bows = reach.third_leg();
        for leg in 0..2 {
            bows.extend((0..2).filter_map(|end| reach.fixed(leg, end, phi, "")));
        }
        Ok(ArcRegion::bounded_by(&bows, &[], robot.size(), |place| reach.holds(place)).scaled(unit))
    }

    /// The places of the platform's centre over all orientations between the quarter turns, in one working mode: any strokes, sliders on either side, any radii.
    ///
    /// With sliders 1 and 2 on the same side a quarter turn is singular, and what lies behind it is not counted. **Shape**, **accuracy** as [`Hana::reachable_between`].
    /// The "area" 32.7980 in print is the perimeter, 32.797963; the area is 44.244826, as a scan over orientations confirms.
    ///
    /// # Errors
    /// None that the model does not have already.
    ///
    /// ```
    /// use assur::{Hana, HanaMode};
    /// let region = Hana::example().reachable_workspace(HanaMode::ABOVE)?;
    /// assert!((region.area - 44.244825742417675).abs() < 1e-11);
    /// assert!((region.perimeter - 32.7980).abs() < 5e-5);
    /// # Ok::<(), assur::SpatialError>(())
    /// ```
    pub fn reachable_workspace(&self, mode: HanaMode) -> Result<ArcRegion, SpatialError> {
        self.reachable_between(mode, [-FRAC_PI_2, FRAC_PI_2])
    }

    /// The places of the platform's centre over the orientations from one to another, counter-clockwise, in radians; a full turn or more is every orientation, the same twice is
    /// that one. Singularities of type 2 between them are no limits.
    ///
    /// **Shape**: arcs in the plane `Oyz`, with holes where there are any. Pieces that are no arcs of circles are named: [`crate::WorkspaceCurve`].
    /// **Accuracy**: corners to about `1e-12` of the size; area, perimeter and centroid in closed form on circles and lines, else by Gauss rules to the same. Which curve
    /// bounds where is decided in `f64`: pieces thinner than `1e-8` of the size may go unseen. **Cost**: some milliseconds.
    ///
    /// # Errors
    /// An orientation that is not finite.
    ///
    /// ```
    /// use assur::{Hana, HanaMode};
    /// // Sliders 1 and 2 on opposite sides: the centre stays half-way between them, a straight boundary.
    /// let robot = Hana::new(3.0, 12.0, 15.0, 15.0, [[-3.0, 3.0], [-2.0, 6.0], [0.0, 9.0]])?;
    /// let region = robot.reachable_between("+-+".parse()?, [-1.0, 0.5])?;
    /// assert!(region.loops[0].1.iter().any(|arc| arc.curve.name() == "line" && arc.active == ["leg 1 max", "leg 2 max"]));
    /// # Ok::<(), assur::SpatialError>(())
    /// ```
    pub fn reachable_between(&self, mode: HanaMode, [from, to]: [f64; 2]) -> Result<ArcRegion, SpatialError> {
        finite("phi from", from)?;
        finite("phi to", to)?;
        if to == from {
            return self.workspace(from, mode);
        }
        let (robot, unit) = self.in_own_unit();
        let width = if to - from >= TAU { TAU } else { (to - from).rem_euclid(TAU) };
        let orientations = if width >= TAU { Orientations::All } else { Orientations::Between { from, width } };
        let reach = Reach { robot: &robot, mode, orientations };
        let (bows, ends) = reach.curves();
        Ok(ArcRegion::bounded_by(&bows, &ends, robot.size(), |place| reach.holds(place)).scaled(unit))
    }

    /// The same robot with the power of two next to its size as unit of length, and that unit: no digit is lost, and no power leaves `f64`.
    fn in_own_unit(&self) -> (Self, f64) {
        let unit = 2.0_f64.powi(self.size().log2().floor() as i32);
        let robot = Self {
            platform_radius: self.platform_radius / unit,
            base_radius: self.base_radius / unit,
            link: self.link / unit,
            third_link: self.third_link / unit,
            strokes: self.strokes.map(|stroke| stroke.map(|end| end / unit)),
            name: String::new(),
        };
        (robot, unit)
    }
}

fn finite(what: &str, value: f64) -> Result<(), SpatialError> {
    if value.is_finite() { Ok(()) } else { Err(SpatialError::NotFinite { what: what.to_owned(), value }) }
}

/// Which orientations count, in radians.
#[derive(Clone, Copy)]
enum Orientations {
    Only(f64),
    Between { from: f64, width: f64 },
    All,
}

/// A question about places: which are reached in a mode, in some of the orientations?
struct Reach<'a> {
    robot: &'a Hana,
    mode: HanaMode,
    orientations: Orientations,
}

const LIMITS: [[&str; 2]; 3] = [["leg 1 min", "leg 1 max"], ["leg 2 min", "leg 2 max"], ["leg 3 min", "leg 3 max"]];
const IN_PLANE: [&str; 2] = ["link 1 and platform in one plane", "link 2 and platform in one plane"];
const LINKS_LEVEL: &str = "links 1, 2 level";
/// An orientation this near to an end of the range is within, in radians: candidates are had to a few roundings.
const AT_END: f64 = 1e-12;

/// 1 for leg 1, whose joint sinks as the platform turns, and -1 for leg 2.
fn turn(leg: usize) -> f64 {
    if leg == 0 { 1.0 } else { -1.0 }
}

impl Reach<'_> {
    fn within(&self, phi: f64) -> bool {
        match self.orientations {
            Orientations::Only(only) => phi == only,
            Orientations::All => true,
            Orientations::Between { from, width } => {
                let beyond = (phi - from).rem_euclid(TAU);
                beyond <= width + AT_END || beyond >= TAU - AT_END
            }
        }
    }

    fn ends(&self) -> Vec<(f64, &'static str)> {
        match self.orientations {
            Orientations::Only(only) => vec![(only, "")],
            Orientations::All => Vec::new(),
            Orientations::Between { from, width } => vec![(from, "phi from"), (from + width, "phi to")],
        }
    }

    /// The half circle on which a slider is at an end of its stroke in one orientation.
    fn fixed(&self, leg: usize, end: usize, phi: f64, name: &'static str) -> Option<Bow> {
        let (sine, cosine) = phi.sin_cos();
        let height = self.robot.strokes[leg][end] + turn(leg) * self.robot.platform_radius * sine;
        let square = self.robot.height_square(0.0, cosine);
        Bow::circle([0.0, height], square, -self.mode.sign(leg), [LIMITS[leg][end], name])
    }

    fn third_leg(&self) -> Vec<Bow> {
        let (offset, link) = (self.robot.platform_radius - self.robot.base_radius, self.robot.third_link);
        let half = |end: usize| {
            let center = [offset, self.robot.strokes[2][end]];
            let circle = Bow::circle(center, link * link, -self.mode.sign(2), [LIMITS[2][end], ""]);
            // The radius itself, not the root of its square.
            circle.map(|bow| Bow {
                shape: Shape::Circle { center, radius: link },
                domain: [offset - link, offset + link],
                ..bow
            })
        };
        (0..2).filter_map(half).collect()
    }

    /// Every curve that can bound the places reached, and values of `y` at which they can end upright.
    fn curves(&self) -> (Vec<Bow>, Vec<f64>) {
        let (r, base, l) = (self.robot.platform_radius, self.robot.base_radius, self.robot.link);
        let mut bows = self.third_leg();
        let strokes = &self.robot.strokes;
        for e1 in 0..2 {
            for e2 in 0..2 {
                let active = [LIMITS[0][e1], LIMITS[1][e2]];
                let (one, two) = (strokes[0][e1], strokes[1][e2]);
                let height = 0.5 * (one + two);
                if self.mode.above[0] != self.mode.above[1] {
                    bows.push(Bow::line(height, [-l, l], active));
                    continue;
                }
                let sine = (two - one) / (2.0 * r);
                if sine.abs() > 1.0 {
                    continue;
                }
                let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
                for cosine in [cosine, -cosine] {
                    if self.within(sine.atan2(cosine)) {
                        let square = self.robot.height_square(0.0, cosine);
                        bows.extend(Bow::circle([0.0, height], square, -self.mode.sign(0), active));
                    }
                }
            }
        }
        for leg in 0..2 {
            for end in 0..2 {
                bows.extend(self.ends().into_iter().filter_map(|(phi, name)| self.fixed(leg, end, phi, name)));
                let height = strokes[leg][end];
                for sigma in [1.0, -1.0] {
                    // (z - e)² = (r + sigma l)² - R², where |r + sigma l| ≥ R.
                    let factors = [[r - base, sigma], [r + base, sigma]];
                    let shape = Shape::Spiric(LinkCurve { height, link: l, factors });
                    let active = [LIMITS[leg][end], IN_PLANE[leg]];
                    if sigma > 0.0 {
                        bows.extend(Bow::over_link(shape, [base - r, l], active));
                    } else {
                        bows.extend(Bow::over_link(shape, [r + base, l], active));
                        bows.extend(Bow::over_link(shape, [0.0, r - base], active));
                    }
                    // (z - e)² = r² - (R - sigma l)², where R - sigma l = r cos phi.
                    let factors = [[r - base, sigma], [r + base, -sigma]];
                    let shape = Shape::Level(LinkCurve { height, link: l, factors });
                    let active = [LIMITS[leg][end], LINKS_LEVEL];
                    let range = if sigma > 0.0 { [base - r, base + r] } else { [0.0, r - base] };
                    bows.extend(Bow::over_link(shape, range, active));
                }
            }
        }
        let across = |cosine: f64| {
            let square = self.robot.height_square(0.0, cosine);
            (square >= 0.0).then(|| square.sqrt())
        };
        let mut upright: Vec<f64> = [1.0, -1.0].into_iter().filter_map(across).collect();
        if base <= r {
            upright.push(l);
        }
        let ends = upright.into_iter().flat_map(|y| [y, -y]).chain([0.0]).collect();
        (bows, ends)
    }

    /// Whether a place is reached. For places on none of the curves; on them by rounding.
    fn holds(&self, [y, z]: [f64; 2]) -> bool {
        let h = self.robot;
        let third = h.third_height_square(y);
        let in_stroke = |leg: usize, value: f64| (h.strokes[leg][0]..=h.strokes[leg][1]).contains(&value);
        if third < 0.0 || !in_stroke(2, z + self.mode.sign(2) * third.sqrt()) {
            return false;
        }
        let (r, base, l) = (h.platform_radius, h.base_radius, h.link);
        let slider = |leg: usize, sine: f64, height: f64| z - turn(leg) * r * sine + self.mode.sign(leg) * height;
        let both = |phi: f64| {
            let (sine, cosine) = phi.sin_cos();
            let square = h.height_square(y, cosine);
            square >= 0.0 && (0..2).all(|leg| in_stroke(leg, slider(leg, sine, square.sqrt())))
        };
        // The orientations allowed are closed: where there are any, all are, or one is at an end of something.
        if self.ends().into_iter().any(|(phi, _)| both(phi)) {
            return true;
        }
        match self.orientations {
            Orientations::Only(_) => return false,
            Orientations::All if both(0.0) => return true,
            _ => {}
        }
        let flat_square = (l - y) * (l + y);
        if flat_square < 0.0 {
            return false;
        }
        let flat = flat_square.sqrt();
        for cosine in [(base - flat) / r, (base + flat) / r] {
            if cosine.abs() > 1.0 {
                continue;
            }
            for phi in [cosine.acos(), -cosine.acos()] {
                if self.within(phi) && (0..2).all(|leg| in_stroke(leg, slider(leg, phi.sin(), 0.0))) {
                    return true;
                }
            }
        }
        for leg in 0..2 {
            let other = 1 - leg;
            for end in h.strokes[leg] {
                let down = z - end;
                // 2 r R cos phi ± 2 r down sin phi = k
                let (a, b) = (2.0 * r * base, 2.0 * r * turn(leg) * down);
                let k = r * r + base * base + y * y + (down - l) * (down + l);
                let amplitude = a.hypot(b);
                if k.abs() > amplitude {
                    continue;
                }
                let (middle, half) = (b.atan2(a), (k / amplitude).acos());
                for phi in [middle - half, middle + half] {
                    let sine = phi.sin();
                    let height = self.mode.sign(leg) * (turn(leg) * r * sine - down);
                    if self.within(phi) && height >= 0.0 && in_stroke(other, slider(other, sine, height)) {
                        return true;
                    }
                }
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn ranges_run_counter_clockwise() {
        let robot = Hana::example();
        let reach = |from: f64, width: f64| Reach {
            robot: &robot,
            mode: HanaMode::ABOVE,
            orientations: Orientations::Between { from, width },
        };
        let inside = |from: f64, width: f64| [0.0, FRAC_PI_2, PI, -FRAC_PI_2].map(|phi| reach(from, width).within(phi));
        assert_eq!(inside(-FRAC_PI_2, PI), [true, true, false, true]);
        assert_eq!(inside(FRAC_PI_2, PI), [false, true, true, true]);
        assert_eq!(inside(3.0, 0.5), [false, false, true, false]);
    }
}
