//! The part of the HDF5 format that results need: groups, contiguous arrays of known shape,
//! attributes. Written front to back with the places of all numbers known beforehand, so that
//! data can be put in piece by piece.
//!
//! Section numbers refer to the *HDF5 File Format Specification, version 3.0* (The HDF Group).

use std::fs::File;
use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::Path;

/// Type of the numbers of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// 64-bit floating point.
    Float,
    /// 64-bit whole numbers.
    Integer,
    /// Text of a fixed length in bytes.
    Text(usize),
}

/// Value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub enum Attribute {
    /// One text.
    Text(String),
    /// One whole number.
    Integer(i64),
    /// A list of whole numbers.
    Integers(Vec<i64>),
    /// The arrays along whose elements each dimension of an array runs: number of a dataset.
    Scale(usize),
}

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
}

/// A file with its layout written.
pub struct Hdf5File {
    file: File,
    places: Vec<u64>,
    sizes: Vec<u64>,
}

impl Kind {
    fn size(self) -> usize {
        match self {
            Self::Float | Self::Integer => 8,
            Self::Text(n) => n.max(1),
        }
    }

    /// Datatype message (IV.A.2.d).
    fn message(self) -> Vec<u8> {
        let size = (self.size() as u32).to_le_bytes();
        match self {
            Self::Float => {
                // little endian, implied leading bit, sign at 63; exponent 52..63, bias 1023
                let mut m = vec![0x11, 0x20, 63, 0];
                m.extend(size);
                m.extend([0, 0, 64, 0, 52, 11, 0, 52]);
                m.extend(1023_u32.to_le_bytes());
                m
            }
            Self::Integer => {
                let mut m = vec![0x10, 0x08, 0, 0]; // signed
                m.extend(size);
                m.extend([0, 0, 64, 0]);
                m
            }
            Self::Text(_) => {
                let mut m = vec![0x13, 0x11, 0, 0]; // padded with zeros, UTF-8
                m.extend(size);
                m
            }
        }
    }
}

/// Dataspace message, version 2 (IV.A.2.b).
fn dataspace(shape: &[usize]) -> Vec<u8> {
    let kind = u8::from(!shape.is_empty());
    let mut m = vec![2, shape.len() as u8, 0, kind];
    for n in shape {
        m.extend((*n as u64).to_le_bytes());
    }
    m
}

/// Attribute message, version 3 (IV.A.2.m); `heap` is where the references to arrays stand.
fn attribute(name: &str, value: &Attribute, rank: usize, heap: u64) -> Vec<u8> {
    let (kind, space, data) = match value {
        Attribute::Text(text) => {
            let bytes = [text.as_bytes(), &[0]].concat();
            let mut kind = Kind::Text(bytes.len()).message();
            kind[1] = if text.is_ascii() { 0x00 } else { 0x10 }; // ends with a zero
            (kind, dataspace(&[]), bytes)
        }
        Attribute::Integer(n) => (
            Kind::Integer.message(),
            dataspace(&[]),
            n.to_le_bytes().to_vec(),
        ),
        Attribute::Integers(list) => {
            let data = list.iter().flat_map(|n| n.to_le_bytes()).collect();
            (Kind::Integer.message(), dataspace(&[list.len()]), data)
        }
        Attribute::Scale(dataset) => {
            // a list of references to objects for each dimension; here one for the first only
            let mut kind = vec![0x19, 0, 0, 0, 16, 0, 0, 0];
            kind.extend([0x17, 0, 0, 0, 8, 0, 0, 0]);
            let mut data = vec![];
            for k in 0..rank {
                let (count, place, index) = match k {
                    0 => (1_u32, heap, *dataset as u32 + 1),
                    _ => (0, 0, 0),
                };
                data.extend(count.to_le_bytes());
                data.extend(place.to_le_bytes());
                data.extend(index.to_le_bytes());
            }
            (kind, dataspace(&[rank]), data)
        }
    };
    let mut m = vec![3, 0];
    for n in [name.len() + 1, kind.len(), space.len()] {
        m.extend((n as u16).to_le_bytes());
    }
    m.push(1); // names are UTF-8
    m.extend(name.as_bytes());
    m.push(0);
    m.extend(kind);
    m.extend(space);
    m.extend(data);
    m
}

/// Link message to an object of the same file (IV.A.2.g).
fn link(name: &str, place: u64) -> Vec<u8> {
    let mut m = vec![1, 0x11, 1]; // two bytes of length; UTF-8
    m.extend((name.len() as u16).to_le_bytes());
    m.extend(name.as_bytes());
    m.extend(place.to_le_bytes());
    m
}

/// Object header, version 2 (IV.A.1.b), of messages with their types.
fn object(messages: &[(u8, Vec<u8>)]) -> Vec<u8> {
    let mut body = vec![];
    for (kind, data) in messages {
        body.push(*kind);
        body.extend((data.len() as u16).to_le_bytes());
        body.push(0);
        body.extend(data);
    }
    let mut out = b"OHDR\x02\x02".to_vec(); // four bytes of length
    out.extend((body.len() as u32).to_le_bytes());
    out.extend(body);
    let sum = lookup3(&out);
    out.extend(sum.to_le_bytes());
    out
}

const UNDEFINED: u64 = u64::MAX;
const LINK_INFO: u8 = 0x02;
const GROUP_INFO: u8 = 0x0a;

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
    fn header(&self, object: &Object, places: &[u64], data: &[u64], heap: u64) -> Vec<u8> {
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
                        messages.push((0x06, link(name, *place)));
                    }
                }
                for (_, name, value) in self.attributes.iter().filter(|a| a.0 == *path) {
                    messages.push((0x0c, attribute(name, value, 0, heap)));
                }
                self::object(&messages)
            }
            Object::Dataset(k) => self.array(*k, data[*k], heap),
        }
    }

    fn array(&self, k: usize, place: u64, heap: u64) -> Vec<u8> {
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
            messages.push((0x0c, attribute(name, value, d.shape.len(), heap)));
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
    /// A file that cannot be written.
    pub fn create(&self, path: &Path) -> std::io::Result<Hdf5File> {
        const SUPERBLOCK: u64 = 48;
        let objects = self.objects();
        let none = vec![0; objects.len()];
        let empty = vec![0; self.datasets.len()];
        let mut at = SUPERBLOCK;
        let mut places = vec![];
        for o in &objects {
            places.push(at);
            at += self.header(o, &none, &empty, 0).len() as u64;
        }
        let heap = at.next_multiple_of(8);
        let collection = self.heap(&places[1 + self.groups.len()..]);
        at = heap + collection.len() as u64;
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
            front.extend(self.header(o, &places, &data, heap));
        }
        front.resize(heap as usize, 0);
        front.extend(collection);
        let mut file = File::create(path)?;
        file.write_all(&front)?;
        file.set_len(at)?;
        Ok(Hdf5File {
            file,
            places: data,
            sizes,
        })
    }

    /// Global heap collection (III.E) with the place of every array as an object of its own,
    /// numbered from 1 in the order of the arrays.
    fn heap(&self, datasets: &[u64]) -> Vec<u8> {
        let mut objects = vec![];
        for (k, place) in datasets.iter().enumerate() {
            objects.extend((k as u16 + 1).to_le_bytes());
            objects.extend([1, 0, 0, 0, 0, 0]); // referred to
            objects.extend(8_u64.to_le_bytes());
            objects.extend(place.to_le_bytes());
        }
        let size = (16 + objects.len() + 16).max(4096);
        let free = size - 16 - objects.len();
        let mut out = b"GCOL\x01\0\0\0".to_vec();
        out.extend((size as u64).to_le_bytes());
        out.extend(objects);
        out.extend([0; 8]); // object 0: what is left
        out.extend((free as u64).to_le_bytes());
        out.resize(size, 0);
        out
    }
}

/// Superblock, version 2 (II.A).
fn superblock(root: u64, end: u64) -> Vec<u8> {
    let mut out = b"\x89HDF\r\n\x1a\n\x02\x08\x08\0".to_vec();
    for address in [0, UNDEFINED, end, root] {
        out.extend(address.to_le_bytes());
    }
    let sum = lookup3(&out);
    out.extend(sum.to_le_bytes());
    out
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

/// Bob Jenkins' lookup3 hash (hashlittle, start value 0), the checksum of HDF5 metadata.
fn lookup3(data: &[u8]) -> u32 {
    let start = 0xdead_beef_u32.wrapping_add(data.len() as u32);
    let (mut a, mut b, mut c) = (start, start, start);
    let mut rest = data;
    while rest.len() > 12 {
        let word = |k: usize| u32::from_le_bytes([rest[k], rest[k + 1], rest[k + 2], rest[k + 3]]);
        a = a.wrapping_add(word(0));
        b = b.wrapping_add(word(4));
        c = c.wrapping_add(word(8));
        for shift in [4, 6, 8, 16, 19, 4] {
            a = a.wrapping_sub(c) ^ c.rotate_left(shift);
            c = c.wrapping_add(b);
            (a, b, c) = (b, c, a);
        }
        rest = &rest[12..];
    }
    if rest.is_empty() {
        return c;
    }
    let mut tail = [0_u8; 12];
    tail[..rest.len()].copy_from_slice(rest);
    let word = |k: usize| u32::from_le_bytes([tail[k], tail[k + 1], tail[k + 2], tail[k + 3]]);
    a = a.wrapping_add(word(0));
    b = b.wrapping_add(word(4));
    c = c.wrapping_add(word(8));
    for shift in [14, 11, 25, 16, 4, 14, 24] {
        c = (c ^ b).wrapping_sub(b.rotate_left(shift));
        (a, b, c) = (b, c, a);
    }
    // seven rounds leave the result one place further
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_checksums_of_lookup3() {
        // Jenkins, lookup3.c (2006), driver5: hashlittle("", 0) and of "Four score ...".
        assert_eq!(lookup3(b""), 0xdead_beef);
        assert_eq!(lookup3(b"Four score and seven years ago"), 0x1777_0551);
    }
}
