//! `liftsim monitor`: watches a lift, sample by sample, from standard input.

use super::first_second::FirstSecond;
use super::floors::{Building, FloorArguments};
use super::heartbeat::{self, Heartbeat};
use super::kept::{Going, Kept};
use super::monitor_options::{Beginning, MonitorArguments, Setup};
use super::network::{Network, NetworkArguments};
use super::output;
use super::reading::ColumnArguments;
use super::readings::{Reading, Readings, UNEVEN};
use super::signals::Signals;
use super::stdin::Stdin;
use super::{CommandResult, Failure, print_to, warn};
use anyhow::{Context, anyhow};
use clap::Args;
use liftsim::detection::MonitorOptions;
use liftsim::monitor::{Kind, Knowledge, Monitor, SavedState, State};
use liftsim::recording::{self, LineReader, Moment, Sample};
use liftsim::track::{Found, Happened, Watch};
use serde::Serialize;
use std::io::{self, BufReader};
use std::path::PathBuf;
use std::process::{self, ExitCode};
use std::sync::{Mutex, mpsc};
use std::thread;
use std::time::Duration;

/// Watch a lift: read samples from standard input, print changes of its state as they happen.
///
/// A line is `acceleration` or `time,acceleration`, up positive, or what a header names: the columns, units and
/// formats are those of `detect`, without a header m/s^2 and s. The output is one JSON object a line: the first state, every change of it with the time of the
/// change (time; and at, its moment by RFC 3339, where the lines have dates), the time at which it became known (reported) and the decision behind it; and alarms.
///
/// States are rest, acceleration, inertial, braking, levelling, and unknown, with its reason: beginning (too little was
/// seen; say --begins rest if the cage stands), pulse (it may be a start, a stop or a disturbance), level (it may
/// have shifted, or the cage moves softly), creep (the cage may not stand yet), hole (samples are missing), sensor.
/// A state is said if no plausible explanation of the record contradicts it, and so is a direction: one motion starts as
/// another, the other way, brakes. Until that is decided, and after a hole, a fault or a beginning that is not at rest until
/// rest was told, a cage that moves is `inertial` without a direction.
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
    sensor | liftsim monitor --state lift.json --save-state lift.json\n  \
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
    /// Save the running monitor to this file at every stop and at a signal (SIGTERM, Ctrl-C), from which --state goes on as
    /// if it had never stopped, at the same columns and units; it may be the file of --state. Readings without times are missing for as long as this
    /// machine's clock says that none was taken. A trip that is under way waits
    /// in it. Not with --floors or --map: it does not hold where the car is among them.
    #[arg(long, value_name = "FILE.json")]
    save_state: Option<PathBuf>,
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
            output::apart(spool, self.floors.map.iter().chain(&self.save_state))?;
        }
        if let Some(path) = &self.save_state {
            self.floors.refuse("--save-state")?;
            Kept::check(path, self.options.state())?;
        }
        let network = self.network.open()?;
        // Before anything is printed: whoever reads it may send one.
        let signals = self.save_state.as_ref().map(|_| Signals::watch());
        let signals = signals
            .transpose()
            .context("signals")
            .map_err(Failure::Run)?;
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
            self.watch(
                config,
                saved,
                &reading,
                signals.as_ref(),
                &heartbeat,
                report,
            )
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
        signals: Option<&Signals>,
        heartbeat: &Heartbeat,
        report: impl FnMut(String) -> Result<bool, Failure>,
    ) -> Result<bool, Failure> {
        let input = Stdin::new(signals);
        let input = input.context("standard input").map_err(Failure::Run)?;
        let input = BufReader::with_capacity(1 << 16, input);
        let mut lines = if self.expected_moving {
            LineReader::with_drum(input, reading)
        } else {
            LineReader::new(input, reading)
        };
        let mut going = match &saved {
            Some(saved) if self.begins.is_none() => Going::of(saved)?,
            _ => None,
        };
        if self.begins.is_some() && saved.as_ref().is_some_and(|it| it.running.is_some()) {
            warn(
                "--begins: the monitor begins anew: what the saved one knows of rest is used, not what the cage has done",
            );
        }
        if going.is_some() {
            self.floors.refuse("--state of a running monitor")?;
        }
        if let (Some(_), Some(rate), Some(saved)) = (&going, self.rate, &saved)
            && (rate / saved.rate - 1.0).abs() > UNEVEN
        {
            return Err(Failure::Input(anyhow!(
                "--rate: must be {} Hz, at which the saved monitor ran, got {rate} (leave it out)",
                saved.rate
            )));
        }
        if let Some(going) = &going {
            going.check(reading, self.expected_moving)?;
        }
        if let Some(columns) = going.as_mut().and_then(|it| it.columns.take()) {
            let within_line = going.as_ref().is_some_and(|it| it.taken.within_line);
            lines = lines
                .resume(columns, within_line)
                .context("standard input")
                .map_err(Failure::Input)?;
        }
        let heartbeat = self.heartbeat.is_some().then_some(heartbeat);
        let mut readings = Readings::new(lines, self.keep_going, heartbeat);
        if let Some(going) = &going {
            readings.go_on(going.taken);
        }
        let known = self.rate.or(saved.as_ref().map(|saved| saved.rate));
        let Some((first, rate)) = readings.begin(known)? else {
            let is_told = signals.is_some_and(|it| it.came().is_some());
            return match &self.save_state {
                // What a monitor went on from is still there.
                Some(path) if is_told && !path.exists() => Err(Failure::Run(anyhow!(
                    "{}: not written: there was no reading yet, and so nothing to save",
                    path.display()
                ))),
                _ => Ok(is_told),
            };
        };
        let saved = saved.unwrap_or(SavedState {
            settings: config.settings,
            rate,
            first_sample: None,
            knowledge: Knowledge::default(),
            running: None,
        });
        let saved = SavedState { rate, ..saved };
        let reports = Reports {
            zero: readings.zero(),
            report,
            is_read: true,
        };
        let lift = match going {
            Some(going) => self.go_on(going, heartbeat, reports),
            None => self.lift(&saved, known.is_none(), &first[0].0, heartbeat, reports),
        };
        let mut lift = lift?;
        let mut kept = self.save_state.as_ref().map(|path| Kept::new(path, &saved));
        let mut save = |lift: &Lift<_>, readings: &Readings<_>| {
            if let Some(kept) = &mut kept {
                kept.save(&lift.monitor, lift.trips.as_ref(), readings);
            }
        };
        let mut first = first.into_iter();
        let read = loop {
            // Nobody may read what is reported any more.
            let next = match first.next() {
                _ if !lift.reports.is_read => break Ok(()),
                None => readings.next(),
                known => Ok(known),
            };
            match next.and_then(|next| next.map(|it| lift.step(it)).transpose()) {
                Ok(Some(true)) => save(&lift, &readings),
                Ok(Some(false)) => {}
                Ok(None) => break Ok(()),
                Err(failure) => break Err(failure),
            }
        };
        // What nobody has read is told again by the monitor that goes on.
        let written = match &kept {
            Some(kept) if lift.reports.is_read => {
                kept.write(&lift.monitor, lift.trips.as_ref(), &readings)
            }
            _ => Ok(()),
        };
        // What is left is told, also before a line that cannot be read, or waits in the saved state.
        let ended = if kept.is_some() {
            lift.keep()
        } else {
            lift.end()
        };
        readings.say_counts();
        if let (Err(_), Err(error)) = (&read, &written) {
            warn(format_args!("{error:#}"));
        }
        read.and(ended).and(written.map_err(Failure::Run))?;
        Ok(true)
    }

    /// The lift that another monitor has watched.
    fn go_on<'a, R: FnMut(String) -> Result<bool, Failure>>(
        &self,
        going: Going,
        heartbeat: Option<&'a Heartbeat>,
        reports: Reports<R>,
    ) -> Result<Lift<'a, R>, Failure> {
        let building = self.floors.building(false)?;
        let measures = self.trips || building.is_some();
        let new = || Watch::new(going.monitor.design().clone(), None);
        if let Some(heartbeat) = heartbeat {
            heartbeat.told(going.monitor.state());
        }
        Ok(Lift {
            trips: measures.then(|| going.trips.unwrap_or_else(new)),
            level: going.monitor.reference().map(|it| it.level),
            monitor: going.monitor,
            building,
            heartbeat,
            reports,
            is_warned: false,
            first_second: FirstSecond::default(),
        })
    }

    /// The lift, at a rate that was perhaps measured, as the samples begin.
    fn lift<'a, R: FnMut(String) -> Result<bool, Failure>>(
        &self,
        saved: &SavedState,
        is_measured: bool,
        beginning: &Sample,
        heartbeat: Option<&'a Heartbeat>,
        reports: Reports<R>,
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
            level: knowledge.reference.as_ref().map(|it| it.level),
            monitor: Monitor::new(design, knowledge),
            building,
            heartbeat,
            reports,
            is_warned: false,
            first_second: FirstSecond::default(),
        };
        if self.begins == Some(Beginning::Motion) {
            lift.monitor.begin_in_motion();
        }
        let event = lift.monitor.beginning(beginning.time);
        lift.reports.say(event.time, &event)?;
        Ok(lift)
    }
}

/// A lift, and where its events are reported.
struct Lift<'a, R> {
    monitor: Monitor,
    trips: Option<Watch>,
    building: Option<Building>,
    heartbeat: Option<&'a Heartbeat>,
    reports: Reports<R>,
    /// Whether the warning of [`Watch::warning`] was given.
    is_warned: bool,
    first_second: FirstSecond,
    /// The level that a saved state knows, m/s².
    level: Option<f64>,
}

/// Where events are reported.
struct Reports<R> {
    /// The moment of time 0, where the lines have dates.
    zero: Option<Moment>,
    report: R,
    /// Whether anybody reads what is reported.
    is_read: bool,
}

impl<R: FnMut(String) -> Result<bool, Failure>> Reports<R> {
    /// Reports what happened at a time, s.
    fn say(&mut self, time: f64, event: &impl Serialize) -> Result<(), Failure> {
        let at = self.zero.map(|zero| zero.after(time));
        self.is_read = self.is_read && (self.report)(line(&Dated { event, at }))?;
        Ok(())
    }
}

impl<R: FnMut(String) -> Result<bool, Failure>> Lift<'_, R> {
    /// Takes a reading, and reports what it shows; whether it has shown that the cage stands.
    fn step(&mut self, (sample, drum_turns): Reading) -> Result<bool, Failure> {
        self.first_second.step(sample, self.level);
        let mut is_rest = false;
        for event in self.monitor.step(sample, drum_turns) {
            if let Kind::Change { state, .. } = event.kind {
                is_rest = state == State::REST;
                if let Some(heartbeat) = self.heartbeat {
                    heartbeat.told(state);
                }
            }
            self.reports.say(event.time, &event)?;
        }
        let Some(trips) = &mut self.trips else {
            return Ok(is_rest);
        };
        let floors = self.building.as_mut().map(|it| &mut it.floors);
        let (state, quiet) = (self.monitor.state(), self.monitor.quiet());
        let mut told = trips.step(sample, state, quiet, floors);
        if !told.is_empty() {
            self.tell(&mut told)?;
            self.building.as_ref().map_or(Ok(()), Building::keep)?;
        }
        Ok(is_rest)
    }

    /// Writes the map, and tells nothing: what is left is in the saved state.
    fn keep(self) -> Result<(), Failure> {
        self.building.map_or(Ok(()), |building| building.save())
    }

    /// Reports what is left, and writes the map.
    fn end(mut self) -> Result<(), Failure> {
        if let Some(trips) = &mut self.trips {
            let mut told = trips.end(self.building.as_mut().map(|it| &mut it.floors));
            self.tell(&mut told)?;
        }
        self.building.map_or(Ok(()), |building| building.save())
    }

    fn tell(&mut self, told: &mut [Happened]) -> Result<(), Failure> {
        let warning = self.trips.as_ref().and_then(Watch::warning);
        if let Some(warning) = warning.filter(|_| !self.is_warned) {
            warn(warning);
            self.is_warned = true;
        }
        told.iter_mut().try_for_each(|event| {
            if let Found::Trip(it) = &mut event.what {
                it.trip.date(self.reports.zero);
            }
            self.reports.say(event.time, event)
        })
    }
}

/// An event, and at what moment it happened, where that is known.
#[derive(Serialize)]
struct Dated<'a, E> {
    #[serde(flatten)]
    event: &'a E,
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<Moment>,
}

/// An event as a line.
pub fn line(event: &impl Serialize) -> String {
    serde_json::to_string(event).expect("an event can be written") + "\n"
}
