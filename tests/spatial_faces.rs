//! `hana` and `tripod` on the command line.
#![cfg(feature = "cli")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn model(name: &str) -> String {
    format!("{}/examples/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_assur")).args(arguments).output().expect("the program starts")
}

fn json(arguments: &[&str]) -> serde_json::Value {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one JSON document")
}

fn text(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// The one line of an error.
fn refused(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(1), "{arguments:?}");
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).expect("text")
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder for files");
    folder
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn hana_answers() {
    let file = model("hana.toml");
    let forward = json(&["hana", "forward", &file, "--inputs=1,-0.5,0.3", "--json"]);
    assert_eq!(
        (forward["schema"].as_str(), forward["account"]["degree"].as_u64()),
        (Some("assur/hana-forward/1"), Some(8))
    );
    assert_eq!(forward["modes"].as_array().expect("modes").len(), 4);
    let inverse = json(&["hana", "inverse", &file, "--pose=-2,-12,0", "--json"]);
    assert_eq!(inverse["modes"].as_array().expect("modes").len(), 8);
    assert_eq!(inverse["mixed_singularities"]["reached"], "nowhere");
    let velocity = json(&["hana", "velocity", &file, "--pose=-2,-12,0", "--rates=1,0,0", "--json"]);
    assert_eq!(velocity["singularity"], "none");
    assert!(velocity["rates"]["inputs_if_pose"].is_array());
    let area = |kind: &str| number(&json(&["hana", "workspace", &file, kind, "--json"])["area"]);
    assert!((area("constant") - 43.453_702_705_955_34).abs() < 1e-9);
    assert!((area("reachable") - 44.244_825_742_417_67).abs() < 1e-9);
    let capability = json(&["hana", "capability", &file, "--at=-2,-12", "--strokes=3,4", "--json"]);
    assert!((number(&capability["zeta"]).to_degrees() - 89.649_985_652).abs() < 1e-6);
    assert_eq!(capability["against_strokes"].as_array().expect("a curve").len(), 2);
    for arguments in [
        vec!["hana", "forward", &file, "--inputs=1,-0.5,0.3"],
        vec!["hana", "inverse", &file, "--pose=-2,-12,0"],
        vec!["hana", "velocity", &file, "--pose=-2,-12,90", "--rates=1,0,0", "--accelerations=0,0,1"],
        vec!["hana", "workspace", &file, "reachable"],
        vec!["hana", "capability", &file, "--at=-2,-12", "--strokes=3,4"],
    ] {
        let shown = text(&arguments);
        assert!(shown.starts_with("HANA with r = 3") && !shown.contains("NaN"), "{shown}");
    }
    let picture = folder("hana").join("map.svg");
    let picture = picture.to_str().expect("plain");
    text(&["hana", "capability", &file, "--cells=20", "--svg", picture]);
    assert!(std::fs::read_to_string(picture).expect("is written").contains("</svg>"));
}

#[test]
fn tripod_answers() {
    let file = model("tripod-cartesian.toml");
    let inverse = json(&["tripod", "inverse", &file, "--pose=200,260,240,10,5,-3", "--json"]);
    let inputs: Vec<String> = inverse["inputs"].as_array().expect("six").iter().map(ToString::to_string).collect();
    let inputs = format!("--inputs={}", inputs.join(","));
    let forward = json(&["tripod", "forward", &file, &inputs, "--json"]);
    assert_eq!(forward["account"]["rejected"], 4);
    let rotation = &inverse["pose"]["rotation"];
    let same = |mode: &serde_json::Value| {
        (0..9).all(|k| (number(&mode["pose"]["rotation"][k / 3][k % 3]) - number(&rotation[k / 3][k % 3])).abs() < 1e-9)
    };
    assert!(forward["modes"].as_array().expect("modes").iter().any(same));
    let velocity = json(&["tripod", "velocity", &file, "--pose=200,260,240,10,5,-3", "--rates=1,0,0,0,0,0", "--json"]);
    assert_eq!(
        (velocity["singularity"].as_str(), velocity["jacobian"].as_array().map(Vec::len)),
        (Some("none"), Some(6))
    );
    let at = "--at=163.39745962155612,163.39745962155612,163.39745962155612";
    let tilt = json(&["tripod", "tilt", &file, at, "--json"]);
    assert!((number(&tilt["tilt"]).to_degrees() - 25.761_932_975_859_754).abs() < 1e-6);
    assert!(number(&tilt["tilt"]) - number(&tilt["proved_at_least"]) < 1.1e-3);
    let picture = folder("tripod").join("tilt.svg");
    let picture = picture.to_str().expect("plain");
    let map = ["tripod", "tilt", &file, "--low=0,0,0", "--high=400,400,400", "--cells=6", "--svg", picture];
    assert!(text(&map).contains("of 36"));
    assert!(std::fs::read_to_string(picture).expect("is written").contains("</svg>"));
    for arguments in [
        vec!["tripod", "inverse", &file, "--pose=200,260,240,50,5,-3"],
        vec!["tripod", "forward", &file, &inputs],
        vec![
            "tripod",
            "velocity",
            &file,
            "--pose=200,260,240,10,5,-3",
            "--rates=1,0,0,0,0,0",
            "--accelerations=1,0,0,0,0,0",
        ],
        vec!["tripod", "tilt", &file, at],
    ] {
        let shown = text(&arguments);
        assert!(shown.starts_with("three-legged robot") && !shown.contains("NaN"), "{shown}");
    }
}

#[test]
fn bad_questions_are_refused_by_name() {
    let (hana, tripod) = (model("hana.toml"), model("tripod-cartesian.toml"));
    let with = |file: &str, name: &str, from: &str, to: &str| {
        let path = folder("bad-spatial").join(name);
        std::fs::write(&path, std::fs::read_to_string(file).expect("a model").replacen(from, to, 1))
            .expect("is written");
        path.to_str().expect("plain").to_owned()
    };
    for (name, from, to, message) in [
        ("zero.toml", "L = 15.0", "L = 0", "L: 0 must be > 0"),
        (
            "stroke.toml",
            "[-3.0, 3.0]",
            "[3.0, -3.0]",
            "strokes, leg 1: [3, -3] must run from the lower to the higher end",
        ),
        ("missing.toml", "L3 = 15.0", "", "L3: missing; must be a length"),
        ("three.toml", "[-3.0, 3.0]", "[1, 2, 3]", "strokes:"),
    ] {
        let said = refused(&["hana", "forward", &with(&hana, name, from, to), "--inputs=0,0,0"]);
        assert!(said.contains(message) && said.contains(name), "{said}");
    }
    assert!(refused(&["hana", "forward", &hana, "--inputs=0,0"]).contains("inputs: 2 given, must be 3"));
    assert!(
        refused(&["hana", "velocity", &hana, "--pose=20,0,0"]).contains("leg 1: does not reach the pose, it misses by")
    );
    assert!(refused(&["hana", "forward", &tripod, "--inputs=0,0,0"]).contains("`assur tripod`"));
    assert!(refused(&["forward", &hana, "--inputs=0,0,0"]).contains("`assur hana`"));
    assert!(refused(&["hana", "capability", &hana, "--at=0,-12", "--mode=+-+"]).contains("same side"));
    for (name, from, to, message) in [
        ("parallel.toml", "w = [0.0, 0.0, 1.0]", "w = [1.0, 0.0, 0.0]", "leg 1: the base axis w must be square"),
        ("rail.toml", "Db = [0.0, 720.0, 0.0]", "Db = [0.0, 600.0, 0.0]", "leg 1: the rails coincide"),
        ("length.toml", "v = [0.0, 1.0, 0.0]", "v = [0.0, 0.0, 0.0]", "leg 1: v has no length"),
        ("reversed.toml", "[0.0, 500.0]", "[500.0, 0.0]", "strokes, slider 1: [500, 0] must run"),
    ] {
        let said = refused(&["tripod", "forward", &with(&tripod, name, from, to), "--inputs=0,0,0,0,0,0"]);
        assert!(said.contains(message) && said.contains(name), "{said}");
    }
    let along = with(&tripod, "along.toml", "v = [0.0, 1.0, 0.0]", "v = [1.0, 0.0, 0.0]");
    assert!(refused(&["tripod", "inverse", &along, "--pose=0,0,0,0,0,0"]).contains("parallel to the rails"));
    assert!(refused(&["tripod", "inverse", &tripod, "--pose=0,0"]).contains("pose: 2 given, must be 6"));
}

/// The picture that a command draws into a folder.
fn drawn(arguments: &[&str], folder: &Path, name: &str) -> String {
    let picture = folder.join(name);
    let picture = picture.to_str().expect("plain");
    text(&[arguments, &["--svg", picture]].concat());
    let svg = std::fs::read_to_string(picture).expect("is written");
    assert!(svg.contains("</svg>") && !svg.contains("NaN") && !svg.contains("inf"), "{name}");
    svg
}

#[test]
fn robots_are_drawn_and_checked_and_determinants_are_curves() {
    let (hana, tripod) = (model("hana.toml"), model("tripod-cartesian.toml"));
    let folder = folder("robots");
    let drawn = |arguments: &[&str], name: &str| drawn(arguments, &folder, name);
    let modes = drawn(&["hana", "forward", &hana, "--inputs=1,-0.5,0.3"], "modes.svg");
    assert_eq!(modes.matches(", phi = ").count(), 4);
    drawn(&["hana", "inverse", &hana, "--pose=-2,-12,0.4"], "ways.svg");
    drawn(&["tripod", "inverse", &tripod, "--pose=200,260,240,10,5,-3"], "pose.svg");
    let inputs = "--inputs=240,254,188,164,92,47";
    assert_eq!(drawn(&["tripod", "forward", &tripod, inputs], "tripod.svg").matches("mode ").count(), 4);
    drawn(&["hana", "workspace", &hana, "reachable", "--mode=+-+", "--from=-180", "--to=180"], "opposite.svg");
    let exact = json(&["tripod", "forward", &tripod, inputs, "--certify", "--json"]);
    assert_eq!((exact["modes"][0]["proof"].as_str(), exact["account"]["rejected"].as_u64()), (Some("proven"), Some(4)));
    let table = folder.join("determinant.csv");
    let table = table.to_str().expect("plain");
    drawn(&["tripod", "determinant", "inclined", "--points=91", "--csv", table], "determinant.svg");
    assert!(drawn(&["tripod", "determinant", "inclined", "--over-angle"], "angle.svg").contains("angle between two"));
    assert!(drawn(&["hana", "capability", &hana, "--strokes=1,2,3,4"], "curve.svg").contains("half length"));
    let rows = std::fs::read_to_string(table).expect("is written");
    assert_eq!((rows.lines().count(), rows.lines().next()), (92, Some("elevation,between,det_J_1,det_J_2,det_J_3")));
    let curve = json(&["tripod", "determinant", "upright", "--pose=0,0,0,10,5,0", "--points=3", "--json"]);
    assert_eq!(curve["curves"][0]["points"].as_array().map(Vec::len), Some(3));
    assert!(refused(&["tripod", "determinant", "inclined", "--pose=1,2"]).contains("pose: 2 given, must be 6"));
    let check = json(&["check", &hana, "--json"]);
    assert_eq!((check["family"].as_str(), check["numbers"]["r"].as_str()), (Some("HANA"), Some("3")));
    let check = json(&["check", &tripod, "--json"]);
    assert_eq!(check["remarks"][0]["name"], "cartesian");
    assert!(text(&["check", &hana]).contains("degree bound  8"));
}

#[test]
fn multipterons_from_files() {
    let folder = folder("multipterons");
    for (file, pose, count) in [
        ("tripteron.toml", "--pose=1,2,3", 1),
        ("quadrupteron.toml", "--pose=0.2,-0.1,0.4,0,0,30", 2),
        ("hexapteron.toml", "--pose=20,-10,30,5,0,10", 8),
    ] {
        let file = model(file);
        let inverse = json(&["multipteron", "inverse", &file, pose, "--json"]);
        let inputs: Vec<String> =
            inverse["inputs"].as_array().expect("a list").iter().map(ToString::to_string).collect();
        let inputs = format!("--inputs={}", inputs.join(","));
        let forward = json(&["multipteron", "forward", &file, &inputs, "--json"]);
        let modes = forward["modes"].as_array().expect("modes");
        assert_eq!((modes.len(), forward["account"]["real"].as_u64()), (count, Some(count as u64)), "{file}");
        let place = |value: &serde_json::Value| [0, 1, 2].map(|k| number(&value[k]));
        let wanted = place(&inverse["position"]);
        assert!(
            modes
                .iter()
                .any(|mode| { place(&mode["pose"]["position"]).iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9) })
        );
        assert!(text(&["multipteron", "forward", &file, &inputs]).contains("degree"));
        let picture = drawn(&["multipteron", "forward", &file, &inputs], &folder, "modes.svg");
        assert_eq!(picture.matches("mode ").count(), count);
        assert!(drawn(&["multipteron", "inverse", &file, pose], &folder, "pose.svg").contains("stroke-dasharray"));
        assert_eq!(json(&["check", &file, "--json"])["degree_bound"].as_u64(), Some(count as u64));
    }
    let path = folder.join("five.toml");
    std::fs::write(&path, "schema = \"assur/multipteron/1\"\nkind = \"pentapteron\"\ndirections = []")
        .expect("is written");
    let path = path.to_str().expect("plain");
    assert!(refused(&["multipteron", "forward", path, "--inputs=1,2,3,4,5"]).contains("208 real solutions"));
    let tripteron = model("tripteron.toml");
    assert!(refused(&["multipteron", "inverse", &tripteron, "--pose=1,2,3,0.1,0,0"]).contains("cannot turn"));
    assert!(refused(&["multipteron", "forward", &tripteron, "--inputs=1,2"]).contains("inputs: 2 given, must be 3"));
}

#[test]
fn models_to_start_from_are_sound() {
    for (name, command) in [
        ("hana", "hana"),
        ("tripod", "tripod"),
        ("tripod-5dof", "tripod"),
        ("tripod-4dof", "tripod"),
        ("tripod-inclined", "tripod"),
        ("tripod-upright", "tripod"),
    ] {
        let path = folder("new-spatial").join(format!("{name}.toml"));
        let path = path.to_str().expect("plain");
        assert!(run(&["new", name, "--output", path]).status.success());
        let inputs = if name == "hana" { "--inputs=0,0,0" } else { "--inputs=0,0,0,0,0,0" };
        assert!(run(&[command, "forward", path, inputs]).status.success());
        assert!(run(&["check", path]).status.success());
    }
}

#[test]
fn variants_with_fewer_degrees_of_freedom() {
    let golden = std::fs::read_to_string(format!("{}/tests/golden/spatial.json", env!("CARGO_MANIFEST_DIR")));
    let golden: serde_json::Value = serde_json::from_str(&golden.expect("is there")).expect("is JSON");
    let list =
        |value: &serde_json::Value| -> Vec<f64> { value.as_array().expect("a list").iter().map(number).collect() };
    let joined = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let near = |a: &[f64], b: &[f64]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9 * b.abs().max(1.0))
    };

    let (five, case) = (model("tripod-5dof.toml"), &golden["tripod6"]["dof5"]);
    let pose = format!("--pose={}", joined(&list(&case["p"])));
    let direction = format!("--direction={}", joined(&list(&case["tool_dir"])));
    let found = json(&["tripod", "inverse", &five, &pose, &direction, "--json"]);
    let solutions = case["solutions"].as_array().expect("a list");
    assert_eq!(found["solutions"].as_array().map(Vec::len), Some(solutions.len()));
    for (k, solution) in solutions.iter().enumerate() {
        let way = &found["solutions"][k];
        assert!((number(&way["torsion"]) - number(&solution["s"])).abs() < 1e-9, "{way}");
        let rho = list(&solution["rho"]);
        assert!(near(&list(&way["inputs"]), &rho), "{way}");
        // Five numbers, and all six, lead back.
        let five_numbers = [0, 2, 3, 4, 5].map(|k| rho[k]);
        for inputs in [joined(&five_numbers), joined(&rho)] {
            let answer = json(&["tripod", "forward", &five, &format!("--inputs={inputs}"), "--json"]);
            let wanted: Vec<f64> = (0..3).flat_map(|i| list(&solution["R"][i])).collect();
            let modes = answer["modes"].as_array().expect("modes");
            let rotation =
                |mode: &serde_json::Value| (0..3).flat_map(|i| list(&mode["pose"]["rotation"][i])).collect::<Vec<_>>();
            assert!(modes.iter().any(|mode| near(&rotation(mode), &wanted)), "{answer}");
        }
    }
    assert!(text(&["tripod", "inverse", &five, &pose, &direction]).contains("as rho a"));
    assert_eq!(found["status"], "complete");
    // The tool's axis along leg 1's, a direction in leg 1's plane: torsion is free; out of it, nothing points there.
    let free = std::fs::read_to_string(&five)
        .expect("is there")
        .replace("tool_axis = [1.0, 1.0, 1.0]", "tool_axis = [0.0, 1.0, 0.0]");
    let file = folder("tripod").join("free.toml");
    std::fs::write(&file, free).expect("can be written");
    let free = file.to_str().expect("plain");
    let ask = |direction: &'static str| ["tripod", "inverse", free, "--pose=200,260,240", direction];
    let every = json(&[&ask("--direction=0,0.8,0.6")[..], &["--json"]].concat());
    assert_eq!((every["status"].as_str(), number(&every["solutions"][0]["torsion"])), (Some("every_torsion"), 0.0));
    assert!(text(&ask("--direction=0,0.8,0.6")).contains("every torsion points the tool there"));
    let none = json(&[&ask("--direction=0.6,0.8,0")[..], &["--json"]].concat());
    assert_eq!((none["status"].as_str(), none["solutions"].as_array().map(Vec::len)), (Some("complete"), Some(0)));
    assert!(text(&ask("--direction=0.6,0.8,0")).contains("no orientation points the tool there"));
    assert!(refused(&["tripod", "inverse", &five, "--pose=0,0,0,0,0,5"]).contains("leg 1: has one motor"));
    assert!(refused(&["tripod", "forward", &five, "--inputs=1,2,3,4,5,6"]).contains("leg 1: has one motor"));
    assert!(refused(&["tripod", "forward", &five, "--inputs=1,2,3,4"]).contains("inputs: 4 given, must be 5"));
    assert!(refused(&["tripod", "tilt", &five, "--at=160,160,160"]).contains("6 degrees of freedom; this one has 5"));

    let (four, case) = (model("tripod-4dof.toml"), &golden["tripod6"]["dof4"]);
    let turn = number(&case["rotation_about_y"]).to_degrees();
    let pose = format!("--pose={},0,{turn},0", joined(&list(&case["p"])));
    let rho = list(&case["rho"]);
    let inverse = json(&["tripod", "inverse", &four, &pose, "--json"]);
    assert!(
        near(&list(&inverse["inputs"]), &rho) && near(&list(&inverse["plane_angles"]), &list(&case["gamma"])),
        "{inverse}"
    );
    let inputs = format!("--inputs={}", joined(&[rho[0], rho[2], rho[4], rho[5]]));
    let answer = json(&["tripod", "forward", &four, &inputs, "--json"]);
    let places = answer["modes"].as_array().expect("modes").iter().map(|mode| list(&mode["pose"]["position"]));
    assert!(places.into_iter().any(|place| near(&place, &list(&case["p"]))), "{answer}");
    let moving = text(&["tripod", "velocity", &four, &pose, "--rates=1,2,3,4"]);
    assert!(
        moving.contains("platform rates for these of the sliders") && !moving.contains("sliders  none"),
        "{moving}"
    );
    assert!(
        text(&["tripod", "velocity", &four, &pose, "--rates=0,0,0,1,0,0"])
            .contains("the platform does not move so: leg")
    );
    let of_motors = json(&["tripod", "velocity", &four, &pose, "--rates=1,2,3,4", "--json"]);
    assert!(of_motors["rates"]["inputs_if_pose"].is_null(), "{of_motors}");
    assert_eq!(list(&of_motors["rates"]["pose_if_inputs"]).len(), 6, "{of_motors}");
    let parted = json(&["tripod", "velocity", &four, &pose, "--rates=0,1,0,0,0,0", "--json"]);
    assert!(
        parted["rates"]["pose_if_inputs"]["refused"].as_str().is_some_and(|why| why.starts_with("leg 1")),
        "{parted}"
    );
    let direction = ["tripod", "inverse", &four, "--pose=0,0,0", "--direction=1,1,1"];
    assert!(refused(&direction).contains("5 degrees of freedom; this one has 4"));
    for (name, freedom) in [("tripod-5dof.toml", 5), ("tripod-4dof.toml", 4)] {
        let check = json(&["check", &model(name), "--json"]);
        assert_eq!(check["degrees_of_freedom"].as_u64(), Some(freedom), "{check}");
    }
}
