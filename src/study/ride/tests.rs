//! Tests of accounts on hand-made events, and of whole studies on several threads.

use super::account::{Account, Seen, Truth};
use super::estimate::of;
use super::measure::Measure;
use super::sums::RideSums;
use super::{Row, Table};
use crate::lift::Journey;
use crate::monitor::{Alarm, DecisionRule, Direction, Event, Kind, Settings, State};
use crate::signal::Phase;
use crate::study::kind::Study;
use crate::study::outcomes::Of;
use crate::study::tests::{UP, read, rows};

/// One trip up from 10 to 20 s and one down from 30 s that jams at 35 s, in a record of 60 s.
fn truth() -> Truth {
    let up = UP;
    let down = Journey {
        start: 30.0,
        uniform: 32.0,
        braking: 35.0,
        stop: 35.1,
        direction: -1,
        jammed: true,
        ..up
    };
    Truth {
        journeys: vec![up, down],
        to: 60.0,
    }
}

fn change(time: f64, reported: f64, state: State, direction: Option<Direction>) -> Event {
    let kind = Kind::Change {
        state,
        direction,
        speed: None,
        reason: None,
        decision: None,
    };
    Event {
        time,
        reported,
        kind,
    }
}

fn rest(time: f64, reported: f64) -> Event {
    change(time, reported, State::REST, None)
}

fn start(time: f64, reported: f64, direction: Direction) -> Event {
    let state = State::Known(Phase::Accelerating);
    change(time, reported, state, Some(direction))
}

fn alarm(time: f64, reported: f64) -> Event {
    Event {
        time,
        reported,
        kind: Kind::Alarm {
            alarm: Alarm::Jam,
            certain: true,
        },
    }
}

/// The reports of a monitor that makes no mistake.
fn said() -> Vec<Event> {
    vec![
        rest(2.0, 5.0),
        start(10.2, 11.0, Direction::Up),
        change(
            12.0,
            12.5,
            State::Known(Phase::Inertial),
            Some(Direction::Up),
        ),
        rest(19.9, 21.5),
        start(30.4, 31.0, Direction::Down),
        alarm(35.05, 36.0),
        rest(35.2, 36.0),
    ]
}

fn account(events: &[Event]) -> Account {
    Account::new(&truth(), &Seen::of(events.to_vec()), 0.5)
}

/// Alarms of the rule: none while the motion before is in the windows, which are as long in seconds at any rate; ranks
/// share no blocks.
#[test]
fn alarms_of_the_rule_are_counted_at_rest() {
    for (rate, rule, expected) in [
        (100.0, DecisionRule::ThreeSample, 2),
        (200.0, DecisionRule::ThreeSample, 2),
        (100.0, DecisionRule::Sequential, 3),
    ] {
        let mut settings = Settings::default();
        settings.detector.rule = rule;
        let truth = truth();
        let stop = truth.journeys[0].stop;
        let seen = Seen {
            // In the motion, in its windows, behind them, near that, and far from it.
            decided: [-1.0, 0.8, 1.3, 2.0, 4.0]
                .map(|after| stop + after)
                .to_vec(),
            ..Seen::by(&settings.at(rate).unwrap())
        };
        assert!((seen.window - 1.2).abs() < 1e-12, "{}", seen.window);
        let account = Account::new(&truth, &seen, 0.5);
        assert_eq!(account.rule_alarms, expected, "{rate} Hz, {rule}");
        let delay = stop - 1.0 - truth.journeys[0].start;
        assert!((account.trips[0].rule_delay - delay).abs() < 1e-9);
        assert_eq!(account.trips[1].rule_delay, f64::INFINITY);
    }
}

#[test]
fn all_is_found_and_timed() {
    let account = account(&said());
    let [up, down] = account.trips[..] else {
        panic!("two trips");
    };
    assert!(up.is_found && down.is_found);
    assert_eq!(
        (up.start_delay, up.stop_delay, up.alarm_delay),
        (1.0, 1.5, None)
    );
    assert_eq!((down.start_delay, down.alarm_delay), (1.0, Some(1.0)));
    assert_eq!((account.false_motions, account.false_alarms), (0, 0));
    // The shared times are 5 to 10 s, 21.5 to 30 s and 36 to 60 s. Only times when the cage stood and
    // the monitor said `rest` count.
    assert!((account.known - (5.0 + 8.5 + 24.0)).abs() < 1e-12);
    // From 10 to 11 s the cage moved and was still said to rest.
    assert!(account.misled && account.knew_soon && account.knew);
}

/// A trip is lost if its direction is wrong, its start is reported for too late a time, or its end is
/// in doubt.
#[test]
fn what_is_not_found() {
    let with = |index: usize, event: Event| {
        let mut events = said();
        events[index] = event;
        account(&events).trips[0]
    };
    assert!(!with(1, start(10.2, 11.0, Direction::Down)).is_found);
    assert!(with(1, start(10.5, 11.0, Direction::Up)).is_found);
    let late = with(1, start(10.6, 11.0, Direction::Up));
    assert!(!late.is_found && late.start_delay == f64::INFINITY && late.stop_delay == 1.5);
    let doubtful = with(3, change(19.9, 21.5, State::Unknown, None));
    assert!(!doubtful.is_found && doubtful.start_delay == 1.0);
    assert_eq!(doubtful.stop_delay, f64::INFINITY);
    // A rest that follows doubt says when the motion before it ended, if it ended then.
    let mut events = said();
    events.insert(3, change(14.0, 15.0, State::Unknown, None));
    assert!(account(&events).trips[0].is_found);
    events[4] = rest(14.0, 21.5);
    assert!(!account(&events).trips[0].is_found);
}

/// A start without a motion is false. A start that is only reported for a wrong time is not false.
/// The same holds for alarms.
#[test]
fn what_is_false() {
    let among = |more: &[Event]| {
        let mut events = [&said(), more].concat();
        events.sort_by(|a, b| a.reported.total_cmp(&b.reported));
        account(&events)
    };
    let false_start = [start(24.0, 25.0, Direction::Up), rest(25.5, 26.0)];
    let disturbed = among(&false_start);
    assert_eq!(disturbed.false_motions, 1);
    assert!((disturbed.known - 36.5).abs() < 1e-12);
    assert_eq!(disturbed.stood, account(&[]).stood);
    assert_eq!(among(&[start(9.0, 10.5, Direction::Up)]).false_motions, 0);
    assert_eq!(among(&[start(8.0, 9.0, Direction::Up)]).false_motions, 1);
    assert_eq!(among(&[alarm(15.0, 16.0)]).false_alarms, 1);
    // An alarm for a wrong time still belongs to the jam. An alarm before the jam does not, nor does one
    // for a time long after it.
    assert_eq!(among(&[alarm(34.0, 36.5)]).false_alarms, 0);
    assert_eq!(among(&[alarm(34.0, 34.5)]).false_alarms, 1);
    assert_eq!(among(&[alarm(45.0, 46.0)]).false_alarms, 1);
    assert_eq!(account(&[]).trips[1].alarm_delay, Some(f64::INFINITY));
    assert!(!account(&[]).knew && !account(&[]).misled);
}

/// One of four trips is never reported. A quantile above three quarters is infinite, one below is not.
#[test]
fn what_is_never_told_takes_for_ever() {
    let mut silent = said();
    silent.remove(1);
    let mut sums = RideSums::default();
    [said(), silent]
        .iter()
        .for_each(|events| sums.add(&account(events)));
    let estimates = of(Measure::Rides, &sums, 2, 0.5);
    let value = |outcome: &str| {
        let estimate = estimates
            .iter()
            .find(|estimate| estimate.outcome == outcome);
        let estimate = estimate.unwrap();
        (estimate.count, estimate.exposure, estimate.value)
    };
    assert_eq!(value("found"), (1, 2.0, 0.5));
    assert_eq!(value("start_delay_50"), (3, 4.0, 1.0));
    assert_eq!(value("start_delay_95"), (3, 4.0, f64::INFINITY));
}

/// Of each point.
const TRIALS: u64 = 4;

/// The study of a config, and its rows.
fn study(text: &str) -> (Of<Table>, Vec<Row>) {
    let study: Of<Table> = read(&format!(
        "question = \"?\"\nseed = 5\ntrials = {TRIALS}\n{text}"
    ));
    let rows = rows(&study, TRIALS);
    (study, rows)
}

const RIDES: &str = "[ride]\nmeasure = \"rides\"\n[ride.axis]\ndelta_over_sigma = [1, 16]\n\
    [[ride.curve]]\nlabel = \"50 Hz\"\nrate = 50\n[[ride.curve]]\nlabel = \"100 Hz\"\n";

#[test]
fn threads_leave_no_trace() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| study(RIDES).1)
    };
    assert_eq!(on(1), on(3));
}

/// Quiet rides are found and quiet rests stay quiet, by name.
#[test]
fn quantities_by_name() {
    let (study, rows) = study(RIDES);
    let quantities = study.quantities(&rows).unwrap();
    let value = |name: &str| {
        let quantity = quantities.iter().find(|quantity| quantity.name == name);
        quantity.unwrap_or_else(|| panic!("no {name}")).value
    };
    assert_eq!(value("found_100_hz_at_16"), 1.0);
    assert_eq!(value("false_motions_50_hz_at_16"), 0.0);
    let delay = value("start_delay_50_100_hz_at_16");
    assert!((0.5..1.5).contains(&delay), "{delay}");
}

/// A monitor that is switched on in a motion that shows is not misled. One that
/// wrongly assumes that the record begins at rest takes smooth motion for rest.
#[test]
fn switched_on() {
    let (_, rows) = study(
        "[ride]\nmeasure = \"switched_on\"\nlearnt = true\n[ride.axis]\nvibration = [0, 30]\n\
         [[ride.curve]]\nlabel = \"shows\"\nmotion_shows = true\n\
         [[ride.curve]]\nlabel = \"wrong\"\nbegins_at_rest = true\n",
    );
    let value = |label: &str, x: f64, outcome: &str| {
        let mut rows = rows.iter();
        let row = rows.find(|row| (&row.label[..], row.x, &row.outcome[..]) == (label, x, outcome));
        row.unwrap().estimate
    };
    assert_eq!(value("shows", 30.0, "misled"), 0.0);
    assert_eq!(value("wrong", 0.0, "misled"), 1.0);
}
