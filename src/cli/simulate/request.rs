//! A trip as it is typed for `liftsim simulate`.

use liftsim::lift::{Drive, Ending, Trip};
use serde::Deserialize;

/// A trip as it is typed.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "String")]
pub struct Request {
    pub distance: f64,
    pub jam: Option<When>,
}

/// When a trip jams.
#[derive(Clone, Copy, Debug)]
pub enum When {
    HalfWay,
    /// s from the start.
    After(f64),
}

impl Request {
    /// `up:12`, `down:7.5`, `up:30:jam`, `up:30:jam@9`.
    pub fn parse(text: &str) -> Result<Self, String> {
        let refused =
            || "must be up:METRES or down:METRES, then :jam or :jam@SECONDS if it jams".to_owned();
        let mut parts = text.splitn(3, ':');
        let sign = match parts.next() {
            Some("up") => 1.0,
            Some("down") => -1.0,
            _ => return Err(refused()),
        };
        let metres = parts.next().and_then(|metres| metres.parse::<f64>().ok());
        let metres = metres.ok_or_else(refused)?;
        if !(metres > 0.0 && metres.is_finite()) {
            return Err(format!(
                "METRES must be positive, got {metres} (up or down says which way)"
            ));
        }
        let jam = parts.next().map(|jam| When::parse(jam).ok_or_else(refused));
        Ok(Self {
            distance: sign * metres,
            jam: jam.transpose()?,
        })
    }

    pub fn trip(&self, drive: Drive, jam_within: f64) -> anyhow::Result<Trip> {
        let commanded = Trip {
            distance: self.distance,
            drive,
            ending: Ending::Commanded,
        };
        let (from, to) = commanded.course()?.uniform_motion();
        let ending = self.jam.map_or(Ending::Commanded, |when| Ending::Jam {
            after: match when {
                When::HalfWay => f64::midpoint(from, to),
                When::After(seconds) => seconds,
            },
            within: jam_within,
        });
        let trip = Trip {
            ending,
            ..commanded
        };
        trip.course()?;
        Ok(trip)
    }
}

impl TryFrom<String> for Request {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        Self::parse(&text)
    }
}

impl When {
    /// `jam`, `jam@9`.
    fn parse(text: &str) -> Option<Self> {
        match text.strip_prefix("jam")? {
            "" => Some(Self::HalfWay),
            at => at.strip_prefix('@')?.parse().ok().map(Self::After),
        }
    }
}
