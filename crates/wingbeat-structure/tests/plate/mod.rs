//! A structure of shells alone, small enough to read: assembly, a banded solver, Newton, subspace iteration. It shares
//! nothing with the solvers of the crate.
#![allow(dead_code)] // each test binary uses its part

use faer::{Mat, Side};
use wingbeat_math::{DVec3, MassProperties, tilde};
use wingbeat_structure::shell::ShellSection;
use wingbeat_structure::{Configuration, Element, ElementForces, Lamina, Shell, ShellMesh};

/// Six numbers of a node held or not.
pub const CLAMPED: [bool; 6] = [true; 6];
pub const FREE: [bool; 6] = [false; 6];

/// An orthotropic sheet with fibres askew.
pub fn askew(thickness: f64) -> Lamina {
    Lamina {
        young: [1.0, 0.4],
        poisson: 0.3,
        shear: 0.2,
        thickness,
        density: 1.0,
        added_mass: 0.5,
        axis: DVec3::new(0.8, 0.6, 0.1),
        prestress: [0.0; 3],
    }
}

/// Shells on nodes of which some numbers are held.
pub struct Plate {
    pub rest: Configuration,
    pub shells: Vec<Shell>,
    pub masses: Vec<MassProperties>,
    /// Number of each unknown among those that are free.
    free: Vec<Option<usize>>,
    count: usize,
    half: usize,
}

/// A lattice of rows x cols panels, points by natural coordinates in (0, 1)^2 (row, column).
pub fn lattice(rows: usize, cols: usize, at: impl Fn(f64, f64) -> DVec3) -> ShellMesh {
    let points: Vec<DVec3> = (0..(rows + 1) * (cols + 1))
        .map(|k| (k / (cols + 1), k % (cols + 1)))
        .map(|(i, j)| at(i as f64 / rows as f64, j as f64 / cols as f64))
        .collect();
    ShellMesh::grid(&points, rows, cols).expect("a lattice")
}

/// A plate a x b in the 1-2 plane, rows along axis 2.
pub fn rectangle(rows: usize, cols: usize, a: f64, b: f64) -> ShellMesh {
    lattice(rows, cols, |r, c| DVec3::new(a * c, b * r, 0.0))
}

impl Plate {
    /// With one section; `held` says of each place what is held.
    pub fn new(mesh: &ShellMesh, section: ShellSection, held: impl Fn(DVec3) -> [bool; 6]) -> Self {
        let shells = mesh.shells(|_| Some(section)).expect("shells");
        Self::of(mesh.rest.clone(), shells, held)
    }

    pub fn of(rest: Configuration, shells: Vec<Shell>, held: impl Fn(DVec3) -> [bool; 6]) -> Self {
        let mut masses = vec![MassProperties::ZERO; rest.len()];
        shells.iter().for_each(|s| s.add_mass(&rest, &mut masses));
        let mut count = 0;
        let number = |held: bool| {
            (!held).then(|| {
                count += 1;
                count - 1
            })
        };
        let free: Vec<_> = rest
            .position
            .iter()
            .flat_map(|x| held(*x))
            .map(number)
            .collect();
        let mut plate = Self {
            rest,
            shells,
            masses,
            free,
            count,
            half: 0,
        };
        plate.half = plate
            .shells
            .iter()
            .map(|s| plate.spread(s))
            .max()
            .expect("a shell");
        plate
    }

    /// Largest distance of two unknowns of an element.
    fn spread(&self, shell: &Shell) -> usize {
        let nodes = shell.nodes().iter();
        let all: Vec<_> = nodes
            .flat_map(|n| &self.free[6 * n..6 * n + 6])
            .flatten()
            .collect();
        match (all.iter().max(), all.iter().min()) {
            (Some(a), Some(b)) => **a - **b,
            _ => 0,
        }
    }

    /// Energy, internal force of all numbers, tangent of the free ones.
    pub fn assemble(&self, at: &Configuration) -> (f64, Vec<f64>, Band) {
        let mut force = vec![0.0; 6 * at.len()];
        let mut band = Band::new(self.count, self.half);
        let (mut out, mut energy) = (ElementForces::default(), 0.0);
        for shell in &self.shells {
            energy += shell.internal(at, true, &mut out);
            let numbers: Vec<usize> = shell
                .nodes()
                .iter()
                .flat_map(|n| 6 * n..6 * n + 6)
                .collect();
            for (i, p) in numbers.iter().enumerate() {
                force[*p] += out.force[i];
                for (j, q) in numbers.iter().enumerate() {
                    if let (Some(r), Some(c)) = (self.free[*p], self.free[*q]) {
                        *band.at(r, c) += out.tangent[i * numbers.len() + j];
                    }
                }
            }
        }
        (energy, force, band)
    }

    /// Equilibrium under `load` (force in W, moment in node components, of all numbers) by Newton in equal steps of it;
    /// the configuration and the passes of the last step.
    pub fn equilibrium(
        &self,
        load: &dyn Fn(f64, &Configuration) -> Vec<f64>,
        steps: usize,
    ) -> (Configuration, usize) {
        let mut at = self.rest.clone();
        let mut passes = 0;
        for step in 1..=steps {
            passes = self.newton(&mut at, &|c| load(step as f64 / steps as f64, c));
        }
        (at, passes)
    }

    fn newton(&self, at: &mut Configuration, load: &dyn Fn(&Configuration) -> Vec<f64>) -> usize {
        let mut last = f64::INFINITY;
        for pass in 1..60 {
            let (_, force, mut band) = self.assemble(at);
            let mut d = vec![0.0; self.count];
            for ((free, f), p) in self.free.iter().zip(&force).zip(load(at)) {
                if let Some(k) = free {
                    d[*k] = p - f;
                }
            }
            band.factor();
            band.solve(&mut d);
            let size = d.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let all: Vec<f64> = self.free.iter().map(|k| k.map_or(0.0, |k| d[k])).collect();
            at.moved(&all);
            // Quadratic convergence: below 1e-7 the next change is round-off; or it stands.
            if size < 1e-9 || (size < 1e-6 && size > 0.5 * last) {
                return pass;
            }
            last = size;
        }
        panic!("Newton's iteration does not converge: last change {last:e}");
    }

    /// Displacements of all numbers under a small load.
    pub fn linear(&self, load: &[f64]) -> Vec<f64> {
        let (_, _, mut band) = self.assemble(&self.rest);
        let mut d = vec![0.0; self.count];
        for (free, p) in self.free.iter().zip(load) {
            if let Some(k) = free {
                d[*k] = *p;
            }
        }
        band.factor();
        band.solve(&mut d);
        self.free.iter().map(|k| k.map_or(0.0, |k| d[k])).collect()
    }

    /// The lowest circular frequencies \[rad/s\] at rest, `shift` added to K as shift x M.
    pub fn frequencies(&self, count: usize, shift: f64) -> Vec<f64> {
        let (_, _, mut band) = self.assemble(&self.rest);
        if shift != 0.0 {
            for n in 0..self.rest.len() {
                let m = self.node_mass(n);
                for (a, b) in (0..36).map(|k| (k / 6, k % 6)) {
                    if let (Some(r), Some(c)) = (self.free[6 * n + a], self.free[6 * n + b]) {
                        *band.at(r, c) += shift * m[a][b];
                    }
                }
            }
        }
        band.factor();
        let size = (2 * count).max(count + 8).min(self.count);
        let mut x: Vec<Vec<f64>> = (0..size)
            .map(|s| {
                (0..self.count)
                    .map(|k| (0.37 * ((k + 1) * (s + 3)) as f64 + (k * k % 97) as f64).sin())
                    .collect()
            })
            .collect();
        let mut values = vec![];
        for _ in 0..60 {
            let mx: Vec<Vec<f64>> = x.iter().map(|v| self.mass_times(v)).collect();
            let mut y = mx.clone();
            y.iter_mut().for_each(|v| band.solve(v));
            let my: Vec<Vec<f64>> = y.iter().map(|v| self.mass_times(v)).collect();
            let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
            // Ritz values of K^-1 M in the space of y: Y^T K Y = Y^T M X.
            let k = Mat::from_fn(size, size, |i, j| {
                0.5 * (dot(&y[i], &mx[j]) + dot(&y[j], &mx[i]))
            });
            let m = Mat::from_fn(size, size, |i, j| dot(&y[i], &my[j]));
            let (found, vectors) = pencil(&k, &m);
            x = (0..size)
                .map(|s| {
                    (0..self.count)
                        .map(|r| (0..size).map(|j| y[j][r] * vectors[(j, s)]).sum())
                        .collect()
                })
                .collect();
            let done = values.len() == size
                && (0..count).all(|i: usize| {
                    let (a, b): (f64, f64) = (values[i], found[i]);
                    (a - b).abs() < 1e-11 * b.abs()
                });
            values = found;
            if done {
                break;
            }
        }
        values[..count]
            .iter()
            .map(|l| (l - shift).max(0.0).sqrt())
            .collect()
    }

    /// Mass matrix of a node: place in W, turn in node components.
    fn node_mass(&self, n: usize) -> [[f64; 6]; 6] {
        let p = &self.masses[n];
        let r = wingbeat_math::DMat3::from_quat(self.rest.rotation[n]);
        let s = r * tilde(p.first_moment);
        std::array::from_fn(|a| {
            std::array::from_fn(|b| match (a < 3, b < 3) {
                (true, true) => {
                    if a == b {
                        p.mass
                    } else {
                        0.0
                    }
                }
                (true, false) => -s.col(b - 3)[a],
                (false, true) => -s.col(a - 3)[b],
                (false, false) => p.inertia.col(b - 3)[a - 3],
            })
        })
    }

    fn mass_times(&self, v: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.count];
        for n in 0..self.rest.len() {
            let m = self.node_mass(n);
            for a in 0..6 {
                let Some(r) = self.free[6 * n + a] else {
                    continue;
                };
                out[r] = (0..6)
                    .filter_map(|b| self.free[6 * n + b].map(|c| m[a][b] * v[c]))
                    .sum();
            }
        }
        out
    }

    /// The node nearest to a place.
    pub fn near(&self, x: DVec3) -> usize {
        let all = 0..self.rest.len();
        all.min_by(|&a, &b| {
            let [p, q] = [a, b].map(|n| self.rest.position[n].distance(x));
            p.total_cmp(&q)
        })
        .expect("a node")
    }
}

/// Eigenvalues, ascending, and vectors of `k x = l m x`.
fn pencil(k: &Mat<f64>, m: &Mat<f64>) -> (Vec<f64>, Mat<f64>) {
    let n = k.nrows();
    let scale: Vec<f64> = (0..n).map(|i| 1.0 / m[(i, i)].sqrt()).collect();
    let m = Mat::from_fn(n, n, |i, j| m[(i, j)] * scale[i] * scale[j]);
    let k = Mat::from_fn(n, n, |i, j| k[(i, j)] * scale[i] * scale[j]);
    // Inverse square root of the mass, directions that have none left out by making them stiff.
    let e = m.self_adjoint_eigen(Side::Lower).expect("eigenvalues");
    let largest = e.S()[n - 1];
    let root = Mat::from_fn(n, n, |i, j| {
        e.U()[(i, j)] / e.S()[j].max(1e-13 * largest).sqrt()
    });
    let reduced = root.transpose() * &k * &root;
    let f = reduced
        .self_adjoint_eigen(Side::Lower)
        .expect("eigenvalues");
    let vectors = &root * f.U();
    let vectors = Mat::from_fn(n, n, |i, j| scale[i] * vectors[(i, j)]);
    ((0..n).map(|i| f.S()[i]).collect(), vectors)
}

/// A banded matrix by rows and its factors without pivoting.
pub struct Band {
    n: usize,
    half: usize,
    rows: Vec<f64>,
}

impl Band {
    fn new(n: usize, half: usize) -> Self {
        Self {
            n,
            half,
            rows: vec![0.0; n * (2 * half + 1)],
        }
    }

    pub fn at(&mut self, r: usize, c: usize) -> &mut f64 {
        &mut self.rows[r * (2 * self.half + 1) + c + self.half - r]
    }

    /// The product with a vector.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let (w, h) = (2 * self.half + 1, self.half);
        let row = |r: usize| (r.saturating_sub(h)..=(r + h).min(self.n - 1)).map(move |c| (r, c));
        let product = |(r, c): (usize, usize)| self.rows[r * w + c + h - r] * x[c];
        (0..self.n).map(|r| row(r).map(product).sum()).collect()
    }

    fn factor(&mut self) {
        let (w, h) = (2 * self.half + 1, self.half);
        for k in 0..self.n {
            let pivot = self.rows[k * w + h];
            assert!(pivot != 0.0 && pivot.is_finite(), "pivot {k} is {pivot:e}");
            let reach = h.min(self.n - 1 - k);
            let (upper, lower) = self.rows.split_at_mut((k + 1) * w);
            let source = &upper[k * w + h + 1..k * w + h + 1 + reach];
            for d in 1..=reach {
                let row = &mut lower[(d - 1) * w..d * w];
                let factor = row[h - d] / pivot;
                row[h - d] = factor;
                if factor != 0.0 {
                    let target = &mut row[h - d + 1..h - d + 1 + reach];
                    target
                        .iter_mut()
                        .zip(source)
                        .for_each(|(t, s)| *t -= factor * s);
                }
            }
        }
    }

    fn solve(&self, x: &mut [f64]) {
        let (w, h) = (2 * self.half + 1, self.half);
        for r in 0..self.n {
            let first = r.saturating_sub(h);
            let row = &self.rows[r * w + first + h - r..r * w + h];
            let sum: f64 = row.iter().zip(&x[first..r]).map(|(a, b)| a * b).sum();
            x[r] -= sum;
        }
        for r in (0..self.n).rev() {
            let last = (r + h).min(self.n - 1);
            let row = &self.rows[r * w + h + 1..r * w + h + 1 + last - r];
            let sum: f64 = row.iter().zip(&x[r + 1..=last]).map(|(a, b)| a * b).sum();
            x[r] = (x[r] - sum) / self.rows[r * w + h];
        }
    }
}
