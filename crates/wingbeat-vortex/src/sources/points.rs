//! Points in space.

use glam::DVec3;

/// Positions \[m\] or velocities \[m/s\], frame N, one array per component.
#[derive(Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Points {
    /// Components along n1.
    pub x: Vec<f64>,
    /// Components along n2.
    pub y: Vec<f64>,
    /// Components along n3.
    pub z: Vec<f64>,
    /// Squared core radius \[m2\] of places where velocities are wanted for vorticity of that core
    /// ([`crate::CoreModel::Algebraic`]); empty: all are points.
    #[serde(skip)]
    pub core: Vec<f64>,
}

impl Points {
    /// `n` points at zero.
    pub fn zeros(n: usize) -> Self {
        Self {
            x: vec![0.0; n],
            y: vec![0.0; n],
            z: vec![0.0; n],
            core: Vec::new(),
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// True when there is no point.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Point `i`.
    pub fn get(&self, i: usize) -> DVec3 {
        DVec3::new(self.x[i], self.y[i], self.z[i])
    }

    /// What softens distances from point `i`: half its squared core radius \[m2\], nothing at a bare point.
    pub(crate) fn softening(&self, i: usize) -> f64 {
        self.core.get(i).map_or(0.0, |core| 0.5 * core)
    }

    /// Overwrites point `i`.
    pub fn set(&mut self, i: usize, p: DVec3) {
        (self.x[i], self.y[i], self.z[i]) = (p.x, p.y, p.z);
    }

    /// Adds `p` to point `i`.
    pub fn add(&mut self, i: usize, p: DVec3) {
        self.set(i, self.get(i) + p);
    }

    /// Appends a point.
    pub fn push(&mut self, p: DVec3) {
        self.x.push(p.x);
        self.y.push(p.y);
        self.z.push(p.z);
    }

    /// Appends a place of this squared core radius \[m2\]; all of them have one, or none.
    pub fn push_with_core(&mut self, p: DVec3, core: f64) {
        debug_assert_eq!(self.core.len(), self.len());
        self.push(p);
        self.core.push(core);
    }

    /// Removes all points and keeps the memory.
    pub fn clear(&mut self) {
        self.x.clear();
        self.y.clear();
        self.z.clear();
        self.core.clear();
    }

    /// Drops all points but the first `n` and keeps the memory.
    pub fn truncate(&mut self, n: usize) {
        for c in [&mut self.x, &mut self.y, &mut self.z, &mut self.core] {
            c.truncate(n);
        }
    }

    /// Makes it `n` points, all zero, and keeps the memory.
    pub fn reset(&mut self, n: usize) {
        for c in [&mut self.x, &mut self.y, &mut self.z] {
            c.clear();
            c.resize(n, 0.0);
        }
        self.core.clear();
    }

    /// Whether these are the places of `other`, whatever their cores.
    pub fn has_places_of(&self, other: &Self) -> bool {
        self.x == other.x && self.y == other.y && self.z == other.z
    }

    /// Whether the cores are as many as those of `other` and no radius differs by more than `near` \[m\].
    pub fn has_cores_near(&self, other: &Self, near: f64) -> bool {
        let is_near =
            |(a, b): (&f64, &f64)| a == b || near > 0.0 && (a.sqrt() - b.sqrt()).abs() <= near;
        self.core.len() == other.core.len() && self.core.iter().zip(&other.core).all(is_near)
    }

    /// Appends the points of `other`, with their cores; either both have some, or none.
    pub fn append(&mut self, other: &Self) {
        let is_alike = self.core.is_empty() == other.core.is_empty();
        debug_assert!(
            self.is_empty() || other.is_empty() || is_alike,
            "cores of some points"
        );
        self.x.extend_from_slice(&other.x);
        self.y.extend_from_slice(&other.y);
        self.z.extend_from_slice(&other.z);
        self.core.extend_from_slice(&other.core);
    }

    /// The points in order.
    pub fn iter(&self) -> impl Iterator<Item = DVec3> + '_ {
        (0..self.len()).map(|i| self.get(i))
    }
}

impl Clone for Points {
    fn clone(&self) -> Self {
        Self {
            x: self.x.clone(),
            y: self.y.clone(),
            z: self.z.clone(),
            core: self.core.clone(),
        }
    }

    /// Keeps the memory.
    fn clone_from(&mut self, other: &Self) {
        self.x.clone_from(&other.x);
        self.y.clone_from(&other.y);
        self.z.clone_from(&other.z);
        self.core.clone_from(&other.core);
    }
}

impl FromIterator<DVec3> for Points {
    fn from_iter<I: IntoIterator<Item = DVec3>>(iter: I) -> Self {
        let mut points = Self::default();
        iter.into_iter().for_each(|p| points.push(p));
        points
    }
}
