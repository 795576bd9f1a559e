//! Autocorrelation against lag, and below it how far the simulation is from theory.

use super::FigureError;
use super::frame::{CAPTION_LEFT, Frame, Scale, WIDTH};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::sheet::{Picture, Sheet};
use super::text::literal;
use super::words::wrap;
use crate::chain::Scenario;
use crate::format::thousands;
use crate::results::Manifest;
use crate::signal::Sensor;
use crate::study::rows::Autocorrelation as Row;
use plotters::prelude::{Color, DrawingBackend};

const UPPER: f64 = 160.0;
const LOWER: f64 = 92.0;
const MARKER: f64 = 2.0;
const LINE: f64 = 1.0;
/// What tells theory, exact theory and simulation apart.
const THEORY: usize = 0;
const EXACT: usize = 3;
const SIMULATION: usize = 1;

/// The picture of an autocorrelation.
pub(super) struct Lags<'a> {
    rows: &'a [Row],
    frames: [Frame; 2],
    x_label: &'static str,
    caption: Vec<String>,
}

impl<'a> Lags<'a> {
    pub fn new(
        scenario: &Scenario,
        confidence: f64,
        length: usize,
        rows: &'a [Row],
        manifest: &Manifest,
    ) -> Self {
        let last = rows.len() as f64 - 1.0;
        let x = Scale {
            from: -0.02 * last,
            to: 1.02 * last,
            ..Scale::linear(0.0, last, 8)
        };
        let deviations = rows.iter().flat_map(deviations);
        let widest = deviations.map(f64::abs).fold(1e-12, f64::max);
        let [upper, lower] = [
            Scale {
                from: -1.1,
                to: 1.1,
                ..Scale::linear(-1.0, 1.0, 4)
            },
            Scale::linear(-1.1 * widest, 1.1 * widest, 6),
        ];
        let is_adxl105 = scenario.sensor == Sensor::adxl105();
        Self {
            frames: Frame::stack(10.0, [(UPPER, upper), (LOWER, lower)], &x),
            x_label: match is_adxl105 {
                true => "lag k, samples (T_0 = 62.5 µs)",
                false => "lag k, samples",
            },
            caption: caption(scenario, confidence, length, manifest),
            rows,
        }
    }

    fn line(&self, frame: &Frame, y: impl Fn(&Row) -> f64) -> Vec<(f64, f64)> {
        let points = self.rows.iter();
        points.map(|row| frame.at(row.lag as f64, y(row))).collect()
    }

    fn draw_upper<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        for (index, line) in [
            (THEORY, self.line(frame, |row| row.theory)),
            (EXACT, self.line(frame, |row| row.exact_transfer)),
        ] {
            let look = Look::of(index);
            sheet.dashed(&line, LINE, look.colour.to_rgba(), look.dash)?;
        }
        frame.draw_axes(sheet, "", "ρ_k, autocorrelation")?;
        let look = Look::of(SIMULATION);
        let estimates = self.line(frame, |row| row.estimate);
        for &place in &estimates {
            sheet.marker(look.marker, place, MARKER, look.colour)?;
        }
        let legend = self.legend();
        let corner = legend.free_corner(frame, &estimates);
        legend.draw(
            sheet,
            corner.unwrap_or((frame.right - 220.0, frame.top + 4.0)),
        )
    }

    fn draw_lower<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        frame.draw_level(sheet, 0.0, &[])?;
        let exact = Look::of(EXACT);
        let line = self.line(frame, |row| row.exact_transfer - row.theory);
        sheet.dashed(&line, LINE, exact.colour.to_rgba(), exact.dash)?;
        let look = Look::of(SIMULATION);
        for row in self.rows {
            let x = row.lag as f64;
            let ends = [row.low, row.high].map(|y| frame.at(x, y - row.theory));
            sheet.line(&ends, 0.8, look.colour.to_rgba())?;
            let place = frame.at(x, row.estimate - row.theory);
            sheet.marker(look.marker, place, MARKER, look.colour)?;
        }
        frame.draw_axes(sheet, self.x_label, "minus theory")
    }

    fn legend(&self) -> Legend {
        let entry = |index, key, text: &str| Entry {
            text: text.to_owned(),
            look: Look::of(index),
            key,
        };
        Legend::new(vec![
            entry(THEORY, Key::Line, "theory, coefficients of the simulation"),
            entry(EXACT, Key::Line, "theory, exact transfer of (1)"),
            entry(SIMULATION, Key::Marker, "simulation"),
        ])
    }
}

impl Picture for Lags<'_> {
    fn size(&self) -> (f64, f64) {
        self.frames[1].sheet_size(&self.caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        sheet.clear(self.size())?;
        for frame in &self.frames {
            frame.draw_grid(sheet)?;
        }
        self.draw_upper(sheet, &self.frames[0])?;
        self.draw_lower(sheet, &self.frames[1])?;
        self.frames[1].draw_caption(sheet, &self.caption)
    }
}

/// What the lower panel has to hold.
fn deviations(row: &Row) -> [f64; 3] {
    [row.low, row.high, row.exact_transfer].map(|value| value - row.theory)
}

fn caption(
    scenario: &Scenario,
    confidence: f64,
    length: usize,
    manifest: &Manifest,
) -> Vec<String> {
    let parts = [
        literal(&scenario.sensor.to_string()).replace('-', "−"),
        format!("{} noise", literal(&scenario.noise.to_string())),
        format!(
            "{} records of {} samples",
            thousands(manifest.origin.trials),
            thousands(length as u64)
        ),
        "mean product over the known variance of x".to_owned(),
        format!("seed {}", manifest.origin.seed),
        format!(
            "bars: pointwise normal {} % intervals of the mean",
            100.0 * confidence
        ),
    ];
    wrap(&parts, WIDTH - 2.0 * CAPTION_LEFT)
}
