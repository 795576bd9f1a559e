//! The rides: how far each went, and how well that is known.

use super::numbers::{decimals, direction, fixed, none, size, time, within};
use super::parts::{section as titled, sentence, wide};
use crate::detection::{End, no_rides};
use crate::track::{Alarm, Climb, Standing, TrackReport, Tracked};
use maud::{Markup, html};

pub(super) fn section(report: &TrackReport) -> Markup {
    if report.rides.is_empty() {
        let none = sentence(no_rides(report.undecided, report.events));
        return titled("rides", "Rides", html! { p { (none) } });
    }
    titled(
        "rides",
        "Rides",
        html! {
            (wide("Rides", table(report)))
            (notes(report))
        },
    )
}

fn table(report: &TrackReport) -> Markup {
    let deviations = report.rides.iter().filter_map(|it| it.deviation);
    let metres = decimals(deviations);
    let (has_air, has_floors) = (report.barometer.is_some(), report.floors.is_some());
    html! {
        table {
            caption { "± is one standard deviation. Times count on the recording's clock; up is positive." }
            thead { tr {
                th scope="col" { "Ride" }
                th scope="col" { "Direction" }
                (column("Distance", "m"))
                @if has_air { (column("Height by barometer", "m")) (column("Then at", "m")) }
                (column("Start", "s"))
                (column("Stop", "s"))
                (column("Top speed", "m/s"))
                (column("Speed left at stop", "m/s"))
                @if has_floors { th scope="col" { "From → to floor" } }
                th scope="col" { "Remarks" }
            } }
            tbody { @for ride in report.rides { tr {
                th scope="row" { (ride.trip.ride) }
                td { (direction(ride.trip.direction)) }
                td.number { (distance(ride, metres)) }
                @if has_air { td.number { (height(ride)) } td.number { (position(ride)) } }
                td.number { (time(ride.trip.start)) }
                td.number { (time(ride.trip.stop)) }
                td.number { (fixed(ride.trip.speed, 2)) }
                td.number { (ride.closing_speed.map_or(none(), |speed| html! { (fixed(speed, 3)) })) }
                @if has_floors { td { (floors(ride)) } }
                td { (remarks(report, ride)) }
            } } }
        }
    }
}

/// A header of numbers, with their unit.
pub(super) fn column(name: &str, unit: &str) -> Markup {
    html! { th.number scope="col" { (name) " " span.unit { (unit) } } }
}

fn distance(ride: &Tracked, decimals: usize) -> Markup {
    match ride.distance.zip(ride.deviation) {
        Some((distance, deviation)) => within(distance, deviation, decimals),
        None => html! { span.none { "not measured" } },
    }
}

fn height(ride: &Tracked) -> Markup {
    let height = |it: Climb| within(it.height, it.height_deviation, 2);
    ride.climb.map_or(none(), height)
}

/// Above where it stood first.
fn position(ride: &Tracked) -> Markup {
    let position = |it: Standing| within(it.position, it.position_deviation, 2);
    ride.standing.map_or(none(), position)
}

/// Between which floors it went, as far as that is known.
pub(super) fn floors(ride: &Tracked) -> Markup {
    let floor = |of: Option<usize>| of.map_or("?".to_owned(), |floor| floor.to_string());
    match &ride.landing {
        Some(stop) if stop.floor.is_none() => html! { (floor(stop.from)) " → off every floor" },
        Some(stop) => html! { (floor(stop.from)) " → " (floor(stop.floor)) },
        None => html! { span.none { "not known" } },
    }
}

fn remarks(report: &TrackReport, ride: &Tracked) -> Markup {
    let trip = &ride.trip;
    let mut alarms = Alarm::standing(report.rides).into_iter();
    let alarm = alarms.find(|(number, _)| *number == trip.ride);
    let alarm = alarm.map(|(_, fault)| format!("alarm: {fault}"));
    let jam = (trip.ended == End::Jam).then(|| "ended by a jam".to_owned());
    let seconds = |time: f64| fixed(time, 2);
    let is_so_far = ride.distance.is_some() && trip.stop.is_none();
    let remarks = [
        ride.unknown.map(|why| why.to_string()),
        is_so_far.then(|| "so far: its stop is not recorded".to_owned()),
        trip.levelling
            .map(|time| format!("creeps to the landing from {} s", seconds(time))),
        trip.or_start
            .map(|time| format!("start may be at {} s as well", seconds(time))),
        trip.or_stop
            .map(|time| format!("stop may be at {} s as well", seconds(time))),
        ride.widened
            .map(|by| format!("± widened by {} m for the speed left", size(by, 2))),
    ];
    html! {
        @for fault in [alarm, jam].into_iter().flatten() { div.bad { "✗ " (fault) } }
        @for remark in remarks.into_iter().flatten() { div { (remark) } }
    }
}

fn notes(report: &TrackReport) -> Markup {
    let is_measured = report.rides.iter().any(|it| it.distance.is_some());
    html! {
        ul.notes {
            @if is_measured {
                li {
                    "The ± holds the noise of the sensor and of the motion. It does not hold an error of the sensor's gain, which \
                     is the same in all of the record: 1 % of it is 1 % of every distance."
                }
                li {
                    "Speed left at stop: what the integral of the acceleration leaves where the car stands. It should be 0; where it \
                     is too much for the noise, the ± is widened, and a warning says so."
                }
            }
            li { "Top speeds carry no ±." }
            @if !report.recording.is_up_known {
                li {
                    "Which way is up is assumed, since nothing in the record shows it: all directions and signs may be the opposite \
                     (" code { "--invert" } " turns them; a barometer shows it)."
                }
            }
            @if let Some(of) = &report.barometer {
                li { "Heights are reckoned with air of " (of.air) "." }
            }
        }
    }
}
