//! Things with a place and a softening in a binary tree of boxes, halved in number along their longest side.

use crate::interpolation::grid::{Frame, Place};
use crate::preorder::children;
use std::ops::Range;

/// Something to be sorted: where it is, the corners of the box around it, and its number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Item {
    pub place: Place,
    pub low: Place,
    pub high: Place,
    pub index: u32,
}

/// A box and what is in it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cell {
    pub frame: Frame,
    /// Half its diagonal, or what its extent in softening counts for if that is more \[m\].
    pub size: f64,
    /// Its items.
    pub items: Range<u32>,
    /// Its leaves, one if it is a leaf.
    pub leaves: Range<u32>,
}

/// How a tree is made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// Items of a leaf; all but the last are full.
    pub leaf: usize,
    /// Square of the length that counts as much as an extent of softening from the middle by its square.
    pub per_softening: f64,
}

/// Cells in pre-order: a cell, its first child's subtree, its second child's.
#[derive(Clone, Debug, Default)]
pub(crate) struct Boxes {
    pub cells: Vec<Cell>,
    pub items: Vec<Item>,
}

impl Boxes {
    /// Sorts the items that are there.
    pub fn sort(&mut self, shape: Shape) {
        let leaves = self.items.len().div_ceil(shape.leaf);
        self.cells.clear();
        self.cells
            .resize((2 * leaves).saturating_sub(1), Cell::default());
        if leaves > 0 {
            grow(shape, &mut self.items, &mut self.cells, [0, 0]);
        }
    }

    /// The children of cell `c`, None if it is a leaf.
    pub fn children(&self, c: usize) -> Option<[usize; 2]> {
        children(c, self.cells[c].leaves.len())
    }

    /// Items of a cell.
    pub fn items_of(&self, cell: &Cell) -> &[Item] {
        &self.items[cell.items.start as usize..cell.items.end as usize]
    }

    /// The leaf with this number.
    pub fn cell_of_leaf(&self, leaf: usize) -> usize {
        let mut c = 0;
        while let Some([one, two]) = self.children(c) {
            c = match self.cells[two].leaves.start as usize <= leaf {
                true => two,
                false => one,
            };
        }
        c
    }

    /// Cells without children.
    pub fn leaves(&self) -> impl Iterator<Item = &Cell> {
        self.cells.iter().filter(|cell| cell.leaves.len() == 1)
    }
}

/// Items of a subtree that is worth a task of its own.
const TASK: usize = 2000;

/// Makes the subtree of `items`, of which `first` are the numbers of the first item and leaf.
fn grow(shape: Shape, items: &mut [Item], cells: &mut [Cell], first: [u32; 2]) {
    let leaves = items.len().div_ceil(shape.leaf);
    let (cell, rest) = cells.split_first_mut().expect("a cell for the root");
    *cell = surround(shape, items, first);
    if leaves == 1 {
        return items.sort_unstable_by_key(|item| item.index);
    }
    let half = leaves / 2;
    let (count, axis) = (half * shape.leaf, longest(shape, items, cell));
    items.select_nth_unstable_by(count, |a, b| {
        let order = a.place[axis].total_cmp(&b.place[axis]);
        order.then(a.index.cmp(&b.index))
    });
    let (items1, items2) = items.split_at_mut(count);
    let (cells1, cells2) = rest.split_at_mut(2 * half - 1);
    let second = [first[0] + count as u32, first[1] + half as u32];
    if items2.len() > TASK {
        rayon::join(
            || grow(shape, items1, cells1, first),
            || grow(shape, items2, cells2, second),
        );
    } else {
        grow(shape, items1, cells1, first);
        grow(shape, items2, cells2, second);
    }
}

/// The cell of these items.
fn surround(shape: Shape, items: &[Item], [item, leaf]: [u32; 2]) -> Cell {
    let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
    for item in items {
        for d in 0..4 {
            low[d] = low[d].min(item.low[d]);
            high[d] = high[d].max(item.high[d]);
        }
    }
    let frame = Frame::between(low, high);
    let [x, y, z, soft] = frame.half;
    let leaves = items.len().div_ceil(shape.leaf) as u32;
    Cell {
        frame,
        size: (x * x + y * y + z * z)
            .max(shape.per_softening * soft)
            .sqrt(),
        items: item..item + items.len() as u32,
        leaves: leaf..leaf + leaves,
    }
}

/// Along which direction the items are to be halved: softening where it makes the cell as large as it is.
fn longest(shape: Shape, items: &[Item], cell: &Cell) -> usize {
    let [x, y, z, soft] = cell.frame.half;
    let extent = |d: usize| {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        let places = items.iter().map(|item| item.place[d]);
        let (low, high) = places.fold(ends, |(low, high), v| (low.min(v), high.max(v)));
        high - low
    };
    if shape.per_softening * soft > x * x + y * y + z * z && extent(3) > 0.0 {
        return 3;
    }
    let [x, y, z] = [0, 1, 2].map(extent);
    if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    }
}
