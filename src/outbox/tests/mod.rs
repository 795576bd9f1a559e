//! Spools that are opened again, cut, damaged, full, and on a full disk.

use super::spool::{Saved, Spool};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

const MOST: u64 = 4096;

fn folder() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lift.spool");
    (folder, path)
}

fn open(path: &Path) -> Spool {
    Spool::open(path, MOST).unwrap().0
}

fn refusal(path: &Path) -> String {
    Spool::open(path, MOST).unwrap_err().to_string()
}

fn line(number: u64) -> String {
    format!("{{\"time\":{number}}}")
}

/// Adds these lines, without anything to tell.
fn push(spool: &mut Spool, numbers: impl IntoIterator<Item = u64>) {
    for number in numbers {
        let Saved { dropped, news } = spool.push(&line(number));
        assert!(dropped == 0 && news.is_none(), "{news:?}");
    }
}

/// All that a listener with so many lines is sent.
fn sent(spool: &Spool, mut has: u64) -> String {
    let mut all = String::new();
    while let Some((text, last)) = spool.batch(has, 100) {
        (all, has) = (all + &text, last);
    }
    all
}

/// Lines with these sequence numbers and times.
fn numbered(numbers: impl IntoIterator<Item = (u64, u64)>) -> String {
    let line = |(sequence, time)| format!("{{\"sequence\":{sequence},\"time\":{time}}}\n");
    numbers.into_iter().map(line).collect()
}

fn same(numbers: impl IntoIterator<Item = u64>) -> String {
    numbered(numbers.into_iter().map(|number| (number, number)))
}

#[test]
fn a_spool_goes_on_where_it_was() {
    let (_folder, path) = folder();
    let mut spool = open(&path);
    let stream = spool.stream().to_owned();
    push(&mut spool, 1..=5);
    assert_eq!(sent(&spool, 0), same(1..=5));
    assert_eq!(sent(&spool, 3), same(4..=5));
    assert!(spool.resume(0) && spool.acknowledge(2));
    assert!(!spool.acknowledge(1), "an old number says nothing new");
    // As if killed: what was acknowledged is still there, and the listener says that it has it.
    drop(spool);
    let mut spool = open(&path);
    assert_eq!((spool.stream(), spool.waiting()), (&*stream, 5));
    assert!(spool.resume(2));
    push(&mut spool, 6..=6);
    assert_eq!(sent(&spool, 2), same(3..=6));
    spool.acknowledge(5);
    spool.close();
    let mut again = open(&path);
    assert_eq!((again.stream(), again.waiting()), (&*stream, 1));
    assert!(again.resume(6));
    again.close();
    let mut empty = open(&path);
    push(&mut empty, 7..=7);
    assert_eq!(sent(&empty, 6), same(7..=7));
}

#[test]
fn a_listener_that_has_more_than_was_sent_is_refused() {
    let (_folder, path) = folder();
    let mut spool = open(&path);
    assert!(!spool.resume(u64::MAX));
    assert!(spool.resume(0));
    push(&mut spool, 1..=3);
    assert!(!spool.resume(4));
    assert_eq!(sent(&spool, 0), same(1..=3), "nothing is forgotten");
}

/// Lines that were sent while the disk was full, or that a power cut took, have numbers that are not given again.
#[test]
fn numbers_that_a_listener_has_are_not_given_again() {
    let (_folder, path) = folder();
    let mut spool = open(&path);
    push(&mut spool, 1..=3);
    drop(spool);
    let mut spool = open(&path);
    push(&mut spool, [104, 105]);
    assert!(spool.resume(9));
    assert_eq!(sent(&spool, 9), numbered([(10, 104), (11, 105)]));
    // They are in the file under these numbers.
    drop(spool);
    let mut spool = open(&path);
    assert!(spool.resume(10));
    assert_eq!(sent(&spool, 10), numbered([(11, 105)]));
}

/// The file never takes more than it may, and the listener is told how many lines it lacks.
#[test]
fn what_is_too_much_is_dropped_aloud() {
    let (_folder, path) = folder();
    let mut spool = open(&path);
    let mut dropped = 0;
    for number in 1..=1000 {
        dropped += spool.push(&line(number)).dropped;
        assert!(fs::metadata(&path).unwrap().len() <= MOST);
    }
    assert!(spool.waiting() > 40 && dropped + spool.waiting() == 1000);
    let told =
        |lines| format!("{{\"sequence\":{dropped},\"event\":\"dropped\",\"lines\":{lines}}}\n");
    let rest = same(dropped + 1..=1000);
    assert_eq!(sent(&spool, 0), told(dropped) + &rest);
    assert_eq!(sent(&spool, 300), told(dropped - 300) + &rest);
    assert_eq!(sent(&spool, dropped), rest);
    drop(spool);
    let mut spool = open(&path);
    assert!(spool.resume(300));
    assert_eq!(sent(&spool, 300), told(dropped - 300) + &rest);
    // What is acknowledged makes room.
    spool.acknowledge(1000);
    push(&mut spool, 1001..=1010);
    assert_eq!(sent(&spool, 1000), same(1001..=1010));
}

/// Cut at any byte, as when the program is killed while it writes: each whole line is there, and it goes on.
#[test]
fn a_cut_spool_is_mended_or_refused() {
    let (_folder, path) = folder();
    let mut spool = open(&path);
    push(&mut spool, 1..=4);
    // Longer than what takes its place.
    spool.push(&format!("{{\"time\":5,\"note\":\"{}\"}}", "x".repeat(200)));
    drop(spool);
    let text = fs::read_to_string(&path).unwrap();
    let head = text.find('\n').unwrap() + 1;
    for length in 1..text.len() {
        fs::write(&path, &text[..length]).unwrap();
        if length < head {
            let refusal = refusal(&path);
            assert!(
                refusal.contains("(move it away to begin a new stream"),
                "{refusal}"
            );
            assert_eq!(
                fs::read_to_string(&path).unwrap(),
                text[..length],
                "left as it was"
            );
            continue;
        }
        let whole = text[head..length].matches('\n').count() as u64;
        let (mut spool, cut) = Spool::open(&path, MOST).unwrap();
        assert_eq!(spool.waiting(), whole);
        assert_eq!(cut == 0, text[..length].ends_with('\n'));
        push(&mut spool, [whole + 1, whole + 2]);
        drop(spool);
        assert_eq!(
            sent(&open(&path), 0),
            same(1..=whole + 2),
            "cut at {length}"
        );
    }
}

#[test]
fn what_cannot_be_a_spool_is_refused_with_a_remedy() {
    let (folder, path) = folder();
    let held = open(&path);
    let err = refusal(&path);
    assert!(
        err.contains("another monitor uses it (give another --spool"),
        "{err}"
    );
    drop(held);
    let table = folder.path().join("ride.csv");
    fs::write(&table, "time,acc\n0,9.8\n").unwrap();
    let cases = [
        (table.clone(), "is no spool of liftsim (move it away"),
        (
            folder.path().to_owned(),
            "is not an ordinary file (give another --spool)",
        ),
        (folder.path().join("no/lift.spool"), "cannot be used: "),
    ];
    for (path, message) in cases {
        let err = refusal(&path);
        assert!(err.contains(message), "{err}");
    }
    assert_eq!(fs::read(&table).unwrap(), b"time,acc\n0,9.8\n");
    let mut text = fs::read_to_string(&path).unwrap();
    text.insert(9, 'x');
    fs::write(&path, text).unwrap();
    assert!(refusal(&path).contains("lift.spool: is"));
}

/// Whatever happens in whatever order, the listener can have every line.
#[test]
fn any_course_of_events_loses_nothing() {
    let (_folder, path) = folder();
    let mut state = 2014u64;
    let mut random = |below: u64| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) % below
    };
    let (mut spool, mut pushed, mut has) = (open(&path), 0, 0);
    for _ in 0..1000 {
        match random(8) {
            0..4 if spool.waiting() < 40 => {
                pushed += 1;
                push(&mut spool, [pushed]);
            }
            4 | 5 => {
                has += random(spool.last() - has + 1);
                spool.acknowledge(has);
            }
            6 => {
                drop(spool);
                spool = open(&path);
                assert!(spool.resume(has));
            }
            7 => {
                spool.close();
                spool = open(&path);
            }
            _ => {}
        }
        assert_eq!(sent(&spool, has), same(has + 1..=pushed));
    }
    assert!(has > 150, "{has} of {pushed}");
}

/// On a full disk lines wait in memory; once there is room all are in the file.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_once_and_loses_nothing() {
    let (_folder, path) = folder();
    let mut spool = open(&path);
    push(&mut spool, 1..=3);
    spool.journal().fill_disk();
    assert!(matches!(spool.push(&line(4)).news, Some(Err(_))));
    push(&mut spool, 5..=9);
    assert_eq!((spool.waiting(), spool.unwritten()), (9, 6));
    assert!(spool.has_failed() && !spool.is_due());
    spool.acknowledge(5);
    assert_eq!(sent(&spool, 5), same(6..=9));
    spool.journal().free_disk();
    assert!(spool.is_due() && matches!(spool.save().news, Some(Ok(()))));
    assert_eq!(spool.unwritten(), 0);
    drop(spool);
    let spool = open(&path);
    assert_eq!(sent(&spool, 5), same(6..=9));
}

/// Memory is bounded too.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_does_not_fill_the_memory() {
    let (_folder, path) = folder();
    let mut spool = open(&path);
    spool.journal().fill_disk();
    let dropped: u64 = (1..=1000)
        .map(|number| spool.push(&line(number)).dropped)
        .sum();
    assert!(dropped > 800 && dropped + spool.waiting() == 1000);
    assert!(sent(&spool, dropped) == same(dropped + 1..=1000));
}
