//! A sensor of three axes, by its data sheet, fixed in the cage in any pose.
//!
//! Rolled by ρ about its x axis and pitched by θ about its y axis, up is (−sin θ, cos θ sin ρ, cos θ cos ρ) in its
//! axes, and the way of the doors (cos θ, sin θ sin ρ, sin θ cos ρ). Axis i reads (1 + ε_i)(g + a)·up_i + offset_i, with
//! noise, walk and steps of its own. A data sheet's noise density is one-sided: white noise of density n sampled
//! at f has the deviation n √(f/2).

use super::Pickup;
use super::draws::Draws;
use crate::recording::GRAVITY;
use crate::rng::Stream;
use crate::rule::OutOfRange;
use crate::signal::Digitiser;
use crate::values::{Positive, bounded_f64};
use libm::{cos, sin, sqrt};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A sensor and its pose. What is left out is as its data sheet says.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Accelerometer {
    /// Its data sheet.
    pub model: Model,
    /// One-sided density of its noise, µg/√Hz.
    pub density: Option<Density>,
    /// Its step, mg; 0 for none.
    pub step: Option<Amount>,
    /// Its limits, g.
    pub range: Option<Positive>,
    /// The offset of each axis, mg; left out, each is drawn within the limits of the data sheet.
    pub offset: Option<[Offset; 3]>,
    /// The error of the gain of each axis, a share: 0.01 reads 1 % too much.
    pub gain_error: [Share; 3],
    /// Deviation of the random walk of each axis' bias after a second, µg.
    pub bias_walk: Amount,
    /// Deviation of the times that are recorded, s, up to 0.4 of the time between samples.
    pub jitter: Amount,
    /// How it lies in the cage.
    pub pose: Pose,
}

/// A data sheet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Model {
    /// A phone's: 180 µg/√Hz, ±8 g in steps of 1/4096 g, offsets of ±40 mg, 100 Hz.
    #[default]
    Phone,
    /// 400 µg/√Hz, ±2 g in steps of 1/16384 g, offsets of ±50, ±50, ±80 mg, 200 Hz.
    Mpu6050,
    /// ±2 g in steps of 18 mg, offsets of ±40 mg, 100 Hz; its noise, 218 µg/√Hz here, is hidden in its steps.
    Lis302dl,
    /// 225 µg/√Hz, ±5 g without steps, 100 Hz; offsets of ±2500 mg, which are trimmed in use: give `offset`.
    Adxl105,
}

/// Degrees; level by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Pose {
    /// About the x axis.
    pub roll_deg: Angle,
    /// About the y axis.
    pub pitch_deg: Angle,
}

bounded_f64! {
    /// µg/√Hz.
    Density: "lie in [1e-6, 1e6] µg/√Hz", |x| (1e-6..=1e6).contains(&x),
        { "type": "number", "minimum": 1e-6, "maximum": 1e6 };
    /// In the unit of its key.
    Amount: "lie in [0, 1e6]", |x| (0.0..=1e6).contains(&x),
        { "type": "number", "minimum": 0, "maximum": 1e6 };
    /// mg.
    Offset: "lie in [-1e6, 1e6] mg", |x| (-1e6..=1e6).contains(&x),
        { "type": "number", "minimum": -1e6, "maximum": 1e6 };
    /// Degrees.
    Angle: "lie in [-360, 360] degrees", |x| (-360.0..=360.0).contains(&x),
        { "type": "number", "minimum": -360, "maximum": 360 };
    /// The error of a gain.
    Share: "lie in [-0.5, 0.5]", |x| (-0.5..=0.5).contains(&x),
        { "type": "number", "minimum": -0.5, "maximum": 0.5 };
}

macro_rules! zero_by_default {
    ($($name:ident)*) => {
        $(impl Default for $name {
            fn default() -> Self {
                Self(0.0)
            }
        })*
    };
}
zero_by_default! { Amount Angle Share }

/// In the units of [`Accelerometer`], and Hz.
struct Sheet {
    density: f64,
    step: f64,
    range: f64,
    offset: [f64; 3],
    rate: f64,
}

const MILLI_G: f64 = 1e-3 * GRAVITY;
const MICRO_G: f64 = 1e-6 * GRAVITY;

impl Model {
    fn sheet(self) -> Sheet {
        let (density, step, range, offset, rate) = match self {
            Self::Phone => (180.0, 1e3 / 4096.0, 8.0, [40.0; 3], 100.0),
            Self::Mpu6050 => (400.0, 1e3 / 16384.0, 2.0, [50.0, 50.0, 80.0], 200.0),
            Self::Lis302dl => (218.0, 18.0, 2.0, [40.0; 3], 100.0),
            Self::Adxl105 => (225.0, 0.0, 5.0, [2500.0; 3], 100.0),
        };
        Sheet {
            density,
            step,
            range,
            offset,
            rate,
        }
    }

    /// Samples per second, by the data sheet.
    pub fn rate(self) -> f64 {
        self.sheet().rate
    }
}

impl Pose {
    /// Up, and the way of the doors, in the axes of the sensor.
    fn directions(&self) -> [[f64; 3]; 2] {
        let [roll, pitch] = [self.roll_deg, self.pitch_deg].map(|angle| angle.get().to_radians());
        let turned = |along: f64, rest: f64| [along, rest * sin(roll), rest * cos(roll)];
        [
            turned(-sin(pitch), cos(pitch)),
            turned(cos(pitch), sin(pitch)),
        ]
    }
}

impl Accelerometer {
    /// Its axes at `rate` Hz, in a cage that vibrates with the deviation `vibration` at full speed, m/s².
    ///
    /// # Errors
    /// If a step or a limit does not go with its noise.
    pub fn axes(&self, rate: f64, vibration: f64, seed: u64) -> Result<[Pickup; 3], OutOfRange> {
        let sheet = self.model.sheet();
        let density = self.density.map_or(sheet.density, Density::get);
        let sigma = density * MICRO_G * sqrt(rate / 2.0);
        let step = self.step.map_or(sheet.step, Amount::get) * MILLI_G;
        let range = self.range.map_or(sheet.range, Positive::get) * GRAVITY;
        let step = (step > 0.0).then_some(step / sigma);
        let digitiser = Digitiser::new(step, Some(range / sigma)).map_err(|_| {
            let step = self.step.map_or(sheet.step, Amount::get);
            OutOfRange::new("sensor.step", "be 1e-9 to 1e9 times the noise", step)
                .explained(" (0 is none)")
        })?;
        let offsets = self.offsets(&sheet, seed);
        let [up, across] = self.pose.directions();
        let axis = |i: usize| {
            let gain = 1.0 + self.gain_error[i].get();
            Pickup {
                digitiser,
                bias: gain * up[i] * GRAVITY + offsets[i] * MILLI_G,
                cosine: gain * up[i],
                across: gain * across[i],
                walk: self.bias_walk.get() * MICRO_G,
                vibration: vibration / sigma,
                ..Pickup::white(sigma)
            }
        };
        Ok([0, 1, 2].map(axis))
    }

    fn offsets(&self, sheet: &Sheet, seed: u64) -> [f64; 3] {
        let mut draws = Draws(Stream::new(seed, "sensor offset", "").at(0));
        let drawn = sheet.offset.map(|most| draws.within([-most, most]));
        self.offset.map_or(drawn, |offset| offset.map(Offset::get))
    }
}
