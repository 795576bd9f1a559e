//! Names one under the other, each with an estimate and its interval for every series.

use crate::plot::{Axis, Entry, Key, Mark, Panel, Place, Plot, Point, Style, ends};
use libm::log10;

/// The height of each series of a name, points.
const LINE: f64 = 4.25;

/// How far apart the series of a name are, as a part of its height.
const APART: f64 = 0.17;

/// Half the thickness of a bar, as a part of that.
const THICK: f64 = 0.03;

/// Names from the top, each with its low end, estimate and high end by series.
pub(super) type Named = Vec<(String, Vec<Option<[f64; 3]>>)>;

/// The picture, its axis in decades.
pub(super) fn plot(named: &Named, series: Vec<String>, axis: &str, caption: &[String]) -> Plot {
    let names = named.iter().rev().map(|(name, _)| name.clone());
    let y = Axis::names(names.collect());
    let height = LINE * (named.len() * series.len()) as f64;
    let mut plot = Plot::of(vec![Panel::new(height, x_axis(named, axis), y)], 1);
    plot.margins.left = 130.0;
    plot.add(0, Mark::Grid);
    for place in 0..series.len() {
        let style = Style::of(place);
        let off = (series.len() - 1) as f64 / 2.0 - place as f64;
        let rows = named.iter().rev().zip((0..).map(f64::from));
        let points = rows.filter_map(|((_, estimates), y)| {
            let [low, x, high] = (*estimates.get(place)?)?.map(log10);
            low.is_finite().then_some((low, (x, y + APART * off), high))
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

fn x_axis(named: &Named, label: &str) -> Axis {
    let estimates = named
        .iter()
        .flat_map(|(_, estimates)| estimates.iter().flatten());
    let (low, high) = ends(estimates.map(|[_, value, _]| log10(*value)));
    let axis = if low > high {
        Axis::decades(0.0, 1.0)
    } else {
        Axis::decades(low - 0.1, high + 0.1)
    };
    axis.labelled(label)
}
