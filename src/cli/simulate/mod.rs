//! `liftsim simulate`: a ride as a phone would record it, or a building's lift by any sensor, with the truth beside it.

mod building;
mod request;
mod trips;

use super::output::{self, Output, Ready};
use super::{CommandResult, Failure, completions};
use anyhow::anyhow;
use clap::Args;
use liftsim::config::{Conflict, Source};
use liftsim::lift::{
    Accelerometer, Building, Drive, ExportLayout, Fault, Pickup, Ride, Stop, write_phyphox,
    write_truth,
};
use liftsim::study::reference::{self, Chapter};
use request::Request;
use schemars::JsonSchema;
use serde::Deserialize;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Simulate a ride as a phone on the cage's floor would record it, with the truth beside it.
///
/// A config with a [building] has the lift go from floor to floor, with faults, before a sensor in any pose. The record is CSV in the layout of phyphox: time, acceleration along x, y and z (up), its size. FILE.truth.csv
/// has a line for each trip: start, stop, direction, distance, top speed, how it ended, and from when to when
/// the cage moved uniformly. Equal settings give equal bytes on every machine.
#[derive(Debug, Args)]
#[command(after_help = "Trips:\n  \
    up:12        12 m up, and a commanded stop\n  \
    down:7.5     7.5 m down\n  \
    up:30:jam    sets out for 30 m and jams half way through the uniform motion\n  \
    up:30:jam@9  jams 9 s after the start\n\n\
    Examples:\n  \
    liftsim simulate ride --out ride.csv\n  \
    liftsim simulate building --out building.csv\n  \
    liftsim simulate --out jam.csv --trip up:6 --trip down:20:jam --speed 1.6\n  \
    liftsim simulate --out rest.csv --still --rest 600 --step 0.01")]
pub struct Simulate {
    /// Settings, a TOML file with keys named as the flags below, or the name of a shipped one; flags take
    /// precedence.
    #[arg(add = completions::configs(&["simulate"]))]
    config: Option<PathBuf>,
    /// The file of the record; the truth is written to FILE.truth.csv. With - the record goes to standard output, and the
    /// truth nowhere.
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
    #[arg(skip)]
    #[schemars(skip)]
    building: Option<Box<Building>>,
    #[arg(skip)]
    #[schemars(skip)]
    sensor: Option<Box<Accelerometer>>,
}

/// A ride, and the axes before which it is made.
struct Simulation {
    ride: Ride,
    stops: Vec<Stop>,
    axes: [Pickup; 3],
    layout: ExportLayout,
    /// s.
    jitter: f64,
}

/// The keys of the config, in words.
pub fn reference() -> Chapter {
    let building = "A lift among floors, instead of trips; of the keys above it takes the seed, the rate and the drive's \
        three limits.";
    let sensor =
        "What a building's ride is recorded with; what is left out is as in its data sheet.";
    let tables = vec![
        reference::table::<Settings>("a ride", "Flags of the same names go over them."),
        reference::table::<Building>("[building]", building),
        reference::table::<Fault>("[[building.faults]]", "What goes wrong on a journey."),
        reference::table::<Accelerometer>("[sensor]", sensor),
    ];
    Chapter::new("Keys of `simulate`", "", tables)
}

impl Simulate {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let record = Output::named(&self.out, self.force, "--out", &["csv"])?;
        // Standard output takes one of both.
        let truth = (!output::is_stdout(&self.out)).then(|| self.out.with_extension("truth.csv"));
        let file = |path: &PathBuf| Output::new(path, self.force);
        let truth = truth.as_ref().map(file).transpose()?;
        let (simulation, seed) = self.simulation()?;
        let record = record.write_with(|out| simulation.write(out, seed))?;
        let ride = &simulation.ride;
        let mut text = format!(
            "{}  {} samples, {:.1} s at {} Hz\n",
            self.out.display(),
            ride.samples(),
            ride.duration(),
            ride.rate(),
        );
        let truth = truth.map(|truth| {
            let (path, trips) = (truth.path().display(), ride.trips().len());
            text += &format!(
                "{path}  {trips} trip{}\n",
                if trips == 1 { "" } else { "s" }
            );
            truth.write_with(|out| write_truth(out, ride, &simulation.stops))
        });
        let ready = [Ok(record)]
            .into_iter()
            .chain(truth)
            .collect::<Result<Vec<_>, _>>()?;
        ready.into_iter().try_for_each(Ready::publish)?;
        output::print_beside([&self.out].into_iter(), &text)?;
        Ok(ExitCode::SUCCESS)
    }

    /// What the flags over the config ask for, and the seed of its noise.
    fn simulation(&self) -> Result<(Simulation, u64), Failure> {
        let flags = self.flags()?;
        let Some(path) = &self.config else {
            return made(&flags);
        };
        let source = Source::find(path, "simulate").map_err(Failure::input)?;
        let tree = source.parse().map_err(Failure::input)?;
        let config: Settings = source.read(&tree, "").map_err(Failure::input)?;
        let settings = flags.clone().over(config);
        let Some(building) = &settings.building else {
            if settings.sensor.is_some() {
                let problem =
                    "sensor: means nothing without a [building] (add one, or give sigma and step)";
                let conflict = Conflict::of(["sensor"], problem);
                return Err(Failure::input(source.conflict(&tree, conflict, &tree.span)));
            }
            return made(&settings);
        };
        let simulation = settings.of_building(building).map_err(|conflict| {
            // A flag has no place in the file.
            let is_flag = conflict
                .keys
                .iter()
                .any(|key| flags.names().contains(&&key[..]));
            if is_flag {
                // The flag of a key has hyphens.
                let text = conflict.error.to_string();
                let end = text.find(':').unwrap_or(text.len());
                let (name, problem) = text.split_at(end);
                Failure::Input(anyhow!("--{}{problem}", name.replace('_', "-")))
            } else {
                Failure::input(source.conflict(&tree, conflict, &tree.span))
            }
        })?;
        Ok((simulation, settings.seed()))
    }

    fn flags(&self) -> Result<Settings, Failure> {
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
        Ok(flags)
    }
}

fn made(settings: &Settings) -> Result<(Simulation, u64), Failure> {
    let simulation = settings.of_trips().map_err(Failure::Input)?;
    Ok((simulation, settings.seed()))
}

impl Simulation {
    fn write(&self, out: &mut impl Write, seed: u64) -> io::Result<()> {
        let axis = |place: usize, index| {
            let simulated = self.ride.simulate(&self.axes[place], seed, index);
            simulated.record
        };
        let (x, y, z) = (axis(0, 1), axis(1, 2), axis(2, 0));
        let clock = self.ride.clock(self.jitter, seed);
        write_phyphox(out, self.layout, &clock, [&x, &y, &z])
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
            building: config.building,
            sensor: config.sensor,
        }
    }

    /// The keys that are given and mean something else, or nothing, to a building.
    fn names(&self) -> Vec<&'static str> {
        let given = [
            ("rate", self.rate.is_some()),
            ("speed", self.speed.is_some()),
            ("acceleration", self.acceleration.is_some()),
            ("jerk", self.jerk.is_some()),
            ("trip", self.trip.is_some()),
            ("rest", self.rest.is_some()),
            ("jam_within", self.jam_within.is_some()),
            ("sigma", self.sigma.is_some()),
            ("vibration", self.vibration.is_some()),
            ("step", self.step.is_some()),
            ("with_gravity", self.with_gravity),
        ];
        let given = given.into_iter().filter(|(_, is_given)| *is_given);
        given.map(|(name, _)| name).collect()
    }

    fn seed(&self) -> u64 {
        self.seed.unwrap_or(1)
    }

    fn drive(&self) -> Drive {
        let slow = Drive::slow();
        Drive {
            speed: self.speed.unwrap_or(slow.speed),
            acceleration: self.acceleration.unwrap_or(slow.acceleration),
            jerk: self.jerk.unwrap_or(slow.jerk),
        }
    }
}
