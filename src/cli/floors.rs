//! The floors of a building for `track`: the flags that say what is known of them, and what is printed.

use super::output::Output;
use super::{Failure, table, warn};
use anyhow::anyhow;
use clap::Args;
use liftsim::track::floors::{Floors, Settings, Start};
use liftsim::track::{Alarm, TrackReport, Tracked};
use serde_json::Value;
use std::path::PathBuf;

/// The deviation of given heights, m: what a drawing and the sensor's gain leave open.
const GIVEN: f64 = 0.05;

/// What is known of the floors.
#[derive(Debug, Args)]
pub struct FloorArguments {
    /// The floors' heights in m, from the lowest up, good to 5 cm: say where the car stops, and where no floor is.
    #[arg(
        long,
        value_name = "HEIGHT,HEIGHT,…",
        value_delimiter = ',',
        value_parser = height,
        allow_hyphen_values = true
    )]
    floors: Option<Vec<f64>>,
    /// A map of the floors that is kept: read if it is there, and written with what the record adds. Where it is not, and
    /// without --floors, the record must begin at an end of the shaft and sweep to the other.
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// The floor where the car stands at first, from 0 up, the lowest [default: any].
    #[arg(long, value_name = "FLOOR")]
    at: Option<usize>,
}

/// The floors, and where their map goes.
pub struct Building {
    pub floors: Floors,
    map: Option<Output>,
}

fn height(text: &str) -> Result<f64, String> {
    let height = text.trim().parse();
    height.map_err(|_| "must be metres, as in 0,3.2,6.4".to_owned())
}

impl FloorArguments {
    /// Refuses floors beside something that does not hold where the car is among them.
    pub fn refuse(&self, beside: &str) -> Result<(), Failure> {
        if self.floors.is_none() && self.map.is_none() {
            return Ok(());
        }
        Err(Failure::Input(anyhow!(
            "{beside} does not hold where the car is among the floors (leave --floors and --map out, or begin anew with --begins)"
        )))
    }

    /// What is known at first; none where floors are not asked for.
    pub fn building(&self, replaces: bool) -> Result<Option<Building>, Failure> {
        if self.floors.is_none() && self.map.is_none() {
            return match self.at {
                Some(_) => Err(refused(
                    "--at: no floors are known (give --floors or --map)",
                )),
                None => Ok(None),
            };
        }
        let map = self.map.as_ref().map(|map| Output::kept("--map", map));
        let map = map.transpose()?;
        let floors = self.known(replaces)?;
        Ok(Some(Building { floors, map }))
    }

    fn known(&self, replaces: bool) -> Result<Floors, Failure> {
        let (settings, start) = (Settings::default(), self.start());
        let kept = self.map.as_ref().filter(|map| map.exists());
        match (&self.floors, kept) {
            (Some(_), Some(map)) if !replaces => Err(refused(format!(
                "{}: is a map already (leave out --floors to use it, or --force to begin anew)",
                map.display()
            ))),
            (Some(heights), _) => {
                let given = Floors::given(settings, heights, GIVEN, start);
                given.map_err(|error| refused(format!("--{error}")))
            }
            (None, Some(map)) => Floors::load(map, settings, start).map_err(Failure::input),
            (None, None) if self.at.is_some() => Err(refused(
                "--at: there is no map yet, and a sweep begins at an end of the shaft (leave it out, or give --floors)",
            )),
            (None, None) => Floors::unknown(settings).map_err(Failure::input),
        }
    }

    fn start(&self) -> Start {
        self.at.map_or(Start::Unknown, Start::Floor)
    }
}

impl Building {
    /// Writes the map, if it is kept and there is one.
    pub fn keep(&self) -> Result<(), Failure> {
        if self.floors.floors().len() < 2 {
            return Ok(());
        }
        self.save()
    }

    /// Writes the map, if it is kept.
    pub fn save(&self) -> Result<(), Failure> {
        let Some(map) = &self.map else {
            return Ok(());
        };
        if self.floors.floors().len() < 2 {
            let path = map.path().display();
            warn(format_args!(
                "{path}: not written, the record shows no second floor (record a sweep from one end of the shaft)"
            ));
            return Ok(());
        }
        self.floors.save(map.path()).map_err(Failure::input)
    }
}

fn refused(message: impl Into<String>) -> Failure {
    Failure::Input(anyhow!(message.into()))
}

/// The columns shown of every stop, without their prefix.
const STOP: [&str; 9] = [
    "from",
    "floor",
    "probability",
    "position",
    "judgement_floor",
    "judgement_offset",
    "judgement_deviation",
    "judgement_fault",
    "added",
];

/// The columns shown of every floor.
const FLOOR: [&str; 5] = ["height", "deviation", "drift", "drift_deviation", "visits"];

/// Every stop, its alarms in words, and every floor; nothing where floors are not asked for.
pub fn text(report: &TrackReport) -> String {
    let Some(floors) = &report.floors else {
        return String::new();
    };
    let floors = floors.iter().enumerate().map(|(place, floor)| {
        let value = serde_json::to_value(floor).expect("a floor is plain data");
        row(place, FLOOR.map(|name| value[name].clone()))
    });
    let floors: Vec<_> = floors.collect();
    let legend =
        "floors from 0 up, the lowest; heights, offsets and their standard deviations in m\n";
    let floors = "\n".to_owned() + &table(&header("floor", &FLOOR), &floors) + legend;
    if report.rides.is_empty() {
        return floors;
    }
    let column = |ride: &Tracked, name: &str| ride.column(&format!("landing_{name}"));
    let stops = report.rides.iter();
    let stops = stops.map(|ride| row(ride.trip.ride, STOP.map(|name| column(ride, name))));
    let stops: Vec<_> = stops.collect();
    let legend =
        "where the probability is low it may be another floor (--at tells where the car begins)\n";
    let alarms = Alarm::all(report.rides).into_iter();
    let alarms: String = alarms.map(|alarm| format!("{alarm}\n")).collect();
    "\n".to_owned() + &table(&header("ride", &STOP), &stops) + legend + &alarms + &floors
}

fn header<'a>(first: &'a str, names: &[&'a str]) -> Vec<&'a str> {
    [&[first], names].concat()
}

fn row(first: impl ToString, values: impl IntoIterator<Item = Value>) -> Vec<String> {
    let cells = values.into_iter().map(|value| match value {
        Value::Null => "-".to_owned(),
        Value::String(text) => text,
        Value::Number(number) if number.is_f64() => metres(number.as_f64().unwrap_or(f64::NAN)),
        value => value.to_string(),
    });
    [first.to_string()].into_iter().chain(cells).collect()
}

/// Never "-0.000".
fn metres(value: f64) -> String {
    format!("{:.3}", (1e3 * value).round() / 1e3 + 0.0)
}
