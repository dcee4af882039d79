//! What can be wrong with an animal: one enum, each case names the key, the value and the remedy.

use std::borrow::Cow;
use std::fmt;

use wingbeat_math::MassError;
use wingbeat_structure::{ShellError, StructureError};

/// Why the given data do not make an animal.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// A number outside its range, or not finite.
    #[error("{key} = {value}: must be {allowed}")]
    Value {
        /// Name of the input.
        key: String,
        /// Its value (SI units).
        value: f64,
        /// The allowed range, in words.
        allowed: Cow<'static, str>,
    },
    /// A number of panels, stations or samples outside its range.
    #[error("{key} = {value}: must be {allowed}")]
    Count {
        /// Name of the input.
        key: String,
        /// Its value.
        value: usize,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// A wing whose shape is prescribed and follows from loads, too.
    #[error(
        "wing `{0}` has a structure and a prescribed deformation: its shape follows from loads or is given, not both; leave one of them out"
    )]
    TwoShapes(String),
    /// A structure that cannot be.
    #[error(transparent)]
    Structure(#[from] WingStructureError),
    /// A row of a table is wrong. Rows count from 1.
    #[error("{table}, row {row}: {problem}")]
    Table {
        /// Name of the table.
        table: String,
        /// Row of the data, counted from 1.
        row: usize,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A surface that should be closed is not.
    #[error(
        "surface `{part}` is not closed: the edge between nodes {} and {} belongs to {panels} panel(s) in one direction and {opposite} in the other (one and one are needed); close the holes and turn all faces outward",
        edge[0], edge[1]
    )]
    NotClosed {
        /// Name of the surface.
        part: String,
        /// Nodes at the ends of the edge.
        edge: [usize; 2],
        /// Panels that use the edge in this direction.
        panels: usize,
        /// Panels that use it in the opposite direction.
        opposite: usize,
    },
    /// One body part consists of several pieces.
    #[error(
        "surface `{part}` consists of {pieces} separate pieces: give each piece as a body part of its own"
    )]
    Pieces {
        /// Name of the surface.
        part: String,
        /// Number of connected pieces.
        pieces: usize,
    },
    /// A panel without area.
    #[error("surface `{part}`: panel {panel} has no area; check its corner nodes {nodes:?}")]
    FlatPanel {
        /// Name of the surface.
        part: String,
        /// Panel index.
        panel: usize,
        /// Corner nodes.
        nodes: [usize; 4],
    },
    /// The normals of a closed surface point inward.
    #[error(
        "surface `{part}` encloses the volume {volume:.3e} m3: its normals point inward; reverse the corner order of its panels"
    )]
    Inward {
        /// Name of the surface.
        part: String,
        /// Enclosed volume with sign \[m3\].
        volume: f64,
    },
    /// A hinge far outside the body.
    #[error(
        "the hinge of wing `{wing}` lies {distance:.3e} m from the nearest surface of body and segments, more than half their extent ({limit:.3e} m); hinges are given in the body frame in metres: check sign and unit"
    )]
    FarHinge {
        /// Name of the wing.
        wing: String,
        /// Distance to the nearest body surface \[m\].
        distance: f64,
        /// Largest distance allowed \[m\].
        limit: f64,
    },
    /// Impossible mass properties of the body, a part or a wing.
    #[error("mass properties of `{of}`: {source}")]
    Mass {
        /// The part, wing or body.
        of: String,
        /// What is wrong.
        source: MassError,
    },
    /// A mesh file cannot be understood.
    #[error("mesh `{name}` ({format}): {problem}")]
    Import {
        /// Name given to the mesh.
        name: String,
        /// `OBJ` or `STL`.
        format: &'static str,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A planform that cannot have the wanted shape.
    #[error("wing planform: {0}")]
    Planform(String),
}

/// `value` if it is finite and `ok`, else [`ModelError::Value`].
pub(crate) fn require(
    key: &str,
    value: f64,
    ok: bool,
    allowed: impl Into<Cow<'static, str>>,
) -> Result<f64, ModelError> {
    if value.is_finite() && ok {
        return Ok(value);
    }
    Err(ModelError::Value {
        key: key.to_owned(),
        value,
        allowed: allowed.into(),
    })
}

/// A finite number greater than zero.
pub(crate) fn positive(key: &str, value: f64) -> Result<f64, ModelError> {
    require(key, value, value > 0.0, "a finite number > 0")
}

/// A finite number, zero or greater.
pub(crate) fn not_negative(key: &str, value: f64) -> Result<f64, ModelError> {
    require(key, value, value >= 0.0, "a finite number >= 0")
}

/// A part of a whole.
pub(crate) fn fraction(key: &str, value: f64) -> Result<f64, ModelError> {
    require(key, value, (0.0..=1.0).contains(&value), "in [0, 1]")
}

/// A finite number.
pub(crate) fn finite(key: &str, value: f64) -> Result<f64, ModelError> {
    require(key, value, true, "a finite number")
}

/// What is wrong with a row of a table, counted from zero.
pub(crate) fn in_row(table: &str, row: usize, problem: impl Into<String>) -> ModelError {
    ModelError::Table {
        table: table.to_owned(),
        row: row + 1,
        problem: problem.into(),
    }
}

/// Checks that a table holds finite numbers and that its first column, `name` in messages, rises.
pub(crate) fn check_rising(table: &str, name: &str, rows: &[(f64, f64)]) -> Result<(), ModelError> {
    for (k, &(x, y)) in rows.iter().enumerate() {
        if !(x.is_finite() && y.is_finite()) {
            return Err(in_row(table, k, format!("({x}, {y}) is not finite")));
        }
        if k > 0 && x <= rows[k - 1].0 {
            let before = rows[k - 1].0;
            let problem = format!("{name} {x} does not increase (row before: {before})");
            return Err(in_row(table, k, problem));
        }
    }
    Ok(())
}

/// `value` if it is `ok`, else [`ModelError::Count`].
pub(crate) fn require_count(
    key: &str,
    value: usize,
    ok: bool,
    allowed: &'static str,
) -> Result<(), ModelError> {
    if ok {
        return Ok(());
    }
    Err(ModelError::Count {
        key: key.to_owned(),
        value,
        allowed,
    })
}

/// Why a wing cannot be made of this.
#[derive(Clone, Debug, PartialEq)]
pub struct WingStructureError {
    /// Name of the wing.
    pub wing: String,
    /// What is wrong.
    pub source: Box<MemberError>,
}

/// What is wrong with the members of a wing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MemberError {
    /// The elastic body.
    #[error(transparent)]
    Body(#[from] StructureError),
    /// A shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
    /// A vein between whose ends there is no second node.
    #[error(
        "vein[{number}]: both its ends are nearest to the same node of the mesh; give it a length, or the mesh more panels"
    )]
    ShortVein {
        /// Which vein, counted from 0.
        number: usize,
    },
    /// A region without panels.
    #[error(
        "region[{number}]: no panel of the mesh has its middle in it; make it larger, or the panels smaller"
    )]
    EmptyRegion {
        /// Which region, counted from 0.
        number: usize,
    },
    /// A region of which later ones leave nothing.
    #[error(
        "region[{number}]: regions after it cover all of its panels, and the last counts; put it after them, or remove it"
    )]
    CoveredRegion {
        /// Which region, counted from 0.
        number: usize,
    },
    /// A clamped vein that begins where the sheet is held.
    #[error(
        "vein[{number}].clamped: true has no effect: the sheet is held where this vein begins; remove it, or free the edge there (shell.clamped_root = false)"
    )]
    HeldVein {
        /// Which vein, counted from 0.
        number: usize,
    },
    /// A vein without mass where the sheet is held all along it.
    #[error(
        "vein[{number}]: this has no effect: the sheet is held all along it, and it has no mass; remove it, give it density_kg_m3, or hold less of the sheet"
    )]
    IdleVein {
        /// Which vein, counted from 0.
        number: usize,
    },
    /// A region of a sheet that is held everywhere in it, and no heavier or lighter for it.
    #[error(
        "region[{number}]: this has no effect: the sheet is held all over it; remove it, or hold less of the sheet"
    )]
    IdleRegion {
        /// Which region, counted from 0.
        number: usize,
    },
    /// Veins that leave no mass for the sheet.
    #[error(
        "the veins weigh {veins:e} kg and the whole wing {wing:e} kg: nothing is left for the sheet; give shell.density_kg_m3 in place of the mass of the wing, or veins of less radius_m or density_kg_m3"
    )]
    HeavyVeins {
        /// Mass of the veins \[kg\].
        veins: f64,
        /// Mass of the wing \[kg\].
        wing: f64,
    },
}

impl fmt::Display for WingStructureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "structure of wing `{}`: {}", self.wing, self.source)
    }
}

impl std::error::Error for WingStructureError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(self.source.as_ref())
    }
}
