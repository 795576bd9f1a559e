//! Simulation with a bar on standard error: done, time left. Off a terminal it stays silent.

use super::Failure;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use liftsim::chain::Decision;
use liftsim::pilot::Pilots;
use liftsim::plan::Plan;
use liftsim::run::{self, Outcome};
use std::fmt::Write;

/// Runs the plan's pilots, then the plan itself. `prefix` stands before the bar.
pub fn simulate(
    plan: &Plan,
    pairs: &[[usize; 2]],
    prefix: &str,
    quiet: bool,
) -> Result<(Vec<Decision>, Outcome), Failure> {
    let pilots = Pilots::new(plan).map_err(Failure::input)?;
    let pilot_bar = bar(prefix, "pilots", pilots.work(), plan.pilot, quiet);
    let decisions = pilots.decide(|work| pilot_bar.inc(work));
    pilot_bar.finish_and_clear();
    let decisions = decisions.map_err(Failure::input)?;

    let ensemble = &plan.ensemble;
    let bar = bar(prefix, "points", ensemble.work(), ensemble.trials, quiet);
    let outcome = run::run(plan, &decisions, pairs, |work| bar.inc(work));
    bar.finish_and_clear();
    Ok((decisions, outcome))
}

/// A bar for `work` trial-points, `trials` of each, to be told of finished work by `inc`.
fn bar(prefix: &str, name: &'static str, work: u64, trials: u64, quiet: bool) -> ProgressBar {
    let points = work as f64 / trials as f64;
    let speed = move |state: &ProgressState, text: &mut dyn Write| {
        // An estimate that cannot be written is not worth stopping for.
        let _ = write!(text, "{:.0}", state.per_sec() / points);
    };
    let style = ProgressStyle::with_template(
        "{prefix}{msg} {bar:32} {percent:>3} %  {speed} trials/s of every point, {eta} left",
    )
    .expect("the template is fixed")
    .with_key("speed", speed);
    let target = match quiet || work == 0 {
        true => ProgressDrawTarget::hidden(),
        false => ProgressDrawTarget::stderr_with_hz(5),
    };
    let bar = ProgressBar::with_draw_target(Some(work), target).with_style(style);
    bar.with_prefix(prefix.to_owned()).with_message(name)
}
