//! A wing on a beam: sections stay rigid, the beam bends and twists.

use wingbeat_math::{DQuat, DVec3};
use wingbeat_structure::{
    Beam, Configuration, Damping, Follower, Section, Stiffness, StructureBuilder, StructureError,
};

use super::body::{Blank, ElasticBody, check_positive};
use crate::deformation::{SpanLaw, column, span};
use crate::error::{ModelError, require, require_count};
use crate::mesh::GridMesh;

/// A beam along the span of a wing, with rigid sections across it.
#[derive(Clone, Debug, PartialEq)]
pub struct WingBeam {
    /// Place of the elastic axis behind the leading edge over the chord \[1\].
    pub axis_fraction: f64,
    /// Elements along the span.
    pub elements: usize,
    /// EI against bending out of the plane of the wing \[N m2\], over r/R.
    pub flap: SpanLaw,
    /// EI against bending in the plane of the wing \[N m2\], over r/R.
    pub lag: SpanLaw,
    /// GJ against twist \[N m2\], over r/R.
    pub torsion: SpanLaw,
    /// Mass per length \[kg/m\], over r/R; none spreads the mass of the wing evenly over its area.
    pub mass: Option<SpanLaw>,
    /// Place of the mass centre behind the leading edge over the chord \[1\].
    pub mass_fraction: f64,
    /// Moment of inertia about the mass centre of a section and its axis along the beam, per length \[kg m\], over r/R; none
    /// is that of the mass spread evenly over the chord.
    pub inertia: Option<SpanLaw>,
}

/// Leading edge, chord \[m\] and place along axis 2 \[m\] at a distance from the hinge.
struct Station {
    lead: f64,
    chord: f64,
    y: f64,
    z: f64,
}

/// The wing at the distance `r` \[m\] from the hinge, straight between columns of nodes.
fn station(mesh: &GridMesh, r: f64) -> Station {
    let distance = |j: usize| column(mesh, j).0;
    let j = (1..mesh.cols)
        .find(|&j| distance(j) > r)
        .unwrap_or(mesh.cols);
    let (a, b) = (j - 1, j);
    let s = (r - distance(a)) / (distance(b) - distance(a));
    let at = |of: &dyn Fn(usize) -> f64| of(a) + s * (of(b) - of(a));
    Station {
        lead: at(&|j| column(mesh, j).1),
        chord: at(&|j| column(mesh, j).2),
        y: at(&|j| mesh.nodes[mesh.node(0, j)].y),
        z: at(&|j| mesh.nodes[mesh.node(0, j)].z),
    }
}

impl WingBeam {
    /// Nodes at equal distances from root to tip, the first clamped.
    pub(super) fn body(
        &self,
        wing: &Blank<'_>,
        damping: Damping,
    ) -> Result<ElasticBody, StructureError> {
        let [root, tip] = span(wing.mesh);
        let count = self.elements + 1;
        let distance = |k: usize| root + (tip - root) * k as f64 / self.elements as f64;
        let place = |k: usize| {
            let s = station(wing.mesh, distance(k));
            DVec3::new(s.lead - self.axis_fraction * s.chord, s.y, s.z)
        };
        let rest = Configuration {
            position: (0..count).map(place).collect(),
            rotation: vec![DQuat::IDENTITY; count],
        };
        let middle = |k: usize| 0.5 * (distance(k) + distance(k + 1));
        let width = (tip - root) / self.elements as f64;
        let area: f64 = (0..self.elements)
            .map(|k| width * station(wing.mesh, middle(k)).chord)
            .sum();
        let even = wing.mass / area;
        let mut builder = StructureBuilder::new(rest.clone())
            .clamp(0)
            .damping(damping);
        for k in 0..self.elements {
            let length = rest.position[k].distance(rest.position[k + 1]);
            let along = (distance(k + 1) - distance(k)) / length;
            let section = self.section(wing, middle(k), (even, along));
            builder = builder.element(Beam::straight(&rest, [k, k + 1], DVec3::X, &section)?);
        }
        let follower = |x: &DVec3| {
            let r = x.y.abs().clamp(root, tip);
            let s = (r - root) / (tip - root) * self.elements as f64;
            let k = (s.floor() as usize).min(self.elements - 1);
            let part = s - k as f64;
            Follower::new(*x, &[(k, 1.0 - part), (k + 1, part)], &rest)
        };
        Ok(ElasticBody {
            structure: builder.build()?,
            followers: wing.mesh.nodes.iter().map(follower).collect(),
        })
    }

    /// Section at the distance `r` \[m\] from the hinge; `even` is the mass of the wing over its area \[kg/m2\], `along` the
    /// distance along the span over the length of the beam.
    fn section(&self, wing: &Blank<'_>, r: f64, (even, along): (f64, f64)) -> Section {
        let [root, tip] = span(wing.mesh);
        let value = |law: &SpanLaw| law.at(r / tip, root / tip);
        let Station { chord, .. } = station(wing.mesh, r);
        let [flap, lag, torsion] = [&self.flap, &self.lag, &self.torsion].map(value);
        // As a plate that is as stiff in its plane has it: EA = 12 EI / c2; shear as of solid sections.
        let axial = 12.0 * lag.max(flap) / (chord * chord);
        let stiffness = Stiffness {
            axial,
            shear: [axial / 3.0; 2],
            torsion,
            bending: [flap, lag],
        };
        let mass = along * self.mass.as_ref().map_or(even * chord, value);
        // Thin: all its inertia about the beam is that of the chord; a hundredth of the chord thick.
        let even = mass * chord * chord / 12.0;
        let roll = self.inertia.as_ref().map_or(even, |law| along * value(law));
        Section::new(&stiffness).with_mass(
            mass,
            [(self.axis_fraction - self.mass_fraction) * chord, 0.0],
            [1e-4 * roll, roll],
        )
    }

    pub(super) fn scaled(&self, s: f64) -> Self {
        let stiffness = s.powi(4);
        Self {
            flap: self.flap.scaled(stiffness),
            lag: self.lag.scaled(stiffness),
            torsion: self.torsion.scaled(stiffness),
            mass: self.mass.as_ref().map(|m| m.scaled(s * s)),
            inertia: self.inertia.as_ref().map(|i| i.scaled(s.powi(4))),
            ..self.clone()
        }
    }

    pub(super) fn check(&self, key: &str, root: f64) -> Result<(), ModelError> {
        let of = |k: &str| format!("{key}.{k}");
        for (k, x) in [
            ("axis_fraction", self.axis_fraction),
            ("mass_fraction", self.mass_fraction),
        ] {
            require(&of(k), x, (0.0..=1.0).contains(&x), "from 0 to 1")?;
        }
        let some = (1..=400).contains(&self.elements);
        require_count(&of("elements"), self.elements, some, "1 to 400")?;
        let laws = [
            ("flap", Some(&self.flap)),
            ("lag", Some(&self.lag)),
            ("torsion", Some(&self.torsion)),
            ("mass", self.mass.as_ref()),
            ("inertia", self.inertia.as_ref()),
        ];
        for (k, law) in laws {
            let Some(law) = law else { continue };
            law.check(&of(k), root)?;
            check_positive(&of(k), law, root)?;
        }
        Ok(())
    }
}
