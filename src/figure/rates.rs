//! Curves of rates with their intervals: lines in bands, or bars side by side at names.

use crate::plot::{Mark, Marker, Plot, Point, Style};

const LINE: f64 = 1.1;
const MARKER: f64 = 2.3;

/// What is drawn in one style.
pub(super) struct Curve {
    pub style: Style,
    /// In the order of the axis.
    pub points: Vec<Rate>,
}

/// A rate and its interval, at a place on the axis; on a logarithmic scale, their logarithms.
#[derive(Clone, Copy)]
pub(super) struct Rate {
    pub x: f64,
    pub rate: f64,
    pub low: f64,
    pub high: f64,
    /// A limit stands for it.
    pub limit: Option<Limit>,
}

/// Which end of an interval stands for a rate of which nothing was counted, on a logarithmic scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Limit {
    Upper,
    Lower,
}

impl Rate {
    /// A rate of zero has no logarithm: a limit stands for it.
    pub fn take_logarithms(&mut self) {
        self.rate = libm::log10(self.shown());
        self.low = libm::log10(self.low.max(f64::MIN_POSITIVE));
        self.high = libm::log10(self.high);
    }

    /// What stands for it on a logarithmic scale.
    pub fn shown(&self) -> f64 {
        match self.limit {
            Some(Limit::Upper) => self.high,
            Some(Limit::Lower) => self.low,
            None => self.rate,
        }
    }
}

/// Every rate of every curve.
pub(super) fn rates(curves: &[Curve]) -> impl Iterator<Item = &Rate> {
    curves.iter().flat_map(|curve| &curve.points)
}

/// Lines in their bands, and markers over all of them. Lines lead through limits only where they are `joined`.
pub(super) fn add_bands(plot: &mut Plot, panel: usize, curves: &[Curve], joined: bool) {
    for Curve { points, style } in curves {
        let points = || {
            points
                .iter()
                .filter(|point| joined || point.limit.is_none())
        };
        let band = points().map(|p| (p.x, p.low, p.high)).collect();
        let colour = style.colour.faded(0.18);
        plot.add(
            panel,
            Mark::Band {
                points: band,
                colour,
            },
        );
        plot.add(
            panel,
            Mark::line(points().map(|p| (p.x, p.rate)), LINE, style.solid()),
        );
    }
    for curve in curves {
        add_markers(plot, panel, curve, 0.0);
    }
}

/// Each interval as an upright bar, those of other curves beside it, and markers over all of them.
pub(super) fn add_bars(plot: &mut Plot, panel: usize, curves: &[Curve]) {
    let step = 0.11f64.min(0.8 / curves.len() as f64);
    let aside = |index: usize| step * (index as f64 - (curves.len() - 1) as f64 / 2.0);
    for (index, Curve { points, style }) in curves.iter().enumerate() {
        // A limit is drawn as an arrow.
        let points = points.iter().filter(|point| point.limit.is_none());
        plot.add(
            panel,
            Mark::Bars {
                bars: points
                    .map(|p| (p.x + aside(index), p.low, p.high))
                    .collect(),
                width: LINE,
                colour: style.colour,
            },
        );
    }
    for (index, curve) in curves.iter().enumerate() {
        add_markers(plot, panel, curve, aside(index));
    }
}

fn add_markers(plot: &mut Plot, panel: usize, Curve { points, style }: &Curve, aside: f64) {
    let marker = |rate: &Rate| Point {
        arrow: rate.limit.map(|limit| match limit {
            Limit::Upper => Marker::ArrowDown,
            Limit::Lower => Marker::ArrowUp,
        }),
        ..Point::at(rate.x + aside, rate.rate)
    };
    plot.add(
        panel,
        Mark::Points {
            points: points.iter().map(marker).collect(),
            size: MARKER,
            width: LINE,
            style: *style,
        },
    );
}
