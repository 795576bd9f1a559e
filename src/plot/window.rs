//! The part of a plot that is shown, and its scale of y: marks are moved to another scale, and cut where they leave
//! their axes.

use super::axis::{Axis, ends};
use super::curves::stretches;
use super::mark::{Limit, Mark, Point};
use super::picture::{Panel, Plot};
use super::scale::Scale;

/// About so many ticks stand along an axis.
const TICKS: usize = 6;

impl Plot {
    /// The same with another scale of y in every panel whose y has numbers; whether there is one.
    pub(super) fn rescale(&mut self, scale: Scale) -> bool {
        let old: Vec<Axis> = self.panels.iter().map(|panel| panel.y.clone()).collect();
        for (panel, mark) in std::mem::take(&mut self.marks) {
            let from = old[panel].scale.filter(|from| *from != scale);
            let moved = match from {
                Some(from) => mark.rescaled(from, scale),
                None => vec![mark],
            };
            self.marks
                .extend(moved.into_iter().map(|mark| (panel, mark)));
        }
        // Panels that had one axis keep one.
        let ends: Vec<(f64, f64)> = (old.iter())
            .map(|axis| self.extent(|panel| old[panel].span() == axis.span()))
            .collect();
        for (Panel { y, .. }, (low, high)) in self.panels.iter_mut().zip(ends) {
            if y.scale.is_some_and(|from| from != scale) {
                let least = if scale == Scale::Linear { 1e-12 } else { 0.1 };
                let room = 0.04 * (high - low).max(least);
                let axis = Axis::scaled(scale, low - room, high + room, TICKS);
                *y = y.ticked_as(axis);
            }
        }
        old.iter().any(|axis| axis.scale.is_some())
    }

    /// The smallest and the largest y of some panels, of estimates rather than the ends of their intervals.
    fn extent(&self, is_meant: impl Fn(usize) -> bool) -> (f64, f64) {
        let here = self.marks.iter().filter(|(panel, _)| is_meant(*panel));
        let values = here.flat_map(|(_, mark)| match mark {
            Mark::Line(points, _) | Mark::Dense(points, _) => {
                points.iter().map(|point| point.1).collect()
            }
            Mark::Markers(points, _) | Mark::Points(points, _) | Mark::Band(points, _) => {
                points.iter().map(|point| point.y).collect()
            }
            Mark::Level(y, _) => vec![*y],
            _ => Vec::new(),
        });
        match ends(values.filter(|y| y.is_finite())) {
            (low, high) if low <= high => (low, high),
            _ => (0.0, 1.0),
        }
    }

    /// Shows these ends of x and y, in data, where they are given, and cuts what lies outside. Returns how many
    /// estimates are not shown.
    ///
    /// # Errors
    /// Names the axis that has no numbers, or on which an end has no place.
    pub(super) fn show(
        &mut self,
        x: Option<[f64; 2]>,
        y: Option<[f64; 2]>,
    ) -> Result<usize, WindowError> {
        for panel in &mut self.panels {
            if let Some(range) = x {
                let old = panel.x.clone();
                panel.x = old.between("x_range", range)?;
                if let Some(top) = &mut panel.top {
                    let value = |place| top.from + old.share(place) * (top.to - top.from);
                    let axis = Axis::linear(value(panel.x.from), value(panel.x.to), TICKS);
                    *top = top.ticked_as(axis);
                }
            }
            if let Some(range) = y {
                panel.y = panel.y.between("y_range", range)?;
            }
        }
        let mut cut = 0;
        let marks = std::mem::take(&mut self.marks);
        for (panel, mark) in marks {
            let Panel { x, y, .. } = &self.panels[panel];
            if let Mark::Markers(points, _) | Mark::Points(points, _) = &mark {
                cut += points.iter().filter(|it| !inside(x, y, it.place())).count();
            }
            let kept = mark.cut(x, y).into_iter().map(|mark| (panel, mark));
            self.marks.extend(kept);
        }
        Ok(cut)
    }
}

/// A range that an axis cannot show.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WindowError {
    #[error("{0}: means nothing to this picture, which has names along that axis (take it out)")]
    Names(&'static str),
    #[error("{0}: must {1}, got {2:?}")]
    NoPlace(&'static str, &'static str, [f64; 2]),
}

impl Axis {
    fn span(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    /// The ends and ticks of another axis; without words where this one has none.
    fn ticked_as(&self, other: Self) -> Self {
        let is_silent = self.ticks.iter().all(|(_, label)| label.is_empty());
        let other = if is_silent { other.unlabelled() } else { other };
        other.labelled(self.label.clone())
    }

    /// The same between two values.
    fn between(&self, key: &'static str, range: [f64; 2]) -> Result<Self, WindowError> {
        let scale = self.scale.ok_or(WindowError::Names(key))?;
        let [from, to] = range.map(|value| scale.place(value));
        if !(from.is_finite() && to.is_finite()) {
            return Err(WindowError::NoPlace(key, scale.rule(), range));
        }
        if from >= to {
            let rule = "be two numbers, the smaller first";
            return Err(WindowError::NoPlace(key, rule, range));
        }
        Ok(self.ticked_as(Self::scaled(scale, from, to, TICKS)))
    }
}

impl Mark {
    /// The same on another scale of y. Where an estimate has no place there its limit stands for it, or nothing, and lines
    /// and bands have a gap, unless they are dense.
    fn rescaled(self, from: Scale, to: Scale) -> Vec<Self> {
        let place = |y: f64| to.place(from.value(y));
        let placed = |points: Vec<(f64, f64)>| points.into_iter().map(|(x, y)| (x, place(y)));
        let estimates = |mut points: Vec<Point>| {
            points.iter_mut().for_each(|point| point.rescale(from, to));
            points
        };
        let kept = |points| {
            let mut points = estimates(points);
            points.retain(|point| point.y.is_finite());
            points
        };
        match self {
            Self::Line(points, style) => {
                let points: Vec<(f64, f64)> = placed(points).collect();
                let lines = stretches(&points, |point| !point.1.is_finite()).into_iter();
                lines.map(|points| Self::Line(points, style)).collect()
            }
            Self::Band(points, style) => {
                let is_gap = |point: &Point| point.limit.is_some() || !point.y.is_finite();
                let bands = stretches(&estimates(points), is_gap).into_iter();
                bands.map(|points| Self::Band(points, style)).collect()
            }
            Self::Dense(points, style) => {
                let points = placed(points).filter(|point| point.1.is_finite());
                vec![Self::Dense(points.collect(), style)]
            }
            Self::Bars(points, style) => vec![Self::Bars(kept(points), style)],
            Self::Markers(points, style) => vec![Self::Markers(kept(points), style)],
            Self::Points(points, style) => vec![Self::Points(kept(points), style)],
            Self::Level(y, dash) => vec![Self::Level(place(y), dash)],
            Self::Cells(cells) => {
                let cells = cells.into_iter();
                let cells =
                    cells.map(|(a, b, colour)| ((a.0, place(a.1)), (b.0, place(b.1)), colour));
                let cells = cells.filter(|(a, b, _)| a.1.is_finite() && b.1.is_finite());
                vec![Self::Cells(cells.collect())]
            }
            other => vec![other],
        }
    }

    /// What of it lies between the ends of the axes.
    pub(super) fn cut(self, x: &Axis, y: &Axis) -> Vec<Self> {
        match self {
            Self::Line(points, style) => (pieces(x, y, &points).into_iter())
                .map(|piece| Self::Line(piece, style))
                .collect(),
            Self::Band(points, style) => {
                let cut = match points.len() {
                    1 => cut_bars(x, y, points),
                    _ => cut_band(x, y, &points),
                };
                vec![Self::Band(cut, style)]
            }
            Self::Dense(mut points, style) => {
                points.retain(|point| holds(x, point.0));
                vec![Self::Dense(points, style)]
            }
            Self::Bars(points, style) => vec![Self::Bars(cut_bars(x, y, points), style)],
            Self::Points(points, style) => {
                let markers = Self::Markers(points.clone(), style).cut(x, y);
                [vec![Self::Bars(cut_bars(x, y, points), style)], markers].concat()
            }
            Self::Markers(mut points, style) => {
                points.retain(|point| inside(x, y, point.place()));
                vec![Self::Markers(points, style)]
            }
            Self::Level(at, _) if !holds(y, at) => Vec::new(),
            Self::Limit(at) if !holds(x, at) => Vec::new(),
            Self::Span(stretch, _) | Self::Bracket(stretch, _) | Self::Bar(stretch, ..)
                if !overlaps(x, stretch) =>
            {
                Vec::new()
            }
            Self::Names(mut names, above) => {
                names.retain(|(stretch, _)| overlaps(x, *stretch));
                vec![Self::Names(names, above)]
            }
            Self::Cells(mut cells) => {
                cells.retain(|(a, b, _)| overlaps(x, (a.0, b.0)) && overlaps(y, (a.1, b.1)));
                vec![Self::Cells(cells)]
            }
            other => vec![other],
        }
    }
}

impl Point {
    fn rescale(&mut self, from: Scale, to: Scale) {
        let [low, y, high] = [self.low, self.y, self.high].map(|y| from.value(y));
        let (least, most) = (to.place(low), to.place(high));
        let place = to.place(y);
        *self = match (place.is_finite(), self.limit) {
            (true, _) => Self {
                y: place,
                low: if least.is_finite() { least } else { -1e9 },
                high: if most.is_finite() { most } else { 1e9 },
                ..*self
            },
            // Of an estimate without a place the end of its interval that has one is shown.
            (false, _) if y <= low && most.is_finite() => Self {
                limit: Some(Limit::Upper),
                ..Self::at((self.x, most))
            },
            (false, _) if y >= high && least.is_finite() => Self {
                limit: Some(Limit::Lower),
                ..Self::at((self.x, least))
            },
            _ => Self { y: place, ..*self },
        };
    }
}

fn holds(axis: &Axis, at: f64) -> bool {
    let room = 1e-9 * (axis.to - axis.from);
    (axis.from - room..=axis.to + room).contains(&at)
}

pub(super) fn inside(x: &Axis, y: &Axis, (at, value): (f64, f64)) -> bool {
    holds(x, at) && holds(y, value)
}

fn overlaps(axis: &Axis, (a, b): (f64, f64)) -> bool {
    a.min(b) < axis.to && a.max(b) > axis.from
}

/// The parts of a line within the rectangle of two axes.
fn pieces(x: &Axis, y: &Axis, line: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
    let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
    for pair in line.windows(2) {
        let Some((from, to)) = segment(x, y, pair[0], pair[1]) else {
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
    }
    pieces
}

/// The part of a segment within the rectangle (Liang and Barsky).
fn segment(
    x: &Axis,
    y: &Axis,
    from: (f64, f64),
    to: (f64, f64),
) -> Option<((f64, f64), (f64, f64))> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let edges = [
        (-dx, from.0 - x.from),
        (dx, x.to - from.0),
        (-dy, from.1 - y.from),
        (dy, y.to - from.1),
    ];
    for (towards, room) in edges {
        if towards == 0.0 && room < 0.0 {
            return None;
        }
        if towards < 0.0 {
            enter = enter.max(room / towards);
        } else if towards > 0.0 {
            leave = leave.min(room / towards);
        }
    }
    let at = |share: f64| match share {
        0.0 => from,
        1.0 => to,
        _ => (from.0 + share * dx, from.1 + share * dy),
    };
    (enter <= leave).then(|| (at(enter), at(leave)))
}

/// A band within the ends of x; its edges turn where they leave those of y.
fn cut_band(x: &Axis, y: &Axis, points: &[Point]) -> Vec<Point> {
    let mut turned: Vec<Point> = Vec::new();
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let crossings = [x.from, x.to].map(|at| (at - a.x) / (b.x - a.x));
        let edges = [(a.low, b.low), (a.high, b.high)];
        let over = edges
            .iter()
            .flat_map(|(from, to)| [y.from, y.to].map(|at| (at - from) / (to - from)));
        let mut shares: Vec<f64> = crossings.into_iter().chain(over).collect();
        shares.retain(|share| *share > 0.0 && *share < 1.0);
        shares.sort_by(f64::total_cmp);
        let between = shares.into_iter().map(|share| {
            let mix = |from: f64, to: f64| from + share * (to - from);
            Point::new(
                mix(a.x, b.x),
                [mix(a.low, b.low), mix(a.y, b.y), mix(a.high, b.high)],
            )
        });
        turned.push(a);
        turned.extend(between);
    }
    turned.extend(points.last());
    turned.retain(|point| holds(x, point.x));
    // An edge alone is nothing.
    if turned.len() == 1 {
        turned.clear();
    }
    turned
}

fn cut_bars(x: &Axis, y: &Axis, mut points: Vec<Point>) -> Vec<Point> {
    points.retain(|point| holds(x, point.x) && overlaps(y, (point.low, point.high)));
    points
}
