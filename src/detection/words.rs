//! What a detection leaves open, and what else it saw, in words: for a terminal and for a page.

use super::trip::{Brief, Event, Trip, Undecided, What, Why};
use crate::monitor::Direction;

/// The most times in a line.
const MOST_TIMES: usize = 8;

/// What is said where no ride is decided.
pub fn no_rides(undecided: &[Undecided], events: &[Event]) -> &'static str {
    if undecided.is_empty() && events.is_empty() {
        "no rides: the record stays at its level"
    } else {
        "no rides that are decided"
    }
}

impl Trip {
    /// A line for every end that may be another.
    pub fn other_ends(&self) -> impl Iterator<Item = String> {
        let ends = [("start", self.or_start), ("stop", self.or_stop)];
        let ride = self.ride;
        ends.into_iter().filter_map(move |(name, time)| {
            let time = time?;
            Some(format!(
                "ride {ride}: the {name} may be at {time:.2} s as well"
            ))
        })
    }
}

impl Undecided {
    /// What may have been.
    pub fn readings(&self) -> String {
        let unknown = match self.why {
            Why::Close | Why::Filter => None,
            Why::NoRide => Some("a change of speed that fits no ride"),
            Why::Frozen => Some("the sensor repeats one value"),
            Why::InHand => Some("the sensor may have been in somebody's hand"),
        };
        if let Some(why) = unknown {
            return why.to_owned();
        }
        let more = match self.more {
            0 => String::new(),
            1 => ", or in another way".to_owned(),
            more => format!(", or in {more} other ways"),
        };
        let (either, or) = (briefly(&self.either), briefly(&self.or));
        if self.why == Why::Filter {
            return format!("either {either}, or {or}{more}{}", self.because());
        }
        let odds = likelier(self.log_odds);
        format!("either {either}, or {or} ({odds}){more}")
    }

    /// Why it is undecided, where a warning says so, after "does not decide".
    pub(super) fn because(&self) -> &'static str {
        match self.why {
            Why::NoRide | Why::Close => "",
            Why::Frozen => ": the sensor repeats one value",
            Why::InHand => ": the sensor may have been in somebody's hand",
            Why::Filter => {
                ", because a phone that filters out slow acceleration would show one ride as these two"
            }
        }
    }

    /// What the user can do about it.
    pub fn advice(&self) -> &'static str {
        let begins = |trips: &[Brief]| trips.iter().any(|trip| trip.start.is_none());
        match self.why {
            Why::NoRide => "record the whole ride, with rest before and after it",
            Why::Frozen => "record again",
            Why::InHand => "let it lie",
            Why::Filter => "record the acceleration with gravity",
            Why::Close if self.is_first && begins(&self.either) != begins(&self.or) => {
                "say how the record begins: --begins rest or --begins motion"
            }
            Why::Close => "record a few seconds of rest before and after the ride",
        }
    }
}

/// How much likelier the first of two explanations is.
fn likelier(log_odds: f64) -> String {
    let odds = libm::exp(log_odds).round();
    if odds < 2.0 {
        "about as likely".to_owned()
    } else {
        format!("the first is {odds} times as likely")
    }
}

fn briefly(trips: &[Brief]) -> String {
    let end = |time: Option<f64>| time.map_or("?".to_owned(), |time| format!("{time:.1}"));
    let told = trips.iter().map(|trip| {
        let direction = match trip.direction {
            Direction::Up => "up",
            Direction::Down => "down",
        };
        format!("{direction} {}-{} s", end(trip.start), end(trip.stop))
    });
    let told: Vec<String> = told.collect();
    if told.is_empty() {
        "no ride".to_owned()
    } else {
        told.join(" and ")
    }
}

/// A line for every kind of event.
pub fn event_lines(events: &[Event]) -> Vec<String> {
    let kinds = [
        (What::Shock, "shocks"),
        (What::Swing, "swings to and fro"),
        (What::Push, "changes of speed that belong to no ride"),
        (What::LevelShift, "shifts of the sensor's level"),
        (What::SlowMotion, "slow motions"),
    ];
    let line = |(what, name): (What, &str)| {
        let times = events.iter().filter(|event| event.what == what);
        let times: Vec<String> = times.map(|event| format!("{:.1}", event.from)).collect();
        let shown = times[..times.len().min(MOST_TIMES)].join(", ");
        let more = match times.len().saturating_sub(MOST_TIMES) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        (!times.is_empty()).then(|| format!("{name} at {shown}{more} s"))
    };
    kinds.into_iter().filter_map(line).collect()
}
