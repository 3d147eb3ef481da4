//! Symbols as the page takes them: what they are, the points they reach, how they look.

use assur::plot::{Look, Mark};
use serde_json::{Value, json};

pub(crate) fn marks(marks: &[Mark]) -> Value {
    marks.iter().map(mark).collect()
}

fn mark(mark: &Mark) -> Value {
    let look = |Look { actuated, violated }: Look| json!({ "actuated": actuated, "violated": violated });
    match *mark {
        Mark::Body { ref corners } => {
            let corners: Vec<[f64; 2]> = corners.iter().map(|&corner| corner.into()).collect();
            json!({ "mark": "body", "at": corners })
        }
        Mark::Rail { from, to, along, fixed } => {
            json!({ "mark": "rail", "at": [[from.x, from.y], [to.x, to.y]], "along": [along.x, along.y], "fixed": fixed })
        }
        Mark::Ground { at } => json!({ "mark": "ground", "at": [[at.x, at.y]] }),
        Mark::Number { at, leg } => json!({ "mark": "number", "at": [[at.x, at.y]], "leg": leg }),
        Mark::Bar { from, to } => json!({ "mark": "bar", "at": [[from.x, from.y], [to.x, to.y]] }),
        Mark::Telescope { from, to, look: joint } => {
            json!({ "mark": "telescope", "at": [[from.x, from.y], [to.x, to.y]], "look": look(joint) })
        }
        Mark::Block { at, along, look: joint } => {
            json!({ "mark": "block", "at": [[at.x, at.y]], "along": [along.x, along.y], "look": look(joint) })
        }
        Mark::Pin { at, look: joint } => json!({ "mark": "pin", "at": [[at.x, at.y]], "look": look(joint) }),
        Mark::Frame { pose } => {
            let (at, along) = (pose.translation.vector, pose.rotation);
            json!({ "mark": "frame", "at": [[at.x, at.y]], "along": [along.re, along.im] })
        }
    }
}
