//! The house: a module imports only from floors below its own.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Each module of the library and its floor.
const FLOORS: [&[&str]; 9] = [
    &["rng", "stats", "format", "simd", "suggest"],
    &["ledger", "claim"],
    &["signal", "whiten", "detect"],
    &["chain", "monitor"],
    &["config", "ensemble", "detection"],
    &["plan"],
    &["pilot", "run", "gate", "results"],
    &["exhibit"],
    &["figure", "report", "campaign"],
];

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn files(directory: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => files(&path, found),
            false if path.extension().is_some_and(|e| e == "rs") => found.push(path),
            false => {}
        }
    }
}

/// The part of a file that is compiled into the library.
fn without_tests(text: &str) -> &str {
    text.split("#[cfg(test)]\nmod tests {").next().unwrap()
}

#[test]
fn imports_go_down() {
    let floors: BTreeMap<&str, usize> = FLOORS
        .iter()
        .enumerate()
        .flat_map(|(floor, modules)| modules.iter().map(move |module| (*module, floor)))
        .collect();
    let mut found = Vec::new();
    files(&source(), &mut found);
    let mut imports = 0;
    for path in found {
        let relative = path.strip_prefix(source()).unwrap();
        let module = relative
            .iter()
            .next()
            .unwrap()
            .to_str()
            .unwrap()
            .trim_end_matches(".rs");
        if ["lib", "main", "cli", "build"].contains(&module) || relative.ends_with("tests.rs") {
            continue;
        }
        let floor = floors
            .get(module)
            .unwrap_or_else(|| panic!("{module} has no floor: give it one"));
        let text = fs::read_to_string(&path).unwrap();
        for line in without_tests(&text)
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"))
        {
            for part in line.split("crate::").skip(1) {
                let name: String = part
                    .chars()
                    .take_while(|c| c.is_alphanumeric() || *c == '_')
                    .collect();
                let below = floors.get(name.as_str()).copied();
                imports += 1;
                assert!(
                    name == module || below.is_some_and(|below| below < *floor),
                    "{}: {module} (floor {floor}) imports {name} (floor {below:?})",
                    relative.display()
                );
            }
        }
    }
    assert!(imports > 20, "the test reads the imports");
}

/// Terminals, argument lists and exit codes belong to the program, not to the library.
#[test]
fn only_the_program_knows_the_terminal() {
    let mut found = Vec::new();
    files(&source(), &mut found);
    for path in found {
        let relative = path.strip_prefix(source()).unwrap();
        if relative.starts_with("cli") || relative == Path::new("main.rs") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        for word in [
            "clap::",
            "anyhow::",
            "indicatif::",
            "process::exit",
            "eprintln!",
        ] {
            assert!(!text.contains(word), "{}: {word}", relative.display());
        }
    }
}
