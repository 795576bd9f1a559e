//! The map on disk: what is known of a building, not where its car is.

use super::floors::{Floors, Height, Map, MapError, Settings, Start};
use super::kept::{KeptError, Kind, Problem};
use serde::{Deserialize, Serialize};
use std::path::Path;

static KIND: Kind = Kind {
    format: "liftsim floor map",
    version: 1,
    // Of the most floors it is 1 MB.
    longest: 1 << 22,
    what: "map of floors",
    made: "`liftsim track RECORDING --map FILE` writes one",
    anew: "restore it, or remove it and begin with a sweep or --floors",
};

/// The file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct MapFile {
    /// m above the floor of the first stop, from the lowest up.
    heights: Vec<f64>,
    /// Of the heights, m², a row for each.
    covariance: Vec<Vec<f64>>,
    /// Stops at each floor.
    visits: Vec<u64>,
    /// Each floor as commissioned, m and m²; none before.
    commissioned: Option<Vec<Height>>,
    /// The latest normalised errors of trips, the oldest first.
    recent: Vec<f64>,
}

impl Floors {
    /// Reads a map from a file.
    ///
    /// # Errors
    /// If it cannot be read, is no map of this version, or holds numbers that no map has.
    pub fn load(path: &Path, settings: Settings, start: Start) -> Result<Self, KeptError> {
        let name = path.display().to_string();
        Self::from_json(&name, &KIND.read(path)?, settings, start)
    }

    /// Reads and checks a file's text; messages call the file `name`.
    ///
    /// # Errors
    /// Same as [`Floors::load`].
    pub fn from_json(
        name: &str,
        text: &[u8],
        settings: Settings,
        start: Start,
    ) -> Result<Self, KeptError> {
        Self::checked(text, settings, start).map_err(|problem| problem.of(name))
    }

    /// Writes the map to a file, over whatever is there.
    ///
    /// # Errors
    /// If it cannot be written; what was there is then whole.
    pub fn save(&self, path: &Path) -> Result<(), KeptError> {
        Kind::write(path, &self.to_json())
    }

    fn checked(text: &[u8], settings: Settings, start: Start) -> Result<Self, Problem> {
        let map: MapFile = KIND.parse(text)?;
        let floors = map.heights.len();
        if map.covariance.iter().any(|row| row.len() != floors) {
            return Err(Problem::Wrong(MapError::Covariance.into()));
        }
        let known = Map {
            heights: map.heights,
            covariance: map.covariance.concat(),
            visits: map.visits,
            commissioned: map.commissioned,
            recent: map.recent,
        };
        Self::known(settings, &known, start).map_err(|error| match error {
            MapError::Start { .. } => Problem::Unfit(error.into()),
            error => Problem::Wrong(error.into()),
        })
    }

    /// The text of the file.
    pub fn to_json(&self) -> String {
        let known = self.map();
        let rows = known.covariance.chunks(known.heights.len());
        KIND.text(MapFile {
            covariance: rows.map(<[f64]>::to_vec).collect(),
            heights: known.heights,
            visits: known.visits,
            commissioned: known.commissioned,
            recent: known.recent,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use serde_json::{Value, json};

    const SETTINGS: Settings = Settings::MENDED;

    fn building() -> Floors {
        let heights = [0.0, 4.5, 7.5, 10.5];
        let mut floors = Floors::given(SETTINGS, &heights, 0.02, Start::Floor(0)).unwrap();
        for distance in [4.5, 3.0, 3.0, -3.0, -3.01, -4.49].repeat(10) {
            floors.step(distance, 4e-5);
        }
        floors
    }

    fn refusal(text: &[u8]) -> String {
        let refused = Floors::checked(text, SETTINGS, Start::Unknown);
        refused
            .err()
            .map_or_else(String::new, |problem| problem.to_string())
    }

    #[test]
    fn what_is_saved_is_loaded() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lift.json");
        let floors = building();
        floors.save(&path).unwrap();
        floors.save(&path).unwrap();
        let again = Floors::load(&path, SETTINGS, Start::Unknown).unwrap();
        assert_eq!(again.map(), floors.map());
        assert!(again.map().commissioned.is_some());
        assert_eq!(folder.path().read_dir().unwrap().count(), 1);
        let nowhere = floors.save(&folder.path().join("no/lift.json"));
        let nowhere = nowhere.unwrap_err().to_string();
        assert!(
            nowhere.contains("cannot be written") && nowhere.contains("(choose"),
            "{nowhere}"
        );
        let missing = Floors::load(&folder.path().join("none"), SETTINGS, Start::Unknown);
        assert!(
            missing
                .unwrap_err()
                .to_string()
                .contains("none: cannot be read")
        );
    }

    type Change = fn(&mut Value);

    #[test]
    fn what_is_no_map_is_refused() {
        let text = building().to_json();
        assert_eq!(refusal(text.as_bytes()), "");
        let texts: [(&[u8], &str); 5] = [
            (b"", "no map of floors"),
            (b"time,acceleration\n0,9.81\n", "no map of floors"),
            (b"{\"settings\": {}}", "no map of floors"),
            (&[0xff; 100], "no map of floors"),
            (&text.as_bytes()[..text.len() / 2], "damaged: EOF"),
        ];
        for (text, expected) in texts {
            let refusal = refusal(text);
            assert!(
                refusal.starts_with(expected) && refusal.ends_with(')'),
                "{expected}: {refusal}"
            );
        }
        let changes: [(&str, Change); 13] = [
            ("no map of floors", |map| map["format"] = json!("another")),
            ("version 2, and this program reads up to 1", |map| {
                map["version"] = json!(2);
                map["new"] = json!("of version 2");
            }),
            ("damaged: unknown field", |map| map["new"] = json!(0)),
            ("damaged: floors: must be at least 2", |map| {
                map["heights"] = json!([0.0]);
                map["covariance"] = json!([[0.0]]);
            }),
            ("damaged: floors[2]: must lie more than", |map| {
                map["heights"][2] = map["heights"][1].clone()
            }),
            ("damaged: floors[2]: must lie more than", |map| {
                map["heights"][2] = json!(1.0)
            }),
            ("damaged: floors[3]: must be finite", |map| {
                map["heights"][3] = json!(1e300)
            }),
            ("damaged: visits: must have an entry", |map| {
                map["visits"] = json!([1])
            }),
            ("damaged: visits: must be at most", |map| {
                map["visits"][1] = json!(u64::MAX)
            }),
            ("damaged: commissioned: must", |map| {
                map["commissioned"] = json!([])
            }),
            ("damaged: covariance: must", |map| {
                map["covariance"][1][1] = json!(-1.0)
            }),
            ("damaged: covariance: must", |map| {
                map["covariance"][1][2] = json!(1.0)
            }),
            ("damaged: covariance: must", |map| {
                map["covariance"][1] = json!([])
            }),
        ];
        for (expected, change) in changes {
            let mut map: Value = serde_json::from_str(&text).unwrap();
            change(&mut map);
            let refusal = refusal(map.to_string().as_bytes());
            assert!(refusal.starts_with(expected), "{expected}: {refusal}");
        }
    }

    proptest! {
        /// A file with a byte changed or a number replaced is refused or is a map that can be used.
        #[test]
        fn damaged_files(at in 0..10_000usize, byte in any::<u8>(), number in any::<f64>()) {
            let text = building().to_json();
            let mut changed = text.clone().into_bytes();
            let length = changed.len();
            changed[at % length] = byte;
            let mut numbers: Vec<&str> = text.split_inclusive([',', '[']).collect();
            let number = format!("{number:?},");
            let place = at % numbers.len();
            numbers[place] = &number;
            for text in [changed, numbers.concat().into_bytes()] {
                if let Ok(mut floors) = Floors::checked(&text, SETTINGS, Start::Unknown) {
                    for distance in [3.0, -4.5, 1.0, 3.0] {
                        let stop = floors.step(distance, 1e-4);
                        prop_assert!(stop.position.is_finite() && stop.deviation >= 0.0, "{stop:?}");
                        prop_assert!(stop.probability > 0.0, "{stop:?}");
                    }
                }
            }
        }
    }
}
