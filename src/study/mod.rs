//! Studies: what a config's table describes, one file and one line in the registry each.
//!
//! A study comes to rows of its own (`points.csv`), from which its picture is drawn, and where it has any to
//! single numbers (`quantities.csv`). What it counts in trials goes through [`run`](crate::run); what it computes
//! is a function of the config alone.

pub(crate) mod autocorrelation;
pub(crate) mod impulse_law;
pub(crate) mod independence;
pub(crate) mod layout;
mod loaded;
pub(crate) mod operating_point;
pub(crate) mod region;
pub mod ride;
mod sweep;
pub(crate) mod trace;

pub use loaded::{DrawError, Loaded, Output};

/// The plane of W and T, for `threshold`.
pub mod plane {
    pub use super::region::boundary;
    pub use super::region::picture::{plot, title};
}

/// The rows of each study.
pub mod rows {
    pub use super::autocorrelation::Row as Autocorrelation;
    pub use super::impulse_law::Row as ImpulseLaw;
    pub use super::independence::{Row as Independence, findings};
    pub use super::layout::Row as Layout;
    pub use super::operating_point::Row as OperatingPoint;
    pub use super::region::{Row as Region, boundary};
    pub use super::ride::Row as Ride;
    pub use super::trace::Row as Trace;
}

use crate::claim::{Outcome, Scope};
use crate::counts::{Counts, Key, Shape, Sums};
use crate::experiment::{ExhibitConfig, ExhibitKind, Experiment};
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::{Comparison, Quantity};
use crate::run::{Identity, StudyError, Target, Trials};
use loaded::AnyStudy;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeSet;

/// What a config's table describes.
pub trait Study: Send + Sync {
    /// The name of its table.
    const NAME: &'static str;

    /// One of `points.csv`.
    type Row: Serialize + DeserializeOwned;

    /// What it is of, point by point: every parameter that changes what comes out.
    fn identities(&self) -> Vec<Identity>;

    /// What it counts; none where everything is computed.
    fn trials(&self) -> Option<Box<dyn Trials + '_>> {
        None
    }

    /// What it comes to. Counters that are not there count as one trial in which nothing happened.
    fn rows(&self, counts: &Counts) -> Vec<Self::Row>;

    /// Pairs of points held against each other.
    fn comparisons(&self, _rows: &[Self::Row], _counts: &Counts) -> Vec<Comparison> {
        Vec::new()
    }

    /// Single numbers.
    ///
    /// # Errors
    /// Where a number is asked for that the rows do not give.
    fn quantities(&self, _rows: &[Self::Row]) -> Result<Vec<Quantity>, StudyError> {
        Ok(Vec::new())
    }

    /// The counts behind its rows, where these tell them.
    fn recall(&self, _rows: &[Self::Row], _comparisons: &[Comparison]) -> Option<Counts> {
        None
    }

    /// Draws the rows.
    ///
    /// # Errors
    /// Where there is nothing to draw, or drawing fails.
    fn plot(&self, rows: &[Self::Row], seed: u64) -> Result<Plot, FigureError>;

    /// What is said of the rows when they are written.
    fn findings(&self, _rows: &[Self::Row]) -> Option<Table> {
        None
    }

    /// How many points there are, in words, for a plan.
    fn points(&self) -> String {
        let points = self.trials().map_or(1, |trials| trials.points());
        format!("{points} of [{}]", Self::NAME)
    }

    /// What claims about curves are judged by: what they may refer to, and the rates.
    fn curves(&self, _rows: &[Self::Row]) -> (Scope, Vec<Outcome>) {
        (Scope::default(), Vec::new())
    }
}

/// More than a study should be asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: must be at most {most}, got {got} ({remedy})")]
pub struct TooMany {
    /// Of what.
    what: &'static str,
    most: usize,
    got: usize,
    remedy: &'static str,
}

impl TooMany {
    /// Refuses more than `most`.
    fn check(
        what: &'static str,
        got: usize,
        most: usize,
        remedy: &'static str,
    ) -> Result<(), Self> {
        if got <= most {
            return Ok(());
        }
        Err(Self {
            what,
            most,
            got,
            remedy,
        })
    }
}

/// A header and lines.
pub type Table = (&'static [&'static str], Vec<Vec<String>>);

/// What the studies of one config share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Context {
    /// Where every draw starts from.
    pub seed: u64,
    /// Trials per point.
    pub trials: u64,
    /// Of the intervals.
    pub confidence: f64,
}

/// The study that a config describes.
fn build(experiment: &Experiment) -> Result<Box<dyn AnyStudy>, StudyError> {
    let config = match experiment {
        Experiment::Sweep(config) => return Ok(Box::new(sweep::Sweep::new(config)?)),
        Experiment::Exhibit(config) => config,
    };
    let ExhibitConfig {
        seed,
        trials,
        confidence,
        ..
    } = **config;
    let context = Context {
        seed,
        trials,
        confidence,
    };
    let scenario = config.scenario.clone();
    Ok(match config.kind.clone() {
        ExhibitKind::Autocorrelation { lags, length } => Box::new(
            autocorrelation::Autocorrelation::new(context, scenario, lags, length),
        ),
        ExhibitKind::Trace(trace) => Box::new(trace::Realisation::new(seed, scenario, trace)),
        ExhibitKind::Layout => Box::new(layout::Layout(scenario)),
        ExhibitKind::Region { rules } => {
            let regions = region::Regions::new(scenario, rules);
            Box::new(regions.map_err(|error| config.refuse_region(error))?)
        }
        ExhibitKind::Independence { sizes } => Box::new(independence::Independence { sizes }),
        ExhibitKind::ImpulseLaw { nu, length } => {
            Box::new(impulse_law::ImpulseLaw::new(context, nu, length))
        }
        ExhibitKind::OperatingPoint(search) => {
            let study = operating_point::OperatingPoint::new(context, &scenario, search);
            Box::new(study.map_err(|problem| config.refuse(problem))?)
        }
        ExhibitKind::Ride(study) => Box::new(ride::Rides::new(context, study)?),
    })
}

/// The counters of the points of a study.
#[derive(Debug, Default)]
struct Counters {
    /// Of every point.
    keys: Vec<Key>,
    /// Every counter once.
    targets: Vec<Target>,
    /// The first point of each.
    points: Vec<usize>,
}

impl Counters {
    fn new<S: Study>(study: &S, seed: u64, shape: &Shape) -> Self {
        let mut counters = Self::default();
        let mut known = BTreeSet::new();
        for (point, identity) in study.identities().iter().enumerate() {
            let key = identity.key(S::NAME, seed, true);
            if known.insert(key.clone()) {
                let shape = shape.clone();
                counters.targets.push(Target {
                    key: key.clone(),
                    shape,
                });
                counters.points.push(point);
            }
            counters.keys.push(key);
        }
        counters
    }
}

/// What was counted of a target: its trials and sums; one trial in which nothing happened where nothing was.
fn counted(counts: &Counts, key: &Key, shape: &Shape) -> (u64, Sums) {
    match counts.get(key) {
        Some(counter) if !counter.trials.is_empty() => (counter.trials.len(), counter.sums.clone()),
        _ => (1, shape.empty().sums),
    }
}

#[cfg(test)]
mod tests_of_pictures;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::whole;

    /// The config of something that is no sweep.
    pub fn config(text: &str) -> ExhibitConfig {
        match Experiment::parse("test", text) {
            Ok(Experiment::Exhibit(config)) => *config,
            other => panic!("{other:?}"),
        }
    }

    pub fn context(config: &ExhibitConfig) -> Context {
        Context {
            seed: config.seed,
            trials: config.trials,
            confidence: config.confidence,
        }
    }

    /// What a study comes to.
    pub fn rows<S: Study>(study: &S, trials: u64) -> Vec<S::Row> {
        let counts = study.trials().map(|all| whole(all, trials));
        study.rows(&counts.unwrap_or_default())
    }
}
