//! The value of a key at a point.

/// The value of a key at a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A whole number.
    Whole(i64),
    /// A number.
    Number(f64),
    /// Anything else, as TOML writes it in one line.
    Other(Box<str>),
}

impl Value {
    /// From a value of the file; none for a table, which no key of a point holds.
    pub fn of(value: &toml::Value) -> Option<Self> {
        match value {
            toml::Value::Integer(n) => Some(Self::Whole(*n)),
            toml::Value::Float(x) => Some(Self::Number(*x)),
            toml::Value::Table(_) => None,
            other => Some(Self::Other(other.to_string().into())),
        }
    }

    /// From a cell of a CSV file: a number or true or false where it is one, else a text.
    pub fn of_cell(cell: &str) -> Option<Self> {
        if let Ok(n) = cell.parse::<i64>() {
            return Some(Self::Whole(n));
        }
        if let Ok(truth) = cell.to_lowercase().parse::<bool>() {
            return Self::of(&toml::Value::Boolean(truth));
        }
        match cell.parse::<f64>() {
            Ok(x) => x.is_finite().then_some(Self::Number(x)),
            Err(_) => Self::of(&toml::Value::String(cell.to_owned())),
        }
    }

    /// The number it is.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Whole(n) => Some(*n as f64),
            Self::Number(x) => Some(*x),
            Self::Other(_) => None,
        }
    }

    /// Appends it as TOML writes it.
    pub fn write(&self, text: &mut String) {
        use std::fmt::Write as _;
        let _ = match self {
            Self::Whole(n) => write!(text, "{n}"),
            Self::Number(x) => write!(text, "{x:?}"),
            Self::Other(other) => write!(text, "{other}"),
        }; // a string takes everything
    }

    /// As tables show it: texts without quotes.
    pub fn shown(&self) -> String {
        let mut text = String::new();
        self.write(&mut text);
        let inner = text.strip_prefix('"').and_then(|t| t.strip_suffix('"'));
        inner.map_or(text.clone(), str::to_owned)
    }
}
