//! Blade elements on the bodies: strips from the wing meshes, loads from the motions.
//!
//! The added mass is linear in the accelerations, and the accelerations follow from the loads.
//! Both are solved for together at every evaluation ([`crate::equations`]), so the loads are a
//! function of state and time alone: quasi-steady air needs no history.

use wingbeat_air::blade::{
    BladeError, BladeWing, BodyDrag, FrameAcceleration, FrameMotion, Load, Strip,
};
use wingbeat_dynamics::{BodyAcceleration, BodyMotion, Wrench};
use wingbeat_math::DVec3;
use wingbeat_model::{Animal, Wing};

use crate::setup::BladeOptions;

/// The blade elements of an animal.
#[derive(Clone, Debug)]
pub struct BladeSide {
    /// Wings in the animal's order: body `i + 1`.
    pub wings: Vec<BladeWing>,
    drag: Option<BodyDrag>,
    density: f64,
    stream: DVec3,
}

impl BladeSide {
    /// One strip per column of each wing's mesh.
    ///
    /// # Errors
    /// A setting out of range; a strip without chord.
    pub fn new(animal: &Animal, options: &BladeOptions) -> Result<Self, BladeError> {
        if let Some(drag) = &options.body_drag {
            drag.check()?;
        }
        let mut settings = options.blade;
        settings.free_stream += options.induced;
        let wing = |w: &Wing| BladeWing::new(strips(w), settings);
        Ok(Self {
            wings: animal.wings.iter().map(wing).collect::<Result<_, _>>()?,
            drag: options.body_drag,
            density: options.blade.density,
            stream: options.blade.free_stream,
        })
    }

    /// Loads that depend on velocities alone, about the origins of the bodies, N components.
    pub fn velocity_loads(&self, motions: &[BodyMotion], out: &mut [Wrench]) {
        out.fill(Wrench::default());
        if let Some(drag) = &self.drag {
            let b = &motions[0];
            let v = b.r.transpose() * (b.v - self.stream);
            out[0].force = b.r * drag.force(self.density, v);
        }
        for ((wing, m), o) in self.wings.iter().zip(&motions[1..]).zip(&mut out[1..]) {
            *o = turned(&wing.velocity_load(&frame(m)), m);
        }
    }

    /// Loads of the added mass.
    pub fn acceleration_loads(
        &self,
        motions: &[BodyMotion],
        accelerations: &[BodyAcceleration],
        out: &mut [Wrench],
    ) {
        out.fill(Wrench::default());
        for (i, wing) in self.wings.iter().enumerate() {
            let (m, a) = (&motions[i + 1], &accelerations[i + 1]);
            let acc = FrameAcceleration {
                linear: a.linear,
                angular: a.angular,
            };
            out[i + 1] = turned(&wing.acceleration_load(&frame(m), &acc), m);
        }
    }
}

/// One strip per spanwise panel: mean chord and mean place of its leading edge.
pub fn strips(wing: &Wing) -> Vec<Strip> {
    let mesh = &wing.mesh;
    let strip = |j: usize| {
        let at = |i: usize, j: usize| mesh.nodes[mesh.node(i, j)];
        let leading = 0.5 * (at(0, j) + at(0, j + 1));
        let trailing = 0.5 * (at(mesh.rows, j) + at(mesh.rows, j + 1));
        Strip {
            y: leading.y,
            x_leading: leading.x,
            chord: leading.x - trailing.x,
            width: (at(0, j + 1).y - at(0, j).y).abs(),
        }
    };
    (0..mesh.cols).map(strip).collect()
}

/// A body's motion in the words of the blade elements.
pub(crate) fn frame(m: &BodyMotion) -> FrameMotion {
    FrameMotion {
        rotation: m.r,
        velocity: m.v,
        rate: m.w,
    }
}

/// A load in wing components as a wrench in N components.
pub(crate) fn turned(load: &Load, m: &BodyMotion) -> Wrench {
    Wrench {
        force: m.r * load.force,
        moment: m.r * load.moment,
    }
}
