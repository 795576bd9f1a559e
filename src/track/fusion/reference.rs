//! The altitude of the reference, learnt anew at every rest: the calibration of the barometer.

use libm::{fabs, sqrt};
use std::collections::VecDeque;

/// Windows of two seconds, each second.
const WINDOW: f64 = 2.0;
const EVERY: f64 = 1.0;

/// Of the windows of a rest those are outliers that are farther off their mean, in deviations.
const OUTLIER: f64 = 3.0;

/// The altitude of the reference, by what the barometer reads where the car stands.
#[derive(Clone, Debug, Default)]
pub struct Reference {
    readings: VecDeque<(f64, f64)>,
    windows: Vec<f64>,
    /// When the last window ended, s.
    ended: Option<f64>,
    /// m.
    altitude: Option<f64>,
}

impl Reference {
    /// The altitude of the reference, m; none before the first rest is over.
    pub fn altitude(&self) -> Option<f64> {
        self.altitude
    }

    /// Takes an altitude that is read at rest, m, at a time, s.
    pub fn rest(&mut self, time: f64, altitude: f64) {
        self.readings.push_back((time, altitude));
        let first = self.readings[0].0;
        if time - first < WINDOW || self.ended.is_some_and(|ended| time - ended < EVERY) {
            return;
        }
        self.ended = Some(time);
        self.readings.retain(|reading| time - reading.0 < WINDOW);
        let sum: f64 = self.readings.iter().map(|reading| reading.1).sum();
        self.windows.push(sum / self.readings.len() as f64);
    }

    /// The rest at this height is over.
    pub fn leave(&mut self, height: f64) {
        if !self.windows.is_empty() {
            self.altitude = Some(mean(&self.windows) - height);
        }
        self.readings.clear();
        self.windows.clear();
        self.ended = None;
    }
}

/// The mean without outliers.
fn mean(of: &[f64]) -> f64 {
    let n = of.len() as f64;
    let middle = of.iter().sum::<f64>() / n;
    let squares: f64 = of.iter().map(|it| (it - middle) * (it - middle)).sum();
    let most = OUTLIER * sqrt(squares / n);
    let sound = || of.iter().filter(|it| fabs(**it - middle) <= most);
    sound().sum::<f64>() / sound().count() as f64
}
