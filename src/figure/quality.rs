//! How hard and how smoothly the rides of a recording went: every figure by ride, beside its limit.

use crate::plot::{Axis, Entry, Key, Mark, Place, Plot, Point, Style, ends, literal};
use crate::track::quality::{Measure, PAIRS};
use crate::track::{QualityReport, Tracked};

/// The height of a panel, points.
const HEIGHT: f64 = 80.0;

/// Of the largest values, and of what 95 % do not exceed.
const STYLES: [Style; 2] = [Style::of(0), Style::of(1)];
const DASH: &[f64] = &[4.0, 3.0];

/// How far they stand beside their ride, where they are alike.
const APART: [f64; 2] = [-0.1, 0.1];

/// The picture of the rides of a recording that is called `name`; none if fewer than two were judged.
pub fn plot(rides: &[Tracked], report: &QualityReport, name: &str) -> Option<Plot> {
    let judged = rides.iter().filter(|it| it.quality.is_some()).count();
    let last = rides.last().filter(|_| judged > 1)?.trip.ride;
    let panels = PAIRS.map(|(name, largest, usual)| {
        let series = [Some(largest), usual].map(|it| points(rides, it));
        let limits = [Some(largest), usual].map(|it| limit(report, it));
        let values = series.iter().flatten().map(|it| it.1);
        let (_, top) = ends(values.chain(limits.into_iter().flatten()));
        let y = Axis::linear(0.0, 1.15 * top.max(1e-3), 3);
        let label = format!("{name}, {}", largest.unit());
        (HEIGHT, y.labelled(label), series, limits)
    });
    let x = Axis::linear(0.5, last as f64 + 0.5, 10).labelled("ride");
    let stack = panels.iter().map(|(height, y, ..)| (*height, y.clone()));
    let mut plot = Plot::stack(&x, stack);
    plot.margins.legend = (6.0, 6.0);
    for (panel, (.., series, limits)) in panels.into_iter().enumerate() {
        plot.add(panel, Mark::Grid);
        let series = series
            .into_iter()
            .zip(limits)
            .zip(STYLES.into_iter().zip(APART));
        for ((points, limit), (style, apart)) in series {
            let level = limit.map(|limit| vec![(x.from, limit), (x.to, limit)]);
            plot.add(
                panel,
                Mark::Line(level.unwrap_or_default(), style.dashed(DASH)),
            );
            let points = points
                .into_iter()
                .map(|(ride, value)| Point::at((ride + apart, value)));
            plot.add(panel, Mark::Markers(points.collect(), style));
        }
        plot.add(panel, Mark::Axes);
    }
    let [largest, usual] = STYLES;
    let entries = [
        Entry::new("the largest", largest, Key::Marker),
        Entry::new("what 95 % do not exceed", usual, Key::Marker),
        Entry::new("limit", largest.dashed(DASH), Key::Line),
    ];
    plot.add_legend(entries, Place::Above);
    plot.set_caption(&[literal(name), report.norm.to_owned()]);
    Some(plot)
}

fn points(rides: &[Tracked], measure: Option<Measure>) -> Vec<(f64, f64)> {
    let point = |it: &Tracked| Some((it.trip.ride as f64, it.quality?.figure(measure?)?.value));
    rides.iter().filter_map(point).collect()
}

fn limit(report: &QualityReport, measure: Option<Measure>) -> Option<f64> {
    let mut limits = report.limits.all().iter();
    let limit = limits.find(|it| Some(it.measure) == measure)?;
    limit.most.or(limit.least)
}
