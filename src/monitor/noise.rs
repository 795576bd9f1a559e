//! The noise of a record, while it may move.

/// What a new value changes the estimate by, as a share, for a record without end; in the beginning by more.
const LEAST_SHARE: f64 = 0.005;
const MOST_SHARE: f64 = 0.2;

/// The deviation of means, from their bends: x − 2x′ + x″ of three in a row. Neither a level nor a ramp bends, and the
/// median of the bends is not moved by a few pulses.
#[derive(Clone, Debug, Default)]
pub(super) struct Noise {
    median: f64,
    count: f64,
}

impl Noise {
    /// Takes the next bend: the median goes up where it is larger, else down, by a share of its own.
    pub fn step(&mut self, bend: f64) {
        self.count += 1.0;
        let share = (1.0 / self.count).clamp(LEAST_SHARE, MOST_SHARE);
        if self.count == 1.0 {
            self.median = bend.abs();
        } else if bend.abs() > self.median {
            self.median *= 1.0 + share;
        } else {
            self.median /= 1.0 + share;
        }
        // Bends of a coarse sensor may be zero for long.
        self.median = self.median.max(1e-6);
    }

    /// The deviation of a mean if the noise were white, in the unit of the bends.
    pub fn deviation(&self) -> f64 {
        1.4826 * self.median / 6f64.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of uniform noise in ±1 with a pulse in a quarter of the time, within a quarter.
    #[test]
    fn pulses_do_not_move_it() {
        let uniform = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 8) / 8_388_608.0 - 1.0;
        let value = |i: u32| {
            uniform(i)
                + if i % 400 < 100 {
                    f64::from(i % 400)
                } else {
                    0.0
                }
        };
        let mut noise = Noise::default();
        for i in 2..4000 {
            noise.step(value(i) - 2.0 * value(i - 1) + value(i - 2));
        }
        let ratio = noise.deviation() * 3f64.sqrt();
        assert!((0.75..1.25).contains(&ratio), "{ratio}");
    }
}
