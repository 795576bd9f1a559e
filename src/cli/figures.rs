//! `liftsim figures`: every config's results, and the report on all of them.

use super::progress::{self, Progress, Reporter};
use super::{Failure, Outcome, exhibit, print, store, sweep, table};
use anyhow::anyhow;
use clap::Args;
use liftsim::campaign::{Campaign, Terms};
use liftsim::claim::Evidence;
use liftsim::config::{Config, ExhibitConfig, Experiment};
use liftsim::plan::Plan;
use liftsim::report::{self, Section};
use liftsim::results::{Directory, Lock, Manifest, Origin};
use liftsim::stats::tally::MOST_TRIALS;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Run every config and write the reproduction report.
///
/// Each config in configs/ gets its directory in results/. What is complete there for the same config,
/// seed and trials is skipped; what differs from it in words alone is drawn again from the
/// stored counts. Then results/README.md says what became of each claim, after the text of
/// configs/preface.md, if there is one.
#[derive(Debug, Args)]
pub struct Figures {
    /// Only this config, by the name of its file; may be given again.
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Where the configs are.
    #[arg(long, value_name = "DIR", default_value = "configs")]
    configs: PathBuf,
    /// Where the results and the report go.
    #[arg(long, value_name = "DIR", default_value = "results")]
    results: PathBuf,
    /// Trials per point, instead of each config's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MOST_TRIALS))]
    trials: Option<u64>,
    /// Simulate again what is complete, too, and replace whatever stands in its place.
    #[arg(long)]
    fresh: bool,
    #[command(flatten)]
    progress: Progress,
}

/// An experiment and where its results go.
struct Entry {
    name: String,
    experiment: Experiment,
    directory: Directory,
}

/// An experiment that must be written, ready to run.
enum Task<'a> {
    Sweep(&'a Config, Box<Campaign>),
    Exhibit(&'a ExhibitConfig, Lock),
}

impl Figures {
    /// Runs the command.
    pub fn run(self, quiet: bool) -> Outcome {
        let paths = self.paths()?;
        let (chosen, others): (Vec<_>, Vec<_>) =
            (paths.iter()).partition(|(name, _)| self.only.is_empty() || self.only.contains(name));
        let chosen = (chosen.into_iter())
            .map(|(name, path)| self.entry(name, path))
            .collect::<Result<Vec<_>, _>>()?;
        // Everything that can be refused is refused before anything takes long.
        let tasks = chosen.iter().map(|entry| self.task(entry));
        let tasks = tasks.collect::<Result<Vec<_>, _>>()?;
        let work = tasks.iter().flatten().count();
        let (mut lines, mut done) = (Vec::new(), 0);
        for (entry, task) in chosen.iter().zip(tasks) {
            let Some(task) = task else {
                lines.push(vec![entry.name.clone(), "skipped".into(), "0.0".into()]);
                continue;
            };
            done += 1;
            let start = Instant::now();
            let prefix = format!("{} ({done} of {work})  ", entry.name);
            let reporter = Reporter::new(quiet, &self.progress, &prefix);
            let note = task.run(&entry.directory, &reporter)?;
            let seconds = format!("{:.1}", start.elapsed().as_secs_f64());
            lines.push(vec![entry.name.clone(), note.into(), seconds]);
        }
        print(&table(&["experiment", "results", "seconds"], &lines))?;
        self.report(chosen, &others)?;
        Ok(ExitCode::SUCCESS)
    }

    /// The name and the file of every config, by name.
    fn paths(&self) -> Result<Vec<(String, PathBuf)>, Failure> {
        let place = self.configs.display();
        let entries = fs::read_dir(&self.configs).map_err(|error| {
            Failure::Input(anyhow!(
                "{place}: cannot be read: {error} (give another --configs)"
            ))
        })?;
        let files = entries.filter_map(|entry| Some(entry.ok()?.path()));
        let is_config = |path: &PathBuf| path.extension() == Some(OsStr::new("toml"));
        let named = |path: PathBuf| Some((path.file_stem()?.to_str()?.to_owned(), path));
        let mut paths: Vec<_> = files.filter(is_config).filter_map(named).collect();
        paths.sort();
        if paths.is_empty() {
            return Err(Failure::Input(anyhow!(
                "{place}: holds no config (give another --configs)"
            )));
        }
        let is_known = |name: &&String| paths.iter().any(|(known, _)| known == *name);
        if let Some(name) = self.only.iter().find(|name| !is_known(name)) {
            let known: Vec<&str> = paths.iter().map(|(name, _)| name.as_str()).collect();
            let known = known.join(", ");
            return Err(Failure::Input(anyhow!(
                "--only: no config {name} in {place} (one of {known})"
            )));
        }
        Ok(paths)
    }

    fn entry(&self, name: &str, path: &Path) -> Result<Entry, Failure> {
        let mut experiment = Experiment::load(path).map_err(Failure::input)?;
        if let Some(trials) = self.trials {
            experiment = experiment.with_trials(trials).map_err(Failure::input)?;
        }
        Ok(Entry {
            name: name.to_owned(),
            experiment,
            directory: Directory::new(self.results.join(name)),
        })
    }

    /// What there is to do; nothing where the results are complete.
    fn task<'a>(&self, entry: &'a Entry) -> Result<Option<Task<'a>>, Failure> {
        if !self.fresh && entry.complete().is_some() {
            return Ok(None);
        }
        if !self.fresh {
            self.check_trials(entry)?;
        }
        let directory = &entry.directory;
        match &entry.experiment {
            Experiment::Sweep(config) => {
                let plan = Plan::new(config).map_err(Failure::input)?;
                sweep::rehearse(config, &plan)?;
                let terms = match self.fresh {
                    true => Terms::Fresh,
                    false => Terms::Adopt,
                };
                let campaign = Campaign::open(config, plan, directory.clone(), None, terms);
                let campaign = campaign.map_err(Failure::input)?;
                Ok(Some(Task::Sweep(config, Box::new(campaign))))
            }
            Experiment::Exhibit(config) => {
                let lock = directory.lock().map_err(Failure::input)?;
                directory.check_writable().map_err(Failure::input)?;
                if !self.fresh {
                    directory.admit_any().map_err(Failure::input)?;
                }
                exhibit::rehearse(config)?;
                Ok(Some(Task::Exhibit(config, lock)))
            }
        }
    }

    /// A quick look, or a config cut short, must not cost a long run.
    fn check_trials(&self, entry: &Entry) -> Result<(), Failure> {
        let asked = entry.origin().trials;
        match entry.directory.manifest() {
            Ok(held) if held.trials > asked => Err(Failure::Input(anyhow!(
                "{}: holds {} trials per point, more than the {asked} asked for \
                 (give another --results, or --fresh to replace them)",
                entry.directory.path().display(),
                held.trials,
            ))),
            _ => Ok(()),
        }
    }

    /// Writes the report where every config has its results.
    fn report(&self, chosen: Vec<Entry>, others: &[&(String, PathBuf)]) -> Result<(), Failure> {
        let mut entries = chosen;
        let mut missing: Vec<&str> = Vec::new();
        for (name, path) in others {
            match self.entry(name, path) {
                Ok(entry) if entry.complete().is_some() => entries.push(entry),
                _ => missing.push(name),
            }
        }
        let directory = Directory::new(&self.results);
        let path = directory.path().join("README.md");
        if !missing.is_empty() {
            eprintln!(
                "{}: not written: no complete results of {} (run liftsim figures without --only)",
                path.display(),
                in_short(&missing)
            );
            return Ok(());
        }
        let sections = entries.iter().map(Entry::section);
        let sections = sections.collect::<Result<_, _>>()?;
        let configs = self.way_to_configs().map_err(Failure::run)?;
        // A config directory may say what the report is about.
        let preface = fs::read_to_string(self.configs.join("preface.md")).unwrap_or_default();
        let text = report::markdown(sections, &configs, &preface).map_err(Failure::input)?;
        let _lock = directory.lock().map_err(Failure::input)?;
        let is_new = directory.write("README.md", &text).map_err(Failure::run)?;
        print(&store::line(&directory, "README.md", is_new))
    }

    /// From the results to the configs, as a link has it.
    fn way_to_configs(&self) -> std::io::Result<String> {
        let (from, to) = (
            fs::canonicalize(&self.results)?,
            fs::canonicalize(&self.configs)?,
        );
        let shared = (from.components().zip(to.components()))
            .take_while(|(a, b)| a == b)
            .count();
        let up = from.components().skip(shared).map(|_| "..".to_owned());
        let down = to.components().skip(shared);
        let down = down.map(|part| part.as_os_str().to_string_lossy().into_owned());
        let way: Vec<String> = up.chain(down).collect();
        Ok(match way.is_empty() {
            true => ".".to_owned(),
            false => way.join("/"),
        })
    }
}

/// A few names, and how many more there are.
fn in_short(names: &[&str]) -> String {
    match names.len() {
        0..=4 => names.join(", "),
        many => format!("{} and {} more", names[..3].join(", "), many - 3),
    }
}

impl Entry {
    fn origin(&self) -> Origin {
        match &self.experiment {
            Experiment::Sweep(config) => Origin::from(&**config),
            Experiment::Exhibit(config) => Origin::from(&**config),
        }
    }

    /// What made the results here, if they are those of this config, whole.
    fn complete(&self) -> Option<Manifest> {
        let manifest = self.directory.manifest().ok()?;
        let is_complete = self.origin().made(&manifest)
            && self.directory.is_intact(&manifest)
            && !self.directory.has_counts();
        is_complete.then_some(manifest)
    }

    /// For the report, from the files.
    fn section(&self) -> Result<Section, Failure> {
        let directory = &self.directory;
        let manifest = directory.manifest().map_err(Failure::run)?;
        let mut evidence = Evidence {
            comparisons: directory.comparisons(&manifest).map_err(Failure::run)?,
            quantities: directory.quantities(&manifest).map_err(Failure::run)?,
            ..Evidence::default()
        };
        let (question, narrative) = match &self.experiment {
            Experiment::Sweep(config) => {
                let rows = directory.rows(&manifest).map_err(Failure::run)?;
                let outcomes = rows.iter().map(|row| row.outcome(config.axis.parameter));
                evidence.outcomes = outcomes.collect();
                evidence.scope = config.scope();
                (&config.question, &config.narrative)
            }
            Experiment::Exhibit(config) => (&config.question, &config.narrative),
        };
        Ok(Section {
            name: self.name.clone(),
            config: manifest.config_name.clone(),
            question: question.clone(),
            narrative: narrative.clone(),
            trials: manifest.trials,
            evidence,
        })
    }
}

impl Task<'_> {
    /// Simulates what is missing, and writes.
    fn run(self, directory: &Directory, reporter: &Reporter) -> Result<&'static str, Failure> {
        let (config, mut campaign) = match self {
            Self::Sweep(config, campaign) => (config, *campaign),
            Self::Exhibit(config, _lock) => {
                let (made, seconds) = exhibit::compute(config)?;
                return Ok(exhibit::write(directory, config, &made, seconds)?.note());
            }
        };
        progress::work_off(&mut campaign, reporter)?;
        let held = campaign.made_by().cloned();
        let is_redrawn = held.is_some();
        // Until the last file vouches for the others, the counts are what a run goes on from.
        campaign.save().map_err(Failure::run)?;
        let (counts, _lock) = campaign.counts();
        let written = sweep::write(directory, config, &counts, held)?;
        Ok(if is_redrawn {
            "redrawn"
        } else {
            written.note()
        })
    }
}
