//! `coupler` and `group`.

use std::path::Path;

use assur::exchange::{
    CouplerFile, CouplerReport, GroupReport, LinkageReport, is_linkage, parse_group, parse_linkage, read_problem,
};
use assur::linkage::{CouplerCurve, InputRange, Intersections, Linkage, LinkageAssemblies, Truss, TrussAssemblies};
use assur::nalgebra::Vector2;
use assur::num_complex::Complex64;

use crate::args::Shown;
use crate::output::{self, Failure, Files};
use crate::tables::{ALARM, POSE_DIGITS, SIDE_DIGITS, STRONG, complex, digits, heading, line, table};

pub(crate) fn group(file: &Path, inputs: &[f64], with_complex: bool, shown: &Shown) -> Result<(), Failure> {
    let text = read_problem(file)?;
    let name = file.display().to_string();
    if is_linkage(&text, &name) {
        return linkage(&parse_linkage(&text, &name)?, &name, inputs, shown);
    }
    if !inputs.is_empty() {
        return Err(Failure::About(name, "a group has no driven joints, so no --inputs".to_owned()));
    }
    let truss = parse_group(&text, &name)?;
    let answer = truss.assemble();
    let draw = || assur::plot::draw_truss(&truss, &answer);
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    output::print(&if shown.json {
        GroupReport::new(&truss, &answer, with_complex).to_json()
    } else {
        group_table(&truss, &answer, with_complex)
    })
}

fn linkage(linkage: &Linkage, file: &str, inputs: &[f64], shown: &Shown) -> Result<(), Failure> {
    let answer = linkage.assemble(inputs).map_err(|error| Failure::About(file.to_owned(), error.to_string()))?;
    let draw = || assur::plot::draw_linkage(linkage, &answer);
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    output::print(&if shown.json {
        LinkageReport::new(inputs, &answer).to_json()
    } else {
        linkage_table(linkage, &answer)
    })
}

fn linkage_table(linkage: &Linkage, answer: &LinkageAssemblies) -> String {
    let mut text = String::new();
    heading(&mut text, "Linkage");
    for (number, group) in (1..).zip(&answer.groups) {
        let links = group.links.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        line(&mut text, format_args!("group {number}  {}, links {links}", group.name));
    }
    // The tree, indented: each assembly of a group under the one it stands on.
    fn branch(text: &mut String, answer: &LinkageAssemblies, parent: Option<usize>, depth: usize) {
        for (place, node) in answer.nodes.iter().enumerate().filter(|(_, node)| node.parent == parent) {
            let note = match node.status {
                assur::Status::Complete => "",
                assur::Status::SelfMotion => ", and the group moves",
                assur::Status::Undecided => ", and its list may be short",
            };
            let indent = "  ".repeat(depth);
            let end = if node.group + 1 == answer.groups.len() { "" } else { ":" };
            line(text, format_args!("{indent}group {}, assembly {}{note}{end}", node.group + 1, node.number));
            branch(text, answer, Some(place), depth + 1);
        }
    }
    branch(&mut text, answer, None, 0);
    if let Some(first) = answer.assemblies.first() {
        let mut header = vec!["assembly".to_owned()];
        header.extend((0..first.poses.len()).map(|link| format!("link {link}")));
        let sliders: Vec<usize> =
            (0..linkage.joints().len()).filter(|&joint| linkage.joints()[joint].letter() == 'P').collect();
        header.extend(sliders.iter().map(|joint| format!("slide {joint}")));
        let mut table = table(&header);
        for assembly in &answer.assemblies {
            let choice = assembly.choice.iter().map(ToString::to_string).collect::<Vec<_>>().join("-");
            let turns = assembly.poses.iter().map(|pose| pose[2]);
            let slides = sliders.iter().map(|&joint| assembly.displacements[joint]);
            let numbers = turns.chain(slides).map(|number| digits(number, SIDE_DIGITS));
            table.add_row(std::iter::once(choice).chain(numbers));
        }
        let slides = if sliders.is_empty() { "" } else { ", and displacements of the sliding joints" };
        line(&mut text, format_args!("rotations from the reference assembly, in radians{slides}\n{table}"));
    }
    let worst = answer.assemblies.iter().map(|assembly| assembly.residual).fold(0.0, f64::max);
    let count = answer.assemblies.len();
    let ends = match answer.dead_ends {
        0 => String::new(),
        1 => "; one branch ends at a group without a real assembly".to_owned(),
        more => format!("; {more} branches end at a group without a real assembly"),
    };
    let count = match count {
        0 => "no assembly".to_owned(),
        1 => format!("1 assembly, residual {worst:.1e}"),
        more => format!("{more} assemblies, worst residual {worst:.1e}"),
    };
    line(&mut text, format_args!("{STRONG}{count}{STRONG:#}{ends}"));
    match answer.status {
        assur::Status::Complete => {}
        assur::Status::SelfMotion => {
            line(&mut text, format_args!("{ALARM}some group moves though the drivers are held{ALARM:#}"))
        }
        assur::Status::Undecided => line(&mut text, format_args!("{ALARM}some group's list may be short{ALARM:#}")),
    }
    text
}

fn group_table(truss: &Truss, answer: &TrussAssemblies, with_complex: bool) -> String {
    let mut text = String::new();
    let title = truss
        .catalogued()
        .map_or_else(|| format!("Group of {} links", truss.links()), |entry| format!("Baranov truss {}", entry.name()));
    heading(&mut text, &title);
    let links: Vec<usize> = (0..truss.links()).filter(|&link| link != truss.ground()).collect();
    line(&mut text, format_args!("{} links, ground {}; rotations in radians", truss.links(), truss.ground()));
    if answer.real().next().is_some() {
        let mut header = vec!["assembly".to_owned()];
        header.extend(links.iter().map(|link| format!("link {link}")));
        header.extend(["mult.".to_owned(), "residual".to_owned()]);
        let mut table = table(&header);
        for (number, assembly) in (1..).zip(answer.real()) {
            let mut row = vec![number.to_string()];
            row.extend(links.iter().map(|&link| digits(assembly.theta[link].arg(), POSE_DIGITS)));
            row.extend([assembly.multiplicity.to_string(), format!("{:.1e}", assembly.residual)]);
            table.add_row(row);
        }
        line(&mut text, format_args!("{table}"));
    }
    if with_complex {
        let mut header = vec!["theta = e^(i phi)".to_owned()];
        header.extend(links.iter().map(|link| format!("link {link}")));
        let mut table = table(&header);
        for assembly in answer.assemblies.iter().filter(|assembly| !assembly.real) {
            let mut row = vec![String::new()];
            row.extend(links.iter().map(|&link| complex(assembly.theta[link] as Complex64)));
            table.add_row(row);
        }
        line(&mut text, format_args!("\nnon-real solutions\n{table}"));
    }
    for link in &answer.loose_links {
        line(&mut text, format_args!("note: link {link} has all its joints in one point and turns freely"));
    }
    if !answer.curves.is_empty() {
        line(&mut text, format_args!("{ALARM}a whole curve of assemblies: the group moves{ALARM:#}"));
    }
    let found = format!("{} real, {} in all", answer.real().count(), answer.count());
    let of = match (answer.expected, answer.missing) {
        (Some(expected), Some(0)) => format!(", complete (of {expected})"),
        (Some(expected), Some(missing)) => {
            format!(", {missing} of {expected} not found: special dimensions have fewer, or they were missed")
        }
        _ => "; how many there are is not known".to_owned(),
    };
    line(&mut text, format_args!("{STRONG}{found}{of}{STRONG:#}"));
    text
}

pub(crate) fn coupler(file: &Path, with_complex: bool, shown: &Shown) -> Result<(), Failure> {
    let text = read_problem(file)?;
    let CouplerFile { curve, with } = CouplerFile::parse(&text, &file.display().to_string())?;
    let found = with.as_ref().and_then(|partner| curve.meet(partner));
    let draw = || assur::plot::draw_coupler(&curve, with.as_ref(), found.as_ref());
    Files::default().with_pictures(shown.svg.as_deref(), shown.png.as_deref(), draw)?.write()?;
    output::print(&if shown.json {
        CouplerReport::new(&curve, found.as_ref()).to_json()
    } else {
        coupler_table(&curve, found.as_ref(), with_complex)
    })
}

fn coupler_table(curve: &CouplerCurve, found: Option<&Intersections>, with_complex: bool) -> String {
    let mut text = String::new();
    heading(&mut text, "Coupler curve");
    let point = |p: Vector2<f64>| format!("({}, {})", digits(p.x, SIDE_DIGITS), digits(p.y, SIDE_DIGITS));
    if let Some(class) = curve.grashof() {
        line(&mut text, format_args!("class  {}", class.name()));
    }
    if let Some(foci) = curve.foci() {
        line(&mut text, format_args!("foci  {}", foci.map(point).join("  ")));
    }
    match curve.double_points() {
        None => {
            line(&mut text, format_args!("every point of the curve is double: a guided point, or a linkage that folds"))
        }
        Some(points) => {
            for double in &points {
                let place = double.point().map_or_else(|| complex(double.z), point);
                line(&mut text, format_args!("{}  {place}", double.kind.name()));
            }
        }
    }
    for (number, circuit) in (1..).zip(curve.circuits()) {
        let range = match circuit.input {
            InputRange::Full => "a full turn of the input".to_owned(),
            InputRange::Between { mid, half } => {
                let [from, to] = [mid - half, mid + half].map(|angle| digits(angle, POSE_DIGITS));
                format!("input from {from} to {to} rad and back")
            }
        };
        let touches = if circuit.touches { ", meets another where the linkage folds flat" } else { "" };
        line(&mut text, format_args!("circuit {number}  {range}{touches}"));
    }
    let Some(found) = found else { return text };
    let mut table = table(&["intersection", "x", "y", "phi (rad)", "mult.", "residual"]);
    for (number, meeting) in (1..).zip(found.list.iter().filter(|meeting| meeting.real)) {
        let turns: Vec<String> = meeting.thetas.iter().map(|theta| digits(theta.arg(), SIDE_DIGITS)).collect();
        let row = [digits(meeting.z.re, POSE_DIGITS), digits(meeting.z.im, POSE_DIGITS), turns.join("  ")];
        let rest = [meeting.multiplicity.to_string(), format!("{:.1e}", meeting.residual)];
        table.add_row(std::iter::once(number.to_string()).chain(row).chain(rest));
    }
    if found.account.real > 0 {
        line(&mut text, format_args!("{table}"));
    }
    if with_complex {
        let mut table = crate::tables::table(&["z = x + iy", "w = x - iy", "theta = e^(i phi)"]);
        for meeting in found.list.iter().filter(|meeting| !meeting.real) {
            let turns: Vec<String> = meeting.thetas.iter().map(|&theta| complex(theta)).collect();
            table.add_row([complex(meeting.z), complex(meeting.w), turns.join("\n")]);
        }
        line(&mut text, format_args!("\nnon-real intersections\n{table}"));
    }
    let account = &found.account;
    let parts = [
        (account.real, "real"),
        (account.complex, "complex"),
        (account.at_infinity, "at infinity"),
        (account.undecided, "not found"),
    ];
    let parts: Vec<String> = parts.iter().filter(|(n, _)| *n > 0).map(|(n, name)| format!("{n} {name}")).collect();
    let summary =
        if account.self_motion > 0 { "the curves have a piece in common".to_owned() } else { parts.join(", ") };
    line(&mut text, format_args!("{STRONG}{summary} (of {}){STRONG:#}", account.degree));
    text
}
