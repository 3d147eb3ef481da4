//! Circles and lines, and where they meet.

use arrayvec::ArrayVec;
use nalgebra::Vector2;

/// A whole circle or a whole line: what arcs and segments lie on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carrier {
    /// A circle; radius zero is a point.
    Circle {
        /// Its centre.
        center: Vector2<f64>,
        /// Its radius, not negative.
        radius: f64,
    },
    /// A line.
    Line {
        /// A point of it.
        point: Vector2<f64>,
        /// Its direction, of length one.
        direction: Vector2<f64>,
    },
}

/// How two carriers meet.
#[derive(Clone, Debug, PartialEq)]
pub enum Meeting {
    /// They are one and the same within the tolerance.
    Same,
    /// They cross in two points or (two lines) one, touch in one, or stay apart.
    Points(ArrayVec<Vector2<f64>, 2>),
}

impl Carrier {
    /// Signed distance: outside a circle, to the left of a line, positive.
    pub fn distance(&self, p: Vector2<f64>) -> f64 {
        match *self {
            Self::Circle { center, radius } => (p - center).norm() - radius,
            Self::Line { point, direction } => direction.perp(&(p - point)),
        }
    }

    /// The parameter of the point of the carrier nearest to `p`: an angle in radians, or a length along the line.
    pub fn parameter(&self, p: Vector2<f64>) -> f64 {
        match *self {
            Self::Circle { center, .. } => (p.y - center.y).atan2(p.x - center.x),
            Self::Line { point, direction } => direction.dot(&(p - point)),
        }
    }

    /// The point at a parameter.
    pub fn at(&self, parameter: f64) -> Vector2<f64> {
        match *self {
            Self::Circle { center, radius } => {
                let (sin, cos) = parameter.sin_cos();
                center + radius * Vector2::new(cos, sin)
            }
            Self::Line { point, direction } => point + parameter * direction,
        }
    }

    /// The unit normal at a point of the carrier: away from the centre, to the left of the line.
    pub fn normal(&self, p: Vector2<f64>) -> Vector2<f64> {
        match *self {
            Self::Circle { center, .. } => (p - center).try_normalize(0.0).unwrap_or_else(Vector2::x),
            Self::Line { direction, .. } => Vector2::new(-direction.y, direction.x),
        }
    }

    /// Where two carriers meet; what comes nearer than `tol` (a length) to touching is taken to touch.
    ///
    /// **Accuracy**: a few roundings of the numbers given. A touching point is found along the line of centres, not as a double root, so it keeps
    /// all its digits.
    pub fn meet(&self, other: &Self, tol: f64) -> Meeting {
        match (*self, *other) {
            (Self::Circle { center, radius }, Self::Circle { center: c, radius: r }) => {
                circles(center, radius, c, r, tol)
            }
            (Self::Circle { center, radius }, Self::Line { point, direction })
            | (Self::Line { point, direction }, Self::Circle { center, radius }) => {
                Meeting::Points(circle_and_line(center, radius, point, direction, tol))
            }
            (Self::Line { point, direction }, Self::Line { point: p, direction: d }) => {
                lines(point, direction, p, d, tol)
            }
        }
    }
}

fn circles(c1: Vector2<f64>, r1: f64, c2: Vector2<f64>, r2: f64, tol: f64) -> Meeting {
    let between = c2 - c1;
    let d = between.norm();
    if d + (r1 - r2).abs() <= tol {
        return Meeting::Same;
    }
    let mut points = ArrayVec::new();
    let (outer, inner) = (r1 + r2 - d, d - (r1 - r2).abs());
    if outer < -tol || inner < -tol || d == 0.0 {
        return Meeting::Points(points);
    }
    let u = between / d;
    if outer <= tol {
        points.push(c1 + u * (r1 - 0.5 * outer));
    } else if inner <= tol {
        let side = if r1 >= r2 { 1.0 } else { -1.0 };
        points.push(c1 + u * (side * r1 + 0.5 * inner));
    } else {
        let along = 0.5 * (d + (r1 - r2) * (r1 + r2) / d);
        // Heron's product keeps the digits that r1² - along² loses near a touch.
        let across = 0.5 * ((r1 + r2 + d) * outer * (d + r1 - r2) * (d - r1 + r2)).max(0.0).sqrt() / d;
        let (foot, side) = (c1 + u * along, Vector2::new(-u.y, u.x) * across);
        points.push(foot + side);
        points.push(foot - side);
    }
    Meeting::Points(points)
}

fn circle_and_line(c: Vector2<f64>, r: f64, p: Vector2<f64>, u: Vector2<f64>, tol: f64) -> ArrayVec<Vector2<f64>, 2> {
    let mut points = ArrayVec::new();
    let h = u.perp(&(c - p));
    let foot = p + u * u.dot(&(c - p));
    let gap = r - h.abs();
    if gap < -tol {
        return points;
    }
    if gap <= tol {
        points.push(foot + 0.5 * gap * Vector2::new(u.y, -u.x) * h.signum());
    } else {
        let half = (gap * (r + h.abs())).sqrt();
        points.push(foot + u * half);
        points.push(foot - u * half);
    }
    points
}

fn lines(p: Vector2<f64>, u: Vector2<f64>, q: Vector2<f64>, v: Vector2<f64>, tol: f64) -> Meeting {
    /// Lines whose directions differ by less than this never meet (heuristic: a hundred roundings of a unit vector).
    const PARALLEL: f64 = 1e-14;
    let cross = u.perp(&v);
    if cross.abs() <= PARALLEL {
        return if u.perp(&(q - p)).abs() <= tol { Meeting::Same } else { Meeting::Points(ArrayVec::new()) };
    }
    let mut points = ArrayVec::new();
    points.push(p + u * ((q - p).perp(&v) / cross));
    Meeting::Points(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn carrier() -> impl Strategy<Value = Carrier> {
        let number = || -3.0..3.0f64;
        prop_oneof![
            (number(), number(), 0.0..3.0f64)
                .prop_map(|(x, y, radius)| Carrier::Circle { center: Vector2::new(x, y), radius }),
            (number(), number(), -3.2..3.2f64).prop_map(|(x, y, angle)| Carrier::Line {
                point: Vector2::new(x, y),
                direction: Vector2::new(angle.cos(), angle.sin())
            }),
        ]
    }

    proptest! {
        #[test]
        fn meeting_points_lie_on_both(a in carrier(), b in carrier()) {
            let Meeting::Points(points) = a.meet(&b, 1e-12) else { return Ok(()) };
            for p in points {
                let scale = 1.0 + p.norm();
                prop_assert!(a.distance(p).abs() < 1e-11 * scale && b.distance(p).abs() < 1e-11 * scale);
                prop_assert!((a.at(a.parameter(p)) - p).norm() < 1e-11 * scale);
            }
        }
    }

    #[test]
    fn touching_keeps_its_digits() {
        let circle = |x: f64, radius| Carrier::Circle { center: Vector2::new(x, 0.0), radius };
        let touch = |a: &Carrier, b: &Carrier| match a.meet(b, 1e-12) {
            Meeting::Points(points) if points.len() == 1 => points[0],
            other => panic!("{other:?}"),
        };
        assert!((touch(&circle(0.0, 1.0), &circle(3.0, 2.0 + 1e-14)) - Vector2::x()).norm() < 1e-13);
        assert!((touch(&circle(0.0, 3.0), &circle(1.0, 2.0 - 1e-14)) - Vector2::new(3.0, 0.0)).norm() < 1e-13);
        assert!((touch(&circle(1.0, 2.0), &circle(0.0, 3.0)) - Vector2::new(3.0, 0.0)).norm() < 1e-13);
        let line = Carrier::Line { point: Vector2::new(1.0, 5.0), direction: Vector2::y() };
        assert!((touch(&circle(0.0, 1.0), &line) - Vector2::x()).norm() < 1e-13);
        assert_eq!(circle(0.0, 1.0).meet(&circle(1e-14, 1.0), 1e-12), Meeting::Same);
    }
}
