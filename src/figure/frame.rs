//! Axes: a plot rectangle on a sheet, its scales, ticks and labels.

use super::FigureError;
use super::sheet::Sheet;
use super::text::{Align, Style, text_width};
use crate::format::minus;
use plotters::prelude::{BLACK, Color, DrawingBackend, RGBColor};

/// Em size of tick labels, in points.
pub(super) const SMALL: f64 = 8.0;
/// Em size of the caption.
pub(super) const CAPTION: f64 = 7.5;
/// Em size of axis labels.
pub(super) const NORMAL: f64 = 9.0;

/// Width of every picture, in points.
pub(super) const WIDTH: f64 = 396.0;
/// From one line of a caption to the next.
pub(super) const CAPTION_STEP: f64 = 10.5;
/// Where a caption starts.
pub(super) const CAPTION_LEFT: f64 = 10.0;
/// Between panels one under the other.
const BETWEEN: f64 = 10.0;

const AXIS_WIDTH: f64 = 0.6;
const TICK: f64 = 3.0;
const GRID: RGBColor = RGBColor(225, 225, 225);

/// From data to points along one direction.
#[derive(Clone, Debug)]
pub(super) struct Scale {
    /// Data at the two ends.
    pub from: f64,
    pub to: f64,
    /// Where ticks stand, and what they say.
    pub ticks: Vec<(f64, String)>,
}

/// A rectangle with axes.
pub(super) struct Frame {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
    pub x: Scale,
    pub y: Scale,
}

impl Scale {
    /// `from` to `to` with about `count` ticks at 1, 2 or 5 times a power of ten.
    pub fn linear(from: f64, to: f64, count: usize) -> Self {
        let (step, decimals) = tick_step((to - from) / count as f64);
        let first = (from / step - 1e-9).ceil() as i64;
        let last = (to / step + 1e-9).floor() as i64;
        let tick = |i: i64| {
            let value = i as f64 * step;
            (value, minus(&format!("{value:.decimals$}")))
        };
        Self {
            from,
            to,
            ticks: (first..=last).map(tick).collect(),
        }
    }

    /// One value in the middle.
    pub fn single(value: f64) -> Self {
        Self {
            from: value - 0.5,
            to: value + 0.5,
            ticks: vec![(value, minus(&value.to_string()))],
        }
    }

    /// Decimal logarithms, `from` to `to`, with ticks at the powers of ten, and at 2 and 5 times them
    /// where there is room.
    pub fn logarithms(from: f64, to: f64) -> Self {
        let powers = (from.floor() as i32)..=(to.ceil() as i32);
        let factors: &[f64] = if to - from > 2.9 {
            &[1.0]
        } else {
            &[1.0, 2.0, 5.0]
        };
        let at = |power: i32| {
            factors
                .iter()
                .map(move |factor| factor * libm::pow(10.0, f64::from(power)))
        };
        let values = powers.flat_map(at);
        let ticks = values.map(|value| {
            (
                libm::log10(value),
                format!("{}", (value * 1e12).round() / 1e12),
            )
        });
        Self {
            from,
            to,
            ticks: ticks
                .filter(|(x, _)| (from - 1e-9..=to + 1e-9).contains(x))
                .collect(),
        }
    }

    /// Decimal logarithms, `from` to `to`, with ticks at some of the powers of ten, about `count`.
    pub fn powers_of_ten(from: f64, to: f64, count: usize) -> Self {
        let (first, last) = (from.ceil() as i32, to.floor() as i32);
        let step = ((to - from) / count as f64).ceil().max(1.0) as usize;
        let ticks = (first..=last).rev().step_by(step);
        Self {
            from,
            to,
            ticks: ticks
                .map(|power| (f64::from(power), power_of_ten(power)))
                .collect(),
        }
    }

    /// Decimal logarithms with as many ticks as there is room for.
    pub fn decades(from: f64, to: f64) -> Self {
        match to - from < 2.5 {
            true => Self::logarithms(from, to),
            false => Self::powers_of_ten(from, to, 6),
        }
    }

    /// The same without the words at its ticks.
    pub fn unlabelled(&self) -> Self {
        let ticks = self.ticks.iter().map(|(at, _)| (*at, String::new()));
        Self {
            ticks: ticks.collect(),
            ..self.clone()
        }
    }

    /// Names at 0, 1, 2, …
    pub fn names(names: &[String]) -> Self {
        Self {
            from: -0.5,
            to: names.len() as f64 - 0.5,
            ticks: names
                .iter()
                .enumerate()
                .map(|(i, name)| (i as f64, name.clone()))
                .collect(),
        }
    }

    /// The ticks that find room on `width` points, the first and every so many after it.
    pub fn sparse_ticks(&self, width: f64) -> Vec<(f64, String)> {
        let widest = self.ticks.iter().map(|(_, label)| text_width(label, SMALL));
        let needed = widest.fold(0.0, f64::max) + 6.0;
        let every = (needed * self.ticks.len() as f64 / width).ceil().max(1.0);
        self.ticks.iter().step_by(every as usize).cloned().collect()
    }

    fn share(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from)
    }
}

/// The next step of 1, 2 or 5 times a power of ten from `rough` on, and the decimals it takes.
fn tick_step(rough: f64) -> (f64, usize) {
    let mut decimals = 9i32;
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
pub(super) fn power_of_ten(power: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = power
        .to_string()
        .chars()
        .map(|c| match c.to_digit(10) {
            Some(digit) => RAISED[digit as usize],
            None => '⁻',
        })
        .collect::<String>();
    format!("10{raised}")
}

/// A caption below a picture, its first line at `baseline`.
pub(super) fn draw_caption<B: DrawingBackend>(
    sheet: &Sheet<B>,
    lines: &[String],
    baseline: f64,
) -> Result<(), FigureError> {
    for (line, text) in (0..).zip(lines) {
        let at = (CAPTION_LEFT, baseline + CAPTION_STEP * f64::from(line));
        sheet.text(text, at, Style::plain(CAPTION, Align::Left))?;
    }
    Ok(())
}

impl Frame {
    /// Panels one under the other, sharing `x`, each as high as it says, the first below `top`; only the
    /// last has words at the ticks of x.
    pub fn stack<const N: usize>(top: f64, panels: [(f64, Scale); N], x: &Scale) -> [Self; N] {
        let mut below = top;
        let mut left = N;
        panels.map(|(height, y)| {
            left -= 1;
            let top = below;
            below += height + BETWEEN;
            Self {
                left: 54.0,
                right: WIDTH - 16.0,
                top,
                bottom: top + height,
                x: if left == 0 { x.clone() } else { x.unlabelled() },
                y,
            }
        })
    }

    /// The size of a sheet that ends with this frame and a caption.
    pub fn sheet_size(&self, caption: &[String]) -> (f64, f64) {
        let lines = CAPTION_STEP * caption.len() as f64;
        (WIDTH, self.bottom + 36.0 + lines)
    }

    /// The caption below this frame and its axis.
    pub fn draw_caption<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        caption: &[String],
    ) -> Result<(), FigureError> {
        draw_caption(sheet, caption, self.bottom + 41.0)
    }

    /// A band over the whole height between two values of x.
    pub fn draw_band<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        (from, to): (f64, f64),
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        let (left, _) = self.at(from, self.y.from);
        let (right, _) = self.at(to, self.y.from);
        let corners = ((left, self.top), (right, self.bottom));
        sheet.rectangle(corners.0, corners.1, colour.to_rgba())
    }

    /// A line over the whole width at one value of y.
    pub fn draw_level<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        y: f64,
        dash: &[f64],
    ) -> Result<(), FigureError> {
        let (left, y) = self.at(self.x.from, y);
        sheet.dashed(&[(left, y), (self.right, y)], 0.8, BLACK.mix(0.6), dash)
    }

    /// Where a value stands on the sheet.
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.left + self.x.share(x) * (self.right - self.left),
            self.bottom - self.y.share(y) * (self.bottom - self.top),
        )
    }

    /// The same for a value that may lie outside: on the edge then.
    pub fn at_within(&self, x: f64, y: f64) -> (f64, f64) {
        let within = |scale: &Scale, value: f64| value.clamp(scale.from, scale.to);
        self.at(within(&self.x, x), within(&self.y, y))
    }

    /// Grid lines, drawn before the data.
    pub fn draw_grid<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        for (y, _) in &self.y.ticks {
            let (_, y) = self.at(self.x.from, *y);
            sheet.line(&[(self.left, y), (self.right, y)], 0.4, GRID.to_rgba())?;
        }
        Ok(())
    }

    /// The rectangle, ticks and labels, drawn after the data.
    pub fn draw_axes<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        x_label: &str,
        y_label: &str,
    ) -> Result<(), FigureError> {
        let black = BLACK.to_rgba();
        let corners = [(self.left, self.top), (self.right, self.bottom)];
        sheet.outline(corners[0], corners[1], AXIS_WIDTH, black)?;
        for (value, label) in &self.x.ticks {
            let (x, y) = self.at(*value, self.y.from);
            sheet.line(&[(x, y), (x, y - TICK)], AXIS_WIDTH, black)?;
            sheet.text(
                label,
                (x, y + SMALL + 3.0),
                Style::plain(SMALL, Align::Centre),
            )?;
        }
        for (value, label) in &self.y.ticks {
            let (x, y) = self.at(self.x.from, *value);
            sheet.line(&[(x, y), (x + TICK, y)], AXIS_WIDTH, black)?;
            sheet.text(
                label,
                (x - 4.0, y + 0.36 * SMALL),
                Style::plain(SMALL, Align::Right),
            )?;
        }
        let middle = f64::midpoint(self.left, self.right);
        sheet.text(
            x_label,
            (middle, self.bottom + 25.0),
            Style::plain(NORMAL, Align::Centre),
        )?;
        let beside = (12.0, f64::midpoint(self.top, self.bottom));
        let upright = Style {
            upright: true,
            ..Style::plain(NORMAL, Align::Centre)
        };
        sheet.text(y_label, beside, upright)
    }

    /// A second scale along the top.
    pub fn draw_top<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        scale: &Scale,
        label: &str,
    ) -> Result<(), FigureError> {
        for (value, tick) in &scale.ticks {
            let x = self.left + scale.share(*value) * (self.right - self.left);
            sheet.line(
                &[(x, self.top), (x, self.top + TICK)],
                AXIS_WIDTH,
                BLACK.to_rgba(),
            )?;
            sheet.text(
                tick,
                (x, self.top - 4.0),
                Style::plain(SMALL, Align::Centre),
            )?;
        }
        let middle = f64::midpoint(self.left, self.right);
        sheet.text(
            label,
            (middle, self.top - 16.0),
            Style::plain(NORMAL, Align::Centre),
        )
    }
}
