//! Displacements that the shapes of a wing are made of: an orthonormal basis over all nodes. What it lacks of
//! the shape that it represents worst joins it, until every node of every shape is within the tolerance (a
//! greedy reduced basis [Quarteroni, Manzoni and Negri 2016, chapter 7]).

use wingbeat_math::DVec3;

/// What the shapes of one wing are made of.
pub(super) struct Basis {
    /// Number of the wing among the surfaces.
    pub surface: usize,
    /// Distance of a node from its place that is let pass \[m\].
    pub tolerance: f64,
    /// Orthonormal over all nodes: displacements, wing axes \[1\].
    targets: Vec<Vec<DVec3>>,
    /// Largest coordinate of a shape along each \[m\].
    largest: Vec<f64>,
    /// Times of the first and the last shape \[s\].
    pub ends: [f64; 2],
    /// Shapes.
    pub count: usize,
    /// What is lacking of the shape that has a node farthest from its place, beyond the tolerance: that
    /// distance, displacements \[m\].
    worst: (f64, Vec<DVec3>),
}

impl Basis {
    pub fn new(surface: usize, tolerance: f64) -> Self {
        Self {
            surface,
            tolerance,
            targets: vec![],
            largest: vec![],
            ends: [0.0; 2],
            count: 0,
            worst: (tolerance, vec![]),
        }
    }

    /// Forgets the shapes that were seen.
    pub fn begin(&mut self) {
        self.count = 0;
        self.largest.fill(0.0);
        self.worst = (self.tolerance, vec![]);
    }

    /// Notes how large a shape is along each vector, and what they lack of it.
    pub fn see(&mut self, time: f64, mut shape: Vec<DVec3>) {
        if self.count == 0 {
            self.ends[0] = time;
        }
        (self.ends[1], self.count) = (time, self.count + 1);
        for (target, largest) in self.targets.iter().zip(&mut self.largest) {
            let along = dot(&shape, target);
            *largest = largest.max(along.abs());
            for (x, t) in shape.iter_mut().zip(target) {
                *x -= along * *t;
            }
        }
        let farthest = shape.iter().map(|x| x.length()).fold(0.0, f64::max);
        if farthest > self.worst.0 {
            self.worst = (farthest, shape);
        }
    }

    /// Takes in what is lacking of the worst shape; whether anything was.
    pub fn grow(&mut self) -> bool {
        let (_, lacking) = std::mem::take(&mut self.worst);
        let size = dot(&lacking, &lacking).sqrt();
        let is_any = size > 0.0;
        if is_any {
            self.targets
                .push(lacking.iter().map(|x| *x / size).collect());
            self.largest.push(0.0);
        }
        is_any
    }

    /// Number of displacements.
    pub fn size(&self) -> usize {
        self.targets.len()
    }

    /// Displacements of the nodes, target by target, wing axes \[m\]; weights are -1 to 1.
    pub fn targets(&self) -> impl Iterator<Item = Vec<DVec3>> {
        let scaled = self.targets.iter().zip(&self.largest);
        scaled.map(|(target, largest)| target.iter().map(|t| *largest * *t).collect())
    }

    /// Weights of a shape, target by target \[1\].
    pub fn weights(&self, shape: &[DVec3]) -> impl Iterator<Item = f32> {
        let scaled = self.targets.iter().zip(&self.largest);
        scaled.map(move |(target, largest)| (dot(shape, target) / largest) as f32)
    }
}

/// Scalar product over all nodes.
fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}
