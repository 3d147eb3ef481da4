//! `tripod tilt` and `tripod determinant`: what is drawn over places and designs.

use std::path::Path;

use assur::exchange::{
    AngleUnit, TiltSections, TripodFile, tilt_json, tilt_limit_name, tripod_determinant_csv, tripod_determinant_json,
};
use assur::nalgebra::Vector3;
use assur::{DeterminantPoint, SpatialError, TripodDesign};

use super::tripod::{DesignName, tripod_pose};
use super::{ROWS, about, exactly, titled};
use crate::args::Shown;
use crate::output::{self, Failure, Files};
use crate::tables::{ALARM, POSE_DIGITS, SIDE_DIGITS, STRONG, digits, line, table};

/// The tolerance of the proved tilt, in radians.
const TOLERANCE: f64 = 1e-3;
pub(super) fn tilt(file: &Path, at: &[f64], tolerance: Option<f64>, shown: &Shown) -> Result<(), Failure> {
    let TripodFile { robot, angle_unit } = TripodFile::read(file)?;
    let place = Vector3::from(exactly::<3>("at", at, file)?);
    let failed = |error| about(file, error);
    if shown.svg.is_some() || shown.png.is_some() {
        return Err(about(file, "a picture is of a map: give --low and --high in place of --at"));
    }
    let found = robot.tilt(&place).map_err(failed)?;
    let given = tolerance.unwrap_or_else(|| angle_unit.from_rad(TOLERANCE));
    if given.is_nan() || given <= 0.0 {
        return Err(about(file, SpatialError::NotPositive { what: "tolerance".to_owned(), value: given }));
    }
    let tolerance = angle_unit.to_rad(given);
    let proved = match &found {
        Some(found) => robot.tilt_bound(&place, found, tolerance).map_err(failed)?,
        None => None,
    };
    if shown.json {
        return output::print(&tilt_json(&place, found.as_ref(), proved));
    }
    let mut text = titled(&robot.name, "three-legged robot");
    let angle = |value: f64| format!("{} {}", digits(angle_unit.from_rad(value), POSE_DIGITS), angle_unit.name());
    match &found {
        None => line(&mut text, format_args!("{STRONG}out of limits already in the home orientation{STRONG:#}")),
        Some(found) => {
            line(&mut text, format_args!("{STRONG}largest tilt {}{STRONG:#}", angle(found.angle)));
            line(&mut text, format_args!("worst azimuth {}: {}", angle(found.azimuth), tilt_limit_name(found.limit)));
            match proved {
                Some(proved) => line(&mut text, format_args!("every azimuth is shown to allow {}", angle(proved))),
                None => line(&mut text, format_args!("{ALARM}not shown for every azimuth{ALARM:#}")),
            }
        }
    }
    output::print(&text)
}

pub(super) fn tilt_map(
    file: &Path,
    corners: [&[f64]; 2],
    sections: usize,
    cells: usize,
    shown: &Shown,
) -> Result<(), Failure> {
    let TripodFile { robot, angle_unit } = TripodFile::read(file)?;
    let (low, high): ([f64; 3], [f64; 3]) = (exactly("low", corners[0], file)?, exactly("high", corners[1], file)?);
    let bar = output::progress(Some((sections * cells) as u64), ROWS);
    let found = TiltSections::of(&robot, low, high, [sections, cells], || bar.inc(1));
    bar.finish_and_clear();
    let found = found.map_err(|error| about(file, error))?;
    let maps = &found.maps;
    let draw = || assur::plot::draw_tilt_sections(&robot.name, low, high, cells, maps);
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&found.to_json());
    }
    let mut text = titled(&robot.name, "three-legged robot");
    let [least, largest] = ["least", "largest"].map(|what| format!("{what} ({})", angle_unit.name()));
    let mut rows = table(&["z", "places within limits", &least, &largest]);
    for (z, values) in maps {
        let known: Vec<f64> = values.iter().flatten().map(|&angle| angle_unit.from_rad(angle)).collect();
        let least = known.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = known.iter().copied().fold(0.0, f64::max);
        let [least, largest] =
            [least, largest].map(|a| if known.is_empty() { "-".to_owned() } else { digits(a, SIDE_DIGITS) });
        rows.add_row([digits(*z, SIDE_DIGITS), format!("{} of {}", known.len(), values.len()), least, largest]);
    }
    line(&mut text, format_args!("{rows}"));
    output::print(&text)
}

pub(super) fn determinant(
    design: DesignName,
    distances: [f64; 2],
    poses: &[String],
    (range, points): ([f64; 2], usize),
    over_angle: bool,
    csv: Option<&Path>,
    shown: &Shown,
) -> Result<(), Failure> {
    let design = match design {
        DesignName::Inclined => TripodDesign::Inclined,
        DesignName::Upright => TripodDesign::Upright,
    };
    let file = Path::new("determinant");
    let degrees = AngleUnit::Deg;
    let range = range.map(|angle| degrees.to_rad(angle));
    let mut curves = Vec::new();
    for given in poses {
        let numbers: Result<Vec<f64>, _> = given.split(',').map(|number| number.trim().parse()).collect();
        let numbers = numbers.map_err(|_| about(file, format!("pose \"{given}\": must be six numbers x,y,z,a,b,c")))?;
        let pose = tripod_pose(&numbers, degrees, file)?;
        let curve = design.determinant_curve(distances[0], distances[1], &pose, range, points);
        curves.push((pose, curve.map_err(|error| about(file, error))?));
    }
    let mut files = Files::default();
    if let Some(path) = csv {
        files = files.with(path, tripod_determinant_csv(&curves).into_bytes());
    }
    let draw = || {
        let named = curves.iter().zip(poses).map(|((_, points), given)| {
            let across = |p: &DeterminantPoint| degrees.from_rad(if over_angle { p.between } else { p.elevation });
            (given.clone(), points.iter().map(|p| (across(p), p.determinant)).collect())
        });
        let what = if design == TripodDesign::Inclined { "rails" } else { "platform axes" };
        let title = format!(
            "det J of the design with {} {what}",
            if design == TripodDesign::Inclined { "inclined" } else { "raised" }
        );
        let subtitle = "one curve a pose: x, y, z and rotation vector in degrees";
        let of = if over_angle { "angle between two" } else { "elevation" };
        let axes = [&*format!("{of} of the {what} (deg)"), "det J"];
        assur::plot::draw_curves(&title, subtitle, axes, &named.collect::<Vec<_>>())
    };
    files.with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&tripod_determinant_json(design, distances, &curves));
    }
    let mut text = titled("", &format!("{} design, d1 = {}, d2 = {}", design.name(), distances[0], distances[1]));
    for ((_, points), given) in curves.iter().zip(poses) {
        let known = || points.iter().filter_map(|p| p.determinant.map(|value| (degrees.from_rad(p.elevation), value)));
        let size = |value: &(f64, f64)| value.1.abs();
        let largest = known().max_by(|a, b| size(a).total_cmp(&size(b)));
        line(&mut text, format_args!("{STRONG}pose {given}{STRONG:#}"));
        match largest {
            Some((_, 0.0)) => line(&mut text, format_args!("  det J = 0 throughout")),
            Some((at, value)) => {
                let value = digits(value, SIDE_DIGITS);
                let at = digits(at, SIDE_DIGITS);
                line(&mut text, format_args!("  largest of those taken: det J = {value} at {at} deg"));
            }
            None => line(&mut text, format_args!("  singular of type 1 throughout")),
        }
        let zeros: Vec<String> = known()
            .collect::<Vec<_>>()
            .windows(2)
            .filter(|pair| pair[0].1 * pair[1].1 < 0.0)
            .map(|pair| format!("{} and {}", digits(pair[0].0, SIDE_DIGITS), digits(pair[1].0, SIDE_DIGITS)))
            .collect();
        if !zeros.is_empty() {
            line(&mut text, format_args!("  changes sign, by a zero or a pole, between {} deg", zeros.join(", ")));
        }
    }
    output::print(&text)
}
