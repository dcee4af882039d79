//! `wingbeat plot`: figures of a run for papers and screens, and an animation.

use std::path::PathBuf;

use clap::Args;
use wingbeat::draw::figures::{self, Format, Kind, Order, Style};
use wingbeat::results::ResultDir;

use crate::failure::Failure;
use crate::options::choose;
use crate::terminal::say;

/// What `wingbeat plot` is told.
#[derive(Args)]
pub(crate) struct PlotArgs {
    /// Result directory of the run.
    dir: PathBuf,
    /// Figures: angles, forces, lollipop, beats, trajectory, phase, balances, wake, animation;
    /// default all but the animation.
    #[arg(value_name = "KIND", value_parser = kind)]
    kinds: Vec<Kind>,
    /// For a paper (180 mm wide, no title) or for the screen.
    #[arg(long, default_value = "screen", value_parser = style)]
    style: Style,
    /// File format: svg or png; the animation is a gif.
    #[arg(long, default_value = "svg", value_parser = format)]
    format: Format,
    /// Step whose wakes are drawn (the nearest frame); default the last.
    #[arg(long, value_name = "STEP")]
    step: Option<usize>,
    /// Folder for the files; default DIR/figures, DIR/figures/paper for papers.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Replace figures that are there already.
    #[arg(long)]
    overwrite: bool,
}

fn kind(name: &str) -> Result<Kind, String> {
    choose(name, &Kind::ALL.map(|(name, kind, _)| (name, kind)))
}

fn style(name: &str) -> Result<Style, String> {
    choose(name, &Style::ALL)
}

fn format(name: &str) -> Result<Format, String> {
    choose(name, &Format::ALL)
}

/// The whole command.
pub(crate) fn plot(args: &PlotArgs) -> Result<(), Failure> {
    let dir = ResultDir::read(&args.dir)?;
    let folder = args.out.clone().unwrap_or_else(|| match args.style {
        Style::Screen => args.dir.join("figures"),
        Style::Paper => args.dir.join("figures/paper"),
    });
    let order = Order {
        kinds: args.kinds.clone(),
        style: args.style,
        format: args.format,
        step: args.step,
        folder,
        overwrite: args.overwrite,
    };
    for file in figures::plot(&dir, &order)? {
        say!("{}", file.display());
    }
    Ok(())
}
