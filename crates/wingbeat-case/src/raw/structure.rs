//! `[wing.NAME.structure]`: what a wing is made of, where loads bend it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;

/// An elastic wing, clamped to the wing frame at its root: its shape follows from inertia and loads.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StructureCase {
    /// Whether this wing is rigid though its counterpart on the other side is elastic; nothing else then stands here.
    ///
    /// Change it to true for the wing of a pair that does not bend.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub rigid: bool,
    /// A beam along the span with rigid sections across it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beam: Option<BeamCase>,
    /// A shell: every panel of the mesh is a sheet that bends and stretches.
    #[schemars(extend("or" = "beam"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shell: Option<ShellCase>,
    /// Veins, spars and battens of a shell: beams on the nodes of its mesh.
    #[schemars(extend("with" = "shell"))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub vein: Vec<VeinCase>,
    /// Regions of a shell that are made of something else; of those that overlap the last counts.
    #[schemars(extend("with" = "shell"))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub region: Vec<RegionCase>,
    /// Time by which rates of strain add to strains (Kelvin and Voigt): the damping ratio of a mode is half
    /// this times its angular frequency. In shells bending alone is damped, not stretching. It belongs to the
    /// material: `animal.scale` leaves it.
    ///
    /// Change it to the damping that was measured.
    #[schemars(range(min = 0))]
    pub damping_s: f64,
    /// Rate by which momentum relative to the wing frame decays: the damping ratio of a mode is half this over
    /// its angular frequency. `animal.scale` leaves it.
    ///
    /// Change it where damping does not grow with frequency.
    #[schemars(range(min = 0))]
    pub mass_damping_per_s: f64,
    /// Part of its amplitude that a motion of the highest frequencies keeps in a step; motions that steps resolve keep
    /// theirs.
    ///
    /// Change it to 1 to keep all energy, to less where what steps do not resolve disturbs.
    #[default = 0.8]
    #[schemars(range(min = 0, max = 1))]
    pub spectral_radius: f64,
}

/// A beam along the span; stiffness by its values at root and tip of the surface, linear between, or by tables.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BeamCase {
    /// Position of the elastic axis behind the leading edge over the chord.
    ///
    /// Change it to what was measured.
    #[default = 0.25]
    #[schemars(range(min = 0, max = 1))]
    pub axis_fraction: f64,
    /// Elements along the span, all of one length. Left out: 10.
    ///
    /// Change it to see what depends on it.
    #[schemars(range(min = 1, max = 400), extend("or" = "stations"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements: Option<usize>,
    /// Nodes of the beam, r/R from the root of the surface (`root_offset_m` over the length from the hinge to the tip)
    /// to the tip (1), where elements have lengths of their own.
    ///
    /// Change it for tables of stiffness by element.
    #[schemars(length(min = 2, max = 401))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stations: Option<Vec<f64>>,
    /// EI against bending out of the plane of the wing at root and tip.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flap_newton_m2: Option<[f64; 2]>,
    /// The same as rows [r/R, EI] from the root (or the hinge, 0) to the tip (1).
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "flap_newton_m2"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flap_table_newton_m2: Option<Vec<[f64; 2]>>,
    /// EI against bending in the plane of the wing at root and tip. Left out: a hundred times that out of the
    /// plane, and where `axial_newton` is left out, too, the shear of a solid plate as stiff in its plane.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lag_newton_m2: Option<[f64; 2]>,
    /// The same as rows [r/R, EI].
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "lag_newton_m2"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lag_table_newton_m2: Option<Vec<[f64; 2]>>,
    /// GJ against twist at root and tip.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torsion_newton_m2: Option<[f64; 2]>,
    /// The same as rows [r/R, GJ].
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "torsion_newton_m2"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torsion_table_newton_m2: Option<Vec<[f64; 2]>>,
    /// EA against stretch at root and tip. Left out: that of a plate as stiff in its plane, of one a hundred
    /// times as stiff there as out of it at least.
    ///
    /// Change it where the beam is coupled to stretch, or built of parts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial_newton: Option<[f64; 2]>,
    /// The same as rows [r/R, EA].
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "axial_newton"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial_table_newton: Option<Vec<[f64; 2]>>,
    /// GA against transverse shear, times the shear correction, at root and tip; along the chord and across it
    /// (Timoshenko). Left out where `lag_newton_m2` or `axial_newton` is given: so large that shear changes
    /// nothing (Euler and Bernoulli).
    ///
    /// Change it for sandwiches and short beams, where shear counts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_newton: Option<[f64; 2]>,
    /// The same as rows [r/R, GA].
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "shear_newton"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_table_newton: Option<Vec<[f64; 2]>>,
    /// Stiffness that couples stretch, twist and bending, as rows [r/R, stretch-twist, stretch-flap,
    /// stretch-lag, twist-flap, twist-lag, flap-lag]: the first three in N m, the others in N m2. Axes of the
    /// sections of a right wing: outward, to the leading edge, to the upper side; curvatures are right-handed
    /// turns about them. A left wing is the mirror image. The other keys of stiffness are the diagonal: that in
    /// the plane and that out of it about the elastic axis.
    ///
    /// Change it for composite layups, and where the tension centre is off the elastic axis.
    #[schemars(length(min = 2))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub coupling_table_newton_m_m2: Vec<[f64; 7]>,
    /// Mass per length at root and tip, instead of the mass of the wing spread evenly over its area. The length
    /// is that across the chord: of a beam swept by 30 deg a metre along the beam has 0.87 times as much, while
    /// stiffnesses are those along the beam; of a wing with dihedral it is that along the slope. 0 is allowed beside lumped masses.
    ///
    /// Change it to what was measured.
    #[schemars(extend("or" = "wing.NAME.mass_kg"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg_per_m: Option<[f64; 2]>,
    /// The same as rows [r/R, mass per length].
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "mass_kg_per_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_table_kg_per_m: Option<Vec<[f64; 2]>>,
    /// Position of the mass centre of a section behind the leading edge over the chord.
    ///
    /// Change it to what was measured: what lies ahead of the elastic axis keeps a wing from flutter.
    #[default = 0.5]
    #[schemars(range(min = 0, max = 1))]
    pub mass_fraction: f64,
    /// Moment of inertia of a section about its mass centre and the axis of the beam, per length of the span as
    /// `mass_kg_per_m`, at root and tip. Left out: that of mass spread evenly over the chord.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m: Option<[f64; 2]>,
    /// The same as rows [r/R, inertia per length].
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "inertia_kg_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_table_kg_m: Option<Vec<[f64; 2]>>,
    /// Lumped masses, each rigid with a node of the beam: the one that it lies at (within a twentieth of an
    /// element), or one of its own, which divides its element. They are part of `mass_kg` of the wing and weigh
    /// less than it in all, or they are beside `mass_kg_per_m`.
    ///
    /// Change it for stores, ballast, and models whose mass is given at nodes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mass: Vec<BeamMassCase>,
}

/// A lumped mass on the beam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BeamMassCase {
    /// Its place along the beam, r/R.
    ///
    /// Change it to where it sits.
    #[schemars(range(min = 0, max = 1))]
    pub at: f64,
    /// Its mass.
    ///
    /// Change it to what was weighed.
    #[schemars(range(min = 0))]
    pub mass_kg: f64,
    /// Its mass centre from the elastic axis in wing axes of a right wing; on a left one it is the mirror image.
    ///
    /// Change it to where it sits.
    #[serde(default)]
    pub offset_m: [f64; 3],
    /// Inertia matrix about its mass centre in wing axes of a right wing: xx, yy, zz, xy, xz, yz (elements of
    /// the matrix).
    ///
    /// Change it to that of its parts.
    #[serde(default)]
    pub inertia_about_centre_kg_m2: [f64; 6],
}

/// A rule for the stiffness of wings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ShellRule {
    /// EI of the wing along the span `10^0.08 R^2.97`, along the chord `10^-1.73 c^2.08` [Combes & Daniel 2003,
    /// J. Exp. Biol. 206:2979], spread evenly; R and c before `animal.scale`, which enlarges the wing that the
    /// rule made.
    CombesDaniel,
}

/// A sheet on the panels of the mesh, clamped to the wing frame at its root.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ShellCase {
    /// Stiffness by a rule for wings of insects, from the span and the mean chord.
    ///
    /// Change it to leave moduli and thickness to what was measured in sixteen species.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rule: Option<ShellRule>,
    /// Young's modulus, along the fibres (the span unless they are turned) if that across them is given, too.
    ///
    /// Change it to that of the material: some 3e9 for cuticle.
    #[schemars(extend("exclusiveMinimum" = 0, "or" = "rule"))]
    pub young_pa: Option<f64>,
    /// Young's modulus across the fibres, along the chord unless they are turned. Left out: that along them.
    ///
    /// Change it for sheets stiffened by fibres.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "young_pa"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young_chord_pa: Option<f64>,
    /// Poisson's ratio: contraction across the fibres (the span unless they are turned) for tension along them.
    ///
    /// Change it to that of the material.
    #[default = 0.3]
    pub poisson: f64,
    /// Shear modulus. Left out: that of a sheet alike in all directions.
    ///
    /// Change it for sheets stiffened by veins or fibres.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "young_pa"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_pa: Option<f64>,
    /// Young's modulus against stretching in the plane, alike in all directions, where those above are of
    /// bending alone. Left out: the same; with `rule` 3e9, that of cuticle.
    ///
    /// Change it for pleated and veined sheets, which bending finds many times stiffer than stretching does.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stretching_young_pa: Option<f64>,
    /// Thickness at root and tip, linear between.
    ///
    /// Change it to what was measured.
    #[schemars(extend("with" = "young_pa"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_m: Option<[f64; 2]>,
    /// The same as rows [r/R, thickness] from the root (or the hinge, 0) to the tip (1).
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "thickness_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_table_m: Option<Vec<[f64; 2]>>,
    /// Density, instead of the mass of the wing spread evenly over its area.
    ///
    /// Change it to that of the material.
    #[schemars(extend("exclusiveMinimum" = 0, "or" = "wing.NAME.mass_kg"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_kg_m3: Option<f64>,
    /// Direction of the fibres, from the span towards the leading edge.
    ///
    /// Change it for fabrics and laminates whose fibres run askew: bending then twists the wing.
    pub fibre_angle_deg: f64,
    /// Tension at rest along and across the fibres, between parts that hold it. A free edge gives way to
    /// tension across it.
    ///
    /// Change it for membranes that are stretched over a frame.
    #[schemars(inner(range(min = 0)))]
    pub prestress_newton_per_m: [f64; 2],
    /// Bending stiffness over that of a solid sheet of this thickness.
    ///
    /// Change it to less than 1 for films that bend more easily, to more for pleated sheets.
    #[default = 1.0]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bending_factor: f64,
    /// Whether the root is clamped to the wing frame. A vein along it bends nowhere: its stiffness has no effect, its
    /// mass has.
    ///
    /// Change it to false for foils that are held along their leading part alone, or by veins.
    #[default = true]
    pub clamped_root: bool,
    /// Whether its leading edge is clamped to the wing frame, all along the span. A vein along it bends nowhere
    /// and takes its mass from the sheet alone.
    ///
    /// Change it to true for sheets that hang in a stream like flags.
    pub clamped_leading_edge: bool,
    /// Whether all its edges are clamped to the wing frame, leading and trailing edge, root and tip.
    ///
    /// Change it to true for membranes on a rigid frame.
    pub clamped_perimeter: bool,
    /// Part of the chord behind the leading edge that is rigid with the wing frame, all along the span: the
    /// lines of nodes within it, so up to a panel less where it does not end on one.
    ///
    /// Change it for foils with a rigid leading part.
    #[schemars(range(min = 0), extend("exclusiveMaximum" = 1))]
    pub rigid_fraction: f64,
}

/// A vein: a round beam on the nodes of the mesh nearest to a straight line over the wing, along lines of the
/// mesh and diagonals of its panels. Pairs are values at its two ends, linear between.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct VeinCase {
    /// Where it begins: r/R, and place behind the leading edge over the chord. Left out: at the root of the
    /// leading edge.
    ///
    /// Change it for veins that begin elsewhere.
    #[schemars(inner(range(min = 0, max = 1)))]
    pub from: [f64; 2],
    /// Where it ends, likewise. Left out: at the tip of the leading edge.
    ///
    /// Change it for veins that run elsewhere.
    #[default(_code = "[1.0, 0.0]")]
    #[schemars(inner(range(min = 0, max = 1)))]
    pub to: [f64; 2],
    /// Radius [at `from`, at `to`]: of it and the modulus are bending and torsion; stretching, `EA = 4 EI / r^2`, follows from it in
    /// any case.
    ///
    /// Change it to what was measured.
    pub radius_m: Option<[f64; 2]>,
    /// Young's modulus of a solid round bar.
    ///
    /// Change it to that of the material: some 5e9 for cuticle of veins, 1e11 to 3e11 for carbon fibre.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub young_pa: Option<f64>,
    /// Shear modulus of a solid round bar. Left out: that of a Poisson's ratio of 0.3.
    ///
    /// Change it for fibre along the bar, which twists more easily.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "young_pa"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_pa: Option<f64>,
    /// EI in all directions, in place of a modulus.
    ///
    /// Change it to what was measured, or for tubes and flat bars.
    #[schemars(extend("or" = "young_pa", "with" = "torsion_newton_m2"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending_newton_m2: Option<[f64; 2]>,
    /// GJ, in place of a modulus.
    ///
    /// Change it to what was measured, or for tubes and flat bars.
    #[schemars(extend("or" = "young_pa", "with" = "bending_newton_m2"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torsion_newton_m2: Option<[f64; 2]>,
    /// Density. Left out: its mass is part of that spread over the sheet. Given, it is taken out of the mass of
    /// the wing before the rest is spread, or added to that of a sheet which has a density, too.
    ///
    /// Change it to that of the material: veins carry much of the mass of a wing.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_kg_m3: Option<f64>,
    /// Whether its beginning is clamped to the wing frame, also where the root of the sheet is not.
    ///
    /// Change it to true for spars that alone hold a wing.
    pub clamped: bool,
}

/// A part of a shell that is made of something else: panels whose middle lies in it. What is left out is as elsewhere.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RegionCase {
    /// From and to along the span, r/R.
    ///
    /// Change it to where the region lies.
    #[default(_code = "[0.0, 1.0]")]
    #[schemars(inner(range(min = 0, max = 1)))]
    pub span_range: [f64; 2],
    /// From and to behind the leading edge over the chord.
    ///
    /// Change it to where the region lies.
    #[default(_code = "[0.0, 1.0]")]
    #[schemars(inner(range(min = 0, max = 1)))]
    pub chord_range: [f64; 2],
    /// Young's modulus, along the fibres if that across them is given, too. Where the shell has
    /// `stretching_young_pa`, or `rule`, which sets it, the moduli and fibres of a region are those of bending
    /// alone.
    ///
    /// Change it to that of the material.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young_pa: Option<f64>,
    /// Young's modulus across the fibres. Left out: that along them.
    ///
    /// Change it for sheets stiffened by fibres.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "young_pa"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young_chord_pa: Option<f64>,
    /// Poisson's ratio.
    ///
    /// Change it to that of the material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson: Option<f64>,
    /// Shear modulus. Left out beside `young_pa`, or where the sheet gives none: that of a sheet alike in all directions.
    ///
    /// Change it for sheets stiffened by fibres.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_pa: Option<f64>,
    /// Thickness, even over the region.
    ///
    /// Change it to what was measured.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_m: Option<f64>,
    /// Density, of shells that have `shell.density_kg_m3`.
    ///
    /// Change it to that of the material.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_kg_m3: Option<f64>,
    /// Direction of the fibres, from the span towards the leading edge.
    ///
    /// Change it for laminates whose fibres run askew.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fibre_angle_deg: Option<f64>,
    /// Tension at rest along and across the fibres.
    ///
    /// Change it for membranes that are stretched over a frame.
    #[schemars(inner(range(min = 0)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub prestress_newton_per_m: Option<[f64; 2]>,
}
