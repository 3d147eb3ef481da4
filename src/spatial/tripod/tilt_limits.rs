//! The limits of a tilt as quartics in the plane.
//!
//! With `r = p x'' + q y''`, `(p, q) = tan(theta/2) (cos phi, sin phi)`, the rotation is `R v = ((1 - r·r) v + 2 (r·v) r + 2 r × v)/(1 + r·r)`. So the angle limits, and that a plane
//! does not come along its rails, are conics in `p, q`, and a slider's end is a quartic; each is written positive where it is kept. The largest tilt that
//! every azimuth allows is the distance from the origin to the nearest of these curves.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Rotation3, Vector3};

use super::super::error::moderate;
use super::model::{Tripod, TripodError, TripodPose};
use super::sector::Quartic;
use super::tilt::TiltLimit;

/// A vector over the monomials `1, p, q, p², p q, q²`.
type Turned = [Vector3<f64>; 6];

/// Degree and power of `q` of these monomials.
const PLACES: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)];

/// Every limit of a robot at a place, positive where it is kept; those that the robot does not have are left out. `None` where home is out of limits.
pub(super) fn limits(robot: &Tripod, place: &Vector3<f64>) -> Result<Option<Vec<(TiltLimit, Quartic)>>, TripodError> {
    place.iter().try_for_each(|&x| moderate(|| "place".to_owned(), x))?;
    if robot.degrees_of_freedom() < 6 {
        let (what, found) = ("the tilt in every azimuth, without torsion,", robot.degrees_of_freedom());
        return Err(TripodError::DegreesOfFreedom { what, needed: 6, found });
    }
    let home = TripodPose { position: place - robot.tool, rotation: Rotation3::identity() };
    let inputs = robot.inverse(&home)?;
    if !robot.violations(&home, &inputs)?.is_empty() {
        return Ok(None);
    }
    let axes = robot.tilt_axes();
    // Planes at a right angle and beyond are excluded by `AlongRail`.
    let tangent = robot.plane_angle_limit.filter(|&limit| limit < FRAC_PI_2).map(f64::tan);
    let mut found = Vec::with_capacity(21);
    for (k, leg) in robot.legs.iter().enumerate() {
        let number = k + 1;
        // n·u > 0 at home.
        let sign = leg.v.cross(&leg.w).dot(&leg.u).signum();
        let normal = turned(&leg.v, &axes).map(|part| part.cross(&leg.w) * sign);
        let along = normal.map(|part| part.dot(&leg.u));
        found.push((TiltLimit::AlongRail { leg: number }, conic(&along)));
        if let Some(tangent) = tangent {
            let across = normal.map(|part| part.dot(&leg.across()));
            for side in [-1.0, 1.0] {
                let kept = std::array::from_fn(|i| tangent * along[i] + side * across[i]);
                found.push((TiltLimit::PlaneAngle { leg: number }, conic(&kept)));
            }
        }
        let Some(strokes) = &robot.strokes else { continue };
        let arm = turned(&(leg.c - robot.tool), &axes);
        let mut arms = [[0.0; 5]; 5];
        for (n, &(k, j)) in normal.iter().zip(&PLACES) {
            for (a, &(l, i)) in arm.iter().zip(&PLACES) {
                arms[k + l][j + i] += n.dot(a);
            }
        }
        for (side, rail) in [leg.da, leg.db].into_iter().enumerate() {
            let slider = 2 * k + side;
            for (end, sign) in strokes[slider].into_iter().zip([1.0, -1.0]) {
                // n · (P - D - rho u), over (1 + r·r)².
                let mut kept = arms;
                let fixed = place - rail - leg.u * end;
                for (n, &(k, j)) in normal.iter().zip(&PLACES) {
                    let part = n.dot(&fixed);
                    kept[k][j] += part;
                    kept[k + 2][j] += part;
                    kept[k + 2][j + 2] += part;
                }
                let kept = Quartic(kept.map(|part| part.map(|x| sign * x)));
                found.push((TiltLimit::Stroke { slider: slider + 1, upper: sign < 0.0 }, kept));
            }
        }
    }
    Ok(Some(found))
}

/// `(1 + r·r) R v`.
fn turned(v: &Vector3<f64>, [x, y]: &[Vector3<f64>; 2]) -> Turned {
    let (along_x, along_y) = (x.dot(v), y.dot(v));
    [
        *v,
        x.cross(v) * 2.0,
        y.cross(v) * 2.0,
        x * (2.0 * along_x) - v,
        y * (2.0 * along_x) + x * (2.0 * along_y),
        y * (2.0 * along_y) - v,
    ]
}

fn conic(parts: &[f64; 6]) -> Quartic {
    let mut by_degree = [[0.0; 5]; 5];
    for (&part, &(k, j)) in parts.iter().zip(&PLACES) {
        by_degree[k][j] = part;
    }
    Quartic(by_degree)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_those_of_the_tilted_robot() {
        let robot = Tripod::cartesian_example();
        let place = Vector3::new(160.0, 170.0, 180.0);
        let limits = limits(&robot, &place).expect("sound").expect("home is inside");
        assert_eq!(limits.len(), 21);
        for (azimuth, theta) in [(0.3_f64, 0.2_f64), (4.0, 0.5)] {
            let pose = robot.tilted_pose(&place, theta, azimuth);
            let inputs = robot.inverse(&pose).expect("regular");
            let t = (0.5 * theta).tan();
            for (limit, quartic) in &limits {
                let TiltLimit::Stroke { slider, upper } = *limit else { continue };
                let value = quartic.ray([azimuth.cos(), azimuth.sin()]).iter().rev().fold(0.0, |sum, x| sum * t + x);
                let leg = &robot.legs[(slider - 1) / 2];
                let along = (pose.rotation * leg.v).cross(&leg.w).dot(&leg.u) * (1.0 + t * t).powi(2);
                let [low, high] = robot.strokes.expect("there are")[slider - 1];
                let slack = if upper { high - inputs[slider - 1] } else { inputs[slider - 1] - low };
                assert!((value / along - slack).abs() < 1e-9, "{limit:?}: {} {slack}", value / along);
            }
        }
    }
}
