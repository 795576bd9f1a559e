//! Rides against closed forms and against integration by brute force.
