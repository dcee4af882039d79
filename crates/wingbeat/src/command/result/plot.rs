//! `wingbeat plot`: figures of a run for papers and screens, and an animation.

use std::path::PathBuf;

use clap::Args;
use wingbeat::case::IoError;
use wingbeat::draw::figures::{self, Format, Kind, Order, Style, Window};
use wingbeat::results::ResultDir;
use wingbeat::results::file::Existing;

use crate::command::options::{self, Choice};
use crate::command::output::failure::{FAILED, Failure};
use crate::command::output::target::folder;
use crate::command::output::terminal::{say, tell};

/// Arguments of `wingbeat plot`.
#[derive(Args)]
pub(crate) struct PlotArgs {
    /// Result directory of the run.
    dir: PathBuf,
    /// Figures: angles, forces, lollipop, beats, trajectory, commands, path, phase, bending,
    /// balances, wake, animation; default all but the animation.
    #[arg(value_name = "KIND", value_parser = Choice(&KINDS), hide_possible_values = true)]
    kinds: Vec<Kind>,
    /// For the screen, for a paper (180 mm wide, no title), or dark (slides).
    #[arg(long, default_value = "screen", value_parser = Choice(&Style::ALL), hide_possible_values = true)]
    style: Style,
    /// File format: svg (default), png or pdf; of the animation gif (default) or mp4 (needs ffmpeg).
    #[arg(long, value_parser = Choice(&Format::ALL), hide_possible_values = true)]
    format: Option<Format>,
    /// Step whose wakes are drawn (the nearest frame); default the last.
    #[arg(long, value_name = "STEP", value_parser = options::count::<0, 1_000_000_000>)]
    step: Option<usize>,
    /// Draw the flight from this time on: wingbeats, or seconds where there are none.
    #[arg(long, value_name = "TIME", allow_negative_numbers = true,
          value_parser = options::finite)]
    from: Option<f64>,
    /// Draw the flight up to this time.
    #[arg(long, value_name = "TIME", allow_negative_numbers = true,
          value_parser = options::finite)]
    to: Option<f64>,
    /// Draw so many wingbeats: from --from on, or up to --to, or the last ones.
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true,
          value_parser = options::positive)]
    beats: Option<f64>,
    /// Folder for the files; default DIR/figures, for the other styles DIR/figures/STYLE.
    #[arg(long, value_name = "FOLDER", value_parser = folder())]
    out: Option<PathBuf>,
    /// Replace figures that are there already.
    #[arg(long)]
    overwrite: bool,
}

/// All figures by name.
const KINDS: [(&str, Kind); Kind::ALL.len()] = {
    let mut kinds = [("", Kind::Angles); Kind::ALL.len()];
    let mut k = 0;
    while k < kinds.len() {
        kinds[k] = (Kind::ALL[k].0, Kind::ALL[k].1);
        k += 1;
    }
    kinds
};

/// What to do where the folder of the run cannot be written to.
fn elsewhere(e: IoError, args: &PlotArgs) -> IoError {
    match e {
        IoError::File {
            action: action @ ("write" | "create"),
            path,
            source,
            ..
        } if args.out.is_none() => IoError::File {
            action,
            path,
            source,
            remedy: "name another folder for the figures with --out FOLDER, or free some space",
        },
        other => other,
    }
}

/// The whole command.
pub(crate) fn plot(args: &PlotArgs) -> Result<(), Failure> {
    let folder = args.out.clone().unwrap_or_else(|| match args.style {
        Style::Screen => args.dir.join("figures"),
        style => args.dir.join("figures").join(style.name()),
    });
    let order = Order {
        kinds: args.kinds.clone(),
        style: args.style,
        format: args.format,
        step: args.step,
        window: Window {
            from: args.from,
            to: args.to,
            beats: args.beats,
        },
        folder,
        existing: Existing::kept_unless(args.overwrite),
    };
    if let Some(problem) = order.contradiction() {
        return Err(Failure::Option(problem));
    }
    let dir = ResultDir::read(&args.dir)?;
    let plotted = figures::plot(&dir, &order).map_err(|e| elsewhere(e, args))?;
    for file in &plotted.files {
        say!("{}", file.display());
    }
    for (file, caption) in &plotted.captions {
        tell!("for the caption of {}: {caption}", file.display());
    }
    for problem in &plotted.lacking {
        tell!("error: {problem}");
    }
    match plotted.lacking.is_empty() {
        true => Ok(()),
        false => Err(Failure::Told(FAILED)),
    }
}
