//! A wing that is a shell: every panel of its mesh an element, its nodes those of the mesh.

use wingbeat_math::DVec3;
use wingbeat_structure::{
    Damping, Follower, Lamina, Shell, ShellError, ShellMesh, StructureBuilder,
};

use super::body::{Blank, ElasticBody, Fibres, check_poisson, check_positive, check_tension};
use super::region::{Region, fibres, middle};
use super::vein::Vein;
use crate::deformation::{SpanLaw, behind, span};
use crate::error::{MemberError, ModelError, require};
use crate::mesh::GridMesh;

/// A wing of sheet: orthotropic, its thickness a law along the span, with regions of other materials and with veins.
#[derive(Clone, Debug, PartialEq)]
pub struct WingShell {
    /// Young's modulus along the span and along the chord \[Pa\].
    pub young: [f64; 2],
    /// Poisson's ratio: contraction along the chord for tension along the span \[1\].
    pub poisson: f64,
    /// Shear modulus \[Pa\]; none is that of a sheet alike in all directions.
    pub shear: Option<f64>,
    /// Young's modulus against stretching in the plane \[Pa\], alike in all directions, where the moduli above
    /// are those of bending alone: pleats and veins stiffen bending many times more than stretching; none where
    /// they are the same.
    pub stretching: Option<f64>,
    /// Thickness \[m\], over r/R.
    pub thickness: SpanLaw,
    /// Density \[kg/m3\]; none spreads the mass of the wing evenly over its area.
    pub density: Option<f64>,
    /// Direction of the fibres, which `young` and `prestress` go along and across: from the span towards the
    /// leading edge \[rad\].
    pub fibre_angle: f64,
    /// Tension at rest along and across the fibres \[N/m\].
    pub prestress: [f64; 2],
    /// Bending stiffness over that of a solid sheet \[1\]: less for a slack film, more for a pleated one.
    pub bending_factor: f64,
    /// Regions of other materials; of those that overlap the last counts.
    pub regions: Vec<Region>,
    /// Veins.
    pub veins: Vec<Vein>,
    /// Whether the root is clamped to the wing frame.
    pub clamps_root: bool,
    /// Whether its leading edge is clamped to the wing frame, all along the span.
    pub clamps_leading_edge: bool,
    /// Whether all its edges are clamped to the wing frame: a membrane on a rigid frame.
    pub clamps_perimeter: bool,
    /// Part of the chord behind the leading edge that is rigid with the wing frame, all along the span \[1\].
    pub rigid_fraction: f64,
}

/// How much of the chord a node may lie beyond the rigid part and still belong to it: rounding.
const ROUNDING: f64 = 1e-9;

/// Density of cuticle \[kg/m3\] [Vincent & Wegst 2004, Arthropod Struct. Dev. 33:187].
const CUTICLE: f64 = 1200.0;

/// Young's modulus of cuticle of wings \[Pa\]: same source, 1e9 to 2e10.
const CUTICLE_YOUNG: f64 = 3e9;

impl WingShell {
    /// A solid sheet of one material, as stiff in bending as in stretching, clamped at the root, the wing's
    /// mass spread evenly over it: Young's modulus along span and chord \[Pa\], Poisson's ratio \[1\],
    /// thickness \[m\] over r/R.
    pub fn solid(young: [f64; 2], poisson: f64, thickness: SpanLaw) -> Self {
        Self {
            young,
            poisson,
            shear: None,
            stretching: None,
            thickness,
            density: None,
            fibre_angle: 0.0,
            prestress: [0.0; 2],
            bending_factor: 1.0,
            regions: vec![],
            veins: vec![],
            clamps_root: true,
            clamps_leading_edge: false,
            clamps_perimeter: false,
            rigid_fraction: 0.0,
        }
    }

    /// A sheet with the bending stiffness of insects' wings, EI along the span `10^0.08 R^2.97`, along the
    /// chord `10^-1.73 c^2.08` (R the wing length, c the mean chord; N m2, m) [Combes & Daniel 2003, J. Exp.
    /// Biol. 206:2979], as thick as cuticle of the wing's mass is and no stiffer than it against stretching:
    /// what pleats and veins add to bending they do not add to that. The shear modulus is the mean of both
    /// directions'. For a wing of this `length` \[m\], `area` \[m2\] and `mass` \[kg\].
    pub fn combes_daniel([length, area, mass]: [f64; 3], poisson: f64) -> Self {
        let chord = area / length;
        let thickness = mass / (CUTICLE * area);
        let along = 10f64.powf(2.97 * length.log10() + 0.08) / chord;
        let across = 10f64.powf(2.08 * chord.log10() - 1.73) / length;
        // EI per width is E h3 / 12.
        let young = [along, across].map(|d| 12.0 * d / thickness.powi(3));
        Self {
            shear: Some((young[0] * young[1]).sqrt() / (2.0 * (1.0 + poisson))),
            stretching: Some(CUTICLE_YOUNG),
            ..Self::solid(young, poisson, SpanLaw::constant(thickness))
        }
    }

    pub(super) fn body(
        &self,
        wing: &Blank<'_>,
        damping: Damping,
    ) -> Result<ElasticBody, MemberError> {
        let grid = wing.mesh;
        let mesh = ShellMesh::grid(&grid.nodes, grid.rows, grid.cols)?;
        let laminae = self.laminae(grid)?;
        let mut builder = StructureBuilder::new(mesh.rest.clone()).damping(damping);
        let mut veins = 0.0;
        for (number, vein) in self.veins.iter().enumerate() {
            let vein = vein.beams(number, grid, &mesh)?;
            veins += vein.mass;
            let held = |n: usize| {
                let nodes = mesh.node_of.iter().enumerate();
                (nodes.filter(|(_, m)| **m == n)).any(|(p, _)| self.is_held(grid, p))
            };
            if vein.mass == 0.0 && vein.nodes.iter().all(|&n| held(n)) {
                return Err(MemberError::IdleVein { number });
            }
            if vein.clamped.is_some_and(held) {
                return Err(MemberError::HeldVein { number });
            }
            builder = vein
                .beams
                .into_iter()
                .fold(builder, |b, beam| b.element(beam));
            builder = vein.clamped.into_iter().fold(builder, |b, n| b.clamp(n));
        }
        let even = self.spread(wing, &mesh, &laminae, veins)?;
        for (k, lamina) in laminae.iter().enumerate() {
            if let Some(shell) = self.panel(&mesh, k, lamina, even)? {
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
            tip: mesh.node_of[grid.node(grid.rows, grid.cols)],
        })
    }

    /// Mass over area \[kg/m2\] of what has no density of its own: the mass of the wing less that of its veins,
    /// spread evenly.
    fn spread(
        &self,
        wing: &Blank<'_>,
        mesh: &ShellMesh,
        laminae: &[Lamina],
        veins: f64,
    ) -> Result<f64, MemberError> {
        if self.density.is_some() {
            return Ok(0.0);
        }
        let left = wing.mass - veins;
        if left <= 0.0 {
            let wing = wing.mass;
            return Err(MemberError::HeavyVeins { veins, wing });
        }
        let mut area = 0.0;
        for (k, lamina) in laminae.iter().enumerate() {
            area += self.panel(mesh, k, lamina, 0.0)?.map_or(0.0, |s| s.area());
        }
        Ok(left / area)
    }

    /// What every panel of the mesh is made of.
    fn laminae(&self, grid: &GridMesh) -> Result<Vec<Lamina>, MemberError> {
        let [root, tip] = span(grid);
        let place = |k: usize| middle(grid, k, tip);
        let count = grid.rows * grid.cols;
        for (number, region) in self.regions.iter().enumerate() {
            if !(0..count).any(|k| region.holds(place(k))) {
                return Err(MemberError::EmptyRegion { number });
            }
            let later = &self.regions[number + 1..];
            let counts = |k: usize| !later.iter().any(|g| g.hides(region) && g.holds(place(k)));
            if !(0..count).any(|k| region.holds(place(k)) && counts(k)) {
                return Err(MemberError::CoveredRegion { number });
            }
            let weighs = self.density.is_some() && region.weighs();
            if !weighs && !(0..count).any(|k| region.holds(place(k)) && self.moves(grid, k)) {
                return Err(MemberError::IdleRegion { number });
            }
        }
        let lamina = |k: usize| {
            let [r, x] = place(k);
            let elsewhere = Lamina {
                young: self.young,
                poisson: self.poisson,
                shear: 0.0,
                thickness: self.thickness.at(r, root / tip),
                density: self.density.unwrap_or(0.0),
                added_mass: 0.0,
                axis: fibres(grid, k, self.fibre_angle),
                prestress: [self.prestress[0], self.prestress[1], 0.0],
            };
            let here = || self.regions.iter().filter(|g| g.holds([r, x]));
            let lamina = here().fold(elsewhere, |made, g| g.applied(grid, k, made));
            let given = here().fold(self.shear, |shear, g| g.own_shear(shear));
            let alike = lamina.young[0] / (2.0 * (1.0 + lamina.poisson));
            Lamina {
                shear: given.unwrap_or(alike),
                ..lamina
            }
        };
        Ok((0..count).map(lamina).collect())
    }

    /// The element of panel `k`, none where it has no area; `even` is the mass over area of what has no density
    /// \[kg/m2\].
    fn panel(
        &self,
        mesh: &ShellMesh,
        k: usize,
        lamina: &Lamina,
        even: f64,
    ) -> Result<Option<Shell>, ShellError> {
        let Some(nodes) = mesh.panels[k] else {
            return Ok(None);
        };
        let lamina = Lamina {
            added_mass: even,
            ..*lamina
        };
        let mut section = lamina.section()?;
        section.bending *= self.bending_factor;
        if let Some(young) = self.stretching {
            let (nu, h) = (lamina.poisson, lamina.thickness);
            section.membrane = Lamina::isotropic(young, nu, h, 0.0).section()?.membrane;
        }
        // Of mass that has no density the inertia is that of the sheet's thickness.
        section.rotary_inertia = section.area_density * lamina.thickness.powi(2) / 12.0;
        Shell::new(&mesh.rest, nodes, &section).map(Some)
    }

    /// Whether a node of panel `k` is free.
    fn moves(&self, grid: &GridMesh, k: usize) -> bool {
        let [i, j] = [k / grid.cols, k % grid.cols];
        let corners = [[0, 0], [0, 1], [1, 0], [1, 1]];
        let mut corners = corners.map(|[a, b]| grid.node(i + a, j + b)).into_iter();
        corners.any(|p| !self.is_held(grid, p))
    }

    /// Whether node `p` of the mesh is rigid with the wing frame.
    fn is_held(&self, grid: &GridMesh, p: usize) -> bool {
        let [i, j] = [p / (grid.cols + 1), p % (grid.cols + 1)];
        let rigid =
            self.rigid_fraction > 0.0 && behind(grid, i, j) <= self.rigid_fraction + ROUNDING;
        let edge = [0, grid.rows].contains(&i) || [0, grid.cols].contains(&j);
        let lead = self.clamps_leading_edge && i == 0;
        rigid || lead || (self.clamps_root && j == 0) || (self.clamps_perimeter && edge)
    }

    pub(super) fn scaled(&self, s: f64) -> Self {
        Self {
            thickness: self.thickness.scaled(s),
            prestress: self.prestress.map(|n| s * n),
            regions: self.regions.iter().map(|g| g.scaled(s)).collect(),
            veins: self.veins.iter().map(|v| v.scaled(s)).collect(),
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
        let clamps = self.clamps_root || self.clamps_leading_edge || self.clamps_perimeter;
        let held = clamps || part > 0.0 || self.veins.iter().any(|v| v.is_clamped);
        let allowed = "above 0 where neither root nor leading edge nor vein is clamped: something must hold the wing";
        require(&of("rigid_fraction"), part, held, allowed)?;
        for young in self.young {
            require(&of("young"), young, young > 0.0, "above 0")?;
        }
        check_poisson(&of("poisson"), self.poisson, self.young)?;
        let positive = [
            ("shear", self.shear),
            ("density", self.density),
            ("stretching_young", self.stretching),
            ("bending_factor", Some(self.bending_factor)),
        ];
        for (k, x) in positive {
            if let Some(x) = x {
                require(&of(k), x, x > 0.0, "above 0")?;
            }
        }
        check_tension(&of("prestress"), self.prestress)?;
        let fibres = Fibres {
            young: self.young,
            shear: self.shear,
            prestress: self.prestress,
        };
        let heirs = self.regions.iter().filter(|g| g.fibre_angle.is_none());
        let mut heirs = heirs.map(|g| g.fibres(fibres));
        let all = heirs.find(Fibres::count).unwrap_or(fibres);
        all.check(&of("fibre_angle"), self.fibre_angle)?;
        self.thickness.check(&of("thickness"), root)?;
        check_positive(&of("thickness"), &self.thickness, root)?;
        let weighed = self.density.is_some();
        (self.regions.iter().enumerate())
            .try_for_each(|(k, g)| g.check(&region_key(key, k), weighed, fibres))?;
        (self.veins.iter().enumerate()).try_for_each(|(k, v)| v.check(&vein_key(key, k)))
    }
}

/// The key of region or vein `k` of the sheet at `shell`.
fn region_key(shell: &str, k: usize) -> String {
    format!("{}.region[{k}]", shell.trim_end_matches(".shell"))
}

fn vein_key(shell: &str, k: usize) -> String {
    format!("{}.vein[{k}]", shell.trim_end_matches(".shell"))
}
