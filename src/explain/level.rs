//! The level of a record: what the sensor reads without acceleration, at every block.
//!
//! Rest and uniform motion read the same, so the level is what most of a record agrees with. It drifts slowly and
//! may step where the sensor is moved. The record is cut into windows of half a second, and the level is the path
//! b through their means m that minimises
//!
//! Σ min(1, ((mₖ − bₖ)/w)²) + 4 · (steps of the grid) + 40 · (jumps),
//!
//! found by dynamic programming on a grid of 0.01 m/s². A window far from the level costs 1 however far it is, so
//! that a pulse of acceleration does not draw the level to itself. The path may go one step of the grid in three
//! seconds, twice the drift of 0.1 m/s² a minute; anything lasting more than twenty seconds is a jump.

use super::blocks::{Cut, median};

/// Length of a window, s.
const WINDOW: f64 = 0.5;

/// Windows between two steps of the path.
const GROUP: usize = 6;

/// The step of the grid, m/s², and the most points in it.
const STEP: f64 = 0.01;
const MOST_POINTS: f64 = 600.0;

/// The costs of a step of the grid and of a jump, in windows off the level.
const STEP_COST: f64 = 4.0;
const JUMP_COST: f64 = 40.0;

/// Windows on either side whose median refines the path.
const REACH: usize = 30;

/// The level of a record.
#[derive(Clone, Debug, Default)]
pub struct Level {
    /// m/s², one value for each block.
    pub at: Vec<f64>,
    /// w: windows nearer than this to the path agree with it, m/s².
    pub width: f64,
    /// The cost of the path, in windows off the level.
    pub cost: f64,
}

impl Level {
    /// The level of a record. A `pull` of 1 makes a window cost 1 more for every 0.1 m/s² that the level is from the
    /// mean of the record, which it equals where the record begins and ends at one speed.
    pub fn of(record: &Cut, pull: f64) -> Self {
        let means = record.window_means(WINDOW);
        let per_window = record.blocks_in(WINDOW) as f64;
        let differences = means.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let white = 20.0 * record.scatter() / per_window.sqrt();
        let width = (4.0 * median(differences.collect()))
            .min(white)
            .clamp(0.03, 0.3);
        let (path, cost) = path(&means, width, pull);
        let fine: Vec<f64> = (0..means.len())
            .map(|window| refined(&means, &path, width, window))
            .collect();
        Self {
            at: (0..record.blocks.len())
                .map(|block| between(&fine, (block as f64 + 0.5) / per_window - 0.5))
                .collect(),
            width,
            cost,
        }
    }
}

/// The cheapest path, one value for each group of windows, and its cost.
fn path(means: &[f64], width: f64, pull: f64) -> (Vec<f64>, f64) {
    let mean = means.iter().sum::<f64>() / means.len() as f64;
    let least = means.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = means.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let step = STEP.max((greatest - least) / MOST_POINTS);
    let points = ((greatest - least) / step).ceil() as usize + 1;
    let value = |point: usize| least + point as f64 * step;
    let mut costs = vec![0.0; points];
    let mut origins: Vec<Vec<u16>> = Vec::new();
    for group in means.chunks(GROUP) {
        let cheapest = cheapest(&costs);
        let origin: Vec<u16> = (0..points)
            .map(|point| {
                let near = point.saturating_sub(1)..=(point + 1).min(points - 1);
                let candidates = near.chain([cheapest]);
                let cost = |from: &usize| costs[*from] + move_cost(*from, point);
                candidates
                    .min_by(|a, b| cost(a).total_cmp(&cost(b)))
                    .unwrap_or(point) as u16
            })
            .collect();
        costs = (0..points)
            .map(|point| {
                let from = usize::from(origin[point]);
                let far = pull * (value(point) - mean).abs() / 0.1;
                let off = |mean: &f64| far + ((mean - value(point)) / width).powi(2).min(1.0);
                costs[from] + move_cost(from, point) + group.iter().map(off).sum::<f64>()
            })
            .collect();
        origins.push(origin);
    }
    let mut point = cheapest(&costs);
    let cost = costs[point];
    let mut path = vec![0.0; origins.len()];
    for (place, origin) in path.iter_mut().zip(&origins).rev() {
        *place = value(point);
        point = usize::from(origin[point]);
    }
    (path, cost)
}

fn cheapest(costs: &[f64]) -> usize {
    (0..costs.len())
        .min_by(|a, b| costs[*a].total_cmp(&costs[*b]))
        .unwrap_or(0)
}

fn move_cost(from: usize, to: usize) -> f64 {
    match from.abs_diff(to) {
        0 => 0.0,
        1 => STEP_COST,
        _ => JUMP_COST,
    }
}

/// The median of the windows around that agree with the path.
fn refined(means: &[f64], path: &[f64], width: f64, window: usize) -> f64 {
    let here = path[window / GROUP];
    let around = window.saturating_sub(REACH)..(window + REACH + 1).min(means.len());
    let near = around.filter(|other| {
        let there = path[other / GROUP];
        (means[*other] - there).abs() < width && (there - here).abs() < width
    });
    let near: Vec<f64> = near.map(|other| means[other]).collect();
    if near.is_empty() { here } else { median(near) }
}

/// The value at a place between windows, held constant beyond the ends.
fn between(values: &[f64], place: f64) -> f64 {
    let place = place.clamp(0.0, values.len() as f64 - 1.0);
    let before = place as usize;
    let after = (before + 1).min(values.len() - 1);
    let share = place - before as f64;
    values[before] * (1.0 - share) + values[after] * share
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Sample;

    /// The largest error of the level of a record with these accelerations and levels, with a little noise.
    fn worst(acceleration: impl Fn(f64) -> f64, level: impl Fn(f64) -> f64) -> f64 {
        let noise = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5;
        let samples: Vec<Sample> = (0..6000)
            .map(|i| {
                let time = f64::from(i) / 50.0;
                let acceleration = acceleration(time) + level(time) + 0.05 * noise(i);
                Sample { time, acceleration }
            })
            .collect();
        let cut = Cut::new(&samples, 2, 0.04);
        let found = Level::of(&cut, 0.0);
        let errors = cut
            .blocks
            .iter()
            .zip(&found.at)
            .map(|(block, found)| (found - level(block.to)).abs());
        errors.fold(0.0, f64::max)
    }

    fn pulse(time: f64, from: f64, to: f64, size: f64) -> f64 {
        if (from..to).contains(&time) {
            size
        } else {
            0.0
        }
    }

    /// A braking of 8 s does not become the level, nor does a drift escape it.
    #[test]
    fn the_level_stays_below_pulses_and_follows_drift() {
        let ride = |time| pulse(time, 20.0, 22.0, 1.0) + pulse(time, 60.0, 68.0, -0.25);
        assert!(worst(ride, |_| 9.81) < 0.01);
        assert!(worst(ride, |time| 9.81 + time / 600.0) < 0.03);
        assert!(worst(ride, |time| -0.1 * time / 60.0) < 0.03);
    }

    /// A step of the level for good is followed within three seconds.
    #[test]
    fn the_level_follows_a_step() {
        let near = |time: f64| (57.0..63.5).contains(&time);
        let step = |time: f64| if time < 60.25 { 0.0 } else { 0.4 };
        // Near the step the sensor reads nothing but the level found, so that only the rest is compared.
        let found = worst(|_| 0.0, |time| if near(time) { 0.2 } else { step(time) });
        assert!(found < 0.21, "{found}");
    }
}
