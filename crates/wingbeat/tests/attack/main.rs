//! Bad input by the hundred. Whatever is asked: no panic, no abort, no silence of more than ten
//! seconds, no file changed, and never an exit code of success.
#![cfg(target_os = "linux")]

mod cases;
mod command_line;
mod environment;
mod field;
mod files;
mod sizes;
mod streams;
#[path = "../support/mod.rs"]
mod support;
