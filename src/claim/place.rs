//! Positions on the axis in words, and the ranges where a claim is shown.

use super::Axis;
use crate::format::minus;

impl Axis {
    /// `Δ/σ_ξ = 0.3`, `rule wilcoxon`.
    pub(super) fn at(&self, value: &str) -> String {
        match value.parse::<f64>() {
            Ok(number) => format!("{} = {}", self.symbol, minus(&number.to_string())),
            Err(_) => format!("{} {value}", self.symbol),
        }
    }

    /// `Δ/σ_ξ in [0.1, 0.6]`.
    pub(super) fn range(&self, first: &str, last: &str) -> String {
        format!("{} in [{}, {}]", self.symbol, minus(first), minus(last))
    }

    /// The ranges in which a claim is shown for a curve or pair of curves called `name`, given at which values it
    /// is shown: the name alone if everywhere, else the ranges of neighbouring numbers, if any.
    pub(super) fn shown(&self, name: &str, values: &[(&str, bool)]) -> Option<String> {
        let is_everywhere = values.iter().all(|(_, is_shown)| *is_shown);
        if is_everywhere && !name.is_empty() {
            return Some(name.to_owned());
        }
        if values
            .iter()
            .any(|(value, _)| value.parse::<f64>().is_err())
        {
            return None;
        }
        let ranges: Vec<String> = values
            .chunk_by(|a, b| a.1 == b.1)
            .filter(|run| run.len() > 1 && run[0].1)
            .map(|run| self.range(run[0].0, run[run.len() - 1].0))
            .collect();
        named_ranges(name, &ranges)
    }
}

/// `"a": Δ/σ_ξ in [0, 0.3], Δ/σ_ξ in [1, 2]`; `None` without ranges.
pub(super) fn named_ranges(name: &str, ranges: &[String]) -> Option<String> {
    let ranges = ranges.join(", ");
    match (ranges.is_empty(), name.is_empty()) {
        (true, _) => None,
        (_, true) => Some(ranges),
        _ => Some(format!("{name}: {ranges}")),
    }
}
