//! What else a sensor feels: people, hands, ropes, and its own faults.

use super::class::Class;
use crate::lift::draws::Draws;
use crate::lift::pulse::{Pulse, Shape};
use crate::recording::GRAVITY;
use libm::cos;
use std::f64::consts::PI;

/// One disturbance of the kind that a class is named after; none for other classes.
pub(super) fn disturbance(class: Class, from: f64, draws: &mut Draws) -> Vec<Pulse> {
    let shapes = match class {
        Class::LevelShift => vec![Shape::Level {
            offset: draws.sign() * draws.within([0.02, 0.1]),
            seconds: draws.within([3.0, 15.0]),
        }],
        Class::LevelStep => vec![Shape::Level {
            offset: draws.sign() * draws.within([0.02, 0.1]),
            seconds: f64::INFINITY,
        }],
        Class::Shocks => vec![Shape::HalfSine {
            peak: draws.sign() * draws.decades([2.0, 20.0]),
            seconds: draws.within([0.01, 0.08]),
        }],
        Class::Boarding => vec![Shape::Bounce {
            depth: draws.sign() * draws.within([0.005, 0.03]),
            frequency: draws.within([0.5, 1.5]),
            damping: draws.within([0.03, 0.15]),
        }],
        Class::Tilt => vec![
            Shape::Level {
                offset: -GRAVITY * (1.0 - cos(draws.within([2.0, 6.0]) * PI / 180.0)),
                seconds: f64::INFINITY,
            },
            Shape::Sine {
                peak: draws.sign() * draws.within([0.3, 2.0]),
                seconds: draws.within([0.2, 0.5]),
            },
        ],
        Class::Turned | Class::TurnedAtStart => vec![Shape::Level {
            offset: draws.sign() * draws.within([0.1, 0.5]),
            seconds: f64::INFINITY,
        }],
        Class::Held => return holding(from, draws),
        Class::Jumps => return jump(from, 0.3, draws.decades([0.05, 1.0])).into(),
        _ => Vec::new(),
    };
    let pulses = shapes.into_iter().map(|shape| Pulse { from, shape });
    pulses.collect()
}

/// A person jumps: pushes off, flies, lands. The cage feels a share of it, the ratio of the masses. Its net speed
/// is zero.
pub(super) fn jump(from: f64, flight: f64, share: f64) -> [Pulse; 3] {
    const PUSH: f64 = 0.25;
    const LANDING: f64 = 0.15;
    let g = share * GRAVITY;
    // Push and landing each carry half of the flight's impulse: peak · 2t/π = gT/2.
    let half_sine = |seconds: f64| Shape::HalfSine {
        peak: g * flight * PI / (4.0 * seconds),
        seconds,
    };
    let flying = Shape::Level {
        offset: -g,
        seconds: flight,
    };
    let pulse = |from, shape| Pulse { from, shape };
    [
        pulse(from, half_sine(PUSH)),
        pulse(from + PUSH, flying),
        pulse(from + PUSH + flight, half_sine(LANDING)),
    ]
}

/// Somebody picks the sensor up, holds it askew with a tremor, and puts it down a little otherwise than it lay.
fn holding(from: f64, draws: &mut Draws) -> Vec<Pulse> {
    const TREMOR: f64 = 0.7;
    let (seconds, offset) = (draws.within([3.0, 8.0]), -draws.within([0.1, 0.5]));
    let until = from + seconds;
    let mut pulses = Vec::new();
    let mut add = |from, shape| pulses.push(Pulse { from, shape });
    add(from, Shape::Level { offset, seconds });
    // It is lifted and lowered again by about half a metre.
    for from in [from, until - 1.0] {
        let seconds = draws.within([0.5, 1.0]);
        let peak = draws.sign() * draws.within([2.0, 4.0]);
        add(from, Shape::Sine { peak, seconds });
    }
    for period in 0..(seconds / TREMOR) as usize {
        let peak = draws.within([0.05, 0.15]);
        let seconds = TREMOR;
        add(from + TREMOR * period as f64, Shape::Sine { peak, seconds });
    }
    let offset = draws.within([-0.05, 0.05]);
    let seconds = f64::INFINITY;
    add(until, Shape::Level { offset, seconds });
    pulses
}

/// Somebody handles the sensor: tilts and swings.
pub(super) fn handling(from: f64, to: f64, draws: &mut Draws) -> Vec<Pulse> {
    let mut pulses = Vec::new();
    let mut now = from;
    while now < to {
        let seconds = draws.within([0.3, 1.0]).min(to - now);
        let offset = draws.within([-1.0, 0.3]);
        let shape = Shape::Level { offset, seconds };
        pulses.push(Pulse { from: now, shape });
        now += seconds;
    }
    let mut now = from;
    while now < to {
        let seconds = draws.within([0.1, 0.5]).min(to - now);
        let peak = draws.sign() * draws.within([2.0, 8.0]);
        let shape = Shape::Sine { peak, seconds };
        pulses.push(Pulse { from: now, shape });
        now += seconds * draws.within([1.0, 1.5]);
    }
    pulses
}
