//! Torsion of elastic wings that blade elements excite.
//!
//! A section in a stream U turns with the rate q about an elastic axis a c behind the edge that meets the air: its leading
//! edge, or the trailing edge where the air comes from behind; so all parts of the chord are counted. The normal force
//! `2 pi s` times the angle and the circulation `C_rot c^2 q` act at the centre of pressure, x_cp c behind the edge, and
//! the added mass gives `m U q` at mid chord. Of a section that feathers about an axis x0 c behind the edge:
//!
//! `pi rho c^3 U q ((a - x_cp) (s (x0 - a) + C_rot / pi) - (1/2 - a)/4 - k)`, which drives the motion where positive.
//!
//! With the couple `-(pi/16) rho c^3 U q` k is 1/16 [Theodorsen 1935]; laws with one coefficient leave it out. Thin-airfoil
//! theory has s = 1, x_cp = 1/4 and C_rot = pi (3/4 - x0), whichever edge is in front ([`Rotation::Circulation`]): without the couple `a > (5 - sqrt 5)/8 = 0.35` is driven, with
//! it a > 1/2. The less lift a law has, the less it damps, as the circulation of turning stays: with the default
//! coefficients (s = 0.594, drag included) the border is 0.416 where the wing feathers about its leading edge, and 0.448
//! about a quarter of the chord. Behind the border a wake that lags is what damps: by
//! Theodorsen's function F + i G of the reduced frequency k_r of the torsion, `s (x0 - a)` becomes
//! `s (F (x0 - a) - (1 - F) C_rot / pi + G / (2 k_r))`. With s = 1 that damps ahead of and behind mid chord; with the
//! default coefficients and slow air (F = 1/2) up to 0.444 and 0.485 only. Where wings bend, too,
//! without the couple those grow whose elastic axis or mass lies behind a quarter of the chord: a wing of 0.3 x 0.08 m at
//! 5 m/s by 15 1/s with the axis at 0.25 and the mass at 0.5, by 3 and 23 1/s with both at 0.3 and 0.4; with both at 0.25
//! it decays.
//!
//! Damping of the wing's own takes `tau G J k^2 / 2 + alpha I / 2` over the inertia of the torsion of wave
//! number k, a quarter of a wave from root to tip (rates of strain by the time tau, momentum at the rate
//! alpha). Torsion by itself grows where the air gives more; what bending adds to that is not known of a wing
//! that is damped.

use std::f64::consts::PI;

use wingbeat_blade::{AddedMassModel, BladeSettings, PlacedStrip, Rotation, Unsteady};
use wingbeat_math::DVec3;
use wingbeat_model::deformation::SpanLaw;
use wingbeat_model::{Members, Wing, WingBeam};
use wingbeat_structure::Damping;

use super::said::names;
use crate::air::strips;
use crate::setup::{AirModel, FlightSetup};

/// Elastic axis or mass behind the edge that meets the air over the chord, behind which a wing is driven without the couple \[1\].
const DRIVEN: f64 = 0.251;

/// Instants of a beat at which speeds are looked at.
const INSTANTS: usize = 50;

/// Angle by which the slope of the lift is found \[rad\].
const SMALL: f64 = 1e-6;

impl FlightSetup {
    /// Says which elastic wings have not enough damping of their own for what blade elements do to their torsion; none
    /// of other air.
    pub fn excited_torsion(&self) -> Option<String> {
        let AirModel::BladeElement(air) = &self.air else {
            return None;
        };
        let wings = self.animal.wings.iter();
        let driven: Vec<&Wing> = wings.filter(|w| self.is_driven(w, &air.blade)).collect();
        let wings: Vec<&str> = driven.iter().map(|w| &w.name[..]).collect();
        let why = match (air.blade.unsteady, air.blade.damps_feathering()) {
            (Some(_), _) => {
                "wakes of blade elements damp less than these coefficients and the circulation of feathering drive about an elastic axis so far from the centre of pressure, which"
            }
            (None, false) => {
                "quasi-steady blade elements leave out the moment of thin-airfoil theory against feathering, and what is left"
            }
            (None, true) => {
                "quasi-steady blade elements have no wake that lags, and what is left about an elastic axis so far behind the centre of pressure"
            }
        };
        let with_moment = BladeSettings {
            rotation: Rotation::Circulation,
            ..air.blade
        };
        let with_wakes = BladeSettings {
            unsteady: Some(Unsteady::Peters { states: 8 }),
            ..air.blade
        };
        let others = [
            (
                with_moment,
                "air.blade.rotation = \"circulation\" without rotation_coefficient",
            ),
            (with_wakes, "air.blade.unsteady = \"peters\""),
        ];
        let helps = |blade: &BladeSettings| !driven.iter().any(|w| self.is_driven(w, blade));
        let mut remedies: Vec<&str> = others
            .iter()
            .filter(|(blade, _)| helps(blade))
            .map(|(_, said)| *said)
            .collect();
        if remedies.is_empty() {
            remedies.push(
                "an elastic axis nearer to the edge that meets the air (structure.beam.axis_fraction)",
            );
        }
        (!wings.is_empty()).then(|| {
            format!(
                "{why} makes the torsion of elastic wings grow, in steps of any size (wings {}, whose own damping, if they have any, takes less): take {}, or give more structure.damping_s",
                names(wings, ", "),
                remedies.join(", ")
            )
        })
    }

    /// Whether the torsion of `wing` is driven by more than its own damping takes.
    fn is_driven(&self, wing: &Wing, blade: &BladeSettings) -> bool {
        wing.structure.as_ref().is_some_and(|made| {
            let damping = made.damping;
            let is_damped = damping.strain_rate > 0.0 || damping.mass > 0.0;
            let bending_adds =
                !is_damped && !blade.damps_feathering() && blade.rotation != Rotation::None;
            match &made.members {
                Members::Beam(beam) => {
                    let strips = self.twisting_strips(wing, beam);
                    let behind = |a: f64| from_edge_in_front(a, comes_from_behind(&strips));
                    let is_behind =
                        behind(beam.axis_fraction).max(behind(beam.mass_fraction)) > DRIVEN;
                    bending_adds && is_behind || gains(&strips, beam, (damping, blade)) > 0.0
                }
                Members::Shell(_) => bending_adds,
            }
        })
    }

    /// The strips of a wing, twisted by a quarter of a wave, in its prescribed motion.
    fn twisting_strips(&self, wing: &Wing, beam: &WingBeam) -> Vec<TwistingStrip> {
        let motion = wing.motion.impulsive();
        let duration = self.round(motion.frequency);
        let instants = (0..INSTANTS).map(|k| k as f64 / INSTANTS as f64 * duration);
        let past: Vec<_> = instants.map(|t| self.air_past(wing, &motion, t)).collect();
        let (strips, report) = (strips(wing), wing.report());
        let [root, tip] = [wing.root() * report.length, report.length];
        let of_strip = |s: &PlacedStrip| {
            let (c, r) = (s.strip.chord, s.strip.y.abs());
            let wave = 0.5 * PI / (tip - root);
            let (twist, slope) = (wave * (r - root)).sin_cos();
            let mut speeds = [0.0; 2];
            for past in &past {
                let air = past(s.axis) * (DVec3::ONE - DVec3::Y);
                let is_from_behind = air.dot(s.turn.x_axis) > 0.0;
                speeds[usize::from(is_from_behind)] += air.length() / INSTANTS as f64;
            }
            let value = |law: &SpanLaw| law.at(r / tip, root / tip);
            let even = wing.mass.mass * c / report.area;
            let mass = beam.mass.as_ref().map_or(even, value);
            let own = beam.inertia.as_ref().map_or(mass * c * c / 12.0, value);
            let behind = (beam.mass_fraction - beam.axis_fraction) * c;
            TwistingStrip {
                chord: c,
                feathering: s.strip.x_leading / c,
                speeds,
                square: s.strip.width * twist * twist,
                inertia: s.strip.width * (own + mass * behind * behind) * twist * twist,
                stiffness: s.strip.width * value(&beam.torsion) * (wave * slope).powi(2),
            }
        };
        strips.iter().map(of_strip).collect()
    }
}

/// Whether the air comes from behind more than from ahead.
fn comes_from_behind(strips: &[TwistingStrip]) -> bool {
    let mean = |from: usize| {
        strips
            .iter()
            .map(|s| s.speeds[from] * s.square)
            .sum::<f64>()
    };
    mean(1) > mean(0)
}

/// A place `x` behind the leading edge over the chord, counted from the edge that meets the air.
fn from_edge_in_front(x: f64, from_behind: bool) -> f64 {
    if from_behind { 1.0 - x } else { x }
}

/// Power that the torsion of a wing gains, over the square of the rate of twist of its tip \[N m s\]: of
/// the air less what its damping takes.
fn gains(
    strips: &[TwistingStrip],
    beam: &WingBeam,
    (damping, blade): (Damping, &BladeSettings),
) -> f64 {
    let a = beam.axis_fraction;
    let (inertia, stiffness) = strips.iter().fold((0.0, 0.0), |(inertia, stiffness), s| {
        let added = s.added_inertia(blade, a);
        (inertia + s.inertia + added, stiffness + s.stiffness)
    });
    let omega = (stiffness / inertia).sqrt();
    let of_strip = |s: &TwistingStrip| {
        s.gains_of_air(blade, a, omega)
            - damping.mass * s.inertia
            - damping.strain_rate * s.stiffness
    };
    strips.iter().map(of_strip).sum()
}

/// A strip of a wing whose torsion is a quarter of a wave, over the square of the twist of the tip.
struct TwistingStrip {
    /// Chord \[m\].
    chord: f64,
    /// Feathering axis behind the leading edge over the chord \[1\].
    feathering: f64,
    /// Mean speed through the air along chord and normal \[m/s\]: while the air comes from ahead, and from behind, each
    /// over the whole time.
    speeds: [f64; 2],
    /// Width times the square of the twist \[m\].
    square: f64,
    /// Inertia of its own about the elastic axis [kg m2].
    inertia: f64,
    /// Stiffness against twist \[N m\].
    stiffness: f64,
}

impl TwistingStrip {
    /// Added inertia about an elastic axis `a` chords behind the leading edge [kg m2].
    fn added_inertia(&self, blade: &BladeSettings, a: f64) -> f64 {
        let own = match blade.added_mass {
            AddedMassModel::None => return 0.0,
            AddedMassModel::Normal => 0.0,
            AddedMassModel::Impulse | AddedMassModel::Section => 1.0 / 32.0,
        };
        let mass = 0.25 * PI * blade.density * self.chord.powi(4);
        self.square * mass * ((0.5 - a).powi(2) + own)
    }

    /// Power that it takes from the air in torsion of the frequency `omega` [rad/s] about an elastic axis `a` chords
    /// behind the leading edge, over the square of the rate of twist of the tip \[N m s\].
    fn gains_of_air(&self, blade: &BladeSettings, a: f64, omega: f64) -> f64 {
        let c = self.chord;
        let speed: f64 = self.speeds.iter().sum();
        let reduced = 0.5 * omega * c / speed;
        let wake = match blade.unsteady {
            Some(law) if speed > 0.0 => {
                let [f, g] = law.indicial().answer(reduced);
                [f, g / (2.0 * reduced)]
            }
            _ => [1.0, 0.0],
        };
        let axes = [a, self.feathering];
        let of_air = |from_behind: bool| {
            self.speeds[usize::from(from_behind)] * drive(blade, axes, from_behind, wake)
        };
        let viscous = blade.viscous.map_or(0.0, |v| PI / 16.0 * v.linear);
        self.square
            * blade.density
            * c.powi(3)
            * (PI * (of_air(false) + of_air(true)) - viscous * c)
    }
}

/// The moment of the air about an elastic axis of a section that feathers about another one, both behind its leading
/// edge over the chord, by the rate of twist and over `pi rho c^3 U` \[1\]: drives where it is positive. `wake` is F and
/// G / (2 k_r) of Theodorsen's function, 1 and 0 of quasi-steady air.
fn drive(
    blade: &BladeSettings,
    axes: [f64; 2],
    from_behind: bool,
    [in_phase, lag]: [f64; 2],
) -> f64 {
    let [a, feathering] = axes.map(|x| from_edge_in_front(x, from_behind));
    let [[lift, drag], [more, _]] = [0.0, SMALL].map(|alpha| blade.translation.at(alpha));
    let slope = ((more - lift) / SMALL + drag) / (2.0 * PI);
    let circulation = match blade.rotation {
        Rotation::None => 0.0,
        Rotation::Coefficient(c) => c / PI,
        // One coefficient whichever edge is in front.
        Rotation::SaneDickinson if blade.unsteady.is_none() => 0.75 - axes[1],
        _ => 0.75 - feathering,
    };
    let mass = match blade.added_mass {
        AddedMassModel::None => 0.0,
        _ => 0.25 * (0.5 - a),
    };
    let couple = if blade.damps_feathering() {
        1.0 / 16.0
    } else {
        0.0
    };
    let lever = a - blade.centre_of_pressure.edge_on();
    let downwash = in_phase * (feathering - a) - (1.0 - in_phase) * circulation + lag;
    lever * (slope * downwash + circulation) - mass - couple
}
