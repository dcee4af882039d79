//! Where the pictures of an animation go: a GIF, or a film (MP4) that ffmpeg makes of them.

use std::ffi::OsString;
use std::fs::File;
use std::io::{BufWriter, Read as _, Write as _};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, Stdio};
use std::thread::{self, JoinHandle};

use gif::{Encoder, Frame, Repeat};

/// Width and height \[points\].
pub(super) const SIZE: [f64; 2] = [560.0, 420.0];

/// Takes pictures one after the other.
pub(super) trait Reel {
    /// Pixels per point of its pictures.
    fn scale(&self) -> f64;

    /// Adds a picture.
    fn add(&mut self, rgb: &[u8]) -> Result<(), String>;

    /// Ends it.
    fn end(&mut self) -> Result<(), String>;
}

fn pixels(scale: f64) -> [u32; 2] {
    SIZE.map(|s| (s * scale) as u32)
}

/// An endless GIF.
pub(super) struct Gif(Option<Encoder<BufWriter<File>>>);

impl Gif {
    /// Time a picture is shown \[1/100 s\].
    const DELAY: u16 = 6;

    /// Begins a file.
    pub fn begin(path: &Path) -> Result<Self, String> {
        let file = File::create(path).map_err(|e| e.to_string())?;
        let [width, height] = pixels(1.0).map(|x| x as u16);
        let encoder = Encoder::new(BufWriter::new(file), width, height, &[]);
        let mut encoder = encoder.map_err(|e| e.to_string())?;
        encoder
            .set_repeat(Repeat::Infinite)
            .map_err(|e| e.to_string())?;
        Ok(Self(Some(encoder)))
    }
}

impl Reel for Gif {
    fn scale(&self) -> f64 {
        1.0
    }

    fn add(&mut self, rgb: &[u8]) -> Result<(), String> {
        let [width, height] = pixels(1.0).map(|x| x as u16);
        let mut picture = Frame::from_rgb_speed(width, height, rgb, 15);
        picture.delay = Self::DELAY;
        match &mut self.0 {
            Some(encoder) => encoder.write_frame(&picture).map_err(|e| e.to_string()),
            None => Err("the animation has ended".to_owned()),
        }
    }

    fn end(&mut self) -> Result<(), String> {
        // To be told of a disk that is full: what is dropped tells nothing.
        let Some(encoder) = self.0.take() else {
            return Ok(());
        };
        let mut file = encoder.into_inner().map_err(|e| e.to_string())?;
        file.flush().map_err(|e| e.to_string())
    }
}

/// A film made by ffmpeg (H.264, 25 pictures a second).
pub(super) struct Film {
    child: Child,
    /// What it complains of, read all the while: it stops once nobody takes its words.
    words: Option<JoinHandle<String>>,
}

impl Film {
    const SCALE: f64 = 2.0;

    /// Starts ffmpeg.
    pub fn begin(path: &Path) -> Result<Self, String> {
        let [width, height] = pixels(Self::SCALE);
        let before = [
            "-y",
            "-loglevel",
            "error",
            "-f",
            "rawvideo",
            "-pix_fmt",
            "rgb24",
        ];
        let after = [
            "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-f", "mp4",
        ];
        let child = Command::new("ffmpeg")
            .args(before)
            .args(["-s", &format!("{width}x{height}"), "-r", "25", "-i", "-"])
            .args(after)
            .args(["-movflags", "+faststart"])
            .arg(file_url(path))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn();
        let mut child = child.map_err(|e| {
            format!("ffmpeg, which makes films, cannot be started ({e}); install it, or use --format gif")
        })?;
        let words = child.stderr.take().map(|w| thread::spawn(|| all(w)));
        Ok(Self { child, words })
    }
}

/// A file as ffmpeg takes it: by its name alone it may be an option or the address of a stream.
fn file_url(path: &Path) -> OsString {
    let mut url = OsString::from("file:");
    url.push(path);
    url
}

/// All that is said.
fn all(mut words: ChildStderr) -> String {
    let mut said = vec![];
    let _ = words.read_to_end(&mut said); // words are no condition
    String::from_utf8_lossy(&said).trim().to_owned()
}

impl Reel for Film {
    fn scale(&self) -> f64 {
        Self::SCALE
    }

    fn add(&mut self, rgb: &[u8]) -> Result<(), String> {
        let Some(inbox) = &mut self.child.stdin else {
            return Err("ffmpeg takes no pictures".to_owned());
        };
        if inbox.write_all(rgb).is_err() {
            return self.end().and(Err("ffmpeg ended early".to_owned()));
        }
        Ok(())
    }

    fn end(&mut self) -> Result<(), String> {
        drop(self.child.stdin.take());
        let words = self.words.take().map(JoinHandle::join);
        match self.child.wait() {
            Ok(status) if status.success() => Ok(()),
            Ok(status) => {
                let said = words.and_then(Result::ok).unwrap_or_default();
                Err(format!("ffmpeg failed ({status}): {said}"))
            }
            Err(e) => Err(format!("ffmpeg: {e}")),
        }
    }
}

impl Drop for Film {
    fn drop(&mut self) {
        let _ = self.child.kill(); // of one that has ended this does nothing
        let _ = self.child.wait();
    }
}
