//! Estimates the time and memory that a run would take.

use super::missing::Work;
use super::{Missing, Progress, StudyError, Trials};
use crate::counts::Counts;
use crate::simd::LANES;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// The time and memory that a run would take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Work in trials of single points, as far as their number is known before the run.
    pub work: u64,
    /// Work of the pilots, in the same unit.
    pub pilots: u64,
    /// Number of groups of counters. Counters that share one realisation form one group.
    pub groups: usize,
    /// Memory of the largest trial, in GB. Every thread needs this much.
    pub gigabytes: f64,
    /// Wall-clock time on the current thread pool.
    pub time: Duration,
}

impl Estimate {
    /// Runs the same points for a short time, long enough to be measured, and scales that time up. The counts
    /// of the short run are discarded.
    ///
    /// # Errors
    /// If it is known before the run that a pilot shows no decision.
    pub fn new(trials: &mut dyn Trials, number: u64) -> Result<Self, StudyError> {
        const LONG_ENOUGH: Duration = Duration::from_millis(300);
        let pilots = trials.pretend()?;
        let trials = &*trials;
        let nothing = Counts::default();
        let needed = trials.needed(&nothing);
        let of = |number| Missing::new(trials, &needed, &nothing, &(0..number));
        let all = Work::new(trials, &of(number));
        // A trial-point of a pilot costs about as much as one of the run.
        let total = (all.size() + pilots) as f64;
        let threads = |work: &Work| work.blocks().clamp(1, rayon::current_num_threads() as u64);
        // Start with one vector of trials, because a whole block of the slowest points would take minutes.
        let mut short = number.min(LANES as u64);
        let time = loop {
            let work = Work::new(trials, &of(short));
            let start = Instant::now();
            work.count(&Mutex::default(), &());
            let time = start.elapsed();
            if time >= LONG_ENOUGH || short == number {
                // A short run may have fewer blocks than threads and so leave some threads idle.
                let busy = threads(&work) as f64 / threads(&all) as f64;
                break time.mul_f64(busy * total / work.size().max(1) as f64);
            }
            short = number.min(4 * short);
        };
        Ok(Self {
            work: all.size(),
            pilots,
            groups: all.groups.len(),
            gigabytes: (all.groups.iter())
                .map(|group| group.gigabytes)
                .fold(0.0, f64::max),
            time,
        })
    }
}

/// Runs all of a study's trials at once, unless `progress` stops it, and keeps the counts in memory.
///
/// # Errors
/// If a pilot shows no decision.
pub fn whole(
    mut trials: Box<dyn Trials + '_>,
    number: u64,
    progress: &dyn Progress,
) -> Result<Counts, StudyError> {
    let mut counts = Counts::default();
    loop {
        let missing = Missing::new(&*trials, &trials.needed(&counts), &counts, &(0..number));
        if missing.is_empty() || progress.is_stopped() {
            return Ok(counts);
        }
        let decisions = trials.prepare(&missing.targets(), progress)?;
        counts.decisions.extend(decisions);
        let work = Work::new(&*trials, &missing);
        progress.begin("points", work.size(), number);
        let shared = Mutex::new(counts);
        work.count(&shared, progress);
        counts = shared.into_inner().expect("nobody panics with the counts");
        progress.end();
    }
}
