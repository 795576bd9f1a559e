//! The real binary, run the way users run it.

mod bad_input;
mod browser;
mod commands;
mod completions;
mod figures;
mod formats;
mod gate;
mod installed;
mod keys;
mod network;
mod order;
mod outputs;
mod page;
mod per_hour;
mod recordings;
mod remedies;
mod replay;
mod report_page;
mod results;
mod service;
mod shards;
mod simulate;
mod studies;
mod survival;
mod track;

use assert_cmd::Command;
use std::path::{Path, PathBuf};

/// `liftsim` in the project's own directory.
fn liftsim() -> Command {
    let mut command = Command::cargo_bin("liftsim").expect("the binary is built with the tests");
    command.current_dir(project());
    command
}

fn project() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A config of the tests.
fn config(name: &str) -> PathBuf {
    project().join("tests/program/configs").join(name)
}

/// Exit code, standard output, standard error.
fn outcome(command: &mut Command) -> (i32, String, String) {
    let output = command.output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("the program writes UTF-8");
    (
        output.status.code().expect("the program ends by itself"),
        text(output.stdout),
        text(output.stderr),
    )
}
