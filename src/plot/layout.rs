//! Puts a plot on a sheet: where each panel and the legend lie. `draw` fills them.

use super::canvas::{Align, Canvas, Shape, Text};
use super::frame::Frame;
use super::legend::Place;
use super::mark::Mark;
use super::picture::{CAPTION_LEFT, Panel, Plot};
use super::placed::Placed;
use super::text::{CAPTION, LINE, font_width};

/// From one line of a caption to the next.
const CAPTION_STEP: f64 = 10.5;
/// Between panels one under the other: where they share what is along x, and where words stand between them.
const BETWEEN: [f64; 2] = [10.0, 36.0];
/// Between panels side by side.
const BESIDE: f64 = 22.0;
/// The highest sheet that is drawn: its raster takes 400 MB.
const HIGHEST: f64 = 2200.0;
/// The height of a row of panels in a grid, and the most that stands above and below all of them.
const ROW: f64 = 150.0;
const AROUND_ROWS: f64 = 250.0;

/// Why a plot does not fit on a sheet.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LayoutError {
    #[error("figure: at most {most} panels can be drawn, got {panels} (draw fewer)")]
    Panels { panels: usize, most: usize },
    #[error(
        "figure: the sheet must be at most {HIGHEST} points high, got {0:.0} (draw fewer curves)"
    )]
    Height(f64),
    #[error("figure: \"{0}\" runs over the edge of the sheet (shorten it, or draw it wider)")]
    Clipped(String),
}

/// Refuses more panels, in rows of two, than can be drawn.
pub(super) fn check_panels(panels: usize) -> Result<(), LayoutError> {
    let most = 2 * ((HIGHEST - AROUND_ROWS) / ROW) as usize;
    if panels > most {
        return Err(LayoutError::Panels { panels, most });
    }
    Ok(())
}

/// Draws a plot on a sheet.
///
/// # Errors
/// Where it does not fit.
pub fn layout(plot: &Plot) -> Result<Canvas, LayoutError> {
    check_panels(plot.panels.len())?;
    let (legend, above) = plot.placed_legend();
    let frames = plot.frames(above);
    let bottom = frames[frames.len() - 1].bottom;
    let caption = plot.caption_lines();
    let last = &frames[frames.len() - 1];
    let words = bottom + last.panel.lines_below(last.right - last.left);
    let height = words + plot.margins.bottom + CAPTION_STEP * caption.len() as f64;
    if height > HIGHEST {
        return Err(LayoutError::Height(height));
    }
    let mut canvas = Canvas::new((plot.width, height));
    for (panel, mark) in &plot.marks {
        match (mark, &legend) {
            (Mark::Legend, Some(legend)) => legend.draw(&mut canvas),
            _ => mark.draw(&mut canvas, *panel, &frames),
        }
    }
    for (line, text) in (0..).zip(&caption) {
        let baseline = words + 41.0 + CAPTION_STEP * f64::from(line);
        canvas.text(text, (CAPTION_LEFT, baseline), CAPTION, Align::Left);
    }
    canvas.check()?;
    Ok(canvas)
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
        let width = self.width - self.margins.left - self.margins.right;
        let width = (width - BESIDE * (columns - 1.0)) / columns;
        let left = self.margins.left + (index % self.columns) as f64 * (width + BESIDE);
        let has_words = |panel: &Panel| self.is_apart || !panel.x.label.is_empty();
        let between =
            |panel: &Panel| BETWEEN[usize::from(has_words(panel))] + panel.lines_below(width);
        let over = self
            .panels
            .iter()
            .step_by(self.columns)
            .take(index / self.columns);
        let top = above + self.margins.top;
        let top = over.fold(top, |top, panel| {
            top + panel.lines_above() + panel.height + between(panel)
        });
        let panel = &self.panels[index.min(self.panels.len() - 1)];
        let top = top + panel.lines_above();
        let (right, bottom) = (left + width, top + panel.height);
        Frame {
            panel,
            sheet: self.width,
            left,
            right,
            top,
            bottom,
        }
    }

    /// The legend in its place, and the height it takes above the panels.
    pub(super) fn placed_legend(&self) -> (Option<Placed<'_>>, f64) {
        let Some(legend) = &self.legend else {
            return (None, 0.0);
        };
        let column = Placed::new(legend);
        let (left, right) = match legend.place {
            Place::Across => (CAPTION_LEFT, CAPTION_LEFT),
            _ => (self.margins.left, self.margins.right),
        };
        let spread = column.spread(self.width - left - right);
        let inside = match legend.place {
            Place::Free => self.in_free_place(column).or(self.in_free_place(spread)),
            Place::Inside(left, down) => {
                let frame = self.frame(0, 0.0);
                let placed = column.at((frame.right - left, frame.top + down));
                (!placed.covers(&self.covered(0, &frame))).then_some(placed)
            }
            Place::Corner { is_right, is_low } => {
                Some(column.at(column.corner_of(&self.frame(0, 0.0), is_right, is_low)))
            }
            Place::Above | Place::Across => None,
        };
        let (over, under) = self.margins.legend;
        match inside {
            Some(placed) => (Some(placed), 0.0),
            None => (Some(spread.at((left, over))), spread.height() + under),
        }
    }

    /// In a corner of a panel, or in the last row of a grid, where its last place is free.
    fn in_free_place<'a>(&'a self, legend: Placed<'a>) -> Option<Placed<'a>> {
        if self.columns == 1 {
            return (self.frames(0.0).iter().enumerate())
                .find_map(|(index, frame)| legend.in_corner(frame, &self.covered(index, frame)));
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
        for line in self.marks_of(panel).flat_map(Mark::extent) {
            let line = frame.all(&line);
            covered.extend(&line);
            for (a, b) in line.iter().zip(line.iter().skip(1)) {
                let share = (1..16).map(|i| f64::from(i) / 16.0);
                covered.extend(share.map(|s| (a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1))));
            }
        }
        covered
    }
}

impl Panel {
    /// What the second and later lines of its words take above it, and below it.
    fn lines_above(&self) -> f64 {
        let over = self.top.as_ref().map_or("", |top| &top.label);
        LINE * (self.title.matches('\n').count() + over.matches('\n').count()) as f64
    }

    fn lines_below(&self, width: f64) -> f64 {
        LINE * (self.x.label.matches('\n').count() + self.lines_of_names(width) - 1) as f64
    }
}

impl Mark {
    /// The lines, in data, that a legend must not hide.
    fn extent(&self) -> Vec<Vec<(f64, f64)>> {
        match self {
            Self::Line(points, _) => vec![points.clone()],
            Self::Dense(points, _) => points.iter().map(|&place| vec![place]).collect(),
            Self::Band(points, _) => vec![
                points.iter().map(|p| (p.x, p.low)).collect(),
                points.iter().map(|p| (p.x, p.high)).collect(),
            ],
            Self::Bars(points, _) | Self::Points(points, _) => (points.iter())
                .map(|p| vec![(p.x, p.low), p.place(), (p.x, p.high)])
                .collect(),
            Self::Markers(points, _) => points.iter().map(|p| vec![p.place()]).collect(),
            _ => Vec::new(),
        }
    }
}

impl Canvas {
    /// Refuses a text that runs over an edge of the sheet.
    fn check(&self) -> Result<(), LayoutError> {
        for shape in &self.shapes {
            if let Shape::Text(text) = shape {
                let ((left, top), (right, bottom)) = text.corners();
                if left < 0.0 || top < 0.0 || right > self.size.0 || bottom > self.size.1 {
                    return Err(LayoutError::Clipped(text.text.chars().take(60).collect()));
                }
            }
        }
        Ok(())
    }
}

impl Text {
    /// From the ascender to the descender.
    fn corners(&self) -> ((f64, f64), (f64, f64)) {
        let (x, y) = self.at;
        let (along, over, under) = (
            font_width(&self.text, self.height),
            0.15 * self.height,
            0.7 * self.height,
        );
        if self.is_upright {
            ((x - over, y - along), (x + under, y))
        } else {
            ((x, y - over), (x + along, y + under))
        }
    }
}
