//! A picture's text about its curves: legend, axis and caption, all from the rows themselves.
//!
//! Every parameter is a [`Fact`] in the words of the table of parameters. The caption states what all points
//! share, except for usual defaults. The legend states how the curves differ.

use crate::format::thousands;
use crate::plot::{Mark, Panel, Plot, Point, Style, literal};
use crate::results::Row;
use crate::scenario::{Caption, PARAMETERS, Parameter, Words};

/// One parameter in words.
#[derive(Clone)]
pub(super) struct Fact {
    parameter: &'static Parameter,
    text: String,
    /// Whether a caption may leave it out.
    is_usual: bool,
}

/// The facts of a row, always the same ones in the same order.
fn facts(row: &Row) -> Vec<Fact> {
    let mut captions: Vec<(&Parameter, &Caption)> = PARAMETERS
        .iter()
        .filter_map(|parameter| Some((parameter, parameter.caption.as_ref()?)))
        .collect();
    captions.sort_by_key(|(_, caption)| caption.place);
    captions
        .into_iter()
        .map(|(parameter, caption)| {
            let value = row.values.text(parameter.name);
            Fact {
                parameter,
                text: match caption.words {
                    Words::Template(words) => words.replace("{}", &literal(&value)),
                    Words::Of(words) => words(&row.values),
                },
                is_usual: caption.usual.holds(&value, &row.values, row.is_at_rest()),
            }
        })
        .collect()
}

/// The facts that more than two thirds of the rows share. If a curve has a name, all rows must share them,
/// because a name need not say how its curve differs.
pub(super) fn common_facts(rows: &[&Row]) -> Vec<Option<Fact>> {
    let is_named = rows.iter().any(|row| row.label.parse::<f64>().is_err());
    let table: Vec<Vec<Fact>> = rows.iter().map(|row| facts(row)).collect();
    let common = |index: usize| {
        let column = || table.iter().map(move |facts| &facts[index]);
        let is_common = |fact: &&Fact| {
            let agreeing = column().filter(|other| other.text == fact.text).count();
            if is_named {
                agreeing == table.len()
            } else {
                3 * agreeing > 2 * table.len()
            }
        };
        column().find(is_common).cloned()
    };
    (0..table.first().map_or(0, Vec::len)).map(common).collect()
}

/// The legend of a curve. A label that is not a number stays alone. A number is followed by the facts
/// that the curve does not share with most others.
pub(super) fn legend(rows: &[&Row], common: &[Option<Fact>], axis: &Parameter) -> String {
    let label = literal(&rows[0].label);
    if rows[0].label.parse::<f64>().is_err() {
        return label;
    }
    let table: Vec<Vec<Fact>> = rows.iter().map(|row| facts(row)).collect();
    let tells_apart = |(index, fact): &(usize, &Fact)| {
        let is_common = common[*index]
            .as_ref()
            .is_some_and(|common| common.text == fact.text);
        let is_constant = table.iter().all(|facts| facts[*index].text == fact.text);
        !fact.is_usual && !fact.parameter.is_said_by(axis) && is_constant && !is_common
    };
    let here = table[0].iter().enumerate().filter(tells_apart);
    let parts: Vec<&str> = here.map(|(_, fact)| fact.text.as_str()).collect();
    if parts.is_empty() {
        return label;
    }
    format!("{label}:  {}", parts.join(", "))
}

/// The parts of a caption: what most points share, and what the bands show.
pub(super) fn caption(
    rows: &[&Row],
    common: Vec<Option<Fact>>,
    axis: &Parameter,
    seed: u64,
) -> Vec<String> {
    let row = rows[0];
    let common = common.into_iter().flatten();
    let shown = common.filter(|fact| !fact.is_usual && !fact.parameter.is_said_by(axis));
    let mut parts: Vec<String> = shown.map(|fact| fact.text).collect();
    if let Some(size) = row
        .size
        .filter(|_| rows.iter().all(|other| other.size == row.size))
    {
        parts.insert(1.min(parts.len()), format!("exact size {size:.6}"));
    }
    parts.push(format!("{} trials per point", thousands(row.tally.trials)));
    parts.push(format!("seed {seed}"));
    parts
}

/// What the bands or bars of a plot are, and whether they can be seen.
pub(super) fn intervals(plot: &Plot, confidence: f64) -> String {
    let words = format!("pointwise exact {} % intervals", 100.0 * confidence);
    let (mut name, mut seen, mut all) = ("bands", 0, 0);
    for (panel, mark) in &plot.marks {
        let (points, least) = match mark {
            Mark::Band(points, _) => (points, LINE),
            Mark::Bars(points, style) => {
                name = "bars";
                (points, 2.0 * style.size)
            }
            _ => continue,
        };
        let Panel { y, height, .. } = &plot.panels[*panel];
        let high = |point: &&Point| height * (y.share(point.high) - y.share(point.low)) > least;
        seen += points.iter().filter(high).count();
        all += points.len();
    }
    match (seen, name) {
        (0, "bars") => format!("{words} are narrower than the markers"),
        (0, _) => format!("{words} are narrower than the lines"),
        (seen, _) if seen == all => format!("{name}: {words}"),
        (_, "bars") => format!("bars: {words}, at times narrower than a marker"),
        _ => format!("bands: {words}, at times narrower than a line"),
    }
}

/// The width of a curve's line, points.
const LINE: f64 = Style::of(0).width;

/// Whether these are false-alarm rates of one level.
pub(super) fn is_held_against_alpha(rows: &[&Row]) -> bool {
    rows.iter()
        .all(|row| row.is_at_rest() && row.alpha() == rows[0].alpha())
}

/// The label of the axis.
pub(super) fn axis_label(parameter: &Parameter, is_whitened: bool) -> &'static str {
    if is_whitened && parameter.name == "delta" {
        return WHITENED_DELTA;
    }
    parameter.axis_label
}

/// The label of Δ after whitening.
pub(super) const WHITENED_DELTA: &str = "Δ(1 − β)/σ_ξ, the shift after whitening";
