//! The program about itself: commands in groups, completions of shells, manual pages.

use std::fmt::Write as _;
use std::path::Path;

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue};
use clap::{Command, CommandFactory, Error};
use clap_complete::Shell;
use wingbeat::case::{nearest, presets};
use wingbeat::results::file::{Existing, NewFile, make_folder};

use crate::command::cli::{Cli, ManArgs, STYLES};
use crate::command::failure::Failure;
use crate::command::terminal::{self, say};

/// Name of the program.
const PROGRAM: &str = "wingbeat";

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
    let list = groups(&command);
    Cli::command().help_template(StyledStr::from(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{list}{{options}}{{after-help}}"
    )))
}

/// A mistaken command that is a case: how it is flown.
pub(crate) fn advised(mut mistake: Error) -> Error {
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

/// The groups with what each command is for.
fn groups(command: &Command) -> String {
    let (header, literal) = (STYLES.get_header(), STYLES.get_literal());
    let mut text = String::new();
    for (group, names) in GROUPS {
        let _ = writeln!(text, "{header}{group}:{header:#}"); // a string takes everything
        for name in names {
            let about = command.find_subcommand(name).and_then(Command::get_about);
            let about = about.map(ToString::to_string).unwrap_or_default();
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
    clap_complete::generate(shell, &mut Cli::command(), PROGRAM, &mut script);
    terminal::output(format_args!("{}", String::from_utf8_lossy(&script)));
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
