//! Curves of one's own over a picture: a table with the columns x, y and name, and panel where there are several.

use super::legend::{Entry, Key, Legend, Place};
use super::mark::Mark;
use super::picture::{Panel, Plot};
use super::style::{Colour, Style};
use super::window::inside;
use serde::Deserialize;
use std::collections::BTreeSet;

/// Curves as their table gives them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    curves: Vec<OwnCurve>,
}

#[derive(Clone, Debug, PartialEq)]
struct OwnCurve {
    name: String,
    /// Counted from 1.
    panel: usize,
    /// In data, each with its line in the file.
    points: Vec<(u64, f64, f64)>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    x: f64,
    y: f64,
    #[serde(default)]
    name: String,
    #[serde(default)]
    panel: Option<usize>,
}

/// Why a table is no overlay, or does not fit a picture.
#[derive(Debug, thiserror::Error)]
pub enum OverlayError {
    #[error(
        "overlay: {0} (write the columns x, y and name, and panel if the picture has several, with commas between them)"
    )]
    Table(#[from] csv::Error),
    #[error("overlay: holds no point (write the columns x, y and name)")]
    Empty,
    #[error("overlay: must have at most {most} names, which dashes tell apart, got {0} (draw fewer at once)", most = DASHES.len())]
    Many(usize),
    #[error("overlay: line {line}: panel must be 1 to {panels}, got {panel}")]
    NoPanel {
        line: u64,
        panels: usize,
        panel: usize,
    },
    #[error("overlay: line {line}: {column} must {rule}, got {got}")]
    NoPlace {
        line: u64,
        column: &'static str,
        rule: &'static str,
        got: f64,
    },
    #[error("overlay: panel {0} has names along an axis, and no numbers (choose another panel)")]
    Names(usize),
}

/// What tells curves of one's own apart.
const DASHES: [&[f64]; 4] = [&[5.0, 2.0], &[1.5, 1.5], &[6.0, 1.5, 1.5, 1.5], &[]];

impl Overlay {
    /// Reads a table. Rows of one name and panel are a curve, in their order.
    ///
    /// # Errors
    /// If it is not a table of these columns, or empty.
    pub fn parse(text: &str) -> Result<Self, OverlayError> {
        let mut curves: Vec<OwnCurve> = Vec::new();
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
        let header = reader.headers()?.clone();
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record)? {
            let mut row: Row = record.deserialize(Some(&header))?;
            row.name = row.name.split_whitespace().collect::<Vec<_>>().join(" ");
            let line = record.position().map_or(0, csv::Position::line);
            let (panel, point) = (row.panel.unwrap_or(1), (line, row.x, row.y));
            let known = |curve: &&mut OwnCurve| curve.name == row.name && curve.panel == panel;
            match curves.iter_mut().find(known) {
                Some(curve) => curve.points.push(point),
                None => curves.push(OwnCurve {
                    name: row.name,
                    panel,
                    points: vec![point],
                }),
            }
        }
        let names: BTreeSet<&str> = curves.iter().map(|curve| &curve.name[..]).collect();
        match names.len() {
            0 => Err(OverlayError::Empty),
            many if many > DASHES.len() => Err(OverlayError::Many(many)),
            _ => Ok(Self { curves }),
        }
    }
}

impl OwnCurve {
    /// Where its points stand in a panel of `plot`.
    fn places(&self, plot: &Plot) -> Result<Vec<(f64, f64)>, OverlayError> {
        let panels = plot.panels.len();
        let panel = self.panel.checked_sub(1).and_then(|at| plot.panels.get(at));
        let panel = panel.ok_or(OverlayError::NoPanel {
            line: self.points[0].0,
            panels,
            panel: self.panel,
        })?;
        let scales = panel.x.scale.zip(panel.y.scale);
        let (x, y) = scales.ok_or(OverlayError::Names(self.panel))?;
        let place = |line, column, scale: super::Scale, got| {
            let place = scale.place(got);
            let rule = scale.rule();
            place
                .is_finite()
                .then_some(place)
                .ok_or(OverlayError::NoPlace {
                    line,
                    column,
                    rule,
                    got,
                })
        };
        (self.points.iter())
            .map(|&(line, at, value)| Ok((place(line, "x", x, at)?, place(line, "y", y, value)?)))
            .collect()
    }
}

impl Plot {
    /// Draws curves of one's own over all others, as far as they lie within the axes; how many points do not.
    ///
    /// # Errors
    /// If there is no such panel, or a point has no place on its axes.
    pub(super) fn overlay(&mut self, overlay: &Overlay) -> Result<usize, OverlayError> {
        let mut outside = 0;
        let mut names: Vec<&str> = Vec::new();
        for curve in &overlay.curves {
            let number = match names.iter().position(|name| *name == curve.name) {
                Some(known) => known,
                None => {
                    names.push(&curve.name);
                    names.len() - 1
                }
            };
            let (places, panel) = (curve.places(self)?, curve.panel - 1);
            let Panel { x, y, .. } = &self.panels[panel];
            outside += places.iter().filter(|place| !inside(x, y, **place)).count();
            for line in Mark::Line(places, style(number)).cut(x, y) {
                self.marks.push((panel, line));
            }
        }
        let named = names
            .iter()
            .enumerate()
            .filter(|(_, name)| !name.is_empty());
        let entries =
            named.map(|(number, name)| Entry::new(super::literal(name), style(number), Key::Line));
        let entries: Vec<Entry> = entries.collect();
        match &mut self.legend {
            Some(Legend { entries: known, .. }) => known.extend(entries),
            None if !entries.is_empty() => self.add_legend(entries, Place::Free),
            None => {}
        }
        Ok(outside)
    }
}

fn style(number: usize) -> Style {
    let dash = DASHES[number % DASHES.len()];
    Style::of(0).coloured(Colour::BLACK).dashed(dash)
}
