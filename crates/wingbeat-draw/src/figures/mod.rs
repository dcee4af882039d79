//! Figures of a run, drawn from its history and its frames: units on axes, colours that
//! colour-blind readers can tell apart (Okabe & Ito 2008).
//!
//! The chapter in order: a drawing is a list of marks (`drawing`), which become SVG, PDF or pixels; `axes` are
//! plots and [`Chart`]s; the kinds of figures stand in `over_time`, `stills` and `animation`; `order` is what is
//! asked for, `source` what it is drawn from.

mod animation;
mod axes;
mod drawing;
mod order;
mod over_time;
mod source;
pub mod stabilised;
mod stills;
pub mod swept;

use std::path::{Path, PathBuf};

pub use axes::chart::{Chart, Panel, Series};
use drawing::Drawing;
pub use drawing::style::Style;
pub use order::{Format, Kind, Order};
pub(crate) use over_time::part::TimeWindow;
pub(crate) use over_time::strokes::stroke_columns;
pub(crate) use over_time::window::charts;
pub use over_time::window::{NamedCharts, Window, charts_of};
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;
use wingbeat_results::file::{NewFile, make_folder, write_file};
use wingbeat_results::{ResultDir, Summary, frames};

use source::Source;

/// What was drawn of an order.
#[derive(Debug, Default)]
pub struct Plotted {
    /// The files, newly written or the same already.
    pub files: Vec<PathBuf>,
    /// What figures without a title show, for their captions: file and words.
    pub captions: Vec<(PathBuf, String)>,
    /// Figures that were asked for beside others and that the run does not have.
    pub lacking: Vec<IoError>,
}

/// Draws what is ordered from a result.
///
/// # Errors
/// A result that cannot be read, figures none of which the run can give, a file that is there already or
/// cannot be written.
pub fn plot(dir: &ResultDir, order: &Order) -> Result<Plotted, IoError> {
    if let Some(problem) = order.contradiction() {
        return Err(fault(&order.folder)(problem));
    }
    let case = dir.case()?;
    let manifest = dir.manifest()?;
    check_step(dir, order, manifest.steps)?;
    let summary = Summary::read(&case, &dir.join("history.csv"), &manifest.outcome)?;
    let source = Source::new(dir.path(), &case, &summary, (order.window, order.step))?;
    dir.check_folder(&order.folder)?;
    // Everything that can be refused is, before anything is written.
    let mut drawn = Drawn::of(&source, order)?;
    let is_empty = drawn.stills.is_empty() && drawn.films.is_empty();
    if is_empty && drawn.lacking.len() == 1 {
        return Err(drawn.lacking.remove(0));
    }
    if drawn.lacking.is_empty() || !is_empty {
        make_folder(&order.folder)?;
    }
    drawn.write(&source, order)
}

/// A step that is asked for is one of the run, which has frames.
fn check_step(dir: &ResultDir, order: &Order, steps: usize) -> Result<(), IoError> {
    let Some(step) = order.step else {
        return Ok(());
    };
    let problem = if frames::steps(dir.path())?.is_empty() {
        "it has no frames, so there is no wake to draw at a step".to_owned()
    } else if step > steps {
        format!("there is no step {step}: its steps are 0 to {steps}")
    } else {
        return Ok(());
    };
    Err(fault(dir.path())(problem))
}

/// What an order comes to.
#[derive(Default)]
struct Drawn {
    /// Files and their bytes.
    stills: Vec<(PathBuf, Vec<u8>)>,
    /// Files of animations, and whether they are films: they are drawn when they are written.
    films: Vec<(PathBuf, bool)>,
    /// As [`Plotted::captions`].
    captions: Vec<(PathBuf, String)>,
    /// As [`Plotted::lacking`].
    lacking: Vec<IoError>,
}

impl Drawn {
    fn of(source: &Source<'_>, order: &Order) -> Result<Self, IoError> {
        let mut drawn = Self::default();
        for kind in order.wanted() {
            let format = Format::of(order.format, kind).map_err(fault(&order.folder))?;
            let file = format!("{}.{}", kind.name(), format.ending());
            let file = order.folder.join(file);
            if kind == Kind::Animation {
                drawn.films.push((file, format == Format::Mp4));
                continue;
            }
            match source.draw(kind, order.style)? {
                Some(drawing) => {
                    let bytes = encoded(&drawing, order.style, format).map_err(fault(&file))?;
                    if !order.style.look().titled {
                        drawn.captions.push((file.clone(), drawing.title));
                    }
                    drawn.stills.push((file, bytes));
                }
                None if order.kinds.is_empty() => {}
                None => drawn.lacking.push(fault(&file)(source.lacks(kind))),
            }
        }
        Ok(drawn)
    }

    fn write(self, source: &Source<'_>, order: &Order) -> Result<Plotted, IoError> {
        for (file, bytes) in &self.stills {
            write_file(file, bytes, order.existing)?;
        }
        for (file, film) in &self.films {
            animate(source, (file, *film), order)?;
        }
        let stills = self.stills.into_iter().map(|(file, _)| file);
        let films = self.films.into_iter().map(|(file, _)| file);
        Ok(Plotted {
            files: stills.chain(films).collect(),
            captions: self.captions,
            lacking: self.lacking,
        })
    }
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
fn animate(source: &Source<'_>, (path, film): (&Path, bool), order: &Order) -> Result<(), IoError> {
    let file = NewFile::claim_own(path, order.existing)?;
    file.make(
        |part| match animation::write(source, (part, film), order.style)? {
            0 => Err(fault(path)(Kind::Animation.needs().to_owned())),
            _ => Ok(()),
        },
    )?;
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
