//! Tells the program which revision it was built from, and gives it the configs to carry.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// What the program is made of.
const SOURCES: [&str; 4] = ["src", "configs", "Cargo.toml", "Cargo.lock"];

fn main() {
    // A path that is not there would rebuild the program every time.
    let sources = SOURCES.into_iter().map(PathBuf::from);
    for path in sources.chain(head()).filter(|path| path.exists()) {
        println!("cargo::rerun-if-changed={}", path.display());
    }
    let revision = packed().or_else(checked_out);
    let revision = revision.unwrap_or_else(|| "unknown".to_owned());
    println!("cargo::rustc-env=LIFTSIM_REVISION={revision}");
    let out = env::var_os("OUT_DIR").expect("cargo sets it");
    fs::write(Path::new(&out).join("shipped.rs"), shipped()).expect("it can be written");
}

/// The revision that a package was made from. It has no history, and may lie in that of something else.
fn packed() -> Option<String> {
    let text = fs::read_to_string(".cargo_vcs_info.json").ok()?;
    let (_, rest) = text.split_once("\"sha1\": \"")?;
    let (revision, rest) = rest.split_once('"')?;
    Some(noted(revision, rest.contains("\"dirty\": true")))
}

/// The revision of a checkout.
fn checked_out() -> Option<String> {
    let revision = git(&["rev-parse", "HEAD"])?;
    let status = ["status", "--porcelain", "--untracked-files=no", "--"];
    let changes = git(&[&status[..], &SOURCES].concat());
    let is_modified = changes.is_some_and(|changes| !changes.is_empty());
    Some(noted(&revision, is_modified))
}

fn noted(revision: &str, is_modified: bool) -> String {
    let note = if is_modified { ", modified" } else { "" };
    format!("{revision}{note}")
}

/// The configs of both folders as an array, by name.
fn shipped() -> String {
    let of_command = |command, folder: &str| {
        let root = env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it");
        let entries = fs::read_dir(Path::new(&root).join(folder)).expect("the folder is there");
        let paths = entries.map(|entry| entry.expect("it can be listed").path());
        let configs = paths.filter(|path| path.extension().is_some_and(|end| end == "toml"));
        let entry = |path: PathBuf| {
            let name = path.file_stem().expect("it has a name").to_owned();
            format!(
                "Shipped {{ name: {name:?}, command: {command:?}, text: include_str!({path:?}) }},\n"
            )
        };
        configs.map(entry).collect::<Vec<_>>()
    };
    let mut all = of_command("sweep", "configs");
    all.extend(of_command("simulate", "configs/simulate"));
    all.sort();
    format!("&[{}]", all.concat())
}

/// The files that change when another revision is checked out or committed: HEAD, and the branch that it names, or
/// where git will put that. The index is not among them, for `git status` writes it.
fn head() -> Vec<PathBuf> {
    let path = |name: &str| git(&["rev-parse", "--git-path", name]).map(PathBuf::from);
    let branch = git(&["symbolic-ref", "--quiet", "HEAD"]).and_then(|branch| path(&branch));
    let branch = branch.and_then(|file| existing(&file));
    path("HEAD").into_iter().chain(branch).collect()
}

/// `path`, or the nearest folder above it that exists.
fn existing(path: &Path) -> Option<PathBuf> {
    let mut places = path.ancestors();
    places.find(|place| place.exists()).map(Path::to_owned)
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
