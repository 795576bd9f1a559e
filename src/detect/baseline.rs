//! Statistics that replace W and T, compared with thresholds.
//!
//! None of them is distribution-free, so their thresholds are measured.

/// Student's t of `shift` against `others`, with the pooled variance.
pub fn student_t(shift: &[f64], others: [&[f64]; 2]) -> f64 {
    let rest = || others[0].iter().chain(others[1]).copied();
    let (a, b) = (moments(shift.iter().copied()), moments(rest()));
    let freedom = a.count + b.count - 2.0;
    let variance = (a.squares + b.squares) / freedom * (1.0 / a.count + 1.0 / b.count);
    (a.mean - b.mean) / libm::sqrt(variance)
}

/// The sample variance of `scale` over that of `reference`.
pub fn variance_ratio(reference: &[f64], scale: &[f64]) -> f64 {
    let variance = |sample: &[f64]| {
        let moments = moments(sample.iter().copied());
        moments.squares / (moments.count - 1.0)
    };
    variance(scale) / variance(reference)
}

/// The mean of `shift` minus that of all of `rest`, in standard deviations of the means of adjacent blocks of
/// `rest` as long as `shift`. So it allows for the colour of the noise without a filter.
pub fn block_means(rest: &[f64], shift: &[f64]) -> f64 {
    let mean = |sample: &[f64]| sample.iter().sum::<f64>() / sample.len() as f64;
    let means = moments(rest.chunks_exact(shift.len()).map(mean));
    let deviation = libm::sqrt(means.squares / (means.count - 1.0));
    (mean(shift) - mean(rest)) / deviation
}

struct Moments {
    count: f64,
    mean: f64,
    /// Σ (x − mean)².
    squares: f64,
}

fn moments(sample: impl Iterator<Item = f64> + Clone) -> Moments {
    let (mut count, mut sum) = (0.0, 0.0);
    for x in sample.clone() {
        count += 1.0;
        sum += x;
    }
    let mean = sum / count;
    let squares = sample.map(|x| (x - mean) * (x - mean)).sum();
    Moments {
        count,
        mean,
        squares,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Small samples, computed by hand: means 4 and 2, Σ squares 8 + 2 + 2 on 6 degrees of freedom.
    #[test]
    fn student_t_by_hand() {
        let t = student_t(&[2.0, 4.0, 6.0], [&[1.0, 2.0, 3.0], &[1.0, 3.0]]);
        let variance = (8.0 + 4.0) / 6.0 * (1.0 / 3.0 + 1.0 / 5.0);
        assert!((t - 2.0 / f64::sqrt(variance)).abs() < 1e-12);
    }

    #[test]
    fn variance_ratio_by_hand() {
        assert_eq!(variance_ratio(&[1.0, 2.0, 3.0], &[0.0, 4.0]), 8.0);
    }

    /// Blocks of two at rest: means 1, 3, 2 with deviation 1, and 2 over all.
    #[test]
    fn block_means_by_hand() {
        let rest = [0.0, 2.0, 3.0, 3.0, 1.0, 3.0];
        assert!((block_means(&rest, &[4.0, 6.0]) - 3.0).abs() < 1e-12);
    }
}
