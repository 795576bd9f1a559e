//! The names that claims may refer to: checks, and the curves that a name stands for.

use super::narrative::{Contrasts, Narrative, Test};
use crate::suggest::among;

/// The curves and the axis of a sweep; empty for any other experiment.
#[derive(Clone, Debug, Default, PartialEq)]
#[allow(missing_docs, reason = "a sweep has both")]
pub struct Scope {
    pub curves: Vec<Curve>,
    pub axis: Axis,
}

/// The names of a curve.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the config's own words")]
pub struct Curve {
    pub label: String,
    pub panel: Option<String>,
    pub series: Option<String>,
}

/// A parameter and the values it takes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// The key in a config.
    pub name: &'static str,
    /// The symbol in the paper.
    pub symbol: &'static str,
    /// Each value as written, and as a number if it is one.
    pub values: Vec<(String, Option<f64>)>,
}

/// Two curves, by their index, and the panel or series they share; blank for two labels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contrast<'a> {
    pub first: usize,
    pub second: usize,
    pub place: &'a str,
}

/// Why a claim does not fit the sweep it refers to.
#[derive(Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum ClaimProblem {
    #[error("unknown curve {}", among(got, known.iter().map(String::as_str)))]
    UnknownCurve { got: String, known: Vec<String> },
    #[error("must name at least one curve (leave it out for all)")]
    NoCurves,
    #[error("must be another curve than those before it, got {0} again")]
    Repeated(String),
    #[error("grows needs an axis of at least two numbers in ascending order (sort them)")]
    Axis,
    #[error("gain needs the axis delta with values from 0 up, in ascending order")]
    GainAxis,
    #[error("quantity needs from, to or both")]
    NoEnds,
    #[error("from = {from} lies above to = {to} (exchange them)")]
    Reversed { from: f64, to: f64 },
    #[error(
        "there are no curves here to test (write {{ quantity = {{ name = \"...\", from = 0.0 }} }})"
    )]
    NoSweep,
}

/// A problem, after the path of the value at fault.
type Placed = (String, ClaimProblem);

impl Narrative {
    /// Checks every claim against what it refers to.
    ///
    /// # Errors
    /// The first problem, after the path of its value, such as `claim[0].test.exceeds.first`.
    pub fn check(&self, scope: &Scope) -> Result<(), Placed> {
        for (index, claim) in self.claims.iter().enumerate() {
            scope
                .check(&claim.test)
                .map_err(|(path, problem)| (format!("claim[{index}].test{path}"), problem))?;
        }
        Ok(())
    }
}

impl Scope {
    fn check(&self, test: &Test) -> Result<(), Placed> {
        let is_of_curves = !matches!(test, Test::Quantity { .. });
        if is_of_curves && self.curves.is_empty() {
            return Err((String::new(), ClaimProblem::NoSweep));
        }
        match test {
            Test::Grows { curves } => self.check_curves(".grows", curves.as_deref())?,
            Test::AlphaHeld { curves, .. } => {
                self.check_curves(".alpha_held", curves.as_deref())?
            }
            Test::Exceeds(contrasts) => self.check_contrasts(".exceeds", contrasts)?,
            Test::Equals(contrasts) => self.check_contrasts(".equals", contrasts)?,
            Test::Gain { first, second, .. } => self.check_pair(".gain", first, second)?,
            Test::Quantity { .. } => {}
        }
        match self.problem(test) {
            Some(problem) => Err((String::new(), problem)),
            None => Ok(()),
        }
    }

    /// The problem of a test whose curves exist, if it has one.
    fn problem(&self, test: &Test) -> Option<ClaimProblem> {
        let numbers = self.axis.ascending().unwrap_or_default();
        match *test {
            Test::Grows { .. } if numbers.len() < 2 => Some(ClaimProblem::Axis),
            Test::Gain { .. } if self.axis.name != "delta" => Some(ClaimProblem::GainAxis),
            Test::Gain { .. } if numbers.first().is_none_or(|start| *start < 0.0) => {
                Some(ClaimProblem::GainAxis)
            }
            Test::Quantity { from, to, .. } => match (from, to) {
                (None, None) => Some(ClaimProblem::NoEnds),
                (Some(from), Some(to)) if from > to => Some(ClaimProblem::Reversed { from, to }),
                _ => None,
            },
            _ => None,
        }
    }

    fn check_curves(&self, test: &str, curves: Option<&[String]>) -> Result<(), Placed> {
        if curves.is_some_and(<[String]>::is_empty) {
            return Err((format!("{test}.curves"), ClaimProblem::NoCurves));
        }
        let named = curves.unwrap_or_default().iter().enumerate();
        let paths = named.map(|(index, label)| (format!("{test}.curves[{index}]"), label.as_str()));
        self.check_labels(paths)
    }

    fn check_contrasts(&self, test: &str, contrasts: &Contrasts) -> Result<(), Placed> {
        let Contrasts { first, second } = contrasts;
        if first != second && !self.shared(contrasts).is_empty() {
            return Ok(());
        }
        self.check_pair(test, first, second)
    }

    fn check_pair(&self, test: &str, first: &str, second: &str) -> Result<(), Placed> {
        let paths = [
            (format!("{test}.first"), first),
            (format!("{test}.second"), second),
        ];
        self.check_labels(paths.into_iter())
    }

    /// Checks that each label is that of a curve and occurs only once.
    fn check_labels<'a>(
        &self,
        labels: impl Iterator<Item = (String, &'a str)>,
    ) -> Result<(), Placed> {
        let mut before = Vec::new();
        for (path, label) in labels {
            let got = label.to_owned();
            if self.index(label).is_none() {
                let known = self
                    .curves
                    .iter()
                    .map(|curve| curve.label.clone())
                    .collect();
                return Err((path, ClaimProblem::UnknownCurve { got, known }));
            }
            if before.contains(&label) {
                return Err((path, ClaimProblem::Repeated(got)));
            }
            before.push(label);
        }
        Ok(())
    }

    fn index(&self, label: &str) -> Option<usize> {
        self.curves.iter().position(|curve| curve.label == label)
    }

    /// The curves of these labels; all curves without labels.
    pub(super) fn named(&self, labels: Option<&[String]>) -> Vec<usize> {
        match labels {
            Some(labels) => labels
                .iter()
                .filter_map(|label| self.index(label))
                .collect(),
            None => (0..self.curves.len()).collect(),
        }
    }

    /// For two series a contrast in each panel that has both, for two panels a contrast of each series that is in
    /// both, else a contrast of the two curves.
    pub(super) fn contrasts<'a>(&'a self, contrasts: &Contrasts) -> Vec<Contrast<'a>> {
        let shared = self.shared(contrasts);
        if !shared.is_empty() {
            return shared;
        }
        let place = "";
        match [&contrasts.first, &contrasts.second].map(|label| self.index(label)) {
            [Some(first), Some(second)] => vec![Contrast {
                first,
                second,
                place,
            }],
            _ => Vec::new(),
        }
    }

    /// The contrasts of two series or two panels.
    fn shared<'a>(&'a self, names: &Contrasts) -> Vec<Contrast<'a>> {
        let (first, second) = (names.first.as_str(), names.second.as_str());
        let mut contrasts = Vec::new();
        let of_series: NamesOf = |curve| (curve.series.as_deref(), curve.panel.as_deref());
        let of_panel: NamesOf = |curve| (curve.panel.as_deref(), curve.series.as_deref());
        for names_of in [of_series, of_panel] {
            let index_of = |names| {
                self.curves
                    .iter()
                    .position(|curve| names_of(curve) == names)
            };
            for (one, curve) in self.curves.iter().enumerate() {
                if let (Some(name), Some(place)) = names_of(curve)
                    && name == first
                    && let Some(second) = index_of((Some(second), Some(place)))
                {
                    let first = one;
                    contrasts.push(Contrast {
                        first,
                        second,
                        place,
                    });
                }
            }
        }
        contrasts
    }
}

/// The name by which a curve is compared, and the one that both curves of a contrast share.
type NamesOf = fn(&Curve) -> (Option<&str>, Option<&str>);

impl Axis {
    /// The values, if they are numbers in ascending order.
    fn ascending(&self) -> Option<Vec<f64>> {
        let numbers: Option<Vec<f64>> = self.values.iter().map(|(_, number)| *number).collect();
        numbers.filter(|numbers| numbers.is_sorted_by(|a, b| a < b))
    }
}
