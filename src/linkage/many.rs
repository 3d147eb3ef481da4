//! The real modes of many triads: those of one shape together, by the block.

use arrayvec::ArrayVec;
use pulp::NullaryFnOnce;

use super::assemblies::Status;
use super::block::{ABREAST, BLOCK, BlockSolver, Shape};
use super::group::{Pose, Triad};
use super::real_modes::{ARCH, MOST_MODES};

/// Finds the modes of each triad, and hands them to `put` with the triad's place: `x, y, phi` each, sorted, and whether they are all.
///
/// The same as [`Triad::real_modes`] one by one, to the last bit; in no order.
pub(crate) fn real_modes_of_many(triads: &[Triad], mut put: impl FnMut(usize, &[[f64; 3]], Status)) {
    let mut shapes: Vec<Option<Shape>> = triads.iter().map(Shape::of).collect();
    for (place, _) in shapes.iter().enumerate().filter(|(_, shape)| shape.is_none()) {
        put_alone(place, &triads[place], &mut put);
    }
    let mut solver = None;
    let mut first = 0;
    // As a rule three shapes, by the leg that serves as reference.
    while let Some(next) = shapes[first..].iter().position(Option::is_some) {
        first += next;
        let (shape, order) = (shapes[first].take().expect("some"), triads[first].order().expect("it has a shape"));
        let mut block: ArrayVec<usize, BLOCK> = ArrayVec::from_iter([first]);
        let mut at = first + 1;
        loop {
            while at < triads.len() && !block.is_full() {
                if shapes[at] == Some(shape) {
                    shapes[at] = None;
                    block.push(at);
                }
                at += 1;
            }
            if block.is_empty() {
                break;
            }
            if block.len() < FEW {
                block.drain(..).for_each(|place| put_alone(place, &triads[place], &mut put));
                continue;
            }
            let own: ArrayVec<&Triad, BLOCK> = block.iter().map(|&place| &triads[place]).collect();
            let solver = solver.get_or_insert_with(|| Box::new(BlockSolver::new()));
            ARCH.dispatch(Solve { solver, triads: &own, shape, order });
            for (k, place) in block.drain(..).enumerate() {
                if solver.undecided >> k & 1 == 1 {
                    put_alone(place, &triads[place], &mut put);
                } else {
                    put(place, &solver.poses[k][..usize::from(solver.counts[k])], Status::Complete);
                }
            }
        }
    }
}

/// Fewer triads than this are solved one by one: a block takes as long as for a whole register of them, and there each takes two thirds of the time alone.
const FEW: usize = ABREAST / 2;

/// What no block takes or decides.
#[cold]
fn put_alone(place: usize, triad: &Triad, put: &mut impl FnMut(usize, &[[f64; 3]], Status)) {
    let found = triad.real_modes();
    let poses: ArrayVec<[f64; 3], MOST_MODES> =
        found.modes().iter().map(|mode| mode.pose).map(|Pose { x, y, phi }| [x, y, phi]).collect();
    put(place, &poses, found.status);
}

/// A block, compiled for each kind of SIMD register; what it calls and is not inlined is compiled for the plainest.
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
