//! From a truss to every way of putting it together.

use nalgebra::Vector2;
use num_complex::Complex64;

use super::closure::{CLOSED, Closure, Refined, distance};
use super::describe::Truss;
use crate::linkage::Status;
use crate::linkage::loops::{Route, candidates};

/// A lift whose loops miss by more than this part of their terms belongs to no solution: true ones miss by 1e-10 at most (heuristic; measured
/// over the 32 trusses: superfluous eigenvalues miss by 0.1 and more).
const PLAUSIBLE: f64 = 1e-3;
/// Solutions closer than this, relative, are one: refined ones agree to some 1e-13.
const SAME: f64 = 1e-7;
/// The same where the Jacobian has lost a rank and Newton's method settles at about the root of that.
const SAME_SINGULAR: f64 = 1e-4;
/// Without a known count: pencils in a row that must add nothing before the list counts as settled.
const SETTLED: usize = 3;
/// Largest gap of a real assembly's joints, over the size, before the complex solution is said not to be real.
const REAL_GAP: f64 = 1e-9;

/// One way to put a truss together, real or complex.
#[derive(Clone, Debug, PartialEq)]
pub struct TrussAssembly {
    /// `theta = e^(i phi)` of every link from its own frame to the ground's, the ground's own 1 among them. Of modulus 1 where real.
    pub theta: Vec<Complex64>,
    /// Whether all rotations are real. Decided by the partner under `theta -> 1 / conj(theta)`: a real solution is its own.
    pub real: bool,
    /// How many solutions meet here, as far as one pencil told: 1 where the loops' Jacobian is regular.
    pub multiplicity: usize,
    /// Real: the largest gap between two links at a joint of the assembled mechanism, over its size. Complex: the largest sum around a
    /// loop over the sum of the sizes of its terms.
    pub residual: f64,
}

/// Every way to put a truss together.
#[derive(Clone, Debug, PartialEq)]
pub struct TrussAssemblies {
    /// `Complete` where the list is known to be whole, `SelfMotion` where a curve of assemblies was met, else `Undecided`.
    pub status: Status,
    /// The isolated solutions: real ones first, each kind sorted by the arguments of the rotations, link by link.
    pub assemblies: Vec<TrussAssembly>,
    /// How many there are for general dimensions, with multiplicity, where that is known.
    pub expected: Option<usize>,
    /// How many are missing to that number; `None` where it is unknown. Special dimensions may have fewer solutions, which this cannot tell
    /// from solutions not found.
    pub missing: Option<usize>,
    /// One assembly on each curve of assemblies that was met, at random places of it.
    pub curves: Vec<TrussAssembly>,
    /// How many pencils were solved.
    pub pencils: usize,
    /// Links that turn freely, since their joints coincide; their `theta` is 1.
    pub loose_links: Vec<usize>,
}

impl TrussAssemblies {
    /// How many solutions were found, with multiplicity.
    pub fn count(&self) -> usize {
        self.assemblies.iter().map(|assembly| assembly.multiplicity).sum()
    }

    /// The real assemblies.
    pub fn real(&self) -> impl Iterator<Item = &TrussAssembly> {
        self.assemblies.iter().filter(|assembly| assembly.real)
    }
}

impl Truss {
    /// Every way to put the truss together, real and complex.
    ///
    /// **Accuracy:** each solution closes its loops to 1e-11 and mostly to a few roundings; numerical, not proved. The number found is held
    /// against the catalogue's. **Cost:** one pencil as a rule: 0.02 ms, 0.15 ms, 2.7 ms for five, seven and nine links; where solutions are missing,
    /// two for each pair of a ground and a hidden link. **Source:** see [`crate::eliminate::DixonPencil`].
    ///
    /// ```
    /// use assur::linkage::{Truss, TrussJoint};
    /// use assur::nalgebra::Vector2;
    /// let joint = |i, j, x, y| TrussJoint::drawn([i, j], Vector2::new(x, y));
    /// let joints = [joint(0, 3, 0.0, 0.0), joint(1, 3, 4.0, 0.0), joint(2, 3, 2.0, 5.0),
    ///               joint(0, 4, 1.0, 1.5), joint(1, 4, 3.0, 1.0), joint(2, 4, 2.0, 2.5)];
    /// let found = Truss::new(5, &joints, 3)?.assemble();
    /// assert_eq!((found.count(), found.missing), (6, Some(0)));
    /// // The drawing itself is one of them.
    /// assert!(found.real().any(|a| a.theta.iter().all(|t| (t - 1.0).norm() < 1e-12)));
    /// # Ok::<(), assur::linkage::TrussError>(())
    /// ```
    pub fn assemble(&self) -> TrussAssemblies {
        let closure = Closure::of(self);
        let mut found = Found { closure: &closure, truss: self, solutions: Vec::new(), curves: Vec::new() };
        // With loose links the equations are those of a special member, and what it lacks is no loss.
        let expected = self.general_count().filter(|_| self.loose.is_empty());
        let (mut pencils, mut idle) = (0, 0);
        'choices: for [ground, hidden] in self.choices() {
            let before = found.solutions.len();
            let mut answered = false;
            // The slower route where the faster one leads nowhere, or falls short of what is known.
            for route in [Route::UnitCircle, Route::Qz] {
                if route == Route::Qz && answered && expected.is_none() {
                    break;
                }
                answered |= found.add_pencil(ground, hidden, route);
                pencils += 1;
                if expected.is_some_and(|expected| found.count() >= expected) {
                    break 'choices;
                }
            }
            if expected.is_none() {
                let added = found.solutions.len() > before;
                idle = if added || !answered { 0 } else { idle + 1 };
                if idle >= SETTLED {
                    break;
                }
            }
        }
        let Found { mut solutions, curves, .. } = found;
        solutions.sort_by(|a, b| b.assembly.real.cmp(&a.assembly.real).then_with(|| order(a, b)));
        let assemblies: Vec<TrussAssembly> = solutions.into_iter().map(|solution| solution.assembly).collect();
        let count: usize = assemblies.iter().map(|assembly| assembly.multiplicity).sum();
        let missing = expected.map(|expected| expected.saturating_sub(count));
        let status = match missing {
            _ if !curves.is_empty() => Status::SelfMotion,
            Some(0) => Status::Complete,
            _ => Status::Undecided,
        };
        let loose_links = self.loose.clone();
        TrussAssemblies { status, assemblies, expected, missing, curves, pencils, loose_links }
    }

    /// Ground and hidden link of each pencil to try, the most promising first.
    fn choices(&self) -> Vec<[usize; 2]> {
        let links = self.links();
        let fits = |&[ground, hidden]: &[usize; 2]| ground != hidden && !self.loose.contains(&ground);
        let first = self.recognised.as_ref().map(|found| found.best).filter(fits);
        let grounds = std::iter::once(self.ground).chain((0..links).filter(|&link| link != self.ground));
        let others = grounds.flat_map(|ground| (0..links).map(move |hidden| [ground, hidden])).filter(fits);
        let others: Vec<[usize; 2]> = others.filter(|choice| Some(*choice) != first).collect();
        first.into_iter().chain(others).collect()
    }

    /// Where each link stands in an assembly: its frame's origin and rotation, and how far the links gape at the joints that no tree closes, over
    /// the size. For complex solutions the first of the two isotropic coordinates.
    pub(super) fn placed(&self, theta: &[Complex64]) -> (Vec<Complex64>, f64) {
        let (parent, order) = self.graph.tree(self.ground);
        let mut origins = vec![Complex64::ZERO; self.links()];
        let place = |link: usize, joint: usize| self.places[joint][usize::from(self.graph.edges[joint][1] == link)];
        for &link in &order[1..] {
            if let Some(joint) = parent[link] {
                let other = self.graph.across(joint, link);
                origins[link] = origins[other] + theta[other] * place(other, joint) - theta[link] * place(link, joint);
            }
        }
        let gap = |(joint, ends): (usize, &[usize; 2])| {
            let [a, b] = ends.map(|link| origins[link] + theta[link] * place(link, joint));
            (a - b).norm()
        };
        let gap = self.graph.edges.iter().enumerate().map(gap).fold(0.0, f64::max) / self.size;
        (origins, gap)
    }

    /// Origin and rotation of every link's frame in an assembly, in the ground's frame.
    pub(in crate::linkage) fn link_frames(&self, assembly: &TrussAssembly) -> Vec<(Complex64, Complex64)> {
        let (origins, _) = self.placed(&assembly.theta);
        origins.into_iter().zip(assembly.theta.iter().copied()).collect()
    }

    /// Where the joints of each link are in a real assembly, in the ground's frame, as (joint, place).
    ///
    /// ```
    /// # use assur::linkage::{Truss, TrussJoint};
    /// # use assur::nalgebra::Vector2;
    /// let joint = |i, j, x, y| TrussJoint::drawn([i, j], Vector2::new(x, y));
    /// let elbow = Truss::new(3, &[joint(0, 1, 0.0, 0.0), joint(1, 2, 1.0, 1.0), joint(0, 2, 2.0, 0.0)], 0)?;
    /// let found = elbow.assemble();
    /// let heights: Vec<f64> = found.real().map(|a| elbow.joints_of_link(1, a)[1].1.y).collect();
    /// assert!(heights.len() == 2 && heights.iter().all(|y| (y.abs() - 1.0).abs() < 1e-12));
    /// # Ok::<(), assur::linkage::TrussError>(())
    /// ```
    pub fn joints_of_link(&self, link: usize, assembly: &TrussAssembly) -> Vec<(usize, Vector2<f64>)> {
        let (origins, _) = self.placed(&assembly.theta);
        let at = |(joint, place): (usize, Complex64)| {
            let point = origins[link] + assembly.theta[link] * place;
            (joint, Vector2::new(point.re, point.im))
        };
        self.on_link(link).map(at).collect()
    }
}

/// Real before complex, then by the arguments of the rotations and their moduli; equal within rounding counts as equal.
fn order(a: &Solution, b: &Solution) -> std::cmp::Ordering {
    let key = |t: &Complex64| [(t.arg() * 1e9).round(), (t.norm().ln() * 1e9).round()];
    let keys = a.assembly.theta.iter().zip(&b.assembly.theta).map(|(x, y)| (key(x), key(y)));
    let mut orders = keys.flat_map(|(x, y)| [x[0].total_cmp(&y[0]), x[1].total_cmp(&y[1])]);
    orders.find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
}

/// `1 / conj(theta)`: a solution too, since the numbers of a truss are real.
fn mirror(theta: &[Complex64]) -> Vec<Complex64> {
    theta.iter().map(|t| t.conj().inv()).collect()
}

struct Solution {
    assembly: TrussAssembly,
    regular: bool,
}

/// The solutions so far.
struct Found<'a> {
    closure: &'a Closure,
    truss: &'a Truss,
    solutions: Vec<Solution>,
    curves: Vec<TrussAssembly>,
}

impl Found<'_> {
    fn count(&self) -> usize {
        self.solutions.iter().map(|solution| solution.assembly.multiplicity).sum()
    }

    /// What the pencil of one hidden link gives; whether it gave anything at all.
    fn add_pencil(&mut self, ground: usize, hidden: usize, route: Route) -> bool {
        let others: Vec<usize> = (0..self.closure.links).filter(|&link| link != ground && link != hidden).collect();
        let columns = |row: &Vec<Complex64>| {
            [ground, hidden].iter().chain(&others).map(|&link| row[link]).collect::<Vec<Complex64>>()
        };
        let loops: Vec<Vec<Complex64>> = self.closure.rows.iter().map(columns).collect();
        let Some(candidates) = candidates(&loops, route) else { return false };
        let refine = |theta: &[Complex64]| self.closure.refine(theta, self.truss.ground, PLAUSIBLE);
        let mut lifted = Vec::with_capacity(candidates.len());
        let mut theta = vec![Complex64::ONE; self.closure.links];
        for candidate in &candidates {
            theta[ground] = Complex64::ONE;
            theta[hidden] = candidate.hidden;
            for (&link, &t) in others.iter().zip(&candidate.others) {
                theta[link] = t;
            }
            let turn = theta[self.truss.ground].inv();
            theta.iter_mut().for_each(|t| *t *= turn);
            let Some(refined) = refine(&theta) else { continue };
            // The mirror image of a regular solution is taken in with it; where they are one, the pair was two that lie close.
            let separate = !refined.regular || distance(&mirror(&refined.theta), &refined.theta) < SAME;
            lifted.push(refined);
            if candidate.paired && separate {
                lifted.extend(refine(&mirror(&theta)));
            }
        }
        let any = !lifted.is_empty();
        // How often each singular solution came out of this pencil: its multiplicity, as far as one can tell.
        let mut tally: Vec<(usize, usize)> = Vec::new();
        for refined in lifted {
            let singular = !refined.regular;
            let Some(place) = self.add(refined) else { continue };
            if singular {
                match tally.iter_mut().find(|(known, _)| *known == place) {
                    Some((_, times)) => *times += 1,
                    None => tally.push((place, 1)),
                }
            }
        }
        for (place, times) in tally {
            let multiplicity = &mut self.solutions[place].assembly.multiplicity;
            *multiplicity = times.max(*multiplicity);
        }
        any
    }

    /// Takes a solution in, with its partner; the place it has, unless it lies on a curve of solutions.
    fn add(&mut self, refined: Refined) -> Option<usize> {
        if let Some(place) = self.place_of(&refined) {
            return Some(place);
        }
        let ground = self.truss.ground;
        if !self.closure.loose_links_stand(&refined.theta, ground) {
            return None;
        }
        if !refined.regular && self.closure.on_a_curve(&refined.theta, ground) {
            // A few samples tell as much as many.
            const SAMPLES: usize = 4;
            if self.curves.len() < SAMPLES {
                let real = refined.theta.iter().all(|t| (t.norm() - 1.0).abs() < SAME);
                let Refined { theta, residual, .. } = refined;
                self.curves.push(TrussAssembly { theta, real, multiplicity: 1, residual });
            }
            return None;
        }
        let mirrored = mirror(&refined.theta);
        let same = if refined.regular { SAME } else { SAME_SINGULAR };
        let place = self.solutions.len();
        if distance(&mirrored, &refined.theta) < same
            && let Some(assembly) = self.as_real(&refined)
        {
            self.solutions.push(Solution { assembly, regular: refined.regular });
            return Some(place);
        }
        // Numbers are real, so the mirrored rotations solve the loops too; found here, they need not be found again.
        for theta in [refined.theta.clone(), mirrored] {
            let residual = self.closure.residual(&theta);
            let assembly = TrussAssembly { theta, real: false, multiplicity: 1, residual };
            self.solutions.push(Solution { assembly, regular: refined.regular });
        }
        Some(place)
    }

    fn place_of(&self, refined: &Refined) -> Option<usize> {
        self.solutions.iter().position(|known| {
            let same = if refined.regular && known.regular { SAME } else { SAME_SINGULAR };
            distance(&known.assembly.theta, &refined.theta) < same
        })
    }

    /// The solution brought onto the unit circle and measured there; `None` where it does not stay closed.
    fn as_real(&self, refined: &Refined) -> Option<TrussAssembly> {
        let on_circle = |theta: &[Complex64]| theta.iter().map(|t| t / t.norm()).collect::<Vec<Complex64>>();
        let mut best = on_circle(&refined.theta);
        let mut gap = self.truss.placed(&best).1;
        if let Some(again) = self.closure.refine(&best, self.truss.ground, PLAUSIBLE) {
            let theta = on_circle(&again.theta);
            let after = self.truss.placed(&theta).1;
            if after < gap {
                (best, gap) = (theta, after);
            }
        }
        (gap < REAL_GAP.max(CLOSED)).then_some(TrussAssembly {
            theta: best,
            real: true,
            multiplicity: 1,
            residual: gap,
        })
    }
}
