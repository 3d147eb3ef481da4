//! Batches through the command line: the same answers as one by one, in every form of file; nothing lost or doubled by a kill.
#![cfg(feature = "cli")]

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;

fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_assur"));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command
}

fn run(arguments: &[&str]) -> Output {
    program().args(arguments).output().expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// An empty folder of this test's own.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("batch-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn shown(path: &Path) -> &str {
    path.to_str().expect("a plain name")
}

/// Rows of inputs for the six-mode 3-RPR, within its limits.
fn inputs(rows: usize) -> String {
    let mut out = "q1,q2,q3\n".to_owned();
    for row in 0..rows {
        let q = |step: usize| 8.5 + (row * step % 9973) as f64 * 1e-3;
        out += &format!("{},{},{}\n", q(7), q(911), q(4001));
    }
    out
}

const MODEL: &str = "examples/3-rpr.toml";

#[test]
fn every_row_has_the_modes_that_forward_gives() {
    let folder = folder("rows");
    let (input, csv) = (folder.join("in.csv"), folder.join("out.csv"));
    let rows = inputs(40);
    fs::write(&input, &rows).expect("written");
    let done = run(&["forward", MODEL, "--batch", shown(&input), "--output", shown(&csv)]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(text(&done.stdout).starts_with("40 rows solved"), "{}", text(&done.stdout));
    let table = fs::read_to_string(&csv).expect("an output");
    let mut lines = table.lines();
    let header = lines.next().expect("a header");
    assert!(header.starts_with("row,q1,q2,q3,status,count,x1,y1,phi1,x2") && header.ends_with("x6,y6,phi6"));
    for ((number, line), given) in (1..).zip(lines).zip(rows.lines().skip(1)).step_by(9) {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields.len(), 24);
        assert_eq!((fields[0].parse(), fields[4]), (Ok(number), "complete"));
        let one = run(&["forward", MODEL, &format!("--inputs={given}"), "--json"]);
        let report: serde_json::Value = serde_json::from_slice(&one.stdout).expect("a report");
        let modes = report["modes"].as_array().expect("modes");
        assert_eq!(fields[5].parse(), Ok(modes.len()));
        for (k, mode) in modes.iter().enumerate() {
            for j in 0..3 {
                let found: f64 = fields[6 + 3 * k + j].parse().expect("a number");
                assert!((found - mode["pose"][j].as_f64().expect("a number")).abs() < 1e-9);
            }
        }
        assert!(fields[6 + 3 * modes.len()..].iter().all(|field| field.is_empty()));
    }
}

#[test]
fn all_forms_of_output_say_the_same() {
    let folder = folder("forms");
    let input = folder.join("in.jsonl");
    let lines: String = inputs(60_000).lines().skip(1).map(|line| format!("[{line}]\n")).collect();
    fs::write(&input, &lines).expect("written");
    let outputs = ["csv", "jsonl", "parquet"].map(|ending| folder.join(format!("out.{ending}")));
    for output in &outputs {
        let done = run(&["forward", MODEL, "--batch", shown(&input), "--output", shown(output), "--json"]);
        let summary: serde_json::Value = serde_json::from_slice(&done.stdout).expect("a summary");
        assert_eq!((&summary["rows"], &summary["rejected"]), (&60_000.into(), &0.into()));
    }
    let table = fs::read_to_string(&outputs[0]).expect("a table");
    let names: Vec<&str> = table.lines().next().expect("a header").split(',').collect();
    let json = fs::read_to_string(&outputs[1]).expect("lines");
    let file = SerializedFileReader::new(fs::File::open(&outputs[2]).expect("a file")).expect("Parquet");
    assert!(file.metadata().num_row_groups() > 1, "more than one block");
    let columns = file.metadata().file_metadata().schema_descr();
    assert_eq!((0..24).map(|k| columns.column(k).name().to_owned()).collect::<Vec<_>>(), names);
    let records = file.get_row_iter(None).expect("rows");
    let mut compared = 0;
    for ((line, object), record) in table.lines().skip(1).zip(json.lines()).zip(records) {
        let record = record.expect("a row");
        let object: serde_json::Value = serde_json::from_str(object).expect("an object");
        for (k, (name, field)) in names.iter().zip(line.split(',')).enumerate() {
            match *name {
                "row" => assert_eq!(field.parse(), Ok(record.get_long(k).expect("a number"))),
                "count" => assert_eq!(field.parse(), Ok(record.get_int(k).expect("a number"))),
                "status" => assert_eq!(field, record.get_string(k).expect("a text")),
                _ if field.is_empty() => {
                    assert!(record.get_double(k).is_err() && object.get(name).is_none());
                    continue;
                }
                _ => {
                    assert_eq!(field.parse(), Ok(record.get_double(k).expect("a number")));
                    assert_eq!(field.parse().ok(), object[*name].as_f64());
                }
            }
        }
        compared += 1;
    }
    assert_eq!(compared, 60_000);
}

#[test]
fn bad_rows_go_to_the_rejects_with_their_number() {
    let folder = folder("rejects");
    let (input, output) = (folder.join("in.csv"), folder.join("out.csv"));
    fs::write(&input, "q1,q2,q3\n14.98,15.38,12\n14.98,nan,12\n1,2\n14.98,x,12\n14.98,15.38,12\n").expect("written");
    let rejects = folder.join("out.csv.rejects.csv");
    let done = run(&["forward", MODEL, "--batch", shown(&input), "--output", shown(&output)]);
    assert!(done.status.success() && text(&done.stdout).contains("rows rejected"), "{}", text(&done.stdout));
    let found = fs::read_to_string(&rejects).expect("rejects");
    let lines: Vec<&str> = found.lines().collect();
    assert_eq!(lines[0], "row,reason");
    for (line, (row, word)) in lines[1..].iter().zip([(2, "q2"), (3, "2 values"), (4, "\"\"x\"\"")]) {
        assert!(line.starts_with(&format!("{row},")) && line.contains(word), "{line}");
    }
    assert_eq!(lines.len(), 4);
    let rows: Vec<String> = fs::read_to_string(&output).expect("rows").lines().map(str::to_owned).collect();
    assert_eq!(rows.len(), 3);
    assert!(rows[1].starts_with("1,") && rows[2].starts_with("5,"));
    // A batch without bad rows leaves no rejects of an earlier one.
    fs::write(&input, inputs(3)).expect("written");
    assert!(run(&["forward", MODEL, "--batch", shown(&input), "--output", shown(&output)]).status.success());
    assert!(!rejects.exists());
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 2, "no parts are left");
}

#[test]
fn a_killed_run_is_taken_up_and_yields_the_same_file() {
    let folder = folder("kill");
    let input = folder.join("in.csv");
    fs::write(&input, inputs(400_000)).expect("written");
    for ending in ["csv", "parquet"] {
        let (whole, killed) = (folder.join(format!("whole.{ending}")), folder.join(format!("killed.{ending}")));
        assert!(run(&["forward", MODEL, "--batch", shown(&input), "--output", shown(&whole)]).status.success());
        let arguments = ["forward", MODEL, "--batch", shown(&input), "--output", shown(&killed), "--json"];
        let mut child = program().args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("starts");
        let parts = folder.join(format!("killed.{ending}.parts"));
        let begun = Instant::now();
        let done = || {
            fs::read_dir(&parts)
                .map_or(0, |parts| parts.flatten().filter(|p| shown(&p.path()).ends_with(".done")).count())
        };
        while done() == 0 && begun.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().expect("killed");
        child.wait().expect("ended");
        assert!(!killed.exists(), "an output that looks complete is not");
        let again = run(&arguments);
        assert!(again.status.success(), "{}", text(&again.stderr));
        let summary: serde_json::Value = serde_json::from_slice(&again.stdout).expect("a summary");
        assert!(summary["taken_up"].as_u64() > Some(0), "{summary}");
        assert_eq!(summary["rows"].as_u64(), Some(400_000));
        assert!(fs::read(&whole).expect("read") == fs::read(&killed).expect("read"), "the files differ");
        assert!(!parts.exists());
    }
}

#[test]
fn parts_of_another_question_are_not_taken_up() {
    let folder = folder("other");
    let (input, output) = (folder.join("in.csv"), folder.join("out.csv"));
    fs::write(&input, inputs(10)).expect("written");
    let parts = folder.join("out.csv.parts");
    fs::create_dir_all(&parts).expect("a folder");
    fs::write(parts.join("00000000-0123456789abcdef.rows"), "not mine").expect("written");
    fs::write(parts.join("00000000-0123456789abcdef.done"), "10 0").expect("written");
    fs::write(parts.join("notes.txt"), "the user's own").expect("written");
    assert!(run(&["forward", MODEL, "--batch", shown(&input), "--output", shown(&output)]).status.success());
    let table = fs::read_to_string(&output).expect("rows");
    assert!(table.lines().count() == 11 && !table.contains("not mine"));
    assert_eq!(fs::read_to_string(parts.join("notes.txt")).expect("left alone"), "the user's own");
}

#[test]
fn standard_input_and_output_serve_as_files() {
    let mut child = program()
        .args(["forward", MODEL, "--batch", "-", "--output", "-", "--format", "jsonl"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("starts");
    child.stdin.take().expect("piped").write_all(b"q1,q2,q3\n14.98,15.38,12\noops,1,2\n").expect("written");
    let done = child.wait_with_output().expect("ends");
    let lines = text(&done.stdout);
    assert!(done.status.success() && lines.lines().count() == 1, "{lines}");
    let row: serde_json::Value = serde_json::from_str(&lines).expect("an object");
    assert_eq!((row["row"].as_u64(), row["count"].as_u64()), (Some(1), Some(6)));
    let messages = text(&done.stderr);
    assert!(messages.contains("oops") && messages.contains("1 rows rejected"), "{messages}");
}

#[test]
fn what_cannot_be_begun_leaves_nothing_behind() {
    let folder = folder("bad");
    let input = folder.join("in.csv");
    fs::write(&input, "a,b\n1,2\n").expect("written");
    let sound = folder.join("sound.csv");
    fs::write(&sound, inputs(3)).expect("written");
    let output = folder.join("out.csv");
    let cases: &[(&[&str], &str)] = &[
        (&["--batch", shown(&input), "--output", shown(&output)], "header \"a,b\" has no column q1"),
        (&["--batch", "/nowhere/in.csv", "--output", shown(&output)], "/nowhere/in.csv: cannot be read"),
        (&["--batch", shown(&sound), "--output", "/nowhere/out.csv"], "/nowhere/out.csv.parts: cannot be written"),
        (&["--batch", shown(&input), "--output", shown(&folder)], "the name tells no form"),
        (&["--batch", "in.parquet", "--output", shown(&output)], "in.parquet"),
    ];
    for (arguments, word) in cases {
        let arguments = [&["forward", MODEL][..], arguments].concat();
        let refused = run(&arguments);
        assert_eq!(refused.status.code(), Some(1), "{arguments:?}");
        assert!(text(&refused.stderr).contains(word), "{word}: {}", text(&refused.stderr));
    }
    assert_eq!(run(&["forward", MODEL, "--batch", shown(&input)]).status.code(), Some(2));
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 2);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_named() {
    let folder = folder("full");
    let input = folder.join("in.csv");
    fs::write(&input, inputs(30_000)).expect("written");
    let refused = run(&["forward", MODEL, "--batch", shown(&input), "--output", "/dev/full", "--format", "csv"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(text(&refused.stderr).contains("/dev/full: cannot be written"), "{}", text(&refused.stderr));
}

#[test]
fn angles_are_in_the_unit_of_the_model() {
    let folder = folder("degrees");
    let (input, output) = (folder.join("in.csv"), folder.join("out.csv"));
    let model = "examples/3-rrr.toml";
    let inverse = run(&["inverse", model, "--pose=5.5,4,17", "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&inverse.stdout).expect("a report");
    let joints = &report["modes"][0]["joints"];
    let q = [0, 1, 2].map(|leg| joints[leg][0].as_f64().expect("an angle").to_degrees());
    fs::write(&input, format!("q1,q2,q3\n{},{},{}\n", q[0], q[1], q[2])).expect("written");
    assert!(run(&["forward", model, "--batch", shown(&input), "--output", shown(&output)]).status.success());
    let table = fs::read_to_string(&output).expect("rows");
    let fields: Vec<f64> = table.lines().nth(1).expect("a row").split(',').skip(6).flat_map(str::parse).collect();
    let found = fields.chunks(3).any(|p| (p[0] - 5.5).abs() + (p[1] - 4.0).abs() + (p[2] - 17.0).abs() < 1e-8);
    assert!(found, "{fields:?}");
}

#[test]
fn what_is_read_is_not_written_over() {
    let folder = folder("same");
    let input = folder.join("in.csv");
    fs::write(&input, inputs(5)).expect("written");
    let refused = run(&["forward", MODEL, "--batch", shown(&input), "--output", shown(&input)]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(text(&refused.stderr).contains("must not be written over"), "{}", text(&refused.stderr));
    assert_eq!(fs::read_to_string(&input).expect("still there"), inputs(5));
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
}

#[cfg(unix)]
#[test]
fn a_link_is_followed() {
    let folder = folder("link");
    let (input, target, link) = (folder.join("in.csv"), folder.join("target.csv"), folder.join("link.csv"));
    fs::write(&input, inputs(5)).expect("written");
    fs::write(&target, "old").expect("written");
    std::os::unix::fs::symlink(&target, &link).expect("a link");
    assert!(run(&["forward", MODEL, "--batch", shown(&input), "--output", shown(&link)]).status.success());
    assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
    assert_eq!(fs::read_to_string(&target).expect("rows").lines().count(), 6);
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_a_run_that_waits_for_input() {
    let folder = folder("interrupt");
    let output = folder.join("out.csv");
    let mut child = program()
        .args(["forward", MODEL, "--batch", "-", "--output", shown(&output)])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("starts");
    let mut pipe = child.stdin.take().expect("piped");
    pipe.write_all(b"q1,q2,q3\n14.98,15.38,12\n").expect("written");
    pipe.flush().expect("written");
    std::thread::sleep(Duration::from_millis(300));
    // A shell starts what it runs in the background with interrupts ignored, and these tests hand that on.
    let ignored = fs::read_to_string("/proc/self/status").is_ok_and(|status| {
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask & 2 != 0)
    });
    let signal = if ignored { "-TERM" } else { "-INT" };
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().expect("kill").success());
    let begun = Instant::now();
    let ended = loop {
        if let Some(status) = child.try_wait().expect("a child") {
            break status;
        }
        assert!(begun.elapsed() < Duration::from_secs(20), "the run goes on");
        std::thread::sleep(Duration::from_millis(10));
    };
    drop(pipe);
    assert!(!ended.success() && !output.exists());
}
