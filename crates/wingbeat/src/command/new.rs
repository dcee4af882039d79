//! `wingbeat new` and `wingbeat presets`: what flights there are to start from.

use std::path::PathBuf;

use clap::Args;
use wingbeat::case::{self, presets};

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
    /// Replace the file if there is one.
    #[arg(long)]
    overwrite: bool,
}

/// `wingbeat new`.
pub(crate) fn new(args: &NewArgs) -> Result<(), Failure> {
    let preset = presets::find(&args.preset)?;
    let named = || PathBuf::from(format!("{}.toml", preset.name));
    let target = Target::claim(&args.file.clone().unwrap_or_else(named), args.overwrite)?;
    target.write(preset.text)?;
    if let Some(path) = target.path() {
        say!("wrote {0}; fly it with `wingbeat run {0}`", path.display());
    }
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
