//! Whole recordings, from small texts in memory and, if available, from real lifts.

use super::*;
use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

mod arbitrary;
mod archives;
mod formats;
mod pressure;
mod real;
mod refusals;
mod vertical;
mod workbooks;

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

fn archive(members: &[(&str, &str)]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in members {
        writer
            .start_file(*name, SimpleFileOptions::default())
            .unwrap();
        writer.write_all(text.as_bytes()).unwrap();
    }
    writer.finish().unwrap().into_inner()
}
