//! Every message that names a flag: it appears, the flag is given as it says, it is gone, and the ride is told.

use super::{liftsim, outcome};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A message and its remedy.
struct Case {
    /// The recording, or the lines of a pipe.
    text: String,
    /// With these flags it says this.
    wrong: &'static [&'static str],
    says: &'static str,
    /// With these it does not, and its output holds this.
    right: &'static [&'static str],
    gives: &'static str,
}

fn case(
    text: String,
    wrong: &'static [&'static str],
    says: &'static str,
    right: &'static [&'static str],
) -> Case {
    Case {
        text,
        wrong,
        says,
        right,
        gives: "   1  up",
    }
}

const GRAVITY: f64 = 9.80665;

/// From −1/2 to 1/2.
fn noise(i: u32) -> f64 {
    f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5
}

/// A change of speed by `speed`, m/s, which lasts 1.5 s.
fn pulse(time: f64, speed: f64) -> f64 {
    (2.0 * time).min(2.0 * (1.5 - time)).clamp(0.0, 1.0) * speed
}

/// A ride up from 8.0 to 21.5 s in 34 s at 100 Hz: in each row what `row` makes of its number, its time and the
/// acceleration, without gravity.
fn ride_at(speed: f64, head: &str, row: impl Fn(u32, f64, f64) -> String) -> String {
    let row = |i: u32| {
        let time = f64::from(i) / 100.0;
        let acceleration = pulse(time - 8.0, speed) - pulse(time - 20.0, speed);
        row(i, time, acceleration + 0.03 * noise(i)) + "\n"
    };
    head.to_owned() + &(0..3400).map(row).collect::<String>()
}

fn ride(head: &str, row: impl Fn(u32, f64, f64) -> String) -> String {
    ride_at(1.0, head, row)
}

/// With a time and one acceleration, so many times that in m/s² with gravity.
fn scaled(scale: f64) -> String {
    ride("time,az\n", |_, t, a| {
        format!("{t},{}", scale * (GRAVITY + a))
    })
}

fn slow(speed: f64) -> String {
    ride_at(speed, "time,az\n", |_, t, a| format!("{t},{}", GRAVITY + a))
}

/// The ride, and another at half its speed: read upside down, a lift that speeds up and slows down without a stop.
fn two_speeds() -> String {
    let row = |t: f64, a: f64| format!("{t},{}", GRAVITY + a);
    let slower = ride_at(0.5, "", |_, t, a| row(34.0 + t, a));
    ride("time,az\n", |_, t, a| row(t, a)) + &slower
}

/// The last part of the ride, which begins in motion or at rest.
fn late() -> String {
    let whole = scaled(1.0);
    let rows = whole.lines().skip(1201);
    "time,az\n".to_owned() + &rows.map(|row| row.to_owned() + "\n").collect::<String>()
}

/// Pushes without gravity for four minutes, two to either side in turn, before the ride.
fn pushed() -> String {
    let rows = (0..24000).map(|i| {
        let time = f64::from(i) / 100.0;
        let sign = if time % 8.0 < 4.0 { 0.2 } else { -0.2 };
        let push = sign * pulse(time % 2.0, 1.0) + 0.03 * noise(i);
        format!("{time},{push}\n")
    });
    let ride = ride("", |_, t, a| format!("{},{a}", 240.0 + t));
    "time,az\n".to_owned() + &rows.collect::<String>() + &ride
}

/// What cannot be read, or is read wrongly.
fn of_reading() -> Vec<Case> {
    let json = ride("", |_, t, a| {
        format!(
            "{{\"sensor\":\"Lift\",\"seconds_elapsed\":\"{t}\",\"z\":\"{}\"}},",
            GRAVITY + a
        )
    });
    let json = format!("[{}]", json.trim_end().trim_end_matches(','));
    let logger = || {
        ride("time,seconds_elapsed,z,y,x\n", |i, t, a| {
            let (y, x) = (0.001 * noise(i + 1), 0.001 * noise(i + 2));
            format!("{i},{t},{},{y},{x}", -a / GRAVITY)
        })
    };
    let total = |_, t, a| format!("{t},{}", GRAVITY + a);
    vec![
        case(
            ride("time,x,lift\n", |_, t, a| format!("{t},0,{}", 9.8 + a)),
            &["--axis", "z"],
            "(--acceleration COLUMN)",
            &["--acceleration", "lift"],
        ),
        case(
            ride("", |_, t, a| format!("{t},1,2,{},5", 9.8 + a)),
            &[],
            "--time 1 --acceleration 4",
            &["--time", "1", "--acceleration", "4"],
        ),
        case(
            ride("az\n", |_, _, a| format!("{}", 9.8 + a)),
            &["--rate", "0"],
            "(--rate HZ)",
            &["--rate", "100"],
        ),
        case(json, &[], "(--member NAME)", &["--member", "Lift"]),
        case(
            ride("time,acceleration,lift\n", |_, t, a| {
                format!("{t},0,{}", 9.8 + a)
            }),
            &[],
            "choose another column with --acceleration",
            &["--acceleration", "lift"],
        ),
        case(
            ride("time,clock,az\n", |_, t, a| format!("0,{t},{}", 9.8 + a)),
            &[],
            "choose another column with --time",
            &["--time", "clock"],
        ),
        case(
            ride("", |i, t, a| {
                format!("{t},{},{},{}", 9.8 + a, noise(i + 1), noise(i + 2))
            }),
            &[],
            "(--time and --acceleration choose others)",
            &["--time", "1", "--acceleration", "2"],
        ),
        case(
            scaled(1.0 / GRAVITY),
            &[],
            "as readings in g have it",
            &["--unit", "g"],
        ),
        case(
            scaled(1000.0 / GRAVITY),
            &[],
            "as readings in mg have it",
            &["--unit", "mg"],
        ),
        case(
            scaled(16384.0 / GRAVITY),
            &[],
            "as 16384 counts per g have it",
            &["--unit", "counts", "--scale", "5.985e-4"],
        ),
        case(
            scaled(2048.0 / GRAVITY),
            &["--unit", "m/s^2"],
            "(give the unit with --unit)",
            &["--unit", "counts", "--scale", "4.788e-3"],
        ),
        case(
            scaled(2e8),
            &[],
            "check the unit: --unit m/s^2, g, mg or counts",
            &["--unit", "counts", "--scale", "5e-9"],
        ),
        case(
            ride("time,az\n", |_, t, a| format!("{t},{}", 2e4 * a)),
            &[],
            "(give the unit: --unit g, mg, or counts with --scale)",
            &["--unit", "counts", "--scale", "5e-5"],
        ),
        case(
            scaled(0.5),
            &[],
            "(check the unit: --unit g, mg, or counts with --scale; or the sensor is tilted: lay it flat",
            &["--unit", "counts", "--scale", "2"],
        ),
        case(
            logger(),
            &[],
            "(--unit m/s^2 says otherwise)",
            &["--unit", "g"],
        ),
        Case {
            gives: "   1  down",
            ..case(logger(), &[], "(--invert)", &["--invert"])
        },
        Case {
            gives: "no rides",
            ..case(
                ride("time,x,y,z\n", |i, t, _| {
                    format!("{t},{},{},{}", noise(i), noise(i + 1), noise(i + 2))
                }),
                &[],
                "(--axis x, y or z)",
                &["--axis", "z"],
            )
        },
        case(
            ride("time,Absolute acceleration (m/s^2),lift\n", |_, t, a| {
                format!("{t},{},{a}", a.abs())
            }),
            &[],
            "(--acceleration COLUMN)",
            &["--acceleration", "lift"],
        ),
        case(
            ride("time,az\n", |_, t, a| total(0, t.floor(), a)),
            &[],
            "(--rate HZ, if they come at a rate)",
            &["--rate", "100"],
        ),
        case(
            ride("time,az\n", |i, t, a| total(0, t + 0.003 * noise(i + 7), a)),
            &[],
            "(--resample HZ evens it out)",
            &["--resample", "100"],
        ),
    ]
}

/// What detection cannot tell by itself.
fn of_detection() -> Vec<Case> {
    let at_a_least = "use --lift slow, or a lower --least-speed";
    vec![
        case(
            pushed(),
            &[],
            "by --from and --to",
            &["--from", "240", "--to", "274"],
        ),
        case(slow(0.15), &[], at_a_least, &["--lift", "slow"]),
        case(slow(0.15), &[], at_a_least, &["--least-speed", "0.1"]),
        case(
            slow(0.15),
            &["--state", "lift.json"],
            "leave out --state and use --lift slow",
            &["--lift", "slow"],
        ),
        case(
            two_speeds(),
            &["--begins", "motion"],
            "(leave out --begins to see what it says itself)",
            &[],
        ),
        case(
            late(),
            &[],
            "(say how the record begins: --begins rest or --begins motion)",
            &["--begins", "motion"],
        ),
        case(
            ride("time,az\n", |i, t, a| {
                let row = format!("{t},{}", GRAVITY + a);
                if i % 2 == 0 { row } else { "#".to_owned() }
            }),
            &["--state", "lift.json"],
            "(use --resample 100.0)",
            &["--state", "lift.json", "--resample", "100.0"],
        ),
    ]
}

/// What a monitor cannot read.
fn of_a_monitor() -> Vec<Case> {
    let plain = || ride("", |_, t, a| format!("{t},{}", GRAVITY + a));
    let cases = vec![
        case(
            ride("", |_, _, a| format!("{}", GRAVITY + a)),
            &["--begins", "rest"],
            "(give --rate)",
            &["--begins", "rest", "--rate", "100"],
        ),
        case(
            plain(),
            &["--begins", "rest", "--rate", "50"],
            "leave --rate out where samples have times",
            &["--begins", "rest"],
        ),
        case(
            plain(),
            &["--begins", "rest", "--expected-moving"],
            "(leave out --expected-moving)",
            &["--begins", "rest"],
        ),
        case(
            ride("time,x,y,z\n", |_, t, a| format!("{t},0,0,{}", 9.8 + a)),
            &["--begins", "rest"],
            "(choose one: --axis x, y or z",
            &["--begins", "rest", "--axis", "z"],
        ),
        case(
            ride("", |_, t, a| format!("{t},{}", 1e5 * a)),
            &["--begins", "rest"],
            "(give the unit: --unit g, mg, or counts with --scale)",
            &["--begins", "rest", "--unit", "counts", "--scale", "1e-5"],
        ),
    ];
    let gives = "\"state\":\"braking\"";
    cases
        .into_iter()
        .map(|case| Case { gives, ..case })
        .collect()
}

/// A directory with a state that was learnt at 100 Hz, `lift.json`.
fn with_state() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("ride.csv"), scaled(1.0)).unwrap();
    let arguments = ["detect", "ride.csv", "--save-state", "lift.json"];
    let mut command = liftsim();
    let said = outcome(command.current_dir(&directory).args(arguments));
    assert_eq!((said.0, &*said.2), (0, ""));
    directory
}

/// Exit code, standard output, standard error.
fn run(directory: &Path, is_monitor: bool, text: &str, flags: &[&str]) -> (i32, String, String) {
    let mut command = liftsim();
    command.current_dir(directory);
    if is_monitor {
        command.arg("monitor").write_stdin(text);
    } else {
        fs::write(directory.join("ride.csv"), text).unwrap();
        command.args(["detect", "ride.csv"]);
    }
    outcome(command.args(flags))
}

fn follow(cases: Vec<Case>, is_monitor: bool) {
    let directory = with_state();
    for it in cases {
        let run = |flags| run(directory.path(), is_monitor, &it.text, flags);
        let (_, _, err) = run(it.wrong);
        assert!(err.contains(it.says), "{}: {err}", it.says);
        let (code, out, err) = run(it.right);
        assert_eq!(code, 0, "{}: {err}", it.says);
        assert!(!err.contains(it.says), "{}: {err}", it.says);
        assert!(out.contains(it.gives), "{}: {out}{err}", it.says);
    }
}

#[test]
fn remedies_of_reading_work() {
    follow(of_reading(), false);
}

#[test]
fn remedies_of_detection_work() {
    follow(of_detection(), false);
}

#[test]
fn remedies_of_a_monitor_work() {
    follow(of_a_monitor(), true);
}
