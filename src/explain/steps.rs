//! The cheapest path through the means of windows, which keeps to its value, goes in small steps, or jumps.
//!
//! The path b through the means m minimises
//!
//! Σ min(1, ((mₖ − bₖ)/w)²) + the costs of its steps and jumps,
//!
//! found by dynamic programming on a grid of 0.01 m/s². A window far from the path costs 1 however far it is, so
//! that a pulse of acceleration does not draw the path to itself.

use crate::simd::{LANES, Vectors, Wide, least};
use std::ops::Range;

/// The step of the grid, m/s², and the most points in it.
pub const STEP: f64 = 0.01;
const MOST_POINTS: f64 = 600.0;

/// What a path pays to move, in windows off it: for one step of the grid; for a jump, so much beside its steps, but
/// no more than the most.
#[derive(Clone, Copy, Debug)]
pub struct Costs {
    pub step: f64,
    pub jump: f64,
    pub most: f64,
}

impl Costs {
    /// To the next point.
    fn to_neighbour(self) -> f64 {
        self.step.min(self.most)
    }

    /// To a point so many steps away.
    #[inline(always)]
    fn to_far(self, steps: f64) -> f64 {
        least(self.jump + self.step * steps, self.most)
    }
}

/// The cheapest path within bounds, one value for each window, and its cost. It moves between groups of windows; a
/// `pull` of 1 makes a window cost 1 more for every 0.1 m/s² that the path is from the mean of all.
pub fn path(
    means: &[f64],
    bounds: (f64, f64),
    windows: (usize, f64),
    pull: f64,
    costs: Costs,
) -> (Vec<f64>, f64) {
    Vectors::widest().run(
        #[inline(always)]
        || path_of(means, bounds, windows, pull, costs),
    )
}

#[inline(always)]
fn path_of(
    means: &[f64],
    (least, greatest): (f64, f64),
    (group, width): (usize, f64),
    pull: f64,
    costs: Costs,
) -> (Vec<f64>, f64) {
    let mean = means.iter().sum::<f64>() / means.len() as f64;
    let step = STEP.max((greatest - least) / MOST_POINTS);
    let points = ((greatest - least) / step).ceil() as usize + 1;
    let value = |point: usize| least + point as f64 * step;
    let values: Vec<f64> = (0..points).map(value).collect();
    let far: Vec<f64> = (values.iter())
        .map(|value| pull * (value - mean).abs() / 0.1)
        .collect();
    let mut totals = vec![0.0; points];
    let mut origins: Vec<Vec<u16>> = Vec::new();
    let (mut off, mut before) = (vec![0.0; points], Before::new(points));
    for windows in means.chunks(group) {
        off.fill(0.0);
        for mean in windows {
            // Points farther than the width pay for all of the window, whose distance is not computed.
            let at = |to: f64| ((to - least) / step).clamp(0.0, points as f64) as usize;
            let near = at(mean - width)..(at(mean + width) + 2).min(points);
            let (below, rest) = off.split_at_mut(near.start);
            let (beside, above) = rest.split_at_mut(near.len());
            far_from(below, &far[..near.start]);
            for ((off, far), value) in beside
                .iter_mut()
                .zip(&far[near.clone()])
                .zip(&values[near.clone()])
            {
                *off += far + ((mean - value) / width).powi(2).min(1.0);
            }
            far_from(above, &far[near.end..]);
        }
        before.find(&totals, costs);
        for ((total, before), off) in totals.iter_mut().zip(&before.cost).zip(&off) {
            *total = before + off;
        }
        origins.push(before.point.iter().map(|point| *point as u16).collect());
    }
    let mut point = cheapest(&totals);
    let cost = totals[point];
    let mut path = vec![0.0; means.len()];
    for (windows, origin) in path.chunks_mut(group).zip(&origins).rev() {
        windows.fill(value(point));
        point = usize::from(origin[point]);
    }
    (path, cost)
}

/// Adds what a window costs that is too far off.
#[inline(always)]
fn far_from(off: &mut [f64], far: &[f64]) {
    for (off, far) in off.iter_mut().zip(far) {
        *off += far + 1.0;
    }
}

/// The cheapest point before each, as a number, and what it costs to come from there.
struct Before {
    point: Vec<f64>,
    cost: Vec<f64>,
    /// The best for a jump by steps, and its total.
    stepped: Vec<f64>,
    totals: Vec<f64>,
    /// All totals between two that are never the least.
    padded: Vec<f64>,
}

impl Before {
    fn new(points: usize) -> Self {
        let none = || vec![0.0; points];
        Self {
            point: none(),
            cost: none(),
            stepped: none(),
            totals: none(),
            padded: vec![f64::INFINITY; points + 2],
        }
    }

    /// For each point itself or a neighbour, the best of those near enough for a jump by steps, or the cheapest of all: of
    /// equal ones the first of these.
    #[inline(always)]
    fn find(&mut self, totals: &[f64], costs: Costs) {
        self.step(totals, costs);
        let (cheapest, beside) = (cheapest(totals), costs.to_neighbour());
        let (place, total) = (cheapest as f64, totals[cheapest]);
        self.padded[1..][..totals.len()].copy_from_slice(totals);
        let all = 0..totals.len();
        let (point, cost) = (&mut self.point[all.clone()], &mut self.cost[all.clone()]);
        let (stepped, by_steps) = (&self.stepped[all.clone()], &self.totals[all.clone()]);
        let [below, own, above] = [0, 1, 2].map(|from| &self.padded[from..][all.clone()]);
        for i in all {
            let at = i as f64;
            let mut best = (at - 1.0, below[i] + beside);
            // Without branches, so that several points are compared at once.
            for (from, cost) in [
                (at, own[i]),
                (at + 1.0, above[i] + beside),
                (
                    stepped[i],
                    by_steps[i] + costs.to_far((stepped[i] - at).abs()),
                ),
                (place, total + costs.to_far((place - at).abs())),
            ] {
                let is_better = cost < best.1;
                best.0 = if is_better { from } else { best.0 };
                best.1 = if is_better { cost } else { best.1 };
            }
            (point[i], cost[i]) = best;
        }
    }

    /// The best for a jump to each point by steps.
    #[inline(always)]
    fn step(&mut self, totals: &[f64], costs: Costs) {
        self.totals.copy_from_slice(totals);
        (self.stepped.iter_mut().zip(0..)).for_each(|(point, place)| *point = f64::from(place));
        let mut spread = |point: usize, beside: usize| {
            let to = |from: usize| {
                let steps = (self.stepped[from] - point as f64).abs();
                self.totals[from] + costs.step * steps
            };
            if to(beside) < to(point) {
                self.stepped[point] = self.stepped[beside];
                self.totals[point] = self.totals[beside];
            }
        };
        for point in 1..totals.len() {
            spread(point, point - 1);
        }
        for point in (1..totals.len()).rev() {
            spread(point - 1, point);
        }
    }
}

/// The first of the least.
#[inline(always)]
fn cheapest(totals: &[f64]) -> usize {
    let (wide, others) = totals.as_chunks::<LANES>();
    let mut lanes = Wide::all(f64::INFINITY);
    for totals in wide {
        lanes = Wide(*totals).least(lanes);
    }
    let all = lanes.0.iter().chain(others);
    let least = all.copied().fold(f64::INFINITY, least);
    totals.iter().position(|total| *total == least).unwrap_or(0)
}

/// A part of a path without jumps.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    pub windows: Range<usize>,
    pub blocks: Range<usize>,
}

/// Cuts a path where it jumps. The blocks, so many in a window, say exactly where: the edge is where they agree best
/// with the path on either side, at most `reach` windows away, and the path is moved to it.
pub fn cut(path: &mut [f64], reach: usize, blocks: &[f64], per_window: usize) -> Vec<Segment> {
    let is_jump = |window: &usize| (path[*window] - path[window - 1]).abs() > 1.5 * STEP;
    let jumps = (1..path.len()).filter(is_jump);
    let jumps: Vec<(usize, f64, f64)> = jumps
        .map(|jump| (jump, path[jump - 1], path[jump]))
        .collect();
    let window_of = |block: usize| (block + per_window / 2) / per_window;
    let mut edges = vec![0];
    for (place, &(jump, before, after)) in jumps.iter().enumerate() {
        let next = jumps.get(place + 1).map_or(path.len(), |next| next.0);
        let from = (jump.saturating_sub(reach) * per_window).max(edges[place]);
        let to = ((jump + reach).min(next) * per_window).min(blocks.len());
        let from = from.min(to);
        let edge = from + edge(&blocks[from..to], before, after, per_window as f64 / 4.0);
        let at = window_of(edge).min(path.len());
        path[at.min(jump)..jump].fill(after);
        path[jump..at.max(jump)].fill(before);
        edges.push(edge);
    }
    edges.push(blocks.len());
    let segment = |ends: &[usize]| {
        let first = window_of(ends[0]).min(path.len().saturating_sub(1));
        Segment {
            windows: first..window_of(ends[1]).max(first + 1).min(path.len()),
            blocks: ends[0]..ends[1],
        }
    };
    edges.windows(2).map(segment).collect()
}

/// Where values change from one to another. A stretch far from both says nothing: it gets the value nearer to zero,
/// so that a shift is no longer than it must be. What is near to one by chance, or as it passes, is less than `doubt`
/// values.
fn edge(values: &[f64], before: f64, after: f64, doubt: f64) -> usize {
    let most = (after - before).abs();
    let farther = |x: &f64| (x - before).abs().min(most) - (x - after).abs().min(most);
    let sums = values.iter().scan(0.0, |sum, x| {
        *sum += farther(x);
        Some(*sum)
    });
    let sums: Vec<f64> = [0.0].into_iter().chain(sums).collect();
    let least = sums.iter().copied().fold(f64::INFINITY, f64::min);
    let best = sums.iter().position(|sum| *sum == least).unwrap_or(0);
    let is_edge = |sum: &f64| *sum <= least + doubt * most;
    let other = if after.abs() < before.abs() {
        sums.iter().position(is_edge)
    } else {
        sums.iter().rposition(is_edge)
    };
    let other = other.unwrap_or(best);
    let between = &values[best.min(other)..best.max(other)];
    let middle = f64::midpoint(before, after);
    let far = between.iter().filter(|x| (*x - middle).abs() > 1.5 * most);
    if 2 * far.count() > between.len() {
        other
    } else {
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Stream, unit};

    /// The least cost of all paths on the grid, each point reached from each.
    fn least_of_all(means: &[f64], least: f64, points: usize, width: f64, costs: Costs) -> f64 {
        let to = |from: usize, to: usize| match from.abs_diff(to) {
            0 => 0.0,
            1 => costs.step.min(costs.most),
            steps => (costs.jump + costs.step * steps as f64).min(costs.most),
        };
        let off = |mean: f64, at: usize| {
            let from_path = (mean - (least + at as f64 * STEP)) / width;
            (from_path * from_path).min(1.0)
        };
        let mut totals = vec![0.0; points];
        for mean in means {
            let reached = (0..points).map(|at| {
                let ways = (0..points).map(|from| totals[from] + to(from, at));
                ways.fold(f64::INFINITY, f64::min) + off(*mean, at)
            });
            totals = reached.collect();
        }
        totals.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Of walks with steps, jumps and outliers, for costs of every kind, no path is cheaper than the one that is found, and its
    /// own cost is the one that is told.
    #[test]
    fn no_path_is_cheaper() {
        let mut draws = Stream::new(2026, "paths", "").at(0);
        for trial in 0..60 {
            let costs = Costs {
                step: 4.0 * unit(&mut draws),
                jump: 6.0 * unit(&mut draws) * f64::from(trial % 3),
                most: 3.0 + 20.0 * unit(&mut draws),
            };
            let width = 0.01 + 0.06 * unit(&mut draws);
            let mut level = 0.0;
            let means: Vec<f64> = (0..80)
                .map(|_| {
                    let moves = unit(&mut draws);
                    if moves < 0.1 {
                        level = unit(&mut draws) - 0.5;
                    }
                    let outlier = if moves > 0.9 { 0.4 } else { 0.02 };
                    (level + outlier * (unit(&mut draws) - 0.5)).clamp(-0.5, 0.5)
                })
                .collect();
            let points = 101;
            let (found, cost) = path(&means, (-0.5, 0.5), (1, width), 0.0, costs);
            let best = least_of_all(&means, -0.5, points, width, costs);
            assert!((cost - best).abs() < 1e-9, "{trial}: {cost} {best}");
            let off = means.iter().zip(&found).map(|(mean, at)| {
                let from_path = (mean - at) / width;
                (from_path * from_path).min(1.0)
            });
            let moved = found.windows(2).map(|pair| {
                let steps = ((pair[1] - pair[0]) / STEP).abs().round();
                match steps as u64 {
                    0 => 0.0,
                    1 => costs.step.min(costs.most),
                    _ => (costs.jump + costs.step * steps).min(costs.most),
                }
            });
            let own = off.sum::<f64>() + moved.sum::<f64>();
            assert!((own - cost).abs() < 1e-6, "{trial}: {own} {cost}");
        }
    }
}
