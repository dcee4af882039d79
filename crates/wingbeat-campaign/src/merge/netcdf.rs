//! The table as `NetCDF` (version 4, which is HDF5): the numbers over the axes of the plan.
//!
//! Every axis is a dimension with its values as coordinate; keys that vary along with another, those of a table
//! and what is drawn are coordinates along the dimension of their axis.

use std::path::Path;

use wingbeat_case::keys::described;
use wingbeat_results::export::hdf5::{Attribute, Hdf5File, Kind, Layout};

use crate::campaign::Campaign;
use crate::merge::rows::Row;
use crate::plan::SAMPLE;
use crate::plan::value::Value;

/// Version of the layout.
const LAYOUT: i64 = 3;

/// Numbers of a dataset that are written when all places are known.
enum Data {
    Whole(Vec<i64>),
    Float(Vec<f64>),
    Bytes(Vec<u8>),
    /// Texts, which the layout has.
    There,
}

#[derive(Default)]
struct File {
    layout: Layout,
    data: Vec<Data>,
}

impl File {
    fn put(&mut self, name: &str, kind: Kind, shape: &[usize], data: Data) -> usize {
        self.data.push(data);
        self.layout.dataset(name, kind, shape)
    }

    fn values(&mut self, name: &str, values: &[Value]) -> usize {
        let shape = [values.len()];
        let whole = |v: &Value| match v {
            Value::Whole(n) => Some(*n),
            _ => None,
        };
        if let Some(list) = values.iter().map(whole).collect() {
            return self.put(name, Kind::Integer, &shape, Data::Whole(list));
        }
        let numbers: Option<Vec<f64>> = values.iter().map(Value::number).collect();
        if let Some(list) = numbers {
            return self.put(name, Kind::Float, &shape, Data::Float(list));
        }
        let texts: Vec<String> = values.iter().map(Value::shown).collect();
        self.data.push(Data::There);
        self.layout.texts(name, texts)
    }

    /// Gives the values of a key of the case their meaning, and their unit if they are numbers.
    fn describe(&mut self, dataset: usize, key: &str) {
        if let Some([unit, about]) = described(key) {
            if !matches!(self.data[dataset], Data::There) {
                self.layout.text(dataset, "units", &unit);
            }
            self.layout.text(dataset, "long_name", &about);
        }
    }

    /// Makes a dataset the coordinate of a dimension.
    fn scale(&mut self, dataset: usize, name: &str) {
        self.layout.text(dataset, "CLASS", "DIMENSION_SCALE");
        self.layout.text(dataset, "NAME", name);
    }

    fn along(&mut self, dataset: usize, scales: &[usize]) {
        let scales = Attribute::Scales(scales.to_vec());
        self.layout.note(dataset, "DIMENSION_LIST", scales);
    }

    fn write(self, path: &Path) -> std::io::Result<()> {
        let mut file: Hdf5File = self.layout.create(path)?;
        for (k, data) in self.data.iter().enumerate() {
            match data {
                Data::Whole(list) => file.integers(k, 0, list)?,
                Data::Float(list) => file.floats(k, 0, list)?,
                Data::Bytes(bytes) => file.put(k, 0, bytes)?,
                Data::There => {}
            }
        }
        Ok(())
    }
}

/// Writes it.
///
/// # Errors
/// A file that cannot be written.
pub fn write(campaign: &Campaign, rows: &[Row], path: &Path) -> std::io::Result<()> {
    let mut file = File::default();
    let (scales, beside) = axes(campaign, &mut file);
    let shape = campaign.plan().shape();
    let success = |r: &Row| r.success.map_or(f64::NAN, |s| f64::from(u8::from(s)));
    let all = Data::Float(rows.iter().map(success).collect());
    let dataset = file.put("success", Kind::Float, &shape, all);
    file.layout.text(
        dataset,
        "long_name",
        "1 where there are numbers, 0 where the point failed",
    );
    file.along(dataset, &scales);
    let verdict = |r: &Row| r.verdict.map_or(f64::NAN, |v| f64::from(v.level()));
    let all = Data::Float(rows.iter().map(verdict).collect());
    let dataset = file.put("verdict", Kind::Float, &shape, all);
    let about = "how far the flight can be trusted: 0 green, 1 amber, 2 red";
    file.layout.text(dataset, "long_name", about);
    file.along(dataset, &scales);
    for (k, number) in campaign.numbers.iter().enumerate() {
        let column = Data::Float(rows.iter().map(|r| r.numbers[k]).collect());
        let dataset = file.put(&number.name, Kind::Float, &shape, column);
        file.layout.text(dataset, "units", &number.unit);
        file.layout.text(dataset, "long_name", &number.about);
        file.along(dataset, &scales);
    }
    describe(campaign, &mut file, &beside);
    file.write(path)
}

/// Dimensions in their order, and the coordinates beside them.
fn axes(campaign: &Campaign, file: &mut File) -> (Vec<usize>, Vec<String>) {
    let plan = campaign.plan();
    let (mut scales, mut beside) = (vec![], vec![]);
    for axis in &plan.axes {
        let own = axis.keys.first() == Some(&axis.name);
        let scale = match own {
            true => file.values(&axis.name, &axis.values[0]),
            false => file.values(&axis.name, &numbered(axis.len())),
        };
        file.scale(scale, &axis.name);
        if own {
            file.describe(scale, &axis.name);
        }
        scales.push(scale);
        for (key, values) in axis.keys.iter().zip(&axis.values).skip(usize::from(own)) {
            let dataset = file.values(key, values);
            file.describe(dataset, key);
            file.along(dataset, &[scale]);
            beside.push(key.clone());
        }
    }
    if !plan.samplers.is_empty() {
        let scale = file.values(SAMPLE, &numbered(plan.samples));
        file.scale(scale, SAMPLE);
        scales.push(scale);
        for sampler in &plan.samplers {
            let drawn: Vec<f64> = (0..plan.samples).map(|s| sampler.value(s)).collect();
            let dataset = file.put(
                sampler.key(),
                Kind::Float,
                &[plan.samples],
                Data::Float(drawn),
            );
            file.describe(dataset, sampler.key());
            file.along(dataset, &[scale]);
            beside.push(sampler.key().to_owned());
        }
    }
    (scales, beside)
}

fn numbered(count: usize) -> Vec<Value> {
    (0..count).map(|k| Value::Whole(k as i64)).collect()
}

fn describe(campaign: &Campaign, file: &mut File, beside: &[String]) {
    let text = |s: &str| Attribute::Text(s.to_owned());
    file.layout
        .note_group("", "layout_version", Attribute::Integer(LAYOUT));
    file.layout
        .note_group("", "wingbeat_version", text(env!("CARGO_PKG_VERSION")));
    file.layout
        .note_group("", "campaign", text(campaign.name()));
    if !beside.is_empty() && beside.iter().all(|key| !key.contains(' ')) {
        file.layout
            .note_group("", "coordinates", text(&beside.join(" ")));
    }
    for (name, content) in [
        ("campaign_toml", campaign.text()),
        ("case_toml", campaign.base().text()),
    ] {
        let bytes = content.as_bytes().to_vec();
        file.put(name, Kind::Text(bytes.len()), &[], Data::Bytes(bytes));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behaves_whole_numbers_beyond_those_of_doubles_are_kept() {
        let mut file = File::default();
        let seeds = [1_i64 << 53, (1 << 53) + 1];
        file.values("seed", &seeds.map(Value::Whole));
        assert!(matches!(&file.data[0], Data::Whole(list) if *list == seeds));
    }
}
