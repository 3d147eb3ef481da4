//! What can be asked on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

/// Every assembly mode of planar mechanisms.
#[derive(Parser)]
#[command(version, about, arg_required_else_help = true)]
#[command(after_help = "Start with:  assur new 3-RPR --output arm.toml\n\
    Exit status: 0 answered (also \"none\"), 1 the question could not be asked or answered, 2 wrong usage.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Prints a commented model to start from.
    #[command(
        after_help = "Families: 3-RPR, 3-RRR, 3-PRR, 3-RRP, 3-PRP, 3-PPR, 3-RPP; with the actuated joint marked, \
        3-_R_RR; three different legs, R_P_R,_P_RR,_R_RR.\nExample:  assur new 3-RPR --output arm.toml"
    )]
    New {
        /// The family, as 3-RPR.
        family: String,
        /// The file to write; without it the model is printed.
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Says whether a model file is sound and what it describes.
    #[command(after_help = "Example:  assur check arm.toml")]
    Check {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// Prints one JSON document.
        #[arg(long)]
        json: bool,
    },
    /// Finds every assembly mode for given actuator values.
    #[command(after_help = "Example:  assur forward examples/3-rpr.toml --inputs=14.98,15.38,12 --svg modes.svg")]
    Forward {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The actuator values, leg 1 first: lengths, and angles in the model file's unit.
        #[arg(long, value_name = "Q1,Q2,Q3", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        inputs: Vec<f64>,
        #[command(flatten)]
        asked: Asked,
    },
    /// Finds every way to put a triad together.
    #[command(after_help = "Example:  assur triad problem.json --complex")]
    Triad {
        /// Triad problem file, JSON or TOML; - is standard input.
        file: PathBuf,
        #[command(flatten)]
        asked: Asked,
    },
    /// Prints a derivation worked through, or lists them.
    #[command(after_help = "Example:  assur derive --list")]
    Derive {
        /// The derivation.
        #[arg(required_unless_present = "list", conflicts_with = "list")]
        name: Option<String>,
        /// Lists what there is.
        #[arg(long)]
        list: bool,
    },
    /// Prints a completion script for a shell.
    #[command(after_help = "Example:  assur completions bash > ~/.local/share/bash-completion/completions/assur")]
    Completions {
        /// The shell.
        shell: Shell,
    },
}

/// How an answer is to be shown.
#[derive(Args)]
pub(crate) struct Asked {
    /// Prints one JSON document with everything known; angles in radians.
    #[arg(long)]
    pub(crate) json: bool,
    /// Lists the non-real solutions too.
    #[arg(long)]
    pub(crate) complex: bool,
    /// Prints the eliminant too: its zeros e^(i phi) are the orientations.
    #[arg(long)]
    pub(crate) polynomial: bool,
    /// Draws all modes into an SVG file.
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Draws all modes into a PNG file.
    #[arg(long, value_name = "FILE")]
    pub(crate) png: Option<PathBuf>,
}
