//! Vortex particles in frames: `particles_STEP.vtp`, points with their strengths, beside the sheets
//! of a flight some of whose wake becomes particles.

use std::path::Path;

use wingbeat_flight::Snapshot;
use wingbeat_math::DVec3;

use crate::snapshots::arrays::{self, arrays, groups};
use crate::snapshots::poses::picture;
use crate::snapshots::vtp::{array, begin, end};
use wingbeat_case::IoError;

/// Names of the numbers of a particle and how many there are of each.
pub const NUMBERS: [(&str, usize); 3] = [("strength_m3_per_s", 3), ("radius_m", 1), ("sheet", 1)];

/// The particles of one instant, picture axes (n1, -n2, -n3).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cloud {
    /// Places \[m\].
    pub points: Vec<[f64; 3]>,
    /// Vorticity times volume \[m3/s\].
    pub strength: Vec<[f64; 3]>,
    /// Radii of the balls over which the vorticity is spread \[m\].
    pub radius: Vec<f64>,
    /// Number of the wake sheet that each was part of \[1\].
    pub sheet: Vec<f64>,
}

impl Cloud {
    /// All particles of a snapshot. Strengths turn with the axes as places do: picture axes are N,
    /// turned about n1.
    pub fn of(snapshot: &Snapshot) -> Self {
        let mut cloud = Self::default();
        for (k, wake) in snapshot.wakes.iter().enumerate() {
            for p in &wake.particles {
                cloud.points.push(picture(p.position));
                cloud.strength.push(picture(p.strength));
                cloud.radius.push(p.radius);
                cloud.sheet.push(k as f64);
            }
        }
        cloud
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// True when there is none.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Sizes of the strengths \[m3/s\].
    pub fn sizes(&self) -> impl Iterator<Item = f64> {
        self.strength.iter().map(|a| DVec3::from_array(*a).length())
    }

    /// The numbers of [`NUMBERS`], in their order.
    pub fn numbers(&self) -> [&[f64]; 3] {
        [self.strength.as_flattened(), &self.radius, &self.sheet]
    }

    /// The numbers of the `most` strongest particles, in their order.
    pub fn strongest(&self, most: usize) -> Vec<usize> {
        let mut list: Vec<(usize, f64)> = self.sizes().enumerate().collect();
        if list.len() > most {
            list.sort_by(|a, b| b.1.total_cmp(&a.1));
            list.truncate(most);
            list.sort_unstable_by_key(|p| p.0);
        }
        list.into_iter().map(|p| p.0).collect()
    }

    /// The file.
    pub fn to_vtp(&self) -> String {
        let n = self.len();
        let mut out = begin(n, [n, 0]);
        let bytes = |values: &[f64]| values.iter().map(|x| x.to_le_bytes()).collect::<Vec<_>>();
        let points = bytes(self.points.as_flattened());
        array(&mut out, "Float64", "points", 3, points.into_iter());
        out.push_str("</Points>\n<Verts>\n");
        for (name, first) in [("connectivity", 0), ("offsets", 1)] {
            let count = (first..first + n as i64).map(i64::to_le_bytes);
            array(&mut out, "Int64", name, 1, count);
        }
        out.push_str("</Verts>\n<PointData Vectors=\"strength_m3_per_s\">\n");
        for ((name, components), values) in NUMBERS.iter().zip(self.numbers()) {
            let values = bytes(values).into_iter();
            array(&mut out, "Float64", name, *components, values);
        }
        out.push_str("</PointData>\n");
        end(out)
    }

    /// Reads a file of particles.
    ///
    /// # Errors
    /// A file that cannot be read or is damaged.
    pub fn read(path: &Path) -> Result<Self, IoError> {
        arrays::read(path, Self::parse)
    }

    /// From the text of a `.vtp` file.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut cloud = Self::default();
        for (name, words) in arrays(text)? {
            let numbers = words.map_to(f64::from_le_bytes);
            match name {
                "points" => cloud.points = groups(&numbers, name)?,
                "strength_m3_per_s" => cloud.strength = groups(&numbers, name)?,
                "radius_m" => cloud.radius = numbers,
                "sheet" => cloud.sheet = numbers,
                "connectivity" | "offsets" => {}
                _ => {
                    return Err(format!(
                        "it has an array `{name}`, which particles have not"
                    ));
                }
            }
        }
        let lengths = [cloud.strength.len(), cloud.radius.len(), cloud.sheet.len()];
        match lengths.iter().all(|n| *n == cloud.len()) {
            true => Ok(cloud),
            false => Err(format!(
                "it has {} points, but {lengths:?} strengths, radii and sheets",
                cloud.len()
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_flight::{ParticleSnapshot, WakeSnapshot};

    fn snapshot() -> Snapshot {
        let particle = |k: usize| ParticleSnapshot {
            position: DVec3::new(k as f64, 0.1, -0.2),
            strength: DVec3::new(0.0, 1e-6 * k as f64, 2e-6),
            radius: 1e-3,
        };
        let wake = |n: usize| WakeSnapshot {
            particles: (0..n).map(particle).collect(),
            ..WakeSnapshot::default()
        };
        Snapshot {
            wakes: vec![wake(0), wake(3), wake(2)],
            ..Snapshot::default()
        }
    }

    #[test]
    fn exact_particles_read_back() {
        let cloud = Cloud::of(&snapshot());
        assert_eq!(cloud.sheet, [1.0, 1.0, 1.0, 2.0, 2.0]);
        assert_eq!(cloud.points[2], [2.0, -0.1, 0.2]);
        assert_eq!(cloud.strength[2], [0.0, -2e-6, -2e-6]);
        assert_eq!(Cloud::parse(&cloud.to_vtp()).unwrap(), cloud);
        let none = Cloud::default();
        assert_eq!(Cloud::parse(&none.to_vtp()).unwrap(), none);
        assert_eq!(cloud.strongest(2), [1, 2]);
    }

    #[test]
    fn refuses_other_frames() {
        let wakes = crate::snapshots::vtp::PolyData::wakes(&snapshot()).to_vtp();
        assert!(
            Cloud::parse(&wakes)
                .unwrap_err()
                .contains("particles have not")
        );
        let whole = Cloud::of(&snapshot()).to_vtp();
        assert!(
            Cloud::parse(&whole[..whole.len() / 2])
                .unwrap_err()
                .contains("cut")
        );
    }
}
