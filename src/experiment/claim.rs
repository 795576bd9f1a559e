//! What an experiment says in the report, and the claims it tests: `title`, `text`, `order` and any
//! number of `[[claim]]`.
//!
//! The rule behind a verdict (what is tested, the margin, the family-wise level) stands in the config,
//! so it is fixed before the run and its hash is part of the result.

use super::error::did_you_mean;

/// What the report says of an experiment beside its picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Narrative {
    /// A short heading; the name of the file where there is none.
    pub title: Option<String>,
    /// One paragraph, with placeholders where numbers are to stand.
    pub text: Option<String>,
    /// Where the experiment stands among the others: smaller comes first.
    pub order: u64,
    /// What it tests.
    pub claims: Vec<Claim>,
}

/// A statement of the paper and how it is put to the test.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// In words.
    pub claim: String,
    /// Where the paper makes it; none for a comparison that is this project's own.
    pub source: Option<String>,
    /// The probability of a wrong verdict, over all comparisons of this claim.
    pub level: f64,
    /// Differences up to this size do not count.
    pub margin: f64,
    /// What is tested.
    pub test: Test,
}

/// What a claim says of the results. Curves go by their labels.
#[derive(Clone, Debug, PartialEq)]
pub enum Test {
    /// Each of these curves grows along the axis.
    Grows {
        /// At least one.
        curves: Vec<String>,
    },
    /// The first curve of each contrast lies above the second.
    Exceeds(Contrasts),
    /// Both curves of each contrast are equivalent within ± the margin.
    Equals(Contrasts),
    /// The false-alarm rates of these curves stay at or below α.
    AlphaHeld {
        /// At least one.
        curves: Vec<String>,
        /// A rate is held where it is surely at most this multiple of α.
        excess: f64,
    },
    /// A number lies in [from, to].
    Quantity {
        /// As in `quantities.csv`.
        name: String,
        /// The lower end, if there is one.
        from: Option<f64>,
        /// The upper end, if there is one.
        to: Option<f64>,
    },
    /// One curve needs a smaller Δ than another for the same power.
    Gain {
        /// The curve that needs less.
        first: String,
        /// The curve it is held against.
        second: String,
        /// The power at which they are compared.
        power: f64,
        /// The gain, in decibels, that is to be surpassed.
        from: f64,
    },
}

/// What is held against what.
#[derive(Clone, Debug, PartialEq)]
pub struct Contrasts {
    /// As the claim has it: a curve's label, a series or a panel.
    pub first: String,
    /// Likewise.
    pub second: String,
    /// One for two curves; for two series one in each panel that has both, for two panels one of each
    /// series that is in both.
    pub each: Vec<Contrast>,
}

/// Two curves, by their labels.
#[derive(Clone, Debug, PartialEq)]
pub struct Contrast {
    /// The one.
    pub first: String,
    /// The other.
    pub second: String,
    /// The panel or the series they share; blank for two curves.
    pub place: String,
}

/// The keys of a test.
pub(super) const NAMES: [&str; 6] = [
    "grows",
    "exceeds",
    "equals",
    "alpha_held",
    "quantity",
    "gain",
];

/// What is wrong with a claim.
#[derive(Debug, thiserror::Error)]
pub enum ClaimProblem {
    /// Nothing is said.
    #[error("{0} must not be blank (say it in words)")]
    Blank(&'static str),
    /// A level that is none.
    #[error("claim: level must lie strictly between 0 and 1, got {0}")]
    Level(f64),
    /// A margin that is none.
    #[error("claim: margin must lie in [0, 1), got {0}")]
    Margin(f64),
    /// No test, or more than one.
    #[error("claim: test must have exactly one key, got {0} (one of {names})", names = NAMES.join(", "))]
    Tests(usize),
    /// A curve that the config does not have.
    #[error("claim: unknown curve `{got}`{} (one of {known})", did_you_mean(.hint))]
    UnknownCurve {
        /// As written.
        got: String,
        /// The nearest label.
        hint: Option<String>,
        /// All labels.
        known: String,
    },
    /// An empty list of curves.
    #[error("claim: curves must name at least one (leave it out for all)")]
    NoCurves,
    /// A curve listed again.
    #[error("claim: curves names {0} twice (leave one out)")]
    Repeated(String),
    /// A curve against itself.
    #[error("claim: first and second must be different curves, got {0} for both")]
    Same(String),
    /// Growth along an axis that does not grow.
    #[error("claim: grows needs an axis of at least two numbers in ascending order (sort them)")]
    Axis,
    /// A gain in another unit than Δ.
    #[error("claim: gain needs the axis delta with values from 0 up, in ascending order")]
    GainAxis,
    /// An excess below α itself.
    #[error("claim: excess must be at least 1, got {0}")]
    Excess(f64),
    /// A power that is none.
    #[error("claim: power must lie strictly between 0 and 1, got {0}")]
    Power(f64),
    /// A range without ends.
    #[error("claim: quantity needs from, to or both")]
    NoEnds,
    /// A range that ends before it starts.
    #[error("claim: from = {from} lies above to = {to} (exchange them)")]
    Reversed {
        /// Its start.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// Curves where there are none.
    #[error(
        "claim: there are no curves here to test (write {{ quantity = {{ name = \"...\", from = 0.0 }} }})"
    )]
    NoSweep,
}
