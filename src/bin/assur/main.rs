//! The command line: parses, calls one function of the library, prints.

mod args;
mod batch;
mod derive;
mod explore;
mod kinematics;
mod linkages;
mod multipteron;
mod output;
mod png;
mod spatial;
mod tables;
mod workspaces;

use std::path::Path;
use std::process::ExitCode;

use args::{Arguments, Asked, Command};
use assur::Manipulator;
use assur::exchange::{AngleUnit, AnyCheck, ClaimedPoses, ForwardReport, ModelFile, Subject, VerifyReport, read_triad};
use clap::{CommandFactory, Parser};
use output::{Failure, Files};

fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => output::report(&failure),
    }
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    match arguments.command {
        Command::New { family, output } => new(&family, output.as_deref()),
        Command::Check { model, json } => {
            let report = AnyCheck::read(&model)?;
            output::print(&if json { report.to_json() } else { tables::check(&report) })
        }
        Command::Forward { model, inputs, batch: None, asked, .. } => forward(&model, &inputs, &asked),
        Command::Forward { model, batch: Some(input), output, format, asked, .. } => {
            batch::run(&model, &input, output.as_deref(), format, asked.json)
        }
        Command::Inverse { model, pose, json } => kinematics::inverse(&model, &pose, json),
        Command::Velocity { model, pose, mode, rates, accelerations, wrench, length, json } => {
            let asked = kinematics::AskedMotion { rates, accelerations, wrench, length };
            kinematics::velocity(&model, &pose, mode.as_deref(), &asked, json)
        }
        Command::Singularities { model, phi, mode, map, csv, no_polynomial, shown } => {
            let asked = kinematics::LociOptions { phi, mode, map, csv, polynomial: !no_polynomial };
            kinematics::singularities(&model, &asked, &shown)
        }
        Command::Path { model, through, from, output, shown } => {
            kinematics::path(&model, &through, &from, output.as_deref(), &shown)
        }
        Command::Explore { model, inputs, port, no_open } => explore::run(model.as_deref(), &inputs, port, !no_open),
        Command::Coupler { file, complex, shown } => linkages::coupler(&file, complex, &shown),
        Command::Group { file, inputs, complex, shown } => linkages::group(&file, &inputs, complex, &shown),
        Command::Triad { file, asked } => triad(&file, &asked),
        Command::Workspace(asked) => workspaces::workspace(&asked),
        Command::Sweep(asked) => workspaces::sweep(&asked),
        Command::Hana { command } => spatial::hana(command),
        Command::Tripod { command } => spatial::tripod(command),
        Command::Multipteron { command } => multipteron::multipteron(command),
        Command::Verify { report, model, tolerance, json } => verify(&report, &model, tolerance, json),
        Command::Derive { name: Some(name), .. } => output::print(&derive::document(&name)?),
        Command::Derive { name: None, .. } => output::print(&derive::list()),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "assur", &mut script);
            output::print(&String::from_utf8_lossy(&script))
        }
    }
}

/// Models of the spatial robots, as in `examples/`.
const SPATIAL_MODELS: [(&str, &str); 9] = [
    ("hana", include_str!("../../../examples/hana.toml")),
    ("tripod", include_str!("../../../examples/tripod-cartesian.toml")),
    ("tripod-5dof", include_str!("../../../examples/tripod-5dof.toml")),
    ("tripod-4dof", include_str!("../../../examples/tripod-4dof.toml")),
    ("tripod-inclined", include_str!("../../../examples/tripod-inclined.toml")),
    ("tripod-upright", include_str!("../../../examples/tripod-upright.toml")),
    ("tripteron", include_str!("../../../examples/tripteron.toml")),
    ("quadrupteron", include_str!("../../../examples/quadrupteron.toml")),
    ("hexapteron", include_str!("../../../examples/hexapteron.toml")),
];

fn new(family: &str, output: Option<&Path>) -> Result<(), Failure> {
    if let Some((_, text)) = SPATIAL_MODELS.iter().find(|(name, _)| family.eq_ignore_ascii_case(name)) {
        return match output {
            Some(path) => Files::default().with(path, text.as_bytes().to_vec()).write(),
            None => output::print(text),
        };
    }
    let (manipulator, inputs) = Manipulator::of_family(family)?;
    let angle_unit = AngleUnit::Deg;
    let inputs = tables::inputs(&manipulator, &inputs, angle_unit);
    let file = output.map_or("MODEL".into(), |path| path.display().to_string());
    let model = ModelFile { manipulator, angle_unit };
    let text = format!(
        "# {}. Lengths in any one unit.\n# Every assembly mode:  assur forward {file} --inputs={inputs}\n\n{}",
        model.manipulator.name,
        model.to_toml()
    );
    match output {
        Some(path) => Files::default().with(path, text.into_bytes()).write(),
        None => output::print(&text),
    }
}

fn forward(path: &Path, inputs: &[f64], asked: &Asked) -> Result<(), Failure> {
    let model = ModelFile::read(path)?;
    let robot = &model.manipulator;
    let inputs = tables::inputs_in_radians(robot, inputs, model.angle_unit);
    let answer = if asked.certify { robot.certify(&inputs) } else { robot.forward(&inputs) };
    let answer = answer.map_err(|error| {
        let error = model.angle_unit.of_lock_error(robot, error);
        Failure::About(path.display().to_string(), error.to_string())
    })?;
    Files::default().with_drawings(asked, || assur::plot::draw_modes(robot, &answer))?.write()?;
    output::print(&if asked.json {
        ForwardReport::of_manipulator(&answer).to_json()
    } else {
        tables::forward(&model, &answer, asked)
    })
}

fn triad(path: &Path, asked: &Asked) -> Result<(), Failure> {
    let triad = read_triad(path)?;
    let answer = if asked.certify { triad.certify() } else { triad.assemble() };
    Files::default().with_drawings(asked, || assur::plot::draw_assemblies(&triad, &answer))?.write()?;
    output::print(&if asked.json {
        ForwardReport::of_triad(&triad, &answer).to_json()
    } else {
        tables::triad(&triad, &answer, asked)
    })
}

fn verify(report: &Path, model: &Path, tolerance: f64, json: bool) -> Result<(), Failure> {
    let claims = ClaimedPoses::read(report)?;
    let group = match Subject::read(model)? {
        Subject::Triad(triad) => triad.certify(),
        Subject::Model(model) => {
            let answer = model.manipulator.certify(&claims.inputs);
            answer.map_err(|error| Failure::About(report.display().to_string(), error.to_string()))?.group
        }
    };
    let judgement = group.judge(&claims.poses, tolerance);
    let report = VerifyReport::of(&group, &judgement, tolerance);
    output::print(&if json { report.to_json() } else { tables::verify(&report) })
}
