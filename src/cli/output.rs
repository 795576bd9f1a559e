//! Files that a command writes: what is in the way is refused before anything takes long.

use super::Failure;
use anyhow::anyhow;
use liftsim::figure::Drawing;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file to be written.
#[derive(Clone, Debug)]
pub struct Output {
    path: PathBuf,
    replaces: bool,
}

impl Output {
    /// Refuses a file that exists, unless it may be replaced, and one in a folder that does not.
    pub fn new(path: &Path, replaces: bool) -> Result<Self, Failure> {
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        let name = path.display();
        if let Some(folder) = folder.filter(|folder| !folder.exists()) {
            let folder = folder.display();
            return Err(Failure::Input(anyhow!(
                "{name}: cannot be written: no folder {folder} (make it, or give another name)"
            )));
        }
        if !replaces && path.exists() {
            return Err(Failure::Input(anyhow!(
                "{name}: is there already (give another name, or --force to replace it)"
            )));
        }
        Ok(Self {
            path: path.to_owned(),
            replaces,
        })
    }

    /// The same for a picture, whose name must say of which kind it is.
    pub fn picture(path: &Path, replaces: bool) -> Result<Self, Failure> {
        match path.extension().is_some_and(|e| e == "png" || e == "svg") {
            true => Self::new(path, replaces),
            false => Err(Failure::Input(anyhow!(
                "--figure must end in .png or .svg, got {}",
                path.display()
            ))),
        }
    }

    /// Where it goes.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes what is all there.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        self.write_with(|out| out.write_all(bytes))
    }

    /// Writes a picture in the kind that the name says.
    pub fn draw(&self, drawing: &Drawing) -> Result<(), Failure> {
        match self.path.extension().is_some_and(|e| e == "svg") {
            true => self.write(&drawing.svg),
            false => self.write(&drawing.png),
        }
    }

    /// Writes what comes bit by bit.
    pub fn write_with(
        &self,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let mut options = File::options();
        match self.replaces {
            true => options.create(true).truncate(true),
            false => options.create_new(true),
        };
        let written = options.write(true).open(&self.path).and_then(|file| {
            let mut out = BufWriter::new(file);
            content(&mut out)?;
            out.flush()
        });
        written.map_err(|error| {
            Failure::Input(anyhow!(
                "{}: cannot be written: {error} (give another name)",
                self.path.display()
            ))
        })
    }
}
