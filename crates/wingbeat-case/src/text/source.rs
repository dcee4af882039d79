//! The text of a case, where each key stands in it, and the overrides of the command line.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};
use wingbeat_model::mirror_name;

use crate::error::{CaseError, Fault};
use crate::text::digits::{token, with_all_digits};
use crate::text::path::{check, find, set, take_away};

/// What is advised where a text is no TOML.
pub(crate) const START: &str = "`wingbeat new fruit-fly-hover` writes a case to start from";

/// A case as written: text, key positions, overrides, and the document with overrides applied.
#[derive(Clone, Debug)]
pub(crate) struct CaseSource {
    /// Name of the file or preset, for messages.
    pub name: String,
    /// The text as written.
    pub text: String,
    /// Where each key path stands: the bytes of the key (or element) and of its value.
    places: BTreeMap<String, Place>,
    /// Overrides: key path and the value as typed.
    overrides: Vec<(String, String)>,
    /// The document after overrides.
    pub table: Table,
}

#[derive(Clone, Debug)]
struct Place {
    key: Range<usize>,
    value: Range<usize>,
}

impl CaseSource {
    /// Parses `text` and applies `KEY=VALUE` overrides; `KEY=` takes a key away.
    ///
    /// # Errors
    /// Broken TOML, a broken override, or a number that is not finite anywhere.
    pub fn new(name: &str, text: &str, overrides: &[String]) -> Result<Self, Box<CaseError>> {
        let mut source = Self {
            name: name.to_owned(),
            text: text.to_owned(),
            places: BTreeMap::new(),
            overrides: vec![],
            table: Table::new(),
        };
        let tree = DeTable::parse(text).map_err(|e| Box::new(source.syntax(&e)))?;
        record_table("", tree.get_ref(), &mut source.places);
        source.table = text
            .parse::<Table>()
            .map_err(|e| Box::new(source.syntax(&e)))?;
        for item in overrides {
            source.apply(item)?;
        }
        let finite = check_finite("", &Value::Table(source.table.clone()));
        finite.map_err(|fault| Box::new(source.locate(fault)))?;
        Ok(source)
    }

    /// The keys of the table at a path; none where there is no table.
    pub fn keys_at(&self, path: &str) -> Vec<&str> {
        let table = find(&self.table, path).and_then(Value::as_table);
        table.map_or(vec![], |t| t.keys().map(String::as_str).collect())
    }

    /// Traces a fault to its line, or to the override that caused it.
    pub fn locate(&self, fault: Fault) -> CaseError {
        let value = find(&self.table, &fault.key).and_then(in_one_line);
        let overridden = self
            .overrides
            .iter()
            .rev()
            .find(|(key, _)| related(key, &fault.key))
            .or_else(|| self.made(&fault.key));
        let mut error = CaseError {
            origin: self.name.clone(),
            line: None,
            column: None,
            key: fault.key.clone(),
            value,
            overridden: overridden.map(|(key, _)| key.clone()),
            problem: fault.problem,
            allowed: fault.allowed,
            remedy: fault.remedy,
            excerpt: None,
        };
        // Where keys are set on top of a case, one of the case may be in their way.
        let is_typed = error.overridden.is_some() && error.problem.starts_with("unknown key");
        if error.remedy.starts_with("remove it") && !self.overrides.is_empty() && !is_typed {
            error.remedy += &format!("; `{}=`, set to nothing, takes it away", error.key);
        }
        if let Some(words) = self.of_mirror_image(&fault.key, &error.problem) {
            error.remedy += &words;
        }
        if let Some((key, typed)) = overridden {
            error.origin = format!("{key}={} (set on top of {})", shortened(typed), self.name);
        } else if let Some(span) = self.span(&fault.key, error.problem.starts_with("unknown key")) {
            self.mark(&mut error, span);
        }
        error
    }

    /// The override that made the table in which `key` is missing; none of a table that the text has.
    fn made(&self, key: &str) -> Option<&(String, String)> {
        let (table, _) = key.rsplit_once('.')?;
        let is_made = !self.places.contains_key(table);
        let mut overrides = self.overrides.iter().rev();
        overrides.find(|(name, _)| is_made && related(table, name))
    }

    /// What is to be known where a key is missing in a table of a wing whose counterpart has one of its own.
    fn of_mirror_image(&self, key: &str, problem: &str) -> Option<String> {
        if !problem.ends_with("missing") {
            return None;
        }
        let (wing, inside) = key.strip_prefix("wing.")?.split_once('.')?;
        let (table, _) = inside.split_once('.')?;
        let other = format!("wing.{}.{table}", mirror_name(wing)?);
        self.gives(&other).then(|| {
            format!(
                "; [wing.{wing}.{table}] takes the place of the whole of [{other}], so give all of its keys"
            )
        })
    }

    /// Whether the command line chooses the value of `key`, by itself or with a table around it.
    pub fn chooses(&self, key: &str) -> bool {
        let around = |outer: &str| {
            let rest = key.strip_prefix(outer);
            rest.is_some_and(|r| r.is_empty() || r.starts_with(['.', '[']))
        };
        self.overrides.iter().any(|(k, _)| around(k))
    }

    /// Whether an override sets a key, one around it or one inside it.
    pub fn touches(&self, key: &str) -> bool {
        self.overrides.iter().any(|(k, _)| related(k, key))
    }

    /// The key at which an override gives a value that the document has: `key` or one inside it.
    pub fn set_at(&self, key: &str) -> Option<String> {
        let is_given = |(name, typed): &&(String, String)| {
            related(name, key) && !typed.trim().is_empty() && self.gives(name)
        };
        let (name, _) = self.overrides.iter().rev().find(is_given)?;
        Some(if name.len() > key.len() { name } else { key }.to_owned())
    }

    /// The value of a key as it is written in the file.
    pub fn written(&self, key: &str) -> Option<&str> {
        let place = self.places.get(key)?;
        self.text.get(place.value.clone())
    }

    /// Whether the document has a value at `key`.
    pub fn gives(&self, key: &str) -> bool {
        self.value_at(key).is_some()
    }

    /// The value of the document at `key`.
    pub fn value_at(&self, key: &str) -> Option<&Value> {
        find(&self.table, key)
    }

    /// The bytes of a value (or of its key), or of the key of the nearest table around it.
    fn span(&self, key: &str, on_key: bool) -> Option<Range<usize>> {
        if let Some(place) = self.places.get(key) {
            if on_key {
                return Some(place.key.clone());
            }
            let multiline = self.text[place.value.clone()].contains('\n');
            return Some(if multiline {
                place.key.clone()
            } else {
                place.value.clone()
            });
        }
        let mut outer = key;
        while let Some(cut) = outer.rfind(['.', '[']) {
            outer = &outer[..cut];
            if let Some(place) = self.places.get(outer) {
                return Some(place.key.clone());
            }
        }
        None
    }

    fn mark(&self, error: &mut CaseError, span: Range<usize>) {
        let before = &self.text[..span.start];
        error.line = Some(before.matches('\n').count() + 1);
        let line_start = before.rfind('\n').map_or(0, |k| k + 1);
        error.column = Some(before[line_start..].chars().count() + 1);
        error.excerpt = Some((self.text.clone(), span));
    }

    fn syntax(&self, e: &toml::de::Error) -> CaseError {
        let fault = Fault::new(
            "",
            format!(
                "this is not TOML: {}",
                e.message().trim().replace('\n', ", ")
            ),
            "",
            START,
        );
        let mut error = self.locate(fault);
        if let Some(span) = e.span() {
            if let Some(whole) = with_all_digits(token(&self.text, span.start)) {
                error.problem += ": it has no numbers like .5 or 5.";
                error.remedy = format!("write {whole}");
            }
            self.mark(&mut error, span);
        }
        error
    }

    fn apply(&mut self, item: &str) -> Result<(), Box<CaseError>> {
        let wrong = |key: &str, problem: String| {
            Box::new(CaseError {
                origin: format!("{} (set on top of {})", shortened(item), self.name),
                line: None,
                column: None,
                key: key.to_owned(),
                value: None,
                overridden: (!key.is_empty()).then(|| key.to_owned()),
                problem,
                allowed: "a key as in a case file, and its value".to_owned(),
                remedy: "motion.frequency_hz=200 or 'air.stream_m_s=[1, 0, 0]', for instance"
                    .to_owned(),
                excerpt: None,
            })
        };
        let (key, typed) = item
            .split_once('=')
            .ok_or_else(|| wrong("", format!("`{}` has no `=`", shortened(item))))?;
        let (key, typed) = (key.trim(), typed.trim());
        check(key).map_err(|problem| wrong(key, problem))?;
        if typed.is_empty() {
            take_away(&mut self.table, key).map_err(|problem| {
                Box::new(CaseError {
                    allowed: "a key that the case has".to_owned(),
                    remedy: "correct the name, or leave it out".to_owned(),
                    ..*wrong(key, problem)
                })
            })?;
            self.overrides.push((key.to_owned(), String::new()));
            return Ok(());
        }
        let document = format!("value = {typed}").parse::<Table>();
        let value = match document {
            Ok(mut table) if table.len() == 1 => table.remove("value"),
            Err(e) if is_no_word(typed) && with_all_digits(typed).is_none() => {
                return Err(Box::new(CaseError {
                    allowed: "TOML: numbers, \"texts\", [lists], { tables }".to_owned(),
                    remedy: "correct it there; in lists and tables texts stand between quotes"
                        .to_owned(),
                    ..*wrong(key, not_toml(typed, &e))
                }));
            }
            _ => None,
        };
        if let (None, Some(whole)) = (&value, with_all_digits(typed)) {
            return Err(Box::new(CaseError {
                allowed: "numbers with digits on both sides of the point".to_owned(),
                remedy: format!("{key}={whole}; a text stands between quotes"),
                ..*wrong(key, "TOML has no numbers like .5 or 5.".to_owned())
            }));
        }
        let value = value.unwrap_or_else(|| Value::String(typed.to_owned()));
        set(&mut self.table, key, value).map_err(|problem| wrong(key, problem))?;
        self.overrides.push((key.to_owned(), typed.to_owned()));
        Ok(())
    }
}

/// Whether a value begins as a list or a table, or is a number or begins as a negative one, none of which is a text
/// without quotes.
fn is_no_word(typed: &str) -> bool {
    let after_signs = typed.trim_start_matches(['+', '-']);
    let begins_with_digit = after_signs.starts_with(|c: char| c.is_ascii_digit());
    let is_signed = after_signs.len() < typed.len();
    typed.starts_with(['[', '{'])
        || begins_with_digit && (is_signed || typed.parse::<f64>().is_ok())
}

/// What is wrong with a value, and where in it.
fn not_toml(typed: &str, error: &toml::de::Error) -> String {
    if typed.parse::<f64>().is_ok_and(f64::is_infinite) {
        return format!("this number is too large: the largest is {:.1e}", f64::MAX);
    }
    let at = error.span().map_or(0, |s| s.start);
    let at = at.saturating_sub("value = ".len()).min(typed.len());
    let place = match typed.get(at..).unwrap_or_default() {
        "" => "at its end".to_owned(),
        rest => format!("at `{}`", shortened(rest)),
    };
    let message = error.message().trim().replace('\n', ", ");
    format!("this is not TOML: {message}, {place}")
}

/// The start of a long text.
fn shortened(text: &str) -> String {
    const MOST: usize = 120;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

/// Whether one path is the other or lies inside it.
fn related(a: &str, b: &str) -> bool {
    let inside = |outer: &str, inner: &str| {
        inner
            .strip_prefix(outer)
            .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
    };
    !b.is_empty() && (inside(a, b) || inside(b, a))
}

/// The path of a key in a table.
pub(crate) fn join(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}

fn record_table(path: &str, table: &DeTable<'_>, places: &mut BTreeMap<String, Place>) {
    for (key, value) in table {
        let here = join(path, key.get_ref());
        record(here, key.span(), value, places);
    }
}

fn record(
    path: String,
    key: Range<usize>,
    value: &Spanned<DeValue<'_>>,
    places: &mut BTreeMap<String, Place>,
) {
    match value.get_ref() {
        DeValue::Table(table) => record_table(&path, table, places),
        DeValue::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                record(format!("{path}[{k}]"), item.span(), item, places);
            }
        }
        _ => {}
    }
    let value = value.span();
    places.insert(path, Place { key, value });
}

/// The raw case, or a table in it, as the table that would be read.
pub(crate) fn table_of(raw: &impl serde::Serialize) -> Table {
    Table::try_from(raw).expect("a case that was read can be written")
}

/// A value in one line, shortened.
pub(crate) fn in_one_line(value: &Value) -> Option<String> {
    match value {
        Value::Table(_) => None,
        Value::Float(x) => Some(format!("{x:?}")),
        Value::Array(items) if (1..=6).contains(&items.len()) => {
            let items: Vec<String> = items
                .iter()
                .map(|i| in_one_line(i).unwrap_or_else(|| i.to_string()))
                .collect();
            Some(format!("[{}]", items.join(", ")))
        }
        Value::Array(items) if items.len() > 6 => Some(format!("[{} elements]", items.len())),
        other => Some(other.to_string()),
    }
}

fn check_finite(path: &str, value: &Value) -> Result<(), Fault> {
    match value {
        Value::Float(x) if !x.is_finite() => Err(Fault::new(
            path,
            "this is not a finite number",
            "finite numbers everywhere",
            "replace it by a measured or estimated value, or leave the key out to get its default",
        )),
        Value::Array(items) => {
            let mut all = items.iter().enumerate();
            all.try_for_each(|(k, item)| check_finite(&format!("{path}[{k}]"), item))
        }
        Value::Table(table) => {
            let mut all = table.iter();
            all.try_for_each(|(key, item)| check_finite(&join(path, key), item))
        }
        _ => Ok(()),
    }
}
