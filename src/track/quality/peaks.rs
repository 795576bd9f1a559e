//! Peaks of a vibration, and percentiles.

/// The part of all that A95 and V95 leave below them.
const PART: f64 = 0.95;

/// What is next to each other on both sides of zero: the sums of neighbouring largest values between crossings of zero.
pub(super) fn peak_to_peak(vibration: &[f64]) -> Vec<f64> {
    let halves = vibration.chunk_by(|one, next| (*one < 0.0) == (*next < 0.0));
    let peaks: Vec<f64> = halves
        .map(|half| {
            half.iter()
                .fold(0.0, |most: f64, value| most.max(value.abs()))
        })
        .collect();
    peaks.windows(2).map(|pair| pair[0] + pair[1]).collect()
}

/// The largest, and the value that 95 % do not exceed; none of nothing.
pub(super) fn greatest(values: Vec<f64>) -> Option<(f64, f64)> {
    let mut values = values;
    values.sort_by(f64::total_cmp);
    let place = (PART * values.len() as f64).ceil() as usize;
    Some((*values.last()?, values[place.max(1) - 1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_on_both_sides() {
        let vibration = [0.1, 0.3, 0.2, -0.4, -0.1, 0.2, -0.1];
        let expected = [0.7, 0.6, 0.3];
        let found = peak_to_peak(&vibration);
        assert!(
            found
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-12),
            "{found:?}"
        );
        assert!(peak_to_peak(&[0.1, 0.2]).is_empty());
    }

    #[test]
    fn nineteen_of_twenty_are_below() {
        let values = (1..=20).map(f64::from).collect();
        assert_eq!(greatest(values), Some((20.0, 19.0)));
        assert_eq!(greatest(vec![2.0]), Some((2.0, 2.0)));
        assert_eq!(greatest(vec![]), None);
    }
}
