//! The normal law and its quantiles.

use std::f64::consts::SQRT_2;

/// Φ(z) = P(Z ≤ z).
pub fn below(z: f64) -> f64 {
    0.5 * libm::erfc(-z / SQRT_2)
}

/// Φ⁻¹(p), the z with P(Z ≤ z) = `p`; ±40 at 1 and 0.
pub fn quantile(p: f64) -> f64 {
    if p < 0.5 {
        -two_sided(2.0 * p)
    } else {
        two_sided(2.0 * (1.0 - p))
    }
}

/// The z with P(|Z| ≤ z) = `confidence`; 0 < `confidence` < 1.
pub fn two_sided_quantile(confidence: f64) -> f64 {
    two_sided(1.0 - confidence)
}

/// The z with P(|Z| > z) = `outside`, by bisection of the error function to the last bit that matters.
fn two_sided(outside: f64) -> f64 {
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

    /// The other library's quantile is good to 1e-7; Φ undoes ours to the last digits, in either tail.
    #[test]
    fn quantiles_invert_the_law() {
        let normal = Normal::standard();
        for p in [1e-12, 1e-4, 0.3, 0.5, 0.7, 0.999] {
            let z = quantile(p);
            assert!((below(z) / p - 1.0).abs() < 1e-11, "{p}: {z}");
            assert!((z - normal.inverse_cdf(p)).abs() < 1e-6, "{p}: {z}");
        }
        assert_eq!((below(quantile(0.0)), below(quantile(1.0))), (0.0, 1.0));
    }
}
