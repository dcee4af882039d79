//! The lattice: surfaces, topology and settings, checked once and constant after that.

use crate::error::AirError;
use crate::filaments::newest;
use crate::images::{Mirror, mirrors};
use crate::loads::AirWorkspace;
use crate::own::{self, Own};
use crate::rings::{Rings, rings};
use crate::seams::Seam;
use crate::settings::{AirSettings, LeadingEdge};
use crate::state::{AirState, NodeMotion, WakeSheet, is_whole};
use crate::strips::{Strip, strips};
use crate::surface::{EdgeKind, Surface};
use crate::topology::{Edge, Sheet, Topology};
use crate::twins::{Halves, Twins};
use std::ops::Range;
use std::sync::Arc;
use wingbeat_math::DVec3;

/// Vortex rings on the panels of any number of surfaces, with their wakes' roots.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    surfaces: Vec<Surface>,
    settings: AirSettings,
    topology: Topology,
    strips: Vec<Strip>,
    rings: Rings,
    mirrors: Vec<Mirror>,
    halves: Option<Halves>,
    own: Arc<Vec<Own>>,
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
    /// As [`Self::new`]; seams that fit nowhere.
    pub fn joined(
        surfaces: Vec<Surface>,
        seams: &[Seam],
        settings: AirSettings,
    ) -> Result<Self, AirError> {
        settings.validate()?;
        let mut settings = settings;
        settings.shedding.leading &= settings.leading != LeadingEdge::Never;
        let topology = Topology::new(&surfaces, seams, settings.shedding)?;
        let lattice = Self {
            strips: strips(&topology, &surfaces),
            rings: rings(&topology, &surfaces, &settings),
            mirrors: mirrors(&settings.images)?,
            surfaces,
            settings,
            topology,
            halves: None,
            own: Arc::default(),
        };
        Ok(lattice.with_own())
    }

    fn with_own(mut self) -> Self {
        self.own = Arc::new(own::known(&self));
        self
    }

    /// The same lattice for motions that are mirror-symmetric: computed on one half.
    ///
    /// # Errors
    /// [`AirError::Twins`] names the first node, panel or wake sheet whose twin does not fit.
    pub fn with_twins(mut self, twins: Twins) -> Result<Self, AirError> {
        self.halves = Some(Halves::new(twins, &self.topology)?);
        Ok(self.with_own())
    }

    pub(crate) fn halves(&self) -> Option<&Halves> {
        self.halves.as_ref()
    }

    /// What is known of surfaces that keep their shape, in the order of their unknowns.
    pub(crate) fn own(&self) -> &[Own] {
        &self.own
    }

    /// Strips of panels behind the leading edges, in the order of [`AirState::leading`].
    pub fn strips(&self) -> &[Strip] {
        &self.strips
    }

    pub(crate) fn rings(&self) -> &Rings {
        &self.rings
    }

    pub(crate) fn mirrors(&self) -> &[Mirror] {
        &self.mirrors
    }

    /// Velocity of the undisturbed air [m/s] at `x` [m] and time `t` [s], N.
    pub fn stream(&self, x: DVec3, t: f64) -> DVec3 {
        let uniform = self.settings.free_stream;
        match self.settings.wind.is_none() {
            true => uniform,
            false => uniform + self.settings.wind.at(x, t),
        }
    }

    /// Whether the flow stays attached at an edge that could shed: its newest ring was left
    /// without circulation by the separation criterion.
    pub(crate) fn is_attached(&self, state: &AirState, edge: &Edge) -> bool {
        edge.wake
            .is_some_and(|w| self.keeps_attached(state, w.sheet, w.column))
    }

    /// The same of a column of a wake sheet.
    pub(crate) fn keeps_attached(&self, state: &AirState, sheet: usize, column: usize) -> bool {
        self.topology.sheets[sheet].kinds[column] == EdgeKind::Leading
            && self.settings.leading != LeadingEdge::Always
            && newest(&state.sheets[sheet], column) == 0.0
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

    /// Roots of the wake sheets, in the order of [`AirState::sheets`].
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

    /// Scratch memory for this lattice.
    pub fn workspace(&self) -> AirWorkspace {
        AirWorkspace::default()
    }

    /// Air without circulation and wake around the surfaces as they are: the start from rest.
    pub fn initial_state(&self, motion: &NodeMotion) -> AirState {
        let sheet = |root: &Sheet| WakeSheet {
            columns: root.panels.len(),
            spent: vec![0; root.panels.len()],
            ..WakeSheet::default()
        };
        AirState {
            gamma: vec![0.0; self.panel_count()],
            gamma_before: vec![0.0; self.panel_count()],
            position: motion.position.clone(),
            velocity: motion.velocity.clone(),
            inner_momentum: vec![DVec3::ZERO; self.surfaces.len()],
            leading: vec![0.0; self.strips.len()],
            sheets: self.sheets().iter().map(sheet).collect(),
            ..AirState::default()
        }
    }

    /// Checks that a state, perhaps read from a file, has the shape this lattice needs.
    ///
    /// # Errors
    /// [`AirError::StateMismatch`] says what differs.
    pub fn check_state(&self, state: &AirState) -> Result<(), AirError> {
        let mismatch = |what| Err(AirError::StateMismatch { what });
        let panels = self.panel_count();
        if state.gamma.len() != panels || state.gamma_before.len() != panels {
            return mismatch("number of panels");
        }
        if [&state.position, &state.velocity]
            .iter()
            .any(|x| x.len() != self.node_count())
        {
            return mismatch("number of nodes");
        }
        if state.leading.len() != self.strips.len() {
            return mismatch("number of leading-edge strips");
        }
        if state.inner_momentum.len() != self.surfaces.len() {
            return mismatch("number of surfaces");
        }
        let fits = |(sheet, root): (&WakeSheet, &Sheet)| {
            sheet.columns == root.panels.len()
                && [&sheet.nodes, &sheet.velocity].into_iter().all(is_whole)
                && sheet.nodes.len() == sheet.rows() * (sheet.columns + 1)
                && sheet.gamma.len() == sheet.rows() * sheet.columns
                && (sheet.velocity.is_empty() || sheet.velocity.len() == sheet.nodes.len())
                && sheet.spent.len() == sheet.columns
                && sheet.spent.iter().all(|&s| s < sheet.rows().max(1))
                && sheet.particles.is_sound()
                && (sheet.particles.is_empty() || self.settings.particles.is_some())
        };
        if state.sheets.len() != self.sheets().len()
            || !state.sheets.iter().zip(self.sheets()).all(fits)
        {
            return mismatch("wake sheets");
        }
        Ok(())
    }

    /// Checks number and finiteness of the nodes.
    pub(crate) fn check_motion(&self, motion: &NodeMotion, step: u64) -> Result<(), AirError> {
        for got in [motion.position.len(), motion.velocity.len()] {
            if got != self.node_count() {
                return Err(AirError::MotionSize {
                    got,
                    expected: self.node_count(),
                });
            }
        }
        let nodes = motion.position.iter().zip(&motion.velocity);
        let mut nodes = nodes.enumerate();
        match nodes.find(|(_, (x, v))| !(x.is_finite() && v.is_finite())) {
            None => Ok(()),
            Some((n, (&position, &velocity))) => {
                let s = self.topology.first_node.partition_point(|&f| f <= n) - 1;
                Err(AirError::SurfaceNotFinite {
                    step,
                    surface: self.surfaces[s].name.clone(),
                    node: n - self.topology.first_node[s],
                    position,
                    velocity,
                })
            }
        }
    }

    pub(crate) fn no_length(&self, panel: usize, nodes: [usize; 2], step: u64) -> AirError {
        let first = self.topology.first_node[self.topology.panel_surface[panel]];
        let [from, to] = nodes.map(|n| n - first);
        let (surface, panel) = self.locate_panel(panel);
        AirError::NoLength {
            step,
            surface,
            panel,
            from,
            to,
        }
    }

    pub(crate) fn crossed(&self, panel: usize, step: u64) -> AirError {
        let (surface, panel) = self.locate_panel(panel);
        AirError::Crossed {
            step,
            surface,
            panel,
        }
    }

    pub(crate) fn flat_panel(&self, panel: usize, step: u64) -> AirError {
        let (surface, panel) = self.locate_panel(panel);
        AirError::FlatPanel {
            step,
            surface,
            panel,
        }
    }

    pub(crate) fn panel_not_finite(
        &self,
        panel: usize,
        step: u64,
        what: &'static str,
        value: f64,
    ) -> AirError {
        let (surface, panel) = self.locate_panel(panel);
        AirError::PanelNotFinite {
            step,
            surface,
            panel,
            what,
            value,
        }
    }

    /// Name of the surface of a panel, and the panel's number there.
    fn locate_panel(&self, panel: usize) -> (String, usize) {
        let s = self.topology.panel_surface[panel];
        let name = self.surfaces[s].name.clone();
        (name, panel - self.topology.first_panel[s])
    }
}
