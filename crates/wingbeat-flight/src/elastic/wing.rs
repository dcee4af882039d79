//! One elastic wing: its body, its nodes, and what it does to the frame that carries it.

use wingbeat_dynamics::{AddedMass, BodyAcceleration, BodyMotion};
use wingbeat_math::six_by_six::{Ldlt, from_entries, scaled, symmetric_part};
use wingbeat_math::{DMat3, DVec3, MassProperties, SixBySix};
use wingbeat_model::{Members, Wing};
use wingbeat_structure::{
    Configuration, Follower, FrameMotion, GeneralizedAlpha, NODE, State, Structure,
};

use super::span::Station;
use super::tangent::added_mass;
use crate::error::FlightError;
use crate::interface::{BentShape, WingResponse};

/// A wing that loads bend.
#[derive(Debug)]
pub struct ElasticWing {
    /// Number of the wing; its body is the next.
    pub(super) wing: usize,
    /// Its name.
    pub(super) name: String,
    pub(super) structure: Structure,
    /// Whether it is a sheet, of which every panel of the mesh is an element.
    pub(super) is_sheet: bool,
    /// Nodes of the mesh.
    pub(super) followers: Vec<Follower>,
    /// Nodes of the mesh at the tip: leading and trailing edge.
    pub(super) tip: [usize; 2],
    /// Node of the elastic body at the tip.
    tip_node: usize,
    /// Sections that are recorded.
    pub(super) stations: [Station; 4],
    pub(super) method: GeneralizedAlpha,
    /// Share of the fastest vibrations that it leaves from step to step \[1\].
    pub(super) spectral_radius: f64,
    /// Mass properties of its nodes at rest: as the multibody system has them, but for what these lack.
    pub(super) rigid: MassProperties,
}

/// What an elastic wing remembers from step to step.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ElasticState {
    /// Shape and velocities.
    pub structure: State,
    /// Acceleration of the frame of the wing \[m/s2\], N components, and angular acceleration \[rad/s2\], wing
    /// components.
    pub frame: [DVec3; 2],
}

impl ElasticState {
    /// Acceleration of the frame.
    pub(super) fn acceleration(&self) -> BodyAcceleration {
        let [linear, angular] = self.frame;
        BodyAcceleration { linear, angular }
    }
}

/// Places and motions of the nodes at an instant, whoever has them.
#[derive(Clone, Copy)]
pub(super) struct Nodes<'a> {
    pub at: &'a Configuration,
    pub velocity: &'a [f64],
    pub acceleration: &'a [f64],
}

impl ElasticWing {
    /// The elastic body of `wing`, number `index` of the animal; none of a rigid one.
    ///
    /// # Errors
    /// What the elastic body refuses.
    pub fn new(index: usize, wing: &Wing) -> Result<Option<Self>, FlightError> {
        let Some(structure) = &wing.structure else {
            return Ok(None);
        };
        let method = GeneralizedAlpha::new(structure.spectral_radius)?;
        let body = structure.body(&wing.blank())?;
        Ok(Some(Self {
            wing: index,
            name: wing.name.clone(),
            rigid: wing.mass + body.structure.remainder().scaled(-1.0),
            tip: [0, wing.mesh.rows].map(|i| wing.mesh.node(i, wing.mesh.cols)),
            stations: Station::all(&wing.mesh.nodes, [wing.mesh.rows, wing.mesh.cols]),
            is_sheet: matches!(structure.members, Members::Shell(_)),
            tip_node: body.tip,
            structure: body.structure,
            followers: body.followers,
            method,
            spectral_radius: structure.spectral_radius,
        }))
    }

    /// Number of the wing.
    pub fn wing(&self) -> usize {
        self.wing
    }

    /// The elastic body.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Node of the elastic body at the tip: of a sheet that of its trailing edge, of a pointed one the point.
    pub fn tip_node(&self) -> usize {
        self.tip_node
    }

    /// Whether it is a sheet, of which every panel of the mesh is an element.
    pub fn is_sheet(&self) -> bool {
        self.is_sheet
    }

    /// How the nodes of the mesh follow.
    pub fn followers(&self) -> &[Follower] {
        &self.followers
    }

    /// Added mass of the air by what its panels answer to accelerations, the body moving like `m` and bent as
    /// in `at`: rows of six numbers a node each, as [`wingbeat_structure::modes`] takes it.
    pub fn added_mass(&self, air: &WingResponse, m: &BodyMotion, at: &Configuration) -> Vec<f64> {
        added_mass(air, m.r, &self.followers, at)
    }

    /// At rest.
    pub(super) fn initial(&self) -> ElasticState {
        ElasticState {
            structure: State::at_rest(self.structure.rest().clone()),
            frame: [DVec3::ZERO; 2],
        }
    }

    /// The nodes of the mesh.
    pub(super) fn shape(&self, nodes: Nodes<'_>, out: &mut BentShape) {
        let Nodes {
            at,
            velocity,
            acceleration,
        } = nodes;
        out.position.clear();
        out.velocity.clear();
        out.acceleration.clear();
        for f in &self.followers {
            out.position.push(f.position(at));
            out.velocity.push(f.velocity(at, velocity));
            out.acceleration
                .push(f.acceleration(at, velocity, acceleration));
        }
    }

    /// Forces on the nodes of the mesh \[N\], N components, as loads on the nodes of the body that moves like `m`.
    pub(super) fn gather(
        &self,
        m: &BodyMotion,
        at: &Configuration,
        forces: &[DVec3],
        loads: &mut [f64],
    ) {
        let back = m.r.transpose();
        loads.fill(0.0);
        for (f, force) in self.followers.iter().zip(forces) {
            f.add_force(at, back * *force, loads);
        }
    }

    /// What the wing as the rigid body it is at rest needs to move like its frame, less its weight; wing components.
    pub(super) fn rigid_inertia(&self, frame: &FrameMotion) -> [DVec3; 2] {
        let (s, j, w) = (self.rigid.first_moment, self.rigid.inertia, frame.w);
        let a = frame.acceleration;
        [
            self.rigid.mass * a + frame.w_dot.cross(s) + w.cross(w.cross(s)),
            j * frame.w_dot + w.cross(j * w) + s.cross(a),
        ]
    }

    /// From the derivative of what the wing exerts by the acceleration of its frame: what a mass beside that of
    /// the rigid wing has. Of its symmetric part so much that both together are positive definite, as masses
    /// are; the answer of the air to places and velocities within a step need not be.
    pub(super) fn carried(&self, response: &SixBySix) -> AddedMass {
        let rigid = self.rigid.matrix(DMat3::IDENTITY);
        let all = scaled(&symmetric_part(response), -1.0);
        let beside = from_entries(|i, j| all[i][j] - rigid[i][j]);
        let both = |part: f64| Ldlt::new(from_entries(|i, j| rigid[i][j] + part * beside[i][j]));
        let part = [1.0, 0.5, 0.25, 0.0]
            .into_iter()
            .find(|part| both(*part).is_positive());
        AddedMass::new(self.wing + 1, scaled(&beside, part.unwrap_or(0.0)))
    }

    /// From the derivative of the loads of the air by the acceleration of the frame: the added mass that it is.
    pub(super) fn carried_air(&self, response: &SixBySix) -> AddedMass {
        AddedMass::new(self.wing + 1, scaled(&symmetric_part(response), -1.0))
    }

    /// Its masses as rigid bodies in N, the frame moving like `m`: nodes, then points between them.
    pub(super) fn bodies<'a>(
        &'a self,
        m: &'a BodyMotion,
        nodes: Nodes<'a>,
    ) -> impl Iterator<Item = (MassProperties, BodyMotion)> + 'a {
        let at = move |u: DVec3, v: DVec3| (m.p + m.r * u, m.v + m.r * (m.w.cross(u) + v));
        let of_node = move |n: usize| {
            let six = &nodes.velocity[NODE * n..];
            (nodes.at.position[n], DVec3::from_slice(six))
        };
        let masses = self.structure.masses().iter().enumerate();
        let node = move |(n, mass): (usize, &MassProperties)| {
            let r = DMat3::from_quat(nodes.at.rotation[n]);
            let spin = DVec3::from_slice(&nodes.velocity[NODE * n + 3..]);
            let (u, v) = of_node(n);
            let (p, v) = at(u, v);
            let motion = BodyMotion {
                p,
                r: m.r * r,
                v,
                w: r.transpose() * m.w + spin,
            };
            (*mass, motion)
        };
        let between = self.structure.masses_between().iter().map(move |mass| {
            let [a, b] = mass.nodes.map(of_node);
            let (p, v) = at(a.0.midpoint(b.0), a.1.midpoint(b.1));
            let motion = BodyMotion {
                p,
                v,
                ..BodyMotion::REST
            };
            (MassProperties::point(mass.mass, DVec3::ZERO), motion)
        });
        masses.map(node).chain(between)
    }
}
