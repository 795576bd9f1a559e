//! The `liftsim` program: parse, call, say what went wrong, choose the exit code.

mod cli;

use cli::Arguments;
use std::process::ExitCode;

fn main() -> ExitCode {
    match Arguments::read().run() {
        Ok(code) => code,
        Err(failure) => ExitCode::from(failure.report()),
    }
}
