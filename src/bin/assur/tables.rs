//! Answers as tables for people.

use std::fmt::Write;

use anstyle::{AnsiColor, Style};
use assur::exchange::{
    AngleUnit, AnyCheck, CertificateReport, CheckReport, DyadEntry, ModelFile, SpatialCheckReport, SubjectReport,
    VerifyReport,
};
use assur::num_complex::Complex64;
use assur::{Assemblies, AssemblyMode, AssemblyModes, JointKind, Manipulator, Remark, Status, Triad, Verdict};
use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, TableStyle};

use crate::args::Asked;

pub(crate) const STRONG: Style = Style::new().bold();
pub(crate) const ALARM: Style = Style::new().fg_color(Some(anstyle::Color::Ansi(AnsiColor::Red)));
/// Digits of poses, and of everything beside them.
pub(crate) const POSE_DIGITS: i32 = 12;
pub(crate) const SIDE_DIGITS: i32 = 7;
/// Digits of a box's middle.
const BOX_DIGITS: i32 = 16;
/// Digits of inputs as written for people.
const INPUT_DECIMALS: f64 = 1e3;

/// Inputs in radians as a text for `--inputs`, in the file's unit.
pub(crate) fn inputs(robot: &Manipulator, inputs: &[f64], unit: AngleUnit) -> String {
    let value = |((leg, joint), &value): ((usize, usize), &f64)| {
        let value = unit.joint_from_rad(robot.legs[leg].joints[joint], value);
        ((value * INPUT_DECIMALS).round() / INPUT_DECIMALS).to_string()
    };
    robot.actuated_joints().zip(inputs).map(value).collect::<Vec<_>>().join(",")
}

/// Inputs given in the file's unit, in radians and length units; surplus ones stay as they are, to be refused by count.
pub(crate) fn inputs_in_radians(robot: &Manipulator, inputs: &[f64], unit: AngleUnit) -> Vec<f64> {
    let kinds = robot.actuated_joints().map(|(leg, joint)| robot.legs[leg].joints[joint]);
    let kinds = kinds.chain(std::iter::repeat(JointKind::Prismatic));
    inputs.iter().zip(kinds).map(|(&value, kind)| unit.joint_to_rad(kind, value)).collect()
}

pub(crate) fn check(report: &AnyCheck) -> String {
    match report {
        AnyCheck::Planar(report) => check_planar(report),
        AnyCheck::Spatial(report) => check_spatial(report),
    }
}

fn check_spatial(report: &SpatialCheckReport) -> String {
    let mut text = String::new();
    heading(&mut text, if report.name.is_empty() { report.family } else { &report.name });
    line(&mut text, format_args!("family        {}, {} degrees of freedom", report.family, report.degrees_of_freedom));
    line(&mut text, format_args!("degree bound  {}", report.degree_bound));
    line(&mut text, format_args!("working modes {}", report.working_modes));
    line(&mut text, format_args!("angle unit    {}", report.angle_unit));
    for (name, value) in &report.numbers {
        line(&mut text, format_args!("{name:<13} {value}"));
    }
    for remark in &report.remarks {
        line(&mut text, format_args!("{ALARM}note:{ALARM:#} {}", remark.text));
    }
    text
}

fn check_planar(report: &CheckReport) -> String {
    let mut text = String::new();
    heading(&mut text, if report.name.is_empty() { &report.family } else { &report.name });
    let bound = report.degree_bound.map_or("unknown".to_owned(), |bound| bound.to_string());
    let group = report.group.as_deref().unwrap_or("no triad");
    line(&mut text, format_args!("family        {}", report.family));
    line(&mut text, format_args!("locked group  {group}"));
    line(&mut text, format_args!("degree bound  {bound}"));
    line(&mut text, format_args!("angle unit    {}", report.angle_unit));
    let mut table = table(&["leg", "joints", "actuated", "locked"]);
    for (number, leg) in (1..).zip(&report.legs) {
        let actuated = leg.actuated.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
        table.add_row([number.to_string(), leg.joints.clone(), actuated, leg.passive.clone()]);
    }
    line(&mut text, format_args!("{table}"));
    for remark in &report.remarks {
        line(&mut text, format_args!("{ALARM}note:{ALARM:#} {}", remark.text));
    }
    text
}

pub(crate) fn forward(model: &ModelFile, answer: &AssemblyModes, asked: &Asked) -> String {
    let (robot, unit) = (&model.manipulator, model.angle_unit);
    let mut text = String::new();
    let family = robot.family();
    heading(&mut text, if robot.name.is_empty() { &family } else { &robot.name });
    let group = answer.triad().map_or("no triad".to_owned(), Triad::name);
    let inputs = inputs_as_given(robot, &answer.inputs, unit);
    line(&mut text, format_args!("{family}, locked {group}, inputs {inputs}"));
    if !answer.modes.is_empty() {
        let mut header = pose_header(unit);
        header.extend(["signs".to_owned()]);
        let mut table = table(&header);
        for (number, mode) in (1..).zip(&answer.modes) {
            let mut row = pose_row(number, &mode.mode, unit);
            row.push(mode.signs.clone());
            table.add_row(row);
        }
        line(&mut text, format_args!("{table}"));
        line(&mut text, format_args!("joint values, by leg and joint\n{}", joints(model, answer)));
        for (number, mode) in (1..).zip(&answer.modes) {
            for violation in &mode.violations {
                let kind = robot.legs[violation.leg - 1].joints[violation.joint - 1];
                let [value, low, high] = [violation.value, violation.limit[0], violation.limit[1]]
                    .map(|value| digits(unit.joint_from_rad(kind, value), SIDE_DIGITS));
                let place = format!("mode {number}: leg {}, joint {}", violation.leg, violation.joint);
                line(&mut text, format_args!("{ALARM}{place}: {value} outside [{low}, {high}]{ALARM:#}"));
            }
        }
    }
    group_facts(&mut text, &answer.group, unit, asked);
    for remark in robot.remarks().into_iter().filter(|remark| matches!(remark, Remark::FreeLeg { .. })) {
        line(&mut text, format_args!("note: {remark}"));
    }
    text
}

/// All joint values, one mode a row; actuated joints between underscores.
fn joints(model: &ModelFile, answer: &AssemblyModes) -> Table {
    let legs = &model.manipulator.legs;
    let joint = |leg: usize, joint: usize| {
        let mark = if legs[leg].actuated[joint] { "_" } else { "" };
        format!("{}.{} {mark}{}{mark}", leg + 1, joint + 1, legs[leg].joints[joint].letter())
    };
    let mut header = vec!["mode".to_owned()];
    header.extend((0..legs.len()).flat_map(|leg| (0..3).map(move |number| (leg, number))).map(|(l, j)| joint(l, j)));
    let mut table = table(&header);
    for (number, mode) in (1..).zip(&answer.modes) {
        let kinds = legs.iter().flat_map(|leg| leg.joints);
        let values = mode.joints.iter().flatten().zip(kinds);
        let values = values.map(|(&value, kind)| digits(model.angle_unit.joint_from_rad(kind, value), SIDE_DIGITS));
        table.add_row(std::iter::once(number.to_string()).chain(values));
    }
    table
}

pub(crate) fn triad(triad: &Triad, answer: &Assemblies, asked: &Asked) -> String {
    let mut text = String::new();
    heading(&mut text, &format!("Triad {}", triad.name()));
    if !answer.modes.is_empty() {
        let mut table = table(&pose_header(AngleUnit::Rad));
        for (number, mode) in (1..).zip(&answer.modes) {
            table.add_row(pose_row(number, mode, AngleUnit::Rad));
        }
        line(&mut text, format_args!("{table}"));
    }
    group_facts(&mut text, answer, AngleUnit::Rad, asked);
    text
}

/// The verdict on each claim, and what is missing. Angles in radians, as in reports.
pub(crate) fn verify(report: &VerifyReport) -> String {
    let mut text = String::new();
    let count = |verdict: &str| report.claims.iter().filter(|claim| claim.verdict == verdict).count();
    let mut table = table(&["claim", "x", "y", "phi (rad)", "verdict", "nearest pose", "distance"]);
    for (number, claim) in (1..).zip(&report.claims) {
        let nearest = claim.nearest.map_or("none".to_owned(), |mode| mode.to_string());
        let distance = claim.distance.map_or(String::new(), |distance| format!("{distance:.1e}"));
        let [x, y, phi] = claim.pose.map(|value| digits(value, POSE_DIGITS));
        let verdict = match claim.repeats {
            Some(earlier) => format!("{}, as claim {earlier}", claim.verdict),
            None => claim.verdict.to_owned(),
        };
        table.add_row([number.to_string(), x, y, phi, verdict, nearest, distance]);
    }
    if !report.claims.is_empty() {
        line(&mut text, format_args!("{table}"));
    }
    for missing in &report.missing {
        let [x, y, phi] = missing.pose.map(|value| digits(value, POSE_DIGITS));
        line(
            &mut text,
            format_args!("{ALARM}missing: pose {}, x = {x}, y = {y}, phi = {phi} rad{ALARM:#}", missing.mode),
        );
    }
    let [proven, refuted, undecided] = ["proven", "refuted", "undecided"].map(count);
    let missing = report.missing.len();
    line(
        &mut text,
        format_args!("{STRONG}{proven} proven, {refuted} refuted, {undecided} undecided; {missing} missing{STRONG:#}"),
    );
    if let Some(certificate) = &report.certificate {
        line(&mut text, format_args!("proof: {}", certificate.summary));
        subject(&mut text, certificate);
    }
    text
}

fn pose_header(unit: AngleUnit) -> Vec<String> {
    let phi = format!("phi ({})", unit.name());
    ["mode", "x", "y", &phi, "mult.", "det A", "residual"].map(str::to_owned).to_vec()
}

fn pose_row(number: usize, mode: &AssemblyMode, unit: AngleUnit) -> Vec<String> {
    vec![
        number.to_string(),
        digits(mode.pose.x, POSE_DIGITS),
        digits(mode.pose.y, POSE_DIGITS),
        digits(unit.from_rad(mode.pose.phi), POSE_DIGITS),
        mode.multiplicity.to_string(),
        format!("{:+.3e}", mode.det_a),
        format!("{:.0e}", mode.residual),
    ]
}

/// What is known beside the modes: the count, what is special, and what was asked for.
fn group_facts(text: &mut String, group: &Assemblies, unit: AngleUnit, asked: &Asked) {
    let account = group.account;
    let mut counts = vec![format!("{} real", account.real), format!("{} complex", account.complex)];
    let others = [
        (account.at_infinity, "at infinity"),
        (account.rejected, "rejected"),
        (account.self_motion, "on self-motions"),
        (account.undecided, "undecided"),
    ];
    counts.extend(others.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")));
    let status = match group.status {
        Status::Complete if group.modes.is_empty() => "complete: no assembly mode",
        Status::Complete => "complete",
        Status::SelfMotion => "self-motion: a curve of poses exists",
        Status::Undecided => "undecided: not every root could be decided",
    };
    line(text, format_args!("{STRONG}{status}{STRONG:#}; degree {} = {}", account.degree, counts.join(" + ")));
    if let Some(limit) = group.limit {
        line(text, format_args!("{ALARM}{limit}{ALARM:#}"));
    }
    if group.complex_out_of_range > 0 {
        let count = group.complex_out_of_range;
        line(
            text,
            format_args!("{count} of the complex solutions cannot be written: their numbers leave the range of f64"),
        );
    }
    for motion in &group.self_motions {
        let reality = if motion.real { "" } else { " (no real pose on it)" };
        match motion.phi {
            Some(phi) => {
                let phi = digits(unit.from_rad(phi), POSE_DIGITS);
                line(text, format_args!("self-motion: translation at phi = {phi} {}{reality}", unit.name()));
            }
            None => line(text, format_args!("self-motion: the platform turns along it{reality}")),
        }
    }
    for rejection in &group.rejections {
        let (theta, times) = (complex(rejection.theta), rejection.multiplicity);
        line(text, format_args!("rejected ×{times}: theta = {theta}: {}", rejection.reason));
    }
    if !group.special.is_empty() {
        let names: Vec<&str> = group.special.iter().map(|special| special.name()).collect();
        line(text, format_args!("special: {}", names.join(", ")));
    }
    for near in &group.near {
        line(
            text,
            format_args!("nearly {}, by {}, but not: decided exactly", near.special.name(), distance(near.distance)),
        );
    }
    if let Some(certificate) = &group.certificate {
        proof(text, group, &CertificateReport::from(certificate), unit);
    }
    if asked.complex && !group.complex.is_empty() {
        let mut table = table(&["theta = e^(i phi)", "z = x + iy", "w = x - iy", "mult."]);
        for mode in &group.complex {
            let [theta, z, w] = [mode.theta, mode.z, mode.w].map(complex);
            table.add_row([theta, z, w, mode.multiplicity.to_string()]);
        }
        line(text, format_args!("\nnon-real solutions\n{table}"));
    }
    if asked.polynomial {
        match &group.polynomial {
            None => line(text, format_args!("\nno eliminant: the orientation is given")),
            Some(polynomial) => {
                let mut table = table(&["power of theta", "coefficient"]);
                for (power, coefficient) in (polynomial.from..).zip(&polynomial.coefficients) {
                    table.add_row([power.to_string(), complex(*coefficient)]);
                }
                line(text, format_args!("\neliminant\n{table}"));
            }
        }
    }
}

/// How far a shape is missed.
fn distance(value: f64) -> String {
    if value < f64::MIN_POSITIVE { format!("less than {:.1e}", f64::MIN_POSITIVE) } else { format!("{value:.1e}") }
}

/// The box of each mode, and the theorem.
fn proof(text: &mut String, group: &Assemblies, certificate: &CertificateReport, unit: AngleUnit) {
    let phi = format!("phi ({})", unit.name());
    let mut table = table(&["pose", "proof", "x", "±", "y", "±", &phi, "±"]);
    for (number, mode) in (1..).zip(&group.modes) {
        let mut row =
            vec![number.to_string(), if mode.proof == Verdict::Proven { "proven" } else { "undecided" }.to_owned()];
        for (k, [low, high]) in mode.pose_box.into_iter().flatten().enumerate() {
            let in_unit = |value: f64| if k == 2 { unit.from_rad(value) } else { value };
            row.push(digits(in_unit(0.5 * low + 0.5 * high), BOX_DIGITS));
            row.push(format!("{:.1e}", in_unit(0.5 * (high - low))));
        }
        table.add_row(row);
    }
    if !group.modes.is_empty() {
        line(text, format_args!("\nboxes, each with one pose in it and no other\n{table}"));
    }
    line(text, format_args!("{STRONG}proof: {}{STRONG:#}", certificate.summary));
    subject(text, certificate);
    if certificate.rounded_offset {
        line(
            text,
            format_args!("an RP leg's d·|v| is no f64: counted as rounded, boxes of simple modes hold for both"),
        );
    }
    if certificate.indistinct > 0 {
        let count = certificate.indistinct;
        line(text, format_args!("{count} boxes meet: their modes are nearer than f64 can tell"));
    }
}

/// What a proof is about, with every number to its last digit.
fn subject(text: &mut String, certificate: &CertificateReport) {
    line(text, format_args!("of {}", certificate.about));
    match &certificate.subject {
        SubjectReport::Triad(triad) => {
            for (number, leg) in (1..).zip(&triad.legs) {
                line(text, format_args!("  leg {number}: {}", dyad(leg)));
            }
        }
        SubjectReport::Pinned { a, b, leg } => {
            line(text, format_args!("  pin: a = {a:?}, b = {b:?}"));
            line(text, format_args!("  leg: {}", dyad(leg)));
        }
        SubjectReport::Placed([x, y, phi]) => line(text, format_args!("  x = {x:?}, y = {y:?}, phi = {phi:?} rad")),
    }
}

fn dyad(leg: &DyadEntry) -> String {
    match leg {
        DyadEntry::RR { a, b, l } => format!("RR, a = {a:?}, b = {b:?}, l = {l:?}"),
        DyadEntry::PR { a, u, b } => format!("PR, a = {a:?}, u = {u:?}, b = {b:?}"),
        DyadEntry::RP { a, b, v, d, delta: None } => format!("RP, a = {a:?}, b = {b:?}, v = {v:?}, d = {d:?}"),
        DyadEntry::RP { a, b, v, delta: Some(delta), .. } => {
            format!("RP, a = {a:?}, b = {b:?}, v = {v:?}, delta = {delta:?}")
        }
        DyadEntry::PP { phi } => format!("PP, phi = {phi:?} rad"),
    }
}

fn inputs_as_given(robot: &Manipulator, inputs: &[f64], unit: AngleUnit) -> String {
    let value = |((leg, joint), &value): ((usize, usize), &f64)| match robot.legs[leg].joints[joint] {
        JointKind::Revolute => format!("{} {}", digits(unit.from_rad(value), SIDE_DIGITS), unit.name()),
        JointKind::Prismatic => digits(value, SIDE_DIGITS),
    };
    robot.actuated_joints().zip(inputs).map(value).collect::<Vec<_>>().join(", ")
}

pub(crate) fn table<T: Into<comfy_table::Cell> + Clone>(header: &[T]) -> Table {
    let mut table = Table::new();
    let style = TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));
    table.load_style(style).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_header(header.to_vec());
    table.column_iter_mut().for_each(|column| column.set_cell_alignment(CellAlignment::Right));
    table
}

pub(crate) fn heading(text: &mut String, title: &str) {
    line(text, format_args!("{STRONG}{title}{STRONG:#}"));
}

pub(crate) fn line(text: &mut String, content: std::fmt::Arguments) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{content}");
}

/// A number with so many significant digits, without needless zeros.
pub(crate) fn digits(value: f64, significant: i32) -> String {
    let magnitude = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    if !(-5..significant).contains(&magnitude) {
        return format!("{value:.*e}", usize::try_from(significant - 1).unwrap_or(0));
    }
    let decimals = usize::try_from(significant - 1 - magnitude.max(0)).unwrap_or(0);
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

pub(crate) fn complex(value: Complex64) -> String {
    let sign = if value.im < 0.0 { '-' } else { '+' };
    format!("{} {sign} {}i", digits(value.re, POSE_DIGITS), digits(value.im.abs(), POSE_DIGITS))
}
