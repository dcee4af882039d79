//! `wingbeat campaign view`: one page that shows all points.

use clap::Args;
use wingbeat::campaign::page;

use super::args::Place;
use crate::command::output::failure::Failure;
use crate::command::output::terminal::say;
use crate::command::result::view::open;

/// Arguments of `wingbeat campaign view`.
#[derive(Args)]
pub(super) struct ViewArgs {
    #[command(flatten)]
    place: Place,
    /// Only write the page.
    #[arg(long)]
    no_open: bool,
}

/// The whole command.
pub(super) fn view(args: &ViewArgs) -> Result<(), Failure> {
    let (campaign, store) = args.place.existing()?;
    let page = page::write(&campaign, &store)?;
    say!("wrote {}", page.display());
    if !args.no_open && !open(&page) {
        say!("No browser could be started: open this file in one.");
    }
    Ok(())
}
