//! How a picture is to look: the keys of `[figure]`, and the flags of the same names. Counts are as they are.

use super::axis::ends;
use super::legend::{Key, Place};
use super::mark::{Mark, Point};
use super::overlay::{Overlay, OverlayError};
use super::picture::Plot;
use super::scale::Scale;
use super::style::{Colour, Style};
use super::text::{SMALL, text_width};
use super::window::WindowError;
use super::{LayoutError, layout};
use crate::rule::OutOfRange;
use crate::values::bounded_f64;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// How the figure of a study is drawn. What is left out is as the study draws it; nothing is simulated again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Width of the sheet, mm; 139.7 if it is left out. The layout changes, type does not shrink.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<Width>,
    /// Height of the sheet, mm; what its panels need if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<Height>,
    /// Dots per inch of a PNG; 300 if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dpi: Option<Dpi>,
    /// The kinds of files in the directory of results; png and svg if it is left out.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub format: Vec<Format>,
    /// The scale of y.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_scale: Option<Scale>,
    /// The ends of x. How many points lie outside is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_range: Option<[f64; 2]>,
    /// The ends of y. How many points lie outside is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_range: Option<[f64; 2]>,
    /// The colours of the curves, at most six.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 6))]
    pub colours: Vec<ColourName>,
    /// Whether points on lines have markers; they have if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub markers: Option<bool>,
    /// Where the legend stands; where it covers no data if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub legend: Option<LegendPlace>,
    /// Whether the caption is drawn; it is if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub caption: Option<bool>,
    /// A CSV file of curves of one's own: columns x, y and name, and panel where there are several. Its path
    /// counts from the config.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlay: Option<PathBuf>,
}

bounded_f64! {
    /// The width of a sheet, mm.
    Width: "lie in 60 to 300 mm", |x| (60.0..=300.0).contains(&x),
        { "type": "number", "minimum": 60, "maximum": 300 };
    /// The height of a sheet, mm.
    Height: "lie in 40 to 700 mm", |x| (40.0..=700.0).contains(&x),
        { "type": "number", "minimum": 40, "maximum": 700 };
    /// Dots per inch of a raster.
    Dpi: "be a whole number from 50 to 1200", |x| (50.0..=1200.0).contains(&x) && x.fract() == 0.0,
        { "type": "integer", "minimum": 50, "maximum": 1200 };
}

/// Points in a millimetre.
const POINTS: f64 = 72.0 / 25.4;

/// What the label of y and the gaps beside it take, left of the labels of its ticks.
const BESIDE_LABELS: f64 = 24.0;

/// The least height of a panel, points.
const LEAST_PANEL: f64 = 36.0;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    Png,
    Svg,
    Pdf,
}

impl Format {
    /// All kinds, by the ends of their names.
    pub const ALL: [(&'static str, Self); 3] =
        [("png", Self::Png), ("svg", Self::Svg), ("pdf", Self::Pdf)];
}

/// A colour that stays apart from the others for colour-blind readers, with a contrast of at least 3 on white.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ColourName {
    Blue,
    Vermilion,
    Green,
    Purple,
    Brown,
    Navy,
    Black,
}

impl ColourName {
    /// All of them; those of the curves, in their order, then black.
    pub const ALL: [(&'static str, Self); 7] = [
        ("blue", Self::Blue),
        ("vermilion", Self::Vermilion),
        ("green", Self::Green),
        ("purple", Self::Purple),
        ("brown", Self::Brown),
        ("navy", Self::Navy),
        ("black", Self::Black),
    ];

    fn colour(self) -> Colour {
        let at = Self::ALL.iter().position(|(_, name)| *name == self);
        match at {
            Some(at) if at < Style::COLOURS => Style::of(at).colour,
            _ => Colour::BLACK,
        }
    }
}

/// Where a legend stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LegendPlace {
    /// Where it covers no data.
    Best,
    Above,
    UpperLeft,
    UpperRight,
    LowerLeft,
    LowerRight,
    /// Nowhere.
    None,
}

impl LegendPlace {
    /// All places by name.
    pub const ALL: [(&'static str, Self); 7] = [
        ("best", Self::Best),
        ("above", Self::Above),
        ("upper-left", Self::UpperLeft),
        ("upper-right", Self::UpperRight),
        ("lower-left", Self::LowerLeft),
        ("lower-right", Self::LowerRight),
        ("none", Self::None),
    ];

    fn place(self) -> Option<Place> {
        let corner = |is_right, is_low| Some(Place::Corner { is_right, is_low });
        match self {
            Self::Best => Some(Place::Free),
            Self::Above => Some(Place::Above),
            Self::UpperLeft => corner(false, false),
            Self::UpperRight => corner(true, false),
            Self::LowerLeft => corner(false, true),
            Self::LowerRight => corner(true, true),
            Self::None => None,
        }
    }
}

/// Why a picture cannot look like that.
#[derive(Debug, thiserror::Error)]
pub enum OptionsError {
    #[error("figure: {0}")]
    Range(OutOfRange),
    #[error("figure.y_scale: means nothing to this picture, which has names along y (take it out)")]
    Names,
    #[error("figure.{0}")]
    Window(WindowError),
    #[error("figure.{0}")]
    Overlay(OverlayError),
    #[error(transparent)]
    Layout(#[from] LayoutError),
    #[error("figure.height: must be at least {least:.0} mm for these panels, got {got}")]
    Low { least: f64, got: f64 },
}

impl Options {
    /// Adds the kinds of files that a report shows, where others are asked for.
    pub fn keep_for_the_report(&mut self) {
        if !self.format.is_empty() {
            let shown = [Format::Png, Format::Svg].into_iter();
            let missing: Vec<_> = shown.filter(|kind| !self.format.contains(kind)).collect();
            self.format.extend(missing);
        }
    }

    /// Draws a plot that way, with curves of one's own. Returns what its reader must be told, too.
    ///
    /// # Errors
    /// If the plot has no such axis, range or panel, or does not fit.
    pub fn apply(
        &self,
        mut plot: Plot,
        overlay: Option<&Overlay>,
    ) -> Result<(Plot, Vec<String>), OptionsError> {
        let mut notes = Vec::new();
        if let Some(scale) = self.y_scale {
            let (before, had_limits) = (plot.estimates().count(), plot.has_limits());
            if !plot.rescale(scale) {
                return Err(OptionsError::Names);
            }
            if plot.has_limits() && !had_limits {
                let arrows = "arrows: limits where an estimate has no place on this scale";
                plot.caption.push(vec![arrows.to_owned()]);
            }
            let lost = before - plot.estimates().count();
            if lost > 0 {
                notes.push(format!("points without a place on this scale of y: {lost}"));
            }
        }
        if let Some(overlay) = overlay {
            let outside = plot.overlay(overlay).map_err(OptionsError::Overlay)?;
            if outside > 0 {
                notes.push(format!("points of the overlay outside the axes: {outside}"));
            }
        }
        if self.x_range.or(self.y_range).is_some() {
            let shown = plot.show(self.x_range, self.y_range);
            let cut = shown.map_err(OptionsError::Window)?;
            if cut > 0 {
                let points = if cut == 1 { "point lies" } else { "points lie" };
                let note = format!("{cut} {points} outside the ranges of the axes");
                plot.caption.push(vec![note.clone()]);
                notes.push(note);
            }
        }
        plot.make_room();
        let curves = plot.recolour(&self.colours);
        if !self.colours.is_empty() && self.colours.len() < curves {
            let names = self.colours.len();
            notes.push(format!(
                "{curves} curves share {names} colours (name as many)"
            ));
        }
        if self.markers == Some(false) {
            plot.drop_markers();
        }
        if self.caption == Some(false) {
            plot.caption.clear();
        }
        if let Some(place) = self.legend {
            plot.place_legend(place.place());
        }
        let width = self.width.map_or(plot.width, |width| width.get() * POINTS);
        plot = plot.resized(width);
        if let Some(height) = self.height {
            plot.stretch(height.get())?;
        }
        let missing = plot.missing_glyphs();
        if !missing.is_empty() {
            let named = missing
                .iter()
                .map(|c| format!("{c} (U+{:04X})", u32::from(*c)));
            let named: Vec<String> = named.collect();
            let note = "the font has no sign for";
            notes.push(format!("{note} {}: boxes stand for them", named.join(", ")));
        }
        Ok((plot, notes))
    }
}

impl Plot {
    /// What has a marker.
    fn estimates(&self) -> impl Iterator<Item = &Point> {
        self.marks.iter().flat_map(|(_, mark)| match mark {
            Mark::Markers(points, _) | Mark::Points(points, _) => &points[..],
            _ => &[],
        })
    }

    /// Whether there are arrows.
    pub fn has_limits(&self) -> bool {
        self.estimates().any(|point| point.limit.is_some())
    }

    /// Widens the margin at the left until the words along y have room.
    fn make_room(&mut self) {
        let labels = self.panels.iter().flat_map(|panel| &panel.y.ticks);
        let widest = labels
            .map(|(_, label)| text_width(label, SMALL))
            .fold(0.0, f64::max);
        self.margins.left = self.margins.left.max(widest + BESIDE_LABELS);
    }

    /// Gives the curves these colours in place of the usual ones, of which so many are in use.
    fn recolour(&mut self, names: &[ColourName]) -> usize {
        if names.is_empty() {
            return 0;
        }
        let mut used = 0;
        let usual: Vec<Colour> = (0..Style::COLOURS).map(|at| Style::of(at).colour).collect();
        let mut change = |colour: &mut Colour| {
            if let Some(at) = usual.iter().position(|usual| usual.rgb == colour.rgb) {
                used = used.max(at + 1);
                colour.rgb = names[at % names.len()].colour().rgb;
            }
        };
        for colour in self.marks.iter_mut().flat_map(|(_, mark)| mark.colours()) {
            change(colour);
        }
        let entries = self.legend.iter_mut().flat_map(|it| &mut it.entries);
        entries.for_each(|entry| change(&mut entry.style.colour));
        used
    }

    /// Leaves out the markers through which a line of their curve runs; limits and single points stay.
    fn drop_markers(&mut self) {
        let lines = self.marks.iter().filter_map(|(panel, mark)| match mark {
            Mark::Line(points, style) if points.len() > 1 => {
                let span = ends(points.iter().map(|point| point.0));
                Some(((*panel, style.colour.rgb), span))
            }
            _ => None,
        });
        let lines: Vec<_> = lines.collect();
        for (panel, mark) in &mut self.marks {
            if let Mark::Markers(points, style) = mark {
                let curve = (*panel, style.colour.rgb);
                let is_on_line = |x: f64| {
                    let mut spans = lines.iter().filter(|line| line.0 == curve);
                    spans.any(|(_, (from, to))| (*from..=*to).contains(&x))
                };
                points.retain(|point| point.limit.is_some() || !is_on_line(point.x));
            }
        }
        let entries = self.legend.iter_mut().flat_map(|it| &mut it.entries);
        for entry in entries.filter(|entry| entry.key == Key::MarkedLine) {
            (entry.key, entry.style) = (Key::Line, entry.style.solid());
        }
    }

    /// Moves the legend, or takes it out.
    fn place_legend(&mut self, place: Option<Place>) {
        match (place, &mut self.legend) {
            (Some(place), Some(legend)) => legend.place = place,
            (Some(_), None) => {}
            (None, _) => self.legend = None,
        }
    }

    /// Makes the panels higher or lower until the sheet is so many mm high.
    fn stretch(&mut self, height: f64) -> Result<(), OptionsError> {
        let asked = height * POINTS;
        // The legend may find another place in other panels, which changes the height once more.
        for _ in 0..6 {
            let off = asked - layout(self)?.size.1;
            if off.abs() < 0.1 {
                return Ok(());
            }
            let rows = self.panels.iter().step_by(self.columns);
            let panels: f64 = rows.clone().map(|panel| panel.height).sum();
            let lowest = rows.map(|panel| panel.height).fold(f64::INFINITY, f64::min);
            let factor = (panels + off) / panels;
            if lowest * factor < LEAST_PANEL {
                let least = (asked - off - panels * (1.0 - LEAST_PANEL / lowest)) / POINTS;
                let (least, got) = (least.ceil(), height);
                return Err(OptionsError::Low { least, got });
            }
            for panel in &mut self.panels {
                panel.height *= factor;
            }
        }
        self.place_legend(Some(Place::Above));
        let off = asked - layout(self)?.size.1;
        let rows = self.panels.iter().step_by(self.columns);
        let panels: f64 = rows.map(|panel| panel.height).sum();
        for panel in &mut self.panels {
            panel.height *= (panels + off) / panels;
        }
        Ok(())
    }
}
