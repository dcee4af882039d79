//! Eigenvalues and eigenvectors of small real matrices, balanced first.
//!
//! States of flight mix metres per second, radians and radians per second; a QR iteration on an
//! unbalanced matrix of that kind loses its small eigenvalues. Balancing scales by powers of two
//! (exactly) until rows and columns have the same size [Parlett & Reinsch 1969].

use faer::Mat;

use crate::AnalysisError;

/// An eigenvalue with its eigenvector, largest component 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigenpair {
    /// Real and imaginary part, in the unit of the matrix \[1 or 1/s\].
    pub value: [f64; 2],
    /// Real and imaginary part of each component \[1\].
    pub vector: Vec<[f64; 2]>,
}

/// All eigenpairs of the n x n matrix `a` given by rows, by falling real part.
///
/// ```
/// // A rotation by 90 degrees: eigenvalues +-i.
/// let pairs = wingbeat_analysis::eigen(&[0.0, -1.0, 1.0, 0.0], 2).unwrap();
/// assert!(pairs[0].value[0].abs() < 1e-15 && (pairs[0].value[1].abs() - 1.0).abs() < 1e-15);
/// ```
///
/// # Errors
/// An entry is not finite; the iteration does not converge.
pub fn eigen(a: &[f64], n: usize) -> Result<Vec<Eigenpair>, AnalysisError> {
    assert_eq!(a.len(), n * n, "an {n} x {n} matrix is needed");
    if a.iter().any(|x| !x.is_finite()) {
        return Err(AnalysisError::Numbers(
            "a matrix entry is not finite".into(),
        ));
    }
    let (balanced, scale) = balance(a, n);
    let matrix = Mat::from_fn(n, n, |i, j| balanced[i * n + j]);
    let decomposition = matrix
        .eigen()
        .map_err(|e| AnalysisError::Numbers(format!("the eigenvalue iteration failed: {e:?}")))?;
    let values = decomposition.S().column_vector();
    let vectors = decomposition.U();
    let pair = |k: usize| {
        let vector = (0..n).map(|i| {
            let z = vectors[(i, k)];
            [z.re * scale[i], z.im * scale[i]]
        });
        Eigenpair {
            value: [values[k].re, values[k].im],
            vector: normalised(vector.collect()),
        }
    };
    let mut pairs: Vec<_> = (0..n).map(pair).collect();
    pairs.sort_by(|p, q| {
        q.value[0]
            .total_cmp(&p.value[0])
            .then(q.value[1].total_cmp(&p.value[1]))
    });
    Ok(pairs)
}

/// The matrix `D^-1 A D` with D of powers of two, and D.
fn balance(a: &[f64], n: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut a, mut d) = (a.to_vec(), vec![1.0; n]);
    for _sweep in 0..100 {
        let mut changed = false;
        for i in 0..n {
            let others = (0..n).filter(|&j| j != i);
            let column: f64 = others.clone().map(|j| a[j * n + i].abs()).sum();
            let row: f64 = others.map(|j| a[i * n + j].abs()).sum();
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let factor = 2.0_f64.powi((0.5 * (row / column).log2()).round() as i32);
            if (column * factor + row / factor) < 0.95 * (column + row) {
                changed = true;
                d[i] *= factor;
                for j in 0..n {
                    a[i * n + j] /= factor;
                }
                for j in 0..n {
                    a[j * n + i] *= factor;
                }
            }
        }
        if !changed {
            break;
        }
    }
    (a, d)
}

/// The vector divided by its largest component.
fn normalised(v: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let size = |z: &[f64; 2]| z[0] * z[0] + z[1] * z[1];
    let largest = v.iter().max_by(|p, q| size(p).total_cmp(&size(q)));
    let Some(&[re, im]) = largest else {
        return v;
    };
    let s = re * re + im * im;
    if s == 0.0 {
        return v;
    }
    v.iter()
        .map(|z| [(z[0] * re + z[1] * im) / s, (z[1] * re - z[0] * im) / s])
        .collect()
}
