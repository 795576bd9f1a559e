//! `[axis]`: how often each point of each curve decides for H₁, along an axis.

mod labels;
mod outcomes;
pub(super) mod picture;
mod tally;
mod targets;
mod trials;
mod x_axis;

use crate::claim::{self, Evidence, Outcome, Scope, Test};
use crate::counts::{Counts, Key, Sums};
use crate::experiment::{Experiment, SWEEP, SweepConfig, schema};
use crate::figure::FigureError;
use crate::plan::Hypothesis;
use crate::plot::Plot;
use crate::results::{Comparison, Quantity, Row};
use crate::run::{Identity, StudyError, Trials};
use crate::scenario::{PARAMETERS, Sections};
use crate::stats::tally::Tally;
use crate::study::kind::{Context, Study, counted};
pub use outcomes::TrialOutcomes;
use schemars::SchemaGenerator;
use serde_json::Value;
pub use targets::Sweep;
use targets::{Compared, Subject};

impl Study for Sweep {
    const NAME: &'static str = SWEEP;
    /// The curves may change any section.
    const USES: &'static [&'static str] = &[];
    const COUNTS_TRIALS: bool = true;
    type Row = Row;

    fn read(experiment: &Experiment, _context: Context) -> Result<Self, StudyError> {
        let config = SweepConfig::new(experiment.clone())?;
        targets::check_sizes(&config)?;
        Ok(Self::new(config)?)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        let sections = schema::properties::<Sections>(generator);
        let swept = PARAMETERS.iter().filter(|parameter| parameter.is_swept());
        schema::axis(swept.map(|parameter| {
            let path = parameter.paths[0].split_once('.');
            let (section, key) = path.expect("a parameter is a key of a section");
            let mut value = sections[section]["properties"][key].clone();
            if parameter.paths.len() > 1 {
                value["description"] = parameter.axis_label.into();
            }
            (parameter.name, value)
        }))
    }

    fn identities(&self) -> Vec<Identity> {
        targets::identities(&self.plan).collect()
    }

    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        Some(Box::new(trials::Sampling::new(self)))
    }

    fn rows(&self, counts: &Counts) -> Vec<Row> {
        let points = self.plan.points.iter().zip(&self.keys);
        let shape = Subject::Point(0).shape();
        let confidence = self.config.header().confidence.get();
        points
            .map(|(point, key)| {
                let (trials, sums) = counted(counts, key, &shape);
                let tally = Tally {
                    hits: sums.counts[0],
                    trials,
                };
                let decision = counts.decisions.get(key).copied();
                Row::new(point, decision, tally, confidence)
            })
            .collect()
    }

    fn comparisons(&self, rows: &[Row], counts: &Counts) -> Vec<Comparison> {
        let tallies: Vec<Tally> = rows.iter().map(|row| row.tally).collect();
        let discordant = |compared: &Compared| match compared {
            Compared::Itself => Some([0, 0]),
            Compared::Paired(key, places) => {
                let (_, sums) = counted(counts, key, &Subject::Pair(*places).shape());
                Some([sums.counts[0], sums.counts[1]])
            }
            Compared::Apart => None,
        };
        let discordant: Vec<_> = self.compared.iter().map(discordant).collect();
        let claims = &self.config.narrative.claims;
        claim::comparisons(claims, &self.pairs, &tallies, &discordant)
    }

    /// The numbers that claims about gains need.
    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        let evidence = Evidence {
            scope: self.scope(),
            outcomes: self.outcomes(rows),
            ..Evidence::default()
        };
        Ok(claim::gains(&self.config.narrative.claims, &evidence)?)
    }

    fn recall(&self, rows: &[Row], comparisons: &[Comparison]) -> Option<Counts> {
        if rows.len() != self.keys.len() {
            return None;
        }
        let mut counts = Counts::default();
        let mut add = |key: &Key, trials: u64, sums: &[u64]| {
            if counts.get(key).is_none() {
                let added = counts.add(key, 0..trials, &Sums::of(sums));
                added.expect("a key is added once");
            }
        };
        for (key, row) in self.keys.iter().zip(rows) {
            add(key, row.tally.trials, &[row.tally.hits]);
        }
        if comparisons.len() == self.compared.len() {
            for (compared, row) in self.compared.iter().zip(comparisons) {
                if let Compared::Paired(key, _) = compared {
                    add(key, row.trials, &[row.first_only?, row.second_only?]);
                }
            }
        }
        let decisions = self
            .keys
            .iter()
            .cloned()
            .zip(rows.iter().map(Row::decision));
        counts.decisions = decisions.collect();
        Some(counts)
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        let step_gain =
            |places: &Vec<usize>| self.plan.points[places[0]].scenario.sensor.step_gain();
        let step_gains: Vec<f64> = self.plan.along.iter().map(step_gain).collect();
        let excess = self
            .config
            .narrative
            .claims
            .iter()
            .filter_map(|claim| match claim.test {
                Test::AlphaHeld { excess, .. } => Some(excess.get()),
                _ => None,
            });
        let frame = picture::Frame {
            scope: &self.config.scope,
            step_gains: &step_gains,
            excess: excess.reduce(f64::max),
        };
        picture::plot(&frame, rows, seed)
    }

    fn points(&self) -> String {
        let points = &self.plan.points;
        let at_rest = points
            .iter()
            .filter(|p| p.hypothesis == Hypothesis::H0)
            .count();
        format!(
            "{} in motion, {at_rest} at rest, of {} curves",
            points.len() - at_rest,
            self.config.scope.curves.len()
        )
    }

    fn scope(&self) -> Scope {
        self.config.scope.clone()
    }

    fn outcomes(&self, rows: &[Row]) -> Vec<Outcome> {
        let parameter = self.config.parameter();
        rows.iter().map(|row| row.outcome(parameter)).collect()
    }
}
