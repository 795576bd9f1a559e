//! `liftsim plan CONFIG`: what a sweep would do.

use super::{CommandResult, Counted, Failure, print};
use clap::Args;
use liftsim::run::Estimate;
use liftsim::stats::tally::Tally;
use liftsim::study::Loaded;
use serde_json::json;
use std::process::ExitCode;
use std::time::Duration;

/// Print what a sweep would do: points, trials, half-width, memory, expected time. Writes nothing.
#[derive(Debug, Args)]
pub struct PlanCommand {
    #[command(flatten)]
    counted: Counted,
    /// Print JSON instead of text; the time is in seconds.
    #[arg(long)]
    json: bool,
}

impl PlanCommand {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let loaded = self.counted.study()?;
        loaded.check().map_err(Failure::study)?;
        let trials = loaded.origin.trials;
        let text = match loaded.study.trials() {
            Some(mut counted) => {
                let points = counted.points();
                let estimate = Estimate::new(&mut *counted, trials).map_err(Failure::study)?;
                let has_rates =
                    (counted.targets().iter()).any(|target| target.shape.most.contains(&Some(1)));
                if self.json {
                    facts(&loaded, points, trials, &estimate)
                } else {
                    words(&loaded, trials, &estimate, has_rates)
                }
            }
            None if self.json => {
                let facts = json!({ "question": loaded.question, "study": loaded.study.name() });
                format!("{facts}\n")
            }
            None => format!(
                "{}\n\n[{}] is computed, no trials\n",
                loaded.question,
                loaded.study.name()
            ),
        };
        print(&text)?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Half the width of the interval of a rate.
fn half_width(hits: u64, trials: u64, confidence: f64) -> f64 {
    let (low, high) = Tally { hits, trials }.interval(confidence);
    (high - low) / 2.0
}

/// What trials take on all threads.
fn megabytes(estimate: &Estimate) -> f64 {
    1e3 * rayon::current_num_threads() as f64 * estimate.gigabytes
}

fn facts(loaded: &Loaded, points: usize, trials: u64, estimate: &Estimate) -> String {
    let facts = json!({
        "question": loaded.question, "study": loaded.study.name(), "points": points,
        "trials": trials, "work": estimate.work,
        "pilots": estimate.pilots, "families": estimate.groups,
        "half_width": half_width(trials / 2, trials, loaded.confidence),
        "confidence": loaded.confidence, "seconds": estimate.time.as_secs_f64(),
        "threads": rayon::current_num_threads(), "megabytes": megabytes(estimate),
    });
    format!("{facts}\n")
}

fn words(loaded: &Loaded, trials: u64, estimate: &Estimate, has_rates: bool) -> String {
    let pilots = match estimate.pilots {
        0 => String::new(),
        work => format!("pilots       {work} trial-points more\n"),
    };
    let half_width = if has_rates {
        format!(
            "half-width   {:.5} at a rate of 1/2, {:.5} at 0.01, of the {} % interval\n",
            half_width(trials / 2, trials, loaded.confidence),
            half_width(trials / 100, trials, loaded.confidence),
            loaded.confidence * 100.0,
        )
    } else {
        String::new()
    };
    format!(
        "{}\n\n\
         points       {}\n\
         trials       {trials} per point, {} trial-points in all\n\
         noise        {} independent sets of realisations\n\
         {pilots}{half_width}\
         memory       {:.1} MB for trials, beside what the program and its figure take\n\
         time         about {} on {} threads\n",
        loaded.question,
        loaded.points,
        estimate.work,
        estimate.groups,
        megabytes(estimate),
        in_words(estimate.time),
        rayon::current_num_threads(),
    )
}

fn in_words(time: Duration) -> String {
    match time.as_secs() {
        0..=1 => format!("{:.1} s", time.as_secs_f64()),
        2..=119 => format!("{} s", time.as_secs()),
        120..=7199 => format!("{} min", time.as_secs() / 60),
        _ => format!("{:.1} h", time.as_secs_f64() / 3600.0),
    }
}
