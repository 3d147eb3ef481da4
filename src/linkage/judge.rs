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
    /// The assembly mode it stands for, or else the nearest, by its place in the answer. Of several claims near one mode the nearest stands for it.
    pub nearest: Option<usize>,
    /// The claim, by its place, that already stands for the nearest mode.
    pub repeats: Option<usize>,
    /// How far that is: the larger of the angle in radians and the displacement over the group's size.
    pub distance: f64,
}

/// Claims against all that is true.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The claims, in their order.
    pub claims: Vec<Claim>,
    /// Assembly modes that no claim stands for, by their places in the answer.
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
        // Each mode to the claim nearest to it, nearest pairs first: of two modes close together, neither is claimed twice.
        let mut pairs: Vec<(f64, usize, usize)> = (0..claims.len())
            .flat_map(|claim| (0..self.modes.len()).map(move |mode| (claim, mode)))
            .map(|(claim, mode)| (self.distance(mode, &claims[claim]), claim, mode))
            .collect();
        pairs.sort_by(|p, q| p.0.total_cmp(&q.0));
        let (mut mode_of, mut claim_of) = (vec![None; claims.len()], vec![None; self.modes.len()]);
        for &(_, claim, mode) in pairs.iter().take_while(|pair| pair.0 <= tolerance) {
            if mode_of[claim].is_none() && claim_of[mode].is_none() {
                (mode_of[claim], claim_of[mode]) = (Some(mode), Some(claim));
            }
        }
        let judged = |(number, &pose): (usize, &Pose)| {
            let nearest = mode_of[number].or_else(|| pairs.iter().find(|pair| pair.1 == number).map(|pair| pair.2));
            let distance = nearest.map_or(f64::INFINITY, |mode| self.distance(mode, &pose));
            let verdict = match nearest {
                Some(mode) if distance <= tolerance => match self.modes[mode].proof {
                    Verdict::Proven => Verdict::Proven,
                    _ => Verdict::Undecided,
                },
                _ if complete => Verdict::Refuted,
                _ => Verdict::Undecided,
            };
            let taken = nearest.filter(|_| distance <= tolerance).and_then(|mode| claim_of[mode]);
            Claim { pose, verdict, nearest, repeats: taken.filter(|&claim| claim != number), distance }
        };
        let claims = claims.iter().enumerate().map(judged).collect();
        let missing = (0..self.modes.len()).filter(|&mode| claim_of[mode].is_none()).collect();
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

#[cfg(test)]
mod tests {
    use crate::linkage::{Dyad, Triad};

    #[test]
    fn two_claims_never_stand_for_one_mode_and_repetitions_are_named() {
        let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
        let legs = [
            leg([0.0, 0.0], [0.0, 0.0], 1.0),
            leg([4.0, 0.0], [2.0, 0.0], 1.0 + 1e-15),
            leg([2.0, 3.0], [1.0, 1.0], 2.0),
        ];
        let answer = Triad::new(legs).expect("valid").certify();
        let [p, q] = [0, 1].map(|mode: usize| answer.modes[mode].pose);
        assert_eq!(answer.modes.len(), 2);
        assert!((p.phi - q.phi).abs() < 1e-6, "{p:?} {q:?}");
        let both = answer.judge(&[q, p], 1e-3);
        assert_eq!(both.claims.iter().map(|claim| claim.nearest).collect::<Vec<_>>(), [Some(1), Some(0)]);
        assert_eq!(both.missing, Vec::<usize>::new());
        let thrice = answer.judge(&[q, p, p], 1e-3);
        assert_eq!(thrice.claims.iter().map(|claim| claim.repeats).collect::<Vec<_>>(), [None, None, Some(1)]);
        assert_eq!(answer.judge(&[p], 1e-3).missing, [1]);
    }
}
