//! `liftsim completions SHELL`, and what may follow where a shell asks.

use super::{CommandResult, keys, new, print};
use clap::builder::StyledStr;
use clap::{Args, Command};
use clap_complete::Shell;
use clap_complete::engine::{
    ArgValueCandidates, ArgValueCompleter, CompletionCandidate as Candidate, PathCompleter,
    ValueCompleter,
};
use clap_complete::env::{CompleteEnv, Shells};
use liftsim::config::{SHIPPED, Shipped};
use std::ffi::OsStr;
use std::path::Path;
use std::process::ExitCode;

/// The variable by which a script asks.
const ASKED: &str = "LIFTSIM_COMPLETE";

/// Print a script by which a shell completes commands, flags, their values, and the names of shipped configs.
///
/// The script asks `liftsim` on the path what may follow.
#[derive(Debug, Args)]
#[command(after_help = "Where it goes:\n  \
    bash  ~/.bashrc: source <(liftsim completions bash)\n  \
    zsh   ~/.zshrc, after compinit: source <(liftsim completions zsh)\n  \
    fish  ~/.config/fish/completions/liftsim.fish: liftsim completions fish | source")]
pub struct Completions {
    /// Which shell.
    shell: Shell,
}

impl Completions {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let (shells, name) = (Shells::builtins(), self.shell.to_string());
        let shell = shells.completer(&name).expect("the same shells are known");
        let mut script = Vec::new();
        let written = shell.write_registration(ASKED, "liftsim", "liftsim", "liftsim", &mut script);
        written.expect("a vector takes every byte");
        print(&String::from_utf8_lossy(&script))?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Where a script asks what may follow, answers and ends the process.
pub fn answer(program: fn() -> Command) {
    CompleteEnv::with_factory(program).var(ASKED).complete();
}

/// For an argument that is a config of these commands: the names of shipped ones, and TOML files.
pub fn configs(commands: &'static [&'static str]) -> ArgValueCompleter {
    let is_toml = |path: &Path| path.extension().is_some_and(|end| end == "toml");
    let files = PathCompleter::any().filter(is_toml);
    ArgValueCompleter::new(move |typed: &OsStr| {
        let is_begun = |name: &Candidate| {
            let (name, typed) = (name.get_value(), typed.as_encoded_bytes());
            name.as_encoded_bytes().starts_with(typed)
        };
        let names = shipped(commands).into_iter().filter(is_begun);
        names.chain(files.complete(typed)).collect()
    })
}

/// For an argument that is the name of a study.
pub fn studies() -> ArgValueCandidates {
    ArgValueCandidates::new(|| shipped(&["sweep"]))
}

/// For an argument that is the name of a table or a key.
pub fn of_keys() -> ArgValueCandidates {
    ArgValueCandidates::new(|| keys::names().into_iter().map(Candidate::new).collect())
}

/// For an argument that is one of few words, or another spelling of one.
pub fn words<const N: usize>(words: [&'static str; N]) -> ArgValueCandidates {
    ArgValueCandidates::new(move || words.map(Candidate::new).into())
}

/// The shipped configs of commands, each with what it is.
fn shipped(commands: &[&str]) -> Vec<Candidate> {
    let of_commands = |shipped: &&Shipped| commands.contains(&shipped.command);
    let named = |it: &Shipped| {
        let about = new::about(it).ok().map(StyledStr::from);
        Candidate::new(it.name).help(about)
    };
    SHIPPED.iter().filter(of_commands).map(named).collect()
}
