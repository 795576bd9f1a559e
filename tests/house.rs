//! The house: every file imports from floors below its room's, or from its own room.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of the library, from the ground floor up.
const FLOORS: &[&[&str]] = &[
    // Numbers, text and files without a domain.
    &[
        "rng", "simd", "stats", "values", "rule", "fields", "format", "files", "suggest", "counts",
    ],
    // The world, and what config, claims and pictures say, each without the others.
    &["signal", "whiten", "detect", "config", "claim", "plot"],
    // Estimators; what a point simulates.
    &["monitor", "scenario", "report"],
    &["chain", "detection", "experiment"],
    // Trials, planned and drawn.
    &["schedule", "figure"],
    &["plan"],
    &["pilot", "gate", "results"],
    // Counted.
    &["run"],
    &["study"],
];

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn files(directory: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The files of the library by their paths as modules, without comments and tests.
fn library() -> BTreeMap<String, String> {
    let mut found = Vec::new();
    files(&source(), &mut found);
    let mut library = BTreeMap::new();
    for path in found {
        let relative = path.strip_prefix(source()).unwrap().with_extension("");
        let parts: Vec<&str> = relative.iter().map(|part| part.to_str().unwrap()).collect();
        let is_program = ["lib", "main", "build", "cli"].contains(&parts[0]);
        if is_program || parts.contains(&"tests") {
            continue;
        }
        let module = parts.join("::");
        let module = module.strip_suffix("::mod").unwrap_or(&module).to_owned();
        let text = fs::read_to_string(&path).unwrap();
        let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        let code = text
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        library.insert(module, code.collect::<Vec<_>>().join("\n"));
    }
    library
}

/// One name that a file brings in.
struct Use {
    is_public: bool,
    path: String,
    name: String,
}

/// `a::{b, c as d}` as `a::b` and `a::c as d`.
fn expanded(tree: &str) -> Vec<String> {
    let Some((prefix, inner)) = tree.split_once('{') else {
        return vec![tree.trim().to_owned()];
    };
    let inner = inner.trim_end().strip_suffix('}').unwrap_or(inner);
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for c in inner.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        match c {
            ',' if depth == 0 => parts.push(String::new()),
            c => parts.last_mut().unwrap().push(c),
        }
    }
    let parts = parts.iter().filter(|part| !part.trim().is_empty());
    parts
        .flat_map(|part| expanded(&format!("{}{}", prefix.trim(), part.trim())))
        .collect()
}

fn uses(text: &str) -> Vec<Use> {
    let flat = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut uses = Vec::new();
    for statement in flat.split(';') {
        let Some((before, tree)) = statement.rsplit_once("use ") else {
            continue;
        };
        for path in expanded(tree) {
            let (path, alias) = path.split_once(" as ").unwrap_or((&path, ""));
            let last = path.rsplit("::").next().unwrap_or_default();
            uses.push(Use {
                is_public: before.trim_end().ends_with("pub") || before.trim_end().ends_with(')'),
                name: if alias.is_empty() {
                    last.to_owned()
                } else {
                    alias.trim().to_owned()
                },
                path: path.trim().to_owned(),
            });
        }
    }
    uses
}

struct House {
    library: BTreeMap<String, String>,
    uses: BTreeMap<String, Vec<Use>>,
}

impl House {
    fn new() -> Self {
        let library = library();
        let uses = library
            .iter()
            .map(|(module, text)| (module.clone(), uses(text)))
            .collect();
        Self { library, uses }
    }

    /// A path as written in `module`, from the root of the crate.
    fn absolute(&self, module: &str, path: &str) -> Option<Vec<String>> {
        let owned = |part: &str| part.to_owned();
        let mut base: Vec<String> = module.split("::").map(owned).collect();
        let mut parts: Vec<String> = path.split("::").map(owned).collect();
        match parts[0].as_str() {
            "crate" => return Some(parts.split_off(1)),
            "self" => drop(parts.remove(0)),
            "super" => {
                while parts.first().is_some_and(|part| part == "super") {
                    base.pop();
                    parts.remove(0);
                }
            }
            first if self.library.contains_key(&format!("{module}::{first}")) => {}
            _ => return None,
        }
        base.extend(parts);
        Some(base)
    }

    /// The file that an absolute path leads to, through what modules pass on.
    fn file(&self, path: &[String], depth: usize) -> Option<String> {
        let end = (1..=path.len())
            .rev()
            .find(|&end| self.library.contains_key(&path[..end].join("::")))?;
        let module = path[..end].join("::");
        let Some(name) = path.get(end).filter(|_| depth < 20) else {
            return Some(module);
        };
        let passed = self.uses[&module].iter().find(|of| of.name == *name);
        let further = passed
            .and_then(|of| self.absolute(&module, &of.path))
            .and_then(|path| self.file(&path, depth + 1));
        Some(further.unwrap_or(module))
    }

    /// The files that a file needs. What it only passes on it does not need.
    fn needs(&self, module: &str) -> BTreeSet<String> {
        let imported = self.uses[module]
            .iter()
            .filter(|of| !of.is_public)
            .map(|of| of.path.clone());
        let words =
            self.library[module].split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
        let named = words.filter(|word| word.contains("::") && !word.starts_with(':'));
        let statements: BTreeSet<&str> = self.uses[module]
            .iter()
            .map(|of| of.path.as_str())
            .collect();
        let named = named
            .map(|word| word.trim_end_matches(':').to_owned())
            .filter(|word| {
                !statements
                    .iter()
                    .any(|path| path.starts_with(word.as_str()))
            });
        imported
            .chain(named)
            .filter_map(|path| self.absolute(module, &path))
            .filter_map(|path| self.file(&path, 0))
            .filter(|file| file != module)
            .collect()
    }
}

fn room(module: &str) -> &str {
    module.split("::").next().unwrap()
}

#[test]
fn imports_go_down() {
    let house = House::new();
    let floors: BTreeMap<&str, usize> = (FLOORS.iter().enumerate())
        .flat_map(|(floor, rooms)| rooms.iter().map(move |room| (*room, floor)))
        .collect();
    let mut needs = 0;
    for module in house.library.keys() {
        let own = room(module);
        let floor = floors
            .get(own)
            .unwrap_or_else(|| panic!("{own} has no floor: give it one"));
        for file in house.needs(module) {
            needs += 1;
            let other = room(&file);
            assert!(
                other == own || floors[other] < *floor,
                "{module} (floor {floor}) imports {file} (floor {})",
                floors[other]
            );
        }
    }
    assert!(needs > 200, "the test reads the imports");
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
        for word in ["clap::", "anyhow::", "indicatif::", "process::exit"] {
            assert!(!text.contains(word), "{}: {word}", relative.display());
        }
    }
}

/// `eprintln!` panics where standard error is full; the program says things by `cli::say`.
#[test]
fn no_message_can_panic() {
    let mut found = Vec::new();
    files(&source(), &mut found);
    for path in found {
        let text = fs::read_to_string(&path).unwrap();
        assert!(!text.contains("eprint"), "{}", path.display());
    }
}
