//! Numbers that lack digits before or after their point, which TOML does not take.

use toml::Table;

/// The value with zeros where numbers lack digits before or after their point; none where that makes no numbers of it.
pub(crate) fn with_all_digits(typed: &str) -> Option<String> {
    let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let (mut whole, mut last) = (String::new(), None);
    let mut rest = typed.chars().peekable();
    while let Some(c) = rest.next() {
        let [before, after] = [is_digit(last), is_digit(rest.peek().copied())];
        match (c, before, after) {
            ('.', false, true) => whole.push_str("0."),
            ('.', true, false) => whole.push_str(".0"),
            _ => whole.push(c),
        }
        last = Some(c);
    }
    let is_value = || format!("value = {whole}").parse::<Table>();
    (whole != typed && is_value().is_ok_and(|t| t.len() == 1)).then_some(whole)
}

/// The number or word of a text at a place.
pub(crate) fn token(text: &str, at: usize) -> &str {
    let is_end = |c: char| c.is_whitespace() || "=,[]{}\"'#".contains(c);
    let (before, after) = text.split_at(at);
    let start = before.rfind(is_end).map_or(0, |k| k + 1);
    &text[start..at + after.find(is_end).unwrap_or(after.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_numbers_get_the_digits_they_lack() {
        let text = "x = [1.0, -.1,5.] # .5\n";
        for (at, lacking, whole) in [(11, "-.1", "-0.1"), (12, "-.1", "-0.1"), (15, "5.", "5.0")] {
            assert_eq!(token(text, at), lacking);
            assert_eq!(with_all_digits(lacking).as_deref(), Some(whole));
        }
        assert_eq!(token(text, text.len()), "");
        assert_eq!(with_all_digits("1.0"), None);
        assert_eq!(with_all_digits("a.b"), None);
    }
}
