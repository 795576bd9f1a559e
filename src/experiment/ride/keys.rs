//! `[ride]` as it stands in the file. Its keys may be changed by `[[ride.curve]]`, and one of them is swept by
//! `[ride.axis]`; nothing here has a default.

use super::Measure;
use crate::config::file::{AxisTable, section};
use crate::config::value::{Number, Whole};
use crate::whiten::Order;
use serde::Deserialize;
use std::ops::Range;
use toml::Spanned;

/// The keys, on their own and beside what only the table or a curve has. (`flatten` would lose the place of
/// an error.)
macro_rules! keys {
    ($($key:ident: $kind:ty),* $(,)?) => {
        section! {
            /// The keys that a curve may change.
            RideKeys { $($key: $kind),* }
        }

        impl RideKeys {
            /// Their names.
            pub const NAMES: &[&'static str] = &[$(stringify!($key)),*];
        }

        /// `[ride]`
        #[derive(Clone, Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(in crate::config) struct RideTable {
            pub measure: Measure,
            pub axis: AxisTable,
            #[serde(default)]
            pub curve: Vec<CurveTable>,
            $($key: Option<Spanned<$kind>>,)*
        }

        /// `[[ride.curve]]`
        #[derive(Clone, Debug, Default, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(in crate::config) struct CurveTable {
            pub label: Option<Spanned<String>>,
            $($key: Option<Spanned<$kind>>,)*
        }

        impl RideTable {
            pub(super) fn keys(&self) -> RideKeys {
                RideKeys { $($key: self.$key.clone()),* }
            }
        }

        impl CurveTable {
            pub(super) fn keys(&self) -> RideKeys {
                RideKeys { $($key: self.$key.clone()),* }
            }
        }
    };
}

keys! {
    distance: Number,
    speed: Number,
    acceleration: Number,
    jerk: Number,
    trips: Whole,
    rest: [Number; 2],
    length: Number,
    jam_within: Number,
    tolerance: Number,
    rate: Number,
    sigma: Number,
    density: Number,
    delta_over_sigma: Number,
    ar: Vec<Number>,
    vibration: Number,
    nu: Number,
    theta: Number,
    quantum: Number,
    footfalls: Number,
    jolt: Number,
    block: Number,
    reference: Whole,
    shift: Whole,
    scale: Whole,
    gap: Whole,
    alpha: Number,
    training: Whole,
    order: Order,
    least_speed: Number,
    least_acceleration: Number,
    most_acceleration: Number,
    learnt: bool,
    begins_at_rest: bool,
    motion_shows: bool,
}

/// Three ways to say one thing: how strong the noise is.
pub(super) const STRENGTH: [&str; 3] = ["sigma", "density", "delta_over_sigma"];

impl RideKeys {
    /// These keys where they say something, `base` where they do not. The strength of the noise is one
    /// choice: naming any replaces the others.
    pub fn laid_over(&self, base: &Self) -> Self {
        let mut base = base.clone();
        if STRENGTH.iter().any(|key| self.span(key).is_some()) {
            (base.sigma, base.density, base.delta_over_sigma) = (None, None, None);
        }
        self.over(&base)
    }
}
