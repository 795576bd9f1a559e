//! The energy of horizontal vibration against the position of the car, ride by ride, with the guard line.

use super::error::FigureError;
use crate::plot::{
    Axis, Colour, Entry, Key, Mark, Panel, Place, Plot, Point, Style, ends, literal,
};
use crate::track::{Placed, Shaken, Track, VibrationReport};
use libm::log10;

/// The height of the panel, points.
const HEIGHT: f64 = 300.0;

const RIDE: Style = Style::of(0).coloured(Colour::new(120, 120, 120)).wide(0.6);
const GUARD: Style = Style::of(1).dashed(&[4.0, 3.0]);
const ALARM: Style = Style::of(1);

/// The picture of a recording that is called `name`; positions are those of its course.
///
/// # Errors
/// If no window has a position.
pub fn plot(track: &Track, report: &VibrationReport, name: &str) -> Result<Plot, FigureError> {
    let at = |it: &Placed| Some((log10(it.energy), track.course.position(it.time)?));
    let known = report.rides.iter().filter(|it| it.most.position.is_some());
    let known: Vec<&Shaken> = known.collect();
    let rides = known
        .iter()
        .map(|ride| ride.windows.iter().filter_map(at).collect());
    let rides: Vec<Vec<(f64, f64)>> = rides.collect();
    let guard = report.guard.map(|guard| log10(guard.energy));
    let all = || rides.iter().flatten();
    let (bottom, top) = ends(all().map(|it| it.1));
    if bottom > top {
        return Err(FigureError::NoPosition);
    }
    let (low, high) = ends(all().map(|it| it.0).chain(guard));
    let x = Axis::decades(low - 0.1, high + 0.1).labelled("energy of horizontal vibration, m²/s⁴");
    let y = Axis::around([bottom, top], false).labelled("position, m");
    let (bottom, top) = (y.from, y.to);
    let mut plot = Plot::of(vec![Panel::new(HEIGHT, x, y)], 1);
    plot.add(0, Mark::Grid);
    for ride in rides {
        plot.add(0, Mark::Line(ride, RIDE));
    }
    let guarded = guard.map(|guard| vec![(guard, bottom), (guard, top)]);
    let entry = Entry::new("guard line", GUARD, Key::Line);
    let mut entries = vec![Entry::new("a ride", RIDE, Key::Line)];
    entries.extend(guarded.is_some().then_some(entry));
    plot.add(0, Mark::Line(guarded.unwrap_or_default(), GUARD));
    let alarms = known.iter().flat_map(|ride| &ride.alarms);
    let alarms: Vec<Point> = alarms
        .filter_map(|it| at(&it.most))
        .map(Point::at)
        .collect();
    entries.extend((!alarms.is_empty()).then(|| Entry::new("alarm", ALARM, Key::Marker)));
    plot.add(0, Mark::Markers(alarms, ALARM));
    plot.add(0, Mark::Axes);
    plot.add_legend(entries, Place::Above);
    plot.set_caption(&[literal(name), "windows of 0.5 s".to_owned()]);
    Ok(plot)
}
