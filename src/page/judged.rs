//! How hard and how smoothly the rides went, beside the limits of the norm.

use super::numbers::{direction, fixed, none};
use super::parts::{section as titled, sentence, wide};
use crate::track::quality::{Limit, Measure, PAIRS, Quality, Verdict};
use crate::track::{QualityReport, TrackReport, Tracked};
use maud::{Markup, PreEscaped, html};
use std::iter;

/// Each ride's figures as a picture.
pub(super) fn picture(picture: &str) -> Markup {
    let content =
        html! { figure { (wide("Ride quality as a picture", html! { (PreEscaped(picture)) })) } };
    titled("figures", "Ride quality, ride by ride", content)
}

pub(super) fn section(report: &TrackReport) -> Markup {
    let judged = |quality| html! { (judged(report.rides, quality)) };
    let content = (report.quality.as_ref()).map_or_else(
        || html! { p { "The rides were not judged (" code { "--quality" } ")." } },
        judged,
    );
    titled("quality", "Ride quality", content)
}

fn judged(rides: &[Tracked], report: &QualityReport) -> Markup {
    let remarks = report.remarks(rides);
    let Some(speed) = report.rated_speed else {
        return html! { @for remark in remarks { p { (sentence(&remark)) } } };
    };
    html! {
        p {
            "Beside the limits of " strong { (report.norm) } ", for a rated speed of " (fixed(speed, 2)) " m/s."
        }
        (wide("Ride quality", table(rides, report)))
        ul.notes {
            li {
                "✓ within its limit, ✗ beyond it, ? beyond it, but it may be the noise of the sensor; a figure without a mark has \
                 no limit. The figures carry no ±."
            }
            li {
                "Vibration is peak to peak, weighted as people feel it; 95 %: what 95 % of the values do not exceed. A ride is \
                 within the limits if it keeps all of them, and not decidable if it breaks none, but lacks a figure or has one with a ?."
            }
            li {
                "Speed is here the integral of the acceleration, zero at both ends; it may differ from the top speed of the rides."
            }
            @for remark in remarks { li { (sentence(&remark)) } }
        }
    }
}

fn table(rides: &[Tracked], report: &QualityReport) -> Markup {
    html! {
        table.quality {
            caption { "Each figure's largest value, and what 95 % do not exceed." }
            thead {
                tr {
                    th scope="col" rowspan="2" { "Ride" }
                    th scope="col" rowspan="2" { "Verdict" }
                    @for (name, most, usual) in PAIRS {
                        th scope="colgroup" colspan=(if usual.is_some() { 2 } else { 1 }) {
                            (sentence_case(name)) " " span.unit { (most.unit()) }
                        }
                    }
                }
                tr {
                    @for (_, _, usual) in PAIRS {
                        th.number scope="col" { "largest" }
                        @if usual.is_some() { th.number scope="col" { "95 %" } }
                    }
                }
            }
            tbody {
                tr.limits {
                    th scope="row" { "Limit" }
                    td {}
                    @for measure in figures() { td.number { (bound(measure, report)) } }
                }
                @for ride in rides { (row(ride, report)) }
            }
        }
    }
}

fn sentence_case(name: &str) -> String {
    sentence(name).trim_end_matches('.').to_owned()
}

/// In the order of the columns.
fn figures() -> impl Iterator<Item = Measure> {
    let pairs = PAIRS.into_iter();
    pairs.flat_map(|(_, most, usual)| iter::once(most).chain(usual))
}

fn limit(measure: Measure, report: &QualityReport) -> Option<&Limit> {
    let mut limits = report.limits.all().iter();
    limits.find(|it| it.measure == measure)
}

fn bound(measure: Measure, report: &QualityReport) -> Markup {
    let Some(limit) = limit(measure, report) else {
        return none();
    };
    html! {
        @if let Some(least) = limit.least { "≥ " (fixed(least, 2)) }
        @if let Some(most) = limit.most { "≤ " (fixed(most, 2)) }
    }
}

fn row(ride: &Tracked, report: &QualityReport) -> Markup {
    html! {
        tr {
            th scope="row" { (ride.trip.ride) " " span.unit { (direction(ride.trip.direction)) } }
            @match &ride.quality {
                None => td colspan="12" { span.none { "not judged" } },
                Some(quality) => {
                    td { (verdict(quality, report)) }
                    @for measure in figures() { td.number { (figure(quality, measure, report)) } }
                }
            }
        }
    }
}

fn verdict(quality: &Quality, report: &QualityReport) -> Markup {
    match report.limits.overall(quality) {
        Some(Verdict::Pass) => html! { span.good { "✓ within limits" } },
        Some(Verdict::Fail) => html! { span.bad { "✗ beyond limits" } },
        Some(Verdict::Noise) => html! { span.doubt { "? not decidable: noise" } },
        None => {
            let is_missing = |it: &(&str, Measure, Option<Measure>)| {
                limit(it.1, report).is_some() && quality.figure(it.1).is_none()
            };
            let missing = PAIRS.iter().filter(|it| is_missing(it));
            let missing: Vec<String> = missing.map(|it| format!("no {}", it.0)).collect();
            html! { span.doubt { "? not decidable: " (missing.join(", ")) } }
        }
    }
}

fn figure(quality: &Quality, measure: Measure, report: &QualityReport) -> Markup {
    let Some(figure) = quality.figure(measure) else {
        return none();
    };
    let (tone, mark) = match report.limits.verdict(quality, measure) {
        Some(Verdict::Pass) => ("good", "✓"),
        Some(Verdict::Fail) => ("bad", "✗"),
        Some(Verdict::Noise) => ("doubt", "?"),
        None => ("", ""),
    };
    html! {
        (apart(figure.value, limit(measure, report)))
        span.noise { @if figure.is_noise() { "~" } }
        span.mark.(tone) { (mark) }
    }
}

/// A value with so many decimals that one beyond its limit does not read like the limit.
fn apart(value: f64, limit: Option<&Limit>) -> String {
    let bound = limit.and_then(|it| it.least.or(it.most));
    let reads_alike = |decimals: &usize| {
        bound.is_some_and(|bound| {
            bound != value && fixed(bound, *decimals) == fixed(value, *decimals)
        })
    };
    let decimals = (2..6).find(|it| !reads_alike(it));
    fixed(value, decimals.unwrap_or(6))
}
