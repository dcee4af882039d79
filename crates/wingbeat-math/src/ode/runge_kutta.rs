//! The classical fourth-order Runge-Kutta method.

/// The method with its scratch.
#[derive(Clone, Debug)]
pub struct Rk4 {
    k: [Vec<f64>; 4],
    stage: Vec<f64>,
}

impl Rk4 {
    /// For states of `dim` components.
    pub fn new(dim: usize) -> Self {
        Self {
            k: std::array::from_fn(|_| vec![0.0; dim]),
            stage: vec![0.0; dim],
        }
    }

    /// One step of size `h` [s] from time `t` [s]; `y` moves on.
    ///
    /// # Errors
    /// The right-hand side `f(t, y, dy)` fails; `y` is then unchanged.
    pub fn advance<E>(
        &mut self,
        t: f64,
        h: f64,
        y: &mut [f64],
        mut f: impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        f(t, y, &mut self.k[0])?;
        for (stage, c) in [(1, 0.5), (2, 0.5), (3, 1.0)] {
            for i in 0..y.len() {
                self.stage[i] = y[i] + c * h * self.k[stage - 1][i];
            }
            f(t + c * h, &self.stage, &mut self.k[stage])?;
        }
        let [k1, k2, k3, k4] = &self.k;
        for i in 0..y.len() {
            y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
        Ok(())
    }
}
