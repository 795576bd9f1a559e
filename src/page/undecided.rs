//! What the record leaves open, why, and what would decide it.

use super::numbers::fixed;
use super::parts::{section as titled, sentence, wide};
use crate::detection::{Undecided, event_lines};
use crate::track::TrackReport;
use maud::{Markup, html};

pub(super) fn section(report: &TrackReport) -> Markup {
    let others = report.rides.iter().flat_map(|it| it.trip.other_ends());
    let lost = report.rides.iter().filter_map(|it| {
        let (ride, why) = (it.trip.ride, it.unknown?);
        Some(format!("ride {ride}: no distance, {why}"))
    });
    let lines: Vec<String> = others.chain(lost).collect();
    let events = event_lines(report.events);
    titled(
        "undecided",
        "What was not decided, and why",
        html! {
            @if report.undecided.is_empty() && lines.is_empty() {
                p { "Nothing: one explanation of the record is clearly likelier than all others." }
            }
            @if !report.undecided.is_empty() { (wide("Undecided stretches", table(report.undecided))) }
            @if !lines.is_empty() { ul { @for line in lines { li { (sentence(&line)) } } } }
            @if !events.is_empty() {
                p { "What else moved the sensor, and is no ride:" }
                ul { @for line in events { li { (sentence(&line)) } } }
            }
        },
    )
}

fn table(stretches: &[Undecided]) -> Markup {
    html! {
        table.prose {
            caption { "Undecided stretches. Times in s." }
            thead { tr {
                th.number scope="col" { "From" }
                th.number scope="col" { "To" }
                th scope="col" { "What may have been" }
                th scope="col" { "What decides it" }
            } }
            tbody { @for it in stretches { tr {
                td.number { (fixed(it.from, 1)) }
                td.number { (fixed(it.to, 1)) }
                td { (sentence(&it.readings())) }
                td { (sentence(it.advice())) }
            } } }
        }
    }
}
