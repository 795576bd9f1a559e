//! Simulation with its progress on standard error: a bar on a terminal, lines of JSON for machines, or
//! nothing.

use super::signals::Signals;
use super::{Failure, say};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use liftsim::counts::Counts;
use liftsim::run::{self, Progress as _, Session};
use liftsim::study::{Loaded, Sweep, TrialOutcomes};
use serde_json::json;
use std::fmt::Write;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, RwLock};
use std::time::{Duration, Instant};

/// How progress is shown.
#[derive(Debug, Args)]
pub struct Progress {
    /// Report progress as lines of JSON on standard error.
    #[arg(long)]
    json: bool,
}

/// Reports the progress of a run.
pub struct Reporter {
    is_json: bool,
    is_bar: bool,
    /// Stands before the bar.
    prefix: String,
}

impl Reporter {
    /// Shows a bar, lines of JSON, or nothing.
    pub fn new(quiet: bool, progress: &Progress, prefix: &str) -> Self {
        Self {
            is_json: progress.json && !quiet,
            is_bar: !progress.json && !quiet,
            prefix: prefix.to_owned(),
        }
    }

    /// An event for machines.
    fn say(&self, event: &serde_json::Value) {
        if self.is_json {
            say(event);
        }
    }

    /// Begins a stage of `work` trial-points, `trials` of each point.
    fn stage(&self, name: &'static str, work: u64, trials: u64) -> Stage<'_> {
        let now = Instant::now();
        Stage {
            reporter: self,
            bar: bar(&self.prefix, name, work, trials, self.is_bar),
            name,
            work,
            done: AtomicU64::new(0),
            start: now,
            last: Mutex::new(now),
        }
    }
}

/// One part of a run.
struct Stage<'a> {
    reporter: &'a Reporter,
    bar: ProgressBar,
    name: &'static str,
    work: u64,
    done: AtomicU64,
    start: Instant,
    last: Mutex<Instant>,
}

/// Between two lines of JSON.
const LINE: Duration = Duration::from_millis(500);

impl Stage<'_> {
    fn inc(&self, work: u64) {
        self.bar.inc(work);
        let done = self.done.fetch_add(work, Ordering::Relaxed) + work;
        if let Ok(mut last) = self.last.try_lock()
            && last.elapsed() >= LINE
        {
            *last = Instant::now();
            self.say(done);
        }
    }

    fn say(&self, done: u64) {
        let seconds = self.start.elapsed().as_secs_f64();
        let remaining = seconds / done.max(1) as f64 * self.work.saturating_sub(done) as f64;
        self.reporter.say(&json!({
            "event": "progress", "stage": self.name, "done": done, "total": self.work,
            "seconds": seconds, "remaining": remaining,
        }));
    }

    fn finish(&self) {
        self.bar.finish_and_clear();
        if self.work > 0 {
            self.say(self.done.load(Ordering::Relaxed));
        }
    }
}

/// Seconds between two saves; tests set a shorter time.
const SAVE_EVERY: (&str, f64) = ("LIFTSIM_SAVE_EVERY", 5.0);

/// Runs what is missing of a session, saving as it goes.
pub fn work_off(session: &mut Session, reporter: &Reporter) -> Result<(), Failure> {
    let directory = session.directory().path().display().to_string();
    let mut missing = session.missing();
    let mut work = missing.as_ref().map_or(0, |missing| session.work(missing));
    reporter.say(&json!({
        "event": "started", "directory": directory, "points": session.points(),
        "trials": session.wanted(), "total": work,
    }));
    let mut all = 0;
    while let Some(some) = missing {
        // On average over the points.
        let trials = work.div_ceil(session.points() as u64);
        let prepared = session.prepare(&some, &Follower::new(reporter, None));
        prepared.map_err(Failure::study)?;
        let signals = Signals::watch().map_err(Failure::run)?;
        let follower = Follower::new(reporter, Some(&signals));
        follower.begin("points", work, trials);
        let counted = session.count(&some, period(), &follower);
        follower.end();
        if !counted.map_err(Failure::run)? {
            return Err(signals.stopped(&directory));
        }
        all += work;
        missing = session.missing();
        work = missing.as_ref().map_or(0, |missing| session.work(missing));
    }
    reporter.say(&json!({ "event": "finished", "directory": directory, "total": all }));
    Ok(())
}

fn period() -> Duration {
    let (name, default) = SAVE_EVERY;
    let given = std::env::var(name).ok().and_then(|text| text.parse().ok());
    let seconds = given.filter(|seconds| (0.0..1e6).contains(seconds));
    Duration::from_secs_f64(seconds.unwrap_or(default))
}

/// Shows the progress of a run, and stops it on a signal.
struct Follower<'a> {
    reporter: &'a Reporter,
    stage: RwLock<Option<Stage<'a>>>,
    signals: Option<&'a Signals>,
}

impl<'a> Follower<'a> {
    fn new(reporter: &'a Reporter, signals: Option<&'a Signals>) -> Self {
        Self {
            reporter,
            stage: RwLock::new(None),
            signals,
        }
    }

    fn with(&self, act: impl FnOnce(&Stage)) {
        if let Some(stage) = &*self.stage.read().expect(NO_PANIC) {
            act(stage);
        }
    }
}

const NO_PANIC: &str = "nobody panics with the lock";

impl run::Progress for Follower<'_> {
    fn begin(&self, stage: &'static str, work: u64, trials: u64) {
        let stage = self.reporter.stage(stage, work, trials);
        *self.stage.write().expect(NO_PANIC) = Some(stage);
    }

    fn done(&self, work: u64) {
        self.with(|stage| stage.inc(work));
    }

    fn end(&self) {
        self.with(|stage| stage.finish());
    }

    fn saved(&self) {
        self.with(|stage| {
            let done = stage.done.load(Ordering::Relaxed);
            let saved = json!({ "event": "saved", "done": done, "total": stage.work });
            self.reporter.say(&saved);
        });
    }

    fn is_stopped(&self) -> bool {
        self.signals.is_some_and(|signals| signals.came().is_some())
    }
}

/// Counts a sweep in memory.
pub fn count(sweep: &Sweep, reporter: &Reporter) -> Result<Counts, Failure> {
    let schedule = &sweep.plan.schedule;
    let work = schedule.work();
    reporter.say(&json!({
        "event": "started", "points": sweep.plan.points.len(), "trials": schedule.trials,
        "total": work,
    }));
    let counts = sweep.counts(&Follower::new(reporter, None));
    let counts = counts.map_err(Failure::study)?;
    reporter.say(&json!({ "event": "finished", "total": work }));
    Ok(counts)
}

/// The outcomes of every trial of some points.
pub fn trial_outcomes(
    sweep: &Sweep,
    points: &[usize],
    trials: &Range<u64>,
    reporter: &Reporter,
) -> Result<Vec<TrialOutcomes>, Failure> {
    let outcomes = sweep.trial_outcomes(points, trials, &Follower::new(reporter, None));
    outcomes.map_err(Failure::study)
}

/// Counts all trials of a study in memory.
pub fn count_all(loaded: &Loaded, reporter: &Reporter) -> Result<Counts, Failure> {
    let Some(trials) = loaded.study.trials() else {
        return Ok(Counts::default());
    };
    let counts = run::whole(trials, loaded.origin.trials, &Follower::new(reporter, None));
    counts.map_err(Failure::study)
}

/// A bar over `work` trial-points, `trials` of each point.
fn bar(prefix: &str, name: &'static str, work: u64, trials: u64, is_shown: bool) -> ProgressBar {
    let points = work as f64 / trials as f64;
    let speed = move |state: &ProgressState, text: &mut dyn Write| {
        // Without the estimate the bar still shows the progress.
        let _ = write!(text, "{:.0}", state.per_sec() / points);
    };
    let style =
        style("{prefix}{msg} {bar:32} {percent:>3} %  {speed} trials/s of every point, {eta} left");
    ProgressBar::with_draw_target(Some(work), target(is_shown && work > 0))
        .with_style(style.with_key("speed", speed))
        .with_prefix(prefix.to_owned())
        .with_message(name)
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is fixed")
}

fn target(is_shown: bool) -> ProgressDrawTarget {
    if is_shown {
        ProgressDrawTarget::stderr_with_hz(5)
    } else {
        ProgressDrawTarget::hidden()
    }
}
