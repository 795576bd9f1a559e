//! Rates against the axis of a sweep: the power of each curve, or, where nothing moves, its
//! false-alarm rate.

use super::FigureError;
use super::frame::{CAPTION, Frame, SMALL, Scale};
use super::sheet::{Align, Marker, Picture, Sheet, Style, text_width};
use super::words::{axis_label, caption, legend, rule_name};
use crate::config::{Config, Parameter};
use crate::results::{Manifest, Row};
use plotters::prelude::{BLACK, Color, DrawingBackend, RGBColor, WHITE};

/// Colours that remain apart for colour-blind readers (Okabe and Ito), each with its marker.
const LOOKS: [(RGBColor, Marker); 6] = [
    (RGBColor(0, 114, 178), Marker::Disc),
    (RGBColor(213, 94, 0), Marker::Square),
    (RGBColor(0, 158, 115), Marker::Triangle),
    (RGBColor(204, 121, 167), Marker::Diamond),
    (RGBColor(230, 159, 0), Marker::Wedge),
    (RGBColor(86, 180, 233), Marker::Cross),
];

const WIDTH: f64 = 396.0;
const HEIGHT: f64 = 290.0;
const LINE: f64 = 1.1;
const CAPTION_STEP: f64 = 10.5;
const CAPTION_LEFT: f64 = 10.0;
const CAPTION_WIDTH: f64 = WIDTH - 2.0 * CAPTION_LEFT;
const MARKER: f64 = 2.3;

/// The picture of a sweep.
pub(super) struct Curves {
    curves: Vec<Curve>,
    axis: Parameter,
    /// Axis values that are names, in order.
    names: Option<Vec<String>>,
    /// What a unit of Δ in the record becomes after whitening, where every curve agrees.
    whitened_unit: Option<f64>,
    alpha: Option<f64>,
    is_false_alarm: bool,
    caption: Vec<String>,
}

struct Curve {
    legend: String,
    look: (RGBColor, Marker),
    /// x, rate, low, high.
    points: Vec<(f64, f64, f64, f64)>,
}

impl Curves {
    pub fn new(config: &Config, rows: &[Row], manifest: &Manifest) -> Result<Self, FigureError> {
        let axis = config.axis.parameter;
        let names = (axis == Parameter::Rule).then(|| distinct(rows.iter().map(rule_name)));
        let drawn: Vec<Vec<&Row>> = (1..=config.curves.len())
            .map(|index| rows_of(rows, index))
            .collect();
        let all: Vec<&Row> = drawn.iter().flatten().copied().collect();
        let Some(first) = all.first() else {
            return Err(FigureError::Empty(axis.name()));
        };
        let x = |row: &Row| match &names {
            Some(names) => names
                .iter()
                .position(|name| *name == rule_name(row))
                .unwrap_or(0) as f64,
            None => column(row, axis),
        };
        let curves = drawn
            .iter()
            .enumerate()
            .filter(|(_, rows)| !rows.is_empty())
            .map(|(index, rows)| Curve {
                legend: legend(rows, &all, axis),
                look: LOOKS[index % LOOKS.len()],
                points: rows
                    .iter()
                    .map(|row| (x(row), row.rate, row.low, row.high))
                    .collect(),
            });
        Ok(Self {
            curves: curves.collect(),
            whitened_unit: whitened_unit(config, &all),
            alpha: all
                .iter()
                .all(|row| row.alpha == first.alpha)
                .then_some(first.alpha),
            is_false_alarm: all.iter().all(|row| row.is_at_rest()),
            caption: caption(&all, axis, manifest, CAPTION_WIDTH),
            axis,
            names,
        })
    }

    fn frame(&self) -> Frame {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let low = points().map(|p| p.0).fold(f64::INFINITY, f64::min);
        let high = points().map(|p| p.0).fold(f64::NEG_INFINITY, f64::max);
        let x = match &self.names {
            Some(names) => Scale::names(names),
            None if low == high => Scale::linear(low - 0.5, high + 0.5, 4),
            None => Scale::linear(low, high, 7),
        };
        let y = match self.is_false_alarm {
            false => Scale {
                to: 1.03,
                ..Scale::linear(0.0, 1.0, 5)
            },
            true => {
                let bottom = points()
                    .map(|p| p.2)
                    .chain(self.alpha)
                    .fold(f64::INFINITY, f64::min);
                let top = points().map(|p| p.3).chain(self.alpha).fold(0.0, f64::max);
                let room = (top - bottom).max(1e-9);
                Scale::linear((bottom - 0.1 * room).max(0.0), top + 0.8 * room, 6)
            }
        };
        Frame {
            left: 48.0,
            right: WIDTH - 10.0,
            top: if self.whitened_unit.is_some() {
                32.0
            } else {
                10.0
            },
            bottom: HEIGHT - 40.0 - CAPTION_STEP * self.caption.len() as f64,
            x,
            y,
        }
    }

    fn draw_lines<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        for curve in &self.curves {
            let at = |pick: fn(&(f64, f64, f64, f64)) -> f64| {
                curve.points.iter().map(move |p| frame.at(p.0, pick(p)))
            };
            let band: Vec<_> = at(|p| p.3).chain(at(|p| p.2).rev()).collect();
            sheet.area(&band, curve.look.0.mix(0.18))?;
            let line: Vec<_> = at(|p| p.1).collect();
            sheet.line(&line, LINE, curve.look.0.to_rgba())?;
        }
        for curve in &self.curves {
            for &(x, rate, ..) in &curve.points {
                sheet.marker(curve.look.1, frame.at(x, rate), MARKER, curve.look.0)?;
            }
        }
        Ok(())
    }

    /// Beside each other at every name: a marker and its interval.
    fn draw_bars<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        let middle = (self.curves.len() - 1) as f64 / 2.0;
        for (index, curve) in self.curves.iter().enumerate() {
            let aside = 0.11 * (index as f64 - middle);
            for &(x, rate, low, high) in &curve.points {
                let ends = [frame.at(x + aside, low), frame.at(x + aside, high)];
                sheet.line(&ends, LINE, curve.look.0.to_rgba())?;
                sheet.marker(
                    curve.look.1,
                    frame.at(x + aside, rate),
                    MARKER,
                    curve.look.0,
                )?;
            }
        }
        Ok(())
    }

    /// The level that false-alarm rates are held against.
    fn draw_nominal<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        let Some(alpha) = self.alpha.filter(|_| self.is_false_alarm) else {
            return Ok(());
        };
        let (left, y) = frame.at(frame.x.from, alpha);
        sheet.line(&[(left, y), (frame.right, y)], 0.8, BLACK.mix(0.6))
    }

    /// In the corner that covers the least of the curves.
    fn draw_legend<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        const STEP: f64 = 11.5;
        let text = self
            .curves
            .iter()
            .map(|curve| text_width(&curve.legend, SMALL));
        let width = text.fold(0.0, f64::max) + 32.0;
        let height = STEP * self.curves.len() as f64 + 6.0;
        let (left, right) = (frame.left + 6.0, frame.right - 6.0 - width);
        let (top, bottom) = (frame.top + 6.0, frame.bottom - 6.0 - height);
        let corners = [(right, bottom), (left, top), (right, top), (left, bottom)];
        let covered = |&(x, y): &(f64, f64)| {
            let inside = |(px, py): (f64, f64)| {
                px > x - 4.0 && px < x + width + 4.0 && py > y - 4.0 && py < y + height + 4.0
            };
            let points = self.curves.iter().flat_map(|curve| &curve.points);
            points.filter(|p| inside(frame.at(p.0, p.1))).count()
        };
        let (x, y) = corners
            .into_iter()
            .min_by_key(covered)
            .unwrap_or(corners[0]);
        let box_corners = [
            (x, y),
            (x + width, y),
            (x + width, y + height),
            (x, y + height),
        ];
        sheet.area(&box_corners, WHITE.to_rgba())?;
        let outline: Vec<_> = box_corners.into_iter().chain([(x, y)]).collect();
        sheet.line(&outline, 0.4, BLACK.mix(0.3))?;
        for (index, curve) in self.curves.iter().enumerate() {
            let middle = y + 3.0 + STEP * (index as f64 + 0.5);
            let (colour, marker) = curve.look;
            if self.names.is_none() {
                sheet.line(
                    &[(x + 4.0, middle), (x + 22.0, middle)],
                    LINE,
                    colour.to_rgba(),
                )?;
            }
            sheet.marker(marker, (x + 13.0, middle), MARKER, colour)?;
            let style = Style::plain(SMALL, Align::Left);
            sheet.text(&curve.legend, (x + 27.0, middle + 0.36 * SMALL), style)?;
        }
        Ok(())
    }
}

impl Picture for Curves {
    fn size(&self) -> (f64, f64) {
        (WIDTH, HEIGHT)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let frame = self.frame();
        sheet.area(
            &[(0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT)],
            WHITE.to_rgba(),
        )?;
        frame.draw_grid(sheet)?;
        self.draw_nominal(sheet, &frame)?;
        match self.names {
            None => self.draw_lines(sheet, &frame)?,
            Some(_) => self.draw_bars(sheet, &frame)?,
        }
        self.draw_legend(sheet, &frame)?;
        let y_label = match self.is_false_alarm {
            true => "false-alarm rate",
            false => "D, probability of detection",
        };
        frame.draw_axes(sheet, axis_label(self.axis), y_label)?;
        if let Some(unit) = self.whitened_unit {
            let scale = Scale::linear(frame.x.from * unit, frame.x.to * unit, 8);
            frame.draw_top(sheet, &scale, "Δ(1 − β)/σ_ξ, the shift after whitening")?;
        }
        for (line, text) in (0..).zip(&self.caption) {
            let baseline = frame.bottom + 41.0 + CAPTION_STEP * f64::from(line);
            sheet.text(
                text,
                (CAPTION_LEFT, baseline),
                Style::plain(CAPTION, Align::Left),
            )?;
        }
        Ok(())
    }
}

/// The rows a curve is drawn from: those in motion, or at rest where nothing ever moves.
fn rows_of(rows: &[Row], curve: usize) -> Vec<&Row> {
    let of_curve = || rows.iter().filter(|row| row.curve == curve);
    let in_motion: Vec<&Row> = of_curve().filter(|row| !row.is_at_rest()).collect();
    match in_motion.is_empty() {
        true => of_curve().collect(),
        false => in_motion,
    }
}

fn distinct(values: impl Iterator<Item = String>) -> Vec<String> {
    let mut seen = Vec::new();
    for value in values {
        if !seen.contains(&value) {
            seen.push(value);
        }
    }
    seen
}

/// The value of the axis at a row.
fn column(row: &Row, parameter: Parameter) -> f64 {
    match parameter {
        Parameter::Delta => row.delta,
        Parameter::Duration => row.duration as f64,
        Parameter::Offset => row.offset as f64,
        Parameter::Nu => row.nu,
        Parameter::Theta => row.theta,
        Parameter::Quantum => row.quantum.unwrap_or(0.0),
        Parameter::Range => row.range.unwrap_or(f64::INFINITY),
        Parameter::Training => row.training as f64,
        Parameter::Order => row.order as f64,
        Parameter::AllSamples | Parameter::Shift => row.shift as f64,
        Parameter::Reference => row.reference as f64,
        Parameter::Scale => row.scale as f64,
        Parameter::Gap => row.gap as f64,
        Parameter::Decimation => row.decimation as f64,
        Parameter::Alpha => row.alpha,
        Parameter::Rule => 0.0,
    }
}

/// 1 − β, where the axis is Δ in the record and every curve has the same sensor.
fn whitened_unit(config: &Config, rows: &[&Row]) -> Option<f64> {
    let first = rows.first()?;
    let agree = rows
        .iter()
        .all(|row| row.delta_at == "record" && row.sensor == first.sensor);
    let scenario = config
        .scenario(first.curve - 1, config.axis.values.first()?)
        .ok()?;
    (agree && config.axis.parameter == Parameter::Delta).then(|| scenario.sensor.step_gain())
}
