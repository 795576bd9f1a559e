//! The places of the three samples of a trial, Fig. 5 of [^1], relative to the phases of the motion.
//!
//! Positions count observations from the first one after X, where the motion may start.
//!
//! [^1]: see [`crate::signal`].

pub(super) mod picture;
mod row;

pub use row::Row;

use crate::chain::Scenario;
use crate::config::Conflict;
use crate::counts::Counts;
use crate::experiment::Experiment;
use crate::figure::FigureError;
use crate::plot::Plot;
use crate::rule::OutOfRange;
use crate::run::{Identity, StudyError};
use crate::study::kind::{Context, Study};
use schemars::{JsonSchema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;

/// Where X, Y₁ and Y₂ lie; a table without keys.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Keys {}

/// The samples of a scenario.
pub(super) struct Layout(Scenario);

/// The most observations. A longer layout cannot be drawn.
const LONGEST: usize = 1_000_000;

impl Layout {
    fn check(&self) -> Result<(), Conflict> {
        let training = self.0.whitening.training;
        let length = self.0.samples.span().saturating_add(training);
        if length <= LONGEST {
            return Ok(());
        }
        let rule = format!("span at most {LONGEST} observations");
        Err(OutOfRange::new("layout.samples", rule, length).into())
    }
}

impl Study for Layout {
    const NAME: &'static str = "layout";
    const USES: &'static [&'static str] = &[
        "motion.profile",
        "motion.duration",
        "motion.offset",
        "whitening",
        "samples.reference",
        "samples.shift",
        "samples.scale",
        "samples.gap",
    ];
    const COUNTS_TRIALS: bool = false;
    type Row = Row;

    fn read(experiment: &Experiment, _context: Context) -> Result<Self, StudyError> {
        let Keys {} = experiment.read()?;
        let study = Self(experiment.scenario()?);
        (study.check()).map_err(|conflict| experiment.conflict(conflict))?;
        Ok(study)
    }

    fn schema(generator: &mut SchemaGenerator) -> Value {
        Keys::json_schema(generator).to_value()
    }

    fn identities(&self) -> Vec<Identity> {
        let Scenario {
            motion,
            whitening,
            samples,
            ..
        } = &self.0;
        vec![Identity::new([
            ("samples", samples.to_string()),
            ("gap", samples.gap().to_string()),
            ("duration", motion.duration.to_string()),
            ("offset", motion.offset.to_string()),
            ("profile", motion.profile.to_string()),
            ("training", whitening.training.to_string()),
            (
                "includes_reference",
                whitening.includes_reference.to_string(),
            ),
        ])]
    }

    fn rows(&self, _counts: &Counts) -> Vec<Row> {
        rows(&self.0)
    }

    fn plot(&self, rows: &[Row], _seed: u64) -> Result<Plot, FigureError> {
        Ok(picture::plot(rows, &self.0))
    }
}

/// The phases, then the samples, each in the order of time. Empty ones are left out.
fn rows(scenario: &Scenario) -> Vec<Row> {
    let samples = &scenario.samples;
    let from_motion = |position: usize| position as i64 - samples.reference() as i64;
    let (shift, scale) = (samples.shift_range(), samples.scale_range());
    let end = from_motion(scale.end);
    let first = from_motion(0);
    let training = if scenario.whitening.includes_reference {
        -(scenario.whitening.training as i64)
    } else {
        first - scenario.whitening.training as i64
    };
    let training_end = if scenario.whitening.includes_reference {
        0
    } else {
        first
    };
    let start = scenario.motion.offset as i64;
    let stop = start.saturating_add(scenario.motion.duration as i64);
    let stretches = [
        ("rest", training.min(first), start.min(end)),
        ("acceleration", start.min(end), stop.min(end)),
        ("inertial", stop.min(end), end),
        ("training", training, training_end),
        ("reference", first, 0),
        ("gap", 0, from_motion(shift.start)),
        ("shift", from_motion(shift.start), from_motion(shift.end)),
        ("gap", from_motion(shift.end), from_motion(scale.start)),
        ("scale", from_motion(scale.start), end),
    ];
    let there = stretches.into_iter().filter(|(_, start, end)| start < end);
    there
        .map(|(name, start, end)| Row {
            name: name.to_owned(),
            start,
            end,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::tests::read;

    fn layout(rest: &str) -> Vec<(String, i64, i64)> {
        let text = format!("question = \"?\"\nseed = 1\n[layout]\n{rest}");
        let rows = rows(&read::<Layout>(&text).0).into_iter();
        rows.map(|row| (row.name, row.start, row.end)).collect()
    }

    fn stretch(name: &str, start: i64, end: i64) -> (String, i64, i64) {
        (name.to_owned(), start, end)
    }

    #[test]
    fn contiguous() {
        let expected = [
            stretch("rest", -268, 0),
            stretch("acceleration", 0, 12),
            stretch("inertial", 12, 24),
            stretch("training", -268, -12),
            stretch("reference", -12, 0),
            stretch("shift", 0, 12),
            stretch("scale", 12, 24),
        ];
        assert_eq!(layout(""), expected);
    }

    #[test]
    fn gaps_offsets_and_the_known_mistake() {
        let rest = "[samples]\nreference = 4\nshift = 3\nscale = 2\ngap = 1\n\
                    [motion]\noffset = 1\nduration = 2\n\
                    [whitening]\ntraining = 10\nincludes_reference = true\n";
        let expected = [
            stretch("rest", -10, 1),
            stretch("acceleration", 1, 3),
            stretch("inertial", 3, 7),
            stretch("training", -10, 0),
            stretch("reference", -4, 0),
            stretch("gap", 0, 1),
            stretch("shift", 1, 4),
            stretch("gap", 4, 5),
            stretch("scale", 5, 7),
        ];
        assert_eq!(layout(rest), expected);
    }
}
