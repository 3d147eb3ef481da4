//! Are these claimed poses assemblies of this group? Another program's answer, or an old one of ours, held against proved modes.

use super::assemblies::{Assemblies, Status};
use super::group::Pose;
use crate::certify::Verdict;

/// A claimed pose and what is proved of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claim {
    /// The pose claimed.
    pub pose: Pose,
    /// `Proven`: an assembly mode lies within the tolerance. `Refuted`: none does. `Undecided`: a self-motion passes somewhere, or the group itself is undecided.
    pub verdict: Verdict,
    /// The nearest assembly mode, by its place in the answer.
    pub nearest: Option<usize>,
    /// How far that is: the larger of the angle in radians and the displacement over the group's size.
    pub distance: f64,
}

/// Claims against all that is true.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The claims, in their order.
    pub claims: Vec<Claim>,
    /// Assembly modes that no claim is near, by their places in the answer.
    pub missing: Vec<usize>,
}

impl Assemblies {
    /// Holds claimed poses against this answer, which [`certify`](super::Triad::certify) has proved.
    ///
    /// `tolerance` is how far a claim may lie from the truth: radians, and displacements relative to the group's size. **Proof**: that of the answer; an answer
    /// without a certificate proves nothing, and every claim stays undecided.
    ///
    /// ```
    /// use assur::{Dyad, Pose, Triad, Verdict};
    /// let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
    /// let triad = Triad::new([
    ///     leg([0.0, 0.0], [0.0, 0.0], 14.98),
    ///     leg([15.91, 0.0], [17.045, 0.0], 15.38),
    ///     leg([0.0, 10.0], [13.2389, 16.0929], 12.0),
    /// ])?;
    /// let answer = triad.certify();
    /// let mut invented = answer.modes[2].pose;
    /// invented.phi += 0.01;
    /// let judgement = answer.judge(&[answer.modes[0].pose, invented], 1e-6);
    /// assert_eq!(judgement.claims[0].verdict, Verdict::Proven);
    /// assert_eq!(judgement.claims[1].verdict, Verdict::Refuted);
    /// assert_eq!(judgement.missing, [1, 2, 3, 4, 5]);
    /// # Ok::<(), assur::TriadError>(())
    /// ```
    pub fn judge(&self, claims: &[Pose], tolerance: f64) -> Judgement {
        let complete = self.certificate.is_some_and(|c| c.complete) && self.status == Status::Complete;
        let claims: Vec<Claim> = claims
            .iter()
            .map(|&pose| {
                let nearest =
                    (0..self.modes.len()).min_by(|&i, &j| self.distance(i, &pose).total_cmp(&self.distance(j, &pose)));
                let distance = nearest.map_or(f64::INFINITY, |i| self.distance(i, &pose));
                let verdict = match nearest {
                    Some(i) if distance <= tolerance => match self.modes[i].proof {
                        Verdict::Proven => Verdict::Proven,
                        _ => Verdict::Undecided,
                    },
                    _ if complete => Verdict::Refuted,
                    _ => Verdict::Undecided,
                };
                Claim { pose, verdict, nearest, distance }
            })
            .collect();
        let claimed = |i: usize| claims.iter().any(|c| self.distance(i, &c.pose) <= tolerance);
        let missing = (0..self.modes.len()).filter(|&i| !claimed(i)).collect();
        Judgement { claims, missing }
    }

    /// How far a pose is from a mode's box, at most.
    fn distance(&self, mode: usize, pose: &Pose) -> f64 {
        let mode = &self.modes[mode];
        let found = [mode.pose.x, mode.pose.y, mode.pose.phi];
        let bounds = mode.pose_box.unwrap_or(found.map(|value| [value; 2]));
        let away = |k: usize, value: f64| (bounds[k][1] - value).abs().max((value - bounds[k][0]).abs());
        let turns = (pose.phi - found[2]) / std::f64::consts::TAU;
        let angle = away(2, pose.phi - turns.round() * std::f64::consts::TAU);
        let size = if self.size > 0.0 { self.size } else { 1.0 };
        angle.max(away(0, pose.x).hypot(away(1, pose.y)) / size)
    }
}
