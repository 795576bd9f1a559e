//! The RMS error over the bound: of every way under the first condition, and of `track` under every condition.

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

/// The rows of a panel by their names, from the top.
type Named<'a> = Vec<(String, Vec<&'a Row>)>;

/// The lower end of an interval, the place of the estimate, and the upper end.
type Placed = (f64, (f64, f64), f64);

/// The picture of a study.
pub fn plot(rows: &[Row], conditions: &[Condition], seed: u64) -> Plot {
    let of = |condition: Condition, outcome: String| -> Vec<&Row> {
        let here = |row: &&Row| row.condition == condition && row.outcome == outcome;
        rows.iter().filter(here).collect()
    };
    let over = |condition, way: Way| of(condition, format!("over_bound_{}", way.name()));
    let words = |name: &str| name.replace('_', " ");
    let ways = Way::ALL.map(|way| (words(way.name()), over(conditions[0], way)));
    let each = conditions.iter();
    let each = each.map(|it| (words(&it.to_string()), over(*it, Way::Track)));
    let shown: [(String, Named, bool); 2] = [
        (
            format!("{}: RMS over bound", words(&conditions[0].to_string())),
            ways.into(),
            true,
        ),
        ("track: RMS over bound".to_owned(), each.collect(), false),
    ];
    let panels = shown.iter().map(|(title, named, is_long)| {
        let names = named.iter().rev().map(|(name, _)| name.clone());
        let height = LINE * named.len() as f64;
        let x = x_axis(named, *is_long);
        Panel::new(height, x, Axis::names(names.collect())).titled(title)
    });
    let mut plot = Plot::of(panels.collect(), 1);
    plot.margins.left = 100.0;
    plot.margins.top = 24.0;
    for (panel, (_, named, is_long)) in shown.iter().enumerate() {
        plot.add(panel, Mark::Grid);
        for (length, points) in points(named, *is_long).into_iter().enumerate() {
            let style = Style::of(length);
            let bars = points.iter().map(|(low, at, high)| {
                let thick = 0.03;
                ((*low, at.1 - thick), (*high, at.1 + thick), style.colour)
            });
            plot.add(panel, Mark::Cells(bars.collect()));
            let markers = points.iter().map(|(_, at, _)| Point::at(*at));
            plot.add(panel, Mark::Markers(markers.collect(), style));
        }
        plot.add(panel, Mark::Axes);
    }
    let lengths = shown[0].1[0].1.iter();
    let lengths = lengths.map(|row| format!("{} m", row.distance));
    plot.add_legend(Entry::of_curves(lengths, Key::Marker), Place::Above);
    plot.set_caption(&[
        "each trip simulated with its accelerometer record".to_owned(),
        format!("{} trips a point", thousands(rows[0].trials)),
        format!("seed {seed}"),
        format!("bars: {} % intervals", 100.0 * rows[0].confidence),
    ]);
    plot
}

fn scaled(value: f64, is_long: bool) -> f64 {
    if is_long { log10(value) } else { value }
}

fn x_axis(named: &Named, is_long: bool) -> Axis {
    let rows = named.iter().flat_map(|(_, rows)| rows);
    let values = rows.filter(|row| row.count > 0);
    let (low, high) = ends(values.map(|row| scaled(row.estimate, is_long)));
    match is_long {
        _ if low > high => Axis::linear(0.0, 1.0, 5),
        true => Axis::decades(low - 0.1, high + 0.1),
        false => Axis::linear(0.9 * low, 1.05 * high, 6),
    }
}

/// For each length the interval of each name, and its place.
fn points(named: &Named, is_long: bool) -> Vec<Vec<Placed>> {
    let lengths = named.iter().map(|(_, rows)| rows.len()).max().unwrap_or(0);
    let of = |length: usize| {
        let places = named.iter().rev().zip((0..).map(f64::from));
        let points = places.filter_map(|((_, rows), y)| {
            let row = rows.get(length).filter(|row| row.count > 0)?;
            let off = (lengths - 1) as f64 / 2.0 - length as f64;
            let [low, x, high] = [row.low, row.estimate, row.high].map(|it| scaled(it, is_long));
            Some((low, (x, y + APART * off), high))
        });
        points.filter(|(low, ..)| low.is_finite()).collect()
    };
    (0..lengths).map(of).collect()
}
