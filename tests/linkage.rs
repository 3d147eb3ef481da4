//! Whole linkages with turning and sliding joints: planted drawings, random chains, what must not change anything, bad input; and the
//! commands `group` and `coupler` as programs.

mod random;

use assur::Status;
use assur::linkage::{Linkage, LinkageAssemblies, LinkageAssembly, LinkageJoint, LinkageJointKind};
use assur::nalgebra::{Isometry2, Point2, Vector2};
use random::Random;

fn scale() -> usize {
    std::env::var("ASSUR_TEST_SCALE").ok().and_then(|text| text.parse().ok()).unwrap_or(1)
}

fn point(random: &mut Random) -> Vector2<f64> {
    Vector2::new(random.between(-5.0, 5.0), random.between(-5.0, 5.0))
}

/// A joint of either kind at a random place.
fn joint(links: [usize; 2], slides: bool, random: &mut Random) -> LinkageJoint {
    let at = point(random);
    if slides { LinkageJoint::prismatic(links, at, point(random)) } else { LinkageJoint::revolute(links, at) }
}

/// Largest gap at the joints, measured here: pivots apart, sliders beside their axis or slanted against it.
fn gap(linkage: &Linkage, assembly: &LinkageAssembly) -> f64 {
    let frame = |link: usize| {
        let [x, y, phi] = assembly.poses[link];
        Isometry2::new(Vector2::new(x, y), phi)
    };
    let of_joint = |joint: &LinkageJoint| {
        let [a, b] = joint.links.map(|link| frame(link) * Point2::from(joint.at));
        match joint.kind {
            LinkageJointKind::Revolute => (a - b).norm(),
            LinkageJointKind::Prismatic { direction } => {
                let [u, v] = joint.links.map(|link| frame(link).rotation * direction.normalize());
                u.perp(&(b - a)).abs().max((u - v).norm() * 10.0)
            }
        }
    };
    linkage.joints().iter().map(of_joint).fold(0.0, f64::max)
}

fn farthest(assembly: &LinkageAssembly) -> f64 {
    assembly.poses.iter().flat_map(|[x, y, _]| [x.abs(), y.abs()]).fold(10.0, f64::max)
}

/// How far an assembly is from the drawing.
fn from_drawing(assembly: &LinkageAssembly) -> f64 {
    assembly.poses.iter().flatten().map(|x| x.abs()).fold(0.0, f64::max)
}

fn turn_apart(a: f64, b: f64) -> f64 {
    let difference = (a - b).rem_euclid(std::f64::consts::TAU);
    difference.min(std::f64::consts::TAU - difference)
}

/// How far two assemblies' joints are apart; lengths of the second divided by `scale`.
fn apart(linkage: &Linkage, a: &[f64], b: &[f64], scale: f64) -> f64 {
    let of_joint = |(joint, (x, y)): (&LinkageJoint, (&f64, &f64))| match joint.kind {
        LinkageJointKind::Revolute => turn_apart(*x, *y),
        LinkageJointKind::Prismatic { .. } => (x - y / scale).abs() / x.abs().max(10.0),
    };
    linkage.joints().iter().zip(a.iter().zip(b)).map(of_joint).fold(0.0, f64::max)
}

/// A random linkage: drivers, dyads, triads and groups of class IV on what is there already, kinds of joints by chance.
struct Builder {
    links: usize,
    joints: Vec<LinkageJoint>,
}

impl Builder {
    fn old(&self, random: &mut Random) -> usize {
        (random.between(0.0, self.links as f64) as usize).min(self.links - 1)
    }

    fn drive(&mut self, slides: bool, random: &mut Random) {
        let old = self.old(random);
        self.joints.push(joint([old, self.links], slides, random).driven());
        self.links += 1;
    }

    /// Joints of a group: ends below `new` are links of it, others any old link.
    fn add(&mut self, new: usize, edges: &[[usize; 2]], slides: &[bool], random: &mut Random) {
        let start = self.links;
        for (edge, &slides) in edges.iter().zip(slides) {
            let links = edge.map(|end| if end < new { start + end } else { self.old(random) });
            self.joints.push(joint(links, slides, random));
        }
        self.links += new;
    }
}

const DYAD: [[usize; 2]; 3] = [[9, 0], [0, 1], [1, 9]];
/// Platform 3 on limbs 0, 1, 2.
const TRIAD: [[usize; 2]; 6] = [[9, 0], [0, 3], [9, 1], [1, 3], [9, 2], [2, 3]];
/// What is known, 2 and 3 are limbs between 0 and 1.
const CLASS_IV: [[usize; 2]; 6] = [[9, 0], [9, 1], [0, 2], [2, 1], [0, 3], [3, 1]];

fn chance(random: &mut Random, of: f64) -> bool {
    random.between(0.0, 1.0) < of
}

/// Random linkages until there are `count` that can be taken apart: sliders by chance close loops of their own.
fn linkages(count: usize, seed: u64) -> Vec<Linkage> {
    let mut random = Random::new(seed);
    let mut found = Vec::new();
    while found.len() < count {
        let mut builder = Builder { links: 1, joints: Vec::new() };
        let sliding = random.between(0.0, 0.6);
        for _ in 0..1 + usize::from(chance(&mut random, 0.5)) {
            let slides = chance(&mut random, 0.4);
            builder.drive(slides, &mut random);
        }
        for _ in 0..1 + usize::from(chance(&mut random, 0.5)) {
            let kinds: Vec<bool> = (0..6).map(|_| chance(&mut random, sliding)).collect();
            match random.between(0.0, 4.0) as usize {
                0 | 1 => builder.add(2, &DYAD, &kinds[..3], &mut random),
                2 => builder.add(4, &TRIAD, &kinds, &mut random),
                _ => builder.add(4, &CLASS_IV, &kinds, &mut random),
            }
            if chance(&mut random, 0.3) {
                let slides = chance(&mut random, 0.4);
                builder.drive(slides, &mut random);
            }
        }
        found.extend(Linkage::new(builder.links, 0, &builder.joints).ok());
    }
    found
}

fn solved(linkage: &Linkage, inputs: &[f64]) -> LinkageAssemblies {
    let found = linkage.assemble(inputs).unwrap_or_else(|error| panic!("{error}: {linkage:?}"));
    assert_eq!(found.status, Status::Complete, "{linkage:?}");
    for assembly in &found.assemblies {
        let miss = gap(linkage, assembly) / farthest(assembly);
        assert!(miss < 1e-9, "a gap of {miss:e}: {linkage:?} {assembly:?}");
        let driven = linkage.joints().iter().zip(&assembly.displacements).filter(|(joint, _)| joint.driven);
        for ((joint, &found), &given) in driven.zip(inputs) {
            let off = if joint.letter() == 'R' { turn_apart(found, given) } else { (found - given).abs() / 10.0 };
            assert!(off < 1e-9, "driven to {given}, found {found}: {linkage:?}");
        }
    }
    found
}

#[test]
fn random_linkages_hold_their_drawing_and_close_when_driven() {
    let (mut names, mut driven, mut worst) = (std::collections::BTreeMap::new(), 0, 0.0f64);
    let mut random = Random::new(77);
    for linkage in linkages(300 * scale(), 6) {
        let still = solved(&linkage, &vec![0.0; linkage.inputs()]);
        still.groups.iter().for_each(|group| *names.entry(group.name.clone()).or_insert(0) += 1);
        let nearest = still.assemblies.iter().map(from_drawing).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-5, "the drawing is missed by {nearest:e}: {linkage:?}");
        worst = worst.max(nearest);
        let inputs: Vec<f64> = (0..linkage.inputs()).map(|_| random.between(-0.4, 0.4)).collect();
        driven += solved(&linkage, &inputs).assemblies.len();
    }
    println!("drawings found to {worst:e}; {driven} driven assemblies; {names:?}");
    assert!(driven > 300 && names.len() > 25, "{driven} {names:?}");
    for dyad in ["RRR", "RRP", "RPR", "PRP", "RPP"] {
        assert!(names.contains_key(&format!("dyad {dyad}")), "{names:?}");
    }
}

#[test]
fn new_numbers_of_links_and_joints_change_nothing() {
    for linkage in linkages(40 * scale(), 7) {
        let inputs = vec![0.1; linkage.inputs()];
        let plain = solved(&linkage, &inputs);
        let links = linkage.links();
        let renumbered =
            |joint: &LinkageJoint| LinkageJoint { links: joint.links.map(|link| links - 1 - link), ..*joint };
        let joints: Vec<LinkageJoint> = linkage.joints().iter().rev().map(renumbered).collect();
        let other = Linkage::new(links, links - 1, &joints).expect("the same linkage");
        let found = solved(&other, &inputs);
        let other: Vec<Vec<f64>> =
            found.assemblies.iter().map(|a| a.displacements.iter().rev().copied().collect()).collect();
        same_assemblies(&linkage, &plain, &other, 1.0);
    }
}

fn same_assemblies(linkage: &Linkage, plain: &LinkageAssemblies, other: &[Vec<f64>], scale: f64) {
    assert_eq!(plain.assemblies.len(), other.len(), "{linkage:?}");
    for assembly in &plain.assemblies {
        let near = other.iter().map(|other| apart(linkage, &assembly.displacements, other, scale));
        let nearest = near.fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{nearest:e}: {linkage:?}");
    }
}

#[test]
fn a_moved_and_enlarged_drawing_has_the_same_assemblies() {
    let frame = Isometry2::new(Vector2::new(30.0, -12.0), 0.7);
    for linkage in linkages(40 * scale(), 8) {
        let plain = solved(&linkage, &vec![0.1; linkage.inputs()]);
        for factor in [1.0, 1024.0] {
            let moved = |joint: &LinkageJoint| LinkageJoint {
                at: (frame * Point2::from(joint.at)).coords * factor,
                kind: match joint.kind {
                    LinkageJointKind::Revolute => LinkageJointKind::Revolute,
                    LinkageJointKind::Prismatic { direction } => {
                        LinkageJointKind::Prismatic { direction: frame.rotation * direction }
                    }
                },
                ..*joint
            };
            let joints: Vec<LinkageJoint> = linkage.joints().iter().map(moved).collect();
            let other = Linkage::new(linkage.links(), 0, &joints).expect("the same linkage");
            let driven = linkage.joints().iter().filter(|joint| joint.driven);
            let inputs: Vec<f64> = driven.map(|joint| if joint.letter() == 'P' { 0.1 * factor } else { 0.1 }).collect();
            let found = other.assemble(&inputs).expect("the same inputs");
            let other: Vec<Vec<f64>> = found.assemblies.into_iter().map(|a| a.displacements).collect();
            same_assemblies(&linkage, &plain, &other, factor);
        }
    }
}

/// Every dyad with its sliders in every place, on every one of its three links as the ground.
#[test]
fn every_dyad_in_every_position() {
    let mut random = Random::new(3);
    for kinds in 0..7u32 {
        for _ in 0..10 * scale() {
            // Link 1 is driven, so that the outer joints are on two known links.
            let slides = [0, 1, 2].map(|k| kinds >> k & 1 == 1);
            let mut builder = Builder { links: 1, joints: Vec::new() };
            builder.drive(false, &mut random);
            for (links, slides) in [[0, 2], [2, 3], [3, 1]].into_iter().zip(slides) {
                builder.joints.push(joint(links, slides, &mut random));
            }
            let linkage = Linkage::new(4, 0, &builder.joints).expect("a dyad");
            let found = solved(&linkage, &[0.0]);
            let most = if slides.iter().filter(|slides| **slides).count() == 2 { 1 } else { 2 };
            assert!((1..=most).contains(&found.assemblies.len()), "{found:?}");
            assert!(found.assemblies.iter().any(|a| from_drawing(a) < 1e-6), "{found:?}");
        }
    }
}

#[test]
fn a_pivot_shared_by_three_links_is_one_however_it_is_written() {
    let at = [[0.0, 0.0], [1.0, 1.0], [4.0, 3.0], [5.0, 0.0], [7.0, 2.0], [8.0, -1.0]].map(Vector2::from);
    let start = [
        LinkageJoint::revolute([0, 1], at[0]).driven(),
        LinkageJoint::revolute([1, 2], at[1]),
        LinkageJoint::revolute([3, 0], at[3]),
        LinkageJoint::revolute([4, 5], at[4]),
        LinkageJoint::revolute([5, 0], at[5]),
    ];
    // Links 2, 3 and 4 share a pivot; pairs may be taken in three ways.
    let mut counts = Vec::new();
    for pairs in [[[2, 3], [3, 4]], [[2, 4], [4, 3]], [[4, 2], [2, 3]]] {
        let joints: Vec<LinkageJoint> =
            start.iter().copied().chain(pairs.map(|links| LinkageJoint::revolute(links, at[2]))).collect();
        let linkage = Linkage::new(6, 0, &joints).expect("two dyads");
        let found = solved(&linkage, &[0.05]);
        assert_eq!(found.groups.iter().map(|group| group.name.as_str()).collect::<Vec<_>>(), ["dyad RRR"; 2]);
        counts.push(found.assemblies.len());
    }
    assert_eq!(counts, [4; 3]);
}

/// A Whitworth quick-return: crank pin sliding in a swinging lever, which drives a ram.
fn shaper() -> Vec<LinkageJoint> {
    let v = |x, y| Vector2::new(x, y);
    vec![
        LinkageJoint::revolute([0, 1], v(0.0, 0.0)).driven(),
        LinkageJoint::revolute([1, 2], v(1.0, 0.5)),
        LinkageJoint::prismatic([2, 3], v(1.0, 0.5), v(1.0, 3.5)),
        LinkageJoint::revolute([3, 0], v(0.0, -3.0)),
        LinkageJoint::revolute([3, 4], v(1.5, 2.25)),
        LinkageJoint::revolute([4, 5], v(3.5, 3.0)),
        LinkageJoint::prismatic([5, 0], v(3.5, 3.0), v(1.0, 0.0)),
    ]
}

#[test]
fn a_shaper_returns_quickly() {
    let linkage = Linkage::new(6, 0, &shaper()).expect("mobility 1");
    let found = solved(&linkage, &[0.0]);
    assert_eq!(found.groups.iter().map(|group| group.name.as_str()).collect::<Vec<_>>(), ["dyad RPR", "dyad RRP"]);
    // The lever stands where the crank pin is, whichever half-turn it has made; both ways round for the ram.
    for angle in [0.3f64, 1.7, -2.0] {
        let (sine, cosine) = angle.sin_cos();
        let pin = Vector2::new(cosine - 0.5 * sine, sine + 0.5 * cosine);
        let lever = (pin - Vector2::new(0.0, -3.0)).normalize();
        let drawn = Vector2::new(1.0, 3.5).normalize();
        for assembly in &solved(&linkage, &[angle]).assemblies {
            let turn = assembly.poses[3][2];
            let now = Isometry2::rotation(turn).rotation * drawn;
            assert!(now.perp(&lever).abs() < 1e-12, "{now} {lever}");
        }
    }
}

#[test]
fn bad_linkages_are_refused_by_name() {
    let v = |x, y| Vector2::new(x, y);
    let refused = |links: usize, joints: &[LinkageJoint]| Linkage::new(links, 0, joints).unwrap_err().to_string();
    let with = |change: &dyn Fn(&mut Vec<LinkageJoint>)| {
        let mut joints = shaper();
        change(&mut joints);
        refused(6, &joints)
    };
    assert_eq!(with(&|j| j[1].links = [1, 9]), "joint 1: link 9 does not exist; there are 6, counted from 0");
    assert_eq!(with(&|j| j[1].links = [2, 2]), "joint 1 joins link 2 to itself");
    assert_eq!(with(&|j| j[4].at.y = f64::NAN), "joint 4: NaN must be finite");
    let still = LinkageJointKind::Prismatic { direction: v(0.0, 0.0) };
    assert_eq!(with(&|j| j[2].kind = still), "joint 2: direction must not be [0, 0]");
    let endless = LinkageJointKind::Prismatic { direction: v(0.0, f64::INFINITY) };
    assert_eq!(with(&|j| j[2].kind = endless), "joint 2: inf must be finite");
    assert_eq!(
        with(&|j| j.push(LinkageJoint::revolute([2, 1], v(1.0, 0.5)))),
        "joints 1 and 7 join the same links in one place"
    );
    assert_eq!(
        with(&|j| j[0].driven = false),
        "links 1, 2, 3, 4, 5: still movable with the drivers held, mobility 1; another driven joint is needed"
    );
    assert_eq!(
        with(&|j| j.push(LinkageJoint::revolute([5, 1], v(2.0, 2.0)))),
        "links 5: overdetermined with the drivers held, mobility -1"
    );
    assert_eq!(with(&|j| j[6] = j[6].driven()), "links 4: overdetermined with the drivers held, mobility -1");
    // A wedge: three sliders in a loop.
    let wedge = [
        LinkageJoint::prismatic([0, 1], v(0.0, 0.0), v(1.0, 0.0)).driven(),
        LinkageJoint::prismatic([1, 2], v(1.0, 1.0), v(1.0, 1.0)),
        LinkageJoint::prismatic([2, 0], v(2.0, 2.0), v(0.0, 1.0)),
    ];
    assert!(refused(3, &wedge).contains("sliders alone close a loop"));
    // Two links between crank and lever, three sliders: both have their orientation from either side.
    let mut random = Random::new(2);
    let mut steered = shaper()[..4].to_vec();
    steered.extend([[1, 4], [4, 5], [5, 3]].map(|links| joint(links, true, &mut random)));
    assert!(refused(6, &steered).starts_with("links 4, 5: sliders alone close a loop"), "{}", refused(6, &steered));
    // A seven-link group in which one joint slides.
    let edges = [[0, 4], [1, 4], [2, 5], [3, 5], [4, 5], [0, 6], [1, 6], [2, 6], [3, 6]];
    let large: Vec<LinkageJoint> =
        edges.iter().enumerate().map(|(k, &links)| joint(links, k == 4, &mut random)).collect();
    assert_eq!(
        refused(7, &large),
        "links 1, 2, 3, 4, 5, 6: they form one Assur group of 6 bodies with a slider, joint 4; sliders are covered in dyads and triads only"
    );
    // A triangle of links within a group is one link.
    let rigid = [[0, 1], [1, 2], [2, 3], [3, 1], [3, 0]].map(|links| joint(links, false, &mut random));
    assert!(refused(4, &rigid).contains("mobility"), "{}", refused(4, &rigid));
    let linkage = Linkage::new(6, 0, &shaper()).expect("sound");
    assert_eq!(
        linkage.assemble(&[0.1, 0.2]).unwrap_err().to_string(),
        "2 inputs given, 1 needed: one for each driven joint, in file order"
    );
    assert_eq!(linkage.assemble(&[f64::INFINITY]).unwrap_err().to_string(), "input 1: inf must be finite");
}

#[cfg(feature = "cli")]
mod programs {
    use std::path::PathBuf;
    use std::process::{Command, Output};

    use serde_json::Value;

    fn assur(arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_assur"))
            .args(arguments)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .expect("the program starts")
    }

    fn answered(arguments: &[&str]) -> Value {
        let output = assur(arguments);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).expect("one JSON document")
    }

    /// A file with this content, in a place of this test's own.
    fn file(name: &str, content: &str) -> PathBuf {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("linkage");
        std::fs::create_dir_all(&folder).expect("a folder of our own");
        let path = folder.join(name);
        std::fs::write(&path, content).expect("is written");
        path
    }

    #[test]
    fn group_reports_trusses_and_linkages() {
        let truss = answered(&["group", "examples/nine-link.json", "--json"]);
        assert_eq!(truss["schema"], "assur/group-report/1");
        assert_eq!((&truss["count"], &truss["truss"]), (&58.into(), &"9#26".into()));
        let real = truss["assemblies"].as_array().expect("a list").len();
        assert_eq!(real, 6);
        let all = answered(&["group", "examples/nine-link.json", "--json", "--complex"]);
        assert_eq!(all["assemblies"].as_array().expect("a list").len(), 58);
        for (name, inputs) in [("chain", "--inputs=0.1"), ("shaper", "--inputs=0.4")] {
            let linkage = answered(&["group", &format!("examples/{name}.json"), inputs, "--json"]);
            assert_eq!(linkage["schema"], "assur/linkage-report/1");
            assert_eq!(linkage["status"], "complete");
            let assemblies = linkage["assemblies"].as_array().expect("a list");
            assert_eq!(linkage["count"], assemblies.len());
            assert!(assemblies.iter().all(|a| a["residual"].as_f64().is_some_and(|r| r < 1e-9)));
            let table = assur(&["group", &format!("examples/{name}.json"), inputs]);
            let table = String::from_utf8(table.stdout).expect("text");
            assert!(table.contains(&format!("{} assemblies", assemblies.len())), "{table}");
        }
    }

    #[test]
    fn coupler_reports_curve_and_intersections() {
        let report = answered(&["coupler", "examples/coupler.json", "--json"]);
        assert_eq!(report["schema"], "assur/coupler-report/1");
        let coefficients = report["sextic"]["coefficients"].as_array().expect("rows");
        assert!(coefficients.len() == 4 && coefficients.iter().all(|row| row.as_array().is_some_and(|r| r.len() == 4)));
        for (list, count) in [("foci", 3), ("double_points", 3), ("intersections", 18)] {
            assert_eq!(report[list].as_array().map(Vec::len), Some(count), "{list}");
        }
        assert_eq!(report["account"]["degree"], 18);
        for meeting in report["intersections"].as_array().expect("a list") {
            assert_eq!(meeting["point"].is_null(), meeting["real"] == false);
            assert!(meeting["z"].is_array() && meeting["w"].is_array() && meeting["multiplicity"].is_u64());
            assert_eq!(meeting["thetas"].as_array().map(Vec::len), Some(2));
        }
        let bar = r#""fourbar":{"a":[0,0],"b":[4,0],"p":[-1,-1],"q":[2,-1],"r":1,"s":2.5}"#;
        for (name, partner, degree) in [
            ("line.json", r#"{"line":{"point":[0,1],"direction":[1,0.2]}}"#, 6),
            ("circle.json", r#"{"circle":{"center":[1,1],"radius":1.5}}"#, 6),
        ] {
            let path = file(name, &format!(r#"{{"schema":"assur/coupler/1",{bar},"with":{partner}}}"#));
            let report = answered(&["coupler", path.to_str().expect("plain"), "--json"]);
            let account = &report["account"];
            assert_eq!(account["degree"], degree);
            let sum: u64 = ["real", "complex", "at_infinity", "rejected", "self_motion", "undecided"]
                .iter()
                .map(|key| account[key].as_u64().expect("a count"))
                .sum();
            assert_eq!(sum, degree);
        }
    }

    #[test]
    fn pictures_are_written() {
        for (arguments, name) in [
            (&["group", "examples/seven-link.json"][..], "truss.svg"),
            (&["group", "examples/shaper.json", "--inputs=0.4"][..], "shaper.svg"),
            (&["coupler", "examples/coupler.json"][..], "coupler.svg"),
        ] {
            let path = file(name, "");
            let output = assur(&[arguments, &["--svg", path.to_str().expect("plain")]].concat());
            assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
            let picture = std::fs::read_to_string(path).expect("is written");
            assert!(picture.starts_with("<svg") && picture.trim_end().ends_with("</svg>") && !picture.contains("NaN"));
        }
    }

    #[test]
    fn bad_files_and_arguments_are_named() {
        let refused = |arguments: &[&str], code: i32, message: &str| {
            let output = assur(arguments);
            let error = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(code), "{error}");
            assert!(error.contains(message), "{error}");
            assert!(output.stdout.is_empty());
        };
        let bad = |name: &str, content: &str, command: &str, message: &str| {
            let path = file(name, content);
            refused(&[command, path.to_str().expect("plain")], 1, message);
        };
        refused(&["group"], 2, "Usage");
        refused(&["group", "examples/none.json"], 1, "none.json");
        refused(&["group", "examples/shaper.json"], 1, "0 inputs given, 1 needed");
        refused(&["group", "examples/seven-link.json", "--inputs=1"], 1, "no driven joints");
        refused(&["group", "examples/coupler.json"], 1, "is a file for `assur coupler`");
        bad("broken.json", "{", "group", "broken.json");
        bad(
            "edge.json",
            r#"{"schema":"assur/group/1","links":3,"edges":[[0,1],[1,2],[2,7]],"joint_xy":[[0,0],[1,1],[2,0]]}"#,
            "group",
            "joint 2: link 7 does not exist; there are 3, counted from 0",
        );
        bad(
            "slider.json",
            r#"{"schema":"assur/linkage/1","links":2,"joints":[{"type":"P","links":[0,1],"at":[0,0]}]}"#,
            "group",
            "joints[0].direction: missing; must be two numbers, since the joint slides",
        );
        bad(
            "turning.json",
            r#"{"schema":"assur/linkage/1","links":2,"joints":[{"type":"R","links":[0,1],"at":[0,0],"direction":[1,0]}]}"#,
            "group",
            "joints[0].direction: [1, 0] must be left out: only a joint of type P has one",
        );
        bad(
            "radius.json",
            r#"{"schema":"assur/coupler/1","fourbar":{"a":[0,0],"b":[4,0],"p":[-1,-1],"q":[2,-1],"r":-1,"s":2.5}}"#,
            "coupler",
            "radius",
        );
        bad("none.json", r#"{"schema":"assur/coupler/1"}"#, "coupler", "fourbar");
    }
}
