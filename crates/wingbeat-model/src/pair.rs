//! Which wings of either side are a pair.

use wingbeat_math::mirrored;

use crate::animal::Wing;
use crate::mesh::mirror_name;

/// Part of the length of a wing by which hinge and nodes of its mirror image may be off \[1\].
const OFF: f64 = 1e-6;

/// Whether two of these wings are a pair, one on either side: by their names, where one of them has a partner by name,
/// as `upper-left` has in `upper-right`; else by hinges that are mirror images. Of several wings on one hinge those are
/// that are mirror images of each other, all of them where none is.
pub fn are_pair(wings: &[Wing], [a, b]: [usize; 2]) -> bool {
    let partner = |w: usize| {
        let name = mirror_name(&wings[w].name)?;
        let is_it = |v: &Wing| v.name == name && v.side != wings[w].side;
        wings.iter().position(is_it)
    };
    let share = |w: usize, v: usize| share_hinge(&wings[w], &wings[v]);
    let is_image = |w: usize, v: usize| share(w, v) && are_images(&wings[w], &wings[v]);
    let has_image = |w: usize| (0..wings.len()).any(|v| partner(v).is_none() && is_image(w, v));
    match [partner(a), partner(b)] {
        [None, None] => share(a, b) && (is_image(a, b) || ![a, b].into_iter().any(has_image)),
        [partner, _] => partner == Some(b),
    }
}

/// Whether the hinges of two wings, one on either side, are mirror images.
fn share_hinge(a: &Wing, b: &Wing) -> bool {
    a.side != b.side && a.hinge_b.distance(mirrored(b.hinge_b)) <= OFF * a.length()
}

/// Whether the surfaces of two wings are mirror images, as they lie on their hinges.
fn are_images(a: &Wing, b: &Wing) -> bool {
    a.mesh.is_image_of(&b.mesh, OFF * a.length())
}
