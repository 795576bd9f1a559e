//! The tables that name a study, each read by serde as it stands, and what a single value cannot say.

use super::ride::{self, RideStudy};
use super::trace::{Trace, TraceTable};
use crate::config::{ConfigError, Conflict, Node, Source, Unfit};
use crate::detect::{Method, Rule};
use crate::scenario::Scenario;
use crate::signal::Law;
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;
use std::fmt::{Debug, Display};

/// What is drawn, with its own parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum ExhibitKind {
    /// The autocorrelation of the sensor's noise.
    Autocorrelation {
        /// The largest lag.
        lags: usize,
        /// Samples in one record.
        length: usize,
    },
    /// One realisation of a ride.
    Trace(Trace),
    /// Where X, Y₁ and Y₂ lie.
    Layout,
    /// The plane of W and T with the regions of several rules.
    Region {
        /// At least one.
        rules: Vec<Rule>,
    },
    /// Whether W and T are independent, by enumeration.
    Independence {
        /// N, M₁ and M₂, at least once.
        sizes: Vec<[usize; 3]>,
    },
    /// The laws of λ and of S.
    ImpulseLaw {
        /// At least one.
        nu: Vec<f64>,
        /// Samples of one realisation.
        length: usize,
    },
    /// The Δ/σ_ξ at which the power reaches a value.
    OperatingPoint(Search),
    /// Whole rides before the monitor.
    Ride(RideStudy),
}

/// The powers looked for, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    /// N = M₁ = M₂, at least one.
    pub sizes: Vec<usize>,
    /// At least one.
    pub power: Vec<f64>,
    /// The smallest and the largest Δ/σ_ξ.
    pub delta: [f64; 2],
}

/// Most samples in one realisation.
pub(super) const LONGEST: usize = 1_000_000;
/// Most assignments of ranks that an enumeration may take; their square is exact in an f64.
const MOST_ASSIGNMENTS: u128 = 50_000_000;
/// Most curves that can be told apart.
const MOST_CURVES: usize = 36;

/// `[autocorrelation]`
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct AutocorrelationTable {
    /// The largest lag.
    #[serde(default = "forty")]
    lags: usize,
    /// Samples in one record.
    #[serde(default = "usual_length")]
    length: usize,
}

fn forty() -> usize {
    40
}

fn usual_length() -> usize {
    4096
}

/// `[layout]`
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct LayoutTable {}

/// `[region]`
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RegionTable {
    /// Rules with an exact region.
    rules: Vec<Method>,
}

/// `[independence]`
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct IndependenceTable {
    /// N, M₁ and M₂ of each enumeration.
    sizes: Vec<[usize; 3]>,
}

/// `[impulse_law]`
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ImpulseLawTable {
    /// ν, strictly between 0 and 1.
    nu: Vec<f64>,
    /// Samples of one realisation.
    #[serde(default = "two_hundred")]
    length: usize,
}

fn two_hundred() -> usize {
    200
}

/// `[operating_point]`
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct OperatingPointTable {
    /// N = M₁ = M₂.
    sizes: Vec<usize>,
    /// The powers looked for.
    power: Vec<f64>,
    /// Where they are looked for, Δ/σ_ξ.
    delta: DeltaRange,
}

/// `operating_point.delta`
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct DeltaRange {
    from: f64,
    to: f64,
}

impl ExhibitKind {
    /// The names of the tables.
    pub const NAMES: [&'static str; 8] = [
        "autocorrelation",
        "trace",
        "layout",
        "region",
        "independence",
        "impulse_law",
        "operating_point",
        "ride",
    ];

    /// The name of its table.
    pub fn name(&self) -> &'static str {
        let index = match self {
            Self::Autocorrelation { .. } => 0,
            Self::Trace(_) => 1,
            Self::Layout => 2,
            Self::Region { .. } => 3,
            Self::Independence { .. } => 4,
            Self::ImpulseLaw { .. } => 5,
            Self::OperatingPoint(_) => 6,
            Self::Ride(_) => 7,
        };
        Self::NAMES[index]
    }

    /// Reads the table of this name.
    pub(super) fn read(name: &str, source: &Source, root: &Node) -> Result<Self, ConfigError> {
        let table = root.get(name).expect("it is asked for");
        let refused = |conflict| source.conflict(root, conflict, &table.span);
        Ok(match name {
            "autocorrelation" => {
                let AutocorrelationTable { lags, length } = source.read(table, name)?;
                within("autocorrelation.length", length, 2..=LONGEST).map_err(refused)?;
                within("autocorrelation.lags", lags, 1..=length.min(10_000) - 1)
                    .map_err(refused)?;
                Self::Autocorrelation { lags, length }
            }
            "trace" => Self::Trace(Trace::checked(source.read(table, name)?).map_err(refused)?),
            "layout" => {
                source.read::<LayoutTable>(table, name)?;
                Self::Layout
            }
            "region" => {
                let RegionTable { rules } = source.read(table, name)?;
                Self::Region {
                    rules: with_regions(rules).map_err(refused)?,
                }
            }
            "independence" => {
                let IndependenceTable { sizes } = source.read(table, name)?;
                check_sizes(&sizes).map_err(refused)?;
                Self::Independence { sizes }
            }
            "impulse_law" => {
                let ImpulseLawTable { nu, length } = source.read(table, name)?;
                check_nu(&nu).map_err(refused)?;
                within("impulse_law.length", length, 1..=10_000).map_err(refused)?;
                Self::ImpulseLaw { nu, length }
            }
            "operating_point" => {
                let table: OperatingPointTable = source.read(table, name)?;
                check_search(&table).map_err(refused)?;
                let OperatingPointTable {
                    sizes,
                    power,
                    delta,
                } = table;
                Self::OperatingPoint(Search {
                    sizes,
                    power,
                    delta: [delta.from, delta.to],
                })
            }
            _ => Self::Ride(ride::read(source, root)?),
        })
    }

    /// Whether it repeats anything.
    pub fn has_trials(&self) -> bool {
        matches!(
            self,
            Self::Autocorrelation { .. }
                | Self::ImpulseLaw { .. }
                | Self::OperatingPoint(_)
                | Self::Ride(_)
        )
    }

    /// Whether a key of the usual sections changes anything in it.
    pub(super) fn heeds(&self, section: &str, key: &str) -> bool {
        match self {
            Self::Autocorrelation { .. } => section == "sensor" || key == "law",
            Self::Trace(trace) => match section {
                "sensor" | "noise" | "impulses" => true,
                "motion" => !matches!(key, "duration" | "offset"),
                "whitening" | "samples" => trace.whitened && key != "decimation",
                _ => false,
            },
            Self::Layout => match section {
                "motion" => !matches!(key, "delta" | "delta_at"),
                "whitening" => true,
                "samples" => key != "decimation",
                _ => false,
            },
            Self::Region { .. } => match section {
                "samples" => !matches!(key, "gap" | "decimation"),
                "detector" => key != "rule",
                _ => false,
            },
            Self::OperatingPoint(_) => match section {
                "motion" => !matches!(key, "delta" | "duration"),
                "samples" => matches!(key, "gap" | "decimation"),
                "detector" => key != "calibrate",
                _ => true,
            },
            Self::Independence { .. } | Self::ImpulseLaw { .. } | Self::Ride(_) => false,
        }
    }

    /// What cannot be seen from the table alone.
    pub(super) fn check(&self, scenario: &Scenario) -> Result<(), Conflict> {
        match self {
            Self::Autocorrelation { .. } => check_law(scenario),
            Self::Trace(trace) if trace.whitened => trace.check_fit(scenario),
            Self::Layout => check_length(scenario),
            _ => Ok(()),
        }
    }
}

fn within(
    path: &str,
    value: usize,
    allowed: std::ops::RangeInclusive<usize>,
) -> Result<(), Conflict> {
    if allowed.contains(&value) {
        return Ok(());
    }
    let rule = format!("lie in {} to {}", allowed.start(), allowed.end());
    Err(Unfit::new(path, rule, value).into())
}

/// Refuses an empty list, and the first value that stands there before.
fn distinct<T: PartialEq + Debug>(
    path: &str,
    what: &str,
    values: &[T],
    show: impl Fn(&T) -> String,
) -> Result<(), Conflict> {
    if values.is_empty() {
        return Err(Unfit::new(path, format!("list at least one {what}"), "none").into());
    }
    let again = (1..values.len()).find(|&i| values[..i].contains(&values[i]));
    match again {
        Some(i) => {
            let got = format!("{} twice", show(&values[i]));
            Err(Unfit::new(format!("{path}[{i}]"), "differ from the others", got).into())
        }
        None => Ok(()),
    }
}

/// Refuses the first value that breaks a rule.
fn each<T: Display>(
    path: &str,
    values: &[T],
    rule: &str,
    holds: impl Fn(&T) -> bool,
) -> Result<(), Conflict> {
    match values.iter().position(|value| !holds(value)) {
        Some(i) => Err(Unfit::new(format!("{path}[{i}]"), rule, &values[i]).into()),
        None => Ok(()),
    }
}

/// The rules of methods that have exact regions, each once.
fn with_regions(methods: Vec<Method>) -> Result<Vec<Rule>, Conflict> {
    distinct("region.rules", "rule", &methods, Method::to_string)?;
    let rule = |(i, method)| match method {
        Method::Rule(rule) => Ok(rule),
        other => {
            let must = "have an exact region (name wilcoxon, product, disjunction or conjunction)";
            Err(Unfit::new(format!("region.rules[{i}]"), must, other).into())
        }
    };
    methods.into_iter().enumerate().map(rule).collect()
}

fn check_sizes(sizes: &[[usize; 3]]) -> Result<(), Conflict> {
    const PATH: &str = "independence.sizes";
    for (i, triple) in sizes.iter().enumerate() {
        let unfit = |rule: String| {
            Err(Unfit::new(format!("{PATH}[{i}]"), rule, format!("{triple:?}")).into())
        };
        if triple.contains(&0) {
            return unfit("be at least 1 each".to_owned());
        }
        if assignments(*triple).is_none() {
            return unfit(format!(
                "have at most {MOST_ASSIGNMENTS} assignments of ranks"
            ));
        }
    }
    distinct(PATH, "[N, M1, M2]", sizes, |triple| format!("{triple:?}"))
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

fn check_nu(nu: &[f64]) -> Result<(), Conflict> {
    const PATH: &str = "impulse_law.nu";
    if nu.len() > MOST_CURVES {
        let rule = format!("list at most {MOST_CURVES} probabilities");
        return Err(Unfit::new(PATH, rule, nu.len()).into());
    }
    each(PATH, nu, "lie strictly between 0 and 1", |nu| {
        *nu > 0.0 && *nu < 1.0
    })?;
    distinct(PATH, "probability", nu, f64::to_string)
}

fn check_search(table: &OperatingPointTable) -> Result<(), Conflict> {
    let OperatingPointTable {
        sizes,
        power,
        delta,
    } = table;
    distinct("operating_point.sizes", "size", sizes, usize::to_string)?;
    distinct("operating_point.power", "power", power, f64::to_string)?;
    each("operating_point.sizes", sizes, "be at least 1", |size| {
        *size > 0
    })?;
    each(
        "operating_point.power",
        power,
        "lie strictly between 0 and 1",
        |power| (f64::EPSILON..1.0).contains(power),
    )?;
    if delta.from >= delta.to {
        let got = format!("{} to {}", delta.from, delta.to);
        return Err(Unfit::new("operating_point.delta", "rise from `from` to `to`", got).into());
    }
    Ok(())
}

/// The band of an autocorrelation is that of a mean of squares, which a heavy tail does not have.
fn check_law(scenario: &Scenario) -> Result<(), Conflict> {
    match Law::from(scenario.noise) {
        Law::Cauchy => {}
        Law::StudentT(freedom) if freedom <= 4.0 => {}
        _ => return Ok(()),
    }
    let rule = "have a fourth moment, which the band of an autocorrelation needs";
    let unfit = Unfit::new("noise.law", rule, scenario.noise);
    let remedy = " (take another law, or a student_t above 4)";
    Err(Unfit { remedy, ..unfit }.into())
}

/// A layout must have an end that can be drawn.
fn check_length(scenario: &Scenario) -> Result<(), Conflict> {
    let length = (scenario.samples.span()).saturating_add(scenario.whitening.training());
    if length <= LONGEST {
        return Ok(());
    }
    let rule = format!("span at most {LONGEST} observations");
    Err(Unfit::new("layout.samples", rule, length).into())
}

/// The tables by name, each with its schema.
pub(super) fn schemas(generator: &mut SchemaGenerator) -> Vec<(&'static str, Value)> {
    let schemas = [
        AutocorrelationTable::json_schema(generator),
        TraceTable::json_schema(generator),
        LayoutTable::json_schema(generator),
        RegionTable::json_schema(generator),
        IndependenceTable::json_schema(generator),
        ImpulseLawTable::json_schema(generator),
        OperatingPointTable::json_schema(generator),
    ];
    let mut schemas: Vec<Value> = schemas
        .into_iter()
        .map(schemars::Schema::to_value)
        .collect();
    schemas.push(ride::schema(generator));
    ExhibitKind::NAMES.into_iter().zip(schemas).collect()
}
