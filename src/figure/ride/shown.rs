//! What the picture of each measurement shows.

use crate::config::Measure;
use crate::figure::panel::Bound;

/// What a panel shows.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    pub outcome: &'static str,
    /// At its axis.
    pub label: &'static str,
    pub kind: Kind,
    pub height: f64,
}

/// How it is drawn.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    /// A probability with its interval.
    Share,
    /// The median of a delay, from its 5 % to its 95 % quantile.
    Delay,
    /// A positive number on a logarithmic scale, with the limit that stands for it where nothing was
    /// counted.
    Positive(Bound),
}

const fn share(outcome: &'static str, label: &'static str, height: f64) -> Shown {
    Shown {
        outcome,
        label,
        kind: Kind::Share,
        height,
    }
}

const fn delay(outcome: &'static str, label: &'static str) -> Shown {
    Shown {
        outcome,
        label,
        kind: Kind::Delay,
        height: 105.0,
    }
}

const fn positive(outcome: &'static str, label: &'static str, bound: Bound) -> Shown {
    Shown {
        outcome,
        label,
        kind: Kind::Positive(bound),
        height: 210.0,
    }
}

/// Its panels, from the top.
pub(super) fn shown(measure: Measure) -> &'static [Shown] {
    const RIDES: &[Shown] = &[
        share("found", "P(every trip is found)", 130.0),
        delay("start_delay", "start to H_1*, s"),
    ];
    const REST: &[Shown] = &[positive(
        "false_motions",
        "false motions per hour of rest",
        Bound::Upper,
    )];
    const TRADEOFF: &[Shown] = &[positive(
        "hours_between",
        "hours of rest between false motions",
        Bound::Lower,
    )];
    const JAM: &[Shown] = &[
        share("alarmed", "P(a jam alarms)", 130.0),
        delay("alarm_delay", "jam to alarm, s"),
    ];
    const SWITCHED_ON: &[Shown] = &[
        share("misled", "P(says rest in motion)", 115.0),
        share("knew", "P(knows it stands at last)", 115.0),
    ];
    match measure {
        Measure::Rides => RIDES,
        Measure::Rest => REST,
        Measure::Tradeoff => TRADEOFF,
        Measure::Jam => JAM,
        Measure::SwitchedOn => SWITCHED_ON,
    }
}
