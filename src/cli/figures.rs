//! `liftsim figures`: every config's results, and the report on all of them.

use super::figure::{FigureFlags, differs, folder, redraw};
use super::output::Output;
use super::progress::{self, Progress, Reporter};
use super::{CommandResult, Failure, completions, print, say, store, sweep, table};
use anyhow::anyhow;
use clap::{Args, ValueHint};
use liftsim::page::report::html;
use liftsim::report::{Report, is_report};
use liftsim::results::Directory;
use liftsim::run::{Overwrite, Session};
use liftsim::stats::tally::MOST_TRIALS;
use liftsim::study::{self, Loaded};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Run every config and write the reproduction report.
///
/// Each config in configs/ gets its directory in results/. Results that are complete for the same config,
/// seed and trials are skipped; where only words of the config have changed, the figure is drawn again
/// from the stored counts. Then results/README.md gives the verdict on each claim, after the text of
/// configs/preface.md, if there is one: paragraphs with `code`, *emphasis* and links.
#[derive(Debug, Args)]
pub struct Figures {
    /// Only the config of this name, without .toml; may be repeated.
    #[arg(long, value_name = "NAME", add = completions::studies())]
    only: Vec<String>,
    /// Where the configs are.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, default_value = "configs")]
    configs: PathBuf,
    /// Where the results and the report go.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, default_value = "results")]
    results: PathBuf,
    /// Trials per point, instead of each config's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MOST_TRIALS))]
    trials: Option<u64>,
    /// Simulate complete results again, too, and replace what is there.
    #[arg(long)]
    fresh: bool,
    /// Write the report as one page too, with every picture in it, to be read, printed or sent. Without a FILE it is README.html
    /// among the results.
    #[arg(long, value_name = "FILE.html", num_args = 0..=1)]
    html: Option<Option<PathBuf>>,
    /// Replace the file of --html, and a README.md among the results that is no report.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    figure: FigureFlags,
    #[command(flatten)]
    progress: Progress,
}

/// An experiment and where its results go.
struct Entry {
    name: String,
    loaded: Loaded,
    directory: Directory,
}

impl Figures {
    /// Runs the command.
    pub fn run(self, quiet: bool) -> CommandResult {
        let paths = self.paths()?;
        let (chosen, others): (Vec<_>, Vec<_>) =
            (paths.iter()).partition(|(name, _)| self.only.is_empty() || self.only.contains(name));
        let chosen = (chosen.into_iter())
            .map(|(name, path)| self.entry(name, path))
            .collect::<Result<Vec<_>, _>>()?;
        // Everything that can be refused is refused before anything takes long.
        self.check_report()?;
        let page = self.page()?;
        let sessions = chosen.iter().map(|entry| self.session(entry));
        let sessions = sessions.collect::<Result<Vec<_>, _>>()?;
        let work = sessions.iter().flatten().count();
        let (mut lines, mut done) = (Vec::new(), 0);
        for (entry, session) in chosen.iter().zip(sessions) {
            let Some(session) = session else {
                let note = if differs(&entry.loaded, &entry.directory) {
                    redraw(&entry.loaded, &entry.directory)?;
                    "redrawn"
                } else {
                    "skipped"
                };
                lines.push(vec![entry.name.clone(), note.into(), "0.0".into()]);
                continue;
            };
            done += 1;
            let start = Instant::now();
            let prefix = format!("{} ({done} of {work})  ", entry.name);
            let reporter = Reporter::new(quiet, &self.progress, &prefix);
            let note = work_off(&entry.loaded, session, &reporter)?;
            let seconds = format!("{:.1}", start.elapsed().as_secs_f64());
            lines.push(vec![entry.name.clone(), note.into(), seconds]);
        }
        print(&table(&["experiment", "results", "seconds"], &lines))?;
        self.report(chosen, &others, page)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Refuses to write over a README.md that is no report.
    fn check_report(&self) -> Result<(), Failure> {
        let path = self.results.join("README.md");
        match fs::read(&path) {
            Ok(text) if !self.force && !is_report(&text) => Err(Failure::Input(anyhow!(
                "{}: is not a report of liftsim (give another --results, or --force to replace it)",
                path.display()
            ))),
            _ => Ok(()),
        }
    }

    /// The file of --html, if it may be written.
    fn page(&self) -> Result<Option<Output>, Failure> {
        let Some(file) = &self.html else {
            return Ok(None);
        };
        let path = match file {
            Some(file) => file.clone(),
            None => {
                fs::create_dir_all(&self.results).map_err(Failure::run)?;
                self.results.join("README.html")
            }
        };
        Output::named(&path, self.force, "--html", &["html", "htm"]).map(Some)
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
        let mut config = study::load(path).map_err(Failure::input)?;
        if let Some(trials) = self.trials {
            config.header.set_trials(trials);
        }
        let mut loaded = Loaded::new(config).map_err(Failure::study)?;
        self.figure.lay_over(&mut loaded, folder(path))?;
        loaded.figure.keep_for_the_report();
        Ok(Entry {
            name: name.to_owned(),
            loaded,
            directory: Directory::new(self.results.join(name)),
        })
    }

    /// The run that is left to do; none where the results are complete.
    fn session<'a>(&self, entry: &'a Entry) -> Result<Option<Session<'a>>, Failure> {
        if !self.fresh && entry.is_complete() {
            return Ok(None);
        }
        let overwrite = if self.fresh {
            Overwrite::Fresh
        } else {
            self.check_trials(entry)?;
            Overwrite::Adopt
        };
        let loaded = &entry.loaded;
        loaded.check().map_err(Failure::study)?;
        let session = Session::open(
            &*loaded.study,
            &loaded.origin,
            entry.directory.clone(),
            None,
            overwrite,
        );
        session.map(Some).map_err(Failure::input)
    }

    /// Refuses to replace a longer run by a shorter one.
    fn check_trials(&self, entry: &Entry) -> Result<(), Failure> {
        let asked = entry.loaded.origin.trials;
        match entry.directory.manifest() {
            Ok(held) if held.origin.trials > asked => Err(Failure::Input(anyhow!(
                "{}: holds {} trials per point, more than the {asked} asked for \
                 (give another --results, or --fresh to replace them)",
                entry.directory.path().display(),
                held.origin.trials,
            ))),
            _ => Ok(()),
        }
    }

    /// Writes the report where every config has its results.
    fn report(
        &self,
        chosen: Vec<Entry>,
        others: &[&(String, PathBuf)],
        page: Option<Output>,
    ) -> Result<(), Failure> {
        let mut entries = chosen;
        let mut missing: Vec<&str> = Vec::new();
        for (name, path) in others {
            match self.entry(name, path) {
                Ok(entry) if entry.is_complete() => entries.push(entry),
                _ => missing.push(name),
            }
        }
        let directory = Directory::new(&self.results);
        let path = directory.path().join("README.md");
        if !missing.is_empty() {
            say(format_args!(
                "{}: not written: no complete results of {} (run liftsim figures without --only)",
                path.display(),
                in_short(&missing)
            ));
            return Ok(());
        }
        let sections = entries.iter();
        let sections = sections
            .map(|entry| entry.loaded.report(&entry.name, &entry.directory))
            .collect::<Result<_, _>>()
            .map_err(Failure::run)?;
        let configs = self.way_to_configs().map_err(Failure::run)?;
        // A config directory may say what the report is about.
        let preface = fs::read_to_string(self.configs.join("preface.md")).unwrap_or_default();
        let report = Report::new(sections, &configs, &preface).map_err(Failure::input)?;
        let text = report.markdown().into_bytes();
        let _lock = directory.lock().map_err(Failure::input)?;
        let is_new = directory.write("README.md", &text).map_err(Failure::run)?;
        print(&store::line(&directory, "README.md", is_new))?;
        let Some(page) = page else { return Ok(()) };
        let pictures = (entries.iter()).map(|entry| {
            let svg = fs::read_to_string(entry.directory.path().join("figure.svg"));
            Ok((entry.name.clone(), svg.map_err(Failure::run)?))
        });
        let html = html(&report, &pictures.collect::<Result<_, Failure>>()?);
        let line = format!("{}  written\n", page.path().display());
        page.write(html.as_bytes())?.publish()?;
        print(&line)
    }

    /// The relative path from the results to the configs.
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
        Ok(if way.is_empty() {
            ".".to_owned()
        } else {
            way.join("/")
        })
    }
}

/// The first names, and the number of the others.
fn in_short(names: &[&str]) -> String {
    match names.len() {
        0..=4 => names.join(", "),
        many => format!("{} and {} more", names[..3].join(", "), many - 3),
    }
}

impl Entry {
    /// Whether the results here are those of this config, whole.
    fn is_complete(&self) -> bool {
        self.directory.complete(&self.loaded.origin).is_some()
    }
}

/// Simulates what is missing, and writes the results.
fn work_off(
    loaded: &Loaded,
    mut session: Session,
    reporter: &Reporter,
) -> Result<&'static str, Failure> {
    progress::work_off(&mut session, reporter)?;
    let is_redrawn = session.made_by().is_some();
    let (_, written) = sweep::write(loaded, session)?;
    Ok(if is_redrawn {
        "redrawn"
    } else {
        written.note()
    })
}
