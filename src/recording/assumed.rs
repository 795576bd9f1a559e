//! The unit of accelerations where neither the file nor the reader says it: assumed aloud, or refused.

use super::error::RecordingProblem;
use super::layout::Layout;
use super::unit::{GRAVITY, Unit};
use super::warning::{BEYOND_GRAVITY, Warning};
use super::windows::Windows;

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
    let distance = |unit: f64| (mean / unit - 1.0).abs();
    let is_logger = layout.format == "Sensor Logger";
    let (unit, name) = if let Some(unit) = layout.unit {
        return Ok(Assumed {
            unit,
            warning: None,
            is_reversed: is_logger && unit == Unit::Gravity && distance(1.0) > OFF,
        });
    } else if distance(1.0) <= OFF {
        (Unit::Gravity, Some("readings in g".to_owned()))
    } else if mean > BEYOND_GRAVITY {
        let nearest = (PER_G.into_iter()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        let Some(counts) = nearest.filter(|counts| distance(*counts) <= OFF) else {
            let scale = GRAVITY / mean;
            return Err(RecordingProblem::UnknownCounts { mean, scale });
        };
        let (scale, offset) = (GRAVITY / counts, 0.0);
        match counts {
            1000.0 => (Unit::Milligravity, Some("readings in mg".to_owned())),
            _ => (
                Unit::Counts { scale, offset },
                Some(format!("{counts} counts per g")),
            ),
        }
    } else if is_logger && mean < 0.5 {
        return Ok(sensor_logger(windows.strength()));
    } else {
        (Unit::MetresPerSecondSquared, None)
    };
    Ok(Assumed {
        unit,
        warning: name.map(|unit| Warning::UnitAssumed { mean, unit }),
        is_reversed: false,
    })
}

/// On Android it writes m/s², on iOS g with up negative. Lifts accelerate by 0.3 to 1.5 m/s², 0.03 to 0.15 g.
fn sensor_logger(strength: f64) -> Assumed {
    let (metres, g) = (Unit::MetresPerSecondSquared, Unit::Gravity);
    let is_ios = strength < 0.2;
    let (unit, other, platform) = if is_ios {
        (g, metres, "iOS, with up negative")
    } else {
        (metres, g, "Android")
    };
    Assumed {
        unit,
        warning: Some(Warning::PlatformAssumed {
            unit,
            other,
            platform,
        }),
        is_reversed: is_ios,
    }
}
