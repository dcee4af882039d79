//! Import of OBJ and STL.

use crate::gap;
use wingbeat_math::DVec3;
use wingbeat_model::ModelError;
use wingbeat_model::mesh::{import, integrate};

/// A box 1 x 2 x 3 whose faces are quadrilaterals; `faces` may replace them.
fn obj_box(faces: &str) -> String {
    let mut text = String::new();
    for k in 0..8 {
        let bit = |b: i32| (k >> b) & 1;
        text += &format!("v {} {} {}\n", bit(0), 2 * bit(1), 3 * bit(2));
    }
    text + faces
}

const QUADS: &str = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

fn read(text: &str) -> Result<import::Imported, ModelError> {
    import::obj("box", &mut text.as_bytes(), 1e-3)
}

#[test]
fn exact_obj_box_of_quadrilaterals_is_taken_as_it_is() {
    let found = read(&obj_box(QUADS)).unwrap();
    assert!(!found.subdivided && !found.reversed);
    assert_eq!(found.mesh.quads.len(), 6);
    assert!((integrate::volume(&found.mesh) - 6e-9).abs() < 1e-23); // rounding
}

#[test]
fn exact_mixed_faces_are_cut_into_quadrilaterals_without_changing_the_solid() {
    // Two faces as triangles: an edge midpoint must not hang between a cut and an uncut face.
    let mixed = QUADS.replace("f 1 3 4 2\n", "f 1 3 4\nf 1 4 2\n");
    let (cut, whole) = (
        read(&obj_box(&mixed)).unwrap(),
        read(&obj_box(QUADS)).unwrap(),
    );
    assert!(cut.subdivided);
    assert_eq!(cut.mesh.quads.len(), 2 * 3 + 5 * 4);
    assert_eq!(crate::euler_characteristic(&cut.mesh), 2);
    let [a, b] = [&cut, &whole].map(|m| integrate::solid(&m.mesh, 1e9));
    assert!((a.mass - b.mass).abs() < 1e-14 * b.mass.abs());
    assert!(gap(a.inertia, b.inertia) < 1e-13 * gap(b.inertia, b.inertia * 0.0));
}

#[test]
fn exact_inward_faces_are_turned_and_reported() {
    let inward: String = QUADS
        .lines()
        .map(|l| {
            let n: Vec<&str> = l[2..].split(' ').collect();
            format!("f {} {} {} {}\n", n[3], n[2], n[1], n[0])
        })
        .collect();
    let found = read(&obj_box(&inward)).unwrap();
    assert!(found.reversed);
    assert!((integrate::volume(&found.mesh) - 6e-9).abs() < 1e-23);
}

#[test]
fn exact_stl_tetrahedron_text() {
    let p = ["0 0 0", "6 0 0", "0 6 0", "0 0 6"];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mut text = "solid t\n".to_owned();
    for f in faces {
        text += "facet normal 0 0 0\nouter loop\n";
        for k in f {
            text += &format!("vertex {}\n", p[k]);
        }
        text += "endloop\nendfacet\n";
    }
    text += "endsolid t\n";
    let found = import::stl("t", text.as_bytes(), 1.0).unwrap();
    assert!(found.subdivided);
    assert_eq!(found.mesh.quads.len(), 12);
    assert_eq!(crate::euler_characteristic(&found.mesh), 2);
    let solid = integrate::solid(&found.mesh, 1.0);
    assert!((solid.mass - 36.0).abs() < 1e-12); // 6^3 / 6
    assert!((solid.centre() - DVec3::splat(1.5)).length() < 1e-13); // 6 / 4
}

#[test]
fn invariant_open_inconsistent_broken_and_separate_meshes_are_refused() {
    let open = QUADS.replace("f 2 4 8 6\n", "");
    assert!(matches!(
        read(&obj_box(&open)),
        Err(ModelError::NotClosed { .. })
    ));
    let turned = QUADS.replace("f 2 4 8 6\n", "f 6 8 4 2\n");
    assert!(matches!(
        read(&obj_box(&turned)),
        Err(ModelError::NotClosed { .. })
    ));
    let two = format!("{}{}", obj_box(QUADS), obj_box("").replace("v ", "v 10"))
        + "f 9 11 12 10\nf 13 14 16 15\nf 9 10 14 13\nf 11 15 16 12\nf 9 13 15 11\nf 10 12 16 14\n";
    assert!(matches!(
        read(&two),
        Err(ModelError::Pieces { pieces: 2, .. })
    ));
    for text in ["", "f 1 2 3\n", "v 0 0 x\n", "v 0 0 0\nf 1 2 9\n"] {
        let error = read(text).unwrap_err();
        assert!(
            matches!(error, ModelError::Import { .. }),
            "{text:?}: {error:?}"
        );
    }
    let error = import::stl("t", b"solid nonsense", 1.0).unwrap_err();
    assert!(matches!(error, ModelError::Import { .. }), "{error:?}");
}
