//! The plausible hypotheses on one level of the sensor.

use super::hypothesis::Hypothesis;
use super::prices::{Known, PENDING};
use crate::explain::{Pulse, Swing, Turned};

/// The most hypotheses kept, and how much dearer than the cheapest they may be.
const MOST: usize = 16;
const HOPELESS: f64 = 14.0;

/// The pulses before, each with the hypotheses before it: as many as a disturbance may have.
#[derive(Clone, Debug)]
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

impl Hypotheses {
    pub fn new(now: &[Hypothesis]) -> Self {
        Self {
            now: now.to_vec(),
            pulses: Vec::with_capacity(MOST_PULSES),
            before: (0..MOST_PULSES).map(|_| Vec::with_capacity(MOST)).collect(),
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
                pulse.ignored.min(known.passing(pulse))
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
    }

    /// Makes all dearer.
    pub fn raise(&mut self, by: f64) {
        self.now.iter_mut().for_each(|it| it.cost += by);
    }

    /// Adds those of another level.
    pub fn join(&mut self, others: impl Iterator<Item = Hypothesis>) {
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
        for hypothesis in &self.now {
            let aged = hypothesis.aged(known, now);
            let Some(pulse) = current else {
                take(hypothesis, aged, false);
                continue;
            };
            let ignored = pulse.ignored.min(known.passing(pulse));
            if hypothesis.is_rest() {
                take(hypothesis, aged + ignored, false);
                if let Some(started) = hypothesis.started(known, pulse) {
                    take(&started, started.cost, true);
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
    for hypothesis in hypotheses.iter() {
        if kept.len() == MOST || hypothesis.cost > least + HOPELESS {
            break;
        }
        if !kept.iter().any(|other| other.is_like(hypothesis)) {
            kept.push(*hypothesis);
        }
    }
    hypotheses.clear();
}
