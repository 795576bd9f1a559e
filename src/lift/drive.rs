//! The start of a cage by a drive with limited jerk, acceleration and speed.
//!
//! The jerk is J for t_j, 0 for t_a, −J for t_j. With a = J t_j and T = 2 t_j + t_a the speed reached is
//! v = a (t_j + t_a), and by the point symmetry v(T − t) = v − v(t) the distance is vT/2. Solved for t_j and T:
//!
//! | | t_j | T |
//! |---|---|---|
//! | v ≥ A²/J: the acceleration A is reached | A/J | v/A + A/J |
//! | below | √(v/J) | 2 t_j |
//!
//! Braking is the same reversed in time, so a trip of speed v without uniform motion has D = vT. With T from
//! the table the highest such speed is
//!
//! | | v |
//! |---|---|
//! | D ≥ 2A³/J²: v² + (A²/J) v − AD = 0 | 2AD/(A²/J + √(A⁴/J² + 4AD)) |
//! | below: D = 2 J t_j³ | J t_j², t_j = ∛(D/2J) |
//!
//! A trip for which it exceeds V has speed V, with uniform motion for D/V − T.

use libm::{cbrt, sqrt};

/// The limits of a drive, each positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// V, m/s.
    pub speed: f64,
    /// A, m/s².
    pub acceleration: f64,
    /// J, m/s³.
    pub jerk: f64,
}

/// From rest to a speed, as fast as a drive allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Start {
    jerk: f64,
    /// t_j.
    ramp: f64,
    /// T.
    pub duration: f64,
    /// v.
    pub speed: f64,
}

impl Drive {
    /// Limits of a slow passenger lift: 0.7 m/s, 0.6 m/s², 0.8 m/s³.
    pub fn slow() -> Self {
        Self {
            speed: 0.7,
            acceleration: 0.6,
            jerk: 0.8,
        }
    }

    /// The start of a trip over `distance` metres.
    pub(super) fn start(&self, distance: f64) -> Start {
        self.start_to(self.speed.min(self.speed_without_uniform_motion(distance)))
    }

    /// A change of speed from a constant speed to one that differs by `speed`.
    pub(super) fn start_to(&self, speed: f64) -> Start {
        let Self {
            acceleration, jerk, ..
        } = *self;
        let (ramp, duration) = if speed >= acceleration * acceleration / jerk {
            let ramp = acceleration / jerk;
            (ramp, speed / acceleration + ramp)
        } else {
            let ramp = sqrt(speed / jerk);
            (ramp, 2.0 * ramp)
        };
        Start {
            jerk,
            ramp,
            duration,
            speed,
        }
    }

    fn speed_without_uniform_motion(&self, distance: f64) -> f64 {
        let Self {
            acceleration, jerk, ..
        } = *self;
        let knee = acceleration * acceleration / jerk;
        if distance >= 2.0 * acceleration * knee / jerk {
            let product = acceleration * distance;
            return 2.0 * product / (knee + sqrt(knee * knee + 4.0 * product));
        }
        let ramp = cbrt(distance / (2.0 * jerk));
        jerk * ramp * ramp
    }
}

impl Start {
    /// m/s², `time` seconds after the start.
    pub fn acceleration_at(&self, time: f64) -> f64 {
        let time = time.clamp(0.0, self.duration);
        self.jerk * time.min(self.duration - time).min(self.ramp)
    }

    /// m/s.
    pub fn speed_at(&self, time: f64) -> f64 {
        let time = time.clamp(0.0, self.duration);
        if 2.0 * time > self.duration {
            self.speed - self.early_speed(self.duration - time)
        } else {
            self.early_speed(time)
        }
    }

    /// m.
    pub fn way_at(&self, time: f64) -> f64 {
        let time = time.clamp(0.0, self.duration);
        if 2.0 * time > self.duration {
            let left = self.duration - time;
            self.speed * (self.duration / 2.0 - left) + self.early_way(left)
        } else {
            self.early_way(time)
        }
    }

    /// The speed in the first half.
    fn early_speed(&self, time: f64) -> f64 {
        let curved = time.min(self.ramp);
        self.jerk * curved * (curved / 2.0 + (time - curved))
    }

    /// The distance in the first half.
    fn early_way(&self, time: f64) -> f64 {
        let curved = time.min(self.ramp);
        let straight = time - curved;
        let of_curve = curved * curved / 6.0;
        self.jerk * curved * (of_curve + straight * (curved + straight) / 2.0)
    }
}
