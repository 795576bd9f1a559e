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
const ACROSS: f64 = 60.0;
const SPEED: f64 = 80.0;
const POSITION: f64 = 130.0;

const FLOOR: Style = Style::of(0).coloured(Colour::new(150, 150, 150)).wide(0.6);

const READING: Style = Style {
    size: 1.3,
    ..Style::of(0).coloured(Colour::new(60, 60, 60))
};

/// The most moments of a stretch that are drawn.
const MOST_PLACES: usize = 8192;

/// The most readings of a barometer that are drawn.
const MOST_READINGS: usize = 300;

/// The most sizes across gravity that are drawn, and of so many one may leave the panel.
const MOST_SIZES: usize = 2048;
const RARE: usize = 500;

/// Deviations on either side of a position.
const WIDE: f64 = 2.0;

/// So many rides are named in the caption.
const NAMED: usize = 12;

/// What is drawn beside the record and its trips, each where it is known.
#[derive(Default)]
pub struct Beside<'a> {
    /// What is read across gravity, m/s², at its time, s.
    pub horizontal: &'a [(f64, f64)],
    /// The heights of the floors, m.
    pub floors: &'a [f64],
    /// Heights by a barometer, m, at their times, s.
    pub barometer: &'a [(f64, f64)],
}

/// The picture of a recording, whose name is `name` and whose times count from `zero`, and its trips.
///
/// # Errors
/// Where the recording has not even one block.
pub fn plot(
    detection: &Detection,
    track: &Track,
    beside: &Beside,
    (name, zero): (&str, Option<&str>),
) -> Result<Plot, FigureError> {
    let recorded = Recorded::of(detection)?;
    let record = recorded.axis_where_known(0.08, |column| column.record);
    let record = (RECORD, record.labelled("record, m/s²"));
    // Where nothing is measured a speed of 0 and a position of 0 would say nothing.
    let is_measured = track.trips.iter().any(|it| it.distance.is_some());
    let across = across(beside.horizontal);
    let has_across = !across.is_empty();
    let mut panels = vec![record];
    panels.extend(has_across.then(|| across_panel(&across)));
    if is_measured {
        panels.extend(course_panels(track));
    }
    let mut plot = recorded.panels(&panels);
    for (span, update) in track.course.updates() {
        if let Some(colour) = phase(*update).map(phase_colour) {
            plot.add_to_all(&Mark::Span((span.start, span.end), colour));
        }
    }
    recorded.hatch(&mut plot, &panels);
    plot.add(0, recorded.values(|column| column.record));
    if has_across {
        plot.add(1, Mark::Dense(across, Style::of(0)));
    }
    if !is_measured {
        return Ok(recorded.finish(plot, [], (name, zero), []));
    }
    let (speed, position) = (panels.len() - 2, panels.len() - 1);
    plot.add(speed, Mark::Level(0.0, &[]));
    let (from, to) = recorded.span();
    let y = &panels[position].1;
    for height in (beside.floors.iter()).filter(|it| (y.from..=y.to).contains(*it)) {
        let line = vec![(from, *height), (to, *height)];
        plot.add(position, Mark::Line(line, FLOOR));
    }
    for places in track.course.stretches() {
        add_places(&mut plot, speed, places);
    }
    let readings = readings(beside.barometer, track);
    let has_readings = !readings.is_empty();
    plot.add(position, Mark::Markers(readings, READING));
    let entries = entries(!beside.floors.is_empty(), has_readings);
    let trips = in_words(track);
    Ok(recorded.finish(plot, entries, (name, zero), trips))
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

/// The largest of so many readings each, as a line.
fn across(horizontal: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let together = horizontal.chunks(horizontal.len().div_ceil(MOST_SIZES).max(1));
    let largest = together.map(|some| {
        let size = some.iter().fold(0.0, |most: f64, it| most.max(it.1));
        (some[0].0, size)
    });
    largest.collect()
}

/// The panel of what is read across gravity: what all but a few sizes need.
fn across_panel(across: &[(f64, f64)]) -> (f64, Axis) {
    let mut sizes: Vec<f64> = across.iter().map(|it| it.1).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let most = sizes[sizes.len() - 1 - sizes.len() / RARE];
    let axis = Axis::linear(0.0, 1.2 * most.max(1e-9), 3);
    (ACROSS, axis.labelled("across, m/s²"))
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

/// In the panel of the speed and the next.
fn add_places(plot: &mut Plot, speed: usize, places: &[track::Place]) {
    let few = places.len().div_ceil(MOST_PLACES).max(1);
    let places = || places.iter().step_by(few);
    let speeds = places().map(|it| (it.time, it.speed));
    plot.add(speed, Mark::Line(speeds.collect(), Style::of(0)));
    let points = places().map(|it| {
        let (low, high) = within(it);
        Point::new(it.time, [low, it.position.mean, high])
    });
    let points: Vec<Point> = points.collect();
    let line = points.iter().map(Point::place).collect();
    plot.add(speed + 1, Mark::Band(points, Style::of(1).faded(0.3)));
    plot.add(speed + 1, Mark::Line(line, Style::of(0)));
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
