//! Redraws the workspace figures of two papers and lists the printed computation times against ours.
//!
//! `cargo run --release --example figures [FOLDER]` writes SVG files into FOLDER (`figures` without it): 4, 11-14, 16, 17, 19, 20 and 23 of Merlet,
//! Gosselin, Mouly 1998, and 2-4 of Gosselin, Lemieux, Merlet 1996, whose dimensions are not printed and are chosen to show the same shapes.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use assur::exchange::ModelFile;
use assur::plane::PhiRange;
use assur::plot::{WorkspaceLayer, draw_workspaces};
use assur::workspace::{Region, Workspace, WorkspaceKind, WorkspaceModes};

/// A picture: its file, the model, the workspaces in it, and the printed time of one of them in milliseconds.
struct Figure {
    file: &'static str,
    model: &'static str,
    kinds: Vec<WorkspaceKind>,
    /// With the regions that each leg alone allows.
    legs: bool,
    printed: &'static str,
}

fn figures() -> Vec<Figure> {
    let degrees = |from: f64, to: f64| PhiRange::between(from.to_radians(), to.to_radians());
    let constant = |phi: f64| WorkspaceKind::Constant { phi: phi.to_radians() };
    let inclusive = |to: f64| WorkspaceKind::Inclusive(degrees(0.0, to));
    let total = |from: f64, to: f64| WorkspaceKind::Total(degrees(from, to));
    let with_maximal =
        |phis: &[f64]| std::iter::once(WorkspaceKind::Maximal).chain(phis.iter().map(|phi| constant(*phi))).collect();
    let figure = |file, model, kinds, printed| Figure { file, model, kinds, legs: false, printed };
    vec![
        figure(
            "fig-04",
            "table1-1a",
            with_maximal(&[210.0, 225.0, 240.0, 255.0, 270.0, 285.0]),
            "4-5 each constant one",
        ),
        figure("fig-11-left", "table1-1a", vec![WorkspaceKind::Maximal], "4216"),
        figure("fig-11-right", "table1-2a", vec![WorkspaceKind::Maximal], "5699"),
        figure("fig-12-left", "table1-3a", vec![WorkspaceKind::Maximal], "14016"),
        figure("fig-12-right", "table1-4a", vec![WorkspaceKind::Maximal], "1983"),
        figure("fig-13", "table1-3b", with_maximal(&[180.0, 210.0, 240.0, 270.0, 300.0]), "1500-15000 the maximal one"),
        // Its claim of two assemblies does not hold: the separating arcs do not close a part off.
        figure("fig-14", "table1-1a", vec![WorkspaceKind::Maximal], "4216"),
        figure("fig-16", "table1-1c", [150.0, 180.0, 210.0, 240.0, 300.0].map(inclusive).to_vec(), "1000-2000 each"),
        figure("fig-17", "table1-2c", [10.0, 40.0, 90.0, 180.0, 270.0].map(inclusive).to_vec(), "1000-2000 each"),
        figure("fig-19-left", "table1-1c", vec![total(200.0, 230.0), total(200.0, 215.0)], "100 each"),
        figure("fig-19-right", "table1-2c", vec![total(0.0, 5.0), total(150.0, 190.0)], "100 each"),
        figure("fig-20-left", "table1-3c", vec![total(200.0, 230.0), total(200.0, 215.0)], "100 each"),
        figure("fig-20-right", "table1-4c", vec![total(0.0, 90.0), WorkspaceKind::Dextrous], "100 each"),
        figure("fig-23", "table1-4c", vec![WorkspaceKind::Dextrous], "80"),
        Figure { legs: true, ..figure("prr-fig-2", "prr-symmetric-radial-void", vec![constant(0.0)], "-") },
        Figure { legs: true, ..figure("prr-fig-3", "prr-symmetric-tangential", vec![constant(0.0)], "-") },
        Figure { legs: true, ..figure("prr-fig-4-left", "prr-square", vec![constant(0.0)], "-") },
        Figure { legs: true, ..figure("prr-fig-4-right", "prr-close-directions", vec![constant(0.0)], "-") },
    ]
}

fn name(kind: &WorkspaceKind) -> String {
    let angle = |phi: f64| format!("{:.0}°", phi.to_degrees());
    match kind {
        WorkspaceKind::Constant { phi } => format!("constant, φ = {}", angle(*phi)),
        WorkspaceKind::Inclusive(range) | WorkspaceKind::Total(range) => {
            format!("{}, φ {} … {}", kind.name(), angle(range.from), angle(range.from + range.width))
        }
        other => other.name().to_owned(),
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = std::env::args().nth(1).unwrap_or_else(|| "figures".to_owned()).into();
    std::fs::create_dir_all(&folder)?;
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/workspaces");
    let both = WorkspaceModes::Both;
    println!("{:<14} {:<28} {:>14} {:>10}   printed (ms, SUN 4-60)", "figure", "workspace", "area", "ms here");
    for figure in figures() {
        let robot = ModelFile::read(&models.join(format!("{}.toml", figure.model)))?.manipulator;
        let mut drawn: Vec<Workspace> = Vec::new();
        for kind in &figure.kinds {
            // The best of a few, as the first also warms the machine.
            let mut best = f64::INFINITY;
            let mut found = None;
            for _ in 0..5 {
                let start = Instant::now();
                found = Some(robot.workspace(kind, &both)?);
                best = best.min(start.elapsed().as_secs_f64() * 1e3);
            }
            let workspace = found.ok_or("asked at least once")?;
            println!(
                "{:<14} {:<28} {:>14.6} {best:>10.3}   {}",
                figure.file,
                name(kind),
                workspace.region.area,
                figure.printed
            );
            drawn.push(workspace);
        }
        let layers: Vec<WorkspaceLayer> =
            drawn.iter().map(|workspace| WorkspaceLayer { name: name(&workspace.kind), workspace }).collect();
        let reach = robot.reach(&both)?;
        let legs: Vec<Region> = if figure.legs {
            (0..robot.legs.len())
                .map(|leg| Ok(reach.only(leg).workspace(&figure.kinds[0])?.region))
                .collect::<Result<_, Box<dyn Error>>>()?
        } else {
            Vec::new()
        };
        std::fs::write(folder.join(format!("{}.svg", figure.file)), draw_workspaces(&robot, &layers, &legs))?;
    }
    Ok(())
}
