//! A pulse of acceleration.

use std::ops::Range;

/// A pulse of acceleration.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulse {
    /// Its blocks.
    pub blocks: Range<usize>,
    /// s
    pub from: f64,
    /// s
    pub to: f64,
    /// Change of speed, m/s, up positive.
    pub change: f64,
    /// Its standard deviation, m/s.
    pub deviation: f64,
    /// Whether it is stronger than any acceleration of a lift: a shock.
    pub is_violent: bool,
    /// Whether it is a long swing to and fro.
    pub is_swing: bool,
    /// What the level shifts by during it, m/s²; 0 for what the record shows above its level.
    pub shift: f64,
    /// Whether an end of a stretch cuts it off and it looks like another level: abrupt, or weak.
    pub is_level: bool,
}

impl Pulse {
    /// A plain change of speed of a record that is not kept, from a time to another, s, with its deviation, m/s.
    pub fn passing((from, to): (f64, f64), change: f64, deviation: f64) -> Self {
        Self {
            blocks: 0..0,
            from,
            to,
            change,
            deviation,
            is_violent: false,
            is_swing: false,
            shift: 0.0,
            is_level: false,
        }
    }

    /// s
    pub fn seconds(&self) -> f64 {
        self.to - self.from
    }
}

/// A level changes within this time, s.
pub(crate) const AT_ONCE: f64 = 0.1;

/// By this share of what there is afterwards, and by so many deviations of its noise.
const MOST_OF: f64 = 0.7;
const NOISES: f64 = 4.0;

/// Whether no lift changes its acceleration so much within that time, m/s², where the pulse comes to this; the change has a
/// deviation from noise.
pub(crate) fn is_at_once(change: f64, value: f64, noise: f64) -> bool {
    change.abs() > (MOST_OF * value.abs()).max(NOISES * noise)
}
