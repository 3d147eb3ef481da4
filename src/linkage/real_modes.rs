//! All real assembly modes, fast.
//!
//! `T(phi)` is evaluated at eight orientations side by side, with one bound on all rounding errors; its real roots are counted with a proof and found on
//! the circle ([`crate::roots::circle`]); above each the pose is taken from two rows, refined by Newton's method on the loop equations, and measured on the
//! geometry. Nothing is allocated. Many triads take the same steps by the block ([`super::many`]), with the same results to the last bit. Wherever a bound does not decide, or a pose would have fewer than nine sure digits, the reference
//! route ([`Triad::assemble`]) answers instead.
//!
//! What it does not give: non-real solutions, boxes, the account; and triads with a PP leg always take the reference route.

use std::sync::LazyLock;

use super::assemblies::{AssemblyMode, Status};
use super::closure_row::{MARGIN, closure_rows, proved_radii};
use super::group::{Pose, Triad};
use super::local::{Local, rows, sort};
use super::loop_box::{IntervalTriad, PoseIntervals};
use super::poses::{Approach, LAST_STEP, Measured, STEPS, best_crossing, crossing, measure, principal, sound};
use super::triad::Rows;
use crate::algebra::{Gaussian, Interval, Lanes};
use crate::roots::{CountedRoots, Harmonics, RootQueue, RootsFound, WIDTH};

/// As many isolated real modes as any triad has.
pub const MOST_MODES: usize = 6;

/// Which way an answer was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModesRoute {
    /// In floating point; its error bound proved the count.
    Fast,
    /// The reference route, over integers, since the bound did not decide.
    Reference,
}

/// A real assembly mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RealMode {
    /// The pose of the platform.
    pub pose: Pose,
    /// How many modes meet here.
    pub multiplicity: usize,
    /// Largest closure error of the assembled group over its largest length, measured on the geometry.
    pub residual: f64,
    /// As [`AssemblyMode::det_a`].
    pub det_a: f64,
}

const NO_MODE: RealMode =
    RealMode { pose: Pose { x: 0.0, y: 0.0, phi: 0.0 }, multiplicity: 0, residual: 0.0, det_a: 0.0 };

const NONE_YET: RealModes =
    RealModes { modes: [NO_MODE; MOST_MODES], count: 0, status: Status::Complete, route: ModesRoute::Fast };

/// All real assembly modes of a triad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RealModes {
    modes: [RealMode; MOST_MODES],
    count: usize,
    /// `Complete`: these are all. `SelfMotion`: there is also a curve of poses. `Undecided`: the list may be short.
    pub status: Status,
    /// Which way they were found.
    pub route: ModesRoute,
}

impl RealModes {
    /// The modes, sorted by `phi`, `x`, `y`.
    pub fn modes(&self) -> &[RealMode] {
        &self.modes[..self.count]
    }
}

impl Triad {
    /// Every real assembly mode, fast: the same modes as [`Triad::assemble`] lists.
    ///
    /// **Shape**: at most six modes, sorted by `phi`, then `x`, then `y`. **Units and frame**: as [`Triad::assemble`]. **Accuracy**: at least nine digits of the
    /// distance from the group, as a rule fifteen. **Proof**: the number of roots of `T` is exact, by a bound on all rounding errors or by integers;
    /// poses above them are measured (closure, regularity, their part of the circle), and [`Triad::prove`] boxes them.
    /// **Cost**: about a microsecond, a millisecond where the bound does not decide (about one random triad in a hundred thousand; `benches/real_modes.rs`).
    ///
    /// ```
    /// use assur::{Dyad, ModesRoute, Triad};
    /// let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
    /// let triad = Triad::new([
    ///     leg([0.0, 0.0], [0.0, 0.0], 14.98),
    ///     leg([15.91, 0.0], [17.045, 0.0], 15.38),
    ///     leg([0.0, 10.0], [13.2389, 16.0929], 12.0),
    /// ])?;
    /// let found = triad.real_modes();
    /// assert_eq!((found.modes().len(), found.route), (6, ModesRoute::Fast));
    /// assert!(found.modes().iter().all(|mode| mode.residual < 1e-15));
    /// # Ok::<(), assur::TriadError>(())
    /// ```
    pub fn real_modes(&self) -> RealModes {
        let mut out = NONE_YET;
        if !self.go_fast(&mut out, None) {
            out = self.real_modes_reference();
        }
        out
    }

    /// The fast way alone; `None` where its bounds do not decide.
    pub fn real_modes_fast(&self) -> Option<RealModes> {
        let mut out = NONE_YET;
        self.go_fast(&mut out, None).then_some(out)
    }

    /// The fast way with a box around each mode, each proved to hold exactly one assembly; in no order.
    pub(super) fn boxes_fast(&self) -> Option<(Boxes, usize)> {
        let (mut out, mut boxes) = (NONE_YET, [[Interval::ZERO; 3]; MOST_MODES]);
        self.go_fast(&mut out, Some(&mut boxes)).then_some((boxes, out.count))
    }

    /// Whether the bounds decide.
    fn go_fast(&self, out: &mut RealModes, boxes: Option<&mut Boxes>) -> bool {
        fast(self, out, boxes).is_some()
    }

    /// The reference way, in the same form.
    #[cold]
    pub fn real_modes_reference(&self) -> RealModes {
        let answer = self.assemble();
        let mut out =
            RealModes { modes: [NO_MODE; MOST_MODES], count: 0, status: answer.status, route: ModesRoute::Reference };
        for AssemblyMode { pose, multiplicity, residual, det_a, .. } in answer.modes {
            out.modes[out.count] = RealMode { pose, multiplicity, residual, det_a };
            out.count += 1;
        }
        out
    }
}

/// The processor's SIMD registers.
pub(super) static ARCH: LazyLock<pulp::Arch> = LazyLock::new(pulp::Arch::new);

/// `[x, y, phi]` of each mode, before sorting.
pub(super) type Boxes = [PoseIntervals; MOST_MODES];

/// Room for the roots of one triad, a multiple of the lanes worked on together.
const ROOM: usize = 8;

// Its steps, each compiled for each kind of SIMD register; what they call and is not inlined is compiled for the plainest. As one function, with its loop, they would take
// minutes to compile.

/// The first step: the cells of the roots; `Some(false)` where the bound does not tell, `None` with a PP leg or numbers out of range.
struct Isolate<'a> {
    triad: &'a Triad,
    local: &'a mut Option<Local>,
    queue: &'a mut RootQueue<ROOM>,
}

/// The second step: the roots of a group of cells, if they are not known, and the poses above them.
struct Lift<'a> {
    local: &'a Local,
    queue: &'a mut RootQueue<ROOM>,
    known: &'a Option<CountedRoots>,
    group: usize,
    out: &'a mut RealModes,
}

/// At the wish of the caller: boxes around the poses just booked.
struct Enclose<'a> {
    local: &'a Local,
    at: &'a Approach<WIDTH>,
    first: usize,
    used: usize,
    out: &'a RealModes,
    boxes: &'a mut Boxes,
}

impl pulp::NullaryFnOnce for Isolate<'_> {
    type Output = Option<bool>;
    #[inline(always)]
    fn call(self) -> Self::Output {
        let local = self.local.insert(Local::of(self.triad)?);
        let (values, bound) = local.values();
        Some(Harmonics::from_samples(&values, local.order, bound).isolate(self.queue).is_some())
    }
}

impl pulp::NullaryFnOnce for Lift<'_> {
    type Output = Option<Approach<WIDTH>>;
    #[inline(always)]
    fn call(self) -> Self::Output {
        let roots = match self.known {
            None => self.queue.find_abreast(self.group),
            Some(known) => known.group(self.group),
        };
        self.local.poses(&roots, WIDTH * self.group, self.out)
    }
}

impl pulp::NullaryFnOnce for Enclose<'_> {
    type Output = Option<()>;
    #[inline(always)]
    fn call(self) -> Self::Output {
        self.local.boxes(self.at, self.first, self.used, self.out, self.boxes)
    }
}

/// One of the steps; a function by itself also where there are no SIMD registers.
#[inline(never)]
fn step<S: pulp::NullaryFnOnce>(step: S) -> S::Output {
    ARCH.dispatch(step)
}

fn fast(triad: &Triad, out: &mut RealModes, mut boxes: Option<&mut Boxes>) -> Option<()> {
    let (mut local, mut queue) = (None, RootQueue::<ROOM>::default());
    let told = step(Isolate { triad, local: &mut local, queue: &mut queue })?;
    let local = local.as_ref().expect("the first step has put it there");
    let closer = if told { None } else { Some(closer_look(triad)?) };
    out.count = closer.as_ref().map_or(queue.len(), CountedRoots::count);
    for group in 0..out.count.div_ceil(WIDTH) {
        let (first, used) = (WIDTH * group, (out.count - WIDTH * group).min(WIDTH));
        let at = step(Lift { local, queue: &mut queue, known: &closer, group, out })?;
        if let Some(boxes) = boxes.as_deref_mut() {
            step(Enclose { local, at: &at, first, used, out, boxes })?;
        }
    }
    sort(&mut out.modes[..out.count], |mode| mode.pose.phi);
    Some(())
}

/// The roots by coefficients in intervals: a closer bound, which some random triads in ten thousand need.
#[cold]
#[inline(never)]
fn closer_look(triad: &Triad) -> Option<CountedRoots> {
    let (even, odd) = IntervalTriad::of(triad)?.consistency();
    Harmonics::from_powers(&even, &odd).real_roots()
}

type L = Lanes<WIDTH>;

impl Local {
    /// The poses above roots side by side, of which those up to the count are booked from `first` on; `None` where one needs a second look.
    #[inline(always)]
    fn poses(&self, roots: &RootsFound<WIDTH>, first: usize, out: &mut RealModes) -> Option<Approach<WIDTH>> {
        let legs = &self.legs;
        let u = match &rows(legs, L::all, roots.cosine, roots.sine) {
            Rows::Circle { rows: [p, q], .. } => crossing(p, q).1,
            Rows::Lines(rows) => best_crossing(rows),
        };
        let mut at = Approach::begin(u, roots.cosine, roots.sine);
        at.step(&closure_rows(legs, at.u, at.c, at.s));
        let used = (out.count - first).min(WIDTH);
        let all = (1 << used) - 1;
        for _ in 1..STEPS {
            if at.step.at_most(L::all(LAST_STEP)) & all == all {
                break;
            }
            let before = at;
            at.step(&closure_rows(legs, at.u, at.c, at.s));
            at.stay_where_settled(&before);
        }
        let direction @ Gaussian { re: c, im: s } = at.direction();
        let leg = |k: usize| Measured::of(&legs[k], L::all, at.u, direction);
        let [residual, det, regular] = measure(&[leg(0), leg(1), leg(2)]);
        let inverse = L::all(1.0) / L::all(self.size);
        let (residual, det) = (residual * inverse, det * inverse);
        if sound(&at, roots, residual, regular) & all != all {
            return None;
        }
        let (phi, unit) = (principal(roots.angle + at.turned), L::all(self.unit));
        let [a0, b0] = [self.a0, self.b0].map(|[x, y]| Gaussian::new(L::all(x), L::all(y)));
        let x = a0.re + at.u.re * unit - (c * b0.re - s * b0.im);
        let y = a0.im + at.u.im * unit - (s * b0.re + c * b0.im);
        for i in 0..used {
            out.modes[first + i] = RealMode {
                pose: Pose { x: x.0[i], y: y.0[i], phi: phi.0[i] },
                multiplicity: 1,
                residual: residual.0[i],
                det_a: self.parity * det.0[i],
            };
        }
        Some(at)
    }

    /// Boxes around the poses just booked.
    #[inline(always)]
    fn boxes(&self, at: &Approach<WIDTH>, first: usize, used: usize, out: &RealModes, boxes: &mut Boxes) -> Option<()> {
        let Gaussian { re: c, im: s } = at.direction();
        let radii = proved_radii(&self.legs, self.roundings, at.u, c, s, used);
        for i in 0..used {
            let [ux, uy, turn] = radii.map(|r| r.0[i]);
            // NaN where nothing was proved.
            if !(ux + uy + turn).is_finite() {
                return None;
            }
            let Pose { x, y, phi } = out.modes[first + i].pose;
            let b0 = self.b0[0].abs() + self.b0[1].abs();
            let u = [at.u.re.0[i], at.u.im.0[i]].map(|u| u.abs() * self.unit);
            // Six roundings in x and y, and the direction's own.
            let shift = |radius: f64, a0: f64, u: f64| {
                (radius * self.unit + b0 * (turn + 4.0 * UNIT) + 6.0 * UNIT * (a0.abs() + u + b0)) * MARGIN
            };
            let radii = [shift(ux, self.a0[0], u[0]), shift(uy, self.a0[1], u[1]), turn + ANGLE_ERROR];
            let around = |k: usize, x: f64| Interval::around(x, radii[k]);
            boxes[first + i] = [around(0, x), around(1, y), around(2, phi)];
        }
        Some(())
    }
}

/// Unit roundoff of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;

/// A bound on the difference between the angle and the direction that were computed side by side: step 7 of the derivation.
const ANGLE_ERROR: f64 = 64.0 * UNIT;
