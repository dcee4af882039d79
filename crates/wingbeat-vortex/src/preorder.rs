//! Binary trees in pre-order: a cell, its first child's subtree, its second child's.

/// The children of cell `c`, which has so many leaves; None if it is a leaf. The first one has half of them.
pub(crate) fn children(c: usize, leaves: usize) -> Option<[usize; 2]> {
    (leaves > 1).then(|| [c + 1, c + 2 * (leaves / 2)])
}
