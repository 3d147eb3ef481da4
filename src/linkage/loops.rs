//! Loops of rotating links, closed through a Dixon pencil: candidates for every solution.
//!
//! `l` loops `c_k0 + c_kh x + sum_j c_kj theta_j = 0` with their conjugates say everything about `2l` rotations. The pencil in the hidden
//! rotation `x` becomes a real eigenproblem on the unit circle ([`DixonPencil::on_unit_circle`]), which is fast but may lose solutions where
//! its linear part is nearly singular; the QZ algorithm on the complex pencil is the slower way that needs no inverse. Neither
//! is trusted: whoever asks refines what comes, and counts.

use num_complex::Complex64;

use crate::eliminate::DixonPencil;
use crate::roots::{pencil_eigenpairs, real_pencil_eigenpairs};

/// How the eigenpairs are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Route {
    /// The real eigenproblem on the unit circle: several times as fast. Measured: 20 rows 0.12 ms for 0.28, 70 rows 2 ms for 10.
    UnitCircle,
    /// The QZ algorithm.
    Qz,
}

/// What may be a solution.
pub(super) struct Candidate {
    /// The hidden rotation.
    pub(super) hidden: Complex64,
    /// The others, in the order of their columns.
    pub(super) others: Vec<Complex64>,
    /// Whether its mirror image `1 / conj(theta)` is a candidate too, which is then not listed on its own.
    pub(super) paired: bool,
}

/// The point of the unit circle that the real parameter misses is turned by so much, in radians, until no solution lies near: any angles do
/// that have nothing to do with those of drawings.
const TURNS: [f64; 3] = [2.0, -0.4, 1.1];

/// A hidden rotation closer to zero or infinity than this belongs to no solution of interest (as for [`crate::roots::Eigenpair::value`]).
const EXTREME: f64 = 1e-12;

/// Candidates for the solutions of loops; `None` where the route does not lead through.
///
/// **Shape:** one row a loop: the constant, the coefficient of the hidden rotation, those of the others.
pub(super) fn candidates(loops: &[Vec<Complex64>], route: Route) -> Option<Vec<Candidate>> {
    match route {
        Route::UnitCircle => TURNS.iter().find_map(|&turn| on_unit_circle(loops, turn)),
        Route::Qz => by_qz(loops),
    }
}

fn pencil(loops: &[Vec<Complex64>]) -> DixonPencil<Complex64> {
    let conjugates: Vec<Vec<Complex64>> = loops.iter().map(|row| row.iter().map(Complex64::conj).collect()).collect();
    DixonPencil::new(loops, &conjugates).expect("l loops with 2l rotations")
}

fn on_unit_circle(loops: &[Vec<Complex64>], turn: f64) -> Option<Vec<Candidate>> {
    let turn = Complex64::from_polar(1.0, turn);
    let mut turned = loops.to_vec();
    turned.iter_mut().for_each(|row| row[1] *= turn);
    let pencil = pencil(&turned);
    let real = pencil.on_unit_circle();
    let pairs = real_pencil_eigenpairs(&real.constant, &real.linear)?;
    let candidate = |pair: &crate::roots::RealPencilPair| {
        let tangent = Complex64::I * pair.value;
        let (above, below) = (1.0 + tangent, 1.0 - tangent);
        let squares = [above, below].map(|z| z.norm_sqr());
        if squares[0] <= EXTREME * EXTREME * squares[1] || squares[1] <= EXTREME * EXTREME * squares[0] {
            return None;
        }
        let others = pencil.unknowns(&real.entries(&pair.vector))?;
        Some(Candidate { hidden: turn * above / below, others, paired: pair.value.im != 0.0 })
    };
    Some(pairs.iter().filter_map(candidate).collect())
}

fn by_qz(loops: &[Vec<Complex64>]) -> Option<Vec<Candidate>> {
    let pencil = pencil(loops);
    let eigen = pencil_eigenpairs(pencil.constant(), pencil.linear()).ok()?;
    let candidate = |pair: &crate::roots::Eigenpair| {
        let (hidden, others) = (pair.value()?, pencil.unknowns(&pair.vector)?);
        Some(Candidate { hidden, others, paired: false })
    };
    Some(eigen.pairs.iter().filter_map(candidate).collect())
}
