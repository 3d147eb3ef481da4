//! How many assembly modes, as a theorem, and a box around each.
//!
//! Two routes. The *filter* counts the real roots of `T` in floating point, by a bound on all rounding errors (as [`Triad::real_modes`] does), and proves
//! a box for each on the loop equations by Krawczyk's operator with counted roundings: every root of `T` is simple then, above a simple root lies exactly one pose (step 5 of the
//! derivation `filter_bound`), and boxes that do not meet hold different poses. Where a bound is not met, the *exact* route counts over the
//! integers and rounds boxes outward from isolated roots. Either way the theorem is about the triad whose numbers are exactly the `f64`s given.

use std::f64::consts::{PI, TAU};

use super::assemblies::{Assemblies, Limit, Status};
use super::certificate::ProofSubject;
use super::exact_box::{Frame, ScaledRotation, boxes, given_boxes};
use super::fibre::{Fibre, Part, parts, parts_alike};
use super::given_orientation::{Given, assemble_two, exact_rotation, same_orientation};
use super::group::{Dyad, Triad};
use super::loop_box::{IntervalTriad, PoseIntervals};
use super::numbers::{LocalLegs, TriadNumbers, has_rounded_offset};
use super::pinned::PinnedDyad;
use super::triad::{LegNumbers, Rows, leg_row, rows_consistency, triad_rows};
use super::vanishing::motions;
use crate::algebra::{Integer, Interval, Rational, Ring, Trig, dyadic};
use crate::certify::Verdict;
use crate::roots::{MAX_BITS, isolate_real_roots};

/// Which arithmetic a proof took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProofRoute {
    /// Floating point with proved error bounds.
    Filter,
    /// Integers.
    Exact,
}

/// One assembly mode, proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvedMode {
    /// `[x, y, phi]`, each from lower to upper bound; the angle may go on beyond pi. Holds this mode and, unless it is
    /// [`ProvedModes::indistinct`], no other.
    pub pose_box: [[f64; 2]; 3],
    /// How many modes meet here, exactly.
    pub multiplicity: usize,
}

/// All assembly modes, proved.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedModes {
    /// The modes, sorted by `phi`, `x`, `y`.
    pub modes: Vec<ProvedMode>,
    /// Which route proved them.
    pub route: ProofRoute,
    /// `Complete`: these are all. `SelfMotion`: there is also a curve of poses. `Undecided`: the list may be short, since a root could not be told from
    /// others within [`MAX_BITS`] bits.
    pub status: Status,
    /// How many boxes meet another: `f64` has too few digits to tell them apart.
    pub indistinct: usize,
}

impl Triad {
    /// How many assembly modes there are, and a box around each, in floating point where its error bounds allow and exactly where not.
    ///
    /// **Shape**: modes sorted by `phi`, `x`, `y`. **Units and frame**: as [`Triad::assemble`]. **Proof**: there are exactly these modes, each simple or of the
    /// multiplicity given, for the triad whose numbers are exactly the `f64`s given. Non-real solutions, reasons and residuals are the
    /// business of [`Triad::certify`]. **Cost**: some microseconds by the filter, some hundred by integers (`benches/certify.rs`).
    ///
    /// ```
    /// use assur::{Dyad, ProofRoute, Triad};
    /// let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
    /// let triad = Triad::new([
    ///     leg([0.0, 0.0], [0.0, 0.0], 14.98),
    ///     leg([15.91, 0.0], [17.045, 0.0], 15.38),
    ///     leg([0.0, 10.0], [13.2389, 16.0929], 12.0),
    /// ])?;
    /// let proved = triad.prove();
    /// assert_eq!((proved.modes.len(), proved.route), (6, ProofRoute::Filter));
    /// assert!(proved.modes.iter().all(|mode| mode.pose_box.iter().all(|[lo, hi]| hi - lo < 1e-10)));
    /// # Ok::<(), assur::TriadError>(())
    /// ```
    pub fn prove(&self) -> ProvedModes {
        self.prove_filtered().unwrap_or_else(|| self.prove_exactly())
    }

    /// The filter alone: `None` where its error bounds do not decide.
    ///
    /// It never decides triads with a PP leg, double roots, or modes nearer than about 1e-7.
    pub fn prove_filtered(&self) -> Option<ProvedModes> {
        let (boxes, count) = self.boxes_fast()?;
        let found = boxes[..count].iter().map(|&pose| (pose, 1)).collect();
        let proved = ProvedModes::new(found, ProofRoute::Filter, Status::Complete);
        (proved.indistinct == 0).then_some(proved)
    }

    /// The exact route alone: integers throughout.
    ///
    /// Undecided only where a root cannot be told from others, or a coordinate from zero, within [`MAX_BITS`] bits.
    pub fn prove_exactly(&self) -> ProvedModes {
        let numbers = TriadNumbers::of(self.legs());
        let frame = frame(self.legs(), &numbers);
        let Ok(legs) = <&[LegNumbers<Integer>; 3]>::try_from(&numbers.legs[..]) else {
            return self.prove_given(&numbers, &frame);
        };
        let symbols = legs.each_ref().map(|leg| leg.map(|x| Trig::constant(x.clone())));
        let rows = triad_rows(&symbols, &Trig::cosine(), &Trig::sine());
        let t = rows_consistency(&rows);
        if t.vanishes() {
            let status = match motions(&rows) {
                Ok(motions) if motions.iter().any(|m| m.real || m.phi.is_none()) => Status::SelfMotion,
                Ok(_) => Status::Complete,
                Err(_) => Status::Undecided,
            };
            return ProvedModes::new(Vec::new(), ProofRoute::Exact, status);
        }
        let (mut found, status) = boxes_of_parts(&parts(&t, &rows), Some(&rows), &frame);
        if has_rounded_offset(self.legs()) {
            self.allow_for_rounded_offsets(&mut found);
        }
        ProvedModes::new(found, ProofRoute::Exact, status)
    }

    /// Replaces the boxes of simple modes by ones that hold for `d·|v|` exact and rounded.
    fn allow_for_rounded_offsets(&self, found: &mut [(PoseIntervals, usize)]) {
        let Some(triad) = IntervalTriad::of(self) else { return };
        let equations = triad.equations();
        for (pose, _) in found.iter_mut().filter(|(_, multiplicity)| *multiplicity == 1) {
            let [x, y, phi] = pose.map(Interval::middle);
            let wider = equations.enclose(triad.start(x, y, phi)).and_then(|region| triad.pose(&region));
            // Newton may have run to another mode; this one's box then stands for the rounded number alone.
            if let Some(wider) = wider.filter(|wider| meet(wider, pose)) {
                *pose = std::array::from_fn(|k| pose[k].hull(wider[k]));
            }
        }
    }

    /// At least one PP leg.
    fn prove_given(&self, numbers: &TriadNumbers, frame: &Frame) -> ProvedModes {
        let proved = |found, status| ProvedModes::new(found, ProofRoute::Exact, status);
        let angle = |leg: &Dyad| if let Dyad::PP { phi } = leg { Some(*phi) } else { None };
        let orientations: Vec<f64> = self.legs().iter().filter_map(angle).collect();
        let phi = orientations[0];
        if orientations.len() > 1 {
            let moves = orientations.iter().all(|&other| same_orientation(phi, other));
            return proved(Vec::new(), if moves { Status::SelfMotion } else { Status::Complete });
        }
        let rotation = exact_rotation(phi);
        let solutions = match assemble_two(&numbers.legs, &rotation, 0) {
            Given::AtInfinity => return proved(Vec::new(), Status::Complete),
            Given::Curve => return proved(Vec::new(), Status::SelfMotion),
            Given::Isolated(solutions) => solutions,
        };
        let real: Vec<usize> =
            solutions.iter().filter(|(s, _)| s.real).map(|&(_, multiplicity)| multiplicity).collect();
        let symbols: Vec<_> = numbers.legs.iter().map(|leg| leg.map(|x| Trig::constant(x.clone()))).collect();
        let (c, s) = (Trig::cosine(), Trig::sine());
        let (radius, rows) = match (&numbers.legs[0], &symbols[0]) {
            (LegNumbers::Circle { length, .. }, LegNumbers::Circle { length: symbol, .. }) => {
                (Some(length), vec![leg_row(&symbols[1], symbol, &c, &s)])
            }
            _ => (None, symbols.iter().map(|leg| leg_row(leg, &Trig::zero(), &c, &s)).collect()),
        };
        let touches = real.contains(&2);
        let mut attempts = given_rotations(phi);
        let found = attempts.find_map(|rotation| {
            let found = given_boxes(&rotation, radius, &rows, touches, frame).filter(|found| found.len() == real.len());
            found.or_else(|| {
                (touches && radius.is_some_and(|r| r.is_zero()))
                    .then(|| frame.centre(&rotation))
                    .flatten()
                    .map(|pose| vec![pose])
            })
        });
        match found {
            Some(found) => proved(found.into_iter().zip(real).collect(), Status::Complete),
            None => proved(Vec::new(), Status::Undecided),
        }
    }

    /// Every way to put the triad together, each proved in a box of its own.
    ///
    /// As [`Triad::assemble`], and every mode has its [`pose_box`](super::AssemblyMode::pose_box) and verdict, the whole its
    /// [`Certificate`](super::Certificate). **Proof**: a theorem about the triad whose numbers are exactly the `f64`s given; a multiple mode is proved multiple by
    /// greatest common divisors and located by exact isolation. For an RP leg given by its distance, `d·|v|` is rounded to `f64` for the count where it
    /// is irrational, and the boxes of simple modes hold for both numbers. **Cost**: about a millisecond.
    ///
    /// ```
    /// use assur::{Dyad, Triad, Verdict};
    /// let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
    /// // Legs of length 1 to an equilateral-like platform, of which the third just reaches.
    /// let triad = Triad::new([
    ///     leg([0.0, 0.0], [0.0, 0.0], 1.0),
    ///     leg([4.0, 0.0], [2.0, 0.0], 1.0),
    ///     leg([2.0, 3.0], [1.0, 1.0], 2.0),
    /// ])?;
    /// let answer = triad.certify();
    /// assert_eq!((answer.modes.len(), answer.modes[0].multiplicity), (1, 2));
    /// assert_eq!(answer.modes[0].proof, Verdict::Proven);
    /// assert_eq!(answer.certificate.unwrap().to_string(), "6 of degree 6: 2 real proved, 4 non-real proved, complete");
    /// # Ok::<(), assur::TriadError>(())
    /// ```
    pub fn certify(&self) -> Assemblies {
        let mut answer = self.assemble();
        answer.attach(&self.prove_exactly(), ProofSubject::Triad(*self), has_rounded_offset(self.legs()));
        answer
    }
}

impl PinnedDyad {
    /// Every way to put the pinned platform together, each proved in a box of its own; see [`Triad::certify`].
    pub fn certify(&self) -> Assemblies {
        let legs = self.as_legs();
        let numbers = TriadNumbers::of(&legs);
        let frame = frame(&legs, &numbers);
        let (found, status) = match (self.leg(), numbers.legs.get(1)) {
            (Dyad::PP { phi }, _) => {
                let found = given_rotations(*phi).find_map(|rotation| frame.centre(&rotation));
                (found.map(|pose| (pose, 1)).into_iter().collect(), Status::Complete)
            }
            (_, leg) => {
                let symbols = leg.expect("a leg other than PP has numbers").map(|x| Trig::constant(x.clone()));
                let t = leg_row(&symbols, &Trig::zero(), &Trig::cosine(), &Trig::sine()).e;
                if t.vanishes() {
                    (Vec::new(), Status::SelfMotion)
                } else {
                    boxes_of_parts(&parts_alike(&t, Fibre::Centre), None, &frame)
                }
            }
        };
        let mut answer = self.assemble();
        let proved = ProvedModes::new(found, ProofRoute::Exact, status);
        answer.attach(&proved, ProofSubject::Pinned(*self), has_rounded_offset(&legs));
        answer
    }
}

fn frame(legs: &[Dyad], numbers: &TriadNumbers) -> Frame {
    let points = numbers.order.first().map(|&i| match &legs[i] {
        Dyad::RR { a, b, .. } | Dyad::PR { a, b, .. } | Dyad::RP { a, b, .. } => ([a.x, a.y], [b.x, b.y]),
        Dyad::PP { .. } => Default::default(),
    });
    let (a0, b0) = points.unwrap_or_default();
    Frame::new(a0, b0, numbers, LocalLegs::of(numbers).unit + numbers.length_shift)
}

/// Boxes above all parts, and whether they are all there is.
fn boxes_of_parts(
    parts: &[Part],
    rows: Option<&Rows<Trig<Integer>>>,
    frame: &Frame,
) -> (Vec<(PoseIntervals, usize)>, Status) {
    let (mut found, mut status) = (Vec::new(), Status::Complete);
    for part in parts {
        if part.fibre == Fibre::Curve && !isolate_real_roots(&part.in_chart).is_empty() && status == Status::Complete {
            status = Status::SelfMotion;
        }
        let boxed = boxes(part, rows, frame);
        found.extend(boxed.poses);
        if !boxed.complete {
            status = Status::Undecided;
        }
    }
    (found, status)
}

/// The rotations that stand for an angle: first all near it, with the exact rational rotation of [`exact_rotation`] among them; then that one alone, ever finer.
fn given_rotations(phi: f64) -> impl Iterator<Item = ScaledRotation> {
    let exact = exact_rotation(phi);
    let wide = [(&exact.re, 0), (&exact.im, 1)].map(|(x, k): (&Rational, usize)| {
        let near = if phi.abs() <= PI {
            Interval::cos_sin(phi)[k].hull(Interval::of_rational(x))
        } else {
            Interval::of_rational(x)
        };
        [near.lo(), near.hi()].map(|end| dyadic(end).expect("cosines are finite"))
    });
    let fine = std::iter::successors(Some(256), |bits| Some(2 * bits)).take_while(|&bits| bits <= MAX_BITS);
    let fine = fine.map(move |bits| {
        let point = |x: &Rational| [x.clone(), x.clone()];
        ScaledRotation::between([point(&exact.re), point(&exact.im)], bits)
    });
    std::iter::once(ScaledRotation::between(wide, 256)).chain(fine)
}

/// Whether two boxes have a pose in common; angles modulo a turn.
fn meet(p: &PoseIntervals, q: &PoseIntervals) -> bool {
    let turned = [0.0, TAU, -TAU].iter().any(|&turn| {
        // Some units wider, since a turn is no f64.
        let turn = if turn == 0.0 { Interval::ZERO } else { Interval::around(turn, 1e-15) };
        (p[2] + turn).intersection(q[2]).is_some()
    });
    turned && (0..2).all(|k| p[k].intersection(q[k]).is_some())
}

impl ProvedModes {
    fn new(mut found: Vec<(PoseIntervals, usize)>, route: ProofRoute, status: Status) -> Self {
        found.sort_by(|(p, _), (q, _)| {
            let order = |k: usize| p[k].middle().total_cmp(&q[k].middle());
            order(2).then(order(0)).then(order(1))
        });
        let others_met = |i: usize| (0..found.len()).any(|j| j != i && meet(&found[i].0, &found[j].0));
        let indistinct = (0..found.len()).filter(|&i| others_met(i)).count();
        let mode = |&(pose, multiplicity): &(PoseIntervals, usize)| ProvedMode {
            pose_box: pose.map(|x| [x.lo(), x.hi()]),
            multiplicity,
        };
        Self { modes: found.iter().map(mode).collect(), route, status, indistinct }
    }
}

impl Assemblies {
    /// Gives each mode the box nearest to it, and the whole its certificate.
    fn attach(&mut self, proved: &ProvedModes, subject: ProofSubject, rounded_offset: bool) {
        let matching = proved.modes.len() == self.modes.len() && proved.status != Status::Undecided;
        let mut free: Vec<&ProvedMode> = proved.modes.iter().collect();
        let size = self.size;
        for mode in &mut self.modes {
            mode.proof = Verdict::Undecided;
            let pose = [mode.pose.x, mode.pose.y, mode.pose.phi];
            let distance = |candidate: &ProvedMode| {
                let away = |k: usize, value: f64| {
                    let [lo, hi] = candidate.pose_box[k];
                    (lo - value).max(value - hi).max(0.0)
                };
                let turn = away(2, pose[2]).min(away(2, pose[2] + TAU)).min(away(2, pose[2] - TAU));
                let size = size.max(pose[0].abs()).max(pose[1].abs()).max(f64::MIN_POSITIVE);
                let shift = away(0, pose[0]).max(away(1, pose[1])) / size;
                turn.max(shift)
            };
            let nearest = (0..free.len()).min_by(|&i, &j| distance(free[i]).total_cmp(&distance(free[j])));
            if let Some(nearest) = nearest.filter(|_| matching) {
                mode.pose_box = Some(free.remove(nearest).pose_box);
                mode.proof = Verdict::Proven;
            }
        }
        // Where a mode is out of range the answer says so already.
        if proved.status == Status::Undecided || (!matching && self.limit.is_none()) {
            self.give_up(Limit::Size);
        }
        self.conclude(subject, proved.indistinct, rounded_offset);
    }
}
