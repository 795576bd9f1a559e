//! Barometers, in the units and the tables in which they come.

use super::archive as zipped;
use crate::recording::BarometerWarning::{Missing, NoAir, NoNames, Repeated, Several};
use crate::recording::{Barometer, Names, PressureUnit};

fn read(text: &str) -> Barometer {
    let read = Barometer::from_bytes("air.csv", text.as_bytes());
    read.unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn refused(text: &str) -> String {
    let read = Barometer::from_bytes("air.csv", text.as_bytes());
    read.expect_err(text).to_string()
}

#[test]
fn units_by_name_and_by_what_air_there_is() {
    let table = |header: &str, scale: f64| {
        let rows = (0..4).map(|at| format!("{at},{}\n", 75_500.0 * scale));
        header.to_owned() + "\n" + &rows.collect::<String>()
    };
    use PressureUnit::{Hectopascal, Kilopascal, Pascal};
    for (header, scale, unit) in [
        ("Time (s),Pressure (hPa)", 1e-2, Hectopascal),
        ("time,pressure", 1e-2, Hectopascal),
        ("Zeit (s),Luftdruck (hPa)", 1e-2, Hectopascal),
        ("t [s],p [mbar]", 1e-2, Hectopascal),
        ("time,pressure", 1.0, Pascal),
        ("time,baro (Pa)", 1.0, Pascal),
        ("time,pressure", 1e-3, Kilopascal),
        ("time,pressure (kPa)", 1e-3, Kilopascal),
        ("time,pressure (mmHg)", 1.0 / 133.322, PressureUnit::Mercury),
        (
            "time,p (inHg)",
            1.0 / (25.4 * 133.322),
            PressureUnit::InchesOfMercury,
        ),
    ] {
        let barometer = read(&table(header, scale));
        assert_eq!(barometer.unit, unit, "{header}");
        let pascal = barometer.readings[3].pascal;
        assert!((pascal - 75_500.0).abs() < 1e-6, "{header} {pascal}");
    }
}

/// Of the pressure and the altitude that an app made of it the pressure is taken; the altitude where it is alone.
#[test]
fn pressure_before_altitude() {
    let both = read("Time (s)\tPressure (hPa)\tAltitude (m)\n0\t755\t0\n1\t754\t11\n");
    assert_eq!(
        (both.column.as_str(), both.readings[1].pascal),
        ("Pressure (hPa)", 75_400.0)
    );
    let altitude = read("time,Altitude (m)\n0,2400\n1,2411\n");
    assert_eq!(altitude.unit, PressureUnit::Metres);
    let climb = altitude.readings[1].standard_altitude() - altitude.readings[0].standard_altitude();
    assert!((climb - 11.0).abs() < 1e-6, "{climb}");
}

#[test]
fn what_is_no_air_is_left_out_or_refused() {
    let gaps = read("time,pressure (hPa)\n0,1000\n1,0\n2,NaN\n3,1001\n3,1002\n");
    let warnings = [Missing(1), Repeated(1), NoAir(1)];
    assert_eq!((gaps.readings.len(), gaps.warnings), (2, warnings.to_vec()));
    for (text, message) in [
        (
            "time,pressure (hPa)\n0,0\n1,0\n",
            "must be those of the air on earth",
        ),
        ("time,pressure\n0,7\n1,7\n", "name its unit in the header"),
        (
            "time,az\n0,7\n1,7\n",
            "no column looks like the pressure of the air",
        ),
        ("time,pressure (hPa)\n0,1000\n1,x\n", "air.csv:3"),
        (
            "time,Sound pressure level (dB)\n0,40\n1,41\n",
            "name its unit in the header",
        ),
        ("", "is empty"),
    ] {
        let error = refused(text);
        assert!(error.contains(message), "{text}: {error}");
    }
}

/// What was taken of several columns, or without names, is said, and how to choose.
#[test]
fn columns_that_are_taken_for_it() {
    let two =
        read("time,pressure (hPa),baro (hPa),noise pressure (dB)\n0,1000,990,40\n1,999,989,41\n");
    let column = "pressure (hPa)".to_owned();
    let others = Names::of(["baro (hPa)"]);
    assert_eq!(two.warnings, [Several { column, others }]);
    let nameless = read("0,98000\n1,98001\n");
    assert_eq!(
        (nameless.unit, nameless.warnings),
        (PressureUnit::Pascal, vec![NoNames])
    );
    for (text, message) in [
        ("0,98000,9\n1,98001,9\n", "name it `time (s)` in the header"),
        ("0,210.5\n1,210.6\n", "name its unit in the header"),
    ] {
        let error = refused(text);
        assert!(error.contains(message), "{error}");
    }
    let table = "time,seconds_elapsed,pressure\n1,0.0,1000.5\n2,1.0,1000.4\n";
    let archive = zipped(&[("Barometer.csv", table), ("b/Barometer.csv", table)]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ride.zip");
    std::fs::write(&path, &archive).unwrap();
    let given = Barometer::from_bytes("ride.zip", archive).expect_err("there are two");
    let found = Barometer::recorded_with(&path).expect_err("there are two");
    for error in [given.to_string(), found.to_string()] {
        let is_told = error.contains("several members") && error.contains("unpack it");
        assert!(is_told && !error.contains("--member"), "{error}");
    }
}

#[test]
fn among_the_sensors_of_an_app() {
    let archive = zipped(&[
        (
            "Accelerometer.csv",
            "time,seconds_elapsed,z,y,x\n1,0.0,1,1,9\n2,0.1,1,1,9\n",
        ),
        (
            "Barometer.csv",
            "time,seconds_elapsed,relativeAltitude,pressure\n1,0.0,0,1000.5\n2,1.0,0,1000.4\n",
        ),
    ]);
    let barometer = Barometer::from_bytes("ride.zip", archive).unwrap();
    assert_eq!(barometer.column, "pressure");
    assert!((barometer.readings[1].pascal - 100_040.0).abs() < 1e-6);
    let json = r#"[{"sensor":"Accelerometer","time":"1","seconds_elapsed":"0","x":"1","y":"1","z":"9"},
        {"sensor":"Barometer","time":"1","seconds_elapsed":"0","pressure":"1000.5"},
        {"sensor":"Barometer","time":"2","seconds_elapsed":"1","pressure":"1000.4"}]"#;
    let barometer = Barometer::from_bytes("ride.json", json.as_bytes()).unwrap();
    assert_eq!(barometer.readings.len(), 2);
}
