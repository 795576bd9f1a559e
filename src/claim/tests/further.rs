//! How many trials would decide.

use super::*;

/// Few trials do not show growth; ever more of the same do. A quarter more than what is named decides, and half of it
/// does not.
#[test]
fn what_is_named_is_about_enough() {
    let config = config("\"grows\"");
    let hits = [[0, 4, 8, 10, 12], [0, 4, 8, 10, 12]];
    let evidence = |factor: u64| {
        let trials = 20 * factor;
        let rows = rows(&config, trials, hits.map(|of| of.map(|hits| hits * factor)));
        let tallies: Vec<Tally> = rows.iter().map(|row| row.tally).collect();
        let pairs = Plan::new(&config).unwrap().pairs(&config);
        let claims = &config.narrative.claims;
        let comparisons = comparisons(claims, &pairs, &tallies, &vec![None; pairs.len()]);
        let outcomes = rows.iter().map(|row| row.outcome(config.parameter()));
        Evidence {
            scope: config.scope.clone(),
            outcomes: outcomes.collect(),
            comparisons,
            quantities: Vec::new(),
        }
    };
    let claim = &config.narrative.claims[0];
    let verdict = |factor| judge(claim, 1, &evidence(factor)).unwrap().verdict;
    assert_eq!(verdict(1), Verdict::Undecided);
    let Enough::Trials(trials) = trials_to_decide(claim, 1, &evidence(1), 20).unwrap() else {
        panic!("a difference shows with enough trials")
    };
    let factor = trials / 20;
    assert_eq!(verdict(factor + factor / 4 + 1), Verdict::Holds);
    assert_eq!(verdict(factor / 2), Verdict::Undecided);
}

/// No false alarm in a few trials does not mean that there are none: the number named is for a rate of α.
#[test]
fn no_false_alarm_is_no_promise() {
    let config = config("{ alpha_held = { excess = 1.2 } }");
    let named = |hits: u64| {
        let rows = rows(&config, 1000, [[hits; 5]; 2]);
        let outcomes = rows.iter().map(|row| row.outcome(config.parameter()));
        let evidence = Evidence {
            scope: config.scope.clone(),
            outcomes: outcomes.collect(),
            ..Evidence::default()
        };
        trials_to_decide(&config.narrative.claims[0], 1, &evidence, 1000).unwrap()
    };
    let Enough::Trials(at_alpha) = named(10) else {
        panic!("a rate of α passes")
    };
    // 1.2 α is 0.2 √(α n) standard errors away.
    assert!((20_000..80_000).contains(&at_alpha), "{at_alpha}");
    assert_eq!(named(0), Enough::Trials(at_alpha));
    // A rate that is 1.2 α is neither shown to be less nor, ever, to be below α.
    assert_eq!(named(3), Enough::Trials(at_alpha));
}

#[test]
fn of_a_quantity_nothing_is_known() {
    let config = config("{ quantity = { name = \"x\", from = 0.0 } }");
    let quantity = Quantity {
        name: "x".to_owned(),
        value: 0.1,
        low: -1.0,
        high: 1.0,
    };
    let evidence = Evidence {
        quantities: vec![quantity],
        ..Evidence::default()
    };
    let enough = trials_to_decide(&config.narrative.claims[0], 1, &evidence, 10);
    assert_eq!(enough.unwrap(), Enough::Unknown);
}
