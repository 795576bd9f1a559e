//! The `liftsim` program: parse, call, say what went wrong, choose the exit code.

mod cli;

use cli::{Arguments, Failure, brief};
use std::process::ExitCode;

fn main() -> ExitCode {
    match Arguments::read().run() {
        Ok(code) => code,
        Err(Failure::Input(error)) => report(&error, 2),
        Err(Failure::Run(error)) => report(&error, 1),
        Err(Failure::Stopped { code, message }) => {
            cli::say(message);
            ExitCode::from(code)
        }
    }
}

fn report(error: &anyhow::Error, code: u8) -> ExitCode {
    cli::say(format_args!("error: {}", brief(format!("{error:#}"))));
    ExitCode::from(code)
}
