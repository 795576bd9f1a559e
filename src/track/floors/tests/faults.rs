//! What alarms are called, and floors that the sweep missed.

use super::world::{LEVEL, MENDED, PRINTED, even_building, variance};
use crate::track::floors::{Fault, Floors, Settings, Start};

/// The floors 0 to 3, 3 m apart, and the car at one of them.
fn building(start: usize) -> Floors {
    let start = Start::Floor(start);
    Floors::given(MENDED, &[0.0, 3.0, 6.0, 9.0], 0.001, start).unwrap()
}

/// The fault at once of one stop, with the offset from the nearest floor.
fn fault(start: usize, distance: f64) -> (Option<Fault>, usize, f64) {
    let judgement = building(start).step(distance, variance(distance)).judgement;
    let judgement = judgement.unwrap();
    (judgement.fault, judgement.floor, judgement.offset)
}

#[test]
fn faults_have_names() {
    let cases = [
        (1, 3.01, None, 2),
        (1, 3.1, Some(Fault::MisLevelling), 2),
        (1, -2.9, Some(Fault::MisLevelling), 0),
        (1, -3.1, Some(Fault::MisLevelling), 0),
        (1, -3.5, Some(Fault::Pit), 0),
        (2, 3.4, Some(Fault::Overrun), 3),
        (2, 2.6, Some(Fault::BetweenFloors), 3),
        (1, 4.4, Some(Fault::BetweenFloors), 2),
    ];
    for (start, distance, expected, floor) in cases {
        let (fault, nearest, offset) = fault(start, distance);
        assert_eq!((fault, nearest), (expected, floor), "{start} {distance}");
        let height = 3.0 * (start as f64 - floor as f64) + distance;
        assert!((offset - height).abs() < 1e-9);
    }
}

/// After the alarm the car goes on; the stop is judged again by both trips, with a smaller ±, and the next stops are
/// right.
#[test]
fn an_alarm_is_confirmed_by_the_next_stop() {
    let mut floors = building(0);
    let stop = floors.step(9.08, variance(9.0));
    let first = stop.judgement.unwrap();
    assert_eq!((first.fault, stop.floor), (Some(Fault::MisLevelling), None));
    let next = floors.step(-3.08, variance(3.0));
    let again = next.earlier.unwrap();
    assert_eq!((next.floor, next.judgement.unwrap().fault), (Some(2), None));
    assert_eq!((again.fault, again.floor), (Some(Fault::MisLevelling), 3));
    assert!((again.offset - 0.08).abs() < 0.005, "{again:?}");
    assert!(
        again.deviation < 0.5 * first.deviation,
        "{again:?} {first:?}"
    );
}

/// The car runs past either end of the shaft, how far does not matter, and goes on from there: it is alarmed, and every
/// later stop is at its floor.
#[test]
fn a_car_beyond_the_shaft_is_not_lost() {
    let heights = [0.0, 4.2, 7.4, 10.6, 13.8, 17.0];
    for off in [0.3, 0.6, 0.95, 1.05, 1.2, 1.5, 2.0, 2.7] {
        for (fault, end, next) in [(Fault::Overrun, 17.0 + off, 2), (Fault::Pit, -off, 3)] {
            let mut floors = Floors::given(MENDED, &heights, 0.001, Start::Floor(1)).unwrap();
            let mut at = heights[1];
            let mut go = |to: f64| {
                let distance = to - at;
                at = to;
                floors.step(distance, variance(distance))
            };
            for floor in [2, 4, 3] {
                assert_eq!(go(heights[floor]).floor, Some(floor));
            }
            let stop = go(end);
            let judged = stop.judgement.unwrap();
            assert!((stop.position - end).abs() < 0.1, "{off}: {stop:?}");
            assert_eq!((judged.fault, stop.floor), (Some(fault), None), "{off}");
            for floor in [next, 4, 1, 5, 0] {
                let stop = go(heights[floor]);
                assert_eq!(stop.floor, Some(floor), "{fault:?} {off}: {stop:?}");
                assert!(stop.probability > 0.9, "{fault:?} {off}: {stop:?}");
            }
        }
    }
}

/// An alarm, but the trip was wrong and not the stop: it is withdrawn, whether the next trip is long or short,
/// and the printed rule alarms again.
#[test]
fn an_alarm_is_withdrawn_by_the_next_stop() {
    let alarms = |settings: Settings, next: f64| {
        let heights = [0.0, 3.0, 6.0, 9.0];
        let mut floors = Floors::given(settings, &heights, 0.001, Start::Floor(0)).unwrap();
        let first = floors.step(9.067, variance(9.0)).judgement.unwrap();
        assert!(first.fault.is_some(), "{first:?}");
        let stop = floors.step(next, variance(next));
        (stop.judgement.unwrap().fault.is_some(), stop.earlier)
    };
    for next in [-6.0, -3.0] {
        let (is_alarm, earlier) = alarms(MENDED, next);
        assert!(!is_alarm, "{next}");
        assert!(earlier.unwrap().fault.is_none(), "{next} {earlier:?}");
        assert_eq!(alarms(PRINTED, next), (true, None));
    }
}

/// A floor left out of the sweep alarms three times, then it is one, with an honest deviation.
#[test]
fn a_floor_left_out_is_added() {
    let mut squares = 0.0;
    let buildings = 60;
    for seed in 0..buildings {
        let mut world = even_building(seed);
        let mut floors = Floors::unknown(MENDED).unwrap();
        for floor in (1..10).filter(|floor| *floor != 6) {
            world.stop(&mut floors, floor, 0.0);
        }
        let mut alarms = 0;
        let added = (0..400).find_map(|_| {
            let stop = world.ride(&mut floors);
            let fault = stop.judgement.unwrap().fault;
            let is_between = fault == Some(Fault::BetweenFloors);
            alarms += usize::from(is_between);
            assert_eq!(
                is_between,
                world.at == 6 && stop.added.is_none(),
                "{stop:?}"
            );
            stop.added
        });
        assert_eq!((added, alarms), (Some(6), 3));
        let floor = floors.floors()[6];
        let error = floor.height - (world.heights[6] - world.heights[0]);
        squares += (error / floor.deviation).powi(2);
        let wrong = (0..100).filter(|_| {
            let stop = world.ride(&mut floors);
            stop.floor.is_some_and(|floor| floor != world.at)
        });
        assert_eq!(wrong.count(), 0);
        assert!(floors.floors()[6].deviation < 0.01);
    }
    // χ² with 60 degrees of freedom exceeds 133 with a probability of 1e-7. The three stops share the map's
    // error, which the mean takes for independent: the sum may be a little larger than its degrees.
    println!("{squares} of {buildings}");
    assert!(squares < 133.0);
}

/// A stop that is off by less than a storey stays an alarm, however often.
#[test]
fn a_floor_out_of_level_is_no_new_floor() {
    let mut world = even_building(1);
    let mut floors = world.settled(MENDED, 200);
    for _ in 0..20 {
        let stop = world.stop(&mut floors, 3, 0.3);
        assert_eq!(stop.judgement.unwrap().fault, Some(Fault::BetweenFloors));
        assert_eq!(world.stop(&mut floors, 4, 0.0).floor, Some(4));
    }
    assert_eq!(floors.floors().len(), 10);
    assert!((floors.floors()[3].height - 9.0).abs() < 0.02);
    let level = floors.floors()[4].deviation;
    assert!(level < 10.0 * LEVEL, "{level}");
}

/// Where the car is unknown, the ends of the shaft or uneven storeys tell.
#[test]
fn a_car_at_an_unknown_floor_is_found() {
    let heights = [0.0, 4.5, 7.5, 10.6, 13.6];
    let mut floors = Floors::given(MENDED, &heights, 0.005, Start::Unknown).unwrap();
    let stop = floors.step(3.0, variance(3.0));
    assert!(stop.probability < 0.7, "{stop:?}");
    let stop = floors.step(3.1, variance(3.1));
    assert_eq!(stop.floor, Some(3));
    assert!(stop.probability > 0.99, "{stop:?}");
    // From the floor 3 it goes down: from the lowest it could not.
    let mut floors = Floors::given(MENDED, &[0.0, 3.0, 6.0, 9.0], 0.005, Start::Unknown).unwrap();
    for distance in [-3.0, 6.0, -9.0] {
        let judgement = floors.step(distance, variance(distance)).judgement.unwrap();
        assert_eq!(judgement.fault, None, "{distance} {judgement:?}");
    }
    let mut floors = Floors::given(MENDED, &heights, 0.005, Start::Floor(2)).unwrap();
    floors.lose();
    let stop = floors.step(-4.5, variance(4.5));
    assert_eq!(stop.floor, Some(0));
}
