//! Processes, so that they can be found dead or alive.

use std::fs;

/// A process, so that it can be found dead or alive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Process {
    /// Machine, start of its system, name space of its process numbers.
    pub machine: String,
    /// Its number.
    pub number: u32,
    /// When it started, as the system counts; empty where it does not say.
    pub start: String,
}

impl Process {
    /// This one.
    pub fn own() -> Self {
        let word = |path: &str| {
            fs::read_to_string(path)
                .unwrap_or_default()
                .trim()
                .to_owned()
        };
        let space = fs::read_link("/proc/self/ns/pid").unwrap_or_default();
        let number = std::process::id();
        Self {
            machine: format!(
                "{}/{}/{}",
                host(),
                word("/proc/sys/kernel/random/boot_id"),
                space.display()
            )
            .replace([' ', '\n'], "_"),
            number,
            start: start_of(number).unwrap_or_default(),
        }
    }

    /// As a lease has it.
    pub fn decoded(text: &str) -> Option<Self> {
        let mut words = text.lines().next()?.split(' ');
        let own = Self {
            machine: words.next()?.to_owned(),
            number: words.next()?.parse().ok()?,
            start: words.next()?.to_owned(),
        };
        words.next().is_none().then_some(own)
    }
}

#[cfg(unix)]
fn host() -> String {
    rustix::system::uname()
        .nodename()
        .to_string_lossy()
        .into_owned()
}

#[cfg(not(unix))]
fn host() -> String {
    std::env::var("COMPUTERNAME").unwrap_or_default()
}

/// Field 22 of `/proc/N/stat`, after the name, which may hold anything.
pub fn start_of(number: u32) -> Option<String> {
    let stat = fs::read_to_string(format!("/proc/{number}/stat")).ok()?;
    let (_, rest) = stat.rsplit_once(')')?;
    let mut fields = rest.split_whitespace();
    let is_dead = matches!(fields.next(), Some("Z" | "X")); // killed, and nobody has looked yet
    (!is_dead).then(|| fields.nth(18).map(str::to_owned))?
}
