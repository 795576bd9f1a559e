//! Floor maps against a building that is known.

mod alarms;
mod estimate;
mod faults;
mod healing;
mod starts;
mod world;
