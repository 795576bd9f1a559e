//! The position of the car from acceleration and barometer together.
//!
//! [`Position`] is the one-dimensional filter of [^1], eqs (18) and (19), and [`Reference`] what it calls the calibration of the
//! barometer. [`SlowHeight`] is what is better: the [distances of whole trips](super::Track), with the barometer as a height
//! that drifts slowly.
//!
//! # The filter of [^1]
//! - (18) h ← h + v T + a T²/2
//! - (19) at rest and |h − hᵢ| < δ: h ← hᵢ
//! - unscented: h, h ± √(3P) with the weights 2/3, 1/6, 1/6 go through (18) and (19); P is their variance and Q
//! - measured: z = h + noise, K = P/(P + R)
//! - adaptive: where |z − h| > 2σ, Q ← Q + s, else back by s towards Q₀
//!
//! Without floors it is a linear filter, of which sigma points tell nothing new. σ is √P in [^1], which leaves the noise of the
//! measurement out, so that Q grows all the time; √(P + R) is meant. `configs/height.toml` measures both.
//!
//! [^1]: The monitor with accelerometer and barometer, in Chinese (楊昱等, 太原理工大學學報).

mod carried;
mod reference;
mod slow;
#[cfg(test)]
mod tests;

pub use carried::{Leg, Reading, Stay, UNKNOWN, stays};
pub use reference::Reference;
pub use slow::{Drift, SlowHeight};

use libm::{fabs, sqrt};

/// The numbers of the filter; the paper gives none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fusion {
    /// Q₀ of a second, m².
    pub process: f64,
    /// R, m².
    pub noise: f64,
    /// How Q follows the innovations.
    pub adapts: Adapts,
    /// s of a second, m².
    pub growth: f64,
    /// δ, m.
    pub tolerance: f64,
}

/// When Q grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adapts {
    /// Never.
    Never,
    /// Where the innovation is beyond 2√P, as printed.
    Printed,
    /// Where it is beyond 2√(P + R).
    Mended,
}

impl Fusion {
    /// For a barometer with this deviation of a reading, m.
    pub fn of(deviation: f64) -> Self {
        Self {
            process: 1e-4,
            noise: deviation * deviation,
            adapts: Adapts::Never,
            growth: 1e-4,
            tolerance: 1.0,
        }
    }
}

/// Where the car is, m above the reference.
#[derive(Clone, Debug)]
pub struct Position {
    fusion: Fusion,
    /// Heights of the floors, m.
    floors: Vec<f64>,
    mean: f64,
    variance: f64,
    /// Q of a second, m².
    process: f64,
}

/// The weights of the sigma points, whose first is the mean.
const WEIGHTS: [f64; 3] = [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0];

impl Position {
    /// A car at the reference, among floors if any are known, m above it.
    pub fn new(fusion: Fusion, floors: &[f64]) -> Self {
        Self {
            fusion,
            floors: floors.to_vec(),
            mean: 0.0,
            variance: 0.0,
            process: fusion.process,
        }
    }

    /// m.
    pub fn height(&self) -> f64 {
        self.mean
    }

    /// Moves it by v T + a T²/2 in so many seconds; at rest it is at a floor if one is near.
    pub fn predict(&mut self, by: f64, seconds: f64, is_at_rest: bool) {
        let spread = sqrt(3.0 * self.variance);
        let points = [0.0, spread, -spread].map(|off| {
            let moved = self.mean + off + by;
            let floor = is_at_rest.then(|| self.floor(moved)).flatten();
            floor.unwrap_or(moved)
        });
        let weighed = || points.iter().zip(WEIGHTS);
        self.mean = weighed().map(|(point, weight)| weight * point).sum();
        let square = |point: &f64| (point - self.mean) * (point - self.mean);
        let variance: f64 = weighed()
            .map(|(point, weight)| weight * square(point))
            .sum();
        self.variance = variance + seconds * self.process;
    }

    /// The floor within δ of a height.
    fn floor(&self, height: f64) -> Option<f64> {
        let each = self.floors.iter().map(|it| (fabs(height - it), *it));
        let near = each.filter(|(off, _)| *off < self.fusion.tolerance);
        let nearest = near.reduce(|one, other| if other.0 < one.0 { other } else { one });
        nearest.map(|(_, floor)| floor)
    }

    /// Whether a car that stands here stands at no floor: an alarm.
    pub fn is_abnormal(&self) -> bool {
        !self.floors.is_empty() && self.floor(self.mean).is_none()
    }

    /// Takes the height of the barometer, m, the first for so many seconds.
    pub fn measure(&mut self, height: f64, seconds: f64) {
        let Fusion {
            noise,
            adapts,
            growth,
            process,
            ..
        } = self.fusion;
        let innovation = height - self.mean;
        let variance = self.variance + noise;
        let is_far = |variance: f64| innovation * innovation > 4.0 * variance;
        let is_unlike = match adapts {
            Adapts::Never => false,
            Adapts::Printed => is_far(self.variance),
            Adapts::Mended => is_far(variance),
        };
        let change = growth * seconds;
        self.process = if is_unlike {
            self.process + change
        } else {
            (self.process - change).max(process)
        };
        let gain = self.variance / variance;
        self.mean += gain * innovation;
        self.variance *= 1.0 - gain;
    }
}
