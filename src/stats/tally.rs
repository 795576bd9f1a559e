//! Binomial counts and inference from them: the exact interval [^1], the number of trials for a given
//! half-width, and a one-sided test with Holm's correction [^2].
//!
//! Counts are stored and rates derived. The interval of Clopper and Pearson covers the true
//! probability with at least its confidence for every n and p, because the number of trials is fixed
//! before a run.
//!
//! [^1]: C. Clopper, E. Pearson, "The use of confidence or fiducial limits", Biometrika 26, 1934.
//! [^2]: S. Holm, "A simple sequentially rejective multiple test procedure", 1979.

use crate::stats::binomial;
use crate::stats::bisect::bisect;

/// More trials than are practical; the time of the exact tails grows with the square root of their number.
pub const MOST_TRIALS: u64 = 100_000_000_000;

/// The number of hits in a number of independent trials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Hits (k).
    pub hits: u64,
    /// Trials (n).
    pub trials: u64,
}

impl Tally {
    /// hits / trials.
    pub fn rate(self) -> f64 {
        self.hits as f64 / self.trials as f64
    }

    /// The two-sided Clopper–Pearson interval for the probability of a hit.
    pub fn interval(self, confidence: f64) -> (f64, f64) {
        let (k, n) = (self.hits, self.trials);
        let tail = (1.0 - confidence) / 2.0;
        let low = match k {
            0 => 0.0,
            _ => bisect(0.0, self.rate(), |p| binomial::upper_tail(k, n, p) < tail),
        };
        let high = match n - k {
            0 => 1.0,
            _ => bisect(self.rate(), 1.0, |p| binomial::lower_tail(k, n, p) > tail),
        };
        (low, high)
    }

    /// P(K ≥ hits) when the true probability is `nominal`: the exact one-sided p-value of
    /// "the rate is at most nominal".
    pub fn p_value_above(self, nominal: f64) -> f64 {
        binomial::upper_tail(self.hits, self.trials, nominal)
    }
}

/// An interval for the difference of two probabilities, from the exact interval of either at half the
/// error (Bonferroni). Nothing is assumed of how the two counts depend on each other, so it serves
/// independent runs as well as the two kinds of discordant trials of one run; its coverage is at
/// least `confidence`.
pub fn difference_interval(first: Tally, second: Tally, confidence: f64) -> (f64, f64) {
    let each = 1.0 - (1.0 - confidence) / 2.0;
    let (a, b) = (first.interval(each), second.interval(each));
    (a.0 - b.1, a.1 - b.0)
}

/// The probability that `trials` trials reject "the rate is at most `nominal`" at `level` when the
/// true rate is `truth`.
pub fn power_against(truth: f64, nominal: f64, level: f64, trials: u64) -> f64 {
    let critical = binomial::critical_count(level, trials, nominal);
    binomial::upper_tail(critical, trials, truth)
}

/// The smallest number of trials whose interval is at most ± `half_width` at every rate. The interval
/// is widest at a rate of one half.
pub fn trials_for_half_width(half_width: f64, confidence: f64) -> u64 {
    let wide = |trials: u64| {
        let hits = trials / 2;
        let (low, high) = Tally { hits, trials }.interval(confidence);
        high - low > 2.0 * half_width
    };
    let mut enough = 2;
    while wide(enough) {
        enough *= 2;
    }
    let mut few = enough / 2;
    while few + 1 < enough {
        let middle = few + (enough - few) / 2;
        if wide(middle) {
            few = middle;
        } else {
            enough = middle;
        }
    }
    enough
}

/// Which of several hypotheses with these p-values are rejected at a family-wise `level`, by the
/// step-down rule of Holm.
pub fn holm(p_values: &[f64], level: f64) -> Vec<bool> {
    let mut order: Vec<usize> = (0..p_values.len()).collect();
    order.sort_by(|&a, &b| p_values[a].total_cmp(&p_values[b]));
    let mut rejected = vec![false; p_values.len()];
    for (rank, &index) in order.iter().enumerate() {
        if p_values[index] > level / (p_values.len() - rank) as f64 {
            break;
        }
        rejected[index] = true;
    }
    rejected
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The coverage, summed over every outcome, is never below the confidence.
    #[test]
    fn interval_covers() {
        for n in [1u64, 2, 7, 30, 100] {
            let intervals: Vec<_> = (0..=n)
                .map(|hits| Tally { hits, trials: n }.interval(0.95))
                .collect();
            for step in 0..=500 {
                let p = f64::from(step) / 500.0;
                let coverage: f64 = (0..=n)
                    .filter(|&k| {
                        let (low, high) = intervals[k as usize];
                        low <= p && p <= high
                    })
                    .map(|k| binomial::mass(k, n, p))
                    .sum();
                assert!(coverage >= 0.95 - 1e-12, "n = {n}, p = {p}: {coverage}");
            }
        }
    }

    /// The coverage of the difference of two discordant rates, summed over every outcome of 14 trials
    /// that go one way, the other or neither, is never below the confidence.
    #[test]
    fn difference_interval_covers() {
        let n = 14u64;
        let alone = |hits| Tally { hits, trials: n };
        let choose = |n: u64, k: u64| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
        for (p, q) in [(0.1, 0.1), (0.3, 0.2), (0.5, 0.4), (0.05, 0.6), (0.02, 0.0)] {
            let mut coverage = 0.0;
            for a in 0..=n {
                for b in 0..=n - a {
                    let (low, high) = difference_interval(alone(a), alone(b), 0.8);
                    let probability = choose(n, a)
                        * choose(n - a, b)
                        * libm::pow(p, a as f64)
                        * libm::pow(q, b as f64)
                        * libm::pow(1.0 - p - q, (n - a - b) as f64);
                    if low <= p - q && p - q <= high {
                        coverage += probability;
                    }
                }
            }
            assert!(coverage >= 0.8, "{p} {q}: {coverage}");
        }
    }

    /// Closed forms at the ends, and published limits (k = 10, n = 100: 0.0490, 0.1762).
    #[test]
    fn interval_values() {
        let ends = |hits, trials| Tally { hits, trials }.interval(0.95);
        assert!((ends(0, 100).1 - (1.0 - 0.025f64.powf(0.01))).abs() < 1e-12);
        assert_eq!(ends(0, 100).0, 0.0);
        assert!((ends(100, 100).0 - 0.025f64.powf(0.01)).abs() < 1e-12);
        let (low, high) = ends(10, 100);
        assert!((low - 0.0490).abs() < 5e-5 && (high - 0.1762).abs() < 5e-5);
        // Small k in a large n, where some libraries fail: at k = 3 the limits tend to Poisson's.
        let (low, high) = ends(3, 10_000_000);
        assert!((low * 1e7 - 0.618672).abs() < 1e-5, "{low}");
        assert!((high * 1e7 - 8.767273).abs() < 1e-5, "{high}");
    }

    #[test]
    fn half_width_is_reached_and_no_more() {
        let n = trials_for_half_width(0.01, 0.95);
        let width = |trials: u64| {
            let hits = trials / 2;
            let (low, high) = Tally { hits, trials }.interval(0.95);
            (high - low) / 2.0
        };
        assert!(width(n) <= 0.01 && width(n - 1) > 0.01, "{n}");
        assert!((9_600..9_800).contains(&n), "{n}");
    }

    #[test]
    fn holm_steps_down() {
        assert_eq!(
            holm(&[0.01, 0.04, 0.03, 0.005], 0.05),
            [true, false, false, true]
        );
        assert_eq!(holm(&[0.06], 0.05), [false]);
        assert!(holm(&[], 0.05).is_empty());
    }

    #[test]
    fn power_grows_with_trials() {
        let power = |n| power_against(0.012, 0.01, 1e-3 / 30.0, n);
        assert!(power(20_000) < 0.5 && power(400_000) > 0.99);
    }
}
