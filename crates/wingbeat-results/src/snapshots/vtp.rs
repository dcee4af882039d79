//! Frames for ParaView: surfaces and wakes as VTK PolyData (`.vtp`, inline base64), and the
//! index of a series (`.pvd`).
//!
//! A frame ends with a comment that holds its checksum.
//!
//! Points are written in picture axes (n1, -n2, -n3): x forward, y to the left, z up. Circulations of surfaces
//! and wakes are right-handed about the corners of their panels in order: a vortex ring along them with this
//! circulation is the flow's.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use wingbeat_flight::Snapshot;
use wingbeat_math::DVec3;

use crate::common::manifest::sha256;
use crate::common::whole::target_name;
use crate::snapshots::poses::picture;

/// What a frame says of its circulations; one that does not is of another build.
pub(super) const RIGHT_HANDED: &str = "circulations right-handed about the corners";

/// The array of circulations that rings which have become particles still have in the filaments that they share
/// with rings; in wakes of flights with particles.
pub(crate) const SHARED: &str = "shared_circulation_m2_per_s";

/// Begins the last line of a frame, which holds the hash of everything before it.
pub(super) const CHECKSUM: &str = "<!-- SHA-256 of the lines above: ";

/// Points, quadrilaterals and numbers per quadrilateral.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolyData {
    /// Points, N components \[m\].
    pub points: Vec<DVec3>,
    /// Corner points of each cell.
    pub quads: Vec<[usize; 4]>,
    /// Named numbers per cell.
    pub cells: Vec<(&'static str, Vec<f64>)>,
}

impl PolyData {
    fn add(&mut self, nodes: &[DVec3], quads: impl Iterator<Item = [usize; 4]>) {
        let first = self.points.len();
        self.points.extend_from_slice(nodes);
        self.quads.extend(quads.map(|q| q.map(|n| n + first)));
    }

    /// All bound surfaces of a snapshot.
    pub fn surfaces(snapshot: &Snapshot) -> Self {
        let mut data = Self::default();
        let (mut gamma, mut jump, mut id) = (vec![], vec![], vec![]);
        for (k, s) in snapshot.surfaces.iter().enumerate() {
            data.add(&s.nodes, s.quads.iter().copied());
            // A ring of the lattice is positive when its lift is along its normal: left-handed about its corners.
            gamma.extend(s.circulation.iter().map(|g| -g));
            jump.extend_from_slice(&s.pressure_jump);
            id.extend(s.quads.iter().map(|_| k as f64));
        }
        data.cells = vec![
            ("circulation_m2_per_s", gamma),
            ("pressure_jump_pascal", jump),
            ("surface", id),
        ];
        data
    }

    /// All wake sheets of a snapshot.
    pub fn wakes(snapshot: &Snapshot) -> Self {
        let mut data = Self::default();
        let (mut gamma, mut row, mut id) = (vec![], vec![], vec![]);
        let mut shared: Option<Vec<f64>> = None;
        for (k, w) in snapshot.wakes.iter().enumerate() {
            let node = |i: usize, j: usize| i * (w.cols + 1) + j;
            let ring = |n: usize| (n / w.cols, n % w.cols);
            let rings = 0..w.rows * w.cols;
            data.add(
                &w.nodes,
                rings.clone().map(|n| {
                    let (i, j) = ring(n);
                    [
                        node(i, j),
                        node(i + 1, j),
                        node(i + 1, j + 1),
                        node(i, j + 1),
                    ]
                }),
            );
            gamma.extend_from_slice(&w.circulation);
            if let Some(of_sheet) = &w.shared_circulation {
                shared.get_or_insert_default().extend_from_slice(of_sheet);
            }
            row.extend(rings.clone().map(|n| ring(n).0 as f64));
            id.extend(rings.map(|_| k as f64));
        }
        data.cells = vec![
            ("circulation_m2_per_s", gamma),
            ("age_rows", row),
            ("sheet", id),
        ];
        // Only flights with particles have it.
        data.cells.extend(shared.map(|all| (SHARED, all)));
        data
    }

    /// The file.
    pub fn to_vtp(&self) -> String {
        let quads = self.quads.len();
        let mut out = begin(self.points.len(), [0, quads]);
        let picture = self.points.iter().flat_map(|p| picture(*p));
        array(
            &mut out,
            "Float64",
            "points",
            3,
            picture.map(f64::to_le_bytes),
        );
        out.push_str("</Points>\n<Polys>\n");
        let corners = self
            .quads
            .iter()
            .flatten()
            .map(|&n| (n as i64).to_le_bytes());
        array(&mut out, "Int64", "connectivity", 1, corners);
        array(
            &mut out,
            "Int64",
            "offsets",
            1,
            (1..=quads as i64).map(|k| (4 * k).to_le_bytes()),
        );
        out.push_str("</Polys>\n<CellData Scalars=\"circulation_m2_per_s\">\n");
        for (name, values) in &self.cells {
            array(
                &mut out,
                "Float64",
                name,
                1,
                values.iter().map(|x| x.to_le_bytes()),
            );
        }
        out.push_str("</CellData>\n");
        end(out)
    }
}

/// The beginning of a file, up to the array of its points, with its numbers of vertices and polygons.
pub(super) fn begin(points: usize, [verts, polys]: [usize; 2]) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<!-- picture axes (n1, -n2, -n3): x forward, y left, z up; metres; {RIGHT_HANDED} -->\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{verts}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{polys}\">\n<Points>\n"
    )
}

/// The file that begins so, with its checksum.
pub(super) fn end(mut out: String) -> String {
    out.push_str("</Piece>\n</PolyData>\n</VTKFile>\n");
    summed(out)
}

/// The text with its checksum as the last line.
pub(super) fn summed(mut out: String) -> String {
    let sum = sha256(out.as_bytes());
    let _ = writeln!(out, "{CHECKSUM}{sum} -->");
    out
}

/// One DataArray: base64 of the length in bytes followed by the data.
pub(super) fn array(
    out: &mut String,
    kind: &str,
    name: &str,
    components: usize,
    items: impl Iterator<Item = [u8; 8]>,
) {
    let mut block = vec![0; 8];
    for item in items {
        block.extend_from_slice(&item);
    }
    let length = block.len() as u64 - 8;
    block[..8].copy_from_slice(&length.to_le_bytes());
    let _ = writeln!(
        out,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">"
    );
    STANDARD.encode_string(&block, out);
    out.push_str("\n</DataArray>\n");
}

/// The index of a series of frames: time \[s\] and step of each, and the parts they have.
pub fn pvd(frames: &[(f64, usize)], parts: &[&str]) -> String {
    let mut out = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
    );
    for (time, step) in frames {
        for (part, stem) in parts.iter().enumerate() {
            let file = frame_name(stem, *step);
            let _ = writeln!(
                out,
                "<DataSet timestep=\"{time:e}\" part=\"{part}\" name=\"{stem}\" file=\"frames/{file}\"/>"
            );
        }
    }
    out.push_str("</Collection>\n</VTKFile>\n");
    summed(out)
}

/// File names of the frames in an index.
///
/// # Errors
/// What is wrong with the index: it is cut, or its checksum is wrong.
pub fn indexed(text: &str) -> Result<Vec<&str>, String> {
    check_sum(text, "index")?;
    let names = text.split("file=\"frames/").skip(1);
    Ok(names.filter_map(|rest| rest.split('"').next()).collect())
}

/// Whether a text ends with the hash of what stands before; `what` it is, for the error.
///
/// # Errors
/// It is cut, or the hash is another.
pub(crate) fn check_sum(text: &str, what: &str) -> Result<(), String> {
    let cut = || format!("this {what} is cut or no {what} of wingbeat");
    let (body, last) = text.split_at(text.rfind(CHECKSUM).ok_or_else(cut)?);
    let sum = last[CHECKSUM.len()..].strip_suffix(" -->\n");
    match sha256(body.as_bytes()) == sum.ok_or_else(cut)? {
        true => Ok(()),
        false => Err(format!("this {what} is damaged (its checksum is wrong)")),
    }
}

/// File name of a frame.
pub fn frame_name(stem: &str, step: usize) -> String {
    format!("{stem}_{step:06}.vtp")
}

/// Name of a frame, whole or half-written: `wakes_000012.vtp`.
pub(crate) fn is_frame(name: &str) -> bool {
    let stem = |n: &str| n.strip_suffix(".vtp").map(str::to_owned);
    let number = stem(target_name(name)).and_then(|stem| {
        let (what, number) = stem.split_once('_')?;
        ["surfaces", "wakes", "particles"]
            .contains(&what)
            .then(|| number.to_owned())
    });
    number.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
}
