//! The three-sample detector of [^1]: samples X, Y₁, Y₂, statistics W and T, their exact laws under
//! H₀, and the decision regions ϑ, eqs (10)–(15). Rules may count T′, the exceedances of all of the motion, in place
//! of T; the joint law of W and T′ is counted too.
//!
//! [^1]: see [`crate::signal`].

mod baseline;
mod clairvoyant;
mod crossings;
mod design;
mod joint;
mod law;
mod likelihood;
mod product;
mod region;
mod rule;
pub mod running;
mod samples;
pub mod sequential;
mod statistics;

pub use baseline::{block_means, student_t, variance_ratio};
pub use clairvoyant::{Clairvoyant, Forward};
pub use crossings::{Along, Crossings, Lines};
pub use design::NullLaws;
pub use law::{NullLaw, NullLawError};
pub use likelihood::{Histogram, LikelihoodOrder};
pub use region::{Bounds, Region, RegionError};
pub use rule::{Alternative, Baseline, Exceedances, Method, Rule, Ties};
pub use samples::Samples;
pub use statistics::{Pooled, Statistics};
