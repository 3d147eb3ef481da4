//! Forward kinematics of many rows of inputs, or of many triads, at once.
//!
//! Each row takes the fast route ([`Triad::real_modes`]), many rows at a time in SIMD registers; rows are shared out over threads, and each writes into its own
//! place, so that results do not depend on how many threads there are. Results are flat arrays.
//!
//! What it does not give: joints, signs, accounts, non-real solutions; for those there is [`Manipulator::forward`]. A leg without actuator only
//! decides which poses it reaches.

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::describe::Manipulator;
use super::lock::{LockError, LockedGroup};
use crate::linkage::{MOST_MODES, Pose, Status, Triad, real_modes_of_many};

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
    fn of_shares(rows: usize, solve: impl Fn(usize, &mut Share) + Sync) -> Self {
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

    /// Whether each row's modes are all there are, or stand beside a curve of poses, or may be short; `None` for a row with an error, of whose modes nothing is known.
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
    fn fill(self, solve: impl Fn(usize, &mut Share) + Sync) -> Vec<(usize, LockError)> {
        let shares = self
            .poses
            .par_chunks_mut(WIDTH * SHARE)
            .zip(self.counts.par_chunks_mut(SHARE))
            .zip(self.statuses.par_chunks_mut(SHARE))
            .enumerate();
        let errors = shares.map(|(number, ((poses, counts), statuses))| {
            // Of a row with an error nothing is known.
            counts.fill(0);
            statuses.fill(None);
            let mut share = Share { poses, counts, statuses, errors: Vec::new() };
            solve(SHARE * number, &mut share);
            share.errors
        });
        let errors: Vec<Vec<(usize, LockError)>> = errors.collect();
        errors.into_iter().flatten().collect()
    }
}

/// Rows that one thread works on.
struct Share<'a> {
    poses: &'a mut [f64],
    counts: &'a mut [u8],
    statuses: &'a mut [Option<Status>],
    errors: Vec<(usize, LockError)>,
}

impl Share<'_> {
    /// Books the modes of a row, counted within the share.
    #[inline(always)]
    fn put(&mut self, row: usize, poses: &[[f64; 3]], status: Status) {
        (self.counts[row], self.statuses[row]) = (poses.len() as u8, Some(status));
        for (to, pose) in self.poses[WIDTH * row..].chunks_exact_mut(3).zip(poses) {
            to.copy_from_slice(pose);
        }
    }
}

impl Triad {
    /// Every real assembly mode of many triads, on all threads.
    ///
    /// **Shape, units, frame, accuracy, proof**: as [`Triad::real_modes`], row by row; to the last bit, in whatever order and company; the number of
    /// threads changes nothing. **Cost**: three quarters of a microsecond a triad and thread, where triads are of few kinds (`benches/real_modes.rs`).
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
        ModesBatch::of_shares(triads.len(), |first, share| {
            let own = &triads[first..first + share.counts.len()];
            real_modes_of_many(own, |row, poses, status| share.put(row, poses, status));
        })
    }
}

impl Manipulator {
    /// Every real assembly mode for many rows of inputs, on all threads.
    ///
    /// **Shape**: `inputs` row by row, one value per actuated joint, leg by leg, base first; results as [`ModesBatch`] has them. **Units and frame**: as [`Manipulator::forward`].
    /// **Proof**: as [`Triad::real_modes`]: each row's count is proved; the number of threads changes nothing. Passive limits are not looked at. A row that cannot be asked (not finite,
    /// out of limits) is an error of its own and leaves the others alone. **Cost**: as [`Triad::real_modes_batch`]; a millisecond where actuators
    /// share a leg.
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
        let (rows, solve) = self.share_by_share(inputs);
        ModesBatch::of_shares(rows, solve)
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
        let (rows, solve) = self.share_by_share(inputs);
        let lengths = [places.poses.len(), places.counts.len(), places.statuses.len()];
        assert_eq!(lengths, [WIDTH * rows, rows, rows], "numbers, counts and statuses for {rows} rows");
        places.fill(solve)
    }

    /// How many rows there are, and what solves those of a share, given the number of its first.
    fn share_by_share(&self, inputs: &[f64]) -> (usize, impl Fn(usize, &mut Share) + Sync) {
        let width = self.actuated_joints().count();
        assert!(inputs.len().is_multiple_of(width), "{} inputs are no rows of {width}", inputs.len());
        let held_by_all = self.legs.iter().all(|leg| leg.actuated.contains(&true));
        let solve = move |first: usize, share: &mut Share| {
            let (mut triads, mut places) = (Vec::with_capacity(SHARE), Vec::with_capacity(SHARE));
            for row in 0..share.counts.len() {
                let inputs = &inputs[width * (first + row)..width * (first + row + 1)];
                match self.lock(inputs) {
                    Ok(LockedGroup::Triad(triad)) if held_by_all => {
                        triads.push(triad);
                        places.push(row);
                    }
                    Ok(_) => match self.forward(inputs) {
                        Ok(answer) => {
                            let mut poses: ArrayVec<[f64; 3], MOST_MODES> = ArrayVec::new();
                            for Pose { x, y, phi } in answer.modes.iter().map(|mode| mode.mode.pose) {
                                // Ways of a leg without actuator share a pose.
                                if !poses.contains(&[x, y, phi]) {
                                    poses.push([x, y, phi]);
                                }
                            }
                            share.put(row, &poses, answer.group.status);
                        }
                        Err(error) => share.errors.push((first + row, error)),
                    },
                    Err(error) => share.errors.push((first + row, error)),
                }
            }
            real_modes_of_many(&triads, |place, poses, status| share.put(places[place], poses, status));
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
