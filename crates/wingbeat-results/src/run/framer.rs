//! Frames are put into words and onto the disk by a thread of their own, while the next steps are
//! flown.
//!
//! At most one frame waits: memory does not grow, and a slow disk slows the flight down. Whoever
//! needs all frames to be there (a checkpoint, the index) waits for them with [`Framer::wait`].

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use wingbeat_flight::Snapshot;

use crate::run::directory::write_whole;
use crate::snapshots::particles::Cloud;
use crate::snapshots::vtp::{PolyData, frame_name};
use wingbeat_case::IoError;

/// Writes frames one after the other.
pub(super) struct Framer {
    /// None once it ends.
    snapshots: Option<SyncSender<Snapshot>>,
    results: Receiver<Result<(), IoError>>,
    thread: Option<JoinHandle<()>>,
    waiting: bool,
}

impl Framer {
    /// For frames of these parts in a folder.
    pub fn new(folder: PathBuf, parts: &'static [&'static str]) -> Self {
        let (snapshots, inbox) = sync_channel::<Snapshot>(1);
        let (outbox, results) = sync_channel(1);
        let thread = std::thread::spawn(move || {
            for snapshot in inbox {
                let written = parts.iter().try_for_each(|stem| {
                    let path = folder.join(frame_name(stem, snapshot.step));
                    write_whole(&path, text(stem, &snapshot).as_bytes())
                });
                if outbox.send(written).is_err() {
                    break; // nobody waits any more
                }
            }
        });
        Self {
            snapshots: Some(snapshots),
            results,
            thread: Some(thread),
            waiting: false,
        }
    }

    /// Takes a frame, once the one before is on the disk.
    ///
    /// # Errors
    /// The frame before could not be written.
    pub fn put(&mut self, snapshot: Snapshot) -> Result<(), IoError> {
        self.wait()?;
        let thread = self.snapshots.as_ref().expect("it has not ended");
        thread.send(snapshot).expect("the thread lives");
        self.waiting = true;
        Ok(())
    }

    /// Waits until every frame is written.
    ///
    /// # Errors
    /// A frame could not be written.
    pub fn wait(&mut self) -> Result<(), IoError> {
        match std::mem::take(&mut self.waiting) {
            true => self.results.recv().expect("the thread lives"),
            false => Ok(()),
        }
    }
}

impl Drop for Framer {
    fn drop(&mut self) {
        self.snapshots = None; // ends the thread after what it has begun
        if let Some(thread) = self.thread.take() {
            let _ = thread.join(); // its panic has been told
        }
    }
}

/// A part of a frame as a file.
fn text(stem: &str, snapshot: &Snapshot) -> String {
    match stem {
        "surfaces" => PolyData::surfaces(snapshot).to_vtp(),
        "wakes" => PolyData::wakes(snapshot).to_vtp(),
        _ => Cloud::of(snapshot).to_vtp(),
    }
}
