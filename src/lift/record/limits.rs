//! One trip by given limits, where a study wants to know its distance.

use super::lift::Lift;
use crate::lift::Journey;
use crate::lift::drive::Drive;
use crate::lift::pulse::Pulse;

/// How a lift moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Its speed, and the limits of its starts.
    pub drive: Drive,
    /// The limits of its braking.
    pub braking: Drive,
    /// The speed, m/s, and the time, s, of the levelling; 0 for none.
    pub levelling: (f64, f64),
}

/// Trips are so long as they should be, m, where that is found within so many tries.
const EXACT: f64 = 1e-9;
const MOST_TRIES: usize = 100;

impl Limits {
    /// A trip over `distance` metres, up positive, after and before a rest, s; and the mean acceleration around each sample
    /// at a rate, Hz.
    pub fn trip(&self, rests: [f64; 2], distance: f64, rate: f64) -> (Journey, Vec<f64>) {
        let [start, after] = rests;
        let lift = Lift::of(self.drive, self.braking, self.levelling);
        let mut motion: Vec<Pulse> = Vec::new();
        let mut journey = lift.trip(start, distance, None, &mut motion);
        // The levelling of a trip too short for its full speed leads beyond the floor.
        let mut way = distance;
        for _ in 0..MOST_TRIES {
            let beyond = journey.distance - distance;
            if beyond.abs() <= EXACT {
                break;
            }
            way -= beyond;
            motion.clear();
            journey = lift.trip(start, way, None, &mut motion);
        }
        let samples = ((journey.stop + after) * rate) as usize;
        let mut acceleration = vec![0.0; samples];
        for pulse in motion {
            pulse.add_to(&mut acceleration, rate, rate);
        }
        (journey, acceleration)
    }
}
