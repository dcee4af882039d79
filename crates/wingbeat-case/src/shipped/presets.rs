//! Presets: ordinary case files, embedded, commented, ready to be written out and edited.

use crate::error::IoError;
use crate::shipped::species::SPECIES;
use crate::text::nearest::nearest;

/// An embedded case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preset {
    /// Name on the command line.
    pub name: &'static str,
    /// The case file.
    pub text: &'static str,
}

impl Preset {
    /// One line about the case: the first comment of its file.
    pub fn line(&self) -> &'static str {
        self.text
            .lines()
            .next()
            .unwrap_or("")
            .trim_start_matches("# ")
    }
}

macro_rules! presets {
    ($($name:literal),* $(,)?) => {
        /// All presets, the default first.
        pub const PRESETS: &[Preset] = &[$(Preset {
            name: $name,
            text: include_str!(concat!("../../presets/", $name, ".toml")),
        }),*];
    };
}

presets![
    "fruit-fly-hover",
    "fruit-fly-tethered",
    "fruit-fly-vacuum",
    "fruit-fly-blade",
    "fruit-fly-controlled",
    "bumblebee-blade",
    "hoverfly-blade",
    "hawkmoth-blade",
    "hawkmoth-elastic",
    "hawkmoth-veins",
    "hummingbird-robot",
    "locust-blade",
    "fruit-fly-abdomen",
    "fruit-fly-abdomen-spring",
    "robobee",
    "robobee-elastic",
    "dragonfly",
    "bird-cruise",
    "bird-cruise-elastic",
    "membrane-wing",
    "rectangular-wing",
    "flapping-rectangles",
    "robofly-advanced",
    "robofly-symmetrical",
    "robofly-delayed",
    "benchmark-1",
    "benchmark-2",
    "roccia-2011",
    "roccia-2011-five-bodies",
    "table1-taylor-thomas-2003",
    "table1-sun-xiong-2005",
    "table1-doman-2009",
    "table1-deng-2001",
    "table1-bolender-2009",
    "table1-sun-2007",
    "table1-sun-2007-hawkmoth",
    "table1-buler-2004",
    "table1-grauer-hubbard-2009",
    "table1-orlowski-2010",
    "table1-lasek-sibilski-2002",
    "table1-dietl-garcia-2008",
];

/// The preset flown when no case is named.
pub const DEFAULT: &str = PRESETS[0].name;

/// A preset by name.
///
/// # Errors
/// [`IoError::NoCase`] with the nearest name.
pub fn find(name: &str) -> Result<Preset, IoError> {
    let found = PRESETS.iter().find(|p| p.name == name);
    found.copied().ok_or_else(|| {
        let names: Vec<&str> = PRESETS.iter().map(|p| p.name).collect();
        let is_species = SPECIES.iter().any(|s| s.name == name);
        let hint = match nearest(name, &names) {
            _ if is_species => {
                format!(", but a species: `wingbeat new --species {name}` writes a case of it")
            }
            Some(near) => format!(", did you mean `{near}`?"),
            None => String::new(),
        };
        IoError::NoCase {
            name: name.to_owned(),
            hint,
        }
    })
}
