//! Veins of a wing of sheet: beams on the nodes of its mesh.

use std::f64::consts::PI;

use wingbeat_math::DVec3;
use wingbeat_structure::{Beam, BeamSection, Configuration, ShellMesh, Stiffness, StructureError};

use crate::deformation::{behind, column, span};
use crate::error::{MemberError, ModelError, require};
use crate::mesh::GridMesh;

/// Radii of veins, from a nanometre on: powers of both make their stiffnesses \[m\].
const THINNEST: f64 = 1e-9;
const THICKEST: f64 = 1.0;

/// A vein, spar or batten: a round beam joined to the nodes of the mesh nearest to a straight line over the
/// wing, along lines of the mesh and diagonals of its panels. Pairs are values at its two ends, linear between.
#[derive(Clone, Debug, PartialEq)]
pub struct Vein {
    /// Where it begins: r/R, and place behind the leading edge over the chord \[1\].
    pub from: [f64; 2],
    /// Where it ends, likewise \[1\].
    pub to: [f64; 2],
    /// Radius \[m\]: what stretches and shears, `EA = 4 EI / r^2`, and the inertia of its sections follow from it.
    pub radius: [f64; 2],
    /// What it is made of.
    pub stiffness: VeinStiffness,
    /// Density \[kg/m3\]; none: its mass is part of that of the sheet.
    pub density: Option<f64>,
    /// Whether its beginning is clamped to the wing frame.
    pub is_clamped: bool,
}

/// Stiffness of a vein.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VeinStiffness {
    /// A solid round bar.
    Solid {
        /// Young's modulus \[Pa\].
        young: f64,
        /// Shear modulus \[Pa\]; none is that of a Poisson's ratio of 0.3.
        shear: Option<f64>,
    },
    /// By its own numbers: a tube, a pleat, a flat bar.
    Given {
        /// EI \[N m2\], the same in all directions.
        bending: [f64; 2],
        /// GJ \[N m2\].
        torsion: [f64; 2],
    },
}

/// Shear over Young's modulus at a Poisson's ratio of 0.3 \[1\].
const SHEAR: f64 = 1.0 / 2.6;
/// Shear correction of a round section \[1\] [Cowper 1966].
const ROUND: f64 = 0.9;

fn between([a, b]: [f64; 2], s: f64) -> f64 {
    a + (b - a) * s
}

impl Vein {
    /// Its section at the part `s` of its length.
    fn section(&self, s: f64) -> BeamSection {
        let r = between(self.radius, s);
        let second = 0.25 * PI * r.powi(4);
        let [bending, torsion, ratio] = match self.stiffness {
            VeinStiffness::Solid { young, shear } => [
                young * second,
                shear.unwrap_or(SHEAR * young) * 2.0 * second,
                shear.map_or(SHEAR, |shear| shear / young),
            ],
            VeinStiffness::Given { bending, torsion } => {
                [between(bending, s), between(torsion, s), SHEAR]
            }
        };
        let axial = 4.0 * bending / (r * r);
        let stiffness = Stiffness {
            axial,
            shear: [ROUND * ratio * axial; 2],
            torsion,
            bending: [bending; 2],
        };
        let mass = self.density.unwrap_or(0.0) * PI * r * r;
        BeamSection::new(&stiffness).with_mass(mass, [0.0; 2], [0.25 * mass * r * r; 2])
    }

    /// Points of the mesh it runs through, each a node of the structure once.
    fn path(&self, grid: &GridMesh, mesh: &ShellMesh) -> Vec<usize> {
        let [a, b] = [self.from, self.to].map(|end| nearest(grid, end));
        let steps = a[0].abs_diff(b[0]).max(a[1].abs_diff(b[1]));
        let on_line = |k: usize| {
            let part = k as f64 / steps.max(1) as f64;
            let [i, j] = [0, 1].map(|n| between([a[n] as f64, b[n] as f64], part).round() as usize);
            mesh.node_of[grid.node(i, j)]
        };
        let mut nodes: Vec<usize> = (0..=steps).map(on_line).collect();
        nodes.dedup();
        nodes
    }

    /// Its beams, its mass \[kg\], and the node that it clamps.
    ///
    /// # Errors
    /// A vein that this mesh has no two nodes for.
    pub(super) fn beams(
        &self,
        number: usize,
        grid: &GridMesh,
        mesh: &ShellMesh,
    ) -> Result<VeinBody, MemberError> {
        let path = self.path(grid, mesh);
        let rest = &mesh.rest;
        let lengths: Vec<f64> = path
            .windows(2)
            .map(|p| distance(rest, [p[0], p[1]]))
            .collect();
        let whole: f64 = lengths.iter().sum();
        if whole == 0.0 {
            return Err(MemberError::ShortVein { number });
        }
        let (mut before, mut mass) = (0.0, 0.0);
        let mut beams = Vec::with_capacity(lengths.len());
        for (p, length) in path.windows(2).zip(&lengths) {
            let section = self.section((before + 0.5 * length) / whole);
            beams.push(beam(rest, [p[0], p[1]], &section)?);
            mass += length * section.mass.mass;
            before += length;
        }
        let clamped = self.is_clamped.then_some(path[0]);
        Ok(VeinBody {
            nodes: path,
            beams,
            mass,
            clamped,
        })
    }

    pub(super) fn scaled(&self, s: f64) -> Self {
        let larger = |pair: [f64; 2], factor: f64| pair.map(|x| factor * x);
        let stiffness = match self.stiffness {
            VeinStiffness::Given { bending, torsion } => VeinStiffness::Given {
                bending: larger(bending, s.powi(4)),
                torsion: larger(torsion, s.powi(4)),
            },
            solid @ VeinStiffness::Solid { .. } => solid,
        };
        Self {
            radius: larger(self.radius, s),
            stiffness,
            ..*self
        }
    }

    pub(super) fn check(&self, key: &str) -> Result<(), ModelError> {
        let of = |k: &str| format!("{key}.{k}");
        let inside = |k: &str, pair: [f64; 2]| {
            let check = |x: f64| require(&of(k), x, (0.0..=1.0).contains(&x), "from 0 to 1");
            pair.into_iter().try_for_each(|x| check(x).map(drop))
        };
        inside("from", self.from)?;
        inside("to", self.to)?;
        let positive = |k: &str, x: f64| require(&of(k), x, x > 0.0, "above 0").map(drop);
        let both = |k: &str, pair: [f64; 2]| pair.into_iter().try_for_each(|x| positive(k, x));
        let is_vein = |x: f64| (THINNEST..=THICKEST).contains(&x);
        for x in self.radius {
            require(&of("radius"), x, is_vein(x), "from 1e-9 to 1 (metres)")?;
        }
        if let Some(density) = self.density {
            positive("density", density)?;
        }
        match self.stiffness {
            VeinStiffness::Solid { young, shear } => {
                positive("young", young)?;
                shear.map_or(Ok(()), |g| positive("shear", g))
            }
            VeinStiffness::Given { bending, torsion } => {
                both("bending", bending)?;
                both("torsion", torsion)
            }
        }
    }
}

/// A vein on a mesh.
pub(super) struct VeinBody {
    /// Nodes of the structure along it.
    pub nodes: Vec<usize>,
    pub beams: Vec<Beam>,
    /// Mass \[kg\].
    pub mass: f64,
    pub clamped: Option<usize>,
}

fn distance(rest: &Configuration, [a, b]: [usize; 2]) -> f64 {
    rest.position[a].distance(rest.position[b])
}

/// A beam whose section's axis 2 lies in the plane of a flat wing; sections are alike in all directions.
fn beam(
    rest: &Configuration,
    nodes: [usize; 2],
    section: &BeamSection,
) -> Result<Beam, StructureError> {
    let along = rest.position[nodes[1]] - rest.position[nodes[0]];
    Beam::straight(rest, nodes, DVec3::Z.cross(along), section)
}

/// Row and column of the node of the mesh nearest to a place: first the column, then the row in it.
fn nearest(grid: &GridMesh, [r, x]: [f64; 2]) -> [usize; 2] {
    let [_, tip] = span(grid);
    let closest = |count: usize, off: &dyn Fn(usize) -> f64| {
        (0..=count)
            .min_by(|&a, &b| off(a).total_cmp(&off(b)))
            .unwrap_or(0)
    };
    let j = closest(grid.cols, &|j| (column(grid, j).0 / tip - r).abs());
    [closest(grid.rows, &|i| (behind(grid, i, j) - x).abs()), j]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `G A` times the shear correction, G being given or that of a Poisson's ratio of 0.3.
    #[test]
    fn exact_transverse_shear_of_a_round_bar_follows_its_shear_modulus() {
        let (young, radius) = (1.2e11, 3e-4);
        for (shear, modulus) in [(Some(5e9), 5e9), (Some(1e9), 1e9), (None, young / 2.6)] {
            let vein = Vein {
                from: [0.0, 0.0],
                to: [1.0, 0.0],
                radius: [radius; 2],
                stiffness: VeinStiffness::Solid { young, shear },
                density: None,
                is_clamped: false,
            };
            let stiffness = vein.section(0.5).stiffness;
            let area = PI * radius * radius;
            let wanted = [young * area, 0.9 * modulus * area, 0.9 * modulus * area];
            for (k, wanted) in wanted.into_iter().enumerate() {
                // Rounding of a few products.
                let apart = stiffness[k][k] / wanted - 1.0;
                assert!(apart.abs() < 1e-14, "{k}: {apart}");
            }
        }
    }
}
