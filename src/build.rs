//! Tells the program which revision it was built from.

use std::path::Path;
use std::process::Command;

fn main() {
    for path in ["src", "Cargo.toml", "Cargo.lock", ".git/HEAD", ".git/index"] {
        // A path that is not there would rebuild the program every time.
        if Path::new(path).exists() {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    let revision = git(&["rev-parse", "HEAD"]).unwrap_or_else(|| "unknown".to_owned());
    let is_clean =
        git(&["status", "--porcelain", "--untracked-files=no"]).is_none_or(|s| s.is_empty());
    let note = if is_clean { "" } else { ", modified" };
    println!("cargo::rustc-env=LIFTSIM_REVISION={revision}{note}");
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
