//! Proofs and the self-check on the command line.
#![cfg(feature = "cli")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::{Value, json};

const MODEL: &str = "3-rpr.toml";
const INPUTS: &str = "--inputs=14.98,15.38,12";

fn assur(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_assur")).args(arguments).output().expect("the program starts")
}

fn succeeds(arguments: &[&str]) -> String {
    let output = assur(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("prints text")
}

fn model() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(MODEL).display().to_string()
}

fn file(name: &str, content: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("verify");
    fs::create_dir_all(&folder).expect("can be made");
    let path = folder.join(name);
    fs::write(&path, content).expect("can be written");
    path
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("is JSON")
}

fn verify(name: &str, report: &Value, model: &str) -> Value {
    let path = file(name, &report.to_string());
    json(&succeeds(&["verify", &path.display().to_string(), "--model", model, "--json"]))
}

#[test]
fn a_certified_answer_has_a_box_around_every_mode() {
    let report = json(&succeeds(&["forward", &model(), INPUTS, "--certify", "--json"]));
    assert_eq!(report["certificate"]["summary"], "6 of degree 6: 6 real proved, 0 non-real proved, complete");
    for mode in report["modes"].as_array().expect("a list") {
        assert_eq!(mode["proof"], "proven");
        for k in 0..3 {
            let at = |v: &Value| v.as_f64().expect("a number");
            let (low, high) = (at(&mode["box"][k][0]), at(&mode["box"][k][1]));
            assert!(low <= high && high - low < 1e-12, "{mode}");
            assert!((at(&mode["pose"][k]) - low).abs() < 1e-12, "{mode}");
        }
    }
    let plain = json(&succeeds(&["forward", &model(), INPUTS, "--json"]));
    assert!(plain.get("certificate").is_none() && plain["modes"][0].get("box").is_none());
    let text = succeeds(&["forward", &model(), INPUTS, "--certify"]);
    assert!(
        text.contains("proof: 6 of degree 6: 6 real proved") && text.contains("sines and cosines were rounded once")
    );
}

#[test]
fn true_false_and_missing_poses_are_told_apart() {
    let report = json(&succeeds(&["forward", &model(), INPUTS, "--json"]));
    let all = verify("all.json", &report, &model());
    assert_eq!(all["missing"], json!([]));
    assert!(all["claims"].as_array().expect("a list").iter().all(|claim| claim["verdict"] == "proven"));
    // Another program's poses: one right but for its last digits, one wrong.
    let pose = &report["modes"][2]["pose"];
    let shifted = json!([pose[0].as_f64().unwrap() + 1e-7, pose[1], pose[2]]);
    let wrong = json!([pose[0].as_f64().unwrap() + 0.1, pose[1], pose[2]]);
    let other = json!({"inputs": report["inputs"], "poses": [shifted, wrong]});
    let judged = verify("other.json", &other, &model());
    assert_eq!([&judged["claims"][0]["verdict"], &judged["claims"][1]["verdict"]], ["proven", "refuted"]);
    assert_eq!(judged["claims"][0]["nearest"], 3);
    let missing: Vec<u64> =
        judged["missing"].as_array().expect("a list").iter().filter_map(|m| m["mode"].as_u64()).collect();
    assert_eq!(missing, [1, 2, 4, 5, 6]);
}

#[test]
fn a_report_about_a_triad_is_held_against_its_problem_file() {
    let report = json(&succeeds(&["forward", &model(), INPUTS, "--json"]));
    let triad = file("triad.json", &report["triad"].to_string());
    let judged = verify("triad-report.json", &report, &triad.display().to_string());
    assert_eq!(judged["missing"], json!([]));
    assert_eq!(judged["certificate"]["complete"], true);
}

#[test]
fn questions_that_cannot_be_asked_end_with_one_line_and_status_1() {
    let bad = file("bad.json", r#"{"inputs":[14.98,15.38,12],"poses":[[1,2]]}"#).display().to_string();
    let short = file("short.json", r#"{"inputs":[14.98,15.38],"poses":[]}"#).display().to_string();
    for (report, says) in [(&bad, "poses[0]"), (&short, "inputs"), (&"nowhere.json".to_owned(), "cannot be read")] {
        let output = assur(&["verify", report, "--model", &model()]);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains(says) && error.trim().lines().count() == 1 && output.stdout.is_empty(), "{error}");
    }
    assert_eq!(assur(&["verify", &bad]).status.code(), Some(2));
}
