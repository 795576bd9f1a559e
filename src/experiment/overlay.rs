//! Curves along an axis. A point's parameters are file ⊕ curve ⊕ axis value, and later values replace earlier
//! ones.

use crate::config::{Axis, AxisValue, Conflict, Node, Value};
use crate::rule::OutOfRange;
use serde::Deserialize;

/// The keys of a curve, and its parameters laid over those of the file.
#[derive(Clone, Debug)]
pub struct Laid {
    /// The label that distinguishes the curve from the others. The default is its number.
    pub label: String,
    /// The keys of the curve's table that are not parameters.
    pub header: Node,
    /// Every parameter that the file or the curve sets. The curve's values replace those of the file.
    pub values: Node,
}

/// An axis, and curves that change the parameters of a table.
#[derive(Clone, Debug)]
pub struct Overlay {
    /// The axis: the name and values that are swept.
    pub axis: Axis,
    /// The curves. There is at least one.
    pub curves: Vec<Laid>,
    /// The parameters that the axis sets.
    paths: Vec<String>,
}

/// The meaning of a table's keys to an overlay.
pub struct Keys<'a> {
    /// The text before a key in messages, such as `ride.`.
    pub prefix: &'static str,
    /// The names that an axis may sweep, each with the paths that it sets.
    pub swept: &'a [(&'static str, Vec<&'static str>)],
    /// Whether a key of the table, or of a curve, is a parameter or a section of parameters.
    pub is_parameter: &'a dyn Fn(&str) -> bool,
    /// Groups of alternative parameters. Setting one parameter of a group replaces the others.
    pub choices: &'a [&'a [&'a str]],
    /// The part of a label that must differ from that of every other label.
    pub name: fn(&str) -> String,
}

/// The largest number of curves. A config with more curves is taken for a mistake.
const MOST_CURVES: usize = 1000;
/// The largest number of points. A config with more points is taken for a mistake, too.
const MOST_POINTS: usize = 20_000;

impl Overlay {
    /// Reads the keys `axis` and `curve` of a table.
    ///
    /// # Errors
    /// If the axis is not valid, a curve has no label of its own, or a parameter is both swept and set.
    pub fn read(table: &Node, keys: &Keys) -> Result<Self, Conflict> {
        let nothing = Node::empty(table.span.clone());
        let axis = table.get("axis").unwrap_or(&nothing);
        let axis = Axis::read(axis, keys.swept.iter().map(|(name, _)| *name))?;
        let paths = keys.swept.iter().find(|(name, _)| *name == axis.name);
        let paths = paths.map_or(&[][..], |(_, paths)| &paths[..]);
        let mut overlay = Self {
            paths: paths.iter().map(|path| String::from(*path)).collect(),
            curves: Vec::new(),
            axis,
        };
        let base = table.only(keys.is_parameter);
        overlay.check_free(&base, keys)?;
        let curves = curve_tables(table, keys.prefix)?;
        overlay.check_points(curves.len())?;
        for curve in curves {
            let own = curve.only(keys.is_parameter);
            overlay.check_free(&own, keys)?;
            overlay.curves.push(Laid {
                label: overlay.label(&curve, keys)?,
                header: curve.only(|key| !(keys.is_parameter)(key)),
                values: own.over(&base, keys.choices),
            });
        }
        Ok(overlay)
    }

    /// The parameters of a curve (from 0) at a value of the axis.
    pub fn at(&self, curve: usize, value: &AxisValue) -> Node {
        let mut laid = self.curves[curve].values.clone();
        for path in &self.paths {
            laid.set(path, value.0.clone());
        }
        laid
    }

    fn check_points(&self, curves: usize) -> Result<(), Conflict> {
        let points = curves * self.axis.values.len();
        if points <= MOST_POINTS {
            return Ok(());
        }
        let unfit = OutOfRange::new("points", format!("be at most {MOST_POINTS}"), points);
        let remedy = " (take fewer curves or values)";
        Err(Conflict::at(&self.axis.span, unfit.explained(remedy)))
    }

    /// Checks that `values` does not set the swept parameter, neither itself nor an alternative to it.
    fn check_free(&self, values: &Node, keys: &Keys) -> Result<(), Conflict> {
        let rivals = |path: &String| {
            let choice = keys
                .choices
                .iter()
                .find(|choice| choice.contains(&&path[..]));
            choice.map_or(vec![path.clone()], |choice| {
                choice.iter().map(|path| String::from(*path)).collect()
            })
        };
        let mut paths = self.paths.iter().flat_map(rivals);
        match paths.find_map(|path| values.get(&path)) {
            Some(node) => Err(Conflict::at(&node.span, self.axis.swept_and_set())),
            None => Ok(()),
        }
    }

    /// Reads the label of the next curve.
    fn label(&self, curve: &Node, keys: &Keys) -> Result<String, Conflict> {
        let number = self.curves.len();
        let path = format!("{}curve[{number}].label", keys.prefix);
        let Some(node) = curve.get("label") else {
            return self.distinct((number + 1).to_string(), &path, curve, keys);
        };
        let label = String::deserialize(node)
            .map_err(|refusal| Conflict::at(&node.span, refusal.within(&path)))?;
        if label.contains(char::is_control) {
            // It is a cell of tables.
            let unfit = OutOfRange::new(path, "be one line", format_args!("{label:?}"));
            return Err(Conflict::at(&node.span, unfit));
        }
        self.distinct(label, &path, node, keys)
    }

    fn distinct(
        &self,
        label: String,
        path: &str,
        place: &Node,
        keys: &Keys,
    ) -> Result<String, Conflict> {
        let name = (keys.name)(&label);
        let is_known = |other: &Laid| (keys.name)(&other.label) == name;
        if !name.is_empty() && !self.curves.iter().any(is_known) {
            return Ok(label);
        }
        let rule = "be there and differ from every other";
        let unfit = OutOfRange::new(path, rule, format_args!("\"{label}\""));
        Err(Conflict::at(&place.span, unfit))
    }
}

/// The tables under `curve`, or one plain curve if there are no tables.
fn curve_tables(table: &Node, prefix: &str) -> Result<Vec<Node>, Conflict> {
    let plain = || Ok(vec![Node::empty(table.span.clone())]);
    let Some((span, node)) = table.table().and_then(|entries| entries.get("curve")) else {
        return plain();
    };
    let path = format!("{prefix}curve");
    match &node.value {
        Value::List(list) if list.is_empty() => plain(),
        Value::List(list) if list.len() > MOST_CURVES => {
            let rule = format!("be at most {MOST_CURVES} curves");
            Err(Conflict::at(
                &node.span,
                OutOfRange::new(path, rule, list.len()),
            ))
        }
        Value::List(list) => Ok(list.clone()),
        _ => {
            let rule = "be a list (write [[curve]] for [curve])";
            Err(Conflict::at(
                span,
                OutOfRange::new(path, rule, "a single one"),
            ))
        }
    }
}
