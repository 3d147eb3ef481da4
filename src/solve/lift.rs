//! From the roots of an eliminant back to all unknowns.
//!
//! The plan is walked backwards. Where a resultant eliminated `v` from `f` and `g`, the value of `v` above known values is a common
//! root of the two: a linear solve where one is linear, the null vector of their Sylvester matrix where its corank is one, and all
//! roots of the one that lie near roots of the other where it is more, so that solutions sharing a root are all found. Newton's
//! method on the *original* equations then refines each, and what does not satisfy them is rejected by name.
//!
//! What it cannot do: tell two solutions apart that agree to about 1e-6 in every variable (singular ones: 1e-4), unless their roots differ; and see a real
//! solution in a complex pair closer to the real axis than the limits below.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use thiserror::Error;

use super::eliminant::{Eliminant, EliminateError, Outcome, eliminate};
use super::plan::{Plan, Step};
use super::solutions::{Account, RejectedRoot, RootRejection, Solution, Solutions};
use super::square_free::square_free;
use super::system::{NumericPoly, System, ToComplex, to_complex_together};
use crate::algebra::Gaussian;
use crate::eliminate::SylvesterMatrix;
use crate::roots::{RootsError, companion_roots, companion_roots_real};

/// Why a system has no list of solutions.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SolveError {
    /// The plan cannot be followed.
    #[error(transparent)]
    Eliminate(#[from] EliminateError),
    /// The roots of the eliminant could not be had.
    #[error("roots of the eliminant: {0}")]
    Roots(#[from] RootsError),
    /// No step of the plan eliminates this variable, so none leads back to it.
    #[error("plan: no step eliminates `{variable}`, so it cannot be lifted")]
    NotReached {
        /// The variable.
        variable: String,
    },
    /// More solutions than the root's multiplicity allows: the plan removed a factor that was not extraneous.
    #[error("{found} solutions above a root of multiplicity {multiplicity}: the plan removes too much")]
    TooManyAbove {
        /// Solutions found.
        found: usize,
        /// Multiplicity of the root.
        multiplicity: usize,
    },
}

/// A solution is accepted when every equation is below this many times the sum of the sizes of its terms. Rounding leaves about
/// 1e-15; roots that are none leave about one.
const ACCEPTED_RESIDUAL: f64 = 1e-11;
/// A coefficient counts as zero in a fibre below this part of the size of its terms: a double root is known to 1e-8 (heuristic).
const VANISHING: f64 = 1e-7;
/// The corank counts singular values below this part of the largest. Loose: candidates too many are refused later (heuristic).
const CORANK: f64 = 1e-6;
/// A root of one polynomial is a candidate when the other's relative residual is below this (heuristic, loose likewise).
const COMMON_ROOT: f64 = 1e-3;
/// A root of a fibre this much smaller than its largest may be zero, rounded (heuristic; refused later if it is not).
const ROUNDED_TO_ZERO: f64 = 1e-9;
/// Roots closer than this, relative, are lifted together: rounding moves a near-double root by up to 1e-8, a near-triple one by 1e-5
/// (heuristic).
const CLUSTERED: f64 = 1e-5;
/// Newton has settled when its last relative step is below this at a simple root: the next one, squared, is below rounding.
const SETTLED: f64 = 1e-8;
/// The same at a multiple root, where steps only halve and rounding hides the rest (heuristic).
const SETTLED_MULTIPLE: f64 = 1e-5;
/// A relative step below half a unit in the last place changes nothing any more.
const NO_STEP: f64 = f64::EPSILON / 2.0;
/// Singular values of the Jacobian below this part of the largest are rounding: no step is taken in their directions.
const SILENT: f64 = 1e-14;
/// Simple solutions above one root closer than this, relative, are one (heuristic).
const MERGED: f64 = 1e-6;
/// Likewise where one is singular: Newton stops about 1e-8 from a double solution, 1e-5 from a triple one (heuristic).
const MERGED_SINGULAR: f64 = 1e-4;
/// A Jacobian with a smaller ratio of singular values belongs to a multiple solution, where Newton gives half the digits (heuristic).
const SINGULAR: f64 = 1e-5;
/// Imaginary parts below this are rounding at a simple solution, and below its square root at a multiple one (heuristic).
const REAL: f64 = 1e-10;
/// No more branches than this are followed above one root (heuristic; three quadrics have 24 at most).
const BRANCHES: usize = 4096;
/// Variables smaller than this part of their usual size (the upper quartile over all candidates: neither zeros nor a candidate that
/// ran away decides) count as that large in residuals: where every term vanishes, rounding would have nothing to be compared with
/// (heuristic).
const SMALLEST: f64 = 1e-3;
/// What is this much smaller than what it is made of may be nothing but rounding, and is tried as exactly zero: coefficients of a
/// fibre against their terms, values against the largest (heuristic; what comes of it has to satisfy the equations).
const TRIED_AS_ZERO: f64 = 1e-12;

/// All solutions of a system, real and complex, by a plan of elimination.
///
/// **Accuracy:** refined on the original equations; [`Solution::residual`] is measured on them. Multiplicities of the eliminant's roots
/// are exact. **Errors:** see [`SolveError`]. A degenerate elimination is an [`Outcome`]. **Cost:** that of [`eliminate`], and some
/// tens of microseconds per solution of a system of three equations.
///
/// ```
/// use assur::{Plan, System, algebra::{Integer, Poly, Ring}, solve};
/// let [x, y] = [0, 1].map(Poly::<Integer>::variable);
/// let system = System::new(["x", "y"])
///     .with("circle", x.power(2) + y.power(2) - Poly::from_int(25))
///     .with("line", x - y - Poly::one());
/// let found = solve(&system, &Plan::new("y").resultant("meet", ("circle", "line"), "x"))?;
/// assert!(found.account.adds_up() && found.account.real == 2);
/// assert!((found.solutions[0].values[0] + 3.0).norm() < 1e-14); // (-3, -4) before (4, 3)
/// # Ok::<(), assur::SolveError>(())
/// ```
pub fn solve<C: ToComplex>(system: &System<C>, plan: &Plan<C>) -> Result<Solutions, SolveError> {
    lift(system, plan, &eliminate(system, plan)?)
}

/// All solutions of a system from the eliminant that the plan led to.
///
/// As [`solve`], for those who want the eliminant as well.
pub fn lift<C: ToComplex>(
    system: &System<C>,
    plan: &Plan<C>,
    eliminant: &Eliminant<C>,
) -> Result<Solutions, SolveError> {
    let outcome = eliminant.outcome();
    let mut account = Account { degree: eliminant.degree_bound, ..Account::default() };
    let mut solutions = Vec::new();
    let mut rejected = Vec::new();
    match &outcome {
        Outcome::IdenticallyZero { .. } => account.undecided = account.degree,
        Outcome::NoFiniteSolution => account.at_infinity = account.degree,
        Outcome::Roots { at_infinity } => {
            account.at_infinity = *at_infinity;
            let fibres = Fibres::new(system, plan, eliminant)?;
            let clusters = clusters(numeric_roots(eliminant)?);
            let lifted: Vec<(Vec<Vec<Complex64>>, bool)> = (clusters.iter())
                .map(|cluster| {
                    let (candidates, free): (Vec<_>, Vec<_>) =
                        cluster.roots.iter().map(|&root| fibres.above(root, Branches::Shared)).unzip();
                    (candidates.concat(), free.contains(&true))
                })
                .collect();
            let usual = |v: usize| {
                let mut sizes: Vec<f64> =
                    lifted.iter().flat_map(|(found, _)| found).map(|values| values[v].norm()).collect();
                sizes.sort_by(f64::total_cmp);
                sizes.get(sizes.len() * 3 / 4).copied().unwrap_or(0.0)
            };
            let sizes: Vec<f64> = (0..system.variables().len()).map(usual).collect();
            // A variable that vanishes everywhere is measured by the others; where all vanish nothing has a size but one.
            let others = Some(sizes.iter().copied().fold(0.0, f64::max)).filter(|&size| size > 0.0).unwrap_or(1.0);
            let floors: Vec<f64> =
                sizes.iter().map(|&size| SMALLEST * if size > 0.0 { size } else { others }).collect();
            for (k, (candidates, free)) in lifted.into_iter().enumerate() {
                let Cluster { ref roots, multiplicity } = clusters[k];
                let root = roots[0];
                let nearest_is_k = |z: Complex64| {
                    let here = clusters[k].distance(z);
                    clusters.iter().all(|other| other.distance(z) >= here)
                };
                let mut found: Vec<Refined> = Vec::new();
                let mut settle = |candidates: Vec<Vec<Complex64>>| {
                    for values in candidates {
                        let Some(solution) = fibres.refine(values, &floors, multiplicity) else { continue };
                        match found.iter_mut().find(|known| known.equals(&solution, &floors)) {
                            Some(known) if known.residual > solution.residual => *known = solution,
                            Some(_) => {}
                            None if nearest_is_k(solution.values[fibres.left]) => found.push(solution),
                            None => {}
                        }
                    }
                    found.len()
                };
                if settle(candidates) < multiplicity && !free {
                    // A root known to few digits can hide which branches are shared: now all are tried, and the equations decide.
                    settle(roots.iter().flat_map(|&root| fibres.above(root, Branches::All).0).collect());
                }
                // Isolated solutions are no more than the multiplicity. Singular ones beyond it are points of a curve.
                let curve = found.len() > multiplicity && found.iter().any(|solution| solution.singular);
                if curve {
                    found.retain(|solution| !solution.singular);
                }
                let free = free || curve;
                let Shares { counted, rest } = share_multiplicity(&found, multiplicity, free)?;
                for (solution, multiplicity) in found.into_iter().zip(counted) {
                    let solution = fibres.finish(solution, multiplicity, &floors);
                    let bin = if solution.real { &mut account.real } else { &mut account.complex };
                    *bin += solution.multiplicity;
                    solutions.push(solution);
                }
                if let Some((reason, multiplicity)) = rest {
                    match reason {
                        RootRejection::FreeVariable => account.self_motion += multiplicity,
                        RootRejection::SharedMultiplicity => account.undecided += multiplicity,
                        RootRejection::NothingAbove | RootRejection::ExtraMultiplicity => {
                            account.rejected += multiplicity
                        }
                    }
                    rejected.push(RejectedRoot { root, multiplicity, reason });
                }
            }
            let key = |s: &Solution| (s.values[fibres.left].re, s.values[fibres.left].im);
            solutions.sort_by(|a, b| {
                let ((a_re, a_im), (b_re, b_im)) = (key(a), key(b));
                a_re.total_cmp(&b_re).then(a_im.total_cmp(&b_im))
            });
        }
    }
    assert!(account.adds_up(), "every root of the eliminant is accounted for: {account:?}");
    Ok(Solutions { variables: system.variables().to_vec(), solutions, rejected, outcome, account })
}

/// Roots so close to each other that floats cannot tell which of them a solution belongs to. They are lifted and counted together:
/// poses that nearly share a value of the variable come from an eliminant that is known there to half its digits.
struct Cluster {
    roots: Vec<Complex64>,
    multiplicity: usize,
}

impl Cluster {
    fn distance(&self, z: Complex64) -> f64 {
        self.roots.iter().map(|root| (root - z).norm()).fold(f64::INFINITY, f64::min)
    }
}

/// Groups roots with their multiplicities by distance.
fn clusters(roots: Vec<(Complex64, usize)>) -> Vec<Cluster> {
    let mut clusters: Vec<Cluster> = Vec::new();
    for (root, multiplicity) in roots {
        let mut joined = Cluster { roots: vec![root], multiplicity };
        let near = |cluster: &Cluster| cluster.distance(root) <= CLUSTERED * root.norm();
        let (touching, apart): (Vec<_>, Vec<_>) = clusters.into_iter().partition(near);
        for cluster in touching {
            joined.multiplicity += cluster.multiplicity;
            joined.roots.extend(cluster.roots);
        }
        clusters = apart;
        clusters.push(joined);
    }
    clusters
}

/// The distinct roots of the eliminant with their exact multiplicities.
fn numeric_roots<C: ToComplex>(eliminant: &Eliminant<C>) -> Result<Vec<(Complex64, usize)>, RootsError> {
    let mut roots = Vec::new();
    for (factor, multiplicity) in square_free(&eliminant.polynomial) {
        let coefficients = to_complex_together(factor.coefficients());
        let real: Vec<f64> = coefficients.iter().map(|c| c.re).collect();
        let found = if coefficients.iter().all(|c| c.im == 0.0) {
            companion_roots_real(&real)?
        } else {
            companion_roots(&coefficients)?
        };
        roots.extend(found.finite.into_iter().map(|root| (root, multiplicity)));
    }
    Ok(roots)
}

/// How the multiplicity of a root is shared among the solutions above it.
struct Shares {
    /// One per solution.
    counted: Vec<usize>,
    /// What no solution takes, and why.
    rest: Option<(RootRejection, usize)>,
}

fn share_multiplicity(found: &[Refined], multiplicity: usize, free: bool) -> Result<Shares, SolveError> {
    if found.len() > multiplicity {
        return Err(SolveError::TooManyAbove { found: found.len(), multiplicity });
    }
    let mut counted = vec![1; found.len()];
    let left = multiplicity - found.len();
    let singular: Vec<usize> = (0..found.len()).filter(|&k| found[k].singular).collect();
    let reason = match singular.len() {
        _ if left == 0 => return Ok(Shares { counted, rest: None }),
        _ if free => RootRejection::FreeVariable,
        0 if found.is_empty() => RootRejection::NothingAbove,
        0 => RootRejection::ExtraMultiplicity,
        shares if left.is_multiple_of(shares) => {
            for k in singular {
                counted[k] += left / shares;
            }
            return Ok(Shares { counted, rest: None });
        }
        _ => RootRejection::SharedMultiplicity,
    };
    Ok(Shares { counted, rest: Some((reason, left)) })
}

/// A candidate after Newton's method.
struct Refined {
    values: Vec<Complex64>,
    residual: f64,
    singular: bool,
}

impl Refined {
    fn equals(&self, other: &Self, floors: &[f64]) -> bool {
        let singular = self.singular || other.singular;
        let close = |((a, b), floor): ((&Complex64, &Complex64), &f64)| {
            let size = a.norm().max(b.norm());
            let limit = if singular { MERGED_SINGULAR * size.max(floor / SMALLEST) } else { MERGED * size.max(*floor) };
            (a - b).norm() <= limit
        };
        self.values.iter().zip(&other.values).zip(floors).all(close)
    }
}

/// A system and the polynomials its plan made, in floats, ready to be solved variable by variable.
struct Fibres {
    left: usize,
    variables: usize,
    equations: Vec<NumericPoly>,
    /// Last elimination first: the variable and the two polynomials it was eliminated from.
    steps: Vec<(usize, NumericPoly, NumericPoly)>,
    /// All others that may help where those two vanish identically.
    others: Vec<NumericPoly>,
}

impl Fibres {
    fn new<C: ToComplex>(system: &System<C>, plan: &Plan<C>, eliminant: &Eliminant<C>) -> Result<Self, SolveError> {
        let number = |name: &str| {
            system.variable_number(name).ok_or_else(|| EliminateError::UnknownVariable { name: name.to_string() })
        };
        let numeric = |name: &str| {
            let polynomial = eliminant.polynomial_called(name);
            polynomial.map(NumericPoly::new).ok_or_else(|| EliminateError::UnknownPolynomial { name: name.to_string() })
        };
        let left = number(plan.variable())?;
        let mut steps = Vec::new();
        for step in plan.steps().iter().rev() {
            if let Step::Resultant { of, eliminate, .. } = step {
                steps.push((number(eliminate)?, numeric(&of.0)?, numeric(&of.1)?));
            }
        }
        for (v, variable) in system.variables().iter().enumerate() {
            if v != left && !steps.iter().any(|&(eliminated, ..)| eliminated == v) {
                return Err(SolveError::NotReached { variable: variable.clone() });
            }
        }
        Ok(Self {
            left,
            variables: system.variables().len(),
            equations: system.equations().iter().map(|(_, polynomial)| NumericPoly::new(polynomial)).collect(),
            steps,
            others: eliminant.polynomials.iter().map(|(_, polynomial)| NumericPoly::new(polynomial)).collect(),
        })
    }

    /// Candidates for all variables above a root, and whether some variable stayed free.
    fn above(&self, root: Complex64, which: Branches) -> (Vec<Vec<Complex64>>, bool) {
        let mut partial = vec![Complex64::ZERO; self.variables];
        partial[self.left] = root;
        let mut branches = vec![partial];
        let mut known = vec![false; self.variables];
        known[self.left] = true;
        let mut free = false;
        for (variable, f, g) in &self.steps {
            if known[*variable] {
                continue;
            }
            let mut extended = Vec::new();
            for values in branches {
                match self.fibre_roots(*variable, [f, g], &values, &known, which) {
                    Some(roots) => extended.extend(roots.into_iter().map(|root| {
                        let mut values = values.clone();
                        values[*variable] = root;
                        values
                    })),
                    None => free = true,
                }
            }
            extended.truncate(BRANCHES);
            branches = extended;
            known[*variable] = true;
        }
        (branches, free)
    }

    /// Values of one variable above known ones; `None` where no polynomial restrains it.
    fn fibre_roots(
        &self,
        variable: usize,
        pair: [&NumericPoly; 2],
        values: &[Complex64],
        known: &[bool],
        which: Branches,
    ) -> Option<Vec<Complex64>> {
        let restrains = |p: &&NumericPoly| {
            p.contains(variable) && (0..self.variables).all(|v| v == variable || known[v] || !p.contains(v))
        };
        let fibre = |p: &NumericPoly| Fibre::new(p, variable, values);
        let mut fibres: Vec<Fibre> = pair.into_iter().filter(restrains).filter_map(fibre).collect();
        if which == Branches::All && !fibres.is_empty() {
            let roots = fibres.iter().filter_map(|f| companion_roots(&f.coefficients).ok());
            return Some(roots.flat_map(|roots| roots.finite).collect());
        }
        if let [f, g] = &fibres[..]
            && let Some(root) = f.shared_root(g)
        {
            return Some(vec![f.without_rounding(g.without_rounding(root))]);
        }
        fibres.extend(self.others.iter().filter(restrains).filter_map(fibre));
        let lowest = fibres.iter().min_by_key(|f| f.coefficients.len())?;
        let roots = companion_roots(&lowest.coefficients).ok()?.finite;
        let roots = roots.into_iter().map(|z| lowest.without_rounding(z));
        Some(roots.filter(|&z| fibres.iter().all(|f| f.relative_residual(z) < COMMON_ROOT)).collect())
    }

    /// Newton's method on the original equations; `None` where it does not settle on a solution.
    fn refine(&self, mut values: Vec<Complex64>, floors: &[f64], multiplicity: usize) -> Option<Refined> {
        /// Enough to halve a distance of one down to 1e-8 and to find the way there first (heuristic).
        const STEPS: usize = 100;
        // Newton halves the distance to a double solution per step, and stops where rounding hides the rest.
        let settled = if multiplicity == 1 { SETTLED } else { SETTLED_MULTIPLE };
        let mut best: Option<(Vec<Complex64>, f64)> = None;
        let mut idle = 0;
        let mut last_step = f64::INFINITY;
        for _ in 0..STEPS {
            if values.iter().any(|z| !z.is_finite()) {
                break;
            }
            let residual = self.residual(&values, floors);
            match &best {
                Some((_, least)) if residual >= *least => idle += 1,
                _ => {
                    best = Some((values.clone(), residual));
                    idle = 0;
                }
            }
            if residual == 0.0 || idle > 2 {
                last_step = if residual == 0.0 { 0.0 } else { last_step };
                break;
            }
            let (step, _) = self.newton_step(&values, floors)?;
            let relative = |((dx, x), floor): ((&Complex64, &Complex64), &f64)| {
                dx.norm() / x.norm().max(*floor).max(f64::MIN_POSITIVE)
            };
            last_step = step.iter().zip(&values).zip(floors).map(relative).fold(0.0, f64::max);
            for (x, dx) in values.iter_mut().zip(&step) {
                *x -= dx;
            }
            if last_step < NO_STEP {
                break;
            }
        }
        let (mut values, mut residual) = best?;
        let largest = values.iter().map(|z| z.norm()).fold(0.0, f64::max);
        for v in 0..values.len() {
            if values[v] != Complex64::ZERO && values[v].norm() < TRIED_AS_ZERO * largest {
                let kept = std::mem::replace(&mut values[v], Complex64::ZERO);
                match self.residual(&values, floors) {
                    fits if fits <= residual.max(f64::EPSILON) => residual = fits,
                    _ => values[v] = kept,
                }
            }
        }
        if residual > ACCEPTED_RESIDUAL || last_step > settled {
            return None;
        }
        let (_, condition) = self.newton_step(&values, floors)?;
        Some(Refined { values, residual, singular: condition < SINGULAR })
    }

    /// The least-squares Newton step, and the ratio of the extreme singular values of the Jacobian, each equation divided by the size of
    /// its terms and each variable by its usual size.
    fn newton_step(&self, values: &[Complex64], floors: &[f64]) -> Option<(Vec<Complex64>, f64)> {
        let (m, n) = (self.equations.len(), self.variables);
        let mut jacobian = DMatrix::<Complex64>::zeros(m, n);
        let mut value = DVector::<Complex64>::zeros(m);
        for (i, equation) in self.equations.iter().enumerate() {
            let size = equation.value_and_size(&raised(values, floors)).1.max(f64::MIN_POSITIVE);
            value[i] = equation.value_and_size(values).0 / size;
            for v in 0..n {
                jacobian[(i, v)] = equation.derivative(v, values) / size;
            }
        }
        // A column counts by what its variable usually amounts to. Columns of length one would hide that one has vanished.
        let scales: Vec<f64> = (0..n).map(|v| values[v].norm().max(floors[v] / SMALLEST)).collect();
        for (v, scale) in scales.iter().enumerate() {
            jacobian.column_mut(v).scale_mut(*scale);
        }
        if jacobian.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let svd = jacobian.try_svd(true, true, f64::EPSILON, 1000)?;
        let largest = svd.singular_values.max();
        // Directions in which the equations say nothing in floats get no step.
        let step = svd.solve(&value, SILENT * largest).ok()?;
        let smallest = if m < n { 0.0 } else { svd.singular_values.min() };
        let step = step.iter().zip(&scales).map(|(dx, scale)| dx * *scale).collect();
        Some((step, if largest > 0.0 { smallest / largest } else { 0.0 }))
    }

    /// The largest value of an equation over the sum of the sizes of its terms.
    fn residual(&self, values: &[Complex64], floors: &[f64]) -> f64 {
        let sizes = raised(values, floors);
        let of = |equation: &NumericPoly| match equation.value_and_size(values).0.norm() {
            0.0 => 0.0,
            value => value / equation.value_and_size(&sizes).1,
        };
        self.equations.iter().map(of).fold(0.0, f64::max)
    }

    /// Decides whether a solution is real and drops the imaginary rounding if so.
    fn finish(&self, refined: Refined, multiplicity: usize, floors: &[f64]) -> Solution {
        let Refined { values, residual, singular } = refined;
        let limit = if singular { REAL.sqrt() } else { REAL };
        let flat = |(z, floor): (&Complex64, &f64)| z.im.abs() <= limit * z.norm().max(*floor);
        if values.iter().zip(floors).all(flat) {
            let real: Vec<Complex64> = values.iter().map(|z| z.re.into()).collect();
            let real_residual = self.residual(&real, floors);
            if real_residual <= ACCEPTED_RESIDUAL {
                return Solution { values: real, residual: real_residual, multiplicity, real: true };
            }
        }
        Solution { values, residual, multiplicity, real: false }
    }
}

/// The values, those that are tiny raised in size.
fn raised(values: &[Complex64], floors: &[f64]) -> Vec<Complex64> {
    values.iter().zip(floors).map(|(z, &floor)| z.norm().max(floor).into()).collect()
}

/// Which values of a variable are followed further.
#[derive(Clone, Copy, PartialEq)]
enum Branches {
    /// Roots that the two polynomials share.
    Shared,
    /// Every root of either.
    All,
}

/// A polynomial in one variable above known values of the others.
struct Fibre {
    coefficients: Vec<Complex64>,
}

impl Fibre {
    /// `None` where the variable drops out.
    fn new(polynomial: &NumericPoly, variable: usize, values: &[Complex64]) -> Option<Self> {
        let (mut coefficients, sizes) = polynomial.coefficients_in(variable, polynomial.degree_in(variable), values);
        let present = |k: usize| coefficients[k].norm() > VANISHING * sizes[k];
        let restrains = (1..coefficients.len()).any(present);
        for (c, size) in coefficients.iter_mut().zip(&sizes) {
            if c.norm() <= TRIED_AS_ZERO * size {
                *c = Complex64::ZERO;
            }
        }
        while coefficients.len() > 1 && coefficients[coefficients.len() - 1] == Complex64::ZERO {
            coefficients.pop();
        }
        let finite = coefficients.iter().all(|c| c.is_finite());
        (restrains && finite).then_some(Self { coefficients })
    }

    /// The one root two polynomials share, where they share just one.
    fn shared_root(&self, other: &Self) -> Option<Complex64> {
        for (linear, checked) in [(self, other), (other, self)] {
            if let [c0, c1] = linear.coefficients[..] {
                let root = -c0 / c1;
                return (root.is_finite() && checked.relative_residual(root) < COMMON_ROOT).then_some(root);
            }
        }
        // In a variable of size about one, the powers in the null vector are too.
        let degree = self.coefficients.len() - 1;
        let ratio = self.coefficients[0].norm() / self.coefficients[degree].norm();
        let scale = if ratio.is_finite() && ratio > 0.0 { (ratio.log2() / degree as f64).round().exp2() } else { 1.0 };
        let scaled = |fibre: &Self| {
            let mut power = 1.0;
            let mut coefficients = fibre.coefficients.clone();
            for c in &mut coefficients {
                *c *= power;
                power *= scale;
            }
            let largest = coefficients.iter().map(|c| c.norm()).fold(0.0, f64::max);
            coefficients.into_iter().map(|c| Gaussian::new(c.re / largest, c.im / largest)).collect::<Vec<_>>()
        };
        let rows = SylvesterMatrix::new(("f", &scaled(self)), ("g", &scaled(other)), "v").into_rows();
        let size = rows.len();
        let matrix = DMatrix::from_fn(size, size, |i, j| Complex64::new(rows[i][j].re, rows[i][j].im));
        let svd = matrix.try_svd(false, true, f64::EPSILON, 1000)?;
        let small = svd.singular_values.iter().filter(|&&s| s < CORANK * svd.singular_values.max()).count();
        let null = svd.v_t?.row(size - 1).map(|z| z.conj());
        if small > 1 {
            return None;
        }
        // The powers descend along the vector: each entry is the root times the next.
        let (above, below) = (null.columns(0, size - 1), null.columns(1, size - 1));
        let product: Complex64 = above.iter().zip(below.iter()).map(|(a, b)| a * b.conj()).sum();
        let root = product / below.norm_squared() * scale;
        let shared = self.relative_residual(root) < COMMON_ROOT && other.relative_residual(root) < COMMON_ROOT;
        (root.is_finite() && shared).then_some(root)
    }

    /// The value over the sum of the sizes of the terms, these taken no closer to zero than rounding reaches.
    fn relative_residual(&self, z: Complex64) -> f64 {
        let size_of_z = z.norm().max(ROUNDED_TO_ZERO * self.largest_root());
        let (value, size) = self
            .coefficients
            .iter()
            .rev()
            .fold((Complex64::ZERO, 0.0), |(value, size), c| (value * z + c, size * size_of_z + c.norm()));
        if value == Complex64::ZERO { 0.0 } else { value.norm() / size }
    }

    /// Zero where the root is so close to it that it may be nothing else: a polynomial further down the plan may vanish there.
    fn without_rounding(&self, root: Complex64) -> Complex64 {
        if root.norm() < TRIED_AS_ZERO * self.largest_root() { Complex64::ZERO } else { root }
    }

    /// The size of the largest root, within a factor of twice the degree (Fujiwara's bound).
    fn largest_root(&self) -> f64 {
        let degree = self.coefficients.len() - 1;
        let lead = self.coefficients[degree].norm();
        let ratios = self.coefficients[..degree].iter().enumerate();
        ratios.map(|(k, c)| (c.norm() / lead).powf(1.0 / (degree - k) as f64)).fold(0.0, f64::max)
    }
}
