//! The test `grows`: whether each curve grows along the axis.

use super::place::named_range;
use super::words::{compared, counter_examples, curve as named, interval};
use super::{Axis, Claim, ClaimError, Comparison, Evidence, Judgement, Verdict};

/// One curve's comparisons.
struct Climb<'a> {
    label: &'a str,
    /// Each value of the axis against the one before.
    steps: &'a [Comparison],
    /// The last value against the first.
    overall: &'a Comparison,
    margin: f64,
}

/// What the intervals show about a curve.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Grows,
    /// It falls somewhere, or is flat from first to last.
    Refuted,
    Open,
}

pub(super) fn judge(
    claim: &Claim,
    number: usize,
    curves: Option<&[String]>,
    evidence: &Evidence,
) -> Result<Judgement, ClaimError> {
    let (scope, comparisons) = (&evidence.scope, evidence.compared(number));
    let climbs: Vec<Climb> = (scope.named(curves).into_iter())
        .map(|curve| Climb::new(&scope.curves[curve].label, comparisons, claim.margin.get()))
        .collect::<Result<_, _>>()?;
    let count = |state| climbs.iter().filter(|climb| climb.state() == state).count();
    let refuted = count(State::Refuted);
    let verdict = if refuted == climbs.len() {
        Verdict::DoesNotHold
    } else if refuted > 0 {
        Verdict::where_shown(climbs.iter().map(|climb| climb.place(&scope.axis)))
    } else if count(State::Open) > 0 {
        Verdict::Undecided
    } else {
        Verdict::Holds
    };
    let (margin, level) = (claim.margin.get(), claim.level.get());
    Ok(Judgement {
        verdict,
        evidence: lowest_of(&climbs, &scope.axis)
            + &counter_examples(refuted, climbs.len(), "curve", None),
        how: format!(
            "growth along {}: no step below −{margin} and every curve's last above its first by more than \
             {margin}; {}, family-wise level {level}",
            scope.axis.symbol,
            compared(comparisons),
        ),
    })
}

impl<'a> Climb<'a> {
    fn new(label: &'a str, comparisons: &'a [Comparison], margin: f64) -> Result<Self, ClaimError> {
        // The comparisons of a claim are sorted by curve.
        let mut of_curve = comparisons.chunk_by(|a, b| a.first_curve == b.first_curve);
        let all = of_curve
            .find(|chunk| chunk[0].first_curve == label)
            .ok_or_else(|| ClaimError::NotCompared(label.to_owned()))?;
        Ok(Self {
            label,
            // With two values the single step is also the overall comparison.
            steps: &all[..(all.len() - 1).max(1)],
            overall: &all[all.len() - 1],
            margin,
        })
    }

    fn state(&self) -> State {
        let falls = self.steps.iter().any(|step| step.high < -self.margin);
        if falls || self.overall.high <= self.margin {
            State::Refuted
        } else if self.steps.iter().all(|s| self.is_sound(s)) && self.overall.low > self.margin {
            State::Grows
        } else {
            State::Open
        }
    }

    /// Whether a step is shown not to fall.
    fn is_sound(&self, step: &Comparison) -> bool {
        step.low >= -self.margin
    }

    /// The range in which growth is shown, in words: the whole curve, or the one stretch without a fall in which the
    /// lower limits of the steps add up to growth.
    fn place(&self, axis: &Axis) -> Option<String> {
        if self.state() == State::Grows {
            return Some(named(self.label));
        }
        let mut ranges = self
            .steps
            .chunk_by(|a, b| self.is_sound(a) && self.is_sound(b))
            .filter(|run| self.is_sound(&run[0]))
            .filter(|run| run.iter().map(|step| step.low).sum::<f64>() > self.margin)
            .map(|run| axis.range(&run[0].second_value, &run[run.len() - 1].first_value));
        match (ranges.next(), ranges.next()) {
            (Some(range), None) => Some(named_range(&named(self.label), &range)),
            _ => None,
        }
    }
}

fn lowest_of(climbs: &[Climb], axis: &Axis) -> String {
    let step = lowest(climbs.iter().flat_map(|climb| climb.steps));
    let overall = lowest(climbs.iter().map(|climb| climb.overall));
    let falls = step.high < -climbs[0].margin;
    format!(
        "{} {} from {} to {} on {}; lowest growth from first to last {} on {}",
        if falls { "deepest fall" } else { "lowest step" },
        interval(step.difference, step.low, step.high),
        axis.at(&step.second_value),
        step.first_value,
        named(&step.first_curve),
        interval(overall.difference, overall.low, overall.high),
        named(&overall.first_curve),
    )
}

/// The deciding comparison: the one with the lowest limit, but certain falls come before wide intervals.
fn lowest<'a>(comparisons: impl Iterator<Item = &'a Comparison>) -> &'a Comparison {
    comparisons
        .min_by(|a, b| {
            let fall = a.high.min(0.0).total_cmp(&b.high.min(0.0));
            fall.then(a.low.total_cmp(&b.low))
        })
        .expect("a claim names a curve")
}
