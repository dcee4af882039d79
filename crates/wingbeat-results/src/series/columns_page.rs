//! The page of the columns of a history, docs/columns.md.

use crate::series::columns::Subject;
use crate::series::quantity::{Kind, Of, Unit};
use crate::series::table::GROUPS;

/// What stands above the table on the page of columns.
const PAGE_HEAD: &str = "# The columns of history.csv

Written by the program: `cargo run -p wingbeat-results --example columns > docs/columns.md`.

BODY is `body`, `wing_NAME` or `segment_NAME`, CHILD a wing or segment at its hinge, JOINT the name of a joint with
what it leaves free: `waist_rotation`, `slider_displacement`, `gimbal_rotation_1`; in names everything but letters and
digits is an underscore. The unit ends the name. Components: x, y, z or n1, n2, n3 along the inertial axes (n3 along
gravity); b1 to b3, w1 to w3, s1 to s3 along the axes of body, wing, segment; phi, theta, psi Euler angles. Counts are
whole numbers, all others have a decimal point or an exponent and read back bit for bit.

A thinned history (`output.history_every`) has rows at every so many steps, at the ends of wingbeats, at frames and at
the end. \"sum\", \"largest\" and \"smallest\" are those of all steps since the row before; the rest is that of its step.

| column | unit | frame | symbol | thinned | what |
|---|---|---|---|---|---|
";

/// The page of all columns, docs/columns.md.
pub fn columns_page() -> String {
    let mut out = PAGE_HEAD.to_owned();
    for group in GROUPS {
        for q in group.quantities {
            let subject = placeholder(group.of);
            let c = subject.column(group.of, q, 0, q.components.placeholder());
            let unit = match q.unit {
                Unit::Coordinate => "rad or m",
                Unit::CoordinateRate => "rad s-1 or m s-1",
                _ => c.unit,
            };
            let frame = q.frame.words_of_all();
            let thinned = c.fold.words();
            let line = format!(
                "| `{}` | {unit} | {frame} | {} | {thinned} | {} |\n",
                c.name, c.symbol, c.about
            );
            out += &line;
        }
    }
    out
}

/// What stands for any subject of a group.
fn placeholder(of: Of) -> Subject {
    let (name, words) = match of {
        Of::Flight | Of::Steered | Of::Following | Of::Holding | Of::Bending | Of::Jointed => {
            ("", "")
        }
        Of::Bodies => ("BODY", "a body"),
        Of::Wings | Of::Deforming | Of::Elastic | Of::Commanded => ("wing_NAME", "a wing"),
        Of::Children => ("CHILD", "a wing or segment"),
        Of::Connections | Of::Orientations => ("N", "N"),
        Of::Coordinates => (
            "JOINT",
            "coordinate of a joint (of a spherical one its rotation vector; the rates are its angular velocity, child axes)",
        ),
        Of::Loops => ("NAME", "a joint"),
    };
    Subject::new(name.to_owned(), words, Kind::Flight, 0)
}
