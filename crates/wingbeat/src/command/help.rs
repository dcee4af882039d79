//! The program about itself: commands in groups, completions of shells, manual pages.

use std::any::TypeId;
use std::fmt::Write as _;
use std::path::Path;

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, CommandFactory, Error};
use clap_complete::Shell;
use wingbeat::case::{nearest, presets};
use wingbeat::results::file::{Existing, NewFile, make_folder};
use wingbeat::results::summary::broken;

use crate::command::cli::{Cli, MAX_WIDTH, ManArgs, STYLES};
use crate::command::output::failure::Failure;
use crate::command::output::terminal::{self, say};

/// Name of the program.
const PROGRAM: &str = "wingbeat";

/// Columns before the descriptions of commands.
const INDENT: usize = 15;

/// The commands by what they are for.
const GROUPS: [(&str, &[&str]); 5] = [
    ("Cases", &["presets", "new", "check", "schema"]),
    ("Flights", &["run", "resume", "ensemble", "campaign"]),
    (
        "Results",
        &["show", "compare", "view", "plot", "export", "velocity"],
    ),
    (
        "Flight mechanics",
        &[
            "trim",
            "stability",
            "derivatives",
            "power",
            "stabilise",
            "modes",
            "flutter",
        ],
    ),
    ("The program", &["verify", "completions", "man", "help"]),
];

/// The command line, its commands listed in groups.
pub(crate) fn command() -> Command {
    let mut command = Cli::command();
    command.build();
    let list = groups(&command, width());
    negative_numbers(Cli::command()).help_template(StyledStr::from(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{list}{{options}}{{after-help}}"
    )))
}

/// Options that take numbers take negative ones, `-.2` and `-inf` too: their own range is what is said of these, not
/// that they are no options.
fn negative_numbers(command: Command) -> Command {
    let numbers = [
        TypeId::of::<usize>(),
        TypeId::of::<u64>(),
        TypeId::of::<f64>(),
    ];
    let of_arg = |arg: Arg| {
        let kind = arg.get_value_parser().type_id();
        let is_option = !arg.is_positional() && arg.get_action().takes_values();
        let is_number = numbers.iter().any(|n| kind == *n);
        match is_option && is_number && !arg.is_allow_hyphen_values_set() {
            true if kind == TypeId::of::<f64>() => arg.allow_hyphen_values(true),
            true => arg.allow_negative_numbers(true),
            false => arg,
        }
    };
    command.mut_args(of_arg).mut_subcommands(negative_numbers)
}

/// An option that was taken as the value of the one before, which has none then: of those that take negative numbers
/// any word may be a value. `--forward --json` is the former, `--forward -1` and `--forward -inf` are not.
fn without_value(mistake: Error) -> Error {
    let context = |kind| mistake.get(kind);
    let (Some(ContextValue::String(option)), Some(ContextValue::String(value))) = (
        context(ContextKind::InvalidArg),
        context(ContextKind::InvalidValue),
    ) else {
        return mistake;
    };
    let mut command = Cli::command();
    command.build();
    if !has_option(&command, value) {
        return mistake;
    }
    let literal = STYLES.get_literal();
    let tip = format!(
        "{literal}{value}{literal:#} is an option itself: give {literal}{option}{literal:#} its value before it"
    );
    let mut found = Error::new(ErrorKind::InvalidValue).with_cmd(&command);
    for (kind, text) in [
        (ContextKind::InvalidArg, option.clone()),
        (ContextKind::InvalidValue, String::new()),
    ] {
        found.insert(kind, ContextValue::String(text));
    }
    let tips = ContextValue::StyledStrs(vec![StyledStr::from(tip)]);
    found.insert(ContextKind::Suggested, tips);
    found
}

/// Whether `word` is the name of an option of this command or of one below it, its value behind `=` included.
fn has_option(command: &Command, word: &str) -> bool {
    let name = word.split('=').next().unwrap_or_default();
    let is_named = |arg: &Arg| match name.strip_prefix("--") {
        Some(long) => arg.get_long() == Some(long),
        None => (arg.get_short())
            .is_some_and(|short| name.strip_prefix('-') == Some(&short.to_string())),
    };
    command.get_arguments().any(is_named)
        || command
            .get_subcommands()
            .any(|below| has_option(below, word))
}

/// A mistaken command that is a case: how it is flown. An option in place of a value: that there is none.
pub(crate) fn advised(mistake: Error) -> Error {
    let mut mistake = without_value(mistake);
    let Some(ContextValue::String(name)) = mistake.get(ContextKind::InvalidSubcommand) else {
        return mistake;
    };
    let name = name.clone();
    if presets::find(&name).is_ok() || Path::new(&name).is_file() {
        let literal = STYLES.get_literal();
        let tip = format!("to fly this case: {literal}{PROGRAM} run {name}{literal:#}");
        let tips = ContextValue::StyledStrs(vec![StyledStr::from(tip)]);
        mistake.insert(ContextKind::Suggested, tips);
        mistake.remove(ContextKind::SuggestedSubcommand);
    }
    if mistake.get(ContextKind::SuggestedSubcommand).is_none() {
        let names: Vec<&str> = GROUPS.iter().flat_map(|g| g.1).copied().collect();
        if let Some(near) = nearest(&name, &names) {
            let near = ContextValue::String(near.to_owned());
            mistake.insert(ContextKind::SuggestedSubcommand, near);
        }
    }
    mistake
}

/// Columns of the help, as clap counts them.
fn width() -> usize {
    let columns = || std::env::var("COLUMNS").ok()?.parse().ok();
    let terminal = terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
    terminal
        .or_else(columns)
        .unwrap_or(MAX_WIDTH)
        .min(MAX_WIDTH)
}

/// The groups with what each command is for.
fn groups(command: &Command, width: usize) -> String {
    let (header, literal) = (STYLES.get_header(), STYLES.get_literal());
    let mut text = String::new();
    for (group, names) in GROUPS {
        let _ = writeln!(text, "{header}{group}:{header:#}"); // a string takes everything
        for name in names {
            let about = command.find_subcommand(name).and_then(Command::get_about);
            let about = about.map(ToString::to_string).unwrap_or_default();
            let about = broken(&about, INDENT, width);
            let _ = writeln!(text, "  {literal}{name:<12}{literal:#} {about}");
        }
        text.push('\n');
    }
    let _ = writeln!(text, "{header}Options:{header:#}");
    text
}

/// `wingbeat completions SHELL`.
pub(crate) fn completions(shell: Shell) {
    let mut script = vec![];
    clap_complete::generate(shell, &mut completed(), PROGRAM, &mut script);
    let script = String::from_utf8_lossy(&script);
    // The shells of which the generator completes either names or files: a case is both.
    let script = match shell {
        Shell::Zsh => with_files(&script),
        _ => script.into_owned(),
    };
    terminal::output(format_args!("{script}"));
}

/// The program as shells complete it: without the commands of `campaign` that it calls itself.
fn completed() -> Command {
    Cli::command().mut_subcommand("campaign", |campaign| {
        let shown = campaign.get_subcommands().filter(|c| !c.is_hide_set());
        Command::new("campaign")
            .about(campaign.get_about().cloned().unwrap_or_default())
            .subcommand_required(true)
            .args(campaign.get_arguments().cloned())
            .subcommands(shown.cloned())
    })
}

/// A script of zsh that completes files, too, where it completes the presets.
fn with_files(script: &str) -> String {
    let names: Vec<&str> = presets::PRESETS.iter().map(|p| p.name).collect();
    let names = format!("({})", names.join(" "));
    // The blank keeps `_arguments` from giving its own options to the action.
    let both = format!(r#" _alternative "presets:preset:{names}" "files:file:_files""#);
    script.replace(&format!(":{names}'"), &format!(":{both}'"))
}

/// The program as its manual has it: without `help`, which has no page.
fn documented() -> Command {
    fn without_help(command: Command) -> Command {
        command
            .disable_help_subcommand(true)
            .mut_subcommands(without_help)
    }
    let mut program = without_help(Cli::command().name(PROGRAM));
    program.build();
    program
}

/// A command and what stands under it, at any depth.
fn with_inner(command: &Command) -> Vec<&Command> {
    let inner = command.get_subcommands().filter(|c| !c.is_hide_set());
    std::iter::once(command)
        .chain(inner.flat_map(with_inner))
        .collect()
}

/// `wingbeat man DIR`: a page for the program and one for each command, those of `campaign` too.
pub(crate) fn man(args: &ManArgs) -> Result<(), Failure> {
    make_folder(&args.dir)?;
    let program = documented();
    let pages = with_inner(&program).into_iter();
    let claim = |command: &Command| {
        let name = command.get_display_name().unwrap_or(PROGRAM).to_owned();
        let file = NewFile::claim(
            &args.dir.join(format!("{name}.1")),
            Existing::kept_unless(args.overwrite),
        )?;
        Ok((file, command.clone()))
    };
    let pages: Result<Vec<_>, Failure> = pages.map(claim).collect();
    for (file, command) in pages? {
        let mut page = vec![];
        let rendered = clap_mangen::Man::new(command).render(&mut page);
        rendered.expect("memory takes everything");
        file.write(&page)?;
        say!("wrote {}", file.path().display());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every page that a page names is there.
    #[test]
    fn exact_manual_pages_name_each_other() {
        let program = documented();
        let name = |c: &Command| c.get_display_name().unwrap_or(PROGRAM).to_owned();
        let all = with_inner(&program);
        let names: Vec<String> = all.iter().map(|c| name(c)).collect();
        assert!(
            names.contains(&"wingbeat-campaign-run".to_owned()),
            "{names:?}"
        );
        for command in all {
            let mut page = vec![];
            clap_mangen::Man::new(command.clone())
                .render(&mut page)
                .unwrap();
            let page = String::from_utf8(page).unwrap().replace('\\', "");
            let named = page.split_whitespace().filter_map(|w| {
                let (word, _) = w.split_once("(1)")?;
                word.starts_with("wingbeat-").then_some(word)
            });
            for word in named {
                assert!(
                    names.iter().any(|n| n == word),
                    "{} names {word}",
                    name(command)
                );
            }
        }
    }

    #[test]
    fn exact_descriptions_of_commands_are_as_wide_as_the_help() {
        let mut program = Cli::command();
        program.build();
        for width in [40, 100] {
            let list = groups(&program, width);
            let plain: String = list
                .split('\u{1b}')
                .map(|p| p.split_once('m').map_or(p, |p| p.1))
                .collect();
            let widest = plain.lines().map(|l| l.chars().count()).max();
            assert!(widest <= Some(width), "{plain}");
            let said = plain.split_whitespace().collect::<Vec<_>>().join(" ");
            for command in program.get_subcommands().filter(|c| c.get_name() != "help") {
                let about = command.get_about().unwrap().to_string();
                assert!(said.contains(&about), "{about}");
            }
        }
    }

    /// Shells complete presets where a case is asked, files beside them, and names of figures, styles and formats.
    #[test]
    fn behaves_shells_complete_names() {
        let script = |shell| {
            let mut script = vec![];
            clap_complete::generate(shell, &mut completed(), PROGRAM, &mut script);
            String::from_utf8(script).unwrap()
        };
        let [bash, zsh] = [script(Shell::Bash), with_files(&script(Shell::Zsh))];
        for preset in presets::PRESETS {
            assert!(
                bash.contains(&format!(" {}", preset.name)),
                "{}",
                preset.name
            );
        }
        assert!(bash.contains("campaign__run") || bash.contains("campaign__subcmd__run"));
        for script in [&bash, &zsh] {
            assert!(
                !script.contains("campaign__work") && !script.contains("campaign__subcmd__work")
            );
        }
        let cases = zsh
            .matches(r#": _alternative "presets:preset:(fruit-fly-hover"#)
            .count();
        assert_eq!(
            cases,
            zsh.matches("Case file or preset").count() + 1,
            "new asks for a preset or a file"
        );
        for names in [
            "screen paper dark",
            "svg png pdf gif mp4",
            "hdf5 vtkhdf parquet gltf",
            "angles forces lollipop",
        ] {
            assert!(bash.contains(names) && zsh.contains(names), "{names}");
        }
    }

    #[test]
    fn behaves_every_command_stands_in_one_group() {
        let mut program = Cli::command();
        program.build();
        let mut known: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
        let mut listed: Vec<&str> = GROUPS.iter().flat_map(|g| g.1).copied().collect();
        known.sort_unstable();
        listed.sort_unstable();
        assert_eq!(known, listed);
        program.debug_assert();
    }
}
