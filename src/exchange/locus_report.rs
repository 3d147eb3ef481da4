//! The answer to `singularities` as a JSON document, and maps as JSON or CSV. Angles in radians.

use std::fmt::Write;

use nalgebra::Vector2;
use serde::Serialize;

use crate::manipulator::{LegLocus, PlaneCurve, PlaneMap, SingularityLocus};

/// The pieces of each working mode's curve, with its name.
pub type TracedModes = Vec<(String, Vec<[Vector2<f64>; 2]>)>;

/// Where a manipulator is singular, for a fixed orientation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SingularitiesReport {
    schema: &'static str,
    phi: f64,
    type_2: Type2Report,
    type_1: Vec<LegReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    map: Option<MapReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Type2Report {
    /// `null` where there is none, with the reason beside it.
    polynomial: Option<CurveReport>,
    /// Why there is no polynomial.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// What the pieces are clipped to.
    clipped_to: &'static str,
    modes: Vec<ModeReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct CurveReport {
    variables: [&'static str; 2],
    degree: u32,
    everywhere: bool,
    /// `[power of x, power of y, coefficient]`, rounded, the largest of modulus 1.
    terms: Vec<(u32, u32, f64)>,
    removed: Vec<(String, u32)>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct ModeReport {
    signs: String,
    pieces: Vec<[[f64; 2]; 2]>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct LegReport {
    leg: usize,
    everywhere: bool,
    curves: Vec<PlaneCurveReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "curve", rename_all = "lowercase")]
enum PlaneCurveReport {
    Circle { center: [f64; 2], radius: f64 },
    Line { point: [f64; 2], direction: [f64; 2] },
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct MapReport {
    quantity: &'static str,
    signs: String,
    characteristic_length: f64,
    low: [f64; 2],
    high: [f64; 2],
    columns: usize,
    rows: usize,
    values: Vec<Option<f64>>,
}

impl SingularitiesReport {
    /// The report on the curves, and on a map if one was made. `locus`: the exact curve, or why there is none.
    pub fn new(
        phi: f64,
        locus: Result<&SingularityLocus, String>,
        modes: &TracedModes,
        legs: &[LegLocus],
        map: Option<&PlaneMap>,
    ) -> Self {
        let curve = |locus: &SingularityLocus| CurveReport {
            variables: ["x", "y"],
            degree: locus.degree(),
            everywhere: locus.polynomial.vanishes(),
            terms: locus.rounded_terms(),
            removed: locus.removed.clone(),
        };
        let mode = |(signs, pieces): &(String, Vec<[Vector2<f64>; 2]>)| ModeReport {
            signs: signs.clone(),
            pieces: pieces.iter().map(|piece| piece.map(Into::into)).collect(),
        };
        let plane_curve = |curve: &PlaneCurve| match *curve {
            PlaneCurve::Circle { center, radius } => PlaneCurveReport::Circle { center: center.into(), radius },
            PlaneCurve::Line { point, direction } => {
                PlaneCurveReport::Line { point: point.into(), direction: direction.into() }
            }
        };
        let leg = |leg: &LegLocus| LegReport {
            leg: leg.leg,
            everywhere: leg.everywhere,
            curves: leg.curves.iter().map(plane_curve).collect(),
        };
        let mapped = |map: &PlaneMap| MapReport {
            quantity: map.quantity.name(),
            signs: map.signs.clone(),
            characteristic_length: map.characteristic_length,
            low: map.window.low.into(),
            high: map.window.high.into(),
            columns: map.size[0],
            rows: map.size[1],
            values: map.values.clone(),
        };
        Self {
            schema: "assur/singularities/1",
            phi,
            type_2: Type2Report {
                reason: locus.as_ref().err().cloned(),
                polynomial: locus.ok().map(curve),
                clipped_to: "the reach of all legs within their limits",
                modes: modes.iter().map(mode).collect(),
            },
            type_1: legs.iter().map(leg).collect(),
            map: map.map(mapped),
        }
    }

    /// The report as a JSON document, ending in a newline.
    pub fn to_json(&self) -> String {
        super::report::json(self)
    }
}

/// A map as CSV with the header `x,y,` and the quantity's name; empty where a leg does not reach.
///
/// ```
/// use assur::{Manipulator, MapQuantity, exchange::map_csv};
/// let (robot, _) = Manipulator::of_family("3-RRR")?;
/// let window = robot.plane_window(0.3);
/// let map = robot.plane_map(MapQuantity::Dexterity, 0.3, "+++", None, &window, [4, 3])?;
/// assert!(map_csv(&map).starts_with("x,y,dexterity\n") && map_csv(&map).lines().count() == 13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn map_csv(map: &PlaneMap) -> String {
    let mut text = format!("x,y,{}\n", map.quantity.name());
    for (index, value) in map.values.iter().enumerate() {
        let p = map.at(index % map.size[0], index / map.size[0]);
        let value = value.map(|value| value.to_string()).unwrap_or_default();
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{},{},{value}", p.x, p.y);
    }
    text
}
