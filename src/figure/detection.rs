//! A recording and what was found in it: the record, below it the same whitened; states shaded and named; where
//! X, Y₁ and Y₂ of each decision lay, and when it was made.

use super::FigureError;
use super::frame::{CAPTION_LEFT, Frame, SMALL, Scale, WIDTH};
use super::legend::{Entry, Key, Legend};
use super::look::Look;
use super::phases::{draw_dense, draw_limit, phase_colour, phase_words};
use super::sheet::{Picture, Sheet};
use super::text::{Align, Style, literal, text_width};
use super::words::wrap;
use crate::detection::{Column, Detection};
use crate::monitor::{Decision, Kind, State};
use crate::signal::Phase;
use plotters::prelude::{BLACK, DrawingBackend, RGBColor};

const PANEL: f64 = 140.0;
/// Room for the names of the states.
const NAMES: f64 = 16.0;
/// Room for the bars of the samples, as a share of the lower panel.
const BARS: f64 = 0.34;

/// The picture of a detection.
pub(super) struct Found<'a> {
    detection: &'a Detection,
    frames: [Frame; 2],
    states: Vec<Stretch>,
    decisions: Vec<(f64, Decision)>,
    legend: Legend,
    caption: Vec<String>,
}

/// A state and from when to when it lasted, s.
struct Stretch {
    state: State,
    from: f64,
    to: f64,
}

impl<'a> Found<'a> {
    pub fn new(detection: &'a Detection, name: &str) -> Result<Self, FigureError> {
        let columns = detection.trace.columns();
        let (Some(first), Some(last)) = (columns.first(), columns.last()) else {
            return Err(FigureError::Short);
        };
        let (from, to) = (first.times.0, last.times.1);
        let states = states(detection, from, to);
        let x = Scale::linear(from, to, 10);
        let is_known = |column: &&Column| is_known(&states, column);
        let record = scale(columns, is_known, 0.08, |column| column.record);
        let whitened = scale(columns, is_known, BARS, |column| column.whitened);
        let legend = legend();
        let frames = Frame::stack(
            NAMES + legend.height() + 4.0,
            [(PANEL, record), (PANEL, whitened)],
            &x,
        );
        Ok(Self {
            frames,
            decisions: decisions(detection),
            caption: caption(detection, name),
            legend,
            states,
            detection,
        })
    }

    fn draw_states<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let upper = &self.frames[0];
        let mut taken = 0.0;
        for Stretch { state, from, to } in &self.states {
            let colour = state_colour(*state);
            for frame in &self.frames {
                frame.draw_band(sheet, (*from, *to), colour)?;
            }
            let (left, right) = (upper.at(*from, 0.0).0, upper.at(*to, 0.0).0);
            let words = state_words(*state);
            let (middle, half) = (f64::midpoint(left, right), text_width(words, SMALL) / 2.0);
            // Of names that would run into each other the first is kept.
            if middle - half > taken && middle + half < WIDTH {
                let at = (middle, upper.top - 5.0);
                sheet.text(words, at, Style::plain(SMALL, Align::Centre))?;
                taken = middle + half + 4.0;
            }
        }
        Ok(())
    }

    fn draw_values<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &Frame,
        value: impl Fn(&Column) -> (f64, f64),
    ) -> Result<(), FigureError> {
        let line: Vec<_> = (self.detection.trace.columns().iter())
            .flat_map(|column| {
                let (low, high) = value(column);
                [(column.times.0, low), (column.times.1, high)]
            })
            .map(|(x, y)| frame.at_within(x, y))
            .collect();
        draw_dense(sheet, &line, Look::of(0).colour)
    }

    /// A bar for each of X, Y₁ and Y₂, and a dashed line where the decision was made.
    fn draw_decisions<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        let [upper, lower] = &self.frames;
        for (reported, decision) in &self.decisions {
            let samples = [
                decision.reference,
                Some(decision.shift),
                Some(decision.scale),
            ];
            let placed = samples.into_iter().enumerate();
            for (index, (from, to)) in placed.filter_map(|(index, span)| Some((index, span?))) {
                let y = lower.top + 6.0 + 5.0 * index as f64;
                let ends = [lower.at_within(from, 0.0).0, lower.at_within(to, 0.0).0];
                sheet.line(&ends.map(|x| (x, y)), 2.4, sample_colour(index).into())?;
            }
            let x = lower.at_within(*reported, 0.0).0;
            draw_limit(sheet, x, [upper.top, lower.bottom])?;
        }
        Ok(())
    }
}

impl Picture for Found<'_> {
    fn size(&self) -> (f64, f64) {
        self.frames[1].sheet_size(&self.caption)
    }

    fn draw<B: DrawingBackend>(&self, sheet: &Sheet<B>) -> Result<(), FigureError> {
        sheet.clear(self.size())?;
        self.draw_states(sheet)?;
        let [upper, lower] = &self.frames;
        lower.draw_level(sheet, 0.0, &[])?;
        self.draw_values(sheet, upper, |column| column.record)?;
        self.draw_values(sheet, lower, |column| column.whitened)?;
        self.draw_decisions(sheet)?;
        upper.draw_axes(sheet, "", "record, m/s²")?;
        lower.draw_axes(sheet, "time, s", "whitened, m/s²")?;
        self.legend.draw(sheet, (CAPTION_LEFT, 4.0))?;
        lower.draw_caption(sheet, &self.caption)
    }
}

fn states(detection: &Detection, from: f64, to: f64) -> Vec<Stretch> {
    let mut states = vec![Stretch {
        state: State::Unknown,
        from,
        to,
    }];
    for event in &detection.events {
        if let Kind::Change { state, .. } = event.kind {
            if let Some(last) = states.last_mut() {
                last.to = event.time;
            }
            states.push(Stretch {
                state,
                from: event.time,
                to,
            });
        }
    }
    states.retain(|stretch| stretch.from < stretch.to);
    states
}

fn decisions(detection: &Detection) -> Vec<(f64, Decision)> {
    let decided = detection
        .events
        .iter()
        .filter_map(|event| match event.kind {
            Kind::Change { decision, .. } => Some((event.reported, decision?)),
            Kind::Alarm(_) => None,
        });
    decided.collect()
}

fn is_known(states: &[Stretch], column: &Column) -> bool {
    let mut known = states
        .iter()
        .filter(|stretch| stretch.state != State::Unknown);
    known.any(|stretch| stretch.from <= column.times.0 && column.times.1 <= stretch.to)
}

/// A scale for what was recorded while something was known of the cage: somebody who picks the sensor up
/// would flatten everything else.
fn scale(
    columns: &[Column],
    is_known: impl Fn(&&Column) -> bool,
    above: f64,
    value: impl Fn(&Column) -> (f64, f64),
) -> Scale {
    let known: Vec<_> = columns.iter().filter(&is_known).map(&value).collect();
    let shown = match known.is_empty() {
        true => columns.iter().map(value).collect(),
        false => known,
    };
    let low = shown
        .iter()
        .map(|pair| pair.0)
        .fold(f64::INFINITY, f64::min);
    let high = shown
        .iter()
        .map(|pair| pair.1)
        .fold(f64::NEG_INFINITY, f64::max);
    let room = (high - low).max(1e-9);
    Scale::linear(low - 0.08 * room, high + above * room, 5)
}

fn state_colour(state: State) -> RGBColor {
    match state {
        State::Unknown => RGBColor(232, 232, 232),
        State::Known(phase) => phase_colour(phase.name()),
    }
}

fn state_words(state: State) -> &'static str {
    match state {
        State::Unknown => "unknown",
        State::Known(phase) => phase_words(phase.name()),
    }
}

fn sample_colour(index: usize) -> RGBColor {
    [BLACK, Look::of(1).colour, Look::of(2).colour][index]
}

fn legend() -> Legend {
    let entry = |text: &str, colour: RGBColor, dash: &'static [f64], key: Key| Entry {
        text: text.to_owned(),
        look: Look {
            dash,
            colour,
            ..Look::of(0)
        },
        key,
    };
    let shade = |phase: Phase| {
        let state = State::Known(phase);
        entry(state_words(state), state_colour(state), &[], Key::Shade)
    };
    let sample = |index: usize, name: &str| entry(name, sample_colour(index), &[], Key::Line);
    let entries = vec![
        shade(Phase::Accelerating),
        sample(0, "X"),
        shade(Phase::Inertial),
        sample(1, "Y_1"),
        shade(Phase::Braking),
        sample(2, "Y_2"),
        entry("unknown", state_colour(State::Unknown), &[], Key::Shade),
        entry("decision made", BLACK, &[2.0, 2.0], Key::Line),
    ];
    Legend::new(entries).spread(WIDTH - 2.0 * CAPTION_LEFT)
}

fn caption(detection: &Detection, name: &str) -> Vec<String> {
    let Detection {
        design, knowledge, ..
    } = detection;
    let mut parts = vec![
        literal(name),
        format!("{:.1} Hz", design.rate),
        format!("blocks of {:.0} ms", 1000.0 * design.block),
        format!("N/M_1/M_2 = {}", design.samples),
        format!("α = {}", design.settings.detector.alpha),
    ];
    if let Some(reference) = &knowledge.reference {
        parts.push(format!("filter of order {}", reference.coefficients.len()));
    }
    wrap(&parts, WIDTH - 2.0 * CAPTION_LEFT)
}
