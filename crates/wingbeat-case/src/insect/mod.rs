//! Cases of insects that no preset holds: from a species, or from a few sizes and scaling laws, as a commented
//! case file that hovers.
//!
//! The chapter in order: `species`, beside this one, is what is known, `scaling` fills in what is not given,
//! `text` writes the case. The stroke is the one with which blade elements carry the weight on average
//! ([`wingbeat_analysis::estimate`]); the hinges are so far apart that it does not take the wings through each other or
//! into the body.

mod number;
mod scaling;
mod text;

use std::path::Path;

use wingbeat_analysis::estimate;

use crate::error::IoError;
use crate::loaded::LoadedCase;
use scaling::Insect;

pub use crate::shipped::species::{SPECIES, Species};
pub use scaling::Size;
pub use text::InsectAir;

/// Strokes from end to end that are looked at \[deg\].
const STROKES: [f64; 2] = [20.0, 170.0];
/// Lift over weight is one to this.
const CLOSE: f64 = 1e-4;
/// Bisections at most: of 150 degrees, to the last bit of five digits.
const BISECTIONS: usize = 30;

/// The case of a species by name.
///
/// # Errors
/// An unknown name; as [`case_of_size`].
pub fn case_of_species(name: &str, air: InsectAir) -> Result<String, IoError> {
    hovering(&Insect::of_species(Species::find(name)?), air)
}

/// The case of an insect of a size.
///
/// # Errors
/// Neither mass nor wing length; a weight that no stroke of these wings carries, or the smallest one exceeds.
pub fn case_of_size(size: &Size, air: InsectAir) -> Result<String, IoError> {
    hovering(&Insect::of_size(size)?, air)
}

/// The case with the stroke that carries the weight.
fn hovering(insect: &Insect, air: InsectAir) -> Result<String, IoError> {
    let [mut low, mut high] = STROKES;
    for (stroke, is_wrong) in [
        (low, lift(insect, low)? > 1.0),
        (high, lift(insect, high)? < 1.0),
    ] {
        if is_wrong {
            return Err(no_stroke(insect, stroke, lift(insect, stroke)?));
        }
    }
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let lift = lift(insect, middle)?;
        if (lift - 1.0).abs() < CLOSE {
            low = middle;
            break;
        }
        *(if lift < 1.0 { &mut low } else { &mut high }) = middle;
    }
    let aside = clear(insect, low)?;
    Ok(text::text(insect, air, (low, aside)))
}

/// Distance of the hinges from the middle over the one they have at least, with which wings of this stroke \[deg\] pass
/// neither through each other nor through the body of a lattice \[1\].
fn clear(insect: &Insect, stroke: f64) -> Result<f64, IoError> {
    const FARTHEST: i32 = 20;
    let aside = |k: i32| 1.1_f64.powi(k);
    for k in 0..FARTHEST {
        let text = text::text(insect, InsectAir::Lattice, (stroke, aside(k)));
        let setup = loaded(&text)?.setup;
        if setup.crossing_wings().is_empty() && setup.wings_inside_parts().is_empty() {
            return Ok(aside(k));
        }
    }
    Err(IoError::Insect {
        problem: format!(
            "wings with a stroke of {stroke:.0} degrees, which carries the weight, pass through each other or through the body"
        ),
        remedy: "give a higher --frequency or longer wings (--wing), which need shorter strokes"
            .to_owned(),
    })
}

fn loaded(text: &str) -> Result<LoadedCase, IoError> {
    LoadedCase::from_text("new case", text, Path::new(""), &[])
}

/// Mean lift over weight by blade elements with this stroke [deg].
fn lift(insect: &Insect, stroke: f64) -> Result<f64, IoError> {
    let text = text::text(insect, InsectAir::BladeElement, (stroke, 1.0));
    let case = loaded(&text)?;
    let refused = |problem: String| IoError::Insect {
        problem,
        remedy: "give other sizes".to_owned(),
    };
    let found = estimate(&case.setup);
    let lift = found.lift_over_weight.filter(|l| l.is_finite());
    let why = found.lift_left_out;
    lift.ok_or_else(|| refused(why.unwrap_or("blade elements give no lift for it".to_owned())))
}

/// Why these wings do not hover with a stroke at the end of the range; lift goes with the square of the frequency.
fn no_stroke(insect: &Insect, stroke: f64, lift: f64) -> IoError {
    const USUAL: f64 = 120.0;
    let frequency = insect.frequency.value * stroke / (USUAL * lift.max(f64::MIN_POSITIVE).sqrt());
    let what = match lift < 1.0 {
        true => "carry",
        false => "already carry",
    };
    IoError::Insect {
        problem: format!(
            "wings of {:.4} mm with {:.4} Hz {what} {lift:.2} times the weight of {:.4} mg with a stroke of {stroke} degrees, so there is no hover with {} to {} degrees",
            1e3 * insect.wing_length.value,
            insect.frequency.value,
            1e6 * insect.mass.value,
            STROKES[0],
            STROKES[1]
        ),
        remedy: format!(
            "give another --frequency (some {frequency:.0} Hz would do with {USUAL} degrees), --wing, --chord or --mass"
        ),
    }
}
