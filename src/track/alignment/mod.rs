//! How far the clock of an accelerometer is ahead of a barometer's, by the trips that both saw.
//!
//! The trips predict the car's height h(t), the pressure says y(t). Over L = 8 s the weather hardly changes, so that where
//! the clock is ahead by τ
//!
//! y(t + L) − y(t) = ± (h(t + τ + L) − h(t + τ)) + noise,
//!
//! with − where up is down. Every τ is tried for which the records overlap at all, every half second. Its *misfit* is the sum
//! of ρ = min(r²/σ², 25) over the residuals r wherever one of the two moves, and its *evidence* is how much larger that sum
//! would be if the car had stood. The best τ is that of the most evidence; it is refined to the minimum of the misfit, and
//! its deviation is that of least squares in white noise of means of a second.
//!
//! # When it is believed
//! - The best τ has a whole trip in both records, and holds half of the motion of that record which has less of it; if it has
//!   only one trip, of either record.
//! - The mean of ρ is at most 6: one trip of two that does not fit has more.
//! - At no other τ do the trips, at least 0.6 of its motion, fit as well, whatever else the barometer shows there: the
//!   likelihood ratio is a million, when eight residuals count for one, since those within 8 s overlap. Equal trips a
//!   constant headway apart are refused by this.
//!
//! What the clocks say is believed before the rides: where the rides fit it to 2 s it is kept, and so it is where no other τ is
//! believed. It gives way only to one that is off by more than 2 s and 5 deviations, which the caller should say.
//!
//! A barometer lags by up to a second. That cannot be told from its clock, and is part of τ.

mod error;
mod search;

pub use error::AlignmentError;

use super::air::{above_first, kelvin};
use super::course::Course;
use super::record::Track;
use crate::detection::{Detection, Undecided};
use crate::recording::Barometer;
use crate::stats::quantile::median;
use search::{Fit, MOST, OFF, PITCH, SCALE, Search};
use serde::Serialize;
use std::fmt;

/// L in steps of the search.
const OVER: usize = 16;

/// That of the refinement, s.
const FINE: f64 = 0.05;

/// Other τ are farther off than this, s, and than so many deviations.
const APART: f64 = 4.0;

/// The error of h besides the noise, m, as where a barometer lags in a pulse.
const BLUR: f64 = 0.2;

/// Readings further apart are not joined, s.
const GAP: f64 = 5.0;

/// Longer records are not searched, s.
const LONGEST: f64 = 172_800.0;

/// A clock is another than it says if it is off by so many deviations, and more.
const CERTAIN: f64 = 5.0;

/// Two clocks, brought together.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Alignment {
    /// How far the accelerometer's clock is ahead of the barometer's, s.
    pub ahead: f64,
    /// Its standard deviation, s.
    pub deviation: f64,
    /// What the clocks themselves said, if anything.
    pub instead_of: Option<f64>,
}

impl fmt::Display for Alignment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (ahead, deviation) = (self.ahead, self.deviation);
        write!(
            f,
            "its clock {ahead:.2} ± {deviation:.2} s behind by the rides"
        )
    }
}

impl Track {
    /// Brings its clock and a barometer's together; none where that is not needed, since the rides agree with how far ahead
    /// the clocks say it is, `said`. The air's temperature is given, °C, or as usual; so is whether the record shows which way
    /// is up.
    ///
    /// # Errors
    /// If no offset is clearly the best.
    pub fn align(
        &self,
        detection: &Detection,
        barometer: &Barometer,
        said: Option<f64>,
        celsius: Option<f64>,
        is_up_known: bool,
    ) -> Result<Option<Alignment>, AlignmentError> {
        let rides = self.trips.iter().filter(|it| it.distance.is_some());
        let rides = rides.filter_map(|it| it.trip.start.zip(it.trip.stop));
        let rides: Vec<(f64, f64)> = rides.collect();
        let means = means(&above_first(&barometer.readings, kelvin(celsius)));
        let [first, .., last] = &means[..] else {
            return Err(AlignmentError::Readings);
        };
        let Some(span) = self.span().filter(|_| !rides.is_empty()) else {
            return Err(AlignmentError::NoRide);
        };
        if (last.0 - first.0).max(span.1 - span.0) > LONGEST {
            return Err(AlignmentError::Long);
        }
        let known = Known {
            course: &self.course,
            undecided: &detection.undecided,
        };
        let search = Search::new(
            changes(&means, (first.0, last.0)),
            known.changes(span),
            span.0 - first.0,
            variance(&means),
        );
        let signs: &[f64] = if is_up_known { &[1.0] } else { &[1.0, -1.0] };
        let in_both = |ahead: f64| {
            let (from, to) = (first.0 + ahead, last.0 + ahead);
            rides.iter().filter(|it| from < it.0 && it.1 < to).count()
        };
        // Rides that a clock leaves without readings count against it.
        let is_believed = |said: f64| {
            let agrees = search.agrees(said, signs);
            agrees.is_some_and(|it| it.motion >= search.least_motion(in_both(said)))
        };
        if said.is_some_and(is_believed) {
            return Ok(None);
        }
        let fits = search.fits(signs);
        let best = search.best(&fits)?;
        let (ahead, deviation) = known.refined(&means, &best, search.variance);
        if best.motion < search.least_motion(in_both(best.ahead)) || !deviation.is_finite() {
            return Err(AlignmentError::Few);
        }
        best.is_only(&fits, APART.max(CERTAIN * deviation))?;
        let is_needed = |said: f64| (ahead - said).abs() > OFF.max(CERTAIN * deviation);
        Ok(said.is_none_or(is_needed).then_some(Alignment {
            ahead,
            deviation,
            instead_of: said,
        }))
    }

    /// From when to when the course is known, s.
    fn span(&self) -> Option<(f64, f64)> {
        let mut places = self.course.stretches().iter().flatten();
        Some((places.next()?.time, places.next_back()?.time))
    }
}

/// What is known of the car's motion.
struct Known<'a> {
    course: &'a Course,
    undecided: &'a [Undecided],
}

impl Known<'_> {
    fn change(&self, from: f64, to: f64) -> Option<f64> {
        let is_decided = |it: &Undecided| to < it.from || from > it.to;
        let is_decided = self.undecided.iter().all(is_decided);
        is_decided.then(|| self.course.change(from, to)).flatten()
    }

    /// How far the car moves in L after each half second; NaN where that is not known.
    fn changes(&self, (from, to): (f64, f64)) -> Vec<f64> {
        let long = PITCH * OVER as f64;
        let cells = ((to - from - long) / PITCH).max(0.0) as usize;
        let times = (0..=cells).map(|cell| from + PITCH * cell as f64);
        let changes = times.map(|time| self.change(time, time + long));
        changes.map(|it| it.unwrap_or(f64::NAN)).collect()
    }

    /// The offset of the least misfit near the best one, and its deviation, s.
    fn refined(&self, means: &[(f64, f64)], best: &Fit, variance: f64) -> (f64, f64) {
        let pairs = pairs(means);
        let change = |(one, other): (usize, usize), ahead: f64| {
            let change = self.change(means[one].0 + ahead, means[other].0 + ahead)?;
            Some(best.sign * change)
        };
        let rho = |pair: (usize, usize), ahead: f64| {
            let change = change(pair, ahead)?;
            let scale = variance + (SCALE * change).powi(2);
            let off = means[pair.1].1 - means[pair.0].1 - change;
            Some((off * off / scale, scale))
        };
        let misfit = |ahead: f64| {
            let rhos = pairs.iter().filter_map(|pair| rho(*pair, ahead));
            rhos.map(|(rho, _)| rho.min(MOST)).sum::<f64>()
        };
        let tried = (-30..=30).map(|step| best.ahead + FINE * f64::from(step));
        let tried = tried.map(|ahead| (misfit(ahead), ahead));
        let (here, least) = tried
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, best.ahead));
        let wide = 5.0 * FINE;
        let [before, after] = [-wide, wide].map(|off| misfit(least + off));
        let bend = before + after - 2.0 * here;
        let off = if bend > 0.0 {
            wide * (before - after) / (2.0 * bend)
        } else {
            0.0
        };
        let ahead = least + off.clamp(-wide, wide);
        // Least squares: τ's error is Σ g r/Σ g² with the slope g of the change, and every mean is in several of the r.
        let mut shares = vec![0.0; means.len()];
        let (mut squares, mut count, mut power) = (0.0, 0.0, 0.0);
        for &pair in &pairs {
            let slope = change(pair, ahead + PITCH / 2.0).zip(change(pair, ahead - PITCH / 2.0));
            let slope = slope.map_or(0.0, |(after, before)| (after - before) / PITCH);
            if let Some((rho, scale)) = rho(pair, ahead).filter(|it| it.0 < MOST && slope != 0.0) {
                let weight = slope / scale;
                squares += slope * weight;
                shares[pair.0] -= weight;
                shares[pair.1] += weight;
                count += 1.0;
                power += rho * scale / 2.0;
            }
        }
        let shares: f64 = shares.iter().map(|it| it * it).sum();
        (ahead, (shares * power / count).sqrt() / squares)
    }
}

/// Means of a second, each at its mean time.
fn means(readings: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let seconds = readings.chunk_by(|a, b| a.0.floor() == b.0.floor());
    let mean = |some: &[(f64, f64)]| {
        let sum = some
            .iter()
            .fold((0.0, 0.0), |sum, it| (sum.0 + it.0, sum.1 + it.1));
        (sum.0 / some.len() as f64, sum.1 / some.len() as f64)
    };
    seconds.map(mean).collect()
}

/// Means that are L apart.
fn pairs(means: &[(f64, f64)]) -> Vec<(usize, usize)> {
    let long = PITCH * OVER as f64;
    let pair = |place: usize| {
        let from = means[place].0;
        let other = means.partition_point(|it| it.0 < from + long - PITCH);
        let is_near = means.get(other)?.0 <= from + long + GAP;
        is_near.then_some((place, other))
    };
    (0..means.len()).filter_map(pair).collect()
}

/// How much the height changes in L after each half second, on the lines between means; NaN where they are too far apart.
fn changes(means: &[(f64, f64)], (from, to): (f64, f64)) -> Vec<f64> {
    let mut next = 1;
    let cells = ((to - from) / PITCH) as usize;
    let heights = (0..=cells).map(|cell| {
        let time = from + PITCH * cell as f64;
        while next + 1 < means.len() && means[next].0 < time {
            next += 1;
        }
        let (a, b) = (means[next - 1], means[next]);
        let height = a.1 + (b.1 - a.1) * (time - a.0) / (b.0 - a.0);
        if b.0 - a.0 > GAP { f64::NAN } else { height }
    });
    over(&heights.collect::<Vec<f64>>())
}

fn over(heights: &[f64]) -> Vec<f64> {
    let later = heights.iter().skip(OVER);
    later.zip(heights).map(|(later, now)| later - now).collect()
}

/// Of a change: the noise of means by their second differences, which uniform motion has none of, and their steps.
fn variance(means: &[(f64, f64)]) -> f64 {
    let bends = means
        .windows(3)
        .map(|it| (it[2].1 - 2.0 * it[1].1 + it[0].1).abs());
    let noise = 1.4826 * median(bends.collect()) / 6f64.sqrt();
    let steps = means.windows(2).map(|it| (it[1].1 - it[0].1).abs());
    let step = steps.filter(|it| *it > 0.0).fold(f64::INFINITY, f64::min);
    let noise = if step.is_finite() {
        noise.max(0.4 * step)
    } else {
        noise
    };
    2.0 * noise * noise + BLUR * BLUR
}
