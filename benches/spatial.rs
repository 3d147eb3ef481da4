//! The two spatial robots: forward kinematics, rotational capability, tilt.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

use assur::nalgebra::Vector3;
use assur::{CartesianRobot, Hana, HanaMode, Tripod, TripodPose};

fn spatial(criterion: &mut Criterion) {
    let hana = Hana::example();
    let inputs = [1.0, -0.5, 0.3];
    let answer = hana.forward(&inputs).expect("finite");
    let worst = answer.modes.iter().map(|mode| mode.residual).fold(0.0, f64::max);
    eprintln!("HANA: {} of degree {}, worst residual {worst:.0e}", answer.modes.len(), answer.account.degree);
    criterion.bench_function("forward/HANA", |b| b.iter(|| hana.forward(black_box(&inputs))));
    criterion.bench_function("capability/HANA", |b| {
        b.iter(|| hana.capability(black_box([-2.0, -12.0]), HanaMode::ABOVE));
    });

    let reach = hana.reachable_workspace(HanaMode::ABOVE).expect("finite");
    eprintln!("HANA, reachable: area {:.9}, {} pieces", reach.area, reach.components());
    criterion.bench_function("reachable/HANA", |b| b.iter(|| hana.reachable_workspace(black_box(HanaMode::ABOVE))));

    let pose = TripodPose::new(Vector3::new(200.0, 260.0, 240.0), Vector3::new(0.17, 0.34, -0.085));
    let closed = CartesianRobot { d1: 600.0, d2: 720.0 };
    let inputs = closed.inverse(&pose).expect("within a quarter turn");
    let off = (closed.forward(&inputs).expect("T > -1").position - pose.position).norm();
    eprintln!("Cartesian: the place found again to {off:.0e}");
    criterion.bench_function("forward/Cartesian, closed form", |b| b.iter(|| closed.forward(black_box(&inputs))));
    let robots = [
        ("Cartesian", Tripod::cartesian(600.0, 720.0), 4),
        ("inclined rails", Tripod::inclined(0.26, 600.0, 720.0), 8),
    ];
    for (name, robot, expected) in robots {
        let robot = robot.expect("is sound");
        let pose = TripodPose::new(Vector3::new(20.0, -35.0, 50.0), Vector3::new(0.08, 0.17, -0.04));
        let inputs = robot.inverse(&pose).expect("regular");
        let answer = robot.forward(&inputs).expect("finite");
        assert_eq!(answer.modes.len(), expected, "{name}");
        let worst = answer.modes.iter().map(|mode| mode.residual).fold(0.0, f64::max);
        eprintln!("{name}: {expected} modes, worst residual {worst:.0e}");
        criterion.bench_function(&format!("forward/{name}"), |b| b.iter(|| robot.forward(black_box(&inputs))));
        let exact = robot.certify(&inputs).expect("finite");
        assert_eq!(exact.account, answer.account, "{name}");
        criterion.bench_function(&format!("certify/{name}"), |b| b.iter(|| robot.certify(black_box(&inputs))));
    }

    let robot = Tripod::cartesian_example();
    let tip = Vector3::repeat(250.0) + robot.tool;
    let tilt = robot.tilt(&tip).expect("finite").expect("home is inside");
    eprintln!("tilt: {:.9} degrees", tilt.angle.to_degrees());
    criterion.bench_function("tilt", |b| b.iter(|| robot.tilt(black_box(&tip))));
    let along = [Vector3::x() * 8.0, Vector3::y() * 8.0];
    let map = || robot.tilt_map(black_box(&Vector3::new(0.0, 0.0, 160.0)), along, [50, 50], || ());
    eprintln!("tilt map: {} of 2500 places within limits", map().expect("finite").iter().flatten().count());
    criterion.bench_function("tilt map of 50 by 50", |b| b.iter(map));
    criterion.bench_function("tilt, proved to 1e-3", |b| b.iter(|| robot.tilt_bound(black_box(&tip), &tilt, 1e-3)));
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = spatial
}
criterion_main!(benches);
