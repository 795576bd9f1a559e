//! What a region is made for: the rule that fills it and the sign of Δ it looks for.

use std::fmt;

/// How a region is filled.
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
    /// C_W(0) … C_W(M₂); `None` never decides H₁.
    Table(Vec<Option<u64>>),
}

/// The sign of Δ that a region is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alternative {
    /// Δ > 0.
    Greater,
    /// Δ < 0.
    Less,
    /// Δ ≠ 0.
    TwoSided,
}

impl Alternative {
    /// What a rule compares with its critical value: W, its mirror image 2 E W − W, or |2W − 2E W|.
    #[inline]
    pub(super) fn score(self, rank_sum: u64, twice_mean: u64) -> u64 {
        match self {
            Self::Greater => rank_sum,
            Self::Less => twice_mean - rank_sum,
            Self::TwoSided => (2 * rank_sum).abs_diff(twice_mean),
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

impl fmt::Display for Rule {
    /// Its name, with the entries of a table: `table(291 291 never)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        if let Self::Table(entries) = self {
            let entry = |w: &Option<u64>| w.map_or("never".to_owned(), |w| w.to_string());
            let entries: Vec<String> = entries.iter().map(entry).collect();
            write!(f, "({})", entries.join(" "))?;
        }
        Ok(())
    }
}

impl fmt::Display for Alternative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Greater => "greater",
            Self::Less => "less",
            Self::TwoSided => "two-sided",
        })
    }
}
