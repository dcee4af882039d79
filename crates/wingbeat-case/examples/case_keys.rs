//! Prints the page of all keys of a case: `cargo run -p wingbeat-case --example case_keys >
//! docs/case-keys.md`.

fn main() {
    print!("{}", wingbeat_case::keys::page());
}
