//! One row of `points.csv`: an outcome at a point.

use super::point::RidePoint;
use super::table::RideTable;
use crate::results::eight_digits;
use crate::study::estimate::Estimate;
use crate::study::kind::Context;
use crate::whiten::Order;
use serde::{Deserialize, Serialize};

/// Defines the columns: the name, type and value of each.
macro_rules! columns {
    (
        $(#[$about:meta])*
        Row($($source:ident: $of:ty),*)
        $($(#[$meaning:meta])* $column:ident: $kind:ty = $value:expr;)*
    ) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[allow(missing_docs, reason = "the columns are the config's own words")]
        pub struct Row {
            $($(#[$meaning])* pub $column: $kind,)*
        }

        impl Row {
            pub(super) fn new($($source: $of),*) -> Self {
                Self { $($column: $value),* }
            }
        }
    };
}

columns! {
    /// An outcome at a point, and the parameters of the point except `longest_motion` and `longest_slack`.
    Row(
        table: &RideTable,
        curve: usize,
        x: f64,
        point: &RidePoint,
        size: f64,
        estimate: Estimate,
        context: &Context
    )
    curve: usize = curve + 1;
    label: String = table.curves[curve].label.clone();
    /// The key that is swept.
    axis: String = table.axis.clone();
    /// The value of the swept key.
    x: f64 = x;
    outcome: String = estimate.outcome;
    /// How often the event happened.
    count: u64 = estimate.count;
    /// The number of cases, or the time, in which it could happen.
    exposure: f64 = eight_digits(estimate.exposure);
    /// Unit of the exposure.
    unit: String = estimate.unit.to_owned();
    /// The rate of the event, or the quantile.
    estimate: f64 = eight_digits(estimate.value);
    low: f64 = eight_digits(estimate.low);
    high: f64 = eight_digits(estimate.high);
    trials: u64 = context.trials;
    confidence: f64 = context.confidence;
    measure: String = table.measure.to_string();
    rate: f64 = point.keys.rate;
    sigma: f64 = eight_digits(point.pickup.sigma);
    sensor: String = point.pickup.sensor.to_string();
    vibration: f64 = point.pickup.vibration;
    nu: f64 = point.pickup.impulses.nu.get();
    theta: f64 = point.pickup.impulses.theta.get();
    quantum: Option<f64> = point.pickup.digitiser.quantum();
    footfalls: f64 = point.pickup.disturbance.footfalls.get();
    jolt: f64 = point.pickup.disturbance.jolt.get();
    distance: f64 = point.keys.distance.get();
    speed: f64 = point.keys.speed.get();
    acceleration: f64 = point.keys.acceleration.get();
    jerk: f64 = point.keys.jerk.get();
    trips: usize = point.keys.trips;
    shortest_rest: f64 = point.keys.rest[0];
    longest_rest: f64 = point.keys.rest[1];
    length: f64 = point.keys.length.get();
    jam_within: f64 = point.keys.jam_within.get();
    tolerance: f64 = point.keys.tolerance.get();
    alpha: f64 = point.settings.detector.alpha;
    /// The exact size of one decision.
    size: f64 = eight_digits(size);
    block: f64 = point.settings.monitor.block;
    reference: usize = point.settings.samples.reference;
    shift: usize = point.settings.samples.shift;
    scale: usize = point.settings.samples.scale;
    gap: usize = point.settings.samples.gap;
    training: usize = point.settings.whitening.training;
    /// None if the monitor chooses the order at each rest.
    order: Option<usize> = fixed(point.settings.whitening.order);
    least_speed: f64 = point.settings.monitor.least_speed;
    least_acceleration: f64 = point.settings.monitor.least_acceleration;
    most_acceleration: f64 = point.settings.monitor.most_acceleration;
    learnt: bool = point.keys.learnt;
    begins_at_rest: bool = point.begins_at_rest;
    motion_shows: bool = point.keys.motion_shows;
}

/// The order, if it is given.
fn fixed(order: Order) -> Option<usize> {
    match order {
        Order::Fixed(order) => Some(order),
        Order::Auto => None,
    }
}
