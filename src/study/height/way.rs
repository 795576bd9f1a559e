//! The ways to follow a car.

use crate::track::fusion::Adapts;

/// Of the time, %.
pub const SHARES: [u8; 7] = [10, 25, 50, 75, 90, 95, 99];

/// How its height is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// By the published filter alone.
    Ukf,
    /// With the barometer calibrated at each rest.
    Calibrated,
    /// With the floors.
    Map,
    /// With Q as printed, too.
    MapPrintedQ,
    /// And as meant.
    MapMendedQ,
    /// By the distances of `liftsim track` alone.
    Trips,
    /// With the barometer as a slow height.
    Slow,
    /// With the floors.
    SlowMap,
}

/// The published filter, as a way has it.
#[derive(Clone, Copy, Debug)]
pub struct Published {
    pub calibrates: bool,
    pub knows_floors: bool,
    pub adapts: Adapts,
}

impl Way {
    pub const ALL: [Self; 8] = [
        Self::Ukf,
        Self::Calibrated,
        Self::Map,
        Self::MapPrintedQ,
        Self::MapMendedQ,
        Self::Trips,
        Self::Slow,
        Self::SlowMap,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Ukf => "ukf",
            Self::Calibrated => "calibrated",
            Self::Map => "map",
            Self::MapPrintedQ => "map_printed_q",
            Self::MapMendedQ => "map_mended_q",
            Self::Trips => "trips",
            Self::Slow => "slow",
            Self::SlowMap => "slow_map",
        }
    }

    /// If it is the published filter.
    pub fn published(self) -> Option<Published> {
        let map = |adapts| Published {
            calibrates: true,
            knows_floors: true,
            adapts,
        };
        let without = |calibrates| Published {
            calibrates,
            knows_floors: false,
            adapts: Adapts::Never,
        };
        match self {
            Self::Ukf => Some(without(false)),
            Self::Calibrated => Some(without(true)),
            Self::Map => Some(map(Adapts::Never)),
            Self::MapPrintedQ => Some(map(Adapts::Printed)),
            Self::MapMendedQ => Some(map(Adapts::Mended)),
            Self::Trips | Self::Slow | Self::SlowMap => None,
        }
    }
}
