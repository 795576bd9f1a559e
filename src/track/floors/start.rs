//! How a map begins: with a sweep from one end of the shaft to the other, with given heights, or with a map known
//! from before.
//!
//! A sweep adds a floor at each stop: m_k = p − v. With the first stop's height for 0 this gives Cov(m_i, m_j) =
//! σ_s² + the sum of the variances of the trips to the lower of both + σ_s² where i = j. It ends with the first
//! trip the other way.

use super::hypothesis::{CAR, Hypothesis};
use super::scale::Scale;
use super::settings::Settings;
use super::stop::Height;
use super::{Floors, MOST_FLOORS};
use crate::rule::{OutOfRange, Rule};

/// More than a lift makes in its life.
const MOST_VISITS: u64 = 1_000_000_000;

/// Where the car is at the beginning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// At a floor, from 0 up.
    Floor(usize),
    /// At any floor.
    Unknown,
}

/// Why heights make no map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum MapError {
    #[error(
        "floors: must be at least 2 and at most {MOST_FLOORS}, got {0} (give every floor's height)"
    )]
    Number(usize),
    #[error("floors[{at}]: must be finite and within 10000 m of the first, got {got}")]
    Height { at: usize, got: f64 },
    #[error(
        "floors[{at}]: must lie more than σ_s = {level} m above the floor before it, {before} m, got {got} m \
         (list floors from the lowest up)"
    )]
    Order {
        at: usize,
        before: f64,
        got: f64,
        level: f64,
    },
    #[error("at: must be one of {floors} floors, from 0 up, got {got}")]
    Start { got: usize, floors: usize },
    #[error("covariance: must be symmetric and not negative, with a row for each floor")]
    Covariance,
    #[error("{0}: must have an entry for each of {1} floors, got {2}")]
    Entries(&'static str, usize, usize),
    #[error(transparent)]
    Value(#[from] OutOfRange),
}

impl Floors {
    /// A car at the lowest floor, or at the highest, of a building that it is about to sweep.
    ///
    /// # Errors
    /// If a setting breaks its rule.
    pub fn unknown(settings: Settings) -> Result<Self, OutOfRange> {
        settings.check()?;
        Ok(Self {
            settings,
            hypotheses: vec![Hypothesis::first(&settings)],
            visits: vec![1],
            scale: Scale::new(settings.window, []),
            nearest: None,
            is_swept: false,
            is_lost: false,
            was_lost: false,
            commissioned: None,
        })
    }

    /// Given heights, m from the lowest up, each but the first with this deviation. The map's heights are above
    /// the lowest.
    ///
    /// # Errors
    /// If these are no heights, or a setting breaks its rule.
    pub fn given(
        settings: Settings,
        heights: &[f64],
        deviation: f64,
        start: Start,
    ) -> Result<Self, MapError> {
        Rule::Within(0.0, 1.0, "m").check("deviation", &deviation)?;
        let floors = heights.len();
        let lowest = heights.first().copied().unwrap_or_default();
        let heights: Vec<f64> = heights.iter().map(|height| height - lowest).collect();
        let mut covariance = vec![0.0; floors * floors];
        let own = covariance.iter_mut().step_by(floors + 1).skip(1);
        own.for_each(|variance| *variance = deviation * deviation);
        let map = Map {
            visits: vec![0; floors],
            commissioned: None,
            recent: Vec::new(),
            heights,
            covariance,
        };
        Self::known(settings, &map, start)
    }

    /// A map known from before.
    ///
    /// # Errors
    /// If its numbers are those of no map, or a setting breaks its rule.
    pub fn known(settings: Settings, map: &Map, start: Start) -> Result<Self, MapError> {
        settings.check()?;
        map.check(settings.level)?;
        let best = Hypothesis::of(&map.heights, &map.covariance, &settings);
        let mut floors = Self {
            is_swept: true,
            is_lost: false,
            was_lost: false,
            settings,
            hypotheses: vec![best],
            visits: map.visits.clone(),
            scale: Scale::new(settings.window, map.recent.iter().copied()),
            nearest: None,
            commissioned: map.commissioned.clone(),
        };
        floors.begin(start)?;
        Ok(floors)
    }

    fn begin(&mut self, start: Start) -> Result<(), MapError> {
        let (floors, settings) = (self.visits.len(), &self.settings);
        match start {
            Start::Floor(floor) if floor < floors => {
                self.hypotheses = vec![self.best().anchored(floor, 0.0, settings)];
            }
            Start::Floor(got) => return Err(MapError::Start { got, floors }),
            Start::Unknown => self.lose(),
        }
        Ok(())
    }

    /// What is to be known when the map is used again.
    pub fn map(&self) -> Map {
        let best = self.best();
        let heights = (0..best.floors()).map(|floor| best.height(floor).mean);
        Map {
            heights: heights.collect(),
            covariance: best.floor_covariance(),
            visits: self.visits.clone(),
            commissioned: self.commissioned.clone(),
            recent: self.scale.recent().collect(),
        }
    }

    /// Adds a floor where the trip that the car has just made is one of the first sweep, and says which.
    pub(super) fn sweep(&mut self, distance: f64) -> Option<usize> {
        if self.is_swept {
            return None;
        }
        let (best, floors) = (self.best(), self.visits.len());
        // Heights are from the first stop on: a sweep downwards has given negative ones.
        let so_far = best.height(floors - 1).mean + best.height(0).mean;
        if distance.abs() < self.settings.least_storey {
            return None;
        }
        if so_far * distance < 0.0 || floors == MOST_FLOORS {
            self.is_swept = true;
            return None;
        }
        self.hypotheses.truncate(1);
        let best = &mut self.hypotheses[0];
        let found = Height {
            mean: best.car().mean,
            variance: self.settings.level * self.settings.level,
        };
        let floor = best.insert(found, Some(CAR));
        best.floor = Some(floor);
        self.visits.insert(floor, 1);
        Some(floor)
    }
}

/// A map without the car: what is known of floors.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// m above the floor of the first stop, from the lowest up.
    pub heights: Vec<f64>,
    /// Of the heights, m², row by row.
    pub covariance: Vec<f64>,
    /// Stops at each floor.
    pub visits: Vec<u64>,
    /// Each floor as commissioned; none before.
    pub commissioned: Option<Vec<Height>>,
    /// The latest ξ, the oldest first.
    pub recent: Vec<f64>,
}

impl Map {
    fn check(&self, level: f64) -> Result<(), MapError> {
        let floors = self.heights.len();
        if !(2..=MOST_FLOORS).contains(&floors) {
            return Err(MapError::Number(floors));
        }
        for (at, &got) in self.heights.iter().enumerate() {
            if !(0.0..=1e4).contains(&got.abs()) {
                return Err(MapError::Height { at, got });
            }
        }
        for (at, pair) in self.heights.windows(2).enumerate() {
            let (before, got) = (pair[0], pair[1]);
            if got - before <= level {
                let at = at + 1;
                return Err(MapError::Order {
                    at,
                    before,
                    got,
                    level,
                });
            }
        }
        let entries = |name, got| match got {
            got if got == floors => Ok(()),
            got => Err(MapError::Entries(name, floors, got)),
        };
        entries("visits", self.visits.len())?;
        for &visits in &self.visits {
            if visits > MOST_VISITS {
                return Err(
                    OutOfRange::new("visits", format!("be at most {MOST_VISITS}"), visits).into(),
                );
            }
        }
        for &xi in &self.recent {
            Rule::Within(0.0, 1e12, "").check("recent", &xi)?;
        }
        for first in self.commissioned.iter().flatten() {
            Rule::Within(-2e4, 2e4, "m").check("commissioned", &first.mean)?;
            Rule::Within(0.0, 1e8, "m²").check("commissioned", &first.variance)?;
        }
        entries(
            "commissioned",
            self.commissioned.as_ref().map_or(floors, Vec::len),
        )?;
        if is_covariance(&self.covariance, floors) {
            Ok(())
        } else {
            Err(MapError::Covariance)
        }
    }
}

/// Whether a matrix is symmetric and has no negative eigenvalue, up to rounding: by Cholesky's factor, which has a
/// column of zeros for each direction that is known exactly.
fn is_covariance(matrix: &[f64], n: usize) -> bool {
    let is_bounded = matrix.iter().all(|value| value.abs() <= 1e8);
    let is_symmetric = || (0..n).all(|i| (0..i).all(|j| matrix[i * n + j] == matrix[j * n + i]));
    if matrix.len() != n * n || !is_bounded || !is_symmetric() {
        return false;
    }
    let largest = matrix.iter().step_by(n + 1).copied().fold(0.0, f64::max);
    let rounding = 1e-9 * largest;
    let mut rest = matrix.to_vec();
    for k in 0..n {
        let pivot = rest[k * n + k];
        if pivot < -rounding {
            return false;
        }
        if pivot <= rounding {
            // Where the variance is 0, so is every covariance: |P_ik|² ≤ P_ii P_kk.
            let bound = (rounding * largest).sqrt() + rounding;
            if (k..n).any(|i| rest[i * n + k].abs() > bound) {
                return false;
            }
            continue;
        }
        for i in k + 1..n {
            let factor = rest[i * n + k] / pivot;
            for j in k + 1..n {
                rest[i * n + j] -= factor * rest[k * n + j];
            }
        }
    }
    true
}
