//! One row of `points.csv`: an outcome at a point.

use super::estimate::Estimate;
use super::point::RidePoint;
use super::table::RideTable;
use crate::results::eight_digits;
use crate::study::kind::Context;
use crate::whiten::Order;
use serde::{Deserialize, Serialize};

/// An outcome at a point, and every parameter of the point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the columns are the config's own words")]
pub struct Row {
    pub curve: usize,
    pub label: String,
    /// The key that is swept.
    pub axis: String,
    /// Its value.
    pub x: f64,
    pub outcome: String,
    /// How often it happened.
    pub count: u64,
    /// Out of so many, or in so much time.
    pub exposure: f64,
    /// Of the exposure.
    pub unit: String,
    /// Its rate, or the quantile.
    pub estimate: f64,
    pub low: f64,
    pub high: f64,
    pub trials: u64,
    pub confidence: f64,
    pub measure: String,
    pub rate: f64,
    pub sigma: f64,
    pub sensor: String,
    pub vibration: f64,
    pub nu: f64,
    pub theta: f64,
    pub quantum: Option<f64>,
    pub footfalls: f64,
    pub jolt: f64,
    pub distance: f64,
    pub speed: f64,
    pub acceleration: f64,
    pub jerk: f64,
    pub trips: usize,
    pub shortest_rest: f64,
    pub longest_rest: f64,
    pub length: f64,
    pub jam_within: f64,
    pub tolerance: f64,
    pub alpha: f64,
    /// The exact size of one decision.
    pub size: f64,
    pub block: f64,
    pub reference: usize,
    pub shift: usize,
    pub scale: usize,
    pub gap: usize,
    pub training: usize,
    /// None where it is chosen at every rest.
    pub order: Option<usize>,
    pub least_speed: f64,
    pub least_acceleration: f64,
    pub most_acceleration: f64,
    pub learnt: bool,
    pub begins_at_rest: bool,
    pub motion_shows: bool,
}

impl Row {
    pub(super) fn new(
        table: &RideTable,
        curve: usize,
        x: f64,
        point: &RidePoint,
        size: f64,
        estimate: Estimate,
        context: &Context,
    ) -> Self {
        let (pickup, settings) = (&point.pickup, &point.settings);
        let keys = &point.keys;
        let [shortest_rest, longest_rest] = keys.rest;
        Self {
            curve: curve + 1,
            label: table.curves[curve].label.clone(),
            axis: table.axis.to_owned(),
            x,
            outcome: estimate.outcome,
            count: estimate.count,
            exposure: eight_digits(estimate.exposure),
            unit: estimate.unit.to_owned(),
            estimate: eight_digits(estimate.value),
            low: eight_digits(estimate.low),
            high: eight_digits(estimate.high),
            trials: context.trials,
            confidence: context.confidence,
            measure: table.measure.name().to_owned(),
            rate: keys.rate,
            sigma: eight_digits(pickup.sigma),
            sensor: pickup.sensor.to_string(),
            vibration: pickup.vibration,
            nu: pickup.impulses.nu.get(),
            theta: pickup.impulses.theta.get(),
            quantum: pickup.digitiser.quantum(),
            footfalls: pickup.disturbance.footfalls.get(),
            jolt: pickup.disturbance.jolt.get(),
            distance: keys.distance,
            speed: keys.speed,
            acceleration: keys.acceleration,
            jerk: keys.jerk,
            trips: keys.trips,
            shortest_rest,
            longest_rest,
            length: keys.length,
            jam_within: keys.jam_within,
            tolerance: keys.tolerance,
            alpha: settings.detector.alpha,
            size: eight_digits(size),
            block: settings.monitor.block,
            reference: settings.samples.reference,
            shift: settings.samples.shift,
            scale: settings.samples.scale,
            gap: settings.samples.gap,
            training: settings.whitening.training,
            order: match settings.whitening.order {
                Order::Fixed(order) => Some(order),
                Order::Auto => None,
            },
            least_speed: settings.monitor.least_speed,
            least_acceleration: settings.monitor.least_acceleration,
            most_acceleration: settings.monitor.most_acceleration,
            learnt: keys.learnt,
            begins_at_rest: point.begins_at_rest,
            motion_shows: keys.motion_shows,
        }
    }
}
