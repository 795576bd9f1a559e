//! Studies: what a config's table describes, one file and one line in the registry each.
//!
//! A study comes to rows of its own (`points.csv`), from which its picture is drawn, and where it has any to
//! single numbers (`quantities.csv`). What it counts in trials goes through [`run`](crate::run); what it computes
//! is a function of the config alone.

mod any;
pub(crate) mod autocorrelation;
pub(crate) mod impulse_law;
pub(crate) mod independence;
mod kind;
pub(crate) mod layout;
mod loaded;
pub(crate) mod operating_point;
pub mod reference;
pub(crate) mod region;
mod registry;
pub mod ride;
mod rules;
mod sweep;
pub(crate) mod trace;

pub use any::{DrawError, Output};
pub use kind::{Context, Study, Table, TooMany};
pub use loaded::Loaded;
pub use registry::{Entry, STUDIES, load, parse};

/// The plane of W and T, for `threshold`.
pub mod plane {
    pub use super::region::boundary;
    pub use super::region::picture::{plot, title};
}

#[cfg(test)]
mod tests_of_pictures;

#[cfg(test)]
mod tests {
    use super::kind::{Context, Study};
    use super::parse;
    use crate::run::whole;

    /// The study of a config.
    pub fn read<S: Study>(text: &str) -> S {
        let experiment = parse("test", text).unwrap_or_else(|error| panic!("{error}"));
        let context = Context::of(&experiment, S::COUNTS_TRIALS);
        S::read(&experiment, context).unwrap_or_else(|error| panic!("{error}"))
    }

    /// What a study comes to.
    pub fn rows<S: Study>(study: &S, trials: u64) -> Vec<S::Row> {
        let counts = study.trials().map(|all| whole(all, trials));
        study.rows(&counts.unwrap_or_default())
    }
}
