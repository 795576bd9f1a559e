//! What follows from several rows: Δ/σ for a probability of 0.9, ratios of it, and the worst rates at rest.

use super::noise::Noise;
use super::start::Start;
use super::table::{Row, Table};
use crate::detect::running::Detector;
use crate::results::{Quantity, eight_digits};
use crate::stats::normal;
use crate::study::curves::name_of;
use libm::{exp, log};

/// The probability that an operating point has.
const POWER: f64 = 0.9;

/// Ratios of Δ/σ that are named, beside those over the clairvoyant's.
const PAIRS: [[Detector; 2]; 3] = [
    [Detector::Mended, Detector::ThreeSample],
    [Detector::Ranks, Detector::Cusum],
    [Detector::Ranks, Detector::Glr],
];

/// An estimate and its interval.
type Value = [f64; 3];

/// The point of a row.
pub fn name(row: &Row) -> String {
    let place = [&row.detector, &row.noise, &row.start].map(|part| name_of(part));
    let place = place.into_iter().filter(|part| !part.is_empty());
    let mut parts: Vec<String> = place.collect();
    if row.delta > 0.0 {
        parts.push(row.delta.to_string().replace('.', "_"));
    }
    parts.join("_")
}

/// All of them.
pub fn quantities(rows: &[Row], table: &Table) -> Vec<Quantity> {
    let at_rest = table
        .detector
        .iter()
        .flat_map(|detector| worst(rows, table, *detector));
    let of_starts = table.noise.iter().flat_map(|noise| {
        let starts = table.start.iter();
        starts.flat_map(|start| of_start(rows, table, noise, start))
    });
    at_rest.chain(of_starts).collect()
}

/// The highest rate of a detector on white and on coloured noise.
fn worst(rows: &[Row], table: &Table, detector: Detector) -> Vec<Quantity> {
    let name = detector.to_string();
    let most = |is_white: bool| {
        let of_noise = |row: &&Row| {
            let mut noises = table.noise.iter();
            let noise = noises.find(|noise| noise.label == row.noise);
            noise.is_some_and(|noise| noise.is_white() == is_white)
        };
        let here = |row: &&Row| row.outcome == "over_promised" && row.detector == name;
        let rates = rows.iter().filter(here).filter(of_noise);
        let rates = rates.map(|row| [row.estimate, row.low, row.high]);
        let kind = if is_white { "white" } else { "coloured" };
        let worst = rates.reduce(|one, other| [0, 1, 2].map(|at| one[at].max(other[at])));
        worst.map(|value| quantity(format!("most_over_promised_{name}_{kind}"), value))
    };
    [true, false].into_iter().filter_map(most).collect()
}

/// The operating points of one start in one noise.
fn of_start(rows: &[Row], table: &Table, noise: &Noise, start: &Start) -> Vec<Quantity> {
    let place = format!("{}_{}", name_of(&noise.label), name_of(&start.label));
    let reaches = |detector: Detector| {
        let known = table.detector.contains(&detector);
        known.then(|| operating_point(rows, detector, &noise.label, &start.label))
    };
    let all = table.detector.iter();
    let each = all.clone().filter_map(|detector| {
        let name = format!("delta_90_{detector}_{place}");
        reaches(*detector).map(|value| quantity(name, value))
    });
    let over_clairvoyant = all.map(|detector| [*detector, Detector::Clairvoyant]);
    let pairs = over_clairvoyant
        .filter(|[one, other]| one != other)
        .chain(PAIRS);
    let ratios = pairs.filter_map(|[one, other]| {
        let name = format!("{one}_over_{other}_{place}");
        let value = ratio(reaches(one)?, reaches(other)?);
        Some(quantity(name, value))
    });
    each.chain(ratios).collect()
}

/// Where the probability reaches 0.9; infinite where it does not.
pub fn operating_point(rows: &[Row], detector: Detector, noise: &str, start: &str) -> Value {
    let name = detector.to_string();
    let here = |row: &&Row| {
        (&*row.detector, &*row.noise, &*row.start) == (&*name, noise, start)
            && row.outcome == "within"
    };
    let here: Vec<&Row> = rows.iter().filter(here).collect();
    let reached = |of: fn(&Row) -> f64| {
        let points = here.iter().map(|row| (row.delta, of(row), row.exposure));
        reach(&points.collect::<Vec<_>>())
    };
    // The higher the probability, the smaller is what reaches it.
    [
        reached(|row| row.estimate),
        reached(|row| row.high),
        reached(|row| row.low),
    ]
}

/// Between the last Δ below and the first above: a straight line of probits along ln Δ. At the first Δ already: anything up
/// to it, as 0.
fn reach(points: &[(f64, f64, f64)]) -> f64 {
    let Some(above) = points.iter().position(|(_, power, _)| *power >= POWER) else {
        return f64::INFINITY;
    };
    if above == 0 {
        return 0.0;
    }
    let place = |(delta, power, trials): (f64, f64, f64)| {
        let least = 0.5 / trials;
        let probit = normal::quantile(power.clamp(least, 1.0 - least));
        (log(delta), probit - normal::quantile(POWER))
    };
    let [(x, below), (y, over)] = [points[above - 1], points[above]].map(place);
    exp(x - below * (y - x) / (over - below))
}

/// The quotient, and the extreme ones.
fn ratio([one, low, high]: Value, [other, least, most]: Value) -> Value {
    let over = |a: f64, b: f64| {
        if a.is_infinite() && b.is_infinite() {
            f64::NAN
        } else {
            a / b
        }
    };
    let value = over(one, other);
    let [low, high] = [over(low, most), over(high, least)];
    [
        value,
        if low.is_nan() { 0.0 } else { low },
        if high.is_nan() { f64::INFINITY } else { high },
    ]
}

fn quantity(name: String, value: Value) -> Quantity {
    let [value, low, high] = value.map(eight_digits);
    Quantity {
        name,
        value,
        low,
        high,
    }
}
