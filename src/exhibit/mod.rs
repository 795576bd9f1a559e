//! Experiments that are no sweep: each comes to rows of its own (`points.csv`), from which its picture
//! is drawn, and where it has any to single numbers (`quantities.csv`).
//!
//! Everything here is a function of the seed and the config; trials run in parallel, and what they
//! come to is added up in their order.

pub mod autocorrelation;
pub mod impulse_law;
pub mod independence;
pub mod layout;
pub mod operating_point;
pub mod region;
pub mod ride;
pub mod trace;

use crate::config::{ConfigError, ExhibitConfig, ExhibitKind};
use crate::results::{Quantity, csv_bytes};
use serde::de::DeserializeOwned;

/// What an exhibit comes to.
#[derive(Clone, Debug, PartialEq)]
pub struct Exhibit {
    /// What the picture is drawn from.
    pub rows: Rows,
    /// Single numbers.
    pub quantities: Vec<Quantity>,
}

/// The rows of an exhibit, each kind with its own columns.
#[derive(Clone, Debug, PartialEq)]
pub enum Rows {
    /// One per lag.
    Autocorrelation(Vec<autocorrelation::Row>),
    /// One per sample.
    Trace(Vec<trace::Row>),
    /// One per stretch of samples.
    Layout(Vec<layout::Row>),
    /// One per rule and T.
    Region(Vec<region::Row>),
    /// One per sizes, W and T.
    Independence(Vec<independence::Row>),
    /// One per ν and sample.
    ImpulseLaw(Vec<impulse_law::Row>),
    /// One per size and power.
    OperatingPoint(Vec<operating_point::Row>),
    /// One per curve, value of the axis and outcome.
    Ride(Vec<ride::Row>),
}

/// Computes an exhibit on the current thread pool.
///
/// # Errors
/// Where a region cannot be designed, or a search meets a size, a motion or a record that cannot be.
pub fn compute(config: &ExhibitConfig) -> Result<Exhibit, ConfigError> {
    let (rows, quantities) = match &config.kind {
        ExhibitKind::Autocorrelation { lags, length } => {
            let rows = autocorrelation::rows(config, *lags, *length);
            let quantities = autocorrelation::quantities(config, &rows);
            (Rows::Autocorrelation(rows), quantities)
        }
        ExhibitKind::Trace(trace) => {
            let ride = trace::Ride::new(config, trace);
            (Rows::Trace(ride.rows()), ride.quantities())
        }
        ExhibitKind::Layout => (Rows::Layout(layout::rows(&config.scenario)), Vec::new()),
        ExhibitKind::Region { rules } => {
            let rows = region::rows(&config.scenario, rules);
            let rows = rows.map_err(|error| config.refuse_region(error))?;
            (Rows::Region(rows), Vec::new())
        }
        ExhibitKind::Independence { sizes } => {
            let rows = independence::rows(sizes);
            let quantities = independence::quantities(&rows);
            (Rows::Independence(rows), quantities)
        }
        ExhibitKind::ImpulseLaw { nu, length } => {
            let rows = impulse_law::rows(config, nu, *length);
            let quantities = impulse_law::quantities(&rows, config.confidence);
            (Rows::ImpulseLaw(rows), quantities)
        }
        ExhibitKind::OperatingPoint(search) => {
            let rows = operating_point::rows(config, search);
            let rows = rows.map_err(|problem| config.refuse(problem))?;
            let quantities = operating_point::quantities(&rows, search);
            (Rows::OperatingPoint(rows), quantities)
        }
        ExhibitKind::Ride(study) => {
            let rows = ride::rows(config, study);
            let quantities = ride::quantities(study, &rows);
            (Rows::Ride(rows), quantities)
        }
    };
    Ok(Exhibit { rows, quantities })
}

impl Rows {
    /// As `points.csv` has them.
    pub fn csv(&self) -> Vec<u8> {
        match self {
            Self::Autocorrelation(rows) => csv_bytes(rows),
            Self::Trace(rows) => csv_bytes(rows),
            Self::Layout(rows) => csv_bytes(rows),
            Self::Region(rows) => csv_bytes(rows),
            Self::Independence(rows) => csv_bytes(rows),
            Self::ImpulseLaw(rows) => csv_bytes(rows),
            Self::OperatingPoint(rows) => csv_bytes(rows),
            Self::Ride(rows) => csv_bytes(rows),
        }
    }

    /// Reads what [`Rows::csv`] wrote for an exhibit of this kind.
    ///
    /// # Errors
    /// Where a column is missing or holds something else.
    pub fn from_csv(kind: &ExhibitKind, bytes: &[u8]) -> Result<Self, csv::Error> {
        fn read<R: DeserializeOwned>(bytes: &[u8]) -> Result<Vec<R>, csv::Error> {
            csv::Reader::from_reader(bytes).deserialize().collect()
        }
        match kind {
            ExhibitKind::Autocorrelation { .. } => read(bytes).map(Self::Autocorrelation),
            ExhibitKind::Trace(_) => read(bytes).map(Self::Trace),
            ExhibitKind::Layout => read(bytes).map(Self::Layout),
            ExhibitKind::Region { .. } => read(bytes).map(Self::Region),
            ExhibitKind::Independence { .. } => read(bytes).map(Self::Independence),
            ExhibitKind::ImpulseLaw { .. } => read(bytes).map(Self::ImpulseLaw),
            ExhibitKind::OperatingPoint(_) => read(bytes).map(Self::OperatingPoint),
            ExhibitKind::Ride(_) => read(bytes).map(Self::Ride),
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Autocorrelation(rows) => rows.len(),
            Self::Trace(rows) => rows.len(),
            Self::Layout(rows) => rows.len(),
            Self::Region(rows) => rows.len(),
            Self::Independence(rows) => rows.len(),
            Self::ImpulseLaw(rows) => rows.len(),
            Self::OperatingPoint(rows) => rows.len(),
            Self::Ride(rows) => rows.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
