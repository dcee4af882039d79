//! What can be wrong with an elastic body, and when a solution cannot be found.

/// Why an elastic body cannot be built or solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StructureError {
    /// A number of nodes differs.
    #[error("{what}: {found} entries for {nodes} nodes; give one for each node")]
    Count {
        /// What was given.
        what: &'static str,
        /// Its number.
        found: usize,
        /// Nodes of the body.
        nodes: usize,
    },
    /// A node is named that is not there.
    #[error("{what} names node {node}, but the body has {nodes} nodes, counted from 0")]
    Node {
        /// What names it.
        what: &'static str,
        /// The node.
        node: usize,
        /// Nodes of the body.
        nodes: usize,
    },
    /// A number is not what it can be.
    #[error("{what} is {value}; it has to be {allowed}")]
    Number {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The ends of an element coincide.
    #[error("the beam between nodes {0} and {1} has length {2:.3e} m: its ends have to lie apart")]
    Length(usize, usize, f64),
    /// The direction that orients a section is along the beam.
    #[error(
        "the beam between nodes {0} and {1} runs along the direction that axis 2 of its section should point to; give another"
    )]
    Direction(usize, usize),
    /// The stiffness of a section is not positive definite.
    #[error(
        "the 6 x 6 stiffness of a section is not symmetric and positive definite (pivot {pivot:.3e} of row {row}, the diagonal scaled to one): every one of stretching, shearing, torsion and bending needs a positive stiffness"
    )]
    Stiffness {
        /// Row.
        row: usize,
        /// Pivot of the scaled matrix \[1\].
        pivot: f64,
    },
    /// A free node has no inertia in some direction.
    #[error(
        "node {node} is free but has no inertia in direction {direction} (0-2 translation, 3-5 rotation): give it mass, give the sections that meet there an inertia per length, or hold it; a sheet that ends in a point asks for more panels along the span"
    )]
    Inertia {
        /// The node.
        node: usize,
        /// First direction without inertia.
        direction: usize,
    },
    /// Mass properties that no distribution of mass has.
    #[error("mass of node {node}: {error}")]
    Mass {
        /// The node.
        node: usize,
        /// What is wrong.
        error: wingbeat_math::MassError,
    },
    /// Nothing can move.
    #[error("all numbers of all nodes are held: nothing can move")]
    NothingFree,
    /// The tangent is singular.
    #[error(
        "the tangent stiffness is singular at node {node}, direction {direction} (0-2 translation, 3-5 rotation): the body is not supported enough, a node is not connected, or it buckles"
    )]
    Singular {
        /// The node.
        node: usize,
        /// Direction.
        direction: usize,
    },
    /// Newton's iteration did not converge.
    #[error(
        "{what} did not converge in {passes} passes: last change {change:.2e} of the body's size where {tolerance:.0e} is needed, residual {residual:.3e} N or N m; {remedy}"
    )]
    NotConverged {
        /// What was solved.
        what: &'static str,
        /// Passes made.
        passes: usize,
        /// Largest change in the last pass \[1\]: rotation \[rad\], translation over the size of the body.
        change: f64,
        /// What was needed \[1\].
        tolerance: f64,
        /// Largest residual \[N, N m\].
        residual: f64,
        /// What to try.
        remedy: &'static str,
    },
    /// Stress as built that no rest is found with.
    #[error(
        "under its tension at rest the body finds no equilibrium ({0}): give it less tension, or hold the edges that it pulls at"
    )]
    Stressed(#[source] Box<StructureError>),
    /// Stress as built that would pull the body out of its shape.
    #[error(
        "its tension at rest pulls at free edges and moves them by {moved:.2e} m, more than a twentieth of the body's {size:.2e} m: give it less tension, or hold the edges that it pulls at"
    )]
    Slack {
        /// Largest displacement of a node \[m\].
        moved: f64,
        /// Largest extent of the body \[m\].
        size: f64,
    },
    /// An eigenproblem could not be solved.
    #[error("the eigenproblem of the modes cannot be solved: {0}")]
    Modes(&'static str),
}
