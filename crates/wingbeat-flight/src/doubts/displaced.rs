//! Bodies beside the fluid that they displace: its weight, which bears them up where the case says so, and its mass, which
//! `hamming` does not carry along with a light body.

use wingbeat_math::DVec3;

use crate::setup::applied::LoadFrame;
use crate::setup::{FlightSetup, IntegratorChoice, MotionMode};

/// Mass of the fluid displaced over that of the flyer from which on its weight is missed \[1\].
const FELT: f64 = 0.03;

/// Part of the weight of the fluid that loads must carry to stand for buoyancy \[1\].
const CARRIED: f64 = 0.5;

/// Mass over that of the fluid displaced below which a body in the lattice alternates by `hamming`: of added mass, a
/// sphere has half of it (docs/dynamics.md) \[1\].
const LIGHT: f64 = 3.0;

impl FlightSetup {
    /// Says that the fluid displaced by bodies weighs so much beside the flyer that buoyancy is missed.
    pub fn without_buoyancy(&self) -> Option<String> {
        let volume: f64 = self.animal.solids().iter().map(|s| s.1).sum();
        let displaced = self.air.density()? * volume;
        let part = displaced / self.animal.mass();
        let is_given = self.lift_of_loads() >= CARRIED * displaced * self.gravity.length();
        let is_felt = self.is_moved_by_forces() && self.gravity != DVec3::ZERO && part >= FELT;
        (is_felt && !is_given).then(|| {
            format!(
                "the fluid that the bodies displace weighs {part:.3} times the flyer, and nothing bears them up: set air.buoyancy = true, or give the weight that is left by a [[load]]"
            )
        })
    }

    /// Constant loads against gravity in all, buoyancy among them \[N\].
    pub fn lift_of_loads(&self) -> f64 {
        let up = -self.gravity.normalize_or_zero();
        let inertial = self.loads.iter().filter(|l| l.frame == LoadFrame::Inertial);
        let force =
            |l: &crate::AppliedLoad| DVec3::from_array(l.force.each_ref().map(|f| f.constant));
        inertial.map(|l| force(l).dot(up)).sum()
    }

    /// Says that a free flyer in the lattice weighs so little beside the fluid that its body displaces that `hamming`
    /// does not carry that along.
    pub fn light_beside_fluid(&self) -> Option<String> {
        let ratio = self.mass_over_carried_fluid()?;
        let is_stable = self.integrator == IntegratorChoice::Bdf;
        (!is_stable).then(|| {
            format!(
                "the flyer weighs {ratio:.2} times the fluid that its body displaces, and below {LIGHT} times forces may alternate or steps not converge by dynamics.integrator = \"{}\": set dynamics.integrator = \"bdf\"",
                self.integrator.name()
            )
        })
    }

    /// Mass of a free flyer in the lattice over that of the fluid that its body displaces, where it is so small that added
    /// mass moves it \[1\].
    pub(crate) fn mass_over_carried_fluid(&self) -> Option<f64> {
        let air = self.air.lattice().filter(|air| air.body_surfaces)?;
        let solids = self.animal.solids();
        let (_, volume, _) = solids.iter().find(|s| s.0 == 0)?;
        let ratio = self.animal.mass() / (air.lattice.density * volume);
        (matches!(self.mode, MotionMode::Free(_)) && ratio < LIGHT).then_some(ratio)
    }
}
