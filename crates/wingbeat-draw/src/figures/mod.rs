//! Figures of a run, drawn from its history and its frames: units on axes, colours that
//! colour-blind readers can tell apart (Okabe & Ito 2008).
//!
//! The chapter in order: a drawing is a list of marks (`drawing`), which become SVG (`svg`) or
//! pixels (`raster`, `font`); `style` says how large and thick; `ticks`, `plot`, `grid` and
//! [`Chart`] make axes; the kinds of figures stand in `kinds`, `beats`, `lollipop`, `phase`,
//! `wake` and `animation`.

mod animation;
mod beats;
mod chart;
mod dots;
mod drawing;
mod font;
mod grid;
mod kinds;
mod lollipop;
mod phase;
mod plot;
mod raster;
pub mod stabilised;
mod style;
mod svg;
mod ticks;
mod wake;

use std::path::{Path, PathBuf};

use wingbeat_flight::FlightSetup;

pub use chart::{Chart, Panel, Series};
use drawing::Drawing;
pub use style::Style;
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;
use wingbeat_results::file::{NewFile, make_folder, write_file};
use wingbeat_results::{History, ResultDir, Summary};

/// More rows of a history than this do not make a figure better.
pub(crate) const MOST_ROWS: usize = 4000;

/// What a figure shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Prescribed wing angles over time.
    Angles,
    /// Force of the air and power of the hinges over time, the downstroke shaded.
    Forces,
    /// Chord of a wing with the force on it through the last wingbeat.
    Lollipop,
    /// Force and power of the wingbeats above each other, and their means.
    Beats,
    /// Path and attitude of the body over time.
    Trajectory,
    /// Phase planes of body and wing.
    Phase,
    /// Energy, momentum and constraints.
    Balances,
    /// Wakes from above and from the side.
    Wake,
    /// The flight as a GIF.
    Animation,
}

impl Kind {
    /// All kinds by name, with what they show.
    pub const ALL: [(&'static str, Self, &'static str); 9] = [
        ("angles", Self::Angles, "wing angles over time"),
        (
            "forces",
            Self::Forces,
            "force of the air and power, downstroke shaded",
        ),
        (
            "lollipop",
            Self::Lollipop,
            "chord of a wing with its force, last wingbeat",
        ),
        (
            "beats",
            Self::Beats,
            "force and power beat by beat, with means",
        ),
        (
            "trajectory",
            Self::Trajectory,
            "path and attitude of the body",
        ),
        ("phase", Self::Phase, "phase planes of body and wing"),
        ("balances", Self::Balances, "energy, momentum, constraints"),
        ("wake", Self::Wake, "wakes from above and from the side"),
        (
            "animation",
            Self::Animation,
            "the flight as a GIF; only when asked for",
        ),
    ];

    /// Name on the command line and of the file.
    pub fn name(self) -> &'static str {
        let known = Self::ALL.iter().find(|k| k.1 == self);
        known.expect("every kind has a name").0
    }

    /// Why a run may not have this figure.
    fn needs(self) -> &'static str {
        match self {
            Self::Forces => "this flight has no air",
            Self::Angles | Self::Lollipop => "no wing of this flight flaps",
            Self::Beats => "this flight has no whole wingbeat",
            Self::Phase => "nothing moves in this flight",
            Self::Wake => "no frames were written (output.frames_every = 0, or air without wakes)",
            Self::Trajectory | Self::Balances | Self::Animation => "the history is empty",
        }
    }
}

/// What a figure is written as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Lines and words, for papers and for editing.
    #[default]
    Svg,
    /// Pixels: 300 per inch for a paper, 144 for the screen.
    Png,
}

impl Format {
    /// All formats by name, which is the ending of the file, too.
    pub const ALL: [(&'static str, Self); 2] = [("svg", Self::Svg), ("png", Self::Png)];

    fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }
}

/// What is to be drawn, how and where to.
#[derive(Clone, Debug)]
pub struct Order {
    /// Kinds of figures; none: all that the run has, but the animation.
    pub kinds: Vec<Kind>,
    /// Style.
    pub style: Style,
    /// File format of figures that do not move.
    pub format: Format,
    /// Step of the frame whose wakes are drawn; the last one if none.
    pub step: Option<usize>,
    /// Folder for the files.
    pub folder: PathBuf,
    /// Whether files that are there already and differ are replaced.
    pub overwrite: bool,
}

/// What figures are drawn from.
struct Source<'a> {
    dir: &'a Path,
    case: &'a LoadedCase,
    history: &'a History,
    summary: &'a Summary,
    step: Option<usize>,
}

impl Source<'_> {
    /// The drawing of a kind; none where the run has no such thing.
    fn draw(&self, kind: Kind, style: Style) -> Result<Option<Drawing>, IoError> {
        let (look, setup) = (style.look(), &self.case.setup);
        if self.history.rows() < 2 {
            return Ok(None);
        }
        let chart = || {
            let all = kinds::all(setup, self.history);
            let found = all.into_iter().find(|c| c.0 == kind.name());
            found.map(|c| c.1.drawing(&look))
        };
        Ok(match kind {
            Kind::Lollipop => lollipop::lollipop(setup, self.history, &look),
            Kind::Beats => beats::beats(setup, self.history, self.summary, &look),
            Kind::Phase => phase::phase(setup, self.history, &look),
            Kind::Wake => wake::wake(self.dir, self.case, self.step, &look)?,
            Kind::Animation => None,
            Kind::Angles | Kind::Forces | Kind::Trajectory | Kind::Balances => chart(),
        })
    }
}

/// Draws what is ordered from a result; returns the files, newly written or the same already.
///
/// # Errors
/// A result that cannot be read, a figure the run cannot give, a file that is there already or
/// cannot be written.
pub fn plot(dir: &ResultDir, order: &Order) -> Result<Vec<PathBuf>, IoError> {
    let case = dir.case()?;
    let path = dir.join("history.csv");
    let (history, _) = History::thinned(&path, MOST_ROWS)?;
    let summary = Summary::read(&case, &path, &dir.manifest()?.outcome)?;
    let source = Source {
        dir: dir.path(),
        case: &case,
        history: &history,
        summary: &summary,
        step: order.step,
    };
    let still = Kind::ALL
        .iter()
        .map(|k| k.1)
        .filter(|k| *k != Kind::Animation);
    let kinds = match order.kinds.is_empty() {
        true => still.collect(),
        false => order.kinds.clone(),
    };
    dir.check_folder(&order.folder)?;
    make_folder(&order.folder)?;
    let mut files = vec![];
    for kind in kinds {
        if kind == Kind::Animation {
            files.push(animate(dir, &case, order)?);
            continue;
        }
        let file = format!("{}.{}", kind.name(), order.format.ending());
        let file = order.folder.join(file);
        match source.draw(kind, order.style)? {
            Some(drawing) => {
                let bytes = encoded(&drawing, order).map_err(fault(&file))?;
                write_file(&file, &bytes, order.overwrite)?;
                files.push(file);
            }
            None if order.kinds.is_empty() => {}
            None => return Err(fault(&file)(kind.needs().to_owned())),
        }
    }
    Ok(files)
}

fn fault(path: &Path) -> impl FnOnce(String) -> IoError + '_ {
    move |problem| IoError::Figure {
        path: path.to_owned(),
        problem,
    }
}

fn encoded(drawing: &Drawing, order: &Order) -> Result<Vec<u8>, String> {
    let scale = order.style.look().pixels_per_point;
    match order.format {
        Format::Svg => Ok(drawing.to_svg().into_bytes()),
        Format::Png => drawing.to_picture(scale)?.to_png(scale),
    }
}

/// The animation is written beside its place and moved there when it is whole.
fn animate(dir: &ResultDir, case: &LoadedCase, order: &Order) -> Result<PathBuf, IoError> {
    let path = order.folder.join("animation.gif");
    let file = NewFile::claim_own(&path, order.overwrite)?;
    file.make(|part| match animation::write(dir.path(), case, part)? {
        0 => Err(fault(&path)(Kind::Animation.needs().to_owned())),
        _ => Ok(()),
    })?;
    Ok(path)
}

/// Draws every figure of the history that makes sense for the case into `figures/`.
///
/// # Errors
/// A file that cannot be written.
pub fn draw_all(
    dir: &ResultDir,
    case: &LoadedCase,
    history: &History,
    summary: &Summary,
) -> Result<(), IoError> {
    dir.folder("figures")?;
    let source = Source {
        dir: dir.path(),
        case,
        history,
        summary,
        step: None,
    };
    for (name, kind, _) in Kind::ALL {
        if matches!(kind, Kind::Wake | Kind::Animation) {
            continue; // large or slow: `wingbeat plot` draws them
        }
        if let Some(drawing) = source.draw(kind, Style::Screen)? {
            let svg = drawing.to_svg();
            dir.write(&format!("figures/{name}.svg"), svg.as_bytes())?;
        }
    }
    Ok(())
}

/// The charts of a run over time.
pub(crate) fn charts(setup: &FlightSetup, history: &History) -> Vec<Chart> {
    kinds::all(setup, history)
        .into_iter()
        .map(|c| c.1)
        .collect()
}

/// Time axis: wingbeats where there are any, else seconds.
pub(crate) fn time_axis(setup: &FlightSetup, history: &History) -> (String, Vec<f64>) {
    let time = history.column("time_s");
    match setup.time.period {
        Some(period) => (
            "wingbeats".to_owned(),
            time.iter().map(|t| t / period).collect(),
        ),
        None => ("time [s]".to_owned(), time.to_vec()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behaves_a_result_directory_knows_its_figures() {
        let names = Kind::ALL.map(|(name, _, _)| name);
        assert_eq!(names, wingbeat_results::directory::FIGURE_NAMES);
    }
}
