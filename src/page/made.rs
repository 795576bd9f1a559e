//! How the page was made.

use super::parts::section as titled;
use crate::track::{TrackReport, TrackSettings};
use maud::{Markup, html};
use serde_json::Value;

pub(super) fn section(report: &TrackReport) -> Markup {
    titled(
        "made",
        "How this was made",
        html! {
            p {
                "By liftsim " (env!("CARGO_PKG_VERSION")) ", command " code { "liftsim track" } ", from "
                (report.recording.file) ". The same file, flags and version give the same page, byte for byte: it holds no date, no \
                 machine and no path."
            }
            p {
                "A ride is found where the changes of speed that the acceleration shows sum to zero, in the likeliest explanation of \
                 the whole record. Its distance is the acceleration integrated twice by a Kalman filter of distance, speed and the \
                 sensor's bias, which knows when the car stands and when it moves uniformly. Nothing here replaces an inspection."
            }
            p { "Settings of that filter, in SI units:" }
            dl.settings { @for (name, value) in settings(report.settings) {
                div { dt { (name) } dd { (value) } }
            } }
        },
    )
}

/// By their names in a config.
fn settings(of: &TrackSettings) -> Vec<(String, String)> {
    let value = serde_json::to_value(of).expect("settings are plain data");
    let mut flat = Vec::new();
    flatten("", &value, &mut flat);
    flat
}

fn flatten(name: &str, value: &Value, into: &mut Vec<(String, String)>) {
    match value {
        Value::Object(fields) => {
            for (field, value) in fields {
                let dot = if name.is_empty() { "" } else { "." };
                flatten(&format!("{name}{dot}{field}"), value, into);
            }
        }
        value => into.push((name.to_owned(), super::numbers::plain(value))),
    }
}
