//! Lengths of the air in metres or in mean chords, and the cores of vortices.

use wingbeat_air::CoreModel;
use wingbeat_model::Animal;

use crate::build::fault::Built;
use crate::error::Fault;
use crate::raw::CoreCase;

/// Size of a bound core in mean chords below which rounding decides what a turned filament does to points on its
/// own line: their distance from it is 1e-16 of the places, which no narrower core hides (a thousandth of this
/// changes the lift of flapping wings by 3 to 70 %). An algebraic core is part of the distance and may be 0.
const MIN_BOUND_CORE: f64 = 1e-6;

/// The mean chord of all wings; of an animal without wings the mean width of the panels of its body, of
/// several parts the smallest of their mean widths.
pub(crate) struct Chord(Option<f64>);

impl Chord {
    /// Area over length of all wings, or that width \[m\].
    pub fn of(animal: &Animal) -> Self {
        let widths = animal.parts.iter().map(|p| p.mesh.mean_width());
        let of_body = widths.reduce(f64::min);
        Self(animal.mean_chord().or(of_body))
    }

    /// A length \[m\] that the case gives as `STEM_m` or `STEM_chords`; none where it gives neither.
    pub fn length(
        &self,
        stem: &str,
        metres: Option<f64>,
        chords: Option<f64>,
    ) -> Built<Option<f64>> {
        match (metres, chords, self.0) {
            (Some(metres), _, _) => Ok(Some(metres)),
            (None, Some(chords), Some(chord)) => Ok(Some(chords * chord)),
            (None, Some(_), None) => Err(Fault::new(
                format!("{stem}_chords"),
                "there are neither wings whose chord could be meant nor parts of a body",
                format!("{stem}_m"),
                "give the length in metres",
            )),
            (None, None, _) => Ok(None),
        }
    }

    /// The core at `path`, in air of this viscosity [m2/s] unless it has one of its own.
    pub fn core(&self, path: &str, case: &CoreCase, viscosity: f64) -> Built<CoreModel> {
        let needed = |name: &str, metres, chords| {
            let stem = format!("{path}.{name}");
            let length = self.length(&stem, metres, chords)?;
            length.ok_or_else(|| {
                Fault::new(
                    path,
                    "this core has no size",
                    format!("{stem}_m or {stem}_chords"),
                    "0.01 chords for a bound core, 0.07 for one in the wake",
                )
            })
        };
        let radius = |kind: &str, m, chords| needed(&format!("{kind}.radius"), m, chords);
        Ok(match case {
            CoreCase::CutOff(c) => CoreModel::CutOff {
                delta: needed("cut_off.length", c.length_m, c.length_chords)?,
            },
            CoreCase::Vatistas(c) => CoreModel::Vatistas {
                radius: radius("vatistas", c.radius_m, c.radius_chords)?,
            },
            CoreCase::Scully(c) => CoreModel::Scully {
                radius: radius("scully", c.radius_m, c.radius_chords)?,
            },
            CoreCase::Algebraic(c) => CoreModel::Algebraic {
                radius: radius("algebraic", c.radius_m, c.radius_chords)?,
                viscosity: c.viscosity_m2_s.unwrap_or(viscosity),
            },
            CoreCase::LambOseen(c) => CoreModel::LambOseen {
                radius: radius("lamb_oseen", c.radius_m, c.radius_chords)?,
                viscosity: c.viscosity_m2_s.unwrap_or(viscosity),
            },
        })
    }

    /// Refuses a core of the surfaces that is lost in rounding.
    pub fn check_bound_core(&self, core: &CoreModel) -> Built<()> {
        let (key, size) = match *core {
            CoreModel::CutOff { delta } => ("cut_off.length_m", delta),
            CoreModel::Vatistas { radius } => ("vatistas.radius_m", radius),
            CoreModel::Scully { radius } => ("scully.radius_m", radius),
            CoreModel::LambOseen { radius, .. } => ("lamb_oseen.radius_m", radius),
            CoreModel::Algebraic { .. } => return Ok(()),
        };
        match self.0.map(|chord| MIN_BOUND_CORE * chord) {
            Some(least) if size < least => Err(Fault::new(
                format!("air.bound_core.{key}"),
                format!(
                    "{size:e} is so small that roundings decide what filaments do on their own line"
                ),
                format!("at least a millionth of the mean chord, {least:.3e}"),
                "0.01 chords are far below a panel; `algebraic` may be 0",
            )),
            _ => Ok(()),
        }
    }
}
