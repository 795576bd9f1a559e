//! `liftsim check CONFIG|DIR`: the false-alarm gate, on trials of its own or on results.

mod findings;
mod format;

use super::progress::{self, Progress, Reporter};
use super::store::stored;
use super::{CommandResult, Counted, Failure, print};
use anyhow::anyhow;
use clap::Args;
use findings::Report;
use format::Format;
use liftsim::config::Shipped;
use liftsim::counts::Counts;
use liftsim::experiment::{Experiment, SWEEP, SweepConfig};
use liftsim::format::brief;
use liftsim::gate::{self, Finding, Scenario, Verdict};
use liftsim::results::{Directory, Origin, Row};
use liftsim::rule::OutOfRange;
use liftsim::study::{self, Loaded, Study, Sweep};
use std::process::ExitCode;

/// Test that the false-alarm rate of every scenario at rest stays at or below its level.
///
/// Of a study of floors: that ordinary stops alarm at most once in a thousand. Of a study of run lengths: that the mean time
/// between false alarms is at least what is promised.
///
/// Each scenario gets an exact one-sided binomial test, all of them corrected together (Holm) at a
/// family-wise level of 0.001. A scenario passes only where the run could have seen a rate of 1.2
/// times nominal with probability 0.99. Of a directory of results its counts are tested, and nothing is simulated. Exit 0: every scenario passes. 1: one fails. 3: none fails,
/// but one is inconclusive, so more trials are needed.
#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    counted: Counted,
    /// Test against this rate, while the regions keep the config's alpha.
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    nominal: Option<f64>,
    /// How the findings are printed.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    progress: Progress,
}

impl Check {
    /// Runs the command.
    pub fn run(self, quiet: bool) -> CommandResult {
        if let Some(nominal) = self.nominal
            && !(nominal > 0.0 && nominal < 1.0)
        {
            return Err(Failure::Input(anyhow!(
                "--nominal must lie strictly between 0 and 1, got {}",
                brief(nominal)
            )));
        }
        let results = self.results()?;
        let experiment = match &results {
            Some((origin, _)) => {
                study::parse(&origin.config_name, &origin.config).map_err(Failure::input)?
            }
            None => self.counted.config()?,
        };
        let points = results.map(|(_, points)| points);
        let is_counted = points.is_some();
        self.counted.simulation.start_threads()?;
        let reporter = Reporter::new(quiet, &self.progress, "");
        if experiment.study() != SWEEP {
            let loaded = Loaded::new(experiment.clone()).map_err(Failure::study)?;
            if let Some(nothing) = loaded.study.nothing_promised() {
                return self.promises(&experiment, &loaded, points, nothing, &reporter);
            }
        }
        let sweep = sweep(experiment)?;
        let rows = match points {
            Some(points) => {
                let rows = at_rest(&points).map_err(Failure::run)?;
                whole(rows.len(), sweep.rows(&Counts::default()).len())?;
                rows
            }
            None => sweep.rows(&progress::count(&sweep, &reporter)?),
        };
        let nominal = |row: &Row| self.nominal.unwrap_or(row.alpha());
        let scenarios = rows.iter().map(|row| (nominal(row), row.tally));
        let findings = gate::judge(&scenarios.collect::<Vec<_>>());
        let config = &sweep.config;
        let report = Report {
            names: rows.iter().map(|row| scenario(config, row)).collect(),
            regions: Some(rows.iter().map(region).collect()),
            findings: &findings,
            cases: "trials per point",
            more: if is_counted {
                "with the config: --trials"
            } else {
                "--trials"
            },
            seed: config.header().seed,
            confidence: config.header().confidence.get(),
        };
        print(&report.show(self.format))?;
        Ok(code(&findings))
    }

    /// The origin and the rows of the results that are to be tested, if it is not a config.
    fn results(&self) -> Result<Option<(Origin, Vec<u8>)>, Failure> {
        let path = &self.counted.simulation.config;
        let directory = Directory::new(path);
        // A shipped config may have the name of a folder, too.
        let is_shipped = path.to_str().and_then(Shipped::find).is_some();
        if is_shipped || !path.is_dir() {
            return Ok(None);
        }
        if !directory.is_finished() {
            return Err(Failure::Input(anyhow!(
                "{}: holds no finished results to be tested (give a config, or a folder that `liftsim sweep` has made)",
                path.display()
            )));
        }
        if let Some(flag) = self.counted.flag() {
            return Err(Failure::Input(anyhow!(
                "{flag}: means nothing to results, whose trials are counted (leave it out, or give the config)"
            )));
        }
        let manifest = directory.manifest().map_err(Failure::input)?;
        let loaded = stored(&directory, &manifest.origin)?;
        if directory.complete(&manifest.origin).is_none() {
            return Err(Failure::Input(anyhow!(
                "{}: a run is unfinished there, or a file is not the one that run.json vouches for (run `{}` again)",
                path.display(),
                manifest.command
            )));
        }
        let points = directory.points(&manifest).map_err(Failure::input)?;
        let comparisons = directory.comparisons(&manifest).map_err(Failure::input)?;
        (loaded.verify(&points, &comparisons))
            .map_err(|error| Failure::input(directory.impossible(&error)))?;
        Ok(Some((manifest.origin, points)))
    }

    /// Tests the rates that a study promises: of stops in simulated buildings, of blocks at rest.
    fn promises(
        &self,
        experiment: &Experiment,
        loaded: &Loaded,
        points: Option<Vec<u8>>,
        nothing: OutOfRange,
        reporter: &Reporter,
    ) -> CommandResult {
        let points = match points {
            Some(points) => points,
            None => {
                let counts = progress::count_all(loaded, reporter)?;
                let output = loaded.study.output(&counts);
                output.map_err(Failure::study)?.points
            }
        };
        let scenarios = loaded.study.false_alarms(&points);
        let scenarios = scenarios.map_err(Failure::run)?;
        let Some(Scenario { cases, .. }) = scenarios.first() else {
            return Err(Failure::input(experiment.conflict(nothing.into())));
        };
        let nominal = |scenario: &Scenario| self.nominal.unwrap_or(scenario.nominal);
        let tallies = scenarios.iter().map(|of| (nominal(of), of.tally));
        let findings = gate::judge(&tallies.collect::<Vec<_>>());
        let report = Report {
            names: scenarios.iter().map(|of| of.name.clone()).collect(),
            regions: None,
            findings: &findings,
            cases,
            more: "",
            seed: experiment.header.seed,
            confidence: experiment.header.confidence.get(),
        };
        print(&report.show(self.format))?;
        Ok(code(&findings))
    }
}

/// The config's points at rest, and nothing that is claimed of them.
fn sweep(mut experiment: Experiment) -> Result<Sweep, Failure> {
    experiment.header.at_rest = true;
    let mut config = SweepConfig::new(experiment).map_err(Failure::input)?;
    config.narrative.claims.clear();
    Sweep::new(config).map_err(Failure::input)
}

/// Refuses results that have lost rows.
fn whole(rows: usize, expected: usize) -> Result<(), Failure> {
    if rows == expected {
        return Ok(());
    }
    Err(Failure::Input(anyhow!(
        "points.csv: must have {expected} rows at rest as its config has, got {rows} (sweep it again)"
    )))
}

/// The rows of a sweep that are at rest.
fn at_rest(points: &[u8]) -> Result<Vec<Row>, csv::Error> {
    let rows = csv::Reader::from_reader(points).into_deserialize();
    let mut rows: Vec<Row> = rows.collect::<Result<_, _>>()?;
    rows.retain(Row::is_at_rest);
    Ok(rows)
}

fn code(findings: &[Finding]) -> ExitCode {
    ExitCode::from(match gate::overall(findings) {
        Verdict::Pass => 0,
        Verdict::Fail => 1,
        Verdict::Inconclusive => 3,
    })
}

/// The rule of a point, and the exact size of its region.
fn region(row: &Row) -> (String, Option<f64>) {
    (row.values.rule_name(), row.size)
}

/// The curve's label, and what the axis changes unless another column says it, or it is a motion.
fn scenario(config: &SweepConfig, row: &Row) -> String {
    let parameter = config.parameter();
    let is_shown = ["motion.", "impulses.", "detector.alpha"]
        .iter()
        .any(|start| parameter.paths[0].starts_with(start));
    match row.on_axis(parameter) {
        Some(value) if !is_shown => format!("{}, {} = {value}", row.label, parameter.name),
        _ => row.label.clone(),
    }
}
