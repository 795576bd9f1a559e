//! Compares a monitor's reports with the truth.

use crate::lift::Journey;
use crate::monitor::{Alarm, Design, Direction, Event, Kind, State};
use crate::signal::Phase;

/// The true motion.
pub struct Truth {
    pub journeys: Vec<Journey>,
    /// When the record ends, s.
    pub to: f64,
}

/// What a monitor showed.
#[derive(Default)]
pub struct Seen {
    pub events: Vec<Event>,
    /// The end of each block at which the rule decided for motion, s.
    pub decided: Vec<f64>,
    /// For how long a motion is in the windows Y₁ and Y₂ of a decision, s.
    pub window: f64,
    /// Whether decisions that lie nearer than that share blocks, and count as one.
    pub shares: bool,
}

/// The result of a trial, or of several.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Account {
    pub trips: Vec<Trip>,
    /// Motions that the monitor reported while the cage stood, for a time when the cage stood.
    pub false_motions: u64,
    /// Jam alarms without a jam.
    pub false_alarms: u64,
    /// Alarms of the rule while the cage stood.
    pub rule_alarms: u64,
    /// How long the cage stood, s, and how long of that the monitor said `rest`.
    pub stood: f64,
    pub known: f64,
    /// Whether the monitor said `rest` in the first trip.
    pub misled: bool,
    /// Whether the monitor said `rest` when the rest after the first trip ended.
    pub knew_soon: bool,
    /// Whether the monitor said `rest` at the end.
    pub knew: bool,
}

/// The monitor's reports on one trip. Delays are in s; a missing report has an infinite delay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trip {
    /// Whether start, stop and direction are correct.
    pub is_found: bool,
    /// Time from the start to its report.
    pub start_delay: f64,
    /// Time from the stop to its report.
    pub stop_delay: f64,
    /// Time from the start to the rule's first alarm in the trip.
    pub rule_delay: f64,
    /// Time from the jam to its alarm, if the trip jammed.
    pub alarm_delay: Option<f64>,
}

/// A motion as the monitor reported it. Each pair holds the times of the event and of its report, in s.
struct Sighting {
    direction: Option<Direction>,
    start: (f64, f64),
    stop: Option<(f64, f64)>,
}

impl Sighting {
    /// Its direction was not told at first: takes that, and when it started.
    fn learn(&mut self, direction: Option<Direction>, start: Option<(f64, f64)>) {
        if self.direction.is_none() && direction.is_some() {
            self.direction = direction;
            self.start = start.unwrap_or(self.start);
        }
    }
}

impl Account {
    pub fn new(truth: &Truth, seen: &Seen, tolerance: f64) -> Self {
        let events = &seen.events;
        let sightings = sightings(events);
        let alarms: Vec<&Event> = (events.iter())
            .filter(|event| event.kind.alarm() == Some(Alarm::Jam))
            .collect();
        let said = Said::new(truth, events);
        let journeys = &truth.journeys;
        let belongs = |sighting: &&Sighting| {
            let (start, told) = sighting.start;
            let mut near = journeys.iter();
            near.any(|of| of.start - tolerance <= told && start <= of.stop + tolerance)
        };
        let is_of_a_jam = |alarm: &&&Event| {
            let mut near = journeys.iter();
            near.any(|journey| journey.is_told_by(alarm, tolerance))
        };
        let first = journeys.first();
        let second = journeys.get(1).map_or(truth.to, |second| second.start);
        Self {
            trips: (journeys.iter())
                .map(|journey| Trip {
                    rule_delay: seen.delay(journey),
                    ..Trip::new(journey, &sightings, &alarms, tolerance)
                })
                .collect(),
            rule_alarms: truth.rests().map(|rest| seen.alarms(rest)).sum(),
            false_motions: (sightings.len() - sightings.iter().filter(belongs).count()) as u64,
            false_alarms: (alarms.len() - alarms.iter().filter(is_of_a_jam).count()) as u64,
            stood: truth.rests().map(|(from, to)| to - from).sum(),
            known: truth
                .rests()
                .map(|(from, to)| said.rest_within(from, to))
                .sum(),
            misled: first.is_some_and(|first| said.rest_within(first.start, first.stop) > 0.0),
            knew_soon: said.rest_at(second),
            knew: said.rest_at(truth.to),
        }
    }

    /// Adds another part of the same trial.
    pub fn add(&mut self, other: Self) {
        self.trips.extend(other.trips);
        self.false_motions += other.false_motions;
        self.false_alarms += other.false_alarms;
        self.rule_alarms += other.rule_alarms;
        self.stood += other.stood;
        self.known += other.known;
        self.misled |= other.misled;
        self.knew_soon |= other.knew_soon;
        self.knew |= other.knew;
    }
}

impl Trip {
    fn new(journey: &Journey, sightings: &[Sighting], alarms: &[&Event], tolerance: f64) -> Self {
        let is_near = |a: f64, b: f64| (a - b).abs() <= tolerance;
        let direction = Some(Direction::of(f64::from(journey.direction)));
        let starts = |sighting: &&Sighting| {
            sighting.direction == direction && is_near(sighting.start.0, journey.start)
        };
        let stop = |sighting: &Sighting| {
            let (time, reported) = sighting.stop?;
            is_near(time, journey.stop).then_some(reported - journey.stop)
        };
        let start = sightings.iter().find(starts);
        let alarm = |jam: f64| {
            let mut alarms = alarms.iter();
            let alarm = alarms.find(|alarm| journey.is_told_by(alarm, tolerance));
            alarm.map_or(f64::INFINITY, |alarm| alarm.reported - jam)
        };
        Self {
            is_found: (sightings.iter().filter(starts)).any(|sighting| stop(sighting).is_some()),
            start_delay: start.map_or(f64::INFINITY, |sighting| sighting.start.1 - journey.start),
            stop_delay: sightings.iter().find_map(stop).unwrap_or(f64::INFINITY),
            alarm_delay: journey.jam().map(alarm),
            rule_delay: f64::INFINITY,
        }
    }
}

impl Journey {
    /// Whether the trip jammed and the alarm belongs to that jam: it was reported after the jam, for a time
    /// no later than the stop, within the tolerance.
    fn is_told_by(&self, alarm: &Event, tolerance: f64) -> bool {
        let told = |jam| jam <= alarm.reported && alarm.time <= self.stop + tolerance;
        self.jam().is_some_and(told)
    }
}

impl Seen {
    /// Of a monitor with this design, as yet nothing.
    pub fn by(design: &Design) -> Self {
        let samples = &design.samples;
        let blocks = samples.shift() + samples.gap() + samples.scale();
        Self {
            window: blocks as f64 * design.block,
            shares: design.ranks.is_none(),
            ..Self::default()
        }
    }

    /// By events alone.
    pub fn of(events: Vec<Event>) -> Self {
        Self {
            events,
            ..Self::default()
        }
    }

    /// From the start of a trip to the first decision for motion in it, s.
    fn delay(&self, journey: &Journey) -> f64 {
        let first = self.decided.partition_point(|time| *time < journey.start);
        let within = self
            .decided
            .get(first)
            .filter(|time| **time <= journey.stop);
        within.map_or(f64::INFINITY, |time| time - journey.start)
    }

    /// The decisions for motion in a rest, those that share blocks as one, without those that may see the motion before.
    fn alarms(&self, (from, to): (f64, f64)) -> u64 {
        let within = |time: &&f64| from + self.window < **time && **time <= to;
        let mut last = f64::NEG_INFINITY;
        let mut alarms = 0;
        for time in self.decided.iter().filter(within) {
            alarms += u64::from(!self.shares || time - last > self.window);
            last = *time;
        }
        alarms
    }
}

/// The reported motions, each from its start to the next rest. Doubt in between ends none: the rest says when it began.
fn sightings(events: &[Event]) -> Vec<Sighting> {
    let mut sightings: Vec<Sighting> = Vec::new();
    let mut moves = false;
    for event in events {
        let Kind::Change {
            state, direction, ..
        } = event.kind
        else {
            continue;
        };
        let told = (event.time, event.reported);
        match state {
            State::Known(phase) if phase.moves() => {
                let starts = phase == Phase::Accelerating;
                let goes_on = |last: &&mut Sighting| {
                    moves && (!starts || last.direction.is_none_or(|it| Some(it) == direction))
                };
                match sightings.last_mut().filter(goes_on) {
                    Some(last) => last.learn(direction, starts.then_some(told)),
                    None => sightings.push(Sighting {
                        direction,
                        start: told,
                        stop: None,
                    }),
                }
                moves = true;
            }
            State::REST => {
                if let Some(last) = sightings.last_mut().filter(|_| moves) {
                    last.stop = Some(told);
                }
                moves = false;
            }
            _ => {}
        }
    }
    sightings
}

impl Truth {
    /// The start and end of each time for which the cage stood, s.
    fn rests(&self) -> impl Iterator<Item = (f64, f64)> {
        let stops = self.journeys.iter().map(|journey| journey.stop);
        let starts = self.journeys.iter().map(|journey| journey.start);
        ([0.0].into_iter().chain(stops)).zip(starts.chain([self.to]))
    }
}

/// The start and end of each time for which the monitor said `rest`, s.
struct Said(Vec<(f64, f64)>);

impl Said {
    fn new(truth: &Truth, events: &[Event]) -> Self {
        let mut said: Vec<(f64, f64)> = Vec::new();
        let mut since = None;
        for event in events {
            let Kind::Change { state, .. } = event.kind else {
                continue;
            };
            match (state == State::REST, since) {
                (true, None) => since = Some(event.reported),
                (false, Some(from)) => {
                    said.push((from, event.reported));
                    since = None;
                }
                _ => {}
            }
        }
        said.extend(since.map(|from| (from, truth.to)));
        Self(said)
    }

    /// How long the monitor said `rest` between `from` and `to`, s.
    fn rest_within(&self, from: f64, to: f64) -> f64 {
        let shared = |&(start, end): &(f64, f64)| (end.min(to) - start.max(from)).max(0.0);
        self.0.iter().map(shared).sum()
    }

    fn rest_at(&self, time: f64) -> bool {
        self.0
            .iter()
            .any(|&(start, end)| start <= time && time <= end)
    }
}
