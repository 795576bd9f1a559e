//! `liftsim new`: a config to start from.

use super::output::{self, Output};
use super::{CommandResult, Failure, completions, print, table};
use anyhow::anyhow;
use clap::Args;
use liftsim::config::{SHIPPED, Shipped, Source};
use liftsim::experiment::SWEEP;
use liftsim::study::{self, reference};
use liftsim::suggest::nearest;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Write a config to start from.
///
/// Without a name, lists the configs that the program carries. With the name of one, writes it to NAME.toml. With
/// another name and --like, writes a copy of a config to NAME.toml, with all keys that one could add. NAME - is
/// standard output.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    liftsim new                         what there is\n  \
    liftsim new fig6                    writes fig6.toml\n  \
    liftsim new my_study --like fig6    writes my_study.toml, to be changed\n\n\
    Every command that takes a config takes the name of a shipped one too: liftsim sweep fig6")]
pub struct New {
    /// A shipped config, or with --like the name of the new one.
    #[arg(add = completions::configs(&["sweep", "simulate"]))]
    name: Option<PathBuf>,
    /// What to begin with: a shipped config or a file.
    #[arg(long, value_name = "CONFIG", requires = "name", add = completions::configs(&["sweep", "simulate"]))]
    like: Option<PathBuf>,
    /// Replace a file that exists.
    #[arg(long, requires = "name")]
    force: bool,
}

impl New {
    /// Runs the command.
    pub fn run(self) -> CommandResult {
        let Some(name) = self.name else {
            print(&list()?)?;
            return Ok(ExitCode::SUCCESS);
        };
        let path = match name.extension() {
            None if output::is_stdout(&name) => name,
            None => name.with_extension("toml"),
            Some(end) if end == "toml" => name,
            Some(_) => {
                let name = name.display();
                return Err(Failure::Input(anyhow!(
                    "NAME must end in .toml or have no ending, got {name}"
                )));
            }
        };
        let output = Output::new(&path, self.force)?;
        let (text, command) = match &self.like {
            Some(like) => begun(&path, like)?,
            None => shipped(&path).map(|shipped| (shipped.text.to_owned(), shipped.command))?,
        };
        output.write(text.as_bytes())?.publish()?;
        if output::is_stdout(&path) {
            return Ok(ExitCode::SUCCESS);
        }
        let path = path.display();
        print(&match command {
            "simulate" => format!(
                "{path}\n\nliftsim simulate {path} --out FILE.csv    makes a recording of it\n"
            ),
            _ => format!(
                "{path}\n\nliftsim plan {path}     says what it would take\n\
                 liftsim sweep {path}    runs it\n"
            ),
        })?;
        Ok(ExitCode::SUCCESS)
    }
}

/// The shipped config that a file is named after.
fn shipped(path: &Path) -> Result<&'static Shipped, Failure> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    Shipped::find(&name).ok_or_else(|| {
        let near = nearest(&name, SHIPPED.iter().map(|shipped| shipped.name));
        let hint = near.map_or(String::new(), |near| format!(", did you mean {near}?"));
        Failure::Input(anyhow!(
            "no shipped config is called {name}{hint} (`liftsim new` lists them; for one of your own add \
             --like fig6, or another to begin with)"
        ))
    })
}

/// What there is, by the command that it is for.
fn list() -> Result<String, Failure> {
    let (mut studies, mut rides) = (Vec::new(), Vec::new());
    for shipped in SHIPPED {
        let row = vec![shipped.name.to_owned(), about(shipped)?];
        if shipped.command == "simulate" {
            rides.push(row);
        } else {
            studies.push(row);
        }
    }
    Ok(format!(
        "{}\n{}\nliftsim new NAME writes one to NAME.toml, liftsim new MINE --like NAME a copy to be changed\n",
        table(&["liftsim sweep", "asks"], &studies),
        table(&["liftsim simulate", "makes"], &rides),
    ))
}

/// What a shipped config asks, or makes.
pub fn about(shipped: &Shipped) -> Result<String, Failure> {
    if shipped.command == "simulate" {
        let first = shipped.text.lines().next().unwrap_or_default();
        return Ok(first.trim_start_matches('#').trim().to_owned());
    }
    let experiment = study::parse(shipped.name, shipped.text).map_err(Failure::input)?;
    Ok(experiment.header.question.to_string())
}

/// The text of a config at `path`, begun as a copy of another, and the command that it is for.
fn begun(path: &Path, like: &Path) -> Result<(String, &'static str), Failure> {
    let is_of_ride = |shipped: &Shipped| shipped.command == "simulate";
    let shipped = like.to_str().and_then(Shipped::find);
    let source = if shipped.is_some_and(is_of_ride) {
        Source::find(like, "simulate")
    } else {
        Source::find(like, "sweep")
    };
    let source = source.map_err(Failure::input)?;
    // Only a study asks something.
    let tree = source.parse().map_err(Failure::input)?;
    let command = if tree.get("question").is_some() {
        "sweep"
    } else {
        "simulate"
    };
    let file = if output::is_stdout(path) {
        Path::new("NAME.toml")
    } else {
        path
    };
    let (file, like) = (file.display(), like.display());
    let mut text = format!("# {file}, begun as a copy of {like}.\n");
    if command == "sweep" {
        text += &format!(
            "# Change the question and what follows, then\n\
             #     liftsim plan {file}     says what it would take\n\
             #     liftsim sweep {file}    runs it\n\
             # `liftsim keys` explains every key, `liftsim keys detector` those of one table.\n"
        );
    }
    let lines = source.text().lines();
    for line in lines.skip_while(|line| line.starts_with("#:schema")) {
        text += &format!("{line}\n");
    }
    if command == "sweep" {
        let experiment = study::parse(source.name(), source.text()).map_err(Failure::input)?;
        if experiment.study() == SWEEP {
            text += &all_sections();
        }
    }
    Ok((text, command))
}

/// The sections of a sweep and their defaults, as comments.
fn all_sections() -> String {
    let mut text = "\n# All sections that a file or a [[curve]] may have, with the default of each key. A table can stand \
        in a\n# file once: where it does, add the key there.\n"
        .to_owned();
    for section in reference::sections() {
        text += &format!("#\n# {}\n", section.title);
        for key in &section.keys {
            let default = if key.default.is_empty() {
                "…"
            } else {
                &key.default
            };
            text += &format!("# {} = {default}    # {}\n", key.name, key.meaning);
        }
    }
    text
}
