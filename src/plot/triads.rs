//! The assembly modes of a triad, which knows lines and distances but no joint values.

use nalgebra::{Rotation2, Vector2};

use super::scene::{Look, Mark, Scene, caption, summary};
use super::sheet::sheet;
use crate::linkage::{Assemblies, AssemblyMode, Dyad, Offset, Pose, Triad};

/// Every way to put a triad together as one SVG document, small multiples on one scale.
///
/// ```
/// # #[cfg(feature = "plot")] {
/// use assur::{Dyad, Triad, nalgebra::Vector2, plot::draw_assemblies};
/// let leg = |a, b, length| Dyad::RR { a: Vector2::from(a), b: Vector2::from(b), length };
/// let triad = Triad::new([
///     leg([0.0, 0.0], [0.0, 0.0], 14.98),
///     leg([15.91, 0.0], [17.045, 0.0], 15.38),
///     leg([0.0, 10.0], [13.25, 16.08], 12.0),
/// ]).unwrap();
/// assert!(draw_assemblies(&triad, &triad.assemble()).starts_with("<svg"));
/// # }
/// ```
pub fn draw_assemblies(triad: &Triad, answer: &Assemblies) -> String {
    let mut scenes: Vec<Scene> =
        (1..).zip(&answer.modes).map(|(number, mode)| mode_scene(triad, mode, number)).collect();
    if scenes.is_empty() {
        scenes.push(base_scene(triad));
    }
    let subtitle = summary(&answer.account, answer.modes.len(), answer.status);
    sheet(&format!("Triad {}", triad.name()), &subtitle, &scenes)
}

fn mode_scene(triad: &Triad, mode: &AssemblyMode, number: usize) -> Scene {
    let pose = mode.pose;
    let corners = triad.legs().iter().filter_map(|dyad| Some(pose.place(platform_point(dyad)?))).collect();
    let mut marks = vec![Mark::Body { corners }, Mark::Frame { pose: pose.isometry() }];
    for (leg, dyad) in (1..).zip(triad.legs()) {
        draw_dyad(&mut marks, dyad, &pose, leg);
    }
    Scene { marks, number: Some(number), caption: caption(mode, "", false), pose: Some(pose) }
}

fn platform_point(dyad: &Dyad) -> Option<Vector2<f64>> {
    match dyad {
        Dyad::RR { b, .. } | Dyad::PR { b, .. } | Dyad::RP { b, .. } => Some(*b),
        Dyad::PP { .. } => None,
    }
}

fn draw_dyad(marks: &mut Vec<Mark>, dyad: &Dyad, pose: &Pose, leg: usize) {
    let look = Look::default();
    match dyad {
        Dyad::RR { a, b, .. } => {
            let tip = pose.place(*b);
            marks.extend([
                Mark::Ground { at: *a },
                Mark::Number { at: *a, leg },
                Mark::Bar { from: *a, to: tip },
                Mark::Pin { at: *a, look },
                Mark::Pin { at: tip, look },
            ]);
        }
        Dyad::PR { a, u, b } => {
            let (tip, along) = (pose.place(*b), u.normalize());
            marks.extend([
                Mark::Number { at: *a, leg },
                Mark::Rail { from: *a, to: tip, along, fixed: true },
                Mark::Block { at: tip, along, look },
                Mark::Pin { at: tip, look },
            ]);
        }
        Dyad::RP { a, b, v, offset } => {
            let along = Rotation2::new(pose.phi) * v.normalize();
            let left = Vector2::new(-along.y, along.x);
            let distance = match *offset {
                Offset::Distance(d) => d,
                Offset::TimesDirection(delta) => delta / v.norm(),
            };
            let foot = *a - left * distance;
            marks.extend([
                Mark::Ground { at: *a },
                Mark::Number { at: *a, leg },
                Mark::Rail { from: pose.place(*b), to: foot, along, fixed: false },
                Mark::Bar { from: *a, to: foot },
                Mark::Block { at: foot, along, look },
                Mark::Pin { at: *a, look },
            ]);
        }
        // Two sliders only hold the orientation; there is no point to draw them at.
        Dyad::PP { .. } => {}
    }
}

/// The base alone, where there is no mode to draw.
fn base_scene(triad: &Triad) -> Scene {
    let look = Look::default();
    let base = |(leg, dyad): (usize, &Dyad)| match dyad {
        Dyad::RR { a, .. } | Dyad::RP { a, .. } => {
            vec![Mark::Ground { at: *a }, Mark::Number { at: *a, leg }, Mark::Pin { at: *a, look }]
        }
        Dyad::PR { a, u, .. } => {
            vec![Mark::Number { at: *a, leg }, Mark::Rail { from: *a, to: *a, along: u.normalize(), fixed: true }]
        }
        Dyad::PP { .. } => Vec::new(),
    };
    let marks = (1..).zip(triad.legs()).flat_map(base).collect();
    Scene { marks, number: None, caption: "no assembly mode".to_owned(), pose: None }
}
