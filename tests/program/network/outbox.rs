//! The outbox of the library, with short times.

use super::listener::{LONG, Random, Store};
use super::{MIB, all_is_well, local};
use liftsim::outbox::{Left, Notice, Outbox, Spool, Timing};
use std::io::{BufRead, BufReader, Write};
use std::net::{SocketAddr, TcpListener};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::{Duration, Instant};

const QUICK: Timing = Timing {
    connect: Duration::from_secs(5),
    answer: Duration::from_secs(2),
    first: Duration::from_millis(1),
    most: Duration::from_millis(20),
};

/// An outbox, and what it tells.
fn outbox(address: SocketAddr, spool: &Path, timing: Timing) -> (Outbox, Receiver<Notice>) {
    let (tell, told) = mpsc::channel();
    let tell = Mutex::new(tell);
    let spool = Spool::open(spool, MIB).unwrap().0;
    let address = address.to_string().parse().unwrap();
    let tell = move |notice| {
        let _ = tell.lock().unwrap().send(notice);
    };
    (Outbox::start(address, spool, timing, tell), told)
}

/// Fifty connections are cut: at random bytes, unanswered, half answered, with lines stored that are not acknowledged,
/// and some while the listener has stopped. Meanwhile the spool is closed and opened again.
#[test]
fn nothing_is_lost_or_delivered_twice_under_fifty_cuts() {
    for seed in 1..=3 {
        let folder = tempfile::tempdir().unwrap();
        let (path, address, store) = (folder.path().join("spool"), local(), Store::default());
        let cuts = store.cut(address, 50, seed);
        let (mut outbox, mut told) = self::outbox(address, &path, QUICK);
        let (mut random, mut expected) = (Random::new(seed + 100), Vec::new());
        let start = Instant::now();
        while cuts.load(Ordering::SeqCst) < 50 {
            assert!(start.elapsed() < LONG);
            for _ in 0..random.below(8) {
                let number = expected.len();
                expected.push(format!(
                    "{{\"time\":{number},\"note\":\"{}\"}}",
                    "ä".repeat(number % 90)
                ));
                outbox.send(&expected[number]);
            }
            if random.below(50) == 0 {
                outbox.finish(Duration::ZERO);
                (outbox, told) = self::outbox(address, &path, QUICK);
            }
            thread::sleep(Duration::from_millis(2));
        }
        assert_eq!(outbox.finish(LONG), Left::default());
        println!(
            "{} lines; told: {}",
            expected.len(),
            told.try_iter().count()
        );
        all_is_well(&store, &expected);
    }
}

/// What is wrong is told once, and that it is right again.
#[test]
fn what_is_wrong_is_told_once() {
    let folder = tempfile::tempdir().unwrap();
    let (address, store) = (local(), Store::default());
    let (outbox, told) = outbox(address, &folder.path().join("spool"), QUICK);
    let next = || told.recv_timeout(LONG).unwrap().to_string();
    outbox.send("{\"time\":1}");
    assert!(next().contains(": cannot be reached: "));
    // A dozen attempts later nothing more has been told.
    thread::sleep(Duration::from_millis(200));
    assert!(told.try_recv().is_err());
    store.serve(address);
    assert!(next().contains("the listener is reached"));
    assert_eq!(outbox.finish(LONG), Left::default());
    all_is_well(&store, &["{\"time\":1}".to_owned()]);
}

/// Listeners that do not keep to the protocol.
#[test]
fn a_wrong_answer_is_told_with_a_remedy() {
    let patience = Timing {
        answer: Duration::from_millis(50),
        ..QUICK
    };
    let zeros = "0".repeat(1000);
    // The answer when it is reached, and what follows the first line.
    for (answer, later, message) in [
        (
            "",
            "",
            "has not answered for 0.05 s (it must send the number",
        ),
        ("OK\n", "", "got \"OK\""),
        ("-1\n", "", "got \"-1\""),
        (&zeros, "", "got \"000"),
        ("99999999999999999999\n", "", "got \"99999999999999999999\""),
        (
            "18446744073709551615\n",
            "",
            "says that it has line 18446744073709551615, and 1 was the last (correct",
        ),
        (
            "0\n",
            "7\n",
            "says that it has line 7, and 1 was the last (correct",
        ),
        ("0\n", "", "has not answered for 0.05 s"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let (outbox, told) = outbox(address, &folder.path().join("spool"), patience);
        outbox.send("{\"time\":1}");
        let (mut stream, _) = listener.accept().unwrap();
        stream.write_all(answer.as_bytes()).unwrap();
        if !later.is_empty() {
            let lines = BufReader::new(&stream).lines();
            assert_eq!(lines.take(2).count(), 2);
            stream.write_all(later.as_bytes()).unwrap();
        }
        let told = told.recv_timeout(LONG).unwrap().to_string();
        assert!(told.contains(message), "{answer}: {told}");
        assert_eq!(outbox.finish(Duration::ZERO), Left { lines: 1, lost: 0 });
    }
}

/// A listener that lacks what another one has acknowledged, or what it has lost, is told how much that is.
#[test]
fn another_listener_is_told_what_it_lacks() {
    let folder = tempfile::tempdir().unwrap();
    let (address, first, second) = (local(), Store::default(), Store::default());
    let (outbox, _told) = outbox(address, &folder.path().join("spool"), QUICK);
    let lines = [1, 2, 3].map(|time| format!("{{\"time\":{time}}}"));
    outbox.send(&lines[0]);
    outbox.send(&lines[1]);
    first.until(address, 2);
    second.serve(address);
    outbox.send(&lines[2]);
    assert_eq!(outbox.finish(LONG), Left::default());
    all_is_well(&first, &lines[..2]);
    let dropped = "{\"event\":\"dropped\",\"lines\":2}".to_owned();
    let stored = second.get();
    assert!(stored.faults.is_empty(), "{:?}", stored.faults);
    assert_eq!(stored.lines, [dropped, lines[2].clone()]);
    assert_eq!(stored.last, 3);
}
