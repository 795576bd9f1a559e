//! Studies of `[ride]` tables.

use super::point::RidePoint;
use super::table::Table;
use crate::lift::Ending;
use crate::study::parse;
use crate::whiten::Order;

fn points(text: &str) -> Vec<RidePoint> {
    let text = format!("question = \"?\"\nseed = 1\ntrials = 1\n[ride]\n{text}");
    let experiment = parse("test", &text).unwrap();
    let points = Table::parse(&experiment).unwrap().points;
    points.into_iter().map(|point| point.of).collect()
}

/// A density holds at any sampling rate, a ratio for one sample. A curve's key replaces the table's.
#[test]
fn the_strength_of_the_noise() {
    let points = points(
        "measure = \"rides\"\ndensity = 0.01\nacceleration = 0.6\n[ride.axis]\nrate = [50, 200]\n\
         [[ride.curve]]\n[[ride.curve]]\ndelta_over_sigma = 3\n[[ride.curve]]\nsigma = 0.5\n",
    );
    let sigma: Vec<f64> = points.iter().map(|point| point.pickup.sigma).collect();
    let expected = [0.05, 0.1, 0.2, 0.2, 0.5, 0.5];
    for (got, expected) in sigma.iter().zip(expected) {
        assert!((got - expected).abs() < 1e-15, "{sigma:?}");
    }
}

/// Trips go up and down in turn and rests are as drawn. The last trip jams in its uniform motion.
#[test]
fn rides_as_drawn() {
    let text = "measure = \"jam\"\ntrips = 3\nrest = [4, 6]\n[ride.axis]\nspeed = [1]\n";
    let point = &points(text)[0];
    let ride = point.ride(|| 0.25).unwrap();
    assert_eq!(ride.rests(), [4.5; 4]);
    let signs: Vec<f64> = ride
        .trips()
        .iter()
        .map(|trip| trip.distance.signum())
        .collect();
    assert_eq!(signs, [1.0, -1.0, 1.0]);
    let jams = ride
        .journeys()
        .iter()
        .map(|journey| journey.jammed)
        .collect::<Vec<_>>();
    assert_eq!(jams, [false, false, true]);
    let (from, to) = ride.started().next().unwrap().1.uniform_motion();
    let Ending::Jam { after, .. } = ride.trips()[2].ending else {
        panic!("no jam");
    };
    assert!((after - (from + (to - from) / 4.0)).abs() < 1e-12);
}

/// Each setting of the monitor is a key of the table, a curve and an axis, by the last word of its path.
#[test]
fn the_monitor_has_all_its_settings() {
    let points = points(
        "measure = \"rest\"\nlongest_motion = 60\norder = \"auto\"\n[ride.axis]\nlongest_slack = [1, 2]\n\
         [[ride.curve]]\n[[ride.curve]]\norder = 3\n",
    );
    let settings: Vec<_> = points
        .iter()
        .map(|point| {
            let settings = &point.design.settings;
            assert_eq!(settings.monitor.longest_motion, 60.0);
            (settings.whitening.order, settings.monitor.longest_slack)
        })
        .collect();
    let (auto, three) = (Order::Auto, Order::Fixed(3));
    let expected = [(auto, 1.0), (auto, 2.0), (three, 1.0), (three, 2.0)];
    assert_eq!(settings, expected);
}
