//! The void that a slider leg with a short stroke leaves around the middle of its stroke.
//!
//! The platform pivot of a PRR leg reaches every place whose distance from some place of the slider's pivot is the link's length `l`. What is nearer than `l` to both ends of
//! the stroke is nearer than that to all of it: an open lens, there where the stroke is shorter than `2 l`. Source: Gosselin, Lemieux, Merlet 1996, equation (37),
//! which asks for a stroke greater than `2 l`; at `2 l` exactly the lens is a single point, which is reached.

use nalgebra::Vector2;

use crate::manipulator::{JointKind, Leg, Manipulator};

/// What a leg's stroke leaves out between the two circles around its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StrokeVoid {
    /// Nothing: the stroke is greater than two links, equation (37).
    None,
    /// The circles around both ends touch in one point, which is reached: the stroke is two links.
    Touching {
        /// The point.
        at: [f64; 2],
    },
    /// An open lens.
    Lens {
        /// Its tips, in the base frame.
        tips: [[f64; 2]; 2],
        /// Its area.
        area: f64,
    },
}

impl Manipulator {
    /// For each leg what its stroke leaves out; `None` for a leg that is no PRR leg or whose slider has no range.
    ///
    /// **Units and frame**: places of the leg's platform pivot in the base frame.
    ///
    /// ```
    /// use assur::{Leg, Manipulator, workspace::StrokeVoid};
    /// let leg = |stroke: f64| Leg { limits: [Some([1.0, 1.0 + stroke]), None, None], ..Leg::prr([0.0, 0.0], 0.0, 2.0, [1.0, 0.0]) };
    /// let robot = Manipulator::new("", vec![leg(4.5), leg(4.0), leg(2.0)])?;
    /// let [Some(StrokeVoid::None), Some(StrokeVoid::Touching { at }), Some(StrokeVoid::Lens { tips, .. })] = robot.stroke_voids()[..] else { panic!() };
    /// assert_eq!(at, [3.0, 0.0]);
    /// assert!((tips[0][0] - 2.0).abs() < 1e-15 && (tips[0][1] - 3f64.sqrt()).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn stroke_voids(&self) -> Vec<Option<StrokeVoid>> {
        self.legs.iter().map(stroke_void).collect()
    }
}

fn stroke_void(leg: &Leg) -> Option<StrokeVoid> {
    use JointKind::{Prismatic as P, Revolute as R};
    let (true, Some([low, high])) = (leg.joints == [P, R, R], leg.limits[0]) else { return None };
    let along = leg.base.direction.try_normalize(0.0)?;
    let left = Vector2::new(-along.y, along.x);
    let pivot = leg.base.at + along * leg.links[0].at.x + left * leg.links[0].at.y;
    let (half, l) = (0.5 * (high - low), leg.links[1].at.norm());
    let middle = pivot + along * (0.5 * (low + high));
    Some(if half > l {
        StrokeVoid::None
    } else if half == l {
        StrokeVoid::Touching { at: middle.into() }
    } else {
        let height = ((l - half) * (l + half)).sqrt();
        // Two segments of the circle, each of twice this angle.
        let angle = height.atan2(half);
        StrokeVoid::Lens {
            tips: [(middle + left * height).into(), (middle - left * height).into()],
            area: 2.0 * (l * l * angle - half * height),
        }
    })
}
