//! The real modes of many triads: those of one shape together, by the block.

use arrayvec::ArrayVec;
use pulp::NullaryFnOnce;

use super::assemblies::Status;
use super::block::{BLOCK, BlockSolver, Shape};
use super::group::{Pose, Triad};
use super::real_modes::{ARCH, MOST_MODES};

/// Finds the modes of each triad, and hands them to `put` with the triad's place: `x, y, phi` each, sorted, and whether they are all.
///
/// The same as [`Triad::real_modes`] one by one, to the last bit; in no order.
pub(crate) fn real_modes_of_many(triads: &[Triad], mut put: impl FnMut(usize, &[[f64; 3]], Status)) {
    let mut left: Vec<(usize, Shape)> = Vec::with_capacity(triads.len());
    for (place, triad) in triads.iter().enumerate() {
        match Shape::of(triad) {
            Some(shape) => left.push((place, shape)),
            None => put_alone(place, triad, &mut put),
        }
    }
    let mut solver = Box::new(BlockSolver::new());
    // As a rule three shapes, by the leg that serves as reference.
    while let Some(&(first, shape)) = left.first() {
        let (alike, others): (Vec<_>, Vec<_>) = left.into_iter().partition(|(_, other)| *other == shape);
        left = others;
        let order = triads[first].order().expect("a triad with a shape has an order");
        for block in alike.chunks(BLOCK) {
            let own: ArrayVec<&Triad, BLOCK> = block.iter().map(|&(place, _)| &triads[place]).collect();
            ARCH.dispatch(Solve { solver: &mut solver, triads: &own, shape, order });
            for (k, &(place, _)) in block.iter().enumerate() {
                if solver.undecided >> k & 1 == 1 {
                    put_alone(place, &triads[place], &mut put);
                } else {
                    put(place, &solver.poses[k][..usize::from(solver.counts[k])], Status::Complete);
                }
            }
        }
    }
}

/// What no block decides: by intervals or by integers.
#[cold]
fn put_alone(place: usize, triad: &Triad, put: &mut impl FnMut(usize, &[[f64; 3]], Status)) {
    let found = triad.real_modes();
    let poses: ArrayVec<[f64; 3], MOST_MODES> =
        found.modes().iter().map(|mode| mode.pose).map(|Pose { x, y, phi }| [x, y, phi]).collect();
    put(place, &poses, found.status);
}

/// A block, compiled for each kind of SIMD register: everything it calls must be inlined.
struct Solve<'a> {
    solver: &'a mut BlockSolver,
    triads: &'a [&'a Triad],
    shape: Shape,
    order: usize,
}

impl NullaryFnOnce for Solve<'_> {
    type Output = ();
    #[inline(always)]
    fn call(self) {
        self.solver.solve(self.triads, self.shape, self.order);
    }
}
