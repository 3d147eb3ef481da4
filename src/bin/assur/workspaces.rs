//! Workspaces and sweeps on the command line.

use std::path::{Path, PathBuf};

use assur::exchange::{
    AngleUnit, Measure, ModelFile, RowFormat, Sweep, Variation, WorkspaceReport, parse_workspace_kind, read_points,
    workspace_csv, workspace_dxf,
};
use assur::plane::PhiRange;
use assur::plot::{WorkspaceLayer, draw_workspaces};
use assur::workspace::{
    DesignChoice, Isolated, Membership, Region, StrokeVoid, Workspace, WorkspaceError, WorkspaceKind, WorkspaceModes,
};
use assur::{DesignKey, Manipulator, Pose};
use clap::{Args, ValueEnum};

use crate::args::{Rows, Shown};
use crate::kinematics::{about, title};
use crate::output::{self, Failure, Files};
use crate::tables::{ALARM, SIDE_DIGITS, STRONG, digits, heading, line, table};

/// Digits of areas and of places.
const AREA_DIGITS: i32 = 12;

/// Which workspace.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum KindName {
    /// Reached with the orientation --phi.
    Constant,
    /// Reached with some orientation.
    Maximal,
    /// Reached with some orientation between --from and --to.
    Inclusive,
    /// Reached with every orientation between --from and --to.
    Total,
    /// Reached with every orientation.
    Dextrous,
}

/// What is asked of a workspace.
#[derive(Args)]
pub(crate) struct WorkspaceArgs {
    /// Model file, TOML or JSON; - is standard input.
    model: PathBuf,
    /// Which workspace.
    #[arg(value_enum)]
    kind: KindName,
    /// The orientation of a constant-orientation workspace, in the model file's unit.
    #[arg(long, value_name = "PHI", allow_hyphen_values = true)]
    phi: Option<f64>,
    /// The first orientation of a range; it runs counter-clockwise.
    #[arg(long, value_name = "A", allow_hyphen_values = true, requires = "to")]
    from: Option<f64>,
    /// The last orientation of a range; the first again is that orientation alone, a full turn or more is every orientation.
    #[arg(long, value_name = "B", allow_hyphen_values = true, requires = "from")]
    to: Option<f64>,
    /// Working modes: a sign for each leg, or both.
    #[arg(long, value_name = "SIGNS", default_value = "both", allow_hyphen_values = true)]
    mode: String,
    /// Tells of each point of a file (CSV with the header x,y, or .jsonl) whether it is inside, and its margin.
    #[arg(long, value_name = "FILE")]
    points: Option<PathBuf>,
    /// Only what the assembly in this pose reaches without being taken apart (with maximal).
    #[arg(long, value_name = "X,Y,PHI", value_delimiter = ',', allow_hyphen_values = true)]
    assembly: Vec<f64>,
    /// Draws another workspace into the picture and lists it: constant:PHI, maximal, inclusive:A:B, total:A:B, dextrous; may be repeated.
    #[arg(long, value_name = "KIND")]
    overlay: Vec<String>,
    /// Lists constant-orientation workspaces over the orientations of the kind, and the volume of them all.
    #[arg(long, value_name = "N", num_args = 0..=1, default_missing_value = "13")]
    slices: Option<usize>,
    /// The area's derivative by a number of the design, as leg1.platform.at.x; may be repeated.
    #[arg(long, value_name = "KEY")]
    gradient: Vec<String>,
    /// Looks for the largest area with this number of the design between two bounds; may be repeated.
    #[arg(long, value_name = "KEY=A:B", allow_hyphen_values = true)]
    optimise: Vec<String>,
    /// Writes the boundary into a DXF file.
    #[arg(long, value_name = "FILE")]
    dxf: Option<PathBuf>,
    /// Writes points along the boundary into a CSV file.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    shown: Shown,
}

/// What is asked of many designs.
#[derive(Args)]
pub(crate) struct SweepArgs {
    /// Model file, TOML or JSON; - is standard input.
    model: PathBuf,
    /// A number of the design and N values from A to B, as leg1.platform.at.x=-3:3:100; repeated for a grid.
    #[arg(long, value_name = "KEY=A:B:N", required = true, allow_hyphen_values = true)]
    vary: Vec<String>,
    /// What is measured: area, perimeter, components, holes, xmin, ymin, xmax or ymax of a kind, as area:maximal,holes:constant:30.
    #[arg(long, value_name = "WHAT:KIND,...", required = true, value_delimiter = ',')]
    report: Vec<String>,
    /// Working modes: a sign for each leg, or both.
    #[arg(long, value_name = "SIGNS", default_value = "both", allow_hyphen_values = true)]
    mode: String,
    /// Where the rows go, .csv, .jsonl or .parquet; standard output without it.
    #[arg(long, short, value_name = "OUT")]
    output: Option<PathBuf>,
    /// The form of the output where its name does not tell.
    #[arg(long, value_enum)]
    format: Option<Rows>,
}

/// The kind that a name and its angles stand for.
fn kind_of(asked: &WorkspaceArgs, unit: AngleUnit, file: &Path) -> Result<WorkspaceKind, Failure> {
    let finite = |what: &str, value: f64| {
        if value.is_finite() {
            Ok(unit.to_rad(value))
        } else {
            Err(about(file, format!("{what}: {value} must be finite")))
        }
    };
    let needs = |what: &str| about(file, what);
    let range = || match (asked.from, asked.to) {
        (Some(from), Some(to)) => Ok(PhiRange::between(finite("from", from)?, finite("to", to)?)),
        _ => Err(needs("this kind needs --from and --to")),
    };
    let surplus = match asked.kind {
        KindName::Constant => asked.from.is_some().then_some("--from and --to"),
        KindName::Inclusive | KindName::Total => asked.phi.is_some().then_some("--phi"),
        KindName::Maximal | KindName::Dextrous => {
            (asked.phi.is_some() || asked.from.is_some()).then_some("--phi, --from and --to")
        }
    };
    if let Some(options) = surplus {
        return Err(needs(&format!("this kind takes no {options}")));
    }
    Ok(match asked.kind {
        KindName::Constant => {
            WorkspaceKind::Constant { phi: finite("phi", asked.phi.ok_or_else(|| needs("constant needs --phi"))?)? }
        }
        KindName::Maximal => WorkspaceKind::Maximal,
        KindName::Inclusive => WorkspaceKind::Inclusive(range()?),
        KindName::Total => WorkspaceKind::Total(range()?),
        KindName::Dextrous => WorkspaceKind::Dextrous,
    })
}

pub(crate) fn workspace(asked: &WorkspaceArgs) -> Result<(), Failure> {
    let file = asked.model.as_path();
    let model = ModelFile::read(file)?;
    let (robot, unit) = (&model.manipulator, model.angle_unit);
    let failed = |error: WorkspaceError| about(file, error);
    let kind = kind_of(asked, unit, file)?;
    let modes: WorkspaceModes = asked.mode.parse().map_err(failed)?;
    let reach = robot.reach(&modes).map_err(failed)?;
    let points = asked.points.as_deref().map(read_points).transpose()?.unwrap_or_default();
    let assembly = match (&asked.assembly[..], asked.kind) {
        ([], _) => None,
        (&[x, y, phi], KindName::Maximal) => Some(Pose::new(x, y, unit.to_rad(phi))),
        ([_, _, _], _) => return Err(about(file, "--assembly goes with the kind maximal")),
        (values, _) => return Err(about(file, format!("assembly: {} values, must be 3 (x, y, phi)", values.len()))),
    };
    let workspace = match &assembly {
        Some(pose) => reach.assembly(pose),
        None => reach.workspace(&kind),
    };
    let workspace = workspace.map_err(failed)?;
    let overlays: Vec<(String, Workspace)> = asked
        .overlay
        .iter()
        .map(|text| {
            let kind = parse_workspace_kind(text, unit).map_err(|error| about(file, format!("overlay {error}")))?;
            Ok((kind_name(&kind, unit), reach.workspace(&kind).map_err(failed)?))
        })
        .collect::<Result<_, Failure>>()?;
    let members: Vec<([f64; 2], Membership)> =
        points.iter().map(|&at| (at, reach.membership(&kind, at.into()))).collect();

    let one = if assembly.is_some() { " of one assembly" } else { "" };
    let draw = || {
        let own = WorkspaceLayer { name: format!("{}{one}", kind_name(&workspace.kind, unit)), workspace: &workspace };
        let layers: Vec<WorkspaceLayer> = std::iter::once(own)
            .chain(overlays.iter().map(|(name, workspace)| WorkspaceLayer { name: name.clone(), workspace }))
            .collect();
        // Several workspaces have several answers for each leg; a leg may reach without bound.
        let legs: Vec<Region> = (0..robot.legs.len())
            .map_while(|leg| reach.only(leg).workspace(&kind).ok().map(|own| own.region))
            .collect();
        let alone = overlays.is_empty() && legs.len() == robot.legs.len();
        draw_workspaces(robot, &layers, if alone { &legs } else { &[] })
    };
    let mut files = Files::default().with_pictures(asked.shown.svg.as_deref(), asked.shown.png.as_deref(), draw)?;
    if let Some(path) = &asked.dxf {
        files = files.with(path, workspace_dxf(&workspace).into_bytes());
    }
    if let Some(path) = &asked.csv {
        files = files.with(path, workspace_csv(&workspace).into_bytes());
    }
    files.write()?;
    let stack = asked.slices.map(|count| {
        let range = match kind {
            WorkspaceKind::Constant { phi } => PhiRange { from: phi, width: 0.0 },
            WorkspaceKind::Inclusive(range) | WorkspaceKind::Total(range) => range,
            WorkspaceKind::Maximal | WorkspaceKind::Dextrous => PhiRange::between(0.0, std::f64::consts::TAU),
        };
        robot.workspace_stack(range, count, &modes)
    });
    let stack = stack.transpose().map_err(failed)?;
    let keys: Vec<DesignKey> =
        asked.gradient.iter().map(|text| text.parse()).collect::<Result<_, _>>().map_err(|error| about(file, error))?;
    let slopes = slopes(robot, &workspace, &modes, &keys).map_err(|error| about(file, error))?;
    let found =
        if asked.optimise.is_empty() { None } else { Some(optimise(&model, file, &kind, &modes, &asked.optimise)?) };
    if asked.shown.json {
        let mut report =
            WorkspaceReport::new(&workspace, &modes, assembly.map(|pose| [pose.x, pose.y, pose.phi]), &members);
        report.overlays = overlays.iter().map(|(_, other)| WorkspaceReport::new(other, &modes, None, &[])).collect();
        if let Some(stack) = &stack {
            report = report.with_stack(stack);
        }
        report.gradient = keys.iter().map(ToString::to_string).zip(slopes).collect();
        if let Some((choices, best)) = &found {
            let names: Vec<String> = choices.iter().map(|(key, _)| key.to_string()).collect();
            report = report.with_optimum(&names, best);
        }
        return output::print(&report.to_json());
    }
    let mut text = String::new();
    heading(&mut text, &title(&model));
    let what = format!("{} workspace{one}", kind_name(&workspace.kind, unit));
    line(&mut text, format_args!("{}, {what}, modes {modes}", robot.family()));
    measures(&mut text, &workspace);
    for (leg, void) in (1..).zip(robot.stroke_voids()) {
        if let Some(StrokeVoid::Lens { area, .. }) = void {
            let area = digits(area, SIDE_DIGITS);
            line(&mut text, format_args!("leg {leg}: a stroke shorter than two links leaves a void of area {area}"));
        }
    }
    for (name, other) in &overlays {
        line(&mut text, format_args!("\n{STRONG}{name}{STRONG:#}"));
        measures(&mut text, other);
    }
    if !members.is_empty() {
        let mut rows = table(&["x", "y", "inside", "margin", "binding"]);
        for ([x, y], member) in &members {
            let binding = member.binding.map_or("-".to_owned(), |limit| limit.to_string());
            let inside = if member.inside { "yes" } else { "no" };
            rows.add_row([
                digits(*x, AREA_DIGITS),
                digits(*y, AREA_DIGITS),
                inside.to_owned(),
                digits(member.margin, SIDE_DIGITS),
                binding,
            ]);
        }
        line(&mut text, format_args!("{rows}"));
    }
    if let Some(stack) = &stack {
        let mut rows = table(&[&format!("phi ({})", unit.name()), "area", "pieces", "holes"]);
        for slice in &stack.slices {
            let WorkspaceKind::Constant { phi } = slice.kind else { continue };
            let region = &slice.region;
            rows.add_row([
                digits(unit.from_rad(phi), SIDE_DIGITS),
                digits(region.area, AREA_DIGITS),
                region.components.to_string(),
                region.holes.to_string(),
            ]);
        }
        line(&mut text, format_args!("{rows}"));
        let (volume, error) = (digits(stack.volume, 10), digits(stack.volume_error, 2));
        line(&mut text, format_args!("volume in (x, y, phi)  {volume}  ± {error}, area times radians"));
    }
    for (key, slope) in keys.iter().zip(&slopes) {
        let by = if key.is_angle(robot) { "rad" } else { "unit of length" };
        line(&mut text, format_args!("d area / d {key}  {}  per {by}", digits(*slope, AREA_DIGITS)));
    }
    if let Some((choices, best)) = &found {
        line(&mut text, format_args!("\n{STRONG}largest area found{STRONG:#}  {}", digits(best.area, AREA_DIGITS)));
        line(
            &mut text,
            format_args!("before  {}; {} designs measured", digits(best.area_before, AREA_DIGITS), best.evaluations),
        );
        let mut rows = table(&["number", "value", "d area / d number"]);
        for (((key, _), value), slope) in choices.iter().zip(&best.values).zip(&best.gradient) {
            let shown = if key.is_angle(robot) { unit.from_rad(*value) } else { *value };
            rows.add_row([key.to_string(), digits(shown, AREA_DIGITS), digits(*slope, 4)]);
        }
        line(&mut text, format_args!("{rows}"));
    }
    output::print(&text)
}

/// The derivative of the area by what each name stands for.
fn slopes(
    robot: &Manipulator,
    workspace: &Workspace,
    modes: &WorkspaceModes,
    keys: &[DesignKey],
) -> Result<Vec<f64>, Box<dyn std::error::Error>> {
    keys.iter().map(|key| Ok(robot.area_gradient(workspace, modes, &key.numbers(robot)?)?.iter().sum())).collect()
}

type Chosen = (Vec<(DesignKey, DesignChoice)>, assur::workspace::Optimum);

fn optimise(
    model: &ModelFile,
    file: &Path,
    kind: &WorkspaceKind,
    modes: &WorkspaceModes,
    asked: &[String],
) -> Result<Chosen, Failure> {
    let (robot, unit) = (&model.manipulator, model.angle_unit);
    let choice = |text: &String| -> Result<(DesignKey, DesignChoice), Failure> {
        let bad =
            || about(file, format!("optimise \"{text}\": must be KEY=A:B with A < B, as in leg1.platform.at.x=-3:3"));
        let (key, bounds) = text.split_once('=').ok_or_else(bad)?;
        let (low, high) = bounds.split_once(':').ok_or_else(bad)?;
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(bad);
        let key: DesignKey = key.trim().parse().map_err(|error| about(file, error))?;
        let numbers = key.numbers(robot).map_err(|error| about(file, error))?;
        let (low, high) = (number(low)?, number(high)?);
        if low >= high {
            return Err(bad());
        }
        let bounds = [low, high].map(|value| if key.is_angle(robot) { unit.to_rad(value) } else { value });
        Ok((key, DesignChoice { numbers, bounds }))
    };
    let choices = asked.iter().map(choice).collect::<Result<Vec<_>, _>>()?;
    let only: Vec<DesignChoice> = choices.iter().map(|(_, choice)| choice.clone()).collect();
    let best = robot.optimise_area(kind, modes, &only).map_err(|error| about(file, error))?;
    Ok((choices, best))
}

/// What a kind is called for people, angles in the file's unit.
fn kind_name(kind: &WorkspaceKind, unit: AngleUnit) -> String {
    let sign = if unit == AngleUnit::Deg { "°" } else { " rad" };
    let angle = |angle: f64| format!("{}{sign}", digits(unit.from_rad(angle), SIDE_DIGITS));
    match kind {
        WorkspaceKind::Constant { phi } => format!("constant, φ = {}", angle(*phi)),
        WorkspaceKind::Maximal | WorkspaceKind::Dextrous => kind.name().to_owned(),
        WorkspaceKind::Inclusive(range) | WorkspaceKind::Total(range) => {
            format!("{}, φ {} … {}", kind.name(), angle(range.from), angle(range.from + range.width))
        }
    }
}

fn measures(text: &mut String, workspace: &Workspace) {
    let region = &workspace.region;
    if !region.unclosed.is_empty() {
        let count = region.unclosed.len();
        line(text, format_args!("{ALARM}undecided{ALARM:#}: {count} pieces of boundary could not be joined to loops"));
    }
    if region.is_empty() {
        line(text, format_args!("{ALARM}empty{ALARM:#}"));
        return;
    }
    let place = |[x, y]: [f64; 2]| format!("({}, {})", digits(x, SIDE_DIGITS), digits(y, SIDE_DIGITS));
    line(text, format_args!("area       {STRONG}{}{STRONG:#}", digits(region.area, AREA_DIGITS)));
    line(text, format_args!("perimeter  {}", digits(region.perimeter, AREA_DIGITS)));
    line(text, format_args!("pieces     {}, holes {}", region.components, region.holes));
    if let Some(centroid) = region.centroid {
        line(text, format_args!("centroid   {}", place(centroid)));
    }
    if let Some([x0, y0, x1, y1]) = region.bbox {
        line(text, format_args!("box        {} to {}", place([x0, y0]), place([x1, y1])));
    }
    if !region.loops.is_empty() {
        let mut rows = table(&["loop", "arc", "curve", "start", "end", "length", "active"]);
        for (number, one) in (1..).zip(&region.loops) {
            for (k, arc) in (1..).zip(&one.arcs) {
                let active = arc.active.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
                let which = if one.area < 0.0 { format!("{number} (hole)") } else { number.to_string() };
                rows.add_row([
                    if k == 1 { which } else { String::new() },
                    k.to_string(),
                    assur::exchange::curve_name(&arc.curve).to_owned(),
                    place(arc.start),
                    place(arc.end),
                    digits(arc.length(), SIDE_DIGITS),
                    active,
                ]);
            }
        }
        line(text, format_args!("{rows}"));
    }
    for part in &region.isolated {
        match part {
            Isolated::Point { at, .. } => line(text, format_args!("isolated point {}", place(*at))),
            Isolated::Curve(arc) => line(
                text,
                format_args!(
                    "isolated curve from {} to {}, length {}",
                    place(arc.start),
                    place(arc.end),
                    digits(arc.length(), SIDE_DIGITS)
                ),
            ),
        }
    }
    if !workspace.separating.is_empty() {
        let length: f64 = workspace.separating.iter().map(|arc| arc.length()).sum();
        let length = digits(length, SIDE_DIGITS);
        line(text, format_args!("separating arcs inside: {}, length {length}", workspace.separating.len()));
    }
}

pub(crate) fn sweep(asked: &SweepArgs) -> Result<(), Failure> {
    let file = asked.model.as_path();
    let model = ModelFile::read(file)?;
    let failed = |error: &dyn std::fmt::Display| Failure::About(file.display().to_string(), error.to_string());
    let modes: WorkspaceModes = asked.mode.parse().map_err(|error| failed(&error))?;
    let variations: Vec<Variation> =
        asked.vary.iter().map(|text| text.parse()).collect::<Result<_, _>>().map_err(|error| failed(&error))?;
    let measures: Vec<Measure> = asked
        .report
        .iter()
        .map(|text| Measure::parse(text, model.angle_unit))
        .collect::<Result<_, _>>()
        .map_err(|error| failed(&error))?;
    // A model without any workspaces is one error, not a table of them.
    model.manipulator.reach(&modes).map_err(|error| failed(&error))?;
    let sweep = Sweep::new(&model, variations, measures, modes).map_err(|error| failed(&error))?;
    let format = match (asked.format, asked.output.as_deref()) {
        (Some(Rows::Csv), _) | (None, None) => RowFormat::Csv,
        (Some(Rows::Jsonl), _) => RowFormat::JsonLines,
        (Some(Rows::Parquet), _) => RowFormat::Parquet,
        (None, Some(path)) => RowFormat::of_path(path).ok_or_else(|| {
            failed(&format!("output {}: its ending tells no form; name one with --format", path.display()))
        })?,
    };
    let bar = output::progress(Some(sweep.designs() as u64), "{wide_bar} {pos} of {len} designs, {eta} left");
    let table = sweep.run(|done| bar.set_position(done as u64));
    bar.finish_and_clear();
    let bytes = table.to_bytes(format);
    match asked.output.as_deref().filter(|path| *path != Path::new("-")) {
        Some(path) => Files::default().with(path, bytes).write()?,
        None => output::print_bytes(&bytes)?,
    }
    if table.failures() > 0 {
        eprintln!("{} of {} designs could not be asked; their rows say why", table.failures(), table.rows());
    }
    Ok(())
}
