//! The thresholds, measured on white normal noise.

use super::noise::Noise;
use super::start::{LEARNING, REST, Start};
use super::table::{Point, Table};
use crate::detect::running::{Detector, Running, Tables, Told};
use crate::rng::Stream;
use crate::run::Progress;
use rayon::prelude::*;

/// What all trials know of the detectors.
#[derive(Debug)]
pub struct Pilot {
    tables: Tables,
    seed: u64,
    thresholds: Vec<(Detector, Option<String>, f64)>,
}

/// Records between reports of progress.
const STRETCH: usize = 256;

impl Pilot {
    /// Runs `table.pilot` records of the seed.
    pub fn run(table: &Table, seed: u64, progress: &dyn Progress) -> Self {
        let mut pilot = Self {
            tables: Tables::default(),
            seed,
            thresholds: Vec::new(),
        };
        let white = Noise::white();
        let kinds = kinds(table, &white);
        progress.begin("thresholds", table.pilot as u64, 1);
        let stretches = (0..table.pilot).step_by(STRETCH);
        let most: Vec<Vec<f64>> = stretches
            .collect::<Vec<_>>()
            .into_par_iter()
            .flat_map_iter(|first| {
                let records = first..table.pilot.min(first + STRETCH);
                progress.done(records.len() as u64);
                let each = records.map(|trial| pilot.most(&kinds, &white, trial as u64));
                each.collect::<Vec<_>>()
            })
            .collect();
        progress.end();
        let allowed = (table.share() * table.pilot as f64) as usize;
        pilot.thresholds = kinds
            .into_iter()
            .enumerate()
            .map(|(place, kind)| {
                let scores = most.iter().map(|record| record[place]).collect();
                let start = kind.start.as_ref().map(Start::subject);
                (kind.detector, start, smallest(scores, allowed))
            })
            .collect();
        pilot
    }

    /// The largest score of each detector in one record.
    fn most(&self, kinds: &[Point], white: &Noise, trial: u64) -> Vec<f64> {
        let mut draws = white.draws("detectors pilot", self.seed, trial);
        let record = white.record(LEARNING + REST, &mut draws);
        let each = kinds.iter().map(|kind| {
            let mut running = self.start(kind, "detectors pilot ties", self.seed, trial);
            running.largest(&record, LEARNING)
        });
        each.collect()
    }

    /// The detector of a point, at the beginning of a record.
    pub fn start(&self, point: &Point, purpose: &str, seed: u64, trial: u64) -> Running {
        let ties = Stream::new(seed, purpose, "").at(trial);
        let shape = point.start.as_ref().map(Start::blocks);
        let told = Told {
            ar: point.noise.ar.clone(),
            deviation: point.noise.deviation(),
            shape: shape.unwrap_or_default(),
        };
        point.detector.start(&self.tables, &told, ties)
    }

    /// Of the detector of a point.
    pub fn threshold(&self, point: &Point) -> f64 {
        let start = point.start.as_ref().map(Start::subject);
        let mut known = self.thresholds.iter();
        let here = |(detector, of, _): &&(Detector, Option<String>, f64)| {
            *detector == point.detector && (!detector.knows_start() || *of == start)
        };
        known.find(here).expect("every detector had its pilot").2
    }
}

/// Each detector once, the clairvoyant with each start.
fn kinds(table: &Table, noise: &Noise) -> Vec<Point> {
    let mut kinds: Vec<Point> = Vec::new();
    for (detector, start) in table.detectors() {
        if detector.knows_start() || kinds.iter().all(|kind| kind.detector != detector) {
            kinds.push(Point {
                detector,
                noise: noise.clone(),
                start: detector.knows_start().then(|| start.clone()),
                delta: 0.0,
            });
        }
    }
    kinds
}

/// The smallest threshold that no more than so many of the scores reach.
pub fn smallest(mut scores: Vec<f64>, allowed: usize) -> f64 {
    scores.sort_by(|a, b| b.total_cmp(a));
    let too_low = scores.get(allowed).copied().unwrap_or(f64::NEG_INFINITY);
    let above = scores.iter().take(allowed).rev();
    let mut above = above.filter(|score| **score > too_low);
    above.next().copied().unwrap_or(f64::INFINITY)
}
