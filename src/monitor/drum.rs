//! The drum beside the cage: rope that is paid out to a cage that may stand.

use serde::{Deserialize, Serialize};

/// By how much a slack alarm may go back before the doubt, s.
const LOOKS_BACK: f64 = 1.5;

/// What is known of the drum.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Drum {
    /// Since when it turns, s, and since when it does so beside a cage that may stand.
    turns: Option<f64>,
    slack: Option<f64>,
    is_told: bool,
}

impl Drum {
    /// Takes whether it turns now, whether the cage is known to move, and since when it rests if it does. Returns since
    /// when rope is slack where that has just lasted for `longest`, s.
    pub fn step(
        &mut self,
        now: f64,
        turns: bool,
        moves: bool,
        rest: Option<f64>,
        longest: f64,
    ) -> Option<f64> {
        if !turns {
            *self = Self::default();
            return None;
        }
        let turns = *self.turns.get_or_insert(now);
        if moves {
            (self.slack, self.is_told) = (None, false);
            return None;
        }
        // Where the motion has become doubtful, the cage may have stood since before.
        let stands = rest.unwrap_or(now).clamp(now - LOOKS_BACK, now);
        let since = *self.slack.get_or_insert(stands.max(turns));
        let is_late = now - since >= longest - 1e-9 && !self.is_told;
        self.is_told |= is_late;
        is_late.then_some(since)
    }
}
