//! The points of a campaign: from the number of a point to the values of its keys.
//!
//! Axes multiply, the last one running fastest; beside them runs the axis of samples, fastest of all. The same
//! samples are drawn at every point of the grid, so that differences along the grid are not those of chance.

pub(crate) mod axes;
pub(crate) mod blocks;
pub(crate) mod cases;
pub(crate) mod checks;
pub(crate) mod file;
pub mod named;
pub(crate) mod number;
pub(crate) mod places;
pub(crate) mod raw;
pub(crate) mod sample;
pub(crate) mod trimming;
pub(crate) mod value;

use crate::plan::sample::Sampler;
use crate::plan::value::Value;

/// Name of the axis along which samples run.
pub const SAMPLE: &str = "sample";

/// Where the values of an axis stand in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In `[parameter."KEY"]`.
    Parameter,
    /// In the group of `[[zip]]` of this number, from 0.
    Zip(usize),
    /// In the table of points.
    Table,
}

impl Place {
    /// Where the values of a key stand, as errors name it.
    pub fn of_key(self, key: &str) -> String {
        match self {
            Self::Parameter => format!("parameter.{key}"),
            Self::Zip(k) => format!("zip[{k}].{key}"),
            Self::Table => "table".to_owned(),
        }
    }
}

/// Keys that vary together.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Its name: that of its first key, or `row` of a table.
    pub name: String,
    /// Where it stands in the file.
    pub place: Place,
    /// Its keys.
    pub keys: Vec<String>,
    /// The values of each key.
    pub values: Vec<Vec<Value>>,
}

impl Axis {
    /// Of one key.
    pub fn of_key(key: &str, values: Vec<Value>) -> Self {
        Self {
            name: key.to_owned(),
            place: Place::Parameter,
            keys: vec![key.to_owned()],
            values: vec![values],
        }
    }

    /// How many values each key has.
    pub fn len(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// Whether there is nothing on it.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The points of a campaign.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The grid.
    pub axes: Vec<Axis>,
    /// What is drawn.
    pub samplers: Vec<Sampler>,
    /// Samples at each point of the grid; 1 where nothing is drawn.
    pub samples: usize,
    keys: Vec<String>,
    points: usize,
}

impl Plan {
    /// Of a grid and what is drawn; none where the points cannot be counted.
    pub fn new(axes: Vec<Axis>, samplers: Vec<Sampler>, samples: usize) -> Option<Self> {
        let sizes = axes.iter().map(Axis::len).chain([samples]);
        let points = sizes.into_iter().try_fold(1_usize, usize::checked_mul)?;
        let listed = axes.iter().flat_map(|a| a.keys.iter().cloned());
        let drawn = samplers.iter().map(|s| s.key().to_owned());
        Some(Self {
            keys: listed.chain(drawn).collect(),
            axes,
            samplers,
            samples,
            points,
        })
    }

    /// Points.
    pub fn points(&self) -> usize {
        self.points
    }

    /// The varied keys.
    pub fn keys(&self) -> &[String] {
        &self.keys
    }

    /// Whether a key varies from point to point.
    pub fn varies(&self, key: &str) -> bool {
        self.keys.iter().any(|k| k == key)
    }

    /// Whether a key that says how a flight starts varies from point to point: of smooth starts and of holds.
    pub fn varies_starts(&self) -> bool {
        let of_start = |key: &String| key.contains("start") || key.contains("held_beats");
        self.keys.iter().any(of_start)
    }

    /// Sizes of the grid, samples last where something is drawn.
    pub fn shape(&self) -> Vec<usize> {
        let drawn = (!self.samplers.is_empty()).then_some(self.samples);
        self.axes.iter().map(Axis::len).chain(drawn).collect()
    }

    /// Where point `i` is on each axis, and the number of its sample.
    pub fn place(&self, i: usize) -> (Vec<usize>, usize) {
        let mut rest = i / self.samples;
        let mut place = vec![0; self.axes.len()];
        for (k, axis) in self.axes.iter().enumerate().rev() {
            place[k] = rest % axis.len();
            rest /= axis.len();
        }
        (place, i % self.samples)
    }

    /// The values of the keys at point `i`, in their order.
    pub fn values(&self, i: usize) -> Vec<Value> {
        let (place, sample) = self.place(i);
        let listed = (self.axes.iter().zip(place))
            .flat_map(|(axis, at)| axis.values.iter().map(move |v| v[at].clone()));
        let drawn = self.samplers.iter().map(|s| Value::Number(s.value(sample)));
        listed.chain(drawn).collect()
    }

    /// The value of a key at point `i`; none of a key that does not vary.
    pub fn value(&self, key: &str, i: usize) -> Option<Value> {
        let k = self.keys.iter().position(|known| known == key)?;
        Some(self.values(i).swap_remove(k))
    }

    /// What is put on top of the case at point `i`: `KEY=VALUE`.
    pub fn overrides(&self, i: usize) -> Vec<String> {
        let of = |(key, value): (&String, Value)| pair(key, &value);
        self.keys.iter().zip(self.values(i)).map(of).collect()
    }
}

/// What puts a value on top of a case: `KEY=VALUE`.
pub fn pair(key: &str, value: &Value) -> String {
    let mut text = format!("{key}=");
    value.write(&mut text);
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::raw::{Ends, Variation};

    #[test]
    fn exact_points_of_a_grid_with_samples() {
        let whole = |list: &[i64]| list.iter().map(|n| Value::Whole(*n)).collect::<Vec<_>>();
        let a = Axis::of_key("a", whole(&[1, 2, 3]));
        let b = Axis::of_key("b", whole(&[10, 20]));
        let ends = Ends { from: 0.0, to: 1.0 };
        let draw = Sampler::new("c", 1, &Variation::Uniform(ends), 4, 0);
        let plan = Plan::new(vec![a, b], vec![draw.clone()], 4).unwrap();
        assert_eq!((plan.points(), plan.shape()), (24, vec![3, 2, 4]));
        assert_eq!(plan.place(0), (vec![0, 0], 0));
        assert_eq!(plan.place(23), (vec![2, 1], 3));
        assert_eq!(plan.place(9), (vec![1, 0], 1));
        let c = draw.value(1);
        let wanted = ["a=2".to_owned(), "b=10".to_owned(), format!("c={c:?}")];
        assert_eq!(plan.overrides(9), wanted);
    }
}
