//! Curves of rates with their intervals: lines in bands, or bars side by side at names.

use super::mark::{Mark, Point};
use super::picture::Plot;
use super::style::Style;

/// Points in one style.
pub struct Curve {
    pub style: Style,
    /// In the order of the axis.
    pub points: Vec<Point>,
}

/// Lines in their bands, and markers over all of them. Bands and lines pass through limits only where `joined`.
pub fn add_bands(plot: &mut Plot, panel: usize, curves: &[Curve], joined: bool) {
    for Curve { points, style } in curves {
        let band = points
            .iter()
            .filter(|point| joined || point.limit.is_none());
        let band: Vec<Point> = band.copied().collect();
        let line = band.iter().map(Point::place).collect();
        plot.add(panel, Mark::Band(band, style.faded(0.18)));
        plot.add(panel, Mark::Line(line, style.solid()));
    }
    for Curve { points, style } in curves {
        plot.add(panel, Mark::Markers(points.clone(), *style));
    }
}

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
