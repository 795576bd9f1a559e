//! The classes of records, and what each draws otherwise than the ordinary one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What makes a record hard to read.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Class {
    /// Nothing but people at rest.
    Ordinary,
    /// Rests of 0 to 5 s before, between and after the trips.
    ShortRests,
    /// The record begins within the first trip, ends within the last one, or both.
    Cut,
    /// The level drifts by up to 0.1 m/s² a minute, along a line or a smooth random walk.
    Drift,
    /// Levelling at 0.03 to 0.3 m/s for 1 to 8 s after the braking.
    Creep,
    /// Motion is as quiet as rest or quieter, for people move at rest.
    QuietCruise,
    /// The cage leaves every floor at 0.2 to 0.5 m/s, with 0.1 to 0.6 m/s², for 2 to 8 s, and levels like that.
    TwoStage,
    /// Half-way on every trip that is long enough it has 0.3 to 0.6 of its speed for 3 to 10 s.
    SlowZone,
    /// A first-order high pass of 0.5 to 16 s.
    HighPass,
    /// One to three stretches of 0.3 to 5 s are missing.
    Holes,
    /// From 5 to 500 samples a second.
    Rates,
    /// Steps of 0.1 m/s².
    Coarse,
    /// Handled for 1 to 4 s before the first rest and after the last.
    Handled,
    /// The level shifts by 0.02 to 0.1 m/s² for 3 to 15 s.
    LevelShift,
    /// The level shifts for good.
    LevelStep,
    /// One to three half-sines of 2 to 20 m/s² in 10 to 80 ms.
    Shocks,
    /// One to three jumps of a person at rest.
    Jumps,
    /// The cage bounces on a long rope when people board: 5 to 30 mm at 0.5 to 1.5 Hz.
    Boarding,
    /// The sensor repeats one value from some time on.
    Frozen,
    /// From 2.5 to 6 m/s, then levelling at 0.2 to 0.5 m/s for 2 to 8 s.
    Express,
    /// A lift of 0.1 to 0.2 m/s.
    Slow,
    /// Starts and stops at 0.04 to 0.08 m/s².
    SoftStarts,
    /// Corrections of 2 to 5 cm at 0.05 m/s at rest.
    Relevelling,
    /// Rests of 1.5 to 3 s between trips.
    BackToBack,
    /// One or two stretches of 0.5 to 20 s are missing.
    Gaps,
    /// The sensor tilts by 2 to 6 degrees in motion.
    Tilt,
    /// The sensor is turned at rest: its level changes by 0.1 to 0.5 m/s² for good.
    Turned,
    /// It is turned like that within half a second of a start, of lifts that may start softly.
    TurnedAtStart,
    /// At rest somebody picks the sensor up, holds it for 3 to 8 s and puts it down.
    Held,
    /// The level settles by 0.05 to 0.25 m/s², with a time constant of 5 to 40 s.
    WarmUp,
    /// The drum turns for 4 to 15 s while the cage stands: after a disturbance, or after a jam.
    Drum,
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// The most trips in a record of any class.
pub(crate) const MOST_TRIPS: u64 = 6;

/// The least and the largest value of everything that every record draws.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ranges {
    /// The number of trips.
    pub trips: [usize; 2],
    /// The first rest, s.
    pub first: [f64; 2],
    /// Every other rest, s.
    pub rest: [f64; 2],
    /// m/s.
    pub speed: [f64; 2],
    /// m/s².
    pub acceleration: [f64; 2],
    /// m/s³.
    pub jerk: [f64; 2],
    /// Acceleration of the braking, in that of the start.
    pub braking: [f64; 2],
    /// Speed of the levelling, m/s; 0 for none.
    pub levelling: [f64; 2],
    /// How long it levels, s.
    pub levelling_time: [f64; 2],
    /// Samples per second.
    pub rate: [f64; 2],
    /// One-sided root density of the noise, µg/√Hz.
    pub density: [f64; 2],
    /// Deviation of the vibration at the lift's speed, σ.
    pub vibration: [f64; 2],
    /// Deviation of the noise of people at rest, σ.
    pub people: [f64; 2],
    /// Footfalls a second at rest.
    pub footfalls: [f64; 2],
    /// The step of a sample, m/s².
    pub quantum: [f64; 2],
}

impl Ranges {
    pub fn of(class: Class) -> Self {
        let ordinary = Self {
            trips: [1, 4],
            first: [8.0, 15.0],
            rest: [4.0, 15.0],
            speed: [0.4, 4.5],
            acceleration: [0.4, 1.2],
            jerk: [0.5, 2.0],
            braking: [0.7, 1.4],
            levelling: [0.0, 0.0],
            levelling_time: [0.0, 0.0],
            rate: [25.0, 200.0],
            density: [150.0, 600.0],
            vibration: [0.5, 4.0],
            people: [0.0, 2.0],
            footfalls: [0.0, 0.5],
            quantum: [6e-4, 2e-2],
        };
        match class {
            Class::ShortRests => Self {
                first: [0.0, 5.0],
                rest: [0.0, 5.0],
                ..ordinary
            },
            Class::Cut => Self {
                trips: [2, 4],
                ..ordinary
            },
            Class::Creep => Self {
                levelling: [0.03, 0.3],
                levelling_time: [1.0, 8.0],
                ..ordinary
            },
            Class::QuietCruise => Self {
                vibration: [0.0, 0.3],
                people: [1.0, 5.0],
                footfalls: [0.2, 1.0],
                ..ordinary
            },
            Class::Rates => Self {
                rate: [5.0, 500.0],
                ..ordinary
            },
            Class::Coarse => Self {
                quantum: [0.1, 0.1],
                ..ordinary
            },
            Class::Boarding => Self {
                rest: [10.0, 20.0],
                ..ordinary
            },
            Class::TwoStage => Self {
                speed: [1.0, 4.5],
                levelling: [0.2, 0.5],
                levelling_time: [2.0, 8.0],
                ..ordinary
            },
            Class::SlowZone => Self {
                speed: [1.0, 4.5],
                ..ordinary
            },
            Class::Express => Self {
                speed: [2.5, 6.0],
                levelling: [0.2, 0.5],
                levelling_time: [2.0, 8.0],
                ..ordinary
            },
            Class::Slow => Self {
                speed: [0.1, 0.2],
                ..ordinary
            },
            Class::SoftStarts => Self {
                speed: [0.4, 1.2],
                acceleration: [0.04, 0.08],
                braking: [1.0, 1.0],
                ..ordinary
            },
            Class::Turned | Class::Held => Self {
                trips: [3, 6],
                rest: [14.0, 20.0],
                ..ordinary
            },
            Class::TurnedAtStart => Self {
                acceleration: [0.1, 1.2],
                jerk: [0.1, 2.0],
                ..ordinary
            },
            Class::BackToBack => Self {
                trips: [2, 4],
                rest: [1.5, 3.0],
                ..ordinary
            },
            Class::Drum => Self {
                trips: [1, 2],
                ..ordinary
            },
            _ => ordinary,
        }
    }
}
