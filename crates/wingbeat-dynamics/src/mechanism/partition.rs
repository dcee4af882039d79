//! Which coordinates follow from which: elimination with full pivoting.
//!
//! The pivots divide the coordinates into dependent ones (a pivot's column) and independent ones,
//! chosen so that the dependent ones follow with the least amplification. Rows without a pivot ask
//! for what other rows ask already; the combination of rows that vanishes names them.

/// Below this part of the largest entry a pivot counts as zero: scaled Jacobians have entries of
/// order one, and constraints hold to 1e-12 when ranks are asked for.
pub(crate) const RANK_TOLERANCE: f64 = 1e-9;

/// Below this part of the largest entry a pivot of the Jacobian means a singular position is near: reactions and
/// accelerations are there a thousand times what they are elsewhere, and loops may go on in several ways.
pub(crate) const NEARLY_SINGULAR: f64 = 1e-3;

/// A row that follows from others.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dependent {
    /// Factors of all rows in the combination that vanishes \[1\].
    pub combination: Vec<f64>,
    /// The same combination of the right-hand sides [m/s2 or rad/s2]: zero if the rows do not contradict.
    pub residual: f64,
}

/// Result of the elimination.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Partition {
    /// Solution with all independent unknowns zero [m/s2 or rad/s2].
    pub step: Vec<f64>,
    /// Columns of the dependent unknowns.
    pub pivots: Vec<usize>,
    /// Rows asked twice.
    pub dependent: Vec<Dependent>,
}

/// Solves the rows `a x = b` for as many unknowns as there are independent rows; columns not
/// `allowed` stay zero. Pivots below `zero` times the largest entry count as zero.
pub(crate) fn partition(
    mut a: Vec<Vec<f64>>,
    mut b: Vec<f64>,
    allowed: &[bool],
    zero: f64,
) -> Partition {
    let (m, n) = (a.len(), allowed.len());
    let largest = a.iter().flatten().fold(0.0_f64, |s, x| s.max(x.abs()));
    let mut combos: Vec<Vec<f64>> = (0..m)
        .map(|i| (0..m).map(|j| f64::from(u8::from(i == j))).collect())
        .collect();
    let mut rows: Vec<usize> = (0..m).collect();
    let (mut step, mut pivots) = (vec![0.0; n], vec![]);
    let mut pairs = vec![];
    while let Some((r, c)) = largest_entry(&a, &rows, allowed, zero * largest) {
        rows.retain(|&i| i != r);
        let (row, combo, right) = (a[r].clone(), combos[r].clone(), b[r]);
        for i in (0..m).filter(|&i| i != r) {
            let f = a[i][c] / row[c];
            if f != 0.0 {
                subtract(&mut a[i], &row, f);
                subtract(&mut combos[i], &combo, f);
                b[i] -= f * right;
            }
        }
        pairs.push((r, c));
        pivots.push(c);
    }
    for (r, c) in pairs {
        step[c] = b[r] / a[r][c];
    }
    let dependent = (rows.iter())
        .map(|&i| Dependent {
            combination: combos[i].clone(),
            residual: b[i],
        })
        .collect();
    Partition {
        step,
        pivots,
        dependent,
    }
}

fn subtract(x: &mut [f64], y: &[f64], f: f64) {
    x.iter_mut().zip(y).for_each(|(x, y)| *x -= f * y);
}

/// The largest entry of the rows left, above `least`.
fn largest_entry(
    a: &[Vec<f64>],
    rows: &[usize],
    allowed: &[bool],
    least: f64,
) -> Option<(usize, usize)> {
    let mut best = (least, None);
    for &i in rows {
        for (j, x) in a[i].iter().enumerate() {
            if allowed[j] && x.abs() > best.0 {
                best = (x.abs(), Some((i, j)));
            }
        }
    }
    best.1
}
