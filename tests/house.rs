//! The house: every file imports from floors below its room's, or from its own room.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of the library, from the ground floor up.
const FLOORS: &[&[&str]] = &[
    // Numbers, text and files without a domain.
    &[
        "rng", "simd", "series", "stats", "kalman", "fields", "format", "files", "suggest",
        "counts", "npz", "vector",
    ],
    // What a value must be; lines to a listener.
    &["rule", "outbox"],
    &["values"],
    // The world, and what config, claims and pictures say, each without the others.
    &[
        "signal",
        "recording",
        "whiten",
        "detect",
        "config",
        "claim",
        "plot",
    ],
    // What a record may hold.
    &["explain"],
    // Lifts, estimators; what a point simulates.
    &["lift", "monitor", "scenario", "report"],
    &["chain", "detection", "experiment"],
    // How far trips went; trials, planned and drawn.
    &["track", "schedule"],
    &["plan", "figure"],
    &["page", "pilot", "gate", "results"],
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

/// The names that a file brings in, and its code without the statements that do so.
fn split(text: &str) -> (Vec<Use>, String) {
    let (mut uses, mut code) = (Vec::new(), String::new());
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let Some((before, tree)) = line.split_once("use ").filter(|(before, _)| {
            let before = before.trim();
            before.is_empty() || before == "pub" || before.starts_with("pub(")
        }) else {
            code.extend([line, "\n"]);
            continue;
        };
        let mut tree = tree.to_owned();
        while !tree.ends_with(';') {
            tree.push_str(lines.next().unwrap().trim());
        }
        for path in expanded(tree.trim_end_matches(';')) {
            let (path, alias) = path.split_once(" as ").unwrap_or((&path, ""));
            let last = path.rsplit("::").next().unwrap();
            uses.push(Use {
                is_public: !before.trim().is_empty(),
                name: if alias.is_empty() { last } else { alias }.to_owned(),
                path: path.to_owned(),
            });
        }
    }
    (uses, code)
}

struct House {
    code: BTreeMap<String, String>,
    uses: BTreeMap<String, Vec<Use>>,
}

impl House {
    fn new() -> Self {
        let (mut code, mut uses) = (BTreeMap::new(), BTreeMap::new());
        for (module, text) in library() {
            let (names, rest) = split(&text);
            code.insert(module.clone(), rest);
            uses.insert(module, names);
        }
        Self { code, uses }
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
            first if self.code.contains_key(&format!("{module}::{first}")) => {}
            _ => return None,
        }
        base.extend(parts);
        Some(base)
    }

    /// The file that an absolute path leads to, through what modules pass on.
    fn file(&self, path: &[String], depth: usize) -> Option<String> {
        let end = (1..=path.len())
            .rev()
            .find(|&end| self.code.contains_key(&path[..end].join("::")))?;
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
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let code = &self.code[module];
        // A variable may be called like a function that is passed on.
        let is_used = |name: &str| {
            code.match_indices(name).any(|(at, _)| {
                let before = code[..at].chars().next_back();
                let after = code[at + name.len()..].chars().next();
                !before.is_some_and(|c| is_word(c) || c == '.')
                    && !after.is_some_and(is_word)
                    && (name.starts_with(char::is_uppercase) || after == Some('('))
            })
        };
        let imported = (self.uses[module].iter())
            .filter(|of| !of.is_public || is_used(&of.name))
            .map(|of| of.path.as_str());
        let paths = (code.split(|c| !(is_word(c) || c == ':')))
            .filter(|path| path.contains("::") && !path.starts_with(':'))
            .map(|path| path.trim_end_matches(':'));
        imported
            .chain(paths)
            .filter_map(|path| self.absolute(module, path))
            .filter_map(|path| self.file(&path, 0))
            .filter(|file| file != module)
            .collect()
    }

    /// The files that need each other, by way of others too, as one circle each.
    fn circles(&self) -> BTreeSet<BTreeSet<String>> {
        let needs: BTreeMap<&str, BTreeSet<String>> = (self.code.keys())
            .map(|module| (module.as_str(), self.needs(module)))
            .collect();
        let reached = |from: &str| {
            let (mut reached, mut next) = (BTreeSet::new(), vec![from.to_owned()]);
            while let Some(module) = next.pop() {
                for needed in &needs[module.as_str()] {
                    if reached.insert(needed.clone()) {
                        next.push(needed.clone());
                    }
                }
            }
            reached
        };
        let reached: BTreeMap<&str, BTreeSet<String>> =
            (needs.keys().map(|module| (*module, reached(module)))).collect();
        (reached.iter())
            .map(|(module, others)| {
                let back = others
                    .iter()
                    .filter(|of| reached[of.as_str()].contains(*module));
                back.cloned().collect()
            })
            .filter(|circle: &BTreeSet<String>| circle.len() > 1)
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
    for module in house.code.keys() {
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

/// Files that need each other can only be read together.
#[test]
fn no_files_form_a_circle() {
    let circles: Vec<String> = (House::new().circles().iter())
        .map(|circle| circle.iter().cloned().collect::<Vec<_>>().join(", "))
        .collect();
    assert!(circles.is_empty(), "circles:\n{}", circles.join("\n"));
}

/// Pictures, verdicts and files are made of values, wherever these come from; a config is text and places, whatever
/// these mean.
#[test]
fn configs_and_what_is_made_of_them_are_apart() {
    let house = House::new();
    for module in house.code.keys() {
        let own = room(module);
        for file in house.needs(module) {
            let other = room(&file);
            if ["plot", "figure", "claim", "results"].contains(&own) {
                assert!(other != "config", "{module} imports {file}");
            }
            if own == "config" {
                let known = ["config", "rule", "format", "suggest", "files"];
                assert!(known.contains(&other), "{module} imports {file}");
            }
        }
    }
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
