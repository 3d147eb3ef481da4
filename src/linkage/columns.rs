//! Legs of many triads in columns.

use super::triad::LegNumbers;
use crate::algebra::Gaussian;

/// One number of each of several triads or roots.
pub(super) type Column<const N: usize> = [f64; N];

/// Passive joints of a leg, base first: RR, PR, RP.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Circle,
    Line,
    PlatformLine,
}

impl Kind {
    /// How many numbers such a leg has.
    pub(super) fn numbers(self) -> usize {
        match self {
            Self::Circle => 5,
            Self::Line => 6,
            Self::PlatformLine => 7,
        }
    }
}

/// A leg of each triad: `alpha`, `beta`, and its length, or its normal and delta.
pub(super) struct LegColumns<const N: usize> {
    pub(super) kind: Kind,
    pub(super) numbers: [Column<N>; 7],
}

impl<const N: usize> LegColumns<N> {
    pub(super) const EMPTY: Self = Self { kind: Kind::Circle, numbers: [[0.0; N]; 7] };

    #[inline(always)]
    pub(super) fn point(&self, at: usize, i: usize) -> Gaussian<f64> {
        Gaussian { re: self.numbers[at][i], im: self.numbers[at + 1][i] }
    }

    #[inline(always)]
    pub(super) fn circle(&self, i: usize) -> LegNumbers<f64> {
        LegNumbers::Circle { alpha: self.point(0, i), beta: self.point(2, i), length: self.numbers[4][i] }
    }

    #[inline(always)]
    pub(super) fn line(&self, i: usize) -> LegNumbers<f64> {
        LegNumbers::Line { alpha: self.point(0, i), beta: self.point(2, i), normal: self.point(4, i) }
    }

    #[inline(always)]
    pub(super) fn platform_line(&self, i: usize) -> LegNumbers<f64> {
        let (alpha, beta) = (self.point(0, i), self.point(2, i));
        LegNumbers::PlatformLine { alpha, beta, normal: self.point(4, i), delta: self.numbers[6][i] }
    }

    /// The leg of one triad.
    pub(super) fn leg(&self, i: usize) -> LegNumbers<f64> {
        match self.kind {
            Kind::Circle => self.circle(i),
            Kind::Line => self.line(i),
            Kind::PlatformLine => self.platform_line(i),
        }
    }
}

/// A loop over the legs of `LegColumns`, up to `count`. The kind is told apart outside of the loop, or it would not become SIMD instructions; a macro, since a
/// closure that is called from three loops is not inlined into them.
macro_rules! each_leg {
    ($columns:expr, $count:expr, |$i:ident, $leg:ident| $body:expr) => {
        match $columns.kind {
            Kind::Circle => {
                for $i in 0..$count {
                    let $leg = $columns.circle($i);
                    $body;
                }
            }
            Kind::Line => {
                for $i in 0..$count {
                    let $leg = $columns.line($i);
                    $body;
                }
            }
            Kind::PlatformLine => {
                for $i in 0..$count {
                    let $leg = $columns.platform_line($i);
                    $body;
                }
            }
        }
    };
}

pub(super) use each_leg;
