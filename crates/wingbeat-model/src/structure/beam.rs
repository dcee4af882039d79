//! A wing on a beam: sections stay rigid, the beam bends and twists.

mod coupling;
mod mass;

pub use coupling::Coupling;
pub use mass::BeamMass;

use wingbeat_math::{DMat3, DQuat, DVec3, MassProperties, outer, trace};
use wingbeat_structure::{
    Beam, BeamSection, Configuration, Damping, Follower, Stiffness, StructureBuilder,
    StructureError,
};

use super::body::{Blank, ElasticBody, check_not_negative, check_positive};
use crate::deformation::{SpanLaw, chord_line, column, is_flat, span};
use crate::error::{ModelError, require, require_count};
use crate::mesh::GridMesh;

/// A beam along the span of a wing, with rigid sections across it.
#[derive(Clone, Debug, PartialEq)]
pub struct WingBeam {
    /// Place of the elastic axis behind the leading edge over the chord \[1\].
    pub axis_fraction: f64,
    /// Elements along the span.
    pub elements: usize,
    /// r/R of the nodes from root to tip \[1\]; none: at equal distances.
    pub stations: Option<Vec<f64>>,
    /// EI against bending out of the plane of the wing \[N m2\], over r/R.
    pub flap: SpanLaw,
    /// EI against bending in the plane of the wing \[N m2\], over r/R; none is a hundred times that out of it,
    /// and shear that of a plate.
    pub lag: Option<SpanLaw>,
    /// GJ against twist \[N m2\], over r/R.
    pub torsion: SpanLaw,
    /// EA \[N\], over r/R; none is that of a plate as stiff in its plane, and of one a hundred times as stiff
    /// there as out of it at least.
    pub axial: Option<SpanLaw>,
    /// GA times the shear correction \[N\] along and across the chord, over r/R; none is so much that shear
    /// changes nothing (Euler and Bernoulli), but where neither `lag` nor `axial` is given that of a plate.
    pub shear: Option<SpanLaw>,
    /// Terms that couple stretch, twist and bending.
    pub coupling: Coupling,
    /// Mass per length of the span, across the chord and not along a swept beam \[kg/m\], over r/R; none
    /// spreads the mass of the wing, less lumped masses, evenly over its area.
    pub mass: Option<SpanLaw>,
    /// Place of the mass centre behind the leading edge over the chord \[1\].
    pub mass_fraction: f64,
    /// Moment of inertia about the mass centre of a section, which lies along the chord, and an axis along the beam,
    /// per length of the span \[kg m\],
    /// over r/R; none is that of the mass spread evenly over the chord.
    pub inertia: Option<SpanLaw>,
    /// Lumped masses.
    pub masses: Vec<BeamMass>,
}

/// In-plane over out-of-plane stiffness where nothing is said \[1\].
const LAG: f64 = 100.0;

/// GA L2 / EI of a slender beam \[1\]: shear lowers the first frequency by 2.5 over this, the tenth by a thousandth.
const SLENDER: f64 = 1e6;

/// Least part of the mass of a wing that lumped masses leave to the beam, more than rounding \[1\].
const LEFT: f64 = 1e-6;

/// Leading edge and chord, from the trailing to the leading edge \[m\], at a distance from the hinge, wing components.
struct Station {
    lead: DVec3,
    chord: DVec3,
}

/// The wing at the distance `r` \[m\] from the hinge along axis 2, straight between columns of nodes.
fn station(mesh: &GridMesh, r: f64) -> Station {
    let distance = |j: usize| column(mesh, j).0;
    let j = (1..mesh.cols)
        .find(|&j| distance(j) > r)
        .unwrap_or(mesh.cols);
    let s = (r - distance(j - 1)) / (distance(j) - distance(j - 1));
    let [inner, outer] = [j - 1, j].map(|j| chord_line(mesh, j));
    let at = |k: usize| inner[k] + s * (outer[k] - inner[k]);
    Station {
        lead: at(0),
        chord: at(1),
    }
}

/// An element of the beam.
struct Piece {
    /// Distance of its middle from the hinge along axis 2 \[m\].
    r: f64,
    /// Width of the wing along it, across the chord \[m\].
    width: f64,
    /// Its width over its length \[1\].
    along: f64,
    /// Direction of the chord there (forward), wing components.
    chordwise: DVec3,
    /// How far that goes along the beam and across it \[1\].
    lies: [f64; 2],
}

/// Part of an element within which a lumped mass lies at its node \[1\].
const AT_NODE: f64 = 0.05;

/// What all pieces of a beam share.
struct Whole {
    /// Mass of the wing, less lumped masses, over its area \[kg/m2\].
    even: f64,
    /// Length of the beam \[m\].
    length: f64,
}

/// 1 on a right wing, -1 on a left one.
fn side(mesh: &GridMesh) -> f64 {
    mesh.nodes[mesh.node(0, mesh.cols)].y.signum()
}

/// How the nodes of the mesh follow those of the beam on either side, at the distances `at` \[m\] from the hinge.
fn followers(mesh: &GridMesh, at: &[f64], rest: &Configuration) -> Vec<Follower> {
    let last = at.len() - 1;
    let follower = |x: &DVec3| {
        let r = x.y.abs().clamp(at[0], at[last]);
        let k = at[1..last].iter().filter(|&&inner| inner <= r).count();
        let part = (r - at[k]) / (at[k + 1] - at[k]);
        Follower::new(*x, &[(k, 1.0 - part), (k + 1, part)], rest)
    };
    mesh.nodes.iter().map(follower).collect()
}

impl WingBeam {
    /// Nodes from root to tip, the first clamped.
    pub(super) fn body(
        &self,
        wing: &Blank<'_>,
        damping: Damping,
    ) -> Result<ElasticBody, StructureError> {
        let at = self.distances(wing.mesh);
        let rest = Configuration {
            position: at.iter().map(|&r| self.axis(wing.mesh, r)).collect(),
            rotation: vec![DQuat::IDENTITY; at.len()],
        };
        let pieces = self.pieces(wing.mesh, &at);
        let whole = Whole {
            even: self.even(wing, &pieces),
            length: pieces.iter().map(|p| p.width / p.along).sum(),
        };
        let mut builder = StructureBuilder::new(rest.clone())
            .clamp(0)
            .damping(damping);
        for (k, piece) in pieces.iter().enumerate() {
            let section = self.section(wing, piece, &whole);
            let beam = Beam::straight(&rest, [k, k + 1], piece.chordwise, &section)?;
            builder = builder.element(beam);
        }
        for m in &self.masses {
            let (node, mass) = self.lumped(wing.mesh, (&at, &rest), m);
            builder = builder.mass(node, mass);
        }
        Ok(ElasticBody {
            structure: builder.build()?,
            followers: followers(wing.mesh, &at, &rest),
            tip: at.len() - 1,
        })
    }

    /// Distances of the nodes from the hinge \[m\], those of lumped masses between others among them.
    fn distances(&self, mesh: &GridMesh) -> Vec<f64> {
        let [root, tip] = span(mesh);
        let mut at: Vec<f64> = match &self.stations {
            Some(stations) => stations.iter().map(|r| r * tip).collect(),
            None => (0..=self.elements)
                .map(|k| root + (tip - root) * k as f64 / self.elements as f64)
                .collect(),
        };
        for r in self.masses.iter().map(|m| m.at * tip) {
            let after = at.iter().filter(|&&node| node <= r).count();
            if let (Some(k), Some(&next)) = (after.checked_sub(1), at.get(after)) {
                let part = (r - at[k]) / (next - at[k]);
                if (AT_NODE..=1.0 - AT_NODE).contains(&part) {
                    at.insert(after, r);
                }
            }
        }
        at
    }

    /// Place of the elastic axis at the distance `r` \[m\] from the hinge, wing components \[m\].
    fn axis(&self, mesh: &GridMesh, r: f64) -> DVec3 {
        let s = station(mesh, r);
        s.lead - self.axis_fraction * s.chord
    }

    /// The elements between nodes at the distances `at` \[m\] from the hinge.
    fn pieces(&self, mesh: &GridMesh, at: &[f64]) -> Vec<Piece> {
        let flat = is_flat(mesh);
        let piece = |pair: &[f64]| {
            let r = 0.5 * (pair[0] + pair[1]);
            let line = self.axis(mesh, pair[1]) - self.axis(mesh, pair[0]);
            let (chordwise, width) = match flat {
                true => (DVec3::X, pair[1] - pair[0]),
                false => {
                    let e1 = station(mesh, r).chord.normalize();
                    (e1, (line - line.dot(e1) * e1).length())
                }
            };
            let along_beam = chordwise.dot(line.normalize());
            Piece {
                r,
                width,
                along: width / line.length(),
                chordwise,
                lies: [along_beam, (1.0 - along_beam * along_beam).sqrt()],
            }
        };
        at.windows(2).map(piece).collect()
    }

    /// Mass of the wing, less lumped masses, over its area \[kg/m2\].
    fn even(&self, wing: &Blank<'_>, pieces: &[Piece]) -> f64 {
        let strip = |p: &Piece| p.width * station(wing.mesh, p.r).chord.length();
        let area: f64 = pieces.iter().map(strip).sum();
        let lumped: f64 = self.masses.iter().map(|m| m.mass).sum();
        (wing.mass - lumped) / area
    }

    /// The node that a lumped mass moves with, and its mass properties about this node.
    fn lumped(
        &self,
        mesh: &GridMesh,
        (at, rest): (&[f64], &Configuration),
        m: &BeamMass,
    ) -> (usize, MassProperties) {
        let r = m.at * span(mesh)[1];
        let farther = at.windows(2).filter(|p| r > 0.5 * (p[0] + p[1]));
        let node = farther.count();
        let axis = self.axis(mesh, r);
        (node, m.about_node(axis - rest.position[node], side(mesh)))
    }

    /// Section of a piece.
    fn section(&self, wing: &Blank<'_>, piece: &Piece, whole: &Whole) -> BeamSection {
        let [root, tip] = span(wing.mesh);
        let (r, along) = (piece.r, piece.along);
        let value = |law: &SpanLaw| law.at(r / tip, root / tip);
        let chord = station(wing.mesh, r).chord.length();
        let usual = self.flap.scaled(LAG);
        let [flap, usual, torsion] = [&self.flap, &usual, &self.torsion].map(value);
        let lag = self.lag.as_ref().map_or(usual, value);
        // As a plate that is as stiff in its plane has it: EA = 12 EI / c2; its shear as of solid sections.
        let plate = 12.0 * lag.max(usual) / (chord * chord);
        let axial = self.axial.as_ref().map_or(plate, value);
        let slender = [lag, flap].map(|bending| SLENDER * bending / whole.length.powi(2));
        let is_plate = self.lag.is_none() && self.axial.is_none();
        let shear = if is_plate { [axial / 3.0; 2] } else { slender };
        let mut section = BeamSection::new(&Stiffness {
            axial,
            shear: self.shear.as_ref().map_or(shear, |law| [value(law); 2]),
            torsion,
            bending: [flap, lag],
        });
        let left = side(wing.mesh) < 0.0;
        self.coupling.add(r / tip, left, &mut section.stiffness);
        let mass = along * self.mass.as_ref().map_or(whole.even * chord, value);
        let [along_beam, across] = piece.lies;
        let direction = DVec3::new(along_beam, across, 0.0);
        // Thin: all its inertia about the beam is that of the chord, which may be oblique to it; a hundredth of
        // the chord thick.
        let even = mass * chord * chord / 12.0;
        let roll = |law: &SpanLaw| along * value(law) / (across * across);
        let spread = self.inertia.as_ref().map_or(even, roll);
        let moments = spread * outer(direction) + 1e-4 * spread * outer(DVec3::Z);
        let inertia = trace(moments) * DMat3::IDENTITY - moments;
        let behind = (self.axis_fraction - self.mass_fraction) * chord;
        section.mass = MassProperties::about_centre(mass, behind * direction, inertia);
        section
    }

    pub(super) fn scaled(&self, s: f64) -> Self {
        let stiffness = s.powi(4);
        Self {
            flap: self.flap.scaled(stiffness),
            lag: self.lag.as_ref().map(|l| l.scaled(stiffness)),
            torsion: self.torsion.scaled(stiffness),
            axial: self.axial.as_ref().map(|a| a.scaled(s * s)),
            shear: self.shear.as_ref().map(|g| g.scaled(s * s)),
            coupling: self.coupling.scaled(s),
            masses: self.masses.iter().map(|m| m.scaled(s)).collect(),
            mass: self.mass.as_ref().map(|m| m.scaled(s * s)),
            inertia: self.inertia.as_ref().map(|i| i.scaled(s.powi(4))),
            ..self.clone()
        }
    }

    /// Checks that lumped masses weigh less than the wing whose mass they are part of.
    pub(super) fn check_mass(&self, key: &str, mass: f64) -> Result<(), ModelError> {
        let lumped: f64 = self.masses.iter().map(|m| m.mass).sum();
        let is_own = self.mass.is_some() || self.masses.is_empty();
        let fits = is_own || lumped <= (1.0 - LEFT) * mass;
        let allowed = "less in all than the mass of the wing, which they are part of: what is left is that of the beam";
        require(&format!("{key}.mass"), lumped, fits, allowed)?;
        Ok(())
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
        if let Some(stations) = &self.stations {
            check_stations(&of("stations"), stations, root)?;
        }
        self.coupling.check(&of("coupling"), root)?;
        for (k, m) in self.masses.iter().enumerate() {
            m.check(&of(&format!("mass[{k}]")), root)?;
        }
        let stiffness = [
            ("flap", Some(&self.flap)),
            ("lag", self.lag.as_ref()),
            ("torsion", Some(&self.torsion)),
            ("axial", self.axial.as_ref()),
            ("shear", self.shear.as_ref()),
        ];
        let mass = [
            ("mass", self.mass.as_ref()),
            ("inertia", self.inertia.as_ref()),
        ];
        for (k, law) in stiffness.into_iter().chain(mass) {
            let Some(law) = law else { continue };
            law.check(&of(k), root)?;
            let is_lumped = ["mass", "inertia"].contains(&k) && !self.masses.is_empty();
            match is_lumped {
                true => check_not_negative(&of(k), law, root)?,
                false => check_positive(&of(k), law, root)?,
            }
        }
        Ok(())
    }
}

/// Refuses stations that do not rise from the root of the surface to its tip.
fn check_stations(key: &str, stations: &[f64], root: f64) -> Result<(), ModelError> {
    let count = stations.len();
    require_count(key, count, (2..=401).contains(&count), "2 to 401 stations")?;
    let (first, last) = (stations[0], stations[count - 1]);
    let begins = (first - root).abs() < 1e-6;
    let from = format!("{root:.8} first, r/R of the root of the surface");
    require(key, first, begins, from)?;
    require(key, last, (last - 1.0).abs() < 1e-6, "1 last: the tip")?;
    let rises = |pair: &&[f64]| pair[1] - pair[0] > 1e-6;
    if let Some(pair) = stations.windows(2).find(|pair| !rises(pair)) {
        require(key, pair[1], false, "numbers that rise from root to tip")?;
    }
    Ok(())
}
