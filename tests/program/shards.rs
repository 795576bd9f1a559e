//! Shards on many machines give one result.

use super::survival::{Bench, STUDIES, TINY};
use liftsim::counts::Counts;
use liftsim::results::{Checkpoint, Directory, Shard};
use liftsim::run;
use liftsim::study::Loaded;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::time::Instant;

fn shard(bench: &Bench, number: u64, count: u64, more: &[&str]) -> String {
    let out = format!("{number}-of-{count}");
    bench.sweep(
        &out,
        &[&["--shard", &format!("{number}/{count}")], more].concat(),
    );
    out
}

/// Any number of shards can be merged in any order; a shard leaves only its counts.
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

/// The same for every study that counts trials.
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

/// By default shards are below the experiment's directory, and `merge` and `status` find them.
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

/// Shards are checked one by one, since impossible counts of single shards might add up to possible ones.
#[test]
fn shards_that_cannot_be_are_refused() {
    let bench = Bench::new(TINY);
    let trials = ["--trials", "3000"];
    let (a, b) = (shard(&bench, 1, 2, &trials), shard(&bench, 2, 2, &trials));
    let state = Directory::new(bench.path(&a)).checkpoint().unwrap();
    let whole = serde_json::to_value(state.unwrap()).unwrap();
    let refused = |change: &dyn Fn(&mut Value), words: &[&str]| {
        let mut state = whole.clone();
        change(&mut state);
        let state: Checkpoint = serde_json::from_value(state).unwrap();
        std::fs::write(bench.path("1-of-2/counts.json"), state.to_json()).unwrap();
        for shards in [[&a, &b], [&b, &a]] {
            let (code, _, err) = bench.run(&["merge", shards[0], shards[1], "--out", "out"]);
            assert_eq!(code, 2, "{err}");
            assert!(words.iter().all(|word| err.contains(word)), "{err}");
            assert!(!bench.path("out").exists());
        }
    };
    let damaged = |member: &'static str, value: Value, words: &str| {
        let change = |state: &mut Value| state[member] = value.clone();
        refused(&change, &["1-of-2/counts.json: damaged", words]);
    };
    damaged("block", json!(512), "block: must be 1024, got 512");
    damaged("points", json!(7), "points: must be 9, got 7");
    damaged(
        "shard",
        json!("2/2"),
        "trials 0 to 1023 are of another shard",
    );
    damaged(
        "shard",
        json!("2/3"),
        "trials 0 to 1023 are of another shard",
    );
    let each = |state: &mut Value, change: &dyn Fn(&mut Value)| {
        let counters = state["counts"]["counters"].as_object_mut().unwrap();
        counters.values_mut().for_each(change);
    };
    let elsewhere = |counter: &mut Value| counter["trials"] = json!([[0, 1024], [2048, 2049]]);
    refused(
        &|state| each(state, &elsewhere),
        &[
            "1-of-2/counts.json: damaged",
            "trials 2048 to 2048 are of another shard",
        ],
    );
    // Fewer than the trials of both shards, more than those of one.
    let many = |counter: &mut Value| {
        let counts = counter["sums"]["counts"].as_array_mut().unwrap();
        counts.iter_mut().for_each(|count| *count = json!(1025));
    };
    refused(
        &|state| each(state, &many),
        &["1-of-2/counts.json: damaged", "1025 of something"],
    );
    let stranger = |state: &mut Value| {
        let counters = &mut state["counts"]["counters"];
        counters["0123456789abcdef01234567"] = json!({ "trials": [], "sums": { "counts": [0] } });
    };
    refused(
        &stranger,
        &["1-of-2/counts.json: damaged", "not of this experiment"],
    );
    let decision = |state: &mut Value| {
        let decisions = state["counts"]["decisions"].as_object_mut().unwrap();
        decisions
            .values_mut()
            .for_each(|decision| decision["size"] = json!(0.03125));
    };
    refused(
        &decision,
        &[
            "1-of-2",
            "2-of-2",
            "decides differently: size is",
            "0.03125",
        ],
    );
}

/// A shard reports correctly whether it has written its file.
#[test]
fn a_shard_says_whether_its_counts_are_new() {
    for text in [TINY, STUDIES[3]] {
        let bench = Bench::new(text);
        let says = |trials: &str, shard: &str, words: &str| {
            let arguments = [
                "sweep",
                "tiny.toml",
                "--trials",
                trials,
                "--shard",
                shard,
                "--out",
            ];
            let (code, out, err) = bench.run(&[&arguments[..], &["out"]].concat());
            assert_eq!(code, 0, "{err}");
            assert!(out.ends_with(&format!("counts.json  {words}\n")), "{out}");
        };
        says("24", "1/1", "written");
        says("24", "1/1", "unchanged");
        bench.write(&text.replace("question = \"", "question = \"Really? "));
        says("24", "1/1", "written");
        says("24", "1/1", "unchanged");
        // A shard without trials has a file too.
        std::fs::remove_file(bench.path("out/counts.json")).unwrap();
        says("1", "1/3", "written");
        says("1", "1/3", "unchanged");
    }
}

/// A finished shard takes changed words; one that lacks a pair is not finished; and a shard of fewer trials does
/// not replace one of more.
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

/// Missing trials are listed, and a sweep in the directory runs them.
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

/// Prints how many shards are checked and merged per second: those of Fig. 6, 156 points and 180 pairs each.
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
        let loaded = Loaded::again(&shards[0].checkpoint().unwrap().unwrap().origin).unwrap();
        let out = Directory::new(bench.path(&format!("{count}/all")));
        let start = Instant::now();
        let (session, absent) = run::merge(&*loaded.study, &loaded.origin, &shards, out).unwrap();
        let seconds = start.elapsed().as_secs_f64();
        println!("{count} shards: {:.0}/s", count as f64 / seconds);
        assert!(absent == run::Absent::default());
        for (key, counter) in all.counts.iter() {
            let sum = session.counts().get(key).unwrap();
            assert_eq!(sum.trials.len(), 1024 * count);
            assert_eq!(sum.sums.counts[0], count * counter.sums.counts[0]);
        }
    }
}
