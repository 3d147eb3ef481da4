//! Derivatives of areas by every number of a design, against differences of the areas themselves.
//!
//! A difference is trusted where the same curves bound the workspace at all designs it is made of: there the area is smooth, three steps are extrapolated
//! (Richardson 1911), and how much the last step changed bounds what is left. Where the curves change between the designs on one side, the other side decides.

use std::collections::BTreeMap;

use assur::workspace::{ActiveLimit, ArcCurve, Region, WorkspaceKind};
use assur::{DesignKey, DesignNumber, JointKind, Leg};

use crate::membership::{kind_of, modes_of, written};
use crate::models::{Case, TROUBLES, questions, random_case, scale};
use crate::oracle::Oracle;
use crate::random::Random;

/// Names of the numbers of a leg.
const OF_A_LEG: [&str; 18] = [
    "base.at.x",
    "base.at.y",
    "base.angle",
    "links1.at.x",
    "links1.at.y",
    "links1.angle",
    "links2.at.x",
    "links2.at.y",
    "links2.angle",
    "platform.at.x",
    "platform.at.y",
    "platform.angle",
    "limits1.min",
    "limits1.max",
    "limits2.min",
    "limits2.max",
    "limits3.min",
    "limits3.max",
];
/// Steps over the mechanism's size (angles: radians), the first at which nothing changes is used.
const STEPS: [f64; 4] = [3e-4, 3e-5, 3e-6, 3e-7];
/// Parts of the step, each half of the one before.
const PARTS: [f64; 3] = [1.0, 0.5, 0.25];
/// What an area may be off by, in the size's square: a hundred roundings.
const ROUNDING: f64 = 2e-14;
/// What a slope may be off by, in its unit: the promise of `area_gradient` for boundaries some sizes long.
const PROMISED: f64 = 1e-9;

/// What bounds a region: the curves' kinds with their limits, and how many loops there are.
type Bounds = (usize, usize, Vec<(u8, Vec<ActiveLimit>)>);

fn bounds(region: &Region) -> Bounds {
    let name = |curve: &ArcCurve| match curve {
        ArcCurve::Line => 0,
        ArcCurve::Circle { .. } => 1,
        ArcCurve::Coupler(_) => 2,
        ArcCurve::Ellipse(_) => 3,
    };
    let arcs = region.loops.iter().flat_map(|one| &one.arcs);
    let mut found: Vec<(u8, Vec<ActiveLimit>)> = arcs.map(|arc| (name(&arc.curve), arc.active.clone())).collect();
    found.sort();
    (region.components, region.holes, found)
}

/// Areas around a design.
struct Around<'a> {
    case: &'a Case,
    kind: &'a WorkspaceKind,
    number: DesignNumber,
    value: f64,
}

impl Around<'_> {
    /// The area with the number changed, and what bounds it there; `None` where that is no manipulator.
    fn area(&self, change: f64) -> Option<(f64, Bounds)> {
        let mut robot = self.case.robot.clone();
        robot.set_design_number(self.number, self.value + change).ok()?;
        let region = robot.workspace(self.kind, &modes_of(self.case)).ok()?.region;
        Some((region.area, bounds(&region)))
    }

    /// Areas at parts of a step if the same curves bound them all.
    fn alike(&self, step: f64, expected: &Bounds) -> Option<[f64; 3]> {
        let mut out = [0.0; 3];
        for (area, part) in out.iter_mut().zip(PARTS) {
            let (found, bounds) = self.area(step * part)?;
            if bounds != *expected {
                return None;
            }
            *area = found;
        }
        Some(out)
    }
}

/// How a slope was checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Checked {
    Central,
    OneSided,
    /// The curves change at the design itself, or around it at every step.
    Not,
}

/// How a slope was checked, and by how much it is off, in units of area over the number.
///
/// `length`: what the steps count in, the size or a radian.
fn check(around: &Around, here: &Region, slope: f64, size: f64, length: f64) -> Result<(Checked, f64), String> {
    let (expected, unit) = (bounds(here), size * size / length);
    let judge = |[coarse, fine]: [f64; 2], step: f64, how: Checked| {
        let room = 2.0 * (fine - coarse).abs() + (PROMISED + ROUNDING / step) * unit;
        let off = (slope - fine).abs();
        if off <= room {
            Ok((how, off / unit))
        } else {
            Err(format!("slope {slope}, difference {fine} ({how:?}, step {step:e}), room {room:e}"))
        }
    };
    for step in STEPS {
        let [up, down] = [step, -step].map(|step| around.alike(step * length, &expected));
        if let (Some(up), Some(down)) = (up, down) {
            let slopes = [0, 1, 2].map(|k| (up[k] - down[k]) / (2.0 * step * length * PARTS[k]));
            // The error goes with the square of the step.
            let better = [0, 1].map(|k| (4.0 * slopes[k + 1] - slopes[k]) / 3.0);
            return judge(better, step, Checked::Central);
        }
    }
    for step in STEPS {
        for side in [1.0, -1.0] {
            let Some(beside) = around.alike(side * step * length, &expected) else { continue };
            let slopes = [0, 1, 2].map(|k| (beside[k] - here.area) / (side * step * length * PARTS[k]));
            // The error goes with the step.
            let better = [0, 1].map(|k| 2.0 * slopes[k + 1] - slopes[k]);
            return judge(better, step, Checked::OneSided);
        }
    }
    Ok((Checked::Not, 0.0))
}

fn letter(leg: &Leg) -> &'static str {
    match (leg.joints[0], leg.joints[1]) {
        (JointKind::Prismatic, _) => "PRR",
        (_, JointKind::Prismatic) => "RPR",
        _ => "RRR",
    }
}

/// What was seen of a number of a leg type.
#[derive(Default)]
struct Seen {
    compared: usize,
    moving: usize,
}

/// `kinds`: which of the five are asked of each case; one may be asked twice, of other numbers.
fn compare(kinds: &[usize], cases: u64, numbers: usize) -> BTreeMap<(&'static str, &'static str), Seen> {
    let mut seen: BTreeMap<(&'static str, &'static str), Seen> = BTreeMap::new();
    let mut how: BTreeMap<Checked, usize> = BTreeMap::new();
    let (mut worst, mut wrong, mut asked) = (0.0f64, Vec::new(), 0);
    for number in 0..cases * scale() {
        // Every other one with ranges of all joints, in turn plain and bent: only these have every number.
        let trouble = match number % 4 {
            1 => TROUBLES[8],
            3 => TROUBLES[9],
            _ => TROUBLES[(number / 20 % 10) as usize],
        };
        let case = random_case(number / 2 + 1000 * (number % 2), trouble);
        let size = Oracle::of(&case.robot, case.modes).size;
        let mut r = Random::new(0x6a7d + number);
        let mut names: Vec<(&'static str, &'static str, String)> = ["x", "y"]
            .map(|axis| ("", if axis == "x" { "reference.x" } else { "reference.y" }, format!("reference.{axis}")))
            .into();
        for (k, leg) in case.robot.legs.iter().enumerate() {
            names.extend(OF_A_LEG.map(|name| (letter(leg), name, format!("leg{}.{name}", k + 1))));
        }
        // A joint without limits has none to change.
        names.retain(|(.., text)| text.parse::<DesignKey>().expect("a name").numbers(&case.robot).is_ok());
        for &index in kinds {
            let kind = kind_of(questions(&case, number)[index], index);
            let here = case.robot.workspace(&kind, &modes_of(&case)).expect("is covered");
            if here.region.loops.is_empty() {
                continue;
            }
            for turn in 0..numbers {
                // Ranges of revolute joints, then angles, are what seldom bounds: they are asked more often.
                let rare = |(leg, name, _): &&(&str, &str, String)| match turn % 3 {
                    0 => {
                        name.starts_with("limits")
                            && !(*leg == "PRR" && name.starts_with("limits1"))
                            && !(*leg == "RPR" && name.starts_with("limits2"))
                    }
                    1 => name.ends_with("angle"),
                    _ => true,
                };
                let some: Vec<_> = names.iter().filter(rare).collect();
                let Some((leg, name, text)) = some.get(r.between(0.0, some.len() as f64) as usize) else { continue };
                let key: DesignKey = text.parse().expect("a name");
                let found = key.numbers(&case.robot).expect("is there");
                let slope = case.robot.area_gradient(&here, &modes_of(&case), &found).expect("is covered")[0];
                let value = case.robot.design_number(found[0]).expect("is there");
                let around = Around { case: &case, kind: &kind, number: found[0], value };
                let length = if key.is_angle(&case.robot) { 1.0 } else { size };
                asked += 1;
                match check(&around, &here.region, slope, size, length) {
                    Ok((checked, off)) => {
                        *how.entry(checked).or_default() += 1;
                        worst = worst.max(off);
                        let seen = seen.entry((*leg, *name)).or_default();
                        seen.compared += usize::from(checked != Checked::Not);
                        seen.moving +=
                            usize::from(checked != Checked::Not && slope.abs() * length > 1e-6 * size * size);
                    }
                    Err(text) => wrong.push(format!("{}, {kind:?}, {key}: {text}\n{}", case.kind, written(&case))),
                }
            }
        }
    }
    println!("{asked} slopes, {how:?}, worst {worst:e} of size (lengths) or size² (angles)");
    for (name, seen) in &seen {
        println!("{name:?}: {} compared, {} moving", seen.compared, seen.moving);
    }
    assert!(
        wrong.is_empty(),
        "{} of {asked} slopes wrong; the first:\n{}",
        wrong.len(),
        wrong[..wrong.len().min(3)].join("\n\n")
    );
    let not = how.get(&Checked::Not).copied().unwrap_or_default();
    assert!(10 * not < asked, "{not} of {asked} not checked");
    seen
}

#[test]
fn slopes_of_constant_total_and_dextrous_areas_are_those_of_differences() {
    let seen = compare(&[0, 0, 3, 4], 200, 10);
    for leg in ["RPR", "RRR", "PRR"] {
        for name in OF_A_LEG {
            assert!(
                seen.get(&(leg, name)).is_some_and(|seen| seen.compared > 0),
                "{name} of a leg {leg} was never compared"
            );
        }
    }
}

#[test]
fn slopes_of_maximal_and_inclusive_areas_are_those_of_differences() {
    compare(&[1, 2], 100, 5);
}
