//! The text of a case: its tables and the place of every key in it, paths of keys, all digits of its numbers, names
//! nearly right, words of command lines.

pub(crate) mod digits;
pub(crate) mod nearest;
pub(crate) mod path;
pub(crate) mod shell;
pub(crate) mod source;
