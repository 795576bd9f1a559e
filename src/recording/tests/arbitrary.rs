//! For any bytes, nothing panics, and an accepted recording is a valid signal.

use super::*;
use proptest::prelude::*;

fn check(bytes: Vec<u8>, reading: &Reading) -> Result<(), TestCaseError> {
    let Ok(recording) = Recording::from_bytes("ride.csv", bytes, reading) else {
        return Ok(());
    };
    recording
        .warnings()
        .iter()
        .for_each(|warning| assert!(!warning.to_string().is_empty()));
    prop_assert!(recording.facts().rate > 0.0);
    let mut last = f64::NEG_INFINITY;
    for sample in recording.samples().iter().take(10_000) {
        prop_assert!(
            sample.time > last && sample.time.is_finite() && sample.acceleration.is_finite()
        );
        last = sample.time;
    }
    Ok(())
}

fn readings() -> [Reading; 5] {
    let resample = Some(7.0);
    let axis = Axis::Gravity;
    let default = Reading::default;
    let (from, to) = (Some(0.01), Some(5.0));
    let (rate, invert) = (Some(50.0), true);
    [
        default(),
        Reading {
            resample,
            ..default()
        },
        Reading { axis, ..default() },
        Reading {
            from: from.map(When::Seconds),
            to: to.map(When::Seconds),
            invert,
            ..default()
        },
        Reading { rate, ..default() },
    ]
}

const VALID: [&str; 10] = [
    "\"Time (s)\",\"Acceleration x (m/s^2)\",\"Acceleration y (m/s^2)\",\"Acceleration z (m/s^2)\"\n\
     0.0E0,1.0E0,7.0E0,7.1E0\n1.0E-2,1.1E0,7.0E0,7.2E0\n2.0E-2,1.0E0,7.1E0,7.1E0\n5.0E-2,1.0E0,7.0E0,7.0E0",
    "relative_time,AccX,AccY,AccZ\n0,,,9.75\n1,0.125,,\n2,,0.25,\n20,0.125,,9.5\n40,,0.5,9.75\n",
    "Zeit (s);Lineare Beschleunigung z (m/s²)\r\n0,00;0,5\r\n0,01;0,25\r\n0,01;0,125\r\n0,02;1\r\n",
    "0.01\t1\n0.02\t2\n0.03\t1\n0.05\t4\n0.5\t4\n",
    "{\"ts\":1.5,\"acc\":{\"x\":0,\"z\":1}}\n{\"ts\":1.51,\"acc\":{\"x\":0,\"z\":2}}\n{\"ts\":1.52,\"acc\":{\"x\":0,\"z\":1}}\n",
    "[{\"sensor\":\"Accelerometer\",\"seconds_elapsed\":\"0.1\",\"z\":\"1\"},{\"sensor\":\"Accelerometer\",\
     \"seconds_elapsed\":\"0.2\",\"z\":\"2\"},{\"sensor\":\"Accelerometer\",\"seconds_elapsed\":\"0.3\",\"z\":\"1\"}]",
    "\"TOA5\",\"S\"\n\"TIMESTAMP\",\"az\"\n\"TS\",\"g\"\n\"\",\"Smp\"\n\"2022-01-11 20:30:00.1\",1\n\
     \"2022-01-11 20:30:00.2\",\"NAN\"\n\"2022-01-11 20:30:00.3\",1.1\n\"2022-01-11 20:30:00.4\",1.2\n",
    "14:23:05.123 -> ready\n14:23:00.1 -> 0,0,9.8\n14:23:00.2 -> 0,1,9.8\n14:23:00.3 -> 0,0,9.7\n",
    "micros,x,y,z\n4294960000,0,0,16384\n4294967000,0,1,16385\n6704,0,0,16384\n13704,0,0,16383\n",
    "t;z\n1;1\n1;2\n1;1\n2;1\n2;2\n2;1\n3;1\n3;2\n3;1\n4;2\n4;2\n",
];

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: prop::test_runner::RngSeed::Fixed(2014), cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bytes(bytes in prop::collection::vec(any::<u8>(), 0..300), reading in 0usize..5) {
        check(bytes, &readings()[reading])?;
    }

    /// The letters of tables.
    #[test]
    fn letters(text in "[-0-9.,;\tEe\n\r\"#timeaccxyzNaN ]{0,200}", reading in 0usize..5) {
        check(format!("time,x,y,z\n{text}").into_bytes(), &readings()[reading])?;
        check(text.into_bytes(), &readings()[reading])?;
    }

    /// Valid files with bytes exchanged, taken out and put in.
    #[test]
    fn mutations(
        file in 0usize..VALID.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0u8..3, any::<u8>()), 1..6),
        reading in 0usize..5,
    ) {
        let mut bytes = VALID[file].as_bytes().to_vec();
        for (place, kind, byte) in changes {
            let place = place.index(bytes.len());
            match kind {
                0 => bytes[place] = byte,
                1 => bytes.insert(place, byte),
                _ => {
                    bytes.remove(place);
                }
            }
        }
        check(bytes, &readings()[reading])?;
    }

    /// A stream reads what a file does: lines of tables, mutated.
    #[test]
    fn streams(
        file in 0usize..VALID.len(),
        place in any::<prop::sample::Index>(),
        byte in any::<u8>(),
        has_drum in any::<bool>(),
    ) {
        let mut bytes = VALID[file].as_bytes().to_vec();
        let place = place.index(bytes.len());
        bytes[place] = byte;
        let options = Reading { axis: "z".parse().unwrap(), ..Reading::default() };
        let mut reader = if has_drum {
            LineReader::with_drum(&bytes[..], &options)
        } else {
            LineReader::new(&bytes[..], &options)
        };
        for _ in 0..100 {
            match reader.next() {
                Ok(Some(reading)) => prop_assert!(reading.acceleration.is_finite()),
                Ok(None) => return Ok(()),
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
        prop_assert!(false, "it does not end");
    }

    #[test]
    fn lines(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let mut reader = LineReader::new(&bytes[..], &Reading::default());
        loop {
            match reader.next() {
                Ok(Some(reading)) => prop_assert!(reading.acceleration.is_finite()),
                Ok(None) => break,
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
    }
}

#[test]
fn the_valid_files_are_valid() {
    for text in VALID {
        assert!(read(&open(text)).len() >= 3, "{text}");
    }
}
