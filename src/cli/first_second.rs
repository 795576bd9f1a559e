//! Whether the first second of a stream is about a level that a sensor has at rest: in other units it is not.

use super::warn;
use liftsim::recording::{GRAVITY, Sample};

/// What the level of a sensor may be off by, m/s², with and without gravity.
const OFF: (f64, f64) = (1.0, 0.5);

/// The mean of the first second.
#[derive(Debug, Default)]
pub struct FirstSecond {
    from: Option<f64>,
    sum: f64,
    count: u32,
    is_over: bool,
}

impl FirstSecond {
    /// Takes a sample. Once a second is over, it warns if that is about no level, or not about the one that is `known`.
    pub fn step(&mut self, sample: Sample, known: Option<f64>) {
        if self.is_over {
            return;
        }
        let from = *self.from.get_or_insert(sample.time);
        if sample.time < from + 1.0 {
            self.sum += sample.acceleration;
            self.count += 1;
            return;
        }
        self.is_over = true;
        let mean = self.sum / f64::from(self.count);
        if let Some(reason) = oddity(mean, known) {
            warn(format_args!(
                "standard input: the first second reads {mean:.2} m/s^2 on average, but {reason} (if it is in another unit: \
                 --unit g, mg or counts; if along another axis: --axis)"
            ));
        }
    }
}

/// What a sensor would read instead, if this is no level of it.
fn oddity(mean: f64, known: Option<f64>) -> Option<String> {
    if let Some(level) = known {
        let is_far = (mean - level).abs() > OFF.0;
        return is_far.then(|| format!("{level:.2} when the state was learnt"));
    }
    let is_level = (mean.abs() - GRAVITY).abs() <= OFF.0 || mean.abs() <= OFF.1;
    let words = "a sensor at rest reads 9.8 along the vertical, or 0 without gravity";
    (!is_level).then(|| words.to_owned())
}

#[cfg(test)]
mod tests {
    use super::oddity;

    #[test]
    fn levels_and_units() {
        for mean in [9.81, -9.7, 10.2, 0.0, -0.3] {
            assert_eq!(oddity(mean, None), None, "{mean}");
        }
        // In g, in mg, in counts of 2 g, and across the vertical.
        for mean in [1.0, -1.0, 981.0, 16384.0, 5.0] {
            assert!(oddity(mean, None).is_some(), "{mean}");
        }
        assert_eq!(oddity(9.6, Some(9.81)), None);
        assert!(oddity(1.0, Some(9.81)).is_some());
    }
}
