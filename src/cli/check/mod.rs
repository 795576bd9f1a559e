//! `liftsim check CONFIG`: the false-alarm gate.

use super::progress::{self, Progress, Reporter};
use super::{CommandResult, Failure, Simulation, print, table};
use anyhow::anyhow;
use clap::Args;
use liftsim::experiment::{Experiment, SWEEP, SweepConfig};
use liftsim::format::{brief, eight_digits};
use liftsim::gate::{self, EXCESS, FAMILY_LEVEL, Finding, Scenario, Verdict};
use liftsim::results::Row;
use liftsim::rule::OutOfRange;
use liftsim::study::{Loaded, Study, Sweep};
use std::process::ExitCode;

/// Test that the false-alarm rate of every scenario at rest stays at or below its level.
///
/// Of a study of floors: that ordinary stops alarm at most once in a thousand. Of a study of run lengths: that the mean time
/// between false alarms is at least what is promised.
///
/// Each scenario gets an exact one-sided binomial test, all of them corrected together (Holm) at a
/// family-wise level of 0.001. A scenario passes only where the run could have seen a rate of 1.2
/// times nominal with probability 0.99. Exit 0: every scenario passes. 1: one fails. 3: none fails,
/// but one is inconclusive, so more trials are needed.
#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    simulation: Simulation,
    /// Test against this rate, while the regions keep the config's alpha.
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    nominal: Option<f64>,
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
        let experiment = self.simulation.config()?;
        self.simulation.start_threads()?;
        let reporter = Reporter::new(quiet, &self.progress, "");
        if experiment.study() != SWEEP {
            let loaded = Loaded::new(experiment.clone()).map_err(Failure::study)?;
            if let Some(nothing) = loaded.study.nothing_promised() {
                return self.promises(&experiment, &loaded, nothing, &reporter);
            }
        }
        let sweep = sweep(experiment)?;
        let counts = progress::count(&sweep, &reporter)?;
        let rows = sweep.rows(&counts);
        let nominal = |row: &Row| self.nominal.unwrap_or(row.alpha());
        let scenarios = rows.iter().map(|row| (nominal(row), row.tally));
        let findings = gate::judge(&scenarios.collect::<Vec<_>>());
        print(&report(&sweep.config, &rows, &findings))?;
        Ok(code(&findings))
    }

    /// Tests the rates that a study promises: of stops in simulated buildings, of blocks at rest.
    fn promises(
        &self,
        experiment: &Experiment,
        loaded: &Loaded,
        nothing: OutOfRange,
        reporter: &Reporter,
    ) -> CommandResult {
        let (seed, confidence) = (experiment.header.seed, experiment.header.confidence.get());
        let counts = progress::count_all(loaded, reporter)?;
        let output = loaded.study.output(&counts).map_err(Failure::study)?;
        let scenarios = loaded.study.false_alarms(&output.points);
        let scenarios = scenarios.map_err(Failure::run)?;
        let Some(Scenario { cases, .. }) = scenarios.first() else {
            return Err(Failure::input(experiment.conflict(nothing.into())));
        };
        let nominal = |scenario: &Scenario| self.nominal.unwrap_or(scenario.nominal);
        let tallies = scenarios.iter().map(|of| (nominal(of), of.tally));
        let findings = gate::judge(&tallies.collect::<Vec<_>>());
        let header = [
            "scenario",
            "nominal",
            cases,
            "false alarms",
            "rate",
            "interval",
            "p",
            "verdict",
        ];
        let rows = scenarios.iter().zip(&findings).map(|(scenario, finding)| {
            let nominal = eight_digits(finding.nominal).to_string();
            let mut cells = vec![scenario.name.clone(), nominal];
            cells.extend(counted(finding, finding.tally.interval(confidence)));
            cells
        });
        let rows: Vec<_> = rows.collect();
        let summary = summary(&findings, cases, seed, confidence);
        print(&(table(&header, &rows) + &summary))?;
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

fn code(findings: &[Finding]) -> ExitCode {
    ExitCode::from(match gate::overall(findings) {
        Verdict::Pass => 0,
        Verdict::Fail => 1,
        Verdict::Inconclusive => 3,
    })
}

fn report(config: &SweepConfig, rows: &[Row], findings: &[Finding]) -> String {
    let header = [
        "scenario",
        "rule",
        "nominal",
        "exact size",
        "trials",
        "false alarms",
        "rate",
        "interval",
        "p",
        "verdict",
    ];
    let each = rows.iter().zip(findings);
    let cells: Vec<Vec<String>> = each
        .map(|(row, finding)| cells(config, row, finding))
        .collect();
    let (seed, confidence) = (config.header().seed, config.header().confidence.get());
    table(&header, &cells) + &summary(findings, "trials per point", seed, confidence)
}

/// The verdicts in all, and how many `cases` would be enough.
fn summary(findings: &[Finding], cases: &str, seed: u64, confidence: f64) -> String {
    let count = |verdict| findings.iter().filter(|f| f.verdict == verdict).count();
    let power = findings.iter().map(|f| f.power).fold(1.0, f64::min);
    let advice = match gate::trials_for_power(findings) {
        Some(trials) if power < gate::POWER => {
            format!("{trials} {cases} would be enough\n")
        }
        _ => String::new(),
    };
    format!(
        "\n{} scenarios at seed {seed}: {} pass, {} inconclusive, {} fail\n\
         family-wise level {FAMILY_LEVEL}; power against {EXCESS} times nominal at least {power:.4}; \
         {} % intervals\n{advice}",
        findings.len(),
        count(Verdict::Pass),
        count(Verdict::Inconclusive),
        count(Verdict::Fail),
        confidence * 100.0,
    )
}

fn cells(config: &SweepConfig, row: &Row, finding: &Finding) -> Vec<String> {
    let size = row.size.map(|size| digits(finding, size));
    let mut cells = vec![
        scenario(config, row),
        row.values.rule_name(),
        finding.nominal.to_string(),
        size.unwrap_or_default(),
    ];
    cells.extend(counted(finding, row.tally.interval(row.confidence)));
    cells
}

/// Four digits of the nominal rate, and six decimals at least.
fn digits(finding: &Finding, rate: f64) -> String {
    let decimals = (3.0 - finding.nominal.log10().floor()).max(6.0) as usize;
    format!("{rate:.decimals$}")
}

/// What was counted, and the verdict.
fn counted(finding: &Finding, (low, high): (f64, f64)) -> [String; 6] {
    let digits = |rate| digits(finding, rate);
    [
        finding.tally.trials.to_string(),
        finding.tally.hits.to_string(),
        digits(finding.tally.rate()),
        format!("[{}, {}]", digits(low), digits(high)),
        p_value(finding.p_value),
        match finding.verdict {
            Verdict::Pass => "pass",
            Verdict::Inconclusive => "inconclusive",
            Verdict::Fail => "FAIL",
        }
        .to_owned(),
    ]
}

/// Four decimals where they say something, a power of ten where they do not.
fn p_value(p: f64) -> String {
    match p {
        0.0 => "<1e-300".to_owned(),
        _ if p < 1e-3 => format!("{p:.2e}"),
        _ => format!("{p:.4}"),
    }
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
