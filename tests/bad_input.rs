//! Every bad input is refused in one line that says where and what, and leaves nothing behind.
#![cfg(feature = "cli")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const LEG: &str = "[[leg]]\njoints = \"R_P_R\"\nbase = { at = [0, 1] }\nplatform = { at = [2, 3] }\nlimits = [1, 9]\n";
const HEAD: &str = "schema = \"assur/manipulator/1\"\n";

/// A model file with one thing changed in leg 2, or in the head where the leg does not have it.
fn model(from: &str, to: &str) -> String {
    let legs = if LEG.contains(from) { [LEG, &LEG.replacen(from, to, 1), LEG].concat() } else { LEG.repeat(3) };
    let head = if LEG.contains(from) { HEAD.to_owned() } else { HEAD.replacen(from, to, 1) };
    assert!(LEG.contains(from) || HEAD.contains(from), "{from:?} is not in the model");
    head + &legs
}

fn triad(from: &str, to: &str) -> String {
    let leg = r#"{"type":"RR","a":[0,1],"b":[2,3],"l":4}"#;
    let line = r#"{"type":"PR","a":[0,1],"u":[1,0],"b":[2,3]}"#;
    let text = format!(r#"{{"schema":"assur/triad/1","legs":[{leg},{line},{leg}]}}"#);
    assert!(text.contains(from), "{from:?} is not in the triad");
    text.replacen(from, to, 1)
}

/// Runs the program in a folder of its own on one file; gives its exit status and what it complains about.
fn ask(case: &str, file: &str, content: &[u8], arguments: &[&str]) -> (Option<i32>, String) {
    let folder: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("bad-{case}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("can be made");
    fs::write(folder.join(file), content).expect("can be written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_assur"));
    let output =
        command.args(arguments).current_dir(&folder).stdin(Stdio::null()).output().expect("the program starts");
    assert!(output.stdout.is_empty(), "{case}: {}", String::from_utf8_lossy(&output.stdout));
    assert_eq!(fs::read_dir(&folder).expect("is there").count(), 1, "{case}: something was written");
    (output.status.code(), String::from_utf8(output.stderr).expect("is text"))
}

fn refused(case: &str, file: &str, content: impl AsRef<[u8]>, arguments: &[&str], words: &[&str]) {
    let (status, complaint) = ask(case, file, content.as_ref(), arguments);
    assert_eq!(status, Some(1), "{case}: {complaint}");
    assert_eq!(complaint.lines().count(), 1, "{case}: not one line: {complaint}");
    for word in words {
        assert!(complaint.contains(word), "{case}: {word:?} is not said in {complaint:?}");
    }
}

const FORWARD: [&str; 5] = ["forward", "m.toml", "--inputs=2,3,4", "--svg", "out.svg"];

#[test]
fn a_sound_model_is_not_refused() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sound");
    fs::create_dir_all(&folder).expect("can be made");
    fs::write(folder.join("m.toml"), HEAD.to_owned() + &LEG.repeat(3)).expect("can be written");
    let output = Command::new(env!("CARGO_BIN_EXE_assur")).args(["check", "m.toml"]).current_dir(&folder).output();
    assert!(output.expect("the program starts").status.success());
}

#[test]
fn models() {
    let cases: [(&str, String, &[&str]); 22] = [
        ("missing-leg", HEAD.to_owned() + &LEG.repeat(2), &["leg: 2 actuated joints", "must be 3"]),
        ("one-leg", HEAD.to_owned() + LEG, &["leg: 1 given, must be 3"]),
        ("extra-leg", HEAD.to_owned() + &LEG.repeat(4), &["leg: 4 given, must be 3"]),
        ("no-leg", HEAD.to_owned(), &["leg: missing"]),
        ("letters", model("R_P_R", "R_X_R"), &["leg 2", "joints", "\"R_X_R\"", "'X'"]),
        ("underscore", model("R_P_R", "R_PR"), &["leg 2", "joints", "\"R_PR\"", "underscores"]),
        (
            "no-actuator",
            model("\"R_P_R\"\nbase", "\"RPR\"\nbase").replace("limits = [1, 9]\n", ""),
            &["2 actuated joints", "RPR"],
        ),
        (
            "actuators",
            model("\"R_P_R\"\nbase", "\"_R__P_R\"\nbase").replace("limits = [1, 9]\n", ""),
            &["4 actuated joints", "_R__P_R"],
        ),
        ("length", model("[0, 1]", "[0, 1, 2]"), &["leg 2: base.at", "[0, 1, 2]", "has 3"]),
        ("limits-length", model("[1, 9]", "[1]"), &["leg 2: limits", "[1]", "two numbers"]),
        ("nan", model("[2, 3]", "[2, nan]"), &["leg 2: platform.at[1]", "NaN", "finite"]),
        ("infinite", model("[2, 3]", "[-inf, 3]"), &["leg 2: platform.at[0]", "-inf", "finite"]),
        ("schema", model("manipulator/1", "manipulater/1"), &["schema", "assur/manipulater/1", "did you mean"]),
        (
            "other-schema",
            model("assur/manipulator/1", "assur/triad/1"),
            &["schema", "assur/triad/1", "assur/manipulator/1"],
        ),
        ("no-schema", LEG.repeat(3), &["schema: missing"]),
        ("key", model("platform", "plattform"), &["leg 2: plattform", "unknown key", "\"platform\""]),
        ("kind", model("[2, 3]", "\"left\""), &["leg 2: platform.at", "\"left\"", "two numbers"]),
        (
            "both",
            model("at = [0, 1]", "at = [0, 1], angle = 0, direction = [1, 0]"),
            &["leg 2: base", "angle", "direction"],
        ),
        ("no-direction", model("at = [0, 1]", "at = [0, 1], direction = [0, 0]"), &["leg 2: base.direction", "[0, 0]"]),
        ("range", model("[1, 9]", "[9, 1]"), &["leg 2: limits of joint 2", "[9, 1]"]),
        ("toml", model("[2, 3]", "[2, 3"), &["m.toml:10:25:", "TOML"]),
        (
            "passive",
            model("limits = [1, 9]", "passive_limits = { 2 = [0, 1] }"),
            &["leg 2: passive_limits.2", "actuated"],
        ),
    ];
    for (case, content, words) in cases {
        refused(case, "m.toml", content, &FORWARD, &[words, &["m.toml"]].concat());
    }
}

#[test]
fn triads() {
    let cases: [(&str, String, &[&str]); 10] = [
        ("t-negative", triad("\"l\":4", "\"l\":-0.3"), &["leg 1", "length", "-0.3"]),
        (
            "t-two-legs",
            r#"{"schema":"assur/triad/1","legs":[{"type":"PP","phi":1}]}"#.to_owned(),
            &["legs", "three legs", "has 1"],
        ),
        ("t-type", triad("\"PR\"", "\"PX\""), &["leg 2: type", "\"PX\""]),
        ("t-key", triad("\"u\"", "\"w\""), &["leg 2: w", "unknown key"]),
        ("t-foreign-key", triad("\"u\":[1,0]", "\"l\":4"), &["leg 2: l", "unknown key"]),
        ("t-missing", triad("\"u\":[1,0],", ""), &["leg 2: u", "missing"]),
        ("t-twice", triad("\"l\":4", "\"l\":4,\"l\":5"), &["leg 1: l", "twice"]),
        ("t-direction", triad("[1,0]", "[0,0]"), &["leg 2", "u", "[0, 0]"]),
        ("t-nan", triad("\"l\":4", "\"l\":NaN"), &["t.json:1:", "JSON"]),
        ("t-syntax", triad("}]}", "}}"), &["t.json:1:", "JSON"]),
    ];
    for (case, content, words) in cases {
        refused(
            case,
            "t.json",
            content,
            &["triad", "t.json", "--json", "--png", "out.png"],
            &[words, &["t.json"]].concat(),
        );
    }
}

#[test]
fn files_and_inputs() {
    let sound = HEAD.to_owned() + &LEG.repeat(3);
    refused("no-file", "m.toml", &sound, &["check", "away.toml"], &["away.toml", "cannot be read"]);
    refused("no-text", "m.toml", b"\xff\xfe\x00", &["check", "m.toml"], &["m.toml", "cannot be read"]);
    refused("json-model", "m.json", "{\"schema\": ", &["check", "m.json"], &["m.json:1:", "JSON"]);
    refused(
        "few-inputs",
        "m.toml",
        &sound,
        &["forward", "m.toml", "--inputs=2,3"],
        &["m.toml", "inputs", "2 given", "3 actuated"],
    );
    refused("many-inputs", "m.toml", &sound, &["forward", "m.toml", "--inputs=2,3,4,5"], &["inputs", "4 given"]);
    refused("nan-input", "m.toml", &sound, &["forward", "m.toml", "--inputs=2,NaN,4"], &["m.toml", "leg 2", "NaN"]);
    refused("limit", "m.toml", &sound, &["forward", "m.toml", "--inputs=2,3,12"], &["leg 3", "12", "[1, 9]"]);
    refused(
        "unwritable",
        "m.toml",
        &sound,
        &["forward", "m.toml", "--inputs=2,3,4", "--svg", "no/where.svg"],
        &["no/where.svg", "cannot be written"],
    );
    refused("family", "m.toml", &sound, &["new", "3-RXR", "--output", "new.toml"], &["3-RXR", "'X'"]);
    refused("derivation", "m.toml", &sound, &["derive", "nothing-of-the-kind"], &["nothing-of-the-kind"]);
}

#[test]
fn files_of_another_kind_say_which_command_takes_them() {
    let sound = HEAD.to_owned() + &LEG.repeat(3);
    refused(
        "kind-1",
        "t.json",
        triad("PR", "PR"),
        &["forward", "t.json", "--inputs=1,2,3"],
        &["schema", "assur triad"],
    );
    refused("kind-2", "m.toml", &sound, &["triad", "m.toml"], &["schema", "assur forward", "assur/triad/1"]);
}

#[test]
fn families_that_no_inputs_determine_are_refused() {
    let sound = HEAD.to_owned() + &LEG.repeat(3);
    for family in ["3-PP_R_", "3-_R_PP", "3-P_R_P", "PP_R_,P_R_P,_R_RR"] {
        let words = [family, "legs 1 and 2", "PP"];
        refused("undetermined", "m.toml", &sound, &["new", family, "--output", "new.toml"], &words);
    }
}

#[test]
fn questions_about_motion() {
    let sound = HEAD.to_owned() + &LEG.repeat(3);
    let cases: [(&[&str], &[&str]); 11] = [
        (&["inverse", "m.toml", "--pose=1,inf,0"], &["pose", "inf", "finite"]),
        (&["inverse", "m.toml", "--pose=1,2,0,4"], &["pose", "4 given", "must be 3"]),
        (&["velocity", "m.toml", "--pose=1,2,nan", "--mode=+++"], &["pose", "NaN"]),
        (&["velocity", "m.toml", "--pose=1,2,0", "--mode=++++"], &["\"++++\"", "3 signs"]),
        (&["velocity", "m.toml", "--pose=1,2,0", "--mode=+0+"], &["\"+0+\"", "3 signs"]),
        (&["velocity", "m.toml", "--pose=1,2,0", "--mode=+++", "--rates=1,2,3,4"], &["rates", "4 given"]),
        (&["velocity", "m.toml", "--pose=1,2,0", "--mode=+++", "--rates=1,2,inf"], &["rates", "inf"]),
        (&["velocity", "m.toml", "--pose=1,2,0", "--mode=+++", "--accelerations=1"], &["accelerations", "1 given"]),
        (&["velocity", "m.toml", "--pose=1,2,0", "--mode=+++", "--wrench=1,2"], &["wrench", "2 given"]),
        (&["singularities", "m.toml", "--phi=nan", "--svg", "out.svg"], &["phi", "NaN"]),
        (&["singularities", "m.toml", "--phi=0", "--mode=+", "--svg", "out.svg"], &["\"+\"", "3 signs"]),
    ];
    for (number, (arguments, words)) in cases.into_iter().enumerate() {
        refused(&format!("motion-{number}"), "m.toml", &sound, arguments, &[words, &["m.toml"]].concat());
    }
    // A picture that cannot be written leaves nothing else behind either.
    let map = ["singularities", "m.toml", "--phi=0.1", "--no-polynomial", "--mode=+++", "--map", "dexterity"];
    let files = ["--csv", "map.csv", "--svg", "no/where.svg"];
    refused("half", "m.toml", &sound, &[&map[..], &files[..]].concat(), &["no/where.svg", "cannot be written"]);
}

#[test]
fn wrong_usage() {
    let sound = HEAD.to_owned() + &LEG.repeat(3);
    let cases: [&[&str]; 10] = [
        &["forward", "m.toml"],
        &["forward", "m.toml", "--inputs=1,x,3"],
        &["forward", "m.toml", "--inputs=1,2,3", "--sgv", "a.svg"],
        &["forwards"],
        &["check"],
        &["derive"],
        &["velocity", "m.toml", "--pose=1,2,0", "--rate=1,2,3"],
        &["path", "m.toml", "--trough", "p.csv"],
        &["singularities", "m.toml", "--phi=0", "--map", "beauty"],
        &["inverse", "m.toml", "--pose=a,b,c"],
    ];
    for (number, arguments) in cases.into_iter().enumerate() {
        let (status, complaint) = ask(&format!("usage-{number}"), "m.toml", sound.as_bytes(), arguments);
        assert_eq!(status, Some(2), "{arguments:?}: {complaint}");
    }
}
