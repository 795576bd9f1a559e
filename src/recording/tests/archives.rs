//! Tables in zip archives.

use super::*;

const TABLE: &str = "\"Time (s)\",\"Acceleration z (m/s^2)\"\n0.01,9.5\n0.02,10.5\n";
const BARE: &str = "time,seconds_elapsed,z,y,x\n10000000,0.01,1.5,0,0\n20000000,0.02,1.25,0,0\n";

fn open_archive(members: &[(&str, &str)]) -> Result<Recording, RecordingError> {
    Recording::from_bytes("ride.zip", archive(members), &Reading::default())
}

#[test]
fn phyphox() {
    let recording = open_archive(&[
        ("Raw Data.csv", TABLE),
        ("meta/device.csv", "property,value\nversion,1\n"),
        ("meta/time.csv", "event,experiment time\nSTART,0\n"),
    ]);
    let recording = recording.unwrap();
    assert_eq!(recording.member(), Some("Raw Data.csv"));
    assert_eq!(read(&recording), [(0.01, 9.5), (0.02, 10.5)]);
}

/// All its tables have the same columns. The one with gravity is taken.
#[test]
fn sensor_logger() {
    let members = [
        ("Accelerometer.csv", BARE),
        ("Gyroscope.csv", BARE),
        ("Gravity.csv", BARE),
    ];
    assert_eq!(
        open_archive(&members).unwrap().member(),
        Some("Accelerometer.csv")
    );
    let members = [("Accelerometer.csv", BARE), ("TotalAcceleration.csv", BARE)];
    assert_eq!(
        open_archive(&members).unwrap().member(),
        Some("TotalAcceleration.csv")
    );
}

#[test]
fn members_are_named() {
    let members = [("a.csv", TABLE), ("b.csv", TABLE), ("notes.md", "# none")];
    let error = open_archive(&members).unwrap_err().to_string();
    assert!(
        error.contains(
            "several members are tables of accelerations: \"a.csv\", \"b.csv\" (--member NAME)"
        ),
        "{error}"
    );
    let open = |member: &str| {
        let reading = Reading {
            member: Some(member.into()),
            ..Reading::default()
        };
        Recording::from_bytes("ride.zip", archive(&members), &reading)
    };
    assert_eq!(open("b.csv").unwrap().member(), Some("b.csv"));
    let error = open("c.csv").unwrap_err().to_string();
    assert!(
        error.contains("no member \"c.csv\", did you mean"),
        "{error}"
    );
    assert!(
        open("notes.md")
            .unwrap_err()
            .to_string()
            .starts_with("ride.zip:notes.md: is empty")
    );
}

#[test]
fn refusals() {
    let error = open_archive(&[("sheet.xml", "<a/>")])
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("no member is a table of accelerations, it holds \"sheet.xml\""),
        "{error}"
    );
    assert!(
        open_archive(&[])
            .unwrap_err()
            .to_string()
            .contains("it holds none")
    );
    let open = |bytes: &[u8]| Recording::from_bytes("ride.zip", bytes, &Reading::default());
    assert!(
        open(TABLE.as_bytes())
            .unwrap_err()
            .to_string()
            .contains("is not a zip archive")
    );
    let whole = archive(&[("a.csv", TABLE)]);
    let error = open(&whole[..whole.len() / 2]).unwrap_err().to_string();
    assert!(error.contains("zip archive: "), "{error}");
    // A byte of the packed text.
    let mut damaged = whole;
    damaged[50] ^= 0x55;
    assert!(open(&damaged).is_err());
}
