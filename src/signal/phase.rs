//! The phases of a ride in [^1].
//!
//! [^1]: see [`crate::signal`].

/// A phase of a ride.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Phase {
    /// It stands.
    Rest,
    /// It gains speed: Δ acts.
    Accelerating,
    /// It moves by itself.
    Inertial,
    /// It loses speed: −Δ acts.
    Braking,
    /// It creeps to the landing.
    Levelling,
}

impl Phase {
    /// All phases.
    pub const ALL: [Self; 5] = [
        Self::Rest,
        Self::Accelerating,
        Self::Inertial,
        Self::Braking,
        Self::Levelling,
    ];

    /// Whether the cage moves.
    pub fn moves(self) -> bool {
        self != Self::Rest
    }

    /// The sign of Δ: 1, 0 or −1.
    pub fn sign(self) -> f64 {
        match self {
            Self::Accelerating => 1.0,
            Self::Braking => -1.0,
            Self::Rest | Self::Inertial | Self::Levelling => 0.0,
        }
    }

    /// The name in configs and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rest => "rest",
            Self::Accelerating => "acceleration",
            Self::Inertial => "inertial",
            Self::Braking => "braking",
            Self::Levelling => "levelling",
        }
    }
}
