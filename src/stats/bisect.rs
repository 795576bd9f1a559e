//! Where a condition ceases to hold.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_root() {
        let root = bisect(0.0, 2.0, |x| x * x < 2.0);
        assert!((root - 2f64.sqrt()).abs() < 2e-12);
    }
}
