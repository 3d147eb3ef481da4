//! Answers about the two spatial robots as JSON documents. Angles in radians.

use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};
use serde_json::{Value, json};

use crate::solve::Account;
use crate::spatial::{
    ArcRegion, Capability, CapabilityMap, CapabilityStop, CapabilitySupremum, Counted, DeterminantPoint,
    HanaAssemblies, HanaPose, HanaVelocity, HanaViolation, HanaWays, MixedReach, MixedSingularity, SpatialError, Tilt,
    TiltLimit, Tripod, TripodAssemblies, TripodAssembly, TripodDesign, TripodError, TripodPointed, TripodPose,
    TripodReach, TripodTorsions, TripodVelocity, WorkspaceArc, WorkspaceCurve,
};

pub(super) fn text(document: &Value) -> String {
    format!("{document:#}\n")
}

fn hana_pose(pose: &HanaPose) -> [f64; 3] {
    [pose.y, pose.z, pose.phi]
}

pub(super) fn account(account: &Account) -> Value {
    json!({
        "degree": account.degree, "real": account.real, "complex": account.complex, "at_infinity": account.at_infinity,
        "rejected": account.rejected, "self_motion": account.self_motion, "undecided": account.undecided,
    })
}

fn hana_violations(found: &[HanaViolation]) -> Value {
    found.iter().map(|v| json!({ "leg": v.leg, "value": v.value, "limit": v.limit })).collect()
}

/// Every working mode of a pose of HANA, and the mixed-mode singular inputs at its place.
pub fn hana_inverse_json(answer: &HanaWays, mixed: &[MixedSingularity], reach: MixedReach) -> String {
    let modes: Vec<Value> = answer
        .modes
        .iter()
        .map(|way| {
            let violations = hana_violations(&way.violations);
            json!({ "signs": way.mode.to_string(), "inputs": way.inputs, "violations": violations })
        })
        .collect();
    let unreachable: Vec<Value> =
        answer.unreachable.iter().map(|leg| json!({ "leg": leg.leg, "miss": leg.miss })).collect();
    let mixed: Vec<Value> = mixed
        .iter()
        .map(|m| {
            let kind = if m.stretched { "stretched" } else { "folded" };
            json!({ "kind": kind, "phi": m.phi, "inputs": m.inputs, "within_strokes": m.within_strokes })
        })
        .collect();
    let reach = match reach {
        MixedReach::Nowhere => json!({ "reached": "nowhere" }),
        MixedReach::At { y, z } => json!({ "reached": "somewhere", "y": y, "z": z }),
        MixedReach::Touched { y } => json!({ "reached": "touched", "y": y }),
    };
    text(&json!({
        "schema": "assur/hana-inverse/1", "pose": hana_pose(&answer.pose), "modes": modes, "unreachable_legs": unreachable,
        "merged_legs": answer.merged, "mixed_singularities_here": mixed, "mixed_singularities": reach,
    }))
}

/// Every way to put HANA together.
pub fn hana_forward_json(answer: &HanaAssemblies, violations: &[HanaViolation]) -> String {
    let modes: Vec<Value> = answer
        .modes
        .iter()
        .map(|mode| {
            json!({
                "pose": hana_pose(&mode.pose), "signs": mode.mode.to_string(), "family": mode.family.name(),
                "multiplicity": mode.multiplicity, "residual": mode.residual,
            })
        })
        .collect();
    let motions: Vec<Value> = answer.self_motions.iter().map(|phi| json!({ "phi": phi })).collect();
    let status = if motions.is_empty() { "complete" } else { "self_motion" };
    text(&json!({
        "schema": "assur/hana-forward/1", "status": status, "inputs": answer.inputs, "modes": modes,
        "account": account(&answer.account), "self_motions": motions, "violations": hana_violations(violations),
    }))
}

fn rows(m: &Matrix3<f64>) -> Vec<[f64; 3]> {
    m.row_iter().map(|row| std::array::from_fn(|k| row[k])).collect()
}

fn answer<const N: usize, E: ToString>(found: Result<[f64; N], E>) -> Value {
    match found {
        Ok(values) => json!(values.to_vec()),
        Err(error) => json!({ "singular": error.to_string() }),
    }
}

/// The matrices of HANA in a pose, its singularity, and rates and accelerations both ways where they are asked for.
pub fn hana_velocity_json(
    velocity: &HanaVelocity,
    rates: Option<Vector3<f64>>,
    accelerations: Option<Vector3<f64>>,
) -> String {
    let singularity = velocity.singularity();
    let three = |found: Result<Vector3<f64>, SpatialError>| answer::<3, _>(found.map(Into::into));
    let at = rates.unwrap_or_else(Vector3::zeros);
    let mut document = json!({
        "schema": "assur/hana-velocity/1", "pose": hana_pose(&velocity.pose), "signs": velocity.mode.to_string(),
        "inputs": velocity.inputs, "pose_matrix": rows(&velocity.pose_matrix), "input_matrix": rows(&velocity.input_matrix),
        "row_scaling": "force: the link as a vector; moment about the platform's axis",
        "det_pose": velocity.pose_matrix.determinant(), "det_input": velocity.input_matrix.determinant(),
        "singularity": singularity.kind.name(), "legs": singularity.level_legs, "reading": singularity.reading,
        "sigma_min": singularity.sigma_min, "sigma_min_input": singularity.sigma_min_input, "dexterity": singularity.dexterity,
    });
    if let Some(given) = rates {
        document["rates"] = json!({
            "given": given.as_slice(), "inputs_if_pose": three(velocity.input_rates(&given)),
            "pose_if_inputs": three(velocity.pose_rates(&given)),
        });
    }
    if let Some(given) = accelerations {
        document["accelerations"] = json!({
            "given": given.as_slice(), "inputs_if_pose": three(velocity.input_accelerations(&at, &given)),
            "pose_if_inputs": three(velocity.pose_accelerations(&at, &given)),
        });
    }
    text(&document)
}

/// A workspace of HANA in the plane `Oyz`: coordinates are `(y, z)`.
pub fn hana_workspace_json(kind: &str, region: &ArcRegion) -> String {
    let arc = |arc: &WorkspaceArc| {
        let mut piece = json!({
            "curve": arc.curve.name(), "start": arc.start, "end": arc.end, "length": arc.length, "active": arc.active,
        });
        match arc.curve {
            WorkspaceCurve::Line => {}
            WorkspaceCurve::Circle(c) => {
                piece["center"] = json!(c.center);
                piece["radius"] = json!(c.radius);
                piece["start_angle"] = json!(c.start_angle);
                piece["end_angle"] = json!(c.end_angle);
            }
            // (z - height)² = (a0 + a1 l)(b0 + b1 l), l = sqrt(L² - y²)
            WorkspaceCurve::Spiric(curve) | WorkspaceCurve::LevelLink(curve) => {
                piece["height"] = json!(curve.height);
                piece["L"] = json!(curve.link);
                piece["factors"] = json!(curve.factors);
            }
        }
        piece
    };
    let loops: Vec<Value> = region
        .loops
        .iter()
        .map(|(area, arcs)| json!({ "area": area, "arcs": arcs.iter().map(arc).collect::<Vec<_>>() }))
        .collect();
    text(&json!({
        "schema": "assur/workspace/1", "kind": kind, "status": "complete", "area": region.area, "perimeter": region.perimeter,
        "centroid": region.centroid, "bbox": region.bbox, "components": region.components(), "holes": region.holes(), "loops": loops,
    }))
}

/// What ends a tilt of HANA's platform, in words.
pub fn capability_stop_name(stop: CapabilityStop) -> String {
    match stop {
        CapabilityStop::Stroke { leg, upper } => format!("leg {leg} {}", if upper { "max" } else { "min" }),
        CapabilityStop::Level => "links 1 and 2 level".to_owned(),
        CapabilityStop::QuarterTurn => "quarter turn, singular".to_owned(),
        CapabilityStop::InLine => "links in line, singular".to_owned(),
    }
}

/// The rotational capability at a place, over a map, its supremum, and against strokes: what was asked for.
pub fn hana_capability_json(
    at: Option<([f64; 2], Option<&Capability>)>,
    supremum: Option<&CapabilitySupremum>,
    map: Option<&CapabilityMap>,
    curve: &[(f64, Option<f64>)],
) -> String {
    let best = supremum
        .map(|best| json!({ "zeta": best.zeta, "at": best.at, "attained": best.attained, "at_most": best.at_most }));
    let mut document = json!({ "schema": "assur/hana-capability/1", "supremum": best });
    if let Some((place, found)) = at {
        document["at"] = json!(place);
        document["inside"] = json!(found.is_some());
        document["zeta"] = json!(found.map(|found| found.zeta));
        document["range"] = json!(found.map(|found| found.range));
        document["limits"] = json!(found.map(|found| found.stops.map(capability_stop_name)));
    }
    if let Some(map) = map {
        let [columns, rows] = map.size;
        document["map"] = json!({ "window": map.window, "columns": columns, "rows": rows, "values": map.values });
    }
    if !curve.is_empty() {
        let points: Vec<Value> =
            curve.iter().map(|(half, zeta)| json!({ "half_stroke": half, "zeta": zeta })).collect();
        document["against_strokes"] = json!(points);
    }
    text(&document)
}

pub(super) fn tripod_pose(pose: &TripodPose) -> Value {
    json!({ "position": pose.position.as_slice(), "rotation": rows(pose.rotation.matrix()) })
}

fn tripod_reach(found: &[TripodReach]) -> Value {
    let reach = |v: &TripodReach| match v.slider {
        Some(slider) => json!({ "leg": v.leg, "slider": slider, "value": v.value, "limit": v.limit }),
        None => json!({ "leg": v.leg, "plane_angle": v.value, "limit": v.limit }),
    };
    found.iter().map(reach).collect()
}

/// The slider positions for a pose, with the limits that they violate.
pub fn tripod_inverse_json(
    pose: &TripodPose,
    inputs: &[f64; 6],
    angles: &[f64; 3],
    violations: &[TripodReach],
) -> String {
    text(&json!({
        "schema": "assur/tripod-inverse/1", "pose": tripod_pose(pose), "inputs": inputs, "plane_angles": angles,
        "violations": tripod_reach(violations),
    }))
}

/// The orientations that point a tool in a direction; where every torsion serves (`every_torsion`), that of torsion 0.
pub fn tripod_torsions_json(direction: &Vector3<f64>, found: &TripodTorsions) -> String {
    let one =
        |torsion: f64, rotation: &Rotation3<f64>| json!({ "torsion": torsion, "rotation": rows(rotation.matrix()) });
    let solutions: Vec<Value> = match found {
        TripodTorsions::Isolated(found) => found.iter().map(|(torsion, rotation)| one(*torsion, rotation)).collect(),
        TripodTorsions::Every(rotation) => vec![one(0.0, rotation)],
    };
    text(&json!({
        "schema": "assur/tripod-torsions/1", "status": found.status(), "direction": direction.as_slice(),
        "solutions": solutions,
    }))
}

/// The poses that point a tool in a direction; where every torsion serves (`every_torsion`), that of torsion 0.
pub fn tripod_pointing_json(position: &Vector3<f64>, direction: &Vector3<f64>, found: &TripodPointed) -> String {
    let ways: Vec<Value> = found
        .ways
        .iter()
        .map(|way| {
            json!({
                "torsion": way.torsion, "pose": tripod_pose(&way.pose), "inputs": way.inputs,
                "plane_angles": way.plane_angles, "violations": tripod_reach(&way.violations),
            })
        })
        .collect();
    text(&json!({
        "schema": "assur/tripod-pointing/1", "status": found.status(), "position": position.as_slice(), "direction": direction.as_slice(),
        "solutions": ways,
    }))
}

/// Every way to put a three-legged robot together.
pub fn tripod_forward_json(answer: &TripodAssemblies) -> String {
    let proof = if answer.counted == Counted::Exactly { "proven" } else { "not_asked" };
    let list = |modes: &[TripodAssembly]| -> Value {
        modes
            .iter()
            .map(|mode| {
                let legs: Vec<usize> = (1..=3).filter(|&leg| mode.parallel_axes[leg - 1]).collect();
                json!({
                    "pose": tripod_pose(&mode.pose), "multiplicity": mode.multiplicity, "residual": mode.residual,
                    "parallel_axes": legs, "proof": proof,
                })
            })
            .collect()
    };
    text(&json!({
        "schema": "assur/tripod-forward/1", "status": answer.status.name(), "inputs": answer.inputs,
        "modes": list(&answer.modes), "spurious": list(&answer.spurious), "account": account(&answer.account),
    }))
}

/// The Jacobian of a three-legged robot in a pose, and rates and accelerations both ways where they are asked for.
///
/// Six numbers each: of the platform or of the sliders; of the sliders only where `of_platform` is not set. Sliders of a leg with one motor that part are `refused`.
pub fn tripod_velocity_json(
    robot: &Tripod,
    velocity: &TripodVelocity,
    rates: Option<Vector6<f64>>,
    accelerations: Option<Vector6<f64>>,
    of_platform: bool,
) -> String {
    let six = |found: Result<Vector6<f64>, TripodError>| answer::<6, _>(found.map(Into::into));
    let all = |what, given: &Vector6<f64>| robot.all_sliders(what, given.as_slice()).map(Vector6::from);
    let refused = |error: TripodError| json!({ "refused": error.to_string() });
    let jacobian: Vec<Vec<f64>> = velocity.jacobian.row_iter().map(|row| row.iter().copied().collect()).collect();
    let singularity = velocity.singularity();
    let mut document = json!({
        "schema": "assur/tripod-velocity/1", "pose": tripod_pose(&velocity.pose), "inputs": velocity.inputs,
        "jacobian": jacobian, "columns": "p' (length), omega (rad, base frame)", "det_jacobian": velocity.jacobian.determinant(),
        "singularity": singularity.name(), "reading": singularity.reading(),
        "position_volume": velocity.position_volume, "orientation_volume": velocity.orientation_volume,
    });
    if let Some(given) = rates {
        let inputs = of_platform.then(|| velocity.input_rates(&given));
        let pose = all("rates", &given).map_or_else(refused, |sliders| six(velocity.pose_rates(&sliders)));
        document["rates"] = json!({
            "given": given.as_slice(), "inputs_if_pose": inputs.as_ref().map(|found| found.as_slice()), "pose_if_inputs": pose,
        });
        if let Some(Err(error)) = inputs.map(|found| all("rates", &found)) {
            document["rates"]["pose_refused"] = json!(error.to_string());
        }
    }
    if let Some(given) = accelerations {
        let at = rates.unwrap_or_else(Vector6::zeros);
        let inputs = of_platform.then(|| velocity.input_accelerations(&at, &given));
        let pose = all("rates", &at)
            .and(all("accelerations", &given))
            .map_or_else(refused, |sliders| six(velocity.pose_accelerations(&at, &sliders)));
        document["accelerations"] = json!({
            "given": given.as_slice(), "inputs_if_pose": inputs.as_ref().map(|found| found.as_slice()), "pose_if_inputs": pose,
        });
    }
    text(&document)
}

/// `det J` over the elevations of a design: one curve a pose. `null` where the Jacobian has a pole (type 1).
pub fn tripod_determinant_json(
    design: TripodDesign,
    distances: [f64; 2],
    curves: &[(TripodPose, Vec<DeterminantPoint>)],
) -> String {
    let point =
        |p: &DeterminantPoint| json!({ "elevation": p.elevation, "between": p.between, "determinant": p.determinant });
    let curve = |(pose, points): &(TripodPose, Vec<DeterminantPoint>)| json!({ "pose": tripod_pose(pose), "points": points.iter().map(point).collect::<Vec<_>>() });
    text(&json!({
        "schema": "assur/tripod-determinant/1", "design": design.name(), "d1": distances[0], "d2": distances[1],
        "curves": curves.iter().map(curve).collect::<Vec<_>>(),
    }))
}

/// The same as CSV, angles in radians: one row an elevation, one column a pose; empty where the Jacobian has a pole.
pub fn tripod_determinant_csv(curves: &[(TripodPose, Vec<DeterminantPoint>)]) -> String {
    let mut text = "elevation,between".to_owned();
    (1..=curves.len()).for_each(|number| text.push_str(&format!(",det_J_{number}")));
    text.push('\n');
    let rows = curves.first().map_or(&[][..], |(_, points)| points);
    for (row, point) in rows.iter().enumerate() {
        text.push_str(&format!("{},{}", point.elevation, point.between));
        for (_, points) in curves {
            let value = points.get(row).and_then(|point| point.determinant);
            text.push_str(&value.map_or(",".to_owned(), |value| format!(",{value}")));
        }
        text.push('\n');
    }
    text
}

/// What ends a tilt, in words.
pub fn tilt_limit_name(limit: TiltLimit) -> String {
    match limit {
        TiltLimit::Stroke { slider, upper } => format!("slider {slider} {}", if upper { "max" } else { "min" }),
        TiltLimit::PlaneAngle { leg } => format!("plane angle of leg {leg}"),
        TiltLimit::AlongRail { leg } => format!("plane of leg {leg} along its rails"),
        TiltLimit::HalfTurn => "none before a half turn".to_owned(),
    }
}

/// The largest tilt at a place, with the angle that is proved for every azimuth.
pub fn tilt_json(place: &Vector3<f64>, tilt: Option<&Tilt>, proved: Option<f64>) -> String {
    text(&json!({
        "schema": "assur/tripod-tilt/1", "at": place.as_slice(), "inside": tilt.is_some(),
        "tilt": tilt.map(|tilt| tilt.angle), "worst_azimuth": tilt.map(|tilt| tilt.azimuth),
        "limit": tilt.map(|tilt| tilt_limit_name(tilt.limit)), "proved_at_least": proved,
    }))
}

/// Largest tilts over sections at heights `z`: `[row][column]` from the lowest corner.
pub fn tilt_map_json(low: [f64; 3], high: [f64; 3], cells: usize, sections: &[(f64, Vec<Option<f64>>)]) -> String {
    let section = |(z, values): &(f64, Vec<Option<f64>>)| json!({ "z": z, "values": values });
    text(&json!({
        "schema": "assur/tripod-tilt-map/1", "low": low, "high": high, "columns": cells, "rows": cells,
        "sections": sections.iter().map(section).collect::<Vec<_>>(),
    }))
}
