//! The cheapest path through the means of windows, which keeps to its value, goes in small steps, or jumps.
//!
//! The path b through the means m minimises
//!
//! Σ min(1, ((mₖ − bₖ)/w)²) + the costs of its steps and jumps,
//!
//! found by dynamic programming on a grid of 0.01 m/s². A window far from the path costs 1 however far it is, so
//! that a pulse of acceleration does not draw the path to itself.

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
    fn of(&self, from: usize, to: usize) -> f64 {
        match from.abs_diff(to) {
            0 => 0.0,
            1 => self.step.min(self.most),
            steps => (self.jump + self.step * steps as f64).min(self.most),
        }
    }
}

/// The cheapest path within bounds, one value for each window, and its cost. It moves between groups of windows; a
/// `pull` of 1 makes a window cost 1 more for every 0.1 m/s² that the path is from the mean of all.
pub fn path(
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
    let mut off = vec![0.0; points];
    for windows in means.chunks(group) {
        // Window by window, so that neighbouring points are computed side by side.
        off.fill(0.0);
        for mean in windows {
            for ((off, value), far) in off.iter_mut().zip(&values).zip(&far) {
                *off += far + ((mean - value) / width).powi(2).min(1.0);
            }
        }
        let (origin, before) = origins_of(&totals, costs);
        for ((total, before), off) in totals.iter_mut().zip(before).zip(&off) {
            *total = before + off;
        }
        origins.push(origin);
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

/// The cheapest point before each, and what it costs to come from there: itself or a neighbour, the best of those near
/// enough for a jump by steps, or the cheapest of all.
fn origins_of(totals: &[f64], costs: Costs) -> (Vec<u16>, Vec<f64>) {
    let last = totals.len() - 1;
    let cheapest = cheapest(totals);
    let by_steps = |from: usize, to: usize| totals[from] + costs.step * from.abs_diff(to) as f64;
    let mut stepped: Vec<usize> = (0..totals.len()).collect();
    let mut spread = |point: usize, beside: usize| {
        if by_steps(stepped[beside], point) < by_steps(stepped[point], point) {
            stepped[point] = stepped[beside];
        }
    };
    (1..=last).for_each(|point| spread(point, point - 1));
    (1..=last).rev().for_each(|point| spread(point - 1, point));
    let origin = |point: usize| {
        let near = [point.saturating_sub(1), point, (point + 1).min(last)];
        let mut best = (near[0] as u16, f64::INFINITY);
        for from in near.into_iter().chain([stepped[point], cheapest]) {
            let cost = totals[from] + costs.of(from, point);
            if cost < best.1 {
                best = (from as u16, cost);
            }
        }
        best
    };
    (0..totals.len()).map(origin).unzip()
}

fn cheapest(totals: &[f64]) -> usize {
    (0..totals.len())
        .min_by(|a, b| totals[*a].total_cmp(&totals[*b]))
        .unwrap_or(0)
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
