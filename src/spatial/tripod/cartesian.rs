//! The Cartesian member in closed form.
//!
//! | symbol | meaning |
//! |---|---|
//! | `t1, t2, t3` | tangents of the planes' angles: `(rho2 - rho1)/(d2 - d1)` and so on |
//! | `T` | `t1 t2 t3` |
//!
//! With every plane within a quarter turn and `T > -1` there is one pose. The paper's eqs. (14) and (15) have `rho3` where it must be `rho5`
//! (derivation `cartesian_robot`); its eqs. (17) and (21)-(23) give a reflection where `T < -1`, and `T = -1` is a second singularity beside `T = 1`:
//! there every rotation has its platform axes parallel to base axes.

use nalgebra::{Matrix3, Rotation3, Vector3};
use thiserror::Error;

use super::model::TripodPose;

/// Distances of the rails from the planes of the axes.
///
/// ```
/// use assur::CartesianRobot;
/// let robot = CartesianRobot { d1: 600.0, d2: 720.0 };
/// let pose = robot.forward(&[200.0, 200.0, 260.0, 260.0, 240.0, 240.0])?;
/// assert_eq!(pose.position.as_slice(), &[200.0, 260.0, 240.0]);
/// # Ok::<(), assur::CartesianSingular>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CartesianRobot {
    /// Distance of the rails 1, 3, 5.
    pub d1: f64,
    /// Distance of the rails 2, 4, 6.
    pub d2: f64,
}

/// Why there is no closed answer.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum CartesianSingular {
    /// `T = 1`: the planes are parallel to a line.
    #[error("t1 t2 t3 = {product}: the legs' planes are parallel to a line (type 2), the place is not determined")]
    Position {
        /// `T`.
        product: f64,
    },
    /// `T = -1`: the orientation is not determined.
    #[error("t1 t2 t3 = {product}: the platform is free to turn (type 2), the orientation is not determined")]
    Orientation {
        /// `T`.
        product: f64,
    },
    /// `T < -1`: no rotation has every plane within a quarter turn; the paper's formulas give a reflection.
    #[error("t1 t2 t3 = {product} < -1: no orientation has all three planes within a quarter turn")]
    NoProperRotation {
        /// `T`.
        product: f64,
    },
    /// Equal rails or an input that is not finite.
    #[error("d1, d2 and the inputs must be finite, d1 and d2 different")]
    Number,
}

/// `|1 ± T|` below this counts as zero (heuristic).
const SINGULAR: f64 = 1e-12;

impl CartesianRobot {
    /// The slider positions for a pose; `None` where a plane is turned by a quarter.
    ///
    /// **Source**: Cherkhelanov, Bonev, eqs. (5)-(13).
    pub fn inverse(&self, pose: &TripodPose) -> Option<[f64; 6]> {
        let r = pose.rotation.matrix();
        let [x, y, z]: [f64; 3] = pose.position.into();
        let t = [r[(0, 1)] / r[(1, 1)], r[(1, 2)] / r[(2, 2)], r[(2, 0)] / r[(0, 0)]];
        let at = |d: f64| [x + (d - y) * t[0], y + (d - z) * t[1], z + (d - x) * t[2]];
        let ([a1, a2, a3], [b1, b2, b3]) = (at(self.d1), at(self.d2));
        let inputs = [a1, b1, a2, b2, a3, b3];
        inputs.iter().all(|x| x.is_finite()).then_some(inputs)
    }

    /// The one pose with every plane within a quarter turn.
    ///
    /// **Accuracy**: closed form, a few roundings over `|1 ± T|`. **Cost**: some tens of nanoseconds. **Source**: Cherkhelanov, Bonev, eqs. (14)-(23) with (14), (15) corrected.
    ///
    /// # Errors
    /// `T = 1`, `T = -1`, `T < -1`, numbers that are not finite.
    pub fn forward(&self, inputs: &[f64; 6]) -> Result<TripodPose, CartesianSingular> {
        let &[r1, r2, r3, r4, r5, r6] = inputs;
        let (d, span) = (self.d1, self.d2 - self.d1);
        let [t1, t2, t3] = [(r2 - r1) / span, (r4 - r3) / span, (r6 - r5) / span];
        let product = t1 * t2 * t3;
        if !(product.is_finite() && inputs.iter().all(|x| x.is_finite())) {
            return Err(CartesianSingular::Number);
        }
        let scale = 1.0 + product.abs();
        if (product - 1.0).abs() <= SINGULAR * scale {
            return Err(CartesianSingular::Position { product });
        }
        if (product + 1.0).abs() <= SINGULAR * scale {
            return Err(CartesianSingular::Orientation { product });
        }
        if product < -1.0 {
            return Err(CartesianSingular::NoProperRotation { product });
        }
        let over = 1.0 / (product - 1.0);
        let position = Vector3::new(
            (d * product + (d - r5) * t1 * t2 + (d - r3) * t1 - r1) * over,
            (d * product + (d - r1) * t2 * t3 + (d - r5) * t2 - r3) * over,
            (d * product + (d - r3) * t1 * t3 + (d - r1) * t3 - r5) * over,
        );
        // x' ∝ (1, a3, t3), y' ∝ (t1, 1, a1), z' ∝ (a2, t2, 1): square to each other, which is linear in the a.
        let below = 1.0 / (1.0 + product);
        let a1 = (t1 * t3 - t2 * (1.0 + t1 * t1)) * below;
        let a2 = (t1 * t2 - t3 * (1.0 + t2 * t2)) * below;
        let a3 = (t2 * t3 - t1 * (1.0 + t3 * t3)) * below;
        let [x, y, z] = [unit(1.0, a3, t3), unit(t1, 1.0, a1), unit(a2, t2, 1.0)];
        Ok(TripodPose { position, rotation: Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, z])) })
    }

    /// `det J = (d2 - d1)³ (1 - T)(1 + T)/(sin a1 sin a2 sin a3 c1 c2 c3)` for the pose of these inputs, in the cube of the unit of length.
    ///
    /// # Errors
    /// As [`CartesianRobot::forward`], except `T = ±1`.
    pub fn jacobian_determinant(&self, inputs: &[f64; 6]) -> Result<f64, CartesianSingular> {
        match self.forward(inputs) {
            Err(CartesianSingular::Position { .. } | CartesianSingular::Orientation { .. }) => Ok(0.0),
            Err(error) => Err(error),
            Ok(pose) => {
                let span = self.d2 - self.d1;
                let t = [0, 2, 4].map(|k| (inputs[k + 1] - inputs[k]) / span);
                let product = t[0] * t[1] * t[2];
                // sin a1 c1 is the entry r22 of the rotation, and so on around.
                let diagonal: f64 = pose.rotation.matrix().diagonal().iter().product();
                Ok(span.powi(3) * (1.0 - product) * (1.0 + product) / diagonal)
            }
        }
    }
}

fn unit(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x, y, z) / (x * x + y * y + z * z).sqrt()
}
