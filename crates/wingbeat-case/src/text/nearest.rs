//! Which of the known names was meant.

/// Words longer than this many bytes are no slips of known ones.
const LONGEST_SLIP: usize = 64;

/// The nearest of `names`, if it is near: alike as a whole, or a slip of the finger away.
pub fn nearest<'a>(got: &str, names: &[&'a str]) -> Option<&'a str> {
    if got.len() > LONGEST_SLIP {
        return None; // the search would take its square
    }
    let got = got.to_lowercase();
    let slips = |name: &str| strsim::damerau_levenshtein(&got, name);
    let score = |name: &str| match slips(name) {
        0 | 1 => 1.0,
        _ => strsim::jaro_winkler(&got, name),
    };
    let best = names.iter().max_by(|a, b| score(a).total_cmp(&score(b)))?;
    (got.chars().count() > 1 && score(best) > 0.8).then_some(best)
}
