//! Many polynomials at once, by loops over a block of them.

use std::array::from_fn;

use super::cells::{CELLS, Cell, QUARTER, TABLE, Turned, changes, error_at, halves, on_sides, sort_out};
use super::queue::RootQueue;
use super::{FORM, Harmonics};
use crate::algebra::Lanes;

/// Polynomials of a block, one number of each beside that of the next, and their forms. Filled again and again, by [`HarmonicBlock::put_samples`]: clearing it would
/// take time.
pub(crate) struct HarmonicBlock<const B: usize> {
    waves: [[f64; B]; 7],
    error: [f64; B],
    in_range: [u64; B],
    forms: [[[f64; B]; FORM]; CELLS],
    opened: Opened,
    /// How many places are filled, also by repetition.
    filled: usize,
}

impl<const B: usize> HarmonicBlock<B> {
    /// Without polynomials.
    pub(crate) const EMPTY: Self = Self {
        waves: [[0.0; B]; 7],
        error: [0.0; B],
        in_range: [0; B],
        forms: [[[0.0; B]; FORM]; CELLS],
        opened: Opened::EMPTY,
        filled: 0,
    };

    /// The first `filled` polynomials, with these values at eight angles; see [`Harmonics::from_samples`].
    #[inline(always)]
    pub(crate) fn put_samples(&mut self, values: &[[f64; B]; 8], order: usize, error: &[f64; B], filled: usize) {
        let turns = TABLE.turns;
        self.filled = filled.min(B);
        for i in 0..self.filled {
            let mut own = [0.0; 8];
            for k in 0..8 {
                own[k] = values[k][i];
            }
            let turned = Turned::of(&Harmonics::from_samples(&own, order, error[i]), &turns);
            for k in 0..7 {
                self.waves[k][i] = turned.waves[k];
            }
            (self.error[i], self.in_range[i]) = (turned.error, u64::from(turned.in_range));
        }
    }

    /// Adds the cells with one root each of the first `count` polynomials to a queue; a bit for each that the bound does not tell.
    #[inline(always)]
    pub(crate) fn isolate<const CAPACITY: usize>(&mut self, count: usize, queue: &mut RootQueue<CAPACITY>) -> u64 {
        const { assert!(B <= 64, "a bit for each") };
        let table = &*TABLE;
        let Self { waves, error, in_range, forms, .. } = self;
        let (waves, error, in_range) = (*waves, *error, *in_range);
        let filled = self.filled.min(B);
        for l in 0..QUARTER {
            for j in 0..FORM {
                let functions = table.coefficients[j];
                for i in 0..filled {
                    let (mut own, mut own_waves) = ([Lanes([0.0]); 7], [Lanes([0.0]); 7]);
                    for k in 0..7 {
                        own[k] = Lanes([functions[k].0[l]]);
                        own_waves[k] = Lanes([waves[k][i]]);
                    }
                    let [own, opposite, mirrored, other] = on_sides(own, own_waves);
                    forms[8 + l][j][i] = own.0[0];
                    forms[l][j][i] = opposite.0[0];
                    forms[7 - l][j][i] = mirrored.0[0];
                    forms[15 - l][j][i] = other.0[0];
                }
            }
        }
        // A bit for each cell: one change of sign for certain; more for certain; a sign in doubt.
        let [mut one, mut many, mut doubt, mut count_of] = [[0u64; B]; 4];
        let mut least_of = [0.0; B];
        for (which, form) in forms.iter().enumerate() {
            for i in 0..filled {
                let mut own = [Lanes([0.0]); FORM];
                for j in 0..FORM {
                    own[j] = Lanes([form[j][i]]);
                }
                let ([changes], least) = changes(&own);
                (count_of[i], least_of[i]) = (changes, least.0[0]);
            }
            let bit = 1 << which;
            for i in 0..filled {
                let certain = least_of[i] > error[i];
                one[i] |= if (count_of[i] == 1) & certain { bit } else { 0 };
                many[i] |= if (count_of[i] > 1) & certain { bit } else { 0 };
                doubt[i] |= if certain { 0 } else { bit };
            }
        }
        let mut undecided = 0;
        self.opened.count = 0;
        for i in 0..count {
            if in_range[i] == 0 {
                undecided |= 1 << i;
                continue;
            }
            let cell = |which: u32| Cell::whole(from_fn(|j| forms[which as usize][j][i]), which, i as u32);
            let (mut one, mut many, mut doubt) = (one[i], many[i], doubt[i]);
            while one != 0 {
                queue.push(&cell(one.trailing_zeros()));
                one &= one - 1;
            }
            // A sign in doubt does not always mean halving: one between opposite ones makes no difference.
            while doubt != 0 {
                undecided |= u64::from(sort_out(&cell(doubt.trailing_zeros()), error[i], queue).is_none()) << i;
                doubt &= doubt - 1;
            }
            while many != 0 {
                let cell = cell(many.trailing_zeros());
                many &= many - 1;
                if self.opened.put(&cell).is_none() && sort_out(&cell, error[i], queue).is_none() {
                    undecided |= 1 << i;
                }
            }
        }
        for _ in 0..LEVELS {
            undecided |= self.opened.halve(&error, queue);
        }
        undecided | self.opened.sort_out(&error, queue)
    }
}

/// Cells with several changes of sign for certain; more at a time are rare, and taken one by one.
struct Opened {
    count: usize,
    cells: [Cell; OPENED],
    /// The largest modulus of a coefficient of the whole cell.
    largest: [f64; OPENED],
}

const OPENED: usize = 32;

/// Halvings side by side; few cells are left then.
const LEVELS: usize = 3;

impl Opened {
    const EMPTY: Self = Self {
        count: 0,
        cells: [Cell { coefficients: [0.0; FORM], from: 0.0, width: 0.0, which: 0, owner: 0, depth: 0 }; OPENED],
        largest: [0.0; OPENED],
    };

    /// Adds a whole cell; `None` where there is no room.
    #[inline(always)]
    fn put(&mut self, cell: &Cell) -> Option<()> {
        let mut largest = cell.coefficients[0].abs();
        for c in &cell.coefficients[1..] {
            largest = if c.abs() > largest { c.abs() } else { largest };
        }
        self.put_part(cell, largest)
    }

    #[inline(always)]
    fn put_part(&mut self, cell: &Cell, largest: f64) -> Option<()> {
        *self.cells.get_mut(self.count)? = *cell;
        self.largest[self.count] = largest;
        self.count += 1;
        Some(())
    }

    /// Replaces all cells by those halves that are still open, and queues those with one root; a bit for each owner whose bound does not tell.
    #[inline(always)]
    fn halve<const CAPACITY: usize>(&mut self, error: &[f64], queue: &mut RootQueue<CAPACITY>) -> u64 {
        let count = self.count.min(OPENED);
        let mut forms = [[[0.0; OPENED]; FORM]; 2];
        let mut bound = [0.0; OPENED];
        for (k, cell) in self.cells.iter().enumerate().take(count) {
            for j in 0..FORM {
                forms[0][j][k] = cell.coefficients[j];
            }
            bound[k] = error_at(error[cell.owner as usize % error.len()], self.largest[k], cell.depth + 1);
        }
        // 0, 1: as many changes; 2: more; 3: in doubt.
        let mut kind = [[0u64; OPENED]; 2];
        for k in 0..count {
            let mut form = [Lanes([0.0]); FORM];
            for j in 0..FORM {
                form[j] = Lanes([forms[0][j][k]]);
            }
            let halves = halves(form);
            for side in 0..2 {
                for j in 0..FORM {
                    forms[side][j][k] = halves[side][j].0[0];
                }
                let ([changes], least) = changes(&halves[side]);
                kind[side][k] = if least.0[0] > bound[k] { changes.min(2) } else { 3 };
            }
        }
        let mut undecided = 0;
        let mut whole_cells = [(Cell::default(), 0.0); OPENED];
        for (k, whole) in whole_cells.iter_mut().enumerate().take(count) {
            *whole = (self.cells[k], self.largest[k]);
        }
        self.count = 0;
        for (k, (whole, largest)) in whole_cells.iter().enumerate().take(count) {
            for side in 0..2 {
                if kind[side][k] == 0 {
                    continue;
                }
                let width = 0.5 * whole.width;
                let half = Cell {
                    coefficients: from_fn(|j| forms[side][j][k]),
                    from: whole.from + if side == 0 { 0.0 } else { width },
                    width,
                    depth: whole.depth + 1,
                    ..*whole
                };
                if kind[side][k] == 1 {
                    queue.push(&half);
                } else if kind[side][k] == 3 || self.put_part(&half, *largest).is_none() {
                    undecided |= self.sort_out_one(&half, *largest, error, queue);
                }
            }
        }
        undecided
    }

    /// Books what is left, one by one.
    #[inline(always)]
    fn sort_out<const CAPACITY: usize>(&mut self, error: &[f64], queue: &mut RootQueue<CAPACITY>) -> u64 {
        let mut undecided = 0;
        for k in 0..self.count.min(OPENED) {
            undecided |= self.sort_out_one(&self.cells[k], self.largest[k], error, queue);
        }
        undecided
    }

    #[inline(always)]
    fn sort_out_one<const CAPACITY: usize>(
        &self,
        cell: &Cell,
        largest: f64,
        error: &[f64],
        queue: &mut RootQueue<CAPACITY>,
    ) -> u64 {
        let owner = cell.owner as usize % error.len();
        u64::from(cell.sort_out(error[owner], largest, queue).is_none()) << owner
    }
}
