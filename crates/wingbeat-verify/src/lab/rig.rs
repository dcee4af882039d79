//! Flat wings that a rig moves in a stream: x along it, y to the right, z up.
//!
//! The setting is that of all insects ([`AirOptions::insect`], wakes kept 0.1 chords off the wings) and the
//! same for all experiments: forces on segments, algebraic cores, wakes from trailing edges and tips, so with
//! the suction of attached leading edges; with leading-edge vorticity these hold some suction and shed what is
//! beyond it: thin ones as insects' do, round ones somewhat more, whose force acts, the more the rounder they
//! are. Which they are is what the experiments' descriptions say.

use wingbeat_air::{
    AirError, AirSettings, Friction, JoinedEdge, Lattice, LeadingEdge, MirrorPairs, NodeMotion,
    Plane, SectionDrag, SheddingKinds, Surface, VortexLift,
};
use wingbeat_flight::AirOptions;
use wingbeat_math::{DMat3, DVec3, mirrored};

use super::fly;

/// What becomes of leading edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Edge {
    /// The flow stays attached: all of their suction acts.
    Attached,
    /// No vorticity leaves them; what they do not hold is the lift of a vortex.
    VortexLift,
    /// They shed what they do not hold, found together with the circulations, as in the insect presets.
    Sheds,
}

impl Edge {
    pub const ALL: [Self; 3] = [Self::Attached, Self::VortexLift, Self::Sheds];

    pub fn name(self) -> &'static str {
        match self {
            Self::Attached => "attached",
            Self::VortexLift => "vortex lift",
            Self::Sheds => "leading-edge vorticity",
        }
    }
}

/// Form of a leading edge, which decides what suction it holds and how much of its force acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Nose {
    /// What insects' wings hold, and none of its force.
    Thin,
    /// Round edge of a plate: [`SD7003`], within what such plates hold, and all of its force.
    Blunt,
    /// Nose of an aerofoil with this radius over the chord. Near it the flow is that around a parabola, and
    /// whether it separates there is decided by the suction parameter over the root of the radius, and little
    /// by the Reynolds number [Rusak & Morris 2005, AIAA 2005-86]: that of SD7003, scaled; all of its force.
    Aerofoil(f64),
}

/// Critical suction parameter of the section SD7003 at a Reynolds number of 3e4 [Ramesh et al. 2014, J. Fluid
/// Mech. 751:500], and the radius of its nose over the chord, of the parabola through its foremost coordinates.
const SD7003: [f64; 2] = [0.18, 0.008];

impl Nose {
    /// Suction parameter held, and part of its force that acts; `thin` are those of thin edges.
    fn suction(self, thin: [f64; 2]) -> [f64; 2] {
        let [held, of] = SD7003;
        match self {
            Self::Thin => thin,
            Self::Blunt => [held, 1.0],
            Self::Aerofoil(radius) => [held * (radius / of).sqrt(), 1.0],
        }
    }
}

/// The fluid and the size of what it meets.
pub(crate) struct Fluid {
    pub density: f64,
    pub viscosity: f64,
    pub stream: DVec3,
    pub chord: f64,
    /// Profile drag beside the friction.
    pub drag: SectionDrag,
    /// How far from the wing its wake is kept; none: all of it.
    pub kept: Option<f64>,
}

impl Fluid {
    /// Chord, speed of the stream and density 1; friction of a laminar plate.
    pub fn unit(reynolds: f64) -> Self {
        Self {
            density: 1.0,
            viscosity: 1.0 / reynolds,
            stream: DVec3::X,
            chord: 1.0,
            drag: laminar(1.0 / reynolds),
            kept: None,
        }
    }

    fn settings(&self, edge: Edge, wing: &Wing) -> AirSettings {
        let insect = AirOptions::insect(self.density, self.viscosity, self.chord).lattice;
        let thin = insect.leading.suction().expect("insects' edges hold some");
        let [threshold, efficiency] = wing.nose.suction(thin);
        AirSettings {
            free_stream: self.stream,
            shedding: SheddingKinds {
                leading: edge != Edge::Attached,
                root: wing.free_root,
                tip: !wing.plane,
                ..insect.shedding
            },
            leading: match edge {
                Edge::VortexLift => LeadingEdge::VortexLift(VortexLift {
                    threshold,
                    efficiency,
                    ..VortexLift::default()
                }),
                _ => LeadingEdge::SuctionImplicit {
                    threshold,
                    efficiency,
                },
            },
            clearance: 0.1 * self.chord,
            // Filaments that run straight across plane flow have no length to resolve.
            wake_overlap: if wing.plane { 0.0 } else { insect.wake_overlap },
            plane_wakes: wing.plane,
            section_drag: Some(self.drag),
            max_distance: self.kept,
            ..insect
        }
    }
}

/// Friction of a laminar plate in a fluid of this viscosity [m2/s], no profile drag.
pub(crate) fn laminar(viscosity: f64) -> SectionDrag {
    SectionDrag {
        friction: Friction::Blasius { viscosity },
        cd0: 0.0,
        cd2: 0.0,
    }
}

/// A wing in the frame of the rig.
pub(crate) struct Wing {
    /// Rows from the leading edge, each from the root to the tip.
    pub nodes: Vec<DVec3>,
    pub mesh: [usize; 2],
    /// Whether its mirror image follows beyond the plane y = 0, where its root lies.
    pub joined: bool,
    /// Whether its mirror image flies beyond that plane, apart from it.
    pub paired: bool,
    /// Whether the root is an edge that sheds.
    pub free_root: bool,
    pub nose: Nose,
    /// Whether the flow is plane: one panel along a long span, whose ends do not shed and whose wakes stay straight.
    pub plane: bool,
    /// Columns from the root on whose force is measured.
    pub measured: usize,
}

impl Wing {
    /// A rectangle of chord 1 between these span positions, its axis of pitch this part of the chord behind the
    /// leading edge, which is thin; all of it is measured. A root that is not joined is free.
    pub fn rectangle(rows: usize, stations: &[f64], axis: f64, joined: bool) -> Self {
        let cols = stations.len() - 1;
        let row = |i: usize| {
            let x = i as f64 / rows as f64 - axis;
            stations.iter().map(move |y| DVec3::new(x, *y, 0.0))
        };
        Self {
            nodes: (0..=rows).flat_map(row).collect(),
            mesh: [rows, cols],
            joined,
            paired: false,
            free_root: !joined,
            nose: Nose::Thin,
            plane: false,
            measured: cols,
        }
    }

    /// A section of plane flow, of chord 1, its axis of pitch this part of the chord behind the leading edge,
    /// which is thin: one panel along this span.
    pub fn section(rows: usize, span: f64, axis: f64) -> Self {
        Self {
            free_root: false,
            plane: true,
            ..Self::rectangle(rows, &[-0.5 * span, 0.5 * span], axis, false)
        }
    }

    fn has_image(&self) -> bool {
        self.joined || self.paired
    }

    /// # Errors
    /// As the lattice's.
    pub fn lattice(&self, settings: AirSettings) -> Result<Lattice, AirError> {
        let [rows, cols] = self.mesh;
        let wing = Surface::grid("right", rows, cols);
        if !self.has_image() {
            return Lattice::new(vec![wing], settings);
        }
        let mut left = Surface::grid("left", rows, cols);
        left.panels.iter_mut().for_each(|c| c.reverse()); // both normals point up
        let root = JoinedEdge {
            surfaces: [0, 1],
            nodes: (0..=rows).map(|i| [i * (cols + 1); 2]).collect(),
        };
        let joined = if self.joined { vec![root] } else { vec![] };
        let other = |n: usize| (0..2 * n).map(|k| (k + n) % (2 * n)).collect();
        let pairs = MirrorPairs {
            plane: Plane {
                point: DVec3::ZERO,
                normal: DVec3::Y,
            },
            node: other(self.nodes.len()),
            panel: other(rows * cols),
        };
        Lattice::joined(vec![wing, left], &joined, settings)?.with_mirror_symmetry(pairs)
    }

    /// Its nodes in this pose, its mirror image last.
    pub fn moved(&self, pose: &Pose) -> NodeMotion {
        let arm = |x: &DVec3| pose.turn * *x;
        let mut motion = NodeMotion {
            position: self.nodes.iter().map(|x| pose.shift + arm(x)).collect(),
            velocity: (self.nodes.iter())
                .map(|x| pose.velocity + pose.spin.cross(arm(x)))
                .collect(),
        };
        if self.has_image() {
            for list in [&mut motion.position, &mut motion.velocity] {
                let image: Vec<DVec3> = list.iter().copied().map(mirrored).collect();
                list.extend(image);
            }
        }
        motion
    }
}

/// Place and motion of the rig's frame.
#[derive(Clone, Copy)]
pub(crate) struct Pose {
    pub turn: DMat3,
    /// Angular velocity [rad/s].
    pub spin: DVec3,
    pub shift: DVec3,
    pub velocity: DVec3,
}

/// Force on the measured columns of the right wing [N], step by step from time `start` on.
pub(crate) fn forces(
    fluid: &Fluid,
    wing: &Wing,
    edge: Edge,
    pose: impl Fn(f64) -> Pose,
    [start, dt]: [f64; 2],
    last: usize,
) -> Result<Vec<DVec3>, AirError> {
    let lattice = wing.lattice(fluid.settings(edge, wing))?;
    let [rows, cols] = wing.mesh;
    let measured: Vec<usize> = (0..rows * cols)
        .filter(|p| p % cols < wing.measured)
        .collect();
    let mut force = Vec::with_capacity(last + 1);
    let motion = |t: f64| wing.moved(&pose(start + t));
    fly(&lattice, motion, dt, last, |_, _, loads, _| {
        force.push(measured.iter().map(|&p| loads.force[p]).sum());
    })?;
    Ok(force)
}
