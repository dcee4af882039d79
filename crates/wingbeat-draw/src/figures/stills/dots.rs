//! Vortex particles as dots.

use crate::figures::drawing::{COLOURS, Colour, Drawing};
use wingbeat_results::particles::Cloud;

/// Corners of a dot: there are many, and they are small.
const CORNERS: usize = 8;

/// Weaker filaments and particles, relative to the usual, are not drawn.
pub(crate) const FAINTEST: f64 = 0.06;

/// Vortex particles, weak ones first: places, and strengths over that which few particles exceed.
pub(crate) struct Dots {
    pub list: Vec<([f64; 3], f64)>,
    /// The strength the others are counted in \[m3/s\].
    pub usual: f64,
    /// Particles that were left out.
    pub left_out: usize,
}

impl Dots {
    /// The `most` strongest of a cloud.
    pub fn strongest(cloud: &Cloud, most: usize) -> Self {
        let sizes: Vec<f64> = cloud.sizes().collect();
        let kept = cloud.strongest(most);
        let left_out = cloud.len() - kept.len();
        let mut list: Vec<([f64; 3], f64)> =
            kept.iter().map(|&k| (cloud.points[k], sizes[k])).collect();
        list.sort_by(|a, b| a.1.total_cmp(&b.1));
        let usual = list.get(list.len() * 19 / 20).map_or(0.0, |d| d.1);
        let usual = if usual > 0.0 { usual } else { 1.0 };
        list.retain(|d| d.1 > FAINTEST * usual);
        for dot in &mut list {
            dot.1 = (dot.1 / usual).min(1.0);
        }
        Self {
            list,
            usual,
            left_out,
        }
    }

    /// Draws them where `flat` puts them, the strongest with this radius \[points\].
    pub fn draw(&self, to: &mut Drawing, flat: impl Fn([f64; 3]) -> [f64; 2], radius: f64) {
        for (place, strength) in &self.list {
            let radius = radius * (0.5 + 0.5 * strength);
            to.disk(flat(*place), radius, dye(*strength), CORNERS);
        }
    }
}

/// From pale to vermilion, the stronger the darker.
pub(crate) fn dye(strength: f64) -> Colour {
    Colour(244, 228, 216).toward(COLOURS[1], strength)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_dots_are_the_strongest_particles_weak_ones_first() {
        let cloud = Cloud {
            points: (0..40).map(|k| [k as f64, 0.0, 0.0]).collect(),
            strength: (0..40).map(|k| [0.0, (40 - k) as f64, 0.0]).collect(),
            ..Cloud::default()
        };
        let dots = Dots::strongest(&cloud, 20);
        assert_eq!((dots.list.len(), dots.left_out, dots.usual), (20, 20, 40.0));
        assert_eq!(dots.list[0], ([19.0, 0.0, 0.0], 21.0 / 40.0));
        assert_eq!(dots.list[19], ([0.0; 3], 1.0));
        assert!(Dots::strongest(&Cloud::default(), 5).list.is_empty());
    }
}
