//! Files that a command writes. What is in the way is refused before anything takes long, and either all of
//! them appear or none does. A file that exists is replaced only with --force, and `-` is standard output.

use super::{Failure, print, say};
use anyhow::anyhow;
use liftsim::figure::{self, DPI, Kind};
use liftsim::files::Draft;
use liftsim::format::shorten;
use liftsim::plot::Plot;
use std::env;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file to be written, or standard output.
#[derive(Clone, Debug)]
pub struct Output {
    path: PathBuf,
    replaces: bool,
}

/// What is written to standard output.
const STDOUT: &str = "-";

/// Whether this is standard output.
pub fn is_stdout(path: &Path) -> bool {
    path == Path::new(STDOUT)
}

/// Refuses standard output for a flag that wants something else.
pub fn not_stdout(flag: &str, wanted: &str, path: &Path) -> Result<(), Failure> {
    if is_stdout(path) {
        return Err(Failure::Input(anyhow!(
            "{flag} must be {wanted}, got -, which is standard output (write ./- for one of that name)"
        )));
    }
    Ok(())
}

/// What a flag must be whose file is read again.
pub const KEPT: &str = "a file that is kept";

/// What a flag must be that takes many files.
pub const DIRECTORY: &str = "a directory";

/// Prints the result of a command: to standard output, unless one of these files goes there.
pub fn print_beside<'a>(
    mut files: impl Iterator<Item = &'a PathBuf>,
    text: &str,
) -> Result<(), Failure> {
    if files.any(|file| is_stdout(file)) {
        say(text.trim_end());
        return Ok(());
    }
    print(text)
}

/// Refuses an output that is the input, or another output, by whatever name.
pub fn apart<'a>(
    input: &'a Path,
    outputs: impl Iterator<Item = &'a PathBuf>,
) -> Result<(), Failure> {
    let mut known = vec![place(input)];
    for output in outputs {
        let place = place(output);
        if known.contains(&place) {
            return Err(Failure::Input(anyhow!(
                "{}: is written to and used for something else too (give another name)",
                output.display()
            )));
        }
        known.push(place);
    }
    Ok(())
}

/// Where a name leads, links followed as far as there is anything.
pub fn place(path: &Path) -> PathBuf {
    let there = path.canonicalize();
    there.unwrap_or_else(|_| match (path.parent(), path.file_name()) {
        (Some(folder), Some(name)) => {
            let folder = if folder.as_os_str().is_empty() {
                Path::new(".")
            } else {
                folder
            };
            let folder = folder.canonicalize();
            folder.map_or(path.to_owned(), |folder| folder.join(name))
        }
        _ => path.to_owned(),
    })
}

/// Says that a file was written.
pub fn print_written(path: &PathBuf) -> Result<(), Failure> {
    print_beside(
        [path].into_iter(),
        &format!("{}  written\n", path.display()),
    )
}

/// A file that is complete but not yet in its place.
#[derive(Debug)]
pub struct Ready {
    draft: Draft,
    output: Output,
}

impl Output {
    /// Refuses a file that exists, unless it may be replaced, and one in a folder that does not exist.
    pub fn new(path: &Path, replaces: bool) -> Result<Self, Failure> {
        let output = Self {
            path: path.to_owned(),
            replaces,
        };
        if is_stdout(path) {
            return Ok(output);
        }
        match output.obstacle() {
            None => Ok(output),
            Some(obstacle) => Err(Failure::Input(anyhow!("{}: {obstacle}", path.display()))),
        }
    }

    /// A file that is kept: read where it is there, and replaced by the same with more in it.
    pub fn kept(flag: &str, path: &Path) -> Result<Self, Failure> {
        not_stdout(flag, KEPT, path)?;
        Self::new(path, true)
    }

    /// The same for the picture of a flag, whose name must end in .png or .svg.
    pub fn picture(flag: &str, path: &Path, replaces: bool) -> Result<Self, Failure> {
        Self::named(path, replaces, flag, &["png", "svg"])
    }

    /// The same for a page, whose name must end in .html.
    pub fn page(path: &Path, replaces: bool) -> Result<Self, Failure> {
        Self::named(path, replaces, "--report", &["html", "htm"])
    }

    /// The same for a file of a flag, whose name must end in one of these.
    pub fn named(path: &Path, replaces: bool, flag: &str, ends: &[&str]) -> Result<Self, Failure> {
        let end = path.extension();
        if is_stdout(path) || end.is_some_and(|end| ends.iter().any(|it| end == *it)) {
            return Self::new(path, replaces);
        }
        Err(Failure::Input(anyhow!(
            "{flag} must end in .{}, got {}",
            ends.join(" or ."),
            path.display()
        )))
    }

    /// Where it goes.
    pub fn path(&self) -> &PathBuf {
        &self.path
    }

    /// What is in the way.
    fn obstacle(&self) -> Option<String> {
        let folder = self.path.parent();
        let folder = folder.filter(|folder| !folder.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| !folder.exists()) {
            let folder = folder.display().to_string();
            let folder = shorten(&folder);
            return Some(format!(
                "cannot be written: no folder {folder} (make it, or give another name)"
            ));
        }
        // Of a link itself, for what it points to may be anything.
        let there = self.path.symlink_metadata().ok()?;
        if !self.replaces {
            Some("already exists (give another name, or --force to replace it)".to_owned())
        } else if !there.is_file() {
            Some("is not an ordinary file and cannot be replaced (give another name)".to_owned())
        } else {
            None
        }
    }

    /// Writes these bytes.
    pub fn write(self, bytes: &[u8]) -> Result<Ready, Failure> {
        self.write_with(|out| out.write_all(bytes))
    }

    /// Writes a picture in the kind that the name says; `origin` says what it was made from.
    pub fn draw(self, plot: &Plot, origin: &str) -> Result<Ready, Failure> {
        let provenance = format!("liftsim {}, {origin}", env!("CARGO_PKG_VERSION"));
        self.draw_at(plot, &provenance, DPI)
    }

    /// The same with dots per inch of a PNG; `provenance` says what made the picture.
    pub fn draw_at(self, plot: &Plot, provenance: &str, dpi: u32) -> Result<Ready, Failure> {
        // The name was checked, but standard output has none.
        let kind = Kind::of(&self.path, dpi).unwrap_or(Kind::Svg);
        let bytes = figure::file(plot, provenance, kind).map_err(Failure::run)?;
        self.write(&bytes)
    }

    /// Writes what `content` writes.
    pub fn write_with(
        self,
        content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> Result<Ready, Failure> {
        let draft = if is_stdout(&self.path) {
            Draft::new(&env::temp_dir().join("liftsim"), content)
        } else {
            Draft::new(&self.path, content)
        };
        let draft = draft.map_err(|error| self.unwritable(&error))?;
        let output = self;
        Ok(Ready { draft, output })
    }

    fn unwritable(&self, error: &io::Error) -> Failure {
        let path = self.path.display();
        let remedy = match error.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "make room there",
            _ => "give another name",
        };
        Failure::Input(anyhow!("{path}: cannot be written: {error} ({remedy})"))
    }
}

impl Ready {
    /// Puts it in its place.
    pub fn publish(self) -> Result<(), Failure> {
        let Self { draft, output } = self;
        let moved = if is_stdout(&output.path) {
            match draft.copy_to(&mut io::stdout().lock()) {
                // A reader that has seen enough is not an error.
                Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
                copied => copied,
            }
        } else if output.replaces {
            draft.replace()
        } else {
            draft.create_new()
        };
        moved.map_err(|error| output.unwritable(&error))
    }
}
