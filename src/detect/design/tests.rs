//! Regions against their definitions, cell by cell.

use super::super::law::needs::shrunk;
use super::*;
use crate::detect::Statistics;
use crate::detect::statistics::smallest_rank_sum;

fn try_region(
    of: Exceedances,
    rule: &Rule,
    alternative: Alternative,
    alpha: f64,
    samples: &Samples,
) -> Result<Region, RegionError> {
    NullLaws::new(of, alternative, samples)?.region(rule, alpha)
}

fn sizes(n: usize, m1: usize, m2: usize) -> Samples {
    Samples::contiguous(n, m1, m2).unwrap()
}

fn region(rule: Rule, alternative: Alternative, alpha: f64, samples: &Samples) -> Region {
    try_region(Exceedances::Scale, &rule, alternative, alpha, samples).unwrap()
}

/// The numbers of cases by T and W, from the smallest W on.
fn counts(of: Exceedances, samples: &Samples) -> Vec<Vec<BigUint>> {
    let w = NullLaw::rank_sum(samples).unwrap();
    let t = NullLaw::exceedances(of, samples).unwrap();
    let column = |t: BigUint| (w.first()..=w.last()).map(move |v| w.count(v) * &t);
    match of {
        Exceedances::Scale => (0..=t.last())
            .map(|v| column.clone()(t.count(v)).collect())
            .collect(),
        Exceedances::Motion => joint::counts(samples),
    }
}

/// Statistics with this W, and these exceedances of Y₂, or of Y₁ for rules on all of the motion.
fn at(of: Exceedances, rank_sum: u64, exceedances: usize) -> Statistics {
    let (scale, shift) = match of {
        Exceedances::Scale => (exceedances, 0),
        Exceedances::Motion => (0, exceedances),
    };
    Statistics {
        rank_sum,
        exceedances: scale,
        shift_exceedances: shift,
    }
}

/// Every cell of the plane of W and T or T′ with its cases.
fn cells(of: Exceedances, samples: &Samples) -> Vec<(Statistics, BigUint)> {
    let first = smallest_rank_sum(samples.shift());
    let columns = counts(of, samples).into_iter().enumerate();
    columns
        .flat_map(|(t, column)| {
            (first..)
                .zip(column)
                .map(move |(w, count)| (at(of, w, t), count))
        })
        .collect()
}

const BOTH: [Exceedances; 2] = [Exceedances::Scale, Exceedances::Motion];
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
        for of in BOTH {
            let cells = cells(of, &samples);
            let all: BigUint = cells.iter().map(|(_, count)| count).sum();
            for (rule, alternative) in RULES.iter().flat_map(|r| ALTERNATIVES.map(|a| (r, a))) {
                let Ok(region) = try_region(of, rule, alternative, 0.01, &samples) else {
                    assert_eq!((rule, samples.scale()), (&Rule::Conjunction, 1));
                    continue;
                };
                let inside = cells.iter().filter(|(s, _)| region.contains(*s));
                let cases: BigUint = inside.map(|(_, count)| count).sum();
                assert_eq!(
                    region.size(),
                    ratio(&cases, &all),
                    "{of} {rule} {alternative}"
                );
                assert!(region.size() <= 0.01 && region.size() > 0.0);
            }
        }
    }
}

/// The product rule against its definition: order all cells by the exact product of the tail counts of both
/// marginal laws, add groups of equal products together, stop before α is exceeded.
#[test]
fn product_enters_cells_in_exact_order() {
    for (samples, alpha) in [
        (sizes(12, 12, 12), 0.01),
        (sizes(12, 12, 12), 0.001),
        (sizes(6, 4, 5), 0.05),
        (sizes(2, 3, 9), 0.2),
        (sizes(1, 3, 4), 0.3),
        (sizes(20, 8, 3), 1e-5),
    ] {
        for of in BOTH {
            let w = NullLaw::rank_sum(&samples).unwrap();
            let t = NullLaw::exceedances(of, &samples).unwrap();
            let mut ordered: Vec<(BigUint, Statistics, BigUint)> = (cells(of, &samples)
                .into_iter())
            .map(|(cell, count)| {
                let tail = t.tail_count(of.of(cell) as u64);
                (w.tail_count(cell.rank_sum) * tail, cell, count)
            })
            .collect();
            ordered.sort();
            let all: BigUint = ordered.iter().map(|(.., count)| count).sum();
            let mut inside = Vec::new();
            let mut cases = BigUint::ZERO;
            for group in ordered.chunk_by(|a, b| a.0 == b.0) {
                let more: BigUint = group.iter().map(|(.., count)| count).sum();
                if ratio(&(&cases + &more), &all) > alpha {
                    break;
                }
                cases += more;
                inside.extend(group.iter().map(|(_, cell, _)| *cell));
            }
            let region = try_region(of, &Rule::Product, Alternative::Greater, alpha, &samples);
            let region = region.unwrap();
            assert_eq!(region.size(), ratio(&cases, &all));
            for (_, cell, _) in &ordered {
                assert_eq!(
                    region.contains(*cell),
                    inside.contains(cell),
                    "{of} {cell:?}"
                );
            }
        }
    }
}

/// The equal products named for 12/12/12: (w − 78, t) = (280, 12) and (288, 10).
#[test]
fn equal_products_exist() {
    let samples = sizes(12, 12, 12);
    let (w, t) = (
        NullLaw::rank_sum(&samples).unwrap(),
        NullLaw::exceedances(Exceedances::Scale, &samples).unwrap(),
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
    let t = NullLaw::exceedances(Exceedances::Scale, &samples)
        .unwrap()
        .critical(0.1) as usize;
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
        for (statistics, _) in cells(Exceedances::Scale, &samples) {
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
            Exceedances::Scale,
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
        try_region(
            Exceedances::Scale,
            rule,
            Alternative::Greater,
            alpha,
            samples,
        )
        .unwrap_err()
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
    for (rule, of) in RULES.iter().flat_map(|rule| BOTH.map(|of| (rule, of))) {
        let at = |alpha| try_region(of, rule, Alternative::Greater, alpha, &samples);
        let Err(RegionError::Unreachable { reachable, .. }) = at(1e-6) else {
            panic!("{rule} {of}");
        };
        assert!(at(reachable * 1.0001).is_ok(), "{rule} {of} {reachable}");
        assert!(at(reachable * 0.9999).is_err(), "{rule} {of} {reachable}");
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

/// The joint law of 40/40/40 takes seconds.
#[test]
fn large_joint_law() {
    let samples = sizes(40, 40, 40);
    let start = std::time::Instant::now();
    let region = try_region(
        Exceedances::Motion,
        &Rule::Product,
        Alternative::Greater,
        0.01,
        &samples,
    );
    println!("40/40/40: {:.1?}", start.elapsed());
    let size = region.unwrap().size();
    assert!(size <= 0.01 && size > 0.00999, "{size}");
}

/// What does not fit says what would.
#[test]
fn joint_law_too_large() {
    let laws = |n| NullLaws::new(Exceedances::Motion, Alternative::Greater, &sizes(n, n, n));
    let Err(NullLawError::TooLarge { share, .. }) = laws(300) else {
        panic!("300/300/300 fits");
    };
    let fits = shrunk(&sizes(300, 300, 300), share);
    assert!(fits.shift() > 40 && fits.shift() < 100, "{fits}");
    let one_more = fits.shift() + 1;
    assert!(laws(one_more).is_err());
}

/// What would take minutes is refused with sizes that do not, whatever their proportions.
#[test]
fn long_joint_laws_are_refused() {
    let laws = |of, [n, m1, m2]: [usize; 3]| {
        let samples = Samples::contiguous(n, m1, m2).unwrap();
        NullLaws::new(of, Alternative::Greater, &samples)
    };
    for sizes in [[67, 67, 67], [50, 50, 50], [100, 80, 3], [200_000, 1, 1]] {
        let error = laws(Exceedances::Motion, sizes).unwrap_err();
        println!("{error}");
        let NullLawError::TooLong { samples, share, .. } = error else {
            panic!("{error}");
        };
        let fits = shrunk(&samples, share);
        let seconds = |samples: &Samples| joint::needs(samples).seconds;
        assert!(seconds(&fits) <= 12.0 && seconds(&samples) > 12.0);
        assert!(fits.reference() < sizes[0] && fits.shift() <= sizes[1]);
    }
    let error = laws(Exceedances::Motion, [5000, 60, 60]).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("the exact laws of W and T' at "),
        "{error}"
    );
    assert!(laws(Exceedances::Scale, [67, 67, 67]).is_ok());
    assert!(laws(Exceedances::Motion, [20, 20, 20]).is_ok());
}
