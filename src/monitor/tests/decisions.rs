//! Decisions, and what they are made from.

use super::*;
use crate::detect::sequential::{Chart, Score, Side};

/// W and T of every decision against a recount from the record at the stated times: means of five, no
/// filter, ranks by sorting.
#[test]
fn decisions_are_those_of_a_recount() {
    let mut settings = Settings::default();
    settings.detector.rule = DecisionRule::ThreeSample;
    settings.whitening.order = Order::Fixed(0);
    let record = Record::quiet()
        .rest(8.0)
        .trip(1.0)
        .rest(7.0)
        .trip(-1.0)
        .rest(5.0);
    let mut monitor = Monitor::new(
        settings.at(RATE).unwrap(),
        Knowledge {
            begins_at_rest: true,
            ..Knowledge::default()
        },
    );
    let blocks: Vec<f64> = record
        .samples
        .chunks_exact(5)
        .map(|c| c.iter().sum::<f64>() / 5.0)
        .collect();
    let at = |(from, to): (f64, f64)| {
        blocks[(from * 20.0).round() as usize..(to * 20.0).ceil() as usize].to_vec()
    };
    let events = record.watch(&mut monitor);
    let mut counted = 0;
    for event in events {
        let Kind::Change {
            decision: Some(Decided::ThreeSample(decision)),
            ..
        } = event.kind
        else {
            continue;
        };
        let x = at(decision.reference.unwrap());
        let [y1, y2] = [decision.shift, decision.scale].map(at);
        // X is the end of the record that the reference was learnt from.
        let x = x[x.len() - 24..].to_vec();
        assert_eq!([x.len(), y1.len(), y2.len()], [24, 12, 12]);
        let others = || x.iter().chain(&y2);
        let won = y1
            .iter()
            .map(|y| others().filter(|other| y > other).count() as u64);
        let [low, high] = [f64::min, f64::max].map(|f| x.iter().copied().reduce(f).unwrap());
        let naive = Statistics {
            rank_sum: 78 + won.sum::<u64>(),
            exceedances: y2.iter().filter(|y| **y < low || **y > high).count(),
            shift_exceedances: y1.iter().filter(|y| **y < low || **y > high).count(),
        };
        let statistics = (decision.rank_sum, decision.exceedances);
        let expected = (naive.rank_sum, naive.exceedances);
        assert_eq!(statistics, expected, "{event:?}");
        let Decision { lower, upper, .. } = decision;
        let moves = lower.is_some_and(|w| naive.rank_sum <= w)
            || upper.is_some_and(|w| naive.rank_sum >= w);
        assert!(moves, "{decision:?}");
        counted += 1;
    }
    assert_eq!(counted, 4);
}

/// Monitors on white noise, each of them with X and a filter of order 0 from the noise before, and `after` blocks since:
/// in how many of `trials` one of the last `counted` decisions was H₁*.
fn alarmed(design: &Design, trials: u64, after: usize, counted: usize) -> u64 {
    let normal = crate::signal::Noise::default();
    let stream = Stream::new(2014, "monitor size", "");
    let mut blocks = vec![0.0; 48 + after];
    let mut alarms = 0;
    for trial in 0..trials {
        normal.fill(&mut stream.at(trial), &mut blocks);
        let reference = Reference::from_rest(&blocks[..48], (0.0, 0.0), design);
        let knowledge = Knowledge {
            reference: Some(reference),
            ..Knowledge::default()
        };
        let mut monitor = Monitor::new(design.clone(), knowledge);
        let decided = blocks[48..].iter().enumerate().map(|(i, acceleration)| {
            let sample = Sample {
                time: i as f64 * 0.05,
                acceleration: *acceleration,
            };
            monitor.step(sample, None);
            monitor.newest().unwrap().moves
        });
        let decided: Vec<Option<bool>> = decided.collect();
        alarms += u64::from(decided[after - counted..].contains(&Some(true)));
    }
    alarms
}

/// The smaller tail of the alarms of 40 000 monitors is not below 5e-7: a two-sided test at 1e-6.
fn assert_probability(alarms: u64, p: f64) {
    let tail = binomial::lower_tail(alarms, 40_000, p).min(binomial::upper_tail(alarms, 40_000, p));
    println!("{alarms} of 40000 at exact probability {p}: smaller tail {tail:.3e}");
    assert!(tail > 5e-7);
}

fn white(rule: DecisionRule) -> Design {
    let mut settings = Settings::default();
    settings.whitening.order = Order::Fixed(0);
    settings.detector = Level { rule, alpha: 0.01 };
    settings.at(20.0).unwrap()
}

#[test]
fn a_decision_at_rest_has_its_exact_size() {
    let design = white(DecisionRule::ThreeSample);
    assert_probability(alarmed(&design, 40_000, 24, 1), design.region.size());
}

/// Whatever few blocks they begin with.
#[test]
fn ranks_alarm_at_rest_with_the_exact_probability() {
    let design = white(DecisionRule::Sequential);
    let chart = Chart::new(Score::Normal, &[Side::Up, Side::Down], 0.8, 96).unwrap();
    let law = chart.run_length(chart.threshold(100.0).unwrap());
    assert_probability(alarmed(&design, 40_000, 60, 60), 1.0 - law.survival(60));
}

/// However long the rest is that a reference is learnt from, ranks see a start after it.
#[test]
fn ranks_see_a_start_after_a_long_training() {
    for training in [24, 4080, 5000] {
        let mut settings = Settings::default();
        settings.whitening.training = training;
        let knowledge = Knowledge {
            begins_at_rest: true,
            ..Knowledge::default()
        };
        let mut monitor = Monitor::new(settings.at(RATE).unwrap(), knowledge);
        let record = Record::quiet().rest(270.0).trip(1.0).rest(7.0);
        let told = states(&record.watch(&mut monitor));
        let starts = told.iter().filter(|state| state.moves()).count();
        assert!(starts > 0, "{training}: {told:?}");
    }
}

/// A start is decided by an alarm of its side that comes after it, and there is none before.
#[test]
fn a_start_is_decided_by_ranks() {
    for sign in [1.0, -1.0] {
        let record = Record::quiet().rest(8.0).trip(sign).rest(7.0);
        let events = record.watch(&mut standing());
        let decided = events.iter().find_map(|event| match event.kind {
            Kind::Change {
                decision: Some(Decided::Sequential(decision)),
                ..
            } => Some(decision),
            _ => None,
        });
        let RankDecision {
            alarmed,
            side,
            reference,
            ..
        } = decided.unwrap();
        assert!((8.0..10.3).contains(&alarmed), "{alarmed}");
        assert_eq!(side, Direction::of(sign));
        assert!(reference.unwrap().1 <= 8.0);
    }
}

/// The reference follows an offset that drifts by three times the weakest acceleration, 0.09 m/s² a minute.
#[test]
fn every_rest_is_learnt_anew() {
    let mut record = Record::quiet();
    for step in 0..2000 {
        record = record.with(0.1, 0.3 * f64::from(step) / 2000.0, 1.0);
    }
    let mut monitor = standing();
    let events = record.watch(&mut monitor);
    assert_eq!(states(&events), [REST]);
    let reference = monitor.reference().unwrap();
    assert!(reference.span.unwrap().1 > record.now() - 12.0);
    assert!((reference.level - 0.3).abs() < 0.05, "{}", reference.level);
}

#[test]
fn a_saved_state_is_read_back_unchanged() {
    let mut monitor = standing();
    Record::quiet().rest(12.0).watch(&mut monitor);
    let saved = SavedState {
        settings: Settings::default(),
        rate: RATE,
        first_sample: None,
        running: None,
        knowledge: Knowledge {
            reference: monitor.reference().cloned(),
            begins_at_rest: true,
            motion_shows: false,
        },
    };
    let read: SavedState = serde_json::from_str(&saved.to_json()).unwrap();
    assert_eq!(read, saved);
}

/// Equal values have no ranks of their own, so random keys decide: decisions for motion are no more frequent
/// than the exact size, and W stays within its range.
#[test]
fn a_constant_record_is_decided_by_keys() {
    let mut settings = Settings::default();
    settings.detector.rule = DecisionRule::ThreeSample;
    let design = settings.at(RATE).unwrap();
    let reference = Reference::from_rest(&[9.81; 48], (0.0, 0.0), &design);
    let mut monitor = Monitor::new(
        design,
        Knowledge {
            reference: Some(reference),
            begins_at_rest: true,
            motion_shows: false,
        },
    );
    let (mut moves, mut decisions) = (0u64, 0u64);
    for i in 0..200_000 {
        let sample = Sample {
            time: f64::from(i) / RATE,
            acceleration: 9.81,
        };
        monitor.step(sample, None);
        if let Some(moved) = monitor.newest().and_then(|block| block.moves) {
            (moves, decisions) = (moves + u64::from(moved), decisions + 1);
        }
    }
    // New keys are drawn at every block, so that these decisions are independent.
    let tail = binomial::upper_tail(moves, decisions, monitor.design().region.size());
    println!("{moves} of {decisions}, upper tail {tail:.2e}");
    assert!(tail > 1e-6);
}
