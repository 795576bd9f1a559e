//! `liftsim monitor`: watches a lift, sample by sample, from standard input.

use super::floors::{Building, FloorArguments};
use super::heartbeat::{self, Heartbeat};
use super::monitor_options::{Beginning, MonitorArguments, Setup};
use super::network::{Network, NetworkArguments};
use super::output;
use super::reading::ColumnArguments;
use super::readings::{Reading, Readings};
use super::{CommandResult, Failure, print_to, warn};
use anyhow::{Context, anyhow};
use clap::Args;
use liftsim::detection::MonitorOptions;
use liftsim::monitor::{Kind, Knowledge, Monitor, SavedState};
use liftsim::recording::{self, LineReader, Sample};
use liftsim::track::{Happened, Watch};
use serde::Serialize;
use std::io::{self, BufReader};
use std::iter;
use std::process::{self, ExitCode};
use std::sync::{Mutex, mpsc};
use std::thread;
use std::time::Duration;

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
/// stretch of the record. Where the state is not rest it is told once nothing has moved the sensor for 10 s and the stretch
/// shows the stop, if the cage is known to have stood before (say --begins rest); at most after a quarter of an hour. With
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
    /// Print a line every so many seconds of this machine's clock, with the state that was last told, the number of
    /// readings, and for how long none has come; not over --tcp: {"event":"heartbeat","time":…,"state":"rest","readings":6000,"silent":0.0}.
    #[arg(long, value_name = "SECONDS", value_parser = heartbeat::period)]
    heartbeat: Option<Duration>,
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

const NO_READING: &str = "standard input: holds no reading (check that the sensor sends any)";

impl MonitorCommand {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let Setup { config, saved } = self.options.setup()?;
        let reading = self.columns.over(&config.reading)?;
        if let Some(spool) = self.network.spool() {
            output::apart(spool, self.floors.map.iter())?;
        }
        let network = self.network.open()?;
        // Heartbeats and events come from two threads, and each line is written whole.
        let out = Mutex::new(());
        let report = |line: String| {
            let _alone = out.lock();
            // First into the spool, so that whatever was printed is delivered too.
            if let Some(network) = &network {
                network.send(&line);
            }
            Ok(print_to(&mut io::stdout().lock(), &line)? || network.is_some())
        };
        let heartbeat = Heartbeat::new();
        let beat = || {
            let _alone = out.lock();
            match print_to(&mut io::stdout().lock(), &heartbeat.line()) {
                Ok(true) => true,
                // The listener of the network still reads the events.
                Ok(false) if network.is_some() => false,
                // Nobody reads: the other thread would see it no sooner than at its next event.
                Ok(false) => process::exit(0),
                Err(failure) => process::exit(failure.report().into()),
            }
        };
        let watched = thread::scope(|scope| {
            let (_ends, end) = mpsc::channel();
            if let Some(period) = self.heartbeat {
                let beat = &beat;
                scope.spawn(move || heartbeat::beat(period, &end, beat));
            }
            self.watch(config, saved, &reading, &heartbeat, report)
        });
        let delivered = network.map_or(0, Network::close);
        match (watched?, delivered) {
            (true, _) => {}
            (false, 0) => return Err(Failure::Input(anyhow!(NO_READING))),
            (false, lines) => warn(format_args!(
                "{NO_READING}; lines of an earlier start that are delivered now: {lines}"
            )),
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Reports every event, until there are no more samples, or nobody reads the reports; whether there was any sample.
    fn watch(
        &self,
        config: MonitorOptions,
        saved: Option<SavedState>,
        reading: &recording::Reading,
        heartbeat: &Heartbeat,
        report: impl FnMut(String) -> Result<bool, Failure>,
    ) -> Result<bool, Failure> {
        let input = BufReader::with_capacity(1 << 16, io::stdin().lock());
        let lines = if self.expected_moving {
            LineReader::with_drum(input, reading)
        } else {
            LineReader::new(input, reading)
        };
        let heartbeat = self.heartbeat.is_some().then_some(heartbeat);
        let mut readings = Readings::new(lines, self.keep_going, heartbeat);
        let known = self.rate.or(saved.as_ref().map(|saved| saved.rate));
        let Some((first, rate)) = readings.begin(known)? else {
            return Ok(false);
        };
        let saved = saved.unwrap_or(SavedState {
            settings: config.settings,
            rate,
            first_sample: None,
            knowledge: Knowledge::default(),
        });
        let saved = SavedState { rate, ..saved };
        let mut lift = self.lift(&saved, known.is_none(), &first[0].0, heartbeat, report)?;
        let rest = iter::from_fn(|| readings.next().transpose());
        let read = lift.take(first.into_iter().map(Ok).chain(rest));
        // What was read is told, also before a line that cannot be.
        let ended = lift.end();
        readings.say_counts();
        read.and(ended)?;
        Ok(true)
    }

    /// The lift, at a rate that was perhaps measured, as the samples begin.
    fn lift<'a, R: FnMut(String) -> Result<bool, Failure>>(
        &self,
        saved: &SavedState,
        is_measured: bool,
        beginning: &Sample,
        heartbeat: Option<&'a Heartbeat>,
        report: R,
    ) -> Result<Lift<'a, R>, Failure> {
        let mut knowledge = saved.knowledge_of(beginning);
        if let Some(begins) = self.begins {
            knowledge.begins_at_rest = begins == Beginning::Rest;
        }
        let begins_at_rest = match self.begins {
            Some(begins) => begins.is_rest(),
            None => knowledge.begins_at_rest.then_some(true),
        };
        let design = saved.design().map_err(anyhow::Error::from);
        let design = if is_measured {
            design.context("standard input, whose times must be in s")
        } else {
            design
        };
        let design = design.map_err(Failure::Input)?;
        let building = self.floors.building(false)?;
        let measures = self.trips || building.is_some();
        let mut lift = Lift {
            trips: measures.then(|| Watch::new(design.clone(), begins_at_rest)),
            monitor: Monitor::new(design, knowledge),
            building,
            heartbeat,
            report,
            is_warned: false,
            is_read: true,
        };
        if self.begins == Some(Beginning::Motion) {
            lift.monitor.begin_in_motion();
        }
        let event = lift.monitor.beginning(beginning.time);
        lift.say(&event)?;
        Ok(lift)
    }
}

/// A lift, and where its events are reported.
struct Lift<'a, R> {
    monitor: Monitor,
    trips: Option<Watch>,
    building: Option<Building>,
    heartbeat: Option<&'a Heartbeat>,
    report: R,
    /// Whether the warning of [`Watch::warning`] was given.
    is_warned: bool,
    /// Whether anybody reads what is reported.
    is_read: bool,
}

impl<R: FnMut(String) -> Result<bool, Failure>> Lift<'_, R> {
    /// Takes readings, as long as anybody reads what they show.
    fn take(
        &mut self,
        mut readings: impl Iterator<Item = Result<Reading, Failure>>,
    ) -> Result<(), Failure> {
        while self.is_read
            && let Some(reading) = readings.next()
        {
            self.step(reading?)?;
        }
        Ok(())
    }

    /// Takes a reading, and reports what it shows.
    fn step(&mut self, (sample, drum_turns): Reading) -> Result<(), Failure> {
        for event in self.monitor.step(sample, drum_turns) {
            if let (Some(heartbeat), Kind::Change { state, .. }) = (self.heartbeat, event.kind) {
                heartbeat.told(state);
            }
            self.is_read = self.is_read && (self.report)(line(event))?;
        }
        let Some(trips) = &mut self.trips else {
            return Ok(());
        };
        let floors = self.building.as_mut().map(|it| &mut it.floors);
        let (state, quiet) = (self.monitor.state(), self.monitor.quiet());
        let told = trips.step(sample, state, quiet, floors);
        if !told.is_empty() {
            self.tell(&told)?;
            self.building.as_ref().map_or(Ok(()), Building::keep)?;
        }
        Ok(())
    }

    /// Reports what is left, and writes the map.
    fn end(mut self) -> Result<(), Failure> {
        if let Some(trips) = &mut self.trips {
            let told = trips.end(self.building.as_mut().map(|it| &mut it.floors));
            self.tell(&told)?;
        }
        self.building.map_or(Ok(()), |building| building.save())
    }

    fn tell(&mut self, told: &[Happened]) -> Result<(), Failure> {
        let warning = self.trips.as_ref().and_then(Watch::warning);
        if let Some(warning) = warning.filter(|_| !self.is_warned) {
            warn(warning);
            self.is_warned = true;
        }
        told.iter().try_for_each(|event| self.say(event))
    }

    fn say(&mut self, event: &impl Serialize) -> Result<(), Failure> {
        self.is_read = self.is_read && (self.report)(line(event))?;
        Ok(())
    }
}

/// An event as a line.
pub fn line(event: &impl Serialize) -> String {
    serde_json::to_string(event).expect("an event can be written") + "\n"
}
