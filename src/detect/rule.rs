//! Decision methods: a rule that gives a region of (W, T), or a baseline statistic, and the sign of Δ.

use super::samples::Samples;
use super::statistics::Statistics;
use schemars::JsonSchema;
use serde::de::{Deserializer, Error, MapAccess, Unexpected, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A rule that gives a region from the exact laws alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rule {
    /// W alone.
    Wilcoxon,
    /// The product of both p-values.
    Product,
    /// Either statistic.
    Disjunction,
    /// Both statistics.
    Conjunction,
    /// C_W(0), C_W(1), … up to the largest number of exceedances; `None` never decides H₁.
    Table(Vec<Option<u64>>),
}

/// A statistic used in place of W and T.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Baseline {
    /// Student's t of the whitened Y₁ against X and Y₂.
    StudentT,
    /// The variance of the whitened Y₂ over that of X.
    VarianceRatio,
    /// The mean of Y₁ minus that of all rest in the raw record, in standard deviations of such means at rest.
    BlockMeans,
    /// The likelihood ratio of normal noise with everything known: Δ, ν, θ and the filter.
    Clairvoyant,
}

/// A decision method.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Method {
    /// A region of (W, T) filled by a rule.
    Rule(Rule),
    /// A region of (W, T) filled in the order of the likelihood ratio against a stated alternative.
    LikelihoodRatio,
    /// Another statistic against a threshold.
    Baseline(Baseline),
}

/// What becomes of equal values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Ties {
    /// A random key for each sample puts them in order, which keeps the laws exact.
    #[default]
    Random,
    /// The later sample counts as the larger: what sorting positions does.
    ByPosition,
    /// Neither exceeds the other: W counts y_i > y_j alone, T what lies strictly outside.
    Strict,
}

/// Whose exceedances of the range of X are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Exceedances {
    #[default]
    /// T, of Y₂ alone, as the paper has it.
    Scale,
    /// T′, of Y₁ and Y₂, which stays powerful where vibration scatters Y₁.
    Motion,
}

impl Exceedances {
    /// T or T′.
    #[inline(always)]
    pub fn of(self, statistics: Statistics) -> usize {
        let of_shift = match self {
            Self::Scale => 0,
            Self::Motion => statistics.shift_exceedances,
        };
        statistics.exceedances + of_shift
    }

    /// The samples that can exceed: M₂ or M₁ + M₂.
    pub fn most(self, samples: &Samples) -> usize {
        match self {
            Self::Scale => samples.scale(),
            Self::Motion => samples.shift().saturating_add(samples.scale()),
        }
    }

    /// The samples, as pictures and tables name them.
    pub fn samples(self) -> &'static str {
        match self {
            Self::Scale => "Y_2",
            Self::Motion => "Y_1 and Y_2",
        }
    }

    /// The symbol of their number.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Scale => "T",
            Self::Motion => "T'",
        }
    }
}

/// The sign of Δ that a region is made for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Alternative {
    #[default]
    /// Δ > 0.
    Greater,
    /// Δ < 0.
    Less,
    /// Δ ≠ 0.
    TwoSided,
}

impl Alternative {
    /// The score that is compared with the critical value: W, its mirror image 2 E W − W, or |2W − 2E W|.
    #[inline]
    pub(super) fn score(self, rank_sum: u64, twice_mean: u64) -> u64 {
        match self {
            Self::Greater => rank_sum,
            Self::Less => twice_mean - rank_sum,
            Self::TwoSided => (2 * rank_sum).abs_diff(twice_mean),
        }
    }

    /// The score of a statistic that is symmetric about zero at rest.
    #[inline]
    pub fn directed(self, statistic: f64) -> f64 {
        match self {
            Self::Greater => statistic,
            Self::Less => -statistic,
            Self::TwoSided => statistic.abs(),
        }
    }
}

impl Rule {
    /// Its name in a config.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Wilcoxon => "wilcoxon",
            Self::Product => "product",
            Self::Disjunction => "disjunction",
            Self::Conjunction => "conjunction",
            Self::Table(_) => "table",
        }
    }
}

impl Baseline {
    /// Its name in a config.
    pub fn name(self) -> &'static str {
        match self {
            Self::StudentT => "student-t",
            Self::VarianceRatio => "variance-ratio",
            Self::BlockMeans => "block-means",
            Self::Clairvoyant => "clairvoyant",
        }
    }
}

impl Method {
    /// The methods without parameters.
    const NAMED: [Self; 9] = [
        Self::Rule(Rule::Wilcoxon),
        Self::Rule(Rule::Product),
        Self::Rule(Rule::Disjunction),
        Self::Rule(Rule::Conjunction),
        Self::LikelihoodRatio,
        Self::Baseline(Baseline::StudentT),
        Self::Baseline(Baseline::VarianceRatio),
        Self::Baseline(Baseline::BlockMeans),
        Self::Baseline(Baseline::Clairvoyant),
    ];

    /// The names of all methods.
    const NAMES: [&'static str; 10] = [
        "wilcoxon",
        "product",
        "disjunction",
        "conjunction",
        TABLE,
        "likelihood-ratio",
        "student-t",
        "variance-ratio",
        "block-means",
        "clairvoyant",
    ];

    /// Its name in a config.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Rule(rule) => rule.name(),
            Self::LikelihoodRatio => "likelihood-ratio",
            Self::Baseline(baseline) => baseline.name(),
        }
    }

    /// Whether it is made for one stated Δ, ν and θ.
    pub fn states_its_alternative(&self) -> bool {
        matches!(
            self,
            Self::LikelihoodRatio | Self::Baseline(Baseline::Clairvoyant)
        )
    }

    /// Whether it uses the samples themselves, not only W and T.
    pub fn needs_samples(&self) -> bool {
        matches!(self, Self::Baseline(_))
    }

    /// Whether it uses the record itself, not only whitened samples.
    pub fn needs_record(&self) -> bool {
        matches!(
            self,
            Self::Baseline(Baseline::BlockMeans | Baseline::Clairvoyant)
        )
    }
}

/// C_W(T) for one T: a rank sum, or "never".
struct Critical(Option<u64>);

impl<'de> Deserialize<'de> for Critical {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct CriticalVisitor;
        impl Visitor<'_> for CriticalVisitor {
            type Value = Critical;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a rank sum or \"never\"")
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Critical, E> {
                u64::try_from(value)
                    .map(|rank_sum| Critical(Some(rank_sum)))
                    .map_err(|_| E::invalid_value(Unexpected::Signed(value), &self))
            }

            fn visit_str<E: Error>(self, value: &str) -> Result<Critical, E> {
                match value {
                    "never" => Ok(Critical(None)),
                    _ => Err(E::invalid_value(Unexpected::Str(value), &self)),
                }
            }
        }
        deserializer.deserialize_any(CriticalVisitor)
    }
}

/// A name, or `{ table = [...] }`.
impl<'de> Deserialize<'de> for Method {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MethodVisitor)
    }
}

struct MethodVisitor;

impl<'de> Visitor<'de> for MethodVisitor {
    type Value = Method;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of a rule or { table = [...] }")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Method, E> {
        match Method::NAMED.iter().find(|method| method.name() == name) {
            Some(method) => Ok(method.clone()),
            None if name == TABLE => {
                let remedy = "needs its parameters (write { table = [...] })";
                Err(E::custom(remedy))
            }
            None => Err(E::unknown_variant(name, &Method::NAMES)),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Method, A::Error> {
        match map.next_key::<String>()?.as_deref() {
            Some(TABLE) => {
                let entries: Vec<Critical> = map.next_value()?;
                let entries = entries.into_iter().map(|Critical(rank_sum)| rank_sum);
                Ok(Method::Rule(Rule::Table(entries.collect())))
            }
            Some(name) => Err(A::Error::unknown_field(name, &[TABLE])),
            None => Err(A::Error::missing_field(TABLE)),
        }
    }
}

const TABLE: &str = "table";

impl JsonSchema for Method {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Rule".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let names: Vec<&str> = Self::NAMED.iter().map(Self::name).collect();
        schemars::json_schema!({ "anyOf": [
            { "enum": names },
            {
                "type": "object",
                "properties": { "table": {
                    "type": "array",
                    "items": { "anyOf": [{ "type": "integer", "minimum": 0 }, { "const": "never" }] },
                } },
                "required": ["table"],
                "additionalProperties": false,
            },
        ] })
    }
}

impl fmt::Display for Rule {
    /// Its name, with the entries of a table: `table(291 291 never)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        if let Self::Table(entries) = self {
            let entries: Vec<String> = (entries.iter())
                .map(|w| w.map_or("never".to_owned(), |w| w.to_string()))
                .collect();
            write!(f, "({})", entries.join(" "))?;
        }
        Ok(())
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rule(rule) => rule.fmt(f),
            other => f.write_str(other.name()),
        }
    }
}

impl fmt::Display for Ties {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl fmt::Display for Exceedances {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl fmt::Display for Alternative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}
