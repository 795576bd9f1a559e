//! Names one under the other, each with an estimate and its interval for every series.

use crate::plot::{Axis, Entry, Key, Mark, Panel, Place, Plot, Point, Style, ends};
use libm::log10;

/// The height of each series of a name, points.
const LINE: f64 = 4.25;

/// The least height of a name, points.
const NAME: f64 = 17.0;

/// How far apart the series of a name are, at most, and all of them together, as a part of its height.
const APART: f64 = 0.17;
const ALL_APART: f64 = 0.85;

/// Half the thickness of a bar, as a part of that.
const THICK: f64 = 0.03;

/// Names from the top, each with its low end, estimate and high end by series.
pub(super) type Named = Vec<(String, Vec<Option<[f64; 3]>>)>;

/// The picture, its axis in decades.
pub(super) fn plot(named: &Named, series: Vec<String>, axis: &str, caption: &[String]) -> Plot {
    let names = named.iter().rev().map(|(name, _)| name.clone());
    let y = Axis::names(names.collect());
    let height = (LINE * series.len() as f64).max(NAME) * named.len() as f64;
    let apart = (ALL_APART / series.len() as f64).min(APART);
    let (least, x) = x_axis(named, axis);
    let mut plot = Plot::of(vec![Panel::new(height, x, y)], 1);
    plot.margins.left = 130.0;
    plot.add(0, Mark::Grid);
    for place in 0..series.len() {
        let style = Style::of(place);
        let off = (series.len() - 1) as f64 / 2.0 - place as f64;
        let rows = named.iter().rev().zip((0..).map(f64::from));
        let points = rows.filter_map(|((_, estimates), y)| {
            let [low, x, high] = (*estimates.get(place)?)?.map(log10);
            // A bar that reaches down to zero begins where the axis does.
            x.is_finite()
                .then_some((low.max(least), (x, y + apart * off), high))
        });
        let points: Vec<_> = points.collect();
        let bars = points.iter().map(|(low, at, high)| {
            let corners = [(*low, at.1 - THICK), (*high, at.1 + THICK)];
            (corners[0], corners[1], style.colour)
        });
        plot.add(0, Mark::Cells(bars.collect()));
        let markers = points.iter().map(|(_, at, _)| Point::at(*at));
        plot.add(0, Mark::Markers(markers.collect(), style));
    }
    plot.add(0, Mark::Axes);
    plot.add_legend(Entry::of_curves(series, Key::Marker), Place::Above);
    plot.set_caption(caption);
    plot
}

/// The axis, and its low end.
fn x_axis(named: &Named, label: &str) -> (f64, Axis) {
    let estimates = named
        .iter()
        .flat_map(|(_, estimates)| estimates.iter().flatten());
    let values = estimates.map(|[_, value, _]| log10(*value));
    let (low, high) = ends(values.filter(|value| value.is_finite()));
    let (low, high) = if low > high {
        (0.0, 1.0)
    } else {
        (low - 0.1, high + 0.1)
    };
    (low, Axis::decades(low, high).labelled(label))
}
