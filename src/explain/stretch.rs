//! A stretch without holes in one direction of time: its pulses, and what each makes of a motion in progress.
//!
//! A motion begins with a pulse; every later one changes its speed, or is something else, or belongs to a disturbance. It
//! may end at a change that brings the speed back to zero. Reversed, braking is a start.

use super::cost::{self, Prior};
use super::progress::{Progress, Turned};
use super::pulse::Pulse;
use super::swing::{LEAST_IN_SWING, LONGEST_SLOW_SWING, PAUSE_SHARE, Swing, goes_back};
use std::ops::Range;

/// The pulses of a stretch without holes.
pub struct Stretch<'a> {
    pub prior: &'a Prior,
    pub pulses: Vec<Turned>,
    /// For each pulse the costs of the disturbances that begin with it: of two pulses, of three and so on.
    disturbances: Vec<Vec<f64>>,
    /// Its end, s.
    pub end: f64,
    /// Its beginning, s.
    begin: f64,
    /// Whether time runs backwards.
    pub is_reversed: bool,
}

impl<'a> Stretch<'a> {
    /// In the order of the record; `begin` and `end` in s.
    pub fn new(prior: &'a Prior, pulses: &[Pulse], (begin, end): (f64, f64)) -> Self {
        let weak: Vec<&Pulse> = pulses.iter().filter(|it| prior.is_weak(it)).collect();
        let turned = pulses.iter().map(|pulse| {
            let mut turned = Turned::new(prior, pulse);
            let is_inside = begin + cost::HANDLED <= pulse.from && pulse.to <= end - cost::HANDLED;
            if is_inside && prior.is_weak(pulse) {
                let (from, to) = (pulse.from - cost::AROUND, pulse.to + cost::AROUND);
                let before = weak.partition_point(|it| it.to < from);
                let count = weak[before..].partition_point(|it| it.from <= to);
                let calm = Prior::calm(to.min(end) - from.max(begin), count);
                turned.ignored = turned.ignored.max(calm);
            }
            // A sensor that is shaken or turned at the end of a record may be in somebody's hand.
            let is_handled = turned.is_shock() || pulse.shift != 0.0;
            let is_at_end = pulse.from <= begin || pulse.to >= end;
            turned.ignored += cost::cut_off(is_at_end && !is_handled);
            if pulse.is_level {
                turned.ignored = turned.ignored.min(cost::TURNED);
            }
            turned
        });
        Self::of(prior, turned.collect(), (begin, end), false)
    }

    /// The same with time reversed.
    pub fn reversed(&self) -> Self {
        let turned = self.pulses.iter().rev().map(Turned::reversed);
        let ends = (-self.end, -self.begin);
        Self::of(self.prior, turned.collect(), ends, !self.is_reversed)
    }

    fn of(
        prior: &'a Prior,
        pulses: Vec<Turned>,
        (begin, end): (f64, f64),
        is_reversed: bool,
    ) -> Self {
        let disturbances = (0..pulses.len()).map(|first| disturbances(prior, &pulses[first..]));
        Self {
            disturbances: disturbances.collect(),
            prior,
            pulses,
            begin,
            end,
            is_reversed,
        }
    }

    /// The cost of a pulse that is not part of any motion.
    pub fn ignored(&self, pulse: usize) -> f64 {
        self.pulses[pulse].ignored
    }

    /// Whether the stretch begins with a pulse, or ends with one: then it cuts the pulse off.
    fn begins_with(&self, pulse: &Turned) -> bool {
        pulse.from <= self.begin
    }

    fn ends_with(&self, pulse: &Turned) -> bool {
        pulse.to >= self.end
    }

    /// The cost of a pulse that a motion goes past on its way through the stretch: one that is cut off may be the end or the
    /// beginning of a change of its speed.
    pub fn passed(&self, index: usize) -> f64 {
        let pulse = &self.pulses[index];
        if self.begins_with(pulse) || self.ends_with(pulse) {
            pulse.ignored.min(cost::STAGE)
        } else {
            pulse.ignored
        }
    }

    /// The disturbances that begin with a pulse: the pulse after, and the cost.
    pub fn disturbances(&self, first: usize) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
        let costs = self.disturbances[first].iter().copied();
        (first + 2..).zip(costs).filter(|it| it.1.is_finite())
    }

    /// The motion that begins with a pulse, if that is strong enough.
    pub fn start(&self, first: usize) -> Option<Progress> {
        let pulse = &self.pulses[first];
        let is_strong = pulse.change.abs() >= self.prior.least_speed / 8.0;
        let mut start = Progress::start(pulse);
        start.cost += cost::cut_off(self.begins_with(pulse));
        // Reversed, the start is the stop.
        if self.is_reversed {
            start.cost += self.unfinished(first);
        }
        is_strong.then_some(start)
    }

    /// What it costs to stop with a pulse that goes on beside the next one: a shift of the level that is taken for a change
    /// of speed.
    fn unfinished(&self, pulse: usize) -> f64 {
        let here = &self.pulses[pulse];
        let goes_on = if self.is_reversed {
            pulse > 0 && self.pulses[pulse - 1].to > here.from
        } else {
            let next = self.pulses.get(pulse + 1);
            next.is_some_and(|next| next.from < here.to)
        };
        if goes_on { cost::ABSURD } else { 0.0 }
    }

    /// The motion after pulses that together change its speed.
    pub fn changed(&self, motion: &Progress, pulses: Range<usize>) -> Progress {
        let mut changed = motion.changed(self.prior, &self.pulses[pulses.clone()]);
        if self.is_half(pulses.end) {
            changed.cost += cost::HALF;
        }
        let tolerance = self.prior.tolerance(changed.top, changed.variance);
        if !motion.creeps && (motion.speed - changed.speed / 2.0).abs() < tolerance {
            changed.cost += cost::DOUBLED;
        }
        changed
    }

    /// Whether the pulse before this one and it are a swing to and fro.
    fn is_half(&self, next: usize) -> bool {
        let Some(after) = self.pulses.get(next) else {
            return false;
        };
        let before = self.pulses[next - 1];
        let is_swing = self.disturbances[next - 1].first();
        is_swing.is_some_and(|cost| cost.is_finite())
            && after.change * before.change < 0.0
            && after.change.abs() > 0.3 * before.change.abs()
    }

    /// A motion that goes on after a change by the pulses before `next`. Reversed, a stage of braking is a second one of
    /// acceleration, unless the record begins within the first.
    pub fn going_on(&self, changed: Progress, before: &Progress, next: usize) -> Progress {
        let stage = if self.ends_with(&self.pulses[next - 1]) {
            0.0
        } else if self.is_reversed && !self.prior.in_stages {
            cost::LATE_STAGE / 2.0
        } else {
            cost::STAGE
        };
        changed.going_on(self.prior, before, stage)
    }

    /// What a motion costs that ends with a pulse.
    pub fn closed(&self, motion: &Progress, first: usize, last: usize) -> f64 {
        let seconds = self.pulses[last].to - self.pulses[first].from;
        let cut_off = cost::cut_off(self.ends_with(&self.pulses[last]));
        let unfinished = if self.is_reversed {
            0.0
        } else {
            self.unfinished(last)
        };
        motion.closed(self.prior, seconds) + cut_off + unfinished
    }

    /// What a motion costs that goes on at the end.
    pub fn open(&self, motion: &Progress) -> f64 {
        let slow = (self.prior).implausible(motion.top, f64::INFINITY, f64::INFINITY);
        // Of a change that the end cuts off nobody knows how fast it became.
        let slow = if motion.since >= self.end {
            slow.min(cost::SLOW_PART)
        } else {
            slow
        };
        let tolerance = self.prior.tolerance(motion.top, motion.variance);
        let stands = if motion.speed.abs() < tolerance {
            cost::STANDS
        } else {
            0.0
        };
        motion.cost + motion.creeping(self.prior, self.end) + slow + stands
    }
}

/// What the disturbances cost that begin with the first pulse: of two pulses, of three and so on; infinite where they
/// are none. Longer ones than these are one pulse already.
fn disturbances(prior: &Prior, pulses: &[Turned]) -> Vec<f64> {
    let few = &pulses[..pulses.len().min(LEAST_IN_SWING - 1)];
    let swings = few.iter().scan(Some(Swing::default()), |swing, pulse| {
        *swing = swing.and_then(|swing| swing.with(pulse));
        Some(swing.map_or(f64::INFINITY, |swing| prior.disturbance(swing.speed)))
    });
    let costs = swings.enumerate().map(|(last, cost)| {
        let slow = slow_swing(&few[..=last]).map(|speed| prior.disturbance(speed));
        slow.map_or(cost, |slow| cost.min(slow + cost::SLOW_SWING))
    });
    costs.skip(1).collect()
}

/// The speed that pulses leave if they may be a period of a slow swing: they turn each time, follow each other at once
/// and go back and forth.
fn slow_swing(pulses: &[Turned]) -> Option<f64> {
    let seconds = |pulse: &Turned| pulse.to - pulse.from;
    let goes_on = |pair: &[Turned]| {
        let longest = seconds(&pair[0]).max(seconds(&pair[1]));
        pair[0].change * pair[1].change < 0.0
            && pair[1].from - pair[0].to <= PAUSE_SHARE * longest
            && longest <= LONGEST_SLOW_SWING
    };
    let parts = pulses.iter().map(|pulse| (seconds(pulse), pulse.change));
    let is_swing = pulses.windows(2).all(goes_on) && goes_back(parts.clone());
    is_swing.then(|| parts.map(|(_, change)| change).sum())
}
