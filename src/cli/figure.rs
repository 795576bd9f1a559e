//! How the figure of a study is drawn: the flags of `sweep`, `figures` and `plot`, over `[figure]` of the config.

use super::output::not_stdout;
use super::store::{line, remove_stale, store};
use super::{Failure, warn};
use anyhow::anyhow;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use liftsim::config::decoded;
use liftsim::figure::Drawing;
use liftsim::plot::{ColourName, Dpi, Format, Height, LegendPlace, Options, Scale, Width};
use liftsim::results::Directory;
use liftsim::run::DrawError;
use liftsim::study::Loaded;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// The keys of `[figure]` as flags.
#[derive(Clone, Debug, Default, Args, Serialize)]
#[command(next_help_heading = "The figure (instead of what [figure] of the config says)")]
pub struct FigureFlags {
    /// Width of the sheet, mm [default: 139.7].
    #[arg(long, value_name = "MM", value_parser = number(Width::new, Width::get))]
    #[serde(skip_serializing_if = "Option::is_none")]
    width: Option<f64>,
    /// Height of the sheet, mm.
    #[arg(long, value_name = "MM", value_parser = number(Height::new, Height::get))]
    #[serde(skip_serializing_if = "Option::is_none")]
    height: Option<f64>,
    /// Dots per inch of a PNG [default: 300].
    #[arg(long, value_name = "N", value_parser = number(Dpi::new, Dpi::get))]
    #[serde(skip_serializing_if = "Option::is_none")]
    dpi: Option<f64>,
    /// The kinds of files among the results, separated by commas [default: png,svg].
    #[arg(long, value_name = "KINDS", value_delimiter = ',', value_parser = named(&Format::ALL))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    format: Vec<Format>,
    /// The scale of y.
    #[arg(long, value_name = "SCALE", value_parser = named(&Scale::ALL))]
    #[serde(skip_serializing_if = "Option::is_none")]
    y_scale: Option<Scale>,
    /// The ends of x, such as 0..2.
    #[arg(long, value_name = "A..B", value_parser = range, allow_hyphen_values = true)]
    #[serde(skip_serializing_if = "Option::is_none")]
    x_range: Option<[f64; 2]>,
    /// The ends of y.
    #[arg(long, value_name = "A..B", value_parser = range, allow_hyphen_values = true)]
    #[serde(skip_serializing_if = "Option::is_none")]
    y_range: Option<[f64; 2]>,
    /// The colours of the curves, by name, separated by commas.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = named(&ColourName::ALL))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    colours: Vec<ColourName>,
    /// Draw lines without markers.
    #[arg(long)]
    #[serde(skip)]
    no_markers: bool,
    /// Where the legend stands.
    #[arg(long, value_name = "PLACE", value_parser = named(&LegendPlace::ALL))]
    #[serde(skip_serializing_if = "Option::is_none")]
    legend: Option<LegendPlace>,
    /// Leave the caption out.
    #[arg(long)]
    #[serde(skip)]
    no_caption: bool,
    /// Curves of your own over it: a CSV file with the columns x, y and name.
    #[arg(long, value_name = "FILE.csv")]
    #[serde(skip)]
    overlay: Option<PathBuf>,
}

/// Reads a number that satisfies a rule.
fn number<T: 'static>(
    new: fn(f64) -> Result<T, liftsim::rule::OutOfRange>,
    get: fn(T) -> f64,
) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let value = text.parse().map_err(|_| "must be a number".to_owned())?;
        new(value).map(get).map_err(|error| error.to_string())
    }
}

/// Reads one of these names.
fn named<T: Copy + Send + Sync>(
    choices: &'static [(&'static str, T)],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(choices.iter().map(|(name, _)| *name)).map(|name| {
        let chosen = choices.iter().find(|(known, _)| *known == name);
        chosen.expect("no other name is possible").1
    })
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let ends = text
        .split_once("..")
        .and_then(|(from, to)| Some([from.parse().ok()?, to.parse().ok()?]));
    let ends = ends.filter(|ends: &[f64; 2]| ends.iter().all(|end| end.abs() < 1e15));
    ends.ok_or_else(|| "must be two numbers, such as 0..2".to_owned())
}

impl FigureFlags {
    /// The keys that are given and have a value.
    fn written(&self) -> serde_json::Map<String, Value> {
        match serde_json::to_value(self) {
            Ok(Value::Object(keys)) => keys,
            _ => serde_json::Map::new(),
        }
    }

    /// Lays the flags over `[figure]` of a config in `folder`, and reads the curves of one's own.
    pub fn lay_over(&self, loaded: &mut Loaded, folder: &Path) -> Result<(), Failure> {
        let mut keys = match serde_json::to_value(&loaded.figure) {
            Ok(Value::Object(keys)) => keys,
            _ => serde_json::Map::new(),
        };
        keys.extend(self.written());
        for (key, is_off) in [("markers", self.no_markers), ("caption", self.no_caption)] {
            if is_off {
                keys.insert(key.to_owned(), Value::Bool(false));
            }
        }
        loaded.figure = Options::deserialize(Value::Object(keys)).map_err(Failure::input)?;
        let own = self.overlay.clone();
        let path = own.or_else(|| Some(folder.join(loaded.figure.overlay.as_ref()?)));
        if let Some(path) = path {
            not_stdout("--overlay", "a file", &path)?;
            let refused =
                |why: String| Failure::Input(anyhow!("{}: overlay {why}", path.display()));
            let bytes = fs::read(&path)
                .map_err(|error| refused(format!("cannot be read: {error} (check the path)")))?;
            let text = decoded(&bytes).ok_or_else(|| {
                refused("is not text in UTF-8 or UTF-16 (save it as UTF-8)".to_owned())
            })?;
            let read = loaded.set_overlay(text);
            read.map_err(|error| Failure::Input(anyhow!("{}: {error}", path.display())))?;
        }
        Ok(())
    }
}

/// How a figure is drawn, but for curves of one's own, which lie beside it.
pub fn drawn(loaded: &Loaded) -> Option<Value> {
    let options = Options {
        overlay: None,
        ..loaded.figure.clone()
    };
    let keys = serde_json::to_value(options).expect("options are plain data");
    Some(keys).filter(|keys| keys.as_object().is_some_and(|keys| !keys.is_empty()))
}

/// Whether the figure of complete results is another than this one.
pub fn differs(loaded: &Loaded, directory: &Directory) -> bool {
    directory.manifest().is_ok_and(|manifest| {
        let own = directory.overlay(&manifest).ok();
        manifest.figure != drawn(loaded) || own.as_deref() != loaded.overlay()
    })
}

/// The folder of a config, from which paths in it count.
pub fn folder(config: &Path) -> &Path {
    config.parent().unwrap_or(Path::new(""))
}

/// Draws the figure of complete results again, and stores it. Returns a line for each file.
pub fn redraw(loaded: &Loaded, directory: &Directory) -> Result<String, Failure> {
    let _lock = directory.lock().map_err(Failure::input)?;
    let mut manifest = directory.manifest().map_err(Failure::input)?;
    let points = directory.points(&manifest).map_err(Failure::input)?;
    let drawing = loaded
        .draw(&points, &manifest)
        .map_err(|error| undrawn(directory, error))?;
    manifest
        .files
        .retain(|name, _| !Drawing::NAMES.contains(&&name[..]));
    manifest.figure = drawn(loaded);
    let mut lines = String::new();
    for (name, bytes) in told(drawing) {
        let is_new = store(directory, &mut manifest, name, &bytes)?;
        lines += &line(directory, name, is_new);
    }
    directory
        .write("run.json", &manifest.to_json())
        .map_err(Failure::run)?;
    lines += &remove_stale(directory, &manifest)?;
    Ok(lines)
}

/// The files of a drawing, after a warning for each of its notes.
pub fn told(drawing: Drawing) -> Vec<(&'static str, Vec<u8>)> {
    warn_of_notes(&drawing.notes);
    drawing.files
}

/// Warns of what the reader of a picture must be told.
pub fn warn_of_notes(notes: &[String]) {
    notes
        .iter()
        .for_each(|note| warn(format_args!("figure: {note}")));
}

/// Why the rows of a directory were not drawn.
pub fn undrawn(directory: &Directory, error: DrawError) -> Failure {
    match error {
        DrawError::Rows(error) => Failure::input(directory.damaged_points(error)),
        DrawError::Figure(error) => Failure::input(error),
    }
}
