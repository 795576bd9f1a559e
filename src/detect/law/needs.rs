//! What laws take, and the refusal of those that take too much.

use crate::detect::rule::Exceedances;
use crate::detect::samples::Samples;
use crate::stats::bisect::largest_below_one;

/// Why laws were refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NullLawError {
    /// The counts would not fit in memory.
    #[error(
        "the exact laws of W and {t} at {samples} need {megabytes:.0} MB of counts, more than the {limit:.0} MB allowed \
         (sizes of about {fits} would fit: lower reference, shift or scale)",
        t = .of.symbol(),
        fits = shrunk(.samples, *.share),
        limit = MEMORY_LIMIT / 1e6
    )]
    TooLarge {
        /// The exceedances asked for.
        of: Exceedances,
        /// The sizes asked for.
        samples: Samples,
        /// The memory needed, in MB.
        megabytes: f64,
        /// About the largest share of each size that fits.
        share: f64,
    },
    /// Counting them would take too long.
    #[error(
        "the joint law of W and T' at {samples} takes some {seconds:.0} s to count, more than the {limit:.0} s allowed \
         (sizes of about {fits} would do: lower reference, shift or scale)",
        fits = shrunk(.samples, *.share),
        limit = TIME_LIMIT
    )]
    TooLong {
        /// The sizes asked for.
        samples: Samples,
        /// The time it takes, about.
        seconds: f64,
        /// About the largest share of each size that is counted in time.
        share: f64,
    },
}

/// The most memory for counts, in bytes; those of W alone take minutes to compute.
const MEMORY_LIMIT: f64 = 1e8;

/// The longest time for a joint law, in seconds on one core.
const TIME_LIMIT: f64 = 12.0;

/// What laws take.
#[derive(Clone, Copy, Debug, Default)]
pub struct Needs {
    pub bytes: f64,
    /// On one core.
    pub seconds: f64,
}

impl Needs {
    fn are_met(self) -> bool {
        self.bytes <= MEMORY_LIMIT && self.seconds <= TIME_LIMIT
    }
}

/// Refuses counts that need more than is allowed.
pub fn check(
    of: Exceedances,
    samples: &Samples,
    needs: impl Fn(&Samples) -> Needs,
) -> Result<(), NullLawError> {
    let needed = needs(samples);
    if needed.are_met() {
        return Ok(());
    }
    let share = largest_below_one(|share| needs(&shrunk(samples, share)).are_met());
    let samples = *samples;
    Err(if needed.bytes > MEMORY_LIMIT {
        NullLawError::TooLarge {
            of,
            samples,
            megabytes: needed.bytes / 1e6,
            share,
        }
    } else {
        NullLawError::TooLong {
            samples,
            seconds: needed.seconds,
            share,
        }
    })
}

/// A share of each size, or 1.
pub fn shrunk(samples: &Samples, share: f64) -> Samples {
    let size = |of: usize| ((of as f64 * share) as usize).max(1);
    let (n, m1, m2) = (samples.reference(), samples.shift(), samples.scale());
    Samples::contiguous(size(n), size(m1), size(m2)).expect("each is at least 1")
}
