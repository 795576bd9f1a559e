//! Rides before the monitor: outcomes against the axis, one panel under the other; of a trade-off, the time
//! between false motions against the delay.

mod places;
mod shown;
mod words;

use super::FigureError;
use super::frame::{Frame, Scale, WIDTH};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::panel::{Curve, Manner, Panel};
use super::sheet::{Picture, Sheet};
use super::text::literal;
use crate::config::{RideCurve, RideStudy};
use crate::results::Manifest;
use crate::study::rows::Ride as Row;
use places::{Places, scale};
use plotters::prelude::DrawingBackend;
use shown::{Kind, Shown, shown};
use words::{axis_label, caption};

const TOP: f64 = 10.0;

/// The picture of a study.
pub(super) struct Rides {
    shown: &'static [Shown],
    panels: Vec<Panel>,
    scales: Vec<Scale>,
    x: Scale,
    x_label: String,
    legend: Legend,
    caption: Vec<String>,
}

impl Rides {
    pub fn new(study: &RideStudy, rows: &[Row], manifest: &Manifest) -> Self {
        let shown = shown(study.measure);
        let places = Places::new(study, rows);
        let panel = |shown: &Shown| {
            let curve = |index: usize| Curve {
                look: Look::of(index),
                points: places.points(shown, index),
            };
            Panel {
                title: String::new(),
                curves: (0..study.curves.len()).map(curve).collect(),
            }
        };
        let panels: Vec<Panel> = shown.iter().map(panel).collect();
        let entry = |(index, curve): (usize, &RideCurve)| Entry {
            text: literal(&curve.label),
            look: Look::of(index),
            key: Key::MarkedLine,
        };
        let legend = Legend::new(study.curves.iter().enumerate().map(entry).collect());
        let picture = Self {
            scales: (shown.iter().zip(&panels))
                .map(|(shown, panel)| scale(shown.kind, panel))
                .collect(),
            x: places.scale(&panels),
            x_label: axis_label(study),
            caption: caption(study, rows, manifest),
            shown,
            panels,
            legend,
        };
        match picture.place() {
            Some(_) => picture,
            None => {
                let legend = picture.legend.spread(WIDTH - 70.0);
                Self { legend, ..picture }
            }
        }
    }

    /// The panels, the first at `top`.
    fn frames(&self, top: f64) -> Vec<Frame> {
        let panel = |index: usize| (self.shown[index].height, self.scales[index].clone());
        match self.shown.len() {
            1 => Frame::stack(top, [panel(0)], &self.x).into(),
            _ => Frame::stack(top, [panel(0), panel(1)], &self.x).into(),
        }
    }

    fn manner(&self, index: usize) -> Manner {
        Manner {
            is_named: false,
            is_logarithmic: matches!(self.shown[index].kind, Kind::Positive(_)),
            joins_bounds: false,
            nominal: None,
        }
    }

    /// A corner of a panel where the legend covers nothing.
    fn place(&self) -> Option<(f64, f64)> {
        let frames = self.frames(TOP);
        (0..self.panels.len()).find_map(|index| {
            let covered = self.panels[index].covered(&frames[index], self.manner(index));
            self.legend.free_corner(&frames[index], &covered)
        })
    }

    /// One curve without a name of its own needs no legend.
    fn has_legend(&self) -> bool {
        self.legend.entries.len() > 1 || self.legend.entries[0].text != "1"
    }

    fn top(&self) -> f64 {
        match self.has_legend() && self.place().is_none() {
            true => TOP + self.legend.height() + 6.0,
            false => TOP,
        }
    }
}

impl Picture for Rides {
    fn size(&self) -> (f64, f64) {
        let frames = self.frames(self.top());
        frames[frames.len() - 1].sheet_size(&self.caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        sheet.clear(self.size())?;
        let frames = self.frames(self.top());
        let last = frames.len() - 1;
        for (index, frame) in frames.iter().enumerate() {
            self.panels[index].draw(sheet, frame, self.manner(index))?;
            let x_label = if index == last { &self.x_label } else { "" };
            frame.draw_axes(sheet, x_label, self.shown[index].label)?;
        }
        if self.has_legend() {
            let above = (frames[0].left, TOP - 4.0);
            self.legend.draw(sheet, self.place().unwrap_or(above))?;
        }
        frames[last].draw_caption(sheet, &self.caption)
    }
}
