//! Bytes as a map of floors: refused with a reason, or a map that any trips leave usable.

#![no_main]

use libfuzzer_sys::fuzz_target;
use liftsim::track::floors::{Floors, Settings, Start};

fuzz_target!(|bytes: &[u8]| {
    // The last bytes are trips.
    let (map, trips) = bytes.split_at(bytes.len().saturating_sub(32));
    let start = trips.first().filter(|at| **at < 128);
    let start = start.map_or(Start::Unknown, |at| Start::Floor(usize::from(*at)));
    let mut floors = match Floors::from_json("map.json", map, Settings::MENDED, start) {
        Ok(floors) => floors,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return;
        }
    };
    for trip in trips.as_chunks::<4>().0 {
        let distance = f64::from(i16::from_le_bytes([trip[0], trip[1]])) / 100.0;
        let deviation = f64::from(u16::from_le_bytes([trip[2], trip[3]])) / 1000.0;
        let stop = floors.step(distance, deviation * deviation);
        assert!(stop.position.is_finite() && stop.deviation >= 0.0);
        assert!(stop.probability > 0.0);
    }
    let again = floors.to_json();
    // Updates may move a floor beyond its neighbour: such a map is refused, not misread.
    let _ = Floors::from_json("map.json", again.as_bytes(), Settings::MENDED, Start::Unknown);
});
