//! Banded or dense matrices of the free numbers and their LU factors.

use wingbeat_math::{DenseLu, LuError};

/// A square matrix, banded or dense, and room for its factors. Rows and columns are scaled before
/// factorisation, so that metres and radians, and stiff and soft directions, weigh alike.
pub(crate) struct Matrix {
    n: usize,
    /// Largest distance of an entry from the diagonal.
    band: usize,
    dense: Option<Dense>,
    /// Room for dense ones while the matrix is banded.
    spare: Option<Dense>,
    /// Rows of `3 band + 1` columns, the diagonal at `band`; factors overwrite them.
    rows: Vec<f64>,
    scale: Vec<f64>,
    pivots: Vec<usize>,
}

/// Rows of n columns, and factors.
struct Dense {
    rows: Vec<f64>,
    lu: DenseLu,
}

impl Dense {
    fn new(n: usize) -> Self {
        Self {
            rows: vec![0.0; n * n],
            lu: DenseLu::new(n),
        }
    }
}

impl std::fmt::Debug for Matrix {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Matrix {{ n: {}, band: {} }}", self.n, self.band)
    }
}

impl Matrix {
    /// Room for a matrix of order n.
    pub fn new(n: usize, band: usize) -> Self {
        Self {
            n,
            band,
            dense: None,
            spare: None,
            rows: vec![0.0; n * (3 * band + 1)],
            scale: vec![1.0; n],
            pivots: vec![0; n],
        }
    }

    /// Sets all entries to zero; `dense` says whether any entry may differ from zero then.
    pub fn clear(&mut self, dense: bool) {
        let room = self.dense.take().or_else(|| self.spare.take());
        if dense {
            let room = room.unwrap_or_else(|| Dense::new(self.n));
            self.dense.insert(room).rows.fill(0.0);
        } else {
            self.spare = room;
            self.rows.fill(0.0);
        }
    }

    fn place(&self, i: usize, j: usize) -> usize {
        i * (3 * self.band + 1) + j + self.band - i
    }

    /// Adds to an entry.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        match &mut self.dense {
            Some(d) => d.rows[i * self.n + j] += value,
            None => {
                debug_assert!(i.abs_diff(j) <= self.band, "({i}, {j}) is outside the band");
                let k = self.place(i, j);
                self.rows[k] += value;
            }
        }
    }

    /// All entries by rows, where the matrix is dense.
    pub fn rows(&self) -> &[f64] {
        self.dense.as_ref().map_or(&[], |d| &d.rows)
    }

    /// Factorises in place.
    ///
    /// # Errors
    /// Index of the row or column without a pivot.
    pub fn factor(&mut self) -> Result<(), usize> {
        self.find_scale();
        match &mut self.dense {
            Some(d) => {
                let n = self.n;
                for (k, a) in d.rows.iter_mut().enumerate() {
                    *a *= self.scale[k / n] * self.scale[k % n];
                }
                d.lu.factor(&d.rows).map_err(|e| match e {
                    LuError::Singular { index, .. } => index,
                    LuError::NotFinite { row, .. } => row,
                })
            }
            None => self.factor_band(),
        }
    }

    /// `1 / sqrt |diagonal|`.
    fn find_scale(&mut self) {
        for i in 0..self.n {
            let d = match &self.dense {
                Some(d) => d.rows[i * (self.n + 1)],
                None => self.rows[self.place(i, i)],
            };
            self.scale[i] = if d == 0.0 { 1.0 } else { 1.0 / d.abs().sqrt() };
        }
    }

    /// Gaussian elimination with partial pivoting within the band [Golub & Van Loan, Matrix Computations, sec. 4.3.3].
    fn factor_band(&mut self) -> Result<(), usize> {
        let (n, b) = (self.n, self.band);
        for i in 0..n {
            for j in i.saturating_sub(b)..(i + b + 1).min(n) {
                let k = self.place(i, j);
                self.rows[k] *= self.scale[i] * self.scale[j];
            }
        }
        for k in 0..n {
            let last = (k + b + 1).min(n);
            let size = |i: usize| self.rows[self.place(i, k)].abs();
            let pivot = (k..last).fold(k, |p, i| if size(i) > size(p) { i } else { p });
            // The scaled diagonal is one: n roundings of that are nothing.
            let is_sound = size(pivot) > n as f64 * f64::EPSILON && size(pivot).is_finite();
            if !is_sound {
                return Err(k);
            }
            self.pivots[k] = pivot;
            let end = (k + 2 * b + 1).min(n);
            self.exchange(k, pivot, end);
            self.eliminate(k, last, end);
        }
        Ok(())
    }

    fn exchange(&mut self, k: usize, pivot: usize, end: usize) {
        if pivot != k {
            let (a, c) = (self.place(k, k), self.place(pivot, k));
            for j in 0..end - k {
                self.rows.swap(a + j, c + j);
            }
        }
    }

    fn eliminate(&mut self, k: usize, last: usize, end: usize) {
        let (top, columns) = (self.place(k, k), end - k);
        for i in k + 1..last {
            let start = self.place(i, k);
            if self.rows[start] == 0.0 {
                continue;
            }
            let (above, below) = self.rows.split_at_mut(start);
            let factor = below[0] / above[top];
            below[0] = factor;
            let pivot_row = &above[top + 1..top + columns];
            let row = &mut below[1..columns];
            row.iter_mut()
                .zip(pivot_row)
                .for_each(|(x, p)| *x -= factor * p);
        }
    }

    /// Replaces a right-hand side by the solution.
    pub fn solve(&mut self, x: &mut [f64]) {
        x.iter_mut().zip(&self.scale).for_each(|(x, s)| *x *= s);
        match &mut self.dense {
            Some(d) => d.lu.solve_in_place(x),
            None => self.solve_band(x),
        }
        x.iter_mut().zip(&self.scale).for_each(|(x, s)| *x *= s);
    }

    fn solve_band(&self, x: &mut [f64]) {
        let (n, b) = (self.n, self.band);
        for k in 0..n {
            x.swap(k, self.pivots[k]);
            for i in k + 1..(k + b + 1).min(n) {
                x[i] -= self.rows[self.place(i, k)] * x[k];
            }
        }
        for k in (0..n).rev() {
            let start = self.place(k, k);
            let end = (k + 2 * b + 1).min(n);
            let row = &self.rows[start + 1..start + end - k];
            let known: f64 = row.iter().zip(&x[k + 1..end]).map(|(a, x)| a * x).sum();
            x[k] = (x[k] - known) / self.rows[start];
        }
    }
}

/// Nodes in an order that keeps neighbours close [reverse Cuthill-McKee, Proc. 24th ACM Conf., 1969].
pub(crate) fn order(neighbours: &[Vec<usize>]) -> Vec<usize> {
    let n = neighbours.len();
    let degree = |k: &usize| (neighbours[*k].len(), *k);
    let mut seen = vec![false; n];
    let mut sequence: Vec<usize> = Vec::with_capacity(n);
    while sequence.len() < n {
        let Some(start) = (0..n).filter(|&k| !seen[k]).min_by_key(degree) else {
            break;
        };
        let far = farthest(neighbours, start);
        seen[far] = true;
        let mut next = sequence.len();
        sequence.push(far);
        while next < sequence.len() {
            let mut around: Vec<usize> = neighbours[sequence[next]].clone();
            around.retain(|&k| !seen[k]);
            around.sort_by_key(degree);
            around.iter().for_each(|&k| seen[k] = true);
            sequence.extend(around);
            next += 1;
        }
    }
    sequence.reverse();
    sequence
}

/// A node farthest from `start`, of smallest degree there.
fn farthest(neighbours: &[Vec<usize>], start: usize) -> usize {
    let mut level = vec![start];
    let mut seen = vec![false; neighbours.len()];
    seen[start] = true;
    loop {
        let mut next = vec![];
        for &k in level.iter().flat_map(|&k| &neighbours[k]) {
            if !std::mem::replace(&mut seen[k], true) {
                next.push(k);
            }
        }
        if next.is_empty() {
            let least = level.iter().min_by_key(|&&k| (neighbours[k].len(), k));
            return *least.unwrap_or(&start);
        }
        level = next;
    }
}
