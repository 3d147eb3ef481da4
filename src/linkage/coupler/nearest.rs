//! Where on its curve a linkage stands that was moved a little: the circuit and the parameter nearest to a place of its coupler.

use std::f64::consts::TAU;

use nalgebra::Vector2;
use num_complex::Complex64;

use super::curve::CouplerCurve;

/// Places looked at on each circuit; between them the curve is close to its tangent.
const SAMPLES: usize = 720;
/// Golden-section steps between neighbours of the best: the last decides about digits that rounding leaves.
const STEPS: usize = 40;

impl CouplerCurve {
    /// The circuit, from 0 in [`CouplerCurve::circuits`], and the parameter of [`CouplerCurve::trace`] whose coupler is nearest to a point and to the rotation
    /// with this cosine and sine; `None` where there is no circuit.
    ///
    /// **Accuracy**: the nearest of 720 places on each circuit, refined to rounding; distances are weighed as the point's over the size plus the chord of the rotation.
    ///
    /// ```
    /// use assur::CouplerCurve;
    /// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[-1.0, -1.0], [2.0, -1.0]], [1.0, 2.5])?;
    /// let (point, theta) = curve.trace(&curve.circuits()[1], 2.0).expect("no dead point");
    /// let (circuit, tau) = curve.nearest(&point, theta.re, theta.im).expect("has circuits");
    /// assert!(circuit == 1 && (tau - 2.0).abs() < 1e-6);
    /// # Ok::<(), assur::CouplerError>(())
    /// ```
    pub fn nearest(&self, point: &Vector2<f64>, cos: f64, sin: f64) -> Option<(usize, f64)> {
        let (circuits, size, wanted) = (self.circuits(), self.size(), Complex64::new(cos, sin));
        let distance = |circuit: usize, tau: f64| {
            let found = self.trace(&circuits[circuit], tau);
            found.map_or(f64::INFINITY, |(p, theta)| (p - point).norm() / size + (theta - wanted).norm())
        };
        let step = TAU / SAMPLES as f64;
        let places = (0..circuits.len()).flat_map(|circuit| (0..SAMPLES).map(move |k| (circuit, k as f64 * step)));
        let valued = places.map(|(circuit, tau)| (circuit, tau, distance(circuit, tau)));
        let (circuit, tau, _) = valued.min_by(|p, q| p.2.total_cmp(&q.2))?;
        let ratio = (5f64.sqrt() - 1.0) / 2.0;
        let (mut low, mut high) = (tau - step, tau + step);
        for _ in 0..STEPS {
            let (left, right) = (high - ratio * (high - low), low + ratio * (high - low));
            if distance(circuit, left) < distance(circuit, right) { high = right } else { low = left }
        }
        Some((circuit, ((low + high) / 2.0).rem_euclid(TAU)))
    }
}
