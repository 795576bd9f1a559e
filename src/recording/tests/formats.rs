//! The formats of the apps.

use super::*;

const EXPECTED: [(f64, f64); 3] = [(0.01, -0.15), (0.02, 0.25), (0.03, 0.5)];

/// The same three samples in every dialect of phyphox.
#[test]
fn phyphox() {
    let header = "\"Time (s)\",\"Linear Acceleration z (m/s^2)\",\"Absolute acceleration (m/s^2)\"";
    let rows = "\n1.0E-2,-1.5E-1,1.5E-1\n2.0E-2,2.5E-1,2.5E-1\n3.0E-2,5.0E-1,5.0E-1";
    let points = format!("{header}{rows}");
    let dialects = [
        points.clone(),
        points.replace(',', ";"),
        points.replace(',', "\t"),
        points.replace(',', ";").replace('.', ","),
        points.replace(',', "\t").replace('.', ","),
        points.replace('\n', "\r\n") + "\r\n",
        format!("\u{feff}{points}\n\n"),
        format!("sep=,\n# exported\n{points}"),
    ];
    for text in dialects {
        let recording = open(&text);
        assert_eq!(read(&recording), EXPECTED, "{text}");
        assert_eq!(recording.format(), "phyphox");
        assert_eq!(recording.time_column(), ("Time (s)", TimeUnit::Seconds));
        assert_eq!(
            recording.acceleration_columns(),
            ["Linear Acceleration z (m/s^2)"]
        );
        assert_eq!(recording.unit(), Unit::MetresPerSecondSquared);
        assert_eq!(recording.warnings(), []);
    }
}

#[test]
fn utf_16() {
    let text = "\u{feff}Time (s);Acceleration z (m/s²)\n0,01;-0,15\n0,02;0,25\n0,03;0,5\n";
    let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
    for bytes in [little, big] {
        let recording = Recording::from_bytes("ride", bytes, &Reading::default()).unwrap();
        assert_eq!(read(&recording), EXPECTED);
    }
}

#[test]
fn latin_1() {
    let text = b"Time (s),Acceleration z (m/s\xb2)\n0.01,-0.15\n0.02,0.25\n0.03,0.5\n";
    let recording = Recording::from_bytes("ride", &text[..], &Reading::default()).unwrap();
    assert_eq!(read(&recording), EXPECTED);
    assert_eq!(recording.format(), "phyphox");
}

/// Each sensor writes its own rows, and z is read at 20 ms.
#[test]
fn science_journal() {
    let text = "relative_time,LinearAccelerometerSensor,AccX,AccY,AccZ\n\
        0,,,,9.75\n1,,0.125,,\n2,,,0.25,\n20,1.5,0.125,,9.5\n40,,,0.5,9.75\n";
    let recording = open(text);
    assert_eq!(read(&recording), [(0.0, 9.75), (0.02, 9.5), (0.04, 9.75)]);
    assert_eq!(recording.format(), "Science Journal");
    assert_eq!(recording.time_column().1, TimeUnit::Milliseconds);
    assert!(recording.facts().has_gravity);
    assert!(matches!(recording.vertical().reason, Reason::Gravity { from, .. } if from < 3.0));
    let blank = Warning::BlankRows {
        count: 2,
        samples: 3,
    };
    assert_eq!(recording.warnings(), [blank]);
}

#[test]
fn sensor_logger() {
    let text = "time,seconds_elapsed,z,y,x\n\
        1700000000010000000,0.01,9.5,0,0\n1700000000020000000,0.02,10,0,0\n";
    let recording = open(text);
    assert_eq!(recording.format(), "Sensor Logger");
    assert_eq!(
        recording.time_column(),
        ("seconds_elapsed", TimeUnit::Seconds)
    );
    assert_eq!(read(&recording), [(0.01, 9.5), (0.02, 10.0)]);
    let reading = Reading {
        time: Some("time".into()),
        ..Reading::default()
    };
    let recording = open_as(text, &reading);
    assert_eq!(recording.time_column().1, TimeUnit::Nanoseconds);
    assert_eq!(recording.facts().clock_offset, Some(1.70000000001e9));
    assert_eq!(recording.facts().start, 0.0);
    assert!((recording.facts().rate - 100.0).abs() < 0.01);
    let gyroscope = Recording::from_bytes("Gyroscope.csv", text.as_bytes(), &Reading::default());
    assert!(
        gyroscope
            .unwrap_err()
            .to_string()
            .contains("no column looks like an acceleration")
    );
}

#[test]
fn plain() {
    for text in [
        "0.01,-0.15\n0.02,0.25\n0.03,0.5",
        "t,acc\n0.01,-0.15\n0.02,0.25\n0.03,0.5\n",
    ] {
        let recording = open(text);
        assert_eq!(read(&recording), EXPECTED);
        assert_eq!(recording.format(), "plain");
    }
    assert_eq!(read(&open("0,01;-0,15\n0,02;0,25\n0,03;0,5")), EXPECTED);
}

#[test]
fn names_and_units_are_given() {
    let reading = Reading {
        time: Some("clock".into()),
        acceleration: Some("ADC".into()),
        time_unit: Some(TimeUnit::Microseconds),
        unit: Unit::Counts {
            scale: 0.5,
            offset: 2048.0,
        },
        ..Reading::default()
    };
    let recording = open_as(
        "n,clock,adc\n1,0,2048\n2,20000,2050\n3,40000,2047\n",
        &reading,
    );
    assert_eq!(read(&recording), [(0.0, 0.0), (0.02, 1.0), (0.04, -0.5)]);
    let reading = Reading {
        acceleration: Some("3".into()),
        time: Some("1".into()),
        ..Reading::default()
    };
    let recording = open_as("0.00,7,1.5\n0.01,7,2.5\n", &reading);
    assert_eq!(read(&recording), [(0.0, 1.5), (0.01, 2.5)]);
}

/// The rows of `0.5 + i % 3` at 100 Hz, each written by `row` from its number, time and acceleration.
fn table(head: &str, row: impl Fn(i32, f64, f64) -> String) -> String {
    let row = |i: i32| row(i, f64::from(i) / 100.0, 9.5 + 0.25 * f64::from(i % 3)) + "\n";
    head.to_owned() + &(0..200).map(row).collect::<String>()
}

/// A logger's file is the table of the acceleration that it was made of.
fn is_that_table(text: &str, format: &str) -> Recording {
    let recording = open(text);
    let samples = read(&recording);
    assert_eq!((recording.format(), samples.len()), (format, 200), "{text}");
    for (i, (time, a)) in (0..).zip(samples) {
        assert!((time - f64::from(i) / 100.0).abs() < 6e-3, "{time} {i}");
        assert!(
            (a - (9.5 + 0.25 * f64::from(i % 3))).abs() < 1e-3,
            "{a} {i}"
        );
    }
    recording
}

#[test]
fn loggers() {
    let physics = |_, t: f64, a: f64| {
        format!(
            "{t};0,0;0,0;{}",
            (a / GRAVITY).to_string().replace('.', ",")
        )
    };
    is_that_table(&table("time;gFx;gFy;gFz\n", physics), "Physics Toolbox");
    let quoted = |_, t: f64, a: f64| format!("\"{t}\",\"{a}\"").replace('.', ",");
    is_that_table(&table("\"time\",\"z\"\n", quoted), "plain");
    let xsens = |i, t: f64, a| format!("{i},{:.0},0,0,{a}", 1e6 * t);
    let head = "sep=,\nDeviceTag:,Xsens DOT\nOutputRate:,60Hz\n\n\
                PacketCounter,SampleTimeFine,Acc_X,Acc_Y,Acc_Z\n";
    is_that_table(&table(head, xsens), "Xsens DOT");
    let witmotion = |_, t: f64, a: f64| format!("0x50\t{t}\t0\t0\t{}\t0.1", a / GRAVITY);
    let head =
        "StartTime: 2023-10-24 14:23:05.123\naddress\tTime(s)\tax(g)\tay(g)\taz(g)\twx(deg/s)\n";
    is_that_table(&table(head, witmotion), "plain");
    let toa5 = |i, t: f64, a| format!("\"2022-01-11 20:30:0{t:.2}\",{i},{a},\"NAN\"");
    let head = "\"TOA5\",\"SITE\",\"CR6\",\"4108\",\"CR6.Std\",\"CPU\",\"6\",\"Accel\"\n\
                \"TIMESTAMP\",\"RECORD\",\"az\",\"batt\"\n\"TS\",\"RN\",\"g\",\"V\"\n\"\",\"\",\"Smp\",\"Avg\"\n";
    let recording = is_that_table(&table(head, |i, t, a: f64| toa5(i, t, a / GRAVITY)), "TOA5");
    assert_eq!(recording.unit(), Unit::Gravity);
    assert_eq!(recording.facts().clock_offset, Some(1641933000.0));
    let arduino = |_, t: f64, a| format!("14:23:0{t:.3} -> 0.0,0.0,{a}");
    let recording = is_that_table(&table("14:23:05.123 -> MPU6050 ready\n", arduino), "plain");
    assert_eq!(recording.warnings(), [Warning::NoNames("time, x, y and z")]);
    let units = |_, t, a| format!("{t},{a}");
    is_that_table(&table("time,lift\ns,m/s^2\n", units), "plain");
    let blanks = |_, t, a| format!("{t}   {a}");
    is_that_table(&table("", blanks), "plain");
    let labels = |_, t, a| format!("{t},0,0,{a},walking");
    is_that_table(&table("t,x,y,z,what\n", labels), "plain");
}

#[test]
fn json() {
    let line = |_, t: f64, a| {
        format!(
            r#"{{"ts": {}, "acc": {{"x": 0, "y": 0, "z": {a}}}}}"#,
            1.7e12 + 1e3 * t
        )
    };
    let recording = is_that_table(&table("", line), "plain");
    assert_eq!(recording.time_column(), ("ts", TimeUnit::Milliseconds));
    let element = |i, t: f64, a| {
        let of = |sensor, z| {
            format!(
                r#"{{"sensor":"{sensor}","time":"17000000000","seconds_elapsed":"{t}","z":"{z}","y":"0","x":"0"}}"#
            )
        };
        let comma = if i == 0 { "" } else { "," };
        format!(
            "{comma}{},{}",
            of("Gyroscope", 0.1),
            of("TotalAcceleration", a)
        )
    };
    let text = table("[", element) + "]";
    let recording = is_that_table(&text, "Sensor Logger");
    assert_eq!(recording.member(), Some("TotalAcceleration"));
    let refused_at = |text: &str| refused(text);
    assert!(refused_at("{\"t\":0,\"a\":1}\n{\"t\":0.1,\"a\":\n{}\n").contains("ride.csv:2: JSON"));
    assert!(
        refused_at("{\"t\":0,\"a\":1}\n{\"t\":\"x\",\"a\":1}\n{}\n")
            .contains("ride.csv:2: column \"t\": must be a number")
    );
    assert!(refused_at("[1, 2]").contains("JSON: invalid type"));
    let bomb = format!(
        "[{{\"{}\":{{{}\"b\":1}}}}]",
        "k".repeat(500_000),
        "\"a\":1,".repeat(70_000)
    );
    assert!(refused_at(&bomb).contains("no column looks like"));
    let array = format!("[{{\"a\":[{}0]}}]", "0,".repeat(600_000));
    assert!(refused_at(&array).contains("a reading must be at most 1048576 bytes long"));
    assert!(refused_at("[{\"sensor\":\"Gyroscope\"}]").contains("no sensor is an accelerometer"));
}

/// Stamps of whole seconds, counters that wrap, a clock in epoch time, rows without readings.
#[test]
fn clocks() {
    let whole = |_, t: f64, a| format!("{},{a}", 1434934563 + t as i64);
    let recording = is_that_table(&table("time,z\n", whole), "plain");
    assert_eq!(recording.warnings()[0], Warning::Spread { rows: 100 });
    let wrapped = |_, t: f64, a| format!("{},{a}", (4294967295f64 - 1e6 + 1e6 * t) % 4294967296.0);
    let recording = open(&table("micros,z\n", wrapped));
    assert_eq!(
        (recording.facts().samples, recording.facts().gaps),
        (200, 0)
    );
    assert_eq!(recording.warnings(), [Warning::Wrapped(1)]);
    let missing = |i, t, a| {
        if i % 10 == 5 {
            format!("{t},NAN")
        } else {
            format!("{t},{a}")
        }
    };
    let recording = open(&table("time,z\n", missing));
    assert_eq!(recording.facts().samples, 180);
    assert_eq!(recording.warnings()[0], Warning::MissingRows(20));
    assert_eq!(recording.facts().missing, 20);
}

#[test]
fn units_are_assumed_aloud() {
    let counts = |_, t: f64, a: f64| format!("{:.0},0,0,{:.0}", 1e3 * t, 16384.0 * a / GRAVITY);
    let recording = open(&table("millis,ax,ay,az\n", counts));
    assert!((recording.facts().mean - 9.75).abs() < 0.01);
    let warning = recording.warnings()[0].to_string();
    assert!(
        warning.contains("as 16384 counts per g have it"),
        "{warning}"
    );
    let in_g = |_, t: f64, a: f64| format!("{t},{}", a / GRAVITY);
    let recording = open(&table("time,z\n", in_g));
    assert!((recording.facts().mean - 9.75).abs() < 0.01);
    assert!(
        recording.warnings()[0]
            .to_string()
            .contains("readings in g")
    );
    let unknown = |_, t: f64, a: f64| format!("{t},{}", 70.0 * a);
    let text = table("time,z\n", unknown);
    let refused = refused(&text);
    // The remedy is the rest of the message, and works.
    let scale = refused
        .split("--scale ")
        .nth(1)
        .unwrap()
        .split(';')
        .next()
        .unwrap();
    let unit = Unit::told(Some("counts"), Some(scale.parse().unwrap()), None).unwrap();
    let reading = Reading {
        unit: unit.unwrap(),
        ..Reading::default()
    };
    assert!(
        (open_as(&text, &reading).facts().mean - 9.8).abs() < 0.1,
        "{refused}"
    );
}

#[test]
fn a_part_and_a_rate() {
    let text = table("time,z\n", |_, t, a| format!("{t},{a}"));
    let part = |from: Option<f64>, to: Option<f64>| Reading {
        from: from.map(When::Seconds),
        to: to.map(When::Seconds),
        ..Reading::default()
    };
    let recording = open_as(&text, &part(Some(0.5), Some(1.0)));
    let facts = recording.facts();
    assert_eq!((facts.start, facts.end, facts.samples), (0.5, 1.0, 51));
    assert_eq!(
        refused_as(&text, &part(Some(5.0), None)),
        "ride.csv: must have at least 2 readings from 5 to 1.99 s, got 0 (times go from 0 to 1.99 s: change \
         --from or --to)"
    );
    let lone = table("z\n", |_, _, a| a.to_string());
    assert!(refused(&lone).contains("or --rate HZ where rows are evenly spaced"));
    let rate = Reading {
        rate: Some(50.0),
        ..Reading::default()
    };
    let recording = open_as(&lone, &rate);
    assert_eq!(
        (recording.facts().rate, recording.facts().end),
        (50.0, 3.98)
    );
    let late = Reading {
        from: Some(When::Seconds(2.0)),
        ..rate.clone()
    };
    assert_eq!(open_as(&lone, &late).facts().samples, 100);
    let nameless = table("", |_, _, a| a.to_string());
    assert!(refused(&nameless).contains("or --rate HZ where rows are evenly spaced"));
    assert_eq!(open_as(&nameless, &rate).facts().samples, 200);
}

/// A part by the calendar, in the zone of the record, in another, or without one.
#[test]
fn a_part_by_the_calendar() {
    let row = |i: usize| {
        format!(
            "2026-11-30T14:05:{:02}.{}+01:00,{}\n",
            i / 10,
            i % 10,
            i % 7
        )
    };
    let dated: String = (0..50).map(row).collect();
    let plain: String = (0..50)
        .map(|i| format!("{}.{},{}\n", i / 10, i % 10, i % 7))
        .collect();
    let read = |rows: &str, from: &str, to: &str| {
        let [from, to] = [from, to].map(|when| Some(when.parse().unwrap()));
        let reading = Reading {
            from,
            to,
            ..Reading::default()
        };
        Recording::from_bytes("ride", format!("time,z\n{rows}").into_bytes(), &reading)
    };
    for from in [
        "2026-11-30T13:05:02Z",
        "2026-11-30T14:05:02",
        "2026-11-30T08:05:02-05:00",
        "2",
    ] {
        let part = read(&dated, from, "2026-11-30T14:05:03+01:00").unwrap();
        let samples = part.samples();
        assert_eq!((samples.len(), samples[0].time), (11, 2.0), "{from}");
    }
    let refused = read(&plain, "2026-11-30T14:05:02", "3").unwrap_err();
    assert!(refused.to_string().contains("have no date"), "{refused}");
}
