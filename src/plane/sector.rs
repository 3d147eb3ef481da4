//! Directions as points of the unit circle, and closed sectors of them.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector2;

/// The product of two vectors as complex numbers: `p` turned by the direction `d` where `d` has length one.
pub fn product(d: Vector2<f64>, p: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(d.x * p.x - d.y * p.y, d.x * p.y + d.y * p.x)
}

/// The complex conjugate: a direction turned back.
pub fn conjugate(d: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(d.x, -d.y)
}

/// The unit vector at an angle in radians; exact at the multiples of pi/2 as `f64` has them.
pub fn direction(angle: f64) -> Vector2<f64> {
    let turns = (angle / FRAC_PI_2).round();
    if turns * FRAC_PI_2 == angle {
        return match turns.rem_euclid(4.0) {
            1.0 => Vector2::new(0.0, 1.0),
            2.0 => Vector2::new(-1.0, 0.0),
            3.0 => Vector2::new(0.0, -1.0),
            _ => Vector2::new(1.0, 0.0),
        };
    }
    let (sin, cos) = angle.sin_cos();
    Vector2::new(cos, sin)
}

/// A closed sector of directions, counter-clockwise from one unit vector to another, less than a full turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sector {
    /// First direction, of length one.
    pub from: Vector2<f64>,
    /// Last direction, of length one.
    pub to: Vector2<f64>,
    /// The angle between them, radians in [0, 2 pi).
    pub width: f64,
    middle: Vector2<f64>,
}

impl Sector {
    /// The sector from a unit vector over `width` radians; `None` for a full turn or more, which excludes nothing.
    pub fn new(from: Vector2<f64>, width: f64) -> Option<Self> {
        (width < TAU).then(|| Self {
            from,
            to: product(from, direction(width)),
            width,
            middle: product(from, direction(0.5 * width)),
        })
    }

    /// Whether a vector points into the sector, or passes beside it by at most `tol`, a length in the vector's units.
    pub fn contains(&self, v: Vector2<f64>, tol: f64) -> bool {
        let after = self.from.perp(&v) >= -tol;
        let before = v.perp(&self.to) >= -tol;
        if self.width < PI {
            // Each end gives a half plane; of a sector of no width they leave a whole line.
            after && before && (self.width > FRAC_PI_2 || self.middle.dot(&v) >= -tol)
        } else {
            after || before
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sector_holds_the_angles_between_its_ends() {
        for width in [0.0, 0.3, 1.5, 2.0, 3.0, PI, 4.0, 6.0] {
            for k in -30..30 {
                let start = 0.7;
                let sector = Sector::new(direction(start), width).expect("less than a turn");
                let angle = start + 0.2 * f64::from(k) + 0.05;
                let inside = (angle - start).rem_euclid(TAU) <= width;
                assert_eq!(sector.contains(3.0 * direction(angle), 0.0), inside, "{width} {angle}");
            }
        }
        assert!(Sector::new(direction(0.0), TAU).is_none());
    }
}
