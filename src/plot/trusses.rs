//! The assemblies of a group with revolute joints.

use nalgebra::Vector2;

use super::scene::{Look, Mark, Scene};
use super::sheet::sheet;
use crate::linkage::{Status, Truss, TrussAssemblies, TrussAssembly};

/// Every real assembly as one SVG document, small multiples on one scale; the ground keeps its place.
///
/// ```
/// # #[cfg(feature = "plot")] {
/// use assur::{linkage::{Truss, TrussJoint}, nalgebra::Vector2, plot::draw_truss};
/// let joint = |i, j, x, y| TrussJoint::drawn([i, j], Vector2::new(x, y));
/// let elbow = Truss::new(3, &[joint(0, 1, 0.0, 0.0), joint(1, 2, 1.0, 1.0), joint(0, 2, 2.0, 0.0)], 0).unwrap();
/// assert!(draw_truss(&elbow, &elbow.assemble()).starts_with("<svg"));
/// # }
/// ```
pub fn draw_truss(truss: &Truss, answer: &TrussAssemblies) -> String {
    let mut scenes: Vec<Scene> = (1..)
        .zip(answer.real())
        .map(|(number, assembly)| Scene {
            marks: truss_marks(truss, assembly),
            number: Some(number),
            caption: match assembly.multiplicity {
                0 | 1 => String::new(),
                more => format!("{more}-fold"),
            },
            pose: None,
        })
        .collect();
    if scenes.is_empty() {
        scenes.push(Scene { marks: Vec::new(), number: None, caption: "no real assembly".to_owned(), pose: None });
    }
    let title = truss
        .catalogued()
        .map_or_else(|| format!("Group of {} links", truss.links()), |entry| format!("Baranov truss {}", entry.name()));
    let note = match (answer.status, answer.missing) {
        (Status::SelfMotion, _) => ", and a curve of assemblies".to_owned(),
        (_, Some(missing)) if missing > 0 => format!(", {missing} not found"),
        _ => String::new(),
    };
    let subtitle = format!("{} real of {} assemblies{note}", answer.real().count(), answer.count());
    sheet(&title, &subtitle, &scenes)
}

/// The symbols of one real assembly, from back to front: links with two joints as bars, others as bodies.
///
/// **Units and frame**: lengths of the mechanism, in the ground's frame.
pub fn truss_marks(truss: &Truss, assembly: &TrussAssembly) -> Vec<Mark> {
    let mut marks = Vec::new();
    for link in 0..truss.links() {
        let joints = truss.joints_of_link(link, assembly);
        let places: Vec<Vector2<f64>> = joints.iter().map(|(_, at)| *at).collect();
        marks.extend(joints.iter().map(|&(_, at)| Mark::Pin { at, look: Look::default() }));
        if link == truss.ground() {
            marks.extend(places.iter().map(|&at| Mark::Ground { at }));
            continue;
        }
        match places[..] {
            [from, to] => marks.push(Mark::Bar { from, to }),
            _ => marks.push(Mark::Body { corners: around_their_middle(places) }),
        }
    }
    marks.sort_by_key(Mark::layer);
    marks
}

/// Points in the order in which a ray from their middle sweeps over them.
pub(super) fn around_their_middle(mut points: Vec<Vector2<f64>>) -> Vec<Vector2<f64>> {
    let middle = points.iter().sum::<Vector2<f64>>() / points.len().max(1) as f64;
    let angle = |p: &Vector2<f64>| (p.y - middle.y).atan2(p.x - middle.x);
    points.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    points
}
