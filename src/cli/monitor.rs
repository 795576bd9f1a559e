//! `liftsim monitor`: watches a lift, sample by sample, from standard input.

use super::floors::FloorArguments;
use super::monitor_options::{Beginning, MonitorArguments, Setup, check_strength};
use super::network::NetworkArguments;
use super::reading::ColumnArguments;
use super::{CommandResult, Failure, print_to, warn};
use anyhow::{Context, anyhow};
use clap::Args;
use liftsim::detection::MonitorOptions;
use liftsim::monitor::{Knowledge, Monitor, SET_BACK, SavedState};
use liftsim::recording::{self, LineReader, LineReading, Sample};
use liftsim::track::Watch;
use serde::Serialize;
use std::io::{self, BufReader};
use std::iter;
use std::process::ExitCode;

/// Watch a lift: read samples from standard input, print changes of its state as they happen.
///
/// A line is `acceleration` or `time,acceleration`, up positive, or what a header names: the columns, units and
/// formats are those of `detect`, without a header m/s^2 and s. The output is one JSON object a line: the first state, every change of it with the time of the
/// change (time), the time at which it became known (reported) and the decision behind it; and alarms.
///
/// States are rest, acceleration, inertial, braking, levelling, and unknown, with its reason: beginning (too little was
/// seen; say --begins rest if the cage stands), pulse (it may be a start, a stop or a disturbance), level (it may
/// have shifted, or the cage moves softly), creep (the cage may not stand yet), hole (samples are missing), sensor.
/// A state is said if no plausible explanation of the record contradicts it.
///
/// The alarm `jam` says that a motion ended in a violent pulse, without the braking of a commanded stop;
/// `slack`, with --expected-moving, that the drum pays out rope and the cage is not known to move, with
/// "certain":false where it is not known to stand either. `sensor` says that it is stuck, saturated, silent, noisy or
/// moved, that its clock was set back, or that it is slow: it sends far fewer samples than before.
///
/// With `--trips` each trip is an event too, once the state has been rest again for some seconds: what `track` says of this
/// stretch of the record. Where the state stays unknown it waits, at most a quarter of an hour (say --begins rest). With
/// `--floors` or `--map` it has the stop after it, and an alarm where no floor is (`mis_levelling`, `pit`, `overrun`,
/// `between_floors`). What a stretch does not decide is the event `undecided`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    liftsim detect ride.csv --save-state lift.json\n  \
    sensor | liftsim monitor --state lift.json --begins rest\n  \
    cut -d, -f1,4 ride.csv | liftsim monitor --state lift.json\n  \
    sensor | liftsim monitor --rate 100 --begins rest\n  \
    paste -d, sensor.txt drum.txt | liftsim monitor --rate 100 --expected-moving\n  \
    sensor | liftsim monitor --begins rest --floors 0,3.2,6.4 --at 0 --map lift.map.json\n  \
    sensor | liftsim monitor --rate 100 --tcp [::1]:9000 --spool lift-1.spool")]
pub struct MonitorCommand {
    /// Samples per second; measured from the first of them where they have times.
    #[arg(long, value_name = "HZ")]
    rate: Option<f64>,
    /// What is known of the cage as the samples begin [default: unknown, unless they are those that the saved
    /// state was learnt from].
    #[arg(long, value_name = "STATE", value_enum)]
    begins: Option<Beginning>,
    /// Each line ends with one more number: 1 while the drum turns, else 0.
    #[arg(long)]
    expected_moving: bool,
    /// Skip lines that cannot be read, with a warning, instead of stopping; and go on after a clock that was set
    /// back.
    #[arg(long)]
    keep_going: bool,
    #[command(flatten)]
    options: MonitorArguments,
    #[command(flatten)]
    columns: ColumnArguments,
    /// Measure each trip once the cage stands again, as `track` does; with --floors or --map also where it stands.
    #[arg(long)]
    trips: bool,
    #[command(flatten)]
    floors: FloorArguments,
    #[command(flatten)]
    network: NetworkArguments,
}

/// Readings from which a rate is measured.
const MEASURED: usize = 100;

/// The largest time, s: no clock is later, and doubles still resolve milliseconds.
const LATEST: f64 = 1e12;

/// A sample, and whether the drum turns.
type Reading = (Sample, Option<bool>);

impl MonitorCommand {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let Setup { config, saved } = self.options.setup()?;
        let reading = self.columns.over(&config.reading)?;
        let network = self.network.open()?;
        let mut out = io::stdout().lock();
        let watched = self.watch(config, saved, &reading, |line| {
            // First into the spool, so that whatever was printed is delivered too.
            if let Some(network) = &network {
                network.send(&line);
            }
            Ok(print_to(&mut out, &line)? || network.is_some())
        });
        if let Some(network) = network {
            network.close();
        }
        watched
    }

    /// Reports every event, until there are no more samples, or nobody reads the reports.
    fn watch(
        &self,
        config: MonitorOptions,
        saved: Option<SavedState>,
        reading: &recording::Reading,
        mut report: impl FnMut(String) -> Result<bool, Failure>,
    ) -> CommandResult {
        let input = BufReader::with_capacity(1 << 16, io::stdin().lock());
        let mut readings = Readings {
            lines: if self.expected_moving {
                LineReader::with_drum(input, reading)
            } else {
                LineReader::new(input, reading)
            },
            rate: None,
            last: None,
            intervals: Vec::new(),
            count: 0,
            keeps_going: self.keep_going,
        };
        let saved_rate = saved.as_ref().map(|saved| saved.rate);
        let (first, rate) = readings.begin(self.rate.or(saved_rate))?;
        let beginning = first[0].0;
        let saved = SavedState {
            rate,
            ..saved.unwrap_or(SavedState {
                settings: config.settings,
                rate,
                first_sample: None,
                knowledge: Knowledge::default(),
            })
        };
        let mut knowledge = saved.knowledge_of(&beginning);
        if let Some(begins) = self.begins {
            knowledge.begins_at_rest = begins == Beginning::Rest;
        }
        let begins_at_rest = match self.begins {
            Some(begins) => begins.is_rest(),
            None => knowledge.begins_at_rest.then_some(true),
        };
        let design = saved.design().map_err(anyhow::Error::from);
        let design = match self.rate.or(saved_rate) {
            Some(_) => design,
            None => design.context("standard input, whose times must be in s"),
        };
        let design = design.map_err(Failure::Input)?;
        let mut monitor = Monitor::new(design, knowledge);
        if self.begins == Some(Beginning::Motion) {
            monitor.begin_in_motion();
        }
        let mut building = self.floors.building(false)?;
        let measures = self.trips || building.is_some();
        let mut trips = measures.then(|| Watch::new(monitor.design().clone(), begins_at_rest));
        let mut is_read = report(line(&monitor.beginning(beginning.time)))?;
        let rest = iter::from_fn(|| readings.next().transpose());
        let mut all = first.into_iter().map(Ok).chain(rest);
        while is_read && let Some(reading) = all.next() {
            let (sample, drum_turns) = reading?;
            for event in monitor.step(sample, drum_turns) {
                is_read = is_read && report(line(event))?;
            }
            let Some(trips) = &mut trips else {
                continue;
            };
            let floors = building.as_mut().map(|it| &mut it.floors);
            let told = trips.step(sample, monitor.state(), floors);
            for event in &told {
                is_read = is_read && report(line(event))?;
            }
            if let Some(building) = building.as_ref().filter(|_| !told.is_empty()) {
                building.keep()?;
            }
        }
        let floors = building.as_mut().map(|it| &mut it.floors);
        let told = trips.map(|trips| trips.end(floors));
        for event in told.iter().flatten() {
            is_read = is_read && report(line(event))?;
        }
        building.map_or(Ok(()), |building| building.save())?;
        Ok(ExitCode::SUCCESS)
    }
}

fn line(event: &impl Serialize) -> String {
    serde_json::to_string(event).expect("an event can be written") + "\n"
}

/// Samples from standard input.
struct Readings<R> {
    lines: LineReader<R>,
    /// Hz, where it is known.
    rate: Option<f64>,
    /// When the last sample with a time was taken, s.
    last: Option<f64>,
    /// The first intervals between such samples, s.
    intervals: Vec<f64>,
    count: u64,
    keeps_going: bool,
}

impl<R: io::BufRead> Readings<R> {
    /// The first readings, at least one, and the rate: as known, or measured from as many as that takes.
    fn begin(&mut self, known: Option<f64>) -> Result<(Vec<Reading>, f64), Failure> {
        self.rate = known;
        let wanted = if known.is_some() { 1 } else { MEASURED + 1 };
        let mut first: Vec<Reading> = Vec::new();
        while first.len() < wanted {
            match self.next()? {
                Some(reading) => first.push(reading),
                None => break,
            }
        }
        match (known.or(self.measured()), first.len()) {
            (_, 0) => Err(Failure::Input(anyhow!(
                "standard input: holds no reading (check that the sensor sends any)"
            ))),
            (None, readings) => Err(Failure::Input(anyhow!(
                "standard input: {readings} reading, and the rate is measured from two or more (give --rate)"
            ))),
            (Some(rate), _) => Ok((first, rate)),
        }
    }

    /// Hz, by the median of the first intervals.
    fn measured(&self) -> Option<f64> {
        let mut intervals = self.intervals.clone();
        intervals.sort_by(f64::total_cmp);
        intervals
            .get(intervals.len() / 2)
            .map(|median| 1.0 / median)
    }

    /// Takes the time of a sample. Once there are enough, they must agree with the known rate.
    fn take_time(&mut self, time: f64) -> Result<(), Failure> {
        if let Some(last) = self.last.replace(time)
            && time > last
            && self.intervals.len() < MEASURED
        {
            self.intervals.push(time - last);
            if self.intervals.len() == MEASURED
                && let (Some(rate), Some(measured)) = (self.rate, self.measured())
                && (measured / rate - 1.0).abs() > 0.05
            {
                return Err(Failure::Input(anyhow!(
                    "standard input: samples come at {measured:.1} Hz, and not at {rate:.1} Hz as --rate or the saved \
                     state says (leave --rate out where samples have times, or learn a state at this rate)"
                )));
            }
        }
        Ok(())
    }

    fn next(&mut self) -> Result<Option<Reading>, Failure> {
        loop {
            let refusal = match self.lines.next() {
                Ok(None) => return Ok(None),
                Ok(Some(reading)) => match self.timed(&reading)? {
                    Ok(sample) => return Ok(Some((sample, reading.drum_turns))),
                    Err(refusal) => refusal,
                },
                Err(error) if error.is_io() => return Err(Failure::run(error)),
                Err(error) => anyhow::Error::from(error),
            };
            if !self.keeps_going {
                return Err(refusal)
                    .context("standard input")
                    .map_err(Failure::Input);
            }
            warn(format_args!("{refusal:#} (passed over)"));
        }
    }

    /// A reading at its time, which must be later than that of the one before; or why it is skipped.
    #[inline]
    fn timed(&mut self, reading: &LineReading) -> Result<anyhow::Result<Sample>, Failure> {
        let acceleration = reading.acceleration;
        let line = self.lines.number();
        if let Err(refusal) = check_strength(acceleration) {
            return Ok(Err(refusal.context(format!("line {line}"))));
        }
        let Some(time) = reading.time else {
            let Some(rate) = self.rate else {
                return Err(Failure::Input(anyhow!(
                    "standard input: samples without times need a rate (give --rate)"
                )));
            };
            self.count += 1;
            let time = (self.count - 1) as f64 / rate;
            return Ok(Ok(Sample { time, acceleration }));
        };
        match self.last {
            _ if time.abs() > LATEST => Ok(Err(anyhow!(
                "line {line}: times must lie within {LATEST:e} s, got {time:e} (give them in s)"
            ))),
            Some(last) if self.keeps_going && time < last - SET_BACK => {
                warn(format_args!(
                    "standard input: line {line}: the clock was set back from {last} s to {time} s"
                ));
                self.take_time(time)?;
                Ok(Ok(Sample { time, acceleration }))
            }
            Some(last) if time <= last => Ok(Err(anyhow!(
                "line {line}: time must increase, got {time} s after {last} s (put lines in order, drop repeated \
                 ones, and write decimals with a point)"
            ))),
            _ => {
                self.take_time(time)?;
                Ok(Ok(Sample { time, acceleration }))
            }
        }
    }
}
