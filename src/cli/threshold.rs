//! `liftsim threshold`: C_W(T) and the exact size of a rule, or the threshold of a rate of false alarms.

use super::output::{self, Output};
use super::per_hour::PerHour;
use super::rows::{FormatArguments, Rows, Shown, pretty};
use super::{CommandResult, Failure, table};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{ArgGroup, Args};
use liftsim::detect::{Alternative, Exceedances, NullLaws, Region, Rule, Samples};
use liftsim::study::plane;
use liftsim::values::Size;
use serde_json::{Value, json};
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

/// Print the threshold C_W(T) of a rule and its exact false-alarm rate, or that of so many false alarms an hour.
///
/// X is the reference at rest, Y1 the sample tested for a shift, Y2 the one tested for its scale.
/// The rule decides that the lift moves where the rank sum W reaches C_W(T) for the T exceedances
/// seen.
///
/// With --per-hour it is the threshold of another detector, which watches block after block: each is ranked among all since
/// a reference of N blocks began, and a CUSUM of the ranks' scores alarms where it reaches the threshold. Its false alarms
/// at rest are exactly known whatever the noise is, as long as blocks do not depend on each other. Printed with it: the
/// mean time between false alarms, the time before which the first comes with a given probability, and how long after a
/// shift of normal noise it alarms; if it looks for vibration, also how long after a growth of the deviation.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("three samples").args(["shift", "scale", "alpha", "rule", "exceedances", "alternative"]).multiple(true))]
pub struct Threshold {
    /// N, the size of X; with --per-hour the blocks of the reference, 300 if not given.
    #[arg(long, value_name = "N", value_parser = size, allow_negative_numbers = true, required_unless_present = "per_hour")]
    reference: Option<usize>,
    /// M1, the size of Y1.
    #[arg(long, value_name = "M1", value_parser = size, allow_negative_numbers = true, required_unless_present = "per_hour")]
    shift: Option<usize>,
    /// M2, the size of Y2.
    #[arg(long, value_name = "M2", value_parser = size, allow_negative_numbers = true, required_unless_present = "per_hour")]
    scale: Option<usize>,
    /// The level: the rule's false-alarm rate is at most this.
    #[arg(
        long,
        value_name = "A",
        allow_negative_numbers = true,
        required_unless_present = "per_hour"
    )]
    alpha: Option<f64>,
    /// How the region is filled.
    #[arg(long, value_name = "R", value_parser = one_of(&RULES), default_value = "product")]
    rule: Rule,
    /// Whose exceedances of the range of X are counted.
    #[arg(long, value_name = "OF", value_parser = one_of(&EXCEEDANCES), default_value = "scale")]
    exceedances: Exceedances,
    /// The sign of the acceleration that it looks for.
    #[arg(long, value_name = "SIGN", value_parser = one_of(&ALTERNATIVES), default_value = "greater")]
    alternative: Alternative,
    #[command(flatten)]
    format: FormatArguments,
    #[command(flatten)]
    per_hour: PerHour,
    /// Draw the plane of W and T with the region in it, or the delay against the shift.
    #[arg(long, value_name = "FILE.png|FILE.svg")]
    figure: Option<PathBuf>,
    /// Replace a figure that exists.
    #[arg(long, requires = "figure")]
    force: bool,
}

/// A name on the command line, its meaning, and its line in the help.
pub(super) type Choice<T> = (&'static str, T, &'static str);

static RULES: [Choice<Rule>; 4] = [
    ("wilcoxon", Rule::Wilcoxon, "W alone"),
    ("product", Rule::Product, "The product of both p-values"),
    ("disjunction", Rule::Disjunction, "Either statistic"),
    ("conjunction", Rule::Conjunction, "Both statistics"),
];

static EXCEEDANCES: [Choice<Exceedances>; 2] = [
    ("scale", Exceedances::Scale, "T, of Y2, as the paper has it"),
    ("motion", Exceedances::Motion, "T', of Y1 and Y2"),
];

static ALTERNATIVES: [Choice<Alternative>; 3] = [
    ("greater", Alternative::Greater, "Upwards"),
    ("less", Alternative::Less, "Downwards"),
    ("two-sided", Alternative::TwoSided, "Either way"),
];

/// Reads one of the names.
pub(super) fn one_of<T: Clone + Send + Sync>(
    choices: &'static [Choice<T>],
) -> impl TypedValueParser<Value = T> {
    let names = choices
        .iter()
        .map(|(name, _, help)| PossibleValue::new(*name).help(*help));
    PossibleValuesParser::new(names).map(|name| {
        let chosen = choices.iter().find(|(known, ..)| *known == name);
        chosen.expect("no other name is possible").1.clone()
    })
}

fn size(text: &str) -> Result<usize, Box<dyn Error + Send + Sync>> {
    Ok(Size::new(text.parse()?)?.get())
}

impl Threshold {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let figure = self.figure.as_ref();
        let figure = figure.map(|path| Output::picture("--figure", path, self.force));
        let figure = figure.transpose()?;
        let (Some(n), Some(m1), Some(m2), Some(alpha)) =
            (self.reference, self.shift, self.scale, self.alpha)
        else {
            return self.per_hour.run(self.reference, &self.format, figure);
        };
        let samples = Samples::contiguous(n, m1, m2).map_err(Failure::input)?;
        let (rule, alternative) = (&self.rule, self.alternative);
        let laws =
            NullLaws::new(self.exceedances, alternative, &samples).map_err(Failure::input)?;
        let region = laws.region(rule, alpha).map_err(Failure::input)?;
        let found = Found {
            flags: &self,
            samples: &samples,
            alpha,
            laws: &laws,
            region: &region,
        };
        let text = self.format.show(&found);
        if let Some(figure) = figure {
            let title = plane::title(&samples, alternative, alpha);
            let plot = plane::plot(&laws, &plane::boundary(rule, &region), &title);
            let origin = format!("rule {rule}, {}", title.join("; "));
            figure.draw(&plot, &origin)?.publish()?;
        }
        output::print_beside(self.figure.iter(), &text)?;
        Ok(ExitCode::SUCCESS)
    }
}

/// The region of a rule.
struct Found<'a> {
    flags: &'a Threshold,
    samples: &'a Samples,
    alpha: f64,
    laws: &'a NullLaws,
    region: &'a Region,
}

const COLUMNS: [&str; 6] = [
    "exceedances",
    "probability",
    "lower",
    "upper",
    "rank_sum_probability",
    "size",
];

impl Found<'_> {
    fn facts(&self) -> Value {
        let Self {
            flags,
            laws,
            region,
            ..
        } = self;
        let conditional = laws.conditional_sizes(region);
        let critical: Vec<_> = (0..)
            .zip(region.critical_values())
            .map(|(t, (lower, upper))| {
                json!({
                    "exceedances": t,
                    "probability": laws.exceedances().mass(t),
                    "lower": lower,
                    "upper": upper,
                    "rank_sum_probability": conditional[t as usize],
                })
            })
            .collect();
        json!({
            "reference": self.samples.reference(),
            "shift": self.samples.shift(),
            "scale": self.samples.scale(),
            "alpha": self.alpha,
            "rule": flags.rule.to_string(),
            "exceedances": flags.exceedances.to_string(),
            "alternative": flags.alternative.to_string(),
            "size": region.size(),
            "critical": critical,
        })
    }
}

impl Shown for Found<'_> {
    fn text(&self) -> String {
        let Self {
            flags,
            samples,
            alpha,
            laws,
            region,
        } = self;
        let bound = |bound: Option<u64>| bound.map_or("never".to_owned(), |w| w.to_string());
        let critical = |(lower, upper): (Option<u64>, Option<u64>)| match flags.alternative {
            Alternative::Greater => bound(upper),
            Alternative::Less => bound(lower),
            Alternative::TwoSided => match (lower, upper) {
                (Some(lower), Some(upper)) => format!("{lower} or {upper}"),
                (None, Some(upper)) => format!("{upper}"),
                _ => "never".to_owned(),
            },
        };
        let rows: Vec<Vec<String>> = (region
            .critical_values()
            .into_iter()
            .zip(laws.conditional_sizes(region)))
        .enumerate()
        .map(|(t, (values, conditional))| {
            let mass = laws.exceedances().mass(t as u64);
            vec![
                t.to_string(),
                probability(mass),
                critical(values),
                probability(conditional),
            ]
        })
        .collect();
        let t = flags.exceedances.symbol();
        let name = match flags.alternative {
            Alternative::Greater => "W >=",
            Alternative::Less => "W <=",
            Alternative::TwoSided => "W <= or >=",
        };
        format!(
            "rule {}, exceedances of {}, alternative {}, N/M1/M2 = {samples}, alpha = {alpha}\n\n{}\nexact size {}\n",
            flags.rule,
            flags.exceedances.samples().replace('_', ""),
            flags.alternative,
            table(
                &[t, &format!("P({t})"), name, &format!("P(H1* | {t})")],
                &rows
            ),
            region.size(),
        )
    }

    fn json(&self) -> String {
        pretty(&self.facts())
    }

    fn rows(&self) -> Rows {
        let facts = self.facts();
        let critical = facts["critical"].as_array();
        Rows::of(&COLUMNS, critical.map_or(&[], Vec::as_slice), &facts)
    }
}

/// Nine decimals where they say something, a power of ten where they do not.
fn probability(p: f64) -> String {
    if p >= 1e-6 || p == 0.0 {
        format!("{p:.9}")
    } else {
        format!("{p:.4e}")
    }
}
