//! Verdicts on claims.

use std::fmt;

/// The verdict on a claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The conclusion.
    pub verdict: Verdict,
    /// The numbers behind it, in words.
    pub evidence: String,
    /// The rule, in words.
    pub how: String,
}

/// The conclusion on a claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Shown everywhere.
    Holds,
    /// Refuted, but shown in a connected range of the axis, of each curve its own.
    HoldsWhere(String),
    /// Refuted.
    DoesNotHold,
    /// Neither shown nor refuted: the trials were too few.
    Undecided,
}

impl Verdict {
    /// The verdict without its places.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::HoldsWhere(_) => "holds where",
            Self::DoesNotHold => "does not hold",
            Self::Undecided => "undecided",
        }
    }

    /// The verdict on a claim that is refuted somewhere: it holds where it is shown, if that is one range for each of
    /// its curves.
    pub(super) fn where_shown(places: impl Iterator<Item = Option<String>>) -> Self {
        match places.collect::<Option<Vec<String>>>() {
            Some(places) => Self::HoldsWhere(places.join("; ")),
            None => Self::DoesNotHold,
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())?;
        match self {
            Self::HoldsWhere(places) => write!(f, " {places}"),
            _ => Ok(()),
        }
    }
}

/// Why a claim cannot be judged by these results.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum ClaimError {
    #[error("quantity `{name}`: not among the results, which have {known} (correct the name)")]
    NoQuantity { name: String, known: String },
    #[error("curve {0}: its points have not been compared for this claim (simulate again)")]
    NotCompared(String),
    #[error("curve {0}: no row at rest of its own (name the first curve that shares its rest)")]
    NoRest(String),
    #[error("curve {0}: no row for each value of the axis (let something move in it)")]
    NoRows(String),
}
