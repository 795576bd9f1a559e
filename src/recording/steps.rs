//! The quantisation step of the sensor, if its readings lie on a grid.
//!
//! It is estimated from the first few thousand readings. After sorting, the distances of neighbours on a grid
//! are integer multiples of the smallest. The estimate is refined from the short multiples to the long, so
//! that its error never reaches a tenth of a step.

use super::unit::GRAVITY;

/// The number of readings used.
pub(super) const LOOKED_AT: usize = 8192;

/// Readings count as equal if they differ by less than this share of the largest of them, or of gravity: apps
/// store numbers in single precision, whose neighbours lie 1.2e-7 apart, and may have subtracted gravity from
/// them.
const EQUAL: f64 = 4.0 * f32::EPSILON as f64;

/// The largest deviation of a distance from a multiple, in steps. Without a grid one distance in five lies so
/// near by chance.
const NEAR: f64 = 0.1;

/// Distances longer than this many steps are not used, because the error of the step would matter.
const LONG: f64 = 50.0;

/// The number of distances needed: five fit by chance with probability 3e-4.
const FEWEST: u64 = 5;

/// The share of ties that proves a grid of even a few levels.
const TIED: f64 = 0.9;

/// The share of distances that may lie off the grid.
const ASTRAY: f64 = 0.01;

/// The result for the first readings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Steps {
    /// m/s².
    pub quantum: Option<f64>,
    /// The number of distinct values.
    pub levels: usize,
}

impl Steps {
    pub fn of(mut readings: Vec<f64>) -> Self {
        let total = readings.len();
        let largest = readings.iter().fold(GRAVITY, |most, x| most.max(x.abs()));
        readings.sort_by(f64::total_cmp);
        readings.dedup();
        let levels = readings.len();
        let ties = 1.0 - levels as f64 / total.max(1) as f64;
        readings.dedup_by(|next, kept| (*next - *kept).abs() <= EQUAL * largest);
        let mut distances: Vec<f64> = readings.windows(2).map(|pair| pair[1] - pair[0]).collect();
        distances.sort_by(f64::total_cmp);
        Self {
            quantum: grid(&distances, if ties > TIED { 1 } else { FEWEST }),
            levels,
        }
    }
}

/// The step of which `distances`, in ascending order, are multiples; `None` if fewer than `fewest` fit.
fn grid(distances: &[f64], fewest: u64) -> Option<f64> {
    let mut step = *distances.first()?;
    let (mut sum, mut multiples) = (0.0, 0.0);
    let (mut fitting, mut astray) = (0, 0);
    for distance in distances {
        if *distance >= LONG * step {
            break;
        }
        let multiple = (distance / step).round();
        if (distance - multiple * step).abs() > NEAR * step {
            astray += 1;
            continue;
        }
        fitting += 1;
        sum += distance;
        multiples += multiple;
        step = sum / multiples;
    }
    let is_grid = fitting >= fewest && f64::from(astray) <= ASTRAY * fitting as f64;
    is_grid.then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Stream;
    use rand::Rng;

    /// Uniform in (−1, 1).
    fn draws(size: usize) -> Vec<f64> {
        let mut generator = Stream::new(2014, "noise", "steps").at(0);
        let uniform = |bits: u64| (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        (0..size).map(|_| uniform(generator.next_u64())).collect()
    }

    #[test]
    fn a_grid_is_found_through_single_precision() {
        for step in [0.1, 0.00119, 0.0765] {
            let on_grid = |x: f64| f64::from((9.8 + (3.0 * x / step).round() * step) as f32);
            let steps = Steps::of(draws(5000).into_iter().map(on_grid).collect());
            let found = steps.quantum.unwrap();
            assert!((found / step - 1.0).abs() < 1e-3, "{found} for {step}");
        }
    }

    #[test]
    fn a_grid_of_few_levels() {
        let levels = [9.7, 9.8, 9.9];
        let steps = Steps::of((0..100).map(|i| levels[i % 3]).collect());
        assert!((steps.quantum.unwrap() - 0.1).abs() < 1e-12);
        assert_eq!(steps.levels, 3);
    }

    #[test]
    fn what_lies_on_none() {
        for size in [2, 6, 100, 8192] {
            let steps = Steps::of(draws(size));
            assert_eq!(steps.quantum, None, "{size}");
        }
        assert_eq!(Steps::of(vec![]).quantum, None);
        assert_eq!(Steps::of(vec![1.0; 9]).quantum, None);
    }

    /// Gravity in single precision leaves a grid that is not the sensor's.
    #[test]
    fn the_grid_of_the_numbers_is_no_step() {
        let without_gravity = |x: f64| f64::from((9.8 + x) as f32) - 9.8;
        let steps = Steps::of(draws(5000).into_iter().map(without_gravity).collect());
        assert_eq!(steps.quantum, None);
    }
}
