//! `inverse`, `velocity`, `singularities`, `path`.

use std::path::{Path, PathBuf};

use assur::exchange::{
    AngleUnit, AskedLoci, InverseReport, Loci, ModelFile, Motion, MotionAnswer, PathReport, ROW_SCALING, map_csv,
    read_path,
};
use assur::nalgebra::{Matrix3, Vector2, Vector3};
use assur::{KinematicsError, MapQuantity, ModeChoice, PathEventKind, PathSettings, Pose, Reading, SingularMatrix};

use crate::args::{Quantity, Shown};
use crate::output::{self, Failure, Files};
use crate::tables::{ALARM, POSE_DIGITS, SIDE_DIGITS, STRONG, digits, heading, line, table};

pub(crate) fn about(file: &Path, error: impl std::fmt::Display) -> Failure {
    Failure::About(file.display().to_string(), error.to_string())
}

/// Three numbers, or the error that says how many there are.
fn three(what: &'static str, values: &[f64], file: &Path) -> Result<Vector3<f64>, Failure> {
    let [a, b, c] = *values else {
        return Err(about(file, KinematicsError::WrongCount { what, expected: 3, found: values.len() }));
    };
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(about(file, KinematicsError::NotFinite { what, value })),
        None => Ok(Vector3::new(a, b, c)),
    }
}

fn pose_of(values: &[f64], unit: AngleUnit, file: &Path) -> Result<Pose, Failure> {
    let [x, y, phi] = three("pose", values, file)?.into();
    Ok(Pose::new(x, y, unit.to_rad(phi)))
}

pub(crate) fn title(model: &ModelFile) -> String {
    let robot = &model.manipulator;
    if robot.name.is_empty() { robot.family() } else { robot.name.clone() }
}

fn shown_pose(pose: &Pose, unit: AngleUnit) -> String {
    let [x, y, phi] = [pose.x, pose.y, unit.from_rad(pose.phi)].map(|value| digits(value, POSE_DIGITS));
    format!("({x}, {y}, {phi} {})", unit.name())
}

pub(crate) fn inverse(file: &Path, pose: &[f64], json: bool) -> Result<(), Failure> {
    let model = ModelFile::read(file)?;
    let (robot, unit) = (&model.manipulator, model.angle_unit);
    let answer = robot.inverse(&pose_of(pose, unit, file)?).map_err(|error| about(file, error))?;
    if json {
        return output::print(&InverseReport::from(&answer).to_json());
    }
    let mut text = String::new();
    heading(&mut text, &title(&model));
    line(&mut text, format_args!("{}, pose {}", robot.family(), shown_pose(&answer.pose, unit)));
    if !answer.modes.is_empty() {
        let mut header = vec!["mode".to_owned()];
        header.extend((1..=robot.legs.len()).map(|leg| format!("leg {leg}: q1  q2  q3")));
        let mut table = table(&header);
        for mode in &answer.modes {
            let mut row = vec![mode.signs.clone()];
            for (leg, values) in robot.legs.iter().zip(&mode.joints) {
                let values = leg.joints.iter().zip(values);
                let values = values.map(|(&kind, &value)| digits(unit.joint_from_rad(kind, value), SIDE_DIGITS));
                row.push(values.collect::<Vec<_>>().join("  "));
            }
            table.add_row(row);
        }
        line(&mut text, format_args!("{table}"));
    }
    for mode in &answer.modes {
        for violation in &mode.violations {
            let kind = robot.legs[violation.leg - 1].joints[violation.joint - 1];
            let [value, low, high] = [violation.value, violation.limit[0], violation.limit[1]]
                .map(|value| digits(unit.joint_from_rad(kind, value), SIDE_DIGITS));
            let place = format!("{}: leg {}, joint {}", mode.signs, violation.leg, violation.joint);
            line(&mut text, format_args!("{ALARM}{place}: {value} outside [{low}, {high}]{ALARM:#}"));
        }
    }
    for leg in &answer.unreachable {
        let miss = digits(leg.miss, SIDE_DIGITS);
        line(&mut text, format_args!("{ALARM}leg {} does not reach: it misses by {miss}{ALARM:#}", leg.leg));
    }
    for special in &answer.special {
        line(&mut text, format_args!("special: {special}"));
    }
    let count = answer.modes.len();
    let modes = if count == 1 { "working mode" } else { "working modes" };
    line(&mut text, format_args!("{STRONG}{count} {modes}{STRONG:#}"));
    output::print(&text)
}

/// What is asked of a pose in motion, as given.
pub(crate) struct AskedMotion {
    pub(crate) rates: Vec<f64>,
    pub(crate) accelerations: Vec<f64>,
    pub(crate) wrench: Vec<f64>,
    pub(crate) length: Option<f64>,
}

pub(crate) fn velocity(
    file: &Path,
    pose: &[f64],
    mode: Option<&str>,
    asked: &AskedMotion,
    json: bool,
) -> Result<(), Failure> {
    let model = ModelFile::read(file)?;
    let (robot, unit) = (&model.manipulator, model.angle_unit);
    let pose = pose_of(pose, unit, file)?;
    let optional = |what, values: &[f64]| (!values.is_empty()).then(|| three(what, values, file)).transpose();
    let motion = Motion {
        rates: optional("rates", &asked.rates)?,
        accelerations: optional("accelerations", &asked.accelerations)?,
        wrench: optional("wrench", &asked.wrench)?,
    };
    let answer = MotionAnswer::of(robot, &pose, mode, motion, asked.length).map_err(|error| match error {
        KinematicsError::WhichMode { .. } => about(file, format!("{error}; name one with --mode")),
        other => about(file, other),
    })?;
    output::print(&if json { answer.report().to_json() } else { velocity_table(&model, &answer) })
}

fn velocity_table(model: &ModelFile, answer: &MotionAnswer) -> String {
    let (robot, unit) = (&model.manipulator, model.angle_unit);
    let MotionAnswer { signs, choice, velocity, singularity, motion } = answer;
    let mut text = String::new();
    heading(&mut text, &title(model));
    let why = if *choice == ModeChoice::Named { String::new() } else { format!(" ({})", choice.name()) };
    line(&mut text, format_args!("{}, mode {signs}{why}, pose {}", robot.family(), shown_pose(&velocity.pose, unit)));
    line(&mut text, format_args!("A (x', y', phi') + B inputs' = 0, angles in radians; rows not scaled:"));
    line(&mut text, format_args!("  {ROW_SCALING}"));
    let mut matrices = table(&["leg", "A: x'", "y'", "phi'", "B: 1", "2", "3"]);
    let entries = |m: &Matrix3<f64>, row: usize| (0..3).map(|c| digits(m[(row, c)], SIDE_DIGITS)).collect::<Vec<_>>();
    for row in 0..3 {
        let mut cells = vec![velocity.row_legs[row].to_string()];
        cells.extend(entries(&velocity.pose_matrix, row));
        cells.extend(entries(&velocity.input_matrix, row));
        matrices.add_row(cells);
    }
    line(&mut text, format_args!("{matrices}"));
    let legs = |legs: &[usize]| legs.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
    let mut kind = format!("singularity  {}", singularity.kind.name());
    if !singularity.legs.is_empty() {
        kind += &format!(" (leg {})", legs(&singularity.legs));
    }
    line(&mut text, format_args!("{STRONG}{kind}{STRONG:#}"));
    if !singularity.idle_legs.is_empty() {
        let legs = legs(&singularity.idle_legs);
        line(&mut text, format_args!("leg {legs}: its idle joints move with the platform at rest"));
    }
    let vector = |v: Vector2<f64>| format!("({}, {})", digits(v.x, SIDE_DIGITS), digits(v.y, SIDE_DIGITS));
    match singularity.reading {
        Some(Reading::Meet { point }) => {
            line(&mut text, format_args!("the legs' lines of force meet in {}", vector(point)));
        }
        Some(Reading::Parallel { direction }) => {
            line(&mut text, format_args!("the legs' lines of force are parallel, along {}", vector(direction)));
        }
        Some(Reading::OneLine { direction }) => {
            line(&mut text, format_args!("the legs' lines of force are one line, along {}", vector(direction)));
        }
        None => {}
    }
    let length = digits(singularity.characteristic_length, SIDE_DIGITS);
    let values = singularity.singular_values.map(|value| format!("{value:.4e}")).join("  ");
    line(
        &mut text,
        format_args!("singular values  {values}  of A with moments over {length}, then each row of length 1"),
    );
    line(
        &mut text,
        format_args!(
            "smallest sine of B  {:.4e}  (rows as those of A, columns of length 1)",
            singularity.sigma_min_input
        ),
    );
    line(
        &mut text,
        format_args!(
            "dexterity  {:.6}  (of inverse(B) A with angles times {length}, inputs as they are)",
            singularity.dexterity
        ),
    );
    line(&mut text, format_args!("characteristic length  {length}"));
    let mut say = |what: &str, answer: Result<Vector3<f64>, SingularMatrix>| match answer {
        Ok(found) => {
            let found = found.iter().map(|value| digits(*value, SIDE_DIGITS)).collect::<Vec<_>>().join(", ");
            line(&mut text, format_args!("{what}  {found}"));
        }
        Err(error) => line(&mut text, format_args!("{what}  {ALARM}none: {error}{ALARM:#}")),
    };
    let rates = motion.rates.unwrap_or_else(Vector3::zeros);
    if motion.rates.is_some() {
        say("actuator rates for these platform rates  ", velocity.input_rates(&rates));
        say("platform rates for these actuator rates  ", velocity.pose_rates(&rates));
    }
    if let Some(given) = &motion.accelerations {
        say("actuator accelerations for the platform's", velocity.input_accelerations(&rates, given));
        say("platform accelerations for the actuators'", velocity.pose_accelerations(&rates, given));
    }
    if let Some(wrench) = &motion.wrench {
        say("actuator forces that hold this wrench    ", velocity.actuator_forces(wrench));
    }
    text
}

/// What loci are asked for.
pub(crate) struct LociOptions {
    pub(crate) phi: f64,
    pub(crate) mode: Option<String>,
    pub(crate) map: Option<Quantity>,
    pub(crate) csv: Option<PathBuf>,
    pub(crate) polynomial: bool,
}

pub(crate) fn singularities(file: &Path, asked: &LociOptions, shown: &Shown) -> Result<(), Failure> {
    let model = ModelFile::read(file)?;
    let (robot, unit) = (&model.manipulator, model.angle_unit);
    let phi = unit.to_rad(asked.phi);
    let map = asked.map.map(|quantity| match quantity {
        Quantity::Dexterity => MapQuantity::Dexterity,
        Quantity::Accuracy => MapQuantity::Accuracy,
        Quantity::Stiffness => MapQuantity::Stiffness,
    });
    let question = AskedLoci { phi, mode: asked.mode.clone(), map, polynomial: asked.polynomial };
    let found = Loci::of(robot, &question).map_err(|error| about(file, error))?;
    let Loci { window, legs, edges, traced, locus, map, .. } = &found;
    let draw = || assur::plot::draw_singularities(robot, phi, window, traced, edges, map.as_ref());
    let mut files = Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?;
    if let (Some(path), Some(map)) = (&asked.csv, map) {
        files = files.with(path, map_csv(map).into_bytes());
    }
    files.write()?;
    if shown.json {
        return output::print(&found.report().to_json());
    }
    let mut text = String::new();
    heading(&mut text, &title(&model));
    let at = format!("phi = {} {}", digits(asked.phi, POSE_DIGITS), unit.name());
    line(&mut text, format_args!("{}, singular positions at {at}", robot.family()));
    match locus {
        Ok(locus) if locus.polynomial.vanishes() => line(&mut text, format_args!("type 2: in every position")),
        Ok(locus) if locus.degree() == 0 => line(&mut text, format_args!("type 2: in no position")),
        Ok(locus) => {
            let terms = locus.polynomial.term_count();
            line(&mut text, format_args!("type 2: a curve of degree {}, {terms} terms, for all modes", locus.degree()));
            for (factor, power) in &locus.removed {
                line(&mut text, format_args!("        removed to the power {power}: {factor}"));
            }
        }
        Err(reason) => line(
            &mut text,
            format_args!("type 2: no exact curve ({reason}); what is drawn is traced by the sign of det A"),
        ),
    }
    for (signs, pieces) in traced {
        let length: f64 = pieces.iter().map(|[p, q]| (p - q).norm()).sum();
        line(&mut text, format_args!("        {signs}: length {} within reach and limits", digits(length, 5)));
    }
    for leg in legs {
        let curves: Vec<String> = leg.curves.iter().map(curve_text).collect();
        let curves = match (leg.everywhere, curves.is_empty()) {
            (true, _) => "in every position".to_owned(),
            (false, true) => "nowhere".to_owned(),
            (false, false) => curves.join("; "),
        };
        line(&mut text, format_args!("type 1, leg {}: {curves}", leg.leg));
    }
    if let Some(map) = map {
        let known: Vec<f64> = map.values.iter().flatten().copied().collect();
        let (low, high) = known.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        let range = format!("{} to {}", digits(low, 5), digits(high, 5));
        let range = if known.is_empty() { "nowhere in reach".to_owned() } else { range };
        line(&mut text, format_args!("{} of mode {}: {range}", map.quantity.name(), map.signs));
    }
    output::print(&text)
}

fn curve_text(curve: &assur::PlaneCurve) -> String {
    let vector = |v: Vector2<f64>| format!("({}, {})", digits(v.x, SIDE_DIGITS), digits(v.y, SIDE_DIGITS));
    match *curve {
        assur::PlaneCurve::Circle { center, radius } => {
            format!("circle about {} of radius {}", vector(center), digits(radius, SIDE_DIGITS))
        }
        assur::PlaneCurve::Line { point, direction } => {
            format!("line through {} along {}", vector(point), vector(direction))
        }
    }
}

pub(crate) fn path(
    file: &Path,
    through: &Path,
    from: &[f64],
    target: Option<&Path>,
    shown: &Shown,
) -> Result<(), Failure> {
    let model = ModelFile::read(file)?;
    let (robot, unit) = (&model.manipulator, model.angle_unit);
    let rows = read_path(through, robot, unit)?;
    let from = if from.is_empty() { None } else { Some(pose_of(from, unit, file)?) };
    let count = rows.len();
    let bar = output::progress(Some(count as u64), "{wide_bar} {pos} of {len} rows, {eta} left");
    let followed = robot.follow_with(&rows, from, &PathSettings::default(), |done| bar.set_position(done as u64));
    bar.finish_and_clear();
    let followed = followed.map_err(|error| about(through, error))?;
    let report = PathReport::from(&followed);
    let draw = || assur::plot::draw_path(robot, &followed);
    let mut files = Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?;
    if let Some(target) = target {
        let lines = target.extension().is_some_and(|ending| ending == "jsonl");
        let content = if lines { report.to_json_lines() } else { report.to_csv() };
        files = files.with(target, content.into_bytes());
    }
    files.write()?;
    if shown.json {
        return output::print(&report.to_json());
    }
    let mut text = String::new();
    heading(&mut text, &title(&model));
    let id = followed.rows.first().map_or(0, |row| row.id);
    line(&mut text, format_args!("{}, mode {id} through {} of {count} rows", robot.family(), followed.rows.len()));
    for event in &followed.events {
        let inputs = robot
            .actuated_joints()
            .zip(&event.inputs)
            .map(|((leg, joint), value)| digits(unit.joint_from_rad(robot.legs[leg].joints[joint], *value), 14));
        let place = format!(
            "at {}: inputs {}; pose {}",
            digits(event.at, POSE_DIGITS),
            inputs.collect::<Vec<_>>().join(", "),
            shown_pose(&event.pose, unit)
        );
        match &event.kind {
            PathEventKind::Meeting => {
                line(
                    &mut text,
                    format_args!("{ALARM}meeting{ALARM:#} {place}: two modes meet and end, the path stops"),
                );
            }
            PathEventKind::Branch => {
                line(
                    &mut text,
                    format_args!("{ALARM}branch{ALARM:#} {place}: modes cannot be told apart, the path stops"),
                );
            }
            PathEventKind::SelfMotion { phi } => {
                let how = phi.map_or("turning".to_owned(), |phi| {
                    format!("translating at phi = {} {}", digits(unit.from_rad(phi), POSE_DIGITS), unit.name())
                });
                line(
                    &mut text,
                    format_args!(
                        "{ALARM}self-motion{ALARM:#} {place}: the platform is free to move, {how}; the path stops"
                    ),
                );
            }
            PathEventKind::Limit { violation, leaves } => {
                let way = if *leaves { "leaves" } else { "comes back into" };
                let joint = format!("leg {}, joint {}", violation.leg, violation.joint);
                line(&mut text, format_args!("limit {place}: {joint} {way} its range"));
            }
        }
    }
    if let Some(distance) = followed.distance_to_meeting(1) {
        line(&mut text, format_args!("distance along the path from row 1 to the meeting: {}", digits(distance, 14)));
    }
    let end = match (followed.complete, followed.closed_in) {
        (true, Some(last)) if last != id => format!("complete; the loop ends in mode {last}, without a singularity"),
        (true, Some(_)) => "complete; the loop ends in the same mode".to_owned(),
        (true, None) => "complete".to_owned(),
        (false, _) => "stopped".to_owned(),
    };
    line(&mut text, format_args!("{STRONG}{end}{STRONG:#}"));
    output::print(&text)
}
