//! `hana`: its kinematics, workspaces, capability.

use std::path::{Path, PathBuf};

use assur::exchange::{
    AngleUnit, AskedTilts, HanaFile, HanaTilts, capability_stop_name, hana_forward_json, hana_inverse_json,
    hana_velocity_json, hana_workspace_json,
};
use assur::nalgebra::Vector3;
use assur::plot::PosedRobot;
use assur::{HanaMode, HanaPose, HanaSingularKind, MixedReach, SpatialError, WorkspaceCurve};
use clap::{Subcommand, ValueEnum};

use super::{ROWS, about, exactly, numbers, optional, titled};
use crate::args::Shown;
use crate::output::{self, Failure, Files};
use crate::tables::{ALARM, POSE_DIGITS, SIDE_DIGITS, STRONG, digits, line, table};

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
    #[command(after_help = "The picture is a map over the workspace; with --strokes, the curve against them.\n\
        Example:  assur hana capability examples/hana.toml --at=-2,-12 --svg map.svg\n\
        Curve:    assur hana capability examples/hana.toml --strokes=0.5,1,1.5,2,2.5,3,3.5,4,4.5,5 --svg curve.svg")]
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
    let named = match kind {
        WorkspaceKind::Constant => format!("phi = {} {}", digits(phi, DRAWN_DIGITS), angle_unit.name()),
        WorkspaceKind::Reachable => name.to_owned(),
    };
    let draw = || assur::plot::draw_hana(&robot.name, &[(named.clone(), &region)], None);
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
    let drawn = strokes.is_empty() && (shown.svg.is_some() || shown.png.is_some());
    let wanted = place.is_none() || drawn;
    let asked = AskedTilts { at: place, strokes: strokes.to_vec(), cells: wanted.then_some(cells) };
    let bar = output::progress(Some(cells as u64), ROWS);
    let found = HanaTilts::of(&robot, mode, &asked, |_| bar.inc(1)).map_err(|error| about(file, error))?;
    bar.finish_and_clear();
    let HanaTilts { here, supremum: best, against_strokes: curve, region, map } = &found;
    let title = if robot.name.is_empty() { "HANA" } else { &robot.name };
    let draw = || {
        if strokes.is_empty() {
            return assur::plot::draw_hana(&robot.name, &[("φ = 0".to_owned(), region)], map.as_ref());
        }
        let points = curve.iter().map(|&(half, zeta)| (half, zeta.map(f64::to_degrees))).collect();
        let axes = ["half length of the strokes", "largest capability ζ (deg)"];
        assur::plot::draw_curves(title, "rotational capability at most", axes, &[(format!("mode {mode}"), points)])
    };
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
            let above = angle_unit.from_rad(best.at_most - best.zeta);
            line(&mut text, format_args!("  shown: no place has more than {above:.1e} {} above", angle_unit.name()));
        }
        None => line(&mut text, format_args!("the workspace of phi = 0 is empty")),
    }
    for (half, zeta) in curve {
        let zeta = zeta.map_or("empty workspace".to_owned(), angle);
        line(&mut text, format_args!("strokes of half length {half}: largest {zeta}"));
    }
    output::print(&text)
}
