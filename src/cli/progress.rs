//! A bar on standard error: done, trials per second, time left. Off a terminal it stays silent.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use liftsim::plan::Plan;
use liftsim::run;
use std::fmt::Write;

/// A bar for the work of `plan`, to be told of finished work by `inc`.
pub fn bar(plan: &Plan, quiet: bool) -> ProgressBar {
    let work = run::total_work(plan);
    let points = work as f64 / plan.trials as f64;
    let speed = move |state: &ProgressState, text: &mut dyn Write| {
        // An estimate that cannot be written is not worth stopping for.
        let _ = write!(text, "{:.0}", state.per_sec() / points);
    };
    let style = ProgressStyle::with_template(
        "{prefix}{bar:32} {percent:>3} %  {speed} trials/s of every point, {eta} left",
    )
    .expect("the template is fixed")
    .with_key("speed", speed);
    let target = match quiet {
        true => ProgressDrawTarget::hidden(),
        false => ProgressDrawTarget::stderr_with_hz(5),
    };
    ProgressBar::with_draw_target(Some(work), target).with_style(style)
}
