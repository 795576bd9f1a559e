//! Many machines, one result.

use super::survival::{Bench, STUDIES, TINY};
use liftsim::counts::Counts;
use liftsim::results::{Directory, Shard};
use liftsim::run;
use std::path::PathBuf;

fn shard(bench: &Bench, number: u64, count: u64, more: &[&str]) -> String {
    let out = format!("{number}-of-{count}");
    bench.sweep(
        &out,
        &[&["--shard", &format!("{number}/{count}")], more].concat(),
    );
    out
}

/// In any number, joined in any order; a shard leaves its counts and nothing else.
#[test]
fn shards_merge_to_the_same_bytes() {
    let bench = Bench::new(TINY);
    bench.sweep("whole", &[]);
    for count in [1, 3, 50] {
        let mut shards: Vec<String> = (1..=count)
            .map(|number| shard(&bench, number, count, &[]))
            .collect();
        assert_eq!(
            bench.names(&shards[0]).into_iter().collect::<Vec<_>>(),
            ["counts.json"]
        );
        shards.rotate_left(count as usize / 2);
        let mut arguments = vec!["merge", "--out", "merged"];
        arguments.extend(shards.iter().map(String::as_str));
        let (code, _, err) = bench.run(&arguments);
        assert_eq!((code, err.as_str()), (0, ""));
        assert!(
            bench.files("merged") == bench.files("whole"),
            "{count} shards"
        );
        assert_eq!(bench.names("merged"), bench.names("whole"));
    }
}

/// The same of every study that counts trials.
#[test]
fn shards_of_studies_merge_to_the_same_bytes() {
    for study in STUDIES {
        let bench = Bench::new(study);
        bench.sweep("whole", &[]);
        let shards: Vec<String> = (1..=3)
            .map(|number| shard(&bench, number, 3, &[]))
            .collect();
        let status = bench.run(&["status", &shards[1]]).1;
        assert!(
            status.contains("2/3") && status.contains("finished"),
            "{status}"
        );
        let [a, b, c] = [&shards[0], &shards[1], &shards[2]];
        let (code, out, _) = bench.run(&["merge", b, c, "--out", "merged"]);
        assert_eq!(code, 0);
        assert!(out.contains("no directory of shard 1/3"), "{out}");
        let (code, _, err) = bench.run(&["merge", c, a, b, "--out", "merged"]);
        assert_eq!((code, err.as_str()), (0, ""));
        assert!(bench.files("merged") == bench.files("whole"), "{study}");
        assert_eq!(bench.names("merged"), bench.names("whole"));
        assert_eq!(bench.sweep("merged", &[]), 0, "all is there");
    }
}

/// By default shards lie below the experiment's place, and `merge` and `status` find theirs.
#[test]
fn shards_have_their_places() {
    let bench = Bench::new(TINY);
    for shard in ["1/2", "2/2"] {
        let (code, ..) = bench.run(&["sweep", "tiny.toml", "--trials", "3000", "--shard", shard]);
        assert_eq!(code, 0);
    }
    let shards = ["results/tiny/shards/1-of-2", "results/tiny/shards/2-of-2"];
    let (code, out, _) = bench.run(&["status", "results/tiny"]);
    assert_eq!(code, 0);
    assert_eq!(out.matches("finished").count(), 2, "{out}");
    assert!(
        out.contains("2/2") && out.contains("1976") && out.contains("tiny.toml"),
        "{out}"
    );
    assert_eq!(bench.run(&["merge", shards[0], shards[1]]).0, 0);
    bench.sweep("own", &["--trials", "3000"]);
    assert!(bench.files("results/tiny") == bench.files("own"));
}

#[test]
fn shards_that_do_not_go_together_are_named() {
    let bench = Bench::new(TINY);
    let trials = ["--trials", "3000"];
    let (a, b) = (shard(&bench, 1, 2, &trials), shard(&bench, 2, 3, &trials));
    let refused = |directories: &[&str], words: &[&str]| {
        let (code, _, err) = bench.run(&[&["merge", "--out", "out"], directories].concat());
        assert_eq!(code, 2, "{err}");
        assert!(words.iter().all(|word| err.contains(word)), "{err}");
        assert!(!bench.path("out").exists());
    };
    refused(&[&a, &a], &["1-of-2 and 1-of-2", "counted twice"]);
    bench.sweep("all", &[&trials[..], &["--shard", "1/1"]].concat());
    refused(
        &[&a, "all"],
        &["1-of-2 and all", "trials 0 to 1023 are counted twice"],
    );
    refused(&[&b, &a, "all"], &["counted twice"]);
    bench.sweep(
        "seed",
        &["--trials", "3000", "--seed", "3", "--shard", "2/2"],
    );
    refused(&[&a, "seed"], &["1-of-2 and seed", "seed is 11 and 3"]);
    bench.sweep("more", &["--trials", "4000", "--shard", "2/2"]);
    refused(
        &[&a, "more"],
        &["1-of-2 and more", "trials is 3000 and 4000"],
    );
    bench.write(&TINY.replace("1.0]", "1.5]"));
    bench.sweep("other", &["--trials", "3000", "--shard", "2/2"]);
    refused(
        &[&a, "other"],
        &[
            "1-of-2 and other",
            "delta = [0.5, 1.0]",
            "delta = [0.5, 1.5]",
        ],
    );
    refused(&[&a, "nowhere"], &["nowhere", "no counts.json"]);
}

/// A finished shard learns new words; one that lacks a pair is not finished; and few counts are not put in the
/// place of many.
#[test]
fn shards_follow_their_config() {
    let bench = Bench::new(TINY);
    let trials = ["--trials", "3000"];
    let (a, b) = (shard(&bench, 1, 2, &trials), shard(&bench, 2, 2, &trials));
    bench.write(&TINY.replace("Does it survive?", "Does it?"));
    assert_eq!(bench.run(&["merge", &a, &b, "--out", "out"]).0, 0);
    shard(&bench, 1, 2, &trials);
    assert_eq!(bench.run(&["merge", &a, &b, "--out", "mixed"]).0, 2);
    shard(&bench, 2, 2, &trials);
    assert_eq!(bench.run(&["merge", &a, &b, "--out", "new"]).0, 0);

    let (code, _, err) = bench.run(&["merge", &a, "--out", "new"]);
    assert_eq!(code, 2, "{err}");
    assert!(bench.path("new/points.csv").exists() && !bench.path("new/counts.json").exists());
}

/// Trials that nobody has are named, and a sweep there does them.
#[test]
fn missing_shards_are_named() {
    let bench = Bench::new(TINY);
    let trials = ["--trials", "5000"];
    let (a, b) = (shard(&bench, 1, 4, &trials), shard(&bench, 3, 4, &trials));
    let (code, out, _) = bench.run(&["merge", &b, &a, "--out", "out"]);
    assert_eq!(code, 0);
    assert!(out.contains("no directory of shard 2/4, 4/4"), "{out}");
    assert_eq!(
        bench.names("out").into_iter().collect::<Vec<_>>(),
        ["counts.json"]
    );
    bench.sweep("whole", &trials);
    assert_eq!(bench.sweep("out", &trials), 6 * (5000 - 2 * 1024));
    assert!(bench.files("out") == bench.files("whole"));
}

/// Prints how many shards are joined in a second: those of Fig. 6, 156 points and 180 pairs each.
#[test]
fn merge_is_linear() {
    let bench = Bench::new(&std::fs::read_to_string("configs/fig6.toml").unwrap());
    bench.sweep("all", &["--trials", "1024", "--shard", "1/1"]);
    let all = Directory::new(bench.path("all"))
        .checkpoint()
        .unwrap()
        .unwrap();
    for count in [500u64, 1000] {
        let shards: Vec<Directory> = (1..=count)
            .map(|number| {
                let mut part = all.clone();
                part.origin.trials = 1024 * count;
                part.shard = Some(Shard { number, count });
                part.counts = Counts::default();
                for (key, counter) in all.counts.iter() {
                    let trials = part.wanted();
                    part.counts.add(key, trials, &counter.sums).unwrap();
                }
                let path: PathBuf = bench.path(&format!("{count}/{number}"));
                std::fs::create_dir_all(&path).unwrap();
                std::fs::write(path.join("counts.json"), part.to_json()).unwrap();
                Directory::new(path)
            })
            .collect();
        let joined = run::join(&shards).unwrap();
        assert!(joined.absent == run::Absent::default());
        for (key, counter) in all.counts.iter() {
            let sum = joined.state.counts.get(key).unwrap();
            assert_eq!(sum.trials.len(), 1024 * count);
            assert_eq!(sum.sums.counts[0], count * counter.sums.counts[0]);
        }
    }
}
