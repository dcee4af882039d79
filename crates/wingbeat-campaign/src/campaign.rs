//! A campaign: its file read and checked, its points with their cases and hashes.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use wingbeat_case::{IoError, LoadedCase};
use wingbeat_results::summary::starting_beats;

use crate::digest::{LAW_OF_BLADES, law_of, of_case};
use crate::plan::blocks::points_of_block;
use crate::plan::cases;
use crate::plan::file::CampaignFile;
use crate::plan::named::{self, Contents, Programs, Seen};
use crate::plan::number::Number;
use crate::plan::raw::{RawCampaign, Task, TrimOptions};
use crate::plan::{Place, Plan};

/// A campaign, read and checked.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// Where its file is.
    pub path: PathBuf,
    /// The numbers that are kept.
    pub numbers: Vec<Number>,
    /// Points of a block, which a worker takes at once.
    pub block: usize,
    file: CampaignFile,
    /// Of everything but the values of the point.
    digest: Sha256,
    /// What is in the files that values name.
    contents: Contents,
    /// What is in the files that commands name.
    programs: Programs,
    /// The files that points read, as they were.
    files: BTreeMap<PathBuf, Seen>,
}

impl Campaign {
    /// Reads the file of a campaign and checks it, as far as that goes without flying.
    ///
    /// # Errors
    /// The first thing in it that cannot be done, with its line.
    pub fn read(path: &Path) -> Result<Self, IoError> {
        let file = checked(path)?;
        let numbers = file.kept()?;
        let files = named::files(&file.raw, &file.plan, &file.base, &file.case_folder);
        Ok(Self {
            files,
            path: path.to_owned(),
            digest: digest_of(&file, &numbers),
            contents: named::contents(&file.plan, &file.base, &file.case_folder),
            programs: named::programs(&file.plan, &file.base, &file.case_folder),
            block: points_of_block(&file.raw, &file.base.setup, file.plan.points()),
            numbers,
            file,
        })
    }

    /// The numbers that the campaign of a file may keep, whatever it keeps.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn possible_numbers(path: &Path) -> Result<Vec<Number>, IoError> {
        checked(path)?.all_possible()
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.file.name
    }

    /// What its file says, as it was written.
    pub fn raw(&self) -> &RawCampaign {
        &self.file.raw
    }

    /// Its points.
    pub fn plan(&self) -> &Plan {
        &self.file.plan
    }

    /// The case without the values of a point; with those of the first one where it cannot be flown without.
    pub fn base(&self) -> &LoadedCase {
        &self.file.base
    }

    /// What an estimate finds doubtful of the case and of the points that are tried, each said once.
    pub fn doubts(&self) -> Vec<String> {
        self.file.doubts()
    }

    /// What is asked of the trim at point `i`; nothing where nothing is trimmed.
    ///
    /// # Errors
    /// A value that cannot be used.
    pub fn trim_options(&self, i: usize) -> Result<Option<TrimOptions>, IoError> {
        self.file.trim_options(i)
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        self.file.document.text()
    }

    /// What is put on top of the case at point `i`, without the options of the trim.
    pub fn overrides(&self, i: usize) -> Vec<String> {
        cases::overrides(&self.file.raw, &self.file.plan, i)
    }

    /// The case of point `i`, with `more` put on top.
    ///
    /// # Errors
    /// A case that cannot be flown.
    pub fn case(&self, i: usize, more: &[String]) -> Result<LoadedCase, IoError> {
        let overrides = [&self.overrides(i)[..], more].concat();
        cases::with(&self.file.base, &self.file.case_folder, &overrides)
    }

    /// The text of the case of point `i`.
    ///
    /// # Errors
    /// A key that cannot be put into it.
    pub fn case_text(&self, i: usize) -> Result<String, IoError> {
        wingbeat_case::overridden(
            self.file.base.origin(),
            self.file.base.text(),
            &self.overrides(i),
        )
    }

    /// SHA-256 of what is done at point `i`: version, case, tasks, numbers that are kept, values of the point
    /// and what is in the files that they name, and in those that commands of other programs name. Which files
    /// of it are kept is no part.
    pub fn hash(&self, i: usize) -> [u8; 32] {
        let mut hash = self.digest.clone();
        for line in self.file.plan.overrides(i) {
            hash.update(&line);
            hash.update(b"\n");
            if let Some(content) = self.contents.get(&line) {
                hash.update(content);
            }
        }
        hash.finalize().into()
    }

    /// Files that commands of other programs name and that are no longer what they were when the campaign was read.
    pub fn changed_programs(&self) -> Vec<PathBuf> {
        let now = named::programs(&self.file.plan, &self.file.base, &self.file.case_folder);
        let changed = now
            .into_iter()
            .filter(|(path, is)| self.programs.get(path) != Some(is));
        changed.map(|(path, _)| path).collect()
    }

    /// The files that points follow from beside the campaign's own: the case, the table, those that they name.
    pub fn inputs(&self) -> Vec<PathBuf> {
        let origin = PathBuf::from(self.file.base.origin());
        let table = self.raw().table.as_ref();
        let table = table.map(|t| self.path.parent().unwrap_or(Path::new("")).join(t));
        let named = self.files.keys().chain(self.programs.keys()).cloned();
        let all = [origin].into_iter().chain(table).chain(named);
        let files: BTreeSet<PathBuf> = all.filter(|path| path.is_file()).collect();
        files.into_iter().collect()
    }

    /// Refuses results of points where a file that they read is no longer what it was when the campaign was read.
    ///
    /// # Errors
    /// The file.
    pub fn refuse_changed_files(&self) -> Result<(), IoError> {
        let mut files = self.files.iter();
        match files.find(|(path, seen)| seen.differs(path)) {
            None => Ok(()),
            Some((path, _)) => Err(IoError::Damaged {
                path: path.clone(),
                problem: "it was changed while the campaign was flown, and its points read it: the same command flies them as it is now".to_owned(),
            }),
        }
    }

    /// SHA-256 of the whole plan, which blocks of points belong to: which points there are and in which order,
    /// and what is kept of them.
    pub fn plan_hash(&self) -> [u8; 32] {
        let raw = &self.file.raw;
        let mut hash = self.digest.clone();
        let varied = (&raw.parameter, &raw.zip, self.file.plan.samples, raw.seed);
        // The keys as they follow each other in the file: points are counted in this order.
        let keys = (self.file.plan.keys(), self.block);
        let files = (&raw.files, raw.retention.every, raw.retention.failed);
        hash.update(format!("{varied:?} {keys:?} {files:?}\n"));
        if let Some(axis) = self.file.plan.axes.iter().find(|a| a.place == Place::Table) {
            hash.update(format!("{axis:?}"));
        }
        self.contents.values().for_each(|c| hash.update(c));
        hash.finalize().into()
    }

    /// Whether point `i`, whose case is `case`, has a result directory of its own while it is flown: it keeps files,
    /// also if it fails, its history leaves steps out, or its air has wakes in space and takes long.
    pub fn has_directory(&self, i: usize, case: &LoadedCase) -> bool {
        let raw = &self.file.raw;
        let keeps = self.keeps_files(i) || raw.retention.failed;
        let needs = case.output.history_every > 1 || case.setup.air.keeps_wake();
        raw.tasks.contains(&Task::Run) && (keeps || needs)
    }

    /// Whether files of point `i` are kept.
    pub fn keeps_files(&self, i: usize) -> bool {
        !self.file.raw.files.is_empty() && i.is_multiple_of(self.file.raw.retention.every)
    }
}

/// The file of a campaign, its points tried.
fn checked(path: &Path) -> Result<CampaignFile, IoError> {
    let file = CampaignFile::read(path)?;
    file.check()?;
    Ok(file)
}

/// What all points have in common.
fn digest_of(file: &CampaignFile, numbers: &[Number]) -> Sha256 {
    let (raw, base) = (&file.raw, &file.base);
    let mut hash = of_case(base);
    let tasks = (&raw.tasks, &raw.trim, &raw.keep, raw.mean_beats(), &raw.set);
    hash.update(format!("{tasks:?}\n"));
    if !raw.remove.is_empty() {
        hash.update(format!("without {:?}\n", raw.remove));
    }
    if let Some(programs) = named::of_programs(base) {
        hash.update(programs);
    }
    if numbers.iter().any(|n| n.source.is_extreme()) {
        hash.update("extremes of the last wingbeats\n"); // they were those of the whole flight once
    }
    let starts = starting_beats(&base.setup) > 0 || file.plan.varies_starts();
    if starts && numbers.iter().any(|n| n.source.is_mean()) {
        hash.update("means without starts and holds\n"); // they were of the last wingbeats, whatever these were
    }
    if file.plan.varies("air.model") {
        hash.update(LAW_OF_BLADES);
    } else {
        hash.update(law_of(&base.setup));
    }
    hash
}
