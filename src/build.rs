//! Tells the program which revision it was built from.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What the program is made of.
const SOURCES: [&str; 3] = ["src", "Cargo.toml", "Cargo.lock"];

fn main() {
    // A path that is not there would rebuild the program every time.
    let sources = SOURCES.into_iter().map(PathBuf::from);
    for path in sources.chain(head()).filter(|path| path.exists()) {
        println!("cargo::rerun-if-changed={}", path.display());
    }
    let revision = git(&["rev-parse", "HEAD"]).unwrap_or_else(|| "unknown".to_owned());
    let status = ["status", "--porcelain", "--untracked-files=no", "--"];
    let changes = git(&[&status[..], &SOURCES].concat());
    let is_clean = changes.is_none_or(|changes| changes.is_empty());
    let note = if is_clean { "" } else { ", modified" };
    println!("cargo::rustc-env=LIFTSIM_REVISION={revision}{note}");
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
