//! Every bad input: exit 2, one message with the place, the value and the remedy, no panic, and no files left
//! behind.

use super::{liftsim, outcome};
use std::fmt::Write;
use std::fs;

pub const GOOD: &str = "question = \"?\"\nseed = 1\ntrials = 10\n";

/// The subject of each message, and the rest of the config that causes it.
pub const CONFIGS: &[(&str, &str)] = &[
    ("unknown key", "trails = 5\n[axis]\ndelta = [1.0]\n"),
    (
        "unknown key in a section",
        "[axis]\ndelta = [1.0]\n[detector]\nalhpa = 0.1\n",
    ),
    (
        "steps that miss the end",
        "[axis]\ndelta = { from = 0.0, to = 1.0, step = 0.3 }\n",
    ),
    (
        "a key of another section",
        "sensor = { quantum = 0.1 }\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a number as it was written",
        "[axis]\ndelta = [1.0]\n[impulses]\nnu = 1.50\n",
    ),
    ("a value twice", "[axis]\ndelta = [0.0, 0.5, 0.50]\n"),
    (
        "an order of nothing",
        "[axis]\ndelta = [1.0]\n[[curve]]\nwhitening = { fit = \"none\", order = 3 }\n",
    ),
    (
        "an order above the sensor's",
        "[axis]\ndelta = [1.0]\n[whitening]\nfit = \"known\"\norder = 5\n",
    ),
    (
        "a range below the step",
        "[axis]\ndelta = [1.0]\n[noise]\nquantum = 0.5\nrange = 0.4\n",
    ),
    (
        "a date for a text",
        "title = 1979-05-27\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a number for a curve",
        "curve = [5]\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a text among curves",
        "curve = [{ label = \"1\" }, \"x\"]\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "unknown key in a curve",
        "[axis]\ndelta = [1.0]\n[[curve]]\nlabel = \"1\"\nimpulses = { nu = 0.1, tehta = 2.0 }\n",
    ),
    (
        "unknown section",
        "[axis]\ndelta = [1.0]\n[detecter]\nalpha = 0.1\n",
    ),
    (
        "unknown value",
        "[axis]\ndelta = [1.0]\n[detector]\nrule = \"wilcoxen\"\n",
    ),
    (
        "unknown law",
        "[axis]\ndelta = [1.0]\n[noise]\nlaw = \"gauss\"\n",
    ),
    ("unknown axis", "[axis]\ndleta = [1.0]\n"),
    ("missing axis", ""),
    (
        "wrong type",
        "[axis]\ndelta = [1.0]\n[impulses]\nnu = \"often\"\n",
    ),
    ("wrong type in an axis", "[axis]\ndelta = [\"one\"]\n"),
    (
        "fraction for a size",
        "[axis]\ndelta = [1.0]\n[samples]\nshift = 1.5\n",
    ),
    (
        "fraction for a size in an axis",
        "[axis]\nshift = [12, 12.5]\n",
    ),
    ("not TOML", "[axis\ndelta = [1.0]\n"),
    ("NaN", "[axis]\ndelta = [1.0]\n[impulses]\nnu = nan\n"),
    ("infinity", "[axis]\ndelta = [0.0, inf]\n"),
    (
        "negative size",
        "[axis]\ndelta = [1.0]\n[samples]\nreference = -12\n",
    ),
    ("zero size", "[axis]\ndelta = [1.0]\n[samples]\nscale = 0\n"),
    (
        "zero decimation",
        "[axis]\ndelta = [1.0]\n[samples]\ndecimation = 0\n",
    ),
    (
        "alpha of 0",
        "[axis]\ndelta = [1.0]\n[detector]\nalpha = 0.0\n",
    ),
    ("alpha above 1", "[axis]\nalpha = [0.01, 1.5]\n"),
    (
        "nu above 1",
        "[axis]\ndelta = [1.0]\n[impulses]\nnu = 1.2\n",
    ),
    ("nu below 0", "[axis]\nnu = [-0.1, 0.1]\n"),
    (
        "negative theta",
        "[axis]\ndelta = [1.0]\n[impulses]\ntheta = -2.0\n",
    ),
    (
        "short training",
        "[axis]\ndelta = [1.0]\n[whitening]\norder = 4\ntraining = 8\n",
    ),
    ("order of 0", "[axis]\norder = [0, 2]\n"),
    (
        "an invalid order",
        "[axis]\ndelta = [1.0]\n[whitening]\norder = \"many\"\n",
    ),
    (
        "a negative order in a curve",
        "[axis]\ndelta = [1.0]\n[[curve]]\nwhitening = { order = -1 }\n",
    ),
    (
        "an order chosen from too little",
        "[axis]\ndelta = [1.0]\n[whitening]\norder = \"auto\"\ntraining = 4\n",
    ),
    (
        "an order chosen for a known filter",
        "[axis]\ndelta = [1.0]\n[[curve]]\nwhitening = { order = \"auto\", fit = \"known\" }\n",
    ),
    (
        "an order chosen on an axis",
        "[axis]\norder = [1, 2, \"auto\"]\n",
    ),
    (
        "known filter below the sensor",
        "[axis]\ndelta = [1.0]\n[whitening]\norder = 1\nfit = \"known\"\n",
    ),
    (
        "unstable sensor",
        "[axis]\ndelta = [1.0]\n[sensor]\nar = [1.2, -0.1]\n",
    ),
    (
        "real poles",
        "[axis]\ndelta = [1.0]\n[sensor]\ntransfer = { a = 1.0, b = 4.0, c = 2.0, period = 0.1 }\n",
    ),
    (
        "two sensors",
        "[axis]\ndelta = [1.0]\n[sensor]\nmodel = \"adxl105\"\nar = [0.5]\n",
    ),
    (
        "freedom of 0",
        "[axis]\ndelta = [1.0]\n[noise]\nlaw = { student_t = 0.0 }\n",
    ),
    (
        "quantum of 0",
        "[axis]\ndelta = [1.0]\n[noise]\nquantum = 0.0\n",
    ),
    (
        "long rise",
        "[axis]\ndelta = [1.0]\n[motion]\nprofile = { trapezoid = { rise = 7.0 } }\n",
    ),
    ("empty axis", "[axis]\ndelta = []\n"),
    ("no axis key", "[axis]\n"),
    ("two axes", "[axis]\ndelta = [1.0]\nnu = [0.1]\n"),
    (
        "zero step",
        "[axis]\ndelta = { from = 0.0, to = 1.0, step = 0.0 }\n",
    ),
    (
        "reversed range",
        "[axis]\ndelta = { from = 2.0, to = 1.0, step = 0.1 }\n",
    ),
    (
        "endless range",
        "[axis]\ndelta = { from = 0.0, to = 1.0, step = 1e-9 }\n",
    ),
    (
        "range without a step",
        "[axis]\ndelta = { from = 0.0, to = 1.0 }\n",
    ),
    (
        "large table",
        "[axis]\ndelta = [1.0]\n[samples]\nscale = 2\n[detector]\nrule = { table = [200, 200, 200] }\n",
    ),
    (
        "short table",
        "[axis]\ndelta = [1.0]\n[detector]\nrule = { table = [300, \"never\"] }\n",
    ),
    (
        "word in a table",
        "[axis]\ndelta = [1.0]\n[detector]\nrule = { table = [300, \"always\"] }\n",
    ),
    (
        "level out of reach",
        "[axis]\ndelta = [1.0]\n[samples]\nreference = 3\nshift = 2\nscale = 3\n[detector]\nalpha = 0.001\n",
    ),
    (
        "conjunction without a threshold",
        "[axis]\ndelta = [1.0]\n[samples]\nscale = 1\n[detector]\nrule = \"conjunction\"\n",
    ),
    (
        "counts that do not fit",
        "[axis]\nshift = [12, 100000]\n[samples]\nreference = 100000\n",
    ),
    (
        "a record that does not fit",
        "[axis]\ndelta = [1.0]\n[whitening]\ntraining = 1000000000000\n",
    ),
    (
        "set and swept",
        "[axis]\nnu = [0.1]\n[[curve]]\nimpulses = { nu = 0.2 }\n",
    ),
    (
        "a label of two lines",
        "[axis]\nnu = [0.1]\n[[curve]]\nlabel = \"a\\nb\"\n",
    ),
    (
        "equal labels",
        "[axis]\nnu = [0.1]\n[[curve]]\nlabel = \"a\"\n[[curve]]\nlabel = \"a\"\n",
    ),
    (
        "single brackets",
        "[axis]\nnu = [0.1]\n[curve]\nlabel = \"a\"\n",
    ),
    (
        "a law without its parameter",
        "[axis]\nnu = [0.1]\n[noise]\nlaw = \"student_t\"\n",
    ),
    ("an exponent for a size", "[axis]\ntraining = [1e3]\n"),
    (
        "law of T that does not fit",
        "[axis]\ndelta = [1.0]\n[samples]\nreference = 300000\nshift = 1\nscale = 300000\n",
    ),
    (
        "offset past Y1",
        "[axis]\ndelta = [1.0]\n[motion]\noffset = 12\n",
    ),
    (
        "known filter of means",
        "[axis]\ndelta = [1.0]\n[whitening]\nfit = \"known\"\n[samples]\ndecimation = 2\n",
    ),
    (
        "whitened delta of means",
        "[axis]\ndecimation = [1, 2]\n[motion]\ndelta_at = \"whitened\"\n",
    ),
    (
        "wide contamination",
        "[axis]\ndelta = [1.0]\n[noise]\nlaw = { contaminated = { share = 0.1, scale = 1e9 } }\n",
    ),
    (
        "small half-width",
        "half_width = 0.000001\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "two numbers of trials",
        "half_width = 0.01\n[axis]\ndelta = [1.0]\n",
    ),
    ("two things to do", "[axis]\ndelta = [1.0]\n[layout]\n"),
    ("two drawings", "[layout]\n[impulse_law]\nnu = [0.1]\n"),
    ("trials of a drawing that has none", "[layout]\n"),
    (
        "curves of a drawing",
        "[impulse_law]\nnu = [0.1]\n[[curve]]\nlabel = \"1\"\n",
    ),
    (
        "a section that means nothing",
        "[autocorrelation]\n[samples]\nscale = 3\n",
    ),
    (
        "noise shared by nothing",
        "common_random_numbers = false\n[autocorrelation]\n",
    ),
    ("unknown key of a drawing", "[autocorrelation]\nlag = 3\n"),
    ("no lags", "[autocorrelation]\nlags = 0\n"),
    (
        "lags beyond the record",
        "[autocorrelation]\nlength = 10\nlags = 10\n",
    ),
    (
        "a law without a fourth moment",
        "[autocorrelation]\n[noise]\nlaw = { student_t = 3.0 }\n",
    ),
    ("nu of 0", "[impulse_law]\nnu = [0.1, 0.0]\n"),
    ("nu twice", "[impulse_law]\nnu = [0.1, 0.1]\n"),
    ("no nu", "[impulse_law]\nnu = []\n"),
    ("a drawing without its key", "[impulse_law]\nlength = 10\n"),
    (
        "confidence of 1",
        "confidence = 1.0\n[axis]\ndelta = [1.0]\n",
    ),
    ("a pilot of no trials", "pilot = 0\n[axis]\ndelta = [1.0]\n"),
    (
        "a baseline without a threshold",
        "[detector]\nrule = \"student-t\"\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "exceedances of a baseline",
        "[detector]\nrule = \"student-t\"\ncalibrate = true\nexceedances = \"motion\"\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a number of many digits",
        "[detector]\nalpha = 1e300\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a table to be calibrated",
        "[detector]\ncalibrate = true\n[axis]\nrule = [{ table = [1] }]\n",
    ),
    (
        "a likelihood ratio against rest",
        "[impulses]\nnu = 0.0\n[detector]\nrule = \"likelihood-ratio\"\n[axis]\ndelta = [0.0, 1.0]\n",
    ),
    (
        "calibration on an unknown law",
        "[detector]\ncalibrate = { law = \"gauss\" }\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "calibration on a number",
        "[detector]\ncalibrate = 3\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a clairvoyant of block means",
        "[sensor]\nar = []\n[samples]\ndecimation = 2\n[detector]\nrule = \"clairvoyant\"\ncalibrate = {}\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "block means without a rest",
        "[whitening]\ntraining = 20\n[detector]\nrule = \"block-means\"\ncalibrate = {}\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a swell of nothing",
        "[rest]\nswell = 0.0\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "unknown ties",
        "[detector]\nties = \"midranks\"\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a blank claim",
        "[axis]\ndelta = [0.0, 1.0]\n[[claim]]\nclaim = \" \"\nsource = \"?\"\ntest = \"grows\"\n",
    ),
    (
        "an unknown test",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = \"grow\"\n",
    ),
    (
        "an unknown key of a test",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { exeeds = { first = \"upper\", second = \"lower\" } }\n",
    ),
    (
        "a test without its parameters",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = \"exceeds\"\n",
    ),
    (
        "two tests",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { grows = {}, alpha_held = {} }\n",
    ),
    (
        "no test",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = {}\n",
    ),
    (
        "an unknown curve in a claim",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { exceeds = { first = \"uper\", second = \"lower\" } }\n",
    ),
    (
        "an unknown curve in a list",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { grows = { curves = [\"upper\", \"middle\"] } }\n",
    ),
    (
        "no curves in a claim",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { grows = { curves = [] } }\n",
    ),
    (
        "a curve twice in a claim",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { grows = { curves = [\"upper\", \"upper\"] } }\n",
    ),
    (
        "a curve against itself",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { equals = { first = \"upper\", second = \"upper\" } }\n",
    ),
    (
        "a level of 0",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\nlevel = 0.0\ntest = \"grows\"\n",
    ),
    (
        "a margin of 1",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\nmargin = 1.0\ntest = \"grows\"\n",
    ),
    (
        "an excess below 1",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { alpha_held = { excess = 0.9 } }\n",
    ),
    (
        "a power of 1",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { gain = { first = \"upper\", second = \"lower\", power = 1.0 } }\n",
    ),
    (
        "a quantity without ends",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { quantity = { name = \"largest\" } }\n",
    ),
    (
        "a quantity reversed",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { quantity = { name = \"largest\", from = 1.0, to = 0.0 } }\n",
    ),
    (
        "a quantity that a sweep lacks",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\nlabel = \"upper\"\n[[curve]]\nlabel = \"lower\"\nimpulses = { nu = 0.2 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { quantity = { name = \"largest\", from = 1.0 } }\n",
    ),
    (
        "growth along names",
        "[axis]\nrule = [\"wilcoxon\", \"product\"]\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = \"grows\"\n",
    ),
    (
        "growth down an axis",
        "[axis]\ndelta = [1.0, 0.0]\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = \"grows\"\n",
    ),
    (
        "a gain along nu",
        "[axis]\nnu = [0.1, 0.2]\n[[curve]]\n[[curve]]\nimpulses = { theta = 3.0 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { gain = { first = \"1\", second = \"2\" } }\n",
    ),
    (
        "rest under another curve",
        "[axis]\ndelta = [0.0, 1.0]\n[[curve]]\n[[curve]]\nimpulses = { theta = 3.0 }\n[[claim]]\nclaim = \"?\"\nsource = \"?\"\ntest = { alpha_held = { curves = [\"2\"] } }\n",
    ),
    ("a blank title", "title = \"\"\n[axis]\ndelta = [1.0]\n"),
    (
        "an unknown placeholder",
        "text = \"{rat:1@1.0}\"\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a placeholder for no curve",
        "text = \"{rate:2@1.0}\"\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "a placeholder for no value",
        "text = \"{rate:1@0.5}\"\n[axis]\ndelta = [0.0, 1.0]\n",
    ),
    (
        "a placeholder for several values",
        "text = \"{rate:1}\"\n[axis]\ndelta = [0.0, 1.0]\n",
    ),
    (
        "a placeholder for no quantity",
        "text = \"{quantity:largest}\"\n[axis]\ndelta = [1.0]\n",
    ),
    (
        "an open placeholder",
        "text = \"{rate:1@1.0\"\n[axis]\ndelta = [1.0]\n",
    ),
];

/// The messages of a sweep of each config, after checks of its exit code and of files left behind.
fn messages(configs: &[(&str, &str)], good: impl Fn(&str) -> String) -> String {
    let directory = tempfile::tempdir().unwrap();
    let mut messages = String::new();
    for (about, rest) in configs {
        let text = format!("{}{rest}", good(rest));
        fs::write(directory.path().join("bad.toml"), text).unwrap();
        let mut command = liftsim();
        command.current_dir(&directory).args(["sweep", "bad.toml"]);
        let (code, out, err) = outcome(&mut command);
        assert_eq!((code, out.as_str()), (2, ""), "{about}: {err}");
        assert!(!err.contains("panicked"), "{about}: {err}");
        assert!(!directory.path().join("results").exists(), "{about}");
        writeln!(messages, "--- {about}\n{err}").unwrap();
    }
    messages
}

#[test]
fn configs() {
    // A half-width replaces the number of trials.
    let good = |rest: &str| match rest.starts_with("half_width = 0.0000") {
        true => GOOD.replace("trials = 10\n", ""),
        false => GOOD.to_owned(),
    };
    insta::assert_snapshot!("configs", messages(CONFIGS, good));
}

/// Studies without trials.
const DRAWINGS: &[(&str, &str)] = &[
    ("no phases", "[trace]\nphases = []\n"),
    ("an unknown phase", "[trace]\nphases = [{ resting = 5 }]\n"),
    (
        "a phase of 0",
        "[trace]\nphases = [{ rest = 5 }, { inertial = 0 }]\n",
    ),
    (
        "an endless phase",
        "[trace]\nphases = [{ rest = 100000000000 }]\n",
    ),
    (
        "rate of 0",
        "[trace]\nphases = [{ rest = 5 }]\nrate = 0.0\n",
    ),
    (
        "negative sigma",
        "[trace]\nphases = [{ rest = 5 }]\nsigma = -1.0\n",
    ),
    (
        "negative vibration",
        "[trace]\nphases = [{ rest = 5 }]\nvibration = -1.0\n",
    ),
    (
        "a unit without a name",
        "[trace]\nphases = [{ rest = 5 }]\nunit = \"\"\n",
    ),
    (
        "drawn from beyond the end",
        "[trace]\nphases = [{ rest = 5 }]\ndrawn_from = 5\n",
    ),
    (
        "whitened without an acceleration",
        "[trace]\nphases = [{ rest = 500 }]\nwhitened = true\n",
    ),
    (
        "no rest to train on",
        "[trace]\nphases = [{ rest = 50 }, { acceleration = 12 }]\nwhitened = true\n",
    ),
    (
        "no room for Y2",
        "[trace]\nphases = [{ rest = 300 }, { acceleration = 12 }]\nwhitened = true\n",
    ),
    (
        "a rise longer than a phase",
        "[trace]\nphases = [{ acceleration = 10 }]\n[motion]\nprofile = { trapezoid = { rise = 6.0 } }\n",
    ),
    (
        "a duration beside phases",
        "[trace]\nphases = [{ acceleration = 10 }]\n[motion]\nduration = 6\n",
    ),
    (
        "whitening of what is not whitened",
        "[trace]\nphases = [{ acceleration = 10 }]\n[whitening]\norder = 3\n",
    ),
    ("no rules", "[region]\nrules = []\n"),
    ("an unknown rule", "[region]\nrules = [\"wilcoxen\"]\n"),
    (
        "a rule beside rules",
        "[region]\nrules = [\"product\"]\n[detector]\nrule = \"product\"\n",
    ),
    (
        "a rule out of reach",
        "[region]\nrules = [\"conjunction\"]\n[samples]\nscale = 1\n",
    ),
    ("no sizes", "[independence]\nsizes = []\n"),
    ("two sizes", "[independence]\nsizes = [[2, 2]]\n"),
    (
        "sizes of 0",
        "[independence]\nsizes = [[2, 2, 2], [2, 0, 2]]\n",
    ),
    (
        "too many assignments",
        "[independence]\nsizes = [[12, 12, 12]]\n",
    ),
    (
        "sizes twice",
        "[independence]\nsizes = [[2, 2, 2], [2, 2, 2]]\n",
    ),
    (
        "a rule twice",
        "[region]\nrules = [\"product\", \"product\"]\n",
    ),
    (
        "an immense layout",
        "[layout]\n[samples]\ngap = 9223372036854775807\n",
    ),
    (
        "immense sizes",
        "[independence]\nsizes = [[1, 1, 9223372036854775807]]\n",
    ),
];

/// Wrong tables of rides.
pub const RIDES: &[(&str, &str)] = &[
    ("no measure", "[ride.axis]\nrate = [100]\n"),
    (
        "one curve for a list",
        "measure = \"rides\"\n[ride.axis]\nrate = [100]\n[ride.curve]\nlabel = \"x\"\n",
    ),
    (
        "a number for a curve",
        "measure = \"rides\"\ncurve = [5]\n[ride.axis]\nrate = [100]\n",
    ),
    (
        "a text for a curve",
        "measure = \"rides\"\ncurve = [\"x\"]\n[ride.axis]\nrate = [100]\n",
    ),
    (
        "an unknown measure",
        "measure = \"ride\"\n[ride.axis]\nrate = [100]\n",
    ),
    (
        "an unknown key",
        "measure = \"rides\"\nspede = 1\n[ride.axis]\nrate = [100]\n",
    ),
    ("no axis", "measure = \"rides\"\n"),
    (
        "two axes",
        "measure = \"rides\"\n[ride.axis]\nrate = [100]\nalpha = [0.1]\n",
    ),
    (
        "an unknown axis",
        "measure = \"rides\"\n[ride.axis]\nrates = [100]\n",
    ),
    (
        "an axis of words",
        "measure = \"rides\"\n[ride.axis]\nlearnt = [true]\n",
    ),
    (
        "an axis of nothing",
        "measure = \"rides\"\n[ride.axis]\nrate = []\n",
    ),
    (
        "swept and set",
        "measure = \"rides\"\nrate = 50\n[ride.axis]\nrate = [100]\n",
    ),
    (
        "noise swept and set",
        "measure = \"rides\"\n[ride.axis]\nsigma = [0.1]\n[[ride.curve]]\ndensity = 0.1\n",
    ),
    (
        "noise said twice in a curve",
        "measure = \"rides\"\n[ride.axis]\nrate = [100]\n[[ride.curve]]\nsigma = 0.1\ndensity = 0.001\n",
    ),
    (
        "three ends of a rest",
        "measure = \"rides\"\nrest = [1, 2, 3]\n[ride.axis]\nrate = [100]\n",
    ),
    (
        "noise said twice",
        "measure = \"rides\"\nsigma = 0.1\ndensity = 0.1\n[ride.axis]\nrate = [100]\n",
    ),
    (
        "labels that make one name",
        "measure = \"rides\"\n[ride.axis]\nrate = [100]\n[[ride.curve]]\nlabel = \"a b\"\n\
         [[ride.curve]]\nlabel = \"A-b\"\n",
    ),
    (
        "a key of another measure",
        "measure = \"rest\"\nspeed = 1\n[ride.axis]\nalpha = [0.1]\n",
    ),
    (
        "an axis of another measure",
        "measure = \"rest\"\n[ride.axis]\nspeed = [1]\n",
    ),
    (
        "no trips",
        "measure = \"rides\"\ntrips = 0\n[ride.axis]\nrate = [100]\n",
    ),
    (
        "a rest from long to short",
        "measure = \"rides\"\nrest = [9, 8]\n[ride.axis]\nrate = [100]\n",
    ),
    (
        "no uniform motion",
        "measure = \"jam\"\ndistance = 1\n[ride.axis]\nspeed = [0.2, 2]\n",
    ),
    (
        "a jam of no time",
        "measure = \"jam\"\njam_within = 0\n[ride.axis]\nspeed = [1]\n",
    ),
    (
        "a negative sigma",
        "measure = \"rides\"\n[ride.axis]\nsigma = [0.1, -1]\n",
    ),
    (
        "a level of 2",
        "measure = \"rest\"\nalpha = 2\n[ride.axis]\nsigma = [0.1]\n",
    ),
    (
        "too little training",
        "measure = \"rest\"\ntraining = 3\n[ride.axis]\nsigma = [0.1]\n",
    ),
    (
        "an unstable sensor",
        "measure = \"rest\"\nar = [1.5]\n[ride.axis]\nsigma = [0.1]\n",
    ),
    (
        "a rest that fills the memory",
        "measure = \"rest\"\nlength = 1e9\n[ride.axis]\nsigma = [0.1]\n",
    ),
];

#[test]
fn rides() {
    let good = |_: &str| "question = \"?\"\nseed = 1\ntrials = 2\n[ride]\n".to_owned();
    insta::assert_snapshot!("rides", messages(RIDES, good));
}

#[test]
fn drawings() {
    let good = |_: &str| "question = \"?\"\nseed = 1\n".to_owned();
    insta::assert_snapshot!("drawings", messages(DRAWINGS, good));
}

#[test]
fn missing_keys() {
    let directory = tempfile::tempdir().unwrap();
    let mut messages = String::new();
    for (about, text) in [
        ("no question", "seed = 1\n[axis]\ndelta = [1.0]\n"),
        ("no seed", "question = \"?\"\n[axis]\ndelta = [1.0]\n"),
        (
            "no trials",
            "question = \"?\"\nseed = 1\ntrials = 0\n[axis]\ndelta = [1.0]\n",
        ),
        (
            "negative seed",
            "question = \"?\"\nseed = -1\n[axis]\ndelta = [1.0]\n",
        ),
        ("empty file", ""),
    ] {
        fs::write(directory.path().join("bad.toml"), text).unwrap();
        let (code, _, err) = outcome(
            liftsim()
                .current_dir(&directory)
                .args(["check", "bad.toml"]),
        );
        assert_eq!(code, 2, "{about}: {err}");
        writeln!(messages, "--- {about}\n{err}").unwrap();
    }
    insta::assert_snapshot!("missing_keys", messages);
}

/// Errors of the command line and the file system. Messages of the system itself are not part of the snapshot.
#[test]
fn arguments_and_places() {
    let directory = tempfile::tempdir().unwrap();
    let good = format!("{GOOD}[axis]\ndelta = [1.0]\n");
    fs::write(directory.path().join("good.toml"), good).unwrap();
    fs::write(directory.path().join("file"), "").unwrap();
    fs::create_dir(directory.path().join("damaged")).unwrap();
    fs::write(
        directory.path().join("damaged/points.csv"),
        "not,these\n1,2\n",
    )
    .unwrap();
    fs::write(directory.path().join("damaged/run.json"), "{}").unwrap();
    fs::create_dir(directory.path().join("foreign")).unwrap();
    fs::write(directory.path().join("foreign/points.csv"), "x\n").unwrap();
    fs::write(directory.path().join("empty.toml"), " \n\n").unwrap();
    fs::write(directory.path().join("nul.toml"), "question = \"?\"\n\0\0").unwrap();
    let long = format!(
        "{GOOD}[axis]\ndelta = [1.0]\n[[curve]]\nlabel = \"{}\"\n",
        "x".repeat(300)
    );
    fs::write(directory.path().join("long.toml"), long).unwrap();
    let made = std::process::Command::new("mkfifo")
        .arg(directory.path().join("pipe"))
        .status();
    assert!(made.unwrap().success());
    for (about, arguments, expected) in [
        (
            "an empty config",
            vec!["sweep", "empty.toml"],
            "error: empty.toml: is empty (`liftsim new` has configs to begin with)",
        ),
        (
            "bytes that are no text",
            vec!["sweep", "nul.toml"],
            "error: nul.toml:2:1: holds a NUL, which no text does (save it as UTF-8)",
        ),
        (
            "a label that is too long",
            vec!["plan", "long.toml"],
            "error: long.toml:7:10: figure: \"xxx",
        ),
        (
            "a pipe that nobody writes to",
            vec!["sweep", "pipe"],
            "error: pipe: cannot be read: it is a pipe that nobody writes to (check the path)",
        ),
        (
            "a number of a flag",
            vec!["check", "good.toml", "--nominal", "2.50"],
            "--nominal must lie strictly between 0 and 1, got 2.50",
        ),
        (
            "no config",
            vec!["sweep", "none.toml"],
            "none.toml: cannot be read",
        ),
        (
            "a directory for a config",
            vec!["sweep", "damaged"],
            "damaged: cannot be read",
        ),
        (
            "a file for a directory",
            vec!["sweep", "good.toml", "--out", "file"],
            "file: cannot be written",
        ),
        (
            "a place below a file",
            vec!["sweep", "good.toml", "--out", "file/below"],
            "file/below: cannot be written",
        ),
        (
            "damaged results",
            vec!["sweep", "good.toml", "--out", "damaged"],
            "run.json: not a result of liftsim",
        ),
        (
            "foreign results",
            vec!["sweep", "good.toml", "--out", "foreign"],
            "foreign: holds points.csv, but no run.json",
        ),
        (
            "nothing to plot",
            vec!["plot", "nowhere"],
            "run.json: cannot be read",
        ),
        (
            "trials of 0",
            vec!["sweep", "good.toml", "--trials", "0"],
            "--trials",
        ),
        (
            "threads of 0",
            vec!["sweep", "good.toml", "--threads", "0"],
            "--threads",
        ),
        (
            "nominal of 2",
            vec!["check", "good.toml", "--nominal", "2"],
            "--nominal must lie strictly between 0 and 1, got 2",
        ),
        ("unknown verb", vec!["sweeep"], "sweep"),
        ("nothing at all", vec![], "Usage"),
        (
            "sizes of 0",
            vec![
                "threshold",
                "--reference",
                "0",
                "--shift",
                "1",
                "--scale",
                "1",
                "--alpha",
                "0.5",
            ],
            "--reference <N>': must be at least 1",
        ),
        (
            "an alpha of 0",
            vec![
                "threshold",
                "--reference",
                "3",
                "--shift",
                "3",
                "--scale",
                "3",
                "--alpha",
                "0",
            ],
            "alpha must lie strictly between",
        ),
        (
            "large sizes",
            vec![
                "threshold",
                "--reference",
                "9000",
                "--shift",
                "9000",
                "--scale",
                "9000",
                "--alpha",
                "0.5",
            ],
            "MB of counts",
        ),
    ] {
        let (code, out, err) = outcome(liftsim().current_dir(&directory).args(&arguments));
        assert_eq!((code, out.as_str()), (2, ""), "{about}: {err}");
        assert!(err.contains(expected), "{about}: {err}");
        assert!(!err.contains("panicked"), "{about}: {err}");
        assert!(!directory.path().join("results").exists(), "{about}");
    }
}
