//! What a picture says: panels with their axes, marks in data, a legend and a caption. Values without
//! pixels, so that a test can look at them.
//!
//! `layout` puts a [`Plot`] on a [`Canvas`]: lines, areas and texts in points (1/72 inch). It finds a place
//! for the legend that covers no data, and refuses a plot whose texts would be cut off.

#![allow(missing_docs, reason = "fields are called what they are")]

mod axis;
mod canvas;
mod curves;
mod draw;
mod frame;
mod layout;
mod legend;
mod mark;
mod options;
mod overlay;
mod phases;
mod picture;
mod placed;
mod resize;
mod scale;
mod style;
mod text;
mod window;

pub use axis::{Axis, LONG_RANGE, ends, is_long, power_of_ten};
pub use canvas::{Canvas, Shape, Text, rounded};
pub use curves::{Curve, add_bands, add_bars};
pub use layout::{LayoutError, layout};
pub use legend::{Entry, Key, Legend, Place};
pub use mark::{Block, Cell, Limit, Mark, Point};
pub use options::{ColourName, Dpi, Format, Height, LegendPlace, Options, OptionsError, Width};
pub use overlay::{Overlay, OverlayError};
pub use phases::{add_phases, hatch, phase_colour, phase_words};
pub use picture::{Margins, Panel, Plot, WIDTH};
pub use scale::Scale;
pub use style::{Colour, Marker, Style};
pub use text::{font, literal, text_width};

#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_of_options;
