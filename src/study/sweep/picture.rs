//! Rates against the axis of a sweep: the power of each curve, or, where nothing moves, its
//! false-alarm rate; in one panel, or in as many as the curves name.

use super::labels::{self, WHITENED_DELTA, axis_label, common_facts, is_held_against_alpha};
use super::x_axis::XAxis;
use crate::claim::{self, Scope};
use crate::figure::FigureError;
use crate::plot::{
    Axis, Curve, Entry, Key, LONG_RANGE, Limit, Mark, Panel, Place, Plot, Point, Style, add_bands,
    add_bars, ends,
};
use crate::results::Row;
use crate::scenario::Parameter;

/// One panel and what stands above it.
const HEIGHT: f64 = 222.0;
/// One of several.
const SMALL_HEIGHT: f64 = 114.0;
/// Above a panel with a title, and above one with a second axis.
const TITLE: f64 = 22.0;
const TOP_AXIS: f64 = 32.0;

/// Curves that share a panel.
struct Group {
    title: String,
    curves: Vec<Curve>,
}

/// What a picture shows beside the rows.
pub struct Frame<'a> {
    pub scope: &'a Scope,
    /// Of every curve 1 − β: what a unit of Δ in the record becomes after whitening.
    pub step_gains: &'a [f64],
    /// The largest multiple of α that a claim allows.
    pub excess: Option<f64>,
}

/// The picture of a sweep.
///
/// # Errors
/// Where no row lies on the axis.
pub fn plot(frame: &Frame, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
    let Frame {
        scope, step_gains, ..
    } = *frame;
    let curves = 1..=scope.curves.len();
    let drawn: Vec<Vec<&Row>> = curves.map(|curve| rows_of(rows, curve)).collect();
    let all = drawn.concat();
    if all.is_empty() {
        return Err(FigureError::Empty(scope.axis.name));
    }
    let axis = XAxis::new(&scope.axis, &all);
    let common = common_facts(&all);
    let (entries, mut groups) = grouped(&scope.curves, &drawn, &axis, &common);
    let is_false_alarm = all.iter().all(|row| row.is_at_rest());
    let is_log = is_false_alarm && spans_far(&groups);
    groups.iter_mut().for_each(|group| group.scale(is_log));
    let scale: fn(f64) -> f64 = if is_log { libm::log10 } else { f64::from };
    let alpha = is_held_against_alpha(&all).then(|| all[0].alpha());
    let most = alpha.and_then(|alpha| Some(alpha * frame.excess?));
    let levels: Vec<(f64, &'static [f64])> = (alpha.map(|alpha| (scale(alpha), SOLID)).into_iter())
        .chain(most.map(|most| (scale(most), DASHED)))
        .collect();
    let y = if is_false_alarm {
        rate_axis(&groups, &levels, is_log)
    } else {
        power_axis()
    };
    let label = axis_label(axis.parameter, is_whitened(&all));
    let mut plot = panels(&groups, &axis, label, &y);
    if let Some(unit) =
        whitened_unit(axis.parameter, step_gains, &all).filter(|_| !axis.is_logarithmic())
    {
        plot.add_whitened_axis(unit);
    }
    for (panel, group) in groups.into_iter().enumerate() {
        add_panel(&mut plot, panel, group, &levels, axis.is_named());
    }
    let mut caption = labels::caption(&all, common, axis.parameter, seed);
    caption.push(labels::intervals(&plot, all[0].confidence));
    if alpha.is_some() {
        caption.push("line: the nominal level".to_owned());
    }
    if let Some(excess) = frame.excess.filter(|_| alpha.is_some()) {
        caption.push(format!("dashed: {excess} α, the most that a claim allows"));
    }
    plot.set_caption(&caption);
    if plot.has_limits() {
        let arrows = "arrows: upper limits where no trial gave a false alarm";
        plot.caption.push(vec![arrows.to_owned()]);
    }
    // One curve without a name of its own needs no legend.
    if entries.len() > 1 || entries[0].text != "1" {
        plot.add_legend(entries, Place::Free);
    }
    Ok(plot)
}

/// The dashes of the nominal level, and of the most that a claim allows.
const SOLID: &[f64] = &[];
const DASHED: &[f64] = &[3.0, 2.0];

fn add_panel(
    plot: &mut Plot,
    panel: usize,
    group: Group,
    levels: &[(f64, &'static [f64])],
    is_named: bool,
) {
    plot.add(panel, Mark::Grid);
    for (level, dash) in levels {
        plot.add(panel, Mark::Level(*level, dash));
    }
    if is_named {
        add_bars(plot, panel, group.curves);
    } else {
        add_bands(plot, panel, &group.curves);
    }
    plot.add(panel, Mark::Axes);
}

impl Group {
    /// Takes logarithms, or leaves rates as they are: then no limits stand for them.
    fn scale(&mut self, is_logarithmic: bool) {
        for point in self.curves.iter_mut().flat_map(|curve| &mut curve.points) {
            *point = if is_logarithmic {
                point.logarithms()
            } else {
                Point {
                    limit: None,
                    ..*point
                }
            };
        }
    }
}

/// The legend, and the curves in the panels that they name.
fn grouped(
    curves: &[claim::Curve],
    drawn: &[Vec<&Row>],
    axis: &XAxis,
    common: &[Option<labels::Fact>],
) -> (Vec<Entry>, Vec<Group>) {
    let key = if axis.is_named() {
        Key::Marker
    } else {
        Key::MarkedLine
    };
    let mut entries: Vec<Entry> = Vec::new();
    let mut groups: Vec<Group> = Vec::new();
    for (curve, rows) in curves
        .iter()
        .zip(drawn)
        .filter(|(_, rows)| !rows.is_empty())
    {
        let series = curve.series.clone();
        let text = series.unwrap_or_else(|| labels::legend(rows, common, axis.parameter));
        let known = entries.iter().find(|entry| entry.text == text);
        let style = known.map_or(Style::of(entries.len()), |entry| entry.style);
        if known.is_none() {
            entries.push(Entry::new(text, style, key));
        }
        let places = (0..rows.len()).map(|index| axis.place(rows, index));
        let mut points: Vec<Point> = places.zip(rows).map(|(x, row)| point(x, row)).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        let title = curve.panel.clone().unwrap_or_default();
        let curves = vec![Curve { style, points }];
        match groups.iter_mut().find(|group| group.title == title) {
            Some(group) => group.curves.extend(curves),
            None => groups.push(Group { title, curves }),
        }
    }
    (entries, groups)
}

/// One panel, or two in a row with words at the left and along the lowest.
fn panels(groups: &[Group], axis: &XAxis, label: &str, y: &Axis) -> Plot {
    let x = axis.axis(points(groups).map(|point| point.x));
    let count = groups.len();
    let panel = |(index, group): (usize, &Group)| {
        let is_lowest = index + 2 >= count;
        let x = x.clone().labelled(if is_lowest { label } else { "" });
        let is_left = index.is_multiple_of(2);
        let y = if is_left { y.clone() } else { y.unlabelled() };
        Panel::new(SMALL_HEIGHT, x, y).titled(&group.title)
    };
    let panels = groups.iter().enumerate().map(panel).collect();
    let mut plot = Plot::of(panels, count.min(2));
    plot.margins.bottom = 40.0;
    if count > 1 || !groups[0].title.is_empty() {
        plot.margins.top = TITLE;
    }
    if count == 1 {
        plot.panels[0].height = HEIGHT - plot.margins.top;
    }
    plot
}

impl Plot {
    /// Δ after whitening, along the top of a single panel without a title.
    fn add_whitened_axis(&mut self, unit: f64) {
        if let [panel] = &mut self.panels[..]
            && panel.title.is_empty()
        {
            let axis = Axis::linear(panel.x.from * unit, panel.x.to * unit, 8);
            panel.top = Some(axis.labelled(WHITENED_DELTA));
            panel.height = HEIGHT - TOP_AXIS;
            self.margins.top = TOP_AXIS;
        }
    }
}

fn power_axis() -> Axis {
    Axis::linear(0.0, 1.0, 5)
        .within(0.0, 1.03)
        .labelled("D, probability of detection")
}

/// Around what there is of false-alarm rates.
fn rate_axis(groups: &[Group], levels: &[(f64, &[f64])], is_logarithmic: bool) -> Axis {
    let level = levels.iter().map(|(level, _)| *level);
    let axis = if is_logarithmic {
        let (bottom, top) = ends(points(groups).map(|point| point.y).chain(level));
        Axis::decades(bottom - 0.25, (top + 0.15).min(0.08))
    } else {
        let limits = points(groups).flat_map(|point| [point.low, point.high]);
        let (bottom, top) = ends(limits.chain(level));
        let room = (top - bottom).max(1e-9);
        // Room above for the legend.
        Axis::linear((bottom - 0.1 * room).max(0.0), top + 0.8 * room, 6)
    };
    axis.labelled("false-alarm rate")
}

fn points(groups: &[Group]) -> impl Iterator<Item = &Point> {
    (groups.iter().flat_map(|group| &group.curves)).flat_map(|curve| &curve.points)
}

/// Whether the largest rate is so many times the smallest that a linear scale would hide it.
fn spans_far(groups: &[Group]) -> bool {
    let (smallest, largest) = ends(points(groups).map(Point::shown));
    largest >= LONG_RANGE * smallest
}

/// A row's rate and interval, from its counts.
fn point(x: f64, row: &Row) -> Point {
    let (low, high) = row.tally.interval(row.confidence);
    let limit = (row.tally.hits == 0).then_some(Limit::Upper);
    Point {
        limit,
        ..Point::new(x, [low, row.tally.rate(), high])
    }
}

/// The rows a curve is drawn from: those in motion, or at rest where nothing ever moves.
fn rows_of(rows: &[Row], curve: usize) -> Vec<&Row> {
    let here = rows.iter().filter(|row| row.curve == curve);
    let (at_rest, in_motion): (Vec<_>, Vec<_>) = here.partition(|row| row.is_at_rest());
    if in_motion.is_empty() {
        at_rest
    } else {
        in_motion
    }
}

fn is_whitened(rows: &[&Row]) -> bool {
    rows.iter()
        .all(|row| row.values.text("delta_at") == "whitened")
}

/// 1 − β, where the axis is Δ in the record and every curve has the same sensor, undecimated.
fn whitened_unit(axis: &Parameter, step_gains: &[f64], rows: &[&Row]) -> Option<f64> {
    let first = rows[0];
    let agrees = |row: &&Row| {
        let is_same = |name| row.values.cell(name) == first.values.cell(name);
        let is_plain = row.values.number("decimation") == 1.0;
        row.values.text("delta_at") == "record" && is_same("sensor") && is_plain
    };
    let is_one = axis.name == "delta" && rows.iter().all(agrees);
    is_one.then(|| step_gains[first.curve - 1])
}
