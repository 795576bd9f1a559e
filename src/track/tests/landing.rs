//! What a barometer knows of the floors where the accelerometer does not.

use crate::lift::{Drive, Ending, Pickup, Ride, Trip};
use crate::monitor::Settings;
use crate::recording::{Barometer, Pressure, Sample};
use crate::rng::Stream;
use crate::signal::white_noise;
use crate::track::floors::{self, Floors, Start};
use crate::track::{Climbs, Track, Unseen};

const RATE: f64 = 100.0;

/// Floors 4 m apart; the second trip is not in the record.
const TRIPS: [f64; 4] = [4.0, 4.0, -8.0, 4.0];

/// At which floors the trips that are in the record end.
fn floors(seed: u64, has_barometer: bool) -> Vec<Option<usize>> {
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
    let ride = Ride::new(RATE, vec![14.0; 5], TRIPS.iter().map(trip).collect()).unwrap();
    let journeys = ride.journeys();
    let (from, to) = (journeys[1].start - 2.0, journeys[1].stop + 2.0);
    let record = ride.simulate(&Pickup::white(0.012), seed, 0).record;
    let samples = record.into_iter().enumerate().map(|(place, acceleration)| {
        let time = place as f64 / RATE;
        Sample { time, acceleration }
    });
    let samples: Vec<Sample> = samples
        .filter(|it| it.time < from || it.time > to)
        .collect();
    let design = Settings::default().at(RATE).unwrap();
    let (detection, mut track) = Track::found(&design, &samples, Some(true));
    assert_eq!(track.trips.len(), 3, "{seed}");
    let height = |time: f64| {
        let gone = journeys.iter().map(|it| {
            let share = (time - it.start) / (it.stop - it.start);
            it.distance * share.clamp(0.0, 1.0)
        });
        gone.sum::<f64>()
    };
    let mut draws = Stream::new(seed, "landing", "").at(0);
    let noise = white_noise(ride.duration() as usize, &mut draws);
    let readings = noise.iter().enumerate().map(|(second, noise)| Pressure {
        time: second as f64,
        pascal: 95_000.0 - 11.1 * (height(second as f64) + 0.1 * noise),
    });
    let barometer = Barometer::of_readings(readings.collect());
    if has_barometer {
        let unseen = Unseen::of(&detection, &samples);
        let climbs = Climbs::of(&track.trips, &unseen, &barometer, 0.0, None);
        track.rise(&climbs, &unseen);
    }
    let start = Start::Floor(0);
    let settings = floors::Settings::default();
    let mut floors = Floors::given(settings, &[0.0, 4.0, 8.0, 12.0], 0.01, start).unwrap();
    track.land(&detection, &samples, &mut floors);
    let landings = track.trips.iter().map(|it| it.landing);
    landings.map(|it| it.and_then(|it| it.floor)).collect()
}

#[test]
fn a_barometer_carries_the_car_over_what_is_not_recorded() {
    for seed in 0..20 {
        let known = [Some(1), Some(0), Some(1)];
        assert_eq!(floors(seed, true), known, "{seed}");
        let lost = floors(seed, false);
        assert_ne!(lost, known, "{seed}");
    }
}
