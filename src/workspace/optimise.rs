//! Design numbers between bounds for which a workspace is largest.
//!
//! Evenly spread designs are measured; from the best of them sequential quadratic programming (Kraft 1994, as in SciPy and NLopt) climbs by exact gradients within the
//! bounds. What is returned is the best design ever measured. There may be a better one between the designs that were tried: areas have several
//! hills, and nothing here proves that the highest was found.

use std::cell::RefCell;

use slsqp::{Func, StopTols, minimize};

use super::limits::{WorkspaceError, WorkspaceModes};
use super::region::WorkspaceKind;
use crate::manipulator::{DesignNumber, Manipulator};

/// A choice: numbers that are set together, and the bounds of their common value; radians for angles.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignChoice {
    /// The numbers.
    pub numbers: Vec<DesignNumber>,
    /// Least and greatest value.
    pub bounds: [f64; 2],
}

/// The best design that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimum {
    /// Its values, one a choice; radians for angles.
    pub values: Vec<f64>,
    /// Its area.
    pub area: f64,
    /// The area's derivatives by the values: near zero inside the bounds, or pointing outwards at one.
    pub gradient: Vec<f64>,
    /// The area of the design that was given.
    pub area_before: f64,
    /// How many designs were measured.
    pub evaluations: usize,
}

/// Designs measured before climbing, for each number of choices from one on.
const SPREAD: [usize; 4] = [33, 100, 200, 300];
/// How many of the best are climbed from.
const CLIMBS: usize = 4;
/// Designs measured on one climb, at most.
const CLIMB: usize = 80;
/// A climb ends where the area changes by less than this part of it.
const LEVEL: f64 = 1e-13;
/// The first coordinates of Halton's sequence: their bases. More choices than these share them, shifted.
const BASES: [u32; 8] = [2, 3, 5, 7, 11, 13, 17, 19];

impl Manipulator {
    /// The design numbers within their bounds for which the area is largest, as far as was searched.
    ///
    /// **Cost**: some hundred to thousand workspaces. Deterministic.
    ///
    /// # Errors
    /// As [`Manipulator::reach`] for the design given. Designs on the way that cannot be asked count as having no workspace.
    ///
    /// ```
    /// use assur::workspace::{DesignChoice, WorkspaceKind, WorkspaceModes};
    /// # let (mut robot, _) = assur::Manipulator::of_family("3-RPR")?;
    /// # robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([5.0, 14.0]));
    /// let numbers = "leg1.limits.min".parse::<assur::DesignKey>()?.numbers(&robot)?;
    /// let choice = DesignChoice { numbers, bounds: [2.0, 9.0] };
    /// let best = robot.optimise_area(&WorkspaceKind::Constant { phi: 0.3 }, &WorkspaceModes::Both, &[choice])?;
    /// // The shorter a leg can be, the more it reaches.
    /// assert!((best.values[0] - 2.0).abs() < 1e-6 && best.area > best.area_before);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn optimise_area(
        &self,
        kind: &WorkspaceKind,
        modes: &WorkspaceModes,
        choices: &[DesignChoice],
    ) -> Result<Optimum, WorkspaceError> {
        let area_before = self.workspace(kind, modes)?.region.area;
        let given: Vec<f64> = choices
            .iter()
            .map(|choice| {
                choice.numbers.first().and_then(|number| self.design_number(*number).ok()).unwrap_or_default()
            })
            .collect();
        let hill = Hill {
            robot: self,
            kind,
            modes,
            choices,
            best: RefCell::new((f64::NEG_INFINITY, given.clone())),
            evaluations: RefCell::new(1),
        };
        let mut starts: Vec<(f64, Vec<f64>)> = Vec::new();
        let within = given.iter().zip(choices).all(|(x, choice)| choice.bounds[0] <= *x && *x <= choice.bounds[1]);
        if within {
            starts.push((hill.area(&given), given));
        }
        let count = SPREAD[choices.len().clamp(1, SPREAD.len()) - 1];
        for index in 0..count {
            let values: Vec<f64> = choices
                .iter()
                .enumerate()
                .map(|(k, choice)| {
                    choice.bounds[0] + (choice.bounds[1] - choice.bounds[0]) * spread(index, k, choices.len(), count)
                })
                .collect();
            starts.push((hill.area(&values), values));
        }
        starts.sort_by(|one, other| other.0.total_cmp(&one.0));
        let highest = starts.first().map_or(0.0, |start| start.0);
        if highest > 0.0 {
            let bounds = vec![(0.0, 1.0); choices.len()];
            let none: [&dyn Func<()>; 0] = [];
            for (_, values) in starts.into_iter().take(CLIMBS).filter(|start| start.0 > 0.0) {
                let parts: Vec<f64> = values.iter().zip(choices).map(|(x, choice)| part(*x, choice.bounds)).collect();
                let fall =
                    |parts: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| hill.fall(parts, gradient, highest);
                let level = StopTols { ftol_rel: LEVEL, ..StopTols::default() };
                // A climb that gets stuck at a kink ends with an error; what it found on the way is kept all the same.
                let _ = minimize(fall, &parts, &bounds, &none, (), CLIMB, Some(level));
            }
        }
        let values = hill.best.borrow().1.clone();
        let evaluations = *hill.evaluations.borrow();
        let best = hill.design(&values).unwrap_or_else(|| self.clone());
        let workspace = best.workspace(kind, modes)?;
        let gradient = choices
            .iter()
            .map(|choice| Ok(best.area_gradient(&workspace, modes, &choice.numbers)?.iter().sum()))
            .collect::<Result<_, WorkspaceError>>()?;
        Ok(Optimum { values, area: workspace.region.area, gradient, area_before, evaluations })
    }
}

/// A number between 0 and 1 for each design and choice: evenly for one choice, else by Halton's sequence.
fn spread(index: usize, choice: usize, choices: usize, count: usize) -> f64 {
    if choices == 1 {
        return index as f64 / (count - 1) as f64;
    }
    let base = BASES[choice % BASES.len()];
    let (mut part, mut sum, mut rest) = (1.0, 0.0, index as u64 + 1);
    while rest > 0 {
        part /= f64::from(base);
        sum += part * (rest % u64::from(base)) as f64;
        rest /= u64::from(base);
    }
    // Choices that share a base are shifted against each other by the golden section.
    let turns = (choice / BASES.len()) as f64 * 0.618_033_988_749_894_9;
    (sum + turns).fract()
}

/// Where between its bounds a value lies, from 0 to 1.
fn part(value: f64, [low, high]: [f64; 2]) -> f64 {
    if high == low { 0.0 } else { ((value - low) / (high - low)).clamp(0.0, 1.0) }
}

/// The area over the choices, with the best design seen.
struct Hill<'a> {
    robot: &'a Manipulator,
    kind: &'a WorkspaceKind,
    modes: &'a WorkspaceModes,
    choices: &'a [DesignChoice],
    best: RefCell<(f64, Vec<f64>)>,
    evaluations: RefCell<usize>,
}

impl Hill<'_> {
    fn values(&self, parts: &[f64]) -> Vec<f64> {
        let value = |(part, choice): (&f64, &DesignChoice)| {
            let [low, high] = choice.bounds;
            // Both bounds exactly.
            if *part >= 1.0 { high } else { low + (high - low) * part.max(0.0) }
        };
        parts.iter().zip(self.choices).map(value).collect()
    }

    fn design(&self, values: &[f64]) -> Option<Manipulator> {
        let mut robot = self.robot.clone();
        for (choice, &value) in self.choices.iter().zip(values) {
            for &number in &choice.numbers {
                robot.set_design_number(number, value).ok()?;
            }
        }
        robot.validate().is_ok().then_some(robot)
    }

    fn area(&self, values: &[f64]) -> f64 {
        *self.evaluations.borrow_mut() += 1;
        let workspace = self.design(values).and_then(|robot| robot.workspace(self.kind, self.modes).ok());
        let area = workspace.map_or(0.0, |workspace| workspace.region.area);
        if area > self.best.borrow().0 {
            *self.best.borrow_mut() = (area, values.to_vec());
        }
        area
    }

    /// The area turned upside down over the highest of the start, and its gradient by the parts; what climbs here falls there.
    fn fall(&self, parts: &[f64], gradient: Option<&mut [f64]>, highest: f64) -> f64 {
        let values = self.values(parts);
        if let Some(gradient) = gradient {
            gradient.fill(0.0);
            let design = self.design(&values);
            let workspace = design.as_ref().and_then(|robot| robot.workspace(self.kind, self.modes).ok());
            if let (Some(robot), Some(workspace)) = (design, workspace) {
                for (slope, choice) in gradient.iter_mut().zip(self.choices) {
                    let by_number: f64 = robot
                        .area_gradient(&workspace, self.modes, &choice.numbers)
                        .map_or(0.0, |all| all.iter().sum());
                    *slope = -by_number * (choice.bounds[1] - choice.bounds[0]) / highest;
                }
            }
        }
        -self.area(&values) / highest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn designs_are_spread_evenly() {
        let values: Vec<f64> = (0..64).map(|index| spread(index, 1, 2, 64)).collect();
        for quarter in 0..4 {
            let low = f64::from(quarter) / 4.0;
            let inside = values.iter().filter(|x| (low..low + 0.25).contains(*x)).count();
            assert!((14..=18).contains(&inside), "{inside} of 64 in a quarter");
        }
        assert_eq!([part(5.0, [2.0, 8.0]), part(9.0, [2.0, 8.0]), part(1.0, [1.0, 1.0])], [0.5, 1.0, 0.0]);
    }
}
