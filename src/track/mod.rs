//! Where the car is, from an accelerometer alone: its trips, the floors of the building, stops where no floor is.

pub mod floors;
pub mod map;
