//! Facts about a recording and its sensor, gathered in one pass.

use super::error::{RecordingError, RecordingProblem};
use super::intervals::{GAP, Gap, Intervals};
use super::series::{Sample, Series};
use super::source::Source;
use super::steps::{LOOKED_AT, Steps};
use super::vertical::is_gravity;

/// Facts about a recording before any resampling.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Samples.
    pub samples: u64,
    /// Time of the first sample, s.
    pub start: f64,
    /// Time of the last sample, s.
    pub end: f64,
    /// One over the median interval, Hz.
    pub rate: f64,
    /// The standard deviation of the intervals over their median, without intervals below 0.5 or above 1.5
    /// medians.
    pub jitter: f64,
    /// The longest interval.
    pub longest_gap: Gap,
    /// Intervals longer than five medians.
    pub gaps: u64,
    /// The sensor's step, m/s², if its first readings lie on a grid.
    pub quantum: Option<f64>,
    /// The share of samples that equal the one before.
    pub repeats: f64,
    /// The share of samples at a limit of the sensor, if there clearly is one.
    pub saturated: Option<f64>,
    /// m/s².
    pub mean: f64,
    /// The standard deviation over rest and ride together, m/s².
    pub deviation: f64,
    /// m/s².
    pub least: f64,
    /// m/s².
    pub greatest: f64,
    /// Whether the mean is that of gravity.
    pub has_gravity: bool,
    /// Rows without time or without acceleration.
    pub blank_rows: u64,
    /// Rows at the time of the row before, which were left out.
    pub repeated_times: u64,
    /// The line of the first row with a repeated time.
    pub first_repeated_time: Option<u64>,
    /// The line at which the file is cut off.
    pub cut_line: Option<u64>,
}

impl Facts {
    /// Reads a series to its end.
    ///
    /// # Errors
    /// If the series has an error, too few samples or only equal ones.
    pub(super) fn of(
        series: &mut Series,
        source: &Source,
        is_headed: bool,
    ) -> Result<Self, RecordingError> {
        let mut survey = Survey::default();
        for sample in series.by_ref() {
            survey.add(sample?);
        }
        let skipped = series.skipped();
        let problem = match survey.samples {
            0 if skipped.blank == 0 && is_headed => Some(RecordingProblem::HeaderOnly),
            samples @ (0 | 1) => Some(RecordingProblem::TooFew(samples)),
            _ if survey.low.value == survey.high.value => {
                Some(RecordingProblem::AllEqual(survey.low.value))
            }
            _ => None,
        };
        if let Some(problem) = problem {
            return Err(source.error(None, problem));
        }
        Ok(Self {
            blank_rows: skipped.blank,
            repeated_times: skipped.repeated,
            first_repeated_time: skipped.first_repeat,
            cut_line: skipped.cut,
            ..survey.facts()
        })
    }

    /// The facts of the inverted signal.
    pub(super) fn turned(self) -> Self {
        Self {
            mean: -self.mean,
            least: -self.greatest,
            greatest: -self.least,
            ..self
        }
    }

    /// The longest interval that is not a gap, s.
    pub fn gap(&self) -> f64 {
        GAP / self.rate
    }

    /// s.
    pub fn duration(&self) -> f64 {
        self.end - self.start
    }
}

/// Sums gathered sample by sample, in bounded memory.
#[derive(Debug, Default)]
struct Survey {
    samples: u64,
    first: Option<Sample>,
    last: Option<Sample>,
    intervals: Intervals,
    readings: Vec<f64>,
    repeats: u64,
    mean: f64,
    squares: f64,
    low: Extreme,
    high: Extreme,
}

impl Survey {
    fn add(&mut self, sample: Sample) {
        let value = sample.acceleration;
        self.samples += 1;
        // Welford's recursion.
        let deviation = value - self.mean;
        self.mean += deviation / self.samples as f64;
        self.squares += deviation * (value - self.mean);
        if let Some(last) = self.last {
            self.intervals.add(last.time, sample.time);
            self.repeats += u64::from(last.acceleration == value);
        }
        if self.readings.len() < LOOKED_AT {
            self.readings.push(value);
        }
        self.low
            .add(value, self.first.is_none() || value < self.low.value);
        self.high
            .add(value, self.first.is_none() || value > self.high.value);
        self.first.get_or_insert(sample);
        self.last = Some(sample);
    }

    /// The facts without the skipped rows, which the caller adds.
    fn facts(self) -> Facts {
        let time = |sample: Option<Sample>| sample.map_or(0.0, |sample| sample.time);
        let count = self.samples as f64;
        let steps = Steps::of(self.readings);
        let step = steps.quantum.unwrap_or(0.0);
        let is_fine = steps.levels > FEW_LEVELS;
        let at_limits: u64 = [&self.low, &self.high]
            .into_iter()
            .filter(|extreme| is_fine && extreme.is_limit(self.mean, step))
            .map(|extreme| extreme.count)
            .sum();
        Facts {
            samples: self.samples,
            start: time(self.first),
            end: time(self.last),
            rate: 1.0 / self.intervals.median(),
            jitter: self.intervals.jitter(),
            longest_gap: self.intervals.longest(),
            gaps: self.intervals.gaps(),
            quantum: steps.quantum,
            repeats: self.repeats as f64 / count,
            saturated: (at_limits > 0).then(|| at_limits as f64 / count),
            mean: self.mean,
            deviation: (self.squares / count).sqrt(),
            least: self.low.value,
            greatest: self.high.value,
            has_gravity: is_gravity(self.mean),
            blank_rows: 0,
            repeated_times: 0,
            first_repeated_time: None,
            cut_line: None,
        }
    }
}

/// The number of levels that the noise at rest may cover on a sensor with coarse steps.
const FEW_LEVELS: usize = 20;

/// The least or the greatest reading, how often it occurred, and how often in a row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Extreme {
    value: f64,
    count: u64,
    run: u64,
    longest_run: u64,
}

impl Extreme {
    fn add(&mut self, value: f64, is_new: bool) {
        if is_new {
            *self = Self {
                value,
                ..Self::default()
            };
        }
        self.run = if value == self.value { self.run + 1 } else { 0 };
        self.count += u64::from(value == self.value);
        self.longest_run = self.longest_run.max(self.run);
    }

    /// Whether the extreme is a limit of the sensor. A signal stays at its extreme for three readings if it is
    /// clipped there. By chance this happens only if the steps are so coarse that rest covers few levels, and then
    /// the extreme is only a few steps from the mean.
    fn is_limit(&self, mean: f64, step: f64) -> bool {
        self.longest_run >= 3 && (self.value - mean).abs() > FEW_LEVELS as f64 * step
    }
}
