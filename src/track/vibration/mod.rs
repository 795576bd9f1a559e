//! Vibration across the vertical, against what is usual in a lift: a baseline, a guard line, and where the car was when it
//! was crossed.
//!
//! The monitor of [^1] takes the energy of horizontal vibration, learns its mean until it has settled,
//! draws a guard line above it and looks for what is beyond, at which position. What is done here:
//!
//! - The [energy](Window) of a window of 0.5 s is the mean square of the acceleration in two directions across the vertical, each
//!   about its own mean in the window, m²/s⁴. So a tilted sensor, its offset and what it shows of the drive's acceleration
//!   hardly count; of a swing of 1 Hz three fifths are left, of 2 Hz all.
//! - A whole trip is looked at from 0.5 s after its start to 0.5 s before its stop, or up to its creep to the landing: both
//!   changes of speed are in it, since the directions across the vertical hold nothing of them; brakes and doors are not.
//! - A [`Baseline`] learns trip by trip. It has settled when it holds enough windows for the guard line, and the standard
//!   error of its mean is small where trips are taken as the units, since windows of one trip are alike.
//! - The [guard line](Guard) is an order statistic of all windows.
//!
//! `configs/baseline.toml` and `configs/vibration.toml` measure all of it.
//!
//! # What the guard line promises
//! Let n windows be learnt, and let the next be exchangeable with them. Then it is equally likely to have any rank among all
//! n + 1, and the probability that it is above the k-th largest is k/(n + 1), whatever their law. With k = ⌊α (n + 1)⌋ that is
//! at most α, and more than α/2: where k = 0, n is too small for such an α.
//!
//! Windows of one trip are like each other, those of another trip are not, wherever trips differ: in load, in
//! direction, in who stands beside the sensor. What is exchangeable then is whole trips. Of T + 1 of them each is equally likely
//! to hold the largest energy, so of trips judged by the largest energy of T others 1 in T + 1 alarms, whatever is within them;
//! and what a line learnt from T − 1 trips does to another is shown without bias by leaving each of T trips out in turn. Both
//! [rates](GuardLine) are reported beside the one asked for: of trips of 30 windows up to 3 in 100 have one in a thousand.
//!
//! # Where [^1] is read one way among several
//! - (20) is the mean of all energies so far, though it is called a moving mean.
//! - (21) is in percent. Where the mean before is zero nothing has been measured, and there is no value.
//! - (22) takes the arc tangent of a slope, which has no unit only if x has that of the error: x counts windows here, and k is
//!   in degrees. The slope is over m windows, as printed; the text says m − 1. m and what k ≈ 0 means are not given.
//! - The energy's unit is printed as m⁴/s².
//!
//! [^1]: The monitor with accelerometer and barometer, in Chinese (楊昱等, 太原理工大學學報), (20)–(22) and Fig. 10.

mod baseline;
mod energy;
mod file;
mod guard;
mod stop;
#[cfg(test)]
mod tests;

pub use baseline::{Baseline, Learning};
pub use energy::{LEAST_RATE, WINDOW, Window, part, windows};
pub use guard::{Guard, GuardLine};
pub use stop::{PrintedStop, Stop};
