//! The equation of a coupler curve, written once for every ring.
//!
//! In isotropic coordinates `z = x + iy`, `w = x - iy` (`'` conjugates), with `theta` the coupler's rotation, each side is a quadratic
//! `A theta^2 + B theta + C = 0`:
//!
//! ```text
//! circle |z - a + theta p| = r:             A = p (w - a'),  B = (z - a)(w - a') + p p' - r^2,  C = p' (z - a)
//! line   n.(z - a + theta p) = 0, n normal: A = n' p,        B = n' (z - a) + n (w - a'),       C = n p'
//! ```
//!
//! Both sides share a root where their resultant vanishes: `F(z, w) = D^2 + N N*`, with `D = A1 C2 - A2 C1`, `N = C1 B2 - C2 B1`,
//! `N* = A1 B2 - A2 B1`, and there `theta = N / D`. For two circles F has degree 3 in z and in w; its 4x4 coefficients are
//! Hermitian. `cargo run --release --example coupler_sextic` works this out.

use crate::algebra::{Gaussian, Ring};

/// One side of a coupler in the numbers of a ring.
#[derive(Clone, Debug, PartialEq)]
pub enum SideNumbers<R> {
    /// The point `z + theta p` keeps the distance `r` to `a`.
    Circle {
        /// Centre.
        a: Gaussian<R>,
        /// The guided point, from the curve's point, in the coupler's frame.
        p: Gaussian<R>,
        /// Radius.
        r: R,
    },
    /// The point `z + theta p` stays on the line through `a` with the normal `n`.
    Line {
        /// A point of the line.
        a: Gaussian<R>,
        /// Its normal, of any length.
        n: Gaussian<R>,
        /// The guided point, from the curve's point, in the coupler's frame.
        p: Gaussian<R>,
    },
}

/// A polynomial of degree 3 at most in `z` and in `w`: entry `[i][j]` belongs to `z^i w^j`.
#[derive(Clone, Debug, PartialEq)]
pub struct Biquadratic<K>(
    /// The coefficients.
    pub [[K; 4]; 4],
);

impl<K: Ring> Biquadratic<K> {
    fn zero() -> Self {
        Self(std::array::from_fn(|_| std::array::from_fn(|_| K::zero())))
    }

    /// `constant + of_z z + of_w w + of_zw z w`.
    fn bilinear(constant: K, of_z: K, of_w: K, of_zw: K) -> Self {
        let mut form = Self::zero();
        form.0[0][0] = constant;
        form.0[1][0] = of_z;
        form.0[0][1] = of_w;
        form.0[1][1] = of_zw;
        form
    }

    fn add(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|j| self.0[i][j].clone() + other.0[i][j].clone())))
    }

    fn sub(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|j| self.0[i][j].clone() - other.0[i][j].clone())))
    }

    /// The product; what exceeds degree 3 is zero for the products taken here.
    fn mul(&self, other: &Self) -> Self {
        let zero = K::zero();
        let mut product = Self::zero();
        for (i, row) in self.0.iter().enumerate() {
            for (j, a) in row.iter().enumerate().filter(|(_, a)| **a != zero) {
                for (k, row) in other.0.iter().enumerate() {
                    for (l, b) in row.iter().enumerate().filter(|(_, b)| **b != zero) {
                        if i + k < 4 && j + l < 4 {
                            let sum = product.0[i + k][j + l].clone() + a.clone() * b.clone();
                            product.0[i + k][j + l] = sum;
                        }
                    }
                }
            }
        }
        product
    }

    /// The value at `(z, w)`.
    pub fn at(&self, z: &K, w: &K) -> K {
        let row = |row: &[K; 4]| row.iter().rev().fold(K::zero(), |sum, c| sum * w.clone() + c.clone());
        self.0.iter().rev().fold(K::zero(), |sum, r| sum * z.clone() + row(r))
    }
}

/// The parts of a coupler curve's equation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Parts<K> {
    /// `theta = numerator / divisor` on the curve.
    pub(super) numerator: Biquadratic<K>,
    pub(super) divisor: Biquadratic<K>,
    pub(super) equation: Biquadratic<K>,
}

/// `A`, `B`, `C` of a side.
pub(super) fn quadratic<R: Ring>(side: &SideNumbers<R>) -> [Biquadratic<Gaussian<R>>; 3] {
    let o = Gaussian::<R>::zero;
    match side {
        SideNumbers::Circle { a, p, r } => {
            let constant = Gaussian::real(a.norm_sqr() + p.norm_sqr() - r.clone() * r.clone());
            [
                Biquadratic::bilinear(-(p.clone() * a.conj()), o(), p.clone(), o()),
                Biquadratic::bilinear(constant, -a.conj(), -a.clone(), Gaussian::one()),
                Biquadratic::bilinear(-(p.conj() * a.clone()), p.conj(), o(), o()),
            ]
        }
        SideNumbers::Line { a, n, p } => {
            let product = n.conj() * a.clone();
            let constant = -(product.clone() + product.conj());
            [
                Biquadratic::bilinear(n.conj() * p.clone(), o(), o(), o()),
                Biquadratic::bilinear(constant, n.conj(), n.clone(), o()),
                Biquadratic::bilinear(n.clone() * p.conj(), o(), o(), o()),
            ]
        }
    }
}

pub(super) fn parts<R: Ring>(sides: &[SideNumbers<R>; 2]) -> Parts<Gaussian<R>> {
    let [[a1, b1, c1], [a2, b2, c2]] = [quadratic(&sides[0]), quadratic(&sides[1])];
    let divisor = a1.mul(&c2).sub(&a2.mul(&c1));
    let numerator = c1.mul(&b2).sub(&c2.mul(&b1));
    let mirrored = a1.mul(&b2).sub(&a2.mul(&b1));
    let equation = divisor.mul(&divisor).add(&numerator.mul(&mirrored));
    Parts { numerator, divisor, equation }
}

/// The coefficients `[i][j]` of `z^i w^j` in the equation of a coupler curve: exact over exact rings, Hermitian always.
///
/// ```
/// use assur::{algebra::{Gaussian, Integer, Ring}, linkage::{SideNumbers, coupler_equation}};
/// let g = |re: i64, im: i64| Gaussian::new(Integer::from(re), Integer::from(im));
/// let side = |a, p, r: i64| SideNumbers::Circle { a, p, r: Integer::from(r) };
/// // A rhombus of side 5 whose coupler point is a joint: it stays on the circle about the first pivot.
/// let equation = coupler_equation(&[side(g(0, 0), g(0, 0), 5), side(g(5, 0), g(5, 0), 5)]);
/// assert_eq!(equation.at(&g(3, 4), &g(3, -4)), g(0, 0));
/// assert_eq!(equation.0[3][1], equation.0[1][3].conj());
/// ```
pub fn coupler_equation<R: Ring>(sides: &[SideNumbers<R>; 2]) -> Biquadratic<Gaussian<R>> {
    parts(sides).equation
}
