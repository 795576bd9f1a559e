//! The keys of `[ride]`. Those of the ride and its sensor are the fields of [`RideKeys`]; those of the monitor are all
//! of [`Settings`], by the last word of their path.

use super::{Measure, RideProblem};
use crate::config::Refusal;
use crate::config::tree::Node;
use crate::fields::names;
use crate::monitor::Settings;
use crate::suggest::among;
use serde::Deserialize;
use std::ops::Range;

/// The keys of the ride and its sensor, with their defaults.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RideKeys {
    pub distance: f64,
    pub speed: f64,
    pub acceleration: f64,
    pub jerk: f64,
    pub trips: usize,
    pub rest: [f64; 2],
    pub length: f64,
    pub jam_within: f64,
    pub tolerance: f64,
    pub rate: f64,
    pub sigma: Option<f64>,
    pub density: Option<f64>,
    pub delta_over_sigma: Option<f64>,
    pub ar: Vec<f64>,
    pub vibration: f64,
    pub nu: f64,
    pub theta: f64,
    pub quantum: Option<f64>,
    pub footfalls: f64,
    pub jolt: f64,
    pub learnt: bool,
    pub begins_at_rest: Option<bool>,
    pub motion_shows: bool,
}

impl Default for RideKeys {
    fn default() -> Self {
        Self {
            distance: 12.0,
            speed: 1.0,
            acceleration: 0.6,
            jerk: 0.8,
            trips: 2,
            rest: [10.0, 20.0],
            length: 600.0,
            jam_within: 0.1,
            tolerance: 0.5,
            rate: 100.0,
            sigma: None,
            density: None,
            delta_over_sigma: None,
            ar: Vec::new(),
            vibration: 0.0,
            nu: 0.0,
            theta: 2.0,
            quantum: None,
            footfalls: 0.0,
            jolt: 10.0,
            learnt: false,
            begins_at_rest: None,
            motion_shows: false,
        }
    }
}

/// Three ways to say one thing: how strong the noise is.
pub(super) const STRENGTH: [&str; 3] = ["sigma", "density", "delta_over_sigma"];

/// All keys that a curve may change and an axis may sweep.
pub(super) fn all() -> impl Iterator<Item = &'static str> + Clone {
    let own = names::<RideKeys>().iter().copied();
    own.chain(Settings::names())
}

/// The values of a `[ride]` or `[[ride.curve]]` table; beside them it may have the keys of `more`.
pub(super) fn values(table: &Node, more: &[&'static str]) -> Result<Node, Refused> {
    let known = more.iter().copied().chain(all());
    let mut entries = table.table().into_iter().flatten();
    if let Some((key, (span, _))) = entries.find(|(key, _)| !known.clone().any(|name| name == *key))
    {
        let problem = RideProblem::UnknownKey(among(key, known));
        return Err((Some(span.clone()), problem));
    }
    Ok(table.only(|key| !more.contains(&key)))
}

/// A problem and where it stands, if anywhere but the whole table.
pub(super) type Refused = (Option<Range<usize>>, RideProblem);

/// The keys with their values, of the ride and of the monitor.
pub(super) fn read(values: &Node) -> Result<(RideKeys, Settings), Refused> {
    let mut settings = Node::empty(values.span.clone());
    for (key, (_, node)) in values.table().into_iter().flatten() {
        if let Some(path) = Settings::path(key) {
            settings.set(path, node.clone());
        }
    }
    let own = values.only(|key| Settings::path(key).is_none());
    Ok((
        RideKeys::deserialize(&own).map_err(refused)?,
        Settings::deserialize(&settings).map_err(refused)?,
    ))
}

fn refused(mut refusal: Refusal) -> Refused {
    // The monitor's keys stand here without their tables.
    let (_, key) = refusal.path.rsplit_once('.').unwrap_or(("", &refusal.path));
    refusal.path = key.to_owned();
    (refusal.span.clone(), refusal.within("ride").into())
}

/// The first key that means nothing to what is measured.
pub(super) fn check_used(measure: Measure, values: &Node) -> Result<(), Refused> {
    let mut entries = values.table().into_iter().flatten();
    match entries.find(|(key, _)| measure.unused().contains(&&key[..])) {
        Some((key, (_, node))) => {
            let problem = RideProblem::Unused {
                key: key.clone(),
                measure,
            };
            Err((Some(node.span.clone()), problem))
        }
        None => Ok(()),
    }
}
