//! Reasons to distrust heights.

#![allow(missing_docs, reason = "what a name says is not said again")]

use super::alignment::Alignment;

/// A reason to distrust heights.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HeightWarning {
    #[error(
        "ride {ride}: by the barometer it went {height:+.1} m, by the accelerometer {distance:+.1} m (look at the barometer: did it \
         freeze, jump, or have another clock? or was --temperature wrong?)"
    )]
    Unlike {
        ride: usize,
        height: f64,
        distance: f64,
    },
    #[error(
        "ride {0}: no height, the barometer has no reading at rest just before it or after it, or only some seconds are recorded there (record \
         both for as long, and the barometer every second)"
    )]
    Missing(usize),
    #[error(
        "by the barometer up is down in this recording (look at --axis and --invert, and at the sensor's mounting)"
    )]
    UpsideDown,
    #[error(
        "ride {ride}: no height, the barometer is frozen: it reads the same all the way{} (restart the sensor, or choose another \
         with --barometer)",
        .distance.map_or(String::new(), |it| format!(", {it:+.1} m by the accelerometer"))
    )]
    Frozen { ride: usize, distance: Option<f64> },
    #[error(
        "ride {ride}: the barometer has no reading for {seconds:.0} s of it; the height is that between the rests (record it without \
         a break)"
    )]
    Silent { ride: usize, seconds: f64 },
    #[error(
        "ride {ride}: at rest beside it the barometer jumps by {metres:+.1} m; the readings nearest to the ride count (keep it away \
         from doors and fans)"
    )]
    Jump { ride: usize, metres: f64 },
    #[error(
        "by the rides the accelerometer's clock is {:.2} ± {:.2} s ahead of the barometer's, and not {said:.2} s as the clocks say: the \
         rides are believed (--barometer-ahead {said:.2} believes the clocks)",
        .by_rides.ahead, .by_rides.deviation
    )]
    Clocks { by_rides: Alignment, said: f64 },
}

impl HeightWarning {
    pub(super) fn is_frozen(&self, of: usize) -> bool {
        matches!(self, Self::Frozen { ride, .. } if *ride == of)
    }
}
