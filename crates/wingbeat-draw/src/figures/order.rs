//! What is ordered: kinds of figures, formats, style, part of the flight.

use std::path::PathBuf;

use wingbeat_results::file::Existing;

use crate::figures::drawing::style::Style;
use crate::figures::over_time::window::Window;

/// What a figure shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Wing angles over time: prescribed ones, with those of passive joints.
    Angles,
    /// Force of the air and power that drives the wings over time, the downstroke shaded.
    Forces,
    /// Chord of a wing with the force on it through the last wingbeat.
    Lollipop,
    /// Force and power of the wingbeats above each other, and their means.
    Beats,
    /// Path and attitude of the body over time.
    Trajectory,
    /// What feedback commands.
    Commands,
    /// Path of the body in space, in three views.
    Path,
    /// Phase planes of body and wing.
    Phase,
    /// How an elastic wing bends, twists and cambers over time.
    Bending,
    /// Energy, momentum and constraints.
    Balances,
    /// Wakes from above and from the side.
    Wake,
    /// The flight as a GIF.
    Animation,
}

impl Kind {
    /// All kinds by name, with what they show.
    pub const ALL: [(&'static str, Self, &'static str); 12] = [
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
        ("commands", Self::Commands, "what feedback commands"),
        (
            "path",
            Self::Path,
            "path of the body in space, three views to one scale",
        ),
        ("phase", Self::Phase, "phase planes of body and wing"),
        (
            "bending",
            Self::Bending,
            "deflection, twist and camber of an elastic wing along its span",
        ),
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
    pub(super) fn needs(self) -> &'static str {
        match self {
            Self::Forces => "this flight has no air",
            Self::Angles | Self::Lollipop => {
                "no wing flaps in this flight, or in no more of it than one step"
            }
            Self::Beats => "this flight has no whole wingbeat",
            Self::Commands => "this flight has no feedback",
            Self::Bending => "no wing of this flight is elastic",
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

    pub(super) fn ending(self) -> &'static str {
        let known = Self::ALL.iter().find(|f| f.1 == self);
        known.expect("every format has a name").0
    }

    pub(super) fn moves(self) -> bool {
        matches!(self, Self::Gif | Self::Mp4)
    }

    /// The format of a kind of figure, or why it has not the one that was asked for.
    pub(super) fn of(asked: Option<Self>, kind: Kind) -> Result<Self, String> {
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

/// An animation has no style for papers.
fn check_animated(style: Style) -> Result<(), String> {
    match style {
        Style::Screen | Style::Dark => Ok(()),
        Style::Paper => Err(
            "--style paper: the animation is drawn for screen or dark; draw it by a command of its own".into(),
        ),
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
    /// What becomes of files that are there already and differ.
    pub existing: Existing,
}

impl Order {
    /// Options that contradict each other, whatever the run; none where they do not.
    pub fn contradiction(&self) -> Option<String> {
        let wanted = self.wanted();
        if self.step.is_some() && !wanted.contains(&Kind::Wake) {
            return Some("--step has no effect without the figure `wake`, which is drawn at a step: leave it out, or name `wake`".to_owned());
        }
        let of_kind = |kind: &Kind| {
            let format = Format::of(self.format, *kind).err();
            format.or_else(|| {
                let is_animated = *kind == Kind::Animation;
                is_animated.then(|| check_animated(self.style).err())?
            })
        };
        let of_kinds = wanted.iter().find_map(of_kind);
        of_kinds.or_else(|| self.window.contradiction())
    }

    /// The kinds that are drawn.
    pub(super) fn wanted(&self) -> Vec<Kind> {
        let stills = Kind::ALL.map(|k| k.1).into_iter();
        match self.kinds.is_empty() {
            true => stills.filter(|k| *k != Kind::Animation).collect(),
            false => {
                let first = |(k, kind): &(usize, &Kind)| !self.kinds[..*k].contains(kind);
                let kinds = self.kinds.iter().enumerate().filter(first);
                kinds.map(|(_, kind)| *kind).collect()
            }
        }
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
