//! The laws of S and of λ against time: closed form and simulation.

use super::FigureError;
use super::frame::{CAPTION_LEFT, Frame, Scale, WIDTH};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::sheet::{Picture, Sheet};
use super::words::wrap;
use crate::format::thousands;
use crate::results::Manifest;
use crate::study::rows::ImpulseLaw as Row;
use plotters::prelude::{Color, DrawingBackend};

const UPPER: f64 = 150.0;
const LOWER: f64 = 110.0;
const MARKER: f64 = 1.9;
const LINE: f64 = 1.0;
/// Markers along a curve, at most.
const MARKERS: usize = 34;

/// The picture of both laws.
pub(super) struct Laws<'a> {
    curves: Vec<&'a [Row]>,
    frames: [Frame; 2],
    caption: Vec<String>,
}

impl<'a> Laws<'a> {
    pub fn new(rows: &'a [Row], manifest: &Manifest, confidence: f64) -> Self {
        let curves: Vec<&[Row]> = rows.chunk_by(|a, b| a.nu == b.nu).collect();
        let last = rows.iter().map(|row| row.sample).max().unwrap_or(1) as f64;
        let x = Scale {
            from: -0.02 * last,
            to: 1.02 * last,
            ..Scale::linear(0.0, last, 8)
        };
        let lowest = rows.iter().map(|row| row.zero_sum_low).fold(0.5, f64::min);
        let highest = rows.iter().map(|row| row.positive_high).fold(0.0, f64::max);
        let [upper, lower] = [
            Scale {
                to: 1.03,
                ..Scale::linear((lowest - 0.05).max(0.0), 1.0, 6)
            },
            Scale::linear(0.0, 1.12 * highest, 4),
        ];
        Self {
            frames: Frame::stack(10.0, [(UPPER, upper), (LOWER, lower)], &x),
            caption: caption(rows[0].trials, manifest, confidence),
            curves,
        }
    }

    /// The rows that get a marker.
    fn marked(curve: &[Row]) -> impl Iterator<Item = &Row> {
        curve.iter().step_by(curve.len().div_ceil(MARKERS))
    }

    fn draw_curves<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
        exact: impl Fn(&Row) -> f64,
        simulated: impl Fn(&Row) -> [f64; 3],
    ) -> Result<(), FigureError> {
        for (index, curve) in self.curves.iter().enumerate() {
            let look = Look::of(index);
            let line: Vec<_> = (curve.iter())
                .map(|row| frame.at(row.sample as f64, exact(row)))
                .collect();
            sheet.line(&line, LINE, look.colour.mix(0.55))?;
            for row in Self::marked(curve) {
                let [low, rate, high] = simulated(row).map(|y| frame.at(row.sample as f64, y));
                sheet.line(&[low, high], LINE, look.colour.to_rgba())?;
                sheet.marker(look.marker, rate, MARKER, look.colour)?;
            }
        }
        Ok(())
    }

    fn draw_legend<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        let entry = |(index, curve): (usize, &&[Row])| Entry {
            text: format!("ν = {}", curve[0].nu),
            look: Look::of(index),
            key: Key::MarkedLine,
        };
        let legend = Legend::new(self.curves.iter().enumerate().map(entry).collect());
        let rows = self.curves.iter().copied().flatten();
        let covered: Vec<_> = rows
            .map(|row| frame.at(row.sample as f64, row.zero_sum))
            .collect();
        let corner = legend.free_corner(frame, &covered);
        legend.draw(
            sheet,
            corner.unwrap_or((frame.right - 80.0, frame.top + 6.0)),
        )
    }
}

impl Picture for Laws<'_> {
    fn size(&self) -> (f64, f64) {
        self.frames[1].sheet_size(&self.caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let [upper, lower] = &self.frames;
        sheet.clear(self.size())?;
        upper.draw_grid(sheet)?;
        upper.draw_level(sheet, 0.5, &[4.0, 2.0])?;
        self.draw_curves(
            sheet,
            upper,
            |row| row.zero_sum,
            |row| [row.zero_sum_low, row.zero_sum_rate, row.zero_sum_high],
        )?;
        upper.draw_axes(sheet, "", "P(S_i = 0)")?;
        self.draw_legend(sheet, upper)?;
        lower.draw_grid(sheet)?;
        self.draw_curves(
            sheet,
            lower,
            |row| row.positive,
            |row| [row.positive_low, row.positive_rate, row.positive_high],
        )?;
        lower.draw_axes(sheet, "i, samples since S = 0", "P(λ_i = +θ)")?;
        lower.draw_caption(sheet, &self.caption)
    }
}

fn caption(trials: u64, manifest: &Manifest, confidence: f64) -> Vec<String> {
    let parts = [
        "lines: P(S_i = 0) = (1 + (1 − 2ν)ⁱ)/2 and P(λ_i = +θ) = ν/2".to_owned(),
        "dashed: the limit ½ of (6)".to_owned(),
        format!("markers: {} realisations", thousands(trials)),
        format!("seed {}", manifest.origin.seed),
        format!("bars: pointwise exact {} % intervals", 100.0 * confidence),
    ];
    wrap(&parts, WIDTH - 2.0 * CAPTION_LEFT)
}
