//! The tables that say what to draw, as they stand in the file, and what they come to: one of them
//! takes the place of `[axis]` and `[[curve]]`.

use super::error::Problem;
use super::exhibit::{ExhibitKind, Search};
use super::file::{LawKind, RuleKind, Sections};
use super::value::{Number, Whole};
use crate::chain::Scenario;
use crate::detect::{Method, Rule};
use serde::Deserialize;
use std::ops::{Range, RangeInclusive};
use toml::Spanned;

/// A problem and where it stands, if anywhere but the whole table.
pub(super) type Refused = (Option<Range<usize>>, Problem);

/// Most samples in one realisation.
pub(super) const LONGEST: usize = 1_000_000;
/// Most assignments of ranks that an enumeration may take; their square is exact in an f64.
const MOST_ASSIGNMENTS: u128 = 50_000_000;
/// Most curves that can be told apart.
const MOST_CURVES: usize = 36;

/// `[autocorrelation]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AutocorrelationTable {
    pub lags: Option<Spanned<Whole>>,
    pub length: Option<Spanned<Whole>>,
}

/// `[layout]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LayoutTable {}

/// `[region]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RegionTable {
    pub rules: Spanned<Vec<Spanned<RuleKind>>>,
}

/// `[independence]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct IndependenceTable {
    pub sizes: Spanned<Vec<Spanned<[Whole; 3]>>>,
}

/// `[impulse_law]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ImpulseLawTable {
    pub nu: Spanned<Vec<Spanned<Number>>>,
    pub length: Option<Spanned<Whole>>,
}

/// `[operating_point]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OperatingPointTable {
    pub sizes: Spanned<Vec<Spanned<Whole>>>,
    pub power: Spanned<Vec<Spanned<Number>>>,
    pub delta: Spanned<DeltaRange>,
}

/// `operating_point.delta`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DeltaRange {
    pub from: Number,
    pub to: Number,
}

pub(super) fn search(table: &OperatingPointTable) -> Result<ExhibitKind, Refused> {
    const KIND: &str = "operating_point";
    let refuse = |span, key, rule: &str, got: String| {
        Err((Some(span), out_of_range(KIND, key, rule.to_owned(), got)))
    };
    let (sizes, power) = (table.sizes.get_ref(), table.power.get_ref());
    if sizes.is_empty() {
        return refuse(
            table.sizes.span(),
            "sizes",
            "list at least one",
            "none".to_owned(),
        );
    }
    if power.is_empty() {
        return refuse(
            table.power.span(),
            "power",
            "list at least one",
            "none".to_owned(),
        );
    }
    if let Some(bad) = sizes.iter().find(|size| size.get_ref().0 == 0) {
        return refuse(bad.span(), "sizes", "be at least 1", "0".to_owned());
    }
    let is_level = |power: &Spanned<Number>| (f64::EPSILON..1.0).contains(&power.get_ref().0);
    if let Some(bad) = power.iter().find(|power| !is_level(power)) {
        let got = bad.get_ref().0.to_string();
        return refuse(bad.span(), "power", "lie strictly between 0 and 1", got);
    }
    let DeltaRange { from, to } = *table.delta.get_ref();
    if from.0 >= to.0 {
        let got = format!("{} to {}", from.0, to.0);
        return refuse(table.delta.span(), "delta", "rise from `from` to `to`", got);
    }
    Ok(ExhibitKind::OperatingPoint(Search {
        sizes: sizes.iter().map(|size| size.get_ref().size()).collect(),
        power: power.iter().map(|power| power.get_ref().0).collect(),
        delta: [from.0, to.0],
    }))
}

pub(super) fn autocorrelation(table: &AutocorrelationTable) -> Result<ExhibitKind, Refused> {
    const KIND: &str = "autocorrelation";
    let length = whole(KIND, "length", &table.length, 4096, 2..=LONGEST)?;
    let lags = whole(KIND, "lags", &table.lags, 40, 1..=length.min(10_000) - 1)?;
    Ok(ExhibitKind::Autocorrelation { lags, length })
}

/// The rules, read by the same code as a detector's.
pub(super) fn rules(table: &RegionTable, sections: &Sections) -> Result<ExhibitKind, Refused> {
    let given = table.rules.get_ref();
    if given.is_empty() {
        let problem = out_of_range(
            "region",
            "rules",
            "name a rule".to_owned(),
            "none".to_owned(),
        );
        return Err((Some(table.rules.span()), problem));
    }
    let rule = |kind: &Spanned<_>| {
        let mut sections = sections.clone();
        sections.detector.rule = Some(kind.clone());
        match sections.resolve() {
            Ok(scenario) => match scenario.detector.method {
                Method::Rule(rule) => Ok(rule),
                other => {
                    let rule = "have an exact boundary".to_owned();
                    let problem = out_of_range("region", "rules", rule, other.to_string());
                    Err((Some(kind.span()), problem))
                }
            },
            Err((problem, keys)) => Err((sections.first_span(keys), problem)),
        }
    };
    let rules: Vec<Rule> = given.iter().map(rule).collect::<Result<_, _>>()?;
    let repeated = (1..rules.len()).find(|&index| rules[..index].contains(&rules[index]));
    if let Some(index) = repeated {
        let (rule, got) = ("differ from each other", format!("{} twice", rules[index]));
        let problem = out_of_range("region", "rules", rule.to_owned(), got);
        return Err((Some(given[index].span()), problem));
    }
    Ok(ExhibitKind::Region { rules })
}

pub(super) fn sizes(table: &IndependenceTable) -> Result<ExhibitKind, Refused> {
    let refuse = |span, rule: String, got: String| {
        Err((Some(span), out_of_range("independence", "sizes", rule, got)))
    };
    let given = table.sizes.get_ref();
    if given.is_empty() {
        let rule = "list at least one [N, M1, M2]".to_owned();
        return refuse(table.sizes.span(), rule, "none".to_owned());
    }
    let mut sizes = Vec::new();
    for spanned in given {
        let triple = spanned.get_ref().map(Whole::size);
        if triple.contains(&0) {
            let rule = "be at least 1 each".to_owned();
            return refuse(spanned.span(), rule, format!("{triple:?}"));
        }
        if assignments(triple).is_none_or(|number| number > MOST_ASSIGNMENTS) {
            let rule = format!("have at most {MOST_ASSIGNMENTS} assignments of ranks");
            return refuse(spanned.span(), rule, format!("{triple:?}"));
        }
        if sizes.contains(&triple) {
            let rule = "differ from each other".to_owned();
            return refuse(spanned.span(), rule, format!("{triple:?} twice"));
        }
        sizes.push(triple);
    }
    Ok(ExhibitKind::Independence { sizes })
}

/// (N + M₁ + M₂)!/(N! M₁! M₂!), unless it is very large.
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

pub(super) fn impulse_law(table: &ImpulseLawTable) -> Result<ExhibitKind, Refused> {
    const KIND: &str = "impulse_law";
    let refuse = |span, rule: &str, got: String| {
        let problem = out_of_range(KIND, "nu", rule.to_owned(), got);
        Err((Some(span), problem))
    };
    let mut nu: Vec<f64> = Vec::new();
    for given in table.nu.get_ref() {
        let value = given.get_ref().0;
        if !(value > 0.0 && value < 1.0) {
            let rule = "lie strictly between 0 and 1";
            return refuse(given.span(), rule, value.to_string());
        }
        if nu.contains(&value) {
            return refuse(given.span(), "differ from the others", value.to_string());
        }
        nu.push(value);
    }
    if nu.len() > MOST_CURVES {
        let rule = format!("list at most {MOST_CURVES} probabilities");
        return refuse(table.nu.span(), &rule, nu.len().to_string());
    }
    if nu.is_empty() {
        return refuse(
            table.nu.span(),
            "list at least one probability",
            "none".to_owned(),
        );
    }
    let length = whole(KIND, "length", &table.length, 200, 1..=10_000)?;
    Ok(ExhibitKind::ImpulseLaw { nu, length })
}

/// The band of an autocorrelation is that of a mean of squares, which a heavy tail does not have.
pub(super) fn check_law(sections: &Sections) -> Result<(), Refused> {
    let law = sections.noise.law.as_ref();
    let is_heavy = |law: &Spanned<LawKind>| match *law.get_ref() {
        LawKind::Cauchy => true,
        LawKind::StudentT(freedom) => freedom.0 <= 4.0,
        _ => false,
    };
    match law.filter(|law| is_heavy(law)) {
        Some(law) => Err((Some(law.span()), Problem::NoFourthMoment)),
        None => Ok(()),
    }
}

/// A layout must have an end that can be drawn.
pub(super) fn check_length(scenario: &Scenario) -> Result<(), Refused> {
    let length = (scenario.samples.span()).saturating_add(scenario.whitening.training());
    match length <= LONGEST {
        true => Ok(()),
        false => {
            let rule = format!("span at most {LONGEST} observations");
            let problem = out_of_range("layout", "samples", rule, length.to_string());
            Err((None, problem))
        }
    }
}

pub(super) fn whole(
    kind: &'static str,
    key: &'static str,
    given: &Option<Spanned<Whole>>,
    default: usize,
    allowed: RangeInclusive<usize>,
) -> Result<usize, Refused> {
    let value = given
        .as_ref()
        .map_or(default, |value| value.get_ref().size());
    match allowed.contains(&value) {
        true => Ok(value),
        false => {
            let rule = format!("lie in {} to {}", allowed.start(), allowed.end());
            let problem = out_of_range(kind, key, rule, value.to_string());
            Err((given.as_ref().map(Spanned::span), problem))
        }
    }
}

pub(super) fn positive(
    kind: &'static str,
    key: &'static str,
    given: &Option<Spanned<Number>>,
    default: f64,
) -> Result<f64, Refused> {
    let value = given.as_ref().map_or(default, |value| value.get_ref().0);
    match value > 0.0 {
        true => Ok(value),
        false => {
            let problem = out_of_range(kind, key, "be positive".to_owned(), value.to_string());
            Err((given.as_ref().map(Spanned::span), problem))
        }
    }
}

pub(super) fn out_of_range(
    kind: &'static str,
    key: &'static str,
    rule: String,
    got: String,
) -> Problem {
    Problem::DrawingValue {
        kind,
        key,
        rule,
        got,
        remedy: "",
    }
}
