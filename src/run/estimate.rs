//! What a run would take.

use super::missing::Work;
use super::{Missing, Progress, StudyError, Trials};
use crate::counts::Counts;
use crate::simd::LANES;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// What a run would take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Trials of single points, so far as it is known beforehand how many there are.
    pub work: u64,
    /// The same of pilots.
    pub pilots: u64,
    /// Counters that share one realisation count as one.
    pub groups: usize,
    /// Of the largest trial, in GB; every thread has its own.
    pub gigabytes: f64,
    /// On the current thread pool.
    pub time: Duration,
}

impl Estimate {
    /// Scales up the time of a short run of the same points, long enough to be measured; its counts are
    /// thrown away.
    ///
    /// # Errors
    /// Where it is known beforehand that a pilot shows no decision.
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
        // As many as run side by side: of the slowest points a block would take minutes.
        let mut short = number.min(LANES as u64);
        let time = loop {
            let work = Work::new(trials, &of(short));
            let start = Instant::now();
            work.count(&Mutex::default(), &());
            let time = start.elapsed();
            if time >= LONG_ENOUGH || short == number {
                // A short run may have fewer blocks than there are threads.
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
/// Where a pilot shows no decision.
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
