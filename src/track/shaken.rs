//! How the rides of a record vibrate beside what is usual in their lift, and what a report says of it.

use super::record::{Track, Tracked};
use super::vibration::{Baseline, GuardLine, LEAST_RATE, Learning, Window, part, windows};
use crate::explain::Faults;
use crate::recording::{Recording, Sample};
use serde::Serialize;
use serde_json::Value;

/// How far the rate of a record may be from that of a baseline, as a share of it.
const LIKE: f64 = 0.1;

/// Why vibration is not set beside a baseline.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum VibrationError {
    #[error(
        "--baseline: vibration is looked at across the vertical, and only one axis was read (record all three; --acceleration \
         reads but one)"
    )]
    Axes,
    #[error(
        "--baseline: a record of {0:.1} Hz holds no vibration (record {LEAST_RATE} Hz or more)"
    )]
    Rate(f64),
    #[error(
        "--baseline: the sensor's steps of {0:.3} m/s^2 are coarser than what is looked at (choose a finer range, or another \
         sensor)"
    )]
    Coarse(f64),
    #[error(
        "--baseline: it was learnt at {baseline:.1} Hz, and this record of {record:.1} Hz holds other vibration (begin another \
         file for such records, or record at that rate)"
    )]
    Unlike { baseline: f64, record: f64 },
}

/// What was done with a ride.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Used {
    /// The baseline learnt it.
    Learnt,
    /// The baseline had learnt it before.
    Known,
    /// It was set beside the baseline.
    Judged,
}

/// A window and where the car was when it was shaken most.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Placed {
    /// s.
    pub time: f64,
    /// m²/s⁴.
    pub energy: f64,
    /// From the stop before, m, up positive; none of a ride whose distance is not known.
    pub position: Option<f64>,
    /// Above the lowest floor, m, where floors are known.
    pub height: Option<f64>,
    #[serde(skip)]
    from: f64,
    #[serde(skip)]
    to: f64,
}

/// Windows above the guard line, one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Exceedance {
    /// s.
    pub from: f64,
    /// s.
    pub to: f64,
    /// The window with the largest energy.
    #[serde(flatten)]
    pub most: Placed,
}

/// A whole ride.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shaken {
    /// Its number.
    pub ride: usize,
    /// What was done with it.
    pub used: Used,
    /// The mean energy of a window, m²/s⁴.
    pub energy: f64,
    /// The window with the largest.
    pub most: Placed,
    /// Where it was above the guard line.
    pub alarms: Vec<Exceedance>,
    /// All of them.
    pub windows: Vec<Placed>,
}

/// A baseline in numbers, and the rides beside it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VibrationReport {
    /// The trips that it has learnt.
    pub trips: usize,
    /// About how many it takes, where it has any.
    pub expected_trips: Option<usize>,
    /// Its windows.
    pub windows: usize,
    /// Whether it has been learnt.
    pub settled: bool,
    /// The mean energy of a window, m²/s⁴.
    pub mean: Option<f64>,
    /// The standard error of that.
    pub standard_error: Option<f64>,
    /// What rides are judged by.
    pub guard: Option<GuardLine>,
    /// Whole rides.
    pub rides: Vec<Shaken>,
}

/// The columns that a ride gains.
pub(super) const COLUMNS: [&str; 5] = [
    "vibration_energy",
    "vibration_largest",
    "vibration_position",
    "vibration_height",
    "vibration_alarms",
];

impl VibrationReport {
    /// What was above the guard line, in words.
    pub fn alarms(&self) -> Vec<String> {
        let of_ride = |ride: &Shaken| -> Vec<String> {
            let guard = self.guard.iter();
            let each =
                guard.flat_map(|guard| ride.alarms.iter().map(|it| ride.words(it, guard.energy)));
            each.collect()
        };
        self.rides.iter().flat_map(of_ride).collect()
    }

    /// Sets the whole rides of a record beside a baseline, ride by ride. As long as it has not settled it learns them; then it
    /// draws its guard line for this rate of false alarms, a window.
    ///
    /// # Errors
    /// If the record does not hold the vibration that the baseline does.
    pub fn new(
        track: &Track,
        recording: &Recording,
        baseline: &mut Baseline,
        rate: f64,
    ) -> Result<Self, VibrationError> {
        let across = recording.across().ok_or(VibrationError::Axes)?;
        check(recording, baseline)?;
        let across = across
            .each_ref()
            .map(|it| Faults::removed(it).0.into_owned());
        let mut guard = None;
        let rides = track.trips.iter().filter_map(|it| {
            let placed = track.windows(it, &across, recording.rate());
            if baseline.has_settled() {
                guard = guard.or_else(|| baseline.guard(rate));
                return Shaken::new(it, Used::Judged, placed, guard.as_ref());
            }
            let used = match baseline.learn(placed.iter().map(|it| it.energy).collect()) {
                Learning::Learnt => Used::Learnt,
                Learning::Known => Used::Known,
                Learning::Nothing => return None,
            };
            Shaken::new(it, used, placed, None)
        });
        let rides = rides.collect();
        let settled = baseline.has_settled();
        Ok(Self {
            trips: baseline.trips().len(),
            expected_trips: baseline.expected_trips(),
            windows: baseline.windows(),
            settled,
            mean: baseline.mean(),
            standard_error: baseline.standard_error(),
            guard: guard.or_else(|| baseline.guard(rate).filter(|_| settled)),
            rides,
        })
    }

    /// The value of a column of a ride; null if it has none, nothing of another column.
    pub(super) fn column(&self, ride: usize, name: &str) -> Option<Value> {
        let place = COLUMNS.iter().position(|it| *it == name)?;
        let ride = self.rides.iter().find(|it| it.ride == ride);
        let value = ride.map(|ride| match place {
            0 => ride.energy.into(),
            1 => ride.most.energy.into(),
            2 => ride.most.position.into(),
            3 => ride.most.height.into(),
            _ => ride.alarms.len().into(),
        });
        Some(value.unwrap_or_default())
    }
}

fn check(recording: &Recording, baseline: &Baseline) -> Result<(), VibrationError> {
    let (rate, learnt) = (recording.rate(), baseline.rate());
    if rate < LEAST_RATE {
        return Err(VibrationError::Rate(rate));
    }
    if let Some(step) = recording.facts().coarse_step {
        return Err(VibrationError::Coarse(step));
    }
    if (rate / learnt - 1.0).abs() > LIKE {
        return Err(VibrationError::Unlike {
            baseline: learnt,
            record: rate,
        });
    }
    Ok(())
}

impl Track {
    /// The windows of one of its trips, in what two directions across the vertical read at this rate, Hz; none of one that is
    /// not recorded from its start to its stop.
    pub fn windows(&self, of: &Tracked, across: &[Vec<Sample>; 2], rate: f64) -> Vec<Placed> {
        let found = part(&of.trip).map(|part| windows(across, rate, &part));
        let found = found.unwrap_or_default();
        found.iter().map(|window| self.place(of, window)).collect()
    }

    /// Where the car was when it was shaken most.
    fn place(&self, of: &Tracked, window: &Window) -> Placed {
        let at = |time: f64| self.course.position(time);
        let start = of.trip.start.filter(|_| of.distance.is_some());
        let position = start.and_then(|start| Some(at(window.peak)? - at(start)?));
        let landing = of.landing.zip(of.distance);
        let height = landing.and_then(|(landing, gone)| Some(landing.position - gone + position?));
        Placed {
            time: window.peak,
            energy: window.energy,
            position,
            height,
            from: window.from,
            to: window.to,
        }
    }
}

impl Shaken {
    fn new(
        of: &Tracked,
        used: Used,
        windows: Vec<Placed>,
        guard: Option<&GuardLine>,
    ) -> Option<Self> {
        let most = *largest(&windows)?;
        let sum: f64 = windows.iter().map(|it| it.energy).sum();
        let alarms = guard.map(|guard| Exceedance::all(&windows, guard.energy));
        Some(Self {
            ride: of.trip.ride,
            used,
            energy: sum / windows.len() as f64,
            most,
            alarms: alarms.unwrap_or_default(),
            windows,
        })
    }
}

impl Shaken {
    fn words(&self, of: &Exceedance, guard: f64) -> String {
        let Placed {
            energy,
            position,
            height,
            ..
        } = of.most;
        let position = position.map(|it| format!(", {it:.2} m from the stop before"));
        let height = height.map(|it| format!(", {it:.2} m above the lowest floor"));
        let place = position.unwrap_or_default() + &height.unwrap_or_default();
        format!(
            "ride {}: alarm, {energy:.5} m²/s⁴ of horizontal vibration from {:.1} to {:.1} s, {:.1} times the guard line{place}",
            self.ride,
            of.from,
            of.to,
            energy / guard
        )
    }
}

impl Exceedance {
    /// What is above a guard line, joined where one window follows the other.
    pub fn all(windows: &[Placed], guard: f64) -> Vec<Self> {
        let is_above = |it: &Placed| it.energy > guard;
        let runs = windows
            .chunk_by(|one, next| is_above(one) == is_above(next) && next.from - one.to < 1e-6);
        let alarm = |run: &[Placed]| {
            let most = *largest(run).filter(|it| is_above(it))?;
            let (first, last) = run.first().zip(run.last())?;
            let (from, to) = (first.from, last.to);
            Some(Self { from, to, most })
        };
        runs.filter_map(alarm).collect()
    }
}

fn largest(windows: &[Placed]) -> Option<&Placed> {
    let by_energy = |a: &&Placed, b: &&Placed| a.energy.total_cmp(&b.energy);
    windows.iter().max_by(by_energy)
}
