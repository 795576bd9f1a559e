//! Exact tails, intervals and tests, independent of lifts.

pub mod binomial;
pub mod bisect;
pub mod chi_squared;
pub mod normal;
pub mod poisson;
pub mod quantile;
pub mod tally;
