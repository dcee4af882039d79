//! Six numbers of each node.

use wingbeat_math::{DVec3, six};

use crate::nodes::configuration::NODE;

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
