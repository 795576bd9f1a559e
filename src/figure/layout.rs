//! Where the samples of a trial lie: the acceleration above, the blocks below, one axis.

use super::FigureError;
use super::frame::{CAPTION_LEFT, Frame, NORMAL, SMALL, Scale, WIDTH};
use super::look::Look;
use super::phases::{draw_limit, phase_colour, phase_words};
use super::sheet::{Picture, Sheet};
use super::text::{Align, Style, text_width};
use super::words::wrap;
use crate::chain::Scenario;
use crate::signal::{Motion, Profile};
use crate::study::rows::Layout as Row;
use plotters::prelude::{Color, DrawingBackend, RGBColor};

const UPPER: f64 = 84.0;
const LOWER: f64 = 74.0;

/// The picture of a layout.
pub(super) struct Layout<'a> {
    rows: &'a [Row],
    motion: Motion,
    frames: [Frame; 2],
    caption: Vec<String>,
}

impl<'a> Layout<'a> {
    pub fn new(scenario: &Scenario, rows: &'a [Row]) -> Self {
        let samples = &scenario.samples;
        let end = rows.iter().map(|row| row.end).max().unwrap_or(0) as f64;
        let first = rows.iter().map(|row| row.start).min().unwrap_or(0) as f64;
        let reference = samples.reference() as f64;
        // A long training record is cut: what counts is where it ends.
        let cut = (reference + 0.35 * (reference + end)).ceil();
        let x = Scale {
            from: first.max(-cut),
            to: end + 0.04 * (end + cut),
            ..Scale::linear(first.max(-cut), end, 8)
        };
        let [upper, lower] = [
            Scale {
                from: -0.35,
                to: 1.35,
                ticks: vec![(0.0, "0".to_owned()), (1.0, "Δ".to_owned())],
            },
            Scale {
                from: 0.0,
                to: 1.0,
                ticks: Vec::new(),
            },
        ];
        Self {
            frames: Frame::stack(18.0, [(UPPER, upper), (LOWER, lower)], &x),
            motion: scenario.motion,
            caption: caption(scenario),
            rows,
        }
    }

    fn row(&self, name: &str) -> Option<&Row> {
        self.rows.iter().find(|row| row.name == name)
    }

    /// Both ends of a stretch on the axis, what is cut off left out.
    fn ends(&self, row: &Row) -> (f64, f64) {
        let (from, to) = (self.frames[0].x.from, self.frames[0].x.to);
        ((row.start as f64).max(from), (row.end as f64).min(to))
    }

    fn draw_phases<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        for name in ["rest", "acceleration", "inertial"] {
            let Some(row) = self.row(name) else { continue };
            let (from, to) = self.ends(row);
            for frame in &self.frames {
                frame.draw_band(sheet, (from, to), phase_colour(name))?;
            }
            let (x, _) = self.frames[0].at(f64::midpoint(from, to), 0.0);
            let word = phase_words(name);
            let at = (x, self.frames[0].top - 5.0);
            sheet.text(word, at, Style::plain(SMALL, Align::Centre))?;
        }
        Ok(())
    }

    fn draw_pulse<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let frame = &self.frames[0];
        let end = self.rows.iter().map(|row| row.end).max().unwrap_or(0) as f64;
        let shape = |time: f64| match time < 0.0 {
            true => 0.0,
            false => self.motion.shape(time),
        };
        let start = self.motion.offset as f64;
        let stop = start + self.motion.duration as f64;
        let rise = match self.motion.profile {
            Profile::Rectangular => 0.0,
            Profile::Trapezoid { rise } => rise,
        };
        let mut line = vec![frame.at(frame.x.from, 0.0)];
        let turns = [start, start + rise, stop - rise, stop];
        for time in turns.into_iter().filter(|time| *time < end) {
            // A jump is upright: both its sides have a point.
            line.extend([-1e-6, 1e-6].map(|side| frame.at(time, shape(time + side))));
        }
        line.push(frame.at(end, shape(end - 1e-6)));
        sheet.line(&line, 1.3, Look::of(1).colour.to_rgba())
    }

    fn draw_blocks<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let frame = &self.frames[1];
        for row in self.rows {
            let Some(block) = Block::of(row) else {
                continue;
            };
            let (from, to) = self.ends(row);
            let (corner, opposite) = (frame.at(from, 0.86), frame.at(to, 0.14));
            if let Some(colour) = block.colour {
                sheet.rectangle(corner, opposite, colour.mix(0.28))?;
                sheet.outline(corner, opposite, 0.8, colour.to_rgba())?;
            }
            if row.start as f64 != from {
                self.draw_cut(sheet, corner)?;
            }
            let middle = f64::midpoint(corner.0, opposite.0);
            let room = opposite.0 - corner.0;
            let lines = block
                .lines
                .iter()
                .filter(|text| text_width(text, SMALL) < room);
            for (line, text) in (0..).zip(lines) {
                let at = (middle, corner.1 + 15.0 + 13.0 * f64::from(line));
                let size = if line == 0 { NORMAL } else { SMALL };
                sheet.text(text, at, Style::plain(size, Align::Centre))?;
            }
        }
        Ok(())
    }

    /// Three dots where a block goes on beyond the picture.
    fn draw_cut<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        corner: (f64, f64),
    ) -> Result<(), FigureError> {
        let at = (corner.0 + 9.0, corner.1 + 15.0);
        sheet.text("…", at, Style::plain(NORMAL, Align::Centre))
    }

    /// Where X, Y₁ and Y₂ begin and end, through both panels.
    fn draw_limits<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let [upper, lower] = &self.frames;
        for row in self.rows {
            if !["reference", "shift", "scale"].contains(&row.name.as_str()) {
                continue;
            }
            for x in [row.start, row.end] {
                draw_limit(sheet, upper.at(x as f64, 0.0).0, [upper.top, lower.bottom])?;
            }
        }
        Ok(())
    }
}

impl Picture for Layout<'_> {
    fn size(&self) -> (f64, f64) {
        self.frames[1].sheet_size(&self.caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let [upper, lower] = &self.frames;
        sheet.clear(self.size())?;
        self.draw_phases(sheet)?;
        self.draw_blocks(sheet)?;
        self.draw_limits(sheet)?;
        self.draw_pulse(sheet)?;
        upper.draw_axes(sheet, "", "acceleration, σ_ξ")?;
        lower.draw_axes(sheet, "time, observations after X", "samples")?;
        lower.draw_caption(sheet, &self.caption)
    }
}

/// How a stretch of samples is drawn.
struct Block {
    colour: Option<RGBColor>,
    lines: Vec<String>,
}

impl Block {
    fn of(row: &Row) -> Option<Self> {
        let length = row.end - row.start;
        let (index, lines) = match row.name.as_str() {
            "training" => (
                5,
                vec!["training".to_owned(), format!("{length}, for the filter")],
            ),
            "reference" => (0, vec!["X".to_owned(), format!("N = {length}")]),
            "shift" => (
                1,
                vec![
                    "Y_1".to_owned(),
                    format!("M_1 = {length}"),
                    "shift: W".to_owned(),
                ],
            ),
            "scale" => (
                2,
                vec![
                    "Y_2".to_owned(),
                    format!("M_2 = {length}"),
                    "scale: T".to_owned(),
                ],
            ),
            "gap" => {
                let lines = vec!["gap".to_owned()];
                return Some(Self {
                    colour: None,
                    lines,
                });
            }
            _ => return None,
        };
        let colour = Some(Look::of(index).colour);
        Some(Self { colour, lines })
    }
}

fn caption(scenario: &Scenario) -> Vec<String> {
    let (samples, motion) = (&scenario.samples, &scenario.motion);
    let parts = [
        format!("N = {}", samples.reference()),
        format!("M_1 = {}", samples.shift()),
        format!("M_2 = {}", samples.scale()),
        format!("gap {}", samples.gap()),
        format!("training {}", scenario.whitening.training()),
        format!(
            "acceleration: {} observations from {} on",
            motion.duration, motion.offset
        ),
        "impulses from observation 0 on".to_owned(),
    ];
    wrap(&parts, WIDTH - 2.0 * CAPTION_LEFT)
}
