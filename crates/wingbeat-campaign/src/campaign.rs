//! A campaign: its file read and checked, its points with their cases and hashes.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use wingbeat_case::{Document, IoError, LoadedCase};
use wingbeat_flight::FlightSetup;

use crate::axes::Reader;
use crate::blocks::points_of_block;
use crate::cases;
use crate::checks::Words;
use crate::named::{self, Contents};
use crate::number::Number;
use crate::plan::{Place, Plan};
use crate::raw::{RawCampaign, Task, TrimOptions};
use crate::trial::Trial;

/// What to do where the file of a campaign cannot be read.
const REMEDY: &str = "docs/campaigns.md has campaigns to start from";

/// A campaign, read and checked.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// Its name.
    pub name: String,
    /// The file.
    pub path: PathBuf,
    /// As it was written.
    pub raw: RawCampaign,
    /// Its points.
    pub plan: Plan,
    /// The numbers that are kept.
    pub numbers: Vec<Number>,
    /// The case without the values of a point.
    pub base: LoadedCase,
    /// Points of a block, which a worker takes at once.
    pub block: usize,
    document: Document,
    /// What paths in the case are relative to.
    case_folder: PathBuf,
    /// Of everything but the values of the point.
    digest: Sha256,
    /// What is in the files that values name.
    contents: Contents,
}

/// A file whose points can be flown, before it is known which numbers are kept of them.
struct Points {
    name: String,
    document: Document,
    raw: RawCampaign,
    plan: Plan,
    base: LoadedCase,
    case_folder: PathBuf,
}

impl Points {
    fn read(path: &Path) -> Result<Self, IoError> {
        let document = Document::read(path, REMEDY)?;
        crate::checks::shape(&document)?;
        let raw: RawCampaign = document.decode()?;
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        let stem = path.file_stem().and_then(|s| s.to_str());
        let name = raw.name.clone();
        let name = name.unwrap_or_else(|| stem.unwrap_or("campaign").to_owned());
        let words = Words {
            document: &document,
            raw: &raw,
        };
        words.check(&name)?;
        let reader = Reader {
            document: &document,
            folder: &folder,
        };
        let plan = reader.plan(&raw)?;
        let base = words.base_case(&folder)?;
        let points = Self {
            name,
            case_folder: cases::folder_of(&raw, &folder),
            document,
            raw,
            plan,
            base,
        };
        points.trial().check()?;
        Ok(points)
    }

    fn trial(&self) -> Trial<'_> {
        Trial {
            document: &self.document,
            raw: &self.raw,
            plan: &self.plan,
            base: &self.base,
            folder: &self.case_folder,
        }
    }
}

impl Campaign {
    /// Reads the file of a campaign and checks it, as far as that goes without flying.
    ///
    /// # Errors
    /// The first thing in it that cannot be done, with its line.
    pub fn read(path: &Path) -> Result<Self, IoError> {
        let points = Points::read(path)?;
        let numbers = points.trial().kept()?;
        let Points {
            name,
            document,
            raw,
            plan,
            base,
            case_folder,
        } = points;
        Ok(Self {
            path: path.to_owned(),
            digest: digest_of(&raw, &base, &numbers),
            contents: named::contents(&plan, &base, &case_folder),
            block: points_of_block(&raw, &base.setup, plan.points()),
            name,
            raw,
            plan,
            numbers,
            base,
            document,
            case_folder,
        })
    }

    /// The numbers that the campaign of a file may keep, whatever it keeps.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn possible_numbers(path: &Path) -> Result<Vec<Number>, IoError> {
        Points::read(path)?.trial().all_possible()
    }

    fn trial(&self) -> Trial<'_> {
        Trial {
            document: &self.document,
            raw: &self.raw,
            plan: &self.plan,
            base: &self.base,
            folder: &self.case_folder,
        }
    }

    /// What an estimate finds doubtful of the case and of the points that are tried, each said once.
    pub fn doubts(&self) -> Vec<String> {
        self.trial().doubts()
    }

    /// What is asked of the trim at point `i`; nothing where nothing is trimmed.
    ///
    /// # Errors
    /// A value that cannot be used.
    pub fn trim_options(&self, i: usize) -> Result<Option<TrimOptions>, IoError> {
        self.trial().trim_options(i)
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        self.document.text()
    }

    /// What is put on top of the case at point `i`, without the options of the trim.
    pub fn overrides(&self, i: usize) -> Vec<String> {
        cases::overrides(&self.raw, &self.plan, i)
    }

    /// The case of point `i`, with `more` put on top.
    ///
    /// # Errors
    /// A case that cannot be flown.
    pub fn case(&self, i: usize, more: &[String]) -> Result<LoadedCase, IoError> {
        let overrides = [&self.overrides(i)[..], more].concat();
        cases::with(&self.base, &self.case_folder, &overrides)
    }

    /// The text of the case of point `i`.
    ///
    /// # Errors
    /// A key that cannot be put into it.
    pub fn case_text(&self, i: usize) -> Result<String, IoError> {
        wingbeat_case::overridden(self.base.origin(), self.base.text(), &self.overrides(i))
    }

    /// SHA-256 of what is done at point `i`: version, case, tasks, numbers that are kept, values of the point and what is in
    /// the files that they name, and in those that commands of other programs name. Which files of it are kept is no part.
    pub fn hash(&self, i: usize) -> [u8; 32] {
        let mut hash = self.digest.clone();
        for line in self.plan.overrides(i) {
            hash.update(&line);
            hash.update(b"\n");
            if let Some(content) = self.contents.get(&line) {
                hash.update(content);
            }
        }
        hash.finalize().into()
    }

    /// SHA-256 of the whole plan, which blocks of points belong to: which points there are and in which order, and what is
    /// kept of them.
    pub fn plan_hash(&self) -> [u8; 32] {
        let raw = &self.raw;
        let mut hash = self.digest.clone();
        let varied = (&raw.parameter, &raw.zip, self.plan.samples, raw.seed);
        // The keys as they follow each other in the file: points are counted in this order.
        let keys = (self.plan.keys(), self.block);
        let files = (&raw.files, raw.retention.every, raw.retention.failed);
        hash.update(format!("{varied:?} {keys:?} {files:?}\n"));
        if let Some(axis) = self.plan.axes.iter().find(|a| a.place == Place::Table) {
            hash.update(format!("{axis:?}"));
        }
        self.contents.values().for_each(|c| hash.update(c));
        hash.finalize().into()
    }

    /// Whether point `i` has a result directory of its own while it is flown: it keeps files, or its air has wakes in space
    /// and takes long.
    pub fn has_directory(&self, i: usize, setup: &FlightSetup) -> bool {
        let runs = self.raw.tasks.contains(&Task::Run);
        runs && (self.keeps_files(i) || setup.air.keeps_wake())
    }

    /// Whether files of point `i` are kept.
    pub fn keeps_files(&self, i: usize) -> bool {
        !self.raw.files.is_empty() && i.is_multiple_of(self.raw.retention.every)
    }
}

/// What all points have in common.
fn digest_of(raw: &RawCampaign, base: &LoadedCase, numbers: &[Number]) -> Sha256 {
    let mut hash = Sha256::new_with_prefix(concat!("wingbeat ", env!("CARGO_PKG_VERSION"), "\n"));
    hash.update(Sha256::digest(base.resolved()));
    hash.update(Sha256::digest(base.text()));
    let tasks = (&raw.tasks, &raw.trim, &raw.keep, raw.mean_beats(), &raw.set);
    hash.update(format!("{tasks:?}\n"));
    if let Some(programs) = named::of_programs(base) {
        hash.update(programs);
    }
    if numbers.iter().any(|n| n.source.is_extreme()) {
        hash.update("extremes of the last wingbeats\n"); // they were those of the whole flight once
    }
    hash
}
