//! `liftsim record`: a simulated ride as a phone would record it, with the truth beside it.

use super::output::Output;
use super::{Failure, Outcome, print};
use anyhow::{Context, anyhow};
use clap::Args;
use liftsim::signal::recording::GRAVITY;
use liftsim::signal::{
    Digitiser, Drive, Ending, ExportLayout, Pickup, Ride, Trip, write_phyphox, write_truth,
};
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Write a simulated ride as a phone on the cage's floor would record it, with the truth beside it.
///
/// The record is CSV in the layout of phyphox: time, acceleration along x, y and z (up), its size. FILE.truth.csv
/// has a line for each trip: start, stop, direction, distance, top speed, how it ended, and from when to when
/// the cage moved uniformly. Equal flags write equal bytes on every machine.
#[derive(Debug, Args)]
#[command(after_help = "Trips:\n  \
    up:12        12 m up, and a commanded stop\n  \
    down:7.5     7.5 m down\n  \
    up:30:jam    sets out for 30 m and jams half way through the uniform motion\n  \
    up:30:jam@9  jams 9 s after the start\n\n\
    Examples:\n  \
    liftsim record --out ride.csv\n  \
    liftsim record --out jam.csv --trip up:6 --trip down:20:jam --speed 1.6\n  \
    liftsim record --out rest.csv --still --rest 600 --step 0.01")]
pub struct Record {
    /// Where the record goes; the truth goes to FILE.truth.csv.
    #[arg(long, value_name = "FILE.csv")]
    out: PathBuf,
    /// Replace files that exist.
    #[arg(long)]
    force: bool,
    /// Where every draw starts from.
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Samples per second.
    #[arg(long, value_name = "HZ", default_value_t = 100.0)]
    rate: f64,
    /// A trip, once for each; see below.
    #[arg(long = "trip", value_name = "TRIP", value_parser = request,
          default_values = ["up:12", "down:12"])]
    trips: Vec<Request>,
    /// No trip at all: one rest.
    #[arg(long, conflicts_with = "trips")]
    still: bool,
    /// Seconds at rest before, between and after the trips; or once for each of these rests.
    #[arg(long = "rest", value_name = "SECONDS", default_value = "8")]
    rests: Vec<f64>,
    /// The drive's full speed, m/s.
    #[arg(long, value_name = "V", default_value_t = Drive::slow().speed)]
    speed: f64,
    /// The drive's highest acceleration, m/s^2.
    #[arg(long, value_name = "A", default_value_t = Drive::slow().acceleration)]
    acceleration: f64,
    /// The drive's highest jerk, m/s^3.
    #[arg(long, value_name = "J", default_value_t = Drive::slow().jerk)]
    jerk: f64,
    /// Seconds in which a jam brings the cage to a stand.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.1)]
    jam_within: f64,
    /// Deviation of the white noise on each axis, m/s^2.
    #[arg(long, value_name = "SIGMA", default_value_t = 0.012)]
    sigma: f64,
    /// Deviation of the vibration at full speed, in sigma; 2.2 makes uniform motion 2.4 times as noisy as
    /// rest.
    #[arg(long, value_name = "V", default_value_t = 2.2)]
    vibration: f64,
    /// The sensor's step, m/s^2; none by default.
    #[arg(long, value_name = "STEP")]
    step: Option<f64>,
    /// Leave gravity in the vertical axis: 9.80665 m/s^2.
    #[arg(long)]
    with_gravity: bool,
}

/// A trip as it is typed.
#[derive(Clone, Copy, Debug)]
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

/// `up:12`, `down:7.5`, `up:30:jam`, `up:30:jam@9`.
fn request(text: &str) -> Result<Request, String> {
    let refused =
        || "a trip reads up:METRES or down:METRES, then :jam or :jam@SECONDS if it jams".to_owned();
    let mut parts = text.split(':');
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
    let jam = match parts.next().map(|jam| jam.strip_prefix("jam")) {
        None => None,
        Some(Some("")) => Some(When::HalfWay),
        Some(Some(at)) => {
            let seconds = at.strip_prefix('@').and_then(|s| s.parse().ok());
            Some(When::After(seconds.ok_or_else(refused)?))
        }
        Some(None) => return Err(refused()),
    };
    match parts.next() {
        None => Ok(Request {
            distance: sign * metres,
            jam,
        }),
        Some(_) => Err(refused()),
    }
}

impl Record {
    /// Runs the command.
    pub fn run(self) -> Outcome {
        if self.out.extension().is_none_or(|e| e != "csv") {
            let out = self.out.display();
            return Err(Failure::Input(anyhow!("--out must end in .csv, got {out}")));
        }
        let out = Output::new(&self.out, self.force)?;
        let truth = Output::new(&self.out.with_extension("truth.csv"), self.force)?;
        let ride = self.ride().map_err(Failure::Input)?;
        let upright = self.pickup().map_err(Failure::Input)?;
        out.write_with(|out| self.write_record(out, &ride, &upright))?;
        truth.write_with(|out| write_truth(out, &ride))?;
        print(&format!(
            "{}  {} samples, {:.1} s at {} Hz\n{}  {} trip{}\n",
            out.path().display(),
            ride.samples(),
            ride.duration(),
            ride.rate(),
            truth.path().display(),
            ride.trips().len(),
            if ride.trips().len() == 1 { "" } else { "s" },
        ))?;
        Ok(ExitCode::SUCCESS)
    }

    fn ride(&self) -> anyhow::Result<Ride> {
        let requests = if self.still { &[] } else { &self.trips[..] };
        let trip = |(number, request): (usize, &Request)| {
            let trip = self.trip(request);
            trip.with_context(|| format!("--trip, number {number}"))
        };
        let trips = (1..).zip(requests).map(trip);
        let trips = trips.collect::<anyhow::Result<Vec<Trip>>>()?;
        let rests = match self.rests[..] {
            [_, _, ..] if self.still => {
                return Err(anyhow!(
                    "--still is one rest, got {} (give --rest once)",
                    self.rests.len()
                ));
            }
            [rest] => vec![rest; trips.len() + 1],
            _ => self.rests.clone(),
        };
        Ok(Ride::new(self.rate, rests, trips)?)
    }

    fn trip(&self, request: &Request) -> anyhow::Result<Trip> {
        let commanded = Trip {
            distance: request.distance,
            drive: Drive {
                speed: self.speed,
                acceleration: self.acceleration,
                jerk: self.jerk,
            },
            ending: Ending::Commanded,
        };
        let (from, to) = commanded.course()?.uniform_motion();
        let ending = request.jam.map_or(Ending::Commanded, |when| Ending::Jam {
            after: match when {
                When::HalfWay => f64::midpoint(from, to),
                When::After(seconds) => seconds,
            },
            within: self.jam_within,
        });
        let trip = Trip {
            ending,
            ..commanded
        };
        trip.course()?;
        Ok(trip)
    }

    /// That of the vertical axis.
    fn pickup(&self) -> anyhow::Result<Pickup> {
        let pickup = Pickup {
            vibration: self.vibration,
            bias: if self.with_gravity { GRAVITY } else { 0.0 },
            ..Pickup::white(self.sigma)
        };
        let pickup = pickup.checked().context("sensor")?;
        let in_sigma = self.step.map(|step| step / self.sigma);
        let digitiser = Digitiser::new(in_sigma, None).map_err(|_| {
            anyhow!(
                "--step must lie in [1e-9, 1e9] times --sigma, got {} (leave it out for no steps)",
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
        let axis = |pickup: &Pickup, index| ride.simulate(pickup, self.seed, index).record;
        let (x, y, z) = (axis(&level, 1), axis(&level, 2), axis(upright, 0));
        let layout = match self.with_gravity {
            true => ExportLayout::WithGravity,
            false => ExportLayout::Linear,
        };
        write_phyphox(out, layout, self.rate, [&x, &y, &z])
    }
}
