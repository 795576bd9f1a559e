//! Several sides together.

use super::*;

/// P(no alarm of up or down in `blocks`), from the chain of both sums, and whether ever one alarmed with the other above 0.
fn both(threshold: i32, allowance: i32, blocks: usize) -> (f64, bool) {
    let law = Lattice::new(Score::Normal).law(Side::Up, |u| u);
    let size = threshold as usize;
    let (mut sums, mut met) = (vec![0.0; size * size], false);
    sums[0] = 1.0;
    for _ in 0..blocks {
        let mut after = vec![0.0; size * size];
        for (at, mass) in sums.iter().enumerate().filter(|(_, mass)| **mass > 0.0) {
            let (up, down) = ((at / size) as i32, (at % size) as i32);
            for score in -160i32..=160 {
                let [up, down] = [up + score, down - score].map(|sum| (sum - allowance).max(0));
                if up < threshold && down < threshold {
                    after[up as usize * size + down as usize] += mass * law.mass(score);
                } else {
                    met |= up.min(down) > 0;
                }
            }
        }
        sums = after;
    }
    (sums.iter().sum(), met)
}

/// Against the chain of both sums, h = 1 and k = 0.2, where sums are often both above 0: errors of rounding alone.
#[test]
fn up_and_down_agree_with_their_joint_chain() {
    let chart = Chart::new(Score::Normal, &[Side::Down, Side::Up], 0.2, 20).unwrap();
    let law = chart.run_length(40);
    for blocks in [0, 1, 2, 3, 9, 30] {
        let (exact, met) = both(40, 8, blocks);
        let survival = law.survival(blocks as u64);
        println!("{blocks} blocks: {survival}, joint chain {exact}");
        assert!((survival - exact).abs() < 1e-14 && !met);
    }
    let mean: f64 = (0..1000).map(|blocks| law.survival(blocks)).sum();
    assert!((law.promised() / mean - 1.0).abs() < 1e-11, "{mean}");
}

/// Another side's alarm never makes a side alarm more often, path by path; and the expected number of all alarms in n
/// blocks is at most what is promised.
#[test]
fn sides_keep_their_promise_together() {
    let sides = [Side::Up, Side::Down, Side::Scale];
    let (threshold, blocks, runs) = (80, 2000u32, 4000);
    let lattice = Lattice::new(Score::Normal);
    let mut alarms = Vec::new();
    let mut draws = stream("together").at(0);
    for _ in 0..runs {
        let mut alone = [Cusum::new(32, threshold); 3];
        let mut together = alone;
        let mut counts = [[0u32; 2]; 3];
        let mut all = 0.0;
        for _ in 0..blocks {
            let u = uniform(&mut draws);
            let scores = sides.map(|side| lattice.score(side.of(u)));
            let mut any = false;
            for (i, score) in scores.into_iter().enumerate() {
                if alone[i].step(score) {
                    alone[i].clear();
                    counts[i][0] += 1;
                }
                if together[i].step(score) {
                    any = true;
                    counts[i][1] += 1;
                }
            }
            if any {
                all += 1.0;
                together.iter_mut().for_each(Cusum::clear);
            }
            assert!(counts.iter().all(|[alone, together]| together <= alone));
        }
        alarms.push(all);
    }
    let promised = f64::from(blocks) / chart(&sides, 20).run_length(threshold).promised();
    let [mean, error] = mean(&alarms);
    println!(
        "{runs} runs of {blocks} blocks: {mean:.3} ± {error:.3} alarms, promised {promised:.3}"
    );
    assert!(mean < promised + FAR * error);
}

/// The same through ranks: with up, down and scale the first alarm is no earlier than the bound says, and of up and down
/// the mean is exact.
#[test]
fn first_alarms_of_detectors() {
    for sides in [
        &[Side::Up, Side::Down][..],
        &[Side::Up, Side::Down, Side::Scale],
    ] {
        let (chart, threshold) = (chart(sides, 20), 80);
        let law = chart.run_length(threshold);
        let mut draws = stream("detectors").at(0);
        let run = |_| {
            let mut detector = chart.detector(threshold);
            let mut monitored = 0.0;
            loop {
                let x = uniform(&mut draws);
                match detector.step(x, uniform(&mut draws)) {
                    Step::Reference => {}
                    Step::Quiet => monitored += 1.0,
                    Step::Alarm(_) => return monitored + 1.0,
                }
            }
        };
        let runs: Vec<f64> = (0..40_000).map(run).collect();
        if law.is_exact() {
            agrees("up and down", &runs, law.promised());
            continue;
        }
        let [mean, error] = mean(&runs);
        println!(
            "three sides: {mean:.2} ± {error:.2}, promised {:.2}",
            law.promised()
        );
        assert!(mean > law.promised() - FAR * error);
        for blocks in [5u32, 20, 60] {
            let longer = runs.iter().filter(|run| **run > f64::from(blocks)).count();
            let (share, bound) = (longer as f64 / 4e4, law.survival(blocks.into()));
            println!("  P(run > {blocks}) = {share:.4}, at least {bound:.4}");
            assert!(share > bound - FAR * 0.0025);
        }
    }
}
