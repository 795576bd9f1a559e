//! P(W, T) against P(W)·P(T), for every W, T and sizes: on the diagonal where W and T are independent.

use super::FigureError;
use super::frame::{CAPTION_LEFT, Frame, Scale, WIDTH};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::sheet::{Picture, Sheet};
use super::words::wrap;
use crate::format::thousands;
use crate::study::rows::{Independence as Row, findings};
use plotters::prelude::{BLACK, Color, DrawingBackend};

const HEIGHT: f64 = 280.0;
const MARKER: f64 = 1.8;
/// Sizes that a legend can name.
const NAMED: usize = 18;

/// The picture of an enumeration.
pub(super) struct Diagonal<'a> {
    sizes: Vec<&'a [Row]>,
    frame: Frame,
    caption: Vec<String>,
}

impl<'a> Diagonal<'a> {
    pub fn new(rows: &'a [Row]) -> Self {
        let sizes: Vec<&[Row]> = rows.chunk_by(|a, b| sizes_of(a) == sizes_of(b)).collect();
        let logarithms = rows.iter().flat_map(places).filter(|x| x.is_finite());
        let lowest = logarithms.fold(-1.0, f64::min).floor();
        let scale = Scale::powers_of_ten(lowest - 0.2, 0.2, 8);
        Self {
            frame: Frame {
                left: 54.0,
                right: WIDTH - 16.0,
                top: 10.0,
                bottom: HEIGHT,
                x: scale.clone(),
                y: scale,
            },
            caption: caption(rows),
            sizes,
        }
    }

    /// On the sheet; a cell that never occurs lies on the lower edge.
    fn place(&self, row: &Row) -> (f64, f64) {
        let [x, y] = places(row);
        self.frame.at(x, y.max(self.frame.y.from))
    }

    fn legend(&self) -> Legend {
        let entry = |(index, rows): (usize, &&[Row])| Entry {
            text: sizes_of(&rows[0]).map(|size| size.to_string()).join("/"),
            look: Look::of(index),
            key: Key::Marker,
        };
        let entries = self.sizes.iter().enumerate().take(NAMED).map(entry);
        Legend::new(entries.collect())
    }
}

impl Picture for Diagonal<'_> {
    fn size(&self) -> (f64, f64) {
        self.frame.sheet_size(&self.caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let frame = &self.frame;
        sheet.clear(self.size())?;
        frame.draw_grid(sheet)?;
        let (from, to) = (frame.x.from, frame.x.to);
        let diagonal = [frame.at(from, from), frame.at(to, to)];
        sheet.line(&diagonal, 0.8, BLACK.mix(0.6))?;
        for (index, rows) in self.sizes.iter().enumerate() {
            let look = Look::of(index);
            for row in rows.iter() {
                sheet.marker(look.marker, self.place(row), MARKER, look.colour)?;
            }
        }
        frame.draw_axes(sheet, "P(W)·P(T)", "P(W, T)")?;
        let covered: Vec<_> = (self.sizes.iter().copied().flatten())
            .map(|row| self.place(row))
            .collect();
        let legend = self.legend();
        let corner = legend.free_corner(frame, &covered);
        legend.draw(sheet, corner.unwrap_or((frame.left + 6.0, frame.top + 6.0)))?;
        frame.draw_caption(sheet, &self.caption)
    }
}

fn sizes_of(row: &Row) -> [usize; 3] {
    [row.reference, row.shift, row.scale]
}

/// Decimal logarithms of both probabilities.
fn places(row: &Row) -> [f64; 2] {
    [row.product, row.joint].map(libm::log10)
}

fn caption(rows: &[Row]) -> Vec<String> {
    let findings = findings(rows);
    let assignments: u64 = findings.iter().map(|finding| finding.assignments).sum();
    let largest = findings.iter().map(|finding| finding.largest_difference);
    let parts = [
        "N/M_1/M_2 as in the legend".to_owned(),
        format!(
            "all {} assignments of ranks enumerated",
            thousands(assignments)
        ),
        format!("{} pairs of W and T", thousands(rows.len() as u64)),
        format!(
            "largest |n(W, T)·n − n(W)·n(T)| in whole numbers: {}",
            largest.max().unwrap_or(0)
        ),
    ];
    wrap(&parts, WIDTH - 2.0 * CAPTION_LEFT)
}
