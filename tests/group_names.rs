//! The printed name `RP-RRP` and the three groups it may mean, each solved.

use assur::nalgebra::Vector2;
use assur::{Dyad, DyadKind, GroupName, Offset, Pose, Status, Triad};

/// The pose that every leg below closes in.
const PLANTED: Pose = Pose { x: 1.5, y: -0.75, phi: 0.625 };

/// A dyad of this kind that closes in the planted pose; different for each `number`.
fn planted(kind: DyadKind, number: f64) -> Dyad {
    let a = Vector2::new(4.0 * (2.0 * number).cos(), 4.0 * (2.0 * number).sin());
    let b = Vector2::new(2.0 * (2.1 * number).cos(), 1.5 * (1.9 * number).sin());
    let joint = PLANTED.place(b);
    match kind {
        DyadKind::RR => Dyad::RR { a, b, length: (joint - a).norm() },
        DyadKind::PR => Dyad::PR { a, u: joint - a, b },
        DyadKind::RP => {
            let v = Vector2::new((1.3 * number).cos(), (1.3 * number).sin());
            let normal = PLANTED.isometry().rotation * Vector2::new(-v.y, v.x);
            Dyad::RP { a, b, v, offset: Offset::TimesDirection(normal.dot(&(a - joint))) }
        }
        DyadKind::PP => Dyad::PP { phi: PLANTED.phi },
    }
}

fn planted_triad(kinds: [DyadKind; 3]) -> Triad {
    let legs = [1.0, 2.0, 3.0].map(|number| planted(kinds[number as usize - 1], number));
    Triad::new(legs).expect("finite numbers")
}

#[test]
fn every_reading_of_the_printed_name_is_solved() {
    let read = GroupName::parse("RP-RRP").expect("accepted with a note");
    assert_eq!(read.dyads, [DyadKind::RP; 3]);
    assert!(read.note.is_some_and(|note| note.contains("RP-RP-RP")));
    assert_eq!(read.other_readings.len(), 2);
    let readings = read.other_readings.iter().copied().chain([read.dyads]);
    let mut degrees = Vec::new();
    for kinds in readings {
        let triad = planted_triad(kinds);
        let answer = triad.assemble();
        assert_eq!(answer.status, Status::Complete);
        assert_eq!(answer.account.real + answer.account.complex, triad.degree(), "{}", triad.name());
        let off = |pose: &Pose| (pose.x - PLANTED.x).hypot(pose.y - PLANTED.y) + (pose.phi - PLANTED.phi).abs();
        assert!(answer.modes.iter().any(|mode| off(&mode.pose) < 1e-9), "{}: planted pose missed", triad.name());
        degrees.push(triad.degree());
    }
    degrees.sort_unstable();
    assert_eq!(degrees, [2, 4, 6]);
}
