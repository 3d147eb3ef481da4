//! Design numbers between bounds for which a workspace is largest.
//!
//! Evenly spread designs are measured; from the best of them the method L-BFGS climbs by exact gradients, each number `x` between bounds `a` and `b` written
//! as `a + (b - a)(1 + sin u)/2`. What is returned is the best design ever measured. There may be a better one between the designs that
//! were tried: areas have several hills, and nothing here proves that the highest was found.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor, Gradient};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;

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
/// Steps of a climb.
const STEPS: u64 = 60;
/// Steps that L-BFGS remembers.
const MEMORY: usize = 7;
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
            .map(|choice| choice.numbers.first().and_then(|number| self.design_number(*number).ok()).unwrap_or_default())
            .collect();
        let hill = Hill {
            robot: self,
            kind,
            modes,
            choices,
            scale: RefCell::new(1.0),
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
                .map(|(k, choice)| choice.bounds[0] + (choice.bounds[1] - choice.bounds[0]) * spread(index, k, choices.len(), count))
                .collect();
            starts.push((hill.area(&values), values));
        }
        starts.sort_by(|one, other| other.0.total_cmp(&one.0));
        let highest = starts.first().map_or(0.0, |start| start.0);
        if highest > 0.0 {
            *hill.scale.borrow_mut() = highest;
            for (area, values) in starts.into_iter().take(CLIMBS).filter(|start| start.0 > 0.0) {
                let _ = area;
                let angles: Vec<f64> = values.iter().zip(choices).map(|(x, choice)| angle(*x, choice.bounds)).collect();
                let solver = LBFGS::new(MoreThuenteLineSearch::new(), MEMORY);
                // A climb that gets stuck at a kink ends with an error; what it found on the way is kept all the same.
                let _ = Executor::new(&hill, solver)
                    .configure(|state| state.param(angles).max_iters(STEPS))
                    .timer(false)
                    .run();
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

/// The angle that stands for a value between bounds.
fn angle(value: f64, [low, high]: [f64; 2]) -> f64 {
    if high == low { 0.0 } else { (2.0 * (value - low) / (high - low) - 1.0).clamp(-1.0, 1.0).asin() * INSIDE }
}

/// A climb starts a little inside its bounds: on them the sine is flat and nothing would move.
const INSIDE: f64 = 0.98;

/// The area over the choices, with the best design seen.
struct Hill<'a> {
    robot: &'a Manipulator,
    kind: &'a WorkspaceKind,
    modes: &'a WorkspaceModes,
    choices: &'a [DesignChoice],
    scale: RefCell<f64>,
    best: RefCell<(f64, Vec<f64>)>,
    evaluations: RefCell<usize>,
}

impl Hill<'_> {
    fn values(&self, angles: &[f64]) -> Vec<f64> {
        let value = |(u, choice): (&f64, &DesignChoice)| {
            let [low, high] = choice.bounds;
            // At the top of the sine the bound itself, not a rounding beside it.
            if u.sin() >= 1.0 { high } else { low + (high - low) * 0.5 * (1.0 + u.sin()) }
        };
        angles.iter().zip(self.choices).map(value).collect()
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
}

impl CostFunction for &Hill<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, angles: &Vec<f64>) -> Result<f64, Error> {
        Ok(-self.area(&self.values(angles)) / *self.scale.borrow())
    }
}

impl Gradient for &Hill<'_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, angles: &Vec<f64>) -> Result<Vec<f64>, Error> {
        let flat = || vec![0.0; angles.len()];
        let Some(robot) = self.design(&self.values(angles)) else { return Ok(flat()) };
        let Ok(workspace) = robot.workspace(self.kind, self.modes) else { return Ok(flat()) };
        let scale = *self.scale.borrow();
        self.choices
            .iter()
            .zip(angles)
            .map(|(choice, u)| {
                let slope: f64 = robot.area_gradient(&workspace, self.modes, &choice.numbers)?.iter().sum();
                Ok(-slope * 0.5 * (choice.bounds[1] - choice.bounds[0]) * u.cos() / scale)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn designs_are_spread_evenly() {
        let values: Vec<f64> = (0..64).map(|index| spread(index, 1, 2, 64)).collect();
        for quarter in 0..4 {
            let low = f64::from(quarter) / 4.0;
            let inside = values.iter().filter(|x| (low..low + 0.25).contains(*x)).count();
            assert!((14..=18).contains(&inside), "{inside} of 64 in a quarter");
        }
        assert!((angle(5.0, [2.0, 8.0])).abs() < 1e-15 && angle(8.0, [2.0, 8.0]) < FRAC_PI_2);
    }
}
