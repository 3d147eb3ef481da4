//! The assemblies of a whole linkage.

use nalgebra::{Isometry2, Point2, Vector2};

use super::scene::{Look, Mark, Scene};
use super::sheet::sheet;
use super::trusses::around_their_middle;
use crate::linkage::{Linkage, LinkageAssemblies, LinkageAssembly, LinkageJoint, LinkageJointKind};

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

/// Pins at turning joints; at a sliding one its guide on the one link and a block on the other.
fn marks(linkage: &Linkage, assembly: &LinkageAssembly) -> Vec<Mark> {
    let mut marks = Vec::new();
    let frames: Vec<Isometry2<f64>> =
        assembly.poses.iter().map(|&[x, y, phi]| Isometry2::new(Vector2::new(x, y), phi)).collect();
    let placed = |link: usize, at: Vector2<f64>| (frames[link] * Point2::from(at)).coords;
    for joint in linkage.joints() {
        let look = Look { actuated: joint.driven, violated: false };
        let [first, second] = joint.links.map(|link| placed(link, joint.at));
        match joint.kind {
            LinkageJointKind::Revolute => marks.push(Mark::Pin { at: first, look }),
            LinkageJointKind::Prismatic { direction } => {
                // The guide belongs to the ground where it can, else to the first link.
                let (guide, from, to) =
                    if joint.links[1] == linkage.ground() { (1, second, first) } else { (0, first, second) };
                let along = frames[joint.links[guide]].rotation * direction.normalize();
                let fixed = joint.links[guide] == linkage.ground();
                marks.push(Mark::Rail { from, to, along, fixed });
                marks.push(Mark::Block { at: to, along, look });
            }
        }
    }
    for link in 0..linkage.links() {
        let own = linkage.joints().iter().filter(|joint| joint.links.contains(&link));
        let ground = link == linkage.ground();
        let turning = |joint: &&LinkageJoint| !ground || joint.kind == LinkageJointKind::Revolute;
        let corners: Vec<Vector2<f64>> = own.filter(turning).map(|joint| placed(link, joint.at)).collect();
        if ground {
            marks.extend(corners.iter().map(|&at| Mark::Ground { at }));
            continue;
        }
        match corners[..] {
            [_] | [] => {}
            [from, to] => marks.push(Mark::Bar { from, to }),
            _ => marks.push(Mark::Body { corners: around_their_middle(corners) }),
        }
    }
    marks
}
