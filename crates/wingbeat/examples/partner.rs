//! A partner for `air.model = "external"`: the smallest program that speaks the protocol of
//! `docs/external-air.md`. Its air is syrup: a force `-c v` on the origin of every body.
//!
//! `partner C` with C in N s/m. A flow solver takes the place of `drag`; one with a memory saves
//! its state at every `accept` and goes back to that of step K - 1 at `evaluate K`.

use std::io::{BufRead, Write, stdin, stdout};

fn main() {
    let coefficient = std::env::args().nth(1).and_then(|c| c.parse().ok());
    let result = match coefficient {
        Some(c) => talk(c),
        None => Err("usage: partner COEFFICIENT".into()),
    };
    if let Err(problem) = result {
        println!("error {problem}");
        std::process::exit(1);
    }
}

fn talk(coefficient: f64) -> Result<(), Box<dyn std::error::Error>> {
    let mut lines = stdin().lock().lines();
    let mut bodies = 0;
    while let Some(line) = lines.next() {
        let line = line?;
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["wingbeat-air", "2"] | ["step_s", _] | ["accept", _] => {}
            ["bodies", count] => {
                bodies = count.parse()?;
                for _ in 0..bodies {
                    lines.next().ok_or("a name is missing")??;
                }
            }
            ["joints", count] => {
                for _ in 0..count.parse()? {
                    lines.next().ok_or("a joint is missing")??;
                }
                println!("ready 2");
            }
            ["evaluate", _step, _time] => {
                for _ in 0..bodies {
                    let motion = lines.next().ok_or("a motion is missing")??;
                    println!("{}", drag(coefficient, &motion)?);
                }
            }
            ["end"] => return Ok(()),
            _ => return Err(format!("cannot understand `{line}`").into()),
        }
        stdout().flush()?;
    }
    Ok(())
}

/// Force and moment for a line of 18 numbers: position, rotation by rows, velocity, rate.
fn drag(c: f64, motion: &str) -> Result<String, Box<dyn std::error::Error>> {
    let x: Result<Vec<f64>, _> = motion.split_whitespace().map(str::parse).collect();
    let x: Vec<f64> = x?;
    let v = x.get(12..15).ok_or("18 numbers a body are needed")?;
    Ok(format!(
        "{:e} {:e} {:e} 0 0 0",
        -c * v[0],
        -c * v[1],
        -c * v[2]
    ))
}
