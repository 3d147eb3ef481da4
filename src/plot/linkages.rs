//! The assemblies of a whole linkage.

use nalgebra::{Isometry2, Point2, Vector2};

use super::scene::{Look, Mark, Scene};
use super::sheet::sheet;
use super::trusses::around_their_middle;
use crate::linkage::{Linkage, LinkageAssemblies, LinkageAssembly};

/// Panels of one sheet; more would not be looked at.
const MOST_PANELS: usize = 60;

/// Every assembly as one SVG document, small multiples on one scale, at most sixty of them; driven joints are filled.
pub fn draw_linkage(linkage: &Linkage, answer: &LinkageAssemblies) -> String {
    let shown = answer.assemblies.iter().take(MOST_PANELS);
    let mut scenes: Vec<Scene> = (1..)
        .zip(shown)
        .map(|(number, assembly)| {
            let choice = assembly.choice.iter().map(ToString::to_string).collect::<Vec<_>>().join(" · ");
            Scene { marks: marks(linkage, assembly), number: Some(number), caption: choice, pose: None }
        })
        .collect();
    if scenes.is_empty() {
        scenes.push(Scene { marks: Vec::new(), number: None, caption: "no real assembly".to_owned(), pose: None });
    }
    let groups = answer.groups.iter().map(|group| group.name.as_str()).collect::<Vec<_>>().join(", ");
    let more =
        if answer.assemblies.len() > MOST_PANELS { format!(", {MOST_PANELS} of them shown") } else { String::new() };
    sheet("Linkage", &format!("{groups}  ·  {} assemblies{more}", answer.assemblies.len()), &scenes)
}

fn marks(linkage: &Linkage, assembly: &LinkageAssembly) -> Vec<Mark> {
    let mut marks = Vec::new();
    for (link, &[x, y, phi]) in assembly.poses.iter().enumerate() {
        let frame = Isometry2::new(Vector2::new(x, y), phi);
        let own = linkage.joints().iter().filter(|joint| joint.links.contains(&link));
        let places: Vec<(Vector2<f64>, bool)> =
            own.map(|joint| ((frame * Point2::from(joint.at)).coords, joint.driven)).collect();
        let look = |actuated| Look { actuated, violated: false };
        marks.extend(places.iter().map(|&(at, driven)| Mark::Pin { at, look: look(driven) }));
        let corners: Vec<Vector2<f64>> = places.iter().map(|(at, _)| *at).collect();
        if link == linkage.ground() {
            marks.extend(corners.iter().map(|&at| Mark::Ground { at }));
            continue;
        }
        match corners[..] {
            [from, to] => marks.push(Mark::Bar { from, to }),
            _ => marks.push(Mark::Body { corners: around_their_middle(corners) }),
        }
    }
    marks
}
