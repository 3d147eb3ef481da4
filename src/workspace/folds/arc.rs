//! Coupler arcs as pieces of boundary.

use nalgebra::Vector2;

use super::super::boundary::ArcIntegrals;
use super::super::limits::Limit;
use super::coupled::{Branch, Coupled, EDGE};
use crate::plane::gauss;

type Point = Vector2<f64>;

/// A piece of a coupler curve: the places of `C` where two limits of different legs are met at once.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplerArc {
    /// The two limits held.
    pub pair: [Limit; 2],
    /// Which of the two places at an orientation: +1 or -1; of two circles the one to the left of the way from the first centre to the second, of a circle and a line the one ahead along the line.
    pub sigma: f64,
    /// Orientation at the start, radians.
    pub phi_start: f64,
    /// Orientation at the end, radians.
    pub phi_end: f64,
    curve: Coupled,
    branch: Branch,
    /// Parameters at both ends: near a turning point of the orientation they keep the digits that it loses.
    from: f64,
    to: f64,
}

/// Halves of an arc must agree with the whole to this share of its square (area) for it to count: some ten roundings.
const AGREE: f64 = 4e-15;
/// Arcs are halved at most so often: each time the distance to a singularity of the parameter doubles in proportion.
const DEPTH: usize = 24;

impl CouplerArc {
    pub(super) fn new(pair: [Limit; 2], curve: Coupled, branch: Branch, [from, to]: [f64; 2]) -> Self {
        let sigma = if branch.sigma { 1.0 } else { -1.0 };
        let (phi_start, phi_end) = (curve.phi(branch, from), curve.phi(branch, to));
        Self { pair, sigma, phi_start, phi_end, curve, branch, from, to }
    }

    /// The arc carried along with the base frame, in which its limits are these.
    pub(in super::super) fn moved(&self, by: Point, own: &dyn Fn(&Limit) -> Limit) -> Self {
        Self { pair: self.pair.each_ref().map(own), curve: self.curve.moved(by), ..self.clone() }
    }

    fn parameter(&self, part: f64) -> f64 {
        self.from + part * (self.to - self.from)
    }

    /// Point and derivative by the part of the arc, from 0 to 1.
    pub(in super::super) fn at(&self, part: f64) -> (Point, Point) {
        let spot = self.curve.at(self.branch, self.parameter(part));
        (spot.place.c, spot.velocity * (self.to - self.from))
    }

    /// The place at a part of the arc, from 0 to 1.
    pub fn point_at(&self, part: f64) -> [f64; 2] {
        self.at(part).0.into()
    }

    /// The orientation at a part of the arc, from 0 to 1; radians.
    pub fn phi_at(&self, part: f64) -> f64 {
        self.curve.phi(self.branch, self.parameter(part))
    }

    /// `n` points along it (at least 2), the ends included.
    pub(in super::super) fn points(&self, n: usize) -> Vec<[f64; 2]> {
        let steps = n.max(2) - 1;
        (0..=steps).map(|k| self.at(k as f64 / steps as f64).0.into()).collect()
    }

    /// Its integrals about an origin, by Gauss-Legendre quadrature on pieces until halves agree with wholes.
    pub(in super::super) fn integrals(&self, origin: Point) -> ArcIntegrals {
        let whole = self.gauss(0.0, 1.0, origin);
        let scale = whole.length * whole.length + (self.at(0.5).0 - origin).norm() * whole.length;
        self.adapt([0.0, 1.0], whole, origin, scale, DEPTH)
    }

    fn adapt(
        &self,
        [from, to]: [f64; 2],
        whole: ArcIntegrals,
        origin: Point,
        scale: f64,
        depth: usize,
    ) -> ArcIntegrals {
        let middle = 0.5 * (from + to);
        let (a, b) = (self.gauss(from, middle, origin), self.gauss(middle, to, origin));
        let sum = plus(&a, &b);
        let size = scale.sqrt();
        let off = (sum.area - whole.area).abs().max(size * (sum.length - whole.length).abs());
        if depth == 0 || off <= AGREE * scale {
            return sum;
        }
        plus(
            &self.adapt([from, middle], a, origin, scale, depth - 1),
            &self.adapt([middle, to], b, origin, scale, depth - 1),
        )
    }

    fn gauss(&self, from: f64, to: f64, origin: Point) -> ArcIntegrals {
        let mut out = ArcIntegrals::default();
        for (part, w) in gauss(from, to) {
            let (at, velocity) = self.at(part);
            let p = at - origin;
            // Of the fan of triangles from the origin, as for lines and circles: only so do the shares of different arcs add up.
            let fan = w * p.perp(&velocity);
            out.area += 0.5 * fan;
            out.moment[0] += p.x * fan / 3.0;
            out.moment[1] += p.y * fan / 3.0;
            out.length += w * velocity.norm();
        }
        out
    }

    /// The rectangle around it.
    pub(in super::super) fn bbox(&self) -> [f64; 4] {
        let (start, end) = (self.at(0.0).0, self.at(1.0).0);
        let (mut low, mut high) = (start.inf(&end), start.sup(&end));
        for axis in 0..2 {
            // Between samples the coordinate turns where its derivative changes sign.
            const SAMPLES: usize = 24;
            let speed = |part: f64| self.at(part.clamp(EDGE, 1.0 - EDGE)).1[axis];
            let part = |k: usize| k as f64 / SAMPLES as f64;
            for k in 0..SAMPLES {
                let (mut a, mut b) = (part(k), part(k + 1));
                let rising = speed(a) > 0.0;
                if (speed(b) > 0.0) == rising {
                    continue;
                }
                // The extreme is flat: half the digits of the place are all those of the coordinate.
                for _ in 0..30 {
                    let middle = 0.5 * (a + b);
                    if (speed(middle) > 0.0) == rising { a = middle } else { b = middle }
                }
                let at = self.at(0.5 * (a + b)).0;
                (low, high) = (low.inf(&at), high.sup(&at));
            }
        }
        [low.x, low.y, high.x, high.y]
    }

    /// Unit vectors along it at its start and its end.
    pub(in super::super) fn tangents(&self) -> [[f64; 2]; 2] {
        [0.0, 1.0].map(|part| {
            let velocity = self.at(self.inner(part)).1;
            velocity.try_normalize(0.0).unwrap_or_else(|| (self.at(1.0).0 - self.at(0.0).0).normalize()).into()
        })
    }

    /// Curvature at its start and its end, by differences of the tangent; positive where it bends to the left.
    pub(in super::super) fn curvatures(&self) -> [f64; 2] {
        /// Step as a part of the arc: its square against roundings over it.
        const STEP: f64 = 1e-5;
        [0.0, 1.0].map(|part| {
            let near = self.inner(part);
            let next = if part == 0.0 { near + STEP } else { near - STEP };
            let ((p, dp), (q, dq)) = (self.at(near), self.at(next));
            let turned = dp.perp(&dq).atan2(dp.dot(&dq));
            let length = (q - p).norm();
            if length > 0.0 { turned / length * if part == 0.0 { 1.0 } else { -1.0 } } else { 0.0 }
        })
    }

    /// A part of the arc whose parameter is not a turning point itself.
    fn inner(&self, part: f64) -> f64 {
        let t = self.parameter(part);
        if t > EDGE && t < 1.0 - EDGE {
            return part;
        }
        let inside = EDGE / (self.to - self.from).abs().max(EDGE);
        if part == 0.0 { inside.min(0.5) } else { 1.0 - inside.min(0.5) }
    }
}

fn plus(a: &ArcIntegrals, b: &ArcIntegrals) -> ArcIntegrals {
    ArcIntegrals {
        area: a.area + b.area,
        moment: [a.moment[0] + b.moment[0], a.moment[1] + b.moment[1]],
        length: a.length + b.length,
    }
}
