//! Tests how the parts of a config are laid over each other.

use super::SweepConfig;
use crate::claim::Test;
use crate::detect::{Alternative, Exceedances, Method, Rule, Samples, Ties};
use crate::scenario::PARAMETERS;
use crate::scenario::{Calibration, Detector, Scenario};
use crate::signal::{
    DeltaAt, Digitiser, Disturbance, During, Impulses, Law, Motion, Noise, Profile, Sensor,
};
use crate::whiten::{Fit, Whitening};

fn config(rest: &str) -> SweepConfig {
    SweepConfig::parse("test", &format!("question = \"?\"\nseed = 1\n{rest}"))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// A curve changes the keys it names and keeps the other keys of the file. The axis overrides both.
#[test]
fn curves_lie_over_the_file_and_the_axis_over_both() {
    let config = config(
        "[impulses]\nnu = 0.2\nduring = \"inertial\"\n[whitening]\nfit = \"burg\"\n[axis]\ntheta = [7.0]\n\
         [[curve]]\n[[curve]]\nlabel = \"b\"\nimpulses = { nu = 0.4 }\n",
    );
    let labels: Vec<&str> = config
        .scope
        .curves
        .iter()
        .map(|c| c.label.as_str())
        .collect();
    assert_eq!(labels, ["1", "b"]);
    let value = &config.axis().values[0];
    let (first, second) = (
        config.scenario(0, value).unwrap(),
        config.scenario(1, value).unwrap(),
    );
    assert_eq!(
        (first.impulses.nu.get(), first.impulses.theta.get()),
        (0.2, 7.0)
    );
    assert_eq!(
        (second.impulses.nu.get(), second.impulses.theta.get()),
        (0.4, 7.0)
    );
    assert_eq!(second.impulses.during, During::Inertial);
    assert_eq!(second.whitening.fit, Fit::Burg);
}

#[test]
fn an_empty_list_of_curves_is_one_plain_curve() {
    let curves = config("curve = []\n[axis]\ndelta = [1.0]\n").scope.curves;
    assert_eq!((curves.len(), curves[0].label.as_str()), (1, "1"));
}

/// A sensor is one choice, so a curve's sensor replaces the file's.
#[test]
fn a_curve_replaces_the_sensor() {
    let config = config(
        "[sensor]\nmodel = \"adxl105\"\n[axis]\ndelta = [0.0]\n[[curve]]\n[[curve]]\nsensor = { ar = [0.5] }\n",
    );
    let sensor = |curve| {
        config
            .scenario(curve, &config.axis().values[0])
            .unwrap()
            .sensor
    };
    assert_eq!(sensor(0), Sensor::adxl105());
    assert_eq!(sensor(1).ar(), [0.5]);
}

/// Δ acts to the last of Y₁ by default, gaps included.
#[test]
fn duration_follows_the_samples() {
    let config = config("[samples]\ngap = 3\n[axis]\nshift = [5, 9]\n");
    let durations: Vec<usize> = (config.axis().values.iter())
        .map(|value| config.scenario(0, value).unwrap().motion.duration)
        .collect();
    assert_eq!(durations, [8, 12]);
}

#[test]
fn all_samples_moves_three_sizes() {
    let config = config("[axis]\nall_samples = [20]\n");
    assert_eq!(config.parameter().name, "all_samples");
    let samples = config
        .scenario(0, &config.axis().values[0])
        .unwrap()
        .samples;
    assert_eq!(samples.to_string(), "20/20/20");
}

/// Every parameter an axis can sweep does what the key of that name does in its section.
#[test]
fn every_parameter_does_what_its_key_does() {
    for name in PARAMETERS.iter().filter(|p| p.is_swept()).map(|p| p.name) {
        let (section, value) = match name {
            "delta" | "duration" | "offset" => ("motion", "7"),
            "nu" => ("impulses", "0.25"),
            "theta" => ("impulses", "7"),
            "quantum" | "range" => ("noise", "7"),
            "training" | "order" => ("whitening", "7"),
            "drift" | "swell" => ("rest", "7"),
            "footfalls" => ("rest", "0.25"),
            "alpha" => ("detector", "0.25"),
            "rule" => ("detector", "\"wilcoxon\""),
            _ => ("samples", "7"),
        };
        let keys = match name {
            "all_samples" => format!("reference = {value}\nshift = {value}\nscale = {value}"),
            "reference_and_scale" => format!("reference = {value}\nscale = {value}"),
            _ => format!("{name} = {value}"),
        };
        // If the axis changes nothing, the value of the section applies.
        let idle = if section == "impulses" {
            "[axis]\ndelta = [0.0]"
        } else {
            "[axis]\nnu = [0.1]"
        };
        let section_says = config(&format!("[{section}]\n{keys}\n{idle}\n"));
        let axis_says = config(&format!("[axis]\n{name} = [{value}]\n"));
        let scenario = |config: &SweepConfig| config.scenario(0, &config.axis().values[0]).unwrap();
        assert_eq!(scenario(&section_says), scenario(&axis_says), "{name}");
        assert_eq!(axis_says.parameter().name, name);
        let default = config("[axis]\nnu = [0.1]\n");
        assert_ne!(scenario(&axis_says), scenario(&default), "{name}");
    }
}

#[test]
fn half_width_fixes_the_trials() {
    let trials = config("half_width = 0.01\n[axis]\ndelta = [0.0]\n")
        .header()
        .trials();
    assert!((9_600..9_800).contains(&trials), "{trials}");
}

/// Every key that is set to a value other than its default reaches its place in the scenario.
#[test]
fn every_key_reaches_the_scenario() {
    let config = config(
        "pilot = 5000\n[sensor]\nar = [0.5, -0.25]\n\
         [noise]\nlaw = \"logistic\"\nquantum = 0.5\nrange = 9.0\n\
         [rest]\ndrift = 0.25\nswell = 2.0\nfootfalls = 0.125\njolt = 3.0\n\
         [motion]\ndelta = 1.5\ndelta_at = \"whitened\"\nprofile = { trapezoid = { rise = 2.0 } }\nduration = 9\noffset = 4\n\
         [impulses]\ntheta = 3.0\nduring = \"inertial\"\n\
         [whitening]\norder = 5\ntraining = 77\nfit = \"yule-walker\"\nincludes_reference = true\n\
         [samples]\nreference = 10\nshift = 11\nscale = 13\ngap = 2\n\
         [detector]\nalpha = 0.02\nrule = \"disjunction\"\nalternative = \"two-sided\"\nexceedances = \"motion\"\nties = \"strict\"\ncalibrate = true\n\
         [axis]\nnu = [0.2]\n",
    );
    let expected = Scenario {
        sensor: Sensor::from_ar(vec![0.5, -0.25]).unwrap(),
        noise: Noise::new(Law::Logistic).unwrap(),
        disturbance: Disturbance::new(0.25, 2.0, 0.125, 3.0).unwrap(),
        digitiser: Digitiser::new(Some(0.5), Some(9.0)).unwrap(),
        motion: Motion {
            delta: 1.5,
            delta_at: DeltaAt::Whitened,
            profile: Profile::Trapezoid { rise: 2.0 },
            duration: 9,
            offset: 4,
        },
        impulses: Impulses::new(0.2, 3.0, During::Inertial).unwrap(),
        whitening: Whitening::new(5, Fit::YuleWalker, 77, true, 2).unwrap(),
        samples: Samples::new(10, 11, 13, 2, 1).unwrap(),
        detector: Detector {
            alpha: 0.02,
            method: Method::Rule(Rule::Disjunction),
            exceedances: Exceedances::Motion,
            alternative: Alternative::TwoSided,
            ties: Ties::Strict,
            calibration: Calibration::Promise,
            stated: None,
            pilot: 5000,
        },
    };
    assert_eq!(
        config.scenario(0, &config.axis().values[0]).unwrap(),
        expected
    );
}

/// Each word of a config means what it says.
#[test]
fn words_mean_themselves() {
    let scenario = |section: &str, key: &str, value: &str| {
        let config = config(&format!(
            "[{section}]\n{key} = {value}\n[axis]\nnu = [0.1]\n"
        ));
        config.scenario(0, &config.axis().values[0]).unwrap()
    };
    for (word, law) in [
        ("normal", Law::Normal),
        ("laplace", Law::Laplace),
        ("logistic", Law::Logistic),
        ("uniform", Law::Uniform),
        ("cauchy", Law::Cauchy),
    ] {
        let noise = scenario("noise", "law", &format!("\"{word}\"")).noise;
        assert_eq!(
            (noise, noise.to_string()),
            (Noise::new(law).unwrap(), word.to_owned())
        );
    }
    assert_eq!(
        scenario("noise", "law", "{ student_t = 3.0 }")
            .noise
            .to_string(),
        "student_t(3)"
    );
    for word in ["least-squares", "yule-walker", "burg", "known"] {
        assert_eq!(
            scenario("whitening", "fit", &format!("\"{word}\""))
                .whitening
                .fit
                .to_string(),
            word
        );
    }
    for word in ["wilcoxon", "product", "disjunction", "conjunction"] {
        assert_eq!(
            scenario("detector", "rule", &format!("\"{word}\""))
                .detector
                .method
                .to_string(),
            word
        );
    }
    for word in ["greater", "less", "two-sided"] {
        let detector = scenario("detector", "alternative", &format!("\"{word}\"")).detector;
        assert_eq!(detector.alternative.to_string(), word);
    }
    assert_eq!(
        scenario("samples", "decimation", "3").samples.decimation(),
        3
    );
}

/// By default Δ acts to the last of Y₁, however late it starts.
#[test]
fn duration_follows_the_offset() {
    let config = config("[axis]\noffset = [0, 3, 11, 12]\n");
    let scenario = |index: usize| config.scenario(0, &config.axis().values[index]);
    for (index, expected) in [(0, 12), (1, 9), (2, 1)] {
        assert_eq!(scenario(index).unwrap().motion.duration, expected);
    }
    let error = scenario(3).unwrap_err().to_string();
    assert!(error.contains("lower offset"), "{error}");
}

/// A claim may leave keys out or give all of them. A text in several lines is one paragraph.
#[test]
fn claims_say_what_they_say() {
    let file = |report: &str, claims: &str| {
        let axis =
            "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"a\"\n[[curve]]\nlabel = \"b\"\n";
        config(&format!("{report}{axis}{claims}")).narrative
    };
    let claim = |test: &str| {
        let claim = format!("[[claim]]\nclaim = \"c\"\nsource = \"s\"\ntest = {test}\n");
        file("", &claim).claims[0].clone()
    };
    let nothing = file("", "");
    assert!(nothing.title.is_none() && nothing.text.is_none() && nothing.claims.is_empty());
    let short = claim("\"grows\"");
    assert_eq!((short.level.get(), short.margin.get()), (0.001, 0.005));
    assert_eq!(short.test, Test::Grows { curves: None });
    assert_eq!(claim("{ grows = {} }"), short);
    let some = claim("{ alpha_held = { curves = [\"b\"] } }").test;
    let Test::AlphaHeld { curves, excess } = some else {
        panic!("{some:?}");
    };
    assert_eq!((curves, excess.get()), (Some(vec!["b".to_owned()]), 1.2));
    let gain = claim("{ gain = { first = \"b\", second = \"a\" } }").test;
    let Test::Gain { power, from, .. } = gain else {
        panic!("{gain:?}");
    };
    assert_eq!((power.get(), from), (0.9, 0.0));
    let full = file(
        "title = \"t\"\norder = 3\ntext = \"\"\"\none\ntwo\"\"\"\n",
        "[[claim]]\nclaim = \"c\"\nlevel = 0.05\nmargin = 0\ntest = \"grows\"\n",
    );
    assert_eq!((full.title.as_deref(), full.order), (Some("t"), 3));
    assert_eq!(full.text.as_deref(), Some("one two"));
    let claim = &full.claims[0];
    assert_eq!((claim.level.get(), claim.margin.get()), (0.05, 0.0));
}
