//! Curves of rates with their intervals: lines in bands, or bars side by side at names.

use super::axis::Axis;
use super::mark::{Mark, Point};
use super::picture::Plot;
use super::style::Style;

/// Points in one style.
pub struct Curve {
    pub style: Style,
    /// In the order of the axis.
    pub points: Vec<Point>,
}

/// Lines in their bands, and markers over all of them. Where a limit stands for an estimate both have a gap: the
/// truth may lie anywhere beyond it. A curve that lies under others is wider, so that its edge is seen.
pub fn add_bands(plot: &mut Plot, panel: usize, curves: &[Curve]) {
    let covers: Vec<usize> = (0..curves.len())
        .map(|index| covers_of(&plot.panels[panel].y, &curves[index..]))
        .collect();
    let widened = |style: Style, covers: usize| {
        let more = 1.8 * covers.min(3) as f64;
        style
            .wide(style.width + more)
            .sized(style.size + 0.5 * more)
    };
    for (Curve { points, style }, covers) in curves.iter().zip(&covers) {
        for band in stretches(points, |point| point.limit.is_some()) {
            let line = band.iter().map(Point::place).collect();
            plot.add(panel, Mark::Band(band, style.faded(0.18)));
            plot.add(panel, Mark::Line(line, widened(style.solid(), *covers)));
        }
    }
    for (Curve { points, style }, covers) in curves.iter().zip(&covers) {
        plot.add(
            panel,
            Mark::Markers(points.clone(), widened(*style, *covers)),
        );
    }
}

/// What lies between gaps.
pub(super) fn stretches<T: Clone>(points: &[T], is_gap: impl Fn(&T) -> bool) -> Vec<Vec<T>> {
    let stretches = points.split(is_gap).filter(|it| !it.is_empty());
    stretches.map(<[T]>::to_vec).collect()
}

/// How many of the later curves lie over nine tenths of the first and more.
fn covers_of(y: &Axis, curves: &[Curve]) -> usize {
    let [first, later @ ..] = curves else {
        return 0;
    };
    if first.points.is_empty() {
        return 0;
    }
    let covers = |curve: &&Curve| {
        let near = |a: &&Point| {
            let mut at = curve.points.iter().filter(|b| b.x == a.x);
            at.any(|b| (y.share(a.y) - y.share(b.y)).abs() < NEAR)
        };
        10 * first.points.iter().filter(near).count() >= 9 * first.points.len()
    };
    later.iter().filter(covers).count()
}

/// Points so close, as a share of a panel's height, lie on each other.
const NEAR: f64 = 0.008;

/// Each interval as an upright bar, those of other curves beside it, and markers over all of them.
pub fn add_bars(plot: &mut Plot, panel: usize, mut curves: Vec<Curve>) {
    let step = 0.11f64.min(0.8 / curves.len() as f64);
    let middle = (curves.len() - 1) as f64 / 2.0;
    for (index, Curve { points, style }) in curves.iter_mut().enumerate() {
        for point in points.iter_mut() {
            point.x += step * (index as f64 - middle);
        }
        // A limit is drawn as an arrow.
        let bars = points.iter().filter(|point| point.limit.is_none()).copied();
        plot.add(panel, Mark::Bars(bars.collect(), *style));
    }
    for Curve { points, style } in curves {
        plot.add(panel, Mark::Markers(points, style));
    }
}
