//! What objects of a file are made of: messages, object headers, the superblock, checksums.
//!
//! Section numbers refer to the *HDF5 File Format Specification, version 3.0* (The HDF Group).

use std::io;

/// Type of the numbers of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// 64-bit floating point.
    Float,
    /// 64-bit whole numbers.
    Integer,
    /// Text of a fixed length in bytes.
    Text(usize),
    /// Texts of any length, which stand in the heap.
    Texts,
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
    /// The arrays along whose elements the dimensions of an array run, from the first on: numbers of datasets.
    Scales(Vec<usize>),
}

impl Kind {
    pub(super) fn size(self) -> usize {
        match self {
            Self::Float | Self::Integer => 8,
            Self::Text(n) => n.max(1),
            Self::Texts => 16,
        }
    }

    /// Datatype message (IV.A.2.d).
    pub(super) fn message(self) -> Vec<u8> {
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
            Self::Texts => {
                let mut m = vec![0x19, 0x01, 0x01, 0]; // a string, UTF-8, of
                m.extend(size);
                m.extend([0x10, 0, 0, 0, 1, 0, 0, 0, 0, 0, 8, 0]); // bytes without sign
                m
            }
        }
    }
}

/// Dataspace message, version 2 (IV.A.2.b).
pub(super) fn dataspace(shape: &[usize]) -> Vec<u8> {
    let kind = u8::from(!shape.is_empty());
    let mut m = vec![2, shape.len() as u8, 0, kind];
    for n in shape {
        m.extend((*n as u64).to_le_bytes());
    }
    m
}

/// A length or number of 16 bits, of `what`.
///
/// # Errors
/// One that needs more.
pub(super) fn short(n: usize, what: &str) -> io::Result<[u8; 2]> {
    let problem = || {
        format!(
            "{what}: {n} is more than the {} that HDF5 files can hold",
            u16::MAX
        )
    };
    u16::try_from(n)
        .map(u16::to_le_bytes)
        .map_err(|_| io::Error::other(problem()))
}

/// Attribute message, version 3 (IV.A.2.m); `heap` is where the references to arrays stand.
///
/// # Errors
/// One of 64 KiB or more, which no message can hold.
pub(super) fn attribute(
    name: &str,
    value: &Attribute,
    rank: usize,
    heap: u64,
) -> io::Result<Vec<u8>> {
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
        Attribute::Scales(datasets) => {
            // a list of references to objects for each dimension; here one or none
            let mut kind = vec![0x19, 0, 0, 0, 16, 0, 0, 0];
            kind.extend([0x17, 0, 0, 0, 8, 0, 0, 0]);
            let mut data = vec![];
            for k in 0..rank {
                let (count, place, index) = match datasets.get(k) {
                    Some(dataset) => (1_u32, heap, *dataset as u32 + 1),
                    None => (0, 0, 0),
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
        m.extend(short(
            n,
            &format!("bytes of the name of attribute `{name}`"),
        )?);
    }
    m.push(1); // names are UTF-8
    m.extend(name.as_bytes());
    m.push(0);
    m.extend(kind);
    m.extend(space);
    m.extend(data);
    short(m.len(), &format!("bytes of attribute `{name}`"))?;
    Ok(m)
}

/// Link message to an object of the same file (IV.A.2.g).
///
/// # Errors
/// A name of nearly 64 KiB or more.
pub(super) fn link(name: &str, place: u64) -> io::Result<Vec<u8>> {
    let mut m = vec![1, 0x11, 1]; // two bytes of length; UTF-8
    m.extend(short(name.len(), &format!("bytes of the name `{name}`"))?);
    m.extend(name.as_bytes());
    m.extend(place.to_le_bytes());
    Ok(m)
}

/// Object header, version 2 (IV.A.1.b), of messages with their types.
///
/// # Errors
/// A message of 64 KiB or more.
pub(super) fn object(messages: &[(u8, Vec<u8>)]) -> io::Result<Vec<u8>> {
    let mut body = vec![];
    for (kind, data) in messages {
        body.push(*kind);
        body.extend(short(data.len(), "bytes of a message")?);
        body.push(0);
        body.extend(data);
    }
    let mut out = b"OHDR\x02\x02".to_vec(); // four bytes of length
    out.extend((body.len() as u32).to_le_bytes());
    out.extend(body);
    let sum = lookup3(&out);
    out.extend(sum.to_le_bytes());
    Ok(out)
}

pub(super) const UNDEFINED: u64 = u64::MAX;

pub(super) const LINK_INFO: u8 = 0x02;

pub(super) const GROUP_INFO: u8 = 0x0a;

/// Superblock, version 2 (II.A).
pub(super) fn superblock(root: u64, end: u64) -> Vec<u8> {
    let mut out = b"\x89HDF\r\n\x1a\n\x02\x08\x08\0".to_vec();
    for address in [0, UNDEFINED, end, root] {
        out.extend(address.to_le_bytes());
    }
    let sum = lookup3(&out);
    out.extend(sum.to_le_bytes());
    out
}

/// Bob Jenkins' lookup3 hash (hashlittle, start value 0), the checksum of HDF5 metadata.
pub(super) fn lookup3(data: &[u8]) -> u32 {
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
