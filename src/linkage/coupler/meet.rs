//! Every intersection of a coupler curve with a line, a circle or another coupler curve.
//!
//! A line or a circle makes the equation a polynomial in one parameter, exact and of degree 6 for a four-bar. Two four-bars together are
//! a truss of three loops whose one rotation is hidden in a Dixon pencil of size 20; where solutions are missing, and for sliders, the 6x6
//! Sylvester matrix as a matrix polynomial of degree 3 is the second opinion. Whatever its origin, each solution is refined on the
//! equations of the guided points themselves, in z, w and the rotations, never on an expanded equation. How many there have to be is counted exactly
//! (`count.rs`); common foci send intersections to infinity.

use nalgebra::Vector2;
use num_complex::Complex64;

use super::count::finite_intersections;
use super::curve::{CouplerCurve, CouplerSide, complex};
use super::equation::{Biquadratic, SideNumbers, coupler_equation, quadratic};
use super::sextic::to_complex;
use crate::algebra::{Gaussian, Rational, Ring, dyadic};
use crate::eliminate::DixonPencil;
use crate::linkage::pivoting::solve;
use crate::roots::{companion_roots, pencil_eigenpairs};
use crate::solve::{Account, to_complex_together};

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

/// Larger residuals of a lift belong to no solution (heuristic, as for trusses).
const PLAUSIBLE: f64 = 1e-3;
/// Residual of a solution.
const CLOSED: f64 = 1e-11;
/// Solutions closer than this are one; where the Jacobian has lost a rank, than the other.
const SAME: f64 = 1e-7;
const SAME_SINGULAR: f64 = 1e-4;
/// A pivot below this part of the largest counts as zero (heuristic, as for trusses).
const RANK: f64 = 1e-6;
/// Largest miss of a guided point, over the size, of a real intersection.
const REAL_MISS: f64 = 1e-9;

impl CouplerCurve {
    /// Every intersection with a line, a circle or another coupler curve, real and complex.
    ///
    /// **Accuracy:** simple ones to some 1e-13 of the size; numerical, not proved, but held against an exact count. `None` for a direction
    /// that is zero, a radius that is not positive or numbers that are not finite. **Cost:** 2.5 ms for line and circle, whose polynomial
    /// is expanded over the rationals; 0.7 ms for another four-bar.
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
        let equation = self.equation();
        let [p, u] = [point, direction].map(exact);
        // z = p + u t, w = p' + u' t.
        let mut sum = vec![Gaussian::zero(); 7];
        let (powers_z, powers_w) = (powers([p.clone(), u.clone()]), powers([p.conj(), u.conj()]));
        for (row, z) in equation.0.iter().zip(&powers_z) {
            for (c, w) in row.iter().zip(&powers_w) {
                add_product(&mut sum, c, z, w, 0);
            }
        }
        let degree = [2, 4, 6][self.cranks()];
        let Some(top) = sum.iter().rposition(|c| *c != Gaussian::zero()) else { return one_piece(degree) };
        let (p, u) = (complex(point), complex(direction));
        let roots = roots_of(&sum[..=top]);
        let starts = roots.iter().map(|t| (p + u * t, p.conj() + u.conj() * t));
        let n = Gaussian::new(-direction.y, direction.x);
        let a = Gaussian::new(point.x, point.y);
        self.meet_simple(starts.collect(), &SideNumbers::Line { a, n, p: Gaussian::zero() }, degree, top)
    }

    fn meet_circle(&self, center: &Vector2<f64>, radius: f64) -> Intersections {
        let equation = self.equation();
        let (o, rho) = (exact(center), Gaussian::real(dyadic(radius).expect("finite, as checked")));
        // z = o + rho tau, w = o' + rho / tau; times tau^3.
        let mut sum = vec![Gaussian::zero(); 7];
        let (powers_z, powers_w) = (powers([o.clone(), rho.clone()]), powers([rho, o.conj()]));
        for (row, z) in equation.0.iter().zip(&powers_z) {
            for (j, (c, w)) in row.iter().zip(&powers_w).enumerate() {
                add_product(&mut sum, c, z, w, 3 - j);
            }
        }
        let degree = [4, 6, 6][self.cranks()];
        let nonzero = |c: &Gaussian<Rational>| *c != Gaussian::zero();
        let (Some(low), Some(high)) = (sum.iter().position(nonzero), sum.iter().rposition(nonzero)) else {
            return one_piece(degree);
        };
        let o = complex(center);
        let roots = roots_of(&sum[low..=high]);
        let starts = roots.iter().map(|tau| (o + tau * radius, o.conj() + radius / tau));
        let a = Gaussian::new(center.x, center.y);
        self.meet_simple(
            starts.collect(),
            &SideNumbers::Circle { a, p: Gaussian::zero(), r: radius },
            degree,
            high - low,
        )
    }

    /// Refines approximate intersections with a line or circle.
    fn meet_simple(
        &self,
        starts: Vec<(Complex64, Complex64)>,
        partner: &SideNumbers<f64>,
        degree: usize,
        finite: usize,
    ) -> Intersections {
        let mut search = Search::new(vec![*self], Some(partner.clone()));
        let lifted = starts.iter().flat_map(|&(z, w)| search.poses(z, w)).collect();
        search.add(lifted);
        search.finish(degree, finite)
    }

    fn meet_coupler(&self, other: &Self) -> Intersections {
        let four_bars = self.cranks() == 2 && other.cranks() == 2;
        // Two general curves of these kinds, so that special dimensions show in the account.
        let degree = if four_bars { 18 } else { general_count(self, other) };
        let Some(finite) = finite_intersections(self, other) else { return one_piece(degree) };
        let mut search = Search::new(vec![*self, *other], None);
        if four_bars {
            let lifted = search.dixon();
            search.add(lifted);
        }
        for hidden in [Hidden::W, Hidden::Z] {
            if search.count() < finite {
                let lifted = search.sylvester(hidden);
                search.add(lifted);
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

fn exact(v: &Vector2<f64>) -> Gaussian<Rational> {
    Gaussian::new(v.x, v.y).map(|&x| dyadic(x).expect("finite, as checked"))
}

/// The powers 0 to 3 of `constant + linear t`, as ascending coefficients.
fn powers([constant, linear]: [Gaussian<Rational>; 2]) -> [Vec<Gaussian<Rational>>; 4] {
    let mut power = vec![Gaussian::one()];
    std::array::from_fn(|k| {
        if k > 0 {
            let mut next = vec![Gaussian::zero(); power.len() + 1];
            for (i, c) in power.iter().enumerate() {
                next[i] = next[i].clone() + c.clone() * constant.clone();
                next[i + 1] = next[i + 1].clone() + c.clone() * linear.clone();
            }
            power = next;
        }
        power.clone()
    })
}

fn add_product(
    sum: &mut [Gaussian<Rational>],
    c: &Gaussian<Rational>,
    z: &[Gaussian<Rational>],
    w: &[Gaussian<Rational>],
    shift: usize,
) {
    if *c == Gaussian::zero() {
        return;
    }
    for (i, a) in z.iter().enumerate() {
        for (j, b) in w.iter().enumerate() {
            let place = &mut sum[i + j + shift];
            *place = place.clone() + c.clone() * a.clone() * b.clone();
        }
    }
}

fn roots_of(coefficients: &[Gaussian<Rational>]) -> Vec<Complex64> {
    companion_roots(&to_complex_together(coefficients)).map_or(Vec::new(), |roots| roots.finite)
}

fn one_piece(degree: usize) -> Intersections {
    Intersections { list: Vec::new(), account: Account { degree, self_motion: degree, ..Account::default() } }
}

/// Which coordinate the Sylvester matrix eliminates; its pencil's eigenvalue is the other.
#[derive(Clone, Copy, PartialEq)]
enum Hidden {
    Z,
    W,
}

/// One equation of a search, and the unknown rotation in it.
struct Equation {
    side: SideNumbers<f64>,
    rotation: Option<usize>,
}

struct Solution {
    unknowns: Vec<Complex64>,
    residual: f64,
    regular: bool,
    real: bool,
    multiplicity: usize,
}

/// Solutions in z, w and the couplers' rotations, near the origin and of size one.
struct Search {
    curves: Vec<CouplerCurve>,
    given: Vec<CouplerCurve>,
    equations: Vec<Equation>,
    shift: Complex64,
    size: f64,
    found: Vec<Solution>,
}

impl Search {
    fn new(given: Vec<CouplerCurve>, partner: Option<SideNumbers<f64>>) -> Self {
        let (_, shift, size) = given[0].normal();
        let curves: Vec<CouplerCurve> = given.iter().map(|curve| curve.moved(shift, size)).collect();
        let mut equations: Vec<Equation> = Vec::new();
        for (rotation, curve) in curves.iter().enumerate() {
            equations.extend(curve.float_sides().map(|side| Equation { side, rotation: Some(rotation) }));
        }
        let moved = |z: Gaussian<f64>| Gaussian::new((z.re - shift.re) / size, (z.im - shift.im) / size);
        equations.extend(partner.map(|partner| {
            let side = match partner {
                SideNumbers::Circle { a, p, r } => SideNumbers::Circle { a: moved(a), p, r: r / size },
                SideNumbers::Line { a, n, p } => {
                    let length = n.re.hypot(n.im);
                    SideNumbers::Line { a: moved(a), n: n.map(|x| x / length), p }
                }
            };
            Equation { side, rotation: None }
        }));
        Self { curves, given, equations, shift, size, found: Vec::new() }
    }

    fn count(&self) -> usize {
        self.found.iter().map(|solution| solution.multiplicity).sum()
    }

    /// Starting points above a point that lies on every curve, in given coordinates: all rotations that fit.
    fn poses(&self, z: Complex64, w: Complex64) -> Vec<Vec<Complex64>> {
        self.poses_near((z - self.shift) / self.size, (w - self.shift.conj()) / self.size)
    }

    fn poses_near(&self, z: Complex64, w: Complex64) -> Vec<Vec<Complex64>> {
        let mut starts = vec![vec![z, w]];
        for curve in &self.curves {
            let thetas = rotations(curve, z, w);
            starts = starts
                .iter()
                .flat_map(|start| thetas.iter().map(|&theta| start.iter().copied().chain([theta]).collect()))
                .collect();
        }
        starts
    }

    /// Lifts of the Dixon pencil of two four-bars: loops `a - b + r R1 - s R2 + theta (q - p) = 0` of either, and one through the
    /// common point; the first coupler's rotation is hidden.
    fn dixon(&self) -> Vec<Vec<Complex64>> {
        let numbers = |curve: &CouplerCurve| {
            curve.sides.map(|side| match side {
                CouplerSide::Circle { pivot, radius, arm } => (complex(&pivot), Complex64::from(radius), complex(&arm)),
                CouplerSide::Line { point, arm, .. } => (complex(&point), Complex64::ZERO, complex(&arm)),
            })
        };
        let [[(a, r, p), (b, s, q)], [(c, t, u), (d, v, x)]] = [numbers(&self.curves[0]), numbers(&self.curves[1])];
        let o = Complex64::ZERO;
        // Columns: 1, theta1, R1, R2, R3, R4, theta2.
        let upper =
            [vec![a - b, q - p, r, -s, o, o, o], vec![c - d, o, o, o, t, -v, x - u], vec![a - c, -p, r, o, -t, o, u]];
        let lower = upper.each_ref().map(|row| row.iter().map(Complex64::conj).collect::<Vec<_>>());
        let pencil = DixonPencil::new(&upper, &lower).expect("three equations of seven coefficients");
        let Ok(eigen) = pencil_eigenpairs(pencil.constant(), pencil.linear()) else { return Vec::new() };
        let lift = |pair: &crate::roots::Eigenpair| {
            let theta = pair.value()?;
            let others = pencil.unknowns(&pair.vector)?;
            let z = a + r * others[0] - theta * p;
            let w = a.conj() + r / others[0] - p.conj() / theta;
            Some(vec![z, w, theta, others[4]])
        };
        eigen.pairs.iter().filter_map(lift).collect()
    }

    /// Lifts of the Sylvester matrix of both equations as a matrix polynomial, linearised.
    fn sylvester(&self, hidden: Hidden) -> Vec<Vec<Complex64>> {
        let [f, g] = [0, 1].map(|k: usize| {
            let form: Biquadratic<Complex64> = to_complex(&coupler_equation(&self.curves[k].float_sides()));
            // [k][j]: k the power of the eigenvalue, j that of the coordinate eliminated.
            move |k: usize, j: usize| if hidden == Hidden::W { form.0[k][j] } else { form.0[j][k] }
        });
        let degree = |form: &dyn Fn(usize, usize) -> Complex64| {
            (0..4).rev().find(|&j| (0..4).any(|k| form(k, j) != Complex64::ZERO)).unwrap_or(0)
        };
        let (m, n) = (degree(&f), degree(&g));
        let block = m + n;
        if m == 0 || n == 0 {
            return Vec::new();
        }
        let coefficient = |power: usize, row: usize, column: usize| {
            let (form, shift, top): (&dyn Fn(usize, usize) -> Complex64, usize, usize) =
                if row < n { (&f, row, m) } else { (&g, row - n, n) };
            if (shift..=shift + top).contains(&column) { form(power, column - shift) } else { Complex64::ZERO }
        };
        let size = 3 * block;
        let mut constant = vec![vec![Complex64::ZERO; size]; size];
        let mut linear = constant.clone();
        for row in 0..block {
            for column in 0..block {
                for power in 0..3 {
                    constant[row][power * block + column] = coefficient(power, row, column);
                }
                linear[row][2 * block + column] = coefficient(3, row, column);
            }
            for power in 0..2 {
                // x v_power - v_(power+1) = 0
                linear[block * (power + 1) + row][power * block + row] = Complex64::ONE;
                constant[block * (power + 1) + row][(power + 1) * block + row] = -Complex64::ONE;
            }
        }
        let Ok(eigen) = pencil_eigenpairs(&constant, &linear) else { return Vec::new() };
        let mut starts = Vec::new();
        for pair in &eigen.pairs {
            if pair.beta.norm() < 1e-12 * pair.alpha.norm() {
                continue;
            }
            let x = pair.alpha / pair.beta;
            // A vector of powers 1, y, y^2, ...: the quotient of two neighbours of which one is largest.
            let part = if x.norm() > 1.0 { &pair.vector[2 * block..] } else { &pair.vector[..block] };
            let largest = (0..block).max_by(|&i, &j| part[i].norm_sqr().total_cmp(&part[j].norm_sqr())).unwrap_or(0);
            let y = if largest > 0 { part[largest] / part[largest - 1] } else { part[1] / part[0] };
            if !y.is_finite() {
                continue;
            }
            let (z, w) = if hidden == Hidden::W { (x, y) } else { (y, x) };
            starts.extend(self.poses_near(z, w));
        }
        starts
    }

    /// Refines starting points and takes in what closes, with its mirrored partner.
    fn add(&mut self, starts: Vec<Vec<Complex64>>) {
        let mut tally: Vec<(usize, usize)> = Vec::new();
        for start in starts {
            let Some(refined) = self.refine(&start) else { continue };
            let singular = !refined.regular;
            let place = match self.place_of(&refined) {
                Some(place) => place,
                None => self.take(refined),
            };
            if singular {
                match tally.iter_mut().find(|(known, _)| *known == place) {
                    Some((_, times)) => *times += 1,
                    None => tally.push((place, 1)),
                }
            }
        }
        for (place, times) in tally {
            let multiplicity = &mut self.found[place].multiplicity;
            *multiplicity = times.max(*multiplicity);
        }
    }

    fn place_of(&self, refined: &Solution) -> Option<usize> {
        self.found.iter().position(|known| {
            let same = if refined.regular && known.regular { SAME } else { SAME_SINGULAR };
            apart(&known.unknowns, &refined.unknowns) < same
        })
    }

    fn take(&mut self, refined: Solution) -> usize {
        let place = self.found.len();
        let mirrored = mirror(&refined.unknowns);
        let same = if refined.regular { SAME } else { SAME_SINGULAR };
        if apart(&mirrored, &refined.unknowns) < same {
            // Halfway to the mirrored one is real; the rotations are brought onto the unit circle.
            let mut real: Vec<Complex64> = refined.unknowns.iter().zip(&mirrored).map(|(a, b)| (a + b) / 2.0).collect();
            real[1] = real[0].conj();
            real[2..].iter_mut().for_each(|theta| *theta /= theta.norm());
            let miss = (self.curves.iter().zip(&real[2..]))
                .map(|(curve, &theta)| curve.misses(real[0], theta))
                .fold(0.0, f64::max);
            if miss < REAL_MISS {
                self.found.push(Solution { unknowns: real, real: true, ..refined });
                return place;
            }
        }
        let residual = self.residual(&mirrored);
        let partner = Solution { unknowns: mirrored, residual, regular: refined.regular, real: false, multiplicity: 1 };
        self.found.extend([refined, partner]);
        place
    }

    fn residual(&self, unknowns: &[Complex64]) -> f64 {
        let worst = self.equations.iter().map(|equation| {
            let value = Value::at(equation, unknowns);
            if value.size > 0.0 { value.value.norm() / value.size } else { 0.0 }
        });
        let worst = worst.fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a });
        if worst.is_nan() { f64::INFINITY } else { worst }
    }

    /// Newton's method: absolute steps in z and w, relative ones in the rotations.
    fn refine(&self, start: &[Complex64]) -> Option<Solution> {
        const MOST_STEPS: usize = 20;
        const LONGEST_STEP: f64 = 0.5;
        let size = self.equations.len();
        let mut unknowns = start.to_vec();
        let mut residual = self.residual(&unknowns);
        if residual > PLAUSIBLE {
            return None;
        }
        let mut regular = true;
        for _ in 0..MOST_STEPS {
            let mut matrix = vec![Complex64::ZERO; size * size];
            let mut right = vec![Complex64::ZERO; size];
            for (row, equation) in self.equations.iter().enumerate() {
                let value = Value::at(equation, &unknowns);
                let scale = if value.size > 0.0 { 1.0 / value.size } else { 1.0 };
                matrix[row * size] = value.by_z * scale;
                matrix[row * size + 1] = value.by_w * scale;
                if let Some(rotation) = equation.rotation {
                    matrix[row * size + 2 + rotation] = value.by_theta * scale;
                }
                right[row] = -value.value * scale;
            }
            let step = solve(&mut matrix, &mut right, size, RANK)?;
            regular = step.kernel.is_none();
            let turn = step.solution[2..].iter().map(|d| d.norm()).fold(0.0, f64::max);
            let held = if turn > LONGEST_STEP { LONGEST_STEP / turn } else { 1.0 };
            let mut next = unknowns.clone();
            for (k, delta) in step.solution.iter().enumerate() {
                next[k] = if k < 2 { next[k] + delta * held } else { next[k] * (1.0 + delta * held) };
            }
            let after = self.residual(&next);
            if residual < CLOSED && after >= residual {
                break;
            }
            if !after.is_finite() {
                return None;
            }
            (unknowns, residual) = (next, after);
        }
        let closed = residual < CLOSED && unknowns.iter().all(|x| x.is_finite());
        closed.then_some(Solution { unknowns, residual, regular, real: false, multiplicity: 1 })
    }

    fn finish(self, degree: usize, finite: usize) -> Intersections {
        let Self { found, given, shift, size, .. } = self;
        let scale = given.iter().map(CouplerCurve::size).fold(0.0, f64::max);
        let of = |solution: Solution| {
            let (z, w) = (solution.unknowns[0] * size + shift, solution.unknowns[1] * size + shift.conj());
            let thetas = solution.unknowns[2..].to_vec();
            // Measured on the linkages as given.
            let miss = || given.iter().zip(&thetas).map(|(curve, &theta)| curve.misses(z, theta)).fold(0.0, f64::max);
            let residual = if solution.real { miss() / scale } else { solution.residual };
            Intersection { z, w, thetas, real: solution.real, multiplicity: solution.multiplicity, residual }
        };
        let mut list: Vec<Intersection> = found.into_iter().map(of).collect();
        list.sort_by(|a, b| b.real.cmp(&a.real).then(a.z.re.total_cmp(&b.z.re)).then(a.z.im.total_cmp(&b.z.im)));
        let counted = |real: bool| list.iter().filter(|i| i.real == real).map(|i| i.multiplicity).sum::<usize>();
        let (real, complex) = (counted(true), counted(false));
        let account = Account {
            degree,
            real,
            complex,
            at_infinity: degree.saturating_sub(finite),
            undecided: finite.saturating_sub(real + complex),
            ..Account::default()
        };
        Intersections { list, account }
    }
}

/// `(w', z', 1 / theta')`: a solution too, since the numbers of the curves are real.
fn mirror(unknowns: &[Complex64]) -> Vec<Complex64> {
    let mut mirrored = vec![unknowns[1].conj(), unknowns[0].conj()];
    mirrored.extend(unknowns[2..].iter().map(|theta| theta.conj().inv()));
    mirrored
}

/// Differences of z and w in units of the size or of themselves, whichever is larger, and relative ones of the rotations.
fn apart(a: &[Complex64], b: &[Complex64]) -> f64 {
    let difference = |(k, (x, y)): (usize, (&Complex64, &Complex64))| {
        let size = x.norm().max(y.norm());
        (x - y).norm() / if k < 2 { size.max(1.0) } else { size }
    };
    a.iter().zip(b).enumerate().map(difference).fold(0.0, f64::max)
}

/// The rotations with which a coupler passes through a point of its curve: one, or two at a double point.
fn rotations(curve: &CouplerCurve, z: Complex64, w: Complex64) -> Vec<Complex64> {
    let sides = curve.float_sides();
    let mut values = sides.each_ref().map(|side| quadratic(side).map(|form| to_complex(&form).at(&z, &w)));
    let weight = |q: &[Complex64; 3]| q.iter().map(|c| c.norm()).fold(0.0, f64::max);
    if weight(&values[0]) < weight(&values[1]) {
        values.swap(0, 1);
    }
    let [[a, b, c], other] = values;
    let root = (b * b - a * c * 4.0).sqrt();
    let sum = if (b + root).norm() >= (b - root).norm() { -(b + root) } else { -(b - root) };
    let miss = |theta: &Complex64| {
        let terms = [other[0] * theta * theta, other[1] * theta, other[2]];
        let size: f64 = terms.iter().map(|t| t.norm()).sum();
        if size > 0.0 { terms.iter().sum::<Complex64>().norm() / size } else { 0.0 }
    };
    let mut found: Vec<Complex64> = [sum / (a * 2.0), c * 2.0 / sum]
        .into_iter()
        .filter(|theta| theta.is_finite() && *theta != Complex64::ZERO)
        .collect();
    found.sort_by(|x, y| miss(x).total_cmp(&miss(y)));
    let fitting = found.iter().filter(|theta| miss(theta) < PLAUSIBLE).count().max(1);
    found.truncate(fitting);
    found
}

/// An equation's value, the sum of the sizes of its terms, and its derivatives; that by theta is relative.
struct Value {
    value: Complex64,
    size: f64,
    by_z: Complex64,
    by_w: Complex64,
    by_theta: Complex64,
}

impl Value {
    fn at(equation: &Equation, unknowns: &[Complex64]) -> Self {
        let (z, w) = (unknowns[0], unknowns[1]);
        let theta = equation.rotation.map_or(Complex64::ONE, |rotation| unknowns[2 + rotation]);
        let as_complex = |g: &Gaussian<f64>| Complex64::new(g.re, g.im);
        let offsets = |a: Complex64, p: Complex64| {
            let (u, v) = (z - a + theta * p, w - a.conj() + p.conj() / theta);
            let sizes = (z.norm() + a.norm() + (theta * p).norm(), w.norm() + a.norm() + (p / theta).norm());
            (u, v, sizes)
        };
        match &equation.side {
            SideNumbers::Circle { a, p, r } => {
                let p = as_complex(p);
                let (u, v, sizes) = offsets(as_complex(a), p);
                Self {
                    value: u * v - r * r,
                    size: sizes.0 * sizes.1 + r * r,
                    by_z: v,
                    by_w: u,
                    by_theta: theta * p * v - u * p.conj() / theta,
                }
            }
            SideNumbers::Line { a, n, p } => {
                let (p, n) = (as_complex(p), as_complex(n));
                let (u, v, sizes) = offsets(as_complex(a), p);
                Self {
                    value: n.conj() * u + n * v,
                    size: n.norm() * (sizes.0 + sizes.1),
                    by_z: n.conj(),
                    by_w: n,
                    by_theta: n.conj() * theta * p - n * p.conj() / theta,
                }
            }
        }
    }
}
