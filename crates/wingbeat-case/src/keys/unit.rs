//! Units of keys, from their names.

/// Endings of names and the units they stand for, longer ones before their own endings.
const UNITS: [(&str, &str); 34] = [
    ("table_m_kg_m2", "m, kg/m2"),
    ("_newton_m_m2", "N m, N m2"),
    ("_newton_m_s_per_rad", "N m s/rad"),
    ("_newton_m_per_rad", "N m/rad"),
    ("_newton_s_per_m", "N s/m"),
    ("_newton_per_m", "N/m"),
    ("_newton_s_m", "N s/m"),
    ("_newton_m_s", "N m s"),
    ("_newton_m2", "N m2"),
    ("_newton_m", "N m"),
    ("_newton_s", "N s"),
    ("_newton", "N"),
    ("_s_per_rad", "s/rad"),
    ("_per_rad2", "1/rad2"),
    ("_per_s", "1/s"),
    ("_1_s", "1/s"),
    ("_kg_m", "kg m"),
    ("_pa", "Pa"),
    ("_kg_m2", "kg m2"),
    ("_kg_m3", "kg/m3"),
    ("_kg_per_m", "kg/m"),
    ("_kg", "kg"),
    ("_deg_s", "deg/s"),
    ("_deg", "deg"),
    ("_hz", "Hz"),
    ("_m_s2", "m/s2"),
    ("_m2_s", "m2/s"),
    ("_m_s", "m/s"),
    ("_m2", "m2"),
    ("_m", "m"),
    ("_s", "s"),
    ("_chords", "mean chords"),
    ("_beats", "wingbeats"),
    ("beats", "wingbeats"),
];

/// Unit of a key; none where it is a pure number or no number.
pub(super) fn unit(key: &str) -> Option<&'static str> {
    if key.starts_with("areal_density_kg") {
        return Some("kg/m2");
    }
    if key.ends_with("formation_chords") {
        return Some("chords"); // of each strip
    }
    UNITS
        .iter()
        .find(|(end, _)| key.ends_with(end))
        .map(|u| u.1)
}

/// A unit of [`unit`] as tables of numbers write units, with exponents in place of fractions, `m s-1`; "1" of
/// pure numbers, which lengths in chords and times in wingbeats are.
pub(super) fn with_exponents(unit: Option<&str>) -> String {
    let unit = match unit {
        None | Some("mean chords" | "chords" | "wingbeats") => return "1".to_owned(),
        Some("deg") => return "degree".to_owned(),
        Some(unit) => unit,
    };
    let (above, below) = unit.split_once('/').unwrap_or((unit, ""));
    let inverse = |symbol: &str| match symbol.find(|c: char| c.is_ascii_digit()) {
        Some(k) => format!("{}-{}", &symbol[..k], &symbol[k..]),
        None => format!("{symbol}-1"),
    };
    let above = above.split(' ').filter(|symbol| *symbol != "1");
    let above = above.map(|symbol| symbol.replace("deg", "degree"));
    let below = below.split_whitespace().map(inverse);
    above.chain(below).collect::<Vec<_>>().join(" ")
}

/// The name of a key without its unit; none for names without one.
pub(crate) fn without_unit(key: &str) -> Option<&str> {
    UNITS.iter().find_map(|(end, _)| key.strip_suffix(end))
}

#[cfg(test)]
mod tests {
    use super::with_exponents;

    #[test]
    fn behaves_units_have_exponents_in_tables() {
        for (unit, written) in [
            (None, "1"),
            (Some("Hz"), "Hz"),
            (Some("m/s2"), "m s-2"),
            (Some("1/rad2"), "rad-2"),
            (Some("N m s/rad"), "N m s rad-1"),
            (Some("deg/s"), "degree s-1"),
            (Some("wingbeats"), "1"),
        ] {
            assert_eq!(with_exponents(unit), written);
        }
    }
}
