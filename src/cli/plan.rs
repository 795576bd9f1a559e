//! `liftsim plan CONFIG`: what a sweep would do.

use super::rows::{FormatArguments, Rows, Shown, pretty};
use super::{CommandResult, Counted, Failure, print};
use clap::Args;
use liftsim::run::Estimate;
use liftsim::stats::tally::Tally;
use liftsim::study::Loaded;
use serde_json::{Value, json};
use std::process::ExitCode;
use std::time::Duration;

/// Print what a sweep would do: points, trials, half-width, memory, expected time. Writes nothing.
#[derive(Debug, Args)]
pub struct PlanCommand {
    #[command(flatten)]
    counted: Counted,
    #[command(flatten)]
    format: FormatArguments,
}

impl PlanCommand {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let loaded = self.counted.study()?;
        loaded.check().map_err(Failure::study)?;
        let planned = match loaded.study.trials() {
            Some(mut counted) => {
                let estimate = Estimate::new(&mut *counted, loaded.origin.trials);
                let targets = counted.targets();
                Some(Planned {
                    points: counted.points(),
                    estimate: estimate.map_err(Failure::study)?,
                    has_rates: (targets.iter()).any(|target| target.shape.most.contains(&Some(1))),
                })
            }
            None => None,
        };
        let loaded = &loaded;
        print(&self.format.show(&Plan { loaded, planned }))?;
        Ok(ExitCode::SUCCESS)
    }
}

/// What a sweep would do.
struct Plan<'a> {
    loaded: &'a Loaded,
    /// Nothing where nothing is counted.
    planned: Option<Planned>,
}

struct Planned {
    points: usize,
    estimate: Estimate,
    /// Whether rates are counted, which have intervals.
    has_rates: bool,
}

const COLUMNS: [&str; 13] = [
    "study",
    "question",
    "points",
    "trials",
    "work",
    "pilots",
    "families",
    "half_width",
    "half_width_at_a_hundredth",
    "confidence",
    "seconds",
    "threads",
    "megabytes",
];

impl Planned {
    /// What trials take on all threads.
    fn megabytes(&self) -> f64 {
        1e3 * rayon::current_num_threads() as f64 * self.estimate.gigabytes
    }
}

impl Plan<'_> {
    /// Half the widths of the interval of a rate, at 1/2 and at 1/100.
    fn half_widths(&self) -> [f64; 2] {
        let (trials, confidence) = (self.loaded.origin.trials, self.loaded.confidence);
        [trials / 2, trials / 100].map(|hits| {
            let (low, high) = Tally { hits, trials }.interval(confidence);
            (high - low) / 2.0
        })
    }

    fn facts(&self) -> Value {
        let (question, study) = (&self.loaded.question, self.loaded.study.name());
        let Some(planned) = &self.planned else {
            return json!({ "question": question, "study": study });
        };
        let estimate = &planned.estimate;
        let half_widths = self.half_widths();
        let [half, hundredth] = half_widths.map(|it| planned.has_rates.then_some(it));
        json!({
            "question": question, "study": study, "points": planned.points,
            "trials": self.loaded.origin.trials, "work": estimate.work,
            "pilots": estimate.pilots, "families": estimate.groups,
            "half_width": half, "half_width_at_a_hundredth": hundredth,
            "confidence": self.loaded.confidence, "seconds": estimate.time.as_secs_f64(),
            "threads": rayon::current_num_threads(), "megabytes": planned.megabytes(),
        })
    }
}

impl Shown for Plan<'_> {
    fn text(&self) -> String {
        let question = &self.loaded.question;
        let Some(planned) = &self.planned else {
            let study = self.loaded.study.name();
            return format!("{question}\n\n[{study}] is computed, no trials\n");
        };
        let estimate = &planned.estimate;
        let pilots = match estimate.pilots {
            0 => String::new(),
            work => format!("pilots       {work} trial-points more\n"),
        };
        let half_width = if planned.has_rates {
            let [half, hundredth] = self.half_widths();
            format!(
                "half-width   {half:.5} at a rate of 1/2, {hundredth:.5} at 0.01, of the {} % interval\n",
                self.loaded.confidence * 100.0,
            )
        } else {
            String::new()
        };
        format!(
            "{question}\n\n\
             points       {}\n\
             trials       {} per point, {} trial-points in all\n\
             noise        {} independent sets of realisations\n\
             {pilots}{half_width}\
             memory       {:.1} MB for trials, beside what the program and its figure take\n\
             time         about {} on {} threads\n",
            self.loaded.points,
            self.loaded.origin.trials,
            estimate.work,
            estimate.groups,
            planned.megabytes(),
            in_words(estimate.time),
            rayon::current_num_threads(),
        )
    }

    fn json(&self) -> String {
        pretty(&self.facts())
    }

    fn rows(&self) -> Rows {
        Rows::of(&COLUMNS, &[self.facts()], &Value::Null)
    }
}

fn in_words(time: Duration) -> String {
    match time.as_secs() {
        0..=1 => format!("{:.1} s", time.as_secs_f64()),
        2..=119 => format!("{} s", time.as_secs()),
        120..=7199 => format!("{} min", time.as_secs() / 60),
        _ => format!("{:.1} h", time.as_secs_f64() / 3600.0),
    }
}
