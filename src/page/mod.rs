//! HTML pages that stand for themselves, a recording or the [`report`]: read on a screen or a phone, or printed.
//!
//! The page of a recording is a view of a [`TrackReport`] and a picture: nothing is measured or judged here. A page asks for
//! nothing: no script, font or picture from elsewhere, and a policy that lets none in. It holds no clock, host or path, so the
//! same recording and flags give the same bytes. Everything that comes from a file is escaped.

mod alarms;
mod judged;
mod made;
mod numbers;
mod parts;
pub mod report;
mod rides;
mod sensor;
mod summary;
mod undecided;

use crate::figure::{FigureError, inline, quality};
use crate::plot::Plot;
use crate::track::TrackReport;
use maud::{Markup, PreEscaped, html};
use parts::{section, sentence, shell, wide};

/// What is read aloud in place of the picture.
const PICTURE: &str = "The record over time, and the speed and the position of the car within two standard deviations. The \
                           tables below have the numbers.";

/// What is read aloud in place of that of the quality.
const QUALITY: &str =
    "The figures of each ride beside their limits. The table above has the numbers.";

/// The page of a report, with the picture of its record.
///
/// # Errors
/// Where a picture does not fit on a sheet.
pub fn html(report: &TrackReport, record: &Plot) -> Result<String, FigureError> {
    let picture = inline(record, PICTURE)?;
    let quality = report.quality.as_ref();
    let quality = quality.and_then(|it| quality::plot(report.rides, it, &report.recording.file));
    let quality = quality.map(|it| inline(&it, QUALITY)).transpose()?;
    let file = &report.recording.file;
    let body = html! {
        main {
            (summary::header(report))
            (warnings(report))
            (figure(report, &picture))
            (rides::section(report))
            (alarms::section(report))
            (judged::section(report))
            @if let Some(quality) = &quality { (judged::picture(quality)) }
            (undecided::section(report))
            (sensor::section(report))
            (made::section(report))
        }
    };
    let title = format!("{file} – lift recording");
    Ok(shell(&title, "light", include_str!("page.css"), body))
}

fn warnings(report: &TrackReport) -> Markup {
    html! {
        @if !report.warnings.is_empty() {
            section.warnings id="warnings" {
                h2 { "Warnings" }
                ul { @for warning in &report.warnings { li { (sentence(warning)) } } }
            }
        }
    }
}

fn figure(report: &TrackReport, picture: &str) -> Markup {
    let is_measured = report.rides.iter().any(|it| it.distance.is_some());
    let record = match report.recording.high_pass {
        None => "The acceleration along the vertical as it was recorded",
        Some(_) => "The acceleration along the vertical, restored from what its filter left",
    };
    let across = if report.calibration.is_empty() {
        ""
    } else {
        "; below, what is read across gravity"
    };
    let course = if is_measured {
        "; below, the speed and the position of the car, up positive, with a band of two standard deviations on either side. \
         Shaded: where the car was known to stand or to move uniformly."
    } else {
        ". No ride is measured, so neither speed nor position is drawn."
    };
    let hatched = if report.undecided.is_empty() {
        ""
    } else {
        " Hatched: not decided."
    };
    let content = html! {
        figure {
            (wide("The record as a picture", html! { (PreEscaped(picture)) }))
            figcaption { (record) (across) (course) (hatched) }
        }
    };
    section("picture", "The record", content)
}
