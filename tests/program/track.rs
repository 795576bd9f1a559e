//! `liftsim track`: distances against the truth of simulated rides, its formats, and what it refuses to print bare.

use super::recordings::{Said, recorded, well};
use super::{liftsim, outcome};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn track(directory: &Path, arguments: &[&str]) -> Said {
    let mut command = liftsim();
    command.current_dir(directory).arg("track").args(arguments);
    outcome(&mut command)
}

fn rides(out: &str) -> Vec<Value> {
    let report: Value = serde_json::from_str(out).unwrap();
    report["rides"].as_array().unwrap().clone()
}

/// The distances of `ride.truth.csv`.
fn truth(directory: &Path) -> Vec<f64> {
    let text = fs::read_to_string(directory.join("ride.truth.csv")).unwrap();
    let distance = |line: &str| line.split(',').nth(3).unwrap().parse().unwrap();
    text.lines().skip(1).map(distance).collect()
}

/// A normal error is beyond 5 deviations once in two million.
#[test]
fn distances_are_true_within_their_deviations() {
    for flags in [
        &[][..],
        &[
            "--trip", "up:3", "--trip", "up:27", "--trip", "down:30", "--speed", "1.6",
        ],
        &["--rate", "25", "--with-gravity"],
        &[
            "--rate",
            "400",
            "--trip",
            "down:60",
            "--speed",
            "4",
            "--acceleration",
            "1",
        ],
    ] {
        let directory = recorded(flags);
        let out = well(track(directory.path(), &["ride.csv", "--format", "json"]));
        let (rides, truth) = (rides(&out), truth(directory.path()));
        assert_eq!(rides.len(), truth.len(), "{flags:?}");
        for (ride, truth) in rides.iter().zip(truth) {
            let number = |name: &str| ride[name].as_f64().unwrap();
            let (error, deviation) = (number("distance") - truth, number("deviation"));
            assert!(error.abs() < 5.0 * deviation, "{flags:?}: {ride} {truth}");
            assert!(
                deviation < 0.01 * truth.abs() + 0.05,
                "{flags:?}: {ride} {truth}"
            );
        }
    }
}

/// All formats say the same.
#[test]
fn formats_agree() {
    let directory = recorded(&[]);
    let path = directory.path();
    let json = rides(&well(track(path, &["ride.csv", "--format", "json"])));
    let csv = well(track(path, &["ride.csv", "--format", "csv"]));
    let markdown = well(track(path, &["ride.csv", "--format", "markdown"]));
    let table = well(track(path, &["ride.csv"]));
    let lines: Vec<&str> = csv.lines().collect();
    let columns: Vec<&str> = lines[0].split(',').collect();
    assert_eq!((lines.len(), markdown.lines().count()), (3, 4));
    for (place, ride) in json.iter().enumerate() {
        let cells: Vec<&str> = lines[place + 1].split(',').collect();
        for name in [
            "start",
            "stop",
            "distance",
            "deviation",
            "closing_speed",
            "speed",
        ] {
            let column = columns.iter().position(|it| *it == name).unwrap();
            assert_eq!(cells[column], ride[name].to_string(), "{name}");
            assert!(markdown.contains(&ride[name].to_string()), "{name}");
        }
        let distance = format!(" {:.2} ", ride["distance"].as_f64().unwrap());
        assert!(table.contains(&distance), "{table}");
    }
}

#[test]
fn draws_a_picture() {
    let directory = recorded(&[]);
    let path = directory.path();
    for name in ["track.png", "track.svg"] {
        let out = well(track(path, &["ride.csv", "--figure", name]));
        assert!(out.contains("distance") && path.join(name).exists());
    }
    let before = fs::read(path.join("track.png")).unwrap();
    for (name, message) in [
        ("track.png", "already exists"),
        ("track.pdf", "must end in .png or .svg"),
        ("nowhere/track.png", "no folder nowhere"),
    ] {
        let (code, out, err) = track(path, &["ride.csv", "--figure", name]);
        assert_eq!((code, out.as_str()), (2, ""), "{name}");
        assert!(err.contains(message), "{err}");
    }
    assert_eq!(fs::read(path.join("track.png")).unwrap(), before);
    let again = ["ride.csv", "--figure", "track.png", "--force"];
    well(track(path, &again));
    assert_eq!(fs::read(path.join("track.png")).unwrap(), before);
}

/// The part of a record between two times: what is not in it is said.
#[test]
fn a_trip_that_is_cut_is_said_to_be() {
    let directory = recorded(&[]);
    let path = directory.path();
    let part = |from: &str, to: &str, begins: &str| {
        let part = ["ride.csv", "--from", from, "--to", to, "--begins", begins];
        let part = [&part[..], &["--format", "json"]].concat();
        let (code, out, err) = track(path, &part);
        assert_eq!(code, 0, "{err}");
        (rides(&out)[0].clone(), err)
    };
    let (ride, err) = part("12", "34", "motion");
    assert!(
        ride["distance"].is_null() && ride["stop"].is_f64(),
        "{ride}"
    );
    assert!(
        err.contains("ride 1: no distance, the record does not hold its start"),
        "{err}"
    );
    let (ride, err) = part("0", "20", "rest");
    assert!(
        ride["stop"].is_null() && ride["deviation"].is_f64(),
        "{ride}"
    );
    let distance = ride["distance"].as_f64().unwrap();
    assert!((6.0..9.5).contains(&distance), "{ride}");
    assert!(
        err.contains("ride 1: the record does not hold its stop"),
        "{err}"
    );
}

/// A first-order high pass of half a second, as many phones have.
#[test]
fn behind_a_high_pass_nothing_is_measured() {
    let directory = recorded(&["--speed", "1.6", "--acceleration", "1", "--jerk", "1"]);
    let path = directory.path();
    let text = fs::read_to_string(path.join("ride.csv")).unwrap();
    let mut low = 0.0;
    let rows = text.lines().skip(1).map(|line| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let filtered = cells[3] - low;
        low += filtered * 0.02;
        format!("{},{filtered}\n", cells[0])
    });
    let rows: String = rows.collect();
    fs::write(
        path.join("filtered.csv"),
        "time,acceleration\n".to_owned() + &rows,
    )
    .unwrap();
    let (code, out, err) = track(path, &["filtered.csv", "--format", "json"]);
    assert_eq!(code, 0, "{err}");
    assert!(
        rides(&out).iter().all(|ride| ride["distance"].is_null()),
        "{out}"
    );
    assert!(err.contains("high-pass filter"), "{err}");
    let (code, out, err) = track(path, &["filtered.csv", "--floors", "0,12"]);
    assert_eq!((code, out.as_str()), (2, ""));
    assert!(err.contains("no floors are found (record the raw"), "{err}");
}

/// 18 mg a step: the deviation is widened, aloud.
#[test]
fn a_coarse_sensor_is_widened() {
    let speed = ["--speed", "1.6", "--acceleration", "1.1", "--jerk", "2"];
    let deviation = |step: &[&str]| {
        let directory = recorded(&[&speed[..], step].concat());
        let (code, out, err) = track(directory.path(), &["ride.csv", "--format", "json"]);
        assert_eq!(code, 0, "{err}");
        let rides = rides(&out);
        let errors = rides.iter().zip(truth(directory.path()));
        for (ride, truth) in errors {
            let number = |name: &str| ride[name].as_f64().unwrap();
            assert!(
                (number("distance") - truth).abs() < 3.0 * number("deviation"),
                "{ride}"
            );
        }
        (rides[0]["deviation"].as_f64().unwrap(), err)
    };
    let (fine, _) = deviation(&[]);
    let (coarse, err) = deviation(&["--step", "0.1765"]);
    assert!(coarse > 4.0 * fine, "{coarse} {fine}");
    assert!(err.contains("coarser than its noise"), "{err}");
}

/// A record that holds no ride, and one that is none.
#[test]
fn says_what_it_cannot_use() {
    let directory = recorded(&["--still", "--rest", "20"]);
    let path = directory.path();
    let (code, out, _) = track(path, &["ride.csv"]);
    assert_eq!(code, 0);
    assert!(out.contains("no rides"), "{out}");
    let (code, out, _) = track(path, &["ride.csv", "--format", "csv"]);
    assert_eq!((code, out.lines().count()), (0, 1), "{out}");
    fs::write(path.join("empty.csv"), "").unwrap();
    fs::write(
        path.join("short.csv"),
        "time,acceleration\n0,0.1\n0.01,0.2\n",
    )
    .unwrap();
    for (name, message) in [
        ("nowhere.csv", "nowhere.csv"),
        ("empty.csv", "empty"),
        ("short.csv", "must last at least 2 s"),
    ] {
        let (code, out, err) = track(path, &[name]);
        assert_eq!((code, out.as_str()), (2, ""), "{name}");
        assert!(err.contains(message), "{name}: {err}");
    }
}

/// Three floors 3.2 m apart and one 4 m above: up by 1, 2 and 1 floors, and down to the lowest.
const BUILDING: [&str; 12] = [
    "--speed",
    "1.6",
    "--acceleration",
    "1",
    "--trip",
    "up:3.2",
    "--trip",
    "up:3.2",
    "--trip",
    "up:4",
    "--trip",
    "down:10.4",
];

#[test]
fn given_floors_are_found() {
    let directory = recorded(&BUILDING);
    let path = directory.path();
    let bare = well(track(path, &["ride.csv", "--format", "csv"]));
    for start in [&["--at", "0"][..], &[]] {
        let flags = [&["ride.csv", "--floors", "-3.2,0,3.2,7.2"], start].concat();
        let run = |format: &str| well(track(path, &[&flags[..], &["--format", format]].concat()));
        let report: Value = serde_json::from_str(&run("json")).unwrap();
        assert_eq!(report["floors"].as_array().unwrap().len(), 4);
        let (csv, table) = (run("csv"), run("table"));
        assert!(!table.contains("alarm,"), "{table}");
        let lines: Vec<&str> = csv.lines().collect();
        let columns: Vec<&str> = lines[0].split(',').collect();
        for (place, line) in bare.lines().enumerate() {
            assert!(lines[place].starts_with(line), "{csv}");
        }
        let rides = report["rides"].as_array().unwrap();
        assert_eq!(rides.len(), 4);
        for (place, (ride, floor)) in rides.iter().zip([1, 2, 3, 0]).enumerate() {
            let landing = &ride["landing"];
            let cells: Vec<&str> = lines[place + 1].split(',').collect();
            let cell = |name: &str| cells[columns.iter().position(|it| *it == name).unwrap()];
            for (name, value) in [
                ("landing_position", &landing["position"]),
                ("landing_judgement_offset", &landing["judgement"]["offset"]),
                ("landing_judgement_xi", &landing["judgement"]["xi"]),
            ] {
                assert_eq!(cell(name), value.to_string(), "{name}");
            }
            // Of a car that may be anywhere the first trips do not say which floors they join.
            if place == 3 || !start.is_empty() {
                assert_eq!(landing["floor"], floor, "{start:?}: {ride}");
                assert!(landing["judgement"]["fault"].is_null(), "{ride}");
            }
        }
    }
}

#[test]
fn a_stop_off_every_floor_is_an_alarm() {
    for (trips, fault, words) in [
        (
            ["up:4.9", "down:4.9"],
            "between_floors",
            "alarm, between floors: ",
        ),
        (["up:9.2", "down:9.2"], "overrun", "alarm, above the top: "),
    ] {
        let trips = [
            "--trip",
            trips[0],
            "--trip",
            trips[1],
            "--speed",
            "1.6",
            "--acceleration",
            "1",
        ];
        let directory = recorded(&trips);
        let flags = ["ride.csv", "--floors", "0,3.2,6.4,8.4", "--at", "0"];
        let out = well(track(directory.path(), &flags));
        assert!(out.contains(&format!("ride 1: {words}")), "{out}");
        assert!(
            out.contains(&format!("ride 1, judged again by ride 2: {words}")),
            "{out}"
        );
        let rides = rides(&well(track(
            directory.path(),
            &[&flags[..], &["--format", "json"]].concat(),
        )));
        assert_eq!(rides[0]["landing"]["judgement"]["fault"], fault);
        assert!(rides[0]["landing"]["floor"].is_null() && rides[1]["landing"]["floor"] == 0);
    }
}

/// Swept by the first record, used by the second.
#[test]
fn a_map_is_kept() {
    let directory = recorded(&BUILDING);
    let path = directory.path();
    let run = |more: &[&str]| {
        let flags = ["ride.csv", "--map", "lift.json", "--format", "json"];
        let report: Value =
            serde_json::from_str(&well(track(path, &[&flags[..], more].concat()))).unwrap();
        let floors = report["floors"].as_array().unwrap().clone();
        let visits = floors.iter().map(|floor| floor["visits"].as_u64().unwrap());
        (visits.sum::<u64>(), floors)
    };
    let (first, floors) = run(&[]);
    for (floor, height) in floors.iter().zip([0.0, 3.2, 6.4, 10.4]) {
        let number = |name: &str| floor[name].as_f64().unwrap();
        assert!(
            (number("height") - height).abs() < 5.0 * number("deviation") + 1e-9,
            "{floor}"
        );
    }
    let (second, again) = run(&["--at", "0"]);
    assert_eq!((floors.len(), again.len(), first, second), (4, 4, 5, 9));
    assert!(again[3]["deviation"].as_f64() < floors[3]["deviation"].as_f64());
    let kept = fs::read(path.join("lift.json")).unwrap();
    let given = [
        "ride.csv",
        "--map",
        "lift.json",
        "--floors",
        "0,3.2,6.4,10.4",
    ];
    for (change, message) in [
        (&kept[..kept.len() / 2], "lift.json: damaged: EOF"),
        (b"time,acceleration\n", "lift.json: no map of floors"),
    ] {
        fs::write(path.join("lift.json"), change).unwrap();
        let (code, out, err) = track(path, &given[..3]);
        assert_eq!((code, out.as_str()), (2, ""));
        assert!(
            err.contains(message) && err.trim_end().ends_with(')'),
            "{err}"
        );
        assert_eq!(fs::read(path.join("lift.json")).unwrap(), change);
    }
    let (code, _, err) = track(path, &given);
    assert_eq!(code, 2);
    assert!(
        err.contains("is a map already (leave out --floors"),
        "{err}"
    );
    well(track(path, &[&given[..], &["--force"]].concat()));
    well(track(path, &given[..3]));
}

#[test]
fn says_which_floors_it_cannot_use() {
    let directory = recorded(&["--still", "--rest", "20"]);
    for (flags, message) in [
        (&["--at", "0"][..], "--at: no floors are known (give"),
        (&["--floors", "0,3,2"], "--floors[2]: must lie more than"),
        (&["--floors", "0"], "--floors: must be at least 2"),
        (
            &["--floors", "0,3", "--at", "2"],
            "--at: must be one of 2 floors",
        ),
        (
            &["--map", "lift.json", "--at", "0"],
            "--at: there is no map yet",
        ),
        (&["--map", "ride.csv"], "used for something else too"),
        (&["--map", "no/lift.json"], "no folder no"),
    ] {
        let (code, out, err) = track(directory.path(), &[&["ride.csv"], flags].concat());
        assert_eq!((code, out.as_str()), (2, ""), "{flags:?}");
        assert!(err.contains(message), "{err}");
    }
    let (code, _, err) = track(directory.path(), &["ride.csv", "--map", "lift.json"]);
    assert!(code == 0 && err.contains("lift.json: not written"), "{err}");
    assert!(!directory.path().join("lift.json").exists());
}

/// The air's pressure at every second of a simulated ride, in hPa at 755 hPa and 20 °C; the record without gravity.
fn with_a_barometer(scale: f64) -> tempfile::TempDir {
    let directory = recorded(&["--trip", "up:18", "--trip", "down:9", "--speed", "1.2"]);
    let path = directory.path();
    let truth: Vec<(f64, f64, f64)> = fs::read_to_string(path.join("ride.truth.csv"))
        .unwrap()
        .lines()
        .skip(1)
        .map(|line| {
            let cell = |at: usize| line.split(',').nth(at).unwrap().parse().unwrap();
            (cell(0), cell(1), cell(3))
        })
        .collect();
    let text = fs::read_to_string(path.join("ride.csv")).unwrap();
    let last = text.lines().last().unwrap();
    let end: f64 = last.split(',').next().unwrap().parse().unwrap();
    let rows = (0..=end as usize).map(|second| {
        let time = second as f64;
        // The speed rises to 1.2 m/s in a ramp, and falls as it rose.
        let gone = |(start, stop, distance): &(f64, f64, f64)| {
            let uniform = distance.abs() / 1.2;
            let ramp = stop - start - uniform;
            let begun = |time: f64| {
                let rising = time.clamp(0.0, ramp);
                1.2 * (rising * rising / (2.0 * ramp) + (time - ramp).max(0.0))
            };
            let moved = time - start;
            distance.signum() * (begun(moved) - begun(moved - uniform))
        };
        let height: f64 = truth.iter().map(gone).sum();
        let pressure = 755.0 * scale * libm::exp(-height * 9.80665 / (287.05 * 293.15));
        format!("{time},{pressure}\n")
    });
    let rows: String = rows.collect();
    fs::write(path.join("air.csv"), "time,pressure\n".to_owned() + &rows).unwrap();
    directory
}

/// The heights of the rides are their distances, whatever the unit; with the air 29.3 K colder they are a tenth shorter.
#[test]
fn a_barometer_gives_heights() {
    for scale in [1.0, 100.0, 0.1] {
        let directory = with_a_barometer(scale);
        let path = directory.path();
        let flags = ["ride.csv", "--barometer", "air.csv", "--format", "json"];
        let (code, out, err) = track(path, &flags);
        assert_eq!(code, 0, "{err}");
        let found = rides(&out);
        for (ride, truth) in found.iter().zip(truth(path)) {
            let height = ride["height"].as_f64().unwrap();
            assert!((height - truth).abs() < 0.2, "{ride}");
        }
        let (_, out, _) = track(path, &[&flags[..], &["--temperature", "-9.315"]].concat());
        for (ride, truth) in rides(&out).iter().zip(truth(path)) {
            let height = ride["height"].as_f64().unwrap();
            assert!((height / truth - 0.9).abs() < 0.005, "{ride}");
        }
        let out = well(track(path, &["ride.csv", "--barometer", "air.csv"]));
        assert!(
            out.contains("barometer: air.csv, \"pressure\"") && out.contains("height"),
            "{out}"
        );
    }
}

/// Without gravity a record may be upside down. The barometer turns it, unless the user said which way is up.
#[test]
fn a_barometer_says_which_way_is_up() {
    let directory = with_a_barometer(1.0);
    let path = directory.path();
    let text = fs::read_to_string(path.join("ride.csv")).unwrap();
    let rows = text.lines().skip(1).map(|line| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        format!("{},{}\n", cells[0], -cells[3])
    });
    let rows: String = rows.collect();
    let turned = "time,acceleration\n".to_owned() + &rows;
    fs::write(path.join("acceleration.csv"), turned).unwrap();
    let directions = |flags: &[&str]| {
        let flags = [&["acceleration.csv", "--format", "json"], flags].concat();
        let (code, out, err) = track(path, &flags);
        assert_eq!(code, 0, "{err}");
        let of = |ride: &Value| ride["direction"].as_str().unwrap().to_owned();
        (rides(&out).iter().map(of).collect::<Vec<_>>(), out, err)
    };
    let (alone, ..) = directions(&[]);
    assert_eq!(alone, ["down", "up"]);
    let (right, out, err) = directions(&["--barometer", "air.csv"]);
    assert_eq!(right, ["up", "down"]);
    assert!(
        out.contains("up as the barometer says") && !err.contains("up is down"),
        "{out} {err}"
    );
    let (told, _, err) = directions(&["--barometer", "air.csv", "--acceleration", "acceleration"]);
    assert_eq!(told, ["down", "up"]);
    assert!(err.contains("by the barometer up is down"), "{err}");
    // One beside it is found, and left out where asked.
    fs::rename(path.join("air.csv"), path.join("pressure.csv")).unwrap();
    assert_eq!(directions(&[]).0, ["up", "down"]);
    assert_eq!(directions(&["--no-barometer"]).0, ["down", "up"]);
    // Not that of another day, nor an altitude, nor where the user said how the clock is read.
    fs::rename(path.join("pressure.csv"), path.join("pressure_monday.csv")).unwrap();
    assert_eq!(directions(&[]).0, ["down", "up"]);
    fs::write(path.join("barometer.csv"), "time,altitude (m)\n0,9\n50,0\n").unwrap();
    assert_eq!(directions(&[]).0, ["down", "up"]);
    fs::rename(path.join("pressure_monday.csv"), path.join("barometer.csv")).unwrap();
    assert_eq!(directions(&[]).0, ["up", "down"]);
    assert_eq!(directions(&["--time", "time"]).0, ["down", "up"]);
}

#[test]
fn a_barometer_that_cannot_be_used() {
    let directory = with_a_barometer(1.0);
    let path = directory.path();
    for (text, message) in [
        (
            "time,pressure\n100,755\n101,755\n".to_owned(),
            "are not those of the recording, 0.0 to",
        ),
        (
            "time,pressure\n1700000000,755\n1700000050,755\n".to_owned(),
            "only one of the two clocks has dates, and the clocks cannot be aligned, because nowhere",
        ),
        (
            "time,pressure\n0,7\n1,7\n".to_owned(),
            "name its unit in the header",
        ),
        (
            "time,az\n0,9\n1,9\n".to_owned(),
            "no column looks like the pressure",
        ),
    ] {
        fs::write(path.join("bad.csv"), &text).unwrap();
        let (code, out, err) = track(path, &["ride.csv", "--barometer", "bad.csv"]);
        assert_eq!((code, out.as_str()), (2, ""), "{text}");
        assert!(err.contains(message) && err.contains("bad.csv"), "{err}");
    }
    let flags = [
        "ride.csv",
        "--barometer",
        "air.csv",
        "--figure",
        "air.csv",
        "--force",
    ];
    assert_eq!(track(path, &flags).0, 2);
    let (code, _, err) = track(path, &["ride.csv", "--temperature", "400"]);
    assert_eq!(code, 2);
    assert!(err.contains("must be a temperature of -60 to 60"), "{err}");
    // One that was found beside it, and cannot be used, is only warned of.
    fs::copy(path.join("ride.csv"), path.join("acceleration.csv")).unwrap();
    fs::rename(path.join("bad.csv"), path.join("barometer.csv")).unwrap();
    let (code, out, err) = track(path, &["acceleration.csv"]);
    assert_eq!(code, 0, "{err}");
    assert!(
        err.contains("the barometer is not used: ") && !out.contains("barometer:"),
        "{err}"
    );
}

/// A change of the readings of a barometer: times, s, and pressures, hPa.
type Change<'a> = &'a dyn Fn(&mut Vec<(f64, f64)>);

fn readings(path: &Path) -> Vec<(f64, f64)> {
    let text = fs::read_to_string(path.join("air.csv")).unwrap();
    let rows = text
        .lines()
        .skip(1)
        .map(|line| line.split_once(',').unwrap());
    let rows = rows.map(|(time, pressure)| (time.parse().unwrap(), pressure.parse().unwrap()));
    rows.collect()
}

fn written(path: &Path, header: &str, readings: &[(f64, f64)]) {
    let rows = readings
        .iter()
        .map(|(time, pressure)| format!("{time},{pressure}\n"));
    fs::write(
        path.join("bad.csv"),
        header.to_owned() + &rows.collect::<String>(),
    )
    .unwrap();
}

/// What is wrong with a barometer is said, and the rides that it does not concern keep their heights.
#[test]
fn faults_of_a_barometer_are_said() {
    let directory = with_a_barometer(1.0);
    let path = directory.path();
    let sound = readings(path);
    let truth = rides(&track(path, &["ride.csv", "--format", "json"]).1);
    let [start, stop, next, end] = [(0, "start"), (0, "stop"), (1, "start"), (1, "stop")]
        .map(|(ride, name)| truth[ride][name].as_f64().unwrap());
    let within = |from: f64, to: f64| move |it: &(f64, f64)| from < it.0 && it.0 < to;
    let named = "time,pressure (hPa)\n";
    let cases: &[(&str, &str, Change, &str, [bool; 2])] = &[
        (
            "frozen",
            named,
            &|it| it.iter_mut().for_each(|it| it.1 = 755.0),
            "ride 1: no height, the barometer is frozen",
            [false; 2],
        ),
        (
            "frozen later",
            named,
            &|it| {
                it.iter_mut()
                    .filter(|it| it.0 > next - 1.0)
                    .for_each(|it| it.1 = 753.4)
            },
            "ride 2: no height, the barometer is frozen",
            [true, false],
        ),
        (
            "coarse",
            named,
            &|it| it.iter_mut().for_each(|it| it.1 = it.1.round()),
            "steps of 11.",
            [false; 2],
        ),
        (
            "NaN",
            named,
            &|it| it[3].1 = f64::NAN,
            "1 rows of the barometer have NaN",
            [true; 2],
        ),
        (
            "repeated",
            named,
            &|it| it[3].0 = it[2].0,
            "1 readings of the barometer repeat a time",
            [true; 2],
        ),
        (
            "no air",
            named,
            &|it| it[3].1 = 0.0,
            "1 readings of the barometer are of no air on earth",
            [true; 2],
        ),
        (
            "silent in a ride",
            named,
            &|it| it.retain(|it| !within(start + 3.0, stop - 3.0)(it)),
            "ride 1: the barometer has no reading for",
            [true; 2],
        ),
        (
            "silent after it",
            named,
            &|it| it.retain(|it| it.0 < end),
            "ride 2: no height, the barometer has no reading",
            [true, false],
        ),
        (
            "a jump at rest",
            named,
            &|it| {
                it.iter_mut()
                    .filter(|it| it.0 > next - 3.0)
                    .for_each(|it| it.1 -= 0.3)
            },
            "ride 2: at rest beside it the barometer jumps by +3.",
            [true; 2],
        ),
        (
            "a jump in a ride",
            named,
            &|it| {
                it.iter_mut()
                    .filter(|it| it.0 > start + 6.0)
                    .for_each(|it| it.1 -= 0.5)
            },
            "ride 1: by the barometer it went +2",
            [false, true],
        ),
        (
            "no header",
            "",
            &|_| {},
            "the barometer's columns have no names",
            [true; 2],
        ),
        (
            "Pa",
            "",
            &|it| it.iter_mut().for_each(|it| it.1 *= 100.0),
            "(Pa)",
            [true; 2],
        ),
        (
            "kPa",
            "",
            &|it| it.iter_mut().for_each(|it| it.1 /= 10.0),
            "(kPa)",
            [true; 2],
        ),
        (
            "not overlapping",
            named,
            &|it| it.iter_mut().for_each(|it| it.0 += 500.0),
            "behind by the rides",
            [true; 2],
        ),
        (
            "dates",
            named,
            &|it| it.iter_mut().for_each(|it| it.0 += 1.7e9),
            "behind by the rides",
            [true; 2],
        ),
        (
            "another clock",
            named,
            &|it| it.iter_mut().for_each(|it| it.0 += 7.0),
            "the rides are believed",
            [true; 2],
        ),
    ];
    for (name, header, change, sentence, has_height) in cases {
        let mut rows = sound.clone();
        change(&mut rows);
        written(path, header, &rows);
        let flags = ["ride.csv", "--barometer", "bad.csv"];
        let (code, out, err) = track(path, &flags);
        assert_eq!(code, 0, "{name}: {err}");
        assert!(
            [&out, &err].iter().any(|it| it.contains(sentence)),
            "{name}: {out} {err}"
        );
        assert!(!out.contains("deviation 0.00 m"), "{name}: {out}");
        let (_, out, _) = track(path, &[&flags[..], &["--format", "json"]].concat());
        for ((ride, distance), has_height) in rides(&out).iter().zip([18.0, -9.0]).zip(has_height) {
            let height = ride["height"].as_f64();
            let is_right = height.is_some_and(|it| (it - distance).abs() < 0.3);
            assert_eq!(is_right, *has_height, "{name}: {ride}");
        }
    }
    // Sound ones are passed over.
    let (_, _, err) = track(path, &["ride.csv", "--barometer", "air.csv"]);
    assert!(!err.contains("barometer"), "{err}");
}

/// The offset of two clocks is in the report; a flag overrides it.
#[test]
fn clocks_are_aligned_by_the_rides() {
    let directory = with_a_barometer(1.0);
    let path = directory.path();
    let mut rows = readings(path);
    rows.iter_mut().for_each(|it| it.0 += 7.0);
    written(path, "time,pressure (hPa)\n", &rows);
    let flags = ["ride.csv", "--barometer", "bad.csv", "--format", "json"];
    let report = |more: &[&str]| {
        let (code, out, err) = track(path, &[&flags, more].concat());
        assert_eq!(code, 0, "{err}");
        serde_json::from_str::<Value>(&out).unwrap()["barometer"]["alignment"].clone()
    };
    let alignment = report(&[]);
    let number = |name: &str| alignment[name].as_f64().unwrap();
    assert!(
        (number("ahead") + 7.0).abs() < 0.3 && number("deviation") < 0.2,
        "{alignment}"
    );
    assert_eq!(number("instead_of"), 0.0);
    for given in ["0", "-7"] {
        assert!(report(&["--barometer-ahead", given]).is_null(), "{given}");
    }
    let far = [&flags[..], &["--barometer-ahead", "900"]].concat();
    let none = ["ride.csv", "--barometer-ahead", "9"];
    for (flags, message) in [
        (&far[..], "give another --barometer-ahead"),
        (&none, "give --barometer FILE"),
    ] {
        let (code, _, err) = track(path, flags);
        assert!(code == 2 && err.contains(message), "{err}");
    }
}

/// Of two columns the first is taken, aloud, unless one is named.
#[test]
fn the_column_of_a_barometer_is_chosen() {
    let directory = with_a_barometer(1.0);
    let path = directory.path();
    let rows = readings(path).into_iter();
    let rows = rows.map(|(time, pressure)| format!("{time},{pressure},{}\n", pressure - 10.0));
    let text = "time,pressure (hPa),baro (hPa)\n".to_owned() + &rows.collect::<String>();
    fs::write(path.join("two.csv"), text).unwrap();
    let flags = ["ride.csv", "--barometer", "two.csv"];
    let (_, out, err) = track(path, &flags);
    let said = "\"pressure (hPa)\" is read, and not \"baro (hPa)\" (--barometer-column COLUMN";
    assert!(
        out.contains("two.csv, \"pressure (hPa)\"") && err.contains(said),
        "{err}"
    );
    let (_, out, err) = track(
        path,
        &[&flags[..], &["--barometer-column", "baro (hPa)"]].concat(),
    );
    assert!(
        out.contains("two.csv, \"baro (hPa)\"") && !err.contains("is read, and not"),
        "{err}"
    );
    let (code, _, err) = track(
        path,
        &[&flags[..], &["--barometer-column", "bar (hPa)"]].concat(),
    );
    assert!(
        code == 2 && err.contains("did you mean \"baro (hPa)\"?"),
        "{err}"
    );
}

/// The quality of rides whose acceleration, jerk and speed are known.
#[test]
fn quality_is_that_of_the_ride() {
    let directory = recorded(&[
        "--acceleration",
        "0.8",
        "--jerk",
        "1",
        "--speed",
        "1.6",
        "--trip",
        "up:20",
    ]);
    let path = directory.path();
    let said = track(path, &["ride.csv", "--quality", "--format", "json"]);
    let ride = &rides(&said.1)[0];
    for (figure, expected) in [
        ("acceleration", 0.8),
        ("acceleration_95", 0.8),
        ("deceleration", 0.8),
        ("top_speed", 1.6),
        ("speed_95", 1.6),
        ("jerk", 1.0),
    ] {
        let found = ride["quality"][figure]["value"].as_f64().unwrap();
        assert!((found / expected - 1.0).abs() < 0.15, "{figure}: {found}");
    }
    let rest = ride["quality"]["horizontal"]["at_rest"].as_f64().unwrap();
    assert!((0.001..0.1).contains(&rest), "{rest}");
    let recorded = fs::read_to_string(path.join("ride.csv")).unwrap();
    let of_row = |line: &str| {
        [0, 3]
            .map(|at| line.split(',').nth(at).unwrap().to_owned())
            .join(",")
    };
    let one: Vec<String> = recorded.lines().map(of_row).collect();
    fs::write(path.join("one.csv"), one.join("\n")).unwrap();
    let said = track(path, &["one.csv", "--quality", "--format", "json"]);
    assert!(
        said.2.contains("horizontal vibration is not judged"),
        "{}",
        said.2
    );
    let one = &rides(&said.1)[0]["quality"];
    assert!(one["horizontal"].is_null());
    let [alone, projected] =
        [one, &ride["quality"]].map(|it| it["vertical"]["value"].as_f64().unwrap());
    assert!(
        (alone / projected - 1.0).abs() < 1e-3,
        "{alone} {projected}"
    );
    let csv = track(path, &["ride.csv", "--quality", "--format", "csv"]).1;
    assert!(
        csv.lines()
            .next()
            .unwrap()
            .ends_with(",horizontal,horizontal_95"),
        "{csv}"
    );
    let table = track(path, &["ride.csv", "--quality"]).1;
    assert!(table.contains("the limits at 1.6"), "{table}");
    assert!(!track(path, &["ride.csv"]).1.contains("quality"));
}

/// What cannot be judged is said, with the remedy.
#[test]
fn quality_that_is_not_in_the_record() {
    let directory = recorded(&["--rate", "10"]);
    let said = track(directory.path(), &["ride.csv", "--quality"]);
    assert!(
        said.2.contains("no ride is judged: at 10.0 Hz"),
        "{}",
        said.2
    );
    assert!(said.1.contains("no ride is judged"), "{}", said.1);
    for flags in [
        &["--rated-speed", "1"][..],
        &["--quality", "--rated-speed", "0"],
    ] {
        let refused = track(directory.path(), &[&["ride.csv"], flags].concat());
        assert_eq!(refused.0, 2, "{flags:?}");
    }
}

/// The published rules find the same ride, to a few centimetres, and stand beside it.
#[test]
fn published_rules_for_comparison() {
    let directory = recorded(&["--trip", "up:20"]);
    let path = directory.path();
    let said = track(path, &["ride.csv", "--rules", "--format", "json"]).1;
    let said: serde_json::Value = serde_json::from_str(&said).unwrap();
    let rules = &said["rules"];
    let [trip] = &rules["trips"].as_array().unwrap()[..] else {
        panic!("{rules}");
    };
    assert!(
        (trip["distance"].as_f64().unwrap() - 20.0).abs() < 0.5,
        "{trip}"
    );
    assert_eq!(trip["direction"], "up");
    assert!(rules["threshold"].as_f64().unwrap() > 3.0 * rules["noise"].as_f64().unwrap());
    let table = track(path, &["ride.csv", "--rules=0.3"]).1;
    assert!(
        table.contains("by the published rules, with a threshold of 0.300 m/s²"),
        "{table}"
    );
    assert!(!track(path, &["ride.csv"]).1.contains("published"));
    let refused = track(path, &["ride.csv", "--rules=0"]);
    assert_eq!(refused.0, 2);
    assert!(
        refused.2.contains("above 0 and up to 5 m/s^2"),
        "{}",
        refused.2
    );
}

/// A baseline of trips whose windows are all below 0.0043 m²/s⁴, learnt at 100 Hz.
pub(super) fn with_a_baseline(directory: &Path) {
    let trip = |trip: u32| {
        (0..40)
            .map(|at| 3e-3 + 1e-6 * f64::from(40 * trip + at))
            .collect()
    };
    let trips: Vec<Vec<f64>> = (0..30).map(trip).collect();
    let file = serde_json::json!({
        "format": "liftsim vibration baseline",
        "version": 1,
        "rate": 100.0,
        "trips": trips,
    });
    fs::write(directory.join("lift.json"), file.to_string()).unwrap();
}

/// The ride of `ride.csv`, up 12 m from 8.0 to 27.1 s, with a knock along x at 17.555 s, when it is half way.
fn knocked(directory: &Path) {
    let text = fs::read_to_string(directory.join("ride.csv")).unwrap();
    let knocked = text.lines().map(|line| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        let time = cells[0].parse::<f64>().unwrap_or(0.0);
        if (17.55..17.6).contains(&time) {
            cells[1] = (cells[1].parse::<f64>().unwrap() + 3.0).to_string();
        }
        cells.join(",") + "\n"
    });
    let knocked: String = knocked.collect();
    fs::write(directory.join("knocked.csv"), knocked).unwrap();
}

/// Whole rides are learnt, each once, as long as the baseline has not settled.
#[test]
fn a_baseline_is_learnt() {
    let directory = recorded(&[]);
    let path = directory.path();
    let first = well(track(path, &["ride.csv", "--baseline", "lift.json"]));
    assert!(first.contains("2 of about 29 trips, 7"), "{first}");
    assert!(first.contains("has not settled"), "{first}");
    let file = fs::read(path.join("lift.json")).unwrap();
    let flags = ["ride.csv", "--baseline", "lift.json", "--format", "json"];
    let again: Value = serde_json::from_str(&well(track(path, &flags))).unwrap();
    let vibration = &again["vibration"];
    assert_eq!(
        (&vibration["trips"], &vibration["guard"]),
        (&2.into(), &Value::Null)
    );
    assert_eq!(vibration["rides"][1]["used"], "known");
    assert_eq!(fs::read(path.join("lift.json")).unwrap(), file);
    assert!(!well(track(path, &["ride.csv"])).contains("vibration"));
}

/// A knock is found beside a settled baseline, where the car was, and drawn; the other ride is usual, and nothing is learnt.
#[test]
fn a_knock_is_located() {
    let directory = recorded(&[]);
    let path = directory.path();
    with_a_baseline(path);
    knocked(path);
    let before = fs::read_to_string(path.join("lift.json")).unwrap();
    let floors = ["--floors", "0,9,12", "--at", "0"];
    let flags = [
        &[
            "knocked.csv",
            "--baseline",
            "lift.json",
            "--spectrum",
            "spectrum.png",
        ],
        &floors[..],
    ];
    let json = [flags.concat(), vec!["--format", "json"]].concat();
    let report: Value = serde_json::from_str(&well(track(path, &json))).unwrap();
    let vibration = &report["vibration"];
    assert_eq!(vibration["guard"]["guard"], "order_statistic");
    let alarms = vibration["rides"][0]["alarms"].as_array().unwrap();
    assert_eq!(alarms.len(), 1, "{alarms:?}");
    for name in ["position", "height"] {
        let place = alarms[0][name].as_f64().unwrap();
        assert!((place - 6.0).abs() < 0.15, "{name} {place}");
    }
    let time = alarms[0]["time"].as_f64().unwrap();
    assert!((17.54..17.61).contains(&time), "{time}");
    assert_eq!(vibration["rides"][1]["alarms"].as_array().unwrap().len(), 0);
    assert!(fs::metadata(path.join("spectrum.png")).unwrap().len() > 10_000);
    let table = track(
        path,
        &[&["knocked.csv", "--baseline", "lift.json"], &floors[..]].concat(),
    )
    .1;
    assert!(
        table.contains("ride 1: alarm, 0.") && table.contains("above the lowest floor"),
        "{table}"
    );
    let csv = track(
        path,
        &["knocked.csv", "--baseline", "lift.json", "--format", "csv"],
    )
    .1;
    let ends: Vec<&str> = csv
        .lines()
        .skip(1)
        .map(|it| it.rsplit(',').next().unwrap())
        .collect();
    assert_eq!(ends, ["1", "0"]);
    let after: Value =
        serde_json::from_str(&fs::read_to_string(path.join("lift.json")).unwrap()).unwrap();
    assert_eq!(after, serde_json::from_str::<Value>(&before).unwrap());
}

/// What holds no such vibration is refused, and so is a file that is no baseline; each with a remedy.
#[test]
fn vibration_that_is_not_in_the_record() {
    let directory = recorded(&["--rate", "50"]);
    let path = directory.path();
    with_a_baseline(path);
    let flags = ["--baseline", "lift.json"];
    let refused = |file: &str, more: &[&str]| {
        let (code, out, err) = track(path, &[&[file], more].concat());
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        err
    };
    let unlike = refused("ride.csv", &flags);
    assert!(
        unlike.contains("learnt at 100.0 Hz") && unlike.contains("(begin"),
        "{unlike}"
    );
    let text = fs::read_to_string(path.join("ride.csv")).unwrap();
    let alone = text.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        format!("{},{}\n", cells[0], cells[3])
    });
    fs::write(path.join("one.csv"), alone.collect::<String>()).unwrap();
    let one = refused("one.csv", &["--baseline", "new.json"]);
    assert!(
        one.contains("only one axis was read (record all three"),
        "{one}"
    );
    assert!(!path.join("new.json").exists());
    let foreign = refused("ride.csv", &["--baseline", "ride.truth.csv"]);
    assert!(foreign.contains("no baseline of vibration"), "{foreign}");
    let rate = refused("ride.csv", &[&flags[..], &["--alarm-rate", "1"]].concat());
    assert!(rate.contains("must be a share"), "{rate}");
    let same = refused("ride.csv", &["--baseline", "ride.csv"]);
    assert!(same.contains("give another name"), "{same}");
    let slow = recorded(&["--rate", "10"]);
    let (code, _, err) = track(slow.path(), &["ride.csv", "--baseline", "new.json"]);
    assert!(
        code == 2 && err.contains("10.0 Hz holds no vibration"),
        "{err}"
    );
}

/// A monitor tells each trip once, as `track` measures it, its floor, and an alarm where none is; the map is kept.
#[test]
fn a_monitor_tells_trips() {
    let directory = recorded(&["--trip", "up:12", "--trip", "down:7", "--rest", "12"]);
    let path = directory.path();
    let text = fs::read_to_string(path.join("ride.csv")).unwrap();
    let lines = text.lines().skip(1).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        format!("{},{}\n", cells[0], cells[3])
    });
    let lines: String = lines.collect();
    let flags = [
        "monitor", "--begins", "rest", "--floors", "0,4,12", "--at", "0",
    ];
    let mut command = liftsim();
    command
        .current_dir(path)
        .args(flags)
        .args(["--map", "lift.json"]);
    let (code, out, said) = outcome(command.write_stdin(lines.clone()));
    assert_eq!(code, 0, "{said}");
    let events: Vec<Value> = out
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let trips: Vec<&Value> = events.iter().filter_map(|it| it.get("trip")).collect();
    let report = well(track(path, &["ride.csv", "--format", "json"]));
    let measured = rides(&report);
    assert_eq!(trips.len(), 2, "{out}");
    for (trip, ride) in trips.iter().zip(&measured) {
        let [told, found] = [trip, &ride].map(|it| it["distance"].as_f64().unwrap());
        assert!((told - found).abs() < 0.02, "{trip} {ride}");
        assert_eq!(trip["ride"], ride["ride"]);
    }
    assert_eq!(trips[0]["landing"]["floor"], 2);
    let alarms: Vec<&Value> = events.iter().filter_map(|it| it.get("alarm")).collect();
    assert_eq!(alarms, ["between_floors"], "{out}");
    assert!(path.join("lift.json").exists());
    assert!(!said.contains("tilted"), "{said}");
    // Read by an axis that is not vertical.
    let first: f64 = lines.split([',', '\n']).nth(1).unwrap().parse().unwrap();
    let tilted = lines.lines().map(|line| {
        let (time, reading) = line.split_once(',').unwrap();
        let reading: f64 = reading.parse().unwrap();
        format!("{time},{}\n", reading - first + 7.0)
    });
    let mut command = liftsim();
    command.args(["monitor", "--begins", "rest", "--trips"]);
    let (_, _, said) = outcome(command.write_stdin(tilted.collect::<String>()));
    assert_eq!(said.matches("it is tilted").count(), 1, "{said}");
    // From the map alone.
    let mut command = liftsim();
    command
        .current_dir(path)
        .args(["monitor", "--rate", "100", "--map", "none/lift.json"]);
    let refused = outcome(command.write_stdin("0.01\n"));
    assert_eq!(refused.0, 2, "{refused:?}");
}

/// A record of many rides is drawn and put on a page too.
#[test]
fn a_day_of_rides_is_drawn() {
    let trips: Vec<&str> = (0..40)
        .flat_map(|trip| ["--trip", if trip % 2 == 0 { "up:4" } else { "down:4" }])
        .collect();
    let directory = recorded(&trips);
    let flags = ["ride.csv", "--figure", "day.svg", "--report", "day.html"];
    let said = track(directory.path(), &flags);
    assert_eq!(said.0, 0, "{}", said.2);
    assert!(said.1.lines().count() > 30, "{}", said.1);
    let page = fs::read_to_string(directory.path().join("day.html")).unwrap();
    assert!(page.contains("rides in"), "{page}");
}
