//! A guided coupler as data.

use nalgebra::Vector2;
use num_complex::Complex64;
use thiserror::Error;

use super::equation::{Biquadratic, SideNumbers, coupler_equation};
use crate::algebra::{Gaussian, Rational, dyadic};
use crate::solve::to_complex_together;

/// How one point of a coupler is guided. `arm` is that point seen from the curve's point, in the coupler's own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CouplerSide {
    /// On a circle: a crank.
    Circle {
        /// Its pivot.
        pivot: Vector2<f64>,
        /// Length of the crank, not negative.
        radius: f64,
        /// The guided point.
        arm: Vector2<f64>,
    },
    /// On a line: a slider.
    Line {
        /// A point of the line.
        point: Vector2<f64>,
        /// Its direction, not zero.
        direction: Vector2<f64>,
        /// The guided point.
        arm: Vector2<f64>,
    },
}

/// The curve of a point of a coupler that is guided in two others.
///
/// Can only be had validated: finite numbers, lengths not negative, directions not zero, two different guided points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplerCurve {
    pub(super) sides: [CouplerSide; 2],
}

/// Why a coupler draws no curve.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CouplerError {
    /// A number is NaN or infinite.
    #[error("side {side}: {field} {value} must be finite")]
    NotFinite {
        /// From 1.
        side: usize,
        /// Which number.
        field: &'static str,
        /// The number found.
        value: f64,
    },
    /// A crank has a negative length.
    #[error("side {side}: radius {value} must be ≥ 0")]
    NegativeRadius {
        /// From 1.
        side: usize,
        /// The number found.
        value: f64,
    },
    /// A line has no direction.
    #[error("side {side}: direction must not be [0, 0]")]
    NoDirection {
        /// From 1.
        side: usize,
    },
    /// Both sides guide the same point of the coupler, which turns freely about it.
    #[error("both sides guide the same point of the coupler: it turns freely about it")]
    OneJoint,
    /// Two sliders on parallel lines: the coupler keeps its rotation.
    #[error("both sides slide along parallel lines: the coupler cannot turn")]
    ParallelLines,
}

impl CouplerSide {
    pub(super) fn arm(&self) -> Complex64 {
        match self {
            Self::Circle { arm, .. } | Self::Line { arm, .. } => complex(arm),
        }
    }

    /// The side over a ring that embeds its numbers.
    pub(super) fn numbers<R>(&self, embed: impl Fn(f64) -> R) -> SideNumbers<R> {
        let point = |v: &Vector2<f64>| Gaussian::new(embed(v.x), embed(v.y));
        match self {
            Self::Circle { pivot, radius, arm } => {
                SideNumbers::Circle { a: point(pivot), p: point(arm), r: embed(*radius) }
            }
            Self::Line { point: on, direction, arm } => {
                let normal = Vector2::new(-direction.y, direction.x);
                SideNumbers::Line { a: point(on), n: point(&normal), p: point(arm) }
            }
        }
    }
}

pub(super) fn complex(v: &Vector2<f64>) -> Complex64 {
    Complex64::new(v.x, v.y)
}

impl CouplerCurve {
    /// A validated curve.
    ///
    /// **Units:** lengths in any one unit. **Errors:** see [`CouplerError`].
    ///
    /// ```
    /// use assur::linkage::{CouplerCurve, CouplerSide};
    /// use assur::nalgebra::Vector2;
    /// let crank = CouplerSide::Circle { pivot: Vector2::zeros(), radius: 1.0, arm: Vector2::zeros() };
    /// let slider = CouplerSide::Line { point: Vector2::zeros(), direction: Vector2::x(), arm: Vector2::new(3.0, 1.0) };
    /// assert!(CouplerCurve::new([crank, slider]).is_ok());
    /// assert!(CouplerCurve::new([crank, crank]).is_err());
    /// ```
    pub fn new(sides: [CouplerSide; 2]) -> Result<Self, CouplerError> {
        for (side, given) in (1..).zip(&sides) {
            let (at, other, name) = match given {
                CouplerSide::Circle { pivot, radius, .. } => (pivot, [*radius, 0.0], "radius"),
                CouplerSide::Line { point, direction, .. } => (point, [direction.x, direction.y], "direction"),
            };
            let arm = given.arm();
            let place = if name == "radius" { "pivot" } else { "point" };
            let numbers =
                [(place, at.x), (place, at.y), (name, other[0]), (name, other[1]), ("arm", arm.re), ("arm", arm.im)];
            if let Some(&(field, value)) = numbers.iter().find(|(_, value)| !value.is_finite()) {
                return Err(CouplerError::NotFinite { side, field, value });
            }
            match given {
                CouplerSide::Circle { radius, .. } if *radius < 0.0 => {
                    return Err(CouplerError::NegativeRadius { side, value: *radius });
                }
                CouplerSide::Line { direction, .. } if *direction == Vector2::zeros() => {
                    return Err(CouplerError::NoDirection { side });
                }
                _ => {}
            }
        }
        if sides[0].arm() == sides[1].arm() {
            return Err(CouplerError::OneJoint);
        }
        if let [CouplerSide::Line { direction: u, .. }, CouplerSide::Line { direction: v, .. }] = &sides {
            let exact = |x: f64| dyadic(x).expect("finite, as checked");
            if exact(u.x) * exact(v.y) == exact(u.y) * exact(v.x) {
                return Err(CouplerError::ParallelLines);
            }
        }
        Ok(Self { sides })
    }

    /// The curve of a four-bar: `|z - a + theta p| = r`, `|z - b + theta q| = s`.
    ///
    /// ```
    /// use assur::linkage::CouplerCurve;
    /// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[-1.0, -1.0], [2.0, -1.0]], [1.0, 2.5])?;
    /// assert_eq!(curve.circuits().len(), 2); // the crank of length 1 turns fully
    /// # Ok::<(), assur::linkage::CouplerError>(())
    /// ```
    pub fn four_bar(pivots: [[f64; 2]; 2], arms: [[f64; 2]; 2], radii: [f64; 2]) -> Result<Self, CouplerError> {
        let side = |k: usize| CouplerSide::Circle { pivot: pivots[k].into(), radius: radii[k], arm: arms[k].into() };
        Self::new([side(0), side(1)])
    }

    /// The two sides.
    pub fn sides(&self) -> &[CouplerSide; 2] {
        &self.sides
    }

    /// The equation over the rationals: exactly that of the `f64`s given.
    ///
    /// **Shape:** `[i][j]` belongs to `z^i w^j`; Hermitian. **Proof:** exact.
    ///
    /// ```
    /// use assur::algebra::{Domain, Gaussian, Rational, Ring};
    /// use assur::linkage::CouplerCurve;
    /// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[-1.0, -1.0], [2.0, -1.0]], [1.0, 2.5])?;
    /// let equation = curve.equation();
    /// // Tricircular: z^3 w^3 leads, and nothing of degree 6 stands beside it.
    /// assert_eq!(equation.0[3][3], Gaussian::from_int(9)); // |q - p|^2
    /// # Ok::<(), assur::linkage::CouplerError>(())
    /// ```
    pub fn equation(&self) -> Biquadratic<Gaussian<Rational>> {
        coupler_equation(&self.exact_sides())
    }

    /// The coefficients of the equation for reading: `[i][j]` of `z^i w^j`, the largest of modulus 1.
    pub fn scaled_coefficients(&self) -> [[Complex64; 4]; 4] {
        let entries: Vec<Gaussian<Rational>> = self.equation().0.into_iter().flatten().collect();
        let floats = to_complex_together(&entries);
        let largest = floats.iter().map(|c| c.norm()).fold(0.0, f64::max);
        let scale = if largest > 0.0 { 1.0 / largest } else { 0.0 };
        std::array::from_fn(|i| std::array::from_fn(|j| floats[4 * i + j] * scale))
    }

    pub(super) fn exact_sides(&self) -> [SideNumbers<Rational>; 2] {
        self.sides.each_ref().map(|side| side.numbers(|x| dyadic(x).expect("finite, as validated")))
    }

    pub(super) fn float_sides(&self) -> [SideNumbers<f64>; 2] {
        self.sides.each_ref().map(|side| side.numbers(|x| x))
    }

    /// A length to measure against: the largest of cranks, arms and the distance of the pivots.
    pub fn size(&self) -> f64 {
        let own = |side: &CouplerSide| match side {
            CouplerSide::Circle { radius, .. } => radius.max(side.arm().norm()),
            CouplerSide::Line { .. } => side.arm().norm(),
        };
        let between = match &self.sides {
            [CouplerSide::Circle { pivot: a, .. }, CouplerSide::Circle { pivot: b, .. }] => (a - b).norm(),
            _ => 0.0,
        };
        self.sides.iter().map(own).fold(between, f64::max).max((self.sides[0].arm() - self.sides[1].arm()).norm())
    }

    /// How far each guided point misses its circle or line, for a point of the curve and a rotation, in length units.
    pub(super) fn misses(&self, z: Complex64, theta: Complex64) -> f64 {
        let miss = |side: &CouplerSide| {
            let at = z + theta * side.arm();
            match side {
                CouplerSide::Circle { pivot, radius, .. } => ((at - complex(pivot)).norm() - radius).abs(),
                CouplerSide::Line { point, direction, .. } => {
                    ((at - complex(point)) * complex(direction).conj()).im.abs() / direction.norm()
                }
            }
        };
        miss(&self.sides[0]).max(miss(&self.sides[1]))
    }

    /// Roberts' other two four-bars that draw the same curve; `None` where a side slides or a link has no length.
    ///
    /// **Source:** Roberts (1875), Proc. London Math. Soc. 7, 14-23, doi:10.1112/plms/s1-7.1.14.
    ///
    /// ```
    /// use assur::linkage::CouplerCurve;
    /// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[-1.0, -1.0], [2.0, -1.0]], [1.0, 2.5])?;
    /// assert_eq!(curve.cognates().map(|others| others.len()), Some(2));
    /// # Ok::<(), assur::linkage::CouplerError>(())
    /// ```
    pub fn cognates(&self) -> Option<[Self; 2]> {
        let [CouplerSide::Circle { pivot: a, radius: r, arm: p }, CouplerSide::Circle { pivot: b, radius: s, arm: q }] =
            &self.sides
        else {
            return None;
        };
        let [_, _, focus] = self.foci()?;
        let (p, q) = (complex(p), complex(q));
        let base = q - p;
        let cognate = |pivot: &Vector2<f64>, turning: f64, arms: [Complex64; 2], radii: [f64; 2]| {
            let side = |pivot: Vector2<f64>, radius, arm: Complex64| CouplerSide::Circle {
                pivot,
                radius,
                arm: Vector2::new(arm.re, arm.im) * turning,
            };
            Self::new([side(*pivot, radii[0], arms[0]), side(focus, radii[1], arms[1])]).ok()
        };
        // z - a = r R1 - theta p and z - b = s R2 - theta q, R1 and R2 the cranks' rotations: each pair of the three rotations gives a
        // four-bar, with the third as its coupler's.
        let first = cognate(a, *r, [-Complex64::ONE, -q / base], [p.norm(), s * p.norm() / base.norm()])?;
        let second = cognate(b, *s, [-Complex64::ONE, p / base], [q.norm(), r * q.norm() / base.norm()])?;
        Some([first, second])
    }

    /// The three singular foci of a four-bar's curve: both pivots and the third of Roberts' cognates. `None` where a side slides.
    ///
    /// All real double points lie on the circle through them ([`CouplerCurve::circle_of_singular_foci`]).
    pub fn foci(&self) -> Option<[Vector2<f64>; 3]> {
        let [CouplerSide::Circle { pivot: a, .. }, CouplerSide::Circle { pivot: b, .. }] = &self.sides else {
            return None;
        };
        let [p, q] = [self.sides[0].arm(), self.sides[1].arm()];
        // The quotient is taken of the difference, so that pivots far from the origin lose nothing.
        let c = complex(a) - p * (complex(b) - complex(a)) / (q - p);
        Some([*a, *b, Vector2::new(c.re, c.im)])
    }

    /// Centre and radius of the circle through the three singular foci; `None` where they lie on a line or a side slides.
    pub fn circle_of_singular_foci(&self) -> Option<(Vector2<f64>, f64)> {
        let [a, b, c] = self.foci()?;
        let (u, v) = (b - a, c - a);
        let cross = 2.0 * (u.x * v.y - u.y * v.x);
        let offset = Vector2::new(
            v.y * u.norm_squared() - u.y * v.norm_squared(),
            u.x * v.norm_squared() - v.x * u.norm_squared(),
        ) / cross;
        offset.iter().all(|x| x.is_finite()).then(|| (a + offset, offset.norm()))
    }
}
