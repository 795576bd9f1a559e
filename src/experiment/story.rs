//! The narrative as it stands in the file: `[[claim]]` beside `title`, `text` and `order`, and its check
//! against the curves and the axis that the claims name.

use super::Curve;
use super::axis::Axis;
use super::claim::{Claim, ClaimProblem, Contrast, Contrasts, NAMES, Narrative, Test};
use super::error::nearest;
use super::value::{Number, Whole};
use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, Visitor, value::MapAccessDeserializer};
use std::fmt;
use std::ops::Range;
use toml::Spanned;

/// Where the file says nothing.
const LEVEL: f64 = 0.001;
const MARGIN: f64 = 0.005;
const ORDER: u64 = 1000;
const EXCESS: f64 = 1.2;
const POWER: f64 = 0.9;

/// The keys that any experiment may have beside its own.
pub(super) struct Story {
    pub title: Option<Spanned<String>>,
    pub text: Option<Spanned<String>>,
    pub order: Option<Whole>,
    pub claims: Vec<ClaimTable>,
}

/// `[[claim]]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ClaimTable {
    claim: Spanned<String>,
    source: Option<Spanned<String>>,
    level: Option<Spanned<Number>>,
    margin: Option<Spanned<Number>>,
    test: Spanned<TestKind>,
}

/// `claim.test`: a name, or a table with one key.
#[derive(Clone, Debug)]
struct TestKind(TestTable);

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct TestTable {
    grows: Option<GrowsTable>,
    exceeds: Option<PairTable>,
    equals: Option<PairTable>,
    alpha_held: Option<AlphaHeldTable>,
    quantity: Option<QuantityTable>,
    gain: Option<GainTable>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct GrowsTable {
    curves: Option<Labels>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PairTable {
    first: Spanned<String>,
    second: Spanned<String>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct AlphaHeldTable {
    curves: Option<Labels>,
    excess: Option<Spanned<Number>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct QuantityTable {
    name: Spanned<String>,
    from: Option<Spanned<Number>>,
    to: Option<Spanned<Number>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct GainTable {
    first: Spanned<String>,
    second: Spanned<String>,
    power: Option<Spanned<Number>>,
    from: Option<Number>,
}

type Labels = Spanned<Vec<Spanned<String>>>;

/// A problem and where it stands.
type Placed = (Range<usize>, ClaimProblem);

struct TestVisitor;

impl<'de> Visitor<'de> for TestVisitor {
    type Value = TestKind;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of a test or a table with one")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<TestKind, E> {
        let mut table = TestTable::default();
        match name {
            "grows" => table.grows = Some(GrowsTable::default()),
            "alpha_held" => table.alpha_held = Some(AlphaHeldTable::default()),
            _ if NAMES.contains(&name) => {
                return Err(E::custom(format_args!(
                    "needs its parameters (write {{ {name} = {{ ... }} }})"
                )));
            }
            _ => return Err(E::unknown_variant(name, &NAMES)),
        }
        Ok(TestKind(table))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TestKind, A::Error> {
        TestTable::deserialize(MapAccessDeserializer::new(map)).map(TestKind)
    }
}

impl<'de> Deserialize<'de> for TestKind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TestVisitor)
    }
}

/// What a test may refer to.
struct Scope<'a> {
    labels: Vec<&'a str>,
    curves: &'a [Curve],
    axis: Option<&'a Axis>,
}

impl Story {
    /// Checks the claims against the curves and the axis, if there are any.
    pub fn check(self, curves: &[Curve], axis: Option<&Axis>) -> Result<Narrative, Placed> {
        let labels = curves.iter().map(|curve| curve.label.as_str()).collect();
        let scope = Scope {
            labels,
            curves,
            axis,
        };
        let claims = self.claims.iter().map(|table| table.check(&scope));
        Ok(Narrative {
            claims: claims.collect::<Result<_, _>>()?,
            title: self
                .title
                .as_ref()
                .map(|title| said("title", title))
                .transpose()?,
            text: self
                .text
                .as_ref()
                .map(|text| said("text", text))
                .transpose()?,
            order: self.order.map_or(ORDER, |order| order.0),
        })
    }
}

/// One line of text, whatever lines it was written in.
fn said(key: &'static str, text: &Spanned<String>) -> Result<String, Placed> {
    let words: Vec<&str> = text.get_ref().split_whitespace().collect();
    match words.is_empty() {
        true => Err((text.span(), ClaimProblem::Blank(key))),
        false => Ok(words.join(" ")),
    }
}

/// The number given, if it will do, or `default`.
fn number(
    given: &Option<Spanned<Number>>,
    default: f64,
    will_do: impl Fn(f64) -> bool,
    problem: impl Fn(f64) -> ClaimProblem,
) -> Result<f64, Placed> {
    let Some(given) = given else {
        return Ok(default);
    };
    let value = given.get_ref().0;
    match will_do(value) {
        true => Ok(value),
        false => Err((given.span(), problem(value))),
    }
}

fn is_probability(value: f64) -> bool {
    value > 0.0 && value < 1.0
}

impl ClaimTable {
    fn check(&self, scope: &Scope) -> Result<Claim, Placed> {
        let is_margin = |margin| (0.0..1.0).contains(&margin);
        Ok(Claim {
            claim: said("claim", &self.claim)?,
            source: (self.source.as_ref())
                .map(|source| said("source", source))
                .transpose()?,
            level: number(&self.level, LEVEL, is_probability, ClaimProblem::Level)?,
            margin: number(&self.margin, MARGIN, is_margin, ClaimProblem::Margin)?,
            test: self.test.get_ref().0.check(self.test.span(), scope)?,
        })
    }
}

impl TestTable {
    fn check(&self, span: Range<usize>, scope: &Scope) -> Result<Test, Placed> {
        let given = [
            self.grows.as_ref().map(|table| scope.grows(&span, table)),
            self.exceeds.as_ref().map(|table| {
                let contrasts = scope.contrasts(&span, &table.first, &table.second);
                contrasts.map(Test::Exceeds)
            }),
            self.equals.as_ref().map(|table| {
                let contrasts = scope.contrasts(&span, &table.first, &table.second);
                contrasts.map(Test::Equals)
            }),
            self.alpha_held
                .as_ref()
                .map(|table| scope.alpha_held(&span, table)),
            self.quantity.as_ref().map(|table| quantity(&span, table)),
            self.gain.as_ref().map(|table| scope.gain(&span, table)),
        ];
        let mut given: Vec<_> = given.into_iter().flatten().collect();
        match given.len() {
            1 => given.remove(0),
            keys => Err((span, ClaimProblem::Tests(keys))),
        }
    }
}

impl Scope<'_> {
    fn grows(&self, span: &Range<usize>, table: &GrowsTable) -> Result<Test, Placed> {
        let curves = self.curves(span, &table.curves)?;
        match self.ascending().is_some_and(|values| values.len() > 1) {
            true => Ok(Test::Grows { curves }),
            false => Err((span.clone(), ClaimProblem::Axis)),
        }
    }

    fn alpha_held(&self, span: &Range<usize>, table: &AlphaHeldTable) -> Result<Test, Placed> {
        let is_excess = |excess| excess >= 1.0;
        Ok(Test::AlphaHeld {
            curves: self.curves(span, &table.curves)?,
            excess: number(&table.excess, EXCESS, is_excess, ClaimProblem::Excess)?,
        })
    }

    fn gain(&self, span: &Range<usize>, table: &GainTable) -> Result<Test, Placed> {
        let (first, second) = self.pair(span, &table.first, &table.second)?;
        let is_delta = self
            .axis
            .is_some_and(|axis| axis.parameter == super::Parameter::Delta);
        let values = self.ascending().filter(|values| values[0] >= 0.0);
        if !is_delta || values.is_none() {
            return Err((span.clone(), ClaimProblem::GainAxis));
        }
        Ok(Test::Gain {
            first,
            second,
            power: number(&table.power, POWER, is_probability, ClaimProblem::Power)?,
            from: table.from.map_or(0.0, |from| from.0),
        })
    }

    /// The values of the axis, where each is a number above the one before.
    fn ascending(&self) -> Option<Vec<f64>> {
        let values = self.axis?.values.iter().map(|value| value.number());
        let values: Vec<f64> = values.collect::<Option<_>>()?;
        values
            .windows(2)
            .all(|pair| pair[0] < pair[1])
            .then_some(values)
    }

    fn curves(&self, span: &Range<usize>, given: &Option<Labels>) -> Result<Vec<String>, Placed> {
        if self.labels.is_empty() {
            return Err((span.clone(), ClaimProblem::NoSweep));
        }
        let Some(given) = given else {
            return Ok(self.labels.iter().map(|&label| label.to_owned()).collect());
        };
        let mut curves: Vec<String> = Vec::new();
        for label in given.get_ref() {
            let curve = self.curve(label)?;
            if curves.contains(&curve) {
                return Err((label.span(), ClaimProblem::Repeated(curve)));
            }
            curves.push(curve);
        }
        match curves.is_empty() {
            true => Err((given.span(), ClaimProblem::NoCurves)),
            false => Ok(curves),
        }
    }

    fn pair(
        &self,
        span: &Range<usize>,
        first: &Spanned<String>,
        second: &Spanned<String>,
    ) -> Result<(String, String), Placed> {
        if self.labels.is_empty() {
            return Err((span.clone(), ClaimProblem::NoSweep));
        }
        let labels = (self.curve(first)?, self.curve(second)?);
        match labels.0 == labels.1 {
            true => Err((second.span(), ClaimProblem::Same(labels.0))),
            false => Ok(labels),
        }
    }

    /// Two curves, or, where neither name is a label, two series or two panels.
    fn contrasts(
        &self,
        span: &Range<usize>,
        first: &Spanned<String>,
        second: &Spanned<String>,
    ) -> Result<Contrasts, Placed> {
        let (a, b) = (first.get_ref(), second.get_ref());
        let by_series = self.matched(a, b, |curve| (&curve.series, &curve.panel));
        let by_panel = self.matched(a, b, |curve| (&curve.panel, &curve.series));
        let mut each = [by_series, by_panel].concat();
        if each.is_empty() || a == b {
            let (first, second) = self.pair(span, first, second)?;
            let place = String::new();
            each = vec![Contrast {
                first,
                second,
                place,
            }];
        }
        Ok(Contrasts {
            first: a.clone(),
            second: b.clone(),
            each,
        })
    }

    /// The curves called `first` that have a counterpart called `second`, by the two names that `of`
    /// gives a curve: that which is held against another, and that which both share.
    fn matched(
        &self,
        first: &str,
        second: &str,
        of: impl Fn(&Curve) -> (&Option<String>, &Option<String>),
    ) -> Vec<Contrast> {
        let called = |name: &str| {
            let named = self.curves.iter().filter_map(|curve| {
                let (own, shared) = of(curve);
                Some((curve, shared.clone()?)).filter(|_| own.as_deref() == Some(name))
            });
            named.collect::<Vec<_>>()
        };
        let others = called(second);
        let ones = called(first).into_iter();
        ones.filter_map(|(one, place)| {
            let (other, _) = others.iter().find(|(_, shared)| *shared == place)?;
            Some(Contrast {
                first: one.label.clone(),
                second: other.label.clone(),
                place,
            })
        })
        .collect()
    }

    fn curve(&self, given: &Spanned<String>) -> Result<String, Placed> {
        let got = given.get_ref();
        if self.labels.contains(&got.as_str()) {
            return Ok(got.clone());
        }
        let problem = ClaimProblem::UnknownCurve {
            got: got.clone(),
            hint: nearest(got, self.labels.iter().copied()),
            known: self.labels.join(", "),
        };
        Err((given.span(), problem))
    }
}

fn quantity(span: &Range<usize>, table: &QuantityTable) -> Result<Test, Placed> {
    let end = |end: &Option<Spanned<Number>>| end.as_ref().map(|end| end.get_ref().0);
    let (from, to) = (end(&table.from), end(&table.to));
    match (from, to) {
        (None, None) => Err((span.clone(), ClaimProblem::NoEnds)),
        (Some(from), Some(to)) if from > to => {
            Err((span.clone(), ClaimProblem::Reversed { from, to }))
        }
        _ => {
            let name = said("name", &table.name)?;
            Ok(Test::Quantity { name, from, to })
        }
    }
}
