//! Bisection for the point where a condition begins or ceases to hold.

use std::ops::Range;

/// The boundary in [`low`, `high`] below which `inside` holds, to twelve digits.
pub fn bisect(mut low: f64, mut high: f64, inside: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = low + (high - low) / 2.0;
        if high - low <= 1e-12 * high {
            return middle;
        }
        if inside(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// The first number of `range` for which `holds` is true, or the end of `range`. `holds` must be monotone.
pub fn first(range: Range<u64>, holds: impl Fn(u64) -> bool) -> u64 {
    let (mut low, mut high) = (range.start, range.end);
    while low < high {
        let middle = low + (high - low) / 2;
        if holds(middle) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

/// The largest number below 1 that is `inside`, or 0. `inside` must be monotone.
pub fn largest_below_one(inside: impl Fn(f64) -> bool) -> f64 {
    // Positive floats are ordered like their bits.
    let beyond = first(1..1f64.to_bits(), |bits| !inside(f64::from_bits(bits)));
    f64::from_bits(beyond - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_root() {
        let root = bisect(0.0, 2.0, |x| x * x < 2.0);
        assert!((root - 2f64.sqrt()).abs() < 2e-12);
    }

    #[test]
    fn finds_the_first_and_the_largest() {
        assert_eq!(first(3..9, |i| i >= 5), 5);
        assert_eq!((first(3..9, |_| true), first(3..9, |_| false)), (3, 9));
        assert_eq!(largest_below_one(|x| x <= 0.3), 0.3);
        assert_eq!(largest_below_one(|_| false), 0.0);
        assert_eq!(largest_below_one(|_| true), 1.0 - f64::EPSILON / 2.0);
    }
}
