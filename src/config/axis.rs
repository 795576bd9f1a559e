//! The x axis: one parameter and the values it takes.

use super::drawing::Refused;
use super::error::{Problem, Refusal, nearest};
use super::file::{AxisTable, Sections};
use super::value::Number;
use serde::Deserialize;
use std::fmt;
use std::ops::Range;
use toml::{Spanned, Value};

/// The parameters, each with its name in a config and the keys it stands for.
macro_rules! parameters {
    ($($(#[$doc:meta])* $variant:ident: $name:literal = $($section:ident.$key:ident),+;)*) => {
        /// A parameter that an axis can sweep.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Parameter {
            $($(#[$doc])* $variant,)*
        }

        impl Parameter {
            /// All of them, by the name they have in a config and, where they have a column, in results.
            pub(super) const ALL: &[(&'static str, Self)] = &[$(($name, Self::$variant)),*];

            /// Its name.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// The sections and keys it stands for.
            pub(super) fn keys(self) -> &'static [(&'static str, &'static str)] {
                match self {
                    $(Self::$variant => &[$((stringify!($section), stringify!($key))),+],)*
                }
            }
        }
    };
}

parameters! {
    /// Δ/σ_ξ.
    Delta: "delta" = motion.delta;
    /// Length of the acceleration.
    Duration: "duration" = motion.duration;
    /// Start of the acceleration after X.
    Offset: "offset" = motion.offset;
    /// ν.
    Nu: "nu" = impulses.nu;
    /// θ/σ_ξ.
    Theta: "theta" = impulses.theta;
    /// Step of the sensor.
    Quantum: "quantum" = noise.quantum;
    /// Limit of the sensor.
    Range: "range" = noise.range;
    /// Drift of the rest.
    Drift: "drift" = rest.drift;
    /// Factor of the noise after X.
    Swell: "swell" = rest.swell;
    /// Probability of a footfall.
    Footfalls: "footfalls" = rest.footfalls;
    /// Training samples.
    Training: "training" = whitening.training;
    /// m.
    Order: "order" = whitening.order;
    /// N, M₁ and M₂ together.
    AllSamples: "all_samples" = samples.reference, samples.shift, samples.scale;
    /// N and M₂ together.
    ReferenceAndScale: "reference_and_scale" = samples.reference, samples.scale;
    /// N.
    Reference: "reference" = samples.reference;
    /// M₁.
    Shift: "shift" = samples.shift;
    /// M₂.
    Scale: "scale" = samples.scale;
    /// Samples skipped between X, Y₁ and Y₂.
    Gap: "gap" = samples.gap;
    /// Observations in a block mean.
    Decimation: "decimation" = samples.decimation;
    /// α.
    Alpha: "alpha" = detector.alpha;
    /// The decision rule.
    Rule: "rule" = detector.rule;
}

impl Parameter {
    /// As the paper writes it.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Delta => "Δ/σ_ξ",
            Self::Nu => "ν",
            Self::Theta => "θ/σ_ξ",
            Self::Order => "m",
            Self::AllSamples => "N = M₁ = M₂",
            Self::ReferenceAndScale => "N = M₂",
            Self::Reference => "N",
            Self::Shift => "M₁",
            Self::Scale => "M₂",
            Self::Alpha => "α",
            other => other.name(),
        }
    }
}

/// One value of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisValue {
    value: Value,
}

/// A parameter and its values.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What is swept.
    pub parameter: Parameter,
    /// At least one.
    pub values: Vec<AxisValue>,
    span: Range<usize>,
}

/// More points than this on one axis are a mistake.
const MOST_POINTS: usize = 10_000;

impl AxisValue {
    /// As the file has it.
    pub(super) fn written(&self) -> &Value {
        &self.value
    }

    /// The number, where it is one.
    pub fn number(&self) -> Option<f64> {
        match self.value {
            Value::Float(number) => Some(number),
            Value::Integer(number) => Some(number as f64),
            _ => None,
        }
    }
}

/// A number in the fewest digits, a name as it is, a table by its name.
impl fmt::Display for AxisValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.value, self.number()) {
            (_, Some(number)) => write!(f, "{number}"),
            (Value::String(name), _) => f.write_str(name),
            (Value::Table(table), _) => f.write_str(table.keys().next().map_or("", |key| key)),
            (other, _) => write!(f, "{other}"),
        }
    }
}

impl Axis {
    pub(super) fn new(table: &AxisTable) -> Result<Self, Refused> {
        let (key, value) = only(table)?;
        let known = Parameter::ALL.iter().map(|(name, _)| *name);
        let Some(&(name, parameter)) = Parameter::ALL
            .iter()
            .find(|(name, _)| name == key.get_ref())
        else {
            return Err(unknown(key, known));
        };
        let span = value.span();
        match values(name, value.get_ref()) {
            Ok(values) => Ok(Self {
                parameter,
                values,
                span,
            }),
            Err(problem) => Err((Some(span), problem)),
        }
    }

    /// Where the values stand in the file.
    pub(super) fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// Puts `value` in the place of what the sections say.
    pub(super) fn set(&self, value: &AxisValue, sections: &mut Sections) -> Result<(), Problem> {
        for &place in self.parameter.keys() {
            sections
                .set(place, &value.value, self.span())
                .map_err(|error| Problem::AxisValue {
                    name: self.parameter.name(),
                    refusal: Refusal::new("", error),
                })?;
        }
        Ok(())
    }
}

/// The one key of an axis and what stands there.
pub(super) fn only(table: &AxisTable) -> Result<(&Spanned<String>, &Spanned<Value>), Refused> {
    let entries = table.get_ref();
    match entries.iter().next() {
        Some(entry) if entries.len() == 1 => Ok(entry),
        _ => {
            // The second key is the one too many.
            let span = entries.keys().nth(1).map_or(table.span(), Spanned::span);
            Err((Some(span), Problem::AxisKeys(entries.len())))
        }
    }
}

/// An axis that is none of the `known` names.
pub(super) fn unknown(
    key: &Spanned<String>,
    known: impl Iterator<Item = &'static str> + Clone,
) -> Refused {
    let problem = Problem::UnknownParameter {
        got: key.get_ref().clone(),
        hint: nearest(key.get_ref(), known.clone()),
        known: known.collect::<Vec<_>>().join(", "),
    };
    (Some(key.span()), problem)
}

/// `{ from, to, step }`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Steps {
    from: Number,
    to: Number,
    step: Number,
}

/// The values of a list, or of a range.
pub(super) fn values(name: &'static str, value: &Value) -> Result<Vec<AxisValue>, Problem> {
    let values: Vec<Value> = match value {
        Value::Array(list) => list.clone(),
        Value::Table(_) => {
            let steps = value.clone().try_into().map_err(|error| {
                let refusal = Refusal::new("", error);
                Problem::AxisValue { name, refusal }
            })?;
            range(name, &steps)?
        }
        single => vec![single.clone()],
    };
    match values.is_empty() {
        true => Err(Problem::EmptyAxis(name)),
        false => Ok(values
            .into_iter()
            .map(|value| AxisValue { value })
            .collect()),
    }
}

/// from, from + step, …, to; whole numbers stay whole.
fn range(name: &'static str, steps: &Steps) -> Result<Vec<Value>, Problem> {
    let (from, to, step) = (steps.from.0, steps.to.0, steps.step.0);
    if step <= 0.0 {
        return Err(Problem::Step { name, step });
    }
    if from > to {
        return Err(Problem::Reversed { name, from, to });
    }
    // A billionth of a step forgives the rounding of (to − from)/step.
    let points = ((to - from) / step + 1e-9).floor() + 1.0;
    if points > MOST_POINTS as f64 {
        let limit = MOST_POINTS;
        return Err(Problem::TooManyPoints {
            name,
            points,
            limit,
        });
    }
    let value = |i: usize| {
        let value = from + i as f64 * step;
        // What rounding leaves of a zero is a zero.
        let value = if value.abs() < 1e-9 * step {
            0.0
        } else {
            twelve_digits(value)
        };
        match value.fract() == 0.0
            && value.abs() < 1e15
            && from.fract() == 0.0
            && step.fract() == 0.0
        {
            true => Value::Integer(value as i64),
            false => Value::Float(value),
        }
    };
    Ok((0..points as usize).map(value).collect())
}

/// The nearest number of twelve significant digits: 0.1 + 2 · 0.1 is meant to be 0.3.
fn twelve_digits(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(value: &str) -> Vec<f64> {
        let table: toml::Table = format!("x = {value}").parse().unwrap();
        let values = values("delta", &table["x"]).unwrap();
        values.iter().map(|value| value.number().unwrap()).collect()
    }

    #[test]
    fn ranges_are_what_they_say() {
        let range = numbers("{ from = 0.0, to = 3.0, step = 0.1 }");
        assert_eq!(range.len(), 31);
        assert_eq!((range[3], range[30]), (0.3, 3.0));
        assert_eq!(numbers("{ from = -0.7, to = 0.7, step = 0.1 }")[7], 0.0);
        assert_eq!(numbers("{ from = 2, to = 9, step = 3 }"), [2.0, 5.0, 8.0]);
        assert_eq!(numbers("{ from = 1.0, to = 1.0, step = 0.5 }"), [1.0]);
        assert_eq!(numbers("[1, 2.5]"), [1.0, 2.5]);
    }
}
