//! A wing that is a shell: every panel of its mesh an element, its nodes those of the mesh.

use wingbeat_math::DVec3;
use wingbeat_structure::{
    Damping, Follower, Lamina, Shell, ShellError, ShellMesh, StructureBuilder,
};

use super::body::{Blank, ElasticBody, check_positive};
use crate::deformation::{SpanLaw, column, span};
use crate::error::{MemberError, ModelError, require};
use crate::mesh::GridMesh;

/// A wing of sheet: orthotropic, its thickness a law along the span.
#[derive(Clone, Debug, PartialEq)]
pub struct WingShell {
    /// Young's modulus along the span and along the chord \[Pa\].
    pub young: [f64; 2],
    /// Poisson's ratio: contraction along the chord for tension along the span \[1\].
    pub poisson: f64,
    /// Shear modulus \[Pa\]; none is that of a sheet alike in all directions.
    pub shear: Option<f64>,
    /// Thickness \[m\], over r/R.
    pub thickness: SpanLaw,
    /// Density \[kg/m3\]; none spreads the mass of the wing evenly over its area.
    pub density: Option<f64>,
    /// Whether the root is clamped to the wing frame.
    pub clamps_root: bool,
    /// Part of the chord behind the leading edge that is rigid with the wing frame, all along the span \[1\].
    pub rigid_fraction: f64,
}

/// How much of the chord a node may lie beyond the rigid part and still belong to it: rounding.
const ROUNDING: f64 = 1e-9;

/// Density of cuticle \[kg/m3\] [Vincent & Wegst 2004, Arthropod Struct. Dev. 33:187].
const CUTICLE: f64 = 1200.0;

impl WingShell {
    /// A sheet with the bending stiffness of insects' wings, EI along the span `10^0.08 R^2.97`, along the chord
    /// `10^-1.73 c^2.08` (R the wing length, c the mean chord; N m2, m) [Combes & Daniel 2003, J. Exp. Biol. 206:2979], as
    /// thick as cuticle of the wing's mass is; its shear modulus is the mean of both directions'. For a wing of this `length`
    /// \[m\], `area` \[m2\] and `mass` \[kg\].
    pub fn combes_daniel([length, area, mass]: [f64; 3], poisson: f64) -> Self {
        let chord = area / length;
        let thickness = mass / (CUTICLE * area);
        let along = 10f64.powf(2.97 * length.log10() + 0.08) / chord;
        let across = 10f64.powf(2.08 * chord.log10() - 1.73) / length;
        // EI per width is E h3 / 12.
        let young = [along, across].map(|d| 12.0 * d / thickness.powi(3));
        Self {
            young,
            poisson,
            shear: Some((young[0] * young[1]).sqrt() / (2.0 * (1.0 + poisson))),
            thickness: SpanLaw::constant(thickness),
            density: None,
            clamps_root: true,
            rigid_fraction: 0.0,
        }
    }

    pub(super) fn body(
        &self,
        wing: &Blank<'_>,
        damping: Damping,
    ) -> Result<ElasticBody, MemberError> {
        let grid = wing.mesh;
        let mesh = ShellMesh::grid(&grid.nodes, grid.rows, grid.cols)?;
        let mut area = 0.0;
        for k in 0..mesh.panels.len() {
            area += self.panel(&mesh, grid, k, 0.0)?.map_or(0.0, |s| s.area());
        }
        let mut builder = StructureBuilder::new(mesh.rest.clone()).damping(damping);
        for k in 0..mesh.panels.len() {
            if let Some(shell) = self.panel(&mesh, grid, k, wing.mass / area)? {
                builder = builder.element(shell);
            }
        }
        for (p, &n) in mesh.node_of.iter().enumerate() {
            if self.is_held(grid, p) {
                builder = builder.clamp(n);
            }
        }
        let follower = |(x, &n): (&DVec3, &usize)| Follower::new(*x, &[(n, 1.0)], &mesh.rest);
        let followers = grid.nodes.iter().zip(&mesh.node_of).map(follower).collect();
        Ok(ElasticBody {
            structure: builder.build()?,
            followers,
        })
    }

    /// The element of panel `k`, none where it has no area; `even` is the mass of the wing over its area \[kg/m2\].
    fn panel(
        &self,
        mesh: &ShellMesh,
        grid: &GridMesh,
        k: usize,
        even: f64,
    ) -> Result<Option<Shell>, ShellError> {
        let Some(nodes) = mesh.panels[k] else {
            return Ok(None);
        };
        let [root, tip] = span(grid);
        let j = k % grid.cols;
        let r = 0.5 * (column(grid, j).0 + column(grid, j + 1).0);
        let [along, across] = self.young;
        let alike = along / (2.0 * (1.0 + self.poisson));
        let lamina = Lamina {
            young: [along, across],
            poisson: self.poisson,
            shear: self.shear.unwrap_or(alike),
            thickness: self.thickness.at(r / tip, root / tip),
            density: self.density.unwrap_or(0.0),
            added_mass: if self.density.is_some() { 0.0 } else { even },
            axis: DVec3::Y,
            prestress: [0.0; 3],
        };
        let mut section = lamina.section()?;
        // Of mass that has no density the inertia is that of the sheet's thickness.
        section.rotary_inertia = section.area_density * lamina.thickness.powi(2) / 12.0;
        Shell::new(&mesh.rest, nodes, &section).map(Some)
    }

    /// Whether node `p` of the mesh is rigid with the wing frame.
    fn is_held(&self, grid: &GridMesh, p: usize) -> bool {
        let j = p % (grid.cols + 1);
        let (_, lead, chord) = column(grid, j);
        let behind = (lead - grid.nodes[p].x) / chord;
        let rigid = self.rigid_fraction > 0.0 && behind <= self.rigid_fraction + ROUNDING;
        rigid || (self.clamps_root && j == 0)
    }

    pub(super) fn scaled(&self, s: f64) -> Self {
        Self {
            thickness: self.thickness.scaled(s),
            ..self.clone()
        }
    }

    pub(super) fn check(&self, key: &str, root: f64) -> Result<(), ModelError> {
        let of = |k: &str| format!("{key}.{k}");
        let part = self.rigid_fraction;
        require(
            &of("rigid_fraction"),
            part,
            (0.0..1.0).contains(&part),
            "from 0 to below 1",
        )?;
        let held = self.clamps_root || part > 0.0;
        let allowed = "above 0 where the root is not clamped: something must hold the wing";
        require(&of("rigid_fraction"), part, held, allowed)?;
        let positive = [
            ("young", Some(self.young[0])),
            ("young", Some(self.young[1])),
            ("shear", self.shear),
            ("density", self.density),
        ];
        for (k, x) in positive {
            if let Some(x) = x {
                require(&of(k), x, x > 0.0, "above 0")?;
            }
        }
        self.thickness.check(&of("thickness"), root)?;
        check_positive(&of("thickness"), &self.thickness, root)
    }
}
