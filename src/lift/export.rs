//! A simulated ride as files: the record as phyphox exports it, the truth beside it.
//!
//! The clock of a record starts with the period of its first sample, which is a mean, so sample i is at
//! (i + ½)/rate, and the truth is shifted by half a period too. Printed numbers do not depend on the machine.

use super::{Ending, Journey, Ride, Stop};
use libm::sqrt;
use std::io::{self, Write};

/// The layout of an export: that of one of phyphox's experiments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExportLayout {
    /// Acceleration without g.
    Linear,
    /// Acceleration with g.
    WithGravity,
}

impl ExportLayout {
    fn quantity(self) -> (&'static str, &'static str) {
        match self {
            Self::Linear => ("Linear Acceleration", "Absolute acceleration"),
            Self::WithGravity => ("Acceleration", "Absolute acceleration"),
        }
    }
}

/// Writes three axes (m/s²) and their times (s), of equal length, without a final newline, as phyphox does.
///
/// # Errors
/// If writing to `out` fails.
pub fn write_phyphox(
    out: &mut impl Write,
    layout: ExportLayout,
    times: &[f64],
    [x, y, z]: [&[f64]; 3],
) -> io::Result<()> {
    let (axis, absolute) = layout.quantity();
    let columns = ["x", "y", "z"].map(|name| format!("\"{axis} {name} (m/s^2)\""));
    let columns = columns.join(",");
    write!(out, "\"Time (s)\",{columns},\"{absolute} (m/s^2)\"")?;
    for (time, ((x, y), z)) in times.iter().zip(x.iter().zip(y).zip(z)) {
        let absolute = sqrt(x * x + y * y + z * z);
        // Adding zero makes −0 the same as 0.
        let [x, y, z] = [x + 0.0, y + 0.0, z + 0.0];
        write!(out, "\n{time:.9E},{x:.9E},{y:.9E},{z:.9E},{absolute:.9E}")?;
    }
    Ok(())
}

/// Writes the trips, one per line: times in s on the clock of the record, with the start and end of uniform
/// motion in `uniform` and `braking`, the distance in m, up positive, and the highest speed in m/s. Of a building
/// also the start of the creep to the landing, the floors that each trip is from and to, where the car stands at its
/// end, m, and what went wrong.
///
/// # Errors
/// If writing to `out` fails.
pub fn write_truth(out: &mut impl Write, ride: &Ride, stops: &[Stop]) -> io::Result<()> {
    write!(
        out,
        "start,stop,direction,distance,speed,ended,uniform,braking"
    )?;
    if !stops.is_empty() {
        write!(out, ",levelling,from,to,height,fault")?;
    }
    writeln!(out)?;
    let clock = |time: f64| time + 0.5 / ride.rate();
    for (place, (journey, trip)) in ride.journeys().iter().zip(ride.trips()).enumerate() {
        let Journey {
            start,
            uniform,
            braking,
            stop,
            distance,
            speed,
            ..
        } = *journey;
        let [start, uniform, braking, stop] = [start, uniform, braking, stop].map(clock);
        let direction = if journey.direction > 0 { "up" } else { "down" };
        let ended = match trip.ending {
            Ending::Jam { .. } => "jam",
            Ending::Emergency(_) => "emergency",
            Ending::Commanded | Ending::Braked(_) => "commanded",
        };
        write!(
            out,
            "{start:.6},{stop:.6},{direction},{distance:.6},{speed:.6},{ended},{uniform:.6},{braking:.6}"
        )?;
        if let Some(stop) = stops.get(place) {
            let levelling = journey.levelling.map(clock);
            let levelling = levelling.map_or(String::new(), |time| format!("{time:.6}"));
            let fault = stop.fault.map_or("", |fault| fault.name());
            let Stop {
                from, to, height, ..
            } = stop;
            write!(out, ",{levelling},{from},{to},{height:.6},{fault}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lift::{Drive, Ending, Trip};

    #[test]
    fn phyphox_layout() {
        let mut out = Vec::new();
        let axes: [&[f64]; 3] = [&[3.0, -0.0], &[0.0, 0.0], &[-4.0, 1.25e-3]];
        write_phyphox(&mut out, ExportLayout::Linear, &[0.01, 0.03], axes).unwrap();
        let expected = "\"Time (s)\",\"Linear Acceleration x (m/s^2)\",\
            \"Linear Acceleration y (m/s^2)\",\"Linear Acceleration z (m/s^2)\",\
            \"Absolute acceleration (m/s^2)\"\n\
            1.000000000E-2,3.000000000E0,0.000000000E0,-4.000000000E0,5.000000000E0\n\
            3.000000000E-2,0.000000000E0,0.000000000E0,1.250000000E-3,1.250000000E-3";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
        let mut out = Vec::new();
        write_phyphox(&mut out, ExportLayout::WithGravity, &[], [&[]; 3]).unwrap();
        assert!(out.starts_with(b"\"Time (s)\",\"Acceleration x (m/s^2)\","));
    }

    /// Times by hand: v = 1 after T = v/A + A/J = 2, uniform for D/v − T = 1.
    #[test]
    fn truth_layout() {
        let drive = Drive {
            speed: 1.0,
            acceleration: 1.0,
            jerk: 1.0,
        };
        let jam = Ending::Jam {
            after: 2.5,
            within: 0.5,
        };
        let trip = |distance, ending| Trip {
            distance,
            drive,
            ending,
        };
        let trips = vec![trip(3.0, Ending::Commanded), trip(-3.0, jam)];
        let ride = Ride::new(100.0, vec![1.0; 3], trips).unwrap();
        let mut out = Vec::new();
        write_truth(&mut out, &ride, &[]).unwrap();
        let expected = "start,stop,direction,distance,speed,ended,uniform,braking\n\
            1.005000,6.005000,up,3.000000,1.000000,commanded,3.005000,4.005000\n\
            7.005000,10.005000,down,-1.750000,1.000000,jam,9.005000,9.505000\n";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }
}
