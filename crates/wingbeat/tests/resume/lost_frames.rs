//! Frames that a flight that goes on does not need.

use std::fs;
use std::path::Path;

use wingbeat::results::{Outcome, ResultDir, RunWriter, saver};

use super::{fly, interrupted, manifest};
use crate::support::{Scratch, wingbeat};

/// Nothing that is flown needs the frames of earlier steps: those that were lost are named, and the flight goes on to the
/// same history. What shows them names them again.
#[test]
fn behaves_a_run_goes_on_without_frames_that_were_lost_cut_or_damaged() {
    let scratch = Scratch::new("lost");
    let whole = fly(&scratch.0, "whole");
    let dir = scratch.0.join("run");
    interrupted(&dir);
    let lost = || {
        let dir = ResultDir::open(&dir).unwrap();
        let saved = saver::read(dir.path()).unwrap();
        let ((header, _), case) = (saved.checkpoint.unwrap(), dir.case().unwrap());
        let writer = RunWriter::resume(dir, &case, &header, saved.manifest, 1).unwrap();
        let lost = writer.lost_frames().iter().map(ToString::to_string);
        lost.collect::<Vec<_>>()
    };
    assert!(lost().is_empty());
    for part in ["surfaces", "wakes"] {
        let path = dir.join(format!("frames/{part}_000000.vtp"));
        let whole = fs::read(&path).unwrap();
        let changed = |by: u8| {
            let mut bytes = whole.clone();
            bytes[whole.len() / 2] ^= by;
            bytes
        };
        let damages = [
            (Some(vec![]), "this frame is cut"),
            (Some(whole[..whole.len() / 2].to_vec()), "this frame is cut"),
            (Some(changed(1)), "its checksum is wrong"),
            (Some(changed(0x80)), "it is no text"),
            (Some([&whole[..], b"more"].concat()), "this frame is cut"),
            (None, "was written and is missing"),
        ];
        for (bytes, problem) in damages {
            match bytes {
                Some(bytes) => fs::write(&path, bytes).unwrap(),
                None => fs::remove_file(&path).unwrap(),
            }
            let said = lost().join("\n");
            for part in [problem, &format!("{part}_000000.vtp"), "goes on without it"] {
                assert_eq!(said.matches(part).count(), 1, "{said}");
            }
        }
        fs::write(&path, whole).unwrap();
    }
    fs::write(dir.join("frames/wakes_000000.vtp"), "").unwrap();
    let done = wingbeat(&dir, &["resume", ".", "--quiet"]);
    let said = String::from_utf8_lossy(&done.stderr);
    // The page alone is missing.
    assert_eq!(done.status.code(), Some(1), "{said}");
    for part in [
        "warning: ",
        "wakes_000000.vtp",
        "what needs that file is not drawn",
    ] {
        assert!(said.contains(part), "{said}");
    }
    let history = |dir: &Path| fs::read(dir.join("history.csv")).unwrap();
    assert!(history(&dir) == history(&whole));
    assert_eq!(manifest(&dir).outcome, Outcome::Finished);
}
