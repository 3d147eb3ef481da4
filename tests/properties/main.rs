//! Laws that hold for every triad and every manipulator, tried on random ones and on troublesome ones.
//!
//! Every property runs on a fixed seed, [`SEED`], which proptest prints with a failure.

mod closure;
mod counts;
mod degenerate;
mod laws;
mod legs;
mod planted;
mod questions;
mod sturm;
mod triads;
mod troubled;

use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, RngSeed};

/// The seed of all properties here.
const SEED: u64 = 20_030_526;

/// Enough cases for a property, always the same ones.
fn cases(count: u32) -> ProptestConfig {
    println!("{count} cases from seed {SEED}");
    ProptestConfig {
        cases: count,
        rng_algorithm: RngAlgorithm::ChaCha,
        rng_seed: RngSeed::Fixed(SEED),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// A coordinate: anything, a small integer, or a sixteenth.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..10.0,
        2 => (-6i32..=6).prop_map(f64::from),
        1 => (-64i32..=64).prop_map(|n| f64::from(n) / 16.0),
    ]
}

/// The numbers of a leg, see [`planted::planted_leg`].
fn leg_numbers() -> impl Strategy<Value = [f64; 7]> {
    prop::array::uniform7(coordinate())
}

/// Where a platform is put.
fn pose() -> impl Strategy<Value = assur::Pose> {
    (coordinate(), coordinate(), -3.2..3.2).prop_map(|(x, y, phi)| assur::Pose::new(x, y, phi))
}
