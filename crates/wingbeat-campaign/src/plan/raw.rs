//! The file of a campaign as it is written: every key once, with its meaning and default.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

/// A campaign.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RawCampaign {
    /// Version of the language, 1.
    #[serde(default = "first")]
    pub format: u32,
    /// Name of the campaign and of its directory; default that of the file.
    pub name: Option<String>,
    /// What it is for.
    #[serde(default)]
    pub description: String,
    /// What is varied: a preset, or a case file (its path relative to this file).
    pub case: String,
    /// Keys of the case that have other values at all points.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, serde_json::Value>")]
    pub set: BTreeMap<String, toml::Value>,
    /// Keys of the case that are taken out of it at all points.
    #[serde(default)]
    pub remove: Vec<String>,
    /// Seed of everything that is drawn; below 2^32 where `sobol` is.
    pub seed: Option<usize>,
    /// Points that are drawn (at every point of the grid, where there is one).
    pub samples: Option<usize>,
    /// What is done at each point, one after the other.
    #[serde(rename = "do", default = "only_run")]
    pub tasks: Vec<Task>,
    /// Numbers that are kept, by their names, one at least; `wingbeat campaign numbers FILE` lists all.
    #[serde(default)]
    pub keep: Vec<String>,
    /// Whole wingbeats over which means are taken, the last of those counted from the start, none of them one that a smooth
    /// start or a hold reaches into; 1 or more, default 1.
    pub mean_beats: Option<usize>,
    /// Files that are kept of each flight.
    #[serde(default)]
    pub files: Vec<FileKind>,
    /// Varied keys: how each is varied.
    #[serde(default)]
    pub parameter: BTreeMap<String, Variation>,
    /// Groups of keys that vary together, each with a list of the same length.
    #[serde(default)]
    #[schemars(with = "Vec<BTreeMap<String, Vec<serde_json::Value>>>")]
    pub zip: Vec<BTreeMap<String, Vec<toml::Value>>>,
    /// A CSV file with a column for each key, a row for each point (its path relative to this file).
    pub table: Option<String>,
    /// What is asked of the trim.
    pub trim: Option<TrimOptions>,
    /// What a point may cost.
    #[serde(default)]
    pub budget: Budget,
    /// Of which points the files stay.
    #[serde(default)]
    pub retention: Retention,
}

impl RawCampaign {
    /// Wingbeats that means are taken over.
    pub fn mean_beats(&self) -> usize {
        self.mean_beats.unwrap_or(1)
    }
}

fn first() -> u32 {
    1
}

fn only_run() -> Vec<Task> {
    vec![Task::Run]
}

/// What is done at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// Fly the case; after a trim, what was trimmed.
    Run,
    /// Find the steady flight.
    Trim,
    /// Modes of the trimmed flight.
    Stability,
    /// Mechanical power of the trimmed flight.
    Power,
}

impl Task {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Trim => "trim",
            Self::Stability => "stability",
            Self::Power => "power",
        }
    }
}

/// The key of the case that says how often frames are written.
pub(crate) const FRAMES_EVERY: &str = "output.frames_every";

/// The key of the case that says how often the history has a row.
pub(crate) const HISTORY_EVERY: &str = "output.history_every";

/// A file, or files, of a result directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FileKind {
    /// The flight page.
    Page,
    /// history.csv.
    History,
    /// The figures.
    Figures,
    /// The frames for `ParaView`.
    Frames,
    /// summary.txt and summary.json.
    Summary,
}

/// How a key is varied.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Variation {
    /// These values; lists multiply.
    #[schemars(with = "Vec<serde_json::Value>")]
    List(Vec<toml::Value>),
    /// So many values, evenly spaced; ranges multiply.
    Range(Range),
    /// The same, evenly spaced in the logarithm.
    LogRange(Range),
    /// Drawn, one value from each of as many equal parts as there are samples [`McKay` et al. 1979].
    LatinHypercube(Ends),
    /// Drawn from an Owen-scrambled Sobol sequence.
    Sobol(Ends),
    /// Drawn, all values equally likely.
    Uniform(Ends),
    /// Drawn, all logarithms equally likely.
    LogUniform(Ends),
    /// Drawn from a normal distribution.
    Normal(Normal),
}

/// A range of values, both ends in it.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// First value.
    #[schemars(with = "f64")]
    pub from: toml::Value,
    /// Last value.
    #[schemars(with = "f64")]
    pub to: toml::Value,
    /// How many.
    pub count: usize,
}

/// The ends of what is drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ends {
    /// Least value \[unit of the key\].
    pub from: f64,
    /// Largest value \[unit of the key\].
    pub to: f64,
}

/// A normal distribution, cut off where ends are given.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Normal {
    /// Mean before it is cut off \[unit of the key\].
    pub mean: f64,
    /// Standard deviation before it is cut off \[unit of the key\].
    pub standard_deviation: f64,
    /// Least value \[unit of the key\].
    pub from: Option<f64>,
    /// Largest value \[unit of the key\].
    pub to: Option<f64>,
}

/// What is asked of the trim; each key may be a parameter too, as `trim.forward_m_s`.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrimOptions {
    /// Mean velocity forward (n1) [m/s].
    pub forward_m_s: Option<f64>,
    /// Mean velocity upward [m/s].
    pub climb_m_s: Option<f64>,
    /// Mean velocity to the right [m/s].
    pub sideslip_m_s: Option<f64>,
    /// Steady turn to the right [deg/s].
    pub turn_rate_deg_s: Option<f64>,
    /// What trim may choose, as `--unknowns` of `wingbeat trim`.
    pub unknowns: Option<Vec<String>>,
    /// Steps per wingbeat, default 100.
    pub steps_per_beat: Option<usize>,
}

/// What a point may cost.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Budget {
    /// How often a point is tried whose process dies, or whose files cannot be written.
    pub attempts: usize,
    /// Time that a point may take before it counts as failed [s]; default without end.
    pub time_per_point_s: Option<f64>,
    /// Size of the campaign's directory at which workers stop [MB]; default without end.
    pub disk_mb: Option<f64>,
}

impl Default for Budget {
    fn default() -> Self {
        Self {
            attempts: 3,
            time_per_point_s: None,
            disk_mb: None,
        }
    }
}

/// Of which points files stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Retention {
    /// The files of every so many points, the first among them.
    pub every: usize,
    /// Whether the result directory of a flight that failed stays.
    pub failed: bool,
}

impl Default for Retention {
    fn default() -> Self {
        Self {
            every: 1,
            failed: false,
        }
    }
}
