//! Every intersection of a coupler curve with a line, a circle or another coupler curve.
//!
//! A line or a circle makes the equation a polynomial in one parameter (`cross.rs`). Two four-bars together are
//! a truss of three loops whose one rotation is hidden in a Dixon pencil of size 20; where solutions are missing, and for sliders, the 6x6
//! Sylvester matrix as a matrix polynomial of degree 3 is the second opinion. Whatever its origin, each solution is refined on the
//! equations of the guided points themselves, in z, w and the rotations (`search.rs`), never on an expanded equation. How many there have
//! to be is counted exactly (`count.rs`); common foci send intersections to infinity.

use nalgebra::Vector2;
use num_complex::Complex64;

use super::count::{finite_intersections, finite_on_circle, finite_on_line};
use super::cross::{circle_starts, circle_starts_exactly, line_starts, line_starts_exactly};
use super::curve::{CouplerCurve, CouplerSide};
use super::equation::SideNumbers;
use super::search::{Hidden, Search};
use crate::algebra::{Gaussian, Ring};
use crate::linkage::loops::Route;
use crate::solve::Account;

/// What a coupler curve is to meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Partner {
    /// A line.
    Line {
        /// A point of it.
        point: Vector2<f64>,
        /// Its direction, not zero.
        direction: Vector2<f64>,
    },
    /// A circle.
    Circle {
        /// Its centre.
        center: Vector2<f64>,
        /// Its radius, positive.
        radius: f64,
    },
    /// Another coupler curve.
    Coupler(CouplerCurve),
}

/// A point that both curves share, with the linkages' poses there.
#[derive(Clone, Debug, PartialEq)]
pub struct Intersection {
    /// `x + iy`.
    pub z: Complex64,
    /// `x - iy`; the conjugate of `z` where the intersection is real.
    pub w: Complex64,
    /// The rotation `e^(i phi)` of each coupler: one, or two where the partner is a coupler curve.
    pub thetas: Vec<Complex64>,
    /// Whether point and poses are real.
    pub real: bool,
    /// How many intersections meet here, as far as the eigenvalues told.
    pub multiplicity: usize,
    /// Real: the largest miss of a guided point over the size. Complex: the largest residual of an equation over its terms.
    pub residual: f64,
}

impl Intersection {
    /// The point, where it is real.
    pub fn point(&self) -> Option<Vector2<f64>> {
        self.real.then(|| Vector2::new(self.z.re, self.z.im))
    }
}

/// All intersections, with the account that shows the list complete.
#[derive(Clone, Debug, PartialEq)]
pub struct Intersections {
    /// The intersections: real ones first, each kind by `x`, then `y`.
    pub list: Vec<Intersection>,
    /// Where each went: `degree` counts those of two general curves of these kinds, *at infinity* those that common foci and other special
    /// dimensions take there, exactly counted; *self_motion* is the degree where the curves have a piece in common, and nothing is listed then;
    /// *undecided* those that were not found.
    pub account: Account,
}

impl CouplerCurve {
    /// Every intersection with a line, a circle or another coupler curve, real and complex.
    ///
    /// **Accuracy:** simple ones to some 1e-13 of the size; numerical, not proved, but held against an exact count. `None` for a direction
    /// that is zero, a radius that is not positive or numbers that are not finite. **Cost:** see benches/README.md.
    ///
    /// ```
    /// use assur::linkage::{CouplerCurve, Partner};
    /// use assur::nalgebra::Vector2;
    /// let curve = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[-1.0, -1.0], [2.0, -1.0]], [1.0, 2.5])?;
    /// let circle = |center: [f64; 2]| Partner::Circle { center: center.into(), radius: 1.5 };
    /// let account = |partner| curve.meet(&partner).map(|found| found.account);
    /// assert_eq!(account(circle([1.0, 1.0])).map(|a| (a.real + a.complex, a.at_infinity)), Some((6, 0)));
    /// // About a focus two of the six go to infinity.
    /// assert_eq!(account(circle([4.0, 0.0])).map(|a| (a.real + a.complex, a.at_infinity)), Some((4, 2)));
    /// # Ok::<(), assur::linkage::CouplerError>(())
    /// ```
    pub fn meet(&self, partner: &Partner) -> Option<Intersections> {
        match partner {
            Partner::Line { point, direction } => {
                let sound = [*point, *direction].iter().all(|v| v.iter().all(|x| x.is_finite()));
                (sound && *direction != Vector2::zeros()).then(|| self.meet_line(point, direction))
            }
            Partner::Circle { center, radius } => {
                let sound = center.iter().all(|x| x.is_finite()) && radius.is_finite() && *radius > 0.0;
                sound.then(|| self.meet_circle(center, *radius))
            }
            Partner::Coupler(other) => Some(self.meet_coupler(other)),
        }
    }

    fn cranks(&self) -> usize {
        self.sides.iter().filter(|side| matches!(side, CouplerSide::Circle { .. })).count()
    }

    fn meet_line(&self, point: &Vector2<f64>, direction: &Vector2<f64>) -> Intersections {
        let degree = [2, 4, 6][self.cranks()];
        let Some(finite) = finite_on_line(self, point, direction) else { return one_piece(degree) };
        let a = Gaussian::new(point.x, point.y);
        let n = Gaussian::new(-direction.y, direction.x);
        let search = Search::new(vec![*self], Some(SideNumbers::Line { a, n, p: Gaussian::zero() }));
        let exactly = || line_starts_exactly(self, point, direction);
        search.cross(|search| line_starts(search, point, direction), exactly, finite).finish(degree, finite)
    }

    fn meet_circle(&self, center: &Vector2<f64>, radius: f64) -> Intersections {
        let degree = [4, 6, 6][self.cranks()];
        let Some(finite) = finite_on_circle(self, center, radius) else { return one_piece(degree) };
        let a = Gaussian::new(center.x, center.y);
        let search = Search::new(vec![*self], Some(SideNumbers::Circle { a, p: Gaussian::zero(), r: radius }));
        let exactly = || circle_starts_exactly(self, center, radius);
        search.cross(|search| circle_starts(search, center, radius), exactly, finite).finish(degree, finite)
    }

    fn meet_coupler(&self, other: &Self) -> Intersections {
        let four_bars = self.cranks() == 2 && other.cranks() == 2;
        // Two general curves of these kinds, so that special dimensions show in the account.
        let degree = if four_bars { 18 } else { general_count(self, other) };
        let Some(finite) = finite_intersections(self, other) else { return one_piece(degree) };
        let mut search = Search::new(vec![*self, *other], None);
        if four_bars {
            for route in [Route::UnitCircle, Route::Qz] {
                if search.count() < finite {
                    let lifted = search.dixon(route);
                    search.add(&lifted);
                }
            }
        }
        for hidden in [Hidden::W, Hidden::Z] {
            if search.count() < finite {
                let lifted = search.sylvester(hidden);
                search.add(&lifted);
            }
        }
        search.finish(degree, finite)
    }
}

/// How many intersections two curves of these kinds have in general.
fn general_count(one: &CouplerCurve, other: &CouplerCurve) -> usize {
    let member = |curve: &CouplerCurve, k: f64| {
        let side = |side: &CouplerSide, j: f64| match side {
            CouplerSide::Circle { .. } => CouplerSide::Circle {
                pivot: Vector2::new(0.3 * k + 1.7 * j, 1.1 - 0.9 * k * j),
                radius: 2.3 + 0.7 * k + 0.31 * j,
                arm: Vector2::new(1.9 * j - 0.4, 0.8 * k + 1.3 * j * j),
            },
            CouplerSide::Line { .. } => CouplerSide::Line {
                point: Vector2::new(0.21 * k - 1.3 * j, 0.6 + 0.37 * k * j),
                direction: Vector2::new(1.0 + 0.3 * j * k, 0.45 * k - 1.7 * j),
                arm: Vector2::new(0.7 * j - 1.1 * k, 0.5 * k + 2.1 * j),
            },
        };
        CouplerCurve { sides: [side(&curve.sides[0], 1.0), side(&curve.sides[1], -0.8)] }
    };
    finite_intersections(&member(one, 1.0), &member(other, 1.9)).unwrap_or(0)
}

fn one_piece(degree: usize) -> Intersections {
    Intersections { list: Vec::new(), account: Account { degree, self_motion: degree, ..Account::default() } }
}
