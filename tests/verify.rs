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

/// Two actuators on leg 1 pin the platform, leg 2 holds it, leg 3 follows in up to two ways.
const PINNED: &str = r#"
schema = "assur/manipulator/1"
name = "pinned"
leg = [
    { joints = "_R__P_R", base = { at = [0, 0] }, platform = { at = [0, 0] } },
    { joints = "R_P_R", base = { at = [5, 0] }, platform = { at = [3, 0] } },
    { joints = "RRR", base = { at = [0, 6] }, links = [4, 4], platform = { at = [1, 2] } },
]
"#;

#[test]
fn a_pinned_group_is_what_its_proof_says_and_free_legs_are_told_apart() {
    let model = file("pinned.toml", PINNED).display().to_string();
    let inputs = "--inputs=0.3,1.5,4";
    let report = json(&succeeds(&["forward", &model, inputs, "--certify", "--json"]));
    let certificate = &report["certificate"];
    assert_eq!(report["account"]["degree"], 4);
    assert_eq!(certificate["free_ways"], 2);
    let summary = certificate["summary"].as_str().expect("a text");
    assert!(summary.starts_with("2 of degree 2: 2 real proved"), "{summary}");
    assert!(summary.ends_with("each pose in up to 2 ways of free legs, measured"), "{summary}");
    assert!(certificate["about"].as_str().expect("a text").contains("pinned platform"), "{certificate}");
    let pin = &certificate["subject"]["pinned"];
    assert_eq!((&pin["leg"]["type"], &pin["leg"]["l"], &pin["b"]), (&json!("RR"), &json!(4.0), &json!([0.0, 0.0])));
    let text = succeeds(&["forward", &model, inputs, "--certify"]);
    assert!(text.contains("pin: a = [") && text.contains("leg: RR, a = [5.0, 0.0]"), "{text}");
    assert!(!text.contains("the locked triad"), "{text}");
    // Four modes in two poses: each pose has one claim to stand for it, and the other says so.
    let modes = report["modes"].as_array().expect("a list");
    assert_eq!(modes.len(), 4);
    let judged = verify("pinned-report.json", &report, &model);
    assert_eq!(judged["missing"], json!([]));
    let claims = judged["claims"].as_array().expect("a list");
    let nearest: Vec<_> = claims.iter().map(|claim| (&claim["nearest"], claim.get("repeats"))).collect();
    let [one, two, three] = [json!(1), json!(2), json!(3)];
    assert_eq!(nearest, [(&one, None), (&one, Some(&one)), (&two, None), (&two, Some(&three))]);
    assert!(claims.iter().all(|claim| claim["verdict"] == "proven"));
    assert!(judged["certificate"]["subject"]["pinned"].is_object());
}

#[test]
fn the_proof_of_a_triad_carries_the_triad() {
    let report = json(&succeeds(&["forward", &model(), INPUTS, "--certify", "--json"]));
    assert_eq!(report["certificate"]["subject"]["triad"], report["triad"]);
    let text = succeeds(&["forward", &model(), INPUTS, "--certify"]);
    assert!(text.contains("leg 3: RR, a = [0.0, 10.0]"), "{text}");
}

#[test]
fn what_is_undecided_names_its_limit_and_what_is_not_written_is_counted() {
    let triad = |legs: Value| json!({"schema": "assur/triad/1", "legs": legs}).to_string();
    let far = triad(json!([
        {"type": "PR", "a": [0, 0], "u": [1, 0], "b": [0, 0]},
        {"type": "PR", "a": [0, 1e200], "u": [1, 1e-300], "b": [0, 0]},
        {"type": "PP", "phi": 0}
    ]));
    let far = file("far.json", &far).display().to_string();
    let report = json(&succeeds(&["triad", &far, "--certify", "--json"]));
    assert_eq!((&report["status"], &report["limit"]["name"]), (&json!("undecided"), &json!("exponent_range")));
    assert!(succeeds(&["triad", &far]).contains("limit of exponents: a coordinate leaves the range of f64"));
    let uneven = triad(json!([
        {"type": "RR", "a": [0, 0], "b": [0, 0], "l": 14.98e300},
        {"type": "RR", "a": [15.91, 0], "b": [17.045, 0], "l": 15.38},
        {"type": "RR", "a": [0, 10], "b": [13.2389, 16.0929], "l": 12}
    ]));
    let uneven = file("uneven.json", &uneven).display().to_string();
    let report = json(&succeeds(&["triad", &uneven, "--certify", "--json"]));
    assert_eq!((&report["status"], report.get("limit")), (&json!("complete"), None));
    assert_eq!((&report["account"]["complex"], &report["complex_out_of_range"]), (&json!(6), &json!(6)));
    let text = succeeds(&["triad", &uneven, "--certify"]);
    assert!(text.contains("6 of the complex solutions cannot be written"), "{text}");
    assert!(!text.contains("by 0.0") && text.contains("nearly zero_length, by 8.0e-301"), "{text}");
}
