//! The stops among the floors, and what is an alarm.

use super::numbers::{count, decimals, fixed, none, within};
use super::parts::{section as titled, sentence, wide};
use super::rides::{column, floors as between};
use crate::detection::{End, Why};
use crate::track::floors::{Floor, Judgement};
use crate::track::{Alarm, TrackReport, Tracked, VibrationReport};
use maud::{Markup, html};

pub(super) fn section(report: &TrackReport) -> Markup {
    titled(
        "alarms",
        "Floors and alarms",
        html! {
            (faults(report))
            @match &report.floors {
                None => p {
                    "No floors were given, so no stop was compared with a floor, and none could raise an alarm ("
                    code { "--floors" } " with their heights, or " code { "--map" } " with a map that is kept)."
                },
                Some(floors) => {
                    (alarms(report))
                    @if !report.rides.is_empty() { (wide("Stops", stops(report))) }
                    (wide("Floors", map(floors)))
                    (notes(report))
                }
            }
        },
    )
}

/// The rides that a jam ended.
pub(super) fn jams<'a>(report: &'a TrackReport) -> impl Iterator<Item = &'a Tracked> {
    let rides = report.rides.iter();
    rides.filter(|ride| ride.trip.ended == End::Jam)
}

/// What went wrong beside the floors.
fn faults(report: &TrackReport) -> Markup {
    let frozen = report.undecided.iter().filter(|it| it.why == Why::Frozen);
    html! {
        @for ride in jams(report) {
            p.bad { "✗ Ride " (ride.trip.ride) " ended by a jam, at " (fixed(ride.trip.stop.unwrap_or_default(), 1)) " s." }
        }
        @for words in report.vibration.iter().flat_map(VibrationReport::alarms) {
            p.bad { "✗ " (sentence(&words)) }
        }
        @for it in frozen {
            p.bad { "✗ The sensor repeats one value from " (fixed(it.from, 1)) " to " (fixed(it.to, 1)) " s." }
        }
    }
}

/// How many stops were compared with a floor.
pub(super) fn judged(report: &TrackReport) -> usize {
    let is_judged = |it: &&Tracked| it.landing.is_some_and(|stop| stop.judgement.is_some());
    report.rides.iter().filter(is_judged).count()
}

fn alarms(report: &TrackReport) -> Markup {
    let alarms = Alarm::all(report.rides);
    let judged = judged(report);
    html! {
        @if judged == 0 {
            p { "No stop could be compared with a floor, so none could raise an alarm." }
        } @else if alarms.is_empty() {
            p { "No alarms: " (judged) " of " (count(report.rides.len(), "stop", "stops")) " compared with a floor, each at one." }
        } @else {
            ul.alarms { @for alarm in &alarms {
                li.bad[alarm.judgement.fault.is_some()] {
                    @if alarm.judgement.fault.is_some() { "✗ " } @else { "✓ " }
                    (sentence(&alarm.to_string()))
                }
            } }
        }
    }
}

fn stops(report: &TrackReport) -> Markup {
    let landings = || report.rides.iter().filter_map(|it| it.landing);
    let judgements = landings().flat_map(|it| [it.judgement, it.earlier]);
    let deviations = judgements.flatten().map(|it| it.deviation);
    let metres = decimals(deviations.chain(landings().map(|it| it.deviation)));
    html! {
        table {
            caption { "Stops. Each is judged at once, and again by the ride after it." }
            thead { tr {
                th scope="col" { "Ride" }
                th scope="col" { "From → to floor" }
                th.number scope="col" { "Probability" }
                (column("Position", "m"))
                (column("Above its floor", "m"))
                th scope="col" { "At once" }
                th scope="col" { "Judged again" }
            } }
            tbody { @for (place, ride) in report.rides.iter().enumerate() { tr {
                th scope="row" { (ride.trip.ride) }
                td { (between(ride)) }
                @match &ride.landing {
                    None => td colspan="5" { span.none { "not judged: the ride is not measured from rest to rest, or something beside it is undecided" } },
                    Some(stop) => {
                        td.number { (probability(stop.probability)) }
                        td.number { (within(stop.position, stop.deviation, metres)) }
                        td.number { (offset(stop.judgement, metres)) }
                        td { (verdict(stop.judgement)) }
                        td { (verdict(again(report, place))) }
                    }
                }
            } } }
        }
    }
}

/// What the next ride says of the stop of this one.
fn again(report: &TrackReport, place: usize) -> Option<Judgement> {
    report.rides.get(place + 1)?.landing?.earlier
}

/// Never 1: other courses of events are not excluded.
fn probability(value: f64) -> String {
    if value > 0.999 {
        "> 0.999".to_owned()
    } else {
        fixed(value, 3)
    }
}

fn offset(judgement: Option<Judgement>, metres: usize) -> Markup {
    judgement.map_or(none(), |it| within(it.offset, it.deviation, metres))
}

fn verdict(judgement: Option<Judgement>) -> Markup {
    match judgement {
        None => html! { span.none { "not judged" } },
        Some(Judgement {
            fault: None, floor, ..
        }) => html! { span.good { "✓ at floor " (floor) } },
        Some(Judgement {
            fault: Some(fault), ..
        }) => html! { span.bad { "✗ " (fault) } },
    }
}

fn map(floors: &[Floor]) -> Markup {
    let metres = decimals(floors.iter().map(|it| it.deviation).filter(|it| *it > 0.0));
    let has_drift = floors.iter().any(|it| it.drift_deviation > 0.0);
    html! {
        table.narrow {
            caption { "Floors, as they are known after the rides." }
            thead { tr {
                th scope="col" { "Floor" }
                (column("Height", "m"))
                @if has_drift { (column("Drift", "m")) }
                th.number scope="col" { "Stops" }
            } }
            tbody { @for (number, floor) in floors.iter().enumerate() { tr {
                th scope="row" { (number) }
                td.number {
                    @if floor.deviation > 0.0 { (within(floor.height, floor.deviation, metres)) } @else { (fixed(floor.height, metres)) }
                }
                @if has_drift { td.number { (within(floor.drift, floor.drift_deviation, 3)) } }
                td.number { (floor.visits) }
            } } }
        }
    }
}

fn notes(report: &TrackReport) -> Markup {
    let added = report.rides.iter().filter_map(|it| {
        let floor = it.landing?.added?;
        Some((it.trip.ride, floor))
    });
    html! {
        ul.notes {
            li { "Floors count from 0, the lowest; ? stands for a stop off every floor, or at one that is not known. Heights and positions \
                 count from the floor at 0 m, which is exact by definition." }
            li {
                "Probability: the share of this course of events in all that are kept. Where it is low the stop may be at another floor ("
                code { "--at" } " says where the car begins)."
            }
            @for (ride, floor) in added {
                li { "Ride " (ride) " added floor " (floor) ": the numbers of the floors above it are one more from there on." }
            }
        }
    }
}
