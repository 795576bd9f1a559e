//! Rides before the monitor: outcomes against the axis, one panel under the other; of a trade-off, the time
//! between false motions against the delay.

use super::measure::Measure;
use super::row::Row;
use super::table::Table;
use crate::format::thousands;
use crate::plot::{
    Axis, Curve, Entry, Key, Limit, Mark, Place, Plot, Point, Style, add_bands, ends, is_long,
    literal,
};

/// What a panel shows.
struct Shown {
    outcome: &'static str,
    /// Along its axis.
    label: &'static str,
    kind: Kind,
    height: f64,
}

/// How it is drawn.
#[derive(Clone, Copy)]
enum Kind {
    /// A probability with its interval.
    Share,
    /// The median of a delay, from its 5 % to its 95 % quantile.
    Delay,
    /// A positive number on a logarithmic scale, with the limit that stands for it where nothing was
    /// counted.
    Positive(Limit),
}

/// The picture of a study.
pub fn plot(rows: &[Row], table: &Table, seed: u64) -> Plot {
    let places = Places::new(rows, table.measure);
    let panels = shown(table.measure).into_iter().map(|shown| {
        let curves = (0..table.labels.len()).map(|index| Curve {
            style: Style::of(index),
            points: places.points(&shown, index),
        });
        let curves = curves.collect();
        (shown, curves)
    });
    let panels: Vec<(Shown, Vec<Curve>)> = panels.collect();
    let x = places.axis(panels.iter().flat_map(|(_, curves)| points(curves)));
    let heights = panels
        .iter()
        .map(|(shown, curves)| (shown.height, shown.y_axis(curves)));
    let mut plot = Plot::stack(&x.labelled(axis_label(table)), heights);
    plot.margins.legend = (6.0, 6.0);
    for (panel, (_, curves)) in panels.iter().enumerate() {
        plot.add(panel, Mark::Grid);
        add_bands(&mut plot, panel, curves, false);
        plot.add(panel, Mark::Axes);
    }
    // One curve without a name of its own needs no legend.
    if table.labels != ["1"] {
        let names = table.labels.iter().map(|label| literal(label));
        plot.add_legend(Entry::of_curves(names, Key::MarkedLine), Place::Free);
    }
    plot.set_caption(&caption(rows, table, seed));
    plot
}

/// The panels of a measurement, from the top.
fn shown(measure: Measure) -> Vec<Shown> {
    let panel = |outcome, label, kind, height| Shown {
        outcome,
        label,
        kind,
        height,
    };
    let share = |outcome, label, height| panel(outcome, label, Kind::Share, height);
    let delay = |outcome, label| panel(outcome, label, Kind::Delay, 105.0);
    let positive =
        |outcome, label, limit| vec![panel(outcome, label, Kind::Positive(limit), 210.0)];
    match measure {
        Measure::Rides => vec![
            share("found", "P(every trip is found)", 130.0),
            delay("start_delay", "start to H_1*, s"),
        ],
        Measure::Rest => {
            let label = "false motions per hour of rest";
            positive("false_motions", label, Limit::Upper)
        }
        Measure::Tradeoff => {
            let label = "hours of rest between false motions";
            positive("hours_between", label, Limit::Lower)
        }
        Measure::Jam => vec![
            share("alarmed", "P(a jam alarms)", 130.0),
            delay("alarm_delay", "jam to alarm, s"),
        ],
        Measure::SwitchedOn => vec![
            share("misled", "P(says rest in motion)", 115.0),
            share("knew", "P(knows it stands at last)", 115.0),
        ],
    }
}

/// Where rows stand in their panel.
struct Places<'a> {
    rows: &'a [Row],
    is_tradeoff: bool,
    is_logarithmic: bool,
}

impl<'a> Places<'a> {
    fn new(rows: &'a [Row], measure: Measure) -> Self {
        let is_tradeoff = measure == Measure::Tradeoff;
        let values: Vec<f64> = rows.iter().map(|row| row.x).collect();
        let is_logarithmic = !is_tradeoff && is_long(&values);
        Self {
            rows,
            is_tradeoff,
            is_logarithmic,
        }
    }

    /// The rows of an outcome, in the order of the axis.
    fn of(&self, curve: usize, outcome: &str) -> Vec<&'a Row> {
        let here = |row: &&Row| row.curve == curve + 1 && row.outcome == outcome;
        self.rows.iter().filter(here).collect()
    }

    /// Those of a curve that lie on the paper.
    fn points(&self, shown: &Shown, curve: usize) -> Vec<Point> {
        let mut points = match shown.kind {
            Kind::Delay => self.delays(shown.outcome, curve),
            kind => {
                let rows = self.of(curve, shown.outcome);
                let places = self.places(curve, &rows).into_iter().zip(rows);
                places.map(|(x, row)| point(row, x, kind)).collect()
            }
        };
        points.retain(|point| point.x.is_finite() && point.y.is_finite());
        points
    }

    /// On the axis; of a trade-off, the delays.
    fn places(&self, curve: usize, rows: &[&Row]) -> Vec<f64> {
        if self.is_tradeoff {
            let delays = self.of(curve, "start_delay_50");
            return delays.iter().map(|row| row.estimate).collect();
        }
        rows.iter().map(|row| self.x(row)).collect()
    }

    /// Medians, and bands to the quantiles on either side where both are finite.
    fn delays(&self, outcome: &str, curve: usize) -> Vec<Point> {
        let quantiles = ["05", "50", "95"].map(|name| format!("{outcome}_{name}"));
        let [low, middle, high] = quantiles.map(|outcome| self.of(curve, &outcome));
        (middle.iter().zip(low.iter().zip(high)))
            .map(|(row, (low, high))| {
                if high.estimate.is_finite() {
                    Point::new(self.x(row), [low, row, high].map(|row| row.estimate))
                } else {
                    Point::at((self.x(row), row.estimate))
                }
            })
            .collect()
    }

    fn x(&self, row: &Row) -> f64 {
        if self.is_logarithmic {
            libm::log10(row.x)
        } else {
            row.x
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

/// A rate and its interval. On a logarithmic scale an arrow stands where nothing was counted: a band would
/// reach to the edge.
fn point(row: &Row, x: f64, kind: Kind) -> Point {
    let point = Point::new(x, [row.low, row.estimate, row.high]);
    let Kind::Positive(limit) = kind else {
        return point;
    };
    let limit = (row.count == 0).then_some(limit);
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

impl Shown {
    /// From 0 to 1 for a probability; around what there is otherwise.
    fn y_axis(&self, curves: &[Curve]) -> Axis {
        let (bottom, top) = ends(points(curves).map(|point| point.y));
        let axis = match self.kind {
            _ if bottom > top => Axis::linear(0.0, 1.0, 5),
            Kind::Share => Axis::linear(0.0, 1.0, 5).within(-0.03, 1.03),
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

fn axis_label(table: &Table) -> String {
    match table.measure {
        Measure::Tradeoff => "median delay from a start to H_1*, s".to_owned(),
        _ => key_in_words(&table.axis),
    }
}

fn key_in_words(key: &str) -> String {
    match key {
        "delta_over_sigma" => "Δ/σ, acceleration of the drive in deviations of a sample",
        "sigma" => "σ, deviation of a sample, m/s²",
        "density" => "density of the noise, m/s²/√Hz",
        "rate" => "sampling rate, Hz",
        "alpha" => "α, level of each decision",
        "vibration" => "deviation of the vibration at full speed, σ",
        "least_speed" => "least speed of a motion, m/s",
        "least_acceleration" => "least acceleration of a start, m/s²",
        "speed" => "speed of the drive, m/s",
        "acceleration" => "acceleration of the drive, m/s²",
        "block" => "length of a block, s",
        "jam_within" => "time from jam to stand, s",
        other => return literal(other),
    }
    .to_owned()
}

/// What all points share, and what is drawn.
fn caption(rows: &[Row], table: &Table, seed: u64) -> Vec<String> {
    let measure = table.measure;
    let facts: Vec<_> = rows.iter().map(|row| facts(measure, row)).collect();
    let shared = (0..facts[0].len())
        .filter(|&index| facts.iter().all(|other| other[index] == facts[0][index]))
        .filter_map(|index| facts[0][index].clone());
    let mut parts: Vec<String> = shared.collect();
    parts.push(format!("{} trials per point", thousands(rows[0].trials)));
    parts.push(format!("seed {}", seed));
    if measure == Measure::Tradeoff {
        let (first, last) = (rows[0].x, rows[rows.len() - 1].x);
        let key = key_in_words(&table.axis);
        parts.push(format!("along each curve {key}, from {first} to {last}"));
    }
    let percent = 100.0 * rows[0].confidence;
    parts.push(match measure {
        Measure::Rides | Measure::Jam => {
            format!(
                "bands: exact {percent} % intervals above, 5 % to 95 % of the delays below, where \
                 so many were told"
            )
        }
        Measure::Rest | Measure::Tradeoff => {
            format!("bands: exact {percent} % intervals; arrows: limits where nothing happened")
        }
        Measure::SwitchedOn => format!("bands: exact {percent} % intervals"),
    });
    parts
}

/// The parameters of a point in words, always as many; `None` for what goes without saying.
fn facts(measure: Measure, row: &Row) -> Vec<Option<String>> {
    let Row {
        trips,
        distance,
        speed,
        acceleration,
        jerk,
        ..
    } = row;
    let sigma = (1e4 * row.sigma).round() / 1e4;
    let rides = measure.rides();
    vec![
        rides.then(|| format!("{trips} trips of {distance} m at {speed} m/s")),
        rides.then(|| format!("{acceleration} m/s², {jerk} m/s³")),
        measure
            .rests()
            .then(|| format!("rests of {} s", row.length)),
        (measure == Measure::Jam).then(|| format!("jams within {} s", row.jam_within)),
        Some(format!("{} Hz", row.rate)),
        Some(format!("σ = {sigma} m/s²")),
        (!row.sensor.ends_with("()")).then(|| row.sensor.clone()),
        (row.vibration > 0.0).then(|| format!("vibration {} σ", row.vibration)),
        (row.nu > 0.0).then(|| format!("ν = {}, θ = {} σ", row.nu, row.theta)),
        (row.footfalls > 0.0)
            .then(|| format!("footfalls {} per sample, {} σ", row.footfalls, row.jolt)),
        Some(format!("α = {}", row.alpha)),
        Some(format!(
            "N, M_1, M_2 = {}, {}, {}",
            row.reference, row.shift, row.scale
        )),
        Some(format!("blocks of {} s", row.block)),
        Some(format!("motions from {} m/s", row.least_speed)),
    ]
}
