//! The exact interval for the mean of a Poisson count [^1]: from the events in an hour to the expected number.
//!
//! With P(N ≤ n; μ) = P(χ²_{2n+2} ≥ 2μ), the limits at confidence 1 − 2ε are the μ for which n or more
//! events, and n or fewer, have probability ε. They cover the true mean with at least their confidence if
//! the events are independent. For clustered events, such as false decisions that share samples, they are
//! too narrow.
//!
//! [^1]: F. Garwood, "Fiducial limits for the Poisson distribution", Biometrika 28, 1936.

use crate::stats::bisect::bisect;
use crate::stats::chi_squared;

/// The two-sided interval for the mean, given `count` events.
pub fn interval(count: u64, confidence: f64) -> (f64, f64) {
    let tail = (1.0 - confidence) / 2.0;
    let at_most = |n: u64, mean: f64| chi_squared::upper_tail(2.0 * mean, 2 * n as usize + 2);
    let events = count as f64;
    let low = match count {
        0 => 0.0,
        _ => bisect(0.0, events, |mean| 1.0 - at_most(count - 1, mean) < tail),
    };
    let mut beyond = 2.0 * events + 10.0;
    while at_most(count, beyond) > tail {
        beyond *= 2.0;
    }
    let high = bisect(events, beyond, |mean| at_most(count, mean) > tail);
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed forms: −ln ε for no events, and 1 − e^{−μ} = ε for one. Garwood's published limits for 10 events:
    /// 4.795 and 18.39.
    #[test]
    fn values() {
        let (low, high) = interval(0, 0.95);
        assert_eq!(low, 0.0);
        assert!((high + 0.025f64.ln()).abs() < 1e-10);
        let (low, _) = interval(1, 0.9);
        assert!((low + 0.95f64.ln()).abs() < 1e-10);
        let (low, high) = interval(10, 0.95);
        assert!(
            (low - 4.795).abs() < 5e-4 && (high - 18.390).abs() < 5e-4,
            "{low} {high}"
        );
    }

    /// The coverage, summed over all counts of relevant probability, is never below the confidence.
    #[test]
    fn covers() {
        let intervals: Vec<(f64, f64)> = (0..200).map(|count| interval(count, 0.9)).collect();
        for step in 1..=200 {
            let mean = 0.25 * f64::from(step);
            let (mut mass, mut coverage) = ((-mean).exp(), 0.0);
            for (count, (low, high)) in intervals.iter().enumerate() {
                if *low <= mean && mean <= *high {
                    coverage += mass;
                }
                mass *= mean / (count + 1) as f64;
            }
            assert!(coverage >= 0.9 - 1e-9, "{mean}: {coverage}");
        }
    }
}
