//! A case, read and checked: from text to a validated setup, and back to text with everything
//! filled in.

use std::path::Path;
use std::sync::Arc;

use wingbeat_flight::{AirModel, FlightError, FlightSetup};

use crate::build::{OutputSettings, resolve};
use crate::error::{CaseError, Fault, IoError};
use crate::external::Unasked;
use crate::external::controller::Uncommanded;
use crate::files::TableGaps;
use crate::shipped::presets;
use crate::text::shell::{shell, shell_path};
use crate::text::source::{CaseSource, table_of};
use crate::{build, decode, files, keys, raw};

/// A case, validated and ready to fly.
#[derive(Clone, Debug)]
pub struct LoadedCase {
    /// Name, used for the result directory.
    pub name: String,
    /// What flies.
    pub setup: FlightSetup,
    /// What is written.
    pub output: OutputSettings,
    /// The resolved case: files read in, no key left open.
    pub raw: raw::Case,
    /// Tables of angles with rows that hold none.
    pub table_gaps: Vec<TableGaps>,
    source: CaseSource,
}

impl LoadedCase {
    /// Reads a case from text. `origin` names it in messages, `base` is the folder that paths in
    /// it are relative to, `overrides` are `KEY=VALUE`.
    ///
    /// # Errors
    /// The first thing in the case that cannot be flown.
    pub fn from_text(
        origin: &str,
        text: &str,
        base: &Path,
        overrides: &[String],
    ) -> Result<Self, IoError> {
        let source = CaseSource::new(origin, text, overrides)?;
        let decoded = decode::decode(&source).map_err(of_another_table);
        let mut raw: raw::Case = decoded.map_err(|e| of_a_campaign(&source, e))?;
        let stem = Path::new(origin)
            .file_stem()
            .and_then(|s| s.to_str())
            .unwrap_or("case");
        let name = raw.name.get_or_insert_with(|| stem.to_owned()).clone();
        let mut built = || {
            check_name(&name)?;
            build::check_names(&raw)?;
            keys::alone(&source.table)?;
            let gaps = files::read_in(&mut raw, base)?;
            resolve::resolve(&mut raw)?;
            keys::together(&source, &table_of(&raw))?;
            let setup = build::setup(&raw, &name)?;
            build::check_effects(&raw, &setup, &source)?;
            Ok((setup, gaps))
        };
        let (setup, table_gaps) = built().map_err(|fault| Box::new(source.locate(fault)))?;
        resolve::leave_out_data(&mut raw);
        if raw.air.model != raw::AirModel::VortexLattice {
            raw.output.frames_every = 0; // there are none
        }
        let output = build::output(&raw.output);
        Ok(Self {
            name,
            setup,
            output,
            raw,
            table_gaps,
            source,
        })
    }

    /// A case put together in Rust, checked like a file of the same keys.
    ///
    /// ```
    /// use wingbeat_case::LoadedCase;
    /// use wingbeat_case::raw::{AirCase, AirModel, BodyCase, Case, TimeCase};
    /// let mut case = Case {
    ///     time: TimeCase { step_s: Some(0.01), steps: Some(50), ..TimeCase::default() },
    ///     air: AirCase { model: AirModel::None, ..AirCase::default() },
    ///     ..Case::default()
    /// };
    /// let error = LoadedCase::new(case.clone()).expect_err("a body without mass");
    /// assert!(error.to_string().contains("body.mass_kg"));
    /// let j = [1e-4, 1e-4, 1e-4, 0.0, 0.0, 0.0]; // kg m2
    /// case.body = BodyCase { mass_kg: Some(0.1), inertia_about_centre_kg_m2: Some(j), ..BodyCase::default() };
    /// assert_eq!(LoadedCase::new(case)?.setup.time.steps, 50);
    /// # Ok::<(), wingbeat_case::IoError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::from_text`].
    pub fn new(case: raw::Case) -> Result<Self, IoError> {
        let name = case.name.clone();
        let mut given = changed(table_of(&case), &table_of(&raw::Case::default()));
        let format = i64::from(case.format);
        given.insert("format".to_owned(), format.into());
        let body = || toml::Table::new().into();
        given.entry("body".to_owned()).or_insert_with(body);
        // Keys in tables without defaults are all there: those that have no effect are left out if
        // they say nothing, and refused if they do.
        let lean = keys::effective(&table_of(&case), &given);
        let says_all = lean.clone().try_into::<raw::Case>().as_ref() == Ok(&case);
        let text = toml::to_string(if says_all { &lean } else { &given });
        let text = text.expect("a table is TOML");
        Self::from_text(name.as_deref().unwrap_or("case"), &text, Path::new(""), &[])
    }

    /// Reads a case file.
    ///
    /// # Errors
    /// A file that cannot be read, or a case that cannot be flown.
    pub fn from_file(path: &Path, overrides: &[String]) -> Result<Self, IoError> {
        let text = files::text_of(path)?;
        let base = path.parent().map(Path::to_owned).unwrap_or_default();
        Self::from_text(&path.display().to_string(), &text, &base, overrides)
    }

    /// Reads a case file or, where no such file exists, a preset of that name; `-` is the standard
    /// input, where paths are relative to the current folder.
    ///
    /// # Errors
    /// As [`Self::from_file`]; [`IoError::NoCase`] for a name that is neither.
    pub fn find(name: impl AsRef<Path>, overrides: &[String]) -> Result<Self, IoError> {
        let path = name.as_ref();
        if path == Path::new(files::STANDARD_INPUT) {
            let text = files::text_of_input()?;
            return Self::from_text("stdin", &text, Path::new(""), overrides);
        }
        if path.is_file() {
            return Self::from_file(path, overrides);
        }
        match presets::find(&path.to_string_lossy()) {
            Ok(preset) => {
                let origin = format!("preset {}", preset.name);
                Self::from_text(&origin, preset.text, Path::new(""), overrides)
            }
            Err(_) if path.exists() => Self::from_file(path, overrides), // says what it is
            Err(e) => Err(e),
        }
    }

    /// The program that computes the air, with its arguments, if the case names one; words that
    /// could be mistaken on a terminal in quotes.
    pub fn program(&self) -> Option<String> {
        let starts = self.raw.air.model == raw::AirModel::External;
        let external = self.raw.air.external.as_ref();
        external.filter(|_| starts).map(in_words)
    }

    /// The program that commands the wings, likewise.
    pub fn control_program(&self) -> Option<String> {
        let control = self.raw.control.as_ref()?;
        let starts = control.controller == raw::ControllerCase::External;
        let external = control.external.as_ref();
        external.filter(|_| starts).map(in_words)
    }

    /// The setup with stand-ins for other programs, for those who only look: nothing is started.
    pub fn unasked(&self) -> FlightSetup {
        let mut setup = self.setup.clone();
        if self.program().is_some() {
            setup.air = AirModel::External(Arc::new(Unasked));
        }
        if let (Some(feedback), Some(_)) = (&mut setup.feedback, self.control_program()) {
            feedback.controller = Arc::new(Uncommanded);
        }
        setup
    }

    /// The text of the case as it was written.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// The number at a key of the case as it was written.
    pub(crate) fn number_at(&self, key: &str) -> Option<f64> {
        let value = self.source.value_at(key)?;
        value
            .as_float()
            .or(value.as_integer().map(|whole| whole as f64))
    }

    /// Whether a key is given, by the text of the case or by what is set on top.
    pub fn gives(&self, key: &str) -> bool {
        self.source.gives(key)
    }

    /// The keys that are given in a table, likewise.
    pub(crate) fn keys_in(&self, table: &str) -> Vec<&str> {
        let table = self.source.value_at(table).and_then(|t| t.as_table());
        table.map_or(vec![], |t| t.keys().map(String::as_str).collect())
    }

    /// A fault traced to its line.
    pub(crate) fn located(&self, fault: Fault) -> CaseError {
        self.source.locate(fault)
    }

    /// The text that is given for a key, with what is set on top; none where it is left out or no text.
    pub fn text_at(&self, key: &str) -> Option<&str> {
        self.source.value_at(key)?.as_str()
    }

    /// Where the case came from: the file or preset.
    pub fn origin(&self) -> &str {
        &self.source.name
    }

    /// The case with everything filled in, as TOML; it gives the same setup bit for bit.
    pub fn resolved(&self) -> String {
        format!(
            "# Case `{}` with every default filled in; it reproduces the run.\n{}",
            self.name,
            written(&self.raw)
        )
    }

    /// The keys of the resolved case that have an effect, all others at their defaults: where another
    /// case for [`Self::new`] begins.
    pub fn effective(&self) -> raw::Case {
        let table = table_of(&self.raw);
        let lean = keys::effective(&table, &table);
        lean.try_into().expect("a case without idle keys is a case")
    }

    /// Refuses what a model of the air of one's own in place of that of the case would lose: streams, gusts,
    /// streets, shear and the ground, and keys of the air that were set on top.
    ///
    /// # Errors
    /// The first such key.
    pub fn check_own_air(&self) -> Result<(), Box<CaseError>> {
        keys::beside_own_air(&self.source).map_err(|fault| Box::new(self.source.locate(fault)))
    }

    /// What a flight of this case refused, at the key it is about.
    pub fn refused(&self, error: &FlightError) -> CaseError {
        self.source
            .locate(build::refused(&self.raw, &self.setup, error))
    }

    /// An error about a key that showed up later, traced to its line.
    pub fn fault(&self, key: &str, problem: String, remedy: &str) -> CaseError {
        self.source.locate(Fault::new(key, problem, "", remedy))
    }
}

/// Names longer than this many bytes are no names of directories everywhere.
const LONGEST_NAME: usize = 100;

/// An unknown key whose name a key elsewhere has.
fn of_another_table(mut error: Box<CaseError>) -> Box<CaseError> {
    const MOST: usize = 3;
    let is_lost = error.remedy.starts_with("remove it");
    if !(is_lost && error.problem.starts_with("unknown key")) {
        return error;
    }
    let name = error.key.rsplit('.').next().unwrap_or_default();
    let places = keys::places(name);
    if !places.is_empty() && places.len() <= MOST {
        error.remedy = format!("did you mean `{}`?", places.join("` or `"));
    }
    error
}

/// An unknown key in the file of a campaign, which names a case.
fn of_a_campaign(source: &CaseSource, mut error: Box<CaseError>) -> Box<CaseError> {
    let names_a_case = source.written("case").is_some();
    if names_a_case && error.problem.starts_with("unknown key") {
        error.remedy = format!(
            "this is the file of a campaign, which `wingbeat campaign run {}` flies",
            shell_path(Path::new(&source.name))
        );
    }
    error
}

fn check_name(name: &str) -> Result<(), Fault> {
    let plain = |c: char| c.is_alphanumeric() || "-_. ".contains(c);
    let fits = (1..=LONGEST_NAME).contains(&name.len());
    if fits && name.chars().all(plain) && !name.starts_with('.') {
        return Ok(());
    }
    Err(Fault::new(
        "name",
        "the name becomes the name of a directory",
        format!(
            "letters, digits, -, _, . and spaces, not beginning with a dot, at most {LONGEST_NAME} bytes"
        ),
        "choose a plain name",
    ))
}

/// A command as it would be typed.
fn in_words(external: &raw::ExternalCase) -> String {
    let words: Vec<String> = external.command.iter().map(|word| shell(word)).collect();
    words.join(" ")
}

/// The keys of `given` that are not as in `default`. A table of one key is a choice, taken as a whole.
fn changed(given: toml::Table, default: &toml::Table) -> toml::Table {
    let differ = |(name, value): (String, toml::Value)| match (value, default.get(&name)) {
        (toml::Value::Table(inner), Some(toml::Value::Table(usual))) if usual.len() > 1 => {
            let inner = changed(inner, usual);
            (!inner.is_empty()).then(|| (name, inner.into()))
        }
        (value, usual) => (usual != Some(&value)).then_some((name, value)),
    };
    given.into_iter().filter_map(differ).collect()
}

/// The keys of a resolved case that have an effect, as TOML.
pub(crate) fn written(case: &raw::Case) -> String {
    let table = table_of(case);
    toml::to_string(&keys::effective(&table, &table)).expect("a table is TOML")
}

/// The same for a case that is to be flown on: without the numbers of one controller that are those of the default,
/// which another controller refuses.
pub(crate) fn written_to_change(case: &raw::Case) -> String {
    let whole = table_of(case);
    let mut table = keys::effective(&whole, &whole);
    let default = raw::ControlCase::default();
    let control = table.get_mut("control").and_then(toml::Value::as_table_mut);
    if let (Some(control), Some(given)) = (control, &case.control) {
        if given.stiffness == default.stiffness {
            control.remove("stiffness");
        }
        if given.weights == default.weights {
            control.remove("weights");
        }
    }
    toml::to_string(&table).expect("a table is TOML")
}
