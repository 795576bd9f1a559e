//! Under which conditions trips are simulated.

use crate::lift::{Drive, Limits};
use crate::recording::GRAVITY;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What differs from a typical trip: 1.6 m/s, 1.1 m/s² and 2 m/s³ up and down, an MPU-6050 of 400 µg/√Hz and 16 384 steps a g
/// at 200 Hz.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// Nothing.
    Typical,
    /// It brakes with 0.5 m/s² and 1 m/s³.
    SoftBrake,
    /// Its jerk is 0.7 m/s³.
    SlowJerk,
    /// It creeps to its floor for 3 s at 0.08 m/s.
    Creep,
    /// Its motion shakes the sensor by four times the noise.
    Rough,
    /// The sensor reads 1 % more upwards than downwards.
    GainAsymmetry,
    /// A phone: 250 µg/√Hz at 100 Hz, in steps of 2.4 mm/s².
    Phone,
    /// Steps of 18 mg at 100 Hz.
    CoarseSteps,
    /// 50 Hz.
    #[serde(rename = "50_hz")]
    Hz50,
    /// 400 Hz.
    #[serde(rename = "400_hz")]
    Hz400,
}

/// A condition in numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbers {
    pub limits: Limits,
    /// Hz.
    pub rate: f64,
    /// One-sided, g/√Hz.
    pub density: f64,
    /// m/s².
    pub step: f64,
    /// Of the noise in motion at full speed, in that of the sensor.
    pub shaken: f64,
    /// Upwards over downwards.
    pub gain: f64,
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl Condition {
    pub(super) fn numbers(self) -> Numbers {
        let drive = Drive {
            speed: 1.6,
            acceleration: 1.1,
            jerk: 2.0,
        };
        let of = |drive: Drive, braking: Drive, levelling| Numbers {
            limits: Limits {
                drive,
                braking,
                levelling,
            },
            rate: 200.0,
            density: 400e-6,
            step: GRAVITY / 16_384.0,
            shaken: 0.0,
            gain: 1.0,
        };
        let typical = of(drive, drive, (0.0, 0.0));
        match self {
            Self::Typical => typical,
            Self::SoftBrake => {
                let soft = Drive {
                    acceleration: 0.5,
                    jerk: 1.0,
                    ..drive
                };
                of(drive, soft, (0.0, 0.0))
            }
            Self::SlowJerk => {
                let slow = Drive { jerk: 0.7, ..drive };
                of(slow, slow, (0.0, 0.0))
            }
            Self::Creep => of(drive, drive, (0.08, 3.0)),
            Self::Rough => Numbers {
                shaken: 4.0,
                ..typical
            },
            Self::GainAsymmetry => Numbers {
                gain: 1.01,
                ..typical
            },
            Self::Phone => Numbers {
                rate: 100.0,
                density: 250e-6,
                step: 0.0024,
                ..typical
            },
            Self::CoarseSteps => Numbers {
                rate: 100.0,
                step: 0.018 * GRAVITY,
                ..typical
            },
            Self::Hz50 => Numbers {
                rate: 50.0,
                ..typical
            },
            Self::Hz400 => Numbers {
                rate: 400.0,
                ..typical
            },
        }
    }
}
