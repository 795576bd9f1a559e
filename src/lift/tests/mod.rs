//! Rides against closed forms, against integration by brute force, and their noise against theory.

mod accelerometer;
mod building;
mod course;
mod record;

use super::*;

const LIFT: Drive = Drive {
    speed: 1.0,
    acceleration: 0.6,
    jerk: 0.8,
};

fn trip(distance: f64, drive: Drive, ending: Ending) -> Trip {
    Trip {
        distance,
        drive,
        ending,
    }
}

fn drive(speed: f64, acceleration: f64, jerk: f64) -> Drive {
    Drive {
        speed,
        acceleration,
        jerk,
    }
}

fn two_trips() -> Ride {
    let up = trip(12.0, LIFT, Ending::Commanded);
    let jam = Ending::Jam {
        after: 7.3,
        within: 0.05,
    };
    let down = trip(-9.0, LIFT, jam);
    Ride::new(100.0, vec![5.003, 4.0, 3.0], vec![up, down]).unwrap()
}

#[test]
fn truth_tells_the_ride() {
    let ride = two_trips();
    let truth = ride.truth();
    let named: Vec<_> = truth
        .iter()
        .map(|s| (s.phase.name(), s.direction))
        .collect();
    let trip = |direction| {
        let phases = ["acceleration", "inertial", "braking"];
        phases.map(|phase| (phase, direction))
    };
    let expected = [
        &[("rest", 0)],
        &trip(1)[..],
        &[("rest", 0)],
        &trip(-1),
        &[("rest", 0)],
    ];
    assert_eq!(named, expected.concat());
    for pair in truth.windows(2) {
        assert_eq!(pair[0].to, pair[1].from);
    }
    let journeys = ride.journeys();
    assert_eq!(journeys[0].start, 5.003);
    assert!((journeys[0].distance - 12.0).abs() < 1e-12);
    assert_eq!((journeys[0].direction, journeys[0].jam()), (1, None));
    assert!((journeys[1].jam().unwrap() - journeys[1].start - 7.3).abs() < 1e-12);
    for (journey, trip) in journeys.iter().zip(truth.chunks(4)) {
        let ends = [journey.start, journey.uniform, journey.braking];
        let expected = [trip[0].to, trip[1].to, trip[2].to];
        for (end, expected) in ends.into_iter().zip(expected) {
            assert!((end - expected).abs() < 1e-12);
        }
    }
    assert!((journeys[1].stop - journeys[1].start - 7.35).abs() < 1e-12);
    assert!((ride.duration() - truth[truth.len() - 1].to).abs() < 1e-12);
}

#[test]
fn refusals() {
    let of = |trip: Trip| trip.course().unwrap_err().to_string();
    let commanded = |distance, drive| of(trip(distance, drive, Ending::Commanded));
    assert!(commanded(0.0, LIFT).contains("got 0"));
    assert!(commanded(f64::NAN, LIFT).contains("NaN"));
    assert!(commanded(1.0, drive(1.0, -1.0, 1.0)).contains("acceleration must be positive"));
    assert!(commanded(1.0, drive(1.0, 1.0, f64::INFINITY)).contains("jerk"));
    let jam = |distance, after, within| of(trip(distance, LIFT, Ending::Jam { after, within }));
    assert!(jam(1.0, 1.0, 0.1).contains("never moves uniformly"));
    assert!(jam(12.0, 1.0, 0.1).contains("2.417 to 12.000 s"));
    assert!(jam(12.0, 5.0, 0.0).contains("jam.within"));
    let up = trip(12.0, LIFT, Ending::Commanded);
    let new = |rate, rests: &[f64], trips: &[Trip]| {
        Ride::new(rate, rests.to_vec(), trips.to_vec()).unwrap_err()
    };
    assert!(matches!(new(0.0, &[1.0], &[]), RideError::Rate(0.0)));
    assert!(
        new(1.0, &[1.0], &[up])
            .to_string()
            .contains("1 trips need 2, got 1")
    );
    let rest = new(1.0, &[1.0, -1.0], &[up]);
    assert!(matches!(rest, RideError::Rest { number: 2, .. }));
    assert!(matches!(new(1.0, &[0.1], &[]), RideError::Length { .. }));
    assert!(matches!(new(1e6, &[1e6], &[]), RideError::Length { .. }));
    let nowhere = trip(0.0, LIFT, Ending::Commanded);
    let refused = new(1.0, &[1.0, 1.0, 1.0], &[up, nowhere]);
    assert!(matches!(refused, RideError::Trip { number: 2, .. }));
    let pickup = |change: fn(&mut Pickup)| {
        let mut pickup = Pickup::white(1.0);
        change(&mut pickup);
        pickup.checked().unwrap_err()
    };
    assert_eq!(pickup(|p| p.sigma = 0.0), PickupError::Sigma(0.0));
    assert!(matches!(
        pickup(|p| p.bias = f64::NAN),
        PickupError::Bias(_)
    ));
    assert_eq!(pickup(|p| p.cosine = 1.1), PickupError::Cosine(1.1));
    assert_eq!(pickup(|p| p.vibration = -1.0), PickupError::Vibration(-1.0));
}
