//! One realisation of a ride, Figs 2–4 of [^1]: the sensor's record while the cage stands, accelerates,
//! coasts and brakes, and the same record after whitening.
//!
//! r = x + Δ·shape + λ + v, eqs (4), (7): Δ acts in acceleration, −Δ in braking. The impulses λ and the
//! vibration v act in motion; v is white noise that [^1] does not have. Every ride starts from S = 0.
//!
//! # Impulses in (9)
//! With the sensor's true coefficients, y_i = r_i − Σ a_p r_{i−p} is
//! ξ_i + Δ·step_i + λ_i − Σ a_p λ_{i−p}, where step is the whitened shape: 1 − β once the filter's
//! memory is full. (9) prints λ_i + Σ a_p λ_{i−p}. The quantities give the distance of y from both.
//!
//! [^1]: see [`crate::signal`].

pub(super) mod picture;
mod row;
mod table;

pub use row::Row;

use crate::chain::Scenario;
use crate::counts::Counts;
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::{self, Quantity, eight_digits};
use crate::rng::Stream;
use crate::run::{Identity, StudyError};
use crate::signal::{During, ImpulseMemory, Motion, Phase, white_noise};
use crate::study::kind::{Context, Study};
use crate::whiten::{Fitter, whiten};
use rand::Rng;
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;
use std::iter;
use table::{Part, Trace};

/// What one realisation is drawn from.
pub(super) struct Realisation {
    seed: u64,
    scenario: Scenario,
    trace: Trace,
}

impl Study for Realisation {
    const NAME: &'static str = "trace";
    const USES: &'static [&'static str] = &[
        "sensor",
        "noise",
        "impulses",
        "motion.delta",
        "motion.delta_at",
        "motion.profile",
        "whitening",
        "samples.reference",
        "samples.shift",
        "samples.scale",
        "samples.gap",
    ];
    const COUNTS_TRIALS: bool = false;
    type Row = Row;

    fn read(experiment: &Experiment, context: Context) -> Result<Self, StudyError> {
        let trace: Trace = experiment.read()?;
        if !trace.whitened {
            let is_of_the_record =
                |of: &&&str| !of.starts_with("whitening") && !of.starts_with("samples");
            let uses: Vec<&str> = Self::USES
                .iter()
                .filter(is_of_the_record)
                .copied()
                .collect();
            experiment.check_used(&uses, Self::COUNTS_TRIALS)?;
        }
        (trace.check()).map_err(|conflict| experiment.conflict(conflict))?;
        let mut sections = experiment.sections();
        trace.lay_over(&mut sections, &experiment.table().span);
        let scenario = experiment.scenario_of(&sections)?;
        (trace.check_fit(&scenario)).map_err(|conflict| experiment.conflict(conflict))?;
        Ok(Self {
            seed: context.seed,
            scenario,
            trace,
        })
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Trace::json_schema(generator).to_value()
    }

    fn identities(&self) -> Vec<Identity> {
        let trace = ("trace".to_owned(), format!("{:?}", self.trace));
        let parameters = results::parameters(&self.scenario);
        vec![Identity::new(iter::once(trace).chain(parameters))]
    }

    fn rows(&self, _counts: &Counts) -> Vec<Row> {
        Ride::new(self).rows()
    }

    fn quantities(&self, _rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        Ok(Ride::new(self).quantities())
    }

    fn plot(&self, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
        Ok(picture::plot(rows, &self.trace, &self.scenario, seed))
    }
}

/// A realisation, part by part, in σ_ξ.
struct Ride<'a> {
    config: &'a Realisation,
    trace: &'a Trace,
    /// ξ.
    innovations: Vec<f64>,
    acceleration: Vec<f64>,
    impulses: Vec<f64>,
    record: Vec<f64>,
}

impl<'a> Ride<'a> {
    /// Draws a realisation.
    fn new(config: &'a Realisation) -> Self {
        let trace = &config.trace;
        let (innovations, coloured) = noise(config, trace.length());
        let acceleration = acceleration(config, trace);
        let impulses = impulses(config, trace);
        let vibration = vibration(config, trace);
        let digitiser = &config.scenario.digitiser;
        let parts = coloured.iter().zip(&acceleration).zip(&impulses);
        let record = parts
            .zip(vibration)
            .map(|(((x, delta), impulse), v)| x + delta + impulse + v)
            .map(|r| digitiser.code(r) * digitiser.unit())
            .collect();
        Self {
            config,
            trace,
            innovations,
            acceleration,
            impulses,
            record,
        }
    }

    /// One row for each sample.
    fn rows(&self) -> Vec<Row> {
        let whitened = self.whitened();
        let mut names = vec![None; self.record.len()];
        if self.trace.whitened {
            self.name_samples(&mut names);
        }
        let scaled = |value: f64| eight_digits(value * self.trace.sigma);
        (samples(self.trace).zip(names).enumerate())
            .map(|(i, ((part, _), sample))| Row {
                time: eight_digits(i as f64 / self.trace.rate),
                phase: part.phase.name().to_owned(),
                record: scaled(self.record[i]),
                whitened: whitened[i].map(scaled),
                sample: sample.map(str::to_owned),
                acceleration: scaled(self.acceleration[i]),
                impulse: scaled(self.impulses[i]),
            })
            .collect()
    }

    /// How far (9) is from the whitened record, with a minus before the impulses' tail and with the plus
    /// that it prints. The ride must be whitened and contain only the terms of (9).
    fn quantities(&self) -> Vec<Quantity> {
        let is_of_nine = self.config.scenario.digitiser.is_transparent()
            && self.trace.vibration == 0.0
            && !self.config.scenario.sensor.ar().is_empty();
        if !self.trace.whitened || !is_of_nine {
            return Vec::new();
        }
        let exactly = |name, sign| Quantity::exact(name, eight_digits(self.residual(sign)));
        vec![
            exactly("eq9_minus_residual", -1.0),
            exactly("eq9_plus_residual", 1.0),
        ]
    }

    /// The largest |y_i − (ξ_i + Δ·step_i + λ_i ± Σ a_p λ_{i−p})| in motion, with true coefficients.
    fn residual(&self, sign: f64) -> f64 {
        let ar = self.config.scenario.sensor.ar();
        let tail = |values: &[f64], i: usize| -> f64 {
            let past = values[..i].iter().rev();
            ar.iter().zip(past).map(|(a, value)| a * value).sum()
        };
        let in_motion = samples(self.trace)
            .enumerate()
            .skip(ar.len())
            .filter(|(_, (part, _))| part.phase.moves());
        let residual = |i: usize| {
            let y = self.record[i] - tail(&self.record, i);
            let step = self.acceleration[i] - tail(&self.acceleration, i);
            let impulse = self.impulses[i] + sign * tail(&self.impulses, i);
            (y - (self.innovations[i] + step + impulse)).abs()
        };
        in_motion.map(|(i, _)| residual(i)).fold(0.0, f64::max)
    }

    /// The whitened record. It starts where the filter's memory is full.
    fn whitened(&self) -> Vec<Option<f64>> {
        let mut whitened = vec![None; self.record.len()];
        if !self.trace.whitened {
            return whitened;
        }
        let whitening = self.config.scenario.whitening;
        let training = self.training();
        let mut fitter = Fitter::new(whitening, self.config.scenario.sensor.ar());
        let coefficients = fitter.fit(&self.record[training]);
        let start = whitening.highest_order().min(self.record.len());
        let mut values = vec![0.0; self.record.len() - start];
        whiten(coefficients, &self.record, start, &mut values);
        for (whitened, value) in whitened[start..].iter_mut().zip(values) {
            *whitened = Some(value);
        }
        whitened
    }

    fn reference_start(&self) -> usize {
        let start = self.trace.reference_start(&self.config.scenario.samples);
        start.expect("the config has been checked")
    }

    /// The samples that the filter is fitted to.
    fn training(&self) -> std::ops::Range<usize> {
        let scenario = &self.config.scenario;
        let start = self.reference_start();
        let end = if scenario.whitening.includes_reference {
            start + scenario.samples.reference()
        } else {
            start
        };
        end - scenario.whitening.training..end
    }

    fn name_samples(&self, names: &mut [Option<&'static str>]) {
        let samples = &self.config.scenario.samples;
        let start = self.reference_start();
        let placed = |range: std::ops::Range<usize>| start + range.start..start + range.end;
        for (name, range) in [
            ("training", self.training()),
            ("reference", placed(samples.reference_range())),
            ("shift", placed(samples.shift_range())),
            ("scale", placed(samples.scale_range())),
        ] {
            names[range].fill(Some(name));
        }
    }
}

/// For each sample, the part of the ride that it lies in and its index within that part.
fn samples(trace: &Trace) -> impl Iterator<Item = (Part, usize)> + '_ {
    let parts = trace.parts.iter();
    parts.flat_map(|part| (0..part.length).map(move |since| (*part, since)))
}

fn stream(config: &Realisation, purpose: &str) -> Stream {
    let subject = format!("{} {}", config.scenario.sensor, config.scenario.noise);
    Stream::new(config.seed, purpose, &subject)
}

/// ξ and x, stationary from the first sample.
fn noise(config: &Realisation, length: usize) -> (Vec<f64>, Vec<f64>) {
    let sensor = &config.scenario.sensor;
    let burn_in = sensor.burn_in();
    let mut white = vec![0.0; burn_in + length];
    let mut generator = stream(config, "trace noise").at(0);
    config.scenario.noise.fill(&mut generator, &mut white);
    let mut coloured = white.clone();
    sensor.colour(&mut coloured);
    (white.split_off(burn_in), coloured.split_off(burn_in))
}

fn acceleration(config: &Realisation, trace: &Trace) -> Vec<f64> {
    let motion = &config.scenario.motion;
    let delta = motion.record_delta(config.scenario.sensor.step_gain());
    let at = |(part, since): (Part, usize)| {
        let pulse = Motion {
            duration: part.length,
            offset: 0,
            ..*motion
        };
        match part.phase.sign() {
            0.0 => 0.0,
            sign => sign * delta * pulse.shape(since as f64 + 0.5),
        }
    };
    samples(trace).map(at).collect()
}

fn impulses(config: &Realisation, trace: &Trace) -> Vec<f64> {
    let impulses = &config.scenario.impulses;
    let mut generator = stream(config, "trace impulses").at(0);
    let mut memory = ImpulseMemory::default();
    let mut next = |phase: Phase| {
        let draw = generator.next_u64();
        let acts = match impulses.during {
            During::Motion => phase.moves(),
            During::Inertial => phase == Phase::Inertial,
        };
        match acts {
            // Adding zero makes −0 the same as 0.
            true => impulses.theta.get() * memory.step(impulses.nu.get(), draw) + 0.0,
            false => {
                memory = ImpulseMemory::default();
                0.0
            }
        }
    };
    samples(trace).map(|(part, _)| next(part.phase)).collect()
}

fn vibration(config: &Realisation, trace: &Trace) -> Vec<f64> {
    let mut generator = stream(config, "trace vibration").at(0);
    let mut vibration = white_noise(trace.length(), &mut generator);
    for (value, (part, _)) in vibration.iter_mut().zip(samples(trace)) {
        *value *= if part.phase.moves() {
            trace.vibration
        } else {
            0.0
        };
    }
    vibration
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::tests::read;

    const HEAD: &str = "question = \"?\"\nseed = 2014\n";
    const PHASES: &str = "phases = [{ rest = 60 }, { acceleration = 20 }, { inertial = 30 }, \
                          { braking = 10 }, { rest = 9 }]";
    const SECTIONS: &str = "[motion]\ndelta = 3.0\n[impulses]\nnu = 0.4\ntheta = 5.0\n\
                            [whitening]\ntraining = 40\n";

    fn ride<R>(text: &str, of: impl FnOnce(Ride) -> R) -> R {
        of(Ride::new(&read(text)))
    }

    fn whitened() -> String {
        format!("{HEAD}[trace]\nwhitened = true\n{PHASES}\n{SECTIONS}")
    }

    /// With a minus, (9) is an identity up to rounding of values below 100. With the plus it is off by
    /// 2 |Σ a_p λ_{i−p}|, which is at least 2 · 1.5365 θ after a lone impulse.
    #[test]
    fn nine_holds_with_a_minus() {
        let quantities = ride(&whitened(), |ride| ride.quantities());
        let [minus, plus] = &quantities[..] else {
            panic!("{quantities:?}");
        };
        assert!(minus.value < 1e-12, "{minus:?}");
        assert!(plus.value > 2.0 * 0.75 * 5.0, "{plus:?}");
    }

    /// X ends where the acceleration starts. The other places follow from the sizes.
    #[test]
    fn samples_lie_where_they_should() {
        let rows = ride(&whitened(), |ride| ride.rows());
        assert_eq!(rows.len(), 129);
        let places = |name: &str| -> Vec<usize> {
            let named = |row: &&Row| row.sample.as_deref() == Some(name);
            let found = rows.iter().filter(named);
            found.map(|row| (row.time * 1.0) as usize).collect()
        };
        assert_eq!(places("training"), (8..48).collect::<Vec<_>>());
        assert_eq!(places("reference"), (48..60).collect::<Vec<_>>());
        assert_eq!(places("shift"), (60..72).collect::<Vec<_>>());
        assert_eq!(places("scale"), (72..84).collect::<Vec<_>>());
        assert_eq!((rows[1].whitened, rows[2].whitened.is_some()), (None, true));
        let (rest, moving) = (&rows[59], &rows[60]);
        assert_eq!((rest.phase.as_str(), rest.acceleration), ("rest", 0.0));
        assert_eq!(
            (moving.phase.as_str(), moving.acceleration),
            ("acceleration", 3.0)
        );
        assert_eq!(rows[110].acceleration, -3.0);
        let quiet = rows.iter().filter(|row| row.phase == "rest");
        assert!(
            quiet
                .clone()
                .all(|row| row.impulse == 0.0 && row.acceleration == 0.0)
        );
        assert!(rows.iter().any(|row| row.impulse == 5.0));
    }

    /// The record is the sum of the parts, in the unit and steps of the sensor.
    #[test]
    fn digitised_and_scaled() {
        let text = format!(
            "{HEAD}[trace]\nsigma = 9.0\nunit = \"mg\"\nrate = 100.0\nvibration = 2.0\n{PHASES}\n\
             [noise]\nquantum = 2.0\nrange = 222.0\n[motion]\ndelta = 4.0\n"
        );
        let rows = ride(&text, |ride| {
            assert!(ride.quantities().is_empty());
            ride.rows()
        });
        assert!(rows.iter().all(|row| (row.record / 18.0).fract() == 0.0));
        assert!(
            rows.iter()
                .all(|row| row.whitened.is_none() && row.sample.is_none())
        );
        assert_eq!((rows[70].time, rows[70].acceleration), (0.7, 36.0));
    }
}
