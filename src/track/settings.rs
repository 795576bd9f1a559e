//! How trips are measured.

use super::filter::Update;
use super::level::Level;
use super::noise::{Densities, Deviations, Noise};
use serde::{Deserialize, Serialize};

/// The settings of the trip filter. Times in s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TrackSettings {
    /// Of the sensor and the cage.
    pub noise: Noise,
    /// S_a in uniform motion, in that at rest.
    pub shaken: f64,
    /// γ_d: a standing cage's ξ_d stays below it.
    pub gate: f64,
    /// ε: the error of the speed at a stop as a share of the highest, since a sensor's gain differs up and down.
    pub gain_error: f64,
    /// γ_δp: the shortest trip, m.
    pub least_distance: f64,
    /// The deviation of the bias that is taken for a start, m/s².
    pub bias_error: f64,
    /// Left out at either end of a uniform motion that a detection finds.
    pub margin: f64,
    /// Left out of the rests on either side of a trip: a start is seen sooner than the end of a change of speed.
    pub foot: f64,
    /// How much rest before a trip is looked at.
    pub rest: f64,
    /// How long after a stop the distance is refined.
    pub settling: f64,
    /// How uniform motion is seen without a detection.
    pub uniform: UniformSettings,
}

/// How uniform motion is seen as it happens. Times in s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct UniformSettings {
    /// Length of the mean.
    pub window: f64,
    /// How far around a sample all means must agree.
    pub beside: f64,
    /// How far a mean may be off the bias at least, m/s².
    pub least: f64,
    /// And in its deviations.
    pub deviations: f64,
    /// Whether the mean is centred, which takes looking ahead, or over the time before.
    pub looks_ahead: bool,
    /// A motion that is uniform below `slow` of its highest speed for so long stands, whatever ξ_d is.
    pub patience: f64,
    /// A share.
    pub slow: f64,
    /// And one at any speed for so long.
    pub longest: f64,
}

impl Default for TrackSettings {
    fn default() -> Self {
        Self {
            noise: Noise::Density(Densities::default()),
            shaken: 1.0,
            gate: 10.8,
            gain_error: 0.0125,
            least_distance: 0.5,
            bias_error: 0.02,
            margin: 0.3,
            foot: 0.15,
            rest: 2.0,
            settling: 1.0,
            uniform: UniformSettings::default(),
        }
    }
}

impl Default for UniformSettings {
    fn default() -> Self {
        Self {
            window: 0.5,
            beside: 0.1,
            least: 0.05,
            deviations: 5.0,
            looks_ahead: true,
            patience: 8.0,
            slow: 0.2,
            longest: 120.0,
        }
    }
}

impl TrackSettings {
    /// Those for a record that is clearly noisier than they say, and how many times S_a is more at rest.
    pub(super) fn noisier(self, level: &Level) -> (Self, Option<f64>) {
        let Noise::Density(noise) = self.noise else {
            return (self, None);
        };
        let [found, motion] = [level.rest, level.motion].map(|it| it.excess(noise.acceleration));
        let rest = found.unwrap_or(1.0);
        // What shakes a resting sensor goes on in motion, where that does not clearly show the contrary.
        let motion = motion.unwrap_or(if level.motion.lacks(rest * noise.acceleration) {
            1.0
        } else {
            rest
        });
        let settings = Self {
            noise: Noise::Density(noise.noisier(rest)),
            shaken: self.shaken * motion / rest,
            ..self
        };
        (settings, found)
    }

    /// S_a in that at rest. What shakes a sensor in motion grows with the speed, whose mean square in a change from or to rest
    /// is a third of the highest; people shake it at rest.
    pub(super) fn shaken(&self, update: Update) -> f64 {
        let least = self.shaken.min(1.0);
        match update {
            Update::Standing => 1.0,
            Update::Uniform => self.shaken,
            Update::None => least + (self.shaken - least) / 3.0,
        }
    }

    /// The patent by its words: standard deviations of a sample, uniform motion seen from before alone, and neither a
    /// gain's error nor patience. The numbers are a choice, since it gives none.
    pub fn by_the_words() -> Self {
        Self {
            noise: Noise::Sample(Deviations {
                acceleration: 0.04,
                bias: 1e-4,
                uniform: 0.01,
                standing: 0.01,
            }),
            gain_error: 0.0,
            uniform: UniformSettings {
                looks_ahead: false,
                beside: 0.0,
                patience: f64::INFINITY,
                longest: f64::INFINITY,
                ..UniformSettings::default()
            },
            ..Self::default()
        }
    }
}
