//! The energy of horizontal vibration, window by window.

use crate::detection::Trip;
use crate::recording::Sample;
use std::ops::Range;

/// The length of a window, s.
pub const WINDOW: f64 = 0.5;

/// The lowest rate of a record with vibration in it, Hz.
pub const LEAST_RATE: f64 = 20.0;

/// Left out at either end of a trip, s: brakes and doors.
const BOUNDARY: f64 = 0.5;

/// A window with less than this share of its samples says nothing.
const LEAST_SHARE: f64 = 0.8;

/// A window of a trip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// s.
    pub from: f64,
    /// s.
    pub to: f64,
    /// m²/s⁴.
    pub energy: f64,
    /// When the car was shaken most in it, s.
    pub peak: f64,
}

/// When a whole trip is looked at, s; none of one whose start or stop is not recorded.
pub fn part(trip: &Trip) -> Option<Range<f64>> {
    let (start, stop) = trip.start.zip(trip.stop)?;
    let creep = trip.levelling.unwrap_or(stop);
    Some(start + BOUNDARY..creep.min(stop - BOUNDARY))
}

/// The windows of a time, s, in what two directions across the vertical read at about this rate, Hz. Left out are what
/// remains at the end, windows with a hole, and those in which one value is repeated.
pub fn windows(across: &[Vec<Sample>; 2], rate: f64, within: &Range<f64>) -> Vec<Window> {
    let number = ((within.end - within.start) / WINDOW + 1e-9)
        .floor()
        .max(0.0) as usize;
    let least = (LEAST_SHARE * WINDOW * rate).ceil() as usize;
    let window = |place: usize| {
        let from = within.start + WINDOW * place as f64;
        let to = from + WINDOW;
        let (mut energy, mut largest, mut peak) = (0.0, 0.0, from);
        for direction in across {
            let first = direction.partition_point(|it| it.time < from);
            let end = direction.partition_point(|it| it.time < to);
            let part = &direction[first..end];
            if part.len() < least.max(2) {
                return None;
            }
            let number = part.len() as f64;
            let mean = part.iter().map(|it| it.acceleration).sum::<f64>() / number;
            let squares = part.iter().map(|it| {
                let off = it.acceleration - mean;
                (off * off, it.time)
            });
            for (square, time) in squares {
                energy += square / number;
                if square > largest {
                    (largest, peak) = (square, time);
                }
            }
        }
        (energy > 0.0 && energy.is_finite()).then_some(Window {
            from,
            to,
            energy,
            peak,
        })
    };
    (0..number).filter_map(window).collect()
}
