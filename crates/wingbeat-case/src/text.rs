//! The text of a case: its tables and the place of every key in it, all digits of its numbers, names nearly right.

pub(crate) mod digits;
pub(crate) mod nearest;
pub(crate) mod source;
