//! Solves the triads of a kind a given number of times and prints how many modes it found: what `instructions.sh` counts the instructions of.
//!
//! `cargo run --release --example instructions -- 3` solves 1000 random RR-RR-RR three times.

use assur::nalgebra::Vector2;
use assur::{Dyad, Triad};

fn main() {
    let rounds = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(1);
    let mut state = 4u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut planted = || {
        let (x, y, turn) = (5.0 * next(), 5.0 * next(), std::f64::consts::PI * next());
        let mut leg = || {
            let (a, b) = (Vector2::new(5.0 * next(), 5.0 * next()), Vector2::new(5.0 * next(), 5.0 * next()));
            let joint = Vector2::new(x + turn.cos() * b.x - turn.sin() * b.y, y + turn.sin() * b.x + turn.cos() * b.y);
            Dyad::RR { a, b, length: (joint - a).norm() }
        };
        Triad::new([leg(), leg(), leg()]).expect("finite numbers")
    };
    let triads: Vec<Triad> = (0..1000).map(|_| planted()).collect();
    let mut modes = 0;
    for _ in 0..rounds {
        modes += triads.iter().map(|triad| std::hint::black_box(triad).real_modes().modes().len()).sum::<usize>();
    }
    println!("{modes} modes of {} triads", 1000 * rounds);
}
