//! The workspace in all three coordinates of the pose: slices at given orientations, and their volume.

use std::f64::consts::TAU;

use super::limits::{WorkspaceError, WorkspaceModes};
use super::region::{Workspace, WorkspaceKind};
use crate::manipulator::Manipulator;
use crate::plane::PhiRange;

/// Slices of the workspace in (x, y, phi).
#[derive(Clone, Debug, PartialEq)]
pub struct Stack {
    /// The orientations.
    pub range: PhiRange,
    /// Constant-orientation workspaces at evenly spaced orientations, both ends included (of a whole turn only the first).
    pub slices: Vec<Workspace>,
    /// Volume of all poses with these orientations, area times radians.
    pub volume: f64,
    /// Estimate of its error: what halving the last intervals changed.
    pub volume_error: f64,
}

/// Gauss-Kronrod rule of 7 and 15 points on [-1, 1], positive half: node, weight of 15, weight of 7.
const RULE: [[f64; 3]; 8] = [
    [0.0, 0.209_482_141_084_727_83, 0.417_959_183_673_469_4],
    [0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0],
    [0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9],
    [0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0],
    [0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64],
    [0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0],
    [0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7],
    [0.991_455_371_120_812_6, 0.022_935_322_010_529_22, 0.0],
];
/// Pieces of the range at the start; the area has kinks where pieces of workspace appear.
const PIECES: usize = 12;
/// Relative accuracy of the volume that is aimed at.
const VOLUME_ACCURACY: f64 = 1e-9;
/// Pieces are halved until so many rules were applied.
const MOST_RULES: usize = 600;

impl Manipulator {
    /// Constant-orientation workspaces over a range of orientations, and the volume of them all in (x, y, phi).
    ///
    /// **Cost**: a constant-orientation workspace for each slice, and some thousands for the volume. **Accuracy**: the volume to about 1e-9, see [`Stack::volume_error`].
    ///
    /// # Errors
    /// As [`Manipulator::workspace`].
    ///
    /// ```
    /// use assur::{plane::PhiRange, workspace::WorkspaceModes};
    /// # let (mut robot, _) = assur::Manipulator::of_family("3-RPR")?;
    /// # robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([5.0, 14.0]));
    /// let stack = robot.workspace_stack(PhiRange::between(0.0, 0.5), 6, &WorkspaceModes::Both)?;
    /// assert_eq!(stack.slices.len(), 6);
    /// let mean = stack.volume / 0.5;
    /// assert!(stack.slices.iter().any(|s| s.region.area < mean) && stack.slices.iter().any(|s| s.region.area > mean));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn workspace_stack(
        &self,
        range: PhiRange,
        slices: usize,
        modes: &WorkspaceModes,
    ) -> Result<Stack, WorkspaceError> {
        WorkspaceKind::Inclusive(range).validate()?;
        let reach = self.reach(modes)?;
        let slice = |phi: f64| reach.workspace(&WorkspaceKind::Constant { phi });
        let width = range.width.min(TAU);
        let gaps = if range.is_full() { slices } else { slices.saturating_sub(1) };
        let step = if gaps == 0 { 0.0 } else { width / gaps as f64 };
        let slices = (0..slices).map(|k| slice(range.from + step * k as f64)).collect::<Result<_, _>>()?;
        let mut failed = None;
        let mut area = |phi: f64| match slice(phi) {
            Ok(workspace) => workspace.region.area,
            Err(error) => {
                failed.get_or_insert(error);
                0.0
            }
        };
        let (volume, volume_error) = if width > 0.0 { integral(&mut area, range.from, width) } else { (0.0, 0.0) };
        failed.map_or(Ok(Stack { range, slices, volume, volume_error }), Err)
    }
}

/// The integral and an estimate of its error: the worst piece is halved until all are good.
fn integral(area: &mut impl FnMut(f64) -> f64, from: f64, width: f64) -> (f64, f64) {
    let mut rule = |low: f64, high: f64| {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let (mut fine, mut coarse) = (0.0, 0.0);
        for [node, weight, weight_of_7] in RULE {
            let both = if node == 0.0 { area(middle) } else { area(middle + half * node) + area(middle - half * node) };
            fine += weight * both * half;
            coarse += weight_of_7 * both * half;
        }
        (low, high, fine, (fine - coarse).abs())
    };
    let cut = width / PIECES as f64;
    let mut pieces: Vec<(f64, f64, f64, f64)> =
        (0..PIECES).map(|k| rule(from + cut * k as f64, from + cut * (k + 1) as f64)).collect();
    let mut rules = PIECES;
    loop {
        let total: f64 = pieces.iter().map(|piece| piece.2).sum();
        let error: f64 = pieces.iter().map(|piece| piece.3).sum();
        if rules >= MOST_RULES || error <= VOLUME_ACCURACY * total.abs() {
            return (total, error);
        }
        let worst = (0..pieces.len()).max_by(|&i, &j| pieces[i].3.total_cmp(&pieces[j].3)).expect("there are pieces");
        let (low, high, ..) = pieces.swap_remove(worst);
        let middle = 0.5 * (low + high);
        pieces.push(rule(low, middle));
        pieces.push(rule(middle, high));
        rules += 2;
    }
}
