//! What a recording consists of.

/// One reading of the vertical axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// s, by the file's clock.
    pub time: f64,
    /// m/s², up positive; bias and any gravity are left in.
    pub acceleration: f64,
}
