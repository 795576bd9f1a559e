//! Identifies a point of a study by its parameters.

use crate::counts::Key;
use crate::results::RESULTS;
use std::collections::BTreeSet;

/// The parameters that the outcome at one point depends on, seed and trials apart.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Identity {
    /// Names and values of the parameters.
    pub parameters: Vec<(String, String)>,
    /// The curve of the point, as text for messages; empty if the point has no curve.
    pub place: String,
}

impl Identity {
    /// The identity of a study that has a single point.
    pub fn new<N: Into<String>>(parameters: impl IntoIterator<Item = (N, String)>) -> Self {
        let parameters = parameters.into_iter();
        Self {
            parameters: parameters
                .map(|(name, value)| (name.into(), value))
                .collect(),
            place: String::new(),
        }
    }

    /// The same identity with one more parameter.
    pub fn with(mut self, name: &str, value: f64) -> Self {
        self.parameters.push((name.to_owned(), value.to_string()));
        self
    }

    /// The key of the counter of this point.
    pub fn key(&self, study: &str, seed: u64, common_random_numbers: bool) -> Key {
        let mut text = format!(
            "results {RESULTS} seed {seed} common_random_numbers {common_random_numbers} {study}"
        );
        for (name, value) in &self.parameters {
            text += &format!(" {name} {value}");
        }
        Key::of(&text)
    }

    /// Compares the first point of `there` that `here` lacks with the most similar point of `here`, and names
    /// the first parameter that differs. Points of `here` that `there` lacks are preferred; where there are none,
    /// points were left out, which changes nothing of the others.
    pub(super) fn difference(there: &[Self], here: &[Self]) -> Option<String> {
        let is_in = |all: &[Self]| all.iter().map(|one| one.parameters.clone()).collect();
        let (known, held): (BTreeSet<_>, BTreeSet<_>) = (is_in(here), is_in(there));
        if known.is_subset(&held) {
            return None;
        }
        let odd = there.iter().find(|one| !known.contains(&one.parameters))?;
        let differing = |one: &Self| {
            let pairs = odd.parameters.iter().zip(&one.parameters);
            pairs.filter(|(a, b)| a != b).count()
        };
        let nearest = here.iter().min_by_key(|one| {
            let is_new = !held.contains(&one.parameters);
            (!is_new, differing(one), one.place != odd.place)
        });
        let cells = nearest.map(|nearest| odd.parameters.iter().zip(&nearest.parameters));
        let differing = cells.and_then(|mut cells| cells.find(|(a, b)| a != b));
        Some(match differing {
            Some(((name, there), (_, here))) => {
                format!("{name} is {there} there, {here} here{}", odd.place)
            }
            None => "it has points that are not here".to_owned(),
        })
    }
}
