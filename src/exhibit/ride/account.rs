//! What a monitor reported, compared with the truth.

use crate::monitor::{Alarm, Direction, Event, Kind, State};
use crate::signal::{Journey, Phase};

/// What there was to see.
pub(super) struct Truth {
    pub journeys: Vec<Journey>,
    /// When the record ends, s.
    pub to: f64,
}

/// The outcome of a trial, or of a part of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Account {
    pub trips: Vec<TripOutcome>,
    /// Starts reported while the cage stood, of a time when it stood.
    pub false_motions: u64,
    /// Jam alarms without a jam.
    pub false_alarms: u64,
    /// For how long the cage stood and the monitor said so, s.
    pub at_rest: f64,
    /// Whether it said `rest` in the first trip.
    pub misled: bool,
    /// Whether it said `rest` when the rest after the first trip ended.
    pub knew_soon: bool,
    /// Whether it said so in the end.
    pub knew: bool,
}

/// What was said of one trip; delays in s, infinite where nothing was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TripOutcome {
    /// Start, stop and direction.
    pub is_found: bool,
    /// From the start to its report.
    pub start_delay: f64,
    /// From the stop.
    pub stop_delay: f64,
    /// From the jam to its alarm, where it jammed.
    pub alarm_delay: Option<f64>,
}

/// A motion as the monitor reported it: times in s, of the event and of its report.
struct Sighting {
    direction: Option<Direction>,
    start: (f64, f64),
    stop: Option<(f64, f64)>,
}

impl Account {
    pub fn new(truth: &Truth, events: &[Event], tolerance: f64) -> Self {
        let sightings = sightings(events);
        let alarms: Vec<&Event> = (events.iter())
            .filter(|event| event.kind == Kind::Alarm(Alarm::Jam))
            .collect();
        let said = Said::new(truth, events);
        let journeys = &truth.journeys;
        let belongs = |sighting: &&Sighting| {
            let (start, reported) = sighting.start;
            let mut near = journeys.iter();
            near.any(|of| of.start - tolerance <= reported && start <= of.stop + tolerance)
        };
        let is_of_a_jam = |alarm: &&&Event| {
            let mut near = journeys.iter();
            near.any(|journey| journey.is_reported_by(alarm, tolerance))
        };
        let first = journeys.first();
        let second = journeys.get(1).map_or(truth.to, |second| second.start);
        Self {
            trips: (journeys.iter())
                .map(|journey| TripOutcome::new(journey, &sightings, &alarms, tolerance))
                .collect(),
            false_motions: (sightings.len() - sightings.iter().filter(belongs).count()) as u64,
            false_alarms: (alarms.len() - alarms.iter().filter(is_of_a_jam).count()) as u64,
            at_rest: truth
                .rests()
                .map(|(from, to)| said.rest_within(from, to))
                .sum(),
            misled: first.is_some_and(|first| said.rest_within(first.start, first.stop) > 0.0),
            knew_soon: said.rest_at(second),
            knew: said.rest_at(truth.to),
        }
    }

    /// Another part of the same trial.
    pub fn add(&mut self, other: Self) {
        self.trips.extend(other.trips);
        self.false_motions += other.false_motions;
        self.false_alarms += other.false_alarms;
        self.at_rest += other.at_rest;
        self.misled |= other.misled;
        self.knew_soon |= other.knew_soon;
        self.knew |= other.knew;
    }
}

impl TripOutcome {
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
            let alarm = alarms.find(|alarm| journey.is_reported_by(alarm, tolerance));
            alarm.map_or(f64::INFINITY, |alarm| alarm.reported - jam)
        };
        Self {
            is_found: (sightings.iter().filter(starts)).any(|sighting| stop(sighting).is_some()),
            start_delay: start.map_or(f64::INFINITY, |sighting| sighting.start.1 - journey.start),
            stop_delay: sightings.iter().find_map(stop).unwrap_or(f64::INFINITY),
            alarm_delay: journey.jam().map(alarm),
        }
    }
}

impl TripOutcome {
    /// Whether it jammed and an alarm said so.
    pub fn is_alarmed(&self) -> bool {
        self.alarm_delay.is_some_and(f64::is_finite)
    }
}

impl Journey {
    /// Whether it jammed and an alarm is of that: reported since, of the jam or of what came before.
    fn is_reported_by(&self, alarm: &Event, tolerance: f64) -> bool {
        (self.jam()).is_some_and(|jam| jam <= alarm.reported && alarm.time <= self.stop + tolerance)
    }
}

/// Motions from their starts to the next rest; one that ends in doubt has no stop.
fn sightings(events: &[Event]) -> Vec<Sighting> {
    let mut sightings: Vec<Sighting> = Vec::new();
    let mut moves = false;
    for Event {
        time,
        reported,
        kind,
    } in events
    {
        let Kind::Change {
            state, direction, ..
        } = kind
        else {
            continue;
        };
        match *state {
            State::Known(Phase::Accelerating) => sightings.push(Sighting {
                direction: *direction,
                start: (*time, *reported),
                stop: None,
            }),
            State::REST if moves => {
                if let Some(last) = sightings.last_mut() {
                    last.stop = Some((*time, *reported));
                }
            }
            _ => {}
        }
        moves = state.moves();
    }
    sightings
}

impl Truth {
    /// From when to when the cage stood, s.
    fn rests(&self) -> impl Iterator<Item = (f64, f64)> {
        let stops = self.journeys.iter().map(|journey| journey.stop);
        let starts = self.journeys.iter().map(|journey| journey.start);
        ([0.0].into_iter().chain(stops)).zip(starts.chain([self.to]))
    }
}

/// From when to when the monitor said `rest`, s.
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

    /// For how long in a time, s.
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
