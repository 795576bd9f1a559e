//! Refusals with their messages, and warnings.

use super::lines::LONGEST_LINE;
use super::*;

#[test]
fn no_table() {
    assert_eq!(refused(""), "ride.csv: is empty (export it again)");
    assert_eq!(refused("\n\n# nothing\n"), refused(""));
    assert!(refused("time,acc\n").contains("has a header and no readings"));
    assert!(
        refused("time,acc\n0.1,1\n")
            .contains("at least 2 readings of the acceleration at different times, got 1")
    );
    assert!(refused("time,acc\n0.1,\n0.2,\n").contains("got 0"));
    assert!(
        refused("time,acc\n0.1,1.5\n0.2,1.5\n")
            .contains("readings of the acceleration must differ, got 1.5")
    );
    assert!(
        refused([0x7f, b'E', b'L', b'F', 2, 1, 1, 0])
            .contains("ride.csv:1: holds bytes that are not text")
    );
    assert!(
        refused("time,acc\n0,1\n0.1,\0\n").contains("ride.csv:3: holds bytes that are not text")
    );
    let long = "9".repeat(LONGEST_LINE + 1);
    assert!(refused(&long).contains("ride.csv:1: must be at most 1048576 bytes long"));
    assert!(refused(format!("time,acc\n0,1\n0.1,{long}")).contains("ride.csv:3: must be at most"));
}

#[test]
fn no_such_column() {
    let named = |time: &str, acceleration: &str| Reading {
        time: Some(time.into()),
        acceleration: Some(acceleration.into()),
        ..Reading::default()
    };
    let text = "time,acc,pressure\n0,1,2\n0.1,2,3\n";
    assert_eq!(
        refused_as(text, &named("tme", "acc")),
        "ride.csv:1: no time column \"tme\", did you mean \"time\"? (there \
         are \"time\", \"acc\", \"pressure\")"
    );
    assert!(
        refused_as(text, &named("time", "volume"))
            .contains("no acceleration column \"volume\" (there are")
    );
    assert!(
        refused("when,acc\n0,1\n").contains("no column looks like time, the columns are \"when\"")
    );
    assert!(refused("time,value\n0,1\n").contains("no column looks like an acceleration"));
    assert_eq!(
        refused("0,1,2,3,4\n1,2,3,4,5\n"),
        "ride.csv:1: a table of 5 columns must have a header (or give the numbers of two of them: \
         --time 1 --acceleration 4)"
    );
    assert!(refused("0,1,2\n1,2,3\n").contains("--time 1 --acceleration 3"));
    let along = |axis: &str| Reading {
        axis: axis.parse().unwrap(),
        ..Reading::default()
    };
    assert!(refused_as("time,x,y\n0,1,2\n", &along("z")).contains("the acceleration along z"));
    assert!(refused_as("time,x,y\n0,1,2\n", &along("gravity")).contains("fewer than three axes"));
    let weightless = "time,x,y,z\n0,1,0,0\n0.1,0,0,0\n";
    assert!(refused_as(weightless, &along("gravity")).contains("got another length"));
}

#[test]
fn cells_that_are_no_numbers() {
    let refused_cell = |cell: &str| refused(format!("time,acc\n0,1\n0.1,{cell}\n0.2,2\n"));
    assert_eq!(
        refused_cell("-inf"),
        "ride.csv:3: column \"acc\": must be finite, got \"-inf\" (leave the row out where nothing was read)"
    );
    assert!(refused_cell("1e999").contains("must be finite"));
    assert!(refused_cell("1e12").contains("must lie within 1e9 m/s^2"));
    assert_eq!(
        refused_cell("none"),
        "ride.csv:3: column \"acc\": must be a number, got \"none\" (correct it, or leave the row out)"
    );
    for date in ["25.11.2013", "2013/11/25", "yesterday"] {
        let refused = refused(format!("time,acc\n{date},1\n"));
        assert!(
            refused.contains("all as 2013-11-25T12:30:00.005Z)"),
            "{refused}"
        );
    }
    assert!(refused("time,acc\n0,1\n2e14,2\n").contains("must lie within 1e12 s"));
}

#[test]
fn rows_of_another_kind() {
    assert!(
        refused("time,acc\n0,1\n0.1\n0.2,1\n")
            .contains(":3: must have 2 cells as the first row has, got 1")
    );
    assert!(
        refused("time,acc\n0,1\n0.1;2\n0.2,1\n")
            .contains("parted by a comma in the first row, here by a semicolon")
    );
    assert!(
        refused("time;acc\n0;1\n0.1,2\n0.2;1\n")
            .contains("parted by a semicolon in the first row, here by a comma")
    );
    assert!(refused("time,acc\n0,00,9,81\n").contains("write decimal points, or quote"));
    assert!(
        refused("time;acc\n0,1;9,5\n0,2;9.5\n").contains(":3: column \"acc\": must be a number")
    );
    // A separator at the end of a row does not add a cell.
    assert_eq!(read(&open("time,acc\n0,1,\n0.1,2,\n")).len(), 2);
}

#[test]
fn time() {
    assert_eq!(
        refused("time,acc\n0,1\n0.2,2\n0.1,3\n"),
        "ride.csv:4: time must increase, got 0.1 s after 0.2 s (sort the rows, or split the file)"
    );
    let recording = open("time,acc\n0,1\n0.1,2\n0.1,3\n0.1,4\n0.2,5\n");
    assert_eq!(read(&recording), [(0.0, 1.0), (0.1, 2.0), (0.2, 5.0)]);
    assert_eq!(
        recording.warnings(),
        [Warning::RepeatedTimes { count: 2, line: 4 }]
    );
    assert_eq!(
        recording.warnings()[0].to_string(),
        "line 4: time repeats here, 2 times in all (the first reading is kept)"
    );
    let once = open("time,acc\n0,1\n0.1,2\n0.1,3\n0.2,5\n");
    assert_eq!(
        once.warnings()[0].to_string(),
        "line 4: time repeats once (the first reading is kept)"
    );
    // Milliseconds without a stated unit.
    let counted = "time,acc\n0,1\n20,2\n40,1\n";
    assert!(refused(counted).contains(
        "column \"time\": counted in s it gives 0.05 readings a second (--time-unit ms)"
    ));
    let reading = Reading {
        time_unit: Some(TimeUnit::Milliseconds),
        ..Reading::default()
    };
    assert_eq!(open_as(counted, &reading).facts().rate, 50.0);
}

/// A file that was cut off is read up to the last whole row.
#[test]
fn cut_off() {
    for cut in ["0.2", "0.2,", "0.2,1.5E-", "0.2,1.5"] {
        let recording = open(&format!("time,acc\n0.0,1.0E0\n0.1,1.2E0\n{cut}"));
        assert_eq!(read(&recording).len(), 2, "{cut}");
    }
    let recording = open("time,acc,other\n0.0,1,1\n0.1,2,1\n0.2,3");
    assert_eq!(recording.warnings(), [Warning::CutOff { line: 4 }]);
    assert_eq!(
        read(&open("time,acc\n0.0,1.0E0\n0.1,1.2E0\n0.2,1E0")).len(),
        3
    );
}

#[test]
fn options_that_cannot_be() {
    let text = "time,acc\n0,1\n0.1,2\n0.2,1\n";
    let resample = |rate| Reading {
        resample: Some(rate),
        ..Reading::default()
    };
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY, 101.0] {
        assert!(refused_as(text, &resample(rate)).contains("resample must lie in (0, 100] Hz"));
    }
    let counts = Reading {
        unit: Unit::Counts {
            scale: 0.0,
            offset: 0.0,
        },
        ..Reading::default()
    };
    assert!(refused_as(text, &counts).contains("unit: scale must be between"));
    let member = Reading {
        member: Some("a.csv".into()),
        ..Reading::default()
    };
    assert!(
        refused_as(text, &member).contains("has no members, got \"a.csv\" (leave out --member)")
    );
}

#[test]
fn files() {
    let open = |path: &Path| Recording::open(path, &Reading::default());
    let folder = tempfile::tempdir().unwrap();
    let error = open(&folder.path().join("none.csv")).unwrap_err();
    assert!(matches!(*error.problem, RecordingProblem::Unreadable(_)));
    assert!(
        open(folder.path())
            .unwrap_err()
            .to_string()
            .contains("must be a file, got a directory")
    );
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(b"0,1\n0.1,2\n").unwrap();
    assert_eq!(read(&open(file.path()).unwrap()).len(), 2);
    // Sparse: it is refused by its size before it is read.
    file.as_file().set_len(20 << 30).unwrap();
    let refused = open(file.path()).unwrap_err().to_string();
    assert!(
        refused.contains("GB of memory, at most 2 are taken (read a part of it with --from"),
        "{refused}"
    );
    assert!(refused.contains("`liftsim monitor`"), "{refused}");
}

#[test]
fn what_is_only_warned_of() {
    let text = |row: &dyn Fn(i32) -> (f64, f64)| {
        let line = |i| format!("{},{}\n", row(i).0, row(i).1);
        format!("time,acc\n{}", (0..1000).map(line).collect::<String>())
    };
    let even = |i: i32| 0.01 * f64::from(i);
    let wave = |i: i32| (0.07 * f64::from(i)).sin();
    let warnings = |text: String| open(&text).warnings().to_vec();
    assert_eq!(warnings(text(&|i| (even(i), wave(i)))), []);
    let clipped = warnings(text(&|i| (even(i), wave(i).clamp(-0.9, 0.9))));
    assert!(
        matches!(clipped[..], [Warning::Saturated { share, .. }] if share > 0.2),
        "{clipped:?}"
    );
    let coarse = warnings(text(&|i| (even(i), (98.0 + wave(i)).round() / 10.0)));
    assert!(
        matches!(coarse[..], [Warning::CoarseStep { .. }]),
        "{coarse:?}"
    );
    let held = warnings(text(&|i| (even(i), wave(i / 2 * 2))));
    assert!(matches!(held[..], [Warning::Held { .. }]), "{held:?}");
    let gap = warnings(text(&|i| {
        (even(i) + if i > 500 { 1.0 } else { 0.0 }, wave(i))
    }));
    assert!(matches!(gap[..], [Warning::Missing { .. }]), "{gap:?}");
    let uneven = warnings(text(&|i| (even(i) + 0.002 * wave(97 * i), wave(i))));
    assert!(matches!(uneven[..], [Warning::Uneven { .. }]), "{uneven:?}");
    assert!(refused(text(&|i| (even(i), 700.0 + wave(i)))).contains("--unit counts --scale 1.40"));
}
