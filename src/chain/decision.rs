//! The decision on a trial.

use super::observation::Observation;
use super::score::Score;
use crate::counts::DecisionSummary;
use crate::detect::{Region, Ties};
use crate::format::eight_digits;
use std::sync::Arc;

/// The decision rule of a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// Whether (W, T) lies in ϑ.
    Region {
        /// ϑ.
        region: Arc<Region>,
        /// The treatment of equal values.
        ties: Ties,
    },
    /// Whether a score lies above a threshold.
    Threshold {
        /// The score.
        score: Arc<Score>,
        /// The value that the score must exceed for H₁.
        threshold: f64,
    },
}

impl Decision {
    /// Whether it decides H₁.
    #[inline(always)]
    pub fn is_h1(&self, observation: &mut Observation) -> bool {
        match self {
            Self::Region { region, ties } => region.contains(observation.statistics(*ties)),
            Self::Threshold { score, threshold } => score.of(observation) > *threshold,
        }
    }

    /// Whether both decide in the same way.
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Region { region, ties }, Self::Region { region: r, ties: t }) => {
                Arc::ptr_eq(region, r) && ties == t
            }
            (
                Self::Threshold { score, threshold },
                Self::Threshold {
                    score: s,
                    threshold: t,
                },
            ) => Arc::ptr_eq(score, s) && threshold == t,
            _ => false,
        }
    }

    /// What `points.csv` says of it.
    pub fn summary(&self) -> DecisionSummary {
        let (size, reachable) = match self {
            Self::Region { region, .. } => (Some(region.size()), region.reachable()),
            Self::Threshold { .. } => (None, None),
        };
        DecisionSummary {
            size,
            threshold: self.threshold().map(eight_digits),
            reachable: reachable.map(eight_digits),
        }
    }

    /// The threshold of a score.
    pub fn threshold(&self) -> Option<f64> {
        match self {
            Self::Region { .. } => None,
            Self::Threshold { threshold, .. } => Some(*threshold),
        }
    }
}
