//! How vibration is weighted: by what people feel of it, in frequency.
//!
//! The curves are those of ISO 8041-1 (which ISO 18738-1 refers to), each a band limit, a transition from acceleration to
//! speed and, vertically, a step. They are given there as functions of the complex frequency, and are applied so: the record
//! is taken apart into its frequencies, each is multiplied, and it is put together again. So nothing is warped, however
//! low the rate is; what is above half of it is not in the record.

use rustfft::num_complex::Complex64;
use rustfft::{FftDirection, FftPlannerScalar};
use std::f64::consts::FRAC_1_SQRT_2;

/// What a record is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weighting {
    /// Of vertical vibration: W_k.
    Vertical,
    /// Of horizontal vibration: W_d.
    Horizontal,
    /// None, but a low pass of 10 Hz (Butterworth, of two poles), for acceleration and jerk.
    LowPass,
}

/// Band limits of both curves, Hz.
const BAND: (f64, f64) = (0.4, 100.0);

/// Where acceleration turns to speed, Hz, and how sharply.
const VERTICAL: (f64, f64) = (12.5, 0.63);
const HORIZONTAL: (f64, f64) = (2.0, 0.63);

/// The step upwards, Hz and how sharp, twice.
const STEP: [(f64, f64); 2] = [(2.37, 0.91), (3.35, 0.91)];

/// Hz.
const LOW_PASS: f64 = 10.0;

/// How long a filter remembers, s: so much nothing comes after a record, which else would follow itself.
const MEMORY: f64 = 10.0;

impl Weighting {
    /// The factor of a frequency, Hz, with its phase.
    pub fn factor(self, frequency: f64) -> Complex64 {
        let turns = Complex64::new(0.0, frequency);
        // 1 + p/(Q ω) + (p/ω)².
        let second = |(corner, q): (f64, f64)| {
            let p = turns / corner;
            1.0 + p / q + p * p
        };
        let band = || {
            let low = turns / BAND.0;
            low * low / second((BAND.0, FRAC_1_SQRT_2)) / second((BAND.1, FRAC_1_SQRT_2))
        };
        let transition = |(corner, q): (f64, f64)| (1.0 + turns / corner) / second((corner, q));
        match self {
            Self::LowPass => 1.0 / second((LOW_PASS, FRAC_1_SQRT_2)),
            Self::Horizontal => band() * transition(HORIZONTAL),
            Self::Vertical => {
                let [from, to] = STEP;
                let height = (from.0 / to.0).powi(2);
                band() * transition(VERTICAL) * height * second(from) / second(to)
            }
        }
    }

    /// A record at a rate, Hz, weighted. It should begin and end at rest, near zero.
    pub fn apply(self, record: &[f64], rate: f64) -> Vec<f64> {
        let length = record.len() + (MEMORY * rate) as usize;
        let mut bins: Vec<Complex64> = record.iter().map(|value| (*value).into()).collect();
        bins.resize(length.next_power_of_two(), Complex64::default());
        let number = bins.len();
        // Without the instructions of one machine or another, for the same bytes on all.
        let mut planner = FftPlannerScalar::new();
        let mut transform = |bins: &mut [Complex64], direction| {
            planner.plan_fft(number, direction).process(bins);
        };
        transform(&mut bins, FftDirection::Forward);
        for (place, bin) in bins.iter_mut().enumerate() {
            let is_negative = 2 * place > number;
            let turns = if is_negative { number - place } else { place };
            let factor = self.factor(turns as f64 * rate / number as f64);
            // What turns backwards is the mirror of what turns forwards; half the rate is both.
            *bin *= match 2 * place {
                twice if twice == number => factor.re.into(),
                _ if is_negative => factor.conj(),
                _ => factor,
            };
        }
        transform(&mut bins, FftDirection::Inverse);
        let weighted = bins[..record.len()].iter();
        weighted.map(|bin| bin.re / number as f64).collect()
    }
}

/// The largest change within a time, s, by a line of least squares: its slopes, a second.
pub(super) fn slopes(record: &[f64], rate: f64, seconds: f64) -> Vec<f64> {
    let number = ((seconds * rate).round() as usize + 1).max(2);
    let middle = (number - 1) as f64 / 2.0;
    let squares: f64 = (0..number).map(|k| (k as f64 - middle).powi(2)).sum();
    let lines = record.windows(number).map(|line| {
        let moments = line.iter().zip(0..);
        let moment: f64 = moments
            .map(|(value, k)| value * (f64::from(k) - middle))
            .sum();
        rate * moment / squares
    });
    lines.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Times 1000 at 10^(n/10) Hz, as ISO 8041-1 tabulates them.
    const TABLE: [(i32, f64, f64); 10] = [
        (-3, 418.8, 854.0),
        (0, 482.5, 1011.0),
        (3, 530.8, 891.3),
        (6, 964.8, 514.3),
        (7, 1039.0, 408.1),
        (9, 1037.0, 255.0),
        (10, 988.4, 201.7),
        (12, 774.3, 126.6),
        (15, 403.1, 62.99),
        (18, 185.7, 29.46),
    ];

    #[test]
    fn curves_are_as_tabulated() {
        for (n, vertical, horizontal) in TABLE {
            let frequency = libm::pow(10.0, f64::from(n) / 10.0);
            for (weighting, expected) in [
                (Weighting::Vertical, vertical),
                (Weighting::Horizontal, horizontal),
            ] {
                let factor = 1000.0 * weighting.factor(frequency).norm();
                assert!(
                    (factor / expected - 1.0).abs() < 1e-3,
                    "{weighting:?} {n}: {factor}"
                );
            }
        }
        let corner = Weighting::LowPass.factor(LOW_PASS).norm();
        assert!((corner - FRAC_1_SQRT_2).abs() < 1e-12);
    }

    /// A swing that has gone on for long comes out times its factor, and late by its phase.
    #[test]
    fn swings_are_multiplied() {
        let rate = 100.0;
        for (weighting, frequency) in [
            (Weighting::Vertical, 5.0),
            (Weighting::Horizontal, 1.0),
            (Weighting::LowPass, 12.0),
        ] {
            let phase = |k: usize| TAU * frequency * k as f64 / rate;
            let swing: Vec<f64> = (0..6000).map(|k| libm::sin(phase(k))).collect();
            let factor = weighting.factor(frequency);
            let weighted = weighting.apply(&swing, rate);
            for (k, weighted) in weighted.iter().enumerate().take(5000).skip(3000) {
                let expected = factor.norm() * libm::sin(phase(k) + factor.arg());
                assert!((weighted - expected).abs() < 1e-3, "{weighting:?} {k}");
            }
        }
    }

    #[test]
    fn a_line_has_its_slope() {
        let line: Vec<f64> = (0..200).map(|k| 3.0 - 0.02 * f64::from(k)).collect();
        assert!(
            slopes(&line, 100.0, 0.5)
                .iter()
                .all(|slope| (slope + 2.0).abs() < 1e-9)
        );
        assert!(slopes(&line[..20], 100.0, 0.5).is_empty());
    }
}
