//! Rides before the monitor: outcomes against the axis, one panel under the other; of a trade-off, the time
//! between false motions against the delay.

mod words;

use super::FigureError;
use super::frame::{Frame, Scale, WIDTH};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::panel::{Bound, Curve, Manner, Panel, Point};
use super::ruler::{around, is_long};
use super::sheet::{Picture, Sheet};
use super::text::literal;
use crate::config::{Measure, RideStudy};
use crate::exhibit::ride::Row;
use crate::results::Manifest;
use plotters::prelude::DrawingBackend;
use words::{axis_label, caption};

const TOP: f64 = 10.0;

/// What a panel shows.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    outcome: &'static str,
    label: &'static str,
    kind: Kind,
    height: f64,
}

/// How it is drawn.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// A probability with its interval.
    Share,
    /// The median of a delay, from its 5 % to its 95 % quantile.
    Delay,
    /// A positive number on a logarithmic scale, with the limit that stands for it where nothing was
    /// counted.
    Positive(Bound),
}

const fn share(outcome: &'static str, label: &'static str, height: f64) -> Shown {
    Shown {
        outcome,
        label,
        kind: Kind::Share,
        height,
    }
}

const fn delay(outcome: &'static str, label: &'static str) -> Shown {
    Shown {
        outcome,
        label,
        kind: Kind::Delay,
        height: 105.0,
    }
}

const fn positive(outcome: &'static str, label: &'static str, bound: Bound) -> Shown {
    Shown {
        outcome,
        label,
        kind: Kind::Positive(bound),
        height: 210.0,
    }
}

/// From the top.
fn shown(measure: Measure) -> &'static [Shown] {
    const RIDES: &[Shown] = &[
        share("found", "P(every trip is found)", 130.0),
        delay("start_delay", "start to H_1*, s"),
    ];
    const REST: &[Shown] = &[positive(
        "false_motions",
        "false motions per hour of rest",
        Bound::Upper,
    )];
    const TRADEOFF: &[Shown] = &[positive(
        "hours_between",
        "hours of rest between false motions",
        Bound::Lower,
    )];
    const JAM: &[Shown] = &[
        share("alarmed", "P(a jam alarms)", 130.0),
        delay("alarm_delay", "jam to alarm, s"),
    ];
    const SWITCHED_ON: &[Shown] = &[
        share("misled", "P(says rest in motion)", 115.0),
        share("knew", "P(knows it stands at last)", 115.0),
    ];
    match measure {
        Measure::Rides => RIDES,
        Measure::Rest => REST,
        Measure::Tradeoff => TRADEOFF,
        Measure::Jam => JAM,
        Measure::SwitchedOn => SWITCHED_ON,
    }
}

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
        let entry = |(index, curve): (usize, &crate::config::RideCurve)| Entry {
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

/// Where rows stand.
struct Places<'a> {
    study: &'a RideStudy,
    rows: &'a [Row],
    is_logarithmic: bool,
}

impl<'a> Places<'a> {
    fn new(study: &'a RideStudy, rows: &'a [Row]) -> Self {
        let values: Vec<f64> = rows.iter().map(|row| row.x).collect();
        Self {
            study,
            rows,
            is_logarithmic: study.measure != Measure::Tradeoff && is_long(&values),
        }
    }

    /// The rows of an outcome, in the order of the axis.
    fn of(&self, curve: usize, outcome: &str) -> Vec<&'a Row> {
        let rows = self.rows.iter();
        rows.filter(|row| row.curve == curve + 1 && row.outcome == outcome)
            .collect()
    }

    /// Those of a curve that lie on the paper.
    fn points(&self, shown: &Shown, curve: usize) -> Vec<Point> {
        let of = |outcome: &str| self.of(curve, outcome);
        let points: Vec<Point> = match shown.kind {
            Kind::Delay => {
                let [low, middle, high] =
                    ["05", "50", "95"].map(|q| of(&format!("{}_{q}", shown.outcome)));
                let rows = middle.iter().zip(low.iter().zip(high));
                rows.map(|(row, (low, high))| Point {
                    x: self.x(row),
                    rate: row.estimate,
                    low: low.estimate,
                    high: high.estimate,
                    bound: None,
                })
                .collect()
            }
            Kind::Share | Kind::Positive(_) => {
                let places: Vec<f64> = match self.study.measure {
                    Measure::Tradeoff => of("start_delay_50")
                        .iter()
                        .map(|row| row.estimate)
                        .collect(),
                    _ => of(shown.outcome).iter().map(|row| self.x(row)).collect(),
                };
                let rows = of(shown.outcome).into_iter().zip(places);
                rows.map(|(row, x)| point(row, x, shown.kind)).collect()
            }
        };
        let is_there = |point: &Point| point.x.is_finite() && point.rate.is_finite();
        points.into_iter().filter(is_there).collect()
    }

    fn x(&self, row: &Row) -> f64 {
        match self.is_logarithmic {
            true => libm::log10(row.x),
            false => row.x,
        }
    }

    fn scale(&self, panels: &[Panel]) -> Scale {
        let curves = panels.iter().flat_map(|panel| &panel.curves);
        let drawn: Vec<f64> = curves
            .flat_map(|curve| curve.points.iter().map(|p| p.x))
            .collect();
        match drawn.is_empty() {
            true => Scale::single(0.0),
            false => around(&drawn, self.is_logarithmic),
        }
    }
}

fn point(row: &Row, x: f64, kind: Kind) -> Point {
    let mut point = Point {
        x,
        rate: row.estimate,
        low: row.low,
        high: row.high,
        bound: None,
    };
    if let Kind::Positive(bound) = kind {
        point.bound = (row.count == 0).then_some(bound);
        point.take_logarithms();
    }
    point
}

/// From 0 to 1 for a probability; around what there is otherwise.
fn scale(kind: Kind, panel: &Panel) -> Scale {
    let points = || panel.curves.iter().flat_map(|curve| &curve.points);
    let largest = |values: &mut dyn Iterator<Item = f64>| {
        values
            .filter(|value| value.is_finite())
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let rates = || points().map(|point| point.rate);
    match kind {
        _ if points().next().is_none() => Scale::linear(0.0, 1.0, 5),
        Kind::Share => Scale {
            from: -0.03,
            to: 1.03,
            ..Scale::linear(0.0, 1.0, 5)
        },
        Kind::Delay => {
            let top = largest(&mut points().map(|point| point.high)).max(largest(&mut rates()));
            Scale::linear(0.0, 1.08 * top, 5)
        }
        Kind::Positive(_) => {
            let bottom = -largest(&mut rates().map(|rate| -rate));
            Scale::decades(bottom - 0.35, largest(&mut rates()) + 0.35)
        }
    }
}
