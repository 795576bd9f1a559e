//! liftsim
#![forbid(unsafe_code)]
#![warn(missing_docs)]
pub mod binomial;
pub mod chain;
pub mod config;
pub mod detect;
pub mod rng;
pub mod signal;
pub mod tally;
pub mod whiten;
