//! What leaves the program: standard output, files that appear whole or not at all, one-line errors.

use std::fs;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anstyle::{AnsiColor, Style};
use assur::FamilyError;
use assur::exchange::FileError;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::Asked;
use crate::derive::UnknownDerivation;
use crate::png;

/// Why there is no answer; prints as one line.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error(transparent)]
    File(#[from] FileError),
    #[error(transparent)]
    Family(#[from] FamilyError),
    #[error(transparent)]
    PathFile(#[from] assur::exchange::PathFileError),
    #[error(transparent)]
    Batch(#[from] assur::exchange::BatchFileError),
    #[error(transparent)]
    Derivation(#[from] UnknownDerivation),
    /// A file and what is wrong with the question about it.
    #[error("{0}: {1}")]
    About(String, String),
    #[error("{0}: cannot be written: {1}")]
    Unwritable(String, std::io::Error),
    #[error("standard output: {0}")]
    Print(std::io::Error),
    #[error(transparent)]
    Picture(#[from] png::PictureError),
}

/// Prints the error and gives its exit status; a reader that went away is none.
pub(crate) fn report(failure: &Failure) -> ExitCode {
    if matches!(failure, Failure::Print(error) if error.kind() == ErrorKind::BrokenPipe) {
        return ExitCode::SUCCESS;
    }
    let red = Style::new().bold().fg_color(Some(AnsiColor::Red.into()));
    // With standard error gone as well there is nobody left to tell.
    let _ = writeln!(anstream::stderr(), "{red}error:{red:#} {failure}");
    ExitCode::FAILURE
}

/// Prints a text on standard output; its colours only reach a terminal.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = anstream::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(Failure::Print)
}

/// Puts bytes on standard output as they are.
pub(crate) fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(bytes).and_then(|()| out.flush()).map_err(Failure::Print)
}

/// How far a long job has come, in the words of an indicatif template; shown on a terminal only, on standard error.
pub(crate) fn progress(length: Option<u64>, template: &str) -> ProgressBar {
    let target = if io::stderr().is_terminal() { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(length, target);
    bar.set_style(ProgressStyle::with_template(template).expect("a template of the program's own"));
    bar
}

/// Files to be written together: all appear whole, or none is touched.
#[derive(Default)]
pub(crate) struct Files {
    contents: Vec<(PathBuf, Vec<u8>)>,
}

impl Files {
    pub(crate) fn with(mut self, path: &Path, content: Vec<u8>) -> Self {
        self.contents.push((path.to_owned(), content));
        self
    }

    /// The drawings that are asked for, drawn at most once.
    pub(crate) fn with_drawings(self, asked: &Asked, draw: impl Fn() -> String) -> Result<Self, Failure> {
        self.with_pictures(asked.svg.as_deref(), asked.png.as_deref(), draw)
    }

    /// A drawing as SVG, as PNG, as both or not at all.
    pub(crate) fn with_pictures(
        self,
        svg: Option<&Path>,
        png: Option<&Path>,
        draw: impl Fn() -> String,
    ) -> Result<Self, Failure> {
        if svg.is_none() && png.is_none() {
            return Ok(self);
        }
        let drawing = draw();
        let mut files = self;
        if let Some(path) = png {
            files = files.with(path, png::render(&drawing)?);
        }
        if let Some(path) = svg {
            files = files.with(path, drawing.into_bytes());
        }
        Ok(files)
    }

    pub(crate) fn write(self) -> Result<(), Failure> {
        let mut staged = Staged::default();
        for (path, content) in &self.contents {
            let failed = |error| Failure::Unwritable(path.display().to_string(), error);
            // Pipes and devices cannot be replaced; they are written to at the end.
            if fs::metadata(path).is_ok_and(|target| !target.is_file()) {
                if path.is_dir() {
                    return Err(failed(ErrorKind::IsADirectory.into()));
                }
                continue;
            }
            let mut name = path.file_name().ok_or_else(|| failed(ErrorKind::InvalidFilename.into()))?.to_owned();
            name.push(format!(".{}.tmp", std::process::id()));
            let temporary = path.with_file_name(name);
            staged.files.push((temporary.clone(), path.clone()));
            fs::write(&temporary, content).map_err(failed)?;
        }
        for (path, content) in &self.contents {
            let failed = |error| Failure::Unwritable(path.display().to_string(), error);
            match staged.files.iter().find(|(_, target)| target == path) {
                Some((temporary, target)) => fs::rename(temporary, target).map_err(failed)?,
                None => fs::write(path, content).map_err(failed)?,
            }
        }
        Ok(())
    }
}

/// Files that carry a temporary name; what still does in the end is removed.
#[derive(Default)]
struct Staged {
    files: Vec<(PathBuf, PathBuf)>,
}

impl Drop for Staged {
    fn drop(&mut self) {
        for (temporary, _) in &self.files {
            // After a rename it is gone already.
            let _ = fs::remove_file(temporary);
        }
    }
}
