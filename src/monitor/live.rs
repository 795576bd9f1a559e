//! Everything that the cage may be doing, as far as the record up to now says.
//!
//! What a sensor reads without acceleration, its level, drifts, and may shift for seconds or for good. A
//! [`Track`] is one level with all that it implies. Where a record stays for three seconds at a distance from a level,
//! that may be a soft start or a long braking, or the level has shifted: another track begins there, with the
//! hypotheses from before, dearer by the cost of a shift. So motion and shift are both followed until the
//! evidence decides. Where the record changed at once, as when the sensor is turned, tracks begin at that moment, on the
//! level to which it came then and on that where it stays: what lies between may be a start.

use super::event::Direction;
use super::hypothesis::{Cage, Hypothesis};
use super::noise::Noises;
use super::prices::Known;
use super::recent::Recent;
use super::track::{Hand, Track};
use crate::explain::Block;
use serde::{Deserialize, Serialize};

/// What another level than the first costs where nothing is forgotten yet, and every level is tried from the beginning.
const YOUNG_SHIFT: f64 = 8.0;

/// The most tracks, and how much dearer than the cheapest one may be.
const MOST_TRACKS: usize = 4;
const HOPELESS: f64 = 12.0;

/// The noise that is assumed with a level, m/s², until there is more.
const FIRST_NOISE: Noises = Noises {
    fast: 0.02,
    slow: 0.01,
};

/// A pulse that adds at most so much is ordinary; what others add is remembered for a time, s; and beyond so much of
/// it, the record is not well explained.
const ORDINARY: f64 = 1.6;
const REMEMBERS: f64 = 90.0;
const STRAINED: f64 = 1.5;

/// Where nothing happens, only every so many blocks are judged.
const RESTS: usize = 4;

/// What calm, and its opposite, are worth where motions of the cage look different from rest, nats.
const CALM: f64 = 5.0;

/// What a hole adds to it.
const IN_HOLE: f64 = 5.0;

/// Holes up to this length can hardly hide a start, s.
const BRIEF: f64 = 1.0;

/// What is the case now.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Belief {
    /// The cheapest hypothesis at rest, and in motion, with the cost of each.
    pub rest: Option<(Hypothesis, f64)>,
    pub motion: Option<(Hypothesis, f64)>,
    /// The cost of the cheapest in motion, where faster ones count as cheaper: an error about them is worse.
    pub threat: f64,
    /// The cost of the cheapest in motion that may go another way than the cheapest does.
    pub otherwise: f64,
    /// The cost of the cheapest of all.
    pub least: f64,
    /// The current pulse, where it changes the speed of the motion: its beginning, s, and its sign.
    pub change: Option<(f64, f64)>,
    /// The level of the cheapest.
    pub level: f64,
    /// Whether the cheapest at rest and in motion have different levels.
    pub is_shifted: bool,
    /// When what looks like the cheapest in motion may have been the sensor, turned, s.
    pub turned_at: f64,
    /// Whether there is a pulse now.
    pub in_pulse: bool,
    /// The deviation of the smoothed record, m/s².
    pub noise: f64,
}

/// All tracks.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Live {
    known: Known,
    begins: Vec<Hypothesis>,
    recent: Recent,
    /// What remains of the strain after a block.
    forgets: f64,
    has_begun: bool,
    /// What was the case when it was last asked.
    latest: Belief,
    /// What the cheapest explanation has lately cost beyond that of ordinary trips, and its cost before.
    strain: f64,
    least: f64,
    /// The level that was known before.
    level: Option<f64>,
    /// Somebody who may have the sensor in hand.
    hand: Option<Hand>,
    tracks: Vec<Track>,
}

impl Live {
    pub fn new(known: Known, block: f64, begins: Vec<Hypothesis>, level: Option<f64>) -> Self {
        Self {
            known,
            recent: Recent::new(block),
            forgets: 1.0 - block / REMEMBERS,
            has_begun: false,
            latest: Belief::default(),
            tracks: Vec::with_capacity(MOST_TRACKS + 1),
            begins,
            strain: 0.0,
            least: 0.0,
            level,
            hand: None,
        }
    }

    /// Begins anew with these hypotheses.
    pub fn begin(&mut self, begins: Vec<Hypothesis>) {
        self.tracks.clear();
        if let Some(level) = self.level {
            // The sensor may have been moved since.
            self.tracks.push(Track::new(level, FIRST_NOISE, &begins));
        }
        self.begins = begins;
    }

    pub fn step(&mut self, block: Block) {
        if !self.has_begun {
            self.has_begun = true;
            self.begins.iter_mut().for_each(|it| it.since = block.from);
            self.begin(self.begins.clone());
        }
        if let Some(smooth) = self.recent.step(block) {
            let white = self.recent.white();
            for track in &mut self.tracks {
                track.step(&self.known, &smooth, white);
            }
        }
        if self.recent.is_due() {
            self.try_plateau();
            self.keep_plausible();
        }
    }

    fn try_plateau(&mut self) {
        let Some((level, since)) = self.recent.plateau() else {
            return;
        };
        let distance = |track: &Track| (track.level - level).abs();
        let home = (0..self.tracks.len())
            .min_by(|a, b| distance(&self.tracks[*a]).total_cmp(&distance(&self.tracks[*b])))
            .filter(|home| distance(&self.tracks[*home]) < self.tracks[*home].nearness());
        let is_young = self.recent.is_whole();
        let in_pulse = |track: &Track| track.is_in_pulse_since(since);
        let is_first = home.is_none() && is_young && self.tracks.iter().all(in_pulse);
        let mut turned = Vec::new();
        let mut given: Option<(Vec<Hypothesis>, Noises)> = None;
        for index in 0..self.tracks.len() {
            let track = &mut self.tracks[index];
            if Some(index) == home || !track.doubts(since, level) {
                continue;
            }
            let (all, _) = given.get_or_insert((Vec::new(), track.noise()));
            all.extend(track.hypotheses.shifted(track.level - level, false));
            turned.extend(self.turned(&self.tracks[index], level));
        }
        match (home, given) {
            (_, given) if is_first => {
                let mut track = self.first(level);
                let given = given.into_iter().flat_map(|(given, _)| given);
                track.hypotheses.join(given);
                self.tracks.push(track);
            }
            (Some(home), Some((given, _))) => self.tracks[home].hypotheses.join(given),
            (None, Some((given, noise))) => {
                let mut track = Track::new(level, noise, &[]);
                track.hypotheses.join(given);
                self.tracks.push(track);
            }
            _ => {}
        }
        self.tracks.extend(turned);
    }

    /// The track on this level where nothing is forgotten yet.
    fn first(&self, level: f64) -> Track {
        let mut track = Track::new(level, self.recent.white(), &self.begins);
        if !self.tracks.is_empty() {
            track.hypotheses.raise(self.latest.least + YOUNG_SHIFT);
        }
        self.see(&mut track);
        track
    }

    /// What a track is on a level to which the record may have come at once.
    fn turned(&self, track: &Track, level: f64) -> Vec<Track> {
        let mut turned = track.turned(level, self.recent.oldest());
        turned.iter_mut().for_each(|track| self.see(track));
        turned
    }

    /// Shows a track what has been seen since it began.
    fn see(&self, track: &mut Track) {
        let white = self.recent.white();
        for smooth in self.recent.since(track.since) {
            track.step(&self.known, smooth, white);
        }
    }

    /// Drops tracks that are hopeless, and merges those at one level.
    fn keep_plausible(&mut self) {
        let Some(now) = self.recent.now() else {
            return;
        };
        let known = &self.known;
        let cost = |track: &Track| {
            let mut least = f64::INFINITY;
            let pulse = track.current(known);
            let take = |_: &Hypothesis, cost: f64, _| least = least.min(cost);
            track.hypotheses.each(known, now, pulse.as_ref(), take);
            least
        };
        if self.tracks.len() < 2 {
            return;
        }
        let mut ranked: Vec<(f64, Track)> =
            self.tracks.drain(..).map(|it| (cost(&it), it)).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        let least = ranked[0].0;
        for (cost, track) in ranked {
            let near = |other: &Track| (other.level - track.level).abs() < 0.5 * other.nearness();
            match self.tracks.iter().position(near) {
                Some(other) => self.tracks[other].hypotheses.join(track.hypotheses.now),
                None if cost > least + HOPELESS || self.tracks.len() == MOST_TRACKS => {}
                None => self.tracks.push(track),
            }
        }
    }

    /// Goes on after a hole.
    pub fn cross(&mut self, now: f64, seconds: f64) {
        for track in &mut self.tracks {
            track.cross(now, seconds < BRIEF);
        }
        self.begins = vec![Hypothesis::rest(now, 0.0), Hypothesis::open(now, 0.0)];
        self.strain += IN_HOLE;
        self.recent.clear();
    }

    /// For how long nothing has left the likeliest level, s.
    pub fn quiet(&self) -> f64 {
        self.tracks.first().map_or(0.0, Track::quiet)
    }

    pub fn is_in_hand(&self) -> bool {
        self.hand.is_some()
    }

    /// Judges whether somebody has the sensor in hand. Who has keeps it until it lies still for three seconds. If that is not
    /// where it lay, or there was another swing, what was seen in between does not count.
    pub fn judge_hand(&mut self, now: f64) {
        let Some(first) = self.tracks.first() else {
            return;
        };
        let Some(hand) = &mut self.hand else {
            self.hand = first.hand();
            return;
        };
        hand.swings_again |= first.swings_after(hand.since);
        let hand = *hand;
        let plateau = self.recent.plateau();
        let Some((level, _)) = plateau.filter(|(_, since)| *since >= hand.since) else {
            return;
        };
        self.hand = None;
        if hand.swings_again || (first.level - level).abs() > first.nearness() {
            self.put_down(level, now);
        }
    }

    /// Goes on with another level, as after a hole.
    fn put_down(&mut self, level: f64, now: f64) {
        self.cross(now, f64::INFINITY);
        let mut track = Track::new(level, self.recent.white(), &[]);
        for held in self.tracks.drain(..) {
            track.hypotheses.join(held.hypotheses.now);
        }
        self.tracks.push(track);
    }

    /// What is the case now.
    /// `is_calm` says whether the record looks like rest, if motions of the cage do not.
    pub fn belief(&mut self, is_calm: Option<bool>) -> Belief {
        let is_settled = self.recent.now().is_some() && self.tracks.iter().all(Track::is_settled);
        if is_settled && !self.recent.count.is_multiple_of(RESTS) {
            return self.latest;
        }
        let mut belief = self.cheapest();
        let is_open = belief.motion.is_some_and(|(it, _)| it.cage == Cage::Open);
        if is_calm == Some(true) {
            belief.threat += CALM;
            belief.otherwise += CALM;
            belief.motion.iter_mut().for_each(|best| best.1 += CALM);
        } else if is_calm == Some(false) && is_open {
            belief.rest.iter_mut().for_each(|best| best.1 += CALM);
        }
        self.strain *= if is_settled {
            self.forgets.powi(RESTS as i32)
        } else {
            self.forgets
        };
        if !belief.in_pulse && belief.least.is_finite() {
            self.strain += (belief.least - self.least - ORDINARY).max(0.0);
            self.least = belief.least;
        }
        self.latest = belief;
        belief
    }

    fn cheapest(&self) -> Belief {
        let mut belief = Belief {
            threat: f64::INFINITY,
            otherwise: f64::INFINITY,
            turned_at: f64::INFINITY,
            ..Belief::default()
        };
        let Some(now) = self.recent.now() else {
            return belief;
        };
        let mut levels = [0.0; 2];
        let mut ways = [f64::INFINITY; 3];
        for track in &self.tracks {
            let pulse = track.current(&self.known);
            let take = |it: &Hypothesis, cost: f64, changes: bool| {
                let is_rest = it.is_rest();
                if !is_rest {
                    let danger = it.danger(&self.known, self.strain > STRAINED);
                    belief.threat = belief.threat.min(cost - danger);
                    let least = &mut ways[way(it)];
                    *least = least.min(cost);
                }
                let best = if is_rest {
                    &mut belief.rest
                } else {
                    &mut belief.motion
                };
                if best.is_some_and(|best| best.1 <= cost) {
                    return;
                }
                *best = Some((*it, cost));
                levels[usize::from(is_rest)] = track.level;
                if !is_rest {
                    belief.turned_at = track.turned_at();
                    belief.change = pulse.filter(|_| changes).map(|it| (it.from, it.change));
                }
            };
            track
                .hypotheses
                .each(&self.known, now, pulse.as_ref(), take);
            belief.in_pulse |= pulse.is_some();
        }
        let least = |best: Option<(Hypothesis, f64)>| best.map_or(f64::INFINITY, |best| best.1);
        belief.least = least(belief.rest).min(least(belief.motion));
        if let Some((it, _)) = &belief.motion {
            ways[way(it)] = f64::INFINITY;
            belief.otherwise = ways.into_iter().fold(f64::INFINITY, f64::min);
        }
        belief.noise = self.recent.noise();
        belief.is_shifted = levels[0] != levels[1];
        if let Some(first) = self.tracks.first() {
            belief.level = first.level;
        }
        belief
    }
}

/// The way of a motion among all ways: up, down, unknown.
fn way(motion: &Hypothesis) -> usize {
    match motion.direction() {
        Some(Direction::Up) => 0,
        Some(Direction::Down) => 1,
        None => 2,
    }
}
