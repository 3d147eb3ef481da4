//! The closure equations of a triad as the maths page writes them, evaluated here and nowhere else.

use assur::nalgebra::Vector2;
use assur::num_complex::Complex64;
use assur::{Dyad, Offset, Pose};

fn complex(p: &Vector2<f64>) -> Complex64 {
    Complex64::new(p.x, p.y)
}

/// By how much, as a length, an RP leg wants its base pivot beside its line.
fn distance(offset: &Offset, v: &Vector2<f64>) -> f64 {
    match offset {
        Offset::Distance(d) => *d,
        Offset::TimesDirection(delta) => delta / v.norm(),
    }
}

/// The largest closure error of the legs in a real pose: lengths, and for PP radians times `size`.
pub fn real_error(legs: &[Dyad], pose: &Pose, size: f64) -> f64 {
    let (sin, cos) = pose.phi.sin_cos();
    let turned = |p: &Vector2<f64>| Vector2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
    let at = Vector2::new(pose.x, pose.y);
    let errors = legs.iter().map(|leg| match leg {
        // Differences first: a far origin costs digits otherwise.
        Dyad::RR { a, b, length } => ((at - a + turned(b)).norm() - length).abs(),
        Dyad::PR { a, u, b } => u.normalize().perp(&(at - a + turned(b))).abs(),
        Dyad::RP { a, b, v, offset } => {
            let beside = turned(&v.normalize()).perp(&(a - at - turned(b)));
            (beside - distance(offset, v)).abs()
        }
        Dyad::PP { phi } => size * super::planted::turn(pose.phi, *phi),
    });
    errors.fold(0.0, f64::max)
}

/// The largest closure error of the legs at a complex solution, over the size of what the equation adds up.
///
/// `extent` is the triad's size: on an isotropic line of a leg of length zero one factor vanishes and nothing is left to compare with.
pub fn complex_error(legs: &[Dyad], extent: f64, theta: Complex64, z: Complex64, w: Complex64) -> f64 {
    let over = |value: Complex64, size: f64| if size > 0.0 { value.norm() / size } else { value.norm() };
    let errors = legs.iter().map(|leg| match leg {
        Dyad::RR { a, b, length } => {
            let (a, b) = (complex(a), complex(b));
            let p = z + theta * b - a;
            let q = w + b.conj() / theta - a.conj();
            let size = (z.norm() + (theta * b).norm() + a.norm()) * (w.norm() + (b / theta).norm() + a.norm());
            over(p * q - length * length, size + extent * extent)
        }
        Dyad::PR { a, u, b } => {
            let (a, b, n) = (complex(a), complex(b), Complex64::I * complex(u));
            let p = z + theta * b - a;
            let q = w + b.conj() / theta - a.conj();
            let size = z.norm() + w.norm() + (theta * b).norm() + (b / theta).norm() + 2.0 * a.norm();
            over(n.conj() * p + n * q, n.norm() * size)
        }
        Dyad::RP { a, b, v, offset } => {
            let (a, b, m) = (complex(a), complex(b), Complex64::I * complex(v));
            let delta = distance(offset, v) * v.norm();
            let p = (a - z - theta * b) / theta;
            let q = (a.conj() - w - b.conj() / theta) * theta;
            let near = (a.norm() + z.norm()) / theta.norm() + b.norm();
            let far = (a.norm() + w.norm()) * theta.norm() + b.norm();
            over(m.conj() * p + m * q - 2.0 * delta, m.norm() * (near + far) + 2.0 * delta.abs())
        }
        Dyad::PP { phi } => (theta - Complex64::from_polar(1.0, *phi)).norm(),
    });
    errors.fold(0.0, f64::max)
}

/// det A in a pose: the wrenches of the legs in the order given, unit forces, moments over `size`.
pub fn determinant(legs: &[Dyad; 3], pose: &Pose, size: f64) -> f64 {
    let (sin, cos) = pose.phi.sin_cos();
    let turned = |p: &Vector2<f64>| Vector2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
    let at = Vector2::new(pose.x, pose.y);
    let size = if size > 0.0 { size } else { 1.0 };
    // Moments about the platform's origin.
    let rows = legs.map(|leg| {
        let (force, arm) = match leg {
            Dyad::RR { a, b, length } => {
                let way = at - a + turned(&b);
                (if length > 0.0 { way / way.norm() } else { Vector2::zeros() }, turned(&b))
            }
            Dyad::PR { u, b, .. } => (Vector2::new(-u.y, u.x).normalize(), turned(&b)),
            Dyad::RP { a, v, .. } => (turned(&Vector2::new(-v.y, v.x).normalize()), a - at),
            Dyad::PP { .. } => return [0.0, 0.0, 1.0],
        };
        [force.x, force.y, arm.perp(&force) / size]
    });
    let [a, b, c] = rows;
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}
