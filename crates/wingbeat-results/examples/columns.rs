//! Prints the page of the columns of a history: `cargo run -p wingbeat-results --example columns >
//! docs/columns.md`.

fn main() {
    print!("{}", wingbeat_results::columns_page());
}
