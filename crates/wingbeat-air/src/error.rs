//! What can go wrong in the air.

use crate::edges::EdgeKind;
use wingbeat_math::{DVec3, LuError};

/// A lattice that cannot be built, or a step that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AirError {
    /// No surface has a panel.
    #[error("the lattice has no panels; give at least one surface with panels, or fly without air")]
    Empty,
    /// A panel names a node its surface does not have.
    #[error(
        "surface {surface}, panel {panel}: node {node} does not exist, the surface has {count} nodes"
    )]
    NodeOutOfRange {
        /// Name of the surface.
        surface: String,
        /// Panel, counted in its surface.
        panel: usize,
        /// The offending node, counted in its surface.
        node: usize,
        /// Number of nodes of the surface.
        count: usize,
    },
    /// The shape at rest is not that of the surface.
    #[error(
        "surface {surface}: its shape at rest has {nodes} nodes where {expected} finite places [m] are needed, one for each of its nodes; give these, or none"
    )]
    Rest {
        /// Name of the surface.
        surface: String,
        /// Places given.
        nodes: usize,
        /// Number of nodes of the surface.
        expected: usize,
    },
    /// Panels do not form an oriented surface.
    #[error(
        "surface {surface}: {count} panels run the edge {from} -> {to} the same way; neighbouring panels must be oriented alike (corner order all clockwise or all anticlockwise seen from one side) and an edge joins at most two"
    )]
    Orientation {
        /// Name of the surface.
        surface: String,
        /// First node of the edge.
        from: usize,
        /// Second node of the edge.
        to: usize,
        /// Panels that run the edge in this direction.
        count: usize,
    },
    /// A surface said to be closed has a free edge.
    #[error(
        "surface {surface} is said to be closed but its edge {from} - {to} belongs to one panel only; join the nodes there or declare it open"
    )]
    NotClosed {
        /// Name of the surface.
        surface: String,
        /// One end of the free edge.
        from: usize,
        /// The other end.
        to: usize,
    },
    /// A shedding segment is no free edge of its panel.
    #[error(
        "surface {surface}: the {kind:?} shedding segment {from} -> {to} is not a free edge of panel {panel}; wakes leave free edges, named with the panel they bound, each once"
    )]
    Shedding {
        /// Name of the surface.
        surface: String,
        /// Kind of the segment.
        kind: EdgeKind,
        /// First node.
        from: usize,
        /// Second node.
        to: usize,
        /// Panel, counted in its surface.
        panel: usize,
    },
    /// Consecutive segments of a shedding line do not meet.
    #[error(
        "surface {surface}, shedding line {line}: segment {segment} starts at node {start}, the one before ends at {end}; consecutive segments share a node"
    )]
    BrokenLine {
        /// Name of the surface.
        surface: String,
        /// Shedding line of the surface.
        line: usize,
        /// Segment of the line.
        segment: usize,
        /// Where the segment starts.
        start: usize,
        /// Where the one before ends.
        end: usize,
    },
    /// A number of the settings makes no sense.
    #[error("air setting {key} = {value}: {allowed}")]
    Setting {
        /// Name of the setting.
        key: &'static str,
        /// Its value.
        value: String,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A gust's table cannot be used.
    #[error(
        "gusts[{gust}], table[{row}]: {problem}; give at least two rows of time and share, times rising"
    )]
    GustTable {
        /// Gust, counted from 0.
        gust: usize,
        /// Row, counted from 0.
        row: usize,
        /// What is wrong.
        problem: &'static str,
    },
    /// The motion has the wrong number of nodes.
    #[error(
        "the motion gives {got} node positions and velocities, the lattice has {expected} nodes"
    )]
    MotionSize {
        /// Nodes given.
        got: usize,
        /// Nodes of the lattice.
        expected: usize,
    },
    /// A time step is not positive.
    #[error("the time step {dt} s of air step {step} is not a positive finite number")]
    TimeStep {
        /// Step [s].
        dt: f64,
        /// Accepted steps so far.
        step: u64,
    },
    /// Calls in the wrong order.
    #[error("air step {step}: {what}")]
    Order {
        /// Accepted steps so far.
        step: u64,
        /// What was done and what is to be done first.
        what: &'static str,
    },
    /// A node of a surface is not at a finite place or speed.
    #[error(
        "air step {step}: node {node} of surface {surface} is at {position} m with {velocity} m/s; the body's motion has diverged, reduce the time step or check the motion"
    )]
    SurfaceNotFinite {
        /// Accepted steps so far.
        step: u64,
        /// Name of the surface.
        surface: String,
        /// Node, counted in its surface.
        node: usize,
        /// Position [m].
        position: DVec3,
        /// Velocity [m/s].
        velocity: DVec3,
    },
    /// A panel has no area, so no normal.
    #[error(
        "air step {step}: panel {panel} of surface {surface} has no area (diagonals parallel); give its corners distinct places"
    )]
    FlatPanel {
        /// Accepted steps so far.
        step: u64,
        /// Name of the surface.
        surface: String,
        /// Panel, counted in its surface.
        panel: usize,
    },
    /// Two corners of a panel lie on one place: an edge without length.
    #[error(
        "air step {step}: nodes {from} and {to} of panel {panel} of surface {surface} coincide; a panel's edges have a length (a triangle names one node twice)"
    )]
    NoLength {
        /// Accepted steps so far.
        step: u64,
        /// Name of the surface.
        surface: String,
        /// Panel, counted in its surface.
        panel: usize,
        /// One end, counted in the surface.
        from: usize,
        /// The other end.
        to: usize,
    },
    /// The sides of a panel cross.
    #[error(
        "air step {step}: the sides of panel {panel} of surface {surface} cross; give its corners in their order round the panel"
    )]
    Crossed {
        /// Accepted steps so far.
        step: u64,
        /// Name of the surface.
        surface: String,
        /// Panel, counted in its surface.
        panel: usize,
    },
    /// The influence equations have no unique solution.
    #[error(
        "air step {step}: the circulations cannot be found ({source}); look for cores of the surfaces (bound_core) wider than their panels, coinciding panels or surfaces (of a body on air.ground, panels and their images), or an open surface declared closed or the other way round"
    )]
    Singular {
        /// Accepted steps so far.
        step: u64,
        /// What the solver met.
        source: LuError,
    },
    /// Circulation, pressure or force of a panel is not finite.
    #[error(
        "air step {step}: the {what} of panel {panel} of surface {surface} is {value}; reduce the time step or enlarge the wake core radius"
    )]
    PanelNotFinite {
        /// Accepted steps so far.
        step: u64,
        /// Name of the surface.
        surface: String,
        /// Panel, counted in its surface.
        panel: usize,
        /// Which quantity.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A wake node moved to nowhere.
    #[error(
        "air step {step}: the wake node {column} of row {row} (0 = newest) of wake sheet {sheet} moves at {velocity} m/s; reduce the time step, enlarge the wake core radius or limit the displacement per step"
    )]
    WakeNotFinite {
        /// Accepted steps so far.
        step: u64,
        /// Sheet.
        sheet: usize,
        /// Row, 0 = newest.
        row: usize,
        /// Node of the row.
        column: usize,
        /// Its velocity [m/s].
        velocity: DVec3,
    },
    /// A particle moved to nowhere.
    #[error(
        "air step {step}: particle {particle} of wake sheet {sheet} moves at {velocity} m/s; reduce the time step, enlarge the particles' radius or omit stretching"
    )]
    ParticleNotFinite {
        /// Accepted steps so far.
        step: u64,
        /// Sheet.
        sheet: usize,
        /// Particle, 0 = oldest.
        particle: usize,
        /// Its velocity [m/s].
        velocity: DVec3,
    },
    /// Surfaces that cannot be joined.
    #[error(
        "joined edge {edge}: {problem}; a joined edge lists the nodes of a free edge line of both surfaces, pair by pair"
    )]
    JoinedEdge {
        /// Number of the joined edge.
        edge: usize,
        /// What does not fit.
        problem: &'static str,
    },
    /// A strip through a body that leads nowhere.
    #[error(
        "surface {surface}, panel {panel}: it is said to carry circulation through a body but lies between no two roots; join its outer \
         side to a wing and its inner side to the strip of the other wing, as many panels along the chord on all four"
    )]
    CarryThrough {
        /// Name of the surface.
        surface: String,
        /// Panel, counted in its surface.
        panel: usize,
    },
    /// Joined surfaces that come apart.
    #[error(
        "air step {step}: node {} of surface {} and node {} of surface {} are joined but {distance:e} m apart; move joined surfaces so that their shared edge is one",
        nodes[0].1, nodes[0].0, nodes[1].1, nodes[1].0
    )]
    JoinOpen {
        /// Accepted steps so far.
        step: u64,
        /// Surface and node, counted in it, on either side.
        nodes: Box<[(String, usize); 2]>,
        /// Distance [m].
        distance: f64,
    },
    /// An edge on a plane of images that leaves it.
    #[error(
        "air step {step}: node {node} of surface {surface} lies on a plane of images and has left it by {distance:e} m; move the surface so that this edge stays on the plane"
    )]
    OffPlane {
        /// Accepted steps so far.
        step: u64,
        /// Name of the surface.
        surface: String,
        /// Node, counted in its surface.
        node: usize,
        /// Distance from the plane [m].
        distance: f64,
    },
    /// A state that does not belong to the lattice.
    #[error(
        "the air state does not fit the lattice ({what}); restart with the case the state was written by"
    )]
    StateMismatch {
        /// What differs.
        what: &'static str,
    },
    /// Nodes, panels or wake sheets that are no mirror images of each other.
    #[error(
        "{what} {index} has no mirror image that fits (the image of its image is the {what} itself, with its nodes in mirror image); compute both halves"
    )]
    MirrorPairs {
        /// Node, panel, wake sheet, or the plane itself.
        what: &'static str,
        /// Its number.
        index: usize,
    },
    /// Undisturbed air, or a plane, that is not mirror-symmetric though only one half is computed.
    #[error(
        "{what} is not its own mirror image in the plane of symmetry of the motion: compute both halves, or turn it so that it is"
    )]
    AsymmetricAir {
        /// Part of the settings.
        what: &'static str,
    },
    /// Wind through a plane through which nothing goes.
    #[error(
        "the {part} blows through a plane of symmetry or a ground; what goes along it is allowed"
    )]
    WindThroughPlane {
        /// Part of the wind.
        part: &'static str,
    },
    /// A surface on both sides of a plane through which nothing goes.
    #[error(
        "air step {step}: node {node} of surface {surface} is {depth:e} m beyond a plane of symmetry or ground; all surfaces stay on one side of it: start farther from it, or fly without it"
    )]
    ThroughPlane {
        /// Accepted steps so far.
        step: u64,
        /// Name of the surface.
        surface: String,
        /// Node, counted in its surface.
        node: usize,
        /// Distance behind the plane [m].
        depth: f64,
    },
    /// Motion that is not mirror-symmetric though only one half is computed.
    #[error(
        "air step {step}: surface node {node} is {distance:e} m away from the mirror image of node {image}; the flight is not mirror-symmetric: compute both halves"
    )]
    Asymmetric {
        /// Accepted steps so far.
        step: u64,
        /// Node of all surfaces.
        node: usize,
        /// The node whose mirror image it should be.
        image: usize,
        /// Distance [m].
        distance: f64,
    },
}

/// An error that names a setting unless `ok`.
///
/// # Errors
/// [`AirError::Setting`].
pub(crate) fn require(
    ok: bool,
    key: &'static str,
    value: impl ToString,
    allowed: &'static str,
) -> Result<(), AirError> {
    match ok {
        true => Ok(()),
        false => Err(AirError::Setting {
            key,
            value: value.to_string(),
            allowed,
        }),
    }
}

/// Whether it is finite and above 0.
pub(crate) fn is_positive(x: f64) -> bool {
    x.is_finite() && x > 0.0
}
