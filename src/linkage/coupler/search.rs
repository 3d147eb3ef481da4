//! Newton's method on the equations of the guided points, and the list of what it found.
//!
//! Unknowns are the two isotropic coordinates of the common point and the rotation of each coupler; a line or a circle is one more
//! equation. Starts come from polynomials and pencils and may be wrong: what does not close is dropped, and the count is held against the exact one.

use arrayvec::ArrayVec;
use num_complex::Complex64;

use super::curve::{CouplerCurve, CouplerSide, complex};
use super::equation::{Biquadratic, SideNumbers, coupler_equation};
use super::meet::{Intersection, Intersections};
use super::sextic::to_complex;
use crate::algebra::{Gaussian, Ring, Twice};
use crate::linkage::loops::{Candidate, Route, candidates};
use crate::linkage::pivoting::{modulus, solve};
use crate::roots::pencil_eigenpairs;
use crate::solve::Account;

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
/// After a step this short the next is not taken: what it would mend is the square of this times a condition that may be large near common foci.
const LAST_STEP: f64 = 1e-13;
/// Places this far away in sizes of the curve, or rotations of such a modulus, are what points at infinity leave: there the equations hold up to
/// rounding without being solved (heuristic: those of the reference pair with nearly common foci lie at 4e4).
const FAR: f64 = 1e8;
/// An eigenvalue this close to infinity belongs to no finite intersection.
const EXTREME: f64 = 1e-12;

/// Which coordinate the Sylvester matrix eliminates; its pencil's eigenvalue is the other.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Hidden {
    Z,
    W,
}

/// A place that may be, or is, an intersection: `z`, `w` and the rotation of each coupler.
pub(super) type Unknowns = ArrayVec<Complex64, 4>;

/// Where Newton's method is to start.
pub(super) struct Start {
    unknowns: Unknowns,
    /// Whether the mirror image is a start too, which is then not listed on its own.
    paired: bool,
}

/// One equation of a search, and the unknown rotation in it.
struct Equation {
    side: Side,
    rotation: Option<usize>,
}

/// One side of a coupler, or a line or circle, in complex numbers.
enum Side {
    Circle { a: Complex64, p: Complex64, r: f64 },
    Line { a: Complex64, n: Complex64, p: Complex64 },
}

impl Side {
    fn of(side: &SideNumbers<f64>) -> Self {
        let c = |g: &Gaussian<f64>| Complex64::new(g.re, g.im);
        match side {
            SideNumbers::Circle { a, p, r } => Self::Circle { a: c(a), p: c(p), r: *r },
            SideNumbers::Line { a, n, p } => Self::Line { a: c(a), n: c(n), p: c(p) },
        }
    }

    /// `A`, `B`, `C` of `A theta^2 + B theta + C = 0` (see `equation.rs`).
    fn quadratic(&self, z: Complex64, w: Complex64) -> [Complex64; 3] {
        match *self {
            Self::Circle { a, p, r } => {
                let (u, v) = (z - a, w - a.conj());
                [p * v, u * v + p.norm_sqr() - r * r, p.conj() * u]
            }
            Self::Line { a, n, p } => [n.conj() * p, n.conj() * (z - a) + n * (w - a.conj()), n * p.conj()],
        }
    }
}

impl Side {
    /// The equation's value, rounded once.
    fn value_twice(&self, [z, w]: [Complex64; 2], theta: Complex64) -> Complex64 {
        let twice = |z: Complex64| Gaussian::new(Twice::from(z.re), Twice::from(z.im));
        let back = theta.inv();
        // One Newton step doubles the digits of the inverse.
        let inverse = twice(back) + twice(back) * (Gaussian::one() - twice(theta) * twice(back));
        let offsets = |a: Complex64, p: Complex64| {
            let u = twice(z) - twice(a) + twice(theta) * twice(p);
            let v = twice(w) - twice(a.conj()) + twice(p.conj()) * inverse;
            (u, v)
        };
        let value = match *self {
            Self::Circle { a, p, r } => {
                let (u, v) = offsets(a, p);
                u * v - Gaussian::real(Twice::from(r) * Twice::from(r))
            }
            Self::Line { a, n, p } => {
                let (u, v) = offsets(a, p);
                twice(n.conj()) * u + twice(n) * v
            }
        };
        Complex64::new(value.re.high(), value.im.high())
    }
}

struct Solution {
    unknowns: Unknowns,
    residual: f64,
    regular: bool,
    real: bool,
    multiplicity: usize,
}

/// Solutions in z, w and the couplers' rotations, near the origin and of size one.
pub(super) struct Search {
    curves: Vec<CouplerCurve>,
    given: Vec<CouplerCurve>,
    equations: Vec<Equation>,
    pub(super) shift: Complex64,
    pub(super) size: f64,
    found: Vec<Solution>,
}

impl Search {
    pub(super) fn new(given: Vec<CouplerCurve>, partner: Option<SideNumbers<f64>>) -> Self {
        let (_, shift, size) = given[0].normal();
        let curves: Vec<CouplerCurve> = given.iter().map(|curve| curve.moved(shift, size)).collect();
        let mut equations: Vec<Equation> = Vec::new();
        for (rotation, curve) in curves.iter().enumerate() {
            let sides = curve.float_sides();
            equations.extend(sides.iter().map(|side| Equation { side: Side::of(side), rotation: Some(rotation) }));
        }
        let partner = partner.map(|side| match Side::of(&side) {
            Side::Circle { a, p, r } => Side::Circle { a: (a - shift) / size, p, r: r / size },
            Side::Line { a, n, p } => Side::Line { a: (a - shift) / size, n: n / n.norm(), p },
        });
        equations.extend(partner.map(|side| Equation { side, rotation: None }));
        Self { curves, given, equations, shift, size, found: Vec::new() }
    }

    /// The equation of the first curve, near the origin and of size one.
    pub(super) fn equation(&self) -> Biquadratic<Complex64> {
        to_complex(&coupler_equation(&self.curves[0].float_sides()))
    }

    /// How many solutions there are so far, with multiplicity.
    pub(super) fn count(&self) -> usize {
        self.found.iter().map(|solution| solution.multiplicity).sum()
    }

    /// Refines what floating point gives; what the exact polynomial gives too, where that is short.
    pub(super) fn cross(
        mut self,
        quick: impl Fn(&Self) -> Vec<[Complex64; 2]>,
        exactly: impl Fn() -> Vec<[Complex64; 2]>,
        finite: usize,
    ) -> Self {
        let starts: Vec<Start> = quick(&self).into_iter().flat_map(|[z, w]| self.poses(z, w)).collect();
        self.add(&starts);
        if self.count() < finite {
            let near = |[z, w]: [Complex64; 2]| [(z - self.shift) / self.size, (w - self.shift.conj()) / self.size];
            let starts: Vec<Start> = exactly().into_iter().map(near).flat_map(|[z, w]| self.poses(z, w)).collect();
            self.add(&starts);
        }
        self
    }

    /// Starts above a point that lies on every curve: all rotations that fit.
    fn poses(&self, z: Complex64, w: Complex64) -> Vec<Start> {
        let mut starts = vec![Unknowns::from_iter([z, w])];
        for sides in self.equations.chunks(2).take(self.curves.len()) {
            let thetas = rotations([&sides[0].side, &sides[1].side], z, w);
            let with = |start: &Unknowns, theta: Complex64| start.iter().copied().chain([theta]).collect::<Unknowns>();
            starts = starts.iter().flat_map(|start| thetas.iter().map(|&theta| with(start, theta))).collect();
        }
        starts.into_iter().map(|unknowns| Start { unknowns, paired: false }).collect()
    }

    /// Lifts of the Dixon pencil of two four-bars: loops `a - b + r R1 - s R2 + theta (q - p) = 0` of either, and one through the
    /// common point; the first coupler's rotation is hidden.
    pub(super) fn dixon(&self, route: Route) -> Vec<Start> {
        let numbers = |curve: &CouplerCurve| {
            curve.sides.map(|side| match side {
                CouplerSide::Circle { pivot, radius, arm } => (complex(&pivot), Complex64::from(radius), complex(&arm)),
                CouplerSide::Line { point, arm, .. } => (complex(&point), Complex64::ZERO, complex(&arm)),
            })
        };
        let [[(a, r, p), (b, s, q)], [(c, t, u), (d, v, x)]] = [numbers(&self.curves[0]), numbers(&self.curves[1])];
        let o = Complex64::ZERO;
        // Columns: 1, theta1, R1, R2, R3, R4, theta2.
        let loops =
            [vec![a - b, q - p, r, -s, o, o, o], vec![c - d, o, o, o, t, -v, x - u], vec![a - c, -p, r, o, -t, o, u]];
        let lift = |candidate: Candidate| {
            let Candidate { hidden: theta, others, paired } = candidate;
            let z = a + r * others[0] - theta * p;
            let w = a.conj() + r / others[0] - p.conj() / theta;
            Start { unknowns: Unknowns::from([z, w, theta, others[4]]), paired }
        };
        candidates(&loops, route).unwrap_or_default().into_iter().map(lift).collect()
    }

    /// Lifts of the Sylvester matrix of both equations as a matrix polynomial, linearised.
    pub(super) fn sylvester(&self, hidden: Hidden) -> Vec<Start> {
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
            if pair.beta.norm() < EXTREME * pair.alpha.norm() {
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
            starts.extend(self.poses(z, w));
        }
        starts
    }

    /// Refines starting points and takes in what closes, with its mirrored partner.
    pub(super) fn add(&mut self, starts: &[Start]) {
        let mut tally: Vec<(usize, usize)> = Vec::new();
        for start in starts {
            let Some(refined) = self.refine(&start.unknowns) else { continue };
            // The mirror image of a regular solution is taken in with it; where they are one, the pair was two that lie close.
            let separate = !refined.regular || apart(&mirror(&refined.unknowns), &refined.unknowns) < SAME;
            let partner = if start.paired && separate { self.refine(&mirror(&start.unknowns)) } else { None };
            for refined in std::iter::once(refined).chain(partner) {
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
            let mut real: Unknowns = refined.unknowns.iter().zip(&mirrored).map(|(a, b)| (a + b) / 2.0).collect();
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
        let residual = self.linearise(&mirrored, &mut Linear::default());
        let partner = Solution { unknowns: mirrored, residual, regular: refined.regular, real: false, multiplicity: 1 };
        self.found.extend([refined, partner]);
        place
    }

    /// Fills in the linearised equations, each over the sizes of its terms; the largest residual.
    fn linearise(&self, unknowns: &[Complex64], linear: &mut Linear) -> f64 {
        let size = self.equations.len();
        let mut worst = 0.0f64;
        linear.units = [0, 1].map(|k| modulus(unknowns[k]).max(1.0));
        let inverses: ArrayVec<Complex64, 2> = unknowns[2..].iter().map(Complex64::inv).collect();
        for (row, equation) in self.equations.iter().enumerate() {
            let (theta, inverse) =
                equation.rotation.map_or((Complex64::ONE, Complex64::ONE), |k| (unknowns[2 + k], inverses[k]));
            let value = Value::at(&equation.side, [unknowns[0], unknowns[1]], theta, inverse);
            let scale = if value.size > 0.0 { 1.0 / value.size } else { 1.0 };
            let line = &mut linear.matrix[row * size..(row + 1) * size];
            line.fill(Complex64::ZERO);
            line[0] = value.by_z * (scale * linear.units[0]);
            line[1] = value.by_w * (scale * linear.units[1]);
            if let Some(rotation) = equation.rotation {
                line[2 + rotation] = value.by_theta * scale;
            }
            linear.right[row] = -value.value * scale;
            linear.scales[row] = scale;
            let residual = modulus(linear.right[row]);
            // `max` would drop a NaN.
            worst = if residual > worst || residual.is_nan() { residual } else { worst };
        }
        if worst.is_nan() { f64::INFINITY } else { worst }
    }

    /// Newton's method: steps in z and w in units of the size or of themselves, whichever is larger, relative ones in the rotations.
    fn refine(&self, start: &[Complex64]) -> Option<Solution> {
        const MOST_STEPS: usize = 20;
        const LONGEST_STEP: f64 = 0.5;
        let size = self.equations.len();
        let mut linear = Linear::default();
        let mut unknowns: Unknowns = start.iter().copied().collect();
        let mut residual = self.linearise(&unknowns, &mut linear);
        if residual > PLAUSIBLE {
            return None;
        }
        let mut regular = true;
        for taken in 0..MOST_STEPS {
            let step = solve(&mut linear.matrix[..size * size], &mut linear.right[..size], size, RANK)?;
            regular = step.kernel.is_none();
            let turn = step.solution[2..].iter().map(|d| modulus(*d)).fold(0.0, f64::max);
            let held = if turn > LONGEST_STEP { LONGEST_STEP / turn } else { 1.0 };
            let longest = step.solution.iter().map(|d| modulus(*d)).fold(0.0, f64::max);
            let next = moved(&unknowns, &step.solution, &linear.units, held);
            let after = self.linearise(&next, &mut linear);
            // The first step always is taken: near common foci small residuals say little about a start.
            if taken > 0 && residual < CLOSED && after >= residual {
                break;
            }
            if !after.is_finite() {
                return None;
            }
            (unknowns, residual) = (next, after);
            if longest < LAST_STEP {
                break;
            }
        }
        let mut closed = residual < CLOSED && unknowns.iter().all(|x| x.is_finite());
        if closed && regular {
            residual = self.last_digits(&mut unknowns, &mut linear);
            closed = residual < CLOSED;
        }
        let (places, turns) = unknowns.split_at(2);
        closed &= places.iter().all(|x| modulus(*x) < FAR);
        closed &= turns.iter().all(|t| (1.0 / FAR..FAR).contains(&modulus(*t)));
        closed.then_some(Solution { unknowns, residual, regular, real: false, multiplicity: 1 })
    }

    /// One step more with residuals taken to twice the digits: near common foci, `w` is lost in `z`, and so the residual in rounding. The
    /// residual afterwards.
    fn last_digits(&self, unknowns: &mut Unknowns, linear: &mut Linear) -> f64 {
        let size = self.equations.len();
        let residual = self.linearise(unknowns, linear);
        for (row, equation) in self.equations.iter().enumerate() {
            let theta = equation.rotation.map_or(Complex64::ONE, |k| unknowns[2 + k]);
            linear.right[row] = -equation.side.value_twice([unknowns[0], unknowns[1]], theta) * linear.scales[row];
        }
        let Some(step) = solve(&mut linear.matrix[..size * size], &mut linear.right[..size], size, RANK) else {
            return residual;
        };
        let next = moved(unknowns, &step.solution, &linear.units, 1.0);
        let after = self.linearise(&next, linear);
        if after < CLOSED && apart(&next, unknowns) < SAME {
            *unknowns = next;
            return after;
        }
        residual
    }

    /// The answer, measured on the curves as given.
    pub(super) fn finish(self, degree: usize, finite: usize) -> Intersections {
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

/// The linearised equations at one place.
#[derive(Default)]
struct Linear {
    matrix: [Complex64; 16],
    right: [Complex64; 4],
    /// One over the size of each equation's terms.
    scales: [f64; 4],
    /// What a step of one means in z and w: the size of the curve, or for places further away their distance.
    units: [f64; 2],
}

/// Unknowns after a step.
fn moved(unknowns: &Unknowns, step: &[Complex64], units: &[f64; 2], held: f64) -> Unknowns {
    let mut next = unknowns.clone();
    for (k, (next, delta)) in next.iter_mut().zip(step).enumerate() {
        match units.get(k) {
            Some(unit) => *next += delta * (held * unit),
            None => *next *= 1.0 + delta * held,
        }
    }
    next
}

/// `(w', z', 1 / theta')`: a solution too, since the numbers of the curves are real.
fn mirror(unknowns: &[Complex64]) -> Unknowns {
    let places = [unknowns[1].conj(), unknowns[0].conj()];
    places.into_iter().chain(unknowns[2..].iter().map(|theta| theta.conj().inv())).collect()
}

/// Differences of z and w in units of the size or of themselves, whichever is larger, and relative ones of the rotations.
fn apart(a: &[Complex64], b: &[Complex64]) -> f64 {
    let square = |(k, (x, y)): (usize, (&Complex64, &Complex64))| {
        let size = x.norm_sqr().max(y.norm_sqr());
        (x - y).norm_sqr() / if k < 2 { size.max(1.0) } else { size }
    };
    a.iter().zip(b).enumerate().map(square).fold(0.0, f64::max).sqrt()
}

/// The rotations with which a coupler passes through a point of its curve: one, or two at a double point.
fn rotations(sides: [&Side; 2], z: Complex64, w: Complex64) -> ArrayVec<Complex64, 2> {
    let mut values = sides.map(|side| side.quadratic(z, w));
    let weight = |q: &[Complex64; 3]| q.iter().map(|c| c.norm_sqr()).fold(0.0, f64::max);
    if weight(&values[0]) < weight(&values[1]) {
        values.swap(0, 1);
    }
    let [[a, b, c], other] = values;
    let root = (b * b - a * c * 4.0).sqrt();
    let sum = if (b + root).norm_sqr() >= (b - root).norm_sqr() { -(b + root) } else { -(b - root) };
    let miss = |theta: &Complex64| {
        let terms = [other[0] * theta * theta, other[1] * theta, other[2]];
        let size: f64 = terms.iter().map(|t| modulus(*t)).sum();
        if size > 0.0 { modulus(terms.iter().sum::<Complex64>()) / size } else { 0.0 }
    };
    let mut found: ArrayVec<Complex64, 2> = [sum / (a * 2.0), c * 2.0 / sum]
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
    fn at(side: &Side, [z, w]: [Complex64; 2], theta: Complex64, inverse: Complex64) -> Self {
        let offsets = |a: Complex64, p: Complex64| {
            let (turned, back) = (theta * p, p.conj() * inverse);
            let centre = modulus(a);
            let sizes = [modulus(z) + centre + modulus(turned), modulus(w) + centre + modulus(back)];
            (z - a + turned, w - a.conj() + back, turned, back, sizes)
        };
        match *side {
            Side::Circle { a, p, r } => {
                let (u, v, turned, back, sizes) = offsets(a, p);
                Self {
                    value: u * v - r * r,
                    size: sizes[0] * sizes[1] + r * r,
                    by_z: v,
                    by_w: u,
                    by_theta: turned * v - u * back,
                }
            }
            Side::Line { a, n, p } => {
                let (u, v, turned, back, sizes) = offsets(a, p);
                Self {
                    value: n.conj() * u + n * v,
                    size: modulus(n) * (sizes[0] + sizes[1]),
                    by_z: n.conj(),
                    by_w: n,
                    by_theta: n.conj() * turned - n * back,
                }
            }
        }
    }
}
