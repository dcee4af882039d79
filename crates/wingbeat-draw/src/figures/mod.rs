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
mod measure;
mod path;
mod pdf;
mod phase;
mod plot;
mod raster;
mod reel;
pub mod stabilised;
mod style;
mod svg;
mod ticks;
mod wake;
mod window;

use std::ops::Range;
use std::path::{Path, PathBuf};

use wingbeat_flight::FlightSetup;

pub use chart::{Chart, Panel, Series};
use drawing::Drawing;
pub use style::Style;
pub use window::Window;
pub(crate) use window::charts;
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;
use wingbeat_results::file::{NewFile, make_folder, write_file};
use wingbeat_results::rows::Rows;
use wingbeat_results::summary::BeatMeans;
use wingbeat_results::{History, ResultDir, Summary};

/// More abscissas than this do not make a figure better: of longer flights, extremes are drawn.
const MOST_POINTS: usize = 4000;
/// Rows, the last ones, from which phase planes and single wingbeats are drawn.
const MOST_ROWS: usize = 8000;

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
    /// Path of the body in space, in three views.
    Path,
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
    pub const ALL: [(&'static str, Self, &'static str); 10] = [
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
        (
            "path",
            Self::Path,
            "path of the body in space, three views to one scale",
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
            Self::Path => "the body does not move in this flight",
            Self::Phase => "nothing moves in this flight",
            Self::Wake => "no frames were written (output.frames_every = 0, or air without wakes)",
            Self::Trajectory | Self::Balances | Self::Animation => "the history is empty",
        }
    }
}

/// What a figure is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Lines and words, for papers and for editing.
    Svg,
    /// Pixels: 300 per inch for a paper, 144 for the screen.
    Png,
    /// One page of lines, for papers.
    Pdf,
    /// The animation as a GIF.
    Gif,
    /// The animation as a film, made by ffmpeg.
    Mp4,
}

impl Format {
    /// All formats by name, which is the ending of the file, too.
    pub const ALL: [(&'static str, Self); 5] = [
        ("svg", Self::Svg),
        ("png", Self::Png),
        ("pdf", Self::Pdf),
        ("gif", Self::Gif),
        ("mp4", Self::Mp4),
    ];

    fn ending(self) -> &'static str {
        let known = Self::ALL.iter().find(|f| f.1 == self);
        known.expect("every format has a name").0
    }

    fn moves(self) -> bool {
        matches!(self, Self::Gif | Self::Mp4)
    }

    /// The format of a kind of figure, or why it has not the one that was asked for.
    fn of(asked: Option<Self>, kind: Kind) -> Result<Self, String> {
        let moves = kind == Kind::Animation;
        match asked {
            None if moves => Ok(Self::Gif),
            None => Ok(Self::Svg),
            Some(format) if format.moves() == moves => Ok(format),
            Some(format) => Err(format!(
                "--format {}: {} is written as {}; draw it by a command of its own",
                format.ending(),
                kind.name(),
                if moves {
                    "gif or mp4"
                } else {
                    "svg, png or pdf"
                },
            )),
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
    /// File format; none: SVG, of the animation GIF.
    pub format: Option<Format>,
    /// Step of the frame whose wakes are drawn; the last one if none.
    pub step: Option<usize>,
    /// Part of the flight that is drawn.
    pub window: Window,
    /// Folder for the files.
    pub folder: PathBuf,
    /// Whether files that are there already and differ are replaced.
    pub overwrite: bool,
}

/// What figures are drawn from.
struct Source<'a> {
    dir: &'a Path,
    case: &'a LoadedCase,
    /// Rows of the history that are drawn.
    rows: Range<usize>,
    /// The last of these rows, at most [`MOST_ROWS`].
    history: History,
    charts: Vec<(&'static str, Chart)>,
    /// Whole wingbeats in these rows.
    beats: Vec<BeatMeans>,
    /// Frame whose wake is drawn.
    step: Option<usize>,
}

impl<'a> Source<'a> {
    fn new(
        dir: &'a Path,
        case: &'a LoadedCase,
        summary: &Summary,
        (window, step): (Window, Option<usize>),
    ) -> Result<Self, IoError> {
        let path = dir.join("history.csv");
        let rows = window.rows(&case.setup, &path)?;
        let last = rows.end.saturating_sub(MOST_ROWS).max(rows.start)..rows.end;
        let history = History::of_rows(&path, last)?;
        let (charts, _) = window::charts(&case.setup, &path, rows.clone(), MOST_POINTS)?;
        let whole = Window::beats(&case.setup, &path, &rows)?;
        let inside = |b: &&BeatMeans| whole.contains(&b.beat);
        Ok(Self {
            dir,
            case,
            history,
            charts,
            beats: summary.beats.iter().filter(inside).cloned().collect(),
            step: step.or_else(|| rows.end.checked_sub(1)),
            rows,
        })
    }

    /// Places of the body in all rows, at most [`MOST_POINTS`] of them \[m, N\].
    fn path(&self) -> Result<path::Path, IoError> {
        let mut rows = Rows::open(&self.dir.join("history.csv"))?;
        let names = ["body_x_m", "body_y_m", "body_z_m"];
        let column = |name: &str| rows.names().iter().position(|n| n == name);
        let Some(columns) = names
            .iter()
            .map(|n| column(n))
            .collect::<Option<Vec<usize>>>()
        else {
            return Ok(path::Path::default());
        };
        rows.skip(self.rows.start)?;
        let mut path = path::Path::new(self.rows.len().div_ceil(MOST_POINTS));
        for k in 0..self.rows.len() {
            let Some(row) = rows.next_row()? else { break };
            path.add(k, row[1], [0, 1, 2].map(|c| row[columns[c]]));
        }
        Ok(path)
    }

    /// What phase planes show, where it is not everything.
    fn note(&self) -> String {
        match self.rows.len() - self.history.rows() {
            0 => String::new(),
            _ => format!(", last {} steps", self.history.rows()),
        }
    }

    /// The drawing of a kind; none where the run has no such thing.
    fn draw(&self, kind: Kind, style: Style) -> Result<Option<Drawing>, IoError> {
        let (look, setup) = (style.look(), &self.case.setup);
        if self.history.rows() < 2 {
            return Ok(None);
        }
        let chart = || {
            let found = self.charts.iter().find(|c| c.0 == kind.name());
            found.map(|c| c.1.drawing(&look))
        };
        Ok(match kind {
            Kind::Lollipop => lollipop::lollipop(setup, &self.history, &look),
            Kind::Beats => beats::beats(setup, &self.history, &self.beats, &look),
            Kind::Path => path::path(setup, &self.path()?, &look),
            Kind::Phase => phase::phase(setup, &self.history, &self.note(), &look),
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
    let summary = Summary::read(&case, &path, &dir.manifest()?.outcome)?;
    let source = Source::new(dir.path(), &case, &summary, (order.window, order.step))?;
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
        let format = Format::of(order.format, kind).map_err(fault(&order.folder))?;
        let file = format!("{}.{}", kind.name(), format.ending());
        let file = order.folder.join(file);
        if kind == Kind::Animation {
            animate(&source, &file, format == Format::Mp4, order.overwrite)?;
            files.push(file);
            continue;
        }
        match source.draw(kind, order.style)? {
            Some(drawing) => {
                let bytes = encoded(&drawing, order.style, format).map_err(fault(&file))?;
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

fn encoded(drawing: &Drawing, style: Style, format: Format) -> Result<Vec<u8>, String> {
    let scale = style.look().pixels_per_point;
    match format {
        Format::Svg => Ok(drawing.to_svg().into_bytes()),
        Format::Pdf => Ok(drawing.to_pdf()),
        _ => drawing.to_picture(scale)?.to_png(scale),
    }
}

/// The animation is written beside its place and moved there when it is whole.
fn animate(source: &Source<'_>, path: &Path, film: bool, overwrite: bool) -> Result<(), IoError> {
    let file = NewFile::claim_own(path, overwrite)?;
    file.make(|part| match animation::write(source, part, film)? {
        0 => Err(fault(path)(Kind::Animation.needs().to_owned())),
        _ => Ok(()),
    })?;
    Ok(())
}

/// Draws every figure of the history that makes sense for the case into `figures/`.
///
/// # Errors
/// A history that cannot be read, a file that cannot be written.
pub fn draw_all(dir: &ResultDir, case: &LoadedCase, summary: &Summary) -> Result<(), IoError> {
    dir.folder("figures")?;
    let source = Source::new(dir.path(), case, summary, (Window::default(), None))?;
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

/// Where the stroke angle of the reference wing stands in a row, and the sign by which it rises in
/// the downstroke.
pub(crate) fn stroke_column(setup: &FlightSetup, names: &[String]) -> Option<(usize, f64)> {
    let (wing, sign) = kinds::reference_wing(setup)?;
    let name = format!("{wing}_prescribed_phi_rad");
    Some((names.iter().position(|n| *n == name)?, sign))
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
