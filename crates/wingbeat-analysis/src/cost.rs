//! Seconds that the steps of a flight take: what a step costs, as a function of the wake, fitted to the steps
//! made so far and summed over those to come.
//!
//! ```text
//! cost(n) = a + b n + c n^p        n: rings and particles of the wake; a, b, c >= 0
//! ```
//!
//! Without a wake the cost is the constant a. Panels and wake meet in b n, the wake moves itself in
//! c n^p: p = 2 where filaments are summed one by one (a tree shows as a smaller c), 3/2 where they
//! become blobs or particles. Steps count by their relative error, older ones less the older they
//! are. The first steps cannot tell b from c, so a trial sum over the present wake says what c will
//! be near ([`CostModel::expect`]); as the wake grows the steps themselves decide.

/// Relative scatter of the time of a step.
const SCATTER: f64 = 0.25;
/// Relative error of a measured c.
const TRIAL_ERROR: f64 = 0.35;
/// The weight of a step falls with its age as `(its number / steps so far)^FADING`.
const FADING: f64 = 2.0;

/// The cost of a step.
#[derive(Clone, Debug)]
pub struct CostModel {
    /// Exponent of the wake's own part.
    power: f64,
    /// Wake elements of the largest wake seen: the unit of n.
    unit: f64,
    /// Normal equations of the fit in the basis (1, n, n^p).
    matrix: [[f64; 3]; 3],
    right: [f64; 3],
    /// Sum of the weighted squares of the seconds; steps that count, old ones for less than one.
    square: f64,
    counted: f64,
    steps: usize,
    /// Cost of the last steps, for the weights \[s\].
    usual: f64,
    /// c by a trial \[s\], with n counted one by one.
    expected: Option<f64>,
}

impl CostModel {
    /// For wakes whose own part of the cost grows with this power of their elements.
    pub fn new(power: f64) -> Self {
        Self {
            power,
            unit: 1.0,
            matrix: [[0.0; 3]; 3],
            right: [0.0; 3],
            square: 0.0,
            counted: 0.0,
            steps: 0,
            usual: 0.0,
            expected: None,
        }
    }

    fn basis(&self, n: f64) -> [f64; 3] {
        let x = n / self.unit;
        [1.0, x, x.powf(self.power)]
    }

    /// Takes a step that began with `n` wake elements and took `seconds` \[s\].
    pub fn step(&mut self, n: f64, seconds: f64) {
        let seconds = seconds.max(1e-9);
        self.rescale(n);
        self.steps += 1;
        let count = self.steps as f64;
        self.usual += (seconds - self.usual) * (1.0 / count).max(0.1);
        let weight = (SCATTER * self.usual).powi(-2);
        let kept = (1.0 - FADING / count).max(0.0);
        self.square = kept * self.square + weight * seconds * seconds;
        self.counted = kept * self.counted + 1.0;
        let basis = self.basis(n);
        for i in 0..3 {
            self.right[i] = kept * self.right[i] + weight * basis[i] * seconds;
            for j in 0..3 {
                self.matrix[i][j] = kept * self.matrix[i][j] + weight * basis[i] * basis[j];
            }
        }
    }

    /// Counts n in another unit when a larger wake comes, so that the equations stay well scaled.
    fn rescale(&mut self, n: f64) {
        if n <= self.unit {
            return;
        }
        let x = self.unit / n;
        let factor = [1.0, x, x.powf(self.power)];
        self.unit = n;
        for i in 0..3 {
            self.right[i] *= factor[i];
            for j in 0..3 {
                self.matrix[i][j] *= factor[i] * factor[j];
            }
        }
    }

    /// Takes what a trial says the wake's own part costs: `seconds` \[s\] for `n` elements.
    pub fn expect(&mut self, n: f64, seconds: f64) {
        self.expected = Some(seconds / n.powf(self.power));
    }

    /// What steps will take \[s\]: pairs of wake elements at their beginning and number of steps.
    pub fn cost(&self, wakes: impl Iterator<Item = [f64; 2]>) -> f64 {
        let (mut matrix, mut right, mut square) = (self.matrix, self.right, self.square);
        if let Some(c) = self.expected.map(|c| c * self.unit.powf(self.power)) {
            let weight = (TRIAL_ERROR * c).powi(-2);
            matrix[2][2] += weight;
            right[2] += weight * c;
            square += weight * c * c;
        }
        let fit = terms(&matrix, &right, square, self.counted);
        let one = |n: f64| -> f64 { fit.iter().zip(self.basis(n)).map(|(f, b)| f * b).sum() };
        wakes.map(|[n, steps]| steps * one(n)).sum()
    }
}

/// Which of the three are free, in bits, fewer first.
const CHOICES: [usize; 7] = [0b001, 0b010, 0b100, 0b011, 0b101, 0b110, 0b111];
/// Scatter of steps that follow a law exactly, relative: rounding.
const MIN_SCATTER: f64 = 1e-7;

/// The terms of the law and their factors: of all choices which of the three are zero and whose others
/// come out positive, the one with the least Bayesian information criterion (Schwarz 1978),
/// `sum / scatter^2 + terms ln(steps)`, where the best fit of all says what the scatter is. A term that
/// only follows the scatter would be carried far ahead.
fn terms(matrix: &[[f64; 3]; 3], right: &[f64; 3], square: f64, steps: f64) -> [f64; 3] {
    let mut fits = vec![];
    for free in CHOICES {
        let is_free = |i: usize| free >> i & 1 == 1;
        let Some(x) = solved(matrix, right, is_free) else {
            continue;
        };
        if x.iter().all(|x| *x >= 0.0) {
            let fitted: f64 = (0..3).map(|i| x[i] * right[i]).sum();
            fits.push((square - fitted, f64::from(free.count_ones()), x));
        }
    }
    let least = fits.iter().map(|f| f.0).fold(f64::INFINITY, f64::min);
    let scatter = (least / steps).max(MIN_SCATTER * MIN_SCATTER * square / steps);
    let criterion = |(sum, terms, _): &(f64, f64, _)| sum / scatter + terms * steps.ln();
    let best = fits
        .iter()
        .min_by(|f, g| criterion(f).total_cmp(&criterion(g)));
    best.map_or([0.0; 3], |f| f.2)
}

/// `M x = r` with the unknowns that are not free at zero; none where it is singular.
fn solved(
    matrix: &[[f64; 3]; 3],
    right: &[f64; 3],
    is_free: impl Fn(usize) -> bool,
) -> Option<[f64; 3]> {
    let chosen: Vec<usize> = (0..3).filter(|i| is_free(*i)).collect();
    let pairs = chosen
        .iter()
        .flat_map(|i| chosen.iter().map(move |j| (*i, *j)));
    let mut m: Vec<f64> = pairs.map(|(i, j)| matrix[i][j]).collect();
    let mut x: Vec<f64> = chosen.iter().map(|i| right[*i]).collect();
    wingbeat_math::solve_small(&mut m, &mut x).ok()?;
    let mut all = [0.0; 3];
    for (i, x) in chosen.into_iter().zip(x) {
        all[i] = x;
    }
    all.iter().all(|x| x.is_finite()).then_some(all)
}

/// How the wake goes on: it grows as in the last steps until it is as large as the case allows.
#[derive(Clone, Copy, Debug)]
pub struct WakeGrowth {
    /// Steps after which the oldest row of a wake is dropped; none keeps all.
    kept_steps: Option<usize>,
    /// Elements at the newest step.
    now: f64,
    /// Elements per step.
    rate: f64,
    /// Largest rate so far: of a wake that drops nothing yet.
    full_rate: f64,
}

/// Steps over which growth is averaged.
const GROWTH_STEPS: f64 = 16.0;
/// Groups of steps ahead: enough for sums of squares to a thousandth.
const GROUPS: usize = 64;

impl WakeGrowth {
    /// Of a wake that has nothing yet and drops its rows after `kept_steps` steps.
    pub fn new(kept_steps: Option<usize>) -> Self {
        Self {
            kept_steps,
            now: 0.0,
            rate: 0.0,
            full_rate: 0.0,
        }
    }

    /// Elements at the newest step.
    pub fn now(&self) -> f64 {
        self.now
    }

    /// Takes the elements after a step.
    pub fn step(&mut self, n: f64) {
        let grown = n - self.now;
        self.now = n;
        self.rate += (grown - self.rate) / GROWTH_STEPS;
        if self.full_rate == 0.0 {
            self.rate = grown;
        }
        self.full_rate = self.full_rate.max(self.rate);
    }

    /// The next `steps` steps in groups: elements at the beginning of a middle step, steps.
    pub fn ahead(self, steps: usize) -> impl Iterator<Item = [f64; 2]> {
        let most = match self.kept_steps {
            Some(kept) => (self.full_rate * kept as f64).max(self.now),
            None => f64::INFINITY,
        };
        let groups = steps.min(GROUPS);
        let length = steps as f64 / groups.max(1) as f64;
        (0..groups).map(move |k| {
            let ahead = (k as f64 + 0.5) * length - 0.5;
            [(self.now + self.rate * ahead).clamp(0.0, most), length]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest factor between seconds left as told and as they come, from a tenth of the run on.
    fn worst(cost: impl Fn(f64) -> f64, kept: Option<usize>, trial: Option<f64>) -> f64 {
        const STEPS: usize = 200;
        let wake = |k: usize| 50.0 * k.min(kept.unwrap_or(STEPS)) as f64;
        // Steps scatter by a fifth, the same way every time.
        let noise = |k: usize| 1.0 + 0.2 * (k as f64 * 2.399).sin();
        let seconds = |k: usize| cost(wake(k)) * noise(k);
        let (mut model, mut growth) = (CostModel::new(2.0), WakeGrowth::new(kept));
        let mut worst = 1.0_f64;
        for k in 0..STEPS - 2 {
            model.step(wake(k), seconds(k));
            growth.step(wake(k + 1));
            if let Some(c) = trial.filter(|_| k == STEPS / 20) {
                model.expect(wake(k), c * wake(k) * wake(k));
            }
            if k + 1 >= STEPS / 10 {
                let told = model.cost(growth.ahead(STEPS - k - 1));
                let left: f64 = (k + 1..STEPS).map(seconds).sum();
                worst = worst.max(told / left).max(left / told);
            }
        }
        worst
    }

    #[test]
    fn behaves_seconds_left_are_within_a_factor_of_one_and_a_half() {
        // Blade elements; a lattice at five and at one corrector passes (measured: seconds per step,
        // per element, per pair); a wake that is cut at sixty rows.
        assert!(worst(|_| 2e-4, None, None) < 1.3);
        let passes = |n: f64| 2e-3 + 1e-5 * n + 1.5e-9 * n * n;
        assert!(worst(passes, None, Some(1.5e-9)) < 1.3);
        assert!(worst(passes, None, Some(2.1e-9)) < 1.5);
        let one = |n: f64| 1e-3 + 3e-6 * n + 2e-9 * n * n;
        assert!(worst(one, None, Some(2e-9)) < 1.3);
        assert!(worst(one, Some(60), Some(2e-9)) < 1.4);
        // Steps so far over time so far, as bars have it, is wrong by more than 10 here.
        let mean = |k: usize| (0..k).map(|k| one(50.0 * k as f64)).sum::<f64>() / k as f64;
        let left: f64 = (20..200).map(|k| one(50.0 * f64::from(k))).sum();
        assert!(left / (180.0 * mean(20)) > 10.0);
    }

    #[test]
    fn exact_costs_that_follow_the_law_are_told_to_rounding() {
        let law = |n: f64| 0.5 + 2e-3 * n + 3e-6 * n * n;
        let mut model = CostModel::new(2.0);
        (0..100).for_each(|k| model.step(f64::from(k), law(f64::from(k))));
        let told = model.cost([[1000.0, 1.0]].into_iter());
        // Condition of the normal equations times rounding.
        assert!((told / law(1000.0) - 1.0).abs() < 1e-8, "{told}");
    }
}
