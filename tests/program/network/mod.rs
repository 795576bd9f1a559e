//! `liftsim monitor --tcp`: whatever happens to the connection, to the listener or to the monitor, the listener has
//! every line once, in order.

mod listener;
mod outbox;
mod running;

use super::{liftsim, outcome, project};
use liftsim::outbox::Spool;
use listener::{LONG, Store, free, wait_until};
use running::Bench;
use std::fs;
use std::net::SocketAddr;
use std::process::{Command, Stdio};
use std::sync::atomic::Ordering;
use std::thread;
use std::time::{Duration, Instant};

const MIB: u64 = 1 << 20;

fn local() -> SocketAddr {
    free("127.0.0.1").unwrap()
}

fn all_is_well(store: &Store, expected: &[String]) {
    let stored = store.get();
    assert!(stored.faults.is_empty(), "{:?}", stored.faults);
    assert_eq!(stored.lines.len(), expected.len());
    assert!(stored.lines == expected);
    assert_eq!(stored.last as usize, expected.len());
}

/// The whole program: fifty cuts, and five times the monitor is killed. Whatever it had printed is delivered.
#[test]
fn a_killed_monitor_goes_on_with_its_stream() {
    let (bench, address, store) = (Bench::new(), local(), Store::default());
    let cuts = store.cut(address, 50, 7);
    let mut printed = Vec::new();
    for kill in 1..=5 {
        let mut monitor = bench.start(address);
        let start = Instant::now();
        while cuts.load(Ordering::SeqCst) < 10 * kill || monitor.printed() < 5 {
            assert!(start.elapsed() < LONG);
            monitor.feed(&bench.ride);
            thread::sleep(Duration::from_millis(5));
        }
        monitor.child.kill().unwrap();
        let (code, lines, _) = monitor.end();
        assert_eq!(code, None);
        printed.push(lines);
    }
    let mut monitor = bench.start(address);
    monitor.feed(&bench.ride);
    let (code, lines, said) = monitor.end();
    assert_eq!(code, Some(0));
    assert!(
        !said.contains("not delivered") && !said.contains("dropped"),
        "{said}"
    );
    printed.push(lines);
    let stored = store.get();
    assert!(stored.faults.is_empty(), "{:?}", stored.faults);
    // A monitor that is killed between the spool and its output has printed one line less.
    let mut rest = &stored.lines[..];
    for lines in &printed {
        if !rest.starts_with(lines) {
            rest = &rest[1..];
        }
        rest = rest
            .strip_prefix(&lines[..])
            .expect("what was printed is stored, in order");
    }
    assert!(rest.is_empty(), "{rest:?}");
}

/// Over IPv4 and IPv6: the listener is not there, comes, stops in the middle, and comes again.
#[test]
fn a_listener_may_stop_and_start_again() {
    let bench = Bench::new();
    for host in ["127.0.0.1", "::1"] {
        let Ok(address) = free(host) else {
            println!("{host}: this machine has no such address");
            continue;
        };
        let store = Store::default();
        let mut monitor = bench.start(address);
        monitor.feed(&bench.ride);
        wait_until("it says that nobody is there", || {
            monitor.says("cannot be reached")
        });
        wait_until("it goes on", || monitor.printed() > 4);
        store.until(address, 3);
        wait_until("it says that nobody is there", || {
            monitor.says("closed the connection") || monitor.says("broke")
        });
        monitor.feed(&bench.ride);
        store.serve(address);
        let (code, printed, said) = monitor.end();
        assert_eq!(code, Some(0), "{said}");
        assert!(
            said.contains(&format!("{address}: the listener is reached")),
            "{said}"
        );
        all_is_well(&store, &printed);
        fs::remove_file(bench.folder.path().join("lift.spool")).unwrap();
    }
}

/// What is not delivered is kept, and the next monitor delivers it.
#[test]
fn what_is_left_waits_for_the_next_start() {
    let (bench, address, store) = (Bench::new(), local(), Store::default());
    let command = Bench::command(&address.to_string()).replace("--tcp-wait 120", "--tcp-wait 0");
    let mut monitor = bench.run(&command);
    monitor.feed(&bench.ride);
    let (code, mut expected, said) = monitor.end();
    assert_eq!(code, Some(0));
    let left = format!(
        "{address}: lines that are not delivered: {}, kept in lift.spool (start",
        expected.len()
    );
    assert!(said.contains(&left), "{said}");
    store.serve(address);
    // Even one that is given no sample.
    let (code, _, said) = bench.start(address).end();
    let delivered = format!("delivered now: {}", expected.len());
    assert!(
        said.contains("holds no reading") && said.contains(&delivered),
        "{said}"
    );
    assert_eq!(code, Some(0));
    let (code, _, said) = bench.start(address).end();
    assert!(said.contains("holds no reading"), "{said}");
    assert_eq!(code, Some(2));
    let mut monitor = bench.start(address);
    monitor.feed("9.8\n");
    let (code, printed, said) = monitor.end();
    assert_eq!((code, &*said), (Some(0), ""));
    expected.extend(printed);
    all_is_well(&store, &expected);
}

/// On a disk that takes no more, here by a limit on the size of files, it goes on, says so, and delivers all.
#[cfg(unix)]
#[test]
fn a_full_disk_stops_nothing() {
    let (bench, address, store) = (Bench::new(), local(), Store::default());
    let limited = format!(
        "trap '' XFSZ; ulimit -f 1; {}",
        Bench::command(&address.to_string())
    );
    let mut monitor = bench.run(&limited);
    monitor.feed(&bench.ride);
    monitor.feed(&bench.ride);
    wait_until("the disk is full", || {
        monitor.says("lift.spool: cannot be written: ")
    });
    wait_until("it goes on", || monitor.printed() > 15);
    store.serve(address);
    let (code, printed, said) = monitor.end();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("(free space on the disk)"), "{said}");
    assert!(
        !said.contains("not delivered") && !said.contains("neither"),
        "{said}"
    );
    all_is_well(&store, &printed);
    // Where nobody comes to take it, what is lost is said.
    let nobody = limited
        .replace(&address.to_string(), &local().to_string())
        .replace("--tcp-wait 120", "--tcp-wait 0")
        .replace("lift.spool", "other.spool");
    let mut monitor = bench.run(&nobody);
    monitor.feed(&bench.ride);
    let (code, printed, said) = monitor.end();
    assert_eq!(code, Some(0));
    let count = |before: &str| -> usize {
        let rest = said
            .split(before)
            .nth(1)
            .unwrap_or_else(|| panic!("{said}"));
        rest.split([' ', ',']).next().unwrap().parse().unwrap()
    };
    let kept = count("lines that are not delivered: ");
    let lost = count("which could not be written: ");
    assert_eq!(kept + lost, printed.len(), "{said}");
}

/// The listener that a user starts from, killed and started again.
#[test]
fn the_listener_in_scripts_stores_everything_once() {
    if Command::new("python3").arg("--version").output().is_err() || free("::1").is_err() {
        println!("no Python, or no IPv6: not tested");
        return;
    }
    let (bench, address) = (Bench::new(), local());
    let listen = || {
        let script = project().join("scripts/listen.py");
        let mut python = Command::new("python3");
        python
            .arg(script)
            .arg(address.port().to_string())
            .arg(bench.folder.path());
        python.stderr(Stdio::null()).spawn().unwrap()
    };
    let stored = || {
        let files = fs::read_dir(bench.folder.path())
            .unwrap()
            .map(|entry| entry.unwrap().path());
        let mut streams = files.filter(|path| path.extension().is_some_and(|it| it == "jsonl"));
        streams
            .next()
            .map_or(String::new(), |path| fs::read_to_string(path).unwrap())
    };
    let mut monitor = bench.run(&Bench::command(&format!("localhost:{}", address.port())));
    for _ in 0..2 {
        let mut listener = listen();
        let before = stored().lines().count();
        let start = Instant::now();
        while stored().lines().count() < before + 5 {
            assert!(start.elapsed() < LONG);
            monitor.feed(&bench.ride);
            thread::sleep(Duration::from_millis(20));
        }
        listener.kill().unwrap();
        listener.wait().unwrap();
    }
    let mut listener = listen();
    let (code, printed, said) = monitor.end();
    listener.kill().unwrap();
    listener.wait().unwrap();
    assert_eq!(code, Some(0), "{said}");
    let numbered =
        |(line, number): (&String, usize)| format!("{{\"sequence\":{number},{}\n", &line[1..]);
    let expected: String = printed.iter().zip(1..).map(numbered).collect();
    assert!(stored() == expected);
}

/// What cannot be used is refused at once, with a remedy.
#[test]
fn what_cannot_be_used_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ride.csv"), "time,acc\n").unwrap();
    let refused = |arguments: &[&str]| {
        let mut command = liftsim();
        command
            .current_dir(&folder)
            .args(["monitor", "--rate", "100"])
            .args(arguments);
        let (code, _, err) = outcome(command.write_stdin("9.8\n"));
        assert_eq!(code, 2, "{err}");
        err
    };
    for (arguments, message) in [
        (
            &["--tcp", "localhost"][..],
            "must be HOST:PORT, got localhost (for example",
        ),
        (
            &["--tcp", "::1:9000"],
            "an IPv6 address must stand in brackets, got ::1:9000 (for example [::1]:9000)",
        ),
        (
            &["--tcp", "localhost:0"],
            "port: must lie in [1, 65535], got 0 (for example localhost:9000)",
        ),
        (&["--spool", "x"], "--tcp <HOST:PORT>"),
        (
            &["--tcp", "[::1]:9", "--spool", "ride.csv"],
            "ride.csv: is no spool of liftsim (move it away",
        ),
        (
            &["--tcp", "[::1]:9", "--spool", "y", "--map", "./y"],
            "y: is written to and used for something else too (give another name)",
        ),
        (
            &["--tcp", "[::1]:9", "--spool", "no/x"],
            "no/x: cannot be used: ",
        ),
        (
            &["--tcp", "[::1]:9", "--spool", "."],
            "give another --spool)",
        ),
        (
            &["--tcp", "[::1]:9", "--spool-size", "0"],
            "0 is not in 1..=1024",
        ),
    ] {
        let err = refused(arguments);
        assert!(err.contains(message), "{err}");
    }
    let _held = Spool::open(&folder.path().join("x"), MIB).unwrap();
    let err = refused(&["--tcp", "[::1]:9", "--spool", "x"]);
    assert!(
        err.contains("x: another monitor uses it (give another --spool: each has its own)"),
        "{err}"
    );
}

/// A host whose name nobody knows may be known later: the monitor says so and goes on.
#[test]
fn an_unknown_host_stops_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = liftsim();
    command.current_dir(&folder);
    command.args([
        "monitor",
        "--rate",
        "100",
        "--tcp",
        "nobody.invalid:9000",
        "--tcp-wait",
        "0",
    ]);
    let (code, out, err) = outcome(command.write_stdin("9.8\n"));
    assert_eq!((code, out.lines().count()), (0, 1), "{err}");
    assert!(
        err.contains("lines that are not delivered: 1, kept in liftsim.spool (start"),
        "{err}"
    );
}
