//! How a recording is read, as the command line has it.

use super::Failure;
use anyhow::anyhow;
use clap::{Args, ValueEnum};
use liftsim::signal::recording::{Axis, Reading, TimeUnit, Unit};

/// How the recording is read. Whatever is left out is found in the file.
#[derive(Debug, Args)]
#[command(next_help_heading = "The recording")]
pub struct ReadingArguments {
    /// The name of the column with the time.
    #[arg(long, value_name = "COLUMN")]
    time: Option<String>,
    /// The name of the column with the vertical acceleration, up positive.
    #[arg(long, value_name = "COLUMN")]
    acceleration: Option<String>,
    /// What time is counted in.
    #[arg(long, value_name = "UNIT", value_enum)]
    time_unit: Option<TimeUnitName>,
    /// What acceleration is counted in; counts are those of a converter, see --scale.
    #[arg(long, value_name = "UNIT", value_enum)]
    unit: Option<UnitName>,
    /// One count of the converter, m/s^2.
    #[arg(long, value_name = "M/S2", allow_negative_numbers = true)]
    scale: Option<f64>,
    /// The count of no acceleration.
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true)]
    offset: Option<f64>,
    /// Which axis is vertical: the nearest to gravity, or the one with the ride, if left out.
    #[arg(long, value_name = "AXIS", value_enum)]
    axis: Option<AxisName>,
    /// Bring the samples to a uniform rate first, Hz.
    #[arg(long, value_name = "HZ")]
    resample: Option<f64>,
    /// The table to read in a zip archive.
    #[arg(long, value_name = "NAME")]
    member: Option<String>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum TimeUnitName {
    S,
    Ms,
    Us,
    Ns,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum UnitName {
    #[value(name = "m/s^2", alias = "m/s2")]
    MetresPerSecondSquared,
    G,
    Mg,
    Counts,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum AxisName {
    X,
    Y,
    Z,
    /// None of them: along gravity.
    Gravity,
}

impl ReadingArguments {
    /// Lays what is given over what a config says.
    pub fn over(self, config: Reading) -> Result<Reading, Failure> {
        Ok(Reading {
            unit: self.unit()?.unwrap_or(config.unit),
            time: self.time.or(config.time),
            acceleration: self.acceleration.or(config.acceleration),
            time_unit: (self.time_unit.map(|unit| match unit {
                TimeUnitName::S => TimeUnit::Seconds,
                TimeUnitName::Ms => TimeUnit::Milliseconds,
                TimeUnitName::Us => TimeUnit::Microseconds,
                TimeUnitName::Ns => TimeUnit::Nanoseconds,
            }))
            .or(config.time_unit),
            axis: self.axis.map_or(config.axis, |axis| match axis {
                AxisName::X => Axis::X,
                AxisName::Y => Axis::Y,
                AxisName::Z => Axis::Z,
                AxisName::Gravity => Axis::Gravity,
            }),
            resample: self.resample.or(config.resample),
            member: self.member.or(config.member),
        })
    }

    fn unit(&self) -> Result<Option<Unit>, Failure> {
        let has_counts = self.scale.is_some() || self.offset.is_some();
        match self.unit {
            None if !has_counts => Ok(None),
            None | Some(UnitName::Counts) => match self.scale {
                Some(scale) => Ok(Some(Unit::Counts {
                    scale,
                    offset: self.offset.unwrap_or(0.0),
                })),
                None => Err(Failure::Input(anyhow!(
                    "--unit counts needs --scale (how many m/s^2 one count is)"
                ))),
            },
            Some(_) if has_counts => Err(Failure::Input(anyhow!(
                "--scale and --offset are for --unit counts (leave them out)"
            ))),
            Some(UnitName::MetresPerSecondSquared) => Ok(Some(Unit::MetresPerSecondSquared)),
            Some(UnitName::G) => Ok(Some(Unit::Gravity)),
            Some(UnitName::Mg) => Ok(Some(Unit::Milligravity)),
        }
    }
}
