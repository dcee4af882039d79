//! The checkpoint reader: any bytes are refused or give a state that is written back as it was
//! read; a flight refuses the state or goes on from it.
#![no_main]

mod seeds;
mod tiny;

use std::path::Path;
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use wingbeat_flight::{FlightSetup, FlightState, Simulation};
use wingbeat_results::checkpoint::{self, Header};
use wingbeat_results::manifest::sha256;

static SETUPS: LazyLock<Vec<FlightSetup>> = LazyLock::new(|| {
    let setup = |k| tiny::flight(k).setup().clone();
    (0..tiny::COUNT).map(setup).collect()
});

const CASE: &str = "0000000000000000000000000000000000000000000000000000000000000000";

fn read(bytes: &[u8]) -> Option<(Header, FlightState)> {
    match checkpoint::decode(Path::new("checkpoint.bin"), bytes, CASE) {
        Ok(read) => Some(read),
        Err(e) => {
            assert!(!e.to_string().is_empty());
            None
        }
    }
}

/// Bytes as they are, and as the content of a file whose checksum is right.
fn read_file(bytes: &[u8]) {
    read(bytes);
    let first = format!("wingbeat-checkpoint {} {}\n", checkpoint::FORMAT, sha256(bytes));
    read(&[first.as_bytes(), bytes].concat());
}

/// A state in a whole and true file.
fn read_state(flight: usize, bytes: &[u8]) {
    let Ok(state) = postcard::from_bytes::<FlightState>(bytes) else {
        return;
    };
    let header = Header {
        version: "0.1.0".to_owned(),
        case_sha256: CASE.to_owned(),
        step: state.step,
        history_bytes: 0,
        history_sha256: CASE.to_owned(),
            pending: vec![],
            each_step: vec![],
    };
    let file = checkpoint::encode(&header, &state);
    let (_, state) = read(&file).expect("a checkpoint that was just written is read");
    assert_eq!(file, checkpoint::encode(&header, &state));
    if let Ok(mut flight) = Simulation::resume(SETUPS[flight].clone(), state) {
        if flight.step().is_ok() {
            let _ = flight.snapshot();
        }
    }
}

/// `WINGBEAT_SEEDS=FOLDER` writes seeds instead of fuzzing.
fn begin() {
    if let Some(folder) = std::env::var_os("WINGBEAT_SEEDS") {
        seeds::write(Path::new(&folder)).expect("a folder that can be written");
        std::process::exit(0);
    }
}

// The first byte says what the others are: a file, or the state of one of the flights.
fuzz_target!(init: begin(), |data: &[u8]| {
    match data.split_first() {
        Some((kind, bytes)) if usize::from(*kind) < tiny::COUNT => {
            read_state(usize::from(*kind), bytes);
        }
        Some((_, bytes)) => read_file(bytes),
        None => {}
    }
});
