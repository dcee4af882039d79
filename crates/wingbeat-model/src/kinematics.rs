//! Published wing motions, each read from its own file and brought into this program's
//! convention by a named converter (see [`convert`]).
//!
//! | constructor | motion |
//! |---|---|
//! | [`fry_hover`] | hovering *Drosophila*, Fry et al. 2005: the default |
//! | [`robofly_dickinson1999`], [`robofly_sane_dickinson2001`] | Robofly Fourier series, any timing |
//! | [`robofly_table`] | Robofly benchmark tables, three rotation timings |
//! | [`berman_wang_fruit_fly`], [`whitehead_fruit_fly`] | Berman & Wang's forms |
//! | [`fwuav_hover`] | hover optima of the FWUAV project for four insects |

pub mod convert;
mod csv;

use crate::ModelError;
use crate::Side;
use crate::motion::{
    AngleLaw, AngleLaws, Fourier, Oval, PeriodicSpline, SmoothSquare, SmoothTriangle, Start,
    WingMotion,
};
use std::f64::consts::FRAC_PI_2;

/// A published motion of a wing pair, symmetric left and right.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedMotion {
    /// What it is.
    pub name: String,
    /// Where it was published.
    pub source: &'static str,
    /// Angle laws of the right wing.
    pub right: AngleLaws,
    /// Wingbeat frequency \[Hz\], where given with the angles.
    pub frequency: Option<f64>,
    /// Stroke-plane pitch eta \[rad\], where given with the angles.
    pub stroke_plane_pitch: Option<f64>,
}

impl PublishedMotion {
    /// The motion of one wing at `frequency` \[Hz\] in a stroke plane of pitch
    /// `stroke_plane_pitch` \[rad\], started smoothly over one wingbeat.
    pub fn wing(&self, side: Side, frequency: f64, stroke_plane_pitch: f64) -> WingMotion {
        let angles = match side {
            Side::Right => self.right.clone(),
            Side::Left => self.right.mirrored(),
        };
        WingMotion {
            angles,
            frequency,
            phase: 0.0,
            stroke_plane_pitch,
            start: Start::default_for(frequency),
        }
    }
}

/// Wing rotation timing of the Robofly experiments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// The wing rotates before stroke reversal.
    Advanced,
    /// The wing rotates about the middle of stroke reversal.
    Symmetrical,
    /// The wing rotates after stroke reversal.
    Delayed,
}

impl Timing {
    /// Lead of the rotation in wingbeats: +-0.08 [Dickinson, Lehmann & Sane 1999].
    pub fn advance(self) -> f64 {
        match self {
            Timing::Advanced => 0.08,
            Timing::Symmetrical => 0.0,
            Timing::Delayed => -0.08,
        }
    }
}

/// Hovering *Drosophila* [Fry, Sayaman & Dickinson 2005]; the beat starts with the downstroke.
///
/// ```
/// let fry = wingbeat_model::kinematics::fry_hover();
/// // Stroke amplitude, dorsal to ventral: 143 degrees.
/// let phi = |i: i32| fry.right.phi.at(f64::from(i) / 1000.0)[0].to_degrees();
/// let (lo, hi) = (0..1000).fold((0.0_f64, 0.0_f64), |(l, h), i| (l.min(phi(i)), h.max(phi(i))));
/// assert!((hi - lo - 143.0).abs() < 1.0);
/// ```
pub fn fry_hover() -> PublishedMotion {
    let rows = csv::rows(include_str!("../data/fry_hover.csv"));
    let series = |column: usize| Fourier {
        mean: 0.5 * rows[0][column].to_radians(),
        cos: rows[1..].iter().map(|r| r[column].to_radians()).collect(),
        sin: rows[1..]
            .iter()
            .map(|r| r[column + 1].to_radians())
            .collect(),
    };
    PublishedMotion {
        name: "hovering Drosophila (Fry et al. 2005)".to_owned(),
        source: "Fry, Sayaman & Dickinson 2005, J. Exp. Biol. 208:2303; digitised in FluSI",
        right: convert::flusi(
            AngleLaw::Fourier(series(1)),
            AngleLaw::Fourier(series(3)),
            AngleLaw::Fourier(series(5)),
        ),
        frequency: None,
        stroke_plane_pitch: None,
    }
}

/// Robofly series of Dickinson, Lehmann & Sane 1999 with the total stroke and the angle of attack
/// at mid stroke \[rad\]. The stroke is the one the wing really sweeps (the file counts that of
/// the triangular wave before it was smoothed).
pub fn robofly_dickinson1999(timing: Timing, stroke: f64, attack: f64) -> PublishedMotion {
    robofly_series(
        include_str!("../data/robofly_dickinson1999.csv"),
        "Dickinson, Lehmann & Sane 1999, Science 284:1954; digitised in FluSI",
        timing,
        [stroke, attack],
    )
}

/// Robofly series of Sane & Dickinson 2001 with the total stroke (as swept) and the angle of
/// attack at mid stroke \[rad\].
pub fn robofly_sane_dickinson2001(timing: Timing, stroke: f64, attack: f64) -> PublishedMotion {
    robofly_series(
        include_str!("../data/robofly_sane_dickinson2001.csv"),
        "Sane & Dickinson 2001, J. Exp. Biol. 204:2607; digitised in FluSI",
        timing,
        [stroke, attack],
    )
}

fn robofly_series(
    text: &str,
    source: &'static str,
    timing: Timing,
    [stroke, attack]: [f64; 2],
) -> PublishedMotion {
    let rows = csv::rows(text);
    // Row i is harmonic 2i + 1, list entry 2i; even harmonics are zero.
    let odd = |column: usize, factor: f64| {
        let mut list = vec![0.0; 2 * rows.len() - 1];
        for (i, row) in rows.iter().enumerate() {
            list[2 * i] = factor * row[column].to_radians();
        }
        list
    };
    // All cosines are one at the dorsal reversal, t = 0: their sum is half the stroke.
    let half_stroke: f64 = rows.iter().map(|r| r[1].to_radians()).sum();
    let phi = Fourier {
        mean: 0.0,
        cos: odd(1, 0.5 * stroke / half_stroke),
        sin: Vec::new(),
    };
    let alpha = Fourier {
        mean: 0.0,
        cos: Vec::new(),
        sin: odd(2, (FRAC_PI_2 - attack).to_degrees() / 40.0),
    };
    let alpha = alpha.shifted(timing.advance());
    PublishedMotion {
        name: format!("Robofly, {timing:?} rotation"),
        source,
        right: convert::flusi(
            AngleLaw::Fourier(phi),
            AngleLaw::Constant(0.0),
            AngleLaw::Fourier(alpha),
        ),
        frequency: None,
        stroke_plane_pitch: Some(FRAC_PI_2),
    }
}

/// Robofly benchmark table: stroke 160 deg, angle of attack 40 deg at mid stroke.
///
/// # Errors
/// None for the tables as shipped; the spline's checks are passed on.
pub fn robofly_table(timing: Timing) -> Result<PublishedMotion, ModelError> {
    let text = match timing {
        Timing::Advanced => include_str!("../data/robofly_advanced_table.csv"),
        Timing::Symmetrical => include_str!("../data/robofly_symmetrical_table.csv"),
        Timing::Delayed => include_str!("../data/robofly_delayed_table.csv"),
    };
    let rows = csv::rows(text);
    let column =
        |k: usize| -> Vec<(f64, f64)> { rows.iter().map(|r| (r[0], r[k].to_radians())).collect() };
    let name = format!("Robofly table, {timing:?} rotation");
    let (phi, psi) = convert::robofly_table(&column(1), &column(2));
    let right = AngleLaws {
        phi: AngleLaw::Table(PeriodicSpline::new(&format!("{name}, stroke"), &phi)?),
        theta: AngleLaw::Constant(0.0),
        psi: AngleLaw::Table(PeriodicSpline::new(&format!("{name}, pitch"), &psi)?),
    };
    Ok(PublishedMotion {
        name,
        source: "Robofly benchmark, repository lhooz/flapping_model_3d_overset, ff_benchmarking",
        right,
        frequency: None,
        stroke_plane_pitch: Some(FRAC_PI_2),
    })
}

/// Berman & Wang's optimum for the fruit fly. The deviation is not in the file it was read from
/// and is zero here.
pub fn berman_wang_fruit_fly() -> PublishedMotion {
    let angles = convert::BermanWang {
        phi_m: 90f64.to_radians(),
        k: 0.704,
        eta_m: 72.7f64.to_radians(),
        c_eta: 2.375,
        phi_eta: (-72.4f64).to_radians(),
    };
    PublishedMotion {
        name: "fruit fly optimum (Berman & Wang 2007), no deviation".to_owned(),
        source: "Berman & Wang 2007, J. Fluid Mech. 582:153; repository xijunke/wing_motion_pattern_WangZJ",
        right: convert::berman_wang(&angles),
        frequency: Some(234.0),
        stroke_plane_pitch: None,
    }
}

/// Fruit fly of the pitch-control simulations after Whitehead et al. 2015.
pub fn whitehead_fruit_fly() -> PublishedMotion {
    let angles = convert::BermanWang {
        phi_m: 65f64.to_radians(),
        k: 0.7,
        eta_m: 53f64.to_radians(),
        c_eta: 2.4,
        phi_eta: -FRAC_PI_2,
    };
    PublishedMotion {
        name: "fruit fly (Whitehead et al. 2015 style)".to_owned(),
        source: "gym_flySim environment, after Whitehead et al. 2015",
        right: convert::berman_wang(&angles),
        frequency: Some(220.0),
        stroke_plane_pitch: Some(45f64.to_radians()),
    }
}

/// Insects of [`fwuav_hover`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FwuavInsect {
    /// Monarch butterfly.
    Monarch,
    /// Hawkmoth.
    Hawkmoth,
    /// Bumblebee.
    Bumblebee,
    /// Fruit fly.
    FruitFly,
}

/// Hover optimum of the FWUAV project and the body pitch in hover \[rad\] that goes with it.
pub fn fwuav_hover(insect: FwuavInsect) -> (PublishedMotion, f64) {
    let rows = csv::rows(include_str!("../data/fwuav_hover.csv"));
    let row: &[f64] = &rows[insect as usize];
    let &[
        _,
        f,
        beta,
        body_pitch,
        phi_m,
        k,
        phi_0,
        pitch_m,
        c,
        pitch_0,
        pitch_a,
        dev_m,
        n,
        dev_0,
        dev_a,
    ] = row
    else {
        unreachable!("the shipped table has 15 columns")
    };
    let right = convert::fwuav(
        AngleLaw::SmoothTriangle(SmoothTriangle {
            amplitude: phi_m,
            shape: k,
            shift: FRAC_PI_2, // their stroke runs as a cosine
            mean: phi_0,
        }),
        AngleLaw::SmoothSquare(SmoothSquare {
            amplitude: pitch_m,
            shape: c,
            shift: pitch_a,
            mean: pitch_0,
        }),
        AngleLaw::Oval(Oval {
            amplitude: dev_m,
            count: n as usize,
            shift: dev_a,
            mean: dev_0,
        }),
    );
    let motion = PublishedMotion {
        name: format!("{insect:?} hover optimum (FWUAV)"),
        source: "repository fdcl-gwu/FWUAV, doc/QS_model.tex",
        right,
        frequency: Some(f),
        stroke_plane_pitch: Some(beta),
    };
    (motion, body_pitch)
}
