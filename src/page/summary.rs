//! The head of the page: what was found, in one sentence and in four boxes.

use super::alarms::{jams, judged};
use super::numbers::{count, fixed};
use super::parts::sentence;
use crate::monitor::Direction;
use crate::track::quality::Verdict;
use crate::track::{Alarm, TrackReport};
use maud::{Markup, html};

pub(super) fn header(report: &TrackReport) -> Markup {
    let boxes = [
        rides(report),
        undecided(report),
        alarms(report),
        quality(report),
    ];
    html! {
        header {
            p.kind { "Report on a lift recording" }
            h1 { (report.recording.file) }
            p.found { (found(report)) }
            dl.boxes {
                @for it in boxes {
                    div class=(it.tone) { dt { (it.name) } dd { strong { (it.value) } span { (it.note) } } }
                }
            }
        }
    }
}

/// "2 rides in 58.0 s of record, 1 undecided stretch, no alarm."
fn found(report: &TrackReport) -> String {
    let rides = count(report.rides.len(), "ride", "rides");
    let seconds = fixed(report.recording.end - report.recording.start, 1);
    let stretches = report.undecided.len();
    let undecided = count(stretches, "undecided stretch", "undecided stretches");
    let alarms = match alarming(report) {
        None if report.floors.is_none() => {
            "no alarms looked for, as no floors were given".to_owned()
        }
        None => "no stop compared with a floor".to_owned(),
        Some(alarms) => count(alarms, "alarm", "alarms"),
    };
    sentence(&format!(
        "{rides} in {seconds} s of record, {undecided}, {alarms}"
    ))
}

/// The alarms and the jams that stand; none where no alarm could be raised.
fn alarming(report: &TrackReport) -> Option<usize> {
    let vibration = report.vibration.as_ref().filter(|it| it.guard.is_some());
    let shaken = vibration.map_or(0, |it| it.alarms().len());
    let faults = Alarm::standing(report.rides).len() + jams(report).count() + shaken;
    (judged(report) > 0 || vibration.is_some() || faults > 0).then_some(faults)
}

/// A box: how it is coloured, and what it says.
struct Summary {
    tone: &'static str,
    name: &'static str,
    value: String,
    note: String,
}

fn rides(report: &TrackReport) -> Summary {
    let is_up = |up| move |of: &Direction| (*of == Direction::Up) == up;
    let directions = || report.rides.iter().map(|it| it.trip.direction);
    let [up, down] = [true, false].map(|up| directions().filter(is_up(up)).count());
    let note = match report.rides.len() {
        0 => String::new(),
        _ => format!("{up} up, {down} down"),
    };
    Summary {
        tone: "plain",
        name: "Rides",
        value: report.rides.len().to_string(),
        note,
    }
}

fn undecided(report: &TrackReport) -> Summary {
    let stretches = report.undecided;
    let seconds: f64 = stretches.iter().map(|it| it.to - it.from).sum();
    let (tone, note) = if stretches.is_empty() {
        ("plain", String::new())
    } else {
        ("doubt", format!("{} s of the record", fixed(seconds, 1)))
    };
    Summary {
        tone,
        name: "Undecided stretches",
        value: stretches.len().to_string(),
        note,
    }
}

fn alarms(report: &TrackReport) -> Summary {
    let (tone, value, note) = match alarming(report) {
        None if report.floors.is_none() => {
            ("plain", "not looked for".to_owned(), "no floors were given")
        }
        None => (
            "plain",
            "none possible".to_owned(),
            "no stop was compared with a floor",
        ),
        Some(0) => ("plain", "none".to_owned(), "of stops among floors"),
        Some(number) => ("bad", number.to_string(), "see Floors and alarms"),
    };
    Summary {
        tone,
        name: "Alarms",
        value,
        note: note.to_owned(),
    }
}

fn quality(report: &TrackReport) -> Summary {
    let quality = report.quality.as_ref();
    let judged = report.rides.iter().filter_map(|it| it.quality);
    let verdicts = quality.map(|it| judged.map(|of| it.limits.overall(&of)).collect());
    let verdicts: Vec<Option<Verdict>> = verdicts.unwrap_or_default();
    let number = |of: Option<Verdict>| verdicts.iter().filter(|it| **it == of).count();
    let [failed, passed] = [Verdict::Fail, Verdict::Pass].map(|it| number(Some(it)));
    let rides = report.rides.len();
    let (tone, value) = if failed > 0 {
        ("bad", "beyond limits")
    } else if verdicts.is_empty() {
        ("plain", "not judged")
    } else if passed == rides {
        ("good", "within limits")
    } else {
        ("doubt", "not decidable")
    };
    let note = if verdicts.is_empty() {
        "see Ride quality".to_owned()
    } else if failed > 0 {
        format!(
            "{failed} of {}; limits from memory",
            count(rides, "ride", "rides")
        )
    } else {
        format!(
            "{passed} of {} within; limits from memory",
            count(rides, "ride", "rides")
        )
    };
    Summary {
        tone,
        name: "Ride quality",
        value: value.to_owned(),
        note,
    }
}
