//! The RMS error over the bound: of every way under the first condition, then of `track` under the others.

use super::condition::Condition;
use super::row::Row;
use super::trial::Way;
use crate::format::thousands;
use crate::plot::{Axis, Entry, Key, Mark, Panel, Place, Plot, Point, Style, ends};
use libm::log10;

/// The height of a name, points.
const LINE: f64 = 17.0;

/// How far apart the lengths of a name are, as a part of that.
const APART: f64 = 0.17;

/// Half the thickness of a bar, as a part of that.
const THICK: f64 = 0.03;

/// Rows by their names, from the top.
type Named<'a> = Vec<(String, Vec<&'a Row>)>;

/// The lower end of an interval, the place of the estimate, and the upper end.
type Placed = (f64, (f64, f64), f64);

/// The picture of a study.
pub fn plot(rows: &[Row], conditions: &[Condition], seed: u64) -> Plot {
    let over = |condition: Condition, way: Way| {
        let outcome = format!("over_bound_{}", way.name());
        let here = |row: &&Row| row.condition == condition && row.outcome == outcome;
        let name = format!("{condition}, {}", way.name()).replace('_', " ");
        (name, rows.iter().filter(here).collect())
    };
    let ways = Way::ALL.map(|way| over(conditions[0], way)).into_iter();
    let others = conditions[1..].iter().map(|it| over(*it, Way::Track));
    let named: Named = ways.chain(others).collect();
    let names = named.iter().rev().map(|(name, _)| name.clone());
    let y = Axis::names(names.collect());
    let height = LINE * named.len() as f64;
    let mut plot = Plot::of(vec![Panel::new(height, x_axis(&named), y)], 1);
    plot.margins.left = 130.0;
    plot.add(0, Mark::Grid);
    for (length, points) in points(&named).into_iter().enumerate() {
        let style = Style::of(length);
        let bars = points.iter().map(|(low, at, high)| {
            let corners = [(*low, at.1 - THICK), (*high, at.1 + THICK)];
            (corners[0], corners[1], style.colour)
        });
        plot.add(0, Mark::Cells(bars.collect()));
        let markers = points.iter().map(|(_, at, _)| Point::at(*at));
        plot.add(0, Mark::Markers(markers.collect(), style));
    }
    plot.add(0, Mark::Axes);
    let lengths = named[0].1.iter().map(|row| format!("{} m", row.distance));
    plot.add_legend(Entry::of_curves(lengths, Key::Marker), Place::Above);
    plot.set_caption(&[
        "each trip simulated with its accelerometer record".to_owned(),
        format!("{} trips a point", thousands(rows[0].trials)),
        format!("seed {seed}"),
        format!("bars: {} % intervals", 100.0 * rows[0].confidence),
    ]);
    plot
}

fn x_axis(named: &Named) -> Axis {
    let rows = named.iter().flat_map(|(_, rows)| rows);
    let values = rows.filter(|row| row.count > 0);
    let (low, high) = ends(values.map(|row| log10(row.estimate)));
    let axis = if low > high {
        Axis::decades(0.0, 1.0)
    } else {
        Axis::decades(low - 0.1, high + 0.1)
    };
    axis.labelled("RMS error over the bound")
}

/// For each length the interval of each name, and its place.
fn points(named: &Named) -> Vec<Vec<Placed>> {
    let lengths = named.iter().map(|(_, rows)| rows.len()).max().unwrap_or(0);
    let of = |length: usize| {
        let places = named.iter().rev().zip((0..).map(f64::from));
        let points = places.filter_map(|((_, rows), y)| {
            let row = rows.get(length).filter(|row| row.count > 0)?;
            let off = (lengths - 1) as f64 / 2.0 - length as f64;
            let [low, x, high] = [row.low, row.estimate, row.high].map(log10);
            Some((low, (x, y + APART * off), high))
        });
        points.filter(|(low, ..)| low.is_finite()).collect()
    };
    (0..lengths).map(of).collect()
}
