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
        assert_eq!(recording.format(), Format::Phyphox);
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
    assert_eq!(recording.format(), Format::Phyphox);
}

/// Each sensor writes its own rows, and z is read at 20 ms.
#[test]
fn science_journal() {
    let text = "relative_time,LinearAccelerometerSensor,AccX,AccY,AccZ\n\
        0,,,,9.75\n1,,0.125,,\n2,,,0.25,\n20,1.5,0.125,,9.5\n40,,,0.5,9.75\n";
    let recording = open(text);
    assert_eq!(read(&recording), [(0.0, 9.75), (0.02, 9.5), (0.04, 9.75)]);
    assert_eq!(recording.format(), Format::ScienceJournal);
    assert_eq!(recording.time_column().1, TimeUnit::Milliseconds);
    assert!(recording.facts().has_gravity);
    assert_eq!(recording.facts().blank_rows, 2);
    assert!(matches!(recording.vertical().reason, Reason::Gravity(angle) if angle < 3.0));
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
    assert_eq!(recording.format(), Format::SensorLogger);
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
        assert_eq!(recording.format(), Format::Plain);
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

/// Gravity shows which way is up, for either sign of the sensor's axis.
#[test]
fn down_is_turned_up() {
    let recording = open("time,x,y,z\n0.00,0,0,-9.75\n0.01,0,0,-10\n0.02,0,0,-9.5\n");
    assert_eq!(read(&recording), [(0.0, 9.75), (0.01, 10.0), (0.02, 9.5)]);
    assert!(
        recording
            .vertical()
            .to_string()
            .starts_with("-z (0.0 degrees")
    );
    let recording = open("time,acceleration (g)\n0.00,-1\n0.01,-1.25\n0.02,-1\n");
    assert!(recording.facts().has_gravity);
    assert!((recording.facts().greatest - 1.25 * 9.80665).abs() < 1e-12);
}

/// 45° between y and z: neither axis is vertical.
#[test]
fn tilted_axes_are_projected() {
    let half = 9.8 / 2f64.sqrt();
    let row = |i: i32| {
        format!(
            "{},0,{},{}\n",
            0.01 * f64::from(i),
            half,
            half + f64::from(i % 2)
        )
    };
    let rows: String = (0..200).map(row).collect();
    let text = format!("time,x,y,z\n{rows}");
    let recording = open(&text);
    assert_eq!(recording.acceleration_columns(), ["x", "y", "z"]);
    assert!(
        (recording.facts().mean - 10.16).abs() < 0.01,
        "{}",
        recording.facts().mean
    );
    // Axes in different rows cannot be projected.
    let apart = |i: i32| match i % 2 {
        0 => format!("{},0,{half},\n", 0.01 * f64::from(i)),
        _ => format!(
            "{},,,{}\n",
            0.01 * f64::from(i),
            half + 0.1 * f64::from(i % 4)
        ),
    };
    let rows: String = (0..200).map(apart).collect();
    let recording = open(&format!("time,x,y,z\n{rows}"));
    let is_tilted =
        |warning: &Warning| matches!(warning, Warning::Tilted { angle } if *angle > 30.0);
    assert!(recording.warnings().iter().any(is_tilted));
}

/// A pulse along y, shaking along x that averages out, and handling at the end that moves all axes.
#[test]
fn the_axis_with_the_ride() {
    let row = |i: i32| {
        let time = 0.01 * f64::from(i);
        let pulse = if (300..500).contains(&i) { 0.5 } else { 0.0 };
        let hand = if i >= 1800 { 4.0 } else { 0.0 };
        let shaking = f64::from(i % 2) * 3.0;
        format!(
            "{time},{},{},{}\n",
            shaking + hand,
            pulse - hand,
            0.01 + hand
        )
    };
    let rows: String = (0..2000).map(row).collect();
    let recording = open(&format!("time,x,y,z\n{rows}"));
    assert_eq!(recording.acceleration_columns(), ["y"]);
    assert!(matches!(recording.vertical().reason, Reason::Ride(lead) if lead > 10.0));
    let given = Reading {
        axis: Axis::X,
        ..Reading::default()
    };
    let recording = open_as(&format!("time,x,y,z\n{rows}"), &given);
    assert_eq!(recording.acceleration_columns(), ["x"]);
    assert_eq!(recording.vertical().reason, Reason::Given);
}

#[test]
fn rest_is_a_tie_for_z() {
    let row = |i: i32| {
        format!(
            "{},{},0,{}\n",
            0.01 * f64::from(i),
            0.01 * f64::from(i % 3),
            i % 2
        )
    };
    let rows: String = (0..500).map(row).collect();
    let recording = open(&format!("time,x,y,z\n{rows}"));
    assert_eq!(recording.acceleration_columns(), ["z"]);
    assert_eq!(recording.vertical().reason, Reason::NearTie);
    assert!(matches!(recording.warnings()[0], Warning::NearTie(_)));
}
