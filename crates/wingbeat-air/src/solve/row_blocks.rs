//! A square matrix in blocks of rows, as the kernel computes it: lanes are rows.

use rayon::prelude::*;
use wingbeat_vortex::BLOCK;

/// Columns taken side by side, so that sums are loaded and stored less often.
const SIDE: usize = 4;

/// A square matrix, block after block of [`BLOCK`] rows; within a block column after column. The last block is
/// filled up with rows that do not count.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct RowBlocks {
    order: usize,
    entries: Vec<f64>,
}

impl RowBlocks {
    /// Makes it a matrix of this order; keeps the memory, what it holds has no meaning.
    pub fn resize(&mut self, order: usize) {
        self.order = order;
        let size = order.div_ceil(BLOCK) * order * BLOCK;
        self.entries.resize(size, 0.0);
    }

    /// The matrix with these columns, one after the other.
    pub fn from_columns(order: usize, columns: &[f64]) -> Self {
        let mut matrix = Self::default();
        matrix.resize(order);
        for (k, &entry) in columns.iter().enumerate() {
            *matrix.entry(k % order, k / order) = entry;
        }
        matrix
    }

    pub fn order(&self) -> usize {
        self.order
    }

    fn place(&self, row: usize, column: usize) -> usize {
        (row / BLOCK * self.order + column) * BLOCK + row % BLOCK
    }

    pub fn entry(&mut self, row: usize, column: usize) -> &mut f64 {
        let k = self.place(row, column);
        &mut self.entries[k]
    }

    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.entries[self.place(row, column)]
    }

    /// The blocks, over threads; column j of a block begins at `j * BLOCK`.
    pub fn par_blocks(&mut self) -> impl IndexedParallelIterator<Item = &mut [f64]> {
        self.entries.par_chunks_mut(self.order * BLOCK)
    }

    /// Row after row.
    pub fn to_rows(&self, rows: &mut Vec<f64>) {
        rows.clear();
        for row in 0..self.order {
            rows.extend((0..self.order).map(|column| self.entries[self.place(row, column)]));
        }
    }

    /// The product with `x`; same bits for any number of threads.
    pub fn multiply(&self, x: &[f64], out: &mut [f64]) {
        let blocks = self.entries.par_chunks(self.order * BLOCK);
        (out.par_chunks_mut(BLOCK).zip(blocks)).for_each(|(out, block)| {
            let mut sum = [0.0; BLOCK];
            let (columns, _) = block.as_chunks::<BLOCK>();
            for (a, x) in columns.chunks(SIDE).zip(x.chunks(SIDE)) {
                match (a, x) {
                    ([a, b, c, d], &[x, y, z, w]) => {
                        for (i, s) in sum.iter_mut().enumerate() {
                            *s += (a[i] * x + b[i] * y) + (c[i] * z + d[i] * w);
                        }
                    }
                    _ => {
                        for (a, x) in a.iter().zip(x) {
                            sum.iter_mut().zip(a).for_each(|(s, a)| *s += a * x);
                        }
                    }
                }
            }
            out.copy_from_slice(&sum[..out.len()]);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_products_and_rows_in_any_number_of_blocks() {
        for n in [1, 5, BLOCK, 2 * BLOCK + 3] {
            let columns: Vec<f64> = (0..n * n).map(|k| (k as f64).sin()).collect();
            let matrix = RowBlocks::from_columns(n, &columns);
            let mut rows = vec![];
            matrix.to_rows(&mut rows);
            assert!((0..n * n).all(|k| rows[k] == columns[k % n * n + k / n]));
            let x: Vec<f64> = (0..n).map(|j| (j as f64).cos()).collect();
            let mut product = vec![0.0; n];
            matrix.multiply(&x, &mut product);
            for (row, product) in rows.chunks(n).zip(&product) {
                let sum: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
                assert!((sum - product).abs() < 1e-12); // some hundred roundings of numbers of order 1
            }
        }
    }
}
