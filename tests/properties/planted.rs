//! Triads made from a chosen pose, so that the pose is known to be among their assembly modes.

use std::f64::consts::PI;

use assur::nalgebra::Vector2;
use assur::{Assemblies, Dyad, Offset, Pose, Triad};

#[path = "../random/mod.rs"]
mod random;
pub use random::Random;

/// The twenty triads.
pub const TRIADS: [[&str; 3]; 20] = [
    ["RR", "RR", "RR"],
    ["RR", "RR", "PR"],
    ["RR", "RR", "RP"],
    ["RR", "PR", "PR"],
    ["RR", "PR", "RP"],
    ["RR", "RP", "RP"],
    ["PR", "PR", "PR"],
    ["PR", "PR", "RP"],
    ["PR", "RP", "RP"],
    ["RP", "RP", "RP"],
    ["RR", "RR", "PP"],
    ["RR", "PR", "PP"],
    ["RR", "RP", "PP"],
    ["PR", "PR", "PP"],
    ["PR", "RP", "PP"],
    ["RP", "RP", "PP"],
    ["RR", "PP", "PP"],
    ["PR", "PP", "PP"],
    ["RP", "PP", "PP"],
    ["PP", "PP", "PP"],
];

/// A leg that holds the platform in this pose.
///
/// `numbers`: base point, platform point, direction of a slider, and how far along it the slider stands.
pub fn planted_leg(kind: &str, pose: &Pose, numbers: [f64; 7]) -> Dyad {
    let [ax, ay, bx, by, dx, dy, stroke] = numbers;
    let (a, b, direction) = (Vector2::new(ax, ay), Vector2::new(bx, by), Vector2::new(dx, dy));
    let direction = if direction == Vector2::zeros() { Vector2::x() } else { direction };
    let joint = pose.place(b);
    match kind {
        "RR" => Dyad::RR { a, b, length: (joint - a).norm() },
        "PR" => Dyad::PR { a: joint - direction * stroke, u: direction, b },
        "RP" => {
            let (sin, cos) = pose.phi.sin_cos();
            let along = Vector2::new(cos * dx - sin * dy, sin * dx + cos * dy);
            let along = if along == Vector2::zeros() { Vector2::new(cos, sin) } else { along };
            let delta = along.perp(&(a - joint));
            // Half of the legs give the distance, half of them distance times direction.
            let offset =
                if stroke > 0.0 { Offset::TimesDirection(delta) } else { Offset::Distance(delta / direction.norm()) };
            Dyad::RP { a, b, v: direction, offset }
        }
        "PP" => Dyad::PP { phi: pose.phi },
        other => panic!("{other} is no dyad"),
    }
}

/// A random triad of these dyads and a pose in which it closes.
pub fn planted_triad(names: [&str; 3], random: &mut Random) -> (Triad, Pose) {
    let pose = Pose::new(random.between(-10.0, 10.0), random.between(-10.0, 10.0), random.between(-PI, PI));
    let legs = names.map(|name| {
        let numbers = [10.0, 10.0, 10.0, 10.0, 1.0, 1.0, 5.0].map(|range| random.between(-range, range));
        planted_leg(name, &pose, numbers)
    });
    (Triad::new(legs).expect("planted numbers are finite"), pose)
}

/// The angle between two orientations.
pub fn turn(phi: f64, other: f64) -> f64 {
    let (sin, cos) = (phi - other).sin_cos();
    sin.atan2(cos).abs()
}

/// How far the nearest assembly mode is from a pose: radians, or lengths over the triad's size; infinite without any mode.
pub fn miss(answer: &Assemblies, pose: &Pose) -> f64 {
    let size = answer.size.max(pose.x.hypot(pose.y)).max(f64::MIN_POSITIVE);
    let misses = answer.modes.iter().map(|mode| {
        let found = &mode.pose;
        turn(found.phi, pose.phi).max((found.x - pose.x).hypot(found.y - pose.y) / size)
    });
    misses.fold(f64::INFINITY, f64::min)
}
