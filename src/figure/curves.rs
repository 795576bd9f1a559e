//! Rates against the axis of a sweep: the power of each curve, or, where nothing moves, its
//! false-alarm rate.

use super::FigureError;
use super::frame::{CAPTION_LEFT, CAPTION_STEP, Frame, Scale, WIDTH, draw_caption};
use super::legend::{Entry, Key, Legend};
use super::ruler::Ruler;
use super::sheet::{Look, Picture, Sheet};
use super::words::{axis_label, caption, common_facts, is_held_against_alpha, legend};
use crate::config::{Config, Parameter};
use crate::results::{Manifest, Row};
use plotters::prelude::{Color, DrawingBackend};

/// Without legend above and caption below.
const HEIGHT: f64 = 262.0;
const LINE: f64 = 1.1;
const MARKER: f64 = 2.3;

/// The picture of a sweep.
pub(super) struct Curves {
    curves: Vec<Curve>,
    axis: Parameter,
    scale: Scale,
    /// Whether the axis holds names, with curves side by side at each.
    is_named: bool,
    is_whitened: bool,
    /// What a unit of Δ in the record becomes after whitening, where every curve agrees.
    whitened_unit: Option<f64>,
    /// The level that false-alarm rates are held against.
    nominal: Option<f64>,
    is_false_alarm: bool,
    caption: Vec<String>,
}

struct Curve {
    legend: String,
    look: Look,
    points: Vec<Point>,
}

/// A rate and its interval, at a place on the axis.
#[derive(Clone, Copy)]
struct Point {
    x: f64,
    rate: f64,
    low: f64,
    high: f64,
}

impl Curves {
    pub fn new(config: &Config, rows: &[Row], manifest: &Manifest) -> Result<Self, FigureError> {
        let axis = config.axis.parameter;
        let drawn: Vec<Vec<&Row>> = (1..=config.curves.len())
            .map(|index| rows_of(rows, index))
            .collect();
        let all: Vec<&Row> = drawn.iter().flatten().copied().collect();
        if all.is_empty() {
            return Err(FigureError::Empty(axis.name()));
        }
        let common = common_facts(&all);
        let ruler = Ruler::new(config, &all);
        let mut curves: Vec<Curve> = Vec::new();
        for (index, rows) in drawn
            .iter()
            .enumerate()
            .filter(|(_, rows)| !rows.is_empty())
        {
            let mut points: Vec<Point> = (0..rows.len())
                .map(|i| point(ruler.place(rows, i), rows[i]))
                .collect();
            points.sort_by(|a, b| a.x.total_cmp(&b.x));
            curves.push(Curve {
                legend: legend(rows, &common, axis),
                look: Look::of(index),
                points,
            });
        }
        let places: Vec<f64> = curves
            .iter()
            .flat_map(|curve| &curve.points)
            .map(|p| p.x)
            .collect();
        Ok(Self {
            scale: ruler.scale(&places),
            is_named: ruler.is_named(),
            is_whitened: all.iter().all(|row| row.delta_at == "whitened"),
            whitened_unit: whitened_unit(config, &all),
            nominal: is_held_against_alpha(&all).then_some(all[0].alpha),
            is_false_alarm: all.iter().all(|row| row.is_at_rest()),
            caption: caption(&all, common, axis, manifest, WIDTH - 2.0 * CAPTION_LEFT),
            curves,
            axis,
        })
    }

    fn points(&self) -> impl Iterator<Item = &Point> {
        self.curves.iter().flat_map(|curve| &curve.points)
    }

    /// The frame with `above` points left free over it.
    fn frame(&self, above: f64) -> Frame {
        let y = match self.is_false_alarm {
            false => Scale {
                to: 1.03,
                ..Scale::linear(0.0, 1.0, 5)
            },
            true => {
                let bottom = self
                    .points()
                    .map(|p| p.low)
                    .chain(self.nominal)
                    .fold(f64::INFINITY, f64::min);
                let top = self
                    .points()
                    .map(|p| p.high)
                    .chain(self.nominal)
                    .fold(0.0, f64::max);
                let room = (top - bottom).max(1e-9);
                // Room above for the legend.
                Scale::linear((bottom - 0.1 * room).max(0.0), top + 0.8 * room, 6)
            }
        };
        let top = above
            + if self.whitened_unit.is_some() {
                32.0
            } else {
                10.0
            };
        Frame {
            left: 54.0,
            right: WIDTH - 16.0,
            top,
            bottom: above + HEIGHT - 40.0,
            x: self.scale.clone(),
            y,
        }
    }

    /// Where each curve stands beside the others at a name.
    fn aside(&self, index: usize) -> f64 {
        let step = 0.11f64.min(0.8 / self.curves.len() as f64);
        match self.is_named {
            true => step * (index as f64 - (self.curves.len() - 1) as f64 / 2.0),
            false => 0.0,
        }
    }

    /// The legend and its place; none for one curve without a name of its own.
    fn legend(&self) -> Option<(Legend, Option<(f64, f64)>)> {
        let key = match self.is_named {
            true => Key::Marker,
            false => Key::MarkedLine,
        };
        let entry = |curve: &Curve| Entry {
            text: curve.legend.clone(),
            look: curve.look,
            key,
        };
        let entries: Vec<Entry> = self.curves.iter().map(entry).collect();
        if entries.len() == 1 && entries[0].text == "1" {
            return None;
        }
        let legend = Legend { entries };
        let corner = legend.free_corner(&self.frame(0.0), &self.covered());
        Some((legend, corner))
    }

    /// Points on the sheet that a legend must not hide: bands and lines, finely.
    fn covered(&self) -> Vec<(f64, f64)> {
        let frame = self.frame(0.0);
        let mut covered = Vec::new();
        for (index, curve) in self.curves.iter().enumerate() {
            let ends =
                |p: &Point| [p.low, p.rate, p.high].map(|y| frame.at(p.x + self.aside(index), y));
            covered.extend(curve.points.iter().flat_map(ends));
            for pair in curve.points.windows(2).filter(|_| !self.is_named) {
                for (a, b) in ends(&pair[0]).into_iter().zip(ends(&pair[1])) {
                    let between = |i: i32| f64::from(i) / 16.0;
                    covered.extend((1..16).map(|i| {
                        (
                            a.0 + between(i) * (b.0 - a.0),
                            a.1 + between(i) * (b.1 - a.1),
                        )
                    }));
                }
            }
        }
        covered
    }

    fn draw_lines<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        for Curve { points, look, .. } in &self.curves {
            let upper = points.iter().map(|p| frame.at(p.x, p.high));
            let lower = points.iter().rev().map(|p| frame.at(p.x, p.low));
            let band: Vec<_> = upper.chain(lower).collect();
            sheet.area(&band, look.colour.mix(0.18))?;
            let line: Vec<_> = points.iter().map(|p| frame.at(p.x, p.rate)).collect();
            sheet.line(&line, LINE, look.colour.to_rgba())?;
        }
        Ok(())
    }

    /// Each interval as an upright bar.
    fn draw_bars<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        for (index, Curve { points, look, .. }) in self.curves.iter().enumerate() {
            for p in points {
                let x = p.x + self.aside(index);
                sheet.line(
                    &[frame.at(x, p.low), frame.at(x, p.high)],
                    LINE,
                    look.colour.to_rgba(),
                )?;
            }
        }
        Ok(())
    }

    fn draw_markers<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        for (index, Curve { points, look, .. }) in self.curves.iter().enumerate() {
            for p in points {
                let centre = frame.at(p.x + self.aside(index), p.rate);
                sheet.marker(look.marker, centre, MARKER, look.colour)?;
            }
        }
        Ok(())
    }

    fn draw_nominal<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        match self.nominal {
            Some(nominal) => frame.draw_level(sheet, nominal, &[]),
            None => Ok(()),
        }
    }

    /// What the legend takes above the plot, where no corner is free.
    fn above(&self) -> f64 {
        match self.legend() {
            Some((legend, None)) => legend.height() + 8.0,
            _ => 0.0,
        }
    }
}

impl Picture for Curves {
    fn size(&self) -> (f64, f64) {
        let caption = CAPTION_STEP * self.caption.len() as f64;
        (WIDTH, self.above() + HEIGHT + caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let frame = self.frame(self.above());
        sheet.clear(self.size())?;
        frame.draw_grid(sheet)?;
        self.draw_nominal(sheet, &frame)?;
        match self.is_named {
            false => self.draw_lines(sheet, &frame)?,
            true => self.draw_bars(sheet, &frame)?,
        }
        let y_label = match self.is_false_alarm {
            true => "false-alarm rate",
            false => "D, probability of detection",
        };
        frame.draw_axes(sheet, axis_label(self.axis, self.is_whitened), y_label)?;
        if let Some(unit) = self.whitened_unit {
            let scale = Scale::linear(frame.x.from * unit, frame.x.to * unit, 8);
            frame.draw_top(sheet, &scale, axis_label(Parameter::Delta, true))?;
        }
        self.draw_markers(sheet, &frame)?;
        if let Some((legend, corner)) = self.legend() {
            legend.draw(sheet, corner.unwrap_or((frame.left, 4.0)))?;
        }
        draw_caption(sheet, &self.caption, frame.bottom + 41.0)
    }
}

/// A row's rate and interval, from its counts.
fn point(x: f64, row: &Row) -> Point {
    let (low, high) = row.tally().interval(row.confidence);
    let rate = row.tally().rate();
    Point { x, rate, low, high }
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

/// 1 − β, where the axis is Δ in the record and every curve has the same sensor, undecimated.
fn whitened_unit(config: &Config, rows: &[&Row]) -> Option<f64> {
    let first = rows.first()?;
    let agrees =
        |row: &&Row| row.delta_at == "record" && row.sensor == first.sensor && row.decimation == 1;
    let scenario = config
        .scenario(first.curve - 1, config.axis.values.first()?)
        .ok()?;
    let is_delta = config.axis.parameter == Parameter::Delta;
    (is_delta && rows.iter().all(agrees)).then(|| scenario.sensor.step_gain())
}
