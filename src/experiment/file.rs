//! The text of a config, its tree, and the keys that every experiment has.

use super::header::Header;
use crate::claim::{Narrative, Scope};
use crate::config::{ConfigError, Conflict, Node, Source};
use crate::fields::names;
use crate::scenario::{Scenario, Sections};
use serde::de::DeserializeOwned;
use std::error::Error;
use std::ops::Range;
use std::path::Path;

/// The text of a config, its tree, and the keys that every experiment has.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// The keys at the top of the config.
    pub header: Header,
    pub(super) source: Source,
    pub(super) root: Node,
    study: &'static str,
}

/// The table that makes a config a sweep.
pub const SWEEP: &str = "axis";

/// Why a config describes no experiment.
#[derive(Debug, thiserror::Error)]
enum ExperimentError {
    #[error("unknown key {0}")]
    Unknown(String),
    #[error(
        "required key `axis` is missing (add what is swept, for instance [axis] delta = [0.0, 1.0], \
         or one table that says what to draw: {0})"
    )]
    NothingToDo(String),
    #[error(
        "[{second}] cannot stand beside [{first}]: a config does one thing (take one of them out)"
    )]
    TwoThingsToDo {
        first: &'static str,
        second: &'static str,
    },
    #[error("{key} means nothing to [{study}] (take it out)")]
    Unused { key: String, study: &'static str },
}

impl Experiment {
    /// Reads a file that describes one of the `studies`, named by their tables.
    ///
    /// # Errors
    /// If the file cannot be read, is not TOML, has an unknown key, lacks a required key, or names no study
    /// or more than one.
    pub fn load(path: &Path, studies: &[&'static str]) -> Result<Self, ConfigError> {
        Self::new(Source::find(path, "sweep")?, studies)
    }

    /// Reads a file's text. Messages call the file `name`.
    ///
    /// # Errors
    /// As [`Experiment::load`].
    pub fn parse(name: &str, text: &str, studies: &[&'static str]) -> Result<Self, ConfigError> {
        Self::new(Source::new(name, text), studies)
    }

    fn new(source: Source, studies: &[&'static str]) -> Result<Self, ConfigError> {
        let root = source.parse()?;
        check_known(&source, &root, studies)?;
        let mut header: Header = source.read(&keys_of::<Header>(&root), "")?;
        (header.settle()).map_err(|conflict| source.conflict(&root, conflict, &root.span))?;
        let study = study(&source, &root, studies)?;
        Ok(Self {
            header,
            source,
            root,
            study,
        })
    }

    /// The name of the study's table.
    pub fn study(&self) -> &'static str {
        self.study
    }

    /// The study's table.
    pub fn table(&self) -> &Node {
        self.root.get(self.study).expect("it names the study")
    }

    /// Reads the study's table as its own type.
    ///
    /// # Errors
    /// If a key is unknown or missing, or a value does not fit.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, ConfigError> {
        self.read_part(self.table())
    }

    /// Reads `part` of the study's table.
    ///
    /// # Errors
    /// As [`Experiment::read`].
    pub fn read_part<T: DeserializeOwned>(&self, part: &Node) -> Result<T, ConfigError> {
        self.source.read(part, self.study)
    }

    /// The sections of the file.
    pub fn sections(&self) -> Node {
        keys_of::<Sections>(&self.root)
    }

    /// The scenario that the file's sections describe.
    ///
    /// # Errors
    /// If a section is not valid or does not fit the others.
    pub fn scenario(&self) -> Result<Scenario, ConfigError> {
        self.scenario_of(&self.sections())
    }

    /// The scenario of other sections. Errors about values that the file does not contain point at the
    /// study's table.
    ///
    /// # Errors
    /// As [`Experiment::scenario`].
    pub fn scenario_of(&self, sections: &Node) -> Result<Scenario, ConfigError> {
        self.laid_scenario(sections, &self.table().span)
    }

    /// The scenario of laid sections. Errors about values that no section contains point at `otherwise`.
    pub fn laid_scenario(
        &self,
        laid: &Node,
        otherwise: &Range<usize>,
    ) -> Result<Scenario, ConfigError> {
        // An empty section counts as absent.
        let is_empty = |key: &str| {
            let section = laid.get(key).and_then(Node::table);
            section.is_some_and(|section| section.is_empty())
        };
        let written = laid.only(|key| !is_empty(key));
        let sections: Sections = self.source.read(&written, "")?;
        sections.scenario(self.header.pilot).map_err(|error| {
            let conflict = Conflict::of(error.keys().iter().copied(), error);
            self.source.conflict(laid, conflict, otherwise)
        })
    }

    /// Refuses keys that mean nothing to a study that is not a sweep: sections, or keys in sections, that
    /// `uses` does not name, and the number of trials if the study counts no trials.
    ///
    /// # Errors
    /// If there is such a key. The error points at the first one.
    pub fn check_used(&self, uses: &[&str], counts_trials: bool) -> Result<(), ConfigError> {
        if self.study == SWEEP {
            return Ok(());
        }
        let sections = self.sections();
        // Read the sections first, so that a misspelt key is reported as unknown and not as unused.
        self.source.read::<Sections>(&sections, "")?;
        let is_used = |path: &str| {
            let section = path.split_once('.').map_or(path, |(section, _)| section);
            uses.contains(&path) || uses.contains(&section)
        };
        let unused = sections
            .written()
            .into_iter()
            .filter(|(path, _)| !is_used(path));
        let of_sweeps = ["curve", "common_random_numbers", "at_rest", "pilot"];
        let of_trials = ["trials", "half_width", "confidence"]
            .iter()
            .filter(|_| !counts_trials);
        let keys = of_sweeps.iter().chain(of_trials);
        let mut unused = keys.filter_map(|key| self.place(key)).chain(unused);
        match unused.next() {
            Some((key, span)) => {
                let study = self.study;
                Err(self
                    .source
                    .at(Some(span), ExperimentError::Unused { key, study }))
            }
            None => Ok(()),
        }
    }

    /// A top-level key and its place in the file. The place of `[[curve]]` is the word itself.
    fn place(&self, key: &str) -> Option<(String, Range<usize>)> {
        let (key_span, node) = self.root.table()?.get(key)?;
        let span = if key == "curve" { key_span } else { &node.span };
        Some((key.to_owned(), span.clone()))
    }

    /// Reads the texts for the report and the claims, and checks that the claims refer only to `scope`.
    ///
    /// # Errors
    /// If a claim does not fit `scope`.
    pub fn narrative(&self, scope: &Scope) -> Result<Narrative, ConfigError> {
        let narrative: Narrative = self.source.read(&keys_of::<Narrative>(&self.root), "")?;
        narrative.check(scope).map_err(|(path, problem)| {
            let conflict = Conflict::of([path.clone()], format!("{path}: {problem}"));
            self.source.conflict(&self.root, conflict, &self.root.span)
        })?;
        Ok(narrative)
    }

    /// A conflict of values. It points at the study's table if the file contains none of these values.
    pub fn conflict(&self, conflict: Conflict) -> ConfigError {
        self.source
            .conflict(&self.root, conflict, &self.table().span)
    }

    /// A problem of the study as a whole.
    pub fn refuse(&self, error: impl Into<Box<dyn Error + Send + Sync>>) -> ConfigError {
        self.source.at(Some(self.table().span.clone()), error)
    }

    /// The file.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The file's text.
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// The name of the file in messages.
    pub fn name(&self) -> &str {
        self.source.name()
    }
}

/// The entries of a table that are fields of `T`.
fn keys_of<T: DeserializeOwned>(table: &Node) -> Node {
    table.only(|key| names::<T>().contains(&key))
}

fn check_known(source: &Source, root: &Node, studies: &[&'static str]) -> Result<(), ConfigError> {
    let known = (names::<Header>().iter())
        .chain(names::<Narrative>())
        .chain(&["axis", "curve"])
        .chain(studies.iter().filter(|name| **name != SWEEP))
        .chain(names::<Sections>())
        .copied();
    match root.unknown(known) {
        Some((span, among)) => Err(source.at(Some(span), ExperimentError::Unknown(among))),
        None => Ok(()),
    }
}

/// The one study whose table is in the file.
fn study(
    source: &Source,
    root: &Node,
    studies: &[&'static str],
) -> Result<&'static str, ConfigError> {
    let there = |name: &&'static str| Some((*name, root.get(name)?.span.clone()));
    let mut asked: Vec<_> = studies.iter().filter_map(there).collect();
    // A message about two studies names [axis] first, wherever it stands in the file.
    asked.sort_by_key(|(name, span)| (*name != SWEEP, span.start));
    match &asked[..] {
        [] => {
            let others = studies.iter().filter(|name| **name != SWEEP);
            let tables: Vec<String> = others.map(|name| format!("[{name}]")).collect();
            let error = ExperimentError::NothingToDo(tables.join(", "));
            Err(source.at(Some(0..1), error))
        }
        [(name, _)] => Ok(name),
        [(first, _), (second, span), ..] => Err(source.at(
            Some(span.clone()),
            ExperimentError::TwoThingsToDo { first, second },
        )),
    }
}
