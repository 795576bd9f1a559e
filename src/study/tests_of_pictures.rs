//! Tests of the pictures of the committed results, without pixels.

use super::*;
use crate::claim::{Axis, Curve, Scope};
use crate::figure::{FigureError, render};
use crate::plot::{Limit, Mark, Options, Panel, Place, Plot, Point};
use crate::results::Row;
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

/// A study's committed rows and the plot that it draws from them.
fn drawn<S: Study>(name: &str) -> (Vec<S::Row>, Plot) {
    let experiment = load(&path(&format!("configs/{name}.toml"))).unwrap();
    let context = Context::of(&experiment, S::COUNTS_TRIALS);
    let study = S::read(&experiment, context).unwrap();
    let rows: Vec<S::Row> = rows(name);
    let plot = checked(study.plot(&rows, 7).unwrap());
    (rows, plot)
}

/// The picture of a sweep without numeric values, with its curves in these panels and no further text.
fn sweep(axis: &'static str, panels: &[Option<&str>], rows: &[Row]) -> Result<Plot, FigureError> {
    let curve = |panel: &Option<&str>| Curve {
        label: String::new(),
        panel: panel.map(str::to_owned),
        series: panel.map(|_| "both".to_owned()),
    };
    let axis = Axis {
        name: axis,
        ..Axis::default()
    };
    let curves = panels.iter().map(curve).collect();
    let step_gains = vec![3.0; panels.len()];
    let frame = sweep::picture::Frame {
        scope: &Scope { curves, axis },
        step_gains: &step_gains,
        excess: None,
    };
    sweep::picture::plot(&frame, rows, 7)
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

/// The points of a panel's marks. Kinds of marks without points are left out.
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
    let plot = checked(sweep("delta", &vec![None; curves], &rows).unwrap());
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
        plot.caption_lines()
            .join("; ")
            .contains("seed 7; pointwise exact 95 % intervals are narrower than the lines")
    );
}

#[test]
fn false_alarms_by_rule_are_bars_around_their_level() {
    let rows: Vec<Row> = rows("rest");
    let curves = rows.iter().map(|row| row.curve).max().unwrap();
    let plot = checked(sweep("rule", &vec![None; curves], &rows).unwrap());
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
        plot.caption_lines()
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
    let plot = checked(sweep("delta", &panels, &rows).unwrap());
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
    let message = sweep("delta", &panels, &[]).unwrap_err().to_string();
    assert!(
        message.contains("no point of the results lies on the axis delta"),
        "{message}"
    );
}

#[test]
fn an_autocorrelation_shows_theory_and_simulation() {
    let (rows, plot) = drawn::<autocorrelation::Autocorrelation>("fig1");
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
    let (_, plot) = drawn::<trace::Realisation>("fig3_4");
    assert_eq!(names(&plot), ["record", "acceleration in it"]);
    assert_eq!(
        plot.panels.len(),
        2,
        "the record and what whitening makes of it"
    );
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
    let (_, plot) = drawn::<layout::Layout>("fig5");
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
    let (_, plot) = drawn::<region::Regions>("regions");
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
    let (rows, plot) = drawn::<operating_point::OperatingPoint>("field");
    assert_eq!(ticks(&plot.panels[0])[0], "8");
    assert!(matches!(
        plot.legend.as_ref().unwrap().place,
        Place::Inside(..)
    ));
    assert_eq!(points(&plot, 0)[0][0].low, rows[0].low.unwrap());
}

#[test]
fn rides_show_rates_above_delays() {
    let (rows, plot) = drawn::<outcomes::Of<ride::Table>>("ride_found");
    let curves = [
        "10 Hz",
        "25 Hz",
        "100 Hz",
        "200 Hz",
        "100 Hz, within 2 s",
        "100 Hz, three samples",
    ];
    assert_eq!(names(&plot), curves);
    let y: Vec<&str> = plot
        .panels
        .iter()
        .map(|panel| panel.y.label.as_str())
        .collect();
    assert_eq!(y, ["P(every trip is found)", "start to its report, s"]);
    assert_eq!(points(&plot, 0)[0][0].x, rows[0].x.log10());
}

#[test]
fn the_same_plot_gives_the_same_bytes() {
    let rows: Vec<crate::study::independence::Row> = rows("independence");
    let plot = independence::picture::plot(&rows);
    let draw = || render(&plot, "a < b", &Options::default()).unwrap();
    assert_eq!(draw(), draw());
    let [(png, _), (svg, bytes)] = &draw()[..] else {
        panic!("a PNG and an SVG");
    };
    assert_eq!([png, svg], [&"figure.png", &"figure.svg"]);
    let svg = String::from_utf8(bytes.clone()).unwrap();
    assert!(svg.contains("<desc>a &lt; b</desc>"));
}
