//! One course of events: an estimate of car and floors, and its cost.

use super::settings::{Association, Settings};
use super::stop::{Fault, Height};
use crate::kalman::Estimate;
use libm::log;

/// The places of p and q in the state.
pub(super) const CAR: usize = 0;
pub(super) const BEFORE: usize = 1;
/// The place of the lowest floor.
const FLOORS: usize = 2;
/// A stop beyond the shaft costs so many thresholds more than a missed trip: more than that alone, which a stop at a
/// floor that the car cannot have reached shows, less than a missed trip and a stop off every floor.
const BEYOND: f64 = 0.5;
/// So many stops off every floor are remembered.
const REMEMBERED: usize = 16;

/// How far the car is from a floor: p − mᵢ, m, and S(i), m².
#[derive(Clone, Copy, Debug)]
pub(super) struct Offset {
    pub mean: f64,
    pub variance: f64,
}

impl Offset {
    /// (p − mᵢ)²/S(i).
    pub fn xi(self) -> f64 {
        self.mean * self.mean / self.variance
    }
}

#[derive(Clone, Debug)]
pub(super) struct Hypothesis {
    estimate: Estimate<Vec<f64>, Vec<f64>>,
    /// −2 ln of the likelihood, up to what all hypotheses share.
    pub cost: f64,
    /// Where the car stopped last; none off every floor.
    pub floor: Option<usize>,
    /// Stops off every floor, far from each.
    unexplained: Vec<Height>,
}

impl Hypothesis {
    /// A car at a floor that defines the height 0.
    pub fn first(settings: &Settings) -> Self {
        let level = settings.level * settings.level;
        let estimate = Estimate {
            mean: vec![0.0; 3],
            covariance: vec![level, level, 0.0, level, level, 0.0, 0.0, 0.0, 0.0],
        };
        Self {
            estimate,
            cost: 0.0,
            floor: Some(0),
            unexplained: Vec::new(),
        }
    }

    /// Floors with their covariance, row by row, and the car at the lowest.
    pub fn of(heights: &[f64], covariance: &[f64], settings: &Settings) -> Self {
        let (floors, size) = (heights.len(), heights.len() + FLOORS);
        let mut estimate = Estimate {
            mean: vec![0.0; size],
            covariance: vec![0.0; size * size],
        };
        estimate.mean[FLOORS..].copy_from_slice(heights);
        for (at, row) in covariance.chunks_exact(floors).enumerate() {
            estimate.covariance[(FLOORS + at) * size + FLOORS..][..floors].copy_from_slice(row);
        }
        let unanchored = Self {
            estimate,
            cost: 0.0,
            floor: None,
            unexplained: Vec::new(),
        };
        unanchored.anchored(0, 0.0, settings)
    }

    fn size(&self) -> usize {
        self.estimate.mean.len()
    }

    fn covariance(&self, i: usize, j: usize) -> f64 {
        self.estimate.covariance[i * self.size() + j]
    }

    fn at(&self, place: usize) -> Height {
        Height {
            mean: self.estimate.mean[place],
            variance: self.covariance(place, place),
        }
    }

    pub fn car(&self) -> Height {
        self.at(CAR)
    }

    pub fn height(&self, floor: usize) -> Height {
        self.at(FLOORS + floor)
    }

    pub fn floors(&self) -> usize {
        self.size() - FLOORS
    }

    /// The covariance of the floors, row by row.
    pub fn floor_covariance(&self) -> Vec<f64> {
        let rows = self
            .estimate
            .covariance
            .chunks_exact(self.size())
            .skip(FLOORS);
        rows.flat_map(|row| &row[FLOORS..]).copied().collect()
    }

    /// Makes the element `to` an equal of the element `from`.
    fn copy(&mut self, from: usize, to: usize) {
        let n = self.size();
        let Estimate { mean, covariance } = &mut self.estimate;
        mean[to] = mean[from];
        covariance.copy_within(from * n..(from + 1) * n, to * n);
        for row in covariance.chunks_exact_mut(n) {
            row[to] = row[from];
        }
    }

    /// A trip: q ← p, p ← p + δp.
    pub fn go(&mut self, distance: f64, variance: f64) {
        self.copy(CAR, BEFORE);
        self.estimate.mean[CAR] += distance;
        self.estimate.covariance[CAR] += variance;
    }

    /// How far the car is, or was, from a floor.
    pub fn offset(&self, of: usize, floor: usize, settings: &Settings) -> Offset {
        let floor = FLOORS + floor;
        let spread = self.covariance(of, of) - 2.0 * self.covariance(of, floor)
            + self.covariance(floor, floor);
        Offset {
            mean: self.estimate.mean[of] - self.estimate.mean[floor],
            variance: spread + settings.level * settings.level,
        }
    }

    /// The floor that the car most likely stopped at.
    pub fn associate(&self, settings: &Settings) -> (usize, Offset) {
        let misfit = |offset: Offset| match settings.association {
            Association::Nearest => offset.xi(),
            Association::Likeliest => offset.xi() + log(offset.variance),
        };
        let offsets = (0..self.floors()).map(|floor| (floor, self.offset(CAR, floor, settings)));
        let best = offsets.min_by(|a, b| misfit(a.1).total_cmp(&misfit(b.1)));
        best.expect("a map has a floor")
    }

    /// Ends the trip at a floor, which updates the estimate, or off every floor, which does not.
    pub fn stop_at(&mut self, floor: Option<usize>, settings: &Settings) {
        let was_off = self.floor.is_none();
        self.floor = floor;
        let Some(floor) = floor else { return };
        let mut row = vec![0.0; self.size()];
        (row[CAR], row[FLOORS + floor]) = (1.0, -1.0);
        let level = settings.level * settings.level;
        self.estimate.update(&row, 0.0, level);
        let before = self.at(BEFORE);
        let is_far = |floor| (before.mean - self.height(floor).mean).abs() > settings.least_storey;
        if was_off && (0..self.floors()).all(is_far) {
            self.unexplained.truncate(REMEMBERED - 1);
            self.unexplained.insert(
                0,
                Height {
                    variance: before.variance + level,
                    ..before
                },
            );
        }
    }

    /// The same floors with the car at one of them, however it came there.
    pub fn anchored(&self, floor: usize, cost: f64, settings: &Settings) -> Self {
        let mut anchored = Self {
            cost,
            floor: Some(floor),
            ..self.clone()
        };
        anchored.copy(FLOORS + floor, CAR);
        let n = self.size();
        anchored.estimate.covariance[CAR * n + CAR] += settings.level * settings.level;
        anchored.copy(CAR, BEFORE);
        anchored
    }

    /// What a stop off every floor costs: less where the car stopped so before, more where no car can go.
    pub fn cost_off(&self, scale: f64, settings: &Settings) -> f64 {
        let car = self.car();
        let [lowest, highest] = self.ends();
        let reach = lowest - settings.overtravel..=highest + settings.overtravel;
        let cost = if reach.contains(&car.mean) {
            settings.threshold
        } else {
            settings.missed.unwrap_or_default().max(settings.threshold)
                + BEYOND * settings.threshold
        };
        let again = self.unexplained.iter().map(|of| {
            let apart = car.mean - of.mean;
            apart * apart / (car.variance + of.variance) / scale
        });
        again.fold(cost, f64::min)
    }

    fn ends(&self) -> [f64; 2] {
        [self.height(0).mean, self.height(self.floors() - 1).mean]
    }

    /// What an alarm means, `offset` from the nearest floor.
    pub fn fault(&self, of: usize, offset: f64, settings: &Settings) -> Fault {
        let at = self.at(of).mean;
        let [lowest, highest] = self.ends();
        if offset.abs() <= settings.levelling {
            Fault::MisLevelling
        } else if at < lowest {
            Fault::Pit
        } else if at > highest {
            Fault::Overrun
        } else {
            Fault::BetweenFloors
        }
    }

    /// Takes the mean of `wanted` unexplained stops that agree with the newest of them.
    pub fn take_consistent(&mut self, wanted: usize, settings: &Settings) -> Option<Height> {
        let newest = *self.unexplained.first()?;
        let agrees = |of: &Height| {
            let apart = of.mean - newest.mean;
            apart * apart <= settings.threshold * (of.variance + newest.variance)
        };
        let (agreeing, others): (Vec<Height>, Vec<Height>) =
            self.unexplained.iter().partition(|of| agrees(of));
        if agreeing.len() < wanted {
            return None;
        }
        self.unexplained = others;
        let weight: f64 = agreeing.iter().map(|of| 1.0 / of.variance).sum();
        let sum: f64 = agreeing.iter().map(|of| of.mean / of.variance).sum();
        Some(Height {
            mean: sum / weight,
            variance: 1.0 / weight,
        })
    }

    /// Adds a floor at its place among the others, and says which it is: with the errors of an element of the
    /// state and some of its own, or with its own alone.
    pub fn insert(&mut self, floor: Height, errors_of: Option<usize>) -> usize {
        let n = self.size();
        let lower = (0..self.floors()).filter(|of| self.height(*of).mean < floor.mean);
        let new = lower.count();
        let place = FLOORS + new;
        let old = |i: usize| match i {
            i if i == place => errors_of,
            i => Some(i - usize::from(i > place)),
        };
        let mut covariance = Vec::with_capacity((n + 1) * (n + 1));
        for i in 0..=n {
            let row = (0..=n).map(|j| match (old(i), old(j)) {
                (Some(i), Some(j)) => self.covariance(i, j),
                _ => 0.0,
            });
            covariance.extend(row);
        }
        covariance[place * (n + 1) + place] += floor.variance;
        self.estimate.mean.insert(place, floor.mean);
        self.estimate.covariance = covariance;
        self.floor = self.floor.map(|of| of + usize::from(of >= new));
        new
    }
}
