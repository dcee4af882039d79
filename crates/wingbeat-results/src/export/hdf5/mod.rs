//! The part of the HDF5 format that results need: groups, contiguous arrays of known shape,
//! attributes. Written front to back with the places of all numbers known beforehand, so that
//! data can be put in piece by piece.
//!
//! Section numbers refer to the *HDF5 File Format Specification, version 3.0* (The HDF Group).

mod heap;
mod message;

use std::fs::File;
use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::Path;

pub use message::{Attribute, Kind};
use message::{GROUP_INFO, LINK_INFO, UNDEFINED, attribute, dataspace, link, object, superblock};

/// An array: its numbers are written later.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    /// Path from the root, e.g. `history/time_s`.
    pub path: String,
    /// Type of its numbers.
    pub kind: Kind,
    /// Size of each dimension; none for a single value.
    pub shape: Vec<usize>,
    /// Attributes.
    pub attributes: Vec<(String, Attribute)>,
}

/// What a file holds.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Groups other than the root, parents first.
    pub groups: Vec<String>,
    /// Arrays.
    pub datasets: Vec<Dataset>,
    /// Attributes of groups; the root is "".
    pub attributes: Vec<(String, String, Attribute)>,
    /// Arrays of texts.
    texts: Vec<(usize, Vec<String>)>,
}

/// A file with its layout written.
pub struct Hdf5File {
    file: File,
    places: Vec<u64>,
    sizes: Vec<u64>,
}

/// One object of the layout.
enum Object<'a> {
    Group(&'a str),
    Dataset(usize),
}

impl Layout {
    /// Adds a group and, before it, its parents.
    pub fn group(&mut self, path: &str) {
        if let Some((parent, _)) = path.rsplit_once('/') {
            self.group(parent);
        }
        if !path.is_empty() && !self.groups.iter().any(|g| g == path) {
            self.groups.push(path.to_owned());
        }
    }

    /// Adds an array and its group; returns its number.
    pub fn dataset(&mut self, path: &str, kind: Kind, shape: &[usize]) -> usize {
        if let Some((parent, _)) = path.rsplit_once('/') {
            self.group(parent);
        }
        self.datasets.push(Dataset {
            path: path.to_owned(),
            kind,
            shape: shape.to_vec(),
            attributes: vec![],
        });
        self.datasets.len() - 1
    }

    /// Adds a list of texts of any length, which need not be put in later; returns its number.
    pub fn texts(&mut self, path: &str, texts: Vec<String>) -> usize {
        let dataset = self.dataset(path, Kind::Texts, &[texts.len()]);
        self.texts.push((dataset, texts));
        dataset
    }

    /// Gives an array an attribute.
    pub fn note(&mut self, dataset: usize, name: &str, value: Attribute) {
        self.datasets[dataset]
            .attributes
            .push((name.to_owned(), value));
    }

    /// Gives an array a text attribute.
    pub fn text(&mut self, dataset: usize, name: &str, value: &str) {
        self.note(dataset, name, Attribute::Text(value.to_owned()));
    }

    /// Gives a group an attribute.
    pub fn note_group(&mut self, group: &str, name: &str, value: Attribute) {
        self.attributes
            .push((group.to_owned(), name.to_owned(), value));
    }

    fn objects(&self) -> Vec<Object<'_>> {
        let groups = self.groups.iter().map(|g| Object::Group(g));
        let datasets = (0..self.datasets.len()).map(Object::Dataset);
        std::iter::once(Object::Group(""))
            .chain(groups)
            .chain(datasets)
            .collect()
    }

    fn path<'a>(&'a self, object: &Object<'a>) -> &'a str {
        match object {
            Object::Group(path) => path,
            Object::Dataset(k) => &self.datasets[*k].path,
        }
    }

    /// The header of an object when all objects stand at `places` and arrays at `data`.
    fn header(
        &self,
        object: &Object,
        places: &[u64],
        data: &[u64],
        heap: u64,
    ) -> std::io::Result<Vec<u8>> {
        match object {
            Object::Group(path) => {
                let mut info = vec![0, 0];
                info.extend(UNDEFINED.to_le_bytes());
                info.extend(UNDEFINED.to_le_bytes());
                let mut messages = vec![(LINK_INFO, info), (GROUP_INFO, vec![0, 0])];
                for (child, place) in self.objects().iter().zip(places) {
                    let full = self.path(child);
                    let (parent, name) = full.rsplit_once('/').unwrap_or(("", full));
                    if parent == *path && !full.is_empty() {
                        messages.push((0x06, link(name, *place)?));
                    }
                }
                for (_, name, value) in self.attributes.iter().filter(|a| a.0 == *path) {
                    messages.push((0x0c, attribute(name, value, 0, heap)?));
                }
                self::object(&messages)
            }
            Object::Dataset(k) => self.array(*k, data[*k], heap),
        }
    }

    fn array(&self, k: usize, place: u64, heap: u64) -> std::io::Result<Vec<u8>> {
        let d = &self.datasets[k];
        let bytes = self.bytes(k);
        let mut contiguous = vec![3, 1]; // data layout, version 3 (IV.A.2.i)
        contiguous.extend(if bytes == 0 { UNDEFINED } else { place }.to_le_bytes());
        contiguous.extend(bytes.to_le_bytes());
        let mut messages = vec![
            (0x01, dataspace(&d.shape)),
            (0x03, d.kind.message()),
            (0x05, vec![3, 0x0a]), // fill value: none defined, never written
            (0x08, contiguous),
        ];
        for (name, value) in &d.attributes {
            messages.push((0x0c, attribute(name, value, d.shape.len(), heap)?));
        }
        object(&messages)
    }

    fn bytes(&self, k: usize) -> u64 {
        let d = &self.datasets[k];
        (d.shape.iter().product::<usize>() * d.kind.size()) as u64
    }

    /// Begins a file: everything but the numbers of the arrays, which are zeros until written.
    ///
    /// # Errors
    /// A file that cannot be written; more than the format holds: attributes of 64 KiB, 65 536 arrays.
    pub fn create(&self, path: &Path) -> std::io::Result<Hdf5File> {
        const SUPERBLOCK: u64 = 48;
        let objects = self.objects();
        let none = vec![0; objects.len()];
        let empty = vec![0; self.datasets.len()];
        let mut at = SUPERBLOCK;
        let mut places = vec![];
        for o in &objects {
            places.push(at);
            at += self.header(o, &none, &empty, 0)?.len() as u64;
        }
        let heap = at.next_multiple_of(8);
        let arrays: Vec<[u8; 8]> = places[1 + self.groups.len()..]
            .iter()
            .map(|place| place.to_le_bytes())
            .collect();
        let mut heaps = heap::collection(arrays.iter().map(<[u8; 8]>::as_slice))?;
        let lists: Vec<&[String]> = self.texts.iter().map(|(_, list)| &list[..]).collect();
        let (collections, references) = heap::texts(&lists, heap + heaps.len() as u64)?;
        heaps.extend(collections);
        at = heap + heaps.len() as u64;
        let mut data = vec![];
        let mut sizes = vec![];
        for k in 0..self.datasets.len() {
            at = at.next_multiple_of(8);
            data.push(at);
            sizes.push(self.bytes(k));
            at += self.bytes(k);
        }
        let mut front = superblock(places[0], at);
        for o in &objects {
            front.extend(self.header(o, &places, &data, heap)?);
        }
        front.resize(heap as usize, 0);
        front.extend(heaps);
        let mut file = File::create(path)?;
        file.write_all(&front)?;
        file.set_len(at)?;
        let mut file = Hdf5File {
            file,
            places: data,
            sizes,
        };
        for ((dataset, _), references) in self.texts.iter().zip(references) {
            file.put(*dataset, 0, &references)?;
        }
        Ok(file)
    }
}

impl Hdf5File {
    /// Puts bytes into an array from element byte `offset` on.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn put(&mut self, dataset: usize, offset: u64, bytes: &[u8]) -> std::io::Result<()> {
        if offset + bytes.len() as u64 > self.sizes[dataset] {
            let problem = "a frame holds more than its head says; fly the case again";
            return Err(std::io::Error::other(problem));
        }
        self.file
            .seek(SeekFrom::Start(self.places[dataset] + offset))?;
        self.file.write_all(bytes)
    }

    /// Puts floating-point numbers from element `at` on.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn floats(&mut self, dataset: usize, at: usize, values: &[f64]) -> std::io::Result<()> {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.put(dataset, 8 * at as u64, &bytes)
    }

    /// Puts whole numbers from element `at` on.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn integers(&mut self, dataset: usize, at: usize, values: &[i64]) -> std::io::Result<()> {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.put(dataset, 8 * at as u64, &bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lengths that have 16 bits in the file end there: they were cut, and readers found no attribute behind.
    #[test]
    fn refuses_attributes_and_arrays_beyond_16_bits() {
        let name = format!("wingbeat-hdf5-{}.h5", std::process::id());
        let path = std::env::temp_dir().join(name);
        let refused = |layout: &Layout| {
            let problem = layout.create(&path).map(drop).unwrap_err().to_string();
            assert!(!path.exists() && problem.contains("65535"), "{problem}");
            problem
        };
        let mut layout = Layout::default();
        let keys = |bytes: usize| Attribute::Text("k".repeat(bytes));
        layout.note_group("", "coordinates", keys(65_000));
        layout.create(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        layout.note_group("", "coordinates", keys(65_536));
        assert!(refused(&layout).contains("`coordinates`"));
        let mut layout = Layout::default();
        (0..=u16::MAX).for_each(|k| _ = layout.dataset(&k.to_string(), Kind::Float, &[]));
        assert!(refused(&layout).contains("arrays"));
    }
}
