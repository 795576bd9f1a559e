//! Column names: time or acceleration, axis and unit.
//!
//! Each app has its own names, and phyphox translates them; the unit in brackets and the letter of the axis
//! are the same in every language.

use super::axis::Axis;
use super::reading::{TimeUnit, Unit};

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Column {
    pub name: String,
    pub role: Role,
    /// The unit in the name, if any.
    pub time_unit: Option<TimeUnit>,
    /// The unit in the name, if any.
    pub unit: Option<Unit>,
}

/// The apparent content of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Role {
    /// Time; of several, the one with the lowest rank is the record's own clock.
    Time { rank: u8 },
    /// The acceleration along one axis.
    Along { axis: Axis, gravity: Gravity },
    /// An acceleration without an axis in its name.
    Acceleration,
    /// The length of the vector of acceleration, which has no sign.
    Magnitude,
    /// Anything else.
    Other,
}

/// Whether a column includes gravity, by its name.
#[derive(Clone, Copy, Debug, Eq, Ord, PartialEq, PartialOrd)]
pub(super) enum Gravity {
    /// Left in, or not mentioned.
    In,
    /// Taken out by the device.
    Out,
}

/// Names of the clock, the best first.
const CLOCKS: [&str; 9] = [
    "secondselapsed",
    "elapsed",
    "elapsedtime",
    "relativetime",
    "time",
    "t",
    "timestamp",
    "timestamps",
    "unixtime",
];

/// Names of an acceleration, before an axis or alone.
const ACCELERATIONS: [&str; 8] = [
    "a",
    "acc",
    "accel",
    "acceleration",
    "accelerometer",
    "accelerometeracceleration",
    "totalacceleration",
    "verticalacceleration",
];

/// Names of an acceleration without gravity.
const LINEAR: [&str; 6] = [
    "linearacceleration",
    "linearaccelerometer",
    "linearaccel",
    "linacc",
    "linaccel",
    "useracceleration",
];

/// Words in the names of files whose x, y and z are not accelerations.
const OTHER_SENSORS: [&str; 9] = [
    "gyro",
    "magnet",
    "gravity",
    "orient",
    "rotation",
    "attitude",
    "location",
    "baro",
    "pedometer",
];

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
        let role = if is_foreign {
            Role::Other
        } else {
            role(&word, time_unit, unit, owner)
        };
        Self {
            name: name.to_owned(),
            role,
            time_unit,
            unit,
        }
    }
}

fn role(word: &str, time_unit: Option<TimeUnit>, unit: Option<Unit>, owner: &str) -> Role {
    if unit.is_none() {
        if let Some(rank) = CLOCKS.iter().position(|clock| *clock == word) {
            return Role::Time { rank: rank as u8 };
        }
        if time_unit.is_some() {
            return Role::Time {
                rank: CLOCKS.len() as u8,
            };
        }
    }
    let is_stated = unit.is_some();
    if word.contains("gravit") {
        return Role::Other;
    }
    if word.contains("absol") || word.contains("magnitude") || word == "linearaccelerometersensor" {
        return Role::Magnitude;
    }
    if let Some((axis, stem)) = along(word) {
        let is_bare = stem.is_empty() && !is_of_another_sensor(owner);
        let is_named = ACCELERATIONS.contains(&stem) || LINEAR.contains(&stem);
        if is_bare || is_named || is_stated {
            let is_out = stem.contains("lin") || stem.contains("user");
            let gravity = if is_out { Gravity::Out } else { Gravity::In };
            return Role::Along { axis, gravity };
        }
    }
    if is_stated || ACCELERATIONS.contains(&word) || LINEAR.contains(&word) {
        Role::Acceleration
    } else {
        Role::Other
    }
}

/// The axis at the end of a word, and the part before it.
fn along(word: &str) -> Option<(Axis, &str)> {
    let word = word.strip_suffix("axis").unwrap_or(word);
    let axes = [('x', Axis::X), ('y', Axis::Y), ('z', Axis::Z)];
    axes.into_iter()
        .find_map(|(letter, axis)| Some((axis, word.strip_suffix(letter)?)))
}

fn is_of_another_sensor(owner: &str) -> bool {
    let file = owner.rsplit(['/', '\\', ':']).next().unwrap_or(owner);
    let file = file.to_lowercase();
    OTHER_SENSORS.iter().any(|sensor| file.contains(sensor))
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
        let z = |gravity| Role::Along {
            axis: Axis::Z,
            gravity,
        };
        for name in [
            "Acceleration z (m/s^2)",
            "AccZ",
            "z",
            "accel_z",
            "az",
            "acc_z_g",
            "Z-axis [mg]",
        ] {
            assert_eq!(role_of(name), z(Gravity::In), "{name}");
        }
        for name in [
            "Linear Acceleration z (m/s^2)",
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
        ] {
            assert!(matches!(role_of(name), Role::Time { .. }), "{name}");
        }
        for name in ["Absolute acceleration (m/s^2)", "LinearAccelerometerSensor"] {
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
