//! Regions against their definitions, cell by cell.

use super::*;
use crate::detect::Statistics;

fn try_region(
    rule: &Rule,
    alternative: Alternative,
    alpha: f64,
    samples: &Samples,
) -> Result<Region, RegionError> {
    NullLaws::new(alternative, samples)?.region(rule, alpha)
}

fn sizes(n: usize, m1: usize, m2: usize) -> Samples {
    Samples::contiguous(n, m1, m2).unwrap()
}

fn region(rule: Rule, alternative: Alternative, alpha: f64, samples: &Samples) -> Region {
    try_region(&rule, alternative, alpha, samples).unwrap()
}

/// Every cell of the (W, T) plane with its probability.
fn cells(samples: &Samples) -> Vec<(Statistics, f64)> {
    let w = NullLaw::rank_sum(samples).unwrap();
    let t = NullLaw::exceedances(samples).unwrap();
    let cell = |rank_sum, exceedances: u64| {
        let probability = w.mass(rank_sum) * t.mass(exceedances);
        let exceedances = exceedances as usize;
        (
            Statistics {
                rank_sum,
                exceedances,
                shift_exceedances: 0,
            },
            probability,
        )
    };
    (w.first()..=w.last())
        .flat_map(|rank_sum| (0..=t.last()).map(move |e| (rank_sum, e)))
        .map(|(rank_sum, e)| cell(rank_sum, e))
        .collect()
}

const RULES: [Rule; 4] = [
    Rule::Wilcoxon,
    Rule::Product,
    Rule::Disjunction,
    Rule::Conjunction,
];
const ALTERNATIVES: [Alternative; 3] = [
    Alternative::Greater,
    Alternative::Less,
    Alternative::TwoSided,
];

/// The size is the sum over the cells that `contains` accepts, and is at most α.
#[test]
fn size_is_the_sum_of_the_cells() {
    for samples in [sizes(12, 12, 12), sizes(9, 5, 7), sizes(8, 4, 1)] {
        for rule in &RULES {
            for alternative in ALTERNATIVES {
                let Ok(region) = try_region(rule, alternative, 0.01, &samples) else {
                    assert_eq!((rule, samples.scale()), (&Rule::Conjunction, 1));
                    continue;
                };
                let inside = cells(&samples)
                    .into_iter()
                    .filter(|(s, _)| region.contains(*s));
                let sum: f64 = inside.map(|(_, p)| p).sum();
                assert!((sum - region.size()).abs() < 1e-14, "{rule} {alternative}");
                assert!(region.size() <= 0.01 && region.size() > 0.0);
            }
        }
    }
}

/// The product rule against its definition: order all cells by the exact product of their tail counts, add
/// groups of equal products together, stop before α is exceeded.
#[test]
fn product_enters_cells_in_exact_order() {
    for (samples, alpha) in [
        (sizes(12, 12, 12), 0.01),
        (sizes(12, 12, 12), 0.001),
        (sizes(6, 4, 5), 0.05),
        (sizes(2, 3, 9), 0.2),
        (sizes(20, 8, 3), 1e-5),
    ] {
        let w = NullLaw::rank_sum(&samples).unwrap();
        let t = NullLaw::exceedances(&samples).unwrap();
        let mut ordered: Vec<(BigUint, u64, u64)> = (w.first()..=w.last())
            .flat_map(|rank| (0..=t.last()).map(move |e| (rank, e)))
            .map(|(rank, e)| (w.tail_count(rank) * t.tail_count(e), rank, e))
            .collect();
        ordered.sort();
        let all = w.total() * t.total();
        let mut inside = Vec::new();
        let mut cases = BigUint::ZERO;
        for group in ordered.chunk_by(|a, b| a.0 == b.0) {
            let more: BigUint = group
                .iter()
                .map(|(_, r, e)| w.count(*r) * t.count(*e))
                .sum();
            if ratio(&(&cases + &more), &all) > alpha {
                break;
            }
            cases += more;
            inside.extend(group.iter().map(|&(_, r, e)| (r, e)));
        }
        let region = region(Rule::Product, Alternative::Greater, alpha, &samples);
        assert_eq!(region.size(), ratio(&cases, &all));
        for (statistics, _) in cells(&samples) {
            let expected = inside.contains(&(statistics.rank_sum, statistics.exceedances as u64));
            assert_eq!(region.contains(statistics), expected, "{statistics:?}");
        }
    }
}

/// The equal products named for 12/12/12: (w − 78, t) = (280, 12) and (288, 10).
#[test]
fn equal_products_exist() {
    let samples = sizes(12, 12, 12);
    let (w, t) = (
        NullLaw::rank_sum(&samples).unwrap(),
        NullLaw::exceedances(&samples).unwrap(),
    );
    assert_eq!(
        w.tail_count(280 + 78) * t.tail_count(12),
        w.tail_count(288 + 78) * t.tail_count(10)
    );
}

#[test]
fn wilcoxon_is_the_published_test() {
    let region = region(
        Rule::Wilcoxon,
        Alternative::Greater,
        0.01,
        &sizes(12, 12, 12),
    );
    assert_eq!(region.critical_values(), vec![(None, Some(291)); 13]);
    assert!((region.size() - 0.009972063).abs() < 5e-10);
}

#[test]
fn disjunction_and_conjunction_by_hand() {
    let samples = sizes(12, 12, 12);
    let either = region(Rule::Disjunction, Alternative::Greater, 0.01, &samples);
    let values = either.critical_values();
    // P(T ≥ 8) = .0047 ≤ α/2 < P(T ≥ 7), so from T = 8 on any W will do.
    assert!(values[8..].iter().all(|v| *v == (None, Some(78))));
    let w = NullLaw::rank_sum(&samples).unwrap();
    let left = (0.01 - 0.004711267) / (1.0 - 0.004711267);
    assert!(
        values[..8]
            .iter()
            .all(|v| *v == (None, Some(w.critical(left))))
    );
    let both = region(Rule::Conjunction, Alternative::Greater, 0.01, &samples);
    let t = NullLaw::exceedances(&samples).unwrap().critical(0.1) as usize;
    let values = both.critical_values();
    assert!(values[..t].iter().all(|v| *v == (None, None)));
    assert!(
        values[t..]
            .windows(2)
            .all(|pair| pair[0] == pair[1] && pair[0].1.is_some())
    );
}

/// P(T ≥ 2) = .033 at 12/12/2: no t qualifies for α/2, so the disjunction is the rank-sum test.
#[test]
fn disjunction_without_a_threshold_is_wilcoxon() {
    let samples = sizes(12, 12, 2);
    let either = region(Rule::Disjunction, Alternative::Greater, 0.01, &samples);
    let alone = region(Rule::Wilcoxon, Alternative::Greater, 0.01, &samples);
    assert_eq!(either.critical_values(), alone.critical_values());
}

/// `less` mirrors W; `two-sided` joins both halves.
#[test]
fn alternatives_mirror() {
    let samples = sizes(12, 12, 12);
    for rule in &RULES {
        let greater = region(rule.clone(), Alternative::Greater, 0.01, &samples);
        let less = region(rule.clone(), Alternative::Less, 0.01, &samples);
        let both = region(rule.clone(), Alternative::TwoSided, 0.01, &samples);
        for (statistics, _) in cells(&samples) {
            let rank_sum = 12 * 37 - statistics.rank_sum;
            let mirrored = Statistics {
                rank_sum,
                ..statistics
            };
            assert_eq!(greater.contains(statistics), less.contains(mirrored));
            assert_eq!(both.contains(statistics), both.contains(mirrored));
        }
        let t = if *rule == Rule::Conjunction { 9 } else { 0 };
        let (lower, upper) = both.critical_values()[t];
        assert_eq!(lower.unwrap() + upper.unwrap(), 12 * 37);
    }
}

#[test]
fn tables() {
    let samples = sizes(12, 12, 2);
    let table = |entries: &[Option<u64>]| {
        try_region(
            &Rule::Table(entries.to_vec()),
            Alternative::Greater,
            0.01,
            &samples,
        )
    };
    let wilcoxon = region(Rule::Wilcoxon, Alternative::Greater, 0.01, &samples);
    let c = wilcoxon.critical_values()[0].1;
    assert_eq!(table(&[c, c, c]).unwrap().size(), wilcoxon.size());
    assert_eq!(table(&[None, None, None]).unwrap().size(), 0.0);
    assert!(matches!(
        table(&[c, c]),
        Err(RegionError::TableLength { .. })
    ));
    assert!(matches!(
        table(&[c, c, Some(0)]),
        Err(RegionError::TableTooLarge { .. })
    ));
}

#[test]
fn refusals_name_what_can_be_reached() {
    let refuse = |rule: &Rule, alpha, samples: &Samples| {
        try_region(rule, Alternative::Greater, alpha, samples).unwrap_err()
    };
    for alpha in [0.0, 1.0, -0.1, f64::NAN] {
        let error = refuse(&Rule::Product, alpha, &sizes(3, 3, 3));
        assert!(matches!(error, RegionError::Alpha(_)));
    }
    assert!(matches!(
        refuse(&Rule::Conjunction, 0.01, &sizes(8, 4, 1)),
        RegionError::NoExceedanceThreshold { .. }
    ));
    let samples = sizes(4, 2, 4);
    for rule in &RULES {
        let RegionError::Unreachable { reachable, .. } = refuse(rule, 1e-6, &samples) else {
            panic!("{rule}");
        };
        let at = |alpha| try_region(rule, Alternative::Greater, alpha, &samples);
        assert!(at(reachable * 1.0001).is_ok(), "{rule} {reachable}");
        assert!(at(reachable * 0.9999).is_err(), "{rule} {reachable}");
    }
}

/// Large sizes take seconds at most.
#[test]
fn large_sizes() {
    let region = region(
        Rule::Product,
        Alternative::Greater,
        0.01,
        &sizes(200, 200, 200),
    );
    assert!(region.size() <= 0.01 && region.size() > 0.00999);
}
