//! `hana` and `tripod`: the two spatial robots.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};

use assur::exchange::{
    AngleUnit, AskedTilts, HanaFile, HanaTilts, TiltSections, TripodFile, capability_stop_name, hana_forward_json,
    hana_inverse_json, hana_velocity_json, hana_workspace_json, tilt_json, tilt_limit_name, tripod_forward_json,
    tripod_inverse_json, tripod_velocity_json,
};
use assur::nalgebra::{Matrix3, Vector3, Vector6};
use assur::{HanaMode, HanaPose, HanaSingularKind, MixedReach, SpatialError, TripodPose, TripodStatus};
use clap::{Subcommand, ValueEnum};

use crate::args::Shown;
use crate::output::{self, Failure, Files};
use crate::tables::{ALARM, POSE_DIGITS, SIDE_DIGITS, STRONG, digits, heading, line, table};

/// What can be asked of HANA.
#[derive(Subcommand)]
pub(crate) enum HanaCommand {
    /// Every working mode for a pose: slider heights, strokes that they violate.
    #[command(after_help = "Example:  assur hana inverse examples/hana.toml --pose=-2,-12,20")]
    Inverse {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The platform's pose; the angle in the model file's unit.
        #[arg(long, value_name = "Y,Z,PHI", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
        /// Prints one JSON document; angles in radians.
        #[arg(long)]
        json: bool,
    },
    /// Every assembly mode for given slider heights.
    #[command(after_help = "Example:  assur hana forward examples/hana.toml --inputs=1,-0.5,0.3")]
    Forward {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The slider heights.
        #[arg(long, value_name = "Z1,Z2,Z3", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        inputs: Vec<f64>,
        /// Prints one JSON document; angles in radians.
        #[arg(long)]
        json: bool,
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
        /// The orientation, in the model file's unit.
        #[arg(long, value_name = "PHI", default_value_t = 0.0, allow_hyphen_values = true)]
        phi: f64,
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
        matrix row by row.\nExample:  assur tripod inverse examples/tripod-cartesian.toml --pose=200,260,240,10,5,-3"
    )]
    Inverse {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The platform's pose.
        #[arg(long, value_name = "X,Y,Z,A,B,C", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
        /// Prints one JSON document; angles in radians.
        #[arg(long)]
        json: bool,
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
        /// Prints one JSON document.
        #[arg(long)]
        json: bool,
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

/// Which workspace of HANA.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum WorkspaceKind {
    /// For one orientation.
    Constant,
    /// Over all orientations between the quarter turns.
    Reachable,
}

/// The tolerance of the proved tilt, in radians.
const TOLERANCE: f64 = 1e-3;
/// Width of a progress bar.
const PROGRESS_WIDTH: usize = 30;

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

/// Shows how much is done, on a terminal only.
fn progress(done: usize, count: usize) {
    if std::io::stderr().is_terminal() {
        let filled = PROGRESS_WIDTH * done / count.max(1);
        let (full, rest) = ("#".repeat(filled), ".".repeat(PROGRESS_WIDTH - filled));
        let end = if done == count { "\n" } else { "" };
        // A progress bar that cannot be shown is no reason to stop.
        let _ = write!(std::io::stderr(), "\r[{full}{rest}] {done}/{count}{end}");
    }
}

pub(crate) fn hana(command: HanaCommand) -> Result<(), Failure> {
    match command {
        HanaCommand::Inverse { model, pose, json } => hana_inverse(&model, &pose, json),
        HanaCommand::Forward { model, inputs, json } => hana_forward(&model, &inputs, json),
        HanaCommand::Velocity { model, pose, mode, rates, accelerations, json } => {
            hana_velocity(&model, &pose, &mode, [&rates, &accelerations], json)
        }
        HanaCommand::Workspace { model, kind, phi, mode, shown } => hana_workspace(&model, kind, phi, &mode, &shown),
        HanaCommand::Capability { model, at, mode, strokes, cells, shown } => {
            hana_capability(&model, &at, &mode, &strokes, usize::from(cells), &shown)
        }
    }
}

fn hana_pose(values: &[f64], unit: AngleUnit, file: &Path) -> Result<HanaPose, Failure> {
    let [y, z, phi] = exactly("pose", values, file)?;
    Ok(HanaPose::new(y, z, unit.to_rad(phi)))
}

fn hana_inverse(file: &Path, pose: &[f64], json: bool) -> Result<(), Failure> {
    let HanaFile { robot, angle_unit } = HanaFile::read(file)?;
    let pose = hana_pose(pose, angle_unit, file)?;
    let answer = robot.inverse(&pose).map_err(|error| about(file, error))?;
    let mixed = robot.mixed_singularities(pose.y, pose.z).map_err(|error| about(file, error))?;
    let reach = robot.mixed_reach();
    if json {
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

fn hana_forward(file: &Path, inputs: &[f64], json: bool) -> Result<(), Failure> {
    let HanaFile { robot, angle_unit } = HanaFile::read(file)?;
    let inputs = exactly("inputs", inputs, file)?;
    let answer = robot.forward(&inputs).map_err(|error| about(file, error))?;
    let violations = robot.violations(&inputs);
    if json {
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

fn hana_workspace(file: &Path, kind: WorkspaceKind, phi: f64, mode: &str, shown: &Shown) -> Result<(), Failure> {
    let HanaFile { robot, angle_unit } = HanaFile::read(file)?;
    let mode = hana_mode(mode, file)?;
    let (name, region) = match kind {
        WorkspaceKind::Constant => {
            let region = robot.workspace(angle_unit.to_rad(phi), mode).map_err(|error| about(file, error))?;
            ("constant", region)
        }
        WorkspaceKind::Reachable => ("reachable", robot.reachable_workspace(mode).map_err(|error| about(file, error))?),
    };
    let draw = || assur::plot::draw_hana(&robot.name, &[(name.to_owned(), &region)], None);
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&hana_workspace_json(name, &region));
    }
    let mut text = titled(&robot.name, "HANA");
    for (area, arcs) in &region.loops {
        line(&mut text, format_args!("piece of area {}", digits(*area, POSE_DIGITS)));
        let mut rows = table(&["from y", "z", "to y", "z", "centre y", "z", "radius", "limit"]);
        for arc in arcs {
            let mut row: Vec<String> =
                arc.start.iter().chain(&arc.end).map(|value| digits(*value, SIDE_DIGITS)).collect();
            match arc.circle {
                Some(c) => row.extend([c.center[0], c.center[1], c.radius].map(|value| digits(value, SIDE_DIGITS))),
                None => row.extend(["straight".to_owned(), String::new(), String::new()]),
            }
            row.push(arc.active.to_owned());
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
    let found =
        HanaTilts::of(&robot, mode, &asked, |done| progress(done, cells)).map_err(|error| about(file, error))?;
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
        TripodCommand::Inverse { model, pose, json } => tripod_inverse(&model, &pose, json),
        TripodCommand::Forward { model, inputs, json } => tripod_forward(&model, &inputs, json),
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

fn tripod_inverse(file: &Path, pose: &[f64], json: bool) -> Result<(), Failure> {
    let TripodFile { robot, angle_unit } = TripodFile::read(file)?;
    let pose = tripod_pose(pose, angle_unit, file)?;
    let failed = |error| about(file, error);
    let inputs = robot.inverse(&pose).map_err(failed)?;
    let angles = robot.plane_angles(&pose).map_err(failed)?;
    let violations = robot.violations(&pose, &inputs).map_err(failed)?;
    if json {
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

fn tripod_forward(file: &Path, inputs: &[f64], json: bool) -> Result<(), Failure> {
    let TripodFile { robot, .. } = TripodFile::read(file)?;
    let answer = robot.forward(&exactly("inputs", inputs, file)?).map_err(|error| about(file, error))?;
    if json {
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
    let a = &answer.account;
    line(
        &mut text,
        format_args!(
            "{STRONG}{status}; degree {} = {} real + {} complex + {} spurious + {} self-motion + {} undecided{STRONG:#}",
            a.degree, a.real, a.complex, a.rejected, a.self_motion, a.undecided
        ),
    );
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
    let TripodFile { robot, .. } = TripodFile::read(file)?;
    let (low, high): ([f64; 3], [f64; 3]) = (exactly("low", corners[0], file)?, exactly("high", corners[1], file)?);
    let total = sections * cells;
    let found = TiltSections::of(&robot, low, high, [sections, cells], |done| progress(done, total));
    let found = found.map_err(|error| about(file, error))?;
    let maps = &found.maps;
    let draw = || assur::plot::draw_tilt_sections(&robot.name, low, high, cells, maps);
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    if shown.json {
        return output::print(&found.to_json());
    }
    let mut text = titled(&robot.name, "three-legged robot");
    let mut rows = table(&["z", "places within limits", "least (deg)", "largest (deg)"]);
    for (z, values) in maps {
        let known: Vec<f64> = values.iter().flatten().map(|angle| angle.to_degrees()).collect();
        let least = known.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = known.iter().copied().fold(0.0, f64::max);
        let [least, largest] =
            [least, largest].map(|a| if known.is_empty() { "-".to_owned() } else { digits(a, SIDE_DIGITS) });
        rows.add_row([digits(*z, SIDE_DIGITS), format!("{} of {}", known.len(), values.len()), least, largest]);
    }
    line(&mut text, format_args!("{rows}"));
    output::print(&text)
}
