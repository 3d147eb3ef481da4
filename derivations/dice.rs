//! Seeded numbers: the same on every run.

use assur::algebra::{Gaussian, Integer};

/// A generator of small integers and exact rotations (splitmix64).
pub struct Dice(u64);

impl Dice {
    /// A generator with this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// One of the `2 size + 1` integers from `-size` to `size`.
    pub fn integer(&mut self, size: u32) -> i64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z % (2 * u64::from(size) + 1)) as i64 - i64::from(size)
    }

    /// A rotation as a Pythagorean triple: `(p + iq)^2` and its modulus `p^2 + q^2`.
    pub fn turn(&mut self) -> (Gaussian<Integer>, Integer) {
        let (p, q) = (self.integer(1_000_000), self.integer(1_000_000));
        if p == 0 && q == 0 {
            return self.turn();
        }
        (Gaussian::new(Integer::from(p * p - q * q), Integer::from(2 * p * q)), Integer::from(p * p + q * q))
    }
}
