//! Curves that can bound a workspace, each as a graph `z(y)` over an interval.
//!
//! | curve | equation | where it comes from |
//! |---|---|---|
//! | circle | `(y - y0)² + (z - z0)² = radius²` | a slider at an end of its stroke, the orientation fixed; leg 3 |
//! | line | `z = z0` | two sliders at ends of their strokes on opposite sides of their joints |
//! | spiric section of Perseus | `(z - z0)² = (r ± l)² - R²` | a slider at an end, its link and the platform in one plane with the axis |
//! | crossing of two cylinders | `(z - z0)² = r² - (R ∓ l)²` | a slider at an end while its link lies level |
//!
//! with `l = sqrt(L² - y²)`. All but the circles of leg 3 are `(z - z0)² = q(l)` with `q` quadratic, so two of them meet at roots of a polynomial of degree 4
//! in `l`, one of them and a circle of leg 3 at roots of one of degree 8. Both are complemented by a search for changes of sign, so that a root that the
//! companion matrix blurs is not lost.

use nalgebra::Vector2;

use super::region::ArcCircle;
use crate::algebra::{Ring, UPoly};
use crate::plane::{Carrier, Meeting, gauss};
use crate::roots::companion_roots_real;

/// A curve other than a circle or a line: `(z - height)² = q(l)`, `l = sqrt(link² - y²)`, with `q` a product of two linear factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkCurve {
    /// The height it is symmetric about: that of a slider.
    pub height: f64,
    /// `L`.
    pub link: f64,
    /// `q(l) = (a0 + a1 l)(b0 + b1 l)`, as `[[a0, a1], [b0, b1]]`.
    pub factors: [[f64; 2]; 2],
}

/// What a curve is, without the part of it that is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    Circle {
        center: [f64; 2],
        radius: f64,
    },
    Line {
        z: f64,
    },
    /// Link and platform in one plane: a spiric section.
    Spiric(LinkCurve),
    /// Link level: a crossing of two cylinders.
    Level(LinkCurve),
}

/// A curve as a graph over an interval of `y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bow {
    pub(super) shape: Shape,
    /// 1 for the upper half, -1 for the lower.
    pub(super) side: f64,
    /// Where it is a graph.
    pub(super) domain: [f64; 2],
    /// The limits reached on it; the second may be empty.
    pub(super) active: [&'static str; 2],
}

/// Eigenvalues with a larger imaginary part, over `1 + |root|`, start no search for a crossing: two that meet come with one of `1e-8` or, fourfold, of `1e-4` (heuristic; a
/// start too many is dropped).
const NEARLY_REAL: f64 = 1e-3;
/// Curves that come as near as this, over the size, count as met: a break too many does no harm (heuristic).
const MET: f64 = 1e-7;
/// Places at which the difference of two curves is looked at for changes of sign.
const SAMPLES: usize = 24;
const SECANTS: usize = 12;
const HALVINGS: usize = 60;
/// Cells are halved for quadrature at most so often; the integrands are smooth in the angle that maps a cell, even where a curve is upright at its end.
const DEPTH: u32 = 12;
/// Where two halves differ from the whole by less than this, over the size, the halves are taken.
const SETTLED: f64 = 1e-14;

impl Bow {
    /// Half a circle; `None` without a radius.
    pub(super) fn circle(center: [f64; 2], square: f64, side: f64, active: [&'static str; 2]) -> Option<Self> {
        let radius = if square > 0.0 { square.sqrt() } else { return None };
        let domain = [center[0] - radius, center[0] + radius];
        Some(Self { shape: Shape::Circle { center, radius }, side, domain, active })
    }

    pub(super) fn line(z: f64, domain: [f64; 2], active: [&'static str; 2]) -> Self {
        Self { shape: Shape::Line { z }, side: 1.0, domain, active }
    }

    /// The halves of a curve `(z - height)² = q(l)` over a range of `l`; cut at `y = 0` where it covers it.
    pub(super) fn over_link(shape: Shape, [low, high]: [f64; 2], active: [&'static str; 2]) -> Vec<Self> {
        let (Shape::Spiric(curve) | Shape::Level(curve)) = shape else { return Vec::new() };
        let (low, high) = (low.max(0.0), high.min(curve.link));
        if low >= high {
            return Vec::new();
        }
        let across = |l: f64| ((curve.link - l) * (curve.link + l)).max(0.0).sqrt();
        let (near, far) = (across(high), across(low));
        let pieces = if near > 0.0 { vec![[-far, -near], [near, far]] } else { vec![[-far, far]] };
        let halves = |domain: [f64; 2]| [1.0, -1.0].map(|side| Self { shape, side, domain, active });
        pieces.into_iter().flat_map(halves).collect()
    }

    pub(super) fn covers(&self, y: f64) -> bool {
        self.domain[0] <= y && y <= self.domain[1]
    }

    pub(super) fn at(&self, y: f64) -> f64 {
        match self.shape {
            Shape::Circle { center, radius } => {
                let t = y - center[0];
                center[1] + self.side * ((radius - t) * (radius + t)).max(0.0).sqrt()
            }
            Shape::Line { z } => z,
            Shape::Spiric(curve) | Shape::Level(curve) => curve.height + self.side * curve.square(y).max(0.0).sqrt(),
        }
    }

    /// `dz/dy`; not finite where the curve is upright.
    fn slope(&self, y: f64) -> f64 {
        match self.shape {
            Shape::Circle { center, .. } => -(y - center[0]) / (self.at(y) - center[1]),
            Shape::Line { .. } => 0.0,
            Shape::Spiric(curve) | Shape::Level(curve) => {
                let l = curve.rest(y);
                let [[a0, a1], [b0, b1]] = curve.factors;
                let by_l = a1 * (b0 + b1 * l) + b1 * (a0 + a1 * l);
                -by_l * y / l / (2.0 * (self.at(y) - curve.height))
            }
        }
    }

    /// Integrals of `z`, `y z` and `z²` over `[a, b]`, and the length of the curve there.
    pub(super) fn integrals(&self, [a, b]: [f64; 2]) -> [f64; 4] {
        match self.shape {
            Shape::Circle { center: [y0, z0], radius } => {
                let root = |t: f64| ((radius - t) * (radius + t)).max(0.0).sqrt();
                let angle = |t: f64| (t / radius).clamp(-1.0, 1.0).asin();
                let (p, q) = (a - y0, b - y0);
                let flat = |t: f64| 0.5 * (t * root(t) + radius * radius * angle(t));
                let half_disc = self.side * (flat(q) - flat(p));
                let moment = self.side * (root(p).powi(3) - root(q).powi(3)) / 3.0;
                let width = b - a;
                let square = radius * radius * width - (q.powi(3) - p.powi(3)) / 3.0;
                [
                    z0 * width + half_disc,
                    z0 * 0.5 * (b * b - a * a) + y0 * half_disc + moment,
                    z0 * z0 * width + 2.0 * z0 * half_disc + square,
                    radius * (angle(q) - angle(p)),
                ]
            }
            Shape::Line { z } => [z * (b - a), 0.5 * z * (b * b - a * a), z * z * (b - a), b - a],
            Shape::Spiric(_) | Shape::Level(_) => {
                let turn = std::f64::consts::FRAC_PI_2;
                let whole = self.by_nodes([a, b], [-turn, turn]);
                self.quadrature([a, b], [-turn, turn], whole, DEPTH)
            }
        }
    }

    fn quadrature(&self, cell: [f64; 2], angles: [f64; 2], whole: [f64; 4], depth: u32) -> [f64; 4] {
        let middle = 0.5 * (angles[0] + angles[1]);
        let left = self.by_nodes(cell, [angles[0], middle]);
        let right = self.by_nodes(cell, [middle, angles[1]]);
        let both: [f64; 4] = std::array::from_fn(|k| left[k] + right[k]);
        let size = both[3].abs();
        let settled = (0..4).all(|k| (both[k] - whole[k]).abs() <= SETTLED * (both[k].abs() + size));
        if settled || depth == 0 {
            return both;
        }
        let left = self.quadrature(cell, [angles[0], middle], left, depth - 1);
        let right = self.quadrature(cell, [middle, angles[1]], right, depth - 1);
        std::array::from_fn(|k| left[k] + right[k])
    }

    /// A Gauss rule in the angle `t` of `y = middle + half sin t`.
    fn by_nodes(&self, [a, b]: [f64; 2], [from, to]: [f64; 2]) -> [f64; 4] {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let mut sums = [0.0; 4];
        for (angle, weight) in gauss(from, to) {
            let (y, dy) = (middle + half * angle.sin(), half * angle.cos() * weight);
            let z = self.at(y);
            let slope = self.slope(y);
            let length = if slope.is_finite() { (1.0 + slope * slope).sqrt() } else { 1.0 };
            for (sum, value) in sums.iter_mut().zip([z, y * z, z * z, length]) {
                *sum += value * dy;
            }
        }
        sums
    }

    /// Where two curves may meet, as values of `y`; a few too many, none too few.
    pub(super) fn meets(&self, other: &Self, size: f64) -> Vec<f64> {
        let (low, high) = (self.domain[0].max(other.domain[0]), self.domain[1].min(other.domain[1]));
        if low > high || self.shape == other.shape {
            return Vec::new();
        }
        if let (Some(a), Some(b)) = (self.shape.carrier(), other.shape.carrier()) {
            // Circles that touch do so to rounding.
            return match a.meet(&b, super::region::TOUCH * size) {
                Meeting::Same => Vec::new(),
                Meeting::Points(points) => points.iter().map(|point| point.x).collect(),
            };
        }
        let places = match (self.shape, other.shape) {
            (Shape::Spiric(curve) | Shape::Level(curve), rest) | (rest, Shape::Spiric(curve) | Shape::Level(curve)) => {
                curve.meets(&rest)
            }
            _ => return Vec::new(),
        };
        let apart = |y: f64| self.at(y) - other.at(y);
        let mut found: Vec<f64> =
            places.into_iter().filter_map(|y| nearest_root(apart, y, [low, high], size)).collect();
        let sample = |k: usize| low + (high - low) * k as f64 / SAMPLES as f64;
        for k in 0..SAMPLES {
            let (mut a, mut b) = (sample(k), sample(k + 1));
            let below = apart(a);
            if below == 0.0 || (below < 0.0) == (apart(b) < 0.0) {
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (a + b);
                if (apart(middle) < 0.0) == (below < 0.0) { a = middle } else { b = middle }
            }
            found.push(0.5 * (a + b));
        }
        found
    }

    /// The circle of an arc of it, run through from one `y` to another.
    pub(super) fn arc_circle(&self, from: f64, to: f64) -> Option<ArcCircle> {
        let Shape::Circle { center, radius } = self.shape else { return None };
        // Directions along the upper half run from pi down to 0 as y grows, along the lower half from -pi up to 0.
        let angle = |y: f64| self.side * ((y - center[0]) / radius).clamp(-1.0, 1.0).acos();
        Some(ArcCircle { center, radius, start_angle: angle(from), end_angle: angle(to) })
    }

    /// Values of `y` within a range at which `z` can be greatest or least, the ends included.
    pub(super) fn extremes(&self, [a, b]: [f64; 2]) -> Vec<f64> {
        let mut places = vec![a, b];
        match self.shape {
            Shape::Circle { center, .. } => places.push(center[0].clamp(a, b)),
            Shape::Line { .. } => {}
            Shape::Spiric(curve) | Shape::Level(curve) => {
                places.push(0.0_f64.clamp(a, b));
                // q' = 0
                let [[a0, a1], [b0, b1]] = curve.factors;
                let l = -(a0 * b1 + b0 * a1) / (2.0 * a1 * b1);
                let across = ((curve.link - l) * (curve.link + l)).max(0.0).sqrt();
                places.extend([across.clamp(a, b), (-across).clamp(a, b)]);
            }
        }
        places
    }
}

impl Shape {
    /// The whole circle or line.
    fn carrier(&self) -> Option<Carrier> {
        match *self {
            Self::Circle { center, radius } => Some(Carrier::Circle { center: center.into(), radius }),
            Self::Line { z } => Some(Carrier::Line { point: Vector2::new(0.0, z), direction: Vector2::x() }),
            Self::Spiric(_) | Self::Level(_) => None,
        }
    }
}

impl LinkCurve {
    /// `l` above a `y`.
    fn rest(&self, y: f64) -> f64 {
        ((self.link - y) * (self.link + y)).max(0.0).sqrt()
    }

    /// `q` above a `y`.
    fn square(&self, y: f64) -> f64 {
        let l = self.rest(y);
        let [[a0, a1], [b0, b1]] = self.factors;
        (a0 + a1 * l) * (b0 + b1 * l)
    }

    fn polynomial(&self) -> UPoly<f64> {
        let [a, b] = self.factors.map(|factor| UPoly::new(factor.to_vec()));
        a * b
    }

    /// Candidates for meeting another curve, as values of `y`.
    fn meets(&self, other: &Shape) -> Vec<f64> {
        let q = self.polynomial();
        let constant = |x: f64| UPoly::constant(x);
        let l = UPoly::<f64>::variable();
        let square = |p: &UPoly<f64>| p.clone() * p.clone();
        let link_square = self.link * self.link;
        // (z - e)² = p(l) for the other one, where it is of that kind.
        let second = match other {
            Shape::Line { z } => Some((*z, UPoly::zero())),
            Shape::Spiric(curve) | Shape::Level(curve) => Some((curve.height, curve.polynomial())),
            Shape::Circle { center, radius } if center[0] == 0.0 => {
                Some((center[1], square(&l) + constant((radius - self.link) * (radius + self.link))))
            }
            Shape::Circle { .. } => None,
        };
        let equation = match (second, other) {
            (Some((height, p)), _) => {
                let apart = height - self.height;
                let difference = q - p.clone();
                if apart == 0.0 {
                    difference
                } else {
                    let rest = difference - constant(apart * apart);
                    square(&rest) - p.scaled(&(4.0 * apart * apart))
                }
            }
            (None, Shape::Circle { center: [y0, z0], radius }) => {
                // K + 2 h side sqrt(q) = 2 y0 y, squared twice.
                let h = self.height - z0;
                let k = q.clone() - square(&l) + constant(link_square + y0 * y0 + h * h - radius * radius);
                let y_square = constant(link_square) - square(&l);
                let once = square(&k) + q.scaled(&(4.0 * h * h)) - y_square.scaled(&(4.0 * y0 * y0));
                square(&once) - (square(&k) * q).scaled(&(16.0 * h * h))
            }
            _ => UPoly::zero(),
        };
        let Ok(roots) = companion_roots_real(equation.coefficients()) else { return Vec::new() };
        let real = roots.finite.iter().filter(|root| root.im.abs() <= NEARLY_REAL * (1.0 + root.norm()));
        real.map(|root| root.re)
            .filter(|l| (-NEARLY_REAL * self.link..=(1.0 + NEARLY_REAL) * self.link).contains(l))
            .flat_map(|l| [1.0, -1.0].map(|side| side * ((self.link - l) * (self.link + l)).max(0.0).sqrt()))
            .collect()
    }
}

/// Secant steps from a place towards a root of a difference; `None` where it does not come near zero.
fn nearest_root(apart: impl Fn(f64) -> f64, start: f64, [low, high]: [f64; 2], size: f64) -> Option<f64> {
    let mut x = start.clamp(low, high);
    let mut value = apart(x);
    let mut step = 1e-6 * (high - low);
    if x + step > high {
        step = -step;
    }
    let (mut other, mut known) = (x + step, apart(x + step));
    for _ in 0..SECANTS {
        if value == known {
            break;
        }
        let next = (x - value * (x - other) / (value - known)).clamp(low, high);
        let there = apart(next);
        if there.abs() >= value.abs() {
            break;
        }
        (other, known, x, value) = (x, value, next, there);
    }
    (value.abs() <= MET * size).then_some(x)
}
