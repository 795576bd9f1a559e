//! Operating points: the Δ/σ_ξ at which the power reaches a value, against the sizes of the samples.

use super::FigureError;
use super::frame::{CAPTION_LEFT, CAPTION_STEP, Frame, Scale, WIDTH, draw_caption};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::sheet::{Picture, Sheet};
use super::words::wrap;
use crate::chain::Scenario;
use crate::format::thousands;
use crate::results::Manifest;
use crate::study::rows::OperatingPoint as Row;
use plotters::prelude::{Color, DrawingBackend};

const HEIGHT: f64 = 240.0;
const LINE: f64 = 1.1;
const MARKER: f64 = 2.3;

/// The picture of a search.
pub(super) struct Points<'a> {
    curves: Vec<Vec<&'a Row>>,
    frame: Frame,
    caption: Vec<String>,
}

impl<'a> Points<'a> {
    pub fn new(scenario: &Scenario, rows: &'a [Row], manifest: &Manifest) -> Self {
        let mut curves: Vec<Vec<&Row>> = Vec::new();
        for row in rows {
            match curves.iter_mut().find(|curve| curve[0].power == row.power) {
                Some(curve) => curve.push(row),
                None => curves.push(vec![row]),
            }
        }
        let sizes = || rows.iter().map(|row| libm::log10(row.all_samples as f64));
        let (first, last) = (
            sizes().fold(f64::INFINITY, f64::min),
            sizes().fold(f64::NEG_INFINITY, f64::max),
        );
        let ends = rows.iter().filter_map(|row| row.high.or(row.delta));
        let top = ends.fold(0.1, f64::max);
        Self {
            curves,
            frame: Frame {
                left: 54.0,
                right: WIDTH - 16.0,
                top: 10.0,
                bottom: HEIGHT - 40.0,
                x: Scale {
                    from: first - 0.03,
                    to: last + 0.03,
                    ticks: ticks(rows),
                },
                y: Scale::linear(0.0, 1.08 * top, 6),
            },
            caption: caption(scenario, &rows[0], manifest),
        }
    }

    fn at(&self, row: &Row, delta: f64) -> (f64, f64) {
        self.frame.at(libm::log10(row.all_samples as f64), delta)
    }

    fn draw_curve<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        curve: &[&'a Row],
        look: Look,
    ) -> Result<(), FigureError> {
        let found = |row: &'a Row| Some((self.at(row, row.delta?), row));
        let points: Vec<((f64, f64), &Row)> = curve.iter().copied().filter_map(found).collect();
        let line: Vec<(f64, f64)> = points.iter().map(|(at, _)| *at).collect();
        sheet.line(&line, LINE, look.colour.mix(0.6))?;
        for (at, row) in points {
            if let (Some(low), Some(high)) = (row.low, row.high) {
                let ends = [self.at(row, low), self.at(row, high)];
                sheet.line(&ends, LINE, look.colour.to_rgba())?;
            }
            sheet.marker(look.marker, at, MARKER, look.colour)?;
        }
        Ok(())
    }

    fn legend(&self) -> Legend {
        let entry = |(index, curve): (usize, &Vec<&Row>)| Entry {
            text: format!("D = {}", curve[0].power),
            look: Look::of(index),
            key: Key::MarkedLine,
        };
        Legend::new(self.curves.iter().enumerate().map(entry).collect())
    }
}

impl Picture for Points<'_> {
    fn size(&self) -> (f64, f64) {
        (WIDTH, HEIGHT + CAPTION_STEP * self.caption.len() as f64)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        sheet.clear(self.size())?;
        self.frame.draw_grid(sheet)?;
        self.frame
            .draw_axes(sheet, "N = M_1 = M_2, samples", "Δ/σ_ξ that reaches D")?;
        for (index, curve) in self.curves.iter().enumerate() {
            self.draw_curve(sheet, curve, Look::of(index))?;
        }
        let corner = (self.frame.right - 80.0, self.frame.top + 6.0);
        self.legend().draw(sheet, corner)?;
        draw_caption(sheet, &self.caption, HEIGHT + 1.0)
    }
}

/// A tick at every size.
fn ticks(rows: &[Row]) -> Vec<(f64, String)> {
    let mut sizes: Vec<usize> = rows.iter().map(|row| row.all_samples).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let tick = |size: usize| (libm::log10(size as f64), size.to_string());
    sizes.into_iter().map(tick).collect()
}

fn caption(scenario: &Scenario, row: &Row, manifest: &Manifest) -> Vec<String> {
    let parts = [
        format!("α = {}", row.alpha),
        format!("rule {}", scenario.detector.method),
        format!("ν = {}", scenario.impulses.nu()),
        format!("θ/σ_ξ = {}", scenario.impulses.theta()),
        format!("{} noise", scenario.noise),
        format!("{} filter", scenario.whitening.fit()),
        format!("order {}", scenario.whitening.order()),
        format!("training {}", scenario.whitening.training()),
        format!("{} trials at every Δ", thousands(row.trials)),
        format!("seed {}", manifest.origin.seed),
        format!(
            "bars: exact {} % intervals, inverted",
            100.0 * row.confidence
        ),
    ];
    wrap(&parts, WIDTH - 2.0 * CAPTION_LEFT)
}
