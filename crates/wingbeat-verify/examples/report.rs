//! Prints the report: `cargo run --release -p wingbeat-verify --example report -- [quick] [only]`.

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let quick = args.iter().any(|a| a == "quick");
    let only = args
        .iter()
        .find(|a| *a != "quick")
        .map_or("", String::as_str);
    let start = std::time::Instant::now();
    let cases = wingbeat_verify::select(quick, only);
    let report = wingbeat_verify::run(&cases, quick, |e| {
        eprintln!(
            "{:>7.1} s {} {:?}",
            start.elapsed().as_secs_f64(),
            e.case,
            e.counts()
        );
    });
    println!("{}", report.page("example"));
}
