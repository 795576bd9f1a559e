//! The plane of W and T: the null probability of every cell on a logarithmic scale, and the region ϑ.

use super::FigureError;
use super::frame::{CAPTION, Frame, SMALL, Scale};
use super::sheet::{Align, Picture, Sheet, Style};
use super::words::wrap;
use crate::detect::{NullLaws, Region, Statistics};
use plotters::prelude::{BLACK, Color, DrawingBackend, RGBColor};

const WIDTH: f64 = 396.0;
const HEIGHT: f64 = 290.0;
/// Cells less probable than this are as pale as it.
const FAINTEST: f64 = 1e-12;
/// Columns of the picture; a wide law is drawn by the largest probability in each.
const COLUMNS: usize = 160;

/// The picture of a region.
pub(super) struct Plane<'a> {
    laws: &'a NullLaws,
    region: &'a Region,
    title: Vec<String>,
}

impl<'a> Plane<'a> {
    pub fn new(laws: &'a NullLaws, region: &'a Region, title: &[String]) -> Self {
        let title = wrap(title, WIDTH - 58.0);
        Self {
            laws,
            region,
            title,
        }
    }

    /// The rank sums worth showing: between them lies all but a 1e-12th of either tail.
    fn visible(&self) -> (u64, u64) {
        let law = self.laws.rank_sum();
        let high = law.critical(FAINTEST).min(law.last());
        (law.first() + law.last() - high, high)
    }
}

impl Picture for Plane<'_> {
    fn size(&self) -> (f64, f64) {
        (WIDTH, HEIGHT)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let (low, high) = self.visible();
        let exceedances = self.laws.exceedances();
        let frame = Frame {
            left: 48.0,
            right: WIDTH - 76.0,
            top: 12.0 + 10.5 * self.title.len() as f64,
            bottom: HEIGHT - 40.0,
            x: Scale::linear(low as f64 - 0.5, high as f64 + 0.5, 7),
            y: Scale::linear(-0.5, exceedances.last() as f64 + 0.5, 8),
        };
        let white = RGBColor(255, 255, 255).to_rgba();
        sheet.area(
            &[(0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT)],
            white,
        )?;
        self.draw_cells(sheet, &frame, low, high)?;
        self.draw_key(sheet, &frame)?;
        frame.draw_axes(sheet, "W, rank sum of Y_1", "T, exceedances of Y_2")?;
        for (line, text) in (0..).zip(&self.title) {
            let baseline = (frame.left, 13.0 + 10.5 * f64::from(line));
            sheet.text(text, baseline, Style::plain(CAPTION, Align::Left))?;
        }
        Ok(())
    }
}

impl Plane<'_> {
    fn draw_cells<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
        low: u64,
        high: u64,
    ) -> Result<(), FigureError> {
        let width = (high - low + 1).div_ceil(COLUMNS as u64);
        let rank_sum: Vec<f64> = (low..=high).map(|w| self.laws.rank_sum().mass(w)).collect();
        for t in 0..=self.laws.exceedances().last() {
            let mass = self.laws.exceedances().mass(t);
            for from in (low..=high).step_by(width as usize) {
                let to = (from + width - 1).min(high);
                let of_column = &rank_sum[(from - low) as usize..=(to - low) as usize];
                let probability = of_column.iter().copied().fold(0.0, f64::max) * mass;
                let is_inside = |rank_sum: &u64| {
                    self.region.contains(Statistics {
                        rank_sum: *rank_sum,
                        exceedances: t as usize,
                    })
                };
                // A column is split where the region's boundary runs through it.
                let cells: Vec<u64> = (from..=to).collect();
                for run in cells.chunk_by(|a, b| is_inside(a) == is_inside(b)) {
                    let (first, last) = (run[0] as f64, run[run.len() - 1] as f64);
                    let (left, bottom) = frame.at(first - 0.5, t as f64 - 0.5);
                    let (right, top) = frame.at(last + 0.5, t as f64 + 0.5);
                    let cell = [(left, top), (right, top), (right, bottom), (left, bottom)];
                    sheet.area(&cell, shade(probability, is_inside(&run[0])).to_rgba())?;
                }
            }
        }
        Ok(())
    }

    fn draw_key<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        let left = frame.right + 12.0;
        let (top, step) = (frame.top + 24.0, 14.0);
        let heading =
            |text, x| sheet.text(text, (x, top - 14.0), Style::plain(SMALL, Align::Centre));
        heading("H_0*", left + 5.0)?;
        heading("H_1*", left + 22.0)?;
        for (row, exponent) in (2..=12).step_by(2).enumerate() {
            let y = top + step * row as f64;
            let probability = libm::pow(10.0, -f64::from(exponent));
            for (x, is_inside) in [(left, false), (left + 17.0, true)] {
                let square = [(x, y), (x + 10.0, y), (x + 10.0, y + 10.0), (x, y + 10.0)];
                sheet.area(&square, shade(probability, is_inside).to_rgba())?;
                let outline = [square[0], square[1], square[2], square[3], square[0]];
                sheet.line(&outline, 0.4, BLACK.mix(0.5))?;
            }
            let label = format!("1e−{exponent}");
            sheet.text(
                &label,
                (left + 31.0, y + 8.0),
                Style::plain(SMALL, Align::Left),
            )?;
        }
        let below = top + step * 6.0 + 8.0;
        sheet.text(
            "P(W, T | H_0)",
            (left, below),
            Style::plain(SMALL, Align::Left),
        )
    }
}

/// Darker where likelier: blue outside the region, orange inside.
fn shade(probability: f64, is_inside: bool) -> RGBColor {
    let depth =
        (1.0 - libm::log10(probability.max(FAINTEST)) / libm::log10(FAINTEST)).clamp(0.0, 1.0);
    let (r, g, b) = if is_inside {
        (190.0, 75.0, 0.0)
    } else {
        (0.0, 80.0, 140.0)
    };
    let mix = |channel: f64| {
        let lightest = if is_inside { 0.25 } else { 0.06 };
        let depth = lightest + (1.0 - lightest) * depth;
        (255.0 + (channel - 255.0) * depth) as u8
    };
    RGBColor(mix(r), mix(g), mix(b))
}
