//! The chain written a second time: its own loops, no linearity, nothing shared between points, ranks by
//! sorting.

use super::{TRIALS, region};
use crate::chain::{Family, Scenario};
use crate::detect::{Samples, Statistics};
use crate::rng::Stream;
use crate::signal::{DeltaAt, During, ImpulseMemory};
use crate::simd::{LANES, Wide};
use crate::whiten::{Fit, Order};
use rand::Rng;

/// One trial of one scenario, step by step.
fn naive_trial(scenario: &Scenario, white: &[f64], draws: &[u64], keys: &[u64]) -> Statistics {
    let samples = &scenario.samples;
    let ar = scenario.sensor.ar();
    let mut x = naive_start(scenario, white);
    for (i, xi) in white.iter().enumerate().skip(x.len()) {
        let past = (0..ar.len())
            .filter(|p| i > *p)
            .map(|p| ar[p] * x[i - 1 - p]);
        x.push(xi + past.sum::<f64>());
    }
    let burn_in = if scenario.noise.is_normal() {
        0
    } else {
        scenario.sensor.burn_in()
    };
    let x = &x[burn_in..];
    let lead = scenario.whitening.lead();
    let rest = (lead + samples.reference()) * samples.decimation();
    let y2 = (lead + samples.scale_range().start) * samples.decimation();
    let delta = match scenario.motion.delta_at {
        DeltaAt::Record => scenario.motion.delta,
        DeltaAt::Whitened => scenario.motion.delta / (1.0 - ar.iter().sum::<f64>()),
    };
    let mut memory = ImpulseMemory::default();
    let written: Vec<f64> = (0..x.len())
        .map(|i| {
            let mut r = x[i];
            if i >= rest {
                let time = ((i - rest) as f64 + 0.5) / samples.decimation() as f64;
                r += delta * scenario.motion.shape(time);
                let acts = scenario.impulses.during == During::Motion || i >= y2;
                if acts {
                    r += scenario.impulses.theta.get()
                        * memory.step(scenario.impulses.nu.get(), draws[i - rest]);
                }
            }
            scenario.digitiser.code(r)
        })
        .collect();
    let r: Vec<f64> = written
        .chunks(samples.decimation())
        .map(|block| block.iter().sum::<f64>() * (scenario.digitiser.unit() / block.len() as f64))
        .collect();
    let a = naive_coefficients(scenario, &r);
    let y: Vec<f64> = (lead..r.len())
        .map(|i| r[i] - (0..a.len()).map(|p| a[p] * r[i - 1 - p]).sum::<f64>())
        .collect();
    naive_statistics(samples, &y, keys)
}

/// The first samples of stationary normal noise: Cholesky's factor of their covariances, which are sums
/// over the impulse response. Other laws start from zero.
fn naive_start(scenario: &Scenario, white: &[f64]) -> Vec<f64> {
    let ar = scenario.sensor.ar();
    if !scenario.noise.is_normal() {
        return Vec::new();
    }
    let mut response = vec![1.0];
    for i in 1..20_000 {
        let past = (0..ar.len().min(i)).map(|p| ar[p] * response[i - 1 - p]);
        response.push(past.sum());
    }
    let covariance = |lag: usize| -> f64 {
        response
            .iter()
            .zip(&response[lag..])
            .map(|(a, b)| a * b)
            .sum()
    };
    let mut factor = vec![vec![0.0; ar.len()]; ar.len()];
    for i in 0..ar.len() {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let rest = covariance(i - j) - known;
            factor[i][j] = if i == j {
                rest.sqrt()
            } else {
                rest / factor[j][j]
            };
        }
    }
    let sample = |row: &Vec<f64>| row.iter().zip(white).map(|(l, z)| l * z).sum();
    factor.iter().map(sample).collect()
}

fn naive_coefficients(scenario: &Scenario, r: &[f64]) -> Vec<f64> {
    let whitening = &scenario.whitening;
    if whitening.fit == Fit::Known {
        let mut a = scenario.sensor.ar().to_vec();
        a.resize(whitening.highest_order(), 0.0);
        return a;
    }
    let end =
        whitening.lead() + usize::from(whitening.includes_reference) * scenario.samples.reference();
    let training = &r[end - whitening.training..end];
    let order = match whitening.order {
        Order::Fixed(order) => order,
        Order::Auto => naive_order(training),
    };
    naive_least_squares(&centred(training), order, order)
}

/// The order of least n ln σ̂² + m ln n, every filter fitted to the same n samples and run over them.
pub(super) fn naive_order(training: &[f64]) -> usize {
    let x = centred(training);
    let most = (x.len() / 5).min(8);
    let n = (x.len() - most) as f64;
    let criterion = |order: usize| {
        let a = naive_least_squares(&x, order, most);
        let error = |i: usize| x[i] - (0..order).map(|p| a[p] * x[i - 1 - p]).sum::<f64>();
        let energy: f64 = (most..x.len()).map(|i| error(i).powi(2)).sum();
        n * (energy / n).ln() + order as f64 * n.ln()
    };
    let criteria: Vec<f64> = (0..=most).map(criterion).collect();
    (0..=most)
        .min_by(|a, b| criteria[*a].total_cmp(&criteria[*b]))
        .unwrap()
}

fn centred(training: &[f64]) -> Vec<f64> {
    let mean = training.iter().sum::<f64>() / training.len() as f64;
    training.iter().map(|x| x - mean).collect()
}

/// Least squares over the samples from `first` on, by the normal equations as they are written,
/// Gauss–Jordan with pivoting.
fn naive_least_squares(x: &[f64], order: usize, first: usize) -> Vec<f64> {
    let c = |j: usize, k: usize| -> f64 { (first..x.len()).map(|i| x[i - j] * x[i - k]).sum() };
    let mut rows: Vec<Vec<f64>> = (1..=order)
        .map(|j| (1..=order).map(|k| c(j, k)).chain([c(j, 0)]).collect())
        .collect();
    for column in 0..order {
        let pivot = (column..order)
            .max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()));
        rows.swap(column, pivot.unwrap());
        let scaled: Vec<f64> = rows[column]
            .iter()
            .map(|v| v / rows[column][column])
            .collect();
        rows[column] = scaled.clone();
        for (index, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if index != column {
                row.iter_mut()
                    .zip(&scaled)
                    .for_each(|(v, s)| *v -= factor * s);
            }
        }
    }
    rows.iter().map(|row| row[order]).collect()
}

/// Ranks by sorting (value, key).
fn naive_statistics(samples: &Samples, y: &[f64], keys: &[u64]) -> Statistics {
    let ranges = [
        samples.reference_range(),
        samples.shift_range(),
        samples.scale_range(),
    ];
    let mut pooled: Vec<(f64, u64, usize)> = Vec::new();
    for (label, range) in ranges.into_iter().enumerate() {
        for i in range {
            pooled.push((y[i], keys[pooled.len()], label));
        }
    }
    pooled.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let pooled = &pooled;
    let places = |label| (0..pooled.len()).filter(move |&i| pooled[i].2 == label);
    let (low, high) = (places(0).min().unwrap(), places(0).max().unwrap());
    let outside = |label| {
        let beyond = places(label).filter(|&place| place < low || place > high);
        beyond.count()
    };
    Statistics {
        rank_sum: places(1).map(|place| place as u64 + 1).sum(),
        exceedances: outside(2),
        shift_exceedances: outside(1),
    }
}

/// How often `scenario` decides H₁ in the first trials, by the naive chain.
pub(super) fn naive_count(scenario: &Scenario, family: &Family) -> u64 {
    let region = region(scenario);
    let length = family.source.burn_in() + family.source.raw_length();
    let raw_after = family.source.motion_observations() * scenario.samples.decimation();
    let draws = |stream: &Stream, position, count| -> Vec<u64> {
        let mut generator = stream.at(position);
        (0..count).map(|_| generator.next_u64()).collect()
    };
    (0..TRIALS)
        .filter(|&trial| {
            let (batch, lane) = (trial / LANES as u64, trial as usize % LANES);
            let mut all = vec![Wide::<LANES>::default(); length];
            scenario.noise.fill(&mut family.noise.at(batch), &mut all);
            let white: Vec<f64> = all.iter().map(|wide| wide.0[lane]).collect();
            let impulses = draws(&family.impulses, batch, LANES * raw_after);
            let impulses = &impulses[lane * raw_after..];
            let keys = draws(&family.ties, trial, scenario.samples.span());
            region.contains(naive_trial(scenario, &white, impulses, &keys))
        })
        .count() as u64
}
