//! `wingbeat campaign plan`, `numbers` and `merge`: tables.

use std::io::{BufWriter, ErrorKind, Write as _};
use std::path::PathBuf;

use clap::Args;
use wingbeat::campaign::merge;
use wingbeat::campaign::{Campaign, Status, Store};
use wingbeat::case::IoError;
use wingbeat::results::file::{Existing, NewFile};

use super::args::{Place, PointSelection};
use crate::command::output::failure::{FAILED, Failure};
use crate::command::output::terminal::{output, say, tell};

/// Arguments of `wingbeat campaign plan`.
#[derive(Args)]
pub(super) struct PlanArgs {
    /// File of the campaign.
    file: PathBuf,
    /// Write the table to a file instead of the terminal.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace a file that exists already.
    #[arg(long, requires = "out")]
    overwrite: bool,
    #[command(flatten)]
    part: PointSelection,
}

/// Arguments of `wingbeat campaign numbers`.
#[derive(Args)]
pub(super) struct NumbersArgs {
    /// File of the campaign.
    file: PathBuf,
}

/// Arguments of `wingbeat campaign merge`.
#[derive(Args)]
pub(super) struct MergeArgs {
    #[command(flatten)]
    place: Place,
    /// Also while points have no result yet.
    #[arg(long)]
    partial: bool,
    /// Also where another campaign was run last, whose tables are replaced.
    #[arg(long)]
    overwrite: bool,
}

/// `wingbeat campaign plan`.
pub(super) fn plan(args: &PlanArgs) -> Result<(), Failure> {
    let file = (args.out.as_ref())
        .map(|path| NewFile::claim(path, Existing::kept_unless(args.overwrite)))
        .transpose()?;
    let campaign = Campaign::read(&args.file)?;
    let range = args.part.range(campaign.plan().points())?;
    let Some(file) = file else {
        let mut out = BufWriter::new(std::io::stdout().lock());
        let written = merge::plan(&campaign, range, &mut out).and_then(|()| out.flush());
        return match written {
            Err(e) if e.kind() != ErrorKind::BrokenPipe => {
                tell!("error: the standard output cannot be written: {e}");
                Err(Failure::Told(FAILED))
            }
            _ => Ok(()),
        };
    };
    file.make(|part| {
        let create = || {
            let mut out = BufWriter::new(std::fs::File::create(part)?);
            merge::plan(&campaign, range.clone(), &mut out)?;
            out.into_inner()?.sync_data()
        };
        create().map_err(IoError::write(part))
    })?;
    say!("wrote {}", file.path().display());
    Ok(())
}

/// `wingbeat campaign numbers`.
pub(super) fn numbers(args: &NumbersArgs) -> Result<(), Failure> {
    for number in Campaign::possible_numbers(&args.file)? {
        output(format_args!(
            "{:<44} {:<10} {}\n",
            number.name, number.unit, number.about
        ));
    }
    Ok(())
}

/// `wingbeat campaign merge`.
pub(super) fn merge(args: &MergeArgs) -> Result<(), Failure> {
    let (campaign, store) = args.place.existing()?;
    let place = args.place.words();
    if !args.overwrite && !store.is_of(campaign.text()) {
        return Err(Failure::Option(format!(
            "{}: another campaign was run here last, or this one before its file was changed, and its tables are left untouched; `wingbeat campaign run {place}` runs this one here, --out names another directory, --overwrite replaces the tables",
            store.root().display()
        )));
    }
    let missing = merge::missing(&campaign, &store)?;
    if missing > 0 && !args.partial {
        return Err(Failure::Option(format!(
            "{missing} of {} points have no result yet; `wingbeat campaign run {place}` flies them, --partial merges what there is",
            campaign.plan().points(),
        )));
    }
    tables(&campaign, &store)
}

/// Writes the tables.
fn tables(campaign: &Campaign, store: &Store) -> Result<(), Failure> {
    for path in merge::merge(campaign, store)? {
        say!("wrote {}", path.display());
    }
    if let Some([red, amber]) = Status::of(campaign, store)?
        .doubtful
        .filter(|d| *d != [0, 0])
    {
        say!(
            "{red} flights are red, {amber} amber: look at `verdict` before you use their numbers."
        );
    }
    Ok(())
}
