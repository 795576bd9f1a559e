//! Under which conditions trips are simulated.

use crate::lift::{Braking, Drive, Ending, Ride, Trip};
use crate::recording::GRAVITY;
use crate::rule::{OutOfRange, Rule};
use crate::run::Identity;
use crate::study::outcomes::ascending;
use crate::track::Densities;
use libm::sqrt;
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
pub struct Numbers {
    pub drive: Drive,
    pub braking: Braking,
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
    pub fn numbers(self) -> Numbers {
        let drive = Drive {
            speed: 1.6,
            acceleration: 1.1,
            jerk: 2.0,
        };
        let braking = Braking {
            acceleration: drive.acceleration,
            jerk: drive.jerk,
            creep: 0.0,
            seconds: 0.0,
        };
        let typical = Numbers {
            drive,
            braking,
            rate: 200.0,
            density: 400e-6,
            step: GRAVITY / 16_384.0,
            shaken: 0.0,
            gain: 1.0,
        };
        match self {
            Self::Typical => typical,
            Self::SoftBrake => Numbers {
                braking: Braking {
                    acceleration: 0.5,
                    jerk: 1.0,
                    ..braking
                },
                ..typical
            },
            Self::SlowJerk => Numbers {
                drive: Drive { jerk: 0.7, ..drive },
                braking: Braking {
                    jerk: 0.7,
                    ..braking
                },
                ..typical
            },
            Self::Creep => Numbers {
                braking: Braking {
                    creep: 0.08,
                    seconds: 3.0,
                    ..braking
                },
                ..typical
            },
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

impl Numbers {
    /// The deviation of a reading, m/s².
    pub fn sigma(&self) -> f64 {
        sqrt(Densities::of_sheet(self.density) * self.rate)
    }

    /// Whether the same drive moves both.
    pub fn is_driven_like(&self, other: &Self) -> bool {
        (self.drive, self.braking) == (other.drive, other.braking)
    }

    /// A trip of so many metres, up positive, between two rests, s.
    pub fn ride(&self, distance: f64, rests: [f64; 2]) -> Ride {
        let trip = Trip {
            distance,
            drive: self.drive,
            ending: Ending::Braked(self.braking),
        };
        Ride::new(self.rate, rests.to_vec(), vec![trip]).expect("every limit here is positive")
    }
}

/// The conditions of a study, each with every value of a key.
pub struct Grid {
    /// The study's table, and the key in it.
    pub table: &'static str,
    pub key: &'static str,
    /// What its values are called together, and what each must be.
    pub values: &'static str,
    pub rule: Rule,
}

impl Grid {
    /// Checks that there are points, and each but once.
    ///
    /// # Errors
    /// If there are none, one is there twice, or a value breaks its rule.
    pub fn check(&self, conditions: &[Condition], values: &[f64]) -> Result<(), OutOfRange> {
        let Self { table, key, .. } = self;
        let of = |key: &str| format!("{table}.{key}");
        if conditions.is_empty() || values.is_empty() {
            let rule = format!("name a condition and a {key}");
            return Err(OutOfRange::new(*table, rule, "none"));
        }
        ascending(&of(key), self.values, self.rule, values)?;
        let mut conditions = conditions.to_vec();
        conditions.sort_unstable();
        match conditions.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => {
                let got = format!("{} twice", pair[0]);
                Err(OutOfRange::new(
                    of("condition"),
                    "name each condition once",
                    got,
                ))
            }
            None => Ok(()),
        }
    }

    /// Condition by condition.
    pub fn points(conditions: &[Condition], values: &[f64]) -> Vec<(Condition, f64)> {
        let of = |condition: &Condition| values.iter().map(|value| (*condition, *value)).collect();
        conditions
            .iter()
            .flat_map(|it| -> Vec<_> { of(it) })
            .collect()
    }

    /// Every parameter of a point.
    pub fn identity(&self, condition: Condition, value: f64) -> Identity {
        let numbers = format!("{:?}", condition.numbers());
        Identity::new([
            ("condition", condition.to_string()),
            ("numbers", numbers),
            (self.key, value.to_string()),
        ])
    }
}
