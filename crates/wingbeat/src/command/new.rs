//! `wingbeat new` and `wingbeat presets`: what flights there are to start from.

use std::path::PathBuf;

use clap::Args;
use wingbeat::case::{self, presets};
use wingbeat::results::file::write_file;

use crate::command::failure::Failure;
use crate::command::target::Target;
use crate::command::terminal::say;

/// Arguments of `wingbeat new`.
#[derive(Args)]
pub(crate) struct NewArgs {
    /// Name of the preset.
    preset: String,
    /// File to write, - for the standard output; default PRESET.toml.
    file: Option<PathBuf>,
    /// Write the schema for editors beside it, too.
    #[arg(long)]
    schema: bool,
    /// Replace files that exist already.
    #[arg(long)]
    overwrite: bool,
}

/// `wingbeat new`.
pub(crate) fn new(args: &NewArgs) -> Result<(), Failure> {
    let preset = presets::find(&args.preset)?;
    let named = || PathBuf::from(format!("{}.toml", preset.name));
    let path = args.file.clone().unwrap_or_else(named);
    let target = Target::claim(&path, args.overwrite)?;
    if args.schema {
        write_schema(&target, args.overwrite)?;
    }
    target.write(&case::with_schema(preset.text))?;
    if let Some(path) = target.path() {
        say!("wrote {0}; fly it with `wingbeat run {0}`", path.display());
    }
    Ok(())
}

/// Writes the schema beside a case.
fn write_schema(case: &Target, overwrite: bool) -> Result<(), Failure> {
    let Some(path) = case.path() else {
        let problem = "--schema writes a file beside the case, which has none on the standard output; `wingbeat schema` prints it";
        return Err(Failure::Option(problem.to_owned()));
    };
    let file = path.with_file_name(case::SCHEMA_FILE);
    write_file(&file, case::schema().as_bytes(), overwrite)?;
    say!("wrote {}", file.display());
    Ok(())
}

/// `wingbeat presets`.
pub(crate) fn list() {
    say!("Presets (wingbeat run NAME, wingbeat new NAME):");
    for preset in presets::PRESETS {
        say!("  {:<27}{}", preset.name, preset.line());
    }
    say!("\nSets of wing angles (motion.data):");
    for (name, line) in case::data_sets() {
        say!("  {name:<28}{line}");
    }
}
