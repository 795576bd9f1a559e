//! Pictures of outcomes along the axis, or against another outcome, curve by curve: one panel under the other.

use super::outcomes::OutcomeRow;
use crate::plot::{
    Axis, Curve, Entry, Key, Limit, Mark, Place, Plot, Point, Style, add_bands, ends, is_long,
    literal,
};
use libm::log10;

/// An outcome of a point.
pub struct Outcome<'a> {
    pub name: &'a str,
    /// From 1.
    pub curve: usize,
    /// On the axis.
    pub x: f64,
    /// The estimate, and the ends of its interval.
    pub value: [f64; 3],
}

impl<'a> Outcome<'a> {
    /// That of a row, whose curve counts from 1.
    pub fn of(row: &'a impl OutcomeRow, curve: usize, x: f64) -> Self {
        Self {
            name: row.outcome(),
            curve,
            x,
            value: row.value(),
        }
    }
}

/// What a panel shows.
pub struct Shown {
    pub outcome: &'static str,
    /// The outcome of a faint line beside it.
    pub beside: Option<&'static str>,
    /// The outcome that it is drawn against, in place of the axis.
    pub against: Option<&'static str>,
    /// Along its axis.
    pub label: &'static str,
    pub kind: Kind,
    /// Points.
    pub height: f64,
}

/// How an outcome is drawn.
#[derive(Clone, Copy)]
pub enum Kind {
    /// A probability with its interval.
    Share,
    /// A number that should be 1.
    Ratio,
    /// The median of a delay, from its 5 % to its 95 % quantile.
    Delay,
    /// A positive number on a logarithmic scale, with the limit that stands for it where nothing was counted.
    Positive(Limit),
}

impl Shown {
    pub fn new(outcome: &'static str, label: &'static str, kind: Kind, height: f64) -> Self {
        Self {
            outcome,
            beside: None,
            against: None,
            label,
            kind,
            height,
        }
    }

    /// From 0 to 1 for a probability; around what there is otherwise.
    fn y_axis(&self, curves: &[Curve]) -> Axis {
        let (bottom, top) = ends(points(curves).map(|point| point.y));
        let axis = match self.kind {
            _ if bottom > top => Axis::linear(0.0, 1.0, 5),
            Kind::Share => Axis::linear(0.0, 1.0, 5).within(-0.03, 1.03),
            Kind::Ratio => Axis::linear(0.0, 1.2 * top.max(1.0), 4),
            Kind::Delay => {
                let highest = points(curves).map(|point| point.high);
                let highest = highest.filter(|high| high.is_finite());
                Axis::linear(0.0, 1.08 * highest.fold(top, f64::max), 5)
            }
            Kind::Positive(_) => Axis::decades(bottom - 0.35, top + 0.35),
        };
        axis.labelled(self.label)
    }
}

/// The picture.
pub fn plot<'a>(
    outcomes: impl Iterator<Item = Outcome<'a>>,
    labels: &[String],
    shown: Vec<Shown>,
    axis: &str,
    caption: &[String],
) -> Plot {
    let outcomes: Vec<Outcome> = outcomes.collect();
    let along = Along::new(&outcomes, &shown);
    let panels = shown.into_iter().map(|shown| {
        let curves = (0..labels.len()).map(|index| Curve {
            style: Style::of(index),
            points: along.points(&shown, index),
        });
        let curves: Vec<Curve> = curves.collect();
        (shown, curves)
    });
    let panels: Vec<(Shown, Vec<Curve>)> = panels.collect();
    let x = along.axis(panels.iter().flat_map(|(_, curves)| points(curves)));
    let heights = panels
        .iter()
        .map(|(shown, curves)| (shown.height, shown.y_axis(curves)));
    let mut plot = Plot::stack(&x.labelled(axis), heights);
    plot.margins.legend = (6.0, 6.0);
    for (panel, (shown, curves)) in panels.iter().enumerate() {
        plot.add(panel, Mark::Grid);
        for curve in (0..labels.len()).filter(|_| shown.beside.is_some()) {
            let line = along.of(curve, shown.beside.unwrap_or_default());
            let line = line.into_iter().map(|it| (along.x(it), it.value[0]));
            let style = Style::of(curve).faded(0.6);
            plot.add(panel, Mark::Line(line.collect(), style));
        }
        add_bands(&mut plot, panel, curves);
        plot.add(panel, Mark::Axes);
    }
    // One curve without a name of its own needs no legend.
    if labels != ["1"] {
        let names = labels.iter().map(|label| literal(label));
        plot.add_legend(Entry::of_curves(names, Key::MarkedLine), Place::Free);
    }
    let arrows = plot.has_limits();
    let arrows = arrows.then(|| "arrows: limits where nothing happened".to_owned());
    let parts: Vec<String> = caption.iter().cloned().chain(arrows).collect();
    plot.set_caption(&parts);
    plot
}

/// The facts that all points share, of as many facts about each; `None` goes without saying.
pub fn shared(facts: impl Iterator<Item = Vec<Option<String>>>) -> Vec<String> {
    let facts: Vec<_> = facts.collect();
    let shared = (0..facts[0].len())
        .filter(|&index| facts.iter().all(|other| other[index] == facts[0][index]))
        .filter_map(|index| facts[0][index].clone());
    shared.collect()
}

/// Where outcomes stand in their panel.
struct Along<'a> {
    outcomes: &'a [Outcome<'a>],
    is_logarithmic: bool,
}

impl<'a> Along<'a> {
    fn new(outcomes: &'a [Outcome], shown: &[Shown]) -> Self {
        let values: Vec<f64> = outcomes.iter().map(|it| it.x).collect();
        let is_against = shown.iter().any(|shown| shown.against.is_some());
        Self {
            outcomes,
            is_logarithmic: !is_against && is_long(&values),
        }
    }

    /// Those of a curve, in the order of the axis.
    fn of(&self, curve: usize, name: &str) -> Vec<&'a Outcome<'a>> {
        let here = |it: &&Outcome| it.curve == curve + 1 && it.name == name;
        self.outcomes.iter().filter(here).collect()
    }

    /// Those of a curve that lie on the paper.
    fn points(&self, shown: &Shown, curve: usize) -> Vec<Point> {
        let mut points = match shown.kind {
            Kind::Delay => self.delays(shown.outcome, curve),
            kind => {
                let outcomes = self.of(curve, shown.outcome);
                let places = self.places(shown, curve, &outcomes).into_iter();
                let places = places.zip(outcomes);
                places.map(|(x, it)| point(it.value, x, kind)).collect()
            }
        };
        points.retain(|point| point.x.is_finite() && point.y.is_finite());
        points
    }

    fn places(&self, shown: &Shown, curve: usize, outcomes: &[&Outcome]) -> Vec<f64> {
        match shown.against {
            Some(other) => {
                let others = self.of(curve, other);
                others.iter().map(|it| it.value[0]).collect()
            }
            None => outcomes.iter().map(|it| self.x(it)).collect(),
        }
    }

    /// Medians, and bands to the quantiles on either side where both are finite.
    fn delays(&self, outcome: &str, curve: usize) -> Vec<Point> {
        let quantiles = ["05", "50", "95"].map(|name| format!("{outcome}_{name}"));
        let [low, middle, high] = quantiles.map(|outcome| self.of(curve, &outcome));
        let each = middle.iter().zip(low.iter().zip(high));
        let point = each.map(|(middle, (low, high))| {
            let x = self.x(middle);
            if high.value[0].is_finite() {
                Point::new(x, [low, middle, high].map(|it| it.value[0]))
            } else {
                Point::at((x, middle.value[0]))
            }
        });
        point.collect()
    }

    fn x(&self, of: &Outcome) -> f64 {
        if self.is_logarithmic {
            log10(of.x)
        } else {
            of.x
        }
    }

    /// From the first point to the last.
    fn axis<'p>(&self, points: impl Iterator<Item = &'p Point>) -> Axis {
        let mut drawn = points.map(|point| point.x).peekable();
        match drawn.peek() {
            None => Axis::single(0.0),
            Some(_) => Axis::around(drawn, self.is_logarithmic),
        }
    }
}

/// An estimate and its interval. On a logarithmic scale an arrow stands where nothing was counted.
fn point([estimate, low, high]: [f64; 3], x: f64, kind: Kind) -> Point {
    let point = Point::new(x, [low, estimate, high]);
    let Kind::Positive(limit) = kind else {
        return point;
    };
    let is_limit = estimate == 0.0 || estimate.is_infinite();
    let limit = is_limit.then_some(limit);
    let point = Point { limit, ..point }.logarithms();
    match limit {
        Some(_) => Point {
            limit,
            ..Point::at(point.place())
        },
        None => point,
    }
}

fn points(curves: &[Curve]) -> impl Iterator<Item = &Point> {
    curves.iter().flat_map(|curve| &curve.points)
}
