//! Standard output and standard error.
//!
//! A print that fails stops no work: a flight goes on when nobody can be told of it. The first
//! failure is kept, nothing more is printed there, and [`close`] turns it into the exit code. Only
//! a reader who has seen enough (`wingbeat show DIR | head -1`) is no failure.

use std::borrow::Cow;
use std::fmt::Arguments;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::sync::{Mutex, PoisonError};

use clap::builder::styling::AnsiColor;
use wingbeat::results::Summary;
use wingbeat::results::summary::Verdict;

/// Exit code of a command whose work is done, but whose words are lost.
const UNSAID: u8 = 1;

static OUTPUT: Stream = Stream(Mutex::new(None));
static ERRORS: Stream = Stream(Mutex::new(None));

/// A stream and why it is given up.
struct Stream(Mutex<Option<ErrorKind>>);

impl Stream {
    /// Prints by `print` unless the stream is given up.
    fn print(&self, print: impl FnOnce() -> io::Result<()>) {
        let mut lost = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if lost.is_none() {
            *lost = print().err().map(|e| e.kind());
        }
    }

    /// Whether it is given up: nothing more is printed.
    fn is_given_up(&self) -> bool {
        self.0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .is_some()
    }

    /// The failure that nobody wanted.
    fn failure(&self) -> Option<ErrorKind> {
        let lost = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        lost.filter(|kind| *kind != ErrorKind::BrokenPipe)
    }
}

/// A line on the standard output, as `println!` but without its panic.
macro_rules! say {
    ($($text:tt)*) => {
        $crate::command::output::terminal::output(format_args!("{}\n", format_args!($($text)*)))
    };
}

/// A line on the standard error, as `eprintln!` but without its panic.
macro_rules! tell {
    ($($text:tt)*) => {
        $crate::command::output::terminal::errors(format_args!("{}\n", format_args!($($text)*)))
    };
}

pub(crate) use {say, tell};

/// Prints on the standard output.
pub(crate) fn output(text: Arguments<'_>) {
    OUTPUT.print(|| io::stdout().write_fmt(text));
}

/// Whether nothing that is printed on the standard output arrives any more: who only prints may end.
pub(crate) fn output_is_given_up() -> bool {
    OUTPUT.is_given_up()
}

/// Prints words, not data, on the standard output: numbers in them are of a length that can be read.
pub(crate) fn words(text: Arguments<'_>) {
    let text = text.to_string();
    output(format_args!("{}", readable(&text)));
}

/// Prints on the standard error.
pub(crate) fn errors(text: Arguments<'_>) {
    let text = text.to_string();
    let text = readable(&text);
    ERRORS.print(|| io::stderr().write_all(abridged(&text).as_bytes()));
}

/// A summary in words, the word of its verdict in its colour where the standard output shows colours.
pub(crate) fn judged(summary: &Summary) -> String {
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    let is_plain = !variable("NO_COLOR").is_empty() || variable("TERM") == "dumb";
    coloured(summary, io::stdout().is_terminal() && !is_plain)
}

fn coloured(summary: &Summary, in_colours: bool) -> String {
    let text = summary.to_text();
    let colour = match summary.verdict {
        Verdict::Green => AnsiColor::Green,
        Verdict::Amber => AnsiColor::Yellow,
        Verdict::Red => AnsiColor::Red,
    };
    let (style, word) = (colour.on_default().bold(), summary.verdict.word());
    match text.strip_prefix(word) {
        Some(rest) if in_colours => format!("{style}{word}{style:#}{rest}"),
        _ => text,
    }
}

/// Numbers of more characters than this are said as powers of ten: digits beyond some 17 say nothing.
const LONGEST_NUMBER: usize = 24;

/// The text with numbers of very many digits as powers of ten. What was typed, or follows from it, may be beyond all measure.
fn readable(text: &str) -> Cow<'_, str> {
    let ends = |c: char| !(c.is_ascii_digit() || c == '.');
    if !text.split(ends).any(|word| word.len() > LONGEST_NUMBER) {
        return Cow::Borrowed(text);
    }
    let (mut short, mut rest) = (String::new(), text);
    while let Some(at) = rest.find(|c| !ends(c)) {
        let (before, after) = rest.split_at(at);
        let whole = &after[..after.find(ends).unwrap_or(after.len())];
        let number = whole.trim_end_matches('.');
        rest = &after[number.len().max(1)..];
        let is_word = |end: Option<char>| end.is_some_and(char::is_alphanumeric);
        let is_name = is_word(before.chars().last()) || is_word(rest.chars().next());
        short += before;
        match number.parse::<f64>() {
            Ok(x) if number.len() > LONGEST_NUMBER && !is_name && x.is_finite() => {
                short += &format!("{x:.3e}");
            }
            _ => short += &after[..number.len().max(1)],
        }
    }
    Cow::Owned(short + rest)
}

/// Words longer than this many characters are not said in full.
const LONGEST_WORD: usize = 1000;

/// The text with the middle of very long words left out: what was typed is said again in messages.
fn abridged(text: &str) -> Cow<'_, str> {
    let is_long = |word: &&str| word.len() > LONGEST_WORD;
    if !text.split_whitespace().any(|w| is_long(&w)) {
        return Cow::Borrowed(text);
    }
    let short = |word: &str| {
        let count = word.chars().count();
        let start: String = word.chars().take(LONGEST_WORD / 10).collect();
        let end: String = word.chars().skip(count - LONGEST_WORD / 10).collect();
        format!("{start}[... {count} characters ...]{end}")
    };
    let pieces = text.split_inclusive(char::is_whitespace);
    let pieces = pieces.map(|piece| match is_long(&piece) {
        true => short(piece),
        false => piece.to_owned(),
    });
    Cow::Owned(pieces.collect())
}

/// Help, version, or what is wrong with the command line; its exit code.
pub(crate) fn usage(message: &clap::Error) -> u8 {
    let stream = if message.use_stderr() {
        &ERRORS
    } else {
        &OUTPUT
    };
    let plain = message.render().to_string();
    stream.print(|| match abridged(&plain) {
        Cow::Borrowed(_) => message.print(), // in colours
        Cow::Owned(short) => io::stderr().write_all(short.as_bytes()),
    });
    u8::try_from(message.exit_code()).unwrap_or(2)
}

/// The last word: the exit code of a command that ended with `code`.
pub(crate) fn close(code: u8) -> u8 {
    OUTPUT.print(|| io::stdout().flush());
    let lost = OUTPUT.failure().map(|kind| ("output", kind));
    let lost = lost.or(ERRORS.failure().map(|kind| ("error", kind)));
    match lost {
        Some((stream, kind)) => {
            tell!(
                "error: the standard {stream} cannot be written: {kind}; files are not touched by this"
            );
            code.max(UNSAID)
        }
        None => code,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behaves_only_the_word_of_a_verdict_is_coloured() {
        let case = wingbeat::case::LoadedCase::find("fruit-fly-blade", &[]).unwrap();
        let record = wingbeat::flight::Record::default();
        let failed = wingbeat::results::Outcome::Failed("it fell".to_owned());
        let summary = Summary::of(&case.setup, &[record], &failed);
        let text = summary.to_text();
        assert_eq!(coloured(&summary, false), text);
        let red = coloured(&summary, true);
        assert!(
            red.starts_with("\u{1b}[1m\u{1b}[31mred\u{1b}[0m: it ended early"),
            "{red}"
        );
        assert_eq!(red.split_once("[0m").unwrap().1, &text["red".len()..]);
    }

    #[test]
    fn behaves_numbers_of_very_many_digits_are_said_as_powers_of_ten() {
        for (text, expected) in [
            (
                format!("{} m/s is too fast.", 1e300),
                "1.000e300 m/s is too fast.",
            ),
            (
                format!("strokes of {:.1} deg", -2.5e60),
                "strokes of -2.500e60 deg",
            ),
            (
                format!("r2_hat = {}, which", 1e-30),
                "r2_hat = 1.000e-30, which",
            ),
            (format!("it is {:.0}. Then", 3e40), "it is 3.000e40. Then"),
            (format!("{} steps", u64::MAX), "18446744073709551615 steps"),
            (
                "0.1234567890123456789 ... 1..2".to_owned(),
                "0.1234567890123456789 ... 1..2",
            ),
        ] {
            assert_eq!(readable(&text), expected);
        }
        let name = format!("points/a{}f.json and 1.5", "7".repeat(40));
        assert_eq!(readable(&name), name);
    }

    #[test]
    fn behaves_only_very_long_words_are_abridged() {
        let plain = format!("error: no {} here\n", "x".repeat(LONGEST_WORD));
        assert_eq!(abridged(&plain), plain);
        let long = "ab".repeat(50_000);
        let said = abridged(&format!("error: no\n`{long}` here\n")).into_owned();
        assert!(said.len() < 400, "{}", said.len());
        assert!(said.starts_with("error: no\n`abab") && said.ends_with("abab` here\n"));
        assert!(said.contains("[... 100003 characters ...]"), "{said}");
    }
}
