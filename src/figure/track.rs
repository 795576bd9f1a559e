//! How far the rides of a recording went: the record, the speed, and the position within two deviations; where the filter
//! knew that the cage stands or moves uniformly is shaded, undecided stretches are hatched.

use super::detection::{states, values, y_axis};
use super::error::FigureError;
use crate::detection::Detection;
use crate::plot::{
    Axis, Entry, Key, Mark, Place, Plot, Point, Style, ends, hatch, literal, phase_colour,
};
use crate::track::{self, Track, Update};

/// Heights of the panels, points.
const RECORD: f64 = 110.0;
const SPEED: f64 = 80.0;
const POSITION: f64 = 130.0;

/// Deviations on either side of a position.
const WIDE: f64 = 2.0;

/// The picture of a recording, whose name is `name` and whose times count from `clock_offset`, and its trips.
///
/// # Errors
/// Where the recording has not even one block.
pub fn plot(
    detection: &Detection,
    track: &Track,
    name: &str,
    clock_offset: Option<f64>,
) -> Result<Plot, FigureError> {
    let columns = detection.trace.columns();
    let (Some(first), Some(last)) = (columns.first(), columns.last()) else {
        return Err(FigureError::Short);
    };
    let (from, to) = (first.times.0, last.times.1);
    let x = Axis::linear(from, to, 10).labelled("time, s");
    let states = states(detection, from, to);
    let record = y_axis(columns, &states, 0.08, |column| column.record).labelled("record, m/s²");
    let speed = axis(track, |place| [place.speed; 2]).labelled("speed, m/s");
    let position = axis(track, within).labelled("position, m");
    let axes = [record, speed, position];
    let heights = [RECORD, SPEED, POSITION];
    let mut plot = Plot::stack(&x, heights.into_iter().zip(axes.clone()));
    (plot.margins.top, plot.margins.legend) = (16.0, (4.0, 4.0));
    for (span, update) in track.course.updates() {
        if let Some(colour) = phase(*update).map(phase_colour) {
            plot.add_to_all(&Mark::Span((span.start, span.end), colour));
        }
    }
    for it in &detection.undecided {
        for (panel, y) in axes.iter().enumerate() {
            for line in hatch((it.from, it.to), &x, y) {
                plot.add(panel, line);
            }
        }
    }
    plot.add(1, Mark::Level(0.0, &[]));
    plot.add(0, values(columns, |column| column.record));
    for places in track.course.stretches() {
        add_places(&mut plot, places);
    }
    plot.add_to_all(&Mark::Axes);
    plot.add_legend(entries(), Place::Across);
    let mut caption = vec![literal(name), format!("{:.1} Hz", detection.design.rate)];
    caption.extend(track.trips.iter().filter_map(|it| {
        let (distance, deviation) = it.distance.zip(it.deviation)?;
        Some(format!(
            "ride {}: {distance:.2} ± {deviation:.2} m",
            it.trip.ride
        ))
    }));
    caption.extend(clock_offset.map(|offset| format!("times count from {offset:.3} s")));
    plot.set_caption(&caption);
    Ok(plot)
}

/// The ends of a position's interval, m.
fn within(place: &track::Place) -> [f64; 2] {
    let wide = WIDE * place.position.variance.sqrt();
    [place.position.mean - wide, place.position.mean + wide]
}

fn axis(track: &Track, value: fn(&track::Place) -> [f64; 2]) -> Axis {
    let places = track.course.stretches().iter().flatten();
    let (low, high) = ends(places.flat_map(value));
    let room = (high - low).max(0.1);
    Axis::linear(low - 0.08 * room, high + 0.08 * room, 5)
}

fn add_places(plot: &mut Plot, places: &[track::Place]) {
    let speeds = places.iter().map(|it| (it.time, it.speed));
    plot.add(1, Mark::Line(speeds.collect(), Style::of(0)));
    let points = places.iter().map(|it| {
        let [low, high] = within(it);
        Point::new(it.time, [low, it.position.mean, high])
    });
    let points: Vec<Point> = points.collect();
    let line = points.iter().map(Point::place).collect();
    plot.add(2, Mark::Band(points, Style::of(1).faded(0.3)));
    plot.add(2, Mark::Line(line, Style::of(0)));
}

/// The phase whose shade an update has.
fn phase(update: Update) -> Option<&'static str> {
    match update {
        Update::None => None,
        Update::Uniform => Some("inertial"),
        Update::Standing => Some("levelling"),
    }
}

fn entries() -> [Entry; 3] {
    let shade = |text: &str, update: Update| {
        let colour = phase_colour(phase(update).unwrap_or("rest"));
        Entry::new(text, Style::of(0).coloured(colour), Key::Shade)
    };
    [
        shade("known to stand", Update::Standing),
        shade("known to move uniformly", Update::Uniform),
        Entry::new("± 2 deviations", Style::of(1).faded(0.3), Key::Shade),
    ]
}
