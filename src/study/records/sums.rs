//! The sums of the records of a class, and what follows from them.

use super::detect::Told;
use super::table::Watch;
use super::watched::{Heading, Watched};
use crate::counts::{Fixed, Shape, Sums, Values};
use crate::lift::MOST_TRIPS;
use crate::rule::{OutOfRange, Rule};
use crate::stats::tally::Tally;
use crate::study::estimate::{Estimate, Mean, delays, rate, share};

const HOUR: f64 = 3600.0;

/// Shares of time. The lengths hold a pair for the time and one for the part of each, and after these their products.
const TIMES: [&str; 3] = ["known", "directed", "misdirected"];

/// A time in all records, and a part of it, s.
struct Times {
    whole: f64,
    part: f64,
}

impl Times {
    fn of(sums: &Sums, share: usize) -> Self {
        let [whole, part] = [4 * share, 4 * share + 2].map(|at| sums.lengths[at].value());
        Self { whole, part }
    }
}

impl Watch {
    /// The sums of a record.
    pub fn shape(self) -> Shape {
        let (one, trips) = (Some(1), Some(MOST_TRIPS));
        match self {
            Self::Detect => Shape {
                most: vec![trips, trips, trips, trips, None, one, trips, trips],
                ..Shape::default()
            },
            Self::Monitor => Shape {
                most: vec![None, one, trips, trips, None, None, one, one],
                lengths: 5 * TIMES.len(),
                values: vec![MOST_TRIPS; 2],
            },
        }
    }

    /// Checks that records can give these sums.
    ///
    /// # Errors
    /// If none can.
    pub fn check(self, sums: &Sums) -> Result<(), OutOfRange> {
        let counts: Vec<f64> = sums.counts.iter().map(|count| *count as f64).collect();
        let within = |name, part: f64, most: f64| Rule::Within(0.0, most, "").check(name, &part);
        match self {
            Self::Detect => {
                within("false_records", counts[5], counts[4])?;
                within("trips between rests", counts[6], counts[..4].iter().sum())?;
                within("found_between_rests", counts[7], counts[6].min(counts[0]))
            }
            Self::Monitor => {
                let [starts, stops] = [0, 1].map(|at| sums.values[at].count(|_| true));
                let [known, right, wrong] = [0, 1, 2].map(|share| Times::of(sums, share));
                within("records of rest_in_motion", counts[1], counts[0])?;
                within("slack_missed", counts[3], counts[2])?;
                within("false_records", counts[6], counts[5])?;
                // A stretch of `rest` ends between two samples.
                within("known", known.part, 1.1 * known.whole + 1.0)?;
                let directed = right.part + wrong.part;
                within("directed and misdirected", directed, right.whole + 1e-6)?;
                let (starts, stops) = (starts as f64, stops as f64);
                Rule::Within(starts, starts, "").check("stop_delays", &stops)
            }
        }
    }

    /// The outcomes of so many records.
    pub fn estimates(self, sums: &Sums, records: u64, confidence: f64) -> Vec<Estimate> {
        let tally = |hits, trials| Tally { hits, trials };
        let of_records = |name, hits| share(name, tally(hits, records), "records", confidence);
        let counts = &sums.counts;
        match self {
            Self::Detect => {
                let trips = counts[..4].iter().sum();
                let of_trips =
                    |name, at: usize| share(name, tally(counts[at], trips), "trips", confidence);
                vec![
                    of_trips("found", 0),
                    of_trips("undecided", 1),
                    of_trips("misplaced", 2),
                    of_trips("missed_silently", 3),
                    rate(
                        "false_trips",
                        counts[4],
                        records as f64,
                        "records",
                        confidence,
                    ),
                    of_records("false_records", counts[5]),
                    share(
                        "found_between_rests",
                        tally(counts[7], counts[6]),
                        "trips between rests",
                        confidence,
                    ),
                ]
            }
            Self::Monitor => {
                let stood = Times::of(sums, 0).whole / HOUR;
                let slack = tally(counts[3], counts[2]);
                let mut estimates = vec![
                    of_records("rest_in_motion", counts[1]),
                    plain("rest_in_motion_ms", counts[0], records as f64, "records"),
                    share("slack_missed", slack, "turns of the drum", confidence),
                    rate(
                        "false_slack",
                        counts[4],
                        records as f64,
                        "records",
                        confidence,
                    ),
                    rate("false_rides", counts[5], stood, "hours", confidence),
                    of_records("false_records", counts[6]),
                    of_records("wrong_way", counts[7]),
                ];
                let times = (0..TIMES.len()).map(|share| of_time(sums, share, records, confidence));
                estimates.extend(times);
                estimates.extend(delays("start_delay", &sums.values[0], confidence));
                estimates.extend(delays("stop_delay", &sums.values[1], confidence));
                estimates
            }
        }
    }
}

/// A share of the time, by sums over all records. Where there is none of it, the interval is that of the share of records.
fn of_time(sums: &Sums, which: usize, records: u64, confidence: f64) -> Estimate {
    let [whole, part] = [0, 1].map(|it| Mean::new(sums, 2 * which + it, records, confidence));
    let product = sums.lengths[4 * TIMES.len() + which].value() / records as f64;
    let name = TIMES[which];
    let of = if part.value > 0.0 && whole.value > 0.0 {
        let ratio = part.ratio(whole, product, records, confidence);
        ratio.named(name, records, "hours")
    } else {
        let none = Tally {
            hits: 0,
            trials: if whole.value > 0.0 { records } else { 0 },
        };
        share(name, none, "hours", confidence)
    };
    Estimate {
        count: 0,
        exposure: Times::of(sums, which).whole / HOUR,
        low: of.low.max(0.0),
        high: of.high.min(1.0),
        ..of
    }
}

/// A mean without an interval.
fn plain(outcome: &str, count: u64, exposure: f64, unit: &'static str) -> Estimate {
    Estimate {
        outcome: outcome.to_owned(),
        count,
        exposure,
        unit,
        value: count as f64 / exposure,
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    }
}

impl From<Told> for Sums {
    fn from(told: Told) -> Self {
        Self::of(&[
            told.found,
            told.undecided,
            told.misplaced,
            told.missed,
            told.false_trips,
            u64::from(told.false_trips > 0),
            told.between_rests,
            told.found_between_rests,
        ])
    }
}

impl From<Watched> for Sums {
    fn from(watched: Watched) -> Self {
        let values = [&watched.start_delays, &watched.stop_delays].map(|delays| {
            let mut values = Values::default();
            delays.iter().for_each(|delay| values.push(*delay));
            values
        });
        let Heading {
            moved,
            right,
            wrong,
        } = watched.heading;
        let mut sums = Self {
            counts: vec![
                watched.rest_in_motion,
                u64::from(watched.rest_in_motion > 0),
                watched.slack_owed,
                watched.slack_missed,
                watched.false_slack,
                watched.false_rides,
                u64::from(watched.false_rides > 0),
                u64::from(wrong > 0.0),
            ],
            lengths: vec![Fixed::default(); 5 * TIMES.len()],
            values: values.into(),
        };
        let times = [
            (watched.stood, watched.known),
            (moved, right),
            (moved, wrong),
        ];
        for (share, (whole, part)) in times.into_iter().enumerate() {
            sums.note(2 * share, whole);
            sums.note(2 * share + 1, part);
            sums.lengths[4 * times.len() + share] = Fixed::new(whole * part);
        }
        sums
    }
}
