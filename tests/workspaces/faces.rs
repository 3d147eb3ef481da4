//! `workspace` and `sweep` on the command line.
#![cfg(feature = "cli")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn model(name: &str) -> String {
    format!("{}/examples/workspaces/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_assur")).args(arguments).output().expect("the program starts")
}

fn json(arguments: &[&str]) -> Value {
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
    assert_eq!(output.status.code(), Some(1), "{arguments:?}: {}", String::from_utf8_lossy(&output.stdout));
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).expect("text")
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder for files");
    folder
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn the_report_is_the_contracts() {
    let file = model("table1-4c");
    let report = json(&["workspace", &file, "dextrous", "--json"]);
    assert_eq!(
        (report["schema"].as_str(), report["kind"].as_str(), report["status"].as_str()),
        (Some("assur/workspace/1"), Some("dextrous"), Some("complete"))
    );
    let loops = report["loops"].as_array().expect("a list");
    let sum: f64 = loops.iter().map(|one| number(&one["area"])).sum();
    assert!((sum - number(&report["area"])).abs() < 1e-9 && number(&report["area"]) > 0.0);
    for one in loops {
        let arcs = one["arcs"].as_array().expect("a list");
        for (arc, next) in arcs.iter().zip(arcs.iter().cycle().skip(1)) {
            let off = |k: usize| (number(&arc["end"][k]) - number(&next["start"][k])).abs();
            assert!(off(0) < 1e-9 && off(1) < 1e-9, "{arc} {next}");
            assert_eq!(arc["curve"], "circle");
            for key in ["center", "radius", "start_angle", "end_angle", "active"] {
                assert!(!arc[key].is_null(), "{key} in {arc}");
            }
            assert!(arc["active"][0].as_str().expect("a text").starts_with("leg "));
        }
    }
    let bbox: Vec<f64> = report["bbox"].as_array().expect("a list").iter().map(number).collect();
    assert!(bbox[0] < bbox[2] && bbox[1] < bbox[3]);
    let maximal = json(&["workspace", &model("table1-1a"), "maximal", "--json"]);
    assert!((number(&maximal["area"]) - 315.848_147).abs() < 1e-4, "{}", maximal["area"]);
    let arcs =
        maximal["loops"].as_array().expect("a list").iter().flat_map(|one| one["arcs"].as_array().expect("a list"));
    let couplers: Vec<&Value> = arcs.filter(|arc| arc["curve"] == "coupler").collect();
    assert!(!couplers.is_empty());
    for arc in couplers {
        assert_eq!(arc["pair"].as_array().map(Vec::len), Some(2), "{arc}");
        assert!(
            arc["pair"][0]["type"] == "RR"
                && arc["sigma"].is_number()
                && arc["phi_start"].is_number()
                && arc["phi_end"].is_number()
        );
    }
}

#[test]
fn angles_are_those_of_the_file_and_reports_are_in_radians() {
    let file = model("table1-1a");
    let report = json(&["workspace", &file, "inclusive", "--from=230", "--to=260", "--json"]);
    assert!((number(&report["from"]) - 230f64.to_radians()).abs() < 1e-12);
    assert!((number(&report["to"]) - 260f64.to_radians()).abs() < 1e-12);
    assert!((number(&report["area"]) - 186.322_393).abs() < 1e-3, "{}", report["area"]);
    // A = B is that single orientation.
    let single = json(&["workspace", &file, "inclusive", "--from=240", "--to=240", "--json"]);
    let constant = json(&["workspace", &file, "constant", "--phi=240", "--json"]);
    assert!((number(&single["area"]) - number(&constant["area"])).abs() < 1e-9);
    // The other way round the same two angles are another range.
    let rest = json(&["workspace", &file, "inclusive", "--from=260", "--to=230", "--json"]);
    assert!((number(&rest["to"]) - 590f64.to_radians()).abs() < 1e-12);
}

#[test]
fn tables_tell_pieces_holes_and_isolated_parts() {
    let out = text(&["workspace", &model("table1-1a"), "constant", "--phi=240"]);
    assert!(out.contains("pieces     2, holes 0") && out.contains("area       45.84896"), "{out}");
    let curve = text(&["workspace", &model("table1-4a"), "dextrous"]);
    assert!(curve.contains("isolated curve from"), "{curve}");
    let void = text(&["workspace", &model("prr-symmetric-radial-void"), "constant", "--phi=0"]);
    assert!(void.contains("leg 1: a stroke shorter than two links leaves a void"), "{void}");
    let empty = text(&["workspace", &model("table1-2a"), "dextrous"]);
    assert!(empty.contains("empty"), "{empty}");
}

#[test]
fn points_are_told_apart() {
    let folder = folder("workspace-points");
    let points = folder.join("points.csv");
    std::fs::write(&points, "x,y\n-2.141140781958235,22.68958554437981\n3.9377688010441325,13.036238052856476\n")
        .expect("writes");
    let report =
        json(&["workspace", &model("table1-1a"), "maximal", "--points", points.to_str().expect("plain"), "--json"]);
    let found = report["points"].as_array().expect("a list");
    assert_eq!((found[0]["inside"].as_bool(), found[1]["inside"].as_bool()), (Some(true), Some(false)));
    assert!(number(&found[0]["margin"]) > 0.0 && number(&found[1]["margin"]) < 0.0);
    assert!(found[0]["binding"].as_str().expect("a text").starts_with("leg "));
    let table = text(&["workspace", &model("table1-1a"), "maximal", "--points", points.to_str().expect("plain")]);
    assert!(table.contains("inside") && table.contains("yes") && table.contains("no"), "{table}");
}

#[test]
fn pictures_and_drawings_are_written_together() {
    let folder = folder("workspace-files");
    let path = |name: &str| folder.join(name).display().to_string();
    let [svg, png, dxf, csv] = ["w.svg", "w.png", "w.dxf", "w.csv"].map(path);
    let file = model("table1-2c");
    text(&[
        "workspace",
        &file,
        "maximal",
        "--svg",
        &svg,
        "--png",
        &png,
        "--dxf",
        &dxf,
        "--csv",
        &csv,
        "--overlay",
        "dextrous",
        "--overlay",
        "constant:20",
    ]);
    let svg = std::fs::read_to_string(&svg).expect("is there");
    assert!(svg.contains("maximal") && svg.contains("constant, φ = 20°") && svg.contains("area "), "a legend");
    assert!(std::fs::read(&png).expect("is there").starts_with(b"\x89PNG"));
    let dxf = std::fs::read_to_string(&dxf).expect("is there");
    let entities = ["ARC", "POLYLINE"].map(|name| dxf.matches(&format!("  0\n{name}\n")).count());
    assert!(entities[0] > 0 && entities[1] > 0 && dxf.ends_with("  0\nEOF\n"), "{entities:?}");
    let csv = std::fs::read_to_string(&csv).expect("is there");
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert!(rows.iter().all(|row| row.len() == 7));
    // The first loop closes.
    let first: Vec<_> = rows.iter().filter(|row| row[0] == "outer" && row[1] == "1").collect();
    let at = |row: &[&str]| [5, 6].map(|k| row[k].parse::<f64>().expect("a number"));
    let (start, end) = (at(first[0]), at(first[first.len() - 1]));
    assert!((start[0] - end[0]).abs() < 1e-9 && (start[1] - end[1]).abs() < 1e-9);
    let alone = path("alone.svg");
    text(&["workspace", &file, "maximal", "--svg", &alone]);
    let alone = std::fs::read_to_string(&alone).expect("is there");
    assert!(alone.contains("coupler curve") && alone.contains("leg 2 alone") && alone.contains("stroke-dasharray"));
}

#[test]
fn one_assembly_reaches_what_it_reaches() {
    let file = model("table1-1a");
    let report = json(&["workspace", &file, "maximal", "--assembly=7,20,270", "--json"]);
    assert!(
        (number(&report["area"]) - 315.848_147).abs() < 1e-4 && (number(&report["assembly"][0]) - 7.0).abs() < 1e-15
    );
    let line = refused(&["workspace", &file, "dextrous", "--assembly=7,20,270"]);
    assert!(line.contains("--assembly goes with the kind maximal"), "{line}");
    let line = refused(&["workspace", &file, "maximal", "--assembly=700,20,270"]);
    assert!(line.contains("leg 1"), "{line}");
}

#[test]
fn slices_gradients_and_searches_are_told() {
    let file = model("table1-4c");
    let report = json(&[
        "workspace",
        &file,
        "dextrous",
        "--slices=5",
        "--gradient=legs.limits.max",
        "--gradient=leg1.base.at.x",
        "--json",
    ]);
    let stack = &report["stack"];
    assert_eq!(stack["slices"].as_array().map(Vec::len), Some(5));
    // The volume over a whole turn lies between the smallest and the largest slice.
    let areas: Vec<f64> =
        stack["slices"].as_array().expect("a list").iter().map(|slice| number(&slice["area"])).collect();
    let mean = number(&stack["volume"]) / std::f64::consts::TAU;
    assert!(
        mean > 0.5 * areas.iter().copied().fold(f64::INFINITY, f64::min)
            && mean < 2.0 * areas.iter().copied().fold(0.0, f64::max)
    );
    assert!(number(&report["gradient"]["legs.limits.max"]) > 0.0);
    let best = json(&["workspace", &file, "dextrous", "--optimise=leg1.limits.max=8:12", "--json"]);
    let optimum = &best["optimum"];
    assert!(number(&optimum["area"]) >= number(&optimum["area_before"]));
    assert!((number(&optimum["values"]["leg1.limits.max"]) - 12.0).abs() < 1e-6, "{optimum}");
}

#[test]
fn sweeps_are_tables_with_reasons() {
    let folder = folder("workspace-sweep");
    let file = model("table1-1a");
    let arguments = [
        "sweep",
        &file,
        "--vary=leg1.limits.min=6:14:5",
        "--vary=leg2.platform.at.x=12:13:2",
        "--report=area:constant:240,holes:maximal",
    ];
    let csv = text(&arguments);
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines[0], "row,leg1.limits.min,leg2.platform.at.x,area:constant:240,holes:maximal,reason");
    assert_eq!(lines.len(), 11);
    assert!(lines[1].starts_with("1,6,12,") && lines[2].starts_with("2,6,13,") && lines[10].starts_with("10,14,13,,,"));
    assert!(lines[10].contains("must not decrease"), "{}", lines[10]);
    // The same in the other forms, and whatever the number of threads.
    for name in ["sweep.csv", "sweep.jsonl", "sweep.parquet"] {
        let path = folder.join(name);
        let output = Command::new(env!("CARGO_BIN_EXE_assur"))
            .args(arguments)
            .arg("--output")
            .arg(&path)
            .env("RAYON_NUM_THREADS", "1")
            .output();
        assert!(output.expect("starts").status.success());
        let bytes = std::fs::read(&path).expect("is there");
        match name {
            "sweep.csv" => assert_eq!(bytes, csv.as_bytes()),
            "sweep.jsonl" => {
                let rows: Vec<Value> = bytes
                    .split(|b| *b == b'\n')
                    .filter(|line| !line.is_empty())
                    .map(|line| serde_json::from_slice(line).expect("JSON"))
                    .collect();
                assert_eq!(rows.len(), 10);
                assert_eq!(rows[0]["area:constant:240"].to_string(), lines[1].split(',').nth(3).expect("a value"));
                assert!(rows[9]["reason"].is_string() && rows[9]["area:constant:240"].is_null());
            }
            _ => assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1")),
        }
    }
}

#[test]
fn what_cannot_be_asked_is_refused_in_one_line() {
    let file = model("table1-1a");
    let folder = folder("workspace-bad");
    let of = |name: &str, from: &str, to: &str| {
        let text = std::fs::read_to_string(&file).expect("an example").replacen(from, to, 1);
        let path = folder.join(name);
        std::fs::write(&path, text).expect("writes");
        path.display().to_string()
    };
    let [backwards, infinite, other] = [
        of("backwards.toml", "limits = [8.0, 12.0]", "limits = [12.0, 8.0]"),
        of("infinite.toml", "limits = [8.0, 12.0]", "limits = [8.0, inf]"),
        of("other.toml", "joints = \"R_P_R\"", "joints = \"RR_P_\""),
    ];
    let points = folder.join("bad.csv").display().to_string();
    std::fs::write(&points, "x,y\n1,2\n3,nan\n").expect("writes");
    let cases: [(&[&str], &str); 17] = [
        (&["workspace", &backwards, "maximal"], "must not decrease"),
        (&["workspace", &infinite, "maximal"], "finite"),
        (
            &["workspace", &other, "maximal"],
            "leg 1: workspaces of legs RRP are not covered; those of RPR, RRR and PRR are",
        ),
        (&["workspace", &file, "constant"], "needs --phi"),
        (&["workspace", &file, "total"], "needs --from and --to"),
        (&["workspace", &file, "maximal", "--phi=3"], "takes no --phi"),
        (&["workspace", &file, "constant", "--phi=nan"], "finite"),
        (&["workspace", &file, "maximal", "--mode=++"], "must be 3"),
        (&["workspace", &file, "maximal", "--mode=x"], "mode \"x\""),
        (&["workspace", &file, "maximal", "--overlay=most"], "kinds are constant:PHI"),
        (&["workspace", &file, "maximal", "--points", &points], "bad.csv: row 2: y: \"nan\" must be a finite number"),
        (&["workspace", &file, "maximal", "--gradient=leg1.length"], "names are leg1.base.at.x"),
        (&["workspace", &file, "maximal", "--optimise=leg1.limits.max=9:8"], "must be KEY=A:B"),
        (&["sweep", &file, "--vary=leg1.base.at.x=0:1", "--report=area:maximal"], "must be KEY=A:B:N"),
        (&["sweep", &file, "--vary=leg5.base.at.x=0:1:3", "--report=area:maximal"], "there is no leg 5"),
        (&["sweep", &file, "--vary=leg1.base.at.x=0:1:3", "--report=volume:maximal"], "must be WHAT:KIND"),
        (
            &["sweep", &file, "--vary=leg1.base.at.x=0:1:3", "--vary=legs.base.at.x=0:1:3", "--report=area:maximal"],
            "varied twice",
        ),
    ];
    for (arguments, expected) in cases {
        let line = refused(arguments);
        assert!(line.contains(expected) && line.trim_end().lines().count() == 1, "{arguments:?}: {line}");
    }
    assert_eq!(run(&["workspace", &file, "largest"]).status.code(), Some(2));
}

#[test]
fn examples_say_what_to_try() {
    let folder = format!("{}/examples/workspaces", env!("CARGO_MANIFEST_DIR"));
    let mut tried = 0;
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("is readable").path();
        let text = std::fs::read_to_string(&path).expect("a model");
        let command = text.lines().find_map(|line| line.strip_prefix("# assur ")).expect("a command to try");
        let words: Vec<String> = command
            .split(' ')
            .map(|word| word.replace("examples/", &format!("{}/examples/", env!("CARGO_MANIFEST_DIR"))))
            .collect();
        assert!(words[1].ends_with(path.file_name().and_then(|name| name.to_str()).expect("plain")), "{command}");
        let output = run(&words.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
        tried += 1;
    }
    assert!(tried >= 14, "{tried}");
}
