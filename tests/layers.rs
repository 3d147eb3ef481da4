//! The picture of the layers and the code say the same.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Who may import whom. `spatial` stands beside linkage … workspace, on `plane`; faces may use every layer but not what solves.
const MAY_IMPORT: &[(&str, &[&str])] = &[
    ("algebra", &[]),
    ("eliminate", &["algebra"]),
    ("certify", &["algebra"]),
    ("roots", &["algebra", "eliminate", "certify"]),
    ("solve", &["algebra", "eliminate", "certify", "roots"]),
    ("plane", &["algebra", "eliminate", "certify", "roots", "solve"]),
    ("linkage", &["algebra", "eliminate", "certify", "roots", "solve", "plane"]),
    ("manipulator", &["algebra", "eliminate", "certify", "roots", "solve", "plane", "linkage"]),
    ("workspace", &["algebra", "eliminate", "certify", "roots", "solve", "plane", "linkage", "manipulator"]),
    ("spatial", &["algebra", "eliminate", "certify", "roots", "solve", "plane"]),
    // Faces read problems and results; `solve` and `certify` only lend them the account and the verdict.
    ("exchange", &["certify", "solve", "plane", "linkage", "manipulator", "workspace", "spatial"]),
    ("plot", &["certify", "solve", "plane", "linkage", "manipulator", "workspace", "spatial"]),
];

#[test]
fn no_layer_knows_a_higher_one() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let rules: BTreeMap<&str, &[&str]> = MAY_IMPORT.iter().copied().collect();
    let mut imports = 0;
    for file in rust_files(&source) {
        let inside = file.strip_prefix(&source).expect("found below src");
        let layer =
            inside.iter().next().and_then(|name| name.to_str()).expect("names are plain").trim_end_matches(".rs");
        if ["lib", "bin"].contains(&layer) {
            continue;
        }
        let allowed = rules.get(layer).unwrap_or_else(|| panic!("src/{layer} has no place in the table of layers"));
        for imported in imported_layers(&fs::read_to_string(&file).expect("is readable")) {
            imports += 1;
            assert!(
                imported == layer || allowed.contains(&imported.as_str()),
                "{} uses crate::{imported}, which {layer} must not know",
                file.display()
            );
        }
    }
    assert!(imports > 10, "only {imports} imports found: does this test still read them?");
}

#[test]
fn imports_are_recognised() {
    let source = "use crate::solve::Account;\n    use crate::{algebra::Poly, roots, linkage::{Dyad, Pose}};\n// use crate::plot;\nlet x = crate::certify::Verdict::Proven;";
    assert_eq!(imported_layers(source), ["solve", "algebra", "roots", "linkage", "certify"]);
}

/// The first path segment after every `crate::` outside comments; of each entry where several stand in braces.
fn imported_layers(source: &str) -> Vec<String> {
    let code: Vec<&str> = source.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    let code = code.join("\n");
    let mut found = Vec::new();
    for (start, _) in code.match_indices("crate::") {
        // `$crate::` in macros and names that end in `crate` are no imports.
        if code[..start].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '$') {
            continue;
        }
        let rest = &code[start + "crate::".len()..];
        let name = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
        match rest.strip_prefix('{') {
            None => found.push(name(rest)),
            Some(list) => {
                let mut depth = 0;
                let mut expects_name = true;
                for (place, letter) in list.char_indices() {
                    match letter {
                        '{' => depth += 1,
                        '}' if depth == 0 => break,
                        '}' => depth -= 1,
                        ',' if depth == 0 => expects_name = true,
                        letter if expects_name && letter.is_alphabetic() => {
                            found.push(name(&list[place..]));
                            expects_name = false;
                        }
                        _ => {}
                    }
                }
            }
        }
    }
    // Items of the crate root, such as `crate::Triad`, are no layers.
    found.retain(|name| name.starts_with(|c: char| c.is_lowercase()));
    found
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("is a folder") {
        let path = entry.expect("is readable").path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}
