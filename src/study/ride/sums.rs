//! The sums of many trials.

use super::account::{Account, Trip};
use super::measure::Measure;
use super::point::RidePoint;
use super::table::Table;
use crate::counts::{Fixed, Shape, Sums, Values};
use crate::rule::{OutOfRange, Rule};
use std::ops::RangeInclusive;

/// The sums of the trials of a point.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct RideSums {
    /// Trials in which every trip was found.
    pub found: u64,
    /// Trials with a false motion.
    pub disturbed: u64,
    /// Trials with an alarm of their jam.
    pub alarmed: u64,
    /// Trials in which the monitor said `rest` in the first trip.
    pub misled: u64,
    /// Trials in which the monitor said `rest` when the rest after the first trip ended.
    pub knew_soon: u64,
    /// Trials in which the monitor said `rest` at the end.
    pub knew: u64,
    pub false_motions: u64,
    pub false_alarms: u64,
    /// Alarms of the rule at rest.
    pub rule_alarms: u64,
    /// Total time for which the cage stood, s.
    pub stood: Fixed,
    /// Delay of the start of every trip, s.
    pub start_delays: Values,
    pub stop_delays: Values,
    /// Delay of the alarm of every jam, s.
    pub alarm_delays: Values,
    /// Delay of the rule in every trip, s.
    pub rule_delays: Values,
}

impl RideSums {
    /// Adds a trial.
    pub fn add(&mut self, account: &Account) {
        let alarmed = |trip: &Trip| trip.alarm_delay.is_some_and(f64::is_finite);
        self.found += u64::from(account.trips.iter().all(|trip| trip.is_found));
        self.disturbed += u64::from(account.false_motions > 0);
        self.alarmed += u64::from(account.trips.iter().any(alarmed));
        self.misled += u64::from(account.misled);
        self.knew_soon += u64::from(account.knew_soon);
        self.knew += u64::from(account.knew);
        self.false_motions += account.false_motions;
        self.false_alarms += account.false_alarms;
        self.rule_alarms += account.rule_alarms;
        self.stood += Fixed::new(account.stood);
        for trip in &account.trips {
            self.start_delays.push(trip.start_delay);
            self.stop_delays.push(trip.stop_delay);
            self.rule_delays.push(trip.rule_delay);
            trip.alarm_delay
                .into_iter()
                .for_each(|delay| self.alarm_delays.push(delay));
        }
    }

    /// Six events, three counts without a limit, a time, and four lists of delays. A trip adds at most one
    /// delay to each list.
    pub fn shape(table: &Table) -> Shape {
        let trips = table.points.iter().map(|point| point.of.keys.trips).max();
        Shape {
            most: [vec![Some(1); 6], vec![None; 3]].concat(),
            lengths: 1,
            values: vec![trips.unwrap_or_default() as u64; 4],
        }
    }

    /// Checks that [`add`](Self::add) can produce these sums from so many trials of a point.
    ///
    /// # Errors
    /// If no accounts give these sums.
    pub fn check(&self, point: &RidePoint, trials: u64) -> Result<(), OutOfRange> {
        for (name, got, bounds) in self.bounds(point, trials) {
            if !bounds.contains(&got) {
                let rule = format_args!("lie in [{}, {}]", bounds.start(), bounds.end());
                return Err(OutOfRange::new(name, rule, got));
            }
        }
        let mut rest = 0.0;
        if point.measure.rides() {
            rest += (point.keys.trips + 1) as f64 * point.keys.rest[1];
        }
        if point.measure.rests() {
            rest += point.keys.length.get();
        }
        // Each rest is the difference of two rounded times. Its rounding error is below a microsecond.
        let rests = (point.keys.trips + 2) as f64;
        let longest = trials as f64 * (rest * (1.0 + 1e-9) + 1e-6 * rests);
        Rule::Within(0.0, longest, "s").check("stood", &self.stood.value())
    }

    /// Each number that is bounded by the trials or by another number, with its bounds.
    fn bounds(
        &self,
        point: &RidePoint,
        trials: u64,
    ) -> [(&'static str, u64, RangeInclusive<u64>); 10] {
        let trips = if point.measure.rides() {
            point.keys.trips as u64
        } else {
            0
        };
        let all = trials.saturating_mul(trips);
        // The last trip of each ride jams.
        let jams = if point.measure == Measure::Jam {
            trials
        } else {
            0
        };
        let delays = [
            &self.start_delays,
            &self.stop_delays,
            &self.alarm_delays,
            &self.rule_delays,
        ];
        let [starts, stops, alarms, rules] = delays.map(|delays| delays.count(|_| true));
        let [start, stop, alarm, _] = delays.map(|delays| delays.count(f64::is_finite));
        let is_none = |delay: f64| delay.is_nan() || delay == f64::NEG_INFINITY;
        let none = delays.iter().map(|delays| delays.count(is_none)).max();
        // A found ride has a finite delay for every start and stop. A ride without trips is always found.
        let told = start.min(stop).checked_div(trips);
        // Without a second trip, the rest after the first trip is the last rest.
        let soon = if trips < 2 {
            self.knew..=self.knew
        } else {
            0..=trials
        };
        let is_any = u64::from(self.false_motions > 0);
        [
            ("start_delays", starts, all..=all),
            ("stop_delays", stops, all..=all),
            ("alarm_delays", alarms, jams..=jams),
            ("rule_delays", rules, all..=all),
            ("delays that are none", none.unwrap_or_default(), 0..=0),
            (
                "found",
                self.found,
                told.map_or(trials..=trials, |told| 0..=told),
            ),
            ("alarmed", self.alarmed, alarm..=alarm),
            ("disturbed", self.disturbed, is_any..=self.false_motions),
            ("misled", self.misled, 0..=all),
            ("knew_soon", self.knew_soon, soon),
        ]
    }
}

impl From<RideSums> for Sums {
    fn from(sums: RideSums) -> Self {
        Self {
            counts: vec![
                sums.found,
                sums.disturbed,
                sums.alarmed,
                sums.misled,
                sums.knew_soon,
                sums.knew,
                sums.false_motions,
                sums.false_alarms,
                sums.rule_alarms,
            ],
            lengths: vec![sums.stood],
            values: vec![
                sums.start_delays,
                sums.stop_delays,
                sums.alarm_delays,
                sums.rule_delays,
            ],
        }
    }
}

impl From<Sums> for RideSums {
    /// Sums of [`RideSums::shape`].
    fn from(sums: Sums) -> Self {
        let counts = sums.counts;
        let mut values = sums.values.into_iter();
        let mut next = || values.next().unwrap_or_default();
        Self {
            found: counts[0],
            disturbed: counts[1],
            alarmed: counts[2],
            misled: counts[3],
            knew_soon: counts[4],
            knew: counts[5],
            false_motions: counts[6],
            false_alarms: counts[7],
            rule_alarms: counts[8],
            stood: sums.lengths[0],
            start_delays: next(),
            stop_delays: next(),
            alarm_delays: next(),
            rule_delays: next(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::account::{Seen, Truth};
    use super::*;
    use crate::monitor::{Alarm, Direction, Event, Kind, State};
    use crate::signal::Phase;
    use crate::study::parse;
    use proptest::prelude::*;

    type Change = fn(&mut RideSums);

    fn point(measure: &str, trips: usize) -> RidePoint {
        let trips = match measure {
            "rest" => String::new(),
            _ => format!("trips = {trips}\nrest = [4, 6]\n"),
        };
        let text = format!(
            "question = \"?\"\nseed = 1\ntrials = 4\n[ride]\nmeasure = \"{measure}\"\n{trips}\
             [ride.axis]\ndelta_over_sigma = [4]\n"
        );
        let experiment = parse("test", &text).unwrap();
        Table::parse(&experiment).unwrap().points[0].of.clone()
    }

    /// Events that a monitor might report, true or not, in a record that ends at `to`, s.
    fn events(said: &[(u8, f64, f64)], to: f64) -> Vec<Event> {
        let mut now = 0.0;
        let mut events = Vec::new();
        for &(what, gap, lag) in said {
            now += gap;
            let change = |state, direction| Kind::Change {
                state,
                direction,
                speed: None,
                reason: None,
                decision: None,
            };
            let kind = match what {
                0 => change(State::Known(Phase::Accelerating), Some(Direction::Up)),
                1 => change(State::Known(Phase::Accelerating), Some(Direction::Down)),
                2 | 3 => change(State::REST, None),
                4 => change(State::Unknown, None),
                _ => Kind::Alarm {
                    alarm: Alarm::Jam,
                    certain: true,
                },
            };
            events.push(Event {
                time: now - lag,
                reported: now,
                kind,
            });
        }
        events.retain(|event| event.reported <= to);
        events
    }

    fn account(point: &RidePoint, said: &[(u8, f64, f64)]) -> Account {
        let of = |ride: crate::lift::Ride| {
            let truth = Truth {
                journeys: ride.journeys(),
                to: ride.duration(),
            };
            let seen = Seen::of(events(said, truth.to));
            Account::new(&truth, &seen, point.keys.tolerance.get())
        };
        let mut account = Account::default();
        if point.measure.rides() {
            account.add(of(point.ride(|| 0.5).unwrap()));
        }
        if point.measure.rests() {
            account.add(of(point.still().unwrap()));
        }
        account
    }

    proptest! {
        /// The sums of any monitor are accepted. They are refused once any of them is changed to a value that
        /// no monitor can produce.
        #[test]
        fn what_can_be_counted(
            measure in proptest::sample::select(vec!["rides", "rest", "tradeoff", "jam", "switched_on"]),
            trips in 1..3usize,
            said in proptest::collection::vec(
                proptest::collection::vec((0..6u8, 0.0..6.0f64, 0.0..3.0f64), 0..16), 0..5,
            ),
        ) {
            let point = point(measure, trips);
            let trials = said.len() as u64;
            let mut sums = RideSums::default();
            said.iter().for_each(|said| sums.add(&account(&point, said)));
            let checked = sums.check(&point, trials);
            prop_assert!(checked.is_ok(), "{checked:?} {sums:?}");
            let changes: [(&str, Change); 13] = [
                ("start_delays", |sums| sums.start_delays.push(1.0)),
                ("stop_delays", |sums| sums.stop_delays.push(f64::INFINITY)),
                ("alarm_delays", |sums| sums.alarm_delays.push(1.0)),
                ("rule_delays", |sums| sums.rule_delays.push(1.0)),
                ("found", |sums| sums.found += 5),
                ("alarmed", |sums| sums.alarmed += 1),
                ("disturbed", |sums| sums.disturbed = sums.false_motions + 1),
                ("disturbed", |sums| (sums.disturbed, sums.false_motions) = (0, 7)),
                ("misled", |sums| sums.misled += 11),
                ("knew_soon", |sums| sums.knew_soon += 5),
                ("stood", |sums| sums.stood += Fixed::new(1e5)),
                ("stood", |sums| sums.stood += Fixed::new(-1e5)),
                ("delays", |sums| {
                    sums.start_delays.push(f64::NAN);
                    sums.stop_delays.push(1.0);
                }),
            ];
            for (name, change) in changes {
                let mut changed = sums.clone();
                change(&mut changed);
                prop_assert!(changed.check(&point, trials).is_err(), "{name} {changed:?}");
            }
        }
    }
}
