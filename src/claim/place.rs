//! Positions on the axis in words, and the range where a claim is shown.

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

    /// Where a claim is shown for a curve or pair of curves called `name`, given at which values it is shown: the name
    /// alone if everywhere, else the range that these values make, if they are connected.
    pub(super) fn shown(&self, name: &str, values: &[(&str, bool)]) -> Option<String> {
        let is_everywhere = values.iter().all(|(_, is_shown)| *is_shown);
        if is_everywhere && !name.is_empty() {
            return Some(name.to_owned());
        }
        let [first, last] = connected(values)?;
        Some(named_range(name, &self.range(first, last)))
    }
}

/// `"a": Δ/σ_ξ in [0, 0.3]`.
pub(super) fn named_range(name: &str, range: &str) -> String {
    match name {
        "" => range.to_owned(),
        _ => format!("{name}: {range}"),
    }
}

/// The ends of the values marked here, if all values are numbers and those that are marked are at least two, with none
/// between them that is not.
fn connected<'a>(values: &[(&'a str, bool)]) -> Option<[&'a str; 2]> {
    let numbers = values.iter().map(|&(value, is_marked)| {
        let number: f64 = value.parse().ok()?;
        Some((number, value, is_marked))
    });
    let mut numbers = numbers.collect::<Option<Vec<_>>>()?;
    numbers.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut runs = (numbers.chunk_by(|a, b| a.2 == b.2)).filter(|run| run[0].2);
    match (runs.next(), runs.next()) {
        (Some([(_, first, _), .., (_, last, _)]), None) => Some([first, last]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// As the words say it: two marked values at least, and whatever lies between two of them is marked.
    fn naive(values: &[(i32, bool)]) -> Option<[i32; 2]> {
        let marked = || values.iter().filter(|it| it.1).map(|it| it.0);
        let (first, last) = (marked().min()?, marked().max()?);
        let is_inside = |it: &&(i32, bool)| first < it.0 && it.0 < last;
        let is_connected = values.iter().filter(is_inside).all(|it| it.1);
        (first < last && is_connected).then_some([first, last])
    }

    proptest! {
        /// In whatever order the values are written. Up to eight of them, so that every pattern is likely to come.
        #[test]
        fn ranges_are_connected(
            marks in prop::collection::vec(any::<bool>(), 0..8)
                .prop_map(|marks| (-9..).step_by(3).zip(marks).collect::<Vec<(i32, bool)>>())
                .prop_shuffle()
        ) {
            let texts: Vec<String> = marks.iter().map(|it| it.0.to_string()).collect();
            let values: Vec<(&str, bool)> =
                texts.iter().zip(&marks).map(|(text, it)| (text.as_str(), it.1)).collect();
            let ends = connected(&values).map(|ends| ends.map(|end| end.parse().unwrap()));
            prop_assert_eq!(ends, naive(&marks));
        }
    }

    #[test]
    fn names_make_no_range() {
        assert_eq!(connected(&[("1", true), ("2", true)]), Some(["1", "2"]));
        assert_eq!(connected(&[("1", true), ("2", true), ("two", false)]), None);
    }
}
