//! The guide says what the program does: every command in it is run, and what stands under it is what is printed; no link leads nowhere.
//!
//! In a block marked `console` a line with `$` is a command, what follows is its output, and `...` stands for any lines. Rust blocks are tests of the library
//! (`src/lib.rs`); plain `sh` blocks are for the reader.
#![cfg(feature = "cli")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn pages() -> Vec<PathBuf> {
    let source = root().join("docs/src");
    let folders = [source.clone(), source.join("catalogue")];
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).expect("the guide's folder"));
    let files = files.map(|entry| entry.expect("is readable").path());
    let mut pages: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|ending| ending == "md")).collect();
    pages.sort();
    pages
}

/// A command and the lines expected under it.
struct Step {
    command: String,
    expected: Vec<String>,
}

fn steps(text: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut inside = false;
    for line in text.lines() {
        match line {
            "```console" => inside = true,
            _ if line.starts_with("```") => inside = false,
            _ if !inside => {}
            _ => match (line.strip_prefix("$ "), steps.last_mut()) {
                (Some(command), _) => steps.push(Step { command: command.to_owned(), expected: Vec::new() }),
                (None, Some(step)) => step.expected.push(line.trim_end().to_owned()),
                (None, None) => panic!("output before any command: {line}"),
            },
        }
    }
    steps
}

/// Whether the lines printed are the expected ones, `...` for any.
fn fits(expected: &[String], printed: &[&str]) -> bool {
    match expected.split_first() {
        None => printed.is_empty(),
        Some((first, rest)) if first == "..." => (0..=printed.len()).any(|skip| fits(rest, &printed[skip..])),
        Some((first, rest)) => {
            printed.first().is_some_and(|line| line.trim_end() == first) && fits(rest, &printed[1..])
        }
    }
}

#[test]
fn every_command_prints_what_stands_under_it() {
    let program = Path::new(env!("CARGO_BIN_EXE_assur"));
    let folder = program.parent().expect("lies in a folder");
    let path = format!("{}:{}", folder.display(), std::env::var("PATH").unwrap_or_default());
    fs::create_dir_all(root().join("target")).expect("can be written");
    let (mut wrong, mut count) = (Vec::new(), 0);
    for page in pages() {
        for step in steps(&fs::read_to_string(&page).expect("is readable")) {
            count += 1;
            let mut shell = Command::new("bash");
            shell.args(["-c", &format!("exec 2>&1; {}", step.command)]);
            let ran = shell.current_dir(root()).env("PATH", &path).env("NO_COLOR", "1").output().expect("bash runs");
            let printed = String::from_utf8_lossy(&ran.stdout).into_owned();
            let lines: Vec<&str> = printed.lines().collect();
            if !fits(&step.expected, &lines) {
                wrong.push(format!("{}\n$ {}\n{printed}", page.display(), step.command));
            }
        }
    }
    assert!(wrong.is_empty(), "the guide shows another output than:\n{}", wrong.join("\n"));
    assert!(count > 20, "only {count} commands found: does this test still read them?");
}

#[test]
fn no_link_leads_nowhere() {
    let source = root().join("docs/src");
    let drawn = fs::read_to_string(root().join("docs/build.sh")).expect("is readable");
    let summary = fs::read_to_string(source.join("SUMMARY.md")).expect("is readable");
    let mut linked = BTreeSet::new();
    for page in pages() {
        let text = fs::read_to_string(&page).expect("is readable");
        let folder = page.parent().expect("lies in a folder");
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let path = folder.join(target);
            if let Some(name) = target.split('/').next_back().filter(|_| target.contains("pictures/")) {
                let name = name.trim_end_matches(".svg");
                assert!(
                    drawn.contains(&format!("draw {name} ")) || name.starts_with("family-"),
                    "{}: no {target} is drawn",
                    page.display()
                );
                continue;
            }
            assert!(path.is_file(), "{}: {target} does not exist", page.display());
            linked.insert(path.canonicalize().expect("exists"));
        }
        for target in text.split("{{#include ").skip(1).filter_map(|rest| rest.split("}}").next()) {
            // That one is written with the pictures.
            let written = target == "pictures/explorer.md" && drawn.contains("$pictures/explorer.md");
            assert!(written || folder.join(target).is_file(), "{}: {target} does not exist", page.display());
        }
        let name = page.strip_prefix(&source).expect("lies in the guide").display().to_string();
        assert!(name == "SUMMARY.md" || summary.contains(&format!("({name})")), "{name} is not in the summary");
    }
    assert!(linked.len() > 15);
}
