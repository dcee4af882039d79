//! Figures of a run, drawn from its history and its frames: units on axes, colours that
//! colour-blind readers can tell apart (Okabe & Ito 2008).
//!
//! The chapter in order: a drawing is a list of marks (`drawing`), which become SVG (`svg`) or
//! pixels (`raster`, `font`); `style` says how large and thick; `ticks`, `plot`, `grid` and
//! [`Chart`] make axes; the kinds of figures stand in `kinds`, `beats`, `lollipop`, `phase`,
//! `wake` and `animation`; `order` is what is asked for, `source` what it is drawn from.

mod animation;
mod beats;
mod bending;
mod chart;
mod dots;
mod drawing;
mod font;
mod grid;
mod kinds;
mod lollipop;
mod measure;
mod order;
mod part;
mod path;
mod pdf;
mod phase;
mod plot;
mod raster;
mod reel;
mod shades;
mod source;
pub mod stabilised;
mod strokes;
mod style;
mod svg;
pub mod swept;
mod ticks;
mod units;
mod wake;
mod window;
mod wing_angles;

use std::path::{Path, PathBuf};

pub use chart::{Chart, Panel, Series};
use drawing::Drawing;
pub use order::{Format, Kind, Order};
pub(crate) use part::Part;
pub(crate) use strokes::stroke_columns;
pub use style::Style;
pub(crate) use window::charts;
pub use window::{NamedCharts, Window, charts_of};
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
    /// Figures that were asked for beside others and that the run does not have.
    pub lacking: Vec<IoError>,
}

/// Draws what is ordered from a result.
///
/// # Errors
/// A result that cannot be read, figures none of which the run can give, a file that is there already or
/// cannot be written.
pub fn plot(dir: &ResultDir, order: &Order) -> Result<Plotted, IoError> {
    let case = dir.case()?;
    let path = dir.join("history.csv");
    let manifest = dir.manifest()?;
    if let Some(step) = order.step {
        let frames = frames::steps(dir.path())?;
        let problem = match frames.is_empty() {
            true => Some("it has no frames, so there is no wake to draw at a step".to_owned()),
            false if step > manifest.steps => Some(format!(
                "there is no step {step}: its steps are 0 to {}",
                manifest.steps
            )),
            false => None,
        };
        problem.map_or(Ok(()), |p| Err(fault(dir.path())(p)))?;
    }
    let summary = Summary::read(&case, &path, &manifest.outcome)?;
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
    // Everything that can be refused is, before anything is written.
    let (mut stills, mut films, mut lacking) = (vec![], vec![], vec![]);
    for kind in kinds {
        let format = Format::of(order.format, kind).map_err(fault(&order.folder))?;
        let file = format!("{}.{}", kind.name(), format.ending());
        let file = order.folder.join(file);
        if kind == Kind::Animation {
            films.push((file, format == Format::Mp4));
            continue;
        }
        match source.draw(kind, order.style)? {
            Some(drawing) => {
                let bytes = encoded(&drawing, order.style, format).map_err(fault(&file))?;
                stills.push((file, bytes));
            }
            None if order.kinds.is_empty() => {}
            None => lacking.push(fault(&file)(source.lacks(kind))),
        }
    }
    if stills.is_empty() && films.is_empty() && lacking.len() == 1 {
        return Err(lacking.remove(0));
    }
    if lacking.is_empty() || !(stills.is_empty() && films.is_empty()) {
        make_folder(&order.folder)?;
    }
    for (file, bytes) in &stills {
        write_file(file, bytes, order.overwrite)?;
    }
    for (file, film) in &films {
        animate(&source, file, *film, order.overwrite)?;
    }
    let stills = stills.into_iter().map(|(file, _)| file);
    let files = stills.chain(films.into_iter().map(|(file, _)| file));
    Ok(Plotted {
        files: files.collect(),
        lacking,
    })
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
