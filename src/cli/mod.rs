//! The commands, one file a verb. What needs a terminal, an argument list or an exit code is here
//! and nowhere else.

mod check;
mod completions;
mod detect;
mod figures;
mod found;
mod keys;
mod man;
mod merge;
mod monitor;
mod monitor_options;
mod output;
mod plan;
mod plot;
mod progress;
mod reading;
mod replay;
mod signals;
mod simulate;
mod status;
mod store;
mod sweep;
mod threshold;

use anyhow::Context;
use clap::error::{ContextKind, ContextValue};
use clap::{Args, Parser, Subcommand};
use liftsim::experiment::{ConfigError, Experiment, MOST_PILOT_TRIALS, SWEEP, SweepConfig};
use liftsim::format::shorten;
use liftsim::plan::Plan;
use liftsim::run::StudyError;
use liftsim::stats::tally::MOST_TRIALS;
use liftsim::study::{self, Loaded};
use std::fmt::Display;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Does the lift move, and how sure can we be, from an accelerometer alone?
///
/// liftsim simulates the adaptive-whitening, three-sample detector of M. A. Raifeld, whose
/// false-alarm rate is known exactly, and measures how often it detects a motion.
#[derive(Debug, Parser)]
#[command(version, propagate_version = true, arg_required_else_help = true)]
#[command(after_help = "Start with: liftsim sweep configs/fig6.toml\n\n\
    Exit codes: 0 done; 1 a run failed, or a gate did not hold; 2 bad usage, config or input; \
    3 a gate was inconclusive; 130 stopped by Ctrl-C, 143 by SIGTERM.")]
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
    Monitor(Box<monitor::MonitorCommand>),
    Keys(keys::Keys),
    Completions(completions::Completions),
    Man(man::Man),
}

/// An error, and whose it is.
pub enum Failure {
    /// What the user gave cannot be used: exit 2.
    Input(anyhow::Error),
    /// The run itself failed: exit 1.
    Run(anyhow::Error),
    /// A signal stopped it: that of the shell for the signal.
    Stopped {
        /// The exit code.
        code: u8,
        /// How to go on.
        message: String,
    },
}

/// What a verb comes to.
type Outcome = Result<ExitCode, Failure>;

impl Failure {
    fn input(error: impl Into<anyhow::Error>) -> Self {
        Self::Input(error.into())
    }

    fn study(error: StudyError) -> Self {
        Self::Input(anyhow::anyhow!(error))
    }

    fn run(error: impl Into<anyhow::Error>) -> Self {
        Self::Run(error.into())
    }
}

impl Arguments {
    /// Reads the command line; where that fails the process ends with the reason.
    pub fn read() -> Self {
        Self::try_parse().unwrap_or_else(|error| without_long_arguments(error).exit())
    }

    /// Runs the command.
    pub fn run(self) -> Outcome {
        match self.command {
            Command::Sweep(verb) => verb.run(self.quiet),
            Command::Merge(verb) => verb.run(),
            Command::Status(verb) => verb.run(),
            Command::Plot(verb) => verb.run(),
            Command::Check(verb) => verb.run(self.quiet),
            Command::Figures(verb) => verb.run(self.quiet),
            Command::Threshold(verb) => verb.run(),
            Command::Plan(verb) => verb.run(),
            Command::Replay(verb) => verb.run(),
            Command::Keys(verb) => verb.run(),
            Command::Simulate(verb) => verb.run(),
            Command::Detect(verb) => verb.run(self.quiet),
            Command::Monitor(verb) => verb.run(),
            Command::Completions(verb) => verb.run(),
            Command::Man(verb) => verb.run(),
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

/// A message in which no argument is repeated at more than some length.
pub fn brief(message: String) -> String {
    let arguments = std::env::args_os().skip(1);
    arguments.fold(message, |message, argument| {
        let argument = argument.to_string_lossy();
        let value = argument
            .split_once('=')
            .map_or(&*argument, |(_, value)| value);
        message.replace(value, &shorten(value))
    })
}

/// What every command that simulates can be told beside its config.
#[derive(Debug, Args)]
struct Simulation {
    /// The experiment, a TOML file.
    config: PathBuf,
    /// Trials per point, instead of the config's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MOST_TRIALS))]
    trials: Option<u64>,
    /// Trials of each pilot run, instead of the config's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MOST_PILOT_TRIALS))]
    pilot: Option<u64>,
    /// Where every draw starts from, instead of the config's.
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Threads to run on; all cores by default. Results do not depend on it.
    #[arg(long, value_name = "N", value_parser = threads)]
    threads: Option<usize>,
}

impl Simulation {
    /// Reads the config of a sweep, puts the command line in its place, and plans it.
    fn prepare(
        &self,
        plan: impl Fn(&SweepConfig) -> Result<Plan, ConfigError>,
    ) -> Result<(SweepConfig, Plan), Failure> {
        let config = SweepConfig::new(self.config()?).map_err(Failure::input)?;
        let plan = plan(&config).map_err(Failure::input)?;
        self.start_threads()?;
        Ok((config, plan))
    }

    /// The same for any config.
    fn study(&self) -> Result<Loaded, Failure> {
        let study = Loaded::new(self.config()?).map_err(Failure::study)?;
        self.start_threads()?;
        Ok(study)
    }

    /// The config with the command line in its place.
    fn config(&self) -> Result<Experiment, Failure> {
        let mut config = study::load(&self.config).map_err(Failure::input)?;
        let header = &mut config.header;
        header.set_trials(self.trials.unwrap_or(header.trials()));
        header.seed = self.seed.unwrap_or(header.seed);
        // A study without pilots is known by the usual number of them.
        if config.study() == SWEEP {
            config.header.pilot = self.pilot.unwrap_or(config.header.pilot);
        }
        Ok(config)
    }

    fn start_threads(&self) -> Result<(), Failure> {
        let Some(threads) = self.threads else {
            return Ok(());
        };
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .context("threads")
            .map_err(Failure::Run)
    }
}

/// More than any machine this runs on has cores.
const MOST_THREADS: usize = 1024;

fn threads(text: &str) -> Result<usize, String> {
    let threads = text.parse().ok();
    threads
        .filter(|threads| (1..=MOST_THREADS).contains(threads))
        .ok_or_else(|| format!("must lie in 1 to {MOST_THREADS} (leave it out to use all cores)"))
}

/// Writes to standard output; a reader that has seen enough is no error.
fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::run(
            anyhow::Error::from(error).context("standard output"),
        )),
        _ => Ok(()),
    }
}

/// A line on standard error. Best effort: where nobody can read it, the work goes on.
pub fn say(line: impl Display) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// What should be known, and stops nothing.
fn warn(warning: impl Display) {
    say(format_args!("warning: {warning}"));
}

/// A table of text: every column as wide as its widest cell, numbers to the right.
fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells
            .chain([header[column].chars().count()])
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let is_number = |column: usize| {
        let mut cells = rows
            .iter()
            .map(|row| row[column].trim_start_matches(['[', '<', '-']));
        cells.all(|cell| cell.is_empty() || cell.starts_with(|c: char| c.is_ascii_digit()))
    };
    let numeric: Vec<bool> = (0..header.len()).map(is_number).collect();
    let line = |cells: &mut dyn Iterator<Item = &str>| {
        let padded = cells
            .zip(&widths)
            .zip(&numeric)
            .map(|((cell, width), numeric)| {
                let blank = " ".repeat(width - cell.chars().count());
                match numeric {
                    true => format!("{blank}{cell}"),
                    false => format!("{cell}{blank}"),
                }
            });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
    };
    let mut text = line(&mut header.iter().copied());
    for row in rows {
        text += &line(&mut row.iter().map(String::as_str));
    }
    text
}
