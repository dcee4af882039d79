//! The case of a point: what is put on top of the case that is varied.

use std::path::{Path, PathBuf};

use wingbeat_case::{IoError, LoadedCase};

use crate::plan::Plan;
use crate::plan::raw::RawCampaign;
use crate::plan::trimming::TRIM;

/// Keys of `remove` and of `[set]` as overrides.
pub fn set_of(raw: &RawCampaign) -> Vec<String> {
    let removed = raw.remove.iter().map(|key| format!("{key}="));
    let set = raw.set.iter().map(|(key, value)| format!("{key}={value}"));
    removed.chain(set).collect()
}

/// What is put on top of the case at point `i`, without the options of the trim.
pub fn overrides(raw: &RawCampaign, plan: &Plan, i: usize) -> Vec<String> {
    let of_point = plan.overrides(i).into_iter();
    let of_case = of_point.filter(|o| !o.starts_with(TRIM));
    set_of(raw).into_iter().chain(of_case).collect()
}

/// The case `base` with `overrides` in place of its own; `folder` is what paths in it are relative to.
///
/// # Errors
/// A case that cannot be flown.
pub fn with(base: &LoadedCase, folder: &Path, overrides: &[String]) -> Result<LoadedCase, IoError> {
    LoadedCase::from_text(base.origin(), base.text(), folder, overrides)
}

/// The folder that paths in the case are relative to; `folder` is that of the campaign's file.
pub fn folder_of(raw: &RawCampaign, folder: &Path) -> PathBuf {
    let file = folder.join(&raw.case);
    match file.is_file() {
        true => file.parent().map(Path::to_owned).unwrap_or_default(),
        false => PathBuf::new(),
    }
}
