//! `hana` and `tripod`: the two spatial robots.

use std::path::{Path, PathBuf};

use assur::exchange::{
    AngleUnit, AskedTilts, HanaFile, HanaTilts, TiltSections, TripodFile, capability_stop_name, hana_forward_json,
    hana_inverse_json, hana_velocity_json, hana_workspace_json, tilt_json, tilt_limit_name, tripod_determinant_csv,
    tripod_determinant_json, tripod_forward_json, tripod_inverse_json, tripod_velocity_json,
};
use assur::nalgebra::{Matrix3, Vector3, Vector6};
use assur::plot::PosedRobot;
use assur::{
    Counted, HanaMode, HanaPose, HanaSingularKind, MixedReach, SpatialError, TripodDesign, TripodPose, TripodStatus,
    WorkspaceCurve,
};
use clap::{Subcommand, ValueEnum};

use crate::args::Shown;
use crate::output::{self, Failure, Files};
use crate::tables::{ALARM, POSE_DIGITS, SIDE_DIGITS, STRONG, digits, heading, line, table};

/// What can be asked of HANA.
#[derive(Subcommand)]
pub(crate) enum HanaCommand {
    /// Every working mode for a pose: slider heights, strokes that they violate.
    #[command(after_help = "Example:  assur hana inverse examples/hana.toml --pose=-2,-12,20 --svg working-modes.svg")]
    Inverse {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The platform's pose; the angle in the model file's unit.
        #[arg(long, value_name = "Y,Z,PHI", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
        #[command(flatten)]
        shown: Shown,
    },
    /// Every assembly mode for given slider heights.
    #[command(after_help = "Example:  assur hana forward examples/hana.toml --inputs=1,-0.5,0.3 --svg modes.svg")]
    Forward {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The slider heights.
        #[arg(long, value_name = "Z1,Z2,Z3", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        inputs: Vec<f64>,
        #[command(flatten)]
        shown: Shown,
    },
    /// Matrices, singularity, rates and accelerations in a pose.
    #[command(after_help = "Example:  assur hana velocity examples/hana.toml --pose=-2,-12,20 --rates=1,0,0")]
    Velocity {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The platform's pose; the angle in the model file's unit.
        #[arg(long, value_name = "Y,Z,PHI", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
        /// The working mode: + for a slider above its joint.
        #[arg(long, value_name = "SIGNS", default_value = "+++", allow_hyphen_values = true)]
        mode: String,
        /// Rates of the platform (y', z', phi') or of the sliders; angles in radians.
        #[arg(long, value_name = "A,B,C", value_delimiter = ',', allow_hyphen_values = true)]
        rates: Vec<f64>,
        /// Accelerations at these rates.
        #[arg(long, value_name = "A,B,C", value_delimiter = ',', allow_hyphen_values = true)]
        accelerations: Vec<f64>,
        /// Prints one JSON document; angles in radians.
        #[arg(long)]
        json: bool,
    },
    /// The places of the platform's centre, as exact arcs.
    #[command(after_help = "Example:  assur hana workspace examples/hana.toml reachable --svg workspace.svg")]
    Workspace {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// For one orientation, or over all.
        kind: WorkspaceKind,
        /// The orientation of `constant`, in the model file's unit.
        #[arg(long, value_name = "PHI", default_value_t = 0.0, allow_hyphen_values = true)]
        phi: f64,
        /// First orientation of `reachable`, in the model file's unit; without it minus a quarter turn.
        #[arg(long, value_name = "PHI", allow_hyphen_values = true, requires = "to")]
        from: Option<f64>,
        /// Last orientation, counter-clockwise from the first; a full turn is every orientation.
        #[arg(long, value_name = "PHI", allow_hyphen_values = true, requires = "from")]
        to: Option<f64>,
        /// The working mode: + for a slider above its joint.
        #[arg(long, value_name = "SIGNS", default_value = "+++", allow_hyphen_values = true)]
        mode: String,
        #[command(flatten)]
        shown: Shown,
    },
    /// How far the platform tilts: at a place, over the workspace, against the strokes.
    #[command(
        after_help = "Example:  assur hana capability examples/hana.toml --at=-2,-12 --strokes=1,2,3,4,5 --svg map.svg"
    )]
    Capability {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// A place of the platform's centre.
        #[arg(long, value_name = "Y,Z", value_delimiter = ',', allow_hyphen_values = true)]
        at: Vec<f64>,
        /// The working mode: + for a slider above its joint.
        #[arg(long, value_name = "SIGNS", default_value = "+++", allow_hyphen_values = true)]
        mode: String,
        /// Half lengths of all strokes for which the supremum is given too.
        #[arg(long, value_name = "H1,H2,...", value_delimiter = ',', allow_hyphen_values = true)]
        strokes: Vec<f64>,
        /// Cells of the map along each side.
        #[arg(long, value_name = "N", default_value_t = 120, value_parser = clap::value_parser!(u16).range(1..=2000))]
        cells: u16,
        #[command(flatten)]
        shown: Shown,
    },
}

/// What can be asked of a three-legged robot.
#[derive(Subcommand)]
pub(crate) enum TripodCommand {
    /// Slider positions for a pose, limits that they violate.
    #[command(
        after_help = "A pose is x,y,z and a rotation vector (axis times angle, in the model file's unit), or x,y,z and the nine entries of a rotation \
        matrix row by row.\nExample:  assur tripod inverse examples/tripod-cartesian.toml --pose=200,260,240,10,5,-3 --svg pose.svg"
    )]
    Inverse {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The platform's pose.
        #[arg(long, value_name = "X,Y,Z,A,B,C", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
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
        /// The six slider positions, leg by leg.
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
        /// Rates of the platform (p', omega) or of the sliders; angles in radians.
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

/// Which workspace of HANA.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum WorkspaceKind {
    /// For one orientation.
    Constant,
    /// Over a range of orientations; by default between the quarter turns.
    Reachable,
}

/// Digits of a number in a drawing's caption.
const DRAWN_DIGITS: i32 = 4;
/// The tolerance of the proved tilt, in radians.
const TOLERANCE: f64 = 1e-3;
/// Progress bars of maps, by rows.
const ROWS: &str = "{wide_bar} {pos} of {len} rows, {eta} left";

fn about(file: &Path, error: impl std::fmt::Display) -> Failure {
    Failure::About(file.display().to_string(), error.to_string())
}

fn exactly<const N: usize>(what: &'static str, values: &[f64], file: &Path) -> Result<[f64; N], Failure> {
    let found = values.len();
    let numbers = values.try_into().map_err(|_| about(file, SpatialError::WrongCount { what, expected: N, found }))?;
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(about(file, SpatialError::NotFinite { what: what.to_owned(), value })),
        None => Ok(numbers),
    }
}

fn optional<const N: usize>(what: &'static str, values: &[f64], file: &Path) -> Result<Option<[f64; N]>, Failure> {
    (!values.is_empty()).then(|| exactly(what, values, file)).transpose()
}

fn numbers(values: &[f64]) -> String {
    values.iter().map(|value| digits(*value, SIDE_DIGITS)).collect::<Vec<_>>().join(", ")
}

fn titled(name: &str, otherwise: &str) -> String {
    let mut text = String::new();
    heading(&mut text, if name.is_empty() { otherwise } else { name });
    text
}

pub(crate) fn hana(command: HanaCommand) -> Result<(), Failure> {
    match command {
        HanaCommand::Inverse { model, pose, shown } => hana_inverse(&model, &pose, &shown),
        HanaCommand::Forward { model, inputs, shown } => hana_forward(&model, &inputs, &shown),
        HanaCommand::Velocity { model, pose, mode, rates, accelerations, json } => {
            hana_velocity(&model, &pose, &mode, [&rates, &accelerations], json)
        }
        HanaCommand::Workspace { model, kind, phi, from, to, mode, shown } => {
            hana_workspace(&model, kind, (phi, from.zip(to)), &mode, &shown)
        }
        HanaCommand::Capability { model, at, mode, strokes, cells, shown } => {
            hana_capability(&model, &at, &mode, &strokes, usize::from(cells), &shown)
        }
    }
}

fn hana_pose(values: &[f64], unit: AngleUnit, file: &Path) -> Result<HanaPose, Failure> {
    let [y, z, phi] = exactly("pose", values, file)?;
    Ok(HanaPose::new(y, z, unit.to_rad(phi)))
}

fn hana_inverse(file: &Path, pose: &[f64], shown: &Shown) -> Result<(), Failure> {
    let HanaFile { robot, angle_unit } = HanaFile::read(file)?;
    let pose = hana_pose(pose, angle_unit, file)?;
    let answer = robot.inverse(&pose).map_err(|error| about(file, error))?;
    let mixed = robot.mixed_singularities(pose.y, pose.z).map_err(|error| about(file, error))?;
    let reach = robot.mixed_reach();
    let draw = || {
        let ways =
            answer.modes.iter().map(|way| PosedRobot { caption: way.mode.to_string(), pose, inputs: way.inputs });
        assur::plot::draw_hana_poses(&robot, &ways.collect::<Vec<_>>())
    };
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&hana_inverse_json(&answer, &mixed, reach));
    }
    let mut text = titled(&robot.name, "HANA");
    let mut rows = table(&["mode", "z1", "z2", "z3"]);
    for way in &answer.modes {
        let heights = way.inputs.map(|z| digits(z, POSE_DIGITS));
        rows.add_row(std::iter::once(way.mode.to_string()).chain(heights));
    }
    if !answer.modes.is_empty() {
        line(&mut text, format_args!("{rows}"));
    }
    for way in &answer.modes {
        for v in &way.violations {
            let [low, high] = v.limit;
            let value = digits(v.value, SIDE_DIGITS);
            line(
                &mut text,
                format_args!("{ALARM}{}: slider {}: {value} outside [{low}, {high}]{ALARM:#}", way.mode, v.leg),
            );
        }
    }
    for leg in &answer.unreachable {
        let miss = digits(leg.miss, SIDE_DIGITS);
        line(&mut text, format_args!("{ALARM}leg {} does not reach: it misses by {miss}{ALARM:#}", leg.leg));
    }
    for leg in &answer.merged {
        line(&mut text, format_args!("leg {leg}: its link lies level, both ways are one (type 1)"));
    }
    for m in &mixed {
        let kind = if m.stretched { "stretched" } else { "folded" };
        let phi = digits(angle_unit.from_rad(m.phi), SIDE_DIGITS);
        let within = if m.within_strokes { "within" } else { "outside" };
        let inputs = numbers(&m.inputs);
        line(
            &mut text,
            format_args!("mixed-mode singularity here, {kind}: z1, z2 = {inputs} at phi = {phi}, {within} the strokes"),
        );
    }
    let anywhere = match reach {
        MixedReach::Nowhere => "the strokes reach no mixed-mode singularity, anywhere".to_owned(),
        MixedReach::At { y, z } => format!("the strokes reach a mixed-mode singularity at y, z = {}", numbers(&[y, z])),
        MixedReach::Touched { y } => {
            format!("the strokes just touch a mixed-mode singularity at y = {}", numbers(&[y]))
        }
    };
    line(&mut text, format_args!("{anywhere}"));
    line(&mut text, format_args!("{STRONG}{} working modes{STRONG:#}", answer.modes.len()));
    output::print(&text)
}

fn hana_forward(file: &Path, inputs: &[f64], shown: &Shown) -> Result<(), Failure> {
    let HanaFile { robot, angle_unit } = HanaFile::read(file)?;
    let inputs = exactly("inputs", inputs, file)?;
    let answer = robot.forward(&inputs).map_err(|error| about(file, error))?;
    let violations = robot.violations(&inputs);
    let draw = || {
        let posed = |(number, mode): (usize, &assur::HanaAssembly)| {
            let phi = digits(angle_unit.from_rad(mode.pose.phi), DRAWN_DIGITS);
            let caption = format!("{number}: {}, phi = {phi} {}", mode.mode, angle_unit.name());
            PosedRobot { caption, pose: mode.pose, inputs }
        };
        assur::plot::draw_hana_poses(&robot, &(1..).zip(&answer.modes).map(posed).collect::<Vec<_>>())
    };
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&hana_forward_json(&answer, &violations));
    }
    let mut text = titled(&robot.name, "HANA");
    let phi = format!("phi ({})", angle_unit.name());
    let mut rows = table(&["mode", "y", "z", &phi, "signs", "family", "mult.", "residual"]);
    for (number, mode) in (1..).zip(&answer.modes) {
        let p = mode.pose;
        let [y, z, phi] = [p.y, p.z, angle_unit.from_rad(p.phi)].map(|value| digits(value, POSE_DIGITS));
        let residual = format!("{:.0e}", mode.residual);
        let (signs, multiplicity) = (mode.mode.to_string(), mode.multiplicity.to_string());
        rows.add_row([format!("{number}"), y, z, phi, signs, mode.family.name().to_owned(), multiplicity, residual]);
    }
    if !answer.modes.is_empty() {
        line(&mut text, format_args!("{rows}"));
    }
    for v in &violations {
        let [low, high] = v.limit;
        line(&mut text, format_args!("{ALARM}slider {}: {} outside [{low}, {high}]{ALARM:#}", v.leg, v.value));
    }
    for phi in &answer.self_motions {
        let phi = digits(angle_unit.from_rad(*phi), POSE_DIGITS);
        line(&mut text, format_args!("{ALARM}self-motion at phi = {phi}: a circle of poses{ALARM:#}"));
    }
    let a = &answer.account;
    line(
        &mut text,
        format_args!(
            "{STRONG}degree {} = {} real + {} complex + {} at infinity + {} self-motion{STRONG:#}",
            a.degree, a.real, a.complex, a.at_infinity, a.self_motion
        ),
    );
    output::print(&text)
}

fn hana_mode(mode: &str, file: &Path) -> Result<HanaMode, Failure> {
    mode.parse().map_err(|error: SpatialError| about(file, error))
}

fn hana_velocity(file: &Path, pose: &[f64], mode: &str, asked: [&[f64]; 2], json: bool) -> Result<(), Failure> {
    let HanaFile { robot, angle_unit } = HanaFile::read(file)?;
    let pose = hana_pose(pose, angle_unit, file)?;
    let rates = optional::<3>("rates", asked[0], file)?.map(Vector3::from);
    let accelerations = optional::<3>("accelerations", asked[1], file)?.map(Vector3::from);
    let velocity = robot.velocity(&pose, hana_mode(mode, file)?).map_err(|error| about(file, error))?;
    if json {
        return output::print(&hana_velocity_json(&velocity, rates, accelerations));
    }
    let mut text = titled(&robot.name, "HANA");
    line(&mut text, format_args!("A (y', z', phi') + B (z1', z2', z3') = 0, angles in radians"));
    let mut rows = table(&["leg", "A: y'", "z'", "phi'", "B (diagonal)"]);
    for k in 0..3 {
        let (a, b) = (&velocity.pose_matrix, &velocity.input_matrix);
        let entries = [a[(k, 0)], a[(k, 1)], a[(k, 2)], b[(k, k)]].map(|value| digits(value, SIDE_DIGITS));
        rows.add_row(std::iter::once((k + 1).to_string()).chain(entries));
    }
    line(&mut text, format_args!("{rows}"));
    let singularity = velocity.singularity();
    line(&mut text, format_args!("{STRONG}singularity  {}{STRONG:#}", singularity.kind.name()));
    if singularity.kind != HanaSingularKind::None {
        for leg in &singularity.level_legs {
            line(&mut text, format_args!("leg {leg}: its link lies level"));
        }
        for reading in &singularity.reading {
            line(&mut text, format_args!("{reading}"));
        }
    }
    line(&mut text, format_args!("det A  {}", digits(velocity.pose_matrix.determinant(), SIDE_DIGITS)));
    line(&mut text, format_args!("dexterity  {:.6}  (angles times r)", singularity.dexterity));
    let mut say = |what: &str, found: Result<Vector3<f64>, SpatialError>| match found {
        Ok(found) => line(&mut text, format_args!("{what}  {}", numbers(found.as_slice()))),
        Err(error) => line(&mut text, format_args!("{what}  none: {error}")),
    };
    if let Some(given) = rates {
        say("slider rates for these of the platform", velocity.input_rates(&given));
        say("platform rates for these of the sliders", velocity.pose_rates(&given));
    }
    if let Some(given) = accelerations {
        let at = rates.unwrap_or_else(Vector3::zeros);
        say("slider accelerations for these of the platform", velocity.input_accelerations(&at, &given));
        say("platform accelerations for these of the sliders", velocity.pose_accelerations(&at, &given));
    }
    output::print(&text)
}

fn hana_workspace(
    file: &Path,
    kind: WorkspaceKind,
    (phi, range): (f64, Option<(f64, f64)>),
    mode: &str,
    shown: &Shown,
) -> Result<(), Failure> {
    let HanaFile { robot, angle_unit } = HanaFile::read(file)?;
    let mode = hana_mode(mode, file)?;
    let (name, region) = match kind {
        WorkspaceKind::Constant => {
            let region = robot.workspace(angle_unit.to_rad(phi), mode).map_err(|error| about(file, error))?;
            ("constant", region)
        }
        WorkspaceKind::Reachable => {
            let region = match range {
                Some((from, to)) => robot.reachable_between(mode, [from, to].map(|phi| angle_unit.to_rad(phi))),
                None => robot.reachable_workspace(mode),
            };
            ("reachable", region.map_err(|error| about(file, error))?)
        }
    };
    let draw = || assur::plot::draw_hana(&robot.name, &[(name.to_owned(), &region)], None);
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&hana_workspace_json(name, &region));
    }
    let mut text = titled(&robot.name, "HANA");
    for (area, arcs) in &region.loops {
        let what = if *area < 0.0 { "hole" } else { "piece" };
        line(&mut text, format_args!("{what} of area {}", digits(area.abs(), POSE_DIGITS)));
        let mut rows = table(&["from y", "z", "to y", "z", "centre y", "z", "radius", "limit"]);
        for arc in arcs {
            let mut row: Vec<String> =
                arc.start.iter().chain(&arc.end).map(|value| digits(*value, SIDE_DIGITS)).collect();
            match arc.curve {
                WorkspaceCurve::Circle(c) => {
                    row.extend([c.center[0], c.center[1], c.radius].map(|value| digits(value, SIDE_DIGITS)));
                }
                other => row.extend([other.name().to_owned(), String::new(), String::new()]),
            }
            row.push(arc.active.join(", "));
            rows.add_row(row);
        }
        line(&mut text, format_args!("{rows}"));
    }
    let empty = if region.loops.is_empty() { "  (empty)" } else { "" };
    line(&mut text, format_args!("{STRONG}area {}{empty}{STRONG:#}", digits(region.area, POSE_DIGITS)));
    line(&mut text, format_args!("perimeter {}", digits(region.perimeter, POSE_DIGITS)));
    output::print(&text)
}

fn hana_capability(
    file: &Path,
    at: &[f64],
    mode: &str,
    strokes: &[f64],
    cells: usize,
    shown: &Shown,
) -> Result<(), Failure> {
    let HanaFile { robot, angle_unit } = HanaFile::read(file)?;
    let mode = hana_mode(mode, file)?;
    let place: Option<[f64; 2]> = optional("at", at, file)?;
    let wanted = place.is_none() || shown.svg.is_some() || shown.png.is_some();
    let asked = AskedTilts { at: place, strokes: strokes.to_vec(), cells: wanted.then_some(cells) };
    let bar = output::progress(Some(cells as u64), ROWS);
    let found = HanaTilts::of(&robot, mode, &asked, |_| bar.inc(1)).map_err(|error| about(file, error))?;
    bar.finish_and_clear();
    let HanaTilts { here, supremum: best, against_strokes: curve, region, map } = &found;
    let draw = || assur::plot::draw_hana(&robot.name, &[("phi = 0".to_owned(), region)], map.as_ref());
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&found.to_json());
    }
    let mut text = titled(&robot.name, "HANA");
    let angle = |value: f64| format!("{} {}", digits(angle_unit.from_rad(value), POSE_DIGITS), angle_unit.name());
    match here {
        Some((at, Some(found))) => {
            line(&mut text, format_args!("{STRONG}zeta at ({}) = {}{STRONG:#}", numbers(at), angle(found.zeta)));
            for (phi, stop) in found.range.iter().zip(found.stops) {
                line(&mut text, format_args!("  tilts to {}: {}", angle(*phi), capability_stop_name(stop)));
            }
        }
        Some((at, None)) => line(&mut text, format_args!("({}) is outside the workspace of phi = 0", numbers(at))),
        None => {}
    }
    match best {
        Some(best) => {
            let how = if best.attained { "had" } else { "approached from below" };
            line(&mut text, format_args!("largest {}, {how} at ({})", angle(best.zeta), numbers(&best.at)));
        }
        None => line(&mut text, format_args!("the workspace of phi = 0 is empty")),
    }
    for (half, zeta) in curve {
        let zeta = zeta.map_or("empty workspace".to_owned(), angle);
        line(&mut text, format_args!("strokes of half length {half}: largest {zeta}"));
    }
    output::print(&text)
}

pub(crate) fn tripod(command: TripodCommand) -> Result<(), Failure> {
    match command {
        TripodCommand::Inverse { model, pose, shown } => tripod_inverse(&model, &pose, &shown),
        TripodCommand::Forward { model, inputs, certify, shown } => tripod_forward(&model, &inputs, certify, &shown),
        TripodCommand::Determinant { design, d1, d2, pose, from, to, points, csv, shown } => {
            determinant(design, [d1, d2], &pose, ([from, to], points as usize), csv.as_deref(), &shown)
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

fn tripod_pose(values: &[f64], unit: AngleUnit, file: &Path) -> Result<TripodPose, Failure> {
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
    let header = format!("plane angle ({})", angle_unit.name());
    let mut rows = table(&["leg", "rho a", "rho b", &header]);
    for k in 0..3 {
        let values = [inputs[2 * k], inputs[2 * k + 1], angle_unit.from_rad(angles[k])];
        rows.add_row(std::iter::once((k + 1).to_string()).chain(values.map(|value| digits(value, POSE_DIGITS))));
    }
    line(&mut text, format_args!("{rows}"));
    for v in &violations {
        let shown =
            |value: f64| digits(if v.slider.is_none() { angle_unit.from_rad(value) } else { value }, SIDE_DIGITS);
        let what = v.slider.map_or(format!("plane angle of leg {}", v.leg), |slider| format!("slider {slider}"));
        let [low, high] = v.limit.map(shown);
        line(&mut text, format_args!("{ALARM}{what}: {} outside [{low}, {high}]{ALARM:#}", shown(v.value)));
    }
    output::print(&text)
}

fn tripod_forward(file: &Path, inputs: &[f64], certify: bool, shown: &Shown) -> Result<(), Failure> {
    let TripodFile { robot, .. } = TripodFile::read(file)?;
    let inputs = exactly("inputs", inputs, file)?;
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

fn determinant(
    design: DesignName,
    distances: [f64; 2],
    poses: &[String],
    (range, points): ([f64; 2], usize),
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
            (given.clone(), points.iter().map(|p| (degrees.from_rad(p.elevation), p.determinant)).collect())
        });
        let what = if design == TripodDesign::Inclined { "rails" } else { "platform axes" };
        let title = format!(
            "det J of the design with {} {what}",
            if design == TripodDesign::Inclined { "inclined" } else { "raised" }
        );
        let subtitle = "one curve a pose: x, y, z and rotation vector in degrees";
        let axes = [&*format!("elevation of the {what} (deg)"), "det J"];
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
                line(&mut text, format_args!("  largest of those taken: det J = {value} at {at} deg"));
            }
            None => line(&mut text, format_args!("  singular of type 1 throughout")),
        }
        let zeros: Vec<String> = known()
            .collect::<Vec<_>>()
            .windows(2)
            .filter(|pair| pair[0].1 * pair[1].1 < 0.0)
            .map(|pair| format!("{} to {}", pair[0].0, pair[1].0))
            .collect();
        if !zeros.is_empty() {
            line(&mut text, format_args!("  changes sign between {} deg", zeros.join(", ")));
        }
    }
    output::print(&text)
}

fn tripod_velocity(file: &Path, pose: &[f64], asked: [&[f64]; 2], json: bool) -> Result<(), Failure> {
    let TripodFile { robot, angle_unit } = TripodFile::read(file)?;
    let pose = tripod_pose(pose, angle_unit, file)?;
    let rates = optional::<6>("rates", asked[0], file)?.map(Vector6::from);
    let accelerations = optional::<6>("accelerations", asked[1], file)?.map(Vector6::from);
    let velocity = robot.velocity(&pose).map_err(|error| about(file, error))?;
    if json {
        return output::print(&tripod_velocity_json(&velocity, rates, accelerations));
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
        let inputs = velocity.input_rates(&given);
        line(&mut text, format_args!("slider rates for these of the platform  {}", numbers(inputs.as_slice())));
        match velocity.pose_rates(&given) {
            Ok(found) => {
                line(&mut text, format_args!("platform rates for these of the sliders  {}", numbers(found.as_slice())))
            }
            Err(error) => line(&mut text, format_args!("platform rates for these of the sliders  none: {error}")),
        }
    }
    if let Some(given) = accelerations {
        let at = rates.unwrap_or_else(Vector6::zeros);
        let inputs = velocity.input_accelerations(&at, &given);
        line(&mut text, format_args!("slider accelerations for these of the platform  {}", numbers(inputs.as_slice())));
        match velocity.pose_accelerations(&at, &given) {
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

fn tilt(file: &Path, at: &[f64], tolerance: Option<f64>, shown: &Shown) -> Result<(), Failure> {
    let TripodFile { robot, angle_unit } = TripodFile::read(file)?;
    let place = Vector3::from(exactly::<3>("at", at, file)?);
    let failed = |error| about(file, error);
    if shown.svg.is_some() || shown.png.is_some() {
        return Err(about(file, "a picture is of a map: give --low and --high in place of --at"));
    }
    let found = robot.tilt(&place).map_err(failed)?;
    let tolerance = tolerance.map_or(TOLERANCE, |angle| angle_unit.to_rad(angle));
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(about(file, SpatialError::NotPositive { what: "tolerance".to_owned(), value: tolerance }));
    }
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

fn tilt_map(file: &Path, corners: [&[f64]; 2], sections: usize, cells: usize, shown: &Shown) -> Result<(), Failure> {
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
