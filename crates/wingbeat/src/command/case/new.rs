//! `wingbeat new` and `wingbeat presets`: what flights there are to start from.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::json;
use wingbeat::case::insect::{self, InsectAir, SPECIES, Size};
use wingbeat::case::{self, presets, shell_path};
use wingbeat::results::file::{Existing, write_file};

use crate::command::options::{self, CaseName};
use crate::command::output::failure::Failure;
use crate::command::output::report::{ReportArgs, line};
use crate::command::output::target::Target;
use crate::command::output::terminal::say;

/// Arguments of `wingbeat new`.
#[derive(Args)]
#[command(override_usage = USAGE)]
pub(crate) struct NewArgs {
    /// Name of the preset; left out where --species, --mass or --wing says what to write.
    #[arg(value_parser = CaseName, hide_possible_values = true)]
    preset: Option<PathBuf>,
    /// File to write, - for the standard output; default NAME.toml.
    file: Option<PathBuf>,
    /// An insect of this species; `wingbeat presets` lists them.
    #[arg(long, value_name = "NAME", help_heading = INSECT)]
    species: Option<String>,
    /// A flyer of this mass in the proportions of an insect, e.g. 100mg; what is not given follows from scaling laws.
    #[arg(long, help_heading = INSECT, value_parser = options::mass, allow_hyphen_values = true)]
    mass: Option<f64>,
    /// Length of a wing, hinge to tip, e.g. 9.7mm.
    #[arg(long, value_name = "LENGTH", help_heading = INSECT,
          value_parser = options::wing_length, allow_hyphen_values = true)]
    wing: Option<f64>,
    /// Mean chord of a wing, e.g. 3mm; beside --mass or --wing.
    #[arg(long, value_name = "LENGTH", help_heading = INSECT,
          value_parser = options::chord, allow_hyphen_values = true)]
    chord: Option<f64>,
    /// Wingbeats per second, e.g. 230.
    #[arg(long, value_name = "HERTZ", help_heading = INSECT,
          value_parser = options::frequency, allow_hyphen_values = true)]
    frequency: Option<f64>,
    /// Its air: blade elements, or the vortex lattice with wakes [default: blade].
    #[arg(long, value_enum, help_heading = INSECT)]
    air: Option<Air>,
    /// Write the schema for editors beside it, too.
    #[arg(long)]
    schema: bool,
    /// Replace files that exist already.
    #[arg(long)]
    overwrite: bool,
}

/// Heading of these options in the help.
const INSECT: &str = "A flyer of your own, in the proportions of an insect";

const USAGE: &str = "wingbeat new PRESET [FILE] [OPTIONS]
       wingbeat new --species NAME [FILE] [OPTIONS]
       wingbeat new [--mass MASS] [--wing LENGTH] [--chord LENGTH] [--frequency HERTZ] [FILE] [OPTIONS]";

/// The air of a new case.
#[derive(Clone, Copy, ValueEnum)]
enum Air {
    /// Quasi-steady blade elements: seconds a flight.
    Blade,
    /// Unsteady vortex lattice with free wakes: minutes.
    Lattice,
}

impl NewArgs {
    fn size(&self) -> Size {
        Size {
            mass: self.mass,
            wing_length: self.wing,
            mean_chord: self.chord,
            frequency: self.frequency,
        }
    }

    fn asks_for_an_insect(&self) -> bool {
        self.species.is_some() || self.size() != Size::default()
    }

    /// The name of the new case, its text, and the file that is named.
    fn case(&self) -> Result<(String, String, Option<PathBuf>), Failure> {
        if self.asks_for_an_insect() {
            return self.insect();
        }
        let Some(name) = &self.preset else {
            let problem = "name a preset, or an insect by --species, --mass or --wing; `wingbeat presets` lists both";
            return Err(Failure::Option(problem.to_owned()));
        };
        let preset = presets::find(&name.to_string_lossy())?;
        if self.air.is_some() {
            let problem = "--air has no effect on a preset, which has its own; leave it out, or set air.model in the file";
            return Err(Failure::Option(problem.to_owned()));
        }
        Ok((
            preset.name.to_owned(),
            preset.text.to_owned(),
            self.file.clone(),
        ))
    }

    /// The same of an insect of one's own.
    fn insect(&self) -> Result<(String, String, Option<PathBuf>), Failure> {
        if self.file.is_some() {
            let problem = "--species, --mass and --wing write one file instead of a preset; name the file alone";
            return Err(Failure::Option(problem.to_owned()));
        }
        let name = self.preset.as_deref().map(Path::to_string_lossy);
        if name.is_some_and(|name| presets::find(&name).is_ok()) {
            let problem = "a preset and an insect are two cases; name one of them, and the file with its ending; to change the size of a preset write it alone, and edit its masses and lengths, or animal.scale, in the file";
            return Err(Failure::Option(problem.to_owned()));
        }
        if self.species.is_some() && self.size() != Size::default() {
            let problem = "--species cannot be used with --mass, --wing, --chord or --frequency: its case has those of the species; write it alone, and change body.mass_kg, animal.scale or motion.frequency_hz in the file or by --set, or leave --species out, for an insect by scaling laws";
            return Err(Failure::Option(problem.to_owned()));
        }
        let air = match self.air {
            None | Some(Air::Blade) => InsectAir::BladeElement,
            Some(Air::Lattice) => InsectAir::Lattice,
        };
        let (name, text) = match &self.species {
            Some(name) => (name.as_str(), insect::case_of_species(name, air)?),
            None => ("insect", insect::case_of_size(&self.size(), air)?),
        };
        Ok((name.to_owned(), text, self.preset.clone()))
    }
}

/// `wingbeat new`.
pub(crate) fn new(args: &NewArgs) -> Result<(), Failure> {
    let (name, text, file) = args.case()?;
    let path = file.unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    let existing = Existing::kept_unless(args.overwrite);
    let target = Target::claim(&path, existing)?;
    if args.schema {
        write_schema(&target, existing)?;
    }
    target.write(&case::with_schema(&text))?;
    if let Some(path) = target.path() {
        say!(
            "wrote {}; fly it with `wingbeat run {}`",
            path.display(),
            shell_path(path)
        );
    }
    Ok(())
}

/// Writes the schema beside a case.
fn write_schema(case: &Target, existing: Existing) -> Result<(), Failure> {
    let Some(path) = case.path() else {
        let problem = "--schema writes a file beside the case, which has none on the standard output; `wingbeat schema` prints it";
        return Err(Failure::Option(problem.to_owned()));
    };
    let file = path.with_file_name(case::SCHEMA_FILE);
    // As `wingbeat schema` prints it.
    let schema = format!("{}\n", case::schema());
    write_file(&file, schema.as_bytes(), existing)?;
    say!("wrote {}", file.display());
    Ok(())
}

/// `wingbeat presets`.
pub(crate) fn list(args: &ReportArgs) -> Result<(), Failure> {
    args.deliver([], |report, []| {
        line!(
            report,
            "Presets (wingbeat run NAME, wingbeat new NAME; Table 1 is that of Roccia et al. 2011):"
        );
        for preset in presets::PRESETS {
            line!(report, "  {:<27}{}", preset.name, preset.line());
        }
        line!(report, "\nSpecies (wingbeat new --species NAME):");
        for s in SPECIES {
            line!(
                report,
                "  {:<27}{}, {:.4} mg",
                s.name,
                s.latin,
                1e6 * s.mass
            );
        }
        line!(report, "\nSets of wing angles (motion.data):");
        for (name, about) in case::data_sets() {
            line!(report, "  {name:<28}{about}");
        }
        let named = |name: &str, about: &str| json!({ "name": name, "about": about });
        let all = presets::PRESETS.iter().map(|p| named(p.name, p.line()));
        report.value("presets", all.collect::<Vec<_>>());
        report.value("species", SPECIES.map(|s| named(s.name, s.latin)).to_vec());
        let sets = case::data_sets().into_iter();
        let sets = sets.map(|(name, about)| named(name, &about));
        report.value("wing_angles", sets.collect::<Vec<_>>());
        Ok(())
    })
}
