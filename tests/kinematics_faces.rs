//! `inverse`, `velocity`, `singularities` and `path` on the command line.
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

/// The one line of an error.
fn refused(arguments: &[&str], status: i32) -> String {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(status), "{arguments:?}");
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).expect("text")
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder for files");
    folder
}

#[test]
fn inverse_lists_working_modes() {
    let file = model("3-rpr.toml");
    let forward = json(&["forward", &file, "--inputs=14.98,15.38,12", "--json"]);
    let pose: Vec<String> =
        forward["modes"][2]["pose"].as_array().expect("a pose").iter().map(ToString::to_string).collect();
    let answer = json(&["inverse", &file, &format!("--pose={}", pose.join(",")), "--json"]);
    assert_eq!(answer["schema"], "assur/inverse/1");
    assert_eq!(answer["modes"].as_array().expect("modes").len(), 8);
    let stroke = answer["modes"][0]["joints"][0][1].as_f64().expect("a stroke");
    assert!((stroke - 14.98).abs() < 1e-12 && answer["modes"][0]["signs"] == "+++");
    let table = run(&["inverse", &file, "--pose=1,2,0.5"]);
    assert!(String::from_utf8_lossy(&table.stdout).contains("8 working modes"));
}

#[test]
fn velocity_names_the_singularity() {
    let file = model("3-rpr.toml");
    let answer =
        json(&["velocity", &file, "--pose=1,2,0.5", "--mode=+-+", "--rates=1,0,0", "--wrench=0,-1,0", "--json"]);
    assert_eq!((answer["schema"].as_str(), answer["singularity"].as_str()), (Some("assur/velocity/1"), Some("none")));
    assert!(answer["rates"]["inputs_if_pose"].is_array() && answer["wrench"]["actuator_forces"].is_array());
    // Leg 1 has its platform pivot in the origin: its strut has no length there.
    let answer = json(&["velocity", &file, "--pose=0,0,0.5", "--mode=+++", "--json"]);
    assert_eq!((&answer["singularity"], &answer["idle_legs"][0]), (&"type 1".into(), &1.into()));
}

#[test]
fn velocity_says_which_mode_it_takes() {
    let free = model("3-rrr.toml");
    let message = refused(&["velocity", &free, "--pose=5.5,4,17"], 1);
    assert!(
        message.contains("8 of the 8") && message.contains("+++, ++-, +-+") && message.contains("--mode"),
        "{message}"
    );
    let text = std::fs::read_to_string(model("3-rpr.toml")).expect("a model");
    let limited = text.replace("platform = ", "limits = [0.5, 60.0]\nplatform = ");
    let file = folder("choice").join("limited.toml");
    let without: String =
        text.lines().filter(|line| !line.starts_with("limits")).map(|line| line.to_owned() + "\n").collect();
    std::fs::write(
        &file,
        if text.contains("limits") {
            without.replace("platform = ", "limits = [0.5, 60.0]\nplatform = ")
        } else {
            limited
        },
    )
    .expect("a file");
    let file = file.to_str().expect("a path");
    let answer = json(&["velocity", file, "--pose=5.5,4,0.3", "--json"]);
    assert_eq!((&answer["signs"], &answer["mode_choice"]), (&"+++".into(), &"the only one within the limits".into()));
    let table = run(&["velocity", file, "--pose=5.5,4,0.3"]);
    assert!(String::from_utf8_lossy(&table.stdout).contains("mode +++ (the only one within the limits)"));
}

/// The printed singular values are those of the printed scaled matrix, which is the printed matrix scaled as it says.
#[test]
fn printed_matrices_and_singular_values_belong_together() {
    let answer = json(&["velocity", &model("3-rrr.toml"), "--pose=5.5,4,17", "--mode=+-+", "--json"]);
    let matrix = |key: &str| {
        let entry = |r: usize, c: usize| answer[key][r][c].as_f64().expect("a number");
        assur::nalgebra::Matrix3::from_fn(entry)
    };
    let (own, scaled) = (matrix("pose_matrix"), matrix("scaled_pose_matrix"));
    let length = answer["characteristic_length"].as_f64().expect("a length");
    let mut expected = own;
    for mut row in expected.row_iter_mut() {
        row[2] /= length;
        row /= row.norm();
    }
    assert!((expected - scaled).norm() < 1e-13);
    let mut values: Vec<f64> = scaled.singular_values().iter().copied().collect();
    values.sort_by(|p, q| q.total_cmp(p));
    for (k, value) in values.iter().enumerate() {
        assert!((answer["singular_values"][k].as_f64().expect("a number") - value).abs() < 1e-13);
    }
    assert_eq!(answer["singular_values"][2], answer["sigma_min"]);
    let input = matrix("input_matrix");
    let mut map = input.try_inverse().expect("regular") * own;
    map.column_mut(2).unscale_mut(length);
    let (low, high) = (map.singular_values().min(), map.singular_values().max());
    assert!((low / high - answer["dexterity"].as_f64().expect("a number")).abs() < 1e-12);
    for key in ["pose_matrix", "singular_values", "sigma_min_input", "dexterity"] {
        assert!(answer["scaling"][key].as_str().is_some_and(|text| !text.is_empty()), "{key}");
    }
}

#[test]
fn a_missing_curve_has_a_reason() {
    let text = "schema = \"assur/manipulator/1\"\n\
        [[leg]]\njoints = \"_R__R_R\"\nbase = { at = [0, 0] }\nlinks = [4, 3]\nplatform = { at = [0, 0] }\n\
        [[leg]]\njoints = \"_R_RR\"\nbase = { at = [8, 0] }\nlinks = [4, 4]\nplatform = { at = [2, 0] }\n";
    let file = folder("reason").join("two.toml");
    std::fs::write(&file, text).expect("a file");
    let file = file.to_str().expect("a path");
    let answer = json(&["singularities", file, "--phi=0.2", "--json"]);
    assert!(answer["type_2"]["polynomial"].is_null());
    assert!(answer["type_2"]["reason"].as_str().expect("a reason").contains("leg 1: 2 actuated joints"));
    let table = run(&["singularities", file, "--phi=0.2"]);
    assert!(String::from_utf8_lossy(&table.stdout).contains("no exact curve (leg 1: 2 actuated joints"));
    let check = json(&["check", file, "--json"]);
    assert_eq!(check["degree_bound"], 2);
    // The other commands take two legs too.
    let pose = json(&["forward", file, "--inputs=0.8,-0.9,0.8", "--json"])["modes"][0]["pose"].clone();
    let pose = pose.as_array().expect("a pose").iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
    let ways = json(&["inverse", file, &format!("--pose={pose}"), "--json"]);
    assert_eq!(ways["modes"].as_array().expect("modes").len(), 4);
    let answer = json(&["velocity", file, &format!("--pose={pose}"), "--mode=-+", "--rates=1,0,0", "--json"]);
    assert!(answer["rates"]["inputs_if_pose"].is_array());
    let rows = folder("reason").join("path.csv");
    std::fs::write(&rows, "q1,q2,q3\n0.8,-0.9,0.8\n0.82,-0.88,0.81\n").expect("a file");
    let path = json(&["path", file, "--through", rows.to_str().expect("a path"), "--json"]);
    assert_eq!((&path["complete"], path["rows"].as_array().map(Vec::len)), (&true.into(), Some(2)));
}

#[test]
fn check_and_forward_name_what_holds_for_every_input() {
    let leg = |joints: &str, x: i32, y: i32, links: &str| {
        format!(
            "[[leg]]\njoints = \"{joints}\"\nbase = {{ at = [{x}, {y}] }}\n{links}platform = {{ at = [{}, {}] }}\n",
            2 * x,
            2 * y
        )
    };
    let head = "schema = \"assur/manipulator/1\"\n";
    let strut = |x, y| leg("R_P_R", x, y, "");
    let names = |name: &str, text: &str| -> Vec<String> {
        let file = folder("remarks").join(name);
        std::fs::write(&file, text).expect("a file");
        let check = json(&["check", file.to_str().expect("a path"), "--json"]);
        let remarks = check["remarks"].as_array().expect("remarks").clone();
        remarks.iter().map(|remark| remark["name"].as_str().expect("a name").to_owned()).collect()
    };
    let similar = head.to_owned() + &strut(0, 0) + &strut(4, 0) + &strut(1, 3);
    assert_eq!(names("similar.toml", &similar), ["similar_platforms"]);
    let flat = head.to_owned() + &strut(0, 0) + &strut(4, 0) + &strut(7, 0);
    assert_eq!(names("flat.toml", &flat), ["similar_platforms", "collinear_base", "collinear_platform"]);
    let twice = head.to_owned() + &strut(1, 2) + &strut(1, 2) + &strut(0, 5);
    assert!(names("twice.toml", &twice).contains(&"coincident_pivots".to_owned()));
    // A leg without actuator doubles every count.
    let pinned = leg("_R__R_R", 0, 0, "links = [4, 3]\n");
    let cranked = leg("_R_RR", 4, 0, "links = [4, 9]\n");
    let free = head.to_owned() + &pinned + &cranked + &leg("RRR", 1, 3, "links = [8, 8]\n");
    assert_eq!(names("free.toml", &free), ["free_leg"]);
    let file = folder("remarks").join("free.toml");
    let file = file.to_str().expect("a path");
    let check = json(&["check", file, "--json"]);
    let forward = json(&["forward", file, "--inputs=0.8,-0.9,0.8", "--json"]);
    assert_eq!((&check["degree_bound"], &forward["account"]["degree"]), (&4.into(), &4.into()));
    let table = run(&["forward", file, "--inputs=0.8,-0.9,0.8"]);
    assert!(String::from_utf8_lossy(&table.stdout).contains("leg 3 has no actuator and reaches each pose in 2 ways"));
}

#[test]
fn singularities_are_drawn_and_mapped() {
    let folder = folder("singularities");
    let (svg, csv) = (folder.join("loci.svg"), folder.join("map.csv"));
    let [svg, csv] = [&svg, &csv].map(|path| path.to_str().expect("a path"));
    let file = model("3-rpr.toml");
    let answer =
        json(&["singularities", &file, "--phi=0.3", "--map", "dexterity", "--csv", csv, "--svg", svg, "--json"]);
    assert_eq!(answer["type_2"]["polynomial"]["degree"], 2);
    assert_eq!(answer["type_2"]["modes"].as_array().expect("modes").len(), 8);
    assert!(std::fs::read_to_string(svg).expect("a drawing").contains("</svg>"));
    assert!(std::fs::read_to_string(csv).expect("a map").starts_with("x,y,dexterity\n"));
}

#[test]
fn paths_are_followed_and_bad_rows_named() {
    let folder = folder("paths");
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).expect("a file");
        path.to_str().expect("a path").to_owned()
    };
    let file = model("3-rpr.toml");
    let through = write("path.csv", "q1,q2,q3\n14.98,15.38,12\n14.98,15.2,12\n14.98,15.38,12\n");
    let out = folder.join("out.csv");
    let out = out.to_str().expect("a path");
    let answer = json(&["path", &file, "--through", &through, "--output", out, "--json"]);
    assert_eq!((&answer["complete"], &answer["closed_in"]), (&true.into(), &1.into()));
    assert_eq!(std::fs::read_to_string(out).expect("rows").lines().count(), 4);

    let bad = write("bad.csv", "q1,q2,q3\n14.98,15.38,12\n14.98,wide,12\n");
    let never = folder.join("never.csv");
    let never = never.to_str().expect("a path");
    let message = refused(&["path", &file, "--through", &bad, "--output", never], 1);
    assert!(message.contains("bad.csv: row 2: q2: \"wide\" must be a finite number"), "{message}");
    assert!(message.lines().count() == 1 && !Path::new(never).exists());
    let short = write("short.csv", "q1,q2,q3\n1,2\n");
    assert!(refused(&["path", &file, "--through", &short], 1).contains("row 1: 2 values, must be 3"));
}

#[test]
fn what_cannot_be_asked_is_refused_in_one_line() {
    let file = model("3-rpr.toml");
    for (arguments, part) in [
        (&["inverse", &file, "--pose=1,nan,0"][..], "NaN must be finite"),
        (&["inverse", &file, "--pose=1,2"], "pose: 2 given, must be 3"),
        (&["velocity", &file, "--pose=1,2,0", "--mode=++"], "mode \"++\": must be 3 signs"),
        (&["velocity", &file, "--pose=1,2,0", "--mode=+x+"], "mode \"+x+\": must be 3 signs"),
        (&["velocity", &file, "--pose=1,2,0", "--rates=1,2"], "rates: 2 given, must be 3"),
        (&["velocity", &file, "--pose=1,2,0", "--mode=+++", "--length=-1"], "characteristic length: -1 must be > 0"),
        (&["singularities", &file, "--phi=inf"], "inf must be finite"),
    ] {
        let message = refused(arguments, 1);
        assert!(message.contains(part) && message.lines().count() == 1, "{message}");
    }
    refused(&["velocity", &file], 2);
    refused(&["singularities", &file, "--phi=0", "--map", "beauty"], 2);
}
