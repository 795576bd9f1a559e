//! Axes: from data to a share of a panel's width or height, with ticks and a label.

use super::scale::Scale;
use crate::format::minus;

/// Values that span more than this are drawn on a logarithmic axis.
pub const LONG_RANGE: f64 = 30.0;

/// One direction of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Data at the two ends.
    pub from: f64,
    pub to: f64,
    /// None where names stand along it.
    pub scale: Option<Scale>,
    /// Where ticks stand, and what they say.
    pub ticks: Vec<(f64, String)>,
    pub label: String,
}

impl Axis {
    /// Ticks where the caller wants them.
    pub fn new(from: f64, to: f64, ticks: Vec<(f64, String)>) -> Self {
        let (label, scale) = (String::new(), Some(Scale::Linear));
        Self {
            from,
            to,
            scale,
            ticks,
            label,
        }
    }

    /// `from` to `to` with about `count` ticks at 1, 2 or 5 times a power of ten. A single value stands in the
    /// middle.
    pub fn linear(from: f64, to: f64, count: usize) -> Self {
        if from >= to {
            return Self::single(from);
        }
        let (step, decimals) = tick_step((to - from) / count as f64);
        let first = (from / step - 1e-9).ceil() as i64;
        let last = (to / step + 1e-9).floor() as i64;
        let values: Vec<f64> = (first..=last).map(|i| i as f64 * step).collect();
        let mut labels = plain(&values, decimals);
        if labels.iter().any(|label| label.len() > LONGEST_LABEL) {
            labels = scientific(&values, step);
        }
        let labels = labels.iter().map(|label| minus(label));
        Self::new(from, to, values.into_iter().zip(labels).collect())
    }

    /// One value in the middle.
    pub fn single(value: f64) -> Self {
        let plain = value.to_string();
        let label = if plain.len() > LONGEST_LABEL {
            format!("{value:.1e}")
        } else {
            plain
        };
        // A half is lost beside a number of sixteen digits.
        let room = if value.abs() < 1e15 {
            0.5
        } else {
            0.5 * value.abs()
        };
        Self::new(value - room, value + room, vec![(value, minus(&label))])
    }

    /// Decimal logarithms, `from` to `to`, with ticks at the powers of ten, and at 2 and 5 times them
    /// where there is room.
    pub fn logarithms(from: f64, to: f64) -> Self {
        let factors: &[f64] = if to - from > 2.9 {
            &[1.0]
        } else {
            &[1.0, 2.0, 5.0]
        };
        let ticks = ((from.floor() as i32)..=(to.ceil() as i32))
            .map(|power| libm::pow(10.0, f64::from(power)))
            .flat_map(|power| factors.iter().map(move |factor| factor * power))
            .map(|value| (libm::log10(value), (value * 1e12).round() / 1e12))
            .filter(|(x, _)| (from - 1e-9..=to + 1e-9).contains(x))
            .map(|(x, value)| (x, value.to_string()));
        Self::new(from, to, ticks.collect()).on(Scale::Log)
    }

    /// Decimal logarithms, `from` to `to`, with ticks at some of the powers of ten, about `count`.
    pub fn powers_of_ten(from: f64, to: f64, count: usize) -> Self {
        let (first, last) = (from.ceil() as i32, to.floor() as i32);
        let step = ((to - from) / count as f64).ceil().max(1.0) as usize;
        let powers = (first..=last).rev().step_by(step);
        let ticks = powers.map(|power| (f64::from(power), power_of_ten(power)));
        Self::new(from, to, ticks.collect()).on(Scale::Log)
    }

    /// Decimal logarithms with as many ticks as there is room for.
    pub fn decades(from: f64, to: f64) -> Self {
        if to - from < 2.5 {
            Self::logarithms(from, to)
        } else {
            Self::powers_of_ten(from, to, 6)
        }
    }

    /// Names at 0, 1, 2, …
    pub fn names(names: Vec<String>) -> Self {
        let to = names.len() as f64 - 0.5;
        let ticks = (0..).map(f64::from).zip(names);
        Self {
            scale: None,
            ..Self::new(-0.5, to, ticks.collect())
        }
    }

    /// Places of a scale, `from` to `to`, with about so many ticks.
    pub fn scaled(scale: Scale, from: f64, to: f64, count: usize) -> Self {
        let axis = match scale {
            Scale::Linear => return Self::linear(from, to, count),
            Scale::Log => Self::decades(from, to),
            Scale::Probit => Self::probits(from, to),
        };
        if axis.ticks.len() >= 3 {
            return axis;
        }
        // Between two usual ticks, those of a linear axis.
        let values = Self::linear(scale.value(from), scale.value(to), count);
        let ticks = values.ticks.into_iter();
        Self {
            ticks: ticks
                .map(|(value, label)| (scale.place(value), label))
                .collect(),
            ..axis
        }
    }

    /// Quantiles of the normal law, with ticks at the usual probabilities.
    fn probits(from: f64, to: f64) -> Self {
        const TAIL: [f64; 8] = [1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2];
        let low = TAIL.iter().map(|tail| (*tail, tail.to_string()));
        // Said by subtraction in decimals: 0.999, not 0.9989999.
        let high = TAIL.iter().rev().map(|tail| {
            let decimals = tail.to_string().len() - 2;
            (1.0 - tail, format!("{:.decimals$}", 1.0 - tail))
        });
        let all = low.chain([(0.5, "0.5".to_owned())]).chain(high);
        let ticks = all.map(|(value, label)| (Scale::Probit.place(value), label));
        let ticks = ticks.filter(|(place, _)| (from..=to).contains(place));
        Self::new(from, to, ticks.collect()).on(Scale::Probit)
    }

    fn on(self, scale: Scale) -> Self {
        let scale = Some(scale);
        Self { scale, ..self }
    }

    /// Numbers, or their logarithms, with a little room on either side. Of a few whole numbers each has its tick.
    pub fn around(places: impl IntoIterator<Item = f64>, is_logarithmic: bool) -> Self {
        let mut places: Vec<f64> = places.into_iter().collect();
        let (low, high) = ends(places.iter().copied());
        let room = 0.025 * (high - low);
        if low == high {
            return Self::single(low);
        }
        let axis = if is_logarithmic {
            Self::logarithms(low, high)
        } else {
            Self::linear(low, high, 7)
        };
        places.sort_by(f64::total_cmp);
        places.dedup();
        let value = |place: &f64| axis.scale.unwrap_or(Scale::Linear).value(*place);
        let value = |place: &f64| (value(place) * 1e9).round() / 1e9;
        let are_few = places.len() <= FEW && places.iter().map(value).all(|it| it.fract() == 0.0);
        let axis = if are_few {
            let ticks = places.iter().map(|at| (*at, minus(&value(at).to_string())));
            Self {
                ticks: ticks.collect(),
                ..axis
            }
        } else {
            axis
        };
        axis.within(low - room, high + room)
    }

    /// The same ticks between other ends.
    pub fn within(self, from: f64, to: f64) -> Self {
        Self { from, to, ..self }
    }

    /// The same with these words along it.
    pub fn labelled(self, label: impl Into<String>) -> Self {
        let label = label.into();
        Self { label, ..self }
    }

    /// The same without words.
    pub fn unlabelled(&self) -> Self {
        let ticks = self.ticks.iter().map(|(at, _)| (*at, String::new()));
        Self {
            ticks: ticks.collect(),
            label: String::new(),
            ..self.clone()
        }
    }

    /// 0 at the start, 1 at the end.
    pub fn share(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from)
    }
}

/// So many whole numbers have a tick each.
const FEW: usize = 10;

/// Of a tick: longer labels run over the edge of the sheet.
const LONGEST_LABEL: usize = 8;

fn plain(values: &[f64], decimals: usize) -> Vec<String> {
    let label = |value: &f64| format!("{value:.decimals$}");
    values.iter().map(label).collect()
}

/// With so many digits that values a `step` apart differ.
fn scientific(values: &[f64], step: f64) -> Vec<String> {
    let power = |value: f64| libm::floor(libm::log10(value.abs()) + 1e-9);
    let label = |&value: &f64| {
        if value == 0.0 {
            return "0".to_owned();
        }
        let digits = (power(value) - power(step)).clamp(0.0, 15.0) as usize;
        format!("{value:.digits$e}")
    };
    values.iter().map(label).collect()
}

/// Whether values span so much that their logarithms are drawn.
pub fn is_long(values: &[f64]) -> bool {
    let (smallest, largest) = ends(values.iter().copied());
    smallest > 0.0 && largest >= LONG_RANGE * smallest
}

/// The smallest and the largest.
pub fn ends(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let widen = |(low, high): (f64, f64), value| (low.min(value), high.max(value));
    values.into_iter().fold(start, widen)
}

/// The next step of 1, 2 or 5 times a power of ten from `rough` on, and the decimals it takes.
fn tick_step(rough: f64) -> (f64, usize) {
    let finer = -(libm::floor(libm::log10(rough)) as i32);
    let mut decimals = finer.max(9);
    loop {
        let power = libm::pow(10.0, f64::from(-decimals));
        for factor in [1.0, 2.0, 5.0] {
            if factor * power >= rough * (1.0 - 1e-9) {
                return (factor * power, decimals.max(0) as usize);
            }
        }
        decimals -= 1;
    }
}

/// 10⁻³.
pub fn power_of_ten(power: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = power.to_string();
    let raised = digits.chars().map(|c| match c.to_digit(10) {
        Some(digit) => RAISED[digit as usize],
        None => '⁻',
    });
    format!("10{}", raised.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the data, labels are short, differ, and stand where they say.
    #[test]
    fn labels_of_any_size() {
        for exponent in -99..=99 {
            let scale = libm::pow(10.0, f64::from(exponent));
            for (from, to) in [(0.0, 1.0), (-3.0, 7.0), (1.0, 1.0), (-0.06, 0.34)] {
                let axis = Axis::linear(from * scale, to * scale, 5);
                for (at, label) in &axis.ticks {
                    assert!(label.chars().count() <= LONGEST_LABEL, "{label}");
                    let said: f64 = label.replace('−', "-").parse().unwrap();
                    let step = (axis.to - axis.from).max(at.abs() * 1e-2);
                    assert!((said - at).abs() <= 1e-2 * step, "{label} at {at:e}");
                }
                let mut labels: Vec<_> = axis.ticks.iter().map(|(_, label)| label).collect();
                labels.dedup();
                assert_eq!(labels.len(), axis.ticks.len());
            }
        }
    }
}
