//! The file of a campaign, read: which points it has, before it is known which numbers are kept of them.

use std::path::{Path, PathBuf};

use wingbeat_case::{Document, IoError, LoadedCase};

use crate::plan::Plan;
use crate::plan::axes::Reader;
use crate::plan::cases;
use crate::plan::checks::{self, Words};
use crate::plan::raw::RawCampaign;

/// What to do where the file of a campaign cannot be read.
const REMEDY: &str = "docs/campaigns.md has campaigns to start from";

/// What is in the file of a campaign.
#[derive(Clone, Debug)]
pub struct CampaignFile {
    /// Name of the campaign.
    pub name: String,
    /// The file.
    pub document: Document,
    /// What it says.
    pub raw: RawCampaign,
    /// Its points.
    pub plan: Plan,
    /// The case without the values of a point; with those of the first one where it cannot be flown without.
    pub base: LoadedCase,
    /// What paths in the case are relative to.
    pub case_folder: PathBuf,
}

impl CampaignFile {
    /// Reads the file.
    ///
    /// # Errors
    /// The first thing in it that cannot be read or contradicts itself, with its line.
    pub fn read(path: &Path) -> Result<Self, IoError> {
        if path == Path::new("-") {
            return Err(IoError::File {
                action: "read",
                path: path.to_owned(),
                source: std::io::Error::other("workers read the file of a campaign again"),
                remedy: "write it to a file and name that, `./-` for one of this name",
            });
        }
        let document = Document::read(path, REMEDY)?;
        checks::shape(&document)?;
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
        let base = words.base_case(&folder, &plan)?;
        Ok(Self {
            name,
            case_folder: cases::folder_of(&raw, &folder),
            document,
            raw,
            plan,
            base,
        })
    }
}
