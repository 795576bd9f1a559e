//! The commands, one file each; `arguments` parses and calls them. What needs a terminal, an argument list
//! or an exit code is here and nowhere else.

mod air;
mod arguments;
mod check;
mod completions;
mod detect;
mod figure;
mod figures;
mod first_second;
mod floors;
mod found;
mod heartbeat;
mod kept;
mod keys;
mod man;
mod merge;
mod monitor;
mod monitor_options;
mod network;
mod new;
mod outcomes;
mod output;
mod per_hour;
mod plan;
mod plot;
mod progress;
mod quality;
mod reading;
mod readings;
mod replay;
mod rides;
mod rows;
mod signals;
mod simulate;
mod status;
mod stdin;
mod store;
mod sweep;
mod threshold;
mod track;
mod vibration;

pub use arguments::Arguments;

use arguments::brief;

use anyhow::Context;
use clap::Args;
use liftsim::experiment::{Experiment, MOST_PILOT_TRIALS, SWEEP};
use liftsim::run::StudyError;
use liftsim::stats::tally::MOST_TRIALS;
use liftsim::study::{self, Loaded};
use std::fmt::Display;
use std::io::{self, StdoutLock, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Why a command ended early, by exit code.
pub enum Failure {
    /// Usage, config or input cannot be used: exit 2.
    Input(anyhow::Error),
    /// The run itself failed: exit 1.
    Run(anyhow::Error),
    /// A signal stopped it: exit 128 and the number of the signal, as a shell has it.
    Stopped {
        /// The exit code.
        code: u8,
        /// The command that continues it.
        message: String,
    },
}

/// How a command ends.
type CommandResult = Result<ExitCode, Failure>;

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

    /// Says what went wrong; returns the exit code.
    pub fn report(self) -> u8 {
        let (error, code) = match self {
            Self::Input(error) => (error, 2),
            Self::Run(error) => (error, 1),
            Self::Stopped { code, message } => {
                say(message);
                return code;
            }
        };
        say(format_args!("error: {}", brief(format!("{error:#}"))));
        code
    }
}

/// The config of a command that simulates, and the flags that go over it.
#[derive(Debug, Args)]
struct Simulation {
    /// The experiment: a TOML file, or the name of a shipped one (see `liftsim new`).
    #[arg(add = completions::configs(&["sweep"]))]
    config: PathBuf,
    /// Trials of each pilot run, instead of the config's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MOST_PILOT_TRIALS))]
    pilot: Option<u64>,
    /// Seed of all random draws, instead of the config's.
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Threads to run on; all cores by default. Results do not depend on it.
    #[arg(long, value_name = "N", value_parser = threads)]
    threads: Option<usize>,
}

/// A simulation whose trials are counted.
#[derive(Debug, Args)]
struct Counted {
    #[command(flatten)]
    simulation: Simulation,
    /// Trials per point, instead of the config's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MOST_TRIALS))]
    trials: Option<u64>,
}

impl Counted {
    /// A flag that changes what is counted, if one is given.
    fn flag(&self) -> Option<&'static str> {
        let Simulation { pilot, seed, .. } = self.simulation;
        let given = [
            ("--trials", self.trials.is_some()),
            ("--seed", seed.is_some()),
            ("--pilot", pilot.is_some()),
        ];
        given
            .iter()
            .find(|(_, is_given)| *is_given)
            .map(|(flag, _)| *flag)
    }

    /// Reads the config, lays the command line over it, and plans it.
    fn study(&self) -> Result<Loaded, Failure> {
        self.simulation.plan(self.config()?)
    }

    /// The config with the command line in its place.
    fn config(&self) -> Result<Experiment, Failure> {
        let mut config = self.simulation.config()?;
        let header = &mut config.header;
        header.set_trials(self.trials.unwrap_or(header.trials()));
        Ok(config)
    }
}

impl Simulation {
    /// The config with the command line in its place.
    fn config(&self) -> Result<Experiment, Failure> {
        let mut config = study::load(&self.config).map_err(Failure::input)?;
        config.header.seed = self.seed.unwrap_or(config.header.seed);
        match self.pilot {
            Some(pilot) if config.study() == SWEEP => config.header.pilot = pilot,
            Some(_) => {
                return Err(Failure::Input(anyhow::anyhow!(
                    "--pilot: means nothing to [{}] (leave it out)",
                    config.study()
                )));
            }
            None => {}
        }
        Ok(config)
    }

    /// The study of a config, planned.
    fn plan(&self, experiment: Experiment) -> Result<Loaded, Failure> {
        // Before the plan: large joint laws are counted on all threads.
        self.start_threads()?;
        Loaded::new(experiment).map_err(Failure::study)
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

/// Writes to standard output. A reader that has closed it is not an error.
fn print(text: &str) -> Result<(), Failure> {
    print_to(&mut io::stdout().lock(), text).map(|_| ())
}

/// The same; whether the reader is still there.
fn print_to(out: &mut StdoutLock, text: &str) -> Result<bool, Failure> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(false),
        Err(error) => Err(error).context("standard output").map_err(Failure::Run),
    }
}

/// Writes a line to standard error. Where that fails the work goes on.
fn say(line: impl Display) {
    // What a file or an argument holds does not steer the terminal.
    let line = line.to_string();
    let line = line.replace(|c: char| c.is_control() && c != '\n', "\u{fffd}");
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Writes a warning to standard error.
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
                if *numeric {
                    format!("{blank}{cell}")
                } else {
                    format!("{cell}{blank}")
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
