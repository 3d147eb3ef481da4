//! What is drawn, in length units of the mechanism.

use nalgebra::{Isometry2, Vector2};

use crate::linkage::{AssemblyMode, Pose, Status};
use crate::manipulator::Manipulator;
use crate::solve::Account;

/// How a joint looks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Look {
    /// Driven.
    pub actuated: bool,
    /// Outside its limits.
    pub violated: bool,
}

/// One symbol. Listed from the back of the picture to its front.
#[derive(Clone, Debug)]
pub enum Mark {
    /// The platform.
    Body {
        /// Its corners.
        corners: Vec<Vector2<f64>>,
    },
    /// A guide of a slider, fixed to the ground (hatched) or to the platform.
    Rail {
        /// Where the slider would be at zero.
        from: Vector2<f64>,
        /// Where the slider is.
        to: Vector2<f64>,
        /// Its direction, of length one.
        along: Vector2<f64>,
        /// Whether it is fixed to the ground.
        fixed: bool,
    },
    /// The ground under a pivot.
    Ground {
        /// The pivot.
        at: Vector2<f64>,
    },
    /// The number of a leg, at its base.
    Number {
        /// The base point.
        at: Vector2<f64>,
        /// From 1.
        leg: usize,
    },
    /// A rigid link.
    Bar {
        /// One end.
        from: Vector2<f64>,
        /// The other.
        to: Vector2<f64>,
    },
    /// A slider between two links.
    Telescope {
        /// One end.
        from: Vector2<f64>,
        /// The other.
        to: Vector2<f64>,
        /// How it looks.
        look: Look,
    },
    /// A slider on its guide.
    Block {
        /// Its place.
        at: Vector2<f64>,
        /// The direction of its guide, of length one.
        along: Vector2<f64>,
        /// How it looks.
        look: Look,
    },
    /// A revolute joint.
    Pin {
        /// Its place.
        at: Vector2<f64>,
        /// How it looks.
        look: Look,
    },
    /// The platform's frame.
    Frame {
        /// The motion from the base frame to it.
        pose: Isometry2<f64>,
    },
}

impl Mark {
    /// Its place from back to front.
    pub(super) fn layer(&self) -> u8 {
        match self {
            Self::Body { .. } => 0,
            Self::Rail { .. } => 1,
            Self::Ground { .. } => 2,
            Self::Bar { .. } => 3,
            Self::Telescope { .. } => 4,
            Self::Block { .. } => 5,
            Self::Pin { .. } => 6,
            Self::Frame { .. } => 7,
            // On top of everything, or links would hide it.
            Self::Number { .. } => 8,
        }
    }

    /// The points it reaches.
    pub(super) fn points(&self) -> Vec<Vector2<f64>> {
        match self {
            Self::Body { corners } => corners.clone(),
            Self::Rail { from, to, .. } | Self::Bar { from, to } | Self::Telescope { from, to, .. } => vec![*from, *to],
            Self::Ground { at } | Self::Number { at, .. } | Self::Block { at, .. } | Self::Pin { at, .. } => vec![*at],
            Self::Frame { pose } => vec![pose.translation.vector],
        }
    }
}

/// One mode: its symbols and what stands under them.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    pub(super) marks: Vec<Mark>,
    /// The number of the mode; `None` for a picture of the base alone.
    pub(super) number: Option<usize>,
    pub(super) caption: String,
    /// Where the platform is, to be said if it lies outside the picture.
    pub(super) pose: Option<Pose>,
}

/// The caption of a mode: orientation, working-mode signs, what is special.
pub(super) fn caption(mode: &AssemblyMode, signs: &str, violated: bool) -> String {
    // A minus sign of its own, so that signs and numbers look alike.
    let mut parts = vec![format!("φ = {}°", number(mode.pose.phi.to_degrees()))];
    if !signs.is_empty() {
        parts.push(signs.replace('-', "−"));
    }
    match mode.multiplicity {
        0 | 1 => {}
        2 => parts.push("double".to_owned()),
        3 => parts.push("triple".to_owned()),
        more => parts.push(format!("{more}-fold")),
    }
    if violated {
        parts.push("outside limits".to_owned());
    }
    parts.join("   ")
}

/// The title of a picture, and what its second line begins with: the family, unless that is the title already.
pub(super) fn heading(robot: &Manipulator) -> (String, String) {
    let family = robot.family();
    if robot.name.is_empty() { (family, String::new()) } else { (robot.name.clone(), format!("{family}  ·  ")) }
}

/// How many modes there are, of how many there could be.
pub(super) fn summary(account: &Account, modes: usize, status: Status) -> String {
    let count = match modes {
        0 => "no assembly mode".to_owned(),
        1 => "1 assembly mode".to_owned(),
        more => format!("{more} assembly modes"),
    };
    let status = match status {
        Status::Complete => "",
        Status::SelfMotion => ", and a curve of poses",
        Status::Undecided => ", not all decided",
    };
    format!("{count} (degree {}){status}", account.degree)
}

/// A length to read: as a [`number`], or with an exponent where that would be all zeros.
pub(super) fn length(value: f64) -> String {
    let size = value.abs();
    if size > 0.0 && !(1e-4..1e6).contains(&size) {
        return format!("{value:.3e}").replace(".000", "").replace('-', "−");
    }
    number(value)
}

/// A number to read, not to compute with: five significant digits.
pub(super) fn number(value: f64) -> String {
    let digits = if value == 0.0 { 0 } else { 4 - value.abs().log10().floor().clamp(-20.0, 4.0) as i32 };
    let text = format!("{value:.*}", usize::try_from(digits.min(6)).unwrap_or(0));
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    (if text == "-0" { "0" } else { text }).replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::{length, number};

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(-14.980_001), "−14.98");
        assert_eq!(number(123_456.7), "123457");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(-1e-12), "0");
        assert_eq!(number(0.884_123_4), "0.88412");
        assert_eq!(length(2e-9), "2e−9");
        assert_eq!(length(-14.98), "−14.98");
    }
}
