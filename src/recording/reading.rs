//! Options for reading a recording; unset options are found from the file.

use super::axis::Axis;
use super::moment::When;
use super::unit::{TimeUnit, Unit};
use serde::{Deserialize, Serialize};

/// Options for reading a file. By default all are found from the file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// The name of the time column. Columns of a file without a header are named "1", "2", ….
    pub time: Option<String>,
    /// The name of the one column that holds the vertical acceleration, or a barometer's pressure.
    pub acceleration: Option<String>,
    /// The unit of time.
    pub time_unit: Option<TimeUnit>,
    /// The unit of acceleration.
    pub unit: Unit,
    /// The vertical axis, if a file has three axes.
    pub axis: Axis,
    /// Whether to turn the vertical upside down in the end.
    pub invert: bool,
    /// Whether to keep what three axes read across the vertical.
    pub across: bool,
    /// Read from this time on.
    pub from: Option<When>,
    /// Read up to this time.
    pub to: Option<When>,
    /// The rate of the rows, Hz, whose times are then not read.
    pub rate: Option<f64>,
    /// The rate of a uniform grid to resample to, Hz; `None` leaves the signal as recorded.
    pub resample: Option<f64>,
    /// The table to read within a zip archive or a workbook; the sensor within a JSON export.
    pub member: Option<String>,
}

impl Reading {
    /// −1 if up is to be down.
    pub(super) fn sign(&self) -> f64 {
        let is_down = matches!(self.axis, Axis::Along { is_down: true, .. });
        if is_down != self.invert { -1.0 } else { 1.0 }
    }
}
