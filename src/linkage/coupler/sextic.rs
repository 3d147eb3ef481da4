//! Double points of a coupler curve: crunodes, acnodes and cusps.
//!
//! Above a double point lie two rotations, so both sides give the same quadratic in `theta`: `D = 0` and `N = 0`
//! (see `equation.rs`). On `D = 0` one isotropic coordinate is a linear fraction of the other; put into N that leaves a cubic for a
//! four-bar, a quadratic for a slider-crank. The two rotations tell the kinds apart: both real at a crunode, where the curve crosses
//! itself; a conjugate pair at an acnode, an isolated point; one double at a cusp.

use nalgebra::Vector2;
use num_complex::Complex64;

use super::curve::{CouplerCurve, CouplerSide, complex};
use super::equation::{Biquadratic, parts, quadratic};
use crate::algebra::Gaussian;
use crate::roots::companion_roots;

/// What a real double point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DoublePointKind {
    /// The curve crosses itself.
    Crunode,
    /// An isolated point.
    Acnode,
    /// A point where the curve turns back.
    Cusp,
    /// A double point that is not real.
    Complex,
}

impl DoublePointKind {
    /// The name that reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Crunode => "crunode",
            Self::Acnode => "acnode",
            Self::Cusp => "cusp",
            Self::Complex => "complex",
        }
    }
}

/// A double point of a coupler curve.
#[derive(Clone, Debug, PartialEq)]
pub struct DoublePoint {
    /// `x + iy`.
    pub z: Complex64,
    /// `x - iy`, the conjugate of `z` where the point is real.
    pub w: Complex64,
    /// The coupler's two rotations `e^(i phi)` there.
    pub thetas: [Complex64; 2],
    /// What it is.
    pub kind: DoublePointKind,
}

impl DoublePoint {
    /// The point, where it is real.
    pub fn point(&self) -> Option<Vector2<f64>> {
        (self.kind != DoublePointKind::Complex).then(|| Vector2::new(self.z.re, self.z.im))
    }
}

/// A double point counts as real, and a pair of rotations as one, up to this (heuristic: what a nearly double root of the cubic keeps).
const NEARLY: f64 = 1e-7;

/// Coefficients as complex numbers.
pub(super) fn to_complex(form: &Biquadratic<Gaussian<f64>>) -> Biquadratic<Complex64> {
    Biquadratic(form.0.each_ref().map(|row| row.each_ref().map(|c| Complex64::new(c.re, c.im))))
}

impl CouplerCurve {
    /// The finite double points of the curve, real ones first: three for a four-bar, two for a slider-crank, none for an ellipse.
    ///
    /// `None` where every point is double, since the curve's point is a guided one or the linkage degenerates. **Accuracy:** some 1e-12 of
    /// the size where they lie apart, half the digits where they meet; the kind of a point that is nearly a cusp is decided numerically.
    ///
    /// ```
    /// use assur::linkage::CouplerCurve;
    /// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[-1.0, -1.0], [2.0, -1.0]], [1.0, 2.5])?;
    /// let points = curve.double_points().expect("no guided point");
    /// assert_eq!(points.len(), 3);
    /// let (centre, radius) = curve.circle_of_singular_foci().expect("not on a line");
    /// assert!(points.iter().filter_map(|p| p.point()).all(|p| ((p - centre).norm() - radius).abs() < 1e-9));
    /// # Ok::<(), assur::linkage::CouplerError>(())
    /// ```
    pub fn double_points(&self) -> Option<Vec<DoublePoint>> {
        let (near, shift, size) = self.normal();
        let sides = near.float_sides();
        let parts = parts(&sides);
        let [n, d] = [&parts.numerator, &parts.divisor].map(to_complex);
        let [first, second] = sides.each_ref().map(|side| quadratic(side).map(|form| to_complex(&form)));
        // w = numerator / denominator on D = 0, both linear in z.
        let over = [-d.0[0][0], -d.0[1][0]];
        let under = [d.0[0][1], d.0[1][1]];
        let mut cubic = [Complex64::ZERO; 4];
        for i in 0..3 {
            for k in 0..2 {
                cubic[i + k] += n.0[i][0] * under[k] + n.0[i][1] * over[k];
            }
        }
        if over[1] == Complex64::ZERO && under == [Complex64::ZERO; 2] {
            // D is a constant: zero, or never zero.
            return (over[0] != Complex64::ZERO).then(Vec::new);
        }
        let roots = companion_roots(&cubic).ok()?;
        let mut found: Vec<DoublePoint> = Vec::new();
        for z in roots.finite {
            let w = (over[0] + over[1] * z) / (under[0] + under[1] * z);
            if !w.is_finite() {
                continue;
            }
            let real = (w - z.conj()).norm() < NEARLY * (1.0 + z.norm());
            let (z, w) = if real { ((z + w.conj()) / 2.0, (z.conj() + w) / 2.0) } else { (z, w) };
            // The better conditioned of two proportional quadratics.
            let values = [&first, &second].map(|side| side.each_ref().map(|form| form.at(&z, &w)));
            let size_of = |q: &[Complex64; 3]| q.iter().map(|c| c.norm()).fold(0.0, f64::max);
            let [a, b, c] = if size_of(&values[0]) >= size_of(&values[1]) { values[0] } else { values[1] };
            let root = (b * b - a * c * 4.0).sqrt();
            // The larger sum first, so that nothing cancels.
            let sum = if (b + root).norm() >= (b - root).norm() { -(b + root) } else { -(b - root) };
            let thetas = [sum / (a * 2.0), c * 2.0 / sum];
            if thetas.iter().any(|theta| !theta.is_finite()) {
                continue;
            }
            let kind = if !real {
                DoublePointKind::Complex
            } else if (thetas[0] - thetas[1]).norm() < NEARLY.sqrt() * thetas[0].norm() {
                DoublePointKind::Cusp
            } else if thetas.iter().all(|theta| (theta.norm() - 1.0).abs() < NEARLY) {
                DoublePointKind::Crunode
            } else {
                DoublePointKind::Acnode
            };
            found.push(DoublePoint { z: z * size + shift, w: w * size + shift.conj(), thetas, kind });
        }
        let key = |p: &DoublePoint| (p.kind == DoublePointKind::Complex, p.z.re, p.z.im);
        found.sort_by(|p, q| {
            let (p, q) = (key(p), key(q));
            p.0.cmp(&q.0).then(p.1.total_cmp(&q.1)).then(p.2.total_cmp(&q.2))
        });
        Some(found)
    }

    /// The same curve near the origin and of size one: `z_here = shift + size * z_there`. Rounds; for floating point only.
    pub(super) fn normal(&self) -> (Self, Complex64, f64) {
        let shift = match &self.sides[0] {
            CouplerSide::Circle { pivot, .. } => complex(pivot),
            CouplerSide::Line { point, .. } => complex(point),
        };
        // A power of two: scaling is then exact.
        let size = self.size().max(f64::MIN_POSITIVE).log2().ceil().clamp(-500.0, 500.0).exp2();
        (self.moved(shift, size), shift, size)
    }

    /// The curve in coordinates `(z - shift) / size`.
    pub(super) fn moved(&self, shift: Complex64, size: f64) -> Self {
        let shift = Vector2::new(shift.re, shift.im);
        let sides = self.sides.each_ref().map(|side| match *side {
            CouplerSide::Circle { pivot, radius, arm } => {
                CouplerSide::Circle { pivot: (pivot - shift) / size, radius: radius / size, arm: arm / size }
            }
            CouplerSide::Line { point, direction, arm } => CouplerSide::Line {
                point: (point - shift) / size,
                // The equation is homogeneous in the normal; unit length keeps its coefficients even.
                direction: direction.normalize(),
                arm: arm / size,
            },
        });
        Self { sides }
    }
}
