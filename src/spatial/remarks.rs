//! What deserves a word about a robot before any pose is known.

use nalgebra::Vector3;

use super::hana::{Hana, HanaMode, MixedReach};
use super::tripod::{Tripod, TripodPose, TripodSingularity};

/// A peculiarity of a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialRemark {
    /// Its name: `zero_stroke`, `always_singular`, ….
    pub name: &'static str,
    /// The leg it is about, from 1; `None` where it is about all.
    pub leg: Option<usize>,
    /// In words.
    pub text: String,
}

fn remark(name: &'static str, leg: Option<usize>, text: impl Into<String>) -> SpatialRemark {
    SpatialRemark { name, leg, text: text.into() }
}

/// Sines below this make directions parallel: twelve digits are what such directions are written with (heuristic).
const PARALLEL: f64 = 1e-12;

impl Hana {
    /// What deserves a word.
    ///
    /// ```
    /// use assur::Hana;
    /// assert!(Hana::example().remarks().is_empty());
    /// let fixed = Hana::new(3.0, 12.0, 15.0, 15.0, [[-3.0, 3.0], [-3.0, 3.0], [1.0, 1.0]])?;
    /// assert_eq!(fixed.remarks()[0].name, "zero_stroke");
    /// # Ok::<(), assur::SpatialError>(())
    /// ```
    pub fn remarks(&self) -> Vec<SpatialRemark> {
        let mut found = Vec::new();
        for (leg, [low, high]) in (1..).zip(self.strokes) {
            if low == high {
                found.push(remark("zero_stroke", Some(leg), format!("leg {leg}: the stroke is a single place, {low}")));
            }
        }
        let (r, base) = (self.platform_radius, self.base_radius);
        if self.link < (base - r).abs() {
            let text = "links 1 and 2 are shorter than R - r: they do not reach a level platform";
            found.push(remark("short_links", None, text));
        } else if self.workspace(0.0, HanaMode::ABOVE).is_ok_and(|region| region.loops.is_empty()) {
            let text = "in mode +++ the strokes allow no place with the platform level";
            found.push(remark("empty_workspace", None, text));
        }
        if r == base && self.link == self.third_link {
            let text =
                "r = R and L = L3: with the sliders level and phi = 0 the platform moves on a circle (self-motion)";
            found.push(remark("self_motion", None, text));
        } else if r >= base {
            let text = "the platform is as large as the base: links 1 and 2 can stand upright or inwards";
            found.push(remark("large_platform", None, text));
        }
        match self.mixed_reach() {
            MixedReach::Nowhere => {}
            MixedReach::At { y, z } => {
                let text = format!(
                    "with sliders 1 and 2 on opposite sides the strokes reach a singularity of type 2, as at y, z = {y:.6}, {z:.6}"
                );
                found.push(remark("mixed_singularity", None, text));
            }
            MixedReach::Touched { y } => {
                let text = format!("the strokes just touch a mixed-mode singularity of type 2 at y = {y:.6}");
                found.push(remark("mixed_singularity", None, text));
            }
        }
        found
    }
}

impl Tripod {
    /// What deserves a word.
    ///
    /// ```
    /// use assur::Tripod;
    /// let names = |robot: Tripod| robot.remarks().into_iter().map(|remark| remark.name).collect::<Vec<_>>();
    /// assert_eq!(names(Tripod::cartesian(600.0, 720.0)?), ["cartesian"]);
    /// assert_eq!(names(Tripod::inclined(0.0, 600.0, 720.0)?), ["always_singular"]);
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn remarks(&self) -> Vec<SpatialRemark> {
        let mut found = Vec::new();
        let parallel =
            |pick: &dyn Fn(usize) -> Vector3<f64>| (1..3).all(|k| pick(0).cross(&pick(k)).norm() <= PARALLEL);
        let always = [
            (
                parallel(&|k| self.legs[k].w),
                "the base axes are parallel, so the legs' planes are parallel to a line in every pose",
            ),
            (
                parallel(&|k| self.legs[k].v),
                "the platform's axes are parallel, so it is free to turn about them in every pose",
            ),
        ];
        let mut singular = false;
        for (_, text) in always.into_iter().filter(|(holds, _)| *holds) {
            singular = true;
            found.push(remark("always_singular", None, text));
        }
        for (slider, [low, high]) in (1_usize..).zip(self.strokes.iter().flatten()) {
            if low == high {
                let text = format!("slider {slider}: the stroke is a single place, {low}");
                found.push(remark("zero_stroke", Some(slider.div_ceil(2)), text));
            }
        }
        let home = TripodPose::new(Vector3::zeros(), Vector3::zeros());
        match self.velocity(&home) {
            Err(error) => found.push(remark("singular_home", None, format!("in the home orientation, {error}"))),
            Ok(velocity) if velocity.singularity() != TripodSingularity::None && !singular => {
                let text = format!("singular in the home orientation: {}", velocity.singularity().reading());
                found.push(remark("singular_home", None, text));
            }
            Ok(_) => {}
        }
        if let Some([d1, d2]) = self.cartesian_distances() {
            let text = format!(
                "rails, base axes and platform axes as in the Cartesian robot, d1 = {d1}, d2 = {d2}: closed forms hold"
            );
            found.push(remark("cartesian", None, text));
        }
        found
    }

    /// `d1` and `d2`, where this is the Cartesian robot.
    fn cartesian_distances(&self) -> Option<[f64; 2]> {
        let [d1, d2] = [self.legs[0].da.y, self.legs[0].db.y];
        Self::cartesian(d1, d2).ok().filter(|robot| robot.legs == self.legs).map(|_| [d1, d2])
    }
}
