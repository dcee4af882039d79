//! Six by six blocks of numbers of a node.

use wingbeat_math::{DMat3, DVec3};

use crate::configuration::NODE;

/// Six rows of six numbers: place and attitude by place and attitude.
pub(crate) type Block = [[f64; NODE]; NODE];

/// From its four quarters, by rows.
pub(crate) fn block(q: [[DMat3; 2]; 2]) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| q[i / 3][j / 3].col(j % 3)[i % 3]))
}

/// Six numbers of two vectors.
pub(crate) fn six(a: DVec3, b: DVec3) -> [f64; NODE] {
    [a.x, a.y, a.z, b.x, b.y, b.z]
}

/// Two vectors of the six numbers of node `n`.
pub(crate) fn pair(numbers: &[f64], n: usize) -> [DVec3; 2] {
    let at = &numbers[NODE * n..];
    [DVec3::from_slice(at), DVec3::from_slice(&at[3..])]
}

/// Adds the six numbers of two vectors to those of node `n`.
pub(crate) fn add_pair(numbers: &mut [f64], n: usize, [a, b]: [DVec3; 2]) {
    let to = &mut numbers[NODE * n..];
    to.iter_mut().zip(six(a, b)).for_each(|(t, v)| *t += v);
}

/// A block times six numbers.
pub(crate) fn times(a: &Block, x: &[f64; NODE]) -> [f64; NODE] {
    std::array::from_fn(|i| (0..NODE).map(|j| a[i][j] * x[j]).sum())
}

/// Product of two blocks.
pub(crate) fn product(a: &Block, b: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..NODE).map(|k| a[i][k] * b[k][j]).sum()))
}

/// Transpose.
pub(crate) fn transpose(a: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

/// Sum.
pub(crate) fn sum(a: &Block, b: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j]))
}

/// Every number times `factor`.
pub(crate) fn scaled(a: &Block, factor: f64) -> Block {
    a.map(|row| row.map(|x| factor * x))
}

/// Zero.
pub(crate) const ZERO: Block = [[0.0; NODE]; NODE];
