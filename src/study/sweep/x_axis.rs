//! The axis of a sweep: where each row stands on it, and what its ticks say.

use crate::claim;
use crate::plot::{Axis, is_long};
use crate::results::Row;
use crate::scenario::{Parameter, parameter};

/// The places of a sweep's rows on its axis.
pub(super) struct XAxis {
    pub parameter: &'static Parameter,
    /// The swept values, if they are numbers.
    values: Vec<f64>,
    is_logarithmic: bool,
    /// The rules on a rule axis, in order.
    rules: Vec<String>,
}

impl XAxis {
    pub fn new(axis: &claim::Axis, rows: &[&Row]) -> Self {
        let parameter = parameter(axis.name).expect("the axis is a parameter");
        let values: Vec<f64> = axis
            .values
            .iter()
            .filter_map(|(_, number)| *number)
            .collect();
        let mut rules: Vec<String> = Vec::new();
        for row in rows.iter().filter(|_| parameter.name == "rule") {
            let rule = row.values.text("rule");
            if !rules.contains(&rule) {
                rules.push(rule);
            }
        }
        Self {
            parameter,
            is_logarithmic: is_long(&values),
            values,
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

    /// The place of the row at `index` among those of its curve. A curve with a row for each value of the
    /// axis is placed by these values, because a row need not repeat them (a known filter has no training).
    /// At rest equal points are written once, so such a curve is placed by its rows.
    pub fn place(&self, rows: &[&Row], index: usize) -> f64 {
        let row = rows[index];
        if self.is_named() {
            let own = row.values.text("rule");
            let rule = self.rules.iter().position(|rule| *rule == own);
            return rule.unwrap_or(0) as f64;
        }
        let value = if rows.len() == self.values.len() {
            self.values[index]
        } else {
            row.on_axis(self.parameter).unwrap_or(0.0)
        };
        if self.is_logarithmic {
            libm::log10(value)
        } else {
            value
        }
    }

    /// From the first place to the last, with a little room on either side.
    pub fn axis(&self, places: impl Iterator<Item = f64>) -> Axis {
        if self.is_named() {
            Axis::names(self.names())
        } else {
            Axis::around(places, self.is_logarithmic)
        }
    }

    /// The rules without their tables. Tables are numbered if there are several.
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
