//! `liftsim simulate`: a ride as a phone would record it, with the truth beside it.

use super::output::Output;
use super::{CommandResult, Failure, print};
use anyhow::{Context, anyhow};
use clap::Args;
use liftsim::config;
use liftsim::lift::{Drive, Ending, ExportLayout, Pickup, Ride, Trip, write_phyphox, write_truth};
use liftsim::recording::GRAVITY;
use liftsim::signal::Digitiser;
use liftsim::study::reference;
use schemars::JsonSchema;
use serde::Deserialize;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Simulate a ride as a phone on the cage's floor would record it, with the truth beside it.
///
/// The record is CSV in the layout of phyphox: time, acceleration along x, y and z (up), its size. FILE.truth.csv
/// has a line for each trip: start, stop, direction, distance, top speed, how it ended, and from when to when
/// the cage moved uniformly. Equal settings give equal bytes on every machine.
#[derive(Debug, Args)]
#[command(after_help = "Trips:\n  \
    up:12        12 m up, and a commanded stop\n  \
    down:7.5     7.5 m down\n  \
    up:30:jam    sets out for 30 m and jams half way through the uniform motion\n  \
    up:30:jam@9  jams 9 s after the start\n\n\
    Examples:\n  \
    liftsim simulate configs/simulate/ride.toml --out ride.csv\n  \
    liftsim simulate --out jam.csv --trip up:6 --trip down:20:jam --speed 1.6\n  \
    liftsim simulate --out rest.csv --still --rest 600 --step 0.01")]
pub struct Simulate {
    /// Settings, a TOML file with keys named as the flags below; flags take precedence.
    config: Option<PathBuf>,
    /// The file of the record; the truth is written to FILE.truth.csv.
    #[arg(long, value_name = "FILE.csv")]
    out: PathBuf,
    /// Replace files that exist.
    #[arg(long)]
    force: bool,
    /// No trips: a single rest.
    #[arg(long, conflicts_with = "trip")]
    still: bool,
    #[command(flatten)]
    settings: Settings,
}

/// The ride and the sensor, from a config or the flags.
#[derive(Clone, Debug, Default, Args, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Settings {
    /// Seed of all random draws [default: 1].
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Samples per second [default: 100].
    #[arg(long, value_name = "HZ")]
    rate: Option<f64>,
    /// A trip, once for each; see below [default: up:12 and down:12].
    #[arg(long, value_name = "TRIP", value_parser = Request::parse)]
    #[schemars(with = "Option<Vec<String>>")]
    #[schemars(
        description = "Trips such as `up:12`, `down:7.5`, `up:30:jam` (half way) and `up:30:jam@9` \
        (9 s after the start); `[]` is a single rest [default: up:12 and down:12]."
    )]
    trip: Option<Vec<Request>>,
    /// Seconds at rest before, between and after the trips; or once for each of these rests [default: 8].
    #[arg(long, value_name = "SECONDS")]
    rest: Option<Vec<f64>>,
    /// The drive's full speed, m/s [default: 0.7].
    #[arg(long, value_name = "V")]
    speed: Option<f64>,
    /// The drive's highest acceleration, m/s^2 [default: 0.6].
    #[arg(long, value_name = "A")]
    acceleration: Option<f64>,
    /// The drive's highest jerk, m/s^3 [default: 0.8].
    #[arg(long, value_name = "J")]
    jerk: Option<f64>,
    /// Seconds in which a jam brings the cage to a stand [default: 0.1].
    #[arg(long, value_name = "SECONDS")]
    jam_within: Option<f64>,
    /// Deviation of the white noise on each axis, m/s^2 [default: 0.012].
    #[arg(long, value_name = "SIGMA")]
    sigma: Option<f64>,
    /// Deviation of the vibration at full speed, in sigma; 2.2 makes uniform motion 2.4 times as noisy as
    /// rest [default: 2.2].
    #[arg(long, value_name = "V")]
    vibration: Option<f64>,
    /// The sensor's step, m/s^2 [default: none].
    #[arg(long, value_name = "STEP")]
    step: Option<f64>,
    /// Leave gravity in the vertical axis: 9.80665 m/s^2.
    #[arg(long)]
    with_gravity: bool,
}

/// A trip as it is typed.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "String")]
struct Request {
    distance: f64,
    jam: Option<When>,
}

/// When a trip jams.
#[derive(Clone, Copy, Debug)]
enum When {
    HalfWay,
    /// s from the start.
    After(f64),
}

impl Request {
    /// `up:12`, `down:7.5`, `up:30:jam`, `up:30:jam@9`.
    fn parse(text: &str) -> Result<Self, String> {
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

    fn trip(&self, drive: Drive, jam_within: f64) -> anyhow::Result<Trip> {
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

/// The keys of the config, in words.
pub fn reference() -> String {
    let title = "# Keys of `simulate`\n\n";
    title.to_owned()
        + &reference::table::<Settings>("a ride", "Flags of the same names go over them.")
}

impl Simulate {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        if self.out.extension().is_none_or(|e| e != "csv") {
            let out = self.out.display();
            return Err(Failure::Input(anyhow!("--out must end in .csv, got {out}")));
        }
        let record = Output::new(&self.out, self.force)?;
        let truth = Output::new(&self.out.with_extension("truth.csv"), self.force)?;
        let paths = [&record, &truth].map(|output| output.path().display().to_string());
        let settings = self.settings()?;
        let ride = settings.ride().map_err(Failure::Input)?;
        let upright = settings.pickup().map_err(Failure::Input)?;
        let record = record.write_with(|out| settings.write_record(out, &ride, &upright))?;
        let truth = truth.write_with(|out| write_truth(out, &ride))?;
        record.publish()?;
        truth.publish()?;
        print(&format!(
            "{}  {} samples, {:.1} s at {} Hz\n{}  {} trip{}\n",
            paths[0],
            ride.samples(),
            ride.duration(),
            ride.rate(),
            paths[1],
            ride.trips().len(),
            if ride.trips().len() == 1 { "" } else { "s" },
        ))?;
        Ok(ExitCode::SUCCESS)
    }

    /// The flags over the config.
    fn settings(&self) -> Result<Settings, Failure> {
        let mut flags = self.settings.clone();
        if self.still {
            flags.trip = Some(Vec::new());
            if let Some(rests @ [_, _, ..]) = flags.rest.as_deref() {
                return Err(Failure::Input(anyhow!(
                    "--still: needs one rest, got {} (give --rest once)",
                    rests.len()
                )));
            }
        }
        let config = self.config.as_deref().map(config::read).transpose();
        Ok(flags.over(config.map_err(Failure::input)?.unwrap_or_default()))
    }
}

impl Settings {
    fn over(self, config: Self) -> Self {
        Self {
            seed: self.seed.or(config.seed),
            rate: self.rate.or(config.rate),
            trip: self.trip.or(config.trip),
            rest: self.rest.or(config.rest),
            speed: self.speed.or(config.speed),
            acceleration: self.acceleration.or(config.acceleration),
            jerk: self.jerk.or(config.jerk),
            jam_within: self.jam_within.or(config.jam_within),
            sigma: self.sigma.or(config.sigma),
            vibration: self.vibration.or(config.vibration),
            step: self.step.or(config.step),
            with_gravity: self.with_gravity || config.with_gravity,
        }
    }

    fn rate(&self) -> f64 {
        self.rate.unwrap_or(100.0)
    }

    fn ride(&self) -> anyhow::Result<Ride> {
        let slow = Drive::slow();
        let drive = Drive {
            speed: self.speed.unwrap_or(slow.speed),
            acceleration: self.acceleration.unwrap_or(slow.acceleration),
            jerk: self.jerk.unwrap_or(slow.jerk),
        };
        let jam_within = self.jam_within.unwrap_or(0.1);
        let there_and_back = [12.0, -12.0].map(|distance| Request {
            distance,
            jam: None,
        });
        let requests = self.trip.as_deref().unwrap_or(&there_and_back);
        let trips = (1..)
            .zip(requests)
            .map(|(number, request)| {
                let trip = request.trip(drive, jam_within);
                trip.with_context(|| format!("trip {number}"))
            })
            .collect::<anyhow::Result<Vec<_>>>()?;
        let rests = match self.rest.as_deref().unwrap_or(&[8.0]) {
            [rest] => vec![*rest; trips.len() + 1],
            rests => rests.to_vec(),
        };
        Ok(Ride::new(self.rate(), rests, trips)?)
    }

    /// The sensor of the vertical axis.
    fn pickup(&self) -> anyhow::Result<Pickup> {
        let sigma = self.sigma.unwrap_or(0.012);
        let pickup = Pickup {
            vibration: self.vibration.unwrap_or(2.2),
            bias: if self.with_gravity { GRAVITY } else { 0.0 },
            ..Pickup::white(sigma)
        };
        let pickup = pickup.checked().context("sensor")?;
        let digitiser = Digitiser::new(self.step.map(|step| step / sigma), None).map_err(|_| {
            anyhow!(
                "step must lie in [1e-9, 1e9] times sigma, got {} (leave it out for no steps)",
                self.step.unwrap_or_default()
            )
        })?;
        Ok(Pickup {
            digitiser,
            ..pickup
        })
    }

    fn write_record(&self, out: &mut impl Write, ride: &Ride, upright: &Pickup) -> io::Result<()> {
        let level = Pickup {
            cosine: 0.0,
            bias: 0.0,
            ..upright.clone()
        };
        let seed = self.seed.unwrap_or(1);
        let axis = |pickup: &Pickup, index| ride.simulate(pickup, seed, index).record;
        let (x, y, z) = (axis(&level, 1), axis(&level, 2), axis(upright, 0));
        let layout = if self.with_gravity {
            ExportLayout::WithGravity
        } else {
            ExportLayout::Linear
        };
        write_phyphox(out, layout, self.rate(), [&x, &y, &z])
    }
}
