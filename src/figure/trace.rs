//! A ride in time: the record, and below it the same whitened; phases shaded and named, samples
//! bracketed.

use super::FigureError;
use super::frame::{CAPTION_LEFT, Frame, SMALL, Scale, WIDTH};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::phases::{draw_dense, draw_limit, phase_colour, phase_words};
use super::sheet::{Picture, Sheet};
use super::text::{Align, Style, literal, text_width};
use super::words::wrap;
use crate::chain::Scenario;
use crate::config::Trace;
use crate::results::Manifest;
use crate::study::rows::Trace as Row;
use plotters::prelude::{BLACK, Color, DrawingBackend};

const SINGLE: f64 = 190.0;
const PANEL: f64 = 128.0;
/// Room for the names of the phases.
const NAMES: f64 = 16.0;
/// Room for the brackets of the samples.
const BRACKETS: f64 = 18.0;
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
        scenario: &Scenario,
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
        let (from, to) = (
            (rows[0].time - half) / unit,
            (last.time + 2.0 * half) / unit,
        );
        let x = Scale::linear(from, to, 8);
        let record = values(rows, 0.34, |row| Some(row.record));
        let frames = match trace.whitened {
            false => Frame::stack(NAMES, [(SINGLE, record)], &x).into(),
            true => {
                let whitened = values(rows, 0.06, |row| row.whitened);
                let panels = [(PANEL, record), (PANEL, whitened)];
                Frame::stack(NAMES + BRACKETS, panels, &x).into()
            }
        };
        Self {
            frames,
            caption: caption(scenario, trace, manifest),
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
        let mut taken = 0.0;
        for (name, (from, to)) in self.stretches(|row| &row.phase) {
            for frame in &self.frames {
                frame.draw_band(sheet, (from, to), phase_colour(name))?;
            }
            let (left, right) = (upper.at(from, 0.0).0, upper.at(to, 0.0).0);
            let words = phase_words(name);
            let (middle, half) = (f64::midpoint(left, right), text_width(words, SMALL) / 2.0);
            // Of names that would run into each other the first is kept.
            if middle - half > taken && middle + half < WIDTH {
                let at = (middle, NAMES - 5.0);
                sheet.text(words, at, Style::plain(SMALL, Align::Centre))?;
                taken = middle + half + 4.0;
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
                draw_limit(sheet, x, [upper.top, bottom])?;
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
        if line.len() >= FEW {
            return draw_dense(sheet, &line, colour);
        }
        if line.len() > 1 {
            sheet.line(&line, 0.7, colour.to_rgba())?;
        }
        for &place in &line {
            sheet.marker(Look::of(0).marker, place, 1.4, colour)?;
        }
        Ok(())
    }

    /// The acceleration itself, over the record in which it hides.
    fn draw_acceleration<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let frame = &self.frames[0];
        let half = 0.5 / self.trace.rate / self.unit;
        let of_equal = |a: &Row, b: &Row| a.acceleration == b.acceleration;
        let line: Vec<_> = (self.rows.chunk_by(of_equal))
            .flat_map(|stretch| {
                let (first, last) = (&stretch[0], &stretch[stretch.len() - 1]);
                let ends = [self.x(first) - half, self.x(last) + half];
                ends.map(|x| frame.at(x, first.acceleration))
            })
            .collect();
        sheet.line(&line, 1.3, Look::of(1).colour.to_rgba())
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
        let legend = Legend::new(vec![entry(0, "record"), entry(1, "acceleration in it")]);
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
        self.frames[self.frames.len() - 1].sheet_size(&self.caption)
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
        self.frames[self.frames.len() - 1].draw_caption(sheet, &self.caption)
    }
}

/// A scale that holds every value and zero, with a share `above` of their range left free on top.
fn values(rows: &[Row], above: f64, value: impl Fn(&Row) -> Option<f64>) -> Scale {
    let all = || rows.iter().filter_map(&value).chain([0.0]);
    let low = all().fold(f64::INFINITY, f64::min);
    let high = all().fold(f64::NEG_INFINITY, f64::max);
    let room = (high - low).max(1e-9);
    Scale::linear(low - 0.06 * room, high + above * room, 5)
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

fn caption(scenario: &Scenario, trace: &Trace, manifest: &Manifest) -> Vec<String> {
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
    parts.push(literal(&scenario.sensor.to_string()).replace('-', "−"));
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
    parts.push(format!("seed {}", manifest.origin.seed));
    wrap(&parts, WIDTH - 2.0 * CAPTION_LEFT)
}
