//! Quantiles of the normal law.

use std::f64::consts::SQRT_2;

/// The z with P(|Z| ≤ z) = `confidence`, by bisection of the error function to the last bit that
/// matters; 0 < `confidence` < 1.
pub fn two_sided_quantile(confidence: f64) -> f64 {
    let outside = 1.0 - confidence;
    // P(|Z| > 40) is below the smallest positive f64.
    let (mut low, mut high) = (0.0, 40.0);
    while high - low > 1e-14 * high {
        let middle = f64::midpoint(low, high);
        if libm::erfc(middle / SQRT_2) > outside {
            low = middle
        } else {
            high = middle
        }
    }
    f64::midpoint(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::{ContinuousCDF, Normal};

    #[test]
    fn agrees_with_another_library() {
        let normal = Normal::standard();
        for confidence in [0.1, 0.5, 0.95, 0.99, 1.0 - 1e-6] {
            let expected = normal.inverse_cdf(1.0 - (1.0 - confidence) / 2.0);
            let z = two_sided_quantile(confidence);
            assert!((z - expected).abs() < 1e-7, "{confidence}: {z} {expected}");
        }
    }
}
