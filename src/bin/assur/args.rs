//! What can be asked on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use crate::multipteron::MultipteronCommand;
use crate::spatial::{HanaCommand, TripodCommand};
use crate::workspaces::{SweepArgs, WorkspaceArgs};

/// Every assembly mode of planar mechanisms.
#[derive(Parser)]
#[command(version, about, arg_required_else_help = true)]
#[command(after_help = "Start with:  assur new 3-RPR --output arm.toml\n\
    Exit status: 0 answered (also \"none\"), 1 the question could not be asked or answered, 2 wrong usage.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The form of a file of rows.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Rows {
    Csv,
    Jsonl,
    Parquet,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Prints a commented model to start from.
    #[command(
        after_help = "Families: 3-RPR, 3-RRR, 3-PRR, 3-RRP, 3-PRP, 3-PPR, 3-RPP; with the actuated joint marked, \
        3-_R_RR; three different legs, R_P_R,_P_RR,_R_RR; \
        the spatial robots hana, tripod, tripod-5dof, tripod-4dof, tripod-inclined, tripod-upright, tripteron, quadrupteron, hexapteron.\nExample:  assur new 3-RPR --output arm.toml"
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
    #[command(
        after_help = "Rows at once: --batch takes a file with the columns q1,q2,q3 (CSV, or JSON lines) and writes a row of modes for each; bad rows go to \
        OUT.rejects.csv. A run that was stopped goes on where it was, by the same command.\n\
        Example:  assur forward examples/3-rpr.toml --inputs=14.98,15.38,12 --svg modes.svg\n          \
        assur forward examples/3-rpr.toml --batch inputs.csv --output modes.parquet"
    )]
    Forward {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The actuator values, leg 1 first: lengths, and angles in the model file's unit.
        #[arg(
            long,
            value_name = "Q1,Q2,Q3",
            value_delimiter = ',',
            required_unless_present = "batch",
            conflicts_with = "batch",
            allow_hyphen_values = true
        )]
        inputs: Vec<f64>,
        /// Rows of actuator values, .csv or .jsonl; - is standard input, CSV.
        #[arg(long, value_name = "IN", requires = "output", conflicts_with_all = ["certify", "polynomial", "complex", "svg", "png"])]
        batch: Option<PathBuf>,
        /// Where the rows of modes go, .csv, .jsonl or .parquet; - is standard output.
        #[arg(long, short, value_name = "OUT", requires = "batch")]
        output: Option<PathBuf>,
        /// The form of the output where its name does not tell.
        #[arg(long, value_enum, requires = "batch")]
        format: Option<Rows>,
        #[command(flatten)]
        asked: Asked,
    },
    /// Finds every working mode for a pose: all joints of each leg, limits that it violates.
    #[command(
        after_help = "A mode is named by one sign a leg: + is the larger value of the prismatic joint in which its two ways differ \
        (RPR: joint 2, PRR: joint 1, RRP: joint 3); for RRR, link 1 x link 2 > 0.\n\
        Example:  assur inverse examples/3-rrr.toml --pose=5.5,4,17"
    )]
    Inverse {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The platform's pose; the angle in the model file's unit.
        #[arg(long, value_name = "X,Y,PHI", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
        /// Prints one JSON document; angles in radians.
        #[arg(long)]
        json: bool,
    },
    /// Tells rates, accelerations, forces and the kind of singularity in a pose.
    #[command(
        after_help = "Rates and accelerations are answered both ways, as the platform's (x', y', phi') and as the actuators'; \
        they are per unit of time, angles in radians.\n\
        Example:  assur velocity examples/3-rrr.toml --pose=5.5,4,17 --mode=+++ --rates=1,0,0 --wrench=0,-10,0"
    )]
    Velocity {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The platform's pose; the angle in the model file's unit.
        #[arg(long, value_name = "X,Y,PHI", value_delimiter = ',', required = true, allow_hyphen_values = true)]
        pose: Vec<f64>,
        /// The working mode, one sign a leg.
        #[arg(long, value_name = "SIGNS", allow_hyphen_values = true)]
        mode: Option<String>,
        /// Rates of the platform or the actuators.
        #[arg(long, value_name = "A,B,C", value_delimiter = ',', allow_hyphen_values = true)]
        rates: Vec<f64>,
        /// Accelerations at these rates.
        #[arg(long, value_name = "A,B,C", value_delimiter = ',', allow_hyphen_values = true)]
        accelerations: Vec<f64>,
        /// An external force and moment on the platform, about its origin.
        #[arg(long, value_name = "FX,FY,M", value_delimiter = ',', allow_hyphen_values = true)]
        wrench: Vec<f64>,
        /// The length that weighs turning against moving; the platform's size where it is not given.
        #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
        length: Option<f64>,
        /// Prints one JSON document; angles in radians.
        #[arg(long)]
        json: bool,
    },
    /// Finds where the manipulator is singular for an orientation, and maps how well it is held.
    #[command(
        after_help = "Example:  assur singularities examples/3-rrr.toml --phi=17 --svg loci.svg --map dexterity --csv map.csv"
    )]
    Singularities {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// The orientation, in the model file's unit.
        #[arg(long, value_name = "PHI", allow_hyphen_values = true)]
        phi: f64,
        /// One working mode; all without it. A map is of this mode, or of the first.
        #[arg(long, value_name = "SIGNS", allow_hyphen_values = true)]
        mode: Option<String>,
        /// A quantity over the plane: dexterity, accuracy or stiffness.
        #[arg(long, value_enum)]
        map: Option<Quantity>,
        /// Writes the map into a CSV file.
        #[arg(long, value_name = "FILE", requires = "map")]
        csv: Option<PathBuf>,
        /// Leaves out the exact curve of all modes, which takes seconds where its degree is high.
        #[arg(long)]
        no_polynomial: bool,
        #[command(flatten)]
        shown: Shown,
    },
    /// Follows one assembly mode through rows of actuator values.
    #[command(
        after_help = "Example:  assur path examples/3-rpr.toml --through path.csv --output followed.csv --svg path.svg"
    )]
    Path {
        /// Model file, TOML or JSON; - is standard input.
        model: PathBuf,
        /// Rows of actuator values: CSV with the header q1,q2,q3, or JSON lines (.jsonl).
        #[arg(long, value_name = "FILE")]
        through: PathBuf,
        /// The mode at the first row, by its pose; the first mode without it.
        #[arg(long, value_name = "X,Y,PHI", value_delimiter = ',', allow_hyphen_values = true)]
        from: Vec<f64>,
        /// Writes the rows into a file: CSV, or JSON lines (.jsonl); angles in radians.
        #[arg(long, short, value_name = "FILE")]
        output: Option<PathBuf>,
        #[command(flatten)]
        shown: Shown,
    },
    /// Opens a page in the browser in which mechanisms are dragged: every assembly mode, at once.
    #[command(
        after_help = "The page is served to this machine only, at the address printed; it needs no network. An address printed before, in place of MODEL, \
        takes up an explorer that was stopped: pages still open go on, and a link to a view opens that view.\nExample:  assur explore examples/3-rpr.toml --inputs=14.98,15.38,12"
    )]
    Explore {
        /// Model, coupler or group file; without it a 3-RPR.
        model: Option<String>,
        /// The actuator values to begin with, leg by leg: lengths, and angles in the model file's unit.
        #[arg(long, value_name = "Q1,Q2,Q3", value_delimiter = ',', allow_hyphen_values = true)]
        inputs: Vec<f64>,
        /// The port; any free one without it.
        #[arg(long)]
        port: Option<u16>,
        /// Only prints the address.
        #[arg(long)]
        no_open: bool,
    },
    /// Describes a coupler curve and finds where it meets a line, a circle or another.
    #[command(after_help = "Example:  assur coupler examples/coupler.json --svg curve.svg")]
    Coupler {
        /// Coupler problem file, JSON or TOML; - is standard input.
        file: PathBuf,
        /// Lists the non-real intersections too.
        #[arg(long)]
        complex: bool,
        #[command(flatten)]
        shown: Shown,
    },
    /// Finds every way to put an Assur group of revolute joints together, or a linkage of such groups.
    #[command(
        after_help = "A group has up to eleven links. A linkage is taken apart into its groups with the drivers held.\n\
        Examples:  assur group examples/seven-link.json --svg assemblies.svg\n           assur group examples/chain.json --inputs=0.1"
    )]
    Group {
        /// Group or linkage file, JSON or TOML; - is standard input.
        file: PathBuf,
        /// For a linkage: the angle of each driven joint from the reference assembly, in radians, in file order.
        #[arg(long, value_name = "Q1,Q2,...", value_delimiter = ',', allow_hyphen_values = true)]
        inputs: Vec<f64>,
        /// Lists the non-real solutions too.
        #[arg(long)]
        complex: bool,
        #[command(flatten)]
        shown: Shown,
    },
    /// Finds every way to put a triad together.
    #[command(after_help = "Example:  assur triad problem.json --complex")]
    Triad {
        /// Triad problem file, JSON or TOML; - is standard input.
        file: PathBuf,
        #[command(flatten)]
        asked: Asked,
    },
    /// Finds where the reference point can be: exactly, as loops of arcs, segments and coupler curves.
    #[command(after_help = "Legs RPR, RRR and PRR, in any mixture; every joint's range counts.\n\
        Examples:  assur workspace examples/workspaces/table1-1a.toml maximal --svg reach.svg --dxf reach.dxf\n           \
        assur workspace examples/workspaces/table1-2c.toml inclusive --from=0 --to=90 --overlay dextrous --overlay constant:30 --png reach.png\n           \
        assur workspace examples/workspaces/table1-4a.toml maximal --optimise leg1.platform.at.x=-3:3")]
    Workspace(WorkspaceArgs),
    /// Measures workspaces over a grid of designs.
    #[command(after_help = "Designs that cannot be asked are rows with a reason.\n\
        Example:  assur sweep examples/workspaces/table1-1a.toml --vary leg1.platform.at.x=20:30:100 --report area:maximal,area:constant:240 --output areas.csv")]
    Sweep(SweepArgs),
    /// Holds a report's poses, ours or another program's, against what can be proved.
    #[command(
        after_help = "REPORT: JSON or TOML with \"inputs\" and \"modes\" (each with a \"pose\") or \"poses\", a list of [x, y, phi]; radians.\n\
        Example:  assur verify report.json --model examples/3-rpr.toml"
    )]
    Verify {
        /// The report; - is standard input.
        report: PathBuf,
        /// The model file or triad file the report is about.
        #[arg(long, value_name = "MODEL")]
        model: PathBuf,
        /// How far a claimed pose may be from the truth: radians, and displacements over the mechanism's size.
        #[arg(long, default_value_t = 1e-6, value_name = "T")]
        tolerance: f64,
        /// Prints one JSON document.
        #[arg(long)]
        json: bool,
    },
    /// HANA: a spatial robot of three degrees of freedom.
    Hana {
        #[command(subcommand)]
        command: HanaCommand,
    },
    /// Three-legged robots of six degrees of freedom.
    Tripod {
        #[command(subcommand)]
        command: TripodCommand,
    },
    /// Tripteron, Quadrupteron and Hexapteron as models; the Pentapteron is not covered.
    Multipteron {
        #[command(subcommand)]
        command: MultipteronCommand,
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
    /// Proves the answer: a box around every mode, a theorem about the whole.
    #[arg(long)]
    pub(crate) certify: bool,
    /// Draws all modes into an SVG file.
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Draws all modes into a PNG file.
    #[arg(long, value_name = "FILE")]
    pub(crate) png: Option<PathBuf>,
}

/// How an answer with a picture is to be shown.
#[derive(Args)]
pub(crate) struct Shown {
    /// Prints one JSON document; angles in radians.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draws into an SVG file.
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Draws into a PNG file.
    #[arg(long, value_name = "FILE")]
    pub(crate) png: Option<PathBuf>,
}

/// What a map shows.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Quantity {
    /// Smallest over largest singular value of the map from inputs to pose.
    Dexterity,
    /// Largest displacement of the reference point for inputs off by one unit.
    Accuracy,
    /// Smallest stiffness for actuators of stiffness one.
    Stiffness,
}
