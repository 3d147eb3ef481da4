//! Is any assembly mode ever missed? Triads with a planted pose by the hundred thousand.
//!
//! `cargo run --release --example sweep` solves 100,000 planted RR-RR-RR and 10,000 of each other triad; `-- N` asks for N and N/10.
//! Every planted pose must be among the modes, every root must satisfy the closure equations, and 10,000 (N/10) counts of real modes
//! must agree with Sturm's sequence. The exit code is 1 where something does not.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use assur::{Dyad, Offset, Status, Triad};
use rayon::prelude::*;

#[path = "../tests/properties/closure.rs"]
mod closure;
#[path = "../tests/properties/planted.rs"]
mod planted;
#[path = "../tests/properties/sturm.rs"]
mod sturm;

use closure::{complex_error, determinant, real_error};
use planted::{Random, TRIADS, miss, planted_triad};
use sturm::real_orientations;

/// The first seed; each triad has one of its own.
const SEED: u64 = 20_030_526;

/// Angle, or length over the triad's size, within which a planted pose counts as found.
const FOUND: f64 = 1e-9;

/// Rounding a leg's length moves the pose by about this over det A; where that is more than [`FOUND`], it is allowed.
const ROUNDING: f64 = 1e-14;

/// Largest closure error of a real mode in units of the size, and of a complex one relative to its terms.
const CLOSED: f64 = 1e-13;

/// What happened to some triads.
#[derive(Clone, Default)]
struct Tally {
    solved: usize,
    /// Planted poses that are not among the modes, and their seeds.
    missed: Vec<u64>,
    /// Roots that miss closure, accounts that do not add up, answers that are undecided.
    unsound: Vec<u64>,
    compared: usize,
    /// Counts of real modes that differ from Sturm's.
    miscounted: Vec<u64>,
    worst_planted: f64,
    worst_real: f64,
    worst_complex: f64,
    nearest_singular: f64,
    /// How many triads have 0, 1, 2 … modes.
    modes: [usize; 7],
    time: Duration,
    slowest: Duration,
}

impl Tally {
    fn of(names: [&str; 3], seed: u64, compare: bool) -> Self {
        let (triad, pose) = planted_triad(names, &mut Random::new(seed));
        let triad = if compare { with_delta(&triad) } else { triad };
        let start = Instant::now();
        let answer = triad.assemble();
        let time = start.elapsed();
        let mut out = Self { solved: 1, time, slowest: time, ..Self::default() };
        out.modes[answer.modes.len()] = 1;
        let translating = names.iter().filter(|name| **name == "PP").count();
        if translating > 1 {
            // One orientation given twice over: a motion, and nothing else.
            if answer.status != Status::SelfMotion || !answer.modes.is_empty() {
                out.missed.push(seed);
            }
            out.nearest_singular = f64::INFINITY;
            return out;
        }
        out.nearest_singular = determinant(triad.legs(), &pose, answer.size).abs();
        out.worst_planted = miss(&answer, &pose);
        if out.worst_planted > FOUND.max(ROUNDING / out.nearest_singular) {
            out.missed.push(seed);
        }
        for mode in &answer.modes {
            let size = answer.size.max(mode.pose.x.hypot(mode.pose.y));
            out.worst_real = out.worst_real.max(real_error(triad.legs(), &mode.pose, size) / size);
        }
        for mode in &answer.complex {
            let error = complex_error(triad.legs(), answer.size, mode.theta, mode.z, mode.w);
            out.worst_complex = out.worst_complex.max(error);
        }
        let settled = answer.status == Status::Complete && answer.account.adds_up();
        if !settled || out.worst_real > CLOSED || out.worst_complex > CLOSED {
            out.unsound.push(seed);
        }
        if compare && translating == 0 {
            out.compared = 1;
            if real_orientations(triad.legs()) != Some(answer.account.real) {
                out.miscounted.push(seed);
            }
        }
        out
    }

    fn and(mut self, other: Self) -> Self {
        self.solved += other.solved;
        self.missed.extend(other.missed);
        self.unsound.extend(other.unsound);
        self.compared += other.compared;
        self.miscounted.extend(other.miscounted);
        self.worst_planted = self.worst_planted.max(other.worst_planted);
        self.worst_real = self.worst_real.max(other.worst_real);
        self.worst_complex = self.worst_complex.max(other.worst_complex);
        self.nearest_singular = self.nearest_singular.min(other.nearest_singular);
        self.modes.iter_mut().zip(other.modes).for_each(|(mine, more)| *mine += more);
        self.time += other.time;
        self.slowest = self.slowest.max(other.slowest);
        self
    }

    fn none() -> Self {
        Self { nearest_singular: f64::INFINITY, ..Self::default() }
    }

    fn sound(&self) -> bool {
        self.missed.is_empty() && self.unsound.is_empty() && self.miscounted.is_empty()
    }

    fn line(&self, name: &str) -> String {
        let mean = self.time.as_secs_f64() / self.solved.max(1) as f64 * 1e6;
        let slowest = self.slowest.as_secs_f64() * 1e6;
        format!(
            "{name:<9} {:>7} {:>6} {:>7} {:>6}/{:<6} {:>8.1e} {:>8.1e} {:>8.1e} {:>8.1e} {mean:>7.0} {slowest:>8.0}  {:?}",
            self.solved,
            self.missed.len(),
            self.unsound.len(),
            self.miscounted.len(),
            self.compared,
            self.worst_planted,
            self.worst_real,
            self.worst_complex,
            self.nearest_singular,
            self.modes,
        )
    }
}

/// RP offsets as `delta`, a dyadic number for both counts.
fn with_delta(triad: &Triad) -> Triad {
    let legs = triad.legs().map(|leg| match leg {
        Dyad::RP { a, b, v, offset: Offset::Distance(d) } => {
            Dyad::RP { a, b, v, offset: Offset::TimesDirection(d * v.norm()) }
        }
        other => other,
    });
    Triad::new(legs).expect("numbers are still finite")
}

fn main() -> ExitCode {
    let argument = std::env::args().nth(1);
    let Ok(count) = argument.as_deref().unwrap_or("100000").parse::<u64>() else {
        eprintln!("usage: sweep [N], the number of RR-RR-RR triads; a tenth of it of each other triad");
        return ExitCode::from(2);
    };
    println!(
        "seed {SEED}; errors of planted poses and of real modes over the size, of complex ones relative; times in µs"
    );
    println!(
        "{:<9} {:>7} {:>6} {:>7} {:>13} {:>8} {:>8} {:>8} {:>8} {:>7} {:>8}  triads with 0, 1, … 6 modes",
        "triad", "solved", "missed", "unsound", "miscounted", "planted", "real", "complex", "det A", "mean", "slowest"
    );
    let mut all = Tally::none();
    for (number, names) in (0..).zip(TRIADS) {
        let triads = if number == 0 { count } else { count.div_ceil(10) };
        // 10,000 exact counts in all for N = 100,000: half of them RR-RR-RR, the rest spread over the nine others without PP.
        let compared = if number == 0 { count / 20 } else { count.div_ceil(180) };
        let mut tally = Tally::none();
        let part = triads.div_ceil(10).max(1);
        for from in (0..triads).step_by(part as usize) {
            let to = (from + part).min(triads);
            let seed = |k: u64| SEED + number * 1_000_000_007 + k * 7_919;
            let done = (from..to).into_par_iter().map(|k| Tally::of(names, seed(k), k < compared));
            tally = tally.and(done.reduce(Tally::none, Tally::and));
            if number == 0 {
                eprintln!("{to} of {triads}");
            }
        }
        println!("{}", tally.line(&names.join("-")));
        for (what, seeds) in [("missed", &tally.missed), ("unsound", &tally.unsound), ("miscounted", &tally.miscounted)]
        {
            if !seeds.is_empty() {
                println!("  {what} with the seeds {:?}", &seeds[..seeds.len().min(10)]);
            }
        }
        all = all.and(tally);
    }
    println!("{}", all.line("all"));
    if all.sound() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
