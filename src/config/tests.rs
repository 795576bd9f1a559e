//! How the parts of a config are laid over each other.

use super::{Config, Parameter};
use crate::signal::Sensor;
use crate::whiten::Fit;

fn config(rest: &str) -> Config {
    Config::parse("test", &format!("question = \"?\"\nseed = 1\n{rest}"))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// A curve changes the keys it names and keeps the file's others; the axis has the last word.
#[test]
fn curves_lie_over_the_file_and_the_axis_over_both() {
    let config = config(
        "[impulses]\nnu = 0.2\ntheta = 5.0\n[whitening]\nfit = \"burg\"\n[axis]\ntheta = [7.0]\n\
         [[curve]]\n[[curve]]\nlabel = \"b\"\nimpulses = { nu = 0.4, theta = 6.0 }\n",
    );
    let labels: Vec<&str> = config.curves.iter().map(|c| c.label.as_str()).collect();
    assert_eq!(labels, ["1", "b"]);
    let value = &config.axis.values[0];
    let (first, second) = (
        config.scenario(0, value).unwrap(),
        config.scenario(1, value).unwrap(),
    );
    assert_eq!((first.impulses.nu(), first.impulses.theta()), (0.2, 7.0));
    assert_eq!((second.impulses.nu(), second.impulses.theta()), (0.4, 7.0));
    assert_eq!(second.whitening.fit(), Fit::Burg);
}

/// A sensor is one choice, so a curve's sensor replaces the file's.
#[test]
fn a_curve_replaces_the_sensor() {
    let config = config(
        "[sensor]\nmodel = \"adxl105\"\n[axis]\ndelta = [0.0]\n[[curve]]\n[[curve]]\nsensor = { ar = [0.5] }\n",
    );
    let sensor = |curve| {
        config
            .scenario(curve, &config.axis.values[0])
            .unwrap()
            .sensor
    };
    assert_eq!(sensor(0), Sensor::adxl105());
    assert_eq!(sensor(1).ar(), [0.5]);
}

/// Δ acts to the last of Y₁ unless told otherwise, gaps included.
#[test]
fn duration_follows_the_samples() {
    let config = config("[samples]\ngap = 3\n[axis]\nshift = [5, 9]\n");
    let durations: Vec<usize> = (config.axis.values.iter())
        .map(|value| config.scenario(0, value).unwrap().motion.duration)
        .collect();
    assert_eq!(durations, [8, 12]);
}

#[test]
fn all_samples_moves_three_sizes() {
    let config = config("[axis]\nall_samples = [20]\n");
    assert_eq!(config.axis.parameter, Parameter::AllSamples);
    let samples = config.scenario(0, &config.axis.values[0]).unwrap().samples;
    assert_eq!(samples.to_string(), "20/20/20");
}

/// Every parameter an axis can sweep reaches the scenario.
#[test]
fn every_parameter_can_be_swept() {
    let at_default = config("[axis]\ndelta = [0.0]\n");
    let default = at_default.scenario(0, &at_default.axis.values[0]).unwrap();
    for (name, parameter) in Parameter::ALL {
        let value = match parameter {
            Parameter::Rule => "\"wilcoxon\"",
            Parameter::Nu | Parameter::Alpha => "0.25",
            _ => "7",
        };
        let config = config(&format!("[axis]\n{name} = [{value}]\n"));
        assert_eq!(config.axis.parameter.name(), name);
        assert_ne!(
            config.scenario(0, &config.axis.values[0]).unwrap(),
            default,
            "{name}"
        );
    }
}

#[test]
fn half_width_fixes_the_trials() {
    let trials = config("half_width = 0.01\n[axis]\ndelta = [0.0]\n").trials;
    assert!((9_600..9_800).contains(&trials), "{trials}");
}
