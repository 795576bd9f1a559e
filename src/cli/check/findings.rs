//! The findings of the gate, for people and for machines.

use super::format::Format;
use crate::cli::rows::{Rows, Shown, pretty};
use crate::cli::table;
use liftsim::format::eight_digits;
use liftsim::gate::{self, EXCESS, FAMILY_LEVEL, Finding, Verdict};
use quick_xml::escape::escape;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// What was found, scenario by scenario.
pub struct Report<'a> {
    pub names: Vec<String>,
    /// The rule of each, and the exact size of its region if it has one.
    pub regions: Option<Vec<(String, Option<f64>)>>,
    pub findings: &'a [Finding],
    /// What is counted.
    pub cases: &'a str,
    /// The flag that asks for more of them, if one does.
    pub more: &'a str,
    pub seed: u64,
    pub confidence: f64,
}

const COLUMNS: [&str; 12] = [
    "scenario",
    "rule",
    "size",
    "nominal",
    "cases",
    "false_alarms",
    "rate",
    "low",
    "high",
    "p",
    "power",
    "verdict",
];

impl Report<'_> {
    /// The text in a format.
    pub fn show(&self, format: Format) -> String {
        match format {
            Format::Rows(format) => format.show(self),
            Format::Junit => self.junit(),
            Format::Github => self.annotations(),
        }
    }

    fn table(&self) -> String {
        let mut header = vec!["scenario"];
        if self.regions.is_some() {
            header.push("rule");
        }
        header.push("nominal");
        if self.regions.is_some() {
            header.push("exact size");
        }
        let cases = if self.regions.is_some() {
            "trials"
        } else {
            self.cases
        };
        let counted = ["false alarms", "rate", "interval", "p", "verdict"];
        header.extend([cases].iter().chain(&counted));
        let rows = (0..self.names.len()).map(|at| self.cells(at));
        table(&header, &rows.collect::<Vec<_>>())
    }

    fn cells(&self, at: usize) -> Vec<String> {
        let finding = &self.findings[at];
        let digits = |rate| digits(finding, rate);
        let mut cells = vec![self.names[at].clone()];
        match self.regions.as_ref().map(|regions| &regions[at]) {
            Some((rule, size)) => {
                cells.extend([rule.clone(), finding.nominal.to_string()]);
                cells.push(size.map(digits).unwrap_or_default());
            }
            None => cells.push(eight_digits(finding.nominal).to_string()),
        }
        let (low, high) = finding.tally.interval(self.confidence);
        cells.extend([
            finding.tally.trials.to_string(),
            finding.tally.hits.to_string(),
            digits(finding.tally.rate()),
            format!("[{}, {}]", digits(low), digits(high)),
            p_value(finding.p_value),
            match finding.verdict {
                Verdict::Fail => "FAIL".to_owned(),
                verdict => name(verdict).to_owned(),
            },
        ]);
        cells
    }

    fn count(&self, verdict: Verdict) -> usize {
        let with = self.findings.iter().filter(|of| of.verdict == verdict);
        with.count()
    }

    /// The verdicts in all, and how many cases would be enough.
    fn summary(&self) -> String {
        let power = self.findings.iter().map(|f| f.power).fold(1.0, f64::min);
        let advice = match gate::trials_for_power(self.findings) {
            Some(trials) if power < gate::POWER => {
                let flag = match self.more {
                    "" => String::new(),
                    more => format!(" ({more} {trials})"),
                };
                format!("{trials} {} would be enough{flag}\n", self.cases)
            }
            _ => String::new(),
        };
        format!(
            "\n{} scenarios at seed {}: {} pass, {} inconclusive, {} fail\n\
             family-wise level {FAMILY_LEVEL}; power against {EXCESS} times nominal at least {power:.4}; \
             {} % intervals\n{advice}",
            self.findings.len(),
            self.seed,
            self.count(Verdict::Pass),
            self.count(Verdict::Inconclusive),
            self.count(Verdict::Fail),
            self.confidence * 100.0,
        )
    }

    /// The scenario with what tells it from others of its name, in one line.
    fn full_name(&self, at: usize) -> String {
        let name = self.names[at].replace(
            |c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'),
            " ",
        );
        match &self.regions {
            Some(regions) => {
                let (rule, nominal) = (&regions[at].0, eight_digits(self.findings[at].nominal));
                format!("{name}, {rule}, alpha {nominal}")
            }
            None => name,
        }
    }

    /// Every scenario by its full name, and what was found. Names that are there again are numbered, since a test runner
    /// takes equal ones for one.
    fn named(&self) -> impl Iterator<Item = (String, &Finding)> {
        let mut times: BTreeMap<String, usize> = BTreeMap::new();
        let names = (0..self.names.len()).map(move |at| {
            let name = self.full_name(at);
            let times = times.entry(name.clone()).or_default();
            *times += 1;
            if *times == 1 {
                name
            } else {
                format!("{name} ({times})")
            }
        });
        names.zip(self.findings)
    }

    fn facts(&self) -> Value {
        let scenarios = self.findings.iter().enumerate().map(|(at, of)| {
            let (low, high) = of.tally.interval(self.confidence);
            let region = self.regions.as_ref().map(|regions| &regions[at]);
            json!({
                "scenario": self.names[at], "rule": region.map(|region| &region.0),
                "size": region.and_then(|region| region.1), "verdict": name(of.verdict), "nominal": of.nominal,
                "cases": of.tally.trials, "false_alarms": of.tally.hits, "rate": of.tally.rate(),
                "low": low, "high": high, "p": of.p_value, "power": of.power,
            })
        });
        let verdict = gate::overall(self.findings);
        json!({
            "verdict": name(verdict), "seed": self.seed, "confidence": self.confidence,
            "counted": self.cases, "scenarios": scenarios.collect::<Vec<_>>(),
        })
    }

    /// What was counted in one scenario, in words.
    fn words(&self, of: &Finding) -> String {
        let (low, high) = of.tally.interval(self.confidence);
        let digits = |rate| digits(of, rate);
        format!(
            "{} false alarms of {}, a rate of {} [{}, {}] for a nominal {}, p = {}",
            of.tally.hits,
            of.tally.trials,
            digits(of.tally.rate()),
            digits(low),
            digits(high),
            eight_digits(of.nominal),
            p_value(of.p_value),
        )
    }

    fn junit(&self) -> String {
        let mut text = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <testsuite name=\"liftsim check\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n",
            self.findings.len(),
            self.count(Verdict::Fail),
            self.count(Verdict::Inconclusive),
        );
        for (scenario, of) in self.named() {
            let words = self.words(of);
            let words = escape(&*words);
            let outcome = match of.verdict {
                Verdict::Pass => format!("<system-out>{words}</system-out>"),
                Verdict::Inconclusive => {
                    format!("<skipped message=\"too few to tell: {words}\"/>")
                }
                Verdict::Fail => format!("<failure message=\"{words}\"/>"),
            };
            let scenario = escape(scenario.as_str());
            text += &format!(
                "  <testcase classname=\"liftsim check\" name=\"{scenario}\">{outcome}</testcase>\n"
            );
        }
        text + "</testsuite>\n"
    }

    fn annotations(&self) -> String {
        let mut text = String::new();
        for (scenario, of) in self.named() {
            let (kind, problem) = match of.verdict {
                Verdict::Pass => continue,
                Verdict::Inconclusive => ("warning", "too few to tell"),
                Verdict::Fail => ("error", "too many false alarms"),
            };
            let scenario = scenario.replace('%', "%25");
            text += &format!(
                "::{kind} title=liftsim check::{scenario}: {problem}, {}\n",
                self.words(of)
            );
        }
        text + self.summary().trim_start()
    }
}

impl Shown for Report<'_> {
    fn text(&self) -> String {
        self.table() + &self.summary()
    }

    fn json(&self) -> String {
        pretty(&self.facts())
    }

    fn rows(&self) -> Rows {
        let facts = self.facts();
        let scenarios = facts["scenarios"].as_array();
        Rows::of(&COLUMNS, scenarios.map_or(&[], Vec::as_slice), &facts)
    }
}

fn name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Inconclusive => "inconclusive",
        Verdict::Fail => "fail",
    }
}

/// Four digits of the nominal rate, and six decimals at least.
fn digits(finding: &Finding, rate: f64) -> String {
    let decimals = (3.0 - libm::log10(finding.nominal).floor()).max(6.0) as usize;
    format!("{rate:.decimals$}")
}

/// Four decimals where they say something, a power of ten where they do not.
fn p_value(p: f64) -> String {
    match p {
        0.0 => "<1e-300".to_owned(),
        _ if p < 1e-3 => format!("{p:.2e}"),
        _ => format!("{p:.4}"),
    }
}
