//! What fuzzing of checkpoints and frames begins with.

use crate::tiny;

use std::path::Path;

use wingbeat_results::checkpoint::{self, Header};
use wingbeat_results::vtp::PolyData;

/// Writes the seeds into `FOLDER/checkpoint` and `FOLDER/frame`.
pub fn write(folder: &Path) -> std::io::Result<()> {
    for part in ["checkpoint", "frame"] {
        std::fs::create_dir_all(folder.join(part))?;
    }
    for number in 0..tiny::COUNT {
        let mut flight = tiny::flight(number);
        for step in [0, 3, 6] {
            while flight.state().step < step {
                flight.step().expect("a preset flies");
            }
            let state = postcard::to_allocvec(flight.state()).expect("plain data");
            let file = folder.join(format!("checkpoint/flight-{number}-{step}"));
            std::fs::write(file, [&[number as u8][..], &state].concat())?;
        }
        let header = Header {
            version: "0.1.0".to_owned(),
            case_sha256: "0".repeat(64),
            step: flight.state().step,
            history_bytes: 1,
            history_sha256: "1".repeat(64),
            pending: vec![],
            each_step: vec![],
        };
        let file = checkpoint::encode(&header, flight.state());
        let first = file.iter().position(|b| *b == b'\n').expect("a line") + 1;
        let (whole, content) = (&file[..], &file[first..]);
        for (name, bytes) in [("whole", whole), ("content", content)] {
            let path = folder.join(format!("checkpoint/{name}-{number}"));
            std::fs::write(path, [b"\xff", bytes].concat())?;
        }
        let snapshot = flight.snapshot();
        let frames = [PolyData::surfaces(&snapshot), PolyData::wakes(&snapshot)];
        for (part, data) in frames.iter().enumerate() {
            let text = data.to_vtp();
            let (content, _) = text.split_once("<!-- SHA-256 of").expect("a checksum");
            std::fs::write(
                folder.join(format!("frame/flight-{number}-{part}")),
                content,
            )?;
        }
    }
    Ok(())
}
