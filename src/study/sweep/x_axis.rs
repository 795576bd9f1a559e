//! The axis of a sweep: where each row stands on it, and what its ticks say.

use super::picture::Sweep;
use crate::plot::{Axis, is_long};
use crate::results::Row;

/// Where the rows of a sweep stand on its axis.
pub(super) struct XAxis<'a> {
    sweep: &'a Sweep,
    is_logarithmic: bool,
    /// The rules on a rule axis, in order.
    rules: Vec<String>,
}

impl<'a> XAxis<'a> {
    pub fn new(sweep: &'a Sweep, rows: &[&Row]) -> Self {
        let mut rules: Vec<String> = Vec::new();
        for row in rows.iter().filter(|_| sweep.axis.name == "rule") {
            let rule = row.values.text("rule");
            if !rules.contains(&rule) {
                rules.push(rule);
            }
        }
        Self {
            sweep,
            is_logarithmic: is_long(&sweep.values),
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
    /// training); at rest equal points are written once, and the rows must do.
    pub fn place(&self, rows: &[&Row], index: usize) -> f64 {
        let (row, values) = (rows[index], &self.sweep.values);
        if self.is_named() {
            let own = row.values.text("rule");
            let rule = self.rules.iter().position(|rule| *rule == own);
            return rule.unwrap_or(0) as f64;
        }
        let value = match rows.len() == values.len() {
            true => values[index],
            false => row.on_axis(self.sweep.axis).unwrap_or(0.0),
        };
        if self.is_logarithmic {
            libm::log10(value)
        } else {
            value
        }
    }

    /// From the first place to the last, with a little room on either side.
    pub fn axis(&self, places: impl Iterator<Item = f64>) -> Axis {
        match self.is_named() {
            true => Axis::names(self.names()),
            false => Axis::around(places, self.is_logarithmic),
        }
    }

    /// The rules without their tables, tables numbered where there are several.
    fn names(&self) -> Vec<String> {
        let is_table = |rule: &&String| rule.starts_with("table");
        let several = self.rules.iter().filter(is_table).count() > 1;
        let mut tables = 0;
        let name = |rule: &String| {
            if several && is_table(&rule) {
                tables += 1;
                return format!("table {tables}");
            }
            rule.split('(').next().unwrap_or_default().to_owned()
        };
        self.rules.iter().map(name).collect()
    }
}
