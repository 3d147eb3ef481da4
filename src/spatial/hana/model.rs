//! What a HANA is made of.

use super::super::error::{SpatialError, moderate, positive, range};

/// The robot HANA: radii, lengths of links, strokes. All lengths in one unit.
///
/// ```
/// use assur::Hana;
/// let robot = Hana::new(3.0, 12.0, 15.0, 15.0, [[-3.0, 3.0]; 3])?;
/// assert_eq!(robot, Hana::example());
/// let error = Hana::new(3.0, 12.0, 0.0, 15.0, [[-3.0, 3.0]; 3]).unwrap_err();
/// assert_eq!(error.to_string(), "L: 0 must be > 0");
/// # Ok::<(), assur::SpatialError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Hana {
    /// A name for people; may be empty.
    pub name: String,
    /// `r`: radius of the platform.
    pub platform_radius: f64,
    /// `R`: radius of the base.
    pub base_radius: f64,
    /// `L`: length of the links of legs 1 and 2.
    pub link: f64,
    /// `L3`: length of the link of leg 3.
    pub third_link: f64,
    /// The range of each slider's height, leg 1 first.
    pub strokes: [[f64; 2]; 3],
}

/// Where the platform is: its centre in the plane `x = 0`, and its rotation about `y` in radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HanaPose {
    /// Place of the centre along the axis of rotation.
    pub y: f64,
    /// Height of the centre.
    pub z: f64,
    /// Rotation, in radians: positive lowers `P1` and raises `P2`.
    pub phi: f64,
}

impl HanaPose {
    /// A pose.
    pub fn new(y: f64, z: f64, phi: f64) -> Self {
        Self { y, z, phi }
    }
}

impl Hana {
    /// A robot of radii `r`, `R`, links `L`, `L3`, and ranges of the sliders.
    ///
    /// # Errors
    /// As [`Hana::validate`].
    pub fn new(r: f64, base_radius: f64, l: f64, l3: f64, strokes: [[f64; 2]; 3]) -> Result<Self, SpatialError> {
        let robot = Self { name: String::new(), platform_radius: r, base_radius, link: l, third_link: l3, strokes };
        robot.validate()?;
        Ok(robot)
    }

    /// The design studied in the paper: `r = 3`, `R = 12`, `L = L3 = 15`, sliders within ±3.
    pub fn example() -> Self {
        Self {
            name: String::new(),
            platform_radius: 3.0,
            base_radius: 12.0,
            link: 15.0,
            third_link: 15.0,
            strokes: [[-3.0, 3.0]; 3],
        }
    }

    /// Whether the numbers make a robot.
    ///
    /// # Errors
    /// A length that is not positive, a stroke reversed, a number that is not finite or of a size whose powers leave `f64`.
    pub fn validate(&self) -> Result<(), SpatialError> {
        positive("r", self.platform_radius)?;
        positive("R", self.base_radius)?;
        positive("L", self.link)?;
        positive("L3", self.third_link)?;
        for (leg, stroke) in (1..).zip(self.strokes) {
            range(&format!("strokes, leg {leg}"), stroke)?;
        }
        Ok(())
    }

    /// `L² - (R - r c)² - y²` as a product that keeps its digits where it vanishes.
    pub(super) fn height_square(&self, y: f64, cosine: f64) -> f64 {
        let across = (self.base_radius - self.platform_radius * cosine).hypot(y);
        (self.link - across) * (self.link + across)
    }

    /// `L3² - (y + R - r)²`.
    pub(super) fn third_height_square(&self, y: f64) -> f64 {
        let across = y + self.base_radius - self.platform_radius;
        (self.third_link - across) * (self.third_link + across)
    }

    /// The largest of the robot's lengths: what residuals are relative to.
    pub(super) fn size(&self) -> f64 {
        self.base_radius.max(self.platform_radius).max(self.link).max(self.third_link)
    }

    pub(super) fn check_pose(&self, pose: &HanaPose) -> Result<(), SpatialError> {
        moderate(|| "pose y".to_owned(), pose.y)?;
        moderate(|| "pose z".to_owned(), pose.z)?;
        match pose.phi.is_finite() {
            true => Ok(()),
            false => Err(SpatialError::NotFinite { what: "pose phi".to_owned(), value: pose.phi }),
        }
    }
}
