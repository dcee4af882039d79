//! All tests of the crate in one program: it is linked once.

mod common;
mod episode;
mod heading;
mod lateral;
mod looks;
mod mechanisms;
mod observer;
mod oracle;
mod realisation;
mod refusals;
mod starts;
mod streams;
mod sweep;
mod validation;
mod verification;
mod wake;
