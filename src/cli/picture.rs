//! Pictures of results: what a config and its rows say to the plots.

use super::Failure;
use liftsim::experiment::{Config, ExhibitConfig, ExhibitKind};
use liftsim::detect::NullLaws;
use liftsim::exhibit::Rows;
use liftsim::figure::autocorrelation::Records;
use liftsim::figure::curves::{Sweep, SweepCurve};
use liftsim::figure::ride::Rides;
use liftsim::figure::{self, Drawing, FigureError};
use liftsim::plot::Plot;
use liftsim::results::{Manifest, Row};

/// Draws a sweep: power, or false-alarm rate where nothing moves, against the axis.
pub fn sweep(config: &Config, rows: &[Row], manifest: &Manifest) -> Result<Drawing, Failure> {
    let values = &config.axis.values;
    let curve = |(index, curve): (usize, &liftsim::experiment::Curve)| {
        let scenario = values
            .first()
            .and_then(|value| config.scenario(index, value).ok());
        SweepCurve {
            panel: curve.panel.clone(),
            series: curve.series.clone(),
            step_gain: scenario.map(|scenario| scenario.sensor.step_gain()),
        }
    };
    let sweep = Sweep {
        axis: config.axis.parameter,
        values: values.iter().filter_map(|value| value.number()).collect(),
        curves: config.curves.iter().enumerate().map(curve).collect(),
    };
    let plot = figure::curves::plot(&sweep, rows, manifest.seed);
    let drawing = plot.and_then(|plot| figure::render(&plot, &provenance(manifest)));
    drawing.map_err(Failure::run)
}

/// Draws an experiment that is no sweep, from its rows.
pub fn exhibit(
    config: &ExhibitConfig,
    rows: &Rows,
    manifest: &Manifest,
) -> Result<Drawing, Failure> {
    let plot = plot(config, rows, manifest.seed);
    let drawing = plot.and_then(|plot| figure::render(&plot, &provenance(manifest)));
    drawing.map_err(Failure::run)
}

fn plot(config: &ExhibitConfig, rows: &Rows, seed: u64) -> Result<Plot, FigureError> {
    let (scenario, confidence) = (&config.scenario, config.confidence);
    Ok(match (&config.kind, rows) {
        _ if rows.is_empty() => return Err(FigureError::NoRows(config.kind.name())),
        (ExhibitKind::Autocorrelation { length, .. }, Rows::Autocorrelation(rows)) => {
            let records = Records {
                sensor: &scenario.sensor,
                noise: &scenario.noise,
                trials: config.trials,
                length: *length,
                confidence,
                seed,
            };
            figure::autocorrelation::plot(rows, &records)
        }
        (ExhibitKind::Trace(trace), Rows::Trace(rows)) => {
            figure::trace::plot(rows, trace, scenario, seed)
        }
        (_, Rows::Layout(rows)) => figure::layout::plot(rows, scenario),
        (_, Rows::Region(rows)) => {
            let (samples, detector) = (&scenario.samples, &scenario.detector);
            let laws = NullLaws::new(detector.alternative, samples)?;
            let title = figure::region::title(samples, detector.alternative, detector.alpha);
            figure::region::plot(&laws, rows, &title)
        }
        (_, Rows::Independence(rows)) => figure::independence::plot(rows),
        (_, Rows::OperatingPoint(rows)) => figure::operating_point::plot(rows, scenario, seed),
        (_, Rows::ImpulseLaw(rows)) => figure::impulse_law::plot(rows, confidence, seed),
        (ExhibitKind::Ride(study), Rows::Ride(rows)) => {
            let labels: Vec<_> = study
                .curves
                .iter()
                .map(|curve| curve.label.clone())
                .collect();
            let rides = Rides {
                measure: study.measure,
                axis: study.axis,
                labels: &labels,
                seed,
            };
            figure::ride::plot(rows, &rides)
        }
        _ => return Err(FigureError::NoRows(config.kind.name())),
    })
}

/// What made a picture, for whoever finds it alone.
fn provenance(manifest: &Manifest) -> String {
    format!(
        "liftsim {}, config {} ({}), seed {}, {} trials per point",
        manifest.version,
        manifest.config_name,
        manifest.short_hash(),
        manifest.seed,
        manifest.trials
    )
}
