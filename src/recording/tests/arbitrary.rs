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

fn readings() -> [Reading; 3] {
    let resample = Some(7.0);
    let axis = Axis::Gravity;
    let default = Reading::default;
    [
        default(),
        Reading {
            resample,
            ..default()
        },
        Reading { axis, ..default() },
    ]
}

const VALID: [&str; 4] = [
    "\"Time (s)\",\"Acceleration x (m/s^2)\",\"Acceleration y (m/s^2)\",\"Acceleration z (m/s^2)\"\n\
     0.0E0,1.0E0,7.0E0,7.1E0\n1.0E-2,1.1E0,7.0E0,7.2E0\n2.0E-2,1.0E0,7.1E0,7.1E0\n5.0E-2,1.0E0,7.0E0,7.0E0",
    "relative_time,AccX,AccY,AccZ\n0,,,9.75\n1,0.125,,\n2,,0.25,\n20,0.125,,9.5\n40,,0.5,9.75\n",
    "Zeit (s);Lineare Beschleunigung z (m/s²)\r\n0,00;0,5\r\n0,01;0,25\r\n0,01;0,125\r\n0,02;1\r\n",
    "0.01\t1\n0.02\t2\n0.03\t1\n0.05\t4\n0.5\t4\n",
];

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: prop::test_runner::RngSeed::Fixed(2014), cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bytes(bytes in prop::collection::vec(any::<u8>(), 0..300), reading in 0usize..3) {
        check(bytes, &readings()[reading])?;
    }

    /// The letters of tables.
    #[test]
    fn letters(text in "[-0-9.,;\tEe\n\r\"#timeaccxyzNaN ]{0,200}", reading in 0usize..3) {
        check(format!("time,x,y,z\n{text}").into_bytes(), &readings()[reading])?;
        check(text.into_bytes(), &readings()[reading])?;
    }

    /// Valid files with bytes exchanged, taken out and put in.
    #[test]
    fn mutations(
        file in 0usize..4,
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0u8..3, any::<u8>()), 1..6),
        reading in 0usize..3,
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
