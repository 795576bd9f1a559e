//! What a directory holds, as counts; and whether they are those of an experiment.

use super::wanted::Wanted;
use super::{NOTHING, Terms};
use crate::config::{Config, Experiment};
use crate::ledger::{Key, Ledger};
use crate::plan::Plan;
use crate::results::{Checkpoint, Directory, Manifest, Origin, RESULTS, ResultsError, Row};
use std::collections::{BTreeMap, BTreeSet};

/// Counts of an experiment.
#[derive(Debug)]
pub(super) struct Held {
    pub state: Checkpoint,
    /// What made them, where they are a finished result.
    pub made_by: Option<Manifest>,
    /// The rows of a finished result.
    rows: Vec<Row>,
}

impl Held {
    /// Reads the counts of a run that is not over or, where there are none, those of a finished result.
    pub fn read(directory: &Directory, terms: Terms) -> Result<Option<Self>, ResultsError> {
        if terms == Terms::Fresh {
            return Ok(None);
        }
        directory.admit_any()?;
        if let Some(state) = directory.checkpoint()? {
            return Ok(Some(Self {
                state,
                made_by: None,
                rows: Vec::new(),
            }));
        }
        if !directory.is_finished() {
            return Ok(None);
        }
        match (Self::finished(directory), terms) {
            (Ok(held), _) => Ok(held),
            (Err(_), Terms::Adopt) => Ok(None),
            (Err(error), _) => Err(error),
        }
    }

    /// The counts of a finished result; none where they are not those of this version.
    fn finished(directory: &Directory) -> Result<Option<Self>, ResultsError> {
        let manifest = directory.manifest()?;
        let origin = Origin::from(&manifest);
        if let Ok(Experiment::Exhibit(config)) =
            Experiment::parse(&origin.config_name, &origin.config)
        {
            return Err(ResultsError::Different {
                path: directory.path().to_owned(),
                difference: format!("[{}] there, a sweep here", config.kind.name()),
            });
        }
        let rows = directory.rows(&manifest)?;
        let mut counters = Ledger::default();
        let mut told = BTreeMap::new();
        let trials = 0..origin.trials;
        for row in &rows {
            let key = row.key(origin.seed, origin.common_random_numbers);
            if told.insert(key.clone(), row.told()).is_none() {
                let added = counters.add(&key, trials.clone(), &[row.detections]);
                added.expect("a key is added once");
            }
        }
        let mut held = Self {
            state: Checkpoint {
                origin,
                shard: None,
                seconds: manifest.seconds,
                told,
                counters,
            },
            made_by: Some(manifest),
            rows,
        };
        held.read_comparisons(directory)?;
        Ok(Some(held))
    }

    /// Adds the counts of the pairs that the claims of a finished result compare.
    fn read_comparisons(&mut self, directory: &Directory) -> Result<(), ResultsError> {
        let manifest = self.made_by.as_ref().expect("results have a manifest");
        let comparisons = directory.comparisons(manifest)?;
        let plan = match comparisons.is_empty() {
            true => None,
            false => self.plan(),
        };
        let Some((config, plan)) = plan else {
            return Ok(());
        };
        let pairs = plan.pairs(&config);
        if pairs.len() != comparisons.len() || plan.points.len() != self.rows.len() {
            return Ok(());
        }
        let key = |place: usize| {
            let Origin {
                seed,
                common_random_numbers,
                ..
            } = self.state.origin;
            self.rows[place].key(seed, common_random_numbers)
        };
        for (pair, comparison) in pairs.iter().zip(&comparisons) {
            let keys = [pair.first, pair.second].map(key);
            let counts = comparison.first_only.zip(comparison.second_only);
            let Some((first, second)) = counts.filter(|_| keys[0] != keys[1]) else {
                continue;
            };
            let key = Key::pair([&keys[0], &keys[1]]);
            if self.state.counters.get(&key).is_none() {
                let trials = 0..comparison.trials;
                let added = self.state.counters.add(&key, trials, &[first, second]);
                added.expect("a key is added once");
            }
        }
        Ok(())
    }

    /// The plan behind the counts, where this version can still make it.
    fn plan(&self) -> Option<(Config, Plan)> {
        let config = self.state.origin.sweep().ok()?;
        let plan = Plan::new(&config).ok()?;
        Some((config, plan))
    }

    /// Whether these counts may be gone on with in the run `here`.
    pub fn admit(
        &self,
        directory: &Directory,
        here: &Checkpoint,
        plan: &Plan,
        wanted: &Wanted,
        terms: Terms,
    ) -> Result<(), ResultsError> {
        let path = directory.path().to_owned();
        let difference = self.difference(here, plan, wanted);
        let is_adopted = terms == Terms::Adopt && self.state.shard.is_none();
        if let Some(difference) = difference.filter(|_| !is_adopted) {
            return Err(ResultsError::Different { path, difference });
        }
        let (held, asked) = (self.state.origin.trials, here.origin.trials);
        match held > asked {
            true => Err(ResultsError::FewerTrials { path, held, asked }),
            false => Ok(()),
        }
    }

    /// Keeps the counters that are wanted, none of another version.
    pub fn keep(&mut self, wanted: &Wanted) {
        let subjects = wanted.subjects();
        let is_of_this_version = self.state.origin.results == RESULTS;
        let is_kept = |key: &Key| is_of_this_version && subjects.contains_key(key);
        self.state.counters.retain(is_kept);
        self.state.told.retain(|key, _| is_kept(key));
        if self.state.told.is_empty() {
            self.state.seconds = 0.0;
            self.made_by = None;
        }
    }

    /// The first thing that keeps these counts from being those of the run `here`; labels, captions, claims
    /// and the number of trials do not count, nor does what is not here yet.
    fn difference(&self, here: &Checkpoint, plan: &Plan, wanted: &Wanted) -> Option<String> {
        let (there, origin) = (&self.state.origin, &here.origin);
        let differs = |name, there: &dyn ToString, here: &dyn ToString| {
            let (there, here) = (there.to_string(), here.to_string());
            (there != here).then(|| format!("{name} is {there} there, {here} here"))
        };
        let shard = |state: &Checkpoint| match state.shard {
            Some(shard) => format!("shard {shard}"),
            None => "all of a run".to_owned(),
        };
        let trials = self.state.shard.map(|_| there.trials);
        // Finished results of another version are replaced by those of this one.
        let is_finished = self.made_by.is_some();
        differs("seed", &there.seed, &origin.seed)
            .or_else(|| {
                let (there, here) = (there.common_random_numbers, origin.common_random_numbers);
                differs("common_random_numbers", &there, &here)
            })
            .or_else(|| differs("it", &shard(&self.state), &shard(here)))
            .or_else(|| differs("trials of a shard", &trials?, &origin.trials))
            .or_else(|| self.odd_point(plan, wanted))
            .or_else(|| {
                differs("results version", &there.results, &origin.results).filter(|_| !is_finished)
            })
    }

    /// How a point that is held and not wanted differs from the most similar one that is.
    fn odd_point(&self, plan: &Plan, wanted: &Wanted) -> Option<String> {
        let known: BTreeSet<&Key> = wanted.points.iter().collect();
        let counters = self.state.counters.iter();
        let mut points = counters.filter(|(_, counter)| counter.counts.len() == 1);
        if points.all(|(key, _)| known.contains(key)) {
            return None;
        }
        let Origin {
            seed,
            common_random_numbers,
            ..
        } = self.state.origin;
        let rows = match self.rows.is_empty() {
            false => self.rows.clone(),
            true => match self.plan() {
                Some((_, plan)) => rows(&plan),
                None => return Some("its config cannot be planned any more".to_owned()),
            },
        };
        let is_odd = |row: &&Row| !known.contains(&row.key(seed, common_random_numbers));
        let Some(odd) = rows.iter().find(is_odd) else {
            return Some("it has points that are not here".to_owned());
        };
        let there = odd.parameters();
        let distance = |row: &Row| {
            let here = row.parameters();
            there.iter().zip(&here).filter(|(a, b)| a.1 != b.1).count()
        };
        // What is here and there is no counterpart of it.
        let is_new = |row: &Row| {
            let key = row.key(seed, common_random_numbers);
            self.state.counters.get(&key).is_none()
        };
        let nearest = rows_of(plan)
            .min_by_key(|row| (!is_new(row), distance(row), row.curve != odd.curve))?;
        let is_place = |name: &str| ["curve", "hypothesis"].contains(&name);
        let here = nearest.parameters();
        let mut cells = there.iter().zip(&here);
        let ((name, there), (_, here)) =
            cells.find(|(there, here)| there.1 != here.1 && !is_place(&there.0))?;
        Some(format!(
            "{name} is {there} there, {here} here, in curve {}",
            odd.curve
        ))
    }
}

fn rows_of(plan: &Plan) -> impl Iterator<Item = Row> + '_ {
    plan.points
        .iter()
        .map(|point| Row::new(point, None, NOTHING, 0.5))
}

fn rows(plan: &Plan) -> Vec<Row> {
    rows_of(plan).collect()
}
