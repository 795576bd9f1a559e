//! The unit of accelerations where neither the file nor the reader says it: assumed aloud, or refused.

use super::error::RecordingProblem;
use super::layout::{Format, Layout};
use super::unit::{GRAVITY, Unit};
use super::vertical::Windows;
use super::warning::{BEYOND_GRAVITY, Warning};

/// Counts per g of the usual digital sensors, and mg.
const PER_G: [f64; 8] = [
    256.0, 512.0, 1000.0, 1024.0, 2048.0, 4096.0, 8192.0, 16384.0,
];

/// The largest share by which a resting sensor may be off.
const OFF: f64 = 0.12;

/// What is taken for the unit.
#[derive(Debug)]
pub(super) struct Assumed {
    pub unit: Unit,
    pub warning: Option<Warning>,
    /// Whether up reads negative, as in iOS, in a record without gravity.
    pub is_reversed: bool,
}

/// The unit as stated, or by the mean length of the readings.
///
/// # Errors
/// If the mean is that of no known unit.
pub(super) fn unit(layout: &Layout, windows: &Windows) -> Result<Assumed, RecordingProblem> {
    let mean = windows.length();
    let is_near = |unit: f64| (mean / unit - 1.0).abs() <= OFF;
    let assumed = |unit, warning| Assumed {
        unit,
        warning,
        is_reversed: false,
    };
    let by_mean = |unit, name: &str| {
        let unit_name = name.to_owned();
        let warning = Warning::UnitAssumed {
            mean,
            unit: unit_name,
        };
        Ok(assumed(unit, Some(warning)))
    };
    if let Some(unit) = layout.unit {
        let is_ios = layout.format == Format::SensorLogger && unit == Unit::Gravity;
        return Ok(Assumed {
            is_reversed: is_ios && !is_near(1.0),
            ..assumed(unit, None)
        });
    }
    if is_near(1.0) {
        return by_mean(Unit::Gravity, "readings in g");
    }
    if mean > BEYOND_GRAVITY {
        let distance = |unit: &&f64| (mean / **unit - 1.0).abs();
        let nearest = PER_G
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        return match nearest.filter(|unit| is_near(**unit)) {
            Some(1000.0) => by_mean(Unit::Milligravity, "readings in mg"),
            Some(unit) => {
                let scale = GRAVITY / unit;
                by_mean(
                    Unit::Counts { scale, offset: 0.0 },
                    &format!("{unit} counts per g"),
                )
            }
            None => Err(RecordingProblem::UnknownCounts {
                mean,
                scale: GRAVITY / mean,
            }),
        };
    }
    if layout.format == Format::SensorLogger && mean < 0.5 {
        return Ok(sensor_logger(windows.strength()));
    }
    Ok(assumed(Unit::MetresPerSecondSquared, None))
}

/// On Android it writes m/s², on iOS g with up negative. Lifts accelerate by 0.3 to 1.5 m/s², 0.03 to 0.15 g.
fn sensor_logger(strength: f64) -> Assumed {
    let (metres, g) = (Unit::MetresPerSecondSquared, Unit::Gravity);
    let is_ios = strength < 0.2;
    let (unit, other) = if is_ios { (g, metres) } else { (metres, g) };
    Assumed {
        unit,
        warning: Some(Warning::PlatformAssumed {
            unit,
            other,
            platform: if is_ios {
                "iOS, with up negative"
            } else {
                "Android"
            },
        }),
        is_reversed: is_ios,
    }
}
