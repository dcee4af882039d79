//! Blade elements on the bodies: strips from the wing meshes, loads from the motions.
//!
//! The added mass is linear in the accelerations, and the accelerations follow from the loads.
//! Both are solved for together at every evaluation ([`crate::equations`]), so the loads are a
//! function of state and time alone: quasi-steady air needs no history.

use wingbeat_blade::{
    BladeError, BladeWing, BodyDrag, FrameAcceleration, FrameMotion, Load, SectionMotion, Strip,
};
use wingbeat_dynamics::{BodyAcceleration, BodyMotion, Wrench};
use wingbeat_math::DVec3;
use wingbeat_model::deformation::Stations;
use wingbeat_model::{Animal, Wing, WingMotion};

use crate::setup::BladeOptions;

/// The blade elements of an animal.
#[derive(Clone, Debug)]
pub struct BladeSide {
    /// Wings in the animal's order: body `i + 1`.
    pub wings: Vec<BladeWing>,
    /// How they are deformed.
    deforming: Vec<Option<DeformingStrips>>,
    drag: Option<BodyDrag>,
    density: f64,
    stream: DVec3,
}

/// Strips of a wing that changes its shape in the phase of its beat.
#[derive(Clone, Debug)]
struct DeformingStrips {
    stations: Stations,
    motion: WingMotion,
    /// Span and distance of the feathering axis ahead of the twist axis, strip by strip [m].
    places: Vec<[f64; 2]>,
}

impl DeformingStrips {
    fn new(wing: &Wing) -> Option<Self> {
        let deformation = wing.deformation.as_ref()?;
        let strips = strips(wing);
        let tip = wing.report().length;
        let r: Vec<f64> = strips.iter().map(|s| s.y.abs() / tip).collect();
        let ahead = |s: &Strip| deformation.axis_fraction * s.chord - s.x_leading;
        Some(Self {
            stations: Stations::new(deformation, &r, wing.root()),
            motion: wing.motion.clone(),
            places: strips.iter().map(|s| [s.y, ahead(s)]).collect(),
        })
    }

    fn section(&self, k: usize, phase: [f64; 3]) -> SectionMotion {
        let (s, [y, ahead]) = (self.stations.at(k, phase), self.places[k]);
        let [d, v, a] = s.displacement(ahead, 0.0, 0.0);
        SectionMotion {
            axis: [DVec3::new(0.0, y, 0.0) + d, v, a],
            twist: s.twist,
        }
    }
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
            deforming: animal.wings.iter().map(DeformingStrips::new).collect(),
            drag: options.body_drag,
            density: options.blade.density,
            stream: options.blade.free_stream,
        })
    }

    /// Whether any wing is deformed.
    pub fn deforms(&self) -> bool {
        self.deforming.iter().any(Option::is_some)
    }

    /// Loads that depend on velocities alone, at time `t` [s], about the origins of the bodies, N
    /// components.
    pub fn velocity_loads(&self, t: f64, motions: &[BodyMotion], out: &mut [Wrench]) {
        out.fill(Wrench::default());
        if let Some(drag) = &self.drag {
            let b = &motions[0];
            let v = b.r.transpose() * (b.v - self.stream);
            out[0].force = b.r * drag.force(self.density, v);
        }
        for (i, wing) in self.wings.iter().enumerate() {
            let m = &motions[i + 1];
            let load = match &self.deforming[i] {
                None => wing.velocity_load(&frame(m)),
                Some(d) => {
                    let phase = d.motion.phase_at(t);
                    let section = |k| d.section(k, phase);
                    wing.deforming_velocity_load(&frame(m), section).load
                }
            };
            out[i + 1] = turned(&load, m);
        }
    }

    /// Loads of the added mass at time `t` [s].
    pub fn acceleration_loads(
        &self,
        t: f64,
        motions: &[BodyMotion],
        accelerations: &[BodyAcceleration],
        out: &mut [Wrench],
    ) {
        out.fill(Wrench::default());
        for (i, wing) in self.wings.iter().enumerate() {
            let (m, acc) = (&motions[i + 1], acceleration(&accelerations[i + 1]));
            let load = match &self.deforming[i] {
                None => wing.acceleration_load(&frame(m), &acc),
                Some(d) => {
                    let phase = d.motion.phase_at(t);
                    let section = |k| d.section(k, phase);
                    wing.deforming_acceleration_load(&frame(m), &acc, section)
                        .load
                }
            };
            out[i + 1] = turned(&load, m);
        }
    }

    /// Power that is needed to deform the wings against the air at time `t` [W], body by body.
    pub fn deformation_power(
        &self,
        t: f64,
        motions: &[BodyMotion],
        accelerations: &[BodyAcceleration],
        out: &mut [f64],
    ) {
        out.fill(0.0);
        for (i, (wing, deforming)) in self.wings.iter().zip(&self.deforming).enumerate() {
            let Some(d) = deforming else { continue };
            let (m, acc) = (&motions[i + 1], acceleration(&accelerations[i + 1]));
            let phase = d.motion.phase_at(t);
            let section = |k| d.section(k, phase);
            out[i + 1] = wing.deforming_velocity_load(&frame(m), section).power
                + wing
                    .deforming_acceleration_load(&frame(m), &acc, section)
                    .power;
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

fn acceleration(a: &BodyAcceleration) -> FrameAcceleration {
    FrameAcceleration {
        linear: a.linear,
        angular: a.angular,
    }
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
