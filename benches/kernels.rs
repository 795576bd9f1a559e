//! Where the time of a trial goes, kernel by kernel, at the sizes of Fig. 6.
//!
//! `cargo bench` prints each; the goals are for one core of a recent x86-64 machine.

use criterion::{Criterion, criterion_group, criterion_main};
use liftsim::detect::{
    Alternative, Crossings, Exceedances, Lines, NullLaws, Pooled, Rule, Samples,
};
use liftsim::experiment::SweepConfig;
use liftsim::lift::{Drive, Ending, Pickup, Ride, Trip};
use liftsim::monitor::{Knowledge, Monitor, Settings};
use liftsim::recording::Sample;
use liftsim::rng::Stream;
use liftsim::signal::{Law, Noise, Sensor};
use liftsim::simd::{LANES, Vectors, Wide};
use liftsim::study::{Study, Sweep};
use liftsim::whiten::{Fit, Fitter, Whitening};
use std::hint::black_box;

const TRAINING: usize = 256;
const RECORD: usize = TRAINING + 36;

/// Eight trials side by side; divide by eight.
fn wide(criterion: &mut Criterion) {
    let mut generator = Stream::new(1, "noise", "bench").at(0);
    let noise = Noise::new(Law::Normal).expect("a law");
    let sensor = Sensor::adxl105();
    let mut record = vec![Wide::<LANES>::default(); RECORD];

    // Goal: 3 ns a normal, 7 us.
    criterion.bench_function("8 x 292 normals", |b| {
        b.iter(|| noise.fill(&mut generator, black_box(&mut record)))
    });

    // Goal: 800 ns; the recursion waits for its own last value.
    let white = record.clone();
    criterion.bench_function("colour 8 x 292", |b| {
        b.iter(|| {
            record.copy_from_slice(&white);
            Vectors::widest().run(
                #[inline(always)]
                || sensor.colour_stationary(black_box(&mut record)),
            );
        });
    });

    // Goal: 800 ns.
    let whitening = Whitening::new(2, Fit::LeastSquares, TRAINING, false, 2).expect("a filter");
    let mut fitter = Fitter::new(whitening, &[]);
    criterion.bench_function("fit order 2 on 8 x 256", |b| {
        b.iter(|| {
            Vectors::widest().run(
                #[inline(always)]
                || black_box(fitter.fit(black_box(&record[..TRAINING])))[0],
            )
        });
    });
}

/// One trial.
fn narrow(criterion: &mut Criterion) {
    let mut samples = [0.0; 36];
    let mut generator = Stream::new(1, "noise", "bench").at(1);
    Noise::new(Law::Normal)
        .expect("a law")
        .fill(&mut generator, &mut samples);

    // Goal: 100 ns.
    let pooled = Pooled {
        reference: &samples[..12],
        shift: &samples[12..24],
        scale: &samples[24..],
    };
    criterion.bench_function("W and T at 12/12/12", |b| {
        b.iter(|| black_box(pooled).statistics(|| unreachable!("no ties")));
    });

    // Goal: 600 ns at 31 values of delta, 900 ns at 301.
    let mut step = [3.287; 12];
    step[..2].copy_from_slice(&[1.0, 2.5365]);
    let mut after = [0.0; 12];
    after[..2].copy_from_slice(&[2.287, 0.751]);
    for points in [31, 301] {
        let deltas = (0..points).map(|i| 3.0 * f64::from(i) / f64::from(points - 1));
        let mut crossings = Crossings::new(Vectors::widest(), deltas.collect(), false);
        let lines = |base, slope| Lines { base, slope };
        criterion.bench_function(&format!("crossings along {points} values"), |b| {
            b.iter(|| {
                let (shift, scale) = (lines(pooled.shift, &step), lines(pooled.scale, &after));
                black_box(crossings.count(black_box(pooled.reference), shift, scale)).is_some()
            });
        });
    }
}

/// Goal: 40 ns a trial and point, all of Fig. 6 in one family.
fn family(criterion: &mut Criterion) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/configs/fig6.toml");
    let mut config = SweepConfig::load(path.as_ref()).expect("a config");
    config.narrative.claims.clear();
    let sweep = Sweep::new(config).expect("a plan");
    let mut trials = sweep.trials().expect("a sweep counts trials");
    let all: Vec<usize> = (0..trials.targets().len()).collect();
    trials.prepare(&all, &()).expect("exact regions");
    let groups = trials.groups(&all);
    criterion.bench_function("64 trials of Fig. 6, 156 points", |b| {
        b.iter(|| (groups[0].run)(black_box(0..64)));
    });
}

/// Goal: 1 s at 200/200/200.
fn design(criterion: &mut Criterion) {
    let samples = Samples::contiguous(200, 200, 200).expect("sizes");
    let mut group = criterion.benchmark_group("region");
    group.sample_size(10);
    group.bench_function("product at 200/200/200", |b| {
        b.iter(|| {
            NullLaws::new(
                Exceedances::Scale,
                Alternative::Greater,
                black_box(&samples),
            )
            .map(|laws| laws.region(&Rule::Product, 0.01))
        });
    });
    group.finish();
}

/// Goal: 5 million samples a second, 200 us for ten seconds at 100 Hz.
fn monitor(criterion: &mut Criterion) {
    let design = Settings::default().at(100.0).expect("settings");
    let knowledge = Knowledge {
        begins_at_rest: true,
        ..Knowledge::default()
    };
    let mut monitor = Monitor::new(design, knowledge);
    let trip = |distance| Trip {
        distance,
        drive: Drive::slow(),
        ending: Ending::Commanded,
    };
    let ride = Ride::new(100.0, vec![10.0; 3], vec![trip(8.0), trip(-8.0)]).expect("a ride");
    let record = ride.simulate(&Pickup::white(0.012), 1, 0).record;
    let samples = record.iter().cycle();
    let mut samples = (0u32..).zip(samples).map(|(i, &acceleration)| Sample {
        time: f64::from(i) / 100.0,
        acceleration,
    });
    criterion.bench_function("a monitor, 1000 samples of rides", |b| {
        b.iter(|| {
            for sample in samples.by_ref().take(1000) {
                black_box(monitor.step(black_box(sample), None));
            }
        });
    });
}

criterion_group!(benches, wide, narrow, family, design, monitor);
criterion_main!(benches);
