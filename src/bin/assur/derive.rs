//! The derivations, printed. Each is a program of its own as well; here they are only asked for their text.

use std::fmt::Write;

/// A derivation that can be printed.
struct Derivation {
    name: &'static str,
    /// What it shows, in one line.
    claim: &'static str,
    /// Its text, worked through.
    document: fn() -> String,
}

#[path = "../../../derivations/acceleration_term.rs"]
mod acceleration_term;
#[path = "../../../derivations/cartesian_robot.rs"]
mod cartesian_robot;
#[path = "../../../derivations/charts.rs"]
mod charts;
#[path = "../../../derivations/coupler_intersections.rs"]
mod coupler_intersections;
#[path = "../../../derivations/coupler_sextic.rs"]
mod coupler_sextic;
#[path = "../../../derivations/degree_table.rs"]
mod degree_table;
#[path = "../../../derivations/dixon_pencils.rs"]
mod dixon_pencils;
#[path = "../../../derivations/filter_bound.rs"]
mod filter_bound;
#[path = "../../../derivations/fold_rule.rs"]
mod fold_rule;
#[path = "../../../derivations/hana_forward.rs"]
mod hana_forward;
#[path = "../../../derivations/joint_ranges.rs"]
mod joint_ranges;
#[path = "../../../derivations/leg_reductions.rs"]
mod leg_reductions;
#[path = "../../../derivations/prr_rows.rs"]
mod prr_rows;
#[path = "../../../derivations/ring_reach.rs"]
mod ring_reach;
#[path = "../../../derivations/rp_rp_rp_octic.rs"]
mod rp_rp_rp_octic;
#[path = "../../../derivations/singularity_degrees.rs"]
mod singularity_degrees;
#[path = "../../../derivations/slider_reach.rs"]
mod slider_reach;
#[path = "../../../derivations/triad_sextic.rs"]
mod triad_sextic;
#[path = "../../../derivations/tripod_orientation.rs"]
mod tripod_orientation;
#[path = "../../../derivations/velocity_row.rs"]
mod velocity_row;

/// Every derivation is a program of its own as well; here only its text is used.
const _: [fn(); 20] = [
    acceleration_term::main,
    cartesian_robot::main,
    charts::main,
    coupler_intersections::main,
    coupler_sextic::main,
    degree_table::main,
    dixon_pencils::main,
    filter_bound::main,
    fold_rule::main,
    hana_forward::main,
    joint_ranges::main,
    leg_reductions::main,
    prr_rows::main,
    ring_reach::main,
    rp_rp_rp_octic::main,
    singularity_degrees::main,
    slider_reach::main,
    triad_sextic::main,
    tripod_orientation::main,
    velocity_row::main,
];

/// The derivations, in reading order.
const DERIVATIONS: &[Derivation] = &[
    Derivation {
        name: "charts",
        claim: "the circle of orientations in theta and in the half-angle, and why a half-turn is ordinary",
        document: charts::document,
    },
    Derivation {
        name: "triad_sextic",
        claim: "the sextic of RR-RR-RR: closed form and Sylvester route are the same",
        document: triad_sextic::document,
    },
    Derivation {
        name: "degree_table",
        claim: "how many assemblies each of the twenty triads has",
        document: degree_table::document,
    },
    Derivation {
        name: "rp_rp_rp_octic",
        claim: "the octic of RP-RP-RP is a quartic, and half of that is a mirror image",
        document: rp_rp_rp_octic::document,
    },
    Derivation {
        name: "leg_reductions",
        claim: "the 21 leg types and the dyads they leave when their driver is held",
        document: leg_reductions::document,
    },
    Derivation {
        name: "velocity_row",
        claim: "the velocity row of every leg is the cross product of its idle joints' screws",
        document: velocity_row::document,
    },
    Derivation {
        name: "acceleration_term",
        claim: "the quadratic term of the accelerations, for any leg and for 3-PRR",
        document: acceleration_term::document,
    },
    Derivation {
        name: "prr_rows",
        claim: "the matrices of 3-PRR as printed in 1996 and as corrected",
        document: prr_rows::document,
    },
    Derivation {
        name: "singularity_degrees",
        claim: "degrees of the curves of type 2 at a fixed orientation, for the 18 leg types",
        document: singularity_degrees::document,
    },
    Derivation {
        name: "filter_bound",
        claim: "when floating point may say how many assembly modes there are",
        document: filter_bound::document,
    },
    Derivation {
        name: "coupler_sextic",
        claim: "the curve of a coupler point is a tricircular sextic, and its equation",
        document: coupler_sextic::document,
    },
    Derivation {
        name: "coupler_intersections",
        claim: "two coupler curves meet in 18 points, in fewer where they share foci",
        document: coupler_intersections::document,
    },
    Derivation {
        name: "dixon_pencils",
        claim: "larger groups as generalised eigenproblems; the triad's sextic is the 6x6 case",
        document: dixon_pencils::document,
    },
    Derivation {
        name: "fold_rule",
        claim: "which curves can bound a maximal or inclusive workspace, and on which side",
        document: fold_rule::document,
    },
    Derivation {
        name: "ring_reach",
        claim: "what bounds the workspaces of a leg whose pivots' distance decides: RPR and RRR",
        document: ring_reach::document,
    },
    Derivation {
        name: "slider_reach",
        claim: "what a slider with a link reaches, and 3-PRR's region: stadium, lens, tips",
        document: slider_reach::document,
    },
    Derivation {
        name: "joint_ranges",
        claim: "a joint held at an end of its range leaves a dyad, with one side allowed",
        document: joint_ranges::document,
    },
    Derivation {
        name: "hana_forward",
        claim: "HANA's forward kinematics is a product: two families of four, by square roots",
        document: hana_forward::document,
    },
    Derivation {
        name: "tripod_orientation",
        claim: "the orientation of a three-legged robot has degree 8",
        document: tripod_orientation::document,
    },
    Derivation {
        name: "cartesian_robot",
        claim: "the Cartesian robot's equations as printed and as corrected, and its two singularities",
        document: cartesian_robot::document,
    },
];

/// No derivation of this name.
#[derive(Debug, thiserror::Error)]
#[error("derivation \"{0}\": unknown; assur derive --list names them all")]
pub(crate) struct UnknownDerivation(String);

/// The text of a derivation.
pub(crate) fn document(name: &str) -> Result<String, UnknownDerivation> {
    let found = DERIVATIONS.iter().find(|derivation| derivation.name == name);
    found.map(|derivation| (derivation.document)()).ok_or_else(|| UnknownDerivation(name.to_owned()))
}

/// The names, one a line, with what each shows.
pub(crate) fn list() -> String {
    let mut text = String::new();
    for Derivation { name, claim, .. } in DERIVATIONS {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{name:<20} {claim}");
    }
    text
}
