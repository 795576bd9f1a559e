//! Trips as they happen, of simulated lifts.

use crate::lift::{Drive, Ending, Pickup, Ride, Trip};
use crate::monitor::{Knowledge, Monitor, Settings, State};
use crate::recording::Sample;
use crate::track::floors::{self, Fault, Floors, Start};
use crate::track::{Found, Happened, Watch};

const RATE: f64 = 100.0;

/// What is told of a lift that makes these trips, m, among floors 4 m apart.
fn told(trips: &[f64]) -> (Vec<Happened>, Ride) {
    told_of(trips, |state| state, Some)
}

/// The same where the monitor says something else, and the clock tells another time, or nothing is recorded.
fn told_of(
    trips: &[f64],
    says: impl Fn(State) -> State,
    clock: impl Fn(f64) -> Option<f64>,
) -> (Vec<Happened>, Ride) {
    let drive = Drive {
        speed: 1.6,
        acceleration: 1.0,
        jerk: 1.5,
    };
    let trip = |distance: &f64| Trip {
        distance: *distance,
        drive,
        ending: Ending::Commanded,
    };
    let rests = vec![12.0; trips.len() + 1];
    let ride = Ride::new(RATE, rests, trips.iter().map(trip).collect()).unwrap();
    let record = ride.simulate(&Pickup::white(0.012), 5, 0).record;
    let heights = [0.0, 4.0, 8.0, 12.0];
    let settings = floors::Settings::default();
    let mut floors = Floors::given(settings, &heights, 0.01, Start::Floor(0)).unwrap();
    let design = Settings::default().at(RATE).unwrap();
    let knowledge = Knowledge {
        begins_at_rest: true,
        ..Knowledge::default()
    };
    let mut monitor = Monitor::new(design.clone(), knowledge);
    let mut watch = Watch::new(design, Some(true));
    let mut told = Vec::new();
    for (place, acceleration) in record.into_iter().enumerate() {
        let Some(time) = clock(place as f64 / RATE) else {
            continue;
        };
        let sample = Sample { time, acceleration };
        monitor.step(sample, None);
        let state = says(monitor.state());
        told.extend(watch.step(sample, state, monitor.quiet(), Some(&mut floors)));
    }
    told.extend(watch.end(Some(&mut floors)));
    (told, ride)
}

/// Every trip once, with its distance, its floor and its time, a few seconds after the stop; also where the monitor never
/// knows what the cage does.
#[test]
fn trips_are_told_as_they_happen() {
    let knows: fn(State) -> State = |state| state;
    for (says, most) in [(knows, 8.0), (|_| State::Unknown, 15.0)] {
        let (told, ride) = told_of(&[4.0, 8.0, -12.0, 4.0], says, Some);
        assert_eq!(floors_of(&told), [1, 3, 0, 1].map(Some), "{told:?}");
        assert_eq!(told.len(), 4, "{told:?}");
        for ((happened, journey), number) in told.iter().zip(ride.journeys()).zip(1..) {
            let Found::Trip(trip) = &happened.what else {
                panic!("{happened:?}");
            };
            let error = trip.distance.unwrap() - journey.distance;
            assert!(error.abs() < 0.1, "{trip:?}");
            assert_eq!(trip.trip.ride, number);
            assert!((happened.time - journey.stop).abs() < 0.5, "{happened:?}");
            assert!(happened.reported - journey.stop < most, "{happened:?}");
        }
    }
}

/// A minute of uniform motion is as quiet as rest: nothing is told before the stop, whatever the monitor knows.
#[test]
fn uniform_motion_is_not_over() {
    let (told, ride) = told_of(&[100.0, 4.0], |_| State::Unknown, Some);
    assert_eq!(floors_of(&told).len(), 2, "{told:?}");
    let is_trip = |it: &&Happened| matches!(it.what, Found::Trip(_));
    for (happened, journey) in told.iter().filter(is_trip).zip(ride.journeys()) {
        assert!(happened.reported > journey.stop, "{happened:?}");
        assert!(happened.reported - journey.stop < 20.0, "{happened:?}");
    }
}

#[test]
fn a_stop_between_floors_is_an_alarm() {
    let (told, _) = told(&[4.0, 2.0, 2.0]);
    let alarms: Vec<_> = told
        .iter()
        .filter_map(|it| match it.what {
            Found::Alarm { alarm, .. } => Some((alarm, it.time)),
            _ => None,
        })
        .collect();
    assert_eq!(alarms.len(), 1, "{told:?}");
    assert_eq!(alarms[0].0, Fault::BetweenFloors);
    let json = serde_json::to_string(&told).unwrap();
    assert!(json.contains("\"alarm\":\"between_floors\""), "{json}");
}

fn floors_of(told: &[Happened]) -> Vec<Option<usize>> {
    let trips = told.iter().filter_map(|it| match &it.what {
        Found::Trip(trip) => Some(trip.landing.and_then(|landing| landing.floor)),
        _ => None,
    });
    trips.collect()
}

/// A hole that takes the stop: that trip is told without it, and none is lost, nor taken for another.
#[test]
fn a_hole_at_a_stop_loses_no_trip() {
    let trips = [4.0, 8.0, -12.0, 4.0];
    let (_, ride) = told(&trips);
    let stop = ride.journeys()[1].stop;
    for length in [0.5, 1.0, 3.0] {
        let hole = |time: f64| (time < stop - 0.2 || time > stop - 0.2 + length).then_some(time);
        let (told, _) = told_of(&trips, |state| state, hole);
        let is_alarm = |it: &Happened| matches!(it.what, Found::Alarm { .. });
        assert_eq!(floors_of(&told).len(), 4, "{length}: {told:?}");
        assert!(!told.iter().any(is_alarm), "{length}: {told:?}");
    }
}

/// A hole, or a clock that is set back, just after a stop: the trip before it is told, and of the floor nothing is taken
/// for known: no alarm where the car went on unseen.
#[test]
fn what_is_cut_off_is_told_first() {
    let trips = [4.0, 4.0, -8.0];
    let (_, ride) = told(&trips);
    let stop = ride.journeys()[0].stop;
    let next = ride.journeys()[1].stop;
    let hole = |time: f64| (time < stop + 1.5 || time > next + 3.0).then_some(time);
    let (told, _) = told_of(&trips, |state| state, hole);
    assert_eq!(floors_of(&told).len(), 2, "{told:?}");
    assert_eq!(floors_of(&told)[0], Some(1));
    assert!(
        !told.iter().any(|it| matches!(it.what, Found::Alarm { .. })),
        "{told:?}"
    );
    let back = |time: f64| Some(if time < stop + 1.5 { time } else { time - 5.0 });
    let (told, _) = told_of(&trips, |state| state, back);
    assert_eq!(floors_of(&told).len(), 3, "{told:?}");
}

/// Rests too short to be called rest: every trip is told, at the latest when the stretch is as long as may be.
#[test]
fn a_long_stretch_loses_no_trip() {
    let drive = Drive {
        speed: 1.6,
        acceleration: 1.0,
        jerk: 1.5,
    };
    let trip = |place: usize| Trip {
        distance: if place.is_multiple_of(2) { 4.0 } else { -4.0 },
        drive,
        ending: Ending::Commanded,
    };
    let mut rests = vec![2.0; 181];
    rests[0] = 10.0;
    let ride = Ride::new(RATE, rests, (0..180).map(trip).collect()).unwrap();
    let record = ride.simulate(&Pickup::white(0.012), 5, 0).record;
    let design = Settings::default().at(RATE).unwrap();
    let mut watch = Watch::new(design, Some(true));
    let mut told = Vec::new();
    for (place, acceleration) in record.into_iter().enumerate() {
        let time = place as f64 / RATE;
        let state = if time < 9.0 {
            State::REST
        } else {
            State::Unknown
        };
        told.extend(watch.step(Sample { time, acceleration }, state, 0.0, None));
    }
    told.extend(watch.end(None));
    let decided = |it: &&Happened| matches!(it.what, Found::Trip(_));
    let (trips, others) = (told.iter().filter(decided).count(), told.len());
    assert!(trips >= 178 && others >= 180, "{trips} {others}");
}
