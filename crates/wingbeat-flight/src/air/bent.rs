//! Blade elements on wings that loads bend: nodes of the wing's mesh move the sections, whose forces go back to them.

use wingbeat_blade::{BladeWing, Lag, LocalWind, MeshSection, NodesInMotion};
use wingbeat_dynamics::{BodyAcceleration, BodyMotion, Wrench};
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::{Animal, Wing};

use crate::error::FlightError;
use crate::interface::{BentScratch, BentShape, Instant, WingResponse};

/// Sections of an elastic wing.
#[derive(Clone, Debug)]
pub struct BentStrips {
    /// Number of the wing.
    wing: usize,
    sections: Vec<MeshSection>,
}

impl BentStrips {
    /// Those of wing number `index`; none of a wing that loads do not bend.
    pub fn new(index: usize, wing: &Wing) -> Option<Self> {
        wing.structure.as_ref()?;
        let mesh = &wing.mesh;
        let column =
            |j: usize| -> Vec<usize> { (0..=mesh.rows).map(|i| mesh.node(i, j)).collect() };
        let section = |j: usize| MeshSection::new(&mesh.nodes, &column(j), &column(j + 1));
        Some(Self {
            wing: index,
            sections: (0..mesh.cols).map(section).collect(),
        })
    }

    /// The shape of the wing, if it has one now.
    fn shape<'a>(&self, at: &Instant<'a>) -> Option<&'a BentShape> {
        at.shapes.get(self.wing).and_then(Option::as_ref)
    }

    /// Forces of the air on the nodes into the scratch \[N\], N components, the whole returned about the origin
    /// of the wing; none of a wing without a shape. `wind` is beside the stream, wing components; circulations
    /// lag behind as `lag` says.
    pub fn load(
        &self,
        blade: &BladeWing,
        at: &Instant<'_>,
        wind: impl LocalWind,
        lag: Option<Lag<'_>>,
        s: &mut BentScratch,
    ) -> Option<Wrench> {
        let shape = self.shape(at)?;
        let m = &at.motions[self.wing + 1];
        s.set_nodes(
            m,
            at.accelerations.get(self.wing + 1),
            shape,
            blade.settings().free_stream,
        );
        self.set_states(blade, &wind, m.r, s);
        if s.forces.len() <= self.wing {
            s.forces.resize(self.wing + 1, vec![]);
        }
        let forces = &mut s.forces[self.wing];
        forces.clear();
        forces.resize(shape.position.len(), DVec3::ZERO);
        blade.bent_forces(&self.sections, &s.states, lag, forces);
        let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
        for (f, r) in forces.iter_mut().zip(&shape.position) {
            force += *f;
            moment += r.cross(*f);
            *f = m.r * *f;
        }
        Some(Wrench {
            force: m.r * force,
            moment: m.r * moment,
        })
    }

    fn set_states(
        &self,
        blade: &BladeWing,
        wind: &impl LocalWind,
        turn: DMat3,
        s: &mut BentScratch,
    ) {
        let nodes = NodesInMotion {
            position: &s.position,
            velocity: &s.velocity,
            acceleration: &s.acceleration,
        };
        s.states.clear();
        (s.states).extend(
            self.sections
                .iter()
                .map(|section| section.state(blade, &nodes, wind, turn)),
        );
    }

    /// How the forces of the sections answer to their motion; false without a shape.
    pub fn respond(
        &self,
        blade: &BladeWing,
        at: &Instant<'_>,
        wind: impl LocalWind,
        lag: Option<Lag<'_>>,
        (s, out): (&mut BentScratch, &mut WingResponse),
    ) -> bool {
        let Some(shape) = self.shape(at) else {
            return false;
        };
        let m = &at.motions[self.wing + 1];
        s.set_nodes(
            m,
            at.accelerations.get(self.wing + 1),
            shape,
            blade.settings().free_stream,
        );
        self.set_states(blade, &wind, m.r, s);
        blade.bent_answers(&self.sections, &s.states, lag, &mut s.answers);
        let order = 3 * s.answers.len();
        out.panels.resize_with(order, Vec::new);
        for matrix in [&mut out.matrix, &mut out.inertia] {
            matrix.clear();
            matrix.resize(order * order, 0.0);
        }
        for (k, answer) in s.answers.iter().enumerate() {
            for i in 0..3 {
                let row = (3 * k + i) * order + 3 * k;
                out.matrix[row..row + 3].copy_from_slice(&answer.velocity[i]);
                out.inertia[row..row + 3].copy_from_slice(&answer.acceleration[i]);
            }
            for (way, panel) in answer.ways.iter().zip(&mut out.panels[3 * k..]) {
                panel.clear();
                panel.extend(way.iter().map(|(n, by)| (*n, by.map(|b| m.r * b))));
            }
        }
        if !blade.has_added_mass() {
            out.inertia.clear();
        }
        true
    }
}

impl BentScratch {
    /// Nodes of a wing whose frame moves like `m` and accelerates like `acc` through the `stream` \[m/s\], N
    /// components.
    fn set_nodes(
        &mut self,
        m: &BodyMotion,
        acc: Option<&BodyAcceleration>,
        shape: &BentShape,
        stream: DVec3,
    ) {
        let back = m.r.transpose();
        let (v, w) = (back * (m.v - stream), m.w);
        let acc = acc.copied().unwrap_or_default();
        let (a, turn) = (back * acc.linear, acc.angular);
        self.position.clone_from(&shape.position);
        self.velocity.clear();
        self.acceleration.clear();
        let nodes = shape
            .position
            .iter()
            .zip(&shape.velocity)
            .zip(&shape.acceleration);
        for ((r, u), b) in nodes {
            let carried = w.cross(*r);
            self.velocity.push(v + carried + *u);
            let turning = turn.cross(*r) + w.cross(carried + 2.0 * *u);
            self.acceleration.push(a + turning + *b);
        }
    }

    /// Forces on the nodes of a wing at the instant last asked for \[N\], N components.
    pub fn forces(&self, wing: usize) -> &[DVec3] {
        self.forces.get(wing).map_or(&[], Vec::as_slice)
    }
}

/// Refuses wings whose surface was measured: strips are flat sections that twist and bend.
pub(super) fn refuse_measured_surfaces(animal: &Animal) -> Result<(), FlightError> {
    match animal.wings.iter().find(|w| w.has_measured_surface()) {
        None => Ok(()),
        Some(wing) => Err(FlightError::setup(
            "air.model",
            "blade_element",
            format!(
                "wing `{}` has a measured surface, which strips cannot follow: give twist and bending instead, or take the vortex lattice",
                wing.name
            ),
        )),
    }
}
