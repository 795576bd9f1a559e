//! The axis of a sweep: where each row stands on it, and what its ticks say.

use super::frame::Scale;
use crate::config::{Config, Parameter};
use crate::results::Row;

/// Values that span more than this are drawn on a logarithmic axis.
pub(super) const LONG_RANGE: f64 = 30.0;

/// Where the rows of a sweep stand on its axis.
pub(super) struct Ruler<'a> {
    config: &'a Config,
    is_logarithmic: bool,
    /// The rules on a rule axis, in order.
    rules: Vec<String>,
}

impl<'a> Ruler<'a> {
    pub fn new(config: &'a Config, rows: &[&Row]) -> Self {
        let mut rules: Vec<String> = Vec::new();
        for row in rows
            .iter()
            .filter(|_| config.axis.parameter == Parameter::Rule)
        {
            if !rules.contains(&row.rule) {
                rules.push(row.rule.clone());
            }
        }
        let values = config.axis.values.iter().filter_map(|value| value.number());
        Self {
            config,
            is_logarithmic: is_long(&values.collect::<Vec<_>>()),
            rules,
        }
    }

    /// Whether places are logarithms.
    pub fn is_logarithmic(&self) -> bool {
        self.is_logarithmic
    }

    /// Whether the axis holds names.
    pub fn is_named(&self) -> bool {
        !self.rules.is_empty()
    }

    /// Of the row at `index` among those of its curve. A curve with a row for each value of the axis
    /// is placed by the values themselves, which a row need not repeat (a known filter has no
    /// training); at rest equal points are told once, and the rows must do.
    pub fn place(&self, rows: &[&Row], index: usize) -> f64 {
        let (row, values) = (rows[index], &self.config.axis.values);
        if !self.rules.is_empty() {
            return self
                .rules
                .iter()
                .position(|rule| *rule == row.rule)
                .unwrap_or(0) as f64;
        }
        let value = match rows.len() == values.len() {
            true => values[index].number().unwrap_or(0.0),
            false => row
                .on_axis(self.config.axis.parameter.name())
                .unwrap_or(0.0),
        };
        if self.is_logarithmic {
            libm::log10(value)
        } else {
            value
        }
    }

    /// From the first place to the last, with a little room on either side.
    pub fn scale(&self, places: &[f64]) -> Scale {
        match self.is_named() {
            true => Scale::names(&self.names()),
            false => around(places, self.is_logarithmic),
        }
    }

    /// The rules without their tables, tables numbered where there are several.
    fn names(&self) -> Vec<String> {
        let is_table = |rule: &&String| rule.starts_with("table");
        let several = self.rules.iter().filter(is_table).count() > 1;
        let mut tables = 0;
        let name = |rule: &String| match (several && is_table(&rule), rule.split('(').next()) {
            (true, _) => {
                tables += 1;
                format!("table {tables}")
            }
            (false, name) => name.unwrap_or_default().to_owned(),
        };
        self.rules.iter().map(name).collect()
    }
}

/// Whether values span so much that their logarithms are drawn.
pub(super) fn is_long(values: &[f64]) -> bool {
    let (smallest, largest) = ends(values);
    smallest > 0.0 && largest >= LONG_RANGE * smallest
}

/// The scale of numbers, or of their logarithms, with a little room on either side.
pub(super) fn around(places: &[f64], is_logarithmic: bool) -> Scale {
    let (low, high) = ends(places);
    let room = 0.025 * (high - low);
    let scale = match is_logarithmic {
        _ if low == high => return Scale::single(low),
        true => Scale::logarithms(low, high),
        false => Scale::linear(low, high, 7),
    };
    Scale {
        from: low - room,
        to: high + room,
        ..scale
    }
}

fn ends(values: &[f64]) -> (f64, f64) {
    let values = || values.iter().copied();
    (
        values().fold(f64::INFINITY, f64::min),
        values().fold(f64::NEG_INFINITY, f64::max),
    )
}
