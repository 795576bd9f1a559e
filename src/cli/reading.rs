//! The flags that say how a recording is read.

use super::Failure;
use super::completions::words;
use clap::Args;
use liftsim::recording::{Axis, Reading, TimeUnit, Unit, When};

/// How the recording is read. What is left out is found in the file.
#[derive(Debug, Args)]
#[command(next_help_heading = "The recording")]
pub struct ReadingArguments {
    #[command(flatten)]
    columns: ColumnArguments,
    /// Read from this time on: s as times are printed, or of a recording with dates a moment such as 2026-11-30T14:05:00.
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    from: Option<When>,
    /// Read up to this time.
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    to: Option<When>,
    /// Rows per second, where they are evenly spaced; their times are then not read.
    #[arg(long, value_name = "HZ")]
    rate: Option<f64>,
    /// Resample to this uniform rate first, Hz.
    #[arg(long, value_name = "HZ")]
    resample: Option<f64>,
    /// The table to read in a zip archive, the sheet in a workbook, or the sensor in JSON.
    #[arg(long, value_name = "NAME")]
    member: Option<String>,
}

/// The columns to read, of a file or a stream, and their units.
#[derive(Debug, Args)]
#[command(next_help_heading = "The recording")]
pub struct ColumnArguments {
    /// The name of the column with the time.
    #[arg(long, value_name = "COLUMN")]
    time: Option<String>,
    /// The name of the column with the vertical acceleration, up positive.
    #[arg(long, value_name = "COLUMN")]
    acceleration: Option<String>,
    /// The unit of time: s, ms, us or ns.
    #[arg(long, value_name = "UNIT", add = words(["s", "ms", "us", "ns"]))]
    time_unit: Option<TimeUnit>,
    #[command(flatten)]
    unit: UnitArguments,
    /// Which axis is vertical: x, y, z, -x, -y, -z; of a file also gravity (along it), or auto (along gravity, or
    /// else along the pulses of the ride) [default: auto].
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true,
          add = words(["x", "y", "z", "-x", "-y", "-z", "gravity", "auto"]))]
    axis: Option<Axis>,
    /// Turn the vertical upside down, where gravity does not show which way is up.
    #[arg(long)]
    invert: bool,
}

/// The unit of acceleration.
#[derive(Debug, Args)]
pub struct UnitArguments {
    /// The unit of acceleration: m/s^2, g, mg, or counts of a converter, see --scale.
    #[arg(long, value_name = "UNIT", add = words(["m/s^2", "g", "mg", "counts"]))]
    unit: Option<String>,
    /// One count of the converter, m/s^2.
    #[arg(long, value_name = "M/S2", allow_negative_numbers = true)]
    scale: Option<f64>,
    /// The count at zero acceleration.
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true)]
    offset: Option<f64>,
}

impl UnitArguments {
    /// The unit, if one is given.
    pub fn given(&self) -> Result<Option<Unit>, Failure> {
        Unit::told(self.unit.as_deref(), self.scale, self.offset).map_err(Failure::input)
    }
}

impl ReadingArguments {
    /// Lays the flags over a config.
    pub fn over(&self, config: &Reading) -> Result<Reading, Failure> {
        Ok(Reading {
            from: self.from.or(config.from),
            to: self.to.or(config.to),
            rate: self.rate.or(config.rate),
            resample: self.resample.or(config.resample),
            member: self.member.clone().or(config.member.clone()),
            ..self.columns.over(config)?
        })
    }
}

impl ColumnArguments {
    /// Lays the flags over a config.
    pub fn over(&self, config: &Reading) -> Result<Reading, Failure> {
        Ok(Reading {
            time: self.time.clone().or(config.time.clone()),
            acceleration: self.acceleration.clone().or(config.acceleration.clone()),
            time_unit: self.time_unit.or(config.time_unit),
            unit: self.unit.given()?.unwrap_or(config.unit),
            axis: self.axis.unwrap_or(config.axis),
            invert: self.invert || config.invert,
            ..config.clone()
        })
    }
}
