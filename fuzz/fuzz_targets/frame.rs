//! The frame reader: any text is refused with a message or gives a mesh whose sheets lie in it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use wingbeat_results::frames::Mesh;
use wingbeat_results::manifest::sha256;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    assert!(Mesh::parse(text).is_ok() || !Mesh::parse(text).unwrap_err().is_empty());
    let sum = sha256(data);
    let Ok(mesh) = Mesh::parse(&format!(
        "{text}<!-- SHA-256 of the lines above: {sum} -->\n"
    )) else {
        return;
    };
    for sheet in mesh.sheets() {
        let nodes = (sheet.rows() + 1) * (sheet.cols + 1);
        assert!(mesh.points[sheet.first_node..].len() >= nodes);
        assert!(mesh.quads[sheet.first_cell..].len() >= sheet.rings);
    }
});
