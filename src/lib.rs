//! Does the lift move, and how sure can we be, from an accelerometer alone?
//!
//! A mine cage that jams while the drum pays out rope is crushed by it, so the winder must know at
//! every moment whether the cage moves. Raifeld[^1] proposed to whiten the accelerometer's signal and
//! to compare three samples of it, from before, during and after the start, by two rank statistics
//! whose laws at rest do not depend on the law of the noise. This crate simulates that chain, knows
//! the laws exactly, and measures the power.
//!
//! # The flow
//! config → plan → pilots → trials (signal → whitened → samples → statistics → decision) → counts → results →
//! figures.
//!
//! ```
//! use liftsim::{experiment::SweepConfig, run::StudyError, study::{Study, Sweep}};
//!
//! let config = SweepConfig::parse("example", r#"
//!     question = "How does the power grow with Δ?"
//!     seed = 1
//!     trials = 2000
//!     [axis]
//!     delta = [0.0, 0.5, 1.0]
//! "#)?;
//! let sweep = Sweep::new(config)?;
//! let rows = sweep.rows(&sweep.counts(&())?);
//! assert!(rows[3].tally.rate() > rows[1].tally.rate());
//! # Ok::<(), StudyError>(())
//! ```
//!
//! # The house
//! Data flows up, imports go down; `tests/house.rs` holds the modules to their floors.
//!
//! | floor | modules |
//! |---|---|
//! | 0 | [`rng`]: coordinates → generator · [`stats`]: exact tails, intervals, tests · [`kalman`]: a mean and its covariance · [`counts`]: sums by what they count, and of which trials · [`mod@format`], [`suggest`], [`fields`], [`files`], [`npz`]: text and files · [`simd`]: trials side by side |
//! | 1, 2 | [`rule`], [`values`]: what a value must be · [`outbox`]: lines to a listener over a network |
//! | 3 | [`signal`]: sensor, noise, impulses, motion · [`recording`]: what real lifts recorded · [`whiten`]: filters · [`detect`]: W, T, their laws, regions · [`config`]: what a file says, with its places · [`claim`]: verdicts · [`plot`]: what a picture says |
//! | 4 | [`explain`]: what a record may hold |
//! | 5 | [`lift`]: simulated rides with their truth · [`monitor`]: one lift, sample by sample · [`scenario`]: what a point simulates, every parameter · [`report`]: the report |
//! | 6 | [`chain`]: one trial, every stage · [`detection`]: what a recording holds · [`experiment`]: what the author wrote |
//! | 7 | [`track`]: how far each trip went, and among which floors · [`schedule`]: blocks of trials in parallel |
//! | 8 | [`figure`]: PNG and SVG · [`plan`]: every point with its scenario and region |
//! | 9 | [`page`]: a recording, or the report, as one HTML page · [`pilot`]: decisions that no law gives · [`gate`]: the false-alarm test · [`results`]: files |
//! | 10 | [`run`]: what is wanted, what is there, what is missing |
//! | 11 | [`study`]: what a config's table describes |
//!
//! # A walk
//! This walk leads from `delta = [0.0, 0.5, 1.0]` under `[axis]` to a row of `points.csv`, file by file.
//! The way down:
//!
//! 1. `experiment/file.rs` has `config/tree.rs` read the text as a tree in which every value keeps its place, and
//!    finds the one table that names a study; `study/mod.rs` has the list of studies.
//! 2. `experiment/sweep.rs` reads this one: `experiment/overlay.rs` lays file, curve and axis value over each other.
//!    `scenario/parameters.rs` says that the axis' `delta` is `motion.delta`.
//! 3. `config/read.rs` lets serde read the result as `scenario/sections.rs`, whose types are the domain's;
//!    `scenario/check.rs` checks that the sections fit each other. A wrong value is refused here,
//!    at its place.
//! 4. `plan.rs` makes the point and its decision, and uses `schedule.rs` to group points that share noise.
//! 5. `study/sweep/targets.rs` names its counter, a hash of every parameter (`run/identity.rs`).
//!
//! The way up:
//!
//! 6. `run/session.rs` sees what the directory has (`run/existing.rs`); `pilot` finds the decisions that no law
//!    gives; `run/missing.rs` spreads the missing blocks of trials over the threads.
//! 7. In a block `study/sweep/trials.rs` has `schedule.rs` run trial after trial: `chain/trial.rs` takes noise from
//!    `chain/batch.rs`, adds Δ by `chain/motion.rs`, whitens and ranks, and each point decides.
//! 8. `study/sweep/tally.rs` counts the decisions, and `counts` adds the blocks up.
//! 9. `study/sweep/mod.rs` makes the row (`results/row.rs`, `delta` by the table of step 2); `results/directory.rs`
//!    writes it, and `study/sweep/picture.rs` makes of the rows a plot that `figure` draws.
//!
//! # Laws
//! - A trial cannot fail: every error occurs when the plan is made.
//! - A trial is determined by its coordinates: its draws are a function of the seed, of what is simulated
//!   and of its index, never of thread, batch, order or machine.
//! - Only integers are added across threads.
//! - Simulate once, decide many times: one noise realisation serves every point that can share it.
//!
//! # Glossary
//! | here | Raifeld | |
//! |---|---|---|
//! | `reference`, `shift`, `scale` | X, Y₁, Y₂; N, M₁, M₂ | the samples at rest, accelerating, in inertial motion |
//! | `delta` | Δ/σ_ξ | the acceleration, in deviations of the whitened noise |
//! | `nu`, `theta` | ν, θ/σ_ξ | probability and strength of vibration impulses |
//! | `training`, `order` | , m | of the whitening filter |
//! | `rank_sum`, `exceedances` | W, T | the two statistics; with `shift_exceedances` T′, of all of the motion |
//! | `size`, `false_alarm` | α | exact probability of deciding H₁ at rest; an event of that kind |
//! | power | D | probability of deciding H₁ in motion |
//!
//! # Where [^1] is read one way among several
//! - Δ and θ are raw, in the record, in units of σ_ξ after whitening; `delta_at = "whitened"` reads Δ
//!   after whitening instead, a factor of 1 − β = 3.287 for the ADXL105.
//! - (9) prints λ_i + Σ a_p λ_{i−p}. With the convention of (3) the sign is a minus, in agreement with the
//!   term Δ(1 − β) of (9).
//! - The numerator of (2) lacks the factors 1/a and T₀. It only scales the signal.
//! - The region ϑ is not given; every rule here is one choice, see [`detect`].
//!
//! [^1]: M. A. Raifeld, "Distinguishing the motion/stop states of a lift from accelerometer
//!     signals", Avtometriya (in Russian), received 25 November 2013.

#![deny(unsafe_code)]
#![warn(missing_docs)]
// Tests compare with the C library's.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod chain;
pub mod claim;
pub mod config;
pub mod counts;
pub mod detect;
pub mod detection;
pub mod experiment;
pub mod explain;
pub mod fields;
pub mod figure;
pub mod files;
pub mod format;
pub mod gate;
pub mod kalman;
pub mod lift;
pub mod monitor;
pub mod npz;
pub mod outbox;
pub mod page;
pub mod pilot;
pub mod plan;
pub mod plot;
pub mod recording;
pub mod report;
pub mod results;
pub mod rng;
pub mod rule;
pub mod run;
pub mod scenario;
pub mod schedule;
mod series;
pub mod signal;
pub mod simd;
pub mod stats;
pub mod study;
pub mod suggest;
pub mod track;
pub mod values;
pub mod vector;
pub mod whiten;
