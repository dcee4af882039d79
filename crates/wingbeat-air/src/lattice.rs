//! The lattice: surfaces, topology and settings, checked once and constant after that.

use crate::edges::EdgeKind;
use crate::error::{AirError, require};
use crate::geometry::{
    Carried, Controls, JoinedEdge, MirrorPairs, Rings, ShedAround, Sheet, Strip, SuctionStrips,
    Surface, Symmetry, Topology, WakeColumn, borders, carried, joined_groups, middle_columns,
    rings, shed_around, spanwise, strips,
};
use crate::images::{Mirror, Plane, mirrors};
use crate::settings::AirSettings;
use std::ops::Range;
use std::sync::Arc;
use wingbeat_math::{DVec3, largest};

/// How far behind a plane a node may be that touches it, over the distance of the farthest one: far above round-off.
const TOUCHING: f64 = 1e-7;

/// How far off its plane an edge on a plane of images may be, in panel sizes: as joined nodes may be apart.
const ON_PLANE: f64 = 1e-6;

/// Vortex rings on the panels of any number of surfaces, with their wakes' roots.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    surfaces: Vec<Surface>,
    settings: AirSettings,
    topology: Topology,
    strips: Vec<Strip>,
    rings: Rings,
    controls: Controls,
    mirrors: Vec<Mirror>,
    symmetry: Option<Symmetry>,
    suction: SuctionStrips,
    joined: Vec<usize>,
    /// Sides of panels that no other panel shares.
    borders: Vec<[bool; 4]>,
    shed_around: Vec<ShedAround>,
    /// Panels within bodies, and the column of nodes in the middle of those wake sheets that leave them.
    carried: Vec<Carried>,
    middle_columns: Vec<Option<usize>>,
    /// The strip that a panel leads.
    led: Vec<Option<usize>>,
    /// Whether each edge runs along the span of a strip.
    spanwise: Vec<bool>,
    identity: Identity,
}

/// Tells lattices apart, so that what is computed once for a lattice is known to be for this one; clones share it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Identity(Arc<()>);

impl Identity {
    /// Whether this is the identity of the same lattice or of a clone.
    pub(crate) fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// No part of what a lattice is: equal lattices may have different identities.
impl PartialEq for Identity {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Lattice {
    /// Builds the lattice of the given surfaces.
    ///
    /// # Errors
    /// [`AirError`] names the first panel, edge, shedding segment or setting that is wrong.
    pub fn new(surfaces: Vec<Surface>, settings: AirSettings) -> Result<Self, AirError> {
        Self::joined(surfaces, &[], settings)
    }

    /// Builds the lattice of surfaces some of which share edges.
    ///
    /// # Errors
    /// As [`Self::new`]; joined edges that fit nowhere.
    pub fn joined(
        surfaces: Vec<Surface>,
        joined: &[JoinedEdge],
        settings: AirSettings,
    ) -> Result<Self, AirError> {
        settings.validate()?;
        let mut settings = settings;
        settings.shedding.leading = settings.leading_edges_shed();
        let mut topology = Topology::new(&surfaces, joined, settings.shedding)?;
        if let Some(edge) = joined.iter().position(JoinedEdge::is_on_plane)
            && settings.images.is_empty()
        {
            let problem = "there is no plane of images on which it could lie";
            return Err(AirError::JoinedEdge { edge, problem });
        }
        require(
            !settings.plane_wakes || topology.sheets.iter().all(|s| s.panels.len() == 1),
            "plane_wakes",
            settings.plane_wakes,
            "true only for wings of one panel along the span (mesh.spanwise = 1), whose flow is that of a section",
        )?;
        if settings.plane_wakes {
            topology.mark_ends(&surfaces);
        }
        let mut strips = strips(&topology, &surfaces);
        let rings = rings(&topology, &surfaces, &strips, &settings);
        let controls = Controls::new(&topology, &surfaces, &strips, &settings);
        // What goes on through a body has no leading edge of its own.
        strips.retain(|s| !surfaces[topology.panel_surface[s.panels[0]]].carry_through);
        let joined = joined_groups(&topology, surfaces.len());
        let mut led = vec![None; topology.panels.len()];
        for (s, strip) in strips.iter().enumerate() {
            led[strip.panels[0]] = Some(s);
        }
        let spanwise = spanwise(&topology, &strips);
        Ok(Self {
            rings,
            controls,
            carried: carried(&topology, &surfaces)?,
            middle_columns: middle_columns(&topology, &surfaces),
            strips,
            shed_around: shed_around(&topology, &surfaces, &joined),
            borders: borders(&topology, &surfaces),
            joined,
            led,
            spanwise,
            mirrors: mirrors(&settings.images)?,
            surfaces,
            settings,
            topology,
            symmetry: None,
            suction: SuctionStrips::default(),
            identity: Identity::default(),
        }
        .with_suction_strips())
    }

    /// The same lattice for motions that are mirror-symmetric: computed on one half.
    ///
    /// # Errors
    /// [`AirError::MirrorPairs`] names the first node, panel or wake sheet whose image does not fit,
    /// [`AirError::AsymmetricAir`] the part of the undisturbed air that is no mirror image of itself.
    pub fn with_mirror_symmetry(mut self, pairs: MirrorPairs) -> Result<Self, AirError> {
        let symmetry = Symmetry::new(pairs, &self.topology)?;
        if let Some(what) = self.settings.asymmetric_part(&symmetry.mirror) {
            return Err(AirError::AsymmetricAir { what });
        }
        self.symmetry = Some(symmetry);
        self.identity = Identity::default();
        Ok(self.with_suction_strips())
    }

    /// Checks that all surfaces lie on that side of each plane of symmetry or ground on which they were
    /// `before`.
    ///
    /// # Errors
    /// [`AirError::ThroughPlane`] names the node that is farthest behind one of them.
    pub(crate) fn check_sides(
        &self,
        [before, position]: [&[DVec3]; 2],
        step: u64,
    ) -> Result<(), AirError> {
        for plane in &self.settings.images {
            let heights = || position.iter().map(|x| plane.height(*x));
            let most = |sign: f64| largest(heights().map(|h| sign * h));
            let side = plane.side(before);
            let [far, depth] = [side, -side].map(most);
            if depth <= TOUCHING * far {
                continue;
            }
            let node = heights()
                .position(|h| h.is_nan() || -side * h == depth)
                .unwrap_or(0);
            let (surface, node) = self.topology.locate_node(node);
            return Err(AirError::ThroughPlane {
                step,
                surface,
                node,
                depth,
            });
        }
        Ok(())
    }

    /// The plane of images nearest to `x` [m], N components.
    pub(crate) fn nearest_plane(&self, x: DVec3) -> Option<&Plane> {
        let far = |p: &&Plane| p.height(x).abs();
        (self.settings.images.iter()).min_by(|a, b| far(a).total_cmp(&far(b)))
    }

    /// The point about which the impulse of filaments is summed [m], N components: `x`, or where edges lie on planes of
    /// images its foot on these. Filaments end there, at their images: what the sum over one side lacks of closed rings
    /// lies along the normal if it is taken about a point of the plane, and else along the plane, too. Particles do not
    /// close anyway.
    pub(crate) fn impulse_point(&self, x: DVec3) -> DVec3 {
        let is_open = !self.topology.plane_lines.is_empty() && self.settings.particles.is_none();
        let planes = self.settings.images.iter().filter(|_| is_open);
        planes.fold(x, |x, plane| plane.foot(x))
    }

    /// Part of circulation x moment of a filament of open surfaces and their wakes that is its impulse \[1\]: half. In
    /// plane flow all of filaments along the span, for what closes their rings at the ends of the section has the other
    /// half.
    pub(crate) fn impulse_part(&self) -> f64 {
        if self.settings.plane_wakes { 1.0 } else { 0.5 }
    }

    /// Checks that edges on planes of images are there, panels having this mean `size` [m].
    ///
    /// # Errors
    /// [`AirError::OffPlane`] names the first node that is not.
    pub(crate) fn check_on_planes(
        &self,
        position: &[DVec3],
        size: f64,
        step: u64,
    ) -> Result<(), AirError> {
        for line in &self.topology.plane_lines {
            let Some(plane) = self.nearest_plane(position[line[0]]) else {
                continue;
            };
            let off = |n: &&usize| plane.height(position[**n]).abs() > ON_PLANE * size;
            if let Some(&n) = line.iter().find(off) {
                let (surface, node) = self.topology.locate_node(n);
                return Err(AirError::OffPlane {
                    step,
                    surface,
                    node,
                    distance: plane.height(position[n]).abs(),
                });
            }
        }
        Ok(())
    }

    /// The mirror symmetry of the flow, if only one half is computed.
    pub(crate) fn symmetry(&self) -> Option<&Symmetry> {
        self.symmetry.as_ref()
    }

    pub(crate) fn identity(&self) -> &Identity {
        &self.identity
    }

    /// Strips of panels behind the leading edges, in the order of [`crate::AirState::leading`].
    pub(crate) fn strips(&self) -> &[Strip] {
        &self.strips
    }

    /// Strips whose leading edges hold suction and shed what is beyond it.
    pub(crate) fn suction(&self) -> &SuctionStrips {
        &self.suction
    }

    /// For each surface the first of those that it is joined to.
    pub(crate) fn joined_groups(&self) -> &[usize] {
        &self.joined
    }

    /// Which sides of each panel no other panel shares, see [`borders`].
    pub(crate) fn borders(&self) -> &[[bool; 4]] {
        &self.borders
    }

    /// The strip that begins with panel `p`, if one does.
    pub(crate) fn led_by(&self, p: usize) -> Option<usize> {
        self.led[p]
    }

    /// Whether edge `e` runs along the span of a strip, from side to side.
    pub(crate) fn is_spanwise(&self, e: usize) -> bool {
        self.spanwise[e]
    }

    /// Panels within bodies, which carry circulation from root to root.
    pub(crate) fn carried(&self) -> &[Carried] {
        &self.carried
    }

    /// What leaves the wings on both sides of the edge that a column of wake sheet `k` leaves, if that is
    /// within a body.
    pub(crate) fn leaving_beside(&self, k: usize, column: usize) -> Option<[WakeColumn; 2]> {
        self.middle_column(k)?;
        let root = &self.sheets()[k];
        let here = |c: &&Carried| c.panel == root.panels[column];
        let carried = self.carried.iter().find(here)?;
        carried.leaving(root.kinds[column])
    }

    /// Whether a column of wake sheet `k` leaves the front edge of a strip within a body.
    pub(crate) fn leads_within(&self, k: usize, column: usize) -> bool {
        self.middle_column(k).is_some() && self.sheets()[k].kinds[column] == EdgeKind::Leading
    }

    /// The column of nodes of wake sheet `k` that left the middle of a body, if one did.
    pub(crate) fn middle_column(&self, k: usize) -> Option<usize> {
        self.middle_columns[k]
    }

    /// Wings that shed from all their edges.
    pub(crate) fn shed_around(&self) -> &[ShedAround] {
        &self.shed_around
    }

    fn with_suction_strips(mut self) -> Self {
        let symmetry = self.symmetry.as_ref();
        let is_within = |s: &Sheet| self.surfaces[s.surface].carry_through;
        self.suction = match self.settings.solves_suction() {
            true => SuctionStrips::new(&self.topology, &self.strips, symmetry, is_within),
            false => SuctionStrips::none(self.strips.len()),
        };
        self
    }

    pub(crate) fn rings(&self) -> &Rings {
        &self.rings
    }

    /// Where the control points lie on the rings.
    pub(crate) fn controls(&self) -> &Controls {
        &self.controls
    }

    pub(crate) fn mirrors(&self) -> &[Mirror] {
        &self.mirrors
    }

    /// Velocity of the undisturbed air [m/s] at `x` [m] and time `t` [s], N components.
    pub fn stream(&self, x: DVec3, t: f64) -> DVec3 {
        let uniform = self.settings.free_stream;
        match self.settings.wind.is_none() {
            true => uniform,
            false => uniform + self.settings.wind.at(x, t),
        }
    }

    /// The surfaces.
    pub fn surfaces(&self) -> &[Surface] {
        &self.surfaces
    }

    /// The settings.
    pub fn settings(&self) -> &AirSettings {
        &self.settings
    }

    /// Edges and panels with global numbers.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Roots of the wake sheets, in the order of [`crate::AirState::sheets`].
    pub fn sheets(&self) -> &[Sheet] {
        &self.topology.sheets
    }

    /// Number of nodes of all surfaces.
    pub fn node_count(&self) -> usize {
        *self.topology.first_node.last().expect("never empty")
    }

    /// Number of panels of all surfaces.
    pub fn panel_count(&self) -> usize {
        self.topology.panels.len()
    }

    /// Nodes of surface `s`.
    pub fn nodes_of(&self, s: usize) -> Range<usize> {
        self.topology.first_node[s]..self.topology.first_node[s + 1]
    }

    /// Panels of surface `s`.
    pub fn panels_of(&self, s: usize) -> Range<usize> {
        self.topology.first_panel[s]..self.topology.first_panel[s + 1]
    }

    /// The sheet whose mirror image sheet `k` is, if that one is computed for both.
    pub(crate) fn reflected_sheet(&self, k: usize) -> Option<(usize, Mirror)> {
        let symmetry = self.symmetry()?;
        let computed = symmetry.sheet[k];
        (computed < k).then_some((computed, symmetry.mirror))
    }
}
