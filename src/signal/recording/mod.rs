//! temporary
/// One reading of the vertical axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// s
    pub time: f64,
    /// m/s²
    pub acceleration: f64,
}
