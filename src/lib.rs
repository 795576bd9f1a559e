//! liftsim
#![forbid(unsafe_code)]
#![warn(missing_docs)]
pub mod binomial;
pub mod chain;
pub mod config;
pub mod detect;
pub mod figure;
pub mod gate;
pub mod plan;
pub mod results;
pub mod rng;
pub mod run;
pub mod signal;
pub mod tally;
pub mod whiten;
