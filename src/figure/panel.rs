//! One panel of a sweep's picture: curves with their bands, or bars side by side at names.

use super::FigureError;
use super::frame::{Frame, Scale};
use super::look::Look;
use super::sheet::Sheet;
use plotters::prelude::{Color, DrawingBackend};

const LINE: f64 = 1.1;
const MARKER: f64 = 2.3;

/// Curves that share a frame.
pub(super) struct Panel {
    /// Above the frame; empty for a picture of one panel.
    pub title: String,
    pub curves: Vec<Curve>,
}

/// What is drawn in one look.
pub(super) struct Curve {
    pub look: Look,
    pub points: Vec<Point>,
}

/// A rate and its interval, at a place on the axis; on a logarithmic scale, their logarithms.
#[derive(Clone, Copy)]
pub(super) struct Point {
    pub x: f64,
    pub rate: f64,
    pub low: f64,
    pub high: f64,
    /// Nothing was counted: on a logarithmic scale this limit is drawn.
    pub bound: Option<Bound>,
}

/// A limit that stands for a point, with an arrow to where the truth lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bound {
    Upper,
    Lower,
}

/// A point where it is drawn, beside those of other curves at the same name.
struct Mark<'a> {
    look: Look,
    x: f64,
    point: &'a Point,
}

/// How rates are drawn, the same in every panel.
#[derive(Clone, Copy)]
pub(super) struct Manner {
    /// The axis holds names, with curves side by side at each.
    pub is_named: bool,
    pub is_logarithmic: bool,
    /// Lines lead through limits that stand for points.
    pub joins_bounds: bool,
    /// The level that false-alarm rates are held against.
    pub nominal: Option<f64>,
}

impl Point {
    /// A rate of zero has no logarithm: a limit stands for it.
    pub fn take_logarithms(&mut self) {
        self.rate = libm::log10(self.shown());
        self.low = libm::log10(self.low.max(f64::MIN_POSITIVE));
        self.high = libm::log10(self.high);
    }

    /// What stands for it on a logarithmic scale.
    pub fn shown(&self) -> f64 {
        match self.bound {
            Some(Bound::Upper) => self.high,
            Some(Bound::Lower) => self.low,
            None => self.rate,
        }
    }
}

impl Panel {
    /// Where each curve stands beside the others at a name.
    fn aside(&self, index: usize, manner: Manner) -> f64 {
        let step = 0.11f64.min(0.8 / self.curves.len() as f64);
        match manner.is_named {
            true => step * (index as f64 - (self.curves.len() - 1) as f64 / 2.0),
            false => 0.0,
        }
    }

    /// Points on the sheet that a legend must not hide: bands and lines, finely.
    pub fn covered(&self, frame: &Frame, manner: Manner) -> Vec<(f64, f64)> {
        let mut covered = Vec::new();
        for (index, curve) in self.curves.iter().enumerate() {
            let aside = self.aside(index, manner);
            let ends = |p: &Point| {
                [p.low, p.rate, p.high].map(|y| within(frame, frame.at(p.x + aside, y)))
            };
            covered.extend(curve.points.iter().flat_map(ends));
            for pair in curve.points.windows(2).filter(|_| !manner.is_named) {
                for (a, b) in ends(&pair[0]).into_iter().zip(ends(&pair[1])) {
                    let share = (1..16).map(|i| f64::from(i) / 16.0);
                    covered.extend(share.map(|s| (a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1))));
                }
            }
        }
        covered
    }

    /// Everything inside the frame.
    pub fn draw<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
        manner: Manner,
    ) -> Result<(), FigureError> {
        frame.draw_grid(sheet)?;
        if let Some(nominal) = manner.nominal {
            frame.draw_level(sheet, nominal, &[])?;
        }
        match manner.is_named {
            false => self.draw_lines(sheet, frame, manner)?,
            true => self.draw_bars(sheet, frame, manner)?,
        }
        self.draw_markers(sheet, frame, manner)
    }

    fn draw_lines<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
        manner: Manner,
    ) -> Result<(), FigureError> {
        for Curve { points, look } in &self.curves {
            let joined = |point: &&Point| manner.joins_bounds || point.bound.is_none();
            let points: Vec<&Point> = points.iter().filter(joined).collect();
            let upper = points.iter().map(|p| frame.at(p.x, p.high));
            let lower = points.iter().rev().map(|p| frame.at(p.x, p.low));
            let band: Vec<_> = upper.chain(lower).map(|at| within(frame, at)).collect();
            sheet.area(&band, look.colour.mix(0.18))?;
            let line: Vec<_> = points.iter().map(|p| frame.at(p.x, p.rate)).collect();
            sheet.line(&line, LINE, look.colour.to_rgba())?;
        }
        Ok(())
    }

    /// Each interval as an upright bar.
    fn draw_bars<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
        manner: Manner,
    ) -> Result<(), FigureError> {
        // A bound is drawn as an arrow.
        let bars = self
            .marks(manner)
            .filter(|mark| !(mark.point.bound.is_some() && manner.is_logarithmic));
        for Mark { look, x, point } in bars {
            let ends = [point.low, point.high].map(|y| within(frame, frame.at(x, y)));
            sheet.line(&ends, LINE, look.colour.to_rgba())?;
        }
        Ok(())
    }

    fn draw_markers<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
        manner: Manner,
    ) -> Result<(), FigureError> {
        for Mark { look, x, point } in self.marks(manner) {
            let centre = frame.at(x, point.rate);
            match point.bound.filter(|_| manner.is_logarithmic) {
                Some(Bound::Upper) => sheet.arrow(centre, 3.0 * MARKER, look.colour)?,
                Some(Bound::Lower) => sheet.arrow(centre, -3.0 * MARKER, look.colour)?,
                None => sheet.marker(look.marker, centre, MARKER, look.colour)?,
            }
        }
        Ok(())
    }

    /// Every point of every curve.
    fn marks(&self, manner: Manner) -> impl Iterator<Item = Mark<'_>> {
        let curves = self.curves.iter().enumerate();
        curves.flat_map(move |(index, Curve { points, look })| {
            let aside = self.aside(index, manner);
            points.iter().map(move |point| Mark {
                look: *look,
                x: point.x + aside,
                point,
            })
        })
    }
}

/// From 0 to 1 for a power; for false-alarm rates around what there is of them.
pub(super) fn rate_scale(panels: &[Panel], is_false_alarm: bool, manner: Manner) -> Scale {
    let points = || {
        panels
            .iter()
            .flat_map(|panel| &panel.curves)
            .flat_map(|curve| &curve.points)
    };
    let lowest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::INFINITY, f64::min);
    let highest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::NEG_INFINITY, f64::max);
    let nominal = manner.nominal;
    match (is_false_alarm, manner.is_logarithmic) {
        (false, _) => Scale {
            to: 1.03,
            ..Scale::linear(0.0, 1.0, 5)
        },
        (true, true) => {
            let rates = || points().map(|p| p.rate).chain(nominal);
            let (bottom, top) = (lowest(&mut rates()), highest(&mut rates()));
            Scale::decades(bottom - 0.25, (top + 0.15).min(0.08))
        }
        (true, false) => {
            let bottom = lowest(&mut points().map(|p| p.low).chain(nominal));
            let top = highest(&mut points().map(|p| p.high).chain(nominal));
            let room = (top - bottom).max(1e-9);
            // Room above for the legend.
            Scale::linear((bottom - 0.1 * room).max(0.0), top + 0.8 * room, 6)
        }
    }
}

/// The nearest point inside the frame: an interval may leave it downwards.
fn within(frame: &Frame, (x, y): (f64, f64)) -> (f64, f64) {
    (x, y.clamp(frame.top, frame.bottom))
}
