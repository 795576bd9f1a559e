//! Rates against the axis of a sweep: the power of each curve, or, where nothing moves, its
//! false-alarm rate; in one panel, or in as many as the curves name.

use super::FigureError;
use super::frame::{CAPTION_LEFT, CAPTION_STEP, Frame, NORMAL, Scale, WIDTH, draw_caption};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::panel::{Bound, Curve, Manner, Panel, Point, rate_scale};
use super::ruler::{LONG_RANGE, Ruler};
use super::sheet::{Picture, Sheet};
use super::text::{Align, Style};
use super::words::{axis_label, caption, common_facts, is_held_against_alpha, legend};
use crate::config::{Config, Parameter};
use crate::results::{Manifest, Row};
use plotters::prelude::DrawingBackend;

/// One panel without legend above and caption below.
const HEIGHT: f64 = 262.0;
/// One of several, with its title.
const SMALL_HEIGHT: f64 = 150.0;
const LEFT: f64 = 54.0;
const RIGHT: f64 = WIDTH - 16.0;
/// For tick labels and the axis label under the lowest panel.
const BELOW: f64 = 40.0;
/// Between panels.
const APART: f64 = 22.0;

/// The picture of a sweep.
pub(super) struct Curves {
    panels: Vec<Panel>,
    legend: Legend,
    manner: Manner,
    axis: Parameter,
    x: Scale,
    y: Scale,
    is_whitened: bool,
    /// What a unit of Δ in the record becomes after whitening, where every curve agrees.
    whitened_unit: Option<f64>,
    is_false_alarm: bool,
    caption: Vec<String>,
}

impl Curves {
    pub fn new(config: &Config, rows: &[Row], manifest: &Manifest) -> Result<Self, FigureError> {
        let axis = config.axis.parameter;
        let drawn: Vec<Vec<&Row>> = (1..=config.curves.len())
            .map(|index| rows_of(rows, index))
            .collect();
        let all: Vec<&Row> = drawn.iter().flatten().copied().collect();
        if all.is_empty() {
            return Err(FigureError::Empty(axis.name()));
        }
        let common = common_facts(&all);
        let ruler = Ruler::new(config, &all);
        let key = match ruler.is_named() {
            true => Key::Marker,
            false => Key::MarkedLine,
        };
        let mut entries: Vec<Entry> = Vec::new();
        let mut panels: Vec<Panel> = Vec::new();
        for (curve, rows) in config.curves.iter().zip(&drawn) {
            if rows.is_empty() {
                continue;
            }
            let words = match &curve.series {
                Some(series) => series.clone(),
                None => legend(rows, &common, axis),
            };
            let known = entries.iter().find(|entry| entry.text == words);
            let look = known.map_or(Look::of(entries.len()), |entry| entry.look);
            if known.is_none() {
                entries.push(Entry {
                    text: words,
                    look,
                    key,
                });
            }
            let mut points: Vec<Point> = (0..rows.len())
                .map(|i| point(ruler.place(rows, i), rows[i]))
                .collect();
            points.sort_by(|a, b| a.x.total_cmp(&b.x));
            let title = curve.panel.clone().unwrap_or_default();
            let known = panels.iter().position(|panel| panel.title == title);
            let panel = known.unwrap_or_else(|| {
                panels.push(Panel {
                    title,
                    curves: Vec::new(),
                });
                panels.len() - 1
            });
            panels[panel].curves.push(Curve { look, points });
        }
        let is_false_alarm = all.iter().all(|row| row.is_at_rest());
        let is_logarithmic = is_false_alarm && spans_far(&panels);
        if is_logarithmic {
            points_of(&mut panels).for_each(Point::take_logarithms);
        }
        let nominal = is_held_against_alpha(&all).then_some(all[0].alpha);
        let manner = Manner {
            is_named: ruler.is_named(),
            is_logarithmic,
            joins_bounds: true,
            nominal: nominal.map(|alpha| match is_logarithmic {
                true => libm::log10(alpha),
                false => alpha,
            }),
        };
        let mut caption = caption(&all, common, axis, manifest, WIDTH - 2.0 * CAPTION_LEFT);
        if is_logarithmic && points_of(&mut panels).any(|point| point.bound.is_some()) {
            caption.push("arrows: upper limits where no trial gave a false alarm".to_owned());
        }
        let places: Vec<f64> = points_of(&mut panels).map(|point| point.x).collect();
        Ok(Self {
            x: ruler.scale(&places),
            y: rate_scale(&panels, is_false_alarm, manner),
            is_whitened: all.iter().all(|row| row.delta_at == "whitened"),
            whitened_unit: whitened_unit(config, &all)
                .filter(|_| panels.len() == 1 && !ruler.is_logarithmic()),
            legend: Legend::new(entries),
            is_false_alarm,
            manner,
            caption,
            panels,
            axis,
        }
        .with_legend_in_place())
    }

    /// Where there is no better place for it, the legend lies above the panels, as low as it can be.
    fn with_legend_in_place(self) -> Self {
        match self.place() {
            Some(_) => self,
            None => Self {
                legend: self.legend.spread(RIGHT - LEFT),
                ..self
            },
        }
    }

    /// Several panels stand two in a row.
    fn grid_rows(&self) -> usize {
        self.panels.len().div_ceil(2)
    }

    /// The frame of a panel, with `above` points left free over all of them.
    fn frame(&self, index: usize, above: f64) -> Frame {
        let (x, y) = (self.x.clone(), self.y.clone());
        if self.panels.len() == 1 {
            let over = if self.whitened_unit.is_some() {
                32.0
            } else {
                10.0
            };
            return Frame {
                left: LEFT,
                right: RIGHT,
                top: above + over,
                bottom: above + HEIGHT - BELOW,
                x,
                y,
            };
        }
        let width = (RIGHT - LEFT - APART) / 2.0;
        let left = LEFT + (index % 2) as f64 * (width + APART);
        let top = above + 22.0 + (index / 2) as f64 * SMALL_HEIGHT;
        Frame {
            left,
            right: left + width,
            top,
            bottom: top + SMALL_HEIGHT - 36.0,
            x: Scale {
                ticks: self.x.sparse_ticks(width),
                ..x
            },
            y,
        }
    }

    /// Where the legend goes: a corner of the one panel, the free place of the grid, or above.
    fn place(&self) -> Option<(f64, f64)> {
        if self.panels.len() == 1 {
            let frame = self.frame(0, 0.0);
            let covered = self.panels[0].covered(&frame, self.manner);
            return self.legend.free_corner(&frame, &covered);
        }
        let free = self.frame(self.panels.len(), 0.0);
        let is_free = self.panels.len() % 2 == 1 && self.legend.width() < free.right - free.left;
        is_free.then_some((free.left, free.top))
    }

    /// One curve without a name of its own needs no legend.
    fn has_legend(&self) -> bool {
        !(self.legend.entries.len() == 1 && self.legend.entries[0].text == "1")
    }

    /// What the legend takes above the panels, where there is no better place.
    fn above(&self) -> f64 {
        match self.has_legend() && self.place().is_none() {
            true => self.legend.height() + 8.0,
            false => 0.0,
        }
    }

    /// The lower end of the panels and what stands under them.
    fn bottom(&self) -> f64 {
        match self.panels.len() {
            1 => self.above() + HEIGHT,
            _ => self.above() + 26.0 + self.grid_rows() as f64 * SMALL_HEIGHT,
        }
    }

    fn draw_panel<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        index: usize,
    ) -> Result<(), FigureError> {
        let mut frame = self.frame(index, self.above());
        let panel = &self.panels[index];
        panel.draw(sheet, &frame, self.manner)?;
        let is_left = self.panels.len() == 1 || index.is_multiple_of(2);
        let is_lowest = index + 2 >= self.panels.len();
        let y_label = match (is_left, self.is_false_alarm) {
            (false, _) => "",
            (true, true) => "false-alarm rate",
            (true, false) => "D, probability of detection",
        };
        if !is_left {
            frame.y = frame.y.unlabelled();
        }
        let x_label = match is_lowest {
            true => axis_label(self.axis, self.is_whitened),
            false => "",
        };
        frame.draw_axes(sheet, x_label, y_label)?;
        let title = (f64::midpoint(frame.left, frame.right), frame.top - 5.0);
        sheet.text(&panel.title, title, Style::plain(NORMAL, Align::Centre))
    }
}

impl Picture for Curves {
    fn size(&self) -> (f64, f64) {
        let caption = CAPTION_STEP * self.caption.len() as f64;
        (WIDTH, self.bottom() + caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        sheet.clear(self.size())?;
        for index in 0..self.panels.len() {
            self.draw_panel(sheet, index)?;
        }
        if let Some(unit) = self.whitened_unit {
            let frame = self.frame(0, self.above());
            let scale = Scale::linear(frame.x.from * unit, frame.x.to * unit, 8);
            frame.draw_top(sheet, &scale, axis_label(Parameter::Delta, true))?;
        }
        if self.has_legend() {
            self.legend
                .draw(sheet, self.place().unwrap_or((LEFT, 4.0)))?;
        }
        draw_caption(sheet, &self.caption, self.bottom() + 1.0)
    }
}

fn points_of(panels: &mut [Panel]) -> impl Iterator<Item = &mut Point> {
    let curves = panels.iter_mut().flat_map(|panel| &mut panel.curves);
    curves.flat_map(|curve| &mut curve.points)
}

/// Whether the largest rate is so many times the smallest that a linear scale would hide it.
fn spans_far(panels: &[Panel]) -> bool {
    let curves = || panels.iter().flat_map(|panel| &panel.curves);
    let rates = || {
        let points = curves().flat_map(|curve| &curve.points);
        points.map(Point::shown)
    };
    let smallest = rates().fold(f64::INFINITY, f64::min);
    rates().fold(0.0, f64::max) >= LONG_RANGE * smallest
}

/// A row's rate and interval, from its counts.
fn point(x: f64, row: &Row) -> Point {
    let (low, high) = row.tally().interval(row.confidence);
    Point {
        x,
        rate: row.tally().rate(),
        low,
        high,
        bound: (row.detections == 0).then_some(Bound::Upper),
    }
}

/// The rows a curve is drawn from: those in motion, or at rest where nothing ever moves.
fn rows_of(rows: &[Row], curve: usize) -> Vec<&Row> {
    let of_curve = || rows.iter().filter(|row| row.curve == curve);
    let in_motion: Vec<&Row> = of_curve().filter(|row| !row.is_at_rest()).collect();
    match in_motion.is_empty() {
        true => of_curve().collect(),
        false => in_motion,
    }
}

/// 1 − β, where the axis is Δ in the record and every curve has the same sensor, undecimated.
fn whitened_unit(config: &Config, rows: &[&Row]) -> Option<f64> {
    let first = rows.first()?;
    let agrees =
        |row: &&Row| row.delta_at == "record" && row.sensor == first.sensor && row.decimation == 1;
    let scenario = config
        .scenario(first.curve - 1, config.axis.values.first()?)
        .ok()?;
    let is_delta = config.axis.parameter == Parameter::Delta;
    (is_delta && rows.iter().all(agrees)).then(|| scenario.sensor.step_gain())
}
