//! What the pictures of a recording have in common: panels over one time axis, the record, hatches where it does not
//! decide, and a caption.

use super::error::FigureError;
use crate::detection::{Column, Detection, Trip};
use crate::plot::{Axis, Entry, Mark, Place, Plot, Style, ends, hatch, literal};

/// A recording and what was found in it, to be drawn.
pub(super) struct Recorded<'a> {
    detection: &'a Detection,
    columns: &'a [Column],
    /// The states that were found, and from when to when they lasted, s.
    pub states: Vec<((f64, f64), &'static str)>,
    x: Axis,
}

impl<'a> Recorded<'a> {
    /// # Errors
    /// Where the recording has not even one block.
    pub fn of(detection: &'a Detection) -> Result<Self, FigureError> {
        let columns = detection.trace.columns();
        let (Some(first), Some(last)) = (columns.first(), columns.last()) else {
            return Err(FigureError::Short);
        };
        let (from, to) = (first.times.0, last.times.1);
        Ok(Self {
            detection,
            columns,
            states: states(detection, from, to),
            x: Axis::linear(from, to, 10).labelled("time, s"),
        })
    }

    /// From when to when it lasts, s.
    pub fn span(&self) -> (f64, f64) {
        (self.x.from, self.x.to)
    }

    /// Panels of these heights, points.
    pub fn panels(&self, panels: &[(f64, Axis)]) -> Plot {
        let mut plot = Plot::stack(&self.x, panels.iter().cloned());
        (plot.margins.top, plot.margins.legend) = (16.0, (4.0, 4.0));
        plot
    }

    /// Hatches what is undecided.
    pub fn hatch(&self, plot: &mut Plot, panels: &[(f64, Axis)]) {
        for it in &self.detection.undecided {
            for (panel, (_, y)) in panels.iter().enumerate() {
                for line in hatch((it.from, it.to), &self.x, y) {
                    plot.add(panel, line);
                }
            }
        }
    }

    /// A scale with room above, for the times at which the state was known: a sensor that is picked up would flatten
    /// everything else.
    pub fn axis_where_known(&self, above: f64, value: fn(&Column) -> (f64, f64)) -> Axis {
        let is_known = |column: &&Column| {
            let mut known = self.states.iter().filter(|(_, name)| *name != "unknown");
            known.any(|((from, to), _)| *from <= column.times.0 && column.times.1 <= *to)
        };
        let known: Vec<_> = self.columns.iter().filter(is_known).map(value).collect();
        if known.is_empty() {
            self.axis(above, value)
        } else {
            axis(above, known)
        }
    }

    /// A scale for all times.
    pub fn axis(&self, above: f64, value: fn(&Column) -> (f64, f64)) -> Axis {
        axis(above, self.columns.iter().map(value))
    }

    /// The values as a line.
    pub fn values(&self, value: fn(&Column) -> (f64, f64)) -> Mark {
        let points = self.columns.iter().flat_map(|column| {
            let ((from, to), (low, high)) = (column.times, value(column));
            [(from, low), (to, high)]
        });
        Mark::Dense(points.collect(), Style::of(0))
    }

    /// Completes a picture of the recording `name`, whose times count from `zero`, where that is not the zero of the file.
    pub fn finish(
        &self,
        mut plot: Plot,
        entries: impl IntoIterator<Item = Entry>,
        (name, zero): (&str, Option<&str>),
        more: impl IntoIterator<Item = String>,
    ) -> Plot {
        plot.add_to_all(&Mark::Axes);
        let mut entries = entries.into_iter().peekable();
        if entries.peek().is_some() {
            plot.add_legend(entries, Place::Across);
        }
        let mut caption = vec![
            literal(name),
            format!("{:.1} Hz", self.detection.design.rate),
        ];
        caption.extend(more);
        caption.extend(zero.map(|zero| format!("times count from {zero}")));
        if let Some(time_constant) = self.detection.filter.time_constant() {
            caption.push(format!("restored from a high pass of {time_constant:.2} s"));
        }
        plot.set_caption(&caption);
        plot
    }
}

/// A scale for stretches of values, with room above.
pub(super) fn axis(above: f64, values: impl IntoIterator<Item = (f64, f64)>) -> Axis {
    let (low, high) = ends(values.into_iter().flat_map(|(low, high)| [low, high]));
    let room = (high - low).max(1e-9);
    Axis::linear(low - 0.08 * room, high + above * room, 5)
}

/// From when to when each state lasted, s, and its name.
fn states(detection: &Detection, from: f64, to: f64) -> Vec<((f64, f64), &'static str)> {
    let mut changes: Vec<(f64, &'static str)> = vec![(from, "rest")];
    for trip in &detection.trips {
        changes.extend(phases(trip));
        if trip.start.is_none() {
            changes[0].1 = "unknown";
        }
    }
    for it in &detection.undecided {
        changes.retain(|(time, _)| !(it.from..it.to).contains(time));
        changes.extend([(it.from, "unknown"), (it.to, "rest")]);
    }
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ends = changes.iter().skip(1).map(|(time, _)| *time).chain([to]);
    let spans = changes
        .iter()
        .zip(ends)
        .map(|((from, name), to)| ((*from, to), *name));
    spans.filter(|((from, to), _)| from < to).collect()
}

/// When the phases of a trip begin, as far as the record shows.
fn phases(trip: &Trip) -> impl Iterator<Item = (f64, &'static str)> {
    let phases = [
        (trip.start, "acceleration"),
        (trip.inertial, "inertial"),
        (trip.braking, "braking"),
        (trip.levelling, "levelling"),
        (trip.stop, "rest"),
    ];
    phases
        .into_iter()
        .filter_map(|(time, name)| time.map(|time| (time, name)))
}
