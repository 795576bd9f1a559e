//! `liftsim sweep CONFIG`: counts or computes what a config describes, and writes results and figure.

use super::figure::{FigureFlags, differs, drawn, folder, redraw, told};
use super::outcomes::SavedTrials;
use super::output;
use super::progress::{self, Progress, Reporter};
use super::store::{Written, line, manifest, remove_stale, store};
use super::{CommandResult, Counted, Failure, table};
use clap::{Args, ValueHint};
use liftsim::results::{Directory, Manifest, Shard};
use liftsim::run::{Output, Overwrite, Session};
use liftsim::study::Loaded;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Run every point of an experiment; write points.csv, the figure and run.json.
///
/// A config with a table of another study instead of an axis and curves is run in the same way; its
/// single numbers, if any, are written to quantities.csv.
///
/// The same config and seed give the same bytes on any machine, with any number of threads.
///
/// Counts are saved in counts.json every few seconds. However a run ends, the same command continues it.
/// Nothing that a finished sweep holds is simulated again: for more trials, another curve or another claim
/// only what is missing is run, and what is left out of the config is dropped. The rows of the other studies do not hold their counts (those of
/// [impulse_law] do): for more trials these start over.
#[derive(Debug, Args)]
pub struct Sweep {
    #[command(flatten)]
    counted: Counted,
    /// Where to write; results/<name of the config>/ by default.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: Option<PathBuf>,
    /// Start over, replacing whatever experiment the directory holds.
    #[arg(long)]
    fresh: bool,
    /// Run share I of N of the trials, into results/<name>/shards/<I>-of-<N>/ by default; `merge` joins
    /// them.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Write W, T and the decision of every trial for NumPy, simulated again: arrays rank_sum, exceedances and h1
    /// with a row for each of points.csv and a column for each trial.
    #[arg(long, value_name = "FILE.npz", conflicts_with = "shard")]
    save_trials: Option<PathBuf>,
    /// Replace the file of --save-trials if it exists.
    #[arg(long, requires = "save_trials")]
    force: bool,
    #[command(flatten)]
    figure: FigureFlags,
    #[command(flatten)]
    progress: Progress,
}

impl Sweep {
    /// Runs the command.
    pub fn run(self, quiet: bool) -> CommandResult {
        if let Some(out) = &self.out {
            output::not_stdout("--out", output::DIRECTORY, out)?;
        }
        let experiment = self.counted.config()?;
        let mut loaded = self.counted.simulation.plan(experiment.clone())?;
        self.figure
            .lay_over(&mut loaded, folder(&self.counted.simulation.config))?;
        let study = &*loaded.study;
        if self.shard.is_some() && study.trials().is_none() {
            return Err(Failure::Input(anyhow::anyhow!(
                "{}: --shard: [{}] counts no trials that could be shared (run it whole)",
                self.counted.simulation.config.display(),
                study.name()
            )));
        }
        loaded.check().map_err(Failure::study)?;
        let out = self.out.clone();
        let directory = Directory::new(out.unwrap_or_else(|| self.default_directory()));
        let overwrite = if self.fresh {
            Overwrite::Fresh
        } else {
            Overwrite::Continue
        };
        let mut session = Session::open(study, &loaded.origin, directory, self.shard, overwrite)
            .map_err(Failure::input)?;
        // Now that the directory is there, in which it may be.
        let saved = match &self.save_trials {
            Some(path) => Some(SavedTrials::new(path, self.force, experiment)?),
            None => None,
        };
        let reporter = Reporter::new(quiet, &self.progress, "");
        progress::work_off(&mut session, &reporter)?;
        let text = finish(&loaded, session, self.shard)?;
        output::print_beside(self.save_trials.iter(), &text)?;
        if let Some(saved) = saved {
            output::print_written(&saved.write(&reporter)?)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// The directory results/<file stem>, with a subdirectory for each shard.
    fn default_directory(&self) -> PathBuf {
        let directory = default_directory(&self.counted.simulation.config);
        match self.shard {
            Some(Shard { number, count }) => directory.join(format!("shards/{number}-of-{count}")),
            None => directory,
        }
    }
}

/// The directory results/<file stem>.
pub(super) fn default_directory(config: &Path) -> PathBuf {
    Path::new("results").join(config.file_stem().unwrap_or(config.as_os_str()))
}

/// Writes the results of a run and returns a summary. A shard saves only its counts.
pub(super) fn finish(
    loaded: &Loaded,
    mut session: Session,
    shard: Option<Shard>,
) -> Result<String, Failure> {
    let directory = session.directory().clone();
    let what = match loaded.study.trials() {
        Some(_) => format!("{} points of {} trials", session.points(), session.wanted()),
        None => format!("[{}]", loaded.study.name()),
    };
    if let Some(shard) = shard {
        // Save even a share without trials, because `merge` needs its file and compares the text of its
        // config.
        let is_new = session.save().map_err(Failure::run)?;
        let counts = line(&directory, "counts.json", is_new);
        return Ok(format!("shard {shard}: {what}\n{counts}"));
    }
    let done = if session.is_complete() {
        let place = directory.path().display();
        drop(session);
        let redrawn = if differs(loaded, &directory) {
            redraw(loaded, &directory)?
        } else {
            String::new()
        };
        format!("{what} are complete in {place}: nothing to simulate\n{redrawn}")
    } else {
        let (output, written) = write(loaded, session)?;
        let findings = match output.findings {
            Some((header, lines)) => table(header, &lines) + "\n",
            None => String::new(),
        };
        let Written { seconds, files, .. } = written;
        format!("{findings}{what} in {seconds:.1} s\n{files}")
    };
    let section = loaded.report("", &directory).map_err(Failure::run)?;
    let verdicts = section.verdicts().map_err(Failure::run)?;
    Ok(if verdicts.is_empty() {
        done
    } else {
        format!("{done}\n{verdicts}")
    })
}

/// Writes the counts, then the figures, then the manifest with the hashes of both.
pub(super) fn write(loaded: &Loaded, mut session: Session) -> Result<(Output, Written), Failure> {
    let start = Instant::now();
    let study = &loaded.study;
    let output = study.output(session.counts()).map_err(Failure::study)?;
    let mut seconds = session.seconds();
    if study.trials().is_none() {
        seconds = start.elapsed().as_secs_f64();
        loaded.judge(&output).map_err(Failure::study)?;
    }
    // Save the counts first, so that a run interrupted before the manifest is written continues from them.
    session.save().map_err(Failure::run)?;
    let directory = session.directory().clone();
    let mut manifest = Manifest {
        figure: drawn(loaded),
        ..made_by(&session, manifest(&loaded.origin, seconds))
    };
    let mut written = Written::new(seconds);
    let mut put = |name: &str, bytes: &[u8], manifest: &mut Manifest| {
        let is_new = store(&directory, manifest, name, bytes)?;
        written.add(&directory, name, is_new);
        Ok(())
    };
    for (name, bytes) in output.files() {
        put(name, &bytes, &mut manifest)?;
    }
    let drawing = loaded
        .draw(&output.points, &manifest)
        .map_err(Failure::run)?;
    for (name, bytes) in told(drawing) {
        put(name, &bytes, &mut manifest)?;
    }
    let _lock = session.close();
    directory
        .write("run.json", &manifest.to_json())
        .map_err(Failure::run)?;
    written.files += &remove_stale(&directory, &manifest)?;
    written.files += &line(&directory, "run.json", true);
    Ok((output, written))
}

/// Keeps the origin of the counts if nothing was simulated since and the results are only written again.
fn made_by(session: &Session, now: Manifest) -> Manifest {
    match session.made_by().cloned() {
        Some(made_by) => Manifest {
            revision: made_by.revision,
            threads: made_by.threads,
            architecture: made_by.architecture,
            ..now
        },
        None => now,
    }
}
