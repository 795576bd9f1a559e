//! The three-sample detector of [^1]: samples X, Y₁, Y₂, statistics W and T, their exact laws under
//! H₀, and the decision regions ϑ, eqs (10)–(15).
//!
//! [^1]: see [`crate::signal`].

mod law;
mod region;
mod samples;
mod statistics;

pub use law::{Law, LawError};
pub use region::{Alternative, NullLaws, Region, RegionError, Rule};
pub use samples::{Samples, SamplesError};
pub use statistics::{Pooled, Statistics};
