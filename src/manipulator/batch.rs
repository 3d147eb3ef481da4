//! Forward kinematics of many rows of inputs, or of many triads, at once.
//!
//! Each row takes the fast route ([`Triad::real_modes`]); rows are shared out over threads, and each writes into its own place, so that results do not
//! depend on how many threads there are. Results are flat arrays.
//!
//! What it does not give: joints, signs, accounts, non-real solutions; for those there is [`Manipulator::forward`]. A leg without actuator only
//! decides which poses it reaches.

use rayon::prelude::*;

use super::describe::Manipulator;
use super::lock::{LockError, LockedGroup};
use crate::linkage::{MOST_MODES, Pose, RealModes, Status, Triad};

/// Numbers a row has in [`ModesBatch::poses`].
const WIDTH: usize = 3 * MOST_MODES;

/// Rows that a thread takes at a time: some tenths of a millisecond.
const SHARE: usize = 1024;

/// All real assembly modes of many problems of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct ModesBatch {
    poses: Vec<f64>,
    counts: Vec<u8>,
    statuses: Vec<Option<Status>>,
    errors: Vec<(usize, LockError)>,
}

impl ModesBatch {
    fn of_rows(rows: usize, solve: impl Fn(usize) -> Result<RowModes, LockError> + Sync) -> Self {
        let mut out = Self {
            poses: vec![0.0; WIDTH * rows],
            counts: vec![0; rows],
            statuses: vec![None; rows],
            errors: Vec::new(),
        };
        let places = ModesPlaces { poses: &mut out.poses, counts: &mut out.counts, statuses: &mut out.statuses };
        out.errors = places.fill(solve);
        out
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.counts.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty()
    }

    /// The poses, **shape** `(rows, 6, 3)` in row order: `x, y, phi` of each mode, sorted by `phi`, `x`, `y`; zeros beyond the row's count.
    pub fn poses(&self) -> &[f64] {
        &self.poses
    }

    /// How many modes each row has; 0 also where it has an error: then its status is `None`.
    pub fn counts(&self) -> &[u8] {
        &self.counts
    }

    /// Whether each row's modes are all there are, or stand beside a curve of poses; `None` for a row with an error, of whose modes nothing is known.
    pub fn statuses(&self) -> &[Option<Status>] {
        &self.statuses
    }

    /// Rows, from 0, that could not be asked, each with the reason.
    pub fn errors(&self) -> &[(usize, LockError)] {
        &self.errors
    }
}

/// Where the modes of many rows are written: arrays of the caller's, with as many rows as there are rows of inputs.
#[derive(Debug)]
pub struct ModesPlaces<'a> {
    /// 18 numbers a row, as [`ModesBatch::poses`]; what lies beyond a row's count is left as it is.
    pub poses: &'a mut [f64],
    /// As [`ModesBatch::counts`].
    pub counts: &'a mut [u8],
    /// As [`ModesBatch::statuses`].
    pub statuses: &'a mut [Option<Status>],
}

impl ModesPlaces<'_> {
    fn fill(self, solve: impl Fn(usize) -> Result<RowModes, LockError> + Sync) -> Vec<(usize, LockError)> {
        let shares = self
            .poses
            .par_chunks_mut(WIDTH * SHARE)
            .zip(self.counts.par_chunks_mut(SHARE))
            .zip(self.statuses.par_chunks_mut(SHARE))
            .enumerate();
        let errors = shares.map(|(share, ((poses, counts), statuses))| {
            let mut errors = Vec::new();
            let rows = poses.chunks_exact_mut(WIDTH).zip(counts).zip(statuses);
            for (row, ((poses, count), status)) in (SHARE * share..).zip(rows) {
                match solve(row) {
                    Ok(found) => {
                        *status = Some(found.status);
                        *count = found.count as u8;
                        for (place, pose) in poses.chunks_exact_mut(3).zip(found.poses()) {
                            place.copy_from_slice(&[pose.x, pose.y, pose.phi]);
                        }
                    }
                    Err(error) => errors.push((row, error)),
                }
            }
            errors
        });
        let errors: Vec<Vec<(usize, LockError)>> = errors.collect();
        errors.into_iter().flatten().collect()
    }
}

/// The modes of one row.
struct RowModes {
    poses: [Pose; MOST_MODES],
    count: usize,
    status: Status,
}

impl RowModes {
    fn poses(&self) -> &[Pose] {
        &self.poses[..self.count]
    }

    fn push(&mut self, pose: Pose) {
        // Ways of a leg without actuator share a pose.
        if !self.poses().contains(&pose) {
            self.poses[self.count] = pose;
            self.count += 1;
        }
    }
}

impl From<RealModes> for RowModes {
    #[inline(always)]
    fn from(found: RealModes) -> Self {
        let mut out = none(found.status);
        for (place, mode) in out.poses.iter_mut().zip(found.modes()) {
            *place = mode.pose;
        }
        out.count = found.modes().len();
        out
    }
}

fn none(status: Status) -> RowModes {
    RowModes { poses: [Pose { x: 0.0, y: 0.0, phi: 0.0 }; MOST_MODES], count: 0, status }
}

impl Triad {
    /// Every real assembly mode of many triads, on all threads.
    ///
    /// **Shape, units, frame, accuracy, proof**: as [`Triad::real_modes`], row by row; the number of threads changes nothing. **Cost**: a microsecond a triad and thread.
    ///
    /// ```
    /// use assur::{Dyad, Triad};
    /// let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
    /// let triads = [12.0, 12.5].map(|last| {
    ///     Triad::new([leg([0.0, 0.0], [0.0, 0.0], 14.98), leg([15.91, 0.0], [17.045, 0.0], 15.38), leg([0.0, 10.0], [13.2389, 16.0929], last)])
    ///         .expect("finite numbers")
    /// });
    /// let batch = Triad::real_modes_batch(&triads);
    /// assert_eq!(batch.counts(), [6, 6]);
    /// assert_eq!(batch.poses()[2], triads[0].real_modes().modes()[0].pose.phi);
    /// ```
    pub fn real_modes_batch(triads: &[Triad]) -> ModesBatch {
        ModesBatch::of_rows(triads.len(), |row| Ok(triads[row].real_modes().into()))
    }
}

impl Manipulator {
    /// Every real assembly mode for many rows of inputs, on all threads.
    ///
    /// **Shape**: `inputs` row by row, one value per actuated joint, leg by leg, base first; results as [`ModesBatch`] has them. **Units and frame**: as [`Manipulator::forward`].
    /// **Proof**: as [`Triad::real_modes`]: each row's count is proved; the number of threads changes nothing. Passive limits are not looked at. A row that cannot be asked (not finite,
    /// out of limits) is an error of its own and leaves the others alone. **Cost**: some tenths of a microsecond a row more than [`Triad::real_modes_batch`]; a millisecond where
    /// actuators share a leg.
    ///
    /// # Panics
    /// Where the length of `inputs` is no multiple of the number of actuated joints.
    ///
    /// ```
    /// use assur::{Leg, Manipulator};
    /// let robot = Manipulator::new("", vec![
    ///     Leg::rpr([0.0, 0.0], [0.0, 0.0]),
    ///     Leg::rpr([15.91, 0.0], [17.045, 0.0]),
    ///     Leg::rpr([0.0, 10.0], [13.2389, 16.0929]),
    /// ])?;
    /// let batch = robot.forward_batch(&[14.98, 15.38, 12.0, 14.98, f64::NAN, 12.0]);
    /// assert_eq!(batch.counts(), [6, 0]);
    /// assert!(batch.statuses()[0].is_some() && batch.statuses()[1].is_none());
    /// assert_eq!(batch.errors()[0].0, 1);
    /// assert!(batch.errors()[0].1.to_string().contains("leg 2"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn forward_batch(&self, inputs: &[f64]) -> ModesBatch {
        let (rows, solve) = self.row_by_row(inputs);
        ModesBatch::of_rows(rows, solve)
    }

    /// [`Manipulator::forward_batch`] into arrays of the caller's; the errors are given back, rows counted from 0.
    ///
    /// # Panics
    /// Where the length of `inputs` is no multiple of the number of actuated joints, or an array has another number of rows.
    ///
    /// ```
    /// use assur::{Manipulator, ModesPlaces};
    /// let (robot, inputs) = Manipulator::of_family("3-RPR")?;
    /// let (mut poses, mut counts, mut statuses) = ([f64::NAN; 18], [0], [None]);
    /// let places = ModesPlaces { poses: &mut poses, counts: &mut counts, statuses: &mut statuses };
    /// assert!(robot.forward_batch_into(&inputs, places).is_empty());
    /// assert_eq!(counts, robot.forward_batch(&inputs).counts());
    /// # Ok::<(), assur::FamilyError>(())
    /// ```
    pub fn forward_batch_into(&self, inputs: &[f64], places: ModesPlaces) -> Vec<(usize, LockError)> {
        let (rows, solve) = self.row_by_row(inputs);
        let lengths = [places.poses.len(), places.counts.len(), places.statuses.len()];
        assert_eq!(lengths, [WIDTH * rows, rows, rows], "numbers, counts and statuses for {rows} rows");
        places.fill(solve)
    }

    /// How many rows there are, and what solves one.
    fn row_by_row(&self, inputs: &[f64]) -> (usize, impl Fn(usize) -> Result<RowModes, LockError> + Sync) {
        let width = self.actuated_joints().count();
        assert!(inputs.len().is_multiple_of(width), "{} inputs are no rows of {width}", inputs.len());
        let held_by_all = self.legs.iter().all(|leg| leg.actuated.contains(&true));
        let solve = move |row: usize| {
            let inputs = &inputs[width * row..width * (row + 1)];
            match self.lock(inputs)? {
                LockedGroup::Triad(triad) if held_by_all => Ok(triad.real_modes().into()),
                _ => {
                    let answer = self.forward(inputs)?;
                    let mut out = none(answer.group.status);
                    answer.modes.iter().for_each(|mode| out.push(mode.mode.pose));
                    Ok(out)
                }
            }
        };
        (inputs.len() / width, solve)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manipulator::{Leg, Placement};

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let robot = Manipulator::new(
            "",
            vec![
                Leg::rpr([0.0, 0.0], [0.0, 0.0]),
                Leg::rpr([15.91, 0.0], [17.045, 0.0]),
                Leg::rpr([0.0, 10.0], [13.2389, 16.0929]),
            ],
        )
        .expect("a sound model");
        let mut inputs: Vec<f64> = (0..9000).map(|i| 10.0 + f64::from(i * 7919 % 9973) * 1e-3).collect();
        inputs[4000] = f64::INFINITY;
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| robot.forward_batch(&inputs))
        };
        let one = with(1);
        assert_eq!(one, with(3));
        assert_eq!(one.errors().len(), 1);
        assert_eq!(one.errors()[0].0, 1333);
        for (row, values) in inputs.chunks(3).enumerate().step_by(97) {
            let poses: Vec<Pose> =
                robot.forward(values).map_or(Vec::new(), |a| a.modes.iter().map(|m| m.mode.pose).collect());
            assert_eq!(poses.len(), usize::from(one.counts()[row]));
            for (pose, found) in poses.iter().zip(one.poses()[WIDTH * row..].chunks(3)) {
                assert!((pose.x - found[0]).abs() + (pose.y - found[1]).abs() + (pose.phi - found[2]).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn legs_without_actuator_take_the_general_way() {
        // Two actuators on the first leg, none on the second.
        let leg = |joints: &str, base: [f64; 2], links: [f64; 2], platform: [f64; 2]| Leg {
            base: Placement::at(base[0], base[1]),
            links: links.map(|l| Placement::at(l, 0.0)),
            platform: Placement::at(platform[0], platform[1]),
            ..joints.parse().expect("a leg")
        };
        let robot = Manipulator::new(
            "",
            vec![
                leg("_R__R_R", [0.0, 0.0], [4.0, 3.0], [0.0, 0.0]),
                leg("RRR", [6.0, 0.0], [8.0, 8.0], [1.0, 0.0]),
                leg("R_P_R", [3.0, 6.0], [0.0, 0.0], [0.5, 1.0]),
            ],
        )
        .expect("a sound model");
        let inputs = [0.9, 0.6, 1.2];
        let answer = robot.forward(&inputs).expect("a sound question");
        let mut poses: Vec<Pose> = answer.modes.iter().map(|m| m.mode.pose).collect();
        let ways = poses.len();
        poses.dedup();
        assert!(!poses.is_empty() && poses.len() < ways);
        assert_eq!(usize::from(robot.forward_batch(&inputs).counts()[0]), poses.len());
    }

    #[test]
    fn no_rows_are_no_error() {
        let (robot, _) = Manipulator::of_family("3-RPR").expect("a family");
        assert!(robot.forward_batch(&[]).is_empty());
    }
}
