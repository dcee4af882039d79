//! All tests of the crate in one program: it is linked once.

mod common;
mod episode;
mod lateral;
mod mechanisms;
mod oracle;
mod sweep;
mod validation;
mod verification;
mod wake;
