//! The plane of W and T: the null probability of every cell on a logarithmic scale, and the boundary
//! C_W(T) of each region as a line of its own colour, dash and width.

use super::FigureError;
use super::frame::{CAPTION_LEFT, Frame, SMALL, Scale, WIDTH, power_of_ten};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::sheet::{Picture, Sheet};
use super::text::{Align, Style};
use super::words::wrap;
use crate::detect::{Alternative, NullLaws, Samples};
use crate::study::rows::Region as Row;
use plotters::prelude::{BLACK, Color, DrawingBackend, RGBColor};

const HEIGHT: f64 = 238.0;
/// Cells less probable than this are as pale as it.
const FAINTEST: f64 = 1e-12;
/// Columns of the picture; a wide law is drawn by the largest probability in each.
const COLUMNS: usize = 160;
/// The width of the last line; those before are wider, so that lines that coincide are all seen.
const LINE: f64 = 1.2;

/// The picture of one or more regions.
pub(super) struct Plane<'a> {
    laws: &'a NullLaws,
    /// The rows of each rule.
    regions: Vec<&'a [Row]>,
    caption: Vec<String>,
}

/// What the regions share, and where they lie, in the parts of a caption.
pub(super) fn title(samples: &Samples, alternative: Alternative, alpha: f64) -> Vec<String> {
    let side = match alternative {
        Alternative::Greater => {
            "a rule decides H_1* to the right of its line, and above it where it runs level"
        }
        Alternative::Less => {
            "a rule decides H_1* to the left of its line, and above it where it runs level"
        }
        Alternative::TwoSided => {
            "a rule decides H_1* outside its lines, and above them where they run level"
        }
    };
    vec![
        format!("N = {}", samples.reference()),
        format!("M_1 = {}", samples.shift()),
        format!("M_2 = {}", samples.scale()),
        format!("alternative {alternative}"),
        format!("α = {alpha}"),
        side.to_owned(),
    ]
}

impl<'a> Plane<'a> {
    pub fn new(laws: &'a NullLaws, rows: &'a [Row], title: Vec<String>) -> Self {
        Self {
            laws,
            regions: rows.chunk_by(|a, b| a.rule == b.rule).collect(),
            caption: wrap(&title, WIDTH - 2.0 * CAPTION_LEFT),
        }
    }

    /// The rank sums worth showing: between them lies all but a 1e-12th of either tail.
    fn visible(&self) -> (u64, u64) {
        let law = self.laws.rank_sum();
        let high = law.critical(FAINTEST).min(law.last());
        (law.first() + law.last() - high, high)
    }

    fn legend(&self) -> Legend {
        let entry = |(index, rows): (usize, &&[Row])| Entry {
            text: format!(
                "{}, exact size {:.6}",
                rows[0].rule.split('(').next().unwrap_or_default(),
                rows[0].size
            ),
            look: Look::of(LOOKS[index % LOOKS.len()]),
            key: Key::Line,
        };
        Legend::new(self.regions.iter().enumerate().map(entry).collect())
    }

    fn frame(&self) -> Frame {
        let (low, high) = self.visible();
        let top = self.legend().height() + 12.0;
        Frame {
            left: 48.0,
            right: WIDTH - 76.0,
            top,
            bottom: top + HEIGHT,
            x: Scale::linear(low as f64 - 0.5, high as f64 + 0.5, 7),
            y: Scale::linear(-0.5, self.laws.exceedances().last() as f64 + 0.5, 8),
        }
    }
}

/// Dark colours first: lines lie on blue.
const LOOKS: [usize; 6] = [1, 2, 3, 4, 0, 5];

impl Picture for Plane<'_> {
    fn size(&self) -> (f64, f64) {
        self.frame().sheet_size(&self.caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let frame = self.frame();
        sheet.clear(self.size())?;
        self.draw_cells(sheet, &frame)?;
        self.draw_key(sheet, &frame)?;
        for (index, rows) in self.regions.iter().enumerate() {
            let wider = 0.5 * (self.regions.len() - 1 - index) as f64;
            let look = Look::of(LOOKS[index % LOOKS.len()]);
            for line in boundaries(rows, &frame) {
                sheet.dashed(&line, LINE + wider, look.colour.to_rgba(), look.dash)?;
            }
        }
        frame.draw_axes(sheet, "W, rank sum of Y_1", "T, exceedances of Y_2")?;
        self.legend().draw(sheet, (frame.left, 4.0))?;
        frame.draw_caption(sheet, &self.caption)
    }
}

impl Plane<'_> {
    fn draw_cells<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        let (low, high) = self.visible();
        let width = (high - low + 1).div_ceil(COLUMNS as u64);
        let rank_sum: Vec<f64> = (low..=high).map(|w| self.laws.rank_sum().mass(w)).collect();
        for t in 0..=self.laws.exceedances().last() {
            let mass = self.laws.exceedances().mass(t);
            for from in (low..=high).step_by(width as usize) {
                let to = (from + width - 1).min(high);
                let of_column = &rank_sum[(from - low) as usize..=(to - low) as usize];
                let probability = of_column.iter().copied().fold(0.0, f64::max) * mass;
                let corner = frame.at(from as f64 - 0.5, t as f64 + 0.5);
                let opposite = frame.at(to as f64 + 0.5, t as f64 - 0.5);
                sheet.rectangle(corner, opposite, shade(probability).to_rgba())?;
            }
        }
        Ok(())
    }

    fn draw_key<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
    ) -> Result<(), FigureError> {
        let (left, top) = (frame.right + 12.0, frame.top + 16.0);
        let style = Style::plain(SMALL, Align::Left);
        sheet.text("P(W, T | H_0)", (left, top - 8.0), style)?;
        for (row, exponent) in (2..=12).step_by(2).enumerate() {
            let y = top + 14.0 * row as f64;
            let probability = libm::pow(10.0, -f64::from(exponent));
            let (corner, opposite) = ((left, y), (left + 14.0, y + 10.0));
            sheet.rectangle(corner, opposite, shade(probability).to_rgba())?;
            sheet.outline(corner, opposite, 0.4, BLACK.mix(0.5))?;
            let label = power_of_ten(-exponent);
            sheet.text(&label, (left + 20.0, y + 8.0), style)?;
        }
        Ok(())
    }
}

/// The lines around a region, on the sheet: for large W, and for small W where there are such. A part
/// that lies outside the frame is left out.
fn boundaries(rows: &[Row], frame: &Frame) -> Vec<Vec<(f64, f64)>> {
    let upper = |row: &Row| row.upper.map_or(f64::INFINITY, |w| w as f64 - 0.5);
    let lower = |row: &Row| row.lower.map_or(f64::NEG_INFINITY, |w| w as f64 + 0.5);
    let mut lines = steps(rows, frame, upper);
    lines.extend(steps(rows, frame, lower));
    lines
}

fn steps(rows: &[Row], frame: &Frame, at: impl Fn(&Row) -> f64) -> Vec<Vec<(f64, f64)>> {
    let (from, to) = (frame.x.from, frame.x.to);
    let corners: Vec<(f64, f64)> = rows
        .iter()
        .flat_map(|row| {
            let (w, t) = (at(row).clamp(from, to), row.exceedances as f64);
            [(w, t - 0.5), (w, t + 0.5)]
        })
        .collect();
    let is_on_edge = |w: f64| w <= from || w >= to;
    let mut lines: Vec<Vec<(f64, f64)>> = vec![Vec::new()];
    for (index, pair) in corners.windows(2).enumerate() {
        let (a, b) = (pair[0], pair[1]);
        let is_upright = index % 2 == 0;
        if is_upright && (is_on_edge(a.0) || decides_always(&rows[index / 2])) {
            lines.push(Vec::new());
            continue;
        }
        let last = lines.last_mut().expect("there is a line");
        if last.is_empty() {
            last.push(frame.at(a.0, a.1));
        }
        last.push(frame.at(b.0, b.1));
    }
    lines.retain(|line| line.len() > 1);
    lines
}

/// Whether small W and large W meet.
fn decides_always(row: &Row) -> bool {
    matches!((row.lower, row.upper), (Some(lower), Some(upper)) if upper <= lower + 1)
}

/// Darker where likelier.
fn shade(probability: f64) -> RGBColor {
    let depth =
        (1.0 - libm::log10(probability.max(FAINTEST)) / libm::log10(FAINTEST)).clamp(0.0, 1.0);
    let mix = |channel: f64| (255.0 + (channel - 255.0) * (0.04 + 0.8 * depth)) as u8;
    RGBColor(mix(60.0), mix(90.0), mix(130.0))
}
