//! `liftsim monitor`: watches a lift, sample by sample, from standard input.

use super::watch::{Told, Watch, check_strength};
use super::{Failure, Outcome};
use anyhow::{Context, anyhow};
use clap::{Args, ValueEnum};
use liftsim::monitor::{Briefing, Event, Knowledge, Monitor};
use liftsim::signal::recording::{LineError, LineReader, LineReading, Sample};
use std::io::{self, BufReader, Write};
use std::process::ExitCode;

/// Watch a lift: samples come in on standard input, changes of state go out, as they happen.
///
/// A line is `acceleration` or `time,acceleration`, in m/s^2, up positive, and s. A header and lines that begin
/// with # are passed over. What goes out is one JSON object a line: the state at first, and every change of it,
/// with when it happened (time), when that was known (reported) and the decision that made it known; and alarms.
///
/// States are unknown, rest, accelerating, inertial, braking. A cage that moves smoothly looks like one that
/// stands, so a monitor that was switched on in between says unknown until it knows better: until the
/// direction of motion has turned, or at once if you say that the cage stands (--begins rest).
///
/// The alarm `jam` says that a motion ended in a violent pulse, without the braking of a commanded stop;
/// `slack`, with --expected-moving, that the cage stands while the drum pays out rope.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    liftsim detect ride.csv --save-state lift.json\n  \
    sensor | liftsim monitor --state lift.json\n  \
    sensor | liftsim monitor --rate 100 --begins rest\n  \
    paste -d, sensor.txt drum.txt | liftsim monitor --rate 100 --expected-moving")]
pub struct MonitorCommand {
    /// Samples per second; measured from the first of them where they have times.
    #[arg(long, value_name = "HZ")]
    rate: Option<f64>,
    /// What is known of the cage as the samples begin [default: what the saved state says, else unknown].
    #[arg(long, value_name = "STATE", value_enum)]
    begins: Option<Beginning>,
    /// Each line ends with one more number: 1 while the drum turns, else 0.
    #[arg(long)]
    expected_moving: bool,
    /// Pass over lines that cannot be read, with a warning, instead of ending.
    #[arg(long)]
    keep_going: bool,
    #[command(flatten)]
    watch: Watch,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Beginning {
    /// It stands.
    Rest,
    /// It may be moving.
    Unknown,
}

/// Readings from which a rate is measured.
const MEASURED: usize = 100;

/// s, in size: no clock is later, and a double still tells milliseconds apart.
const LATEST: f64 = 1e12;

/// A sample, and whether the drum turns.
type Reading = (Sample, Option<bool>);

impl MonitorCommand {
    /// Runs the command.
    pub fn run(self) -> Outcome {
        let Told { config, briefing } = self.watch.told()?;
        let input = BufReader::with_capacity(1 << 16, io::stdin().lock());
        let mut readings = Readings {
            lines: match self.expected_moving {
                true => LineReader::with_drum(input),
                false => LineReader::new(input),
            },
            interval: None,
            last: None,
            count: 0,
            keeps_going: self.keep_going,
        };
        let known_rate = self
            .rate
            .or(briefing.as_ref().map(|briefing| briefing.rate));
        let (first, rate) = readings.begin(known_rate)?;
        let mut briefing = briefing.unwrap_or(Briefing {
            settings: config.settings,
            rate,
            knowledge: Knowledge::default(),
        });
        briefing.rate = rate;
        if let Some(begins) = self.begins {
            briefing.knowledge.begins_at_rest = begins == Beginning::Rest;
        } else if briefing.knowledge.begins_at_rest {
            eprintln!(
                "note: the saved state says that the cage stands as the samples begin (--begins unknown if it may not)"
            );
        }
        let design = match known_rate {
            Some(_) => briefing.design().map_err(Failure::input)?,
            None => (briefing
                .design()
                .context("standard input, whose times must be in s"))
            .map_err(Failure::Input)?,
        };
        let mut monitor = Monitor::new(design, briefing.knowledge);
        let mut out = Reports::new();
        if let Some((sample, _)) = first.first() {
            out.say(&monitor.beginning(sample.time))?;
        }
        let mut watch = |(sample, drum_turns): Reading| {
            let mut events = monitor.step(sample, drum_turns).iter();
            events.try_for_each(|event| out.say(event))
        };
        let watched = first.into_iter().try_for_each(&mut watch).and_then(|()| {
            while let Some(reading) = readings.next()? {
                watch(reading)?;
            }
            Ok(())
        });
        match watched {
            Err(Stop::Closed) => Ok(ExitCode::SUCCESS),
            Err(Stop::Failed(failure)) => Err(failure),
            Ok(()) => Ok(ExitCode::SUCCESS),
        }
    }
}

/// Why watching ends before the input does.
enum Stop {
    /// Nobody reads what is said.
    Closed,
    Failed(Failure),
}

impl From<Failure> for Stop {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

impl From<Stop> for Failure {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Failed(failure) => failure,
            Stop::Closed => Self::Run(anyhow!("standard output is closed")),
        }
    }
}

/// Samples from standard input.
struct Readings<R> {
    lines: LineReader<R>,
    /// Seconds between samples without times of their own.
    interval: Option<f64>,
    last: Option<f64>,
    count: u64,
    keeps_going: bool,
}

impl<R: io::BufRead> Readings<R> {
    /// The first readings, and the rate, measured or as known.
    fn begin(&mut self, known: Option<f64>) -> Result<(Vec<Reading>, f64), Failure> {
        self.interval = known.map(|rate| 1.0 / rate);
        let mut first: Vec<Reading> = Vec::new();
        while first.len() < MEASURED {
            match self.next()? {
                Some(reading) => first.push(reading),
                None => break,
            }
            if self.last.is_none() {
                break;
            }
        }
        if first.is_empty() {
            return Err(Failure::Input(anyhow!(
                "standard input: holds no reading (does the sensor send anything?)"
            )));
        }
        let mut intervals: Vec<f64> = (first.windows(2))
            .map(|pair| pair[1].0.time - pair[0].0.time)
            .collect();
        intervals.sort_by(f64::total_cmp);
        let measured = intervals
            .get(intervals.len() / 2)
            .map(|median| 1.0 / median);
        match (known, measured) {
            (None, None) => Err(Failure::Input(anyhow!(
                "standard input: the rate is measured from two readings or more, got {} (give --rate)",
                first.len()
            ))),
            (Some(known), measured) => {
                if let Some(measured) =
                    measured.filter(|measured| (measured / known - 1.0).abs() > 0.05)
                {
                    self.warn(&format!(
                        "samples come at {measured:.1} Hz, not at {known:.1} Hz"
                    ));
                }
                Ok((first, known))
            }
            (None, Some(measured)) => Ok((first, measured)),
        }
    }

    fn next(&mut self) -> Result<Option<Reading>, Failure> {
        loop {
            let refusal = match self.lines.next() {
                Ok(None) => return Ok(None),
                Ok(Some(reading)) => match self.timed(&reading) {
                    Ok(sample) => return Ok(Some((sample, reading.drum_turns))),
                    Err(refusal) => refusal,
                },
                Err(error @ LineError::Io { .. }) => return Err(Failure::run(error)),
                Err(error) => anyhow::Error::from(error),
            };
            if !self.keeps_going {
                return Err(refusal)
                    .context("standard input")
                    .map_err(Failure::Input);
            }
            self.warn(&format!("{refusal:#} (passed over)"));
        }
    }

    /// A reading at its time, which must be later than that of the one before.
    #[inline]
    fn timed(&mut self, reading: &LineReading) -> Result<Sample, anyhow::Error> {
        let acceleration = reading.acceleration;
        let line = self.lines.number();
        check_strength(acceleration).with_context(|| format!("line {line}"))?;
        let Some(time) = reading.time else {
            let Some(interval) = self.interval else {
                return Err(anyhow!("samples without times need a rate (give --rate)"));
            };
            self.count += 1;
            return Ok(Sample {
                time: (self.count - 1) as f64 * interval,
                acceleration,
            });
        };
        match self.last {
            _ if time.abs() > LATEST => Err(anyhow!(
                "line {line}: times must lie within {LATEST:e} s, got {time:e} (are they counted in s?)"
            )),
            Some(last) if time <= last => Err(anyhow!(
                "line {line}: time must increase, got {time} s after {last} s (are lines out of order or \
                 repeated, or is a comma the decimal mark?)"
            )),
            _ => {
                self.last = Some(time);
                Ok(Sample { time, acceleration })
            }
        }
    }

    fn warn(&self, words: &str) {
        eprintln!("warning: {words}");
    }
}

/// Standard output, a line at a time.
struct Reports(io::StdoutLock<'static>);

impl Reports {
    fn new() -> Self {
        Self(io::stdout().lock())
    }

    fn say(&mut self, event: &Event) -> Result<(), Stop> {
        let line = serde_json::to_string(event).expect("an event can be written") + "\n";
        match self
            .0
            .write_all(line.as_bytes())
            .and_then(|()| self.0.flush())
        {
            Ok(()) => Ok(()),
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Err(Stop::Closed),
            Err(error) => Err(Stop::Failed(Failure::run(
                anyhow::Error::from(error).context("standard output"),
            ))),
        }
    }
}
