//! Goland's wing: flutter of a cantilever in a lattice.

use std::f64::consts::TAU;
use std::path::Path;

use wingbeat_analysis::flutter::{FlutterSettings, condition, crossings};
use wingbeat_analysis::{About, wing_modes};
use wingbeat_case::LoadedCase;

use crate::{Case, Part, Row, VerifyError};

pub(super) const CASES: &[Case] = &[Case {
    name: "goland",
    about: "Goland's wing, a cantilever of beam and lattice: frequencies without air, the speed at which it flutters and \
            the frequency there, on three lattices.",
    part: Part::Programs,
    quick: false,
    run,
}];

/// A lattice: panels along the chord and the span, part of a panel by which rings stay inside side edges.
type Mesh = (usize, usize, f64);

fn load((rows, cols, inset): Mesh) -> Result<LoadedCase, VerifyError> {
    // The stream passes one panel in a step, and ten chords of wake are kept.
    let set = [
        format!("wing.right.mesh.chordwise={rows}"),
        format!("wing.right.mesh.spanwise={cols}"),
        format!("wing.right.structure.beam.elements={cols}"),
        format!("time.step_s={}", 1.8288 / (160.0 * rows as f64)),
        format!("air.max_wake_rows={}", 10 * rows),
        format!("air.ring_inset={inset}"),
    ];
    let text = include_str!("../../data/goland.toml");
    Ok(LoadedCase::from_text("goland", text, Path::new(""), &set)?)
}

/// Speed [m/s] at which flutter begins and its frequency \[Hz\], from two speeds about it.
fn onset(mesh: Mesh) -> Result<[f64; 2], VerifyError> {
    let case = load(mesh)?;
    let settings = FlutterSettings {
        modes: 2,
        ..FlutterSettings::default()
    };
    let at = |speed| condition(&case.setup, speed, &settings);
    let both: [_; 2] = [at(164.0)?, at(174.0)?];
    let both = both.concat();
    let begins = crossings(&both).into_iter().find(|c| c.begins);
    Ok(begins.map_or([f64::NAN; 2], |c| [c.speed, c.frequency / TAU]))
}

const LATTICES: &str = "lattices of others: 163 to 169 m/s (SHARPy's tests: 166 and 169)";

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let case = load((6, 10, 0.25))?;
    let modes = wing_modes(&case.setup, About::Rest, 2)?.swap_remove(0);
    let mut rows = vec![];
    for (k, (name, known)) in [("first", 7.66), ("second", 15.24)].into_iter().enumerate() {
        let name = format!("{name} frequency without air");
        rows.push(
            Row::new(name, "Hz", modes.vacuum[k].frequency / TAU)
                .against(
                    known,
                    "Goland 1945, J. Appl. Mech. 12:A197, as recomputed by others",
                )
                .within_part(0.01, "ten elements; the printed digits"),
        );
    }
    let [edges, inside, fine] = [(6, 10, 0.0), (6, 10, 0.25), (8, 20, 0.25)].map(onset);
    let ([edges, _], [inside, hertz], [fine, _]) = (edges?, inside?, fine?);
    rows.push(
        Row::new(
            "flutter, rings on the edges as in the lattices of others, 6 x 10 panels",
            "m/s",
            edges,
        )
        .against(166.0, LATTICES)
        .within(3.0, "the range of what others have"),
    );
    rows.push(
        Row::new("flutter, rings inside side edges, 6 x 10 panels", "m/s", inside)
            .against(166.0, LATTICES)
            .uncertain(fine - inside)
            .because("rings on the edges of coarse lattices make the span too large, which this cures: the limit of both is 1 % above the range"),
    );
    rows.push(Row::new("its frequency", "Hz", hertz).because("stated, not judged"));
    Ok(rows)
}
