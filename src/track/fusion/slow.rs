//! Trips by the accelerometer, and the barometer as a height that drifts slowly.
//!
//! The state is x = [p, w, r]: the car's position, by how much the barometer reads more, and how fast that changes. A trip
//! moves p by its distance, with its variance; in between w is the integral of r, which changes as the weather does. At rest the mean
//! of the barometer's readings measures p + w. So trips carry the position over minutes and the barometer over hours, the
//! less the more its drift has been seen to be steady. A floor at which the car is known to stand measures p alone.

use crate::kalman::Estimate;
use crate::track::Uncertain;

/// The places of the state.
const POSITION: usize = 0;
const OFFSET: usize = 1;
const RATE: usize = 2;

/// H of the two measurements.
const BAROMETER: [f64; 3] = [1.0, 1.0, 0.0];
const FLOOR: [f64; 3] = [1.0, 0.0, 0.0];

/// The variance of an offset of which nothing is known, m².
const UNKNOWN: f64 = 1e8;

/// A barometer that reads something else than is expected by more than this, in deviations, has jumped.
const JUMP: f64 = 5.0;

/// How the weather moves a barometer's height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// The deviation of its rate, m/s.
    pub rate: f64,
    /// After so many seconds the rate is another.
    pub lasts: f64,
}

impl Default for Drift {
    /// 0.5 hPa an hour, for an hour.
    fn default() -> Self {
        Self {
            rate: 4.2 / 3600.0,
            lasts: 3600.0,
        }
    }
}

/// Where the car stands.
#[derive(Clone, Debug)]
pub struct SlowHeight {
    drift: Drift,
    estimate: Estimate<[f64; 3], [f64; 9]>,
}

impl SlowHeight {
    /// A car that stands at 0 m; what a barometer reads there is not known yet.
    pub fn new(drift: Drift) -> Self {
        let mut covariance = [0.0; 9];
        covariance[4 * OFFSET] = UNKNOWN;
        covariance[4 * RATE] = drift.rate * drift.rate;
        Self {
            drift,
            estimate: Estimate {
                mean: [0.0; 3],
                covariance,
            },
        }
    }

    /// After a trip of this distance, m, so many seconds from rest to rest. The rate is an Ornstein–Uhlenbeck process of the drift's
    /// deviation and time, and the offset its integral, so that one step is as good as several.
    pub fn travel(&mut self, distance: Uncertain, seconds: f64) {
        let Drift { rate, lasts } = self.drift;
        let kept = libm::exp(-seconds / lasts);
        let lost = 1.0 - kept;
        #[rustfmt::skip]
        let transition = [
            1.0, 0.0, 0.0,
            0.0, 1.0, lasts * lost,
            0.0, 0.0, kept,
        ];
        let power = rate * rate;
        let both = power * lasts * lost * lost;
        let offset = 2.0 * seconds / lasts - 3.0 + 4.0 * kept - kept * kept;
        #[rustfmt::skip]
        let noise = [
            distance.variance, 0.0, 0.0,
            0.0, power * lasts * lasts * offset.max(0.0), both,
            0.0, both, power * (1.0 - kept * kept),
        ];
        self.estimate
            .predict(&transition, &[distance.mean, 0.0, 0.0], &noise);
    }

    /// Counts from where the car stands now.
    pub fn count_from_here(&mut self) {
        #[rustfmt::skip]
        let moved = [
            0.0, 0.0, 0.0,
            1.0, 1.0, 0.0,
            0.0, 0.0, 1.0,
        ];
        self.estimate.predict(&moved, &[0.0; 3], &[0.0; 9]);
    }

    /// The barometer reads this height at rest, m. Where that cannot be it has jumped, and tells nothing yet: trips are believed.
    pub fn read(&mut self, height: Uncertain) {
        let Uncertain { mean, variance } = height;
        let innovation = self.estimate.innovation(&BAROMETER, mean, variance);
        if innovation.nis() > JUMP * JUMP {
            self.estimate.covariance[4 * OFFSET] += UNKNOWN;
        }
        self.estimate.update(&BAROMETER, mean, variance);
    }

    /// The car stands at a floor of this height, m.
    pub fn stand(&mut self, floor: Uncertain) {
        self.estimate.update(&FLOOR, floor.mean, floor.variance);
    }

    /// m above where it stood first.
    pub fn position(&self) -> Uncertain {
        Uncertain {
            mean: self.estimate.mean[POSITION],
            variance: self.estimate.covariance[4 * POSITION],
        }
    }
}
