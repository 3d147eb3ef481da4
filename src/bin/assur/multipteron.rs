//! `multipteron`: Tripteron, Quadrupteron and Hexapteron as models.

use std::path::{Path, PathBuf};

use assur::TripodPose;
use assur::exchange::{MultipteronFile, multipteron_forward_json, multipteron_inverse_json};
use assur::nalgebra::Vector3;
use assur::plot::draw_multipteron_poses;
use clap::Subcommand;

use crate::args::Shown;
use crate::output::{self, Failure, Files};
use crate::tables::{POSE_DIGITS, SIDE_DIGITS, STRONG, digits, heading, line};

/// What can be asked of a Multipteron.
#[derive(Subcommand)]
pub(crate) enum MultipteronCommand {
    /// Every pose for given slider positions.
    #[command(after_help = "Example:  assur multipteron forward examples/quadrupteron.toml --inputs=0.8,1.2,0.9,0.4")]
    Forward {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The slider positions.
        #[arg(long, value_name = "R1,R2,...", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        inputs: Vec<f64>,
        #[command(flatten)]
        shown: Shown,
    },
    /// Slider positions for a pose.
    #[command(after_help = "Example:  assur multipteron inverse examples/hexapteron.toml --pose=20,-10,30,5,0,10")]
    Inverse {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The place and a rotation vector, in the model file's unit; or the place alone.
        #[arg(long, value_name = "X,Y,Z[,A,B,C]", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
        #[command(flatten)]
        shown: Shown,
    },
}

pub(crate) fn multipteron(command: MultipteronCommand) -> Result<(), Failure> {
    match command {
        MultipteronCommand::Forward { model, inputs, shown } => forward(&model, &inputs, &shown),
        MultipteronCommand::Inverse { model, pose, shown } => inverse(&model, &pose, &shown),
    }
}

fn about(file: &Path, error: impl std::fmt::Display) -> Failure {
    Failure::About(file.display().to_string(), error.to_string())
}

fn titled(model: &MultipteronFile) -> String {
    let mut text = String::new();
    heading(&mut text, model.title());
    text
}

fn drawn(model: &MultipteronFile, poses: &[(String, TripodPose)], shown: &Shown) -> Result<(), Failure> {
    let draw = || draw_multipteron_poses(model.title(), &model.robot, poses);
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()
}

fn forward(file: &Path, inputs: &[f64], shown: &Shown) -> Result<(), Failure> {
    let model = MultipteronFile::read(file)?;
    let answer = model.robot.forward(inputs).map_err(|error| about(file, error))?;
    let numbered = (1..).zip(&answer.poses).map(|(number, &pose): (usize, _)| (format!("mode {number}"), pose));
    drawn(&model, &numbered.collect::<Vec<_>>(), shown)?;
    if shown.json {
        return output::print(&multipteron_forward_json(&model.robot, inputs, &answer));
    }
    let mut text = titled(&model);
    for (number, pose) in (1..).zip(&answer.poses) {
        let list = |values: &[f64]| values.iter().map(|x| digits(*x, POSE_DIGITS)).collect::<Vec<_>>().join(", ");
        let turn: Vec<f64> = pose.rotation.scaled_axis().iter().map(|x| model.angle_unit.from_rad(*x)).collect();
        let place = list(pose.position.as_slice());
        line(&mut text, format_args!("{STRONG}mode {number}{STRONG:#}  x, y, z = {place}"));
        line(&mut text, format_args!("  rotation vector ({}) = {}", model.angle_unit.name(), list(&turn)));
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

fn inverse(file: &Path, pose: &[f64], shown: &Shown) -> Result<(), Failure> {
    let model = MultipteronFile::read(file)?;
    let (place, turn) = match *pose {
        [x, y, z] => (Vector3::new(x, y, z), Vector3::zeros()),
        [x, y, z, a, b, c] => {
            (Vector3::new(x, y, z), Vector3::new(a, b, c).map(|angle| model.angle_unit.to_rad(angle)))
        }
        _ => return Err(about(file, format!("pose: {} given, must be 3 or 6", pose.len()))),
    };
    let inputs = model.robot.inverse(&place, &turn).map_err(|error| about(file, error))?;
    drawn(&model, &[(String::new(), TripodPose::new(place, turn))], shown)?;
    if shown.json {
        return output::print(&multipteron_inverse_json(&model.robot, &place, &turn, &inputs));
    }
    let mut text = titled(&model);
    for (slider, value) in (1..).zip(&inputs) {
        line(&mut text, format_args!("slider {slider}  {}", digits(*value, SIDE_DIGITS)));
    }
    output::print(&text)
}
