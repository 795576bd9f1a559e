//! Where the cage is: the distance of every trip, from the acceleration alone, with a variance that can be trusted.
//!
//! The filter is that of a patent [^1]: position, speed and bias are predicted from the acceleration, and a cage that
//! stands or moves uniformly, both of which an accelerometer shows, gives the filter two pseudo-measurements. Who says when
//! it does makes the difference:
//!
//! - [`Track`]: the trips that a [`Detection`](crate::detection::Detection) finds, which sees the whole record;
//! - [`LiveTrips`]: a detector of uniform motion with the patent's test of standing, sample by sample, a third of a second
//!   late; [`TrackSettings::by_the_words`] is the patent as printed, without looking ahead.
//!
//! Beside it are [other ways](Method): the moment formula, which is the bound, integration with the drift removed, and plain
//! integration.
//!
//! On simulated trips of 3 to 27 m (MPU-6050, 1.6 m/s) the first has an RMS error of 1.04 to 1.14 times the bound, and of 1.24
//! to 1.39 with levelling (`configs/trip_error.toml`). The second is as good without levelling; a creep of 0.08 m/s it may
//! take for a stop, since a gain's error leaves as much.
//!
//! A barometer gives [heights](Climbs) beside them, and which way is up; its clock and the accelerometer's are [brought
//! together](Track::align). [`vibration`] across the vertical is set beside what is usual in the lift.
//!
//! # What the deviation holds
//! The noise of the sensor and of its bias, that of the motion as far as a uniform motion shows it, steps coarser than the noise,
//! and where a trip does not close, something else that the record shows. It does not hold the sensor's gain: a gain of 1.01
//! makes every distance of every trip longer by 1 %.
//!
//! # Where [^1] is read one way among several
//! - It gives no numbers. Noise is given as densities, so that one set serves every rate.
//! - H of both pseudo-measurements, and the form of ξ_d, are lost in its text: they are inferred.
//!
//! [^1]: A patent on the detection of lift motion and abnormal stops by an accelerometer, in Chinese (基于加速度传感器的电梯运
//!     动检测及异常位置停车判断), claims 1 to 3.

mod air;
mod alarm;
mod alignment;
mod calibration;
mod climb;
mod column;
mod course;
mod filter;
pub mod floors;
pub mod fusion;
pub mod gravity;
mod height;
mod height_faults;
mod height_warning;
mod integrals;
mod judged;
mod kept;
mod landing;
mod legs;
mod level;
mod live;
pub mod map;
mod noise;
mod phases;
pub mod quality;
mod record;
mod report;
mod rested;
mod rides;
mod settings;
mod settled;
mod shaken;
mod steps;
mod still;
#[cfg(test)]
mod tests;
mod travelled;
mod uniform;
mod unseen;
mod vertical;
pub mod vibration;
mod warning;
mod watch;

pub use air::Air;
pub use alarm::Alarm;
pub use alignment::{Alignment, AlignmentError};
pub use calibration::{Calibration, calibrated};
pub use climb::{Climb, Standing};
pub use course::{Course, Place};
pub use filter::{TripFilter, Uncertain, Update};
pub use height::Climbs;
pub use height_warning::HeightWarning;
pub use integrals::{integrated, moments};
pub use judged::{Beyond, QualityReport, QualityWarning};
pub use kept::KeptError;
pub use level::{Level, Scatter};
pub use live::{LiveTrip, LiveTrips};
pub use noise::{Densities, Deviations, Noise};
pub use phases::{Method, Phases};
pub use record::{Track, Tracked, Unknown};
pub use report::{Barometric, TrackReport};
pub use settings::{TrackSettings, UniformSettings};
pub use shaken::{Exceedance, Placed, Shaken, Used, VibrationError, VibrationReport};
pub use steps::{Step, Steps};
pub use travelled::Travelled;
pub use uniform::UniformDetector;
pub use unseen::Unseen;
pub use vertical::{ByRules, Motion, Move, Moves, Rules, Vertical, VerticalFilter};
pub use warning::Warning;
pub use watch::{Found, Happened, Watch};
