//! What the pictures of the committed results say, without pixels.

use super::sweep::picture::{Sweep, SweepCurve};
use super::*;
use crate::detect::NullLaws;
use crate::experiment::{ExhibitConfig, ExhibitKind, Experiment};
use crate::figure::render;
use crate::plot::{Limit, Mark, Panel, Place, Point};
use crate::results::Row;
use crate::scenario::{Parameter, parameter};
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn rows<R: DeserializeOwned>(study: &str) -> Vec<R> {
    let points = path(&format!("results/{study}/points.csv"));
    let rows = csv::Reader::from_path(points).unwrap().into_deserialize();
    rows.collect::<Result<_, _>>().unwrap()
}

fn config(study: &str) -> ExhibitConfig {
    match Experiment::load(&path(&format!("configs/{study}.toml"))).unwrap() {
        Experiment::Exhibit(config) => *config,
        Experiment::Sweep(_) => panic!("{study} is a sweep"),
    }
}

/// A sweep of curves in these panels, without more to say.
fn sweep(axis: &'static Parameter, values: &[f64], panels: &[Option<&str>]) -> Sweep {
    let curve = |panel: &Option<&str>| SweepCurve {
        panel: panel.map(str::to_owned),
        series: panel.map(|_| "both".to_owned()),
        step_gain: Some(3.0),
    };
    let curves = panels.iter().map(curve).collect();
    Sweep {
        axis,
        values: values.to_vec(),
        curves,
    }
}

/// Every picture must fit on its sheet.
fn checked(plot: Plot) -> Plot {
    crate::plot::layout(&plot).unwrap();
    plot
}

fn names(plot: &Plot) -> Vec<&str> {
    let entries = &plot.legend.as_ref().unwrap().entries;
    entries.iter().map(|entry| entry.text.as_str()).collect()
}

fn labels(panel: &Panel) -> [&str; 2] {
    [&panel.x.label, &panel.y.label]
}

fn ticks(panel: &Panel) -> Vec<&str> {
    panel
        .x
        .ticks
        .iter()
        .map(|(_, label)| label.as_str())
        .collect()
}

/// The points of a panel's marks that have any.
fn points(plot: &Plot, panel: usize) -> Vec<&[Point]> {
    let of = |mark| match mark {
        &Mark::Band(ref points, _) | &Mark::Points(ref points, _) | &Mark::Bars(ref points, _) => {
            Some(&points[..])
        }
        _ => None,
    };
    plot.marks_of(panel).filter_map(of).collect()
}

#[test]
fn a_sweep_of_power_shows_each_curve_in_its_band() {
    let rows: Vec<Row> = rows("fig6");
    let curves = rows.iter().map(|row| row.curve).max().unwrap();
    let values: Vec<f64> = Vec::new();
    let plot = sweep::picture::plot(
        &sweep(parameter("delta").unwrap(), &values, &vec![None; curves]),
        &rows,
        7,
    );
    let plot = checked(plot.unwrap());
    assert_eq!(
        labels(&plot.panels[0]),
        ["Δ/σ_ξ", "D, probability of detection"]
    );
    let top = plot.panels[0].top.as_ref().unwrap();
    assert_eq!(top.label, "Δ(1 − β)/σ_ξ, the shift after whitening");
    assert!((top.to - 3.0 * plot.panels[0].x.to).abs() < 1e-12);
    assert_eq!(names(&plot).len(), curves);
    assert!(
        names(&plot)[1].starts_with("2:  ν = "),
        "{:?}",
        names(&plot)
    );
    let moving = rows
        .iter()
        .find(|row| !row.is_at_rest() && row.curve == 2)
        .unwrap();
    let drawn = points(&plot, 0)[1][0];
    assert_eq!(
        (drawn.x, drawn.y),
        (moving.values.number("delta"), moving.tally.rate())
    );
    let (low, high) = moving.tally.interval(moving.confidence);
    assert!((drawn.low - low).abs() < 1e-7 && (drawn.high - high).abs() < 1e-7);
    assert!(!plot.marks_of(0).any(|mark| matches!(mark, Mark::Level(..))));
    assert!(
        plot.caption
            .join("; ")
            .contains("seed 7; bands: pointwise exact 95 % intervals")
    );
}

#[test]
fn false_alarms_by_rule_are_bars_around_their_level() {
    let rows: Vec<Row> = rows("rest");
    let curves = rows.iter().map(|row| row.curve).max().unwrap();
    let plot = sweep::picture::plot(
        &sweep(parameter("rule").unwrap(), &[], &vec![None; curves]),
        &rows,
        7,
    );
    let plot = checked(plot.unwrap());
    assert_eq!(
        labels(&plot.panels[0]),
        ["decision rule", "false-alarm rate"]
    );
    assert_eq!(
        ticks(&plot.panels[0]),
        ["wilcoxon", "product", "disjunction", "conjunction"]
    );
    let levels: Vec<f64> = (plot.marks_of(0))
        .filter_map(|mark| match mark {
            Mark::Level(y, _) => Some(*y),
            _ => None,
        })
        .collect();
    assert_eq!(levels, [-2.0], "the logarithm of α");
    // No false alarm in 200 000 trials: an arrow at the limit, and no bar.
    let limits = plot.marks_of(0).filter_map(|mark| match mark {
        Mark::Markers(points, _) => points.iter().find(|point| point.limit.is_some()),
        _ => None,
    });
    let limits: Vec<&Point> = limits.collect();
    assert_eq!(limits[0].limit, Some(Limit::Upper));
    assert!((limits[0].y - 1.8444e-5f64.log10()).abs() < 1e-4);
    assert_eq!(points(&plot, 0)[1].len(), 3);
    assert!(
        plot.caption
            .last()
            .unwrap()
            .starts_with("arrows: upper limits")
    );
}

#[test]
fn panels_share_a_legend_and_their_axes() {
    let rows: Vec<Row> = rows("fig6");
    let rows: Vec<Row> = rows.into_iter().filter(|row| row.curve <= 3).collect();
    let panels = [Some("upper left"), Some("upper right"), Some("below")];
    let plot = sweep::picture::plot(&sweep(parameter("delta").unwrap(), &[], &panels), &rows, 7);
    let plot = checked(plot.unwrap());
    let titles: Vec<&str> = plot
        .panels
        .iter()
        .map(|panel| panel.title.as_str())
        .collect();
    assert_eq!(titles, ["upper left", "upper right", "below"]);
    assert_eq!(labels(&plot.panels[0]), ["", "D, probability of detection"]);
    assert_eq!(labels(&plot.panels[1]), ["Δ/σ_ξ", ""]);
    assert_eq!(
        labels(&plot.panels[2]),
        ["Δ/σ_ξ", "D, probability of detection"]
    );
    assert_eq!(names(&plot), ["both"]);
    let nothing = sweep::picture::plot(&sweep(parameter("delta").unwrap(), &[], &panels), &[], 7);
    let message = nothing.unwrap_err().to_string();
    assert!(
        message.contains("no point of the results lies on the axis delta"),
        "{message}"
    );
}

#[test]
fn an_autocorrelation_shows_theory_and_simulation() {
    let (rows, config) = (
        rows::<crate::study::autocorrelation::Row>("fig1"),
        config("fig1"),
    );
    let records = autocorrelation::picture::Records {
        sensor: &config.scenario.sensor,
        noise: &config.scenario.noise,
        trials: 1000,
        length: 64,
        confidence: 0.95,
        seed: 7,
    };
    let plot = checked(autocorrelation::picture::plot(&rows, &records));
    assert_eq!(labels(&plot.panels[0]), ["", "ρ_k, autocorrelation"]);
    assert_eq!(
        labels(&plot.panels[1]),
        ["lag k, samples (T_0 = 62.5 µs)", "minus theory"]
    );
    assert_eq!(names(&plot)[2], "simulation");
    let deviation = points(&plot, 1)[0][5];
    assert_eq!(deviation.x, 5.0);
    assert_eq!(deviation.low, rows[5].low - rows[5].theory);
}

#[test]
fn traces_name_what_lies_in_them() {
    let (rows, config) = (rows::<crate::study::trace::Row>("fig3_4"), config("fig3_4"));
    let ExhibitKind::Trace(trace) = &config.kind else {
        panic!("fig3_4 is a trace")
    };
    let plot = checked(trace::picture::plot(&rows, trace, &config.scenario, 7));
    assert_eq!(names(&plot), ["record", "acceleration in it"]);
    assert_eq!(plot.panels.len(), if trace.whitened { 2 } else { 1 });
    let named = plot.marks_of(0).find_map(|mark| match mark {
        Mark::Names(names, _) => Some(
            names
                .iter()
                .map(|(_, name)| name.as_str())
                .collect::<Vec<_>>(),
        ),
        _ => None,
    });
    assert_eq!(
        named.unwrap()[..3],
        ["rest", "acceleration", "inertial motion"]
    );
}

#[test]
fn a_layout_labels_its_blocks() {
    let (rows, config) = (rows("fig5"), config("fig5"));
    let plot = checked(layout::picture::plot(&rows, &config.scenario));
    let blocks = plot.marks_of(1).filter_map(|mark| match mark {
        Mark::Block(block) => Some((block.lines[0].as_str(), block.ends, block.is_cut)),
        _ => None,
    });
    let blocks: Vec<_> = blocks.collect();
    assert_eq!(blocks[0].0, "training");
    assert!(blocks[0].2, "a long training record is cut");
    assert_eq!(blocks[1], ("X", (-12.0, 0.0), false));
    assert_eq!(plot.panels[0].y.ticks[1], (1.0, "Δ".to_owned()));
}

#[test]
fn regions_are_drawn_over_their_law() {
    let (rows, config) = (rows("regions"), config("regions"));
    let (samples, detector) = (&config.scenario.samples, &config.scenario.detector);
    let laws = NullLaws::new(detector.alternative, samples).unwrap();
    let title = region::picture::title(samples, detector.alternative, detector.alpha);
    let plot = checked(region::picture::plot(&laws, &rows, &title));
    assert_eq!(names(&plot)[0], "wilcoxon, exact size 0.009972");
    let Some(Mark::Cells(cells)) = plot.marks_of(0).next() else {
        panic!("cells are drawn first");
    };
    assert_eq!(cells[0].0.0, plot.panels[0].x.from);
    // The Wilcoxon rule decides from W = 291 on, whatever T.
    let line = plot.marks_of(0).find_map(|mark| match mark {
        Mark::Line(line, _) => Some(line),
        _ => None,
    });
    assert!(line.unwrap().iter().all(|(w, _)| *w == 290.5));
}

#[test]
fn independence_lies_on_the_diagonal() {
    let rows: Vec<crate::study::independence::Row> = rows("independence");
    let plot = checked(independence::picture::plot(&rows));
    assert_eq!(names(&plot)[0], "1/1/1");
    let Some(Mark::Markers(points, _)) = plot.marks_of(0).nth(2) else {
        panic!("markers after grid and diagonal");
    };
    assert!(points.iter().all(|point| (point.x - point.y).abs() < 1e-9));
}

#[test]
fn laws_of_impulses_have_intervals() {
    let rows: Vec<crate::study::impulse_law::Row> = rows("impulse_law");
    let plot = checked(impulse_law::picture::plot(&rows, 0.95, 7));
    assert_eq!(names(&plot)[0], "ν = 0.01");
    let (first, row) = (points(&plot, 1)[0][0], &rows[0]);
    assert_eq!(
        [first.low, first.y, first.high],
        [row.positive_low, row.positive_rate, row.positive_high]
    );
    assert!(
        plot.marks_of(0)
            .any(|mark| *mark == Mark::Level(0.5, &[4.0, 2.0]))
    );
}

#[test]
fn operating_points_stand_at_their_sizes() {
    let (rows, config) = (rows("field"), config("field"));
    let plot = checked(operating_point::picture::plot(&rows, &config.scenario, 7));
    assert_eq!(ticks(&plot.panels[0])[0], "8");
    assert!(matches!(
        plot.legend.as_ref().unwrap().place,
        Place::Inside(..)
    ));
    let first: &crate::study::operating_point::Row = &rows[0];
    assert_eq!(points(&plot, 0)[0][0].low, first.low.unwrap());
}

#[test]
fn rides_show_rates_above_delays() {
    let (rows, config) = (rows("ride_found"), config("ride_found"));
    let ExhibitKind::Ride(study) = &config.kind else {
        panic!("ride_found is a study of rides")
    };
    let labels: Vec<String> = study
        .curves
        .iter()
        .map(|curve| curve.label.clone())
        .collect();
    let rides = ride::picture::Rides {
        measure: study.measure,
        axis: &study.axis,
        labels: &labels,
        seed: 7,
    };
    let plot = checked(ride::picture::plot(&rows, &rides));
    assert_eq!(names(&plot), labels);
    let y: Vec<&str> = plot
        .panels
        .iter()
        .map(|panel| panel.y.label.as_str())
        .collect();
    assert_eq!(y, ["P(every trip is found)", "start to H_1*, s"]);
    let first: &crate::study::ride::Row = &rows[0];
    assert_eq!(points(&plot, 0)[0][0].x, first.x.log10());
}

#[test]
fn the_same_plot_gives_the_same_bytes() {
    let rows: Vec<crate::study::independence::Row> = rows("independence");
    let plot = independence::picture::plot(&rows);
    let drawing = render(&plot, "a < b").unwrap();
    assert_eq!(drawing.png, render(&plot, "a < b").unwrap().png);
    assert!(
        String::from_utf8(drawing.svg)
            .unwrap()
            .contains("<desc>a &lt; b</desc>")
    );
}
