//! The workspaces of table 1 of Merlet, Gosselin, Mouly 1998, and membership of a point; areas beside the times.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};

use assur::exchange::ModelFile;
use assur::plane::PhiRange;
use assur::workspace::{WorkspaceKind, WorkspaceModes};

/// A model, a kind, and what the paper says its machine took, in milliseconds.
fn cases() -> Vec<(&'static str, WorkspaceKind, &'static str)> {
    let degrees = |from: f64, to: f64| PhiRange::between(from.to_radians(), to.to_radians());
    vec![
        ("table1-1a", WorkspaceKind::Constant { phi: 240f64.to_radians() }, "4-5"),
        ("table1-1a", WorkspaceKind::Maximal, "4216"),
        ("table1-2a", WorkspaceKind::Maximal, "5699"),
        ("table1-3a", WorkspaceKind::Maximal, "14016"),
        ("table1-4a", WorkspaceKind::Maximal, "1983"),
        ("table1-3b", WorkspaceKind::Maximal, "1500-15000"),
        ("table1-1c", WorkspaceKind::Inclusive(degrees(0.0, 180.0)), "1000-2000"),
        ("table1-2c", WorkspaceKind::Inclusive(degrees(0.0, 90.0)), "1000-2000"),
        ("table1-2c", WorkspaceKind::Total(degrees(0.0, 5.0)), "100"),
        ("table1-3c", WorkspaceKind::Total(degrees(200.0, 230.0)), "100"),
        ("table1-4c", WorkspaceKind::Dextrous, "80"),
    ]
}

fn workspaces(criterion: &mut Criterion) {
    let model = |name: &str| {
        let path = format!("{}/examples/workspaces/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        ModelFile::read(path.as_ref()).expect("an example").manipulator
    };
    for (name, kind, printed) in cases() {
        let robot = model(name);
        let region = robot.workspace(&kind, &WorkspaceModes::Both).expect("is covered").region;
        assert!(region.unclosed.is_empty(), "{name} {}", kind.name());
        let arcs: usize = region.loops.iter().map(|one| one.arcs.len()).sum();
        eprintln!(
            "{name} {}: area {:.9}, {} pieces, {} holes, {arcs} arcs (the paper's machine: {printed} ms)",
            kind.name(),
            region.area,
            region.components,
            region.holes
        );
        criterion.bench_function(&format!("workspace/{name} {}", kind.name()), |b| {
            b.iter(|| robot.workspace(black_box(&kind), &WorkspaceModes::Both));
        });
    }
    let reach = model("table1-1a").reach(&WorkspaceModes::Both).expect("is covered");
    for kind in [WorkspaceKind::Constant { phi: 4.0 }, WorkspaceKind::Maximal, WorkspaceKind::Dextrous] {
        // Inside the maximal workspace, near its middle.
        let at = [7.0, 20.0].into();
        eprintln!("membership {}: {:?}", kind.name(), reach.membership(&kind, at));
        criterion.bench_function(&format!("membership/{}", kind.name()), |b| {
            b.iter(|| reach.membership(black_box(&kind), black_box(at)));
        });
        criterion.bench_function(&format!("contains/{}", kind.name()), |b| {
            b.iter(|| reach.contains(black_box(&kind), black_box(at)));
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = workspaces
}
criterion_main!(benches);
