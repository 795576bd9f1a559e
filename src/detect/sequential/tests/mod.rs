//! The exact laws against enumerations, naive chains and simulation.
//!
//! A statistic is tested at 5.2 standard errors, which a true law exceeds with probability 2e-7, or at p < 1e-7.

mod delay;
mod laws;
mod ranks;
mod together;

use super::run_length::RARE;
use super::*;
use crate::rng::{self, Generator, Stream};
use crate::signal::{Law, Noise};

/// Standard errors.
const FAR: f64 = 5.2;

/// Laws of blocks, each with the step to which it is rounded, or none.
const LAWS: [(&str, Law, f64); 6] = [
    ("normal", Law::Normal, 0.0),
    ("laplace", Law::Laplace, 0.0),
    ("cauchy", Law::Cauchy, 0.0),
    ("uniform", Law::Uniform, 0.0),
    (
        "contaminated",
        Law::Contaminated {
            share: 0.1,
            scale: 5.0,
        },
        0.0,
    ),
    ("normal in steps of σ", Law::Normal, 1.0),
];

/// Uniform on (0, 1].
fn uniform(draws: &mut Generator) -> f64 {
    1.0 - rng::unit(draws)
}

/// A source of blocks.
fn blocks(law: Law, step: f64) -> impl FnMut(&mut Generator) -> f64 {
    let noise = Noise::new(law).unwrap();
    // The samplers fill records: a few at a time, so that little is drawn in vain.
    let (mut record, mut used) = ([0.0; 64], 64);
    move |draws| {
        if used == record.len() {
            noise.fill(draws, &mut record);
            used = 0;
        }
        used += 1;
        let x: f64 = record[used - 1];
        if step > 0.0 {
            (x / step).round() * step
        } else {
            x
        }
    }
}

fn stream(subject: &str) -> Stream {
    Stream::new(2014, "sequential", subject)
}

/// Mean and its standard error.
fn mean(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    [mean, (squares / (n - 1.0) / n).sqrt()]
}

/// A sample's mean against an exact one, in standard errors and in per cent.
fn agrees(what: &str, values: &[f64], exact: f64) {
    let [mean, error] = mean(values);
    let (z, off) = ((mean - exact) / error, 100.0 * (mean / exact - 1.0));
    let n = values.len();
    println!("{what}: n = {n}, mean {mean:.3}, exact {exact:.3}, off by {off:+.3} %, z = {z:+.2}");
    assert!(z.abs() < FAR, "{what}");
}

fn chart(sides: &[Side], reference: usize) -> Chart {
    Chart::new(Score::Normal, sides, 0.8, reference).unwrap()
}
