//! `wingbeat export`: a run in a format of other programs.

use std::path::PathBuf;

use clap::Args;
use wingbeat::results::ResultDir;
use wingbeat::results::export::{self, Format};
use wingbeat::results::file::Existing;

use crate::command::options::Choice;
use crate::command::output::failure::Failure;
use crate::command::output::target::folder;
use crate::command::output::terminal::say;

/// Arguments of `wingbeat export`.
#[derive(Args)]
pub(crate) struct ExportArgs {
    /// Result directory of the run.
    dir: PathBuf,
    /// Format: hdf5, vtkhdf, parquet or gltf.
    #[arg(long, value_parser = Choice(&Format::ALL), hide_possible_values = true)]
    format: Format,
    /// Folder for the files; default the result directory.
    #[arg(long, value_name = "DIR", value_parser = folder())]
    out: Option<PathBuf>,
    /// Replace files that exist already.
    #[arg(long)]
    overwrite: bool,
}

/// The whole command.
pub(crate) fn export(args: &ExportArgs) -> Result<(), Failure> {
    let dir = ResultDir::read(&args.dir)?;
    let into = args.out.as_ref().unwrap_or(&args.dir);
    for file in export::export(
        &dir,
        args.format,
        into,
        Existing::kept_unless(args.overwrite),
    )? {
        say!("wrote {}", file.display());
    }
    Ok(())
}
