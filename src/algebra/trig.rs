//! Trigonometric polynomials: the ring `R[c, s] / (c² + s² - 1)`.
//!
//! A closed formula in `cos phi` and `sin phi`, run over this ring, yields its own expansion, exactly and
//! without the halves that Fourier coefficients bring. Every element is `A(c) + s·B(c)` in one way. From there
//! lead three charts: the value at an angle, the polynomial in the half-angle `t = tan(phi/2)`, and the
//! polynomial in `theta = e^(i phi)`, in which a half-turn is an ordinary point.

use std::ops::{Add, Mul, Neg, Sub};

use super::{Domain, Gaussian, Ring, UPoly};

/// A trigonometric polynomial `A(cos phi) + sin phi · B(cos phi)`.
///
/// ```
/// use assur::algebra::{Integer, Ring, Trig};
/// let (c, s) = (Trig::<Integer>::cosine(), Trig::<Integer>::sine());
/// assert_eq!(c.clone() * c + s.clone() * s, Trig::one());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Trig<R> {
    even: UPoly<R>,
    odd: UPoly<R>,
}

impl<R: Ring> Trig<R> {
    /// A constant.
    pub fn constant(value: R) -> Self {
        Self { even: UPoly::constant(value), odd: UPoly::zero() }
    }

    /// `cos phi`.
    pub fn cosine() -> Self {
        Self { even: UPoly::variable(), odd: UPoly::zero() }
    }

    /// `sin phi`.
    pub fn sine() -> Self {
        Self { even: UPoly::zero(), odd: UPoly::one() }
    }

    /// Whether this is zero for every angle.
    pub fn vanishes(&self) -> bool {
        self.even.vanishes() && self.odd.vanishes()
    }

    /// The order: the largest `k` for which `cos(k phi)` or `sin(k phi)` occurs; 0 for constants and zero.
    ///
    /// ```
    /// use assur::algebra::{Integer, Ring, Trig};
    /// assert_eq!((Trig::<Integer>::cosine() * Trig::sine()).order(), 2);
    /// ```
    pub fn order(&self) -> usize {
        let even = self.even.degree().unwrap_or(0);
        let odd = self.odd.degree().map_or(0, |d| d + 1);
        // c^k and s·c^(k-1) both carry the order k, and never cancel: they belong to cos and to sin.
        even.max(odd)
    }

    /// The value at an angle given by its cosine and sine, in any ring.
    pub fn evaluate<S: Ring>(&self, embed: impl Fn(&R) -> S, cosine: &S, sine: &S) -> S {
        let horner =
            |p: &UPoly<R>| p.coefficients().iter().rev().fold(S::zero(), |sum, c| sum * cosine.clone() + embed(c));
        horner(&self.even) + sine.clone() * horner(&self.odd)
    }

    /// The derivative by the angle.
    pub fn derivative(&self) -> Self {
        // (A + sB)' = -s·A' + c·B - s²·B'
        let (a, b) = (self.even.derivative(), self.odd.derivative());
        let one_minus_c2 = UPoly::new(vec![R::one(), R::zero(), -R::one()]);
        Self { even: self.odd.shifted(1) - one_minus_c2 * b, odd: -a }
    }

    /// `(1 + t²)^order · T` with `cos = (1-t²)/(1+t²)`, `sin = 2t/(1+t²)`: a polynomial in `t = tan(phi/2)` of formal degree `2·order`.
    ///
    /// `order` is at least [`Trig::order`]. Degrees missing at the top are roots at `phi = pi`.
    pub fn half_angle(&self, order: usize) -> UPoly<R> {
        self.half_angle_about(order, 0)
    }

    /// The half-angle polynomial in another chart: `t = tan((phi - phi0)/2)` with `tan(phi0/2) = tau`.
    ///
    /// Up to the factor `(1 + tau²)^order`. Degrees missing at the top are roots at `phi0 + pi`, so one chart or another has none.
    pub fn half_angle_about(&self, order: usize, tau: i64) -> UPoly<R> {
        let linear = |a: i64, b: i64| UPoly::new(vec![R::from_int(a), R::from_int(b)]);
        // tan(phi/2) = n/d
        let (n, d) = (linear(tau, 1), linear(1, -tau));
        let (n2, d2) = (n.power(2), d.power(2));
        let s = UPoly::from_int(2) * n * d;
        self.homogeneous(order, &(d2.clone() - n2.clone()), &s, &(d2 + n2), |x| UPoly::constant(x.clone()))
    }

    /// `(2 theta)^order · T` with `cos = (theta + 1/theta)/2`, `sin = (theta - 1/theta)/(2i)`: a polynomial in `theta` of formal
    /// degree `2·order`, over the complex numbers of the ring.
    pub fn theta(&self, order: usize) -> UPoly<Gaussian<R>> {
        let g = |re, im| Gaussian::new(R::from_int(re), R::from_int(im));
        let c = UPoly::new(vec![g(1, 0), g(0, 0), g(1, 0)]);
        let s = UPoly::new(vec![g(0, 1), g(0, 0), g(0, -1)]);
        let w = UPoly::new(vec![g(0, 0), g(2, 0)]);
        self.homogeneous(order, &c, &s, &w, |x| UPoly::constant(Gaussian::real(x.clone())))
    }

    /// `w^order · T(c/w, s/w)` in any ring: the value at a cosine and a sine given as fractions, without dividing.
    ///
    /// `order` is at least [`Trig::order`].
    ///
    /// ```
    /// use assur::algebra::{Integer, Ring, Trig};
    /// // 3 cos phi + 1 at the angle of the 3-4-5 triangle is 14/5.
    /// let t = Trig::from_int(3) * Trig::cosine() + Trig::<Integer>::one();
    /// let [c, s, w] = [3, 4, 5].map(Integer::from);
    /// assert_eq!(t.homogeneous(1, &c, &s, &w, Clone::clone), Integer::from(14));
    /// ```
    pub fn homogeneous<S: Ring>(&self, order: usize, c: &S, s: &S, w: &S, embed: impl Fn(&R) -> S) -> S {
        let form = |p: &UPoly<R>, degree: usize| {
            let mut sum = S::zero();
            let mut w_power = w.power((degree + 1 - p.coefficients().len()) as u32);
            for (k, x) in p.coefficients().iter().enumerate().rev() {
                sum = sum + embed(x) * c.power(k as u32) * w_power.clone();
                w_power = w_power * w.clone();
            }
            sum
        };
        let even = form(&self.even, order);
        if self.odd.vanishes() { even } else { even + s.clone() * form(&self.odd, order - 1) }
    }

    /// The trigonometric polynomial over another ring.
    pub fn map<S: Ring>(&self, f: impl Fn(&R) -> S) -> Trig<S> {
        Trig { even: self.even.map(&f), odd: self.odd.map(&f) }
    }

    /// All coefficients, those of `1, c, c², …` before those of `s, s·c, …`.
    pub fn coefficients(&self) -> impl Iterator<Item = &R> {
        self.even.coefficients().iter().chain(self.odd.coefficients())
    }
}

impl<R: Domain> Trig<R> {
    /// The trigonometric polynomial whose polynomial in `theta` (see [`Trig::theta`]) is `polynomial`, up to a real factor.
    ///
    /// `polynomial` has formal degree `2·order`; `None` where it is not self-conjugate (`c_(2K-k) = conj c_k`), that is, where
    /// `theta^(-K)·polynomial` is not real on the unit circle.
    pub fn from_theta(polynomial: &UPoly<Gaussian<R>>, order: usize) -> Option<Self> {
        if polynomial.degree().is_some_and(|d| d > 2 * order) {
            return None;
        }
        // theta^k + theta^-k = 2 cos(k phi) and i(theta^-k - theta^k) = 2 sin(k phi), by the recurrences of Chebyshev.
        let mut sum = Self::constant(polynomial.coefficient(order).re);
        if !polynomial.coefficient(order).im.is_zero() {
            return None;
        }
        let c = Self::cosine();
        let two = Self::from_int(2);
        let (mut cos_before, mut cos) = (Self::one(), c.clone());
        let (mut sin_before, mut sin) = (Self::zero(), Self::sine());
        for k in 1..=order {
            let upper = polynomial.coefficient(order + k);
            if polynomial.coefficient(order - k) != upper.conj() {
                return None;
            }
            let real = Self::constant(upper.re) * cos.clone() - Self::constant(upper.im) * sin.clone();
            sum = sum + two.clone() * real;
            (cos_before, cos) = (cos.clone(), two.clone() * c.clone() * cos - cos_before);
            (sin_before, sin) = (sin.clone(), two.clone() * c.clone() * sin - sin_before);
        }
        Some(sum)
    }
}

impl<R: Ring> Add for Trig<R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { even: self.even + other.even, odd: self.odd + other.odd }
    }
}

impl<R: Ring> Sub for Trig<R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { even: self.even - other.even, odd: self.odd - other.odd }
    }
}

impl<R: Ring> Mul for Trig<R> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // s² = 1 - c²
        let odd_odd = self.odd.clone() * other.odd.clone();
        Self {
            even: self.even.clone() * other.even.clone() + odd_odd.clone() - odd_odd.shifted(2),
            odd: self.even * other.odd + self.odd * other.even,
        }
    }
}

impl<R: Ring> Neg for Trig<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { even: -self.even, odd: -self.odd }
    }
}

impl<R: Ring> Ring for Trig<R> {
    fn from_int(n: i64) -> Self {
        Self::constant(R::from_int(n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Integer;

    /// 3 - 2c + 5sc² + 7s, of order 3.
    fn sample() -> Trig<Integer> {
        let n = |x: i64| Trig::constant(Integer::from(x));
        let (c, s) = (Trig::cosine(), Trig::sine());
        n(3) - n(2) * c.clone() + n(5) * s.clone() * c.clone() * c + n(7) * s
    }

    fn at(t: &Trig<Integer>, phi: f64) -> f64 {
        t.evaluate(|c| c.to_f64().value(), &phi.cos(), &phi.sin())
    }

    #[test]
    fn the_three_charts_agree() {
        let f = sample();
        let order = f.order();
        assert_eq!(order, 3);
        let (t_chart, theta_chart) = (f.half_angle(order), f.theta(order));
        for k in -7..8 {
            let phi = 0.4 * f64::from(k);
            let t = (phi / 2.0).tan();
            let in_t = t_chart.map(|c| c.to_f64().value()).evaluate(&t) / (1.0 + t * t).powi(3);
            let theta = Gaussian::new(phi.cos(), phi.sin());
            let in_theta = theta_chart.map(|c| c.map(|x| x.to_f64().value())).evaluate(&theta);
            let in_theta = in_theta * theta.conj().power(3) * Gaussian::real(0.125);
            let direct = 3.0 - 2.0 * phi.cos() + 5.0 * phi.sin() * phi.cos().powi(2) + 7.0 * phi.sin();
            assert!((at(&f, phi) - direct).abs() < 1e-13);
            assert!((in_t - direct).abs() < 1e-11, "{in_t} {direct}");
            assert!((in_theta.re - direct).abs() < 1e-13 && in_theta.im.abs() < 1e-13);
        }
    }

    #[test]
    fn theta_chart_leads_back() {
        let f = sample();
        let eight = Trig::from_int(8);
        assert_eq!(Trig::from_theta(&f.theta(3), 3), Some(f.clone() * eight));
        let turned = f.theta(3).scaled(&Gaussian::new(0, 1).map(|&n| Integer::from(n)));
        assert_eq!(Trig::from_theta(&turned, 3), None);
    }

    #[test]
    fn derivative_agrees_with_a_difference() {
        let f = sample();
        for k in 0..6 {
            let phi = 0.9 * f64::from(k);
            let difference = (at(&f, phi + 1e-6) - at(&f, phi - 1e-6)) / 2e-6;
            assert!((at(&f.derivative(), phi) - difference).abs() < 1e-8);
        }
    }

    #[test]
    fn products_with_wider_order_hold_the_extra_factor() {
        let f = sample();
        let w = UPoly::new([1, 0, 1].map(Integer::from).to_vec());
        assert_eq!(f.half_angle(4), f.half_angle(3) * w);
    }
}
