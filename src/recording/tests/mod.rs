//! Whole recordings, from small texts in memory and, if available, from real lifts.

use super::*;

mod arbitrary;
mod archives;
mod formats;
mod real;
mod refusals;

fn open(text: &str) -> Recording {
    open_as(text, &Reading::default())
}

fn open_as(text: &str, reading: &Reading) -> Recording {
    Recording::from_bytes("ride.csv", text.as_bytes(), reading).unwrap()
}

fn refused(text: impl AsRef<[u8]>) -> String {
    refused_as(text, &Reading::default())
}

fn refused_as(text: impl AsRef<[u8]>, reading: &Reading) -> String {
    let refused = Recording::from_bytes("ride.csv", text.as_ref(), reading);
    refused.unwrap_err().to_string()
}

fn read(recording: &Recording) -> Vec<(f64, f64)> {
    let pair = |sample: &Sample| (sample.time, sample.acceleration);
    recording.samples().iter().map(pair).collect()
}
