//! Words of command lines that are said to be typed.

use std::path::{Path, PathBuf};

/// A word as a shell takes it: in single quotes unless all of its characters are plain ones.
///
/// ```
/// use wingbeat_case::shell;
/// assert_eq!(shell("results/fly"), "results/fly");
/// assert_eq!(shell("it's $HOME"), r"'it'\''s $HOME'");
/// ```
pub fn shell(word: &str) -> String {
    let plain = |c: char| {
        c.is_ascii_alphanumeric() || "-_./=+,:@%".contains(c) || (cfg!(windows) && c == '\\')
    };
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

/// A path as a word that no program takes for an option.
pub fn operand(path: &Path) -> PathBuf {
    match path.as_os_str().as_encoded_bytes().first() {
        Some(b'-') => Path::new(".").join(path),
        _ => path.to_owned(),
    }
}

/// A path as a shell takes it, no option either.
///
/// ```
/// use std::path::Path;
/// use wingbeat_case::shell_path;
/// assert_eq!(shell_path(Path::new("my fly")), "'my fly'");
/// # #[cfg(unix)]
/// assert_eq!(shell_path(Path::new("-f.toml")), "./-f.toml");
/// ```
pub fn shell_path(path: &Path) -> String {
    shell(&operand(path).display().to_string())
}
