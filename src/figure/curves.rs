//! Rates against the axis of a sweep: the power of each curve, or, where nothing moves, its
//! false-alarm rate; in one panel, or in as many as the curves name.

use super::FigureError;
use super::labels::{self, WHITENED_DELTA, axis_label, common_facts, is_held_against_alpha};
use super::rates::{Curve, Limit, Rate, add_bands, add_bars, rates};
use super::x_axis::XAxis;
use crate::plot::{
    Axis, Entry, Key, LONG_RANGE, Legend, Margins, Mark, Panel, Place, Plot, Style, ends,
};
use crate::results::Row;
use crate::scenario::Parameter;

/// One panel, without its legend above.
const HEIGHT: f64 = 212.0;
/// One of several.
const SMALL_HEIGHT: f64 = 114.0;

/// What is swept.
#[derive(Clone, Debug)]
pub struct Sweep {
    pub axis: &'static Parameter,
    /// Of the axis, where they are numbers.
    pub values: Vec<f64>,
    pub curves: Vec<SweepCurve>,
}

/// How a curve is shown.
#[derive(Clone, Debug)]
pub struct SweepCurve {
    /// The panel it is drawn in.
    pub panel: Option<String>,
    /// Its name in the legend, where curves of several panels share it.
    pub series: Option<String>,
    /// 1 − β: what a unit of Δ in the record becomes after whitening.
    pub step_gain: Option<f64>,
}

/// Curves that share a panel.
struct Group {
    title: String,
    curves: Vec<Curve>,
}

/// The picture of a sweep.
///
/// # Errors
/// Where no row lies on the axis.
pub fn plot(sweep: &Sweep, rows: &[Row], seed: u64) -> Result<Plot, FigureError> {
    let drawn: Vec<Vec<&Row>> = (1..=sweep.curves.len())
        .map(|curve| rows_of(rows, curve))
        .collect();
    let all: Vec<&Row> = drawn.iter().flatten().copied().collect();
    if all.is_empty() {
        return Err(FigureError::Empty(sweep.axis.name));
    }
    let x = XAxis::new(sweep, &all);
    let common = common_facts(&all);
    let (entries, mut groups) = grouped(sweep, &drawn, &x, &common);
    let is_false_alarm = all.iter().all(|row| row.is_at_rest());
    let is_logarithmic = is_false_alarm && spans_far(&groups);
    for rate in rates_of(&mut groups) {
        match is_logarithmic {
            true => rate.take_logarithms(),
            false => rate.limit = None,
        }
    }
    let mut plot = panels(
        &x,
        &y_axis(&groups, &all, is_false_alarm, is_logarithmic),
        sweep,
        &groups,
        &all,
    );
    for (panel, group) in groups.iter().enumerate() {
        plot.add(panel, Mark::Grid);
        if let Some(y) = nominal(&all, is_logarithmic) {
            plot.add(panel, Mark::Level { y, dash: &[] });
        }
        match x.is_named() {
            true => add_bars(&mut plot, panel, &group.curves),
            false => add_bands(&mut plot, panel, &group.curves, true),
        }
        plot.add(panel, Mark::Axes);
    }
    plot.add(0, Mark::Legend);
    // One curve without a name of its own needs no legend.
    plot.legend =
        (entries.len() > 1 || entries[0].text != "1").then(|| Legend::new(entries, Place::Free));
    plot.set_caption(&labels::caption(&all, common, sweep.axis, seed));
    if rates_of(&mut groups).any(|rate| rate.limit.is_some()) {
        plot.caption
            .push("arrows: upper limits where no trial gave a false alarm".to_owned());
    }
    Ok(plot)
}

/// The legend, and the curves in the panels that they name.
fn grouped(
    sweep: &Sweep,
    drawn: &[Vec<&Row>],
    x: &XAxis,
    common: &[Option<labels::Fact>],
) -> (Vec<Entry>, Vec<Group>) {
    let key = if x.is_named() {
        Key::Marker
    } else {
        Key::MarkedLine
    };
    let mut entries: Vec<Entry> = Vec::new();
    let mut groups: Vec<Group> = Vec::new();
    for (curve, rows) in sweep.curves.iter().zip(drawn) {
        if rows.is_empty() {
            continue;
        }
        let series = curve.series.clone();
        let text = series.unwrap_or_else(|| labels::legend(rows, common, sweep.axis));
        let known = entries.iter().find(|entry| entry.text == text);
        let style = known.map_or(Style::of(entries.len()), |entry| entry.style);
        if known.is_none() {
            entries.push(Entry::new(text, style, key));
        }
        let places = (0..rows.len()).map(|index| rate(x.place(rows, index), rows[index]));
        let mut points: Vec<Rate> = places.collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        let title = curve.panel.clone().unwrap_or_default();
        let curve = Curve { style, points };
        match groups.iter_mut().find(|group| group.title == title) {
            Some(group) => group.curves.push(curve),
            None => groups.push(Group {
                title,
                curves: vec![curve],
            }),
        }
    }
    (entries, groups)
}

/// The panels: one, or two in a row, with words at the left and along the lowest.
fn panels(x: &XAxis, y: &Axis, sweep: &Sweep, groups: &[Group], rows: &[&Row]) -> Plot {
    let is_whitened = rows.iter().all(|row| row.values.text("delta_at") == "whitened");
    let label = axis_label(sweep.axis, is_whitened);
    let (x_axis, y) = (
        x.axis(
            groups
                .iter()
                .flat_map(|group| rates(&group.curves).map(|rate| rate.x)),
        ),
        y.clone(),
    );
    let bottom = 40.0;
    if let [group] = groups {
        let unit =
            whitened_unit(sweep, rows).filter(|_| !x.is_logarithmic() && group.title.is_empty());
        let top = unit.map(|unit| {
            let axis = Axis::linear(x_axis.from * unit, x_axis.to * unit, 8);
            axis.labelled(WHITENED_DELTA)
        });
        let above = match (&top, group.title.is_empty()) {
            (Some(_), _) => 32.0,
            (None, true) => 10.0,
            (None, false) => 22.0,
        };
        let margins = Margins {
            top: above,
            bottom,
            ..Margins::default()
        };
        let height = HEIGHT + 10.0 - above;
        let panel = Panel {
            title: group.title.clone(),
            top,
            ..Panel::new(height, x_axis.labelled(label), y)
        };
        return Plot {
            margins,
            ..Plot::of(vec![panel], 1)
        };
    }
    let panel = |(index, group): (usize, &Group)| {
        let is_lowest = index + 2 >= groups.len();
        let x = x_axis.clone().labelled(if is_lowest { label } else { "" });
        let y = if index.is_multiple_of(2) {
            y.clone()
        } else {
            y.unlabelled()
        };
        Panel {
            title: group.title.clone(),
            ..Panel::new(SMALL_HEIGHT, x, y)
        }
    };
    let margins = Margins {
        top: 22.0,
        bottom,
        ..Margins::default()
    };
    Plot {
        margins,
        ..Plot::of(groups.iter().enumerate().map(panel).collect(), 2)
    }
}

/// From 0 to 1 for a power; for false-alarm rates around what there is of them.
fn y_axis(groups: &[Group], rows: &[&Row], is_false_alarm: bool, is_logarithmic: bool) -> Axis {
    if !is_false_alarm {
        let axis = Axis::linear(0.0, 1.0, 5).within(0.0, 1.03);
        return axis.labelled("D, probability of detection");
    }
    let all = || groups.iter().flat_map(|group| rates(&group.curves));
    let nominal = nominal(rows, is_logarithmic);
    let axis = match is_logarithmic {
        true => {
            let (bottom, top) = ends(all().map(|rate| rate.rate).chain(nominal));
            Axis::decades(bottom - 0.25, (top + 0.15).min(0.08))
        }
        false => {
            let (bottom, top) = ends(all().flat_map(|rate| [rate.low, rate.high]).chain(nominal));
            let room = (top - bottom).max(1e-9);
            // Room above for the legend.
            Axis::linear((bottom - 0.1 * room).max(0.0), top + 0.8 * room, 6)
        }
    };
    axis.labelled("false-alarm rate")
}

/// Where the level stands that false-alarm rates are compared with.
fn nominal(rows: &[&Row], is_logarithmic: bool) -> Option<f64> {
    let alpha = is_held_against_alpha(rows).then_some(rows[0].alpha())?;
    Some(if is_logarithmic {
        libm::log10(alpha)
    } else {
        alpha
    })
}

fn rates_of(groups: &mut [Group]) -> impl Iterator<Item = &mut Rate> {
    let curves = groups.iter_mut().flat_map(|group| &mut group.curves);
    curves.flat_map(|curve| &mut curve.points)
}

/// Whether the largest rate is so many times the smallest that a linear scale would hide it.
fn spans_far(groups: &[Group]) -> bool {
    let all = groups.iter().flat_map(|group| rates(&group.curves));
    let (smallest, largest) = ends(all.map(Rate::shown));
    largest >= LONG_RANGE * smallest
}

/// A row's rate and interval, from its counts.
fn rate(x: f64, row: &Row) -> Rate {
    let (low, high) = row.tally.interval(row.confidence);
    Rate {
        x,
        rate: row.tally.rate(),
        low,
        high,
        limit: (row.tally.hits == 0).then_some(Limit::Upper),
    }
}

/// The rows a curve is drawn from: those in motion, or at rest where nothing ever moves.
fn rows_of(rows: &[Row], curve: usize) -> Vec<&Row> {
    let (at_rest, in_motion): (Vec<&Row>, Vec<&Row>) =
        (rows.iter().filter(|row| row.curve == curve)).partition(|row| row.is_at_rest());
    if in_motion.is_empty() {
        at_rest
    } else {
        in_motion
    }
}

/// 1 − β, where the axis is Δ in the record and every curve has the same sensor, undecimated.
fn whitened_unit(sweep: &Sweep, rows: &[&Row]) -> Option<f64> {
    let first = rows[0];
    let agrees =
        |row: &&Row| {
            let is_same = |name| row.values.cell(name) == first.values.cell(name);
            row.values.text("delta_at") == "record" && is_same("sensor") && row.values.number("decimation") == 1.0
        };
    let is_one = sweep.axis.name == "delta" && rows.iter().all(agrees);
    sweep.curves[first.curve - 1].step_gain.filter(|_| is_one)
}
