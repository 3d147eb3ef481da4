//! Model files written: TOML with comments to start from, and JSON.

use std::fmt::Write;

use nalgebra::Vector2;
use serde_json::{Map, Value, json};

use super::model::{ModelFile, SCHEMA};
use crate::manipulator::{JointKind, Leg, Placement};

/// Decimals an angle is tried with before all its digits are written.
const SHORT_DECIMALS: i32 = 9;
/// The key of the ranges of actuated joints, and of the others.
const RANGES: [(&str, bool); 2] = [("limits", true), ("passive_limits", false)];

impl ModelFile {
    /// The model as a TOML file with the explanations a reader needs to change it.
    ///
    /// ```
    /// use assur::{Manipulator, exchange::{AngleUnit, ModelFile}};
    /// let (manipulator, _) = Manipulator::of_family("3-PRR").unwrap();
    /// let model = ModelFile { manipulator, angle_unit: AngleUnit::Deg };
    /// assert_eq!(ModelFile::parse(&model.to_toml(), "prr.toml").unwrap(), model);
    /// ```
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        // Writing to a String cannot fail.
        let _ = self.write_toml(&mut text);
        text
    }

    fn write_toml(&self, out: &mut String) -> std::fmt::Result {
        let unit = self.angle_unit;
        writeln!(out, "schema = \"{SCHEMA}\"")?;
        writeln!(out, "name = {}", toml::Value::String(self.manipulator.name.clone()))?;
        writeln!(out, "angle_unit = \"{}\"            # of every angle here and on the command line", unit.name())?;
        let reference = self.manipulator.reference;
        writeln!(out, "reference = {}          # point C of the platform, for workspaces", numbers(&reference))?;
        for (number, leg) in (1..).zip(&self.manipulator.legs) {
            writeln!(out, "\n[[leg]]                       # leg {number}")?;
            let note = if number == 1 {
                "         # base to platform; an actuated joint stands between underscores"
            } else {
                ""
            };
            writeln!(out, "joints = \"{}\"{note}", leg.name())?;
            let note = if number == 1 { "   # frame of joint 1, in the base" } else { "" };
            writeln!(out, "base = {}{note}", self.placement(&leg.base))?;
            if leg.links.iter().any(|link| *link != Placement::default()) {
                let note = if number == 1 {
                    "   # joint 2 after joint 1, joint 3 after joint 2: a length, or a frame"
                } else {
                    ""
                };
                let links = leg.links.each_ref().map(|link| self.link(link));
                writeln!(out, "links = [{}]{note}", links.join(", "))?;
            }
            let note = if number == 1 { "   # frame after joint 3, in the platform" } else { "" };
            writeln!(out, "platform = {}{note}", self.placement(&leg.platform))?;
            for (name, actuated) in RANGES {
                let range = |(joint, range)| format!("{joint} = {}", numbers(&Vector2::from(range)));
                let ranges: Vec<String> = self.ranges(leg, actuated).into_iter().map(range).collect();
                if !ranges.is_empty() {
                    writeln!(out, "{name} = {{ {} }}", ranges.join(", "))?;
                }
            }
        }
        Ok(())
    }

    fn placement(&self, placement: &Placement) -> String {
        let at = numbers(&placement.at);
        match self.turn(placement) {
            Turn::None => format!("{{ at = {at} }}"),
            Turn::Angle(angle) => format!("{{ at = {at}, angle = {angle:?} }}"),
            Turn::Direction => format!("{{ at = {at}, direction = {} }}", numbers(&placement.direction)),
        }
    }

    fn link(&self, link: &Placement) -> String {
        match self.turn(link) {
            Turn::None if link.at.y == 0.0 => format!("{:?}", link.at.x),
            _ => self.placement(link),
        }
    }

    /// The ranges of the actuated joints, or of the others, by joint number.
    fn ranges(&self, leg: &Leg, actuated: bool) -> Vec<(usize, [f64; 2])> {
        let joints = (0..3).filter(|&joint| leg.actuated[joint] == actuated);
        let range = |joint: usize| {
            let range = leg.limits[joint]?.map(|value| self.short_joint(leg.joints[joint], value));
            Some((joint + 1, range))
        };
        joints.filter_map(range).collect()
    }

    /// A joint value in the file's unit, in the fewest digits that read back as the same number.
    fn short_joint(&self, kind: JointKind, value: f64) -> f64 {
        let full = self.angle_unit.joint_from_rad(kind, value);
        let short = shortened(full);
        if self.angle_unit.joint_to_rad(kind, short) == value { short } else { full }
    }

    /// How to say where the x axis points so that it reads back exactly.
    fn turn(&self, placement: &Placement) -> Turn {
        if placement.direction == Vector2::x() {
            return Turn::None;
        }
        let full = self.angle_unit.from_rad(placement.direction.y.atan2(placement.direction.x));
        let reads_back = |angle: &f64| self.angle_unit.placement(placement.at, *angle).direction == placement.direction;
        [shortened(full), full].into_iter().find(reads_back).map_or(Turn::Direction, Turn::Angle)
    }

    /// The model as a JSON document, with the same keys as the TOML file.
    ///
    /// ```
    /// use assur::{Manipulator, exchange::{AngleUnit, ModelFile}};
    /// let (manipulator, _) = Manipulator::of_family("R_P_R,_P_RR,_R_RP").unwrap();
    /// let model = ModelFile { manipulator, angle_unit: AngleUnit::Rad };
    /// assert_eq!(ModelFile::parse(&model.to_json(), "mixed.json").unwrap(), model);
    /// ```
    pub fn to_json(&self) -> String {
        let placement = |placement: &Placement| {
            let at = array(&placement.at);
            match self.turn(placement) {
                Turn::None => json!({ "at": at }),
                Turn::Angle(angle) => json!({ "at": at, "angle": angle }),
                Turn::Direction => json!({ "at": at, "direction": array(&placement.direction) }),
            }
        };
        let leg = |leg: &Leg| {
            let mut entries = Map::new();
            entries.insert("joints".to_owned(), json!(leg.name()));
            entries.insert("base".to_owned(), placement(&leg.base));
            entries.insert("links".to_owned(), json!(leg.links.each_ref().map(placement)));
            entries.insert("platform".to_owned(), placement(&leg.platform));
            for (name, actuated) in RANGES {
                let ranges = self.ranges(leg, actuated).into_iter();
                let ranges: Map<String, Value> =
                    ranges.map(|(joint, range)| (joint.to_string(), json!(range))).collect();
                if !ranges.is_empty() {
                    entries.insert(name.to_owned(), Value::Object(ranges));
                }
            }
            Value::Object(entries)
        };
        let document = json!({
            "schema": SCHEMA,
            "name": self.manipulator.name,
            "angle_unit": self.angle_unit.name(),
            "reference": array(&self.manipulator.reference),
            "leg": self.manipulator.legs.iter().map(leg).collect::<Vec<_>>(),
        });
        format!("{document:#}\n")
    }
}

/// How a file says where an x axis points.
enum Turn {
    None,
    Angle(f64),
    Direction,
}

fn shortened(value: f64) -> f64 {
    let scale = 10_f64.powi(SHORT_DECIMALS);
    (value * scale).round() / scale
}

fn array(p: &Vector2<f64>) -> [f64; 2] {
    [p.x, p.y]
}

fn numbers(p: &Vector2<f64>) -> String {
    format!("[{:?}, {:?}]", p.x, p.y)
}
