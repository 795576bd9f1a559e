//! Whether W and T are independent under H₀, eqs (13)–(14) of [^1], by enumeration.
//!
//! (13): every assignment of the pooled ranks to X, Y₁ and Y₂ is equally likely. This study makes each
//! of the n assignments, computes W and T by their definitions (12), and counts n(w, t), n(w) and n(t).
//! (14) holds if n(w, t)·n = n(w)·n(t) for every w and t. These are whole numbers without rounding, and
//! they do not use the laws that the detector relies on.
//!
//! [^1]: see [`crate::signal`].

pub(super) mod picture;
mod row;

pub use row::{Finding, Row, findings};

use crate::config::Conflict;
use crate::counts::Counts;
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::results::Quantity;
use crate::rule::OutOfRange;
use crate::run::{Identity, StudyError, Table};
use crate::study::kind::{Context, Study};
use crate::study::rules::distinct;
use rayon::prelude::*;
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// Whether W and T are independent at rest, by enumeration.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Independence {
    /// N, M₁ and M₂ of each enumeration.
    sizes: Vec<[usize; 3]>,
}

/// The most assignments of ranks in one enumeration. The square of their number is exact in an f64.
const MOST_ASSIGNMENTS: u128 = 50_000_000;
/// The most sets of sizes. All enumerations of a config are held in memory.
const MOST_SIZES: usize = 100;

impl Independence {
    fn check(&self) -> Result<(), Conflict> {
        const PATH: &str = "independence.sizes";
        for (i, sizes) in self.sizes.iter().enumerate() {
            let unfit = |rule: String| {
                Err(OutOfRange::new(format!("{PATH}[{i}]"), rule, format!("{sizes:?}")).into())
            };
            if sizes.contains(&0) {
                return unfit("be at least 1 each".to_owned());
            }
            if assignments(*sizes).is_none() {
                return unfit(format!(
                    "have at most {MOST_ASSIGNMENTS} assignments of ranks"
                ));
            }
        }
        let words = ["[N, M1, M2]", "[N, M1, M2]"];
        distinct(PATH, words, MOST_SIZES, &self.sizes, |sizes| {
            format!("{sizes:?}")
        })
    }
}

/// (N + M₁ + M₂)!/(N! M₁! M₂!). `None` if it is very large.
fn assignments([n, m1, m2]: [usize; 3]) -> Option<u128> {
    let mut number = 1u128;
    for (before, more) in [(n, m1), (n.checked_add(m1)?, m2)] {
        for i in 1..=more {
            number = number.checked_mul(before.checked_add(i)? as u128)? / i as u128;
            if number > MOST_ASSIGNMENTS {
                return None;
            }
        }
    }
    Some(number)
}

impl Study for Independence {
    const NAME: &'static str = "independence";
    const USES: &'static [&'static str] = &[];
    const COUNTS_TRIALS: bool = false;
    type Row = Row;

    fn read(experiment: &Experiment, _context: Context) -> Result<Self, StudyError> {
        let study: Self = experiment.read()?;
        (study.check()).map_err(|conflict| experiment.conflict(conflict))?;
        Ok(study)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Self::json_schema(generator).to_value()
    }

    fn identities(&self) -> Vec<Identity> {
        let identity = |sizes: &[usize; 3]| Identity::new([("sizes", format!("{sizes:?}"))]);
        self.sizes.iter().map(identity).collect()
    }

    fn rows(&self, _counts: &Counts) -> Vec<Row> {
        rows(&self.sizes)
    }

    /// The largest difference overall, and the number of assignments.
    fn quantities(&self, rows: &[Row]) -> Result<Vec<Quantity>, StudyError> {
        let findings = findings(rows);
        let largest = findings.iter().map(|finding| finding.largest_difference);
        let assignments: u64 = findings.iter().map(|finding| finding.assignments).sum();
        Ok(vec![
            Quantity::exact("largest_difference", largest.max().unwrap_or(0) as f64),
            Quantity::exact("assignments", assignments as f64),
        ])
    }

    fn plot(&self, rows: &[Row], _seed: u64) -> Result<Plot, FigureError> {
        Ok(picture::plot(rows))
    }

    fn findings(&self, rows: &[Row]) -> Option<Table> {
        let line = |finding: &Finding| {
            vec![
                finding.sizes.map(|size| size.to_string()).join("/"),
                finding.assignments.to_string(),
                finding.cells.to_string(),
                finding.largest_difference.to_string(),
            ]
        };
        let lines = findings(rows).iter().map(line).collect();
        Some((HEADER, lines))
    }
}

const HEADER: &[&str] = &[
    "N/M1/M2",
    "assignments",
    "cells",
    "largest |n(w,t) n - n(w) n(t)|",
];

/// The rows of all sets of sizes.
pub(super) fn rows(sizes: &[[usize; 3]]) -> Vec<Row> {
    let each = sizes.par_iter();
    each.flat_map_iter(|&sizes| cells(sizes, &enumerate(sizes)))
        .collect()
}

/// The sample that a rank is assigned to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Sample {
    Reference,
    Shift,
    Scale,
}

/// Counts n(w, t) over all assignments.
fn enumerate([n, m1, m2]: [usize; 3]) -> BTreeMap<(u64, usize), u64> {
    let mut owners = [
        vec![Sample::Reference; n],
        vec![Sample::Shift; m1],
        vec![Sample::Scale; m2],
    ]
    .concat();
    let mut counts = BTreeMap::new();
    loop {
        *counts.entry(statistics(&owners)).or_insert(0) += 1;
        if !next_arrangement(&mut owners) {
            return counts;
        }
    }
}

/// W and T by (12), for the ranks 1, 2, … assigned to `owners`.
fn statistics(owners: &[Sample]) -> (u64, usize) {
    let (mut rank_sum, mut lowest, mut highest) = (0, usize::MAX, 0);
    for (rank, owner) in (1..).zip(owners) {
        match owner {
            Sample::Shift => rank_sum += rank as u64,
            Sample::Reference => (lowest, highest) = (lowest.min(rank), highest.max(rank)),
            Sample::Scale => {}
        }
    }
    let is_outside = |(rank, owner): &(usize, &Sample)| {
        **owner == Sample::Scale && (*rank < lowest || *rank > highest)
    };
    let exceedances = (1..).zip(owners).filter(is_outside).count();
    (rank_sum, exceedances)
}

/// Makes the next arrangement in lexicographic order. Returns false after the last.
fn next_arrangement(owners: &mut [Sample]) -> bool {
    let Some(pivot) = owners.windows(2).rposition(|pair| pair[0] < pair[1]) else {
        return false;
    };
    let successor = owners.iter().rposition(|owner| *owner > owners[pivot]);
    owners.swap(pivot, successor.expect("the next one is larger"));
    owners[pivot + 1..].reverse();
    true
}

/// The rows of one set of sizes: every w that occurs with every t that occurs, even if they never occur
/// together.
fn cells(sizes: [usize; 3], counts: &BTreeMap<(u64, usize), u64>) -> Vec<Row> {
    let (mut of_w, mut of_t) = (BTreeMap::new(), BTreeMap::new());
    for (&(w, t), count) in counts {
        *of_w.entry(w).or_insert(0u64) += count;
        *of_t.entry(t).or_insert(0u64) += count;
    }
    let all: u64 = of_w.values().sum();
    let [reference, shift, scale] = sizes;
    let mut rows = Vec::new();
    for (&rank_sum, &with_w) in &of_w {
        for (&exceedances, &with_t) in &of_t {
            let count = counts.get(&(rank_sum, exceedances)).copied().unwrap_or(0);
            rows.push(Row {
                reference,
                shift,
                scale,
                rank_sum,
                exceedances,
                count,
                // Both products are below 2^53, so each quotient is rounded once.
                product: (with_w * with_t) as f64 / (all * all) as f64,
                joint: count as f64 / all as f64,
            });
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks 1/1/1 by hand. X, Y₁ and Y₂ hold the ranks 1, 2, 3 in some order, W is the rank of Y₁, and
    /// Y₂ always lies outside the single X.
    #[test]
    fn one_each_by_hand() {
        let counts = enumerate([1, 1, 1]);
        let expected = [((1, 1), 2), ((2, 1), 2), ((3, 1), 2)];
        assert_eq!(counts, BTreeMap::from(expected));
    }

    /// Each arrangement occurs once: their number is the multinomial coefficient, eq. (13).
    #[test]
    fn every_assignment_once() {
        for (sizes, number) in [
            ([2, 2, 2], 90),
            ([3, 2, 2], 210),
            ([2, 3, 4], 1260),
            ([1, 4, 2], 105),
            ([4, 4, 4], 34_650),
        ] {
            assert_eq!(enumerate(sizes).values().sum::<u64>(), number);
        }
        let mut owners = vec![Sample::Reference, Sample::Shift, Sample::Scale];
        let mut seen = vec![owners.clone()];
        while next_arrangement(&mut owners) {
            seen.push(owners.clone());
        }
        seen.dedup();
        assert_eq!(seen.len(), 6);
    }

    /// Checks (14) and the laws of the detector, which share no code with this enumeration.
    #[test]
    fn independent_and_of_the_known_laws() {
        use crate::detect::{Exceedances, NullLaw, Samples};
        for sizes in [[2, 2, 2], [3, 2, 4], [1, 3, 2], [5, 3, 2]] {
            let rows = rows(&[sizes]);
            let finding = findings(&rows)[0];
            assert_eq!(finding.largest_difference, 0, "{sizes:?}");
            assert_eq!(finding.sizes, sizes);
            let samples = Samples::contiguous(sizes[0], sizes[1], sizes[2]).unwrap();
            let (w, t) = (
                NullLaw::rank_sum(&samples).unwrap(),
                NullLaw::exceedances(Exceedances::Scale, &samples).unwrap(),
            );
            for row in rows {
                let known = w.mass(row.rank_sum) * t.mass(row.exceedances as u64);
                assert!((row.joint - known).abs() < 1e-15, "{row:?}");
                assert_eq!(row.joint, row.product);
            }
        }
    }

    /// The study detects rows that are not independent, such as 3 · 4 against 1 · 3.
    #[test]
    fn dependence_shows() {
        let mut rows = rows(&[[2, 1, 1]]);
        rows[0].count += 1;
        assert!(findings(&rows)[0].largest_difference > 0);
    }
}
