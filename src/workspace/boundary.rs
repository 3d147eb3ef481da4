//! Pieces of boundary: what they lie on, their ends, and the limits active on them.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::folds::CouplerArc;
use super::limits::{ActiveLimit, Limit};

/// What a piece of boundary lies on.
#[derive(Clone, Debug, PartialEq)]
pub enum ArcCurve {
    /// A straight segment.
    Line,
    /// A circular arc.
    Circle {
        /// Its centre.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
        /// Direction of the start from the centre, radians.
        start_angle: f64,
        /// Direction of the end: greater where the arc runs counter-clockwise, else smaller, by at most a turn.
        end_angle: f64,
    },
    /// A coupler curve: a sextic between two circles, a quartic between circle and line, and the conchoidal kinds.
    Coupler(Box<CouplerArc>),
    /// A coupler curve between two lines: an ellipse.
    Ellipse(Box<CouplerArc>),
}

/// A piece of boundary; the workspace lies to its left.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryArc {
    /// What it lies on.
    pub curve: ArcCurve,
    /// Where it starts.
    pub start: [f64; 2],
    /// Where it ends.
    pub end: [f64; 2],
    /// The limits active on it.
    pub active: Vec<ActiveLimit>,
}

/// Integrals of a piece of boundary, by Green's theorem shares of those of the region to its left.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ArcIntegrals {
    /// `½∮ (x dy - y dx)` from the origin chosen.
    pub area: f64,
    /// `⅓∮ x (x dy - y dx)`, `⅓∮ y (x dy - y dx)` from the origin chosen.
    pub moment: [f64; 2],
    /// Length.
    pub length: f64,
}

impl BoundaryArc {
    /// The piece carried along with the base frame, in which limits are these.
    pub(super) fn moved(&self, by: Vector2<f64>, own: &dyn Fn(&Limit) -> Limit) -> Self {
        let carried = |p: [f64; 2]| [p[0] + by.x, p[1] + by.y];
        let curve = match &self.curve {
            ArcCurve::Line => ArcCurve::Line,
            ArcCurve::Circle { center, radius, start_angle, end_angle } => ArcCurve::Circle {
                center: carried(*center),
                radius: *radius,
                start_angle: *start_angle,
                end_angle: *end_angle,
            },
            ArcCurve::Coupler(arc) => ArcCurve::Coupler(Box::new(arc.moved(by, own))),
            ArcCurve::Ellipse(arc) => ArcCurve::Ellipse(Box::new(arc.moved(by, own))),
        };
        Self { curve, start: carried(self.start), end: carried(self.end), active: self.active.clone() }
    }

    /// Its length.
    pub fn length(&self) -> f64 {
        self.integrals(Vector2::zeros()).length
    }

    /// `n` points along it (at least 2), the ends included.
    pub fn points(&self, n: usize) -> Vec<[f64; 2]> {
        let steps = n.max(2) - 1;
        let part = |k: usize| k as f64 / steps as f64;
        match &self.curve {
            ArcCurve::Line => (0..=steps)
                .map(|k| std::array::from_fn(|i| self.start[i] + part(k) * (self.end[i] - self.start[i])))
                .collect(),
            ArcCurve::Circle { center, radius, start_angle, end_angle } => (0..=steps)
                .map(|k| {
                    let (sin, cos) = (start_angle + part(k) * (end_angle - start_angle)).sin_cos();
                    [center[0] + radius * cos, center[1] + radius * sin]
                })
                .collect(),
            ArcCurve::Coupler(arc) | ArcCurve::Ellipse(arc) => arc.points(n),
        }
    }

    /// Its integrals about an origin. Near the region it should be, so that digits are kept.
    pub fn integrals(&self, origin: Vector2<f64>) -> ArcIntegrals {
        let (p, q) = (Vector2::from(self.start) - origin, Vector2::from(self.end) - origin);
        match &self.curve {
            ArcCurve::Line => triangle(p, q, (q - p).norm()),
            ArcCurve::Circle { center, radius, start_angle, end_angle } => {
                let (turn, c) = (end_angle - start_angle, Vector2::from(*center) - origin);
                let mut out = triangle(p, q, radius * turn.abs());
                // The segment between chord and arc: area r²(turn - sin turn)/2, its moment about the centre ⅔ r³ sin³(turn/2)
                // along the middle.
                let area = 0.5 * radius * radius * turn_minus_sine(turn);
                let (sin, cos) = (0.5 * (start_angle + end_angle)).sin_cos();
                let lever = 2.0 / 3.0 * radius.powi(3) * (0.5_f64 * turn).sin().powi(3);
                out.area += area;
                out.moment[0] += c.x * area + cos * lever;
                out.moment[1] += c.y * area + sin * lever;
                out
            }
            ArcCurve::Coupler(arc) | ArcCurve::Ellipse(arc) => arc.integrals(origin),
        }
    }

    /// The rectangle around it: `[xmin, ymin, xmax, ymax]`.
    pub fn bbox(&self) -> [f64; 4] {
        let mut out = [
            self.start[0].min(self.end[0]),
            self.start[1].min(self.end[1]),
            self.start[0].max(self.end[0]),
            self.start[1].max(self.end[1]),
        ];
        match &self.curve {
            ArcCurve::Line => {}
            ArcCurve::Circle { center, radius, start_angle, end_angle } => {
                let (from, width) = (start_angle.min(*end_angle), (end_angle - start_angle).abs());
                for (k, [dx, dy]) in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].into_iter().enumerate() {
                    let after = (0.25 * TAU * k as f64 - from).rem_euclid(TAU);
                    if after <= width {
                        out = around(out, [center[0] + dx * radius, center[1] + dy * radius]);
                    }
                }
            }
            ArcCurve::Coupler(arc) | ArcCurve::Ellipse(arc) => {
                let [low_x, low_y, high_x, high_y] = arc.bbox();
                out = around(around(out, [low_x, low_y]), [high_x, high_y]);
            }
        }
        out
    }

    /// The unit vectors along it at its start and at its end.
    pub fn tangents(&self) -> [[f64; 2]; 2] {
        match &self.curve {
            ArcCurve::Line => {
                let along = (Vector2::from(self.end) - Vector2::from(self.start)).normalize();
                [along.into(), along.into()]
            }
            ArcCurve::Circle { start_angle, end_angle, .. } => {
                let side = (end_angle - start_angle).signum();
                [*start_angle, *end_angle].map(|angle| {
                    let (sin, cos) = angle.sin_cos();
                    [-side * sin, side * cos]
                })
            }
            ArcCurve::Coupler(arc) | ArcCurve::Ellipse(arc) => arc.tangents(),
        }
    }

    /// Curvature at its start and at its end, positive where it bends to the left; 1/length.
    pub fn curvatures(&self) -> [f64; 2] {
        match &self.curve {
            ArcCurve::Line => [0.0; 2],
            ArcCurve::Circle { radius, start_angle, end_angle, .. } => [(end_angle - start_angle).signum() / radius; 2],
            ArcCurve::Coupler(arc) | ArcCurve::Ellipse(arc) => arc.curvatures(),
        }
    }
}

/// The triangle from the origin to a chord.
fn triangle(p: Vector2<f64>, q: Vector2<f64>, length: f64) -> ArcIntegrals {
    let area = 0.5 * p.perp(&q);
    let third = (p + q) / 3.0;
    ArcIntegrals { area, moment: [third.x * area, third.y * area], length }
}

/// `x - sin x` without the loss at small `x`.
fn turn_minus_sine(x: f64) -> f64 {
    /// Below this angle (radians) the series is at least as exact as the difference.
    const SMALL: f64 = 0.5;
    if x.abs() > SMALL {
        return x - x.sin();
    }
    let mut term = x * x * x / 6.0;
    let mut sum = 0.0;
    for k in 2..9 {
        sum += term;
        let n = f64::from(2 * k);
        term *= -x * x / (n * (n + 1.0));
    }
    sum
}

/// The rectangle around a rectangle and a point.
pub(super) fn around(b: [f64; 4], [x, y]: [f64; 2]) -> [f64; 4] {
    [b[0].min(x), b[1].min(y), b[2].max(x), b[3].max(y)]
}
