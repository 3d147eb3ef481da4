//! In which ways can a triad be put together? All of them, with an account.
//!
//! 1. The triad's numbers become integers ([`super::numbers`]).
//! 2. `T` is eliminated exactly, by Sylvester resultants ([`super::constraint`]); its order against the family's tells how many roots ran to infinity.
//! 3. `T` is split into square-free parts by multiplicity and by what lies above their roots ([`super::fibre`]): exactly.
//! 4. Roots are located to 160 bits or more; those that are real are counted exactly ([`crate::roots`]).
//! 5. Each root is lifted to the poses above it ([`super::place`]), and each pose is measured on the geometry
//!    ([`super::verify`]).
//!
//! Every root ends in exactly one entry of the [`Account`].

use std::f64::consts::PI;

use dashu_int::ops::BitTest;
use nalgebra::Vector2;
use num_complex::Complex64;

use super::assemblies::{
    Assemblies, AssemblyMode, ComplexMode, Limit, Rejection, SelfMotion, Special, Status, ThetaPolynomial,
};
use super::constraint::reference_consistency;
use super::det_a::{parity, points, scaled_determinant};
use super::fibre::{Fibre, Part, parts, parts_alike};
use super::given_orientation::{Given, assemble_two, exact_rotation, same_orientation};
use super::group::{Dyad, Pose, Triad};
use super::numbers::{LocalLegs, TriadNumbers};
use super::pinned::PinnedDyad;
use super::place::{Placed, Solution, place, place_pinned};
use super::special::{near_misses, special_shapes};
use super::triad::{LegNumbers, leg_row, triad_rows};
use super::vanishing::motions;
use super::verify::{Placement, complex_residual, determinant, residual, size};
use crate::algebra::{Gaussian, Integer, Ring, Trig};
use crate::certify::Verdict;
use crate::roots::{NotLocated, scaled};
use crate::solve::Account;

/// A pose whose assembled geometry misses closure by more than this, relative to the size, is not reported as a mode but as
/// undecided. Poses found are near 1e-16; the bound only guards against a breach of the arithmetic's range.
const CLOSURE_GUARD: f64 = 1e-9;

/// Two angles, or two coordinates relative to the size, closer than this count as equal when modes are sorted.
const SORTING_TIE: f64 = 1e-9;

impl Triad {
    /// Every way to put the triad together.
    ///
    /// **Shape**: modes sorted by `phi`, `x`, `y`; the account sums to [`Triad::degree`], or to 0 where the consistency polynomial
    /// vanishes identically. **Units and frame**: poses of the platform frame in the base frame, lengths as given, radians.
    /// **Proof**: the number of modes, their multiplicities and every degenerate case are decided exactly, for the
    /// triad whose numbers are the given `f64`s (for an RP leg given by its distance see [`super::Offset`]); poses are rounded from
    /// 160 bits or more. **Cost**: about a millisecond.
    /// **Source**: Gosselin, Sefrioui, Richard 1992 for three RR legs; the derivation `degree_table` for all.
    ///
    /// ```
    /// use assur::{Dyad, Triad, nalgebra::Vector2};
    /// let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
    /// let triad = Triad::new([
    ///     leg([0.0, 0.0], [0.0, 0.0], 14.98),
    ///     leg([15.91, 0.0], [17.045, 0.0], 15.38),
    ///     leg([0.0, 10.0], [13.2389, 16.0929], 12.0),
    /// ])?;
    /// let answer = triad.assemble();
    /// assert_eq!((answer.modes.len(), answer.account.real, answer.account.degree), (6, 6, 6));
    /// # Ok::<(), assur::TriadError>(())
    /// ```
    pub fn assemble(&self) -> Assemblies {
        let numbers = TriadNumbers::of(self.legs());
        let local = LocalLegs::of(&numbers);
        let mut gathering = Gathering::new(self.legs(), self.degree(), &numbers, &local);
        let exponent = local.unit + numbers.length_shift;
        match <&[LegNumbers<Integer>; 3]>::try_from(&numbers.legs[..]) {
            Ok(legs) => {
                let order = self.order().expect("three legs without PP have an order");
                gathering.turning_platform(legs, order, exponent);
            }
            Err(_) => gathering.translating_platform(self.legs(), &numbers.legs, exponent),
        }
        gathering.finish()
    }
}

impl PinnedDyad {
    /// Every way to put the pinned platform together: two, one with a PP leg, or none.
    ///
    /// Units, frame, proof and cost as in [`Triad::assemble`]. `det_a` is that of [`PinnedDyad::det_a`].
    pub fn assemble(&self) -> Assemblies {
        let legs = self.as_legs();
        let numbers = TriadNumbers::of(&legs);
        let local = LocalLegs::of(&numbers);
        let mut gathering = Gathering { pinned: true, ..Gathering::new(&legs, self.degree(), &numbers, &local) };
        gathering.out.special.retain(|&special| special != Special::ZeroLength || self.leg_is_point());
        match (self.leg(), numbers.legs.get(1)) {
            (Dyad::PP { phi }, _) => gathering.pinned_at(*phi),
            (_, leg) => gathering.pinned_platform(leg.expect("a leg other than PP has numbers")),
        }
        gathering.finish()
    }

    fn leg_is_point(&self) -> bool {
        matches!(self.leg(), Dyad::RR { length: 0.0, .. })
    }
}

/// An answer in the making.
struct Gathering<'a> {
    /// Whether the reference point is a pin.
    pinned: bool,
    /// `legs`, the reference leg first.
    legs: &'a [LegNumbers<f64>],
    /// 1, or -1 where that order is an odd permutation of the one given.
    parity: f64,
    /// Lengths of `legs` are in units of `2^unit`.
    unit: i64,
    size: f64,
    a0: Complex64,
    b0: Complex64,
    out: Assemblies,
}

impl<'a> Gathering<'a> {
    fn new(legs: &[Dyad], degree: usize, numbers: &TriadNumbers, local: &'a LocalLegs) -> Self {
        let (a0, b0) = numbers.order.first().map_or_else(Default::default, |&i| points(&legs[i]));
        Self {
            pinned: false,
            parity: parity(legs, &numbers.order),
            size: size(&local.legs),
            legs: &local.legs,
            unit: local.unit,
            a0,
            b0,
            out: Assemblies {
                status: Status::Complete,
                limit: None,
                modes: Vec::new(),
                complex: Vec::new(),
                complex_out_of_range: 0,
                account: Account { degree, ..Account::default() },
                rejections: Vec::new(),
                self_motions: Vec::new(),
                special: special_shapes(legs, numbers),
                near: near_misses(numbers),
                certificate: None,
                polynomial: None,
                size: 0.0,
                origin: Vector2::new(a0.re, a0.im),
            },
        }
    }

    /// Three legs without PP: the orientations are the roots of `T`.
    fn turning_platform(&mut self, legs: &[LegNumbers<Integer>; 3], order: usize, exponent: i64) {
        let symbols = legs.each_ref().map(|leg| leg.map(|x| Trig::constant(x.clone())));
        let rows = triad_rows(&symbols, &Trig::cosine(), &Trig::sine());
        let t = reference_consistency(legs, order);
        self.out.polynomial = Some(shown(&t, order));
        if t.vanishes() {
            self.out.account.degree = 0;
            match motions(&rows) {
                Ok(motions) => motions.into_iter().for_each(|m| self.note_motion(m)),
                Err(_) => self.out.give_up(Limit::Size),
            }
            return;
        }
        self.out.account.at_infinity += 2 * (order - t.order());
        for part in parts(&t, &rows) {
            self.take_part(&part, place(&part, &rows, exponent));
        }
    }

    /// A pinned platform on one leg without PP: its row at `u = 0` is the consistency polynomial.
    fn pinned_platform(&mut self, leg: &LegNumbers<Integer>) {
        let symbols = leg.map(|x| Trig::constant(x.clone()));
        let t = leg_row(&symbols, &Trig::zero(), &Trig::cosine(), &Trig::sine()).e;
        self.out.polynomial = Some(shown(&t, 1));
        if t.vanishes() {
            self.out.account.degree = 0;
            self.note_motion(SelfMotion { phi: None, real: true });
            return;
        }
        self.out.account.at_infinity += 2 * (1 - t.order());
        for part in parts_alike(&t, Fibre::Centre) {
            self.take_part(&part, place_pinned(&part));
        }
    }

    /// A pinned platform with its orientation given.
    fn pinned_at(&mut self, phi: f64) {
        let theta = Complex64::from_polar(1.0, phi);
        self.take_solution(Solution { theta, u: [Complex64::ZERO; 2], real: true, twin: false }, 1);
    }

    fn take_part(&mut self, part: &Part, placed: Result<Placed, NotLocated>) {
        match placed {
            Ok(placed) => {
                for (theta, on_circle, solutions) in placed.roots {
                    self.take_root(theta, on_circle, &solutions, part.multiplicity, part.fibre);
                }
            }
            Err(NotLocated::NotSettled(_) | NotLocated::Ambiguous { .. }) => {
                self.out.account.undecided += part.in_chart.degree().unwrap_or(0) * part.multiplicity;
                self.out.give_up(Limit::Size);
            }
        }
    }

    /// At least one PP leg: the orientation is given.
    fn translating_platform(&mut self, all: &[Dyad; 3], legs: &[LegNumbers<Integer>], exponent: i64) {
        let orientations: Vec<f64> =
            all.iter().filter_map(|leg| if let Dyad::PP { phi } = leg { Some(*phi) } else { None }).collect();
        let phi = orientations[0];
        let rotation = exact_rotation(phi);
        let motion = SelfMotion { phi: Some(principal(phi.sin().atan2(phi.cos()))), real: true };
        if orientations.len() > 1 {
            // One orientation, given twice: the same and the platform translates, or there is no assembly.
            if orientations.iter().all(|&other| same_orientation(phi, other)) {
                self.note_motion(motion);
            }
            return;
        }
        let degree = self.out.account.degree;
        match assemble_two(legs, &rotation, exponent) {
            Given::AtInfinity => self.out.account.at_infinity = degree,
            Given::Curve => {
                self.out.account.self_motion = degree;
                self.note_motion(motion);
            }
            Given::Isolated(solutions) => {
                for (solution, multiplicity) in solutions {
                    self.take_solution(solution, multiplicity);
                }
            }
        }
    }

    fn note_motion(&mut self, motion: SelfMotion) {
        // A motion in orientations that are not real is no curve of poses; the account still counts it.
        if motion.real || motion.phi.is_none() {
            self.out.self_motions.push(SelfMotion { phi: motion.phi.map(principal), ..motion });
            self.out.status = Status::SelfMotion;
        }
    }

    /// Books one root of `T` with everything above it.
    fn take_root(
        &mut self,
        theta: Complex64,
        on_circle: bool,
        solutions: &[Solution],
        multiplicity: usize,
        fibre: Fibre,
    ) {
        match (fibre, solutions) {
            (Fibre::Empty(reason), _) => {
                self.out.account.rejected += multiplicity;
                self.out.rejections.push(Rejection { theta, multiplicity, reason });
            }
            (Fibre::Curve, _) => {
                self.out.account.self_motion += multiplicity;
                self.note_motion(SelfMotion { phi: on_circle.then(|| theta.arg()), real: on_circle });
            }
            (Fibre::IsotropicPoint, [solution]) => {
                self.take_solution(*solution, 1);
                let reason = super::assemblies::RejectionReason::IsotropicLine;
                if multiplicity > 1 {
                    self.out.account.rejected += multiplicity - 1;
                    self.out.rejections.push(Rejection { theta, multiplicity: multiplicity - 1, reason });
                }
            }
            (_, [p, q]) => {
                let [m, n] = self.share(multiplicity, p, q);
                self.take_solution(*p, m);
                self.take_solution(*q, n);
            }
            (_, rest) => rest.iter().for_each(|&solution| self.take_solution(solution, multiplicity)),
        }
    }

    /// How two poses share a root of `T`: evenly, and where that does not go, the one nearer to a singularity has more.
    fn share(&self, multiplicity: usize, p: &Solution, q: &Solution) -> [usize; 2] {
        let regular = |s: &Solution| determinant(self.legs, Placement { rotation: s.theta, u: s.u[0] }).abs();
        match multiplicity {
            0 | 1 => [multiplicity, 0],
            m if m % 2 == 0 => [m / 2; 2],
            m if regular(p) >= regular(q) => [m / 2, m - m / 2],
            m => [m - m / 2, m / 2],
        }
    }

    /// Books one solution: a mode, which is undecided where it fails its measurement, or a complex one.
    fn take_solution(&mut self, solution: Solution, multiplicity: usize) {
        if multiplicity == 0 {
            return;
        }
        if !solution.real {
            self.take_complex(solution, multiplicity);
        } else if !self.take_mode(solution, multiplicity) {
            self.out.account.undecided += multiplicity;
            self.out.give_up(Limit::ExponentRange);
        }
    }

    fn take_mode(&mut self, solution: Solution, multiplicity: usize) -> bool {
        let rotation = solution.theta / solution.theta.norm();
        let at = Placement { rotation, u: solution.u[0] };
        let scale = if self.size > 0.0 { self.size } else { 1.0 };
        // A platform far outside the group cannot be placed better than its distance is rounded.
        let residual = residual(self.legs, at) / scale.max(at.u.norm());
        let phi = principal(rotation.arg());
        // The pose's own rounded angle turns the reference point, so that the rounding of phi does not swing the platform about a
        // far origin.
        let origin = self.a0 + self.length(solution.u[0]) - Complex64::from_polar(1.0, phi) * self.b0;
        let det_a = scaled_determinant(self.legs, at, self.pinned, self.parity, self.size);
        let sound = residual <= CLOSURE_GUARD && origin.is_finite();
        if sound {
            let pose = Pose::new(origin.re, origin.im, phi);
            let proof = Verdict::NotAsked;
            self.out.modes.push(AssemblyMode { pose, multiplicity, residual, det_a, proof, pose_box: None });
            self.out.account.real += multiplicity;
            if multiplicity > 1 {
                self.out.special.push(Special::DoubleRoot);
            }
            // Two positions in a given orientation are the rule; only where the orientation is sought are they special.
            if solution.twin && self.out.polynomial.is_some() {
                self.out.special.push(Special::TwinPoses);
            }
        }
        sound
    }

    /// That there is such a solution is exact; its numbers are listed where they can be.
    fn take_complex(&mut self, solution: Solution, multiplicity: usize) {
        let Solution { theta, u: [u, v], .. } = solution;
        let z = self.length(u) + self.a0 - theta * self.b0;
        let w = self.length(v) + self.a0.conj() - theta.inv() * self.b0.conj();
        self.out.account.complex += multiplicity;
        let finite = [theta, z, w].iter().all(|number| number.is_finite());
        if finite && complex_residual(self.legs, theta, u, v) <= CLOSURE_GUARD {
            self.out.complex.push(ComplexMode { theta, z, w, multiplicity });
        } else {
            self.out.complex_out_of_range += multiplicity;
        }
    }

    /// A length of the local legs in the unit of the model.
    fn length(&self, u: Complex64) -> Complex64 {
        // In two steps: 2^unit alone may leave the range of f64.
        let unit = self.unit.clamp(-2200, 2200) as i32;
        u * 2f64.powi(unit / 2) * 2f64.powi(unit - unit / 2)
    }

    fn finish(self) -> Assemblies {
        let size = self.length(Complex64::from(self.size)).re;
        let mut out = self.out;
        out.size = size;
        sort_modes(&mut out.modes, size);
        out.complex.sort_by(|p, q| {
            let key = |m: &ComplexMode| [m.theta.arg(), m.theta.norm(), m.z.re];
            key(p).partial_cmp(&key(q)).unwrap_or(std::cmp::Ordering::Equal)
        });
        if !out.self_motions.is_empty() {
            out.special.push(Special::SelfMotion);
        }
        out.special.sort_unstable();
        out.special.dedup();
        assert!(out.account.adds_up(), "every root is booked once: {:?}", out.account);
        out
    }
}

impl Assemblies {
    /// Ends the answer as undecided. A lack of digits is named before a lack of exponents.
    pub(super) fn give_up(&mut self, limit: Limit) {
        self.status = Status::Undecided;
        if self.limit != Some(Limit::Size) {
            self.limit = Some(limit);
        }
    }
}

/// The angle with -pi written as pi.
fn principal(phi: f64) -> f64 {
    if phi <= -PI { PI } else { phi }
}

/// A number to sort modes by.
type Key = fn(&AssemblyMode) -> f64;

/// Sorts by phi, then x, then y, ties within [`SORTING_TIE`] counting as equal.
fn sort_modes(modes: &mut [AssemblyMode], size: f64) {
    let length = SORTING_TIE * size;
    let keys: [(Key, f64); 3] = [(|m| m.pose.phi, SORTING_TIE), (|m| m.pose.x, length), (|m| m.pose.y, length)];
    sort_by_keys(modes, &keys);
}

/// Sorts by the first key, and runs of near-equal values among themselves by the next.
fn sort_by_keys(modes: &mut [AssemblyMode], keys: &[(Key, f64)]) {
    let Some(((key, tie), rest)) = keys.split_first() else { return };
    modes.sort_by(|p, q| key(p).total_cmp(&key(q)));
    for run in modes.chunk_by_mut(|p, q| key(q) - key(p) <= *tie) {
        sort_by_keys(run, rest);
    }
}

/// `T` as a Laurent polynomial in theta with its largest coefficient of modulus 1.
fn shown(t: &Trig<Integer>, order: usize) -> ThetaPolynomial {
    let exact = t.theta(order);
    let bits = |c: &Gaussian<Integer>| c.re.bit_len().max(c.im.bit_len()) as i64;
    let exponent = exact.coefficients().iter().map(bits).max().unwrap_or(0);
    let rounded: Vec<Complex64> = (0..=2 * order).map(|k| scaled(&exact.coefficient(k), -exponent)).collect();
    let largest = rounded.iter().map(|c| c.norm()).fold(0.0, f64::max);
    let coefficients = rounded.into_iter().map(|c| if largest > 0.0 { c / largest } else { c });
    ThetaPolynomial { from: -(order as i32), coefficients: coefficients.collect() }
}
