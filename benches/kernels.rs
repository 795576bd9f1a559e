//! Where the time of a trial goes, kernel by kernel, at the sizes of Fig. 6.
//!
//! `cargo bench` prints each; the goals are for one core of a recent x86-64 machine.

use criterion::{Criterion, criterion_group, criterion_main};
use liftsim::config::Config;
use liftsim::detect::{Alternative, NullLaws, Pooled, Rule, Samples};
use liftsim::pilot::Pilots;
use liftsim::plan::Plan;
use liftsim::rng::Stream;
use liftsim::run;
use liftsim::signal::{Law, Noise, Sensor};
use liftsim::whiten::{Fit, Fitter, Whitening, whiten};
use std::hint::black_box;

const RECORD: usize = 72 + 256 + 36;

fn kernels(criterion: &mut Criterion) {
    let mut generator = Stream::new(1, "noise", "bench").at(0);
    let noise = Noise::new(Law::Normal).expect("a law");
    let sensor = Sensor::adxl105();
    let mut record = vec![0.0; RECORD];

    // Goal: 4 ns a sample.
    criterion.bench_function("364 normals", |b| {
        b.iter(|| noise.fill(&mut generator, black_box(&mut record)))
    });

    // Goal: 600 ns; the recursion waits for its own last value.
    let white = record.clone();
    criterion.bench_function("colour 364", |b| {
        b.iter(|| {
            record.copy_from_slice(&white);
            sensor.colour(black_box(&mut record));
        });
    });

    // Goal: 300 ns.
    let whitening = Whitening::new(2, Fit::LeastSquares, 256, false, 2).expect("a filter");
    let mut fitter = Fitter::new(whitening, &[]);
    criterion.bench_function("fit order 2 on 256", |b| {
        b.iter(|| black_box(fitter.fit(black_box(&record[72..328]))[0]));
    });

    // Goal: 50 ns.
    let mut whitened = vec![0.0; 36];
    criterion.bench_function("whiten 36", |b| {
        b.iter(|| {
            whiten(
                sensor.ar(),
                black_box(&record),
                328,
                black_box(&mut whitened),
            )
        });
    });

    // Goal: 100 ns.
    let pooled = Pooled {
        reference: &whitened[..12],
        shift: &whitened[12..24],
        scale: &whitened[24..],
    };
    criterion.bench_function("W and T at 12/12/12", |b| {
        b.iter(|| black_box(pooled).statistics(|| unreachable!("no ties")));
    });
}

/// Goal: 200 ns a trial and point, all of Fig. 6 in one family.
fn family(criterion: &mut Criterion) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/configs/fig6.toml");
    let config = Config::load(path.as_ref()).expect("a config");
    let plan = Plan::new(&config).expect("a plan");
    let decisions = Pilots::new(&plan).and_then(|pilots| pilots.decide(|_| {}));
    let decisions = decisions.expect("exact regions");
    let mut short = plan.clone();
    short.ensemble.trials = 64;
    criterion.bench_function("64 trials of Fig. 6, 156 points", |b| {
        b.iter(|| run::run(black_box(&short), &decisions, &[], |_| {}));
    });
}

/// Goal: 1 s at 200/200/200.
fn design(criterion: &mut Criterion) {
    let samples = Samples::contiguous(200, 200, 200).expect("sizes");
    let mut group = criterion.benchmark_group("region");
    group.sample_size(10);
    group.bench_function("product at 200/200/200", |b| {
        b.iter(|| {
            NullLaws::new(Alternative::Greater, black_box(&samples))
                .map(|laws| laws.region(&Rule::Product, 0.01))
        });
    });
    group.finish();
}

criterion_group!(benches, kernels, family, design);
criterion_main!(benches);
