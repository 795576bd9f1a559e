//! The three-sample detector of [^1]: samples X, Y₁, Y₂, statistics W and T, their exact laws under
//! H₀, and the decision regions ϑ, eqs (10)–(15).
//!
//! [^1]: see [`crate::signal`].

mod design;
mod law;
mod product;
mod region;
mod rule;
mod samples;
mod statistics;

pub use design::NullLaws;
pub use law::{NullLaw, NullLawError};
pub use region::{Region, RegionError};
pub use rule::{Alternative, Rule};
pub use samples::{Samples, SamplesError};
pub use statistics::{Pooled, Statistics};
