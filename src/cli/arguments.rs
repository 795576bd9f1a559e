//! The command line: which commands there are, and what each takes.

use super::CommandResult;
use super::{
    check, completions, detect, figures, keys, man, merge, monitor, new, plan, plot, replay,
    simulate, status, sweep, threshold, track,
};
use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser, Subcommand};
use liftsim::format::{as_written, shorten};

/// Does the lift move, and how sure can we be, from an accelerometer alone?
///
/// liftsim simulates the adaptive-whitening, three-sample detector of M. A. Raifeld, whose
/// false-alarm rate is known exactly, and measures how often it detects a motion.
#[derive(Debug, Parser)]
#[command(version, propagate_version = true, arg_required_else_help = true)]
#[command(after_help = "Start with: liftsim sweep fig6\n\n\
    A file that exists is replaced only with --force, and - is standard output. What is kept from run to run is replaced \
    as it grows: a map, a baseline, a spool, a directory of results.\n\n\
    Exit codes: 0 done; 1 a run failed, or a gate did not hold; 2 bad usage, config or input; \
    3 a gate was inconclusive; 130 stopped by Ctrl-C, 143 by SIGTERM (0 where `monitor --save-state` \
    has saved its state).")]
pub struct Arguments {
    /// Show no progress.
    #[arg(long, short, global = true)]
    quiet: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Sweep(sweep::Sweep),
    Merge(merge::Merge),
    Status(status::StatusCommand),
    Plot(plot::Plot),
    Check(check::Check),
    Figures(figures::Figures),
    Threshold(threshold::Threshold),
    Plan(plan::PlanCommand),
    Replay(replay::ReplayCommand),
    #[command(alias = "record")]
    Simulate(simulate::Simulate),
    Detect(Box<detect::Detect>),
    Track(Box<track::TrackCommand>),
    Monitor(Box<monitor::MonitorCommand>),
    New(new::New),
    Keys(keys::Keys),
    Completions(completions::Completions),
    Man(man::Man),
}

impl Arguments {
    /// Reads the command line. Where it cannot be used, says why and ends the process; where a shell asks how one may go
    /// on, says that.
    pub fn read() -> Self {
        completions::answer(Self::command);
        Self::try_parse().unwrap_or_else(|error| without_long_arguments(error).exit())
    }

    /// Runs the command.
    pub fn run(self) -> CommandResult {
        match self.command {
            Command::Sweep(command) => command.run(self.quiet),
            Command::Merge(command) => command.run(),
            Command::Status(command) => command.run(),
            Command::Plot(command) => command.run(),
            Command::Check(command) => command.run(self.quiet),
            Command::Figures(command) => command.run(self.quiet),
            Command::Threshold(command) => command.run(),
            Command::Plan(command) => command.run(),
            Command::Replay(command) => command.run(self.quiet),
            Command::New(command) => command.run(),
            Command::Keys(command) => command.run(),
            Command::Simulate(command) => command.run(),
            Command::Detect(command) => command.run(),
            Command::Track(command) => command.run(),
            Command::Monitor(command) => command.run(),
            Command::Completions(command) => command.run(),
            Command::Man(command) => command.run(Self::command()),
        }
    }
}

/// The same refusal, in which no argument is repeated at more than some length.
fn without_long_arguments(mut error: clap::Error) -> clap::Error {
    let contexts = error.context().filter_map(|(kind, value)| match value {
        ContextValue::String(text) if shorten(text) != *text => Some((kind, shorten(text).into())),
        _ => None,
    });
    for (kind, text) in contexts.collect::<Vec<_>>() {
        error.insert(kind, ContextValue::String(text));
        // Tips repeat it too.
        error.remove(ContextKind::Suggested);
    }
    error
}

/// A message in which an argument is repeated as it was written, but at no more than some length.
pub fn brief(message: String) -> String {
    let arguments = std::env::args_os().skip(1);
    arguments.fold(message, |message, argument| {
        let argument = argument.to_string_lossy();
        let value = argument
            .split_once('=')
            .map_or(&*argument, |(_, value)| value);
        as_written(message.replace(value, &shorten(value)), value)
    })
}
