//! The boundaries C_W(T) of several rules at the same sizes and level, eqs (10)–(11) and (15) of [^1].
//!
//! [^1]: see [`crate::signal`].

pub(super) mod picture;
mod row;

pub use row::Row;

use crate::chain::Scenario;
use crate::config::Conflict;
use crate::counts::Counts;
use crate::detect::{Method, NullLaws, Region, RegionError, Rule};
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::rule::OutOfRange;
use crate::run::{Identity, StudyError};
use crate::scenario::{Calibration, ScenarioError};
use crate::study::kind::{Context, Study};
use crate::study::rules::distinct;
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;

/// The plane of W and T with the regions of several rules.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Keys {
    /// Rules with an exact region.
    rules: Vec<Method>,
}

/// A reader cannot distinguish more regions than this.
const MOST_RULES: usize = 36;

/// The rules of methods that have exact regions, each once.
fn with_regions(methods: Vec<Method>) -> Result<Vec<Rule>, Conflict> {
    let words = ["rule", "rules"];
    distinct(
        "region.rules",
        words,
        MOST_RULES,
        &methods,
        Method::to_string,
    )?;
    let rule = |(i, method)| match method {
        Method::Rule(rule) => Ok(rule),
        other => {
            let must = "have an exact region (name wilcoxon, product, disjunction or conjunction)";
            Err(OutOfRange::new(format!("region.rules[{i}]"), must, other).into())
        }
    };
    methods.into_iter().enumerate().map(rule).collect()
}

/// The regions of several rules at the same sizes and level.
pub(super) struct Regions {
    scenario: Scenario,
    regions: Vec<(Rule, Region)>,
}

impl Regions {
    /// # Errors
    /// If a rule has no region.
    fn new(scenario: Scenario, rules: Vec<Rule>) -> Result<Self, RegionError> {
        let detector = &scenario.detector;
        let laws = NullLaws::new(
            detector.exceedances,
            detector.alternative,
            &scenario.samples,
        )?;
        let mut regions = Vec::new();
        for rule in rules {
            let region = laws.region(&rule, detector.alpha)?;
            regions.push((rule, region));
        }
        Ok(Self { scenario, regions })
    }
}

impl Study for Regions {
    const NAME: &'static str = "region";
    const USES: &'static [&'static str] = &[
        "samples.reference",
        "samples.shift",
        "samples.scale",
        "detector.alpha",
        "detector.alternative",
        "detector.exceedances",
        "detector.ties",
        "detector.calibrate",
    ];
    const COUNTS_TRIALS: bool = false;
    type Row = Row;

    fn read(experiment: &Experiment, _context: Context) -> Result<Self, StudyError> {
        let Keys { rules } = experiment.read()?;
        let rules = with_regions(rules).map_err(|conflict| experiment.conflict(conflict))?;
        let scenario = experiment.scenario()?;
        let is_table = |rule: &Rule| matches!(rule, Rule::Table(_));
        if scenario.detector.calibration != Calibration::None && rules.iter().any(is_table) {
            let conflict = Conflict::of(["detector.calibrate"], ScenarioError::TableCalibrated);
            return Err(experiment.conflict(conflict).into());
        }
        let study = Self::new(scenario, rules);
        Ok(study.map_err(|error| experiment.refuse(ScenarioError::from(error)))?)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Keys::json_schema(generator).to_value()
    }

    fn identities(&self) -> Vec<Identity> {
        let Scenario {
            samples, detector, ..
        } = &self.scenario;
        let identity = |(rule, _): &(Rule, Region)| {
            Identity::new([
                ("samples", samples.to_string()),
                ("alpha", detector.alpha.to_string()),
                ("alternative", detector.alternative.to_string()),
                ("exceedances", detector.exceedances.to_string()),
                ("rule", rule.to_string()),
            ])
        };
        self.regions.iter().map(identity).collect()
    }

    fn rows(&self, _counts: &Counts) -> Vec<Row> {
        let regions = self.regions.iter();
        regions
            .flat_map(|(rule, region)| boundary(rule, region))
            .collect()
    }

    fn plot(&self, rows: &[Row], _seed: u64) -> Result<Plot, FigureError> {
        let (samples, detector) = (&self.scenario.samples, &self.scenario.detector);
        let laws = NullLaws::new(detector.exceedances, detector.alternative, samples)?;
        let title = picture::title(samples, detector.alternative, detector.alpha);
        Ok(picture::plot(&laws, rows, &title))
    }
}

/// The rows of one region.
pub fn boundary(rule: &Rule, region: &Region) -> Vec<Row> {
    let critical = region.critical_values().into_iter().enumerate();
    critical
        .map(|(exceedances, (lower, upper))| Row {
            rule: rule.to_string(),
            size: region.size(),
            exceedances,
            lower,
            upper,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::independence;
    use crate::study::tests::{read, rows};

    /// Compares the size of each boundary with the sum of its cells in a full enumeration of ranks.
    #[test]
    fn sizes_are_those_of_an_enumeration() {
        let text = "question = \"?\"\nseed = 1\n[region]\nrules = [\"wilcoxon\", \"product\", \
                    \"disjunction\"]\n[samples]\nreference = 3\nshift = 3\nscale = 3\n\
                    [detector]\nalpha = 0.2\nalternative = \"two-sided\"\n";
        let cells = independence::rows(&[[3, 3, 3]]);
        let study: Regions = read(text);
        let rows = rows(&study, 1);
        assert_eq!(rows.len(), 12);
        for of_rule in rows.chunk_by(|a, b| a.rule == b.rule) {
            let is_inside = |cell: &&independence::Row| {
                let row = &of_rule[cell.exceedances];
                row.upper.is_some_and(|w| cell.rank_sum >= w)
                    || row.lower.is_some_and(|w| cell.rank_sum <= w)
            };
            let size: f64 = cells.iter().filter(is_inside).map(|cell| cell.joint).sum();
            assert!(size > 0.0 && (size - of_rule[0].size).abs() < 1e-14);
        }
    }
}
