//! Degrees of the curves on which a manipulator is singular of type 2, at a fixed orientation.

use assur::nalgebra::Vector2;
use assur::{Leg, Manipulator, Placement};

/// Leg types with the degree of the curve for three such legs with nothing special about them.
const DEGREES: [(&str, u32); 18] = [
    ("R_P_R", 2),
    ("_R_PR", 16),
    ("RP_R_", 16),
    ("R_R_R", 2),
    ("_P_RR", 20),
    ("P_R_R", 0),
    ("PR_R_", 6),
    ("_R_RP", 6),
    ("R_R_P", 0),
    ("RR_P_", 20),
    ("_P_PR", 0),
    ("P_P_R", 0),
    ("_P_RP", 1),
    ("PR_P_", 1),
    ("R_P_P", 0),
    ("RP_P_", 0),
    ("_R_RR", 44),
    ("RR_R_", 44),
];

/// The text, with every step checked.
pub fn document() -> String {
    let mut text = String::from(
        "Degrees of the curves of type 2\n\
         ===============================\n\
         Claim. At a fixed orientation det A = 0, all working modes together, is a curve in the position (x, y) of the\n\
         degree below, for three legs of a type with general dimensions. Each is found by exact elimination of the square roots\n\
         (Manipulator::singularity_locus) on one example, so a general one has at least this degree. Degree 0: whether A is singular\n\
         does not depend on the position. 44 for 3-RRR has no factor to spare: modulo 1000003 its restrictions\n\
         to two lines y = const were found, apart from this program, to have no common splitting.\n\n",
    );
    for (kind, degree) in DEGREES {
        let robot = general(kind);
        let locus = robot.singularity_locus(0.375).expect("one actuator a leg");
        assert_eq!(locus.degree(), degree, "3-{kind}");
        let removed: u32 = locus.removed.iter().map(|(_, power)| 2 * power).sum();
        text += &format!("3-{kind:<8} degree {degree:>2}, {:>4} terms", locus.polynomial.term_count());
        text += &if removed > 0 { format!(", after removing factors of degree {removed}\n") } else { "\n".to_owned() };
    }
    text
}

fn general(kind: &str) -> Manipulator {
    let base = [[0.0, 0.0], [8.0, 1.0], [3.0, 7.0]];
    let platform = [[-1.0, -0.5], [1.5, -0.75], [0.25, 2.0]];
    let directions = [[1.0, 2.0], [-3.0, 1.0], [1.0, -4.0]];
    let legs = (0..3).map(|k| Leg {
        base: Placement { at: Vector2::from(base[k]), direction: Vector2::from(directions[k]) },
        links: [
            Placement { at: Vector2::new(2.0 + 0.5 * k as f64, 0.25), direction: Vector2::new(3.0, 1.0 + k as f64) },
            Placement { at: Vector2::new(3.0 - 0.25 * k as f64, 0.5), direction: Vector2::new(1.0, 2.0) },
        ],
        platform: Placement { at: Vector2::from(platform[k]), direction: Vector2::from(directions[(k + 1) % 3]) },
        ..kind.parse().expect("a leg type")
    });
    Manipulator::new("", legs.collect()).expect("is sound")
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
