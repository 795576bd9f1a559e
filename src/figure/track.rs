//! How far the rides of a recording went: the record, the speed, and the position within two deviations; where the filter
//! knew that the cage stands or moves uniformly is shaded, undecided stretches are hatched.

use super::error::FigureError;
use super::record::{Recorded, axis};
use crate::detection::Detection;
use crate::plot::{Axis, Colour, Entry, Key, Mark, Plot, Point, Style, phase_colour};
use crate::stats::quantile::median;
use crate::track::{self, Track, Update};

/// Heights of the panels, points.
const RECORD: f64 = 110.0;
const SPEED: f64 = 80.0;
const POSITION: f64 = 130.0;

const FLOOR: Style = Style::of(0).coloured(Colour::new(150, 150, 150)).wide(0.6);

const READING: Style = Style {
    size: 1.3,
    ..Style::of(0).coloured(Colour::new(60, 60, 60))
};

/// The most readings of a barometer that are drawn.
const MOST_READINGS: usize = 300;

/// Deviations on either side of a position.
const WIDE: f64 = 2.0;

/// So many rides are named in the caption.
const NAMED: usize = 12;

/// The picture of a recording, whose name is `name` and whose times count from `clock_offset`, and its trips among
/// floors at these heights, m.
///
/// # Errors
/// Where the recording has not even one block.
pub fn plot(
    detection: &Detection,
    track: &Track,
    floors: &[f64],
    barometer: &[(f64, f64)],
    (name, clock_offset): (&str, Option<f64>),
) -> Result<Plot, FigureError> {
    let recorded = Recorded::of(detection)?;
    let record = recorded.axis_where_known(0.08, |column| column.record);
    let record = (RECORD, record.labelled("record, m/s²"));
    // Where nothing is measured a speed of 0 and a position of 0 would say nothing.
    let is_measured = track.trips.iter().any(|it| it.distance.is_some());
    let panels: Vec<(f64, Axis)> = if is_measured {
        [record].into_iter().chain(course_panels(track)).collect()
    } else {
        vec![record]
    };
    let mut plot = recorded.panels(&panels);
    for (span, update) in track.course.updates() {
        if let Some(colour) = phase(*update).map(phase_colour) {
            plot.add_to_all(&Mark::Span((span.start, span.end), colour));
        }
    }
    recorded.hatch(&mut plot, &panels);
    plot.add(0, recorded.values(|column| column.record));
    if !is_measured {
        return Ok(recorded.finish(plot, [], (name, clock_offset), []));
    }
    plot.add(1, Mark::Level(0.0, &[]));
    let (from, to) = recorded.span();
    let y = &panels[2].1;
    for height in floors.iter().filter(|it| (y.from..=y.to).contains(*it)) {
        plot.add(2, Mark::Line(vec![(from, *height), (to, *height)], FLOOR));
    }
    for places in track.course.stretches() {
        add_places(&mut plot, places);
    }
    let readings = readings(barometer, track);
    let has_readings = !readings.is_empty();
    plot.add(2, Mark::Markers(readings, READING));
    let entries = entries(!floors.is_empty(), has_readings);
    let trips = in_words(track);
    Ok(recorded.finish(plot, entries, (name, clock_offset), trips))
}

/// The first rides, and how many more there are: a sheet has room for so many.
fn in_words(track: &Track) -> Vec<String> {
    let words = track.trips.iter().filter_map(|it| {
        let (distance, deviation) = it.distance.zip(it.deviation)?;
        Some(format!(
            "ride {}: {distance:.2} ± {deviation:.2} m",
            it.trip.ride
        ))
    });
    let mut words: Vec<String> = words.collect();
    if words.len() > NAMED {
        let more = words.len() - NAMED;
        words.truncate(NAMED);
        words.push(format!("and {more} more"));
    }
    words
}

/// The panels of the speed and of the position.
fn course_panels(track: &Track) -> [(f64, Axis); 2] {
    let places = || track.course.stretches().iter().flatten();
    let speed = axis(0.08, places().map(|place| (place.speed, place.speed)));
    let position = axis(0.08, places().map(within));
    [
        (SPEED, speed.labelled("speed, m/s")),
        (POSITION, position.labelled("position, m")),
    ]
}

/// Readings of a barometer, few enough to be seen, at the height where most of them agree with the position.
fn readings(barometer: &[(f64, f64)], track: &Track) -> Vec<Point> {
    let mut places = track.course.stretches().iter().flatten();
    let (Some(first), Some(last)) = (places.next(), places.next_back()) else {
        return Vec::new();
    };
    let together = barometer.chunks(barometer.len().div_ceil(MOST_READINGS).max(1));
    let means = together.map(|some| {
        let count = some.len() as f64;
        let sum = some
            .iter()
            .fold((0.0, 0.0), |sum, it| (sum.0 + it.0, sum.1 + it.1));
        (sum.0 / count, sum.1 / count)
    });
    let within = means.filter(|it| (first.time..=last.time).contains(&it.0));
    let readings: Vec<(f64, f64)> = within.collect();
    let off = readings
        .iter()
        .filter_map(|(time, height)| Some(track.course.position(*time)? - height));
    let off = median(off.collect());
    let points = readings
        .iter()
        .map(|(time, height)| Point::at((*time, height + off)));
    points.collect()
}

/// The ends of a position's interval, m.
fn within(place: &track::Place) -> (f64, f64) {
    let wide = WIDE * place.position.variance.sqrt();
    (place.position.mean - wide, place.position.mean + wide)
}

fn add_places(plot: &mut Plot, places: &[track::Place]) {
    let speeds = places.iter().map(|it| (it.time, it.speed));
    plot.add(1, Mark::Line(speeds.collect(), Style::of(0)));
    let points = places.iter().map(|it| {
        let (low, high) = within(it);
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

fn entries(has_floors: bool, has_readings: bool) -> impl Iterator<Item = Entry> {
    let shade = |text: &str, update: Update| {
        let colour = phase_colour(phase(update).unwrap_or("rest"));
        Entry::new(text, Style::of(0).coloured(colour), Key::Shade)
    };
    let stands = shade("known to stand", Update::Standing);
    let moves = shade("known to move uniformly", Update::Uniform);
    let floors = has_floors.then(|| Entry::new("floors", FLOOR, Key::Line));
    let readings = has_readings.then(|| Entry::new("barometer", READING, Key::Marker));
    let within = Entry::new("± 2 deviations", Style::of(1).faded(0.3), Key::Shade);
    [stands, moves]
        .into_iter()
        .chain(floors)
        .chain(readings)
        .chain([within])
}
