//! A ride in time: the record, and below it the same whitened; phases shaded and named, samples
//! bracketed.

use super::FigureError;
use super::frame::{CAPTION_LEFT, CAPTION_STEP, Frame, SMALL, Scale, WIDTH, draw_caption};
use super::layout::{phase_colour, phase_words};
use super::legend::{Entry, Key, Legend};
use super::sheet::{Align, Look, Picture, Sheet, Style, literal, text_width};
use super::words::wrap;
use crate::config::{ExhibitConfig, Trace};
use crate::exhibit::trace::Row;
use crate::results::Manifest;
use plotters::prelude::{BLACK, Color, DrawingBackend};

const SINGLE: f64 = 190.0;
const PANEL: f64 = 128.0;
/// Room for the names of the phases.
const NAMES: f64 = 16.0;
/// Room for the brackets of the samples.
const BRACKETS: f64 = 22.0;
/// Fewer samples than this get a marker each.
const FEW: usize = 250;

/// The picture of a ride.
pub(super) struct Ride<'a> {
    trace: &'a Trace,
    /// Those in the picture.
    rows: &'a [Row],
    frames: Vec<Frame>,
    /// Seconds in a unit of the time axis.
    unit: f64,
    caption: Vec<String>,
}

impl<'a> Ride<'a> {
    pub fn new(
        config: &ExhibitConfig,
        trace: &'a Trace,
        rows: &'a [Row],
        manifest: &Manifest,
    ) -> Self {
        let rows = &rows[trace.drawn_from.min(rows.len() - 1)..];
        let last = &rows[rows.len() - 1];
        let unit = match trace.rate > 1.0 && last.time < 1.0 {
            true => 1e-3,
            false => 1.0,
        };
        let half = 0.5 / trace.rate;
        let (from, to) = ((rows[0].time - half) / unit, (last.time + half) / unit);
        let x = Scale::linear(from, to, 8);
        let mut ys = vec![values(rows, |row| Some(row.record))];
        let mut top = NAMES;
        let mut heights = vec![SINGLE];
        if trace.whitened {
            ys.push(values(rows, |row| row.whitened));
            top += BRACKETS;
            heights = vec![PANEL; 2];
        }
        Self {
            frames: Frame::stack(top, &heights, &x, ys),
            caption: caption(config, trace, manifest),
            trace,
            rows,
            unit,
        }
    }

    fn x(&self, row: &Row) -> f64 {
        row.time / self.unit
    }

    /// The stretches in which `of` says the same, each with its ends on the axis.
    fn stretches(&self, of: fn(&Row) -> &str) -> Vec<(&str, (f64, f64))> {
        let half = 0.5 / self.trace.rate / self.unit;
        (self.rows.chunk_by(|a, b| of(a) == of(b)))
            .map(|stretch| {
                let ends = [&stretch[0], &stretch[stretch.len() - 1]].map(|row| self.x(row));
                (of(&stretch[0]), (ends[0] - half, ends[1] + half))
            })
            .collect()
    }

    fn draw_phases<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let upper = &self.frames[0];
        for (name, (from, to)) in self.stretches(|row| &row.phase) {
            for frame in &self.frames {
                frame.draw_band(sheet, (from, to), phase_colour(name))?;
            }
            let (left, right) = (upper.at(from, 0.0).0, upper.at(to, 0.0).0);
            let words = phase_words(name);
            // What does not fit stands in the shades of the caption's order alone.
            if text_width(words, SMALL) < right - left {
                let at = (f64::midpoint(left, right), NAMES - 5.0);
                sheet.text(words, at, Style::plain(SMALL, Align::Centre))?;
            }
        }
        Ok(())
    }

    /// A bracket over each sample, its name on top, and its limits through the panels.
    fn draw_samples<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let upper = &self.frames[0];
        let bottom = self.frames[self.frames.len() - 1].bottom;
        let y = upper.top - 5.0;
        for (name, (from, to)) in self.stretches(|row| row.sample.as_deref().unwrap_or("")) {
            let Some(words) = sample_words(name) else {
                continue;
            };
            let (left, right) = (upper.at(from, 0.0).0 + 0.7, upper.at(to, 0.0).0 - 0.7);
            let bracket = [(left, y + 4.0), (left, y), (right, y), (right, y + 4.0)];
            sheet.line(&bracket, 0.8, BLACK.to_rgba())?;
            let at = (f64::midpoint(left, right), y - 3.0);
            sheet.text(words, at, Style::plain(SMALL, Align::Centre))?;
            if name == "training" {
                continue;
            }
            for x in [left - 0.7, right + 0.7] {
                let limit = [(x, upper.top), (x, bottom)];
                sheet.dashed(&limit, 0.5, BLACK.mix(0.6), &[2.0, 2.0])?;
            }
        }
        Ok(())
    }

    fn draw_values<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
        value: impl Fn(&Row) -> Option<f64>,
    ) -> Result<(), FigureError> {
        let colour = Look::of(0).colour;
        let line: Vec<_> = (self.rows.iter())
            .filter_map(|row| Some(frame.at(self.x(row), value(row)?)))
            .collect();
        let is_few = line.len() < FEW;
        let width = if is_few { 0.7 } else { 0.35 };
        if line.len() > 1 {
            sheet.line(&line, width, colour.to_rgba())?;
        }
        for &place in line.iter().filter(|_| is_few) {
            sheet.marker(Look::of(0).marker, place, 1.4, colour)?;
        }
        Ok(())
    }

    /// The acceleration itself, over the record in which it hides.
    fn draw_acceleration<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let frame = &self.frames[0];
        let line: Vec<_> = (self.rows.iter())
            .map(|row| frame.at(self.x(row), row.acceleration))
            .collect();
        match line.len() {
            0 | 1 => Ok(()),
            _ => sheet.line(&line, 1.3, Look::of(1).colour.to_rgba()),
        }
    }

    fn draw_legend<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let frame = &self.frames[0];
        let entry = |index, text: &str| Entry {
            text: text.to_owned(),
            look: Look {
                dash: &[],
                ..Look::of(index)
            },
            key: Key::Line,
        };
        let legend = Legend {
            entries: vec![entry(0, "record"), entry(1, "acceleration in it")],
        };
        let covered: Vec<_> = (self.rows.iter())
            .map(|row| frame.at(self.x(row), row.record))
            .collect();
        match legend.free_corner(frame, &covered) {
            Some(corner) => legend.draw(sheet, corner),
            None => Ok(()),
        }
    }
}

impl Picture for Ride<'_> {
    fn size(&self) -> (f64, f64) {
        let caption = CAPTION_STEP * self.caption.len() as f64;
        let bottom = self.frames[self.frames.len() - 1].bottom;
        (WIDTH, bottom + 36.0 + caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        sheet.clear(self.size())?;
        self.draw_phases(sheet)?;
        self.draw_samples(sheet)?;
        for frame in &self.frames {
            frame.draw_level(sheet, 0.0, &[])?;
        }
        self.draw_values(sheet, &self.frames[0], |row| Some(row.record))?;
        self.draw_acceleration(sheet)?;
        let time = match (self.trace.rate == 1.0, self.unit < 1.0) {
            (true, _) => "time, samples",
            (false, true) => "time, ms",
            (false, false) => "time, s",
        };
        let unit = unit_words(&self.trace.unit);
        let record = format!("record, {unit}");
        match &self.frames[..] {
            [upper, lower] => {
                self.draw_values(sheet, lower, |row| row.whitened)?;
                upper.draw_axes(sheet, "", &record)?;
                lower.draw_axes(sheet, time, &format!("whitened, {unit}"))?;
            }
            frames => frames[0].draw_axes(sheet, time, &record)?,
        }
        self.draw_legend(sheet)?;
        let bottom = self.frames[self.frames.len() - 1].bottom;
        draw_caption(sheet, &self.caption, bottom + 41.0)
    }
}

/// A scale that holds every value and zero, with room for a legend.
fn values(rows: &[Row], value: impl Fn(&Row) -> Option<f64>) -> Scale {
    let all = || rows.iter().filter_map(&value).chain([0.0]);
    let low = all().fold(f64::INFINITY, f64::min);
    let high = all().fold(f64::NEG_INFINITY, f64::max);
    let room = (high - low).max(1e-9);
    Scale::linear(low - 0.06 * room, high + 0.06 * room, 5)
}

fn sample_words(name: &str) -> Option<&'static str> {
    match name {
        "training" => Some("training"),
        "reference" => Some("X"),
        "shift" => Some("Y_1"),
        "scale" => Some("Y_2"),
        _ => None,
    }
}

/// The unit as its author wrote it; σ_ξ keeps its index.
fn unit_words(unit: &str) -> String {
    match unit {
        "σ_ξ" => unit.to_owned(),
        _ => literal(unit),
    }
}

fn caption(config: &ExhibitConfig, trace: &Trace, manifest: &Manifest) -> Vec<String> {
    let scenario = &config.scenario;
    let unit = unit_words(&trace.unit);
    let delta = scenario.motion.record_delta(scenario.sensor.step_gain());
    let measured = |name: &str, value: f64| {
        let value = (value * trace.sigma * 1e6).round() / 1e6;
        format!("{name} = {value} {unit}")
    };
    let mut parts = vec!["simulated".to_owned(), measured("Δ", delta)];
    if trace.unit != "σ_ξ" {
        parts.push(measured("σ_ξ", 1.0));
    }
    if !scenario.impulses.are_absent() {
        parts.push(format!("ν = {}", scenario.impulses.nu()));
        parts.push(measured("θ", scenario.impulses.theta()));
    }
    if trace.vibration > 0.0 {
        parts.push(measured("vibration", trace.vibration));
    }
    parts.push(format!("{} noise", literal(&scenario.noise.to_string())));
    parts.push(literal(&scenario.sensor.to_string()));
    if let Some(quantum) = scenario.digitiser.quantum() {
        parts.push(measured("step", quantum));
    }
    if let Some(range) = scenario.digitiser.range() {
        parts.push(measured("range", range));
    }
    if trace.whitened {
        let (samples, whitening) = (&scenario.samples, &scenario.whitening);
        parts.push(format!("{} filter", whitening.fit()));
        parts.push(format!("order {}", whitening.order()));
        parts.push(format!("training {}", whitening.training()));
        parts.push(format!("N/M_1/M_2 = {samples}"));
    }
    parts.push(format!("seed {}", manifest.seed));
    wrap(&parts, WIDTH - 2.0 * CAPTION_LEFT)
}
