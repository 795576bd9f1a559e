//! The floors of a building and where the car stands, from the distances of its trips. [^1]
//!
//! The state is x = [p, q, m₁ … m_M]: the car at this stop and at the stop before, and the floors, m from the
//! floor of the first stop up. A trip moves p ← p + δp with the variance of its distance. A stop at floor i says
//! 0 = p − mᵢ + v, var v = σ_s², the scatter of stops about their floor. With
//!
//! ξ(i) = (p − mᵢ)²/S(i), S(i) = P_pp − 2 P_pi + P_ii + σ_s²,
//!
//! the stop belongs to the floor of least ξ(i) in [^1], or of least ξ(i) + ln S(i), the likelihood: a floor that is
//! known to metres has a small ξ for every stop. Only S is divided by: P is singular, as m₁ = 0 is exact.
//! ξ > γ_s is an alarm, and the estimate is not updated.
//!
//! # What [^1] leaves open
//! The car stands somewhere after an alarm too. Where the trip was measured wrongly, [^1] carries its error
//! along, and alarms come in pairs. So there is a hypothesis for every floor, and one for "off every floor", each
//! with an estimate and a cost, −2 ln of its likelihood up to what all share:
//!
//! | a hypothesis says | costs |
//! |---|---|
//! | the car stopped at floor i | ξ(i)/κ − 2 ln of how much more often than others this floor is visited |
//! | it stopped off every floor | γ_s; far beyond the shaft γ_s/2 more than a missed trip; ξ/κ of a place where it did so before |
//! | a trip was missed, the car is at floor i | [`Settings::missed`] |
//!
//! Of those that end alike the cheapest is kept, as Viterbi does, and the chance that a trip was missed adds up over
//! trips: a discrete filter over floors. The stop was abnormal or the trip was wrong, the next stop decides: it is
//! judged by the one of these that fits. A missed trip, which shifts p by whole floors, is healed once the shaft's
//! ends or the usual traffic contradict it. Where all floors are equally apart and equally visited, nothing else
//! can tell.
//!
//! **Judged again.** The hypothesis "off every floor" has q without the previous stop's update. Once the stop
//! after it is at a floor, ξ of q against its floor uses the trip in and the trip out, σ⁻² = σ_in⁻² + σ_out⁻². It
//! equals ξ + ξ′ − ξ″, with ξ′ of the next stop had the previous one been at its floor, ξ″ had it not.
//! Two stops with a trip between them that fits neither are both alarmed; the next trip takes the second back or not.
//!
//! **Scale.** Trips noisier than they claim raise every ξ. κ is the running median of ξ over that of χ²₁, at least
//! 1: ξ/κ is tested, and deviations are multiplied by √κ.
//!
//! **Floors missed at the start.** Three stops off every floor that agree become a floor, with the variance of
//! their mean.
//!
//! # Assumptions
//! Errors of trips are independent, normal and without bias. Floors do not move: of one that does, stops after long
//! trips drag the map along. The map as it was after ten stops per floor is kept, and a floor's drift from it has
//! the variance P₀ − P if it has not moved.
//!
//! [^1]: the patent, claims 4 to 6: "lift motion detection and abnormal stops from an acceleration sensor".

mod hypothesis;
mod scale;
mod settings;
mod start;
mod stop;
#[cfg(test)]
mod tests;

pub use settings::{Association, Settings};
pub use start::{Map, MapError, Start};
pub use stop::{Fault, Floor, Height, Judgement, Stop};

use hypothesis::{BEFORE, CAR, Hypothesis, Offset};
use libm::{exp, log, sqrt};
use scale::Scale;

/// Visits that each floor is taken to have had: chance must not look like habit.
const USUAL: f64 = 30.0;
/// The map is commissioned once there were so many stops per floor.
const COMMISSIONING: u64 = 10;
/// So many stops off every floor that agree are a floor.
const CONSISTENT: usize = 3;
/// A lost car is found once every other floor costs more, a tenth as likely.
const UNDECIDED: f64 = 4.6;
/// The most floors of a building.
pub const MOST_FLOORS: usize = 200;

/// The floors of a building and the car among them.
#[derive(Clone, Debug)]
pub struct Floors {
    settings: Settings,
    /// The cheapest first; it costs 0.
    hypotheses: Vec<Hypothesis>,
    /// How often the car stopped at each floor.
    visits: Vec<u64>,
    scale: Scale,
    /// The floor that the latest stop was judged by; none in the first sweep.
    nearest: Option<usize>,
    is_swept: bool,
    /// Whether the car may be at any of several floors since a trip was lost.
    is_lost: bool,
    /// Whether it may have been before the latest stop, whose floor nothing then judges again.
    was_lost: bool,
    /// Each floor as it was after the first stops.
    commissioned: Option<Vec<Height>>,
}

/// The cheapest way to a hypothesis.
#[derive(Clone, Copy)]
struct Way {
    cost: f64,
    parent: usize,
}

/// The cost of either of two courses, −2 ln (exp(−a/2) + exp(−b/2)).
fn joint(a: f64, b: f64) -> f64 {
    a.min(b) - 2.0 * libm::log1p(exp(-0.5 * (a - b).abs()))
}

impl Floors {
    /// Takes the distance of a trip, m upwards, with its variance, and judges the stop after it, and the stop
    /// before it again.
    pub fn step(&mut self, distance: f64, variance: f64) -> Stop {
        let from = self.best().floor.filter(|_| !self.is_lost);
        let stop = self.stop_after(distance, variance);
        // A floor that was added below it has moved it up.
        let moved = |of: usize| of + usize::from(stop.added.is_some_and(|at| of >= at));
        Stop {
            from: from.map(moved),
            ..stop
        }
    }

    fn stop_after(&mut self, distance: f64, variance: f64) -> Stop {
        for hypothesis in &mut self.hypotheses {
            hypothesis.go(distance, variance);
        }
        if let Some(floor) = self.sweep(distance) {
            return self.stop(None, None, Some(floor));
        }
        let factor = self.scale.factor();
        let (by, floor, offset) = self.believed(factor);
        let judgement = self.judge(by, CAR, floor, offset);
        self.scale.push(offset.xi());
        let off = self
            .hypotheses
            .iter()
            .find(|of| of.floor.is_none())
            .cloned();
        if self.settings.branches {
            self.branch(factor);
        } else {
            let is_level = judgement.fault.is_none();
            self.hypotheses[0].stop_at(is_level.then_some(floor), &self.settings);
        }
        let earlier = off.and_then(|off| self.judge_again(off));
        self.nearest = Some(floor);
        self.was_lost = self.is_lost;
        self.is_lost &= self.hypotheses[1..].iter().any(|of| of.cost <= UNDECIDED);
        if let Some(floor) = self.best().floor {
            self.visits[floor] += 1;
        }
        let added = self.add_floor();
        self.commission();
        self.stop(Some(judgement), earlier, added)
    }

    /// Says that a trip was not measured: the car may be at any floor.
    pub fn lose(&mut self) {
        self.is_swept = true;
        self.is_lost = true;
        let best = self.best();
        let mut lost: Vec<Hypothesis> = (0..self.visits.len())
            .map(|floor| best.anchored(floor, self.visit_cost(floor), &self.settings))
            .collect();
        lost.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let least = lost[0].cost;
        lost.iter_mut().for_each(|of| of.cost -= least);
        self.hypotheses = lost;
        self.nearest = None;
    }

    /// Every floor from the lowest up.
    pub fn floors(&self) -> Vec<Floor> {
        let factor = self.scale.factor();
        let floor = |(at, &visits): (usize, &u64)| {
            let now = self.best().height(at);
            let first = self.commissioned.as_ref().map_or(now, |all| all[at]);
            Floor {
                height: now.mean,
                deviation: sqrt(now.variance * factor),
                drift: now.mean - first.mean,
                drift_deviation: sqrt((first.variance - now.variance).max(0.0) * factor),
                visits,
            }
        };
        self.visits.iter().enumerate().map(floor).collect()
    }

    /// Keeps the map once it has settled.
    fn commission(&mut self) {
        let floors = self.visits.len();
        let stops: u64 = self.visits.iter().sum();
        if self.commissioned.is_none() && stops >= COMMISSIONING * floors as u64 {
            let heights = (0..floors).map(|floor| self.best().height(floor));
            self.commissioned = Some(heights.collect());
        }
    }

    fn best(&self) -> &Hypothesis {
        &self.hypotheses[0]
    }

    /// What a stop is judged by: the cheapest way to a floor, from the best hypothesis or from where the car may as well
    /// have been: after an alarm at its floor, if the trip was wrong; of an unknown car at any floor.
    fn believed(&self, factor: f64) -> (&Hypothesis, usize, Offset) {
        let settings = &self.settings;
        let is_rival = |of: &&Hypothesis| match self.best().floor {
            None => of.floor == self.nearest && of.cost <= settings.threshold,
            Some(_) => self.is_lost && of.floor.is_some() && of.cost <= UNDECIDED,
        };
        let rivals = self.hypotheses[1..].iter().filter(is_rival);
        let fits = [self.best()].into_iter().chain(rivals).map(|of| {
            let (floor, offset) = of.associate(settings);
            (of, floor, offset)
        });
        let cost = |(of, _, offset): &(&Hypothesis, usize, Offset)| of.cost + offset.xi() / factor;
        let cheapest = fits.min_by(|a, b| cost(a).total_cmp(&cost(b)));
        cheapest.expect("there is a hypothesis")
    }

    fn judge(&self, of: &Hypothesis, at: usize, floor: usize, offset: Offset) -> Judgement {
        let factor = self.scale.factor();
        let xi = offset.xi() / factor;
        let is_alarm = xi > self.settings.threshold;
        Judgement {
            floor,
            offset: offset.mean,
            deviation: sqrt(offset.variance * factor),
            xi,
            fault: is_alarm.then(|| of.fault(at, offset.mean, &self.settings)),
        }
    }

    /// Judges the stop before by the trip in and the trip out, if this one is at a floor: by the hypothesis that the
    /// stop before was off every floor, or by the best of all.
    fn judge_again(&self, mut off: Hypothesis) -> Option<Judgement> {
        let is_known = self.settings.branches && !self.was_lost;
        let before = self.nearest.filter(|_| is_known)?;
        let (floor, offset) = off.associate(&self.settings);
        let is_level = offset.xi() / self.scale.factor() <= self.settings.threshold;
        let floor = if is_level { floor } else { self.best().floor? };
        off.stop_at(Some(floor), &self.settings);
        let offset = off.offset(BEFORE, before, &self.settings);
        Some(self.judge(&off, BEFORE, before, offset))
    }

    /// Follows every way to stop, and of those that end alike the cheapest.
    fn branch(&mut self, factor: f64) {
        let off = self.visits.len();
        let ways = self.ways(factor);
        let first = (0..=off).min_by(|&a, &b| ways[a].cost.total_cmp(&ways[b].cost));
        let first = first.unwrap_or(off);
        let least = ways[first].cost;
        let follow = |end: usize, cost: f64| {
            let mut child = self.hypotheses[ways[end].parent].clone();
            child.cost = cost;
            child.stop_at((end < off).then_some(end), &self.settings);
            child
        };
        let best = follow(first, 0.0);
        let others = (0..=off).filter(|end| *end != first).map(|end| {
            let missed = self.settings.missed.filter(|_| end < off);
            let excess = ways[end].cost - least;
            match missed {
                Some(missed) if excess > missed => {
                    best.anchored(end, joint(excess, missed), &self.settings)
                }
                Some(missed) => follow(end, joint(excess, missed)),
                None => follow(end, excess),
            }
        });
        let others: Vec<Hypothesis> = others.filter(|of| of.cost.is_finite()).collect();
        self.hypotheses = [best].into_iter().chain(others).collect();
    }

    /// The cheapest way to stop at each floor, and last the cheapest to stop off every floor.
    fn ways(&self, factor: f64) -> Vec<Way> {
        let settings = &self.settings;
        let none = Way {
            cost: f64::INFINITY,
            parent: 0,
        };
        let mut ways = vec![none; self.visits.len() + 1];
        let mut offer = |end: usize, cost: f64, parent: usize| {
            if cost < ways[end].cost {
                ways[end] = Way { cost, parent };
            }
        };
        for (parent, of) in self.hypotheses.iter().enumerate() {
            let (floor, offset) = of.associate(settings);
            let visit = offset.xi() / factor + self.visit_cost(floor);
            offer(floor, of.cost + visit, parent);
            let off = of.cost_off(factor, settings);
            offer(self.visits.len(), of.cost + off, parent);
        }
        ways
    }

    /// −2 ln of how much more often than the average floor this one is visited.
    fn visit_cost(&self, floor: usize) -> f64 {
        let floors = self.visits.len() as f64;
        let all = self.visits.iter().sum::<u64>() as f64 + USUAL * floors;
        -2.0 * log((self.visits[floor] as f64 + USUAL) / all * floors)
    }

    /// Makes a floor of stops off every floor that agree.
    fn add_floor(&mut self) -> Option<usize> {
        if self.visits.len() == MOST_FLOORS {
            return None;
        }
        let found = self.hypotheses[0].take_consistent(CONSISTENT, &self.settings)?;
        let best = &mut self.hypotheses[0];
        let at = best.insert(found, None);
        let best = best.clone();
        self.visits.insert(at, CONSISTENT as u64);
        if let Some(commissioned) = &mut self.commissioned {
            commissioned.insert(at, found);
        }
        self.nearest = self.nearest.map(|of| of + usize::from(of >= at));
        // The others know nothing of it: start them anew from the best.
        self.hypotheses = vec![best];
        Some(at)
    }

    fn stop(
        &self,
        judgement: Option<Judgement>,
        earlier: Option<Judgement>,
        added: Option<usize>,
    ) -> Stop {
        let best = self.best();
        let likelihoods = self.hypotheses.iter().map(|of| exp(-0.5 * of.cost));
        let car = best.car();
        Stop {
            position: car.mean,
            deviation: sqrt(car.variance * self.scale.factor()),
            from: None,
            floor: best.floor,
            probability: 1.0 / likelihoods.sum::<f64>(),
            judgement,
            earlier,
            added,
        }
    }
}
