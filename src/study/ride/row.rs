//! The columns of `points.csv`: an outcome at a point, and the parameters of the point except `longest_motion` and
//! `longest_slack`.

use super::point::RidePoint;
use super::table::Table;
use crate::results::eight_digits;
use crate::study::curves::Point;
use crate::study::outcomes::outcome_row;
use crate::whiten::Order;

outcome_row! {
    |table: &Table, point: &Point<RidePoint>|
    curve: usize = point.curve + 1;
    label: String = table.labels[point.curve].clone();
    /// The key that is swept.
    axis: String = table.axis.clone();
    /// Its value.
    x: f64 = point.x;
    ..
    measure: String = table.measure.to_string();
    rate: f64 = point.of.keys.rate;
    sigma: f64 = eight_digits(point.of.pickup.sigma);
    sensor: String = point.of.pickup.sensor.to_string();
    vibration: f64 = point.of.pickup.vibration;
    nu: f64 = point.of.pickup.impulses.nu.get();
    theta: f64 = point.of.pickup.impulses.theta.get();
    quantum: Option<f64> = point.of.pickup.digitiser.quantum();
    footfalls: f64 = point.of.pickup.disturbance.footfalls.get();
    jolt: f64 = point.of.pickup.disturbance.jolt.get();
    distance: f64 = point.of.keys.distance.get();
    speed: f64 = point.of.keys.speed.get();
    acceleration: f64 = point.of.keys.acceleration.get();
    jerk: f64 = point.of.keys.jerk.get();
    trips: usize = point.of.keys.trips;
    shortest_rest: f64 = point.of.keys.rest[0];
    longest_rest: f64 = point.of.keys.rest[1];
    length: f64 = point.of.keys.length.get();
    jam_within: f64 = point.of.keys.jam_within.get();
    tolerance: f64 = point.of.keys.tolerance.get();
    rule: String = point.of.design.settings.detector.rule.to_string();
    alpha: f64 = point.of.design.settings.detector.alpha;
    /// The exact size of one decision.
    size: f64 = eight_digits(point.of.design.region.size());
    block: f64 = point.of.design.settings.monitor.block;
    reference: usize = point.of.design.settings.samples.reference;
    shift: usize = point.of.design.settings.samples.shift;
    scale: usize = point.of.design.settings.samples.scale;
    gap: usize = point.of.design.settings.samples.gap;
    training: usize = point.of.design.settings.whitening.training;
    /// None if the monitor chooses the order at each rest.
    order: Option<usize> = fixed(point.of.design.settings.whitening.order);
    least_speed: f64 = point.of.design.settings.monitor.least_speed;
    least_acceleration: f64 = point.of.design.settings.monitor.least_acceleration;
    most_acceleration: f64 = point.of.design.settings.monitor.most_acceleration;
    learnt: bool = point.of.keys.learnt;
    begins_at_rest: bool = point.of.begins_at_rest;
    motion_shows: bool = point.of.keys.motion_shows;
}

/// The order, if it is given.
fn fixed(order: Order) -> Option<usize> {
    match order {
        Order::Fixed(order) => Some(order),
        Order::Auto => None,
    }
}
