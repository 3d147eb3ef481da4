//! `tripod`: the kinematics of the three-legged robots.

use std::path::{Path, PathBuf};

use assur::exchange::{
    AngleUnit, TripodFile, tripod_forward_json, tripod_inverse_json, tripod_pointing_json, tripod_velocity_json,
};
use assur::nalgebra::{Matrix3, Vector3, Vector6};
use assur::plot::PosedRobot;
use assur::{Counted, Tripod, TripodPose, TripodReach, TripodStatus};
use clap::{Subcommand, ValueEnum};

use super::tilt::{determinant, tilt, tilt_map};
use super::{about, exactly, numbers, titled};
use crate::args::Shown;
use crate::output::{self, Failure, Files};
use crate::tables::{ALARM, POSE_DIGITS, SIDE_DIGITS, STRONG, digits, line, table};

/// What can be asked of a three-legged robot.
#[derive(Subcommand)]
pub(crate) enum TripodCommand {
    /// Slider positions for a pose, limits that they violate.
    #[command(
        after_help = "A pose is x,y,z and a rotation vector (axis times angle, in the model file's unit), or x,y,z and the nine entries of a rotation \
        matrix row by row. A robot with five degrees of freedom points its tool instead: x,y,z and --direction.\nExample:  assur tripod inverse examples/tripod-cartesian.toml --pose=200,260,240,10,5,-3 --svg pose.svg"
    )]
    Inverse {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The platform's pose.
        #[arg(long, value_name = "X,Y,Z,A,B,C", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
        /// The direction of the tool's axis, for a robot with five degrees of freedom: every orientation that has it.
        #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_hyphen_values = true)]
        direction: Vec<f64>,
        #[command(flatten)]
        shown: Shown,
    },
    /// Every assembly mode for given slider positions.
    #[command(
        after_help = "Example:  assur tripod forward examples/tripod-cartesian.toml --inputs=240,254,188,164,92,47"
    )]
    Forward {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The slider positions, leg by leg; one for a leg with one motor.
        #[arg(long, value_name = "R1,...,R6", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        inputs: Vec<f64>,
        /// Counts exactly, over the integers: real solutions, multiplicities, spurious ones.
        #[arg(long)]
        certify: bool,
        #[command(flatten)]
        shown: Shown,
    },
    /// det J over the elevation of the rails or of the platform axes, for a design of the paper's figure 8.
    #[command(
        after_help = "inclined: rails at the elevation, figure 8(a). upright: platform axes at the elevation, figure 8(b). Angles in degrees, JSON and CSV in radians.\n\
        Example:  assur tripod determinant inclined --svg determinant.svg\n\
        Example:  assur tripod determinant inclined --over-angle --svg angle.svg\n\
        Example:  assur tripod determinant upright --pose=0,0,0,10,5,0 --pose=0,0,0,20,10,0 --csv determinant.csv"
    )]
    Determinant {
        /// The design.
        design: DesignName,
        /// Distance of the first rail of each leg.
        #[arg(long, value_name = "D", default_value_t = 600.0, allow_hyphen_values = true)]
        d1: f64,
        /// Distance of the second.
        #[arg(long, value_name = "D", default_value_t = 720.0, allow_hyphen_values = true)]
        d2: f64,
        /// A pose, x,y,z and a rotation vector in degrees; may be given several times, one curve each.
        #[arg(long, value_name = "X,Y,Z,A,B,C", allow_hyphen_values = true, default_values_t =
            ["0,0,0,0,0,0".to_owned(), "0,0,0,10,5,0".to_owned(), "0,0,0,20,10,0".to_owned()])]
        pose: Vec<String>,
        /// First elevation.
        #[arg(long, value_name = "ANGLE", default_value_t = 0.0, allow_hyphen_values = true)]
        from: f64,
        /// Last elevation.
        #[arg(long, value_name = "ANGLE", default_value_t = 90.0, allow_hyphen_values = true)]
        to: f64,
        /// Elevations.
        #[arg(long, value_name = "N", default_value_t = 181, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
        points: u32,
        /// Draws over the angle between any two of the rails or axes, in place of the elevation.
        #[arg(long)]
        over_angle: bool,
        /// Writes the curves as CSV.
        #[arg(long, value_name = "FILE")]
        csv: Option<PathBuf>,
        #[command(flatten)]
        shown: Shown,
    },
    /// Jacobian, singularity, rates and accelerations in a pose.
    #[command(after_help = "Example:  assur tripod velocity examples/tripod-cartesian.toml --pose=200,260,240,10,5,-3")]
    Velocity {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The platform's pose.
        #[arg(long, value_name = "X,Y,Z,A,B,C", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
        /// Rates of the platform (p', omega) or of the sliders, one for each motor; angles in radians.
        #[arg(long, value_name = "A,...,F", value_delimiter = ',', allow_hyphen_values = true)]
        rates: Vec<f64>,
        /// Accelerations at these rates.
        #[arg(long, value_name = "A,...,F", value_delimiter = ',', allow_hyphen_values = true)]
        accelerations: Vec<f64>,
        /// Prints one JSON document.
        #[arg(long)]
        json: bool,
    },
    /// The largest tilt of the tool that every azimuth allows: at a place, or over sections.
    #[command(after_help = "Example:  assur tripod tilt examples/tripod-cartesian.toml --at=163.4,163.4,163.4\n\
        Map:      assur tripod tilt examples/tripod-cartesian.toml --low=0,0,0 --high=400,400,400 --sections=12 --svg tilt.svg")]
    Tilt {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// A place of the tool's point.
        #[arg(
            long,
            value_name = "X,Y,Z",
            value_delimiter = ',',
            allow_hyphen_values = true,
            required_unless_present = "low"
        )]
        at: Vec<f64>,
        /// Lowest corner of a map.
        #[arg(
            long,
            value_name = "X,Y,Z",
            value_delimiter = ',',
            allow_hyphen_values = true,
            requires = "high",
            conflicts_with = "at"
        )]
        low: Vec<f64>,
        /// Highest corner of a map.
        #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_hyphen_values = true, requires = "low")]
        high: Vec<f64>,
        /// Sections of the map, evenly over its height.
        #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u16).range(1..=100))]
        sections: u16,
        /// Cells of a section along each side.
        #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u16).range(1..=1000))]
        cells: u16,
        /// How far below the tilt the proved one may be, in the model file's unit.
        #[arg(long, value_name = "ANGLE")]
        tolerance: Option<f64>,
        #[command(flatten)]
        shown: Shown,
    },
}

/// A design of figure 8.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum DesignName {
    Inclined,
    Upright,
}

pub(crate) fn tripod(command: TripodCommand) -> Result<(), Failure> {
    match command {
        TripodCommand::Inverse { model, pose, direction, shown } if direction.is_empty() => {
            tripod_inverse(&model, &pose, &shown)
        }
        TripodCommand::Inverse { model, pose, direction, shown } => pointing(&model, &pose, &direction, &shown),
        TripodCommand::Forward { model, inputs, certify, shown } => tripod_forward(&model, &inputs, certify, &shown),
        TripodCommand::Determinant { design, d1, d2, pose, from, to, points, over_angle, csv, shown } => {
            determinant(design, [d1, d2], &pose, ([from, to], points as usize), over_angle, csv.as_deref(), &shown)
        }
        TripodCommand::Velocity { model, pose, rates, accelerations, json } => {
            tripod_velocity(&model, &pose, [&rates, &accelerations], json)
        }
        TripodCommand::Tilt { model, at, low, high, sections, cells, tolerance, shown } => {
            if low.is_empty() {
                tilt(&model, &at, tolerance, &shown)
            } else {
                tilt_map(&model, [&low, &high], usize::from(sections), usize::from(cells), &shown)
            }
        }
    }
}

pub(super) fn tripod_pose(values: &[f64], unit: AngleUnit, file: &Path) -> Result<TripodPose, Failure> {
    if values.len() == 12 {
        let all: [f64; 12] = exactly("pose", values, file)?;
        let matrix = Matrix3::from_row_slice(&all[3..]);
        return TripodPose::with_matrix(Vector3::from_column_slice(&all[..3]), matrix)
            .map_err(|error| about(file, error));
    }
    let [x, y, z, a, b, c] = exactly("pose", values, file)?;
    Ok(TripodPose::new(Vector3::new(x, y, z), Vector3::new(a, b, c).map(|angle| unit.to_rad(angle))))
}

fn tripod_inverse(file: &Path, pose: &[f64], shown: &Shown) -> Result<(), Failure> {
    let TripodFile { robot, angle_unit } = TripodFile::read(file)?;
    let pose = tripod_pose(pose, angle_unit, file)?;
    let failed = |error| about(file, error);
    let inputs = robot.inverse(&pose).map_err(failed)?;
    let angles = robot.plane_angles(&pose).map_err(failed)?;
    let violations = robot.violations(&pose, &inputs).map_err(failed)?;
    let draw = || assur::plot::draw_tripod_poses(&robot, &[PosedRobot { caption: String::new(), pose, inputs }]);
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&tripod_inverse_json(&pose, &inputs, &angles, &violations));
    }
    let mut text = titled(&robot.name, "three-legged robot");
    positions(&mut text, &robot, &inputs, &angles, angle_unit);
    violated(&mut text, &violations, angle_unit);
    output::print(&text)
}

/// A row for each leg: its sliders, the angle of its plane.
fn positions(text: &mut String, robot: &Tripod, inputs: &[f64; 6], angles: &[f64; 3], angle_unit: AngleUnit) {
    let header = format!("plane angle ({})", angle_unit.name());
    let mut rows = table(&["leg", "rho a", "rho b", &header]);
    for k in 0..3 {
        let [a, b, angle] = [inputs[2 * k], inputs[2 * k + 1], angle_unit.from_rad(angles[k])];
        let [a, b, angle] = [a, b, angle].map(|value| digits(value, POSE_DIGITS));
        rows.add_row([(k + 1).to_string(), a, if robot.one_motor[k] { "as rho a".to_owned() } else { b }, angle]);
    }
    line(text, format_args!("{rows}"));
}

fn violated(text: &mut String, violations: &[TripodReach], angle_unit: AngleUnit) {
    for v in violations {
        let shown =
            |value: f64| digits(if v.slider.is_none() { angle_unit.from_rad(value) } else { value }, SIDE_DIGITS);
        let what = v.slider.map_or(format!("plane angle of leg {}", v.leg), |slider| format!("slider {slider}"));
        let [low, high] = v.limit.map(shown);
        line(text, format_args!("{ALARM}{what}: {} outside [{low}, {high}]{ALARM:#}", shown(v.value)));
    }
}

/// Both orientations of a robot with five degrees of freedom that point its tool in a direction.
fn pointing(file: &Path, at: &[f64], direction: &[f64], shown: &Shown) -> Result<(), Failure> {
    let TripodFile { robot, angle_unit } = TripodFile::read(file)?;
    let failed = |error| about(file, error);
    let position = Vector3::from(exactly::<3>("pose, beside a direction,", at, file)?);
    let direction = Vector3::from(exactly::<3>("direction", direction, file)?);
    let found = robot.pointed(&position, &direction).map_err(failed)?;
    let angle = |value: f64| format!("{} {}", digits(angle_unit.from_rad(value), POSE_DIGITS), angle_unit.name());
    let draw = || {
        let posed = found.ways.iter().map(|way| {
            let caption = format!("torsion {}", angle(way.torsion));
            PosedRobot { caption, pose: way.pose, inputs: way.inputs }
        });
        assur::plot::draw_tripod_poses(&robot, &posed.collect::<Vec<_>>())
    };
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&tripod_pointing_json(&position, &direction, &found));
    }
    let mut text = titled(&robot.name, "three-legged robot");
    for way in &found.ways {
        let turn = way.pose.rotation.scaled_axis().map(|x| angle_unit.from_rad(x));
        line(&mut text, format_args!("{STRONG}torsion {}{STRONG:#}", angle(way.torsion)));
        line(&mut text, format_args!("rotation vector ({})  {}", angle_unit.name(), numbers(turn.as_slice())));
        positions(&mut text, &robot, &way.inputs, &way.plane_angles, angle_unit);
        violated(&mut text, &way.violations, angle_unit);
    }
    let count = match (found.every_torsion, found.ways.len()) {
        (true, _) => {
            "every torsion points the tool there: a curve of orientations, of which torsion 0 is shown".to_owned()
        }
        (false, 0) => "no orientation points the tool there".to_owned(),
        (false, 1) => "one orientation points the tool there: two have met".to_owned(),
        (false, count) => format!("{count} orientations point the tool there"),
    };
    line(&mut text, format_args!("{STRONG}{count}{STRONG:#}"));
    output::print(&text)
}

fn tripod_forward(file: &Path, inputs: &[f64], certify: bool, shown: &Shown) -> Result<(), Failure> {
    let TripodFile { robot, .. } = TripodFile::read(file)?;
    let inputs = robot.all_sliders("inputs", inputs).map_err(|error| about(file, error))?;
    let answer = if certify { robot.certify(&inputs) } else { robot.forward(&inputs) };
    let answer = answer.map_err(|error| about(file, error))?;
    let draw = || {
        let posed = |(number, mode): (usize, &assur::TripodAssembly)| PosedRobot {
            caption: format!("mode {number}"),
            pose: mode.pose,
            inputs,
        };
        assur::plot::draw_tripod_poses(&robot, &(1..).zip(&answer.modes).map(posed).collect::<Vec<_>>())
    };
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&tripod_forward_json(&answer));
    }
    let mut text = titled(&robot.name, "three-legged robot");
    for (number, mode) in (1..).zip(&answer.modes) {
        let place = mode.pose.position.map(|value| digits(value, POSE_DIGITS));
        let residual = mode.residual;
        line(
            &mut text,
            format_args!(
                "{STRONG}mode {number}{STRONG:#}  x, y, z = {}  residual {residual:.0e}",
                place.as_slice().join(", ")
            ),
        );
        for row in mode.pose.rotation.matrix().row_iter() {
            let row: Vec<String> = row.iter().map(|value| format!("{value:>16.12}")).collect();
            line(&mut text, format_args!("  [{}]", row.join(" ")));
        }
    }
    for mode in &answer.spurious {
        let legs: Vec<String> = (1..=3).filter(|&leg| mode.parallel_axes[leg - 1]).map(|leg| leg.to_string()).collect();
        line(
            &mut text,
            format_args!("removed: a solution of the equations with parallel axes in leg {}", legs.join(", ")),
        );
    }
    let status = match answer.status {
        TripodStatus::Complete => "complete",
        TripodStatus::PositionFree => "the legs' planes are parallel to a line: the place is not determined (type 2)",
        TripodStatus::OrientationFree => "a curve of orientations",
        TripodStatus::Undecided => "undecided: the roots could not be had",
    };
    let counted = if answer.counted == Counted::Exactly { ", counted exactly" } else { "" };
    let a = &answer.account;
    line(
        &mut text,
        format_args!(
            "{STRONG}{status}{counted}; degree {} = {} real + {} complex + {} spurious + {} self-motion + {} undecided{STRONG:#}",
            a.degree, a.real, a.complex, a.rejected, a.self_motion, a.undecided
        ),
    );
    output::print(&text)
}

fn tripod_velocity(file: &Path, pose: &[f64], asked: [&[f64]; 2], json: bool) -> Result<(), Failure> {
    let TripodFile { robot, angle_unit } = TripodFile::read(file)?;
    let pose = tripod_pose(pose, angle_unit, file)?;
    // Six are of the platform or of the sliders; fewer, one for each motor, are of the sliders.
    let six = |what: &'static str, given: &[f64]| -> Result<Option<Vector6<f64>>, Failure> {
        let all = || match given.len() {
            6 => exactly::<6>(what, given, file),
            _ => robot.all_sliders(what, given).map_err(|error| about(file, error)),
        };
        (!given.is_empty()).then(all).transpose().map(|found| found.map(Vector6::from))
    };
    let (rates, accelerations) = (six("rates", asked[0])?, six("accelerations", asked[1])?);
    let of_platform = asked.iter().all(|given| [0, 6].contains(&given.len()));
    let velocity = robot.velocity(&pose).map_err(|error| about(file, error))?;
    if json {
        return output::print(&tripod_velocity_json(&robot, &velocity, rates, accelerations, of_platform));
    }
    let mut text = titled(&robot.name, "three-legged robot");
    line(&mut text, format_args!("rho' = J (p', omega), angles in radians"));
    let mut rows = table(&["slider", "p'x", "p'y", "p'z", "omega x", "y", "z"]);
    for k in 0..6 {
        let entries = velocity.jacobian.row(k).iter().map(|value| digits(*value, SIDE_DIGITS)).collect::<Vec<_>>();
        rows.add_row(std::iter::once((k + 1).to_string()).chain(entries));
    }
    line(&mut text, format_args!("{rows}"));
    let singularity = velocity.singularity();
    line(&mut text, format_args!("{STRONG}singularity  {}{STRONG:#}  {}", singularity.name(), singularity.reading()));
    line(&mut text, format_args!("det J  {}", digits(velocity.jacobian.determinant(), SIDE_DIGITS)));
    let volumes = [velocity.position_volume, velocity.orientation_volume];
    line(&mut text, format_args!("volumes of the planes' normals, of the turning axes  {}", numbers(&volumes)));
    if let Some(given) = rates {
        if of_platform {
            let inputs = velocity.input_rates(&given);
            line(&mut text, format_args!("slider rates for these of the platform  {}", numbers(inputs.as_slice())));
            if let Err(error) = robot.all_sliders("rates", inputs.as_slice()) {
                line(&mut text, format_args!("{ALARM}the platform does not move so: {error}{ALARM:#}"));
            }
        }
        let together = robot.all_sliders("rates", given.as_slice());
        match together.and_then(|sliders| velocity.pose_rates(&sliders.into())) {
            Ok(found) => {
                line(&mut text, format_args!("platform rates for these of the sliders  {}", numbers(found.as_slice())))
            }
            Err(error) => line(&mut text, format_args!("platform rates for these of the sliders  none: {error}")),
        }
    }
    if let Some(given) = accelerations {
        let at = rates.unwrap_or_else(Vector6::zeros);
        if of_platform {
            let inputs = velocity.input_accelerations(&at, &given);
            line(
                &mut text,
                format_args!("slider accelerations for these of the platform  {}", numbers(inputs.as_slice())),
            );
        }
        let together =
            robot.all_sliders("rates", at.as_slice()).and(robot.all_sliders("accelerations", given.as_slice()));
        match together.and_then(|sliders| velocity.pose_accelerations(&at, &sliders.into())) {
            Ok(found) => line(
                &mut text,
                format_args!("platform accelerations for these of the sliders  {}", numbers(found.as_slice())),
            ),
            Err(error) => {
                line(&mut text, format_args!("platform accelerations for these of the sliders  none: {error}"))
            }
        }
    }
    output::print(&text)
}
