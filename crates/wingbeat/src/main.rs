//! The wingbeat command line.
fn main() {}
