//! Does each curve grow along the axis?

use super::words::{at, compared, curve as named, interval, range};
use super::{ClaimError, Judgement, Verdict};
use crate::experiment::{Axis, Claim};
use crate::results::Comparison;

/// One curve's comparisons.
struct Climb<'a> {
    label: &'a str,
    /// Each value of the axis against the one before.
    steps: &'a [&'a Comparison],
    /// The last against the first.
    overall: &'a Comparison,
    margin: f64,
}

/// What is sure of a curve.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Grows,
    /// It falls somewhere, or is flat over all.
    Refuted,
    Open,
}

pub(super) fn judge(
    claim: &Claim,
    curves: &[String],
    comparisons: &[&Comparison],
    axis: Option<&Axis>,
) -> Result<Judgement, ClaimError> {
    let climbs = curves
        .iter()
        .map(|label| Climb::new(label, comparisons, claim.margin));
    let climbs: Vec<Climb> = climbs.collect::<Result<_, _>>()?;
    Ok(Judgement {
        verdict: verdict(&climbs, axis),
        evidence: evidence(&climbs, axis),
        how: how(claim, comparisons, axis),
    })
}

impl<'a> Climb<'a> {
    fn new(
        label: &'a str,
        comparisons: &'a [&'a Comparison],
        margin: f64,
    ) -> Result<Self, ClaimError> {
        // A claim's comparisons stand curve by curve.
        let mut of_curve = comparisons.chunk_by(|a, b| a.first_curve == b.first_curve);
        let of_curve = of_curve.find(|chunk| chunk[0].first_curve == label);
        let all = of_curve.ok_or_else(|| ClaimError::NotCompared(label.to_owned()))?;
        let steps = &all[..(all.len() - 1).max(1)];
        Ok(Self {
            label,
            steps,
            overall: all[all.len() - 1],
            margin,
        })
    }

    fn state(&self) -> State {
        let overall = self.overall;
        if self.steps.iter().any(|step| step.high < -self.margin) || overall.high <= self.margin {
            State::Refuted
        } else if self.steps.iter().all(|step| step.low >= -self.margin) && self.rises() {
            State::Grows
        } else {
            State::Open
        }
    }

    /// Whether the last lies above the first for sure.
    fn rises(&self) -> bool {
        self.overall.low > self.margin
    }

    /// Ranges of the axis without a fall in which the lower limits of the steps add up to growth.
    fn growing_ranges(&self, axis: Option<&Axis>) -> Vec<String> {
        let is_sound = |step: &Comparison| step.low >= -self.margin;
        let runs = self.steps.chunk_by(|a, b| is_sound(a) && is_sound(b));
        let grows = |run: &&[&Comparison]| {
            let total: f64 = run.iter().map(|step| step.low).sum();
            is_sound(run[0]) && total > self.margin
        };
        let ends = |run: &[&Comparison]| {
            let (first, last) = (&run[0].second_value, &run[run.len() - 1].first_value);
            range(axis, first, last)
        };
        runs.filter(grows).map(ends).collect()
    }
}

fn verdict(climbs: &[Climb], axis: Option<&Axis>) -> Verdict {
    let states: Vec<State> = climbs.iter().map(Climb::state).collect();
    let all = |state| states.iter().all(|other| *other == state);
    if all(State::Grows) {
        Verdict::Holds
    } else if all(State::Refuted) {
        Verdict::DoesNotHold
    } else if !states.contains(&State::Refuted) {
        Verdict::Undecided
    } else if !climbs.iter().any(Climb::rises) {
        Verdict::DoesNotHold
    } else {
        let places = places(climbs, axis);
        match places.is_empty() {
            true => Verdict::Undecided,
            false => Verdict::HoldsWhere(places.join("; ")),
        }
    }
}

/// Curves that grow, and ranges in those that do not.
fn places(climbs: &[Climb], axis: Option<&Axis>) -> Vec<String> {
    let place = |climb: &Climb| match climb.state() {
        State::Grows => Some(named(climb.label)),
        State::Refuted => {
            let ranges = climb.growing_ranges(axis);
            (!ranges.is_empty()).then(|| format!("{}: {}", named(climb.label), ranges.join(", ")))
        }
        State::Open => None,
    };
    climbs.iter().filter_map(place).collect()
}

fn evidence(climbs: &[Climb], axis: Option<&Axis>) -> String {
    let steps = climbs.iter().flat_map(|climb| climb.steps.iter().copied());
    let overall = climbs.iter().map(|climb| climb.overall);
    let (step, overall) = (lowest(steps), lowest(overall));
    let margin = climbs[0].margin;
    let kind = match step.high < -margin {
        true => "deepest fall",
        false => "lowest step",
    };
    format!(
        "{kind} {} from {} to {} on {}; lowest growth from first to last {} on {}",
        interval(step.difference, step.low, step.high),
        at(axis, &step.second_value),
        step.first_value,
        named(&step.first_curve),
        interval(overall.difference, overall.low, overall.high),
        named(&overall.first_curve),
    )
}

/// The one that decides: with the lowest limit, but of a sure fall before one that is only wide.
fn lowest<'a>(comparisons: impl Iterator<Item = &'a Comparison>) -> &'a Comparison {
    let depth = |c: &Comparison| (c.high.min(0.0), c.low);
    let order = |a: &&Comparison, b: &&Comparison| {
        let (a, b) = (depth(a), depth(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    };
    comparisons.min_by(order).expect("a climb has a step")
}

fn how(claim: &Claim, comparisons: &[&Comparison], axis: Option<&Axis>) -> String {
    let Claim { level, margin, .. } = claim;
    format!(
        "growth along {}: no step below −{margin} and every curve's last above its first by more than \
         {margin}; {}, family-wise level {level}",
        super::words::symbol(axis),
        compared(comparisons),
    )
}
