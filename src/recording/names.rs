//! Column names: time or acceleration, axis and unit.
//!
//! Each app has its own names, and phyphox translates them; the unit in brackets and the letter of the axis
//! are the same in every language.

use super::axis::AXES;
use super::unit::{TimeUnit, Unit};
use serde::{Deserialize, Serialize};

/// A column of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Column {
    pub name: String,
    pub role: Role,
    /// The unit in the name, if any.
    pub time_unit: Option<TimeUnit>,
    /// The unit in the name, if any.
    pub unit: Option<Unit>,
}

/// The apparent content of a column.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Role {
    /// Time; of several, the one with the lowest rank is the record's own clock.
    Time { rank: usize },
    /// The acceleration along x, y or z: 0, 1 or 2.
    Along { axis: usize, gravity: Gravity },
    /// An acceleration without an axis in its name.
    Acceleration,
    /// The length of the vector of acceleration, which has no sign.
    Magnitude,
    /// Anything else.
    Other,
}

/// Whether a column includes gravity, by its name.
#[derive(Clone, Copy, Debug, Eq, Ord, PartialEq, PartialOrd, Serialize, Deserialize)]
pub(super) enum Gravity {
    /// Left in, or not mentioned.
    In,
    /// Taken out by the device.
    Out,
}

/// Names of the clock, the best first, with the unit if the name says it.
const CLOCKS: [(&str, Option<TimeUnit>); 18] = [
    ("secondselapsed", Some(TimeUnit::Seconds)),
    ("elapsed", None),
    ("elapsedtime", None),
    ("relativetime", Some(TimeUnit::Milliseconds)),
    ("sampletimefine", Some(TimeUnit::Microseconds)),
    ("micros", Some(TimeUnit::Microseconds)),
    ("millis", Some(TimeUnit::Milliseconds)),
    ("ms", Some(TimeUnit::Milliseconds)),
    ("us", Some(TimeUnit::Microseconds)),
    ("time", None),
    ("t", None),
    ("ts", None),
    ("timestamp", None),
    ("timestamps", None),
    ("datetime", None),
    ("datetimeutc", None),
    ("unixtime", None),
    ("seconds", Some(TimeUnit::Seconds)),
];

/// Names of an acceleration, before an axis or alone.
const ACCELERATIONS: &str = "a acc accel acceleration accelerometer accelerometeracceleration \
    totalacceleration verticalacceleration gf";

/// Names of an acceleration without gravity.
const LINEAR: &str = "linearacceleration linearaccelerometer linearaccel linacc linaccel \
    useracceleration freeacc";

/// Words in the names of files whose x, y and z are not accelerations.
const OTHER_SENSORS: &str = "gyro magnet gravity orient rotation attitude location baro pedometer";

/// The apps and loggers that are known, each by columns that only it writes.
const FORMATS: [(&str, &[&str]); 6] = [
    ("Sensor Logger", &["seconds_elapsed"]),
    ("Science Journal", &["relative_time"]),
    ("Science Journal", &["timestamp", "AccX"]),
    ("Physics Toolbox", &["gFx"]),
    ("Xsens DOT", &["SampleTimeFine"]),
    // Witmotion's units stand in brackets as those of phyphox.
    ("plain", &["address"]),
];

/// The app that wrote these columns, of which `clock` is the time.
pub(super) fn format(columns: &[Column], clock: Option<&Column>) -> &'static str {
    let is = |mark: &str| {
        columns
            .iter()
            .any(|column| column.name.eq_ignore_ascii_case(mark))
    };
    if let Some((name, _)) = (FORMATS.iter()).find(|(_, marks)| marks.iter().all(|mark| is(mark))) {
        return name;
    }
    let in_brackets = |column: &Column| column.name.ends_with(')');
    let is_timed = clock.is_some_and(|clock| clock.time_unit.is_some() && in_brackets(clock));
    let mut columns = columns.iter();
    if is_timed && columns.any(|column| column.unit.is_some() && in_brackets(column)) {
        "phyphox"
    } else {
        "plain"
    }
}

impl Column {
    /// Reads a name. `owner`, the name of the file, decides the meaning of columns called only x, y and z.
    pub fn new(name: &str, owner: &str) -> Self {
        let name = name.trim();
        let (words, unit_name) = parted(name);
        let (time_unit, unit) = match unit_name {
            Some(name) => (name.parse().ok(), Unit::from_name(name)),
            None => (None, None),
        };
        let word: String = words.chars().filter(|c| c.is_alphanumeric()).collect();
        let word = word.to_lowercase();
        let is_foreign = unit_name.is_some() && time_unit.is_none() && unit.is_none();
        // Physics Toolbox's gFx is in g.
        let unit = unit.or(["gfx", "gfy", "gfz"]
            .contains(&&*word)
            .then_some(Unit::Gravity));
        let role = if is_foreign {
            Role::Other
        } else {
            role(&word, time_unit, unit, owner)
        };
        let clock = CLOCKS.iter().find(|(clock, _)| *clock == word);
        Self {
            name: name.to_owned(),
            role,
            time_unit: time_unit.or(clock.and_then(|(_, unit)| *unit)),
            unit,
        }
    }

    /// Takes a unit from a line below the names. A column of accelerations may show itself by it.
    pub fn unit_below(&mut self, name: &str) {
        let name = name.trim().trim_matches(['(', ')', '[', ']']);
        match (self.role, name.parse(), Unit::from_name(name)) {
            (Role::Time { .. }, Ok(unit), _) => self.time_unit = self.time_unit.or(Some(unit)),
            (Role::Time { .. }, ..) => {}
            (_, _, Some(unit)) => {
                self.unit = self.unit.or(Some(unit));
                if self.role == Role::Other {
                    self.role = role(&self.name.to_lowercase(), None, self.unit, "");
                }
            }
            _ => {}
        }
    }

    /// A column without a name, counted from 1.
    pub fn numbered(number: usize, role: Role) -> Self {
        Self {
            name: number.to_string(),
            role,
            time_unit: None,
            unit: None,
        }
    }
}

fn role(word: &str, time_unit: Option<TimeUnit>, unit: Option<Unit>, owner: &str) -> Role {
    if unit.is_none() {
        if let Some(rank) = CLOCKS.iter().position(|(clock, _)| *clock == word) {
            return Role::Time { rank };
        }
        if time_unit.is_some() {
            return Role::Time { rank: CLOCKS.len() };
        }
    }
    let is_stated = unit.is_some();
    if word.contains("gravit") {
        return Role::Other;
    }
    let is_length = ["linearaccelerometersensor", "tgf"].contains(&word);
    if is_length || word.contains("absol") || word.contains("magnitude") {
        return Role::Magnitude;
    }
    if let Some((axis, stem)) = along(word) {
        let is_bare = stem.is_empty() && !is_of_another_sensor(owner);
        if is_bare || is_acceleration(stem) || is_stated {
            let is_out = is_one_of(LINEAR, stem) || stem.contains("lin");
            let gravity = if is_out { Gravity::Out } else { Gravity::In };
            return Role::Along { axis, gravity };
        }
    }
    if is_stated || is_acceleration(word) {
        Role::Acceleration
    } else {
        Role::Other
    }
}

fn is_acceleration(word: &str) -> bool {
    is_one_of(ACCELERATIONS, word) || is_one_of(LINEAR, word)
}

fn is_one_of(words: &str, word: &str) -> bool {
    words.split(' ').any(|one| one == word)
}

/// The axis at the end of a word, and the part before it.
fn along(word: &str) -> Option<(usize, &str)> {
    let word = word.strip_suffix("axis").unwrap_or(word);
    (0..)
        .zip(AXES)
        .find_map(|(axis, letter)| Some((axis, word.strip_suffix(letter)?)))
}

fn is_of_another_sensor(owner: &str) -> bool {
    let file = owner.rsplit(['/', '\\', ':']).next().unwrap_or(owner);
    let file = file.to_lowercase();
    OTHER_SENSORS.split(' ').any(|sensor| file.contains(sensor))
}

/// A name without its unit, and the unit: `Time (s)`, `acc [mg]`, `time_ms`.
fn parted(name: &str) -> (&str, Option<&str>) {
    for (open, close) in [('(', ')'), ('[', ']')] {
        let inside = name
            .strip_suffix(close)
            .and_then(|name| name.rsplit_once(open));
        if let Some((words, unit)) = inside {
            return (words, Some(unit));
        }
    }
    match name.rsplit_once('_') {
        Some((words, unit))
            if unit.parse::<TimeUnit>().is_ok() || Unit::from_name(unit).is_some() =>
        {
            (words, Some(unit))
        }
        _ => (name, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn role_of(name: &str) -> Role {
        Column::new(name, "ride.csv").role
    }

    #[test]
    fn the_apps_names() {
        let z = |gravity| Role::Along { axis: 2, gravity };
        for name in [
            "Acceleration z (m/s^2)",
            "AccZ",
            "z",
            "accel_z",
            "az",
            "acc_z_g",
            "Z-axis [mg]",
            "gFz",
            "Acc_Z",
            "acc.z",
        ] {
            assert_eq!(role_of(name), z(Gravity::In), "{name}");
        }
        for name in [
            "Linear Acceleration z (m/s^2)",
            "FreeAcc_Z",
            "Lineare Beschleunigung z (m/s²)",
        ] {
            assert_eq!(role_of(name), z(Gravity::Out), "{name}");
        }
        for name in [
            "Time (s)",
            "Zeit (s)",
            "relative_time",
            "time",
            "timestamp_ns",
            "t [ms]",
            "millis",
            "SampleTimeFine",
            "TIMESTAMP",
        ] {
            assert!(matches!(role_of(name), Role::Time { .. }), "{name}");
        }
        for name in [
            "Absolute acceleration (m/s^2)",
            "LinearAccelerometerSensor",
            "TgF",
        ] {
            assert_eq!(role_of(name), Role::Magnitude, "{name}");
        }
        for name in ["acceleration", "acceleration (g)", "Vertical (m/s^2)"] {
            assert_eq!(role_of(name), Role::Acceleration, "{name}");
        }
        for name in ["Gyroscope z (rad/s)", "pressure", "", "Height (m)", "index"] {
            assert_eq!(role_of(name), Role::Other, "{name}");
        }
        assert_eq!(Column::new("z", "a.zip:Gyroscope.csv").role, Role::Other);
    }

    #[test]
    fn units_in_names() {
        assert_eq!(
            Column::new("Time (s)", "").time_unit,
            Some(TimeUnit::Seconds)
        );
        assert_eq!(
            Column::new("time_ms", "").time_unit,
            Some(TimeUnit::Milliseconds)
        );
        assert_eq!(Column::new("acc [mg]", "").unit, Some(Unit::Milligravity));
        assert_eq!(Column::new("AccZ", "").unit, None);
    }
}
