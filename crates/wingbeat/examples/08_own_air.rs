//! An air of one's own: the wings of the smallest insects, falling, as discs in creeping flow.
//! `cargo run --release --example 08_own_air`

use wingbeat::model::species::{FlyOptions, drosophila_melanogaster};
use wingbeat::prelude::*;

/// Viscosity of air [Pa s].
const VISCOSITY: f64 = 1.8e-5;

/// Thin discs at vanishing Reynolds number, each alone in its flow: force `-mu a (32/3 v + 16/3 n (n . v))`
/// at the centre, moment `-32/3 mu a^3 w` [Happel & Brenner 1983, sec. 5-11]. The body has no drag.
#[derive(Debug)]
struct CreepingFlow(Vec<Disc>);

/// In place of a wing.
#[derive(Debug)]
struct Disc {
    /// Radius a [m]: the disc has the area of the wing.
    radius: f64,
    /// Centre of the wing, wing frame [m]; the normal n is axis 3.
    centre: DVec3,
}

impl Disc {
    fn of(wing: &Wing) -> Self {
        let area = wingbeat::model::mesh::integrate::area(&wing.mesh.to_quads(wing.side));
        Self {
            radius: (area / std::f64::consts::PI).sqrt(),
            centre: wing.mass.centre(), // the mass is spread evenly
        }
    }

    fn load(&self, motion: &BodyMotion) -> Wrench {
        let (v, n) = (motion.point_velocity(self.centre), motion.r.z_axis);
        let drag = -VISCOSITY * self.radius * (32.0 / 3.0 * v + 16.0 / 3.0 * n * n.dot(v));
        let mut load = Wrench::at(drag, motion.r * self.centre);
        load.moment -= 32.0 / 3.0 * VISCOSITY * self.radius.powi(3) * (motion.r * motion.w);
        load
    }
}

impl Air for CreepingFlow {
    fn loads(
        &self,
        at: &Instant<'_>,
        _memory: Option<&AirMemory>,
        _scratch: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        out.fill(Wrench::default()); // body 0 is the central one, then the wings
        for (k, disc) in self.0.iter().enumerate() {
            out[k + 1] = disc.load(&at.motions[k + 1]);
        }
        Ok(())
    }
}

/// Speed [m/s] at which the animal falls in the end, and by the closed form: weight over the sum of
/// `16 mu a` of the wings, broadside on.
pub(crate) fn fall() -> Result<[f64; 2], Box<dyn std::error::Error>> {
    let mut insect = drosophila_melanogaster(&FlyOptions {
        scale: 0.05, // wings of 0.13 mm
        ..FlyOptions::default()
    })?;
    for wing in &mut insect.wings {
        wing.motion = WingMotion::fixed(0.0, [0.0; 3]); // spread and still
        wing.hinge_b.x = -Disc::of(wing).centre.x; // a parachute above the body
    }
    let discs: Vec<Disc> = insect.wings.iter().map(Disc::of).collect();
    let drag: f64 = discs.iter().map(|d| 16.0 * VISCOSITY * d.radius).sum();
    let closed = insect.mass() * 9.81 / drag;
    let air = AirModel::Own(std::sync::Arc::new(CreepingFlow(discs)));
    let mut flight = Flight::new("falling", insect, air);
    (flight.setup.time.step, flight.setup.time.steps) = (1e-4, 2000); // s
    let run = flight.fly()?;
    let end = run.records.last().expect("a start at least");
    Ok([end.momentum.z / run.setup.animal.mass(), closed])
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [flown, closed] = fall()?.map(|speed| 1e3 * speed);
    println!("falls at {flown:.6} mm/s, closed form {closed:.6} mm/s");
    Ok(())
}
