//! det A of a group in a pose: one number for every report that mentions it.
//!
//! | leg | its row: force, and its moment about a fixed point |
//! |---|---|
//! | RR | unit force from the base pivot towards the platform pivot; none for a leg without length |
//! | PR | unit force `i u` through the platform pivot |
//! | RP | unit force `R i v` through the base pivot |
//! | PP | no force, the moment 1 |
//!
//! The determinant of the three rows, in the order of the legs, moments in units of the group's size: the largest of the distances between base points, between
//! platform points, leg lengths and offsets ([`super::Assemblies`] reports it as `size`). It does not depend on the point that moments are about. For a pinned platform it is the moment of
//! the other leg's row about the pin, in the same units; two PP legs or a placed platform have 1.
//!
//! **Unit**: none. **Sign**: kept along a path that meets no singularity, changed across one of type 2. With a row of [`crate::Velocity::pose_matrix`] as
//! `sigma` times the leg's row here, `sigma` the distance of the idle pivots (RR), -1 (PR), 1 (RP), the sine from the leg's first idle slider to its second (PP),
//! `det pose_matrix = size · det_a · product of sigma` for three legs, without the size where one leg is PP.

use num_complex::Complex64;

use super::group::{Dyad, Pose, Triad};
use super::numbers::{LocalLegs, TriadNumbers};
use super::pinned::PinnedDyad;
use super::triad::LegNumbers;
use super::verify::{Placement, determinant, pinned_determinant, size};

/// det A of legs in local units, as the table above has it; `parity` is -1 where their order is an odd permutation of the one given.
pub(super) fn scaled_determinant(
    legs: &[LegNumbers<f64>],
    at: Placement,
    pinned: bool,
    parity: f64,
    group_size: f64,
) -> f64 {
    // A PP leg restrains the rotation by a pure moment: then no length is left in the determinant.
    let (determinant, has_length) = if pinned {
        (pinned_determinant(legs, at), legs.len() == 2)
    } else {
        (parity * determinant(legs, at), legs.len() == 3)
    };
    if has_length && group_size > 0.0 { determinant / group_size } else { determinant }
}

fn in_pose(legs: &[Dyad], pinned: bool, pose: &Pose) -> f64 {
    let numbers = TriadNumbers::of(legs);
    let local = LocalLegs::of(&numbers);
    let rotation = Complex64::from_polar(1.0, pose.phi);
    let (a0, b0) = numbers.order.first().map_or_else(Default::default, |&i| points(&legs[i]));
    let u = Complex64::new(pose.x, pose.y) + rotation * b0 - a0;
    // In two steps: 2^unit alone may leave the range of f64.
    let unit = local.unit.clamp(-2200, 2200) as i32;
    let at = Placement { rotation, u: u * 2f64.powi(-(unit / 2)) * 2f64.powi(-(unit - unit / 2)) };
    scaled_determinant(&local.legs, at, pinned, parity(legs, &numbers.order), size(&local.legs))
}

impl Triad {
    /// det A in a pose that closes: the determinant of the legs' unit wrenches in their order, moments over the largest length; no unit.
    ///
    /// A leg RR pushes from base to platform, PR along `i u`, RP along `R i v`, PP gives the moment 1. Zero where the pose is singular of type 2, and for a leg of length zero.
    /// **Accuracy**: some roundings, and what the pose's rounding does; [`Triad::assemble`] reports the same number from its own digits. **Cost**: some microseconds.
    ///
    /// ```
    /// use assur::{Dyad, Triad, nalgebra::Vector2};
    /// let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
    /// let triad = Triad::new([
    ///     leg([0.0, 0.0], [0.0, 0.0], 14.98),
    ///     leg([15.91, 0.0], [17.045, 0.0], 15.38),
    ///     leg([0.0, 10.0], [13.2389, 16.0929], 12.0),
    /// ])?;
    /// let mode = &triad.assemble().modes[0];
    /// assert!((triad.det_a(&mode.pose) - mode.det_a).abs() < 1e-13);
    /// # Ok::<(), assur::TriadError>(())
    /// ```
    pub fn det_a(&self, pose: &Pose) -> f64 {
        in_pose(self.legs(), false, pose)
    }
}

impl PinnedDyad {
    /// det A in a pose that closes: the moment of the leg's unit wrench about the pin, over the largest length; 1 for PP.
    pub fn det_a(&self, pose: &Pose) -> f64 {
        in_pose(&self.as_legs(), true, pose)
    }
}

/// Base and platform point of a leg as complex numbers; the origin for a PP leg, which has none.
pub(super) fn points(leg: &Dyad) -> (Complex64, Complex64) {
    match leg {
        Dyad::RR { a, b, .. } | Dyad::PR { a, b, .. } | Dyad::RP { a, b, .. } => {
            (Complex64::new(a.x, a.y), Complex64::new(b.x, b.y))
        }
        Dyad::PP { .. } => Default::default(),
    }
}

/// The sign of the order in which legs are solved, PP legs last, against the order given.
pub(super) fn parity(legs: &[Dyad], order: &[usize]) -> f64 {
    let last = (0..legs.len()).filter(|i| !order.contains(i));
    let order: Vec<usize> = order.iter().copied().chain(last).collect();
    let exchanges = (0..order.len()).map(|i| order[..i].iter().filter(|&&before| before > order[i]).count());
    if exchanges.sum::<usize>() % 2 == 0 { 1.0 } else { -1.0 }
}
