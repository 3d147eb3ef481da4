//! The command line, as its users meet it.
#![cfg(feature = "cli")]

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// The example models, with inputs and the number of real modes these have.
const EXAMPLES: [(&str, &str, usize); 8] = [
    ("3-rpr.toml", "14.98,15.38,12", 6),
    ("3-rrr.toml", "60,150,270", 2),
    ("3-prr.toml", "7,8,6", 2),
    ("3-rrp.toml", "60,100,210", 2),
    ("3-prp.toml", "20,20,20", 2),
    ("3-rpr-base.toml", "40,130,-80", 2),
    ("3-ppr-base.toml", "6,7,8", 2),
    ("mixed.toml", "8,7,250", 2),
];

fn assur(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_assur"));
    command.args(arguments).stdin(Stdio::null()).output().expect("the program starts")
}

fn succeeds(arguments: &[&str]) -> String {
    let output = assur(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "assur {arguments:?}: {error}");
    String::from_utf8(output.stdout).expect("prints text")
}

fn example(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name).display().to_string()
}

/// A folder of this test's own, empty.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("can be made");
    path
}

#[test]
fn every_example_has_the_modes_its_comment_promises() {
    for (name, inputs, count) in EXAMPLES {
        let inputs = format!("--inputs={inputs}");
        let comment = format!("# assur forward examples/{name} {inputs}");
        let text = fs::read_to_string(example(name)).expect("is shipped");
        assert!(text.contains(&comment), "{name} does not say {comment:?}");
        let report: Value =
            serde_json::from_str(&succeeds(&["forward", &example(name), &inputs, "--json"])).expect("is JSON");
        assert_eq!(report["schema"], "assur/forward/1");
        assert_eq!(report["status"], "complete");
        let modes = report["modes"].as_array().expect("is a list");
        assert_eq!(modes.len(), count, "{name}");
        for mode in modes {
            assert!(mode["residual"].as_f64().is_some_and(|residual| residual < 1e-13), "{name}: {mode}");
            assert_eq!(mode["joints"].as_array().map(Vec::len), Some(3), "{name}: all nine joints come with a mode");
        }
        let account = &report["account"];
        let parts = ["real", "complex", "at_infinity", "rejected", "self_motion", "undecided"];
        let sum: u64 = parts.iter().filter_map(|part| account[part].as_u64()).sum();
        assert_eq!(Some(sum), account["degree"].as_u64(), "{name}");
        succeeds(&["check", &example(name)]);
    }
}

#[test]
fn the_locked_triad_of_a_report_is_a_problem_file_with_the_same_answer() {
    let path = folder("triad").join("triad.json");
    for (name, inputs, _) in EXAMPLES {
        let whole = succeeds(&["forward", &example(name), &format!("--inputs={inputs}"), "--json"]);
        let whole: Value = serde_json::from_str(&whole).expect("is JSON");
        fs::write(&path, whole["triad"].to_string()).expect("can be written");
        let part = succeeds(&["triad", &path.display().to_string(), "--json"]);
        let part: Value = serde_json::from_str(&part).expect("is JSON");
        assert_eq!(whole["account"], part["account"], "{name}");
        assert_eq!(whole["complex"], part["complex"], "{name}");
        let poses = |report: &Value| -> Vec<Value> {
            report["modes"].as_array().into_iter().flatten().map(|mode| mode["pose"].clone()).collect()
        };
        assert_eq!(poses(&whole), poses(&part), "{name}");
    }
}

#[test]
fn a_new_model_of_every_family_can_be_asked_at_once() {
    let folder = folder("families");
    let chains = ["RRR", "PRR", "RPR", "RRP", "PPR", "PRP", "RPP"];
    for chain in chains {
        for joint in 0..3 {
            let mut leg = chain.to_owned();
            leg.insert(joint, '_');
            leg.insert(joint + 2, '_');
            // Legs with both sliders passive restrain the turning only; one of them is enough.
            let passive: String =
                chain.chars().enumerate().filter(|(place, _)| *place != joint).map(|(_, c)| c).collect();
            let family = if passive == "PP" { format!("{leg},_R_RR,R_P_R") } else { format!("3-{leg}") };
            let path = folder.join(format!("{leg}.toml")).display().to_string();
            succeeds(&["new", &family, "--output", &path]);
            let model = fs::read_to_string(&path).expect("was written");
            let inputs = model.lines().find_map(|line| line.split("--inputs=").nth(1)).expect("names its inputs");
            let report = succeeds(&["forward", &path, &format!("--inputs={inputs}"), "--json"]);
            let report: Value = serde_json::from_str(&report).expect("is JSON");
            assert!(report["modes"].as_array().is_some_and(|modes| !modes.is_empty()), "{family} has no mode: {model}");
        }
    }
}

#[test]
fn drawings_are_whole_and_show_every_mode() {
    let folder = folder("drawings");
    let (svg, png) = (folder.join("modes.svg"), folder.join("modes.png"));
    let arguments = ["--svg", &svg.display().to_string(), "--png", &png.display().to_string()];
    succeeds(&[&["forward", &example("3-rpr.toml"), "--inputs=14.98,15.38,12"], &arguments[..]].concat());
    let drawing = fs::read_to_string(&svg).expect("was written");
    assert!(drawing.starts_with("<svg") && drawing.trim_end().ends_with("</svg>"));
    assert_eq!(drawing.matches("φ = ").count(), 6);
    assert!(fs::read(&png).expect("was written").starts_with(b"\x89PNG"));
    assert_eq!(fs::read_dir(&folder).expect("is there").count(), 2, "nothing else is left behind");
    let far =
        ["forward", &example("3-rpr.toml"), "--inputs=1,1,1", "--svg", &svg.display().to_string()].map(str::to_owned);
    succeeds(&far.each_ref().map(String::as_str));
    assert!(fs::read_to_string(&svg).expect("was written").contains("no assembly mode"));
}

#[test]
fn tables_speak_the_unit_of_the_file_and_json_speaks_radians() {
    let arguments = ["forward", &example("3-rrp.toml"), "--inputs=60,100,210"];
    let table = succeeds(&arguments);
    assert!(table.contains("26.588") && table.contains("phi (deg)"), "{table}");
    let report: Value = serde_json::from_str(&succeeds(&[&arguments[..], &["--json"]].concat())).expect("is JSON");
    let phi = report["modes"][1]["pose"][2].as_f64().expect("is a number");
    assert!((phi - 26.588_247_445_6_f64.to_radians()).abs() < 1e-10);
    assert!(!table.contains('\u{1b}'), "no colour where there is no terminal");
}

#[test]
fn what_is_asked_for_is_shown() {
    let arguments = ["forward", &example("3-rrr.toml"), "--inputs=60,150,270"];
    assert!(!succeeds(&arguments).contains("theta"));
    assert!(succeeds(&[&arguments[..], &["--complex"]].concat()).contains("non-real solutions"));
    assert!(succeeds(&[&arguments[..], &["--polynomial"]].concat()).contains("eliminant"));
}

#[test]
fn every_command_helps_with_an_example() {
    for command in ["new", "check", "forward", "triad", "derive", "completions"] {
        assert!(succeeds(&[command, "--help"]).contains(&format!("Example:  assur {command}")), "{command}");
    }
    assert!(succeeds(&["completions", "bash"]).contains("assur"));
}

#[test]
fn every_derivation_listed_can_be_printed() {
    for line in succeeds(&["derive", "--list"]).lines() {
        let name = line.split_whitespace().next().expect("a line starts with a name");
        assert!(succeeds(&["derive", name]).len() > 200, "{name}");
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_assur"))
        .args(["completions", "zsh"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let mut complaint = String::new();
    child.stderr.take().expect("is piped").read_to_string(&mut complaint).expect("is text");
    assert_eq!(child.wait().expect("ends").code(), Some(0), "{complaint}");
    assert_eq!(complaint, "");
}
