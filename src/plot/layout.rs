//! Puts a plot on a sheet: where each panel and the legend lie, and what is drawn in them.

use super::canvas::{Align, Canvas, Shape};
use super::frame::Frame;
use super::legend::{Place, Placed};
use super::text::{CAPTION, NORMAL, SMALL, font_width, text_width};
use super::{CAPTION_LEFT, Cell, Colour, Mark, Plot, Point, WIDTH};

/// From one line of a caption to the next.
const CAPTION_STEP: f64 = 10.5;
/// Between panels one under the other in one column, and in rows of several with titles.
const BETWEEN: f64 = 10.0;
const BETWEEN_ROWS: f64 = 36.0;
/// Between panels side by side.
const BESIDE: f64 = 22.0;
/// Width of a column of a dense line.
const COLUMN: f64 = 0.4;
/// A sheet no higher than this is drawn: its raster takes 400 MB.
const HIGHEST: f64 = 2200.0;
/// What one row of panels in a grid takes, and what stands above and below all of them.
const ROW: f64 = 150.0;
const AROUND_ROWS: f64 = 250.0;
const GRAY: Colour = Colour::BLACK.faded(0.6);

/// Why a plot does not fit on a sheet.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LayoutError {
    #[error("figure: at most {most} panels can be drawn, got {panels} (draw fewer)")]
    Panels { panels: usize, most: usize },
    #[error(
        "figure: the sheet must be at most {HIGHEST} points high, got {height:.0} (draw fewer curves)"
    )]
    Height { height: f64 },
    #[error("figure: \"{text}\" runs over the edge of the sheet (shorten it)")]
    Clipped { text: String },
}

/// Whether a plot of so many panels in rows of two can be drawn.
///
/// # Errors
/// Where it cannot, with the number that can.
pub fn check_panels(panels: usize) -> Result<(), LayoutError> {
    let most = 2 * ((HIGHEST - AROUND_ROWS) / ROW) as usize;
    match panels > most {
        true => Err(LayoutError::Panels { panels, most }),
        false => Ok(()),
    }
}

/// Draws a plot on a sheet.
///
/// # Errors
/// Where it does not fit.
pub fn layout(plot: &Plot) -> Result<Canvas, LayoutError> {
    check_panels(plot.panels.len())?;
    let legend = plot.legend();
    let above = match legend {
        Some((legend, true)) => legend.height() + plot.margins.legend.1,
        _ => 0.0,
    };
    let frames = plot.frames(above);
    let bottom = frames.last().map_or(0.0, |frame| frame.bottom);
    let lines = CAPTION_STEP * plot.caption.len() as f64;
    let height = bottom + plot.margins.bottom + lines;
    if height > HIGHEST {
        return Err(LayoutError::Height { height });
    }
    let mut sheet = Sheet {
        canvas: Canvas::new((WIDTH, height)),
        frames,
        legend: legend.map(|(legend, _)| legend),
    };
    for (panel, mark) in &plot.marks {
        sheet.draw(*panel, mark);
    }
    for (line, text) in (0..).zip(&plot.caption) {
        let baseline = bottom + 41.0 + CAPTION_STEP * f64::from(line);
        sheet
            .canvas
            .text(text, (CAPTION_LEFT, baseline), CAPTION, Align::Left);
    }
    sheet.canvas.check()?;
    Ok(sheet.canvas)
}

impl Plot {
    /// The panels, with `above` points left free over all of them.
    fn frames(&self, above: f64) -> Vec<Frame<'_>> {
        (0..self.panels.len())
            .map(|index| self.frame(index, above))
            .collect()
    }

    /// The place of a panel, or the one after the last.
    fn frame(&self, index: usize, above: f64) -> Frame<'_> {
        let columns = self.columns as f64;
        let width = WIDTH - self.margins.left - self.margins.right;
        let width = (width - BESIDE * (columns - 1.0)) / columns;
        let left = self.margins.left + (index % self.columns) as f64 * (width + BESIDE);
        let between = if self.columns == 1 {
            BETWEEN
        } else {
            BETWEEN_ROWS
        };
        let rows = self
            .panels
            .iter()
            .step_by(self.columns)
            .take(index / self.columns);
        let top = rows.fold(above + self.margins.top, |top, panel| {
            top + panel.height + between
        });
        let panel = &self.panels[index.min(self.panels.len() - 1)];
        Frame {
            panel,
            left,
            right: left + width,
            top,
            bottom: top + panel.height,
        }
    }

    /// The legend in its place, and whether that is above the panels.
    fn legend(&self) -> Option<(Placed<'_>, bool)> {
        let legend = self.legend.as_ref()?;
        let column = Placed::new(legend);
        let (left, right) = match legend.place {
            Place::Across => (CAPTION_LEFT, CAPTION_LEFT),
            _ => (self.margins.left, self.margins.right),
        };
        let spread = column.spread(WIDTH - left - right);
        let inside = match legend.place {
            Place::Free => self.in_free_place(column).or(self.in_free_place(spread)),
            Place::Inside(left, down) => {
                let frame = self.frame(0, 0.0);
                let placed = column.at((frame.right - left, frame.top + down));
                (!placed.covers(&self.covered(0, &frame))).then_some(placed)
            }
            Place::Above | Place::Across => None,
        };
        let above = (spread.at((left, self.margins.legend.0)), true);
        Some(inside.map_or(above, |placed| (placed, false)))
    }

    /// In a corner of a panel, or in the last row of a grid, where its last place is free.
    fn in_free_place<'a>(&'a self, legend: Placed<'a>) -> Option<Placed<'a>> {
        if self.columns == 1 {
            let frames = self.frames(0.0).into_iter().enumerate();
            return frames
                .into_iter()
                .find_map(|(panel, frame)| legend.in_corner(&frame, &self.covered(panel, &frame)));
        }
        let free = self.frame(self.panels.len(), 0.0);
        let (width, height) = (free.right - free.left, free.bottom - free.top);
        let is_free = !self.panels.len().is_multiple_of(self.columns);
        let fits = legend.width() < width && legend.height() < height;
        (is_free && fits).then(|| legend.at((free.left, free.top)))
    }

    /// Points on the sheet that a legend must not hide: bands and lines, finely.
    fn covered(&self, panel: usize, frame: &Frame) -> Vec<(f64, f64)> {
        let mut covered = Vec::new();
        for mark in self.marks_of(panel) {
            for line in mark.outline() {
                let line: Vec<_> = line.into_iter().map(|at| frame.at(at)).collect();
                covered.extend(&line);
                let pairs = line
                    .windows(2)
                    .filter(|_| !matches!(mark, Mark::Dense { .. } | Mark::Points { .. }));
                for (a, b) in pairs.map(|pair| (pair[0], pair[1])) {
                    let share = (1..16).map(|i| f64::from(i) / 16.0);
                    covered.extend(share.map(|s| (a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1))));
                }
            }
        }
        covered
    }
}

impl Mark {
    /// The lines along which it hides what lies under it, in data.
    fn outline(&self) -> Vec<Vec<(f64, f64)>> {
        match self {
            Self::Line { points, .. } | Self::Dense { points, .. } => vec![points.clone()],
            Self::Band { points, .. } => vec![
                points.iter().map(|&(x, low, _)| (x, low)).collect(),
                points.iter().map(|&(x, _, high)| (x, high)).collect(),
            ],
            Self::Bars { bars, .. } => (bars.iter())
                .map(|&(x, low, high)| vec![(x, low), (x, high)])
                .collect(),
            Self::Points { points, .. } => {
                let ends = |p: &Point| {
                    p.bar
                        .map_or(vec![], |(low, high)| vec![(p.x, low), (p.x, high)])
                };
                let bars = points.iter().map(ends);
                let places = points.iter().map(|p| vec![(p.x, p.y)]);
                places.chain(bars).collect()
            }
            _ => Vec::new(),
        }
    }
}

/// A canvas with the panels in their places.
struct Sheet<'a> {
    canvas: Canvas,
    frames: Vec<Frame<'a>>,
    legend: Option<Placed<'a>>,
}

impl Sheet<'_> {
    fn draw(&mut self, panel: usize, mark: &Mark) {
        let frame = self.frames[panel];
        let canvas = &mut self.canvas;
        match mark {
            Mark::Grid => frame.draw_grid(canvas),
            Mark::Axes => frame.draw_axes(canvas),
            Mark::Legend => {
                if let Some(legend) = self.legend {
                    legend.draw(canvas);
                }
            }
            Mark::Line {
                points,
                width,
                style,
            } => {
                let points: Vec<_> = points.iter().map(|&at| frame.at(at)).collect();
                canvas.dashed(&points, *width, style.colour, style.dash);
            }
            Mark::Dense { points, colour } => {
                let points: Vec<_> = points.iter().map(|&at| frame.at(at)).collect();
                draw_dense(canvas, &points, *colour);
            }
            Mark::Band { points, colour } => {
                let upper = points.iter().map(|&(x, _, high)| frame.at((x, high)));
                let lower = points.iter().rev().map(|&(x, low, _)| frame.at((x, low)));
                canvas.area(upper.chain(lower).collect(), *colour);
            }
            Mark::Bars {
                bars,
                width,
                colour,
            } => {
                for &(x, low, high) in bars {
                    canvas.line(&[low, high].map(|y| frame.at((x, y))), *width, *colour);
                }
            }
            Mark::Points {
                points,
                size,
                width,
                style,
            } => {
                for point in points {
                    if let Some((low, high)) = point.bar {
                        let ends = [low, high].map(|y| frame.at((point.x, y)));
                        canvas.line(&ends, *width, style.colour);
                    }
                    let marker = point.arrow.unwrap_or(style.marker);
                    canvas.marker(marker, frame.at((point.x, point.y)), *size, style.colour);
                }
            }
            Mark::Span { from, to, colour } => {
                let corner = (frame.x(*from), frame.top);
                canvas.rectangle(corner, (frame.x(*to), frame.bottom), *colour);
            }
            Mark::Names { names, above } => draw_names(canvas, &frame, names, frame.top - above),
            Mark::Level { y, dash } => {
                let y = frame.y(*y);
                canvas.dashed(&[(frame.left, y), (frame.right, y)], 0.8, GRAY, dash);
            }
            Mark::Limit { x } => self.draw_limit(frame.x(*x)),
            Mark::Bracket { from, to, name } => {
                draw_bracket(canvas, &frame, (frame.x(*from), frame.x(*to)), name);
            }
            Mark::Bar {
                from,
                to,
                below,
                colour,
            } => {
                let y = frame.top + below;
                canvas.line(&[(frame.x(*from), y), (frame.x(*to), y)], 2.4, *colour);
            }
            Mark::Cells(cells) => {
                for Cell {
                    corner,
                    opposite,
                    colour,
                } in cells
                {
                    canvas.rectangle(frame.at(*corner), frame.at(*opposite), *colour);
                }
            }
            Mark::Shades { title, shades } => draw_shades(canvas, &frame, title, shades),
            Mark::Block {
                from,
                to,
                is_cut,
                colour,
                lines,
            } => {
                let ends = (frame.x(*from), frame.x(*to));
                draw_block(canvas, &frame, ends, *is_cut, *colour, lines);
            }
        }
    }

    /// From the top of the first panel to the bottom of the last.
    fn draw_limit(&mut self, x: f64) {
        let (first, last) = (self.frames[0], self.frames[self.frames.len() - 1]);
        let line = [(x, first.top), (x, last.bottom)];
        self.canvas.dashed(&line, 0.5, GRAY, &[2.0, 2.0]);
    }
}

/// An upright bar over the extremes of each column, its neighbour's end included, because the turns of a
/// thick line would reach beyond its points.
fn draw_dense(canvas: &mut Canvas, line: &[(f64, f64)], colour: Colour) {
    let column = |place: &(f64, f64)| (place.0 / COLUMN).floor();
    let mut before: Option<f64> = None;
    for places in line.chunk_by(|a, b| column(a) == column(b)) {
        let (top, bottom) = super::ends(places.iter().map(|place| place.1).chain(before));
        let x = (column(&places[0]) + 0.5) * COLUMN;
        canvas.line(&[(x, top - 0.2), (x, bottom + 0.2)], COLUMN, colour);
        before = places.last().map(|place| place.1);
    }
}

fn draw_names(canvas: &mut Canvas, frame: &Frame, names: &[(f64, f64, String)], baseline: f64) {
    let mut taken = 0.0;
    for (from, to, name) in names {
        let (left, right) = (frame.x(*from), frame.x(*to));
        let (middle, half) = (f64::midpoint(left, right), text_width(name, SMALL) / 2.0);
        if middle - half > taken && middle + half < WIDTH {
            canvas.text(name, (middle, baseline), SMALL, Align::Centre);
            taken = middle + half + 4.0;
        }
    }
}

fn draw_bracket(canvas: &mut Canvas, frame: &Frame, (from, to): (f64, f64), name: &str) {
    let (left, right, y) = (from + 0.7, to - 0.7, frame.top - 5.0);
    let bracket = [(left, y + 4.0), (left, y), (right, y), (right, y + 4.0)];
    canvas.line(&bracket, 0.8, Colour::BLACK);
    let above = (f64::midpoint(left, right), y - 3.0);
    canvas.text(name, above, SMALL, Align::Centre);
}

fn draw_shades(canvas: &mut Canvas, frame: &Frame, title: &str, shades: &[(Colour, String)]) {
    let (left, top) = (frame.right + 12.0, frame.top + 16.0);
    canvas.text(title, (left, top - 8.0), SMALL, Align::Left);
    for (row, (colour, label)) in shades.iter().enumerate() {
        let y = top + 14.0 * row as f64;
        let (corner, opposite) = ((left, y), (left + 14.0, y + 10.0));
        canvas.rectangle(corner, opposite, *colour);
        canvas.outline(corner, opposite, 0.4, Colour::BLACK.faded(0.5));
        canvas.text(label, (left + 20.0, y + 8.0), SMALL, Align::Left);
    }
}

fn draw_block(
    canvas: &mut Canvas,
    frame: &Frame,
    (left, right): (f64, f64),
    is_cut: bool,
    colour: Option<Colour>,
    lines: &[String],
) {
    let (top, bottom) = (frame.y(0.86), frame.y(0.14));
    if let Some(colour) = colour {
        canvas.rectangle((left, top), (right, bottom), colour.faded(0.28));
        canvas.outline((left, top), (right, bottom), 0.8, colour);
    }
    if is_cut {
        canvas.text("…", (left + 9.0, top + 15.0), NORMAL, Align::Centre);
    }
    let fits = |text: &&String| text_width(text, SMALL) < right - left;
    for (line, text) in (0..).zip(lines.iter().filter(fits)) {
        let at = (
            f64::midpoint(left, right),
            top + 15.0 + 13.0 * f64::from(line),
        );
        let size = if line == 0 { NORMAL } else { SMALL };
        canvas.text(text, at, size, Align::Centre);
    }
}

impl Canvas {
    /// Refuses a text that runs over an edge of the sheet.
    fn check(&self) -> Result<(), LayoutError> {
        for shape in &self.shapes {
            if let Shape::Text {
                text,
                at,
                height,
                is_upright,
            } = shape
            {
                let (x, y) = *at;
                // From the ascender to the descender of a text whose position lies half a height above its
                // baseline.
                let (along, across) = (font_width(text, *height), (-0.15 * height, 0.7 * height));
                let ((left, right), (top, bottom)) = match is_upright {
                    true => ((x + across.0, x + across.1), (y - along, y)),
                    false => ((x, x + along), (y + across.0, y + across.1)),
                };
                if left < 0.0 || top < 0.0 || right > self.size.0 || bottom > self.size.1 {
                    let text = text.chars().take(60).collect();
                    return Err(LayoutError::Clipped { text });
                }
            }
        }
        Ok(())
    }
}
