//! The plausible hypotheses on one level of the sensor.

use super::hypothesis::Hypothesis;
use super::prices::{Known, PENDING};
use crate::explain::{Pulse, Swing, Turned, is_of_hand};
use serde::{Deserialize, Serialize};

/// The most hypotheses kept, of old ones and of renewed ones, and how much dearer than the cheapest they may be.
const MOST: [usize; 2] = [16, 4];
const HOPELESS: f64 = 14.0;

/// The pulses before, each with the hypotheses before it: as many as a disturbance may have.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Hypotheses {
    /// Now, cheapest first.
    pub now: Vec<Hypothesis>,
    /// The pulses that a disturbance may consist of.
    pulses: Vec<Turned>,
    /// The hypotheses before each.
    before: Vec<Vec<Hypothesis>>,
    made: Vec<Hypothesis>,
}

/// How long after its beginning a pulse is seen, at most, s.
const UNSEEN: f64 = 0.3;

/// The most pulses in a disturbance.
const MOST_PULSES: usize = 12;

/// Pulses no farther apart than this, s, may be one under a shock, which costs this.
const APART: f64 = 0.1;
const SHOCK: f64 = 0.5;

/// Pulses in one direction no farther apart than this, s, are parts of one.
const BESIDE: f64 = 0.5;

impl Hypotheses {
    pub fn new(now: &[Hypothesis]) -> Self {
        Self {
            now: now.to_vec(),
            pulses: Vec::with_capacity(MOST_PULSES),
            before: (0..MOST_PULSES)
                .map(|_| Vec::with_capacity(MOST[0] + MOST[1] + 1))
                .collect(),
            made: Vec::with_capacity(1024),
        }
    }

    /// Takes the next pulse.
    pub fn take(&mut self, known: &Known, pulse: &Turned) {
        if self
            .pulses
            .last()
            .is_some_and(|last| !lasts(last.to, pulse.from))
        {
            self.pulses.clear();
        }
        if self.pulses.len() == MOST_PULSES {
            self.pulses.remove(0);
            self.before.rotate_left(1);
        }
        let place = self.pulses.len();
        self.before[place].clear();
        self.before[place].extend_from_slice(&self.now);
        self.pulses.push(*pulse);
        let (made, pulses) = (&mut self.made, &self.pulses);
        for first in 0..=place {
            if let Some((under, shocks)) = under_shocks(known, &pulses[first..]) {
                for hypothesis in &self.before[first] {
                    let hypothesis = hypothesis.dearer(shocks);
                    hypothesis.explain(known, &[under], under.ignored, &mut |it| made.push(it));
                }
            }
            let ignored = if first == place {
                ignored(known, &pulses[..place], pulse)
            } else {
                match swing(&pulses[first..]) {
                    Some(swing) => known.prior.disturbance(swing.speed),
                    None => continue,
                }
            };
            for hypothesis in &self.before[first] {
                hypothesis.explain(known, &pulses[first..], ignored, &mut |it| made.push(it));
            }
        }
        prune(&mut self.made, &mut self.now);
        self.renew(pulse.to);
    }

    /// The swings that hands may have made among the latest pulses, each from its beginning to its end, s: two brisk
    /// pulses against each other, as no lift makes them.
    pub fn swings(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let is_of_hand = |it: &Turned| is_of_hand(it.to - it.from, it.change);
        let swings = self.pulses.windows(2).filter(move |pair| {
            let is_close = pair[1].from - pair[0].to < APART;
            is_close && pair[0].change * pair[1].change < 0.0 && pair.iter().all(is_of_hand)
        });
        swings.map(|pair| (pair[0].from, pair[1].to))
    }

    /// Where none is at rest, one more is: that all before was misread. Else a motion that never was would never end.
    fn renew(&mut self, now: f64) {
        if let Some(first) = self.now.first().copied()
            && !self.now.iter().any(Hypothesis::is_rest)
        {
            self.now.push(Hypothesis::renewed(now, first.cost));
        }
    }

    /// Makes all dearer.
    pub fn raise(&mut self, by: f64) {
        self.now.iter_mut().for_each(|it| it.cost += by);
    }

    /// What they are if the level has changed by so much, m/s², at once or not.
    pub fn shifted(&self, by: f64, at_once: bool) -> impl Iterator<Item = Hypothesis> + '_ {
        self.now.iter().map(move |it| it.shifted(by, at_once))
    }

    /// Adds those of another level.
    pub fn join(&mut self, others: impl IntoIterator<Item = Hypothesis>) {
        self.made.extend_from_slice(&self.now);
        self.made.extend(others);
        prune(&mut self.made, &mut self.now);
    }

    /// Replaces each by what it becomes across a hole.
    pub fn cross(&mut self, now: f64, is_brief: bool, in_pulse: bool) {
        self.pulses.clear();
        let made = &mut self.made;
        for hypothesis in &self.now {
            hypothesis.across(now, is_brief, in_pulse, &mut |it| made.push(it));
        }
        prune(&mut self.made, &mut self.now);
    }

    /// Shows each with its cost at a time, while a pulse may be going on; and whether that pulse is a change of
    /// its speed.
    pub fn each(
        &self,
        known: &Known,
        now: f64,
        current: Option<&Turned>,
        mut take: impl FnMut(&Hypothesis, f64, bool),
    ) {
        let ignored = current.map_or(0.0, |pulse| ignored(known, &self.pulses, pulse));
        for hypothesis in &self.now {
            let aged = hypothesis.aged(known, now);
            let Some(pulse) = current else {
                take(hypothesis, aged, false);
                continue;
            };
            if hypothesis.is_rest() {
                take(hypothesis, aged + ignored, false);
                if let Some(started) = hypothesis.started(known, pulse) {
                    take(&started, started.aged(known, now), true);
                }
            } else {
                let changed = hypothesis.changing(known, pulse) - hypothesis.cost;
                let changes = changed < ignored && !hypothesis.is_ripple(pulse.change);
                take(hypothesis, aged + ignored.min(changed), changes);
            }
        }
        self.each_in_swing(known, now, current, take);
    }

    /// Those before a disturbance that may still be going on.
    fn each_in_swing(
        &self,
        known: &Known,
        now: f64,
        current: Option<&Turned>,
        mut take: impl FnMut(&Hypothesis, f64, bool),
    ) {
        let ended = self.pulses.last().map(|it| it.to);
        if current.is_none() && !ended.is_some_and(|to| lasts(to + UNSEEN, now)) {
            return;
        }
        for first in 0..=self.pulses.len() {
            let before = self.before.get(first).filter(|_| first < self.pulses.len());
            let mut pulses = self.pulses[first..].iter().chain(current);
            let swing = pulses.try_fold(Swing::default(), |swing, pulse| swing.with(pulse));
            let returns = |swing: Swing| current.is_none_or(|it| swing.may_return(it.to - it.from));
            let is_nothing = first == self.pulses.len() && current.is_none();
            if is_nothing || !swing.is_some_and(returns) {
                continue;
            }
            for hypothesis in before.unwrap_or(&self.now) {
                take(hypothesis, hypothesis.aged(known, now) + PENDING, false);
            }
        }
    }
}

/// What it costs to take a pulse for something else. Where it goes on from those before, all of them cost what they would
/// as one: a soft start that is seen in parts is not less of a start.
fn ignored(known: &Known, before: &[Turned], pulse: &Turned) -> f64 {
    let cost = |it: &Turned| it.ignored.min(known.passing(it));
    let goes_on = |one: &Turned, next: &Turned| {
        let is_beside = next.from - one.to < BESIDE && one.change * next.change > 0.0;
        is_beside && !one.is_shock() && !next.is_shock()
    };
    let (mut parts, mut next): (Option<Turned>, &Turned) = (None, pulse);
    for part in before.iter().rev() {
        if !goes_on(part, next) {
            break;
        }
        parts = Some(parts.map_or(*part, |later| together(known, part, &later)));
        next = part;
    }
    let alone = cost(pulse);
    parts.map_or(alone, |parts| {
        alone.max(cost(&together(known, &parts, pulse)) - cost(&parts))
    })
}

/// Two pulses as one.
fn together(known: &Known, one: &Turned, next: &Turned) -> Turned {
    let deviation = (one.variance + next.variance).sqrt();
    let span = (one.from, next.to);
    let pulse = Pulse::passing(span, one.change + next.change, deviation);
    Turned::new(&known.prior, &pulse)
}

/// The pulse that goes on under shocks, which leave its beginning or its end to be seen, and what the shocks cost.
fn under_shocks(known: &Known, pulses: &[Turned]) -> Option<(Turned, f64)> {
    let of = |shocks: bool| (pulses.iter()).filter(move |it| it.is_shock() == shocks);
    let sum = |shocks: bool, of_one: fn(&Turned) -> f64| of(shocks).map(of_one).sum::<f64>();
    let shocks = of(true).count();
    let first = of(false).next().filter(|_| shocks > 0)?;
    let is_one = pulses.windows(2).all(|it| it[1].from - it[0].to < APART)
        && of(false).all(|it| it.change * first.change > 0.0);
    if !is_one {
        return None;
    }
    let change = sum(false, |it| it.change);
    let seconds = |shocks| sum(shocks, |it| it.to - it.from);
    let hidden = change / seconds(false) * seconds(true);
    let span = (pulses[0].from, pulses[pulses.len() - 1].to);
    let deviation = libm::hypot(sum(false, |it| it.variance).sqrt(), hidden / 2.0);
    let pulse = Pulse::passing(span, change + hidden, deviation);
    Some((Turned::new(&known.prior, &pulse), SHOCK * shocks as f64))
}

fn swing(pulses: &[Turned]) -> Option<Swing> {
    let mut pulses = pulses.iter();
    pulses.try_fold(Swing::default(), |swing, pulse| swing.with(pulse))
}

/// Whether a disturbance whose latest pulse ended at a time may still go on.
fn lasts(to: f64, now: f64) -> bool {
    Swing::lasts_from(to, now)
}

/// Keeps the cheapest of hypotheses that differ.
fn prune(hypotheses: &mut Vec<Hypothesis>, kept: &mut Vec<Hypothesis>) {
    hypotheses.sort_unstable_by(|a, b| a.cost.total_cmp(&b.cost));
    kept.clear();
    let least = hypotheses.first().map_or(0.0, |first| first.cost);
    let mut left = MOST;
    for hypothesis in hypotheses.iter() {
        if hypothesis.cost > least + HOPELESS {
            break;
        }
        let left = &mut left[usize::from(hypothesis.is_renewed)];
        if *left > 0 && !kept.iter().any(|other| other.is_like(hypothesis)) {
            kept.push(*hypothesis);
            *left -= 1;
        }
    }
    hypotheses.clear();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::Prior;

    #[test]
    fn a_pulse_in_parts_costs_what_it_costs_as_one() {
        let prior = Prior::default();
        let known = Known { prior, soft: 0.1 };
        let pulse = |from: f64, to: f64, change: f64| {
            Turned::new(&prior, &Pulse::passing((from, to), change, 0.01))
        };
        let cost = |parts: &[Turned]| -> f64 {
            let each =
                (0..parts.len()).map(|place| ignored(&known, &parts[..place], &parts[place]));
            each.sum()
        };
        let parts = [
            pulse(0.0, 2.0, 0.08),
            pulse(2.1, 4.0, 0.09),
            pulse(4.3, 6.0, 0.08),
        ];
        let whole = cost(&[pulse(0.0, 6.0, 0.25)]);
        assert!(
            (cost(&parts) - whole).abs() < 1e-9,
            "{} {whole}",
            cost(&parts)
        );
        let alone: f64 = parts.iter().map(|it| cost(&[*it])).sum();
        assert!(alone < whole - 1.0, "{alone} {whole}");
        let back = [pulse(0.0, 2.0, 0.08), pulse(2.1, 4.0, -0.09)];
        let apart = [pulse(0.0, 2.0, 0.08), pulse(2.6, 4.0, 0.09)];
        assert!(cost(&back) < alone && cost(&apart) < alone);
    }
}
