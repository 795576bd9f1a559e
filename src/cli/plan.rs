//! `liftsim plan CONFIG`: what a sweep would do.

use super::{Failure, Outcome, Simulation, print};
use clap::Args;
use liftsim::chain::Family;
use liftsim::ensemble::BLOCK;
use liftsim::pilot::Pilots;
use liftsim::plan::{Hypothesis, Plan};
use liftsim::run;
use liftsim::stats::tally::Tally;
use serde_json::json;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Say what a sweep would do: points, trials, expected time, half-width. Writes nothing.
#[derive(Debug, Args)]
pub struct PlanCommand {
    #[command(flatten)]
    simulation: Simulation,
    /// Say it in JSON; the time is in seconds.
    #[arg(long)]
    json: bool,
}

impl PlanCommand {
    /// Runs the command.
    pub fn run(self) -> Outcome {
        let (config, plan) = self.simulation.prepare(Plan::new)?;
        let trials = plan.ensemble.trials;
        let at_rest = plan
            .points
            .iter()
            .filter(|p| p.hypothesis == Hypothesis::H0)
            .count();
        let pilots = Pilots::new(&plan).map_err(Failure::input)?;
        let tally = |hits| Tally { hits, trials };
        let half_width = |hits| {
            let (low, high) = tally(hits).interval(config.confidence);
            (high - low) / 2.0
        };
        let time = expected_time(&plan, &pilots);
        let families = plan.ensemble.families.iter();
        let threads = rayon::current_num_threads();
        let megabytes = 1e3 * threads as f64 * families.map(Family::gigabytes).fold(0.0, f64::max);
        if self.json {
            let facts = json!({
                "question": config.question, "points": plan.points.len(), "at_rest": at_rest,
                "trials": trials, "work": plan.ensemble.work(), "pilots": pilots.work(),
                "families": plan.ensemble.families.len(),
                "half_width": half_width(trials / 2), "confidence": config.confidence,
                "seconds": time.as_secs_f64(), "threads": threads, "megabytes": megabytes,
            });
            print(&format!("{facts}\n"))?;
            return Ok(ExitCode::SUCCESS);
        }
        print(&format!(
            "{}\n\n\
             points       {} in motion, {at_rest} at rest, of {} curves\n\
             trials       {trials} per point, {} trial-points in all\n\
             noise        {} independent sets of realisations\n\
             {}half-width   {:.5} at a rate of 1/2, {:.5} at 0.01, of the {} % interval\n\
             memory       {megabytes:.1} MB for trials, beside what the program and its figure take\n\
             time         about {} on {threads} threads\n",
            config.question,
            plan.points.len() - at_rest,
            config.curves.len(),
            plan.ensemble.work(),
            plan.ensemble.families.len(),
            match pilots.work() {
                0 => String::new(),
                work => format!("pilots       {work} trial-points more\n"),
            },
            half_width(trials / 2),
            half_width(trials / 100),
            config.confidence * 100.0,
            in_words(time),
        ))?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Scales up the time of a short run of the same points, long enough to be measured; its counts are
/// thrown away.
fn expected_time(plan: &Plan, pilots: &Pilots) -> Duration {
    const LONG_ENOUGH: Duration = Duration::from_millis(300);
    let decisions = pilots.stand_ins();
    let mut short = plan.clone();
    let wanted = plan.ensemble.trials;
    short.ensemble.trials = wanted.min(BLOCK * rayon::current_num_threads() as u64);
    // A trial-point of a pilot costs about as much as one of the run.
    let work = (plan.ensemble.work() + pilots.work()) as f64;
    loop {
        let start = Instant::now();
        run::run(&short, &decisions, &[], |_| {});
        let time = start.elapsed();
        if time >= LONG_ENOUGH || short.ensemble.trials == wanted {
            return time.mul_f64(work / short.ensemble.work() as f64);
        }
        short.ensemble.trials = wanted.min(4 * short.ensemble.trials);
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
